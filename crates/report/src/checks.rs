//! The consistency checks in words, for the text and for the page.

use analysis::{Analysis, CheckedQuantity, FAST_CLOSING};
use crash3::EnergyBasis;

use crate::units::{Quantity, Units, number};

/// The heading of the checks.
pub(crate) const TITLE: &str = "Consistency checks";
/// What stands over the columns.
pub(crate) const COLUMNS: [&str; 3] = ["found", "limit", "verdict"];

/// One check.
pub(crate) struct Row {
    pub(crate) label: String,
    /// As in [`COLUMNS`].
    pub(crate) cells: [String; 3],
}

/// All checks of the analysis. Where one is not passed, a warning below them says more.
pub(crate) fn rows(analysis: &Analysis, units: Units) -> Vec<Row> {
    let percent = |share: f64| format!("{} %", number(100.0 * share, 1));
    let angle = |si: f64| units.format(Quantity::Angle, si);
    analysis
        .checks
        .iter()
        .map(|check| {
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
                    let [closing, fast] = [closing, FAST_CLOSING].map(|si| units.format(Quantity::Speed, si));
                    (
                        "restitution at closing speed".to_owned(),
                        format!("{} at {closing}", number(check.value, 2)),
                        format!("{} above {fast}", number(check.limit, 1)),
                    )
                }
                CheckedQuantity::Rotation { vehicle } => {
                    let found = if check.passed() { "with the moment" } else { "against the moment" };
                    let damage = analysis.vehicles[vehicle - 1].subject.damage.as_ref();
                    let is_given = damage.is_some_and(|damage| damage.pdof.is_some());
                    let of = if is_given { "of the PDOF as given" } else { "of the impulse at C" };
                    (format!("rotation of vehicle {vehicle}"), found.to_owned(), of.to_owned())
                }
            };
            let verdict = if check.passed() { "passed" } else { "see below" };
            Row { label, cells: [found, limit, verdict.to_owned()] }
        })
        .collect()
}
