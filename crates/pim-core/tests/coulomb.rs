//! Friction opposes sliding, even if the critical ratio cannot be reached.

use oracle::compare::assert_close;
use oracle::scenes::{Car, Scene, for_all, scene_under};
use oracle::{Condition, Effects, Scale, Verdict, coulomb, solve, verdict};
use pim_core::Tangential;
use proptest::prelude::*;

#[test]
fn friction_never_drives_the_sliding() {
    let law = (0.0..3.0).prop_map(Tangential::Friction);
    for_all(50_000, 0.9, scene_under(law), |scene| {
        let Tangential::Friction(limit) = scene.tangential else { return false };
        let Ok(outcome) = scene.impact() else { return false };
        let effects = Effects::from(&outcome);
        let scale = Scale::of(&scene, &effects);
        // P_t U_t ≤ 0: zero where the surfaces stick.
        assert!(effects.impulse[1] * effects.separation[1] <= scale.work * 1e-12, "{effects:?}");
        // Sliding uses all the available friction.
        if effects.separation[1].abs() > scale.velocity * 1e-9 {
            assert_close("|μ|", effects.ratio.abs(), limit, limit * 1e-12);
        }
        true
    });
}

/// A friction law always has exactly one answer: no geometry jams if friction opposes the sliding.
#[test]
fn friction_leaves_no_collision_without_an_impulse() {
    let law = (0.0..3.0).prop_map(Tangential::Friction);
    for_all(50_000, 0.9, scene_under(law), |scene| {
        use pim_core::ImpactError::EnergyCreated;
        let answer = scene.impact();
        assert!(matches!(answer, Ok(_) | Err(EnergyCreated { .. })), "{answer:?}");
        answer.is_ok()
    });
}

/// Unit mass and unit radius of gyration, C one metre ahead and one to the left of the CG; a wall along x.
///
/// Its arms along n and t are r_n = −1, r_t = 1, so that by hand k_nn = 2, k_nt = 1, k_tt = 2 and det K = 3.
/// It approaches with u = (−1, −8).
pub(crate) fn steep_sideswipe(tangential: Tangential) -> Scene {
    let wall = Car {
        fixed: true,
        mass: 1.0,
        yaw_radius: 1.0,
        heading: 0.0,
        distance: 0.0,
        angle: 0.0,
        velocity: [0.0; 2],
        yaw_rate: 0.0,
    };
    // n = +y, t = −x: C lies at (−1, −1) from the CG, and the velocity (8, −1) gives u_n = −1, u_t = −8.
    let car = Car {
        fixed: false,
        distance: 2_f64.sqrt(),
        angle: -0.75 * std::f64::consts::PI,
        velocity: [8.0, -1.0],
        ..wall
    };
    Scene {
        cars: [car, wall],
        crush_plane: std::f64::consts::FRAC_PI_2,
        restitution: 0.0,
        tangential,
        moment: -1.0,
    }
}

/// ERRATUM (theory, section 3): sign(μ_c) min(|μ_c|, μ_max) holds only if a push reaches μ_c.
#[test]
fn the_sign_of_an_unreachable_critical_ratio_is_the_wrong_one() {
    let limit = 0.5;
    let scene = steep_sideswipe(Tangential::Friction(limit));

    // U = 0 requires P = −K⁻¹u = −⅓ (2·(−1) − 1·(−8), −1·(−1) + 2·(−8)) = (−2, 5): a pull, with μ_c = −2.5.
    let sticking = solve(&scene, Condition::CommonTangential);
    assert_close("P_n", sticking.impulse[0], -2.0, 1e-12);
    assert_close("μ_c", sticking.ratio, -2.5, 1e-12);
    assert!(matches!(verdict(&Scene { tangential: Tangential::Critical, ..scene }), Verdict::Pulling(_)));

    // The rule gives μ = −½: P_n = 1/(k_nn + μ k_nt) = 2/3, P_t = −1/3, U_t = −8 + 2/3 − 2/3 = −8. Friction
    // pushes in the direction of sliding.
    let by_rule = sticking.ratio.signum() * sticking.ratio.abs().min(limit);
    let driven = Scene { tangential: Tangential::Ratio(by_rule), ..scene }.impact();
    let energy_created = matches!(driven, Err(pim_core::ImpactError::EnergyCreated { tangential_work, .. })
        if (tangential_work + 8.0 / 3.0).abs() < 1e-12);
    assert!(energy_created, "{driven:?}");

    // Against the sliding μ = +½: P_n = 1/2.5 = 0.4, P_t = 0.2, U_t = −8 + 0.4 + 0.4 = −7.2, W_t = ½·0.2·15.2
    // = 1.52.
    let outcome = scene.impact().unwrap();
    assert_close("μ", outcome.impulse_ratio, 0.5, 1e-12);
    assert_close("P_n", outcome.impulse.normal, 0.4, 1e-12);
    assert_close("P_t", outcome.impulse.tangential, 0.2, 1e-12);
    assert_close("U_t", outcome.separation.tangential, -7.2, 1e-12);
    assert_close("W_t", outcome.energy.tangential_work, 1.52, 1e-12);
    assert_eq!(outcome.critical_impulse_ratio, None);
    assert_eq!(coulomb(&scene, limit).map(|(condition, _)| condition), Some(Condition::Ratio(0.5)));
}
