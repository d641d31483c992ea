//! The case files of a command: a row for each, or the one to report on.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use report::{Csv, Units};
use requests::Request;

use crate::arguments::{self, Arguments, CasesArguments};
use crate::batch::{self, Rows};
use crate::files::named;
use crate::threads::pool;

/// Writes a row for each case if rows are requested; else returns the arguments for the report on one.
pub(crate) fn of_cases(arguments: CasesArguments, request: &Request) -> Result<Option<Arguments>> {
    let CasesArguments { mut cases, format, units, threads, csv_style, output } = arguments;
    let Some(table) = request.rows() else {
        let format = format.unwrap_or(arguments::Format::Text);
        return Ok(cases.pop().map(|case| Arguments { case, format, units, output }));
    };
    let mut cases = with_folders(cases)?;
    let format = match format {
        Ok(format) => match (cases.pop(), cases.len()) {
            (Some(case), 0) => return Ok(Some(Arguments { case, format, units, output })),
            (_, others) => anyhow::bail!(
                "{} case files are given, but a report covers only one; use --format csv or --format jsonl for a row each",
                others + 1
            ),
        },
        // Rows of several cases have one header: its units are not those of a case.
        Err(arguments::Rows::Csv) => {
            let units = units.unwrap_or(Units::Si);
            Rows::Csv(Csv { table, units, style: csv_style })
        }
        Err(arguments::Rows::Jsonl) => Rows::Jsonl,
    };
    batch::write(&cases, (&request.of_row(), format), &pool(threads)?, output.file())?;
    Ok(None)
}

/// The case files, with those of each folder in the order of their names.
fn with_folders(paths: Vec<PathBuf>) -> Result<Vec<PathBuf>> {
    let mut cases = Vec::new();
    for path in paths {
        if !path.is_dir() {
            cases.push(path);
            continue;
        }
        let cannot = || format!("cannot read the folder {}", named(&path));
        let mut inside = Vec::new();
        for entry in fs::read_dir(&path).with_context(cannot)? {
            inside.push(entry.with_context(cannot)?.path());
        }
        inside.retain(|path| path.extension().is_some_and(|ending| ending == "toml") && !path.is_dir());
        if inside.is_empty() {
            anyhow::bail!("{} is a folder without .toml files: name the case files", named(&path));
        }
        inside.sort();
        cases.append(&mut inside);
    }
    Ok(cases)
}
