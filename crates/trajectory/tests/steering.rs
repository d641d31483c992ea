//! Steer angles, constant and as functions of time.

use trajectory::{Control, GRAVITY, Ground, Steer, to_rest};

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

#[test]
fn angles_are_linear_between_their_times() {
    let steer = Steer::Over(&[(1.0, 0.2), (3.0, -0.2)]);
    for (time, angle) in [(0.0, 0.2), (1.0, 0.2), (1.5, 0.1), (2.0, 0.0), (3.0, -0.2), (7.0, -0.2)] {
        assert!((steer.at(time) - angle).abs() < 1e-15, "{time}");
    }
    assert!(Steer::Over(&[(1.0, 0.2), (0.5, 0.1)]).check().is_err());
    assert!(Steer::Held(2.0).check().is_err() && Steer::Held(f64::NAN).check().is_err());
}
