//! `deltav new`.

use std::borrow::Cow;
use std::io::ErrorKind;

use anyhow::{Context as _, Result, bail};
use case::UnitSystem;
use report::Units;

use crate::arguments::NewArguments;
use crate::files::{named, write};
use crate::outputs;
use crate::sink;

pub(crate) fn new(arguments: &NewArguments) -> Result<()> {
    let template = arguments.template;
    let text = match arguments.units {
        Units::Si => Cow::from(template.text(UnitSystem::Si)),
        Units::Us => Cow::from(template.text(UnitSystem::Us)),
        Units::Uk => Cow::from(template.text_with_mph()),
    };
    let Some(path) = arguments.output.file() else { return write(None, &*text) };
    outputs::has_folder("-o", path)?;
    let name = named(path);
    match sink::create_new(path, text.as_bytes()) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            bail!("{name} exists already, and is not overwritten: give another name, or remove it first")
        }
        written => written.with_context(|| format!("cannot write the case to {name}")),
    }
}
