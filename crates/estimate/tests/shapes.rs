//! Posteriors that are far from normal.

use estimate::{DrawnQuantity, Independent, ParticleSettings, Verdict, sample_quietly};
use real::elementary::{exp, ln};
use uncertainty::normal::cumulative;
use uncertainty::{Distribution, Estimate};

use super::{assert_converged, assert_near, by_function, integral, ln_normal, posterior, standard};

/// φ(z)
fn density(z: f64) -> f64 {
    exp(ln_normal(z, 0.0, 1.0))
}

/// ln(eᵃ + eᵇ)
fn ln_sum(a: f64, b: f64) -> f64 {
    let most = a.max(b);
    most + ln(exp(a - most) + exp(b - most))
}

/// ln ∫ N(x; 0, 1) N(m; x, s²) dx = ln N(m; 0, 1 + s²) for each coordinate.
fn ln_mode(dimensions: usize, mean: f64, sd: f64) -> f64 {
    dimensions as f64 * ln_normal(mean, 0.0, (1.0 + sd * sd).sqrt())
}

#[test]
fn two_modes_have_their_weights() {
    for (dimensions, particles) in [(1, 512), (2, 512), (3, 4096)] {
        let mode = |values: &[f64], mean: f64, sd: f64| -> f64 {
            values.iter().map(|value| ln_normal(*value, mean, sd)).sum()
        };
        let (near, far) = ((-1.0, 0.1), (1.5, 0.05));
        let found = posterior(&standard(dimensions), particles, |values| {
            ln_sum(ln(0.3) + mode(values, near.0, near.1), ln(0.7) + mode(values, far.0, far.1))
        });
        assert_converged(&found);
        let first = ln(0.3) + ln_mode(dimensions, near.0, near.1);
        let second = ln(0.7) + ln_mode(dimensions, far.0, far.1);
        let exact = ln_sum(first, second);
        assert_near(found.log_evidence(), exact, 0.1);
        let share = exp(second - exact);
        let above = found.draws().probability_above(&found.values()[0], 0.25);
        assert_near(above, share, 0.03);
        let modes = &found.diagnosis().modes;
        let seen = modes.iter().filter(|mode| mode.quantity == DrawnQuantity::Value(0)).count();
        assert_eq!(seen, 2, "{modes:?}");
    }
}

/// The posterior is ten thousand times narrower than the prior.
#[test]
fn evidence_may_be_tight() {
    for dimensions in [1, 5, 12] {
        let sd = 1e-4;
        let found = posterior(&standard(dimensions), 512, |values| {
            values.iter().map(|value| ln_normal(*value, 0.7, sd)).sum()
        });
        assert_converged(&found);
        assert_near(found.log_evidence(), ln_mode(dimensions, 0.7, sd), 0.15);
        for place in 0..dimensions {
            let summary = found.summary(DrawnQuantity::Value(place));
            assert_near(summary.mean, 0.7 / (1.0 + sd * sd), 0.05 * sd);
            assert_near(summary.sd, sd, 0.05 * sd);
        }
    }
}

/// A ridge: only a sum is known, to a thousandth.
#[test]
fn what_is_not_measured_keeps_its_prior() {
    let dimensions = 8;
    let found = posterior(&standard(dimensions), 512, |values| ln_normal(3.0, values.iter().sum(), 1e-3));
    assert_converged(&found);
    let spread = (dimensions as f64).sqrt();
    assert_near(found.log_evidence(), ln_normal(3.0, 0.0, (spread * spread + 1e-6).sqrt()), 0.1);
    let summary = found.summary(DrawnQuantity::Value(2));
    assert_near(summary.mean, 3.0 / 8.0, 0.04);
    // σ² = 1 − 1/d
    assert_near(summary.sd, (7.0_f64 / 8.0).sqrt(), 0.04);
}

#[test]
fn a_banana_is_bent_as_it_should_be() {
    let sd = 0.05;
    let found = posterior(&standard(2), 1024, |values| ln_normal(values[1], values[0] * values[0] - 0.5, sd));
    assert_converged(&found);
    // y integrated out: ∫ N(y; 0, 1) N(y; x² − ½, s²) dy = N(x² − ½; 0, 1 + s²)
    let marginal = |x: f64| density(x) * exp(ln_normal(x * x - 0.5, 0.0, (1.0 + sd * sd).sqrt()));
    let evidence = integral(-8.0, 8.0, marginal);
    assert_near(found.log_evidence(), ln(evidence), 0.06);
    let square = integral(-8.0, 8.0, |x| x * x * marginal(x)) / evidence;
    let summary = found.summary(DrawnQuantity::Value(0));
    assert_near(summary.mean, 0.0, 0.05);
    assert_near(summary.sd, square.sqrt(), 0.03);
    let height = integral(-8.0, 8.0, |x| (x * x - 0.5) / (1.0 + sd * sd) * marginal(x)) / evidence;
    assert_near(found.summary(DrawnQuantity::Value(1)).mean, height, 0.03);
}

#[test]
fn a_ring_is_round() {
    let found = posterior(&standard(2), 1024, |values| {
        ln_normal((values[0] * values[0] + values[1] * values[1]).sqrt(), 1.5, 0.02)
    });
    assert_converged(&found);
    // ∫ r e^(−r²/2) N(r; 1.5, s²) dr
    let radial = |r: f64| r * exp(-0.5 * r * r) * exp(ln_normal(r, 1.5, 0.02));
    let evidence = integral(0.0, 8.0, radial);
    assert_near(found.log_evidence(), ln(evidence), 0.08);
    let square = integral(0.0, 8.0, |r| r * r * radial(r)) / evidence;
    for place in 0..2 {
        let summary = found.summary(DrawnQuantity::Value(place));
        assert_near(summary.mean, 0.0, 0.06);
        assert_near(summary.sd, (0.5 * square).sqrt(), 0.04);
    }
}

/// A density that rises up to the end of the prior: 1 − x has the density 50 e^(−50 (1 − x)).
#[test]
fn a_posterior_may_lie_at_the_edge_of_the_prior() {
    let prior = Independent(vec![Distribution::uniform(0.0, 1.0).unwrap(); 2]);
    let found = posterior(&prior, 512, |values| 50.0 * (values[0] - 1.0));
    assert_converged(&found);
    assert_near(found.log_evidence(), ln((1.0 - exp(-50.0)) / 50.0), 0.06);
    let summary = found.summary(DrawnQuantity::Value(0));
    assert_near(summary.mean, 1.0 - 0.02, 0.001);
    // Quantiles 1 + ln(p)/50
    assert_near(summary.intervals[3].low, 1.0 + ln(0.025) / 50.0, 0.006);
    assert!(found.values()[0].iter().all(|value| *value <= 1.0));
    assert_near(found.summary(DrawnQuantity::Value(1)).mean, 0.5, 0.02);
}

#[test]
fn what_is_impossible_is_cut_off() {
    let found = posterior(&standard(3), 256, |values| if values[0] > 2.5 { 0.0 } else { f64::NEG_INFINITY });
    assert_converged(&found);
    let tail = cumulative(-2.5);
    assert_near(found.log_evidence(), ln(tail), 0.05);
    let summary = found.summary(DrawnQuantity::Value(0));
    // φ(a)/Φ(−a)
    assert_near(summary.mean, density(2.5) / tail, 0.02);
    assert!(found.values()[0].iter().all(|value| *value > 2.5));
    assert_near(found.summary(DrawnQuantity::Value(2)).sd, 1.0, 0.03);
}

/// A likelihood with two levels: on a plateau no move is better than another.
#[test]
fn a_likelihood_may_be_a_plateau() {
    let found = posterior(&standard(2), 512, |values| {
        if values[0] * values[0] + values[1] * values[1] < 0.04 { 0.0 } else { -40.0 }
    });
    assert_converged(&found);
    // The prior probability of a circle is 1 − e^(−r²/2).
    assert_near(found.log_evidence(), ln(1.0 - exp(-0.02)), 0.15);
    // ⟨r²⟩ = 2 (1 − (1 + q) e^(−q))/(1 − e^(−q)), q = r²/2; half of it for each coordinate.
    let variance = (1.0 - 1.02 * exp(-0.02)) / (1.0 - exp(-0.02));
    assert_near(found.summary(DrawnQuantity::Value(0)).sd, variance.sqrt(), 0.004);
}

#[test]
fn without_information_the_posterior_is_the_prior() {
    let prior = Independent(vec![
        Distribution::normal(20.0, 5.0).unwrap(),
        Distribution::log_normal(2.0, 0.3).unwrap(),
        Distribution::uniform(-1.0, 3.0).unwrap(),
        Distribution::triangular(0.0, 1.0, 4.0).unwrap(),
        Distribution::truncated_normal(0.1, 0.08, 0.0, 1.0).unwrap(),
        Distribution::truncated_normal(-1.0, 1.0, 0.5, f64::INFINITY).unwrap(),
    ]);
    let found = posterior(&prior, 512, |_| -3.0);
    assert_converged(&found);
    assert_eq!(found.log_evidence(), Estimate { value: -3.0, standard_error: Some(0.0) });
    for (place, distribution) in prior.0.iter().enumerate() {
        let (summary, sd) = (found.summary(DrawnQuantity::Value(place)), distribution.sd());
        assert_near(summary.mean, distribution.mean(), 0.04 * sd);
        assert_near(summary.sd, sd, 0.04 * sd);
        for interval in summary.intervals {
            let end = 0.5 - 0.5 * interval.level;
            assert_near(interval.low, distribution.quantile(end), 0.12 * sd);
            assert_near(interval.high, distribution.quantile(1.0 - end), 0.12 * sd);
        }
    }
}

/// A run without any evidence.
#[test]
fn there_may_be_no_evidence_at_all() {
    let evidence = by_function(0, |_: &[f64], _: &mut [f64]| Ok(()));
    let found = sample_quietly(&standard(1), &evidence, &ParticleSettings::new(256, 1)).unwrap();
    assert_eq!(found.verdict(), Verdict::Converged);
    assert_near(found.summary(DrawnQuantity::Value(0)).mean, 0.0, 0.05);
}

/// Evidence eight standard deviations from the centre of the prior.
#[test]
fn evidence_may_lie_far_out_of_the_prior() {
    let found = posterior(&standard(2), 512, |values| ln_normal(values[0], 8.0, 0.1));
    assert_converged(&found);
    assert_near(found.log_evidence(), ln_mode(1, 8.0, 0.1), 0.12);
    assert_near(found.summary(DrawnQuantity::Value(0)).mean, 8.0 / 1.01, 0.01);
}
