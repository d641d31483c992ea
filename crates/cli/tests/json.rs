//! The JSON that the program prints: its keys, the values of the paper's example, and that neither the frame,
//! the labels nor the units of a case change them. Everything goes through the program, from text to text.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// The example's own file, as the program reads it.
const POLE: &str = include_str!("../../../fixtures/pole.toml");
const PAPER_FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/sae-980025.toml");
const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");

/// Runs the program, with a case on standard input.
fn deltav(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_deltav"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that does not read its standard input closes it.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

/// The output of the program, which must report no error.
#[track_caller]
fn printed(arguments: &[&str], input: &str) -> Vec<u8> {
    let output = deltav(arguments, input.as_bytes());
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), &*message), (Some(0), ""));
    output.stdout
}

#[track_caller]
fn json(command: &str, case: &str) -> Value {
    let mut document: Value =
        serde_json::from_slice(&printed(&[command, "-", "--format", "json"], case)).unwrap();
    // The hash is that of the text, but the collisions are compared.
    document.as_object_mut().unwrap().remove("case").unwrap();
    document
}

/// The text on standard error of the program, which must end with status 2 and print nothing.
#[track_caller]
fn refused(arguments: &[&str], input: &[u8]) -> String {
    let output = deltav(arguments, input);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert_eq!(output.stdout, b"");
    String::from_utf8(output.stderr).unwrap()
}

fn temporary(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// `text` with one place replaced.
#[track_caller]
fn with(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old:?} has to stand once in the case");
    text.replace(old, new)
}

/// The kind of value of a key.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Text,
    Count,
    Number,
    Pair,
}
use Kind::{Count, Number, Pair, Text};

const FOUND: [(&str, Kind); 3] = [("quantity", Text), ("value", Number), ("admissible_roots", Count)];
const IMPACT: [(&str, Kind); 13] = [
    ("restitution", Number),
    ("impulse_ratio", Number),
    ("critical_impulse_ratio", Number),
    ("normal_impulse", Number),
    ("tangential_impulse", Number),
    ("impulse", Pair),
    ("normal_velocity", Pair),
    ("tangential_velocity", Pair),
    ("initial_energy", Number),
    ("final_energy", Number),
    ("energy_loss", Number),
    ("normal_work", Number),
    ("tangential_work", Number),
];
const MOTION: [(&str, Kind); 9] = [
    ("speed", Number),
    ("velocity", Pair),
    ("yaw_rate", Number),
    ("final_velocity", Pair),
    ("final_yaw_rate", Number),
    ("final_speed", Number),
    ("delta_v", Number),
    ("delta_v_vector", Pair),
    ("pdof", Number),
];
const CRUSH: [(&str, Kind); 5] = [
    ("crush_energy", Number),
    ("oblique_angle", Number),
    ("oblique_factor", Number),
    ("corrected_crush_energy", Number),
    ("ees", Number),
];
const CRASH3: [(&str, Kind); 6] = [
    ("crush_energy", Number),
    ("corrected_crush_energy", Number),
    ("moment_arm", Pair),
    ("effective_mass_ratio", Pair),
    ("delta_v", Pair),
    ("corrected_delta_v", Pair),
];

/// Asserts that the object at `pointer` has these keys, each with its kind of value.
#[track_caller]
fn assert_keys(document: &Value, pointer: &str, keys: &[(&str, Kind)]) {
    for (key, kind) in keys {
        let value = document.pointer(&format!("{pointer}/{key}"));
        let fits = value.is_some_and(|value| match kind {
            Text => value.is_string(),
            Count => value.is_u64(),
            Number => value.is_number(),
            Pair => value.as_array().is_some_and(|pair| pair.len() == 2 && pair.iter().all(Value::is_number)),
        });
        assert!(fits, "{pointer}/{key} has to be {kind:?}, and is {value:?}");
    }
}

/// Asserts that nothing is null, which is how JSON writes NaN and infinities.
#[track_caller]
fn assert_no_null(document: &Value) {
    match document {
        Value::Null => panic!("null in the document"),
        Value::Array(elements) => elements.iter().for_each(assert_no_null),
        Value::Object(keys) => keys.values().for_each(assert_no_null),
        Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

#[track_caller]
fn number(document: &Value, pointer: &str) -> f64 {
    let value = document.pointer(pointer).and_then(Value::as_f64);
    value.unwrap_or_else(|| panic!("{pointer} is no number"))
}

/// Asserts that a value is what was printed, within half a unit of the last digit printed; `unit` is that of
/// the print.
#[track_caller]
fn assert_printed(document: &Value, pointer: &str, printed: &str, unit: f64) {
    let decimals = printed.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let half = 0.5 * 10_f64.powi(-i32::try_from(decimals).unwrap());
    let (actual, expected) = (number(document, pointer) / unit, printed.parse::<f64>().unwrap());
    assert!((actual - expected).abs() <= half, "{pointer} is {actual}, printed {printed}");
}

#[test]
fn every_key_of_the_example_is_there() {
    let document = json("reconstruct", PAPER);
    assert_no_null(&document);
    assert_keys(&document, "", &[("title", Text), ("energy_basis", Text)]);
    let warned = json("reconstruct", &with(PAPER, "[vehicle1]\n", "[vehicle1]\nspeed = \"75 ft/s\"\n"));
    assert_keys(&warned, "/warnings/0", &[("code", Text), ("vehicle", Number), ("message", Text)]);
    assert_keys(&document, "/found", &FOUND);
    assert_keys(&document, "/impact", &IMPACT);
    for vehicle in ["/vehicle1", "/vehicle2"] {
        assert_keys(&document, vehicle, &MOTION);
        assert_keys(&document, vehicle, &CRUSH);
    }
    assert_keys(&document, "/crash3", &CRASH3);
}

/// The figures of docs/theory.md for the paper's example, which follow from its equations solved with other
/// code.
#[test]
fn the_example_has_the_known_values() {
    const FOOT: f64 = 0.3048;
    const MPH: f64 = 0.44704;
    let document = json("reconstruct", PAPER);
    for (pointer, expected) in [
        ("/title", "Intersection collision, GMC Jimmy and Nissan Altima"),
        ("/energy_basis", "dissipated"),
        ("/found/quantity", "vehicle1.speed"),
    ] {
        assert_eq!(document.pointer(pointer).and_then(Value::as_str), Some(expected), "{pointer}");
    }
    assert_eq!(document.pointer("/warnings/0"), None);
    assert_eq!(document.pointer("/found/admissible_roots").and_then(Value::as_u64), Some(1));
    for (pointer, printed, unit) in [
        ("/found/value", "22.869", 1.0),
        ("/found/value", "75.03", FOOT),
        ("/impact/restitution", "0.3", 1.0),
        ("/impact/impulse_ratio", "0.36885", 1.0),
        ("/impact/critical_impulse_ratio", "0.36885", 1.0),
        ("/impact/normal_impulse", "19112.9", 1.0),
        ("/impact/tangential_impulse", "7049.8", 1.0),
        ("/impact/impulse/0", "20348.1", 1.0),
        ("/impact/impulse/1", "-978.6", 1.0),
        ("/impact/normal_velocity/0", "-21.05", 1.0),
        ("/impact/normal_velocity/1", "6.32", 1.0),
        ("/impact/tangential_velocity/0", "-13.41", 1.0),
        ("/impact/tangential_velocity/1", "0.0", 1.0),
        ("/impact/initial_energy", "453862", 1.0),
        ("/impact/final_energy", "265785", 1.0),
        ("/impact/energy_loss", "188076", 1.0),
        ("/impact/normal_work", "140821", 1.0),
        ("/impact/tangential_work", "47255", 1.0),
        ("/vehicle1/speed", "22.869", 1.0),
        ("/vehicle1/velocity/0", "-22.869", 1.0),
        ("/vehicle1/velocity/1", "0.000", 1.0),
        ("/vehicle1/yaw_rate", "0.0", 1.0),
        ("/vehicle1/final_velocity/0", "-35.21", FOOT),
        ("/vehicle1/final_velocity/1", "-1.92", FOOT),
        ("/vehicle1/final_yaw_rate", "-3.98", 1.0),
        // √(35.21² + 1.92²), √(37.39² + 15.57²)
        ("/vehicle1/final_speed", "35.3", FOOT),
        ("/vehicle2/final_speed", "40.5", FOOT),
        ("/vehicle1/delta_v", "12.15", 1.0),
        ("/vehicle1/delta_v", "27.18", MPH),
        ("/vehicle1/pdof", "0.048", 1.0),
        ("/vehicle1/crush_energy", "102165", 1.0),
        ("/vehicle1/oblique_angle", "0.048", 1.0),
        ("/vehicle1/oblique_factor", "1.002", 1.0),
        ("/vehicle1/corrected_crush_energy", "1024", 100.0),
        ("/vehicle1/ees", "11.04", 1.0),
        ("/vehicle2/speed", "10", MPH),
        // 10 mph along 67°, with the corrected sign of the appendix.
        ("/vehicle2/velocity/0", "5.7", FOOT),
        ("/vehicle2/velocity/1", "13.5", FOOT),
        ("/vehicle2/yaw_rate", "0.0", 1.0),
        ("/vehicle2/final_velocity/0", "-37.39", FOOT),
        ("/vehicle2/final_velocity/1", "15.57", FOOT),
        ("/vehicle2/final_yaw_rate", "4.11", 1.0),
        ("/vehicle2/delta_v", "29.44", MPH),
        ("/vehicle2/crush_energy", "38657", 1.0),
        ("/crash3/crush_energy", "140821", 1.0),
        ("/crash3/moment_arm/0", "0.646", 1.0),
        ("/crash3/moment_arm/1", "0.592", 1.0),
        ("/crash3/effective_mass_ratio/0", "0.825", 1.0),
        ("/crash3/effective_mass_ratio/1", "0.844", 1.0),
        ("/crash3/delta_v/0", "8.2", 1.0),
        ("/crash3/delta_v/1", "8.9", 1.0),
        ("/crash3/delta_v/0", "26.9", FOOT),
        ("/crash3/delta_v/1", "29.2", FOOT),
    ] {
        assert_printed(&document, pointer, printed, unit);
    }

    // Values that are not printed follow from printed ones.
    let at = |pointer: &str| number(&document, pointer);
    for (pointer, expected) in [
        // The impulse comes from −P₂ = P₁: clockwise from the heading of 67° to where it comes from.
        ("/vehicle2/pdof", 67_f64.to_radians() - at("/impact/impulse/1").atan2(at("/impact/impulse/0"))),
        ("/vehicle2/oblique_angle", at("/vehicle2/pdof") - PI / 2.0),
        ("/vehicle2/oblique_factor", 1.0 + at("/vehicle2/oblique_angle").tan().powi(2)),
        ("/vehicle2/corrected_crush_energy", at("/vehicle2/crush_energy") * at("/vehicle2/oblique_factor")),
        ("/vehicle2/ees", (2.0 * at("/vehicle2/crush_energy") / (3413.0 * 0.45359237)).sqrt()),
        (
            "/crash3/corrected_crush_energy",
            at("/vehicle1/corrected_crush_energy") + at("/vehicle2/corrected_crush_energy"),
        ),
    ] {
        assert!(
            (at(pointer) / expected - 1.0).abs() <= 1e-12,
            "{pointer} is {}, not {expected}",
            at(pointer)
        );
    }
    let growth = (at("/crash3/corrected_crush_energy") / at("/crash3/crush_energy")).sqrt();
    for i in 0..2 {
        let ratio = at(&format!("/crash3/corrected_delta_v/{i}")) / at(&format!("/crash3/delta_v/{i}"));
        assert!((ratio / growth - 1.0).abs() <= 1e-12);
        let (after, before) =
            (at(&format!("/vehicle1/final_velocity/{i}")), at(&format!("/vehicle1/velocity/{i}")));
        assert!((at(&format!("/vehicle1/delta_v_vector/{i}")) - (after - before)).abs() <= 1e-12);
        let (after, before) =
            (at(&format!("/vehicle2/final_velocity/{i}")), at(&format!("/vehicle2/velocity/{i}")));
        assert!((at(&format!("/vehicle2/delta_v_vector/{i}")) - (after - before)).abs() <= 1e-12);
    }
}

#[test]
fn an_impact_finds_nothing() {
    let document = json("impact", include_str!("../../../fixtures/sae-980025-impact.toml"));
    assert_no_null(&document);
    assert_eq!(document.get("found"), None);
    assert_keys(&document, "/impact", &IMPACT);
    for vehicle in ["/vehicle1", "/vehicle2"] {
        assert_keys(&document, vehicle, &MOTION);
    }
}

#[test]
fn damage_alone_has_crash3_and_the_crush_keys() {
    let document = json("crush", include_str!("../../../fixtures/sae-980025-crush.toml"));
    assert_no_null(&document);
    assert_eq!((document.get("found"), document.get("impact")), (None, None));
    assert_keys(&document, "/crash3", &CRASH3);
    for vehicle in ["/vehicle1", "/vehicle2"] {
        assert_keys(&document, vehicle, &CRUSH);
        assert_eq!(document.pointer(&format!("{vehicle}/velocity")), None);
    }
    // The paper: 1.16e5 and 7.31e4 N·m with the angles of this case, 27.6 and 29.9 ft/s with its arms.
    assert_printed(&document, "/vehicle1/corrected_crush_energy", "1.16", 1e5);
    assert_printed(&document, "/vehicle2/corrected_crush_energy", "7.31", 1e4);
    assert_printed(&document, "/crash3/delta_v/0", "27.6", 0.3048);
    assert_printed(&document, "/crash3/delta_v/1", "29.9", 0.3048);
}

/// A pole takes no energy and does not move: EBS = √(2E/m), ΔV = √(2γE/m), and with a dissipated energy
/// √((1+e)/(1−e)) times that.
#[test]
fn a_pole_gives_the_barrier_speed_and_one_velocity_change() {
    let mut document = json("crush", POLE);
    take_nulls(&mut document, &["/crash3/moment_arm", "/crash3/delta_v", "/crash3/corrected_delta_v"]);
    for correction in document["crash3"]["corrections"].as_array_mut().unwrap() {
        take_nulls(correction, &["/delta_v", "/friction"]);
    }
    assert_no_null(&document);
    let at = |pointer: &str| number(&document, pointer);
    // Two zones of 0.3 m from 0.4 to 0.5 m: A C̄ + B Q/2 + A²/2B with C̄ = 0.45 m and Q = (0.16 + 0.2 +
    // 0.25)/3 m².
    let (a, b): (f64, f64) = (50e3, 800e3);
    let energy = 0.6 * (a * 0.45 + b * 0.61 / 6.0 + a * a / (2.0 * b));
    let close = |pointer: &str, expected: f64| {
        let actual = at(pointer);
        assert!((actual / expected - 1.0).abs() < 1e-12, "{pointer}: {actual} is not {expected}");
    };
    close("/vehicle1/crush_energy", energy);
    close("/vehicle1/ees", (2.0 * energy / 1500.0).sqrt());
    // The force passes the CG at 0.3 m.
    let ratio = 1.96 / (1.96 + 0.09);
    close("/crash3/effective_mass_ratio/0", ratio);
    close("/crash3/delta_v/0", (2.0 * ratio * energy / 1500.0).sqrt());
    close("/crash3/restitution_factor", (1.1_f64 / 0.9).sqrt());
}

/// A pole has no ΔV, whichever way the force came.
#[test]
fn the_sweep_has_nothing_of_what_is_fixed() {
    let mut document = json("sensitivity", POLE);
    let rows = document["pdof_sweep"].as_array_mut().unwrap();
    assert!(rows.len() > 2);
    for row in rows {
        let of_both = [
            "/pdof",
            "/oblique_angle",
            "/moment_arm",
            "/uncorrected_delta_v",
            "/delta_v",
            "/capped_delta_v",
            "/uncapped_delta_v",
        ];
        take_nulls(row, &of_both);
        assert!(number(row, "/uncorrected_delta_v/0") > 0.0);
    }
    let text = String::from_utf8(printed(&["sensitivity", "-"], POLE)).unwrap();
    let sweep = text.split("PDOF sweep").nth(1).unwrap();
    let rows: Vec<&str> =
        sweep.lines().filter(|line| line.contains("(nominal)") || line.contains(" 0.00")).collect();
    assert!(rows.len() == 1 && !rows[0].contains(" 0.00"), "{sweep}");
}

/// An arm beside an energy keeps its value like one beside a profile.
#[test]
fn the_sweep_says_which_arms_of_energies_are_kept() {
    let vehicle = |id: u8, crush: &str| {
        format!(
            "[vehicle{id}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\ncrush = {{ ees = \"40 km/h\", {crush} }}\n"
        )
    };
    let case = vehicle(1, "pdof = \"10 deg\", moment_arm = \"0.3 m\"")
        + &vehicle(2, "pdof = \"-80 deg\", moment_arm = \"0.5 m\"");
    let document = json("sensitivity", &case);
    let kept = ["vehicle1.crush.moment_arm", "vehicle2.crush.moment_arm"];
    assert_eq!(document["pdof_sweep_held"], serde_json::json!(kept));
    assert_eq!(document.get("pdof_sweep_turned"), None);
}

/// Arm and angle from the file are said to be kept or turned, and the nominal row is the answer of `crush`.
#[test]
fn the_sweep_says_what_the_file_gives() {
    for key in ["pdof_sweep_held", "pdof_sweep_turned"] {
        assert_eq!(json("sensitivity", POLE).get(key), None);
    }
    let line = POLE.lines().find(|line| line.starts_with("pdof")).unwrap();
    let given = "pdof = \"0 deg\"\nmoment_arm = \"0.9 m\"\noblique_angle = \"30 deg\"";
    let case = POLE.replace(line, given);
    let document = json("sensitivity", &case);
    assert_eq!(document["pdof_sweep_held"], serde_json::json!(["vehicle1.crush.moment_arm"]));
    assert_eq!(document["pdof_sweep_turned"], serde_json::json!(["vehicle1.crush.oblique_angle"]));
    let rows = document["pdof_sweep"].as_array().unwrap();
    let nominal = rows.iter().find(|row| row["change"] == 0.0).unwrap();
    let alone = json("crush", &case);
    assert_eq!(nominal["uncorrected_delta_v"], alone["crash3"]["delta_v"]);
    assert_eq!(nominal["delta_v"], alone["crash3"]["corrected_delta_v"]);
    assert_eq!(nominal["oblique_angle"][0], alone["vehicle1"]["oblique_angle"]);
    let text = String::from_utf8(printed(&["sensitivity", "-"], &case)).unwrap();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("The moment arm of vehicle 1 keeps the value that the file gives."), "{text}");
    assert!(
        text.contains("The oblique angle of vehicle 1 starts at the value that the file gives"),
        "{text}"
    );
}

/// CRASH3's friction limits are given for each vehicle, in text and in JSON.
#[test]
fn friction_limits_are_told_by_vehicle() {
    let case = PAPER
        .replace("[vehicle1.crush]", "[vehicle1.crush]\noblique = { friction = 0.8 }")
        .replace("[vehicle2.crush]", "[vehicle2.crush]\noblique = { friction = 0.05 }");
    let document = json("reconstruct", &case);
    let rows = document["crash3"]["corrections"].as_array().unwrap();
    for row in rows {
        let expected = (row["oblique"] == "friction").then(|| serde_json::json!([0.8, 0.05]));
        assert_eq!(row.get("friction"), expected.as_ref());
    }
    let compared = json("compare", &case);
    let rows = compared["rows"].as_array().unwrap();
    let row = rows.iter().find(|row| row["law"] == "CRASH3, friction-limited").unwrap();
    assert_eq!(row["friction"], serde_json::json!([0.8, 0.05]));
    assert!(row["coefficients"].as_str().unwrap().ends_with("1+min(tan²α,μ|tanα|), μ_1 = 0.8, μ_2 = 0.05"));
    let text = String::from_utf8(printed(&["reconstruct", "-"], &case)).unwrap();
    assert!(text.contains("The friction limit μ is 0.8 for vehicle 1 and 0.05 for vehicle 2.\n"), "{text}");
}

/// Takes the second number of each pair, which has to be null, away.
#[track_caller]
fn take_nulls(document: &mut Value, pointers: &[&str]) {
    for pointer in pointers {
        // Not every answer is corrected.
        let Some(pair) = document.pointer_mut(pointer) else { continue };
        let second = pair.as_array_mut().unwrap().pop();
        assert_eq!(second, Some(Value::Null), "{pointer}");
    }
}

/// A hundred strips of grass beside the road would keep the estimate behind a report busy for minutes.
#[test]
fn a_report_on_very_many_zones_goes_without_an_estimate_and_says_so() {
    let strip = |x: usize| {
        let corner = |x: usize, y: usize| format!("{{ x = \"{x} m\", y = \"{y} m\" }}");
        let corners = [corner(x, 50), corner(x + 1, 50), corner(x, 60)].join(", ");
        format!("{{ friction = 0.4, polygon = [{corners}] }}")
    };
    let strips: Vec<String> = (0..100).map(strip).collect();
    let case = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/rear-end-rest.toml"));
    let case = case.unwrap();
    let many = case.replacen("[surface]\n", &format!("[surface]\nzone = [{}]\n", strips.join(", ")), 1);
    // The exact solution is the answer.
    let many = format!("{many}\n[estimate]\ncrush_bias = \"100 %\"\n");
    let page = printed(&["reconstruct", "-", "--format", "markdown"], &many);
    let page = String::from_utf8(page).unwrap();
    assert!(page.contains("so many zones") && page.contains("`deltav estimate` computes it"), "{page}");
    assert!(!page.contains("with the errors of the method) "), "{page}");
}

/// The report of a case with ranges has their uncertainty and the sensitivity, word for word as the commands
/// print them.
#[test]
fn ranges_are_in_the_report_to_hand_over() {
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let uncertain = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/sae-980025-uncertain.toml");
    let page = text(printed(&["reconstruct", uncertain, "--format", "markdown"], ""));
    // The tables of both commands, row by row.
    let mut rows = 0;
    for command in [&["uncertainty", uncertain][..], &["sensitivity", uncertain]] {
        let alone = text(printed(&[command, &["--format", "markdown"]].concat(), ""));
        for row in alone.lines().filter(|line| line.starts_with('|')) {
            assert!(page.contains(row), "{row}");
            rows += 1;
        }
    }
    assert!(rows > 100, "{rows}");
    let html = text(printed(&["reconstruct", uncertain, "--format", "html"], ""));
    assert!(html.contains("<h2>Uncertainty</h2>") && html.contains("<h2>Sensitivity</h2>"));
    let certain = text(printed(&["reconstruct", PAPER_FILE, "--format", "markdown"], ""));
    assert!(!certain.contains("## Uncertainty"));
    // It leads with the 95 % interval that includes the errors of the method; that of the table is next to
    // it.
    let row = page.lines().skip_while(|line| *line != "**Intervals**");
    let row = row.into_iter().find(|line| line.starts_with("| Speed of vehicle 1, mph")).unwrap();
    let cells: Vec<&str> = row.split('|').map(|cell| cell.split_whitespace().next().unwrap_or("")).collect();
    let lead = page.split("before impact: ").nth(1).and_then(|rest| rest.split(".**").next()).unwrap();
    let [wide, narrow] =
        [" mph (95 %, with the errors of the method)", " mph (95 %, by the ranges of the case alone)"]
            .map(|words| lead.split(words).next().unwrap());
    let ends: Vec<&str> = narrow.rsplit(", ").next().unwrap().split(" to ").collect();
    let wider: Vec<f64> = wide.split(" to ").map(|end| end.parse().unwrap()).collect();
    // One decimal, and two of which the second is rounded.
    let near = |one: &str, other: &str| {
        let [one, other] = [one, other].map(|text| text.parse::<f64>().unwrap());
        (one - other).abs() < 0.0551
    };
    assert!(ends.len() == 2 && near(ends[0], cells[6]) && near(ends[1], cells[7]), "{ends:?} {row}");
    assert!(wider[0] < cells[6].parse().unwrap() && wider[1] > cells[7].parse().unwrap(), "{wider:?} {row}");
    // No more digits than the wider interval leaves.
    assert!(lead.contains("; as solved 51 mph, "), "{lead}");
    assert!(certain.contains("**Speed of vehicle 1 before impact: 51.16 mph (75.03 ft/s).**"));
    for page in [page, certain] {
        assert!(page.contains("## Known error rate") && page.contains("## Appendix: ΔV by CRASH3"), "{page}");
    }
}

#[test]
fn every_way_in_and_out_has_the_same_bytes() {
    for format in ["json", "text"] {
        let from_file = printed(&["reconstruct", PAPER_FILE, "--format", format], "");
        assert!(from_file.len() > 1000);
        assert_eq!(from_file, printed(&["reconstruct", PAPER_FILE, "--format", format], ""));
        let from_input =
            String::from_utf8(printed(&["reconstruct", "-", "--format", format], PAPER)).unwrap();
        // The name of the file, which standard input does not have.
        let named = from_input.replace("\"file\": \"standard input\"", "\"file\": \"sae-980025.toml\"");
        assert_eq!(from_file, named.into_bytes());

        let path = temporary(&format!("out.{format}"));
        // An older and longer file leaves nothing behind.
        fs::write(&path, vec![b'x'; 100_000]).unwrap();
        let arguments = ["reconstruct", PAPER_FILE, "--format", format, "-o", path.to_str().unwrap()];
        assert_eq!(printed(&arguments, ""), b"");
        assert_eq!(fs::read(&path).unwrap(), from_file);
    }
}

fn law(name: &str) -> Value {
    json("reconstruct", &fs::read_to_string(format!("../../fixtures/laws/{name}.toml")).unwrap())
}

#[test]
fn the_impact_names_its_law_and_what_the_law_adds() {
    for (case, name, regime) in [
        ("woolley", "woolley", None),
        ("woolley-sideswipe", "woolley", None),
        ("ishikawa", "ishikawa", None),
        // The common tangential velocity needs μ = 0.37, and the limit is 0.3.
        ("kudlich-slibar", "kudlich-slibar", Some("sliding")),
        ("restitution-curve", "brach", None),
        ("moment", "brach", None),
    ] {
        let document = law(case);
        assert_no_null(&document);
        assert_keys(&document, "/impact", &IMPACT);
        let impact = &document["impact"];
        assert_eq!((&impact["law"], impact.get("regime")), (&name.into(), regime.map(Value::from).as_ref()));
        let moment = (impact.get("moment_impulse").is_some(), impact.get("moment_work").is_some());
        assert_eq!(moment, (case == "moment", case == "moment"), "{case}");
    }
    let full = fs::read_to_string("../../fixtures/laws/kudlich-slibar.toml").unwrap();
    let full = json("reconstruct", &with(&full, "friction    = 0.3", "friction    = 0.9"));
    assert_eq!(full["impact"]["regime"], "full");
    // U = −ε u
    for direction in ["normal_velocity", "tangential_velocity"] {
        let [before, after] = pair(&full["impact"][direction]);
        assert!((after + 0.3 * before).abs() < 1e-10, "{before} {after}");
    }
}

/// To stop the contact point along the wall takes a pull: there is no critical ratio, and its key says so.
/// Nothing else is null.
#[test]
fn where_there_is_no_critical_ratio_its_key_is_null() {
    let mut document =
        json("reconstruct", include_str!("../../../fixtures/no-answer/only-with-friction.toml"));
    let impact = document["impact"].as_object_mut().unwrap();
    assert_eq!(impact.remove("critical_impulse_ratio"), Some(Value::Null));
    take_nulls(&mut document, &["/crash3/moment_arm", "/crash3/delta_v", "/crash3/corrected_delta_v"]);
    for correction in document["crash3"]["corrections"].as_array_mut().unwrap() {
        take_nulls(correction, &["/delta_v", "/friction"]);
    }
    assert_no_null(&document);
}

#[test]
fn the_moment_impulse_changes_the_yaw_rates_and_takes_its_share() {
    let document = law("moment");
    let at = |pointer: &str| number(&document, pointer);
    let spin = |key: &str| at(&format!("/vehicle1/{key}")) - at(&format!("/vehicle2/{key}"));
    let work = -0.5 * at("/impact/moment_impulse") * (spin("yaw_rate") + spin("final_yaw_rate"));
    assert!((at("/impact/moment_work") / work - 1.0).abs() < 1e-9);
    let sum = at("/impact/normal_work") + at("/impact/tangential_work") + work;
    assert!((at("/impact/energy_loss") / sum - 1.0).abs() < 1e-9);
}

#[test]
fn a_comparison_has_the_answer_of_each_law() {
    let document = json("compare", PAPER);
    assert_no_null(&document);
    let rows = document["rows"].as_array().unwrap();
    let row = |name: &str| rows.iter().find(|row| row["law"] == name).unwrap_or_else(|| panic!("{name}"));
    let own = json("reconstruct", PAPER);
    assert_eq!(rows[0]["law"], "Brach, common tangential velocity");
    assert_eq!(rows[0]["found"], own["found"]["value"]);
    assert_eq!(rows.len(), 12);
    // A row is the answer to a case of its own.
    let woolley = law("woolley");
    assert_row(row("Woolley"), &woolley);
    let change = number(&woolley, "/found/value") - number(&own, "/found/value");
    assert!((number(row("Woolley"), "/found_difference") - change).abs() < 1e-12);
    assert_eq!(row("CRASH3, uncorrected")["delta_v"], own["crash3"]["delta_v"]);
    assert_eq!(row("CRASH3, corrected")["delta_v"], own["crash3"]["corrected_delta_v"]);
    for row in rows {
        let assumed = [
            "Brach, friction limit",
            "Kudlich–Slibar",
            "Ishikawa",
            "Woolley, sideswipe",
            "Brach, common yaw rate",
        ];
        assert_eq!(row.get("assumed").is_some(), assumed.iter().any(|name| row["law"] == *name), "{row}");
    }
}

#[track_caller]
fn assert_row(row: &Value, alone: &Value) {
    assert_eq!(row["found"], alone["found"]["value"]);
    assert_eq!(row["energy_loss"], alone["impact"]["energy_loss"]);
    for (i, vehicle) in ["vehicle1", "vehicle2"].into_iter().enumerate() {
        for key in ["delta_v", "pdof", "final_yaw_rate"] {
            assert_eq!(row[key][i], alone[vehicle][key], "{key}");
        }
    }
    for (share, work) in [("normal_share", "normal_work"), ("tangential_share", "tangential_work")] {
        let expected = number(alone, &format!("/impact/{work}")) / number(alone, "/impact/initial_energy");
        assert!((number(row, &format!("/{share}")) / expected - 1.0).abs() < 1e-12, "{share}");
    }
}

#[test]
fn a_comparison_begins_with_the_case_s_own_law_and_has_it_once() {
    for name in ["woolley", "woolley-sideswipe", "ishikawa", "kudlich-slibar", "restitution-curve", "moment"]
    {
        let document =
            json("compare", &fs::read_to_string(format!("../../fixtures/laws/{name}.toml")).unwrap());
        let rows = document["rows"].as_array().unwrap();
        assert_row(&rows[0], &law(name));
        assert!(rows[1..].iter().all(|row| row["law"] != rows[0]["law"]), "{name}");
        assert!(rows[1..].iter().all(|row| row.get("delta_v_difference").is_some()), "{name}");
    }
}

/// A fixed object has no front from which the direction of a force could be counted, so it has none, as in
/// `reconstruct`, however the scene is turned.
#[test]
fn a_fixed_object_has_no_direction_of_force() {
    let barrier = include_str!("../../../fixtures/barrier.toml");
    let turned = barrier
        .replace("heading    = \"0 deg\"", "heading = \"90 deg\"")
        .replace("crush_plane = \"0 deg\"", "crush_plane = \"90 deg\"");
    assert!(turned.matches("90 deg").count() == 2);
    for text in [barrier, &turned] {
        assert!(json("reconstruct", text)["vehicle2"].get("pdof").is_none());
        for row in json("compare", text)["rows"].as_array().unwrap() {
            let Some(pdof) = row.get("pdof") else { continue };
            assert!(pdof[0].is_number() && pdof[1].is_null(), "{row}");
        }
    }
}

#[test]
fn laws_without_an_answer_say_why() {
    let mut document = json("compare", include_str!("../../../fixtures/no-answer/only-with-friction.toml"));
    // A fixed object has no direction of force.
    for row in document["rows"].as_array_mut().unwrap() {
        row.as_object_mut().unwrap().remove("pdof");
    }
    assert_no_null(&document);
    let rows = document["rows"].as_array().unwrap();
    let error = |name: &str| rows.iter().find(|row| row["law"] == name).and_then(|row| row.get("error"));
    assert_eq!(error("Brach, friction limit"), None);
    assert_eq!(error("Kudlich–Slibar"), None);
    for name in ["Brach, common tangential velocity", "Woolley"] {
        let error = error(name).and_then(Value::as_str).unwrap();
        assert!(error.starts_with("no speed of vehicle 1"), "{error}");
    }
}

/// Every number of a document, and every text, under its path. A pair of numbers stays together.
fn leaves(document: &Value) -> BTreeMap<String, Value> {
    fn collect(path: &str, value: &Value, into: &mut BTreeMap<String, Value>) {
        match value {
            Value::Object(keys) => {
                for (key, value) in keys {
                    collect(&format!("{path}/{key}"), value, into);
                }
            }
            // The sentences name vehicles and round numbers.
            Value::Array(_) if path == "/warnings" => {}
            Value::Array(elements) if elements.iter().any(Value::is_object) => {
                for (i, element) in elements.iter().enumerate() {
                    collect(&format!("{path}/{i}"), element, into);
                }
            }
            other => {
                into.insert(path.to_owned(), other.clone());
            }
        }
    }
    let mut into = BTreeMap::new();
    collect("", document, &mut into);
    into
}

/// Asserts agreement to 1e-9, in a list relative to its largest number.
#[track_caller]
fn assert_same(actual: &BTreeMap<String, Value>, expected: &BTreeMap<String, Value>) {
    assert!(actual.keys().eq(expected.keys()), "{:?} is not {:?}", actual.keys(), expected.keys());
    for (path, expected) in expected {
        let actual = &actual[path];
        let numbers = |value: &Value| match value {
            Value::Array(elements) => elements.iter().map(Value::as_f64).collect(),
            other => vec![other.as_f64()],
        };
        let (a, b) = (numbers(actual), numbers(expected));
        assert_eq!(a.len(), b.len(), "{path}");
        let scale = b.iter().flatten().fold(0.0, |largest: f64, number| largest.max(number.abs()));
        for pair in a.into_iter().zip(b) {
            match pair {
                (Some(a), Some(b)) => {
                    assert!((a - b).abs() <= 1e-9 * scale, "{path}: {actual} is not {expected}");
                }
                _ => assert_eq!(actual, expected, "{path}"),
            }
        }
    }
}

/// The vectors of a document in the scene frame.
const VECTORS: [&str; 8] = [
    "/impact/impulse",
    "/impact/normal",
    "/vehicle1/velocity",
    "/vehicle1/final_velocity",
    "/vehicle1/delta_v_vector",
    "/vehicle2/velocity",
    "/vehicle2/final_velocity",
    "/vehicle2/delta_v_vector",
];

fn pair(value: &Value) -> [f64; 2] {
    [0, 1].map(|i| value[i].as_f64().unwrap())
}

/// Asserts that a case gives the expected document, without a warning like the example.
#[track_caller]
fn assert_case_gives(case: &str, expected: &BTreeMap<String, Value>) {
    let document = json("reconstruct", case);
    assert_eq!(document["warnings"], Value::Array(Vec::new()));
    assert_same(&leaves(&document), expected);
}

#[test]
fn the_frame_of_the_scene_does_not_matter() {
    let mut expected = leaves(&json("reconstruct", PAPER));
    let (sin, cos) = 77_f64.to_radians().sin_cos();
    for path in VECTORS {
        let [x, y] = pair(&expected[path]);
        expected.insert(path.to_owned(), [x * cos - y * sin, x * sin + y * cos].to_vec().into());
    }
    let direction = expected["/impact/impulse_direction"].as_f64().unwrap() + 77_f64.to_radians();
    assert!(direction.abs() < PI);
    expected.insert("/impact/impulse_direction".to_owned(), direction.into());

    let case = with(PAPER, "heading     = \"180 deg\"", "heading     = \"257 deg\"");
    let case = with(&case, "heading     = \"67 deg\"", "heading     = \"144 deg\"");
    assert_case_gives(&with(&case, "\"-23 deg\"", "\"54 deg\""), &expected);
}

#[test]
fn both_normals_describe_the_same_plane() {
    let expected = leaves(&json("reconstruct", PAPER));
    assert_case_gives(&with(PAPER, "\"-23 deg\"", "\"157 deg\""), &expected);
    assert_case_gives(&with(PAPER, "\"-23 deg\"", "\"-203 deg\""), &expected);
}

/// Vehicle 1 is vehicle 2: n and t turn round, and P acts on the other.
#[test]
fn the_labels_do_not_matter() {
    let swap = |text: &str| {
        text.replace("vehicle1", "vehicle0").replace("vehicle2", "vehicle1").replace("vehicle0", "vehicle2")
    };
    // The checks of the two rotations change places, and each keeps the vehicle that it names.
    let swap_path = |path: &str| match path {
        "/checks/2/value" => "/checks/3/value".to_owned(),
        "/checks/3/value" => "/checks/2/value".to_owned(),
        other => swap(other),
    };
    let expected = leaves(&json("reconstruct", PAPER)).into_iter().map(|(path, value)| {
        let value = match path.as_str() {
            "/found/quantity" => "vehicle2.speed".into(),
            "/impact/impulse" | "/impact/normal" => pair(&value).map(|component| -component).to_vec().into(),
            "/impact/impulse_direction" => {
                let turned = value.as_f64().unwrap() + PI;
                (if turned > PI { turned - TAU } else { turned }).into()
            }
            "/crash3/moment_arm"
            | "/crash3/effective_mass_ratio"
            | "/crash3/delta_v"
            | "/crash3/corrected_delta_v" => {
                let [first, second] = pair(&value);
                [second, first].to_vec().into()
            }
            path if path.starts_with("/crash3/corrections") && value.is_array() => {
                let [first, second] = pair(&value);
                [second, first].to_vec().into()
            }
            _ => value,
        };
        (swap_path(&path), value)
    });
    assert_case_gives(&swap(PAPER), &expected.collect());
}

/// The same case in SI units, with the definitions of the foot, the pound, the mile and standard gravity.
#[test]
fn the_units_do_not_matter() {
    const FOOT: f64 = 0.3048;
    const INCH: f64 = 0.0254;
    const POUND: f64 = 0.453_592_37;
    const POUND_FORCE: f64 = POUND * 9.80665;
    let mut expected = leaves(&json("reconstruct", PAPER));
    // The other case gives the stiffness in its other form, and the report says in which.
    for vehicle in ["/vehicle1", "/vehicle2"] {
        expected.insert(format!("{vehicle}/stiffness_source"), Value::from("A and B as given"));
    }
    let case = [
        ("weight      = \"3696 lb\"", format!("mass = \"{} kg\"", 3696.0 * POUND)),
        ("weight      = \"3413 lb\"", format!("mass = \"{} kg\"", 3413.0 * POUND)),
        ("\"2437 lb ft s^2\"", format!("\"{} kg m^2\"", 2437.0 * POUND_FORCE * FOOT)),
        ("\"2165 lb ft s^2\"", format!("\"{} kg m^2\"", 2165.0 * POUND_FORCE * FOOT)),
        ("heading     = \"180 deg\"", format!("heading = \"{PI} rad\"")),
        ("heading     = \"67 deg\"", format!("heading = \"{} rad\"", 67.0 * PI / 180.0)),
        (
            "\"6.3 ft\", angle = \"-22.4 deg\"",
            format!("\"{} m\", angle = \"{} rad\"", 6.3 * FOOT, -22.4 * PI / 180.0),
        ),
        (
            "\"3.8 ft\", angle = \"-39 deg\"",
            format!("\"{} m\", angle = \"{} rad\"", 3.8 * FOOT, -39.0 * PI / 180.0),
        ),
        ("\"10 mph\"", format!("\"{} m/s\"", 10.0 * 1609.344 / 3600.0)),
        ("\"65 in\"", format!("\"{} cm\"", 65.0 * 2.54)),
        ("\"84 in\"", format!("\"{} mm\"", 84.0 * 25.4)),
        (
            "\"21.3 20.3 13.8 11.3 5.3 4.8 in\"",
            metres([21.3, 20.3, 13.8, 11.3, 5.3, 4.8].map(|depth| depth * INCH)),
        ),
        (
            "\"3.0 15.8 13.5 6.7 3.3 5.0 in\"",
            metres([3.0, 15.8, 13.5, 6.7, 3.3, 5.0].map(|depth| depth * INCH)),
        ),
        ("{ d0 = \"35 lb^0.5\", d1 = \"115 lb^0.5/ft\" }", crush_stiffness(35.0, 115.0, POUND_FORCE, FOOT)),
        ("{ d0 = \"30 lb^0.5\", d1 = \"77.5 lb^0.5/ft\" }", crush_stiffness(30.0, 77.5, POUND_FORCE, FOOT)),
        ("\"-23 deg\"", format!("\"{} rad\"", -23.0 * PI / 180.0)),
    ]
    .into_iter()
    .fold(PAPER.to_owned(), |case, (old, new)| with(&case, old, &new));
    assert_case_gives(&case, &expected);
}

fn metres(depths: [f64; 6]) -> String {
    format!("[{}]", depths.map(|depth| format!("\"{depth} m\"")).join(", "))
}

/// A = d_0 d_1 and B = d_1², from √lbf and √lbf/ft to SI units.
fn crush_stiffness(d0: f64, d1: f64, pound_force: f64, foot: f64) -> String {
    let (a, b) = (d0 * d1 * pound_force / foot, d1 * d1 * pound_force / (foot * foot));
    format!("{{ A = \"{a} N/m\", B = \"{b} N/m^2\" }}")
}

#[test]
fn what_is_no_text_is_refused_in_one_error() {
    let utf_16: Vec<u8> = "[vehicle1]\nmass = \"1 t\"\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let kinds: [(&[u8], &str); 4] = [
        // "é" in Latin-1.
        (
            b"title = \"a\"\nsource = \"Caf\xe9\"\n",
            "the file is not UTF-8 text: line 2 has the first invalid character",
        ),
        (&utf_16, "this is text in UTF-16, but a case file must be UTF-8"),
        (b"%PDF-1.7\n\x00\xff", "this is a PDF file, not a case file"),
        (b"<!DOCTYPE html>\n<p>Report</p>", "this is an HTML page, not a case file"),
    ];
    for (bytes, expected) in kinds {
        let path = temporary("no-case.toml");
        fs::write(&path, bytes).unwrap();
        let path = path.to_str().unwrap();
        for (arguments, name) in [(&["reconstruct", path], path), (&["crush", "-"], "standard input")] {
            let message = refused(arguments, bytes);
            assert!(message.starts_with(&format!("error: {expected}\n--> {name}\n = help: ")), "{message}");
            assert_eq!(message.matches("error").count(), 1, "{message}");
        }
        let rows = Command::new(env!("CARGO_BIN_EXE_deltav"))
            .args(["reconstruct", path, "--format", "csv"])
            .output()
            .unwrap();
        assert!(String::from_utf8(rows.stdout).unwrap().contains(expected));
    }
}

#[test]
fn a_folder_is_no_case() {
    let folder = env!("CARGO_TARGET_TMPDIR");
    for command in ["check", "sensitivity"] {
        let message = refused(&[command, folder], b"");
        assert_eq!(message, format!("error: {folder} is a folder: name the case file in it\n"));
    }
}

/// The keys that readers of the comparison rely on, speeds in m/s.
#[test]
fn the_validation_has_its_keys() {
    let validation: Value = serde_json::from_slice(&printed(&["validate", "--format", "json"], "")).unwrap();
    let list = |key: &str| validation[key].as_array().unwrap().clone();
    assert_eq!(list("failed"), Vec::<Value>::new());
    assert_eq!(
        [list("table1").len(), list("table2").len(), list("table3").len(), list("reconstruction").len()],
        [8, 66, 30, 11]
    );
    // SAE 980025, Table 2: total ΔV of PIM in test 1, 15.1 and 22.7 ft/s; measured 18.5 and 22.8 ft/s.
    let row = list("table2").into_iter().find(|row| row["test"] == 1 && row["row"] == "pim_total").unwrap();
    for (i, [paper, measured]) in [[15.1, 18.5], [22.7, 22.8]].into_iter().enumerate() {
        let number = |key: &str| row[key][i].as_f64().unwrap() / 0.3048;
        assert!(
            (number("paper") - paper).abs() < 1e-9 && (number("measured") - measured).abs() < 1e-9,
            "{row}"
        );
        assert!((number("ours") - paper).abs() < 0.1, "{row}");
        assert!((number("difference") - (number("ours") - number("paper"))).abs() < 1e-9, "{row}");
        assert_eq!(row["claims"][i]["reproduces"], true);
    }
    let mut rows: Vec<String> =
        list("table2").iter().map(|row| row["row"].as_str().unwrap().to_owned()).collect();
    rows.sort();
    rows.dedup();
    let expected = [
        "crash_corrected",
        "crash_corrected_implied",
        "crash_uncorrected",
        "crash_uncorrected_implied",
        "pim_crush",
        "pim_total",
    ];
    assert_eq!(rows, expected);
    // The true speed is the test speed of the case, and the speed found is that of `reconstruct`.
    let case = include_str!("../../../fixtures/ricsac/08.toml");
    let alone = json("reconstruct", case);
    let within = list("reconstruction").into_iter().find(|row| row["test"] == 8).unwrap();
    assert_eq!(within["found"], alone["found"]["value"]);
    assert_eq!(within["true"], 9.3);
    let error = within["found"].as_f64().unwrap() - 9.3;
    assert!((within["error"].as_f64().unwrap() - error).abs() < 1e-12);
    // ERRATUM: Table 3 prints 17.77 for 11.77 ft/s.
    let nominal = list("table3").into_iter().find(|row| row["test"] == 5 && row["turn"] == 0.0).unwrap();
    assert_eq!(nominal["claims"][0]["erratum"]["printed"], "17.77");
    assert!(nominal["claims"][1]["erratum"].is_null());
}

#[test]
fn the_validation_writes_the_page_and_the_plots_of_the_docs() {
    let folder = temporary("validation");
    fs::create_dir_all(&folder).unwrap();
    let page = folder.join("validation.md");
    let arguments = [
        "validate",
        "--format",
        "markdown",
        "-o",
        page.to_str().unwrap(),
        "--plots",
        folder.to_str().unwrap(),
    ];
    assert_eq!(printed(&arguments, ""), b"");
    for name in ["validation.md", "computed-against-measured.svg", "reconstructed-speed.svg"] {
        let docs = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name);
        assert!(fs::read(folder.join(name)).unwrap() == fs::read(docs).unwrap(), "{name}");
    }
}

const UNCERTAIN_FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/sae-980025-uncertain.toml");

/// The same bytes for any number of threads, of every kind of output.
#[test]
fn uncertainty_does_not_depend_on_the_number_of_threads() {
    for method in ["monte-carlo", "latin-hypercube", "sobol"] {
        let run = |threads: &str| {
            let samples = temporary(&format!("samples-{method}-{threads}.csv"));
            let arguments = [
                "uncertainty",
                UNCERTAIN_FILE,
                "--samples",
                "10000",
                "--seed",
                "5",
                "--sobol=256",
                "--format",
                "json",
                "--method",
                method,
                "--threads",
                threads,
                "--samples-out",
                samples.to_str().unwrap(),
            ];
            (printed(&arguments, ""), fs::read(&samples).unwrap())
        };
        let one = run("1");
        assert_eq!(one, run("2"), "{method}");
        assert_eq!(one, run("3"), "{method}");
    }
}

#[test]
fn uncertainty_has_its_keys_and_its_samples_are_those_of_the_statistics() {
    let samples = temporary("samples.csv");
    let arguments = [
        "uncertainty",
        UNCERTAIN_FILE,
        "--samples",
        "5000",
        "--seed",
        "3",
        "--sobol=512",
        "--format",
        "json",
        "--samples-out",
        samples.to_str().unwrap(),
    ];
    let result: Value = serde_json::from_slice(&printed(&arguments, "")).unwrap();
    assert_eq!(result["samples"], 5000);
    assert_eq!(result["seed"], 3);
    let failed: u64 =
        result["failed"].as_object().unwrap().values().map(|count| count.as_u64().unwrap()).sum();
    assert_eq!(result["succeeded"].as_u64().unwrap() + failed, 5000);
    let outputs: Vec<&String> = result["outputs"].as_object().unwrap().keys().collect();
    let names = [
        "vehicle1.speed",
        "vehicle1.delta_v",
        "vehicle2.delta_v",
        "vehicle1.pdof",
        "vehicle2.pdof",
        "impact.closing_speed",
        "impact.energy_loss",
        "impact.normal_work",
        "impact.tangential_work",
        "vehicle1.delta_v_longitudinal",
        "vehicle1.delta_v_lateral",
        "vehicle2.delta_v_longitudinal",
        "vehicle2.delta_v_lateral",
    ];
    assert_eq!(outputs, names);

    // The central value is that of the other commands to the last digit.
    let speed = &result["outputs"]["vehicle1.speed"];
    let reconstructed = json("reconstruct", &fs::read_to_string(UNCERTAIN_FILE).unwrap());
    assert_eq!(speed["central"], reconstructed["found"]["value"]);
    assert_eq!(result["outputs"]["vehicle2.pdof"]["central"], reconstructed["vehicle2"]["pdof"]);
    assert_eq!(result["outputs"]["impact.energy_loss"]["central"], reconstructed["impact"]["energy_loss"]);

    // Statistics of the samples as written, by another method: sorting, and NumPy's quantiles.
    let text = fs::read_to_string(&samples).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    assert_eq!(header.len(), 2 + 31 + 13);
    let column = header.iter().position(|name| *name == "vehicle1.speed").unwrap();
    let lines: Vec<_> = lines.collect();
    // Inputs in SI: 3696 lb of 4.448 22 N each, and the mean of 5000 is within four of 222 N/√5000 of it.
    let weight = header.iter().position(|name| *name == "vehicle1.weight").unwrap();
    let mean = lines.iter().map(|line| line[weight].parse::<f64>().unwrap()).sum::<f64>() / 5000.0;
    assert!((mean - 16_440.6).abs() < 12.6, "{mean}");
    let mut values: Vec<f64> = lines.iter().map(|line| line[column].parse().unwrap()).collect();
    assert_eq!(values.len(), 5000);
    values.sort_by(f64::total_cmp);
    let quantile = |p: f64| {
        let place = p * 4999.0;
        #[expect(clippy::cast_possible_truncation, reason = "a place below 5000")]
        let (below, share) = (place.floor() as usize, place.fract());
        values[below] + share * (values[below + 1] - values[below])
    };
    let near = |value: &Value, wanted: f64| {
        let value = value.as_f64().unwrap();
        assert!((value - wanted).abs() < 1e-9 * wanted.abs(), "{value} against {wanted}");
    };
    let mean = values.iter().sum::<f64>() / 5000.0;
    near(&speed["mean"], mean);
    near(&speed["sd"], (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 4999.0).sqrt());
    near(&speed["median"], quantile(0.5));
    for (key, low, high) in [
        ("interval50", 0.25, 0.75),
        ("interval90", 0.05, 0.95),
        ("interval95", 0.025, 0.975),
        ("interval99", 0.005, 0.995),
    ] {
        near(&speed[key][0], quantile(low));
        near(&speed[key][1], quantile(high));
    }

    // The plane of the crush is what matters most, and the shares of a nearly linear model add up to one.
    let indices = result["sensitivity"].as_array().unwrap();
    assert_eq!(indices.len(), 31);
    assert_eq!(result["sensitivity"], speed["sensitivity"]);
    let total = |index: &&Value| index["total"].as_f64().unwrap();
    let most = indices.iter().max_by(|one, other| total(one).total_cmp(&total(other))).unwrap();
    assert_eq!(most["input"], "impact.crush_plane");
    assert!(
        indices.iter().all(|index| index["first_order"].is_number() && index["total_interval95"].is_array())
    );
    let sum: f64 = indices.iter().map(|index| total(&index)).sum();
    assert!((0.9..1.15).contains(&sum), "{sum}");
    let shares: f64 =
        speed["tornado"].as_array().unwrap().iter().map(|bar| bar["share"].as_f64().unwrap()).sum();
    assert!((shares - 1.0).abs() < 1e-12);
}

#[test]
fn samples_without_an_answer_say_why() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/wide-ranges.toml");
    let samples = temporary("samples-failed.csv");
    let arguments = [
        "uncertainty",
        file,
        "--samples",
        "1000",
        "--format",
        "json",
        "--samples-out",
        samples.to_str().unwrap(),
    ];
    let result: Value = serde_json::from_slice(&printed(&arguments, "")).unwrap();
    let text = fs::read_to_string(&samples).unwrap();
    let failed =
        text.lines().filter(|line| line.contains(",not_approaching,") && line.ends_with(",,,,,")).count();
    assert_eq!(result["failed"]["not_approaching"], failed);
    // Φ(−1) of 1000, give or take four of √(n p (1 − p)) = 11.6: Abramowitz & Stegun, table 26.1
    assert!((failed as f64 - 158.7).abs() < 46.2, "{failed}");
    let energy = &result["outputs"]["impact.energy_loss"];
    assert_eq!(energy["first_order_differs"], true);
    // The force comes along the normal, whatever its size: only rounding moves the PDOF.
    assert_eq!(result["outputs"]["vehicle1.pdof"]["first_order_differs"], false);
    // A normal distribution of 0.1 ± 0.1 has Φ(1) = 0.841 345 above zero.
    let restitution = &result["inputs"].as_array().unwrap()[2];
    assert_eq!(restitution["input"], "impact.restitution");
    assert!((restitution["truncated"]["kept"].as_f64().unwrap() - 0.841_344_746).abs() < 1e-8);
}

#[test]
fn uncertainty_draws_every_result() {
    let folder = temporary("plots");
    fs::create_dir_all(&folder).unwrap();
    printed(
        &[
            "uncertainty",
            UNCERTAIN_FILE,
            "--samples",
            "1000",
            "--plots",
            folder.to_str().unwrap(),
            "-o",
            temporary("u.txt").to_str().unwrap(),
        ],
        "",
    );
    for name in ["histogram-vehicle1.speed.svg", "tornado-vehicle2.pdof.svg"] {
        let drawn = fs::read_to_string(folder.join(name)).unwrap();
        assert!(drawn.starts_with("<svg") && drawn.ends_with("</svg>\n"), "{name}");
    }
    // A histogram and a tornado of each of 13 results.
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 26);
    let drawn = fs::read_to_string(folder.join("tornado-vehicle1.speed.svg")).unwrap();
    assert!(drawn.contains(">crush plane: ") && drawn.contains(", seed 1<"), "{drawn}");
    // People read speeds in mph and km/h: 22.869 m/s, the speed found, is 51.16 mph or 82.3 km/h.
    let plots = |units: &str| {
        let text = temporary("u-units.txt");
        let arguments = ["uncertainty", UNCERTAIN_FILE, "--samples", "1000", "--units", units, "--plots"];
        printed(&[&arguments[..], &[folder.to_str().unwrap(), "-o", text.to_str().unwrap()]].concat(), "");
        ["tornado", "histogram"]
            .map(|plot| fs::read_to_string(folder.join(format!("{plot}-vehicle1.speed.svg"))).unwrap())
    };
    for (units, unit, central) in [("us", "mph", "51.16"), ("si", "km/h", "82.3")] {
        let [tornado, histogram] = plots(units);
        for (plot, central) in
            [(tornado, format!(">central {central}<")), (histogram, format!(">central: {central}<"))]
        {
            assert!(
                plot.contains(&format!(">Speed of vehicle 1, {unit}<")) && plot.contains(&central),
                "{plot}"
            );
        }
    }
}

/// Every output from a case has its warnings.
#[test]
fn every_command_says_the_warnings_of_the_case() {
    let text = include_str!("../../../fixtures/wide-ranges.toml");
    let text =
        text.replace("friction = { low = 0.3, mode = 0.4, high = 0.6 }", "friction = { low = 2, high = 4 }");
    for command in ["impact", "compare", "sensitivity", "uncertainty", "check"] {
        let document = json(command, &text);
        let warnings = document["warnings"].as_array().unwrap();
        let friction = warnings.iter().find(|warning| warning["code"] == "unusual-friction");
        let message = friction.and_then(|warning| warning["message"].as_str()).unwrap();
        assert!(message.contains("the friction limit is 3,"), "{command}: {message}");
        let page = String::from_utf8(printed(&[command, "-"], &text)).unwrap();
        assert!(page.contains("\nwarning [unusual-friction]: the friction limit is 3,"), "{command}: {page}");
    }
    let drawn = deltav(&["draw", "-", "--what", "scene"], text.as_bytes());
    assert!(drawn.stdout.starts_with(b"<svg"));
    let said = String::from_utf8(drawn.stderr).unwrap();
    assert!(
        said.starts_with("- has ")
            && said.ends_with(": `deltav impact -` prints them.\n")
            && said.lines().count() == 1,
        "{said}"
    );
}
