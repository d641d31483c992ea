//! How many samples there can be.

use crate::model::LANES;

/// Number of point sets that the samples are dealt to.
pub const REPLICATES: usize = 16;

/// The least number of samples: one block, four points of each replicate.
pub const MIN_SAMPLES: usize = LANES;

/// The greatest number of samples, all of which are kept, and of rows of [`crate::sensitivity`]. With so many
/// the standard error of an end of a 95 % interval is below a thousandth of the standard deviation.
pub const MAX_SAMPLES: usize = 10_000_000;
