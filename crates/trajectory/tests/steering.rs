//! Steer angles, constant and as functions of time.

use real::{Duals, Real};
use trajectory::{
    Axles, Body, Chassis, Control, GRAVITY, Ground, Motion, Rest, State, Steer, Vector2, to_rest,
};

use crate::scenes::{car, start};

/// A slowly rolling vehicle follows its wheels: it turns by S tan δ/L, with S the path of the rear axle.
#[test]
fn a_rolling_vehicle_follows_its_wheels() {
    let (steer, v, drag) = (0.1_f64, 3.0_f64, 0.05);
    for sign in [1.0, -1.0] {
        let chassis = car([drag; 4]);
        let start = start(0.0, [v, 0.0], sign * v * f64::tan(steer) / chassis.wheelbase());
        let held = Steer::Held(sign * steer);
        let ground = Ground::level(0.7);
        let rest = to_rest(&chassis, held, &ground, &start, &Control::default(), |_| {}).unwrap();
        let turn = sign * rest.distance * f64::tan(steer) / chassis.wheelbase();
        assert!((rest.heading / turn - 1.0).abs() < 0.03, "{rest:?}, {turn}");
        assert!((rest.distance / (v * v / (2.0 * drag * GRAVITY)) - 1.0).abs() < 0.03, "{rest:?}");
        // The same angle given over time is the same motion.
        let points = [(0.0, sign * steer), (1.0, sign * steer), (9.0, sign * steer)];
        let over =
            to_rest(&chassis, Steer::Over(&points), &ground, &start, &Control::default(), |_| {}).unwrap();
        assert!((over.position - rest.position).norm() < 5e-3, "{over:?} {rest:?}");
    }
}

/// The rest of a car with its front wheels held at 2°, that leaves at 5 m/s times `factor` with this drag.
fn rolled<T: Real>(factor: T, drag: T, control: &Control) -> Rest<T> {
    let number = |x: f64| T::from(x);
    let axles = Axles { cg_to_front: number(1.2), cg_to_rear: number(1.5), track: number(1.5) };
    let body = Body::new(number(1450.0), number(2700.0)).unwrap();
    let chassis = Chassis::new(body, axles, [drag; 4]).unwrap();
    let motion =
        Motion { velocity: Vector2::new(factor * 4.9, factor * 1.0), yaw_rate: factor * number(0.35) };
    let start = State { position: Vector2::new(number(0.0), number(0.0)), heading: number(0.0), motion };
    let steer = Steer::Held(number(2_f64.to_radians()));
    to_rest(&chassis, steer, &Ground::level(number(0.7)), &start, control, |_| {}).unwrap()
}

/// By central differences of motions in far shorter steps.
#[test]
fn derivatives_of_the_time_of_a_curved_roll_hold_down_to_rest() {
    let (drag, by) = (0.012, 0.002);
    let fine = Control { tolerance: 1e-9, most_steps: 1_000_000, ..Control::default() };
    let time = |factor: f64, drag: f64| rolled(factor, drag, &fine).time;
    let differences = [
        (time(1.0 + by, drag) - time(1.0 - by, drag)) / (2.0 * by),
        (time(1.0, drag * (1.0 + by)) - time(1.0, drag * (1.0 - by))) / (2.0 * by * drag),
    ];
    for tolerance in [1e-5, 1e-7] {
        let control = Control { tolerance, longest_step: 0.05, closed_end: false, ..Control::default() };
        let [factor, drag] = [Duals::<2>::variable(1.0, 0), Duals::variable(drag, 1)];
        let found = rolled(factor, drag, &control).time.derivatives;
        for (found, difference) in found.into_iter().zip(differences) {
            assert!((found / difference - 1.0).abs() < 0.01, "{found} is not {difference}");
        }
    }
}

#[test]
fn angles_are_linear_between_their_times() {
    let steer = Steer::Over(&[(1.0, 0.2), (3.0, -0.2)]);
    for (time, angle) in [(0.0, 0.2), (1.0, 0.2), (1.5, 0.1), (2.0, 0.0), (3.0, -0.2), (7.0, -0.2)] {
        assert!((steer.at(time) - angle).abs() < 1e-15, "{time}");
    }
    assert!(Steer::Over(&[(1.0, 0.2), (0.5, 0.1)]).check().is_err());
    assert!(Steer::Held(2.0).check().is_err() && Steer::Held(f64::NAN).check().is_err());
}
