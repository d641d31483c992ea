//! Comparisons that fail for NaN.

/// Asserts |actual − expected| ≤ tolerance.
#[track_caller]
pub fn assert_close(what: &str, actual: f64, expected: f64, tolerance: f64) {
    assert!(
        (actual - expected).abs() <= tolerance,
        "{what}: {actual:e} is not {expected:e} within {tolerance:e} (off by {:e})",
        actual - expected
    );
}

/// Asserts agreement relative to the expected value.
#[track_caller]
pub fn assert_relative(what: &str, actual: f64, expected: f64, tolerance: f64) {
    assert_close(what, actual, expected, tolerance * expected.abs());
}

/// Asserts that two angles (rad) are the same direction.
#[track_caller]
pub fn assert_direction(what: &str, actual: f64, expected: f64, tolerance: f64) {
    let turn = actual - expected;
    // Sine and cosine together: the sine alone would accept a half turn.
    assert!(
        turn.sin().abs() <= tolerance && turn.cos() > 0.0,
        "{what}: {actual} rad is not the direction {expected} rad within {tolerance:e}"
    );
}

/// Asserts that `value` agrees with the print to half a unit of the last digit of `printed`, which may have
/// an exponent.
#[track_caller]
pub fn assert_printed(value: f64, printed: &str) {
    assert!(agrees_with_print(value, printed), "{value} does not print as {printed}");
}

fn agrees_with_print(value: f64, printed: &str) -> bool {
    let expected: f64 = printed.parse().unwrap();
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let exponent = exponent.parse::<i32>().unwrap() - i32::try_from(decimals).unwrap();
    let unit = 10_f64.powi(exponent);
    // A tie may be rounded either way, and the decimal value itself is rounded to binary.
    (value - expected).abs() <= 0.5 * unit * (1.0 + 1e-9)
}

#[test]
fn printed_precision_is_that_of_the_last_digit() {
    for (value, printed) in [
        (27.184, "27.18"),
        (27.185, "27.18"),
        (-1.8, "-1.8"),
        (101_600.0, "1.02e5"),
        (0.371, "0.371"),
        (75.4, "75"),
    ] {
        assert!(agrees_with_print(value, printed), "{value} {printed}");
    }
    for (value, printed) in [
        (27.186, "27.18"),
        (27.174, "27.18"),
        (1.8, "-1.8"),
        (101_400.0, "1.02e5"),
        (0.3716, "0.371"),
        (75.6, "75"),
        (f64::NAN, "75"),
        (f64::INFINITY, "75"),
    ] {
        assert!(!agrees_with_print(value, printed), "{value} {printed}");
    }
}

#[test]
fn nan_is_close_to_nothing() {
    for (actual, expected) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::NAN, f64::NAN)] {
        assert!(std::panic::catch_unwind(|| assert_close("", actual, expected, f64::INFINITY)).is_err());
        assert!(std::panic::catch_unwind(|| assert_relative("", actual, expected, 1.0)).is_err());
        assert!(std::panic::catch_unwind(|| assert_direction("", actual, expected, 2.0)).is_err());
    }
}
