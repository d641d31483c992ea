//! The crossing of two paths, and the times at which each road user is in the zone.

use pim_core::InvalidInput;
use real::Real;

use crate::course::Course;
use pim_core::check;

/// (–) least sine of the angle between two paths: below it, rounding of the angle decides where they cross.
const LEAST_SINE: f64 = 1e-9;

/// A road user on a straight path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Party<T = f64> {
    /// (m) from the point whose path is given to the front.
    pub front: T,
    /// (m) from that point to the rear.
    pub rear: T,
    /// (m) width.
    pub width: T,
}

/// Two straight paths that cross.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Crossing<T = f64> {
    /// (rad) angle between the directions of travel.
    angle: T,
    parties: [Party<T>; 2],
}

/// The time that a road user is in the zone that both sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occupancy<T = f64> {
    /// (s) its front enters; `None` where it never does.
    pub enters: Option<T>,
    /// (s) its rear has left; `None` where it stays.
    pub leaves: Option<T>,
}

impl<T: Real> Crossing<T> {
    /// From the angle (rad) between the directions and the outlines.
    ///
    /// # Errors
    /// If the paths are parallel (the sine of the angle is below 1e-9), the angle is beyond what
    /// [`Real::sin_cos`] takes, an outline is impossible, or a number is not finite.
    pub fn new(angle: T, parties: [Party<T>; 2]) -> Result<Self, InvalidInput> {
        check::angle("angle between the paths", angle.value())?;
        let (sin, _) = angle.sin_cos();
        check::at_least("sine of the angle between the paths", sin.abs().value(), LEAST_SINE)?;
        for party in &parties {
            check::at_least("distance to the front", party.front.value(), 0.0)?;
            check::at_least("distance to the rear", party.rear.value(), 0.0)?;
            check::at_least("width", party.width.value(), 0.0)?;
        }
        Ok(Self { angle, parties })
    }

    /// (m) half the length, along the path of each party, of the parallelogram that both sweep; its middle is
    /// where the paths cross.
    #[must_use]
    pub fn half_zones(&self) -> [T; 2] {
        let [one, two] = self.parties.each_ref().map(|party| party.width);
        let (sin, cos) = self.angle.sin_cos();
        // (w_other + w_own |cos θ|)/(2 |sin θ|)
        [(one, two), (two, one)].map(|(own, other)| (other + own * cos.abs()) / (sin.abs() * 2.0))
    }

    /// (m) distance that party 1 still has to travel until its rear has left the zone; negative if it has
    /// already left it. Party 1 is `aside` (m) from the middle of the strip that party 0 sweeps, positive to
    /// the left of the direction of party 0.
    #[must_use]
    pub fn way_out(&self, aside: T) -> T {
        let [_, party] = &self.parties;
        let (sin, _) = self.angle.sin_cos();
        // To the middle of the zone, out of it, and the rear: z + r − q/sin θ
        let [_, half] = self.half_zones();
        half + party.rear - aside / sin
    }

    /// (m) distance that party 1 travels while any part of it is in the zone.
    #[must_use]
    pub fn way_through(&self) -> T {
        let [_, party] = &self.parties;
        let [_, half] = self.half_zones();
        half * 2.0 + party.front + party.rear
    }

    /// When each party is in the zone, on its course, whose positions count from the crossing of the paths.
    #[must_use]
    pub fn occupancies(&self, [one, two]: [&Course<'_, T>; 2]) -> [Occupancy<T>; 2] {
        let [first, second] = &self.parties;
        let [half_one, half_two] = self.half_zones();
        [(one, first, half_one), (two, second, half_two)].map(|(course, outline, half)| Occupancy {
            enters: course.reaches(-half - outline.front),
            leaves: course.reaches(half + outline.rear),
        })
    }
}

impl<T: Real> Occupancy<T> {
    /// (s) the time from this one's leaving to the other's entering; negative if both are in the zone
    /// together, and −∞ if this one stays. `None` if either never enters.
    #[must_use]
    pub fn margin_before(&self, other: &Self) -> Option<T> {
        let (_, enters) = (self.enters?, other.enters?);
        Some(match self.leaves {
            Some(leaves) => enters - leaves,
            None => T::from(f64::NEG_INFINITY),
        })
    }

    /// Whether both are ever in the zone together.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        let (Some(own), Some(others)) = (self.enters, other.enters) else { return false };
        let leaves_before =
            |leaves: Option<T>, enters: T| leaves.is_some_and(|leaves| leaves.value() <= enters.value());
        !leaves_before(self.leaves, others) && !leaves_before(other.leaves, own)
    }
}
