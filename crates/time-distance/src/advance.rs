//! How another road user moves on its path.

use pim_core::{InvalidInput, check};
use real::Real;

/// How a road user covers its path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Advance<T = f64> {
    /// At constant speed.
    Steady {
        /// (m/s) the speed, positive.
        speed: T,
    },
    /// From a stop.
    FromStop {
        /// (m/s²) acceleration, positive.
        acceleration: T,
        /// (m/s) the speed that it keeps once it has reached it, positive; it accelerates all the way if
        /// absent.
        up_to: Option<T>,
    },
}

impl<T: Real> Advance<T> {
    /// (s) the time over a distance (m) from its position at the beginning.
    ///
    /// # Errors
    /// If the distance is negative, or a speed or the acceleration is not positive.
    pub fn time_over(&self, distance: T) -> Result<T, InvalidInput> {
        check::at_least("distance along the path", distance.value(), 0.0)?;
        let of_speed = |speed: T| check::positive("speed of the road user", speed.value());
        match *self {
            Self::Steady { speed } => {
                of_speed(speed)?;
                Ok(distance / speed)
            }
            Self::FromStop { acceleration, up_to } => {
                check::positive("acceleration from a stop", acceleration.value())?;
                if let Some(speed) = up_to {
                    of_speed(speed)?;
                }
                if distance.value() <= 0.0 {
                    return Ok(T::ZERO);
                }
                if let Some(speed) = up_to {
                    // s_v = v²/(2 a), where it reaches v
                    let reached = speed * speed / (acceleration * 2.0);
                    if distance.value() > reached.value() {
                        // t = s/v + v/(2 a)
                        return Ok(distance / speed + speed / (acceleration * 2.0));
                    }
                }
                // t = √(2 s/a)
                Ok((distance * 2.0 / acceleration).sqrt())
            }
        }
    }

    /// (m/s) its speed after a distance (m) from its position at the beginning.
    ///
    /// # Errors
    /// As [`Advance::time_over`].
    pub fn speed_after(&self, distance: T) -> Result<T, InvalidInput> {
        self.time_over(distance)?;
        Ok(match *self {
            Self::Steady { speed } => speed,
            Self::FromStop { acceleration, up_to } => {
                // v = √(2 a s), at most the speed that it keeps
                let gained = (acceleration * distance * 2.0).sqrt();
                up_to.map_or(gained, |kept| if gained.value() < kept.value() { gained } else { kept })
            }
        })
    }
}
