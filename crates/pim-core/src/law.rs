//! Impact laws: each is one normal and one tangential condition on the impulse, with an optional third on the
//! yaw rates.

use real::Real;

use crate::check;
use crate::contact::{Approach, InverseMass, NormalTangential};
use crate::error::{ImpactError, InvalidInput};

/// The tangential condition of an impact law.
///
/// Code that depends on the variant matches without a catch-all arm, so that a new one must be decided there
/// before it compiles; adding one is a breaking change.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Tangential<T = f64> {
    /// U_t = 0: a common tangential velocity at C after impact, μ = μ_c.
    Critical,
    /// P_t = μ P_n with μ given.
    Ratio(T),
    /// P_t = f μ_c P_n with 0 ≤ f ≤ 1; f = 0 is frictionless, whether or not a push gives μ_c.
    FractionOfCritical(T),
    /// Coulomb friction: U_t = 0 if friction of at most this coefficient (≥ 0) can hold the surfaces
    /// together, else they keep sliding and |P_t| is at the limit.
    ///
    /// The impulse is continuous in limit and velocities: at the border both regimes have the same ratio
    /// P_t/P_n, for which the normal condition has one answer. A moment impulse makes it jump unless e_m = 0:
    /// see [`with_moment_restitution`](Law::with_moment_restitution).
    Friction(T),
    /// U_t − u_t given (m/s).
    VelocityChange(T),
    /// U_t = −e_t u_t with −1 ≤ e_t ≤ 1.
    Restitution(T),
    /// U_t = −e u_t with the normal coefficient e, if friction of at most this coefficient (≥ 0) can achieve
    /// that; else the surfaces slide as under [`Friction`](Self::Friction).
    ///
    /// The impulse jumps if the normal impulse alone reverses the sliding, to less than e |u_t|: full
    /// reversal then needs a P_t of one sign, and friction against the sliding has the other. It jumps at the
    /// border of the two regimes, and between two directions of sliding. With e = 0 it is continuous.
    /// [`Law::borders`] finds the jumps.
    FullOrSliding(T),
}

/// Whether an impact law with a friction limit reached the limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Regime {
    /// Friction sufficed for the law's condition on U_t.
    Full,
    /// The surfaces slide until separation, |P_t| = μ P_n.
    Sliding,
}

/// An impact law: U_n = −e u_n, one [`Tangential`] condition and, optionally, a moment impulse.
///
/// | law | constructor | normal | tangential | when | assumes about the tangential direction |
/// |---|---|---|---|---|---|
/// | Brach | [`Law::new`] with [`Critical`](Tangential::Critical) | U_n = −e u_n | U_t = 0 | most collisions that are not sideswipes | the surfaces interlock and end with a common velocity |
/// | | [`Ratio`](Tangential::Ratio) | | P_t = μ P_n | μ is known, or is to be varied | nothing: sign and size are the analyst's choice |
/// | | [`FractionOfCritical`](Tangential::FractionOfCritical) | | P_t = f μ_c P_n | between frictionless and interlocked | the same share of the interlocking impulse at every speed |
/// | | [`Friction`](Tangential::Friction) | | U_t = 0, or \|P_t\| = μ P_n | sideswipes, barriers | Coulomb friction against the sliding |
/// | Woolley | [`Law::woolley`] | U_n = 0 | U_t = 0 | heavy engagement | as Brach with e = 0 and μ_c |
/// | Woolley, sideswipe | [`Law::woolley_sideswipe`] | U_n = 0 | U_t − u_t given | sideswipes with a change of speed known from the scrape | the change is known and does not depend on the speeds |
/// | Ishikawa | [`Law::ishikawa`] | U_n = −e_n u_n | U_t = −e_t u_t | coefficients fitted to tests | rebound along the surface in proportion to the sliding |
/// | Kudlich–Slibar | [`Law::kudlich_slibar`] | U_n = −ε u_n | U_t = −ε u_t, or \|P_t\| = μ P_n | general purpose, as simulation programs use it | one coefficient for both directions while friction suffices |
///
/// # References
/// Brach & Brach, SAE 980025, "Summary of planar impact mechanics", which names the others: Woolley (SAE
/// 870046 and 1987), Ishikawa (1985, 1994), Steffan & Moser (1996, after Kudlich and Slibar). The moment
/// impulse: Brach, *Mechanical Impact Dynamics* (1991).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law<T = f64> {
    pub(crate) restitution: T,
    pub(crate) tangential: Tangential<T>,
    pub(crate) moment_restitution: T,
}

impl<T: Real> Law<T> {
    /// The law with coefficient of restitution e and the given tangential condition: Brach's, for the first
    /// four conditions.
    ///
    /// # Errors
    /// If e or a fraction lies outside [0, 1], a tangential restitution outside [−1, 1], a friction limit
    /// is negative, or a number is not finite.
    #[inline(always)]
    pub fn new(restitution: T, tangential: Tangential<T>) -> Result<Self, InvalidInput> {
        let law = Self { restitution, tangential, moment_restitution: -T::ONE };
        law.check()?;
        Ok(law)
    }

    /// Like [`new`](Self::new), but returns a validity flag in place of an error, so that loops over many
    /// samples vectorise.
    #[inline(always)]
    #[must_use]
    pub fn new_with_validity(restitution: T, tangential: Tangential<T>) -> (Self, bool) {
        let law = Self { restitution, tangential, moment_restitution: -T::ONE };
        (law, law.check().is_ok())
    }

    #[inline(always)]
    fn check(&self) -> Result<(), InvalidInput> {
        check::within("coefficient of restitution", self.restitution.value(), 0.0, 1.0)?;
        match self.tangential {
            Tangential::Critical => Ok(()),
            Tangential::Ratio(mu) => check::finite("impulse ratio", mu.value()),
            Tangential::FractionOfCritical(f) => {
                check::within("fraction of the critical impulse ratio", f.value(), 0.0, 1.0)
            }
            Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => {
                check::at_least("friction limit", limit.value(), 0.0)
            }
            Tangential::VelocityChange(change) => check::finite("tangential velocity change", change.value()),
            Tangential::Restitution(e_t) => {
                check::within("tangential coefficient of restitution", e_t.value(), -1.0, 1.0)
            }
        }
    }

    /// Woolley: a common velocity at C after impact.
    #[must_use]
    pub fn woolley() -> Self {
        Self { restitution: T::ZERO, tangential: Tangential::Critical, moment_restitution: -T::ONE }
    }

    /// Woolley for sideswipes: a common normal velocity, and a given change U_t − u_t (m/s) of the tangential
    /// one.
    ///
    /// # Errors
    /// If the change is not finite.
    pub fn woolley_sideswipe(tangential_velocity_change: T) -> Result<Self, InvalidInput> {
        Self::new(T::ZERO, Tangential::VelocityChange(tangential_velocity_change))
    }

    /// Ishikawa: a coefficient of restitution in each direction.
    ///
    /// # Errors
    /// If e_n lies outside [0, 1] or e_t outside [−1, 1].
    pub fn ishikawa(restitution: T, tangential_restitution: T) -> Result<Self, InvalidInput> {
        Self::new(restitution, Tangential::Restitution(tangential_restitution))
    }

    /// Kudlich–Slibar, as Steffan & Moser use it: one coefficient of restitution for both directions if the
    /// friction limit allows it.
    ///
    /// # Errors
    /// If ε lies outside [0, 1] or the friction limit is negative.
    pub fn kudlich_slibar(restitution: T, friction: T) -> Result<Self, InvalidInput> {
        Self::new(restitution, Tangential::FullOrSliding(friction))
    }

    /// The same law with a moment impulse M = (1 + e_m) M_c at C, where M_c is the one that gives a common
    /// yaw rate: e_m = −1 means no moment impulse, e_m = 0 a common yaw rate.
    ///
    /// Under a friction limit M, and with it P and the motion after impact, jumps where sticking turns into
    /// sliding. M_c is computed under the condition of each regime, U_t = 0 or P_t = ±μ P_n. At the border
    /// the two conditions agree for the acting moment M, but not for the whole M_c. They agree for both only
    /// if M = M_c (e_m = 0) or M = 0 (e_m = −1). Theory, section 3, gives the size of the jump;
    /// [`Law::borders`] finds its place.
    ///
    /// # Errors
    /// If e_m lies outside [−1, 1].
    pub fn with_moment_restitution(self, moment_restitution: T) -> Result<Self, InvalidInput> {
        check::within("moment coefficient of restitution", moment_restitution.value(), -1.0, 1.0)?;
        Ok(Self { moment_restitution, ..self })
    }

    /// The same law with another coefficient of restitution, which the caller has checked.
    #[inline(always)]
    #[must_use]
    pub fn restituting(self, restitution: T) -> Self {
        Self { restitution, ..self }
    }

    /// The coefficient of restitution e.
    #[inline(always)]
    #[must_use]
    pub fn restitution(&self) -> T {
        self.restitution
    }

    /// The tangential condition.
    #[inline(always)]
    #[must_use]
    pub fn tangential(&self) -> Tangential<T> {
        self.tangential
    }

    /// The moment coefficient of restitution e_m; −1 if there is no moment impulse.
    #[inline(always)]
    #[must_use]
    pub fn moment_restitution(&self) -> T {
        self.moment_restitution
    }

    /// Whether the law has a moment impulse: e_m > −1.
    #[inline(always)]
    #[must_use]
    pub fn has_moment(&self) -> bool {
        self.moment_restitution != -T::ONE
    }

    /// Whether the impulse is affine in the velocities before impact: its conditions are linear, and no limit
    /// switches them.
    #[inline(always)]
    #[must_use]
    pub fn is_affine(&self) -> bool {
        match self.tangential {
            Tangential::Critical
            | Tangential::Ratio(_)
            | Tangential::VelocityChange(_)
            | Tangential::Restitution(_) => true,
            Tangential::FractionOfCritical(_) | Tangential::Friction(_) | Tangential::FullOrSliding(_) => {
                false
            }
        }
    }

    /// The law with the same coefficients of restitution but no friction limit, so that its tangential
    /// condition is always met; for a fraction of μ_c, the law that gives μ_c.
    #[inline(always)]
    #[must_use]
    pub fn without_limit(&self) -> Self {
        let tangential = match self.tangential {
            Tangential::Friction(_) | Tangential::FractionOfCritical(_) => Tangential::Critical,
            Tangential::FullOrSliding(_) => Tangential::Restitution(self.restitution),
            unlimited => unlimited,
        };
        Self { tangential, ..*self }
    }

    /// (–) μ of a law with a friction limit.
    #[inline(always)]
    #[must_use]
    pub fn friction_limit(&self) -> Option<T> {
        match self.tangential {
            Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => Some(limit),
            Tangential::Critical
            | Tangential::Ratio(_)
            | Tangential::FractionOfCritical(_)
            | Tangential::VelocityChange(_)
            | Tangential::Restitution(_) => None,
        }
    }

    /// The law that acts in an impact of this regime and impulse ratio. For a law with a friction limit, that
    /// is the one [without a limit](Self::without_limit) if friction sufficed, else the one with the
    /// [ratio](Self::with_ratio) of the sliding surfaces. For any other law it is the law itself.
    #[must_use]
    pub fn acting(&self, regime: Option<Regime>, impulse_ratio: T) -> Self {
        match (self.friction_limit(), regime) {
            (Some(_), Some(Regime::Full)) => self.without_limit(),
            (Some(limit), Some(Regime::Sliding)) => {
                self.with_ratio(if impulse_ratio < T::ZERO { -limit } else { limit })
            }
            (_, None) | (None, Some(_)) => *self,
        }
    }

    /// The law with the same coefficients of restitution and the impulse ratio μ.
    #[inline(always)]
    #[must_use]
    pub fn with_ratio(&self, mu: T) -> Self {
        Self { tangential: Tangential::Ratio(mu), ..*self }
    }

    /// The impulse on vehicle 1 that satisfies the conditions, whether or not a collision can have it:
    /// [`Contact::impact`](crate::Contact::impact) checks that. A search for a speed needs the impulse on
    /// both sides of that border.
    #[inline(always)]
    #[must_use]
    pub fn impulse(&self, k: &InverseMass<T>, approach: Approach<T>) -> LawImpulse<T> {
        self.solve(k, approach).impulse
    }

    #[inline(always)]
    pub(crate) fn solve(&self, k: &InverseMass<T>, approach: Approach<T>) -> Solution<T> {
        let conditions = self.conditions(k, approach);
        let u_t = approach.velocity.tangential;
        let (impulse, critical) = match self.tangential {
            Tangential::Critical => {
                let impulse = conditions.with_change(-u_t);
                (impulse, impulse.linear)
            }
            Tangential::Ratio(mu) => (conditions.with_ratio(mu), conditions.critical_direction()),
            Tangential::FractionOfCritical(f) => {
                let critical = conditions.with_change(-u_t).linear;
                // A fraction of 0 means no friction, even if no push gives μ_c.
                let ratio = if self.needs_critical() | (critical.normal > T::ZERO) {
                    f * critical.tangential / critical.normal
                } else {
                    T::ZERO
                };
                (conditions.with_ratio(ratio), critical)
            }
            Tangential::Friction(limit) => {
                let full = conditions.with_change(-u_t);
                (conditions.limited(full, limit), full.linear)
            }
            Tangential::VelocityChange(change) => {
                (conditions.with_change(change), conditions.critical_direction())
            }
            Tangential::Restitution(e_t) => {
                (conditions.with_change(-((e_t + 1.0) * u_t)), conditions.critical_direction())
            }
            Tangential::FullOrSliding(limit) => {
                let full = conditions.with_change(-((self.restitution + 1.0) * u_t));
                (conditions.limited(full, limit), conditions.critical_direction())
            }
        };
        Solution { impulse, critical }
    }

    #[inline(always)]
    pub(crate) fn conditions<'a>(&self, k: &'a InverseMass<T>, approach: Approach<T>) -> Conditions<'a, T> {
        Conditions { k, approach, restitution: self.restitution, moment: self.moment_restitution }
    }

    /// Whether the impulse of the law is a push. A fraction of μ_c also needs a push that gives μ_c.
    #[inline(always)]
    pub(crate) fn pushes(&self, solution: &Solution<T>) -> bool {
        (solution.impulse.linear.normal > T::ZERO)
            & ((solution.critical.normal > T::ZERO) | !self.needs_critical())
    }

    /// Whether the law takes a fraction of μ_c, and so has no impulse without μ_c.
    #[inline(always)]
    fn needs_critical(&self) -> bool {
        matches!(self.tangential, Tangential::FractionOfCritical(f) if f != T::ZERO)
    }

    /// The reason why the law has no impulse that pushes.
    #[cold]
    pub(crate) fn refusal(&self, k: &InverseMass<T>, solution: &Solution<T>) -> ImpactError {
        let impulse = solution.impulse.linear;
        let (asks_for, ratio) = match self.tangential {
            Tangential::FractionOfCritical(_)
                if self.needs_critical() && solution.critical.normal <= T::ZERO =>
            {
                (solution.critical, None)
            }
            Tangential::Ratio(mu) => (impulse, Some(mu)),
            // If these do not push, they slide.
            Tangential::FractionOfCritical(_) | Tangential::Friction(_) | Tangential::FullOrSliding(_) => {
                (impulse, Some(impulse.tangential / impulse.normal))
            }
            Tangential::Critical | Tangential::VelocityChange(_) | Tangential::Restitution(_) => {
                (impulse, None)
            }
        };
        // With a moment impulse the vehicles may pull although nothing jams.
        match ratio {
            Some(mu) if k.nn + mu * k.nt <= T::ZERO => {
                ImpactError::Jam { impulse_ratio: mu.value(), k_nn: k.nn.value(), k_nt: k.nt.value() }
            }
            _ if !asks_for.normal.is_finite() => {
                ImpactError::Overflow { what: "normal impulse", value: asks_for.normal.value() }
            }
            _ => ImpactError::Pulling { normal_impulse: asks_for.normal.value() },
        }
    }
}

/// The result of a law: impulse and moment impulse on vehicle 1; vehicle 2 receives their opposites.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LawImpulse<T = f64> {
    /// (N·s) impulse P at C.
    pub linear: NormalTangential<T>,
    /// (N·m·s) moment impulse M.
    pub moment: T,
    /// Whether a friction limit was reached, for a law that has one.
    pub regime: Option<Regime>,
}

/// The impulse of a law and, up to a positive factor, the one that would give a common tangential velocity
/// under the same law: its ratio is μ_c, if it is a push.
pub(crate) struct Solution<T> {
    pub(crate) impulse: LawImpulse<T>,
    pub(crate) critical: NormalTangential<T>,
}

/// The conditions that all laws share: the normal and the moment condition.
pub(crate) struct Conditions<'a, T> {
    k: &'a InverseMass<T>,
    approach: Approach<T>,
    restitution: T,
    moment: T,
}

impl<T: Real> Conditions<'_, T> {
    /// U_n = −e u_n and U_t − u_t = `change`.
    #[inline(always)]
    fn with_change(&self, change: T) -> LawImpulse<T> {
        let k = self.k;
        let det = k.determinant();
        // K P = (−(1+e) u_n, U_t − u_t)
        let solve = |normal: T, tangential: T| NormalTangential {
            normal: (k.tt * normal - k.nt * tangential) / det,
            tangential: (k.nn * tangential - k.nt * normal) / det,
        };
        self.with_moment(solve(self.normal_change(), change), || solve(-self.k.nm, -self.k.tm))
    }

    /// U_n = −e u_n and P_t = μ P_n.
    #[inline(always)]
    fn with_ratio(&self, mu: T) -> LawImpulse<T> {
        let k = self.k;
        // P_n = −(1+e) u_n / (k_nn + μ k_nt) = −(1+e) m̄ q u_n
        let solve = |normal: T| {
            let p_n = normal / (k.nn + mu * k.nt);
            NormalTangential { normal: p_n, tangential: mu * p_n }
        };
        self.with_moment(solve(self.normal_change()), || solve(-self.k.nm))
    }

    /// The impulse that gives a common tangential velocity, up to a positive factor.
    #[inline(always)]
    fn critical_direction(&self) -> NormalTangential<T> {
        let u_t = self.approach.velocity.tangential;
        if self.moment != -T::ONE {
            return self.with_change(-u_t).linear;
        }
        let (k, normal) = (self.k, self.normal_change());
        // det K · K⁻¹ (−(1+e) u_n, −u_t)
        NormalTangential { normal: k.tt * normal + k.nt * u_t, tangential: -(k.nn * u_t) - k.nt * normal }
    }

    /// (m/s) U_n − u_n.
    #[inline(always)]
    fn normal_change(&self) -> T {
        // −(1+e) u_n
        -((self.restitution + 1.0) * self.approach.velocity.normal)
    }

    /// Adds the moment impulse to an impulse P₀ that meets the conditions without one; `correction`, per unit
    /// of moment, maintains them.
    #[inline(always)]
    fn with_moment(
        &self,
        plain: NormalTangential<T>,
        correction: impl FnOnce() -> NormalTangential<T>,
    ) -> LawImpulse<T> {
        if self.moment == -T::ONE {
            return LawImpulse { linear: plain, moment: T::ZERO, regime: None };
        }
        let k = self.k;
        let correction = correction();
        let turn = |p: NormalTangential<T>| k.nm * p.normal + k.tm * p.tangential;
        // Ω₁ − Ω₂ = (ω₁ − ω₂) + k_m·(P₀ + M P′) + k_mm M = 0
        let common = -(self.approach.relative_yaw_rate + turn(plain)) / (k.mm + turn(correction));
        // M = (1 + e_m) M_c
        let moment = (self.moment + 1.0) * common;
        LawImpulse {
            linear: NormalTangential {
                normal: plain.normal + moment * correction.normal,
                tangential: plain.tangential + moment * correction.tangential,
            },
            moment,
            regime: None,
        }
    }

    /// The `full` impulse if friction of at most `limit` can provide it, else that of sliding.
    ///
    /// The usual rule for the direction of friction, the sign of μ_c, holds only if a push reaches μ_c.
    /// Beyond that, μ_c has jumped through infinity to the other sign, and the rule would let friction drive
    /// the sliding. Friction here opposes the U_t of a frictionless impact.
    #[inline(always)]
    fn limited(&self, full: LawImpulse<T>, limit: T) -> LawImpulse<T> {
        let p = full.linear;
        if (p.normal > T::ZERO) & (p.tangential.abs() <= limit * p.normal) {
            return LawImpulse { regime: Some(Regime::Full), ..full };
        }
        let mu = against(self.free_sliding(), limit);
        LawImpulse { regime: Some(Regime::Sliding), ..self.with_ratio(mu) }
    }

    /// (m/s) U_t as it would be without friction.
    #[inline(always)]
    pub(crate) fn free_sliding(&self) -> T {
        let free = self.with_ratio(T::ZERO);
        self.k.separation(self.approach, free.linear, free.moment).velocity.tangential
    }
}

/// The impulse ratio of the given size that opposes the sliding (m/s).
#[inline(always)]
pub(crate) fn against<T: Real>(sliding: T, size: T) -> T {
    if sliding > T::ZERO { -size } else { size }
}
