//! The commands that take a case file and report on it: `deltav reconstruct`, `impact` and the others.

use std::io::{self, BufWriter};
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use case::{Case, CaseFile};
use rayon::ThreadPool;
use report::{CsvStyle, Document, PROGRAM, Units};
use requests::{Answer, NoPage, Request, Unanswered, UncertaintyOptions, site_plan_beside};

use crate::arguments::{Asked, Format, Rows};
use crate::cases::of_cases;
use crate::files::{case_file, named, write};
use crate::live::Page;
use crate::outputs;
use crate::pictures::write_plot;
use crate::present::{NoAnswer, answered, found, present, units};
use crate::progress::Progress;
use crate::sink::Sink;
use crate::threads::{in_pool, pool};

pub(crate) fn report(asked: Asked) -> Result<()> {
    outputs::check_asked(&asked)?;
    check(&asked)?;
    let Asked { request, cases, is_live, page, samples_out, plots } = asked;
    let (threads, csv_style) = (cases.threads, cases.csv_style);
    let live = if is_live { Some(Page::read(&cases, page.as_deref())?) } else { None };
    let Some(arguments) = of_cases(cases, &request)? else { return Ok(()) };
    let file = case_file(&arguments.case)?;
    let units = units(arguments.units, &file);
    let (answer, pool) = answer(&request, &file.case, threads)?;
    let mut answer = found(answer, &file, units)?;
    has_outputs(&request, &answer)?;
    // Neither a live report without a headline nor samples without an answer is of use.
    let unweighed = match &mut answer {
        Answer::Analysis(solved) => solved.unweighed.take(),
        _ => None,
    };
    if let Some(page) = live {
        unweighed.map_or(Ok(()), |failure| answered(Err(failure), &file, units))?;
        let document = handed_over(&arguments.case, &file, &answer, units)?;
        return write(arguments.output.file(), page.with(&document, &file)?);
    }
    if let Some(path) = samples_out.as_deref().filter(|_| answer.no_answer().is_none()) {
        write_samples(&answer, path, csv_style)?;
    }
    if let (Some((folder, format)), Answer::Uncertainty(uncertainty)) = (&plots, &answer) {
        let draw = || requests::plots(&file.case, uncertainty, units).collect::<Vec<_>>();
        for (name, output, plot) in installed(pool.as_ref(), draw) {
            write_plot(folder, &format!("{name}-{output}"), &plot, *format)?;
        }
    }
    let document = || match (&answer, arguments.format) {
        // A terminal gets the results; the report to hand over also has all steps and the case file.
        (Answer::Analysis(_), Format::Html | Format::Markdown) => {
            handed_over(&arguments.case, &file, &answer, units)
        }
        _ => Ok(installed(pool.as_ref(), || answer.document(&file, units))),
    };
    present(arguments.format, arguments.output.file(), document, || answer.json(&file))?;
    if let Some(failure) = unweighed {
        // The exact solution has been printed already.
        return answered(Err(failure), &file, units)
            .context("the evidence could not be weighed, so the case has no headline");
    }
    if let Answer::Uncertainty(uncertainty) = &answer {
        let (done, total) = (uncertainty.propagation.evaluated(), uncertainty.propagation.requested());
        if done < total {
            let ended = format!("ended early: the figures are those of {done} of {total} samples");
            return Err(NoAnswer(ended).into());
        }
        return Ok(());
    }
    let Some(reason) = answer.no_answer() else { return Ok(()) };
    let draws = if samples_out.is_some() { ", and the draws are not written" } else { "" };
    Err(NoAnswer(format!("{reason}{draws}")).into())
}

/// Refuses options that do not go together.
fn check(Asked { request, cases, samples_out, plots, .. }: &Asked) -> Result<()> {
    if let Request::Uncertainty(UncertaintyOptions { indices: Some(_), .. }) = request
        && let Some(rows) = cases.cases.iter().find(|case| is_number(case) && !case.exists())
    {
        let rows = named(rows);
        bail!("--sobol {rows}: write --sobol={rows}; a number after a space is read as a case file");
    }
    if cases.format.is_err() && (samples_out.is_some() || plots.is_some()) {
        bail!("--samples-out and --plots are for the report on one case: leave them out, or --format");
    }
    let writes_csv = matches!(cases.format, Err(Rows::Csv)) || samples_out.is_some();
    if cases.csv_style != CsvStyle::default() && !writes_csv {
        bail!(
            "--csv-style is for the CSV of --format csv or --samples-out: add one of them, or leave it out"
        );
    }
    Ok(())
}

fn is_number(path: &Path) -> bool {
    path.to_str().is_some_and(|name| name.parse::<f64>().is_ok())
}

/// The answer, and the pool of threads if it took long.
fn answer(
    request: &Request,
    case: &Case,
    threads: Option<u16>,
) -> Result<(Result<Answer, Unanswered>, Option<ThreadPool>)> {
    match request.begin(case) {
        Ok(answer) => Ok((answer, None)),
        Err(begun) => {
            let pool = pool(threads)?;
            Ok((in_pool(&pool, |progress| begun.finish(case, progress))?, Some(pool)))
        }
    }
}

/// Refuses results that the case does not have.
fn has_outputs(request: &Request, answer: &Answer) -> Result<()> {
    let (Request::Uncertainty(options), Answer::Uncertainty(uncertainty)) = (request, answer) else {
        return Ok(());
    };
    let is_known = |name: &String| uncertainty.outputs.iter().any(|known| known.output.path() == *name);
    match options.outputs.iter().flatten().find(|name| !is_known(name)) {
        Some(name) => bail!("--outputs {name}: this case has no such result; leave the name out"),
        None => Ok(()),
    }
}

fn write_samples(answer: &Answer, path: &Path, style: CsvStyle) -> Result<()> {
    let written = if matches!(answer, Answer::Estimate(_)) { "draws" } else { "samples" };
    let cannot = || format!("cannot write the {written} to {}", named(path));
    let mut out = BufWriter::new(Sink::open(Some(path)).with_context(cannot)?);
    answer
        .write_samples(style, &mut out)
        .and_then(|()| out.into_inner().map_err(io::IntoInnerError::into_error)?.finish())
        .with_context(cannot)
}

/// The report to hand over.
fn handed_over(path: &Path, file: &CaseFile, answer: &Answer, units: Units) -> Result<Document> {
    let site_plan = if answer.shows_site_plan() { site_plan_beside(path, file, &PROGRAM)? } else { None };
    let mut progress = Progress::new()?;
    let at = &mut |counted, done, total| progress.at(counted, done, total);
    answer.page(file, site_plan.as_ref(), units, at).or_else(|error| match error {
        NoPage::Failure(failure) => answered(Err(failure), file, units),
        NoPage::Drawing(error) => Err(error.into()),
        NoPage::Validation(error) => Err(error.into()),
    })
}

/// Draws with the threads of the pool, if there is one.
fn installed<T: Send>(pool: Option<&ThreadPool>, draw: impl FnOnce() -> T + Send) -> T {
    match pool {
        Some(pool) => pool.install(draw),
        None => draw(),
    }
}
