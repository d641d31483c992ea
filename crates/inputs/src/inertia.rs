//! Mass and yaw inertia, in the forms that a case can give.

use std::fmt::Display;

use pim_core::Real;

use crate::quantity::Quantity;
use crate::units::STANDARD_GRAVITY;
use crate::walk::{Key, Walk};

/// How a vehicle's mass is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mass<T = f64> {
    /// (kg) `mass`.
    Mass(Quantity<T>),
    /// (N) `weight`.
    Weight(Quantity<T>),
}

impl<T: Copy> Mass<T> {
    /// The same with another number.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, number: impl FnMut(T) -> U) -> Mass<U> {
        match self {
            Self::Mass(mass) => Mass::Mass(mass.map(number)),
            Self::Weight(weight) => Mass::Weight(weight.map(number)),
        }
    }
}

impl<T: Real> Mass<T> {
    /// (kg) the mass; a weight is divided by [`STANDARD_GRAVITY`].
    #[inline(always)]
    #[must_use]
    pub fn kg(&self) -> T {
        match self {
            Self::Mass(mass) => mass.si(),
            // m = W / g
            Self::Weight(weight) => weight.si() / STANDARD_GRAVITY,
        }
    }
}

/// How a vehicle's yaw moment of inertia is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum YawInertia<T = f64> {
    /// (kg·m²) `yaw_inertia`.
    Inertia(Quantity<T>),
    /// (m) `yaw_radius`, the radius of gyration k: I = m k².
    Radius(Quantity<T>),
}

impl<T: Copy> YawInertia<T> {
    /// The same with another number.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, number: impl FnMut(T) -> U) -> YawInertia<U> {
        match self {
            Self::Inertia(inertia) => YawInertia::Inertia(inertia.map(number)),
            Self::Radius(radius) => YawInertia::Radius(radius.map(number)),
        }
    }
}

impl<T: Real> YawInertia<T> {
    /// (kg·m²) the inertia of a vehicle of the given mass (kg).
    #[inline(always)]
    #[must_use]
    pub fn kg_m2(&self, mass: T) -> T {
        match self {
            Self::Inertia(inertia) => inertia.si(),
            // I = m k²
            Self::Radius(radius) => mass * radius.si() * radius.si(),
        }
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn mass(&mut self, table: &dyn Display, mass: &Mass) -> Mass<U> {
        match mass {
            Mass::Mass(q) => Mass::Mass(self.quantity(&Key(table, "mass"), q)),
            Mass::Weight(q) => Mass::Weight(self.quantity(&Key(table, "weight"), q)),
        }
    }
}
