//! An estimate as JSON, and its draws as CSV, in SI units and radians.

use std::io::{self, Write};

use ::estimate::{DrawsSummary, SamplerDoubt};
use ::uncertainty::Estimate;
use analysis::{Agreement, Estimated, EstimatedOutput, PieceFound, UnknownNumber};
use case::CaseFile;
use evidence::{CrushErrors, EnergyMethod, TestedClass};
use pim_core::VehicleId;
use serde_json::{Map, Value, json};

use super::csv::CsvStyle;
use super::json::warning;
use super::{distribution_name, identified, list, object, pretty, title};
use crate::estimates::{
    Asked, EIGHTY, HALF, NINETY, Question, WIDEST, doubt_code, doubted, ends, factor, unknown_key, unused,
};

/// The median and the ends of the 95 % interval.
fn spread(summary: &DrawsSummary) -> Value {
    json!({ "median": summary.median.value, "interval95": ends(summary, WIDEST) })
}

fn output(output: &EstimatedOutput, is_answer: bool) -> Value {
    let answer = is_answer.then_some(&output.posterior);
    let level = |place: usize| answer.map(|summary| ends(summary, place));
    let error = |estimate: Estimate| estimate.standard_error;
    json!({
        // Whether the evidence determines it.
        "told": is_answer.then(|| output.is_told()),
        // `null` if the run before the evidence has not converged.
        "prior": output.prior.as_ref().map(spread),
        "median": answer.map(|summary| summary.median.value),
        "interval50": level(HALF),
        "interval80": level(EIGHTY),
        "interval90": level(NINETY),
        "interval95": level(WIDEST),
        "mean": answer.map(|summary| summary.mean.value),
        "sd": answer.map(|summary| summary.sd.value),
        // Standard errors due to the sampling.
        "standard_error": answer.map(|summary| json!({
            "median": error(summary.median),
            "interval95": [error(summary.intervals[WIDEST].low), error(summary.intervals[WIDEST].high)],
            "mean": error(summary.mean),
            "sd": error(summary.sd),
        })),
        // If somebody was seriously hurt; `null` if another prior was asked for, or too few draws lead there.
        "if_serious_injury": output.if_injured.as_ref().filter(|_| is_answer).map(spread),
    })
}

/// The probability that a result is above the limit.
fn question(question: &Question, estimated: &Estimated, is_answer: bool) -> Value {
    let answer = estimated.probability_above(question.output, question.limit).filter(|_| is_answer);
    json!({
        "output": question.output.path(),
        "above": question.limit,
        "probability": answer.map(|probability| probability.value),
        "standard_error": answer.and_then(|probability| probability.standard_error),
    })
}

/// The speeds of vehicle 1 and 2 by a piece alone, and without it. `null` if that was not asked for or has
/// not converged.
fn piece(piece: &PieceFound, agreement: Option<(Agreement, f64)>) -> Value {
    let speeds = |speeds: &Option<[Option<DrawsSummary>; 2]>| {
        speeds.as_ref().map(|speeds| speeds.each_ref().map(|speed| speed.as_ref().map(spread)))
    };
    json!({
        "key": piece.key,
        "alone": speeds(&piece.alone),
        "without": speeds(&piece.without),
        "p_value": piece.p_value.map(|p| p.value),
        // The p-value after Holm's correction, which decides the verdict.
        "adjusted_p_value": agreement.map(|(_, adjusted)| adjusted),
        // Whether it points in the opposite direction to the rest.
        "reversed": piece.reversed,
        "verdict": agreement.map(|(agreement, _)| agreement.name()),
    })
}

/// Real collisions on which intervals were tested.
fn tested(class: &TestedClass) -> Value {
    object! { class.{code, collisions, quantity, n, inside95, rms, source} }
}

/// How the crush energy of a vehicle was obtained, and its error in ln.
fn crush(estimated: &Estimated, CrushErrors(errors): &CrushErrors, id: VehicleId) -> Option<Value> {
    let method = match estimated.energies[id.index()]? {
        EnergyMethod::Class => "class",
        EnergyMethod::Fleet => "fleet",
        EnergyMethod::Coefficients => "coefficients",
        EnergyMethod::Test => "test",
        EnergyMethod::Ees => "ees",
        EnergyMethod::OfObject => "object",
    };
    let error = &errors[id.index()];
    Some(json!({
        "method": method,
        "bias": error.bias,
        "shared_sd": estimated.observed.shared_ln_sd(id)?,
        "own_sd": error.own_ln_sd,
    }))
}

fn unknown(unknown: &UnknownNumber, is_answer: bool) -> Value {
    let factor = factor(unknown);
    let summary = &unknown.posterior;
    json!({
        "key": unknown_key(unknown),
        // Whether its prior is assumed, because the case does not give it.
        "assumed": unknown.assumed.is_some(),
        "prior": {
            "distribution": distribution_name(&unknown.prior),
            "mean": unknown.prior.mean() * factor,
            "sd": unknown.prior.sd() * factor,
        },
        "posterior": is_answer.then(|| json!({
            "median": summary.median.value * factor,
            "interval95": ends(summary, WIDEST).map(|end| end * factor),
            "mean": summary.mean.value * factor,
            "sd": summary.sd.value * factor,
        })),
    })
}

/// The estimate as indented JSON, ending in a line break: `outputs` with prior, median and intervals of each
/// result, `converged` and `ess`, the `pieces` of evidence, `questions` and `unknown` numbers. SI units and
/// radians. If the run has not converged, everything after the evidence is `null`.
///
/// # Errors
/// If serialisation fails, which no estimate causes.
pub fn estimate_json(
    file: &CaseFile,
    estimated: &Estimated,
    asked: &Asked,
) -> Result<String, serde_json::Error> {
    let doubts = estimated.doubts();
    let is_answer = doubts.is_empty();
    let doubt = |doubt: &SamplerDoubt| {
        object! { "code": doubt_code(doubt), "key"?: doubted(doubt, estimated) }
    };
    let outputs = estimated.outputs.iter().map(|one| (one.output.path(), output(one, is_answer)));
    let pieces = estimated.pieces.iter().zip(Agreement::of_all(&estimated.pieces));
    let crush = estimated.observed.crush.map(|errors| VehicleId::ALL.map(|id| crush(estimated, &errors, id)));
    let document = json!({
        "title": title(&file.case),
        // The axes of the inputs.
        "axes": file.case.axes.name(),
        // The kind of prior.
        "prior": estimated.prior.name(),
        "seed": asked.plan.seed,
        // As requested, per island; doubled if the run did not converge.
        "particles": asked.plan.particles,
        "draws": estimated.posterior.count(),
        "converged": is_answer,
        "doubts": list(doubts, doubt),
        // Keys of evidence that even the nearest collisions miss: the medians are then no answer.
        "missed": estimated.missed,
        // The least effective sample size of all numbers.
        "ess": estimated.ess(),
        // Without statistics if the run has not converged.
        "outputs": outputs.collect::<Map<_, _>>(),
        "questions": list(&asked.questions, |one| question(one, estimated, is_answer)),
        "pieces": list(pieces, |(found, agreement)| piece(found, agreement)),
        // Of vehicle 1 and 2; `null` if the crush is not evidence.
        "crush": crush,
        // The class of real collisions on which such intervals were tested; `null` if no such class was
        // tested.
        "tested": estimated.tested.map(tested),
        // Probability that each vehicle stood still: as assumed, among the collisions that are possible
        // before the evidence, and after it. `null` if the vehicle certainly moved, or if its speed is known.
        "stood": estimated.stood.map(|stood| stood.map(|stood| json!({
            "assumed": stood.assumed,
            "prior": stood.before.map(|before| before.value),
            "probability": is_answer.then_some(stood.after.value),
        }))),
        "same_twice": list(&estimated.same_twice, |same| &same.keys),
        "unknown": list(&estimated.unknown, |one| unknown(one, is_answer)),
        // Keys of errors that the case does not give.
        "default_errors": estimated.default_errors,
        "unused": list(&estimated.unused, |one| json!({ "key": one.key, "reason": unused(one.reason)[0] })),
        // The warnings about the inputs.
        "warnings": list(&estimated.warnings, |one| warning(&one.seen(file.case.axes))),
    });
    pretty(&identified(file, document))
}

/// A column of the draws of an estimate.
#[derive(Clone, Debug)]
pub struct DrawColumn<'a> {
    /// The key of an unknown number or of a result.
    pub key: String,
    /// (SI) the size of the unit of the values.
    pub factor: f64,
    /// A value for each draw.
    pub values: &'a [f64],
}

/// The draws of an estimate: the unknown numbers and the results. A number that is also a result appears
/// once.
#[must_use]
pub fn draw_columns(estimated: &Estimated) -> Vec<DrawColumn<'_>> {
    let results = estimated.outputs.iter().zip(estimated.posterior.outputs());
    let results: Vec<DrawColumn<'_>> = results
        .map(|(output, values)| DrawColumn { key: output.output.path(), factor: 1.0, values })
        .collect();
    let unknown = estimated
        .unknown
        .iter()
        .zip(estimated.posterior.values())
        .map(|(unknown, values)| DrawColumn { key: unknown_key(unknown), factor: factor(unknown), values });
    let mut columns: Vec<DrawColumn<'_>> =
        unknown.filter(|column| results.iter().all(|result| result.key != column.key)).collect();
    columns.extend(results);
    columns
}

/// Writes a line for each draw: its number, the unknown numbers and the results, in SI units and radians. All
/// draws have the same weight. Numbers are the shortest that read back as the same, in the style of the
/// spreadsheet.
///
/// # Errors
/// If `out` cannot be written to.
pub fn write_draws(estimated: &Estimated, style: CsvStyle, out: &mut dyn Write) -> io::Result<()> {
    let next = style.separator();
    let columns = draw_columns(estimated);
    write!(out, "{}draw", style.beginning())?;
    for DrawColumn { key, .. } in &columns {
        write!(out, "{next}{key}")?;
    }
    writeln!(out)?;
    for draw in 0..estimated.posterior.count() {
        write!(out, "{}", draw + 1)?;
        for DrawColumn { factor, values, .. } in &columns {
            write!(out, "{next}{}", style.number((values[draw] * factor).to_string()))?;
        }
        writeln!(out)?;
    }
    Ok(())
}
