//! A number beside a printed one, and what is claimed of the two.

/// What is claimed of a [`Cell`].
#[derive(Clone, Debug, PartialEq)]
pub enum Claim {
    /// It comes out within this tolerance, in the unit of the cell.
    Reproduces {
        /// In the unit of the cell.
        tolerance: f64,
    },
    /// It is known not to come out, or its inputs are not published: nothing is claimed.
    KnownDifference {
        /// Why, as a clause of a sentence.
        reason: String,
    },
}

/// A misprint that was corrected before the comparison. Marked `ERRATUM` wherever it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Erratum {
    /// What stands in print.
    pub printed: String,
    /// Why it cannot be meant, as a clause of a sentence.
    pub reason: String,
}

/// A number of ours beside one of a paper, both in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// What the program computes.
    pub ours: f64,
    /// What the paper has, with its misprints corrected.
    pub paper: f64,
    /// The misprint that was corrected.
    pub erratum: Option<Erratum>,
    /// What is claimed.
    pub claim: Claim,
}

impl Cell {
    pub(crate) fn claimed(ours: f64, paper: f64, tolerance: f64) -> Self {
        Self { ours, paper, erratum: None, claim: Claim::Reproduces { tolerance } }
    }

    pub(crate) fn known(ours: f64, paper: f64, reason: &str) -> Self {
        Self { ours, paper, erratum: None, claim: Claim::KnownDifference { reason: reason.to_owned() } }
    }

    pub(crate) fn with_erratum(self, erratum: Option<Erratum>) -> Self {
        Self { erratum, ..self }
    }

    /// Ours less the paper's.
    #[must_use]
    pub fn difference(&self) -> f64 {
        self.ours - self.paper
    }

    /// Whether it is claimed to reproduce.
    #[must_use]
    pub fn is_claimed(&self) -> bool {
        matches!(self.claim, Claim::Reproduces { .. })
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
