//! Moments of a column, from sums that are made span by span.

use crate::limits::REPLICATES;
use crate::model::{LANES, Lanes};

/// Samples that one thread takes at a time, and values that are added up together.
pub(crate) const SPAN: usize = 64 * LANES;

/// How many values there are, and Σ(x − c)ᵏ for k = 1 … 4, where c is a value in their middle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Powers {
    pub(super) count: u64,
    sums: [f64; 4],
}

impl Powers {
    pub(crate) fn add(&mut self, more: &Self) {
        self.count += more.count;
        for (sum, more) in self.sums.iter_mut().zip(more.sums) {
            *sum += more;
        }
    }

    pub(crate) fn of_all(parts: &[Self]) -> Self {
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
        // Rounding may leave less than nothing; a sum beyond the greatest number stays beyond it.
        let above = |sum: f64, of: f64| if of.is_finite() { sum.max(0.0) } else { of };
        Moments {
            count: usize::try_from(self.count).unwrap_or(usize::MAX),
            mean: centre + shift,
            squares: above(squares, second),
            fourth_powers: above(fourth_powers, fourth),
        }
    }
}

/// Number, mean and sums of powers of the deviations from it.
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

/// The powers of each replicate while its values come: they are dealt to the replicates in turn. NaN is in
/// none.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    counts: [u64; REPLICATES],
    sums: [[f64; REPLICATES]; 4],
}

impl Sums {
    #[inline(always)]
    pub(super) fn add(&mut self, block: &Lanes, centre: f64) {
        // Copies, which a compiler can keep in registers.
        let Self { mut counts, sums: [mut first, mut second, mut third, mut fourth] } = *self;
        let (rows, _) = block.as_chunks::<REPLICATES>();
        for row in rows {
            for own in 0..REPLICATES {
                let is_missing = row[own].is_nan();
                let deviation = if is_missing { 0.0 } else { row[own] - centre };
                let square = deviation * deviation;
                counts[own] += u64::from(!is_missing);
                first[own] += deviation;
                second[own] += square;
                third[own] += square * deviation;
                fourth[own] += square * square;
            }
        }
        *self = Self { counts, sums: [first, second, third, fourth] };
    }

    pub(super) fn powers(&self) -> [Powers; REPLICATES] {
        std::array::from_fn(|own| Powers { count: self.counts[own], sums: self.sums.map(|sums| sums[own]) })
    }
}

#[cfg(test)]
mod tests {
    use super::{Powers, SPAN, Sums};
    use crate::limits::REPLICATES;
    use crate::model::{LANES, Lanes};
    use crate::random::{bits, unit};

    fn of_replicates(span: &[f64], centre: f64) -> [Powers; REPLICATES] {
        let mut sums = Sums::default();
        for part in span.chunks(LANES) {
            let mut block = Lanes::splat(f64::NAN);
            block[..part.len()].copy_from_slice(part);
            sums.add(&block, centre);
        }
        sums.powers()
    }

    /// Beside sums of the deviations from the mean itself, with a centre beside it, values that are missing,
    /// and a length that is no multiple of anything.
    #[test]
    fn moments_are_those_of_deviations_from_the_mean() {
        for (missing, spread) in [(0.0, 1.0), (0.2, 1.0), (0.2, 1e-6)] {
            let value = |index: u64| {
                let u = unit(bits(1, index));
                if unit(bits(2, index)) < missing { f64::NAN } else { 1000.0 + spread * u * u }
            };
            let column: Vec<f64> = (0..3 * SPAN as u64 + 77).map(value).collect();
            let centre = 1000.0 + 0.4 * spread;
            let mut totals = [Powers::default(); REPLICATES];
            for span in column.chunks(SPAN) {
                for (total, own) in totals.iter_mut().zip(of_replicates(span, centre)) {
                    total.add(&own);
                }
            }
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
        let alike = Powers::of_all(&of_replicates(&[0.1; 100], 0.1)).moments(0.1);
        assert_eq!((alike.mean, alike.squares, alike.fourth_powers), (0.1, 0.0, 0.0));
        let huge = Powers::of_all(&of_replicates(&[-1e300, 1e300], 0.0)).moments(0.0);
        assert_eq!((huge.sd(), huge.fourth_powers), (f64::INFINITY, f64::INFINITY));
    }
}
