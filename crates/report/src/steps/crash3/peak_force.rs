//! The force at maximum crush.

use crash3::{Profile, SideStiffness, Stiffness, Yielding, Zone, zone_force};
use pim_core::VehicleId;

use super::super::damage::{SHARE_BELOW, of_zone};
use super::super::{Draft, n, step};
use crate::units::Measure;

/// For the whole side if one line holds along it, else zone by zone, from the peak force (N).
pub(super) fn steps(structure: &SideStiffness, profile: &Profile, peak: f64, i: VehicleId) -> Vec<Draft> {
    let total = |formula: String| {
        step(format!("peak force, vehicle {i}"), format!("F_{i}"), (peak, "N"), "theory 5")
            .equals(formula)
            .of(Measure::Force)
    };
    let zones: Vec<(Zone, Stiffness)> = match structure {
        SideStiffness::Uniform(stiffness) if stiffness.saturation_force().is_none() => {
            let width = [(format!("L_{i}"), n(profile.sums().width, "m"))];
            return vec![total(format!("(A_{i} L_{i} + B_{i} S_1,{i})/cos α_{i}")).with(width)];
        }
        SideStiffness::Uniform(stiffness) => profile.zones().map(|zone| (zone, *stiffness)).collect(),
        SideStiffness::Zones(stiffnesses) => profile.zones().zip(stiffnesses.iter().copied()).collect(),
    };
    // Square to the side: the sum is divided by cos α.
    let mut steps: Vec<Draft> = (1..)
        .zip(zones)
        .map(|(j, (zone, stiffness))| {
            let (formula, numeric) = force_of_zone(zone.yielding(&stiffness));
            let name = format!("peak force square to the side, vehicle {i}, zone {j}");
            step(name, format!("F_{i},{j}"), (zone_force(zone, &stiffness), "N"), "theory 5")
                .equals(formula)
                .written_out(numeric)
                .with(of_zone(zone, &stiffness))
                .of(Measure::Force)
        })
        .collect();
    let forces: Vec<&str> = steps.iter().map(|step| step.symbol.as_str()).collect();
    let numeric = format!("({})/cos α_{i}", forces.join(" + "));
    steps.push(total(format!("(Σ F_{i},j)/cos α_{i}")).written_out(numeric));
    steps
}

/// The force of a zone: as shown, and with every part written out.
fn force_of_zone(yielding: Yielding) -> (String, String) {
    let plain = |formula: &str| (formula.to_owned(), formula.to_owned());
    match yielding {
        Yielding::Nowhere => plain("w_j [A + B (C_j + C_j+1)/2]"),
        Yielding::Throughout(_) => plain("w_j F_s"),
        Yielding::Partly { .. } => {
            let rising = "[A + B (C_low + C_s)/2]";
            (
                format!("w_j {{s {rising} + (1 − s) F_s}}, s = {SHARE_BELOW}"),
                format!("w_j {{{SHARE_BELOW} {rising} + (1 − {SHARE_BELOW}) F_s}}"),
            )
        }
    }
}
