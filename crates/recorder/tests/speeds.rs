//! The speed at impact against an independent simulation of its errors.

use recorder::{ImpactSpeed, ImpactSpeedErrors, PreCrash, PreCrashSample, SpeedErrorSource};

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
            let acceleration = numbers.uniform(-0.75 * 9.80665, 0.0);
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
    // The account is of all of the variance, and of all that the mean is moved by.
    let whole: f64 = found.parts.iter().map(|part| part.variance).sum();
    assert!((whole.sqrt() / sd - 1.0).abs() < 0.01, "{whole} {sd}");
    // The age alone: Var(a (g + ℓ)) − Var(a) g², by the same draws.
    let mut numbers = Numbers(8);
    let [mut with, mut without] = [Vec::new(), Vec::new()];
    for _ in 0..200_000 {
        let acceleration = numbers.uniform(-0.75 * 9.80665, 0.0);
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
    assert!((whole.sqrt() / found.sd - 1.0).abs() < 0.02, "{whole} {}", found.sd);
    // Just within 1 g, with the rounding of both speeds: 17.65 km/h in half a second.
    let within = [(-0.5, 58.0, Some(true)), (0.0, 40.0, Some(true))];
    assert_eq!(ImpactSpeed::of(&record(&within), &ImpactSpeedErrors::default()).unwrap().steep_fall, None);
}

#[test]
fn a_vehicle_that_stands_stands() {
    let standing = [(-1.0, 0.0, Some(true)), (-0.5, 0.0, Some(true)), (0.0, 0.0, Some(true))];
    let found = ImpactSpeed::of(&record(&standing), &ImpactSpeedErrors::default()).unwrap();
    assert!(found.quantile(0.975) < 1.0 * KMH && found.quantile(0.0) >= 0.0, "{:?}", found.interval(0.95));
    let errors = ImpactSpeedErrors { friction: f64::NAN, ..ImpactSpeedErrors::default() };
    let error = ImpactSpeed::of(&record(&standing), &errors).unwrap_err();
    assert_eq!((error.name, error.greatest), ("friction", 1.5));
}
