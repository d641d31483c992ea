//! Rows of the commands that are not `deltav reconstruct`, and tables for spreadsheets in Europe.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const UNCERTAIN: &str = "fixtures/sae-980025-uncertain.toml";

fn deltav(arguments: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_deltav"))
        .current_dir("../..")
        .args(arguments.split(' '))
        .output()
        .unwrap()
}

fn out(arguments: &str) -> String {
    let output = deltav(arguments);
    assert!(output.status.success(), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The records under their columns, read by another CSV reader than in the tests with commas.
fn table(text: &str, separator: u8) -> Vec<Vec<(String, String)>> {
    let mut reader = csv::ReaderBuilder::new().delimiter(separator).from_reader(text.as_bytes());
    let columns: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    reader
        .records()
        .map(|record| columns.iter().cloned().zip(record.unwrap().iter().map(str::to_owned)).collect())
        .collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    &row.iter().find(|(column, _)| column == name).unwrap_or_else(|| panic!("no column {name}")).1
}

fn number(row: &[(String, String)], name: &str) -> f64 {
    cell(row, name).parse().unwrap_or_else(|_| panic!("{name}: {:?}", cell(row, name)))
}

/// The statistics of a row against those of the samples themselves, by sorting.
#[test]
fn a_row_of_uncertainty_has_the_statistics_of_its_samples() {
    let samples = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("rows-samples.csv");
    out(&format!("uncertainty {UNCERTAIN} --samples 4000 --samples-out {}", samples.display()));
    let samples = table(&fs::read_to_string(samples).unwrap(), b',');
    let text = out(&format!(
        "uncertainty {UNCERTAIN} fixtures/sae-980025-uncertain.toml --samples 4000 --format csv"
    ));
    let rows = table(&text, b',');
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0], rows[1]);
    let row = &rows[0];
    let failed = samples.iter().filter(|sample| !cell(sample, "failed").is_empty()).count();
    assert_eq!(cell(row, "samples"), "4000");
    assert_eq!(cell(row, "seed"), "1");
    assert!((number(row, "failed_share") - failed as f64 / 4000.0).abs() < 1e-12);
    for (output, unit) in
        [("vehicle1.speed", "(m/s)"), ("vehicle2.delta_v", "(m/s)"), ("vehicle1.pdof", "(rad)")]
    {
        let mut values: Vec<f64> =
            samples.iter().filter_map(|sample| cell(sample, output).parse().ok()).collect();
        values.sort_by(f64::total_cmp);
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let sd = (values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0)).sqrt();
        let of = |name: &str| number(row, &format!("{output}.{name} {unit}"));
        assert!((of("sd") / sd - 1.0).abs() < 1e-9, "{output}");
        // Between the neighbours of the place, whichever definition of a quantile is used.
        for (name, per_mille) in [("low95", 25), ("median", 500), ("high95", 975)] {
            let place = per_mille * values.len() / 1000;
            assert!((values[place - 2]..=values[place + 2]).contains(&of(name)), "{output} {name}");
        }
    }
    // The other vehicle's speed is given.
    assert_eq!(cell(row, "vehicle2.speed.median (m/s)"), "");
    let us = table(&out(&format!("uncertainty {UNCERTAIN} --samples 4000 --format csv --units us")), b',');
    let mph = number(&us[0], "vehicle1.speed.high95 (mph)") * 1609.344 / 3600.0;
    assert!((mph / number(row, "vehicle1.speed.high95 (m/s)") - 1.0).abs() < 1e-12);
}

#[test]
fn rows_of_uncertainty_are_the_same_for_any_number_of_threads() {
    let run = |threads: &str| {
        let arguments =
            "fixtures/ricsac fixtures/sae-980025-uncertain.toml fixtures/rear-end.toml --samples 3000";
        let output = deltav(&format!("uncertainty {arguments} --format jsonl --threads {threads}"));
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    assert_eq!(run("1"), run("5"));
}

/// Rows have the same values as the document on one case.
#[test]
fn a_line_of_jsonl_is_the_document_with_its_file() {
    for command in
        ["reconstruct", "crush fixtures/sae-980025-crush.toml", "compare", "uncertainty --samples 500"]
    {
        let case = if command.contains(".toml") { "" } else { UNCERTAIN };
        let arguments = format!("{command} {case}").trim().replace("  ", " ");
        let one: Value = serde_json::from_str(&out(&format!("{arguments} --format json"))).unwrap();
        let mut row: Value = serde_json::from_str(&out(&format!("{arguments} --format jsonl"))).unwrap();
        let file = row.as_object_mut().unwrap().remove("file").unwrap();
        assert!(file.as_str().unwrap().ends_with(".toml"));
        assert_eq!(one, row, "{arguments}");
    }
}

/// The results by each kind of evidence are in every row of their case, as in the document; they are empty
/// for a case without both kinds.
#[test]
fn rows_of_a_comparison_have_the_answers_by_evidence() {
    const REST: &str = "fixtures/rear-end-rest.toml";
    let one: Value = serde_json::from_str(&out(&format!("compare {REST} --format json"))).unwrap();
    let text = out(&format!("compare {REST} fixtures/sae-980025.toml --format csv"));
    let rows = table(&text, b',');
    let of = |file: &str| rows.iter().filter(|row| cell(row, "file").ends_with(file)).collect::<Vec<_>>();
    assert!(of(REST).len() > 1);
    for row in of(REST) {
        let same = |column: &str, pointer: &str| {
            assert_eq!(number(row, column), one["evidence"].pointer(pointer).unwrap().as_f64().unwrap());
        };
        same("evidence.crush_energy (J)", "/crush_energy");
        same("evidence.damage.closing_speed (m/s)", "/damage/closing_speed");
        same("evidence.damage.vehicle2.delta_v (m/s)", "/damage/delta_v/1");
        same("evidence.momentum_and_damage.vehicle1.speed (m/s)", "/momentum_and_damage/speeds/0");
        same("evidence.momentum_and_damage.energy_loss (J)", "/momentum_and_damage/energy_loss");
        assert_eq!(cell(row, "evidence.damage.vehicle1.speed (m/s)"), "");
        let reason = one["evidence"]["momentum"]["error"].as_str().unwrap();
        assert_eq!(cell(row, "evidence.momentum.error"), reason);
    }
    // Both speeds of the case are those of the first law, its own.
    let found = one["rows"][0]["speeds"].clone();
    assert_eq!(found, one["evidence"]["momentum_and_damage"]["speeds"]);
    assert_eq!(number(of(REST)[0], "vehicle2.speed (m/s)"), found[1].as_f64().unwrap());
    for row in of("sae-980025.toml") {
        assert!(row.iter().all(|(name, value)| !name.starts_with("evidence.") || value.is_empty()));
    }
}

#[test]
fn a_row_of_a_comparison_is_a_law() {
    let one: Value = serde_json::from_str(&out("compare fixtures/sae-980025.toml --format json")).unwrap();
    let laws = one["rows"].as_array().unwrap();
    let output = deltav("compare fixtures/sae-980025.toml missing.toml fixtures/rear-end.toml --format csv");
    assert_eq!(output.status.code(), Some(1));
    let rows = table(&String::from_utf8(output.stdout).unwrap(), b',');
    for (row, law) in rows.iter().zip(laws) {
        assert_eq!(cell(row, "file"), "fixtures/sae-980025.toml");
        assert_eq!(cell(row, "law"), law["law"].as_str().unwrap());
        assert_eq!(
            cell(row, "found (m/s)"),
            law["found"].as_f64().map_or(String::new(), |found| found.to_string())
        );
        assert!((number(row, "vehicle2.delta_v (m/s)") - law["delta_v"][1].as_f64().unwrap()).abs() < 1e-12);
    }
    assert_eq!(cell(&rows[laws.len()], "file"), "missing.toml");
    assert!(cell(&rows[laws.len()], "error").starts_with("cannot read the case file missing.toml"));
    assert_eq!(cell(&rows[laws.len() + 1], "file"), "fixtures/rear-end.toml");
}

/// Each output names the program and the hash of the file from which it was made.
#[test]
fn version_and_hash_are_in_json_and_csv() {
    // sha256sum fixtures/rear-end.toml
    let sum = Command::new("sha256sum").arg("../../fixtures/rear-end.toml").output().unwrap();
    let sum = String::from_utf8(sum.stdout).unwrap()[..64].to_owned();
    for command in ["reconstruct", "check", "compare", "sensitivity"] {
        let text = out(&format!("{command} fixtures/rear-end.toml --format json"));
        let json: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["program"]["name"], "deltav", "{command}");
        assert_eq!(json["program"]["version"], env!("CARGO_PKG_VERSION"), "{command}");
        assert_eq!(json["case"]["file"], "rear-end.toml", "{command}");
        assert_eq!(json["case"]["sha256"], sum, "{command}");
    }
    let output =
        deltav("reconstruct fixtures/rear-end.toml fixtures/no-answer/restitution-one.toml --format csv");
    let rows = table(&String::from_utf8(output.stdout).unwrap(), b',');
    assert_eq!(cell(&rows[0], "case.sha256"), sum);
    assert_eq!(cell(&rows[1], "case.sha256").len(), 64);
    assert!(rows.iter().all(|row| cell(row, "program.version") == env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_row_says_that_ranges_are_held() {
    let rows = table(&out(&format!("reconstruct {UNCERTAIN} fixtures/rear-end.toml --format csv")), b',');
    let said = cell(&rows[0], "ranges");
    assert_eq!(said, "31 ranges held at their central values; deltav uncertainty propagates them");
    assert_eq!(cell(&rows[1], "ranges"), "");
}

#[test]
fn a_style_of_csv_without_csv_is_refused() {
    let output = deltav("reconstruct fixtures/rear-end.toml --format json --csv-style european");
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && message.contains("--samples-out"), "{message}");
}

/// Semicolons, decimal commas and a byte order mark, with the same values.
#[test]
fn a_european_spreadsheet_has_the_same_values() {
    let samples = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let pair = |arguments: &str, file: Option<&Path>| {
        ["international", "european"].map(|style| {
            let text = out(&format!("{arguments} --csv-style {style}"));
            file.map_or(text, |file| fs::read_to_string(file).unwrap())
        })
    };
    let file = samples.join("european-samples.csv");
    let with_samples = format!("uncertainty {UNCERTAIN} --samples 300 --samples-out {}", file.display());
    for (arguments, file) in [
        (&*format!("reconstruct {UNCERTAIN} fixtures/rear-end.toml --format csv"), None),
        ("compare fixtures/sae-980025.toml --format csv", None),
        (&*format!("uncertainty {UNCERTAIN} --samples 300 --format csv"), None),
        (&*with_samples, Some(&*file)),
    ] {
        let [international, european] = pair(arguments, file);
        let european = european.strip_prefix('\u{feff}').expect("a byte order mark");
        let (ours, theirs) = (table(&international, b','), table(european, b';'));
        assert_eq!(ours.len(), theirs.len());
        let mut numbers = 0;
        for ((name, our), (their_name, their)) in ours.iter().flatten().zip(theirs.iter().flatten()) {
            assert_eq!(name, their_name);
            match our.parse::<f64>() {
                Ok(value) => {
                    assert!(!their.contains('.'), "{name}: {their}");
                    assert_eq!(their.replace(',', ".").parse::<f64>(), Ok(value), "{name}");
                    numbers += 1;
                }
                Err(_) => assert_eq!(our, their, "{name}"),
            }
        }
        assert!(numbers > 50, "{arguments}");
    }
}

#[test]
fn a_folder_is_its_toml_files_in_order() {
    let by_name = {
        let mut names: Vec<_> = fs::read_dir("../../fixtures/ricsac")
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.ends_with(".toml"))
            .collect();
        names.sort();
        names.into_iter().map(|name| format!("fixtures/ricsac/{name}")).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(
        deltav("reconstruct fixtures/ricsac --format csv").stdout,
        deltav(&format!("reconstruct {by_name} --format csv")).stdout
    );
    let empty = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("empty folder".replace(' ', "-"));
    fs::create_dir_all(&empty).unwrap();
    let message = |arguments: String| String::from_utf8(deltav(&arguments).stderr).unwrap();
    let said = message(format!("crush {} --format csv", empty.display()));
    assert!(said.ends_with("is a folder without .toml files: name the case files\n"), "{said}");
    let said = message("check fixtures".to_owned());
    assert_eq!(said, "error: fixtures is a folder: name the case file in it\n");
    let said = message(format!("uncertainty {UNCERTAIN} --format csv --plots plots"));
    assert!(said.starts_with("error: --samples-out and --plots are for the report on one case"), "{said}");
}

#[test]
fn an_empty_file_is_called_empty() {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("empty.toml");
    for text in ["", "\n \t\r\n", "\u{feff}"] {
        fs::write(&file, text).unwrap();
        let output = deltav(&format!("reconstruct {}", file.display()));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.starts_with("error: the file is empty\n"), "{message}");
        assert!(message.contains("help: `deltav new` writes a template of a case file"), "{message}");
    }
}

/// 854 of 1,000 samples have an answer: 0.146 of them failed, to the last digit.
#[test]
fn the_share_of_failed_samples_is_no_difference_of_rounded_shares() {
    let text = out("uncertainty fixtures/wide-ranges.toml --samples 1000 --format csv");
    let row = &table(&text, b',')[0];
    let [samples, succeeded] = ["samples", "succeeded"].map(|name| number(row, name));
    assert!(succeeded < samples);
    // The shortest decimal of thousandths has three digits at most.
    let failed = cell(row, "failed_share");
    assert!(failed.len() <= 5, "{failed}");
    assert_eq!(failed.parse::<f64>().unwrap(), (samples - succeeded) / samples);
}
