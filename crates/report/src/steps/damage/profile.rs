//! The crush energy of a measured profile.

use crash3::{Profile, Saturation, Stiffness, Yielding, Zone, zone_energy};
use pim_core::VehicleId;

use super::super::{Step, n, p, step};

/// Area and second moment of a profile.
pub(super) fn moments(profile: &Profile, i: VehicleId) -> [Step; 2] {
    let sums = profile.sums();
    let area = |Zone { width, depths: [c1, c2] }: Zone| {
        format!("{} · ({} + {}) / 2", n(width, "m"), n(c1, "m"), n(c2, "m"))
    };
    let square = |Zone { width, depths }: Zone| format!("{} · ({}) / 6", n(width, "m"), squares(depths));
    [
        step(format!("area of the crush of vehicle {i}"), format!("S_1,{i}"))
            .equals("Σ w_j (C_j + C_j+1)/2", profile.zones().map(area).collect::<Vec<_>>().join(" + "))
            .is(sums.area, "m²", "Eq 5"),
        step(format!("second moment of the crush of vehicle {i}"), format!("S_2,{i}"))
            .equals(
                "Σ w_j (C_j² + C_j C_j+1 + C_j+1²)/6",
                profile.zones().map(square).collect::<Vec<_>>().join(" + "),
            )
            .is(sums.second_moment, "m³", "Eq 5"),
    ]
}

/// With one stiffness along the side and no saturation: from the moments of the profile.
pub(super) fn whole(profile: &Profile, stiffness: &Stiffness, energy: f64, i: VehicleId) -> [Step; 1] {
    let sums = profile.sums();
    [step(format!("crush energy of vehicle {i}"), format!("E_{i}"))
        .equals(
            format!("A_{i} S_1,{i} + B_{i} S_2,{i} + G_{i} L_{i}"),
            format!(
                "{} · {} + {} · {} + {} · {}",
                n(stiffness.a(), "N/m"),
                n(sums.area, "m²"),
                n(stiffness.b(), "N/m²"),
                n(sums.second_moment, "m³"),
                n(stiffness.g(), "N"),
                n(sums.width, "m")
            ),
        )
        .is(energy, "J", "Eq 5")]
}

/// C_1² + C_1 C_2 + C_2² in numbers.
fn squares([c1, c2]: [f64; 2]) -> String {
    format!("{}² + {} · {} + {}²", p(c1, "m"), n(c1, "m"), n(c2, "m"), p(c2, "m"))
}

/// Zone by zone, if the stiffness differs along the side or its limit is reached.
pub(super) fn zone_by_zone(
    zones: impl Iterator<Item = (Zone, Stiffness)>,
    energy: f64,
    i: VehicleId,
) -> Vec<Step> {
    let (mut steps, mut terms) = (Vec::new(), Vec::new());
    for (j, (zone, stiffness)) in (1..).zip(zones) {
        let share = zone_energy(zone, &stiffness);
        let (formula, per_width) = energy_per_width(zone, &stiffness);
        terms.push(n(share, "J"));
        steps.push(
            step(format!("crush energy of vehicle {i}, zone {j}"), format!("E_{i},{j}"))
                .equals(
                    formula,
                    format!("{} · ({per_width} + {})", n(zone.width, "m"), n(stiffness.g(), "N")),
                )
                .is(share, "J", "Eq 5"),
        );
    }
    steps.push(
        step(format!("crush energy of vehicle {i}"), format!("E_{i}"))
            .equals(format!("Σ E_{i},j"), terms.join(" + "))
            .is(energy, "J", "Eq 5"),
    );
    steps
}

/// The energy of a zone in symbols, and its mean per width without G in numbers.
fn energy_per_width(zone: Zone, stiffness: &Stiffness) -> (&'static str, String) {
    match zone.yielding(stiffness) {
        Yielding::Nowhere => {
            ("w_j [A (C_j + C_j+1)/2 + B (C_j² + C_j C_j+1 + C_j+1²)/6 + G]", rising(stiffness, zone.depths))
        }
        Yielding::Throughout(saturation) => {
            let [c1, c2] = zone.depths;
            let ends = [c1.min(c2), c1.max(c2)];
            (
                "w [(A + F_s) C_s/2 + F_s ((C_j + C_j+1)/2 − C_s) + G], C_s = (F_s − A)/B",
                flat(stiffness, saturation, ends),
            )
        }
        Yielding::Partly { saturation, low, high, .. } => {
            let knee = saturation.depth;
            let share = share_below(knee, low, high);
            (
                "w [s e_rising(C_low, C_s) + (1 − s) e_flat(C_s, C_high) + G], s = (C_s − C_low)/(C_high − C_low)",
                format!(
                    "{share} · ({}) + (1 − {share}) · ({})",
                    rising(stiffness, [low, knee]),
                    flat(stiffness, saturation, [knee, high])
                ),
            )
        }
    }
}

/// s, the share of a zone's width on which the force still rises, in numbers.
pub(crate) fn share_below(knee: f64, low: f64, high: f64) -> String {
    format!("({} − {}) / ({} − {})", n(knee, "m"), n(low, "m"), n(high, "m"), n(low, "m"))
}

/// The mean energy per width where the force rises, in numbers.
fn rising(stiffness: &Stiffness, [c1, c2]: [f64; 2]) -> String {
    format!(
        "{} · ({} + {}) / 2 + {} · ({}) / 6",
        n(stiffness.a(), "N/m"),
        n(c1, "m"),
        n(c2, "m"),
        n(stiffness.b(), "N/m²"),
        squares([c1, c2])
    )
}

/// The same where the force has reached its limit: the energy at the knee, (A + F_s) C_s/2, and that of the
/// flat part.
fn flat(stiffness: &Stiffness, Saturation { force, depth: knee }: Saturation, [c1, c2]: [f64; 2]) -> String {
    let (force, knee) = (n(force, "N/m"), n(knee, "m"));
    format!(
        "({} + {force}) · {knee} / 2 + {force} · (({} + {}) / 2 − {knee})",
        n(stiffness.a(), "N/m"),
        n(c1, "m"),
        n(c2, "m")
    )
}
