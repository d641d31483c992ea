//! A recorder's table as evidence, and what disagrees with it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use analysis::{Evident, Warning, estimate_evidence, impact, recorders};
use case::CaseFile;

/// Two cars that meet front to front along one line.
fn head_on(recorder: &str) -> CaseFile {
    let vehicle = |n: u8, heading: u16, speed: u8| {
        format!(
            "[vehicle{n}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"{heading} deg\"\nspeed = \"{speed} km/h\"\n\
             contact = {{ x = \"2 m\", y = \"0 m\" }}\n"
        )
    };
    let text = format!(
        "{}{}[vehicle1.recorder]\n{recorder}\n[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n",
        vehicle(1, 0, 50),
        vehicle(2, 180, 40)
    );
    CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn table(last: u8) -> String {
    format!(
        "pre_crash = {{ time = \"-1 -0.5 0 s\", speed = \"{last} {last} {last} km/h\", brake = \"off off off\" }}"
    )
}

fn differs(file: &CaseFile) -> Vec<Evident> {
    let analysis = impact(&file.case).unwrap();
    let warnings = analysis.warnings.iter();
    warnings
        .filter_map(|warning| match warning {
            Warning::EvidenceDiffers { evidence, .. } => Some(*evidence),
            _ => None,
        })
        .collect()
}

/// The case has 50 km/h: a table that ends at 50 agrees, and one at 65 does not.
#[test]
fn a_speed_that_the_table_contradicts_is_told() {
    assert_eq!(differs(&head_on(&table(50))), []);
    assert_eq!(differs(&head_on(&table(65))), [Evident::TabledSpeed]);
}

/// Both of 1500 kg at 50 and 40 km/h with e = 0.1: ΔV = 1.1 · 90/2 = 49.5 km/h.
#[test]
fn a_pulse_that_disagrees_is_told_and_one_cut_off_is_not() {
    let pulse = |values: &str| {
        format!("pulse = {{ time = \"0 20 40 60 80 100 120 ms\", delta_v_longitudinal = \"{values} km/h\" }}")
    };
    assert_eq!(differs(&head_on(&pulse("0 -10 -25 -40 -49 -49 -49"))), []);
    assert_eq!(differs(&head_on(&pulse("0 -8 -15 -20 -25 -25 -25"))), [Evident::PulseLongitudinal]);
    // Still falling at its end: a lower bound.
    let cut = head_on(&pulse("0 -3 -6 -10 -15 -20 -25"));
    assert_eq!(differs(&cut), []);
    let reading = recorders(&cut.case).unwrap();
    let found = reading.vehicles[0].as_ref().unwrap();
    assert!(found.is_cut && found.delta_v.is_none());
}

#[test]
fn an_estimate_takes_the_table_as_evidence() {
    let evidence = |recorder: &str| {
        let text = head_on(recorder)
            .source
            .text()
            .replace("speed = \"50 km/h\"", "")
            .replace("speed = \"40 km/h\"", "");
        estimate_evidence(&CaseFile::parse("case.toml", &text).unwrap().case).unwrap()
    };
    assert_eq!(evidence(&table(50)), ["vehicle1.recorder.speed"]);
    // A table of a vehicle that stood, and a pulse that was cut off, are left out.
    assert_eq!(evidence(&table(0)), [""; 0]);
    let whole = "pulse = { time = \"0 20 40 60 80 100 120 ms\", delta_v_longitudinal = \"0 -10 -25 -40 -49 -49 -49 km/h\" }";
    assert_eq!(evidence(whole), ["vehicle1.recorder.delta_v"]);
    assert_eq!(evidence(&whole.replace("-40 -49 -49 -49", "-40 -49 -59 -69")), [""; 0]);
}

/// A recorder 1 m ahead of the centre of gravity; the vehicle then turns to the left by 90 °/s = π/2 rad/s:
/// what it stored to the left is by π/2 m/s too much.
#[test]
fn a_recorder_away_from_the_centre_is_taken_there() {
    let file = head_on(
        "pulse = { time = \"0 20 40 60 80 100 ms\", delta_v_longitudinal = \"0 -20 -40 -49 -49 -49 km/h\", \
         delta_v_lateral = \"0 -4 -8 -10 -10 -10 km/h\" }\nat = { x = \"1 m\", y = \"0 m\" }\nyaw_rate = \"90 deg/s\"",
    );
    let told = file.case.vehicles[0].recorder.as_ref().unwrap().tells_delta_v(file.case.axes).unwrap();
    assert!((told.along.unwrap() + 49.0 / 3.6).abs() < 1e-9);
    assert!((told.left.unwrap() - (10.0 / 3.6 - std::f64::consts::FRAC_PI_2)).abs() < 1e-9, "{told:?}");
}
