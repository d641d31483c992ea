//! `deltav`: arguments, files and exit codes. All else is in the libraries.

mod arguments;

use std::fs;
use std::io::{self, ErrorKind, Read as _, Write as _};
use std::path::Path;
use std::process::ExitCode;

use analysis::{Analysis, Failure, Sweep};
use anyhow::{Context as _, Result};
use arguments::{Arguments, Command, Format, SensitivityArguments, UnitSystem};
use case::{Case, CaseFile};
use clap::Parser as _;
use report::Units;

/// The case is well formed, but no answer exists.
const NO_ANSWER: u8 = 1;
/// The case file or the command line is wrong.
const WRONG_INPUT: u8 = 2;

fn main() -> ExitCode {
    let result = match Command::parse() {
        Command::Reconstruct(arguments) => report_analysis(&arguments, analysis::reconstruct),
        Command::Impact(arguments) => report_analysis(&arguments, analysis::impact),
        Command::Crush(arguments) => report_analysis(&arguments, analysis::crush),
        Command::Compare(arguments) => report_comparison(&arguments),
        Command::Sensitivity(arguments) => report_sensitivity(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Diagnostics render themselves with the word "error" and their place in the file.
            let (lead, status) = match error.downcast_ref::<Failure>() {
                Some(Failure::Case(_)) => ("", WRONG_INPUT),
                Some(_) => ("error: ", NO_ANSWER),
                None => ("error: ", WRONG_INPUT),
            };
            // Nothing is left to be done where standard error is closed.
            let _ = writeln!(io::stderr(), "{lead}{error:#}");
            ExitCode::from(status)
        }
    }
}

fn report_analysis(arguments: &Arguments, analyse: fn(&CaseFile) -> Result<Analysis, Failure>) -> Result<()> {
    let file = case_file(arguments)?;
    let analysis = analyse(&file)?;
    let output = match arguments.format {
        Format::Text => report::text(&file.case, &analysis, units(arguments, &file)),
        Format::Json => report::json(&file.case, &analysis)?,
    };
    write(arguments.output.as_deref(), &output)
}

fn report_comparison(arguments: &Arguments) -> Result<()> {
    let file = case_file(arguments)?;
    let comparison = analysis::compare(&file)?;
    let output = match arguments.format {
        Format::Text => report::comparison_text(&file.case, &comparison, units(arguments, &file)),
        Format::Json => report::comparison_json(&file.case, &comparison)?,
    };
    write(arguments.output.as_deref(), &output)
}

fn report_sensitivity(
    SensitivityArguments { arguments, pdof_step, pdof_steps }: &SensitivityArguments,
) -> Result<()> {
    let file = case_file(arguments)?;
    let sweep = Sweep { step: pdof_step.to_radians(), steps: *pdof_steps };
    let sensitivity = analysis::sensitivity(&file, sweep)?;
    let output = match arguments.format {
        Format::Text => report::sensitivity_text(&file.case, &sensitivity, units(arguments, &file)),
        Format::Json => report::sensitivity_json(&file.case, &sensitivity)?,
    };
    write(arguments.output.as_deref(), &output)
}

fn case_file(arguments: &Arguments) -> Result<CaseFile> {
    let (name, text) = read(&arguments.case)?;
    Ok(Case::parse(&name, &text).map_err(Failure::from)?)
}

fn units(arguments: &Arguments, file: &CaseFile) -> Units {
    match arguments.units {
        Some(UnitSystem::Si) => Units::Si,
        Some(UnitSystem::Us) => Units::Us,
        None => Units::of_case(&file.case),
    }
}

/// The name to show in messages, and the text.
fn read(path: &Path) -> Result<(String, String)> {
    let (name, bytes) = if path == Path::new("-") {
        let mut bytes = Vec::new();
        io::stdin().read_to_end(&mut bytes).context("cannot read the case from standard input")?;
        ("standard input".to_owned(), bytes)
    } else {
        let name = path.display().to_string();
        let bytes = fs::read(path).with_context(|| format!("cannot read the case file {name}"))?;
        (name, bytes)
    };
    let text = String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        anyhow::anyhow!("{name} is not a text file in UTF-8: byte {place} is the first that does not fit; save it as UTF-8")
    })?;
    Ok((name, text))
}

fn write(path: Option<&Path>, output: &str) -> Result<()> {
    match path {
        Some(path) => {
            fs::write(path, output).with_context(|| format!("cannot write the output to {}", path.display()))
        }
        None => match io::stdout().write_all(output.as_bytes()) {
            // Whoever reads has read enough, as `head` does.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            written => written.context("cannot write to standard output"),
        },
    }
}
