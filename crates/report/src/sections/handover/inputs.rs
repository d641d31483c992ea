//! The inputs: every number of the file in the file's own unit and in SI, its words, and what is assumed.

use analysis::{Analysis, Assumption};
use case::{CaseFile, Input, list_of};

use crate::document::{Column, NONE, Table, Width};
use crate::sections::judgement::{ASSUMED, CHOICES, NUMBERS};
use crate::steps::digits;
use crate::understood;
use crate::units::Units;

/// The tables that have rows.
pub(super) fn tables(file: &CaseFile, analysis: &Analysis, units: Units) -> Vec<Table> {
    let pairs = |title: &str, [key, value]: [&str; 2], rows: Vec<(String, String)>| {
        let mut table =
            Table::new(title).columns([key, value].map(|name| Column::words(name, Width::Fit(0))));
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
        pairs(ASSUMED, ["key that would give it", "assumed"], assumed),
    ];
    tables.retain(|table| !table.rows.is_empty());
    tables
}

/// Whether the analysis depends on the assumption: one of damage alone has no impact, a forward one seeks no
/// speed, and not every vehicle is followed to rest.
fn is_of(assumption: &Assumption, analysis: &Analysis) -> bool {
    match assumption {
        Assumption::SpeedUnused { .. } => analysis.is_reconstruction(),
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

/// The numbers; the stations of a profile share a row, as in the file.
fn numbers(file: &CaseFile) -> Table {
    let columns = ["key in the case file", "as given", "in SI units"];
    let mut table = Table::new(NUMBERS).columns(columns.map(|name| Column::words(name, Width::Fit(0))));
    let mut ranges = file.case.ranges.iter().peekable();
    let inputs = understood::numbers(&file.case);
    for row in
        inputs.chunk_by(|one, next| list_of(&one.path).is_some() && list_of(&one.path) == list_of(&next.path))
    {
        let [first, ..] = row else { continue };
        let path = list_of(&first.path).filter(|_| first.path.ends_with("[1]")).unwrap_or(&first.path);
        let spreads: Vec<String> = row
            .iter()
            .map(|input| ranges.next_if(|range| range.path == input.path))
            .map(|range| range.map_or_else(|| NONE.to_owned(), understood::spread))
            .collect();
        let joined = |said: fn(&Input) -> String| row.iter().map(said).collect::<Vec<_>>().join(", ");
        let mut own = joined(|input| understood::amount(input.number, input.unit));
        match spreads.as_slice() {
            spreads if spreads.iter().all(|spread| spread == NONE) => {}
            [spread] => own.push_str(&format!("; {spread}")),
            [first, rest @ ..] if rest.iter().all(|spread| spread == first) => {
                own.push_str(&format!("; each {first}"));
            }
            spreads => own.push_str(&format!("; {}", spreads.join(", "))),
        }
        table.row([path.to_owned(), own, joined(si)]);
    }
    table
}

/// With as many digits as in the steps, so that the same number looks the same.
fn si(input: &Input) -> String {
    match input.unit {
        Some(unit) => format!("{} {}", digits(input.si()).replace('−', "-"), unit.dimension().si_unit()),
        None => input.number.to_string(),
    }
}
