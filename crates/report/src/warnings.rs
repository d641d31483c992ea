//! The sentence of each warning.

use analysis::Warning;

use crate::units::{Quantity, Units, number};

/// What the warning says, in the units of the reader.
#[must_use]
pub fn message(warning: &Warning, units: Units) -> String {
    let speed = |si: f64| units.format(Quantity::Speed, si);
    let angle = |si: f64| units.format(Quantity::Angle, si);
    match warning {
        Warning::PlaneDoesNotSeparate => {
            "the crush plane through the contact point does not lie between the two \
            centres of gravity; check the crush plane's angle and the contact points"
                .to_owned()
        }
        Warning::ContactOutside { vehicle, distance } => format!(
            "the contact point lies {} outside of the outline of vehicle {vehicle}; the resultant impulse acts \
             within the damage",
            units.format(Quantity::Length, *distance)
        ),
        Warning::HighRestitution { restitution, closing_speed } => format!(
            "a restitution of {restitution} at a closing speed of {} is high: above 15 m/s (49 ft/s) tests show 0.3 \
             and less",
            speed(*closing_speed)
        ),
        Warning::ForceBalance { forces: [f1, f2] } => format!(
            "the peak forces that the crush stands for differ by a factor of {}: {} on vehicle 1, {} on vehicle 2; by \
             Newton's third law they are equal, so check stiffness, damage width and depths",
            number(f1.max(*f2) / f1.min(*f2), 1),
            units.format(Quantity::Force, *f1),
            units.format(Quantity::Force, *f2)
        ),
        Warning::PdofDiffers { vehicle, given, computed } => format!(
            "the PDOF given for vehicle {vehicle}, {}, differs from that of the impulse, {}, by more than 10°",
            angle(*given),
            angle(*computed)
        ),
        Warning::AngleCapped { vehicle, oblique_angle } => format!(
            "the force meets the damaged side of vehicle {vehicle} at {} to its normal; CRASH3 limits that to 45°, \
             a correction factor of 2",
            angle(*oblique_angle)
        ),
        Warning::SideNotPushed { vehicle, oblique_angle } => format!(
            "the force on vehicle {vehicle} makes an angle of {} with the normal of the damaged side, so it does not \
             push on that side: no corrected energy, peak force and ΔV follow; check side, PDOF and headings",
            angle(*oblique_angle)
        ),
        Warning::DeltaVDiffers { impact: [p1, p2], crash3: [c1, c2] } => format!(
            "CRASH3's ΔV of {} and {} (without restitution) differs from the impact's {} and {} by more than 10 %",
            speed(*c1),
            speed(*c2),
            speed(*p1),
            speed(*p2)
        ),
        Warning::SeveralSpeeds { speeds } => {
            let all: Vec<String> = speeds.iter().map(|&si| speed(si)).collect();
            format!(
                "{} speeds give the crush energy: {}; the answer is the first, that with the slowest approach",
                speeds.len(),
                all.join(", ")
            )
        }
        Warning::MovesBackward { vehicle, speed: found } => format!(
            "the speed found for vehicle {vehicle} is {}: it would have moved backwards; check the heading and the \
             crush energy",
            speed(*found)
        ),
        Warning::GivenSpeedUnused { vehicle, given, found } => format!(
            "the file gives vehicle {vehicle} a speed of {}, which was not used: the speed found is {}",
            speed(*given),
            speed(*found)
        ),
    }
}
