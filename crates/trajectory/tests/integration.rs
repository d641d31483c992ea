//! The integration: its order, its balances, its mirrors.

use trajectory::{
    Chassis, Control, GRAVITY, Ground, Motion, NoRest, Rest, Sample, State, Steer, Vector2, to_rest,
};

use crate::scenes::{car, random, start, turned_car};

fn control(tolerance: f64) -> Control {
    Control { tolerance, most_steps: 1_000_000, ..Control::default() }
}

fn run(chassis: &Chassis, ground: &Ground<'_>, start: &State, tolerance: f64) -> (Rest, Vec<Sample>) {
    let mut samples = Vec::new();
    let rest = to_rest(chassis, Steer::straight(), ground, start, &control(tolerance), |sample| {
        samples.push(*sample);
    });
    (rest.unwrap(), samples)
}

/// An independent formulation of the tyre forces, in angles, without the fading near standstill.
fn accelerations(chassis: &Chassis, friction: f64, state: &State) -> [f64; 3] {
    let (sin, cos) = state.heading.sin_cos();
    let Motion { velocity, yaw_rate } = state.motion;
    let mut sum = [0.0; 3];
    for wheel in chassis.wheels() {
        let arm = [wheel.forward * cos - wheel.left * sin, wheel.forward * sin + wheel.left * cos];
        let slip = [velocity.x - yaw_rate * arm[1], velocity.y + yaw_rate * arm[0]];
        let angle = slip[1].atan2(slip[0]) - state.heading;
        let load = chassis.body().mass() * GRAVITY * wheel.load;
        let brake = wheel.drag.min(friction * angle.cos().abs());
        let side = (friction * friction - brake * brake).sqrt();
        let q = (9.0 * angle.tan().abs() / (3.0 * side)).min(1.0);
        let along = -brake * angle.cos().signum() * load;
        let across = -side * (3.0 * q - 3.0 * q * q + q * q * q) * angle.sin().signum() * load;
        let force = [along * cos - across * sin, along * sin + across * cos];
        sum[0] += force[0] / chassis.body().mass();
        sum[1] += force[1] / chassis.body().mass();
        sum[2] += (arm[0] * force[1] - arm[1] * force[0]) / chassis.body().yaw_inertia();
    }
    sum
}

/// An explicit method of order 4 with short steps and the forces above, for the first second.
#[test]
fn an_independent_integration_agrees() {
    let mut random = random(3);
    for n in 0..20 {
        let (chassis, start, ground) = turned_car(&mut random);
        let start =
            State { motion: Motion { velocity: start.motion.velocity * 2.0, ..start.motion }, ..start };
        let (_, samples) = run(&chassis, &ground, &start, 1e-8);
        let mut y = start;
        let h = 1e-4;
        let rate = |y: &State| (y.motion, accelerations(&chassis, ground.friction, y));
        let moved = |y: &State, (motion, a): &(Motion, [f64; 3]), h: f64| State {
            position: y.position + motion.velocity * h,
            heading: y.heading + motion.yaw_rate * h,
            motion: Motion {
                velocity: y.motion.velocity + Vector2::new(a[0], a[1]) * h,
                yaw_rate: y.motion.yaw_rate + a[2] * h,
            },
        };
        for _ in 0..5000 {
            let k1 = rate(&y);
            let k2 = rate(&moved(&y, &k1, h / 2.0));
            let k3 = rate(&moved(&y, &k2, h / 2.0));
            let k4 = rate(&moved(&y, &k3, h));
            for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                y = moved(&y, &k, h * weight / 6.0);
            }
        }
        let after = samples.iter().position(|sample| sample.time > 0.5).unwrap();
        let ours = samples[after - 1].between(&samples[after], 0.5);
        assert!((ours.position - y.position).norm() < 2e-5, "{n}: {ours:?} {y:?}");
        assert!((ours.heading - y.heading).abs() < 2e-5, "{n}: {ours:?} {y:?}");
        assert!((ours.motion.velocity - y.motion.velocity).norm() < 1e-3, "{n}: {ours:?} {y:?}");
    }
}

/// A method of order 3 with an estimate of order 2: the error falls with the tolerance, the steps grow by its
/// cube root.
#[test]
fn the_error_falls_with_the_tolerance() {
    let mut random = random(5);
    let runs: Vec<_> = (0..50).map(|_| turned_car(&mut random)).collect();
    let rests = |tolerance: f64| -> Vec<Rest> {
        runs.iter().map(|(chassis, start, ground)| run(chassis, ground, start, tolerance).0).collect()
    };
    let exact = rests(1e-9);
    let mut before: Option<(f64, u32)> = None;
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let rests = rests(tolerance);
        let mut misses: Vec<f64> =
            rests.iter().zip(&exact).map(|(a, b)| (a.position - b.position).norm()).collect();
        misses.sort_by(f64::total_cmp);
        let (median, steps) = (misses[25], rests.iter().map(|rest| rest.steps).sum());
        assert!(median < 10.0 * tolerance, "{tolerance}: {median}");
        if let Some((miss, fewer)) = before {
            assert!(median < miss / 30.0, "{tolerance}: {median} after {miss}");
            assert!(f64::from(steps) < 6.0 * f64::from(fewer), "{tolerance}: {steps} after {fewer}");
        }
        before = Some((median, steps));
    }
}

#[test]
fn energy_and_momentum_balance() {
    let mut random = random(7);
    for n in 0..200 {
        let (chassis, start, ground) = turned_car(&mut random);
        let (grade_x, grade_y) = (0.02 * random() - 0.01, 0.02 * random() - 0.01);
        let ground = Ground { grade: Vector2::new(grade_x, grade_y), ..ground };
        let (rest, samples) = run(&chassis, &ground, &start, 1e-6);
        let energy = rest.energy;
        assert!((energy.start - chassis.body().kinetic_energy(&start.motion)).abs() < 1e-9 * energy.start);
        assert!(energy.remainder.abs() < 1e-4 * energy.start, "{n}: {energy:?}");
        let balance = energy.start + energy.grade - energy.friction - energy.remainder;
        assert!(balance.abs() < 1e-9 * energy.start);
        // Velocity and path: Δq = ∫ w dt by the trapezoidal rule with its end correction.
        let mut way = Vector2::new(0.0, 0.0);
        for pair in samples.windows(2) {
            let middle = pair[0].between(&pair[1], (pair[0].time + pair[1].time) / 2.0).motion.velocity;
            let (from, to) = (pair[0].state.motion.velocity, pair[1].state.motion.velocity);
            way += (from + middle * 4.0 + to) * ((pair[1].time - pair[0].time) / 6.0);
        }
        assert!((way - (rest.position - start.position)).norm() < 1e-9, "{n}");
        // No tyre gives more than its friction: |Δv| ≤ μ g Δt.
        for pair in samples.windows(2) {
            let dv = pair[1].state.motion.velocity - pair[0].state.motion.velocity;
            let most = (ground.friction + 0.02) * GRAVITY * (pair[1].time - pair[0].time);
            assert!(dv.norm() <= most * (1.0 + 1e-3), "{n}: {} of {most}", dv.norm());
        }
    }
}

/// A scene that is turned, moved and mirrored gives a rest that is turned, moved and mirrored.
#[test]
fn turned_and_mirrored_scenes_agree() {
    let mut random = random(11);
    for n in 0..200 {
        let (chassis, start, ground) = turned_car(&mut random);
        let rest = run(&chassis, &ground, &start, 1e-4).0;
        let by = 6.0 * random() - 3.0;
        let (sin, cos) = f64::sin_cos(by);
        let turn = |v: Vector2<f64>| Vector2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
        let place = Vector2::new(30.0, -70.0);
        let turned = State {
            position: place,
            heading: start.heading + by,
            motion: Motion { velocity: turn(start.motion.velocity), ..start.motion },
        };
        let other = run(&chassis, &ground, &turned, 1e-4).0;
        // Rounding may choose another step, and the rest then differs by an error of the integration.
        assert!((other.position - place - turn(rest.position)).norm() < 1e-2, "{n}: {rest:?} {other:?}");
        assert!((other.heading - by - rest.heading).abs() < 1e-2, "{n}");

        let [front_left, front_right, rear_left, rear_right] = chassis.wheels().map(|wheel| wheel.drag);
        let flipped = car([front_right, front_left, rear_right, rear_left]);
        let flip = |v: Vector2<f64>| Vector2::new(v.x, -v.y);
        let mirrored = State {
            position: flip(start.position),
            heading: -start.heading,
            motion: Motion { velocity: flip(start.motion.velocity), yaw_rate: -start.motion.yaw_rate },
        };
        let other = run(&flipped, &ground, &mirrored, 1e-4).0;
        assert!((flip(other.position) - rest.position).norm() < 1e-2, "{n}: {rest:?} {other:?}");
        assert!((other.heading + rest.heading).abs() < 1e-2, "{n}");
    }
}

/// Vehicles that roll far with little drag after their spin has died out, two of them in a curve. The
/// guarantee of the crate: the rest position is accurate to a thousandth of the path.
#[test]
fn long_roll_outs_are_exact_to_a_thousandth_of_the_path() {
    let light = car([0.02, 0.01, 0.01, 0.01]);
    let free = car([0.01, 0.02, 0.01, 0.02]);
    let dragging = car([0.04, 0.006, 0.01, 0.05]);
    for (chassis, steer, start, longer_than) in [
        (free, 0.0, start(0.3, [12.4, 15.7], 1.5), 60.0),
        (light, 0.03, start(0.0, [11.8, 2.4], 1.0), 300.0),
        (dragging, -0.09, start(0.96, [-1.4, 17.3], -1.47), 100.0),
    ] {
        let rest = |control: &Control| {
            let ground = Ground::level(0.65);
            to_rest(&chassis, Steer::Held(steer), &ground, &start, control, |_| {}).unwrap()
        };
        let ours = rest(&Control::default());
        let tolerance = Control::default().tolerance / 1000.0;
        let exact = rest(&Control { longest_step: 0.02, ..control(tolerance) });
        assert!(exact.distance > longer_than, "{} m", exact.distance);
        let miss = (ours.position - exact.position).norm();
        assert!(miss < 1e-3 * exact.distance, "{miss} m of {} m", exact.distance);
        assert!(
            (ours.heading - exact.heading).abs() < 0.3_f64.to_radians(),
            "{}",
            ours.heading - exact.heading
        );
    }
}

/// 1e9 m/s and 1e9 rad/s are the limits.
#[test]
fn starts_that_no_vehicle_has_are_refused() {
    let refused = |velocity: [f64; 2], yaw_rate: f64| {
        let (chassis, ground, start) = (car([0.3; 4]), Ground::level(0.7), start(0.0, velocity, yaw_rate));
        to_rest(&chassis, Steer::straight(), &ground, &start, &Control::default(), |_| {}).unwrap_err()
    };
    for bad in [1.001e9, -1e20, 1e300, f64::NAN, f64::INFINITY] {
        for refusal in [refused([bad, 0.0], 0.0), refused([0.0, bad], 0.0), refused([0.0; 2], bad)] {
            assert!(matches!(refusal, NoRest::Invalid(_)), "{refusal}");
        }
    }
}
