//! `deltav completions` and `deltav man`: from the command line itself.

use std::path::Path;

use anyhow::{Context as _, Result};
use clap::CommandFactory as _;
use clap_complete::Shell;

use crate::arguments::Command;

pub(crate) fn completions(shell: Shell) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Command::command(), "deltav", &mut script);
    crate::write(None, script)
}

/// The page of the program to standard output, or all pages into a folder.
pub(crate) fn manual(folder: Option<&Path>) -> Result<()> {
    match folder {
        Some(folder) => clap_mangen::generate_to(for_pages(), folder)
            .with_context(|| format!("cannot write the manual pages into {}", crate::named(folder))),
        None => {
            let mut page = Vec::new();
            // As in the folder, which has no page for the help.
            let command = for_pages().disable_help_subcommand(true);
            clap_mangen::Man::new(command).render(&mut page).context("cannot make the page")?;
            crate::write(None, page)
        }
    }
}

/// The commands with dots behind what may be given several times, which clap_mangen leaves out.
fn for_pages() -> clap::Command {
    Command::command()
        .mut_subcommand("reconstruct", |command| command.mut_arg("cases", |cases| cases.value_name("CASE…")))
        .mut_subcommand("explain", |command| command.mut_arg("topic", |topic| topic.value_name("TOPIC…")))
}
