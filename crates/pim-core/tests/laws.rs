//! Relations between the impact laws, and each of them by hand.

use oracle::compare::{assert_close, assert_relative};
use oracle::scenes::{Car, Scene, for_all, moment, scene, scene_under};
use oracle::{Condition, Effects, Scale, assert_same, solve};
use pim_core::{Body, Contact, Law, Motion, Outcome, Participant, Regime, Tangential, Vector2};
use proptest::prelude::*;

use crate::coulomb::steep_sideswipe;

const ROUNDING: f64 = 1e-12;

/// The outcome under a law other than the scene's.
fn impact(scene: &Scene, law: Law) -> Option<Outcome> {
    scene.contact().impact(scene.motions(), &law).ok()
}

/// Equal to the last bit, except for μ_c, which a law that needs it takes from its impulse, while the others
/// compute it separately.
#[track_caller]
fn assert_equal(a: &Outcome, b: &Outcome) {
    let mut same = *a;
    same.critical_impulse_ratio = b.critical_impulse_ratio;
    assert_eq!(same, *b);
    match (a.critical_impulse_ratio, b.critical_impulse_ratio) {
        (Some(a), Some(b)) => assert_close("μ_c", a, b, 1e-9 * (1.0 + b.abs())),
        (a, b) => assert_eq!(a, b),
    }
}

#[test]
fn two_laws_that_slide_are_the_same() {
    for_all(20_000, 0.15, scene_under((0.0..1.0).prop_map(Tangential::FullOrSliding)), |scene| {
        let Tangential::FullOrSliding(limit) = scene.tangential else { return false };
        let other = scene.under(Tangential::Friction(limit));
        let (Ok(a), Ok(b)) = (scene.impact(), other.impact()) else { return false };
        let both = a.regime == Some(Regime::Sliding) && b.regime == Some(Regime::Sliding);
        if both {
            assert_equal(&a, &b);
        }
        both
    });
}

#[test]
fn a_full_impact_has_the_same_restitution_in_both_directions() {
    for_all(20_000, 0.15, scene_under((0.0..3.0).prop_map(Tangential::FullOrSliding)), |scene| {
        let Ok(full) = scene.impact() else { return false };
        if full.regime != Some(Regime::Full) {
            return false;
        }
        let mut other = impact(&scene, Law::ishikawa(scene.restitution, scene.restitution).unwrap()).unwrap();
        other.regime = Some(Regime::Full);
        assert_eq!(full, other);
        true
    });
}

#[test]
fn constructors_name_their_conditions() {
    let brach = Law::new(0.0, Tangential::Critical).unwrap();
    assert_eq!(Law::woolley(), brach);
    assert_eq!(Law::woolley_sideswipe(-3.0), Law::new(0.0, Tangential::VelocityChange(-3.0)));
    assert_eq!(Law::ishikawa(0.3, -0.2), Law::new(0.3, Tangential::Restitution(-0.2)));
    assert_eq!(Law::kudlich_slibar(0.3, 0.6), Law::new(0.3, Tangential::FullOrSliding(0.6)));
    assert_eq!(brach.moment_restitution(), -1.0);
    let turning = brach.with_moment_restitution(0.25).unwrap();
    assert_eq!(turning.moment_restitution(), 0.25);
    assert_eq!((turning.restitution(), turning.tangential()), (0.0, Tangential::Critical));
}

#[test]
fn woolley_is_brach_without_restitution() {
    for_all(5000, 0.8, scene_under(Just(Tangential::Critical)), |scene| {
        let scene = Scene { restitution: 0.0, ..scene };
        let outcome = impact(&scene, Law::woolley());
        assert_eq!(outcome, scene.impact().ok());
        outcome.is_some()
    });
}

#[test]
fn a_sideswipe_that_ends_the_sliding_is_woolley_s() {
    for_all(5000, 0.8, scene_under(Just(Tangential::Critical)), |scene| {
        let scene = Scene { restitution: 0.0, ..scene };
        let Some(common) = impact(&scene, Law::woolley()) else { return false };
        let law = Law::woolley_sideswipe(-common.approach.tangential).unwrap();
        assert_equal(&impact(&scene, law).unwrap(), &common);
        true
    });
}

#[test]
fn ishikawa_without_tangential_restitution_is_brach() {
    for_all(5000, 0.8, scene_under(Just(Tangential::Critical)), |scene| {
        let law = Law::ishikawa(scene.restitution, 0.0).unwrap();
        match (impact(&scene, law), scene.impact()) {
            (Some(ishikawa), Ok(brach)) => assert_equal(&ishikawa, &brach),
            (None, Err(_)) => return false,
            (ishikawa, brach) => panic!("{ishikawa:?} {brach:?}"),
        }
        true
    });
}

#[test]
fn no_moment_is_no_moment() {
    for_all(20_000, 0.6, scene(), |scene| {
        let scene = scene.without_moment();
        let plain = Law::new(scene.restitution, scene.tangential).unwrap();
        let outcome = impact(&scene, plain);
        assert_eq!(outcome, impact(&scene, plain.with_moment_restitution(-1.0).unwrap()));
        outcome.is_some_and(|outcome| {
            assert_eq!((outcome.moment_impulse, outcome.energy.moment_work), (0.0, 0.0));
            true
        })
    });
}

#[test]
fn a_moment_without_restitution_leaves_a_common_yaw_rate() {
    for_all(20_000, 0.3, scene(), |scene| {
        let scene = Scene { moment: 0.0, ..scene }.under(scene.tangential);
        let Ok(outcome) = scene.impact() else { return false };
        if scene.moment != 0.0 {
            return false;
        }
        let effects = Effects::from(&outcome);
        let scale = Scale::of(&scene, &effects);
        let [one, two] = effects.yaw_rates;
        assert_close("Ω₁ − Ω₂", one, two, (scale.yaw_rates[0] + scale.yaw_rates[1]) * ROUNDING);
        true
    });
}

/// M = (1 + e_m) M_c.
#[test]
fn the_moment_is_in_proportion_to_one_plus_its_restitution() {
    for_all(20_000, 0.15, (scene(), moment()), |(scene, moment)| {
        let conditions = matches!(scene.tangential, Tangential::Critical | Tangential::Ratio(_));
        let at = |moment: f64| Scene { moment, ..scene };
        let (Ok(some), Ok(common)) = (at(moment).impact(), at(0.0).impact()) else { return false };
        if !conditions {
            return false;
        }
        let scale = Scale::of(&at(0.0), &Effects::from(&common));
        let expected = (1.0 + moment) * common.moment_impulse;
        assert_close("M", some.moment_impulse, expected, 2.0 * scale.moment * ROUNDING);
        true
    });
}

/// A central head-on impact at 10 m/s each: the yaw rates of ±1 rad/s do not affect the rest.
#[test]
fn a_moment_by_hand() {
    let car = Car {
        fixed: false,
        mass: 1000.0,
        yaw_radius: 1.5,
        heading: 0.0,
        distance: 2.0,
        angle: 0.0,
        velocity: [10.0, 0.0],
        yaw_rate: 1.0,
    };
    let other = Car { heading: std::f64::consts::PI, velocity: [-10.0, 0.0], yaw_rate: -1.0, ..car };
    let inertia = 2250.0;
    // Ω₁ − Ω₂ = 2 + 2 M/I = −2 e_m, so that M = −(1+e_m) I; W_m = −½ M (2 − 2 e_m) = I (1 − e_m²).
    for e_m in [-1.0, -0.5, 0.0, 0.5, 1.0] {
        // Frictionless and elastic: the moment alone takes energy.
        let scene = Scene {
            cars: [car, other],
            crush_plane: 0.0,
            restitution: 1.0,
            tangential: Tangential::Ratio(0.0),
            moment: e_m,
        };
        let outcome = scene.impact().unwrap();
        assert_close("M", outcome.moment_impulse, -(1.0 + e_m) * inertia, 1e-9);
        assert_close("Ω₁", outcome.after[0].yaw_rate, -e_m, 1e-12);
        assert_close("Ω₂", outcome.after[1].yaw_rate, e_m, 1e-12);
        assert_close("W_m", outcome.energy.moment_work, inertia * (1.0 - e_m * e_m), 1e-9);
        assert_close("E_L", outcome.energy.loss, inertia * (1.0 - e_m * e_m), 1e-7);
        assert_close("P_n", outcome.impulse.normal, 20_000.0, 1e-8);
    }
}

/// Only a spin that the moment reverses: rounding must not turn it into created energy.
#[test]
fn an_elastic_moment_is_possible() {
    for_all(5000, 1.0, (-50.0..50.0, -50.0..50.0, 0.5..4.0, 1e-9..1e-3), |(one, two, radius, speed)| {
        let (one, two, radius, speed): (f64, f64, f64, f64) = (one, two, radius, speed);
        let car = Car {
            fixed: false,
            mass: 1300.0,
            yaw_radius: radius,
            heading: 0.0,
            distance: 1.7,
            angle: 0.0,
            velocity: [speed, 0.0],
            yaw_rate: one,
        };
        let other = Car { distance: -1.1, velocity: [0.0; 2], yaw_rate: two, ..car };
        let scene = Scene {
            cars: [car, other],
            crush_plane: 0.0,
            restitution: 1.0,
            tangential: Tangential::Ratio(0.0),
            moment: 1.0,
        };
        let outcome = scene.impact().unwrap();
        let energy = car.mass * radius * radius * (one * one + two * two);
        assert_close("E_L", outcome.energy.loss, 0.0, energy * ROUNDING);
        true
    });
}

/// Kudlich and Slibar's law where K = (2 1; 1 2) and u = (−1, −1), with ε = ½.
#[test]
fn a_full_and_a_sliding_impact_by_hand() {
    let scene = |limit: f64| {
        let mut scene = steep_sideswipe(Tangential::FullOrSliding(limit));
        scene.cars[0].velocity = [1.0, -1.0];
        Scene { restitution: 0.5, ..scene }
    };
    // P = −1.5 K⁻¹ u = ½ (1, 1), U = ½ (1, 1).
    let full = scene(1.2).impact().unwrap();
    assert_eq!(full.regime, Some(Regime::Full));
    for value in
        [full.impulse.normal, full.impulse.tangential, full.separation.normal, full.separation.tangential]
    {
        assert_relative("P and U", value, 0.5, 1e-12);
    }
    // Without friction U_t = −1 + ¾ < 0, so that μ = +0.4: P_n = 1.5/2.4 = 0.625, P_t = 0.25, U_t = −1 +
    // 0.625 + 0.5.
    let sliding = scene(0.4).impact().unwrap();
    assert_eq!(sliding.regime, Some(Regime::Sliding));
    assert_relative("P_n", sliding.impulse.normal, 0.625, 1e-12);
    assert_relative("P_t", sliding.impulse.tangential, 0.25, 1e-12);
    assert_relative("U_t", sliding.separation.tangential, 0.125, 1e-12);
}

/// 1 + ε times the impulse that leaves no velocity is the one that leaves −ε u: the oracle has both methods.
#[test]
fn the_oracle_s_full_impact_reverses_both_components() {
    for_all(2000, 1.0, scene_under(Just(Tangential::FullOrSliding(1e9))), |scene| {
        let full = solve(&scene, Condition::Full);
        let reversed = solve(&scene, Condition::Restitution(scene.restitution));
        assert_same(&full, &reversed, &Scale::of(&scene, &full), 1e-10);
        true
    });
}

/// The parameters of a law can be read, and changed one at a time.
#[test]
fn a_law_with_another_ratio() {
    let law = Law::new(0.2, Tangential::Friction(0.4)).unwrap().with_moment_restitution(-0.3).unwrap();
    assert!(law.has_moment() && !law.is_affine());
    let other = law.with_ratio(-0.7);
    assert_eq!(other.tangential(), Tangential::Ratio(-0.7));
    assert_eq!((other.restitution(), other.moment_restitution()), (0.2, -0.3));
    assert!(other.is_affine());
    assert!(!Law::new(0.2, Tangential::Critical).unwrap().has_moment());
    assert!(!Law::<f64>::woolley().has_moment());
}

/// An impulse along −x has the direction π, not −π, whatever the sign of the zero across it.
#[test]
fn an_impulse_backwards_is_at_half_a_turn() {
    let body = Body::new(1500.0, 2700.0).unwrap();
    let law = Law::new(0.2, Tangential::Critical).unwrap();
    for plane in [0.0, -0.0] {
        for left in [0.0, -0.0, 1.0, -1.0] {
            let places = [
                Participant::new(body, 0.0, 2.0, left).unwrap(),
                Participant::new(body, std::f64::consts::PI, 2.0, -left).unwrap(),
            ];
            let contact = Contact::new(places, plane).unwrap();
            let motions = [Motion { velocity: Vector2::new(10.0, 0.0), yaw_rate: 0.0 }, Motion::rest()];
            let outcome = contact.impact(motions, &law).unwrap();
            assert!(outcome.impulse_vector.x < 0.0);
            if outcome.impulse_vector.y == 0.0 {
                assert_eq!(outcome.impulse_direction(), std::f64::consts::PI);
            }
            for y in [0.0, -0.0] {
                let mut backwards = outcome;
                backwards.impulse_vector = Vector2::new(-1.0, y);
                assert_eq!(backwards.impulse_direction(), std::f64::consts::PI);
            }
        }
    }
}
