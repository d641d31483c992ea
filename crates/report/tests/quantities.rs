//! The table of output quantities against the JSON, for every fixture that has an answer.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use analysis::{Analysis, Of, OutputQuantity, QUANTITIES, Values};
use case::CaseFile;
use serde_json::Value;

/// Every case of these folders under every command that has an answer to it.
fn analyses() -> Vec<(String, CaseFile, Analysis)> {
    fn cases(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                cases(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                found.push(path);
            }
        }
    }
    let mut paths = Vec::new();
    cases(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures"), &mut paths);
    paths.sort();
    let mut analyses = Vec::new();
    for path in paths {
        let name = path.file_name().unwrap().display().to_string();
        let Ok(file) = CaseFile::parse(&name, &fs::read_to_string(&path).unwrap_or_default()) else {
            continue;
        };
        for (command, answer) in [
            ("reconstruct", analysis::reconstruct(&file.case)),
            ("impact", analysis::impact(&file.case)),
            ("crush", analysis::crush(&file.case)),
        ] {
            if let Ok(analysis) = answer {
                analyses.push((format!("{command} {name}"), file.clone(), analysis));
            }
        }
    }
    assert!(analyses.len() > 50, "{}", analyses.len());
    analyses
}

fn json(file: &CaseFile, analysis: &Analysis) -> Value {
    serde_json::from_str(&report::json(&file.case, analysis).unwrap()).unwrap()
}

/// Where the JSON has each value of a quantity, and the value by the table.
fn places(quantity: &OutputQuantity, analysis: &Analysis) -> Vec<(String, Option<f64>)> {
    match quantity.values(analysis) {
        Values::Shared(value) => vec![(quantity.pointer.to_owned(), value)],
        Values::Pair(values) => (0..2)
            .map(|i| {
                let place = quantity.pointer.replace('#', &(i + 1).to_string()).replace('%', &i.to_string());
                (place, values[i])
            })
            .collect(),
    }
}

#[test]
fn each_row_has_the_number_of_the_json() {
    let mut seen = BTreeSet::new();
    for (name, file, analysis) in analyses() {
        let json = json(&file, &analysis);
        let analysis = analysis.in_axes(file.case.axes);
        for quantity in QUANTITIES {
            for (place, value) in places(quantity, &analysis) {
                let expected = json.pointer(&place).and_then(Value::as_f64);
                // serde_json reads a number within one unit of its last digit.
                let same = match (value, expected) {
                    (Some(value), Some(expected)) => (value - expected).abs() <= 1e-15 * expected.abs(),
                    (None, None) => true,
                    _ => false,
                };
                assert!(same, "{name}: {}: {value:?}, {place} has {expected:?}", quantity.key);
                if value.is_some() {
                    seen.insert(quantity.key);
                }
            }
        }
    }
    let unseen: Vec<&str> =
        QUANTITIES.iter().map(|quantity| quantity.key).filter(|key| !seen.contains(key)).collect();
    assert!(unseen.is_empty(), "no fixture has {unseen:?}");
}

/// Numbers of the JSON that are no quantity of the collision, by the start of their place.
const EXCEPTIONS: [(&str, &str); 6] = [
    ("/checks/", "a list of what was compared, with its limits"),
    ("/warnings/", "a list, in which a number is that of a vehicle"),
    ("/found/admissible_roots", "a count"),
    ("/found/roots/", "a list of any length, whose first is found.value"),
    ("/found/iterations/", "the way of the root-finder, of any length"),
    ("/crash3/corrections/", "a list, a row for each correction"),
];

fn numbers(place: &str, value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(place.to_owned()),
        Value::Array(elements) => {
            for (i, element) in elements.iter().enumerate() {
                numbers(&format!("{place}/{i}"), element, found);
            }
        }
        Value::Object(keys) => {
            for (key, element) in keys {
                numbers(&format!("{place}/{key}"), element, found);
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

#[test]
fn each_number_of_the_json_has_a_row() {
    let mut needed: BTreeSet<&str> = BTreeSet::new();
    for (name, file, analysis) in analyses() {
        let known: BTreeSet<String> = QUANTITIES
            .iter()
            .flat_map(|quantity| places(quantity, &analysis))
            .map(|(place, _)| place)
            .collect();
        let mut all = Vec::new();
        numbers("", &json(&file, &analysis), &mut all);
        for place in all.into_iter().filter(|place| !known.contains(place)) {
            let exception = EXCEPTIONS.iter().map(|(start, _)| *start).find(|start| place.starts_with(start));
            assert!(exception.is_some(), "{name}: {place} has no row");
            needed.extend(exception);
        }
    }
    assert_eq!(needed.len(), EXCEPTIONS.len(), "an exception that nothing needs: {needed:?}");
}

#[test]
fn keys_are_unique_and_found() {
    for quantity in QUANTITIES {
        let of_key = QUANTITIES.iter().filter(|other| other.key == quantity.key);
        assert_eq!(of_key.count(), 1, "{}", quantity.key);
        assert_eq!(analysis::quantity(quantity.key).unwrap().pointer, quantity.pointer);
        assert_eq!(quantity.is_of_vehicle(), quantity.pointer.contains(['#', '%']), "{}", quantity.key);
    }
}

/// The tables of a text: the line with the names of the columns, and the labels of the rows.
fn tables(text: &str) -> Vec<(&str, Vec<&str>)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut tables: Vec<(&str, Vec<&str>)> = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        if lines.get(i + 1).is_some_and(|rule| rule.starts_with('─')) {
            tables.push((line, Vec::new()));
        } else if let Some((_, rows)) = tables.last_mut() {
            // Two blanks end a label.
            rows.push(line.trim_start().split("  ").next().unwrap_or_default());
        }
    }
    tables
}

/// One number for both vehicles has no place under the name of one, nor one without direction under n.
#[test]
fn what_is_shared_stands_in_no_column_of_a_vehicle() {
    let shared = || QUANTITIES.iter().filter(|quantity| matches!(quantity.of, Of::Collision(_)));
    let (mut below, mut elsewhere) = (BTreeSet::new(), BTreeSet::new());
    for (name, file, analysis) in analyses() {
        let text = report::text(&file.case, &analysis, report::Units::Si);
        for (header, labels) in tables(&text) {
            let named = ["vehicle 1", "along n"].iter().any(|column| header.contains(column));
            for label in labels {
                if shared().any(|quantity| quantity.label == label) {
                    assert!(!named, "{name}: {label} stands under {header}");
                    elsewhere.insert(label.to_owned());
                } else if named && QUANTITIES.iter().any(|quantity| quantity.label == label) {
                    below.insert(label.to_owned());
                }
            }
        }
    }
    assert!(below.len() > 10 && elsewhere.len() > 10, "{below:?} {elsewhere:?}");
}
