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
