//! Several case files at once: a row each, the same for any number of threads.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use serde_json::Value;

use crate::changes::invalid_cases;

fn deltav(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_deltav")).current_dir("../..").args(arguments).output().unwrap()
}

/// All case files of the fixtures, wrong ones and ones without an answer too, each part sorted.
fn case_files() -> Vec<String> {
    fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.ends_with("invalid") {
                continue;
            }
            if path.is_dir() {
                collect(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                files.push(path);
            }
        }
    }
    let mut files = Vec::new();
    collect(Path::new("../../fixtures"), &mut files);
    files.sort();
    let mut files: Vec<String> =
        files.iter().map(|path| path.strip_prefix("../..").unwrap().display().to_string()).collect();
    files.extend(INVALID.iter().cloned());
    files
}

/// The invalid cases, most of which are given in the fixtures as changes of one, as a file each.
static INVALID: LazyLock<Vec<String>> = LazyLock::new(|| {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("invalid");
    fs::create_dir_all(&folder).unwrap();
    let write = |(name, text)| {
        let path = folder.join(format!("{name}.toml"));
        fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    invalid_cases().into_iter().map(write).collect()
});

/// Records of RFC 4180, read by its grammar.
fn records(csv: &str) -> Vec<Vec<String>> {
    let mut records = vec![vec![String::new()]];
    let mut quoted = false;
    let mut characters = csv.chars().peekable();
    while let Some(c) = characters.next() {
        let record = records.last_mut().unwrap();
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                record.last_mut().unwrap().push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => record.push(String::new()),
            '\n' if !quoted => records.push(vec![String::new()]),
            c => record.last_mut().unwrap().push(c),
        }
    }
    assert_eq!(records.pop(), Some(vec![String::new()]), "the last line ends in a line feed");
    records
}

#[test]
fn rows_stand_in_the_order_of_the_arguments_and_are_the_same_for_any_number_of_threads() {
    let mut files = case_files();
    // Sorted neither by name nor by their run time.
    files.reverse();
    files.push("no/such/file.toml".to_owned());
    assert!(files.len() > 200);
    for format in ["csv", "jsonl"] {
        let mut first: Option<Vec<u8>> = None;
        for threads in ["1", "2", "7"] {
            let mut arguments = vec!["reconstruct", "--format", format, "--threads", threads];
            arguments.extend(files.iter().map(String::as_str));
            let output = deltav(&arguments);
            assert_eq!(output.status.code(), Some(1));
            let bytes = first.get_or_insert_with(|| output.stdout.clone());
            assert!(*bytes == output.stdout, "{format} differs with {threads} threads");
        }
        let text = String::from_utf8(first.unwrap()).unwrap();
        let named: Vec<String> = if format == "csv" {
            let records = records(&text);
            assert!(records.iter().all(|record| record.len() == records[0].len()));
            records.iter().skip(1).map(|record| record[0].clone()).collect()
        } else {
            let name =
                |line| serde_json::from_str::<Value>(line).unwrap()["file"].as_str().map(str::to_owned);
            text.lines().map(|line| name(line).unwrap()).collect()
        };
        assert_eq!(named, files);
    }
}

/// Where `--format json` has the value of a column.
fn place(column: &str) -> String {
    let name = column.split(" (").next().unwrap();
    let mut place = name.replace('.', "/");
    for (end, index) in
        [("/before", "/0"), ("/after", "/1"), ("/x", "/0"), ("/y", "/1"), ("/low", "/0"), ("/high", "/1")]
    {
        // A place of rest has its parts by name.
        if let Some(list) = place.strip_suffix(end).filter(|list| !list.ends_with("/rest")) {
            place = format!("{list}{index}");
        }
    }
    for (vehicle, index) in [("vehicle1", "0"), ("vehicle2", "1")] {
        place = place.replace(&format!("{vehicle}/delta_v/"), &format!("{vehicle}/delta_v_vector/"));
        for block in ["crash3", "momentum", "law_check"] {
            if let Some(list) = place.strip_prefix(&format!("{vehicle}/{block}")) {
                place = format!("{block}{list}/{index}");
            }
        }
    }
    format!("/{place}")
}

#[test]
fn a_row_says_what_the_json_of_its_file_says() {
    let (mut compared, mut helped) = (0, 0);
    let files = case_files();
    let [jsonl, csv] = ["jsonl", "csv"].map(|format| {
        let arguments = ["reconstruct", "--format", format].into_iter();
        let output = deltav(&arguments.chain(files.iter().map(String::as_str)).collect::<Vec<_>>());
        assert_eq!(output.status.code(), Some(1));
        String::from_utf8(output.stdout).unwrap()
    });
    let mut records = records(&csv).into_iter();
    let columns = records.next().unwrap();
    assert_eq!([jsonl.lines().count(), records.len()], [files.len(); 2]);
    for ((file, line), cells) in files.iter().zip(jsonl.lines()).zip(records) {
        let alone = deltav(&["reconstruct", file, "--exact", "--format", "json"]);
        assert!(line.starts_with(r#"{"file":"#), "{file}");
        let line: Value = serde_json::from_str(line).unwrap();
        if !alone.status.success() {
            let error = line["error"].as_str().unwrap();
            assert!(error.len() > 10 && !error.contains('\n'), "{file}: {error:?}");
            let help = line.get("help").map_or("", |help| help.as_str().unwrap());
            // An error of the reader always says what to write.
            assert!(!file.contains("/invalid/") || !help.is_empty(), "{file}");
            assert!(!help.contains('\n'));
            let known = ["file", "error", "help", "program", "case"];
            assert!(line.as_object().unwrap().keys().all(|key| known.contains(&key.as_str())), "{file}");
            let printed = String::from_utf8(alone.stderr).unwrap();
            // The error text shows the same help, broken into lines.
            let words = |text: &str| text.replace('|', "").split_whitespace().collect::<Vec<_>>().join(" ");
            if printed.matches("help: ").count() == 1 {
                let placed = help.strip_prefix("line ").and_then(|placed| placed.split_once(": "));
                let shown = placed.map_or(help, |(_, help)| help);
                assert!(words(&printed).contains(&words(shown)), "{file}: {shown}\n{printed}");
                helped += 1;
            }
            for (column, cell) in columns.iter().zip(&cells) {
                let expected = match column.as_str() {
                    "file" => file,
                    "error" => error,
                    "help" => help,
                    "program.version" => env!("CARGO_PKG_VERSION"),
                    // Empty for a file that cannot be read.
                    "case.sha256" => line.pointer("/case/sha256").map_or("", |hash| hash.as_str().unwrap()),
                    _ => "",
                };
                assert_eq!(cell, expected, "{file}: {column}");
            }
            continue;
        }
        let mut json: Value = serde_json::from_slice(&alone.stdout).unwrap();
        for (column, cell) in columns.iter().zip(&cells) {
            let value = json.pointer(&place(column));
            match (column.as_str(), value) {
                ("file", _) => assert_eq!(cell, file),
                ("error" | "help", _) => assert_eq!(cell, ""),
                ("ranges", _) => {
                    let case = case::CaseFile::parse(
                        "",
                        &fs::read_to_string(Path::new("../..").join(file)).unwrap(),
                    );
                    let ranges = case.unwrap().case.ranges.len();
                    let held = match ranges {
                        0 => String::new(),
                        1 => "1 range held at its central value; ".to_owned(),
                        _ => format!("{ranges} ranges held at their central values; "),
                    };
                    assert_eq!(cell.split("deltav").next().unwrap(), held, "{file}");
                }
                ("warnings", _) => {
                    let warnings = json["warnings"].as_array().unwrap();
                    let codes: Vec<String> = warnings
                        .iter()
                        .map(|warning| match warning["vehicle"].as_u64() {
                            Some(vehicle) => {
                                format!("vehicle{vehicle}.{}", warning["code"].as_str().unwrap())
                            }
                            None => warning["code"].as_str().unwrap().to_owned(),
                        })
                        .collect();
                    assert_eq!(cell.split_whitespace().collect::<Vec<_>>(), codes);
                }
                (_, Some(Value::Number(number))) => {
                    // serde_json reads a number within one unit of its last digit.
                    let (cell, number) = (cell.parse::<f64>().unwrap(), number.as_f64().unwrap());
                    assert!(
                        (cell - number).abs() <= 1e-15 * number.abs(),
                        "{file}: {column}: {cell}, {number}"
                    );
                    compared += 1;
                }
                (_, Some(Value::String(text))) => assert_eq!(cell, text, "{file}: {column}"),
                (_, Some(Value::Bool(fixed))) => assert_eq!(*cell, fixed.to_string(), "{file}: {column}"),
                (_, None | Some(Value::Null)) => assert_eq!(cell, "", "{file}: {column}"),
                (_, other) => panic!("{column} has {other:?}"),
            }
        }
        json["file"] = file.as_str().into();
        assert_eq!(line, json);
    }
    assert!(compared > 1000 && helped > 100, "{compared} {helped}");
}

#[test]
fn text_that_csv_has_to_quote_reads_back() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join("quoting, \"quoted\".toml");
    let case = fs::read_to_string("../../fixtures/sae-980025.toml").unwrap();
    let title = case.lines().find(|line| line.starts_with("title")).unwrap();
    fs::write(&path, case.replace(title, r#"title = "two, \"three\"\nand a line, = 1""#)).unwrap();
    let path = path.display().to_string();
    let output = folder.join("rows.csv");
    let printed = deltav(&["reconstruct", &path, "--format", "csv", "-o", &output.display().to_string()]);
    assert_eq!((printed.status.code(), printed.stdout.len(), printed.stderr.len()), (Some(0), 0, 0));
    let csv = fs::read_to_string(output).unwrap();
    assert!(csv.contains(r#""two, ""three""#), "{csv}");
    let records = records(&csv);
    let cell = |name: &str| {
        let column = records[0].iter().position(|column| column == name).unwrap();
        records[1][column].as_str()
    };
    assert_eq!((cell("file"), cell("title")), (&*path, "two, \"three\"␊and a line, = 1"));
    // SAE 980025, appendix: 75 ft/s.
    assert!((cell("found.value (m/s)").parse::<f64>().unwrap() / 0.3048 - 75.0).abs() < 0.05);
}

#[test]
fn no_text_of_a_case_is_a_formula_to_a_spreadsheet() {
    let case = fs::read_to_string("../../fixtures/sae-980025.toml").unwrap();
    let line = |key: &str| case.lines().find(|line| line.trim_start().starts_with(key)).unwrap();
    for lead in ["=", "+", "-", "@", "＝", "＋", "－", "＠", r"\t", r"\r", r"\n"] {
        let text = case
            .replace(line("title"), &format!("title = \"{lead}1+2\""))
            .replace(line("name"), &format!("name = \"{lead}cmd|' /C calc'!A0\""));
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("=1+2.toml");
        fs::write(&path, text).unwrap();
        let run = |format: &str| {
            let folder = path.parent().unwrap();
            let deltav = Command::new(env!("CARGO_BIN_EXE_deltav"))
                .current_dir(folder)
                .args(["reconstruct", "=1+2.toml", "--format", format])
                .output()
                .unwrap();
            String::from_utf8(deltav.stdout).unwrap()
        };
        let [columns, cells] = <[Vec<String>; 2]>::try_from(records(&run("csv"))).unwrap();
        let cell = |name: &str| cells[columns.iter().position(|column| column == name).unwrap()].as_str();
        let raw = lead.replace(r"\t", "\t").replace(r"\r", "\r").replace(r"\n", "\n");
        let start = raw.replace('\t', "␉").replace('\r', "␍").replace('\n', "␊");
        assert_eq!(cell("file"), "'=1+2.toml");
        assert_eq!(cell("title"), format!("'{start}1+2"));
        assert_eq!(cell("vehicle1.name"), format!("'{start}cmd|' /C calc'!A0"));
        // A number is a number: the Jimmy drives to −x.
        assert!(cell("vehicle1.velocity.x (m/s)").parse::<f64>().unwrap() < -22.0);
        for cell in cells.iter().filter(|cell| cell.parse::<f64>().is_err()) {
            assert!(
                !cell.starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠', '\t', '\r', '\n']),
                "{cell:?}"
            );
        }
        let json: Value = serde_json::from_str(&run("jsonl")).unwrap();
        assert_eq!(json["title"], format!("{raw}1+2"));
    }
}

/// The size of a unit of the US columns in SI: the foot and the pound by definition, and standard gravity.
fn in_si(unit: &str) -> f64 {
    let (foot, pound): (f64, f64) = (0.3048, 0.453_592_37 * 9.806_65);
    match unit {
        "mph" => 5280.0 * foot / 3600.0,
        "deg" | "deg/s" => std::f64::consts::PI / 180.0,
        "ft" => foot,
        "ft lb" | "ft lb s" => foot * pound,
        "lb s" | "lb" => pound,
        "s" => 1.0,
        other => panic!("{other}"),
    }
}

/// ½ m v² before less that after is the sum of the works of the impulses, including that of the moment
/// impulse.
#[test]
fn the_energy_of_a_row_balances() {
    let csv = deltav(&["reconstruct", "fixtures/laws/moment.toml", "--format", "csv"]).stdout;
    let [columns, cells] = <[Vec<String>; 2]>::try_from(records(&String::from_utf8(csv).unwrap())).unwrap();
    let energy = |name: &str| -> f64 {
        let name = format!("impact.{name} (J)");
        cells[columns.iter().position(|column| *column == name).unwrap()].parse().unwrap()
    };
    let loss = energy("initial_energy") - energy("final_energy");
    let works = ["normal_work", "tangential_work", "moment_work"].map(energy);
    assert!(works[2] > 1000.0, "{works:?}");
    assert!((loss - works.iter().sum::<f64>()).abs() < 1e-9 * loss, "{loss} {works:?}");
    assert!((energy("energy_loss") - loss).abs() < 1e-9 * loss);
}

/// Columns are promises: those of today, in their order, with their units.
#[test]
fn columns_keep_their_names_and_order() {
    let csv = deltav(&["reconstruct", "fixtures/laws/moment.toml", "--format", "csv"]).stdout;
    let mut columns = records(&String::from_utf8(csv).unwrap())[0].clone().into_iter();
    let of_vehicle = [
        "name",
        "speed (m/s)",
        "velocity.x (m/s)",
        "velocity.y (m/s)",
        "yaw_rate (rad/s)",
        "final_velocity.x (m/s)",
        "final_velocity.y (m/s)",
        "final_yaw_rate (rad/s)",
        "delta_v (m/s)",
        "delta_v.x (m/s)",
        "delta_v.y (m/s)",
        "pdof (rad)",
        "stiffness_source",
        "crush_source",
        "crush_energy (J)",
        "ees (m/s)",
        "oblique_angle (rad)",
        "oblique_factor",
        "corrected_crush_energy (J)",
        "peak_force (N)",
        "crash3.delta_v (m/s)",
        "crash3.corrected_delta_v (m/s)",
    ];
    let shared = [
        "file",
        "error",
        "title",
        "axes",
        "found.quantity",
        "found.value (m/s)",
        "found.admissible_roots",
        "energy_basis",
        "impact.law",
        "impact.restitution",
        "impact.impulse_ratio",
        "impact.critical_impulse_ratio",
        "impact.normal_impulse (N s)",
        "impact.tangential_impulse (N s)",
        "impact.normal_velocity.before (m/s)",
        "impact.normal_velocity.after (m/s)",
        "impact.tangential_velocity.before (m/s)",
        "impact.tangential_velocity.after (m/s)",
        "impact.initial_energy (J)",
        "impact.final_energy (J)",
        "impact.energy_loss (J)",
        "impact.normal_work (J)",
        "impact.tangential_work (J)",
    ];
    let vehicles = [1, 2].into_iter().flat_map(|i| of_vehicle.map(|name| format!("vehicle{i}.{name}")));
    for name in
        shared.map(str::to_owned).into_iter().chain(vehicles).chain(["warnings", "help"].map(str::to_owned))
    {
        assert!(columns.any(|column| column == name), "{name} is missing or elsewhere");
    }
}

/// The units depend neither on the files nor on the order of the columns, but on an option.
#[test]
fn us_columns_have_the_values_of_the_si_columns() {
    let mut converted = 0;
    for command in ["reconstruct", "impact"] {
        for file in case_files().iter().filter(|file| !file.contains("/invalid/")) {
            let rows = |units: &[&str]| {
                let output = deltav(&[&[command, file, "--format", "csv"], units].concat());
                <[Vec<String>; 2]>::try_from(records(&String::from_utf8(output.stdout).unwrap())).unwrap()
            };
            let [[names, default], [si_names, si], [us_names, us]] =
                [rows(&[]), rows(&["--units", "si"]), rows(&["--units", "us"])];
            assert_eq!((&names, &default), (&si_names, &si), "{file}");
            assert_eq!(names.len(), us_names.len());
            for (i, (name, us_name)) in names.iter().zip(&us_names).enumerate() {
                let (bare, unit) = us_name.split_once(" (").unwrap_or((us_name, ""));
                assert_eq!(name.split(" (").next(), Some(bare));
                assert_eq!(name.contains(" ("), !unit.is_empty(), "{name} {us_name}");
                if unit.is_empty() || si[i].is_empty() {
                    assert_eq!(si[i], us[i], "{file}: {name}");
                    continue;
                }
                let [si, us] = [&si[i], &us[i]].map(|cell| cell.parse::<f64>().unwrap());
                let expected = si / in_si(unit.strip_suffix(')').unwrap());
                assert!(
                    (us - expected).abs() <= 1e-14 * expected.abs(),
                    "{file}: {us_name}: {us}, {expected}"
                );
                converted += 1;
            }
        }
    }
    assert!(converted > 1000, "{converted}");
}

#[test]
fn rows_of_impacts_are_those_of_their_json_with_nothing_found() {
    let files: Vec<String> = case_files().into_iter().filter(|file| file.contains("ricsac/")).collect();
    let run = |format: &str| {
        let mut arguments = vec!["impact", "--format", format];
        arguments.extend(files.iter().map(String::as_str));
        deltav(&arguments)
    };
    let (csv, jsonl) = (run("csv"), run("jsonl"));
    let records = records(&String::from_utf8(csv.stdout).unwrap());
    let lines: Vec<Value> = jsonl
        .stdout
        .split(|&byte| byte == b'\n')
        .filter_map(|line| serde_json::from_slice(line).ok())
        .collect();
    assert_eq!((records.len(), lines.len()), (files.len() + 1, files.len()));
    let (mut answered, mut refused) = (0, 0);
    for ((file, line), cells) in files.iter().zip(&lines).zip(&records[1..]) {
        let alone = deltav(&["impact", file, "--format", "json"]);
        assert_eq!((line["file"].as_str(), &cells[0]), (Some(file.as_str()), file));
        if !alone.status.success() {
            assert!(line["error"].is_string() && !cells[1].is_empty(), "{file}");
            refused += 1;
            continue;
        }
        let mut json: Value = serde_json::from_slice(&alone.stdout).unwrap();
        json["file"] = file.as_str().into();
        assert_eq!(*line, json);
        for (column, cell) in records[0].iter().zip(cells) {
            if column.starts_with("found.") {
                assert_eq!(cell, "", "{file}: {column}");
            } else if let Some(number) = json.pointer(&place(column)).and_then(Value::as_f64) {
                let cell: f64 = cell.parse().unwrap();
                assert!((cell - number).abs() <= 1e-15 * number.abs(), "{file}: {column}");
            }
        }
        answered += 1;
    }
    // Two of the files are not cases: the numbers that the papers print.
    assert_eq!(refused, 2);
    assert!(answered > 5, "{answered}");
    assert_eq!((csv.status.code(), jsonl.status.code()), (Some(1), Some(1)));
}
