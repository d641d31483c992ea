//! The speed at impact against an independent simulation of its errors.

use recorder::{
    ImpactSpeed, ImpactSpeedErrors, ImpactSpeedFault, PreCrash, PreCrashSample, SampledApproach,
    SpeedErrorSource,
};

const KMH: f64 = 1.0 / 3.6;

fn record(samples: &[(f64, f64, Option<bool>)]) -> PreCrash {
    let sample = |(time, speed, brake): &(f64, f64, Option<bool>)| PreCrashSample {
        time: *time,
        speed: Some(speed * KMH),
        brake: *brake,
        ..PreCrashSample::default()
    };
    PreCrash::new(samples.iter().map(sample).collect()).unwrap()
}

/// Uniform numbers of a 64-bit generator (splitmix64), and normal ones as sums of twelve.
struct Numbers(u64);

impl Numbers {
    fn uniform(&mut self, least: f64, greatest: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let share = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        least + (greatest - least) * share
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform(0.0, 1.0)).sum::<f64>() - 6.0
    }
}

fn moments(draws: &[f64]) -> [f64; 2] {
    let mean = draws.iter().sum::<f64>() / draws.len() as f64;
    let variance = draws.iter().map(|draw| (draw - mean).powi(2)).sum::<f64>() / draws.len() as f64;
    [mean, variance.sqrt()]
}

/// (m/s²) the acceleration of a driver who braked at `shown` (m/s²): with 65 % that within 0.1 g.
fn goes_on(shown: f64, numbers: &mut Numbers) -> f64 {
    let g = 9.80665;
    if numbers.uniform(0.0, 1.0) < 0.65 {
        -numbers.uniform((shown - 0.1 * g).max(0.0), (shown + 0.1 * g).min(0.75 * g))
    } else {
        -numbers.uniform(0.0, 0.75 * g)
    }
}

/// Braking at 4 m/s² on asphalt of 0.75, the last sample half a second before the impact: the wheels slip by
/// 4 / (0.75 g) of what they do in hard braking.
#[test]
fn braking_with_a_gap_is_that_of_a_simulation() {
    let fall = 4.0 * 0.5 * 3.6;
    let record = record(&[(-1.0, 60.0, Some(true)), (-0.5, 60.0 - fall, Some(true))]);
    let found = ImpactSpeed::of(&record, &ImpactSpeedErrors::default()).unwrap();
    let mut numbers = Numbers(7);
    let stored = (60.0 - fall) * KMH;
    let share = 4.0 / (0.75 * 9.80665);
    let mut draws: Vec<f64> = (0..200_000)
        .map(|_| {
            let rounding = numbers.uniform(-0.5, 0.5) * KMH;
            let hard = share * 3.0 * KMH + share * 2.1 * KMH * numbers.normal();
            let steady = (1.0 - share) * stored * (0.014 + 0.0043 * numbers.normal());
            let tyres = stored * 0.007 * numbers.normal();
            let acceleration = goes_on(4.0, &mut numbers);
            stored + rounding + hard + steady + tyres + acceleration * (0.5 + numbers.uniform(0.0, 0.1))
        })
        .collect();
    let [mean, sd] = moments(&draws);
    assert!((found.mean - mean).abs() < 0.01, "{} {mean}", found.mean);
    assert!((found.sd / sd - 1.0).abs() < 0.01, "{} {sd}", found.sd);
    draws.sort_by(f64::total_cmp);
    for (share, k) in [(0.025, 5_000), (0.25, 50_000), (0.5, 100_000), (0.9, 180_000), (0.975, 195_000)] {
        assert!(
            (found.quantile(share) - draws[k]).abs() < 0.05,
            "{share}: {} {}",
            found.quantile(share),
            draws[k]
        );
    }
    // The parts add up to the whole variance, and to the whole shift of the mean.
    let whole: f64 = found.parts.iter().map(|part| part.variance).sum();
    assert!((whole.sqrt() / sd - 1.0).abs() < 0.01, "{whole} {sd}");
    // The age alone: Var(a (g + ℓ)) − Var(a) g², by the same draws.
    let mut numbers = Numbers(8);
    let [mut with, mut without] = [Vec::new(), Vec::new()];
    for _ in 0..200_000 {
        let acceleration = goes_on(4.0, &mut numbers);
        with.push(acceleration * (0.5 + numbers.uniform(0.0, 0.1)));
        without.push(acceleration * 0.5);
    }
    let age = moments(&with)[1].powi(2) - moments(&without)[1].powi(2);
    let part = found.parts.iter().find(|part| part.source == SpeedErrorSource::Latency).unwrap();
    assert!((part.variance / age - 1.0).abs() < 0.03, "{} {age}", part.variance);
    let shift: f64 = found.parts.iter().map(|part| part.shift).sum();
    assert!((stored + shift - mean).abs() < 0.01);
    let largest = found.parts.iter().max_by(|a, b| a.variance.total_cmp(&b.variance)).unwrap();
    assert_eq!(largest.source, SpeedErrorSource::Gap);
}

/// Each error alone, with all others at 0: rounding 1/√12 km/h, the share of the tyres, and so on.
#[test]
fn each_error_alone_has_its_own_spread() {
    let none = ImpactSpeedErrors {
        step: 0.0,
        steady_low: 0.0,
        steady_sd: 0.0,
        tyre_sd: 0.0,
        slip_low: 0.0,
        slip_sd: 0.0,
        coasting: 0.0,
        brake_comes_on: 0.0,
        latency: 0.0,
        ..ImpactSpeedErrors::default()
    };
    let record = record(&[(-0.5, 72.0, Some(false)), (0.0, 72.0, Some(false))]);
    let sd = |errors| ImpactSpeed::of(&record, &errors).unwrap().sd;
    let mean = |errors| ImpactSpeed::of(&record, &errors).unwrap().mean;
    assert!(sd(none) < 1e-9 && (mean(none) - 20.0).abs() < 1e-9);
    let close =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
    close(sd(ImpactSpeedErrors { step: KMH, ..none }), KMH / 12_f64.sqrt());
    close(sd(ImpactSpeedErrors { tyre_sd: 0.01, ..none }), 0.2);
    close(sd(ImpactSpeedErrors { steady_sd: 0.02, ..none }), 0.4);
    close(mean(ImpactSpeedErrors { steady_low: 0.014, ..none }), 20.28);
    // Uniform in ±1 m/s² times uniform in 0 to 0.3 s: σ² = 1/3 · 0.09/3
    close(sd(ImpactSpeedErrors { coasting: 1.0, latency: 0.3, ..none }), 0.1);
}

#[test]
fn a_speed_that_falls_by_more_than_g_may_be_of_the_impact() {
    let braked = [(-1.0, 60.0, Some(true)), (-0.5, 58.0, Some(true)), (0.0, 30.0, Some(true))];
    let found = ImpactSpeed::of(&record(&braked), &ImpactSpeedErrors::default()).unwrap();
    let steep = found.steep_fall.unwrap();
    // 28 km/h in 0.5 s
    assert!((steep.deceleration - 28.0 / 3.6 / 0.5).abs() < 1e-9 && (steep.time + 0.5).abs() < 1e-12);
    let [low, high] = found.interval(0.95);
    assert!(low < 31.0 * KMH && high > 55.0 * KMH, "{low} {high}");
    assert!(
        found.parts.iter().any(|part| part.source == SpeedErrorSource::LastSample && part.variance > 0.0)
    );
    let whole: f64 = found.parts.iter().map(|part| part.variance).sum();
    assert!((whole.sqrt() / found.sd - 1.0).abs() < 2e-3, "{whole} {}", found.sd);
    let shift: f64 = found.parts.iter().map(|part| part.shift).sum();
    assert!((found.stored + shift - found.mean).abs() < 0.01, "{shift} {}", found.mean);
    // Just within 1 g, with the rounding of both speeds: 17.65 km/h in half a second.
    let within = [(-0.5, 58.0, Some(true)), (0.0, 40.0, Some(true))];
    assert_eq!(ImpactSpeed::of(&record(&within), &ImpactSpeedErrors::default()).unwrap().steep_fall, None);
}

/// From 1 g on, a fall counts the more as slip or impact the steeper it is, up to 1.2 g. Half-way, at 1.1 g,
/// the weight is half: of one sample, half of the 50 % for the impact; of several, half.
#[test]
fn a_fall_of_little_more_than_g_counts_a_little() {
    let of = |speeds: &[f64]| {
        let count = i32::try_from(speeds.len()).unwrap();
        let times = (1 - count..=0).map(|k| 0.5 * f64::from(k));
        let samples: Vec<_> = times.zip(speeds).map(|(time, speed)| (time, *speed, Some(true))).collect();
        ImpactSpeed::of(&record(&samples), &ImpactSpeedErrors::default()).unwrap()
    };
    // (km/h) in half a second, with a step for the rounding
    let fall = |g: f64| 1.0 + g * 9.806_65 * 0.5 * 3.6;
    for (g, share) in [(1.001, 0.002_5), (1.05, 0.125), (1.1, 0.25), (1.2, 0.5), (1.5, 0.5)] {
        let found = of(&[60.0, 58.0, 58.0 - fall(g)]).steep_fall.unwrap();
        assert!((found.probability - share).abs() < 1e-9 && !found.is_slip, "{g} {found:?}");
    }
    for (g, share) in [(1.1, 0.5), (1.2, 1.0)] {
        let found = of(&[60.0, 80.0, 80.0 - fall(g), 80.0 - (2.0 * fall(g) - 1.0)]).steep_fall.unwrap();
        assert!((found.probability - share).abs() < 1e-9 && found.is_slip, "{g} {found:?}");
    }
    // Hard braking all the way: one kilometre per hour of the last speed makes no other answer.
    let hard = |last: f64| of(&[100.0, 98.0, 97.0, 80.0, 70.0, 48.0, 32.0, last]);
    let [slower, faster] = [16.0, 17.0].map(|last| hard(last).mean / KMH);
    assert!((slower - faster).abs() < 2.0, "{slower} {faster}");
    assert!(hard(16.0).steep_fall.is_some() && hard(17.0).steep_fall.is_none());
}

/// Wheels that lock read 0 while the car slides on: from 62 km/h, 1 s of braking at 0 to 0.75 g leaves 35
/// to 62.
#[test]
fn locked_wheels_are_no_stop() {
    let locked = |speeds: [f64; 5]| {
        let times = [-2.0, -1.5, -1.0, -0.5, 0.0];
        let samples: Vec<_> =
            times.into_iter().zip(speeds).map(|(time, speed)| (time, speed, Some(time >= -1.0))).collect();
        ImpactSpeed::of(&record(&samples), &ImpactSpeedErrors::default()).unwrap()
    };
    for speeds in [[80.0, 80.0, 62.0, 0.0, 0.0], [80.0, 80.0, 62.0, 20.0, 3.0]] {
        let found = locked(speeds);
        let [low, high] = found.interval(0.95);
        assert!(
            low > 33.0 * KMH && low < 39.0 * KMH && high > 60.0 * KMH && high < 68.0 * KMH,
            "{low} {high}"
        );
        assert!(found.steep_fall.is_some_and(|fall| fall.is_slip && fall.time == -1.0));
        let shifts: f64 = found.parts.iter().map(|part| part.shift).sum();
        assert!(
            (found.stored + shifts - found.mean).abs() < 0.05,
            "{} {shifts} {}",
            found.stored,
            found.mean
        );
    }
    // A wheel that grips again shows the speed again: 18 km/h in a second is hard braking.
    let again = locked([80.0, 80.0, 62.0, 20.0, 44.0]);
    assert_eq!(again.steep_fall, None);
    assert!((again.mean - 44.0 * KMH).abs() < 1.0);
}

/// After a steep fall, the speed is that of the last sample or that of the one before the fall: the sum of
/// two normal distributions, each with its part of the errors alone, has the mean and spread of the whole.
#[test]
fn a_steep_fall_leaves_two_speeds() {
    let samples = [(-1.0, 110.0, Some(true)), (-0.5, 108.0, Some(true)), (0.0, 40.0, Some(true))];
    let found = ImpactSpeed::of(&record(&samples), &ImpactSpeedErrors::default()).unwrap();
    let [last, earlier] = found.humps.unwrap();
    assert!((last.probability - 0.5).abs() < 1e-12 && (earlier.probability - 0.5).abs() < 1e-12);
    // Hard braking reads 3 km/h low, and in the 0.05 s of the age of the speed it takes 0.66 km/h. The fall
    // of 2 km/h before the earlier speed is 0.113 g: it went on within 0.1 g of it, or by up to 0.75 g.
    assert!((last.mean - 42.34 * KMH).abs() < 0.02, "{last:?}");
    let slowed = (0.65 * 0.113 + 0.35 * 0.375) * 9.80665 * 0.55;
    let slip = 0.113 / 0.75;
    let reads_low = slip * 3.0 * KMH + (1.0 - slip) * 0.014 * 108.0 * KMH;
    assert!((earlier.mean - (108.0 * KMH + reads_low - slowed)).abs() < 0.02, "{earlier:?}");
    assert!(last.mean + 4.0 * last.sd < earlier.mean - 4.0 * earlier.sd);
    let mean = 0.5 * (last.mean + earlier.mean);
    let square = 0.5 * (last.sd.powi(2) + earlier.sd.powi(2)) + 0.25 * (earlier.mean - last.mean).powi(2);
    assert!((found.mean - mean).abs() < 0.1);
    assert!((found.sd / square.sqrt() - 1.0).abs() < 0.01, "{} {square}", found.sd);
    let rarely = ImpactSpeedErrors { last_is_of_impact: 0.2, ..ImpactSpeedErrors::default() };
    let humps = ImpactSpeed::of(&record(&samples), &rarely).unwrap().humps.unwrap();
    assert!((humps[0].probability - 0.8).abs() < 1e-12 && (humps[1].probability - 0.2).abs() < 1e-12);
    // Where no tyre allows it and it did not belong to the impact, one speed is left.
    let of_impact = ImpactSpeedErrors { last_is_of_impact: 1.0, ..ImpactSpeedErrors::default() };
    assert_eq!(ImpactSpeed::of(&record(&samples), &of_impact).unwrap().humps, None);
}

/// With the brake off, wheels neither slip nor lock: a speed that fell by more than a tyre allows and stays
/// low is that of the vehicle, which something else has slowed.
#[test]
fn wheels_without_brakes_do_not_slip() {
    let of = |brake: Option<bool>| {
        let speeds = [(-0.5, 70.0), (-0.3, 45.0), (-0.2, 44.0), (-0.1, 44.0), (0.0, 43.0)];
        let samples = speeds.map(|(time, speed)| (time, speed, brake));
        ImpactSpeed::of(&record(&samples), &ImpactSpeedErrors::default()).unwrap()
    };
    let off = of(Some(false));
    assert_eq!((off.steep_fall, off.humps), (None, None));
    assert!((43.0..45.0).contains(&(off.mean / KMH)), "{}", off.mean / KMH);
    for brake in [Some(true), None] {
        assert!(
            of(brake).steep_fall.is_some_and(|fall| fall.is_slip && fall.probability == 1.0),
            "{brake:?}"
        );
    }
}

#[test]
fn a_vehicle_that_stands_stands() {
    let standing = [(-1.0, 0.0, Some(true)), (-0.5, 0.0, Some(true)), (0.0, 0.0, Some(true))];
    let found = ImpactSpeed::of(&record(&standing), &ImpactSpeedErrors::default()).unwrap();
    assert_eq!(found.interval(2.0), [found.quantile(0.0), found.quantile(1.0)]);
    assert_eq!(found.interval(-1.0), [found.quantile(0.5); 2]);
    assert!(found.quantile(0.975) < 1.0 * KMH && found.quantile(0.0) >= 0.0, "{:?}", found.interval(0.95));
    let errors = ImpactSpeedErrors { friction: f64::NAN, ..ImpactSpeedErrors::default() };
    let error = ImpactSpeed::of(&record(&standing), &errors).unwrap_err();
    let ImpactSpeedFault::OutOfRange(error) = error else { panic!("{error}") };
    assert_eq!((error.name, error.greatest), ("friction", 1.5));
}

/// From 10 km/h, a second of any braking up to 0.75 g stops the car more often than not. The parts, with what
/// is cut off at 0, are the mean and the variance.
#[test]
fn the_parts_of_a_car_that_may_have_stopped_add_up() {
    let slow = record(&[(-1.5, 10.0, Some(true)), (-1.0, 10.0, Some(true))]);
    let found = ImpactSpeed::of(&slow, &ImpactSpeedErrors::default()).unwrap();
    let shift: f64 = found.parts.iter().map(|part| part.shift).sum();
    let variance: f64 = found.parts.iter().map(|part| part.variance).sum();
    assert!((found.stored + shift - found.mean).abs() < 1e-9, "{found:?}");
    assert!((variance - found.sd * found.sd).abs() < 1e-9, "{found:?}");
    let cut = found.parts.last().unwrap();
    assert!(cut.source == SpeedErrorSource::CutOff && cut.shift > 0.5 && cut.variance < 0.0, "{found:?}");
    // 50 km/h are never used up.
    let fast = record(&[(-1.5, 50.0, Some(true)), (-1.0, 50.0, Some(true))]);
    let found = ImpactSpeed::of(&fast, &ImpactSpeedErrors::default()).unwrap();
    assert!(found.parts.iter().all(|part| part.source != SpeedErrorSource::CutOff), "{found:?}");
}

/// Braking at 4 m/s² with a sample every tenth of a second: in steps of 5 km/h the last fall is 0 or 50 km/h
/// in a second, and that over half a second is near 4 m/s², or 14.4 km/h. Brakes that came on later count
/// alone.
#[test]
fn the_slip_is_by_the_fall_over_half_a_second() {
    let share = |speeds: [f64; 7], came_on: f64| {
        let times = [-0.6, -0.5, -0.4, -0.3, -0.2, -0.1, 0.0];
        let samples: Vec<_> =
            times.into_iter().zip(speeds).map(|(time, speed)| (time, speed, Some(time >= came_on))).collect();
        let errors = ImpactSpeedErrors { step: 5.0 * KMH, ..ImpactSpeedErrors::default() };
        let found = ImpactSpeed::of(&record(&samples), &errors).unwrap();
        let slip = found.parts.iter().find(|part| part.source == SpeedErrorSource::Slip).unwrap().shift;
        // slip = h · 3 km/h + (1 − h) · 1.4 % of the last speed
        let steady = 0.014 * speeds[6];
        (slip / KMH - steady) / (3.0 - steady)
    };
    // From 70 to 60 km/h in half a second: 5.56 m/s² of 0.75 g.
    let half = [70.0, 70.0, 65.0, 65.0, 65.0, 60.0, 60.0];
    assert!((share(half, -1.0) - 10.0 / 3.6 / 0.5 / (0.75 * 9.80665)).abs() < 1e-9);
    // On from −0.2 s on: from 65 to 60 in 0.2 s.
    assert!((share(half, -0.2) - 5.0 / 3.6 / 0.2 / (0.75 * 9.80665)).abs() < 1e-9);
}

/// The last speed is 72 km/h, after another of 72 half a second before; each row is a time and the brake,
/// after the first with a dash for the speed.
fn with_gap(brakes: &[(f64, Option<bool>)]) -> PreCrash {
    let first = brakes[0];
    let sample = |(k, (time, brake)): (usize, &(f64, Option<bool>))| PreCrashSample {
        time: *time,
        speed: (k < 2).then_some(20.0),
        brake: *brake,
        ..PreCrashSample::default()
    };
    let all: Vec<_> = [(first.0 - 0.5, first.1)].iter().chain(brakes).copied().collect();
    PreCrash::new(all.iter().enumerate().map(sample).collect()).unwrap()
}

/// Mean and standard deviation of a simulation: the time with the brake on (s) for two uniform numbers and
/// one between 0 and 1 that decides, whether it was on at the last speed, and the whole gap (s). If it is
/// known to have been on there and before, the driver may go on as shown: by not slowing at all.
fn simulated(gap: f64, is_known_on: bool, course: impl Fn([f64; 3]) -> (f64, bool)) -> [f64; 2] {
    let mut numbers = Numbers(11);
    let draws: Vec<f64> = (0..400_000)
        .map(|_| {
            let rounding = numbers.uniform(-0.5, 0.5) * KMH;
            let low = 20.0 * (0.014 + 0.0043 * numbers.normal()) + 20.0 * 0.007 * numbers.normal();
            let any = numbers.uniform(-0.75 * 9.80665, 0.0);
            let brakes = if is_known_on { goes_on(0.0, &mut numbers) } else { any };
            let coasts = numbers.uniform(-1.0, 1.0);
            let (on, was_on) = course([0; 3].map(|_: i32| numbers.uniform(0.0, 1.0)));
            let age = numbers.uniform(0.0, 0.1);
            let [on, off] = if was_on { [on + age, gap - on] } else { [on, gap - on + age] };
            (20.0 + rounding + low + brakes * on + coasts * off).max(0.0)
        })
        .collect();
    moments(&draws)
}

#[test]
fn the_brake_in_the_gap_is_that_of_a_simulation() {
    let (on, off) = (Some(true), Some(false));
    type Case<'a> = (&'a [(f64, Option<bool>)], &'a dyn Fn([f64; 3]) -> (f64, bool));
    let cases: [Case; 8] = [
        // Off in every sample up to the impact: it coasted for a second.
        (&[(-1.0, off), (-0.5, off), (0.0, off)], &|_| (0.0, false)),
        // On after half a second: it came on somewhere within it.
        (&[(-1.0, off), (-0.5, on), (0.0, on)], &|u| (0.5 + 0.5 * u[0], false)),
        (&[(-1.0, off), (-0.5, off), (0.0, on)], &|u| (0.5 * u[0], false)),
        // It went off in the first half second, and was off at the impact.
        (&[(-1.0, on), (-0.5, off), (0.0, off)], &|u| (0.5 * u[0], true)),
        // Nothing but "off" two seconds before: 1 − 0.75⁴ = 68.36 %, at any time of the two seconds.
        (&[(-2.0, off)], &|u| (if u[1] < 0.683_593_75 { 2.0 * u[0] } else { 0.0 }, false)),
        // Half a second is one interval: 25 %.
        (&[(-0.5, off)], &|u| (if u[1] < 0.25 { 0.5 * u[0] } else { 0.0 }, false)),
        // On in the last sample: braked up to the impact.
        (&[(-0.5, on)], &|_| (0.5, true)),
        // No switch: on or off with half each, and from off it comes on with 1 − 0.75² = 43.75 % in a second.
        (&[(-1.0, None)], &|u| match (u[2] < 0.5, u[1] < 0.4375) {
            (true, _) => (1.0, true),
            (false, true) => (u[0], false),
            (false, false) => (0.0, false),
        }),
    ];
    for (brakes, course) in cases {
        let found = ImpactSpeed::of(&with_gap(brakes), &ImpactSpeedErrors::default()).unwrap();
        let [mean, sd] = simulated(-brakes[0].0, brakes[0].1 == Some(true), course);
        assert!((found.mean - mean).abs() < 0.02, "{brakes:?}: {} {mean}", found.mean);
        assert!((found.sd / sd - 1.0).abs() < 0.015, "{brakes:?}: {} {sd}", found.sd);
        // The parts add up, unless some of the draws come to a standstill.
        if brakes[0].0 > -1.5 {
            let whole: f64 = found.parts.iter().map(|part| part.variance).sum();
            let shift: f64 = found.parts.iter().map(|part| part.shift).sum();
            assert!((whole.sqrt() / sd - 1.0).abs() < 0.015, "{brakes:?}: {whole} {sd}");
            assert!((20.0 + shift - mean).abs() < 0.02, "{brakes:?}: {shift} {mean}");
        }
    }
}

/// 50 km/h two seconds before, the brake off in every sample: 50.7 km/h, as the wheels read 1.4 % low, and
/// ±1 m/s² over 2 s: a standard deviation of 2.05/√3 = 1.18 m/s without the rest.
#[test]
fn a_brake_that_is_off_up_to_the_impact_takes_nothing_off() {
    let sample = |(k, time): (usize, &f64)| PreCrashSample {
        time: *time,
        speed: (k < 2).then_some(50.0 * KMH),
        brake: Some(false),
        ..PreCrashSample::default()
    };
    let times = [-2.5, -2.0, -1.5, -1.0, -0.5, 0.0];
    let record = PreCrash::new(times.iter().enumerate().map(sample).collect()).unwrap();
    let found = ImpactSpeed::of(&record, &ImpactSpeedErrors::default()).unwrap();
    assert!((found.mean / KMH - 50.7).abs() < 0.1, "{}", found.mean / KMH);
    assert!((found.sd - 1.19).abs() < 0.02, "{}", found.sd);
}

/// Slip goes by the deceleration before the last sample, whatever the switch says: 12 km/h in half a second
/// are 6.67 m/s², of which 1 m/s² is the engine: 5.67 of 6.35 m/s², so 0.892 · 3 + 0.108 · 0.84 = 2.77 km/h.
/// A single sample with the brake on shows no deceleration: half of hard braking, 1.5 + 0.28 = 1.78 km/h.
#[test]
fn slip_goes_by_the_deceleration_before_the_last_sample() {
    let shift = |samples: &[(f64, f64, Option<bool>)]| {
        let found = ImpactSpeed::of(&record(samples), &ImpactSpeedErrors::default()).unwrap();
        found.parts.iter().find(|part| part.source == SpeedErrorSource::Slip).unwrap().shift / KMH
    };
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 0.005, "{found} {expected}");
    close(shift(&[(-0.5, 72.0, Some(false)), (0.0, 60.0, Some(false))]), 2.766);
    close(shift(&[(-0.5, 72.0, Some(true)), (0.0, 60.0, Some(true))]), 2.799);
    // An engine that brakes makes no wheel slip.
    close(shift(&[(-0.5, 61.0, Some(false)), (0.0, 60.0, Some(false))]), 0.84);
    close(shift(&[(0.0, 40.0, Some(true))]), 1.78);
    close(shift(&[(0.0, 40.0, Some(false))]), 0.56);
    // Either of the two: a quarter of hard braking.
    close(shift(&[(0.0, 40.0, None)]), 1.17);
}

/// A brake that came on between the last two samples acted for a part of the time: of all drivers whose speed
/// fell by 6 km/h in half a second, those that braked late braked hard.
#[test]
fn slip_is_that_of_the_part_of_the_time_that_the_brake_acted() {
    let [before, last] = [30.0, 24.0];
    let found = ImpactSpeed::of(
        &record(&[(-0.5, before, Some(false)), (0.0, last, Some(true))]),
        &ImpactSpeedErrors::default(),
    )
    .unwrap();
    let slip = found.parts.iter().find(|part| part.source == SpeedErrorSource::Slip).unwrap();
    let mut numbers = Numbers(11);
    let mut draws = Vec::new();
    while draws.len() < 20_000 {
        let [hard, part] = [numbers.uniform(0.0, 1.0), numbers.uniform(0.0, 1.0)];
        let fall = hard * 0.75 * 9.80665 * part * 0.5 * 3.6;
        if (fall - (before - last)).abs() < 0.05 {
            let low = 3.0 + 2.1 * numbers.normal();
            draws.push(hard * low + (1.0 - hard) * last * (0.014 + 0.0043 * numbers.normal()));
        }
    }
    let [mean, sd] = moments(&draws);
    assert!((slip.shift / KMH - mean).abs() < 0.04, "{} {mean}", slip.shift / KMH);
    assert!((slip.variance.sqrt() / KMH - sd).abs() < 0.04, "{} {sd}", slip.variance.sqrt() / KMH);
}

#[test]
fn a_record_without_a_speed_tells_none() {
    let sample = PreCrashSample { time: -1.0, brake: Some(true), ..PreCrashSample::default() };
    let record = PreCrash::new(vec![sample]).unwrap();
    assert_eq!(record.samples().len(), 1);
    assert_eq!(record.speeds().count(), 0);
    let errors = ImpactSpeedErrors::default();
    assert_eq!(ImpactSpeed::of(&record, &errors), Err(ImpactSpeedFault::NoSpeed));
    assert_eq!(SampledApproach::of(&record, &errors), Err(ImpactSpeedFault::NoSpeed));
}
