//! The sentence of each warning.

use analysis::Warning;
use case::Axes;

use crate::axes;
use crate::units::{Quantity, Units, number};

/// Where more is said of a warning.
pub(crate) const MORE: &str = "`deltav explain CODE` says what a warning means for the answer and what to check; its code stands in brackets.";

/// What the warning says, in the units of the reader. Its numbers have to be in the axes: [`Analysis::in_axes`](analysis::Analysis::in_axes).
#[must_use]
pub fn message(warning: &Warning, units: Units, axes: Axes) -> String {
    let speed = |si: f64| units.format(Quantity::Speed, si);
    let angle = |si: f64| units.format(Quantity::Angle, si);
    let spread = format!("±{} %", number(100.0 * crash3::BURG_SPREAD, 0));
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
        Warning::ClassValues { vehicle, class, yaw_inertia, outline } => {
            let mut assumed = Vec::new();
            if let Some(inertia) = yaw_inertia {
                assumed.push(format!(
                    "a yaw inertia of {} (its radius of gyration may be {spread} off)",
                    units.format(Quantity::YawInertia, *inertia)
                ));
            }
            if let Some(outline) = outline {
                let [length, width, front] = outline.map(|si| units.format(Quantity::Length, si));
                assumed.push(format!(
                    "a body of {length} by {width} with the centre of gravity {front} behind its front"
                ));
            }
            format!(
                "vehicle {vehicle} was given typical values of CRASH3's size class {class} (SAE 870045, from a poor scan): {}",
                assumed.join("; ")
            )
        }
        Warning::BurgInertia { vehicle, yaw_inertia } => format!(
            "the yaw inertia of vehicle {vehicle} was estimated from mass, wheelbase and length (Burg: 0.1269 m · wheelbase · length) as {}; \
             its radius of gyration may be {spread} off",
            units.format(Quantity::YawInertia, *yaw_inertia)
        ),
        Warning::InferredEnergy { vehicle, force, crush: [width, depth], energy, bounds } => {
            let crush = if *depth > 0.0 {
                format!("a uniform crush of {}", units.format(Quantity::Crush, *depth))
            } else {
                "no residual crush, only elastic energy".to_owned()
            };
            let bounds = bounds.map_or_else(String::new, |bounds| {
                let [least, most] = bounds.map(|si| units.format(Quantity::Energy, si));
                format!("; the width is not known, and what is possible lies between {least} and {most}")
            });
            format!(
                "the crush of vehicle {vehicle} was not measured but inferred from the force of {} on the other vehicle: {crush} over {}, {}{bounds}",
                units.format(Quantity::Force, *force),
                units.format(Quantity::Crush, *width),
                units.format(Quantity::Energy, *energy)
            )
        }
        Warning::DamageCentroid { vehicle, point: [forward, aside], offset_given } => {
            let assumed = if *offset_given {
                ""
            } else {
                "; no offset is given, so the middle of the damage was taken to lie on the vehicle's axis or beside its centre of gravity"
            };
            format!(
                "the force on vehicle {vehicle} was taken to act through the centroid of its damage, {} forward and {} {} of the \
                 centre of gravity{assumed}",
                units.format(Quantity::Length, *forward),
                units.format(Quantity::Length, *aside),
                axes::side_of_y(axes)
            )
        }
        Warning::PdofsNotOpposite { angle: off } => format!(
            "the two directions of force that the file gives are {} from opposite in the scene; by Newton's third law they are opposite, so \
             check both PDOFs and headings",
            angle(*off)
        ),
        Warning::DamageEnergyDiffers { normal_work, crush_energy } => format!(
            "the work of the normal impulse, {}, differs from the crush energy that it should equal, {}, by more than 10 %: the speeds \
             and the damage do not tell of one collision",
            units.format(Quantity::Energy, *normal_work),
            units.format(Quantity::Energy, *crush_energy)
        ),
        Warning::RotationOpposes { vehicle, pdof, turned } => format!(
            "the impact turned vehicle {vehicle} by {} in yaw rate, but a force with the PDOF {} through its contact point would turn it the \
             other way; check PDOF, contact point and crush plane",
            units.format(Quantity::YawRate, *turned),
            angle(*pdof)
        ),
        Warning::GivenSpeedUnused { vehicle, given, found } => format!(
            "the file gives vehicle {vehicle} a speed of {}, which was not used: the speed found is {}",
            speed(*given),
            speed(*found)
        ),
    }
}
