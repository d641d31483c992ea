//! The same bits for any number of threads and any instructions.

use std::sync::atomic::{AtomicUsize, Ordering};

use estimate::{Evidence, Hurdle, ParticleSettings, Posterior, Selection, sample_quietly};
use uncertainty::{Instructions, LANES, Lanes};

use super::{by_function, ln_normal, standard};

fn run(settings: &ParticleSettings) -> Posterior {
    let evidence = by_function(2, |x: &[f64], terms: &mut [f64]| {
        terms[0] = ln_normal(x[0] * x[1], 0.6, 0.05);
        terms[1] = if x[2] > 2.0 { f64::NEG_INFINITY } else { ln_normal(x[2], x[0], 0.4) };
        if x[1] < -2.5 { Err(1) } else { Ok(()) }
    });
    sample_quietly(&standard(4), &evidence, settings).unwrap()
}

/// All results of a run, with all digits.
fn bits(posterior: &Posterior) -> (Vec<u64>, String) {
    let numbers = posterior.values().iter().chain(posterior.terms()).flatten().map(|x| x.to_bits());
    (numbers.collect(), format!("{:?} {:?}", posterior.log_evidence(), posterior.diagnosis()))
}

#[test]
fn one_two_and_three_threads_give_the_same_bits() {
    let settings = ParticleSettings::new(128, 5);
    let expected = bits(&run(&settings));
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| bits(&run(&settings))) == expected, "{threads} threads");
    }
    assert!(bits(&run(&ParticleSettings::new(128, 6))).0 != expected.0);
}

#[test]
fn all_instructions_give_the_same_bits() {
    let settings = ParticleSettings::new(128, 5);
    let expected = bits(&run(&settings));
    for instructions in Instructions::available() {
        assert!(
            bits(&run(&ParticleSettings { instructions, ..settings.clone() })) == expected,
            "{instructions:?}"
        );
    }
}

/// Unused evidence changes nothing except its own columns.
#[test]
fn evidence_that_is_not_used_leaves_the_draws_alone() {
    let settings = ParticleSettings { terms: Selection::Only(vec![0]), ..ParticleSettings::new(128, 5) };
    let only = run(&settings);
    let evidence = by_function(1, |x: &[f64], terms: &mut [f64]| {
        terms[0] = ln_normal(x[0] * x[1], 0.6, 0.05);
        if x[1] < -2.5 { Err(1) } else { Ok(()) }
    });
    let alone = sample_quietly(&standard(4), &evidence, &ParticleSettings::new(128, 5)).unwrap();
    assert_eq!(only.values(), alone.values());
}

/// Evidence whose second term is computed only for proposals that may be accepted.
struct InTwoParts {
    left_out: AtomicUsize,
}

impl Evidence for InTwoParts {
    fn terms_count(&self) -> usize {
        2
    }

    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], _: &mut [u8; LANES]) {
        for lane in 0..LANES {
            terms[0][lane] = ln_normal(values[0][lane] * values[1][lane], 0.6, 0.05);
            terms[1][lane] = ln_normal(values[2][lane], values[0][lane], 0.4);
        }
    }

    fn log_likelihood_of_proposals(
        &self,
        values: &[Lanes],
        hurdle: &Hurdle<'_>,
        terms: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) -> bool {
        let mut whole = [Lanes::ZERO; 2];
        self.log_likelihood(values, &mut whole, reasons);
        let most = [whole[0], Lanes::splat(ln_normal(0.0, 0.0, 0.4))];
        let taken = hurdle.takes(&most);
        for lane in 0..LANES {
            for term in 0..2 {
                terms[term][lane] = if taken[lane] { whole[term][lane] } else { most[term][lane] };
            }
        }
        self.left_out.fetch_add(taken.iter().filter(|taken| !**taken).count(), Ordering::Relaxed);
        true
    }
}

#[test]
fn what_is_not_found_of_proposals_in_vain_changes_nothing() {
    let settings = ParticleSettings::new(128, 5);
    let evidence = InTwoParts { left_out: AtomicUsize::new(0) };
    let in_parts = sample_quietly(&standard(3), &evidence, &settings).unwrap();
    let whole = by_function(2, |x: &[f64], terms: &mut [f64]| {
        terms[0] = ln_normal(x[0] * x[1], 0.6, 0.05);
        terms[1] = ln_normal(x[2], x[0], 0.4);
        Ok(())
    });
    let whole = sample_quietly(&standard(3), &whole, &settings).unwrap();
    assert!(bits(&in_parts) == bits(&whole));
    // A large part is skipped.
    let left_out = evidence.left_out.into_inner();
    assert!(4 * left_out > whole.diagnosis().evaluations, "{left_out}");
}
