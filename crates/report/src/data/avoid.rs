//! Whether the collision was avoidable, as JSON.

use analysis::{ActualRun, AvoidChance, AvoidInterval, AvoidRun, Avoidance, DrivenBy, NoEstimate, Unbraked};
use case::{CaseFile, SWELLS, word};
use serde_json::{Value, json};

use super::json::of_movable;
use super::{identified, list, object, pretty, title};
use crate::sections::avoid::avoid_warnings;
use crate::units::Units;
use crate::words::run_words;

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
    let of = |speed: f64, is: bool| json!({ "speed": speed, "avoidable_at_limit": is });
    let run = |run: &AvoidRun| {
        json!({
            "hypothesis": run_words(run.hypothesis).key,
            "speed": run.course.speed,
            "reaction_time": run.course.response.map(|response| response.reaction()),
            "deceleration": run.course.response.map(|response| response.deceleration()),
            "stopping_distance": run.course.stop(),
            "collision_speed": run.collision_speed,
            "arrival": run.arrival,
            "stops_before": run.stops_before(),
            "least_gap": run.gap,
            "late_enough": run.is_late_enough,
            "delta_v": delta_v(run),
        })
    };
    // SI.
    let avoid = json!({
        "vehicle": found.vehicle.number(),
        "speed": scene.speed,
        "speed_source": found.speed_from.name(),
        "speed_determined": found.undetermined().is_none(),
        // By the exact solution that is the headline of `reconstruct`; null unless the speed comes from
        // `estimate`.
        "exact_speed_at_impact": found.exact_speed(),
        "limit": scene.limit,
        "demand": { "distance": scene.distance, "time": scene.time },
        "sight": sight(found),
        // A vehicle that moves on the same line; null if the place of the impact is fixed.
        "same_line": scene.same_line.as_ref().map(|line| object! {
            "direction": line.along.name(),
            line.{gap, speed, deceleration},
        }),
        "stopping_distance": scene.stopping_distance(),
        "spatial": of(scene.spatial(), scene.stops_at_limit()),
        "temporal": scene.temporal().zip(scene.is_late_at_limit()).map(|(speed, is)| of(speed, is)),
        "at_limit": {
            "collision_speed": scene.left_at_limit(),
            "delta_v": found.run_at_limit().and_then(delta_v),
        },
        // False if the evidence was weighed, but the run did not converge.
        "converged": found.speed_doubt != Some(NoEstimate::Unconverged),
        "probability": found.chance.as_ref().map(probability),
        "response": {
            "reaction_time": response.reaction(),
            "swell": response.swell(),
            "swell_form": word(&SWELLS, &response.form()),
            "deceleration": response.deceleration(),
        },
        "actual": match scene.actual {
            ActualRun::Responded => "responded",
            ActualRun::Unbraked(Unbraked::Stated) => "unbraked",
            ActualRun::Unbraked(Unbraked::NothingKnown) => "taken as unbraked",
            ActualRun::Unbraked(Unbraked::WouldHaveStopped) => "late or not at all",
            ActualRun::Skidded(_) => "skidded",
            ActualRun::Driven(DrivenBy::Phases) => "by phases",
            ActualRun::Driven(DrivenBy::Recorder) => "by the recorder",
        },
        "reaction_late_by": scene.delay(),
        "runs": list(found.runs.iter().chain(&found.more_runs), run),
        "enough": {
            "speed": found.enough.speed,
            "deceleration": found.enough.deceleration,
            "reaction_time": found.enough.reaction,
            "deceleration_at_limit": found.enough.deceleration_at_limit,
            "reaction_time_at_limit": found.enough.reaction_at_limit,
        },
        "intervals": found.chance.as_ref().map(intervals),
        // In sentences.
        "warnings": avoid_warnings(found, Units::Si),
    });
    let document = json!({ "title": title(case), "axes": case.axes.name(), "avoid": avoid });
    pretty(&identified(file, document))
}

fn sight(found: &Avoidance) -> Option<Value> {
    let sight = found.scene.view.sight()?;
    Some(object! {
        sight.{time, distance_subject, distance_other},
        "hidden_by": found.hiding.and_then(|hiding| hiding.by).map(|index| index + 1),
        "seen_earlier": found.hiding.and_then(|hiding| hiding.seen_earlier),
    })
}

fn probability(chance: &AvoidChance) -> Value {
    object! {
        chance.{avoided_at_limit, above_limit, mc_error, stopped_at_limit},
        "avoided_at_limit_else_as_it_was": chance.avoided_else_as_it_was,
        chance.{samples, possible},
        "influences": list(&chance.influences, |influence| json!({
            "input": influence.input.as_ref().map_or_else(|| "speed".to_owned(), crate::outputs::input_name),
            "difference": influence.difference,
        })),
    }
}

fn intervals(chance: &AvoidChance) -> Value {
    // The median and the ends of a 95 % interval.
    let of = |interval: &AvoidInterval| {
        let AvoidInterval { low, median, high } = interval;
        json!({ "low": low, "median": median, "high": high })
    };
    json!({
        "speed": of(&chance.speed),
        "demand_distance": of(&chance.distance),
        "demand_time": of(&chance.time),
        "spatial_speed": of(&chance.spatial),
        "temporal_speed": chance.temporal.as_ref().map(of),
        "collision_speed_at_limit": of(&chance.left_at_limit),
        "sight": chance.sight.as_ref().map(|sight| json!({
            "time": of(&sight.time),
            "distance_subject": of(&sight.distance_subject),
            "distance_other": of(&sight.distance_other),
            "never_hidden": sight.never_hidden,
        })),
    })
}
