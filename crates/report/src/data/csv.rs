//! Many reconstructions, a row each: as CSV for a spreadsheet, or as one JSON document a line.

use analysis::{Analysis, Kind, OutputQuantity, QUANTITIES, Values};
use case::{Case, shown};
use pim_core::VehicleId;
use serde::Serialize;
use serde_json::Value;

use super::json::document;
use super::on_one_line;
use crate::units::{Measure, Units};

/// What came of one file.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// The name of the file.
    pub file: &'a str,
    /// Its case and its analysis, or why there is none.
    pub answer: Result<(&'a Case, &'a Analysis), Refused<'a>>,
}

/// Why a file has no answer.
#[derive(Clone, Copy, Debug)]
pub struct Refused<'a> {
    /// What is wrong and where, on one line.
    pub error: &'a str,
    /// What to write instead, on one line; empty where the error says all.
    pub help: &'a str,
}

/// Why a row cannot be written; no analysis causes that.
#[derive(Debug, thiserror::Error)]
pub enum RowError {
    /// Not as JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// Not as CSV.
    #[error(transparent)]
    Csv(#[from] csv::Error),
}

/// A column of text or of a count: its name, its place in the JSON document (RFC 6901), and the quantity
/// before whose column it stands.
struct Text {
    name: &'static str,
    place: &'static str,
    before: &'static str,
}

const fn text(name: &'static str, place: &'static str, before: &'static str) -> Text {
    Text { name, place, before }
}

/// Those that are there once.
const SHARED: [Text; 9] = [
    text("file", "/file", "found.value"),
    text("error", "/error", "found.value"),
    text("title", "/title", "found.value"),
    text("axes", "/axes", "found.value"),
    text("found.quantity", "/found/quantity", "found.value"),
    text("found.admissible_roots", "/found/admissible_roots", "impact.restitution"),
    text("energy_basis", "/energy_basis", "impact.restitution"),
    text("impact.law", "/impact/law", "impact.restitution"),
    text("impact.regime", "/impact/regime", "impact.restitution"),
];

/// Those of each vehicle: the place has `#` for the number of the vehicle.
const VEHICLE: [Text; 4] = [
    text("name", "/vehicle#/name", "speed"),
    text("fixed", "/vehicle#/fixed", "speed"),
    text("stiffness_source", "/vehicle#/stiffness_source", "crush_energy"),
    text("crush_source", "/vehicle#/crush_source", "crush_energy"),
];

/// What stands in a column.
enum Column {
    /// What the JSON document has at this place.
    Place(String),
    /// A quantity of the collision, or of this vehicle.
    Quantity(&'static OutputQuantity, Option<VehicleId>),
}

/// The columns before the last: names in SI units, and what stands in them. Every quantity has one.
fn columns() -> Vec<(String, Column)> {
    let mut columns = Vec::new();
    let mut add = |texts: &[Text], vehicle: Option<VehicleId>| {
        let prefix = vehicle.map_or_else(String::new, |id| format!("vehicle{id}."));
        let number = vehicle.map_or_else(String::new, |id| id.to_string());
        for quantity in QUANTITIES.iter().filter(|quantity| quantity.is_of_vehicle() == vehicle.is_some()) {
            for text in texts.iter().filter(|text| text.before == quantity.key) {
                let place = text.place.replace('#', &number);
                columns.push((format!("{prefix}{}", text.name), Column::Place(place)));
            }
            let name = format!("{prefix}{}{}", quantity.key, unit(quantity.kind));
            columns.push((name, Column::Quantity(quantity, vehicle)));
        }
    };
    add(&SHARED, None);
    for id in VehicleId::ALL {
        add(&VEHICLE, Some(id));
    }
    columns
}

/// What the name of a column in SI units ends in.
fn unit(kind: Kind) -> &'static str {
    match kind {
        Kind::Ratio => "",
        Kind::Speed => " (m/s)",
        Kind::Length => " (m)",
        Kind::Angle => " (rad)",
        Kind::YawRate => " (rad/s)",
        Kind::Energy => " (J)",
        Kind::Impulse => " (N s)",
        Kind::MomentImpulse => " (N m s)",
        Kind::Force => " (N)",
    }
}

/// The last columns: the codes of all warnings, with spaces between them, as `vehicle2.burg-inertia` where
/// one is of one vehicle, and what to write instead of what is wrong.
const LAST: [&str; 2] = ["warnings", "help"];

/// What the names of columns end in, in SI and in US units, and what it is the unit of. There is one column
/// for a speed: mph.
const UNITS: [(&str, &str, Measure); 8] = [
    ("(m/s)", "(mph)", Measure::RoadSpeed),
    ("(m)", "(ft)", Measure::Length),
    ("(rad)", "(deg)", Measure::Angle),
    ("(rad/s)", "(deg/s)", Measure::YawRateDegrees),
    ("(J)", "(ft lb)", Measure::Energy),
    ("(N s)", "(lb s)", Measure::Impulse),
    ("(N m s)", "(ft lb s)", Measure::MomentImpulse),
    ("(N)", "(lb)", Measure::Force),
];

/// Where the values of a column are converted: its name without the unit, the unit, and what it is of.
fn converted(name: &str, units: Units) -> Option<(&str, &'static str, Measure)> {
    let find = || {
        UNITS.iter().find_map(|&(si, us, quantity)| name.strip_suffix(si).map(|bare| (bare, us, quantity)))
    };
    match units {
        Units::Si => None,
        Units::Us => find(),
    }
}

/// The columns of [`csv_row`]: names that do not change, with the unit of the values in parentheses. Columns
/// may be added.
#[must_use]
pub fn csv_columns(units: Units) -> Vec<String> {
    let named = |name: String| match converted(&name, units) {
        Some((bare, unit, _)) => format!("{bare}{unit}"),
        None => name,
    };
    columns().into_iter().map(|(name, _)| named(name)).chain(LAST.map(str::to_owned)).collect()
}

/// The line with the names of the columns.
///
/// # Errors
/// [`RowError`], which no names cause.
pub fn csv_header(units: Units) -> Result<String, RowError> {
    line(&csv_columns(units))
}

/// One line of CSV (RFC 4180, but for the plain line feed at its end) under the [`csv_header`] of the same
/// units: SI units and radians, or US units with speeds in mph and degrees. Each number is the shortest that
/// reads back as the same; there is nothing where there is no value.
///
/// A spreadsheet runs a cell that begins with `=`, `+`, `-`, `@`, one of their full-width forms, tab, line
/// feed or carriage return as a formula, and titles and names come from whoever wrote the file. Such a text,
/// never a number, has an apostrophe before it: the spreadsheet shows a text, and a program takes the
/// apostrophe away. Control characters are [shown](case::shown). [`jsonl_row`] has all texts as they are.
///
/// # Errors
/// [`RowError`], which no analysis causes.
pub fn csv_row(row: Row<'_>, units: Units) -> Result<String, RowError> {
    let value = value(row)?;
    let seen = row.answer.ok().map(|(case, analysis)| analysis.seen(case.axes));
    let number = |name: &str, quantity: &OutputQuantity, vehicle: Option<VehicleId>| {
        let si = match quantity.values(seen.as_ref()?) {
            Values::Shared(value) => value,
            Values::Pair(values) => values[vehicle?.index()],
        };
        Some(match (converted(name, units), si?) {
            (Some((_, _, unit)), si) => units.value(unit, si),
            (None, si) => si,
        })
    };
    let mut cells: Vec<String> = columns()
        .into_iter()
        .map(|(name, column)| match column {
            Column::Place(place) => value.pointer(&place).map(cell).unwrap_or_default(),
            Column::Quantity(quantity, vehicle) => {
                number(&name, quantity, vehicle).map(|number| cell(&number.into())).unwrap_or_default()
            }
        })
        .collect();
    let warnings = value.get("warnings").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let codes = warnings.iter().filter_map(|warning| {
        let code = warning.get("code").and_then(Value::as_str)?;
        let vehicle = warning.get("vehicle").and_then(Value::as_u64);
        Some(vehicle.map_or_else(|| code.to_owned(), |vehicle| format!("vehicle{vehicle}.{code}")))
    });
    cells.push(codes.collect::<Vec<_>>().join(" "));
    cells.push(value.pointer("/help").map(cell).unwrap_or_default());
    line(&cells)
}

/// One JSON document on one line: what [`json`](crate::json()) gives, with the `file` before all else; or
/// `file`, `error` and, where there is more to say, `help`.
///
/// # Errors
/// [`RowError`], which no analysis causes.
pub fn jsonl_row(Row { file, answer }: Row<'_>) -> Result<String, RowError> {
    Ok(match answer {
        Ok((case, analysis)) => on_one_line(&document(Some(file), case, analysis))?,
        Err(refused) => on_one_line(&RefusedFile::new(file, refused))?,
    })
}

#[derive(Serialize)]
struct RefusedFile<'a> {
    file: &'a str,
    error: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    help: &'a str,
}

impl<'a> RefusedFile<'a> {
    fn new(file: &'a str, Refused { error, help }: Refused<'a>) -> Self {
        Self { file, error, help }
    }
}

fn value(Row { file, answer }: Row<'_>) -> Result<Value, serde_json::Error> {
    match answer {
        Ok((case, analysis)) => serde_json::to_value(document(Some(file), case, analysis)),
        Err(refused) => serde_json::to_value(RefusedFile::new(file, refused)),
    }
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => no_formula(text),
        other => other.to_string(),
    }
}

/// A text as a spreadsheet should show it: see [`csv_row`].
fn no_formula(text: &str) -> String {
    // The list of the Open Worldwide Application Security Project (OWASP, CSV Injection).
    const BEGINS_A_FORMULA: [char; 11] = ['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠'];
    let shown = shown(text);
    // Standard input is called so, and a sign alone is no formula.
    match text.starts_with(BEGINS_A_FORMULA) && text != "-" {
        true => format!("'{shown}"),
        false => shown.into_owned(),
    }
}

fn line(cells: &[String]) -> Result<String, RowError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(cells)?;
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    // What went in was text, and so is what comes out.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
