//! An uncertainty as JSON.

use std::collections::BTreeMap;

use ::uncertainty::{Bar, End, Estimate, Indices, LEVELS, Summary};
use analysis::{Doubt, Doubtful, ExactValue, REASONS, TakenAsExact, UncertainInput, Uncertainty};
use case::{Case, CaseFile, Input, Origin};
use pim_core::VehicleId;
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::json::WarningBlock;
use super::{distribution_name, identified, pretty, title};
use crate::outputs::{estimate_source, input_name, reason_name};
use crate::worth::worth;

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// The axes of the inputs.
    axes: &'static str,
    samples: usize,
    requested: usize,
    seed: u64,
    method: &'static str,
    succeeded: usize,
    failed: BTreeMap<&'static str, usize>,
    /// Samples with an answer that would raise a warning as a single case.
    doubtful: Vec<DoubtfulBlock>,
    inputs: Vec<InputBlock<'a>>,
    /// Values that all samples share, so that no interval contains their errors.
    taken_as_exact: Vec<ExactBlock<'a>>,
    outputs: InOrder<OutputBlock<'a>>,
    /// The indices of the first output.
    sensitivity: Vec<IndexBlock<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    index_rows: Option<RowsBlock>,
    /// The warnings of the case with its central values.
    warnings: Vec<WarningBlock>,
}

/// `of` is the number of samples that were examined, and `share` the doubtful share of them.
#[derive(Serialize)]
struct DoubtfulBlock {
    code: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    vehicle: Option<u8>,
    samples: usize,
    of: usize,
    share: f64,
}

/// `value` in SI and radians; `worth` says how well such a number is usually known.
#[derive(Serialize)]
struct ExactBlock<'a> {
    key: &'a str,
    value: ExactNumbers,
    #[serde(skip_serializing_if = "Option::is_none")]
    worth: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<&'static str>,
}

/// A number, the numbers of a list, or a word.
#[derive(Serialize)]
#[serde(untagged)]
enum ExactNumbers {
    One(f64),
    List(Vec<f64>),
    Word(String),
}

/// An object whose keys keep their order.
struct InOrder<T>(Vec<(String, T)>);

impl<T: Serialize> Serialize for InOrder<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (key, value) in &self.0 {
            map.serialize_entry(key, value)?;
        }
        map.end()
    }
}

/// SI.
#[derive(Serialize)]
struct InputBlock<'a> {
    input: &'a str,
    /// In words, if it is not a key of the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    distribution: &'static str,
    central: f64,
    mean: f64,
    sd: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    truncated: Option<TruncationBlock>,
}

#[derive(Serialize)]
struct TruncationBlock {
    #[serde(skip_serializing_if = "Option::is_none")]
    low: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    high: Option<f64>,
    kept: f64,
}

/// SI and radians; without the statistics if fewer than two samples have an answer.
#[derive(Serialize)]
struct OutputBlock<'a> {
    central: f64,
    mean: Option<f64>,
    sd: Option<f64>,
    median: Option<f64>,
    interval50: Option<[f64; 2]>,
    interval90: Option<[f64; 2]>,
    interval95: Option<[f64; 2]>,
    interval99: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_error: Option<ErrorBlock>,
    first_order_sd: f64,
    first_order_differs: Option<bool>,
    tornado: Vec<BarBlock<'a>>,
    sensitivity: Vec<IndexBlock<'a>>,
}

/// Standard errors due to the sampling.
#[derive(Serialize)]
struct ErrorBlock {
    mean: Option<f64>,
    sd: Option<f64>,
    median: Option<f64>,
    interval50: [Option<f64>; 2],
    interval90: [Option<f64>; 2],
    interval95: [Option<f64>; 2],
    interval99: [Option<f64>; 2],
}

/// The input at its 2.5 % and 97.5 % quantile, and the output there; `share` is that of its first-order
/// variance.
#[derive(Serialize)]
struct BarBlock<'a> {
    input: &'a str,
    low: [Option<f64>; 2],
    high: [Option<f64>; 2],
    share: f64,
}

#[derive(Serialize)]
struct RowsBlock {
    rows: usize,
    used: usize,
    evaluations: usize,
}

#[derive(Serialize)]
struct IndexBlock<'a> {
    input: &'a str,
    first_order: f64,
    total: f64,
    first_order_interval95: Option<[f64; 2]>,
    total_interval95: Option<[f64; 2]>,
}

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
pub(crate) fn document<'a>(case: &'a Case, uncertainty: &'a Uncertainty) -> impl Serialize + use<'a> {
    let Uncertainty { inputs, taken_as_exact, tornado, .. } = uncertainty;
    of_inputs(case, uncertainty, inputs, taken_as_exact, &tornado.bars)
}

/// The content for a table of results: without the inputs and their effects.
pub(crate) fn results<'a>(case: &'a Case, uncertainty: &'a Uncertainty) -> impl Serialize + use<'a> {
    of_inputs(case, uncertainty, &[], &[], &[])
}

fn of_inputs<'a>(
    case: &'a Case,
    uncertainty: &'a Uncertainty,
    inputs: &'a [UncertainInput],
    taken_as_exact: &'a [TakenAsExact],
    bars: &'a [Bar],
) -> Document<'a> {
    let propagation = &uncertainty.propagation;
    let outputs = (0..uncertainty.outputs.len()).map(|place| {
        let output = &uncertainty.outputs[place];
        (output.output.path(), output_block(uncertainty, place, bars))
    });
    Document {
        title: title(case),
        axes: case.axes.name(),
        warnings: WarningBlock::all(&uncertainty.nominal, case),
        samples: propagation.evaluated(),
        requested: propagation.requested(),
        seed: uncertainty.settings.seed,
        method: uncertainty.settings.method.name(),
        succeeded: propagation.succeeded(),
        failed: REASONS.map(|reason| (reason_name(reason), uncertainty.failed(reason))).into(),
        doubtful: uncertainty.doubtful.iter().map(doubtful_block).collect(),
        inputs: inputs.iter().map(input_block).collect(),
        taken_as_exact: taken_as_exact.iter().map(exact_block).collect(),
        outputs: InOrder(outputs.collect()),
        sensitivity: indices(uncertainty, 0),
        index_rows: uncertainty.indices.as_ref().map(|indices| RowsBlock {
            rows: indices.rows(),
            used: indices.used(),
            evaluations: indices.evaluations(),
        }),
    }
}

fn doubtful_block(doubtful: &Doubtful) -> DoubtfulBlock {
    let Doubtful { doubt, samples, of } = *doubtful;
    let vehicle = match doubt {
        Doubt::FoundBackward { vehicle }
        | Doubt::GivenBackward { vehicle }
        | Doubt::FoundTooFast { vehicle, .. } => Some(if vehicle == VehicleId::One { 1 } else { 2 }),
        Doubt::SeveralSpeeds | Doubt::HighRestitution => None,
    };
    #[expect(clippy::cast_precision_loss, reason = "counts are below 2^53")]
    let share = samples as f64 / of as f64;
    DoubtfulBlock { code: doubt.code(), vehicle, samples, of, share }
}

fn exact_block(exact: &TakenAsExact) -> ExactBlock<'_> {
    let value = match &exact.value {
        ExactValue::Numbers(numbers) => match numbers.as_slice() {
            [one] if one.path == exact.key => ExactNumbers::One(one.si()),
            list => ExactNumbers::List(list.iter().map(Input::si).collect()),
        },
        ExactValue::Estimate(estimate) => ExactNumbers::Word(estimate_source(*estimate)),
        ExactValue::Word(word) => ExactNumbers::Word((*word).to_owned()),
    };
    let worth = worth(&exact.key);
    ExactBlock {
        key: &exact.key,
        value,
        worth: worth.as_ref().map(|worth| worth.error),
        source: worth.map(|worth| worth.source),
    }
}

fn input_block(input: &UncertainInput) -> InputBlock<'_> {
    let UncertainInput { input: number, distribution, .. } = input;
    let factor = number.factor();
    let bound = |bound: f64| bound.is_finite().then_some(bound * factor);
    InputBlock {
        input: &number.path,
        name: (number.origin != Origin::Given).then(|| input_name(number)),
        distribution: distribution_name(distribution),
        central: number.si(),
        mean: distribution.mean() * factor,
        sd: distribution.sd() * factor,
        truncated: input.truncation().map(|cut| TruncationBlock {
            low: bound(cut.low),
            high: bound(cut.high),
            kept: cut.kept,
        }),
    }
}

fn output_block<'a>(uncertainty: &'a Uncertainty, place: usize, bars: &'a [Bar]) -> OutputBlock<'a> {
    let output = &uncertainty.outputs[place];
    let summary = uncertainty.propagation.summaries()[place].as_ref();
    let interval = |level: usize| {
        summary.map(|summary| [summary.intervals[level].low.value, summary.intervals[level].high.value])
    };
    OutputBlock {
        central: output.central,
        mean: summary.map(|summary| summary.mean.value),
        sd: summary.map(|summary| summary.sd.value),
        median: summary.map(|summary| summary.median.value),
        interval50: interval(0),
        interval90: interval(1),
        interval95: interval(2),
        interval99: interval(3),
        standard_error: summary.map(errors),
        first_order_sd: output.first_order.sd,
        first_order_differs: summary.map(|summary| output.differs(summary.sd.value)),
        tornado: bars
            .iter()
            .map(|bar| bar_block(uncertainty, bar, place, output.first_order.shares[bar.input]))
            .collect(),
        sensitivity: indices(uncertainty, place),
    }
}

fn errors(summary: &Summary) -> ErrorBlock {
    // The levels are 50, 90, 95 and 99 %, in this order.
    const { assert!(LEVELS.len() == 4) };
    let of = |estimate: Estimate| estimate.standard_error;
    let [interval50, interval90, interval95, interval99] =
        summary.intervals.map(|interval| [of(interval.low), of(interval.high)]);
    ErrorBlock {
        mean: of(summary.mean),
        sd: of(summary.sd),
        median: of(summary.median),
        interval50,
        interval90,
        interval95,
        interval99,
    }
}

fn bar_block<'a>(uncertainty: &'a Uncertainty, bar: &Bar, place: usize, share: f64) -> BarBlock<'a> {
    let input = &uncertainty.inputs[bar.input].input;
    let end = |end: &End| {
        let output = end.outputs.as_ref().ok().and_then(|outputs| outputs.get(place).copied());
        [Some(end.input * input.factor()), output]
    };
    BarBlock { input: &input.path, low: end(&bar.low), high: end(&bar.high), share }
}

fn indices(uncertainty: &Uncertainty, place: usize) -> Vec<IndexBlock<'_>> {
    let all = uncertainty.indices.as_ref().and_then(|indices| indices.indices().get(place)?.as_ref());
    let Some(all) = all else { return Vec::new() };
    uncertainty
        .inputs
        .iter()
        .zip(all)
        .map(|(input, Indices { first_order, total })| IndexBlock {
            input: &input.input.path,
            first_order: first_order.value,
            total: total.value,
            first_order_interval95: first_order.interval95(),
            total_interval95: total.interval95(),
        })
        .collect()
}
