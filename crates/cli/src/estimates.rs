//! `deltav estimate`.

use std::io::{self, BufWriter};
use std::ops::ControlFlow;

use analysis::{EstimatePlan, EstimateStage, Estimated, Failure, estimate_outputs};
use anyhow::{Context as _, Result};
use case::{Case, CaseFile};
use rayon::ThreadPool;
use report::{Asked, Drawing, Question, Units};

use crate::arguments::EstimateArguments;
use crate::files::{case_file, named};
use crate::present::{NoAnswer, answered, present, units};
use crate::progress;
use crate::sink::Sink;
use crate::threads::pool;

pub(crate) fn report(arguments: &EstimateArguments) -> Result<()> {
    let of_case = &arguments.arguments;
    let file = case_file(&of_case.case)?;
    let units = units(of_case.units, &file);
    let outputs = answered(estimate_outputs(&file.case), &file, units)?;
    let question = |text: &String| {
        let problem = |problem| anyhow::anyhow!("--above \"{}\": {problem}", case::shown(text.trim()));
        Question::read(text, &outputs).map_err(problem)
    };
    let questions = arguments.above.iter().map(question).collect::<Result<Vec<Question>>>()?;
    let plan = EstimatePlan {
        particles: arguments.particles,
        seed: arguments.seed,
        prior: arguments.prior.map(Into::into),
        pieces: !arguments.no_pieces,
    };
    let estimated = answered(run(&file.case, &plan, &pool(arguments.threads)?)?, &file, units)?;
    let is_answer = estimated.doubts().is_empty();
    // Draws that have not converged are no answer either.
    if let Some(path) = arguments.samples_out.as_deref().filter(|_| is_answer) {
        let cannot = || format!("cannot write the draws to {}", named(path));
        let mut out = BufWriter::new(Sink::open(Some(path)).with_context(cannot)?);
        report::write_draws(&estimated, arguments.csv_style.into(), &mut out)
            .and_then(|()| out.into_inner().map_err(io::IntoInnerError::into_error)?.finish())
            .with_context(cannot)?;
    }
    let asked = Asked { plan, questions };
    let document = || Ok(report::estimate(&file.case, &estimated, &asked, units));
    present(of_case, document, || report::estimate_json(&file, &estimated, &asked))?;
    if is_answer {
        return Ok(());
    }
    let draws = if arguments.samples_out.is_some() { ", and the draws are not written" } else { "" };
    let message = format!("the run has not converged: the report says why, and has no intervals{draws}");
    Err(NoAnswer(message).into())
}

/// The pictures of an estimate as it is without options.
pub(crate) fn pictures(file: &CaseFile, units: Units) -> Result<Drawing> {
    let plan = EstimatePlan { particles: EstimatePlan::PARTICLES, seed: 1, prior: None, pieces: false };
    let estimated = answered(run(&file.case, &plan, &pool(None)?)?, file, units)?;
    if !estimated.doubts().is_empty() {
        let message = "the run has not converged, so there is nothing to draw: `deltav estimate` says why";
        return Err(NoAnswer(message.to_owned()).into());
    }
    let asked = Asked { plan, questions: Vec::new() };
    let drawing = report::estimate_pictures(&file.case, &estimated, &asked, units);
    let message = "there is no estimate to draw: the case gives both speeds and follows no vehicle to rest; leave out the speed that is sought";
    drawing.ok_or_else(|| NoAnswer(message.to_owned()).into())
}

fn run(case: &Case, plan: &EstimatePlan, pool: &ThreadPool) -> Result<Result<Estimated, Failure>> {
    with_progress(pool, |progress| analysis::estimate(case, plan, progress))
}

/// Runs an estimate in the pool, with a bar on the terminal.
pub(crate) fn with_progress<T: Send>(
    pool: &ThreadPool,
    run: impl FnOnce(&mut Reported<'_>) -> T + Send,
) -> Result<T> {
    let mut progress = progress::Progress::new()?;
    Ok(pool.install(|| {
        run(&mut |stage, done, total| {
            let counted = match stage {
                EstimateStage::All => "particles",
                EstimateStage::Prior => "particles before the evidence",
                EstimateStage::Piece => "pieces of evidence",
            };
            progress.at(counted, done, total)
        })
    }))
}

/// What hears of the progress of an estimate, and may end it.
type Reported<'a> = dyn FnMut(EstimateStage, usize, usize) -> ControlFlow<()> + Send + 'a;
