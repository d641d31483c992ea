//! Many reconstructions, a row each: as CSV for a spreadsheet, or as one JSON document a line.

use analysis::Analysis;
use case::Case;
use serde::Serialize;
use serde_json::Value;

use crate::json::document;
use crate::units::{Quantity, Units};

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

/// A column that is there once: its name and, in the JSON document, its place (RFC 6901).
const SHARED: [(&str, &str); 23] = [
    ("file", "/file"),
    ("error", "/error"),
    ("title", "/title"),
    ("axes", "/axes"),
    ("found.quantity", "/found/quantity"),
    ("found.value (m/s)", "/found/value"),
    ("found.admissible_roots", "/found/admissible_roots"),
    ("energy_basis", "/energy_basis"),
    ("impact.law", "/impact/law"),
    ("impact.restitution", "/impact/restitution"),
    ("impact.impulse_ratio", "/impact/impulse_ratio"),
    ("impact.critical_impulse_ratio", "/impact/critical_impulse_ratio"),
    ("impact.normal_impulse (N s)", "/impact/normal_impulse"),
    ("impact.tangential_impulse (N s)", "/impact/tangential_impulse"),
    ("impact.normal_velocity.before (m/s)", "/impact/normal_velocity/0"),
    ("impact.normal_velocity.after (m/s)", "/impact/normal_velocity/1"),
    ("impact.tangential_velocity.before (m/s)", "/impact/tangential_velocity/0"),
    ("impact.tangential_velocity.after (m/s)", "/impact/tangential_velocity/1"),
    ("impact.initial_energy (J)", "/impact/initial_energy"),
    ("impact.final_energy (J)", "/impact/final_energy"),
    ("impact.energy_loss (J)", "/impact/energy_loss"),
    ("impact.normal_work (J)", "/impact/normal_work"),
    ("impact.tangential_work (J)", "/impact/tangential_work"),
];

/// Columns of each vehicle: what follows `vehicle1` and `vehicle2`, and the place, in which `#` is the number of the vehicle and `%` one less.
const VEHICLE: [(&str, &str); 22] = [
    ("name", "/vehicle#/name"),
    ("speed (m/s)", "/vehicle#/speed"),
    ("velocity.x (m/s)", "/vehicle#/velocity/0"),
    ("velocity.y (m/s)", "/vehicle#/velocity/1"),
    ("yaw_rate (rad/s)", "/vehicle#/yaw_rate"),
    ("final_velocity.x (m/s)", "/vehicle#/final_velocity/0"),
    ("final_velocity.y (m/s)", "/vehicle#/final_velocity/1"),
    ("final_yaw_rate (rad/s)", "/vehicle#/final_yaw_rate"),
    ("delta_v (m/s)", "/vehicle#/delta_v"),
    ("delta_v.x (m/s)", "/vehicle#/delta_v_vector/0"),
    ("delta_v.y (m/s)", "/vehicle#/delta_v_vector/1"),
    ("pdof (rad)", "/vehicle#/pdof"),
    ("stiffness_source", "/vehicle#/stiffness_source"),
    ("crush_source", "/vehicle#/crush_source"),
    ("crush_energy (J)", "/vehicle#/crush_energy"),
    ("ees (m/s)", "/vehicle#/ees"),
    ("oblique_angle (rad)", "/vehicle#/oblique_angle"),
    ("oblique_factor", "/vehicle#/oblique_factor"),
    ("corrected_crush_energy (J)", "/vehicle#/corrected_crush_energy"),
    ("peak_force (N)", "/vehicle#/peak_force"),
    ("crash3.delta_v (m/s)", "/crash3/delta_v/%"),
    ("crash3.corrected_delta_v (m/s)", "/crash3/corrected_delta_v/%"),
];

/// The last columns: the codes of all warnings, with spaces between them, as `vehicle2.burg-inertia` where one is of one vehicle, and what to write
/// instead of what is wrong.
const LAST: [&str; 2] = ["warnings", "help"];

/// What the names of columns end in, in SI and in US units, and what it is the unit of. There is one column for a speed: mph.
const UNITS: [(&str, &str, Quantity); 6] = [
    ("(m/s)", "(mph)", Quantity::RoadSpeed),
    ("(rad)", "(deg)", Quantity::Angle),
    ("(rad/s)", "(deg/s)", Quantity::YawRateDegrees),
    ("(J)", "(ft lb)", Quantity::Energy),
    ("(N s)", "(lb s)", Quantity::Impulse),
    ("(N)", "(lb)", Quantity::Force),
];

/// Where the values of a column are converted: its name without the unit, the unit, and what it is of.
fn converted(name: &str, units: Units) -> Option<(&str, &'static str, Quantity)> {
    let find = || {
        UNITS.iter().find_map(|&(si, us, quantity)| name.strip_suffix(si).map(|bare| (bare, us, quantity)))
    };
    match units {
        Units::Si => None,
        Units::Us => find(),
    }
}

/// The columns of [`csv_row`]: names that do not change, with the unit of the values in parentheses. Columns may be added.
#[must_use]
pub fn csv_columns(units: Units) -> Vec<String> {
    let named = |name: &str| {
        converted(name, units).map_or_else(|| name.to_owned(), |(bare, unit, _)| format!("{bare}{unit}"))
    };
    let of_vehicle = |vehicle: usize| VEHICLE.map(|(name, _)| format!("vehicle{vehicle}.{}", named(name)));
    let shared = SHARED.map(|(name, _)| named(name));
    shared.into_iter().chain(of_vehicle(1)).chain(of_vehicle(2)).chain(LAST.map(str::to_owned)).collect()
}

/// The line with the names of the columns.
///
/// # Errors
/// [`RowError`], which no names cause.
pub fn csv_header(units: Units) -> Result<String, RowError> {
    line(&csv_columns(units))
}

/// One line of CSV (RFC 4180, but for the plain line feed at its end) under the [`csv_header`] of the same units: SI units and radians, or US units with speeds in mph
/// and degrees. Each number is the shortest that reads back as the same; there is nothing where there is no value.
///
/// A spreadsheet runs a cell that begins with `=`, `+`, `-`, `@`, tab or carriage return as a formula, and titles and names come from whoever wrote the
/// file. Such a text, never a number, has an apostrophe before it: the spreadsheet shows a text, and a program takes the apostrophe away. [`jsonl_row`]
/// has all texts as they are.
///
/// # Errors
/// [`RowError`], which no analysis causes.
pub fn csv_row(row: Row<'_>, units: Units) -> Result<String, RowError> {
    let value = value(row)?;
    let cell = |name: &str, place: &str| {
        let found = value.pointer(place);
        match (converted(name, units), found.and_then(Value::as_f64)) {
            (Some((_, _, quantity)), Some(si)) => cell(&units.value(quantity, si).into()),
            _ => found.map(cell).unwrap_or_default(),
        }
    };
    let mut cells: Vec<String> = SHARED.iter().map(|(name, place)| cell(name, place)).collect();
    for vehicle in [1, 2] {
        let place =
            |place: &str| place.replace('#', &vehicle.to_string()).replace('%', &(vehicle - 1).to_string());
        cells.extend(VEHICLE.iter().map(|(name, of_either)| cell(name, &place(of_either))));
    }
    let warnings = value.get("warnings").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let codes = warnings.iter().filter_map(|warning| {
        let code = warning.get("code").and_then(Value::as_str)?;
        let vehicle = warning.get("vehicle").and_then(Value::as_u64);
        Some(vehicle.map_or_else(|| code.to_owned(), |vehicle| format!("vehicle{vehicle}.{code}")))
    });
    cells.push(codes.collect::<Vec<_>>().join(" "));
    cells.push(cell("help", "/help"));
    line(&cells)
}

/// One JSON document on one line: what [`json`](crate::json()) gives, with the `file` before all else; or `file`, `error` and, where there is more to say, `help`.
///
/// # Errors
/// [`RowError`], which no analysis causes.
pub fn jsonl_row(Row { file, answer }: Row<'_>) -> Result<String, RowError> {
    let line = match answer {
        Ok((case, analysis)) => serde_json::to_string(&document(Some(file), case, analysis))?,
        Err(refused) => serde_json::to_string(&RefusedFile::new(file, refused))?,
    };
    Ok(line + "\n")
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
    match text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        true => format!("'{text}"),
        false => text.to_owned(),
    }
}

fn line(cells: &[String]) -> Result<String, RowError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(cells)?;
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    // What went in was text, and so is what comes out.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
