//! The functions for loops over many samples give the same answers as those with a reason, and a plain
//! validity flag.

use oracle::scenes::{any_scene, for_all};
use pim_core::{Body, Contact, Law, Participant, Tangential};

const ODD: [f64; 6] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 0.0];

#[test]
fn bodies_and_places() {
    for mass in ODD.into_iter().chain([1500.0]) {
        for inertia in ODD.into_iter().chain([2700.0]) {
            let (body, possible) = Body::new_with_validity(mass, inertia);
            match Body::new(mass, inertia) {
                Ok(expected) => assert!(possible && body == expected),
                Err(_) => assert!(!possible, "{mass} {inertia}"),
            }
        }
    }
    let body = Body::new(1500.0, 2700.0).unwrap();
    let values = ODD.into_iter().chain([2.0, 1e300]);
    for value in values {
        for [heading, forward, left] in [[value, 2.0, 0.5], [0.3, value, 0.5], [0.3, 2.0, value]] {
            let (place, possible) = Participant::new_with_validity(body, heading, forward, left);
            match Participant::new(body, heading, forward, left) {
                Ok(expected) => assert!(possible && place == expected),
                Err(_) => assert!(!possible, "{heading} {forward} {left}"),
            }
        }
    }
}

#[test]
fn laws() {
    let values = ODD.into_iter().chain([-2.0, 0.4, 1.0, 1.1]);
    for value in values.clone() {
        for tangential in [
            Tangential::Critical,
            Tangential::Ratio(value),
            Tangential::FractionOfCritical(value),
            Tangential::Friction(value),
            Tangential::VelocityChange(value),
            Tangential::Restitution(value),
            Tangential::FullOrSliding(value),
        ] {
            for e in values.clone() {
                let (law, possible) = Law::new_with_validity(e, tangential);
                match Law::new(e, tangential) {
                    Ok(expected) => assert!(possible && law == expected),
                    Err(_) => assert!(!possible, "{e} {tangential:?}"),
                }
            }
        }
    }
    assert!(!Law::new_with_validity(0.3, Tangential::Critical).0.has_moment());
}

#[test]
fn contacts_and_impacts() {
    for_all(3000, 0.3, any_scene(), |scene| {
        let places = scene.cars.map(|car| car.participant());
        let (contact, possible) = Contact::new_with_validity(places, scene.crush_plane);
        assert!(possible);
        assert_eq!(contact, scene.contact());
        let (outcome, possible) = contact.impact_with_validity(scene.motions(), &scene.law());
        match scene.impact() {
            Ok(expected) => assert!(possible && outcome == expected),
            Err(_) => assert!(!possible),
        }
        possible
    });
    let wall = Participant::barrier();
    assert!(!Contact::new_with_validity([wall, wall], 0.0).1);
    let car = Participant::new(Body::new(1500.0, 2700.0).unwrap(), 0.0, 2.0, 0.0).unwrap();
    assert!(!Contact::new_with_validity([car, wall], f64::NAN).1);
    assert!(!Contact::new_with_validity([car, car], 0.0).1);
}
