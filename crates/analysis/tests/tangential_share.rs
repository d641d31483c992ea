//! A share of the tangential work in the crush energy, from the case file to every analysis.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::ops::ControlFlow;

use analysis::quantities::SPEED;
use analysis::{
    Analysis, CheckedQuantity, Derivative, Plan, Sweep, compare, impact, reconstruct, sensitivity,
    uncertainty, work_curve,
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
    let of_speed =
        |row: &&Derivative| row.output == SPEED.of_vehicle(VehicleId::One) && row.input.path == SHARE;
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
    let place =
        result.outputs.iter().position(|other| other.output == SPEED.of_vehicle(VehicleId::One)).unwrap();
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

/// With both speeds known, the crush energy is compared with the same sum.
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

/// Labels exchanged, and in the axes of SAE J670: the same speed and the same derivative.
#[test]
fn neither_labels_nor_axes_change_the_answer() {
    let derivative = |text: &str, vehicle: VehicleId| {
        let found = sensitivity(&read(text), Sweep { step: 0.1, steps: 0 }).unwrap();
        let of_share = |row: &&Derivative| row.output == SPEED.of_vehicle(vehicle) && row.input.path == SHARE;
        found.derivatives.iter().find(of_share).unwrap().value
    };
    let text = with_basis("{ tangential_share = 0.4 }");
    let exchanged =
        text.replace("vehicle1", "vehicle0").replace("vehicle2", "vehicle1").replace("vehicle0", "vehicle2");
    let mut down = text.replacen("[vehicle1]", "[scene]\naxes = \"z-down\"\n[vehicle1]", 1);
    for (up, turned) in [
        ("\"180 deg\"", "\"-180 deg\""),
        ("\"67 deg\"", "\"-67 deg\""),
        ("\"-22.4 deg\"", "\"22.4 deg\""),
        ("\"-39 deg\"", "\"39 deg\""),
        ("\"-23 deg\"", "\"23 deg\""),
    ] {
        assert!(down.contains(up), "{up}");
        down = down.replace(up, turned);
    }
    let expected = (speed(&reconstruct(&read(&text)).unwrap()), derivative(&text, VehicleId::One));
    for (other, vehicle) in [(exchanged, VehicleId::Two), (down, VehicleId::One)] {
        let found = speed(&reconstruct(&read(&other)).unwrap());
        assert!((found / expected.0 - 1.0).abs() < 1e-12, "{found} is not {}", expected.0);
        let found = derivative(&other, vehicle);
        assert!((found / expected.1 - 1.0).abs() < 1e-9, "{found} is not {}", expected.1);
    }
}

/// Central differences of the speed with respect to the share.
#[test]
fn the_derivative_by_the_share_is_the_difference_in_the_limit() {
    let step = 1e-5;
    for share in [0.1, 0.5, 0.9] {
        let [low, high] =
            [share - step, share + step].map(|share| speed(&reconstruct(&with_share(share)).unwrap()));
        let found = sensitivity(&with_share(share), Sweep { step: 0.1, steps: 0 }).unwrap();
        let of_share =
            |row: &&Derivative| row.output == SPEED.of_vehicle(VehicleId::One) && row.input.path == SHARE;
        let derivative = found.derivatives.iter().find(of_share).unwrap().value;
        let expected = (high - low) / (2.0 * step);
        assert!((derivative / expected - 1.0).abs() < 1e-8, "{derivative} is not {expected}");
    }
}

/// A car that slides along a wall at 35° to its course, under a friction limit: the speed is
/// lower the more of the sliding shows in the damage.
#[test]
fn a_wall_takes_its_share_too() {
    let text = include_str!("../../../fixtures/barrier.toml")
        .replace("crush_plane = \"0 deg\"", "crush_plane = \"35 deg\"");
    let mut before = f64::INFINITY;
    for share in [0.0, 0.3, 1.0] {
        let basis = format!("{{ tangential_share = {share:?} }}");
        let analysis = reconstruct(&read(&text.replace("\"absorbed\"", &basis))).unwrap();
        let energy = analysis.impact.as_ref().unwrap().outcome.energy;
        let taken = energy.normal_work + share * energy.tangential_work;
        assert!((taken / analysis.found.as_ref().unwrap().crush_energy - 1.0).abs() < 1e-9, "{share}");
        assert!(energy.tangential_work > 0.1 * energy.normal_work, "{share}");
        let found = speed(&analysis);
        assert!(found < before, "{share}: {found} is not below {before}");
        before = found;
    }
}

/// Two cars on one line that meet at an angle of the plane: neither speed is known, both velocities after the
/// impact are.
fn both_speeds(basis: &str) -> String {
    let rests = include_str!("../../../fixtures/rear-end-rest.toml");
    let text = rests
        .replace("[surface]\nfriction = 0.7\n", "")
        .replace("[vehicle1.before]\nskid = { length = \"8 m\" }\n", "")
        .replace("crush_plane = \"178 deg\"", "crush_plane = \"155 deg\"")
        .replace(
            "drag = \"locked\"\nrest = { x = \"2.6 m\", y = \"0.1 m\", heading = \"2 deg\" }",
            "speed = \"8 m/s\"\ndirection = \"3 deg\"",
        )
        .replace(
            "drag = 0.25\nrest = { x = \"19.0 m\", y = \"0.3 m\", heading = \"-3 deg\" }",
            "speed = \"9 m/s\"\ndirection = \"-2 deg\"",
        );
    assert!(!text.contains("rest = ") && !text.contains("178"));
    format!("{text}energy_basis = {basis}\n")
}

#[test]
fn both_speeds_are_found_with_the_share() {
    let at = |share: f64| {
        let case = read(&both_speeds(&format!("{{ tangential_share = {share:?} }}")));
        let analysis = reconstruct(&case).unwrap();
        let energy = analysis.impact.as_ref().unwrap().outcome.energy;
        let crush: f64 = analysis.vehicles.iter().map(|vehicle| vehicle.crush_energy().unwrap()).sum();
        let taken = energy.normal_work + share * energy.tangential_work;
        assert!((taken / crush - 1.0).abs() < 1e-9, "{share}: {taken} of {crush}");
        assert!(energy.tangential_work > 0.05 * energy.normal_work);
        // The energy that the speeds need by `compare` is the one that was measured.
        let by = compare(&case).unwrap().evidence.unwrap();
        let needed = by.together.unwrap().crush_energy.unwrap();
        assert!(
            (needed / by.crush_energy.unwrap() - 1.0).abs() < 1e-9,
            "{share}: {needed} of {}",
            by.crush_energy.unwrap()
        );
        analysis.both.unwrap().speeds
    };
    let plain = reconstruct(&read(&both_speeds("\"dissipated\""))).unwrap().both.unwrap().speeds;
    assert_eq!(at(0.0), plain);
    let step = 1e-5;
    let [low, high] = [0.5 - step, 0.5 + step].map(at);
    let case = read(&both_speeds("{ tangential_share = { value = 0.5, sd = 0.1 } }"));
    let found = sensitivity(&case, Sweep { step: 0.1, steps: 0 }).unwrap();
    for (i, vehicle) in VehicleId::ALL.into_iter().enumerate() {
        let of_share = |row: &&Derivative| row.output == SPEED.of_vehicle(vehicle) && row.input.path == SHARE;
        let derivative = found.derivatives.iter().find(of_share).unwrap().value;
        let expected = (high[i] - low[i]) / (2.0 * step);
        assert!((derivative / expected - 1.0).abs() < 1e-6, "{derivative} is not {expected}");
    }
    let plan = Plan { settings: Settings::new(SamplingMethod::MonteCarlo, 256, 1), index_rows: None };
    let result = uncertainty(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
    assert!(result.inputs.iter().any(|input| input.input.path == SHARE));
}

/// Where the approaches cross, the crush energy is a check of momentum, and compared with the same sum.
#[test]
fn the_check_of_momentum_holds_the_share_too() {
    let check = |basis: &str| {
        // The second car comes from the right at 60°, and both leave between their courses.
        let text = both_speeds(basis).replace("\"3 deg\"", "\"18 deg\"").replace("\"-2 deg\"", "\"30 deg\"");
        let (one, two) = text.split_once("[vehicle2]").unwrap();
        let text =
            format!("{one}[vehicle2]{}", two.replacen("heading = \"0 deg\"", "heading = \"60 deg\"", 1));
        let analysis = reconstruct(&read(&text)).unwrap();
        let implied = analysis.both.as_ref().unwrap().implied;
        let found = analysis.checks.iter().find_map(|check| match check.quantity {
            CheckedQuantity::MomentumEnergy { normal_work, .. } => Some(normal_work),
            _ => None,
        });
        (found.unwrap(), implied.normal_work, implied.tangential_work)
    };
    let (held, normal, tangential) = check("{ tangential_share = 0.5 }");
    assert!((held - (normal + 0.5 * tangential)).abs() < 1e-9 * held.abs());
    assert!(tangential.abs() > 0.01 * normal.abs());
    let (held, normal, _) = check("\"dissipated\"");
    assert_eq!(held, normal);
}
