//! `deltav draw`.

use std::path::Path;

use analysis::{Analysis, NoEstimate, Weighed};
use anyhow::{Context as _, Result, bail};
use case::{Axes, CaseFile, Quantity};
use report::{
    AvoidPicture, Drawing, DrawingError, DrawingRequest, PROGRAM, PictureFormat, SitePlan, Subject, Units,
};
use requests::{
    Answer, AvoidOptions, EstimateAnswer, EstimateOptions, Request, read_picture, site_plan_beside,
};

use crate::arguments::{DrawArguments, What};
use crate::files::{case_file, named, say};
use crate::pictures::write_picture;
use crate::present::{NoAnswer, answered, found, units};
use crate::threads::{in_pool, pool};

pub(crate) fn draw(arguments: &DrawArguments) -> Result<()> {
    let path = arguments.output.file();
    let format = format_of(path)?;
    let subject = arguments.what.subject();
    let plain = arguments.plain;
    if plain && !subject.is_some_and(|subject| DrawingRequest { subject, plain }.can_be()) {
        bail!("--plain is a form of the scene and of the motion: give --what scene, or leave out --plain");
    }
    if arguments.site_plan.is_some() && subject != Some(Subject::Motion) {
        bail!("--site-plan is the background of the motion: give --what motion, or leave it out");
    }
    let file = case_file(&arguments.case)?;
    let site_plan = match site_plan(arguments, file.case.axes)? {
        None if subject == Some(Subject::Motion) => site_plan_beside(&arguments.case, &file, &PROGRAM)?,
        given => given,
    };
    let units = units(arguments.units, &file);
    let subject = match arguments.what {
        What::Subject(subject) => subject,
        What::Estimate => return write_picture(path, &estimate(&file, units)?, format),
        What::Avoid(picture) => return write_picture(path, &avoided(&file, units, picture)?, format),
    };
    if let Some(obstacle) = subject.obstacle(&file.case) {
        return cannot_draw(obstacle, &file, units);
    }
    let is_motion = matches!(subject, Subject::Motion | Subject::MotionCurves);
    let analysis = answered(subject.analysis(&file.case), &file, units)?;
    let is_exact = analysis.why_not_exact().is_none();
    let drawing = DrawingRequest { subject, plain };
    // Readers who are not engineers get the answer, or no speeds.
    let weighed = if plain && !is_exact { weigh(&analysis, &file, units)? } else { None };
    let drawing = drawing.draw(&file, &analysis, weighed.as_ref(), units, site_plan)?;
    // A drawing has no room for sentences, and standard output may be the drawing.
    let (warnings, command) = match (analysis.warnings.len(), &analysis.found, analysis.exchange()) {
        // A case that was not solved may have warnings that need no answer.
        (0, None, None) => (analysis::judge(&file.case).warnings.len(), "check"),
        (warnings, Some(_), _) => (warnings, "reconstruct"),
        (warnings, None, Some(_)) if analysis.both.is_some() => (warnings, "reconstruct"),
        (warnings, None, Some(_)) => (warnings, "impact"),
        (warnings, None, None) if is_motion => (warnings, "motion"),
        (warnings, None, None) => (warnings, "crush"),
    };
    let case = named(&arguments.case);
    if warnings > 0 {
        let warnings = if warnings == 1 { "1 warning".to_owned() } else { format!("{warnings} warnings") };
        say(&format!("{case} has {warnings}: `deltav {command} {case}` prints them."))?;
    }
    if !is_exact && !plain && subject != Subject::Damage {
        say(&format!(
            "the drawing shows an exact solution, which is not the answer of {case}: `deltav reconstruct {case}` says why, and \
             weighs all the evidence."
        ))?;
    }
    if subject == Subject::Scene && analysis.exchange().is_none() {
        say(&format!(
            "{case} does not give both speeds, so the scene has no velocities and no impulse: `deltav check \
             {case}` says which command finds them."
        ))?;
    }
    write_picture(path, &drawing, format)
}

/// All the evidence, weighed; `None`, and a line with the reason, if it cannot be weighed.
fn weigh(analysis: &Analysis, file: &CaseFile, units: Units) -> Result<Option<Weighed>> {
    let weighed = in_pool(&pool(None)?, |progress| requests::weigh(&file.case, analysis, progress))?;
    answered(weighed, file, units).or_else(|reason| {
        say(&format!("the drawing has no speeds: {reason:#}"))?;
        Ok(None)
    })
}

/// The pictures of an estimate with the default options.
fn estimate(file: &CaseFile, units: Units) -> Result<Drawing> {
    let options = EstimateOptions { pieces: false, ..EstimateOptions::default() };
    let answer = in_pool(&pool(None)?, |progress| options.answer(&file.case, progress))?;
    let EstimateAnswer { estimated, asked } = found(answer, file, units)?;
    match estimated.no_answer() {
        Some(NoEstimate::Unconverged) => {
            let message =
                "the run has not converged, so there is nothing to draw: `deltav estimate` says why";
            return Err(NoAnswer(message.to_owned()).into());
        }
        Some(NoEstimate::Contradicted(keys)) => say(&format!(
            "no collision reproduces all of the evidence, and even the nearest miss {}: the picture shows \
             these collisions, and is not an answer; `deltav estimate` says more",
            keys.join(", ")
        ))?,
        None => {}
    }
    let drawing = report::estimate_pictures(&file.case, &estimated, &asked, units);
    let message = "there is no estimate to draw: the case gives both speeds and follows no vehicle to rest; leave out the speed to be estimated";
    drawing.ok_or_else(|| NoAnswer(message.to_owned()).into())
}

/// A picture of avoidability with the default options.
fn avoided(file: &CaseFile, units: Units, picture: AvoidPicture) -> Result<Drawing> {
    let request = Request::Avoid(AvoidOptions::default());
    let answer = in_pool(&pool(None)?, |progress| request.answer(&file.case, progress))?;
    let Answer::Avoidance(found) = found(answer, file, units)? else { bail!("the answer has no picture") };
    picture.draw(&file.case, &found, units).map_err(|reason| NoAnswer(reason.to_owned()).into())
}

/// Reports the data that a case lacks for a drawing, and what else can be drawn.
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
    let bytes = read_picture(path).with_context(|| format!("cannot read the site plan {name}"))?;
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
