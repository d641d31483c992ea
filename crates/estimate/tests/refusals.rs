//! Cases without an answer.

use std::ops::ControlFlow;

use estimate::{
    CannotReweight, Culprit, DrawnQuantity, Exclusion, Independent, NoDraws, PARTICLES_STEP,
    ParticleSettings, Selection, Weights, sample, sample_quietly,
};

use super::{by_function, ln_normal, posterior, standard};

fn refusal<F: Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync>(terms: usize, function: F) -> NoDraws {
    let evidence = by_function(terms, function);
    sample_quietly(&standard(2), &evidence, &ParticleSettings::new(PARTICLES_STEP, 1)).unwrap_err()
}

#[track_caller]
fn exclusion(failure: NoDraws) -> Exclusion {
    let NoDraws::Impossible(exclusion) = failure else { panic!("{failure:?}") };
    exclusion
}

fn limit(holds: bool) -> f64 {
    if holds { 0.0 } else { f64::NEG_INFINITY }
}

#[test]
fn impossible_evidence_is_refused_with_what_excludes_what() {
    let alone = refusal(3, |x, terms| {
        terms.copy_from_slice(&[limit(x[0] > 0.0), limit(x[1] > 100.0), 0.0]);
        Ok(())
    });
    assert!(alone.to_string().contains("evidence 1 alone excludes all of"), "{alone}");
    assert_eq!(exclusion(alone).culprit(), Culprit::Term(1));

    let pair = refusal(3, |x, terms| {
        terms.copy_from_slice(&[limit(x[0] > 0.5), 0.0, limit(x[0] < 0.4)]);
        Ok(())
    });
    let told = pair.to_string();
    assert!(told.contains("evidence 0 and evidence 2 are possible alone, but together"), "{told}");
    let found = exclusion(pair);
    assert_eq!(found.culprit(), Culprit::Pair(0, 2));
    // The fractions Φ(−0.5) and Φ(0.4) of the draws are possible.
    let share = |term: usize| 1.0 - found.by_term[term] as f64 / found.drawn as f64;
    assert!((share(0) - 0.308_54).abs() < 0.003 && (share(2) - 0.655_42).abs() < 0.003, "{found:?}");

    // Each pair is possible somewhere, all three nowhere.
    let three = refusal(3, |x, terms| {
        let place = if x[0] < -0.4 { 0 } else { usize::from(x[0] > 0.4) + 1 };
        for (term, excluded) in terms.iter_mut().zip(0..) {
            *term = limit(place != excluded);
        }
        Ok(())
    });
    assert_eq!(exclusion(three).culprit(), Culprit::Together);

    let model = refusal(1, |_, _| Err(7));
    let found = exclusion(model);
    assert_eq!(found.culprit(), Culprit::Model);
    assert_eq!(found.failures[&7], found.drawn);
}

/// Values for which the model fails are impossible.
#[test]
fn values_of_which_the_model_makes_nothing_are_impossible() {
    let evidence = by_function(1, |x: &[f64], terms: &mut [f64]| {
        terms[0] = ln_normal(x[0], 0.5, 0.5);
        if x[1] < 0.0 { Err(3) } else { Ok(()) }
    });
    let found = sample_quietly(&standard(2), &evidence, &ParticleSettings::new(256, 1)).unwrap();
    assert!(found.values()[1].iter().all(|value| *value >= 0.0));
    let [drawn, possible] = found.diagnosis().prior_draws;
    assert!((possible as f64 / drawn as f64 - 0.5).abs() < 0.03);
    // Whatever the reason.
    for reason in [0, 255] {
        let evidence = by_function(1, |x: &[f64], terms: &mut [f64]| {
            terms[0] = ln_normal(x[0], 0.5, 0.5);
            if x[1] < 0.0 { Err(reason) } else { Ok(()) }
        });
        let found = sample_quietly(&standard(2), &evidence, &ParticleSettings::new(256, 1)).unwrap();
        assert!(found.values()[1].iter().all(|value| *value >= 0.0), "{reason}");
    }
}

/// What was not drawn has no statistics.
#[test]
fn statistics_of_nothing_are_nan() {
    let evidence = by_function(1, |x: &[f64], terms: &mut [f64]| {
        terms[0] = ln_normal(x[0], 0.5, 0.5);
        Ok(())
    });
    let found = sample_quietly(&standard(1), &evidence, &ParticleSettings::new(256, 1)).unwrap();
    let column = &found.values()[0];
    let few = Weights::smoothed(&[0.0; 10]);
    assert!(found.weighted(&few).effective().is_nan() && found.worth(&few).is_nan());
    assert!(found.weighted(&few).probability_above(column, 0.0).value.is_nan());
    assert!(found.draws().probability_above(&column[1..], 0.0).value.is_nan());
    for nothing in [
        found.summary(DrawnQuantity::Value(9)),
        found.summary(DrawnQuantity::Output(0)),
        found.weighted(&few).summary(column),
        found.draws().summary(&column[1..]),
    ] {
        let ends = nothing.intervals.iter().flat_map(|interval| [interval.low, interval.high]);
        let all = [nothing.mean, nothing.sd, nothing.median].into_iter().chain(ends);
        assert!(all.into_iter().all(|estimate| estimate.value.is_nan()), "{nothing:?}");
    }
}

#[test]
fn nan_is_an_error_with_its_values_and_not_a_draw() {
    let failure = refusal(2, |x, terms| {
        terms[0] = 0.0;
        terms[1] = if x[0] > 1.0 { f64::NAN } else { 0.0 };
        Ok(())
    });
    let NoDraws::NotALikelihood { term: 1, value, ref values } = failure else { panic!("{failure:?}") };
    assert!(value.is_nan() && values.len() == 2 && values[0] > 1.0);
    assert!(failure.to_string().starts_with("the log-likelihood of evidence 1 is NaN at the values ["));
    // +∞ is not a log-likelihood either, even with −∞.
    let failure = refusal(2, |x, terms| {
        terms.copy_from_slice(&[limit(x[1] < 0.0), f64::INFINITY]);
        Ok(())
    });
    assert!(matches!(failure, NoDraws::NotALikelihood { term: 1, .. }), "{failure:?}");
}

#[test]
fn settings_that_cannot_be_used_are_refused() {
    let evidence = by_function(1, |_: &[f64], terms: &mut [f64]| {
        terms[0] = 0.0;
        Ok(())
    });
    let with = |settings: &ParticleSettings| sample_quietly(&standard(1), &evidence, settings).unwrap_err();
    for particles in [0, 100, PARTICLES_STEP + 64] {
        assert_eq!(with(&ParticleSettings::new(particles, 1)), NoDraws::Particles { particles });
    }
    for islands in [0, 3, 1025, usize::MAX] {
        let refused = with(&ParticleSettings { islands, ..ParticleSettings::new(128, 1) });
        assert_eq!(refused, NoDraws::Islands { islands });
    }
    let terms = Selection::Only(vec![0, 1]);
    assert_eq!(
        with(&ParticleSettings { terms, ..ParticleSettings::new(128, 1) }),
        NoDraws::NoSuchTerm { term: 1, terms: 1 }
    );
    let nothing = sample_quietly(&Independent(Vec::new()), &evidence, &ParticleSettings::new(128, 1));
    assert_eq!(nothing.unwrap_err(), NoDraws::NothingUnknown);
}

#[test]
fn the_caller_may_end_a_run() {
    let evidence = by_function(1, |_: &[f64], terms: &mut [f64]| {
        terms[0] = 0.0;
        Ok(())
    });
    let mut calls = 0;
    let ended = sample(&standard(1), &evidence, &ParticleSettings::new(128, 1), &mut |_, total| {
        assert_eq!(total, 16 * 128);
        calls += 1;
        if calls > 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    // After the run has ended, `progress` is not called again, and unfinished islands do not finish.
    assert_eq!(calls, 4);
    assert!(matches!(ended.unwrap_err(), NoDraws::Ended { finished: 0..4, islands: 16 }));
}

#[test]
fn a_limit_cannot_be_weighed_away_and_has_no_residual() {
    let found = posterior(&standard(1), 128, |x| limit(x[0] > 0.0));
    assert_eq!(found.without(&[0]).unwrap_err(), CannotReweight::Excludes { term: 0 });
    assert_eq!(found.without(&[1]).unwrap_err(), CannotReweight::NoSuchTerm { term: 1, terms: 1 });
    let soft = posterior(&standard(1), 128, |x| ln_normal(x[0], 0.0, 1.0));
    assert_eq!(soft.check(0).unwrap_err(), CannotReweight::NoResidual { term: 0 });
}
