//! The speed in closed form, where W_n is quadratic in it.

use pim_core::{ImpactError, Outcome, Real, Tangential};

use crate::answer::{Method, Reconciliation, Search, is_too_fast};
use crate::error::ReconcileError;
use crate::problem::Problem;

impl<T: Real> Problem<'_, T> {
    /// The answer in closed form, or `None` where W_n is not quadratic in the speed: a friction limit may switch, and a fraction of μ_c makes
    /// it cubic.
    ///
    /// # Errors
    /// [`ReconcileError`].
    #[must_use]
    pub fn closed_form(&self) -> Option<Result<Reconciliation<T>, ReconcileError>> {
        if !self.has_closed_form() {
            return None;
        }
        let approaches = self.approaches();
        let mut search = Search::new(self);
        for x in approaches.ascending() {
            search.consider(self.line.speed(x), Method::ClosedForm);
        }
        // A jam leaves no root at all: say so rather than that none was found.
        if approaches.ascending().next().is_none()
            && let Tangential::Ratio(_) = self.law.tangential()
        {
            let speed = self.line.speed(T::ONE);
            if let Err(jam @ ImpactError::Jam { .. }) = self.contact.impact(self.motions(speed), &self.law) {
                return Some(Err(jam.into()));
            }
        }
        Some(search.finish())
    }

    /// The speed with the slowest approach that the closed form gives, its impact, and whether a collision can be so: [`solve`](Problem::solve) without
    /// a reason, without a second speed and without a branch, for loops over many samples. Where it says yes, the answer has the same bits. It says no
    /// wherever `solve` may still find one: under a law that has no closed form, or at a faster approach.
    #[inline(always)]
    #[must_use]
    pub fn attempt(&self) -> (T, Outcome<T>, bool) {
        let x = self.approaches().slowest();
        let speed = self.line.speed(x);
        let (outcome, possible) = self.contact.attempt(self.motions(speed), &self.law);
        (speed, outcome, possible & self.has_closed_form() & is_root(x) & !is_too_fast(speed))
    }

    /// Whether W_n is quadratic in the speed at all speeds.
    #[inline(always)]
    pub(crate) fn has_closed_form(&self) -> bool {
        self.restitution.is_none() & self.law.is_affine()
    }

    /// Where W_n has the value sought, under a law without a limit.
    #[inline(always)]
    pub(crate) fn approaches(&self) -> Approaches<T> {
        self.unlimited().approaches()
    }

    /// W_n as a quadratic of the approach speed, or `None` under a law that has no closed form: what the closed form is solved from.
    #[must_use]
    pub fn quadratic(&self) -> Option<Quadratic<T>> {
        self.has_closed_form().then(|| self.unlimited())
    }

    /// The same under a law that is known to have one.
    #[inline(always)]
    fn unlimited(&self) -> Quadratic<T> {
        let k = self.contact.inverse_mass();
        let push = |x: T| self.law.impulse(&k, self.line.at(x)).linear.normal;
        // P_n(x) = α x + β
        let beta = push(T::ZERO);
        let alpha = push(T::ONE) - beta;
        // c = 2 W_n/(1−e)
        let c = self.sought(&self.law) * 2.0 / (T::ONE - self.law.restitution());
        Quadratic { alpha, beta, c }
    }
}

/// The condition on the approach speed x = −u_n where P_n is affine in it: with W_n = ½ (1−e) x P_n and P_n = α x + β it is α x² + β x = c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadratic<T = f64> {
    /// (kg) α = dP_n/dx.
    pub alpha: T,
    /// (N·s) β = P_n where the vehicles just touch, x = 0.
    pub beta: T,
    /// (J) c = 2 W_n/(1−e), with the normal work sought.
    pub c: T,
}

impl<T: Real> Quadratic<T> {
    #[inline(always)]
    fn approaches(&self) -> Approaches<T> {
        let Self { alpha, beta, c } = *self;
        // α x² + β x − c = 0; since c > 0, x > 0 means P_n > 0
        // q = −½ (β ± √…) with the sign that does not cancel; the roots are q/α and −c/q.
        let root = (beta * beta + alpha * c * 4.0).sqrt();
        let q = -(if beta < T::ZERO { beta - root } else { beta + root }) * 0.5;
        Approaches([q / alpha, -(c / q)])
    }
}

/// The approach speeds x = −u_n at which W_n has the value sought; not numbers where there are none, and of no use where not positive.
#[derive(Clone, Copy)]
pub(crate) struct Approaches<T>([T; 2]);

impl<T: Real> Approaches<T> {
    /// Those that are positive, the least first.
    pub(crate) fn ascending(self) -> impl Iterator<Item = T> {
        self.ordered().into_iter().filter(|x| is_root(*x))
    }

    /// The first of these, or something else where there is none.
    #[inline(always)]
    fn slowest(&self) -> T {
        let [a, b] = self.ordered();
        if is_root(a) { a } else { b }
    }

    #[inline(always)]
    fn ordered(&self) -> [T; 2] {
        let [a, b] = self.0;
        if b < a { [b, a] } else { [a, b] }
    }
}

/// Whether this is the approach speed of a collision.
#[inline(always)]
fn is_root<T: Real>(x: T) -> bool {
    (x > T::ZERO) & x.is_finite()
}
