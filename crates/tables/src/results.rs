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
use report::Units;
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

/// The content of a column.
#[derive(Clone, Copy)]
enum What {
    Error,
    Help,
    /// Lists of words: the codes of warnings, of avoidability their sentences, and the keys of evidence that
    /// the rest contradicts.
    Warnings,
    Contradicting,
    Axes,
    EnergyBasis,
    FoundQuantity,
    AdmissibleRoots,
    Quantity(&'static OutputQuantity, Option<VehicleId>),
    /// The samples of a row, and those with an answer.
    Samples,
    Succeeded,
    /// A statistic of an output, by their places.
    OfSamples(usize, usize),
    Converged,
    EffectiveSamples,
    OfDraws(usize, usize),
    /// A number of [`AVOIDED`], and a flag of [`AVOIDABLE`], by their places.
    OfAvoidance(usize),
    IsAvoidable(usize),
}

/// Reads a value of the avoidability.
type OfAvoidance<T> = fn(&Case, &Avoidance) -> Option<T>;

/// The numbers of avoidability, by the keys of the JSON of `deltav avoid`.
const AVOIDED: [(&str, OfAvoidance<f64>); 16] = [
    ("speed", |_, found| Some(found.scene.speed)),
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

/// The answers at the limit, in the same way.
const AVOIDABLE: [(&str, OfAvoidance<bool>); 2] = [
    ("spatial_avoidable_at_limit", |_, found| Some(found.scene.stops_at_limit())),
    ("temporal_avoidable_at_limit", |_, found| found.scene.is_late_at_limit()),
];

/// (m/s) of a vehicle that can move.
fn delta_v_at_limit(case: &Case, found: &Avoidance, id: VehicleId) -> Option<f64> {
    let delta_v = found.run_at_limit()?.delta_v?;
    (!case.vehicles[id.index()].fixed).then_some(delta_v[id.index()])
}

/// The results of one row.
pub(crate) enum Found {
    Analysis(Box<Seen>, Vec<String>, Option<Spread>),
    Estimate(Box<EstimateFound>),
    Avoidance(Box<AvoidFound>),
}

/// The results on avoidability.
pub(crate) struct AvoidFound {
    axes: Axes,
    /// By the places of [`AVOIDED`] and [`AVOIDABLE`].
    numbers: [Option<f64>; AVOIDED.len()],
    flags: [Option<bool>; AVOIDABLE.len()],
    warnings: Vec<String>,
}

/// The statistics of the samples of a row.
pub(crate) struct Spread {
    samples: usize,
    succeeded: usize,
    /// By the places of [`OUTPUTS`].
    of: Vec<Option<[f64; STATISTICS.len()]>>,
}

/// The estimate of a row.
pub(crate) struct EstimateFound {
    axes: Axes,
    converged: bool,
    ess: f64,
    contradicting: Vec<String>,
    warnings: Vec<String>,
    /// By the places of [`DRAWN`].
    of: Vec<Option<[f64; STATISTICS.len()]>>,
}

/// The outcome of a row: a result, or the reason why there is none. An estimate that has not converged has
/// both.
pub(crate) struct Outcome {
    pub(crate) found: Option<Found>,
    pub(crate) refusal: Option<RowRefusal>,
}

/// The outputs that samples can have.
static OUTPUTS: LazyLock<Vec<Output>> = LazyLock::new(Output::all);

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

fn columns(job: Job, samples: Option<usize>) -> Vec<(String, What)> {
    let mut columns = vec![("error".to_owned(), What::Error), ("help".to_owned(), What::Help)];
    let named = |name: &str, what: What| (name.to_owned(), what);
    columns.push(named("axes", What::Axes));
    match job {
        Job::Estimate => {
            columns.push(named("converged", What::Converged));
            columns.push(named("ess", What::EffectiveSamples));
            columns.push(named("contradicting", What::Contradicting));
            columns.push(named("warnings", What::Warnings));
            for (place, output) in DRAWN.iter().enumerate() {
                columns.extend(statistics(*output, |statistic| What::OfDraws(place, statistic)));
            }
            return columns;
        }
        Job::Avoid => {
            let numbers = AVOIDED.iter().enumerate().map(|(k, (name, _))| (*name, What::OfAvoidance(k)));
            let flags = AVOIDABLE.iter().enumerate().map(|(k, (name, _))| (*name, What::IsAvoidable(k)));
            columns.extend(numbers.chain(flags).map(|(name, what)| (format!("avoid_{name}"), what)));
            columns.push(named("warnings", What::Warnings));
            return columns;
        }
        Job::Crush => columns.push(named("energy_basis", What::EnergyBasis)),
        Job::Reconstruct | Job::Impact => {
            columns.push(named("energy_basis", What::EnergyBasis));
            columns.push(named("found_quantity", What::FoundQuantity));
            columns.push(named("found_admissible_roots", What::AdmissibleRoots));
        }
    }
    let is_wanted = |quantity: &&OutputQuantity| {
        job != Job::Crush
            || quantity.key.starts_with("crash3.")
            || OF_DAMAGE.iter().any(|row| row.key == quantity.key)
    };
    let wanted = || QUANTITIES.iter().filter(is_wanted);
    for quantity in wanted().filter(|quantity| !quantity.is_of_vehicle()) {
        columns.push((column(quantity.key), What::Quantity(quantity, None)));
    }
    for id in VehicleId::ALL {
        for quantity in wanted().filter(|quantity| quantity.is_of_vehicle()) {
            let name = column(&format!("vehicle{id}.{}", quantity.key));
            columns.push((name, What::Quantity(quantity, Some(id))));
        }
    }
    columns.push(named("warnings", What::Warnings));
    if samples.is_some() {
        columns.push(named("samples", What::Samples));
        columns.push(named("samples_succeeded", What::Succeeded));
        for (place, output) in OUTPUTS.iter().enumerate() {
            columns.extend(statistics(*output, |statistic| What::OfSamples(place, statistic)));
        }
    }
    columns
}

fn statistics(output: Output, what: impl Fn(usize) -> What) -> impl Iterator<Item = (String, What)> {
    let name = column(&output.path());
    STATISTICS
        .into_iter()
        .enumerate()
        .map(move |(place, statistic)| (format!("{name}_{statistic}"), what(place)))
}

impl What {
    fn data_type(self) -> DataType {
        match self {
            Self::Error | Self::Help | Self::Axes | Self::EnergyBasis | Self::FoundQuantity => DataType::Utf8,
            Self::Warnings | Self::Contradicting => {
                DataType::List(Arc::new(Field::new_list_field(DataType::Utf8, true)))
            }
            Self::AdmissibleRoots | Self::Samples | Self::Succeeded => DataType::Int64,
            Self::Converged | Self::IsAvoidable(_) => DataType::Boolean,
            Self::Quantity(..)
            | Self::OfSamples(..)
            | Self::OfDraws(..)
            | Self::OfAvoidance(_)
            | Self::EffectiveSamples => DataType::Float64,
        }
    }

    fn number(self, found: &Found) -> Option<f64> {
        match (self, found) {
            (Self::Quantity(quantity, vehicle), Found::Analysis(seen, ..)) => quantity.value(seen, vehicle),
            (Self::OfSamples(place, statistic), Found::Analysis(_, _, Some(spread))) => {
                spread.of[place].map(|statistics| statistics[statistic])
            }
            (Self::OfDraws(place, statistic), Found::Estimate(found)) => {
                found.of[place].map(|statistics| statistics[statistic])
            }
            (Self::EffectiveSamples, Found::Estimate(found)) => Some(found.ess),
            (Self::OfAvoidance(place), Found::Avoidance(found)) => found.numbers[place],
            _ => None,
        }
    }

    fn flag(self, found: &Found) -> Option<bool> {
        match (self, found) {
            (Self::Converged, Found::Estimate(found)) => Some(found.converged),
            (Self::IsAvoidable(place), Found::Avoidance(found)) => found.flags[place],
            _ => None,
        }
    }

    fn whole(self, found: &Found) -> Option<i64> {
        let Found::Analysis(seen, _, spread) = found else { return None };
        let count = match self {
            Self::AdmissibleRoots => seen.found.as_ref()?.admissible.len(),
            Self::Samples => spread.as_ref()?.samples,
            Self::Succeeded => spread.as_ref()?.succeeded,
            _ => return None,
        };
        i64::try_from(count).ok()
    }

    fn words(self, found: &Found) -> Option<&[String]> {
        match (self, found) {
            (Self::Warnings, Found::Analysis(_, warnings, _)) => Some(warnings),
            (Self::Warnings, Found::Estimate(found)) => Some(&found.warnings),
            (Self::Warnings, Found::Avoidance(found)) => Some(&found.warnings),
            (Self::Contradicting, Found::Estimate(found)) => Some(&found.contradicting),
            _ => None,
        }
    }

    fn text(self, outcome: &Outcome) -> Option<&str> {
        let refusal = outcome.refusal.as_ref();
        match self {
            Self::Error => return refusal.map(|refusal| &*refusal.error),
            Self::Help => return refusal.map(|refusal| &*refusal.help).filter(|help| !help.is_empty()),
            _ => {}
        }
        match (self, outcome.found.as_ref()?) {
            (Self::Axes, Found::Analysis(seen, ..)) => Some(seen.axes.name()),
            (Self::Axes, Found::Estimate(found)) => Some(found.axes.name()),
            (Self::Axes, Found::Avoidance(found)) => Some(found.axes.name()),
            (Self::EnergyBasis, Found::Analysis(seen, ..)) => Some(seen.basis.name()),
            (Self::FoundQuantity, Found::Analysis(seen, ..)) => {
                let found = seen.found.as_ref()?;
                Some(match found.unknown.vehicle() {
                    VehicleId::One => "vehicle1.speed",
                    VehicleId::Two => "vehicle2.speed",
                })
            }
            _ => None,
        }
    }
}

/// The schema of the results, whatever the cases are.
pub(crate) fn schema(job: Job, options: &RowOptions) -> SchemaRef {
    let fields: Vec<Field> = columns(job, options.samples)
        .into_iter()
        .map(|(name, what)| Field::new(name, what.data_type(), true))
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
    columns: Vec<(What, Filled)>,
}

enum Filled {
    Numbers(Float64Builder),
    Wholes(Int64Builder),
    Texts(StringBuilder),
    Flags(BooleanBuilder),
    Lists(ListBuilder<StringBuilder>),
}

impl Builder {
    pub(crate) fn new(job: Job, options: &RowOptions) -> Self {
        let filled = |what: What| match what.data_type() {
            DataType::Float64 => Filled::Numbers(Float64Builder::new()),
            DataType::Int64 => Filled::Wholes(Int64Builder::new()),
            DataType::Boolean => Filled::Flags(BooleanBuilder::new()),
            DataType::List(_) => Filled::Lists(ListBuilder::new(StringBuilder::new())),
            _ => Filled::Texts(StringBuilder::new()),
        };
        let columns =
            columns(job, options.samples).into_iter().map(|(_, what)| (what, filled(what))).collect();
        Self { schema: schema(job, options), columns }
    }

    pub(crate) fn push(&mut self, outcome: &Outcome) {
        let found = outcome.found.as_ref();
        for (what, filled) in &mut self.columns {
            match filled {
                Filled::Numbers(numbers) => {
                    numbers.append_option(found.and_then(|found| what.number(found)));
                }
                Filled::Wholes(wholes) => wholes.append_option(found.and_then(|found| what.whole(found))),
                Filled::Texts(texts) => texts.append_option(what.text(outcome)),
                Filled::Flags(flags) => flags.append_option(found.and_then(|found| what.flag(found))),
                Filled::Lists(lists) => match found.and_then(|found| what.words(found)) {
                    Some(words) => lists.append_value(words.iter().map(Some)),
                    None => lists.append_null(),
                },
            }
        }
    }

    pub(crate) fn finish(self) -> Result<RecordBatch, TableError> {
        let arrays = self.columns.into_iter().map(|(_, filled)| -> ArrayRef {
            match filled {
                Filled::Numbers(mut numbers) => Arc::new(numbers.finish()),
                Filled::Wholes(mut wholes) => Arc::new(wholes.finish()),
                Filled::Texts(mut texts) => Arc::new(texts.finish()),
                Filled::Flags(mut flags) => Arc::new(flags.finish()),
                Filled::Lists(mut lists) => Arc::new(lists.finish()),
            }
        });
        Ok(RecordBatch::try_new(self.schema, arrays.collect())?)
    }
}

impl Found {
    pub(crate) fn analysis(case: &Case, analysis: &Analysis, spread: Option<Spread>) -> Self {
        let seen = analysis.seen(case.axes);
        let codes = seen.warnings.iter().map(|seen| code(seen.warning())).collect();
        Self::Analysis(Box::new(seen), codes, spread)
    }

    pub(crate) fn avoidance(case: &Case, found: &Avoidance) -> Self {
        Self::Avoidance(Box::new(AvoidFound {
            axes: case.axes,
            numbers: AVOIDED.map(|(_, of)| of(case, found)),
            flags: AVOIDABLE.map(|(_, of)| of(case, found)),
            warnings: report::avoid_warnings(found, Units::Si),
        }))
    }

    pub(crate) fn estimate(case: &Case, estimated: &Estimated) -> Self {
        let converged = estimated.doubts().is_empty();
        let of = |wanted: &Output| {
            let output = estimated.outputs.iter().find(|output| output.output == *wanted)?;
            let summary = &output.posterior;
            let widest = summary.intervals.last().filter(|_| converged)?;
            Some([widest.low, summary.median, widest.high, summary.mean, summary.sd].map(|one| one.value))
        };
        Self::Estimate(Box::new(EstimateFound {
            axes: case.axes,
            converged,
            ess: estimated.ess(),
            contradicting: estimated.with_agreement(Agreement::Contradicts),
            warnings: estimated.warnings.iter().map(code).collect(),
            of: DRAWN.iter().map(of).collect(),
        }))
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
