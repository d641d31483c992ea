//! The subjects of the benchmarks. These tests are here because the tests of a package must build everything
//! that its benchmarks link.

use crash3::crush_energy;
use deltav_benches::{Example, FRICTION, TANGENTIAL_CONDITIONS};
use pim_core::{Regime, Tangential};

/// Both targets measure exactly the paper's example: theory, section 7.
#[test]
fn the_example_is_the_papers() {
    let example = Example::new().unwrap();
    let energies = example.damage.each_ref().map(|(profile, stiffness)| crush_energy(profile, stiffness));
    for (energy, expected) in energies.into_iter().zip([102_165.0, 38_657.0]) {
        assert!((energy - expected).abs() < 0.5, "{energy} J, expected {expected} J");
    }

    let problem = example.problem(Tangential::Critical).unwrap();
    for answer in [problem.solve().unwrap(), problem.root_finder().unwrap()] {
        assert!((answer.speed - 22.869).abs() < 5e-4, "{} m/s", answer.speed);
        assert!((answer.outcome.impulse_ratio - 0.36885).abs() < 5e-6, "{answer:?}");
    }
    // Friction above the critical ratio gives the critical law's answer.
    let rough = example.problem(FRICTION).unwrap().solve().unwrap();
    assert!((rough.speed - 22.869).abs() < 5e-4, "{} m/s", rough.speed);
}

/// The place of a condition in the list: a new one does not compile until it has a place.
fn place(tangential: Tangential) -> usize {
    match tangential {
        Tangential::Critical => 0,
        Tangential::Ratio(_) => 1,
        Tangential::FractionOfCritical(_) => 2,
        Tangential::Friction(_) => 3,
        Tangential::VelocityChange(_) => 4,
        Tangential::Restitution(_) => 5,
        Tangential::FullOrSliding(_) => 6,
    }
}

#[test]
fn every_condition_has_an_impact() {
    let example = Example::new().unwrap();
    let places: Vec<usize> =
        TANGENTIAL_CONDITIONS.into_iter().map(|(_, tangential)| place(tangential)).collect();
    assert_eq!(places, [0, 1, 2, 3, 4, 5, 6]);
    for (name, tangential) in TANGENTIAL_CONDITIONS {
        let outcome = example.contact.impact(example.motions, &Example::law(tangential).unwrap());
        assert!(
            outcome.as_ref().is_ok_and(|outcome| outcome.regime != Some(Regime::Sliding)),
            "{name}: {outcome:?}"
        );
    }
}
