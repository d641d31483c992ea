use super::{Chunk, Classes, Estimate, First, Histogram, Passes, Place, SPAN, Size, Summary, without_nan};
use crate::points::SamplingMethod;
use crate::random::{bits, unit};
use crate::sampler::Settings;

/// At once, of no number of samples and no seed, which a summary does not read.
fn by(method: SamplingMethod) -> Passes {
    Passes::new(&Settings::new(method, 0, 0), Size::AT_ONCE, &[])
}

/// 0, 1, … 100 in disorder.
fn hundred() -> Vec<f64> {
    (0..=100).map(|index| f64::from(index * 37 % 101)).collect()
}

/// Of 0, 1, … 100 the quantile at p is 100p by any type that interpolates like NumPy's; the variance is n(n +
/// 1)/12, n = 101.
#[test]
fn the_statistics_of_a_hundred_numbers() {
    let summary = Summary::of(&hundred(), false, by(SamplingMethod::MonteCarlo)).unwrap();
    assert_eq!(summary.samples, 101);
    assert_eq!(summary.mean.value, 50.0);
    assert!((summary.sd.value - (101.0_f64 * 102.0 / 12.0).sqrt()).abs() < 1e-13);
    assert_eq!(summary.median.value, 50.0);
    let ends = summary.intervals.map(|interval| (interval.level, interval.low.value, interval.high.value));
    let expected = [(0.5, 25.0, 75.0), (0.9, 5.0, 95.0), (0.95, 2.5, 97.5), (0.99, 0.5, 99.5)];
    for (found, expected) in ends.into_iter().zip(expected) {
        assert_eq!(found.0, expected.0);
        assert!((found.1 - expected.1).abs() < 1e-12 && (found.2 - expected.2).abs() < 1e-12);
    }
    // Median: √(101/4) = 5.02, so the order statistics 45 and 55, half of whose distance is 5.
    assert_eq!(summary.median.standard_error, Some(5.0));
    // At 5 % five values lie below, at 2.5 % not.
    assert!(summary.intervals[1].low.standard_error.is_some());
    assert_eq!(summary.intervals[2].low.standard_error, None);
    // s/√n = √(n(n + 1)/12/n) = √(102/12)
    assert!((summary.mean.standard_error.unwrap() - (102.0_f64 / 12.0).sqrt()).abs() < 1e-13);
}

#[test]
fn failed_samples_are_left_out() {
    let mut column = hundred();
    for place in [0, 50, 101] {
        column.insert(place, f64::NAN);
    }
    assert_eq!(
        Summary::of(&column, false, by(SamplingMethod::MonteCarlo)),
        Summary::of(&hundred(), false, by(SamplingMethod::MonteCarlo))
    );
    assert_eq!(Summary::of(&[1.0, f64::NAN], false, by(SamplingMethod::MonteCarlo)), None);
    assert_eq!(Summary::of(&[], false, by(SamplingMethod::Sobol)), None);
}

#[test]
fn a_constant_has_no_uncertainty() {
    for method in [SamplingMethod::MonteCarlo, SamplingMethod::LatinHypercube] {
        let summary = Summary::of(&vec![3.0; 16_000], true, by(method)).unwrap();
        let certain = |value| Estimate { value, standard_error: Some(0.0) };
        assert_eq!((summary.mean, summary.sd, summary.median), (certain(3.0), certain(0.0), certain(3.0)));
        assert_eq!(summary.intervals[3].high, certain(3.0));
    }
}

/// Replicate r holds the number r throughout: s = √(16·17/12) of the numbers 0 … 15, over √16.
#[test]
fn replicates_give_the_standard_error() {
    let column: Vec<f64> = (0..16_000).map(|index| f64::from(index % 16)).collect();
    let summary = Summary::of(&column, false, by(SamplingMethod::Sobol)).unwrap();
    let expected = (16.0_f64 * 17.0 / 12.0).sqrt() / 4.0;
    assert!((summary.mean.standard_error.unwrap() - expected).abs() < 1e-13);
    assert_eq!(summary.sd.standard_error, Some(0.0));
    // No replicate but one.
    let mut lonely = vec![f64::NAN; 1600];
    lonely.iter_mut().step_by(16).for_each(|value| *value = 1.0);
    let lonely = Summary::of(&lonely, false, by(SamplingMethod::Sobol)).unwrap();
    assert_eq!((lonely.mean.standard_error, lonely.median.standard_error), (None, None));
}

/// A thousand values of each replicate. The median is 7.5: all of eight replicates lie below and none of the
/// others, which differ from the mean of 500 by 500. So √(16/15·16·500² + 1) = 2065.6 places before and after
/// place 7999.5: 5933.9 and 10065.1, of values 5 and 10. The lower quartile, place 3999.75, is 3 + ¾: four
/// replicates below, 4·750² + 12·250² = 3·10⁶, √(16/15·3·10⁶ + 1) = 1788.9 places: 2210.9 and 5788.6, values
/// 2 and 5. With the value at the quantile itself in one replicate, half of that counts: at 2.5 %, place
/// 399.975 of value 0, 500 of replicate 0 lie below, and the mean is 31.25: √(16/15·(468.75² + 15·31.25²) +
/// 1) = 500.0: from place 0 to 900 all are 0.
#[test]
fn numbers_below_a_quantile_give_its_standard_error() {
    let column: Vec<f64> = (0..16_000).map(|index| f64::from(index % 16)).collect();
    for method in [SamplingMethod::LatinHypercube, SamplingMethod::Sobol] {
        let summary = Summary::of(&column, true, by(method)).unwrap();
        let found = [summary.median, summary.intervals[0].low, summary.intervals[2].low];
        let expected = [(7.5, 2.5), (3.75, 1.5), (0.0, 0.0)]
            .map(|(value, error)| Estimate { value, standard_error: Some(error) });
        assert_eq!(found, expected);
    }
    // Replicates alike, 0 … 99 in each: nothing but the one place, which is between n + 1 and n − 1 in
    // sixteen equal values each.
    let column: Vec<f64> = (0..1600).map(|index| f64::from(index / 16)).collect();
    let summary = Summary::of(&column, true, by(SamplingMethod::Sobol)).unwrap();
    // Place 1599/2 = 799.5 between 49 and 50; 798.5 is among the 49 and 800.5 among the 50.
    assert_eq!(summary.median, Estimate { value: 49.5, standard_error: Some(0.5) });
    // Five samples beyond are enough, as for Monte Carlo.
    assert!(summary.intervals[3].low.standard_error.is_some());
    let few = Summary::of(&column[..999], true, by(SamplingMethod::Sobol)).unwrap();
    assert_eq!(
        (few.intervals[3].low.standard_error, few.intervals[2].low.standard_error.is_some()),
        (None, true)
    );
}

/// Cut into chunks, with so few cells that these are cut again: the same bits, with samples that failed and
/// without.
#[test]
fn a_summary_is_the_same_however_its_column_is_cut() {
    let kinds: [fn(f64) -> f64; 4] = [|u| u, |u| 1.0 / u, |u| (3.0 * u).floor(), |_| 4.0];
    let size = Size { cells: 32, most: 16 };
    for (kind, of) in (0..).zip(kinds) {
        for count in [2, 40, 1000, 100_000] {
            for failing in [0.0, 0.3] {
                let value = |index| {
                    let fails = unit(bits(17, index)) < failing;
                    if fails { f64::NAN } else { of(unit(bits(kind, index))) }
                };
                let column: Vec<f64> = (0..count).map(value).collect();
                for (_, method) in SamplingMethod::WORDS {
                    let expected = Summary::of(&column, failing == 0.0, by(method));
                    let mut passes = Passes::new(&Settings::new(method, 0, 0), size, &[Classes::Coarse]);
                    loop {
                        for all in column.chunks(2048) {
                            passes.add(Chunk { all, answered: &without_nan(all) });
                        }
                        if !passes.go_on() {
                            break;
                        }
                    }
                    assert_eq!(passes.summary(), expected, "kind {kind}, {count} samples, {method:?}");
                    let histogram =
                        expected.and_then(|summary| Histogram::of(&column, &summary, Classes::Coarse));
                    assert_eq!(passes.histograms(), Vec::from_iter(histogram));
                }
            }
        }
    }
}

#[test]
fn two_values_have_every_place() {
    let summary = Summary::of(&[2.0, 1.0], true, by(SamplingMethod::MonteCarlo)).unwrap();
    assert_eq!(summary.median.value, 1.5);
    assert_eq!(Place::of(0.995, 2).above, 1);
}

/// 0, 1, … 100: the middle 99 % lie from 0.5 to 99.5, and the 40 classes between are 99/40 = 2.475 wide.
#[test]
fn a_histogram_counts_every_sample() {
    let column = hundred();
    let summary = Summary::of(&column, true, by(SamplingMethod::MonteCarlo)).unwrap();
    let histogram = Histogram::of(&column, &summary, Classes::Fine).unwrap();
    assert!((histogram.low - 0.5).abs() < 1e-12 && (histogram.width - 2.475).abs() < 1e-12);
    assert_eq!(histogram.outside, [1, 1]);
    // 1 and 2 lie below 2.975.
    assert_eq!(histogram.counts[0], 2);
    assert_eq!(histogram.counts.iter().sum::<usize>(), 99);
    let alike = Summary::of(&[3.0; 9], true, by(SamplingMethod::MonteCarlo)).unwrap();
    assert_eq!(Histogram::of(&[3.0; 9], &alike, Classes::Fine), None);
}

/// The spans from the last to the first, as threads might do them.
#[test]
fn a_first_pass_by_spans_has_the_bits_of_one_over_the_column() {
    let random = |key: u64| (0..30_000).map(move |index| 1.0 / unit(bits(key, index)));
    let mut columns: [Vec<f64>; 2] = [random(1).collect(), random(2).collect()];
    let settings = Settings::new(SamplingMethod::MonteCarlo, 0, 0);
    let first = First::new(settings.instructions);
    let spans = columns[0].len().div_ceil(SPAN);
    let add = |span: usize| {
        let parts = columns.iter_mut().filter_map(|column| column.chunks_mut(SPAN).nth(span));
        first.add(&parts.collect::<Vec<_>>())
    };
    let mut sums: Vec<Vec<f64>> = (0..spans).rev().map(add).collect();
    sums.reverse();
    let begun = first.passes(&settings, columns[0].len(), &sums);
    assert_eq!(begun.len(), 2);
    for (column, begun) in columns.iter().zip(begun) {
        assert_eq!(Summary::of(column, true, begun), Summary::of(column, true, by(settings.method)));
    }
}
