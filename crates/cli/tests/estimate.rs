//! `deltav estimate`: what it prints as text, HTML, JSON and CSV, and what it refuses.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::LazyLock;

use serde_json::Value;

/// Two cars with unknown speeds; few of the numbers are uncertain, so that a run takes seconds.
const CASE: &str = include_str!("estimate/case.toml");
/// Few particles, and the main run alone.
const FAST: [&str; 3] = ["--particles", "128", "--no-pieces"];

fn temporary(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("estimate");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn written(name: &str, case: &str) -> String {
    let path = temporary(name);
    fs::write(&path, case).unwrap();
    path.display().to_string()
}

fn estimate(case: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_deltav")).arg("estimate").arg(case).args(arguments).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// What one run with a question printed as JSON, and its draws.
static RUN: LazyLock<(Value, String)> = LazyLock::new(|| {
    let case = written("run.toml", CASE);
    let draws = temporary("draws.csv");
    let draws_name = draws.display().to_string();
    let question = ["--above", "vehicle1.speed 50 km/h", "--above", "impact.restitution 0.1"];
    let arguments =
        [&FAST[..], &["--format", "json", "--threads", "1", "--samples-out", &draws_name], &question]
            .concat();
    let output = estimate(&case, &arguments);
    assert_eq!((output.status.code(), &*said(&output)), (Some(0), ""));
    (serde_json::from_slice(&output.stdout).unwrap(), fs::read_to_string(draws).unwrap())
});

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// The columns of the draws, by their names.
fn columns(text: &str) -> Vec<(String, Vec<f64>)> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut columns: Vec<(String, Vec<f64>)> =
        reader.headers().unwrap().iter().map(|name| (name.to_owned(), Vec::new())).collect();
    for record in reader.records() {
        for (column, cell) in columns.iter_mut().zip(&record.unwrap()) {
            column.1.push(cell.parse().unwrap());
        }
    }
    columns
}

#[test]
fn the_json_has_what_it_promises() {
    let json = &RUN.0;
    assert_eq!(json["converged"], Value::Bool(true), "{}", json["doubts"]);
    assert_eq!(json["doubts"].as_array().unwrap().len(), 0);
    assert_eq!(json["prior"], "field");
    assert_eq!((&json["seed"], &json["particles"]), (&1.into(), &128.into()));
    assert!(number(&json["ess"]) >= 400.0);
    assert_eq!(json["program"]["name"], "deltav");
    assert_eq!(json["case"]["sha256"].as_str().unwrap().len(), 64);
    let outputs = json["outputs"].as_object().unwrap();
    for key in ["vehicle1.speed", "vehicle2.speed", "vehicle1.delta_v", "impact.restitution", "crush_energy"]
    {
        let output = &outputs[key];
        let ends = |key: &str| {
            let ends = output[key].as_array().unwrap();
            [number(&ends[0]), number(&ends[1])]
        };
        let median = number(&output["median"]);
        let mut inner = [median; 2];
        for level in ["interval50", "interval80", "interval90", "interval95"] {
            let [low, high] = ends(level);
            assert!(low < inner[0] && inner[1] < high, "{key} {level}: {low} {high}");
            inner = [low, high];
        }
        assert!(number(&output["sd"]) > 0.0 && number(&output["standard_error"]["median"]) > 0.0);
        assert!(number(&output["prior"]["median"]).is_finite());
    }
    let pieces: Vec<&str> =
        json["pieces"].as_array().unwrap().iter().map(|piece| piece["key"].as_str().unwrap()).collect();
    assert_eq!(
        pieces,
        [
            "crush",
            "vehicle1.after.direction",
            "vehicle2.after.direction",
            "vehicle2.recorder.delta_v",
            "vehicle2.recorder.delta_v_lateral"
        ]
    );
    let unknown = json["unknown"].as_array().unwrap();
    let of = |key: &str| unknown.iter().find(|unknown| unknown["key"] == key).unwrap();
    // 3° in rad.
    assert!((number(&of("vehicle1.heading")["prior"]["sd"]) - 0.052_359_877_56).abs() < 1e-9);
    assert_eq!(of("vehicle1.heading")["assumed"], Value::Bool(false));
    assert_eq!(of("vehicle1.mass")["assumed"], Value::Bool(true));
    // 65 lb.
    assert!((number(&of("vehicle1.mass")["prior"]["sd"]) - 29.483_504).abs() < 1e-6);
}

/// The program's statistics against those of the draws by sorting.
#[test]
fn the_draws_have_the_medians_and_probabilities_of_the_json() {
    let (json, csv) = &*RUN;
    let columns = columns(csv);
    let column = |key: &str| {
        let found = columns.iter().filter(|(name, _)| name == key).collect::<Vec<_>>();
        assert_eq!(found.len(), 1, "{key}");
        &found[0].1
    };
    assert_eq!(columns[0].0, "draw");
    for (key, output) in json["outputs"].as_object().unwrap() {
        let mut sorted = column(key).clone();
        assert_eq!(sorted.len() as u64, json["draws"].as_u64().unwrap());
        sorted.sort_by(f64::total_cmp);
        let middle = 0.5 * (sorted[sorted.len() / 2 - 1] + sorted[sorted.len() / 2]);
        let median = number(&output["median"]);
        assert!((median - middle).abs() <= 1e-9 * median.abs().max(1.0), "{key}: {median} {middle}");
    }
    for unknown in json["unknown"].as_array().unwrap() {
        let key = unknown["key"].as_str().unwrap();
        let mut sorted = column(key).clone();
        sorted.sort_by(f64::total_cmp);
        let middle = 0.5 * (sorted[sorted.len() / 2 - 1] + sorted[sorted.len() / 2]);
        let median = number(&unknown["posterior"]["median"]);
        assert!((median - middle).abs() <= 1e-9 * median.abs().max(1.0), "{key}: {median} {middle}");
    }
    let questions = json["questions"].as_array().unwrap();
    // 50 km/h
    for (question, key, limit) in
        [(&questions[0], "vehicle1.speed", 50.0 / 3.6), (&questions[1], "impact.restitution", 0.1)]
    {
        assert_eq!(question["output"], key);
        assert!((number(&question["above"]) - limit).abs() < 1e-12);
        let draws = column(key);
        let above = draws.iter().filter(|draw| **draw > limit).count();
        let share = above as f64 / draws.len() as f64;
        assert!((number(&question["probability"]) - share).abs() < 1e-12, "{key}");
        assert!(number(&question["standard_error"]) > 0.0);
    }
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let case = written("threads.toml", CASE);
    let draws = temporary("draws-2.csv");
    let name = draws.display().to_string();
    let arguments = [
        &FAST[..],
        &[
            "--format",
            "json",
            "--threads",
            "2",
            "--samples-out",
            &name,
            "--above",
            "vehicle1.speed 50 km/h",
            "--above",
            "impact.restitution 0.1",
        ],
    ]
    .concat();
    let output = estimate(&case, &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let mut json: Value = serde_json::from_slice(&output.stdout).unwrap();
    json["case"]["file"] = RUN.0["case"]["file"].clone();
    assert_eq!(json, RUN.0);
    assert_eq!(fs::read_to_string(draws).unwrap(), RUN.1);
}

#[test]
fn a_known_speed_stays_as_given() {
    let case = CASE.replace("name = \"Golf\"", "speed = \"30 km/h\"");
    assert_ne!(case, CASE);
    let case = written("known.toml", &case);
    let output = estimate(&case, &FAST);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("\nSpeed of vehicle 2: 30.0 km/h, as given\n"), "{text}");
    let rows = text.lines().filter_map(|line| line.strip_prefix("Speed of vehicle 2, km/h "));
    let rows: Vec<Vec<&str>> = rows.map(|row| row.split_whitespace().collect()).collect();
    assert_eq!(rows, [["30.0"; 6], ["30.0"; 6]], "{text}");
}

/// A recorder that stored five times the ΔV by all other evidence.
#[test]
fn evidence_that_contradicts_the_rest_is_warned_of() {
    let case = CASE.replace("\"-9 km/h\"", "\"-45 km/h\"").replace("\"-26 km/h\"", "\"-130 km/h\"");
    assert_ne!(case, CASE);
    let case = written("contradiction.toml", &case);
    for format in ["text", "html"] {
        let output = estimate(&case, &[&FAST[..], &["--format", format]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        let text = String::from_utf8(output.stdout).unwrap();
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("recorder's ΔV, vehicle 2"), "{words}");
        assert!(words.contains("contradicts the other evidence: p"), "{words}");
        assert!(words.contains("Default errors, because the case gives none"), "{words}");
        assert!(words.contains("329 crashes of cars"), "{words}");
    }
}

/// Two speeds so certain that hardly a draw before the evidence has them.
#[test]
fn without_convergence_there_is_no_interval() {
    let within = |low: &str, high: &str| {
        format!("certain_speed = {{ at_least = \"{low} km/h\", at_most = \"{high} km/h\" }}")
    };
    let case = CASE.replace("name = \"Focus\"", &within("46.9", "47"));
    let case = case.replace("name = \"Golf\"", &within("30", "30.1"));
    assert!(case.matches("certain_speed").count() == 2);
    let case = written("not-converged.toml", &case);
    let draws = temporary("not-converged.csv");
    let _ = fs::remove_file(&draws);
    let name = draws.display().to_string();
    let output = estimate(&case, &[&FAST[..], &["--samples-out", &name]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("the run has not converged"), "{}", said(&output));
    assert!(!draws.exists());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("No answer: the run has not converged, so no interval is given."), "{text}");
    assert!(!text.contains("(95 %:") && !text.contains("Narrower intervals"), "{text}");
    let output = estimate(&case, &[&FAST[..], &["--format", "json"]].concat());
    assert_eq!(output.status.code(), Some(1));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["converged"], Value::Bool(false));
    assert!(!json["doubts"].as_array().unwrap().is_empty());
    for (key, output) in json["outputs"].as_object().unwrap() {
        for statistic in ["median", "interval50", "interval80", "interval90", "interval95", "mean", "sd"] {
            assert_eq!(output[statistic], Value::Null, "{key} {statistic}");
        }
    }
    assert!(json["unknown"].as_array().unwrap().iter().all(|unknown| unknown["posterior"].is_null()));
}

#[test]
fn what_cannot_be_asked_is_refused_before_the_run() {
    let case = written("refused.toml", CASE);
    for (arguments, says) in [
        (&["--above", "vehicle1.rest.x 5 m"][..], "its results are vehicle1.speed, vehicle2.speed,"),
        (&["--above", "vehicle1.speed 50 kg"], "km/h"),
        (&["--prior", "none"], "[possible values: field, serious-injury, flat]"),
        (&["--particles", "100"], "give a multiple of 128 up to"),
        (&["--csv-style", "european"], "--samples-out"),
    ] {
        let output = estimate(&case, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(said(&output).contains(says), "{arguments:?}: {}", said(&output));
    }
}

/// The evidence that excludes every collision is named.
#[test]
fn impossible_evidence_is_named() {
    // Vehicle 1 backs away from where vehicle 2 stands.
    let limits =
        |low: &str, high: &str| format!("certain_speed = {{ at_least = \"{low}\", at_most = \"{high}\" }}");
    let case = CASE.replace("name = \"Focus\"", &limits("-90 km/h", "-80 km/h"));
    let case = case.replace("name = \"Golf\"", &limits("-1 km/h", "1 km/h"));
    let case = written("excluded.toml", &case);
    let output = estimate(&case, &FAST);
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("do not approach each other; check the headings"), "{}", said(&output));
}

/// The statement on the energy that deformed an object depends on its range, even if the car has no damage.
#[test]
fn the_error_of_an_objects_energy_is_told() {
    const TREE: &str = include_str!("../../../fixtures/leaning-tree.toml");
    let given = "{ value = \"15 kJ\", sd = \"5 kJ\" }";
    let (before, crush) = TREE.split_once("[vehicle1.crush]\n").unwrap();
    let (_, after) = crush.split_once("[vehicle2]").unwrap();
    let undamaged = format!("{before}crush = \"none\"\n[vehicle2]{after}");
    for (number, case) in [TREE, &undamaged].into_iter().enumerate() {
        for (energy, words) in [
            (given, "has the range that the case gives, and the method's error is chosen: 20 %."),
            (
                "\"15 kJ\"",
                "has no range, so its error is chosen: 20 % for the method and 30 % for the object.",
            ),
        ] {
            let case = case.replace(given, energy);
            let output = estimate(&written(&format!("tree-{number}.toml"), &case), &FAST);
            let text = String::from_utf8(output.stdout).unwrap();
            let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let sentence = format!("The energy that deformed the object {words}");
            assert!(text.contains(&sentence), "{sentence}\n{text}");
        }
    }
}

/// The pictures of the report below each other; and of speeds that are all known, a sentence.
#[test]
fn the_estimate_is_drawn() {
    let draw = |case: &str, to: &str| {
        let to = temporary(to);
        // That of an earlier run.
        let _ = fs::remove_file(&to);
        let arguments = ["draw", case, "--what", "estimate", "-o", &to.display().to_string()];
        let output = Command::new(env!("CARGO_BIN_EXE_deltav")).args(arguments).output().unwrap();
        (output, to)
    };
    let (output, svg) = draw(&written("drawn.toml", CASE), "drawn.svg");
    assert_eq!((output.status.code(), &*said(&output)), (Some(0), ""));
    let svg = fs::read_to_string(svg).unwrap();
    for part in ["density-speed-1-", "density-speed-2-", "joint-speeds-"] {
        assert!(svg.contains(&format!(" id=\"estimate-{part}")), "{part}");
    }
    let fixtures = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures");
    let (output, svg) = draw(&format!("{fixtures}/sae-980025-impact.toml"), "known.svg");
    assert_eq!(output.status.code(), Some(1));
    let sentence = "there is no estimate to draw: the case gives both speeds and follows no vehicle to rest; \
                    leave out the speed to be estimated";
    assert!(said(&output).contains(sentence), "{}", said(&output));
    assert!(!svg.exists());
}

/// A car of the 1970s beside one of the field: their energies by category have different biases.
#[test]
fn the_energies_of_cars_of_two_ages_are_told_apart() {
    let text = include_str!("../../../fixtures/estimate.toml");
    let old = text.replacen("[vehicle1]\n", "[vehicle1]\nmodel_year = 1976\n", 1);
    assert_ne!(old, text);
    let output = estimate(&written("ages.toml", &old), &[]);
    let said = String::from_utf8(output.stdout).unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
    for sentence in [
        "Energies of vehicle 1 by CRASH3's categories are taken as right on average.",
        "Energies of vehicle 2 by CRASH3's categories are on average 45 %",
    ] {
        assert!(said.contains(sentence), "{said}");
    }
}
