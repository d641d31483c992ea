//! Drawings as files.

use std::path::Path;

use anyhow::Result;
use report::{Drawing, PictureFormat};

use crate::files::{named, say, write};

/// Writes a drawing, and reports on standard error which of its letters it could not draw.
pub(crate) fn write_picture(path: Option<&Path>, drawing: &Drawing, format: PictureFormat) -> Result<()> {
    let missing: Vec<String> =
        drawing.missing_letters().map(|letter| format!("{letter} (U+{:04X})", u32::from(letter))).collect();
    if format != PictureFormat::Svg && !missing.is_empty() {
        let place = path.map_or_else(String::new, |path| format!("{}: ", named(path)));
        say(&format!(
            "warning: {place}the font of the drawings lacks {}; the picture has ? instead. An SVG uses the \
             fonts of its reader.",
            missing.join(", ")
        ))?;
    }
    write(path, drawing.write_as(format)?)
}

pub(crate) fn write_plot(folder: &Path, name: &str, plot: &Drawing, format: PictureFormat) -> Result<()> {
    let path = folder.join(format!("{name}.{}", format.extension()));
    write_picture(Some(&path), plot, format)
}
