//! `--live`: the report with the program in it.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use analysis::{Analysis, Weighed};
use anyhow::{Context as _, Result, bail};
use case::CaseFile;
use report::Units;

use crate::arguments::{CasesArguments, CasesFormat};
use crate::cases::Analyse;
use crate::files::{case_file, named, write};
use crate::handover::handover;
use crate::present::{answered, units};

/// What the page is called beside the program.
const PAGE: &str = "deltav.html";

/// What may lead the report in place of the analysis.
pub(crate) type Weigh<'a> = dyn Fn(&CaseFile, &Analysis, Units) -> Result<Option<Weighed>> + 'a;

pub(crate) fn report(
    arguments: CasesArguments,
    page: Option<&Path>,
    analyse: Analyse,
    weigh: &Weigh<'_>,
) -> Result<()> {
    if arguments.format != CasesFormat::Html {
        bail!("--live puts the program into a report as HTML: add --format html, or leave out --live");
    }
    let [case] = arguments.cases.as_slice() else {
        bail!("{} case files are given, and a report is on one", arguments.cases.len());
    };
    let path = page.map_or_else(beside, |page| Ok(page.to_owned()))?;
    let text = fs::read_to_string(&path).with_context(|| match page {
        Some(page) => format!("cannot read the page {}", named(page)),
        None => format!(
            "--live needs the page {PAGE}, and there is none beside the program ({}): put it there, or name it \
             with --page FILE; web/README.md says how it is built",
            named(&path)
        ),
    })?;
    let file = case_file(case)?;
    let units = units(arguments.units, &file);
    let analysis = answered(analyse(&file.case), &file, units)?;
    let weighed = weigh(&file, &analysis, units)?;
    let document = handover(case, &file, &analysis, weighed.as_ref(), None, units)?;
    let live = report::live(&text, &document.html(), &file);
    write(arguments.output.file(), live.with_context(|| named(&path).to_string())?)
}

/// The page beside the program.
pub(crate) fn beside() -> Result<PathBuf> {
    let program =
        env::current_exe().context("cannot tell where the program is: name the page with --page FILE")?;
    Ok(program.with_file_name(PAGE))
}
