//! Units of measurement and their factors to SI.
//!
//! There is no unit algebra: every unit is a row of an explicit table, with its exact factor.

mod table;
#[cfg(test)]
mod tests;

use std::fmt;

/// (N/kg, m/s²) standard gravity, which turns a weight into a mass: exact by definition (3rd CGPM, 1901; NIST
/// SP 811, appendix B.8).
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// The dimension of a quantity. Each key of a case has one dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dimension {
    /// (m) widths, depths, distances.
    Length,
    /// (kg) mass; here `lb` is the pound of mass.
    Mass,
    /// (N) weight; here `lb` is the pound-force.
    Weight,
    /// (m/s) speed.
    Speed,
    /// (rad) angle.
    Angle,
    /// (rad/s) yaw rate.
    YawRate,
    /// (s) time.
    Time,
    /// (m/s²) acceleration.
    Acceleration,
    /// (kg·m²) yaw moment of inertia.
    Inertia,
    /// (J) energy; here `lb` is the pound-force.
    Energy,
    /// (N/m) stiffness coefficient A: force per unit width at which crush begins.
    StiffnessA,
    /// (N/m²) stiffness coefficient B: force per unit width and depth.
    StiffnessB,
    /// (N) stiffness coefficient G: energy per unit width absorbed without residual crush.
    StiffnessG,
    /// (√N) d₀ = A/√B.
    RootForce,
    /// (√N/m) d₁ = √B.
    RootForcePerLength,
}

impl Dimension {
    /// The name with its article, for error texts: "a length", "an angle".
    #[must_use]
    pub fn name(self) -> &'static str {
        self.kind().name
    }

    /// The SI unit in which [`Quantity::si`](crate::Quantity::si) gives values of this dimension.
    #[must_use]
    pub fn si_unit(self) -> &'static str {
        self.unit_of_si().spelling()
    }

    /// That SI unit as a row of the table: each dimension has one row whose factor is 1.
    pub(crate) fn unit_of_si(self) -> &'static Unit {
        let units = self.units();
        units.iter().find(|unit| unit.factor == 1.0).unwrap_or(&units[0])
    }

    /// (SI) the largest magnitude a case may give. Far beyond any vehicle, and small enough that no
    /// equation downstream can overflow: a number beyond it is a typing error.
    #[must_use]
    pub fn bound(self) -> f64 {
        self.kind().bound
    }

    /// (SI) the smallest value accepted for a quantity that must be positive: below it a division downstream
    /// could overflow, and no vehicle has such a value.
    #[must_use]
    pub fn least_positive(self) -> f64 {
        self.kind().least
    }

    /// The units of this dimension, in the order in which error texts list them.
    #[must_use]
    pub fn units(self) -> &'static [Unit] {
        self.kind().units
    }

    /// The unit with this spelling, which must be exactly one of [`Unit::spellings`].
    #[must_use]
    pub fn unit(self, spelling: &str) -> Option<&'static Unit> {
        self.units().iter().find(|unit| unit.spellings().any(|known| known == spelling))
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The two unit systems in which a case may be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitSystem {
    /// Metric.
    Si,
    /// US customary.
    Us,
}

/// One accepted unit: a row of the table.
#[derive(Debug, PartialEq)]
pub struct Unit {
    spelling: &'static str,
    others: &'static [&'static str],
    factor: f64,
    system: Option<UnitSystem>,
    dimension: Dimension,
}

impl Unit {
    /// The spelling used when a value is written back.
    #[must_use]
    pub fn spelling(&self) -> &'static str {
        self.spelling
    }

    /// Every accepted spelling, the canonical one first.
    pub fn spellings(&self) -> impl Iterator<Item = &'static str> + use<> {
        std::iter::once(self.spelling).chain(self.others.iter().copied())
    }

    /// The size of this unit in SI.
    #[inline(always)]
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// The system this unit belongs to; `None` for a unit that both use, such as degrees.
    #[must_use]
    pub fn system(&self) -> Option<UnitSystem> {
        self.system
    }

    /// The dimension of this unit.
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        self.dimension
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.spelling)
    }
}
