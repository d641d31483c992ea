//! What the engines write with their feature `serde` is read again as the same, and what no constructor
//! accepts is refused.

use std::cell::Cell;
use std::fmt::Debug;

use crash3::{
    BarrierTest, DamagedFace, EnergyBasis, ObliqueCorrection, Profile, Side, SideStiffness, Stiffness,
    Yielding, crush_range_from_force,
};
use pim_core::{
    Body, Contact, Law, LawImpulse, Participant, RestitutionCurve, Tangential, VaryingLaw, VehicleId,
};
use real::Dual;
use reconcile::{Iterations, MAX_STEPS, Problem, Reconciliation, SolutionMethod, Unknown};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, from_value, json, to_value};

use crate::crush::{make, profile};
use crate::reconciliation::{Case, all_laws, case, with_curve};
use crate::scenes::{any_scene, for_all};

/// Through a tree of values, which keeps every bit of a number.
fn again<T: Serialize + DeserializeOwned>(value: &T) -> T {
    from_value(to_value(value).unwrap()).unwrap()
}

#[track_caller]
fn assert_again<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    assert_eq!(again(value), *value);
}

#[track_caller]
fn assert_refused<T: DeserializeOwned + Debug>(written: Value, what: &str) {
    let refusal = from_value::<T>(written).unwrap_err().to_string();
    assert!(refusal.contains(what), "{refusal}");
}

#[test]
fn numbers_with_derivatives() {
    let number = Dual { value: 0.1 + 0.2, derivative: -1.0 / 3.0 };
    assert_again(&number);
    assert_eq!(to_value(Dual::variable(2.0)).unwrap(), json!({ "value": 2.0, "derivative": 1.0 }));
    let gradients = real::gradients(&[3.0], |x| Ok::<_, ()>(vec![x[0] * x[0]])).unwrap();
    assert_again(&gradients);
}

#[test]
fn contacts_laws_and_impacts() {
    for_all(500, 0.3, any_scene(), |scene| {
        let (contact, law, motions) = (scene.contact(), scene.law(), scene.motions());
        assert_again(&contact);
        assert_again(&law);
        assert_again(&motions);
        assert_again(&contact.inverse_mass());
        let approach = contact.approach(&motions);
        assert_again(&approach);
        let impulse: LawImpulse = law.impulse(&contact.inverse_mass(), approach);
        assert_again(&impulse);
        assert_again(&law.borders(&contact.inverse_mass(), approach));
        let Ok(outcome) = scene.impact() else { return false };
        assert_again(&outcome);
        true
    });
    assert_again(&Participant::<f64>::barrier());
}

#[test]
fn a_law_is_written_by_the_names_of_its_coefficients() {
    let law = Law::new(0.25, Tangential::Friction(0.5)).unwrap();
    let written =
        json!({ "restitution": 0.25, "tangential": { "Friction": 0.5 }, "moment_restitution": -1.0 });
    assert_eq!(to_value(law).unwrap(), written);
    let curve = RestitutionCurve::new(vec![(2.0, 0.5), (6.0, 0.25)]).unwrap();
    let varying = law.with_restitution_curve(curve);
    assert_again(&varying);
    assert_again(&VaryingLaw::from(law));
    // The curve goes before the number of the law.
    let other = json!({ "law": written, "curve": { "points": [[2.0, 0.5], [6.0, 0.25]] } });
    assert_eq!(from_value::<VaryingLaw>(other).unwrap(), varying);
    let body = to_value([Body::fixed(), Body::new(1500.0, 2700.0).unwrap()]).unwrap();
    assert_eq!(body, json!(["Fixed", { "Movable": { "mass": 1500.0, "yaw_inertia": 2700.0 } }]));
}

#[test]
fn impossible_impacts_are_refused() {
    assert_refused::<Body>(
        json!({ "Movable": { "mass": -1.0, "yaw_inertia": 2700.0 } }),
        "the mass is -1, but must be",
    );
    let law =
        |e: f64, e_m: f64| json!({ "restitution": e, "tangential": "Critical", "moment_restitution": e_m });
    assert!(from_value::<Law>(law(0.3, 0.0)).is_ok());
    assert_refused::<Law>(law(1.5, 0.0), "coefficient of restitution");
    assert_refused::<Law>(law(0.3, -1.5), "moment coefficient of restitution");
    assert_refused::<RestitutionCurve>(json!({ "points": [] }), "at least one point");
    let place = |forward: [f64; 2]| json!({ "body": "Fixed", "forward": forward, "arm": [1.0, 0.0] });
    assert!(from_value::<Participant>(place([0.6, 0.8])).is_ok());
    assert_refused::<Participant>(place([0.6, 0.9]), "length of the forward axis");
    let places = [place([0.6, 0.8]), place([1.0, 0.0])];
    assert_refused::<Contact>(json!({ "participants": places, "crush_plane": 0.3 }), "both bodies are fixed");
}

#[test]
fn damage() {
    for_all(500, 1.0, profile(), |plain| {
        let profile = make(&plain);
        assert_again(&profile);
        assert_again(&profile.sums());
        assert_again(&profile.zones().collect::<Vec<_>>());
        true
    });
    let profile = Profile::equally_spaced(vec![0.1, 0.5, 0.3], 1.2).unwrap();
    let rising = Stiffness::from_ab(40e3, 500e3).unwrap();
    let saturated = rising.with_saturation_force(150e3).unwrap();
    for stiffness in [rising, saturated] {
        assert_again(&stiffness);
        assert_again(&SideStiffness::Uniform(stiffness));
    }
    assert_again(&SideStiffness::Zones(vec![rising, saturated]));
    let yielding: Vec<Yielding> = profile.zones().map(|zone| zone.yielding(&saturated)).collect();
    assert!(matches!(yielding[0], Yielding::Partly { .. }));
    assert_again(&yielding);
    assert_again(&saturated.saturation());
    assert_again(&BarrierTest::new(1400.0, 15.6, profile, 2.0).unwrap());
    assert_again(&DamagedFace::new(Side::Left, 0.9, -0.2).unwrap());
    assert_again(&crush_range_from_force(2e5, 0.1, &rising, 1.0, 1.6, 2.0).unwrap());
    for correction in [ObliqueCorrection::Capped, ObliqueCorrection::Friction(0.5)] {
        assert_again(&correction);
        assert_again(&correction.factor(0.3).unwrap());
    }
    assert_again(&[EnergyBasis::Dissipated, EnergyBasis::Absorbed]);
}

#[test]
fn impossible_damage_is_refused() {
    assert_refused::<Profile>(json!({ "depths": [0.1, -0.1], "spacings": [0.5] }), "must not be negative");
    assert_refused::<Profile>(json!({ "depths": [0.1, 0.1], "spacings": [0.5, 0.5] }), "need 1 spacings");
    let stiffness = |force: f64| json!({ "a": 4e4, "b": 5e5, "g": 1600.0, "saturation_force": force });
    assert!(from_value::<Stiffness>(stiffness(5e4)).is_ok());
    assert_refused::<Stiffness>(stiffness(3e4), "must be at least A");
    assert_refused::<DamagedFace>(
        json!({ "side": "Left", "distance": 0.0, "offset": 0.0 }),
        "greater than zero",
    );
    let profile = json!({ "depths": [0.0, 0.0], "spacings": [0.5] });
    let test = json!({ "mass": 1400.0, "speed": 15.0, "profile": profile, "no_damage_speed": 2.0 });
    assert_refused::<BarrierTest>(test, "no crush");
}

/// A problem that was read gives the answer of the one that was written, bit by bit; and so does the answer.
#[test]
fn problems_and_answers() {
    let (closed, searched) = (Cell::new(0), Cell::new(0));
    for_all(500, 0.2, case(all_laws()), |case: Case| {
        let Ok(outcome) = case.scene.impact() else { return false };
        let problem = case.problem(outcome.energy.normal_work);
        let curve = RestitutionCurve::new(vec![(0.0, 0.5), (20.0, 0.1)]).unwrap();
        for problem in [with_curve(&problem, &curve), problem] {
            let read: Problem = again(&problem);
            assert_eq!(read, problem);
            assert_again(&problem.line());
            let Ok(answer) = problem.solve() else { return false };
            assert_again(&problem.quadratic(&answer.acting));
            let text = format!("{answer:?}");
            assert_eq!(format!("{:?}", read.solve().unwrap()), text);
            let answer_read: Reconciliation = again(&answer);
            assert_eq!(format!("{answer_read:?}"), text);
            match answer.method {
                SolutionMethod::ClosedForm => closed.set(closed.get() + 1),
                SolutionMethod::RootFinder(_) => searched.set(searched.get() + 1),
            }
        }
        true
    });
    assert!(closed.get() > 20 && searched.get() > 100, "{closed:?} {searched:?}");
    assert_eq!(to_value([Unknown::Speed1, Unknown::Speed2]).unwrap(), json!(["Speed1", "Speed2"]));
    assert_eq!(to_value(VehicleId::ALL).unwrap(), json!(["One", "Two"]));
    assert_again(&VehicleId::ALL);
}

#[test]
fn a_search_has_no_more_steps_than_it_can_have() {
    let steps = |count: usize| {
        let step = json!({ "speed": 1.0, "normal_work": 2.0 });
        from_value::<Iterations>(Value::Array(vec![step; count]))
    };
    assert_eq!(steps(MAX_STEPS).unwrap().as_slice().len(), MAX_STEPS);
    let refusal = steps(MAX_STEPS + 1).unwrap_err().to_string();
    assert!(refusal.contains("at most 64 steps"), "{refusal}");
}
