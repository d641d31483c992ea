//! Ranges through the equations: against exact answers, and against the same numbers written into a file.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

use std::ops::ControlFlow;

use analysis::quantities::{CRUSH_ENERGY, DELTA_V, EES, IMPACT_NORMAL_WORK, PDOF, SKID_SPEED, SPEED};
use analysis::{
    Doubt, Doubtful, ExactValue, Failure, Output, Plan, Reason, Sweep, Uncertainty, impact, reconstruct,
    sensitivity, uncertainty, uncertainty_of,
};
use case::{CaseFile, to_toml};
use inputs::Case;
use pim_core::VehicleId;
use uncertainty::{LANES, Lanes, Sampler, SamplingMethod, Settings, Shape};

const UNCERTAIN: &str = include_str!("../../../fixtures/sae-980025-uncertain.toml");

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case
}

fn plan(samples: usize) -> Plan {
    Plan { settings: Settings::new(SamplingMethod::MonteCarlo, samples, 1), index_rows: None }
}

fn run(text: &str, samples: usize) -> Uncertainty {
    uncertainty(&read(text), &plan(samples), &mut |_, _, _| ControlFlow::Continue(())).unwrap()
}

/// Place of an output.
fn place(result: &Uncertainty, output: Output) -> usize {
    result.outputs.iter().position(|other| other.output == output).unwrap()
}

/// The inputs of the first block of samples.
fn first_block(result: &Uncertainty) -> Vec<Lanes> {
    let distributions: Vec<_> = result.inputs.iter().map(|input| input.distribution).collect();
    let mut columns = vec![Lanes::ZERO; distributions.len()];
    Sampler::new(&distributions, &result.settings).unwrap().fill(0, &mut columns);
    columns
}

/// Two of the outputs, of a case that takes a block and of one that does not: each as in the run of all of
/// them, to the last bit, with the same failures and doubts.
#[test]
fn outputs_that_are_wanted_are_those_of_all() {
    let friction = UNCERTAIN.replace("\"critical\"", "{ friction = 0.5 }");
    assert_ne!(friction, UNCERTAIN);
    for text in [UNCERTAIN, &friction] {
        let all = run(text, 2000);
        let wanted = [DELTA_V.of_vehicle(VehicleId::Two), PDOF.of_vehicle(VehicleId::One)];
        let quietly = &mut |_, _, _| ControlFlow::Continue(());
        let some =
            uncertainty_of(&read(text), &plan(2000), &|output| wanted.contains(&output), quietly).unwrap();
        assert_eq!(some.outputs.iter().map(|known| known.output).collect::<Vec<_>>(), wanted);
        assert_eq!(some.propagation.summaries().len(), wanted.len());
        for (here, output) in wanted.into_iter().enumerate() {
            let there = place(&all, output);
            assert_eq!(some.propagation.columns()[here], all.propagation.columns()[there]);
            assert_eq!(some.propagation.summaries()[here], all.propagation.summaries()[there]);
            assert_eq!(some.outputs[here].first_order, all.outputs[there].first_order);
            assert_eq!(some.outputs[here].central, all.outputs[there].central);
        }
        assert_eq!(some.propagation.failures(), all.propagation.failures());
        assert_eq!(some.doubtful, all.doubtful);
        assert!(!all.doubtful.is_empty(), "no doubt to compare");

        let none = uncertainty_of(&read(text), &plan(2000), &|_| false, quietly).unwrap_err();
        assert!(matches!(none, Failure::Case(_)), "{none}");
    }
}

/// A vehicle of 1500 kg head-on into a barrier, its forward axis along −n.
const HEAD_ON: &str = r#"
[vehicle1]
mass = "1500 kg"
yaw_inertia = "2500 kg m^2"
heading = "180 deg"
contact = { x = "2 m", y = "0 m" }
speed = SPEED
[vehicle2]
fixed = true
[impact]
crush_plane = "0 deg"
restitution = 0.2
tangential = "critical"
"#;

fn head_on(speed: &str) -> String {
    HEAD_ON.replace("SPEED", speed)
}

#[test]
fn a_central_value_is_that_of_the_other_commands_to_the_last_bit() {
    let result = run(UNCERTAIN, 64);
    let found = reconstruct(&read(UNCERTAIN)).unwrap().found.unwrap().speed;
    assert_eq!(result.outputs[0].output, SPEED.of_vehicle(VehicleId::One));
    assert_eq!(result.outputs[0].central.to_bits(), found.to_bits());
    for (central, output) in result.tornado.central.as_ref().unwrap().iter().zip(&result.outputs) {
        assert_eq!(central.to_bits(), output.central.to_bits(), "{}", output.output.path());
    }
    let forward = head_on("{ value = \"20 m/s\", sd = \"1 m/s\" }");
    let delta_v = impact(&read(&forward)).unwrap().impact.unwrap().outcome.delta_v_magnitude()[0];
    let result = run(&forward, 64);
    assert_eq!(
        result.outputs[place(&result, DELTA_V.of_vehicle(VehicleId::One))].central.to_bits(),
        delta_v.to_bits()
    );
}

/// Every sample is the answer of `reconstruct` to a file with its numbers.
#[test]
fn a_sample_is_the_reconstruction_of_its_numbers() {
    let file = read(UNCERTAIN);
    let result = run(UNCERTAIN, 64);
    let block = first_block(&result);
    for lane in 0..LANES {
        let mut columns = block.iter();
        let mut paths = file.ranges.iter().map(|range| &range.path).peekable();
        let sample = file.map(|input| match paths.next_if(|path| **path == input.path) {
            Some(_) => columns.next().unwrap()[lane],
            None => input.number,
        });
        let written = read(&to_toml(&sample));
        assert!(written.ranges.is_empty());
        let found = reconstruct(&written).unwrap().found.unwrap().speed;
        assert_eq!(result.propagation.columns()[0][lane].to_bits(), found.to_bits(), "sample {lane}");
    }
}

/// ΔV = (1 + e) v, so that its distribution is the speed's, stretched.
#[test]
fn a_linear_case_comes_out_exactly() {
    let result = run(&head_on("{ value = \"20 m/s\", sd = \"1 m/s\" }"), 20_000);
    let at = place(&result, DELTA_V.of_vehicle(VehicleId::One));
    let output = &result.outputs[at];
    assert!((output.central - 24.0).abs() < 1e-12);
    assert!((output.first_order.sd - 1.2).abs() < 1e-12);
    let summary = result.propagation.summaries()[at].unwrap();
    assert!((summary.mean.value - 24.0).abs() < 4.0 * summary.mean.standard_error.unwrap());
    assert!((summary.sd.value - 1.2).abs() < 4.0 * summary.sd.standard_error.unwrap());
    // 95 %: μ ± 1.959 964 σ
    let interval = summary.intervals[2];
    for (end, exact) in [(interval.low, 24.0 - 1.959_964 * 1.2), (interval.high, 24.0 + 1.959_964 * 1.2)] {
        assert!((end.value - exact).abs() < 4.0 * end.standard_error.unwrap(), "{} {exact}", end.value);
    }
    // W_n = m v² (1 − e²)/2; dW_n/dv = m v (1 − e²) = 1500 · 20 · 0.96
    let work = &result.outputs[place(&result, IMPACT_NORMAL_WORK.of_collision())];
    assert!((work.first_order.sd / 28_800.0 - 1.0).abs() < 1e-12, "{}", work.first_order.sd);
    let paths: Vec<String> = result.outputs.iter().map(|output| output.output.path()).collect();
    assert_eq!(
        paths,
        [
            "vehicle1.delta_v",
            "vehicle1.pdof",
            "impact.closing_speed",
            "impact.energy_loss",
            "impact.normal_work",
            "impact.tangential_work",
            "vehicle1.delta_v_longitudinal",
            "vehicle1.delta_v_lateral"
        ]
    );
}

/// ΔV = 1.2 v, the speed in miles per hour, its deviation in those or in km/h: 1 mph is 0.447 04 m/s.
#[test]
fn ranges_are_in_their_own_units() {
    for (sd, si) in [("1 mph", 0.447_04), ("3.6 km/h", 1.0)] {
        let result = run(&head_on(&format!("{{ value = \"40 mph\", sd = \"{sd}\" }}")), 20_000);
        let at = place(&result, DELTA_V.of_vehicle(VehicleId::One));
        assert!((result.outputs[at].first_order.sd / (1.2 * si) - 1.0).abs() < 1e-12);
        let sampled = result.propagation.summaries()[at].unwrap().sd;
        assert!((sampled.value - 1.2 * si).abs() < 4.0 * sampled.standard_error.unwrap());
    }
}

/// A quarter of the speeds is backwards, away from the barrier.
#[test]
fn samples_without_an_answer_are_counted_by_reason() {
    let result = run(&head_on("{ low = \"-1 m/s\", high = \"3 m/s\" }"), 10_000);
    let failed = result.failed(Reason::NotApproaching);
    // √(n p (1 − p)) = 43.3
    assert!((2500.0 - failed as f64).abs() < 4.0 * 43.3, "{failed}");
    assert_eq!(result.propagation.succeeded(), 10_000 - failed);
    let columns = result.propagation.columns();
    let backwards = columns[0].iter().filter(|value| value.is_nan()).count();
    assert_eq!(backwards, failed);
    // The direction of force is 0 for each that approaches.
    assert!(columns[1].iter().all(|pdof| pdof.is_nan() || pdof.abs() < 1e-12));
}

/// A car at 10° to a wall whose contact point lies anywhere along its side. Far behind the CG, stopping that
/// point along the wall takes a pull at every speed.
#[test]
fn what_would_have_to_pull_at_every_speed_is_counted_so() {
    let case = include_str!("../../../fixtures/no-answer/not-reached.toml");
    assert!(case.contains("x = \"-2.0 m\""));
    let range = "x = { low = \"-2.5 m\", mode = \"2 m\", high = \"2.5 m\" }";
    let result = run(&case.replace("x = \"-2.0 m\"", range), 2000);
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let pulls = |x: f64| {
        let (along, across) = (x * cos - 0.8 * sin, x * sin + 0.8 * cos);
        // P_n ∝ k_tt (1 + e)|u_n| + k_nt u_t, with m k_tt = 1 + r_n²/k² and m k_nt = r_t r_n/k² in the sense
        // of u_t
        (1.0 + across * across / 2.25) * 1.1 * sin + along * across / 2.25 * cos <= 0.0
    };
    let distributions: Vec<_> = result.inputs.iter().map(|input| input.distribution).collect();
    let sampler = Sampler::new(&distributions, &result.settings).unwrap();
    let mut expected = 0;
    let mut left = 2000;
    for block in 0.. {
        let mut columns = vec![Lanes::ZERO; 1];
        sampler.fill(block, &mut columns);
        expected += columns[0].iter().take(left).filter(|x| pulls(**x)).count();
        if left <= LANES {
            break;
        }
        left -= LANES;
    }
    assert!(expected > 100, "{expected}");
    assert_eq!(result.failed(Reason::Pulling), expected);
    assert_eq!(result.failed(Reason::NoRoot), 0);
}

/// A twelfth of the speeds without damage, and a fifth of the limits, are such that no stiffness follows.
#[test]
fn a_stiffness_that_cannot_be_is_a_reason_of_its_own() {
    let barrier = include_str!("../../../fixtures/barrier.toml");
    let line = barrier.lines().find(|line| line.starts_with("stiffness")).unwrap();
    let failed = |stiffness: &str, reason| {
        let result = run(&barrier.replace(line, stiffness), 10_000);
        assert_eq!(result.failed(Reason::Other), 0, "{stiffness}");
        result.failed(reason) as f64
    };
    // From 6 to 60 km/h, those from 55.5 km/h on: a twelfth.
    let test = "stiffness = { test = { mass = \"1200 kg\", speed = \"55.5 km/h\", width = \"150 cm\", depths = \"46 48 46 cm\", \
                no_damage_speed = { low = \"6 km/h\", high = \"60 km/h\" } } }";
    // √(n p (1 − p)) = 27.6
    let failed_tests = failed(test, Reason::NoDamageSpeed);
    assert!((10_000.0 / 12.0 - failed_tests).abs() < 4.0 * 27.6, "{failed_tests}");
    // From 500 to 1500 N/cm, those below 700 N/cm: a fifth.
    let limit = "stiffness = { A = \"700 N/cm\", B = \"50 N/cm^2\", limit = { low = \"500 N/cm\", high = \"1500 N/cm\" } }";
    // √(n p (1 − p)) = 40
    let failed_limits = failed(limit, Reason::LimitBelowStart);
    assert!((2000.0 - failed_limits).abs() < 4.0 * 40.0, "{failed_limits}");
}

/// A vehicle with A and B as ranges: without G, each sample has G = A²/2B.
#[test]
fn g_follows_from_a_and_b_of_each_sample() {
    let barrier = include_str!("../../../fixtures/barrier.toml").replace("absorbed", "dissipated");
    let from = barrier.find("stiffness = {").unwrap();
    let line = barrier[from..].lines().next().unwrap();
    let ranges = "stiffness = { A = { low = \"300 N/cm\", high = \"600 N/cm\" }, B = { value = \"40 N/cm^2\", sd = \"4 N/cm^2\" } }";
    let text = barrier.replace(line, ranges);
    let result = run(&text, 64);
    let file = read(&text);
    let crush = file.vehicles[0].crush.as_ref().unwrap();
    let width = crush.width.unwrap().si();
    let depths: Vec<f64> = crush.depths.iter().map(case::Quantity::si).collect();
    let zones = depths.len() - 1;
    let block = first_block(&result);
    let work = place(&result, IMPACT_NORMAL_WORK.of_collision());
    for (lane, (a, b)) in block[0].iter().zip(&block[1]).enumerate() {
        // N/cm and N/cm²
        let (a, b) = (a * 100.0, b * 1e4);
        // ∫ (A C + B C²/2 + A²/2B) dw over trapezoids: ∫C = Δw (C + C')/2, ∫C² = Δw (C² + C C' + C'²)/3
        let step = width / zones as f64;
        let energy: f64 = depths
            .windows(2)
            .map(|pair| {
                let (c, d) = (pair[0], pair[1]);
                step * (a * (c + d) / 2.0 + b * (c * c + c * d + d * d) / 6.0 + a * a / (2.0 * b))
            })
            .sum();
        let value = result.propagation.columns()[work][lane];
        assert!((value / energy - 1.0).abs() < 1e-9, "{value} {energy}");
    }
}

#[test]
fn physics_cuts_what_cannot_be() {
    let text = UNCERTAIN.replace("5.3 4.8 in\", sd = \"0.5 in\"", "5.3 0.5 in\", sd = \"0.5 in\"");
    let result = run(&text, 64);
    let cut: Vec<_> =
        result.inputs.iter().filter(|input| input.truncation().is_some_and(|cut| cut.kept < 0.999)).collect();
    assert_eq!(cut.len(), 1);
    assert_eq!(cut[0].input.path, "vehicle1.crush.depths[6]");
    // Φ(1), Abramowitz & Stegun, table 26.1
    assert!((cut[0].truncation().unwrap().kept - 0.841_344_746_1).abs() < 1e-9);
    assert!(first_block(&result).iter().all(|column| column.iter().all(|value| value.is_finite())));
}

/// ±10 % with 95 %: σ = 0.1 μ/1.959 963 985 (Abramowitz & Stegun, table 26.5).
#[test]
fn a_share_with_a_confidence_becomes_a_deviation() {
    let result = run(UNCERTAIN, 64);
    let input = result.inputs.iter().find(|input| input.input.path == "vehicle1.yaw_inertia").unwrap();
    let Shape::Normal { mean, sd } = input.distribution.shape() else { panic!("{:?}", input.distribution) };
    assert_eq!(mean, 2437.0);
    assert!((sd / (243.7 / 1.959_963_985) - 1.0).abs() < 1e-9, "{sd}");
}

/// A number that the file gives for the speed sought is not an input.
#[test]
fn a_speed_that_is_sought_is_a_result_only() {
    let given =
        UNCERTAIN.replacen("contact ", "speed = { low = \"60 ft/s\", high = \"80 ft/s\" }\ncontact ", 1);
    assert_eq!(read(&given).ranges.len(), 32);
    let result = run(&given, 64);
    assert_eq!(result.inputs.len(), 31);
    assert_eq!(result.propagation.columns(), run(UNCERTAIN, 64).propagation.columns());
}

#[test]
fn what_makes_no_sense_is_refused() {
    let run = |text: &str, samples| {
        uncertainty(&read(text), &plan(samples), &mut |_, _, _| ControlFlow::Continue(()))
    };
    let error = run(include_str!("../../../fixtures/sae-980025.toml"), 64).unwrap_err();
    assert!(matches!(error, Failure::Case(_)), "{error}");
    assert!(error.to_string().contains("weight = { value = \"3696 lb\", within = \"5 %\""), "{error}");
    let error = run(UNCERTAIN, 0).unwrap_err();
    assert!(matches!(error, Failure::Ranges(_)), "{error}");
}

const CATEGORIES: &str = include_str!("../../../fixtures/t-bone-category.toml");

/// (m/s) the speed found with other categories: front of vehicle 1, side of vehicle 2.
fn with_categories(first: i32, second: i32) -> f64 {
    let text = CATEGORIES
        .replace("category = 4", &format!("category = {first}"))
        .replace("{ category = 2 }", &format!("{{ category = {second} }}"));
    reconstruct(&read(&text)).unwrap().found.unwrap().speed
}

/// The choice of a category may be off by one, for either vehicle or both. An interval that does not contain
/// those answers claims more than is known.
#[test]
fn the_interval_of_a_case_from_tables_contains_the_answers_of_the_neighbouring_categories() {
    let result = run(CATEGORIES, 20_000);
    let [_, _, interval, _] = result.propagation.summaries()[0].unwrap().intervals;
    assert_eq!(interval.level, 0.95);
    for first in 3..=5 {
        for second in 1..=3 {
            let speed = with_categories(first, second);
            let [low, high] = [interval.low.value, interval.high.value];
            assert!(low < speed && speed < high, "{first}, {second}: {speed} is not in {low} to {high}");
        }
    }
}

/// The case with A, B, G and k of both vehicles written out, each vehicle with a factor on A and one on k.
/// The numbers are those of SAE 870045, Tables 1 and 2.
fn written_out([a1, k1, a2, k2]: [f64; 4]) -> String {
    let stiffness = |[a, b, g]: [f64; 3], factor: f64| {
        // ln A and ln B are normal with 0.38 and 0.59, and of the same z.
        let z = factor.ln() / 0.38;
        let (a_new, b_new) = (a * (0.38 * z).exp(), b * (0.59 * z).exp());
        // G is A²/2B, as far as the table has it so.
        let g_new = g * (a_new * a_new / b_new) / (a * a / b);
        format!("{{ A = \"{a_new} lb/in\", B = \"{b_new} lb/in^2\", G = \"{g_new} lb\" }}")
    };
    CATEGORIES
        .replace("{ category = 4 }", &stiffness([356.0, 34.0, 1874.0], a1))
        .replace("{ category = 2 }", &stiffness([140.0, 67.0, 148.0], a2))
        .replace("class   = 4", &format!("yaw_radius = \"{} in\"", 3741.0_f64.sqrt() * k1))
        .replace("class   = 3", &format!("yaw_radius = \"{} in\"", 3324.0_f64.sqrt() * k2))
}

/// Sample by sample, the same with the stiffness of the fleet: docs/theory.md, section 9. A = 1000 b₀ b₁, B =
/// 1000 b₁² with b₀ = 2.22 m/s and b₁ = 27.7 1/s of a front, 1.58 and 31.1 of a side.
#[test]
fn a_spread_of_the_fleet_is_a_factor_on_its_stiffness() {
    let fleet = CATEGORIES.replace("{ category = 4 }", "\"fleet\"").replace("{ category = 2 }", "\"fleet\"");
    let result = run(&fleet, 64);
    let columns = first_block(&result);
    for lane in [0, 5, 31, 63] {
        let [speed, a1, k1, a2, k2] = [0, 1, 2, 3, 4].map(|input| columns[input][lane]);
        let stiffness = |factor: f64, [b0, b1]: [f64; 2]| {
            let z = factor.ln() / 0.40;
            let (a, b) = (1000.0 * b0 * b1 * (0.40 * z).exp(), 1000.0 * b1 * b1 * (0.30 * z).exp());
            format!("stiffness = {{ A = \"{a} N/m\", B = \"{b} N/m^2\" }}")
        };
        let text = fleet
            .replacen("stiffness = \"fleet\"", &stiffness(a1, [2.22, 27.7]), 1)
            .replacen("stiffness = \"fleet\"", &stiffness(a2, [1.58, 31.1]), 1)
            .replace("class   = 4", &format!("yaw_radius = \"{} in\"", 3741.0_f64.sqrt() * k1))
            .replace("class   = 3", &format!("yaw_radius = \"{} in\"", 3324.0_f64.sqrt() * k2))
            .replace("{ value = \"25 mph\", sd = \"1.5 mph\" }", &format!("\"{speed} mph\""));
        let expected = reconstruct(&read(&text)).unwrap().found.unwrap().speed;
        let found = result.propagation.columns()[0][lane];
        assert!((found / expected - 1.0).abs() < 1e-9, "{lane}: {found} {expected}");
    }
}

/// Sample by sample: the spread of a table has the same effect as the same numbers given in the file.
#[test]
fn a_spread_of_a_table_is_a_factor_on_what_the_table_gives() {
    let result = run(CATEGORIES, 64);
    let paths: Vec<&str> = result.inputs.iter().map(|input| input.input.path.as_str()).collect();
    let factors = [
        "vehicle1.crush.stiffness.factor",
        "vehicle1.yaw_radius.factor",
        "vehicle2.crush.stiffness.factor",
        "vehicle2.yaw_radius.factor",
    ];
    assert_eq!(paths[0], "vehicle2.speed");
    assert_eq!(paths[1..], factors);
    for (input, shape) in [
        (1, Shape::LogNormal { median: 1.0, ln_sd: 0.38 }),
        // ±15 % at 95 %: 0.15/1.959964
        (2, Shape::Normal { mean: 1.0, sd: 0.076_532_019 }),
    ] {
        let sd = |shape| match shape {
            Shape::LogNormal { ln_sd, .. } => ln_sd,
            Shape::Normal { sd, .. } => sd,
            _ => f64::NAN,
        };
        let found = result.inputs[input].distribution.shape();
        assert!((sd(found) - sd(shape)).abs() < 1e-8, "{found:?}");
    }
    let columns = first_block(&result);
    let speed = |text: &str| reconstruct(&read(text)).unwrap();
    assert!((result.outputs[0].central / speed(CATEGORIES).found.unwrap().speed - 1.0).abs() < 1e-15);
    for lane in [0, 7, 40, 63] {
        let of_sample = [1, 2, 3, 4].map(|input| columns[input][lane]);
        let text = written_out(of_sample)
            .replace("{ value = \"25 mph\", sd = \"1.5 mph\" }", &format!("\"{} mph\"", columns[0][lane]));
        let expected = speed(&text);
        let delta_v = expected.impact.as_ref().unwrap().outcome.delta_v_magnitude();
        let found = expected.found.unwrap().speed;
        for (output, expected) in
            [(SPEED.of_vehicle(VehicleId::One), found), (DELTA_V.of_vehicle(VehicleId::Two), delta_v[1])]
        {
            let sampled = result.propagation.columns()[place(&result, output)][lane];
            assert!((sampled / expected - 1.0).abs() < 1e-9, "sample {lane}: {sampled} is not {expected}");
        }
    }
}

/// The exact derivative by a factor against differences of the case written out.
#[test]
fn derivatives_by_the_factor_of_a_table_are_those_of_the_numbers_written_out() {
    let sweep = Sweep { step: 0.1, steps: 1 };
    let result = sensitivity(&read(CATEGORIES), sweep).unwrap();
    let speed = |factors| reconstruct(&read(&written_out(factors))).unwrap().found.unwrap().speed;
    for (place, path) in [
        "vehicle1.crush.stiffness.factor",
        "vehicle1.yaw_radius.factor",
        "vehicle2.crush.stiffness.factor",
        "vehicle2.yaw_radius.factor",
    ]
    .into_iter()
    .enumerate()
    {
        let at = |change: f64| {
            let mut factors = [1.0; 4];
            factors[place] += change;
            speed(factors)
        };
        // Fourth order: (8 (f(h) − f(−h)) − (f(2h) − f(−2h)))/12h
        let h = 1e-3;
        let expected = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let row =
            result.derivatives.iter().find(|row| row.input.path == path && row.output.is(&SPEED)).unwrap();
        assert!((row.value / expected - 1.0).abs() < 1e-6, "{path}: {} is not {expected}", row.value);
    }
}

/// Burg's estimate has the spread too. Where no speed is sought, no result depends on the stiffness.
#[test]
fn a_case_without_a_range_has_the_spread_of_its_estimates() {
    let burg = CATEGORIES
        .replace("class   = 4", "wheelbase = \"108 in\"\nlength = \"190 in\"")
        .replace("{ value = \"25 mph\", sd = \"1.5 mph\" }", "\"25 mph\"");
    let paths = |text: &str| -> Vec<String> {
        run(text, 64).inputs.into_iter().map(|input| input.input.path).collect()
    };
    assert_eq!(
        paths(&burg),
        [
            "vehicle1.crush.stiffness.factor",
            "vehicle1.yaw_radius.factor",
            "vehicle2.crush.stiffness.factor",
            "vehicle2.yaw_radius.factor",
        ]
    );
    let forward = burg
        .replace("[reconstruct]\nfind = \"vehicle1.speed\"\n", "")
        .replace("weight  = \"3450 lb\"", "weight = \"3450 lb\"\nspeed = \"35 mph\"");
    assert_eq!(paths(&forward), ["vehicle1.yaw_radius.factor", "vehicle2.yaw_radius.factor"]);
}

/// Every number of the T-bone but the one range, and what is estimated; nothing that has no part in the
/// answer, such as an outline.
#[test]
fn what_has_no_range_is_taken_as_exact() {
    let outline = CATEGORIES.replace(
        "contact = { x = \"92 in\"",
        "length = \"190 in\"\nwidth = \"70 in\"\ncg_to_front = \"95 in\"\ncontact = { x = \"92 in\"",
    );
    let exact = run(&outline, 64).taken_as_exact;
    let keys: Vec<&str> = exact.iter().map(|exact| exact.key.as_str()).collect();
    assert_eq!(
        keys,
        [
            "vehicle1.weight",
            "vehicle1.heading",
            "vehicle1.contact.x",
            "vehicle1.contact.y",
            "vehicle1.crush.width",
            "vehicle1.crush.depths",
            "vehicle2.weight",
            "vehicle2.heading",
            "vehicle2.contact.x",
            "vehicle2.contact.y",
            "vehicle2.crush.width",
            "vehicle2.crush.depths",
            "impact.crush_plane",
            "impact.restitution",
            "impact.tangential.friction",
        ]
    );
    let ExactValue::Numbers(depths) = &exact[5].value else { panic!("{:?}", exact[5]) };
    let depths: Vec<f64> = depths.iter().map(|depth| depth.number).collect();
    assert_eq!(depths, [3.0, 6.5, 8.8, 10.0, 11.2, 13.5]);
    // Each of the 31 numbers of this case is a range; one choice is left.
    let all = run(UNCERTAIN, 64).taken_as_exact;
    assert_eq!(all.len(), 1);
    assert_eq!((all[0].key.as_str(), &all[0].value), ("impact.tangential", &ExactValue::Word("critical")));
    // One depth of six that is a range leaves five.
    let five = CATEGORIES.replace("\"3.0 6.5 8.8 10.0 11.2 13.5 in\"", "[{ value = \"3.0 in\", sd = \"1 in\" }, \"6.5 in\", \"8.8 in\", \"10.0 in\", \"11.2 in\", \"13.5 in\"]");
    let exact = run(&five, 64).taken_as_exact;
    let ExactValue::Numbers(depths) = &exact[5].value else { panic!("{:?}", exact[5]) };
    assert_eq!(depths.len(), 5);
}

fn doubt(result: &Uncertainty, doubt: Doubt) -> Option<Doubtful> {
    result.doubtful.iter().copied().find(|doubtful| doubtful.doubt == doubt)
}

/// P(v < 0) of a normal distribution with σ = μ is Φ(−1) = 15.866 %.
#[test]
fn given_speeds_that_are_sampled_negative_are_counted() {
    let wide = CATEGORIES.replace("sd = \"1.5 mph\"", "sd = \"25 mph\"");
    let result = run(&wide, 20_000);
    let backward = doubt(&result, Doubt::GivenBackward { vehicle: VehicleId::Two }).unwrap();
    assert_eq!(backward.of, result.propagation.succeeded());
    let share = backward.samples as f64 / backward.of as f64;
    // √(p (1 − p)/n) = 0.0026
    assert!((share - 0.15866).abs() < 4.0 * 0.0026, "{share}");
    // If the central value itself is negative, there is no warning about the others.
    let reversing = wide.replace("{ value = \"25 mph\"", "{ value = \"-1 mph\"");
    assert_eq!(doubt(&run(&reversing, 640), Doubt::GivenBackward { vehicle: VehicleId::Two }), None);
    assert!(run(CATEGORIES, 20_000).doubtful.is_empty());
}

#[test]
fn speeds_found_that_are_negative_or_implausible_are_counted() {
    let wide = UNCERTAIN
        .replace("{ value = \"180 deg\", sd = \"3 deg\" }", "{ low = \"0 deg\", high = \"360 deg\" }")
        .replace(
            "{ low = \"8 mph\", mode = \"10 mph\", high = \"12 mph\" }",
            "{ value = \"10 mph\", sd = \"60 mph\" }",
        );
    let result = run(&wide, 20_000);
    let first = result.outputs[0].output;
    assert!(first.is(&SPEED), "{first:?}");
    let vehicle = first.vehicle().unwrap();
    let speeds = &result.propagation.columns()[0];
    let backward = speeds.iter().filter(|speed| **speed < 0.0).count();
    let too_fast = speeds.iter().filter(|speed| speed.abs() * 3.6 > 250.0).count();
    let count = |kind| doubt(&result, kind).map_or(0, |doubtful| doubtful.samples);
    assert_eq!(count(Doubt::FoundBackward { vehicle }), backward);
    assert_eq!(count(Doubt::FoundTooFast { vehicle, limit: 250.0 / 3.6 }), too_fast);
    assert!(backward > 100 && too_fast > 100, "{backward} {too_fast}");
}

/// The closing speed of the paper's example is about 21 m/s in practically every sample; half of a uniform
/// distribution from 0.2 to 0.4 lies above 0.3.
#[test]
fn restitutions_that_are_high_at_the_closing_speed_of_the_sample_are_counted() {
    let result = run(UNCERTAIN, 20_000);
    let high = doubt(&result, Doubt::HighRestitution).unwrap();
    let share = high.samples as f64 / high.of as f64;
    assert!((share - 0.5).abs() < 4.0 * 0.0036, "{share}");
}

/// The fixture has five speeds, found by a search that shares no code with the program; the T-bone has one.
#[test]
fn samples_with_several_speeds_are_counted_among_the_first() {
    let five = include_str!("../../../fixtures/roots/five-roots.toml");
    let line = five.lines().find(|line| line.trim_start().starts_with("crush_plane")).unwrap();
    let value = line.split('"').nth(1).unwrap();
    let unit = value.split(' ').nth(1).unwrap();
    let narrow = format!("crush_plane = {{ value = \"{value}\", sd = \"1e-9 {unit}\" }}");
    let result = run(&five.replace(line, &narrow), 5000);
    let several = doubt(&result, Doubt::SeveralSpeeds).unwrap();
    assert_eq!((several.samples, several.of), (4096, 4096));
}

/// The same where a quadratic has two of them, and where one.
#[test]
fn samples_with_two_speeds_in_closed_form_are_counted() {
    let counted = |across: f64| {
        let narrow = "yaw_rate = { value = \"5 rad/s\", sd = \"1e-9 rad/s\" }";
        let result = run(&crate::warnings::spinning(across).replace("yaw_rate = \"5 rad/s\"", narrow), 5000);
        doubt(&result, Doubt::SeveralSpeeds).map(|several| (several.samples, several.of))
    };
    assert_eq!(counted(3.0), Some((4096, 4096)));
    assert_eq!(counted(1.9), None);
}

/// By hand (`several_speeds`), of −4 √10 and 4 √10 m/s the second is the answer, and the samples stay with
/// it: their yaw rate, 5 rad/s, has a standard deviation of 1 %, and s = (x − ω) √10 with −x² + 2 ω x − 9 =
/// 0 is √10 √(ω² − 9).
#[test]
fn samples_stay_with_the_speed_that_is_the_answer() {
    let ranged = "yaw_rate = { value = \"5 rad/s\", sd = \"0.05 rad/s\" }";
    let result = run(&crate::warnings::spinning(3.0).replace("yaw_rate = \"5 rad/s\"", ranged), 5000);
    let place = place(&result, SPEED.of_vehicle(VehicleId::One));
    let summary = result.propagation.summaries()[place].unwrap();
    // 95 %
    let interval = summary.intervals[2];
    let at = |deviations: f64| {
        let yaw_rate = 5.0 + 0.05 * deviations;
        (10.0 * (yaw_rate * yaw_rate - 9.0)).sqrt()
    };
    for (actual, expected) in
        [(summary.median.value, at(0.0)), (interval.low.value, at(-1.96)), (interval.high.value, at(1.96))]
    {
        assert!((actual - expected).abs() < 0.03, "{actual} for {expected}");
    }
}

/// All depths of both vehicles, but for the tape.
const TAPE: &str = include_str!("../../../fixtures/depths-shared.toml");
const INDEPENDENT: &str = include_str!("../../../fixtures/depths-independent.toml");
const DEPTHS: [&str; 2] = ["3.0 6.5 8.8 10.0 11.2 13.5 in", "3.0 8.0 11.5 12.5 10.0 5.0 in"];

/// Sample by sample: the file with the error added to each of its depths; below zero, a depth is zero.
#[test]
fn a_shared_error_is_added_to_each_of_its_numbers() {
    let wide = TAPE.replace("sd   = \"1 in\"", "sd   = \"10 cm\"");
    let result = run(&wide, 64);
    assert_eq!(result.inputs.len(), 1);
    assert_eq!(result.inputs[0].input.path, "uncertainty.shared.tape");
    let columns = first_block(&result);
    let mut cut = 0;
    for (lane, error) in columns[0].iter().enumerate() {
        let mut text = wide.split("[[uncertainty.shared]]").next().unwrap().to_owned();
        for depths in DEPTHS {
            let numbers = depths.trim_end_matches(" in").split(' ');
            let moved = numbers.map(|depth| {
                // The error is in cm, the depths are in inches.
                let moved: f64 = depth.parse::<f64>().unwrap() + error / 2.54;
                cut += usize::from(moved < 0.0);
                moved.max(0.0).to_string()
            });
            let moved = moved.collect::<Vec<_>>().join(" ");
            text = text.replace(depths, &format!("{moved} in"));
        }
        let expected = reconstruct(&read(&text)).unwrap().found.unwrap().speed;
        let sampled = result.propagation.columns()[0][lane];
        assert!((sampled / expected - 1.0).abs() < 1e-9, "sample {lane}: {sampled} is not {expected}");
    }
    assert!(cut > 10, "{cut}");
}

/// A percentage multiplies: the energy of depths alone (A = G = 0) goes with their square, and the closing
/// speed of a head-on collision with its root.
#[test]
fn a_shared_percentage_multiplies_each_of_its_numbers() {
    let text = TAPE
        .replace("sd   = \"1 in\"", "within = \"10 %\"\nconfidence = 0.95")
        .replace("{ category = 4 }", "{ A = \"0 lb/in\", B = \"40 psi\" }")
        .replace("{ category = 2 }", "{ A = \"0 lb/in\", B = \"60 psi\" }")
        .replace("\"vehicle1.crush.stiffness\", \"vehicle2.crush.stiffness\", ", "");
    let result = run(&text, 64);
    let work = place(&result, IMPACT_NORMAL_WORK.of_collision());
    let central = result.outputs[work].central;
    for (factor, sampled) in first_block(&result)[0].iter().zip(&result.propagation.columns()[work]) {
        assert!((sampled / (central * factor * factor) - 1.0).abs() < 1e-9);
    }
}

/// The derivatives of a shared error add up before they are squared, those of independent ones after.
#[test]
fn first_order_of_a_shared_error_is_the_sum_of_the_derivatives() {
    let sweep = Sweep { step: 0.1, steps: 1 };
    let rows = sensitivity(&read(TAPE), sweep).unwrap().derivatives;
    let of_depths: Vec<f64> = rows
        .iter()
        .filter(|row| row.input.path.contains("crush.depths") && row.output.is(&SPEED))
        .map(|row| row.value)
        .collect();
    assert_eq!(of_depths.len(), 12);
    // Nothing is said twice.
    assert!(!rows.iter().any(|row| row.input.path.starts_with("uncertainty")));
    let inch = 0.0254;
    let sum = of_depths.iter().sum::<f64>() * inch;
    let root = of_depths.iter().map(|by| by * by).sum::<f64>().sqrt() * inch;
    let shared = run(TAPE, 20_000);
    let independent = run(INDEPENDENT, 20_000);
    assert!((shared.outputs[0].first_order.sd / sum - 1.0).abs() < 1e-9);
    // A depth of 3 in with 1 in is cut at zero, which takes 0.5 % of its deviation.
    assert!((independent.outputs[0].first_order.sd / root - 1.0).abs() < 1e-2);
    for (result, expected) in [(&shared, sum), (&independent, root)] {
        let sd = result.propagation.summaries()[0].unwrap().sd.value;
        assert!((sd / expected - 1.0).abs() < 0.05, "{sd} is not {expected}");
    }
}

/// On top of the range that a number has of its own, and beside the one of another.
#[test]
fn a_number_may_have_a_range_and_share_an_error() {
    let both = INDEPENDENT.to_owned()
        + TAPE
            .split_once("[[uncertainty.shared]]")
            .map(|(_, rest)| "[[uncertainty.shared]]".to_owned() + rest)
            .unwrap()
            .as_str();
    let result = run(&both, 20_000);
    assert_eq!(result.inputs.len(), 13);
    let variance = |result: &Uncertainty| result.outputs[0].first_order.sd.powi(2);
    let apart = variance(&run(TAPE, 64)) + variance(&run(INDEPENDENT, 64));
    assert!((variance(&result) / apart - 1.0).abs() < 1e-9);
    let keys: Vec<&str> = result.taken_as_exact.iter().map(|exact| exact.key.as_str()).collect();
    assert!(!keys.contains(&"vehicle1.crush.depths") && keys.contains(&"vehicle1.crush.width"), "{keys:?}");
    assert!(run(TAPE, 64).taken_as_exact.iter().all(|exact| exact.key != "vehicle1.crush.depths"));
}

/// Estimated values that are taken as exact have no spread, and are in the list of exact values.
#[test]
fn a_spread_that_is_switched_off_is_taken_as_exact() {
    let exact = CATEGORIES.to_owned()
        + "\n[uncertainty]\nexact = [\"vehicle1.crush.stiffness\", \"vehicle2.yaw_inertia\"]\n";
    let result = run(&exact, 64);
    let paths: Vec<&str> = result.inputs.iter().map(|input| input.input.path.as_str()).collect();
    assert_eq!(paths, ["vehicle2.speed", "vehicle1.yaw_radius.factor", "vehicle2.crush.stiffness.factor"]);
    let keys: Vec<&str> = result.taken_as_exact.iter().map(|exact| exact.key.as_str()).collect();
    assert!(keys.contains(&"vehicle1.crush.stiffness") && keys.contains(&"vehicle2.yaw_inertia"), "{keys:?}");
}

/// The samples that are shown, in their order: their outputs are the columns, of all outputs and of one that
/// was asked for alone, and their inputs are those that the sampler draws.
#[test]
fn samples_are_shown_with_their_inputs() {
    let wide = UNCERTAIN.replace("{ low = 0.2, high = 0.4 }", "{ value = 0.3, sd = 0.5 }");
    assert!(wide != UNCERTAIN);
    for asks_for_all in [true, false] {
        let wanted = |output: Output| asks_for_all || output == DELTA_V.of_vehicle(VehicleId::Two);
        let plan = Plan { settings: plan(5000).settings, index_rows: None };
        let quietly = &mut |_, _, _| ControlFlow::Continue(());
        let result = uncertainty_of(&read(&wide), &plan, &wanted, quietly).unwrap();
        let distributions: Vec<_> = result.inputs.iter().map(|input| input.distribution).collect();
        let sampler = ::uncertainty::Sampler::new(&distributions, &plan.settings).unwrap();
        let mut drawn = vec![::uncertainty::Lanes::ZERO; distributions.len()];
        let (mut block, mut sample, mut failed) = (0, 0, 0);
        let done: Result<(), ()> = result.for_each_block(|shown| {
            sampler.fill(block, &mut drawn);
            assert_eq!(shown.inputs, drawn);
            block += 1;
            for (lane, reason) in shown.reasons.iter().enumerate() {
                assert_eq!(*reason, result.propagation.reasons()[sample]);
                failed += usize::from(*reason != 0);
                for (output, column) in shown.outputs.iter().zip(result.propagation.columns()) {
                    assert_eq!(output[lane].to_bits(), column[sample].to_bits());
                }
                sample += 1;
            }
            Ok(())
        });
        assert_eq!((done, sample), (Ok(()), 5000));
        assert_eq!(result.propagation.columns().len(), if asks_for_all { result.outputs.len() } else { 1 });
        assert!(failed > 0 && failed == 5000 - result.propagation.succeeded());
    }
}

/// For a vector whose speed is sought, only the direction counts, with its range: that of 75 ft/s along and 5
/// ft/s across is 75 · 5/(75² + 5²) rad per 5 ft/s across, as a sideslip of the same range shows.
#[test]
fn the_direction_of_a_sought_velocity_has_its_range() {
    let sd = |given: &str, key: &str| {
        let text = case::EXAMPLE.replacen("[vehicle1]", &format!("[vehicle1]\n{given}"), 1);
        let result = run(&text.replace("\"3696 lb\"", "{ value = \"3696 lb\", sd = \"50 lb\" }"), 64);
        assert!(result.inputs.iter().any(|input| input.input.path == key));
        assert!(!result.taken_as_exact.iter().any(|exact| exact.key == key));
        result.outputs[place(&result, SPEED.of_vehicle(VehicleId::One))].first_order.sd
    };
    let vector = sd(
        "velocity = { x = \"-75 ft/s\", y = { value = \"-5 ft/s\", sd = \"5 ft/s\" } }",
        "vehicle1.velocity.y",
    );
    let [angle, range] = [(5.0_f64 / 75.0).atan().to_degrees(), (375.0_f64 / 5650.0).to_degrees()];
    let sideslip = sd(
        &format!("sideslip = {{ value = \"{angle:?} deg\", sd = \"{range:?} deg\" }}"),
        "vehicle1.sideslip",
    );
    assert!((vector / sideslip - 1.0).abs() < 1e-6, "{vector} {sideslip}");
    // Far more than the 50 lb alone, 0.15 mph.
    assert!(vector > 0.5, "{vector}");
}

/// v_b = √(v² + 2 μ g S): its distribution against the area of the square of both ranges below each value, by
/// a grid, and its derivatives against those of the formula.
#[test]
fn the_speed_where_a_skid_begins_varies_with_friction_and_speed() {
    let skid = "[vehicle1.before]\nskid = { length = \"20 m\", friction = { low = 0.6, high = 0.8 } }\n";
    let text = head_on("{ low = \"8 m/s\", high = \"12 m/s\" }") + skid;
    let at_begin = SKID_SPEED.of_vehicle(VehicleId::One);
    let begin = |speed: f64, friction: f64| (speed * speed + 2.0 * friction * 9.806_65 * 20.0).sqrt();

    let result = run(&text, 100_000);
    let column = &result.propagation.columns()[place(&result, at_begin)];
    let middles = (0..1000).map(|k| (f64::from(k) + 0.5) / 1000.0);
    let mut exact: Vec<f64> = middles
        .clone()
        .flat_map(|one| middles.clone().map(move |two| begin(8.0 + 4.0 * one, 0.6 + 0.2 * two)))
        .collect();
    exact.sort_by(f64::total_cmp);
    for share in [0.025_f64, 0.25, 0.5, 0.75, 0.975] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in the grid")]
        let quantile = exact[(share * 1e6) as usize];
        #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
        let below = column.iter().filter(|value| **value <= quantile).count() as f64 / column.len() as f64;
        let error = (share * (1.0 - share) / 1e5).sqrt();
        assert!((below - share).abs() < 4.0 * error, "{share}: {below}");
    }

    let found = sensitivity(&read(&text), Sweep { step: 0.1, steps: 0 }).unwrap();
    let by = |path: &str| {
        let mut rows = found.derivatives.iter();
        rows.find(|row| row.output == at_begin && row.input.path == path).unwrap().value
    };
    let central = begin(10.0, 0.7);
    // ∂v_b/∂v = v/v_b, ∂v_b/∂μ = g S/v_b, ∂v_b/∂S = μ g/v_b
    for (path, exact) in [
        ("vehicle1.speed", 10.0 / central),
        ("vehicle1.before.skid.friction", 9.806_65 * 20.0 / central),
        ("vehicle1.before.skid.length", 0.7 * 9.806_65 / central),
    ] {
        assert!((by(path) - exact).abs() < 1e-12 * exact, "{path}: {} {exact}", by(path));
    }
}

/// EES = √(2 E/m) of one vehicle: its interval has the ends of that of the mass, and its derivatives are
/// those of the formula.
#[test]
fn the_energy_equivalent_speed_of_one_vehicle_has_an_interval() {
    let text = |stiffness: &str| {
        format!(
            "[vehicle1]\nmass = {{ value = \"1400 kg\", sd = \"70 kg\" }}\n[vehicle1.crush]\nside = \"front\"\n\
             width = \"150 cm\"\ndepths = \"20 25 30 25 20 15 cm\"\nstiffness = {stiffness}\n"
        )
    };
    let measured = text("{ A = \"555 N/cm\", B = \"40 N/cm^2\" }");
    let result = run(&measured, 100_000);
    let [of_energy, of_ees] = [CRUSH_ENERGY.of_vehicle(VehicleId::One), EES.of_vehicle(VehicleId::One)]
        .map(|output| place(&result, output));
    let energy = result.outputs[of_energy].central;
    let ees = |mass: f64| (2.0 * energy / mass).sqrt();
    assert!((result.outputs[of_ees].central - ees(1400.0)).abs() < 1e-12 * ees(1400.0));
    let summary = result.propagation.summaries()[of_ees].unwrap();
    let [_, _, interval, _] = summary.intervals;
    for (end, sds) in [(interval.low, 1.959_964), (summary.median, 0.0), (interval.high, -1.959_964)] {
        let exact = ees(1400.0 + sds * 70.0);
        assert!((end.value - exact).abs() < 4.0 * end.standard_error.unwrap(), "{end:?} {exact}");
    }
    assert!(result.propagation.summaries()[of_energy].unwrap().sd.value < 1e-9 * energy);

    let found = sensitivity(&read(&measured), Sweep { step: 0.1, steps: 0 }).unwrap();
    let mut rows = found.derivatives.iter();
    let by_mass = rows
        .find(|row| row.output == EES.of_vehicle(VehicleId::One) && row.input.path == "vehicle1.mass")
        .unwrap();
    // ∂EES/∂m = −EES/2m
    let exact = -ees(1400.0) / 2800.0;
    assert!((by_mass.value - exact).abs() < 1e-12 * exact.abs(), "{} {exact}", by_mass.value);

    // E of a category varies: ln A by 0.38, and B by 0.59.
    let spread = run(&text("{ category = 3 }"), 10_000).propagation.summaries()[of_energy].unwrap();
    assert!((0.2..0.8).contains(&(spread.sd.value / spread.mean.value)), "{spread:?}");
}
