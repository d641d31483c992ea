//! The command line.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use analysis::EstimatePlan;
use case::{Dimension, Prior, Quantity, read_quantity};
use clap::builder::{
    MapValueParser, PathBufValueParser, PossibleValue, StringValueParser, TypedValueParser,
    ValueParserFactory,
};
use clap::{Arg, Args, Parser, ValueEnum};
use clap_complete::Shell;
use estimate::{MOST_PARTICLES, PARTICLES_STEP, Settings};
use uncertainty::{InvalidRequest, MAX_SAMPLES, MIN_SAMPLES};

/// Reconstructs a two-vehicle collision from its damage.
///
/// CRASH3 turns the damage of both vehicles into an energy, and planar impact mechanics finds the speed at
/// which the impact dissipates exactly that energy (Brach & Brach, SAE 980025). A case is a TOML file:
/// `deltav new` writes a template, and fixtures/sae-980025.toml is the paper's example.
#[derive(Debug, Parser)]
#[command(
    name = "deltav",
    bin_name = "deltav",
    version,
    subcommand_required = true,
    arg_required_else_help = true,
    after_help = "Which command: `deltav explain which command`. If neither speed is known, or evidence disagrees: `deltav estimate`.\n\nExit status: 0 done; 1 the case is well formed but has no answer, or a claim of validate fails; 2 the case file or the command line is wrong."
)]
pub(crate) enum Command {
    /// Write a commented case file to start from
    #[command(
        long_about = "Write a commented case file to start from.\n\n\
            The file runs as it is, but its numbers are made up. Each line says what its number is; replace them with yours. An existing file is not overwritten.",
        after_help = "Examples:\n  deltav new -o case.toml\n  deltav new --template barrier --units us -o case.toml\n  deltav reconstruct case.toml"
    )]
    New(NewArguments),
    /// Find the speed at which impact and crush agree, and print the whole reconstruction
    #[command(
        long_about = "Find the speed at which impact and crush agree, and print the whole reconstruction.\n\n\
            The program varies the speed that [reconstruct] names until the work of the normal impulse \
            equals the crush energy of both vehicles or, with energy_basis = \"absorbed\", the share 1 − e² \
            of it. With energy_basis = { tangential_share = 0.5 }, half the work of the tangential impulse \
            counts as well. With find = [\"vehicle1.speed\", \"vehicle2.speed\"] it finds both speeds: from \
            momentum and how the vehicles left the impact, which their rest positions tell, and from the crush energy \
            as well where the approaches lie within 10° of one line.\n\n\
            That is exact where the case just determines the speeds. Where it has more evidence than the exact solution \
            uses, or where the checks of that refute it, all the evidence is weighed as `deltav estimate` does \
            and leads the report; the exact solutions stand beneath, each with what speaks against it. \
            --exact leaves the weighing out.\n\n\
            Several files give one row each, in the order of the command line: use --format csv for a \
            spreadsheet, --format jsonl for a program. If a file has no answer, its row holds the error, \
            and the other files are still processed.\n\n\
            The names of the csv columns do not change and include the unit: \"file\", \"error\", \
            \"found.value (m/s)\", \
            \"impact.energy_loss (J)\", \"vehicle1.delta_v (m/s)\", \"vehicle2.pdof (rad)\" and so on, each \
            named after its key in --format json. They are in SI units and radians, whatever units the \
            files use. With --units us the columns are \"found.value (mph)\", \"impact.energy_loss (ft \
            lb)\", \"vehicle1.peak_force (lb)\", \
            \"vehicle2.pdof (deg)\" and so on. The \"warnings\" column lists warning codes, prefixed with \
            the vehicle where one applies; `deltav explain CODE` describes each. \"help\" says what to \
            write instead of what is wrong. If a text begins with =, +, -, @, one of their full-width forms, tab, line feed \
            or carriage return, it gets an apostrophe in front, because a spreadsheet would run it as a \
            formula. A line of jsonl \
            is the object of --format json with \"file\" added in front, or \
            {\"file\": …, \"error\": …, \"help\": …}. The ranges of a case are not propagated: \
            the \"ranges\" column says so, and `deltav uncertainty` does it. The last columns are \
            \"program.version\" and \"case.sha256\", the SHA-256 of the file.\n\n\
            --csv-style european separates the columns by semicolons, writes decimal commas and begins with \
            a byte order mark, as European spreadsheets expect.",
        after_help = "Examples:\n  deltav reconstruct fixtures/sae-980025.toml --units si\n  \
            deltav reconstruct fixtures/sae-980025.toml --format json -o result.json\n  \
            deltav reconstruct fixtures/sae-980025.toml --format html -o report.html\n  \
            deltav reconstruct fixtures/sae-980025.toml --format html --live -o report.html\n  \
            deltav reconstruct fixtures/rear-end-rest.toml --exact\n  \
            deltav reconstruct fixtures/ricsac/*.toml --format csv -o results.csv\n\n\
            Exit status: 0 done; 1 no answer, or in csv and jsonl any file with an error; 2 the case file or the command line is wrong."
    )]
    Reconstruct(ReconstructArguments),
    /// Compute an impact from two known speeds
    #[command(
        long_about = "Compute an impact from two known speeds.\n\n\
            Planar impact mechanics gives the impulse, the motion after the impact, ΔV, PDOF and energy. If \
            the case has damage, it is evaluated too.\n\n\
            Several files give one row each, as with `deltav reconstruct`: --format csv has the same \
            columns, but those for the speed found are empty; --format jsonl writes one line of JSON.",
        after_help = "Examples:\n  deltav impact fixtures/sae-980025-impact.toml\n  \
            deltav impact fixtures/ricsac/*.toml --format csv --units us -o results.csv\n\n\
            Exit status: 0 done; 1 no answer, or in csv and jsonl any file with an error; 2 the case file or the command line is wrong."
    )]
    Impact(ReportArguments),
    /// Follow each vehicle from the impact to rest, or find how it left from where it came to rest
    #[command(
        long_about = "Follow each vehicle from the impact to rest, or find how it left from where it came to rest.\n\n\
            Each vehicle is one rigid body on four wheels that roll, skid or slide on the ground. \
            [vehicleN.after] with speed, direction and yaw_rate is followed forward to rest; with rest, the \
            program searches for the velocity and yaw rate after the impact that lead there, and names \
            every other motion that does so too. [surface] has the friction, [vehicleN.after] the drag of \
            the wheels, and [scene] contact the place of the impact.\n\n\
            `deltav impact` and `deltav reconstruct` carry on to rest by themselves where the case has \
            friction and drag.\n\n\
            Several files give one row each, as with `deltav reconstruct`; the columns for the impact are empty.",
        after_help = "Examples:\n  deltav motion fixtures/rear-end-rest.toml\n  \
            deltav new --template intersection -o case.toml\n  \
            deltav motion case.toml\n  \
            deltav draw case.toml --what motion -o motion.svg\n\n\
            Exit status: 0 done; 1 no answer, or in csv and jsonl any file with an error; 2 the case file or the command line is wrong."
    )]
    Motion(ReportArguments),
    /// Compute crush energy and ΔV from damage and PDOF alone (CRASH3)
    #[command(
        long_about = "Compute crush energy and ΔV from damage and PDOF alone (CRASH3).\n\n\
            Each damaged vehicle needs a PDOF in its crush table, because no impact is computed that could provide one.\n\n\
            Several files give one row each, as with `deltav reconstruct`; the columns for the impact are empty.",
        after_help = "Example:\n  deltav crush fixtures/sae-980025-crush.toml"
    )]
    Crush(ReportArguments),
    /// Check a case without solving it
    #[command(
        long_about = "Check a case without solving it.\n\n\
            Prints what the program understood, with every number as written and in both unit systems; what it assumes where the file says nothing; which commands can run, and what the others still need; and every warning that does not require a solution.",
        after_help = "Examples:\n  deltav check fixtures/sae-980025.toml\n  \
            deltav check fixtures/one-inspected.toml --format json\n\n\
            Exit status: 0 the file is valid, with or without warnings; 2 it is not."
    )]
    Check(Arguments),
    /// Compare the answers of every impact law and of CRASH3, and those of damage and momentum
    #[command(
        long_about = "Compare the answers of every impact law and of CRASH3, and those of damage and momentum.\n\n\
            Shows how much the answer depends on the choice of impact law. The case is solved under its own \
            law and under Brach's, Woolley's, Ishikawa's and Kudlich–Slibar's, with its own coefficients \
            where they apply and stated assumptions elsewhere. A case with [reconstruct] is reconstructed \
            under each law; a case with both speeds is computed forward.\n\n\
            Where a case with [reconstruct] has both the damage and how the vehicles left the impact, a first \
            table puts side by side what the damage says alone, what momentum says alone, and what both say \
            together.\n\n\
            Several files give one row for each law of each case with --format csv, and one line for each \
            case with --format jsonl.",
        after_help = "Examples:\n  deltav compare fixtures/sae-980025.toml\n  \
            deltav compare fixtures/rear-end-rest.toml"
    )]
    Compare(CasesArguments),
    /// Show how sensitive the answer is to each input
    #[command(
        long_about = "Show how sensitive the answer is to each input.\n\n\
            For a case with [reconstruct], prints the exact derivatives of the speed found and of both \
            velocity changes with respect to each number of the file, in that number's own unit and in per \
            cent per per cent, the most influential first. For any case with known damage and directions of \
            force, also sweeps the PDOF: CRASH3's answer with the lines of action turned to both sides, \
            counter-clockwise positive, or clockwise in a case with z-down axes.",
        after_help = "Examples:\n  deltav sensitivity fixtures/sae-980025.toml\n  \
            deltav sensitivity fixtures/sae-980025.toml --pdof-step 10 --pdof-steps 1 --format json"
    )]
    Sensitivity(SensitivityArguments),
    /// Compute a row of results for each row of a table: Parquet or CSV in and out
    #[command(
        long_about = "Compute a row of results for each row of a table: Parquet or CSV in and out.\n\n\
            Each row is a case, read and solved as a case file is, with the same results to the last bit. \
            The template, a case file or a part of one, holds what all rows share; what a row gives replaces \
            or completes it, and an empty cell gives nothing. The rows stay in their order. A row that is \
            wrong, or has no answer, has a sentence in the column \"error\", and the others are not affected.\n\n\
            A column is named after the key of the case file, with its unit in brackets: \"vehicle1.mass \
            [kg]\", \"vehicle1.crush.depths[1] [in]\", \"vehicle2.speed.sd [mph]\". Without dots and brackets \
            the same is \"vehicle1__mass__kg\", with two underscores. A number without a unit is in SI units \
            and radians. A Parquet file can also have structs and lists as the case file has tables and lists. \
            --schema lists all columns. The column \"seed\" gives a row a seed of its own.\n\n\
            The columns of results are named after the keys of --format json, with underscores for dots: \
            \"vehicle1_delta_v\", in SI units and radians; --columns lists them. With --samples, the numbers that \
            vary also have \"vehicle1_delta_v_p025\", \"…_median\", \"…_p975\", \"…_mean\" and \"…_sd\": the \
            median and the ends of the 95 % interval, as `deltav uncertainty` finds them. Columns of the table \
            that are not keys, such as the number of the crash, come first; --keep chooses others.\n\n\
            The table is read and written in parts, so that any number of rows fits into memory.",
        after_help = "Examples:\n  deltav table crashes.parquet --template case.toml -o results.parquet\n  \
            deltav table crashes.csv --template case.toml --job crush --keep id,year -o results.csv\n  \
            deltav table crashes.csv --template case.toml --samples 1000 -o intervals.csv\n  \
            deltav table --schema\n\n\
            Exit status: 1 where a row has an error. Ctrl-C ends the run and keeps the rows that were finished."
    )]
    Table(TableArguments),
    /// Propagate input ranges and distributions to the results
    #[command(
        long_about = "Propagate input ranges and distributions to the results.\n\n\
            No measurement of a crash is exact. Any number of a case can be a range:\n  \
            speed = { value = \"10 mph\", sd = \"1 mph\" }  normal\n  \
            yaw_radius = { value = \"1.4 m\", within = \"10 %\", confidence = 0.95 }  normal, 95 % within 10 %\n  \
            restitution = { low = 0.2, high = 0.4 }  uniform\n  \
            width = { low = \"63 in\", mode = \"65 in\", high = \"66 in\" }  triangular\n  \
            depths = { values = \"21.3 20.3 13.8 in\", sd = \"0.5 in\" }  each station by itself\n\n\
            Stiffness from a category, and yaw inertia from a class or by Burg's formula, vary by default; \
            `exact` in [uncertainty] switches that off. [[uncertainty.shared]] names an error that several \
            numbers share, such as that of one tape.\n\n\
            Each sample draws all ranges independently and solves the same equations as `deltav \
            reconstruct` (or, without [reconstruct], `deltav impact`). The report has the mean, standard \
            deviation, median and the intervals that hold 50, 90, 95 and 99 % of the samples, each with its \
            standard error; the number of samples without an answer, by reason, and of those of which a single \
            case would be warned; what was taken as exact; the effect of each input \
            alone (tornado); and the first-order propagation (GUM) for comparison. The same seed gives the \
            same bytes, with any number of threads.\n\n\
            Several files give one row each: --format csv has, of each result, the columns \
            \"vehicle1.speed.central (m/s)\", \"….median (m/s)\", \"….sd (m/s)\", \"….low95 (m/s)\" and \
            \"….high95 (m/s)\", the ends of the 95 % interval, and besides \"seed\", \"samples\" and \
            \"failed_share\".",
        after_help = "Examples:\n  deltav uncertainty fixtures/sae-980025-uncertain.toml\n  \
            deltav uncertainty fixtures/sae-980025-uncertain.toml --method sobol --samples 65536 --sobol\n  \
            deltav uncertainty fixtures/sae-980025-uncertain.toml --format json -o result.json --samples-out samples.csv --plots .\n\n\
            Ctrl-C ends the sampling, prints the results so far and exits with status 1."
    )]
    Uncertainty(UncertaintyArguments),
    /// Estimate the speeds from all evidence, with how probable each is
    #[command(
        long_about = "Estimate the speeds from all evidence, with how probable each is.\n\n\
            Speeds that the case does not give, or that [reconstruct] seeks, are unknown, both if need be. The \
            program draws collisions that might have been, and weighs each by how well it agrees with all \
            evidence at once (Bayes). The answer is the median and the interval that holds 95 % of them, of \
            each speed, ΔV and other result.\n\n\
            Evidence is whatever the case has of this:\n  \
            [vehicleN.crush] of both vehicles or of one: the crush energy; with pdof the direction of force\n  \
            [vehicleN.before] speed where a skid began, with its length and friction\n  \
            [vehicleN.after] speed, direction, yaw_rate after the impact\n  \
            [vehicleN.after] rest and points, with drag and [surface] friction: each draw is followed to rest\n  \
            [vehicleN.recorder] what an event data recorder stored: ΔV, its direction, speed, yaw rate\n  \
            certain_speed = { at_least = \"0 km/h\", at_most = \"60 km/h\" }: other speeds are excluded\n\n\
            Ranges are what is known before the evidence. A heading, mass, contact point or crush plane without a \
            range is taken to be as uncertain as it usually is; evidence without an error gets a default one; a \
            restitution or tangential condition without a range is the middle of what such collisions have. The \
            report lists all of these. [estimate] changes what is assumed: prior = \"flat\" in place of \"field\" \
            (as severe as collisions of which a vehicle was towed), delta_v_median, crush_error, crush_bias, \
            rest_error, rest_least_error, rest_heading_error, and stood.\n\n\
            Each piece of evidence is shown with what it says alone, with the answer without it, and with the \
            probability, by all others, of an observation as far off: what contradicts the rest is warned of. \
            Where the run has not converged, no interval is given at all. The same seed gives the same bytes, with any number \
            of threads.",
        after_help = "Examples:\n  deltav estimate fixtures/estimate.toml\n  \
            deltav estimate fixtures/estimate.toml --above \"vehicle1.speed 50 km/h\"\n  \
            deltav estimate fixtures/estimate.toml --prior flat --no-pieces --format json -o result.json\n  \
            deltav estimate fixtures/estimate.toml --format html -o report.html --samples-out draws.csv\n\n\
            Exit status: 0 done; 1 no answer, or the run has not converged; 2 the case file or the command line is wrong."
    )]
    Estimate(EstimateArguments),
    /// Draw the scene, the motion, the momenta, the damage, the reconciliation, the energy or an estimate, as
    /// SVG, PNG or PDF
    #[command(
        long_about = "Draw the scene, the motion, the momenta, the damage, the reconciliation, the energy or an estimate, as SVG, PNG or PDF.\n\n\
            A case with [reconstruct] is reconstructed first; a case with both speeds is computed forward; for a case without [impact], the damage and the motion after the impact can be drawn. Scene, motion and damage are to scale. The damaged body is filled, and its shape before the damage is dashed. A vehicle that has neither class nor length, width and cg_to_front is drawn with the outline of the CRASH3 size class whose radius of gyration is nearest to its own, and the legend notes this. If its radius of gyration or its contact point does not fit a car of that class, the scene shows its centre of gravity and its arrows, and no body.\n\n--plain draws the scene or the motion for readers who are no engineers: the vehicles by name and their speeds before and after the impact, without symbols, axes or forces.\n\nA case that has more evidence than an exact solution uses has its answer from `deltav reconstruct`, which weighs all of it: drawings of the exact solution say below the title that they are not the answer, and --plain draws the speeds by all the evidence, which takes as long as an estimate.\n\n--what estimate draws the results of `deltav estimate` with its default options: how probable each unknown speed is, both speeds together if both are unknown, and where the vehicles come to rest if they are followed.\n\nStandard error says how many warnings the case has. The letters of PNG and PDF are those of DejaVu Sans. If a text has other letters, standard error names them, and the picture has ? in their place; an SVG uses the fonts of its reader.",
        after_help = "Examples:\n  deltav draw fixtures/sae-980025.toml --what scene -o scene.svg\n  \
            deltav draw fixtures/sae-980025.toml --what scene --plain -o exhibit.pdf\n  \
            deltav draw fixtures/sae-980025.toml --what energy -o energy.png\n  \
            deltav draw fixtures/estimate.toml --what estimate -o estimate.svg\n  \
            deltav draw case.toml --what motion --site-plan aerial.jpg --plan-corner \"-20 m, -15 m\" --plan-width \"60 m\" -o motion.pdf"
    )]
    Draw(DrawArguments),
    /// Measure the program's error rate on built-in staged collisions
    #[command(
        long_about = "Measure the program's error rate on built-in staged collisions.\n\n\
            Runs eleven of the RICSAC staged collisions (Jones & Baum 1978) and compares the results with \
            the published ones: Tables 1 to 3 and the appendix of SAE 980025, and the energies of SAE \
            871993. Each number is either claimed to reproduce within a tolerance, or listed with the \
            reason why it does not; misprints are marked ERRATUM. Then reconstructs the speed of vehicle 1 \
            of each collision from its crush, compares it with the true speed, and shows the error rate and \
            how it depends on the analyst's choices.\n\n\
            It reads no file: the data are fixtures/ricsac/*.toml as they were when the program was built. \
            To try a change, edit one of those files and run `deltav reconstruct` on it.\n\n\
            With --field FILE it judges intervals of ΔV by real crashes in place of that: a table (CSV) with \
            one line for each pair of vehicles, and the columns of NHTSA's Crash Investigation Sampling System \
            with _1 and _2 for the two vehicles. The ΔV of each vehicle with a recorder is estimated from the \
            damage, the headings, the PDOF and the masses, with both speeds unknown, and compared with what its \
            recorder stored: how often the 50, 80 and 95 % intervals contain it, and how far off the median is. \
            With --other the recorder of the other vehicle is given. The columns: CASEID, CURBWT (kg), CARGOWT \
            (kg), CDCPLANE (F, B, L or R), PDOF and HEADINGANG (degrees), FIELDL, DIRECTL, DIRECTD and C1 to \
            C6 (cm), MAXDVLONG and MAXDVLAT (km/h) of the recorder, and DVTOTAL and DVLONG (km/h) of WinSMASH, \
            which is judged beside and is no input. VEHNO may be missing; with it the program leaves records \
            out that seem to belong to another event of the crash.",
        after_help = "Examples:\n  deltav validate\n  deltav validate --format json -o validation.json\n  \
            deltav validate --format markdown -o docs/validation.md --plots docs\n  \
            deltav validate --field ciss-pairs.csv\n  deltav validate --field ciss-pairs.csv --other --format json\n\n\
            Exit status: 0 every claimed number reproduces; 1 at least one does not. With --field: 0 done."
    )]
    Validate(ValidateArguments),
    /// Explain a term, a symbol, a key of the case file or the code of a warning
    #[command(
        long_about = "Explain a term, a symbol, a key of the case file or the code of a warning.\n\n\
            The same texts are in crates/report/glossary.md. Without a topic, the command lists all topics.\n\n\
            --format json writes \"term\", \"kind\", \"also\" (other names), \"text\" (Markdown) and \
            \"see_also\" (terms that the text uses); without a topic, it writes a list of all topics.",
        after_help = "Examples:\n  deltav explain\n  deltav explain crush plane\n  deltav explain μ_c\n  \
            deltav explain vehicle1.crush.offset\n  deltav explain delta-v-differs\n  \
            deltav explain --format json -o glossary.json"
    )]
    Explain(ExplainArguments),
    /// Print the JSON Schema of the case file, for editors
    #[command(
        long_about = "Print the JSON Schema of the case file, for editors.\n\n\
            If the first line of a case file is `#:schema case.schema.json`, with the path from the case to \
            the schema, Visual Studio Code with the extension Even Better TOML and other editors built on \
            Taplo complete and check the file while you write it. The program itself does not need the \
            schema, and checks more.",
        after_help = "Example:\n  deltav schema -o case.schema.json"
    )]
    Schema(SchemaArguments),
    /// Print shell completions
    #[command(
        long_about = "Print shell completions: commands, options and their values on the Tab key.",
        after_help = "Examples:\n  deltav completions bash > ~/.local/share/bash-completion/completions/deltav\n  \
            deltav completions zsh > ~/.zfunc/_deltav\n  deltav completions fish > ~/.config/fish/completions/deltav.fish"
    )]
    Completions(CompletionsArguments),
    /// Print the manual page
    #[command(
        long_about = "Print the manual page, in roff.\n\nWith --output-dir, write it and one page for each \
        command into a folder instead.",
        after_help = "Examples:\n  deltav man > deltav.1\n  deltav man --output-dir ~/.local/share/man/man1"
    )]
    Man(ManArguments),
}

/// A file, or standard output, which is also called `-`.
#[derive(Clone, Debug)]
pub(crate) struct Destination(PathBuf);

impl Destination {
    /// Nothing where it is standard output.
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

    /// Text for people, JSON for programs, or a page as HTML or Markdown
    #[arg(long, value_enum, default_value_t = Format::Text)]
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
    /// The case file (TOML), or - for standard input; with --format csv or jsonl several, or a folder for its
    /// .toml files in the order of their names
    #[arg(value_name = "CASE", required = true)]
    pub(crate) cases: Vec<PathBuf>,

    /// Text for people, JSON in SI units and radians for programs, or a report to hand over: one HTML file
    /// with drawings, or Markdown; for any number of files, one row each as CSV or as a line of JSON
    #[arg(long, value_enum, default_value_t = CasesFormat::Text)]
    pub(crate) format: CasesFormat,

    /// Units of text, report and csv; the default is the units that most of the case file uses, and SI for
    /// csv
    #[arg(long, value_enum)]
    pub(crate) units: Option<UnitSystem>,

    /// Number of threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// How a spreadsheet reads the csv
    #[arg(long, value_name = "STYLE", value_enum, default_value_t = CsvStyle::International)]
    pub(crate) csv_style: CsvStyle,

    /// Write to FILE instead of standard output; a case file, or any other .toml file, is not overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Debug, Args)]
pub(crate) struct ReconstructArguments {
    #[command(flatten)]
    pub(crate) report: ReportArguments,

    /// Print the exact solution alone, even where the case has more evidence than that uses. Rows (csv and
    /// jsonl) always are the exact solutions
    #[arg(long)]
    pub(crate) exact: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ReportArguments {
    #[command(flatten)]
    pub(crate) cases: CasesArguments,

    /// With --format html: put the program itself into the report, so that its reader can change a number in
    /// any browser and see what follows; the report as it was handed over stands unchanged below
    #[arg(long)]
    pub(crate) live: bool,

    /// The page that --live puts the report into; the default is deltav.html beside the program
    #[arg(long, value_name = "FILE", requires = "live")]
    pub(crate) page: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CsvStyle {
    /// Commas between the columns, decimal points
    International,
    /// Semicolons between the columns, decimal commas, byte order mark
    European,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CasesFormat {
    Text,
    Json,
    Html,
    Markdown,
    Csv,
    Jsonl,
}

/// What has a row for each of many cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rows {
    Csv,
    Jsonl,
}

impl CasesFormat {
    /// The format of a document on one case, or that of rows.
    pub(crate) fn of_one(self) -> Result<Format, Rows> {
        match self {
            Self::Text => Ok(Format::Text),
            Self::Json => Ok(Format::Json),
            Self::Html => Ok(Format::Html),
            Self::Markdown => Ok(Format::Markdown),
            Self::Csv => Err(Rows::Csv),
            Self::Jsonl => Err(Rows::Jsonl),
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct NewArguments {
    /// Kind of case
    #[arg(long, value_enum, default_value_t = Template::FrontSide)]
    pub(crate) template: Template,

    /// Units of the numbers; they are round in either
    #[arg(long, value_enum, default_value_t = CaseUnits::Si)]
    pub(crate) units: CaseUnits,

    /// Write to FILE, which must not exist, instead of standard output
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CaseUnits {
    /// kg, m, cm, km/h
    Si,
    /// lb, in, mph
    Us,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Template {
    /// The front of one vehicle against the side of the other
    FrontSide,
    /// Two fronts, offset
    HeadOn,
    /// A front against the rear of a waiting vehicle
    RearEnd,
    /// A front against the rear of a waiting vehicle: both came to rest, neither speed is known
    RearEndRest,
    /// Two vehicles that cross: both came to rest, neither speed is known
    Intersection,
    /// A vehicle against a wall
    Barrier,
    /// A vehicle that scrapes along the side of another
    Sideswipe,
    /// Two cars whose energy equivalent speeds (EES) are known
    Ees,
    /// A car against the rear of a heavy truck (lorry)
    HeavyTruck,
    /// One vehicle with its damage, for `deltav crush`
    OneVehicle,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArguments {
    /// Write to FILE instead of standard output; a case file, or any other .toml file, is not overwritten
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
    /// Write the pages of the program and of each command into DIR, which is created if needed
    #[arg(long, value_name = "DIR")]
    pub(crate) output_dir: Option<PathBuf>,
}

/// Of the commands that have a report to hand over.
#[derive(Debug, Args)]
pub(crate) struct DrawArguments {
    /// The case file (TOML), or - for standard input
    pub(crate) case: PathBuf,

    /// What to draw
    #[arg(long, value_enum)]
    pub(crate) what: What,

    /// Units of the drawing; the default is the units that most of the case file uses
    #[arg(long, value_enum)]
    pub(crate) units: Option<UnitSystem>,

    /// Draw the scene or the motion in plain words, without symbols and axes
    #[arg(long)]
    pub(crate) plain: bool,

    /// Draw the motion on this site plan or aerial picture, a PNG or a JPEG, in place of that of [scene]
    #[arg(long, value_name = "FILE", requires_all = ["plan_corner", "plan_width"])]
    pub(crate) site_plan: Option<PathBuf>,

    /// Where the lower left corner of the site plan lies in the scene, such as "-20 m, -15 m"
    #[arg(long, value_name = "X, Y", value_parser = place, requires = "site_plan", allow_hyphen_values = true)]
    pub(crate) plan_corner: Option<[Quantity; 2]>,

    /// How wide the site plan is, such as "60 m"
    #[arg(long, value_name = "LENGTH", value_parser = length, requires = "site_plan")]
    pub(crate) plan_width: Option<Quantity>,

    /// Angle from the scene's x axis to the lower edge of the site plan, such as "15 deg"
    #[arg(long, value_name = "ANGLE", value_parser = angle, requires = "site_plan", allow_hyphen_values = true)]
    pub(crate) plan_angle: Option<Quantity>,

    /// Write to FILE, which must end in .svg, .png or .pdf; without this option, SVG goes to standard output
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum What {
    /// Plan view at impact: outlines, contact point, crush plane, impulse, velocities, PDOF
    Scene,
    /// Each damaged vehicle with its crush profile in place
    Damage,
    /// Work of the normal impulse against the speed sought
    Reconciliation,
    /// Where the initial kinetic energy went
    Energy,
    /// Plan view from the approach over the impact to rest, with the marks of the wheels
    Motion,
    /// Speed, yaw rate and heading over the time from the impact to rest
    MotionCurves,
    /// The momentum polygon: momenta before and after the impact, tip to tail
    Momentum,
    /// How probable the speeds are by all evidence, one by one and both at once, and where the vehicles
    /// would have come to rest: the pictures of `deltav estimate`, below each other
    Estimate,
}

#[derive(Debug, Args)]
pub(crate) struct SensitivityArguments {
    #[command(flatten)]
    pub(crate) arguments: Arguments,

    /// Step of the PDOF sweep in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 5.0, value_parser = degrees, allow_negative_numbers = true)]
    pub(crate) pdof_step: f64,

    /// Number of steps to each side of the nominal direction
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

    /// Number of samples; four times as many halve the standard errors [default: 100000, or 1000 where the
    /// vehicles are searched back from their rests]
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(crate) samples: Option<usize>,

    /// Random seed
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,

    /// Sampling method
    #[arg(long, value_enum, default_value_t = Method::MonteCarlo)]
    pub(crate) method: Method,

    /// Only these results, by their names in the JSON with commas between them, such as
    /// vehicle1.speed,vehicle1.delta_v: the others cost no memory and little time [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = output_name)]
    pub(crate) outputs: Option<Vec<String>>,

    /// Also compute Sobol' indices: the share of the variance that each input causes. This takes ROWS ×
    /// (number of uncertain inputs + 2) evaluations
    #[arg(long, value_name = "ROWS", num_args = 0..=1, require_equals = true, default_missing_value = "4096", value_parser = rows)]
    pub(crate) sobol: Option<usize>,

    /// Also write every sample and its inputs to FILE as CSV (SI units and radians), of one case; a .toml
    /// file is not overwritten
    #[arg(long, value_name = "FILE")]
    pub(crate) samples_out: Option<PathBuf>,

    /// Also write a histogram and a tornado of each result into DIR, which is created if needed
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,

    /// Format of the plots
    #[arg(long, value_enum, default_value_t = PlotsFormat::Svg, requires = "plots")]
    pub(crate) plots_format: PlotsFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlotsFormat {
    Svg,
    Png,
    Pdf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    /// Independent points
    MonteCarlo,
    /// Each range divided into equal shares, one point in each
    LatinHypercube,
    /// Scrambled Sobol' points, best if N is a power of two
    Sobol,
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
    match text.parse::<f64>() {
        Ok(degrees) if degrees > 0.0 && degrees <= 180.0 => Ok(degrees),
        _ => Err("give degrees above 0 and up to 180, such as 5".to_owned()),
    }
}

#[derive(Debug, Args)]
pub(crate) struct EstimateArguments {
    #[command(flatten)]
    pub(crate) arguments: Arguments,

    /// Random seed
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,

    /// Number of particles of each of 16 islands, a multiple of 128; it is doubled up to twice where the run
    /// does not converge, and the default also where its draws are worth fewer than 1,000 independent ones
    #[arg(long, value_name = "N", default_value_t = EstimatePlan::PARTICLES, value_parser = particles)]
    pub(crate) particles: usize,

    /// Number of threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// How severe the collision may have been before the evidence, in place of `prior` of [estimate]
    #[arg(long, value_enum)]
    pub(crate) prior: Option<EstimatePrior>,

    /// Do not find what each piece of evidence says alone, and the answer without it, which takes most of the
    /// time
    #[arg(long)]
    pub(crate) no_pieces: bool,

    /// Also tell the probability that a result is above a limit, such as "vehicle1.speed 50 km/h": a key of
    /// `outputs` in the JSON, a number and a unit; may be repeated
    #[arg(long, value_name = "QUESTION", allow_hyphen_values = true)]
    pub(crate) above: Vec<String>,

    /// Also write every draw to FILE as CSV (SI units and radians); a .toml file is not overwritten
    #[arg(long, value_name = "FILE")]
    pub(crate) samples_out: Option<PathBuf>,

    /// How a spreadsheet reads the csv
    #[arg(long, value_name = "STYLE", value_enum, default_value_t = CsvStyle::International, requires = "samples_out")]
    pub(crate) csv_style: CsvStyle,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum EstimatePrior {
    /// As collisions of which a vehicle was towed
    Field,
    /// Any speed is as likely as any other
    Flat,
}

impl From<EstimatePrior> for Prior {
    fn from(prior: EstimatePrior) -> Self {
        match prior {
            EstimatePrior::Field => Self::Field,
            EstimatePrior::Flat => Self::Flat,
        }
    }
}

/// What can be dealt in two halves of whole blocks.
fn particles(text: &str) -> Result<usize, String> {
    let particles = count(text)?;
    if !Settings::can_have(particles) {
        return Err(format!(
            "give a multiple of {PARTICLES_STEP} up to {MOST_PARTICLES}, such as {}",
            EstimatePlan::PARTICLES
        ));
    }
    Ok(particles)
}

#[derive(Debug, Args)]
pub(crate) struct TableArguments {
    /// The table: a Parquet file, or CSV, or - for CSV on standard input
    #[arg(required_unless_present_any = ["schema", "columns"])]
    pub(crate) cases: Option<PathBuf>,

    /// The case file (TOML), or part of one, with what all rows share
    #[arg(long, value_name = "FILE")]
    pub(crate) template: Option<PathBuf>,

    /// What is done with each row
    #[arg(long, value_enum, default_value_t = TableJob::Reconstruct)]
    pub(crate) job: TableJob,

    /// Number of samples of each row, for intervals; for the jobs reconstruct and impact
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(crate) samples: Option<usize>,

    /// Random seed of every row, unless the table has a column `seed`
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,

    /// Number of particles of each of 16 islands, a multiple of 128; for the job estimate
    #[arg(long, value_name = "N", default_value_t = EstimatePlan::PARTICLES, value_parser = particles)]
    pub(crate) particles: usize,

    /// How severe the collisions may have been before the evidence; for the job estimate
    #[arg(long, value_enum)]
    pub(crate) prior: Option<EstimatePrior>,

    /// Number of threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// Columns of the table to carry over, separated by commas; they come before the results. The default is
    /// all columns that are not keys
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    pub(crate) keep: Option<Vec<String>>,

    /// List the columns that a table can have, each with its SI unit, what it holds and its meaning
    #[arg(long, conflicts_with = "columns")]
    pub(crate) schema: bool,

    /// List the columns of the results
    #[arg(long)]
    pub(crate) columns: bool,

    /// Write to FILE instead of standard output: Parquet where it ends in .parquet, else CSV; a case file, or
    /// any other .toml file, is not overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableJob {
    /// The speed at which impact and crush agree
    Reconstruct,
    /// What the impact does, both speeds given
    Impact,
    /// CRASH3: energies and ΔV from the damage alone
    Crush,
    /// Both speeds from all the evidence
    Estimate,
}

#[derive(Debug, Args)]
pub(crate) struct ValidateArguments {
    /// Text for people, JSON in SI units and radians for programs, or a page as HTML or Markdown
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,

    /// Write to FILE instead of standard output; a case file, or any other .toml file, is not overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,

    /// Judge intervals of ΔV by the recorders of the real crashes in FILE (CSV) in place of the staged
    /// collisions
    #[arg(long, value_name = "FILE")]
    pub(crate) field: Option<PathBuf>,

    /// Give the recorder of one vehicle, and judge the other vehicle
    #[arg(long, requires = "field")]
    pub(crate) other: bool,

    /// Seed of the random numbers: the same seed gives the same results
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = seed, requires = "field")]
    pub(crate) seed: u64,

    /// Number of threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), requires = "field")]
    pub(crate) threads: Option<u16>,

    /// Also write the plots computed-against-measured.svg and reconstructed-speed.svg into DIR, which is
    /// created if needed; with --field estimated-against-recorded.svg and ranks-of-recorders.svg
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,

    /// Format of the plots, which is also the ending of their names
    #[arg(long, value_enum, default_value_t = PlotsFormat::Svg, requires = "plots")]
    pub(crate) plots_format: PlotsFormat,
}

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The case file (TOML), or - for standard input
    pub(crate) case: PathBuf,

    /// Text for people, JSON in SI units and radians for programs, or a document to hand over: one HTML file,
    /// or Markdown
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,

    /// Units of the text; the default is the units that most of the case file uses
    #[arg(long, value_enum)]
    pub(crate) units: Option<UnitSystem>,

    /// Write to FILE instead of standard output; a case file, or any other .toml file, is not overwritten
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub(crate) output: Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Text,
    Json,
    Html,
    Markdown,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UnitSystem {
    /// ft/s, mph, lb, ft·lb, in
    Us,
    /// m/s, km/h, kg, J, cm
    Si,
    /// As si, but speeds of vehicles in mph
    Uk,
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
