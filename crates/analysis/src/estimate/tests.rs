//! Estimates of cases of which the answer is known otherwise.
#![allow(clippy::disallowed_methods, reason = "expected values may differ between machines by rounding")]

use std::ops::ControlFlow;

use case::CaseFile;
use inputs::Case;

use ::estimate::Evidence as _;

use super::*;
use crate::sensitivity::Output;

fn read(text: &str) -> Case {
    CaseFile::parse("test.toml", text).unwrap().case
}

fn run(case: &Case, particles: usize) -> Result<Estimated, Failure> {
    let plan = EstimatePlan { particles, seed: 1, prior: None, pieces: false };
    estimate(case, &plan, &mut |_, _, _| ControlFlow::Continue(()))
}

fn speed(vehicle: VehicleId) -> EstimateOutput {
    EstimateOutput::Result(Output::Speed { vehicle })
}

fn of(estimated: &Estimated, output: EstimateOutput) -> &EstimatedOutput {
    estimated.outputs.iter().find(|found| found.output == output).unwrap()
}

/// Vehicle 1 runs squarely into the rear of vehicle 2, which stands: all of the geometry is known to a hair.
const CENTRAL: &str = r#"
[estimate]
prior = "flat"
[vehicle1]
mass = { value = "1500 kg", sd = "0.01 kg" }
yaw_radius = "1.4 m"
heading = { value = "0 deg", sd = "0.0001 deg" }
contact = { x = { value = "2 m", sd = "0.01 mm" }, y = { value = "0 m", sd = "0.01 mm" } }
[vehicle2]
mass = { value = "1000 kg", sd = "0.01 kg" }
yaw_radius = "1.4 m"
heading = { value = "0 deg", sd = "0.0001 deg" }
contact = { x = { value = "-2 m", sd = "0.01 mm" }, y = { value = "0 m", sd = "0.01 mm" } }
speed = "0 km/h"
[impact]
crush_plane = { value = "0 deg", sd = "0.0001 deg" }
restitution = { value = 0.1, sd = 0.00001 }
tangential = { friction = { value = 0.7, sd = 0.0001 } }
"#;

/// The weighted quantile of a density at equal steps.
fn quantile(density: impl Fn(f64) -> f64, [low, high]: [f64; 2], share: f64) -> f64 {
    let steps = 20_000;
    let at = |k: usize| low + (high - low) * (k as f64 + 0.5) / steps as f64;
    let total: f64 = (0..steps).map(|k| density(at(k))).sum();
    let mut sum = 0.0;
    for k in 0..steps {
        sum += density(at(k)) / total;
        if sum >= share {
            return at(k);
        }
    }
    panic!("the grid ends below {share}")
}

fn assert_is_quantiles(found: &Summary, density: impl Fn(f64) -> f64, range: [f64; 2]) {
    let ends = found.intervals[3];
    for (ours, share) in [(ends.low, 0.025), (found.median, 0.5), (ends.high, 0.975)] {
        let exact = quantile(&density, range, share);
        let error = ours.standard_error.unwrap();
        assert!((ours.value - exact).abs() < 4.0 * error + 1e-3 * exact, "{ours:?} {exact}");
        assert!(error < 0.05 * exact, "{ours:?} tells nothing");
    }
}

/// V₂ = (1 + e) m₁ v₁/(m₁ + m₂) = 0.66 v₁, and 11 m/s were measured, ± 12 % in the logarithm.
#[test]
fn the_speed_after_tells_that_before() {
    let case = read(&format!("{CENTRAL}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n"));
    let estimated = run(&case, 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    assert_eq!(estimated.default_errors, ["vehicle2.after.speed", "vehicle2.after.direction"]);
    let density = |v: f64| (-0.5 * ((11.0 / (0.66 * v)).ln() / 0.12).powi(2)).exp();
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
}

/// ½ (1 − e²) m₁m₂/(m₁ + m₂) v² = 297 v² J, of which no crush of EES 20 km/h and 30 km/h tells more than the
/// misfit allows.
#[test]
fn the_crush_energy_tells_the_speed() {
    let crushes = "[vehicle1.crush]\nees = \"20 km/h\"\n[vehicle2.crush]\nees = \"30 km/h\"\n";
    let text =
        format!("{CENTRAL}{crushes}").replace("prior = \"flat\"", "prior = \"flat\"\ncrush_error = \"25 %\"");
    let estimated = run(&read(&text), 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    // E = ½ m EES²
    let energy = 0.5 * (1500.0 * (20.0_f64 / 3.6).powi(2) + 1000.0 * (30.0_f64 / 3.6).powi(2));
    let bias = evidence::FITTED.crush.bias;
    let density = |v: f64| (-0.5 * (((energy / (297.0 * v * v)).ln() - bias) / 0.25).powi(2)).exp();
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
    let crush = of(&estimated, EstimateOutput::CrushEnergy);
    assert!((crush.posterior.median.value - energy).abs() < 1e-3 * energy);
}

/// Vehicle 2 slides straight to rest on locked wheels, S = V₂²/2μg, where 15 m were measured, ± 0.5 m and
/// 10 %.
#[test]
fn the_rest_tells_the_speed() {
    let rest = r#"
[scene]
contact = { x = "-2 m", y = "0 m" }
[surface]
friction = { value = 0.7, sd = 0.00001 }
[vehicle2.after]
drag = "locked"
rest = { x = "15 m", y = "0 m", heading = "0 deg" }
"#;
    let text = format!("{CENTRAL}{rest}").replace(
        "yaw_radius = \"1.4 m\"\n",
        "yaw_radius = \"1.4 m\"\nwheelbase = \"2.6 m\"\ntrack = \"1.5 m\"\ncg_to_front_axle = \"1.2 m\"\n",
    );
    let estimated = run(&read(&text), 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    let density = |v: f64| {
        let way = (0.66 * v).powi(2) / (2.0 * 0.7 * 9.80665);
        (-0.5 * ((15.0 - way) / 2.0).powi(2)).exp()
    };
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
}

/// ΔV₁ = (1 + e) m₂ v₁/(m₁ + m₂) = 0.44 v₁: a recorder has an error of Student's t with 3 degrees of freedom.
#[test]
fn a_recorder_tells_the_speed() {
    let text = format!(
        "{CENTRAL}[vehicle1.recorder]\ndelta_v_longitudinal = \"-24 km/h\"\ndelta_v_error = \"6 %\"\n"
    );
    let estimated = run(&read(&text), 128).unwrap();
    let density = |v: f64| {
        let z = ((24.0 / 3.6) / (0.44 * v)).ln() / 0.06;
        (1.0 + z * z / 3.0).powi(-2)
    };
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
    // Above the median is half of it.
    let found = of(&estimated, speed(VehicleId::One)).posterior.median.value;
    let above = estimated.probability_above(speed(VehicleId::One), found).unwrap();
    assert!((above.value - 0.5).abs() < 0.01);
}

/// A limit cuts the prior off, and the speed that is sought is said not to be used.
#[test]
fn a_limit_holds() {
    let text = CENTRAL
        .replacen(
            "[vehicle1]",
            "[vehicle1]\nspeed = \"300 km/h\"\ncertain_speed = { at_most = \"10 m/s\" }",
            1,
        )
        .replace("[impact]", "[reconstruct]\nfind = \"vehicle1.speed\"\n[impact]");
    let text = format!("{text}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n");
    let estimated = run(&read(&text), 128).unwrap();
    assert!(estimated.draws(speed(VehicleId::One)).unwrap().iter().all(|v| *v <= 10.0));
    assert_eq!(estimated.unused, [Unused { key: "vehicle1.speed".to_owned(), reason: UnusedReason::Sought }]);
}

#[test]
fn what_excludes_everything_is_named() {
    // Vehicle 1 is behind vehicle 2, and slower.
    let apart = CENTRAL.replace("speed = \"0 km/h\"", "speed = \"20 km/h\"").replacen(
        "[vehicle1]",
        "[vehicle1]\ncertain_speed = { at_most = \"10 km/h\" }",
        1,
    );
    let refusal = run(&read(&apart), 128).unwrap_err().to_string();
    assert!(refusal.contains("do not approach each other"), "{refusal}");
}

/// Of two unknown speeds hardly any lies in a sliver: too few draws to go on from, and the run says so.
#[test]
fn a_run_that_has_not_converged_says_so() {
    let text = CENTRAL.replace("prior = \"flat\"", "").replace("speed = \"0 km/h\"", "").replacen(
        "[vehicle1]",
        "[vehicle1]\ncertain_speed = { at_least = \"30 m/s\", at_most = \"30.02 m/s\" }",
        1,
    );
    match run(&read(&text), 128) {
        Ok(estimated) => assert!(!estimated.doubts().is_empty()),
        Err(failure) => assert!(failure.to_string().contains("nearly every"), "{failure}"),
    }
}

/// A coefficient without a range is not taken as exact, and one with a range is used.
#[test]
fn coefficients_without_a_range_are_open() {
    let text = CENTRAL.replace("restitution = { value = 0.1, sd = 0.00001 }", "restitution = 0.1").replace(
        "tangential = { friction = { value = 0.7, sd = 0.0001 } }",
        "tangential = { friction = 0.7 }",
    );
    let text = format!("{text}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n");
    let estimated = run(&read(&text), 128).unwrap();
    let unused: Vec<&str> = estimated.unused.iter().map(|unused| unused.key.as_str()).collect();
    assert_eq!(unused, ["impact.restitution", "impact.tangential"]);
    let spread = |estimated: &Estimated| {
        let ends = of(estimated, EstimateOutput::Restitution).posterior.intervals[3];
        ends.high.value - ends.low.value
    };
    assert!(spread(&estimated) > 0.05);
}

/// What the motion to rest is asked for, without saying of which proposals it is not needed.
struct Whole<'a>(&'a Told<'a>);

impl ::estimate::Evidence for Whole<'_> {
    fn terms_count(&self) -> usize {
        self.0.terms_count()
    }

    fn log_likelihood(
        &self,
        values: &[::uncertainty::Lanes],
        terms: &mut [::uncertainty::Lanes],
        reasons: &mut [u8; ::uncertainty::LANES],
    ) {
        self.0.log_likelihood(values, terms, reasons);
    }
}

/// Vehicles are not followed to rest in proposals that are refused without it, and the draws stay the same.
#[test]
fn proposals_that_are_refused_need_no_rest() {
    let after = |x: &str| {
        format!(
            "drag = 0.5\nrest = {{ x = \"{x}\", y = \"0.2 m\", heading = \"4 deg\" }}\npoints = [{{ x = \"3 m\", y = \"0 m\" }}]\n"
        )
    };
    let text = format!(
        "{CENTRAL}[scene]\ncontact = {{ x = \"0 m\", y = \"0 m\" }}\n[surface]\nfriction = 0.7\n\
         [vehicle1.after]\n{}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n{}",
        after("5 m"),
        after("14 m")
    );
    let text = text.replace("yaw_radius", "class = 3\nyaw_radius");
    let setup = setup::of(&read(&text), None).unwrap();
    let model = Model::of(setup.impacts, setup.observed);
    for id in VehicleId::ALL {
        assert!(model.pieces().contains(&Piece::Rest(id)) && model.pieces().contains(&Piece::Points(id)));
    }
    let told = Told::new(&model, inputs::Axes::ZUp, setup.reference);
    let settings = Settings { islands: 4, ..Settings::new(128, 1) };
    let in_parts = ::estimate::sample_quietly(&told, &told, &settings).unwrap();
    let whole = ::estimate::sample_quietly(&told, &Whole(&told), &settings).unwrap();
    assert_eq!(in_parts.values(), whole.values());
    assert_eq!(in_parts.terms(), whole.terms());
}
