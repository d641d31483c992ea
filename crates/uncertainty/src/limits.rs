//! Limits of the number of samples.

use crate::model::LANES;

/// Number of point sets to which the samples are dealt.
pub const REPLICATES: usize = 16;

/// Minimum number of samples: one block, four points of each replicate.
pub const MIN_SAMPLES: usize = LANES;

/// Maximum number of samples, which are all kept, and of rows of [`crate::sensitivity`]. At this number the
/// standard error of an end of a 95 % interval is below a thousandth of the standard deviation.
pub const MAX_SAMPLES: usize = 10_000_000;
