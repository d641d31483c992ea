//! The presentation of an answer: its format, its units, and the message if there is none.

use std::path::Path;

use analysis::Failure;
use anyhow::Result;
use case::CaseFile;
use report::{Document, Units};
use requests::Unanswered;

use crate::arguments::Format;
use crate::files::write;
use crate::terminal;

/// Writes a document, or its data as JSON, to the destination in the arguments; makes only the one that is
/// written.
pub(crate) fn present<E>(
    format: Format,
    output: Option<&Path>,
    document: impl FnOnce() -> Result<Document>,
    json: impl FnOnce() -> Result<String, E>,
) -> Result<()>
where
    anyhow::Error: From<E>,
{
    match format {
        Format::Text if output.is_none() => terminal::print(&document()?),
        Format::Text => write(output, document()?.text()),
        Format::Json => write(output, json()?),
        Format::Html => write(output, document()?.html()),
        Format::Markdown => write(output, document()?.markdown()),
    }
}

pub(crate) fn units(asked: Option<Units>, file: &CaseFile) -> Units {
    asked.unwrap_or_else(|| Units::of_case(&file.case))
}

/// Why there is no answer, or not the whole one, though the input is well-formed.
#[derive(Debug)]
pub(crate) struct NoAnswer(pub(crate) String);

impl std::fmt::Display for NoAnswer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NoAnswer {}

/// The answer, or a failure in the units of the reader; faults of the file are reported in its own units.
pub(crate) fn answered<T>(answer: Result<T, Failure>, file: &CaseFile, units: Units) -> Result<T> {
    answer.map_err(|failure| match failure {
        Failure::Case(faults) => file.diagnostics(&faults, &report::PROGRAM).into(),
        Failure::Ranges(_) => failure.into(),
        failure => NoAnswer(report::no_answer(&failure, units)).into(),
    })
}

/// The same for an answer to a request.
pub(crate) fn found<T>(answer: Result<T, Unanswered>, file: &CaseFile, units: Units) -> Result<T> {
    answer.or_else(|refused| match refused {
        Unanswered::Failure(failure) => answered(Err(failure), file, units),
        question @ Unanswered::Question { .. } => anyhow::bail!("--above {question}"),
    })
}
