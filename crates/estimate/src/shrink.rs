//! Eigenvalues of a covariance that is estimated from few draws.
//!
//! # References
//!
//! O. Ledoit and M. Wolf, *Analytical nonlinear shrinkage of large-dimensional covariance matrices*, Annals
//! of Statistics 48 (2020), 3043–3065, section 4.

use std::f64::consts::PI;

use nalgebra::{DMatrix, SymmetricEigen};
use real::elementary::{exp, ln};

/// (–) minimum variance of a coordinate: a standard deviation of 1e-7 of the prior's.
pub(crate) const FLOOR: f64 = 1e-14;

/// (–) minimum number of different draws per dimension.
const LEAST: f64 = 1.2;

/// The lower triangle of the covariance estimated from `draws` different draws with the sample covariance
/// `triangle`: shrunk eigenvalues with the sample eigenvectors. `None` if there are too few draws for the
/// dimensions.
pub(crate) fn eigenvalues(triangle: &[Vec<f64>], draws: usize) -> Option<Vec<Vec<f64>>> {
    let dimensions = triangle.len();
    if (draws as f64) < LEAST * dimensions as f64 {
        return None;
    }
    let entry = |row: usize, column: usize| {
        let (low, high) = if row < column { (row, column) } else { (column, row) };
        triangle[high][low]
    };
    let found = SymmetricEigen::new(DMatrix::from_fn(dimensions, dimensions, entry));
    let sample: Vec<f64> = found.eigenvalues.iter().map(|value| value.max(FLOOR)).collect();
    let better = shrunk(&sample, draws as f64);
    let vectors = &found.eigenvectors;
    // Σ = U diag(d) Uᵀ
    let of = |row: usize, column: usize| -> f64 {
        better.iter().enumerate().map(|(k, value)| value * vectors[(row, k)] * vectors[(column, k)]).sum()
    };
    Some((0..dimensions).map(|row| (0..=row).map(|column| of(row, column)).collect()).collect())
}

/// The shrunk eigenvalues for those of the sample covariance of `draws` draws.
fn shrunk(sample: &[f64], draws: f64) -> Vec<f64> {
    let root = 5.0_f64.sqrt();
    let count = sample.len() as f64;
    let share = count / draws;
    // h = n^(−1/3)
    let width = exp(-ln(draws) / 3.0);
    let of = |&value: &f64| {
        let (mut density, mut transform) = (0.0, 0.0);
        for other in sample {
            let kernel = width * other;
            let x = (value - other) / kernel;
            // f(λ) = (1/p) Σ 3/(4√5 h_j) [1 − x²/5]⁺
            density += 0.75 / root * (1.0 - x * x / 5.0).max(0.0) / kernel;
            // H(λ) = (1/p) Σ {−3x/10 + 3/(4√5) (1 − x²/5) ln|(√5 − x)/(√5 + x)|}/(π h_j)
            let edge = ((root - x) / (root + x)).abs();
            let bent = if edge > 0.0 && edge < f64::INFINITY {
                0.75 / root * (1.0 - x * x / 5.0) * ln(edge)
            } else {
                0.0
            };
            transform += (bent - 0.3 * x) / (PI * kernel);
        }
        let (density, transform) = (density / count, transform / count);
        // d = λ/{[π c λ f]² + [1 − c − π c λ H]²}
        let (across, along) = (PI * share * value * density, 1.0 - share - PI * share * value * transform);
        value / (across * across + along * along)
    };
    sample.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::eigenvalues;
    use nalgebra::{DMatrix, DVector, SymmetricEigen};
    use real::elementary::ln;
    use uncertainty::normal::quantiles;
    use uncertainty::random::{bits, key, unit};

    const DIMENSIONS: usize = 24;
    const DRAWS: usize = 64;

    /// A covariance that is narrow in six directions, none along a coordinate.
    fn truth() -> DMatrix<f64> {
        // Householder's reflection I − 2vvᵀ applied to diagonal variances.
        let v = DMatrix::from_fn(DIMENSIONS, 1, |row, _| 1.0 + row as f64).normalize();
        let reflection = DMatrix::identity(DIMENSIONS, DIMENSIONS) - 2.0 * &v * v.transpose();
        let variance = |row: usize| if row.is_multiple_of(4) { 0.0025 } else { 1.0 };
        let diagonal = DMatrix::from_diagonal(&DVector::from_fn(DIMENSIONS, |row, _| variance(row)));
        &reflection * diagonal * &reflection
    }

    /// The covariance of `DRAWS` draws from a normal distribution about zero.
    fn of_draws(truth: &DMatrix<f64>, seed: u64) -> DMatrix<f64> {
        let lower = truth.clone().cholesky().unwrap().unpack();
        let columns: Vec<f64> = (0..DRAWS as u64)
            .flat_map(|draw| {
                let mut column: [f64; DIMENSIONS] =
                    std::array::from_fn(|row| unit(bits(key(seed, &[draw]), row as u64)));
                quantiles(&mut column);
                column
            })
            .collect();
        let draws = lower * DMatrix::from_vec(DIMENSIONS, DRAWS, columns);
        &draws * draws.transpose() / DRAWS as f64
    }

    fn triangle(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
        (0..DIMENSIONS).map(|row| (0..=row).map(|column| matrix[(row, column)]).collect()).collect()
    }

    /// The shrunk eigenvalues estimate uᵀ Σ u for the sample eigenvectors u and the true Σ, with a fraction
    /// of the error of the sample eigenvalues.
    #[test]
    fn eigenvalues_are_the_variances_along_their_vectors() {
        let truth = truth();
        let (mut raw, mut better) = (0.0, 0.0);
        for seed in 0..20 {
            let sample = of_draws(&truth, seed);
            let shrunk = eigenvalues(&triangle(&sample), DRAWS).unwrap();
            let shrunk = DMatrix::from_fn(DIMENSIONS, DIMENSIONS, |row, column| {
                shrunk[row.max(column)][row.min(column)]
            });
            let found = SymmetricEigen::new(sample);
            for (value, vector) in found.eigenvalues.iter().zip(found.eigenvectors.column_iter()) {
                let along = |matrix: &DMatrix<f64>| vector.dot(&(matrix * vector));
                let exact = along(&truth);
                let miss = |found: f64| ln(found / exact);
                raw += miss(*value) * miss(*value);
                better += miss(along(&shrunk)) * miss(along(&shrunk));
            }
        }
        let mean = |squares: f64| (squares / (20 * DIMENSIONS) as f64).sqrt();
        assert!(mean(better) < 0.3 && mean(raw) > 0.5, "{} {}", mean(better), mean(raw));
    }

    #[test]
    fn too_few_draws_tell_no_eigenvalues() {
        let triangle = triangle(&of_draws(&truth(), 1));
        assert!(eigenvalues(&triangle, DIMENSIONS + 4).is_none());
        assert!(eigenvalues(&triangle, DIMENSIONS + 5).is_some());
    }
}
