//! Identifies one of the two vehicles.

use core::fmt::{self, Display, Formatter};

/// One of the two vehicles of a collision.
///
/// Vehicle 1 comes first in every pair `[T; 2]`, with [`index`](Self::index) 0. In text and data it has the
/// [`number`](Self::number) 1, which [`Display`] prints.
///
/// ```
/// use pim_core::VehicleId;
///
/// let speeds = [22.86, 4.4704];
/// for vehicle in VehicleId::ALL {
///     println!("vehicle {vehicle}: {} m/s", speeds[vehicle.index()]);
/// }
/// assert_eq!(VehicleId::One.other().number(), 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum VehicleId {
    /// Vehicle 1, towards which the normal of the crush plane points.
    One,
    /// Vehicle 2.
    Two,
}

impl VehicleId {
    /// Both, in their order.
    pub const ALL: [Self; 2] = [Self::One, Self::Two];

    /// 0 or 1: the index in a pair.
    #[inline(always)]
    #[must_use]
    pub const fn index(self) -> usize {
        match self {
            Self::One => 0,
            Self::Two => 1,
        }
    }

    /// 1 or 2: the number in text and data. Not a `usize`, so that it cannot be mistaken for the
    /// [`index`](Self::index).
    #[must_use]
    pub const fn number(self) -> u8 {
        match self {
            Self::One => 1,
            Self::Two => 2,
        }
    }

    /// The vehicle that this one collides with.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::One => Self::Two,
            Self::Two => Self::One,
        }
    }
}

impl Display for VehicleId {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.number(), f)
    }
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::VehicleId;

    #[test]
    fn each_vehicle_has_its_place_its_number_and_the_other() {
        let [one, two] = VehicleId::ALL;
        assert_eq!([one, two], [VehicleId::One, VehicleId::Two]);
        assert_eq!([one.index(), two.index()], [0, 1]);
        assert_eq!([one.number(), two.number()], [1, 2]);
        assert_eq!([one.other(), two.other()], [two, one]);
        assert_eq!([one.to_string(), two.to_string()], ["1", "2"]);
    }
}
