//! The work of the normal impulse over the speed sought: what the answer is a root of.

use case::CaseFile;

use crate::sensitivity::at;
use crate::{Failure, Found};

/// One point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkPoint {
    /// (m/s) speed along the heading of the vehicle whose speed is sought.
    pub speed: f64,
    /// (J) W_n at that speed; negative or not a number where no impact can happen.
    pub normal_work: f64,
    /// (J) the normal work sought at that speed. It depends on the speed only where a curve of restitution meets the basis `absorbed`.
    pub sought: f64,
}

/// How far beyond the fastest speed of interest the curve goes, as a share of the way to it.
const BEYOND: f64 = 0.2;

/// W_n at `samples` equal steps of speed, from the one at which the vehicles just touch (u_n = 0) to beyond every admissible speed and every step of the
/// root-finder.
///
/// # Errors
/// [`Failure`], as for [`reconstruct`](crate::reconstruct).
pub fn work_curve(file: &CaseFile, found: &Found, samples: usize) -> Result<Vec<WorkPoint>, Failure> {
    at(file, &file.case, |problem| {
        let touch = problem.touching_speed();
        let steps = found.iterations.iter().map(|step| step.speed);
        let farthest = found.admissible.iter().copied().chain(steps).fold(found.speed, |far, speed| {
            if (speed - touch).abs() > (far - touch).abs() { speed } else { far }
        });
        let reach = (farthest - touch) * (1.0 + BEYOND);
        #[expect(clippy::cast_precision_loss, reason = "a drawing has few samples")]
        let share = |i: usize| i as f64 / samples.max(1) as f64;
        Ok((0..=samples)
            .map(|i| {
                let speed = touch + reach * share(i);
                let normal_work = problem.normal_work(speed);
                WorkPoint { speed, normal_work, sought: normal_work - problem.residual(speed) }
            })
            .collect())
    })
}
