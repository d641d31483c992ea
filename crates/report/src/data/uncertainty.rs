//! An uncertainty as JSON.

use std::collections::BTreeMap;

use ::uncertainty::{Bar, End, Estimate, Indices, LEVELS, Summary};
use analysis::{Doubt, Doubtful, ExactValue, REASONS, TakenAsExact, UncertainInput, Uncertainty};
use case::{Case, CaseFile, Input, Origin};
use serde_json::{Map, Value, json};

use super::headline::headline;
use super::json::all_warnings;
use super::{distribution_name, followed, identified, list, object, pretty, title};
use crate::outputs::{estimate_source, input_name, reason_name};
use crate::worth::worth;

/// The uncertainty as indented JSON, ending in a line break: `{"samples": N, "seed": S, "failed": {…},
/// "outputs": {"vehicle1.speed": {"mean": …, "sd": …, "median": …, "interval95": [lo, hi], …}, …},
/// "sensitivity": [{"input": …, "first_order": …, "total": …}]}`. SI units and radians. `samples` are those
/// evaluated; `sensitivity` is that of the first output, and each output has its own.
///
/// # Errors
/// If serialisation fails, which no uncertainty causes.
pub fn uncertainty_json(file: &CaseFile, uncertainty: &Uncertainty) -> Result<String, serde_json::Error> {
    pretty(&identified(file, document(&file.case, uncertainty)))
}

/// The content of the JSON.
pub(crate) fn document(case: &Case, uncertainty: &Uncertainty) -> Value {
    let Uncertainty { inputs, taken_as_exact, tornado, .. } = uncertainty;
    of_inputs(case, uncertainty, inputs, taken_as_exact, &tornado.bars)
}

/// The content for a table of results: without the inputs and their effects.
pub(crate) fn results(case: &Case, uncertainty: &Uncertainty) -> Value {
    of_inputs(case, uncertainty, &[], &[], &[])
}

fn of_inputs(
    case: &Case,
    uncertainty: &Uncertainty,
    inputs: &[UncertainInput],
    taken_as_exact: &[TakenAsExact],
    bars: &[Bar],
) -> Value {
    let propagation = &uncertainty.propagation;
    let outputs = uncertainty.outputs.iter().enumerate();
    let outputs = outputs.map(|(place, one)| (one.output.path(), output(uncertainty, place, bars)));
    let index_rows = uncertainty.indices.as_ref().map(|indices| {
        json!({ "rows": indices.rows(), "used": indices.used(), "evaluations": indices.evaluations() })
    });
    object! {
        "title": title(case),
        // The axes of the inputs.
        "axes": case.axes.name(),
        "samples": propagation.evaluated(),
        "requested": propagation.requested(),
        "seed": uncertainty.settings.seed,
        "method": uncertainty.settings.method.name(),
        "succeeded": propagation.succeeded(),
        "failed": BTreeMap::from(REASONS.map(|reason| (reason_name(reason), uncertainty.failed(reason)))),
        // Samples with an answer that would raise a warning as a single case.
        "doubtful": list(&uncertainty.doubtful, doubtful),
        "inputs": list(inputs, input),
        // Values that all samples share, so that no interval contains their errors.
        "taken_as_exact": list(taken_as_exact, exact),
        "outputs": outputs.collect::<Map<_, _>>(),
        // The indices of the first output.
        "sensitivity": indices(uncertainty, 0),
        "index_rows"?: index_rows,
        // The answer of the case, which the intervals may not be of, and evidence that they do not use.
        "headline"?: headline(&uncertainty.nominal, None),
        "left_aside"?: uncertainty.nominal.left_aside,
        // The warnings of the case with its central values.
        "warnings": all_warnings(&uncertainty.nominal, case),
    }
}

/// `of` is the number of samples that were examined, and `share` the doubtful share of them.
fn doubtful(doubtful: &Doubtful) -> Value {
    let Doubtful { doubt, samples, of } = *doubtful;
    let vehicle = match doubt {
        Doubt::FoundBackward { vehicle }
        | Doubt::GivenBackward { vehicle }
        | Doubt::FoundTooFast { vehicle, .. } => Some(vehicle.number()),
        Doubt::SeveralSpeeds | Doubt::HighRestitution => None,
    };
    #[expect(clippy::cast_precision_loss, reason = "counts are below 2^53")]
    let share = samples as f64 / of as f64;
    let code = doubt.code();
    object! { "code": code, "vehicle"?: vehicle, "samples": samples, "of": of, "share": share }
}

/// `value` is a number or a list of numbers in SI and radians, or a word; `worth` says how well such a number
/// is usually known.
fn exact(exact: &TakenAsExact) -> Value {
    let value: Value = match &exact.value {
        ExactValue::Numbers(numbers) => match numbers.as_slice() {
            [one] if one.path == exact.key => one.si().into(),
            numbers => list(numbers, Input::si).into(),
        },
        ExactValue::Estimate(estimate) => estimate_source(*estimate).into(),
        ExactValue::Word(word) => (*word).into(),
    };
    let worth = worth(&exact.key);
    object! {
        "key": exact.key,
        "value": value,
        "worth"?: worth.as_ref().map(|worth| worth.error),
        "source"?: worth.as_ref().map(|worth| worth.source),
    }
}

/// SI.
fn input(input: &UncertainInput) -> Value {
    let UncertainInput { input: number, distribution, .. } = input;
    let factor = number.factor();
    let bound = |bound: f64| bound.is_finite().then_some(bound * factor);
    let truncated = input.truncation().map(|cut| {
        object! { "low"?: bound(cut.low), "high"?: bound(cut.high), "kept": cut.kept }
    });
    object! {
        "input": number.path,
        // In words, if it is not a key of the file.
        "name"?: (number.origin != Origin::Given).then(|| input_name(number)),
        "distribution": distribution_name(distribution),
        "central": number.si(),
        "mean": distribution.mean() * factor,
        "sd": distribution.sd() * factor,
        "truncated"?: truncated,
    }
}

/// SI and radians; without the statistics if fewer than two samples have an answer.
fn output(uncertainty: &Uncertainty, place: usize, bars: &[Bar]) -> Value {
    let output = &uncertainty.outputs[place];
    let summary = uncertainty.propagation.summaries()[place].as_ref();
    let more = object! {
        // Due to the sampling.
        "standard_error"?: summary.map(|_| statistics(summary, |estimate| estimate.standard_error)),
        "first_order_sd": output.first_order.sd,
        "first_order_differs": summary.map(|summary| output.differs(summary.sd.value)),
        "tornado": list(bars, |one| bar(uncertainty, one, place, output.first_order.shares[one.input])),
        "sensitivity": indices(uncertainty, place),
    };
    let statistics = statistics(summary, |estimate| Some(estimate.value));
    followed(followed(json!({ "central": output.central }), statistics), more)
}

/// A number of each statistic.
fn statistics(summary: Option<&Summary>, of: fn(Estimate) -> Option<f64>) -> Value {
    // The levels are 50, 90, 95 and 99 %, in this order.
    const { assert!(LEVELS.len() == 4) };
    let interval = |level: usize| {
        summary.map(|summary| [summary.intervals[level].low, summary.intervals[level].high].map(of))
    };
    json!({
        "mean": summary.and_then(|summary| of(summary.mean)),
        "sd": summary.and_then(|summary| of(summary.sd)),
        "median": summary.and_then(|summary| of(summary.median)),
        "interval50": interval(0),
        "interval90": interval(1),
        "interval95": interval(2),
        "interval99": interval(3),
    })
}

/// The input at its 2.5 % and 97.5 % quantile, and the output there; `share` is that of its first-order
/// variance.
fn bar(uncertainty: &Uncertainty, bar: &Bar, place: usize, share: f64) -> Value {
    let input = &uncertainty.inputs[bar.input].input;
    let end = |end: &End| {
        let output = end.outputs.as_ref().ok().and_then(|outputs| outputs.get(place).copied());
        [Some(end.input * input.factor()), output]
    };
    json!({ "input": input.path, "low": end(&bar.low), "high": end(&bar.high), "share": share })
}

fn indices(uncertainty: &Uncertainty, place: usize) -> Vec<Value> {
    let all = uncertainty.indices.as_ref().and_then(|indices| indices.indices().get(place)?.as_ref());
    let all = all.into_iter().flatten();
    list(uncertainty.inputs.iter().zip(all), |(input, Indices { first_order, total })| {
        json!({
            "input": input.input.path,
            "first_order": first_order.value,
            "total": total.value,
            "first_order_interval95": first_order.interval95(),
            "total_interval95": total.interval95(),
        })
    })
}
