//! A number that carries its derivative.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::Real;

/// A value and its derivative with respect to one input: an equation over [`Real`] evaluated on it is
/// differentiated exactly, by the rules of calculus and not by differences.
///
/// ```
/// use real::{Dual, Real};
///
/// let x = Dual { value: 3.0, derivative: 1.0 };
/// let y = x * x + x.sqrt();
/// assert_eq!(y.derivative, 2.0 * 3.0 + 0.5 / 3_f64.sqrt());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Dual {
    /// The number itself.
    pub value: f64,
    /// d/dx of it.
    pub derivative: f64,
}

impl Dual {
    /// A constant is `Dual::from(value)`; this is the input itself, whose derivative is 1.
    #[must_use]
    pub fn variable(value: f64) -> Self {
        Self { value, derivative: 1.0 }
    }
}

impl PartialOrd for Dual {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl From<f64> for Dual {
    fn from(value: f64) -> Self {
        Self { value, derivative: 0.0 }
    }
}

impl Neg for Dual {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, derivative: -self.derivative }
    }
}

/// An operator of two numbers, and of a number and an `f64` on its right.
macro_rules! operator {
    ($Op:ident $op:ident $Assign:ident $assign:ident: |$x:ident, $y:ident| $value:expr, $derivative:expr) => {
        impl $Op for Dual {
            type Output = Self;

            #[inline(always)]
            fn $op(self, other: Self) -> Self {
                let ($x, $y) = (self, other);
                Self { value: $value, derivative: $derivative }
            }
        }

        impl $Op<f64> for Dual {
            type Output = Self;

            #[inline(always)]
            fn $op(self, other: f64) -> Self {
                self.$op(Self::from(other))
            }
        }

        impl $Assign for Dual {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = self.$op(other);
            }
        }
    };
}

operator!(Add add AddAssign add_assign: |x, y| x.value + y.value, x.derivative + y.derivative);
operator!(Sub sub SubAssign sub_assign: |x, y| x.value - y.value, x.derivative - y.derivative);
// (x y)′ = x′ y + x y′
operator!(Mul mul MulAssign mul_assign: |x, y| x.value * y.value, x.derivative * y.value + x.value * y.derivative);
// (x/y)′ = (x′ − (x/y) y′)/y
operator!(Div div DivAssign div_assign: |x, y| x.value / y.value, (x.derivative - x.value / y.value * y.derivative) / y.value);

impl Real for Dual {
    const ZERO: Self = Self { value: 0.0, derivative: 0.0 };
    const ONE: Self = Self { value: 1.0, derivative: 0.0 };

    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }

    /// The derivative of √x at x = 0 is infinite, but that of a constant zero is zero.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = Real::sqrt(self.value);
        // (√x)′ = x′/(2√x)
        let derivative = if self.derivative == 0.0 { 0.0 } else { self.derivative / (2.0 * root) };
        Self { value: root, derivative }
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(self.value);
        (
            Self { value: sin, derivative: cos * self.derivative },
            Self { value: cos, derivative: -sin * self.derivative },
        )
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        // atan2(y, x)′ = (y′ x − y x′)/(x² + y²)
        let derivative = (self.derivative * x.value - self.value * x.derivative)
            / (self.value * self.value + x.value * x.value);
        Self { value: Real::atan2(self.value, x.value), derivative }
    }

    #[inline(always)]
    fn power(self, exponent: f64) -> Self {
        let power = self.value.power(exponent);
        // (xᵖ)′ = p xᵖ x′/x
        Self { value: power, derivative: exponent * power * self.derivative / self.value }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self.value <= other.value || self.value.is_nan() { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self.value >= other.value || self.value.is_nan() { self } else { other }
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.derivative.is_finite()
    }

    #[inline(always)]
    fn is_constant_zero(self) -> bool {
        self.value == 0.0 && self.derivative == 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::Dual;
    use crate::Real;

    /// Functions with derivatives that are known, at x = 0.7.
    #[test]
    fn derivatives_follow_the_rules() {
        let x = Dual::variable(0.7);
        let (sin, cos) = x.sin_cos();
        let constant = Dual::from(2.0);
        for (name, y, expected) in [
            ("x + x", x + x, 2.0),
            ("x − x²", x - x * x, 1.0 - 1.4),
            ("1/x", Dual::ONE / x, -1.0 / 0.49),
            ("x/2", x / constant, 0.5),
            ("x/(1 + x)", x / (x + 1.0), 1.0 / (1.7 * 1.7)),
            ("√x", x.sqrt(), 0.5 / 0.7_f64.sqrt()),
            ("√0 of a constant", Dual::ZERO.sqrt(), 0.0),
            // d/dx x^1.5 = 1.5 √x
            ("x^1.5", x.power(1.5), 1.5 * 0.7_f64.sqrt()),
            ("sin", sin, 0.764_842_187_284_488_5),
            ("cos", cos, -0.644_217_687_237_691),
            ("atan", x.atan2(Dual::ONE), 1.0 / 1.49),
            ("atan 1/x", Dual::ONE.atan2(x), -1.0 / 1.49),
            ("|−x|", (-x).abs(), 1.0),
            ("|x|", x.abs(), 1.0),
            ("min", x.min(constant), 1.0),
            ("max", x.max(constant), 0.0),
        ] {
            assert!((y.derivative - expected).abs() < 1e-15, "{name}: {} is not {expected}", y.derivative);
        }
    }

    #[test]
    fn the_value_is_that_of_plain_numbers() {
        fn formula<T: Real>(x: T) -> T {
            let (sin, cos) = (x * 3.0).sin_cos();
            let mut y = (sin / (x + 2.0) - cos * x).sqrt().atan2(x);
            y += x;
            y -= T::ONE;
            y *= x;
            y /= x + 1.0;
            y.min(x).max(-x)
        }
        for x in [0.3, 0.9, 1.4] {
            assert_eq!(formula(Dual::variable(x)).value, formula(x));
        }
    }

    #[test]
    fn a_nan_stays_one() {
        let nan = Dual::from(f64::NAN);
        assert!(nan.min(Dual::ONE).value.is_nan() && Dual::ONE.max(nan).value.is_nan());
        assert!(!nan.is_finite() && !Dual { value: 1.0, derivative: f64::INFINITY }.is_finite());
        assert!(Dual::ONE.is_finite());
    }
}
