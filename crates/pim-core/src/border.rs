//! Where a friction limit switches from one condition to another, and the impulse may jump.

use real::Real;

use crate::contact::{Approach, InverseMass};
use crate::law::{Law, Regime, Tangential, against};

/// What switches, and at which number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Switch<T = f64> {
    /// Between the full impulse and sliding: the friction limit that just suffices, |P_t|/P_n of the full
    /// impulse.
    Limit(T),
    /// Between two directions of sliding: (m/s) the sliding u_t before impact that leaves none after a
    /// frictionless one.
    Direction(T),
}

/// A border between two conditions of a law with a friction limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Border<T = f64> {
    /// What switches there.
    pub switch: Switch<T>,
    /// The laws, without a limit, whose impulses at this approach are those on either side of the border: of
    /// [`Switch::Limit`] the full impulse and sliding, of [`Switch::Direction`] sliding as here and the other
    /// way. The first border is one of μ at this approach; on the way to the second only u_t changes, on
    /// which an impulse of given ratio does not depend.
    pub laws: [Law<T>; 2],
}

impl<T: Real> Law<T> {
    /// The borders that the impulse at this approach has: that of the friction limit, if a push gives the
    /// full impulse; and that of the direction, if the surfaces slide here and on the border. A law without a
    /// friction limit has none.
    ///
    /// Whether the impulse jumps there is seen by comparing the impulses of the two laws, which need not be
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
        // The frictionless impulse does not depend on u_t, so that its U_t changes by as much as u_t does.
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
