//! `deltav draw`.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use case::{Axes, CaseFile, Fault, FaultKind, Faults, GivenSitePlan, Quantity};
use report::{Drawing, DrawingError, PictureFormat, SitePlan, Subject, Units};

use crate::arguments::{DrawArguments, What};
use crate::reconstruction;

pub(crate) fn draw(arguments: &DrawArguments) -> Result<()> {
    let path = arguments.output.file();
    let format = format_of(path)?;
    if arguments.plain && !matches!(arguments.what, What::Scene | What::Motion) {
        bail!("--plain is a form of the scene and of the motion: give --what scene, or leave out --plain");
    }
    if arguments.site_plan.is_some() && arguments.what != What::Motion {
        bail!("--site-plan lies behind the motion: give --what motion, or leave it out");
    }
    let file = crate::case_file(&arguments.case)?;
    let site_plan = match site_plan(arguments, file.case.axes)? {
        None if arguments.what == What::Motion => plan_of_case(&arguments.case, &file)?,
        given => given,
    };
    let units = crate::units(arguments.units, &file);
    let subject = match arguments.what {
        What::Estimate => {
            return write_picture(path, &crate::estimates::pictures(&file, units)?, format);
        }
        What::Scene => Subject::Scene,
        What::Damage => Subject::Damage,
        What::Reconciliation => Subject::Reconciliation,
        What::Energy => Subject::Energy,
        What::Motion => Subject::Motion,
        What::MotionCurves => Subject::MotionCurves,
        What::Momentum => Subject::Momentum,
    };
    if let Some(obstacle) = subject.obstacle(&file.case) {
        return cannot_draw(obstacle, &file, units);
    }
    let is_motion = matches!(subject, Subject::Motion | Subject::MotionCurves);
    let analysis = crate::answered(subject.analysis(&file.case), &file, units)?;
    let overdetermined = analysis.overdetermined().is_some();
    // Readers who are no engineers get the answer, or no speeds.
    let weighed = if arguments.plain && overdetermined {
        match reconstruction::weigh(&file, &analysis, None, units)? {
            Ok(weighed) => weighed,
            Err(reason) => {
                writeln!(io::stderr(), "the drawing has no speeds: {reason:#}")
                    .context("cannot write to standard error")?;
                None
            }
        }
    } else {
        None
    };
    let weighed = weighed.as_ref();
    let drawing = match subject {
        Subject::Scene if arguments.plain => report::plain_scene(&file, &analysis, weighed, units)?,
        Subject::Motion if arguments.plain => {
            report::plain_motion(&file, &analysis, weighed, units, site_plan)?
        }
        Subject::Motion => report::motion_on(&file, &analysis, units, site_plan)?,
        _ => report::drawing(&file, &analysis, units, subject)?,
    };
    // A drawing has no room for sentences, and standard output may be the drawing.
    let warnings = match analysis.warnings.len() {
        0 => None,
        1 => Some("1 warning".to_owned()),
        several => Some(format!("{several} warnings")),
    };
    if let Some(warnings) = warnings {
        let command = match (&analysis.found, analysis.exchange()) {
            (Some(_), _) => "reconstruct",
            (None, Some(_)) if analysis.both.is_some() => "reconstruct",
            (None, Some(_)) => "impact",
            (None, None) if is_motion => "motion",
            (None, None) => "crush",
        };
        let case = crate::named(&arguments.case);
        writeln!(io::stderr(), "{case} has {warnings}: `deltav {command} {case}` prints them.")
            .context("cannot write to standard error")?;
    }
    if overdetermined && !arguments.plain && subject != Subject::Damage {
        let case = crate::named(&arguments.case);
        writeln!(
            io::stderr(),
            "{case} has more evidence than the exact solution that is drawn: `deltav reconstruct {case}` weighs \
             all of it."
        )
        .context("cannot write to standard error")?;
    }
    if subject == Subject::Scene && analysis.exchange().is_none() {
        let case = crate::named(&arguments.case);
        writeln!(
            io::stderr(),
            "{case} does not give both speeds, so the scene has no velocities and no impulse: `deltav check \
             {case}` says which command finds them."
        )
        .context("cannot write to standard error")?;
    }
    write_picture(path, &drawing, format)
}

/// Says what a case lacks for a drawing, and what else can be drawn of it.
fn cannot_draw(obstacle: DrawingError, file: &CaseFile, units: Units) -> Result<()> {
    if let DrawingError::Analysis(failure) = obstacle {
        return crate::answered(Err(failure), file, units);
    }
    match Subject::of_case(&file.case).as_slice() {
        [] => bail!("{obstacle}"),
        subjects => {
            let names: Vec<&str> = subjects.iter().map(|subject| subject.name()).collect();
            bail!("{obstacle}; this case has enough for --what {}", names.join(", "))
        }
    }
}

/// The picture to draw on, with its place.
fn site_plan(arguments: &DrawArguments, axes: Axes) -> Result<Option<SitePlan>> {
    let (Some(path), Some([x, y]), Some(width)) =
        (&arguments.site_plan, &arguments.plan_corner, &arguments.plan_width)
    else {
        return Ok(None);
    };
    let name = crate::named(path);
    let bytes = picture(path).with_context(|| format!("cannot read the site plan {name}"))?;
    let angle = arguments.plan_angle.as_ref().map_or(0.0, Quantity::si);
    let plan = report::site_plan(bytes, axes, [x.si(), y.si()], angle, width.si());
    Ok(Some(plan.with_context(|| format!("--site-plan {name}"))?))
}

/// (bytes) no PNG or JPEG of a plan is larger.
const LARGEST_PICTURE: u64 = 1 << 28;

/// What is in the file of a picture, which is no device and no pipe.
fn picture(path: &Path) -> io::Result<Vec<u8>> {
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

/// Writes a drawing, and says on standard error which of its letters it could not draw.
pub(crate) fn write_picture(path: Option<&Path>, drawing: &Drawing, format: PictureFormat) -> Result<()> {
    let missing: Vec<String> =
        drawing.missing_letters().map(|letter| format!("{letter} (U+{:04X})", u32::from(letter))).collect();
    if format != PictureFormat::Svg && !missing.is_empty() {
        let place = path.map_or_else(String::new, |path| format!("{}: ", crate::named(path)));
        writeln!(
            io::stderr(),
            "warning: {place}the font of the drawings lacks {}; the picture has ? instead. An SVG uses the \
             fonts of its reader.",
            missing.join(", ")
        )
        .context("cannot write to standard error")?;
    }
    crate::write(path, drawing.write_as(format)?)
}

fn format_of(path: Option<&Path>) -> Result<PictureFormat> {
    let Some(path) = path else { return Ok(PictureFormat::Svg) };
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let format = PictureFormat::ALL
        .into_iter()
        .find(|format| ending.as_deref().is_some_and(|ending| ending == format.extension()));
    let Some(format) = format else {
        bail!("{} must end in .svg, .png or .pdf: the extension selects the format", crate::named(path))
    };
    Ok(format)
}
