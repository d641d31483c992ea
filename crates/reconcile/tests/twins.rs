//! The functions for loops over many samples give the same answers as those with a reason, and a plain
//! validity flag.

use std::cell::Cell;

use oracle::scenes::for_all;
use pim_core::{
    Body, Contact, ImpactError, Law, Motion, Participant, RestitutionCurve, Tangential, VehicleId,
};
use reconcile::{EnergyBasis, Problem, ReconcileError};

use crate::reconciliation::{Case, all_laws, case, posed, with_curve};

fn solved(case: &Case, problem: &Problem) -> bool {
    let (speed, outcome, [possible, _]) = problem.solve_with_verdict();
    tells_that_it_pulls(problem);
    match problem.solve() {
        Ok(answer) if possible => {
            assert_eq!(speed.to_bits(), answer.speed.to_bits());
            assert_eq!(outcome, answer.outcome);
        }
        // It may miss an answer that only the root-finder or a faster approach gives, or that rounding
        // decides.
        Ok(answer) => {
            let line = problem.line();
            let approach = -(line.at_rest.normal + line.slope.normal * speed);
            let is_none = approach.is_nan()
                || approach <= 1e-9
                || speed.abs() > 1000.0
                || problem.impact(speed).is_err();
            assert!(is_none || problem.closed_form().is_none(), "{case:?} {answer:?}");
        }
        Err(_) => assert!(!possible, "{case:?}"),
    }
    possible
}

/// Whether the verdict is at once that the vehicles would have to pull; if so, the search agrees.
fn tells_that_it_pulls(problem: &Problem) -> bool {
    let (.., [_, pulls]) = problem.solve_with_verdict();
    let why = problem.solve().err();
    let is_pulling =
        matches!(why, Some(ReconcileError::Inadmissible { reason: ImpactError::Pulling { .. }, .. }));
    assert!(!pulls || is_pulling, "{problem:?} {why:?}");
    pulls
}

/// The only speed needs a fraction of a critical impulse that would pull.
#[test]
fn a_critical_impulse_that_would_pull() {
    let car = |heading: f64, left: f64| {
        Participant::new(Body::new(1500.0, 3375.0).unwrap(), heading, -2.0, left).unwrap()
    };
    let mut told = 0;
    for heading in 0..24 {
        for f in [1e-9, 0.01, 0.1, 0.3, 0.6, 1.0] {
            for energy in [1e3, 1e4, 1e5, 1e6, 1e9] {
                let place = car(f64::from(heading) * 0.25, 0.8);
                let Ok(contact) = Contact::new([place, Participant::barrier()], std::f64::consts::FRAC_PI_2)
                else {
                    continue;
                };
                let law = Law::new(0.1, Tangential::FractionOfCritical(f)).unwrap();
                let motions = [Motion { yaw_rate: 1.0, ..Motion::rest() }, Motion::rest()];
                let basis = EnergyBasis::Dissipated;
                let Ok(problem) = posed(contact, law, motions, VehicleId::One, energy, basis) else {
                    continue;
                };
                told += usize::from(tells_that_it_pulls(&problem));
            }
        }
    }
    assert!(told > 10, "{told}");
}

#[test]
fn reconciliations() {
    let (with_limit, with_cubic) = (Cell::new(0), Cell::new(0));
    for_all(8000, 0.1, (case(all_laws()), -4.0..4.0), |(case, exponent): (Case, f64)| {
        let Ok(outcome) = case.scene.impact() else { return false };
        let problem = case.problem(outcome.energy.normal_work * exponent.exp());
        let possible = solved(&case, &problem);
        // With a curve there is no closed form.
        let curve = RestitutionCurve::new(vec![(0.0, case.scene.restitution)]).unwrap();
        assert!(!with_curve(&problem, &curve).solve_with_verdict().2[0]);
        let has_cubic = matches!(case.scene.tangential, Tangential::FractionOfCritical(_));
        assert!(!possible || problem.closed_form().is_some() || has_cubic);
        with_cubic.set(with_cubic.get() + usize::from(possible && has_cubic));
        with_limit
            .set(with_limit.get() + usize::from(possible && case.scene.law().friction_limit().is_some()));
        possible
    });
    assert!(with_limit.get() > 500 && with_cubic.get() > 100, "{with_limit:?} {with_cubic:?}");
}

/// 1000 m/s is the fastest admissible speed, for both.
#[test]
fn nobody_is_faster_than_a_kilometre_per_second() {
    let car = Participant::new(Body::new(1500.0, 2700.0).unwrap(), 0.0, 2.0, 0.0).unwrap();
    let contact = Contact::new([car, Participant::barrier()], 0.0).unwrap();
    let law = Law::new(0.0, Tangential::Critical).unwrap();
    let at = |speed: f64| {
        let energy = 0.5 * 1500.0 * speed * speed;
        let motions = [Motion::rest(); 2];
        posed(contact, law, motions, VehicleId::One, energy, EnergyBasis::Dissipated).unwrap()
    };
    assert!(at(999.0).solve_with_verdict().2[0]);
    assert!(at(999.0).solve().is_ok() && at(999.0).root_finder().is_ok());
    assert!(!at(1001.0).solve_with_verdict().2[0]);
    for refused in [at(1001.0).solve(), at(1001.0).root_finder()] {
        assert!(matches!(refused, Err(ReconcileError::NotReached { .. })), "{refused:?}");
    }
}

#[test]
fn problems_without_an_answer() {
    let car = Participant::new(Body::new(1500.0, 2700.0).unwrap(), 0.0, 2.0, 0.0).unwrap();
    let (wall, rest) = (Participant::barrier(), Motion::rest());
    let across =
        Participant::new(Body::new(1500.0, 2700.0).unwrap(), std::f64::consts::FRAC_PI_2, 0.0, 2.0).unwrap();
    for (places, unknown, e, energy) in [
        ([car, wall], VehicleId::One, 0.3, 1e5),
        ([car, wall], VehicleId::Two, 0.3, 1e5),
        ([car, wall], VehicleId::One, 1.0, 1e5),
        ([car, wall], VehicleId::One, 0.3, 0.0),
        ([car, wall], VehicleId::One, 0.3, -1.0),
        ([car, wall], VehicleId::One, 0.3, f64::INFINITY),
        ([car, wall], VehicleId::One, 0.3, f64::NAN),
        ([car, across], VehicleId::Two, 0.3, 1e5),
    ] {
        let contact = Contact::new(places, 0.0).unwrap();
        let law = Law::new(e, Tangential::Critical).unwrap();
        let basis = EnergyBasis::Dissipated;
        let problem = posed(contact, law, [rest; 2], unknown, energy, basis);
        let flagged = Problem {
            contact,
            law: law.into(),
            motions: [rest; 2],
            unknown,
            crush_energy: energy,
            basis,
            tangential_share: 0.0,
        };
        let (.., [possible, _]) = flagged.solve_with_verdict();
        assert_eq!(possible, problem.is_ok(), "{unknown:?} {e} {energy}");
    }
}
