//! Text on standard output: at the width of a terminal and with its headings in bold where there is one, plain elsewhere.

use std::io::{self, ErrorKind, IsTerminal as _, Write as _};

use anstream::{AutoStream, ColorChoice};
use anyhow::{Context as _, Result};

/// Prints the text that is made for the columns of the terminal, `None` where standard output is none. `NO_COLOR` and `CLICOLOR` are respected.
pub(crate) fn print(text: impl FnOnce(Option<usize>) -> String) -> Result<()> {
    let stdout = io::stdout();
    let columns = terminal_size::terminal_size_of(&stdout).map(|(width, _)| usize::from(width.0));
    let text = text(columns);
    let choice = if stdout.is_terminal() { AutoStream::choice(&stdout) } else { ColorChoice::Never };
    let styled = if choice == ColorChoice::Never { text } else { styled(&text) };
    match AutoStream::new(stdout.lock(), choice).write_all(styled.as_bytes()) {
        // Whoever reads has read enough, as `head` does.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.context("cannot write to standard output"),
    }
}

/// Headings, which a rule follows, and the answer in bold, warnings in yellow.
fn styled(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let mut styled = String::new();
    for (i, line) in lines.iter().enumerate() {
        let is_heading = lines.get(i + 1).is_some_and(|next| next.starts_with('─'));
        let code = if is_heading || line.starts_with("Speed of vehicle") {
            "1"
        } else if line.starts_with("warning [") || line.ends_with(", at the end.") {
            "33"
        } else {
            ""
        };
        if code.is_empty() {
            styled.push_str(line);
        } else {
            styled.push_str(&format!("\x1b[{code}m{line}\x1b[0m"));
        }
        styled.push('\n');
    }
    styled
}

#[cfg(test)]
mod tests {
    use super::styled;

    #[test]
    fn headings_the_answer_and_warnings_stand_out() {
        let text = "Title\n\nSpeed of vehicle 1: 10 m/s\nplain\n2 warnings, at the end.\n\nImpact   along n\n────\nrow\nwarning [code]: text\n";
        let expected = "Title\n\n\x1b[1mSpeed of vehicle 1: 10 m/s\x1b[0m\nplain\n\x1b[33m2 warnings, at the end.\x1b[0m\n\n\x1b[1mImpact   along n\x1b[0m\n────\nrow\n\
                        \x1b[33mwarning [code]: text\x1b[0m\n";
        assert_eq!(styled(text), expected);
    }
}
