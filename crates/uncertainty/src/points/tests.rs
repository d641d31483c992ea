use super::{MAX_SOBOL_INPUTS, Points, REPLICATES, SamplingMethod, permuted};
use crate::InvalidRequest;
use crate::model::{LANES, Lanes};
use crate::random::{bits, key};

const METHODS: [SamplingMethod; 3] =
    [SamplingMethod::MonteCarlo, SamplingMethod::LatinHypercube, SamplingMethod::Sobol];

/// Points of each input, a column for each.
fn columns(method: SamplingMethod, seed: u64, inputs: usize, samples: usize) -> Vec<Vec<f64>> {
    let points = Points::new(method, seed, inputs, samples).unwrap();
    let mut columns = vec![Vec::new(); inputs];
    let mut block = vec![Lanes::ZERO; inputs];
    for number in 0..samples.div_ceil(LANES) {
        points.fill(number as u64, &mut block);
        for (column, lanes) in columns.iter_mut().zip(&block) {
            column.extend(lanes);
        }
    }
    for column in &mut columns {
        column.truncate(samples);
    }
    columns
}

#[test]
fn permutations_are_bijections() {
    for count in [1, 2, 3, 4, 5, 7, 8, 9, 63, 64, 65, 1000, 4097] {
        for key in 0..4 {
            let mut places: Vec<u32> = (0..count).map(|index| permuted(index, count, key)).collect();
            places.sort_unstable();
            assert!(places.into_iter().eq(0..count), "{count} with key {key}");
        }
    }
}

/// Over many keys each index must go to every place equally often: χ² with 15² degrees of freedom (rows and
/// columns are fixed), mean 225, standard deviation √450 = 21.2.
#[test]
fn permutations_are_fair() {
    const COUNT: usize = 16;
    let keys = 10_000;
    let mut seen = [[0.0; COUNT]; COUNT];
    for key in 0..keys {
        for (index, row) in (0..).zip(&mut seen) {
            row[permuted(index, COUNT as u32, key) as usize] += 1.0;
        }
    }
    let expected = keys as f64 / COUNT as f64;
    let chi_squared: f64 =
        seen.iter().flatten().map(|count: &f64| (count - expected).powi(2) / expected).sum();
    assert!((chi_squared - 225.0).abs() < 5.0 * 21.3, "{chi_squared}");
}

#[test]
fn latin_hypercube_has_one_point_in_each_stratum_of_each_replicate() {
    // Also with replicates of unequal size.
    for samples in [64, 65, 1000, 4096, 10_007] {
        for column in columns(SamplingMethod::LatinHypercube, 5, 3, samples) {
            for replicate in 0..REPLICATES {
                let points: Vec<f64> = column.iter().skip(replicate).step_by(REPLICATES).copied().collect();
                let mut strata: Vec<usize> =
                    points.iter().map(|share| (share * points.len() as f64) as usize).collect();
                strata.sort_unstable();
                assert!(strata.into_iter().eq(0..points.len()), "{samples} samples");
            }
        }
    }
}

/// A block walks its permutations together; each point is that of its sample alone, to the last bit.
#[test]
fn latin_hypercube_points_are_as_one_by_one() {
    for samples in [64, 65, 1000, 4096, 10_007, 66_000] {
        let all = columns(SamplingMethod::LatinHypercube, 5, 5, samples as usize);
        for (number, column) in (0..).zip(&all) {
            let input = key(5, &[2, number]);
            for (sample, share) in (0..samples).zip(column) {
                let (replicate, index) = (sample % REPLICATES as u32, sample / REPLICATES as u32);
                let count = (samples - replicate).div_ceil(REPLICATES as u32);
                let stratum = permuted(index, count, key(input, &[1, u64::from(replicate)]));
                // Twenty bits of 64 for each of three inputs, from the highest on.
                let word = bits(key(5, &[5, number / 3]), u64::from(sample));
                let place = ((word >> (44 - 20 * (number % 3))) & 0xF_FFFF) as f64;
                let width = 1.0 / f64::from(count);
                let expected = (f64::from(stratum) + (place + 0.5) / 1_048_576.0) * width;
                assert_eq!(*share, expected, "sample {sample} of {samples}");
            }
        }
    }
}

/// The greatest distance between the distribution of the points and the uniform one (Kolmogorov–Smirnov),
/// times √n.
fn kolmogorov_smirnov(mut column: Vec<f64>) -> f64 {
    column.sort_unstable_by(f64::total_cmp);
    let count = column.len() as f64;
    let distance = |(index, share): (usize, &f64)| {
        let (below, above) = (index as f64 / count, (index as f64 + 1.0) / count);
        (share - below).max(above - share)
    };
    column.iter().enumerate().map(distance).fold(0.0, f64::max) * count.sqrt()
}

#[test]
fn all_points_are_uniform() {
    for method in METHODS {
        for seed in 0..5 {
            for column in columns(method, seed, 8, 20_000) {
                assert!(column.iter().all(|share| *share > 0.0 && *share < 1.0));
                let distance = kolmogorov_smirnov(column);
                // Kolmogorov: beyond 2.2 once in 8000. Stratified points stay far below 1.
                let limit = if method == SamplingMethod::MonteCarlo { 2.2 } else { 0.2 };
                assert!(distance < limit, "{method:?}: {distance}");
                assert!(
                    method != SamplingMethod::MonteCarlo || distance > 0.3,
                    "{distance} is too even for chance"
                );
            }
        }
    }
}

#[test]
fn inputs_and_neighbouring_samples_are_not_correlated() {
    let samples = 20_000;
    // Five standard deviations, 1/√n.
    let limit = 5.0 / (samples as f64).sqrt();
    let correlation = |first: &[f64], second: &[f64]| {
        let products: f64 = first.iter().zip(second).map(|(x, y)| (x - 0.5) * (y - 0.5)).sum();
        12.0 * products / first.len() as f64
    };
    for method in METHODS {
        let columns = columns(method, 11, 31, samples);
        for (number, first) in columns.iter().enumerate() {
            assert!((correlation(first, first) - 1.0).abs() < 0.05);
            for second in &columns[number + 1..] {
                assert!(correlation(first, second).abs() < limit, "{method:?}");
            }
            if method != SamplingMethod::Sobol {
                assert!(correlation(&first[1..], &first[..samples - 1]).abs() < limit, "{method:?}");
            }
        }
        // Another seed gives other points; for scrambled ones the mean over 16 replicates, each as below.
        let others = self::columns(method, 12, 2, samples);
        let limit = if method == SamplingMethod::Sobol { 5.0 * (0.6_f64 / 16.0).sqrt() } else { limit };
        assert!(correlation(&columns[0], &others[0]).abs() < limit, "{method:?}");
    }
}

/// Each replicate must be independent of the others, or their spread would be meaningless.
#[test]
fn replicates_are_not_correlated() {
    let (samples, inputs) = (1 << 14, 8);
    let pairs = inputs * REPLICATES * (REPLICATES - 1) / 2;
    for method in METHODS {
        let mut correlations = Vec::new();
        for column in columns(method, 13, inputs, samples) {
            let of = |replicate: usize| column.iter().skip(replicate).step_by(REPLICATES);
            for first in 0..REPLICATES {
                for second in first + 1..REPLICATES {
                    let products: f64 = of(first).zip(of(second)).map(|(x, y)| (x - 0.5) * (y - 0.5)).sum();
                    correlations.push(12.0 * products / (samples / REPLICATES) as f64);
                }
            }
        }
        assert_eq!(correlations.len(), pairs);
        // Variance of a correlation: 1/n, but for Sobol' points that of the bits that shift the first four
        // digits, Σ (3/4ᵏ)² = 0.6, and next to nothing from the others.
        let variance = if method == SamplingMethod::Sobol { 0.6 } else { REPLICATES as f64 / samples as f64 };
        let mean = correlations.iter().sum::<f64>() / pairs as f64;
        let squares = correlations.iter().map(|correlation| correlation * correlation).sum::<f64>();
        assert!(mean.abs() < 5.0 * (variance / pairs as f64).sqrt(), "{method:?}: {mean}");
        let ratio = squares / (pairs as f64 * variance);
        assert!((0.75..1.3).contains(&ratio), "{method:?}: {ratio}");
    }
}

/// 465 pairs of inputs with 1,024 samples in 16 replicates; 32,131 pairs with 2,048. One scrambled set of
/// 1,024 Sobol' points has up to 0.05, independently scrambled replicates have 0.4, and chance has 1/√n =
/// 0.031, the greatest of 465 being more than three times that.
#[test]
fn pairs_of_sobol_inputs_are_hardly_correlated() {
    let greatest = |method, seed, inputs, samples| {
        let columns = columns(method, seed, inputs, samples);
        let mut greatest: f64 = 0.0;
        for (number, first) in columns.iter().enumerate() {
            for second in &columns[number + 1..] {
                let products: f64 = first.iter().zip(second).map(|(x, y)| (x - 0.5) * (y - 0.5)).sum();
                greatest = greatest.max(12.0 * products.abs() / samples as f64);
            }
        }
        greatest
    };
    for seed in 0..20 {
        let (chance, sobol) = (
            greatest(SamplingMethod::MonteCarlo, seed, 31, 1024),
            greatest(SamplingMethod::Sobol, seed, 31, 1024),
        );
        assert!(chance > 0.06, "{chance}");
        assert!(sobol < 0.05, "seed {seed}: {sobol}");
    }
    let many = greatest(SamplingMethod::Sobol, 1, 254, 2048);
    assert!(many < 0.05, "{many}");
}

/// The cancellation for two digits must not hide the effect of three from the spread between replicates: the
/// product of their signs is often the same for all points of a replicate, and then it must be a coin for
/// each replicate.
#[test]
fn products_of_three_sobol_digits_vary_between_the_replicates() {
    let seeds = 40;
    // For each seed, the first and second digits of 31 inputs for the 64 points of each replicate.
    let digits: Vec<Vec<[u64; REPLICATES]>> = (0..seeds)
        .map(|seed| {
            let pack = |(column, digit): (&Vec<f64>, f64)| {
                let mut words = [0; REPLICATES];
                for (sample, share) in column.iter().enumerate() {
                    let is_one = (share * digit) as u64 % 2 == 1;
                    words[sample % REPLICATES] |= u64::from(is_one) << (sample / REPLICATES);
                }
                words
            };
            let columns = columns(SamplingMethod::Sobol, seed, 31, 1024);
            columns.iter().flat_map(|column| [2.0, 4.0].map(|digit| pack((column, digit)))).collect()
        })
        .collect();
    let (mut varying, mut worst) = (0, 0.0_f64);
    for first in 0..62 {
        for second in 0..first {
            for third in 0..second {
                let (mut real, mut printed) = (0.0, 0.0);
                for digits in &digits {
                    let means: [f64; REPLICATES] = std::array::from_fn(|replicate| {
                        let of = |digit: usize| digits[digit][replicate];
                        1.0 - f64::from((of(first) ^ of(second) ^ of(third)).count_ones()) / 32.0
                    });
                    let mean = means.iter().sum::<f64>() / REPLICATES as f64;
                    real += mean * mean;
                    printed += means.iter().map(|of| (of - mean) * (of - mean)).sum::<f64>() / 240.0;
                }
                if real + printed > 0.0 {
                    varying += 1;
                    worst = worst.max(real / printed);
                }
            }
        }
    }
    assert!(varying > 100, "{varying}");
    // A variance from 40 seeds is uncertain by √(2/40) = 0.22; the greatest of some hundred exceeds 1 by four
    // times that.
    assert!(worst < 3.0, "{worst} of {varying}");
}

#[test]
fn requests_out_of_range_are_refused() {
    let refusal = |method, inputs, samples| Points::new(method, 1, inputs, samples).unwrap_err();
    assert_eq!(refusal(SamplingMethod::MonteCarlo, 0, 100), InvalidRequest::NoInputs);
    assert_eq!(refusal(SamplingMethod::MonteCarlo, 1, 63), InvalidRequest::Samples { samples: 63 });
    assert_eq!(
        refusal(SamplingMethod::Sobol, MAX_SOBOL_INPUTS + 1, 64),
        InvalidRequest::TooManyInputs { inputs: 257, limit: 256 }
    );
    assert!(Points::new(SamplingMethod::Sobol, 1, MAX_SOBOL_INPUTS, 64).is_ok());
    assert!(Points::new(SamplingMethod::LatinHypercube, 1, 1000, 64).is_ok());
}
