//! `deltav reconstruct`: an exact solution, or all the evidence weighed where the case has more.

use analysis::{Analysis, EstimatePlan, Estimated, Weighed};
use anyhow::Result;
use case::CaseFile;
use report::Units;

use crate::arguments::{Format, ReconstructArguments, ReportArguments};
use crate::cases::of_cases;
use crate::estimates;
use crate::files::case_file;
use crate::handover::handover;
use crate::live;
use crate::present::{NoAnswer, answered, present, units};
use crate::threads::pool;

/// As `deltav estimate --no-pieces` without further options.
const PLAN: EstimatePlan =
    EstimatePlan { particles: EstimatePlan::PARTICLES, seed: 1, prior: None, pieces: false };

pub(crate) fn report(arguments: ReconstructArguments) -> Result<()> {
    let ReconstructArguments { report, exact } = arguments;
    let ReportArguments { cases, live, page } = report;
    let threads = cases.threads;
    if live {
        let weigh = |file: &CaseFile, solution: &Analysis, units: Units| {
            if exact { Ok(None) } else { weigh(file, solution, threads, units)? }
        };
        return live::report(cases, page.as_deref(), analysis::reconstruct, &weigh);
    }
    let answer = |case: &case::Case| {
        analysis::reconstruct(case).map(|found| report::Answer::Analysis(Box::new(found)))
    };
    let Some(arguments) = of_cases(cases, report::Table::Analyses, &answer)? else { return Ok(()) };
    let file = case_file(&arguments.case)?;
    let units = units(arguments.units, &file);
    let solution = answered(analysis::reconstruct(&file.case), &file, units)?;
    let weighed = if exact { Ok(None) } else { weigh(&file, &solution, threads, units)? };
    // Without weighing, the exact solution stands there as one.
    let (weighed, unweighed) = match weighed {
        Ok(weighed) => (weighed, None),
        Err(reason) => (None, Some(reason)),
    };
    let document = || match (arguments.format, &weighed) {
        (Format::Html | Format::Markdown, weighed) => {
            let of_method = if exact || weighed.is_some() { None } else { with_method(&file, threads)? };
            let (weighed, of_method) = (weighed.as_ref(), of_method.as_ref());
            handover(&arguments.case, &file, &solution, weighed, of_method, units)
        }
        (Format::Text | Format::Json, Some(weighed)) => {
            Ok(report::weighed(&file.case, &solution, weighed, units))
        }
        (Format::Text | Format::Json, None) => Ok(report::results(&file.case, &solution, units)),
    };
    present(&arguments, document, || match &weighed {
        Some(weighed) => report::weighed_json(&file, &solution, weighed),
        None => report::json(&file, &solution),
    })?;
    if let Some(reason) = unweighed {
        return Err(reason.context("the evidence could not be weighed, so the case has no headline"));
    }
    let Some(weighed) = weighed.filter(|weighed| !weighed.is_answer()) else { return Ok(()) };
    let message = if weighed.estimated.doubts().is_empty() {
        "the evidence contradicts itself: the report says where, and has no one answer"
    } else {
        "the evidence was weighed, but the run has not converged: the report says why, and has no interval"
    };
    Err(NoAnswer(message.to_owned()).into())
}

/// All the evidence, where the case has more than its exact solution uses; or why it cannot be weighed.
pub(crate) fn weigh(
    file: &CaseFile,
    solution: &Analysis,
    threads: Option<u16>,
    units: Units,
) -> Result<Result<Option<Weighed>>> {
    if solution.overdetermined().is_none() {
        return Ok(Ok(None));
    }
    let weighed = estimates::with_progress(&pool(threads)?, |progress| {
        analysis::weigh(&file.case, solution, &PLAN, progress)
    })?;
    Ok(answered(weighed, file, units))
}

/// What has the errors of the method, for the report on a case whose exact solution is the answer and that
/// has ranges: an interval by these alone would be read as that of all. `None` where it cannot be had or would
/// take minutes, which the report then says.
fn with_method(file: &CaseFile, threads: Option<u16>) -> Result<Option<Estimated>> {
    if !(analysis::is_uncertain(&file.case) && analysis::is_estimated_beside(&file.case)) {
        return Ok(None);
    }
    let estimated = estimates::with_progress(&pool(threads)?, |progress| {
        analysis::estimate(&file.case, &PLAN, progress)
    })?;
    Ok(estimated.ok())
}
