//! The commands that a case is for.

use std::fmt;

/// What can be done with a case: the commands of the program that read one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Command {
    /// Finds the speed at which the impact takes the crush energy.
    Reconstruct,
    /// Solves the impact, both speeds given.
    Impact,
    /// CRASH3 from the damage alone.
    Crush,
    /// Propagates the ranges of the case.
    Uncertainty,
    /// Puts the answers of all laws side by side.
    Compare,
    /// Derives the answer by each estimate.
    Sensitivity,
    /// Draws the answer.
    Draw,
    /// Judges the case without solving it.
    Check,
}

impl Command {
    /// The word that calls it, as in `deltav reconstruct`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reconstruct => "reconstruct",
            Self::Impact => "impact",
            Self::Crush => "crush",
            Self::Uncertainty => "uncertainty",
            Self::Compare => "compare",
            Self::Sensitivity => "sensitivity",
            Self::Draw => "draw",
            Self::Check => "check",
        }
    }
}

impl fmt::Display for Command {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
