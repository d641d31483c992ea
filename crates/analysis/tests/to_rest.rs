//! Derivatives and samples of cases whose vehicles are followed to rest, or whose speeds are found from the
//! rests.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::ops::ControlFlow;

use ::uncertainty::{Lanes, Sampler, SamplingMethod, Settings};
use analysis::quantities::SPEED;
use analysis::{
    Analysis, Failure, Output, Plan, Reason, Sweep, Uncertainty, impact, motion, reconstruct, sensitivity,
    uncertainty,
};
use case::CaseFile;
use inputs::{Axes, Case, Dimension, Input};

const NO_SWEEP: Sweep = Sweep { step: 0.1, steps: 0 };

fn parsed(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

/// Two cars that cross, and after the impact roll and spin to rest.
fn crossing([one, two]: [&str; 2], [after_1, after_2]: [&str; 2], scene: &str, end: &str) -> String {
    format!(
        r#"
[scene]
contact = {{ x = "0 m", y = "0 m" }}
{scene}
[surface]
friction = 0.7
[vehicle1]
mass = "1500 kg"
yaw_inertia = "2500 kg m^2"
wheelbase = "2.7 m"
track = "1.5 m"
cg_to_front_axle = "1.25 m"
heading = "0 deg"
contact = {{ x = "1.9 m", y = "-0.3 m" }}
{one}
[vehicle1.after]
drag = 0.15
{after_1}
[vehicle2]
mass = "1300 kg"
yaw_inertia = "2000 kg m^2"
wheelbase = "2.5 m"
track = "1.45 m"
cg_to_front_axle = "1.1 m"
heading = "80 deg"
contact = {{ x = "0.6 m", y = "0.8 m" }}
{two}
[vehicle2.after]
drag = 0.1
{after_2}
[impact]
crush_plane = "190 deg"
restitution = 0.1
tangential = {{ fraction = 0.9 }}
{end}
"#
    )
}

/// The same with y to the right: what is lateral or rotational has the other sign.
fn mirrored(text: &str) -> String {
    [
        ("y = \"-0.3 m\"", "y = \"0.3 m\""),
        ("y = \"0.8 m\"", "y = \"-0.8 m\""),
        ("heading = \"80 deg\"", "heading = \"-80 deg\""),
        ("crush_plane = \"190 deg\"", "crush_plane = \"-190 deg\""),
    ]
    .into_iter()
    .fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

const SPEEDS: [f64; 2] = [14.0, 11.0];

/// The same, forward from both speeds, as an impact that carries on to rest.
fn forward(scene: &str) -> String {
    crossing(
        SPEEDS.map(|speed| format!("speed = \"{speed} m/s\"")).each_ref().map(String::as_str),
        [""; 2],
        scene,
        "",
    )
}

/// The same, back from where the forward case comes to rest, as given in the axes of the case.
fn backward() -> String {
    let rests = impact(&parsed(&forward(""))).unwrap().travel.map(|travel| {
        let rest = travel.unwrap().rest;
        let heading = rest.heading.to_degrees();
        format!(
            "rest = {{ x = \"{} m\", y = \"{} m\", heading = \"{heading} deg\" }}",
            rest.position.x, rest.position.y
        )
    });
    let find = "[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n";
    crossing([""; 2], rests.each_ref().map(String::as_str), "", find)
}

/// The value of an output, read from the finished analysis of a whole run.
fn value(analysis: &Analysis, output: Output) -> f64 {
    let axes = Axes::default();
    let vehicle = output.vehicle().unwrap();
    let travel = || analysis.travel[vehicle.index()].as_ref().unwrap();
    match output.key() {
        "speed" => match &analysis.both {
            Some(both) => both.speeds[vehicle.index()],
            None => analysis.found.as_ref().unwrap().speed,
        },
        "delta_v" => match &analysis.both {
            Some(both) => both.delta_v[vehicle.index()],
            None => analysis.impact.as_ref().unwrap().outcome.delta_v_magnitude()[vehicle.index()],
        },
        "skid.speed" => analysis.skids[vehicle.index()].unwrap().speed,
        "start.speed" => travel().start.motion.velocity.norm(),
        "start.direction" => axes.lateral(travel().direction()),
        "start.yaw_rate" => travel().start.motion.yaw_rate,
        "rest.x" => travel().rest.position.x,
        "rest.y" => travel().rest.position.y,
        "rest.heading" => travel().rest.heading,
        "rest.distance" => travel().rest.distance,
        "rest.time" => travel().rest.time,
        other => panic!("{other} is not differentiated"),
    }
}

/// Compares each derivative with central differences of whole runs, in plain numbers: for each output the
/// greatest difference, as a share of the greatest influence on that output. `scale` makes the differences
/// longer.
fn compare(case: &Case, solve: fn(&Case) -> Result<Analysis, Failure>, scale: f64) -> Vec<(String, f64)> {
    compared(case, solve, scale).into_iter().map(|(output, [off, _])| (output, off)).collect()
}

/// The same, and after it the greatest difference as a share of the influence that it belongs to, or of a
/// tenth of the greatest if that is more.
fn compared(
    case: &Case,
    solve: fn(&Case) -> Result<Analysis, Failure>,
    scale: f64,
) -> Vec<(String, [f64; 2])> {
    let rows = sensitivity(case, NO_SWEEP).unwrap().derivatives;
    // By a small step, but far above the error of the integration.
    let step = |input: &Input| match input.unit.map(inputs::Unit::dimension) {
        Some(Dimension::Angle) => 0.002 / input.factor(),
        Some(Dimension::Length) => 0.01 * scale / input.factor(),
        _ => 0.003 * scale * input.number.abs().max(0.1),
    };
    let around: Vec<(Input, [Analysis; 4])> = case
        .inputs()
        .into_iter()
        .map(|input| {
            let moved = |steps: f64| {
                let case = case.map(|other| {
                    if other.path == input.path { other.number + steps * step(&input) } else { other.number }
                });
                solve(&case).unwrap_or_else(|failure| panic!("{}: {failure}", input.path))
            };
            let analyses = [-2.0, -1.0, 1.0, 2.0].map(moved);
            (input, analyses)
        })
        .collect();
    let mut outputs: Vec<Output> = rows.iter().map(|row| row.output).collect();
    outputs.dedup();
    let compared = outputs.into_iter().map(|output| {
        let of = |input: &Input| rows.iter().find(|row| row.output == output && row.input == *input).unwrap();
        let effects: Vec<[f64; 2]> = around
            .iter()
            .map(|(input, analyses)| {
                let [low2, low, high, high2] = analyses.each_ref().map(|analysis| value(analysis, output));
                // Fourth order: (8 (f₁ − f₋₁) − (f₂ − f₋₂))/12
                let expected = (8.0 * (high - low) - (high2 - low2)) / 12.0;
                [of(input).value * input.factor() * step(input), expected]
            })
            .collect();
        let largest = effects.iter().flatten().fold(0.0, |largest: f64, effect| largest.max(effect.abs()));
        let greatest = |by: fn(f64, f64) -> f64| {
            effects
                .iter()
                .fold(0.0, |off: f64, [one, other]| off.max((one - other).abs() / by(other.abs(), largest)))
        };
        (output.path(), [greatest(|_, largest| largest), greatest(|own, largest| own.max(0.1 * largest))])
    });
    compared.collect()
}

/// The accuracy of central differences of an integration with an error of 0.1 mm a step.
const CLOSE: f64 = 0.01;

/// A search for a start may miss its rest by half a millimetre, rarely by one, so that differences of 1 cm
/// are too small, and longer ones have this accuracy.
const SEARCHED: f64 = 3.0;
const CLOSE_BY_SEARCH: f64 = 0.02;
/// The same of an influence itself, in place of the greatest.
const OF_ITS_OWN: f64 = 0.08;

#[test]
fn derivatives_of_both_speeds_are_central_differences() {
    let case = parsed(&backward());
    let found = reconstruct(&case).unwrap().both.unwrap().speeds;
    for (found, given) in found.into_iter().zip(SPEEDS) {
        assert!((found - given).abs() < 1e-3, "{found} {given}");
    }
    let worst = compare(&case, reconstruct, SEARCHED);
    // Both speeds, both ΔV; speed, direction, yaw rate, distance and time of both paths.
    assert_eq!(worst.len(), 4 + 2 * 5);
    assert!(worst.iter().all(|(_, off)| *off < CLOSE_BY_SEARCH), "{worst:#?}");
}

/// The wheels lock and roll again as the vehicles spin, and the search back from the rests magnifies the
/// errors of the derivatives: along the steps of the path itself they are off by up to twice the influence.
#[test]
fn derivatives_of_vehicles_that_spin_to_rest_are_central_differences() {
    let text = include_str!("../../case/templates/si/intersection.toml");
    // Momentum alone gives the speeds; a depth cannot be moved far below its 9 cm.
    let parts: Vec<&str> = text.split("\n[").filter(|part| !part.contains(".crush]")).collect();
    let case = parsed(&parts.join("\n[").replace("energy_basis = \"absorbed\"", ""));
    let worst = compared(&case, reconstruct, 2.0 * SEARCHED);
    assert_eq!(worst.len(), 4 + 2 * 5);
    // The time to rest jumps by some hundredths of a second where the integration chooses other steps.
    let is_close = |(output, [off, own]): &(String, [f64; 2])| {
        *own < OF_ITS_OWN || (output.ends_with("rest.time") && *off < 1.5 * CLOSE_BY_SEARCH)
    };
    assert!(worst.iter().all(is_close), "{worst:#?}");
}

#[test]
fn derivatives_by_momentum_and_crush_are_central_differences() {
    let text = include_str!("../../../fixtures/rear-end-rest.toml");
    let worst = compare(&parsed(text), reconstruct, 1.0);
    // Neither turns as it leaves; one skidded before.
    assert_eq!(worst.len(), 4 + 1 + 2 * 4);
    assert!(worst.iter().all(|(_, off)| *off < CLOSE), "{worst:#?}");
}

#[test]
fn derivatives_of_the_ways_after_an_impact_are_central_differences() {
    let worst = compare(&parsed(&forward("")), impact, 1.0);
    assert_eq!(worst.len(), 2 + 2 * 8);
    assert!(worst.iter().all(|(_, off)| *off < CLOSE), "{worst:#?}");
}

#[test]
fn derivatives_of_a_motion_alone_are_central_differences() {
    let text = backward();
    let (alone, _) = text.split_once("[impact]").unwrap();
    let worst = compare(&parsed(alone), motion, SEARCHED);
    assert_eq!(worst.len(), 2 * 5);
    assert!(worst.iter().all(|(_, off)| *off < CLOSE_BY_SEARCH), "{worst:#?}");
}

fn propagated(case: &Case, samples: usize) -> Uncertainty {
    let plan = Plan { settings: Settings::new(SamplingMethod::MonteCarlo, samples, 1), index_rows: None };
    uncertainty(case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap()
}

/// With ranges of the numbers that give the rest of the vehicles.
fn uncertain(text: &str) -> String {
    text.replace("friction = 0.7", "friction = { value = 0.7, sd = 0.03 }")
        .replace("drag = 0.15", "drag = { value = 0.15, sd = 0.02 }")
}

/// Each sample is what a whole run finds for a case with its numbers.
#[test]
fn samples_are_runs() {
    let case = parsed(&uncertain(&backward()));
    let propagated = propagated(&case, 100);
    assert_eq!(propagated.inputs.len(), 2);
    assert_eq!(propagated.propagation.succeeded(), 100);
    let distributions: Vec<_> = propagated.inputs.iter().map(|input| input.distribution).collect();
    let sampler = Sampler::new(&distributions, &propagated.settings).unwrap();
    let mut block = vec![Lanes::ZERO; 2];
    sampler.fill(0, &mut block);
    for sample in 0..10 {
        let numbers = [block[0][sample], block[1][sample]];
        let run = case.map(|input| {
            let place = propagated.inputs.iter().position(|uncertain| uncertain.input.path == input.path);
            place.map_or(input.number, |place| numbers[place])
        });
        let run = reconstruct(&run).unwrap();
        for (output, column) in propagated.outputs.iter().zip(propagated.propagation.columns()) {
            if !output.output.is(&SPEED) && !output.output.quantity().is_of_path() {
                continue;
            }
            let expected = value(&run, output.output);
            // The rest is reached to within a millimetre from either side.
            assert!(
                (column[sample] - expected).abs() < 2e-3 * expected.abs().max(1.0),
                "{:?}",
                output.output
            );
        }
    }
}

/// Where the ranges are narrow, the law of propagation of uncertainty and the samples agree.
#[test]
fn first_order_and_samples_agree_where_ranges_are_narrow() {
    let case =
        parsed(&uncertain(&backward()).replace("sd = 0.03", "sd = 0.004").replace("sd = 0.02", "sd = 0.002"));
    let propagated = propagated(&case, 400);
    for (output, summary) in propagated.outputs.iter().zip(propagated.propagation.summaries()) {
        let sd = summary.as_ref().unwrap().sd.value;
        // 400 samples determine a standard deviation to 4 %.
        assert!(
            (output.first_order.sd / sd - 1.0).abs() < 0.15,
            "{:?} {sd} {:?}",
            output.output,
            output.first_order
        );
    }
}

/// A scene that is seen from below has the same intervals, its lateral numbers with the other sign.
#[test]
fn a_scene_with_z_down_has_the_mirrored_intervals() {
    let text = mirrored(&uncertain(&forward("axes = \"z-down\"")));
    let down = propagated(&parsed(&text), 100);
    let up = propagated(&parsed(&uncertain(&forward(""))), 100);
    for (up, down) in up.outputs.iter().zip(&down.outputs) {
        assert_eq!(up.output.path(), down.output.path());
        let lateral = ["start.direction", "start.yaw_rate", "rest.y", "rest.heading", "delta_v_lateral"];
        let is_lateral = lateral.contains(&up.output.key());
        let sign = if is_lateral { -1.0 } else { 1.0 };
        assert!((up.central - sign * down.central).abs() < 1e-9, "{:?}", up.output);
        assert!(
            (up.first_order.sd - down.first_order.sd).abs() < 1e-9 * up.first_order.sd.max(1.0),
            "{:?}",
            up.output
        );
    }
}

/// Of two starts that lead to a rest, the short way and the long way round, the samples keep to one.
#[test]
fn samples_turn_as_far_as_the_central_case() {
    let case = parsed(
        &uncertain(&backward())
            .replace("heading = \"0 deg\"", "heading = { value = \"0 deg\", sd = \"2 deg\" }"),
    );
    let propagated = propagated(&case, 100);
    let place = propagated
        .outputs
        .iter()
        .position(|output| output.output.path() == "vehicle1.start.yaw_rate")
        .unwrap();
    let central = propagated.outputs[place].central;
    assert_eq!(propagated.failed(Reason::NoRest), 100 - propagated.propagation.succeeded());
    for yaw_rate in propagated.propagation.columns()[place].iter().filter(|rate| !rate.is_nan()) {
        assert_eq!(yaw_rate.signum(), central.signum());
    }
}
