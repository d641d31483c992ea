//! Restitution that depends on how fast the vehicles close.

use real::Real;

use crate::error::{self, InvalidInput};
use crate::law::Law;

/// The coefficient of restitution as a function of the closing speed −u_n: linear between the points, constant outside.
///
/// Restitution falls with closing speed, so a reconstruction in which the speed is not known cannot know it beforehand.
#[derive(Clone, Debug, PartialEq)]
pub struct RestitutionCurve<T = f64> {
    /// (closing speed in m/s, e), by ascending speed.
    points: Vec<(T, T)>,
}

impl<T: Real> RestitutionCurve<T> {
    /// Through points (closing speed in m/s, coefficient of restitution).
    ///
    /// # Errors
    /// Where there is no point, the speeds do not ascend from zero or more, or a coefficient lies outside [0, 1].
    pub fn new(points: Vec<(T, T)>) -> Result<Self, InvalidInput> {
        if points.is_empty() {
            return Err(InvalidInput::NoPoints);
        }
        let mut before = 0.0;
        for (i, (speed, e)) in points.iter().enumerate() {
            error::finite("closing speed of a restitution", speed.value())?;
            error::within("coefficient of restitution", e.value(), 0.0, 1.0)?;
            if speed.value() < before || (i > 0 && speed.value() == before) {
                return Err(InvalidInput::NotAscending { before, value: speed.value() });
            }
            before = speed.value();
        }
        Ok(Self { points })
    }

    /// The points (closing speed in m/s, coefficient of restitution).
    #[must_use]
    pub fn points(&self) -> &[(T, T)] {
        &self.points
    }

    /// e at a closing speed (m/s).
    #[must_use]
    pub fn at(&self, closing_speed: T) -> T {
        let next = self.points.partition_point(|(speed, _)| *speed <= closing_speed);
        match (next.checked_sub(1).and_then(|i| self.points.get(i)), self.points.get(next)) {
            (Some(&(v0, e0)), Some(&(v1, e1))) => {
                // e = e₀ + (e₁ − e₀) (v − v₀)/(v₁ − v₀)
                e0 + (e1 - e0) * (closing_speed - v0) / (v1 - v0)
            }
            (Some(&(_, e)), None) | (None, Some(&(_, e))) => e,
            // The constructor sees to it that there is a point.
            (None, None) => T::ZERO,
        }
    }

    /// `law` with the restitution of a closing speed (m/s).
    #[must_use]
    pub fn law(&self, law: Law<T>, closing_speed: T) -> Law<T> {
        law.restituting(self.at(closing_speed))
    }
}
