//! Errors: no speed reconciles the crush energy with the impact.

use core::fmt::{self, Display};

use crash3::EnergyBasis;
use pim_core::{ImpactError, InvalidInput, VehicleId};

/// Why a reconciliation has no answer.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReconcileError {
    /// There is no crush energy to match.
    #[error(
        "the crush energy is {energy} J, but must be greater than zero, because without crush there is no \
         speed to find; check \
         the depths and the stiffness of both vehicles"
    )]
    NoCrushEnergy {
        /// (J) the crush energy.
        energy: f64,
    },
    /// e = 1: W_n is zero at every speed.
    #[error(
        "with a restitution of {restitution} the normal impulse dissipates no energy at any speed, so no \
         speed fits the crush energy; give a restitution below 1"
    )]
    NoRestitutionLoss {
        /// e.
        restitution: f64,
    },
    /// The crush cannot take this share of the tangential work.
    #[error(
        "the tangential share is {share}, but must lie between 0 and 1, and be 0 on the basis `absorbed`; \
         it is the share of the tangential work that the crush takes"
    )]
    TangentialShare {
        /// λ.
        share: f64,
        /// The basis.
        basis: EnergyBasis,
    },
    /// The vehicle whose speed is sought is a barrier.
    #[error("vehicle {vehicle} is fixed and has no speed to find; find the other vehicle's speed")]
    Fixed {
        /// Which vehicle.
        vehicle: VehicleId,
    },
    /// The vehicle moves along the crush plane, so that its speed does not change u_n.
    #[error(
        "vehicle {vehicle} heads along the crush plane (at 90° to its normal but for a cosine of \
         {cosine:.1e}), so its speed does not change the normal work; check its heading and the crush \
         plane, or find \
         the other vehicle's speed instead"
    )]
    SpeedWithoutEffect {
        /// Which vehicle.
        vehicle: VehicleId,
        /// Cosine of the angle between heading and normal.
        cosine: f64,
    },
    /// W_n + λ W_t does not reach the crush energy at any speed (up to 1000 m/s) at which the vehicles
    /// approach.
    #[error(
        "no speed of vehicle {vehicle} up to 1000 m/s makes {} equal to {energy:.1} J while \
         the vehicles approach and push; check the contact points, the crush plane, the headings, the yaw rates, the \
         restitution and the crush energy, or give a friction limit as the tangential condition",
        WorkSought(*.tangential_share)
    )]
    NotReached {
        /// Which vehicle.
        vehicle: VehicleId,
        /// (J) the work sought.
        energy: f64,
        /// (–) λ.
        tangential_share: f64,
    },
    /// A speed gives the energy, but the impact at that speed is impossible.
    #[error("at {speed:.4} m/s vehicle {vehicle} would give the crush energy, but: {reason}")]
    Inadmissible {
        /// Which vehicle.
        vehicle: VehicleId,
        /// (m/s) the speed.
        speed: f64,
        /// The reason why the impact at that speed is impossible.
        reason: ImpactError,
    },
    /// No impact is possible at any speed.
    #[error(transparent)]
    Impact(#[from] ImpactError),
    /// The root-finder stopped short of its tolerance.
    #[error(
        "the search for the speed did not converge: {last:.9} m/s still misses the crush energy by \
         {residual:.3e} J; check \
         the input for extreme values, or try another tangential condition"
    )]
    NotConverged {
        /// (m/s) last speed tried.
        last: f64,
        /// (J) the residual there.
        residual: f64,
    },
}

/// W_n + λ W_t in words, for the share λ.
pub(crate) struct WorkSought(pub(crate) f64);

impl Display for WorkSought {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the work of the normal impulse")?;
        if self.0 == 0.0 {
            return Ok(());
        }
        write!(f, " plus {} of that of the tangential impulse", self.0)
    }
}

impl ReconcileError {
    /// The same refusal in axes of the other handedness, as [`ImpactError::mirrored`].
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::Inadmissible { vehicle, speed, reason } => {
                Self::Inadmissible { vehicle, speed, reason: reason.mirrored() }
            }
            Self::Impact(reason) => Self::Impact(reason.mirrored()),
            unsigned => unsigned,
        }
    }
}

impl From<InvalidInput> for ReconcileError {
    fn from(invalid: InvalidInput) -> Self {
        Self::Impact(invalid.into())
    }
}
