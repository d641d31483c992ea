//! `--live`: the report with the program in it.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use case::{CaseFile, Text};
use report::Document;

use crate::arguments::{CasesArguments, Format};
use crate::files::named;

/// The name of the page next to the program.
const PAGE: &str = "deltav.html";

/// The text of a page into which a report is put, and its name in messages.
pub(crate) struct Page {
    name: Text,
    text: String,
}

impl Page {
    /// The page that the arguments name, or the one next to the program.
    pub(crate) fn read(arguments: &CasesArguments, page: Option<&Path>) -> Result<Self> {
        if arguments.format != Ok(Format::Html) {
            bail!("--live puts the program into a report as HTML: add --format html, or leave out --live");
        }
        if arguments.cases.len() != 1 {
            bail!("{} case files are given, but a report covers only one", arguments.cases.len());
        }
        let path = page.map_or_else(beside, |page| Ok(page.to_owned()))?;
        let name = named(&path);
        let text = fs::read_to_string(&path).with_context(|| match page {
            Some(_) => format!("cannot read the page {name}"),
            None => format!(
                "--live needs the page {PAGE}, and there is none beside the program ({name}): put it there, or \
                 name it with --page FILE; web/README.md says how it is built"
            ),
        })?;
        Ok(Self { name, text })
    }

    /// With a report in it.
    pub(crate) fn with(&self, document: &Document, file: &CaseFile) -> Result<String> {
        report::live(&self.text, &document.html(), file).with_context(|| self.name.to_string())
    }
}

/// The path of the page next to the program.
pub(crate) fn beside() -> Result<PathBuf> {
    let program =
        env::current_exe().context("cannot tell where the program is: name the page with --page FILE")?;
    Ok(program.with_file_name(PAGE))
}
