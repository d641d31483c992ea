//! The columns of results.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock};

use analysis::quantities::{
    CORRECTED_CRUSH_ENERGY, CRUSH_ENERGY, CRUSH_ENERGY_BOUNDS_HIGH, CRUSH_ENERGY_BOUNDS_LOW, EES,
    NO_DAMAGE_SPEED, OBLIQUE_ANGLE, OBLIQUE_FACTOR, PDOF, PEAK_FORCE,
};
use analysis::{
    Agreement, Analysis, Avoidance, Estimated, Output, OutputQuantity, QUANTITIES, Samples, Seen, Warning,
};
use arrow_array::builder::{BooleanBuilder, Float64Builder, Int64Builder, ListBuilder, StringBuilder};
use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use case::{Axes, Case, SeverityPrior, word};
use pim_core::VehicleId;
use report::{Units, led_by};
use requests::RowRefusal;

use crate::error::TableError;
use crate::job::{Job, RowOptions};

/// The quantities of a vehicle that damage alone gives, in addition to all those of CRASH3.
const OF_DAMAGE: [OutputQuantity; 10] = [
    PDOF,
    CRUSH_ENERGY,
    CRUSH_ENERGY_BOUNDS_LOW,
    CRUSH_ENERGY_BOUNDS_HIGH,
    EES,
    OBLIQUE_ANGLE,
    OBLIQUE_FACTOR,
    CORRECTED_CRUSH_ENERGY,
    PEAK_FORCE,
    NO_DAMAGE_SPEED,
];

/// The statistics of an interval, in the order of their columns.
const STATISTICS: [&str; 5] = ["p025", "median", "p975", "mean", "sd"];

/// Their values for one output.
type Statistics = [f64; STATISTICS.len()];

/// Reads a value of the avoidability.
type OfAvoidance<T> = fn(&Case, &Avoidance) -> Option<T>;

/// The numbers of avoidability, by the keys of the JSON of `deltav avoid`.
const AVOIDED: [(&str, OfAvoidance<f64>); 17] = [
    ("speed", |_, found| Some(found.scene.speed)),
    ("exact_speed_at_impact", |_, found| found.exact_speed()),
    ("demand_distance", |_, found| Some(found.scene.distance)),
    ("demand_time", |_, found| Some(found.scene.time)),
    ("sight_time", |_, found| Some(found.scene.view.sight()?.time)),
    ("sight_distance_subject", |_, found| Some(found.scene.view.sight()?.distance_subject)),
    ("sight_distance_other", |_, found| Some(found.scene.view.sight()?.distance_other)),
    ("stopping_distance", |_, found| Some(found.scene.stopping_distance())),
    ("spatial_speed", |_, found| Some(found.scene.spatial())),
    ("temporal_speed", |_, found| found.scene.temporal()),
    ("at_limit_collision_speed", |_, found| Some(found.scene.left_at_limit())),
    ("at_limit_vehicle1_delta_v", |case, found| delta_v_at_limit(case, found, VehicleId::One)),
    ("at_limit_vehicle2_delta_v", |case, found| delta_v_at_limit(case, found, VehicleId::Two)),
    ("enough_speed", |_, found| Some(found.enough.speed)),
    ("probability_avoided_at_limit", |_, found| Some(found.chance.as_ref()?.avoided_at_limit)),
    ("probability_above_limit", |_, found| Some(found.chance.as_ref()?.above_limit)),
    ("probability_mc_error", |_, found| Some(found.chance.as_ref()?.mc_error)),
];

/// Whether the evidence determines the speed, and the answers at the limit, in the same way.
const AVOIDABLE: [(&str, OfAvoidance<bool>); 3] = [
    ("speed_determined", |_, found| Some(found.undetermined().is_none())),
    ("spatial_avoidable_at_limit", |_, found| Some(found.scene.stops_at_limit())),
    ("temporal_avoidable_at_limit", |_, found| found.scene.is_late_at_limit()),
];

/// (m/s) of a vehicle that can move.
fn delta_v_at_limit(case: &Case, found: &Avoidance, id: VehicleId) -> Option<f64> {
    let delta_v = found.run_at_limit()?.delta_v?;
    (!case.vehicles[id.index()].fixed).then_some(delta_v[id.index()])
}

/// The results of one row.
pub(crate) struct Found {
    axes: Axes,
    warnings: Vec<String>,
    of: FoundBy,
}

/// The results of the job.
enum FoundBy {
    Analysis(Box<Solved>, Option<Spread>),
    Estimate(EstimateFound),
    Avoidance(Box<AvoidFound>),
}

/// An exact solution.
struct Solved {
    seen: Seen,
    /// The headline of the reconstruction of its case alone, and the codes of the checks that refute it.
    headline: Option<(&'static str, Vec<String>)>,
}

/// The results on avoidability.
struct AvoidFound {
    speed_source: &'static str,
    /// By the places of [`AVOIDED`] and [`AVOIDABLE`].
    numbers: [Option<f64>; AVOIDED.len()],
    flags: [Option<bool>; AVOIDABLE.len()],
}

/// The statistics of the samples of a row.
pub(crate) struct Spread {
    samples: usize,
    succeeded: usize,
    /// By the places of [`OUTPUTS`].
    of: Vec<Option<Statistics>>,
}

/// The estimate of a row.
struct EstimateFound {
    converged: bool,
    ess: f64,
    contradicting: Vec<String>,
    /// Pairs of keys, each pair in one text.
    same_twice: Vec<String>,
    /// The results that vary and that the evidence does not determine.
    undetermined: Vec<String>,
    tested: Option<&'static str>,
    /// By the places of [`DRAWN`].
    of: Vec<Option<Statistics>>,
}

/// The outcome of a row: a result, or the reason why there is none. An estimate that has not converged has
/// both.
pub(crate) struct Outcome {
    pub(crate) found: Option<Found>,
    pub(crate) refusal: Option<RowRefusal>,
}

/// The outputs that samples can have: no job of a table samples the damage alone.
static OUTPUTS: LazyLock<Vec<Output>> =
    LazyLock::new(|| Output::all().into_iter().filter(|output| !output.quantity().is_of_damage()).collect());

/// The outputs that an estimate can have.
static DRAWN: LazyLock<Vec<Output>> = LazyLock::new(|| {
    let (all, drawn) = (Output::all(), Output::drawn());
    let shared = all.iter().filter(|output| drawn.contains(output));
    let others = drawn.iter().filter(|output| !all.contains(output));
    shared.chain(others).copied().collect()
});

/// The name of a column: the key of the JSON, without its dots.
fn column(path: &str) -> String {
    path.replace('.', "_")
}

/// A column: how a row is read for it, and what has been read.
enum Column {
    Numbers(Read<f64>, Float64Builder),
    Wholes(fn(&Found) -> Option<usize>, Int64Builder),
    Flags(Read<bool>, BooleanBuilder),
    Lists(fn(&Found) -> Option<&[String]>, ListBuilder<StringBuilder>),
    Texts(fn(&Outcome) -> Option<&str>, StringBuilder),
}

/// How a number or a flag is read from what was found.
type Read<T> = Box<dyn Fn(&Found) -> Option<T> + Send + Sync>;

fn numbers(read: impl Fn(&Found) -> Option<f64> + Send + Sync + 'static) -> Column {
    Column::Numbers(Box::new(read), Float64Builder::new())
}

fn wholes(read: fn(&Found) -> Option<usize>) -> Column {
    Column::Wholes(read, Int64Builder::new())
}

fn flags(read: impl Fn(&Found) -> Option<bool> + Send + Sync + 'static) -> Column {
    Column::Flags(Box::new(read), BooleanBuilder::new())
}

fn lists(read: fn(&Found) -> Option<&[String]>) -> Column {
    Column::Lists(read, ListBuilder::new(StringBuilder::new()))
}

fn texts(read: fn(&Outcome) -> Option<&str>) -> Column {
    Column::Texts(read, StringBuilder::new())
}

fn columns(job: Job, samples: Option<usize>) -> Vec<(String, Column)> {
    let named = |name: &str, column: Column| (name.to_owned(), column);
    let warnings = || named("warnings", lists(|found| Some(&found.warnings)));
    let mut columns = vec![
        named("error", texts(|outcome| Some(&outcome.refusal.as_ref()?.error))),
        named(
            "help",
            texts(|outcome| Some(&*outcome.refusal.as_ref()?.help).filter(|help| !help.is_empty())),
        ),
        named("axes", texts(|outcome| Some(outcome.found.as_ref()?.axes.name()))),
    ];
    match job {
        Job::Estimate => {
            columns.push(named("converged", flags(|found| Some(found.estimate()?.converged))));
            columns.push(named("ess", numbers(|found| Some(found.estimate()?.ess))));
            columns.push(named("contradicting", lists(|found| Some(&found.estimate()?.contradicting))));
            columns.push(named("same_twice", lists(|found| Some(&found.estimate()?.same_twice))));
            columns.push(named("undetermined", lists(|found| Some(&found.estimate()?.undetermined))));
            columns.push(named("tested", texts(|outcome| outcome.found.as_ref()?.estimate()?.tested)));
            columns.push(warnings());
            columns.extend(statistics(&DRAWN, |found| Some(&found.estimate()?.of)));
            return columns;
        }
        Job::Avoid => {
            let source = texts(|outcome| Some(outcome.found.as_ref()?.avoidance()?.speed_source));
            columns.push(named("avoid_speed_source", source));
            for (place, (name, _)) in AVOIDED.into_iter().enumerate() {
                let column = numbers(move |found| found.avoidance()?.numbers[place]);
                columns.push((format!("avoid_{name}"), column));
            }
            for (place, (name, _)) in AVOIDABLE.into_iter().enumerate() {
                columns.push((format!("avoid_{name}"), flags(move |found| found.avoidance()?.flags[place])));
            }
            columns.push(warnings());
            return columns;
        }
        Job::Crush | Job::Reconstruct | Job::Impact => {}
    }
    columns.push(named("energy_basis", texts(|outcome| Some(outcome.found.as_ref()?.seen()?.basis.name()))));
    if job == Job::Reconstruct {
        columns.push(named("headline_by", texts(|outcome| Some(outcome.found.as_ref()?.headline()?.0))));
        columns.push(named("left_aside", lists(|found| Some(&found.seen()?.left_aside))));
        columns.push(named("refuted_by", lists(|found| Some(&found.headline()?.1))));
    }
    if job != Job::Crush {
        columns.push(named("found_quantity", texts(found_quantity)));
        let admissible = |found: &Found| Some(found.seen()?.found.as_ref()?.admissible.len());
        columns.push(named("found_admissible_roots", wholes(admissible)));
    }
    let is_wanted = |quantity: &&'static OutputQuantity| {
        job != Job::Crush
            || quantity.key.starts_with("crash3.")
            || OF_DAMAGE.iter().any(|row| row.key == quantity.key)
    };
    let mut push = |name: String, quantity: &'static OutputQuantity, of: Option<VehicleId>| {
        columns.push((column(&name), numbers(move |found| quantity.value(found.seen()?, of))));
    };
    let wanted = || QUANTITIES.iter().filter(is_wanted);
    for quantity in wanted().filter(|quantity| !quantity.is_of_vehicle()) {
        push(quantity.key.to_owned(), quantity, None);
    }
    for id in VehicleId::ALL {
        for quantity in wanted().filter(|quantity| quantity.is_of_vehicle()) {
            push(format!("vehicle{id}.{}", quantity.key), quantity, Some(id));
        }
    }
    columns.push(warnings());
    if samples.is_some() {
        columns.push(named("samples", wholes(|found| Some(found.spread()?.samples))));
        columns.push(named("samples_succeeded", wholes(|found| Some(found.spread()?.succeeded))));
        columns.extend(statistics(&OUTPUTS, |found| Some(&found.spread()?.of)));
    }
    columns
}

/// The columns of the statistics of some outputs.
fn statistics(
    outputs: &[Output],
    read: fn(&Found) -> Option<&[Option<Statistics>]>,
) -> impl Iterator<Item = (String, Column)> {
    outputs.iter().enumerate().flat_map(move |(output, of)| {
        let name = column(&of.path());
        STATISTICS.into_iter().enumerate().map(move |(place, statistic)| {
            let column = numbers(move |found| Some(read(found)?[output]?[place]));
            (format!("{name}_{statistic}"), column)
        })
    })
}

fn found_quantity(outcome: &Outcome) -> Option<&str> {
    let found = outcome.found.as_ref()?.seen()?.found.as_ref()?;
    Some(match found.unknown {
        VehicleId::One => "vehicle1.speed",
        VehicleId::Two => "vehicle2.speed",
    })
}

impl Column {
    fn data_type(&self) -> DataType {
        match self {
            Self::Numbers(..) => DataType::Float64,
            Self::Wholes(..) => DataType::Int64,
            Self::Flags(..) => DataType::Boolean,
            Self::Lists(..) => DataType::List(Arc::new(Field::new_list_field(DataType::Utf8, true))),
            Self::Texts(..) => DataType::Utf8,
        }
    }

    fn push(&mut self, outcome: &Outcome) {
        let found = outcome.found.as_ref();
        match self {
            Self::Numbers(read, values) => values.append_option(found.and_then(read)),
            Self::Wholes(read, values) => {
                values.append_option(found.and_then(*read).and_then(|count| i64::try_from(count).ok()));
            }
            Self::Flags(read, values) => values.append_option(found.and_then(read)),
            Self::Lists(read, values) => match found.and_then(*read) {
                Some(words) => values.append_value(words.iter().map(Some)),
                None => values.append_null(),
            },
            Self::Texts(read, values) => values.append_option(read(outcome)),
        }
    }

    fn finish(self) -> ArrayRef {
        match self {
            Self::Numbers(_, mut values) => Arc::new(values.finish()),
            Self::Wholes(_, mut values) => Arc::new(values.finish()),
            Self::Flags(_, mut values) => Arc::new(values.finish()),
            Self::Lists(_, mut values) => Arc::new(values.finish()),
            Self::Texts(_, mut values) => Arc::new(values.finish()),
        }
    }
}

/// The schema of the results, whatever the cases are.
pub(crate) fn schema(job: Job, options: &RowOptions) -> SchemaRef {
    let fields: Vec<Field> = columns(job, options.samples)
        .into_iter()
        .map(|(name, column)| Field::new(name, column.data_type(), true))
        .collect();
    // Together with the cases, all that is needed to reproduce the results.
    let mut metadata = HashMap::from([
        ("deltav.version".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
        ("deltav.job".to_owned(), job.name().to_owned()),
        ("deltav.seed".to_owned(), options.seed.to_string()),
    ]);
    if let Some(samples) = options.samples {
        metadata.insert("deltav.samples".to_owned(), samples.to_string());
    }
    if job == Job::Estimate {
        metadata.insert("deltav.particles".to_owned(), options.particles.to_string());
        if let Some(prior) = options.prior {
            metadata.insert("deltav.prior".to_owned(), word(&SeverityPrior::WORDS, &prior).to_owned());
        }
    }
    Arc::new(Schema::new_with_metadata(fields, metadata))
}

/// The columns of results, filled row by row.
pub(crate) struct Builder {
    schema: SchemaRef,
    columns: Vec<Column>,
}

impl Builder {
    pub(crate) fn new(job: Job, options: &RowOptions) -> Self {
        let columns = columns(job, options.samples).into_iter().map(|(_, column)| column).collect();
        Self { schema: schema(job, options), columns }
    }

    pub(crate) fn push(&mut self, outcome: &Outcome) {
        for column in &mut self.columns {
            column.push(outcome);
        }
    }

    pub(crate) fn finish(self) -> Result<RecordBatch, TableError> {
        let arrays = self.columns.into_iter().map(Column::finish).collect();
        Ok(RecordBatch::try_new(self.schema, arrays)?)
    }
}

impl Found {
    fn seen(&self) -> Option<&Seen> {
        if let FoundBy::Analysis(solved, _) = &self.of { Some(&solved.seen) } else { None }
    }

    fn headline(&self) -> Option<&(&'static str, Vec<String>)> {
        if let FoundBy::Analysis(solved, _) = &self.of { solved.headline.as_ref() } else { None }
    }

    fn spread(&self) -> Option<&Spread> {
        if let FoundBy::Analysis(_, spread) = &self.of { spread.as_ref() } else { None }
    }

    fn estimate(&self) -> Option<&EstimateFound> {
        if let FoundBy::Estimate(found) = &self.of { Some(found) } else { None }
    }

    fn avoidance(&self) -> Option<&AvoidFound> {
        if let FoundBy::Avoidance(found) = &self.of { Some(found) } else { None }
    }

    pub(crate) fn of_analysis(case: &Case, analysis: &Analysis, spread: Option<Spread>) -> Self {
        let seen = analysis.seen(case.axes);
        let warnings = seen.warnings.iter().map(|seen| code(seen.warning())).collect();
        let why = analysis.why_not_exact();
        let headline = analysis.is_reconstruction().then(|| {
            let refuted_by = why.iter().flat_map(|why| &why.refuted_by);
            (led_by(None, why.as_ref()), refuted_by.map(|check| check.code().to_owned()).collect())
        });
        let solved = Solved { seen, headline };
        Self { axes: case.axes, warnings, of: FoundBy::Analysis(Box::new(solved), spread) }
    }

    pub(crate) fn of_avoidance(case: &Case, found: &Avoidance) -> Self {
        let numbers = AVOIDED.map(|(_, of)| of(case, found));
        let flags = AVOIDABLE.map(|(_, of)| of(case, found));
        Self {
            axes: case.axes,
            warnings: report::avoid_warnings(found, Units::Si),
            of: FoundBy::Avoidance(Box::new(AvoidFound {
                speed_source: found.speed_from.name(),
                numbers,
                flags,
            })),
        }
    }

    pub(crate) fn of_estimate(case: &Case, estimated: &Estimated) -> Self {
        let is_answer = estimated.no_answer().is_none();
        let of = |wanted: &Output| {
            let output = estimated.outputs.iter().find(|output| output.output == *wanted)?;
            let summary = &output.posterior;
            let widest = summary.intervals.last().filter(|_| is_answer)?;
            Some([widest.low, summary.median, widest.high, summary.mean, summary.sd].map(|one| one.value))
        };
        let undetermined = estimated.outputs.iter().filter(|output| is_answer && !output.is_told());
        let found = EstimateFound {
            converged: estimated.doubts().is_empty(),
            ess: estimated.ess(),
            contradicting: estimated.with_agreement(Agreement::Contradicts),
            same_twice: estimated.same_twice.iter().map(|same| same.keys.join(" ")).collect(),
            undetermined: undetermined.map(|output| output.output.path()).collect(),
            tested: estimated.tested.map(|class| class.code),
            of: DRAWN.iter().map(of).collect(),
        };
        let warnings = estimated.warnings.iter().map(code).collect();
        Self { axes: case.axes, warnings, of: FoundBy::Estimate(found) }
    }
}

/// The code of a warning, with its vehicle.
fn code(warning: &Warning) -> String {
    match warning.vehicle() {
        Some(id) => format!("vehicle{id}.{}", warning.code()),
        None => warning.code().to_owned(),
    }
}

impl Spread {
    pub(crate) fn of(Samples { outputs, propagation }: &Samples) -> Self {
        let of = |wanted: &Output| {
            let place = outputs.iter().position(|output| output == wanted)?;
            let summary = propagation.summaries().get(place)?.as_ref()?;
            let interval = summary.intervals.iter().find(|interval| interval.level == WIDEST)?;
            Some([interval.low, summary.median, interval.high, summary.mean, summary.sd].map(|one| one.value))
        };
        Self {
            samples: propagation.evaluated(),
            succeeded: propagation.succeeded(),
            of: OUTPUTS.iter().map(of).collect(),
        }
    }
}

/// Between the quantiles of 2.5 % and 97.5 %.
const WIDEST: f64 = 0.95;
