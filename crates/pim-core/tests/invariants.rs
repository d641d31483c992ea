//! Invariants of every collision: conservation, the laws' own conditions, and independence of frame,
//! numbering and handedness.

use std::f64::consts::{FRAC_PI_2, PI};
use std::mem::discriminant;

use oracle::compare::{assert_close, assert_direction};
use oracle::scenes::{Car, Scene, for_all, scene, scene_under};
use oracle::{ENERGY_UNDECIDED, Effects, Scale, arm, assert_same, cross, kinetic_energy, orientation};
use pim_core::{Contact, ImpactError, Law, Motion, Outcome, Participant, Regime, Tangential, Vector2, pdof};
use proptest::prelude::*;

/// Rounding, relative to the scale of the quantity.
const ROUNDING: f64 = 1e-12;

/// The outcome and its scale, if there is an impact.
fn impact(scene: &Scene) -> Option<(Outcome, Effects, Scale)> {
    let outcome = scene.impact().ok()?;
    let effects = Effects::from(&outcome);
    Some((outcome, effects, Scale::of(scene, &effects)))
}

#[test]
fn the_works_of_the_impulses_are_the_energy_loss() {
    for_all(20_000, 0.7, scene(), |scene| {
        let Some((outcome, effects, scale)) = impact(&scene) else { return false };
        let tolerance = (scale.energy + scale.work) * ROUNDING;
        let energy = outcome.energy;
        let works = energy.normal_work + energy.tangential_work + energy.moment_work;
        assert_close("W_n + W_t + W_m", works, energy.loss, tolerance);
        assert_close("T − T′", energy.before - energy.after, energy.loss, tolerance);
        // The kinetic energies again, from the motions.
        let sum = |motions: [([f64; 2], f64); 2]| {
            (0..2).map(|i| kinetic_energy(&scene.cars[i], motions[i].0, motions[i].1)).sum::<f64>()
        };
        let before = sum(scene.cars.map(|car| (car.velocity, car.yaw_rate)));
        let after = sum([0, 1].map(|i| (effects.velocities[i], effects.yaw_rates[i])));
        assert_close("T", energy.before, before, tolerance);
        assert_close("T′", energy.after, after, tolerance);
        assert!(energy.loss >= -tolerance, "E_L = {}", energy.loss);
        assert!(energy.before >= 0.0 && energy.after >= 0.0);
        true
    });
}

#[test]
fn free_bodies_keep_their_momentum() {
    let place = || [-50.0..50.0, -50.0..50.0];
    for_all(20_000, 0.5, (scene(), place(), place()), |(scene, c, origin)| {
        let Some((_, effects, scale)) = impact(&scene) else { return false };
        if scene.has_barrier() {
            return false;
        }
        let mut linear = [0.0; 2];
        let mut angular = 0.0;
        let mut size = 0.0;
        let mut moment_size = 0.0;
        for (i, car) in scene.cars.iter().enumerate() {
            let inertia = car.mass * car.yaw_radius * car.yaw_radius;
            // The CG lies at C − r; moments are about an arbitrary point.
            let lever = [c[0] - arm(car)[0] - origin[0], c[1] - arm(car)[1] - origin[1]];
            let change = [0, 1].map(|axis| car.mass * (effects.velocities[i][axis] - car.velocity[axis]));
            linear = [linear[0] + change[0], linear[1] + change[1]];
            angular += cross(lever, change) + inertia * (effects.yaw_rates[i] - car.yaw_rate);
            // A velocity is accurate to a rounding error of its scale, a momentum to that times the mass.
            size += car.mass * scale.velocity;
            moment_size +=
                car.mass * scale.velocity * lever[0].hypot(lever[1]) + inertia * scale.yaw_rates[i];
        }
        assert_close("momentum along x", linear[0], 0.0, size * ROUNDING);
        assert_close("momentum along y", linear[1], 0.0, size * ROUNDING);
        assert_close("angular momentum", angular, 0.0, moment_size * ROUNDING);
        true
    });
}

#[test]
fn a_barrier_stays_where_it_is() {
    for_all(5000, 0.1, scene(), |scene| {
        let Some((outcome, _, _)) = impact(&scene) else { return false };
        let fixed: Vec<usize> = (0..2).filter(|&i| scene.cars[i].fixed).collect();
        for &i in &fixed {
            assert_eq!(outcome.after[i], outcome.before[i]);
            assert_eq!(outcome.delta_v_magnitude()[i], 0.0);
        }
        !fixed.is_empty()
    });
}

#[test]
fn the_motions_differ_by_delta_v() {
    for_all(5000, 0.7, scene(), |scene| {
        let Some((outcome, effects, scale)) = impact(&scene) else { return false };
        for i in 0..2 {
            let change = outcome.after[i].velocity - outcome.before[i].velocity;
            let dv = outcome.delta_v[i];
            assert_close("ΔV along x", dv.x, change.x, scale.velocity * ROUNDING);
            assert_close("ΔV along y", dv.y, change.y, scale.velocity * ROUNDING);
            assert_close("|ΔV|", outcome.delta_v_magnitude()[i], dv.x.hypot(dv.y), scale.velocity * ROUNDING);
            assert_eq!(outcome.before[i], scene.motions()[i]);
        }
        let [p, t] = effects.impulse;
        assert_close("|P|", outcome.impulse_vector.norm(), p.hypot(t), scale.impulse * ROUNDING);
        true
    });
}

#[test]
fn the_normal_velocity_is_reversed_by_the_restitution() {
    for_all(20_000, 0.7, scene(), |scene| {
        let Some((_, effects, scale)) = impact(&scene) else { return false };
        let expected = -scene.restitution * effects.approach[0];
        assert_close("U_n", effects.separation[0], expected, scale.velocity * ROUNDING);
        assert!(effects.impulse[0] > 0.0);
        true
    });
}

/// K, which relates impulses to the motion of C, compared with the motions of the vehicles themselves.
#[test]
fn the_contact_moves_after_the_impact_as_the_vehicles_do() {
    for_all(5000, 0.7, scene(), |scene| {
        let Some((outcome, effects, scale)) = impact(&scene) else { return false };
        let contact = scene.contact();
        let before = contact.approach(&scene.motions());
        let after = contact.inverse_mass().separation(before, outcome.impulse, outcome.moment_impulse);
        let [w1, w2] = effects.yaw_rates;
        let size = scale.yaw_rates[0] + scale.yaw_rates[1];
        assert_close("Ω₁ − Ω₂", after.relative_yaw_rate, w1 - w2, size * ROUNDING);
        assert_close("U_n", after.velocity.normal, effects.separation[0], scale.velocity * ROUNDING);
        assert_close("U_t", after.velocity.tangential, effects.separation[1], scale.velocity * ROUNDING);
        true
    });
}

#[test]
fn the_impulse_ratio_is_the_one_asked_for() {
    for_all(20_000, 0.7, scene(), |scene| {
        let Some((outcome, effects, scale)) = impact(&scene) else { return false };
        let [p_n, p_t] = effects.impulse;
        let tolerance = scale.impulse * ROUNDING;
        match scene.tangential {
            Tangential::Critical => {
                assert_close("U_t", effects.separation[1], 0.0, scale.velocity * ROUNDING);
                if scene.restitution == 0.0 {
                    // Vehicle 1 and vehicle 2 share the velocity of C.
                    assert_close("U_n", effects.separation[0], 0.0, scale.velocity * ROUNDING);
                }
                let critical = effects.critical_ratio.unwrap();
                assert_close("μ", effects.ratio, critical, scale.ratio * ROUNDING);
            }
            Tangential::Ratio(mu) => assert_close("P_t", p_t, mu * p_n, tolerance),
            Tangential::FractionOfCritical(0.0) => assert_close("P_t", p_t, 0.0, tolerance),
            Tangential::FractionOfCritical(f) => {
                let critical = effects.critical_ratio.unwrap();
                assert_close("μ", effects.ratio, f * critical, scale.ratio * ROUNDING);
            }
            Tangential::Friction(limit) => assert!(p_t.abs() <= limit * p_n + tolerance),
            Tangential::VelocityChange(change) => {
                let actual = effects.separation[1] - effects.approach[1];
                assert_close("U_t − u_t", actual, change, scale.velocity * ROUNDING);
            }
            Tangential::Restitution(e_t) => {
                let expected = -e_t * effects.approach[1];
                assert_close("U_t", effects.separation[1], expected, scale.velocity * ROUNDING);
            }
            Tangential::FullOrSliding(limit) => match outcome.regime {
                Some(Regime::Full) => {
                    let expected = -scene.restitution * effects.approach[1];
                    assert_close("U_t", effects.separation[1], expected, scale.velocity * ROUNDING);
                    assert!(p_t.abs() <= limit * p_n + tolerance);
                }
                Some(Regime::Sliding) => assert_close("|P_t|", p_t.abs(), limit * p_n, tolerance),
                None => panic!("a law with a limit says whether it was reached"),
            },
        }
        let limited = matches!(scene.tangential, Tangential::Friction(_) | Tangential::FullOrSliding(_));
        assert_eq!(outcome.regime.is_some(), limited);
        true
    });
}

#[test]
fn without_restitution_a_common_velocity_is_common() {
    let law = Just(Tangential::Critical);
    for_all(5000, 0.8, scene_under(law), |scene| {
        let scene = Scene { restitution: 0.0, ..scene };
        let Some((outcome, _, scale)) = impact(&scene) else { return false };
        // The velocity of each vehicle's material at C, in the scene: V + Ω×r.
        let [a, b] = [0, 1].map(|i| {
            let [x, y] = arm(&scene.cars[i]);
            let after = outcome.after[i];
            [after.velocity.x - after.yaw_rate * y, after.velocity.y + after.yaw_rate * x]
        });
        let tolerance = (scale.velocity + 4.0 * (scale.yaw_rates[0] + scale.yaw_rates[1])) * ROUNDING;
        assert_close("velocity of C along x", a[0], b[0], tolerance);
        assert_close("velocity of C along y", a[1], b[1], tolerance);
        true
    });
}

/// An elastic impact without friction takes no energy: rounding must not turn that into created energy.
#[test]
fn an_elastic_impact_without_friction_is_possible() {
    let law = prop_oneof![
        Just(Tangential::Ratio(0.0)),
        Just(Tangential::FractionOfCritical(0.0)),
        Just(Tangential::Friction(0.0)),
    ];
    for_all(20_000, 0.7, scene_under(law), |scene| {
        let scene = Scene { restitution: 1.0, ..scene };
        match scene.impact() {
            Ok(outcome) => {
                let effects = Effects::from(&outcome);
                let scale = Scale::of(&scene, &effects);
                assert_close("E_L", effects.loss, 0.0, scale.work * ROUNDING);
                true
            }
            Err(ImpactError::Pulling { .. }) => false,
            Err(error) => panic!("{error:?}"),
        }
    });
}

/// Compares a collision with an equivalent one: `change` transforms its effects.
#[track_caller]
fn assert_equivalent(scene: &Scene, other: &Scene, change: impl Fn(&Effects, &Effects) -> Effects) -> bool {
    match (scene.impact(), other.impact()) {
        (Ok(outcome), Ok(other_outcome)) => {
            let (original, transformed) = (Effects::from(&outcome), Effects::from(&other_outcome));
            let expected = change(&original, &transformed);
            let scale = Scale::of(scene, &original).max(Scale::of(other, &transformed));
            assert_same(&transformed, &expected, &scale, ROUNDING);
            true
        }
        (Err(a), Err(b)) => {
            assert_eq!(discriminant(&a), discriminant(&b), "{a} / {b}");
            false
        }
        (Ok(outcome), Err(ImpactError::EnergyCreated { .. }))
        | (Err(ImpactError::EnergyCreated { .. }), Ok(outcome)) => {
            let effects = Effects::from(&outcome);
            let scale = Scale::of(scene, &effects);
            assert!(effects.loss.abs() <= (scale.energy + scale.work) * ENERGY_UNDECIDED);
            false
        }
        (a, b) => panic!("{a:?} / {b:?}"),
    }
}

fn turn([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

#[test]
fn the_axes_of_the_scene_do_not_matter() {
    for_all(10_000, 0.7, (scene(), -PI..PI), |(scene, angle)| {
        let other = Scene { crush_plane: scene.crush_plane + angle, ..scene }.with_cars(|car| Car {
            heading: car.heading + angle,
            velocity: turn(car.velocity, angle),
            ..car
        });
        assert_equivalent(&scene, &other, |effects, _| Effects {
            impulse_vector: turn(effects.impulse_vector, angle),
            velocities: effects.velocities.map(|v| turn(v, angle)),
            delta_v: effects.delta_v.map(|v| turn(v, angle)),
            impulse_direction: effects.impulse_direction + angle,
            ..*effects
        })
    });
}

#[test]
fn the_speed_of_the_scene_does_not_matter() {
    for_all(10_000, 0.5, (scene(), [-60.0..60.0, -60.0..60.0]), |(scene, [x, y])| {
        if scene.has_barrier() {
            return false;
        }
        let boost = |v: [f64; 2]| [v[0] + x, v[1] + y];
        let other = scene.with_cars(|car| Car { velocity: boost(car.velocity), ..car });
        assert_equivalent(&scene, &other, |effects, boosted| Effects {
            velocities: effects.velocities.map(boost),
            // Kinetic energy depends on the frame; its loss does not.
            energy_before: boosted.energy_before,
            energy_after: boosted.energy_after,
            ..*effects
        })
    });
}

#[test]
fn the_labels_of_the_vehicles_do_not_matter() {
    for_all(10_000, 0.7, scene(), |scene| {
        let [a, b] = scene.cars;
        let other = Scene { cars: [b, a], ..scene };
        let swap = |[a, b]: [[f64; 2]; 2]| [b, a];
        assert_equivalent(&scene, &other, |effects, _| Effects {
            // n, t, the force and the relative velocity are all reversed: their components are unchanged.
            moment: -effects.moment,
            impulse_vector: effects.impulse_vector.map(|p| -p),
            impulse_direction: effects.impulse_direction + PI,
            velocities: swap(effects.velocities),
            delta_v: swap(effects.delta_v),
            yaw_rates: [effects.yaw_rates[1], effects.yaw_rates[0]],
            pdof: [effects.pdof[1], effects.pdof[0]],
            ..*effects
        })
    });
}

#[test]
fn both_normals_of_the_crush_plane_mean_the_same() {
    for_all(10_000, 0.7, scene(), |scene| {
        let other = Scene { crush_plane: scene.crush_plane + PI, ..scene };
        assert_equivalent(&scene, &other, |effects, _| *effects)
    });
}

#[test]
fn a_mirror_changes_the_hand_and_nothing_else() {
    for_all(10_000, 0.7, scene(), |scene| {
        let flip = |[x, y]: [f64; 2]| [x, -y];
        let other = Scene {
            crush_plane: -scene.crush_plane,
            tangential: match scene.tangential {
                Tangential::Ratio(mu) => Tangential::Ratio(-mu),
                Tangential::VelocityChange(change) => Tangential::VelocityChange(-change),
                law => law,
            },
            ..scene
        }
        .with_cars(|car| Car {
            heading: -car.heading,
            angle: -car.angle,
            velocity: flip(car.velocity),
            yaw_rate: -car.yaw_rate,
            ..car
        });
        // The crates' own mirror is the same one.
        assert_eq!(scene.law().mirrored(), other.law());
        let (contact, mirrored) = (scene.contact(), other.contact());
        for (actual, expected) in [
            (contact.mirrored().normal(), mirrored.normal()),
            (contact.mirrored().participants()[0].arm(), mirrored.participants()[0].arm()),
            (contact.mirrored().participants()[1].forward(), mirrored.participants()[1].forward()),
        ] {
            assert_close("x", actual.x, expected.x, 1e-12);
            assert_close("y", actual.y, expected.y, 1e-12);
        }
        if let (Ok(outcome), Ok(expected)) =
            (scene.impact(), contact.mirrored().impact(other.motions(), &other.law()))
        {
            assert_eq!(outcome.mirrored().before, expected.before);
            let scale = expected.energy.before + 1.0;
            assert_close("E_L", outcome.mirrored().energy.loss, expected.energy.loss, 1e-9 * scale);
            let size = 1e-7 * (1.0 + expected.impulse_ratio.abs());
            assert_close("μ", outcome.mirrored().impulse_ratio, expected.impulse_ratio, size);
        }
        assert_equivalent(&scene, &other, |effects, _| Effects {
            impulse: flip(effects.impulse),
            approach: flip(effects.approach),
            separation: flip(effects.separation),
            impulse_vector: flip(effects.impulse_vector),
            velocities: effects.velocities.map(flip),
            delta_v: effects.delta_v.map(flip),
            yaw_rates: effects.yaw_rates.map(|yaw| -yaw),
            moment: -effects.moment,
            ratio: -effects.ratio,
            critical_ratio: effects.critical_ratio.map(|mu| -mu),
            impulse_direction: -effects.impulse_direction,
            pdof: effects.pdof.map(|pdof| -pdof),
            ..*effects
        })
    });
}

#[test]
fn polar_and_cartesian_contacts_are_the_same() {
    for_all(2000, 1.0, scene(), |scene| {
        for car in scene.cars {
            let polar = car.participant();
            let (sin, cos) = car.angle.sin_cos();
            let cartesian =
                Participant::new(*polar.body(), car.heading, car.distance * cos, car.distance * sin).unwrap();
            let expected = arm(&car);
            for arm in [polar.arm(), cartesian.arm()] {
                assert_close("arm along x", arm.x, expected[0], 8.0 * ROUNDING);
                assert_close("arm along y", arm.y, expected[1], 8.0 * ROUNDING);
            }
            assert_close("forward axis", polar.forward().x, car.heading.cos(), ROUNDING);
            assert_close("forward axis", polar.forward().y, car.heading.sin(), ROUNDING);
        }
        true
    });
}

#[test]
fn the_normal_points_from_vehicle_2_to_vehicle_1() {
    for_all(5000, 1.0, scene(), |scene| {
        let contact = scene.contact();
        let [r1, r2] = scene.cars.map(|car| arm(&car));
        let n = contact.normal();
        assert!(n.x * (r2[0] - r1[0]) + n.y * (r2[1] - r1[1]) > 0.0);
        assert_close("|n|", n.norm(), 1.0, ROUNDING);
        // The same plane.
        let turned = n.x * scene.crush_plane.sin() - n.y * scene.crush_plane.cos();
        assert_close("n × Γ", turned, 0.0, ROUNDING);
        // Γ as given, and n along it or against it.
        assert_eq!(contact.crush_plane().to_bits(), scene.crush_plane.to_bits());
        let along = n.x * scene.crush_plane.cos() + n.y * scene.crush_plane.sin();
        assert_eq!(contact.is_turned(), along < 0.0);
        assert_direction("n", contact.normal_angle(), f64::atan2(n.y, n.x), ROUNDING);
        assert!((-PI..=PI).contains(&contact.normal_angle()));
        let mirrored = contact.mirrored();
        assert_direction("n mirrored", mirrored.normal_angle(), f64::atan2(-n.y, n.x), ROUNDING);
        // Between the CGs, except that a barrier has none.
        let [d1, d2] = [r1, r2].map(|r| n.x * r[0] + n.y * r[1]);
        let separates = (scene.cars[0].fixed || d1 < 0.0) && (scene.cars[1].fixed || d2 > 0.0);
        assert_eq!(contact.separates_centres(), separates);
        true
    });
}

/// A barrier without known geometry: n points from it to the other vehicle's CG.
#[test]
fn a_barrier_without_a_place_orients_the_normal_by_the_other_vehicle() {
    for_all(5000, 0.6, scene(), |mut scene| {
        scene.cars[0].fixed = false;
        scene.cars[1] =
            Car { fixed: true, distance: 0.0, velocity: [0.0; 2], yaw_rate: 0.0, ..scene.cars[1] };
        if orientation(&scene) < 1e-6 {
            return false;
        }
        let scene = scene.approaching();
        let r1 = arm(&scene.cars[0]);
        let contact =
            Contact::new([scene.cars[0].participant(), Participant::barrier()], scene.crush_plane).unwrap();
        assert!(contact.normal().x * r1[0] + contact.normal().y * r1[1] < 0.0);
        match (contact.impact(scene.motions(), &scene.law()), scene.impact()) {
            (Ok(actual), Ok(expected)) => {
                assert_eq!(actual.impulse, expected.impulse);
                assert_eq!(actual.after, expected.after);
                true
            }
            (actual, expected) => {
                assert_eq!(actual.is_err(), expected.is_err());
                false
            }
        }
    });
}

#[test]
fn the_forces_on_the_vehicles_are_opposite() {
    for_all(10_000, 0.7, scene(), |scene| {
        let Some((outcome, _, scale)) = impact(&scene) else { return false };
        // A PDOF is clockwise from the heading: in the scene the force comes from θ − PDOF.
        let [from1, from2] = [0, 1].map(|i| scene.cars[i].heading - outcome.pdof()[i]);
        let tolerance = scale.direction * ROUNDING;
        assert_direction("the force on vehicle 2", from2, from1 + PI, tolerance);
        assert_direction("the force on vehicle 1 goes", outcome.impulse_direction(), from1 + PI, tolerance);
        true
    });
}

/// A car at rest that points east, struck at (`forward`, `left`) by one on the given course.
fn struck(forward: f64, left: f64, course: f64) -> Scene {
    let target = Car {
        fixed: false,
        mass: 1500.0,
        yaw_radius: 1.4,
        heading: 0.0,
        distance: f64::hypot(forward, left),
        angle: f64::atan2(left, forward),
        velocity: [0.0, 0.0],
        yaw_rate: 0.0,
    };
    let bullet = Car { heading: course, distance: 2.0, angle: 0.0, ..target }.at_speed(10.0);
    Scene {
        cars: [target, bullet],
        crush_plane: course,
        restitution: 0.2,
        tangential: Tangential::Critical,
        moment: -1.0,
    }
}

#[test]
fn pdof_is_clockwise_from_the_heading() {
    for (what, scene, pdof) in [
        ("in front", struck(2.0, 0.0, PI), 0.0),
        ("from the right, by a car that goes north", struck(0.0, -0.9, FRAC_PI_2), FRAC_PI_2),
        ("from the left, by a car that goes south", struck(0.0, 0.9, -FRAC_PI_2), -FRAC_PI_2),
        ("from behind", struck(-2.0, 0.0, 0.0), PI),
        // The other car goes north-west: the force comes from the south-east, ahead and to the right.
        ("at the right front corner", struck(1.8, -0.9, 0.75 * PI), PI / 4.0),
    ] {
        let outcome = scene.impact().unwrap();
        // The force at the corner need not be normal to the plane, so its direction is known only roughly.
        let corner = what == "at the right front corner";
        let tolerance = if corner { 0.5 } else { ROUNDING };
        assert_direction(what, outcome.pdof()[0], pdof, tolerance);
        assert_direction(what, outcome.pdof()[1], 0.0, tolerance);
    }
}

/// In every orientation, and with either way to write the crush plane.
#[test]
fn pdof_from_behind_is_never_minus_180_degrees() {
    let body = *struck(-2.0, 0.0, 0.0).cars[0].participant().body();
    let law = Law::new(0.2, Tangential::Critical).unwrap();
    for step in 0..720 {
        let heading = f64::from(step) * PI / 360.0;
        let struck = Participant::new(body, heading, -2.0, 0.0).unwrap();
        let bullet = Participant::new(body, heading, 2.0, 0.0).unwrap();
        for plane in [heading, heading - PI, heading + PI] {
            let contact = Contact::new([struck, bullet], plane).unwrap();
            let outcome = contact.impact([Motion::rest(), Motion::along(heading, 10.0)], &law).unwrap();
            assert_eq!(outcome.pdof()[0], PI, "{step} {plane}");
            let direction = outcome.impulse_direction();
            assert!(direction > -PI + 1e-9 && direction <= PI, "{step} {plane}: {direction}");
        }
    }
}

/// A push from straight behind is at +180°, where the angle jumps.
#[test]
fn pdof_from_behind_is_plus_180_degrees() {
    let body = *struck(-2.0, 0.0, 0.0).cars[0].participant().body();
    let law = Law::new(0.2, Tangential::Critical).unwrap();
    for zero in [0.0, -0.0] {
        let struck = Participant::new(body, zero, -2.0, zero).unwrap();
        let bullet = Participant::new(body, 0.0, 2.0, 0.0).unwrap();
        let contact = Contact::new([struck, bullet], zero).unwrap();
        let outcome = contact.impact([Motion::rest(), Motion::along(0.0, 10.0)], &law).unwrap();
        assert_eq!(outcome.pdof(), [PI, 0.0]);
        for impulse in [Vector2::new(1.0, 0.0), Vector2::new(1.0, -0.0)] {
            assert_eq!(pdof(struck.forward(), impulse), PI);
        }
    }
}
