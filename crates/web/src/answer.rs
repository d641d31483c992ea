//! Answers, and the report to hand over.

use std::ops::ControlFlow;

use analysis::Analysis;
use case::Purpose;
use pim_core::VehicleId;
use report::{Csv, CsvStyle, Document, Drawing, ExactSolution, Row, Units};
use requests::{Answer, OptionError, Request, RequestOptions, SolvedCase};
use serde_json::{Value, json};

use crate::given::{Given, Refused, made};
use crate::{check, picture, warned};

/// A command of this name, an empty one being the most complete that the case allows, and its answer.
fn solved<'a>(given: &Given, command: &'a str) -> Result<(&'a str, Request, Answer), Refused> {
    let case = &given.file.case;
    let command = if command.is_empty() { case.furthest_purpose().name() } else { command };
    let request = Request::read(command, &RequestOptions::default())?;
    // A command that takes long is left to a worker.
    let answer = request.begin(case).map_err(|_| OptionError::Command(command.to_owned()))?;
    let answer = given.found(answer)?;
    Ok((command, request, answer))
}

pub(crate) fn answer(text: &str, command: &str, units: &str, name: Option<&str>) -> Value {
    made(Given::read(text, name, units).and_then(|given| {
        let (command, request, answer) = solved(&given, command)?;
        let document = answer.document(&given.file, given.units);
        let json = answer.json(&given.file).map_err(|error| Refused::message(error.to_string()))?;
        let warnings = match &answer {
            Answer::Analysis(solved) => warnings(&given, &solved.analysis),
            _ => json!([]),
        };
        Ok(json!({
            "ok": true,
            "command": command,
            "headline": document.headline(),
            "html": document.html_fragment(),
            "charts": charts(&document),
            "text": document.text(),
            "json": json,
            "csv": csv(&given, &request, &answer),
            "warnings": warnings,
        }))
    }))
}

fn warnings(given: &Given, analysis: &Analysis) -> Value {
    let seen = analysis.seen(given.file.case.axes);
    let is_answer = analysis.why_not_exact().is_none();
    let warnings = seen.warnings.iter().map(|warning| {
        json!({
            "code": warning.warning().code(),
            "message": report::message(warning, given.units),
            "vehicle": warning.warning().vehicle().map(VehicleId::number),
            "keys": warned::keys(warning.warning()),
            "aside": !is_answer && warning.warning().is_of_exact_solution(),
        })
    });
    warnings.collect()
}

/// The exact solution if it is not the answer; otherwise `null`.
fn exact(given: &Given, analysis: &Analysis) -> Value {
    ExactSolution::not_the_answer(analysis, given.units).map_or(Value::Null, |exact| {
        json!({
            "by": exact.by,
            "speeds": exact.speeds,
            "delta_v": exact.delta_v,
            "caveat": exact.caveat,
        })
    })
}

/// The charts of a document.
pub(crate) fn charts(document: &Document) -> Vec<Value> {
    let chart = |(name, drawing): (&str, Drawing)| json!({ "name": name, "title": drawing.title(), "svg": drawing.svg_named(name) });
    document.charts().map(chart).collect()
}

/// The table of the answer, or the data that its recorders stored.
fn csv(given: &Given, request: &Request, answer: &Answer) -> Option<String> {
    if matches!(answer, Answer::Recorders(_)) {
        return Some(samples(answer)).filter(|samples| !samples.is_empty());
    }
    let csv = Csv { table: request.rows()?, units: given.units, style: CsvStyle::International };
    let name = given.file.source.name();
    let row = Row { file: name.as_given(), answer: Ok((&given.file, answer.row()?)) };
    Some(csv.header().ok()? + &csv.row(row).ok()?)
}

/// The samples or draws of an answer as CSV, or the data that recorders stored; empty if there are none.
pub(crate) fn samples(answer: &Answer) -> String {
    let mut bytes = Vec::new();
    let written = answer.write_samples(CsvStyle::International, &mut bytes);
    // Writing a text to memory does not fail.
    written.ok().and_then(|()| String::from_utf8(bytes).ok()).unwrap_or_default()
}

/// The headline of an answer.
struct First {
    headline: Vec<String>,
    /// The analysis, if the answer is one.
    analysis: Option<Box<SolvedCase>>,
}

impl First {
    fn of(given: &Given, command: &str) -> Result<Self, Refused> {
        let Given { file, units } = given;
        let of_document = |document: &Document| document.headline().to_vec();
        if command == Purpose::Avoid.name() {
            let found = given.answered(analysis::avoid_at_once(&file.case))?;
            // If the speed has to be found first, there is no headline yet, as that takes time.
            let headline = found.map(|found| of_document(&report::avoid(&file.case, &found, *units)));
            return Ok(Self { headline: headline.unwrap_or_default(), analysis: None });
        }
        Ok(match solved(given, command)?.2 {
            Answer::Analysis(solved) => {
                let headline = of_document(&report::results(&file.case, &solved.analysis, *units));
                Self { headline, analysis: Some(solved) }
            }
            other => Self { headline: of_document(&other.document(file, *units)), analysis: None },
        })
    }
}

/// The first view of a text, from one reading, one analysis and one drawing.
pub(crate) fn look(text: &str, command: &str, units: &str, what: &str, viewport: &str) -> Value {
    made(Given::read(text, None, units).map(|given| {
        let case = &given.file.case;
        let able = check::able(case);
        let asked = able.iter().find(|able| **able == command).or(able.first()).copied();
        let asked = asked.unwrap_or(if command.is_empty() { Purpose::Reconstruct.name() } else { command });
        let first = First::of(&given, asked);
        let furthest = first.as_ref().ok().and_then(|first| first.analysis.as_deref());
        let furthest = furthest.filter(|_| asked == case.furthest_purpose().name());
        let scene = picture::first_view(&given, what, viewport, furthest.map(|solved| &solved.analysis));
        let mut look = match first {
            Ok(First { headline, analysis }) => {
                let analysis = analysis.as_ref().map(|solved| &solved.analysis);
                json!({
                    "ok": true,
                    "headline": headline,
                    "exact": analysis.map_or(Value::Null, |analysis| exact(&given, analysis)),
                    "warnings": analysis.map_or(json!([]), |analysis| warnings(&given, analysis)),
                })
            }
            Err(refused) => refused.json(),
        };
        look["scene"] = scene;
        look["command"] = json!(asked);
        look["able"] = json!(able);
        look["units"] = json!(case::word(&Units::WORDS, &Units::of_case(case)));
        look
    }))
}

pub(crate) fn report(text: &str, name: &str, command: &str, units: &str, plan: Option<Vec<u8>>) -> Value {
    made(Given::read(text, Some(name), units).and_then(|given| {
        let (_, _, answer) = solved(&given, command)?;
        Ok(json!({ "ok": true, "html": page(&given, &answer, plan)?.html() }))
    }))
}

/// The report to hand over, as the program makes it; `plan` is the picture that the case names.
pub(crate) fn page(given: &Given, answer: &Answer, plan: Option<Vec<u8>>) -> Result<Document, Refused> {
    let Given { file, units } = given;
    let site_plan = picture::site_plan(&file.case, plan)?;
    let page = answer.page(file, site_plan.as_ref(), *units, &mut |_, _, _| ControlFlow::Continue(()));
    page.map_err(|error| Refused::of_page(&error, file, *units))
}

pub(crate) fn live(
    program: &str,
    text: &str,
    name: &str,
    command: &str,
    units: &str,
    plan: Option<Vec<u8>>,
) -> Value {
    made(Given::read(text, Some(name), units).and_then(|given| {
        let document = page(&given, &solved(&given, command)?.2, plan)?;
        Ok(json!({ "ok": true, "html": alive(program, &document, &given)? }))
    }))
}

/// The page with a report in it.
pub(crate) fn alive(page: &str, document: &Document, given: &Given) -> Result<String, Refused> {
    let live = report::live(page, &document.html(), &given.file);
    live.map_err(|error| Refused::message(error.to_string()))
}
