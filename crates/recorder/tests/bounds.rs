//! The distance between samples lies within its bounds, whatever the speed does between them.

#![expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a short list")]

use proptest::prelude::{Strategy, any, prop, prop_assert, proptest};
use proptest::test_runner::Config;
use recorder::{
    Channel, DistanceBounds, PreCrash, PreCrashFault, PreCrashSample, SpeedLimits, SteepChange, StepSource,
    read_tables,
};

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

proptest! {
    #![proptest_config(Config { cases: 20_000, failure_persistence: None, ..Config::default() })]

    /// A speed that drops or jumps at one instant, and changes by 1 g at most otherwise: if the two samples
    /// show such a jump, the bounds hold.
    #[test]
    fn the_distance_lies_within_its_bounds_beyond_1_g(
        (first, accelerations) in traces(),
        at in 0.0..1.0_f64,
        share in 0.0..1.0_f64,
        falls in any::<bool>(),
    ) {
        let count = accelerations.len().min(20);
        let (mut speed, mut distance) = (first, 0.0);
        for (k, wanted) in accelerations.iter().take(count).enumerate() {
            if k == (at * count as f64).floor() as usize {
                speed = if falls { speed * share } else { speed + 40.0 * share };
            }
            let acceleration = wanted.max(-speed / FINE);
            distance += speed * FINE + 0.5 * acceleration * FINE * FINE;
            speed = (speed + acceleration * FINE).max(0.0);
        }
        let sample = |time: f64, speed: f64| PreCrashSample {
            time,
            speed: Some((speed * 3.6).round() / 3.6),
            ..PreCrashSample::default()
        };
        let record = PreCrash::new(vec![sample(-FINE * count as f64, first), sample(0.0, speed)]).unwrap();
        let limits = SpeedLimits::default();
        if !record.steep_changes(&limits).is_empty() {
            let (_, bounds) = record.distances_to_last(&limits)[0];
            prop_assert!(bounds.at_least <= distance + 1e-9, "{bounds:?} {distance}");
            prop_assert!(distance <= bounds.at_most + 1e-9, "{bounds:?} {distance}");
            let sums = [bounds.left, bounds.between, bounds.right];
            prop_assert!(sums.iter().all(|sum| (bounds.at_least..=bounds.at_most).contains(sum)), "{bounds:?}");
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
    // Braked by 1 g throughout, there is one distance.
    let braked = record(20.0, 20.0 - 9.80665);
    let bounds = braked.distance(-1.0, 0.0, &limits);
    let only = 20.0 - 9.80665 / 2.0;
    assert!((bounds.at_least - only).abs() < 1e-9 && (bounds.at_most - only).abs() < 1e-9, "{bounds:?}");
    assert!((bounds.left - 20.0).abs() < 1e-12 && (bounds.right - 20.0 + 9.80665).abs() < 1e-12);
    assert!((bounds.between - only).abs() < 1e-12);
    assert_eq!(braked.steep_changes(&limits), []);
}

/// From 60 km/h at −0.5 s to 54 km/h at the impact: 0.5 s at 16.667 and 15 m/s. At the least, 1 g of braking
/// from 53.5 km/h, 14.861 · 0.5 − g/8; at the most 1 g forward from 60.5 km/h, 16.806 · 0.5 + g/8.
#[test]
fn the_distance_to_the_impact_includes_the_gap() {
    let sample = |time: f64| PreCrashSample { time, speed: Some(60.0 / 3.6), ..PreCrashSample::default() };
    let limits = SpeedLimits::default();
    let early = PreCrash::new(vec![sample(-1.5), sample(-0.5)]).unwrap();
    let found = early.distances_to_impact(15.0, &limits);
    assert_eq!(found.iter().map(|(time, _)| *time).collect::<Vec<_>>(), [-1.5, -0.5, 0.0]);
    let gap = found[1].1;
    for (sum, by_hand) in [
        (gap.at_least, 6.204_7),
        (gap.right, 7.5),
        (gap.between, 7.916_67),
        (gap.left, 8.333_33),
        (gap.at_most, 9.628_6),
    ] {
        assert!((sum - by_hand).abs() < 1e-4, "{sum} {by_hand}");
    }
    let to_last = early.distances_to_last(&limits)[0].1;
    assert!((found[0].1.between - to_last.between - gap.between).abs() < 1e-12, "{found:?}");
    assert!((found[0].1.at_most - to_last.at_most - gap.at_most).abs() < 1e-12, "{found:?}");
    assert_eq!(found[2].1, DistanceBounds::default());
    // Wheels that locked read 0, while the vehicle went on: the bounds contain both.
    let locked = PreCrash::new(vec![PreCrashSample { speed: Some(0.0), ..sample(-0.5) }]).unwrap();
    let gap = locked.distances_to_impact(15.0, &limits)[0].1;
    assert!(gap.at_least == 0.0 && gap.at_most > gap.right && gap.right == 7.5, "{gap:?}");
    // Without a gap, it is the distance to the last sample.
    let whole = PreCrash::new(vec![sample(-1.0), sample(0.0)]).unwrap();
    assert_eq!(whole.distances_to_impact(15.0, &limits), whole.distances_to_last(&limits));
}

/// A fall of 15 m/s in a second is more than tyres can do. It may have happened in the last instant, after a
/// second of
/// 1 g forward from 20 m/s, or in the first, with 5 m/s at the end: from a standstill, as 5 < g, 5²/2g m.
#[test]
fn bounds_hold_where_the_speed_falls_by_more_than_g() {
    let sample =
        |time: f64, speed: f64| PreCrashSample { time, speed: Some(speed), ..PreCrashSample::default() };
    let record = |first: f64, last: f64| PreCrash::new(vec![sample(-1.0, first), sample(0.0, last)]).unwrap();
    let limits = SpeedLimits { rounding: 0.0, ..SpeedLimits::default() };
    for (first, last) in [(20.0, 5.0), (5.0, 20.0)] {
        let steep = record(first, last);
        let bounds = steep.distance(-1.0, 0.0, &limits);
        assert!((bounds.at_most - (20.0 + 9.80665 / 2.0)).abs() < 1e-9, "{bounds:?}");
        assert!((bounds.at_least - 25.0 / (2.0 * 9.80665)).abs() < 1e-9, "{bounds:?}");
        let found = steep.steep_changes(&limits);
        assert_eq!(found, [SteepChange { times: [-1.0, 0.0], acceleration: last - first }]);
    }
}

/// 60, 58 and 55 mph at −2, −1 and 0 s, each to ±0.5 mph: 46.35 to 56.92 m. From 60.5 to 58.5 mph (27.046 and
/// 26.152 m/s): the quickest course turns after (g − 0.894)/2g = 0.4544 s; and so on.
#[test]
fn speeds_in_whole_miles_are_rounded_to_a_mile() {
    let text = |unit: &str, speeds: [&str; 3]| {
        let [a, b, c] = speeds;
        format!("Time (s),Vehicle speed ({unit})\n-2,{a}\n-1,{b}\n0,{c}\n")
    };
    let record = |unit, speeds| PreCrash::from_table(&read_tables(&text(unit, speeds)).unwrap()[0]).unwrap();
    let miles = record("mph", ["60", "58", "55"]);
    assert!((miles.step() - 0.44704).abs() < 1e-12);
    let (_, bounds) = miles.distances_to_last(&SpeedLimits::stored_in(miles.step()))[0];
    assert!((bounds.at_least - 46.35).abs() < 0.005 && (bounds.at_most - 56.92).abs() < 0.005, "{bounds:?}");
    // With a fraction of a mile, and in km/h, it is 1 km/h; without rounding the bounds are nearer.
    assert!((record("mph", ["60", "58.4", "55"]).step() - 1.0 / 3.6).abs() < 1e-12);
    assert!((record("km/h", ["60", "58", "55"]).step() - 1.0 / 3.6).abs() < 1e-12);
    // 60, 58 and 55 mph are 96.56, 93.34 and 88.51 km/h.
    assert!((record("km/h", ["96.6", "93.3", "88.5"]).step() - 0.44704).abs() < 1e-12);
    for speeds in [["96.6", "93.3", "88.6"], ["96.6", "96.6", "0"]] {
        assert!((record("km/h", speeds).step() - 1.0 / 3.6).abs() < 1e-12, "{speeds:?}");
    }
    let (_, exact) = miles.distances_to_last(&SpeedLimits::stored_in(0.0))[0];
    // ±0.22352 m/s over 2 s, as the turns stay where they are.
    assert!((bounds.at_most - exact.at_most - 0.44704).abs() < 1e-9, "{exact:?}");
    assert!((exact.at_least - bounds.at_least - 0.44704).abs() < 1e-9, "{exact:?}");
}

/// A step shows in the speeds themselves: 4 different multiples of 5, 6 of 2, or 8 whole miles in whole km/h.
/// By conversion, 60, 59, 57, 55, 52, 48, 44 and 39 mph are 96.56, 94.95, 91.73, 88.51, 83.69, 77.25, 70.81
/// and 62.76 km/h.
#[test]
fn a_coarser_step_shows_in_the_speeds() {
    let found = |unit: &str, speeds: &str| {
        let count = i32::try_from(speeds.split(' ').count()).unwrap();
        let rows: String = speeds.split(' ').zip(1 - count..).map(|(v, k)| format!("{k},{v}\n")).collect();
        let text = format!("Time (s),Vehicle speed ({unit})\n{rows}");
        let record = PreCrash::from_table(&read_tables(&text).unwrap()[0]).unwrap();
        (record.step(), record.step_source())
    };
    let miles = "97 95 92 89 84 77 71 63";
    for (unit, speeds, step, source) in [
        ("km/h", "70 65 60 60 50 45", 5.0 / 3.6, StepSource::Multiples(5)),
        ("km/h", "70 66 60 60 50 44 38", 2.0 / 3.6, StepSource::Multiples(6)),
        ("mph", "70 66 60 60 50 44 38", 2.0 * 0.447_04, StepSource::Multiples(6)),
        ("km/h", "65 65 60 55 50", 5.0 / 3.6, StepSource::Multiples(4)),
        ("km/h", miles, 0.447_04, StepSource::Miles(8)),
        ("km/h", "96.6 93.3 88.5", 0.447_04, StepSource::Miles(3)),
        ("mph", "60 57 55", 0.447_04, StepSource::Unit),
        // One speed too few, a standstill that is a multiple of everything, or one speed that is none.
        ("km/h", "65 60 60 50 50", 1.0 / 3.6, StepSource::Regular),
        ("km/h", "70 66 60 60 50 44", 1.0 / 3.6, StepSource::Regular),
        ("km/h", "60 50 40 0 0", 1.0 / 3.6, StepSource::Regular),
        ("km/h", "70 65 60 61 50 45 40", 1.0 / 3.6, StepSource::Regular),
        ("km/h", "0 0 0 0 0 0", 1.0 / 3.6, StepSource::Regular),
        ("km/h", &miles[3..], 1.0 / 3.6, StepSource::Regular),
        ("km/h", &miles.replace("89", "88"), 1.0 / 3.6, StepSource::Regular),
    ] {
        let (size, how) = found(unit, speeds);
        assert!((size - step).abs() < 1e-12 && how == source, "{unit} {speeds}: {size} {how:?}");
    }
}

#[test]
fn limits_have_their_ranges() {
    let usual = SpeedLimits::default();
    assert_eq!(usual.check(), Ok(()));
    for (bad, name) in [
        (SpeedLimits { rounding: f64::NAN, ..usual }, "rounding"),
        (SpeedLimits { rounding: -1.0, ..usual }, "rounding"),
        (SpeedLimits { deceleration: -5.0, ..usual }, "deceleration"),
        (SpeedLimits { acceleration: f64::INFINITY, ..usual }, "acceleration"),
    ] {
        assert_eq!(bad.check().unwrap_err().name, name);
    }
}

/// A table with these numbers would leave them out.
#[test]
fn what_no_recorder_stores_is_refused() {
    let last = PreCrashSample { speed: Some(10.0), ..PreCrashSample::default() };
    assert!(PreCrash::new(vec![last]).is_ok());
    for (bad, channel) in [
        (PreCrashSample { time: -1e300, ..last }, Channel::Time),
        (PreCrashSample { speed: Some(1e308), ..last }, Channel::Speed),
        (PreCrashSample { accelerator: Some(101.0), ..last }, Channel::Accelerator),
        (PreCrashSample { throttle: Some(-1.0), ..last }, Channel::Throttle),
        (PreCrashSample { engine_speed: Some(1e6), ..last }, Channel::EngineSpeed),
        (PreCrashSample { steering: Some(30.0), ..last }, Channel::Steering),
        (PreCrashSample { yaw_rate: Some(-10.0), ..last }, Channel::YawRate),
    ] {
        let refusal = PreCrash::new(vec![bad]).unwrap_err();
        let PreCrashFault::OutOfRange { sample: 1, channel: found, .. } = refusal else {
            panic!("{refusal}")
        };
        assert_eq!(found, channel);
        assert!(refusal.to_string().contains(channel.name()), "{refusal}");
    }
}
