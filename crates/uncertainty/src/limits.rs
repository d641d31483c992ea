//! How many samples there can be.

use crate::model::LANES;

/// Number of point sets that the samples are dealt to.
pub const REPLICATES: usize = 16;

/// The least number of samples: one block, four points of each replicate.
pub const MIN_SAMPLES: usize = LANES;

/// The greatest number of samples, 2³², for which the strata and the direction numbers are made.
pub const MAX_SAMPLES: u64 = 1 << 32;
