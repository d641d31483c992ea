//! A number together with numbers near it.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::Real;
use crate::operator::operator;

/// A number and `N` − 1 others that started near it: their differences, divided by the initial ones,
/// approximate its derivatives in less time than [`Duals`] take for the exact ones.
///
/// The number itself is the first lane and has the same bits as on its own. All comparisons use it, so that
/// the others take the same branches and, in an integrator, the same step lengths. Their differences
/// therefore have none of the jumps that separate runs would have.
///
/// ```
/// use real::{Bundle, Real};
///
/// let x = Bundle { lanes: [3.0, 3.0 + 1e-6] };
/// let y = x * x + x.sqrt();
/// assert!(((y.lanes[1] - y.lanes[0]) / 1e-6 - (2.0 * 3.0 + 0.5 / 3_f64.sqrt())).abs() < 1e-5);
/// ```
///
/// [`Duals`]: crate::Duals
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bundle<const N: usize> {
    /// The number itself, then those near it.
    pub lanes: [f64; N],
}

impl<const N: usize> Bundle<N> {
    #[inline(always)]
    fn with(lane: impl Fn(usize) -> f64) -> Self {
        let mut lanes = [0.0; N];
        let mut i = 0;
        while i < N {
            lanes[i] = lane(i);
            i += 1;
        }
        Self { lanes }
    }
}

impl<const N: usize> PartialOrd for Bundle<N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value().partial_cmp(&other.value())
    }
}

impl<const N: usize> From<f64> for Bundle<N> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self { lanes: [value; N] }
    }
}

impl<const N: usize> Neg for Bundle<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::with(|i| -self.lanes[i])
    }
}

operator!(Bundle: Add add AddAssign add_assign |x, y|
    Self::with(|i| x.lanes[i] + y.lanes[i]), Self::with(|i| x.lanes[i] + y));
operator!(Bundle: Sub sub SubAssign sub_assign |x, y|
    Self::with(|i| x.lanes[i] - y.lanes[i]), Self::with(|i| x.lanes[i] - y));
operator!(Bundle: Mul mul MulAssign mul_assign |x, y|
    Self::with(|i| x.lanes[i] * y.lanes[i]), Self::with(|i| x.lanes[i] * y));
operator!(Bundle: Div div DivAssign div_assign |x, y|
    Self::with(|i| x.lanes[i] / y.lanes[i]), Self::with(|i| x.lanes[i] / y));

impl<const N: usize> Real for Bundle<N> {
    const ZERO: Self = Self { lanes: [0.0; N] };
    const ONE: Self = Self { lanes: [1.0; N] };

    /// The first lane; NaN if there is none.
    #[inline(always)]
    fn value(self) -> f64 {
        self.lanes.first().copied().unwrap_or(f64::NAN)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::with(|i| Real::sqrt(self.lanes[i]))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sin, mut cos) = (self, self);
        let mut i = 0;
        while i < N {
            (sin.lanes[i], cos.lanes[i]) = Real::sin_cos(self.lanes[i]);
            i += 1;
        }
        (sin, cos)
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        Self::with(|i| Real::atan2(self.lanes[i], x.lanes[i]))
    }

    #[inline(always)]
    fn power(self, exponent: f64) -> Self {
        Self::with(|i| self.lanes[i].power(exponent))
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        self.lanes.iter().all(|lane| lane.is_finite())
    }

    #[inline(always)]
    fn is_constant_zero(self) -> bool {
        self.lanes.iter().all(|&lane| lane == 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Bundle;
    use crate::duals::tests::formula;
    use crate::{Duals, Real};

    /// Each lane has the bits of a separate run, and their differences give the derivatives.
    #[test]
    fn differences_are_derivatives() {
        let apart = 1e-7;
        for (x, y) in [(0.3, 0.8), (0.9, 1.7), (1.4, 0.1)] {
            let z = formula(Bundle { lanes: [x, x + apart, x] }, Bundle { lanes: [y, y, y + apart] });
            assert_eq!(z.lanes, [formula(x, y), formula(x + apart, y), formula(x, y + apart)]);
            let exact = formula(Duals::<2>::variable(x, 0), Duals::variable(y, 1));
            for (lane, derivative) in z.lanes[1..].iter().zip(exact.derivatives) {
                assert!(((lane - z.value()) / apart - derivative).abs() < 1e-5, "{lane} {derivative}");
            }
        }
    }

    /// The other lanes follow the branches of the first, whatever their own values.
    #[test]
    fn comparisons_are_those_of_the_first() {
        let (a, b) = (Bundle { lanes: [-1.0, 5.0] }, Bundle { lanes: [2.0, 3.0] });
        assert_eq!((a.min(b), a.max(b)), (a, b));
        assert_eq!(a.abs().lanes, [1.0, -5.0]);
        assert!(a < b);
    }

    #[test]
    fn a_nan_stays_one() {
        let nan = Bundle::<2>::from(f64::NAN);
        let one = Bundle::ONE;
        assert!(nan.min(one).value().is_nan() && one.max(nan).value().is_nan());
        assert!(!nan.is_finite() && !Bundle { lanes: [1.0, f64::INFINITY] }.is_finite());
        assert!(one.is_finite() && Bundle::<2>::ZERO.is_constant_zero());
        assert!(!Bundle { lanes: [0.0, 1.0] }.is_constant_zero());
    }
}
