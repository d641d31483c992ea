//! The inputs: every number of the file in the file's own unit and in SI, its words, and what is assumed.

use analysis::{Analysis, Assumption};
use case::{CaseFile, Input};

use crate::document::{Column, Table, Width};
use crate::sections::judgement::{ASSUMED, CHOICES, NUMBERS};
use crate::steps::digits;
use crate::understood;
use crate::units::Units;

/// The tables that have rows.
pub(super) fn tables(file: &CaseFile, analysis: &Analysis, units: Units) -> Vec<Table> {
    let pairs = |title: &str, [key, value]: [&str; 2], rows: Vec<(String, String)>| {
        let mut table = Table::new(title, [key, value].map(|name| Column::words(name, Width::Fit(0))));
        rows.into_iter().for_each(|(key, value)| table.row([key, value]));
        table
    };
    let assumed = analysis::assumptions(&file.case)
        .iter()
        .filter(|assumption| is_of(assumption, analysis))
        .map(|assumption| (assumption.key(), understood::message(assumption, units)))
        .collect();
    let mut tables = vec![
        numbers(file),
        pairs(CHOICES, ["key in the case file", "as given"], understood::choices(&file.case)),
        pairs(ASSUMED, ["key that would say it", "assumed"], assumed),
    ];
    tables.retain(|table| !table.rows.is_empty());
    tables
}

/// Whether the analysis depends on the assumption: one of damage alone has no impact, a forward one seeks no
/// speed, and not every vehicle is followed to rest.
fn is_of(assumption: &Assumption, analysis: &Analysis) -> bool {
    match assumption {
        Assumption::SpeedUnused { .. } => analysis.found.is_some() || analysis.both.is_some(),
        Assumption::ImpactAtOrigin | Assumption::LevelGround => analysis.travel.iter().any(Option::is_some),
        Assumption::Axle { vehicle, .. } | Assumption::StraightWheels { vehicle } => {
            analysis.travel[vehicle.index()].is_some()
        }
        Assumption::SkidFriction { vehicle, .. } => analysis.skids[vehicle.index()].is_some(),
        Assumption::YawRate { .. }
        | Assumption::ContactPlaced { .. }
        | Assumption::BrachLaw
        | Assumption::NoMoment => analysis.impact.is_some(),
        _ => true,
    }
}

/// A row of the numbers: the stations of a profile share one, as in the file.
struct Row {
    path: String,
    own: Vec<String>,
    /// The range of each number, empty without one.
    spreads: Vec<String>,
    si: Vec<String>,
}

impl Row {
    fn cells(self) -> [String; 3] {
        let mut own = self.own.join(", ");
        let known: Vec<&str> =
            self.spreads.iter().map(|spread| if spread.is_empty() { "–" } else { spread }).collect();
        match known.as_slice() {
            spreads if spreads.iter().all(|&spread| spread == "–") => {}
            [spread] => own.push_str(&format!("; {spread}")),
            [first, rest @ ..] if rest.iter().all(|spread| spread == first) => {
                own.push_str(&format!("; each {first}"));
            }
            spreads => own.push_str(&format!("; {}", spreads.join(", "))),
        }
        [self.path, own, self.si.join(", ")]
    }
}

fn numbers(file: &CaseFile) -> Table {
    let mut ranges = file.case.ranges.iter().peekable();
    let mut rows: Vec<Row> = Vec::new();
    for input in file.case.inputs() {
        let spread =
            ranges.next_if(|range| range.path == input.path).map(understood::spread).unwrap_or_default();
        let (path, first) = match input.path.strip_suffix("[1]") {
            Some(list) => (list.to_owned(), true),
            None => (input.path.split('[').next().unwrap_or_default().to_owned(), !input.path.ends_with(']')),
        };
        match rows.last_mut() {
            Some(row) if !first && row.path == path => {
                row.own.push(own(&input));
                row.spreads.push(spread);
                row.si.push(si(&input));
            }
            _ => {
                let path = if first { path } else { input.path.clone() };
                rows.push(Row { path, own: vec![own(&input)], spreads: vec![spread], si: vec![si(&input)] });
            }
        }
    }
    let columns = ["key in the case file", "as given", "in SI units"];
    let mut table = Table::new(NUMBERS, columns.map(|name| Column::words(name, Width::Fit(0))));
    rows.into_iter().for_each(|row| table.row(row.cells()));
    table
}

fn own(input: &Input) -> String {
    match input.unit {
        Some(unit) => format!("{} {unit}", input.number),
        None => input.number.to_string(),
    }
}

/// With the digits of the steps, so that the same number looks the same.
fn si(input: &Input) -> String {
    match input.unit {
        Some(unit) => format!("{} {}", digits(input.si()).replace('−', "-"), unit.dimension().si_unit()),
        None => input.number.to_string(),
    }
}
