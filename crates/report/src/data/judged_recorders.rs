//! The judgement of speeds by recorders as JSON: speeds in km/h.

use std::collections::BTreeMap;

use field::{DeltaVFigures, DoubtedRecord, JudgedDeltaV, JudgedRecord, LEVELS, Recorders, SpeedFigures};
use serde::Serialize;

use super::field::prior;
use super::pretty;

/// (–) km/h in one m/s.
const KMH: f64 = 3.6;

#[derive(Serialize)]
struct Document<'a> {
    rows: usize,
    finished: usize,
    prior: &'static str,
    other_speed: SpeedBlock,
    delta_v_from_speeds: DeltaVBlock,
    delta_v_by_estimate: DeltaVBlock,
    refused: Vec<RefusedBlock<'a>>,
    doubted: Vec<DoubtedBlock<'a>>,
    judged: Vec<JudgedBlock<'a>>,
    judged_delta_v: Vec<JudgedDeltaVBlock<'a>>,
}

#[derive(Serialize)]
struct SpeedBlock {
    n: usize,
    bias: Option<f64>,
    rms: Option<f64>,
    coverage: Option<BTreeMap<String, f64>>,
    half_width: Option<f64>,
    half_width_if_exact: BTreeMap<&'static str, f64>,
}

#[derive(Serialize)]
struct DeltaVBlock {
    n: usize,
    bias: Option<f64>,
    rms: Option<f64>,
}

#[derive(Serialize)]
struct RefusedBlock<'a> {
    case: &'a str,
    reason: &'a str,
}

#[derive(Serialize)]
struct DoubtedBlock<'a> {
    case: &'a str,
    vehicle: usize,
    reason: String,
}

#[derive(Serialize)]
struct JudgedBlock<'a> {
    case: &'a str,
    vehicle: usize,
    recorder: f64,
    median: f64,
    interval50: [f64; 2],
    interval80: [f64; 2],
    interval95: [f64; 2],
    converged: bool,
}

#[derive(Serialize)]
struct JudgedDeltaVBlock<'a> {
    case: &'a str,
    vehicle: usize,
    recorder: f64,
    longitudinal: bool,
    common_velocity: f64,
    median: f64,
}

impl SpeedBlock {
    fn of(figures: &SpeedFigures) -> Self {
        let kmh = |speed: Option<f64>| speed.map(|speed| KMH * speed);
        let coverage = figures.coverage.map(|coverage| {
            LEVELS
                .iter()
                .zip(coverage)
                .map(|(level, share)| (format!("{:.0}", 100.0 * level), share))
                .collect()
        });
        let exact = figures.half_width_without.iter();
        Self {
            n: figures.n,
            bias: kmh(figures.bias),
            rms: kmh(figures.rms),
            coverage,
            half_width: kmh(figures.half_width),
            half_width_if_exact: exact.map(|(part, width)| (part.name(), KMH * width)).collect(),
        }
    }
}

impl<'a> DoubtedBlock<'a> {
    fn of(record: &'a DoubtedRecord) -> Self {
        let vehicle = record.vehicle.index() + 1;
        Self { case: &record.case, vehicle, reason: doubt(record) }
    }
}

/// Why a record is hardly of this impact.
pub(crate) fn doubt(record: &DoubtedRecord) -> String {
    format!(
        "its recorder stored a ΔV of {:.0} km/h, where the speeds of both recorders and one common velocity after the \
         impact ask for {:.0} km/h: the record is hardly of this impact",
        KMH * record.stored,
        KMH * record.common
    )
}

impl<'a> JudgedBlock<'a> {
    fn of(judged: &'a JudgedRecord) -> Self {
        let [interval50, interval80, interval95] = judged.intervals.map(|ends| ends.map(|end| KMH * end));
        Self {
            case: &judged.case,
            vehicle: judged.vehicle.index() + 1,
            recorder: KMH * judged.recorded,
            median: KMH * judged.median,
            interval50,
            interval80,
            interval95,
            converged: judged.converged,
        }
    }
}

impl<'a> JudgedDeltaVBlock<'a> {
    fn of(judged: &'a JudgedDeltaV) -> Self {
        Self {
            case: &judged.case,
            vehicle: judged.vehicle.index() + 1,
            recorder: KMH * judged.truth.delta_v,
            longitudinal: judged.truth.is_longitudinal,
            common_velocity: KMH * judged.common,
            median: KMH * judged.median,
        }
    }
}

/// The judgement as JSON, speeds in km/h: `other_speed`, of each vehicle by all evidence but its own
/// recorder, `delta_v_from_speeds`, by momentum to one common velocity, and `delta_v_by_estimate` (`bias` and
/// `rms` are of the logarithm), the rows that cannot be judged, the
/// records that are doubted, and every vehicle.
///
/// # Errors
/// If the JSON cannot be written.
pub fn judged_recorders_json(recorders: &Recorders) -> Result<String, serde_json::Error> {
    let delta_v = |DeltaVFigures { n, bias, rms }| DeltaVBlock { n, bias, rms };
    pretty(&Document {
        rows: recorders.rows,
        finished: recorders.finished,
        prior: prior(recorders.injured),
        other_speed: SpeedBlock::of(&recorders.other_speed),
        delta_v_from_speeds: delta_v(recorders.delta_v_from_speeds),
        delta_v_by_estimate: delta_v(recorders.delta_v_by_estimate),
        refused: recorders.refused.iter().map(|(case, reason)| RefusedBlock { case, reason }).collect(),
        doubted: recorders.doubted.iter().map(DoubtedBlock::of).collect(),
        judged: recorders.speeds.iter().map(JudgedBlock::of).collect(),
        judged_delta_v: recorders.delta_vs.iter().map(JudgedDeltaVBlock::of).collect(),
    })
}
