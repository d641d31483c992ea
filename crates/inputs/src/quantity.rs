//! A number with its unit, as it was given.

use std::fmt;

use pim_core::Real;
use thiserror::Error;

use crate::units::{Dimension, Unit};

/// A number with its unit, as it was given: finite and within [`Dimension::bound`], unless
/// [`with`](Self::with) or [`map`](Self::map) made another of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity<T = f64> {
    number: T,
    unit: &'static Unit,
}

impl<T: Copy> Quantity<T> {
    /// The number as given.
    #[must_use]
    pub fn number(&self) -> T {
        self.number
    }

    /// The unit as given.
    #[must_use]
    pub fn unit(&self) -> &'static Unit {
        self.unit
    }

    /// Its dimension.
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        self.unit.dimension()
    }

    /// Another number in the same unit.
    #[inline(always)]
    #[must_use]
    pub fn with<U>(&self, number: U) -> Quantity<U> {
        Quantity { number, unit: self.unit }
    }

    /// The number changed by a function, in the same unit.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> Quantity<U> {
        self.with(number(self.number))
    }
}

impl<T: From<f64>> Quantity<T> {
    /// A length in metres.
    pub(crate) fn metres(metres: f64) -> Self {
        Self { number: T::from(metres), unit: Dimension::Length.unit_of_si() }
    }
}

impl<T: Real> Quantity<T> {
    /// The value in SI ([`Dimension::si_unit`]).
    #[inline(always)]
    #[must_use]
    pub fn si(&self) -> T {
        self.number * self.unit.factor()
    }
}

impl Quantity {
    /// A number in a unit of the table.
    ///
    /// ```
    /// use inputs::{Dimension, Quantity};
    /// let foot = Dimension::Length.unit("ft").ok_or("a foot is a length")?;
    /// let distance = Quantity::new(6.3, foot)?;
    /// assert!((distance.si() - 1.92024).abs() < 1e-12); // NIST SP 811: 1 ft = 0.3048 m
    /// assert_eq!(distance.to_string(), "6.3 ft");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`InvalidQuantity`].
    pub fn new(number: f64, unit: &'static Unit) -> Result<Self, InvalidQuantity> {
        let quantity = Self { number, unit };
        if !number.is_finite() {
            return Err(InvalidQuantity::NotFinite { value: quantity.to_string() });
        }
        if quantity.si().abs() > unit.dimension().bound() {
            return Err(InvalidQuantity::OutOfBounds { value: quantity.to_string(), unit });
        }
        Ok(quantity)
    }

    /// A value in SI ([`Dimension::si_unit`]).
    ///
    /// # Errors
    ///
    /// [`InvalidQuantity`].
    pub fn from_si(value: f64, dimension: Dimension) -> Result<Self, InvalidQuantity> {
        Self::new(value, dimension.unit_of_si())
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", format_number(self.number), self.unit)
    }
}

/// Why a number in a unit is not a quantity.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum InvalidQuantity {
    /// Not a number, or infinite.
    #[error("\"{value}\" is not a finite number")]
    NotFinite {
        /// Number and unit.
        value: String,
    },
    /// Beyond [`Dimension::bound`].
    #[error("\"{value}\" is implausibly large for {}", unit.dimension())]
    OutOfBounds {
        /// Number and unit.
        value: String,
        /// The unit.
        unit: &'static Unit,
    },
}

/// The shortest text that reads back as the same number.
#[must_use]
pub fn format_number(number: f64) -> String {
    let text = format!("{number:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}
