//! Log densities of errors, and normal scores of observations.

use core::f64::consts::{FRAC_2_PI, PI, SQRT_2};

use real::Real;
use real::elementary::{atan2, ln};

/// ln √(2π).
pub(crate) const LN_ROOT_TAU: f64 = 0.918_938_533_204_672_8;

/// (–) farther from zero no probability changes, and the square is finite.
const FARTHEST: f64 = 1e150;

/// Log density of an error `x` with a normal distribution about zero.
#[inline(always)]
pub(crate) fn normal(x: f64, sd: f64) -> f64 {
    // ln φ(x/σ)/σ = −x²/2σ² − ln σ√(2π)
    let z = x / sd;
    -0.5 * z * z - ln(sd) - LN_ROOT_TAU
}

/// arsinh x.
#[inline(always)]
fn arsinh(x: f64) -> f64 {
    // arsinh |x| = ln(|x| + √(x² + 1))
    let size = ln(x.abs() + Real::sqrt(x * x + 1.0));
    if x < 0.0 { -size } else { size }
}

/// (–) error of an `observed` number relative to the `predicted` one. Its error has a proportional part σ (–,
/// of the logarithm) and a part a at zero; the result is scaled to a standard deviation of σ for both.
///
/// Without a part at zero it is the difference of the logarithms.
#[inline(always)]
pub(crate) fn relative(observed: f64, predicted: f64, ln_sd: f64, at_zero: f64) -> f64 {
    if at_zero > 0.0 {
        // ε = arsinh(σy/a) − arsinh(σx/a), as dε/dy = σ/√(σ²y² + a²)
        let scale = ln_sd / at_zero;
        arsinh(scale * observed) - arsinh(scale * predicted)
    } else {
        // ε = ln(y/x)
        ln(observed / predicted)
    }
}

/// Log density of an error `x` about zero by Student's t with 2 degrees of freedom.
#[inline(always)]
pub(crate) fn student_of_two(x: f64, scale: f64) -> f64 {
    let z = x / scale;
    // f(z) = (1 + z²/2)^(−3/2)/(2√2)
    -1.5 * ln(1.0 + 0.5 * z * z) - ln(2.0 * SQRT_2 * scale)
}

/// The same with 3 degrees of freedom.
#[inline(always)]
pub(crate) fn student_of_three(x: f64, scale: f64) -> f64 {
    let z = x / scale;
    // f(z) = 2 (1 + z²/3)⁻²/(π√3)
    -2.0 * ln(1.0 + z * z / 3.0) - ln(scale * Real::sqrt(3.0) / FRAC_2_PI)
}

/// Degrees of freedom of Student's t: few, for errors that are occasionally far larger than usual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// ν = 2.
    Two,
    /// ν = 3.
    Three,
}

impl Freedom {
    /// Log density of an error `x` about zero.
    #[inline(always)]
    #[must_use]
    pub fn log_density(self, x: f64, scale: f64) -> f64 {
        match self {
            Self::Two => student_of_two(x, scale),
            Self::Three => student_of_three(x, scale),
        }
    }

    /// (–) cumulative probability at `z` (–), for scale 1 about zero.
    #[must_use]
    pub fn share_below(self, z: f64) -> f64 {
        let z = z.clamp(-FARTHEST, FARTHEST);
        match self {
            // F(z) = 1/2 + z/(2√(2 + z²))
            Self::Two => 0.5 + 0.5 * z / Real::sqrt(2.0 + z * z),
            // F(z) = 1/2 + [w/(1 + w²) + atan w]/π, w = z/√3
            Self::Three => {
                let w = z / Real::sqrt(3.0);
                0.5 + (w / (1.0 + w * w) + atan2(w, 1.0)) / PI
            }
        }
    }
}
