//! Drawings of a case, and the picture behind its motion.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use analysis::{Analysis, Weighed};
use case::{CaseFile, Diagnostics, Fault, GivenSitePlan, Program};
use report::{Drawing, DrawingError, SitePlan, Subject, Units};

use crate::beside::beside;

/// The drawing to make of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawingRequest {
    /// The subject.
    pub subject: Subject,
    /// Whether it is for readers who are not engineers.
    pub plain: bool,
}

impl DrawingRequest {
    /// Whether there is a form of the subject for readers who are not engineers.
    #[must_use]
    pub fn can_be(self) -> bool {
        !self.plain || matches!(self.subject, Subject::Scene | Subject::Motion)
    }

    /// Draws it; a plain drawing has the speeds by all the evidence if that was weighed.
    ///
    /// # Errors
    /// [`DrawingError`]: mostly that the analysis has nothing of this kind.
    pub fn draw(
        self,
        file: &CaseFile,
        analysis: &Analysis,
        weighed: Option<&Weighed>,
        units: Units,
        site_plan: Option<SitePlan>,
    ) -> Result<Drawing, DrawingError> {
        match (self.subject, self.plain) {
            (Subject::Motion, true) => report::plain_motion(file, analysis, weighed, units, site_plan),
            (_, true) => report::plain_scene(file, analysis, weighed, units),
            (Subject::Motion, false) => report::motion_on(file, analysis, units, site_plan),
            (subject, false) => report::drawing(file, analysis, units, subject),
        }
    }
}

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
