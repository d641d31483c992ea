use super::*;

/// Narrows a bracket after evaluating f at its ends, and checks the values returned for the new ends.
#[track_caller]
fn narrow(f: impl Fn(f64) -> f64, bracket: [f64; 2]) -> [f64; 2] {
    narrowed(&f, bracket.map(|x| (x, f(x)))).map(|(x, value)| {
        assert_eq!(value.to_bits(), f(x).to_bits());
        x
    })
}

/// Checks that a narrowed bracket holds the change of sign of x − root and of root − x.
#[track_caller]
fn assert_narrowed(root: f64, bracket: [f64; 2]) {
    for sign in [1.0, -1.0] {
        let f = |x: f64| sign * (x - root);
        let [low, high] = narrow(f, bracket);
        assert!(bracket[0] <= low && low <= root && root <= high && high <= bracket[1], "{low:e} {high:e}");
        // ⁴√2
        assert!(low.to_bits() == high.to_bits() || high <= 1.19 * low, "{low:e} {high:e}");
    }
}

#[test]
fn a_narrowed_bracket_has_the_root_and_ends_of_one_size() {
    assert_narrowed(1e-30, [0.0, 1.0]);
    assert_narrowed(3.0, [1e-200, 1e100]);
    assert_narrowed(0.7, [0.0, 0.7]);
    assert_narrowed(5.0, [4.9, 1e9]);
}

#[test]
fn a_root_at_an_end_stays_in_the_narrowed_bracket() {
    // Zero counts as positive, so that only a falling line still changes sign to the right of its root.
    let [low, high] = narrow(|x| 1.0 - x, [1.0, 8.0]);
    assert!(low == 1.0 && high <= 1.19, "{low} {high}");
    assert_narrowed(8.0, [1.0, 8.0]);
    // The first point tried, √1·√16, is the root.
    assert_narrowed(4.0, [1.0, 16.0]);
}

#[test]
fn a_bracket_that_is_narrow_is_left_alone() {
    assert_eq!(narrow(|x| x - 1.1, [1.0, 1.15]), [1.0, 1.15]);
}

/// There is nothing between zero and the smallest positive number.
#[test]
fn a_root_at_zero_ends_the_narrowing() {
    assert_eq!(narrow(|x| -x, [0.0, 1.0])[0], 0.0);
}
