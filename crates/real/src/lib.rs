//! The number type of the equations: a formula written once over [`Real`] serves plain `f64`, loops that the
//! compiler vectorises, and numbers that carry their derivatives.
//!
//! ```
//! use real::Real;
//!
//! /// (m/s) speed along the forward axis of a vehicle that moves with `(vx, vy)` and points to
//! /// `heading` (rad).
//! #[inline(always)]
//! fn forward_speed<T: Real>(vx: T, vy: T, heading: T) -> T {
//!     let (sin, cos) = heading.sin_cos();
//!     // v = vₓ cos θ + v_y sin θ
//!     vx * cos + vy * sin
//! }
//!
//! // SAE 980025, appendix: the Altima moved with (5.7, 13.5) ft/s and pointed to 67°. Its speed was
//! // 10 mph, 14.67 ft/s.
//! let speed = forward_speed(5.7, 13.5, 67_f64.to_radians());
//! assert!((speed - 14.67).abs() < 0.05 * (1.0 + 1.0)); // both components are printed to 0.1 ft/s
//! ```
//!
//! # Items
//!
//! | item | is |
//! |---|---|
//! | [`Real`] | the operations that the equations use; implemented for `f64`, [`Duals`], [`Bundle`] and [`Traced`] |
//! | [`Duals`] | a number that carries its derivatives with respect to one input or a few |
//! | [`Bundle`] | a number with others near it, whose differences approximate its derivatives in less time |
//! | [`gradients`], [`Traced`] | the derivatives of a formula with respect to all inputs at once (reverse mode), by recording how each number was computed |
//! | [`elementary::sin_cos`] | sine and cosine of an angle in radians, up to [`elementary::SIN_COS_LIMIT`] |
//! | [`elementary::atan2`] | angle of a vector in radians, over all of `f64` |
//! | [`principal_angle`] | the same direction in (−π, π] |
//! | [`elementary::sqrt`], [`elementary::ceil`] | square root and rounding up without the standard library |
//! | [`elementary::ln`], [`elementary::exp`] | natural logarithm and exponential, over all of `f64`; for sampling, not part of [`Real`] |
//!
//! # Same bits everywhere
//!
//! The C library picks its sine by the CPU it finds, so the standard library's last digit changes from
//! machine to machine. The functions here are made of + − × ÷, comparisons and bit operations, √ is rounded
//! correctly by IEEE 754, and nothing is fused, so a result has the same bits on every CPU and in every build
//! profile, alone or in a vectorised loop. Two things are not promised: the sign and payload of a NaN, and
//! 32-bit x86 without SSE2, whose registers hold more than an `f64`.
//!
//! # A trap
//!
//! On a plain `f64`, `x.sin_cos()` and `y.atan2(x)` are the *standard library's* methods, even where [`Real`]
//! is in scope: inherent methods win. So do `f64::min` and `f64::max`, which lose a NaN. In a function
//! generic over `T: Real` the same spelling calls ours. If the type is `f64`, write `Real::sin_cos(x)` or
//! [`elementary::sin_cos`]`(x)`.
//!
//! `examples/derivative.rs` differentiates a formula.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std`, on by default | [`gradients`], [`Traced`]; √ by the processor's own instruction. Without it the crate is `no_std`, with the same bits |
//! | `serde` | [`Gradient`] can be written and read |
//!
//! # What it does not do
//!
//! No logarithm or exponential of a [`Real`]: only what the equations use. No `f64 * T`: write the
//! constant on the right, `x * 0.5`. No complex numbers, no `f32`, and no reduction of angles beyond
//! [`elementary::SIN_COS_LIMIT`].

#![cfg_attr(not(feature = "std"), no_std)]
#![warn(clippy::std_instead_of_core)]

mod angle;
mod bundle;
mod duals;
pub mod elementary;
mod operator;
#[cfg(feature = "serde")]
mod read_as;
#[cfg(feature = "std")]
mod traced;

pub use angle::principal_angle;
pub use bundle::Bundle;
pub use duals::Duals;
#[cfg(feature = "std")]
pub use traced::{Gradient, Traced, gradients};

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number, as the equations use it.
///
/// Constants enter by `From<f64>`, or as `f64` on the right of an operator. Angles are in radians. Nothing
/// panics: an operation without an answer gives NaN, and every operation here passes NaN on to the result,
/// where the caller turns it into an error.
///
/// Implementations mark every function `#[inline(always)]` and select instead of branching, so that a loop
/// over samples is vectorised.
///
/// The trait is sealed: the equations rely on the behaviour of these types, and a later version may require
/// more of them.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + PartialEq
    + PartialOrd
    + From<f64>
    + Send
    + Sync
    + 'static
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;

    /// The number itself, without the derivatives it carries.
    fn value(self) -> f64;

    /// √x; NaN below zero, and −0 of −0.
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle in radians; NaN beyond [`elementary::SIN_COS_LIMIT`].
    fn sin_cos(self) -> (Self, Self);

    /// Angle in radians, in [−π, π], of the vector `(x, self)`: called on y, as `y.atan2(x)`.
    fn atan2(self, x: Self) -> Self;

    /// xᵖ with an exponent that is a constant; NaN below zero.
    fn power(self, exponent: f64) -> Self;

    /// |x|.
    #[inline(always)]
    fn abs(self) -> Self {
        if self.value().is_sign_negative() { -self } else { self }
    }

    /// The lesser of two numbers, the first if they are equal. NaN if either is NaN, unlike `f64::min`, which
    /// would hide it.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // A NaN in `other` makes the comparison false, which selects it.
        if self.value() <= other.value() || self.value().is_nan() { self } else { other }
    }

    /// The greater of two numbers, the first if they are equal. NaN if either is NaN, unlike `f64::max`,
    /// which would hide it.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // A NaN in `other` makes the comparison false, which selects it.
        if self.value() >= other.value() || self.value().is_nan() { self } else { other }
    }

    /// Whether the number and everything it carries is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// Whether the number and everything it carries is 0, so that a term multiplied by it can be left out. If
    /// only its value is 0, that would drop the derivative of the term.
    fn is_constant_zero(self) -> bool;
}

mod sealed {
    /// Cannot be implemented outside of this crate.
    pub trait Sealed {}

    impl Sealed for f64 {}
    impl<const N: usize> Sealed for crate::Duals<N> {}
    impl<const N: usize> Sealed for crate::Bundle<N> {}
    #[cfg(feature = "std")]
    impl Sealed for crate::Traced {}
}

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;

    #[inline(always)]
    fn value(self) -> f64 {
        self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        #[cfg(feature = "std")]
        let root = f64::sqrt(self);
        #[cfg(not(feature = "std"))]
        let root = elementary::sqrt(self);
        root
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        elementary::atan2(self, x)
    }

    #[inline(always)]
    fn power(self, exponent: f64) -> Self {
        // xᵖ = exp(p ln x)
        elementary::exp(exponent * elementary::ln(self))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        // The same as f64::is_finite, which together with a test of the sign compiles to tests of bits. In
        // vectors those cost three times as much as these comparisons.
        self.abs() <= Self::MAX
    }

    #[inline(always)]
    fn is_constant_zero(self) -> bool {
        self == 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::{Real, elementary};
    use core::f64::consts::PI;

    /// Every operation of the trait in its generic spelling, as the equations use it.
    fn constants_on_the_right<T: Real>(x: T) -> T {
        let mut y = -(((x + 1.0) * 2.0 - 3.0) / 4.0);
        y += T::ONE;
        y -= T::ZERO;
        y *= T::from(8.0);
        y /= x;
        y
    }

    #[test]
    fn arithmetic_is_that_of_f64() {
        // −((3 + 1)·2 − 3)/4 = −1.25; (−1.25 + 1 − 0)·8/3 = −2/3
        assert_eq!(constants_on_the_right(3.0), -2.0 / 3.0);
        assert_eq!(Real::value(2.5), 2.5);
        assert_eq!(Real::sqrt(6.25), 2.5);
        assert!(Real::sqrt(-1.0).is_nan());
        assert_eq!(Real::abs(-2.5), 2.5);
    }

    #[test]
    fn the_trait_takes_our_own_functions() {
        // The standard library has no limit; ours has.
        let (sin, cos) = Real::sin_cos(2.0 * elementary::SIN_COS_LIMIT);
        assert!(sin.is_nan() && cos.is_nan());
        assert_eq!(Real::sin_cos(0.0), (0.0, 1.0));
        assert_eq!(Real::atan2(0.0, -1.0), PI);
        assert_eq!(Real::atan2(-1.0, 0.0), -PI / 2.0);
    }

    #[test]
    fn min_and_max_keep_nan() {
        for (least, most) in [(-1.0, 2.0), (f64::NEG_INFINITY, f64::INFINITY), (-0.5, -0.25)] {
            assert_eq!(Real::min(least, most), least);
            assert_eq!(Real::min(most, least), least);
            assert_eq!(Real::max(least, most), most);
            assert_eq!(Real::max(most, least), most);
        }
        for x in [-1.0, 0.0, f64::INFINITY, f64::NAN] {
            assert!(Real::min(x, f64::NAN).is_nan() && Real::min(f64::NAN, x).is_nan());
            assert!(Real::max(x, f64::NAN).is_nan() && Real::max(f64::NAN, x).is_nan());
        }
    }

    #[test]
    fn of_equal_numbers_min_and_max_take_the_first() {
        assert!(Real::min(-0.0, 0.0).is_sign_negative() && Real::min(0.0, -0.0).is_sign_positive());
        assert!(Real::max(-0.0, 0.0).is_sign_negative() && Real::max(0.0, -0.0).is_sign_positive());
    }

    #[test]
    fn finite_is_neither_infinite_nor_nan() {
        assert!(Real::is_finite(f64::MAX) && Real::is_finite(-0.0));
        assert!(!Real::is_finite(f64::INFINITY) && !Real::is_finite(f64::NAN));
    }
}
