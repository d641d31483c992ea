//! The purposes of a case: which analysis it is used for.

use crate::choices;
use std::fmt;

choices! {
    /// What can be done with a case.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Purpose {
        /// Finds the speed at which the impact dissipates exactly the crush energy.
        Reconstruct = "reconstruct",
        /// Solves the impact with both speeds given.
        Impact = "impact",
        /// CRASH3 from only the damage.
        Crush = "crush",
        /// Follows each vehicle from the impact to rest, or back.
        Motion = "motion",
        /// Propagates the ranges of the case.
        Uncertainty = "uncertainty",
        /// Weighs all evidence.
        Estimate = "estimate",
        /// Puts the answers of all laws side by side.
        Compare = "compare",
        /// Shows how sensitive the answer is to each input.
        Sensitivity = "sensitivity",
        /// Draws the answer.
        Draw = "draw",
        /// Asks whether the collision was avoidable.
        Avoid = "avoid",
    }
}

impl fmt::Display for Purpose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
