//! An estimate as JSON, and its draws as CSV, in SI units and radians.

use std::io::{self, Write};

use ::estimate::{DrawsSummary, SamplerDoubt};
use ::uncertainty::{Distribution, Estimate, Shape};
use analysis::{Agreement, Estimated, EstimatedOutput, PieceFound, Stood, UnknownNumber};
use case::CaseFile;
use evidence::{CrushErrors, EnergyError, EnergyMethod, TestedClass};
use pim_core::VehicleId;
use serde::Serialize;

use super::csv::CsvStyle;
use super::json::WarningBlock;
use super::uncertainty::InOrder;
use super::{identified, pretty, title};
use crate::estimates::{
    Asked, EIGHTY, HALF, NINETY, Question, WIDEST, doubt_code, doubted, ends, factor, unknown_key, unused,
};

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// The axes of the inputs.
    axes: &'static str,
    /// The kind of prior.
    prior: &'static str,
    seed: u64,
    /// As asked for, per island; doubled where the run did not converge.
    particles: usize,
    draws: usize,
    converged: bool,
    doubts: Vec<DoubtBlock>,
    /// Keys of evidence that even the nearest collisions miss: the medians are then no answer.
    missed: &'a [String],
    /// The least effective sample size of all numbers.
    ess: f64,
    /// In order; without statistics where the run has not converged.
    outputs: InOrder<OutputBlock>,
    questions: Vec<QuestionBlock>,
    pieces: Vec<PieceBlock<'a>>,
    /// The error of the crush energies of vehicle 1 and 2; `null` if the crush is not evidence.
    crush: Option<[Option<CrushBlock>; 2]>,
    /// The class of real collisions on which such intervals were judged; `null` where nothing like it was.
    tested: Option<TestedBlock>,
    /// How probable it is that vehicle 1 and 2 stood; `null` for one that did not, or whose speed is known.
    stood: [Option<StoodBlock>; 2],
    same_twice: Vec<&'a [String; 2]>,
    unknown: Vec<UnknownBlock>,
    /// Keys of errors that the case does not give.
    default_errors: &'a [String],
    unused: Vec<UnusedBlock<'a>>,
    /// What speaks against the inputs.
    warnings: Vec<WarningBlock>,
}

#[derive(Serialize)]
struct DoubtBlock {
    code: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    key: Option<String>,
}

#[derive(Serialize)]
struct OutputBlock {
    /// Whether the evidence determines it.
    told: Option<bool>,
    /// `null` where the run before the evidence has not converged.
    prior: Option<PriorBlock>,
    median: Option<f64>,
    interval50: Option<[f64; 2]>,
    interval80: Option<[f64; 2]>,
    interval90: Option<[f64; 2]>,
    interval95: Option<[f64; 2]>,
    mean: Option<f64>,
    sd: Option<f64>,
    /// Standard errors due to the sampling.
    standard_error: Option<ErrorBlock>,
    /// If somebody was seriously hurt; `null` if another prior was asked for, or too few draws lead there.
    if_serious_injury: Option<PriorBlock>,
}

#[derive(Serialize)]
struct PriorBlock {
    median: f64,
    interval95: [f64; 2],
}

#[derive(Serialize)]
struct ErrorBlock {
    median: Option<f64>,
    interval95: [Option<f64>; 2],
    mean: Option<f64>,
    sd: Option<f64>,
}

/// The probability that a result is above the limit.
#[derive(Serialize)]
struct QuestionBlock {
    output: String,
    above: f64,
    probability: Option<f64>,
    standard_error: Option<f64>,
}

/// The speeds of vehicle 1 and 2 by a piece alone, and without it. `null` if that was not asked for or has
/// not converged.
#[derive(Serialize)]
struct PieceBlock<'a> {
    key: &'a str,
    alone: Option<[Option<PriorBlock>; 2]>,
    without: Option<[Option<PriorBlock>; 2]>,
    p_value: Option<f64>,
    /// The p-value after Holm's correction, which decides the verdict.
    adjusted_p_value: Option<f64>,
    /// Whether it points the other way than the rest says.
    reversed: bool,
    verdict: Option<&'static str>,
}

/// Real collisions on which intervals were judged.
#[derive(Serialize)]
struct TestedBlock {
    code: &'static str,
    collisions: &'static str,
    quantity: &'static str,
    n: u32,
    inside95: f64,
    rms: Option<f64>,
    source: &'static str,
}

impl TestedBlock {
    fn of(class: &TestedClass) -> Self {
        let TestedClass { code, collisions, quantity, n, inside95, rms, source } = *class;
        Self { code, collisions, quantity, n, inside95, rms, source }
    }
}

/// How the crush energy of a vehicle was obtained, and its error in ln.
#[derive(Serialize)]
struct CrushBlock {
    method: &'static str,
    bias: f64,
    shared_sd: f64,
    own_sd: f64,
}

impl CrushBlock {
    fn of(method: EnergyMethod, error: &EnergyError, shared_sd: f64) -> Self {
        let method = match method {
            EnergyMethod::Class => "class",
            EnergyMethod::Coefficients => "coefficients",
            EnergyMethod::Test => "test",
            EnergyMethod::Ees => "ees",
            EnergyMethod::OfObject => "object",
        };
        Self { method, bias: error.bias, shared_sd, own_sd: error.own_ln_sd }
    }
}

/// How probable it is that a vehicle stood: as assumed, of the collisions that are possible before the
/// evidence, and after it.
#[derive(Serialize)]
struct StoodBlock {
    assumed: f64,
    prior: Option<f64>,
    probability: Option<f64>,
}

impl StoodBlock {
    fn of(stood: Stood, is_answer: bool) -> Self {
        let Stood { assumed, before, after } = stood;
        Self {
            assumed,
            prior: before.map(|before| before.value),
            probability: is_answer.then_some(after.value),
        }
    }
}

#[derive(Serialize)]
struct UnknownBlock {
    key: String,
    /// Whether its prior is assumed, because the case does not give it.
    assumed: bool,
    prior: DistributionBlock,
    posterior: Option<PosteriorBlock>,
}

#[derive(Serialize)]
struct DistributionBlock {
    distribution: &'static str,
    mean: f64,
    sd: f64,
}

#[derive(Serialize)]
struct PosteriorBlock {
    median: f64,
    interval95: [f64; 2],
    mean: f64,
    sd: f64,
}

#[derive(Serialize)]
struct UnusedBlock<'a> {
    key: &'a str,
    reason: &'static str,
}

impl PriorBlock {
    fn of(summary: &DrawsSummary) -> Self {
        Self { median: summary.median.value, interval95: ends(summary, WIDEST) }
    }
}

impl OutputBlock {
    fn of(output: &EstimatedOutput, is_answer: bool) -> Self {
        let answer = is_answer.then_some(&output.posterior);
        let level = |place: usize| answer.map(|summary| ends(summary, place));
        let error = |estimate: Estimate| estimate.standard_error;
        Self {
            told: is_answer.then(|| output.is_told()),
            prior: output.prior.as_ref().map(PriorBlock::of),
            median: answer.map(|summary| summary.median.value),
            interval50: level(HALF),
            interval80: level(EIGHTY),
            interval90: level(NINETY),
            interval95: level(WIDEST),
            mean: answer.map(|summary| summary.mean.value),
            sd: answer.map(|summary| summary.sd.value),
            standard_error: answer.map(|summary| ErrorBlock {
                median: error(summary.median),
                interval95: [summary.intervals[WIDEST].low, summary.intervals[WIDEST].high].map(error),
                mean: error(summary.mean),
                sd: error(summary.sd),
            }),
            if_serious_injury: output.if_injured.as_ref().filter(|_| is_answer).map(PriorBlock::of),
        }
    }
}

impl QuestionBlock {
    fn of(question: &Question, estimated: &Estimated, is_answer: bool) -> Self {
        let answer = estimated.probability_above(question.output, question.limit).filter(|_| is_answer);
        Self {
            output: question.output.path(),
            above: question.limit,
            probability: answer.map(|probability| probability.value),
            standard_error: answer.and_then(|probability| probability.standard_error),
        }
    }
}

impl<'a> PieceBlock<'a> {
    fn of(piece: &'a PieceFound, agreement: Option<(Agreement, f64)>) -> Self {
        let speeds = |speeds: &Option<[Option<DrawsSummary>; 2]>| {
            speeds.as_ref().map(|speeds| speeds.each_ref().map(|speed| speed.as_ref().map(PriorBlock::of)))
        };
        Self {
            key: &piece.key,
            alone: speeds(&piece.alone),
            without: speeds(&piece.without),
            p_value: piece.p_value.map(|p| p.value),
            adjusted_p_value: agreement.map(|(_, adjusted)| adjusted),
            reversed: piece.reversed,
            verdict: agreement.map(|(agreement, _)| agreement.name()),
        }
    }
}

impl UnknownBlock {
    fn of(unknown: &UnknownNumber, is_answer: bool) -> Self {
        let factor = factor(unknown);
        let summary = &unknown.posterior;
        Self {
            key: unknown_key(unknown),
            assumed: unknown.assumed.is_some(),
            prior: DistributionBlock {
                distribution: distribution_name(&unknown.prior),
                mean: unknown.prior.mean() * factor,
                sd: unknown.prior.sd() * factor,
            },
            posterior: is_answer.then(|| PosteriorBlock {
                median: summary.median.value * factor,
                interval95: ends(summary, WIDEST).map(|end| end * factor),
                mean: summary.mean.value * factor,
                sd: summary.sd.value * factor,
            }),
        }
    }
}

fn distribution_name(distribution: &Distribution) -> &'static str {
    match distribution.shape() {
        Shape::Normal { .. } => "normal",
        Shape::LogNormal { .. } => "log-normal",
        Shape::Uniform { .. } => "uniform",
        Shape::Triangular { .. } => "triangular",
        _ => "other",
    }
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
    let doubt = |doubt: &SamplerDoubt| DoubtBlock { code: doubt_code(doubt), key: doubted(doubt, estimated) };
    let outputs = estimated.outputs.iter();
    pretty(&identified(
        file,
        Document {
            title: title(&file.case),
            axes: file.case.axes.name(),
            prior: estimated.prior.name(),
            seed: asked.plan.seed,
            particles: asked.plan.particles,
            draws: estimated.posterior.count(),
            converged: is_answer,
            doubts: doubts.iter().map(doubt).collect(),
            missed: &estimated.missed,
            ess: estimated.ess(),
            outputs: InOrder(
                outputs.map(|output| (output.output.path(), OutputBlock::of(output, is_answer))).collect(),
            ),
            questions: asked
                .questions
                .iter()
                .map(|question| QuestionBlock::of(question, estimated, is_answer))
                .collect(),
            pieces: estimated
                .pieces
                .iter()
                .zip(Agreement::of_all(&estimated.pieces))
                .map(|(piece, agreement)| PieceBlock::of(piece, agreement))
                .collect(),
            crush: estimated.observed.crush.map(|CrushErrors(errors)| {
                VehicleId::ALL.map(|id| {
                    let method = estimated.energies[id.index()]?;
                    let shared_sd = estimated.observed.shared_ln_sd(id)?;
                    Some(CrushBlock::of(method, &errors[id.index()], shared_sd))
                })
            }),
            tested: estimated.tested.map(TestedBlock::of),
            stood: estimated.stood.map(|stood| stood.map(|stood| StoodBlock::of(stood, is_answer))),
            same_twice: estimated.same_twice.iter().map(|same| &same.keys).collect(),
            unknown: estimated.unknown.iter().map(|unknown| UnknownBlock::of(unknown, is_answer)).collect(),
            default_errors: &estimated.default_errors,
            unused: estimated
                .unused
                .iter()
                .map(|one| UnusedBlock { key: &one.key, reason: unused(one.reason)[0] })
                .collect(),
            warnings: estimated
                .warnings
                .iter()
                .map(|warning| WarningBlock::new(&warning.seen(file.case.axes)))
                .collect(),
        },
    ))
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
