//! The answer without a piece of evidence, by reweighting the draws with it.
//!
//! # References
//!
//! A. Vehtari, D. Simpson, A. Gelman, Y. Yao and J. Gabry, *Pareto smoothed importance sampling*, JMLR 25
//! (2024). J. Zhang and M. A. Stephens, *A new and efficient estimation method for the generalized Pareto
//! distribution*, Technometrics 51 (2009).

use real::elementary::{exp, ln};

/// (–) maximum k̂ of reliable weights: up to here their variance is finite.
///
/// Vehtari et al. allow 0.7. But if the piece left out was the only one that constrained a value, the draws
/// hardly cover the range that opens up: at a k̂ of 0.63 the mean was found wrong by half a standard
/// deviation.
pub const PARETO_LIMIT: f64 = 0.5;

/// Minimum number of draws in the tail for an estimate of k̂.
const LEAST_TAIL: usize = 5;

/// Weights that turn the draws into those of another posterior.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    /// The weight of each draw; their mean is 1.
    pub weights: Vec<f64>,
    /// (–) k̂, the shape of the generalised Pareto distribution of the greatest weights: from 0.5 on their
    /// variance is infinite. −∞ if all weights are equal, ∞ if there are few, or one is NaN.
    pub pareto: f64,
}

impl Weights {
    /// Whether the weights are reliable: k̂ is at most [`PARETO_LIMIT`].
    #[must_use]
    pub fn are_reliable(&self) -> bool {
        self.pareto <= PARETO_LIMIT
    }

    /// Weights from their logarithms, one for each draw, with the greatest smoothed: the logarithms of the
    /// likelihood of another piece of evidence turn the draws into those of the posterior with it. If one is
    /// NaN or ∞, or all are −∞, the weights are NaN and not reliable.
    #[must_use]
    pub fn smoothed(logarithms: &[f64]) -> Self {
        let greatest = logarithms.iter().fold(f64::NEG_INFINITY, |greatest, l| greatest.max(*l));
        let mut weights: Vec<f64> = logarithms.iter().map(|l| exp(l - greatest)).collect();
        let pareto = smooth(&mut weights);
        let mean = weights.iter().sum::<f64>() / weights.len() as f64;
        for weight in &mut weights {
            *weight /= mean;
        }
        Self { weights, pareto: if mean.is_nan() { f64::INFINITY } else { pareto } }
    }
}

/// Replaces the greatest weights by the expected order statistics of the distribution fitted to them, at most
/// the greatest weight, which is 1; returns its k̂.
fn smooth(weights: &mut [f64]) -> f64 {
    let count = weights.len();
    // The lesser of a fifth of the draws and 3√n.
    let tail = (count / 5).min((9 * count).isqrt());
    if tail < LEAST_TAIL {
        return f64::INFINITY;
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| weights[*a].total_cmp(&weights[*b]).then(a.cmp(b)));
    let (below, tail) = order.split_at(count - tail);
    let cut = below.last().map_or(0.0, |draw| weights[*draw]);
    let beyond: Vec<f64> = tail.iter().map(|&draw| weights[draw] - cut).collect();
    let Some(pareto) = Pareto::of(&beyond) else {
        // All weights of the tail are equal: there is nothing to smooth.
        return f64::NEG_INFINITY;
    };
    for (place, &draw) in tail.iter().enumerate() {
        let share = (place as f64 + 0.5) / tail.len() as f64;
        weights[draw] = (cut + pareto.quantile(share)).min(1.0);
    }
    pareto.shape
}

/// A generalised Pareto distribution that begins at zero.
#[derive(Clone, Copy, Debug)]
struct Pareto {
    /// (–) k.
    shape: f64,
    scale: f64,
}

impl Pareto {
    /// Fitted to values in rising order, by Zhang and Stephens; k is shrunk towards ½ with the weight of ten
    /// values.
    fn of(values: &[f64]) -> Option<Self> {
        let count = values.len();
        let greatest = *values.last()?;
        if greatest <= 0.0 || values.first()? >= &greatest {
            return None;
        }
        let quartile = values[count.div_ceil(4) - 1].max(greatest * 1e-12);
        let candidates = 30 + count.isqrt();
        let shape_of = |b: f64| values.iter().map(|x| ln(1.0 - b * x)).sum::<f64>() / count as f64;
        // b_j = 1/x_n + (1 − √(m/(j − ½)))/(3 x_¼)
        let candidate = |j: usize| {
            let root = (candidates as f64 / (j as f64 + 0.5)).sqrt();
            greatest.recip() + (1.0 - root) / (3.0 * quartile)
        };
        let candidates: Vec<f64> = (0..candidates).map(candidate).collect();
        // l(b) = n (ln(−b/k) − k − 1), k of b
        let profile = |&b: &f64| {
            let shape = shape_of(b);
            count as f64 * (ln(-b / shape) - shape - 1.0)
        };
        let profiles: Vec<f64> = candidates.iter().map(profile).collect();
        let best = profiles.iter().fold(f64::NEG_INFINITY, |best, l| if *l > best { *l } else { best });
        let (mut sum, mut weights) = (0.0, 0.0);
        for (b, profile) in candidates.iter().zip(&profiles) {
            let weight = exp(profile - best);
            if weight.is_finite() {
                sum += weight * b;
                weights += weight;
            }
        }
        let b = sum / weights;
        let shape = shape_of(b);
        let scale = -shape / b;
        let count = count as f64;
        let drawn = (count * shape + 10.0 * 0.5) / (count + 10.0);
        scale.is_finite().then_some(Self { shape: drawn, scale })
    }

    /// σ ((1 − p)⁻ᵏ − 1)/k
    fn quantile(&self, share: f64) -> f64 {
        let logarithm = -ln(1.0 - share);
        if self.shape.abs() < 1e-12 {
            return self.scale * logarithm;
        }
        self.scale * (exp(self.shape * logarithm) - 1.0) / self.shape
    }
}

#[cfg(test)]
mod tests {
    use super::{Pareto, Weights};
    use real::elementary::{exp, ln};

    /// Quantiles at evenly spaced probabilities of distributions of known shape.
    #[test]
    fn shape_and_scale_are_found_again() {
        for shape in [-0.3, 0.2, 0.5, 0.9] {
            let of =
                |place: u32| 2.0 * (exp(-shape * ln(1.0 - (f64::from(place) + 0.5) / 1000.0)) - 1.0) / shape;
            let values: Vec<f64> = (0..1000).map(of).collect();
            let fit = Pareto::of(&values).unwrap();
            // k before it was shrunk towards ½ by ten in a thousand.
            let found = (fit.shape * 1010.0 - 5.0) / 1000.0;
            assert!((found - shape).abs() < 0.02, "{found} is not {shape}");
            assert!((fit.scale - 2.0).abs() < 0.05, "{}", fit.scale);
        }
    }

    #[test]
    fn equal_weights_stay_equal() {
        let weights = Weights::smoothed(&[-3.0; 500]);
        assert!(weights.weights.iter().all(|w| *w == 1.0));
        assert!(weights.are_reliable());
    }

    #[test]
    fn weights_that_are_no_numbers_are_not_reliable() {
        for bad in [f64::NAN, -f64::NAN, f64::INFINITY] {
            let mut logarithms = vec![0.0; 500];
            logarithms[3] = bad;
            assert!(!Weights::smoothed(&logarithms).are_reliable(), "{bad}");
        }
        assert!(!Weights::smoothed(&[f64::NEG_INFINITY; 500]).are_reliable());
    }

    /// Weights exp(z²/4) of normal z have infinite variance and k = ½; exp(0.45 z²) has k = 0.9.
    #[test]
    fn heavy_tails_are_recognised() {
        let normal = |place: u32| {
            let mut lanes = [(f64::from(place) + 0.5) / 20_000.0];
            uncertainty::normal::quantiles(&mut lanes);
            lanes[0]
        };
        let shape = |factor: f64| {
            let logarithms: Vec<f64> =
                (0..20_000).map(|place| factor * normal(place) * normal(place)).collect();
            Weights::smoothed(&logarithms)
        };
        let [light, heavy] = [0.1, 0.45].map(shape);
        assert!(light.pareto < 0.4 && light.are_reliable(), "{}", light.pareto);
        assert!(heavy.pareto > 0.7 && !heavy.are_reliable(), "{}", heavy.pareto);
    }
}
