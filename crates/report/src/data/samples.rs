//! Samples as CSV.

use std::io::{self, Write};

use ::uncertainty::SUCCEEDED;
use analysis::{Reason, Uncertainty};

use super::csv::CsvStyle;
use crate::outputs::reason_name;

/// Writes a line for each sample: its number, why it has no answer, its uncertain inputs and its outputs, in
/// SI units and radians. Missing outputs are empty. Numbers are the shortest that read back as the same, in
/// the style of the spreadsheet. Samples that a large run did not keep are computed again.
///
/// # Errors
/// If `out` cannot be written to.
pub fn write_samples(uncertainty: &Uncertainty, style: CsvStyle, out: &mut dyn Write) -> io::Result<()> {
    let next = style.separator();
    let inputs = &uncertainty.inputs;
    write!(out, "{}sample{next}failed", style.beginning())?;
    for input in inputs {
        write!(out, "{next}{}", input.input.path)?;
    }
    for output in &uncertainty.outputs {
        write!(out, "{next}{}", output.output.path())?;
    }
    writeln!(out)?;
    let mut sample = 0;
    uncertainty.for_each_block(|block| {
        for (lane, &code) in block.reasons.iter().enumerate() {
            sample += 1;
            let failed = if code == SUCCEEDED { "" } else { reason_name(Reason::of_code(code)) };
            write!(out, "{sample}{next}{failed}")?;
            for (input, column) in inputs.iter().zip(block.inputs) {
                let value = column[lane] * input.input.factor();
                write!(out, "{next}{}", style.number(value.to_string()))?;
            }
            for column in block.outputs {
                if code == SUCCEEDED {
                    write!(out, "{next}{}", style.number(column[lane].to_string()))?;
                } else {
                    write!(out, "{next}")?;
                }
            }
            writeln!(out)?;
        }
        Ok(())
    })
}
