//! Statistics of a column of samples, each with its standard error.
//!
//! # References
//!
//! R. J. Hyndman and Y. Fan, *Sample quantiles in statistical packages*, American Statistician 50 (1996):
//! quantiles are their type 7, as in NumPy. M. G. Kendall and A. Stuart, *The Advanced Theory of Statistics*,
//! volume 1, sections 10.5 and 14: standard errors of moments; order statistics.

mod first;
mod order;
mod passes;
mod sums;

use crate::limits::REPLICATES;
use crate::model::LANES;
use order::Order;
use sums::Moments;
pub(crate) use sums::SPAN;

pub(crate) use first::First;
pub(crate) use passes::{Chunk, Passes, Size};
pub use passes::{Classes, Histogram};

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
const PROBABILITIES: [f64; QUANTILES] = [0.5, 0.25, 0.75, 0.05, 0.95, 0.025, 0.975, 0.005, 0.995];
/// Number of them.
const QUANTILES: usize = 1 + 2 * LEVELS.len();

impl Summary {
    /// Of a column in which NaN stands for samples that failed; `None` where fewer than two succeeded.
    /// `is_complete` tells that there are none.
    pub(crate) fn of(column: &[f64], is_complete: bool, mut passes: Passes) -> Option<Self> {
        let succeeded;
        let answered = if is_complete {
            column
        } else {
            succeeded = without_nan(column);
            &succeeded
        };
        while !passes.are_done() {
            passes.add(Chunk { all: column, answered });
            passes.go_on();
        }
        passes.summary()
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

/// The values of a column in which NaN stands for samples that failed.
pub(crate) fn without_nan(column: &[f64]) -> Vec<f64> {
    column.iter().copied().filter(|value| !value.is_nan()).collect()
}

/// Where a quantile stands among the ordered values.
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

/// Whether enough samples lie beyond a quantile for its standard error.
fn tail_is_populated(probability: f64, count: usize) -> bool {
    count as f64 * probability.min(1.0 - probability) >= TAIL_SAMPLES
}

impl Place {
    /// Its value, once those that it [wants](Self::wanted) are known.
    fn value(&self, order: &Order) -> f64 {
        let (low, high) = (order.at(self.below), order.at(self.above));
        // Q = x₍ₖ₎ + (h − k)·(x₍ₖ₊₁₎ − x₍ₖ₎)
        low + (high - low) * self.part
    }

    /// Half of the distance between the order statistics to either side, where there are enough samples.
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

    /// By the moments of each replicate that has any.
    fn by_replicates(replicates: &[Moments], quantiles: [Option<f64>; QUANTILES]) -> Self {
        let means: Vec<f64> = replicates.iter().map(|moments| moments.mean).collect();
        let sds: Vec<f64> = replicates.iter().map(Moments::sd).collect();
        Self { mean: error_of_mean(&means), sd: error_of_mean(&sds), quantiles }
    }
}

/// How many samples of each replicate lie below each quantile.
#[derive(Debug)]
struct Below {
    quantiles: [f64; QUANTILES],
    /// Samples of each replicate.
    counts: [u64; REPLICATES],
    /// Twice the number below, so that a value at the quantile itself counts by half.
    twice: [[u64; REPLICATES]; QUANTILES],
}

impl Below {
    fn new(quantiles: [f64; QUANTILES]) -> Self {
        Self { quantiles, counts: [0; REPLICATES], twice: [[0; REPLICATES]; QUANTILES] }
    }

    /// Samples that follow, from the first replicate on. NaN is in none.
    #[inline(always)]
    fn add(&mut self, column: &[f64]) {
        let mut counts = [0; LANES];
        let mut twice = [[0; LANES]; QUANTILES];
        let (blocks, rest) = column.as_chunks::<LANES>();
        // All quantiles of a block before the next one: a sum that was just written is not ready yet.
        for block in blocks {
            count(&mut counts, block, |value| u64::from(!value.is_nan()));
            for (&quantile, twice) in self.quantiles.iter().zip(&mut twice) {
                count(twice, block, |value| u64::from(value < quantile) + u64::from(value <= quantile));
            }
        }
        count(&mut counts, rest, |value| u64::from(!value.is_nan()));
        for (&quantile, twice) in self.quantiles.iter().zip(&mut twice) {
            count(twice, rest, |value| u64::from(value < quantile) + u64::from(value <= quantile));
        }
        let add = |totals: &mut [u64; REPLICATES], more: &Counts| {
            for (replicate, total) in totals.iter_mut().enumerate() {
                *total += more.iter().skip(replicate).step_by(REPLICATES).sum::<u64>();
            }
        };
        add(&mut self.counts, &counts);
        for (totals, more) in self.twice.iter_mut().zip(&twice) {
            add(totals, more);
        }
    }

    /// How far from its place among the ordered values each quantile may be.
    fn deviations(&self) -> [f64; QUANTILES] {
        let all = self.counts.iter().sum::<u64>() as f64;
        self.twice.map(|twice| {
            let share = 0.5 * twice.iter().sum::<u64>() as f64 / all;
            let squares = twice.iter().zip(self.counts).map(|(&twice, count)| {
                let excess = 0.5 * twice as f64 - share * count as f64;
                excess * excess
            });
            let replicates = REPLICATES as f64;
            // √(R/(R − 1)·Σ(cᵣ − Fnᵣ)² + 1), F = Σcᵣ/n
            (replicates / (replicates - 1.0) * squares.sum::<f64>() + 1.0).sqrt()
        })
    }

    /// The places so far before and after each quantile of `count` values.
    fn ends(&self, count: usize) -> [[Place; 2]; QUANTILES] {
        let last = (count - 1) as f64;
        let mut ends = PROBABILITIES.map(|probability| [last * probability; 2]);
        for ([before, after], deviation) in ends.iter_mut().zip(self.deviations()) {
            *before = (*before - deviation).max(0.0);
            *after = (*after + deviation).min(last);
        }
        ends.map(|ends| ends.map(|position| Place::at(position, count)))
    }
}

/// A count for each lane, of which each replicate has several: the loop over them is vectorised as it stands.
type Counts = [u64; LANES];

/// Adds f(x) of values that begin with the first replicate.
#[inline(always)]
fn count(sums: &mut Counts, values: &[f64], f: impl Fn(f64) -> u64) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += f(*value);
    }
}

/// s/√R over the replicates, where all of them have a value.
fn error_of_mean(of_replicates: &[f64]) -> Option<f64> {
    (of_replicates.len() == REPLICATES).then(|| Moments::of(of_replicates).sd() / (REPLICATES as f64).sqrt())
}

#[cfg(test)]
mod tests;
