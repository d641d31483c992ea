//! Documents on standard output: at the width of a terminal and with its headings in bold where there is one,
//! plain elsewhere.

use std::io::{self, ErrorKind, IsTerminal as _, Write as _};

use anstream::{AutoStream, ColorChoice};
use anyhow::{Context as _, Result};
use report::Document;

/// Prints the document as text for the columns of the terminal, if standard output is one. `NO_COLOR` and
/// `CLICOLOR` are respected.
pub(crate) fn print(document: &Document) -> Result<()> {
    let stdout = io::stdout();
    let columns = terminal_size::terminal_size_of(&stdout).map(|(width, _)| usize::from(width.0));
    let choice = if stdout.is_terminal() { AutoStream::choice(&stdout) } else { ColorChoice::Never };
    let text = match columns {
        Some(columns) if choice != ColorChoice::Never => document.terminal(columns),
        Some(columns) => document.text_within(columns),
        None => document.text(),
    };
    match AutoStream::new(stdout.lock(), choice).write_all(text.as_bytes()) {
        // The reader has read enough, as `head` does.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.context("cannot write to standard output"),
    }
}
