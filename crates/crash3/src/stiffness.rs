//! What the structure resists with: force per width as a linear function of crush.

use real::Real;

use crate::error::{self, CrushError};

/// CRASH3's stiffness coefficients: force per width A + B C, and the energy per width G that is stored before any
/// crush remains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness<T = f64> {
    a: T,
    b: T,
    g: T,
}

impl<T: Real> Stiffness<T> {
    /// From A (N/m) and B (N/m²), with G = A²/2B (N).
    ///
    /// # Errors
    /// Where A is negative, B is not positive, or a number is not finite.
    pub fn from_ab(a: T, b: T) -> Result<Self, CrushError> {
        if b.value() == 0.0 {
            return Err(CrushError::NoRise);
        }
        error::positive("stiffness B", b.value())?;
        // G = A²/2B
        Self::from_abg(a, b, a * a / (b * 2.0))
    }

    /// From A (N/m), B (N/m²) and a G (N) of its own, as CRASH3's tables give it.
    ///
    /// # Errors
    /// Where one of them is negative or not finite.
    pub fn from_abg(a: T, b: T, g: T) -> Result<Self, CrushError> {
        error::not_negative("stiffness A", a.value())?;
        error::not_negative("stiffness B", b.value())?;
        error::not_negative("stiffness G", g.value())?;
        Ok(Self { a, b, g })
    }

    /// From d_0 (√N) and d_1 (√N/m), with G = d_0²/2.
    ///
    /// # Errors
    /// Where one of them is negative or not finite.
    pub fn from_d0_d1(d0: T, d1: T) -> Result<Self, CrushError> {
        // G = d₀²/2
        Self::from_d0_d1_g(d0, d1, d0 * d0 * 0.5)
    }

    /// From d_0 (√N), d_1 (√N/m) and a G (N) of its own.
    ///
    /// # Errors
    /// Where one of them is negative or not finite.
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
}
