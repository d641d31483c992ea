//! Checks the outputs of a command: each can be written, and replaces neither an input, nor any other case
//! file, nor another output.

use std::borrow::Cow;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use case::CaseFile;
use report::PictureFormat;
use requests::plan_path;
use same_file::{Handle, is_same_file};

use crate::arguments::{Asked, Command, Format, Rows};
use crate::ciss::files_of;
use crate::files::{named, read};
use crate::live;
use crate::validate::{FIELD_PLOTS, VALIDATION_PLOTS};

/// A file that is written.
struct Output<'a> {
    /// The option that names it.
    option: &'static str,
    path: &'a Path,
    /// The ending of a proposed name.
    ending: &'static str,
}

/// A folder into which files are written under names of the program's own.
struct Folder<'a> {
    option: &'static str,
    path: &'a Path,
    is_name: fn(&str) -> bool,
}

/// A file that is read.
struct Input<'a> {
    /// Its description within a sentence.
    what: &'static str,
    path: Cow<'a, Path>,
}

impl<'a> Input<'a> {
    fn of(what: &'static str, paths: impl IntoIterator<Item = &'a PathBuf>) -> impl Iterator<Item = Self> {
        paths.into_iter().map(move |path| Self { what, path: Cow::Borrowed(path) })
    }

    fn of_table(path: PathBuf) -> Self {
        Self { what: "the table", path: Cow::Owned(path) }
    }
}

const CASE: &str = "the case file";

/// The files of a command.
#[derive(Default)]
struct Files<'a> {
    inputs: Vec<Input<'a>>,
    outputs: Vec<Output<'a>>,
    folder: Option<Folder<'a>>,
}

/// Refuses to overwrite an input, or to write where nothing can be written, and makes the folder for files.
/// To be called before anything is computed.
pub(crate) fn check(command: &Command) -> Result<()> {
    check_files(files(command))
}

/// The same for a question.
pub(crate) fn check_asked(asked: &Asked) -> Result<()> {
    check_files(of_asked(asked))
}

fn check_files(Files { mut inputs, outputs, folder }: Files<'_>) -> Result<()> {
    // Looks for the pictures that cases name only if one of them could be overwritten.
    if folder.is_some() || outputs.iter().any(|output| is_file(output.path)) {
        let cases = inputs.iter().filter(|input| input.what == CASE);
        let plans: Vec<PathBuf> = cases.filter_map(|case| site_plan_of(&case.path)).collect();
        inputs.extend(plans.into_iter().map(|path| Input { what: "the site plan", path: Cow::Owned(path) }));
    }
    let named_so = outputs.iter().map(|output| (output.option, output.path));
    let folders = folder.iter().map(|folder| (folder.option, folder.path));
    if let Some((option, _)) = named_so.chain(folders).find(|(_, path)| *path == Path::new("-")) {
        bail!("{option} - : standard output is for the report; give a name, or ./- for a file called -");
    }
    for output in &outputs {
        let Output { option, path, .. } = output;
        let (name, other) = (named(path), proposal(output));
        if let Some(Input { what, path: input }) = inputs.iter().find(|input| is_read_from(&input.path, path))
        {
            let input = if is_standard_input(input) {
                "that comes in on standard input".to_owned()
            } else {
                named(input).to_string()
            };
            bail!(
                "{option} {name} would overwrite {what} {input}: give another name, such as {option} {other}"
            );
        }
        has_folder(option, path)?;
        if let Some(format) = other_format(output) {
            bail!(
                "{option} {name} would not have the format of its name: {format}, or write {option} {other}"
            );
        }
        if is_toml(path) {
            bail!(
                "{option} {name} would overwrite a .toml file that exists, which may be a case: give another name, such as {option} {other}"
            );
        }
    }
    if let [first, second] = &outputs[..]
        && is_one_file(first.path, second.path)
    {
        bail!(
            "{} and {} would both write to {}: give another name to one of the two, such as {} {}",
            first.option,
            second.option,
            named(first.path),
            second.option,
            proposal(second)
        );
    }
    match folder {
        Some(folder) => {
            check_folder(&folder, &inputs, &outputs)?;
            let Folder { option, path, .. } = folder;
            fs::create_dir_all(path)
                .with_context(|| format!("{option} {} cannot be made a folder", named(path)))
        }
        None => Ok(()),
    }
}

/// Refuses a file whose folder does not exist.
pub(crate) fn has_folder(option: &str, path: &Path) -> Result<()> {
    let folder = parent(path);
    if !folder.is_dir() {
        bail!("{option} {}: there is no folder {}; make it first", named(path), named(folder));
    }
    Ok(())
}

fn check_folder(
    Folder { option, path: folder, is_name }: &Folder<'_>,
    inputs: &[Input<'_>],
    outputs: &[Output<'_>],
) -> Result<()> {
    let shown = named(folder);
    for output in outputs {
        let is_theirs = output.path.file_name().and_then(|name| name.to_str()).is_some_and(is_name);
        if is_theirs && is_same_file(parent(output.path), folder).unwrap_or(false) {
            bail!(
                "{} and {option} {shown} may both write to {}: give another name to the first, such as {} {}",
                output.option,
                named(output.path),
                output.option,
                proposal(output)
            );
        }
    }
    // A folder that cannot be read cannot be written to either, which is reported then.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let (name, path) = (entry.file_name(), entry.path());
        if !name.to_str().is_some_and(is_name) {
            continue;
        }
        let input = inputs.iter().find(|input| is_read_from(&input.path, &path));
        let what = match input {
            Some(input) => input.what,
            None if is_toml(&path) => CASE,
            None => continue,
        };
        bail!("{option} {shown} would overwrite {}, which is {what}: give another folder", named(&path));
    }
    Ok(())
}

fn files(command: &Command) -> Files<'_> {
    match command {
        // It refuses whatever exists when it writes.
        Command::New(_) => Files::default(),
        // Its files are checked before it is asked.
        Command::Question(_) => Files::default(),
        Command::Table(arguments) => Files {
            inputs: Input::of("the table", &arguments.cases)
                .chain(Input::of("the template", &arguments.template))
                .collect(),
            outputs: output(arguments.output.file(), "-results.csv"),
            folder: None,
        },
        Command::Draw(arguments) => Files {
            inputs: Input::of(CASE, [&arguments.case])
                .chain(Input::of("the site plan", &arguments.site_plan))
                .collect(),
            outputs: output(arguments.output.file(), "-drawing.svg"),
            folder: None,
        },
        Command::Validate(arguments) => Files {
            inputs: Input::of("the table", &arguments.recorders)
                .chain(arguments.field.iter().flat_map(|path| files_of(path)).map(Input::of_table))
                .collect(),
            outputs: output(arguments.output.file(), ending(arguments.format, PAGE)),
            folder: arguments.plots.as_deref().map(|path| Folder {
                option: "--plots",
                path,
                is_name: if !arguments.field.is_empty() {
                    |name| without_ending(name).is_some_and(|name| FIELD_PLOTS.contains(&name))
                } else {
                    |name| without_ending(name).is_some_and(|name| VALIDATION_PLOTS.contains(&name))
                },
            }),
        },
        Command::Schema(arguments) => {
            Files { outputs: output(arguments.output.file(), ".schema.json"), ..Files::default() }
        }
        Command::Man(arguments) => Files {
            folder: arguments.output_dir.as_deref().map(|path| Folder {
                option: "--output-dir",
                path,
                is_name: is_page,
            }),
            ..Files::default()
        },
        Command::Explain(arguments) => Files {
            outputs: output(arguments.output.file(), ending(arguments.format, TOPIC)),
            ..Files::default()
        },
        // Standard output is theirs.
        Command::Completions(_) => Files::default(),
    }
}

fn of_asked(asked: &Asked) -> Files<'_> {
    let Asked { cases, is_live, page, samples_out, plots, .. } = asked;
    let ending = match cases.format {
        Ok(format) => ending(format, REPORT),
        Err(Rows::Csv) => "-rows.csv",
        Err(Rows::Jsonl) => "-rows.jsonl",
    };
    let page = match page {
        Some(page) => Some(Cow::Borrowed(page.as_path())),
        // If it cannot be found, the report fails with a message.
        None if *is_live => live::beside().ok().map(Cow::Owned),
        None => None,
    };
    let page = page.map(|path| Input { what: "the page", path });
    let samples = samples_out.as_deref();
    let samples = samples.map(|path| Output { option: "--samples-out", path, ending: "-samples.csv" });
    Files {
        inputs: Input::of(CASE, &cases.cases).chain(page).collect(),
        outputs: output(cases.output.file(), ending).into_iter().chain(samples).collect(),
        folder: plots.as_ref().map(|(path, _)| Folder { option: "--plots", path, is_name: is_plot }),
    }
}

/// The path of the picture that a case names, if the case can be read and names one.
fn site_plan_of(case: &Path) -> Option<PathBuf> {
    if !is_file(case) {
        return None;
    }
    let (name, bytes) = read(case).ok()?;
    let file = CaseFile::parse(&name, std::str::from_utf8(&bytes).ok()?).ok()?;
    file.case.site_plan.as_ref().map(|plan| plan_path(case, plan))
}

/// The option that makes a file have the format of its name, if that is another format of a report.
fn other_format(output: &Output<'_>) -> Option<&'static str> {
    if ![REPORT, PAGE, TOPIC].iter().any(|endings| endings.contains(&output.ending)) {
        return None;
    }
    let (_, wanted) = output.ending.rsplit_once('.')?;
    let given = output.path.extension()?.to_str()?.to_ascii_lowercase();
    match given.as_str() {
        "html" | "htm" if wanted != "html" => Some("add --format html"),
        "json" if wanted != "json" => Some("add --format json"),
        "md" if wanted != "md" => Some("add --format markdown"),
        "pdf" => Some("write --format html and print that page as PDF"),
        _ => None,
    }
}

/// The endings of proposed names, in the order of [`ending`].
type Endings = [&'static str; 4];
const REPORT: Endings = ["-report.txt", "-report.json", "-report.html", "-report.md"];
const PAGE: Endings = ["-page.txt", "-page.json", "-page.html", "-page.md"];
const TOPIC: Endings = ["-topic.txt", "-topic.json", "-topic.html", "-topic.md"];

fn ending(format: Format, [text, json, html, markdown]: Endings) -> &'static str {
    match format {
        Format::Text => text,
        Format::Json => json,
        Format::Html => html,
        Format::Markdown => markdown,
    }
}

fn output<'a>(path: Option<&'a Path>, ending: &'static str) -> Vec<Output<'a>> {
    path.map(|path| Output { option: "-o", path, ending }).into_iter().collect()
}

fn is_plot(name: &str) -> bool {
    without_ending(name).is_some_and(|name| name.starts_with("tornado-") || name.starts_with("histogram-"))
}

/// The name of a picture without the ending that shows its format.
fn without_ending(name: &str) -> Option<&str> {
    let (name, ending) = name.rsplit_once('.')?;
    PictureFormat::ALL.iter().any(|format| format.extension() == ending).then_some(name)
}

fn is_page(name: &str) -> bool {
    name.ends_with(".1") && name.starts_with("deltav")
}

/// A proposed name, based on the refused one.
fn proposal(output: &Output<'_>) -> String {
    let mut name = output.path.file_stem().map_or_else(OsString::new, OsString::from);
    name.push(output.ending);
    named(&output.path.with_file_name(name)).to_string()
}

fn is_standard_input(case: &Path) -> bool {
    case == Path::new("-")
}

/// Through links of either kind. Devices and pipes may be read and written at once.
fn is_read_from(case: &Path, output: &Path) -> bool {
    if !is_file(output) {
        false
    } else if is_standard_input(case) {
        matches!((Handle::stdin(), Handle::from_path(output)), (Ok(input), Ok(output)) if input == output)
    } else {
        is_file(case) && is_same_file(case, output).unwrap_or(false)
    }
}

/// Whether two names are of one file, which need not exist yet.
fn is_one_file(first: &Path, second: &Path) -> bool {
    if is_file(first) {
        return is_file(second) && is_same_file(first, second).unwrap_or(false);
    }
    !first.exists()
        && first.file_name() == second.file_name()
        && is_same_file(parent(first), parent(second)).unwrap_or(false)
}

/// Whether it exists, and its name or that of its target ends so.
fn is_toml(path: &Path) -> bool {
    let is_called = |path: &Path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    is_file(path) && (is_called(path) || fs::canonicalize(path).is_ok_and(|path| is_called(&path)))
}

fn is_file(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| metadata.is_file())
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}
