//! The command line.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use analysis::EstimatePlan;
use case::{Dimension, Quantity, SeverityPrior, Template, read_quantity};
use clap::builder::{
    MapValueParser, PathBufValueParser, PossibleValue, PossibleValuesParser, StringValueParser,
    TypedValueParser, ValueParserFactory,
};
use clap::{Arg, Args, CommandFactory as _, FromArgMatches as _, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use report::{AvoidPicture, CsvStyle, PictureFormat, Subject, Units};
use requests::{
    AvoidOptions, EstimateOptions, ReconstructOptions, Request, SensitivityOptions, UncertaintyOptions,
};
use tables::Job;
use uncertainty::{InvalidRequest, MAX_SAMPLES, MIN_SAMPLES, SamplingMethod};

/// Reconstructs a two-vehicle collision from its damage.
#[derive(Debug, Parser)]
#[command(
    name = "deltav",
    bin_name = "deltav",
    version,
    subcommand_required = true,
    arg_required_else_help = true,
    before_help = "It finds the speed at which the impact dissipates the energy of the damage (Brach & Brach, \
        SAE 980025). A case is a TOML file: `deltav new` writes one, fixtures/sae-980025.toml is the paper's.",
    after_help = "Exit status: 0 done; 1 no answer, or a claim of validate fails; 2 wrong case file or \
        command line.\n\n\
        Which command: `deltav explain which command`. If neither speed is known: `deltav estimate`."
)]
pub(crate) enum Command {
    /// Write a commented case file to start from
    #[command(
        before_help = "The file runs as it is, but its numbers are made up: replace them with yours. Each \
            line says what its number is. An existing file is not overwritten.",
        after_help = format!("Templates:\n{}\n\n\
            Examples:\n  deltav new -o case.toml\n  deltav new --template barrier --units us -o \
            case.toml\n  deltav reconstruct case.toml\n\n\
            More: `deltav explain which command`.", listed(templates()))
    )]
    New(NewArguments),
    #[command(flatten)]
    Question(Question),
    /// Compute a row of results for each row of a table (Parquet, CSV)
    #[command(
        before_help = "Each row is a case, read and solved as a case file is, with the same results to \
            the last bit. The template, a case file or a part of one, holds what all rows share; a row \
            replaces or completes it. A row that is wrong, or has no answer, gets a message in the column \
            \"error\"; the others are not affected. A column is named after the key and the unit: \
            \"vehicle1.mass [kg]\".",
        after_help = "Examples:\n  deltav table crashes.parquet --template case.toml -o results.parquet\n  \
            deltav table crashes.csv --template case.toml --job crush --keep id,year -o results.csv\n  \
            deltav table crashes.csv --template case.toml --samples 1000 -o intervals.csv\n\n\
            Exit status: 1 if a row has an error. Ctrl-C ends the run and keeps the rows that were \
            finished.\n\n\
            More: `deltav explain table`."
    )]
    Table(TableArguments),
    /// Draw the scene, motion, damage or an estimate (SVG, PNG, PDF)
    #[command(
        before_help = "A case with [reconstruct] is reconstructed first; one with both speeds is computed \
            forward. Scene, motion and damage are to scale. The number of warnings goes to standard error.",
        after_help = format!("What to draw:\n{}\n\n\
            Examples:\n  deltav draw fixtures/sae-980025.toml --what scene --plain -o exhibit.pdf\n  \
            deltav draw fixtures/estimate.toml --what estimate -o estimate.svg\n  \
            deltav draw my.toml --what motion --site-plan map.png --plan-corner \"0 m, 0 m\" \
            --plan-width \"60 m\"\n\n\
            More: `deltav explain drawing`, `deltav explain site plan`.", listed(drawings()))
    )]
    Draw(DrawArguments),
    /// Measure the program's error rate on staged collisions
    #[command(
        before_help = "Compares eleven RICSAC staged collisions with what the papers print about them: each \
            number is claimed to reproduce within a tolerance, or listed with the reason why it does not. \
            Then reconstructs the speed of each from its crush, and shows the error rate. It reads no file: \
            the data are built in. With --field PATH it judges intervals of ΔV by the recorders of real \
            crashes instead. PATH is a table of crashes (CSV), or NHTSA's CISS tables (CSV or SAS): the ZIP \
            file of a year as downloaded, a folder with its tables, or a folder with such ZIP files or folders of \
            several years. With --recorders FILE it judges speeds before the impact.",
        after_help = "Examples:\n  deltav validate\n  deltav validate --format json -o validation.json\n  \
            deltav validate --format markdown -o docs/validation.md --plots docs\n  \
            deltav validate --field 2017.zip --field 2018.zip\n  deltav validate --field 2017.zip \
            --objects\n  deltav validate --field ciss-pairs.csv --judge DVTOTAL\n\n\
            Exit status: 0 every claimed number reproduces; 1 at least one does not. With --field: 0 \
            done.\n\n\
            More: `deltav explain error rate`, `deltav explain field data`."
    )]
    Validate(ValidateArguments),
    /// Explain a term, a symbol, a key of a case or a warning
    #[command(
        before_help = "The same texts are in crates/report/glossary.md. Without a topic, the command \
            lists all topics. --format json writes \"term\", \"kind\", \"also\" (other names), \"text\" \
            (Markdown) and \"see_also\" (terms that the text uses).",
        after_help = "Examples:\n  deltav explain\n  deltav explain crush plane\n  deltav explain μ_c\n  \
            deltav explain vehicle1.crush.offset\n  deltav explain delta-v-differs\n  \
            deltav explain --format json -o glossary.json"
    )]
    Explain(ExplainArguments),
    /// Print the JSON Schema of the case file, for editors
    #[command(
        before_help = "If the first line of a case file is `#:schema case.schema.json`, with the path \
            from the case to the schema, Visual Studio Code with the extension Even Better TOML and other \
            editors built on Taplo complete and check the file while you write it. The program itself \
            does not need the schema, and checks more.",
        after_help = "Example:\n  deltav schema -o case.schema.json"
    )]
    Schema(SchemaArguments),
    /// Print shell completions
    #[command(
        before_help = "On the Tab key, the shell then completes commands, options and their values.",
        after_help = "Examples:\n  deltav completions bash > \
            ~/.local/share/bash-completion/completions/deltav\n  \
            deltav completions zsh > ~/.zfunc/_deltav\n  deltav completions fish > \
            ~/.config/fish/completions/deltav.fish"
    )]
    Completions(CompletionsArguments),
    /// Print the manual page
    #[command(
        before_help = "The page is in roff. With --output-dir, it and one page for each command are \
            written into a folder instead.",
        after_help = "Examples:\n  deltav man > deltav.1\n  deltav man --output-dir ~/.local/share/man/man1"
    )]
    Man(ManArguments),
}

/// The request of a command on cases, and the destination of the answer.
#[derive(Debug)]
pub(crate) struct Asked {
    pub(crate) request: Request,
    pub(crate) cases: CasesArguments,
    /// Whether the report has the program in it.
    pub(crate) is_live: bool,
    /// The page for that, if it is named.
    pub(crate) page: Option<PathBuf>,
    pub(crate) samples_out: Option<PathBuf>,
    pub(crate) plots: Option<(PathBuf, PictureFormat)>,
}

// Each command that asks something of cases. A comment for rustdoc would become the help of the program.
#[derive(Debug, Subcommand)]
pub(crate) enum Question {
    /// Find the speed from damage or momentum, and all that follows
    #[command(
        before_help = "The program varies the speed that `find` of [reconstruct] names until the impact \
            dissipates the crush energy of both vehicles. If there is no damage, momentum and the motion \
            after the impact give the speed, or both speeds if `find` names both. If the case has more \
            evidence than that, or its checks refute the answer, all the evidence is weighed as in `deltav \
            estimate` and leads the report, above the exact solutions.\n\n\
            Several files give one row each. A file without an answer has the error in its row.",
        after_help = "Examples:\n  deltav reconstruct fixtures/sae-980025.toml --units si\n  \
            deltav reconstruct fixtures/sae-980025.toml --format html -o report.html\n  \
            deltav reconstruct fixtures/sae-980025.toml --format html --live -o report.html\n  \
            deltav reconstruct fixtures/rear-end-rest.toml --exact\n  \
            deltav reconstruct fixtures/ricsac/*.toml --format csv -o results.csv\n\n\
            Exit status: 0 done; 1 no answer, or a row has an error; 2 wrong case file or command line.\n\n\
            More: `deltav explain reconciliation`, `deltav explain headline`, `deltav explain rows`."
    )]
    Reconstruct(ReconstructArguments),
    /// Compute an impact from two known speeds
    #[command(
        before_help = "Planar impact mechanics gives the impulse, the motion after the impact, ΔV, PDOF \
            and energy. If the case has damage, it is evaluated too. Several files give one row each.",
        after_help = "Examples:\n  deltav impact fixtures/sae-980025-impact.toml\n  \
            deltav impact fixtures/ricsac/*.toml --format csv --units us -o results.csv\n\n\
            Exit status: 0 done; 1 no answer, or a row has an error; 2 wrong case file or command line.\n\n\
            More: `deltav explain impact law`, `deltav explain rows`."
    )]
    Impact(ReportArguments),
    /// Follow the vehicles from the impact to rest, or back from it
    #[command(
        before_help = "Each vehicle is one rigid body on four wheels that roll, skid or slide on the \
            ground. A vehicle with speed, direction and yaw_rate in [vehicleN.after] is followed to rest; \
            from its rest, the program finds the velocity and yaw rate after the impact that lead there, \
            and names every other motion that does so too. It needs the friction of [surface], the drag \
            of the wheels, and the place of the impact. `deltav impact` and `deltav reconstruct` go on to \
            rest by themselves if the case has friction and drag.",
        after_help = "Examples:\n  deltav motion fixtures/rear-end-rest.toml\n  \
            deltav new --template intersection -o case.toml\n  \
            deltav motion case.toml\n  \
            deltav draw case.toml --what motion -o motion.svg\n\n\
            Exit status: 0 done; 1 no answer, or a row has an error; 2 wrong case file or command line.\n\n\
            More: `deltav explain rest`, `deltav explain drag`, `deltav explain rows`."
    )]
    Motion(ReportArguments),
    /// Compute crush energy and ΔV from damage and PDOF alone (CRASH3)
    #[command(
        before_help = "No impact is computed that could give the direction of force, so ΔV needs a PDOF \
            in the crush table of a damaged vehicle. The crush energy of one vehicle alone needs none. \
            Several files give one row each.",
        after_help = "Examples:\n  deltav crush fixtures/sae-980025-crush.toml\n  \
            deltav crush fixtures/one-vehicle.toml\n\n\
            More: `deltav explain CRASH3`, `deltav explain one vehicle alone`, `deltav explain rows`."
    )]
    Crush(ReportArguments),
    /// Check a case without solving it
    #[command(
        before_help = "Prints what the program understood, with every number as written and in both unit \
            systems; what it assumes; which commands can run, and what the others still need; and every \
            warning that needs no solution.",
        after_help = "Examples:\n  deltav check fixtures/sae-980025.toml\n  \
            deltav check fixtures/one-inspected.toml --format json\n\n\
            Exit status: 0 the file is valid, with or without warnings; 2 it is not.\n\n\
            More: `deltav explain which command`."
    )]
    Check(Arguments),
    /// Compare the answers of the impact laws, CRASH3 and momentum
    #[command(
        before_help = "Shows how much the answer depends on the choice of impact law. The case is solved \
            under its own law and under Brach's, Woolley's, Ishikawa's and Kudlich–Slibar's, with its own \
            coefficients where they apply and stated assumptions elsewhere. If it has [reconstruct], the \
            damage and how the vehicles left the impact, a first table has the answers by damage alone, by \
            momentum alone, and by both together.\n\n\
            Several files give one row for each law of each case as csv, one line for each case as jsonl.",
        after_help = "Examples:\n  deltav compare fixtures/sae-980025.toml\n  \
            deltav compare fixtures/rear-end-rest.toml\n\n\
            More: `deltav explain impact law`, `deltav explain two unknown speeds`, `deltav explain rows`."
    )]
    Compare(CasesArguments),
    /// Show what the event data recorders give on their own
    #[command(
        before_help = "Reads the table of a recorder from the case, from a CSV beside it, or as copied from \
                       a printed report (`pre_crash` and `pulse` of [vehicle1.recorder]). Prints what each \
                       heading was \
            taken for, and each cell without a value with its place; the distance to the impact by the speed \
            of the wheels, with its bounds (slip makes the true distance longer); the speed at impact with \
            its interval and what its error comes from; where the pulse begins and ends, its ΔV, and whether the record ends before the impact does. \
            If there are several records (`records`), it says which is of this impact. HTML adds the curves.",
        after_help = "Examples:\n  deltav new --template recorder -o case.toml\n  \
            deltav recorder fixtures/recorder.toml\n  \
            deltav recorder fixtures/recorder.toml --format html -o recorder.html\n  \
            deltav recorder fixtures/recorder.toml --samples-out path.csv\n\n\
            Exit status: 0 done; 1 no answer; 2 wrong case file, or no table of a recorder in it.\n\n\
            More: `deltav explain recorder`."
    )]
    Recorder(RecorderArguments),
    /// Show how sensitive the answer is to each input
    #[command(
        before_help = "For a case with [reconstruct], prints the exact derivatives of the speed found and \
                       of both ΔV with respect to each number of the file, the most influential first. For \
                       any case with known \
            damage and directions of force, also sweeps the PDOF: CRASH3's answer with the lines of \
            action turned to both sides.",
        after_help = "Examples:\n  deltav sensitivity fixtures/sae-980025.toml\n  \
            deltav sensitivity fixtures/sae-980025.toml --pdof-step 10 --pdof-steps 1 --format json\n\n\
            More: `deltav explain sensitivity`."
    )]
    Sensitivity(SensitivityArguments),
    /// Propagate the ranges of the inputs to the results
    #[command(
        before_help = "Any number of a case can be a range, such as restitution = { low = 0.2, high = 0.4 \
            }. Each sample draws all ranges and solves the case as `deltav reconstruct` does or, without \
            [reconstruct], `deltav impact`. The report gives intervals of each result with their standard \
            errors, what was taken as exact, and which inputs matter.\n\n\
            Several files give one row each. Ctrl-C ends the sampling, prints the results so far and \
            exits with status 1.",
        after_help = "Examples:\n  deltav uncertainty fixtures/sae-980025-uncertain.toml\n  \
            deltav uncertainty fixtures/sae-980025-uncertain.toml --method sobol --samples 65536 --sobol\n  \
            deltav uncertainty fixtures/sae-980025-uncertain.toml --samples-out samples.csv --plots .\n\n\
            More: `deltav explain range`, `deltav explain shared error`, `deltav explain default spread`, \
            `deltav explain Monte Carlo`."
    )]
    Uncertainty(UncertaintyArguments),
    /// Estimate the speeds from all evidence, with intervals
    #[command(
        before_help = "Speeds that the case does not give, or that [reconstruct] seeks, are unknown. The \
            program draws possible collisions, and weighs each by how well it agrees with all \
            evidence at once (Bayes): crush of one vehicle or both, PDOF, skid marks, the motion after the \
            impact, rest positions and points, recorders, and speeds that are certain. Each speed, ΔV and \
            other result then has a median and an interval that holds 95 % of the draws. A warning names \
            each piece of evidence that contradicts the rest. If the run does not converge, the report \
            gives no interval.",
        after_help = "Examples:\n  deltav estimate fixtures/estimate.toml\n  \
            deltav estimate fixtures/estimate.toml --above \"vehicle1.speed 50 km/h\"\n  \
            deltav estimate fixtures/estimate.toml --prior flat --no-pieces --format json -o result.json\n  \
            deltav estimate fixtures/estimate.toml --format html -o report.html --samples-out draws.csv\n\n\
            Exit status: 0 done; 1 no answer, or not converged; 2 wrong case file or command line.\n\n\
            More: `deltav explain posterior`, `deltav explain errors of the evidence`, `deltav explain \
            p-value`."
    )]
    Estimate(EstimateArguments),
    /// Show whether the collision was avoidable: at the limit, in time
    #[command(
        before_help = "Shows what the driver of one vehicle did from the reaction demand on, that is, from \
                       where the danger could first be recognized, and what a lower speed, a timely \
                       reaction and full braking would have changed: whether the vehicle stops before the \
                       place of the impact (in space), or arrives after the other party has left it (in \
                       time), the speeds that just avoid the collision, and the speed that is left at the \
                       impact when driving at the limit. With ranges, or with evidence of the speed, it \
                       gives the probability. The case needs a table [avoid], and may consist of it alone. \
                       No reaction time and no deceleration is assumed.",
        after_help = "Examples:\n  deltav new --template avoid -o case.toml\n  \
            deltav avoid case.toml\n  \
            deltav avoid case.toml --format html -o report.html\n  \
            deltav avoid fixtures/avoid/pedestrian.toml --format json\n\n\
            Exit status: 0 done; 1 no answer, or not converged; 2 wrong case file or command line.\n\n\
            More: `deltav explain time and distance`, `deltav explain reaction demand`."
    )]
    Avoid(AvoidArguments),
}

impl Asked {
    fn of(request: Request, cases: impl Into<CasesArguments>) -> Self {
        Self { request, cases: cases.into(), is_live: false, page: None, samples_out: None, plots: None }
    }

    fn report(request: Request, ReportArguments { cases, live, page }: ReportArguments) -> Self {
        Self { is_live: live, page, ..Self::of(request, cases) }
    }
}

impl From<Question> for Asked {
    fn from(question: Question) -> Self {
        match question {
            Question::Reconstruct(ReconstructArguments { report, exact }) => {
                // The report to hand over adds intervals that take as long again; a live one leaves them out.
                let is_page = matches!(report.cases.format, Ok(Format::Html | Format::Markdown));
                let method = is_page && !exact && !report.live;
                Self::report(Request::Reconstruct(ReconstructOptions { weigh: !exact, method }), report)
            }
            Question::Impact(report) => Self::report(Request::Impact, report),
            Question::Motion(report) => Self::report(Request::Motion, report),
            Question::Crush(report) => Self::report(Request::Crush, report),
            Question::Check(arguments) => Self::of(Request::Check, arguments),
            Question::Compare(cases) => Self::of(Request::Compare, cases),
            Question::Recorder(arguments) => {
                let cases = CasesArguments { csv_style: arguments.csv_style, ..arguments.arguments.into() };
                Self { samples_out: arguments.samples_out, ..Self::of(Request::Recorder, cases) }
            }
            Question::Sensitivity(SensitivityArguments { arguments, pdof_step, pdof_steps }) => {
                Self::of(Request::Sensitivity(SensitivityOptions { pdof_step, pdof_steps }), arguments)
            }
            Question::Uncertainty(arguments) => {
                let UncertaintyArguments { samples, seed, method, outputs, sobol: indices, .. } = arguments;
                let options = UncertaintyOptions { samples, seed, method, indices, outputs };
                Self {
                    samples_out: arguments.samples_out,
                    plots: arguments.plots.map(|folder| (folder, arguments.plots_format)),
                    ..Self::of(Request::Uncertainty(options), arguments.arguments)
                }
            }
            Question::Estimate(arguments) => {
                let EstimateArguments {
                    particles, seed, prior, no_pieces, above, threads, csv_style, ..
                } = arguments;
                let options = EstimateOptions { particles, seed, prior, pieces: !no_pieces, above };
                let cases = CasesArguments { threads, csv_style, ..arguments.arguments.into() };
                let asked = Self::of(Request::Estimate(options), cases);
                Self { samples_out: arguments.samples_out, ..asked }
            }
            Question::Avoid(AvoidArguments { arguments, samples, seed, exact, threads }) => {
                let samples = samples.unwrap_or(AvoidOptions::default().samples);
                let cases = CasesArguments { threads, ..arguments.into() };
                Self::of(Request::Avoid(AvoidOptions { samples, seed, exact }), cases)
            }
        }
    }
}

/// The commands as `deltav --help` lists them, each in one group.
pub(crate) const GROUPS: [(&str, &[&str]); 3] = [
    ("Do the job", &["new", "check", "reconstruct", "estimate", "impact", "motion", "crush", "table"]),
    ("Look closer", &["recorder", "avoid", "compare", "sensitivity", "uncertainty", "draw", "validate"]),
    ("Utilities", &["explain", "schema", "completions", "man", "help"]),
];

/// The description of the command comes between its name and its usage, its examples after the options.
const HELP: &str = "{about-with-newline}\n{before-help}{usage-heading} {usage}\n\n{all-args}{after-help}";

/// The command line, whose help lists the commands in groups, which clap does not have.
pub(crate) fn command() -> clap::Command {
    let command = Command::command().mut_subcommands(|command| command.help_template(HELP));
    let (heading, literal) = (*command.get_styles().get_header(), *command.get_styles().get_literal());
    let line = |name: &&str| {
        // clap adds `help` itself.
        let about = command
            .find_subcommand(name)
            .and_then(clap::Command::get_about)
            .map_or_else(|| "Print this message or the help of a command".to_owned(), ToString::to_string);
        format!("  {literal}{name:<11}{literal:#}  {about}\n")
    };
    let group = |(title, names): &(&str, &[&str])| {
        let lines: Vec<String> = names.iter().map(line).collect();
        format!("{heading}{title}:{heading:#}\n{}\n", lines.concat())
    };
    let groups: Vec<String> = GROUPS.iter().map(group).collect();
    let template = format!(
        "{{about-with-newline}}\n{{before-help}}{{usage-heading}} {{usage}}\n\n\
         {}{heading}Options:{heading:#}\n{{options}}{{after-help}}",
        groups.concat()
    );
    command.help_template(template)
}

/// The command that this line asks for.
pub(crate) fn parse(
    line: impl IntoIterator<Item = impl Into<OsString> + Clone>,
) -> Result<Command, clap::Error> {
    let mut command = command();
    let matches = command.try_get_matches_from_mut(line)?;
    Command::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
}

/// A word for an option: its name, its meaning if that needs explanation, and its value.
type Word<T> = (&'static str, &'static str, T);

/// Words of a library, each with its meaning.
fn meaning<T: Copy, const N: usize>(
    words: [(&'static str, T); N],
    meanings: [&'static str; N],
) -> Vec<Word<T>> {
    words.into_iter().zip(meanings).map(|((name, value), meaning)| (name, meaning, value)).collect()
}

/// Takes one of a few words.
fn one_of<T: Copy + Send + Sync + 'static>(
    words: impl IntoIterator<Item = Word<T>>,
) -> impl TypedValueParser<Value = T> {
    let words: Vec<Word<T>> = words.into_iter().collect();
    let value = |(name, meaning, _): &Word<T>| match *meaning {
        "" => PossibleValue::new(*name),
        meaning => PossibleValue::new(*name).help(meaning),
    };
    let values = PossibleValuesParser::new(words.iter().map(value).collect::<Vec<_>>());
    values.try_map(move |name| {
        let found = words.iter().find(|(word, _, _)| *word == name).map(|(_, _, value)| *value);
        found.ok_or("no such value")
    })
}

/// The values of an option, one below the other, each with its meaning.
fn listed<T>(words: Vec<Word<T>>) -> String {
    let widest = words.iter().map(|(name, _, _)| name.len()).max().unwrap_or_default();
    let line = |(name, meaning, _): &Word<T>| format!("  {name:<widest$}  {meaning}");
    words.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn templates() -> Vec<Word<Template>> {
    let meanings = [
        "The front of one vehicle against the side of the other",
        "Two fronts, offset",
        "A front against the rear of a waiting vehicle",
        "Rear-end collision: both rest positions are known, neither speed is",
        "Crossing vehicles: both rest positions are known, neither speed is",
        "A vehicle against a wall",
        "A vehicle that scrapes along the side of another",
        "Two cars whose energy equivalent speeds (EES) are known",
        "A car against the rear of a heavy truck (lorry)",
        "One vehicle with its damage, for `deltav crush`",
        "Whether a collision was avoidable, for `deltav avoid`",
        "Two cars with event data recorders, for `deltav recorder`",
    ];
    meaning(Template::WORDS, meanings)
}

fn methods() -> Vec<Word<SamplingMethod>> {
    let meanings = [
        "Independent points",
        "Each range divided into equal shares, one point in each",
        "Scrambled Sobol' points, best if N is a power of two",
    ];
    meaning(SamplingMethod::WORDS, meanings)
}

fn priors() -> Vec<Word<SeverityPrior>> {
    let meanings = [
        "As severe as collisions after which a vehicle was towed",
        "As severe as the ones among these in which somebody was seriously hurt (MAIS 3 or more)",
        "All speeds are equally likely",
    ];
    meaning(SeverityPrior::WORDS, meanings)
}

/// Those that a table of crashes can be judged with.
fn priors_of_field() -> Vec<Word<SeverityPrior>> {
    priors().into_iter().filter(|(_, _, prior)| *prior != SeverityPrior::Flat).collect()
}

fn jobs() -> Vec<Word<Job>> {
    let meanings = [
        "The speed at which impact and crush agree",
        "What the impact does, both speeds given",
        "CRASH3: energies and ΔV from the damage alone",
        "Both speeds from all the evidence",
        "Whether the collision was avoidable, for rows with the keys of [avoid]",
    ];
    meaning(Job::WORDS, meanings)
}

/// What can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    /// A subject of an analysis.
    Subject(Subject),
    /// An estimate.
    Estimate,
    /// Whether a collision was avoidable.
    Avoid(AvoidPicture),
}

impl What {
    /// The subject of an analysis, if it is one.
    pub(crate) fn subject(self) -> Option<Subject> {
        match self {
            Self::Subject(subject) => Some(subject),
            Self::Estimate | Self::Avoid(_) => None,
        }
    }
}

fn drawings() -> Vec<Word<What>> {
    let of_subjects = [
        (Subject::Scene, "Plan view at impact: outlines, contact, crush plane, impulse, velocities, PDOF"),
        (Subject::Damage, "Each damaged vehicle with its crush profile in place"),
        (Subject::Reconciliation, "Work of the normal impulse against the speed sought"),
        (Subject::Energy, "Where the initial kinetic energy went"),
        (Subject::Motion, "Plan view from approach through impact to rest, with the marks of the wheels"),
        (Subject::MotionCurves, "Speed, yaw rate and heading over time, from the impact to rest"),
        (Subject::Momentum, "The momentum polygon: momenta before and after the impact, tip to tail"),
    ];
    let others = [(
        "estimate",
        "How probable speeds and rest positions are, as `deltav estimate` finds them",
        What::Estimate,
    )];
    let of_avoid = AvoidPicture::WORDS.map(|(name, picture)| {
        let meaning = match picture {
            AvoidPicture::PathTime => "Distance against time before the impact, of `deltav avoid`",
            AvoidPicture::Chance => "Probability that the collision is avoided, against the speed",
            AvoidPicture::Sight => "Both parties before the impact and what obstacles hide, seen from above",
        };
        (name, meaning, What::Avoid(picture))
    });
    let of_subjects = of_subjects.map(|(subject, meaning)| (subject.name(), meaning, What::Subject(subject)));
    of_subjects.into_iter().chain(others).chain(of_avoid).collect()
}

const CASE_UNITS: [Word<Units>; 3] = [
    ("si", "kg, m, cm, km/h", Units::Si),
    ("us", "lb, in, mph", Units::Us),
    ("uk", "kg, m, cm, mph", Units::Uk),
];

const UNITS: [Word<Units>; 3] = [
    ("us", "ft/s, mph, lb, ft·lb, in", Units::Us),
    ("si", "m/s, km/h, kg, J, cm", Units::Si),
    ("uk", "As si, but speeds of vehicles in mph", Units::Uk),
];

const CSV_STYLES: [Word<CsvStyle>; 2] = [
    ("international", "Commas between the columns, decimal points", CsvStyle::International),
    ("european", "Semicolons between the columns, decimal commas, byte order mark", CsvStyle::European),
];

fn plot_formats() -> [Word<PictureFormat>; 3] {
    PictureFormat::ALL.map(|format| (format.extension(), "", format))
}

/// A file, or standard output, which is also called `-`.
#[derive(Clone, Debug)]
pub(crate) struct Destination(PathBuf);

impl Destination {
    /// `None` for standard output.
    pub(crate) fn file(&self) -> Option<&Path> {
        (self.0 != Path::new("-")).then_some(&self.0)
    }
}

impl From<PathBuf> for Destination {
    fn from(path: PathBuf) -> Self {
        Self(path)
    }
}

impl ValueParserFactory for Destination {
    type Parser = MapValueParser<PathBufValueParser, fn(PathBuf) -> Self>;

    fn value_parser() -> Self::Parser {
        PathBufValueParser::new().map(Self::from)
    }
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArguments {
    /// What to explain, in one or more words
    #[arg(value_parser = TopicParser, hide_possible_values = true)]
    pub(crate) topic: Vec<String>,

    /// text, json, html or markdown
    #[arg(long, value_enum, default_value_t = Format::Text, hide_possible_values = true)]
    pub(crate) format: Format,

    /// Write to FILE instead of standard output
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

/// Takes any word, which may be a symbol or a key, and offers the names of the topics to the completions of
/// shells.
#[derive(Clone)]
struct TopicParser;

impl TypedValueParser for TopicParser {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        // In a script, a quote would begin a text, and a comma is no word.
        let is_plain = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '-' || c == ' ');
        let names = report::topics().iter().map(|topic| topic.name).filter(move |name| is_plain(name));
        Some(Box::new(names.map(PossibleValue::new)))
    }
}

#[derive(Debug, Args)]
pub(crate) struct CasesArguments {
    /// Case file (TOML), or - for standard input; for rows, several files or a folder of them
    #[arg(value_name = "CASE", required = true)]
    pub(crate) cases: Vec<PathBuf>,

    /// text, json (SI), html, markdown; csv, jsonl (rows)
    #[arg(long, value_parser = one_of(CASES_FORMATS), default_value = "text", hide_possible_values = true)]
    pub(crate) format: CasesFormat,

    /// us, si, or uk (si, speeds in mph) [default: the file's; csv: si]
    #[arg(long, value_parser = one_of(UNITS), hide_possible_values = true)]
    pub(crate) units: Option<Units>,

    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// international [default], or european (semicolons, decimal commas)
    #[arg(long, value_name = "STYLE", value_parser = one_of(CSV_STYLES), default_value = "international", hide_default_value = true, hide_possible_values = true)]
    pub(crate) csv_style: CsvStyle,

    /// Write to FILE, not standard output; no .toml file is overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Debug, Args)]
pub(crate) struct ReconstructArguments {
    #[command(flatten)]
    pub(crate) report: ReportArguments,

    /// Print the exact solution alone, even if there is more evidence
    #[arg(long)]
    pub(crate) exact: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ReportArguments {
    #[command(flatten)]
    pub(crate) cases: CasesArguments,

    /// With html: embed the program, so that readers can change numbers
    #[arg(long)]
    pub(crate) live: bool,

    /// Page that --live uses [default: deltav.html beside the program]
    #[arg(long, value_name = "FILE", requires = "live")]
    pub(crate) page: Option<PathBuf>,
}

/// The format of a document on one case, or that of rows.
pub(crate) type CasesFormat = Result<Format, Rows>;

const CASES_FORMATS: [Word<CasesFormat>; 6] = [
    ("text", "", Ok(Format::Text)),
    ("json", "", Ok(Format::Json)),
    ("html", "", Ok(Format::Html)),
    ("markdown", "", Ok(Format::Markdown)),
    ("csv", "", Err(Rows::Csv)),
    ("jsonl", "", Err(Rows::Jsonl)),
];

/// What has a row for each of many cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rows {
    Csv,
    Jsonl,
}

#[derive(Debug, Args)]
pub(crate) struct NewArguments {
    /// Kind of case, one of the templates below
    #[arg(long, value_parser = one_of(templates()), default_value = "front-side", hide_possible_values = true)]
    pub(crate) template: Template,

    /// si (kg, m, cm, km/h), us (lb, in, mph), or uk (kg, m, cm, mph)
    #[arg(long, value_parser = one_of(CASE_UNITS), default_value = "si", hide_possible_values = true)]
    pub(crate) units: Units,

    /// Write to FILE, which must not exist, instead of standard output
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArguments {
    /// Write to FILE, not standard output; no .toml file is overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArguments {
    /// Write the pages of the program and of each command into DIR, created if needed
    #[arg(long, value_name = "DIR")]
    pub(crate) output_dir: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct DrawArguments {
    /// Case file (TOML), or - for standard input
    pub(crate) case: PathBuf,

    /// What to draw, one of those below
    #[arg(long, value_parser = one_of(drawings()), hide_possible_values = true)]
    pub(crate) what: What,

    /// us, si, or uk (si, speeds in mph) [default: the file's]
    #[arg(long, value_parser = one_of(UNITS), hide_possible_values = true)]
    pub(crate) units: Option<Units>,

    /// Draw scene or motion for lay readers, without symbols and axes
    #[arg(long)]
    pub(crate) plain: bool,

    /// Draw the motion on this picture (PNG, JPEG) instead of that of [scene]
    #[arg(long, value_name = "FILE", requires_all = ["plan_corner", "plan_width"])]
    pub(crate) site_plan: Option<PathBuf>,

    /// Place of its lower left corner in the scene, such as "-20 m, -15 m"
    #[arg(long, value_name = "X, Y", value_parser = place, requires = "site_plan", allow_hyphen_values = true)]
    pub(crate) plan_corner: Option<[Quantity; 2]>,

    /// Its width, such as "60 m"
    #[arg(long, value_name = "LENGTH", value_parser = length, requires = "site_plan")]
    pub(crate) plan_width: Option<Quantity>,

    /// Angle from the scene's x axis to its lower edge, such as "15 deg"
    #[arg(long, value_name = "ANGLE", value_parser = angle, requires = "site_plan", allow_hyphen_values = true)]
    pub(crate) plan_angle: Option<Quantity>,

    /// Write to FILE (.svg, .png, .pdf) [default: SVG to standard output]
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Debug, Args)]
pub(crate) struct RecorderArguments {
    #[command(flatten)]
    pub(crate) arguments: Arguments,

    /// Also write the samples with their distances, path against time, to FILE as CSV (SI units, radians)
    #[arg(long, value_name = "FILE")]
    pub(crate) samples_out: Option<PathBuf>,

    /// international [default], or european (semicolons, decimal commas)
    #[arg(long, value_name = "STYLE", value_parser = one_of(CSV_STYLES), default_value = "international", hide_default_value = true, hide_possible_values = true, requires = "samples_out")]
    pub(crate) csv_style: CsvStyle,
}

#[derive(Debug, Args)]
pub(crate) struct SensitivityArguments {
    #[command(flatten)]
    pub(crate) arguments: Arguments,

    /// Step of the PDOF sweep in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 5.0, value_parser = degrees, allow_negative_numbers = true)]
    pub(crate) pdof_step: f64,

    /// Number of steps to each side
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=180))]
    pub(crate) pdof_steps: u32,
}

fn length(text: &str) -> Result<Quantity, String> {
    quantity(text, Dimension::Length)
}

fn angle(text: &str) -> Result<Quantity, String> {
    quantity(text, Dimension::Angle)
}

/// Two lengths with a comma between.
fn place(text: &str) -> Result<[Quantity; 2], String> {
    let (x, y) =
        text.split_once(',').ok_or("give two lengths with a comma between, such as \"-20 m, -15 m\"")?;
    Ok([length(x.trim())?, length(y.trim())?])
}

fn quantity(text: &str, dimension: Dimension) -> Result<Quantity, String> {
    read_quantity(text, dimension).map_err(|error| format!("{error}; {}", error.help()))
}

#[derive(Debug, Args)]
pub(crate) struct UncertaintyArguments {
    #[command(flatten)]
    pub(crate) arguments: CasesArguments,

    /// Number of samples [default: 100000; 1000 if searched back from rests]
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(crate) samples: Option<usize>,

    /// Random seed
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,

    /// monte-carlo [default], latin-hypercube, or sobol (N a power of two)
    #[arg(long, value_parser = one_of(methods()), default_value = "monte-carlo", hide_default_value = true, hide_possible_values = true)]
    pub(crate) method: SamplingMethod,

    /// Only these results: vehicle1.speed,vehicle1.delta_v [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = output_name)]
    pub(crate) outputs: Option<Vec<String>>,

    /// Also Sobol' indices, ROWS × (inputs + 2) evaluations [ROWS: 4096]
    #[arg(long, value_name = "ROWS", num_args = 0..=1, require_equals = true, default_missing_value = "4096", value_parser = rows)]
    pub(crate) sobol: Option<usize>,

    /// Also write the samples of one case to FILE as CSV (SI units, radians)
    #[arg(long, value_name = "FILE")]
    pub(crate) samples_out: Option<PathBuf>,

    /// Also write histograms and tornados into DIR, created if needed
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,

    /// Format of the plots
    #[arg(long, value_name = "FORMAT", value_parser = one_of(plot_formats()), default_value = "svg", requires = "plots")]
    pub(crate) plots_format: PictureFormat,
}

/// A whole number, which may be written as 1e6 too.
fn count(text: &str) -> Result<usize, String> {
    let (digits, zeros) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let number = (is_whole(digits) && is_whole(zeros)).then(|| {
        let power = zeros.parse().ok().and_then(|zeros| 10_usize.checked_pow(zeros))?;
        digits.parse::<usize>().ok()?.checked_mul(power)
    });
    number
        .flatten()
        .ok_or_else(|| "give a whole number, without commas or points, such as 100000 or 1e6".to_owned())
}

/// The name of a result, as the JSON has it.
fn output_name(text: &str) -> Result<String, String> {
    let known: Vec<String> = analysis::Output::all().into_iter().map(analysis::Output::path).collect();
    if known.iter().any(|name| name == text) {
        return Ok(text.to_owned());
    }
    let near = case::nearest_names(text, known.iter().map(String::as_str));
    Err(match near.first() {
        Some(near) => format!("no result has this name; did you mean {near}?"),
        None => format!("no result has this name; the names are {}", known.join(", ")),
    })
}

/// Judged before anything is drawn.
fn samples(text: &str) -> Result<usize, String> {
    let samples = count(text)?;
    if samples > MAX_SAMPLES {
        return Err(InvalidRequest::TooManySamples { samples }.to_string());
    }
    if samples < MIN_SAMPLES { Err(InvalidRequest::Samples { samples }.to_string()) } else { Ok(samples) }
}

fn rows(text: &str) -> Result<usize, String> {
    let rows = count(text)?;
    let is_possible = (MIN_SAMPLES..=MAX_SAMPLES).contains(&rows);
    if is_possible { Ok(rows) } else { Err(InvalidRequest::Rows { rows }.to_string()) }
}

fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("give a whole number from 0 to {}, such as 1", u64::MAX))
}

fn degrees(text: &str) -> Result<f64, String> {
    SensitivityOptions::check_step(text.parse().unwrap_or(f64::NAN))
}

#[derive(Debug, Args)]
pub(crate) struct EstimateArguments {
    #[command(flatten)]
    pub(crate) arguments: Arguments,

    /// Random seed
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,

    /// Particles of each of 16 islands, a multiple of 128
    #[arg(long, value_name = "N", default_value_t = EstimatePlan::PARTICLES, value_parser = particles)]
    pub(crate) particles: usize,

    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// Severity before the evidence: field, serious-injury or flat
    #[arg(long, value_parser = one_of(priors()), hide_possible_values = true)]
    pub(crate) prior: Option<SeverityPrior>,

    /// Skip the answers for each piece of evidence, which take most of the time
    #[arg(long)]
    pub(crate) no_pieces: bool,

    /// Probability of exceeding a limit, "vehicle1.speed 50 km/h"; repeatable
    #[arg(long, value_name = "QUESTION", allow_hyphen_values = true)]
    pub(crate) above: Vec<String>,

    /// Also write every draw to FILE as CSV (SI units, radians)
    #[arg(long, value_name = "FILE")]
    pub(crate) samples_out: Option<PathBuf>,

    /// international [default], or european (semicolons, decimal commas)
    #[arg(long, value_name = "STYLE", value_parser = one_of(CSV_STYLES), default_value = "international", hide_default_value = true, hide_possible_values = true, requires = "samples_out")]
    pub(crate) csv_style: CsvStyle,
}

#[derive(Debug, Args)]
pub(crate) struct AvoidArguments {
    #[command(flatten)]
    pub(crate) arguments: Arguments,

    /// Number of samples, where numbers have ranges [default: 100000]
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(crate) samples: Option<usize>,

    /// Random seed
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,

    /// Take the speed of the exact solution, even if there is more evidence
    #[arg(long)]
    pub(crate) exact: bool,

    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}

fn particles(text: &str) -> Result<usize, String> {
    EstimateOptions::check_particles(count(text)?)
}

#[derive(Debug, Args)]
pub(crate) struct TableArguments {
    /// Parquet or CSV file, or - for CSV on standard input
    #[arg(required_unless_present_any = ["schema", "columns"])]
    pub(crate) cases: Option<PathBuf>,

    /// Case file (TOML), or part of one, with what all rows share
    #[arg(long, value_name = "FILE")]
    pub(crate) template: Option<PathBuf>,

    /// reconstruct, impact, crush, estimate or avoid
    #[arg(long, value_parser = one_of(jobs()), default_value = "reconstruct", hide_possible_values = true)]
    pub(crate) job: Job,

    /// Samples of each row, for intervals (reconstruct and impact) or the probability (avoid)
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(crate) samples: Option<usize>,

    /// Random seed of every row without one in the column `seed`
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,

    /// Particles of each island, a multiple of 128 (estimate)
    #[arg(long, value_name = "N", default_value_t = EstimatePlan::PARTICLES, value_parser = particles)]
    pub(crate) particles: usize,

    /// Severity before the evidence: field, serious-injury or flat (estimate)
    #[arg(long, value_parser = one_of(priors()), hide_possible_values = true)]
    pub(crate) prior: Option<SeverityPrior>,

    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// Columns to carry over, with commas between [default: all that are not keys]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    pub(crate) keep: Option<Vec<String>>,

    /// List the columns that a table can have, with units and meanings
    #[arg(long, conflicts_with = "columns")]
    pub(crate) schema: bool,

    /// List the columns of the results
    #[arg(long)]
    pub(crate) columns: bool,

    /// Write to FILE, Parquet if .parquet, else CSV; no .toml file is overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("real crashes").args(["field", "recorders"]))]
pub(crate) struct ValidateArguments {
    /// text, json (SI units, radians), html or markdown
    #[arg(long, value_enum, default_value_t = Format::Text, hide_possible_values = true)]
    pub(crate) format: Format,

    /// Write to FILE, not standard output; no .toml file is overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,

    /// Judge intervals of ΔV by recorders of real crashes; repeatable
    #[arg(long, value_name = "PATH")]
    pub(crate) field: Vec<PathBuf>,

    /// In NHTSA's tables, judge vehicles that struck a fixed object
    #[arg(long, requires = "field", conflicts_with_all = ["other", "judge"])]
    pub(crate) objects: bool,

    /// Judge speeds before the impact by recorders in FILE (CSV)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["field", "plots", "objects", "other", "judge"])]
    pub(crate) recorders: Option<PathBuf>,

    /// Give the recorder of one vehicle, and judge the other vehicle
    #[arg(long, requires = "field")]
    pub(crate) other: bool,

    /// Prior severity [default: field; with --recorders serious-injury]
    #[arg(long, value_parser = one_of(priors_of_field()), requires = "real crashes", conflicts_with = "judge", hide_possible_values = true)]
    pub(crate) prior: Option<SeverityPrior>,

    /// Judge another program instead: its ΔV (km/h) in the columns COLUMN_1 and COLUMN_2 of PATH, and the
    /// ends of its 95 % intervals in LOW_1, HIGH_1, LOW_2 and HIGH_2
    #[arg(long, value_name = "COLUMN[,LOW,HIGH]", requires = "field", conflicts_with_all = ["other", "plots"])]
    pub(crate) judge: Option<field::ClaimColumns>,

    /// Random seed
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed, requires = "real crashes")]
    pub(crate) seed: u64,

    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), requires = "real crashes")]
    pub(crate) threads: Option<u16>,

    /// Also write the plots into DIR, created if needed
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,

    /// Format of the plots: svg, png or pdf
    #[arg(long, value_name = "FORMAT", value_parser = one_of(plot_formats()), default_value = "svg", requires = "plots", hide_possible_values = true)]
    pub(crate) plots_format: PictureFormat,
}

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Case file (TOML), or - for standard input
    pub(crate) case: PathBuf,

    /// text, json (SI units, radians), html or markdown
    #[arg(long, value_enum, default_value_t = Format::Text, hide_possible_values = true)]
    pub(crate) format: Format,

    /// us, si, or uk (si, speeds in mph) [default: the file's]
    #[arg(long, value_parser = one_of(UNITS), hide_possible_values = true)]
    pub(crate) units: Option<Units>,

    /// Write to FILE, not standard output; no .toml file is overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

impl From<Arguments> for CasesArguments {
    fn from(Arguments { case, format, units, output }: Arguments) -> Self {
        let csv_style = CsvStyle::International;
        Self { cases: vec![case], format: Ok(format), units, threads: None, csv_style, output }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Text,
    Json,
    Html,
    Markdown,
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn a_count_is_whole() {
        for (text, number) in
            [("0", 0), ("100000", 100_000), ("1e6", 1_000_000), ("25E3", 25_000), ("7e0", 7)]
        {
            assert_eq!(count(text), Ok(number), "{text}");
        }
        for text in
            ["", "e6", "1e", "1.5e3", "1e-3", "100,000", "-1", "+1", "1e99", "99999999999999999999", "many"]
        {
            assert!(count(text).is_err_and(|message| message.contains("such as 100000 or 1e6")), "{text}");
        }
    }
}
