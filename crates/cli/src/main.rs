//! `deltav`: arguments, files and exit codes. All else is in the libraries.

mod arguments;
mod batch;
mod draw;
mod estimates;
mod live;
mod new;
mod outputs;
mod pages;
mod progress;
mod reconstruction;
mod sink;
mod table;
mod terminal;

use std::fs;
use std::io::{self, BufWriter, ErrorKind, Read as _, Write as _};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use analysis::{Analysis, Beside, Estimated, Failure, Output, Plan, Stage, Sweep, Uncertainty, Weighed};
use anyhow::{Context as _, Result};
use arguments::{
    Arguments, CasesArguments, Command, ExplainArguments, Format, PlotsFormat, ReportArguments,
    SensitivityArguments, UncertaintyArguments, UnitSystem, ValidateArguments,
};
use batch::{Job, Rows};
use case::{Case, CaseFile, Diagnostics, Text};
use rayon::{ThreadPool, ThreadPoolBuilder};
use report::{
    Answer, Csv, CsvStyle, Document, Drawing, DrawingError, PictureFormat, Supplements, Table, Units,
};
use sink::Sink;
use uncertainty::{SamplingMethod, Settings};
use validation::{Data, Validation};

/// What a command makes of a case.
type Analyse = fn(&Case) -> Result<Analysis, Failure>;

/// The files that `deltav validate --plots` writes, without their endings.
const VALIDATION_PLOTS: [&str; 2] = ["computed-against-measured", "reconstructed-speed"];

/// Those of `deltav validate --field --plots`.
const FIELD_PLOTS: [&str; 2] = ["estimated-against-recorded", "ranks-of-recorders"];

/// The case is well formed, but no answer exists; or a claim of the validation fails.
const NO_ANSWER: u8 = 1;
/// The case file or the command line is wrong.
const WRONG_INPUT: u8 = 2;

fn main() -> ExitCode {
    let command = match arguments::parse(std::env::args_os()) {
        Ok(command) => command,
        Err(error) => return not_a_command(&error),
    };
    match outputs::check(&command).and_then(|()| run(command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing is left to be done where standard error is closed.
            let _ = writeln!(io::stderr(), "{}", message(&error));
            ExitCode::from(status(&error))
        }
    }
}

/// Prints the help or the version that was asked for, or what is wrong with the command line.
fn not_a_command(error: &clap::Error) -> ExitCode {
    if error.use_stderr() {
        // The message quotes the command line, which a script may have made of the name of a file.
        let shown = std::env::args_os().map(|argument| case::shown(&argument.to_string_lossy()).into_owned());
        let again = arguments::parse(shown).err();
        // Nothing is left to be done where standard error is closed.
        let _ = again.as_ref().unwrap_or(error).print();
        return ExitCode::from(WRONG_INPUT);
    }
    match error.print() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let _ = writeln!(io::stderr(), "error: cannot write to standard output: {error}");
            ExitCode::from(WRONG_INPUT)
        }
        _ => ExitCode::SUCCESS,
    }
}

fn run(command: Command) -> Result<()> {
    match command {
        Command::New(arguments) => new::new(&arguments),
        Command::Reconstruct(arguments) => reconstruction::report(arguments),
        Command::Impact(arguments) => report_or_rows(arguments, analysis::impact),
        Command::Motion(arguments) => report_or_rows(arguments, analysis::motion),
        Command::Crush(arguments) => report_or_rows(arguments, analysis::crush),
        Command::Check(arguments) => report_judgement(&arguments),
        Command::Compare(arguments) => report_comparison(arguments),
        Command::Sensitivity(arguments) => report_sensitivity(&arguments),
        Command::Uncertainty(arguments) => report_uncertainty(arguments),
        Command::Estimate(arguments) => estimates::report(&arguments),
        Command::Table(arguments) => table::table(&arguments),
        Command::Draw(arguments) => draw::draw(&arguments),
        Command::Validate(arguments) => validate(&arguments),
        Command::Explain(arguments) => explain(&arguments),
        Command::Schema(arguments) => write(arguments.output.file(), case::json_schema()),
        Command::Completions(arguments) => pages::completions(arguments.shell),
        Command::Man(arguments) => pages::manual(arguments.output_dir.as_deref()),
    }
}

/// What is said of an error: each cause once, and nothing of it acts on the terminal.
fn message(error: &anyhow::Error) -> String {
    // Diagnostics render themselves with the word "error" and their place in the file.
    if error.is::<Diagnostics>() {
        return format!("{error:#}");
    }
    let mut message = String::from("error");
    for cause in error.chain().map(ToString::to_string) {
        // Some libraries quote the cause that they also name.
        if !message.ends_with(&cause) {
            message.push_str(": ");
            message.push_str(&cause);
        }
    }
    // A message may quote the command line or a file, and its lines are the program's own.
    case::shown_lines(&message).trim_end_matches('\n').to_owned()
}

fn status(error: &anyhow::Error) -> u8 {
    let is_no_answer = error.is::<NoAnswer>()
        || error.is::<NotReproduced>()
        || error.is::<batch::Incomplete>()
        || error.is::<DrawingError>();
    if is_no_answer { NO_ANSWER } else { WRONG_INPUT }
}

fn report_or_rows(ReportArguments { cases, live, page }: ReportArguments, analyse: Analyse) -> Result<()> {
    if live {
        return live::report(cases, page.as_deref(), analyse, &|_, _, _| Ok(None));
    }
    let answer = |case: &Case| analyse(case).map(|analysis| Answer::Analysis(Box::new(analysis)));
    match of_cases(cases, Table::Analyses, &answer)? {
        Some(arguments) => report_analysis(&arguments, analyse),
        None => Ok(()),
    }
}

/// Writes a row for each case, where rows are asked for; else the arguments for the report on one.
fn of_cases(
    arguments: CasesArguments,
    table: Table,
    answer: &(dyn Fn(&Case) -> Result<Answer, Failure> + Sync),
) -> Result<Option<Arguments>> {
    let CasesArguments { cases, format, units, threads, csv_style, output } = arguments;
    let mut cases = with_folders(cases)?;
    let format = match format.of_one() {
        Ok(format) => match (cases.pop(), cases.len()) {
            (Some(case), 0) => return Ok(Some(Arguments { case, format, units, output })),
            (_, others) => anyhow::bail!(
                "{} case files are given, and a report is on one; use --format csv or --format jsonl for a row each",
                others + 1
            ),
        },
        // Rows of several cases have one header: its units are not those of a case.
        Err(arguments::Rows::Csv) => {
            let units = units.map_or(Units::Si, Units::from);
            Rows::Csv(Csv { table, units, style: csv_style.into() })
        }
        Err(arguments::Rows::Jsonl) => Rows::Jsonl,
    };
    batch::write(&Job { cases: &cases, answer, format }, &pool(threads)?, output.file())?;
    Ok(None)
}

/// The case files, with those of each folder in the order of their names.
fn with_folders(paths: Vec<PathBuf>) -> Result<Vec<PathBuf>> {
    let mut cases = Vec::new();
    for path in paths {
        if !path.is_dir() {
            cases.push(path);
            continue;
        }
        let cannot = || format!("cannot read the folder {}", named(&path));
        let mut inside = Vec::new();
        for entry in fs::read_dir(&path).with_context(cannot)? {
            inside.push(entry.with_context(cannot)?.path());
        }
        inside.retain(|path| path.extension().is_some_and(|ending| ending == "toml") && !path.is_dir());
        if inside.is_empty() {
            anyhow::bail!("{} is a folder without .toml files: name the case files", named(&path));
        }
        inside.sort();
        cases.append(&mut inside);
    }
    Ok(cases)
}

fn report_analysis(arguments: &Arguments, analyse: Analyse) -> Result<()> {
    let file = case_file(&arguments.case)?;
    let units = units(arguments.units, &file);
    let analysis = answered(analyse(&file.case), &file, units)?;
    let document = || match arguments.format {
        // In a terminal the results; the report to hand over has all steps and the case file besides.
        Format::Text | Format::Json => Ok(report::results(&file.case, &analysis, units)),
        Format::Html | Format::Markdown => handover(&arguments.case, &file, &analysis, None, None, units),
    };
    present(arguments, document, || report::json(&file, &analysis))
}

/// Writes a document, or its data as JSON, to where the arguments say. Only what is written is made.
fn present<E>(
    arguments: &Arguments,
    document: impl FnOnce() -> Result<Document>,
    json: impl FnOnce() -> Result<String, E>,
) -> Result<()>
where
    anyhow::Error: From<E>,
{
    present_as(arguments.format, arguments.output.file(), document, json)
}

fn present_as<E>(
    format: Format,
    output: Option<&Path>,
    document: impl FnOnce() -> Result<Document>,
    json: impl FnOnce() -> Result<String, E>,
) -> Result<()>
where
    anyhow::Error: From<E>,
{
    match format {
        Format::Text if output.is_none() => terminal::print(&document()?),
        Format::Text => write(output, document()?.text()),
        Format::Json => write(output, json()?),
        Format::Html => write(output, document()?.html()),
        Format::Markdown => write(output, document()?.markdown()),
    }
}

/// The report to hand over, with what the uncertain inputs make of the answer.
fn handover(
    path: &Path,
    file: &CaseFile,
    analysis: &Analysis,
    weighed: Option<&Weighed>,
    estimated: Option<&Estimated>,
    units: Units,
) -> Result<Document> {
    let mut progress = progress::Progress::new()?;
    let beside = analysis::beside(&file.case, analysis, &mut |stage, done, total| {
        progress.at(counted(stage), done, total)
    });
    drop(progress);
    let Beside { uncertainty, sensitivity } = answered(beside, file, units)?;
    let is_followed = analysis.travel.iter().any(Option::is_some);
    let site_plan = if is_followed { draw::plan_of_case(path, file)? } else { None };
    let validation = validation::validate(&Data::built_in())?;
    let supplements = Supplements {
        uncertainty: uncertainty.as_ref(),
        sensitivity: sensitivity.as_ref(),
        validation: Some(&validation),
        site_plan: site_plan.as_ref(),
        weighed,
        estimated,
    };
    Ok(report::handover(file, analysis, supplements, units)?)
}

fn report_judgement(arguments: &Arguments) -> Result<()> {
    let file = case_file(&arguments.case)?;
    let judgement = analysis::judge(&file.case);
    let document = || Ok(report::judgement(&file, &judgement, units(arguments.units, &file)));
    present(arguments, document, || report::judgement_json(&file, &judgement))
}

fn explain(ExplainArguments { topic, format, output }: &ExplainArguments) -> Result<()> {
    let topic = match topic.as_slice() {
        [] => None,
        words => Some(report::topic(&words.join(" "))?),
    };
    let document = || Ok(topic.map_or_else(report::list_of_topics, report::explanation));
    present_as(*format, output.file(), document, || {
        topic.map_or_else(report::topics_json, report::topic_json)
    })
}

fn report_comparison(arguments: CasesArguments) -> Result<()> {
    let answer = |case: &Case| analysis::compare(case).map(|answer| Answer::Comparison(Box::new(answer)));
    let Some(arguments) = of_cases(arguments, Table::Comparisons, &answer)? else { return Ok(()) };
    let file = case_file(&arguments.case)?;
    let units = units(arguments.units, &file);
    let comparison = answered(analysis::compare(&file.case), &file, units)?;
    let document = || Ok(report::comparison(&file.case, &comparison, units));
    present(&arguments, document, || report::comparison_json(&file, &comparison))
}

fn report_sensitivity(
    SensitivityArguments { arguments, pdof_step, pdof_steps }: &SensitivityArguments,
) -> Result<()> {
    let file = case_file(&arguments.case)?;
    let sweep = Sweep { step: pdof_step.to_radians(), steps: *pdof_steps };
    let units = units(arguments.units, &file);
    let sensitivity = answered(analysis::sensitivity(&file.case, sweep), &file, units)?;
    let document = || Ok(report::sensitivity(&file.case, &sensitivity, units));
    present(arguments, document, || report::sensitivity_json(&file, &sensitivity))
}

fn report_uncertainty(arguments: UncertaintyArguments) -> Result<()> {
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
    if done < total { Err(batch::Incomplete::EndedSamples { done, total }.into()) } else { Ok(()) }
}

fn is_number(path: &Path) -> bool {
    path.to_str().is_some_and(|name| name.parse::<f64>().is_ok())
}

fn write_plot(folder: &Path, name: &str, plot: &Drawing, format: PlotsFormat) -> Result<()> {
    let format = PictureFormat::from(format);
    let path = folder.join(format!("{name}.{}", format.extension()));
    draw::write_picture(Some(&path), plot, format)
}

impl From<PlotsFormat> for PictureFormat {
    fn from(format: PlotsFormat) -> Self {
        match format {
            PlotsFormat::Svg => Self::Svg,
            PlotsFormat::Png => Self::Png,
            PlotsFormat::Pdf => Self::Pdf,
        }
    }
}

fn counted(stage: Stage) -> &'static str {
    match stage {
        Stage::Samples => "samples",
        Stage::Indices => "rows for the indices",
    }
}

fn propagate(
    case: &Case,
    plan: &Plan,
    wanted: &(dyn Fn(Output) -> bool + Sync),
    pool: &ThreadPool,
) -> Result<Result<Uncertainty, Failure>> {
    let mut progress = progress::Progress::new()?;
    Ok(pool.install(|| {
        analysis::uncertainty_of(case, plan, wanted, &mut |stage, done, total| {
            progress.at(counted(stage), done, total)
        })
    }))
}

fn pool(threads: Option<u16>) -> Result<ThreadPool> {
    /// (byte) what a search back from rests needs in a build without optimisation, and more.
    const STACK: usize = 16 << 20;
    // Without a number, rayon takes one thread for each processor.
    let threads = threads.map_or(0, usize::from);
    let builder = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK);
    builder.build().context("cannot start the threads")
}

fn case_file(path: &Path) -> Result<CaseFile> {
    let (name, bytes) = read(path)?;
    Ok(CaseFile::parse_bytes(&name, &bytes).map_err(|errors| errors.in_words_of(&report::PROGRAM))?)
}

/// A path as messages write it.
fn named(path: &Path) -> Text {
    path.display().to_string().into()
}

fn units(asked: Option<UnitSystem>, file: &CaseFile) -> Units {
    asked.map_or_else(|| Units::of_case(&file.case), Units::from)
}

impl From<arguments::CsvStyle> for CsvStyle {
    fn from(asked: arguments::CsvStyle) -> Self {
        match asked {
            arguments::CsvStyle::International => Self::International,
            arguments::CsvStyle::European => Self::European,
        }
    }
}

impl From<UnitSystem> for Units {
    fn from(asked: UnitSystem) -> Self {
        match asked {
            UnitSystem::Si => Self::Si,
            UnitSystem::Us => Self::Us,
            UnitSystem::Uk => Self::Uk,
        }
    }
}

/// Why a well-formed case has no answer, in the units of the reader.
#[derive(Debug)]
struct NoAnswer(String);

impl std::fmt::Display for NoAnswer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NoAnswer {}

/// The answer, or a failure that says so in the units of the reader; what is wrong with the file speaks its
/// own.
fn answered<T>(answer: Result<T, Failure>, file: &CaseFile, units: Units) -> Result<T> {
    answer.map_err(|failure| match failure {
        Failure::Case(faults) => file.diagnostics(&faults, &report::PROGRAM).into(),
        Failure::Ranges(_) => failure.into(),
        failure => NoAnswer(report::no_answer(&failure, units)).into(),
    })
}

/// Claims of the validation that fail: how many of how many, and the first.
#[derive(Debug)]
struct NotReproduced {
    failed: usize,
    claimed: usize,
    first: String,
}

impl std::fmt::Display for NotReproduced {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { failed, claimed, first } = self;
        write!(f, "{failed} of {claimed} numbers that are claimed to reproduce do not; the first: {first}")
    }
}

impl std::error::Error for NotReproduced {}

fn validate(arguments: &ValidateArguments) -> Result<()> {
    if let Some(path) = &arguments.field {
        return validate_field(path, arguments);
    }
    show(&validation::validate(&Data::built_in())?, arguments)
}

/// Particles of an island, of which a pair has sixteen: the intervals of 350 vehicles need no more.
const PARTICLES_OF_PAIR: usize = 128;

fn validate_field(path: &Path, arguments: &ValidateArguments) -> Result<()> {
    /// (bytes) a table of all crashes that NHTSA has sampled is smaller.
    const LARGEST_TABLE: usize = 1 << 28;
    let name = named(path).to_string();
    if path.is_dir() {
        anyhow::bail!("{name} is a folder: name the table in it");
    }
    let bytes = fs::File::open(path)
        .and_then(|file| read_at_most(LARGEST_TABLE, file))
        .with_context(|| format!("cannot read {name}"))?;
    if bytes.len() > LARGEST_TABLE {
        anyhow::bail!("{name} is larger than {} MB: split it", LARGEST_TABLE >> 20);
    }
    let text = String::from_utf8(bytes)
        .with_context(|| format!("{name} is no text in UTF-8: save the table as CSV, encoded in UTF-8"))?;
    let pairs = field::read(&text).with_context(|| name.clone())?;
    let options = field::Options {
        particles: PARTICLES_OF_PAIR,
        seed: arguments.seed,
        other: arguments.other,
        crush: field::KnownCrush::Both,
    };
    let mut progress = progress::Progress::new()?;
    let judged = pool(arguments.threads)?.install(|| {
        field::judge(&pairs, &evidence::FITTED, &options, &mut |done, total| {
            progress.at("pairs", done, total)
        })
    });
    let judged = judged.with_context(|| name.clone())?;
    let document = || Ok(report::field(&judged, &name));
    present_as(arguments.format, arguments.output.file(), document, || report::field_json(&judged))?;
    let plots = [report::estimated_against_recorded(&judged), report::ranks_of_recorders(&judged)];
    write_plots(FIELD_PLOTS, plots, arguments)?;
    let (done, total) = (judged.finished, judged.pairs);
    if done < total { Err(batch::Incomplete::EndedPairs { done, total }.into()) } else { Ok(()) }
}

fn write_plots<const N: usize>(
    names: [&str; N],
    plots: [Drawing; N],
    arguments: &ValidateArguments,
) -> Result<()> {
    let Some(folder) = &arguments.plots else { return Ok(()) };
    for (name, plot) in names.into_iter().zip(plots) {
        write_plot(folder, name, &plot, arguments.plots_format)?;
    }
    Ok(())
}

/// Writes everything first: what fails is to be seen in full.
fn show(validation: &Validation, arguments: &ValidateArguments) -> Result<()> {
    let document = || Ok(report::validation(validation));
    present_as(arguments.format, arguments.output.file(), document, || report::validation_json(validation))?;
    let plots = [report::computed_against_measured(validation), report::reconstructed_speed(validation)];
    write_plots(VALIDATION_PLOTS, plots, arguments)?;
    let failures = validation.failures();
    match failures.first() {
        None => Ok(()),
        Some((first, _)) => {
            Err(NotReproduced { failed: failures.len(), claimed: validation.claimed(), first: first.clone() }
                .into())
        }
    }
}

/// One byte more than what is read may have is enough to refuse it; a device or a pipe may have no end.
fn read_at_most(most: usize, source: impl io::Read) -> io::Result<Vec<u8>> {
    // Most cases fit in this.
    let mut bytes = Vec::with_capacity(1 << 13);
    source.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// A file with a part of a case, as text.
fn read_text(path: &Path) -> Result<(String, String)> {
    let (name, bytes) = read(path)?;
    let text = String::from_utf8(bytes).with_context(|| format!("{} is no text in UTF-8", named(path)))?;
    Ok((name, text))
}

/// The name to show in messages, and what is in the file.
fn read(path: &Path) -> Result<(String, Vec<u8>)> {
    if path == Path::new("-") {
        let bytes = read_at_most(CaseFile::LARGEST_FILE, io::stdin())
            .context("cannot read the case from standard input")?;
        return Ok(("standard input".to_owned(), bytes));
    }
    let name = path.display().to_string();
    if path.is_dir() {
        anyhow::bail!("{name} is a folder: name the case file in it", name = named(path));
    }
    let bytes = fs::File::open(path)
        .and_then(|file| read_at_most(CaseFile::LARGEST_FILE, file))
        .with_context(|| format!("cannot read the case file {}", named(path)))?;
    Ok((name, bytes))
}

fn write(path: Option<&Path>, output: impl AsRef<[u8]>) -> Result<()> {
    let written = Sink::open(path).and_then(|mut sink| {
        sink.write_all(output.as_ref())?;
        sink.finish()
    });
    match (written, path) {
        (written, Some(path)) => {
            written.with_context(|| format!("cannot write the output to {}", named(path)))
        }
        // Whoever reads has read enough, as `head` does.
        (Err(error), None) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        (written, None) => written.context("cannot write to standard output"),
    }
}

#[cfg(test)]
mod tests {
    use std::{fs, io};

    use case::CaseFile;

    use crate::arguments::{Format, PlotsFormat, ValidateArguments};

    use super::{NO_ANSWER, message, read_at_most, show, status};

    #[test]
    fn a_source_without_end_is_left_after_one_byte_too_many() {
        assert_eq!(
            read_at_most(CaseFile::LARGEST_FILE, io::repeat(b'x')).unwrap().len(),
            CaseFile::LARGEST_FILE + 1
        );
    }

    #[test]
    fn a_cause_is_said_once_and_acts_on_nothing() {
        let full = || io::Error::other("No space left");
        let quoted =
            anyhow::Error::new(full()).context("External: No space left").context("cannot write to x");
        assert_eq!(message(&quoted), "error: cannot write to x: External: No space left");
        let two = anyhow::Error::new(full()).context("cannot write\n  to \u{1b}[31mx");
        assert_eq!(message(&two), "error: cannot write\n  to ␛[31mx: No space left");
    }

    #[test]
    fn a_claim_that_fails_ends_with_status_1_after_the_page_is_written() {
        let page = std::env::temp_dir().join(format!("deltav-failing-{}.txt", std::process::id()));
        let output = page.clone().into();
        let arguments = ValidateArguments {
            format: Format::Text,
            output,
            field: None,
            other: false,
            seed: 1,
            threads: None,
            plots: None,
            plots_format: PlotsFormat::Svg,
        };
        let mut validation = validation::validate(&validation::Data::built_in()).unwrap();
        assert!(show(&validation, &arguments).is_ok());
        validation.energies[3].normal.ours *= 1.02;
        let error = show(&validation, &arguments).unwrap_err();
        assert_eq!(
            error.to_string(),
            "1 of 240 numbers that are claimed to reproduce do not; the first: SAE 871993, Table 1, test 5, normal loss"
        );
        assert_eq!((message(&error), status(&error)), (format!("error: {error}"), NO_ANSWER));
        assert!(fs::read_to_string(&page).unwrap().contains("Failing: SAE 871993, Table 1, test 5, normal"));
        fs::remove_file(&page).unwrap();
    }
}
