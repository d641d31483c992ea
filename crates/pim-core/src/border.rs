//! Where a friction limit switches from one condition to another, and the impulse may jump.

use real::Real;

use crate::contact::{Approach, InverseMass};
use crate::law::{Law, Regime, Tangential, against};

/// The quantity that switches the condition, and its value there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Switch<T = f64> {
    /// Between the full impulse and sliding: the friction limit that is just enough, |P_t|/P_n of the full
    /// impulse.
    Limit(T),
    /// Between two directions of sliding: (m/s) the u_t before impact for which a frictionless impact leaves
    /// U_t = 0.
    Direction(T),
}

/// A border between two conditions of a law with a friction limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Border<T = f64> {
    /// The quantity that switches.
    pub switch: Switch<T>,
    /// The two laws without a limit that give the impulses on either side of the border at this approach: for
    /// [`Switch::Limit`] the full impulse and sliding, for [`Switch::Direction`] sliding in this direction
    /// and in the opposite one. The first border is a value of μ at this approach. The second is a value of
    /// u_t, on which an impulse of given ratio does not depend.
    pub laws: [Law<T>; 2],
}

impl<T: Real> Law<T> {
    /// The borders of the impulse at this approach: that of the friction limit, if the full impulse is a
    /// push, and that of the sliding direction, if the surfaces slide both here and on the border. A law
    /// without a friction limit has none.
    ///
    /// To see whether the impulse jumps there, compare the impulses of the two laws, which need not be
    /// pushes.
    #[must_use]
    pub fn borders(&self, k: &InverseMass<T>, approach: Approach<T>) -> [Option<Border<T>>; 2] {
        let (Tangential::Friction(limit) | Tangential::FullOrSliding(limit)) = self.tangential() else {
            return [None, None];
        };
        let free = self.conditions(k, approach).free_sliding();
        let without_limit = self.without_limit();
        let full = without_limit.impulse(k, approach).linear;
        let at_limit = (full.normal > T::ZERO).then(|| {
            // |P_t| = μ P_n
            let needed = full.tangential.abs() / full.normal;
            let sliding = self.with_ratio(against(free, needed));
            Border { switch: Switch::Limit(needed), laws: [without_limit, sliding] }
        });
        let mut still = approach;
        // The frictionless impulse does not depend on u_t, so U_t changes by as much as u_t.
        still.velocity.tangential = approach.velocity.tangential - free;
        let slides = |at: Approach<T>| self.impulse(k, at).regime == Some(Regime::Sliding);
        let at_turn = (slides(approach) && slides(still)).then(|| {
            let here = against(free, limit);
            Border {
                switch: Switch::Direction(still.velocity.tangential),
                laws: [self.with_ratio(here), self.with_ratio(-here)],
            }
        });
        [at_limit, at_turn]
    }
}
