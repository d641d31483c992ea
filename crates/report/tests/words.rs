//! Signs, units and values that a reader must not overlook.

#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::ops::ControlFlow;

use analysis::Plan;
use case::CaseFile;
use report::{DrawingRequest, Subject, Units};
use serde_json::Value;
use uncertainty::{SamplingMethod, Settings};

/// Two vehicles of 1000 kg at right angles, which leave with one velocity: v₁ = 2 V_x, v₂ = 2 V_y.
fn crossing(speed: &str, direction: &str) -> CaseFile {
    let text = format!(
        r#"
[vehicle1]
mass = "1000 kg"
yaw_radius = "1.3 m"
heading = "0 deg"
contact = {{ x = "2 m", y = "0 m" }}
after = {{ speed = "{speed}", direction = "{direction}" }}
[vehicle2]
mass = "1000 kg"
yaw_radius = "1.3 m"
heading = "90 deg"
contact = {{ x = "0.2 m", y = "0.8 m" }}
after = {{ speed = "{speed}", direction = "{direction}" }}
[impact]
crush_plane = "0 deg"
restitution = 0.1
tangential = "critical"
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#
    );
    CaseFile::parse("crossing.toml", &text).unwrap()
}

#[test]
fn a_negative_speed_is_called_backwards() {
    // V = (6, −1.5) m/s: v₂ = −3 m/s = −10.8 km/h.
    let file = crossing("6.1846584384 m/s", "-14.0362434679 deg");
    let analysis = analysis::reconstruct(&file.case).unwrap();
    let codes: Vec<&str> = analysis.warnings.iter().map(analysis::Warning::code).collect();
    assert!(codes.contains(&"moves-backward"), "{codes:?}");
    let text = report::results(&file.case, &analysis, Units::Si).text();
    assert!(text.contains("Speed of vehicle 2: -10.8 km/h (-3.00 m/s), backwards\n"), "{text}");
    assert!(text.contains("Speed of vehicle 1: 43.2 km/h (12.00 m/s)\n"), "{text}");
    let plain = DrawingRequest { subject: Subject::Scene, plain: true }
        .draw(&file, &analysis, None, Units::Si, None)
        .unwrap();
    assert!(plain.svg().contains("before: 10.8 km/h backwards"));
    assert!(plain.description().contains("before: 10.8 km/h backwards"));
    assert!(plain.svg().contains("before: 43.2 km/h<"));
    let scene = report::drawing(&file, &analysis, Units::Si, Subject::Scene).unwrap();
    assert!(scene.svg().contains("before: 10.8 km/h backwards"));
}

/// Slightly wrong inputs give a vehicle that stood a speed below zero.
#[test]
fn a_vehicle_that_backs_slowly_was_probably_stationary() {
    // V = (6, −0.5) m/s: v₂ = −1 m/s = −3.6 km/h.
    let file = crossing("6.0207972894 m/s", "-4.7636416907 deg");
    let analysis = analysis::reconstruct(&file.case).unwrap();
    let text = report::results(&file.case, &analysis, Units::Si).text();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for told in [
        "A vehicle was probably stationary: the answer is the estimate from all evidence.",
        "The exact solution has vehicle 2 move backward at 3.6 km/h; if the inputs are slightly off, a stationary \
         vehicle comes out like this.",
    ] {
        assert!(text.contains(told), "{text}");
    }
    let scene = report::drawing(&file, &analysis, Units::Si, Subject::Scene).unwrap();
    let caveat = "not the answer: a vehicle that it has move backward was probably stationary.";
    assert!(scene.description().contains(caveat), "{}", scene.description());
    let json: Value = serde_json::from_str(&report::json(&file, &analysis).unwrap()).unwrap();
    assert_eq!(json["headline"]["why_not_exact"]["nearly_stood"], serde_json::json!(["vehicle2"]));
}

/// A vehicle that stood has a speed of zero, but for rounding: that is no movement.
#[test]
fn a_vehicle_that_stood_is_not_called_backwards() {
    for direction in ["0 deg", "-1e-9 deg"] {
        let file = crossing("6 m/s", direction);
        let analysis = analysis::reconstruct(&file.case).unwrap();
        assert!(analysis.warnings.iter().all(|warning| warning.code() != "moves-backward"));
        let text = report::results(&file.case, &analysis, Units::Si).text();
        assert!(text.contains("Speed of vehicle 2: 0.0 km/h (0.00 m/s)\n"), "{text}");
    }
}

#[test]
fn a_file_in_kilograms_metres_and_miles_per_hour_is_answered_so() {
    let text = r#"
[vehicle1]
mass = "1000 kg"
yaw_radius = "1.3 m"
heading = "0 deg"
contact = { x = "2 m", y = "0 m" }
speed = "30 mph"
[vehicle2]
mass = "1200 kg"
yaw_radius = "1.3 m"
heading = "180 deg"
contact = { x = "2 m", y = "0 m" }
speed = "20 mph"
[impact]
crush_plane = "0 deg"
restitution = 0.1
tangential = "critical"
"#;
    let units = |text: &str| Units::of_case(&CaseFile::parse("uk.toml", text).unwrap().case);
    assert_eq!(units(text), Units::Uk);
    assert_eq!(units(&text.replace("mph", "km/h")), Units::Si);
    assert_eq!(units(&text.replace("30 mph", "48 km/h")), Units::Si);
    // A speed in m/s counts neither way.
    assert_eq!(units(&text.replace("30 mph", "14 m/s")), Units::Uk);
    let us = text.replace(" kg\"", " lb\"").replace(" m\"", " ft\"");
    assert_eq!(units(&us), Units::Us);
    // 1 mph is 0.44704 m/s.
    let file = CaseFile::parse("uk.toml", text).unwrap();
    let analysis = analysis::impact(&file.case).unwrap();
    let text = report::results(&file.case, &analysis, Units::Uk).text();
    assert!(text.contains("1,000.0 kg") && text.contains("30.00 mph (13.41 m/s)"), "{text}");
    assert!([" N·s", " J ", " kg·m²", "2.000 m "].iter().all(|unit| text.contains(unit)), "{text}");
    assert!(!text.contains("km/h") && !text.contains("ft/s"), "{text}");
}

/// A case may have its speeds in the tables of its recorders alone: more columns in mph than in km/h count.
#[test]
fn the_tables_of_recorders_tell_the_units() {
    let pulse = |unit: &str| {
        format!("pulse = {{ time = \"0 10 20 ms\", delta_v_longitudinal = \"0 -9 -9 {unit}\" }}\n")
    };
    let before = |unit: &str| format!("pre_crash = {{ time = \"-1 0 s\", speed = \"30 29 {unit}\" }}\n");
    for (lines, units) in [
        (before("mph"), Units::Uk),
        (before("mph") + &pulse("mph"), Units::Uk),
        (before("km/h"), Units::Si),
        (before("mph") + &pulse("km/h"), Units::Si),
    ] {
        let file = CaseFile::parse("uk.toml", &format!("[vehicle1.recorder]\n{lines}")).unwrap();
        assert_eq!(Units::of_case(&file.case), units, "{lines}");
    }
}

/// Average crush of a car that was not inspected, by a force balance over the same width: the example of
/// GuideBook (energy2), A 479.7 and 355.8 lb/in, B 52.2 and 34.0 lb/in², C₁ 14 in, prints C₂ = 25.14 in.
#[test]
fn an_inferred_crush_stands_beside_the_measured_one() {
    let vehicle = |weight: &str, x: &str, rest: &str| {
        format!(
            "weight = \"{weight} lb\"\nclass = 3\nheading = \"0 deg\"\ncontact = {{ x = \"{x} ft\", y = \"0 ft\" }}\n\
             {rest}\n"
        )
    };
    let one = "crush = { side = \"front\", width = \"60 in\", depths = \"14 14 in\", pdof = \"0 deg\", \
               stiffness = { A = \"479.7 lb/in\", B = \"52.2 lb/in^2\" } }";
    let two = "crush = { side = \"rear\", width = \"60 in\", from_force_balance = true, \
               stiffness = { A = \"355.8 lb/in\", B = \"34.0 lb/in^2\" } }";
    let text = format!("[vehicle1]\n{}[vehicle2]\n{}", vehicle("3500", "7", one), vehicle("3000", "-7", two));
    let file = CaseFile::parse("inferred.toml", &text).unwrap();
    let analysis = analysis::crush(&file.case).unwrap();
    let text = report::results(&file.case, &analysis, Units::Us).text();
    let row =
        "crush depths, vehicle 2 25.1 in deep, 60.0 in wide, inferred from the force on the other vehicle";
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains(row), "{text}");
    let json: Value = serde_json::from_str(&report::json(&file, &analysis).unwrap()).unwrap();
    let inferred = |key: &str| json["vehicle2"]["inferred_crush"][key].as_f64().unwrap() / 0.0254;
    assert!((inferred("depth") - 25.14).abs() < 0.005 && (inferred("width") - 60.0).abs() < 1e-9, "{json}");
}

fn judged(text: &str) -> Value {
    let file = CaseFile::parse("case.toml", text).unwrap();
    serde_json::from_str(&report::judgement_json(&file, &analysis::judge(&file.case)).unwrap()).unwrap()
}

/// The words and switches of the file: no more and no less than it contains.
#[test]
fn check_reads_every_choice_back() {
    let choices = |text: &str| -> Vec<(String, String)> {
        let judged = judged(text);
        let rows = judged["choices"].as_array().unwrap().iter();
        rows.map(|row| [&row["path"], &row["value"]].map(|of| of.as_str().unwrap().to_owned()).into())
            .collect()
    };
    let has = |text: &str, wanted: &[(&str, &str)]| {
        let choices = choices(text);
        for (path, value) in wanted {
            assert!(choices.contains(&((*path).to_owned(), (*value).to_owned())), "{path}: {choices:#?}");
        }
        choices.len()
    };
    let rest = include_str!("../../../fixtures/rear-end-rest.toml");
    let locked = has(rest, &[("vehicle1.after.drag", "locked")]);
    let wheels = rest.replace("drag = \"locked\"", "drag = [\"locked\", 0.02, \"locked\", 0.02]");
    let each = has(&wheels, &[("vehicle1.after.drag[1]", "locked"), ("vehicle1.after.drag[3]", "locked")]);
    assert_eq!(each, locked + 1);
    let estimate = include_str!("../../../fixtures/estimate.toml");
    has(
        &format!("{estimate}\n[scene]\nlocked_together = true\n[estimate]\nprior = \"serious-injury\"\n"),
        &[("scene.locked_together", "true"), ("estimate.prior", "serious-injury")],
    );
    has(include_str!("../../../fixtures/avoid/from-stop.toml"), &[("avoid.demand.sight", "true")]);
    has(include_str!("../../../fixtures/avoid/evidence.toml"), &[("avoid.clear.outlines", "true")]);
    has(
        include_str!("../../../fixtures/depths-independent.toml"),
        &[(
            "uncertainty.exact",
            "vehicle1.crush.stiffness, vehicle2.crush.stiffness, vehicle1.yaw_inertia, vehicle2.yaw_inertia",
        )],
    );
}

#[test]
fn a_table_with_one_sample_has_one_time() {
    let recorder = include_str!("../../../fixtures/estimate.toml");
    let table = "[vehicle1.recorder.pre_crash]\ntime = \"0 s\"\nspeed = \"20 km/h\"\n";
    let choices = judged(&format!("{recorder}\n{table}"))["choices"].to_string();
    assert!(choices.contains("1 time, 0.00 s; "), "{choices}");
}

/// With e = 0.3 the normal impulse gives back 9 % of the crush energy, and both speeds are found with that.
#[test]
fn an_energy_that_the_basis_explains_is_no_disagreement() {
    let rest = include_str!("../../../fixtures/rear-end-rest.toml");
    let absorbed = rest.replace("restitution = 0.1", "restitution = 0.3") + "energy_basis = \"absorbed\"\n";
    let file = CaseFile::parse("case.toml", &absorbed).unwrap();
    let analysis = analysis::reconstruct(&file.case).unwrap();
    let svg = report::drawing(&file, &analysis, Units::Si, Subject::Energy).unwrap().svg();
    assert!(svg.contains("restitution returns the rest"), "{svg}");
    assert!(!svg.contains("do not agree"));
}

/// Both speeds by momentum: the crush energy differs from the normal work by 0.07 %, which is no
/// disagreement; that of depths four times as large is beyond the limit of the check.
#[test]
fn energies_within_the_limit_of_the_check_do_not_disagree() {
    let intersection = include_str!("../../case/templates/si/intersection.toml");
    let note = |text: &str| {
        let file = CaseFile::parse("case.toml", text).unwrap();
        let analysis = analysis::reconstruct(&file.case).unwrap();
        let svg = report::drawing(&file, &analysis, Units::Si, Subject::Energy).unwrap().svg();
        let said = ["finds no contradiction between them", "the damage and the impact do not agree"];
        said.map(|words| svg.contains(words))
    };
    assert_eq!(note(intersection), [true, false]);
    let deep = intersection
        .replace("\"10 14 18 21 cm\"", "\"48 68 88 104 cm\"")
        .replace("\"6 10 14 12 6 cm\"", "\"40 68 88 80 36 cm\"");
    assert_eq!(note(&deep), [false, true]);
}

/// Against a barrier, without restitution, the ΔV is the speed, whatever the mass.
#[test]
fn nothing_drives_a_result_that_does_not_vary() {
    let text = r#"
[vehicle1]
mass = { value = "1500 kg", sd = "50 kg" }
yaw_radius = "1.45 m"
heading = "0 deg"
speed = "10 m/s"
contact = { x = "1.9 m", y = "0 m" }
[vehicle2]
fixed = true
[impact]
crush_plane = "0 deg"
restitution = 0
tangential = "critical"
"#;
    let file = CaseFile::parse("case.toml", text).unwrap();
    let plan = Plan { settings: Settings::new(SamplingMethod::MonteCarlo, 1000, 1), index_rows: None };
    let quietly = &mut |_, _, _| ControlFlow::Continue(());
    let found = analysis::uncertainty(&file.case, &plan, quietly).unwrap();
    let text = report::uncertainty(&file.case, &found, Units::Si).text();
    assert!(text.contains("does not vary"), "{text}");
    assert!(!text.contains("Main drivers: ΔV of vehicle 1"), "{text}");
}

/// Vehicle 1 is given and vehicle 2 is followed back from its rest: the sentence has each mark once.
#[test]
fn the_evidence_after_the_impact_is_told_in_a_sentence() {
    let given =
        include_str!("../../../fixtures/motion/ricsac-6.toml").split("[vehicle2.after]").next().unwrap();
    let rest =
        "[vehicle2.after]\ndrag = 0.3\nrest = { x = \"-1.5 m\", y = \"6.2 m\", heading = \"-120 deg\" }\n";
    let find = "[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n";
    let file = CaseFile::parse("case.toml", &format!("{given}{rest}{find}")).unwrap();
    let analysis = analysis::reconstruct(&file.case).unwrap();
    let text = report::results(&file.case, &analysis, Units::Si).text();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        text.contains("which the case gives or which is known from the rest position; the headings differ"),
        "{text}"
    );
}
