//! Errors of the search for both speeds.

use crash3::EnergyBasis;
use pim_core::{ImpactError, InvalidInput, VehicleId};

use crate::answer::FASTEST;
use crate::error::WorkSought;

/// The reason why momentum, with or without the crush energy, does not give both speeds.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MomentumError {
    /// The ground takes momentum out of a fixed object.
    #[error(
        "vehicle {vehicle} is fixed, so the momentum of the vehicles is not kept and does not give their \
         speeds; find the other vehicle's speed from the crush energy"
    )]
    Fixed {
        /// Which vehicle.
        vehicle: VehicleId,
    },
    /// The body that was hit is no fixed object.
    #[error("vehicle {vehicle} can move, so it is no fixed object; find both speeds from momentum")]
    Movable {
        /// Which vehicle.
        vehicle: VehicleId,
    },
    /// An input is impossible.
    #[error(transparent)]
    Invalid(#[from] InvalidInput),
    /// The directions of travel are too close to one line for momentum alone.
    #[error(
        "the directions of travel differ by {:.2}°, which is within 10° of one line, so momentum alone does not give both \
         speeds; use momentum along this line together with the crush energy", .angle.abs().to_degrees()
    )]
    Collinear {
        /// (rad) the angle from the course of vehicle 1 to that of vehicle 2.
        angle: f64,
    },
    /// No vehicle is that fast: a number of the case is in the wrong unit.
    #[error(
        "momentum gives vehicle {vehicle} a speed of {speed:.4e} m/s, but no vehicle is faster than \
         {FASTEST:.0} m/s; check the masses and the motion after the impact, and their units"
    )]
    TooFast {
        /// Which vehicle.
        vehicle: VehicleId,
        /// (m/s) the speed.
        speed: f64,
    },
    /// The velocities do not change, so there was no impulse.
    #[error(
        "at the speeds that momentum gives, neither velocity changes in the impact, so there was none; check \
         the directions and speeds after the impact"
    )]
    NoImpulse,
    /// The motion after the impact with a wall does not determine the speed before it.
    #[error(
        "with a restitution of {restitution} the speed after the impact with a fixed object hardly depends on \
         the speed before it: 1 m/s before makes {slope:.3} m/s after; give the crush of vehicle {vehicle} to \
         find its speed, or the restitution that its path after the impact shows"
    )]
    NoReturn {
        /// Which vehicle.
        vehicle: VehicleId,
        /// (–) e.
        restitution: f64,
        /// (–) change of the speed after the impact per change of the speed before it, along the normal.
        slope: f64,
    },
    /// The vehicle would move away from the object that it hit.
    #[error(
        "to leave the fixed object like this, vehicle {vehicle} would have approached at {speed:.4} m/s along \
         its heading, but its heading does not point into the object; check the direction after the impact, \
         the heading and the crush plane"
    )]
    LeavesWall {
        /// Which vehicle.
        vehicle: VehicleId,
        /// (m/s) the speed.
        speed: f64,
    },
    /// The axis is not a unit vector.
    #[error("the axis of the momentum is a vector of length {length}, but must be of length 1")]
    NoAxis {
        /// (–) its length.
        length: f64,
    },
    /// Neither speed adds momentum along the axis.
    #[error(
        "both vehicles head across the axis of the momentum (cosines {:.1e} and {:.1e}), so it does not \
         depend on their speeds; take the axis along the headings", .cosines[0], .cosines[1]
    )]
    AcrossAxis {
        /// Cosines of the angles between the headings and the axis.
        cosines: [f64; 2],
    },
    /// The vehicles approach along the crush plane, at all speeds that the momentum allows.
    #[error(
        "the speeds that the momentum allows differ by a velocity along the crush plane (at 90° to its normal \
         but for a cosine of {cosine:.1e}), so the crush energy does not determine them; check the \
         headings and the crush plane"
    )]
    AlongCrushPlane {
        /// Cosine of the angle between that velocity and the normal.
        cosine: f64,
    },
    /// Without crush energy there is no second equation.
    #[error(
        "the crush energy is {energy} J, but must be greater than zero to give the speeds; check the depths \
         and the stiffness of both vehicles"
    )]
    NoCrushEnergy {
        /// (J) the crush energy.
        energy: f64,
    },
    /// e = 1: W_n is zero at all speeds.
    #[error(
        "with a restitution of {restitution} the normal impulse dissipates no energy, so no speeds fit the \
         crush energy; give a restitution below 1"
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
    /// W_n + λ W_t does not reach the crush energy at any speeds that the momentum allows.
    #[error(
        "no speeds with this momentum make {} equal to {energy:.1} J while the \
         vehicles approach and push; check the velocities after impact, the crush energy, the crush plane and \
         the restitution",
        WorkSought(*.tangential_share)
    )]
    NotReached {
        /// (J) the work sought.
        energy: f64,
        /// (–) λ.
        tangential_share: f64,
    },
    /// Speeds give momentum and energy, but the impact at these speeds is impossible.
    #[error(
        "at {:.4} and {:.4} m/s the vehicles would have the momentum and the crush energy, but: {reason}",
        .speeds[0], .speeds[1]
    )]
    Inadmissible {
        /// (m/s) the speeds.
        speeds: [f64; 2],
        /// The reason why the impact at these speeds is impossible.
        reason: ImpactError,
    },
    /// No impact is possible at any speeds with this momentum.
    #[error(transparent)]
    Impact(ImpactError),
    /// The root-finder stopped short of its tolerance.
    #[error(
        "the search for the speeds did not converge: {:.9} and {:.9} m/s still miss the crush energy by \
         {residual:.3e} J; check the input for extreme values", .speeds[0], .speeds[1]
    )]
    NotConverged {
        /// (m/s) the last speeds tried.
        speeds: [f64; 2],
        /// (J) the residual there.
        residual: f64,
    },
}

impl MomentumError {
    /// The same refusal in axes of the other handedness.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::Invalid(invalid) => Self::Invalid(invalid.mirrored()),
            Self::Collinear { angle } => Self::Collinear { angle: -angle },
            Self::Inadmissible { speeds, reason } => Self::Inadmissible { speeds, reason: reason.mirrored() },
            Self::Impact(reason) => Self::Impact(reason.mirrored()),
            unsigned => unsigned,
        }
    }
}
