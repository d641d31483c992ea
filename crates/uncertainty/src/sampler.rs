//! The inputs of every sample.

use crate::dispatch;

use crate::distribution::Distribution;
use crate::error::InvalidRequest;
use crate::limits::MAX_SAMPLES;
use crate::model::{LANES, Lanes, Model, evaluate};
use crate::points::{Points, SamplingMethod};
use crate::run::Instructions;

/// Settings of the sampling.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Number of samples, or of rows for [`crate::sensitivity`].
    pub samples: usize,
    /// The random seed: the same seed gives the same results.
    pub seed: u64,
    /// The sampling method.
    pub method: SamplingMethod,
    /// The instruction set, which does not change the results.
    pub instructions: Instructions,
}

impl Settings {
    /// Settings with the best instruction set of this CPU.
    #[must_use]
    pub fn new(method: SamplingMethod, samples: usize, seed: u64) -> Self {
        Self { samples, seed, method, instructions: Instructions::best() }
    }
}

/// Regenerates the inputs of the samples of [`crate::propagate`], for a caller that writes them to a file:
/// the propagation keeps only the outputs.
#[derive(Clone, Debug)]
pub struct Sampler<'a> {
    pub(crate) inputs: &'a [Distribution],
    points: Points,
    pub(crate) instructions: Instructions,
}

impl<'a> Sampler<'a> {
    /// A sampler for the same inputs and settings as the propagation.
    ///
    /// # Errors
    /// If there are no inputs or too many, or if the number of samples is out of range.
    pub fn new(inputs: &'a [Distribution], settings: &Settings) -> Result<Self, InvalidRequest> {
        let points = Points::new(settings.method, settings.seed, inputs.len(), settings.samples)?;
        Ok(Self { inputs, points, instructions: settings.instructions })
    }

    /// Inputs of the samples from `block`·[`crate::LANES`] on, a column for each input. Lanes beyond the last
    /// sample hold arbitrary values.
    pub fn fill(&self, block: u64, columns: &mut [Lanes]) {
        // All blocks beyond the last sample are arbitrary.
        let block = block.min(MAX_SAMPLES as u64);
        fill(self.instructions, &self.points, self.inputs, block, columns);
    }

    /// Fills the inputs likewise, and returns the model's reason codes; `outputs` has a column for each
    /// output.
    pub fn evaluate<M: Model>(
        &self,
        model: &M,
        block: u64,
        columns: &mut [Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) {
        self.fill(block, columns);
        evaluate(self.instructions, model, columns, outputs, reasons);
    }
}

/// Turns a block of points into values of the inputs, repeating the inputs for all columns.
pub(crate) fn fill(
    instructions: Instructions,
    points: &Points,
    inputs: &[Distribution],
    block: u64,
    columns: &mut [Lanes],
) {
    dispatch!(instructions, fill_with(points, inputs, block, columns));
}

#[inline(always)]
fn fill_with(points: &Points, inputs: &[Distribution], block: u64, columns: &mut [Lanes]) {
    let Some(keys) = points.sequences() else {
        points.fill(block, columns);
        return Distribution::transform_all(inputs, columns);
    };
    let first = block * LANES as u64;
    for ((column, input), &key) in columns.iter_mut().zip(inputs.iter().cycle()).zip(keys) {
        input.draw(key, first, column);
    }
}
