//! The comparison as JSON, in SI units and radians.

use serde_json::{Value, json};
use validation::{
    Cell, Claim, DeltaVRow, ErrorRate, Method, Requirement, RestMethod, SHARES, SpeedEvidence, TurnedPdof,
    Validation,
};

use super::{list, object, pretty};

/// Either a tolerance or the reason of a known difference.
fn claim(cell: &Cell) -> Value {
    let (tolerance, known_difference) = match &cell.claim {
        Claim::Reproduces { tolerance } => (Some(*tolerance), None),
        Claim::KnownDifference { reason } => (None, Some(reason)),
    };
    object! {
        "reproduces": cell.is_claimed().then(|| !cell.fails()),
        "tolerance"?: tolerance,
        "known_difference"?: known_difference,
        "erratum"?: cell.erratum,
    }
}

fn claimed(cell: &Cell) -> Value {
    json!({ "ours": cell.ours, "paper": cell.paper, "claim": claim(cell) })
}

/// A requirement of the methods with the result of its test.
fn requirement(found: &Requirement) -> Value {
    object! {
        // The worst is the greatest difference as a share of its tolerance.
        found.{code, requirement, test, acceptance, compared, failed, worst},
        "met": found.is_met(),
    }
}

fn evidence(evidence: SpeedEvidence) -> &'static str {
    match evidence {
        SpeedEvidence::Momentum => "momentum",
        SpeedEvidence::MomentumAndCrush => "momentum_and_crush",
    }
}

fn errors(found: [f64; 2], true_speeds: [f64; 2]) -> [f64; 2] {
    [found[0] - true_speeds[0], found[1] - true_speeds[1]]
}

fn pair<'a, T>(cells: &'a [Cell; 2], of: impl Fn(&'a Cell) -> T) -> [T; 2] {
    cells.each_ref().map(of)
}

fn row_name(row: DeltaVRow) -> &'static str {
    match row {
        DeltaVRow::PimCrush => "pim_crush",
        DeltaVRow::PimTotal => "pim_total",
        DeltaVRow::CrashUncorrected => "crash_uncorrected",
        DeltaVRow::CrashCorrected => "crash_corrected",
        DeltaVRow::CrashUncorrectedImplied => "crash_uncorrected_implied",
        DeltaVRow::CrashCorrectedImplied => "crash_corrected_implied",
    }
}

/// The comparison as indented JSON, ending in a line break.
///
/// # Errors
/// If serialisation fails, which no comparison causes.
pub fn validation_json(validation: &Validation) -> Result<String, serde_json::Error> {
    let speed = &validation.speed_errors;
    let both = &validation.both_speed_errors;
    let energies = validation.energies.iter().flat_map(|line| {
        [
            ("initial_energy", &line.initial),
            ("normal_loss", &line.normal),
            ("tangential_loss", &line.tangential),
            ("total_loss", &line.total),
        ]
        .map(|(quantity, cell)| (line.test, quantity, cell))
    });
    let turn = |pdof: TurnedPdof| json!({ "turn": pdof.turn, "corrected_delta_v": pdof.delta_v });
    pretty(&json!({
        "claimed": validation.claimed(),
        "failed": list(validation.failures(), |(place, cell)| json!({
            "place": place,
            "ours": cell.ours,
            "paper": cell.paper,
        })),
        "requirements": list(&validation.requirements(), requirement),
        "table1": list(&validation.table1, |line| object! {
            "geometry": line.geometry,
            "tests": line.tests,
            "method": match line.method {
                Method::Pim => "pim",
                Method::Crash3 => "crash3",
            },
            "ours": line.ours,
            "ours_implied"?: line.ours_implied,
            "paper_rows": line.paper_rows.ours,
            "paper": line.paper_rows.paper,
            "claim": claim(&line.paper_rows),
        }),
        "table2": list(&validation.table2, |line| json!({
            "test": line.test,
            "row": row_name(line.row),
            "ours": pair(&line.cells, |cell| cell.ours),
            "paper": pair(&line.cells, |cell| cell.paper),
            "difference": pair(&line.cells, Cell::difference),
            "measured": line.measured,
            "claims": pair(&line.cells, claim),
        })),
        "table3": list(&validation.table3, |line| json!({
            "test": line.test,
            "turn": line.turn,
            "ours": pair(&line.cells, |cell| cell.ours),
            "paper": pair(&line.cells, |cell| cell.paper),
            "difference": pair(&line.cells, Cell::difference),
            "claims": pair(&line.cells, claim),
        })),
        "table3_rms": list(&validation.table3_rms, |line| object! {
            line.{tests, turn, ours},
            "paper_rows": line.paper_rows.ours,
            "paper": line.paper_rows.paper,
            "claim": claim(&line.paper_rows),
        }),
        "energies": list(energies, |(test, quantity, cell)| json!({
            "test": test,
            "quantity": quantity,
            "ours": cell.ours,
            "paper": cell.paper,
            "claim": claim(cell),
        })),
        "appendix": list(&validation.appendix, |figure| json!({
            "quantity": figure.quantity,
            "ours": figure.cell.ours,
            "paper": figure.cell.paper,
            "claim": claim(&figure.cell),
        })),
        // From the published profiles; then from other energies.
        "reconstruction": list(&validation.reconstructions, |line| object! {
            line.{test, crush_energy, found},
            "true": line.true_speed,
            "error": line.error(),
            "implied": object! {
                "crush_energy": line.implied_energy,
                "found": line.found_implied,
                "error": line.found_implied - line.true_speed,
            },
            "round_trip": object! {
                "crush_energy": line.printed_normal_loss,
                "found": line.round_trip.ours,
                "error": line.round_trip.difference(),
                "claim": claim(&line.round_trip),
            },
        }),
        "choices": list(&validation.reconstructions, |line| json!({
            "test": line.test,
            "fitted": line.found,
            "critical": line.choices.critical,
            "critical_plastic": line.choices.critical_plastic,
            "pdof": line.choices.pdof.map(turn),
        })),
        // The speed by the share of the tangential work.
        "by_share": list(SHARES.iter().zip(validation.share_errors).enumerate(), |(i, (share, rate))| json!({
            "tangential_share": share,
            // In the order of the tests of `reconstruction`; `null` if there is no answer.
            "found": list(&validation.by_share, |row| row.found[i]),
            "relative_error": rate,
        })),
        "motion": list(&validation.motions, |line| object! {
            "test": line.test,
            "vehicle": line.vehicle.number(),
            "drag": line.drag,
            "distance": claimed(&line.distance),
            "distance_within": line.within,
            "path": line.path,
            "time": line.time,
            "turn": claimed(&line.turn),
            "rest_missed"?: line.miss,
        }),
        "back_from_rest": list(&validation.returns, |line| object! {
            "test": line.test,
            "vehicle": line.vehicle.number(),
            "drag": line.drag,
            "round_trip": claimed(&line.round_trip),
            "from_rest"?: line.from_rest.as_ref().map(|found| json!({
                "speed": claimed(&found.speed),
                "direction": claimed(&found.direction),
                "yaw_rate": claimed(&found.yaw_rate),
                "speed_of_turned_way": found.turned,
            })),
        }),
        // Shares of the path.
        "simulations": list(&validation.simulations, |other| json!({
            "name": other.name,
            "mean_errors": other.errors,
        })),
        "both_speeds": list(&validation.both_speeds, |line| object! {
            "test": line.test,
            "evidence": evidence(line.evidence),
            "true": line.true_speeds,
            "found": line.found,
            "error": errors(line.found, line.true_speeds),
            "impulse_disagreement": line.disagreement,
            "erratum"?: line.erratum,
        }),
        "both_speeds_from_rest": list(&validation.from_rest, |line| json!({
            "test": line.test,
            "method": match line.method {
                RestMethod::Motion => "motion",
                RestMethod::MotionDirected => "motion_directed",
                RestMethod::Slide => "slide",
            },
            "evidence": evidence(line.evidence),
            "drag": line.drag,
            "after": line.after,
            "true": line.true_speeds,
            "found": line.found,
            "error": errors(line.found, line.true_speeds),
        })),
        "error_rate": {
            "delta_v": validation.delta_v_errors,
            "speed": with_relative([
                ("profiles", &speed.profiles),
                ("implied", &speed.implied),
                ("round_trip", &speed.round_trip),
            ]),
            "both_speeds": with_relative([
                ("all", &both.all),
                ("momentum", &both.momentum),
                ("momentum_and_crush", &both.momentum_and_crush),
            ]),
        },
    }))
}

/// Error rates in m/s, each next to its relative error rate.
fn with_relative(rates: [(&str, &[ErrorRate; 2]); 3]) -> Value {
    let both = |(name, [rate, share]): (&str, &[ErrorRate; 2])| {
        [(name.to_owned(), json!(rate)), (format!("{name}_relative"), json!(share))]
    };
    rates.into_iter().flat_map(both).collect()
}
