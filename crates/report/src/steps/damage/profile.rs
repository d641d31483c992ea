//! The crush energy of a measured profile.

use crash3::{Profile, Saturation, Stiffness, Yielding, Zone, zone_energy};
use pim_core::VehicleId;

use super::super::numbers::Amount;
use super::super::{Draft, n, step};

/// Area and second moment of a profile.
pub(super) fn moments(profile: &Profile, i: VehicleId) -> [Draft; 2] {
    let sums = profile.sums();
    let sum = |term: &dyn Fn(usize) -> String| {
        let terms = (1..).zip(profile.zones()).map(|(j, _)| term(j));
        terms.collect::<Vec<_>>().join(" + ")
    };
    let widths = || (1..).zip(profile.zones()).map(|(j, zone)| (format!("w_{j}"), n(zone.width, "m")));
    [
        step(format!("area of the crush of vehicle {i}"), format!("S_1,{i}"), (sums.area, "m²"), "Eq 5")
            .equals("Σ w_j (C_j + C_j+1)/2")
            .written_out(sum(&|j| format!("w_{j} (C_{j} + C_{})/2", j + 1))),
        step(
            format!("second moment of the crush of vehicle {i}"),
            format!("S_2,{i}"),
            (sums.second_moment, "m³"),
            "Eq 5",
        )
        .equals("Σ w_j (C_j² + C_j C_j+1 + C_j+1²)/6")
        .written_out(sum(&|j| format!("w_{j} ({})/6", squares(j)))),
    ]
    .map(|step| step.with(widths()).with(stations(profile.depths())))
}

/// The depths at the stations.
pub(super) fn stations(depths: &[f64]) -> impl Iterator<Item = (String, Amount)> {
    (1..).zip(depths).map(|(j, depth)| (format!("C_{j}"), n(*depth, "m")))
}

/// C_j² + C_j C_j+1 + C_j+1² of a zone.
pub(super) fn squares(j: usize) -> String {
    format!("C_{j}² + C_{j} C_{0} + C_{0}²", j + 1)
}

/// With one stiffness along the side and no saturation: from the moments of the profile.
pub(super) fn whole(profile: &Profile, energy: f64, i: VehicleId) -> Draft {
    step(format!("crush energy of vehicle {i}"), format!("E_{i}"), (energy, "J"), "Eq 5")
        .equals(format!("A_{i} S_1,{i} + B_{i} S_2,{i} + G_{i} L_{i}"))
        .with([(format!("L_{i}"), n(profile.sums().width, "m"))])
}

/// Zone by zone, if the stiffness differs along the side or its limit is reached.
pub(super) fn zone_by_zone(
    zones: impl Iterator<Item = (Zone, Stiffness)>,
    energy: f64,
    i: VehicleId,
) -> Vec<Draft> {
    let (mut steps, mut terms) = (Vec::new(), Vec::new());
    for (j, (zone, stiffness)) in (1..).zip(zones) {
        let (formula, numeric) = energy_of_zone(zone.yielding(&stiffness));
        let symbol = format!("E_{i},{j}");
        terms.push(symbol.clone());
        steps.push(
            step(
                format!("crush energy of vehicle {i}, zone {j}"),
                symbol,
                (zone_energy(zone, &stiffness), "J"),
                "Eq 5",
            )
            .equals(formula)
            .written_out(numeric)
            .with(of_zone(zone, &stiffness)),
        );
    }
    steps.push(
        step(format!("crush energy of vehicle {i}"), format!("E_{i}"), (energy, "J"), "Eq 5")
            .equals(format!("Σ E_{i},j"))
            .written_out(terms.join(" + ")),
    );
    steps
}

/// s, the share of a zone's width on which the force still rises.
pub(crate) const SHARE_BELOW: &str = "(C_s − C_low)/(C_high − C_low)";

/// The symbols of a zone alone.
pub(crate) fn of_zone(zone: Zone, stiffness: &Stiffness) -> Vec<(&'static str, Amount)> {
    let [c1, c2] = zone.depths;
    let mut own = vec![
        ("w", n(zone.width, "m")),
        ("w_j", n(zone.width, "m")),
        ("C_j", n(c1, "m")),
        ("C_j+1", n(c2, "m")),
        ("C_low", n(c1.min(c2), "m")),
        ("C_high", n(c1.max(c2), "m")),
        ("A", n(stiffness.a(), "N/m")),
        ("B", n(stiffness.b(), "N/m²")),
        ("G", n(stiffness.g(), "N")),
    ];
    match zone.yielding(stiffness) {
        Yielding::Nowhere => {}
        Yielding::Throughout(Saturation { force, depth })
        | Yielding::Partly { saturation: Saturation { force, depth }, .. } => {
            own.extend([("F_s", n(force, "N/m")), ("C_s", n(depth, "m"))]);
        }
    }
    own
}

/// The energy of a zone: as shown, and with every part written out.
fn energy_of_zone(yielding: Yielding) -> (String, String) {
    match yielding {
        Yielding::Nowhere => {
            let formula = "w_j [A (C_j + C_j+1)/2 + B (C_j² + C_j C_j+1 + C_j+1²)/6 + G]".to_owned();
            (formula.clone(), formula)
        }
        Yielding::Throughout(_) => {
            let formula = "w [(A + F_s) C_s/2 + F_s ((C_j + C_j+1)/2 − C_s) + G]";
            (format!("{formula}, C_s = (F_s − A)/B"), formula.to_owned())
        }
        Yielding::Partly { .. } => {
            let rising = "A (C_low + C_s)/2 + B (C_low² + C_low C_s + C_s²)/6";
            let flat = "(A + F_s) C_s/2 + F_s ((C_s + C_high)/2 − C_s)";
            (
                format!("w [s e_rising(C_low, C_s) + (1 − s) e_flat(C_s, C_high) + G], s = {SHARE_BELOW}"),
                format!("w [{SHARE_BELOW} ({rising}) + (1 − {SHARE_BELOW}) ({flat}) + G]"),
            )
        }
    }
}
