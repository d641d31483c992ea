//! The inputs: every number of the file in the file's own unit and in SI.

use case::{CaseFile, Input};

use super::Table;
use crate::units::significant;

pub(super) fn table(file: &CaseFile) -> Table {
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
        caption: "Inputs as understood",
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

/// Six digits are more than any input has.
fn si(input: &Input) -> String {
    match input.unit {
        Some(unit) => format!("{} {}", significant(input.si(), 6), unit.dimension().si_unit()),
        None => input.number.to_string(),
    }
}
