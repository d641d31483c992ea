//! `deltav completions` and `deltav man`: from the command line itself.

use std::path::Path;

use anyhow::{Context as _, Result};
use clap::{Arg, ArgAction, CommandFactory as _};
use clap_complete::Shell;

use crate::arguments::Command;
use crate::files::write;

pub(crate) fn completions(shell: Shell) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Command::command(), "deltav", &mut script);
    write(None, script)
}

/// The page of the program to standard output, or all pages into a folder.
pub(crate) fn manual(folder: Option<&Path>) -> Result<()> {
    match folder {
        Some(folder) => {
            let mut command = for_pages().disable_help_subcommand(true);
            // The names of pages include the commands above, which this adds.
            command.build();
            pages(&command, folder)
        }
        None => {
            let mut page = Vec::new();
            // As in the folder, which has no page for the help.
            let command = for_pages().disable_help_subcommand(true);
            clap_mangen::Man::new(command).render(&mut page).context("cannot make the page")?;
            write(None, page)
        }
    }
}

/// The page of a command, and those of its commands.
fn pages(command: &clap::Command, folder: &Path) -> Result<()> {
    command
        .get_subcommands()
        .filter(|command| !command.is_hide_set())
        .try_for_each(|command| pages(command, folder))?;
    let manual = clap_mangen::Man::new(command.clone());
    let mut page = Vec::new();
    manual.render(&mut page).context("cannot make the page")?;
    write(Some(&folder.join(manual.get_filename())), page)
}

/// The command with its whole description and, in its options, the meaning of their values.
fn described(command: clap::Command) -> clap::Command {
    let description: Vec<String> = [command.get_about(), command.get_before_help()]
        .into_iter()
        .flatten()
        .map(ToString::to_string)
        .collect();
    // With more than one description, clap would speak of a summary.
    let help = Arg::new("help").short('h').long("help").action(ArgAction::Help).help("Print help");
    command
        .long_about(description.join(".\n\n"))
        .mut_args(|argument| argument.hide_possible_values(false))
        .disable_help_flag(true)
        .arg(help)
}

/// The commands with dots after arguments that may be given several times, which clap_mangen leaves out.
fn for_pages() -> clap::Command {
    described(Command::command())
        .mut_subcommands(|command| {
            let command = described(command);
            let takes_several = command.get_arguments().any(|argument| argument.get_id() == "cases");
            if takes_several {
                command.mut_arg("cases", |cases| cases.value_name("CASE…"))
            } else {
                command
            }
        })
        .mut_subcommand("explain", |command| {
            command.mut_arg("topic", |topic| topic.value_name("TOPIC…").hide_possible_values(true))
        })
}
