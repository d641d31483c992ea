//! Many cases, one row each: as CSV for a spreadsheet, or as one JSON document per line.

use std::sync::LazyLock;

use analysis::quantities::{CRUSH_ENERGY, FOUND_VALUE, IMPACT_RESTITUTION, SPEED};
use analysis::{Analysis, Comparison, Kind, Output, OutputQuantity, QUANTITIES, Uncertainty};
use case::{CaseFile, shown};
use pim_core::VehicleId;
use serde_json::Value;

use super::{case_file, comparison, followed, identified, json, object, on_one_line, program, uncertainty};
use crate::units::{Measure, Units};

/// The result of one file.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// The name of the file.
    pub file: &'a str,
    /// The case and its answer, or why there is none.
    pub answer: Result<(&'a CaseFile, RowAnswer<'a>), Refused<'a>>,
}

/// The answer in a row.
#[derive(Clone, Copy, Debug)]
pub enum RowAnswer<'a> {
    /// The answer of `deltav reconstruct`, `deltav impact` and `deltav crush`.
    Analysis(&'a Analysis),
    /// The answer of `deltav compare`.
    Comparison(&'a Comparison),
    /// The answer of `deltav uncertainty`.
    Uncertainty(&'a Uncertainty),
}

/// Why a file has no answer.
#[derive(Clone, Copy, Debug)]
pub struct Refused<'a> {
    /// What is wrong and where, on one line.
    pub error: &'a str,
    /// What to write instead, on one line; empty if the error suffices.
    pub help: &'a str,
    /// The bytes of the file, if it could be read.
    pub bytes: Option<&'a [u8]>,
}

/// A table for a spreadsheet: which rows it has, and how they are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Csv {
    /// The kind of rows.
    pub table: Table,
    /// The units of its numbers.
    pub units: Units,
    /// The style that the spreadsheet reads.
    pub style: CsvStyle,
}

/// The kind of rows of a [`Csv`]. The [`RowAnswer`] of each row is of this kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// One analysis per row.
    Analyses,
    /// One law of one case per row.
    Comparisons,
    /// The intervals of one case per row.
    Uncertainties,
}

/// The separator of columns and the decimal mark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CsvStyle {
    /// Commas between the columns, and a decimal point (RFC 4180).
    #[default]
    International,
    /// Semicolons between the columns, a decimal comma, and a byte order mark, without which spreadsheets
    /// take UTF-8 for another encoding.
    European,
}

impl CsvStyle {
    /// The beginning of the file.
    pub(crate) fn beginning(self) -> &'static str {
        match self {
            Self::International => "",
            Self::European => "\u{feff}",
        }
    }

    /// The separator of two columns.
    pub(crate) fn separator(self) -> char {
        match self {
            Self::International => ',',
            Self::European => ';',
        }
    }

    /// A number, which has a decimal point.
    pub(crate) fn number(self, number: String) -> String {
        match self {
            Self::International => number,
            Self::European => number.replace('.', ","),
        }
    }
}

/// Why a row cannot be written, which no analysis causes.
#[derive(Debug, thiserror::Error)]
pub enum RowError {
    /// It cannot be written as JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// It cannot be written as CSV.
    #[error(transparent)]
    Csv(#[from] csv::Error),
}

/// A column with a text or a count: its name, its place in the JSON document (RFC 6901), and the quantity
/// whose column follows it.
struct Text {
    name: &'static str,
    place: &'static str,
    before: &'static OutputQuantity,
}

const fn text(name: &'static str, place: &'static str, before: &'static OutputQuantity) -> Text {
    Text { name, place, before }
}

/// Columns of the whole case.
const SHARED: [Text; 10] = [
    text("file", "/file", &FOUND_VALUE),
    text("error", "/error", &FOUND_VALUE),
    text("title", "/title", &FOUND_VALUE),
    text("axes", "/axes", &FOUND_VALUE),
    text("headline.by", "/headline/by", &FOUND_VALUE),
    text("found.quantity", "/found/quantity", &FOUND_VALUE),
    text("found.admissible_roots", "/found/admissible_roots", &IMPACT_RESTITUTION),
    text("energy_basis", "/energy_basis", &IMPACT_RESTITUTION),
    text("impact.law", "/impact/law", &IMPACT_RESTITUTION),
    text("impact.regime", "/impact/regime", &IMPACT_RESTITUTION),
];

/// Columns of each vehicle: the place has `#` for the number of the vehicle.
const VEHICLE: [Text; 4] = [
    text("name", "/vehicle#/name", &SPEED),
    text("fixed", "/vehicle#/fixed", &SPEED),
    text("stiffness_source", "/vehicle#/stiffness_source", &CRUSH_ENERGY),
    text("crush_source", "/vehicle#/crush_source", &CRUSH_ENERGY),
];

/// The content of a column.
enum Column {
    /// The value at this place in the JSON document.
    Place(String),
    /// The share of the samples without an answer.
    FailedShare,
    /// A note that the row has the central values of ranges.
    Ranges,
    /// The codes of all warnings, with spaces between them; `vehicle2.burg-inertia` if one is about one
    /// vehicle.
    Warnings,
    /// A quantity of the collision, or of this vehicle.
    Quantity(&'static OutputQuantity, Option<VehicleId>),
}

/// The columns: names in SI units, and contents. Made once, because each row needs them.
fn columns(table: Table) -> &'static [(String, Column)] {
    static COLUMNS: LazyLock<[Vec<(String, Column)>; 3]> =
        LazyLock::new(|| [Table::Analyses, Table::Comparisons, Table::Uncertainties].map(made));
    let [analyses, comparisons, uncertainties] = &*COLUMNS;
    match table {
        Table::Analyses => analyses,
        Table::Comparisons => comparisons,
        Table::Uncertainties => uncertainties,
    }
}

fn made(table: Table) -> Vec<(String, Column)> {
    let mut columns = match table {
        Table::Analyses => of_analyses(),
        Table::Comparisons => of_comparisons(),
        Table::Uncertainties => of_uncertainties(),
    };
    let place = |name: &str, place: &str| (name.to_owned(), Column::Place(place.to_owned()));
    columns.push(("warnings".to_owned(), Column::Warnings));
    columns.push(place("help", "/help"));
    if table != Table::Uncertainties {
        columns.push(("ranges".to_owned(), Column::Ranges));
    }
    columns.push(place("program.version", "/program/version"));
    columns.push(place("case.sha256", "/case/sha256"));
    if table == Table::Analyses {
        columns.push(place("tangential_share", "/tangential_share"));
    }
    columns
}

/// Every quantity has a column.
fn of_analyses() -> Vec<(String, Column)> {
    let mut columns = Vec::new();
    let mut add = |texts: &[Text], vehicle: Option<VehicleId>| {
        let prefix = vehicle.map_or_else(String::new, |id| format!("vehicle{id}."));
        let number = vehicle.map_or_else(String::new, |id| id.to_string());
        for quantity in QUANTITIES.iter().filter(|quantity| quantity.is_of_vehicle() == vehicle.is_some()) {
            for text in texts.iter().filter(|text| text.before.key == quantity.key) {
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

/// The columns that each row of a comparison fills, with their places in it.
const COMPARISON: [(&str, &str); 24] = [
    ("law", "law"),
    ("coefficients", "coefficients"),
    ("assumed", "assumed"),
    ("regime", "regime"),
    ("found (m/s)", "found"),
    ("found_difference (m/s)", "found_difference"),
    ("vehicle1.speed (m/s)", "speeds/0"),
    ("vehicle2.speed (m/s)", "speeds/1"),
    ("vehicle1.speed_difference (m/s)", "speeds_difference/0"),
    ("vehicle2.speed_difference (m/s)", "speeds_difference/1"),
    ("vehicle1.delta_v (m/s)", "delta_v/0"),
    ("vehicle2.delta_v (m/s)", "delta_v/1"),
    ("vehicle1.delta_v_difference (m/s)", "delta_v_difference/0"),
    ("vehicle2.delta_v_difference (m/s)", "delta_v_difference/1"),
    ("vehicle1.pdof (rad)", "pdof/0"),
    ("vehicle2.pdof (rad)", "pdof/1"),
    ("vehicle1.final_yaw_rate (rad/s)", "final_yaw_rate/0"),
    ("vehicle2.final_yaw_rate (rad/s)", "final_yaw_rate/1"),
    ("energy_loss (J)", "energy_loss"),
    ("normal_share", "normal_share"),
    ("tangential_share", "tangential_share"),
    ("moment_share", "moment_share"),
    ("vehicle1.friction", "friction/0"),
    ("vehicle2.friction", "friction/1"),
];

/// The kinds of evidence, whose answers are the same in all rows of a case.
const EVIDENCE: [&str; 3] = ["damage", "momentum", "momentum_and_damage"];

/// The columns of each, with their places in it.
const BY_EVIDENCE: [(&str, &str); 8] = [
    ("vehicle1.speed (m/s)", "speeds/0"),
    ("vehicle2.speed (m/s)", "speeds/1"),
    ("vehicle1.delta_v (m/s)", "delta_v/0"),
    ("vehicle2.delta_v (m/s)", "delta_v/1"),
    ("closing_speed (m/s)", "closing_speed"),
    ("crush_energy_needed (J)", "crush_energy_needed"),
    ("energy_loss (J)", "energy_loss"),
    ("error", "error"),
];

/// The places have `#` for the number of the row.
fn of_comparisons() -> Vec<(String, Column)> {
    let place = |name: &str, place: &str| (name.to_owned(), Column::Place(place.to_owned()));
    let mut columns = vec![
        place("file", "/file"),
        // The error of the file, or of the law.
        place("error", "/error"),
        place("law_error", "/rows/#/error"),
        place("title", "/title"),
        place("axes", "/axes"),
    ];
    columns
        .extend(COMPARISON.map(|(name, place)| (name.to_owned(), Column::Place(format!("/rows/#/{place}")))));
    let measured = Column::Place("/evidence/crush_energy".to_owned());
    columns.push(("evidence.crush_energy (J)".to_owned(), measured));
    for evidence in EVIDENCE {
        columns.extend(BY_EVIDENCE.map(|(name, place)| {
            (format!("evidence.{evidence}.{name}"), Column::Place(format!("/evidence/{evidence}/{place}")))
        }));
    }
    columns.push((
        "evidence.momentum_and_damage.standard_deviations_apart".to_owned(),
        Column::Place("/evidence/momentum_and_damage/standard_deviations_apart".to_owned()),
    ));
    columns
}

/// The statistics of an output, with their places in it.
const STATISTICS: [(&str, &str); 5] = [
    ("central", "central"),
    ("median", "median"),
    ("sd", "sd"),
    ("low95", "interval95/0"),
    ("high95", "interval95/1"),
];

fn of_uncertainties() -> Vec<(String, Column)> {
    let mut columns: Vec<(String, Column)> =
        ["file", "error", "title", "axes", "method", "seed", "samples", "succeeded"]
            .map(|name| (name.to_owned(), Column::Place(format!("/{name}"))))
            .into();
    columns.push(("failed_share".to_owned(), Column::FailedShare));
    for output in Output::all() {
        let path = output.path();
        let unit = unit(output.quantity().kind);
        columns.extend(STATISTICS.map(|(name, place)| {
            (format!("{path}.{name}{unit}"), Column::Place(format!("/outputs/{path}/{place}")))
        }));
    }
    columns
}

/// The kinds of quantity, the ends of the names of their columns in SI and in US units, and how they are
/// converted. A speed has one column, in mph.
const UNITS: [(Kind, &str, &str, Measure); 9] = [
    (Kind::Speed, "(m/s)", "(mph)", Measure::RoadSpeed),
    (Kind::Length, "(m)", "(ft)", Measure::Length),
    (Kind::Angle, "(rad)", "(deg)", Measure::Angle),
    (Kind::YawRate, "(rad/s)", "(deg/s)", Measure::YawRateDegrees),
    (Kind::Energy, "(J)", "(ft lb)", Measure::Energy),
    (Kind::Impulse, "(N s)", "(lb s)", Measure::Impulse),
    (Kind::MomentImpulse, "(N m s)", "(ft lb s)", Measure::MomentImpulse),
    (Kind::Force, "(N)", "(lb)", Measure::Force),
    (Kind::Time, "(s)", "(s)", Measure::Time),
];

/// The end of the name of a column in SI units; empty for a ratio.
fn unit(kind: Kind) -> String {
    let row = UNITS.iter().find(|(of, ..)| *of == kind);
    row.map_or_else(String::new, |(_, si, ..)| format!(" {si}"))
}

/// For a column whose values are converted: its name without the unit, the unit, and the quantity.
fn converted(name: &str, units: Units) -> Option<(&str, &'static str, Measure)> {
    let find = || {
        UNITS.iter().find_map(|&(_, si, us, quantity)| name.strip_suffix(si).map(|bare| (bare, us, quantity)))
    };
    match units {
        Units::Si => None,
        Units::Us => find(),
        Units::Uk => find().filter(|(_, _, quantity)| {
            matches!(quantity, Measure::RoadSpeed | Measure::Angle | Measure::YawRateDegrees)
        }),
    }
}

impl Csv {
    /// The columns of [`row`](Self::row): names that do not change, with the unit of the values in
    /// parentheses. Columns may be added.
    #[must_use]
    pub fn columns(self) -> Vec<String> {
        let named = |name: &str| match converted(name, self.units) {
            Some((bare, unit, _)) => format!("{bare}{unit}"),
            None => name.to_owned(),
        };
        columns(self.table).iter().map(|(name, _)| named(name)).collect()
    }

    /// The line with the names of the columns.
    ///
    /// # Errors
    /// [`RowError`], which no names cause.
    pub fn header(self) -> Result<String, RowError> {
        Ok(self.style.beginning().to_owned() + &self.line(&self.columns())?)
    }

    /// The line of a file under the [`header`](Self::header), or one for each law: RFC 4180, except for the
    /// plain line feed at its end. SI units and radians, or US units with speeds in mph and degrees; with UK
    /// units, speeds in mph, angles in degrees, and all else in SI. Each
    /// number is the shortest that reads back as the same; a missing value is empty.
    ///
    /// A spreadsheet runs a cell that begins with `=`, `+`, `-`, `@`, one of their full-width forms, tab,
    /// line feed or carriage return as a formula, and titles and names come from whoever wrote the file. Such
    /// a text, never a number, has an apostrophe before it: the spreadsheet shows a text, and a program can
    /// remove the apostrophe. Control characters are [shown](case::shown). [`jsonl_row`] keeps all texts as
    /// they are.
    ///
    /// # Errors
    /// [`RowError`], which no answer causes.
    pub fn row(self, row: Row<'_>) -> Result<String, RowError> {
        let value = document(row, Detail::Results);
        let rows = match self.table {
            Table::Comparisons => value.pointer("/rows").and_then(Value::as_array).map_or(1, Vec::len),
            Table::Analyses | Table::Uncertainties => 1,
        };
        (0..rows).map(|number| self.line(&self.cells(row, &value, number))).collect()
    }

    fn cells(self, row: Row<'_>, value: &Value, number: usize) -> Vec<String> {
        let seen = match row.answer {
            Ok((file, RowAnswer::Analysis(analysis))) => Some(analysis.seen(file.case.axes)),
            _ => None,
        };
        // Most places have no number of a row in them.
        let place = |place: &str| match place.contains('#') {
            true => value.pointer(&place.replace('#', &number.to_string())),
            false => value.pointer(place),
        };
        let cell = |name: &str, column: &Column| match column {
            Column::Place(at) => Some(self.cell(name, place(at)?)),
            Column::Quantity(quantity, vehicle) => {
                Some(self.cell(name, &quantity.value(seen.as_ref()?, *vehicle)?.into()))
            }
            Column::FailedShare => {
                let [samples, succeeded] =
                    ["/samples", "/succeeded"].map(|at| place(at).and_then(Value::as_f64));
                let (samples, succeeded) = (samples?, succeeded?);
                Some(self.cell(name, &((samples - succeeded) / samples).into()))
            }
            Column::Ranges => match row.answer.ok()?.0.case.ranges.len() {
                0 => None,
                1 => Some("1 range held at its central value; deltav uncertainty propagates it".to_owned()),
                ranges => Some(format!(
                    "{ranges} ranges held at their central values; deltav uncertainty propagates them"
                )),
            },
            Column::Warnings => Some(codes(value)),
        };
        columns(self.table).iter().map(|(name, column)| cell(name, column).unwrap_or_default()).collect()
    }

    /// A value of the JSON document in its column.
    fn cell(self, name: &str, value: &Value) -> String {
        match (value, converted(name, self.units)) {
            (Value::Null, _) => String::new(),
            (Value::String(text), _) => no_formula(text),
            (Value::Number(number), Some((_, _, measure))) => {
                let si = number.as_f64().unwrap_or(f64::NAN);
                self.style.number(Value::from(self.units.value(measure, si)).to_string())
            }
            (Value::Number(number), None) => self.style.number(number.to_string()),
            (other, _) => other.to_string(),
        }
    }

    fn line(self, cells: &[String]) -> Result<String, RowError> {
        let separator = u8::try_from(self.style.separator()).unwrap_or(b',');
        let mut writer = csv::WriterBuilder::new().delimiter(separator).from_writer(Vec::new());
        writer.write_record(cells)?;
        let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
        // The input was text, and so is the output.
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

fn codes(value: &Value) -> String {
    let warnings = value.get("warnings").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let codes = warnings.iter().filter_map(|warning| {
        let code = warning.get("code").and_then(Value::as_str)?;
        let vehicle = warning.get("vehicle").and_then(Value::as_u64);
        Some(vehicle.map_or_else(|| code.to_owned(), |vehicle| format!("vehicle{vehicle}.{code}")))
    });
    codes.collect::<Vec<_>>().join(" ")
}

/// One JSON document on one line: what [`json`](crate::json()), [`comparison_json`](crate::comparison_json)
/// or [`uncertainty_json`](crate::uncertainty_json) gives, with `file` first; or `file`, `error` and, if
/// there is more advice, `help`.
///
/// # Errors
/// [`RowError`], which no answer causes.
pub fn jsonl_row(row: Row<'_>) -> Result<String, RowError> {
    Ok(on_one_line(&document(row, Detail::All))?)
}

/// How much of an answer a row contains.
#[derive(Clone, Copy, Debug)]
enum Detail {
    All,
    /// Only what columns are made from.
    Results,
}

fn document(Row { file: name, answer }: Row<'_>, detail: Detail) -> Value {
    let (file, answer) = match answer {
        Ok(answer) => answer,
        Err(Refused { error, help, bytes }) => {
            let case = bytes.map(|bytes| case_file(&name.into(), bytes));
            return object! {
                "file": name,
                "error": error,
                "help"?: help,
                "program": program(),
                "case"?: case,
            };
        }
    };
    let case = &file.case;
    let answer = match (answer, detail) {
        (RowAnswer::Analysis(analysis), _) => json::document(case, analysis),
        (RowAnswer::Comparison(comparison), _) => comparison::document(case, comparison),
        (RowAnswer::Uncertainty(found), Detail::All) => uncertainty::document(case, found),
        (RowAnswer::Uncertainty(found), Detail::Results) => uncertainty::results(case, found),
    };
    followed(json!({ "file": name }), identified(file, answer))
}

/// A text that a spreadsheet shows and does not run as a formula: see [`Csv::row`].
#[must_use]
pub fn no_formula(text: &str) -> String {
    // The list of the Open Worldwide Application Security Project (OWASP, CSV Injection).
    const BEGINS_A_FORMULA: [char; 11] = ['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠'];
    let shown = shown(text);
    // `-` is the name of standard input, and a sign alone is not a formula.
    match text.starts_with(BEGINS_A_FORMULA) && text != "-" {
        true => format!("'{shown}"),
        false => shown.into_owned(),
    }
}
