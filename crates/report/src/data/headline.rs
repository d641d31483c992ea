//! The headline of a reconstruction as JSON, in SI units.

use analysis::quantities::{DELTA_V, SPEED};
use analysis::{Agreement, Analysis, Output, Solution, Weighed, WhyNotExact};
use pim_core::VehicleId;
use serde_json::{Value, json};

use super::{list, object};
use crate::estimates::{WIDEST, ends};
use crate::words;

/// The headline of a reconstruction: `exact` or `estimate`; `none` if an exact solution is not the answer and
/// the evidence was not weighed, or gave no answer.
#[must_use]
pub fn led_by(weighed: Option<&Weighed>, why_not_exact: Option<&WhyNotExact>) -> &'static str {
    match (weighed, why_not_exact) {
        (Some(weighed), _) if weighed.is_answer() => "estimate",
        (None, None) => "exact",
        _ => "none",
    }
}

/// The answer of a reconstruction; `None` for any other analysis.
pub(crate) fn headline(analysis: &Analysis, weighed: Option<&Weighed>) -> Option<Value> {
    if !analysis.is_reconstruction() {
        return None;
    }
    let why = weighed.map(|weighed| weighed.why.clone()).or_else(|| analysis.why_not_exact());
    let agreement = |of: Agreement| weighed.map(|weighed| weighed.estimated.with_agreement(of));
    let figure = |output: Output, exact: f64| {
        let Some(weighed) = weighed else { return json!({ "value": exact + 0.0 }) };
        let summary = weighed.summary(output).filter(|_| weighed.is_answer());
        // By all the evidence, with its errors and those of the method.
        let interval = summary.map(|summary| ends(summary, WIDEST));
        let median = summary.map(|summary| summary.median.value);
        object! { "value": median, "interval95"?: interval }
    };
    let delta_v = analysis.delta_v();
    let of_vehicle = |id: VehicleId| {
        let has_figures = analysis.moves(id) && (weighed.is_some() || why.is_none());
        has_figures.then(|| {
            json!({
                "speed": figure(SPEED.of_vehicle(id), analysis.speed(id)),
                "delta_v": figure(DELTA_V.of_vehicle(id), delta_v[id.index()]),
            })
        })
    };
    Some(object! {
        "by": led_by(weighed, why.as_ref()),
        "why_not_exact"?: why.as_ref().map(reasons),
        "converged"?: weighed.map(|weighed| weighed.estimated.doubts().is_empty()),
        // Evidence that all the rest contradicts, and that it makes doubtful.
        "contradicting"?: agreement(Agreement::Contradicts),
        "doubtful"?: agreement(Agreement::Doubtful),
        "vehicle1"?: of_vehicle(VehicleId::One),
        "vehicle2"?: of_vehicle(VehicleId::Two),
    })
}

fn reasons(why: &WhyNotExact) -> Value {
    object! {
        "left_aside": why.left_aside,
        "refuted_by": list(&why.refuted_by, |check| check.code()),
        "contradicted": why.is_contradicted,
        // The average share of the impact's energy that its crush energies show, if it does not correct them:
        // that by category if there are two.
        "energy_share"?: why.energies_shown.first().map(|shown| shown.share),
        // Whether it takes an upper bound of the crush energy for the energy.
        "takes_bound": why.takes_bound,
        // The vehicles that it has move backward so slowly that they are likely to have stood.
        "nearly_stood": list(&why.nearly_stood, |vehicle| format!("vehicle{vehicle}")),
    }
}

/// The solution by a part of the evidence, taken as exact.
pub(crate) fn solution(solution: &Solution) -> Value {
    let [speeds, changes] = solution.outside;
    let named = |of: [bool; 2], key: &str| {
        let named = VehicleId::ALL.into_iter().filter(|id| of[id.index()]);
        list(named, |id| format!("vehicle{id}.{key}"))
    };
    let outside = [named(speeds, "speed"), named(changes, "delta_v")].concat();
    object! {
        "by": words::solution(solution.by),
        "speeds": solution.speeds,
        "delta_v": solution.delta_v,
        // Speeds and ΔV outside of the 95 % interval by all the evidence.
        "outside": outside,
        // Speeds that differ from those of the case.
        "differs_from_given"?: named(solution.differs_from.map(|given| given.is_some()), "speed"),
        // The codes of its checks that fail.
        "failed": list(&solution.failed, |check| check.code()),
    }
}
