//! Crush energy and crush force of one vehicle.

use real::Real;

use crate::error::{self, CrushError};
use crate::profile::{Profile, Zone};
use crate::stiffness::{Saturation, SideStiffness, Stiffness};

/// (J) the energy that made the crush: the integral of A + B C over depth and width, for a profile that is
/// linear between its stations.
///
/// ERRATUM (theory, section 8): SAE 980025 prints its Eq 5, for six equally spaced stations, with B/6 on the
/// squares only and 5G outside L/5. The equation here is the correct one.
///
/// # References
/// SAE 980025, Eq 5.
#[inline(always)]
#[must_use]
pub fn crush_energy<T: Real>(profile: &Profile<T>, stiffness: &Stiffness<T>) -> T {
    let mut energy = T::ZERO;
    for zone in profile.zones() {
        energy += zone_energy(zone, stiffness);
    }
    energy
}

/// (J) the share of one zone in [`crush_energy`].
#[inline(always)]
#[must_use]
pub fn zone_energy<T: Real>(zone: Zone<T>, stiffness: &Stiffness<T>) -> T {
    let Zone { width, depths: [c1, c2] } = zone;
    let per_width = match zone.yielding(stiffness) {
        // E = Σⱼ wⱼ [ A (Cⱼ + Cⱼ₊₁)/2 + B (Cⱼ² + Cⱼ Cⱼ₊₁ + Cⱼ₊₁²)/6 + G ]
        Yielding::Nowhere => rising(stiffness, c1, c2),
        Yielding::Throughout(saturation) => flat(stiffness, saturation, c1, c2),
        // s e(C_low, C_s) + (1 − s) e(C_s, C_high)
        Yielding::Partly { saturation, low, high, below } => {
            let knee = saturation.depth;
            below * rising(stiffness, low, knee) + (T::ONE - below) * flat(stiffness, saturation, knee, high)
        }
    };
    width * (per_width + stiffness.g())
}

/// (N) mean energy per width where the depth goes from C_1 to C_2 and the force rises: A (C_1 + C_2)/2 + B
/// (C_1² + C_1 C_2 + C_2²)/6.
#[inline(always)]
fn rising<T: Real>(stiffness: &Stiffness<T>, c1: T, c2: T) -> T {
    stiffness.a() * (c1 + c2) / 2.0 + stiffness.b() * (c1 * c1 + c1 * c2 + c2 * c2) / 6.0
}

/// (N) the same where the force has reached its limit: e_s + F_s ((C_1 + C_2)/2 − C_s).
#[inline(always)]
fn flat<T: Real>(
    stiffness: &Stiffness<T>,
    Saturation { force, depth: knee }: Saturation<T>,
    c1: T,
    c2: T,
) -> T {
    // e_s = A C_s + B C_s²/2 = (A + F_s) C_s/2
    let at_knee = (stiffness.a() + force) * knee / 2.0;
    at_knee + force * ((c1 + c2) / 2.0 - knee)
}

/// The part of a zone on which the force per width is saturated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Yielding<T = f64> {
    /// Nowhere: the force is A + B C.
    Nowhere,
    /// All along the zone: the force is F_s.
    Throughout(Saturation<T>),
    /// On the deeper part of the zone.
    Partly {
        /// F_s and C_s.
        saturation: Saturation<T>,
        /// (m) C_low, the depth at the shallower end.
        low: T,
        /// (m) C_high, the depth at the deeper end.
        high: T,
        /// s = (C_s − C_low)/(C_high − C_low), the share of the width on which the force still rises.
        below: T,
    },
}

impl<T: Real> Zone<T> {
    /// The part of this zone on which the force per width is saturated.
    #[inline(always)]
    #[must_use]
    pub fn yielding(&self, stiffness: &Stiffness<T>) -> Yielding<T> {
        let Some(saturation) = stiffness.saturation() else { return Yielding::Nowhere };
        let [c1, c2] = self.depths;
        let knee = saturation.depth;
        let (low, high) = if c1.value() <= c2.value() { (c1, c2) } else { (c2, c1) };
        if high.value() <= knee.value() {
            Yielding::Nowhere
        } else if low.value() >= knee.value() {
            Yielding::Throughout(saturation)
        } else {
            // The depth is linear along the zone, so it crosses C_s once.
            // s = (C_s − C_low)/(C_high − C_low)
            Yielding::Partly { saturation, low, high, below: (knee - low) / (high - low) }
        }
    }
}

/// (N) the force at maximum crush, for a force at the angle α (rad) to the normal of the damaged side:
/// ∫(A + B C) dw / cos α. By Newton's third law it should be the same for both vehicles of a collision.
///
/// # Errors
/// If |α| ≥ π/2: such a force does not push on the side.
pub fn peak_force<T: Real>(
    profile: &Profile<T>,
    stiffness: &Stiffness<T>,
    oblique_angle: T,
) -> Result<T, CrushError> {
    let cos = pushing_cosine(oblique_angle)?;
    let mut force = T::ZERO;
    for zone in profile.zones() {
        force += zone_force(zone, stiffness);
    }
    // F = F_n / cos α
    Ok(force / cos)
}

/// (N) the share of one zone in [`peak_force`], for a force normal to the side.
#[inline(always)]
#[must_use]
pub fn zone_force<T: Real>(zone: Zone<T>, stiffness: &Stiffness<T>) -> T {
    let Zone { width, depths: [c1, c2] } = zone;
    let (a, b) = (stiffness.a(), stiffness.b());
    match zone.yielding(stiffness) {
        // F_n = Σⱼ wⱼ [ A + B (Cⱼ + Cⱼ₊₁)/2 ]
        Yielding::Nowhere => width * (a + b * (c1 + c2) / 2.0),
        Yielding::Throughout(Saturation { force, .. }) => width * force,
        // s (A + B (C_low + C_s)/2) + (1 − s) F_s
        Yielding::Partly { saturation: Saturation { force, depth: knee }, low, below, .. } => {
            width * (below * (a + b * (low + knee) / 2.0) + (T::ONE - below) * force)
        }
    }
}

impl<T: Real> SideStiffness<T> {
    /// (J) the energy that made the crush: [`crush_energy`], zone by zone where the stiffness differs along
    /// the side.
    ///
    /// # Errors
    /// If the number of stiffnesses is not that of the profile's zones.
    pub fn crush_energy(&self, profile: &Profile<T>) -> Result<T, CrushError> {
        self.fold(profile, T::ZERO, |sum, zone, stiffness| sum + zone_energy(zone, stiffness))
    }

    /// (N) the force at maximum crush: [`peak_force`], zone by zone where the stiffness differs along the
    /// side.
    ///
    /// # Errors
    /// If the number of stiffnesses is not that of the profile's zones, or |α| ≥ π/2.
    pub fn peak_force(&self, profile: &Profile<T>, oblique_angle: T) -> Result<T, CrushError> {
        let cos = pushing_cosine(oblique_angle)?;
        let force = self.fold(profile, T::ZERO, |sum, zone, stiffness| sum + zone_force(zone, stiffness))?;
        // F = F_n / cos α
        Ok(force / cos)
    }

    /// Goes through the zones of a profile, each with its stiffness.
    pub(crate) fn fold<A>(
        &self,
        profile: &Profile<T>,
        start: A,
        add: impl Fn(A, Zone<T>, &Stiffness<T>) -> A,
    ) -> Result<A, CrushError> {
        match self {
            Self::Uniform(stiffness) => {
                Ok(profile.zones().fold(start, |sum, zone| add(sum, zone, stiffness)))
            }
            Self::Zones(stiffnesses) => {
                let zones = profile.depths().len() - 1;
                if stiffnesses.len() != zones {
                    return Err(CrushError::ZoneCount { zones, stiffnesses: stiffnesses.len() });
                }
                let both = profile.zones().zip(stiffnesses);
                Ok(both.fold(start, |sum, (zone, stiffness)| add(sum, zone, stiffness)))
            }
        }
    }
}

/// The correction of the crush energy for a force at an angle α to the normal of the damaged side: a factor
/// on the energy.
///
/// Code that depends on the variant matches without a catch-all arm, so that a new one must be decided there
/// before it compiles; adding one is a breaking change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ObliqueCorrection<T = f64> {
    /// 1 + tan²α with |α| limited to 45°, so never more than 2: CRASH3.
    #[default]
    Capped,
    /// 1 + tan²α for any α: the paper's tables.
    Uncapped,
    /// No correction.
    None,
    /// 1 + min(|tan α|, μ) |tan α|: the tangential part of the force is limited by the friction coefficient μ
    /// ≥ 0. After McHenry and McHenry, SAE 861894. The paper was not available to check its exact form: this
    /// is the form in which others cite it, with a tangential force no greater than tan α requires.
    Friction(T),
    /// 1/cos α: the work of the oblique force along its own line, after Fonda (SAE 1999-01-0106) and SAE
    /// 2006-01-0908.
    Secant,
}

/// The factor of an oblique force on the crush energy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ObliqueFactor<T = f64> {
    /// The factor on the crush energy.
    pub factor: T,
    /// Whether CRASH3's limit of 45° was in effect.
    pub capped: bool,
}

impl<T: Real> ObliqueCorrection<T> {
    /// The factor on the crush energy for a force at the angle α (rad) to the normal of the damaged side.
    ///
    /// # References
    /// SAE 980025, Eq 8.
    ///
    /// # Errors
    /// If |α| ≥ π/2, because such a force does not push on the side (without correction every angle is
    /// accepted), or if the friction coefficient is negative or not finite.
    pub fn factor(self, oblique_angle: T) -> Result<ObliqueFactor<T>, CrushError> {
        let (factor, capped) = match self {
            Self::None => (T::ONE, false),
            Self::Uncapped => (one_plus_tan_squared(oblique_angle)?, false),
            Self::Capped => {
                let factor = one_plus_tan_squared(oblique_angle)?;
                if factor > T::from(CAP * (1.0 + f64::EPSILON * 4.0)) {
                    (T::from(CAP), true)
                } else {
                    (factor, false)
                }
            }
            Self::Friction(friction) => {
                error::not_negative("friction coefficient of the oblique correction", friction.value())?;
                let cos = pushing_cosine(oblique_angle)?;
                let (sin, _) = oblique_angle.sin_cos();
                let tan = (sin / cos).abs();
                // 1 + min(|tan α|, μ) |tan α|
                (tan.min(friction) * tan + 1.0, false)
            }
            // 1/cos α
            Self::Secant => (T::ONE / pushing_cosine(oblique_angle)?, false),
        };
        Ok(ObliqueFactor { factor, capped })
    }
}

/// 1 + tan² 45°.
const CAP: f64 = 2.0;

fn one_plus_tan_squared<T: Real>(oblique_angle: T) -> Result<T, CrushError> {
    let cos = pushing_cosine(oblique_angle)?;
    // 1 + tan²α = 1/cos²α
    Ok(T::ONE / (cos * cos))
}

/// cos α for a force that pushes on the side.
pub(crate) fn pushing_cosine<T: Real>(oblique_angle: T) -> Result<T, CrushError> {
    let (_, cos) = oblique_angle.sin_cos();
    // A NaN angle fails here too; a cosine that is only rounding at π/2 does not count as pushing.
    if cos > T::from(1e-9) { Ok(cos) } else { Err(CrushError::NotPushing { angle: oblique_angle.value() }) }
}
