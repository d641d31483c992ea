//! The distance between samples lies within its bounds, whatever the speed does between them.

use proptest::prelude::{Strategy, any, prop, prop_assert, proptest};
use proptest::test_runner::Config;
use recorder::{PreCrash, PreCrashSample, SpeedLimits};

/// (s) within this step the acceleration of a trace is constant.
const FINE: f64 = 0.05;

/// Accelerations from full braking to full acceleration, held for random times; the speed at the beginning.
fn traces() -> impl Strategy<Value = (f64, Vec<f64>)> {
    let extremes = prop::sample::select(vec![-9.80665, 9.80665, 0.0]);
    let held = prop::collection::vec((extremes, -1.0..1.0_f64, any::<bool>(), 1_usize..8), 4..20);
    (0.0..60.0_f64, held).prop_map(|(speed, held)| {
        let accelerations = held.into_iter().flat_map(|(extreme, share, is_extreme, count)| {
            std::iter::repeat_n(if is_extreme { extreme } else { 9.80665 * share }, count)
        });
        (speed, accelerations.collect())
    })
}

proptest! {
    #![proptest_config(Config { cases: 100_000, failure_persistence: None, ..Config::default() })]

    #[test]
    fn the_distance_lies_within_its_bounds((first, accelerations) in traces(), every in 1_usize..11) {
        let (mut speed, mut distance, mut time) = (first, 0.0, 0.0);
        let mut stored = vec![(0.0, speed, 0.0)];
        for (k, wanted) in accelerations.iter().enumerate() {
            // A vehicle that stands does not brake any more.
            let stops = -speed / FINE;
            let acceleration = wanted.max(stops);
            distance += speed * FINE + 0.5 * acceleration * FINE * FINE;
            speed = (speed + acceleration * FINE).max(0.0);
            time += FINE;
            if (k + 1) % every == 0 {
                stored.push((time, speed, distance));
            }
        }
        // Stored to the nearest km/h, at times before the end.
        let sample = |(at, speed, _): &(f64, f64, f64)| PreCrashSample {
            time: at - time - 1.0,
            speed: Some((speed * 3.6).round() / 3.6),
            ..PreCrashSample::default()
        };
        let record = PreCrash::new(stored.iter().map(sample).collect()).unwrap();
        let bounds = record.distances_to_last(&SpeedLimits::default());
        let whole = stored.last().unwrap().2;
        for ((_, bounds), (_, _, before)) in bounds.iter().zip(&stored) {
            let truth = whole - before;
            prop_assert!(bounds.at_least <= truth + 1e-9, "{bounds:?} {truth}");
            prop_assert!(truth <= bounds.at_most + 1e-9, "{bounds:?} {truth}");
            prop_assert!(bounds.at_least <= bounds.between && bounds.between <= bounds.at_most);
        }
    }
}

/// Two samples 1 s apart at 20 m/s, without rounding. The quickest course rises for half a second at 1 g and
/// falls again: 20 + g/4 m; the slowest is as far below.
#[test]
fn bounds_of_two_equal_speeds() {
    let sample =
        |time: f64, speed: f64| PreCrashSample { time, speed: Some(speed), ..PreCrashSample::default() };
    let record = |first: f64, last: f64| PreCrash::new(vec![sample(-1.0, first), sample(0.0, last)]).unwrap();
    let limits = SpeedLimits { rounding: 0.0, ..SpeedLimits::default() };
    let bounds = record(20.0, 20.0).distance(-1.0, 0.0, &limits);
    assert!((bounds.at_most - (20.0 + 9.80665 / 4.0)).abs() < 1e-12, "{bounds:?}");
    assert!((bounds.at_least - (20.0 - 9.80665 / 4.0)).abs() < 1e-12, "{bounds:?}");
    // A vehicle that stands at both may have driven, g/4 m at most, and may have stood.
    let bounds = record(0.0, 0.0).distance(-1.0, 0.0, &limits);
    assert_eq!((bounds.at_least, bounds.left, bounds.right), (0.0, 0.0, 0.0));
    assert!((bounds.at_most - 9.80665 / 4.0).abs() < 1e-12, "{bounds:?}");
    // Braked by 1 g throughout, there is one distance. A fall beyond that happened nevertheless.
    for fall in [9.80665, 15.0] {
        let bounds = record(20.0, 20.0 - fall).distance(-1.0, 0.0, &limits);
        let only = 20.0 - fall / 2.0;
        assert!((bounds.at_least - only).abs() < 1e-9 && (bounds.at_most - only).abs() < 1e-9, "{bounds:?}");
        assert!((bounds.left - 20.0).abs() < 1e-12 && (bounds.right - 20.0 + fall).abs() < 1e-12);
        assert!((bounds.between - only).abs() < 1e-12);
    }
}
