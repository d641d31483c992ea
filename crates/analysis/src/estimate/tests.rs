//! Estimates of cases whose answers are known from elsewhere.
#![allow(clippy::disallowed_methods, reason = "expected values may differ between machines by rounding")]

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use ::estimate::ParticleSettings;
use case::CaseFile;
use evidence::CrushErrors;
use inputs::{Case, SeverityPrior};

use super::*;
use crate::columns::tests::{AnyCase, FORMS, any_case};
use crate::output::Output;
use crate::quantities::{
    CRUSH_ENERGY, DELTA_V, IMPACT_IMPULSE_RATIO, IMPACT_RESTITUTION, PDOF, SKID_SPEED, SPEED,
};

fn read(text: &str) -> Case {
    CaseFile::parse("test.toml", text).unwrap().case
}

fn run(case: &Case, particles: usize) -> Result<Estimated, Failure> {
    let plan = EstimatePlan { particles, seed: 1, prior: None, pieces: PieceDetail::Weighed };
    estimate(case, &plan, &mut |_, _, _| ControlFlow::Continue(()))
}

fn speed(vehicle: VehicleId) -> Output {
    SPEED.of_vehicle(vehicle)
}

fn of(estimated: &Estimated, output: Output) -> &EstimatedOutput {
    estimated.outputs.iter().find(|found| found.output == output).unwrap()
}

/// Vehicle 1 runs squarely into the rear of vehicle 2, which stands: the geometry is all but exact.
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

/// A car meets a wall squarely under a force at an angle: a ratio of the other sign is the mirror image of
/// the collision, and so are z-down axes.
#[test]
fn a_ratio_of_the_other_sign_is_the_mirror_image() {
    let found = |ratio: f64, axes: &str| {
        let text = format!(
            "[scene]\naxes = \"{axes}\"\n[vehicle1]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\n\
             contact = {{ x = \"2 m\", y = \"0 m\" }}\n[vehicle1.crush]\nside = \"front\"\nwidth = \"1.6 m\"\n\
             depths = \"0.4 0.4 m\"\nstiffness = {{ category = 3 }}\n[vehicle2]\nfixed = true\n\
             [impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = {{ ratio = {ratio} }}\n\
             [reconstruct]\nfind = \"vehicle1.speed\"\nenergy_basis = \"absorbed\"\n"
        );
        let estimated = run(&read(&text), 512).unwrap();
        let ratio = of(&estimated, IMPACT_IMPULSE_RATIO.of_collision()).posterior.median.value;
        [ratio, of(&estimated, PDOF.of_vehicle(VehicleId::One)).posterior.median.value]
    };
    let [ratio, pdof] = found(0.3, "z-up");
    assert!(ratio > 0.2 && pdof.abs() > 0.1, "{ratio} {pdof}");
    // A wall at right angles to the x axis is its own mirror image. The PDOF is clockwise in all axes.
    for (sign, axes, [of_ratio, of_pdof]) in
        [(-1.0, "z-up", [-1.0, -1.0]), (-1.0, "z-down", [-1.0, 1.0]), (1.0, "z-down", [1.0, -1.0])]
    {
        let other = found(sign * 0.3, axes);
        assert!((other[0] - of_ratio * ratio).abs() < 0.02 * ratio.abs(), "{sign} {axes}: {other:?} {ratio}");
        assert!((other[1] - of_pdof * pdof).abs() < 0.05 * pdof.abs(), "{sign} {axes}: {other:?} {pdof}");
    }
}

/// Estimates of two vehicles with unknown speeds from crush and a coded PDOF were tested on field data.
#[test]
fn the_judged_collisions_are_named() {
    let vehicle = |n: u8, heading: u16, pdof: &str| {
        format!(
            "[vehicle{n}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"{heading} deg\"\n\
             contact = {{ x = \"2 m\", y = \"0 m\" }}\n[vehicle{n}.crush]\nside = \"front\"\nwidth = \"1.6 m\"\n\
             depths = \"0.4 0.4 m\"\nstiffness = {{ category = 3 }}\n{pdof}"
        )
    };
    let tested = |pdof: &str, rest: &str| {
        let text = format!(
            "{}{rest}{}[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = {{ friction = 0.5 }}\n",
            vehicle(1, 0, pdof),
            vehicle(2, 180, "")
        );
        run(&read(&text), 128).unwrap().tested.map(|class| class.code)
    };
    assert_eq!(tested("pdof = \"0 deg\"\n", ""), Some("two-fronts"));
    assert_eq!(tested("", ""), None);
    assert_eq!(
        tested("pdof = \"0 deg\"\n", "[vehicle1.recorder]\ndelta_v_longitudinal = \"-40 km/h\"\n"),
        Some("recorder")
    );
    assert_eq!(tested("pdof = \"0 deg\"\n", "[vehicle1.recorder]\nspeed = \"40 km/h\"\n"), None);
    // No car was as old as CRASH3's table.
    let of_year = |year: u16| {
        let text = format!(
            "{}{}[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = {{ friction = 0.5 }}\n",
            vehicle(1, 0, "pdof = \"0 deg\"\n"),
            vehicle(2, 180, "")
        );
        let text = text.replacen("[vehicle1]\n", &format!("[vehicle1]\nmodel_year = {year}\n"), 1);
        run(&read(&text), 128).unwrap().tested.map(|class| class.code)
    };
    assert_eq!((of_year(1991), of_year(2009), of_year(2019)), (None, None, None));
    assert_eq!((of_year(2010), of_year(2018)), (Some("two-fronts"), Some("two-fronts")));
    // With the stiffness of the fleet the age was never counted.
    let of_fleet = |text: String| run(&read(&text), 128).unwrap().tested.map(|class| class.code);
    let fleet = |year: u16| {
        let vehicles = vehicle(1, 0, "pdof = \"0 deg\"\n") + &vehicle(2, 180, "");
        let dated = vehicles.replacen("[vehicle1]\n", &format!("[vehicle1]\nmodel_year = {year}\n"), 1);
        dated.replace("{ category = 3 }", "\"fleet\"")
            + "[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = { friction = 0.5 }\n"
    };
    let codes = [1990, 1991, 2018, 2019].map(|year| of_fleet(fleet(year)));
    assert_eq!(codes, [None, Some("two-fronts-fleet"), Some("two-fronts-fleet"), None]);
    // Nobody tested one of each.
    assert_eq!(of_fleet(fleet(2015).replacen("\"fleet\"", "{ category = 3 }", 1)), None);
    // Nor was an assumption of the analyst's own tested, or another law.
    for own in
        ["crush_error = \"40 %\"", "crush_bias = \"90 %\"", "delta_v_median = \"20 km/h\"", "stood = \"5 %\""]
    {
        assert_eq!(tested("pdof = \"0 deg\"\n", &format!("[estimate]\n{own}\n")), None, "{own}");
    }
    assert_eq!(tested("pdof = { value = \"0 deg\", sd = \"0.5 deg\" }\n", ""), None);
    let recorder = "[vehicle1.recorder]\ndelta_v_longitudinal = \"-40 km/h\"\ndelta_v_error = \"1 %\"\n";
    assert_eq!(tested("pdof = \"0 deg\"\n", recorder), None);
    // The age counts for a stiffness by category alone: RICSAC's cars have stiffnesses of their own.
    let staged = |id: u8, heading: u16| {
        vehicle(id, heading, "").replace("category = 3", "A = \"300 N/cm\", B = \"40 N/cm^2\"")
            + &format!("[vehicle{id}.after]\nspeed = \"10 km/h\"\ndirection = \"0 deg\"\n")
    };
    let text = format!(
        "{}{}[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = {{ friction = 0.5 }}\n",
        staged(1, 0).replacen("[vehicle1]\n", "[vehicle1]\nmodel_year = 1974\n", 1),
        staged(2, 180)
    );
    let tested = run(&read(&text), 128).unwrap().tested.map(|class| class.code);
    assert_eq!(tested, Some("velocities-after"));
}

/// A piece that contradicts the rest leaves too few draws to show how far it is off: a run without it does.
#[test]
fn a_contradiction_is_found_without_the_answers_by_each_piece() {
    let text = format!(
        "{CENTRAL}[vehicle1.recorder]\nspeed = \"100 km/h\"\nspeed_error = \"1 %\"\n\
         [vehicle2.recorder]\ndelta_v_longitudinal = \"12 km/h\"\n[vehicle1.certain_speed]\nat_least = \"20 km/h\"\n"
    );
    let case = read(&text);
    let p_values = |pieces: PieceDetail| {
        let plan = EstimatePlan { particles: 256, seed: 1, prior: None, pieces };
        let estimated = estimate(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
        assert_eq!(
            estimated.pieces.iter().any(|piece| piece.without.is_some()),
            pieces == PieceDetail::Apart
        );
        estimated.pieces.iter().map(|piece| piece.p_value.map(|p| p.value)).collect::<Vec<_>>()
    };
    let of_draws = p_values(PieceDetail::Weighed);
    let compared = p_values(PieceDetail::Compared);
    assert!(of_draws.iter().any(Option::is_none), "{of_draws:?}");
    // 100 km/h give vehicle 2 a ΔV of 100 · 1.1 · 0.6 = 66 km/h.
    assert!(compared.iter().flatten().any(|p| *p < 0.01), "{compared:?}");
}

/// The quantile of a density at equal steps.
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

fn assert_is_quantiles(found: &DrawsSummary, density: impl Fn(f64) -> f64, range: [f64; 2]) {
    let ends = found.intervals[3];
    for (ours, share) in [(ends.low, 0.025), (found.median, 0.5), (ends.high, 0.975)] {
        let exact = quantile(&density, range, share);
        let error = ours.standard_error.unwrap();
        assert!((ours.value - exact).abs() < 4.0 * error + 1e-3 * exact, "{ours:?} {exact}");
        assert!(error < 0.05 * exact, "{ours:?} tells nothing");
    }
}

/// The error of a speed y compared with x, with a standard deviation of √(σ²y² + (1 km/h)²): the integral of
/// σ dy/√(σ²y² + a²), in another form than the engine's.
fn scaled(y: f64, x: f64, sd: f64) -> f64 {
    let a = 1.0 / 3.6;
    (sd * y / a).asinh() - (sd * x / a).asinh()
}

/// V₂ = (1 + e) m₁ v₁/(m₁ + m₂) = 0.66 v₁, and 11 m/s were measured, ± 12 % in the logarithm.
#[test]
fn the_speed_after_tells_that_before() {
    let case = read(&format!("{CENTRAL}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n"));
    let estimated = run(&case, 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    assert_eq!(estimated.default_errors, ["vehicle2.after.speed", "vehicle2.after.direction"]);
    let density = |v: f64| (-0.5 * (scaled(11.0, 0.66 * v, 0.12) / 0.12).powi(2)).exp();
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
}

/// 60 m of skid at 0.7 from 15 m/s end a speed of √(15² + 2·0.7·g·60) = 32 m/s, twice what the recorder
/// stored before the impact; 2 m are √(15² + 2·0.7·g·2) = 15.9 m/s, within its error.
#[test]
fn a_skid_faster_than_the_record_is_doubted() {
    let found = |length: u8| {
        let text = format!(
            "{CENTRAL}[vehicle1.before]\nskid = {{ length = \"{length} m\", friction = 0.7 }}\n[vehicle1.recorder]\n\
             pre_crash = {{ time = \"-2 -1 0 s\", speed = \"54 54 54 km/h\" }}\n\
             [vehicle2.after]\nspeed = \"9.9 m/s\"\ndirection = \"0 deg\"\n"
        );
        let estimated = run(&read(&text), 128).unwrap();
        assert!(estimated.default_errors.contains(&"vehicle1.recorder.errors".to_owned()));
        // With an error of its own for the speed, none is taken by default.
        let given = text.replacen("pre_crash", "speed_error = \"3 %\"\npre_crash", 1);
        assert!(!of_case(&given).default_errors.contains(&"vehicle1.recorder.errors".to_owned()));
        estimated.warnings.into_iter().find_map(|warning| match warning {
            Warning::SkidAboveRecord { vehicle, recorded, found } => Some((vehicle, recorded, found)),
            _ => None,
        })
    };
    let (vehicle, recorded, speed) = found(60).unwrap();
    assert_eq!(vehicle, VehicleId::One);
    assert!((recorded - 15.0).abs() < 1e-9 && (28.0..32.0).contains(&speed), "{recorded} {speed}");
    assert_eq!(found(2), None);
}

/// The ΔV of both vehicles are in the ratio of the masses: either both are told, or neither is.
#[test]
fn both_delta_v_are_told_together() {
    let estimated = run(&read(&format!("{CENTRAL}[vehicle1.crush]\nees = \"25 km/h\"\n")), 128).unwrap();
    let [one, two] = VehicleId::ALL.map(|id| of(&estimated, DELTA_V.of_vehicle(id)).is_told());
    assert_eq!(one, two);
}

/// A moment restitution of −1 is no moment impulse: what is not said of restitution and friction stays open.
#[test]
fn a_moment_restitution_without_moment_changes_nothing() {
    let text = CENTRAL
        .replace("{ value = 0.1, sd = 0.00001 }", "0.1")
        .replace("{ friction = { value = 0.7, sd = 0.0001 } }", "\"critical\"")
        + "[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n";
    let with = |line: &str| {
        let case = read(&text.replacen("[impact]\n", &format!("[impact]\n{line}"), 1));
        let estimated = run(&case, 128).unwrap();
        let keys: Vec<String> = estimated.unknown.iter().map(|unknown| unknown.key.clone()).collect();
        let medians = estimated.outputs.iter().map(|output| output.posterior.median.value.to_bits());
        (keys, medians.collect::<Vec<_>>())
    };
    let without = with("");
    assert!(without.0.contains(&"impact.restitution".to_owned()), "{:?}", without.0);
    assert_eq!(with("moment_restitution = -1\n"), without);
    assert_ne!(with("moment_restitution = 0.5\n"), without);
}

/// Without residual crush the damage only says that the impact took no more than w A²/2B of both: with b = 0,
/// P(W ≤ E) = Φ(ln(E/W)/σ).
#[test]
fn without_residual_crush_the_speed_has_only_an_upper_bound() {
    let crush = |side: &str| {
        format!(
            "side = \"{side}\"\nwidth = \"1.5 m\"\ndepths = \"0 0 cm\"\nstiffness = {{ A = \"400 N/cm\", B = \"40 N/cm^2\" }}\n"
        )
    };
    let text = format!("{CENTRAL}[vehicle1.crush]\n{}[vehicle2.crush]\n{}", crush("front"), crush("rear"))
        .replace("prior = \"flat\"", "prior = \"flat\"\ncrush_error = \"25 %\"");
    let estimated = run(&read(&text), 256).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    assert!(estimated.is_bound() && estimated.tested.is_none());
    let energy = 2.0 * 1.5 * 40e3_f64.powi(2) / (2.0 * 400e3);
    let below = |z: f64| {
        let steps = 400;
        let step = (z + 9.0).max(0.0) / f64::from(steps);
        (0..steps).map(|k| step * (-0.5 * ((f64::from(k) + 0.5) * step - 9.0).powi(2)).exp()).sum::<f64>()
    };
    let density = |v: f64| below((energy / (297.0 * v * v)).ln() / 0.25);
    let found = &of(&estimated, speed(VehicleId::One)).posterior;
    let ends = found.intervals[3];
    for (ours, share) in [(ends.low, 0.025), (found.median, 0.5), (ends.high, 0.975)] {
        // Slower approaches are no collisions.
        let exact = quantile(density, [evidence::LEAST_APPROACH, 70.0], share);
        let error = ours.standard_error.unwrap();
        assert!((ours.value - exact).abs() < 4.0 * error + 1e-3 * exact, "{ours:?} {exact}");
    }
    // The solution that takes the bound for the energy is near the upper end.
    let bound = (energy / 297.0_f64).sqrt();
    assert!(found.median.value < 0.7 * bound && ends.high.value > 0.9 * bound, "{bound}");
    // One vehicle with crush makes it a measurement again.
    let text = text.replacen("0 0 cm", "0 5 cm", 1);
    assert!(!run(&read(&text), 128).unwrap().is_bound());
}

/// A quarter of 640 is not a valid number of particles of an island.
#[test]
fn every_number_of_particles_that_an_island_can_have_runs() {
    let case = read(&format!("{CENTRAL}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n"));
    assert!(::estimate::ParticleSettings::can_have(640) && !::estimate::ParticleSettings::can_have(160));
    let estimated = run(&case, 640).unwrap();
    assert!(estimated.draws_before(speed(VehicleId::One)).is_some());
}

/// ½ (1 − e²) m₁m₂/(m₁ + m₂) v² = 297 v² J, which the crush of EES 20 km/h and 30 km/h only determines within
/// the misfit.
#[test]
fn the_crush_energy_tells_the_speed() {
    let crushes = "[vehicle1.crush]\nees = \"20 km/h\"\n[vehicle2.crush]\nees = \"30 km/h\"\n";
    let text =
        format!("{CENTRAL}{crushes}").replace("prior = \"flat\"", "prior = \"flat\"\ncrush_error = \"25 %\"");
    let estimated = run(&read(&text), 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    // E = ½ m EES²
    let energy = 0.5 * (1500.0 * (20.0_f64 / 3.6).powi(2) + 1000.0 * (30.0_f64 / 3.6).powi(2));
    // An EES is all of the deformation energy.
    let bias = 0.0;
    let density = |v: f64| (-0.5 * (((energy / (297.0 * v * v)).ln() - bias) / 0.25).powi(2)).exp();
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
    let crush = of(&estimated, CRUSH_ENERGY.of_collision());
    assert!((crush.posterior.median.value - energy).abs() < 1e-3 * energy);
}

/// The crush of vehicle 1 alone: ½ m EES² and r times that absorbed 297 v² J, where r is log-normal.
#[test]
fn the_crush_of_one_vehicle_tells_the_speed() {
    for (known, mass, damage) in [("vehicle1", 1500.0, ""), ("vehicle2", 1000.0, "side = \"rear\"\n")] {
        let text = format!("{CENTRAL}[{known}.crush]\nees = \"25 km/h\"\n{damage}")
            .replace("prior = \"flat\"", "prior = \"flat\"\ncrush_error = \"25 %\"");
        let estimated = run(&read(&text), 256).unwrap();
        assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
        assert_eq!(estimated.unused, []);
        let [one, other] = if known == "vehicle1" { ["1", "2"] } else { ["2", "1"] };
        let key = format!("vehicle{other}.crush_by_vehicle{one}");
        let ratio = estimated.unknown.iter().find(|unknown| unknown.key == key).unwrap();
        assert_eq!(ratio.assumed, Some(Assumed::OtherCrush));
        let energy = 0.5 * mass * (25.0_f64 / 3.6).powi(2);
        let (bias, tau) = (0.0, evidence::FITTED.other_crush_ln_sd);
        // Front against rear: equal in the median.
        let density = |v: f64| {
            let of_ratio = |z: f64| {
                let error = (energy * (1.0 + (tau * z).exp()) / (297.0 * v * v)).ln() - bias;
                (-0.5 * (error / 0.25).powi(2) - 0.5 * z * z).exp()
            };
            (-50..=50).map(|k| of_ratio(0.1 * f64::from(k))).sum::<f64>()
        };
        assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
    }
}

/// Sides absorb less than the fronts that they meet, and a crush inferred from the other does not count.
#[test]
fn the_ratio_of_the_crush_energies_is_that_of_the_sides_that_met() {
    let median = |text: &str| {
        let setup = of_case(text);
        let ratio = setup.unknown.iter().find(|unknown| unknown.assumed == Some(Assumed::OtherCrush));
        ratio.map(|ratio| (ratio.key.clone(), ratio.prior.quantile(0.5)))
    };
    let sideways = CENTRAL
        .replacen("heading = { value = \"0 deg\"", "heading = { value = \"0.0 deg\"", 1)
        .replace("heading = { value = \"0 deg\"", "heading = { value = \"90 deg\"");
    let side = evidence::FITTED.side_crush;
    for (text, known, expected) in
        [(CENTRAL, 1, 1.0), (CENTRAL, 2, 1.0), (&sideways, 1, side), (&sideways, 2, 1.0 / side)]
    {
        let text = format!("{text}[vehicle{known}.crush]\nees = \"25 km/h\"\n");
        let (key, median) = median(&text).unwrap();
        assert_eq!(key, format!("vehicle{}.crush_by_vehicle{known}", 3 - known));
        assert!((median - expected).abs() < 1e-9, "{median} {expected}");
    }
    let both = format!("{CENTRAL}[vehicle1.crush]\nees = \"25 km/h\"\n[vehicle2.crush]\nees = \"25 km/h\"\n");
    assert_eq!(median(&both), None);
    // Without damage on the only vehicle whose damage is known, there is nothing to compare.
    let undamaged = CENTRAL.replacen("[vehicle1]", "[vehicle1]\ncrush = \"none\"", 1);
    assert_eq!(median(&undamaged), None);
    assert!(of_case(&undamaged).observed.crush.is_none());
}

/// A vehicle that is slowed and pushed to its right was hit from ahead on its left: tan α = 5/10, at 11
/// o'clock. Its own lateral axis points left, or right if z points down.
#[test]
fn a_recorder_shows_where_the_force_came_from() {
    for (axes, lateral) in [("", "-5 m/s"), ("[scene]\naxes = \"z-down\"\n", "5 m/s")] {
        let recorder = format!(
            "[vehicle2.recorder]\ndelta_v_longitudinal = \"-10 m/s\"\ndelta_v_lateral = \"{lateral}\"\n"
        );
        let setup = of_case(&format!("{CENTRAL}{recorder}{axes}"));
        let shown = setup.observed.vehicles[1].recorder.direction.unwrap().pdof;
        assert!((shown + 0.5_f64.atan()).abs() < 1e-12, "{axes:?} {shown}");
    }
}

/// 20 % of a yaw rate and at least 10 °/s, unless the case gives another error.
#[test]
fn the_error_of_a_recorded_yaw_rate_is_that_of_the_case() {
    for (lines, degrees, assumed) in [
        ("yaw_rate = \"-90 deg/s\"", 18.0, true),
        ("yaw_rate = \"30 deg/s\"", 10.0, true),
        ("yaw_rate = \"-90 deg/s\"\nyaw_rate_error = \"7 deg/s\"", 7.0, false),
    ] {
        let setup = of_case(&format!("{CENTRAL}[vehicle2.recorder]\n{lines}\n"));
        let error = setup.observed.vehicles[1].recorder.yaw_rate.unwrap().sd;
        assert!((error - degrees * std::f64::consts::PI / 180.0).abs() < 1e-12, "{lines}: {error}");
        let key = "vehicle2.recorder.yaw_rate_error".to_owned();
        assert_eq!(setup.default_errors.contains(&key), assumed, "{lines}");
    }
}

/// v_b² = v² + 2 μ g d with v = V₂/0.66: the recorder's 25 m/s at the start of 20 m of marks.
#[test]
fn the_speed_before_a_skid_tells_that_at_the_impact() {
    let text = format!(
        "{CENTRAL}[vehicle1.before]\nskid = {{ length = \"20 m\", friction = 0.7 }}\nspeed = \"25 m/s\"\n"
    );
    let estimated = run(&read(&text), 256).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    assert_eq!(estimated.default_errors, ["vehicle1.before.speed"]);
    let begins = |v: f64, z: f64| (v * v + 2.0 * 0.7 * (0.10 * z).exp() * 9.80665 * 20.0).sqrt();
    let density = |v: f64| {
        let of_factor =
            |z: f64| (-0.5 * (scaled(25.0, begins(v, z), 0.04) / 0.04).powi(2) - 0.5 * z * z).exp();
        (-50..=50).map(|k| of_factor(0.1 * f64::from(k))).sum::<f64>()
    };
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
    // It is a result, too.
    let begin = of(&estimated, SKID_SPEED.of_vehicle(VehicleId::One));
    assert_eq!(begin.output.path(), "vehicle1.skid.speed");
    assert!((begin.posterior.median.value - 25.0).abs() < 0.5, "{begin:?}");
    // With a range, the errors are those of the case.
    let ranged = text
        .replace("\"20 m\"", "{ value = \"20 m\", sd = \"2 m\" }")
        .replace("friction = 0.7 }\n", "friction = { value = 0.7, sd = 0.1 } }\n")
        .replace("speed = \"25 m/s\"", "speed = { value = \"25 m/s\", sd = \"2 m/s\" }");
    let setup = of_case(&ranged);
    assert!((setup.observed.vehicles[0].skid_speed.unwrap().ln_sd - 0.08).abs() < 1e-12);
    let keys: Vec<&str> = setup.unknown.iter().map(|unknown| unknown.key.as_str()).collect();
    for key in ["vehicle1.before.skid.length", "vehicle1.before.skid.friction"] {
        assert!(keys.contains(&key), "{keys:?}");
    }
    // On the ground of [surface], the friction is that of both vehicles.
    let ground =
        text.replace(", friction = 0.7", "").replace("[impact]", "[surface]\nfriction = 0.7\n[impact]");
    let setup = of_case(&ground);
    assert!(setup.unknown.iter().any(|unknown| unknown.key == "surface.friction"));
    assert!(setup.impacts.skids[0].unwrap().factor.is_some());
}

/// Vehicle 2, whose CG was at the origin, slides 15 m straight on with locked wheels.
const REST: &str = r#"
[scene]
contact = { x = "-2 m", y = "0 m" }
[surface]
friction = { value = 0.7, sd = 0.00001 }
[vehicle2.after]
drag = "locked"
rest = { x = "15 m", y = "0 m", heading = "0 deg" }
"#;

fn at_rest(rest: &str) -> String {
    format!("{CENTRAL}{rest}").replace(
        "yaw_radius = \"1.4 m\"\n",
        "yaw_radius = \"1.4 m\"\nwheelbase = \"2.6 m\"\ntrack = \"1.5 m\"\ncg_to_front_axle = \"1.2 m\"\n",
    )
}

/// The logarithm of the likelihood that 15 m were measured of a path of this length (m), ± 0.5 m and 10 % of
/// either, by the geometric mean of both.
fn of_15_m(way: f64) -> f64 {
    -0.5 * (15.0 - way).powi(2) / (2.0 * (0.5 + 0.1 * way))
}

/// Vehicle 2 slides straight to rest on locked wheels, S = V₂²/2μg, where 15 m were measured.
#[test]
fn the_rest_tells_the_speed() {
    let estimated = run(&read(&at_rest(REST)), 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    let density = |v: f64| {
        let way = (0.66 * v).powi(2) / (2.0 * 0.7 * 9.80665);
        of_15_m(way).exp()
    };
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
}

/// Vehicle 2 slides straight on: a mark of its left wheels lies 0.75 m to the left of the path of its CG.
#[test]
fn a_tyre_mark_is_that_of_its_wheel() {
    for (wheel, miss) in [("", 0.75), (", wheel = \"rear left\"", 0.0), (", wheel = \"rear right\"", 1.5)] {
        let rest = REST
            .replace("rest = {", &format!("points = [{{ x = \"6 m\", y = \"0.75 m\"{wheel} }}]\nrest = {{"));
        let setup = of_case(&at_rest(&rest));
        let mut values = vec![::uncertainty::Lanes::ZERO; setup.impacts.unknown.0.len()];
        for (column, distribution) in values.iter_mut().zip(&setup.impacts.unknown.0) {
            distribution.from_standard_normals(column);
        }
        // 21 m/s of the prior's 0 to 70 m/s take it well beyond 6 m.
        let place = setup.unknown.iter().position(|unknown| unknown.key == "vehicle1.speed").unwrap();
        values[place] = ::uncertainty::Lanes::splat(21.0);
        let impacts = evidence::Impacts::impacts(&setup.impacts, &values);
        let way = impacts[0].ways[1].as_ref().unwrap();
        assert!(way.position.x > 7.0);
        let [found] = way.misses.as_ref().unwrap()[..] else { panic!("{:?}", way.misses) };
        assert!((found - miss).abs() < 0.01, "{wheel} {found}");
    }
}

/// ΔV₁ = (1 + e) m₂ v₁/(m₁ + m₂) = 0.44 v₁: a recorder has an error of Student's t with 3 degrees of freedom.
#[test]
fn a_recorder_tells_the_speed() {
    let text = format!(
        "{CENTRAL}[vehicle1.recorder]\ndelta_v_longitudinal = \"-24 km/h\"\ndelta_v_error = \"6 %\"\n"
    );
    let estimated = run(&read(&text), 128).unwrap();
    let density = |v: f64| {
        // The error of a zero component is 1 km/h plus a twentieth of the whole.
        let a = (1.0 / 3.6_f64).hypot(0.05 * 0.44 * v);
        let z = ((0.06 * (24.0 / 3.6) / a).asinh() - (0.06 * 0.44 * v / a).asinh()) / 0.06;
        (1.0 + z * z / 3.0).powi(-2) / (0.06_f64 * (24.0 / 3.6)).hypot(a)
    };
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
    // Half of the probability lies above the median.
    let found = of(&estimated, speed(VehicleId::One)).posterior.median.value;
    let above = estimated.probability_above(speed(VehicleId::One), found).unwrap();
    assert!((above.value - 0.5).abs() < 0.01);
}

/// A limit truncates the prior, and the given value of the unknown speed is reported as unused.
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
    assert_eq!(estimated.certain, ["vehicle1.certain_speed"]);
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

/// With two unknown speeds, hardly any draw lies within narrow limits of both: too few to continue, as the
/// run reports. Narrow limits of one are no more than a speed that is nearly known.
#[test]
fn a_run_that_has_not_converged_says_so() {
    let open = CENTRAL.replace("prior = \"flat\"", "");
    let within = |low: &str, high: &str| {
        format!("certain_speed = {{ at_least = \"{low} m/s\", at_most = \"{high} m/s\" }}")
    };
    let narrow = open.replacen("[vehicle1]", &format!("[vehicle1]\n{}", within("30", "30.001")), 1);
    let one = run(&read(&narrow.replace("speed = \"0 km/h\"", "")), 128).unwrap();
    assert!(one.doubts().is_empty(), "{:?}", one.doubts());
    let speeds = one.draws(speed(VehicleId::One)).unwrap();
    assert!(speeds.iter().all(|v| (30.0..=30.001).contains(v)));
    let both = narrow.replace("speed = \"0 km/h\"", &within("20", "20.002"));
    match run(&read(&both), 128) {
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
    assert!(unused.is_empty(), "{unused:?}");
    let spread = |estimated: &Estimated| {
        let ends = of(estimated, IMPACT_RESTITUTION.of_collision()).posterior.intervals[3];
        ends.high.value - ends.low.value
    };
    assert!(spread(&estimated) > 0.05);
}

/// Evidence that always computes the motion to rest, also for proposals that do not need it.
struct Whole<'a>(&'a CollisionModel<CaseImpacts>);

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

/// Vehicles are not followed to rest in proposals that are refused anyway, and the draws stay the same.
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
    let model = CollisionModel::of(setup.impacts, setup.observed);
    for id in VehicleId::ALL {
        assert!(model.pieces().contains(&Piece::Rest(id)) && model.pieces().contains(&Piece::Points(id)));
    }
    let settings = ParticleSettings { islands: 4, ..ParticleSettings::new(128, 1) };
    let in_parts = ::estimate::sample_quietly(&model, &model, &settings).unwrap();
    let whole = ::estimate::sample_quietly(&model, &Whole(&model), &settings).unwrap();
    assert_eq!(in_parts.values(), whole.values());
    assert_eq!(in_parts.terms(), whole.terms());
}

/// Friction without a range is the value of its key times a factor with an ln-sd of 0.10.
#[test]
fn a_ground_of_one_value_has_the_error_of_such_a_value() {
    let text = at_rest(REST).replace("friction = { value = 0.7, sd = 0.00001 }", "friction = 0.7");
    let estimated = run(&read(&text), 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    let density = |v: f64| {
        let of_factor = |z: f64| {
            let way = (0.66 * v).powi(2) / (2.0 * 0.7 * (0.10 * z).exp() * 9.80665);
            (of_15_m(way) - 0.5 * z * z).exp()
        };
        (-50..=50).map(|k| of_factor(0.1 * f64::from(k))).sum::<f64>()
    };
    assert_is_quantiles(&of(&estimated, speed(VehicleId::One)).posterior, density, [1.0, 70.0]);
}

/// With the vehicle numbers exchanged, vehicle 2 is the one that drives.
#[test]
fn the_labels_of_the_vehicles_do_not_matter() {
    let text = format!("{CENTRAL}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n");
    let text = text.replace("vehicle1", "other").replace("vehicle2", "vehicle1").replace("other", "vehicle2");
    let estimated = run(&read(&text), 128).unwrap();
    assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
    let density = |v: f64| (-0.5 * ((11.0 / (0.66 * v)).ln() / 0.12).powi(2)).exp();
    assert_is_quantiles(&of(&estimated, speed(VehicleId::Two)).posterior, density, [1.0, 70.0]);
}

#[test]
fn a_least_speed_holds() {
    let text = CENTRAL.replacen("[vehicle1]", "[vehicle1]\ncertain_speed = { at_least = \"20 m/s\" }", 1);
    let text = format!("{text}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n");
    let estimated = run(&read(&text), 128).unwrap();
    assert!(estimated.draws(speed(VehicleId::One)).unwrap().iter().all(|v| *v >= 20.0));
}

fn of_case(text: &str) -> Setup {
    setup::of(&read(text), None).unwrap()
}

/// The variances of measurement errors and of model errors add up.
#[test]
fn errors_add_as_variances() {
    let crush = |pdof: &str| format!("{CENTRAL}[vehicle1.crush]\nees = \"20 km/h\"\npdof = \"{pdof}\"\n");
    let pdof = |text: &str| of_case(&crush(text)).observed.vehicles[0].pdof.unwrap();
    // 6°; an hour of the clock is 30° wide: 6² + 30²/12.
    assert!((pdof("30 deg").scale.to_degrees() - 6.0).abs() < 1e-9);
    let hour = pdof("1 o'clock");
    assert!((hour.pdof.to_degrees() - 30.0).abs() < 1e-9);
    assert!((hour.scale.to_degrees() - 111.0_f64.sqrt()).abs() < 1e-9);
    // 0.5 m and 10 % of 15 m for the model, 5° at least for the heading.
    let exact = of_case(&at_rest(REST)).observed.vehicles[1].rest.unwrap();
    assert!((exact.position_sd() - 2.0).abs() < 1e-9 && (exact.heading_sd.to_degrees() - 5.0).abs() < 1e-9);
    let measured = REST.replace(
        "rest = { x = \"15 m\", y = \"0 m\", heading = \"0 deg\" }",
        "[vehicle2.after.rest]\nx = { value = \"15 m\", sd = \"1 m\" }\ny = { value = \"0 m\", sd = \"2 m\" }\n\
         heading = { value = \"0 deg\", sd = \"8 deg\" }",
    );
    let measured = of_case(&at_rest(&measured)).observed.vehicles[1].rest.unwrap();
    // 2² + (1² + 2²)/2 and 5² + 8²
    assert!((measured.position_sd() - 6.5_f64.sqrt()).abs() < 1e-9, "{measured:?}");
    assert!((measured.heading_sd.to_degrees() - 89.0_f64.sqrt()).abs() < 1e-9, "{measured:?}");
}

/// Smith and Noga (1982): 65 lb.
#[test]
fn a_mass_of_one_value_has_the_error_of_a_weight() {
    for (given, expected) in
        [("mass = \"1500 kg\"", 65.0 * 0.453_592_37), ("weight = \"3300 lb\"", 65.0 * 4.448_221_615_260_5)]
    {
        let text = CENTRAL.replace("mass = { value = \"1500 kg\", sd = \"0.01 kg\" }", given);
        let setup = of_case(&text);
        let key = format!("vehicle1.{}", given.split(' ').next().unwrap());
        let mass = setup.unknown.iter().find(|unknown| unknown.key == key).unwrap();
        let sd = mass.prior.sd() * mass.unit.unwrap().factor();
        assert!((sd - expected).abs() < 1e-6 * expected, "{given}: {sd}");
    }
}

#[test]
fn a_direction_turns_with_the_axes() {
    for (axes, sign) in [("z-up", 1.0), ("z-down", -1.0)] {
        let text = format!("[scene]\naxes = \"{axes}\"\n{CENTRAL}[vehicle2.after]\ndirection = \"30 deg\"\n");
        let direction = of_case(&text).observed.vehicles[1].after.direction.unwrap();
        assert!((direction.value.to_degrees() - sign * 30.0).abs() < 1e-9, "{axes}: {direction:?}");
        // To the right in z-down, to the left in z-up: the rest position has the sign of the case.
        let rest = REST.replace("y = \"0 m\", heading", "y = \"3 m\", heading");
        let text = at_rest(&rest).replace("[scene]", &format!("[scene]\naxes = \"{axes}\""));
        let text = text.replace(
            "heading = { value = \"0 deg\", sd = \"0.0001 deg\" }\ncontact",
            "heading = { value = \"11.31 deg\", sd = \"0.0001 deg\" }\ncontact",
        );
        let text = text.replace("crush_plane = { value = \"0 deg\"", "crush_plane = { value = \"11.31 deg\"");
        let estimated = run(&read(&text), 128).unwrap();
        let is_y = |output: &Output| output.path() == "vehicle2.rest.y";
        let y = estimated.outputs.iter().find(|found| is_y(&found.output)).unwrap();
        assert!((1.5..4.5).contains(&y.posterior.median.value), "{axes}: {:?}", y.posterior.median);
    }
}

/// The force on a vehicle that is hit from the left comes from 9 o'clock, that on one hit in the rear from 6.
#[test]
fn forces_come_from_where_the_vehicle_was_hit() {
    let [one, two] = of_case(CENTRAL).impacts.reference.map(f64::to_degrees);
    assert!(one.abs() < 1e-9 && (two.abs() - 180.0).abs() < 1e-9, "{one} {two}");
    let heading = "heading = { value = \"0 deg\", sd = \"0.0001 deg\" }\ncontact = { x = { value = \"-2 m\"";
    let left = CENTRAL.replace(heading, &heading.replace("\"0 deg\"", "\"90 deg\""));
    assert_ne!(left, CENTRAL);
    let [one, two] = of_case(&left).impacts.reference.map(f64::to_degrees);
    assert!(one.abs() < 1e-9 && (two + 90.0).abs() < 1e-9, "{one} {two}");
    // About 180°, and not half of the draws a full turn away.
    let estimated = run(&read(&format!("{CENTRAL}[vehicle2.after]\ndirection = \"0 deg\"\n")), 128).unwrap();
    let pdof = &of(&estimated, PDOF.of_vehicle(VehicleId::Two)).posterior;
    let [low, high] = [pdof.intervals[3].low.value, pdof.intervals[3].high.value];
    assert!((pdof.median.value.abs() - std::f64::consts::PI).abs() < 0.1 && high - low < 0.1, "{pdof:?}");
}

/// V₂ = 0.66 v₁ and ΔV₁ = 0.44 v₁: a recorder that stored the value for 11 m/s agrees, and one that stored
/// three times that does not.
#[test]
fn each_piece_is_judged_by_the_others() {
    for (stored, agrees) in [(7.33, true), (22.0, false)] {
        let text = format!(
            "{CENTRAL}[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n[vehicle1.recorder]\ndelta_v_longitudinal = \"-{stored} m/s\"\n"
        );
        let plan = EstimatePlan { particles: 128, seed: 1, prior: None, pieces: PieceDetail::Apart };
        let estimated = estimate(&read(&text), &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
        assert_eq!(estimated.pieces.len(), 3);
        for piece in estimated.pieces.iter().filter(|piece| !piece.key.contains("direction")) {
            let p = piece.p_value.unwrap().value;
            assert_eq!(p > 0.05, agrees, "{stored}: {p}");
            assert!(p <= 1.0);
            // By itself: 11/0.66 m/s, or 7.33/0.44.
            let alone = piece.alone.as_ref().unwrap()[0].as_ref().unwrap().median.value;
            let expected = if piece.key.contains("recorder") { stored / 0.44 } else { 11.0 / 0.66 };
            assert!((alone / expected - 1.0).abs() < 0.05, "{}: {alone}", piece.key);
            let without = piece.without.as_ref().unwrap()[0].as_ref().unwrap().median.value;
            let expected = if piece.key.contains("recorder") { 11.0 / 0.66 } else { stored / 0.44 };
            assert!((without / expected - 1.0).abs() < 0.05, "{}: {without}", piece.key);
        }
    }
}

/// The Debug text of the impacts of a block of draws of the prior, which shows any difference.
fn impacts_of(impacts: &CaseImpacts, seed: u64) -> Vec<String> {
    use evidence::Impacts;
    impacts.impacts(&columns_of(impacts, seed)).iter().map(|impacted| format!("{impacted:?}")).collect()
}

/// A block of draws of the prior.
fn columns_of(impacts: &CaseImpacts, seed: u64) -> Vec<::uncertainty::Lanes> {
    use ::uncertainty::random::{bits, unit};
    let mut columns = Vec::new();
    for (place, distribution) in (0..).zip(&impacts.unknown.0) {
        let mut column = ::uncertainty::Lanes::ZERO;
        for (lane, number) in (0..).zip(&mut column) {
            // Now and then far out, where the engine refuses.
            *number = 8.0 * unit(bits(seed, 1000 * place + lane)) - 4.0;
        }
        distribution.from_standard_normals(&mut column);
        columns.push(column);
    }
    columns
}

/// A block has the bits of its cases.
#[test]
fn a_block_is_its_cases() {
    let fixture = include_str!("../../../../fixtures/estimate.toml");
    let other = "
[scene]
axes = \"z-down\"
contact = { x = \"1 m\", y = \"2 m\" }
[surface]
friction = 0.7
[vehicle1]
weight = { value = \"3300 lb\", sd = \"300 lb\" }
class = 3
heading = { value = \"10 deg\", sd = \"3 deg\" }
contact = { distance = \"6 ft\", angle = { value = \"-15 deg\", sd = \"20 deg\" } }
yaw_rate = { value = \"10 deg/s\", sd = \"5 deg/s\" }
[vehicle1.crush]
side = \"front\"
width = { value = \"150 cm\", sd = \"5 cm\" }
depths = { values = \"10 14 20 24 26 30 cm\", sd = \"6 cm\" }
stiffness = { A = { value = \"40 kN/m\", sd = \"5 kN/m\" }, B = \"600 kN/m^2\" }
pdof = \"11 o'clock\"
[vehicle1.after]
drag = 0.6
rest = { x = \"5 m\", y = \"4 m\", heading = \"60 deg\" }
[vehicle2]
mass = { value = \"1400 kg\", sd = \"100 kg\" }
yaw_inertia = { value = \"2400 kg m^2\", sd = \"200 kg m^2\" }
heading = { value = \"95 deg\", sd = \"3 deg\" }
contact = { x = \"0.5 m\", y = { value = \"-0.8 m\", sd = \"0.1 m\" } }
velocity = { x = \"0 m/s\", y = { value = \"8 m/s\", sd = \"2 m/s\" } }
[vehicle2.crush]
ees = { value = \"20 km/h\", sd = \"6 km/h\" }
[impact]
crush_plane = { value = \"0 deg\", sd = \"8 deg\" }
restitution = { value = 0.1, sd = 0.05 }
tangential = { ratio = { value = -0.2, sd = 0.1 } }
[reconstruct]
find = \"vehicle1.speed\"
energy_basis = { tangential_share = { value = 0.5, sd = 0.2 } }
";
    let flat = fixture.replace(
        "[impact]",
        "[estimate]\nprior = \"flat\"\n[vehicle1.before]\nspeed = \"70 km/h\"\n\
         [vehicle1.before.skid]\nlength = { value = \"9 m\", sd = \"1 m\" }\nfriction = 0.7\n[impact]",
    );
    // The friction of the ground with a range, and that of the marks of the other vehicle without one.
    let skids = fixture.replace(
        "[impact]",
        "[surface]\nfriction = { value = 0.6, sd = 0.1 }\n[vehicle1.before]\nskid = { length = \"30 ft\" }\n\
         [vehicle2.before]\nskid = { length = \"4 m\", friction = 0.5 }\n[impact]",
    );
    let fraction =
        other.replace("ratio = { value = -0.2, sd = 0.1 }", "fraction = { value = 0.8, sd = 0.1 }");
    let absorbed = fixture.replace(
        "[impact]",
        "[reconstruct]\nfind = \"vehicle2.speed\"\nenergy_basis = \"absorbed\"\n[impact]",
    );
    let absorbed =
        absorbed.replacen("[vehicle1]", "[vehicle1]\nspeed = { value = \"50 km/h\", sd = \"9 km/h\" }", 1);
    let spaced = fixture.replacen("width = \"150 cm\"", "spacing = \"30 25 35 30 30 cm\"", 1);
    let burg = other.replacen(
        "yaw_inertia = { value = \"2400 kg m^2\", sd = \"200 kg m^2\" }",
        "wheelbase = { value = \"2.7 m\", sd = \"5 cm\" }\nlength = \"4.5 m\"",
        1,
    );
    let offset = fixture.replace("pdof = \"15 deg\"", "offset = { value = \"0 cm\", sd = \"3 cm\" }");
    let law = |law: &str| fixture.replace("restitution = 0.1\ntangential = \"critical\"", law);
    let woolley = law("law = \"woolley\"");
    let curve =
        law("restitution = { speeds = \"1 30 m/s\", values = [0.4, 0.2] }\ntangential = \"critical\"");
    for changed in [&spaced, &burg, &offset, &woolley, &curve] {
        assert!(changed != fixture && changed != other);
    }
    for text in
        [fixture, other, &flat, &skids, &fraction, &absorbed, &spaced, &burg, &offset, &woolley, &curve]
    {
        let mut impacts = of_case(text).impacts;
        assert!(impacts.block.is_some(), "{text}");
        let blocks: Vec<_> = (0..8).flat_map(|seed| impacts_of(&impacts, seed)).collect();
        impacts.block = None;
        let cases: Vec<_> = (0..8).flat_map(|seed| impacts_of(&impacts, seed)).collect();
        let possible = cases.iter().filter(|text| text.contains("is_possible: true")).count();
        assert!(possible > 50, "{possible} of {}", cases.len());
        for (block, case) in blocks.iter().zip(&cases) {
            assert_eq!(block, case, "{text}");
        }
        // The skid marks are read without a case as well.
        let skids = [0, 1].map(|i| impacts.skids[i].is_some());
        assert_eq!(skids, read(text).skids().map(|skid| skid.is_some()));
        for seed in 0..8 {
            let columns = columns_of(&impacts, seed);
            for lane in 0..::uncertainty::LANES {
                assert_eq!(impacts.marks(&columns)[lane], impacts.case_of(&columns, lane).skids());
            }
        }
    }
}

/// Errors that numbers share are left to the case.
#[test]
fn other_shapes_are_left_to_the_case() {
    let fixture = include_str!("../../../../fixtures/estimate.toml");
    let shared = format!(
        "{fixture}[[uncertainty.shared]]\nname = \"tape\"\nof = [\"vehicle1.crush.depths\"]\nsd = \"1 cm\"\n"
    );
    assert!(of_case(&shared).impacts.block.is_none());
}

/// Bias and error depend on how each energy was obtained, and the case may give both.
#[test]
fn a_crush_energy_errs_by_how_it_was_obtained() {
    let depths = |stiffness: &str| {
        format!(
            "side = \"front\"\nwidth = \"150 cm\"\ndepths = \"30 30 cm\"\noblique = \"none\"\nstiffness = {{ {stiffness} }}\n"
        )
    };
    let class = depths("category = 3");
    let given = depths("A = \"300 N/cm\", B = \"40 N/cm^2\"");
    let test = depths(
        "test = { mass = \"1500 kg\", speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 50 54 54 50 42 cm\", no_damage_speed = \"8 km/h\" }",
    );
    let ees = "side = \"front\"\nees = \"30 km/h\"\n".to_owned();
    let ranged = ees.replace("\"30 km/h\"", "{ value = \"30 km/h\", sd = \"2 km/h\" }");
    let dimensions = "length = \"4.4 m\"\nwidth = \"1.76 m\"\ncg_to_front = \"2.05 m\"\n";
    let errors = |one: &str, two: &str, estimate: &str| {
        let text = format!("{CENTRAL}[vehicle1.crush]\n{one}[vehicle2.crush]\n{two}")
            .replace("yaw_radius = \"1.4 m\"\n", &format!("yaw_radius = \"1.4 m\"\n{dimensions}"))
            .replace("prior = \"flat\"", &format!("prior = \"flat\"\n{estimate}"));
        of_case(&text).observed.crush.unwrap().0.map(|of| [of.bias, of.shared_ln_sd, of.own_ln_sd])
    };
    // docs/calibration.md, by category: β = −0.843, σ_c = 0.382 between fronts.
    let field = [-0.843, 0.382, 0.0];
    for (crush, expected) in [
        (&class, field),
        (&given, [0.0, 0.40, 0.30]),
        (&test, [0.0, 0.26, 0.0]),
        (&ees, [0.0, 0.20, 0.20]),
        (&ranged, [0.0, 0.20, 0.0]),
    ] {
        for (found, expected) in errors(crush, &class, "")[0].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{crush} {found} {expected}");
        }
    }
    // A car as old as the table has no bias, one of 1988 a third of that of the field.
    for (year, newer) in [(1950, 0.0), (1977, 0.0), (1988, 1.0 / 3.0), (2010, 1.0), (2024, 1.0)] {
        let text = format!("{CENTRAL}[vehicle1.crush]\n{class}[vehicle2.crush]\n{class}").replace(
            "yaw_radius = \"1.4 m\"\n",
            &format!("yaw_radius = \"1.4 m\"\n{dimensions}model_year = {year}\n"),
        );
        let found = of_case(&text).observed.crush.unwrap().0[0].bias;
        assert!((found - field[0] * newer).abs() < 1e-12, "{year} {found}");
    }
    let [one, two] = errors(&ees, &class, "crush_bias = \"50 %\"\ncrush_error = \"10 %\"");
    assert_eq!(one, two);
    for (found, expected) in one.iter().zip([0.5_f64.ln(), 0.10, 0.0]) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

/// The survey of a point and of a rest position is part of their errors: √(s² + (s_x² + s_y²)/2), where the
/// computed path has an error s of 0.5 m and 10 % of 6.2 m, or as given by the case.
#[test]
fn the_range_of_a_point_counts() {
    let sds = |sd: &str, estimate: &str| {
        let place =
            |at: &str| format!("{{ value = \"{at}\"{sd} }}").replace("{ value = \"6 m\" }", "\"6 m\"");
        let x = place("6 m");
        let rest = REST.replace("rest = {", &format!("points = [{{ x = {x}, y = \"0 m\" }}]\nrest = {{"));
        let text = at_rest(&rest).replace("prior = \"flat\"", &format!("prior = \"flat\"\n{estimate}"));
        let setup = of_case(&text);
        (setup.observed.vehicles[1].points[0], setup.default_errors)
    };
    let (exact, defaults) = sds("", "");
    assert!((exact - 1.1).abs() < 1e-12, "{exact}");
    for key in ["estimate.rest_error", "estimate.rest_least_error", "estimate.rest_heading_error"] {
        assert!(defaults.iter().any(|default| default == key), "{defaults:?}");
    }
    let (ranged, _) = sds(", sd = \"5 m\"", "");
    assert!((ranged - (1.1_f64 * 1.1 + 12.5).sqrt()).abs() < 1e-12, "{ranged}");
    let (given, defaults) = sds("", "rest_error = \"5 %\"\nrest_least_error = \"0.2 m\"");
    assert!((given - 0.5).abs() < 1e-12, "{given}");
    assert!(!defaults.iter().any(|default| default == "estimate.rest_error"), "{defaults:?}");
}

/// Vehicle 2 stands with a probability of 20 % or has any speed up to 70 m/s; V₂ = 0.66 v₁ + 0.34 v₂ was
/// measured. With 0.66 v₁ = 9.9 m/s: P(0) by a sum over v₂.
#[test]
fn a_vehicle_that_stood_has_a_probability() {
    let case = |after: f64, stood: &str| {
        let text = CENTRAL
            .replace("speed = \"0 km/h\"", "")
            .replacen("[vehicle1]", "[vehicle1]\nspeed = \"15 m/s\"", 1)
            .replace("prior = \"flat\"", &format!("prior = \"flat\"\n{stood}"));
        read(&format!("{text}[vehicle2.after]\nspeed = \"{after} m/s\"\ndirection = \"0 deg\"\n"))
    };
    for after in [9.0, 9.9, 11.0] {
        let estimated = run(&case(after, ""), 256).unwrap();
        assert!(estimated.doubts().is_empty(), "{:?}", estimated.doubts());
        let likelihood = |v2: f64| (-0.5 * (scaled(after, 9.9 + 0.34 * v2, 0.12) / 0.12).powi(2)).exp();
        // The vehicles approach at 0.3 m/s at least.
        let (steps, most) = (20_000, 14.7);
        let moving: f64 =
            (0..steps).map(|k| likelihood(most * (f64::from(k) + 0.5) / f64::from(steps))).sum::<f64>()
                * most
                / f64::from(steps);
        let exact = 0.2 * likelihood(0.0) / (0.2 * likelihood(0.0) + 0.8 * moving / 70.0);
        let stood = estimated.stood[1].unwrap();
        let error = stood.after.standard_error.unwrap();
        assert!((stood.after.value - exact).abs() < 4.0 * error + 0.005, "{after} {stood:?} {exact}");
        assert!(stood.assumed == 0.2 && estimated.stood[0].is_none());
        assert_eq!(of(&estimated, speed(VehicleId::Two)).posterior.intervals[3].low.value, 0.0);
    }
    let certain = run(&case(11.0, "stood = \"0 %\""), 128).unwrap();
    assert!(certain.stood[1].is_none());
    assert!(certain.draws(speed(VehicleId::Two)).unwrap().iter().all(|v| *v > 0.0));
}

/// Both speeds unknown: vehicle 1 ran into vehicle 2, which has its own probability of standing still, and in
/// none of the draws do both stand.
#[test]
fn of_two_unknown_speeds_each_may_be_zero() {
    let text = CENTRAL.replace("prior = \"flat\"", "").replace("speed = \"0 km/h\"", "");
    let estimated = run(&read(&text), 128).unwrap();
    let [one, two] = estimated.stood.map(Option::unwrap);
    assert_eq!(one.after.value, 0.0, "vehicle 1 has to be faster");
    // Before taking account of which of them collide, 20 % compared with the 60 % with both moving, of which
    // less than half have vehicle 1 faster by 0.3 m/s.
    assert!(two.after.value > 0.3 && two.after.value < 0.6, "{two:?}");
    let draws = |id| estimated.draws(speed(id)).unwrap();
    assert!(draws(VehicleId::One).iter().all(|v| *v > 0.0) && draws(VehicleId::Two).contains(&0.0));
}

fn p_value(estimated: &Estimated, key: &str) -> (f64, bool) {
    let piece = estimated.pieces.iter().find(|piece| piece.key == key).unwrap();
    (piece.p_value.unwrap().value, piece.reversed)
}

fn judged(text: &str) -> Estimated {
    let plan = EstimatePlan { particles: 128, seed: 1, prior: None, pieces: PieceDetail::Apart };
    estimate(&read(text), &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap()
}

/// Vehicle 2 is pushed straight on: an opposite direction, PDOF or sign contradicts that, the right ones
/// agree, and zero is a number like any other.
#[test]
fn what_points_the_other_way_contradicts() {
    let crush = "[vehicle1.crush]\nside = \"front\"\nees = \"30 km/h\"\n";
    for (lines, key, agrees) in [
        ("[vehicle2.after]\ndirection = \"0 deg\"\n", "vehicle2.after.direction", true),
        ("[vehicle2.after]\ndirection = \"180 deg\"\n", "vehicle2.after.direction", false),
        ("[vehicle1.recorder]\ndelta_v_longitudinal = \"-24 km/h\"\n", "vehicle1.recorder.delta_v", true),
        ("[vehicle1.recorder]\ndelta_v_longitudinal = \"24 km/h\"\n", "vehicle1.recorder.delta_v", false),
        (
            "[vehicle1.recorder]\ndelta_v_longitudinal = \"24 km/h\"\ndelta_v_lateral = \"0 km/h\"\n",
            "vehicle1.recorder.delta_v_lateral",
            false,
        ),
    ] {
        let estimated = judged(&format!("{CENTRAL}{crush}{lines}"));
        let (p, reversed) = p_value(&estimated, key);
        assert_eq!((p > 0.05, reversed), (agrees, !agrees), "{lines} {p}");
        assert!(agrees || p < 0.01, "{lines} {p}");
    }
    let turned = format!(
        "{CENTRAL}{crush}pdof = \"180 deg\"\n[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n"
    );
    let (p, reversed) = p_value(&judged(&turned), "vehicle1.crush.pdof");
    assert!(p < 0.01 && reversed, "{p}");
}

/// The force is along the line of both. Two PDOFs that are each 30° off it, so that they would have its
/// direction as their mean, are not one observation that agrees.
#[test]
fn two_pdofs_far_apart_have_no_mean() {
    let p = |one: &str, two: &str| {
        let crush = format!(
            "[vehicle1.crush]\nside = \"front\"\nees = \"30 km/h\"\npdof = \"{one} deg\"\n\
             [vehicle2.crush]\nside = \"rear\"\nees = \"20 km/h\"\npdof = \"{two} deg\"\n\
             [vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n"
        );
        p_value(&judged(&format!("{CENTRAL}{crush}")), "vehicle1.crush.pdof").0
    };
    let [agree, near, apart] = [p("0", "180"), p("10", "170"), p("30", "150")];
    assert!(agree > 0.9 && near > 0.9 && apart < 0.3, "{agree} {near} {apart}");
}

/// With the usual severity, slow speeds are more frequent than fast ones, and 20 % still stood. Without
/// friction a vehicle that slides along the crush plane meets the other at any speed, so that no speed is
/// left out.
#[test]
fn the_share_that_stood_is_that_before_the_evidence() {
    let text = "[vehicle1]\nmass = \"1400 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\nspeed = \"50 km/h\"\n\
                contact = { x = \"1.9 m\", y = \"0 m\" }\nrecorder = { delta_v_longitudinal = \"-26 km/h\" }\n\
                [vehicle2]\nmass = \"1400 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"90 deg\"\n\
                contact = { x = \"0 m\", y = \"0.8 m\" }\n[impact]\ncrush_plane = { value = \"0 deg\", sd = \"0.01 deg\" }\n\
                restitution = 0.1\ntangential = { ratio = 0 }\n";
    let stood = run(&read(text), 256).unwrap().stood[1].unwrap();
    assert!((stood.before.unwrap().value - 0.2).abs() < 0.03, "{stood:?}");
}

/// A vehicle at rest and one of at most 0.1 km/h are the same fact, and have the same severity before the
/// evidence.
#[test]
fn a_known_speed_leaves_the_severity_as_it_is() {
    let medians = |speed: &str| {
        let text = format!(
            "[estimate]\ndelta_v_median = \"25 km/h\"\n[vehicle1]\nmass = \"1400 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\n\
             contact = {{ x = \"2 m\", y = \"0 m\" }}\n[vehicle1.crush]\nside = \"front\"\nwidth = \"1.5 m\"\n\
             depths = \"0.3 0.3 m\"\nstiffness = {{ category = 3 }}\n[vehicle2]\nmass = \"1400 kg\"\nyaw_radius = \"1.4 m\"\n\
             heading = \"0 deg\"\ncontact = {{ x = \"-2 m\", y = \"0 m\" }}\n{speed}\n[impact]\ncrush_plane = \"0 deg\"\n\
             restitution = 0.1\ntangential = {{ friction = 0.5 }}\n"
        );
        let estimated = run(&read(&text), 2048).unwrap();
        let delta_v = of(&estimated, DELTA_V.of_vehicle(VehicleId::One));
        [delta_v.prior.as_ref().unwrap().median.value, delta_v.posterior.median.value]
            .map(|speed| 3.6 * speed)
    };
    let known = medians("speed = \"0 km/h\"");
    let next_to = medians("certain_speed = { at_least = \"0 km/h\", at_most = \"0.1 km/h\" }");
    // High speeds are rare on roads, which lowers the median by some 8 %.
    assert!((22.0..25.0).contains(&known[0]), "{known:?}");
    assert!((known[1] / next_to[1] - 1.0).abs() < 0.03, "{known:?} {next_to:?}");
}

/// A recorder that stored 1 km/h, where it is 1 km/h off at zero, leaves open whether the vehicle stood; one
/// that stored 6 km/h does not, and neither does a speed that follows from a table.
#[test]
fn a_recorder_that_stored_next_to_nothing_leaves_open_whether_it_stood() {
    let stood = |recorder: &str| {
        let text = CENTRAL.replace("speed = \"0 km/h\"", &format!("recorder = {{ {recorder} }}"));
        let after = "[vehicle2.after]\nspeed = \"11 m/s\"\ndirection = \"0 deg\"\n";
        run(&read(&format!("{text}{after}")), 128).unwrap().stood[1].map(|stood| stood.after.value)
    };
    assert!(stood("speed = \"1 km/h\"").is_some_and(|stood| stood > 0.1));
    assert_eq!(stood("speed = \"6 km/h\""), None);
}

/// Zero is a valid speed and ΔV, and data that zero cannot determine are named.
#[test]
fn zero_can_be_observed() {
    let stops = format!(
        "{CENTRAL}[vehicle1.after]\nspeed = \"0 m/s\"\ndirection = \"0 deg\"\n[vehicle1.crush]\nees = \"20 km/h\"\n"
    );
    let estimated = run(&read(&stops), 128).unwrap();
    let after = Unused { key: "vehicle1.after.direction".to_owned(), reason: UnusedReason::NoDirection };
    assert!(estimated.unused.contains(&after), "{:?}", estimated.unused);
    let still = format!("{CENTRAL}[vehicle2.recorder]\ndelta_v_longitudinal = \"0 km/h\"\n");
    // ΔV₂ = 0.66 v₁ is below 1 km/h or so: v₁ is near the smallest that makes an impact.
    let slow = run(&read(&still), 128).unwrap();
    assert!(of(&slow, speed(VehicleId::One)).posterior.median.value < 2.0);
    let none = format!("{CENTRAL}[vehicle1.crush]\nees = \"0 m/s\"\n[vehicle2.crush]\nees = \"0 m/s\"\n");
    let unused = of_case(&none).unused;
    for key in ["vehicle1.crush", "vehicle2.crush"] {
        assert!(
            unused.contains(&Unused { key: key.to_owned(), reason: UnusedReason::NoEnergy }),
            "{unused:?}"
        );
    }
}

/// A coefficient without a range has its value as the median.
#[test]
fn a_coefficient_without_a_range_is_the_median() {
    let text = CENTRAL
        .replace("{ value = 0.1, sd = 0.00001 }", "0.2")
        .replace("{ friction = { value = 0.7, sd = 0.0001 } }", "{ friction = 0.4 }");
    let setup = of_case(&text);
    for (key, median) in [("impact.restitution", 0.2), ("impact.tangential.friction", 0.4)] {
        let unknown = setup.unknown.iter().find(|unknown| unknown.key == key).unwrap();
        assert!((unknown.prior.quantile(0.5) - median).abs() < 1e-9, "{key}");
        assert_eq!(unknown.assumed, Some(Assumed::Coefficient));
    }
    assert_eq!(setup.unused, []);
}

/// Without evidence no speed is determined, and with a recorder it is.
#[test]
fn what_the_evidence_does_not_tell_is_said() {
    let text = CENTRAL.replace("prior = \"flat\"", "");
    let untold = run(&read(&text), 128).unwrap();
    assert!(!of(&untold, speed(VehicleId::One)).is_told());
    let told = run(&read(&format!("{text}[vehicle1.recorder]\nspeed = \"40 km/h\"\n")), 128).unwrap();
    assert!(of(&told, speed(VehicleId::One)).is_told());
}

/// A limit in a wrong unit, and one that only says that a vehicle moved backward.
#[test]
fn limits_that_make_no_sense_are_refused() {
    let refusal = |limit: &str| {
        let text = CENTRAL.replacen("[vehicle1]", &format!("[vehicle1]\ncertain_speed = {{ {limit} }}"), 1);
        let failure = setup::of(&read(&text), None).err().map(|failure| failure.to_string());
        failure.unwrap_or_default()
    };
    assert!(refusal("at_least = \"100 m/s\"").contains("252 km/h"), "{}", refusal("at_least = \"100 m/s\""));
    assert!(refusal("at_most = \"0 km/h\"").contains("backward"), "{}", refusal("at_most = \"0 km/h\""));
    assert_eq!(refusal("at_least = \"-20 km/h\", at_most = \"0 km/h\""), "");
    // If both limits are given, the upper limit of the prior does not apply.
    assert_eq!(refusal("at_least = \"255 km/h\", at_most = \"295 km/h\""), "");
}

/// The cost of an estimate of two vehicles that came to rest, with the effects of all pieces, in likelihoods:
/// a measure of time that is the same on every machine.
#[test]
fn two_rests_take_few_likelihoods() {
    let case = read(include_str!("../../../../fixtures/rear-end-rest.toml"));
    let plan =
        EstimatePlan { particles: EstimatePlan::PARTICLES, seed: 1, prior: None, pieces: PieceDetail::Apart };
    let estimated = estimate(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
    assert!(estimated.doubts().is_empty() && estimated.ess() >= 1000.0, "{}", estimated.ess());
    assert!(estimated.pieces.iter().all(|piece| piece.alone.is_some() && piece.without.is_some()));
    let all = estimated.posterior.diagnosis().evaluations;
    // 803,000 with this seed.
    assert!(all < 880_000, "{all}");
    assert!(estimated.evaluations < 1_650_000, "{}", estimated.evaluations);
}

/// A vehicle is not followed if no piece in use needs its path: its rest term then has its maximum.
#[test]
fn a_rest_that_is_not_used_needs_no_way() {
    let setup = setup::of(&read(&at_rest(REST)), None).unwrap();
    let columns = columns_of(&setup.impacts, 1);
    let model = CollisionModel::of(setup.impacts, setup.observed);
    let rest = model.pieces().iter().position(|piece| *piece == Piece::Rest(VehicleId::Two)).unwrap();
    let of_rest = |is_used: bool| {
        use ::estimate::Evidence;
        let mut terms = vec![::uncertainty::Lanes::ZERO; model.terms_count()];
        let mut used = vec![true; terms.len()];
        used[rest] = is_used;
        model.log_likelihood_of_used(&columns, &used, &mut terms, &mut [0; ::uncertainty::LANES]);
        terms[rest]
    };
    let (followed, not) = (of_rest(true), of_rest(false));
    let most = not.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(not.iter().all(|term| *term == most || *term == f64::NEG_INFINITY));
    assert!(followed.iter().zip(&not).all(|(followed, most)| followed <= most));
    assert!(followed.iter().any(|followed| *followed < most - 1.0));
}

/// The paths of an estimate have small errors compared with the best accuracy of a rest position, 0.5 m and
/// 10 % of the path: tested against paths that were followed a thousand times as closely.
#[test]
fn ways_are_followed_as_closely_as_a_rest_is_known() {
    use ::uncertainty::random::{bits, unit};
    use trajectory::{Axles, Chassis, Control, Ground, State, Steer, to_rest};
    let mut shares = Vec::new();
    for number in 0..200 {
        let of = |place: u64, low: f64, high: f64| low + (high - low) * unit(bits(place, number));
        let body = pim_core::Body::new(1400.0, 2600.0).unwrap();
        let axles = Axles { cg_to_front: 1.2, cg_to_rear: 1.4, track: 1.5 };
        let drag =
            [0, 1, 2, 3].map(|wheel| if of(wheel, 0.0, 1.0) < 0.4 { 1.0 } else { of(9 + wheel, 0.02, 0.3) });
        let chassis = Chassis::new(body, axles, drag).unwrap();
        let motion = pim_core::Motion {
            velocity: pim_core::Vector2::new(of(5, 2.0, 20.0), of(6, -6.0, 6.0)),
            yaw_rate: of(7, -5.0, 5.0),
        };
        let start = State { position: pim_core::Vector2::new(0.0, 0.0), heading: 0.0, motion };
        let ground =
            Ground { friction: of(8, 0.4, 0.8), zones: &[], grade: pim_core::Vector2::new(0.0, 0.0) };
        let rest = |tolerance: f64| {
            let control = Control { tolerance, ..Control::default() };
            to_rest(&chassis, Steer::Held(0.0), &ground, &start, &control, |_| {}).unwrap()
        };
        let (rough, close) = (rest(impacts::WAY_TOLERANCE), rest(impacts::WAY_TOLERANCE / 1000.0));
        let apart = rough.position - close.position;
        let sd = (0.5_f64.powi(2) + (0.1 * close.distance).powi(2)).sqrt();
        shares.push(apart.norm() / sd);
    }
    shares.sort_by(f64::total_cmp);
    // 5 % of the error of a rest position in 95 % of the paths, and at most a quarter of it.
    assert!(shares[189] < 0.05 && shares[199] < 0.25, "{} {}", shares[189], shares[199]);
}

/// A contact in the scene, an axle and a rest position with unknown numbers belong to the motion after the
/// impact: the impacts of a block need no case for them, and equal those of the case.
#[test]
fn numbers_of_the_motion_leave_the_block() {
    let text = at_rest(REST)
        .replace("x = \"-2 m\"", "x = { value = \"-2 m\", sd = \"0.2 m\" }")
        .replace("wheelbase = \"2.6 m\"", "wheelbase = { value = \"2.6 m\", sd = \"2 cm\" }")
        .replace("track = \"1.5 m\"", "track = { value = \"1.5 m\", sd = \"2 cm\" }")
        .replace("cg_to_front_axle = \"1.2 m\"", "cg_to_front_axle = { value = \"1.2 m\", sd = \"2 cm\" }");
    let mut impacts = of_case(&text).impacts;
    assert!(impacts.block.is_some());
    let blocks = impacts_of(&impacts, 1);
    impacts.block = None;
    assert_eq!(impacts_of(&impacts, 1), blocks);
    assert!(blocks.iter().any(|impact| impact.contains("is_possible: true")));
}

/// The parts of the case that a particle copies for its motion lead to the motion of the whole case.
#[test]
fn the_motion_needs_no_more_of_the_case() {
    let given = at_rest(REST);
    let placed = include_str!("../../../../fixtures/edcrash-tutorial.toml");
    let rear_end = include_str!("../../../../fixtures/rear-end-rest.toml");
    for text in [&given, placed, rear_end] {
        let impacts = of_case(text).impacts;
        let columns = columns_of(&impacts, 2);
        let motion = impacts.motion.as_ref().unwrap();
        for lane in 0..::uncertainty::LANES {
            let whole = impacts.case_of(&columns, lane).run_out().unwrap().unwrap();
            let own = motion.of(&columns, lane).run_out().unwrap().unwrap();
            assert_eq!(format!("{own:?}"), format!("{whole:?}"), "{text}");
        }
    }
}

/// The wheel of a vehicle that spins passes the same places as on a closely followed path, also between the
/// long steps of a particle.
#[test]
fn a_mark_is_sought_between_the_steps() {
    use crate::travel::Followed;
    let text = at_rest(REST)
        .replace("rest = {", "points = [{ x = \"6 m\", y = \"0 m\", wheel = \"front left\" }]\nrest = {");
    let case = read(&text);
    let mut input = case.run_out().unwrap().unwrap();
    let id = VehicleId::Two;
    let start = pim_core::Motion { velocity: pim_core::Vector2::new(9.0, 4.0), yaw_rate: 5.0 };
    let close = trajectory::Control { tolerance: 1e-8, longest_step: 0.005, ..Default::default() };
    let mut states = Vec::new();
    let of = Followed::of(&input, id).unwrap();
    of.to_rest(start, &close, |sample| states.push(sample.state)).unwrap();
    let way = input.vehicles[id.index()].as_mut().unwrap();
    let wheel = way.chassis.wheels()[way.points[0].wheel.unwrap() as usize];
    way.points = states
        .iter()
        .step_by(states.len() / 40)
        .map(|state| {
            let (sin, cos) = state.heading.sin_cos();
            let arm = [wheel.forward * cos - wheel.left * sin, wheel.forward * sin + wheel.left * cos];
            let position = state.position + pim_core::Vector2::new(arm[0], arm[1]);
            inputs::PointData { position, ..way.points[0] }
        })
        .collect();
    assert!(way.points.len() >= 40);
    let passes = Followed::of(&input, id).unwrap().passes(start, impacts::WAY_TOLERANCE).unwrap();
    let worst = passes.iter().map(|pass| pass.miss).fold(0.0, f64::max);
    assert!(worst < 0.03, "{worst}");
}

/// Whatever form the inputs of the impact have, the particles of a block are those of its cases.
#[test]
fn a_block_of_any_case_is_its_cases() {
    let mut seen = BTreeSet::new();
    for seed in 0..120 {
        let AnyCase { text, forms } = any_case(seed);
        let Ok(Setup { mut impacts, .. }) = setup::of(&read(&text), None) else { continue };
        let blocks = impacts_of(&impacts, seed);
        assert!(impacts.block.take().is_some(), "{text}");
        assert_eq!(impacts_of(&impacts, seed), blocks, "{text}");
        if blocks.iter().any(|impacted| impacted.contains("is_possible: true")) {
            seen.extend(forms);
        }
    }
    let unseen: Vec<&str> = FORMS.into_iter().filter(|form| !seen.contains(form)).collect();
    assert!(unseen.is_empty(), "{unseen:?}");
}

/// A front against a barrier: the misfit, its errors and the severity are those of crashes into fixed
/// objects, whose median is that of a vehicle although its speed is uniform before.
#[test]
fn a_front_against_a_barrier_has_figures_of_its_own() {
    let text = |side: &str, other: &str, estimate: &str| {
        format!(
            "[vehicle1]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\nlength = \"4.4 m\"\n\
             width = \"1.76 m\"\ncg_to_front = \"2.05 m\"\ncontact = {{ x = \"1.9 m\", y = \"0 m\" }}\n\
             [vehicle1.crush]\nside = \"{side}\"\nwidth = \"150 cm\"\ndepths = \"30 30 cm\"\noblique = \"none\"\n\
             stiffness = {{ category = 3 }}\n[vehicle2]\n{other}[impact]\ncrush_plane = \"180 deg\"\n\
             restitution = 0.1\ntangential = \"critical\"\n[estimate]\nprior = \"field\"\n{estimate}"
        )
    };
    let object = evidence::FITTED.by_category(&[evidence::DamagedSide::Front]).objects;
    assert_eq!([object.misfit.bias, object.misfit.ln_sd], [-0.671, 1.372]);
    let setup = of_case(&text("front", "fixed = true\n", ""));
    let (errors, figures) = (setup.observed.crush.unwrap().0[0], setup.observed.figures.unwrap());
    assert_eq!([errors.bias, errors.shared_ln_sd], [object.misfit.bias, object.misfit.ln_sd]);
    assert!((figures.bias_sd(VehicleId::One) - object.covariance[0][0].sqrt()).abs() < 1e-12);
    // ∫ v N(ln v; μ, σ) d ln v has its median at exp(μ + σ²).
    let severity = setup.observed.severity.unwrap();
    assert_eq!(severity, evidence::Severity { uniform_speeds: 1, ..object.severity });
    // What the case gives was not fitted.
    let given = of_case(&text("front", "fixed = true\n", "crush_bias = \"60 %\"\ncrush_error = \"50 %\"\n"));
    assert_eq!(given.observed.figures, None);
    // A side against an object was not fitted to such crashes.
    let side = of_case(&text("left", "fixed = true\n", ""));
    assert_eq!(side.observed.crush.unwrap().0[0].bias, -0.794);
    // So has the stiffness of the fleet (docs/calibration.md), whose age does not count.
    for (side, year, [bias, ln_sd, error]) in [
        ("front", 2015, [-0.770, 1.470, 0.243]),
        ("front", 1978, [-0.770, 1.470, 0.243]),
        ("left", 2015, [-0.521, 0.336, 0.159]),
    ] {
        let fleet = text(side, "fixed = true\n", "").replace("{ category = 3 }", "\"fleet\"");
        let setup =
            of_case(&fleet.replacen("[vehicle1]\n", &format!("[vehicle1]\nmodel_year = {year}\n"), 1));
        let (errors, figures) = (setup.observed.crush.unwrap().0[0], setup.observed.figures.unwrap());
        assert_eq!([errors.bias, errors.shared_ln_sd], [bias, ln_sd]);
        assert!(
            (figures.bias_sd(VehicleId::One) - error).abs() < 5e-4,
            "{}",
            figures.bias_sd(VehicleId::One)
        );
    }
}

/// Vehicles of different kinds of stiffness have each the bias and the spread of its own.
#[test]
fn a_category_beside_the_fleet_keeps_its_bias() {
    let text =
        include_str!("../../../../fixtures/t-bone-category.toml").replace("{ category = 4 }", "\"fleet\"");
    let CrushErrors([one, two]) = of_case(&text).observed.crush.unwrap();
    // docs/calibration.md: a side was hit.
    assert_eq!([one.bias, one.shared_ln_sd], [-0.521, 0.336]);
    assert_eq!([two.bias, two.shared_ln_sd], [-0.794, 0.387]);
}

/// The answer for a serious injury, shown next to that of the field, equals the one from a run with that
/// prior.
#[test]
fn a_serious_injury_is_told_beside_the_answer_and_can_be_asked_for() {
    let case = read(include_str!("../../../../fixtures/estimate.toml"));
    let of_prior = |prior| {
        let plan = EstimatePlan { particles: 512, seed: 1, prior, pieces: PieceDetail::Weighed };
        estimate(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap()
    };
    let [field, injured, flat] =
        [None, Some(SeverityPrior::SeriousInjury), Some(SeverityPrior::Flat)].map(of_prior);
    for output in VehicleId::ALL.map(|id| DELTA_V.of_vehicle(id)) {
        let told = of(&field, output).if_injured.as_ref().unwrap().median;
        let found = of(&injured, output).posterior.median;
        let error = told.standard_error.unwrap().hypot(found.standard_error.unwrap());
        assert!((told.value - found.value).abs() < 4.0 * error, "{output:?}: {told:?}, {found:?}");
        assert!(told.value > of(&field, output).posterior.median.value + 2.0 * error);
        assert!(of(&injured, output).if_injured.is_none() && of(&flat, output).if_injured.is_none());
    }
}

/// The median of vehicle 1's speed behind the wreck of two cars of 1500 and 1000 kg that left at 12 m/s.
fn behind_the_wreck(scene: &str) -> (f64, Vec<Unused>) {
    let after = "after = { speed = { value = \"12 m/s\", sd = \"0.001 m/s\" }, direction = \"0 deg\" }";
    let text = CENTRAL.replace("speed = \"0 km/h\"", &format!("speed = \"0 km/h\"\n{after}"));
    let estimated = run(&read(&format!("{scene}{text}")), 256).unwrap();
    let median = of(&estimated, speed(VehicleId::One)).posterior.median.value;
    (median, estimated.unused)
}

#[test]
fn locked_together_is_common_velocity() {
    // (m_1 + m_2) V = m_1 v_1, whatever the restitution of the case; without the key
    // (m_1 + m_2) V_2 = (1 + e) m_1 v_1
    let (one_wreck, unused) = behind_the_wreck("[scene]\nlocked_together = true\n");
    assert!((one_wreck - 20.0).abs() < 0.02, "{one_wreck}");
    let keys: Vec<&str> = unused.iter().map(|unused| unused.key.as_str()).collect();
    assert_eq!(keys, ["impact.restitution", "impact.tangential"]);
    assert!(unused.iter().all(|unused| unused.reason == UnusedReason::OneWreck));
    let (apart, unused) = behind_the_wreck("");
    assert!((apart - 20.0 / 1.1).abs() < 0.02, "{apart}");
    assert!(unused.is_empty());
}

#[test]
fn the_velocity_of_a_wreck_is_that_of_its_cg() {
    // A crossing off both CGs, so the wreck turns, and neither CG moves as the common one.
    let case = r#"
[scene]
locked_together = true
[estimate]
prior = "flat"
[vehicle1]
mass = { value = "1135 kg", sd = "0.01 kg" }
heading = { value = "180 deg", sd = "0.01 deg" }
yaw_radius = "1.3 m"
contact = { x = { value = "2 m", sd = "1 mm" }, y = { value = "0.2 m", sd = "1 mm" } }
after = { speed = { value = "19.8 m/s", sd = "0.02 m/s" }, direction = { value = "150 deg", sd = "0.05 deg" } }
[vehicle2]
mass = { value = "1300 kg", sd = "0.01 kg" }
heading = { value = "90 deg", sd = "0.01 deg" }
yaw_radius = "1.35 m"
contact = { x = { value = "1 m", sd = "1 mm" }, y = { value = "0.8 m", sd = "1 mm" } }
[impact]
crush_plane = { value = "0 deg", sd = "0.01 deg" }
restitution = 0.3
tangential = { friction = 0.5 }
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#;
    let estimated = run(&read(case), 512).unwrap();
    // m_1 v_1 = −(m_1 + m_2) V cos 150°, m_2 v_2 = (m_1 + m_2) V sin 150°
    let momentum = 2435.0 * 19.8;
    let expected = [momentum * 0.75_f64.sqrt() / 1135.0, momentum * 0.5 / 1300.0];
    for id in VehicleId::ALL {
        let found = of(&estimated, speed(id)).posterior.median.value;
        assert!((found - expected[id.index()]).abs() < 0.1, "{id:?}: {found}, not {expected:?}");
    }
}

/// The only law whose coefficients locked vehicles decide is Brach's without a moment.
#[test]
fn a_law_with_a_moment_does_not_lock() {
    let with = |law: &str| {
        of_case(&format!("[scene]\nlocked_together = true\n{}", CENTRAL.replace("[impact]", law)))
    };
    let unused = |setup: Setup| setup.unused.into_iter().map(|one| (one.key, one.reason)).collect::<Vec<_>>();
    let key = || "scene.locked_together".to_owned();
    let moment = unused(with("[impact]\nmoment_restitution = 0"));
    assert_eq!(moment, [(key(), UnusedReason::WithMoment)]);
}

/// One of two locked vehicles does not come to rest as it would alone.
#[test]
fn a_rest_of_a_wreck_is_no_evidence() {
    let text = include_str!("../../../../fixtures/rear-end-rest.toml");
    let of = |text: &str| {
        let setup = of_case(text);
        let rests = setup.observed.vehicles.each_ref().map(|vehicle| vehicle.rest.is_some());
        (rests, setup.unused.into_iter().map(|one| (one.key, one.reason)).collect::<Vec<_>>(), setup.warnings)
    };
    let (rests, unused, _) = of(text);
    assert_eq!(rests, [true; 2]);
    assert!(unused.iter().all(|(_, reason)| *reason != UnusedReason::Wreck), "{unused:?}");
    let (rests, unused, warnings) = of(&text.replacen("[scene]\n", "[scene]\nlocked_together = true\n", 1));
    assert_eq!(rests, [false; 2]);
    for key in ["vehicle1.after.rest", "vehicle2.after.rest"] {
        assert!(unused.contains(&(key.to_owned(), UnusedReason::Wreck)), "{unused:?}");
    }
    assert!(warnings.iter().all(|warning| warning.code() != "wreck-alone"));
}

/// A speed with a range counts as given by the case, whatever the evidence adds to it.
#[test]
fn a_given_speed_is_told() {
    let text = CENTRAL.replace("speed = \"0 km/h\"", "speed = { value = \"5 m/s\", sd = \"1 m/s\" }");
    let estimated = run(&read(&text), 256).unwrap();
    let given = of(&estimated, speed(VehicleId::Two));
    assert!(given.is_given && given.varies() && given.is_told());
    assert!(!of(&estimated, speed(VehicleId::One)).is_given);
}

/// Points to which no vehicle can be followed are reported under their own key.
#[test]
fn points_that_are_not_followed_are_named() {
    let unused = |after: &str| {
        let setup = of_case(&format!("{CENTRAL}[vehicle1.after]\n{after}\n"));
        setup.unused.into_iter().map(|one| (one.key, one.reason)).collect::<Vec<_>>()
    };
    let of = |key: &str| (format!("vehicle1.after.{key}"), UnusedReason::NotFollowed);
    let (rest, points) = (
        "rest = { x = \"9 m\", y = \"0 m\", turned = \"0 deg\" }",
        "points = [{ x = \"3 m\", y = \"1 m\" }]",
    );
    assert_eq!(unused(points), [of("points")]);
    assert_eq!(unused(rest), [of("rest")]);
    assert_eq!(unused(&format!("{rest}\n{points}")), [of("rest"), of("points")]);
}

/// What says something about evidence that the estimate does not have is named.
#[test]
fn what_applies_to_nothing_is_named() {
    let unused = |text: &str| {
        let setup = of_case(text);
        setup.unused.into_iter().map(|one| (one.key, one.reason)).collect::<Vec<_>>()
    };
    let errors = "delta_v_median = \"20 km/h\"\ncrush_error = \"30 %\"\ncrush_bias = \"60 %\"\nrest_error = \"5 %\"\n\
                  rest_least_error = \"1 m\"\nrest_heading_error = \"9 deg\"\nstood = \"30 %\"\n";
    let rolls = "[vehicle1.after]\nfriction = 0.7\ndrag = 0.1\nsteer = \"2 deg\"\n";
    let recorder = "[vehicle1.recorder]\nspeed = \"30 km/h\"\nerrors = { step = \"2 km/h\" }\n";
    let wheels = "wheelbase = \"2.6 m\"\ntrack = \"1.5 m\"\ncg_to_front_axle = \"1.1 m\"\n";
    let first = format!("{errors}[vehicle1]\n{wheels}");
    let text = CENTRAL.replacen("[vehicle1]", &first, 1) + rolls + recorder;
    let of = |key: &str, reason| (key.to_owned(), reason);
    assert_eq!(
        unused(&text),
        [
            of("estimate.stood", UnusedReason::NoneStood),
            of("vehicle1.recorder.errors", UnusedReason::NoSpeeds),
            of("vehicle1.after.friction", UnusedReason::NoPlace),
            of("vehicle1.after.drag", UnusedReason::NoPlace),
            of("vehicle1.after.steer", UnusedReason::NoPlace),
            of("estimate.delta_v_median", UnusedReason::FlatPrior),
            of("estimate.crush_error", UnusedReason::NoCrushEnergy),
            of("estimate.crush_bias", UnusedReason::NoCrushEnergy),
            of("estimate.rest_error", UnusedReason::NoPlace),
            of("estimate.rest_least_error", UnusedReason::NoPlace),
            of("estimate.rest_heading_error", UnusedReason::NoRest),
        ]
    );
    // With both rests, crush, a severity and a speed that may be zero, each applies to something.
    let text = include_str!("../../../../fixtures/rear-end-rest.toml");
    let with_errors = unused(&format!("{text}\n[estimate]\n{errors}"));
    assert_eq!(with_errors, unused(text));
}

/// A vehicle whose velocity is zero stands, in either form, so that the other one moved.
#[test]
fn a_velocity_of_zero_stands() {
    for zero in ["speed = \"0 km/h\"", "velocity = { x = \"0 m/s\", y = \"0 m/s\" }"] {
        assert_eq!(of_case(&CENTRAL.replace("speed = \"0 km/h\"", zero)).stood, [0.0; 2], "{zero}");
    }
}

/// A known speed stays known even if the heading is uncertain: backward at 3 m/s in every draw.
#[test]
fn a_given_velocity_is_a_given_speed() {
    let text = CENTRAL
        .replace("speed = \"0 km/h\"", "velocity = { x = \"-3 m/s\", y = \"0 m/s\" }")
        .replace("heading = { value = \"0 deg\", sd = \"0.0001 deg\" }", "heading = \"0 deg\"");
    let text = format!("{text}[vehicle2.after]\nspeed = \"5 m/s\"\ndirection = \"0 deg\"\n");
    let estimated = run(&read(&text), 128).unwrap();
    assert!(!of(&estimated, speed(VehicleId::Two)).varies());
    assert!(estimated.draws(speed(VehicleId::Two)).unwrap().iter().all(|v| (v + 3.0).abs() < 1e-12));
}

/// The direction of a velocity of (20, 1) m/s ± 2 m/s: 20 · 2/401 rad.
#[test]
fn the_direction_of_a_sought_velocity_is_uncertain() {
    let text = CENTRAL
        .replacen(
            "[vehicle1]",
            "[vehicle1]\nvelocity = { x = \"20 m/s\", y = { value = \"1 m/s\", sd = \"2 m/s\" } }",
            1,
        )
        .replace("[impact]", "[reconstruct]\nfind = \"vehicle1.speed\"\n[impact]");
    let setup = of_case(&text);
    let sideslip = setup.unknown.iter().find(|unknown| unknown.key == "vehicle1.sideslip").unwrap();
    let factor = sideslip.unit.unwrap().factor();
    assert!((sideslip.prior.sd() * factor - 40.0 / 401.0).abs() < 1e-12);
    assert!((sideslip.prior.mean() * factor - 0.05_f64.atan()).abs() < 1e-12);
}

/// Phases that lead from a stop to the impact are no evidence, which is said, but the vehicle did not stand.
#[test]
fn phases_that_lead_to_the_impact_are_named_and_exclude_a_stationary_vehicle() {
    let text = CENTRAL.replace("speed = \"0 km/h\"", "");
    let with = |phase: &str| {
        let case = read(&format!("{text}[[vehicle2.before.phase]]\n{phase}\n"));
        let estimated = run(&case, 128).unwrap();
        let unused: Vec<_> = estimated.unused.iter().map(|one| (one.key.clone(), one.reason)).collect();
        (estimated.stood[1].is_some(), unused)
    };
    let named = vec![("vehicle2.before.phase".to_owned(), UnusedReason::Phases)];
    let moving = "speed = \"0 km/h\"\nacceleration = \"2 m/s^2\"\ndistance = \"9 m\"";
    assert_eq!(with(moving), (false, named.clone()));
    // 10 m/s braked with 5 m/s² for 2 s.
    assert_eq!(with("speed = \"10 m/s\"\nacceleration = \"-5 m/s^2\"\ntime = \"2 s\""), (true, named));
    assert_eq!(with("time = \"2 s\"\nacceleration = \"0 m/s^2\""), (true, Vec::new()));
}

/// A car that is struck on its left, with its damage on the right.
#[test]
fn a_damaged_side_on_which_no_force_pushes_is_told() {
    let text = include_str!("../../../case/templates/si/front-side.toml");
    let told = |text: &str| -> Vec<(VehicleId, f64)> {
        let warnings = run(&read(text), 128).unwrap().warnings;
        let of = |warning: &Warning| match warning {
            Warning::SideNotPushed { vehicle, oblique_angle } => Some((*vehicle, *oblique_angle)),
            _ => None,
        };
        warnings.iter().filter_map(of).collect()
    };
    assert_eq!(told(text), []);
    let [(VehicleId::Two, angle)] = told(&text.replace("side      = \"left\"", "side      = \"right\""))[..]
    else {
        panic!();
    };
    assert!(angle.abs() > 2.0, "{angle}");
}
