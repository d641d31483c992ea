//! Messages that help further: units, technical terms, and the command that can answer.

#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::PathBuf;
use std::process::Command;

const CASE: &str = include_str!("../../../fixtures/estimate.toml");
const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");

/// The text of a command on a case, from both streams, and its exit status.
fn said(name: &str, text: &str, arguments: &[&str]) -> (String, i32) {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("words-{name}.toml"));
    fs::write(&path, text).unwrap();
    let drawing = path.with_extension("svg");
    let mut command = Command::new(env!("CARGO_BIN_EXE_deltav"));
    command.arg(arguments[0]).arg(&path).args(&arguments[1..]);
    if arguments[0] == "draw" {
        command.arg("-o").arg(&drawing);
    }
    let output = command.output().unwrap();
    let all = [output.stdout, output.stderr].concat();
    (String::from_utf8(all).unwrap(), output.status.code().unwrap())
}

#[test]
fn a_missing_unit_is_that_of_the_file_or_one_of_each_system() {
    for (text, expected) in [
        ("[vehicle1]\nspeed = \"35\"\n", "add the unit, as in \"35 m/s\" or \"35 mph\";"),
        ("[vehicle1]\nspeed = 35\n", "for example speed = \"35 m/s\" or speed = \"35 mph\";"),
        ("[vehicle1]\nmass = \"3500 lb\"\nspeed = \"35\"\n", "add the unit, as in \"35 mph\";"),
        ("[vehicle1]\nmass = \"1500 kg\"\nspeed = \"35\"\n", "add the unit, as in \"35 m/s\";"),
        ("[vehicle1]\nspeed = \"35\"\n[vehicle2]\nspeed = \"20 km/h\"\n", "add the unit, as in \"35 km/h\";"),
        ("[vehicle1]\nlength = \"15\"\n", "add the unit, as in \"15 m\" or \"15 ft\";"),
        ("[vehicle1]\nmass = \"1500\"\n", "add the unit, as in \"1500 kg\" or \"1500 lb\";"),
        ("[vehicle1]\nheading = \"15\"\n", "add the unit, as in \"15 deg\";"),
        ("[vehicle1.crush]\ndepths = [4, 5]\n", "depths = \"4 5 cm\""),
    ] {
        let (message, status) = said("unit", text, &["check"]);
        assert!(status == 2 && message.contains(expected), "{expected}\n{message}");
    }
}

#[test]
fn other_names_are_understood() {
    let edr = CASE.replace("[vehicle2.recorder]", "[vehicle2.edr]");
    let driver = CASE.replace("side = \"left\"", "side = \"driver\"");
    let bev = "[vehicle1.crush]\nbev = \"40 km/h\"\n".to_owned();
    for (text, expected) in [
        (edr, "did you mean \"recorder\"?"),
        (driver, "the driver's side is \"left\" where the steering wheel is on the left"),
        (bev, "did you mean \"ees\"?"),
    ] {
        let (message, status) = said("names", &text, &["check"]);
        assert!(status == 2 && message.contains(expected), "{expected}\n{message}");
    }
}

/// Every command that needs an unknown speed names the command that does without it.
#[test]
fn where_no_speed_is_known_the_estimate_is_named() {
    for command in ["reconstruct", "impact", "compare", "uncertainty"] {
        let (message, status) = said("estimate", CASE, &[command]);
        let expected = "if neither speed is known, `deltav estimate` finds both from all evidence";
        assert!(status == 2 && message.contains(expected), "{command}: {message}");
    }
    // One car stood and one rest is known: one equation too few for momentum, but not for all the evidence.
    let one_rest = "[surface]\nfriction = 0.7\n[vehicle1]\nweight = \"3775 lb\"\nclass = 4\nheading = \"0 deg\"\n\
                    contact = { x = \"7 ft\", y = \"0 ft\" }\n[vehicle2]\nweight = \"2679 lb\"\nclass = 2\nheading = \"110 deg\"\n\
                    speed = \"5 mph\"\ncontact = { x = \"0 ft\", y = \"-2.5 ft\" }\n[vehicle2.after]\ndrag = 0.3\n\
                    rest = { x = \"83 ft\", y = \"0 ft\", turned = \"0 deg\" }\n[impact]\ncrush_plane = \"0 deg\"\n\
                    restitution = 0.1\ntangential = { friction = 0.5 }\n[reconstruct]\nfind = \"vehicle1.speed\"\n";
    let (message, status) = said("one-rest", one_rest, &["reconstruct"]);
    assert!(
        status == 2 && message.contains("`deltav estimate` finds the speeds from all evidence"),
        "{message}"
    );
    let output = Command::new(env!("CARGO_BIN_EXE_deltav")).arg("--help").output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    assert!(help.contains("`deltav explain which command`") && help.contains("`deltav estimate`"), "{help}");
}

#[test]
fn what_cannot_be_drawn_says_why_and_what_can() {
    let both =
        PAPER.replace("find         = \"vehicle1.speed\"", "find = [\"vehicle1.speed\", \"vehicle2.speed\"]");
    assert!(both != PAPER);
    let (message, status) = said("both", &both, &["draw", "--what", "reconciliation"]);
    assert!(status == 2 && message.contains("follow from how the vehicles left the impact"), "{message}");
    let (message, status) = said("scene", CASE, &["draw", "--what", "scene"]);
    assert!(status == 0 && message.contains("does not give both speeds"), "{message}");
    let (message, status) = said("energy", CASE, &["draw", "--what", "energy"]);
    assert!(status == 2 && message.contains("this case has enough for --what scene, damage"), "{message}");
    assert!(!message.contains("pdof"), "{message}");
}

#[test]
fn a_reader_may_have_uk_units() {
    let (text, status) = said("uk", PAPER, &["reconstruct", "--units", "uk"]);
    // 22.87 m/s
    assert!(status == 0 && text.contains("Speed of vehicle 1: 51.16 mph (22.87 m/s)"), "{text}");
    assert!(text.contains(" kg ") && text.contains(" kN") && !text.contains(" lb"), "{text}");
    let (text, _) = said("uk-csv", PAPER, &["reconstruct", "--units", "uk", "--format", "csv"]);
    for column in ["found.value (mph)", "impact.energy_loss (J)", "vehicle2.pdof (deg)"] {
        assert!(text.contains(column), "{column}: {text}");
    }
}
