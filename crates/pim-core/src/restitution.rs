//! Restitution that depends on the closing speed.

use alloc::vec::Vec;

use real::Real;

use crate::check;
use crate::error::InvalidInput;
use crate::law::Law;

/// The coefficient of restitution as a function of the closing speed −u_n: linear between the points,
/// constant outside.
///
/// Restitution falls with closing speed, so a reconstruction of an unknown speed cannot assume it beforehand.
#[derive(Clone, Debug, PartialEq)]
pub struct RestitutionCurve<T = f64> {
    /// (closing speed in m/s, e), by ascending speed.
    pub(crate) points: Vec<(T, T)>,
}

impl<T: Real> RestitutionCurve<T> {
    /// Through points (closing speed in m/s, coefficient of restitution).
    ///
    /// # Errors
    /// If there is no point, the speeds do not ascend from zero or more, or a coefficient lies outside [0,
    /// 1].
    pub fn new(points: Vec<(T, T)>) -> Result<Self, InvalidInput> {
        if points.is_empty() {
            return Err(InvalidInput::NoPoints);
        }
        let mut before = 0.0;
        for (i, (speed, e)) in points.iter().enumerate() {
            check::finite("closing speed of a restitution", speed.value())?;
            check::within("coefficient of restitution", e.value(), 0.0, 1.0)?;
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

    /// The points (closing speed in m/s, coefficient of restitution) on either side of a closing speed (m/s):
    /// the last that is not above it, and the first that is.
    #[must_use]
    pub fn around(&self, closing_speed: T) -> [Option<(T, T)>; 2] {
        let next = self.points.partition_point(|(speed, _)| *speed <= closing_speed);
        [next.checked_sub(1).and_then(|i| self.points.get(i)).copied(), self.points.get(next).copied()]
    }

    /// e at a closing speed (m/s) between two neighbouring points, of different speeds.
    #[inline(always)]
    #[must_use]
    pub fn between([(v0, e0), (v1, e1)]: [(T, T); 2], closing_speed: T) -> T {
        // e = e₀ + (e₁ − e₀) (v − v₀)/(v₁ − v₀)
        e0 + (e1 - e0) * (closing_speed - v0) / (v1 - v0)
    }

    /// e at a closing speed (m/s).
    #[must_use]
    pub fn at(&self, closing_speed: T) -> T {
        match self.around(closing_speed) {
            [Some(from), Some(to)] => Self::between([from, to], closing_speed),
            [Some((_, e)), None] | [None, Some((_, e))] => e,
            // The constructor ensures that there is a point.
            [None, None] => T::ZERO,
        }
    }
}

/// An impact law at every closing speed: its coefficient of restitution is a number, or the
/// [`RestitutionCurve`] that [`Law::with_restitution_curve`] gave it.
///
/// ```
/// use pim_core::{Law, RestitutionCurve, Tangential, VaryingLaw};
///
/// let curve = RestitutionCurve::new(vec![(2.0, 0.4), (6.0, 0.2)])?;
/// let law = Law::new(0.0, Tangential::Critical)?.with_restitution_curve(curve);
/// assert!((law.at(4.0).restitution() - 0.3).abs() < 1e-15);
/// let constant = VaryingLaw::from(Law::new(0.1, Tangential::Critical)?);
/// assert_eq!(constant.at(4.0).restitution(), 0.1);
/// # Ok::<(), pim_core::InvalidInput>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct VaryingLaw<T = f64> {
    pub(crate) nominal: Law<T>,
    pub(crate) curve: Option<RestitutionCurve<T>>,
}

impl<T> From<Law<T>> for VaryingLaw<T> {
    #[inline(always)]
    fn from(law: Law<T>) -> Self {
        Self { nominal: law, curve: None }
    }
}

impl<T: Real> Law<T> {
    /// The same law with a restitution that depends on the closing speed, in place of its own.
    #[must_use]
    pub fn with_restitution_curve(self, curve: RestitutionCurve<T>) -> VaryingLaw<T> {
        let first = curve.points.first().map_or(self.restitution(), |&(_, e)| e);
        VaryingLaw { nominal: self.restituting(first), curve: Some(curve) }
    }
}

impl<T: Real> VaryingLaw<T> {
    /// The law at a closing speed −u_n (m/s).
    #[inline(always)]
    #[must_use]
    pub fn at(&self, closing_speed: T) -> Law<T> {
        match &self.curve {
            None => self.nominal,
            Some(curve) => self.nominal.restituting(curve.at(closing_speed)),
        }
    }

    /// The law itself; if it has a curve, with the restitution of the first point.
    #[inline(always)]
    #[must_use]
    pub fn nominal(&self) -> Law<T> {
        self.nominal
    }

    /// The restitution by closing speed, if it varies.
    #[inline(always)]
    #[must_use]
    pub fn curve(&self) -> Option<&RestitutionCurve<T>> {
        self.curve.as_ref()
    }

    /// Whether e = 1 at every closing speed, so that the normal impulse takes no energy at any.
    #[inline(always)]
    #[must_use]
    pub fn is_elastic(&self) -> bool {
        match &self.curve {
            None => self.nominal.restitution() == T::ONE,
            Some(curve) => curve.points.iter().all(|&(_, e)| e == T::ONE),
        }
    }
}
