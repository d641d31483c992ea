//! Numbers that may be unknown.

use uncertainty::{Distribution, Lanes};

/// A number of the collision, in the SI unit of its field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// Known.
    Exact(f64),
    /// Unknown, with its prior distribution.
    Unknown(Distribution),
}

impl From<f64> for Number {
    fn from(number: f64) -> Self {
        Self::Exact(number)
    }
}

impl From<Distribution> for Number {
    fn from(distribution: Distribution) -> Self {
        Self::Unknown(distribution)
    }
}

/// The source of a number of a particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Slot {
    /// The same in every particle.
    Exact(f64),
    /// The index among the unknown values.
    At(usize),
}

impl Slot {
    #[inline(always)]
    pub(crate) fn of(self, values: &[Lanes], lane: usize) -> f64 {
        match self {
            Self::Exact(number) => number,
            Self::At(place) => values.get(place).map_or(f64::NAN, |column| column[lane]),
        }
    }
}
