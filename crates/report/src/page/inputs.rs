//! The inputs: every number of the file in the file's own unit and in SI, what it says in words, and what is assumed.

use analysis::{Analysis, Assumption};
use case::{CaseFile, Input};

use super::Table;
use crate::judgement::{self, ASSUMED, CHOICES};
use crate::steps::digits;
use crate::units::Units;

/// Those that have rows.
pub(super) fn tables(file: &CaseFile, analysis: &Analysis, units: Units) -> Vec<Table> {
    let pairs = |caption, header: [&str; 2], rows: Vec<(String, String)>| Table {
        caption,
        header: header.map(str::to_owned).to_vec(),
        rows: rows.into_iter().map(|(key, value)| vec![key, value]).collect(),
    };
    let assumed = analysis::assumptions(file)
        .iter()
        .filter(|assumption| is_of(assumption, analysis))
        .map(|assumption| (assumption.key(), judgement::message(assumption, units)))
        .collect();
    let mut tables = vec![
        numbers(file),
        pairs(CHOICES, ["key in the case file", "as given"], judgement::choices(&file.case)),
        pairs(ASSUMED, ["key that would say it", "assumed"], assumed),
    ];
    tables.retain(|table| !table.rows.is_empty());
    tables
}

/// Whether the analysis rests on the assumption: one of damage alone has no impact, and a forward one seeks no speed.
fn is_of(assumption: &Assumption, analysis: &Analysis) -> bool {
    match assumption {
        Assumption::SpeedUnused { .. } => analysis.found.is_some(),
        Assumption::YawRate { .. } | Assumption::BrachLaw | Assumption::NoMoment => analysis.impact.is_some(),
        _ => true,
    }
}

fn numbers(file: &CaseFile) -> Table {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for input in file.case.inputs() {
        // The stations of a profile stand in one row, as in the file.
        let (path, first) = match input.path.strip_suffix("[1]") {
            Some(list) => (list.to_owned(), true),
            None => (input.path.split('[').next().unwrap_or_default().to_owned(), !input.path.ends_with(']')),
        };
        match rows.last_mut() {
            Some(row) if !first && row.first() == Some(&path) => {
                for (cell, more) in row.iter_mut().skip(1).zip([own(&input), si(&input)]) {
                    cell.push_str(", ");
                    cell.push_str(&more);
                }
            }
            _ => {
                let path = if first { path } else { input.path.clone() };
                rows.push(vec![path, own(&input), si(&input)]);
            }
        }
    }
    Table {
        caption: "Numbers as understood",
        header: ["key in the case file", "as given", "in SI units"].map(str::to_owned).to_vec(),
        rows,
    }
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
