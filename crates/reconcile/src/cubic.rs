//! The speed under a fraction of μ_c without a moment impulse, as the root of a cubic.
//!
//! With the critical impulse c and d = k_nn c_n + f k_nt c_t, both affine in the approach speed x, P_n = c_n
//! (1+e) x/d, so that W_n = ½ (1−e) x P_n has the value sought where
//!
//! ½ (1−e²) x² c_n − W_n d = 0
//!
//! A fraction of μ_c exists only if the critical impulse is a push, c_n > 0. By Descartes' rule that range
//! has exactly one root if the coefficients about its end change sign once. This holds for nearly all
//! collisions; the others are left to [`Posed::roots`].

use pim_core::{Law, NormalTangential, Real, Tangential};

use crate::answer::{Iteration, Trail};
use crate::posed::Posed;
use crate::root::{CONVERGED, Root, STEPS};

impl Posed<'_> {
    /// The only root, if it is known to be the only one, with the recorded steps.
    pub(crate) fn only_root<S: Trail>(self) -> Option<Root<S>> {
        // Without friction there is no cubic to solve.
        if !matches!(self.problem.law.nominal().tangential(), Tangential::FractionOfCritical(f) if f > 0.0) {
            return None;
        }
        let (x, way) = self.root_of_cubic();
        if x.is_nan() || x <= 0.0 { None } else { Some(self.root_at_the_end_of(way, x)) }
    }

    /// A root with the recorded steps of Newton's method.
    pub(crate) fn root_at_the_end_of<S: Trail>(self, way: [f64; STEPS], x: f64) -> Root<S> {
        let (mut steps, mut before) = (S::none(), f64::NAN);
        for tried in way.into_iter().take_while(|tried| core::mem::replace(&mut before, *tried) != *tried) {
            steps.push(|| {
                let speed = self.line.speed(tried);
                Iteration { speed, normal_work: self.problem.normal_work(speed) }
            });
        }
        Root { x, steps }
    }
}

impl<T: Real> Posed<'_, T> {
    /// The only approach speed at which W_n has the value sought, and the steps to it; NaN or not positive if
    /// the law has no cubic, the signs do not show that the root is unique, or Newton's method does not
    /// converge.
    #[inline(always)]
    pub(crate) fn root_of_cubic(self) -> (T, [T; STEPS]) {
        let nothing = (T::ZERO, [T::ZERO; STEPS]);
        let law = self.problem.law.nominal();
        let Tangential::FractionOfCritical(f) = law.tangential() else { return nothing };
        if self.problem.law.curve().is_some()
            | law.has_moment()
            | !self.problem.tangential_share.is_constant_zero()
        {
            return nothing;
        }
        let cubic = self.cubic(&law, f);
        let mut x = cubic.with_friction_as_at(self.frictionless_approach_speed());
        let mut way = [x; STEPS];
        let mut step = x;
        for place in &mut way {
            step = cubic.newton(x);
            x -= step;
            *place = x;
        }
        let low = cubic.first_push();
        let is_only = cubic.has_one_root_above(low) & (x > low) & (f > T::ZERO);
        (if is_only & (step.abs() <= x * CONVERGED) { x } else { T::ZERO }, way)
    }

    #[inline(always)]
    fn cubic(self, law: &Law<T>, f: T) -> Cubic<T> {
        let critical = law.without_limit();
        let (touch, one) =
            (self.impulse_at(&critical, T::ZERO).linear, self.impulse_at(&critical, T::ONE).linear);
        let (e, sought) = (law.restitution(), self.problem.sought(law));
        // ½ (1−e²)
        let loss = (T::ONE - e * e) * 0.5;
        let (d_0, d_1) = (self.jam_at(touch, f), self.jam_at(one, f));
        let (c_0, c_1) = (touch.normal, one.normal);
        Cubic { push: [c_0 * loss, (c_1 - c_0) * loss], jam: [d_0 * sought, (d_1 - d_0) * sought] }
    }

    /// d = k_nn c_n + f k_nt c_t
    #[inline(always)]
    fn jam_at(self, critical: NormalTangential<T>, f: T) -> T {
        let k = self.problem.contact.inverse_mass();
        k.nn * critical.normal + f * k.nt * critical.tangential
    }
}

/// x² (p₀ + p₁ x) − (j₀ + j₁ x).
struct Cubic<T> {
    /// ½ (1−e²) c_n
    push: [T; 2],
    /// W_n d
    jam: [T; 2],
}

impl<T: Real> Cubic<T> {
    /// The approach speed above which the critical impulse is a push; zero if there is none.
    #[inline(always)]
    fn first_push(&self) -> T {
        let [p_0, p_1] = self.push;
        if (p_0 < T::ZERO) & (p_1 > T::ZERO) { -p_0 / p_1 } else { T::ZERO }
    }

    /// Whether there is exactly one root above `low`: the nonzero coefficients change sign once (Descartes).
    #[inline(always)]
    fn has_one_root_above(&self, low: T) -> bool {
        let [p_0, p_1] = self.push;
        let [j_0, j_1] = self.jam;
        // N(low + y) = (low + y)² (p + p₁ y) − (j + j₁ y)
        // If low is not zero, p is, but for rounding.
        let p = if low > T::ZERO { T::ZERO } else { p_0 };
        let j = j_0 + j_1 * low;
        let third = p_1 > T::ZERO;
        let second = sign_after(third, p + p_1 * low * 2.0);
        let first = sign_after(second, low * (p * 2.0 + p_1 * low) - j_1);
        let constant = sign_after(first, low * low * p - j);
        let (a, b, c) = (third != second, second != first, first != constant);
        (p_1 != T::ZERO) & (a | b | c) & !(a & b) & !(a & c) & !(b & c)
    }

    /// The root if d/c_n had the value at this approach speed at all others.
    #[inline(always)]
    fn with_friction_as_at(&self, x: T) -> T {
        let [p_0, p_1] = self.push;
        let [j_0, j_1] = self.jam;
        ((j_0 + j_1 * x) / (p_0 + p_1 * x)).sqrt()
    }

    /// (m/s) Newton's step N/N′ of the polynomial.
    #[inline(always)]
    fn newton(&self, x: T) -> T {
        let [p_0, p_1] = self.push;
        let [j_0, j_1] = self.jam;
        let value = x * x * (p_0 + p_1 * x) - (j_0 + j_1 * x);
        let slope = x * (p_0 * 2.0 + p_1 * x * 3.0) - j_1;
        value / slope
    }
}

/// Whether a coefficient is positive, or zero and the one before it counts as positive.
#[inline(always)]
fn sign_after<T: Real>(before: bool, c: T) -> bool {
    (c > T::ZERO) | ((c == T::ZERO) & before)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial with only real roots has as many positive ones as changes of sign (Descartes).
    #[test]
    fn one_root_above_is_told_from_none_two_and_three() {
        let roots = [-7.0, -2.0, -0.5, 0.25, 1.0, 3.0, 11.0];
        let mut counts = [0; 4];
        for a in roots {
            for b in roots {
                for c in roots {
                    // (x − a)(x − b)(x − c), twice
                    let push = [-(a + b + c) * 2.0, 2.0];
                    let jam = [a * b * c * 2.0, -(a * b + b * c + c * a) * 2.0];
                    let cubic = Cubic { push, jam };
                    let low = cubic.first_push();
                    assert_eq!(low, (0.5 * -push[0]).max(0.0));
                    let above = [a, b, c].iter().filter(|root| **root > low).count();
                    assert_eq!(cubic.has_one_root_above(low), above == 1, "{a} {b} {c}");
                    counts[above] += 1;
                    // With reversed signs the critical impulse is not a push at fast approaches.
                    let falling = Cubic { push: push.map(|c| -c), jam: jam.map(|c| -c) };
                    assert_eq!(falling.first_push(), 0.0);
                    let positive = [a, b, c].iter().filter(|root| **root > 0.0).count();
                    assert_eq!(falling.has_one_root_above(0.0), positive == 1, "{a} {b} {c}");
                }
            }
        }
        assert!(counts[0] > 20 && counts[1] > 20, "{counts:?}");
    }

    #[test]
    fn a_coefficient_that_is_zero_changes_no_sign() {
        for (push, jam, has_one) in [
            ([0.0, 1.0], [0.0, 4.0], true),
            ([0.0, 1.0], [8.0, 0.0], true),
            ([0.0, 1.0], [0.0, -4.0], false),
            ([0.0, 0.0], [1.0, -4.0], false),
        ] {
            assert_eq!(Cubic { push, jam }.has_one_root_above(0.0), has_one, "{push:?} {jam:?}");
        }
    }

    #[test]
    fn the_tangent_leads_to_the_root_of_a_line() {
        // x² (1 + 2 x) − (5 + 3 x) at x = 2: 20 − 11 = 9, and its slope 2 x + 6 x² − 3 = 25
        let cubic = Cubic { push: [1.0, 2.0], jam: [5.0, 3.0] };
        assert_eq!(cubic.newton(2.0), 9.0 / 25.0);
        // x² = (5 + 3 · 2)/(1 + 2 · 2)
        assert_eq!(cubic.with_friction_as_at(2.0), Real::sqrt(11.0_f64 / 5.0));
    }
}
