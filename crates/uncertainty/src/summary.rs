//! Statistics of a column of samples, each with its standard error.
//!
//! # References
//!
//! R. J. Hyndman and Y. Fan, *Sample quantiles in statistical packages*, American Statistician 50 (1996):
//! quantiles are their type 7, as in NumPy. M. G. Kendall and A. Stuart, *The Advanced Theory of Statistics*,
//! volume 1, sections 10.5 and 14: standard errors of moments; order statistics.

mod histogram;
mod powers;

use crate::limits::REPLICATES;
use powers::{Moments, Powers, powers_of_replicates};

pub use histogram::{Classes, Histogram};

/// Levels of the intervals of a [`Summary`].
pub const LEVELS: [f64; 4] = [0.5, 0.9, 0.95, 0.99];

/// Minimum expected number of samples beyond a quantile for a standard error of it.
const TAIL_SAMPLES: f64 = 5.0;

/// A statistic and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// (unit of the output) the statistic.
    pub value: f64,
    /// (unit of the output) its standard error from sampling; `None` if there are too few samples.
    pub standard_error: Option<f64>,
}

/// The range between two quantiles, with equal probabilities beyond either end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Fraction of the samples in between.
    pub level: f64,
    /// (unit of the output) lower end.
    pub low: Estimate,
    /// (unit of the output) upper end.
    pub high: Estimate,
}

/// Statistics of one output.
///
/// Monte Carlo: the standard error of the mean is s/√n, that of s follows from the fourth moment, that of a
/// quantile from the order statistics at one binomial standard deviation of the count on either side.
///
/// Latin hypercube and Sobol': the standard errors of the mean and of s follow from their spread between the
/// [`REPLICATES`] point sets, s/√16. That of a quantile is half of the distance between the order statistics
/// on either side of it, as for Monte Carlo, but their distance in places is the standard error of the number
/// of samples below the quantile, from its spread between the replicates, plus one. The spread of the
/// replicates' own quantiles would be wrong: if one input dominates the result, they stay in their strata,
/// and the quantile of all samples does not. With 15 degrees of freedom all these are themselves uncertain by
/// a fifth.
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
    /// The intervals at [`LEVELS`].
    pub intervals: [Interval; LEVELS.len()],
}

/// Probabilities of the median and of the ends of the intervals, lower and upper in turn.
const PROBABILITIES: [f64; QUANTILES] = [0.5, 0.25, 0.75, 0.05, 0.95, 0.025, 0.975, 0.005, 0.995];
/// Number of quantiles.
const QUANTILES: usize = 1 + 2 * LEVELS.len();

impl Summary {
    /// The statistics of a column in which NaN marks failed samples, either dealt to replicates in turn or
    /// independent. `None` if fewer than two have an answer.
    pub(crate) fn of(column: &[f64], is_replicated: bool) -> Option<Self> {
        let mut values: Vec<f64> = column.iter().copied().filter(|value| !value.is_nan()).collect();
        let count = values.len();
        if count < 2 {
            return None;
        }
        let places = PROBABILITIES.map(|probability| Place::of(probability, count));
        let order = Order::of(&mut values, places.iter().flat_map(Place::wanted));
        let quantiles = places.each_ref().map(|place| place.value(&order));
        // Moments are shifted by the median.
        let [centre, ..] = quantiles;
        let replicates = powers_of_replicates(column, centre);
        let moments = Powers::of_all(&replicates).moments(centre);
        let errors = if !is_replicated {
            Errors::by_formula(&moments, places.each_ref().map(|place| place.half_distance(&order)))
        } else if replicates.iter().any(|powers| powers.count < 2) {
            Errors { mean: None, sd: None, quantiles: [None; QUANTILES] }
        } else {
            let ends = Below::of(column, &quantiles).ends(&replicates.each_ref().map(|powers| powers.count));
            let order = Order::of(&mut values, ends.iter().flatten().flat_map(Place::wanted));
            let distance = |[before, after]: &[Place; 2]| 0.5 * (after.value(&order) - before.value(&order));
            let is_populated = PROBABILITIES.map(|probability| tail_is_populated(probability, count));
            let distances = ends.each_ref().map(distance);
            let of_quantiles = std::array::from_fn(|place| is_populated[place].then_some(distances[place]));
            Errors::by_replicates(&replicates.map(|powers| powers.moments(centre)), of_quantiles)
        };
        Some(Self::new(&moments, &quantiles, &errors))
    }

    fn new(moments: &Moments, quantiles: &[f64; QUANTILES], errors: &Errors) -> Self {
        let quantile =
            |place: usize| Estimate { value: quantiles[place], standard_error: errors.quantiles[place] };
        let interval = |place: usize| Interval {
            level: LEVELS[place],
            low: quantile(2 * place + 1),
            high: quantile(2 * place + 2),
        };
        Self {
            samples: moments.count,
            mean: Estimate { value: moments.mean, standard_error: errors.mean },
            sd: Estimate { value: moments.sd(), standard_error: errors.sd },
            median: quantile(0),
            intervals: std::array::from_fn(interval),
        }
    }
}

/// Selected order statistics of a column.
struct Order {
    /// Ascending.
    places: Vec<usize>,
    values: Vec<f64>,
}

impl Order {
    /// Selects the wanted places; reorders the values.
    fn of(values: &mut [f64], wanted: impl Iterator<Item = usize>) -> Self {
        let mut places: Vec<usize> = wanted.collect();
        places.sort_unstable();
        places.dedup();
        let mut found = vec![f64::NAN; places.len()];
        select(values, 0, &places, &mut found);
        Self { places, values: found }
    }

    /// The value at one of the wanted places.
    fn at(&self, place: usize) -> f64 {
        self.places.binary_search(&place).map_or(f64::NAN, |index| self.values[index])
    }
}

/// Selects the values at ascending places; the least of `values` has the place `first` in the column. The
/// middle place divides the others in two.
fn select(values: &mut [f64], first: usize, places: &[usize], found: &mut [f64]) {
    let middle = places.len() / 2;
    let Some(place) = places.get(middle) else { return };
    let (below, value, above) = values.select_nth_unstable_by(place - first, f64::total_cmp);
    found[middle] = *value;
    select(below, first, &places[..middle], &mut found[..middle]);
    select(above, place + 1, &places[middle + 1..], &mut found[middle + 1..]);
}

/// The place of a quantile among the ordered values.
#[derive(Debug)]
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

/// The order statistic at a position among ascending values, counted from 0, linear between two of them; NaN
/// if there are none, or the position is. For a probability p the convention of the caller gives the
/// position: (n − 1)p is type 7 of Hyndman and Fan, np − ½ their type 5, and ⌊np⌋ a value that occurred.
#[must_use]
pub fn order_statistic(ascending: &[f64], position: f64) -> f64 {
    let Some(last) = ascending.len().checked_sub(1).filter(|_| !position.is_nan()) else { return f64::NAN };
    let place = Place::at(position.clamp(0.0, last as f64), ascending.len());
    place.between(ascending[place.below], ascending[place.above])
}

/// Whether enough samples lie beyond a quantile for its standard error.
fn tail_is_populated(probability: f64, count: usize) -> bool {
    count as f64 * probability.min(1.0 - probability) >= TAIL_SAMPLES
}

impl Place {
    /// Its value, from the order statistics that it [wants](Self::wanted).
    fn value(&self, order: &Order) -> f64 {
        self.between(order.at(self.below), order.at(self.above))
    }

    fn between(&self, low: f64, high: f64) -> f64 {
        // Q = x₍ₖ₎ + (h − k)·(x₍ₖ₊₁₎ − x₍ₖ₎)
        if self.part > 0.0 { low + (high - low) * self.part } else { low }
    }

    /// Half of the distance between the order statistics on either side, if there are enough samples.
    fn half_distance(&self, order: &Order) -> Option<f64> {
        self.around.map(|(before, after)| 0.5 * (order.at(after) - order.at(before)))
    }
}

/// Standard errors of the statistics.
struct Errors {
    mean: Option<f64>,
    sd: Option<f64>,
    quantiles: [Option<f64>; QUANTILES],
}

impl Errors {
    fn by_formula(moments: &Moments, quantiles: [Option<f64>; QUANTILES]) -> Self {
        let count = moments.count as f64;
        let sd = moments.sd();
        // s/√n
        let mean = sd / count.sqrt();
        // Var(s²) = (m₄ − s⁴(n − 3)/(n − 1))/n, Var(s) ≈ Var(s²)/4s²
        let fourth = moments.fourth_powers / count;
        let variance = (fourth - sd * sd * sd * sd * (count - 3.0) / (count - 1.0)) / count;
        let of_sd = if sd > 0.0 { variance.max(0.0).sqrt() / (2.0 * sd) } else { 0.0 };
        Self { mean: Some(mean), sd: Some(of_sd), quantiles }
    }

    fn by_replicates(replicates: &[Moments; REPLICATES], quantiles: [Option<f64>; QUANTILES]) -> Self {
        let means = replicates.each_ref().map(|moments| moments.mean);
        let sds = replicates.each_ref().map(Moments::sd);
        Self { mean: Some(error_of_mean(&means)), sd: Some(error_of_mean(&sds)), quantiles }
    }
}

/// Number of samples of each replicate below each quantile.
#[derive(Debug)]
struct Below {
    /// Twice the number below, so that a value at the quantile itself counts by half.
    twice: [[u64; REPLICATES]; QUANTILES],
}

impl Below {
    /// Counts a column in sample order, without NaN.
    fn of(column: &[f64], quantiles: &[f64; QUANTILES]) -> Self {
        let mut twice = [[0; REPLICATES]; QUANTILES];
        for row in column.chunks(REPLICATES) {
            for (&quantile, twice) in quantiles.iter().zip(&mut twice) {
                for (twice, &value) in twice.iter_mut().zip(row) {
                    *twice += u64::from(value < quantile) + u64::from(value <= quantile);
                }
            }
        }
        Self { twice }
    }

    /// Standard error of the place of each quantile among the ordered values, given the number of samples of
    /// each replicate.
    fn deviations(&self, counts: &[u64; REPLICATES]) -> [f64; QUANTILES] {
        let all = counts.iter().sum::<u64>() as f64;
        self.twice.map(|twice| {
            let share = 0.5 * twice.iter().sum::<u64>() as f64 / all;
            let squares = twice.iter().zip(counts).map(|(&twice, &count)| {
                let excess = 0.5 * twice as f64 - share * count as f64;
                excess * excess
            });
            let replicates = REPLICATES as f64;
            // √(R/(R − 1)·Σ(cᵣ − Fnᵣ)² + 1), F = Σcᵣ/n
            (replicates / (replicates - 1.0) * squares.sum::<f64>() + 1.0).sqrt()
        })
    }

    /// The places at that distance before and after each quantile.
    fn ends(&self, counts: &[u64; REPLICATES]) -> [[Place; 2]; QUANTILES] {
        let count = usize::try_from(counts.iter().sum::<u64>()).unwrap_or(usize::MAX);
        let last = (count - 1) as f64;
        let mut ends = PROBABILITIES.map(|probability| [last * probability; 2]);
        for ([before, after], deviation) in ends.iter_mut().zip(self.deviations(counts)) {
            *before = (*before - deviation).max(0.0);
            *after = (*after + deviation).min(last);
        }
        ends.map(|ends| ends.map(|position| Place::at(position, count)))
    }
}

/// s/√R, with s from the replicates.
fn error_of_mean(of_replicates: &[f64; REPLICATES]) -> f64 {
    let count = REPLICATES as f64;
    let mean = of_replicates.iter().sum::<f64>() / count;
    let squares: f64 = of_replicates.iter().map(|value| (value - mean) * (value - mean)).sum();
    // s² = Σ(x − x̄)²/(R − 1)
    (squares / (count - 1.0)).sqrt() / count.sqrt()
}

#[cfg(test)]
mod tests;
