//! Impact laws: one normal and one tangential condition on the impulse.

use real::Real;

use crate::contact::{InverseMass, NormalTangential};
use crate::error::{self, ImpactError, InvalidInput};

/// The tangential condition of Brach's law: what decides the impulse ratio μ = P_t/P_n.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangential<T = f64> {
    /// μ = μ_c: a common tangential velocity at C after impact, U_t = 0.
    Critical,
    /// μ as given.
    Ratio(T),
    /// μ = f μ_c with 0 ≤ f ≤ 1.
    FractionOfCritical(T),
    /// Coulomb friction: μ = μ_c while friction of at most this coefficient (≥ 0) can hold the surfaces
    /// together, else they still slide and μ has the limit's size.
    Friction(T),
}

/// Brach's impact law: U_n = −e u_n, and one of four tangential conditions.
///
/// # References
/// Brach & Brach, SAE 980025, "Summary of planar impact mechanics".
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law<T = f64> {
    restitution: T,
    tangential: Tangential<T>,
}

impl<T: Real> Law<T> {
    /// The law with coefficient of restitution e and the given tangential condition.
    ///
    /// # Errors
    /// Where e or the fraction lies outside [0, 1], the friction limit is negative, or a number is not finite.
    pub fn new(restitution: T, tangential: Tangential<T>) -> Result<Self, InvalidInput> {
        error::within("coefficient of restitution", restitution.value(), 0.0, 1.0)?;
        match tangential {
            Tangential::Critical => {}
            Tangential::Ratio(mu) => error::finite("impulse ratio", mu.value())?,
            Tangential::FractionOfCritical(f) => {
                error::within("fraction of the critical impulse ratio", f.value(), 0.0, 1.0)?;
            }
            Tangential::Friction(limit) => error::within("friction limit", limit.value(), 0.0, f64::MAX)?,
        }
        Ok(Self { restitution, tangential })
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

    /// The law with the same coefficient of restitution, under which the vehicles end up with a common tangential velocity at C.
    #[inline(always)]
    #[must_use]
    pub fn with_common_tangential_velocity(&self) -> Self {
        Self { tangential: Tangential::Critical, ..*self }
    }

    /// (N·s) the impulse on vehicle 1 that satisfies both conditions, whether or not it is one that a collision can
    /// have: [`Contact::impact`](crate::Contact::impact) judges that. A search for a speed needs the impulse on
    /// both sides of that border.
    #[inline(always)]
    #[must_use]
    pub fn impulse(&self, k: InverseMass<T>, u: NormalTangential<T>) -> NormalTangential<T> {
        match self.tangential {
            Tangential::Critical => CriticalRatio::new(k, u, self.restitution).impulse(k),
            Tangential::Ratio(mu) => self.with_ratio(k, u, mu),
            Tangential::FractionOfCritical(f) => {
                let critical = CriticalRatio::new(k, u, self.restitution);
                self.with_ratio(k, u, f * critical.numerator / critical.denominator)
            }
            Tangential::Friction(limit) => {
                let critical = CriticalRatio::new(k, u, self.restitution);
                if critical.needs_at_most(limit) {
                    critical.impulse(k)
                } else {
                    self.with_ratio(k, u, critical.sliding(limit))
                }
            }
        }
    }

    /// U_n = −e u_n with P_t = μ P_n.
    #[inline(always)]
    fn with_ratio(&self, k: InverseMass<T>, u: NormalTangential<T>, mu: T) -> NormalTangential<T> {
        // P_n = −(1+e) u_n / (k_nn + μ k_nt) = −(1+e) m̄ q u_n
        let normal = -((self.restitution + 1.0) * u.normal) / (k.nn + mu * k.nt);
        NormalTangential { normal, tangential: mu * normal }
    }

    /// Why this law has no impulse for an approach u, as far as its conditions decide that.
    pub(crate) fn refusal(
        &self,
        k: InverseMass<T>,
        u: NormalTangential<T>,
        impulse: NormalTangential<T>,
    ) -> Option<ImpactError> {
        let critical = CriticalRatio::new(k, u, self.restitution);
        let mu = match self.tangential {
            Tangential::Critical | Tangential::FractionOfCritical(_) if !critical.is_push() => {
                let normal_impulse = (-critical.denominator / k.determinant()).value();
                return Some(ImpactError::Pulling { normal_impulse });
            }
            Tangential::Ratio(mu) => mu,
            _ => impulse.tangential / impulse.normal,
        };
        if impulse.normal > T::ZERO {
            None
        } else {
            Some(ImpactError::Jam { impulse_ratio: mu.value(), k_nn: k.nn.value(), k_nt: k.nt.value() })
        }
    }
}

/// The critical impulse ratio μ_c = N/D, at which the final tangential velocity at C is zero, kept as its two
/// parts: D = −P_n det K also says whether an impulse that does this would push.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CriticalRatio<T> {
    numerator: T,
    denominator: T,
}

impl<T: Real> CriticalRatio<T> {
    /// For the approach u and the coefficient of restitution e.
    #[inline(always)]
    pub(crate) fn new(k: InverseMass<T>, u: NormalTangential<T>, e: T) -> Self {
        // μ_c = [r A + (1+e) B] / [(1+e)(1+C) + r B],  r = u_t/u_n; both parts multiplied by u_n/m̄:
        // N = u_t k_nn − (1+e) u_n k_nt,  D = (1+e) u_n k_tt − u_t k_nt
        let one_plus_e = e + 1.0;
        Self {
            numerator: u.tangential * k.nn - one_plus_e * u.normal * k.nt,
            denominator: one_plus_e * u.normal * k.tt - u.tangential * k.nt,
        }
    }

    /// Whether the vehicles reach a common tangential velocity by pushing: P_n > 0.
    #[inline(always)]
    fn is_push(&self) -> bool {
        self.denominator < T::ZERO
    }

    /// μ_c, or `None` where only a pull could give a common tangential velocity.
    #[inline(always)]
    pub(crate) fn value(&self) -> Option<T> {
        if self.is_push() { Some(self.numerator / self.denominator) } else { None }
    }

    /// The impulse that gives a common tangential velocity.
    #[inline(always)]
    fn impulse(&self, k: InverseMass<T>) -> NormalTangential<T> {
        // U_t = 0 and U_n = −e u_n are linear in P: P_n = −D/det K, P_t = −N/det K
        NormalTangential {
            normal: -self.denominator / k.determinant(),
            tangential: -self.numerator / k.determinant(),
        }
    }

    /// Whether friction of at most `limit` can give a common tangential velocity.
    #[inline(always)]
    fn needs_at_most(&self, limit: T) -> bool {
        self.is_push() & (self.numerator.abs() <= limit * -self.denominator)
    }

    /// μ of surfaces that slide to the end: the limit, against the sliding.
    ///
    /// The usual rule sign(μ_c) min(|μ_c|, limit) holds only where μ_c is reached by a push. Beyond, μ_c has jumped through
    /// infinity to the other sign, and the rule would let friction drive the sliding. The direction is that of −N:
    /// without friction U_t = N/k_nn.
    #[inline(always)]
    fn sliding(&self, limit: T) -> T {
        if self.numerator > T::ZERO { -limit } else { limit }
    }
}
