//! Why a distribution or a request makes no sense.

use crate::limits::{MAX_SAMPLES, MIN_SAMPLES};

/// Why a distribution cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidDistribution {
    /// A number that is infinite or NaN.
    #[error("the {name} must be a finite number, and is {value}")]
    NotFinite {
        /// What the number is.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A normal distribution without width.
    #[error(
        "the standard deviation must be greater than zero, and is {sd}; give a value that is certain as a plain value"
    )]
    NoDeviation {
        /// (unit of the input) the standard deviation.
        sd: f64,
    },
    /// Bounds in the wrong order, or equal.
    #[error(
        "the lower bound must be below the upper bound, and they are {low} and {high}; give a value that is certain \
         as a plain value"
    )]
    Empty {
        /// (unit of the input) lower bound.
        low: f64,
        /// (unit of the input) upper bound.
        high: f64,
    },
    /// A mode outside the bounds.
    #[error("the likeliest value must lie between the bounds {low} and {high}, and is {mode}")]
    ModeOutside {
        /// (unit of the input) lower bound.
        low: f64,
        /// (unit of the input) likeliest value.
        mode: f64,
        /// (unit of the input) upper bound.
        high: f64,
    },
    /// Bounds that cut away all but [`crate::MIN_KEPT`] of the distribution.
    #[error(
        "a value of {mean} with a standard deviation of {sd} lies between {low} and {high} with a probability of {kept:.1e} only; \
         check the value and its deviation"
    )]
    NothingKept {
        /// (unit of the input) mean before the cut.
        mean: f64,
        /// (unit of the input) standard deviation before the cut.
        sd: f64,
        /// (unit of the input) lower bound.
        low: f64,
        /// (unit of the input) upper bound.
        high: f64,
        /// Share between the bounds.
        kept: f64,
    },
}

/// Why a propagation cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidRequest {
    /// Nothing is uncertain.
    #[error("there is no uncertain input; give at least one input as a range")]
    NoInputs,
    /// More inputs than the direction numbers of the Sobol' points serve.
    #[error(
        "Sobol' points serve up to {limit} inputs here, and there are {inputs}; take Latin hypercube or Monte Carlo points"
    )]
    TooManyInputs {
        /// Number of inputs.
        inputs: usize,
        /// The most there may be.
        limit: usize,
    },
    /// A number of samples that tells nothing, or that no point set reaches.
    #[error("the number of samples must be between {} and {MAX_SAMPLES}, and is {samples}", MIN_SAMPLES)]
    Samples {
        /// Number of samples.
        samples: usize,
    },
    /// A number of rows for the indices that tells nothing, or that no point set reaches.
    #[error("the number of rows must be between {} and {MAX_SAMPLES}, and is {rows}", MIN_SAMPLES)]
    Rows {
        /// Number of rows.
        rows: usize,
    },
    /// Two lists that belong together differ in length.
    #[error("there must be one {what} for each of the {expected} inputs, and there are {given}")]
    Length {
        /// What the list holds.
        what: &'static str,
        /// Number of inputs.
        expected: usize,
        /// Length of the list.
        given: usize,
    },
    /// A probability that is none.
    #[error("the two probabilities must be above 0, below 1 and in rising order, and are {low} and {high}")]
    Probabilities {
        /// The lower.
        low: f64,
        /// The upper.
        high: f64,
    },
}
