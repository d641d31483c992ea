//! From the direction of the force to the angle at the damaged side and the moment arm.

use real::Real;

use std::f64::consts::{FRAC_PI_2, PI};

/// The damaged side of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The front.
    Front,
    /// The right side.
    Right,
    /// The rear.
    Rear,
    /// The left side.
    Left,
}

impl Side {
    /// (rad) direction of the side's outward normal, clockwise from the heading: the PDOF of a force that meets it squarely.
    #[must_use]
    pub fn square_pdof(self) -> f64 {
        match self {
            Self::Front => 0.0,
            Self::Right => FRAC_PI_2,
            Self::Rear => PI,
            Self::Left => -FRAC_PI_2,
        }
    }

    /// (rad) α: angle between a force with the given PDOF (rad, in (−π, π]) and the normal of this side, in (−π, π], clockwise positive
    /// like the PDOF. The force pushes on the side where |α| < π/2.
    #[inline(always)]
    #[must_use]
    pub fn oblique_angle<T: Real>(self, pdof: T) -> T {
        // α = PDOF − PDOF of a square hit
        let angle = pdof - self.square_pdof();
        if angle > T::from(PI) {
            angle - 2.0 * PI
        } else if angle <= T::from(-PI) {
            angle + 2.0 * PI
        } else {
            angle
        }
    }
}

/// (m) h: distance of the CG from the line of action of a force with the given PDOF (rad) through a point that lies at
/// (`forward`, `left`) (m) of the CG in the vehicle's own axes.
#[inline(always)]
#[must_use]
pub fn moment_arm<T: Real>([forward, left]: [T; 2], pdof: T) -> T {
    let (sin, cos) = pdof.sin_cos();
    // h = |r × f| with the direction of the push f = (−cos PDOF, sin PDOF) in (forward, left)
    (forward * sin + left * cos).abs()
}
