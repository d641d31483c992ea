//! Samples as CSV.

use std::io::{self, Write};

use ::uncertainty::{LANES, SUCCEEDED, Sampler};
use analysis::{Reason, Uncertainty};

use super::csv::CsvStyle;
use crate::outputs::reason_name;

/// Writes a line for each sample: its number, why it has no answer, its uncertain inputs and its outputs, in
/// SI units and radians. Outputs that there are not are empty. Numbers are the shortest that read back as the
/// same, in the style of the spreadsheet.
///
/// # Errors
/// Where `out` cannot be written to.
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
    let distributions: Vec<_> = inputs.iter().map(|input| input.distribution).collect();
    let sampler = Sampler::new(&distributions, &uncertainty.settings).map_err(io::Error::other)?;
    let mut block = vec![[0.0; LANES]; inputs.len()];
    let (columns, reasons) = (uncertainty.propagation.columns(), uncertainty.propagation.reasons());
    for (number, reasons) in (0..).zip(reasons.chunks(LANES)) {
        sampler.fill(number, &mut block);
        let first = usize::try_from(number).unwrap_or(usize::MAX).saturating_mul(LANES);
        for (lane, &code) in reasons.iter().enumerate() {
            let sample = first + lane;
            let failed = if code == SUCCEEDED { "" } else { reason_name(Reason::of_code(code)) };
            write!(out, "{}{next}{failed}", sample + 1)?;
            for (input, column) in inputs.iter().zip(&block) {
                let value = column[lane] * input.input.factor();
                write!(out, "{next}{}", style.number(value.to_string()))?;
            }
            // Behind those that were asked for there may be others.
            for column in columns.iter().take(uncertainty.outputs.len()) {
                match column[sample] {
                    value if value.is_nan() => write!(out, "{next}")?,
                    value => write!(out, "{next}{}", style.number(value.to_string()))?,
                }
            }
            writeln!(out)?;
        }
    }
    Ok(())
}
