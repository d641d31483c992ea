//! Every impact of random collisions agrees with the oracle's brute-force solution, and is refused if there
//! is none.

use std::f64::consts::PI;

use oracle::compare::assert_close;
use oracle::scenes::{Car, Scene, any_scene, for_all, scene};
use oracle::{Condition, ENERGY_UNDECIDED, Effects, Scale, Verdict, approach, assert_same, solve, verdict};
use pim_core::{ImpactError, Tangential};

#[test]
fn impact_is_the_brute_force_solution() {
    for_all(100_000, 0.7, scene(), |scene| {
        let actual = scene.impact();
        match (verdict(&scene), actual) {
            (Verdict::Impact(expected), Ok(actual)) => {
                let scale = Scale::of(&scene, &expected);
                assert_same(&Effects::from(&actual), &expected, &scale, 1e-10);
                true
            }
            (Verdict::EnergyCreated(expected), Ok(actual)) => {
                let scale = Scale::of(&scene, &expected);
                assert!(expected.loss.abs() < (scale.energy + scale.work) * ENERGY_UNDECIDED, "{expected:?}");
                assert_same(&Effects::from(&actual), &expected, &scale, 1e-10);
                true
            }
            (Verdict::Impact(expected), Err(ImpactError::EnergyCreated { .. })) => {
                let scale = Scale::of(&scene, &expected);
                assert!(expected.loss.abs() < (scale.energy + scale.work) * ENERGY_UNDECIDED, "{expected:?}");
                false
            }
            (
                Verdict::EnergyCreated(expected),
                Err(ImpactError::EnergyCreated { loss, normal_work, tangential_work, moment_work }),
            ) => {
                let scale = Scale::of(&scene, &expected);
                assert_close("E_L", loss, expected.loss, (scale.energy + scale.work) * 1e-10);
                assert_close("W_n", normal_work, expected.normal_work, scale.work * 1e-10);
                assert_close("W_t", tangential_work, expected.tangential_work, scale.work * 1e-10);
                assert_close("W_m", moment_work, expected.moment_work, scale.work * 1e-10);
                false
            }
            (Verdict::Jam, Err(ImpactError::Jam { impulse_ratio, k_nn, k_nt })) => {
                assert!(k_nn + impulse_ratio * k_nt <= 0.0);
                match scene.tangential {
                    Tangential::Ratio(mu) => assert_eq!(impulse_ratio, mu),
                    Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => {
                        assert_close("|μ|", impulse_ratio.abs(), limit, limit * 1e-12);
                    }
                    // A fraction of μ_c jams only if it takes the moment impulse to make μ_c a push.
                    Tangential::FractionOfCritical(_) => assert!(scene.moment > -1.0),
                    law => panic!("{law:?} gives no ratio"),
                }
                false
            }
            (Verdict::Pulling(expected), Err(ImpactError::Pulling { normal_impulse })) => {
                let common = solve(&scene, Condition::CommonTangential);
                let scene = match scene.tangential {
                    Tangential::FractionOfCritical(f) if f != 0.0 => scene.under(Tangential::Critical),
                    _ => scene,
                };
                let scale = Scale::of(&scene, &common);
                assert_close("P_n", normal_impulse, expected, scale.impulse * 1e-10);
                false
            }
            (expected, actual) => panic!("{actual:?} is not {expected:?}"),
        }
    });
}

#[test]
fn vehicles_that_do_not_approach_have_no_impact() {
    for_all(10_000, 0.4, any_scene(), |scene| {
        let u_n = approach(&scene)[0];
        match scene.impact() {
            Err(ImpactError::NotApproaching { u_n: reported }) => {
                assert!(u_n >= 0.0);
                assert_close("u_n", reported, u_n, 1e-12 * 200.0);
                true
            }
            _ => {
                assert!(u_n < 0.0);
                false
            }
        }
    });
}

/// The oracle itself, on a case that can be solved by hand: equal point masses, head-on, with e = ½ and no
/// friction.
#[test]
fn the_oracle_knows_a_textbook_impact() {
    let car = Car {
        fixed: false,
        mass: 1000.0,
        yaw_radius: 1.5,
        heading: 0.0,
        distance: 2.0,
        angle: 0.0,
        velocity: [10.0, 0.0],
        yaw_rate: 0.0,
    };
    let other = Car { heading: PI, velocity: [-10.0, 0.0], ..car };
    let scene = Scene {
        cars: [car, other],
        crush_plane: 0.0,
        restitution: 0.5,
        tangential: Tangential::Ratio(0.0),
        moment: -1.0,
    };
    let Verdict::Impact(effects) = verdict(&scene) else { panic!("an impact") };
    // U = −½ u: each leaves at 5 m/s; P = m ΔV; ¾ of the energy is lost.
    assert_close("P_n", effects.impulse[0], 15_000.0, 1e-9);
    assert_close("V_1", effects.velocities[0][0], -5.0, 1e-12);
    assert_close("V_2", effects.velocities[1][0], 5.0, 1e-12);
    assert_close("E_L", effects.loss, 75_000.0, 1e-8);
    assert_close("W_n", effects.normal_work, 75_000.0, 1e-8);
    assert_close("PDOF", effects.pdof[0], 0.0, 1e-12);
    assert_close("PDOF", effects.pdof[1], 0.0, 1e-12);
}
