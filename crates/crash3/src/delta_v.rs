//! Velocity changes from the crush energy of both vehicles.

use real::Real;

use crate::error::{self, CrushError};

/// The properties of a vehicle that determine its velocity change for a given energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StruckVehicle<T = f64> {
    inverse_mass: T,
    square_radius: T,
    effective_mass_ratio: T,
    inverse_effective_mass: T,
}

impl<T: Real> StruckVehicle<T> {
    /// A vehicle of mass m (kg) and yaw inertia I (kg·m²), struck by a force whose line of action passes its
    /// CG at the distance h = `moment_arm` (m).
    ///
    /// # Errors
    /// If the mass or the inertia is not positive, or the arm is not finite.
    pub fn new(mass: T, yaw_inertia: T, moment_arm: T) -> Result<Self, CrushError> {
        error::positive("mass", mass.value())?;
        error::positive("yaw inertia", yaw_inertia.value())?;
        error::finite("moment arm", moment_arm.value())?;
        // k² = I/m
        let square_radius = yaw_inertia / mass;
        // γ = k²/(k² + h²)
        let effective_mass_ratio = square_radius / (square_radius + moment_arm * moment_arm);
        Ok(Self {
            inverse_mass: T::ONE / mass,
            square_radius,
            effective_mass_ratio,
            inverse_effective_mass: T::ONE / (effective_mass_ratio * mass),
        })
    }

    /// A barrier, which does not move.
    #[must_use]
    pub fn fixed() -> Self {
        Self {
            inverse_mass: T::ZERO,
            square_radius: T::ZERO,
            effective_mass_ratio: T::ONE,
            inverse_effective_mass: T::ZERO,
        }
    }

    /// (m²) k² = I/m, the square of the radius of gyration; zero for a barrier, which has none.
    #[inline(always)]
    #[must_use]
    pub fn square_radius(&self) -> T {
        self.square_radius
    }

    /// γ = k²/(k² + h²): the fraction of the mass that is effective against a force at the distance h from
    /// the CG.
    #[inline(always)]
    #[must_use]
    pub fn effective_mass_ratio(&self) -> T {
        self.effective_mass_ratio
    }
}

/// (m/s) ΔV_1 and ΔV_2 for the energy E = E_1 + E_2 (J) of both vehicles' crush, with the common normal
/// velocity that CRASH3 assumes (e = 0).
///
/// # References
/// SAE 980025, Eq 6 and Eq 7.
///
/// # Errors
/// If the energy is negative or not finite, or both vehicles are fixed.
pub fn delta_v<T: Real>(energy: T, vehicles: [StruckVehicle<T>; 2]) -> Result<[T; 2], CrushError> {
    error::not_negative("crush energy", energy.value())?;
    let [v1, v2] = vehicles;
    let inverse = v1.inverse_effective_mass + v2.inverse_effective_mass;
    if inverse == T::ZERO {
        return Err(CrushError::BothFixed);
    }
    // Eq 6, ΔV₁ = √( 2 γ₁ E / (m₁ (1 + γ₁m₁/γ₂m₂)) ), is J/m₁ with the impulse
    // J = √( 2E / (1/γ₁m₁ + 1/γ₂m₂) ), which serves Eq 7 and barriers as well.
    let impulse = (energy * 2.0 / inverse).sqrt();
    Ok([impulse * v1.inverse_mass, impulse * v2.inverse_mass])
}

/// The energy that the crush represents.
///
/// Code that depends on the variant matches without a catch-all arm, so that a new one must be decided there
/// before it compiles; adding one is a breaking change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum EnergyBasis {
    /// The energy that the normal impulse dissipated, W_n: SAE 980025.
    #[default]
    Dissipated,
    /// The energy absorbed at maximum engagement, W_n/(1−e²); restitution returns part of it. Stiffness
    /// coefficients fitted to barrier tests by impact speed give this energy (Ziernicki & Rose, SAE
    /// 2005-01-1200).
    Absorbed,
}

impl EnergyBasis {
    /// The factor on CRASH3's ΔV (e = 0) that takes the restitution e into account.
    ///
    /// # Errors
    /// If e lies outside [0, 1).
    pub fn restitution_factor<T: Real>(self, e: T) -> Result<T, CrushError> {
        if !(0.0..1.0).contains(&e.value()) {
            return Err(CrushError::Restitution { value: e.value() });
        }
        Ok(match self {
            // √( (1+e)/(1−e) )
            Self::Dissipated => ((e + 1.0) / (T::ONE - e)).sqrt(),
            // 1 + e
            Self::Absorbed => e + 1.0,
        })
    }

    /// (J) the energy W_n that the normal impulse dissipates if the crush energy of both vehicles is `energy`
    /// (J) on this basis and the restitution is e.
    #[inline(always)]
    #[must_use]
    pub fn dissipated<T: Real>(self, energy: T, e: T) -> T {
        match self {
            Self::Dissipated => energy,
            // W_n = E (1−e²)
            Self::Absorbed => energy * (T::ONE - e * e),
        }
    }
}

/// (m/s) energy equivalent speed: the speed at which the vehicle's kinetic energy equals its crush energy E
/// (J).
///
/// # Errors
/// If the energy is negative, the mass (kg) is not positive, or one of them is not finite.
pub fn energy_equivalent_speed<T: Real>(energy: T, mass: T) -> Result<T, CrushError> {
    error::not_negative("crush energy", energy.value())?;
    error::positive("mass", mass.value())?;
    // EES = √( 2E/m )
    Ok((energy * 2.0 / mass).sqrt())
}

/// (J) the crush energy of a vehicle whose energy equivalent speed is known: the inverse of
/// [`energy_equivalent_speed`].
///
/// # Errors
/// If the speed (m/s) is negative, the mass (kg) is not positive, or one of them is not finite.
pub fn energy_of_equivalent_speed<T: Real>(speed: T, mass: T) -> Result<T, CrushError> {
    error::not_negative("energy equivalent speed", speed.value())?;
    error::positive("mass", mass.value())?;
    // E = ½ m EES²
    Ok(mass * speed * speed / 2.0)
}
