//! Values written with the feature `serde` are read back unchanged, and values that no constructor accepts
//! are refused.

use oracle::scenes::{any_scene, for_all};
use oracle::written::{assert_again, assert_refused};
use pim_core::{Body, Contact, Law, LawImpulse, Participant, RestitutionCurve, Tangential, VaryingLaw};
use serde_json::{from_value, json, to_value};

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
    // The curve takes precedence over the law's own number.
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
