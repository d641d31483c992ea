//! A case has one answer, whichever command shows it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

/// A rear-end collision whose recorder stored far less than follows from its crush.
fn contradicted() -> String {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("drawn");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("contradicted.toml");
    let text = include_str!("../../../fixtures/rear-end.toml");
    fs::write(&path, format!("{text}\n[vehicle1.recorder]\nspeed = \"20 km/h\"\n")).unwrap();
    path.display().to_string()
}

fn run(arguments: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_deltav")).args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    output
}

#[test]
fn a_drawing_never_shows_a_speed_that_is_not_the_answer_as_one() {
    let case = contradicted();
    let reconstructed = run(&["reconstruct", &case, "--format", "json"]);
    let json: Value = serde_json::from_slice(&reconstructed.stdout).unwrap();
    assert_eq!(json["headline"]["by"], "estimate");
    let speed = json["headline"]["vehicle1"]["speed"]["value"].as_f64().unwrap();
    let exact = json["solutions"][0]["speeds"][0].as_f64().unwrap();

    let plain = run(&["draw", &case, "--what", "scene", "--plain", "--units", "si"]);
    let svg = String::from_utf8(plain.stdout).unwrap();
    assert!(svg.contains(&format!(">before: {:.1} km/h (95 %: ", speed * 3.6)), "{speed}: {svg}");
    assert!(!svg.contains(&format!("{:.1} km/h", exact * 3.6)), "{exact}: {svg}");

    let drawn = run(&["draw", &case, "--what", "scene", "--units", "si"]);
    let svg = String::from_utf8(drawn.stdout).unwrap();
    assert!(svg.contains("not the answer: other evidence of the case contradicts it.</text>"), "{svg}");
    let said = String::from_utf8(drawn.stderr).unwrap();
    assert!(said.contains("`deltav reconstruct") && said.contains("weighs all the evidence."), "{said}");
}

/// A contact point 1.8 m before the outline of the vehicle, in a case without speeds.
#[test]
fn a_scene_without_speeds_has_the_warnings_of_check() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("drawn");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("outside.toml");
    let text = include_str!("../../../fixtures/estimate.toml");
    let outside = text.replacen("value = \"1.9 m\"", "value = \"3.9 m\"", 1);
    assert_ne!(outside, text);
    fs::write(&path, outside).unwrap();
    let case = path.display().to_string();
    let checked = run(&["check", &case, "--format", "json"]);
    let checked: Value = serde_json::from_slice(&checked.stdout).unwrap();
    assert_eq!(checked["warnings"].as_array().unwrap().len(), 1);
    let said = String::from_utf8(run(&["draw", &case, "--what", "scene"]).stderr).unwrap();
    assert!(said.contains(&format!("has 1 warning: `deltav check {case}` prints them.")), "{said}");
}

/// Against a tree, crush hardly says anything: a picture for a jury does not promise a speed that it lacks.
#[test]
fn a_plain_scene_says_that_a_speed_is_not_determined() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/leaning-tree.toml");
    let svg = String::from_utf8(run(&["draw", case, "--what", "scene", "--plain"]).stdout).unwrap();
    assert!(
        svg.contains("does not determine the speed that is not drawn") && !svg.contains(">before: "),
        "{svg}"
    );
}

/// Vehicle 2 was probably stationary: its density and the regions of both speeds are those of the draws in
/// which it moved, and the picture says how many it leaves out.
#[test]
fn a_stationary_vehicle_is_said_beside_its_density() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/rear-end-rest-uncertain.toml");
    let svg = String::from_utf8(run(&["draw", case, "--what", "estimate"]).stdout).unwrap();
    for region in ["inner", "outer"] {
        let path = svg.lines().find(|line| line.contains(&format!("joint-speeds-{region}\""))).unwrap();
        assert!(path.contains(" d=\"M"), "{path}");
    }
    let estimated = String::from_utf8(run(&["estimate", case, "--no-pieces"]).stdout).unwrap();
    let share = estimated.split_once("vehicle 2 was stationary: ").unwrap().1.split_once(" %").unwrap().0;
    assert!(svg.contains(&format!("without the {share} % for a stationary vehicle")), "{share}");
}
