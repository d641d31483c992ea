//! Moments of a column, from sums over spans.

use crate::limits::REPLICATES;

/// Number of values summed at once, in whole rows of replicates. Their sum is then added to that of the
/// earlier spans, so that rounding does not grow with the number of values.
const SPAN: usize = 256 * REPLICATES;

/// Number of values, and the shifted moments Σ(x − c)ᵏ for k = 1 … 4, where c is a central value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Powers {
    pub(super) count: u64,
    sums: [f64; 4],
}

impl Powers {
    fn add(&mut self, more: &Self) {
        self.count += more.count;
        for (sum, more) in self.sums.iter_mut().zip(more.sums) {
            *sum += more;
        }
    }

    pub(super) fn of_all(parts: &[Self]) -> Self {
        let mut all = Self::default();
        for part in parts {
            all.add(part);
        }
        all
    }

    pub(super) fn moments(&self, centre: f64) -> Moments {
        let count = self.count as f64;
        let [first, second, third, fourth] = self.sums;
        // δ = x̄ − c
        let shift = first / count;
        // Σ(x − x̄)² = S₂ − δS₁
        let squares = second - shift * first;
        // Σ(x − x̄)⁴ = S₄ − 4δS₃ + 6δ²S₂ − 3δ³S₁
        let square = shift * shift;
        let fourth_powers =
            fourth - 4.0 * (shift * third) + 6.0 * (square * second) - 3.0 * (square * (shift * first));
        // Rounding may make a sum negative; a sum that overflowed stays infinite.
        let above = |sum: f64, of: f64| if of.is_finite() { sum.max(0.0) } else { of };
        Moments {
            count: usize::try_from(self.count).unwrap_or(usize::MAX),
            mean: centre + shift,
            squares: above(squares, second),
            fourth_powers: above(fourth_powers, fourth),
        }
    }
}

/// Number of values, mean, and sums of powers of the deviations from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments {
    pub(super) count: usize,
    pub(super) mean: f64,
    squares: f64,
    pub(super) fourth_powers: f64,
}

impl Moments {
    pub(super) fn sd(&self) -> f64 {
        // s² = Σ(x − x̄)²/(n − 1)
        (self.squares / (self.count as f64 - 1.0)).sqrt()
    }
}

/// The sums of each replicate; samples are dealt to the replicates in turn. NaN is left out.
pub(super) fn powers_of_replicates(column: &[f64], centre: f64) -> [Powers; REPLICATES] {
    let mut all = [Powers::default(); REPLICATES];
    for span in column.chunks(SPAN) {
        let mut of_span = [Powers::default(); REPLICATES];
        for row in span.chunks(REPLICATES) {
            for (Powers { count, sums: [first, second, third, fourth] }, value) in of_span.iter_mut().zip(row)
            {
                let is_missing = value.is_nan();
                let deviation = if is_missing { 0.0 } else { value - centre };
                let square = deviation * deviation;
                *count += u64::from(!is_missing);
                *first += deviation;
                *second += square;
                *third += square * deviation;
                *fourth += square * square;
            }
        }
        for (powers, more) in all.iter_mut().zip(&of_span) {
            powers.add(more);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::{Powers, SPAN, powers_of_replicates};
    use crate::limits::REPLICATES;
    use crate::random::{bits, unit};

    /// Compared with sums of the deviations from the mean itself, with a centre next to it, missing values,
    /// and a length that is not a multiple of the block sizes.
    #[test]
    fn moments_are_those_of_deviations_from_the_mean() {
        for (missing, spread) in [(0.0, 1.0), (0.2, 1.0), (0.2, 1e-6)] {
            let value = |index: u64| {
                let u = unit(bits(1, index));
                if unit(bits(2, index)) < missing { f64::NAN } else { 1000.0 + spread * u * u }
            };
            let column: Vec<f64> = (0..3 * SPAN as u64 + 77).map(value).collect();
            let centre = 1000.0 + 0.4 * spread;
            let totals = powers_of_replicates(&column, centre);
            let own = |replicate: usize| column.iter().skip(replicate).step_by(REPLICATES).copied();
            let all = (Powers::of_all(&totals), column.clone());
            let parts = totals
                .into_iter()
                .enumerate()
                .map(|(replicate, own_total)| (own_total, own(replicate).collect::<Vec<f64>>()));
            for (powers, values) in parts.chain([all]) {
                let values: Vec<f64> = values.into_iter().filter(|value| !value.is_nan()).collect();
                let count = values.len() as f64;
                let mean = values.iter().map(|value| value - 1000.0).sum::<f64>() / count + 1000.0;
                let squares: Vec<f64> = values.iter().map(|x| (x - mean) * (x - mean)).collect();
                let found = powers.moments(centre);
                assert_eq!(found.count, values.len());
                let near = |found: f64, expected: f64, share: f64| {
                    assert!((found - expected).abs() <= share * expected.abs(), "{found} {expected}");
                };
                near(found.mean, mean, 1e-15);
                // The mean is rounded to 1e-13 of 1000.
                let share = if spread < 1.0 { 1e-6 } else { 1e-12 };
                near(found.squares, squares.iter().sum(), share);
                near(found.fourth_powers, squares.iter().map(|square| square * square).sum(), share);
            }
        }
    }

    #[test]
    fn powers_of_alike_values_are_nothing_and_of_huge_ones_too_much() {
        let alike = Powers::of_all(&powers_of_replicates(&[0.1; 100], 0.1)).moments(0.1);
        assert_eq!((alike.mean, alike.squares, alike.fourth_powers), (0.1, 0.0, 0.0));
        let huge = Powers::of_all(&powers_of_replicates(&[-1e300, 1e300], 0.0)).moments(0.0);
        assert_eq!((huge.sd(), huge.fourth_powers), (f64::INFINITY, f64::INFINITY));
    }
}
