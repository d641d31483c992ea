//! The handedness of the axes of a case.

use crate::choices;
use crash3::Side;
use pim_core::Real;

choices! {
    /// The axes of the scene and of the vehicles in it, seen from above. The engine computes in
    /// [`ZUp`](Self::ZUp).
    ///
    /// Each is the mirror image of the other: a lateral or rotational number changes its sign. Such numbers
    /// are angles except PDOF and α, yaw rates, y components, components along t, moments, and the ratio
    /// μ = P_t/P_n. Lengths, energies, normal components, restitution and friction are the same in both.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Axes {
        /// `"z-up"`: y to the left of x; angles and yaw rates counter-clockwise positive.
        #[default]
        ZUp = "z-up",
        /// `"z-down"`: y to the right of x; angles and yaw rates clockwise positive, as in SAE J670.
        ZDown = "z-down",
    }
}

impl Axes {
    /// Converts a lateral or rotational number from these axes to those of the engine, or back.
    #[inline(always)]
    #[must_use]
    pub fn lateral<T: Real>(self, value: T) -> T {
        match self {
            Self::ZUp => value,
            // Subtracts from zero, because −0.0 would print as "-0".
            Self::ZDown => T::ZERO - value,
        }
    }

    /// (m) a distance along the face of a side, in the axes of the engine: to the left on front and rear,
    /// forward on the sides, which is forward in any axes.
    #[must_use]
    pub fn along_face<T: Real>(self, side: Side, distance: T) -> T {
        match side {
            Side::Front | Side::Rear => self.lateral(distance),
            Side::Left | Side::Right => distance,
        }
    }
}
