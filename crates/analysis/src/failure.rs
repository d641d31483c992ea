//! Why there is no analysis.

use ::estimate::NoDraws;
use crash3::CrushError;
use inputs::Faults;
use pim_core::{ImpactError, VehicleId};
use reconcile::{Iteration, MomentumError, ReconcileError};
use trajectory::{NoRest, Unreached};

use crate::excluded::Impossible;

/// Why there is no analysis.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The case lacks something or contradicts itself.
    #[error(transparent)]
    Case(#[from] Faults),
    /// No speed reconciles crush and impact.
    #[error(transparent)]
    Reconcile(#[from] ReconcileError),
    /// No speed gives the crush energy, [`ReconcileError::NotReached`].
    #[error(
        "{}",
        ReconcileError::NotReached {
            vehicle: *.vehicle,
            energy: *.energy,
            tangential_share: *.tangential_share
        }
    )]
    NotReached {
        /// The vehicle whose speed is unknown.
        vehicle: VehicleId,
        /// (J) the required work, W_n + λ W_t.
        energy: f64,
        /// (–) λ.
        tangential_share: f64,
        /// The nearest possible impact, or why none can happen.
        nearest: Result<Iteration, ImpactError>,
    },
    /// The impact has no answer.
    #[error(transparent)]
    Impact(#[from] ImpactError),
    /// The damage has no answer.
    #[error(transparent)]
    Crush(#[from] CrushError),
    /// Momentum does not give both speeds.
    #[error(transparent)]
    Momentum(#[from] MomentumError),
    /// A vehicle does not come to rest after the impact.
    #[error("vehicle {vehicle} does not come to rest: {reason}")]
    NoRest {
        /// The vehicle.
        vehicle: VehicleId,
        /// The reason.
        reason: NoRest,
    },
    /// No motion after the impact leads to the measured rest position.
    #[error("no motion after the impact brings vehicle {vehicle} to its rest: {reason}")]
    NoStart {
        /// The vehicle.
        vehicle: VehicleId,
        /// The reason.
        reason: Unreached,
    },
    /// The evidence excludes every collision.
    #[error("{0}")]
    Excluded(Box<Impossible>),
    /// The estimate has no draws.
    #[error(transparent)]
    Estimate(NoDraws),
    /// The likelihood of a piece of evidence cannot be computed.
    #[error("the likelihood of `{key}` cannot be computed")]
    Unjudged {
        /// The key of the piece.
        key: String,
    },
    /// Nothing is uncertain, or the requested samples are invalid.
    #[error(transparent)]
    Ranges(#[from] ::uncertainty::InvalidRequest),
}
