//! The work that is compared with the crush energy, against the unknown speed. The answer is where it equals
//! the required work.

use inputs::Case;

use crate::failure::Failure;
use crate::found::Found;
use crate::goal::at;

/// One point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkPoint {
    /// (m/s) speed along the heading of the vehicle whose speed is unknown.
    pub speed: f64,
    /// (J) W_n at that speed; negative or not a number if no impact can happen.
    pub normal_work: f64,
    /// (J) W_n + λ W_t at that speed, with λ from the basis: W_n alone unless that is a share of the
    /// tangential work.
    pub crush_work: f64,
    /// (J) the required work at that speed. It depends on the speed only for a restitution curve with the
    /// basis `absorbed`.
    pub sought: f64,
}

/// How far the curve extends beyond the fastest speed of interest, as a share of the distance to it.
const BEYOND: f64 = 0.2;

/// W_n, and W_n + λ W_t, at `samples` equal steps of speed, from the one at which the vehicles just touch
/// (u_n = 0) to beyond every admissible speed and every step of the root finder.
///
/// # Errors
/// [`Failure`], as for [`reconstruct`](crate::reconstruct).
pub fn work_curve(case: &Case, found: &Found, samples: usize) -> Result<Vec<WorkPoint>, Failure> {
    at(case, |problem| {
        let touch = problem.touching_speed();
        let steps = found.iterations.iter().flatten().map(|step| step.speed);
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
                let crush_work = problem.crush_work(speed);
                let sought = crush_work - problem.residual(speed);
                WorkPoint { speed, normal_work, crush_work, sought }
            })
            .collect())
    })
}

/// As a share of the first step of a curve: as near to the touching speed as possible while the sign of the
/// normal work is still meaningful.
const NEAR: f64 = 1e-3;
/// Halvings of a step of the curve: the last is below the rounding of a speed.
const HALVINGS: usize = 60;

/// (m/s) the speed beyond which the normal work of a [`work_curve`] is positive; `None` if that is the one at
/// which the vehicles just touch. There u_n = 0 and therefore W_n = 0, whatever P_n is; but the impulse of a
/// law may be a pull there, and become a push (P_n > 0) only at a faster approach.
///
/// # Errors
/// [`Failure`], as for [`reconstruct`](crate::reconstruct).
pub fn first_push(case: &Case, curve: &[WorkPoint]) -> Result<Option<f64>, Failure> {
    let Some(after) = curve.iter().position(|point| point.normal_work > 0.0) else { return Ok(None) };
    let (Some(touch), Some(before), Some(after)) =
        (curve.first(), after.checked_sub(1).and_then(|before| curve.get(before)), curve.get(after))
    else {
        return Ok(None);
    };
    at(case, |problem| {
        let is_push = |speed: f64| problem.normal_work(speed) > 0.0;
        let mut low = before.speed;
        if before == touch {
            low += NEAR * (after.speed - low);
            if is_push(low) {
                return Ok(None);
            }
        }
        let mut high = after.speed;
        for _ in 0..HALVINGS {
            let middle = low + (high - low) / 2.0;
            if is_push(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Ok(Some(high))
    })
}
