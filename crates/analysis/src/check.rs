//! The comparison of a check.

use std::f64::consts::PI;

use inputs::Axes;
use pim_core::VehicleId;

use crate::codes::codes;
use crate::travel::Pass;

/// (rad) more than the rounding error of sums of a few angles within a turn or two.
const ANGLE_ROUNDING: f64 = 1e-12;

/// (rad/s) a turn a second: a difference between the yaw rates of vehicles after an impact is rarely as
/// large.
const FASTEST_TURN: f64 = 2.0 * PI;

/// (–) half of what is possible: a limit as wide holds nearly every restitution of vehicles.
const WIDEST_RESTITUTION: f64 = 0.5;

/// (–) a limit of this factor or more tells nothing of two energies.
const WIDEST_FACTOR: f64 = 4.0;

/// (–) the factor between two energies for a maximum relative difference from the second, upward or downward.
#[must_use]
pub fn limit_factor(is_more: bool, difference: f64) -> f64 {
    if is_more { 1.0 + difference } else { 1.0 / (1.0 - difference) }
}

/// One comparison. Values are in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Check {
    /// The kind of comparison.
    pub quantity: CheckedQuantity,
    /// The value found.
    pub value: f64,
    /// The largest value allowed or, for a direction of rotation, the smallest.
    pub limit: f64,
}

/// The compared quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CheckedQuantity {
    /// The ratio of the larger peak force to the smaller: by Newton's third law, 1.
    ForceBalance,
    /// (rad) how far the two directions of force that the file gives are from opposite.
    PdofsOpposite,
    /// |W_n + λ W_t − E|/E.
    DamageEnergy {
        /// (J) W_n + λ W_t, with λ from the case's basis: 0 unless that is a share of the tangential work.
        normal_work: f64,
        /// (J) E, the part of the crush energy that the impact dissipates on the case's basis.
        crush_energy: f64,
    },
    /// e above 15 m/s of closing speed: at most 0.3. Below that speed every possible e is acceptable, so
    /// there is no check.
    Restitution,
    /// (N·m·s) moment about the CG of the impulse that acts along the line of action of the file's PDOF, or
    /// of the computed one if a moment impulse acts too; positive in the sense of the change of the yaw rate.
    /// Without either, the impulse alone makes the change (I ΔΩ = r × P), and there is nothing to compare it
    /// with.
    Rotation {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// |W_n + λ W_t − E|/E with the works that both speeds and the velocities after the impact imply.
    MomentumEnergy {
        /// (J) W_n + λ W_t.
        normal_work: f64,
        /// (J) E, on the case's basis.
        crush_energy: f64,
        /// (–) λ.
        tangential_share: f64,
    },
    /// (N·s) momentum across the heading of the vehicle whose speed was found, for which no speed of it
    /// accounts.
    MomentumAcross {
        /// The vehicle.
        vehicle: VehicleId,
        /// (N·s) to the left of its heading, or to the right in z-down axes.
        surplus: f64,
    },
    /// (–) the difference of the impulses that the velocities of both vehicles imply, as a share of their
    /// mean: beyond 1, momentum says nothing of the impact.
    MomentumBalance {
        /// (N·s) the difference.
        difference: f64,
        /// (N·s) the mean.
        impulse: f64,
    },
    /// How far the restitution that they imply lies outside 0 to 1, if the case gives none.
    PossibleRestitution {
        /// (–) as implied.
        implied: f64,
    },
    /// The difference between the restitution that they imply and that of the case.
    MomentumRestitution {
        /// (–) as implied.
        implied: f64,
        /// (–) of the case, at this closing speed.
        given: f64,
    },
    /// How far the impulse ratio that they imply lies outside 0 to μ_c.
    MomentumRatio {
        /// (–) as implied.
        implied: f64,
        /// (–) μ_c.
        critical: f64,
    },
    /// (rad/s) the difference between the yaw rate after the impact by the impulse at C and the one by the
    /// rest position or the case.
    MomentumYawRate {
        /// The vehicle.
        vehicle: VehicleId,
        /// (rad/s) by the impulse at C.
        implied: f64,
        /// (rad/s) by the rest position, or as given.
        told: f64,
    },
    /// (rad) the difference between the PDOF that they imply and that of the case.
    MomentumPdof {
        /// The vehicle.
        vehicle: VehicleId,
        /// (rad) as implied.
        implied: f64,
        /// (rad) of the case.
        given: f64,
    },
    /// By how much the path to rest misses a point, in position or by the turn of the wheelbase if that is
    /// more, as a share of the path.
    PointMissed {
        /// The vehicle.
        vehicle: VehicleId,
        /// The number of the point, counted from 1.
        point: usize,
        /// How the path passes it.
        pass: Pass,
    },
    /// How far the path to the measured rest position ends from it, as a share of the path.
    RestMissed {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m) that distance.
        miss: f64,
    },
}

impl CheckedQuantity {
    codes! {
        ForceBalance => "force-balance",
        PdofsOpposite => "pdofs-opposite",
        DamageEnergy => "damage-energy",
        Restitution => "restitution",
        Rotation { vehicle } => "rotation",
        MomentumEnergy => "momentum-energy",
        MomentumAcross { vehicle } => "momentum-across",
        MomentumBalance => "momentum-balance",
        PossibleRestitution => "possible-restitution",
        MomentumRestitution => "momentum-restitution",
        MomentumRatio => "momentum-ratio",
        MomentumYawRate { vehicle } => "momentum-yaw-rate",
        MomentumPdof { vehicle } => "momentum-pdof",
        PointMissed { vehicle } => "point-missed",
        RestMissed { vehicle } => "rest-missed",
    }
}

impl Check {
    /// Whether the value is within the limit.
    #[must_use]
    pub fn passed(&self) -> bool {
        match self.quantity {
            CheckedQuantity::Rotation { .. } => self.value >= self.limit,
            // Two adjacent hours are exactly at the limit.
            CheckedQuantity::PdofsOpposite => self.value <= self.limit + ANGLE_ROUNDING,
            _ => self.value <= self.limit,
        }
    }

    /// Whether a value beyond the limit can occur at all: the limit of a comparison with momentum is that of
    /// its errors, which may be wider than anything that happens.
    #[must_use]
    pub fn can_fail(&self) -> bool {
        match self.quantity {
            CheckedQuantity::MomentumYawRate { .. } => self.limit < FASTEST_TURN,
            CheckedQuantity::MomentumRestitution { .. } => self.limit < WIDEST_RESTITUTION,
            CheckedQuantity::MomentumEnergy { normal_work, crush_energy, .. } => {
                limit_factor(normal_work > crush_energy, self.limit) < WIDEST_FACTOR
            }
            _ => true,
        }
    }

    /// The name in JSON.
    #[must_use]
    pub fn code(&self) -> &'static str {
        self.quantity.code()
    }

    /// The check with its numbers in the given axes.
    pub(crate) fn in_axes(self, axes: Axes) -> Self {
        let turned = |value: f64| axes.lateral(value);
        let quantity = match self.quantity {
            CheckedQuantity::MomentumRatio { implied, critical } => {
                CheckedQuantity::MomentumRatio { implied: turned(implied), critical: turned(critical) }
            }
            CheckedQuantity::MomentumAcross { vehicle, surplus } => {
                CheckedQuantity::MomentumAcross { vehicle, surplus: turned(surplus) }
            }
            CheckedQuantity::MomentumYawRate { vehicle, implied, told } => {
                CheckedQuantity::MomentumYawRate { vehicle, implied: turned(implied), told: turned(told) }
            }
            CheckedQuantity::PointMissed { vehicle, point, pass } => {
                CheckedQuantity::PointMissed { vehicle, point, pass: pass.in_axes(axes) }
            }
            other => other,
        };
        Self { quantity, ..self }
    }

    /// Whether it compares momentum with other evidence.
    #[must_use]
    pub fn is_of_momentum(&self) -> bool {
        matches!(
            self.quantity,
            CheckedQuantity::MomentumEnergy { .. }
                | CheckedQuantity::MomentumAcross { .. }
                | CheckedQuantity::MomentumBalance { .. }
                | CheckedQuantity::PossibleRestitution { .. }
                | CheckedQuantity::MomentumRestitution { .. }
                | CheckedQuantity::MomentumRatio { .. }
                | CheckedQuantity::MomentumYawRate { .. }
                | CheckedQuantity::MomentumPdof { .. }
        )
    }
}
