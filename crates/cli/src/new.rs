//! `deltav new`.

use std::io::ErrorKind;

use anyhow::{Context as _, Result, bail};

use crate::arguments::{CaseUnits, NewArguments, Template};
use crate::files::{named, write};
use crate::outputs;
use crate::sink;

pub(crate) fn new(arguments: &NewArguments) -> Result<()> {
    let template = match arguments.template {
        Template::FrontSide => case::Template::FrontSide,
        Template::HeadOn => case::Template::HeadOn,
        Template::RearEnd => case::Template::RearEnd,
        Template::RearEndRest => case::Template::RearEndRest,
        Template::Intersection => case::Template::Intersection,
        Template::Barrier => case::Template::Barrier,
        Template::Sideswipe => case::Template::Sideswipe,
        Template::Ees => case::Template::Ees,
        Template::HeavyTruck => case::Template::HeavyTruck,
        Template::OneVehicle => case::Template::OneVehicle,
    };
    let text = template.text(match arguments.units {
        CaseUnits::Si => case::UnitSystem::Si,
        CaseUnits::Us => case::UnitSystem::Us,
    });
    let Some(path) = arguments.output.file() else { return write(None, text) };
    outputs::has_folder("-o", path)?;
    let name = named(path);
    match sink::create_new(path, text.as_bytes()) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            bail!("{name} exists already, and is not overwritten: give another name, or remove it first")
        }
        written => written.with_context(|| format!("cannot write the case to {name}")),
    }
}
