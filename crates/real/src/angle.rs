//! Angles that differ by full turns.

use core::f64::consts::{PI, TAU};

use crate::{Real, elementary};

/// (rad) the same direction in (−π, π].
#[must_use]
pub fn principal_angle<T: Real>(angle: T) -> T {
    // φ − 2π ⌈(φ − π)/2π⌉
    angle - TAU * elementary::ceil((angle.value() - PI) / TAU)
}
