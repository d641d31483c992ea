//! A distribution as evenly spread points.

use uncertainty::order_statistic;

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
        order_statistic(&self.0, probability * count(self.0.len()) - 0.5)
    }
}

/// A count as a number; those here are far below 2³².
pub(crate) fn count(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}

/// How many coordinates a point has.
pub(crate) const DIMENSIONS: usize = 8;

/// The `k`-th of points spread evenly in the unit cube (Halton's sequence, each coordinate shifted by half of
/// its finest step so that none is 0).
pub(crate) fn radical_point(k: u32) -> [f64; DIMENSIONS] {
    [2, 3, 5, 7, 11, 13, 17, 19].map(|base: u32| {
        let (mut rest, mut scale, mut sum) = (k + 1, 1.0, 0.0);
        while rest > 0 {
            scale /= f64::from(base);
            sum += scale * f64::from(rest % base);
            rest /= base;
        }
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::{DIMENSIONS, Draws, radical_point};

    #[test]
    fn points_are_spread_evenly() {
        for coordinate in 0..DIMENSIONS {
            let draws = Draws::new((0..2048).map(|k| radical_point(k)[coordinate]).collect());
            let [mean, sd] = draws.moments();
            assert!((mean - 0.5).abs() < 3e-3 && (sd - 12_f64.sqrt().recip()).abs() < 2e-3, "{mean} {sd}");
            assert!((draws.quantile(0.25) - 0.25).abs() < 5e-3);
        }
    }
}
