//! Vehicles and starts that several tests share.

use trajectory::{Axles, Body, Chassis, Motion, State, Vector2};

/// A mid-size car with the same drag on all wheels.
pub(crate) fn car(drag: [f64; 4]) -> Chassis {
    let axles = Axles { cg_to_front: 1.2, cg_to_rear: 1.45, track: 1.5 };
    Chassis::new(Body::new(1500.0, 2500.0).unwrap(), axles, drag).unwrap()
}

pub(crate) fn start(heading: f64, velocity: [f64; 2], yaw_rate: f64) -> State {
    let [vx, vy] = velocity;
    State {
        position: Vector2::new(0.0, 0.0),
        heading,
        motion: Motion { velocity: Vector2::new(vx, vy), yaw_rate },
    }
}
