//! The purposes of a case: which analysis it is used for.

use std::fmt;

/// What can be done with a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purpose {
    /// Finds the speed at which the impact dissipates exactly the crush energy.
    Reconstruct,
    /// Solves the impact with both speeds given.
    Impact,
    /// CRASH3 from only the damage.
    Crush,
    /// Follows each vehicle from the impact to rest, or back.
    Motion,
    /// Propagates the ranges of the case.
    Uncertainty,
    /// Weighs all evidence.
    Estimate,
    /// Puts the answers of all laws side by side.
    Compare,
    /// Shows how sensitive the answer is to each input.
    Sensitivity,
    /// Draws the answer.
    Draw,
    /// Asks whether the collision was avoidable.
    Avoid,
}

impl Purpose {
    /// Its name in one word, such as `reconstruct`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reconstruct => "reconstruct",
            Self::Impact => "impact",
            Self::Crush => "crush",
            Self::Motion => "motion",
            Self::Uncertainty => "uncertainty",
            Self::Estimate => "estimate",
            Self::Compare => "compare",
            Self::Sensitivity => "sensitivity",
            Self::Draw => "draw",
            Self::Avoid => "avoid",
        }
    }
}

impl fmt::Display for Purpose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
