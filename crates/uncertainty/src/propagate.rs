//! Turns samples of the inputs into samples of the outputs.

use crate::distribution::Distribution;
use crate::error::InvalidRequest;
use crate::model::{Failures, LANES, Lanes, Model, SUCCEEDED, count_failures, evaluate};
use crate::run::{Instructions, Progress, Span, for_each, in_order};
use crate::sampler::{Sampler, Settings};
use crate::summary::Summary;

/// Samples that one thread takes at a time.
const SPAN: usize = 64 * LANES;

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

    /// Number of samples evaluated: fewer than requested where the run was ended early.
    #[must_use]
    pub fn evaluated(&self) -> usize {
        self.reasons.len()
    }

    /// Number of samples that have an answer. Only these are summarised.
    #[must_use]
    pub fn succeeded(&self) -> usize {
        self.evaluated() - self.failures.values().sum::<usize>()
    }

    /// Number of samples without an answer, by the model's reason code, or [`crate::NOT_FINITE`].
    #[must_use]
    pub fn failures(&self) -> &Failures {
        &self.failures
    }

    /// Reason code of each sample evaluated; [`SUCCEEDED`] where it has an answer.
    #[must_use]
    pub fn reasons(&self) -> &[u8] {
        &self.reasons
    }

    /// The samples of each output, NaN where the sample failed.
    #[must_use]
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// Statistics of each output that is [summarised](Model::summarised); `None` where fewer than two samples
    /// have an answer.
    #[must_use]
    pub fn summaries(&self) -> &[Option<Summary>] {
        &self.summaries
    }
}

/// Evaluates the model for samples of its inputs.
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
    let mut columns: Vec<_> = (0..model.outputs()).map(|_| vec![0.0; settings.samples]).collect();
    let mut reasons = vec![SUCCEEDED; settings.samples];

    let mut slices: Vec<_> = columns.iter_mut().map(|column| column.chunks_mut(SPAN)).collect();
    let spans = (0..)
        .zip(reasons.chunks_mut(SPAN))
        .map(|(index, reasons)| {
            let outputs = slices.iter_mut().flat_map(Iterator::next).collect();
            Span { samples: reasons.len(), work: Part { index, outputs, reasons } }
        })
        .collect();
    let work = |part: Part<'_>| part.evaluate(model, &sampler, settings.instructions);
    let parts = in_order(spans, work, progress);

    let mut failures = Failures::new();
    let mut evaluated = 0;
    for part in parts {
        evaluated += part.samples;
        for (reason, count) in part.failures {
            *failures.entry(reason).or_default() += count;
        }
    }
    for column in &mut columns {
        column.truncate(evaluated);
    }
    reasons.truncate(evaluated);
    let is_complete = failures.is_empty();
    let summarised = &columns[..model.summarised().min(columns.len())];
    let summaries = for_each(summarised, |column| Summary::of(column, is_complete, settings.method));
    Ok(Propagation { columns, reasons, failures, summaries, requested: settings.samples })
}

/// Where the results of a span go.
struct Part<'a> {
    index: u64,
    outputs: Vec<&'a mut [f64]>,
    reasons: &'a mut [u8],
}

/// What is known of a span that is done.
struct Done {
    samples: usize,
    failures: Failures,
}

impl Part<'_> {
    fn evaluate<M: Model>(self, model: &M, sampler: &Sampler<'_>, instructions: Instructions) -> Done {
        let Self { index, mut outputs, reasons: codes } = self;
        let mut columns: Vec<Lanes> = vec![[0.0; LANES]; sampler.inputs()];
        let mut answers: Vec<Lanes> = vec![[0.0; LANES]; outputs.len()];
        let mut reasons = [SUCCEEDED; LANES];
        let mut failures = Failures::new();
        let blocks = index * (SPAN / LANES) as u64..;
        for ((start, codes), block) in (0..).step_by(LANES).zip(codes.chunks_mut(LANES)).zip(blocks) {
            sampler.fill(block, &mut columns);
            evaluate(instructions, model, &columns, &mut answers, &mut reasons);
            let all_succeeded = reasons == [SUCCEEDED; LANES];
            for (answer, output) in answers.iter().zip(&mut outputs) {
                if all_succeeded && let Some((places, _)) = output[start..].split_first_chunk_mut() {
                    *places = *answer;
                    continue;
                }
                for ((place, value), reason) in output[start..].iter_mut().zip(answer).zip(&reasons) {
                    *place = if *reason == SUCCEEDED { *value } else { f64::NAN };
                }
            }
            codes.copy_from_slice(&reasons[..codes.len()]);
            count_failures(&mut failures, codes);
        }
        Done { samples: codes.len(), failures }
    }
}
