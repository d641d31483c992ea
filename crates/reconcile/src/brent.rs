//! A bracketed root-finder for one real function.

use real::Real;

/// Maximum number of evaluations in [`brent`] after the two at the ends of the bracket. Halving alone
/// resolves a bracket to double precision in 53 steps, and useless interpolations leave that many.
pub const MAX_STEPS: usize = 64;

/// 2⁶⁰: a bracket longer than this many times its resolution must be halved at once, for halving to finish
/// two steps before the last.
const HALVING_REACH: f64 = (1_u64 << (MAX_STEPS - 4)) as f64;

/// Why there is no root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RootError {
    /// The function has the same sign at both ends, or is not a number there; or the ends are infinitely far
    /// apart.
    NotBracketed {
        /// Values at the ends.
        ends: [f64; 2],
    },
    /// [`MAX_STEPS`] evaluations were not enough.
    NotConverged {
        /// Last point tried.
        last: f64,
        /// Value there.
        residual: f64,
    },
}

/// A root of `f` between `a` and `b`, where `f` must have opposite signs; an end that is a root is returned
/// at once.
///
/// Guarantee: the root stays bracketed throughout, and the answer lies within `tolerance`, plus four rounding
/// units of its magnitude, of a change of sign. Every evaluation between the ends is passed to `observe` as
/// (x, f(x)).
///
/// # References
/// R. P. Brent, *Algorithms for Minimization without Derivatives* (1973), chapter 4.
///
/// # Errors
/// [`RootError`] if the signs are equal, a value is NaN, the length of the bracket is not finite, or
/// [`MAX_STEPS`] evaluations do not reach the tolerance.
pub fn brent(
    f: impl Fn(f64) -> f64,
    ends: [f64; 2],
    tolerance: f64,
    observe: impl FnMut(f64, f64),
) -> Result<f64, RootError> {
    let [a, b] = ends;
    let ends = ends.map(|x| (x, f(x)));
    if !(b - a).is_finite() {
        return Err(RootError::NotBracketed { ends: ends.map(|(_, value)| value) });
    }
    brent_between(f, ends, tolerance, observe)
}

/// Like [`brent`], with known values at the ends: each is (x, f(x)).
pub(crate) fn brent_between(
    f: impl Fn(f64) -> f64,
    [(mut a, mut fa), (mut b, mut fb)]: [(f64, f64); 2],
    tolerance: f64,
    mut observe: impl FnMut(f64, f64),
) -> Result<f64, RootError> {
    if fa == 0.0 {
        return Ok(a);
    }
    if fb == 0.0 {
        return Ok(b);
    }
    if fa.is_nan() || fb.is_nan() || (fa < 0.0) == (fb < 0.0) {
        return Err(RootError::NotBracketed { ends: [fa, fb] });
    }
    // b is the best point, a the one before it, c the other side of the bracket.
    let (mut c, mut fc) = (a, fa);
    let mut step = b - a;
    let mut previous_step = step;
    let mut halving_reach = HALVING_REACH;
    for _ in 0..MAX_STEPS {
        if (fb < 0.0) == (fc < 0.0) {
            (c, fc) = (a, fa);
            step = b - a;
            previous_step = step;
        }
        if fc.abs() < fb.abs() {
            (a, b, c) = (b, c, b);
            (fa, fb, fc) = (fb, fc, fb);
        }
        let resolution = 2.0 * f64::EPSILON * b.abs() + 0.5 * tolerance;
        let half = 0.5 * (c - b);
        if half.abs() <= resolution || fb == 0.0 {
            return Ok(b);
        }
        // Brent's own bound on the number of steps is the square of that of halving.
        let must_halve = half.abs() > resolution * halving_reach;
        halving_reach *= 0.5;
        let (trial, reach) = if must_halve || previous_step.abs() < resolution || fa.abs() <= fb.abs() {
            (half, half)
        } else {
            let interpolated = interpolate([a, b, c], [fa, fb, fc]);
            let limit = (1.5 * half).abs() - 0.5 * resolution;
            // Towards c, at most three quarters of the distance to it, and less than half the step before
            // last.
            if interpolated * half > 0.0
                && interpolated.abs() < limit
                && 2.0 * interpolated.abs() < previous_step.abs()
            {
                (interpolated, step)
            } else {
                (half, half)
            }
        };
        previous_step = reach;
        step = trial;
        (a, fa) = (b, fb);
        b += if step.abs() > resolution { step } else { resolution.copysign(half) };
        fb = f(b);
        if fb.is_nan() {
            return Err(RootError::NotConverged { last: b, residual: fb });
        }
        observe(b, fb);
    }
    Err(RootError::NotConverged { last: b, residual: fb })
}

/// The ends of a narrowed bracket are within this factor of each other, 2^¼.
const NARROW: f64 = 1.189_207_115_002_721;

/// Narrows a bracket with a lower end of zero or more until its ends have nearly the same size; each end is
/// (x, f(x)). [`brent`] resolves a root relative to its size, and may need more than [`MAX_STEPS`] if the
/// root is small compared with its bracket.
pub(crate) fn narrowed(f: impl Fn(f64) -> f64, [mut low, mut high]: [(f64, f64); 2]) -> [(f64, f64); 2] {
    let below = low.1 < 0.0;
    while high.0 > NARROW * low.0 {
        let x = if low.0 > 0.0 { Real::sqrt(low.0) * Real::sqrt(high.0) } else { high.0 / 1024.0 };
        if x == 0.0 {
            break;
        }
        let value = f(x);
        if (value < 0.0) == below {
            low = (x, value);
        } else {
            high = (x, value);
        }
    }
    [low, high]
}

/// The step from b to the zero of the inverse parabola through the three points (a secant if a = c).
fn interpolate([a, b, c]: [f64; 3], [fa, fb, fc]: [f64; 3]) -> f64 {
    let s = fb / fa;
    let (p, q) = if a == c {
        ((c - b) * s, 1.0 - s)
    } else {
        let (q, r) = (fa / fc, fb / fc);
        (s * ((c - b) * q * (q - r) - (b - a) * (r - 1.0)), (q - 1.0) * (r - 1.0) * (s - 1.0))
    };
    -p / q
}

#[cfg(test)]
mod tests;
