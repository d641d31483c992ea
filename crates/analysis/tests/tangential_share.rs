//! A share of the tangential work in the crush energy, from the case file to every analysis.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::ops::ControlFlow;

use analysis::{
    Analysis, CheckedQuantity, Output, Plan, Sweep, impact, reconstruct, sensitivity, uncertainty, work_curve,
};
use case::CaseFile;
use inputs::Case;
use pim_core::VehicleId;
use uncertainty::{SamplingMethod, Settings};

const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");
const SHARE: &str = "reconstruct.energy_basis.tangential_share";

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case
}

/// The paper's example on another energy basis.
fn with_basis(basis: &str) -> String {
    let (before, after) = PAPER.split_once("\"dissipated\"").unwrap();
    format!("{before}{basis}{after}")
}

fn with_share(share: f64) -> Case {
    read(&with_basis(&format!("{{ tangential_share = {share:?} }}")))
}

fn speed(analysis: &Analysis) -> f64 {
    analysis.found.as_ref().unwrap().speed
}

#[test]
fn the_impact_takes_the_crush_energy_with_its_share() {
    for share in [0.0, 0.25, 0.5, 1.0] {
        let analysis = reconstruct(&with_share(share)).unwrap();
        let energy = analysis.impact.as_ref().unwrap().outcome.energy;
        let crush = analysis.found.as_ref().unwrap().crush_energy;
        let taken = energy.normal_work + share * energy.tangential_work;
        assert!((taken / crush - 1.0).abs() < 1e-12, "{share}: {taken} of {crush}");
    }
    let [without, paper] = [with_share(0.0), read(PAPER)].map(|case| speed(&reconstruct(&case).unwrap()));
    assert_eq!(without, paper);
}

/// The derivative by a share of zero is not lost with the term that the share multiplies.
#[test]
fn the_derivative_by_a_share_of_zero_is_that_of_the_speeds_above_it() {
    let step = 1e-4;
    let [f0, f1, f2] = [0.0, step, 2.0 * step].map(|share| speed(&reconstruct(&with_share(share)).unwrap()));
    // f′(0) = (−3 f(0) + 4 f(h) − f(2h))/2h + O(h²)
    let expected = (4.0 * f1 - 3.0 * f0 - f2) / (2.0 * step);
    let sweep = Sweep { step: 0.1, steps: 0 };
    let found = sensitivity(&with_share(0.0), sweep).unwrap();
    let of_speed = |row: &&analysis::Derivative| {
        row.output == Output::Speed { vehicle: VehicleId::One } && row.input.path == SHARE
    };
    let derivative = found.derivatives.iter().find(of_speed).unwrap().value;
    assert!(expected < -1.0, "{expected}");
    assert!((derivative / expected - 1.0).abs() < 1e-6, "{derivative} is not {expected}");
}

#[test]
fn a_range_of_the_share_spans_the_speeds_of_its_ends() {
    let case = read(&with_basis("{ tangential_share = { low = 0.2, high = 0.8 } }"));
    let plan = Plan { settings: Settings::new(SamplingMethod::MonteCarlo, 512, 1), index_rows: None };
    let result = uncertainty(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
    assert_eq!(result.inputs.len(), 1);
    assert_eq!(result.inputs[0].input.path, SHARE);
    let place = result
        .outputs
        .iter()
        .position(|other| other.output == Output::Speed { vehicle: VehicleId::One })
        .unwrap();
    let summary = result.propagation.summaries()[place].as_ref().unwrap();
    // The speed falls as the share grows: the quantiles of the one are the speeds at those of the other.
    let [at_0_2, at_0_8] = [0.2, 0.8].map(|share| speed(&reconstruct(&with_share(share)).unwrap()));
    let interval = summary.intervals.iter().find(|interval| interval.level == 0.95).unwrap();
    let (low, high) = (interval.low.value, interval.high.value);
    let width = at_0_2 - at_0_8;
    assert!(at_0_8 < low && low < at_0_8 + 0.05 * width, "{low} from {at_0_8}");
    assert!(at_0_2 - 0.05 * width < high && high < at_0_2, "{high} to {at_0_2}");
}

#[test]
fn the_curve_meets_what_is_sought_at_the_speed_found() {
    let case = with_share(0.5);
    let found = reconstruct(&case).unwrap().found.unwrap();
    let curve = work_curve(&case, &found, 2_000).unwrap();
    let above = curve.iter().position(|point| point.crush_work > point.sought).unwrap();
    assert!(curve[above - 1].speed <= found.speed.max(curve[above].speed));
    let (a, b) = (curve[above - 1], curve[above]);
    let (low, high) = (a.speed.min(b.speed), a.speed.max(b.speed));
    assert!((low..=high).contains(&found.speed), "{} is not in {low} … {high}", found.speed);
    assert!(curve.iter().all(|point| (point.sought - found.crush_energy).abs() < 1e-6));
}

/// With both speeds known, the crush energy is held against the same sum.
#[test]
fn a_check_holds_the_share_too() {
    let found = speed(&reconstruct(&with_share(0.5)).unwrap());
    let both = |basis: &str| {
        let text = with_basis(basis).replace("[vehicle1]", &format!("[vehicle1]\nspeed = \"{found:?} m/s\""));
        let analysis = impact(&read(&text)).unwrap();
        let is_energy =
            |check: &&analysis::Check| matches!(check.quantity, CheckedQuantity::DamageEnergy { .. });
        analysis.checks.iter().find(is_energy).unwrap().value
    };
    let share = both("{ tangential_share = 0.5 }");
    assert!(share < 1e-12, "{share}");
    let without = both("\"dissipated\"");
    assert!(without > 0.1, "{without}");
}
