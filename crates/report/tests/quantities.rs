//! The table of output quantities against the JSON, for every fixture that has an answer.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use analysis::{Analysis, Of, OutputQuantity, QUANTITIES, Seen, Values};
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
    serde_json::from_str(&report::json(file, analysis).unwrap()).unwrap()
}

/// Where the JSON has each value of a quantity, and the value by the table.
fn places(quantity: &OutputQuantity, analysis: &Seen) -> Vec<(String, Option<f64>)> {
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
        let analysis = analysis.seen(file.case.axes);
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

/// Numbers of the JSON that are not quantities of the collision, by the beginning of their path.
const EXCEPTIONS: [(&str, &str); 12] = [
    ("/checks/", "a list of what was compared, with its limits"),
    ("/warnings/", "a list, in which a number is that of a vehicle"),
    ("/headline/", "the answer: the speeds and ΔV that have their rows, or an estimate of them"),
    ("/found/admissible_roots", "a count"),
    ("/found/roots/", "a list of any length, whose first is found.value"),
    ("/found/0/", "of vehicle 1, where both speeds are found: vehicle1.speed"),
    ("/found/1/", "of vehicle 2: vehicle2.speed"),
    ("/vehicle", "moments of the way to rest, of any number"),
    ("/found/iterations/", "the way of the root-finder, of any length"),
    ("/tangential_share", "an input: reconstruct.energy_basis.tangential_share"),
    ("/crash3/corrections/", "a list, a row for each correction"),
    ("/momentum/combinations/", "the motions that lead to the rests, of any number"),
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
        let seen = analysis.seen(file.case.axes);
        let known: BTreeSet<String> =
            QUANTITIES.iter().flat_map(|quantity| places(quantity, &seen)).map(|(place, _)| place).collect();
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
        let text = report::results(&file.case, &analysis, report::Units::Si).text();
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

/// A row whose label is in no table of the text, and the place of its number instead.
const ELSEWHERE: [(&str, &str); 1] = [("found.value", "in the answer above all tables")];

#[test]
fn each_row_stands_in_csv_glossary_and_text() {
    let columns = report::Csv {
        table: report::Table::Analyses,
        units: report::Units::Si,
        style: report::CsvStyle::International,
    }
    .columns();
    let mut labels = BTreeSet::new();
    for (_, file, analysis) in analyses() {
        let text = report::results(&file.case, &analysis, report::Units::Si).text();
        let rows = tables(&text).into_iter().flat_map(|(_, rows)| rows.into_iter().map(str::to_owned));
        labels.extend(rows.collect::<Vec<_>>());
    }
    let mut unknown = BTreeSet::new();
    for quantity in QUANTITIES {
        let key = if quantity.is_of_vehicle() {
            format!("vehicle2.{}", quantity.key)
        } else {
            quantity.key.to_owned()
        };
        let is_column = |name: &String| {
            name.strip_prefix(&key).is_some_and(|unit| unit.is_empty() || unit.starts_with(" ("))
        };
        assert!(columns.iter().any(is_column), "{key} has no column");
        if report::topic(quantity.name).is_err() {
            unknown.insert(quantity.name);
        }
        let is_elsewhere = ELSEWHERE.iter().any(|(key, _)| *key == quantity.key);
        assert_ne!(labels.contains(quantity.label), is_elsewhere, "{} in the text", quantity.label);
    }
    assert!(unknown.is_empty(), "not in the glossary: {unknown:?}");
}

/// By the heading of each vehicle: the part forward, ΔV·(cos θ, sin θ), and that to the left, ΔV·(−sin θ, cos
/// θ), which z-down axes count to the right.
#[test]
fn the_parts_of_a_velocity_change_are_those_along_the_axes_of_the_vehicle() {
    let mut seen = 0;
    for (name, file, analysis) in analyses() {
        let json = json(&file, &analysis);
        for i in 0..2 {
            let vehicle = &json[format!("vehicle{}", i + 1)];
            let Some(vector) = vehicle["delta_v_vector"].as_array() else { continue };
            let [x, y] = [0, 1].map(|axis| vector[axis].as_f64().unwrap());
            let heading = file.case.vehicles[i].heading.as_ref().unwrap().si();
            let part = |key: &str| vehicle[key].as_f64().unwrap();
            // In z-down axes angles count clockwise, and the y axis of the vehicle is to its right: the same
            // formula.
            let expected = [x * heading.cos() + y * heading.sin(), y * heading.cos() - x * heading.sin()];
            let found = [part("delta_v_longitudinal"), part("delta_v_lateral")];
            let scale = part("delta_v").max(1e-9);
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() <= 1e-12 * scale, "{name}: {found} {expected}");
            }
            // A force from the right pushes to the left: tan PDOF = lateral / −longitudinal, lateral counted
            // to the left.
            let left = if file.case.axes == case::Axes::ZDown { -found[1] } else { found[1] };
            let pdof = left.atan2(-found[0]);
            let turn = (pdof - part("pdof")).rem_euclid(std::f64::consts::TAU);
            assert!(turn.min(std::f64::consts::TAU - turn) < 1e-9, "{name}: {pdof}");
            seen += usize::from(left.abs() > 0.1);
        }
    }
    assert!(seen > 20, "{seen}");
}
