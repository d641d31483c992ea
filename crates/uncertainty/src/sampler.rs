//! The inputs of every sample.

use crate::distribution::{Distribution, transform_block};
use crate::error::InvalidRequest;
use crate::model::Lanes;
use crate::points::{Method, Points};
use crate::run::Instructions;

/// How to sample.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Number of samples; of rows for [`crate::sensitivity`].
    pub samples: usize,
    /// Any number; the same gives the same results.
    pub seed: u64,
    /// How points are laid.
    pub method: Method,
    /// For which instructions; makes no difference to the results.
    pub instructions: Instructions,
}

impl Settings {
    /// With the best instructions of this CPU.
    #[must_use]
    pub fn new(method: Method, samples: usize, seed: u64) -> Self {
        Self { samples, seed, method, instructions: Instructions::best() }
    }
}

/// The inputs of the samples of a [`crate::propagate`], for whoever writes them down: they are not kept, but made again.
#[derive(Clone, Debug)]
pub struct Sampler<'a> {
    inputs: &'a [Distribution],
    points: Points,
}

impl<'a> Sampler<'a> {
    /// For the same inputs and settings as the propagation.
    ///
    /// # Errors
    /// Where there are no inputs or too many, or where the number of samples is out of range.
    pub fn new(inputs: &'a [Distribution], settings: &Settings) -> Result<Self, InvalidRequest> {
        let points = Points::new(settings.method, settings.seed, inputs.len(), settings.samples)?;
        Ok(Self { inputs, points })
    }

    /// Inputs of the samples `block`·[`crate::LANES`] and following, a column for each input. Lanes beyond the last sample hold some
    /// value or other.
    #[inline(always)]
    pub fn fill(&self, block: u64, columns: &mut [Lanes]) {
        self.points.fill(block, columns);
        transform_block(self.inputs, columns);
    }
}
