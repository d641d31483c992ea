//! The normal distribution with the mean and covariance of particles.

use uncertainty::{LANES, Lanes};

use crate::shrink::{self, FLOOR};

/// A mean and the lower triangle L of a covariance L Lᵀ.
#[derive(Clone, Debug)]
pub(crate) struct Gaussian {
    pub(crate) mean: Vec<f64>,
    /// Row i has i + 1 numbers.
    pub(crate) triangle: Vec<Vec<f64>>,
}

impl Gaussian {
    /// The normal distribution of the particles in `blocks`, each with a column for each coordinate.
    ///
    /// The eigenvalues of a sample covariance of few particles are too far apart: narrow directions are found
    /// too narrow, wide ones too wide, and in many dimensions such a normal distribution misses most of the
    /// posterior. So the eigenvalues are shrunk; if there are too few particles for that, the covariance is
    /// shrunk towards its diagonal.
    pub(crate) fn of(blocks: &[&[Lanes]], dimensions: usize) -> Self {
        let count = (blocks.len() * LANES) as f64;
        let mean: Vec<f64> = (0..dimensions)
            .map(|coordinate| blocks.iter().map(|block| sum(&block[coordinate])).sum::<f64>() / count)
            .collect();
        let mut triangle: Vec<Vec<f64>> = (0..dimensions).map(|row| vec![0.0; row + 1]).collect();
        let mut deviations = vec![Lanes::ZERO; dimensions];
        for block in blocks {
            for ((deviation, column), mean) in deviations.iter_mut().zip(*block).zip(&mean) {
                for (deviation, value) in deviation.iter_mut().zip(column) {
                    *deviation = value - mean;
                }
            }
            for (row, first) in triangle.iter_mut().zip(&deviations) {
                for (entry, second) in row.iter_mut().zip(&deviations) {
                    *entry += product(first, second);
                }
            }
        }
        for (place, row) in triangle.iter_mut().enumerate() {
            for entry in row.iter_mut() {
                *entry /= count;
            }
            if let Some(variance) = row.get_mut(place) {
                *variance += FLOOR;
            }
        }
        let different = different(blocks);
        match shrink::eigenvalues(&triangle, different) {
            Some(better) => triangle = better,
            None => towards_diagonal(&mut triangle, count),
        }
        cholesky(&mut triangle);
        Self { mean, triangle }
    }

    /// y = L⁻¹(x − m), column by column.
    #[inline(always)]
    pub(crate) fn standardise(&self, x: &[Lanes], y: &mut [Lanes]) {
        for (row, (entries, mean)) in self.triangle.iter().zip(&self.mean).enumerate() {
            let (done, rest) = y.split_at_mut(row.min(y.len()));
            let (Some(place), Some(column), Some(diagonal)) = (rest.first_mut(), x.get(row), entries.last())
            else {
                return;
            };
            for (place, value) in place.iter_mut().zip(column) {
                *place = value - mean;
            }
            for (entry, earlier) in entries.iter().zip(done.iter()) {
                for (place, earlier) in place.iter_mut().zip(earlier) {
                    *place -= entry * earlier;
                }
            }
            let inverse = diagonal.recip();
            for place in place.iter_mut() {
                *place *= inverse;
            }
        }
    }

    /// x = m + L y, column by column.
    #[inline(always)]
    pub(crate) fn spread(&self, y: &[Lanes], x: &mut [Lanes]) {
        for ((column, entries), mean) in x.iter_mut().zip(&self.triangle).zip(&self.mean) {
            *column = Lanes::splat(*mean);
            for (entry, number) in entries.iter().zip(y) {
                for (value, number) in column.iter_mut().zip(number) {
                    *value += entry * number;
                }
            }
        }
    }
}

/// Number of different particles: resampling leaves several at the same place.
fn different(blocks: &[&[Lanes]]) -> usize {
    let mut places: Vec<f64> = blocks.iter().filter_map(|block| block.first()).flatten().copied().collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    places.len()
}

/// Shrinks a covariance of `count` particles towards its diagonal by d/(d + n), the extent to which they
/// leave it undetermined.
fn towards_diagonal(triangle: &mut [Vec<f64>], count: f64) {
    let kept = count / (count + triangle.len() as f64);
    for (place, row) in triangle.iter_mut().enumerate() {
        for entry in row.iter_mut().take(place) {
            *entry *= kept;
        }
    }
}

/// A = L Lᵀ, in place (Cholesky–Banachiewicz).
fn cholesky(triangle: &mut [Vec<f64>]) {
    for row in 0..triangle.len() {
        let (done, rest) = triangle.split_at_mut(row);
        let Some(entries) = rest.first_mut() else { return };
        for (column, above) in done.iter().enumerate() {
            // l_ij = (a_ij − Σ l_ik l_jk)/l_jj
            let sum: f64 = entries.iter().zip(above).take(column).map(|(l, k)| l * k).sum();
            entries[column] = (entries[column] - sum) / above[column];
        }
        let squares: f64 = entries.iter().take(row).map(|l| l * l).sum();
        let variance = entries[row];
        // l_ii = √(a_ii − Σ l_ik²), which rounding must not take to zero
        entries[row] = (variance - squares).max(variance * 1e-12).sqrt();
    }
}

/// Σ x in a fixed order over eight lanes.
#[inline(always)]
pub(crate) fn sum(column: &[f64; LANES]) -> f64 {
    let mut sums = [0.0; 8];
    let (groups, _) = column.as_chunks::<8>();
    for group in groups {
        for (sum, value) in sums.iter_mut().zip(group) {
            *sum += value;
        }
    }
    sums.iter().sum()
}

/// Σ x y in a fixed order over eight lanes.
#[inline(always)]
pub(crate) fn product(first: &[f64; LANES], second: &[f64; LANES]) -> f64 {
    let mut sums = [0.0; 8];
    let (groups, _) = first.as_chunks::<8>();
    let (others, _) = second.as_chunks::<8>();
    for (group, other) in groups.iter().zip(others) {
        for ((sum, value), other) in sums.iter_mut().zip(group).zip(other) {
            *sum += value * other;
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::Gaussian;
    use uncertainty::Lanes;

    /// Points with known mean and covariance: (a, 2a + b) for a, b = ±1 in all combinations.
    #[test]
    fn mean_and_covariance_are_those_of_the_points() {
        let sign = |bit: usize, lane: usize| if lane >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let first = Lanes::from(std::array::from_fn(|lane| 3.0 + sign(0, lane)));
        let second = Lanes::from(std::array::from_fn(|lane| -1.0 + 2.0 * sign(0, lane) + sign(1, lane)));
        let block = [first, second];
        let gaussian = Gaussian::of(&[&block, &block], 2);
        assert_eq!(gaussian.mean, [3.0, -1.0]);
        // Covariances 1, 2·n/(n + d), 5 with n = 128 and d = 2.
        let between = 2.0 * 128.0 / 130.0;
        let expected = [[1.0, 0.0], [between, (5.0_f64 - between * between).sqrt()]];
        for (row, expected) in gaussian.triangle.iter().zip(expected) {
            assert!(row.iter().zip(expected).all(|(l, exact)| (l - exact).abs() < 1e-12), "{row:?}");
        }
        let mut standard = vec![Lanes::ZERO; 2];
        let mut back = standard.clone();
        gaussian.standardise(&block, &mut standard);
        gaussian.spread(&standard, &mut back);
        let pairs = back.iter().flatten().zip(block.iter().flatten());
        assert!(pairs.into_iter().all(|(back, value)| (back - value).abs() < 1e-12));
    }

    #[test]
    fn equal_particles_have_a_triangle_too() {
        let block = [Lanes::splat(0.5); 3];
        let gaussian = Gaussian::of(&[&block], 3);
        assert!(gaussian.triangle.iter().all(|row| row.iter().all(|l| l.is_finite())));
        assert!(gaussian.triangle.iter().all(|row| *row.last().unwrap() > 0.0));
    }
}
