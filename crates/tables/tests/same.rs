//! A row has the same bits as the program on the same case file.

use analysis::{Analysis, Failure, Plan, QUANTITIES};
use arrow_array::cast::AsArray as _;
use arrow_array::types::Float64Type;
use arrow_array::{Array, RecordBatch};
use case::{Case, CaseFile};
use report::{PROGRAM, Units};
use serde_json::Value as Json;
use std::ops::ControlFlow;
use tables::{Job, RowOptions, RowTemplate, run};
use uncertainty::{SamplingMethod, Settings};

use crate::fixtures::{self, Fixture, in_si, toml};
use crate::forms::{Names, flat, nested};

type Solve = fn(&Case) -> Result<Analysis, Failure>;

const JOBS: [(Job, Solve); 3] = [
    (Job::Reconstruct, analysis::reconstruct),
    (Job::Impact, analysis::impact),
    (Job::Crush, analysis::crush),
];

fn rows(job: Job, batch: &RecordBatch, options: &RowOptions) -> RecordBatch {
    run(job, batch, &RowTemplate::default(), options, &|_, _| ControlFlow::Continue(())).unwrap()
}

fn text(results: &RecordBatch, column: &str, row: usize) -> Option<String> {
    let array = results.column_by_name(column).unwrap().as_string::<i32>();
    array.is_valid(row).then(|| array.value(row).to_owned())
}

fn number(results: &RecordBatch, column: &str, row: usize) -> Option<f64> {
    let array = results.column_by_name(column).unwrap().as_primitive::<Float64Type>();
    array.is_valid(row).then(|| array.value(row))
}

/// The answer of the program to a text: its JSON, or its error.
fn program(text: &str, analyse: fn(&Case) -> Result<Analysis, Failure>) -> Result<Json, String> {
    let file = CaseFile::parse("case.toml", text).map_err(|errors| errors.one_line())?;
    match analyse(&file.case) {
        Ok(analysis) => Ok(serde_json::from_str(&report::json(&file, &analysis).unwrap()).unwrap()),
        Err(Failure::Case(faults)) => {
            // The sentences without their places in the text.
            let errors = file.diagnostics(&faults, &PROGRAM);
            let sentences = errors
                .list()
                .iter()
                .map(|one| one.problem().to_string().split_whitespace().collect::<Vec<_>>().join(" "));
            Err(sentences.collect::<Vec<_>>().join("; "))
        }
        Err(failure) => Err(report::no_answer(&failure, Units::of_case(&file.case))),
    }
}

/// Compares a row with the answer of the program; returns the number of numbers.
fn compare(
    name: &str,
    job: Job,
    results: &RecordBatch,
    row: usize,
    expected: &Result<Json, String>,
) -> usize {
    let error = text(results, "error", row);
    let json = match expected {
        Ok(json) => json,
        Err(sentence) => {
            assert_eq!(error.as_ref().map(|error| bare(error)), Some(bare(sentence)), "{name} {job:?}");
            return 0;
        }
    };
    assert_eq!(error, None, "{name} {job:?}");
    let mut numbers = 0;
    for quantity in QUANTITIES {
        let vehicles: &[Option<usize>] = if quantity.is_of_vehicle() { &[Some(1), Some(2)] } else { &[None] };
        for vehicle in vehicles {
            let (prefix, pointer) = match vehicle {
                Some(number) => (
                    format!("vehicle{number}_"),
                    quantity
                        .pointer
                        .replace('#', &number.to_string())
                        .replace('%', &(number - 1).to_string()),
                ),
                None => (String::new(), quantity.pointer.to_owned()),
            };
            let column = format!("{prefix}{}", quantity.key.replace('.', "_"));
            let expected = json.pointer(&pointer).and_then(Json::as_f64);
            if results.column_by_name(&column).is_none() {
                assert!(job == Job::Crush && expected.is_none(), "{name} {job:?} lacks {column}");
                continue;
            }
            let found = number(results, &column, row);
            assert_eq!(
                found.map(f64::to_bits),
                expected.map(f64::to_bits),
                "{name} {job:?} {column}: {found:?} and not {expected:?}"
            );
            numbers += usize::from(found.is_some());
        }
    }
    let codes: Vec<String> = json["warnings"].as_array().unwrap().iter().map(code).collect();
    let warnings = results.column_by_name("warnings").unwrap().as_list::<i32>().value(row);
    let warnings: Vec<&str> = warnings.as_string::<i32>().iter().map(Option::unwrap).collect();
    assert_eq!(warnings, codes, "{name} {job:?}");
    for key in ["axes", "energy_basis"] {
        assert_eq!(text(results, key, row).as_deref(), json[key].as_str(), "{name} {job:?} {key}");
    }
    if job == Job::Reconstruct {
        let quantity = json.pointer("/found/quantity").and_then(Json::as_str);
        assert_eq!(text(results, "found_quantity", row).as_deref(), quantity, "{name}");
    }
    numbers
}

fn code(warning: &Json) -> String {
    let code = warning["code"].as_str().unwrap();
    warning["vehicle"].as_u64().map_or_else(|| code.to_owned(), |vehicle| format!("vehicle{vehicle}.{code}"))
}

/// A sentence without the key that a row has in front of it.
fn bare(sentence: &str) -> String {
    sentence
        .split("; ")
        .map(|part| part.rsplit_once(": ").map_or(part, |(_, rest)| rest))
        .collect::<Vec<_>>()
        .join("; ")
}

/// In one table, nested, every row with a law, sides and a number of stations of its own.
#[test]
fn nested_rows_are_the_program() {
    let fixtures = fixtures::all();
    let values: Vec<_> = fixtures.iter().map(|fixture| in_si(&fixture.values)).collect();
    let batch = nested(&values.iter().collect::<Vec<_>>());
    let mut numbers = 0;
    for (job, analyse) in JOBS {
        let results = rows(job, &batch, &RowOptions::default());
        assert_eq!(results.num_rows(), fixtures.len());
        for (row, (fixture, values)) in fixtures.iter().zip(&values).enumerate() {
            numbers += compare(&fixture.name, job, &results, row, &program(&toml(values), analyse));
        }
    }
    assert!(numbers > 4000, "{numbers} numbers");
}

/// With the units of the file itself.
#[test]
fn flat_rows_are_the_program() {
    let mut numbers = 0;
    for Fixture { name, text, values } in fixtures::all() {
        for names in [Names::Dotted, Names::Underscored, Names::Texts] {
            let batch = flat(&values, names);
            for (job, analyse) in JOBS {
                let results = rows(job, &batch, &RowOptions::default());
                numbers += compare(&name, job, &results, 0, &program(&text, analyse));
            }
        }
    }
    assert!(numbers > 12000, "{numbers} numbers");
}

/// The template alone, and empty rows.
#[test]
fn a_template_is_the_program() {
    let empty = arrow_array::new_null_array(&arrow_schema::DataType::Null, 2);
    let batch = RecordBatch::try_from_iter([("seed", empty)]).unwrap();
    for Fixture { name, text, .. } in fixtures::all() {
        let template = RowTemplate::parse(&name, &text).unwrap();
        for (job, analyse) in JOBS {
            let results =
                run(job, &batch, &template, &RowOptions::default(), &|_, _| ControlFlow::Continue(()))
                    .unwrap();
            compare(&name, job, &results, 1, &program(&text, analyse));
        }
    }
}

#[test]
fn intervals_are_the_program() {
    let mut numbers = 0;
    for Fixture { name, text: of_file, values } in fixtures::all() {
        let file = CaseFile::parse("case.toml", &of_file).unwrap();
        if !analysis::is_uncertain(&file.case) || analysis::is_searched_back(&file.case) {
            continue;
        }
        let Ok(_) = analysis::reconstruct(&file.case) else { continue };
        let settings = Settings::new(SamplingMethod::MonteCarlo, 200, 7);
        let plan = Plan { settings, index_rows: None };
        let of_program = analysis::uncertainty(&file.case, &plan, &mut |_, _, _| ControlFlow::Continue(()));
        let of_program = of_program.unwrap();
        let json: Json =
            serde_json::from_str(&report::uncertainty_json(&file, &of_program).unwrap()).unwrap();
        let options = RowOptions { samples: Some(200), seed: 7, ..RowOptions::default() };
        let results = rows(Job::Reconstruct, &flat(&values, Names::Dotted), &options);
        for (path, output) in json["outputs"].as_object().unwrap() {
            for (statistic, pointer) in [
                ("p025", "/interval95/0"),
                ("median", "/median"),
                ("p975", "/interval95/1"),
                ("mean", "/mean"),
                ("sd", "/sd"),
            ] {
                let column = format!("{}_{statistic}", path.replace('.', "_"));
                let expected = output.pointer(pointer).and_then(Json::as_f64);
                let found = number(&results, &column, 0);
                assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{name} {column}");
                numbers += usize::from(found.is_some());
            }
        }
    }
    assert!(numbers > 500, "{numbers} numbers");
}

#[test]
fn an_estimate_is_the_program() {
    let Fixture { text, values, .. } = fixtures::one("estimate.toml");
    let file = CaseFile::parse("case.toml", &text).unwrap();
    let options = RowOptions { particles: 128, seed: 3, ..RowOptions::default() };
    let plan = analysis::EstimatePlan {
        particles: 128,
        seed: 3,
        prior: None,
        pieces: analysis::PieceDetail::Weighed,
    };
    let estimated = analysis::estimate(&file.case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
    let asked = report::Asked { plan, questions: Vec::new() };
    let json: Json =
        serde_json::from_str(&report::estimate_json(&file, &estimated, &asked).unwrap()).unwrap();
    let results = rows(Job::Estimate, &flat(&values, Names::Dotted), &options);
    let converged = results.column_by_name("converged").unwrap().as_boolean().value(0);
    assert_eq!(Some(converged), json["converged"].as_bool());
    assert_eq!(number(&results, "ess", 0), json["ess"].as_f64());
    let mut numbers = 0;
    for (path, output) in json["outputs"].as_object().unwrap() {
        for (statistic, pointer) in
            [("p025", "/interval95/0"), ("median", "/median"), ("p975", "/interval95/1"), ("sd", "/sd")]
        {
            let column = format!("{}_{statistic}", path.replace('.', "_"));
            let expected = output.pointer(pointer).and_then(Json::as_f64);
            assert_eq!(
                number(&results, &column, 0).map(f64::to_bits),
                expected.map(f64::to_bits),
                "{column}"
            );
            numbers += usize::from(expected.is_some());
        }
    }
    assert!(numbers > 40, "{numbers} numbers");
}
