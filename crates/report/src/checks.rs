//! The consistency checks in words, for the text and for the page.

use analysis::{Analysis, Check, CheckedQuantity, FAST_CLOSING, Seen, limit_factor};
use case::Basis;

use crate::basis::short;
use crate::document::Table;
use crate::units::{Measure, Units, number};
use crate::{basis, words};

/// The checks that a reader is told of.
pub(crate) fn told<W>(analysis: &Analysis<W>) -> impl Iterator<Item = &Check> {
    // If momentum gives both speeds, its own comparison of the energies takes account of the errors of both.
    let is_of_momentum = |check: &Check| matches!(check.quantity, CheckedQuantity::MomentumEnergy { .. });
    let has_momentum = analysis.checks.iter().any(is_of_momentum);
    let is_twice =
        move |check: &&Check| has_momentum && matches!(check.quantity, CheckedQuantity::DamageEnergy { .. });
    analysis.checks.iter().filter(move |check| !is_twice(check))
}

/// All checks of the analysis; `None` without any. A warning below explains each failed one.
pub(crate) fn table(analysis: &Seen, units: Units) -> Option<Table> {
    let mut table = Table::of_two("Consistency checks", ["found", "limit", "verdict"]);
    for check in told(analysis) {
        let [label, found, limit] = said(check, analysis, units);
        let verdict = match (check.passed(), check.can_fail()) {
            (true, true) => "passed",
            (true, false) => "errors too large to tell",
            (false, _) => "see below",
        };
        table.row([label, found, limit, verdict.to_owned()]);
    }
    (!table.rows.is_empty()).then_some(table)
}

/// How far the first of two energies is from the second: as a factor, or in per cent if the first is not
/// positive.
fn apart(one: f64, other: f64) -> String {
    if one > 0.0 {
        format!("× {}", number(one.max(other) / one.min(other), 1))
    } else {
        format!("{} %", number(100.0 * (one - other).abs() / other, 1))
    }
}

/// What a check of this analysis compares, what it found, and its limit.
pub(crate) fn said(check: &Check, analysis: &Seen, units: Units) -> [String; 3] {
    let percent = |share: f64| format!("{} %", number(100.0 * share, 1));
    let angle = |si: f64| units.format(Measure::Angle, si);
    let energy = |si: f64| units.format(Measure::Energy, si);
    let (label, found, limit) = match check.quantity {
        CheckedQuantity::ForceBalance => {
            ("ratio of the peak forces".to_owned(), number(check.value, 2), number(check.limit, 1))
        }
        CheckedQuantity::PdofsOpposite => {
            ("PDOFs from opposite".to_owned(), angle(check.value), angle(check.limit))
        }
        CheckedQuantity::DamageEnergy { .. } => {
            // The part of the crush energy that W_n should equal.
            let label = match analysis.basis {
                Basis::Dissipated => "normal work and crush energy".to_owned(),
                Basis::Absorbed => "normal work and (1 − e²) E".to_owned(),
                Basis::TangentialShare(_) => {
                    format!("{} and crush energy", basis::symbol(analysis.basis, ["W_n", "W_t"]))
                }
            };
            (label, percent(check.value), percent(check.limit))
        }
        CheckedQuantity::Restitution => {
            // At a low closing speed there is no limit, and no check.
            let closing = analysis.exchange().map_or(0.0, |exchange| exchange.closing_speed);
            let [closing, fast] = [closing, FAST_CLOSING].map(|si| units.road_speed(si));
            (
                "restitution at closing speed".to_owned(),
                format!("{} at {closing}", number(check.value, 2)),
                format!("{} above {fast}", number(check.limit, 1)),
            )
        }
        CheckedQuantity::Rotation { vehicle } => {
            let found = if check.passed() { "with the moment" } else { "against the moment" };
            let is_given = analysis.vehicles[vehicle.index()].subject.force.pdof.is_some();
            let of = if is_given { "of the PDOF as given" } else { "of the impulse at C" };
            (format!("rotation of vehicle {vehicle}"), found.to_owned(), of.to_owned())
        }
        CheckedQuantity::MomentumEnergy { normal_work, crush_energy, tangential_share: _ } => (
            format!("momentum: {} and crush energy", basis::symbol(analysis.basis, ["W_n", "W_t"])),
            format!(
                "{} and {}: {}",
                energy(normal_work),
                energy(crush_energy),
                apart(normal_work, crush_energy)
            ),
            format!("× {}", number(limit_factor(normal_work > crush_energy, check.limit), 1)),
        ),
        CheckedQuantity::MomentumAcross { vehicle, surplus } => {
            let impulse = |si: f64| units.format(Measure::Impulse, si);
            (
                format!("momentum: across vehicle {vehicle}"),
                format!("{} too much", impulse(surplus)),
                format!("±{}", impulse(check.limit)),
            )
        }
        CheckedQuantity::MomentumBalance { difference, impulse } => (
            "momentum: impulses".to_owned(),
            format!(
                "{} apart, mean {}",
                units.format(Measure::Impulse, difference),
                units.format(Measure::Impulse, impulse)
            ),
            "the mean".to_owned(),
        ),
        CheckedQuantity::PossibleRestitution { implied } => (
            "momentum: possible restitution".to_owned(),
            number(implied, 2),
            format!("0 to 1, ±{}", number(check.limit, 1)),
        ),
        CheckedQuantity::MomentumRestitution { implied, given } => (
            "momentum: restitution".to_owned(),
            format!("{}, the case has {}", number(implied, 2), short(given, 4)),
            format!("{} apart", number(check.limit, 1)),
        ),
        CheckedQuantity::MomentumRatio { implied, critical } => (
            "momentum: impulse ratio".to_owned(),
            number(implied, 2),
            format!("0 to {}, ±{}", number(critical, 2), number(check.limit, 2)),
        ),
        CheckedQuantity::MomentumYawRate { vehicle, implied, told } => {
            let degrees = |si: f64| units.format(Measure::YawRateDegrees, si);
            let plain = |si: f64| units.plain(Measure::YawRateDegrees, si);
            (
                format!("momentum: yaw rate, vehicle {vehicle}"),
                format!("{}, evidence: {}", plain(implied), degrees(told)),
                format!("{} apart", degrees(check.limit)),
            )
        }
        CheckedQuantity::MomentumPdof { vehicle, implied, given } => (
            format!("momentum: PDOF of vehicle {vehicle}"),
            format!("{}, the case has {}", angle(implied), angle(given)),
            format!("{} apart", angle(check.limit)),
        ),
        CheckedQuantity::PointMissed { vehicle, point, pass } => (
            format!("path past point {point} of vehicle {vehicle}"),
            format!("{}: {}", words::pass(&pass, units), percent(check.value)),
            format!("{} of the path", percent(check.limit)),
        ),
        CheckedQuantity::RestMissed { vehicle, miss } => (
            format!("path to the rest of vehicle {vehicle}"),
            format!("ends {} from it: {}", units.format(Measure::Length, miss), percent(check.value)),
            format!("{} of the path", percent(check.limit)),
        ),
    };
    [label, found, limit]
}
