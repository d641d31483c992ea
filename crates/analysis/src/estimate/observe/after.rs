//! How a vehicle left the impact, and its rest position.

use evidence::{Measured, MeasuredRest, PlaceError, PostImpactMotion};
use inputs::{Quantity, VehicleMotion};
use pim_core::Vector2;
use real::Real;

use super::{DEGREE, Subject, measured_speed};
use crate::estimate::notes::{Notes, Unused, UnusedReason};
use crate::thresholds::{DIRECTION_AFTER_ERROR, REST_LEAST, SPEED_AFTER_ERROR, yaw_rate_error};

/// (–) error of the simulated rest position: a share of the path length.
const REST_SHARE: f64 = 0.10;
/// (rad) error of the heading at rest: a quarter of the turn, between 5° and 15°.
const REST_HEADING: [f64; 2] = [5.0 * DEGREE, 15.0 * DEGREE];
const REST_TURN_SHARE: f64 = 0.25;

/// The motion after the impact that the case gives.
pub(super) fn after(subject: Subject<'_>, notes: &mut Notes) -> PostImpactMotion {
    let mut found = PostImpactMotion::default();
    let Some(after) = &subject.given().after else { return found };
    let lateral = |quantity: &Quantity| subject.case.axes.lateral(quantity.si());
    found.speed = after
        .speed
        .as_ref()
        .map(|speed| measured_speed(speed.si(), subject.noted_sd("after.speed", notes), SPEED_AFTER_ERROR));
    // A vehicle that stands still has no direction of departure.
    let leaves = after.speed.as_ref().is_none_or(|speed| speed.si() > 0.0);
    found.direction = after.direction.as_ref().filter(|_| leaves).map(|direction| {
        let sd = subject.noted_sd("after.direction", notes);
        Measured { value: lateral(direction), sd: sd.unwrap_or(DIRECTION_AFTER_ERROR) }
    });
    if after.direction.is_some() && !leaves {
        notes.unused.push(Unused { key: subject.key("after.direction"), reason: UnusedReason::NoDirection });
    }
    found.yaw_rate = after.yaw_rate.as_ref().map(|rate| {
        let (value, sd) = (lateral(rate), subject.noted_sd("after.yaw_rate", notes));
        Measured { value, sd: sd.unwrap_or(yaw_rate_error(value)) }
    });
    // Without a yaw rate, the velocity of one of the two is that of the wreck.
    let other = &subject.case.vehicles[subject.id.other().index()];
    let is_alone = other.after.as_ref().is_none_or(|other| other.speed.is_none());
    found.of_common_cg = subject.case.locked_together && is_alone && after.yaw_rate.is_none();
    found
}

/// The rest position of a vehicle that is followed, and (m) the errors of the points of its path.
pub(super) fn rest(
    subject: Subject<'_>,
    way: &VehicleMotion,
    notes: &mut Notes,
) -> (Option<MeasuredRest>, Vec<f64>) {
    let given = subject.case.estimate.unwrap_or_default();
    let share = given.rest_error.map_or(REST_SHARE, |percent| percent / 100.0);
    let least = given.rest_least_error.as_ref().map_or(REST_LEAST, Quantity::si);
    let far = |place: Vector2<f64>| least + share * (place - way.position).norm();
    // The errors of survey and model together.
    let both = |model: f64, [x, y]: [f64; 2]| Real::sqrt(model * model + 0.5 * (x * x + y * y));
    let rest = way.rest.as_ref().map(|rest| {
        let surveyed = ["after.rest.x", "after.rest.y"].map(|of| subject.sd(of).unwrap_or_default());
        let heading = rest.heading.heading(way.heading);
        let turns_are_known = rest.heading.turns_are_known();
        let turned = heading - way.heading;
        let turned = if turns_are_known { turned } else { real::principal_angle(turned) };
        let [slight, most] = REST_HEADING;
        let usual = Real::min(Real::max(REST_TURN_SHARE * turned.abs(), slight), most);
        let model_heading = given.rest_heading_error.as_ref().map_or(usual, Quantity::si);
        let own = ["after.rest.heading", "after.rest.turned"]
            .iter()
            .find_map(|of| subject.sd(of))
            .unwrap_or_default();
        MeasuredRest {
            position: rest.position,
            impact: way.position,
            error: PlaceError { least, share, survey: both(0.0, surveyed) },
            heading,
            turns_are_known,
            heading_sd: Real::sqrt(model_heading * model_heading + own * own),
        }
    });
    let points = way.points.iter().enumerate().map(|(place, point)| {
        let surveyed =
            ["x", "y"].map(|of| subject.sd(&format!("after.points[{}].{of}", place + 1)).unwrap_or_default());
        both(far(point.position), surveyed)
    });
    notes.default_error(given.rest_error.is_none(), "estimate.rest_error".to_owned());
    notes.default_error(given.rest_least_error.is_none(), "estimate.rest_least_error".to_owned());
    let has_usual_heading = given.rest_heading_error.is_none() && way.rest.is_some();
    notes.default_error(has_usual_heading, "estimate.rest_heading_error".to_owned());
    (rest, points.collect())
}
