//! Every command and option that the text names is one of the program's: its own command line reads it.

use clap::error::ErrorKind;
use clap::{CommandFactory as _, Parser as _};

use crate::guide::prose::{pages, root};

#[path = "../../src/arguments.rs"]
#[allow(dead_code, reason = "the arguments are read, not used")]
mod arguments;

const FOLDERS: [&str; 4] = ["docs", "docs/guide", "crates/report", "benches"];

/// The meaning of a word in capitals.
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
            "recorder",
            "sensitivity",
            "uncertainty",
            "estimate",
            "avoid",
            "table",
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

/// The words as a shell separates them, with several kept together by double quotes.
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

/// Whether the program would read it. Text may name a command without its required arguments, such as its
/// file.
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
            if let Some((_, arguments)) = line.trim_start_matches("$ ").split_once("cargo run -- ") {
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

/// The placeholder of a command stands for each of the commands.
#[test]
fn every_command_is_known() {
    let names: Vec<String> = arguments::Command::command()
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    assert_eq!(meant("COMMAND"), names);
}

/// What the program prints for this line on a screen of 100 columns.
fn printed(line: &[&str]) -> String {
    arguments::command().term_width(100).try_get_matches_from(line).unwrap_err().to_string()
}

/// The help of the program, and that of each command.
fn helps() -> Vec<(String, String)> {
    let command = arguments::command();
    let names = command.get_subcommands().map(|one| one.get_name().to_owned());
    let of_commands = names.map(|name| {
        let help = printed(&["deltav", &name, "--help"]);
        (name, help)
    });
    std::iter::once(("deltav".to_owned(), printed(&["deltav", "--help"]))).chain(of_commands).collect()
}

#[test]
fn every_help_fits_a_screen() {
    for (name, help) in helps() {
        let lines = help.trim_end().lines().count();
        assert!(lines <= 40, "{name} --help has {lines} lines:\n{help}");
    }
    // An example that is broken over two lines cannot be copied.
    for one in arguments::Command::command().get_subcommands() {
        let help = one.get_after_help().map(ToString::to_string).unwrap_or_default();
        for example in help.lines().filter(|line| line.starts_with("  ")) {
            assert!(example.chars().count() <= 100, "{example}");
        }
    }
}

/// Nobody has to ask twice: `-h` and `--help` print the same.
#[test]
fn there_is_one_help() {
    for (name, help) in helps().into_iter().skip(1) {
        assert_eq!(printed(&["deltav", &name, "-h"]), help);
        assert_eq!(printed(&["deltav", "help", &name]), help);
    }
}

/// The groups of `deltav --help` have each command once, and their lines fit into 80 columns.
#[test]
fn every_command_is_in_one_group() {
    let mut grouped: Vec<&str> =
        arguments::GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
    grouped.sort_unstable();
    let mut command = arguments::command();
    command.build();
    let mut commands: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
    commands.sort_unstable();
    assert_eq!(grouped, commands);

    let (_, help) = helps().swap_remove(0);
    for (title, names) in arguments::GROUPS {
        let lines: Vec<&str> =
            help.lines().skip_while(|line| *line != format!("{title}:")).skip(1).take(names.len()).collect();
        for (line, name) in lines.iter().zip(names) {
            assert!(line.starts_with(&format!("  {name} ")), "{title}: {line}");
            assert!(line.chars().count() <= 80, "{line}");
        }
        assert_eq!(lines.len(), names.len(), "{title}");
    }
}

/// The values that an option takes are in its line or in the list below; `deltav explain` lists the topics.
#[test]
fn the_help_names_every_value_of_an_option() {
    let command = arguments::command();
    let mut count = 0;
    for (name, help) in helps().into_iter().skip(1) {
        let Some(one) = command.find_subcommand(&name) else { continue };
        let (options, _) = help.split_once("Example").unwrap();
        for argument in
            one.get_arguments().filter(|one| one.get_id() != "topic" && one.get_action().takes_values())
        {
            for value in argument.get_possible_values() {
                let is_named = options
                    .split(|c: char| !(c.is_alphanumeric() || c == '-'))
                    .any(|word| word == value.get_name());
                assert!(is_named, "{name}: {} {}", argument.get_id(), value.get_name());
                count += 1;
            }
        }
    }
    assert!(count > 80, "only {count} values");
}

/// Topics explain what the help has no room for, and those topics exist.
#[test]
fn the_help_leads_to_topics_that_exist() {
    let mut count = 0;
    for (name, help) in helps() {
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        let topics: Vec<&str> =
            help.split("`deltav explain ").skip(1).map(|rest| rest.split('`').next().unwrap()).collect();
        for topic in &topics {
            assert!(report::topic(topic).is_ok(), "{name}: {topic}");
        }
        let utilities = arguments::GROUPS[2].1;
        assert!(!topics.is_empty() || utilities.contains(&name.as_str()), "{name} --help leads nowhere");
        count += topics.len();
    }
    assert!(count > 25, "only {count} topics");
}
