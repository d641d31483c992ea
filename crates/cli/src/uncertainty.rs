//! `deltav uncertainty`.

use std::io::{self, BufWriter};
use std::ops::ControlFlow;
use std::path::Path;

use ::uncertainty::{SamplingMethod, Settings};
use analysis::{Failure, Output, Plan, Uncertainty};
use anyhow::{Context as _, Result};
use case::Case;
use rayon::ThreadPool;
use report::{Answer, Table};

use crate::arguments::{self, UncertaintyArguments};
use crate::batch::Incomplete;
use crate::cases::of_cases;
use crate::files::{case_file, named};
use crate::pictures::write_plot;
use crate::present::{answered, present, units};
use crate::progress::{Progress, counted};
use crate::sink::Sink;
use crate::threads::pool;

pub(crate) fn report(arguments: UncertaintyArguments) -> Result<()> {
    let UncertaintyArguments {
        arguments: of_case,
        samples,
        seed,
        method,
        outputs,
        sobol,
        samples_out,
        plots,
        plots_format,
    } = arguments;
    if sobol.is_some()
        && let Some(rows) = of_case.cases.iter().find(|case| is_number(case) && !case.exists())
    {
        let rows = named(rows);
        anyhow::bail!("--sobol {rows}: write --sobol={rows}; a number after a space is read as a case file");
    }
    let wanted = |output: Output| outputs.as_ref().is_none_or(|names| names.contains(&output.path()));
    let method = match method {
        arguments::Method::MonteCarlo => SamplingMethod::MonteCarlo,
        arguments::Method::LatinHypercube => SamplingMethod::LatinHypercube,
        arguments::Method::Sobol => SamplingMethod::Sobol,
    };
    let plan = |case: &Case| {
        let samples = samples.unwrap_or_else(|| analysis::usual_samples(case));
        Plan { settings: Settings::new(method, samples, seed), index_rows: sobol }
    };
    if of_case.format.of_one().is_err() && (samples_out.is_some() || plots.is_some()) {
        anyhow::bail!(
            "--samples-out and --plots are for the report on one case: leave them out, or --format"
        );
    }
    let (threads, csv_style) = (of_case.threads, of_case.csv_style);
    let answer = |case: &Case| {
        let quietly = &mut |_, _, _| ControlFlow::Continue(());
        let uncertainty = analysis::uncertainty_of(case, &plan(case), &wanted, quietly);
        uncertainty.map(|answer| Answer::Uncertainty(Box::new(answer)))
    };
    let Some(arguments) = of_cases(of_case, Table::Uncertainties, &answer)? else { return Ok(()) };
    let file = case_file(&arguments.case)?;
    let units = units(arguments.units, &file);
    let pool = pool(threads)?;
    let propagated = propagate(&file.case, &plan(&file.case), &wanted, &pool)?;
    let uncertainty = answered(propagated, &file, units)?;
    for name in outputs.iter().flatten() {
        if !uncertainty.outputs.iter().any(|known| known.output.path() == *name) {
            anyhow::bail!("--outputs {name}: this case has no such result; leave the name out");
        }
    }
    if let Some(path) = &samples_out {
        let cannot = || format!("cannot write the samples to {}", named(path));
        let mut out = BufWriter::new(Sink::open(Some(path)).with_context(cannot)?);
        report::write_samples(&uncertainty, csv_style.into(), &mut out)
            .and_then(|()| out.into_inner().map_err(io::IntoInnerError::into_error)?.finish())
            .with_context(cannot)?;
    }
    if let Some(folder) = &plots {
        for (place, output) in uncertainty.outputs.iter().enumerate() {
            let name = output.output.path();
            let plots = [
                ("tornado", report::tornado(&file.case, &uncertainty, place, units)),
                ("histogram", pool.install(|| report::histogram(&file.case, &uncertainty, place, units))),
            ];
            for (plot, drawing) in plots {
                if let Some(drawing) = drawing {
                    write_plot(folder, &format!("{plot}-{name}"), &drawing, plots_format)?;
                }
            }
        }
    }
    let document = || Ok(pool.install(|| report::uncertainty(&file.case, &uncertainty, units)));
    present(&arguments, document, || report::uncertainty_json(&file, &uncertainty))?;
    let (done, total) = (uncertainty.propagation.evaluated(), uncertainty.propagation.requested());
    if done < total { Err(Incomplete::EndedSamples { done, total }.into()) } else { Ok(()) }
}

fn is_number(path: &Path) -> bool {
    path.to_str().is_some_and(|name| name.parse::<f64>().is_ok())
}

fn propagate(
    case: &Case,
    plan: &Plan,
    wanted: &(dyn Fn(Output) -> bool + Sync),
    pool: &ThreadPool,
) -> Result<Result<Uncertainty, Failure>> {
    let mut progress = Progress::new()?;
    Ok(pool.install(|| {
        analysis::uncertainty_of(case, plan, wanted, &mut |stage, done, total| {
            progress.at(counted(stage), done, total)
        })
    }))
}
