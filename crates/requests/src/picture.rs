//! The picture behind the motion of a case.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use case::{CaseFile, Diagnostics, Fault, GivenSitePlan, Program};
use report::SitePlan;

use crate::beside::beside;

/// (bytes) no PNG or JPEG of a plan is larger.
const LARGEST_PICTURE: u64 = 1 << 28;

/// Reads the file of a picture, which must not be a device or a pipe.
///
/// # Errors
/// That of the system, or if the file cannot be a picture of a plan.
pub fn read_picture(path: &Path) -> io::Result<Vec<u8>> {
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    if metadata.len() > LARGEST_PICTURE {
        return Err(io::Error::other(format!(
            "it has {} MB, at most {}",
            metadata.len() >> 20,
            LARGEST_PICTURE >> 20
        )));
    }
    fs::read(path)
}

/// The path of the picture of a case.
#[must_use]
pub fn plan_path(case: &Path, plan: &GivenSitePlan) -> PathBuf {
    case.parent().unwrap_or(Path::new("")).join(plan.file.as_given())
}

/// Reads the picture that `site_plan` of `[scene]` names, counted from the folder of the case file.
///
/// # Errors
/// [`Diagnostics`] in the words of the program.
pub fn site_plan_beside(
    case: &Path,
    file: &CaseFile,
    program: &'static Program,
) -> Result<Option<SitePlan>, Diagnostics> {
    let Some(plan) = &file.case.site_plan else { return Ok(None) };
    let refused = |reason: String, advice: &str| {
        file.diagnostics(&Fault::refused("scene.site_plan.file", reason, advice).into(), program)
    };
    let cannot = |error: io::Error| {
        refused(
            format!("cannot read the site plan {}: {error}", plan.file),
            "put the picture itself next to the case file, or leave out site_plan",
        )
    };
    let bytes = beside(case, plan.file.as_given()).and_then(|path| read_picture(&path)).map_err(cannot)?;
    report::site_plan_of(&file.case, bytes)
        .map_err(|error| refused(error.to_string(), "save it as a PNG or a JPEG, or leave out site_plan"))
}
