//! The skid before the impact.

use evidence::MeasuredSpeed;

use super::{Subject, measured_speed};
use crate::estimate::notes::Notes;
use crate::thresholds::RECORDER_SPEED_ERROR;

/// The speed at the start of the skid.
pub(super) fn speed(subject: Subject<'_>) -> (Option<MeasuredSpeed>, Notes) {
    let mut notes = Notes::default();
    let speed = subject.given().before.as_ref().and_then(|before| before.speed).map(|speed| {
        let sd = subject.sd("before.speed");
        notes.default_error(sd.is_none(), subject.key("before.speed"));
        measured_speed(speed.si(), sd, RECORDER_SPEED_ERROR)
    });
    (speed, notes)
}
