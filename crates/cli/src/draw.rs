//! `deltav draw`.

use std::io::{self, Write as _};
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use case::{Axes, CaseFile, Quantity};
use report::{DrawingError, PictureFormat, SitePlan, Subject, Units};

use crate::arguments::{DrawArguments, What};
use crate::estimates;
use crate::files::{case_file, named};
use crate::pictures::write_picture;
use crate::present::{answered, units};
use crate::reconstruction;
use crate::site_plan::{picture, plan_of_case};

pub(crate) fn draw(arguments: &DrawArguments) -> Result<()> {
    let path = arguments.output.file();
    let format = format_of(path)?;
    if arguments.plain && !matches!(arguments.what, What::Scene | What::Motion) {
        bail!("--plain is a form of the scene and of the motion: give --what scene, or leave out --plain");
    }
    if arguments.site_plan.is_some() && arguments.what != What::Motion {
        bail!("--site-plan lies behind the motion: give --what motion, or leave it out");
    }
    let file = case_file(&arguments.case)?;
    let site_plan = match site_plan(arguments, file.case.axes)? {
        None if arguments.what == What::Motion => plan_of_case(&arguments.case, &file)?,
        given => given,
    };
    let units = units(arguments.units, &file);
    let subject = match arguments.what {
        What::Estimate => {
            return write_picture(path, &estimates::pictures(&file, units)?, format);
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
    let analysis = answered(subject.analysis(&file.case), &file, units)?;
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
        let case = named(&arguments.case);
        writeln!(io::stderr(), "{case} has {warnings}: `deltav {command} {case}` prints them.")
            .context("cannot write to standard error")?;
    }
    if overdetermined && !arguments.plain && subject != Subject::Damage {
        let case = named(&arguments.case);
        writeln!(
            io::stderr(),
            "{case} has more evidence than the exact solution that is drawn: `deltav reconstruct {case}` weighs \
             all of it."
        )
        .context("cannot write to standard error")?;
    }
    if subject == Subject::Scene && analysis.exchange().is_none() {
        let case = named(&arguments.case);
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
        return answered(Err(failure), file, units);
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
    let name = named(path);
    let bytes = picture(path).with_context(|| format!("cannot read the site plan {name}"))?;
    let angle = arguments.plan_angle.as_ref().map_or(0.0, Quantity::si);
    let plan = report::site_plan(bytes, axes, [x.si(), y.si()], angle, width.si());
    Ok(Some(plan.with_context(|| format!("--site-plan {name}"))?))
}

fn format_of(path: Option<&Path>) -> Result<PictureFormat> {
    let Some(path) = path else { return Ok(PictureFormat::Svg) };
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let format = PictureFormat::ALL
        .into_iter()
        .find(|format| ending.as_deref().is_some_and(|ending| ending == format.extension()));
    let Some(format) = format else {
        bail!("{} must end in .svg, .png or .pdf: the extension selects the format", named(path))
    };
    Ok(format)
}
