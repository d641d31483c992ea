//! The body of a vehicle seen from above, for drawings and damage.

use crash3::Side;
use pim_core::Real;

/// The body seen from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensions<T = f64> {
    /// (m) length of the body.
    pub length: T,
    /// (m) width of the body.
    pub width: T,
    /// (m) from the CG forward to the front of the body.
    pub cg_to_front: T,
    /// CRASH3's size class, if the dimensions come from it.
    pub class: Option<u8>,
}

impl<T: Real> Dimensions<T> {
    /// (m) distance of a side's face from the CG.
    #[must_use]
    pub fn face(&self, side: Side) -> T {
        match side {
            Side::Front => self.cg_to_front,
            Side::Rear => self.length - self.cg_to_front,
            Side::Left | Side::Right => self.width / 2.0,
        }
    }

    /// (m) length of a side's face.
    #[must_use]
    pub fn extent(&self, side: Side) -> T {
        match side {
            Side::Front | Side::Rear => self.width,
            Side::Left | Side::Right => self.length,
        }
    }
}
