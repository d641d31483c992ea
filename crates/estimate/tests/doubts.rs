//! Cases made to fool the diagnosis, and its verdicts.

use estimate::{Culprit, NoDraws, ParticleSettings, Posterior, SamplerDoubt, Verdict, sample_quietly};
use real::elementary::{exp, ln};

use super::{by_function, ln_normal, posterior, standard};

/// Half of the posterior is wide, around −0.5, and half is a mode at `at` with the standard deviation `sd`,
/// in all dimensions; also returns the fraction of the draws in that mode.
fn hidden(dimensions: usize, [at, sd]: [f64; 2], particles: usize, seed: u64) -> (Posterior, f64) {
    let mode = |values: &[f64], mean: f64, sd: f64| {
        let likelihood: f64 = values.iter().map(|value| ln_normal(*value, mean, sd)).sum();
        // Divided by its own evidence, so that both modes have the same.
        likelihood - dimensions as f64 * ln_normal(mean, 0.0, (1.0 + sd * sd).sqrt())
    };
    let evidence = by_function(1, |values: &[f64], terms: &mut [f64]| {
        let (wide, narrow) = (mode(values, -0.5, 0.6), mode(values, at, sd));
        let most = wide.max(narrow);
        terms[0] = most + ln(exp(wide - most) + exp(narrow - most)) - ln(2.0);
        Ok(())
    });
    let found =
        sample_quietly(&standard(dimensions), &evidence, &ParticleSettings::new(particles, seed)).unwrap();
    let is_in = |draw: usize| found.values().iter().all(|column| (column[draw] - at).abs() < 5.0 * sd);
    let share = (0..found.count()).filter(|&draw| is_in(draw)).count() as f64 / found.count() as f64;
    (found, share)
}

/// A mode of a thousandth of the prior or less holds half of the posterior. If at least a fiftieth of the
/// draws have found it, but not its half, the run is not called converged.
///
/// In one dimension independent proposals lead all islands equally into such a mode, after the last
/// temperature step, and islands that are equally wrong do not disagree.
#[test]
fn a_mode_that_few_particles_found_is_doubted() {
    let (mut doubted, mut missed) = (0, 0);
    for (dimensions, mode, particles) in [
        (3, [1.2, 0.1], 128),
        (3, [1.6, 0.1], 128),
        (2, [2.5, 0.1], 128),
        (2, [2.5, 0.1], 512),
        (5, [1.2, 0.1], 512),
    ] {
        for seed in 0..8 {
            let (found, share) = hidden(dimensions, mode, particles, seed);
            if (0.02..0.4).contains(&share) {
                let Verdict::NotConverged(doubts) = found.verdict() else {
                    panic!("{dimensions} {mode:?} {particles} {seed}: {share} {:?}", found.diagnosis());
                };
                assert!(!doubts.is_empty());
                doubted += 1;
            }
            missed += usize::from(share < 0.02);
        }
    }
    assert!(doubted >= 16, "{doubted} doubted, {missed} missed");
}

/// The limit of any such method: a mode that no particle has found is missed, and the verdict does not show
/// it.
#[test]
fn a_mode_that_no_particle_has_met_is_not_seen() {
    // The mode has about 1e-7 of the prior.
    let (found, share) = hidden(3, [2.2, 0.05], 128, 1);
    assert_eq!(share, 0.0);
    assert_eq!(found.verdict(), Verdict::Converged);
    assert!((found.log_evidence().value - ln(0.5)).abs() < 0.1);
}

/// Enough particles find the same mode, which then has its half.
#[test]
fn enough_particles_find_the_mode() {
    let (found, share) = hidden(1, [3.0, 0.03], 4096, 1);
    assert_eq!(found.verdict(), Verdict::Converged, "{:?}", found.diagnosis());
    assert!((share - 0.5).abs() < 0.05, "{share}");
    assert!(found.log_evidence().value.abs() < 0.05);
}

/// A ring a thousandth wide: moves along it are hardly ever accepted.
#[test]
fn particles_that_stand_still_are_told() {
    let found = posterior(&standard(2), 256, |values| {
        ln_normal((values[0] * values[0] + values[1] * values[1]).sqrt(), 1.5, 1e-4)
    });
    let Verdict::NotConverged(doubts) = found.verdict() else { panic!("{:?}", found.diagnosis()) };
    assert!(doubts.iter().any(|doubt| matches!(doubt, SamplerDoubt::StoodStill { .. })), "{doubts:?}");
    let words = doubts.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    assert!(words.contains("of the particles did not move at the end"), "{words}");
}

/// Limits that leave 2e-4 and 3e-5 of the prior.
#[test]
fn a_prior_that_hardly_agrees_is_told() {
    let beyond = |limit: f64| {
        let evidence = by_function(1, move |values: &[f64], terms: &mut [f64]| {
            terms[0] = if values[0] > limit { 0.0 } else { f64::NEG_INFINITY };
            Ok(())
        });
        sample_quietly(&standard(1), &evidence, &ParticleSettings::new(128, 1))
    };
    let found = beyond(3.5).unwrap();
    let Verdict::NotConverged(doubts) = found.verdict() else { panic!("{:?}", found.diagnosis()) };
    assert!(doubts.iter().any(|doubt| matches!(doubt, SamplerDoubt::HardlyPossible { .. })), "{doubts:?}");
    let Err(NoDraws::Impossible(exclusion)) = beyond(4.0) else { panic!("an answer") };
    assert_eq!(exclusion.culprit(), Culprit::None);
    assert!(exclusion.possible > 0 && exclusion.to_string().starts_with("only "), "{exclusion}");
}

/// A funnel: the standard deviation of four values depends on a fifth, to which the moves adapt too late.
#[test]
fn islands_that_disagree_are_told() {
    let found = posterior(&standard(5), 128, |values| {
        let ln_sd = 1.5 * values[0];
        values[1..].iter().map(|value| ln_normal(*value, 0.5, exp(ln_sd))).sum()
    });
    let Verdict::NotConverged(doubts) = found.verdict() else { panic!("{:?}", found.diagnosis()) };
    assert!(doubts.iter().any(|doubt| matches!(doubt, SamplerDoubt::Disagreement { .. })), "{doubts:?}");
}
