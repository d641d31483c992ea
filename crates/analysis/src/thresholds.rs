//! What the checks and the warnings hold values against.

use std::f64::consts::PI;

/// Newton's third law: the peak forces of the two vehicles should be the same. Stiffness and crush are
/// uncertain, but not by more than this factor.
pub(crate) const FORCE_RATIO: f64 = 2.0;
/// (rad) how far a PDOF judged by eye may be from the computed one: 10°.
pub(crate) const PDOF_DIFFERENCE: f64 = 10.0 * PI / 180.0;
/// (rad) how far a PDOF may be from the hour of the clock that is given for it: half of an hour, 15°.
pub(crate) const HALF_HOUR: f64 = 15.0 * PI / 180.0;
/// Restitution falls with closing speed: above [`FAST_CLOSING`], more than this is not seen in vehicle
/// collisions.
pub const HIGH_RESTITUTION: f64 = 0.3;
/// (m/s) see [`CheckedQuantity::Restitution`](crate::CheckedQuantity::Restitution)
pub const FAST_CLOSING: f64 = 15.0;
/// How far the work of the normal impulse may be from the crush energy.
pub(crate) const ENERGY_DIFFERENCE: f64 = 0.1;
/// How far the crush energy may be from the normal work that momentum implies, as a share: on the RICSAC
/// collisions the two differ by half in the rms of the logarithm.
pub(crate) const MOMENTUM_ENERGY_DIFFERENCE: f64 = 0.5;
/// How far the restitution that momentum implies may be from the one of the case or, where that gives none,
/// outside of 0 to 1. A choice: no source gives a limit.
pub(crate) const RESTITUTION_DIFFERENCE: f64 = 0.2;
/// How far the impulse ratio that momentum implies may lie outside of 0 to μ_c: an error of 5° in the
/// direction of the impulse.
pub(crate) const RATIO_BEYOND: f64 = 0.1;
/// How far a way may pass from a point on it, as a share of the way: EDCRASH's limit for a point on the curve
/// and the end of rotation (its manual).
pub(crate) const POINT_MISSED: f64 = 0.15;
/// (m) how far the line of action of the impulse may be from the contact point: the place of C on a damage a
/// metre wide is not known better.
pub(crate) const ARM_DIFFERENCE: f64 = 0.2;
/// (–) standard deviation of a speed after the impact, as a share of it: what a measured rest leaves of it, 7
/// to 15 %, in simulations of vehicles that roll or spin to their rest.
pub(crate) const SPEED_AFTER_ERROR: f64 = 0.12;
/// (rad) standard deviation of the direction after the impact: 8°. With these two, 18 of 19 speeds of the
/// RICSAC collisions lay in their intervals of 95 %.
pub(crate) const DIRECTION_AFTER_ERROR: f64 = 8.0 * PI / 180.0;
/// (–) usual error of a recorder's ΔV, of its logarithm.
pub(crate) const RECORDER_DELTA_V_ERROR: f64 = 0.08;
/// (–) usual error of a recorder's speed, and of one where a skid begins: a standard deviation.
pub(crate) const RECORDER_SPEED_ERROR: f64 = 0.04;
