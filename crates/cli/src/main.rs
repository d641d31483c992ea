//! `deltav`: arguments, files and exit codes. All else is in the libraries.

mod arguments;
mod asked;
mod batch;
mod cases;
mod ciss;
mod draw;
mod explain;
mod files;
mod live;
mod long_texts;
mod new;
mod outputs;
mod pages;
mod pictures;
mod present;
mod progress;
mod sink;
mod table;
mod terminal;
mod threads;
mod validate;

use std::io::{self, ErrorKind, Write as _};
use std::process::ExitCode;

use anyhow::Result;
use arguments::Command;
use case::Diagnostics;
use present::NoAnswer;
use report::DrawingError;

/// The case is well formed, but no answer exists; or a claim of the validation fails.
const NO_ANSWER: u8 = 1;
/// The case file or the command line is wrong.
const WRONG_INPUT: u8 = 2;

fn main() -> ExitCode {
    let command = match arguments::parse(std::env::args_os()) {
        Ok(command) => command,
        Err(error) => return not_a_command(&error),
    };
    match outputs::check(&command).and_then(|()| run(command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // If standard error is closed, nothing more can be done.
            let _ = writeln!(io::stderr(), "{}", message(&error));
            ExitCode::from(status(&error))
        }
    }
}

/// Prints the help or the version that was asked for, or what is wrong with the command line.
fn not_a_command(error: &clap::Error) -> ExitCode {
    if error.use_stderr() {
        // The message quotes the command line, which a script may have made of the name of a file.
        let shown = std::env::args_os().map(|argument| case::shown(&argument.to_string_lossy()).into_owned());
        let again = arguments::parse(shown).err();
        // If standard error is closed, nothing more can be done.
        let _ = again.as_ref().unwrap_or(error).print();
        return ExitCode::from(WRONG_INPUT);
    }
    match error.print() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let _ = writeln!(io::stderr(), "error: cannot write to standard output: {error}");
            ExitCode::from(WRONG_INPUT)
        }
        _ => ExitCode::SUCCESS,
    }
}

fn run(command: Command) -> Result<()> {
    match command {
        Command::New(arguments) => new::new(&arguments),
        Command::Question(question) => asked::report(question.into()),
        Command::Table(arguments) => table::table(&arguments),
        Command::Draw(arguments) => draw::draw(&arguments),
        Command::Validate(arguments) => validate::validate(&arguments),
        Command::Explain(arguments) => explain::explain(&arguments),
        Command::Schema(arguments) => files::write(arguments.output.file(), case::json_schema()),
        Command::Completions(arguments) => pages::completions(arguments.shell),
        Command::Man(arguments) => pages::manual(arguments.output_dir.as_deref()),
    }
}

/// The message of an error: each cause once, without characters that act on the terminal.
fn message(error: &anyhow::Error) -> String {
    // Diagnostics render themselves with the word "error" and their place in the file.
    if error.is::<Diagnostics>() {
        return format!("{error:#}");
    }
    let mut message = String::from("error");
    for cause in error.chain().map(ToString::to_string) {
        // Some libraries quote the cause that they also name.
        if !message.ends_with(&cause) {
            message.push_str(": ");
            message.push_str(&cause);
        }
    }
    // A message may quote the command line or a file, and its lines are the program's own.
    case::shown_lines(&message).trim_end_matches('\n').to_owned()
}

fn status(error: &anyhow::Error) -> u8 {
    if error.is::<NoAnswer>() || error.is::<DrawingError>() { NO_ANSWER } else { WRONG_INPUT }
}

#[cfg(test)]
mod tests {
    use std::io;

    use super::message;

    #[test]
    fn a_cause_is_said_once_and_acts_on_nothing() {
        let full = || io::Error::other("No space left");
        let quoted =
            anyhow::Error::new(full()).context("External: No space left").context("cannot write to x");
        assert_eq!(message(&quoted), "error: cannot write to x: External: No space left");
        let two = anyhow::Error::new(full()).context("cannot write\n  to \u{1b}[31mx");
        assert_eq!(message(&two), "error: cannot write\n  to ␛[31mx: No space left");
    }
}
