//! Vehicles and starts shared by several tests.

use trajectory::{Axles, Body, Chassis, Ground, Motion, State, Vector2};

/// A mid-size car with the drag of each wheel.
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

/// Uniform numbers on 0 … 1 (SplitMix64).
pub(crate) fn random(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A random spin-out: any direction, 3 to 18 m/s, up to 4 rad/s in either direction; wheels that roll, drag
/// or are locked.
pub(crate) fn turned_car(random: &mut impl FnMut() -> f64) -> (Chassis, State, Ground<'static>) {
    let drag = [0; 4].map(|_| if random() < 0.2 { 1.0 } else { 0.02 + 0.3 * random() });
    let (speed, direction) = (3.0 + 15.0 * random(), 6.3 * random());
    let velocity = [speed * f64::cos(direction), speed * f64::sin(direction)];
    let start = start(6.3 * random(), velocity, 8.0 * random() - 4.0);
    (car(drag), start, Ground::level(0.4 + 0.5 * random()))
}
