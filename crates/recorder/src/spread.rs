//! A distribution as evenly spread points, and the normal distribution.

use real::elementary::ln;

/// Numbers of a distribution, in order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Draws(Vec<f64>);

impl Draws {
    pub(crate) fn new(mut numbers: Vec<f64>) -> Self {
        numbers.sort_by(f64::total_cmp);
        Self(numbers)
    }

    /// Mean and standard deviation.
    pub(crate) fn moments(&self) -> [f64; 2] {
        let count = count(self.0.len());
        let mean = self.0.iter().sum::<f64>() / count;
        let variance = self.0.iter().map(|number| (number - mean) * (number - mean)).sum::<f64>() / count;
        [mean, variance.sqrt()]
    }

    pub(crate) fn quantile(&self, probability: f64) -> f64 {
        let (Some(first), Some(last)) = (self.0.first(), self.0.last()) else { return f64::NAN };
        let at = probability.clamp(0.0, 1.0) * count(self.0.len()) - 0.5;
        if at <= 0.0 {
            return *first;
        }
        let below = (1..self.0.len()).take_while(|k| count(*k) <= at).count();
        let share = (at - count(below)).clamp(0.0, 1.0);
        let upper = self.0.get(below + 1).unwrap_or(last);
        self.0[below] + (upper - self.0[below]) * share
    }

    pub(crate) fn density(&self, bins: usize) -> Vec<(f64, f64)> {
        let (Some(first), Some(last)) = (self.0.first(), self.0.last()) else { return Vec::new() };
        let width = (last - first) / count(bins.max(1));
        if width <= 0.0 {
            return vec![(*first, f64::INFINITY)];
        }
        let edges = (0..bins.max(1)).map(|k| first + width * count(k));
        let total = count(self.0.len());
        edges
            .map(|edge| {
                let is_last = edge + 1.5 * width > *last;
                let end = if is_last { f64::INFINITY } else { edge + width };
                let inside = self.0.iter().filter(|number| (edge..end).contains(number)).count();
                (edge, count(inside) / (total * width))
            })
            .collect()
    }
}

/// A count as a number; those here are far below 2³².
pub(crate) fn count(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}

/// The `k`-th of points spread evenly in the unit cube (Halton's sequence, each coordinate shifted by half of
/// its finest step so that none is 0).
pub(crate) fn radical_point(k: u32) -> [f64; 6] {
    [2, 3, 5, 7, 11, 13].map(|base: u32| {
        let (mut rest, mut scale, mut sum) = (k + 1, 1.0, 0.0);
        while rest > 0 {
            scale /= f64::from(base);
            sum += scale * f64::from(rest % base);
            rest /= base;
        }
        sum
    })
}

/// Quantile of the standard normal distribution, to 1.2e-9 (P. J. Acklam's rational approximation).
pub(crate) fn normal_quantile(probability: f64) -> f64 {
    const A: [f64; 6] = [
        -3.969_683_028_665_376e1,
        2.209_460_984_245_205e2,
        -2.759_285_104_469_687e2,
        1.383_577_518_672_69e2,
        -3.066_479_806_614_716e1,
        2.506_628_277_459_239,
    ];
    const B: [f64; 6] = [
        -5.447_609_879_822_406e1,
        1.615_858_368_580_409e2,
        -1.556_989_798_598_866e2,
        6.680_131_188_771_972e1,
        -1.328_068_155_288_572e1,
        1.0,
    ];
    const C: [f64; 6] = [
        -7.784_894_002_430_293e-3,
        -3.223_964_580_411_365e-1,
        -2.400_758_277_161_838,
        -2.549_732_539_343_734,
        4.374_664_141_464_968,
        2.938_163_982_698_783,
    ];
    const D: [f64; 5] = [
        7.784_695_709_041_462e-3,
        3.224_671_290_700_398e-1,
        2.445_134_137_142_996,
        3.754_408_661_907_416,
        1.0,
    ];
    fn horner(coefficients: &[f64], x: f64) -> f64 {
        coefficients.iter().fold(0.0, |sum, coefficient| sum * x + coefficient)
    }
    const TAIL: f64 = 0.02425;
    let p = probability.clamp(1e-12, 1.0 - 1e-12);
    let tail = |p: f64| {
        let q = (-2.0 * ln(p)).sqrt();
        horner(&C, q) / horner(&D, q)
    };
    if p < TAIL {
        tail(p)
    } else if p > 1.0 - TAIL {
        -tail(1.0 - p)
    } else {
        let q = p - 0.5;
        horner(&A, q * q) * q / horner(&B, q * q)
    }
}

#[cfg(test)]
mod tests {
    use super::{Draws, normal_quantile, radical_point};

    /// Quantiles of any table of the normal distribution.
    #[test]
    fn quantiles_of_the_normal_distribution() {
        for (p, x) in
            [(0.5, 0.0), (0.975, 1.959_964), (0.995, 2.575_829), (0.001, -3.090_232), (0.1, -1.281_552)]
        {
            assert!((normal_quantile(p) - x).abs() < 1e-6, "{p}");
        }
    }

    #[test]
    fn points_are_spread_evenly() {
        for coordinate in 0..6 {
            let draws = Draws::new((0..2048).map(|k| radical_point(k)[coordinate]).collect());
            let [mean, sd] = draws.moments();
            assert!((mean - 0.5).abs() < 2e-3 && (sd - 12_f64.sqrt().recip()).abs() < 2e-3, "{mean} {sd}");
            assert!((draws.quantile(0.25) - 0.25).abs() < 3e-3);
            let density = draws.density(10);
            assert!(density.iter().all(|(_, density)| (density - 1.0).abs() < 0.06), "{density:?}");
        }
    }
}
