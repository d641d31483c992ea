//! Derivatives against central differences, and the sweep against cases with the turned PDOF.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

use std::fs;
use std::path::{Path, PathBuf};

use analysis::quantities::{DELTA_V, SPEED};
use analysis::{Analysis, Failure, Output, Sweep, crush, reconstruct, sensitivity};
use case::{CaseFile, read_quantity};
use inputs::{Case, Dimension, Pdof};
use pim_core::VehicleId;

const NO_SWEEP: Sweep = Sweep { step: 0.1, steps: 0 };

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures")
}

fn read(path: &Path) -> Case {
    CaseFile::parse(&path.display().to_string(), &fs::read_to_string(path).unwrap()).unwrap().case
}

/// Every case that has a reconstruction.
fn reconstructions() -> Vec<(String, Case)> {
    let folders = ["", "laws", "ricsac"].map(|folder| fixtures().join(folder));
    let mut cases: Vec<(String, Case)> = folders
        .iter()
        .flat_map(|folder| fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .filter(|path| path.file_stem().is_some_and(|stem| stem != "published"))
        .map(|path| (path.display().to_string(), read(&path)))
        .filter(|(_, file)| file.reconstruct.is_some_and(|sought| sought.find.unknown().is_some()))
        .filter(|(_, file)| reconstruct(file).is_ok())
        .collect();
    cases.sort_by(|(a, _), (b, _)| a.cmp(b));
    cases
}

fn outputs(analysis: &Analysis) -> [f64; 3] {
    let [dv1, dv2] = analysis.impact.as_ref().unwrap().outcome.delta_v_magnitude();
    [analysis.found.as_ref().unwrap().speed, dv1, dv2]
}

/// The case with input number `i` moved by `change`, in the input's own unit.
fn moved(case: &Case, i: usize, change: f64) -> Result<[f64; 3], Failure> {
    let mut index = 0;
    let case = case.map(|input| {
        index += 1;
        if index == i + 1 { input.number + change } else { input.number }
    });
    reconstruct(&case).map(|analysis| outputs(&analysis))
}

#[test]
fn derivatives_are_central_differences_on_every_fixture() {
    let cases = reconstructions();
    assert!(cases.len() >= 19, "{}", cases.len());
    let mut compared = 0;
    for (name, file) in &cases {
        let sensitivity = sensitivity(file, NO_SWEEP).unwrap();
        let nominal = outputs(&sensitivity.nominal);
        for (i, input) in file.inputs().into_iter().enumerate() {
            // Small compared with the number, or with a usual number of its kind if it is zero.
            let usual = match input.unit.map(inputs::Unit::dimension) {
                Some(Dimension::Angle) => 1.0 / input.factor(),
                Some(_) | None => 1.0,
            };
            let step = 1e-4 * input.number.abs().max(0.1 * usual);
            let sides = [-2.0, -1.0, 1.0, 2.0].map(|steps| moved(file, i, steps * step));
            // A number at the end of its range, such as a depth of zero, has no neighbour on one side.
            let [Ok(low2), Ok(low), Ok(high), Ok(high2)] = sides else { continue };
            for (j, &value) in nominal.iter().enumerate() {
                let output = match j {
                    0 => SPEED.of_vehicle(sensitivity.nominal.found.as_ref().unwrap().unknown),
                    number => DELTA_V.of_vehicle(VehicleId::ALL[number - 1]),
                };
                let row =
                    sensitivity.derivatives.iter().find(|row| row.output == output && row.input == input);
                let Some(row) = row else {
                    // The ΔV of a wall.
                    assert_eq!(value, 0.0, "{name} {}", input.path);
                    continue;
                };
                assert_eq!(row.output_value, value, "{name} {}", input.path);
                // Central differences at one and two steps, combined so that their error is of fourth order.
                let difference =
                    (8.0 * (high[j] - low[j]) - (high2[j] - low2[j])) / (12.0 * step * input.factor());
                let scale = value.abs() / (input.number.abs().max(usual) * input.factor());
                let error = (row.value - difference).abs();
                assert!(
                    error <= 1e-6 * difference.abs().max(1e-2 * scale),
                    "{name}: {output:?} by {}: {} is not {difference}",
                    input.path,
                    row.value
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 1500, "{compared}");
}

#[test]
fn the_most_influential_input_comes_first() {
    let sensitivity = sensitivity(&read(&fixtures().join("sae-980025.toml")), NO_SWEEP).unwrap();
    for rows in sensitivity.derivatives.chunk_by(|a, b| a.output == b.output) {
        assert_eq!(rows.len(), 31);
        assert!(rows.is_sorted_by(|a, b| a.influence().abs() >= b.influence().abs()));
    }
    let by = |output: Output, path: &str| {
        let found = sensitivity.derivatives.iter().find(|row| row.output == output && row.input.path == path);
        found.unwrap_or_else(|| panic!("{path}"))
    };
    // The direction of the scene's axes is a matter of choice: turning all angles together changes nothing.
    for output in [
        SPEED.of_vehicle(VehicleId::One),
        DELTA_V.of_vehicle(VehicleId::One),
        DELTA_V.of_vehicle(VehicleId::Two),
    ] {
        let turned: f64 = ["vehicle1.heading", "vehicle2.heading", "impact.crush_plane"]
            .map(|path| by(output, path).value)
            .iter()
            .sum();
        assert!(turned.abs() < 1e-9, "{turned}");
    }
    // A heading has no influence in per cent, a weight has: −0.225 % per %, from −0.004941 ft/s per lb at
    // 3413 lb and 75.03 ft/s.
    let speed = SPEED.of_vehicle(VehicleId::One);
    assert_eq!(by(speed, "vehicle1.heading").relative(), None);
    let weight = by(speed, "vehicle2.weight");
    assert!((weight.relative().unwrap() + 0.225).abs() < 5e-4);
    assert!((weight.influence() + 0.00225).abs() < 5e-6);
}

/// Degrees in the case's own unit.
fn pdof(degrees: f64) -> Option<Pdof> {
    Some(Pdof::Angle(read_quantity(&format!("{degrees} deg"), Dimension::Angle).unwrap()))
}

#[test]
fn the_sweep_is_what_cases_with_that_pdof_say() {
    let file = read(&fixtures().join("sae-980025.toml"));
    let sweep = Sweep { step: 5_f64.to_radians(), steps: 2 };
    let rows = sensitivity(&file, sweep).unwrap().pdof_sweep;
    let changes: Vec<f64> = rows.iter().map(|row| row.change.to_degrees().round()).collect();
    assert_eq!(changes, [-10.0, -5.0, 0.0, 5.0, 10.0]);
    let [p1, p2] = rows[2].pdof.map(|pdof| pdof.unwrap().to_degrees());
    for row in &rows {
        let mut turned = file.clone();
        // The force turns counter-clockwise, and a PDOF counts clockwise.
        for (vehicle, nominal) in turned.vehicles.iter_mut().zip([p1, p2]) {
            vehicle.crush.as_mut().unwrap().pdof = pdof(nominal - row.change.to_degrees());
        }
        let alone = crush(&turned).unwrap().crash3.unwrap();
        for vehicle in [0, 1] {
            let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
            close(row.crash3.delta_v[vehicle], alone.delta_v[vehicle]);
            close(row.crash3.corrected.unwrap().delta_v[vehicle], alone.corrected.unwrap().delta_v[vehicle]);
            close(row.crash3.moment_arm[vehicle], alone.moment_arm[vehicle]);
        }
    }
}

#[test]
fn a_damage_without_a_pdof_has_no_sweep() {
    let file = read(&fixtures().join("sae-980025-crush.toml"));
    let sensitivity = sensitivity(&file, Sweep { step: 0.1, steps: 2 }).unwrap();
    assert!(sensitivity.derivatives.is_empty() && sensitivity.pdof_sweep.is_empty());
}

/// The pole with h = 0.9 m and α = 30° of its own, which contact point and PDOF would make 0.3 m and 0°: in
/// every row h stays, and α turns as the PDOF does.
#[test]
fn the_sweep_keeps_what_the_file_gives() {
    let pole = fs::read_to_string(fixtures().join("pole.toml")).unwrap();
    let given = "pdof = \"0 deg\"\nmoment_arm = \"0.9 m\"\noblique_angle = \"30 deg\"";
    let line = pole.lines().find(|line| line.starts_with("pdof")).unwrap();
    let text = pole.replace(line, given);
    // Two zones of 0.3 m from 0.4 to 0.5 m: A C̄ + B Q/2 + A²/2B with C̄ = 0.45 m and Q = 0.61/3 m².
    let energy: f64 = 0.6 * (50e3 * 0.45 + 800e3 * 0.61 / 6.0 + 50e3 * 50e3 / 1.6e6);
    // γ = k²/(k² + h²),  ΔV = √(2 γ E/m)
    let uncorrected = (2.0 * 1.96 / (1.96 + 0.81) * energy / 1500.0).sqrt();
    assert!((uncorrected - 7.72).abs() < 5e-3);
    let sweep = Sweep { step: 10_f64.to_radians(), steps: 2 };
    for (axes, sign) in [("z-up", -1.0), ("z-down", 1.0)] {
        let file =
            CaseFile::parse("x.toml", &format!("scene = {{ axes = \"{axes}\" }}\n{text}")).unwrap().case;
        let alone = crush(&file).unwrap().crash3.unwrap();
        let rows = sensitivity(&file, sweep).unwrap().pdof_sweep;
        assert_eq!(rows.len(), 5);
        assert_eq!(rows[2].crash3.delta_v, alone.delta_v);
        assert_eq!(rows[2].crash3.corrected.unwrap().delta_v, alone.corrected.unwrap().delta_v);
        for row in &rows {
            // A line of action that turns counter-clockwise takes from the PDOF and from α, which count
            // clockwise.
            let alpha = 30_f64.to_radians() + sign * row.change;
            assert!((row.oblique_angle[0].unwrap() - alpha).abs() < 1e-12);
            assert_eq!(row.crash3.moment_arm[0], 0.9);
            assert!((row.crash3.delta_v[0] / uncorrected - 1.0).abs() < 1e-12);
            // √(1 + tan²α), at most √2
            let factor = (1.0 / alpha.cos()).min(2_f64.sqrt());
            let corrected = row.crash3.corrected.unwrap().delta_v[0];
            assert!((corrected / (uncorrected * factor) - 1.0).abs() < 1e-12, "{corrected}");
            if row.change == 0.0 {
                assert!((corrected - 8.92).abs() < 5e-3, "{corrected}");
            }
        }
    }
    // Only one of the two given: the other follows from contact point and PDOF.
    let file = CaseFile::parse("x.toml", &text.replace("oblique_angle = \"30 deg\"\n", "")).unwrap().case;
    for row in sensitivity(&file, sweep).unwrap().pdof_sweep {
        assert_eq!(row.crash3.moment_arm[0], 0.9);
        assert!((row.oblique_angle[0].unwrap() + row.change).abs() < 1e-12);
    }
}
