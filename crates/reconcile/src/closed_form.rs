//! The speed in closed form, where W_n is quadratic in it.

use pim_core::{ImpactError, LawImpulse, Outcome, Real, Tangential};

use crate::answer::{Found, Reconciliation, Search, SolutionMethod, is_too_fast};
use crate::error::ReconcileError;
use crate::posed::Posed;
use crate::problem::Problem;

impl<T: Real> Problem<T> {
    /// The answer in closed form, or `None` where W_n is not quadratic in the speed: a friction limit may
    /// switch, a fraction of μ_c makes it cubic, and a restitution that varies changes what is sought.
    ///
    /// # Errors
    /// [`ReconcileError`].
    #[must_use]
    pub fn closed_form(&self) -> Option<Result<Reconciliation<T>, ReconcileError>> {
        self.has_closed_form().then(|| {
            let found = self.posed()?.closed_form()?;
            Ok(found.reconciling(self, |()| SolutionMethod::ClosedForm))
        })
    }

    /// W_n as a quadratic of the approach speed, or `None` under a law that has no closed form: what the
    /// closed form is solved from.
    #[must_use]
    pub fn quadratic(&self) -> Option<Quadratic<T>> {
        self.has_closed_form().then(|| Posed { problem: self, line: self.line() }.quadratic())
    }

    /// Impulse and sliding over the approach speed, or `None` under a law that has no closed form: what a
    /// share of the tangential work adds to that quadratic.
    #[must_use]
    pub fn affine_impact(&self) -> Option<AffineImpact<T>> {
        self.has_closed_form().then(|| Posed { problem: self, line: self.line() }.affine_impact())
    }

    /// Like [`solve`](Problem::solve), but in place of an error it returns a validity flag, so that loops
    /// over many samples vectorise: the speed with the slowest approach that the closed form gives, its
    /// impact, and whether a collision can be so. Where the flag is set, the answer has the same bits. It is
    /// not set wherever `solve` may still find one: under a law that has no closed form, or at a faster
    /// approach.
    #[inline(always)]
    #[must_use]
    pub fn solve_with_validity(&self) -> (T, Outcome<T>, bool) {
        let posed = Posed { problem: self, line: self.line() };
        let x = posed.approaches().slowest();
        let speed = posed.line.speed(x);
        let (outcome, possible) =
            self.contact.impact_with_validity(self.motions_at(speed), &self.law.nominal());
        let is_answer = self.makes_sense(posed.line.slope)
            & possible
            & self.has_closed_form()
            & is_root(x)
            & !is_too_fast(speed);
        (speed, outcome, is_answer)
    }

    /// Whether W_n is quadratic in the speed at all speeds.
    #[inline(always)]
    pub(crate) fn has_closed_form(&self) -> bool {
        self.law.curve().is_none() & self.law.nominal().is_affine()
    }
}

impl<T: Real> Posed<'_, T> {
    /// The answer under a law that has a closed form.
    pub(crate) fn closed_form(self) -> Result<Found<T, ()>, ReconcileError> {
        let Self { problem, line } = self;
        let approaches = self.approaches();
        let mut search = Search::new(problem);
        for x in approaches.ascending() {
            search.consider(line.speed(x), ());
        }
        // A jam leaves no root at all: say so rather than that none was found.
        let law = problem.law.nominal();
        if approaches.ascending().next().is_none()
            && let Tangential::Ratio(_) = law.tangential()
            && let Err(jam @ ImpactError::Jam { .. }) =
                problem.contact.impact(problem.motions_at(line.speed(T::ONE)), &law)
        {
            return Err(jam.into());
        }
        search.finish()
    }

    /// Where W_n has the value sought, under a law without a limit.
    #[inline(always)]
    pub(crate) fn approaches(self) -> Approaches<T> {
        self.quadratic().approaches()
    }

    #[inline(always)]
    fn quadratic(self) -> Quadratic<T> {
        let Self { problem, line } = self;
        let (k, law) = (problem.contact.inverse_mass(), problem.law.nominal());
        let push = |x: T| law.impulse(&k, line.at(x)).linear.normal;
        // P_n(x) = α_n x + β_n
        let beta = push(T::ZERO);
        let alpha = push(T::ONE) - beta;
        // c = 2 W_n/(1−e)
        let c = problem.sought(&law) * 2.0 / (T::ONE - law.restitution());
        if problem.tangential_share.is_constant_zero() {
            return Quadratic { alpha, beta, c };
        }
        let AffineImpact { tangential: [b_t, a_t], sliding: [zeta, eta], .. } = self.affine_impact();
        // 2 λ W_t/(1−e) = −λ/(1−e) (α_t x + β_t)(η x + ζ)
        let share = -(problem.tangential_share / (T::ONE - law.restitution()));
        Quadratic {
            alpha: alpha + share * (a_t * eta),
            beta: beta + share * (b_t * eta + a_t * zeta),
            c: c - share * (b_t * zeta),
        }
    }

    #[inline(always)]
    fn affine_impact(self) -> AffineImpact<T> {
        let Self { problem, line } = self;
        let (k, law) = (problem.contact.inverse_mass(), problem.law.nominal());
        let at = |x: T| {
            let approach = line.at(x);
            let LawImpulse { linear, moment, .. } = law.impulse(&k, approach);
            let sliding =
                approach.velocity.tangential + k.separation(approach, linear, moment).velocity.tangential;
            [linear.normal, linear.tangential, sliding]
        };
        let (touch, one) = (at(T::ZERO), at(T::ONE));
        let [normal, tangential, sliding] = [0, 1, 2].map(|i| [touch[i], one[i] - touch[i]]);
        AffineImpact { normal, tangential, sliding }
    }
}

/// Impulse and sliding under a law without a limit, at the approach speed x = −u_n in which both are affine.
/// Of each, the value where the vehicles just touch and the growth with x.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AffineImpact<T = f64> {
    /// (N·s, kg) β_n and α_n of P_n = α_n x + β_n.
    pub normal: [T; 2],
    /// (N·s, kg) β_t and α_t of P_t = α_t x + β_t.
    pub tangential: [T; 2],
    /// (m/s, –) ζ and η of u_t + U_t = η x + ζ.
    pub sliding: [T; 2],
}

impl<T: Real> AffineImpact<T> {
    /// The same in axes of the other handedness.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        // Subtracted from zero, because −0 would be printed as "-0".
        let negated = |pair: [T; 2]| pair.map(|value| T::ZERO - value);
        Self { normal: self.normal, tangential: negated(self.tangential), sliding: negated(self.sliding) }
    }
}

/// The condition on the approach speed x = −u_n where P_n is affine in it, P_n = α x + β.
///
/// With W_n = ½ (1−e) x P_n it is α x² + β x = c. Where the crush takes a share λ of the tangential work,
/// 2 λ W_t/(1−e) = −λ/(1−e) (α_t x + β_t)(η x + ζ) is added to the left side, with the numbers of an
/// [`AffineImpact`]; the coefficients below have that in them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
        // α x² + β x − c = 0; without a tangential share c > 0, so that x > 0 means P_n > 0
        // q = −½ (β ± √…) with the sign that does not cancel; the roots are q/α and −c/q.
        let root = (beta * beta + alpha * c * 4.0).sqrt();
        let q = -(if beta < T::ZERO { beta - root } else { beta + root }) * 0.5;
        Approaches([q / alpha, -(c / q)])
    }
}

/// The approach speeds x = −u_n at which W_n has the value sought; not numbers where there are none, and of
/// no use where not positive.
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
