//! The stiffness of a structure: force per width as a linear function of crush.

use alloc::vec::Vec;

use real::Real;

use crate::error::{self, CrushError};

/// CRASH3's stiffness coefficients: force per width A + B C, flat beyond a limit if there is one, and the
/// energy per width G that is stored before any crush remains.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stiffness<T = f64> {
    a: T,
    b: T,
    g: T,
    saturation_force: Option<T>,
}

impl<T: Real> Stiffness<T> {
    /// From A (N/m) and B (N/m²), with G = A²/2B (N).
    ///
    /// # Errors
    /// If A is negative, B is not positive, or a number is not finite.
    #[inline(always)]
    pub fn from_ab(a: T, b: T) -> Result<Self, CrushError> {
        if b.value() == 0.0 {
            return Err(CrushError::NoRise);
        }
        error::positive("stiffness B", b.value())?;
        // G = A²/2B
        Self::from_abg(a, b, a * a / (b * 2.0))
    }

    /// From A (N/m), B (N/m²) and an independent G (N), as CRASH3's tables give it.
    ///
    /// # Errors
    /// If one of them is negative or not finite.
    #[inline(always)]
    pub fn from_abg(a: T, b: T, g: T) -> Result<Self, CrushError> {
        let stiffness = Self { a, b, g, saturation_force: None };
        stiffness.check()?;
        Ok(stiffness)
    }

    /// Like [`from_abg`](Self::from_abg), but returns a validity flag in place of an error, so that loops
    /// over many samples vectorise.
    #[inline(always)]
    #[must_use]
    pub fn from_abg_with_validity(a: T, b: T, g: T) -> (Self, bool) {
        let stiffness = Self { a, b, g, saturation_force: None };
        (stiffness, stiffness.check().is_ok())
    }

    #[inline(always)]
    fn check(&self) -> Result<(), CrushError> {
        error::not_negative("stiffness A", self.a.value())?;
        error::not_negative("stiffness B", self.b.value())?;
        error::not_negative("stiffness G", self.g.value())
    }

    /// From d_0 (√N) and d_1 (√N/m), with G = d_0²/2.
    ///
    /// # Errors
    /// If one of them is negative or not finite.
    #[inline(always)]
    pub fn from_d0_d1(d0: T, d1: T) -> Result<Self, CrushError> {
        // G = d₀²/2
        Self::from_d0_d1_g(d0, d1, d0 * d0 * 0.5)
    }

    /// From d_0 (√N), d_1 (√N/m) and an independent G (N).
    ///
    /// # Errors
    /// If one of them is negative or not finite.
    #[inline(always)]
    pub fn from_d0_d1_g(d0: T, d1: T, g: T) -> Result<Self, CrushError> {
        error::not_negative("stiffness d0", d0.value())?;
        error::not_negative("stiffness d1", d1.value())?;
        // A = d₀ d₁,  B = d₁²
        Self::from_abg(d0 * d1, d1 * d1, g)
    }

    /// (N/m) A, the force per width at which crush begins.
    #[inline(always)]
    #[must_use]
    pub fn a(&self) -> T {
        self.a
    }

    /// (N/m²) B, the rise of the force per width with crush.
    #[inline(always)]
    #[must_use]
    pub fn b(&self) -> T {
        self.b
    }

    /// (N) G, the energy per width taken up before crush begins.
    #[inline(always)]
    #[must_use]
    pub fn g(&self) -> T {
        self.g
    }

    /// The same stiffness with a force per width that saturates at `force`, F_s (N/m).
    ///
    /// # Errors
    /// If the force is below A or not finite.
    #[inline(always)]
    pub fn with_saturation_force(self, force: T) -> Result<Self, CrushError> {
        error::finite("limit of the force per width", force.value())?;
        if force.value() < self.a.value() {
            return Err(CrushError::LimitBelowStart { limit: force.value(), a: self.a.value() });
        }
        Ok(Self { saturation_force: Some(force), ..self })
    }

    /// (N/m) F_s, the force per width at which the structure yields without a further rise: key `limit` of a
    /// case.
    #[inline(always)]
    #[must_use]
    pub fn saturation_force(&self) -> Option<T> {
        self.saturation_force
    }

    /// (N/m) the force per width at the depth C (m).
    #[inline(always)]
    #[must_use]
    pub fn force_per_width(&self, depth: T) -> T {
        // f = min(A + B C, F_s)
        let rising = self.a + self.b * depth;
        match self.saturation_force {
            Some(force) if rising.value() > force.value() => force,
            _ => rising,
        }
    }

    /// The point where the force per width saturates; `None` if it never does.
    #[inline(always)]
    #[must_use]
    pub fn saturation(&self) -> Option<Saturation<T>> {
        match self.saturation_force {
            // C_s = (F_s − A)/B
            Some(force) if self.b.value() > 0.0 => {
                Some(Saturation { force, depth: (force - self.a) / self.b })
            }
            _ => None,
        }
    }
}

/// The point where the force per width ceases to rise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Saturation<T = f64> {
    /// (N/m) F_s.
    pub force: T,
    /// (m) C_s, the depth at which the force per width reaches it.
    pub depth: T,
}

/// The stiffness of a damaged side: uniform, or separate for each zone between two stations.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
pub enum SideStiffness<T = f64> {
    /// The same everywhere.
    Uniform(Stiffness<T>),
    /// One for each zone between neighbouring stations, in order.
    Zones(Vec<Stiffness<T>>),
}
