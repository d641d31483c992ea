//! Distributions: exact moments and quantiles, refusals, and samples.
#![expect(clippy::excessive_precision, reason = "constants as they were computed, with all their digits")]
#![expect(clippy::disallowed_methods, reason = "an independent formula, no bits of which are compared")]

use std::ops::ControlFlow;
use uncertainty::{
    Distribution, Function, InvalidDistribution, LANES, Lanes, Sampler, SamplingMethod, Settings, Shape,
    propagate,
};

fn assert_near(value: f64, exact: f64, relative: f64) {
    assert!((value - exact).abs() <= relative * exact.abs(), "{value} is not {exact}");
}

#[test]
fn normal_quantiles_and_moments() {
    let normal = Distribution::normal(10.0, 2.0).unwrap();
    assert_eq!((normal.mean(), normal.sd(), normal.quantile(0.5)), (10.0, 2.0, 10.0));
    // z at 97.5 %: 1.959963984540054 (mpmath).
    assert_near(normal.quantile(0.975), 10.0 + 2.0 * 1.959_963_984_540_054, 1e-15);
    assert_eq!(normal.quantile(0.0), f64::NEG_INFINITY);
    assert_eq!(normal.shape(), Shape::Normal { mean: 10.0, sd: 2.0 });
    assert_eq!(normal.truncation(), None);
}

/// Exact: the quantiles of a uniform distribution are linear in the probability, those of a triangular one
/// square roots of it.
#[test]
fn uniform_and_triangular_quantiles_and_moments() {
    let uniform = Distribution::uniform(-8.0, 8.0).unwrap();
    for (share, value) in [(0.0, -8.0), (0.25, -4.0), (0.5, 0.0), (0.75, 4.0), (1.0, 8.0)] {
        assert_eq!(uniform.quantile(share), value);
    }
    assert_eq!(uniform.mean(), 0.0);
    assert_near(uniform.sd(), 16.0 / 12.0_f64.sqrt(), 1e-15);

    // F(mode) = ¼: below, x = 4√u; above, 4 − √(12(1 − u)).
    let triangular = Distribution::triangular(0.0, 1.0, 4.0).unwrap();
    for (share, value) in [(0.0, 0.0), (0.0625, 0.5), (0.25, 1.0), (0.8125, 2.5), (1.0, 4.0)] {
        assert_near(triangular.quantile(share), value, 1e-15);
    }
    assert_near(triangular.mean(), 5.0 / 3.0, 1e-15);
    // σ² = (0 + 1 + 16 − 0 − 0 − 4)/18
    assert_near(triangular.sd(), (13.0_f64 / 18.0).sqrt(), 1e-15);

    // The mode may lie on a bound.
    let rising = Distribution::triangular(0.0, 2.0, 2.0).unwrap();
    assert_eq!((rising.quantile(0.25), rising.quantile(1.0)), (1.0, 2.0));
    let falling = Distribution::triangular(0.0, 0.0, 2.0).unwrap();
    assert_eq!((falling.quantile(0.75), falling.quantile(0.0)), (1.0, 0.0));
}

/// Compared with an integration of the density by the midpoint rule, which uses neither formulas of the
/// moments nor the inverse of the normal distribution.
#[test]
fn log_normal_quantiles_and_moments() {
    for (median, ln_sd) in [(1.0, 0.38), (2.5, 0.59), (0.1, 0.05)] {
        let distribution = Distribution::log_normal(median, ln_sd).unwrap();
        let (low, high): (f64, f64) = (median * (-9.0 * ln_sd).exp(), median * (9.0 * ln_sd).exp());
        let steps = 400_000;
        let (mut share, mut mean, mut square) = (0.0, 0.0, 0.0);
        let mut quantiles = [0.025, 0.16, 0.5, 0.9].map(|u| (u, f64::NAN));
        let ratio = (high / low).powf(1.0 / f64::from(steps));
        for step in 0..steps {
            let left = low * ratio.powi(step);
            let (x, width) = (left * ratio.sqrt(), left * (ratio - 1.0));
            let z = (x / median).ln() / ln_sd;
            let weight = (-0.5 * z * z).exp() / (x * ln_sd * std::f64::consts::TAU.sqrt()) * width;
            share += weight;
            mean += weight * x;
            square += weight * x * x;
            for (u, quantile) in &mut quantiles {
                if quantile.is_nan() && share >= *u {
                    *quantile = x;
                }
            }
        }
        assert_near(share, 1.0, 1e-8);
        assert_near(distribution.mean(), mean, 1e-7);
        assert_near(distribution.sd(), (square - mean * mean).sqrt(), 1e-6);
        for (u, quantile) in quantiles {
            assert_near(distribution.quantile(u), quantile, 1e-4);
        }
        assert_eq!(distribution.shape(), Shape::LogNormal { median, ln_sd });
    }
    assert!(Distribution::log_normal(0.0, 0.1).is_err() && Distribution::log_normal(1.0, 0.0).is_err());
    assert!(Distribution::log_normal(1.0, 80.0).is_err() && Distribution::log_normal(f64::NAN, 1.0).is_err());
}

/// Values by mpmath 1.3 with 40 digits, for a standard normal variable.
#[test]
fn truncated_normal_moments_and_quantiles() {
    let infinity = f64::INFINITY;
    // (low, high, kept, mean, sd)
    let table = [
        (0.0, infinity, 0.5, 0.797_884_560_802_865_36, 0.602_810_274_989_086_97),
        (-1.0, 2.0, 0.818_594_614_120_363_74, 0.229_637_179_091_328_97, 0.720_945_586_859_045_79),
        (-infinity, -2.0, 0.022_750_131_948_179_207, -2.373_215_532_822_840_9, 0.338_051_919_701_813_34),
        (3.0, 4.0, 0.001_318_226_789_796_974_6, 3.260_454_285_590_021_2, 0.221_986_021_581_074_17),
    ];
    for (low, high, kept, mean, sd) in table {
        for (scale, place) in [(1.0, 0.0), (2.5, -7.0)] {
            let (low, high) = (place + scale * low, place + scale * high);
            let truncated = Distribution::truncated_normal(place, scale, low, high).unwrap();
            assert_near(truncated.truncation().unwrap().kept, kept, 1e-12);
            assert_near(truncated.mean(), place + scale * mean, 1e-13);
            assert_near(truncated.sd(), scale * sd, 1e-13);
            // Up to the rounding of the probability near its ends, where the density is least.
            let (least, most) = (truncated.quantile(0.0), truncated.quantile(1.0));
            if low.is_finite() {
                assert_near(least, low, 1e-12);
            }
            if high.is_finite() {
                assert_near(most, high, 1e-12);
            }
            assert!(least >= low && most <= high && least < most);
        }
    }
    // Half of a normal: its quantile at u is that of the whole at (1 + u)/2.
    let half = Distribution::truncated_normal(0.0, 1.0, 0.0, infinity).unwrap();
    for share in [0.125, 0.5, 0.875, 1.0 - f64::EPSILON] {
        let whole = Distribution::normal(0.0, 1.0).unwrap();
        assert_near(half.quantile(share), -whole.quantile((1.0 - share) / 2.0), 1e-15);
    }
    // Bounds without effect.
    let wide = Distribution::truncated_normal(5.0, 0.1, 0.0, infinity).unwrap();
    assert_eq!(wide.truncation().unwrap().kept, 1.0);
    assert_near(wide.sd(), 0.1, 1e-13);
    assert_near(wide.quantile(0.3), Distribution::normal(5.0, 0.1).unwrap().quantile(0.3), 1e-15);
}

#[test]
fn what_makes_no_distribution_is_refused() {
    let no_deviation = Err(InvalidDistribution::NoDeviation { sd: 0.0 });
    assert_eq!(Distribution::normal(1.0, 0.0), no_deviation);
    assert_eq!(Distribution::uniform(2.0, 2.0), Err(InvalidDistribution::Empty { low: 2.0, high: 2.0 }));
    assert_eq!(
        Distribution::triangular(0.0, 3.0, 2.0),
        Err(InvalidDistribution::ModeOutside { low: 0.0, mode: 3.0, high: 2.0 })
    );
    for bad in [f64::NAN, f64::INFINITY, f64::MAX] {
        let refused = [
            Distribution::normal(bad, f64::MAX).is_err(),
            Distribution::normal(0.0, bad).is_err(),
            Distribution::uniform(-f64::MAX, bad).is_err(),
            Distribution::triangular(0.0, bad, 1.0).is_err(),
            Distribution::triangular(-f64::MAX, 0.0, bad).is_err(),
        ];
        assert_eq!(refused, [true; 5], "{bad}");
    }
    assert!(Distribution::truncated_normal(0.0, 1.0, f64::NAN, 1.0).is_err());
    // exp(s²) of the variance is 10⁶⁹⁵, although no sample is beyond 10⁷⁴.
    assert!(
        Distribution::log_normal(1e-100, 40.0).is_err() && Distribution::log_normal(1e-100, 10.0).is_ok()
    );
    assert!(Distribution::truncated_normal(0.0, 1.0, 1.0, 1.0).is_err());
    // Φ(−5) = 2.9e-7 is below the minimum probability, Φ(−4.7) = 1.3e-6 above.
    let refused = Distribution::truncated_normal(0.0, 1.0, 5.0, f64::INFINITY).unwrap_err();
    let text = refused.to_string();
    assert!(text.contains("between 5 and inf with a probability of only 2.9e-7"), "{text}");
    assert!(Distribution::truncated_normal(0.0, 1.0, 4.7, f64::INFINITY).is_ok());
}

/// Samples of each distribution compared with its cumulative distribution, written out here
/// (Kolmogorov–Smirnov).
#[test]
fn samples_follow_their_distribution() {
    let inputs = [
        Distribution::uniform(-3.0, 5.0).unwrap(),
        Distribution::triangular(1.0, 2.0, 4.0).unwrap(),
        Distribution::normal(0.0, 1.0).unwrap(),
        Distribution::truncated_normal(0.0, 1.0, -0.5, 1.0).unwrap(),
        Distribution::log_normal(2.0, 0.4).unwrap(),
    ];
    let identity = Function::new(5, |x: &[f64], y: &mut [f64]| {
        y.copy_from_slice(x);
        Ok(())
    });
    let settings = Settings::new(SamplingMethod::MonteCarlo, 50_000, 3);
    let result = propagate(&identity, &inputs, &settings, &mut |_, _| ControlFlow::Continue(())).unwrap();

    let uniform = |x: f64| (x + 3.0) / 8.0;
    let triangular = |x: f64| if x < 2.0 { (x - 1.0).powi(2) / 3.0 } else { 1.0 - (4.0 - x).powi(2) / 6.0 };
    // Abramowitz and Stegun, 7.1.26, good to 1.5e-7.
    let normal = |x: f64| {
        let z = x.abs() / 2.0_f64.sqrt();
        let t = 1.0 / (1.0 + 0.327_591_1 * z);
        let series = [0.254_829_592, -0.284_496_736, 1.421_413_741, -1.453_152_027, 1.061_405_429];
        let tail = series.iter().rev().fold(0.0, |sum, a| t * (a + sum)) * (-z * z).exp() / 2.0;
        if x < 0.0 { tail } else { 1.0 - tail }
    };
    let (start, end) = (normal(-0.5), normal(1.0));
    let truncated = |x: f64| (normal(x) - start) / (end - start);
    let log_normal = |x: f64| normal((x / 2.0).ln() / 0.4);
    let shares: [&dyn Fn(f64) -> f64; 5] = [&uniform, &triangular, &normal, &truncated, &log_normal];

    for ((column, share), input) in result.columns().iter().zip(shares).zip(&inputs) {
        let mut sorted = column.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let count = sorted.len() as f64;
        let distance = |(index, &x): (usize, &f64)| {
            let (below, above) = (index as f64 / count, (index as f64 + 1.0) / count);
            (share(x) - below).max(above - share(x))
        };
        // Kolmogorov: √n times the distance is beyond 2 once in 1500.
        let greatest = sorted.iter().enumerate().map(distance).fold(0.0, f64::max) * count.sqrt();
        assert!(greatest < 2.0 && greatest > 0.2, "{input:?}: {greatest}");
    }
    for (summary, input) in result.summaries().iter().zip(&inputs) {
        let summary = summary.unwrap();
        assert!((summary.mean.value - input.mean()).abs() < 4.0 * summary.mean.standard_error.unwrap());
        assert!((summary.sd.value - input.sd()).abs() < 4.0 * summary.sd.standard_error.unwrap());
    }
}

/// Box–Muller turns two uniform numbers into two normal ones, half a block apart: neither they nor their
/// squares are correlated, within a block or from input to input.
#[test]
fn normal_samples_are_independent() {
    let inputs = [Distribution::normal(0.0, 1.0).unwrap(), Distribution::normal(0.0, 1.0).unwrap()];
    let settings = Settings::new(SamplingMethod::MonteCarlo, 64_000, 11);
    let sampler = Sampler::new(&inputs, &settings).unwrap();
    let mut columns = [Lanes::ZERO; 2];
    let (mut pairs, mut neighbours, mut across) = (Vec::new(), Vec::new(), Vec::new());
    for block in 0..1000 {
        sampler.fill(block, &mut columns);
        for lane in 0..LANES / 2 {
            pairs.push((columns[0][lane], columns[0][lane + LANES / 2]));
            neighbours.push((columns[0][2 * lane], columns[0][2 * lane + 1]));
            across.push((columns[0][lane], columns[1][lane]));
        }
    }
    for (kind, pairs) in [("pairs", pairs), ("neighbours", neighbours), ("inputs", across)] {
        let count = pairs.len() as f64;
        // E[xy] = 0 ± 1/√n; E[(x² − 1)(y² − 1)] = 0 ± 2/√n, as Var(x²) = 2
        let product: f64 = pairs.iter().map(|(x, y)| x * y).sum::<f64>() / count;
        let squares: f64 = pairs.iter().map(|(x, y)| (x * x - 1.0) * (y * y - 1.0)).sum::<f64>() / count;
        assert!(product.abs() < 4.0 / count.sqrt(), "{kind}: {product}");
        assert!(squares.abs() < 8.0 / count.sqrt(), "{kind}: {squares}");
    }
}

/// However close a bound is, even if the mean lies outside.
#[test]
fn no_independent_sample_leaves_its_bounds() {
    let infinity = f64::INFINITY;
    let bounds = [
        [-1.0, infinity],
        [-infinity, 1.0],
        [-0.5, 4.0],
        [-4.0, 0.5],
        [0.5, 3.0],
        [-3.0, -0.5],
        [-7.0, 2.0],
        [-2.5, 2.5],
    ]
    .map(|deviations| deviations.map(|deviation| 10.0 + 2.0 * deviation));
    let inputs = bounds.map(|[low, high]| Distribution::truncated_normal(10.0, 2.0, low, high).unwrap());
    let sampler = Sampler::new(&inputs, &Settings::new(SamplingMethod::MonteCarlo, 8192, 3)).unwrap();
    let mut columns = [Lanes::ZERO; 8];
    for block in 0..8192 / LANES as u64 {
        sampler.fill(block, &mut columns);
        for (column, [low, high]) in columns.iter().zip(bounds) {
            assert!(column.iter().all(|value| (low..=high).contains(value)), "{low} to {high}: {column:?}");
        }
    }
}
