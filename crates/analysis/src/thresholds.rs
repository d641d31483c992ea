//! Limits and errors for the checks and the warnings.

use std::f64::consts::PI;

use real::Real;

/// Newton's third law: the peak forces of the two vehicles should be equal. Stiffness and crush are
/// uncertain, but not by more than this factor.
pub(crate) const FORCE_RATIO: f64 = 2.0;
/// (rad) how far a PDOF judged by eye may be from the computed one: 10°.
pub(crate) const PDOF_DIFFERENCE: f64 = 10.0 * PI / 180.0;
/// (rad) maximum distance of a PDOF from the hour of the clock that is given for it: half of an hour, 15°.
pub(crate) const HALF_HOUR: f64 = 15.0 * PI / 180.0;
/// Restitution falls with closing speed: above [`FAST_CLOSING`], more than this is not seen in vehicle
/// collisions.
pub const HIGH_RESTITUTION: f64 = 0.3;
/// (m/s) see [`CheckedQuantity::Restitution`](crate::CheckedQuantity::Restitution)
pub const FAST_CLOSING: f64 = 15.0;
/// (m/s) no vehicle is taken to have been faster unless the case says that it may have been: 252 km/h.
pub const FASTEST_BELIEVED: f64 = 70.0;
/// How far the work of the normal impulse may be from the crush energy.
pub const ENERGY_DIFFERENCE: f64 = 0.1;
/// How far CRASH3's ΔV may be from that of the impact, as a share of it.
pub const DELTA_V_DIFFERENCE: f64 = 0.1;
/// How far the restitution that momentum implies may lie outside 0 to 1 if nothing shows how well it is
/// known. A choice: no source gives a limit.
pub(crate) const RESTITUTION_DIFFERENCE: f64 = 0.2;
/// Limit in standard deviations for an implication of momentum, which one number in a hundred exceeds. With
/// the five that can be compared with other evidence, one collision in twenty then fails.
pub(crate) const SURE: f64 = 2.58;
/// (–) standard deviation of a restitution: those of staged collisions between 0 and
/// [`HIGH_RESTITUTION`] spread by about this.
pub(crate) const RESTITUTION_ERROR: f64 = 0.15;
/// (–) standard deviation of the impulse ratio: an error of 5° in the direction of the impulse, which varies
/// during an impact.
pub(crate) const RATIO_BEYOND: f64 = 0.1;
/// (rad) standard deviation of the crush plane, which is judged by eye: 5°.
pub(crate) const PLANE_ERROR: f64 = 5.0 * PI / 180.0;
/// (m) standard deviation of the contact point along either axis: half of the uncertainty of 0.2 m for a
/// damage a metre wide.
pub(crate) const ARM_ERROR: f64 = 0.1;
/// (–) standard deviation of a yaw rate from a rest position, as a share of it: like that of a speed, plus
/// that of the turn.
pub(crate) const YAW_RATE_SHARE: f64 = 0.15;
/// (rad/s) standard deviation of the yaw rate of a vehicle that hardly turned: 11°/s.
pub(crate) const YAW_RATE_ERROR: f64 = 0.2;
/// (–) two combinations of starts are both reported if the less likely one has more weight than this.
pub(crate) const COMPARABLE_WEIGHT: f64 = 0.2;
/// (m/s) and only if a speed differs by more than 12 km/h, about the error of a speed by momentum.
pub(crate) const MATERIAL_SPEED: f64 = 12.0 / 3.6;
/// (–) how far a path may end from the measured rest position, as a share of the path.
pub(crate) const REST_MISSED: f64 = 0.05;
/// (–) a vehicle that did not spin is traced back straight unless that path ends further from the rest
/// position than this share of it: a choice, below the limit of a warning.
pub(crate) const REST_SEARCHED: f64 = 0.03;
/// (m) the assumed accuracy of the survey of a rest position: a choice.
pub(crate) const REST_SURVEY: f64 = 0.25;
/// (m) the error of a computed rest or point that even a short path has.
pub(crate) const REST_LEAST: f64 = 0.5;
/// (rad/s) a vehicle with a slower yaw rate as it leaves the impact does not spin: 57°/s.
pub(crate) const SLOW_YAW: f64 = 1.0;
/// How far a path may miss a point, as a share of the path: EDCRASH's limit for a point on the curve and the
/// end of rotation (its manual).
pub const POINT_MISSED: f64 = 0.15;
/// (–) standard deviation of a speed after the impact, as a share of it: the uncertainty from a measured rest
/// position, 7 to 15 %, in simulations of vehicles that roll or spin to rest.
pub(crate) const SPEED_AFTER_ERROR: f64 = 0.12;
/// (rad) standard deviation of the direction after the impact: 8°. With these two, 18 of 19 speeds of the
/// RICSAC collisions lay in their intervals of 95 %.
pub(crate) const DIRECTION_AFTER_ERROR: f64 = 8.0 * PI / 180.0;
/// (–) usual error of the logarithm of a recorder's ΔV.
pub(crate) const RECORDER_DELTA_V_ERROR: f64 = 0.08;
/// (–) usual error of a recorder's speed, and of the speed at the start of a skid: a standard deviation.
pub(crate) const RECORDER_SPEED_ERROR: f64 = 0.04;

/// (rad/s) standard deviation of the error of a yaw rate (rad/s) after the impact: 20 % of it, and at least
/// 10°/s, that of a slow turn.
pub(crate) fn yaw_rate_error(rate: f64) -> f64 {
    Real::max(0.2 * rate.abs(), 10.0 * PI / 180.0)
}
