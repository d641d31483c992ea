//! The headline of a reconstruction as JSON, in SI units.

use ::estimate::DrawsSummary;
use analysis::quantities::{DELTA_V, SPEED};
use analysis::{Agreement, Analysis, Output, Overdetermined, Solution, Weighed};
use pim_core::VehicleId;
use serde::Serialize;

use crate::estimates::{WIDEST, ends};
use crate::words;

/// The answer of a case.
#[derive(Serialize)]
pub(crate) struct HeadlineBlock {
    /// `exact`, `estimate`, or `none` if the case has more evidence than an exact solution uses and it was
    /// not weighed, or if the run did not converge.
    by: &'static str,
    /// Why the exact solution is not the answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    why_not_exact: Option<WhyBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    converged: Option<bool>,
    /// Evidence that all the rest contradicts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    contradicting: Vec<String>,
    /// Evidence that the rest makes doubtful.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    doubtful: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vehicle1: Option<FiguresBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vehicle2: Option<FiguresBlock>,
}

#[derive(Serialize)]
struct WhyBlock {
    left_aside: Vec<String>,
    refuted_by: Vec<&'static str>,
    contradicted: bool,
    /// The average share of the impact's energy that its crush energies show, if it does not correct them.
    energy_share: Option<f64>,
}

#[derive(Serialize)]
struct FiguresBlock {
    speed: FigureBlock,
    delta_v: FigureBlock,
}

#[derive(Serialize)]
struct FigureBlock {
    /// The exact solution, or the median.
    value: Option<f64>,
    /// By all the evidence, with its errors and those of the method.
    #[serde(skip_serializing_if = "Option::is_none")]
    interval95: Option<[f64; 2]>,
}

/// The solution by a part of the evidence, taken as exact.
#[derive(Serialize)]
pub(crate) struct SolutionBlock {
    by: &'static str,
    speeds: [Option<f64>; 2],
    delta_v: [Option<f64>; 2],
    /// Speeds and ΔV outside of the 95 % interval by all the evidence.
    outside: Vec<String>,
    /// Speeds that differ from those of the case.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    differs_from_given: Vec<String>,
    /// The codes of its checks that fail.
    failed: Vec<&'static str>,
}

impl WhyBlock {
    fn of(why: &Overdetermined) -> Self {
        Self {
            left_aside: why.left_aside.clone(),
            refuted_by: why.refuted_by.iter().map(|check| check.code()).collect(),
            contradicted: why.is_contradicted,
            energy_share: why.energy_share,
        }
    }
}

impl HeadlineBlock {
    /// For a reconstruction; `None` for any other analysis.
    pub(crate) fn of(analysis: &Analysis, weighed: Option<&Weighed>) -> Option<Self> {
        if analysis.found.is_none() && analysis.both.is_none() {
            return None;
        }
        let moving = |of: &dyn Fn(VehicleId) -> FiguresBlock| {
            VehicleId::ALL.map(|id| analysis.moves(id).then(|| of(id)))
        };
        if let Some(weighed) = weighed {
            let figure = |output: Output| {
                let summary: Option<&DrawsSummary> = weighed.summary(output).filter(|_| weighed.is_answer());
                FigureBlock {
                    value: summary.map(|summary| summary.median.value),
                    interval95: summary.map(|summary| ends(summary, WIDEST)),
                }
            };
            let of = |vehicle: VehicleId| FiguresBlock {
                speed: figure(SPEED.of_vehicle(vehicle)),
                delta_v: figure(DELTA_V.of_vehicle(vehicle)),
            };
            let [vehicle1, vehicle2] = moving(&of);
            return Some(Self {
                by: if weighed.is_answer() { "estimate" } else { "none" },
                why_not_exact: Some(WhyBlock::of(&weighed.why)),
                converged: Some(weighed.estimated.doubts().is_empty()),
                contradicting: weighed.estimated.with_agreement(Agreement::Contradicts),
                doubtful: weighed.estimated.with_agreement(Agreement::Doubtful),
                vehicle1,
                vehicle2,
            });
        }
        let why = analysis.overdetermined();
        let exactly = |value: f64| FigureBlock { value: Some(value + 0.0), interval95: None };
        let delta_v = analysis.delta_v();
        let of = |vehicle: VehicleId| FiguresBlock {
            speed: exactly(analysis.speed(vehicle)),
            delta_v: exactly(delta_v[vehicle.index()]),
        };
        let [vehicle1, vehicle2] = if why.is_none() { moving(&of) } else { [None, None] };
        Some(Self {
            by: if why.is_none() { "exact" } else { "none" },
            why_not_exact: why.as_ref().map(WhyBlock::of),
            converged: None,
            contradicting: Vec::new(),
            doubtful: Vec::new(),
            vehicle1,
            vehicle2,
        })
    }
}

impl SolutionBlock {
    pub(crate) fn all(weighed: Option<&Weighed>) -> Vec<Self> {
        weighed.iter().flat_map(|weighed| &weighed.solutions).map(Self::of).collect()
    }

    fn of(solution: &Solution) -> Self {
        let [speeds, changes] = solution.outside;
        let named = |of: [bool; 2], key: &str| {
            let outside = VehicleId::ALL.into_iter().filter(move |id| of[id.index()]);
            outside.map(|id| format!("vehicle{}.{key}", id.number())).collect::<Vec<_>>()
        };
        Self {
            by: words::solution(solution.by),
            speeds: solution.speeds,
            delta_v: solution.delta_v,
            outside: [named(speeds, "speed"), named(changes, "delta_v")].concat(),
            differs_from_given: named(solution.differs_from.map(|given| given.is_some()), "speed"),
            failed: solution.failed.iter().map(|check| check.code()).collect(),
        }
    }
}
