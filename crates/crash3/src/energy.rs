//! Crush energy and crush force of one vehicle.

use real::Real;

use crate::error::CrushError;
use crate::profile::Profile;
use crate::stiffness::Stiffness;

/// (J) the energy that made the crush: the integral of A + B C over depth and width, for a profile that is linear
/// between its stations.
///
/// ERRATUM (theory, section 8): SAE 980025 prints its Eq 5, the case of six equal stations, with B/6 on the squares
/// only and 5G outside of L/5. This is the equation as it must read.
///
/// # References
/// SAE 980025, Eq 5.
#[inline(always)]
#[must_use]
pub fn crush_energy<T: Real>(profile: &Profile<T>, stiffness: &Stiffness<T>) -> T {
    let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
    let mut energy = T::ZERO;
    for zone in profile.zones() {
        let [c1, c2] = zone.depths;
        // E = Σⱼ wⱼ [ A (Cⱼ + Cⱼ₊₁)/2 + B (Cⱼ² + Cⱼ Cⱼ₊₁ + Cⱼ₊₁²)/6 + G ]
        energy += zone.width * (a * (c1 + c2) / 2.0 + b * (c1 * c1 + c1 * c2 + c2 * c2) / 6.0 + g);
    }
    energy
}

/// (N) the force at maximum crush, for a force at the angle α (rad) to the normal of the damaged side:
/// ∫(A + B C) dw / cos α. By Newton's third law both vehicles of a collision should show the same.
///
/// # Errors
/// Where |α| ≥ π/2: such a force does not push on the side.
pub fn peak_force<T: Real>(
    profile: &Profile<T>,
    stiffness: &Stiffness<T>,
    oblique_angle: T,
) -> Result<T, CrushError> {
    let cos = pushing_cosine(oblique_angle)?;
    let mut force = T::ZERO;
    for zone in profile.zones() {
        let [c1, c2] = zone.depths;
        // F_n = Σⱼ wⱼ [ A + B (Cⱼ + Cⱼ₊₁)/2 ]
        force += zone.width * (stiffness.a() + stiffness.b() * (c1 + c2) / 2.0);
    }
    // F = F_n / cos α
    Ok(force / cos)
}

/// How the energy of a force that is not normal to the damaged side is corrected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ObliqueCorrection {
    /// 1 + tan²α with |α| limited to 45°, so never more than 2: CRASH3.
    #[default]
    Capped,
    /// 1 + tan²α whatever α: the paper's tables.
    Uncapped,
    /// No correction.
    None,
}

/// The corrected share of an oblique force's energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObliqueFactor<T = f64> {
    /// What the crush energy is multiplied with.
    pub factor: T,
    /// Whether CRASH3's limit of 45° was in effect.
    pub capped: bool,
}

impl ObliqueCorrection {
    /// The factor on the crush energy for a force at the angle α (rad) to the normal of the damaged side.
    ///
    /// # References
    /// SAE 980025, Eq 8.
    ///
    /// # Errors
    /// Where |α| ≥ π/2: such a force does not push on the side. Without correction every angle is accepted.
    pub fn factor<T: Real>(self, oblique_angle: T) -> Result<ObliqueFactor<T>, CrushError> {
        if self == Self::None {
            return Ok(ObliqueFactor { factor: T::ONE, capped: false });
        }
        let cos = pushing_cosine(oblique_angle)?;
        // 1 + tan²α = 1/cos²α
        let factor = T::ONE / (cos * cos);
        let capped = self == Self::Capped && factor > T::from(CAP * (1.0 + f64::EPSILON * 4.0));
        Ok(ObliqueFactor { factor: if capped { T::from(CAP) } else { factor }, capped })
    }
}

/// 1 + tan² 45°.
const CAP: f64 = 2.0;

fn pushing_cosine<T: Real>(oblique_angle: T) -> Result<T, CrushError> {
    let (_, cos) = oblique_angle.sin_cos();
    // A NaN angle fails here too; a cosine of one rounding of π/2 is no push.
    if cos > T::from(1e-9) { Ok(cos) } else { Err(CrushError::NotPushing { angle: oblique_angle.value() }) }
}
