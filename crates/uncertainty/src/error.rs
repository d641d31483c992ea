//! Errors of distributions and requests.

use crate::limits::{MAX_SAMPLES, MIN_SAMPLES};

/// The reason why a distribution is invalid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidDistribution {
    /// A number that is infinite or NaN.
    #[error("the {name} is {value}, but must be a finite number")]
    NotFinite {
        /// The name of the number.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A normal distribution without width.
    #[error(
        "the standard deviation is {sd}, but must be greater than zero; write an exact value without a range"
    )]
    NoDeviation {
        /// (unit of the input) the standard deviation.
        sd: f64,
    },
    /// A log-normal distribution about a value that is not positive.
    #[error("the median is {median}, but must be greater than zero")]
    MedianNotPositive {
        /// (unit of the input) the median.
        median: f64,
    },
    /// Bounds in the wrong order, or equal.
    #[error(
        "the bounds are {low} and {high}, but the lower must be below the upper; write an exact value \
         without a range"
    )]
    Empty {
        /// (unit of the input) lower bound.
        low: f64,
        /// (unit of the input) upper bound.
        high: f64,
    },
    /// A mode outside the bounds.
    #[error("the most likely value is {mode}, but must lie between the bounds {low} and {high}")]
    ModeOutside {
        /// (unit of the input) lower bound.
        low: f64,
        /// (unit of the input) most likely value.
        mode: f64,
        /// (unit of the input) upper bound.
        high: f64,
    },
    /// Bounds that leave less than [`crate::MIN_KEPT`] of the distribution.
    #[error(
        "a value of {mean} with a standard deviation of {sd} lies between {low} and {high} with a \
         probability of only {kept:.1e}; \
         check the value and its deviation"
    )]
    NothingKept {
        /// (unit of the input) mean before truncation.
        mean: f64,
        /// (unit of the input) standard deviation before truncation.
        sd: f64,
        /// (unit of the input) lower bound.
        low: f64,
        /// (unit of the input) upper bound.
        high: f64,
        /// Probability between the bounds.
        kept: f64,
    },
}

/// The reason why a propagation cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidRequest {
    /// No input is uncertain.
    #[error("there is no uncertain input; give at least one input as a range")]
    NoInputs,
    /// More inputs than there are direction numbers for Sobol' points.
    #[error(
        "Sobol' points allow at most {limit} inputs, but there are {inputs}; use Latin hypercube or Monte \
         Carlo points"
    )]
    TooManyInputs {
        /// Number of inputs.
        inputs: usize,
        /// Maximum number of inputs.
        limit: usize,
    },
    /// A number of samples that is too small to be useful.
    #[error("the number of samples must be between {MIN_SAMPLES} and {MAX_SAMPLES}, but is {samples}")]
    Samples {
        /// Number of samples.
        samples: usize,
    },
    /// More samples than the memory limit allows.
    #[error(
        "the number of samples must be between {MIN_SAMPLES} and {MAX_SAMPLES}, but is {samples}: each result \
         would take {} MB of memory, and the standard error of an end of its 95 % interval would fall only \
         from {:.3} % to {:.3} % of its standard deviation",
        samples / 125_000,
        error_of_end(MAX_SAMPLES),
        error_of_end(*samples)
    )]
    TooManySamples {
        /// Number of samples.
        samples: usize,
    },
    /// A number of rows for the indices that is too small or too large to be useful.
    #[error("the number of rows must be between {MIN_SAMPLES} and {MAX_SAMPLES}, but is {rows}")]
    Rows {
        /// Number of rows.
        rows: usize,
    },
    /// Two lists that belong together differ in length.
    #[error("there must be one {what} for each of the {expected} inputs, but there are {given}")]
    Length {
        /// The content of the list.
        what: &'static str,
        /// Number of inputs.
        expected: usize,
        /// Length of the list.
        given: usize,
    },
    /// Probabilities that are not 0 < low < high < 1.
    #[error("the two probabilities are {low} and {high}, but must be above 0, below 1 and in rising order")]
    Probabilities {
        /// The lower.
        low: f64,
        /// The upper.
        high: f64,
    },
}

/// (% of the standard deviation) standard error of an end of the 95 % interval of a normal result.
fn error_of_end(samples: usize) -> f64 {
    /// φ(1.96), the density of a standard normal number there.
    const DENSITY: f64 = 0.058_445;
    // σ_Q = √(p(1 − p)/n)/φ(z_p), p = 0.025 (Kendall and Stuart, section 14)
    100.0 * (0.025 * 0.975 / samples as f64).sqrt() / DENSITY
}
