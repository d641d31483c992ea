//! Turns samples of the inputs into samples of the outputs.

use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

use crate::columns::Columns;
use crate::distribution::Distribution;
use crate::error::InvalidRequest;
use crate::limits::REPLICATES;
use crate::model::{Failures, LANES, Lanes, Model, SUCCEEDED, count_failures, tally};
use crate::points::SamplingMethod;
use crate::run::{Progress, Span, for_each, in_order};
use crate::sampler::{Sampler, Settings};
use crate::summary::{
    Caution, Classes, Histogram, Passes, Powers, Room, SPAN, Store, Summary, Watch, Watched, Watching,
};

/// The result of a propagation.
#[derive(Clone, Debug)]
pub struct Propagation {
    /// All samples of the first outputs, so many as are kept.
    columns: Columns,
    /// The first samples of all outputs that are summarised.
    first: Columns,
    reasons: Vec<u8>,
    totals: Totals,
    summaries: Vec<Option<Summary>>,
    /// Of each output of which there may be histograms, but whose samples are not kept.
    histograms: Vec<Vec<Histogram>>,
    classes: &'static [Classes],
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
        let kept = if self.columns.count() == self.first.count() { &self.columns } else { &self.first };
        kept.iter().collect()
    }

    /// Statistics of each output that is [summarised](Model::summarised); `None` where fewer than two samples
    /// have an answer.
    #[must_use]
    pub fn summaries(&self) -> &[Option<Summary>] {
        &self.summaries
    }

    /// The histogram of an output, over all samples. `None` where its middle 99 % do not differ, where fewer
    /// than two samples have an answer, where there is no such output, and where it is none of
    /// [`Settings::columns`] and [`Settings::classes`].
    #[must_use]
    pub fn histogram(&self, output: usize, classes: Classes) -> Option<Histogram> {
        if let Some(column) = self.columns.get(output).filter(|_| self.classes.contains(&classes)) {
            let summary = (*self.summaries.get(output)?)?;
            return Histogram::of(column, &summary, classes);
        }
        self.histograms.get(output)?.iter().find(|histogram| histogram.is_of(classes)).cloned()
    }
}

/// Evaluates the model for samples of its inputs.
///
/// Where [`Settings::keep`] leaves no place for all samples of [`Settings::columns`], these are drawn and
/// evaluated a second time for their histograms; the results are the same to the bit.
///
/// `progress` receives the number of finished samples and may end the run early; the result then holds the
/// first samples of the whole run. Where they are drawn twice, each time counts for a half, and only the
/// first can be ended.
///
/// # Errors
/// If there are no inputs or too many, or if the number of samples is out of range.
pub fn propagate<M: Model>(
    model: &M,
    inputs: &[Distribution],
    settings: &Settings,
    progress: &mut Progress<'_>,
) -> Result<Propagation, InvalidRequest> {
    propagate_by(model, inputs, settings, progress, &Limits::USUAL)
}

/// How a run is cut, and how much is taken out of its columns.
#[derive(Clone, Copy, Debug)]
struct Limits {
    /// The most spans after which what was found in them is added up.
    group: usize,
    /// The values of all outputs that are in memory at once where they are drawn again, but one span at
    /// least.
    again: usize,
    caution: Caution,
    /// The most values that a further pass takes out at once.
    most: usize,
}

impl Limits {
    const USUAL: Self = Self { group: 1 << 9, again: 1 << 22, caution: Caution::USUAL, most: 1 << 14 };
}

fn propagate_by<M: Model>(
    model: &M,
    inputs: &[Distribution],
    settings: &Settings,
    progress: &mut Progress<'_>,
    limits: &Limits,
) -> Result<Propagation, InvalidRequest> {
    let sampler = Sampler::new(inputs, settings)?;
    let outputs = model.summarised().min(model.outputs());
    let shown = settings.columns.min(outputs);
    let is_room = settings.samples.saturating_mul(shown) <= settings.keep;
    let kept = if is_room { shown } else { 0 };
    Ok(Run { model, sampler, settings, limits, outputs, shown, kept }.propagation(progress))
}

/// A model with the inputs of its samples.
struct Run<'a, M> {
    model: &'a M,
    sampler: Sampler<'a>,
    settings: &'a Settings,
    limits: &'a Limits,
    /// Those that are summarised; of them, those of which there may be histograms, and those that are kept.
    outputs: usize,
    shown: usize,
    kept: usize,
}

/// Samples of the first span that a thread takes at a time.
const SMALL: usize = SPAN / 8;

/// What a run has before its first span, and what it finds.
struct Begun<'m> {
    first: Samples,
    watches: Vec<Watch<'m>>,
    totals: Totals,
    powers: Vec<Powers>,
}

impl<M: Model> Run<'_, M> {
    fn propagation(&self, progress: &mut Progress<'_>) -> Propagation {
        let requested = self.settings.samples;
        let is_drawn_again = self.kept < self.shown && !self.settings.classes.is_empty();
        // More passes than usual do not turn the count back.
        let mut most = 0;
        let mut told = |pass: usize, done: usize| {
            let done = if is_drawn_again { (pass * requested + done) / 2 } else { done };
            most = most.max(done.min(requested));
            progress(most, requested)
        };
        let mut columns = Columns::new(self.kept, requested);
        let is_kept = self.kept == self.outputs;
        let mut reasons = vec![SUCCEEDED; if is_kept { requested } else { 0 }];
        if told(0, 0).is_break() {
            return self.nothing();
        }
        let mut store = Store::new(self.outputs, requested, self.is_replicated());
        let mut begun = self.begin(Arc::new(store.room()));
        for (column, begin) in columns.iter_mut().zip(begun.first.columns.iter()) {
            column[..begin.len()].copy_from_slice(begin);
        }
        if is_kept {
            reasons[..begun.first.reasons.len()].copy_from_slice(&begun.first.reasons);
        }
        let workers = self.go_on(&mut columns, &mut reasons, &mut begun, &mut |done| told(0, done));
        let Begun { first, watches, totals, powers } = begun;
        columns.truncate(totals.samples);
        reasons.truncate(totals.samples);

        let mut passes = self.passes(watches, workers, &powers);
        for (passes, column) in passes.iter_mut().zip(columns.iter()) {
            while !passes.are_done() {
                passes.add(column);
                passes.go_on();
            }
        }
        let histograms = self.draw_again(&mut passes, totals.samples, &mut |done| told(1, done));
        let summaries = passes.iter().map(Passes::summary).collect();
        let Samples { columns: first, reasons: first_reasons } = first;
        let reasons = if is_kept { reasons } else { first_reasons };
        let classes = self.settings.classes;
        Propagation { columns, first, reasons, totals, summaries, histograms, classes, requested }
    }

    fn is_replicated(&self) -> bool {
        self.settings.method != SamplingMethod::MonteCarlo
    }

    /// Without a sample.
    fn nothing(&self) -> Propagation {
        Propagation {
            columns: Columns::new(0, 0),
            first: Columns::new(self.outputs, 0),
            reasons: Vec::new(),
            totals: Totals::of(self.model),
            summaries: vec![None; self.outputs],
            histograms: Vec::new(),
            classes: self.settings.classes,
            requested: self.settings.samples,
        }
    }

    /// The first span, which tells how its columns are watched. It is cut small, as nobody can go on before
    /// it is done.
    fn begin<'m>(&self, room: Arc<Room<'m>>) -> Begun<'m> {
        let planned = self.settings.samples;
        let mut first = Samples::new(self.outputs, SPAN.min(planned));
        let count = first.reasons.len();
        let totals = self.evaluate(0, &mut first, (count, SMALL), &mut |_, _| ControlFlow::Continue(()));
        let Limits { caution, .. } = *self.limits;
        let watching = Watching { planned, instructions: self.settings.instructions, caution, room };
        let watched = for_each(first.columns.iter(), |column| {
            let mut watch = Watch::new(column, watching.clone());
            let powers = watch.add(column);
            (watch, powers)
        });
        let (watches, powers): (Vec<_>, Vec<_>) = watched.into_iter().unzip();
        let powers = self.powers(powers.into_iter());
        Begun { first, watches, totals, powers }
    }

    /// How many a column has: one of all samples, or one of each replicate.
    fn powers_of_column(&self) -> usize {
        if self.is_replicated() { REPLICATES } else { 1 }
    }

    /// What a span adds to the powers of each column.
    fn powers(&self, of_columns: impl Iterator<Item = [Powers; REPLICATES]>) -> Vec<Powers> {
        let mut powers = Vec::with_capacity(self.powers_of_column() * self.outputs);
        for of_replicates in of_columns {
            if self.is_replicated() {
                powers.extend(of_replicates);
            } else {
                powers.push(Powers::of_all(&of_replicates));
            }
        }
        powers
    }

    /// All spans but the first one, in groups, and who has watched them. After each group windows are
    /// narrowed: at first that saves more than it costs only now and then, and later it keeps memory small.
    fn go_on<'m>(
        &self,
        columns: &mut Columns,
        reasons: &mut [u8],
        Begun { watches, totals, powers, .. }: &mut Begun<'m>,
        told: &mut (dyn FnMut(usize) -> ControlFlow<()> + Send),
    ) -> Vec<Worker<'m>> {
        let requested = self.settings.samples;
        let mut slices: Vec<_> = columns.iter_mut().map(|column| column.chunks_mut(SPAN).skip(1)).collect();
        let mut codes = reasons.chunks_mut(SPAN).skip(1);
        let mut spans = (1..).zip((SPAN..requested).step_by(SPAN)).map(|(index, start)| {
            let outputs = slices.iter_mut().filter_map(Iterator::next).collect();
            let samples = SPAN.min(requested - start);
            Span { samples, work: Kept { index, samples, outputs, reasons: codes.next() } }
        });
        let waiting = Mutex::new(Vec::<Worker<'_>>::new());
        let lock = || waiting.lock().unwrap_or_else(PoisonError::into_inner);
        let mut spans_done = 1;
        loop {
            let group: Vec<_> = spans.by_ref().take((4 * spans_done).min(self.limits.group)).collect();
            let (count, begin) = (group.len(), totals.samples);
            let work = |span| {
                let own = lock().pop();
                let mut worker = own.unwrap_or_else(|| Worker::new(self.model, &self.sampler, watches));
                let found = self.watch(span, &mut worker);
                lock().push(worker);
                found
            };
            let done = in_order(group, work, &mut |done, _| told(begin + done));
            let is_ended = done.len() < count;
            spans_done += count;
            for (more, of_span) in done {
                totals.add(more);
                for (powers, more) in powers.iter_mut().zip(of_span) {
                    powers.add(&more);
                }
            }
            if is_ended || totals.samples == requested {
                break;
            }
            let mut workers = lock();
            let mut of_workers: Vec<_> = workers.iter_mut().map(|worker| worker.watches.iter_mut()).collect();
            let columns = watches.iter_mut().map(|watch| {
                let others: Vec<&mut Watch<'_>> = of_workers.iter_mut().filter_map(Iterator::next).collect();
                (watch, others)
            });
            for_each(columns, |(watch, others)| watch.narrow(others));
        }
        waiting.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// A span, and what it adds.
    fn watch(&self, span: Kept<'_>, worker: &mut Worker<'_>) -> (Totals, Vec<Powers>) {
        let Kept { index, samples, outputs, reasons } = span;
        let Worker { block, reasons: own, watches } = worker;
        let reasons = reasons.unwrap_or(&mut own[..samples]);
        let part = Part { first_block: index * (SPAN / LANES) as u64, outputs, watches, reasons };
        let totals = part.evaluate(self.model, &self.sampler, block);
        (totals, self.powers(watches.iter_mut().map(Watch::end_span)))
    }

    /// What has been watched of each column.
    fn passes<'m>(
        &self,
        watches: Vec<Watch<'m>>,
        workers: Vec<Worker<'m>>,
        powers: &[Powers],
    ) -> Vec<Passes<'m>> {
        let mut of_workers: Vec<_> = workers.into_iter().map(|worker| worker.watches.into_iter()).collect();
        let of_each = powers.chunks(self.powers_of_column());
        let columns = watches.into_iter().zip(of_each).map(|(watch, powers)| {
            let others: Vec<Watch<'_>> = of_workers.iter_mut().filter_map(Iterator::next).collect();
            (watch, others, powers)
        });
        for_each(columns, |(watch, others, powers)| {
            Passes::new(Watched::by(watch, others), powers, self.limits.most)
        })
    }

    /// Draws the samples again as often as the summaries of columns that are not kept take it, and once for
    /// their histograms.
    fn draw_again(
        &self,
        passes: &mut [Passes<'_>],
        evaluated: usize,
        told: &mut (dyn FnMut(usize) -> ControlFlow<()> + Send),
    ) -> Vec<Vec<Histogram>> {
        while passes.iter().any(|passes| !passes.are_done()) {
            self.pass(evaluated, passes, told, |passes, column| passes.add(column));
            for passes in &mut *passes {
                passes.go_on();
            }
        }
        let shown = if self.kept < self.shown { self.shown } else { 0 };
        let summaries = passes.iter().take(shown).map(Passes::summary);
        let mut histograms: Vec<_> = summaries.map(|summary| self.histograms_of(summary)).collect();
        if histograms.iter().any(|histograms| !histograms.is_empty()) {
            self.pass(evaluated, &mut histograms, told, |histograms, column| {
                for histogram in histograms {
                    histogram.add(self.settings.instructions, column);
                }
            });
        }
        histograms
    }

    /// Of a summary, before the samples are counted.
    fn histograms_of(&self, summary: Option<Summary>) -> Vec<Histogram> {
        let classes = self.settings.classes.iter();
        let of =
            |summary: Summary| classes.filter_map(|classes| Histogram::new(&summary, *classes)).collect();
        summary.map_or_else(Vec::new, of)
    }

    /// Draws the samples again, and shows the column of each of the first outputs to what is there for it.
    fn pass<T: Send>(
        &self,
        evaluated: usize,
        of_outputs: &mut [T],
        told: &mut (dyn FnMut(usize) -> ControlFlow<()> + Send),
        add: impl Fn(&mut T, &[f64]) + Sync,
    ) {
        let chunk = (self.limits.again / self.outputs / SPAN * SPAN).max(SPAN);
        let mut samples = Samples::new(self.outputs, chunk.min(evaluated));
        for begin in (0..evaluated).step_by(chunk) {
            let count = chunk.min(evaluated - begin);
            // What is begun is finished: its summary would be lost.
            self.evaluate(begin, &mut samples, (count, SPAN), &mut |done, _| {
                let _ = told(begin + done);
                ControlFlow::Continue(())
            });
            let columns = of_outputs.iter_mut().zip(samples.columns.iter());
            for_each(columns, |(of_output, column)| add(of_output, &column[..count]));
        }
    }

    /// Evaluates `count` samples from `begin` on, so many at a time, which are whole blocks.
    fn evaluate(
        &self,
        begin: usize,
        samples: &mut Samples,
        (count, at_once): (usize, usize),
        progress: &mut Progress<'_>,
    ) -> Totals {
        let Samples { columns, reasons } = samples;
        let mut slices: Vec<_> =
            columns.iter_mut().map(|column| column[..count].chunks_mut(at_once)).collect();
        let parts = (begin / LANES..).step_by(at_once / LANES).zip(reasons[..count].chunks_mut(at_once));
        let parts = parts.map(|(first_block, reasons)| {
            let outputs = slices.iter_mut().flat_map(Iterator::next).collect();
            let samples = reasons.len();
            let part = Part { first_block: first_block as u64, outputs, watches: &mut [], reasons };
            Span { samples, work: part }
        });
        let work = |part: Part<'_, '_, '_>| {
            part.evaluate(self.model, &self.sampler, &mut Block::new(self.model, &self.sampler))
        };
        let mut totals = Totals::of(self.model);
        for more in in_order(parts.collect(), work, progress) {
            totals.add(more);
        }
        totals
    }
}

/// The samples of some outputs.
struct Samples {
    columns: Columns,
    reasons: Vec<u8>,
}

impl Samples {
    fn new(outputs: usize, samples: usize) -> Self {
        Self { columns: Columns::new(outputs, samples), reasons: vec![SUCCEEDED; samples] }
    }
}

/// What one thread has while it does its spans.
struct Worker<'m> {
    block: Block,
    /// Those of a span that are not kept.
    reasons: Vec<u8>,
    /// What it has seen of each column.
    watches: Vec<Watch<'m>>,
}

impl<'m> Worker<'m> {
    fn new(model: &impl Model, sampler: &Sampler<'_>, watches: &[Watch<'m>]) -> Self {
        let watches = watches.iter().map(Watch::unwatched).collect();
        Self { block: Block::new(model, sampler), reasons: vec![SUCCEEDED; SPAN], watches }
    }
}

/// A block of samples.
struct Block {
    inputs: Vec<Lanes>,
    answers: Vec<Lanes>,
}

impl Block {
    fn new<M: Model>(model: &M, sampler: &Sampler<'_>) -> Self {
        let (inputs, answers) = (sampler.inputs(), model.outputs());
        Self { inputs: vec![Lanes::ZERO; inputs], answers: vec![Lanes::ZERO; answers] }
    }
}

/// What is kept of a span, of so many samples.
struct Kept<'c> {
    index: u64,
    samples: usize,
    outputs: Vec<&'c mut [f64]>,
    reasons: Option<&'c mut [u8]>,
}

/// Where the results of some blocks go.
struct Part<'a, 'c, 'm> {
    first_block: u64,
    /// Those that are kept.
    outputs: Vec<&'c mut [f64]>,
    /// Of all that are summarised, unless that is not done.
    watches: &'a mut [Watch<'m>],
    reasons: &'a mut [u8],
}

/// What is counted of samples that are done.
#[derive(Clone, Debug)]
struct Totals {
    samples: usize,
    failures: Failures,
    tallies: Vec<usize>,
}

impl Totals {
    /// Of no sample.
    fn of(model: &impl Model) -> Self {
        Self { samples: 0, failures: Failures::new(), tallies: vec![0; model.tallies()] }
    }

    fn add(&mut self, more: Self) {
        self.samples += more.samples;
        for (reason, count) in more.failures {
            *self.failures.entry(reason).or_default() += count;
        }
        for (tally, more) in self.tallies.iter_mut().zip(more.tallies) {
            *tally += more;
        }
    }
}

impl Part<'_, '_, '_> {
    fn evaluate<M: Model>(self, model: &M, sampler: &Sampler<'_>, block: &mut Block) -> Totals {
        let Self { first_block, mut outputs, watches, reasons: codes } = self;
        let Block { inputs, answers } = block;
        let mut reasons = [SUCCEEDED; LANES];
        let mut totals = Totals::of(model);
        for ((start, codes), block) in (0..).step_by(LANES).zip(codes.chunks_mut(LANES)).zip(first_block..) {
            sampler.evaluate(model, block, inputs, answers, &mut reasons);
            let count = codes.len();
            for answer in answers.iter_mut() {
                answer[count..].fill(f64::NAN);
            }
            for (answer, output) in answers.iter().zip(&mut outputs) {
                output[start..][..count].copy_from_slice(&answer[..count]);
            }
            Watch::add_blocks(watches, answers);
            codes.copy_from_slice(&reasons[..count]);
            count_failures(&mut totals.failures, codes);
            tally(sampler.instructions(), model, [inputs, answers], codes, &mut totals.tallies);
        }
        totals.samples = codes.len();
        totals
    }
}

#[cfg(test)]
mod tests;
