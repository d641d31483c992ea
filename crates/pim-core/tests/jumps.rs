//! Jumps of the impulse at a friction limit, and where there are none.

use oracle::compare::{assert_close, assert_relative};
use oracle::scenes::{Scene, for_all, scene, scene_under};
use oracle::{Condition, solve};
use pim_core::{Approach, Border, Law, NormalTangential, Switch, Tangential};
use proptest::prelude::*;

/// The borders of the scene's law, each with the impulses on both sides.
fn borders(scene: &Scene) -> Vec<(Border, [NormalTangential; 2])> {
    let (k, approach) = at(scene);
    let borders = scene.law().borders(&k, approach).into_iter().flatten();
    borders.map(|border| (border, border.laws.map(|law| law.impulse(&k, approach).linear))).collect()
}

fn at(scene: &Scene) -> (pim_core::InverseMass, Approach) {
    let contact = scene.contact();
    (contact.inverse_mass(), contact.approach(&scene.motions()))
}

fn size(p: NormalTangential) -> f64 {
    p.normal.hypot(p.tangential)
}

fn distance(a: NormalTangential, b: NormalTangential) -> f64 {
    (a.normal - b.normal).hypot(a.tangential - b.tangential)
}

/// Theory, section 3: without a moment impulse, both regimes have the same impulse at their border, and the
/// direction of sliding reverses where nothing slides.
#[test]
fn coulomb_friction_is_continuous_without_a_moment() {
    let law = (0.0..1.5).prop_map(Tangential::Friction);
    for_all(20_000, 0.9, scene_under(law), |scene| {
        let (k, approach) = at(&scene);
        let mut has_limit = false;
        for (border, [one, other]) in borders(&scene) {
            assert!(distance(one, other) <= size(one) * 1e-9, "{border:?} {one:?} {other:?}");
            let Switch::Limit(needed) = border.switch else { continue };
            has_limit = true;
            // The law itself, on both sides of its border.
            let [below, above] = [1.0 - 1e-9, 1.0 + 1e-9].map(|share| {
                let law = Law::new(scene.restitution, Tangential::Friction(needed * share)).unwrap();
                law.impulse(&k, approach).linear
            });
            assert!(distance(below, above) <= size(above) * 1e-6, "{border:?} {below:?} {above:?}");
        }
        has_limit
    });
}

/// M_slide/M_full = 1 − e_m (b_full/b_slide − 1) of theory, section 3, against the oracle, which solves both
/// regimes by elimination.
#[test]
fn the_jump_of_a_moment() {
    let any = (scene(), 0.01..1.5, -0.99..0.99).prop_map(|(scene, limit, moment): (Scene, f64, f64)| Scene {
        tangential: Tangential::Friction(limit),
        moment,
        ..scene
    });
    for_all(5_000, 0.3, any, |scene| {
        let (k, approach) = at(&scene);
        let Some((Border { switch: Switch::Limit(needed), laws, .. }, [one, other])) =
            borders(&scene).into_iter().find(|(border, _)| matches!(border.switch, Switch::Limit(_)))
        else {
            return false;
        };
        let Tangential::Ratio(mu) = laws[1].tangential() else { panic!("{laws:?}") };
        let (full, sliding) =
            (solve(&scene, Condition::CommonTangential), solve(&scene, Condition::Ratio(mu)));
        // Near a jam rounding grows, and so does the jump.
        let det = k.nn * k.tt - k.nt * k.nt;
        if needed > 10.0 || (k.nn + mu * k.nt) < 0.1 * k.nn || (full.ratio - mu).abs() > 1e-6 {
            return false;
        }
        assert_relative("μ", needed, full.ratio.abs(), 1e-9);
        assert_relative("P_n full", one.normal, full.impulse[0], 1e-9);
        assert_relative("P_n sliding", other.normal, sliding.impulse[0], 1e-8);
        // b = k_mm − k_mᵀ K⁻¹ k_m, and k_mm − k_nm (k_nm + μ k_tm)/(k_nn + μ k_nt)
        let b_full = k.mm - (k.tt * k.nm * k.nm - 2.0 * k.nt * k.nm * k.tm + k.nn * k.tm * k.tm) / det;
        let b_slide = k.mm - k.nm * (k.nm + mu * k.tm) / (k.nn + mu * k.nt);
        if b_slide.abs() < 0.01 * k.mm {
            return false;
        }
        let expected = full.moment * (1.0 - scene.moment * (b_full / b_slide - 1.0));
        let scale = full.moment.abs().max(expected.abs());
        assert_close("M of sliding", sliding.moment, expected, scale * 1e-6);
        let moments = laws.map(|law| law.impulse(&k, approach).moment);
        assert_close("M", moments[0], full.moment, scale * 1e-8);
        assert_close("M sliding", moments[1], sliding.moment, scale * 1e-6);
        true
    });
}

/// A common yaw rate, e_m = 0, is a third linear condition that both regimes share.
#[test]
fn a_common_yaw_rate_is_continuous() {
    let any = (scene(), 0.0..1.5).prop_map(|(scene, limit): (Scene, f64)| Scene {
        tangential: Tangential::Friction(limit),
        moment: 0.0,
        ..scene
    });
    for_all(20_000, 0.7, any, |scene| {
        let all = borders(&scene);
        // With a moment impulse the vehicles may pull, which is not an impact.
        for (border, [one, other]) in all.iter().filter(|(_, sides)| sides.iter().all(|p| p.normal > 0.0)) {
            assert!(distance(*one, *other) <= size(*one) * 1e-6, "{border:?} {one:?} {other:?}");
        }
        !all.is_empty()
    });
}

/// Theory, section 3: Kudlich and Slibar's law jumps exactly where the normal impulse reverses the sliding to
/// less than ε |u_t|.
#[test]
fn kudlich_slibar_jumps_where_the_signs_differ() {
    let law = (0.0..1.0).prop_map(Tangential::FullOrSliding);
    for differ in [false, true] {
        let least_kept = if differ { 0.005 } else { 0.7 };
        for_all(20_000, least_kept, scene_under(law.clone()), |scene| {
            let free = solve(&scene, Condition::Ratio(0.0));
            let (u_t, v_t) = (free.approach[1], free.separation[1]);
            let full = solve(&scene, Condition::Full);
            let scale = u_t.abs() + v_t.abs();
            let opposite = u_t * v_t < 0.0 && v_t.abs() < scene.restitution * u_t.abs();
            // Only if neither is zero to rounding.
            if opposite != differ || v_t.abs() < 1e-6 * scale || full.impulse[0] <= 0.0 {
                return false;
            }
            let limit =
                borders(&scene).into_iter().find(|(border, _)| matches!(border.switch, Switch::Limit(_)));
            let Some((border, [one, other])) = limit else { return false };
            if full.ratio.abs() < 1e-6 {
                return false;
            }
            let jumps = distance(one, other) > size(one) * 1e-7;
            assert_eq!(jumps, differ, "{border:?} {one:?} {other:?}");
            assert_eq!(one.tangential * other.tangential < 0.0, differ && other.normal > 0.0);
            true
        });
    }
}
