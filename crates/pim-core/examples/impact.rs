//! The forward impact of the paper's example: both speeds are known; what are the velocities, yaw rates and
//! energy afterwards?

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use pim_core::{Body, Contact, Law, Motion, Participant, Tangential};

/// Whether a number is the printed one, within half of its last digit and the effect of the paper's rounded
/// data.
fn printed(ours: f64, paper: f64, half_a_digit: f64) -> bool {
    (ours - paper).abs() <= 1.5 * half_a_digit
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // SAE 980025, appendix, in SI units and radians. Angles are counter-clockwise positive.
    let foot = 0.3048;
    let headings = [180_f64.to_radians(), 67_f64.to_radians()];
    let jimmy =
        Participant::polar(Body::new(1676.5, 3304.1)?, headings[0], 6.3 * foot, -22.4_f64.to_radians())?;
    let altima =
        Participant::polar(Body::new(1548.1, 2935.3)?, headings[1], 3.8 * foot, -39_f64.to_radians())?;
    let contact = Contact::new([jimmy, altima], -23_f64.to_radians())?;
    let before = [Motion::along(headings[0], 75.0 * foot), Motion::along(headings[1], 14.67 * foot)];

    // Restitution 0.3 along the normal; sliding along the crush plane ends by separation.
    let law = Law::new(0.3, Tangential::Critical)?;
    let outcome = contact.impact(before, &law)?;

    for (i, (after, delta_v)) in outcome.after.iter().zip(outcome.delta_v_magnitude()).enumerate() {
        let (x, y) = (after.velocity.x / foot, after.velocity.y / foot);
        println!(
            "vehicle {}: V ({x:.1}, {y:.1}) ft/s, Ω {:.1} rad/s, ΔV {delta_v:.2} m/s",
            i + 1,
            after.yaw_rate
        );
    }
    println!(
        "energy loss {:.0} J, {:.1} %",
        outcome.energy.loss,
        100.0 * outcome.energy.loss / outcome.energy.before
    );

    // The paper prints −35.3 ft/s, −4.0 rad/s; −37.3 ft/s, 4.1 rad/s; 41.4 %.
    let [jimmy, altima] = &outcome.after;
    assert!(printed(jimmy.velocity.x / foot, -35.3, 0.1) && printed(jimmy.yaw_rate, -4.0, 0.05));
    assert!(printed(altima.velocity.x / foot, -37.3, 0.1) && printed(altima.yaw_rate, 4.1, 0.05));
    assert!(printed(100.0 * outcome.energy.loss / outcome.energy.before, 41.4, 0.05));
    Ok(())
}
