//! The picture behind the motion.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Result;
use case::{CaseFile, Fault, FaultKind, Faults, GivenSitePlan};
use report::SitePlan;

/// (bytes) no PNG or JPEG of a plan is larger.
const LARGEST_PICTURE: u64 = 1 << 28;

/// What is in the file of a picture, which is no device and no pipe.
pub(crate) fn picture(path: &Path) -> io::Result<Vec<u8>> {
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() {
        return Err(io::Error::other("it is no file"));
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

/// Where the picture of a case lies.
pub(crate) fn plan_path(case: &Path, plan: &GivenSitePlan) -> PathBuf {
    case.parent().unwrap_or(Path::new("")).join(plan.file.as_given())
}

/// The picture that `site_plan` of `[scene]` names, counted from the folder of the case file.
pub(crate) fn plan_of_case(case: &Path, file: &CaseFile) -> Result<Option<SitePlan>> {
    let Some(plan) = &file.case.site_plan else { return Ok(None) };
    let refused = |reason: String, advice: &str| {
        let kind = FaultKind::Refused { reason };
        let fault = Fault { key: "scene.site_plan.file".to_owned(), kind, advice: Some(advice.to_owned()) };
        file.diagnostics(&Faults::from(fault), &report::PROGRAM)
    };
    let cannot = |error: io::Error| {
        refused(
            format!("cannot read the site plan {}: {error}", plan.file),
            "put the picture beside the case file, or leave out site_plan",
        )
    };
    let path = plan_path(case, plan);
    // A case comes from others: what it names is to lie in its folder, and a link would lead out of it.
    if fs::symlink_metadata(&path).map_err(cannot)?.is_symlink() {
        return Err(refused(
            format!("the site plan {} is a link", plan.file),
            "put the picture itself beside the case file, or leave out site_plan",
        )
        .into());
    }
    let bytes = picture(&path).map_err(cannot)?;
    let plan = report::site_plan_of(&file.case, bytes);
    Ok(plan
        .map_err(|error| refused(error.to_string(), "save it as a PNG or a JPEG, or leave out site_plan"))?)
}
