//! Brent's method on functions with known roots.

use std::cell::Cell;

use oracle::compare::assert_close;
use oracle::scenes::for_all;
use reconcile::{MAX_STEPS, RootError, brent};

/// The root, and the evaluations between the ends.
fn solve(f: impl Fn(f64) -> f64, bracket: [f64; 2]) -> (Result<f64, RootError>, Vec<(f64, f64)>) {
    let mut steps = Vec::new();
    let root = brent(f, bracket, 0.0, |x, y| steps.push((x, y)));
    (root, steps)
}

#[test]
fn textbook_roots() {
    type Function = fn(f64) -> f64;
    // Wallis (1685) solved the first by Newton's new method; the second is Dottie's number.
    let cases: [(Function, [f64; 2], f64); 5] = [
        (|x| x * x * x - 2.0 * x - 5.0, [2.0, 3.0], 2.094_551_481_542_326_5),
        (|x| x.cos() - x, [0.0, 1.0], 0.739_085_133_215_160_6),
        (|x| x * x - 2.0, [0.0, 2.0], std::f64::consts::SQRT_2),
        (|x| x.exp() - 3.0, [0.0, 5.0], 1.098_612_288_668_109_8),
        (|x| 1.0 - x / 7.0, [-100.0, 100.0], 7.0),
    ];
    for (f, [a, b], root) in cases {
        for bracket in [[a, b], [b, a]] {
            let (found, steps) = solve(f, bracket);
            assert_close("the root", found.unwrap(), root, 4.0 * f64::EPSILON * root.abs());
            // Faster than bisection, which takes 53 steps.
            assert!(!steps.is_empty() && steps.len() <= 14, "{} steps", steps.len());
            for (x, y) in steps {
                assert!((a..=b).contains(&x));
                assert_eq!(y, f(x));
            }
        }
    }
}

#[test]
fn an_end_that_is_a_root_is_returned_at_once() {
    for bracket in [[2.0, 5.0], [-7.0, 2.0], [2.0, 2.0]] {
        let (found, steps) = solve(|x| x - 2.0, bracket);
        assert_eq!(found, Ok(2.0));
        assert!(steps.is_empty());
    }
    // Even if the sign does not change.
    assert_eq!(solve(|x| (x - 2.0) * (x - 2.0), [2.0, 5.0]).0, Ok(2.0));
}

#[test]
fn equal_signs_are_no_bracket() {
    assert_eq!(solve(|x| x * x + 1.0, [-1.0, 2.0]).0, Err(RootError::NotBracketed { ends: [2.0, 5.0] }));
    assert_eq!(solve(|x| -x * x - 1.0, [-1.0, 2.0]).0, Err(RootError::NotBracketed { ends: [-2.0, -5.0] }));
}

#[test]
fn ends_infinitely_far_apart_are_no_bracket() {
    for bracket in [[f64::NEG_INFINITY, f64::INFINITY], [0.0, f64::INFINITY], [-1e308, 1e308]] {
        let found = solve(|x| x - 0.5, bracket).0;
        assert!(matches!(found, Err(RootError::NotBracketed { .. })), "{found:?}");
    }
}

#[test]
fn nan_is_no_bracket_and_no_answer() {
    for bracket in [[f64::NAN, 1.0], [-1.0, f64::NAN]] {
        assert!(matches!(solve(|x| x, bracket).0, Err(RootError::NotBracketed { .. })));
    }
    let with_hole = |x: f64| if x.abs() < 0.9 { f64::NAN } else { x };
    let (found, _) = solve(with_hole, [-1.0, 1.0]);
    assert!(matches!(found, Err(RootError::NotConverged { residual, .. }) if residual.is_nan()), "{found:?}");
}

/// Interpolation is useless here, but the answer is still found in a bounded number of steps.
#[test]
fn hard_functions_take_bounded_steps() {
    let jump = |x: f64| if x < 0.7 { -1.0 } else { 1e6 };
    let flat = |x: f64| (x - 0.3).powi(9);
    let pole = |x: f64| 1.0 / (x - 0.2);
    let steep = |x: f64| (1e3 * (x - 0.123)).sinh();
    for (f, root) in [(&jump as &dyn Fn(f64) -> f64, 0.7), (&flat, 0.3), (&pole, 0.2), (&steep, 0.123)] {
        let (found, steps) = solve(f, [0.0, 1.0]);
        assert!(steps.len() <= MAX_STEPS);
        assert_close("the change of sign", found.unwrap(), root, 1e-9);
    }
}

#[test]
fn every_bracket_gets_an_answer() {
    // A cubic with a triple, a double or three roots, plus a jump: f changes sign between the ends whatever
    // happens inside.
    let cubic = ([-1.0..1.0, -1.0..1.0, -1.0..1.0], -1.0..1.0, 0.0..10.0);
    for_all(20_000, 0.3, cubic, |([p, q, r], at, height): ([f64; 3], f64, f64)| {
        let f = |x: f64| (x - p) * (x - q) * (x - r) + if x > at { height } else { 0.0 };
        let ends = [f(-1.0), f(1.0)];
        if ends[0] * ends[1] >= 0.0 {
            return false;
        }
        let count = Cell::new(0_usize);
        let bracket = Cell::new([-1.0, 1.0]);
        let observe = |x: f64, y: f64| {
            count.set(count.get() + 1);
            let [low, high] = bracket.get();
            assert!(low <= x && x <= high, "{x} is outside of {low} to {high}");
            bracket.set(if (y < 0.0) == (ends[0] < 0.0) { [x, high] } else { [low, x] });
        };
        // A root at zero has no relative accuracy.
        let tolerance = 1e-15;
        let root = brent(f, [-1.0, 1.0], tolerance, observe).unwrap();
        assert!(count.get() <= MAX_STEPS);
        // The sign changes within the guaranteed distance.
        let near = 4.0 * f64::EPSILON * root.abs() + tolerance;
        let (low, high) = (f((root - near).max(-1.0)), f((root + near).min(1.0)));
        assert!(
            f(root) == 0.0 || low * f(root) <= 0.0 || high * f(root) <= 0.0,
            "{root}: {low} {} {high}",
            f(root)
        );
        true
    });
}

/// The points at which Brent's own procedure `zero` evaluates the function between the ends, and its answer:
/// section 4.6 of his book, with the book's names. In addition, the bracket is halved if only that can still
/// end within `halvings` steps.
fn published(
    f: &dyn Fn(f64) -> f64,
    [mut a, mut b]: [f64; 2],
    t: f64,
    halvings: i32,
) -> (f64, Vec<(f64, f64)>) {
    let mut points = Vec::new();
    let (mut fa, mut fb) = (f(a), f(b));
    let (mut c, mut fc) = (a, fa);
    let mut d = b - a;
    let mut e = d;
    loop {
        if fc.abs() < fb.abs() {
            (a, b, c) = (b, c, b);
            (fa, fb, fc) = (fb, fc, fb);
        }
        let tol = 2.0 * f64::EPSILON * b.abs() + t;
        let m = 0.5 * (c - b);
        if m.abs() <= tol || fb == 0.0 {
            return (b, points);
        }
        let left = halvings - i32::try_from(points.len()).unwrap();
        if m.abs() > tol * 2_f64.powi(left) || e.abs() < tol || fa.abs() <= fb.abs() {
            (d, e) = (m, m);
        } else {
            let s = fb / fa;
            let (mut p, mut q);
            if a == c {
                p = 2.0 * m * s;
                q = 1.0 - s;
            } else {
                let (k, r) = (fa / fc, fb / fc);
                p = s * (2.0 * m * k * (k - r) - (b - a) * (r - 1.0));
                q = (k - 1.0) * (r - 1.0) * (s - 1.0);
            }
            if p > 0.0 {
                q = -q;
            } else {
                p = -p;
            }
            let before = e;
            e = d;
            if 2.0 * p < 3.0 * m * q - (tol * q).abs() && p < (0.5 * before * q).abs() {
                d = p / q;
            } else {
                (d, e) = (m, m);
            }
        }
        (a, fa) = (b, fb);
        b += if d.abs() > tol {
            d
        } else if m > 0.0 {
            tol
        } else {
            -tol
        };
        fb = f(b);
        points.push((b, fb));
        if (fb > 0.0) == (fc > 0.0) {
            (c, fc) = (a, fa);
            d = b - a;
            e = d;
        }
    }
}

/// Step by step the method is Brent's, to rounding: secants, parabolas, rejected steps and bisections.
#[test]
fn every_step_is_the_published_one() {
    let shape = ([-1.0..1.0, -1.0..1.0, -1.0..1.0], 0..5, -1.0..1.0, -14.0..-0.3);
    for_all(20_000, 0.3, shape, |([p, q, r], kind, at, exponent): ([f64; 3], i32, f64, f64)| {
        let f = |x: f64| match kind {
            0 => (x - p) * (x - q) * (x - r),
            1 => (x - p) * (1.0 + (x - q) * (x - q)),
            2 => (8.0 * (x - p)).exp() - 1.0 + 0.1 * q * x,
            3 => (x - p) * (x - p) * (x - p) + 1e-3 * r,
            _ => (x - p) / (1.1 + x * q.signum()) + if x > at { 0.5 } else { 0.0 },
        };
        let ends = [f(-1.0), f(1.0)];
        if ends[0] * ends[1] >= 0.0 {
            return false;
        }
        let tolerance = 10_f64.powf(exponent);
        let (expected, points) = published(&f, [-1.0, 1.0], 0.5 * tolerance, 60);
        let mut steps = Vec::new();
        let root = brent(f, [-1.0, 1.0], tolerance, |x, y| steps.push((x, y))).unwrap();
        // Rounding decides once only the last digits of the function are left.
        let decided = points.iter().take_while(|(_, y)| y.abs() > 1e-11).count();
        assert!(steps.len() >= decided, "{steps:?} {points:?}");
        for (step, point) in steps.iter().zip(&points[..decided]) {
            assert_close("a step", step.0, point.0, 1e-7 * (1.0 - point.0.abs()).max(1e-3));
        }
        assert_close("the root", root, expected, tolerance + 1e-9);
        if decided == points.len() {
            assert_eq!(steps.len(), points.len());
        }
        true
    });
}

#[test]
fn the_tolerance_is_kept_and_used() {
    let f = |x: f64| x * x * x - 2.0 * x - 5.0;
    let mut coarse = 0;
    let root = brent(f, [2.0, 3.0], 1e-3, |_, _| coarse += 1).unwrap();
    assert_close("the root", root, 2.094_551_481_542_326_5, 1e-3);
    let (_, fine) = solve(f, [2.0, 3.0]);
    assert!(coarse < fine.len(), "{coarse}");
}
