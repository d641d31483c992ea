//! The speed in closed form, for laws under which W_n is quadratic in it.

use pim_core::{ImpactError, Law, LawImpulse, Outcome, Real, Tangential};

use crate::answer::{Found, Reconciliation, Search, SolutionMethod, Wanted, is_too_fast};
use crate::error::ReconcileError;
use crate::posed::Posed;
use crate::problem::Problem;

/// Two roots within this relative distance are the same root at the border of two laws if one of them belongs
/// to a law that does not act there.
const SAME: f64 = 1e-6;

/// A law that does not act at its own root has a border there if the law that does act misses the value
/// sought by at most this fraction, which is rounding.
const AT_BORDER: f64 = 1e-12;

/// Roots within this relative distance are the same root. Rounding decides whether a quadratic has two roots
/// that close, and moves a root that two laws share at their border by less.
const APART: f64 = 1e-9;

impl<T: Real> Problem<T> {
    /// The answer in closed form, or `None` if W_n is not quadratic in the speed, not even piecewise: a
    /// fraction of μ_c makes it cubic, and a varying restitution changes the value sought.
    ///
    /// # Errors
    /// [`ReconcileError`].
    #[must_use]
    pub fn closed_form(&self) -> Option<Result<Reconciliation<T>, ReconcileError>> {
        self.has_closed_form().then(|| {
            let found = self.posed()?.closed_form(Wanted::All)?;
            Ok(found.reconciling(self, |()| SolutionMethod::ClosedForm))
        })
    }

    /// W_n as a quadratic in the approach speed under the law that [acts](Reconciliation::acting), from which
    /// the closed form is solved; `None` for a law with a limit or a fraction of μ_c.
    #[must_use]
    pub fn quadratic(&self, acting: &Law<T>) -> Option<Quadratic<T>> {
        acting.is_affine().then(|| Posed { problem: self, line: self.line() }.quadratic(acting))
    }

    /// Impulse and sliding as functions of the approach speed, which a share of the tangential work adds to
    /// the [`quadratic`](Self::quadratic); `None` for the same laws.
    #[must_use]
    pub fn affine_impact(&self, acting: &Law<T>) -> Option<AffineImpact<T>> {
        acting.is_affine().then(|| Posed { problem: self, line: self.line() }.affine_impact(acting))
    }

    /// Like [`solve`](Problem::solve), but returns flags in place of an error, so that loops over many
    /// samples vectorise: the speed with the slowest approach from a closed form or a cubic with one root,
    /// its impact, whether a collision can have it, and whether `solve` certainly has no answer, because the
    /// law takes a fraction of the critical ratio and no push has that ratio at the only speed that gives the
    /// crush energy. If the first flag is set, the answer has the same bits. If neither is, `solve` may still
    /// find an answer: by a search, at a faster approach, or if rounding decides whether friction suffices.
    #[inline(always)]
    #[must_use]
    pub fn solve_with_verdict(&self) -> (T, Outcome<T>, [bool; 2]) {
        let posed = Posed { problem: self, line: self.line() };
        let x = posed.slowest_approach();
        let (speed, outcome, is_answer) = posed.answer_at(x);
        let is_considered =
            self.makes_sense(posed.line.slope) & is_root(x) & !is_too_fast(speed) & !self.has_closed_form();
        let pulls = (outcome.approach.normal < T::ZERO)
            & outcome.approach.normal.is_finite()
            & outcome.energy.before.is_finite()
            & outcome.critical_impulse_ratio.is_none();
        (speed, outcome, [is_answer, is_considered & pulls])
    }

    /// Whether W_n is quadratic in the speed, at all speeds or piecewise.
    #[inline(always)]
    pub(crate) fn has_closed_form(&self) -> bool {
        let law = self.law.nominal();
        self.law.curve().is_none() & (law.is_affine() | law.friction_limit().is_some())
    }
}

impl<T: Real> Posed<'_, T> {
    /// The speed that gives an approach speed, its impact, and whether it can be the answer.
    #[inline(always)]
    pub(crate) fn answer_at(self, x: T) -> (T, Outcome<T>, bool) {
        let Self { problem, line } = self;
        let speed = line.speed(x);
        let (outcome, possible) =
            problem.contact.impact_with_validity(problem.motions_at(speed), &problem.law.nominal());
        let is_answer = problem.makes_sense(line.slope) & possible & is_root(x) & !is_too_fast(speed);
        (speed, outcome, is_answer)
    }

    /// The answer under a law that has a closed form.
    #[inline(always)]
    pub(crate) fn closed_form(self, wanted: Wanted) -> Result<Found<T, ()>, ReconcileError> {
        let law = self.problem.law.nominal();
        match law.friction_limit() {
            None => self.judged(self.quadratic(&law).roots().into_iter().filter(|x| is_root(*x)), wanted),
            Some(limit) => self.judged(self.approaches_under(&law, limit).into_iter(), wanted),
        }
    }

    /// Selects the answer among approach speeds.
    #[inline(always)]
    fn judged(
        self,
        approaches: impl Iterator<Item = T>,
        wanted: Wanted,
    ) -> Result<Found<T, ()>, ReconcileError> {
        let Self { problem, line } = self;
        let mut search = Search::new(problem, wanted);
        let mut has_root = false;
        for x in approaches {
            has_root = true;
            search.consider(line.speed(x), ());
            if search.is_done() {
                break;
            }
        }
        // A jam leaves no root at all: report the jam rather than that no root was found.
        let law = problem.law.nominal();
        if !has_root
            && let Tangential::Ratio(_) = law.tangential()
            && let Err(jam @ ImpactError::Jam { .. }) =
                problem.contact.impact(problem.motions_at(line.speed(T::ONE)), &law)
        {
            return Err(jam.into());
        }
        search.finish()
    }

    /// The approach speeds at which W_n has the value sought, under a law that has a closed form.
    pub(crate) fn approaches(self) -> Approaches<T> {
        let law = self.problem.law.nominal();
        match law.friction_limit() {
            None => Approaches::of(self.quadratic(&law).roots()),
            Some(limit) => self.approaches_under(&law, limit),
        }
    }

    /// The approach speeds at which W_n has the value sought, under a friction limit.
    fn approaches_under(self, law: &Law<T>, limit: T) -> Approaches<T> {
        let mut approaches = Approaches::none();
        let mut at_borders = Approaches::none();
        for acting in branches(law, limit) {
            for (x, [acts, is_at_border]) in self.roots_under(law, &acting) {
                if !is_root(x) {
                    continue;
                }
                if acts {
                    approaches.insert(x, APART);
                } else if is_at_border {
                    at_borders.insert(x, SAME);
                }
            }
        }
        for x in at_borders {
            approaches.insert(x, SAME);
        }
        approaches
    }

    /// Both solutions of the quadratic of one of the [`branches`], each with whether the branch
    /// [acts](Self::acts) there. Inlined six times with derivatives, it would take the compiler a minute.
    #[inline(never)]
    fn roots_under(self, law: &Law<T>, acting: &Law<T>) -> [(T, [bool; 2]); 2] {
        self.quadratic(acting).roots().map(|x| (x, self.acts(law, acting, x)))
    }

    /// The slowest of the approach speeds, or the only root of a cubic. The result is [no root](is_root)
    /// under any other law, if there is none, or if rounding decides which law acts.
    #[inline(always)]
    fn slowest_approach(self) -> T {
        if !self.problem.has_closed_form() {
            return self.root_of_cubic().0;
        }
        let law = self.problem.law.nominal();
        let Some(limit) = law.friction_limit() else {
            let [low, high] = self.quadratic(&law).roots();
            return if is_root(low) { low } else { high };
        };
        let [sticking, pushed, pulled] = branches(&law, limit);
        // A loop over the branches would keep the caller's loop from vectorising.
        let [a, b, c] = [
            self.slowest_of(&law, &sticking),
            self.slowest_of(&law, &pushed),
            self.slowest_of(&law, &pulled),
        ];
        a.min(b).min(c)
    }

    /// The slowest approach speed at which one of the [`branches`] of a law with a limit acts; infinite if
    /// there is none, zero if rounding decides.
    #[inline(always)]
    fn slowest_of(self, law: &Law<T>, acting: &Law<T>) -> T {
        let [a, b] = self.quadratic(acting).roots();
        self.where_it_acts(law, acting, a).min(self.where_it_acts(law, acting, b))
    }

    #[inline(always)]
    fn where_it_acts(self, law: &Law<T>, acting: &Law<T>, x: T) -> T {
        let [acts, is_at_border] = self.acts(law, acting, x);
        let speed = if is_root(x) & acts { x } else { T::from(f64::INFINITY) };
        if is_root(x) & is_at_border { T::ZERO } else { speed }
    }

    /// Whether one of the [`branches`] of a law with a limit acts at its root x, and whether only rounding
    /// keeps it from acting.
    #[inline(always)]
    fn acts(self, law: &Law<T>, acting: &Law<T>, x: T) -> [bool; 2] {
        let (own, other) = (self.impulse_at(law, x), self.impulse_at(acting, x));
        let acts = own.linear == other.linear;
        let sought = self.problem.sought(law);
        let missing = self.problem.crush_work_at(law, self.line.at(x)) - sought;
        [acts, !acts & (missing.abs() <= sought * AT_BORDER)]
    }

    #[inline(always)]
    fn quadratic(self, law: &Law<T>) -> Quadratic<T> {
        let problem = self.problem;
        // P_n(x) = α_n x + β_n
        let beta = self.impulse_at(law, T::ZERO).linear.normal;
        let alpha = self.impulse_at(law, T::ONE).linear.normal - beta;
        // c = 2 W_n/(1−e)
        let c = problem.sought(law) * 2.0 / (T::ONE - law.restitution());
        if problem.tangential_share.is_constant_zero() {
            return Quadratic { alpha, beta, c };
        }
        let AffineImpact { tangential: [b_t, a_t], sliding: [zeta, eta], .. } = self.affine_impact(law);
        // 2 λ W_t/(1−e) = −λ/(1−e) (α_t x + β_t)(η x + ζ)
        let share = -(problem.tangential_share / (T::ONE - law.restitution()));
        Quadratic {
            alpha: alpha + share * (a_t * eta),
            beta: beta + share * (b_t * eta + a_t * zeta),
            c: c - share * (b_t * zeta),
        }
    }

    #[inline(always)]
    fn affine_impact(self, law: &Law<T>) -> AffineImpact<T> {
        let (touch, one) = (self.impulse_at(law, T::ZERO), self.impulse_at(law, T::ONE));
        let (p, p_one) = (touch.linear, one.linear);
        let (sliding, sliding_one) = (self.sliding_at(touch, T::ZERO), self.sliding_at(one, T::ONE));
        AffineImpact {
            normal: [p.normal, p_one.normal - p.normal],
            tangential: [p.tangential, p_one.tangential - p.tangential],
            sliding: [sliding, sliding_one - sliding],
        }
    }

    // Methods, because a closure may not be inlined, and a loop with a call does not vectorise.

    #[inline(always)]
    pub(crate) fn impulse_at(self, law: &Law<T>, x: T) -> LawImpulse<T> {
        law.impulse(&self.problem.contact.inverse_mass(), self.line.at(x))
    }

    /// (m/s) u_t + U_t
    #[inline(always)]
    pub(crate) fn sliding_at(self, impulse: LawImpulse<T>, x: T) -> T {
        self.problem.sliding(self.line.at(x), impulse)
    }
}

/// Impulse and sliding under a law without a limit, both affine in the approach speed x = −u_n: for each the
/// value at x = 0, where the vehicles just touch, and the slope.
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

/// The condition on the approach speed x = −u_n under a law for which P_n is affine in it, P_n = α x + β.
///
/// With W_n = ½ (1−e) x P_n it is α x² + β x = c. If the crush takes a share λ of the tangential work,
/// 2 λ W_t/(1−e) = −λ/(1−e) (α_t x + β_t)(η x + ζ) is added to the left side, with the numbers of an
/// [`AffineImpact`]; the coefficients below include it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quadratic<T = f64> {
    /// (kg) α = dP_n/dx.
    pub alpha: T,
    /// (N·s) β = P_n at x = 0, where the vehicles just touch.
    pub beta: T,
    /// (J) c = 2 W_n/(1−e), with the normal work sought.
    pub c: T,
}

impl<T: Real> Quadratic<T> {
    /// (m/s) the approach speeds that solve it, the lesser first; NaN if there are none, and meaningless
    /// unless positive.
    #[inline(always)]
    fn roots(&self) -> [T; 2] {
        let Self { alpha, beta, c } = *self;
        // α x² + β x − c = 0; without a tangential share c > 0, so that x > 0 means P_n > 0
        // q = −½ (β ± √…) with the sign that does not cancel; the roots are q/α and −c/q.
        let root = (beta * beta + alpha * c * 4.0).sqrt();
        let q = -(if beta < T::ZERO { beta - root } else { beta + root }) * 0.5;
        let [a, b] = [q / alpha, -(c / q)];
        if b < a { [b, a] } else { [a, b] }
    }
}

/// The laws without a limit; in any impact under a law with this friction limit, one of them acts.
#[inline(always)]
fn branches<T: Real>(law: &Law<T>, limit: T) -> [Law<T>; 3] {
    [law.without_limit(), law.with_ratio(-limit), law.with_ratio(limit)]
}

/// Approach speeds in ascending order, at most two for each law without a limit.
#[derive(Clone, Copy)]
pub(crate) struct Approaches<T> {
    speeds: [T; 6],
    count: usize,
}

impl<T: Real> Approaches<T> {
    fn none() -> Self {
        Self { speeds: [T::ZERO; 6], count: 0 }
    }

    /// The solutions of a quadratic that are roots.
    #[inline(always)]
    fn of(ascending: [T; 2]) -> Self {
        let mut approaches = Self::none();
        for x in ascending {
            if is_root(x) {
                approaches.speeds[approaches.count] = x;
                approaches.count += 1;
            }
        }
        approaches
    }

    pub(crate) fn are_several(&self) -> bool {
        self.count > 1
    }

    /// Adds one, unless there is another within the given relative distance: of the two the slower is kept.
    fn insert(&mut self, x: T, apart: f64) {
        let there = &mut self.speeds[..self.count];
        if let Some(other) = there.iter_mut().find(|other| (**other - x).abs() <= x * apart) {
            *other = other.min(x);
            return;
        }
        let place = there.partition_point(|other| *other < x);
        if self.count < self.speeds.len() {
            self.speeds[place..=self.count].rotate_right(1);
            self.speeds[place] = x;
            self.count += 1;
        }
    }
}

impl<T> IntoIterator for Approaches<T> {
    type Item = T;
    type IntoIter = core::iter::Take<core::array::IntoIter<T, 6>>;

    fn into_iter(self) -> Self::IntoIter {
        self.speeds.into_iter().take(self.count)
    }
}

/// Whether a collision can have this approach speed.
#[inline(always)]
fn is_root<T: Real>(x: T) -> bool {
    (x > T::ZERO) & x.is_finite()
}
