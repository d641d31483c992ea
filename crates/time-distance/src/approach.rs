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
    /// From another speed, over a distance.
    FromOver {
        /// (m/s) the speed where it begins.
        speed: T,
        /// (m) its length.
        distance: T,
    },
    /// From another speed, for a time.
    FromFor {
        /// (m/s) the speed where it begins.
        speed: T,
        /// (s) how long.
        time: T,
    },
    /// Over a distance, for a time.
    OverFor {
        /// (m) its length.
        distance: T,
        /// (s) how long.
        time: T,
    },
}

/// The name of a speed at the beginning of a phase in a refusal.
const FROM: &str = "speed where a phase before the impact begins";
/// The same for the time that a phase takes.
const LASTS: &str = "duration of a phase before the impact";
/// The same for its length.
const LONG: &str = "length of a phase before the impact";

/// The beginning of a phase whose end is known. Time and position of the impact are zero, so those before it
/// are negative.
///
/// # Errors
/// If a number is impossible: a negative length, a speed that would have been negative, an acceleration
/// that does not lead from one speed to the other; or if the beginning is not finite.
pub fn approach<T: Real>(end: &Leg<T>, phase: Phase<T>) -> Result<Leg<T>, InvalidInput> {
    let least = |what, value: T| check::at_least(what, value.value(), 0.0);
    let forward = |start: T| match start.value() {
        start if start < 0.0 => Err(InvalidInput::GainsMore { end: end.speed.value() }),
        start => check::finite(FROM, start),
    };
    least("speed where a phase before the impact ends", end.speed)?;
    let any = |acceleration: T| check::finite("acceleration before the impact", acceleration.value());
    let (speed, time, acceleration) = match phase {
        Phase::Over { distance, acceleration } => {
            least(LONG, distance)?;
            any(acceleration)?;
            // v₀² = v² − 2 a s
            let square = end.speed * end.speed - acceleration * distance * 2.0;
            forward(square)?;
            let speed = if square.value() > 0.0 { square.sqrt() } else { T::ZERO };
            (speed, time_over(distance, speed + end.speed)?, acceleration)
        }
        Phase::For { time, acceleration } => {
            least(LASTS, time)?;
            any(acceleration)?;
            let speed = end.speed - acceleration * time;
            forward(speed)?;
            (speed, time, acceleration)
        }
        Phase::FromRest { acceleration } => {
            check::positive("acceleration from a stop", acceleration.value())?;
            (T::ZERO, end.speed / acceleration, acceleration)
        }
        Phase::From { speed, acceleration } => {
            least(FROM, speed)?;
            any(acceleration)?;
            (speed, time_between(speed, end.speed, acceleration)?, acceleration)
        }
        Phase::FromOver { speed, distance } => {
            least(FROM, speed)?;
            check::positive(LONG, distance.value())?;
            let sum = speed + end.speed;
            // a = (v² − v₀²)/2 s
            (speed, time_over(distance, sum)?, (end.speed - speed) * sum / (distance * 2.0))
        }
        Phase::FromFor { speed, time } => {
            least(FROM, speed)?;
            check::positive(LASTS, time.value())?;
            (speed, time, (end.speed - speed) / time)
        }
        Phase::OverFor { distance, time } => {
            least(LONG, distance)?;
            check::positive(LASTS, time.value())?;
            // v₀ = 2 s/t − v
            let speed = distance * 2.0 / time - end.speed;
            forward(speed)?;
            (speed, time, (end.speed - speed) / time)
        }
    };
    // s = (v₀ + v) t/2
    let distance = (speed + end.speed) * time * 0.5;
    let start =
        Leg { time: end.time - time, position: end.position - distance, speed, acceleration, jerk: T::ZERO };
    check::finite("time at which a phase before the impact begins", start.time.value())?;
    check::finite("place where a phase before the impact begins", start.position.value())?;
    check::finite(FROM, start.speed.value())?;
    check::finite("acceleration before the impact", start.acceleration.value())?;
    Ok(start)
}

/// (s) t = 2 s/(v₀ + v), which needs no acceleration.
fn time_over<T: Real>(distance: T, sum: T) -> Result<T, InvalidInput> {
    if distance.value() > 0.0 && sum.value() <= 0.0 {
        let what = "speed over a phase before the impact";
        return Err(InvalidInput::NotPositive { what, value: sum.value() });
    }
    Ok(if sum.value() > 0.0 { distance * 2.0 / sum } else { T::ZERO })
}

/// (s) t = (v − v₀)/a, which is zero where the speeds are the same.
fn time_between<T: Real>(from: T, to: T, acceleration: T) -> Result<T, InvalidInput> {
    let gain = to - from;
    if gain.value() == 0.0 {
        return Ok(T::ZERO);
    }
    let time = gain / acceleration;
    if check::at_least(LASTS, time.value(), 0.0).is_err() {
        let [from, to, acceleration] = [from, to, acceleration].map(|number| number.value());
        return Err(InvalidInput::NotReached { from, to, acceleration });
    }
    Ok(time)
}
