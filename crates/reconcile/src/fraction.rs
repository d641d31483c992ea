//! The impulse under a fraction of μ_c, generic over the type of polynomial.

use pim_core::InverseMass;

use crate::polynomial::Ring;

/// Numerators of P_n, P_t and M, and their common denominator, as polynomials.
pub(crate) struct Fraction<P> {
    pub(crate) push: P,
    pub(crate) slide: P,
    pub(crate) moment: P,
    pub(crate) divisor: P,
}

/// The critical impulse of a law.
pub(crate) struct Critical<P> {
    pub(crate) normal: P,
    pub(crate) tangential: P,
}

/// The polynomials whose zeros are jams under a fraction f of μ_c.
pub(crate) struct Jams<P> {
    /// d = k_nn c_n + f k_nt c_t: the contact jams at its zero.
    pub(crate) normal: P,
    /// n = k_nm c_n + f k_tm c_t
    turn: P,
    /// g = k_mm d − k_nm n: at its zero no moment impulse gives a common yaw rate.
    pub(crate) moment: P,
}

impl<P: Ring> Jams<P> {
    /// s d + (1+e) x n
    #[inline(always)]
    pub(crate) fn turning(&self, yaw_rate: f64, change: P) -> P {
        self.normal.by(yaw_rate) + change * self.turn
    }
}

#[inline(always)]
pub(crate) fn jams<P: Ring>(k: &InverseMass, critical: &Critical<P>, f: f64) -> Jams<P> {
    let normal = critical.normal.by(k.nn) + critical.tangential.by(f * k.nt);
    let turn = critical.normal.by(k.nm) + critical.tangential.by(f * k.tm);
    Jams { normal, turn, moment: normal.by(k.mm) + turn.by(-k.nm) }
}

/// The second case of [`Posed::fraction_of_critical`], with (1+e) x.
#[inline(always)]
pub(crate) fn fraction_with_moment<P: Ring>(
    k: &InverseMass,
    (critical, f): (&Critical<P>, f64),
    jams: &Jams<P>,
    change: P,
    (yaw_rate, e_m): (f64, f64),
) -> Fraction<P> {
    let (d, g) = (jams.normal, jams.moment);
    let turning = jams.turning(yaw_rate, change);
    let share = change * g + turning.by((1.0 + e_m) * k.nm);
    Fraction {
        push: critical.normal * share,
        slide: (critical.tangential * share).by(f),
        divisor: d * g,
        moment: (turning * d).by(-(1.0 + e_m)),
    }
}
