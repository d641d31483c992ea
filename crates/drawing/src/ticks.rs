//! Round lengths and steps.

/// The greatest 1, 2 or 5 times a power of ten that is not above `most` (> 0), and how many decimals it has.
pub(crate) fn round(most: f64) -> (f64, usize) {
    let mut power = 1.0;
    let mut decimals = 0;
    while power * 10.0 <= most && power < 1e300 {
        power *= 10.0;
    }
    while power > most && decimals < 12 {
        decimals += 1;
        power /= 10.0;
    }
    let mantissa = [5.0, 2.0].into_iter().find(|m| m * power <= most).unwrap_or(1.0);
    (mantissa * power, decimals)
}

/// Round numbers from `low` to `high`, at most `most` steps apart, with the decimals that they need.
pub(crate) fn between(low: f64, high: f64, most: f64) -> (Vec<f64>, usize) {
    let least = (high - low) / most;
    // If the ends are equal up to rounding, or unbounded, there is nothing to count.
    if !(least.is_normal() && least > 1e-12 * low.abs().max(high.abs()) && least < 1e300) {
        return (Vec::new(), 0);
    }
    // The smallest round number that is at least the least step.
    let (mut step, mut decimals) = round(least * 9.999);
    for candidate in [least * 4.999, least * 2.499, least * 1.999] {
        let (smaller, smaller_decimals) = round(candidate);
        if smaller >= least {
            (step, decimals) = (smaller, smaller_decimals);
        }
    }
    let mut values = Vec::new();
    let mut k = (low / step).ceil();
    while k * step <= high * (1.0 + 1e-12) {
        values.push(k * step);
        k += 1.0;
    }
    (values, decimals)
}

#[cfg(test)]
mod tests {
    use super::{between, round};

    #[test]
    fn round_numbers_are_below_and_near() {
        for (most, expected) in [(0.99, 0.5), (1.0, 1.0), (4.9, 2.0), (73.0, 50.0), (0.021, 0.02)] {
            assert!((round(most).0 - expected).abs() < 1e-12 * expected, "{most}");
        }
        assert_eq!(round(0.03).1, 2);
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(between(0.0, 27.4, 8.0), (vec![0.0, 5.0, 10.0, 15.0, 20.0, 25.0], 0));
        assert_eq!(between(-3.0, 3.0, 6.0).0, [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0]);
        assert_eq!(between(1000.0, 1000.001, 5.0).0.len(), 6);
    }

    #[test]
    fn there_are_none_between_ends_that_are_alike_or_without_bounds() {
        let ends =
            [(7.0, 7.0), (1e20, 1e20), (2.0, 1.0), (0.0, f64::INFINITY), (f64::NAN, 1.0), (-1e308, 1e308)];
        for (low, high) in ends {
            assert!(between(low, high, 5.0).0.is_empty(), "{low} to {high}");
        }
    }
}
