//! Refusals of bodies, contacts, laws and impacts, and the advice in them.

use std::f64::consts::{FRAC_PI_2, PI};

use oracle::compare::assert_close;
use oracle::scenes::{Scene, for_all, scene, scene_under};
use oracle::{Effects, Verdict, verdict};
use pim_core::{
    Body, Contact, ImpactError, InvalidInput, Law, Motion, Participant, Real, Tangential, Vector2, VehicleId,
};
use real::Traced;

const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn car() -> Body {
    Body::new(1500.0, 2700.0).unwrap()
}

/// Head-on, along x, C two metres ahead of each.
fn head_on() -> Contact {
    Contact::new(
        [Participant::new(car(), 0.0, 2.0, 0.3).unwrap(), Participant::new(car(), PI, 2.0, 0.3).unwrap()],
        0.0,
    )
    .unwrap()
}

fn towards_each_other() -> [Motion; 2] {
    [Motion::along(0.0, 10.0), Motion::along(PI, 10.0)]
}

#[test]
fn masses_and_inertias_are_positive() {
    for bad in [0.0, -0.0, -1.0] {
        assert_eq!(Body::new(bad, 1.0), Err(InvalidInput::NotPositive { what: "mass", value: bad }));
        assert_eq!(Body::new(1.0, bad), Err(InvalidInput::NotPositive { what: "yaw inertia", value: bad }));
    }
    for bad in NOT_FINITE {
        assert!(matches!(Body::new(bad, 1.0), Err(InvalidInput::NotFinite { what: "mass", .. })));
        assert!(matches!(Body::new(1.0, bad), Err(InvalidInput::NotFinite { what: "yaw inertia", .. })));
    }
    assert!(!car().is_fixed());
    assert!(Body::<f64>::fixed().is_fixed());
    assert_eq!(
        Body::new(-3.0, 1.0).unwrap_err().to_string(),
        "the mass is -3, but must be greater than zero"
    );
}

#[test]
fn places_are_finite() {
    for bad in NOT_FINITE {
        let refused = |result: Result<Participant, InvalidInput>, name: &str| {
            assert!(
                matches!(result, Err(InvalidInput::NotFinite { what, .. }) if what.contains(name)),
                "{result:?}"
            );
        };
        refused(Participant::new(car(), bad, 1.0, 1.0), "heading");
        refused(Participant::new(car(), 0.0, bad, 1.0), "forward");
        refused(Participant::new(car(), 0.0, 1.0, bad), "left");
        refused(Participant::polar(car(), bad, 1.0, 1.0), "heading");
        refused(Participant::polar(car(), 0.0, bad, 1.0), "distance");
        refused(Participant::polar(car(), 0.0, 1.0, bad), "angle");
        let places = *head_on().participants();
        assert!(
            matches!(Contact::new(places, bad), Err(InvalidInput::NotFinite { what, .. }) if what.contains("crush plane"))
        );
    }
}

#[test]
fn angles_are_those_that_can_be_reduced() {
    let beyond = 2.0 * real::elementary::SIN_COS_LIMIT;
    let refused = |error: InvalidInput| {
        assert!(matches!(error, InvalidInput::OutOfRange { value, .. } if value == beyond));
    };
    refused(Participant::new(car(), beyond, 1.0, 1.0).unwrap_err());
    refused(Participant::polar(car(), 0.0, 1.0, beyond).unwrap_err());
    refused(Contact::new(*head_on().participants(), beyond).unwrap_err());
}

#[test]
fn two_barriers_do_not_collide() {
    let wall = Participant::barrier();
    assert_eq!(Contact::new([wall, wall], 0.0), Err(InvalidInput::BothFixed));
    let placed = Participant::new(Body::fixed(), 1.0, 2.0, 3.0).unwrap();
    assert_eq!(Contact::new([wall, placed], 0.0), Err(InvalidInput::BothFixed));
}

#[test]
fn a_normal_across_the_centres_has_no_direction() {
    // Both CGs lie on the x axis: the normal along y points to neither.
    let places =
        [Participant::new(car(), 0.0, 2.0, 0.0).unwrap(), Participant::new(car(), PI, 2.0, 0.0).unwrap()];
    assert_eq!(
        Contact::new(places, FRAC_PI_2),
        Err(InvalidInput::NormalUndefined { crush_plane: FRAC_PI_2 })
    );
    // Nor does any normal if both CGs are at C.
    let at_c = Participant::new(car(), 0.0, 0.0, 0.0).unwrap();
    assert!(matches!(Contact::new([at_c, at_c], 0.3), Err(InvalidInput::NormalUndefined { .. })));
    // A ten-millionth of a radian is enough.
    assert!(Contact::new(places, FRAC_PI_2 - 1e-7).is_ok());
}

/// A normal within 1e-12 rad of perpendicular to the line between the CGs has no direction, whatever the
/// length and direction of that line.
#[test]
fn how_near_to_across_a_normal_may_be() {
    for size in [0.05, 1.0, 30.0] {
        for turn in 0..12 {
            let direction = f64::from(turn) * PI / 6.0 + 0.1;
            let place = |sign: f64| {
                let (sin, cos) = direction.sin_cos();
                Participant::new(car(), 0.0, sign * size * cos, sign * size * sin).unwrap()
            };
            let places = [place(1.0), place(-1.0)];
            let at = |off: f64| Contact::new(places, direction + FRAC_PI_2 + off);
            assert!(at(1e-11).is_ok() && at(-1e-11).is_ok());
            assert!(at(2e-13).is_err() && at(-2e-13).is_err(), "{size} {direction}");
        }
    }
    // A barrier does not count as a second CG.
    let aside = Participant::new(car(), 0.0, 2.0, 0.0).unwrap();
    let refused = Contact::new([aside, Participant::barrier()], FRAC_PI_2);
    assert!(matches!(refused, Err(InvalidInput::NormalUndefined { .. })), "{refused:?}");
}

/// A CG on the plane is on neither side of it.
#[test]
fn a_plane_through_a_centre_does_not_separate() {
    let ahead = Participant::new(car(), PI, 2.0, 0.0).unwrap();
    let beside = Participant::new(car(), 0.0, 0.0, 1.0).unwrap();
    let clear = Participant::new(car(), 0.0, 1.0, 1.0).unwrap();
    assert!(Contact::new([clear, ahead], 0.0).unwrap().separates_centres());
    assert!(Contact::new([ahead, clear], 0.0).unwrap().separates_centres());
    assert!(!Contact::new([beside, ahead], 0.0).unwrap().separates_centres());
    assert!(!Contact::new([ahead, beside], 0.0).unwrap().separates_centres());
}

/// C at (−1, −1) m of the CG of a body with unit mass and inertia, a wall along y ahead of it: k_nn = k_tt =
/// 2, det K = 3, and |k_nt| = 1. All numbers are small integers, so that the borders are hit exactly.
fn exact(velocity: [f64; 2], yaw_rate: f64) -> (Contact, [Motion; 2]) {
    let body = Body::new(1.0, 1.0).unwrap();
    let places = [Participant::new(body, 0.0, -1.0, -1.0).unwrap(), Participant::barrier()];
    let motion = Motion { velocity: Vector2::new(velocity[0], velocity[1]), yaw_rate };
    (Contact::new(places, 0.0).unwrap(), [motion, Motion::rest()])
}

/// u_n = 0 exactly, with sliding for which a common velocity would need a push: the vehicles do not approach.
#[test]
fn sliding_along_each_other_is_no_approach() {
    let law = Law::new(0.0, Tangential::Critical).unwrap();
    for speed in [1.0, -1.0] {
        let (contact, motions) = exact([0.0, speed], 0.0);
        assert_eq!(contact.approach(&motions).velocity.normal, 0.0);
        assert_eq!(contact.impact(motions, &law), Err(ImpactError::NotApproaching { u_n: 0.0 }));
        assert!(!contact.impact_with_validity(motions, &law).1);
    }
}

/// If a common tangential velocity takes P_n = 0 exactly, it is not a push: the law is refused, and the
/// outcome of another law has no μ_c. A fraction of that μ_c is refused too, except for 0, which is
/// frictionless.
#[test]
fn no_push_is_no_critical_ratio() {
    let critical = Law::new(0.0, Tangential::Critical).unwrap();
    let mut looked = 0;
    for across in [-6.0, -4.0, -2.0, 2.0, 4.0, 6.0] {
        for ahead in [-1.0, 1.0, -2.0, 2.0] {
            let (contact, motions) = exact([ahead, across], 0.0);
            let approach = contact.approach(&motions);
            let k = contact.inverse_mass();
            let normal = critical.impulse(&k, approach).linear.normal;
            if approach.velocity.normal >= 0.0 || normal != 0.0 {
                continue;
            }
            looked += 1;
            let refused = contact.impact(motions, &critical);
            assert!(matches!(refused, Err(ImpactError::Pulling { normal_impulse: 0.0 })), "{refused:?}");
            let share = Law::new(0.0, Tangential::FractionOfCritical(f64::MIN_POSITIVE)).unwrap();
            let refused = contact.impact(motions, &share);
            assert!(matches!(refused, Err(ImpactError::Pulling { normal_impulse: 0.0 })), "{refused:?}");
            let frictionless = Law::new(0.0, Tangential::Ratio(0.0)).unwrap();
            let outcome = contact.impact(motions, &frictionless).unwrap();
            assert_eq!(outcome.critical_impulse_ratio, None);
            // μ_c = P_t/0, and 0 times that would be NaN.
            let none = Law::new(0.0, Tangential::FractionOfCritical(0.0)).unwrap();
            assert_eq!(contact.impact(motions, &none), Ok(outcome));
        }
    }
    assert!(looked > 0);
}

/// f = 0 is frictionless in every scene, even if the critical condition pulls, with and without a moment
/// impulse: it gives the impact, or the refusal, of μ = 0.
#[test]
fn no_share_of_the_critical_ratio_is_no_friction() {
    let pulls = std::cell::Cell::new(0);
    for_all(20_000, 0.8, scene(), |scene| {
        let [frictionless, none, critical] =
            [Tangential::Ratio(0.0), Tangential::FractionOfCritical(0.0), Tangential::Critical]
                .map(|law| scene.under(law).impact());
        if frictionless.is_ok() && matches!(critical, Err(ImpactError::Pulling { .. })) {
            pulls.set(pulls.get() + 1);
        }
        match (&none, &frictionless) {
            (Ok(none), Ok(frictionless)) => {
                assert_eq!(none.impulse, frictionless.impulse);
                assert_eq!(none.moment_impulse, frictionless.moment_impulse);
                assert_eq!(none.after, frictionless.after);
                assert_eq!(none.energy, frictionless.energy);
                let ratios = [none, frictionless].map(|outcome| outcome.critical_impulse_ratio);
                assert_eq!(ratios[0].is_some(), ratios[1].is_some());
            }
            _ => assert_eq!(none, frictionless),
        }
        frictionless.is_ok()
    });
    assert!(pulls.get() > 500, "{}", pulls.get());
}

/// The impulse depends on f only if a push gives μ_c; the other derivatives at f = 0 are those at μ = 0.
#[test]
fn the_derivatives_without_friction_are_numbers() {
    let outcome = |across: f64, tangential: fn(Traced) -> Tangential<Traced>| {
        let gradients = real::gradients(&[0.0, across], |numbers| {
            let &[share, across] = numbers else { unreachable!() };
            let n = Traced::from;
            let body = Body::new(n(1.0), n(1.0)).unwrap();
            let places = [Participant::new(body, n(0.0), n(-1.0), n(-1.0)).unwrap(), Participant::barrier()];
            let velocity = Vector2::new(n(-2.0), across);
            let motions = [Motion { velocity, yaw_rate: n(0.0) }, Motion::rest()];
            let law = Law::new(n(0.0), tangential(share)).unwrap();
            let outcome = Contact::new(places, n(0.0)).unwrap().impact(motions, &law)?;
            Ok::<_, ImpactError>(vec![outcome.impulse.normal, outcome.impulse.tangential])
        });
        gradients.unwrap()
    };
    for across in [-7.0, -4.0, -2.0, -1.0, 1.0, 2.0, 4.0, 7.0] {
        let none = outcome(across, Tangential::FractionOfCritical);
        let frictionless = outcome(across, |_| Tangential::Ratio(Traced::ZERO));
        for (none, frictionless) in none.iter().zip(&frictionless) {
            assert_eq!(none.value, frictionless.value);
            assert_eq!(none.by[1], frictionless.by[1], "by the velocity across, {across}");
        }
        // By hand, with K = ((2, −1), (−1, 2)) and u = (−2, across): P_n = −u_n/k_nn = 1 at f = 0, so that
        // ∂P_t/∂f = μ_c, and the impulse of μ_c is along (k_tt 2 + k_nt across, −k_nn across − k_nt 2).
        let [c_n, c_t] = [4.0 - across, 2.0 - 2.0 * across];
        let expected = if c_n > 0.0 { c_t / c_n } else { 0.0 };
        assert_close("∂P_t/∂f", none[1].by[0], expected, 1e-12);
    }
}

/// E_L may fall below zero by 1e-12 of the energy that the impulses exchange, and no further: elastic in the
/// normal direction, elastic or frictionless in the tangential one, with and without an elastic moment
/// impulse, and a little too much of the tangential impulse.
#[test]
fn rounding_may_create_energy_and_nothing_else() {
    use proptest::prelude::*;
    let moment = prop_oneof![Just(-1.0), Just(1.0)];
    let shape = (scene_under(Just(Tangential::Ratio(0.0))), moment, any::<bool>());
    let spun = std::cell::Cell::new(0);
    for_all(5000, 0.3, shape, |(scene, moment, reversed)| {
        let contact = scene.contact();
        let u_t = contact.approach(&scene.motions()).velocity.tangential;
        let law = |excess: f64| {
            let tangential = if reversed {
                Tangential::VelocityChange(-2.0 * u_t * (1.0 + excess))
            } else {
                Tangential::Ratio(excess)
            };
            Law::new(1.0, tangential).unwrap().with_moment_restitution(moment).unwrap()
        };
        // The loss relative to the exchanged energy, and whether the impact is possible.
        let at = |excess: f64| {
            let (outcome, possible) = contact.impact_with_validity(scene.motions(), &law(excess));
            let (p, u, v) = (outcome.impulse, outcome.approach, outcome.separation);
            let mut exchanged = p.normal.abs() * (u.normal.abs() + v.normal.abs())
                + p.tangential.abs() * (u.tangential.abs() + v.tangential.abs());
            let spin = |motions: [Motion; 2]| (motions[0].yaw_rate - motions[1].yaw_rate).abs();
            if moment == 1.0 {
                exchanged += outcome.moment_impulse.abs() * (spin(outcome.before) + spin(outcome.after));
            }
            (outcome.energy.loss / exchanged, possible)
        };
        // The excess of the impulse for which the loss is this fraction of the exchanged energy.
        let excess = |share: f64| {
            let far = [1e-3, -1e-3, 1.0, -1.0].into_iter().find(|&x| at(x).0 < -1e-6)?;
            let (mut within, mut beyond) = (0.0, far);
            for _ in 0..200 {
                let middle = 0.5 * (within + beyond);
                if at(middle).0 < share {
                    beyond = middle;
                } else {
                    within = middle;
                }
            }
            let pushes = contact.impact_with_validity(scene.motions(), &law(within)).0.impulse.normal > 0.0;
            (pushes && (at(within).0 / share - 1.0).abs() < 0.05).then_some(within)
        };
        if contact.impact(scene.motions(), &law(0.0)).is_err() {
            return false;
        }
        let (Some(little), Some(more)) = (excess(-0.9e-12), excess(-1.1e-12)) else { return false };
        assert!(at(little).1, "{:e}", at(little).0);
        assert!(!at(more).1, "{:e}", at(more).0);
        spun.set(spun.get() + u32::from(moment == 1.0));
        true
    });
    assert!(spun.get() > 100, "{spun:?}");
}

/// The work of a moment impulse is named if there is one.
#[test]
fn created_energy_is_told_by_its_works() {
    let text = |moment_work: f64| {
        let (loss, normal_work, tangential_work) = (-3.0, 1.0, -2.0);
        ImpactError::EnergyCreated { loss, normal_work, tangential_work, moment_work }.to_string()
    };
    assert!(text(-4.0).contains("tangential impulse, and -4.000000e0 J that of the moment impulse); check"));
    assert!(text(0.0).contains("tangential impulse); check"));
}

#[test]
fn coefficients_lie_in_their_ranges() {
    let e = |e: f64| Law::new(e, Tangential::Critical);
    let fraction = |f: f64| Law::new(0.3, Tangential::FractionOfCritical(f));
    let friction = |limit: f64| Law::new(0.3, Tangential::Friction(limit));
    let ratio = |mu: f64| Law::new(0.3, Tangential::Ratio(mu));
    for bad in NOT_FINITE {
        for law in [e(bad), fraction(bad), friction(bad), ratio(bad)] {
            assert!(matches!(law, Err(InvalidInput::NotFinite { .. })), "{law:?}");
        }
    }
    let just_above = 1.0 + f64::EPSILON;
    for bad in [-1e-300, just_above] {
        let refusal = |what| InvalidInput::OutOfRange { what, value: bad, low: 0.0, high: 1.0 };
        assert_eq!(e(bad), Err(refusal("coefficient of restitution")));
        assert_eq!(fraction(bad), Err(refusal("fraction of the critical impulse ratio")));
    }
    assert!(matches!(friction(-1e-300), Err(InvalidInput::TooSmall { low: 0.0, .. })));
    for good in [0.0, 1.0] {
        assert_eq!(e(good).unwrap().restitution(), good);
        assert!(fraction(good).is_ok());
        assert!(friction(3.0 * good).is_ok());
    }
    assert_eq!(ratio(-2.0).unwrap().tangential(), Tangential::Ratio(-2.0));
    assert_eq!(
        e(1.5).unwrap_err().to_string(),
        "the coefficient of restitution is 1.5, but must lie between 0 and 1"
    );
}

#[test]
fn motions_are_finite_and_barriers_rest() {
    let law = Law::new(0.3, Tangential::Critical).unwrap();
    let contact = head_on();
    for bad in NOT_FINITE {
        for vehicle in 0..2 {
            for (what, motion) in [
                ("velocity along x", Motion { velocity: Vector2::new(bad, 0.0), yaw_rate: 0.0 }),
                ("velocity along y", Motion { velocity: Vector2::new(0.0, bad), yaw_rate: 0.0 }),
                ("yaw rate", Motion::rest().with_yaw_rate(bad)),
            ] {
                let mut motions = towards_each_other();
                motions[vehicle] = motion;
                let refusal = contact.impact(motions, &law);
                assert!(
                    matches!(refusal, Err(ImpactError::Invalid(InvalidInput::NotFinite { what: named, .. })) if named == what),
                    "{refusal:?}"
                );
            }
        }
    }
    let mut places = *contact.participants();
    for body in VehicleId::ALL {
        places[body.index()] = Participant::new(Body::fixed(), 0.0, 0.0, 0.0).unwrap();
        if body == VehicleId::Two {
            places[0] = contact.participants()[0];
        }
        let wall = Contact::new(places, 0.0).unwrap();
        let mut motions = towards_each_other();
        motions[body.index()] = Motion::rest();
        assert!(wall.impact(motions, &law).is_ok());
        for moving in [Motion::along(0.0, 1.0), Motion::rest().with_yaw_rate(0.1)] {
            motions[body.index()] = moving;
            assert_eq!(
                wall.impact(motions, &law),
                Err(ImpactError::Invalid(InvalidInput::FixedBodyMoves { body }))
            );
        }
    }
}

#[test]
fn vehicles_that_part_or_rest_do_not_collide() {
    let law = Law::new(0.3, Tangential::Critical).unwrap();
    let parting = head_on()
        .impact(towards_each_other().map(|motion| Motion { velocity: -motion.velocity, ..motion }), &law);
    let Err(ImpactError::NotApproaching { u_n }) = parting else { panic!("{parting:?}") };
    assert_close("u_n", u_n, 20.0, 1e-12);
    let resting = head_on().impact([Motion::rest(); 2], &law);
    assert_eq!(resting, Err(ImpactError::NotApproaching { u_n: 0.0 }));
}

#[test]
fn numbers_beyond_double_precision_are_no_impact() {
    let law = Law::new(0.3, Tangential::Critical).unwrap();
    for speed in [1e200, 1e308] {
        let result = head_on().impact([Motion::along(0.0, speed), Motion::along(PI, speed)], &law);
        assert!(
            matches!(result, Err(ImpactError::Overflow { value, .. }) if !value.is_finite()),
            "{result:?}"
        );
    }
    // The vehicles approach at 20 m/s, in a scene that moves so fast that the square of its speed overflows.
    let boosted = towards_each_other()
        .map(|motion| Motion { velocity: motion.velocity + Vector2::new(0.0, 1e200), ..motion });
    let result = head_on().impact(boosted, &law);
    assert!(
        matches!(result, Err(ImpactError::Overflow { what: "initial kinetic energy", .. })),
        "{result:?}"
    );
    // The square of the inverse inertia overflows, and with it the impulse.
    let flat = Participant::new(Body::new(1500.0, 1e-300).unwrap(), 0.0, 1.5, -0.5).unwrap();
    let solid = Participant::new(Body::new(1500.0, 2500.0).unwrap(), PI, 1.5, 0.5).unwrap();
    let result = Contact::new([flat, solid], 0.0).unwrap().impact(towards_each_other(), &law);
    assert!(matches!(result, Err(ImpactError::Overflow { what: "normal impulse", .. })), "{result:?}");
}

/// The message of a jam names the ratio at which it ends: slightly beyond it there is an impulse.
#[test]
fn a_jam_ends_where_its_message_says() {
    use proptest::prelude::*;
    let law = prop_oneof![-4.0..-1.0, 1.0..4.0].prop_map(Tangential::Ratio);
    for_all(5000, 0.05, scene_under(law), |scene| {
        let Err(jam @ ImpactError::Jam { impulse_ratio, k_nn, k_nt }) = scene.impact() else { return false };
        let border = -k_nn / k_nt;
        let text = jam.to_string();
        let (side, inside) = if k_nt > 0.0 { ("above", 1e-6) } else { ("below", -1e-6) };
        assert!(text.contains(&format!("needs μ {side} {border:.6}")), "{text}");
        assert!((impulse_ratio - border) * inside <= 0.0);
        let at = |mu: f64| Scene { tangential: Tangential::Ratio(mu), ..scene };
        // Next to the jam the impulse is enormous and may well create energy, but it exists.
        assert!(!matches!(verdict(&at(border + inside)), Verdict::Jam));
        assert!(matches!(verdict(&at(border - inside)), Verdict::Jam));
        assert!(!matches!(at(border + inside).impact(), Err(ImpactError::Jam { .. })));
        assert!(matches!(at(border - inside).impact(), Err(ImpactError::Jam { .. })));
        true
    });
}

/// A frictionless push is always possible: only created energy is refused, and with e = 0 not even that
/// occurs.
#[test]
fn a_frictionless_plastic_impact_is_always_possible() {
    use proptest::prelude::*;
    for_all(5000, 1.0, scene_under(Just(Tangential::Ratio(0.0))), |scene| {
        let outcome = Scene { restitution: 0.0, ..scene }.impact().unwrap();
        assert!(Effects::from(&outcome).loss > 0.0);
        true
    });
}
