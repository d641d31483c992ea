//! Linear measurements with normal errors and a normal prior: the posterior is known exactly.

use std::ops::ControlFlow;

use estimate::{
    CannotReweight, DrawnQuantity, Evidence, ParticleSettings, Posterior, Selection, sample, sample_quietly,
};
use real::elementary::{ln, sin_cos};
use uncertainty::normal::cumulative;
use uncertainty::{Estimate, LANES, Lanes};

use super::{assert_converged, assert_near, ln_normal, standard};

/// y_k = a_k·x + ε_k, with the standard deviation σ of ε_k.
struct Linear {
    rows: Vec<Vec<f64>>,
    measured: Vec<f64>,
    sd: f64,
}

impl Linear {
    /// Two more measurements than values, in different directions.
    fn new(dimensions: usize, sd: f64) -> Self {
        let measurements = dimensions + 2;
        let entry = |row: usize, column: usize| {
            let (sin, _) = sin_cos((3 * row + 7 * column + row * column) as f64);
            if row == column { 1.0 + 0.3 * sin } else { 0.3 * sin }
        };
        let rows = (0..measurements).map(|row| (0..dimensions).map(|column| entry(row, column)).collect());
        let measured = (0..measurements).map(|row| sin_cos(1.0 + 2.0 * row as f64).0);
        Self { rows: rows.collect(), measured: measured.collect(), sd }
    }

    fn dimensions(&self) -> usize {
        self.rows[0].len()
    }

    /// Mean and covariance of the posterior given some of the measurements: Λ = 1 + Σ a aᵀ/σ², Λ m = Σ a
    /// y/σ².
    fn posterior(&self, used: &[usize]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let dimensions = self.dimensions();
        let variance = self.sd * self.sd;
        let identity = |row: usize, column: usize| if row == column { 1.0 } else { 0.0 };
        let precision = |row: usize, column: usize| {
            let sum: f64 = used.iter().map(|&k| self.rows[k][row] * self.rows[k][column]).sum();
            identity(row, column) + sum / variance
        };
        let matrix = square(dimensions, precision);
        let right =
            |row: usize| used.iter().map(|&k| self.rows[k][row] * self.measured[k]).sum::<f64>() / variance;
        let mean = solve(&matrix, &(0..dimensions).map(right).collect::<Vec<_>>()).0;
        let column = |column: usize| {
            let unit: Vec<f64> = (0..dimensions).map(|row| identity(row, column)).collect();
            solve(&matrix, &unit).0
        };
        (mean, (0..dimensions).map(column).collect())
    }

    /// ln of the density of y ~ N(0, A Aᵀ + σ²).
    fn log_evidence(&self) -> f64 {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let covariance = square(self.rows.len(), |row, column| {
            let noise = if row == column { self.sd * self.sd } else { 0.0 };
            dot(&self.rows[row], &self.rows[column]) + noise
        });
        let (solved, log_determinant) = solve(&covariance, &self.measured);
        let normalisation = self.rows.len() as f64 * ln(std::f64::consts::TAU);
        -0.5 * (dot(&self.measured, &solved) + log_determinant + normalisation)
    }

    /// Mean and standard deviation of measurement k predicted by the others.
    fn prediction(&self, k: usize) -> (f64, f64) {
        let others: Vec<usize> = (0..self.rows.len()).filter(|&other| other != k).collect();
        let (mean, covariance) = self.posterior(&others);
        let row = &self.rows[k];
        let predicted = row.iter().zip(&mean).map(|(a, m)| a * m).sum();
        let mut variance = self.sd * self.sd;
        for (a, column) in row.iter().zip(&covariance) {
            variance += a * column.iter().zip(row).map(|(s, b)| s * b).sum::<f64>();
        }
        (predicted, variance.sqrt())
    }
}

impl Evidence for Linear {
    fn terms_count(&self) -> usize {
        self.rows.len()
    }

    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], _reasons: &mut [u8; LANES]) {
        for ((row, measured), term) in self.rows.iter().zip(&self.measured).zip(terms) {
            for (lane, term) in term.iter_mut().enumerate() {
                let predicted = row.iter().zip(values).map(|(a, column)| a * column[lane]).sum();
                *term = ln_normal(*measured, predicted, self.sd);
            }
        }
    }

    fn outputs_count(&self) -> usize {
        1
    }

    fn describe(&self, values: &[Lanes], outputs: &mut [Lanes], residuals: &mut [Lanes]) {
        for lane in 0..LANES {
            outputs[0][lane] = values.iter().map(|column| column[lane]).sum();
            for ((row, measured), residual) in self.rows.iter().zip(&self.measured).zip(residuals.iter_mut())
            {
                let predicted: f64 = row.iter().zip(values).map(|(a, column)| a * column[lane]).sum();
                residual[lane] = (measured - predicted) / self.sd;
            }
        }
    }
}

fn square(count: usize, entry: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    (0..count).map(|row| (0..count).map(|column| entry(row, column)).collect()).collect()
}

/// Solution of a symmetric positive definite system, and ln of its determinant, by Gaussian elimination.
fn solve(matrix: &[Vec<f64>], right: &[f64]) -> (Vec<f64>, f64) {
    let mut rows: Vec<Vec<f64>> = matrix.to_vec();
    let mut right = right.to_vec();
    let mut log_determinant = 0.0;
    for pivot in 0..rows.len() {
        log_determinant += ln(rows[pivot][pivot]);
        for row in pivot + 1..rows.len() {
            let above = rows[pivot].clone();
            let factor = rows[row][pivot] / above[pivot];
            for (entry, above) in rows[row].iter_mut().zip(&above) {
                *entry -= factor * above;
            }
            right[row] -= factor * right[pivot];
        }
    }
    for row in (0..rows.len()).rev() {
        let known: f64 = (row + 1..rows.len()).map(|column| rows[row][column] * right[column]).sum();
        right[row] = (right[row] - known) / rows[row][row];
    }
    (right, log_determinant)
}

fn run(linear: &Linear, particles: usize, seed: u64) -> Posterior {
    let settings = ParticleSettings::new(particles, seed);
    sample_quietly(&standard(linear.dimensions()), linear, &settings).unwrap()
}

/// ⟨(x_i − m_i)(x_j − m_j)⟩ with the exact means.
fn product(posterior: &Posterior, mean: &[f64], [i, j]: [usize; 2]) -> Estimate {
    let values = posterior.values();
    let column: Vec<f64> =
        values[i].iter().zip(&values[j]).map(|(x, y)| (x - mean[i]) * (y - mean[j])).collect();
    posterior.draws().summary(&column).mean
}

#[test]
fn mean_covariance_and_evidence_are_exact_in_one_to_twenty_dimensions() {
    for (dimensions, sd, particles) in [(1, 0.1, 256), (3, 0.5, 256), (10, 0.2, 512), (20, 0.3, 1024)] {
        let linear = Linear::new(dimensions, sd);
        let posterior = run(&linear, particles, 1);
        assert_converged(&posterior);
        let (mean, covariance) = linear.posterior(&(0..linear.rows.len()).collect::<Vec<_>>());
        for (place, (mean, row)) in mean.iter().zip(&covariance).enumerate() {
            let summary = posterior.summary(DrawnQuantity::Value(place));
            let deviation = row[place].sqrt();
            assert_near(summary.mean, *mean, 0.05 * deviation);
            assert_near(summary.sd, deviation, 0.05 * deviation);
            // The 97.5 % of a normal distribution
            assert_near(summary.intervals[3].high, mean + 1.959_964 * deviation, 0.1 * deviation);
            assert_near(summary.median, *mean, 0.06 * deviation);
        }
        for pair in [[0, dimensions - 1], [dimensions / 2, dimensions / 3]] {
            let exact = covariance[pair[0]][pair[1]];
            let scale = (covariance[pair[0]][pair[0]] * covariance[pair[1]][pair[1]]).sqrt();
            assert_near(product(&posterior, &mean, pair), exact, 0.05 * scale);
        }
        assert_near(posterior.log_evidence(), linear.log_evidence(), 0.12);
        // The output is the sum of all values.
        assert_near(posterior.summary(DrawnQuantity::Output(0)).mean, mean.iter().sum(), 0.1);
    }
}

/// Standard errors are as large as the errors: over 30 seeds, the mean square of the error divided by the
/// standard error is that of Student's t, 15/13, within 4.5 of its own standard deviations (√(2/30)·1.5).
#[test]
fn standard_errors_are_those_of_repeated_runs() {
    let linear = Linear::new(2, 0.3);
    let (mean, covariance) = linear.posterior(&[0, 1, 2, 3]);
    let mut squares = [0.0; 4];
    const SEEDS: u64 = 30;
    for seed in 0..SEEDS {
        let posterior = run(&linear, 128, 100 + seed);
        let summary = posterior.summary(DrawnQuantity::Value(0));
        let deviation = covariance[0][0].sqrt();
        let end = mean[0] - 1.281_552 * deviation;
        let above = posterior.draws().probability_above(&posterior.values()[0], end);
        let found = [
            (summary.mean, mean[0]),
            (summary.intervals[1].low, end),
            (above, 0.9),
            (posterior.log_evidence(), linear.log_evidence()),
        ];
        for (sum, (estimate, exact)) in squares.iter_mut().zip(found) {
            let z = (estimate.value - exact) / estimate.standard_error.unwrap();
            *sum += z * z / SEEDS as f64;
        }
    }
    // Standard errors of quantiles and probabilities have a floor, so they may be too large.
    for (place, square) in squares.into_iter().enumerate() {
        assert!((0.3..2.9).contains(&square), "{place}: {squares:?}");
    }
}

/// By weights, if they report that they are reliable, and by another run.
#[test]
fn an_answer_without_a_piece_is_that_of_a_run_without_it() {
    let mut by_weights = 0;
    for (sd, seed) in [(0.5, 3), (1.0, 4), (2.0, 5)] {
        let linear = Linear::new(3, sd);
        let posterior = run(&linear, 512, seed);
        for left_out in 0..5 {
            let others: Vec<usize> = (0..5).filter(|&other| other != left_out).collect();
            let (mean, covariance) = linear.posterior(&others);
            let weights = posterior.without(&[left_out]).unwrap();
            let mut settings = ParticleSettings::new(512, 4);
            settings.terms = Selection::Without(vec![left_out]);
            let again = sample_quietly(&standard(3), &linear, &settings).unwrap();
            by_weights += usize::from(weights.are_reliable());
            for (place, (mean, row)) in mean.iter().zip(&covariance).enumerate() {
                let weighted = posterior.weighted(&weights).summary(&posterior.values()[place]);
                let summary = again.summary(DrawnQuantity::Value(place));
                for (draws, is_told) in [(weighted, weights.are_reliable()), (summary, true)] {
                    if is_told {
                        assert_near(draws.mean, *mean, 0.1 * row[place].sqrt());
                        assert_near(draws.sd, row[place].sqrt(), 0.1 * row[place].sqrt());
                    }
                }
            }
        }
    }
    assert!(by_weights >= 8, "only {by_weights} of 15 by weights");
    let linear = Linear::new(3, 0.5);
    let (mean, _) = linear.posterior(&[1]);
    let mut settings = ParticleSettings::new(256, 5);
    settings.terms = Selection::Only(vec![1]);
    let alone = sample_quietly(&standard(3), &linear, &settings).unwrap();
    assert_near(alone.summary(DrawnQuantity::Value(1)).mean, mean[1], 0.05);
    assert_eq!(alone.used(), [false, true, false, false, false]);
}

/// With a piece in addition to those used, if the weights are reliable and enough draws count.
#[test]
fn an_answer_with_a_piece_is_that_of_both() {
    let mut by_weights = 0;
    for (sd, seed) in [(0.5, 3), (1.0, 4), (2.0, 5)] {
        let linear = Linear::new(3, sd);
        let mut settings = ParticleSettings::new(512, seed);
        settings.terms = Selection::Only(vec![0, 1, 2]);
        let without = sample_quietly(&standard(3), &linear, &settings).unwrap();
        for added in [3, 4] {
            let (mean, covariance) = linear.posterior(&[0, 1, 2, added]);
            let weights = without.with(added).unwrap();
            let worth = without.worth(&weights);
            assert!(worth > 0.0 && worth < without.diagnosis().ess(), "{worth}");
            if !weights.are_reliable() || worth < 400.0 {
                continue;
            }
            by_weights += 1;
            for (place, (mean, row)) in mean.iter().zip(&covariance).enumerate() {
                let weighted = without.weighted(&weights).summary(&without.values()[place]);
                assert_near(weighted.mean, *mean, 0.1 * row[place].sqrt());
                assert_near(weighted.sd, row[place].sqrt(), 0.1 * row[place].sqrt());
            }
        }
        // A piece that is already used changes no weights.
        assert!(without.with(1).unwrap().weights.iter().all(|weight| *weight == 1.0));
        assert_eq!(without.with(5).unwrap_err(), CannotReweight::NoSuchTerm { term: 5, terms: 5 });
    }
    assert!(by_weights >= 4, "only {by_weights} of 6 by weights");
}

/// The place of a measurement in the prediction of the others, with the weights and by a run without it.
#[test]
fn a_check_is_the_tail_of_the_prediction() {
    let linear = Linear::new(3, 1.0);
    let posterior = run(&linear, 512, 6);
    for term in 0..5 {
        let (predicted, sd) = linear.prediction(term);
        let exact = cumulative((linear.measured[term] - predicted) / sd);
        let check = posterior.check(term).unwrap();
        if check.is_reliable() {
            assert_near(check.below, exact, 0.03);
            assert_near(check.p_value, 2.0 * exact.min(1.0 - exact), 0.06);
        }
        let mut settings = ParticleSettings::new(256, 7);
        settings.terms = Selection::Without(vec![term]);
        let progress = &mut |_, _| ControlFlow::Continue(());
        let again = sample(&standard(3), &linear, &settings, progress).unwrap().check(term).unwrap();
        assert!(again.weights.is_none());
        assert_near(again.below, exact, 0.03);
    }
}

/// Measurements that cannot both be right: an answer between them, and a small p-value.
#[test]
fn contradictory_measurements_have_an_answer_and_a_small_p_value() {
    let mut linear = Linear::new(2, 0.05);
    linear.rows[1] = linear.rows[0].clone();
    linear.measured[0] = 0.5;
    linear.measured[1] = 1.0;
    let posterior = run(&linear, 512, 8);
    assert_converged(&posterior);
    let (mean, covariance) = linear.posterior(&[0, 1, 2, 3]);
    assert_near(posterior.summary(DrawnQuantity::Value(0)).mean, mean[0], 0.05 * covariance[0][0].sqrt());
    assert_near(posterior.log_evidence(), linear.log_evidence(), 0.1);
    // The draws are too far from those without the piece, and the weights report it.
    let check = posterior.check(0).unwrap();
    let (predicted, sd) = linear.prediction(0);
    let exact = 2.0 * cumulative(-((0.5 - predicted) / sd).abs());
    assert!(exact < 1e-8 && !check.is_reliable(), "{exact} {check:?}");
    let mut settings = ParticleSettings::new(512, 9);
    settings.terms = Selection::Without(vec![0]);
    let again = sample_quietly(&standard(2), &linear, &settings).unwrap().check(0).unwrap();
    assert!(again.p_value.value < 1e-6, "{again:?}");
}

/// Draws that start from those with all pieces, compared with the exact posterior without one, and their
/// evidence with that of a run from the prior.
#[test]
fn a_piece_fades_out_of_the_draws() {
    for (sd, seed) in [(0.5, 3), (0.1, 4)] {
        let linear = Linear::new(3, sd);
        let posterior = run(&linear, 512, seed);
        for left_out in [0, 3] {
            let others: Vec<usize> = (0..5).filter(|&other| other != left_out).collect();
            let (mean, covariance) = linear.posterior(&others);
            let settings = ParticleSettings { islands: 8, ..ParticleSettings::new(256, 4) };
            let faded =
                estimate::sample_without(&standard(3), &linear, &posterior, left_out, &settings).unwrap();
            for (place, (mean, row)) in mean.iter().zip(&covariance).enumerate() {
                let summary = faded.summary(DrawnQuantity::Value(place));
                assert_near(summary.mean, *mean, 0.2 * row[place].sqrt());
                assert_near(summary.sd, row[place].sqrt(), 0.2 * row[place].sqrt());
            }
            assert!(!faded.used()[left_out] && faded.used().iter().filter(|used| **used).count() == 4);
            let terms = Selection::Without(vec![left_out]);
            let again = ParticleSettings { terms, ..settings };
            let again = sample_quietly(&standard(3), &linear, &again).unwrap();
            let difference = faded.log_evidence().value - again.log_evidence().value;
            let [one, other] = [&faded, &again].map(|run| run.log_evidence().standard_error.unwrap());
            assert!(
                difference.abs() < 4.0 * (one * one + other * other).sqrt() + 0.1,
                "{sd} {left_out}: {difference} {one} {other}"
            );
        }
    }
}

/// A piece that is not used, or settings that do not fit the draws, are refused.
#[test]
fn only_a_piece_that_is_used_fades() {
    let linear = Linear::new(3, 0.5);
    let posterior = run(&linear, 256, 3);
    let without = |term: usize, settings: &ParticleSettings| {
        estimate::sample_without(&standard(3), &linear, &posterior, term, settings).unwrap_err()
    };
    assert!(matches!(
        without(5, &ParticleSettings::new(128, 1)),
        estimate::NoDraws::NoSuchTerm { term: 5, terms: 5 }
    ));
    assert!(matches!(
        without(0, &ParticleSettings::new(512, 1)),
        estimate::NoDraws::Particles { particles: 512 }
    ));
    let many = ParticleSettings { islands: 17, ..ParticleSettings::new(128, 1) };
    assert!(matches!(without(0, &many), estimate::NoDraws::Islands { islands: 17 }));
}

/// Evidence in which only an unused piece excludes half of the prior.
struct Half;

impl Evidence for Half {
    fn terms_count(&self) -> usize {
        2
    }

    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], reasons: &mut [u8; LANES]) {
        self.log_likelihood_of_used(values, &[true, false], terms, reasons);
        for ((reason, term), value) in reasons.iter_mut().zip(terms[1].iter_mut()).zip(&values[0]) {
            *term = 0.0;
            *reason = u8::from(*value > 0.0);
        }
    }

    fn log_likelihood_of_used(
        &self,
        values: &[Lanes],
        _used: &[bool],
        terms: &mut [Lanes],
        _reasons: &mut [u8; LANES],
    ) {
        for (term, value) in terms[0].iter_mut().zip(&values[1]) {
            *term = -0.5 * (value - 1.0) * (value - 1.0);
        }
    }
}

/// Draws that the whole model finds impossible are removed, and the evidence accounts for their fraction: Z
/// is half of ∫ N(x; 0, 1) exp(−½(x − 1)²) dx = exp(−¼)/√2.
#[test]
fn what_is_impossible_is_taken_out_at_the_end() {
    let settings = ParticleSettings { terms: Selection::Only(vec![0]), ..ParticleSettings::new(512, 2) };
    let posterior = sample_quietly(&standard(2), &Half, &settings).unwrap();
    assert!(posterior.values()[0].iter().all(|value| *value <= 0.0));
    let exact = -0.25 - 1.5 * std::f64::consts::LN_2;
    let found = posterior.log_evidence().value;
    assert!((found - exact).abs() < 0.05, "{found} is not {exact}");
    assert_near(posterior.summary(DrawnQuantity::Value(1)).mean, 0.5, 0.05);
}
