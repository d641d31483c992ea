//! `deltav draw`.

use std::io::{self, Write as _};
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use report::Subject;

use crate::arguments::{DrawArguments, What};

pub(crate) fn draw(arguments: &DrawArguments) -> Result<()> {
    let image = Image::of(arguments.output.file())?;
    let file = crate::case_file(&arguments.case)?;
    let subject = match arguments.what {
        What::Scene => Subject::Scene,
        What::Damage => Subject::Damage,
        What::Reconciliation => Subject::Reconciliation,
        What::Energy => Subject::Energy,
    };
    let units = crate::units(arguments.units, &file);
    let analysis = crate::answered(analysis::furthest(&file.case), &file, units)?;
    let drawing = report::drawing(&file, &analysis, units, subject)?;
    // A drawing has no room for sentences, and standard output may be the drawing.
    let warnings = report::warnings(&file.case, &analysis, units).text();
    write!(io::stderr(), "{warnings}").context("cannot write to standard error")?;
    let path = arguments.output.file();
    match image {
        Image::Svg => crate::write(path, drawing.svg()),
        Image::Png => crate::write(path, drawing.png()?),
    }
}

enum Image {
    Svg,
    Png,
}

impl Image {
    fn of(path: Option<&Path>) -> Result<Self> {
        let Some(path) = path else { return Ok(Self::Svg) };
        match path.extension().map(|ending| ending.to_ascii_lowercase()) {
            Some(ending) if ending == "svg" => Ok(Self::Svg),
            Some(ending) if ending == "png" => Ok(Self::Png),
            _ => bail!("{} must end in .svg or .png: the extension selects the format", crate::named(path)),
        }
    }
}
