//! The speed of vehicle 1 in the RICSAC collisions, with a share λ of the tangential work in the crush.

use validation::{Data, SHARES, Validation, validate};

const TESTS: [u8; 11] = [1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];

/// λ, the error of the speed of vehicle 1 (%) in each test with a common tangential velocity, and their root
/// mean square, from a scan of the speed in plain arithmetic. A share of 1 leaves test 10 without a speed.
const ERRORS: [(f64, [f64; 11], f64); 5] = [
    (0.0, [61.8, -16.9, 15.5, 22.0, 48.0, 41.1, 2.7, 26.4, -8.6, -23.1, -54.7], 34.5),
    (0.25, [41.3, -16.7, 15.6, 22.2, 31.1, 25.1, -3.0, 17.3, -23.6, -23.0, -54.6], 28.1),
    (0.5, [23.3, -16.6, 15.8, 22.5, 15.9, 10.6, -9.0, 7.9, -41.1, -23.0, -54.6], 25.7),
    (0.75, [7.4, -16.4, 15.9, 22.7, 2.1, -2.7, -15.3, -1.8, -63.4, -22.9, -54.6], 28.4),
    (1.0, [-6.7, -16.3, 16.0, 23.0, -10.5, -14.8, -22.1, -12.0, f64::NAN, -22.8, -54.5], f64::NAN),
];

#[test]
fn a_share_of_the_tangential_work_halves_the_largest_errors() {
    let Validation { by_share, share_errors, .. } = validate(&Data::built_in()).unwrap();
    assert_eq!(by_share.iter().map(|row| row.test).collect::<Vec<_>>(), TESTS);
    for (i, (share, expected, rms)) in ERRORS.into_iter().enumerate() {
        assert_eq!(SHARES[i], share);
        for (row, expected) in by_share.iter().zip(expected) {
            let error = row.errors()[i].map_or(f64::NAN, |error| 100.0 * error);
            assert!(
                error.is_nan() && expected.is_nan() || (error - expected).abs() <= 0.051,
                "test {}, λ = {share}: {error} is not {expected}",
                row.test
            );
        }
        let found = 100.0 * share_errors[i].rms;
        assert!(rms.is_nan() || (found - rms).abs() <= 0.051, "λ = {share}: {found} is not {rms}");
    }
    assert_eq!(share_errors.map(|rate| rate.count), [11, 11, 11, 11, 10]);
}
