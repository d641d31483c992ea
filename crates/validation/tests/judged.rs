//! Both speeds of the staged collisions, with the intervals of the posterior.

use validation::{AfterImpact, Data, judge_speeds};

/// The true speeds (m/s) of those that moved: Vossou & Koulocheris (2018), and `ricsac/*.toml`.
const MOVED: [(u8, &[f64]); 11] = [
    (1, &[8.85, 8.86]),
    (3, &[9.48]),
    (4, &[17.30]),
    (5, &[17.75]),
    (6, &[9.61, 9.54]),
    (7, &[13.01, 13.01]),
    (8, &[9.30, 9.30]),
    (9, &[9.48, 9.48]),
    (10, &[14.89, 14.89]),
    (11, &[9.12, 9.12]),
    (12, &[14.08, 14.08]),
];

/// At least 18 of the 19 intervals of 95 % must contain the true speed. Their half widths must average no
/// more than 22.5 % of it, and none may exceed 40 %. The errors of the fitted figures are 0.2 % of the mean.
#[test]
fn intervals_hold_the_true_speeds_and_are_narrow() {
    let judgement = judge_speeds(&Data::built_in(), AfterImpact::VelocitiesAndYawRates, 256, 1).unwrap();
    assert_eq!(judgement.tests.len(), MOVED.len());
    for (judged, (test, speeds)) in judgement.tests.iter().zip(MOVED) {
        assert_eq!((judged.test, judged.speeds.len()), (test, speeds.len()));
        for (judged, speed) in judged.speeds.iter().zip(speeds) {
            assert!((judged.true_speed - speed).abs() < 0.006, "test {test}: {judged:?}");
        }
    }
    let [mean, largest] = judgement.half_widths();
    assert!(judgement.inside() >= 18, "{judgement:?}");
    assert!(mean <= 0.225, "{mean}");
    assert!(largest <= 0.40, "{largest}");
}
