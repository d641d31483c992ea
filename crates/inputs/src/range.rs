//! Ranges: numbers that are not known exactly.

use std::fmt;

use trajectory::GREATEST_FRICTION;

use crate::quantity::format_number;
use crate::units::Unit;

/// An uncertain number of a case: one of [`Case::inputs`](crate::Case::inputs), and its uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Path of the number, as [`Input::path`](crate::Input::path).
    pub path: String,
    /// Its uncertainty.
    pub spread: Spread,
    /// Its physical bounds.
    pub bounds: Bounds,
}

/// The uncertainty of a number. The number itself is kept by the [`Case`](crate::Case), as its central value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// `{ value, sd }`: normally distributed about the central value.
    Normal {
        /// Standard deviation, greater than zero.
        sd: Amount,
    },
    /// `{ low, high }`: anything between the two; the central value is their middle.
    Uniform {
        /// Least value.
        low: Amount,
        /// Greatest value.
        high: Amount,
    },
    /// `{ low, mode, high }`: between the two, with the central value most likely.
    Triangular {
        /// Least value.
        low: Amount,
        /// Greatest value.
        high: Amount,
    },
    /// `{ value, within, confidence }`: normally distributed; with the probability `confidence`, it lies
    /// within this percentage of the central value.
    Within {
        /// (%) of the central value, greater than zero.
        percent: f64,
        /// Probability, between 0 and 1.
        confidence: f64,
    },
}

/// A number and the unit in which it was written, if it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    /// The number as written.
    pub number: f64,
    /// The unit as written.
    pub unit: Option<&'static Unit>,
}

impl Amount {
    /// The number in another unit of the same dimension; unchanged if the unit is its own.
    #[must_use]
    pub fn in_unit(&self, unit: Option<&'static Unit>) -> f64 {
        match (self.unit, unit) {
            (Some(own), Some(other)) if own != other => self.number * own.factor() / other.factor(),
            _ => self.number,
        }
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&format_number(self.number))?;
        self.unit.map_or(Ok(()), |unit| write!(f, " {unit}"))
    }
}

/// The physical bounds of a quantity. No sample lies beyond them: a normal distribution is truncated there,
/// and the ends of the other distributions must lie within.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// No bounds.
    None,
    /// Zero or more.
    NotNegative,
    /// More than zero.
    Positive,
    /// From 0 to 1.
    Share,
    /// From 0 to less than 1: a coefficient of restitution.
    BelowOne,
    /// From −1 to 1.
    Coefficient,
    /// More than zero, and no more than any ground has.
    Friction,
    /// Less than a right angle to either side.
    Acute,
}

impl Bounds {
    /// The least and the greatest value in the given unit; infinite if there is no bound.
    #[must_use]
    pub fn interval(self, unit: Option<&'static Unit>) -> [f64; 2] {
        let least = |unit: &Unit| unit.dimension().least_positive() / unit.factor();
        match self {
            Self::None => [f64::NEG_INFINITY, f64::INFINITY],
            Self::NotNegative => [0.0, f64::INFINITY],
            Self::Positive => [unit.map_or(f64::MIN_POSITIVE, least), f64::INFINITY],
            Self::Share => [0.0, 1.0],
            Self::BelowOne => [0.0, 1.0_f64.next_down()],
            Self::Coefficient => [-1.0, 1.0],
            Self::Friction => [f64::MIN_POSITIVE, GREATEST_FRICTION],
            Self::Acute => {
                let right = std::f64::consts::FRAC_PI_2 / unit.map_or(1.0, Unit::factor);
                // The rounding of the division must not reach the right angle itself.
                [-right.next_down().next_down(), right.next_down().next_down()]
            }
        }
    }
}

// The words for it, here and where a case is read, say "at most 2".
const _: () = assert!(GREATEST_FRICTION == 2.0);

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "any value",
            Self::NotNegative => "zero or more",
            Self::Positive => "greater than zero",
            Self::Share => "0 to 1",
            Self::BelowOne => "0 to less than 1",
            Self::Coefficient => "-1 to 1",
            Self::Friction => "greater than zero, and at most 2",
            Self::Acute => "less than a right angle",
        })
    }
}
