//! A vehicle of a staged collision, from the impact to rest and back.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use trajectory::{
    Axles, Body, Chassis, Control, Ground, Motion, State, Steer, Target, Vector2, to_rest, to_start,
};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // RICSAC 6: the Rabbit after the impact (Vossou & Koulocheris 2018), at a drag of 6.2 % of its weight.
    let axles = Axles { cg_to_front: 1.176, cg_to_rear: 1.273, track: 1.387 };
    let rabbit = Chassis::new(Body::new(1190.0, 2263.0)?, axles, [0.062; 4])?;
    let start = State {
        position: Vector2::new(0.0, 0.0),
        heading: 60_f64.to_radians(),
        motion: Motion { velocity: Vector2::new(-1.28, 5.49), yaw_rate: -180_f64.to_radians() },
    };
    let (ground, control) = (Ground::level(0.87), Control::default());
    let rest = to_rest(&rabbit, Steer::straight(), &ground, &start, &control, |sample| {
        let State { position, heading, .. } = sample.state;
        println!(
            "{:5.2} s  {:6.2} m  {:6.2} m  {:7.1}°",
            sample.time,
            position.x,
            position.y,
            heading.to_degrees()
        );
    })?;
    println!("at rest after {:.2} s and {:.2} m", rest.time, rest.distance);
    // In the test it came to rest 21.5 ft away, turned by 123° (SAE 2004-01-1207).
    assert!((rest.position.norm() / 0.3048 - 21.5).abs() < 1.0);
    assert!(((rest.heading - start.heading).to_degrees() + 123.0).abs() < 5.0);

    // Which motions lead there? A turn the other way round does, too.
    let target = Target { position: rest.position, heading: rest.heading, turns_known: false, via: None };
    let starts =
        to_start(&rabbit, Steer::straight(), &ground, start.position, start.heading, &target, &control)?;
    for found in starts.iter() {
        let Motion { velocity, yaw_rate } = found.motion;
        println!(
            "({:.2}, {:.2}) m/s, {yaw_rate:.2} rad/s, turn {:.0}°",
            velocity.x,
            velocity.y,
            found.turn.to_degrees()
        );
    }
    let likeliest = starts.first().ok_or("a rest that was reached has a start")?;
    // A rest known to 1 mm determines the velocity to some cm/s.
    assert!((likeliest.motion.velocity - start.motion.velocity).norm() < 0.05);
    Ok(())
}
