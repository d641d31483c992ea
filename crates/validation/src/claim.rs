//! A number next to a printed one, and the claim about the two.

use serde::Serialize;

/// The claim about a [`Cell`].
#[derive(Clone, Debug, PartialEq)]
pub enum Claim {
    /// Our number agrees within this tolerance, in the unit of the cell.
    Reproduces {
        /// In the unit of the cell.
        tolerance: f64,
    },
    /// It is known not to agree, or its inputs are not published: nothing is claimed.
    KnownDifference {
        /// Why, as a clause of a sentence.
        reason: String,
    },
}

/// A misprint that was corrected before the comparison. Marked `ERRATUM` wherever it is shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Erratum {
    /// The printed text.
    pub printed: String,
    /// Why it cannot be right, as a clause of a sentence.
    pub reason: String,
}

/// A number of ours next to one of a paper, both in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The program's number.
    pub ours: f64,
    /// The paper's number, with its misprints corrected.
    pub paper: f64,
    /// The misprint that was corrected.
    pub erratum: Option<Erratum>,
    /// The claim about the two.
    pub claim: Claim,
}

impl Cell {
    pub(crate) fn claimed(ours: f64, paper: f64, tolerance: f64) -> Self {
        Self { ours, paper, erratum: None, claim: Claim::Reproduces { tolerance } }
    }

    pub(crate) fn known(ours: f64, paper: f64, reason: &str) -> Self {
        Self { ours, paper, erratum: None, claim: Claim::KnownDifference { reason: reason.to_owned() } }
    }

    /// Our number less the paper's.
    #[must_use]
    pub fn difference(&self) -> f64 {
        self.ours - self.paper
    }

    /// The tolerance within which it is claimed to reproduce.
    #[must_use]
    pub fn tolerance(&self) -> Option<f64> {
        match self.claim {
            Claim::Reproduces { tolerance } => Some(tolerance),
            Claim::KnownDifference { .. } => None,
        }
    }

    /// Whether it is claimed to reproduce.
    #[must_use]
    pub fn is_claimed(&self) -> bool {
        self.tolerance().is_some()
    }

    /// Whether it is claimed to reproduce and does not. A result that is not a number fails.
    #[must_use]
    pub fn fails(&self) -> bool {
        match self.claim {
            Claim::Reproduces { tolerance } => {
                self.difference().abs().partial_cmp(&tolerance).is_none_or(std::cmp::Ordering::is_gt)
            }
            Claim::KnownDifference { .. } => false,
        }
    }
}
