//! The consistency checks in words, for the text and for the page.

use analysis::{CheckedQuantity, FAST_CLOSING, Seen};
use crash3::EnergyBasis;

use crate::document::Table;
use crate::units::{Measure, Units, number};

/// All checks of the analysis, where it has any. Where one is not passed, a warning below them says more.
pub(crate) fn table(analysis: &Seen, units: Units) -> Option<Table> {
    let mut table = Table::of_two("Consistency checks", ["found", "limit", "verdict"]);
    let percent = |share: f64| format!("{} %", number(100.0 * share, 1));
    let angle = |si: f64| units.format(Measure::Angle, si);
    for check in &analysis.checks {
        let (label, found, limit) = match check.quantity {
            CheckedQuantity::ForceBalance => {
                ("ratio of the peak forces".to_owned(), number(check.value, 2), number(check.limit, 1))
            }
            CheckedQuantity::PdofsOpposite => {
                ("PDOFs from opposite".to_owned(), angle(check.value), angle(check.limit))
            }
            CheckedQuantity::DamageEnergy { .. } => {
                // As much of the crush energy as W_n should be.
                let label = match analysis.basis {
                    EnergyBasis::Dissipated => "normal work and crush energy",
                    EnergyBasis::Absorbed => "normal work and (1 − e²) E",
                };
                (label.to_owned(), percent(check.value), percent(check.limit))
            }
            CheckedQuantity::Restitution => {
                // Where they close slowly there is no limit, and no check.
                let closing = analysis.impact.as_ref().map_or(0.0, |i| -i.outcome.approach.normal);
                let [closing, fast] = [closing, FAST_CLOSING].map(|si| units.road_speed(si));
                (
                    "restitution at closing speed".to_owned(),
                    format!("{} at {closing}", number(check.value, 2)),
                    format!("{} above {fast}", number(check.limit, 1)),
                )
            }
            CheckedQuantity::Rotation { vehicle } => {
                let found = if check.passed() { "with the moment" } else { "against the moment" };
                let is_given = analysis.vehicles[vehicle.index()].subject.pdof().is_some();
                let of = if is_given { "of the PDOF as given" } else { "of the impulse at C" };
                (format!("rotation of vehicle {vehicle}"), found.to_owned(), of.to_owned())
            }
        };
        let verdict = if check.passed() { "passed" } else { "see below" };
        table.row([label, found, limit, verdict.to_owned()]);
    }
    (!table.rows.is_empty()).then_some(table)
}
