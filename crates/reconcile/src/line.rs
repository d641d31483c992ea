//! The relative velocity at C as a function of the unknown speed.

use pim_core::{Approach, NormalTangential, Real};

/// The relative velocity u at C is affine in the unknown speed s, and so are u_t and s in the approach speed
/// x = −u_n.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ApproachLine<T = f64> {
    /// (m/s) u for s = 0, with the vehicle whose speed is sought at rest but for its yaw rate.
    pub at_rest: NormalTangential<T>,
    /// (–) du/ds.
    pub slope: NormalTangential<T>,
    /// (rad/s) ω_1 − ω_2, which does not depend on the speed.
    pub relative_yaw_rate: T,
}

impl<T: Real> ApproachLine<T> {
    /// (–) τ = du_t/dx.
    #[inline(always)]
    #[must_use]
    pub fn tangential_slope(&self) -> T {
        // τ = −c_t/c_n
        -self.slope.tangential / self.slope.normal
    }

    /// (m/s) u_t0, the tangential velocity at x = 0, where the vehicles just touch.
    #[inline(always)]
    #[must_use]
    pub fn tangential_at_zero_approach(&self) -> T {
        // u_t0 = u_t(s=0) + u_n(s=0) τ
        self.at_rest.tangential + self.at_rest.normal * self.tangential_slope()
    }

    /// The approach of the vehicles at the approach speed x (m/s).
    #[inline(always)]
    #[must_use]
    pub fn at(&self, x: T) -> Approach<T> {
        let velocity = NormalTangential {
            normal: -x,
            // u_t = u_t0 + τ x
            tangential: self.tangential_at_zero_approach() + x * self.tangential_slope(),
        };
        Approach { velocity, relative_yaw_rate: self.relative_yaw_rate }
    }

    /// (m/s) the speed s that gives the approach speed x (m/s).
    #[inline(always)]
    #[must_use]
    pub fn speed(&self, x: T) -> T {
        // s = −(x + u_n(s=0))/c_n
        -(x + self.at_rest.normal) / self.slope.normal
    }

    /// The same in axes of the other handedness.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            at_rest: self.at_rest.mirrored(),
            slope: self.slope.mirrored(),
            // Subtracted from zero, because −0 would be printed as "-0".
            relative_yaw_rate: T::ZERO - self.relative_yaw_rate,
        }
    }
}
