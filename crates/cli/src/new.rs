//! `deltav new`.

use std::fs::File;
use std::io::{ErrorKind, Write as _};

use anyhow::{Context as _, Result, bail};

use crate::arguments::{CaseUnits, NewArguments, Template};

pub(crate) fn new(arguments: &NewArguments) -> Result<()> {
    let template = match arguments.template {
        Template::FrontSide => case::Template::FrontSide,
        Template::HeadOn => case::Template::HeadOn,
        Template::RearEnd => case::Template::RearEnd,
        Template::Barrier => case::Template::Barrier,
        Template::Sideswipe => case::Template::Sideswipe,
    };
    let text = template.text(match arguments.units {
        CaseUnits::Si => case::UnitSystem::Si,
        CaseUnits::Us => case::UnitSystem::Us,
    });
    let Some(path) = &arguments.output else { return crate::write(None, text) };
    let name = crate::named(path);
    // Whoever has a case in that file keeps it, whatever happens between a look and the writing.
    let mut file = match File::create_new(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            bail!("{name} exists already, and is not overwritten: give another name, or remove it first")
        }
        created => created.with_context(|| format!("cannot write the case to {name}"))?,
    };
    file.write_all(text.as_bytes()).with_context(|| format!("cannot write the case to {name}"))
}
