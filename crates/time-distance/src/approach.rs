//! The motion before the impact, backwards from it.

use pim_core::InvalidInput;
use real::Real;

use crate::course::Leg;
use pim_core::check;

/// A stretch of constant acceleration before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Phase<T = f64> {
    /// Over a distance.
    Over {
        /// (m) its length.
        distance: T,
        /// (m/s²) acceleration, negative where the vehicle brakes.
        acceleration: T,
    },
    /// For a time.
    For {
        /// (s) how long.
        time: T,
        /// (m/s²) acceleration, negative where the vehicle brakes.
        acceleration: T,
    },
    /// From a stop.
    FromRest {
        /// (m/s²) acceleration, positive.
        acceleration: T,
    },
    /// From another speed.
    From {
        /// (m/s) the speed where it begins.
        speed: T,
        /// (m/s²) acceleration, negative where the vehicle brakes.
        acceleration: T,
    },
}

/// The beginning of a phase of which the end is known. Time and position of the impact are zero, so those
/// before it are negative.
///
/// # Errors
/// If a number is impossible: a negative length, a speed that would have been negative, an acceleration
/// that does not lead from one speed to the other.
pub fn approach<T: Real>(end: &Leg<T>, phase: Phase<T>) -> Result<Leg<T>, InvalidInput> {
    let (speed, time, acceleration) = match phase {
        Phase::Over { distance, acceleration } => {
            check::within("length of a phase before the impact", distance.value(), 0.0, f64::MAX)?;
            check::finite("acceleration before the impact", acceleration.value())?;
            // v₀² = v² − 2 a s
            let square = end.speed * end.speed - acceleration * distance * 2.0;
            check::within(
                "square of the speed where a phase before the impact begins",
                square.value(),
                0.0,
                f64::MAX,
            )?;
            let speed = if square.value() > 0.0 { square.sqrt() } else { T::ZERO };
            // t = 2 s/(v₀ + v), which needs no acceleration
            let sum = speed + end.speed;
            if distance.value() > 0.0 && sum.value() <= 0.0 {
                let what = "speed over a phase before the impact";
                return Err(InvalidInput::NotPositive { what, value: sum.value() });
            }
            let time = if sum.value() > 0.0 { distance * 2.0 / sum } else { T::ZERO };
            (speed, time, acceleration)
        }
        Phase::For { time, acceleration } => {
            check::within("duration of a phase before the impact", time.value(), 0.0, f64::MAX)?;
            check::finite("acceleration before the impact", acceleration.value())?;
            let speed = end.speed - acceleration * time;
            check::within("speed where a phase before the impact begins", speed.value(), 0.0, f64::MAX)?;
            (speed, time, acceleration)
        }
        Phase::FromRest { acceleration } => {
            check::positive("acceleration from a stop", acceleration.value())?;
            (T::ZERO, end.speed / acceleration, acceleration)
        }
        Phase::From { speed, acceleration } => {
            check::within("speed where a phase before the impact begins", speed.value(), 0.0, f64::MAX)?;
            check::finite("acceleration before the impact", acceleration.value())?;
            let time = (end.speed - speed) / acceleration;
            check::within("duration of a phase before the impact", time.value(), 0.0, f64::MAX)?;
            (speed, time, acceleration)
        }
    };
    // s = (v₀ + v) t/2
    let distance = (speed + end.speed) * time * 0.5;
    Ok(Leg { time: end.time - time, position: end.position - distance, speed, acceleration, jerk: T::ZERO })
}
