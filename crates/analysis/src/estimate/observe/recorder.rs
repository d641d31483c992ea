//! The data stored by a recorder.

use evidence::{
    CodedPdof, FITTED, Freedom, Measured, MeasuredSpeed, RecordedData, RecordedDeltaV, RecordedPart,
    RecorderPlace, ShownSpeed,
};
use inputs::{GivenSpeedErrors, Quantity};

use super::{LEAST_SPEED_ERROR, Subject};
use crate::estimate::notes::{Notes, Unused, UnusedReason};
use crate::thresholds::{RECORDER_DELTA_V_ERROR, RECORDER_SPEED_ERROR, yaw_rate_error};

/// The recorder data of a vehicle, with the errors that the case gives or the default ones. `is_side` is true
/// if the vehicle was hit on a side.
pub(super) fn recorded(subject: Subject<'_>, is_side: bool, notes: &mut Notes) -> RecordedData {
    let Some(recorder) = &subject.given().recorder else { return RecordedData::default() };
    let axes = subject.case.axes;
    let mut or_default = |of: &str, given: Option<f64>, default: f64| {
        given.unwrap_or_else(|| {
            notes.default_error(true, subject.key(of));
            default
        })
    };
    let share = |percent: Option<f64>| percent.map(|percent| percent / 100.0);
    let before = subject.given().yaw_rate_before();
    let told = recorder.tells_delta_v(axes, before);
    let ends_early = told.is_none();
    let least = || recorder.least_delta_v(axes, before).filter(|least| least.size() > 0.0);
    let told = told.or_else(least);
    let [along, left] = [told.and_then(|told| told.along), told.and_then(|told| told.left)];
    let (mut delta_v, mut longitudinal) = (None, None);
    if let Some((told, along)) = told.zip(along) {
        let ln_scale =
            or_default("recorder.delta_v_error", share(recorder.delta_v_error), RECORDER_DELTA_V_ERROR);
        let (least, freedom) = (LEAST_SPEED_ERROR, Freedom::Three);
        if left.is_some() {
            let size = told.size();
            delta_v = Some(RecordedDeltaV { size, is_longitudinal: false, ln_scale, least, freedom });
        } else {
            longitudinal = Some(RecordedPart { along, ln_scale, least, freedom });
        }
    }
    // The direction of the force in the rest of the impact is unknown.
    let both = along.zip(left).filter(|_| !ends_early);
    let direction = both.filter(|(along, left)| *along != 0.0 || *left != 0.0).map(|(along, left)| {
        // Away from the origin of the force; clockwise from the heading.
        let shown = FITTED.recorded_direction(real::elementary::atan2(left, -along), is_side);
        let given = recorder.direction_error.as_ref().map(Quantity::si);
        CodedPdof { scale: or_default("recorder.direction_error", given, shown.scale), ..shown }
    });
    let shown = recorder.tells_speed(subject.case.ground_friction());
    let is_of_table = shown.is_some_and(|told| told.is_of_table);
    let speed = shown.map(|told| match told.humps {
        Some(humps) => ShownSpeed::Either(
            humps.map(|hump| (hump.probability, Measured { value: hump.mean, sd: hump.sd })),
        ),
        None => ShownSpeed::One(MeasuredSpeed {
            value: told.speed,
            ln_sd: or_default("recorder.speed_error", told.error, RECORDER_SPEED_ERROR),
            // The table has its own rounding; a number may have been rounded again.
            least: if told.is_of_table { 0.0 } else { LEAST_SPEED_ERROR },
        }),
    });
    let yaw_rate = recorder.yaw_rate.as_ref().map(|rate| {
        let value = axes.lateral(rate.si());
        let given = recorder.yaw_rate_error.as_ref().map(Quantity::si);
        Measured { value, sd: or_default("recorder.yaw_rate_error", given, yaw_rate_error(value)) }
    });
    if recorder.pulse.is_some() && told.is_none() {
        notes.unused.push(Unused { key: subject.key("recorder.pulse"), reason: UnusedReason::NoImpact });
    }
    if recorder.pre_crash.is_some() && speed.is_none() {
        notes
            .unused
            .push(Unused { key: subject.key("recorder.pre_crash"), reason: UnusedReason::StoodByRecord });
    }
    if told.is_some() && along.is_none() {
        let key = if recorder.pulse.is_some() { "recorder.pulse" } else { "recorder.delta_v_lateral" };
        notes.unused.push(Unused { key: subject.key(key), reason: UnusedReason::OnlyLateral });
    }
    notes.default_error(
        is_of_table && recorder.speed_error.is_none() && recorder.errors == GivenSpeedErrors::default(),
        subject.key("recorder.errors"),
    );
    if recorder.pre_crash.is_none() && recorder.errors != GivenSpeedErrors::default() {
        notes.unused.push(Unused { key: subject.key("recorder.errors"), reason: UnusedReason::NoSpeeds });
    }
    let place = told.and_then(|told| told.place);
    let place = place.map(|at| RecorderPlace { at, yaw_rate: axes.lateral(before) });
    RecordedData { delta_v, longitudinal, ends_early, direction, speed, yaw_rate, place }
}
