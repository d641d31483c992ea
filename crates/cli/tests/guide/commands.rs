//! Every command and option that the text names is one of the program's: its own command line reads it.

use clap::error::ErrorKind;
use clap::{CommandFactory as _, Parser as _};

use crate::guide::prose::{pages, root};

#[path = "../../src/arguments.rs"]
#[allow(dead_code, reason = "the arguments are read, not used")]
mod arguments;

const FOLDERS: [&str; 4] = ["docs", "docs/guide", "crates/report", "benches"];

/// What a word in capitals stands for.
fn meant(word: &str) -> Vec<&str> {
    match word.trim_end_matches('…') {
        "CASE" => vec!["case.toml"],
        "TOPIC" | "KEY" | "CODE" => vec!["heading"],
        "SHELL" => vec!["bash", "zsh", "fish"],
        "FILE" => vec!["result.json"],
        "DIR" => vec!["plots"],
        "COMMAND" => vec![
            "new",
            "reconstruct",
            "impact",
            "motion",
            "crush",
            "check",
            "compare",
            "sensitivity",
            "table",
            "uncertainty",
            "estimate",
            "draw",
            "validate",
            "explain",
            "schema",
            "completions",
            "man",
        ],
        _ if word.contains('|') => word.split('|').collect(),
        _ => vec![word],
    }
}

/// The words as a shell parts them, where double quotes keep several together.
fn words(code: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (index, part) in code.split('"').enumerate() {
        if index % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

/// Every command line that this one stands for.
fn command_lines(code: &str) -> Vec<Vec<String>> {
    let mut lines = vec![Vec::new()];
    for word in words(code) {
        let several: Vec<_> = meant(&word).into_iter().map(str::to_owned).collect();
        let longer = |line: Vec<String>| {
            several.iter().map(move |one| [&line[..], std::slice::from_ref(one)].concat())
        };
        lines = lines.into_iter().flat_map(longer).collect();
    }
    lines
}

/// Whether the program would read it. Text may name a command without what it needs, such as its file.
fn read(line: &[String]) -> Result<(), String> {
    match arguments::Command::try_parse_from(line) {
        Ok(_) => Ok(()),
        Err(error) => match error.kind() {
            ErrorKind::MissingRequiredArgument | ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => Ok(()),
            _ => Err(error.to_string()),
        },
    }
}

#[test]
fn every_command_in_the_text_is_read() {
    let mut count = 0;
    for page in pages(&FOLDERS) {
        let mut commands: Vec<String> =
            page.inline_code().into_iter().filter(|code| code.starts_with("deltav ")).collect();
        // Blocks that are not run: how to run it without installing it.
        for line in page.fenced("text") {
            if let Some((_, arguments)) = line.trim_start_matches("$ ").split_once("cargo run --release -- ")
            {
                commands.push(format!("deltav {arguments}"));
            }
        }
        for code in commands {
            for line in command_lines(&code) {
                read(&line).unwrap_or_else(|error| panic!("{}: `{code}`: {error}", page.name));
                for file in line.iter().filter(|word| word.starts_with("fixtures/") && !word.contains('*')) {
                    // NN is the number of a staged collision.
                    let exists = root().join(file.replace("NN", "01")).exists();
                    assert!(exists, "{}: `{code}`: there is no {file}", page.name);
                }
            }
            count += 1;
        }
    }
    assert!(count > 60, "the text has only {count} commands");
}

/// Whether the command has an option of this name, such as `--units` or `-o`.
fn has_option(command: &clap::Command, name: &str) -> bool {
    command.get_arguments().any(|argument| match name.strip_prefix("--") {
        Some(long) => argument.get_long() == Some(long),
        None => argument.get_short().is_some_and(|short| name == format!("-{short}")),
    })
}

/// An option that stands by itself, with a value or without, is one of some command.
#[test]
fn every_option_in_the_text_is_read() {
    let mut command = arguments::Command::command();
    command.build();
    let mut count = 0;
    for page in pages(&FOLDERS) {
        let is_option =
            |code: &String| code.strip_prefix('-').is_some_and(|rest| !rest.starts_with(char::is_numeric));
        for code in page.inline_code().into_iter().filter(is_option) {
            for options in command_lines(&code) {
                let of_some_command = command.get_subcommands().any(|one| {
                    let line = [&["deltav".to_owned(), one.get_name().to_owned()], &options[..]].concat();
                    // An option may be named without its value.
                    read(&line).is_ok() || matches!(&options[..], [name] if has_option(one, name))
                });
                assert!(of_some_command, "{}: no command has `{code}`", page.name);
            }
            count += 1;
        }
    }
    assert!(count > 20, "the text has only {count} options");
}

/// So are the examples that `--help` gives.
#[test]
fn every_example_of_the_help_is_read() {
    let mut count = 0;
    for command in arguments::Command::command().get_subcommands() {
        let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        for example in help.lines().map(str::trim).filter(|line| line.starts_with("deltav ")) {
            let before_the_shell = example.split(" > ").next().unwrap();
            read(&words(before_the_shell)).unwrap_or_else(|error| panic!("{example}: {error}"));
            count += 1;
        }
    }
    assert!(count > 20, "the help has only {count} examples");
}

#[test]
fn what_the_program_does_not_have_is_refused() {
    for wrong in [
        "deltav reconstructs case.toml",
        "deltav draw case.toml --what scenery",
        "deltav check a.toml b.toml",
    ] {
        assert!(command_lines(wrong).iter().any(|line| read(line).is_err()), "{wrong}");
    }
    assert_eq!(command_lines("deltav draw CASE --what scene|damage").len(), 2);
    assert_eq!(words("deltav explain \"impulse ratio\""), ["deltav", "explain", "impulse ratio"]);
    let command = arguments::Command::command();
    let reconstruct = command.find_subcommand("reconstruct").unwrap();
    assert_eq!(
        ["--units", "-o", "--unit", "-u", "units", "--o"].map(|name| has_option(reconstruct, name)),
        [true, true, false, false, false, false]
    );
}

/// The placeholder of a command stands for each there is.
#[test]
fn every_command_is_known() {
    let names: Vec<String> = arguments::Command::command()
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    assert_eq!(meant("COMMAND"), names);
}
