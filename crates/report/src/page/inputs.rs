//! The inputs: every number of the file in the file's own unit and in SI.

use case::{CaseFile, Input};

use super::Table;
use crate::units::significant;

pub(super) fn table(file: &CaseFile) -> Table {
    let rows =
        file.case.inputs().iter().map(|input| vec![input.path.clone(), own(input), si(input)]).collect();
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
