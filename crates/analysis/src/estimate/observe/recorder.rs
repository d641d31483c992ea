//! The data stored by a recorder.

use evidence::{CodedPdof, FITTED, Freedom, Measured, MeasuredSpeed, RecordedDeltaV, RecordedPart, Recorder};
use inputs::Quantity;
use real::Real;

use super::after::yaw_rate_error;
use super::{LEAST_SPEED_ERROR, Subject};
use crate::estimate::notes::Notes;
use crate::thresholds::{RECORDER_DELTA_V_ERROR, RECORDER_SPEED_ERROR};

/// The recorder data of a vehicle, with the errors that the case gives or the default ones. `is_side` is true
/// if the vehicle was hit on a side.
pub(super) fn recorded(subject: Subject<'_>, is_side: bool) -> (Recorder, Notes) {
    let mut notes = Notes::default();
    let Some(recorder) = &subject.given().recorder else { return (Recorder::default(), notes) };
    let axes = subject.case.axes;
    let mut or_default = |of: &str, given: Option<f64>, default: f64| {
        given.unwrap_or_else(|| {
            notes.default_error(true, subject.key(of));
            default
        })
    };
    let share = |percent: Option<f64>| percent.map(|percent| percent / 100.0);
    let (mut delta_v, mut longitudinal) = (None, None);
    if let Some(along) = recorder.delta_v_longitudinal.as_ref().map(Quantity::si) {
        let ln_scale =
            or_default("recorder.delta_v_error", share(recorder.delta_v_error), RECORDER_DELTA_V_ERROR);
        let (least, freedom) = (LEAST_SPEED_ERROR, Freedom::Three);
        match recorder.delta_v_lateral.as_ref().map(Quantity::si) {
            Some(across) => {
                let size = Real::sqrt(along * along + across * across);
                delta_v = Some(RecordedDeltaV { size, is_longitudinal: false, ln_scale, least, freedom });
            }
            None => longitudinal = Some(RecordedPart { along, ln_scale, least, freedom }),
        }
    }
    let both = recorder.delta_v_longitudinal.zip(recorder.delta_v_lateral);
    let direction = both.filter(|(along, across)| along.si() != 0.0 || across.si() != 0.0).map(|parts| {
        let (along, left) = (parts.0.si(), axes.lateral(parts.1.si()));
        // Away from the origin of the force; clockwise from the heading.
        let shown = FITTED.recorded_direction(real::elementary::atan2(left, -along), is_side);
        let given = recorder.direction_error.as_ref().map(Quantity::si);
        CodedPdof { scale: or_default("recorder.direction_error", given, shown.scale), ..shown }
    });
    let speed = recorder.speed.as_ref().map(|speed| MeasuredSpeed {
        value: speed.si(),
        ln_sd: or_default("recorder.speed_error", share(recorder.speed_error), RECORDER_SPEED_ERROR),
        least: LEAST_SPEED_ERROR,
    });
    let yaw_rate = recorder.yaw_rate.as_ref().map(|rate| {
        let value = axes.lateral(rate.si());
        let given = recorder.yaw_rate_error.as_ref().map(Quantity::si);
        Measured { value, sd: or_default("recorder.yaw_rate_error", given, yaw_rate_error(value)) }
    });
    (Recorder { delta_v, longitudinal, direction, speed, yaw_rate }, notes)
}
