use super::{Classes, Estimate, Histogram, Place, Summary, order_statistic};
use crate::points::SamplingMethod;
use crate::random::{bits, unit};

fn of_column(column: &[f64], method: SamplingMethod) -> Option<Summary> {
    Summary::of(column, method != SamplingMethod::MonteCarlo)
}

/// 0, 1, … 100, shuffled.
fn hundred() -> Vec<f64> {
    (0..=100).map(|index| f64::from(index * 37 % 101)).collect()
}

/// For 0, 1, … 100 the quantile at p is 100p by any type that interpolates like NumPy's, and the variance is
/// n(n + 1)/12, n = 101.
#[test]
fn the_statistics_of_a_hundred_numbers() {
    let summary = of_column(&hundred(), SamplingMethod::MonteCarlo).unwrap();
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
    // Five values lie below the 5 % quantile, fewer below that of 2.5 %.
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
        of_column(&column, SamplingMethod::MonteCarlo),
        of_column(&hundred(), SamplingMethod::MonteCarlo)
    );
    assert_eq!(of_column(&[1.0, f64::NAN], SamplingMethod::MonteCarlo), None);
    assert_eq!(of_column(&[], SamplingMethod::Sobol), None);
}

#[test]
fn a_constant_has_no_uncertainty() {
    for method in [SamplingMethod::MonteCarlo, SamplingMethod::LatinHypercube] {
        let summary = of_column(&vec![3.0; 16_000], method).unwrap();
        let certain = |value| Estimate { value, standard_error: Some(0.0) };
        assert_eq!((summary.mean, summary.sd, summary.median), (certain(3.0), certain(0.0), certain(3.0)));
        assert_eq!(summary.intervals[3].high, certain(3.0));
    }
}

/// Every value of replicate r is r: s = √(16·17/12) for the numbers 0 … 15, divided by √16.
#[test]
fn replicates_give_the_standard_error() {
    let column: Vec<f64> = (0..16_000).map(|index| f64::from(index % 16)).collect();
    let summary = of_column(&column, SamplingMethod::Sobol).unwrap();
    let expected = (16.0_f64 * 17.0 / 12.0).sqrt() / 4.0;
    assert!((summary.mean.standard_error.unwrap() - expected).abs() < 1e-13);
    assert_eq!(summary.sd.standard_error, Some(0.0));
    // Only one replicate has values.
    let mut lonely = vec![f64::NAN; 1600];
    lonely.iter_mut().step_by(16).for_each(|value| *value = 1.0);
    let lonely = of_column(&lonely, SamplingMethod::Sobol).unwrap();
    assert_eq!((lonely.mean.standard_error, lonely.median.standard_error), (None, None));
}

/// A thousand values in each replicate. The median is 7.5: all values of eight replicates lie below and none
/// of the others, so that the counts differ from their mean of 500 by 500. So √(16/15·16·500² + 1) = 2065.6
/// places before and after place 7999.5: 5933.9 and 10065.1, of values 5 and 10. The lower quartile, place
/// 3999.75, is 3 + ¾: four replicates below, 4·750² + 12·250² = 3·10⁶, √(16/15·3·10⁶ + 1) = 1788.9 places:
/// 2210.9 and 5788.6, values 2 and 5. A value at the quantile itself counts by half: at 2.5 %, place 399.975
/// of value 0, 500 of replicate 0 lie below, and the mean is 31.25: √(16/15·(468.75² + 15·31.25²) + 1) =
/// 500.0: from place 0 to 900 all are 0.
#[test]
fn numbers_below_a_quantile_give_its_standard_error() {
    let column: Vec<f64> = (0..16_000).map(|index| f64::from(index % 16)).collect();
    for method in [SamplingMethod::LatinHypercube, SamplingMethod::Sobol] {
        let summary = of_column(&column, method).unwrap();
        let found = [summary.median, summary.intervals[0].low, summary.intervals[2].low];
        let expected = [(7.5, 2.5), (3.75, 1.5), (0.0, 0.0)]
            .map(|(value, error)| Estimate { value, standard_error: Some(error) });
        assert_eq!(found, expected);
    }
    // Equal replicates, 0 … 99 in each: only the one place is left, which lies between n + 1 and n − 1 in
    // sixteen equal values each.
    let column: Vec<f64> = (0..1600).map(|index| f64::from(index / 16)).collect();
    let summary = of_column(&column, SamplingMethod::Sobol).unwrap();
    // Place 1599/2 = 799.5 between 49 and 50; 798.5 is among the 49 and 800.5 among the 50.
    assert_eq!(summary.median, Estimate { value: 49.5, standard_error: Some(0.5) });
    // Five samples beyond are enough, as for Monte Carlo.
    assert!(summary.intervals[3].low.standard_error.is_some());
    let few = of_column(&column[..999], SamplingMethod::Sobol).unwrap();
    assert_eq!(
        (few.intervals[3].low.standard_error, few.intervals[2].low.standard_error.is_some()),
        (None, true)
    );
}

/// The quantile of sorted values, as defined by NumPy.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place among the values")]
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let position = (sorted.len() - 1) as f64 * share;
    let before = sorted[position.floor() as usize];
    let after = sorted[(position.floor() as usize + 1).min(sorted.len() - 1)];
    before + (after - before) * (position - position.floor())
}

/// Values spread evenly, with a long tail, in three clusters, half of them equal, all but a few equal, all
/// equal, subnormal, of both zeros, and first small and then large, compared with a full sort, with and
/// without failed samples.
#[test]
fn quantiles_are_those_of_a_full_sort() {
    let kinds: [fn(f64, u64) -> f64; 9] = [
        |u, _| u,
        |u, _| 1.0 / (u * u),
        |u, _| (3.0 * u).floor(),
        |u, _| if u < 0.6 { 0.5 } else { u },
        |u, _| if u < 0.9999 { 1.0 } else { 1e300 },
        |_, _| 4.0,
        |u, _| u * 1e-310,
        |u, _| if u < 0.5 { -0.0 } else { 0.0 },
        |u, index| if index < 5000 { u } else { 10.0 + u },
    ];
    for (kind, of) in (0..).zip(kinds) {
        for count in [2, 40, 1000, 5000, 100_003] {
            for failing in [0.0, 0.3] {
                let value = |index| {
                    let fails = unit(bits(17, index)) < failing;
                    if fails { f64::NAN } else { of(unit(bits(kind, index)), index) }
                };
                let column: Vec<f64> = (0..count).map(value).collect();
                let mut sorted: Vec<f64> = column.iter().copied().filter(|value| !value.is_nan()).collect();
                sorted.sort_unstable_by(f64::total_cmp);
                for (_, method) in SamplingMethod::WORDS {
                    let summary = of_column(&column, method);
                    assert_eq!(summary.is_some(), sorted.len() >= 2, "kind {kind}, {count}");
                    let Some(summary) = summary else { continue };
                    assert_eq!(summary.samples, sorted.len());
                    let ends = summary.intervals.map(|interval| {
                        let below = 0.5 - 0.5 * interval.level;
                        [(interval.low.value, below), (interval.high.value, 1.0 - below)]
                    });
                    for (found, share) in ends.into_iter().flatten().chain([(summary.median.value, 0.5)]) {
                        let expected = quantile(&sorted, share);
                        let is_near = (found - expected).abs() <= 1e-12 * expected.abs();
                        assert!(is_near, "kind {kind}, {count}, {share}: {found} {expected}");
                    }
                }
            }
        }
    }
}

#[test]
fn two_values_have_every_place() {
    let summary = of_column(&[2.0, 1.0], SamplingMethod::MonteCarlo).unwrap();
    assert_eq!(summary.median.value, 1.5);
    assert_eq!(Place::of(0.995, 2).above, 1);
}

/// 0, 1, … 100: the middle 99 % lie from 0.5 to 99.5, and the 40 classes between are 99/40 = 2.475 wide.
#[test]
fn a_histogram_counts_every_sample() {
    let column = hundred();
    let summary = of_column(&column, SamplingMethod::MonteCarlo).unwrap();
    let histogram = Histogram::of(&column, &summary, Classes::Fine).unwrap();
    assert!((histogram.low - 0.5).abs() < 1e-12 && (histogram.width - 2.475).abs() < 1e-12);
    assert_eq!(histogram.outside, [1, 1]);
    // 1 and 2 lie below 2.975.
    assert_eq!(histogram.counts[0], 2);
    assert_eq!(histogram.counts.iter().sum::<usize>(), 99);
    let alike = of_column(&[3.0; 9], SamplingMethod::MonteCarlo).unwrap();
    assert_eq!(Histogram::of(&[3.0; 9], &alike, Classes::Fine), None);
}

/// By hand, among 1, 2, 4, 8: type 7 puts the median at (4 − 1)/2, type 5 the lower quartile at 4/4 − ½. A
/// position beyond an end counts as that end, and one at a value needs no other.
#[test]
fn an_order_statistic_is_linear_between_two_values() {
    let values = [1.0, 2.0, 4.0, 8.0];
    for (position, expected) in [(1.5, 3.0), (0.5, 1.5), (2.0, 4.0), (2.25, 5.0), (-0.5, 1.0), (3.5, 8.0)] {
        assert_eq!(order_statistic(&values, position), expected, "{position}");
    }
    assert_eq!(order_statistic(&[1.0, f64::INFINITY], 0.0), 1.0);
    assert!(order_statistic(&[], 0.0).is_nan() && order_statistic(&[1.0, 2.0], f64::NAN).is_nan());
}
