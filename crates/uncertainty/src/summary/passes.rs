//! A summary by passes over a column that comes in chunks.

use fearless_simd::dispatch;

use super::order::Order;
pub(crate) use super::order::Size;
use super::sums::{Moments, SPAN, Spread, Summed};
use super::{Below, Errors, PROBABILITIES, Place, QUANTILES, Summary, tail_is_populated};
use crate::limits::REPLICATES;
use crate::points::SamplingMethod;
use crate::run::Instructions;
use crate::sampler::Settings;

impl Size {
    /// For a column that is in memory: few cells stay in the nearest cache.
    pub(crate) const AT_ONCE: Self = Self { cells: 1 << 11, most: usize::MAX };
    /// For a column that is drawn again in each pass: so many that hardly a cell is cut again.
    pub(crate) const IN_CHUNKS: Self = Self { cells: 1 << 16, most: 1 << 14 };
}

/// Samples of a column that follow each other, a whole number of points of all replicates but at its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chunk<'a> {
    /// NaN for those without an answer.
    pub(crate) all: &'a [f64],
    /// The others.
    pub(crate) answered: &'a [f64],
}

/// The passes over a column from which its [`Summary`] follows, in each of which it has to come whole and in
/// the same order. However it is cut into chunks, the summary has the same bits.
#[derive(Debug)]
pub(crate) struct Passes {
    is_replicated: bool,
    instructions: Instructions,
    order: Order,
    stage: Stage,
    places: Option<Box<[Place; QUANTILES]>>,
    quantiles: [f64; QUANTILES],
    /// Of all samples, and of those of each replicate.
    moments: Option<(Moments, Vec<Moments>)>,
    summary: Option<Summary>,
    /// The histograms that are wanted, and these.
    classes: &'static [Classes],
    histograms: Vec<Histogram>,
}

/// What the next pass is for.
#[derive(Debug)]
enum Stage {
    Sums(Summed, Vec<Summed>),
    Powers(Spread, Vec<Spread>),
    /// Some order statistics are still to be found.
    Quantiles,
    Below(Box<Below>),
    Distances(Box<[[Place; 2]; QUANTILES]>),
    Done,
}

impl Passes {
    pub(crate) fn new(settings: &Settings, size: Size, classes: &'static [Classes]) -> Self {
        let Settings { method, instructions, .. } = *settings;
        let is_replicated = method != SamplingMethod::MonteCarlo;
        let replicates = if is_replicated { REPLICATES } else { 0 };
        Self {
            is_replicated,
            instructions,
            order: Order::new(size),
            stage: Stage::Sums(Summed::new(), vec![Summed::new(); replicates]),
            places: None,
            quantiles: [f64::NAN; QUANTILES],
            moments: None,
            summary: None,
            classes,
            histograms: Vec::new(),
        }
    }

    /// The passes after the first, of which this is known; by Monte Carlo, without histograms.
    pub(super) fn after_the_first(settings: &Settings, order: Order, summed: Summed) -> Self {
        let stage = Stage::Sums(summed, Vec::new());
        let mut passes = Self { order, stage, ..Self::new(settings, Size::AT_ONCE, &[]) };
        passes.go_on();
        passes
    }

    /// How many passes there are, where no cell has to be cut again.
    pub(crate) const USUAL: usize = 3;

    /// The samples that follow.
    pub(crate) fn add(&mut self, chunk: Chunk<'_>) {
        dispatch!(self.instructions.level(), _simd => self.add_in_pieces(chunk));
    }

    /// Piece by piece, so that what one loop has read is still in the caches when the next one reads it.
    /// Where samples failed, the pieces of both columns begin at different samples: that changes no result.
    #[inline(always)]
    fn add_in_pieces(&mut self, Chunk { all, answered }: Chunk<'_>) {
        let size = if self.is_replicated { SPAN * REPLICATES } else { SPAN };
        let mut answered = answered.chunks(size);
        for all in all.chunks(size) {
            self.add_with(Chunk { all, answered: answered.next().unwrap_or_default() });
        }
    }

    #[inline(always)]
    fn add_with(&mut self, Chunk { all, answered }: Chunk<'_>) {
        match &mut self.stage {
            Stage::Sums(summed, replicates) => {
                self.order.count(answered);
                summed.add(answered);
                if self.is_replicated {
                    Summed::add_dealt(replicates, all);
                }
            }
            Stage::Powers(spread, replicates) => {
                self.order.take(answered);
                spread.add(answered);
                if self.is_replicated {
                    Spread::add_dealt(replicates, all);
                }
            }
            Stage::Quantiles | Stage::Distances(_) => self.order.take(answered),
            Stage::Below(below) => {
                if self.is_replicated {
                    below.add(all);
                }
                for histogram in &mut self.histograms {
                    histogram.add(answered);
                }
            }
            Stage::Done => {}
        }
    }

    /// Ends a pass, and tells whether another one is wanted.
    pub(crate) fn go_on(&mut self) -> bool {
        self.stage = match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::Sums(summed, _) if summed.count() < 2 => Stage::Done,
            Stage::Sums(summed, replicates) => {
                let places = PROBABILITIES.map(|probability| Place::of(probability, summed.count()));
                let wanted = places.iter().flat_map(Place::wanted);
                if self.is_replicated {
                    let near = PROBABILITIES.map(|probability| near(probability, summed.count()));
                    self.order.seek(wanted.chain(near.into_iter().flatten()));
                } else {
                    self.order.seek(wanted);
                }
                self.places = Some(Box::new(places));
                Stage::Powers(summed.spread(), replicates.iter().map(Summed::spread).collect())
            }
            Stage::Powers(spread, replicates) => {
                let of_replicates = replicates.iter().map(Spread::moments);
                let of_replicates = of_replicates.filter(|moments| moments.count >= 2).collect();
                self.moments = Some((spread.moments(), of_replicates));
                self.after_quantiles()
            }
            Stage::Quantiles => self.after_quantiles(),
            Stage::Below(below) => match &self.moments {
                Some((moments, replicates)) if replicates.len() == REPLICATES => {
                    let ends = Box::new(below.ends(moments.count));
                    if self.order.seek(ends.iter().flatten().flat_map(Place::wanted)) {
                        self.after_distances(&ends)
                    } else {
                        Stage::Distances(ends)
                    }
                }
                _ if self.is_replicated => self.done([None; QUANTILES]),
                _ => Stage::Done,
            },
            Stage::Distances(ends) if self.order.settle() => self.after_distances(&ends),
            unsettled @ Stage::Distances(_) => unsettled,
            Stage::Done => Stage::Done,
        };
        !self.are_done()
    }

    fn after_quantiles(&mut self) -> Stage {
        if !self.order.settle() {
            return Stage::Quantiles;
        }
        let Some(places) = self.places.take() else { return Stage::Done };
        self.quantiles = places.each_ref().map(|place| place.value(&self.order));
        let [.., low, high] = self.quantiles;
        self.histograms =
            self.classes.iter().filter_map(|&classes| Histogram::new([low, high], classes)).collect();
        let of_replicates = self.moments.as_ref().map_or(0, |(_, replicates)| replicates.len());
        if !self.is_replicated {
            self.done(places.each_ref().map(|place| place.half_distance(&self.order)));
        }
        if of_replicates == REPLICATES || !self.histograms.is_empty() {
            Stage::Below(Box::new(Below::new(self.quantiles)))
        } else if self.is_replicated {
            self.done([None; QUANTILES])
        } else {
            Stage::Done
        }
    }

    fn after_distances(&mut self, ends: &[[Place; 2]; QUANTILES]) -> Stage {
        let distance =
            |[before, after]: &[Place; 2]| 0.5 * (after.value(&self.order) - before.value(&self.order));
        let found = ends.each_ref().map(distance);
        let count = self.moments.as_ref().map_or(0, |(moments, _)| moments.count);
        let populated = PROBABILITIES.map(|probability| tail_is_populated(probability, count));
        self.done(std::array::from_fn(|place| populated[place].then_some(found[place])))
    }

    /// With the standard errors of the quantiles, the summary is known.
    fn done(&mut self, errors: [Option<f64>; QUANTILES]) -> Stage {
        if let Some((moments, replicates)) = &self.moments {
            let errors = if self.is_replicated {
                Errors::by_replicates(replicates, errors)
            } else {
                Errors::by_formula(moments, errors)
            };
            self.summary = Some(Summary::new(moments, &self.quantiles, &errors));
        }
        Stage::Done
    }

    /// Whether no pass is wanted any more.
    pub(crate) fn are_done(&self) -> bool {
        matches!(self.stage, Stage::Done)
    }

    /// `None` where fewer than two samples have an answer, and before the last pass.
    pub(crate) fn summary(&self) -> Option<Summary> {
        self.summary
    }

    pub(crate) fn histograms(self) -> Vec<Histogram> {
        self.histograms
    }
}

/// Places beside a quantile, so far that the ends of its standard error under stratified points lie between
/// them, and so near that they share its cells or the next ones: what is taken out there need not be sought.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the count")]
fn near(probability: f64, count: usize) -> [usize; 4] {
    let last = (count - 1) as f64;
    // √(np(1 − p)), that of independent points
    let deviation = (count as f64 * probability * (1.0 - probability)).sqrt();
    [-2.0, -1.0, 1.0, 2.0].map(|far: f64| (last * probability + far * deviation).clamp(0.0, last) as usize)
}

/// How many classes a [`Histogram`] has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Classes {
    /// 15, for a text.
    Coarse,
    /// 40, for a picture.
    Fine,
}

impl Classes {
    pub(crate) const ALL: [Self; 2] = [Self::Coarse, Self::Fine];

    /// Their number.
    #[must_use]
    pub fn count(self) -> u8 {
        match self {
            Self::Coarse => 15,
            Self::Fine => 40,
        }
    }
}

/// How many samples lie in each of some classes of the same width, which hold the middle 99 %.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// (unit of the output) lower end of the first class.
    pub low: f64,
    /// (unit of the output) width of a class.
    pub width: f64,
    /// Samples in each class. The upper end belongs to the last one.
    pub counts: Vec<usize>,
    /// Samples below the first and above the last class.
    pub outside: [usize; 2],
    high: f64,
    classes: Classes,
}

impl Histogram {
    /// Between these ends; `None` where they do not differ.
    fn new([low, high]: [f64; 2], classes: Classes) -> Option<Self> {
        let width = (high - low) / f64::from(classes.count());
        let is_wide = width.is_finite() && width > 0.0;
        let counts = || vec![0; usize::from(classes.count())];
        is_wide.then(|| Self { low, width, counts: counts(), outside: [0; 2], high, classes })
    }

    pub(crate) fn is_of(&self, classes: Classes) -> bool {
        self.classes == classes
    }

    /// Of a column in which NaN stands for samples that failed.
    pub(crate) fn of(column: &[f64], summary: &Summary, classes: Classes) -> Option<Self> {
        let [.., widest] = summary.intervals;
        let mut histogram = Self::new([widest.low.value, widest.high.value], classes)?;
        dispatch!(Instructions::best().level(), _simd => histogram.add(column));
        Some(histogram)
    }

    #[inline(always)]
    fn add(&mut self, values: &[f64]) {
        /// Values whose places are found together, by a loop of its own that is vectorised.
        const AHEAD: usize = 64;
        // Below the first class, each class, above the last one, and what is not a number. The counts of
        // neighbouring values stand apart, as a count that was just written is not ready yet.
        let classes = self.classes.count();
        let mut counts = [[0_usize; PLACES]; 4];
        for values in values.chunks(AHEAD) {
            let mut places = [0_u8; AHEAD];
            for (place, value) in places.iter_mut().zip(values) {
                *place = self.place(*value, classes);
            }
            for (number, place) in places[..values.len()].iter().enumerate() {
                counts[number % 4][usize::from(*place) % PLACES] += 1;
            }
        }
        let [below, of_classes @ ..] = counts
            .into_iter()
            .fold([0; PLACES], |sums, counts| std::array::from_fn(|place| sums[place] + counts[place]));
        self.outside[0] += below;
        self.outside[1] += of_classes[usize::from(classes)];
        for (count, more) in self.counts.iter_mut().zip(of_classes) {
            *count += more;
        }
    }

    /// 0 below the first class, from 1 on the classes, and after them what lies above, and what is not a
    /// number.
    #[inline(always)]
    fn place(&self, value: f64, classes: u8) -> u8 {
        let class = (value - self.low) / self.width;
        let last = f64::from(classes - 1);
        let class = if class < last { class } else { last };
        let class = if class > 0.0 { class } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "one of the classes")]
        let class = class as u8;
        let place = if value < self.low { 0 } else { class + 1 };
        let place = if value > self.high { classes + 1 } else { place };
        if value.is_nan() { classes + 2 } else { place }
    }
}

/// More than the classes and three.
const PLACES: usize = 64;

#[cfg(test)]
mod tests {
    use super::{Classes, Histogram};
    use crate::random::{bits, unit};

    /// Values at the ends of the classes and right beside them, beyond the ends, and not a number: beside a
    /// search for the class one by one.
    #[test]
    fn every_value_is_in_its_class() {
        for classes in Classes::ALL {
            let ends =
                (0..=classes.count()).map(|end| 1.0 + f64::from(end) * (2.0 / f64::from(classes.count())));
            let mut values: Vec<f64> = ends.flat_map(|end| [end.next_down(), end, end.next_up()]).collect();
            values.extend((0..1000).map(|index| 4.0 * unit(bits(1, index))));
            values.extend([f64::NAN, -1e300, 1e300]);
            let mut histogram = Histogram::new([1.0, 3.0], classes).unwrap();
            histogram.add(&values);

            let class =
                |value: f64| ((value - 1.0) / histogram.width).floor().min(f64::from(classes.count() - 1));
            for (number, count) in (0_u8..).zip(&histogram.counts) {
                let is_in =
                    |value: &&f64| (1.0..=3.0).contains(*value) && class(**value) == f64::from(number);
                assert_eq!(values.iter().filter(is_in).count(), *count, "class {number}");
            }
            let below = values.iter().filter(|value| **value < 1.0).count();
            let above = values.iter().filter(|value| **value > 3.0).count();
            assert_eq!(histogram.outside, [below, above]);
        }
    }
}
