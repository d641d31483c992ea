use super::{Estimate, Place, Quantiles, Summary, order_statistics, select, sums};
use crate::points::SamplingMethod;
use crate::random::{bits, unit};

/// 0, 1, … 100 in disorder.
fn hundred() -> Vec<f64> {
    (0..=100).map(|index| f64::from(index * 37 % 101)).collect()
}

/// Of 0, 1, … 100 the quantile at p is 100p by any type that interpolates like NumPy's; the variance is n(n +
/// 1)/12, n = 101.
#[test]
fn the_statistics_of_a_hundred_numbers() {
    let summary = Summary::of(&hundred(), false, SamplingMethod::MonteCarlo).unwrap();
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
        Summary::of(&column, false, SamplingMethod::MonteCarlo),
        Summary::of(&hundred(), false, SamplingMethod::MonteCarlo)
    );
    assert_eq!(Summary::of(&[1.0, f64::NAN], false, SamplingMethod::MonteCarlo), None);
    assert_eq!(Summary::of(&[], false, SamplingMethod::Sobol), None);
}

#[test]
fn a_constant_has_no_uncertainty() {
    for method in [SamplingMethod::MonteCarlo, SamplingMethod::LatinHypercube] {
        let summary = Summary::of(&vec![3.0; 16_000], true, method).unwrap();
        let certain = |value| Estimate { value, standard_error: Some(0.0) };
        assert_eq!((summary.mean, summary.sd, summary.median), (certain(3.0), certain(0.0), certain(3.0)));
        assert_eq!(summary.intervals[3].high, certain(3.0));
    }
}

/// Replicate r holds the number r throughout: s = √(16·17/12) of the numbers 0 … 15, over √16.
#[test]
fn replicates_give_the_standard_error() {
    let column: Vec<f64> = (0..16_000).map(|index| f64::from(index % 16)).collect();
    let summary = Summary::of(&column, false, SamplingMethod::Sobol).unwrap();
    let expected = (16.0_f64 * 17.0 / 12.0).sqrt() / 4.0;
    assert!((summary.mean.standard_error.unwrap() - expected).abs() < 1e-13);
    assert_eq!(summary.sd.standard_error, Some(0.0));
    // No replicate but one.
    let mut lonely = vec![f64::NAN; 1600];
    lonely.iter_mut().step_by(16).for_each(|value| *value = 1.0);
    let lonely = Summary::of(&lonely, false, SamplingMethod::Sobol).unwrap();
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
        let summary = Summary::of(&column, true, method).unwrap();
        let found = [summary.median, summary.intervals[0].low, summary.intervals[2].low];
        let expected = [(7.5, 2.5), (3.75, 1.5), (0.0, 0.0)]
            .map(|(value, error)| Estimate { value, standard_error: Some(error) });
        assert_eq!(found, expected);
    }
    // Replicates alike, 0 … 99 in each: nothing but the one place, which is between n + 1 and n − 1 in
    // sixteen equal values each.
    let column: Vec<f64> = (0..1600).map(|index| f64::from(index / 16)).collect();
    let summary = Summary::of(&column, true, SamplingMethod::Sobol).unwrap();
    // Place 1599/2 = 799.5 between 49 and 50; 798.5 is among the 49 and 800.5 among the 50.
    assert_eq!(summary.median, Estimate { value: 49.5, standard_error: Some(0.5) });
    // Five samples beyond are enough, as for Monte Carlo.
    assert!(summary.intervals[3].low.standard_error.is_some());
    let few = Summary::of(&column[..999], true, SamplingMethod::Sobol).unwrap();
    assert_eq!(
        (few.intervals[3].low.standard_error, few.intervals[2].low.standard_error.is_some()),
        (None, true)
    );
}

#[test]
fn selection_puts_all_places_right() {
    let mut values = hundred();
    let wanted = [0, 3, 4, 50, 51, 99, 100];
    select(&mut values, 0, &wanted);
    for place in wanted {
        assert_eq!(values[place], place as f64);
    }
    // Two values: every place exists.
    let quantiles = Quantiles::of(&[2.0, 1.0]);
    assert_eq!(quantiles.values[0], 1.5);
    assert_eq!(Place::of(0.995, 2).above, 1);
}

/// Beside a full sort: values spread evenly, in clumps, all alike but one, all alike, over the whole range of
/// an `f64`, subnormal, and of both zeros.
#[test]
fn order_statistics_are_those_of_a_sort() {
    let kinds: [fn(f64) -> f64; 8] = [
        |u| u,
        |u| (7.0 * u).floor() - 3.0,
        |u| if u < 0.9999 { 1.0 } else { 1e300 },
        |_| -2.5,
        |u| (u - 0.5) * f64::MAX * 2.0,
        |u| u * 1e-310,
        |u| if u < 0.5 { -0.0 } else { 0.0 },
        |u| 1.0 / (u * u),
    ];
    for (kind, of) in (0..).zip(kinds) {
        for count in [2, 3, 100, 20_000] {
            let values: Vec<f64> = (0..count).map(|index| of(unit(bits(kind, index)))).collect();
            let mut sorted = values.clone();
            sorted.sort_unstable_by(f64::total_cmp);
            let count = values.len();
            let mut wanted = vec![0, 1, count / 7, count / 2, count / 2 + 1, count * 9 / 10, count - 1];
            wanted.retain(|place| *place < count);
            wanted.sort_unstable();
            wanted.dedup();
            let expected: Vec<f64> = wanted.iter().map(|place| sorted[*place]).collect();
            let found = order_statistics(&values, &wanted);
            assert_eq!(found, expected, "kind {kind}, {count} values");
            assert_eq!(
                order_statistics(&values, &[count - 1]),
                [sorted[count - 1]],
                "kind {kind}, {count} values"
            );
        }
    }
}

#[test]
fn sums_take_every_value_once() {
    for count in [0, 1, 7, 8, 9, 4095, 4096, 4097, 10_000] {
        let values: Vec<f64> = (1..=count).map(f64::from).collect();
        let total = f64::from(count) * f64::from(count + 1) / 2.0;
        assert_eq!(sums(&values, |x| [x, 2.0 * x]), [total, 2.0 * total]);
    }
}
