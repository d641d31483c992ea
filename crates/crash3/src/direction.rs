//! From the direction of the force to the angle at the damaged side and the moment arm.

use core::f64::consts::{FRAC_PI_2, PI};

use real::{Real, principal_angle};

use crate::energy::Yielding;
use crate::error::{self, CrushError};
use crate::profile::{Profile, Zone};
use crate::stiffness::{Saturation, SideStiffness, Stiffness};

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
    /// Whether it is the left or the right side.
    #[must_use]
    pub fn is_side(self) -> bool {
        matches!(self, Self::Left | Self::Right)
    }

    /// (rad) direction of the side's outward normal, clockwise from the heading: the PDOF of a square hit.
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
/// direction of the scene. `pdof` belongs to the first of the two headings (rad, counter-clockwise), the
/// result to the second.
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

/// The crush energy of adjacent zones of a profile, and its moments.
///
/// Each strip of the damage is weighted by the energy that crushed it, and lies at half its depth, so that
/// deep damage and stiff structure attract the centroid. EDCRASH places its impulse centre in the same way:
/// the three centres printed in its manual are within 1 cm of this centroid, and up to 21 cm from that of the
/// area.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnergyMoments<T = f64> {
    /// (m) of all zones.
    pub width: T,
    /// (J) ∫ E ds, with E (N) the energy per width.
    pub energy: T,
    /// (J·m) ∫ s E ds, with s from the beginning of the first zone.
    pub moment_along: T,
    /// (J·m) ∫ C/2 E ds.
    pub moment_deep: T,
}

impl<T: Real> EnergyMoments<T> {
    /// No zones.
    #[must_use]
    pub fn none() -> Self {
        Self { width: T::ZERO, energy: T::ZERO, moment_along: T::ZERO, moment_deep: T::ZERO }
    }

    /// The moments of a profile.
    ///
    /// # Errors
    /// If the number of stiffnesses is not that of the profile's zones.
    pub fn of(profile: &Profile<T>, structure: &SideStiffness<T>) -> Result<Self, CrushError> {
        structure.fold(profile, Self::none(), Self::with)
    }

    /// Adds a zone.
    #[inline(always)]
    #[must_use]
    pub fn with(self, zone: Zone<T>, stiffness: &Stiffness<T>) -> Self {
        let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
        // E = G + A C + B C²/2
        let rising = [g, a, b];
        // E = G + e_s + F_s (C − C_s),  e_s = (A + F_s) C_s/2
        let flat =
            |Saturation { force, depth }: Saturation<T>| [g + (a - force) * depth / 2.0, force, T::ZERO];
        match zone.yielding(stiffness) {
            Yielding::Nowhere => self.with_strip(zone, rising),
            Yielding::Throughout(saturation) => self.with_strip(zone, flat(saturation)),
            Yielding::Partly { saturation, below, .. } => {
                let Zone { width, depths: [c1, c2] } = zone;
                let (knee, rises) = (saturation.depth, width * below);
                let (shallow, deep) = (rises, width - rises);
                if c1.value() < c2.value() {
                    self.with_strip(Zone { width: shallow, depths: [c1, knee] }, rising)
                        .with_strip(Zone { width: deep, depths: [knee, c2] }, flat(saturation))
                } else {
                    self.with_strip(Zone { width: deep, depths: [c1, knee] }, flat(saturation))
                        .with_strip(Zone { width: shallow, depths: [knee, c2] }, rising)
                }
            }
        }
    }

    /// Adds a zone with the energy per width p_0 + p_1 C + p_2 C²/2.
    #[inline(always)]
    fn with_strip(self, zone: Zone<T>, [p0, p1, p2]: [T; 3]) -> Self {
        let Zone { width, depths: [c1, c2] } = zone;
        let (mean, square) = (zone.mean_depth(), zone.mean_square_depth());
        // mean of C³: (C₁² + C₂²)(C₁ + C₂)/4
        let cube = (c1 * c1 + c2 * c2) * (c1 + c2) / 4.0;
        // ∫ E ds = w [p₀ + p₁ C̄ + p₂ Q/2]
        let energy = width * (p0 + p1 * mean + p2 * square / 2.0);
        // ∫ s E ds = s₁ ∫ E ds + w² [p₀/2 + p₁ (C₁ + 2 C₂)/6 + p₂ (C₁² + 2 C₁ C₂ + 3 C₂²)/24]
        let inside =
            p0 / 2.0 + p1 * (c1 + c2 * 2.0) / 6.0 + p2 * (c1 * c1 + c1 * c2 * 2.0 + c2 * c2 * 3.0) / 24.0;
        let along = self.width * energy + width * width * inside;
        // ∫ C/2 E ds = w/2 [p₀ C̄ + p₁ Q + p₂ (C₁² + C₂²)(C₁ + C₂)/8]
        let deep = width * (p0 * mean + p1 * square + p2 * cube / 2.0) / 2.0;
        Self {
            width: self.width + width,
            energy: self.energy + energy,
            moment_along: self.moment_along + along,
            moment_deep: self.moment_deep + deep,
        }
    }
}

/// The damaged face of a vehicle, and the position of the damage on it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
    /// If the distance is not positive, or the offset is not finite.
    pub fn new(side: Side, distance: T, offset: T) -> Result<Self, CrushError> {
        error::positive("distance of the damaged face from the centre of gravity", distance.value())?;
        error::finite("offset of the damage", offset.value())?;
        Ok(Self { side, distance, offset })
    }

    /// (m) the centroid of the damage, weighted by [crush energy](EnergyMoments), forward and left of the CG:
    /// the point through which the force acts in CRASH3. Depths run from left to right on the front and the
    /// rear, from rear to front on the sides. If a uniform side has no crush, it is the middle of the damage
    /// on the face.
    ///
    /// # Errors
    /// If the number of stiffnesses is not that of the profile's zones.
    pub fn centroid(&self, profile: &Profile<T>, structure: &SideStiffness<T>) -> Result<[T; 2], CrushError> {
        Ok(self.centroid_of(&EnergyMoments::of(profile, structure)?))
    }

    /// The centroid for moments that were added up zone by zone.
    #[inline(always)]
    #[must_use]
    pub fn centroid_of(&self, moments: &EnergyMoments<T>) -> [T; 2] {
        let EnergyMoments { width, energy, moment_along, moment_deep } = *moments;
        let middle = width / 2.0;
        let (along, depth) = if energy.value() > 0.0 {
            (moment_along / energy - middle, moment_deep / energy)
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
