//! Answers, and the report to hand over.

use std::ops::ControlFlow;

use analysis::{Analysis, Beside, Comparison, Estimated, Failure, Sensitivity, Sweep, Weighed};
use case::{Case, Purpose};
use pim_core::VehicleId;
use report::{Answer, Csv, CsvStyle, Document, Row, Supplements, Table, Units};
use serde_json::{Value, json};
use validation::{Data, validate};

use crate::given::{Given, Refused, made, unit_system};
use crate::{check, picture, warned};

/// What a command makes of a case.
type Solve = fn(&Case) -> Result<Analysis, Failure>;

/// The command of an analysis, by its name; an empty one is the most complete that the case allows.
fn solver(command: &str, case: &Case) -> Option<(&'static str, Solve)> {
    let command = if command.is_empty() { case.furthest_purpose().name() } else { command };
    let solvers: [(Purpose, Solve); 4] = [
        (Purpose::Reconstruct, analysis::reconstruct),
        (Purpose::Impact, analysis::impact),
        (Purpose::Motion, analysis::motion),
        (Purpose::Crush, analysis::crush),
    ];
    let solver = solvers.into_iter().find(|(purpose, _)| purpose.name() == command);
    solver.map(|(purpose, solve)| (purpose.name(), solve))
}

fn unknown(command: &str) -> Refused {
    Refused::message(format!("there is no command \"{}\" that answers", case::shown(command)))
}

pub(crate) fn answer(text: &str, command: &str, units: &str, name: Option<&str>) -> Value {
    made(Given::read(text, name, units).and_then(|given| match command {
        "compare" => compare(&given),
        "sensitivity" => sensitivity(&given),
        command => analyse(&given, command),
    }))
}

/// The analysis of a command, and the name of the command.
fn analysis(given: &Given, command: &str) -> Result<(&'static str, Analysis), Refused> {
    let case = &given.file.case;
    let (command, solve) = solver(command, case).ok_or_else(|| unknown(command))?;
    Ok((command, given.answered(solve(case))?))
}

fn warnings(given: &Given, analysis: &Analysis) -> Value {
    let seen = analysis.seen(given.file.case.axes);
    let warnings = seen.warnings.iter().map(|warning| {
        json!({
            "code": warning.warning().code(),
            "message": report::message(warning, given.units),
            "vehicle": warning.warning().vehicle().map(VehicleId::number),
            "keys": warned::keys(warning.warning()),
        })
    });
    warnings.collect()
}

fn analyse(given: &Given, command: &str) -> Result<Value, Refused> {
    let Given { file, units } = given;
    let (command, analysis) = analysis(given, command)?;
    let document = report::results(&file.case, &analysis, *units);
    let json = report::json(file, &analysis);
    let warnings = warnings(given, &analysis);
    let csv = csv(given, Table::Analyses, Answer::Analysis(Box::new(analysis)));
    answered(command, &document, json, csv, warnings)
}

fn comparison(given: &Given) -> Result<(Comparison, Document), Refused> {
    let Given { file, units } = given;
    let comparison = given.answered(analysis::compare(&file.case))?;
    let document = report::comparison(&file.case, &comparison, *units);
    Ok((comparison, document))
}

fn compare(given: &Given) -> Result<Value, Refused> {
    let (comparison, document) = comparison(given)?;
    let json = report::comparison_json(&given.file, &comparison);
    let csv = csv(given, Table::Comparisons, Answer::Comparison(Box::new(comparison)));
    answered("compare", &document, json, csv, json!([]))
}

fn sensitivities(given: &Given) -> Result<(Sensitivity, Document), Refused> {
    let Given { file, units } = given;
    let sensitivity = given.answered(analysis::sensitivity(&file.case, Sweep::default()))?;
    let document = report::sensitivity(&file.case, &sensitivity, *units);
    Ok((sensitivity, document))
}

fn sensitivity(given: &Given) -> Result<Value, Refused> {
    let (sensitivity, document) = sensitivities(given)?;
    let json = report::sensitivity_json(&given.file, &sensitivity);
    answered("sensitivity", &document, json, None, json!([]))
}

fn csv(given: &Given, table: Table, answer: Answer) -> Option<String> {
    let csv = Csv { table, units: given.units, style: CsvStyle::International };
    let name = given.file.source.name();
    let row = Row { file: name.as_given(), answer: Ok((&given.file, &answer)) };
    Some(csv.header().ok()? + &csv.row(row).ok()?)
}

fn answered(
    command: &str,
    document: &Document,
    json: Result<String, serde_json::Error>,
    csv: Option<String>,
    warnings: Value,
) -> Result<Value, Refused> {
    let json = json.map_err(|error| Refused::message(error.to_string()))?;
    Ok(json!({
        "ok": true,
        "command": command,
        "headline": document.headline(),
        "html": document.html_fragment(),
        "text": document.text(),
        "json": json,
        "csv": csv,
        "warnings": warnings,
    }))
}

/// What is seen first of a text, of one reading, one analysis and one drawing.
pub(crate) fn look(text: &str, command: &str, units: &str, what: &str, viewport: &str) -> Value {
    made(Given::read(text, None, units).map(|given| {
        let case = &given.file.case;
        let able = check::able(case);
        let asked = able.iter().find(|able| **able == command).or(able.first()).copied();
        let asked = asked.unwrap_or(if command.is_empty() { Purpose::Reconstruct.name() } else { command });
        let analysis = analysis(&given, asked);
        let furthest = analysis.as_ref().ok().map(|(_, analysis)| analysis);
        let furthest = furthest.filter(|_| asked == case.furthest_purpose().name());
        let scene = picture::first_view(&given, what, viewport, furthest);
        let mut look = match analysis {
            Ok((_, analysis)) => json!({
                "ok": true,
                "headline": report::results(case, &analysis, given.units).headline(),
                "weigh": analysis.overdetermined().is_some(),
                "warnings": warnings(&given, &analysis),
            }),
            Err(refused) => refused.json(),
        };
        look["scene"] = scene;
        look["command"] = json!(asked);
        look["able"] = json!(able);
        look["units"] = json!(unit_system(Units::of_case(case)));
        look
    }))
}

pub(crate) fn report(text: &str, name: &str, command: &str, units: &str, plan: Option<Vec<u8>>) -> Value {
    made(Given::read(text, Some(name), units).and_then(|given| {
        let document = match command {
            "compare" => comparison(&given)?.1,
            "sensitivity" => sensitivities(&given)?.1,
            command => handover(&given, command, plan)?,
        };
        Ok(json!({ "ok": true, "html": document.html() }))
    }))
}

/// The report to hand over, of the exact solution; `plan` is the picture that the case names.
fn handover(given: &Given, command: &str, plan: Option<Vec<u8>>) -> Result<Document, Refused> {
    let (_, analysis) = analysis(given, command)?;
    handed_over(given, &analysis, Known::default(), plan)
}

/// What is known of a case besides its exact solution.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Known<'a> {
    /// All the evidence, where it leads the report.
    pub(crate) weighed: Option<&'a Weighed>,
    /// The intervals with the errors of the method, where the exact solution leads.
    pub(crate) estimated: Option<&'a Estimated>,
}

/// The report to hand over, as the program makes it.
pub(crate) fn handed_over(
    given: &Given,
    analysis: &Analysis,
    known: Known<'_>,
    plan: Option<Vec<u8>>,
) -> Result<Document, Refused> {
    let Given { file, units } = given;
    let beside = analysis::beside(&file.case, analysis, &mut |_, _, _| ControlFlow::Continue(()));
    let Beside { uncertainty, sensitivity } = given.answered(beside)?;
    let validation = validate(&Data::built_in()).map_err(|error| Refused::message(error.to_string()))?;
    let site_plan = picture::site_plan(&file.case, plan)?;
    let supplements = Supplements {
        uncertainty: uncertainty.as_ref(),
        sensitivity: sensitivity.as_ref(),
        validation: Some(&validation),
        site_plan: site_plan.as_ref(),
        weighed: known.weighed,
        estimated: known.estimated,
    };
    let document = report::handover(file, analysis, supplements, *units);
    document.map_err(|error| Refused::message(error.to_string()))
}

pub(crate) fn live(
    page: &str,
    text: &str,
    name: &str,
    command: &str,
    units: &str,
    plan: Option<Vec<u8>>,
) -> Value {
    made(Given::read(text, Some(name), units).and_then(|given| {
        let document = handover(&given, command, plan)?;
        Ok(json!({ "ok": true, "html": alive(page, &document, &given)? }))
    }))
}

/// The page with a report in it.
pub(crate) fn alive(page: &str, document: &Document, given: &Given) -> Result<String, Refused> {
    let live = report::live(page, &document.html(), &given.file);
    live.map_err(|error| Refused::message(error.to_string()))
}
