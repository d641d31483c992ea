//! The tests of the sampler, in one binary. Expected values are closed forms or quadratures.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "tests")]

mod calibration;
mod conjugate;
mod determinism;
mod doubts;
mod refusals;
mod shapes;

use estimate::{Independent, LikelihoodFunction, ParticleSettings, Posterior, Verdict, sample_quietly};
use real::elementary::ln;
use uncertainty::{Distribution, Estimate};

/// Standard normal values.
fn standard(count: usize) -> Independent {
    Independent(vec![Distribution::normal(0.0, 1.0).unwrap(); count])
}

type Function<'a> = Box<dyn Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync + 'a>;

/// Evidence from a function. In a box, it is of one type: the sampler is compiled once for all of them.
fn by_function<'a>(
    terms: usize,
    function: impl Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync + 'a,
) -> LikelihoodFunction<Function<'a>> {
    LikelihoodFunction::new(terms, Box::new(function))
}

/// A run with one term of evidence.
fn posterior(
    prior: &Independent,
    particles: usize,
    log_likelihood: impl Fn(&[f64]) -> f64 + Sync,
) -> Posterior {
    let evidence = by_function(1, |values: &[f64], terms: &mut [f64]| {
        terms[0] = log_likelihood(values);
        Ok(())
    });
    sample_quietly(prior, &evidence, &ParticleSettings::new(particles, 1)).unwrap()
}

/// ln of the density of N(mean, sd²).
fn ln_normal(value: f64, mean: f64, sd: f64) -> f64 {
    let z = (value - mean) / sd;
    -0.5 * z * z - ln(sd) - 0.5 * ln(std::f64::consts::TAU)
}

/// Within 4.5 of its own standard errors, which must not exceed `most`: by Student's t with 15 degrees of
/// freedom one in 2000 is farther out.
#[track_caller]
fn assert_near(found: Estimate, exact: f64, most: f64) {
    let error = found.standard_error.unwrap();
    assert!(error <= most, "a standard error of {error}, of {found:?}");
    assert!((found.value - exact).abs() <= 4.5 * error, "{found:?} is not {exact}");
}

#[track_caller]
fn assert_converged(posterior: &Posterior) {
    assert_eq!(posterior.verdict(), Verdict::Converged, "{:?}", posterior.diagnosis());
}

/// ∫ f(x) dx between two ends: Simpson's rule.
fn integral(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 200_000;
    let step = (high - low) / f64::from(STEPS);
    let term = |index: u32| {
        let weight = if index == 0 || index == STEPS { 1.0 } else { f64::from(2 + 2 * (index % 2)) };
        weight * f(low + step * f64::from(index))
    };
    (0..=STEPS).map(term).sum::<f64>() * step / 3.0
}
