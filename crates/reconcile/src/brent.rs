//! A bracketed root-finder for one real function.

use real::Real;

/// Most evaluations that [`brent`] makes beyond the two at the ends of the bracket. Halving alone resolves a
/// bracket to double precision in 53 steps, and interpolation that is of no use leaves that many.
pub const MAX_STEPS: usize = 64;

/// 2⁶⁰: more than this many times its resolution is a bracket that halving has to begin with at once, to be
/// done two steps before the last.
const HALVING_REACH: f64 = (1_u64 << (MAX_STEPS - 4)) as f64;

/// Why there is no root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RootError {
    /// The function has the same sign at both ends, or is not a number there.
    NotBracketed {
        /// Values at the ends.
        ends: [f64; 2],
    },
    /// [`MAX_STEPS`] were not enough.
    NotConverged {
        /// Last point tried.
        last: f64,
        /// Value there.
        residual: f64,
    },
}

/// A root of `f` between `a` and `b`, at which `f` must have opposite signs; an end that is a root is
/// returned at once.
///
/// Guarantee: the root stays bracketed throughout, and the answer lies within `tolerance`, plus 4 units of
/// rounding of its size, of a change of sign. Every evaluation between the ends goes to `observe` as (x,
/// f(x)).
///
/// # References
/// R. P. Brent, *Algorithms for Minimization without Derivatives* (1973), chapter 4.
///
/// # Errors
/// [`RootError`] where the signs are equal or a value is NaN, or where [`MAX_STEPS`] do not reach the
/// tolerance.
pub fn brent(
    f: impl Fn(f64) -> f64,
    ends: [f64; 2],
    tolerance: f64,
    observe: impl FnMut(f64, f64),
) -> Result<f64, RootError> {
    let ends = ends.map(|x| (x, f(x)));
    brent_between(f, ends, tolerance, observe)
}

/// The same between ends whose values are known: each is (x, f(x)).
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
        // Brent's own bound on the steps is the square of that of halving.
        let must_halve = half.abs() > resolution * halving_reach;
        halving_reach *= 0.5;
        let (trial, reach) = if must_halve || previous_step.abs() < resolution || fa.abs() <= fb.abs() {
            (half, half)
        } else {
            let interpolated = interpolate([a, b, c], [fa, fb, fc]);
            let limit = (1.5 * half).abs() - 0.5 * resolution;
            // Towards c, not past three quarters of the way, and less than half the step before last.
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

/// A bracket of the same change of sign with ends of nearly one size, from one whose lower end is zero or
/// more; each end is (x, f(x)). [`brent`] resolves a root relative to its size, and may need more than
/// [`MAX_STEPS`] for one that is small beside its bracket.
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

/// The step from b at which the inverse parabola through the three points (a secant where a = c) is zero.
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
