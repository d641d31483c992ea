//! Turns samples of the inputs into samples of the outputs.

use std::ops::ControlFlow;

use crate::columns::Columns;
use crate::distribution::Distribution;
use crate::error::InvalidRequest;
use crate::model::{Failures, LANES, Lanes, Model, SUCCEEDED, count_failures, tally};
use crate::points::SamplingMethod;
use crate::run::{Progress, Span, in_order};
use crate::sampler::{Sampler, Settings};
use crate::summary::{Chunk, Classes, First, Histogram, Passes, SPAN, Size, Summary, without_nan};

/// The result of a propagation.
#[derive(Clone, Debug)]
pub struct Propagation {
    columns: Columns,
    reasons: Vec<u8>,
    totals: Totals,
    summaries: Vec<Option<Summary>>,
    /// Of each output, where not all samples are kept.
    histograms: Vec<Vec<Histogram>>,
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
        self.totals.samples
    }

    /// Number of samples that have an answer. Only these are summarised.
    #[must_use]
    pub fn succeeded(&self) -> usize {
        self.evaluated() - self.failures().values().sum::<usize>()
    }

    /// Number of samples without an answer, by the model's reason code, or [`crate::NOT_FINITE`].
    #[must_use]
    pub fn failures(&self) -> &Failures {
        &self.totals.failures
    }

    /// What the model [counted](Model::tally).
    #[must_use]
    pub fn tallies(&self) -> &[usize] {
        &self.totals.tallies
    }

    /// Whether all samples that were evaluated are kept. If not, [`columns`](Self::columns) and
    /// [`reasons`](Self::reasons) hold some thousand samples, the first ones.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        self.reasons.len() == self.evaluated()
    }

    /// Reason code of each sample that is kept; [`SUCCEEDED`] where it has an answer.
    #[must_use]
    pub fn reasons(&self) -> &[u8] {
        &self.reasons
    }

    /// The samples of each output that is [summarised](Model::summarised), NaN where the sample failed: those
    /// that are kept.
    #[must_use]
    pub fn columns(&self) -> Vec<&[f64]> {
        self.columns.iter().collect()
    }

    /// Statistics of each output that is [summarised](Model::summarised); `None` where fewer than two samples
    /// have an answer.
    #[must_use]
    pub fn summaries(&self) -> &[Option<Summary>] {
        &self.summaries
    }

    /// The histogram of an output, over all samples. `None` where its middle 99 % do not differ, where fewer
    /// than two samples have an answer, and where there is no such output.
    #[must_use]
    pub fn histogram(&self, output: usize, classes: Classes) -> Option<Histogram> {
        if self.is_kept() {
            let summary = (*self.summaries.get(output)?)?;
            return Histogram::of(self.columns.get(output)?, &summary, classes);
        }
        self.histograms.get(output)?.iter().find(|histogram| histogram.is_of(classes)).cloned()
    }
}

/// Evaluates the model for samples of its inputs.
///
/// Where [`Settings::keep`] leaves no place for all samples, they are drawn and evaluated again in each of
/// three passes; the results are the same to the bit.
///
/// `progress` receives the number of finished samples and may end the run early; the result then holds the
/// first samples of the whole run. Where there are several passes, each counts for its share, and only the
/// first can be ended: the others then go over what it has done.
///
/// # Errors
/// If there are no inputs or too many, or if the number of samples is out of range.
pub fn propagate<M: Model>(
    model: &M,
    inputs: &[Distribution],
    settings: &Settings,
    progress: &mut Progress<'_>,
) -> Result<Propagation, InvalidRequest> {
    propagate_by(model, inputs, settings, progress, &Chunks { values: 1 << 22, size: Size::IN_CHUNKS })
}

/// How a run that is not kept is cut.
#[derive(Clone, Copy, Debug)]
struct Chunks {
    /// The values of all outputs that are in memory at once, but one span at least.
    values: usize,
    size: Size,
}

fn propagate_by<M: Model>(
    model: &M,
    inputs: &[Distribution],
    settings: &Settings,
    progress: &mut Progress<'_>,
    chunks: &Chunks,
) -> Result<Propagation, InvalidRequest> {
    let sampler = Sampler::new(inputs, settings)?;
    let outputs = model.summarised().min(model.outputs());
    let run = Run { model, sampler, settings, outputs };
    if settings.samples.saturating_mul(outputs) <= settings.keep {
        Ok(run.at_once(progress))
    } else {
        Ok(run.in_chunks(progress, chunks))
    }
}

/// A model with the inputs of its samples.
struct Run<'a, M> {
    model: &'a M,
    sampler: Sampler<'a>,
    settings: &'a Settings,
    /// Those that are kept and summarised.
    outputs: usize,
}

impl<M: Model> Run<'_, M> {
    fn at_once(&self, progress: &mut Progress<'_>) -> Propagation {
        let mut samples = Samples::new(self.outputs, self.settings.samples);
        // The sums of replicates do not follow from those of spans, nor do sums from which samples are left
        // out.
        let is_counted = self.settings.method == SamplingMethod::MonteCarlo
            && u32::try_from(self.settings.samples).is_ok();
        let first = is_counted.then(|| First::new(self.settings.instructions));
        let (totals, sums) = self.evaluate(0, &mut samples, self.settings.samples, first.as_ref(), progress);
        samples.truncate(totals.samples);
        let is_complete = totals.failures.is_empty();
        let mut begun = match first {
            Some(first) if is_complete => first.passes(self.settings, totals.samples, &sums),
            _ => Vec::new(),
        }
        .into_iter();
        let spans = samples.columns.iter().map(|column| {
            let passes = begun.next().unwrap_or_else(|| Passes::new(self.settings, Size::AT_ONCE, &[]));
            Span { samples: 0, work: (column, passes) }
        });
        let of = |(column, passes): (&[f64], Passes)| Summary::of(column, is_complete, passes);
        let summaries = in_order(spans.collect(), of, &mut |_, _| ControlFlow::Continue(()));
        let Samples { columns, reasons } = samples;
        let requested = self.settings.samples;
        Propagation { columns, reasons, totals, summaries, histograms: Vec::new(), requested }
    }

    fn in_chunks(&self, progress: &mut Progress<'_>, chunks: &Chunks) -> Propagation {
        let requested = self.settings.samples;
        let chunk = (chunks.values / self.outputs / SPAN * SPAN).max(SPAN);
        let mut samples = Samples::new(self.outputs, chunk.min(requested));
        let mut all: Vec<_> =
            (0..self.outputs).map(|_| Passes::new(self.settings, chunks.size, &Classes::ALL)).collect();
        let mut totals = Totals::default();
        let mut kept = Samples::new(self.outputs, 0);
        // More passes than usual do not turn the count back.
        let mut told = 0;
        for pass in 0_usize.. {
            let evaluated = if pass == 0 { requested } else { totals.samples };
            let mut begin = 0;
            while begin < evaluated {
                let count = chunk.min(evaluated - begin);
                let mut tell = |done: usize, _: usize| {
                    let of_all = pass.saturating_mul(evaluated).saturating_add(begin + done);
                    told = told.max((of_all / Passes::USUAL).min(evaluated));
                    let answer = progress(told, requested);
                    if pass == 0 { answer } else { ControlFlow::Continue(()) }
                };
                let (done, _) = self.evaluate(begin, &mut samples, count, None, &mut tell);
                samples.pass_on(&mut all, &done);
                let is_ended = done.samples < count;
                begin += done.samples;
                if pass == 0 {
                    if kept.reasons.is_empty() {
                        kept = samples.first(SPAN.min(done.samples));
                    }
                    totals.add(done);
                }
                if is_ended {
                    break;
                }
            }
            let mut goes_on = false;
            for passes in &mut all {
                goes_on |= passes.go_on();
            }
            if !goes_on {
                break;
            }
        }
        let summaries = all.iter().map(Passes::summary).collect();
        let histograms = all.into_iter().map(Passes::histograms).collect();
        let Samples { columns, reasons } = kept;
        Propagation { columns, reasons, totals, summaries, histograms, requested }
    }

    /// Evaluates `count` samples from `begin` on, which is the first of a span. Where `first` counts them,
    /// there are the sums of each span that is complete.
    fn evaluate(
        &self,
        begin: usize,
        samples: &mut Samples,
        count: usize,
        first: Option<&First>,
        progress: &mut Progress<'_>,
    ) -> (Totals, Vec<Vec<f64>>) {
        let Samples { columns, reasons } = samples;
        let mut slices: Vec<_> = columns.iter_mut().map(|column| column[..count].chunks_mut(SPAN)).collect();
        let spans = (begin / SPAN..)
            .zip(reasons[..count].chunks_mut(SPAN))
            .map(|(index, reasons)| {
                let outputs = slices.iter_mut().flat_map(Iterator::next).collect();
                Span { samples: reasons.len(), work: Part { index: index as u64, outputs, reasons } }
            })
            .collect();
        let work = |part: Part<'_>| part.evaluate(self.model, &self.sampler, first);
        let mut totals = Totals { tallies: vec![0; self.model.tallies()], ..Totals::default() };
        let mut all_sums = Vec::new();
        for (part, sums) in in_order(spans, work, progress) {
            totals.add(part);
            all_sums.push(sums);
        }
        (totals, all_sums)
    }
}

/// The samples of all outputs that are summarised.
struct Samples {
    columns: Columns,
    reasons: Vec<u8>,
}

impl Samples {
    fn new(outputs: usize, samples: usize) -> Self {
        Self { columns: Columns::new(outputs, samples), reasons: vec![SUCCEEDED; samples] }
    }

    fn truncate(&mut self, samples: usize) {
        self.columns.truncate(samples);
        self.reasons.truncate(samples);
    }

    fn first(&self, samples: usize) -> Self {
        let mut first = Self::new(self.columns.iter().count(), samples);
        for (own, column) in first.columns.iter_mut().zip(self.columns.iter()) {
            own.copy_from_slice(&column[..samples]);
        }
        first.reasons.copy_from_slice(&self.reasons[..samples]);
        first
    }

    /// To the passes of each output.
    fn pass_on(&self, all: &mut [Passes], done: &Totals) {
        let is_complete = done.failures.is_empty();
        let columns = self.columns.iter().zip(all);
        let spans = columns.map(|work| Span { samples: 0, work }).collect();
        let add = |(column, passes): (&[f64], &mut Passes)| {
            let all = &column[..done.samples];
            if is_complete {
                passes.add(Chunk { all, answered: all });
            } else {
                passes.add(Chunk { all, answered: &without_nan(all) });
            }
        };
        in_order(spans, add, &mut |_, _| ControlFlow::Continue(()));
    }
}

/// Where the results of a span go.
struct Part<'a> {
    index: u64,
    outputs: Vec<&'a mut [f64]>,
    reasons: &'a mut [u8],
}

/// What is counted of samples that are done.
#[derive(Clone, Debug, Default)]
struct Totals {
    samples: usize,
    failures: Failures,
    tallies: Vec<usize>,
}

impl Totals {
    fn add(&mut self, more: Self) {
        self.samples += more.samples;
        for (reason, count) in more.failures {
            *self.failures.entry(reason).or_default() += count;
        }
        self.tallies.resize(more.tallies.len(), 0);
        for (tally, more) in self.tallies.iter_mut().zip(more.tallies) {
            *tally += more;
        }
    }
}

impl Part<'_> {
    fn evaluate<M: Model>(
        self,
        model: &M,
        sampler: &Sampler<'_>,
        first: Option<&First>,
    ) -> (Totals, Vec<f64>) {
        let Self { index, mut outputs, reasons: codes } = self;
        let mut columns: Vec<Lanes> = vec![[0.0; LANES]; sampler.inputs()];
        let mut answers: Vec<Lanes> = vec![[0.0; LANES]; model.outputs()];
        let mut reasons = [SUCCEEDED; LANES];
        let mut failures = Failures::new();
        let mut tallies = vec![0; model.tallies()];
        let blocks = index * (SPAN / LANES) as u64..;
        for ((start, codes), block) in (0..).step_by(LANES).zip(codes.chunks_mut(LANES)).zip(blocks) {
            sampler.evaluate(model, block, &mut columns, &mut answers, &mut reasons);
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
            tally(sampler.instructions(), model, [&columns, &answers], codes, &mut tallies);
        }
        let first = first.filter(|_| failures.is_empty());
        let sums = first.map_or_else(Vec::new, |first| first.add(&outputs));
        (Totals { samples: codes.len(), failures, tallies }, sums)
    }
}

#[cfg(test)]
mod tests;
