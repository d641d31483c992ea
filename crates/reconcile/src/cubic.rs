//! The speed under a fraction of μ_c without a moment impulse, where a cubic gives it.
//!
//! With the critical impulse c and d = k_nn c_n + f k_nt c_t, both affine in the approach speed x, P_n = c_n
//! (1+e) x/d, so that W_n = ½ (1−e) x P_n has the value sought where
//!
//! ½ (1−e²) x² c_n − W_n d = 0
//!
//! By Descartes' rule it has one positive root where its coefficients change sign once. That is the rule for
//! the vehicles' push; any other case is left to [`Posed::roots`].

use pim_core::{Law, LawImpulse, NormalTangential, Real, Tangential};

use crate::answer::{Iteration, Trail};
use crate::pieces::Root;
use crate::posed::Posed;

/// Steps of Newton's method: the first speed is a few per cent off, and each step doubles the digits. So few
/// that they are written out, with no end but the last, for loops over many samples.
const STEPS: usize = 6;

/// The last step is at most this share of the speed: the error left is its square.
const CONVERGED: f64 = 1e-10;

impl Posed<'_> {
    /// The only root, if that is known, with what is kept of the steps.
    pub(crate) fn only_root<S: Trail>(self) -> Option<Root<S>> {
        let (x, way) = self.root_of_cubic();
        if !(x > 0.0) {
            return None;
        }
        let (mut steps, mut before) = (S::none(), f64::NAN);
        for tried in way.into_iter().take_while(|tried| core::mem::replace(&mut before, *tried) != *tried) {
            steps.push(|| {
                let speed = self.line.speed(tried);
                Iteration { speed, normal_work: self.problem.normal_work(speed) }
            });
        }
        Some(Root { x, steps })
    }
}

impl<T: Real> Posed<'_, T> {
    /// The only approach speed at which W_n has the value sought, and the way there; not a number, or no
    /// positive one, where the law has no cubic, signs leave open whether it has one root alone, or Newton's
    /// method does not converge.
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
            x = x - step;
            *place = x;
        }
        let is_only = cubic.has_one_positive_root() & (f > T::ZERO);
        (if is_only & (step.abs() <= x * CONVERGED) { x } else { T::ZERO }, way)
    }

    #[inline(always)]
    fn cubic(self, law: &Law<T>, f: T) -> Cubic<T> {
        let k = self.problem.contact.inverse_mass();
        let critical = |x: T| {
            let LawImpulse { linear: c, .. } = law.without_limit().impulse(&k, self.line.at(x));
            c
        };
        let (touch, one) = (critical(T::ZERO), critical(T::ONE));
        // d = k_nn c_n + f k_nt c_t
        let jam = |c: NormalTangential<T>| k.nn * c.normal + f * k.nt * c.tangential;
        let (e, sought) = (law.restitution(), self.problem.sought(law));
        // ½ (1−e²)
        let loss = (T::ONE - e * e) * 0.5;
        let (d_0, d_1) = (jam(touch), jam(one) - jam(touch));
        let (c_0, c_1) = (touch.normal, one.normal - touch.normal);
        Cubic { push: [c_0 * loss, c_1 * loss], jam: [d_0 * sought, d_1 * sought] }
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
    /// Whether the coefficients that are not zero change sign once (Descartes).
    #[inline(always)]
    fn has_one_positive_root(&self) -> bool {
        let [p_0, p_1] = self.push;
        let [j_0, j_1] = self.jam;
        // One that is zero has the sign of the one before it.
        let after = |before: bool, c: T| (c > T::ZERO) | ((c == T::ZERO) & before);
        let third = p_1 > T::ZERO;
        let second = after(third, p_0);
        let first = after(second, -j_1);
        let constant = after(first, -j_0);
        let changes = [third != second, second != first, first != constant];
        let [a, b, c] = changes;
        (p_1 != T::ZERO) & (a | b | c) & !(a & b) & !(a & c) & !(b & c)
    }

    /// The root if d/c_n were the same at all approach speeds as at this one.
    #[inline(always)]
    fn with_friction_as_at(&self, x: T) -> T {
        let [p_0, p_1] = self.push;
        let [j_0, j_1] = self.jam;
        ((j_0 + j_1 * x) / (p_0 + p_1 * x)).sqrt()
    }

    /// (m/s) how far the polynomial's tangent leads from its root: N/N′.
    #[inline(always)]
    fn newton(&self, x: T) -> T {
        let [p_0, p_1] = self.push;
        let [j_0, j_1] = self.jam;
        let value = x * x * (p_0 + p_1 * x) - (j_0 + j_1 * x);
        let slope = x * (p_0 * 2.0 + p_1 * x * 3.0) - j_1;
        value / slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial all of whose roots are real has as many positive ones as changes of sign (Descartes).
    #[test]
    fn one_positive_root_is_told_from_none_two_and_three() {
        let roots = [-7.0, -2.0, -0.5, 0.25, 1.0, 3.0, 11.0];
        let mut counts = [0; 4];
        for a in roots {
            for b in roots {
                for c in roots {
                    for leading in [2.0, -0.5] {
                        // (x − a)(x − b)(x − c), times the leading coefficient
                        let push = [-(a + b + c) * leading, leading];
                        let jam = [a * b * c * leading, -(a * b + b * c + c * a) * leading];
                        let positive = [a, b, c].iter().filter(|root| **root > 0.0).count();
                        let cubic = Cubic { push, jam };
                        assert_eq!(cubic.has_one_positive_root(), positive == 1, "{a} {b} {c}");
                        counts[positive] += 1;
                    }
                }
            }
        }
        assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
    }

    #[test]
    fn a_coefficient_that_is_zero_changes_no_sign() {
        for (push, jam, has_one) in [
            ([0.0, 1.0], [0.0, 4.0], true),
            ([0.0, 1.0], [8.0, 0.0], true),
            ([0.0, 1.0], [0.0, -4.0], false),
            ([0.0, 0.0], [1.0, -4.0], false),
        ] {
            assert_eq!(Cubic { push, jam }.has_one_positive_root(), has_one, "{push:?} {jam:?}");
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
