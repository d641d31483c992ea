//! The force at maximum crush.

use crash3::{Profile, Saturation, SideStiffness, Stiffness, Yielding, Zone, zone_force};
use pim_core::VehicleId;

use super::super::damage::share_below;
use super::super::{Step, angle, n, step};
use crate::units::Measure;

/// For the whole side if one line holds along it, else zone by zone, from the peak force (N) and α (rad).
pub(super) fn steps(
    structure: &SideStiffness,
    profile: &Profile,
    [peak, alpha]: [f64; 2],
    i: VehicleId,
) -> Vec<Step> {
    let alpha = angle(alpha);
    let total = |formula: String, substitution: String| {
        step(format!("peak force, vehicle {i}"), format!("F_{i}"))
            .equals(formula, substitution)
            .is(peak, "N", "theory 5")
            .of(Measure::Force)
    };
    let mut zones: Vec<(Zone, Stiffness)> = Vec::new();
    match structure {
        SideStiffness::Uniform(stiffness) if stiffness.saturation_force().is_none() => {
            let sums = profile.sums();
            return vec![total(
                format!("(A_{i} L_{i} + B_{i} S_1,{i})/cos α_{i}"),
                format!(
                    "({} · {} + {} · {}) / cos{alpha}",
                    n(stiffness.a(), "N/m"),
                    n(sums.width, "m"),
                    n(stiffness.b(), "N/m²"),
                    n(sums.area, "m²")
                ),
            )];
        }
        SideStiffness::Uniform(stiffness) => zones.extend(profile.zones().map(|zone| (zone, *stiffness))),
        SideStiffness::Zones(stiffnesses) => zones.extend(profile.zones().zip(stiffnesses.iter().copied())),
    }
    let mut steps: Vec<Step> =
        (1..).zip(&zones).map(|(j, (zone, stiffness))| of_zone(*zone, stiffness, i, j)).collect();
    let forces: Vec<String> = steps.iter().map(|step| n(step.value, "N")).collect();
    steps.push(total(format!("(Σ F_{i},j)/cos α_{i}"), format!("({}) / cos{alpha}", forces.join(" + "))));
    steps
}

/// Square to the side: the sum is divided by cos α.
fn of_zone(zone: Zone, stiffness: &Stiffness, i: VehicleId, j: usize) -> Step {
    let (formula, per_width) = force_per_width(zone, stiffness);
    step(format!("peak force square to the side, vehicle {i}, zone {j}"), format!("F_{i},{j}"))
        .equals(formula, format!("{} · ({per_width})", n(zone.width, "m")))
        .is(zone_force(zone, stiffness), "N", "theory 5")
        .of(Measure::Force)
}

/// The force of a zone in symbols, and its mean per width in numbers.
fn force_per_width(zone: Zone, stiffness: &Stiffness) -> (&'static str, String) {
    let rising = |[c1, c2]: [f64; 2]| {
        let (a, b) = (n(stiffness.a(), "N/m"), n(stiffness.b(), "N/m²"));
        format!("{a} + {b} · ({} + {}) / 2", n(c1, "m"), n(c2, "m"))
    };
    match zone.yielding(stiffness) {
        Yielding::Nowhere => ("w_j [A + B (C_j + C_j+1)/2]", rising(zone.depths)),
        Yielding::Throughout(Saturation { force, .. }) => ("w_j F_s", n(force, "N/m")),
        Yielding::Partly { saturation: Saturation { force, depth: knee }, low, high, .. } => {
            let share = share_below(knee, low, high);
            (
                "w_j {s [A + B (C_low + C_s)/2] + (1 − s) F_s}, s = (C_s − C_low)/(C_high − C_low)",
                format!("{share} · ({}) + (1 − {share}) · {}", rising([low, knee]), n(force, "N/m")),
            )
        }
    }
}
