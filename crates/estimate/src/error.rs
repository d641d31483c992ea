//! Errors of a run.

use std::fmt;

use uncertainty::Failures;

use crate::limits::{LEAST_ISLANDS, MOST_ISLANDS, MOST_PARTICLES, PARTICLES_STEP};

/// The reason why there are no draws.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoDraws {
    /// There is no unknown value.
    #[error("there is no unknown value; give at least one value a prior")]
    NothingUnknown,
    /// A number of particles that cannot be divided into two halves of whole blocks.
    #[error(
        "the number of particles of an island must be a multiple of {PARTICLES_STEP} up to \
         {MOST_PARTICLES}, but is {particles}"
    )]
    Particles {
        /// Number of particles.
        particles: usize,
    },
    /// Too few islands for their differences to be meaningful, or more than a computer holds.
    #[error("there must be from {LEAST_ISLANDS} to {MOST_ISLANDS} islands, but there are {islands}")]
    Islands {
        /// Number of islands.
        islands: usize,
    },
    /// A piece of evidence that does not exist.
    #[error("there are {terms} pieces of evidence, counted from 0, but number {term} was asked for")]
    NoSuchTerm {
        /// The requested index.
        term: usize,
        /// Number of pieces.
        terms: usize,
    },
    /// A log-likelihood that is NaN or +∞.
    #[error("the log-likelihood of evidence {term} is {value} at the values {values:?}")]
    NotALikelihood {
        /// Index of the piece of evidence.
        term: usize,
        /// The value in place of its log-likelihood.
        value: f64,
        /// (units of the values) the values that give it.
        values: Vec<f64>,
    },
    /// An output that is infinite or NaN.
    #[error("output {output} is {value} at the values {values:?}")]
    NotFinite {
        /// Index of the output.
        output: usize,
        /// Its value.
        value: f64,
        /// (units of the values) the values that give it.
        values: Vec<f64>,
    },
    /// No draw from the prior, or hardly any, agrees with all evidence.
    #[error("the evidence excludes what the prior allows: {0}")]
    Impossible(Exclusion),
    /// The caller ended the run.
    #[error("the run was ended after {finished} of {islands} islands")]
    Ended {
        /// Number of islands finished.
        finished: usize,
        /// Number of islands.
        islands: usize,
    },
}

/// The exclusions among the draws from the prior.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exclusion {
    /// Number of draws from the prior.
    pub drawn: usize,
    /// Number of draws with a likelihood above zero.
    pub possible: usize,
    /// Number of draws without a result of the model, by its reason.
    pub failures: Failures,
    /// Number of other draws excluded by each piece of evidence.
    pub by_term: Vec<usize>,
    /// Number of other draws excluded by both of two pieces, `[a][b]` for b < a.
    pub by_both: Vec<Vec<usize>>,
}

/// The smallest cause that excludes every draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Culprit {
    /// The model has no result for any draw.
    Model,
    /// One piece of evidence.
    Term(usize),
    /// Two pieces that are possible separately but not together.
    Pair(usize, usize),
    /// Three or more pieces together.
    Together,
    /// None: some draws are possible, but too few to continue.
    None,
}

impl Exclusion {
    pub(crate) fn new(terms: usize) -> Self {
        let by_both = (0..terms).map(|term| vec![0; term]).collect();
        Self { by_term: vec![0; terms], by_both, ..Self::default() }
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.drawn += other.drawn;
        self.possible += other.possible;
        for (reason, count) in &other.failures {
            *self.failures.entry(*reason).or_default() += count;
        }
        for (sum, count) in self.by_term.iter_mut().zip(&other.by_term) {
            *sum += count;
        }
        let others = other.by_both.iter().flatten();
        for (sum, count) in self.by_both.iter_mut().flatten().zip(others) {
            *sum += count;
        }
    }

    /// The smallest cause that excludes every draw; of several, the first.
    #[must_use]
    pub fn culprit(&self) -> Culprit {
        if self.possible > 0 {
            return Culprit::None;
        }
        let judged = self.drawn - self.failures.values().sum::<usize>();
        if judged == 0 {
            return Culprit::Model;
        }
        if let Some(term) = self.by_term.iter().position(|&excluded| excluded == judged) {
            return Culprit::Term(term);
        }
        for (second, row) in self.by_both.iter().enumerate() {
            for (first, &both) in row.iter().enumerate() {
                // |A ∪ B| = |A| + |B| − |A ∩ B|
                if self.by_term[first] + self.by_term[second] - both == judged {
                    return Culprit::Pair(first, second);
                }
            }
        }
        Culprit::Together
    }
}

impl fmt::Display for Exclusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let drawn = self.drawn;
        match self.culprit() {
            Culprit::Model => write!(f, "the model fails for all of {drawn} draws of the prior"),
            Culprit::Term(term) => {
                write!(f, "evidence {term} alone excludes all of {drawn} draws of the prior")
            }
            Culprit::Pair(first, second) => write!(
                f,
                "evidence {first} and evidence {second} are possible alone, but together they exclude all of \
                 {drawn} draws of the prior"
            ),
            Culprit::Together => {
                write!(f, "three pieces or more together exclude all of {drawn} draws of the prior")
            }
            Culprit::None => write!(f, "only {} of {drawn} draws of the prior are possible", self.possible),
        }
    }
}

/// The reason why draws cannot be reweighted, or a piece of evidence not be checked.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CannotReweight {
    /// A piece of evidence that does not exist.
    #[error("there are {terms} pieces of evidence, counted from 0, but number {term} was asked for")]
    NoSuchTerm {
        /// The requested index.
        term: usize,
        /// Number of pieces.
        terms: usize,
    },
    /// A piece that excludes values: without it there would be draws where there are none now.
    #[error("evidence {term} excludes values, so that no weights can bring them back; run again without it")]
    Excludes {
        /// Index of the piece of evidence.
        term: usize,
    },
    /// A piece without a residual.
    #[error("evidence {term} has no residual, so that it cannot be compared with a prediction")]
    NoResidual {
        /// Index of the piece of evidence.
        term: usize,
    },
}
