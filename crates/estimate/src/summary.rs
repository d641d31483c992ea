//! Statistics of draws, each with its sampling error.

use std::ops::Range;

use uncertainty::{Estimate, Interval};

/// Levels of the intervals of a [`DrawsSummary`].
pub const LEVELS: [f64; 4] = [0.5, 0.8, 0.9, 0.95];

/// Statistics of one quantity.
///
/// Standard errors follow from the spread between the islands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawsSummary {
    /// (unit of the quantity) mean.
    pub mean: Estimate,
    /// (unit of the quantity) standard deviation.
    pub sd: Estimate,
    /// (unit of the quantity) median.
    pub median: Estimate,
    /// The intervals at [`LEVELS`].
    pub intervals: [Interval; LEVELS.len()],
}

/// Draws in islands, with or without weights.
#[derive(Clone, Copy, Debug)]
pub struct Draws<'a> {
    islands: &'a [Range<usize>],
    weights: Option<&'a [f64]>,
}

impl<'a> Draws<'a> {
    /// With a number of weights other than that of the draws, all statistics are NaN.
    pub(crate) fn new(islands: &'a [Range<usize>], weights: Option<&'a [f64]>) -> Self {
        let draws = islands.last().map_or(0, |island| island.end);
        Self { islands, weights: weights.map(|weights| if weights.len() == draws { weights } else { &[] }) }
    }

    /// Statistics of a quantity; `column` has its value for each draw. All are NaN if it is shorter.
    #[must_use]
    pub fn summary(&self, column: &[f64]) -> DrawsSummary {
        let column = self.covered(column);
        let ordered = Ordered::of(column, |draw| self.weight(draw));
        let mean = self.mean(|draw| at(column, draw));
        let square = |draw: usize| (at(column, draw) - mean.value) * (at(column, draw) - mean.value);
        let variance = self.mean(square);
        let sd = variance.value.sqrt();
        // δσ = δσ²/2σ
        let sd_error = variance.standard_error.map(|error| if sd > 0.0 { error / (2.0 * sd) } else { 0.0 });
        let quantile = |share: f64| self.quantile(&ordered, column, share);
        let interval = |place: usize| {
            let level = LEVELS[place];
            Interval { level, low: quantile(0.5 - 0.5 * level), high: quantile(0.5 + 0.5 * level) }
        };
        DrawsSummary {
            mean,
            sd: Estimate { value: sd, standard_error: sd_error },
            median: quantile(0.5),
            intervals: std::array::from_fn(interval),
        }
    }

    /// The probability that a quantity is above a limit.
    ///
    /// Its standard error is at least that of the same effective number of independent draws with one more on
    /// either side: unanimous draws do not make anything certain.
    ///
    /// It is NaN if the column is shorter than the number of draws.
    #[must_use]
    pub fn probability_above(&self, column: &[f64], limit: f64) -> Estimate {
        let share = self.mean(|draw| match column.get(draw) {
            Some(value) if *value > limit => 1.0,
            Some(_) => 0.0,
            None => f64::NAN,
        });
        let count = self.effective();
        let cautious = (share.value * count + 1.0) / (count + 2.0);
        let least = (cautious * (1.0 - cautious) / (count + 2.0)).sqrt();
        Estimate { value: share.value, standard_error: share.standard_error.map(|error| error.max(least)) }
    }

    /// Number of equally weighted draws that would give a mean with the same accuracy, if all were
    /// independent: (Σ w)²/Σ w².
    #[must_use]
    pub fn effective(&self) -> f64 {
        let draws = self.islands.iter().cloned().flatten();
        let (sum, squares) = draws.fold((0.0, 0.0), |(sum, squares), draw| {
            let weight = self.weight(draw);
            (sum + weight, squares + weight * weight)
        });
        sum * sum / squares
    }

    fn weight(&self, draw: usize) -> f64 {
        self.weights.map_or(1.0, |weights| at(weights, draw))
    }

    /// A column with a value for each draw; an empty one in place of a shorter one.
    fn covered<'c>(&self, column: &'c [f64]) -> &'c [f64] {
        if self.islands.iter().all(|island| island.end <= column.len()) { column } else { &[] }
    }

    /// The mean of a function of the draw.
    #[must_use]
    pub fn mean(&self, of: impl Fn(usize) -> f64) -> Estimate {
        let sums = self.islands.iter().map(|island| {
            island.clone().fold((0.0, 0.0), |(sum, weights), draw| {
                let weight = self.weight(draw);
                (sum + weight * of(draw), weights + weight)
            })
        });
        let sums: Vec<(f64, f64)> = sums.collect();
        let total: f64 = sums.iter().map(|(_, weights)| weights).sum();
        let mean = sums.iter().map(|(sum, _)| sum).sum::<f64>() / total;
        let islands = sums.len() as f64;
        // A ratio of sums over islands: s² = I/(I − 1) Σ (Σ w x − x̄ Σ w)²/(Σ Σ w)²
        let squares: f64 = sums
            .iter()
            .map(|(sum, weights)| {
                let deviation = sum - mean * weights;
                deviation * deviation
            })
            .sum();
        let error = (islands / (islands - 1.0) * squares).sqrt() / total;
        Estimate { value: mean, standard_error: (islands > 1.0).then_some(error) }
    }

    fn quantile(&self, ordered: &Ordered, column: &[f64], share: f64) -> Estimate {
        let value = ordered.quantile(share);
        // Half of the distance between the quantiles at one standard error of the probability on either side.
        let below = self.mean(|draw| if at(column, draw) <= value { 1.0 } else { 0.0 });
        let error = below.standard_error.map(|error| {
            let least = (share * (1.0 - share) / self.effective()).sqrt();
            let error = error.max(least);
            0.5 * (ordered.quantile((share + error).min(1.0)) - ordered.quantile((share - error).max(0.0)))
        });
        Estimate { value, standard_error: error }
    }
}

/// The value of a draw; NaN beyond the end of the column.
fn at(column: &[f64], draw: usize) -> f64 {
    column.get(draw).copied().unwrap_or(f64::NAN)
}

/// A sorted column.
struct Ordered {
    values: Vec<f64>,
    /// (–) cumulative weight up to the middle of each value.
    shares: Vec<f64>,
}

impl Ordered {
    fn of(column: &[f64], weight: impl Fn(usize) -> f64) -> Self {
        let mut draws: Vec<usize> = (0..column.len()).filter(|&draw| weight(draw) > 0.0).collect();
        draws.sort_by(|a, b| column[*a].total_cmp(&column[*b]));
        let total: f64 = draws.iter().map(|&draw| weight(draw)).sum();
        let mut reached = 0.0;
        let shares = draws.iter().map(|&draw| {
            let weight = weight(draw);
            reached += weight;
            (reached - 0.5 * weight) / total
        });
        let shares = shares.collect();
        Self { values: draws.iter().map(|&draw| column[draw]).collect(), shares }
    }

    /// Linear interpolation between the two values whose shares enclose it.
    fn quantile(&self, share: f64) -> f64 {
        let above = self.shares.partition_point(|reached| *reached < share);
        let last = self.values.len().saturating_sub(1);
        let (low, high) = (above.saturating_sub(1).min(last), above.min(last));
        let Some((&from, &to)) = self.values.get(low).zip(self.values.get(high)) else { return f64::NAN };
        let span = self.shares[high] - self.shares[low];
        if span > 0.0 {
            from + (to - from) * ((share - self.shares[low]) / span).clamp(0.0, 1.0)
        } else {
            from
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Draws;

    /// Twelve numbers in three islands, calculated by hand.
    #[test]
    fn statistics_are_those_by_hand() {
        let column = [1.0, 2.0, 3.0, 6.0, 5.0, 4.0, 7.0, 8.0, 9.0, 12.0, 11.0, 10.0];
        let islands = [0..4, 4..8, 8..12];
        let summary = Draws::new(&islands, None).summary(&column);
        assert_eq!(summary.mean.value, 6.5);
        // Means of the islands 3, 6, 10.5: deviations −3.5, −0.5, 4; s = √(28.5/2)/√3.
        let error = summary.mean.standard_error.unwrap();
        assert!((error - (28.5_f64 / 6.0).sqrt()).abs() < 1e-12, "{error}");
        // Σ k²/12 − 6.5² = 650/12 − 42.25
        assert!((summary.sd.value - (650.0_f64 / 12.0 - 42.25).sqrt()).abs() < 1e-12);
        assert_eq!(summary.median.value, 6.5);
        // The share 0.25 lies halfway between 2.5/12 and 3.5/12.
        assert_eq!(summary.intervals[0].low.value, 3.5);
        assert_eq!(summary.intervals[0].high.value, 9.5);
        assert_eq!(summary.intervals[3].low.value, 1.0);
        let above = Draws::new(&islands, None).probability_above(&column, 9.0);
        assert_eq!(above.value, 0.25);
        // There is a standard error even without a draw beyond. p = 1/14: √(p(1 − p)/14) = 0.0688.
        let never = Draws::new(&islands, None).probability_above(&column, 12.0);
        assert_eq!(never.value, 0.0);
        assert!((never.standard_error.unwrap() - 0.068_83).abs() < 1e-5);
    }

    #[test]
    fn a_weight_of_two_is_two_draws() {
        let (column, weights) = ([3.0, 1.0, 2.0, 5.0], [2.0, 1.0, 0.0, 1.0]);
        let islands = [0..2, 2..4];
        let weighted = Draws::new(&islands, Some(&weights));
        let summary = weighted.summary(&column);
        assert_eq!(summary.mean.value, 3.0);
        assert_eq!(summary.median.value, 3.0);
        assert!((weighted.effective() - 16.0 / 6.0).abs() < 1e-12);
        assert_eq!(weighted.probability_above(&column, 4.0).value, 0.25);
    }
}
