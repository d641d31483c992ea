//! A number that carries its derivatives with respect to several inputs (dual number).

use core::array;
use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::Real;
use crate::operator::operator;

/// A value and its derivatives with respect to `N` inputs: an equation over [`Real`] is differentiated
/// exactly, by the rules of calculus and not by differences.
///
/// ```
/// use real::{Duals, Real};
///
/// let [x, y] = [Duals::<2>::variable(3.0, 0), Duals::variable(4.0, 1)];
/// let length = (x * x + y * y).sqrt();
/// assert_eq!(length.derivatives, [3.0 / 5.0, 4.0 / 5.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duals<const N: usize> {
    /// The number itself.
    pub value: f64,
    /// Its derivative with respect to each input.
    pub derivatives: [f64; N],
}

impl<const N: usize> Duals<N> {
    /// The input with this `number`, counted from 0: its own derivative is 1.
    #[must_use]
    pub fn variable(value: f64, number: usize) -> Self {
        Self { value, derivatives: array::from_fn(|i| if i == number { 1.0 } else { 0.0 }) }
    }

    /// A value, with the derivative with respect to each input from a rule.
    #[inline(always)]
    fn with(value: f64, derivative: impl Fn(usize) -> f64) -> Self {
        let mut derivatives = [0.0; N];
        let mut i = 0;
        while i < N {
            derivatives[i] = derivative(i);
            i += 1;
        }
        Self { value, derivatives }
    }
}

impl<const N: usize> PartialOrd for Duals<N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<const N: usize> From<f64> for Duals<N> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self { value, derivatives: [0.0; N] }
    }
}

impl<const N: usize> Neg for Duals<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::with(-self.value, |i| -self.derivatives[i])
    }
}

operator!(Duals: Add add AddAssign add_assign |x, y|
    Self::with(x.value + y.value, |i| x.derivatives[i] + y.derivatives[i]),
    Self::with(x.value + y, |i| x.derivatives[i]));
operator!(Duals: Sub sub SubAssign sub_assign |x, y|
    Self::with(x.value - y.value, |i| x.derivatives[i] - y.derivatives[i]),
    Self::with(x.value - y, |i| x.derivatives[i]));
// (x y)′ = x′ y + x y′
operator!(
    #[expect(clippy::suspicious_arithmetic_impl, reason = "a product has two terms")]
    Duals: Mul mul MulAssign mul_assign |x, y|
    Self::with(x.value * y.value, |i| x.derivatives[i] * y.value + x.value * y.derivatives[i]),
    Self::with(x.value * y, |i| x.derivatives[i] * y));
// (x/y)′ = (x′ − (x/y) y′)/y
operator!(
    #[expect(clippy::suspicious_arithmetic_impl, reason = "a quotient has two terms")]
    Duals: Div div DivAssign div_assign |x, y|
    Self::with(x.value / y.value, |i| (x.derivatives[i] - x.value / y.value * y.derivatives[i]) / y.value),
    Self::with(x.value / y, |i| x.derivatives[i] / y));

impl<const N: usize> Real for Duals<N> {
    const ZERO: Self = Self { value: 0.0, derivatives: [0.0; N] };
    const ONE: Self = Self { value: 1.0, derivatives: [0.0; N] };

    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }

    /// The derivative of √x at x = 0 is infinite, but that of a constant zero is zero.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = Real::sqrt(self.value);
        // (√x)′ = x′/(2√x)
        Self::with(root, |i| {
            let derivative = self.derivatives[i];
            if derivative == 0.0 { 0.0 } else { derivative / (2.0 * root) }
        })
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(self.value);
        (Self::with(sin, |i| cos * self.derivatives[i]), Self::with(cos, |i| -sin * self.derivatives[i]))
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        // atan2(y, x)′ = (y′ x − y x′)/(x² + y²)
        let square = self.value * self.value + x.value * x.value;
        Self::with(Real::atan2(self.value, x.value), |i| {
            (self.derivatives[i] * x.value - self.value * x.derivatives[i]) / square
        })
    }

    #[inline(always)]
    fn power(self, exponent: f64) -> Self {
        let power = self.value.power(exponent);
        // (xᵖ)′ = p xᵖ x′/x
        Self::with(power, |i| exponent * power * self.derivatives[i] / self.value)
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.derivatives.iter().all(|derivative| derivative.is_finite())
    }

    #[inline(always)]
    fn is_constant_zero(self) -> bool {
        self.value == 0.0 && self.derivatives.iter().all(|&derivative| derivative == 0.0)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::Duals;
    use crate::Real;

    /// Each operation, on numbers that all depend on both inputs.
    pub(crate) fn formula<T: Real>(x: T, y: T) -> T {
        let (sin, cos) = (x * 3.0 - y).sin_cos();
        let mut z = (sin / (x + 2.0) - cos * y + 3.0).sqrt().atan2(x);
        z += y.power(1.5);
        z -= T::ONE - x / 2.0;
        z *= -y;
        z /= x + 1.0;
        z.min(x + 7.0).max(-x) + (z - 9.0).abs()
    }

    /// Functions with known derivatives, at x = 0.7.
    #[test]
    fn derivatives_follow_the_rules() {
        let x = Duals::<1>::variable(0.7, 0);
        let (sin, cos) = x.sin_cos();
        let constant = Duals::from(2.0);
        for (name, y, expected) in [
            ("x + x", x + x, 2.0),
            ("x − x²", x - x * x, 1.0 - 1.4),
            ("1/x", Duals::ONE / x, -1.0 / 0.49),
            ("x/2", x / constant, 0.5),
            ("x/(1 + x)", x / (x + 1.0), 1.0 / (1.7 * 1.7)),
            ("√x", x.sqrt(), 0.5 / 0.7_f64.sqrt()),
            ("√0 of a constant", Duals::ZERO.sqrt(), 0.0),
            // d/dx x^1.5 = 1.5 √x
            ("x^1.5", x.power(1.5), 1.5 * 0.7_f64.sqrt()),
            ("sin", sin, 0.764_842_187_284_488_5),
            ("cos", cos, -0.644_217_687_237_691),
            ("atan", x.atan2(Duals::ONE), 1.0 / 1.49),
            ("atan 1/x", Duals::ONE.atan2(x), -1.0 / 1.49),
            ("|−x|", (-x).abs(), 1.0),
            ("|x|", x.abs(), 1.0),
            ("min", x.min(constant), 1.0),
            ("max", x.max(constant), 0.0),
        ] {
            let [derivative] = y.derivatives;
            assert!((derivative - expected).abs() < 1e-15, "{name}: {derivative} is not {expected}");
        }
    }

    /// One number with two derivatives equals two numbers with one each, to the bit.
    #[test]
    fn each_derivative_is_the_one_alone() {
        for (x, y) in [(0.3, 0.8), (0.9, 1.7), (1.4, 0.1)] {
            let both: Duals<2> = formula(Duals::variable(x, 0), Duals::variable(y, 1));
            let by_x: Duals<1> = formula(Duals::variable(x, 0), Duals::from(y));
            let by_y: Duals<1> = formula(Duals::from(x), Duals::variable(y, 0));
            assert_eq!(both.value, formula(x, y));
            assert_eq!(both.value, by_x.value);
            assert_eq!(both.derivatives, [by_x.derivatives[0], by_y.derivatives[0]]);
        }
    }

    #[test]
    fn a_nan_stays_one() {
        let nan = Duals::<1>::from(f64::NAN);
        let one = Duals::ONE;
        assert!(nan.min(one).value.is_nan() && one.max(nan).value.is_nan());
        assert!(!nan.is_finite() && !Duals { value: 1.0, derivatives: [f64::INFINITY] }.is_finite());
        assert!(one.is_finite() && Duals::<1>::ZERO.is_constant_zero());
        assert!(!Duals::<1>::variable(0.0, 0).is_constant_zero());
        assert_eq!(Duals::<1>::ZERO.sqrt(), Duals::ZERO);
    }
}
