//! Speeds judged by recorders, as JSON: speeds in km/h.

use std::collections::BTreeMap;

use field::{DeltaVFigures, DoubtedRecord, JudgedDeltaV, JudgedRecord, Recorders, SpeedFigures};
use serde_json::{Value, json};

use super::field::{coverage, prior};
use super::{list, pretty};

/// (–) km/h in one m/s.
const KMH: f64 = 3.6;

fn speed(figures: &SpeedFigures) -> Value {
    let kmh = |speed: Option<f64>| speed.map(|speed| KMH * speed);
    let exact = figures.half_width_without.iter();
    let exact: BTreeMap<_, _> = exact.map(|(part, width)| (part.name(), KMH * width)).collect();
    json!({
        "n": figures.n,
        "bias": kmh(figures.bias),
        "rms": kmh(figures.rms),
        "coverage": figures.coverage.map(coverage),
        "half_width": kmh(figures.half_width),
        "half_width_if_exact": exact,
    })
}

/// Why a record is probably not of this impact.
pub(crate) fn doubt(record: &DoubtedRecord) -> String {
    format!(
        "its recorder stored a ΔV of {:.0} km/h, but the speeds of both recorders and one common velocity \
         after the impact imply {:.0} km/h: the record is probably not of this impact",
        KMH * record.stored,
        KMH * record.common
    )
}

fn judged(judged: &JudgedRecord) -> Value {
    let [interval50, interval80, interval95] = judged.intervals.map(|ends| ends.map(|end| KMH * end));
    json!({
        "case": judged.case,
        "vehicle": judged.vehicle.number(),
        "recorder": KMH * judged.recorded,
        "median": KMH * judged.median,
        "interval50": interval50,
        "interval80": interval80,
        "interval95": interval95,
        "converged": judged.converged,
    })
}

fn judged_delta_v(judged: &JudgedDeltaV) -> Value {
    json!({
        "case": judged.case,
        "vehicle": judged.vehicle.number(),
        "recorder": KMH * judged.truth.delta_v,
        "longitudinal": judged.truth.is_longitudinal,
        "common_velocity": KMH * judged.common,
        "median": KMH * judged.median,
    })
}

/// The judgement as JSON, speeds in km/h: `other_speed`, the speed of each vehicle by all evidence except its
/// own recorder, `delta_v_from_speeds`, by momentum to one common velocity, and `delta_v_by_estimate` (`bias`
/// and `rms` are of the logarithm), the rows that cannot be judged, the
/// records that are doubted, and every vehicle.
///
/// # Errors
/// If the JSON cannot be written.
pub fn judged_recorders_json(recorders: &Recorders) -> Result<String, serde_json::Error> {
    let delta_v = |DeltaVFigures { n, bias, rms }| json!({ "n": n, "bias": bias, "rms": rms });
    pretty(&json!({
        "rows": recorders.rows,
        "finished": recorders.finished,
        "prior": prior(recorders.injured),
        "other_speed": speed(&recorders.other_speed),
        "delta_v_from_speeds": delta_v(recorders.delta_v_from_speeds),
        "delta_v_by_estimate": delta_v(recorders.delta_v_by_estimate),
        "refused": list(&recorders.refused, |(case, reason)| json!({ "case": case, "reason": reason })),
        "doubted": list(&recorders.doubted, |record| json!({
            "case": record.case,
            "vehicle": record.vehicle.number(),
            "reason": doubt(record),
        })),
        "judged": list(&recorders.speeds, judged),
        "judged_delta_v": list(&recorders.delta_vs, judged_delta_v),
    }))
}
