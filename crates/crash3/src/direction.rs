//! From the direction of the force to the angle at the damaged side and the moment arm.

use core::f64::consts::{FRAC_PI_2, PI};

use real::{Real, principal_angle};

use crate::error::{self, CrushError};
use crate::profile::{Profile, Zone};

/// The damaged side of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// The front.
    Front,
    /// The right side.
    Right,
    /// The rear.
    Rear,
    /// The left side.
    Left,
}

impl Side {
    /// (rad) direction of the side's outward normal, clockwise from the heading: the PDOF of a force that
    /// meets it squarely.
    #[must_use]
    pub fn square_pdof(self) -> f64 {
        match self {
            Self::Front => 0.0,
            Self::Right => FRAC_PI_2,
            Self::Rear => PI,
            Self::Left => -FRAC_PI_2,
        }
    }

    /// (rad) α: angle between a force with the given PDOF (rad, in (−π, π]) and the normal of this side, in
    /// (−π, π], clockwise positive like the PDOF. The force pushes on the side where |α| < π/2.
    #[inline(always)]
    #[must_use]
    pub fn oblique_angle<T: Real>(self, pdof: T) -> T {
        // α = PDOF − PDOF of a square hit
        principal_angle(pdof - self.square_pdof())
    }
}

/// (rad) the PDOF of the other vehicle, in (−π, π], by Newton's third law: the force comes from the opposite
/// direction of the scene. `pdof` is that of the first of the two `headings` (rad, counter-clockwise), the
/// result that of the second.
#[must_use]
pub fn opposite_pdof<T: Real>(pdof: T, [own, other]: [T; 2]) -> T {
    // The force on the first comes from the scene angle θ₁ − PDOF₁, that on the second from θ₂ − PDOF₂ = θ₁ −
    // PDOF₁ + π.
    principal_angle(other - own + pdof - PI)
}

/// (m) h: distance of the CG from the line of action of a force with the given PDOF (rad) through a point
/// that lies at (`forward`, `left`) (m) of the CG in the vehicle's own axes.
#[inline(always)]
#[must_use]
pub fn moment_arm<T: Real>([forward, left]: [T; 2], pdof: T) -> T {
    let (sin, cos) = pdof.sin_cos();
    // h = |r × f| with the direction of the push f = (−cos PDOF, sin PDOF) in (forward, left)
    (forward * sin + left * cos).abs()
}

/// The area between an undamaged face and some zones of a profile, one beside the other, and its moments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrushArea<T = f64> {
    /// (m) of all zones.
    pub width: T,
    /// (m²) ∫ C ds.
    pub area: T,
    /// (m³) ∫ s C ds, with s from the beginning of the first zone.
    pub moment_along: T,
    /// (m³) ∫ C²/2 ds.
    pub moment_deep: T,
}

impl<T: Real> CrushArea<T> {
    /// Without a zone.
    #[must_use]
    pub fn none() -> Self {
        Self { width: T::ZERO, area: T::ZERO, moment_along: T::ZERO, moment_deep: T::ZERO }
    }

    /// With one more zone.
    #[inline(always)]
    #[must_use]
    pub fn with(self, zone: Zone<T>) -> Self {
        let [c1, c2] = zone.depths;
        let area = zone.area();
        // ∫ s C ds = s₁ a + w² (C₁ + 2C₂)/6
        let along = self.width * area + zone.width * zone.width * (c1 + c2 * 2.0) / 6.0;
        Self {
            width: self.width + zone.width,
            area: self.area + area,
            moment_along: self.moment_along + along,
            moment_deep: self.moment_deep + zone.second_moment(),
        }
    }
}

/// The face of a vehicle that was damaged, and where on it the damage lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DamagedFace<T = f64> {
    pub(crate) side: Side,
    pub(crate) distance: T,
    pub(crate) offset: T,
}

impl<T: Real> DamagedFace<T> {
    /// The undamaged face of `side` lies at `distance` (m) from the CG, along its normal; the middle of the
    /// damage's width at `offset` (m) along the face: to the left of the vehicle's axis on the front and the
    /// rear, forward of the CG on the sides.
    ///
    /// # Errors
    /// Where the distance is not positive, or the offset is not finite.
    pub fn new(side: Side, distance: T, offset: T) -> Result<Self, CrushError> {
        error::positive("distance of the damaged face from the centre of gravity", distance.value())?;
        error::finite("offset of the damage", offset.value())?;
        Ok(Self { side, distance, offset })
    }

    /// (m) the centroid of the area between the undamaged face and the profile, forward and left of the CG:
    /// the point through which CRASH3 lets the force act. Depths run from left to right on the front and the
    /// rear, from rear to front on the sides. Without any crush it is the middle of the damage on the face.
    #[must_use]
    pub fn centroid(&self, profile: &Profile<T>) -> [T; 2] {
        self.centroid_of(&profile.zones().fold(CrushArea::none(), CrushArea::with))
    }

    /// The same of an area that is added up zone by zone.
    #[inline(always)]
    #[must_use]
    pub fn centroid_of(&self, area: &CrushArea<T>) -> [T; 2] {
        let CrushArea { width, area, moment_along, moment_deep } = *area;
        let middle = width / 2.0;
        let (along, depth) = if area.value() > 0.0 {
            (moment_along / area - middle, moment_deep / area)
        } else {
            (T::ZERO, T::ZERO)
        };
        let outward = self.distance - depth;
        match self.side {
            Side::Front => [outward, self.offset - along],
            Side::Rear => [-outward, self.offset - along],
            Side::Left => [self.offset + along, outward],
            Side::Right => [self.offset + along, -outward],
        }
    }
}
