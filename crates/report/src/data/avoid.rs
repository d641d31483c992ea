//! Whether the collision was avoidable, as JSON.

use analysis::{
    ActualRun, AvoidChance, AvoidInterval, AvoidRun, Avoidance, DrivenBy, SpeedDoubt, SpeedSource, Unbraked,
};
use case::{CaseFile, SWELLS, word};
use serde::Serialize;

use super::json::{OfMovable, of_movable};
use super::{identified, pretty, title};
use crate::sections::avoid::avoid_warnings;
use crate::units::Units;
use crate::words::run_words;

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    axes: &'static str,
    avoid: AvoidBlock,
}

/// SI.
#[derive(Serialize)]
struct AvoidBlock {
    vehicle: u8,
    speed: f64,
    speed_source: &'static str,
    limit: f64,
    demand: DemandBlock,
    sight: Option<SightBlock>,
    stopping_distance: f64,
    spatial: KindBlock,
    temporal: Option<KindBlock>,
    at_limit: AtLimitBlock,
    /// False where the evidence was weighed, but the run did not converge.
    converged: bool,
    probability: Option<ProbabilityBlock>,
    response: ResponseBlock,
    actual: &'static str,
    reaction_late_by: Option<f64>,
    runs: Vec<RunBlock>,
    enough: EnoughBlock,
    intervals: Option<IntervalsBlock>,
    /// In sentences.
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct DemandBlock {
    distance: f64,
    time: f64,
}

#[derive(Serialize)]
struct SightBlock {
    time: f64,
    distance_subject: f64,
    distance_other: f64,
    hidden_by: Option<usize>,
    seen_earlier: Option<f64>,
}

#[derive(Serialize)]
struct KindBlock {
    speed: f64,
    avoidable_at_limit: bool,
}

#[derive(Serialize)]
struct AtLimitBlock {
    collision_speed: f64,
    delta_v: Option<OfMovable>,
}

#[derive(Serialize)]
struct ProbabilityBlock {
    avoided_at_limit: f64,
    above_limit: f64,
    mc_error: f64,
    stopped_at_limit: f64,
    avoided_at_limit_else_as_it_was: f64,
    samples: usize,
    possible: usize,
    influences: Vec<InfluenceBlock>,
}

#[derive(Serialize)]
struct InfluenceBlock {
    input: String,
    difference: f64,
}

#[derive(Serialize)]
struct ResponseBlock {
    reaction_time: f64,
    swell: f64,
    swell_form: &'static str,
    deceleration: f64,
}

#[derive(Serialize)]
struct RunBlock {
    hypothesis: &'static str,
    speed: f64,
    reaction_time: Option<f64>,
    deceleration: Option<f64>,
    stopping_distance: Option<f64>,
    collision_speed: f64,
    arrival: Option<f64>,
    stops_before: bool,
    late_enough: Option<bool>,
    delta_v: Option<OfMovable>,
}

#[derive(Serialize)]
struct EnoughBlock {
    speed: f64,
    deceleration: Option<f64>,
    reaction_time: Option<f64>,
    deceleration_at_limit: Option<f64>,
    reaction_time_at_limit: Option<f64>,
}

/// The median and the ends of a 95 % interval.
#[derive(Serialize)]
struct IntervalBlock {
    low: f64,
    median: f64,
    high: f64,
}

#[derive(Serialize)]
struct IntervalsBlock {
    speed: IntervalBlock,
    demand_distance: IntervalBlock,
    demand_time: IntervalBlock,
    spatial_speed: IntervalBlock,
    temporal_speed: Option<IntervalBlock>,
    collision_speed_at_limit: IntervalBlock,
    sight: Option<SightIntervalsBlock>,
}

#[derive(Serialize)]
struct SightIntervalsBlock {
    time: IntervalBlock,
    distance_subject: IntervalBlock,
    distance_other: IntervalBlock,
    never_hidden: f64,
}

/// Whether the collision was avoidable, as indented JSON, ending in a line break: `{"avoid": {"speed": …,
/// "demand": {"distance": …, "time": …}, "spatial": {"speed": …, "avoidable_at_limit": …}, …}}`.
///
/// # Errors
/// If serialisation fails, which no answer causes.
pub fn avoid_json(file: &CaseFile, found: &Avoidance) -> Result<String, serde_json::Error> {
    let case = &file.case;
    let delta_v = |run: &AvoidRun| run.delta_v.map(|delta_v| of_movable(case, delta_v));
    let scene = &found.scene;
    let response = scene.response;
    let of = |speed: f64, avoidable_at_limit: bool| KindBlock { speed, avoidable_at_limit };
    let run = |run: &AvoidRun| RunBlock {
        hypothesis: run_words(run.hypothesis).key,
        speed: run.course.speed,
        reaction_time: run.course.response.map(|response| response.reaction()),
        deceleration: run.course.response.map(|response| response.deceleration()),
        stopping_distance: run.course.stop(),
        collision_speed: run.collision_speed,
        arrival: run.arrival,
        stops_before: run.stops_before(),
        late_enough: run.is_late_enough,
        delta_v: delta_v(run),
    };
    let document = Document {
        title: title(case),
        axes: case.axes.name(),
        avoid: AvoidBlock {
            vehicle: found.vehicle.number(),
            speed: scene.speed,
            speed_source: match found.speed_from {
                SpeedSource::AtDemand => "avoid",
                SpeedSource::AtImpact => "vehicle",
                SpeedSource::Reconstructed => "reconstruct",
                SpeedSource::Estimated => "estimate",
                SpeedSource::Phases => "phases",
                SpeedSource::Recorder => "recorder",
            },
            limit: scene.limit,
            demand: DemandBlock { distance: scene.distance, time: scene.time },
            sight: sight(found),
            stopping_distance: scene.stopping_distance(),
            spatial: of(scene.spatial(), scene.stops_at_limit()),
            temporal: scene.temporal().zip(scene.is_late_at_limit()).map(|(speed, is)| of(speed, is)),
            at_limit: AtLimitBlock {
                collision_speed: scene.left_at_limit(),
                delta_v: found.run_at_limit().and_then(delta_v),
            },
            converged: found.speed_doubt != Some(SpeedDoubt::Unconverged),
            probability: found.chance.as_ref().map(probability),
            response: ResponseBlock {
                reaction_time: response.reaction(),
                swell: response.swell(),
                swell_form: word(&SWELLS, &response.form()),
                deceleration: response.deceleration(),
            },
            actual: match scene.actual {
                ActualRun::Responded => "responded",
                ActualRun::Unbraked(Unbraked::Stated) => "unbraked",
                ActualRun::Unbraked(Unbraked::NothingKnown) => "taken as unbraked",
                ActualRun::Unbraked(Unbraked::WouldHaveStopped) => "late or not at all",
                ActualRun::Skidded(_) => "skidded",
                ActualRun::Driven(DrivenBy::Phases) => "by phases",
                ActualRun::Driven(DrivenBy::Recorder) => "by the recorder",
            },
            reaction_late_by: scene.delay(),
            runs: found.runs.iter().chain(&found.more_runs).map(run).collect(),
            enough: EnoughBlock {
                speed: found.enough.speed,
                deceleration: found.enough.deceleration,
                reaction_time: found.enough.reaction,
                deceleration_at_limit: found.enough.deceleration_at_limit,
                reaction_time_at_limit: found.enough.reaction_at_limit,
            },
            intervals: found.chance.as_ref().map(intervals),
            warnings: avoid_warnings(found, Units::Si),
        },
    };
    pretty(&identified(file, document))
}

fn sight(found: &Avoidance) -> Option<SightBlock> {
    let sight = found.scene.view.sight()?;
    Some(SightBlock {
        time: sight.time,
        distance_subject: sight.distance_subject,
        distance_other: sight.distance_other,
        hidden_by: found.hiding.and_then(|hiding| hiding.by).map(|index| index + 1),
        seen_earlier: found.hiding.and_then(|hiding| hiding.seen_earlier),
    })
}

fn probability(chance: &AvoidChance) -> ProbabilityBlock {
    ProbabilityBlock {
        avoided_at_limit: chance.avoided_at_limit,
        above_limit: chance.above_limit,
        mc_error: chance.mc_error,
        stopped_at_limit: chance.stopped_at_limit,
        avoided_at_limit_else_as_it_was: chance.avoided_else_as_it_was,
        samples: chance.samples,
        possible: chance.possible,
        influences: chance
            .influences
            .iter()
            .map(|influence| InfluenceBlock {
                input: influence
                    .input
                    .as_ref()
                    .map_or_else(|| "speed".to_owned(), crate::outputs::input_name),
                difference: influence.difference,
            })
            .collect(),
    }
}

fn intervals(chance: &AvoidChance) -> IntervalsBlock {
    let of = |interval: &AvoidInterval| {
        let AvoidInterval { low, median, high } = *interval;
        IntervalBlock { low, median, high }
    };
    IntervalsBlock {
        speed: of(&chance.speed),
        demand_distance: of(&chance.distance),
        demand_time: of(&chance.time),
        spatial_speed: of(&chance.spatial),
        temporal_speed: chance.temporal.as_ref().map(of),
        collision_speed_at_limit: of(&chance.left_at_limit),
        sight: chance.sight.as_ref().map(|sight| SightIntervalsBlock {
            time: of(&sight.time),
            distance_subject: of(&sight.distance_subject),
            distance_other: of(&sight.distance_other),
            never_hidden: sight.never_hidden,
        }),
    }
}
