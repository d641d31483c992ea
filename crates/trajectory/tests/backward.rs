//! The search back from rests of forward runs.

use trajectory::{
    Chassis, Control, FrictionZone, Ground, REACHED, Region, StartMotion, State, Steer, Target, Unreached,
    Vector2, to_rest, to_start,
};

use crate::scenes::{car, random, start, turned_car};

/// The start itself is found again, or others that lead to the same rest, as a forward run shows.
#[test]
fn a_start_of_every_rest_is_found() {
    let mut random = random(18);
    let control = Control::default();
    let (mut same, mut other, mut rough) = (0, 0, 0);
    for n in 0..1000 {
        let (chassis, start, ground) = turned_car(&mut random);
        let rest = to_rest(&chassis, Steer::straight(), &ground, &start, &control, |_| {}).unwrap();
        let target = Target { position: rest.position, heading: rest.heading, turns_known: false, via: None };
        let (position, heading) = (start.position, start.heading);
        let starts = to_start(&chassis, Steer::straight(), &ground, position, heading, &target, &control)
            .unwrap_or_else(|refusal| panic!("{n}: {refusal}"));
        rough += usize::from(starts.first().unwrap().miss > 0.5 * REACHED * control.tolerance);
        let off = |found: &StartMotion| {
            let dv = found.motion.velocity - start.motion.velocity;
            f64::hypot(dv.x, dv.y).max((found.motion.yaw_rate - start.motion.yaw_rate).abs())
        };
        if starts.iter().map(off).fold(f64::INFINITY, f64::min) < 1e-6 {
            same += 1;
            continue;
        }
        other += 1;
        for found in starts.iter() {
            let again = State { motion: found.motion, ..start };
            let again = to_rest(&chassis, Steer::straight(), &ground, &again, &control, |_| {}).unwrap();
            let miss = again.position - rest.position;
            let turns = (again.heading - rest.heading) / std::f64::consts::TAU;
            assert!(f64::hypot(miss.x, miss.y) <= REACHED * control.tolerance, "{n}: {miss}");
            assert!((turns - turns.round()).abs() < REACHED * control.tolerance, "{n}: {turns}");
        }
    }
    assert!(same > 500, "{same} the same, {other} others");
    // The search goes on until a rest is missed by half as much, unless its steps cycle.
    assert!(rough < 5, "{rough} are missed by more than half of what counts as reached");
}

/// Of a thousand spin-outs with low drag and a thousand with steer, these are missed unless the search is
/// repeated.
#[test]
fn what_is_missed_once_is_sought_again() {
    let control = Control::default();
    let found = |chassis: &Chassis, steer: Steer<'_, f64>, ground: &Ground<'_, f64>, start: &State| {
        let rest = to_rest(chassis, steer, ground, start, &control, |_| {}).unwrap();
        let target = Target { position: rest.position, heading: rest.heading, turns_known: true, via: None };
        let starts =
            to_start(chassis, steer, ground, start.position, start.heading, &target, &control).unwrap();
        let again = State { motion: starts.first().unwrap().motion, ..*start };
        let miss =
            to_rest(chassis, steer, ground, &again, &control, |_| {}).unwrap().position - rest.position;
        assert!(miss.norm() <= REACHED * control.tolerance, "{miss}");
    };
    let mut low = random(18);
    for n in 0..=428 {
        let (_, start, ground) = turned_car(&mut low);
        let chassis = car([0.02 + 0.05 * low(); 4]);
        if [41, 428].contains(&n) {
            found(&chassis, Steer::straight(), &ground, &start);
        }
    }
    let mut steered = random(18);
    for n in 0..=987 {
        let (chassis, start, ground) = turned_car(&mut steered);
        let steer = Steer::Held(steered() - 0.5);
        if n == 987 {
            found(&chassis, steer, &ground, &start);
        }
    }
}

/// Derivatives are carried across the borders of zones.
#[test]
fn a_start_is_found_over_changing_ground() {
    let chassis = car([0.3; 4]);
    let ground = Ground {
        zones: &[FrictionZone { region: Region::half_plane(Vector2::new(4.0, 0.0), 0.3), friction: 0.35 }],
        ..Ground::level(0.8)
    };
    let start = start(0.2, [9.0, 3.0], 2.5);
    let control = Control::default();
    let rest = to_rest(&chassis, Steer::straight(), &ground, &start, &control, |_| {}).unwrap();
    let target = Target { position: rest.position, heading: rest.heading, turns_known: true, via: None };
    let starts =
        to_start(&chassis, Steer::straight(), &ground, start.position, start.heading, &target, &control)
            .unwrap();
    let found = starts.first().unwrap();
    assert!((found.motion.velocity - start.motion.velocity).norm() < 1e-6, "{found:?}");
    assert!((found.motion.yaw_rate - start.motion.yaw_rate).abs() < 1e-6, "{found:?}");
}

/// A vehicle that rests turned by half a turn may have turned either way. The start that comes first does not
/// depend on how the scene is turned.
#[test]
fn half_a_turn_has_the_same_start_in_every_orientation() {
    let (chassis, ground, control) = (car([0.1; 4]), Ground::level(0.7), Control::default());
    for (x, y) in [(12.0, 4.0), (12.0, 1.0), (15.0, -2.0), (9.0, 0.0)] {
        let of = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let turned = |x: f64, y: f64| Vector2::new(3.0 + x * cos - y * sin, x * sin + y * cos - 7.0);
            let target = Target {
                position: turned(x, y),
                heading: angle + std::f64::consts::PI,
                turns_known: false,
                via: None,
            };
            let starts =
                to_start(&chassis, Steer::straight(), &ground, turned(0.0, 0.0), angle, &target, &control);
            let found = *starts.unwrap().first().unwrap();
            let [vx, vy] = [found.motion.velocity.x, found.motion.velocity.y];
            [vx * cos + vy * sin, vy * cos - vx * sin, found.motion.yaw_rate]
        };
        let level = of(0.0);
        for k in 1..24 {
            let found = of(f64::from(k) * std::f64::consts::TAU / 24.0);
            for (found, level) in found.iter().zip(level) {
                assert!((found - level).abs() < 1e-2, "{x} {y} {k}: {found} {level}");
            }
        }
    }
}

/// A point of the path distinguishes starts that lead to the same rest.
#[test]
fn the_start_past_the_point_comes_first() {
    let chassis = car([0.1; 4]);
    let start = start(0.0, [6.0, 7.0], 4.5);
    let (control, ground) = (Control::default(), Ground::level(0.7));
    let mut path = Vec::new();
    let rest = to_rest(&chassis, Steer::straight(), &ground, &start, &control, |sample| {
        path.push(sample.state.position);
    })
    .unwrap();
    let via = Some(path[path.len() / 3]);
    let target = Target { position: rest.position, heading: rest.heading, turns_known: false, via };
    let starts =
        to_start(&chassis, Steer::straight(), &ground, start.position, start.heading, &target, &control)
            .unwrap();
    let misses: Vec<f64> = starts.iter().map(|found| found.via_miss.unwrap()).collect();
    assert!(misses.is_sorted() && misses.len() > 1, "{misses:?}");
    let first = starts.first().unwrap();
    assert!((first.motion.velocity - start.motion.velocity).norm() < 5e-3, "{first:?}");
}

#[test]
fn a_rest_that_nothing_leads_to_is_refused() {
    let (control, ground) = (Control::default(), Ground::level(0.7));
    let to = |x: f64, heading: f64, friction: f64| {
        let target = Target { position: Vector2::new(x, 0.0), heading, turns_known: true, via: None };
        let ground = Ground { friction, ..ground };
        to_start(&car([1.0; 4]), Steer::straight(), &ground, Vector2::new(0.0, 0.0), 0.0, &target, &control)
    };
    assert!(to(10.0, 0.0, 0.7).is_ok());
    assert!(matches!(to(f64::NAN, 0.0, 0.7), Err(Unreached::Invalid(_))));
    assert!(matches!(to(10.0, 0.0, 0.0), Err(Unreached::Invalid(_))));
    assert!(matches!(to(0.0, 0.0, 0.7), Err(Unreached::NoWay)));
}
