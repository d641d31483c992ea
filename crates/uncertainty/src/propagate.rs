//! Turns samples of the inputs into samples of the outputs.

use crate::distribution::Distribution;
use crate::error::InvalidRequest;
use crate::model::{Failures, LANES, Lanes, Model, SUCCEEDED, count_failures};
use crate::points::SamplingMethod;
use crate::run::{Progress, Span, for_each, in_order};
use crate::sampler::{Sampler, Settings};
use crate::summary::{Classes, Histogram, Summary};

/// The result of a propagation.
#[derive(Clone, Debug)]
pub struct Propagation {
    columns: Vec<Vec<f64>>,
    reasons: Vec<u8>,
    failures: Failures,
    summaries: Vec<Option<Summary>>,
    requested: usize,
}

impl Propagation {
    /// Number of samples requested.
    #[must_use]
    pub fn requested(&self) -> usize {
        self.requested
    }

    /// Number of samples evaluated: fewer than requested if the run was ended early.
    #[must_use]
    pub fn evaluated(&self) -> usize {
        self.reasons.len()
    }

    /// Number of samples with an answer. Only these are summarised.
    #[must_use]
    pub fn succeeded(&self) -> usize {
        self.evaluated() - self.failures().values().sum::<usize>()
    }

    /// Number of samples without an answer, by the model's reason code, or [`crate::NOT_FINITE`].
    #[must_use]
    pub fn failures(&self) -> &Failures {
        &self.failures
    }

    /// Reason code of each sample; [`SUCCEEDED`] if it has an answer.
    #[must_use]
    pub fn reasons(&self) -> &[u8] {
        &self.reasons
    }

    /// The samples of each output, NaN for failed samples.
    #[must_use]
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// Statistics of each output; `None` if fewer than two samples have an answer.
    #[must_use]
    pub fn summaries(&self) -> &[Option<Summary>] {
        &self.summaries
    }

    /// The histogram of an output. `None` if its middle 99 % are equal, if fewer than two samples have an
    /// answer, or if there is no such output.
    #[must_use]
    pub fn histogram(&self, output: usize, classes: Classes) -> Option<Histogram> {
        let summary = (*self.summaries.get(output)?)?;
        Histogram::of(self.columns.get(output)?, &summary, classes)
    }

    /// Leaves only the first outputs.
    pub fn truncate(&mut self, outputs: usize) {
        self.columns.truncate(outputs);
        self.summaries.truncate(outputs);
    }
}

/// Evaluates the model for samples of its inputs, and keeps the outputs, eight bytes each.
///
/// `progress` receives the number of finished samples and may end the run early; the result then holds the
/// first samples of the whole run.
///
/// # Errors
/// If there are no inputs or too many, or if the number of samples is out of range.
pub fn propagate<M: Model>(
    model: &M,
    inputs: &[Distribution],
    settings: &Settings,
    progress: &mut Progress<'_>,
) -> Result<Propagation, InvalidRequest> {
    let sampler = Sampler::new(inputs, settings)?;
    let requested = settings.samples;
    let mut columns = vec![vec![0.0; requested]; model.outputs()];
    let mut reasons = vec![SUCCEEDED; requested];
    let evaluated = evaluate(model, &sampler, (&mut columns, &mut reasons), progress);
    for column in &mut columns {
        column.truncate(evaluated);
    }
    reasons.truncate(evaluated);
    let mut failures = Failures::new();
    count_failures(&mut failures, &reasons);
    let is_replicated = settings.method != SamplingMethod::MonteCarlo;
    let summaries = for_each(&columns, |column| Summary::of(column, is_replicated));
    Ok(Propagation { columns, reasons, failures, summaries, requested })
}

/// Samples that a thread takes at a time.
const SPAN: usize = 64 * LANES;

/// Fills the columns and the reasons, until the run ends. Returns the number of samples evaluated.
fn evaluate<M: Model>(
    model: &M,
    sampler: &Sampler<'_>,
    (columns, reasons): (&mut [Vec<f64>], &mut [u8]),
    progress: &mut Progress<'_>,
) -> usize {
    let mut slices: Vec<_> = columns.iter_mut().map(|column| column.chunks_mut(SPAN)).collect();
    let blocks = (0_u64..).step_by(SPAN / LANES);
    let spans = blocks.zip(reasons.chunks_mut(SPAN)).map(|(first_block, reasons)| {
        let outputs = slices.iter_mut().flat_map(Iterator::next).collect();
        Span { samples: reasons.len(), work: Part { first_block, outputs, reasons } }
    });
    let spans = spans.collect();
    in_order(spans, |part: Part<'_>| part.evaluate(model, sampler), progress).into_iter().sum()
}

/// The destination of the results of a span of blocks.
struct Part<'c> {
    first_block: u64,
    outputs: Vec<&'c mut [f64]>,
    reasons: &'c mut [u8],
}

impl Part<'_> {
    /// Returns the number of samples.
    fn evaluate<M: Model>(self, model: &M, sampler: &Sampler<'_>) -> usize {
        let Self { first_block, mut outputs, reasons: codes } = self;
        let mut inputs = vec![Lanes::ZERO; sampler.inputs.len()];
        let mut answers = vec![Lanes::ZERO; model.outputs()];
        let mut reasons = [SUCCEEDED; LANES];
        for ((start, codes), block) in (0..).step_by(LANES).zip(codes.chunks_mut(LANES)).zip(first_block..) {
            sampler.evaluate(model, block, &mut inputs, &mut answers, &mut reasons);
            let count = codes.len();
            for (answer, output) in answers.iter().zip(&mut outputs) {
                output[start..][..count].copy_from_slice(&answer[..count]);
            }
            codes.copy_from_slice(&reasons[..count]);
        }
        codes.len()
    }
}

#[cfg(test)]
mod tests;
