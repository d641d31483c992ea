//! CRASH3's own answer.

mod peak_force;
mod velocity_changes;

use analysis::{Damage, Seen, Vehicle};
use case::Case;
use crash3::ObliqueCorrection;
use pim_core::VehicleId;

use super::{Draft, DraftGroup, angle, group, n, step};

pub(super) fn groups(case: &Case, analysis: &Seen) -> Vec<DraftGroup> {
    let mut groups = Vec::new();
    for (i, vehicle) in VehicleId::ALL.into_iter().zip(&analysis.vehicles) {
        if let Some(damage) = &vehicle.damage {
            let correction =
                vehicle.subject.damage.as_ref().map(|given| (given.correction, given.side.square_pdof()));
            let mut steps = Vec::new();
            steps.extend(pdof_of_file(vehicle, analysis.impact.is_some(), i));
            let pdof = pdof_symbol(vehicle, i);
            steps.extend(oblique(vehicle, damage, correction, &pdof, i));
            groups.push(group(format!("CRASH3: oblique force on vehicle {i}"), steps));
        } else if vehicle.energy.is_some() {
            let steps = pdof_of_file(vehicle, analysis.impact.is_some(), i).into_iter().collect();
            groups.push(group(format!("CRASH3: force on vehicle {i}"), steps));
        }
    }
    groups.push(group("CRASH3: velocity changes", velocity_changes::steps(analysis, case.axes)));
    groups
}

/// The symbol of the PDOF that CRASH3 uses, which differs from that of the impulse above.
fn pdof_symbol(vehicle: &Vehicle, i: VehicleId) -> String {
    match (vehicle.subject.force.pdof, vehicle.subject.force.pdof_follows) {
        (Some(_), true) => format!("PDOF_opposite,{i}"),
        (Some(_), false) => format!("PDOF_given,{i}"),
        (None, _) => format!("PDOF_{i}"),
    }
}

/// The PDOF that the file gives for the vehicle or, if it gives that of the other vehicle, the opposite one.
fn pdof_of_file(vehicle: &Vehicle, has_impulse: bool, i: VehicleId) -> Option<Draft> {
    let pdof = vehicle.subject.force.pdof?;
    let (what, source) = if vehicle.subject.force.pdof_follows {
        ("opposite to the given force on the other vehicle", "theory 5")
    } else {
        ("as given", "input")
    };
    let instead = if has_impulse { ", used for CRASH3 in place of that of the impulse" } else { "" };
    let name = format!("PDOF of vehicle {i} {what}{instead}");
    Some(step(name, pdof_symbol(vehicle, i), (pdof.to_degrees(), "°"), source))
}

fn oblique(
    vehicle: &Vehicle,
    damage: &Damage,
    correction: Option<(ObliqueCorrection, f64)>,
    pdof_symbol: &str,
    i: VehicleId,
) -> Vec<Draft> {
    let Some(alpha) = damage.oblique_angle else { return Vec::new() };
    let name = format!("angle of the force to the normal of the damaged side, vehicle {i}");
    let mut angle_of_force = step(name, format!("α_{i}"), (alpha.to_degrees(), "°"), "theory 5");
    // α follows from the PDOF and that of a square hit, or is given.
    if let Some((pdof, (_, square))) = damage.pdof.zip(correction)
        && (pdof - square - alpha).abs() < 1e-9
    {
        angle_of_force = angle_of_force
            .equals(format!("{pdof_symbol} − PDOF of a square hit"))
            .with([(pdof_symbol, angle(pdof)), ("PDOF of a square hit", angle(square))]);
    }
    let mut steps = vec![angle_of_force];
    let Some(oblique) = &damage.oblique else { return steps };
    if damage.inferred.is_none()
        && let Some(profile) = super::damage::measured(vehicle)
    {
        steps.extend(peak_force::steps(&damage.structure, profile, oblique.peak_force, i));
    }
    let correction = correction.map(|(correction, _)| correction);
    let is_capped = oblique.factor.capped;
    let (of, source) = match correction {
        Some(ObliqueCorrection::Secant) => (" after Fonda (SAE 1999-01-0106)", "theory 5"),
        _ if is_capped => (", at CRASH3's limit of 45°", "Eq 8"),
        _ => ("", "Eq 8"),
    };
    let mut friction = None;
    let formula = match correction {
        Some(ObliqueCorrection::None) => String::new(),
        Some(ObliqueCorrection::Capped) if is_capped => String::new(),
        Some(ObliqueCorrection::Friction(mu)) => {
            friction = Some(("μ", n(mu, "")));
            format!("1 + min(|tan α_{i}|, μ) |tan α_{i}|")
        }
        Some(ObliqueCorrection::Secant) => format!("1/cos α_{i}"),
        Some(ObliqueCorrection::Capped | ObliqueCorrection::Uncapped) | None => format!("1 + tan² α_{i}"),
    };
    let name = format!("factor of the oblique correction{of}, vehicle {i}");
    let factor = step(name, format!("f_{i}"), (oblique.factor.factor, ""), source);
    steps.push(factor.equals(formula).with(friction));
    let (name, energy) = (format!("corrected crush energy, vehicle {i}"), oblique.corrected_crush_energy);
    steps.push(step(name, format!("E'_{i}"), (energy, "J"), "Eq 8").equals(format!("E_{i} f_{i}")));
    steps
}
