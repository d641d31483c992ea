//! The angle of the front wheels.

use core::f64::consts::FRAC_PI_2;

use pim_core::InvalidInput;
use real::Real;

use pim_core::check;

/// (rad) steer angle of the front wheels, counter-clockwise from the vehicle's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steer<'a, T = f64> {
    /// Constant.
    Held(T),
    /// Angles (rad) at ascending times (s) from the start of the motion: linear between them, and constant
    /// before the first and after the last.
    Over(&'a [(T, T)]),
}

impl<T: Real> Steer<'_, T> {
    /// Wheels that point straight ahead.
    #[must_use]
    pub fn straight() -> Self {
        Self::Held(T::ZERO)
    }

    /// Checks that a steering can have every number.
    ///
    /// # Errors
    /// If an angle is not within ±90°, or the times do not ascend.
    pub fn check(&self) -> Result<(), InvalidInput> {
        let angle = |angle: T| check::within("steer angle", angle.value(), -FRAC_PI_2, FRAC_PI_2);
        match *self {
            Self::Held(held) => angle(held),
            Self::Over(points) => {
                let mut before = 0.0;
                for &(time, at) in points {
                    check::at_least("time of a steer angle", time.value(), before)?;
                    angle(at)?;
                    before = time.value();
                }
                Ok(())
            }
        }
    }

    /// (rad) the angle at a time (s).
    pub fn at(&self, time: T) -> T {
        self.angle(time)
    }

    /// The angle at a time that carries more derivatives than the angles.
    pub(crate) fn angle<U: Real + From<T>>(&self, time: U) -> U {
        match *self {
            Self::Held(held) => held.into(),
            Self::Over(points) => {
                let next = points.partition_point(|&(at, _)| at.value() <= time.value());
                match (next.checked_sub(1).and_then(|last| points.get(last)), points.get(next)) {
                    (Some(&(t0, from)), Some(&(t1, to))) => {
                        let [t0, from, t1, to]: [U; 4] = [t0, from, t1, to].map(Into::into);
                        from + (to - from) * ((time - t0) / (t1 - t0))
                    }
                    (Some(&(_, held)), None) | (None, Some(&(_, held))) => held.into(),
                    (None, None) => U::ZERO,
                }
            }
        }
    }

    /// (s) the next time after `time` (s) when the rate of steering changes.
    pub(crate) fn next_change(&self, time: f64) -> Option<T> {
        match *self {
            Self::Held(_) => None,
            Self::Over(points) => points.iter().map(|&(at, _)| at).find(|at| at.value() > time),
        }
    }
}
