//! Statistics of a column of samples, each with its standard error.
//!
//! # References
//!
//! R. J. Hyndman and Y. Fan, *Sample quantiles in statistical packages*, American Statistician 50 (1996):
//! quantiles are their type 7, as in NumPy. M. G. Kendall and A. Stuart, *The Advanced Theory of Statistics*,
//! volume 1, sections 10.5 and 14: standard errors of moments; order statistics.

use crate::limits::REPLICATES;
use crate::model::LANES;
use crate::points::SamplingMethod;

/// Levels of the intervals of a [`Summary`].
pub const LEVELS: [f64; 4] = [0.5, 0.9, 0.95, 0.99];

/// A standard error of a quantile needs as many samples expected beyond it.
const TAIL_SAMPLES: f64 = 5.0;

/// A statistic and how well the samples tell it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// (unit of the output) the statistic.
    pub value: f64,
    /// (unit of the output) its standard error from sampling; `None` where there are too few samples to tell.
    pub standard_error: Option<f64>,
}

/// The range between two quantiles, with equal shares beyond either end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Share of the samples in between.
    pub level: f64,
    /// (unit of the output) lower end.
    pub low: Estimate,
    /// (unit of the output) upper end.
    pub high: Estimate,
}

/// Statistics of one output.
///
/// Monte Carlo: the standard error of the mean is s/√n, that of s follows from the fourth moment, that of a
/// quantile from the order statistics one binomial standard deviation of the count to either side.
///
/// Latin hypercube and Sobol': the standard errors of the mean and of s follow from their spread between the
/// [`REPLICATES`] point sets, s/√16. That of a quantile is half of the distance between the order statistics
/// to either side of it, as for Monte Carlo, but as far away as the numbers of samples below the quantile,
/// which differ between the replicates, tell: by their standard error and one place more. The spread of the
/// replicates' own quantiles would not do: where one input rules the result, they keep to their strata, and
/// the quantile of all samples does not. With 15 degrees of freedom all these are themselves uncertain by a
/// fifth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Number of samples that succeeded.
    pub samples: usize,
    /// (unit of the output) arithmetic mean.
    pub mean: Estimate,
    /// (unit of the output) standard deviation, with n − 1.
    pub sd: Estimate,
    /// (unit of the output) median.
    pub median: Estimate,
    /// At each of [`LEVELS`].
    pub intervals: [Interval; LEVELS.len()],
}

/// The probabilities of the median and of the ends of the intervals, lower and upper in turn.
const PROBABILITIES: [f64; 1 + 2 * LEVELS.len()] = [0.5, 0.25, 0.75, 0.05, 0.95, 0.025, 0.975, 0.005, 0.995];

impl Summary {
    /// Of a column in which NaN stands for samples that failed; `None` where fewer than two succeeded.
    /// `is_complete` tells that there are none.
    pub(crate) fn of(column: &[f64], is_complete: bool, method: SamplingMethod) -> Option<Self> {
        let succeeded;
        let values = if is_complete {
            column
        } else {
            succeeded = without_nan(column.iter());
            &succeeded
        };
        if values.len() < 2 {
            return None;
        }
        let moments = Moments::of(values);
        let quantiles = Quantiles::of(values);
        let errors = match method {
            SamplingMethod::MonteCarlo => Errors::by_formula(&moments, &quantiles),
            SamplingMethod::LatinHypercube | SamplingMethod::Sobol => {
                Errors::by_replicates(column, values, &quantiles)
            }
        };

        let quantile = |place: usize| Estimate {
            value: quantiles.values[place],
            standard_error: errors.quantiles[place],
        };
        let interval = |place: usize| Interval {
            level: LEVELS[place],
            low: quantile(2 * place + 1),
            high: quantile(2 * place + 2),
        };
        Some(Self {
            samples: moments.count,
            mean: Estimate { value: moments.mean, standard_error: errors.mean },
            sd: Estimate { value: moments.sd(), standard_error: errors.sd },
            median: quantile(0),
            intervals: std::array::from_fn(interval),
        })
    }
}

fn without_nan<'a>(values: impl Iterator<Item = &'a f64>) -> Vec<f64> {
    values.copied().filter(|value| !value.is_nan()).collect()
}

/// Number, mean and sums of powers of the deviations from it.
struct Moments {
    count: usize,
    mean: f64,
    squares: f64,
    fourth_powers: f64,
}

impl Moments {
    fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let [sum] = sums(values, |x| [x]);
        let mean = sum / count;
        let [squares, fourth_powers] = sums(values, |x| {
            let square = (x - mean) * (x - mean);
            [square, square * square]
        });
        Self { count: values.len(), mean, squares, fourth_powers }
    }

    fn sd(&self) -> f64 {
        // s² = Σ(x − x̄)²/(n − 1)
        (self.squares / (self.count as f64 - 1.0)).sqrt()
    }
}

/// Σ f(x) in a fixed order, of sums over eight lanes and over spans, which keeps the rounding small.
fn sums<const N: usize>(values: &[f64], f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    const SPAN: usize = 64 * LANES;
    let mut totals = [0.0; N];
    for span in values.chunks(SPAN) {
        let mut lanes = [[0.0; 8]; N];
        let (blocks, rest) = span.as_chunks::<8>();
        for block in blocks {
            for (lane, &value) in block.iter().enumerate() {
                for (lanes, term) in lanes.iter_mut().zip(f(value)) {
                    lanes[lane] += term;
                }
            }
        }
        let mut of_rest = [0.0; N];
        for &value in rest {
            for (sum, term) in of_rest.iter_mut().zip(f(value)) {
                *sum += term;
            }
        }
        for ((total, lanes), rest) in totals.iter_mut().zip(lanes).zip(of_rest) {
            let lanes: f64 = lanes.into_iter().sum();
            *total += lanes + rest;
        }
    }
    totals
}

/// The quantiles at [`PROBABILITIES`], and the order statistics around them.
struct Quantiles {
    values: [f64; PROBABILITIES.len()],
    /// Half of the distance between the order statistics next to each, a binomial standard deviation of the
    /// count away.
    half_distances: [Option<f64>; PROBABILITIES.len()],
}

impl Quantiles {
    fn of(values: &[f64]) -> Self {
        let count = values.len();
        let places = PROBABILITIES.map(|probability| Place::of(probability, count));
        let found = Ordered::of(values, places.iter().flat_map(Place::wanted));
        Self {
            values: places.each_ref().map(|place| found.between(place)),
            half_distances: places
                .map(|place| place.around.map(|(before, after)| 0.5 * (found.at(after) - found.at(before)))),
        }
    }
}

/// Some of the values in their order.
struct Ordered {
    places: Vec<usize>,
    values: Vec<f64>,
}

impl Ordered {
    fn of(values: &[f64], wanted: impl Iterator<Item = usize>) -> Self {
        let mut places: Vec<usize> = wanted.collect();
        places.sort_unstable();
        places.dedup();
        let values = order_statistics(values, &places);
        Self { places, values }
    }

    /// At a place that was wanted.
    fn at(&self, place: usize) -> f64 {
        self.values[self.places.partition_point(|wanted| *wanted < place)]
    }

    fn between(&self, place: &Place) -> f64 {
        let (low, high) = (self.at(place.below), self.at(place.above));
        // Q = x₍ₖ₎ + (h − k)·(x₍ₖ₊₁₎ − x₍ₖ₎)
        low + (high - low) * place.part
    }
}

/// Where a quantile stands among the ordered values.
struct Place {
    below: usize,
    above: usize,
    part: f64,
    around: Option<(usize, usize)>,
}

impl Place {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the count")]
    fn of(probability: f64, count: usize) -> Self {
        let last = count - 1;
        // h = (n − 1)p
        let position = last as f64 * probability;
        let around = tail_is_populated(probability, count).then(|| {
            // √(np(1 − p))
            let deviation = (count as f64 * probability * (1.0 - probability)).sqrt();
            let before = (position - deviation).round().max(0.0) as usize;
            let after = ((position + deviation).round() as usize).min(last);
            (before, after)
        });
        Self { around, ..Self::at(position, count) }
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the count")]
    fn at(position: f64, count: usize) -> Self {
        let below = position.floor();
        let index = below as usize;
        Self { below: index, above: (index + 1).min(count - 1), part: position - below, around: None }
    }

    fn wanted(&self) -> impl Iterator<Item = usize> + use<> {
        let around = self.around.map(|(before, after)| [before, after]);
        [self.below, self.above].into_iter().chain(around.into_iter().flatten())
    }
}

/// Whether enough samples lie beyond a quantile for its standard error.
fn tail_is_populated(probability: f64, count: usize) -> bool {
    count as f64 * probability.min(1.0 - probability) >= TAIL_SAMPLES
}

/// The values at the wanted places, counted from zero and ascending, of the values in their order.
///
/// The range of the values is cut into equal cells. One pass counts the values in each; a second one takes
/// out those of the few cells in which a wanted place lies, which alone are put in order. However the values
/// lie, this is right; where most lie in one cell, it is no quicker than ordering them.
fn order_statistics(values: &[f64], wanted: &[usize]) -> Vec<f64> {
    let cells = Cells::of(values);
    let counts = cells.count(values);

    // The cells with a wanted place, each with the place of its first value. There are fewer than u8::MAX: a
    // summary wants 36 places at most.
    let mut slots = [u8::MAX; 2 * CELLS];
    let mut taken: Vec<(usize, Vec<f64>)> = Vec::new();
    let mut waiting = wanted.iter().peekable();
    let mut first = 0;
    for (slot, &count) in slots.iter_mut().zip(counts.iter()) {
        let next = first + count;
        if waiting.peek().is_some_and(|place| **place < next) {
            *slot = u8::try_from(taken.len()).unwrap_or(u8::MAX);
            taken.push((first, Vec::with_capacity(count)));
            while waiting.next_if(|place| **place < next).is_some() {}
        }
        first = next;
    }
    for &value in values {
        let slot = slots[cells.cell(value)];
        if slot < u8::MAX
            && let Some((_, taken)) = taken.get_mut(usize::from(slot))
        {
            taken.push(value);
        }
    }

    let mut found = Vec::with_capacity(wanted.len());
    let mut waiting = wanted;
    for (first, mut values) in taken {
        let here = waiting.partition_point(|place| *place < first + values.len());
        let (places, rest) = waiting.split_at(here);
        waiting = rest;
        select(&mut values, first, places);
        found.extend(places.iter().map(|place| values[place - first]));
    }
    found
}

/// Number of cells.
const CELLS: usize = 1 << 11;

/// Equal parts of the range of some values.
struct Cells {
    least: f64,
    per_unit: f64,
}

impl Cells {
    fn of(values: &[f64]) -> Self {
        let mut least = [f64::INFINITY; 8];
        let mut greatest = [f64::NEG_INFINITY; 8];
        let (blocks, rest) = values.as_chunks::<8>();
        let mut widen = |lane: usize, value: f64| {
            least[lane] = if value < least[lane] { value } else { least[lane] };
            greatest[lane] = if value > greatest[lane] { value } else { greatest[lane] };
        };
        for block in blocks {
            for (lane, &value) in block.iter().enumerate() {
                widen(lane, value);
            }
        }
        for (lane, &value) in rest.iter().enumerate() {
            widen(lane, value);
        }
        let least = least.into_iter().fold(f64::INFINITY, f64::min);
        let greatest = greatest.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let per_unit = CELLS as f64 / (greatest - least);
        // One cell for values that are all the same, or too near or too far apart for the quotient.
        if per_unit.is_finite() && per_unit > 0.0 {
            Self { least, per_unit }
        } else {
            Self { least: 0.0, per_unit: 0.0 }
        }
    }

    /// Never falls where the value rises.
    #[inline(always)]
    fn cell(&self, value: f64) -> usize {
        // 2⁵²: its last bits are the rounded sum.
        const TO_INTEGER: f64 = 4_503_599_627_370_496.0;
        let bits = ((value - self.least) * self.per_unit + TO_INTEGER).to_bits();
        #[expect(clippy::cast_possible_truncation, reason = "only the last bits are wanted")]
        let last = bits as usize;
        last % (2 * CELLS)
    }

    fn count(&self, values: &[f64]) -> Box<[usize; 2 * CELLS]> {
        let mut counts = Box::new([0; 2 * CELLS]);
        for &value in values {
            counts[self.cell(value)] += 1;
        }
        counts
    }
}

/// Puts the wanted places of the ordered values right, the middle one first and the others inside its halves.
/// `values` begin at `start`.
fn select(values: &mut [f64], start: usize, wanted: &[usize]) {
    let (before, [middle, after @ ..]) = wanted.split_at(wanted.len() / 2) else { return };
    let place = middle - start;
    let (low, _, high) = values.select_nth_unstable_by(place, f64::total_cmp);
    select(low, start, before);
    select(high, middle + 1, after);
}

/// Standard errors of the statistics.
struct Errors {
    mean: Option<f64>,
    sd: Option<f64>,
    quantiles: [Option<f64>; PROBABILITIES.len()],
}

impl Errors {
    fn by_formula(moments: &Moments, quantiles: &Quantiles) -> Self {
        let count = moments.count as f64;
        let sd = moments.sd();
        // s/√n
        let mean = sd / count.sqrt();
        // Var(s²) = (m₄ − s⁴(n − 3)/(n − 1))/n, Var(s) ≈ Var(s²)/4s²
        let fourth = moments.fourth_powers / count;
        let variance = (fourth - sd * sd * sd * sd * (count - 3.0) / (count - 1.0)) / count;
        let of_sd = if sd > 0.0 { variance.max(0.0).sqrt() / (2.0 * sd) } else { 0.0 };
        Self { mean: Some(mean), sd: Some(of_sd), quantiles: quantiles.half_distances }
    }

    fn by_replicates(column: &[f64], values: &[f64], quantiles: &Quantiles) -> Self {
        // Dealt in one pass over the column, which is too long for the caches.
        let mut replicates: [Vec<f64>; REPLICATES] =
            std::array::from_fn(|_| Vec::with_capacity(column.len().div_ceil(REPLICATES)));
        for row in column.chunks(REPLICATES) {
            for (own, value) in replicates.iter_mut().zip(row).filter(|(_, value)| !value.is_nan()) {
                own.push(*value);
            }
        }
        let moments: Vec<Moments> =
            replicates.iter().filter(|own| own.len() >= 2).map(|own| Moments::of(own)).collect();
        let means: Vec<f64> = moments.iter().map(|moments| moments.mean).collect();
        let sds: Vec<f64> = moments.iter().map(Moments::sd).collect();
        let mut of_quantiles = [None; PROBABILITIES.len()];
        if means.len() == REPLICATES {
            let deviations = deviations_of_place(column, &quantiles.values);
            let populated = PROBABILITIES.map(|probability| tail_is_populated(probability, values.len()));
            let found = half_distances(values, deviations);
            of_quantiles = std::array::from_fn(|place| populated[place].then_some(found[place]));
        }
        Self { mean: error_of_mean(&means), sd: error_of_mean(&sds), quantiles: of_quantiles }
    }
}

/// How far from its place among the ordered values each quantile may be, by the numbers of samples below it
/// in the replicates. NaN is in none.
fn deviations_of_place(column: &[f64], quantiles: &[f64; PROBABILITIES.len()]) -> [f64; PROBABILITIES.len()] {
    let (rows, rest) = column.as_chunks::<REPLICATES>();
    let mut last = [f64::NAN; REPLICATES];
    last[..rest.len()].copy_from_slice(rest);
    let rows = || rows.iter().chain(std::iter::once(&last));
    let mut counts = [0_u64; REPLICATES];
    for row in rows() {
        for (count, value) in counts.iter_mut().zip(row) {
            *count += u64::from(!value.is_nan());
        }
    }
    let all = counts.iter().sum::<u64>() as f64;
    quantiles.map(|quantile| {
        // Twice the number below, so that a value at the quantile itself counts by half.
        let mut twice = [0_u64; REPLICATES];
        for row in rows() {
            for (twice, &value) in twice.iter_mut().zip(row) {
                *twice += u64::from(value < quantile) + u64::from(value <= quantile);
            }
        }
        let share = 0.5 * twice.iter().sum::<u64>() as f64 / all;
        let squares = twice.iter().zip(counts).map(|(&twice, count)| {
            let excess = 0.5 * twice as f64 - share * count as f64;
            excess * excess
        });
        let replicates = REPLICATES as f64;
        // √(R/(R − 1)·Σ(cᵣ − Fnᵣ)² + 1), F = Σcᵣ/n
        (replicates / (replicates - 1.0) * squares.sum::<f64>() + 1.0).sqrt()
    })
}

/// Half of the distance between the values so many places after and before each quantile.
fn half_distances(values: &[f64], deviations: [f64; PROBABILITIES.len()]) -> [f64; PROBABILITIES.len()] {
    let last = (values.len() - 1) as f64;
    let mut ends = PROBABILITIES.map(|probability| [last * probability; 2]);
    for ([before, after], deviation) in ends.iter_mut().zip(deviations) {
        *before = (*before - deviation).max(0.0);
        *after = (*after + deviation).min(last);
    }
    let ends = ends.map(|ends| ends.map(|position| Place::at(position, values.len())));
    let found = Ordered::of(values, ends.iter().flatten().flat_map(Place::wanted));
    ends.map(|[before, after]| 0.5 * (found.between(&after) - found.between(&before)))
}

/// s/√R over the replicates, where all of them have a value.
fn error_of_mean(of_replicates: &[f64]) -> Option<f64> {
    (of_replicates.len() == REPLICATES).then(|| Moments::of(of_replicates).sd() / (REPLICATES as f64).sqrt())
}

#[cfg(test)]
mod tests;
