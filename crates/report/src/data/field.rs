//! The judgement by recorders as JSON, in SI units.

use std::collections::BTreeMap;

use case::SeverityPrior;
use field::{Field, Figures, Judged, LEVELS};
use serde::Serialize;

use super::pretty;

#[derive(Serialize)]
struct Document<'a> {
    other: bool,
    objects: bool,
    prior: &'static str,
    pairs: usize,
    finished: usize,
    groups: BTreeMap<&'a str, FiguresBlock>,
    winsmash: BTreeMap<&'a str, FiguresBlock>,
    left_out: Vec<LeftOutBlock<'a>>,
    judged: Vec<JudgedBlock<'a>>,
}

#[derive(Serialize)]
struct LeftOutBlock<'a> {
    case: &'a str,
    vehicle: usize,
}

#[derive(Serialize)]
pub(super) struct FiguresBlock {
    n: usize,
    collisions: usize,
    bias: f64,
    bias_error: f64,
    rms: f64,
    rms_error: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    coverage: Option<BTreeMap<String, f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    coverage_error: Option<BTreeMap<String, f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    width95: Option<f64>,
    crps: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pit: Option<[usize; 10]>,
}

#[derive(Serialize)]
struct JudgedBlock<'a> {
    case: &'a str,
    vehicle: usize,
    kind: &'static str,
    recorder: f64,
    longitudinal: bool,
    median: f64,
    interval50: [f64; 2],
    interval80: [f64; 2],
    interval95: [f64; 2],
    below: f64,
    crps: f64,
    converged: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    winsmash: Option<f64>,
}

impl FiguresBlock {
    pub(super) fn of(figures: &Figures) -> Self {
        let level = |level: f64| format!("{:.0}", 100.0 * level);
        let part = |place: usize| {
            let coverage = figures.coverage?;
            Some(LEVELS.iter().zip(coverage).map(|(&at, part)| (level(at), part[place])).collect())
        };
        Self {
            n: figures.n,
            collisions: figures.collisions,
            bias: figures.bias[0],
            bias_error: figures.bias[1],
            rms: figures.rms[0],
            rms_error: figures.rms[1],
            coverage: part(0),
            coverage_error: part(1),
            width95: figures.width95,
            crps: figures.crps,
            pit: figures.pit,
        }
    }
}

impl<'a> JudgedBlock<'a> {
    fn of(judged: &'a Judged) -> Self {
        let [interval50, interval80, interval95] = judged.intervals;
        Self {
            case: &judged.case,
            vehicle: judged.vehicle.index() + 1,
            kind: judged.kind.name(),
            recorder: judged.truth.delta_v,
            longitudinal: judged.truth.is_longitudinal,
            median: judged.median,
            interval50,
            interval80,
            interval95,
            below: judged.below,
            crps: judged.crps,
            converged: judged.converged,
            winsmash: judged.winsmash,
        }
    }
}

/// The judgement as JSON: `groups` and `winsmash`, all, by kind of collision and of one event, each with `n`,
/// `bias`, `rms`, `coverage`, `width95` and `crps` (m/s), the records that are left out, and every vehicle.
///
/// # Errors
/// If the JSON cannot be written.
pub fn field_json(field: &Field) -> Result<String, serde_json::Error> {
    pretty(&Document {
        other: field.other,
        objects: field.objects,
        prior: if field.injured { SeverityPrior::SeriousInjury } else { SeverityPrior::Field }.name(),
        pairs: field.pairs,
        finished: field.finished,
        groups: field.groups.iter().map(|group| (group.name, FiguresBlock::of(&group.ours))).collect(),
        winsmash: field
            .groups
            .iter()
            .filter_map(|group| Some((group.name, FiguresBlock::of(group.winsmash.as_ref()?))))
            .collect(),
        left_out: field
            .doubted
            .iter()
            .map(|(case, vehicle)| LeftOutBlock { case, vehicle: vehicle.index() + 1 })
            .collect(),
        judged: field.judged.iter().map(JudgedBlock::of).collect(),
    })
}
