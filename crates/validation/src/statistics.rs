//! Root mean square, mean and 95 % limits of errors.

use serde::Serialize;

/// The size of errors, in the unit of the errors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorRate {
    /// Number of errors.
    pub count: usize,
    /// Root mean square.
    pub rms: f64,
    /// Mean: the bias.
    pub mean: f64,
    /// The smallest and the largest.
    pub range: [f64; 2],
    /// Limits within which one more error of the same kind lies with a probability of 95 %, if errors are
    /// independent and normally distributed: mean ± t s √(1 + 1/n).
    pub limits: [f64; 2],
}

/// Student's t for 95 % two-sided, by degrees of freedom from 1, to eight decimals: the t with a probability
/// A(t|ν) of 0.95 by Abramowitz & Stegun, *Handbook of Mathematical Functions*, 26.7.3 and 26.7.4. Three
/// decimals, as in most tables, such as that of the NIST/SEMATECH e-Handbook of Statistical Methods, section
/// 1.3.6.7.2, would show in the limits.
const STUDENT: [f64; 30] = [
    12.706_204_74,
    4.302_652_73,
    3.182_446_31,
    2.776_445_11,
    2.570_581_84,
    2.446_911_85,
    2.364_624_25,
    2.306_004_14,
    2.262_157_16,
    2.228_138_85,
    2.200_985_16,
    2.178_812_83,
    2.160_368_66,
    2.144_786_69,
    2.131_449_55,
    2.119_905_30,
    2.109_815_58,
    2.100_922_04,
    2.093_024_05,
    2.085_963_45,
    2.079_613_84,
    2.073_873_07,
    2.068_657_61,
    2.063_898_56,
    2.059_538_55,
    2.055_529_44,
    2.051_830_52,
    2.048_407_14,
    2.045_229_64,
    2.042_272_46,
];

impl ErrorRate {
    /// The error rate of at least two and at most 31 errors; the limits of fewer or more are not a number.
    #[must_use]
    pub fn of(errors: &[f64]) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "a few dozen errors")]
        let n = errors.len() as f64;
        let mean = errors.iter().sum::<f64>() / n;
        // s² = Σ (x − x̄)² / (n − 1)
        let variance = errors.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
        let student = errors.len().checked_sub(2).and_then(|i| STUDENT.get(i)).copied().unwrap_or(f64::NAN);
        // t s √(1 + 1/n)
        let reach = student * (variance * (1.0 + 1.0 / n)).sqrt();
        Self {
            count: errors.len(),
            rms: rms(errors),
            mean,
            range: [
                errors.iter().copied().fold(f64::INFINITY, f64::min),
                errors.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            ],
            limits: [mean - reach, mean + reach],
        }
    }
}

/// Root mean square: SAE 980025, the note to Table 1.
pub(crate) fn rms(errors: &[f64]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few dozen errors")]
    let n = errors.len() as f64;
    // √( Σ x² / n )
    (errors.iter().map(|x| x * x).sum::<f64>() / n).sqrt()
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "an independent formula, no bits of which are compared")]
mod tests {
    use super::{ErrorRate, STUDENT};

    /// Γ(n/2).
    fn gamma_of_half(n: u32) -> f64 {
        match n {
            1 => std::f64::consts::PI.sqrt(),
            2 => 1.0,
            // Γ(x + 1) = x Γ(x)
            n => (f64::from(n) / 2.0 - 1.0) * gamma_of_half(n - 2),
        }
    }

    /// The integral of Student's density over 95 % of the errors, by Simpson's rule.
    #[test]
    fn student_s_t_has_its_probability() {
        for (degrees, t) in (1..).zip(STUDENT) {
            let nu = f64::from(degrees);
            let factor =
                gamma_of_half(degrees + 1) / ((nu * std::f64::consts::PI).sqrt() * gamma_of_half(degrees));
            // f(x) = Γ((ν+1)/2) / (√(νπ) Γ(ν/2)) (1 + x²/ν)^(−(ν+1)/2)
            let density = |x: f64| factor * (1.0 + x * x / nu).powf(-(nu + 1.0) / 2.0);
            let steps = 20_000;
            let h = t / f64::from(steps);
            let sum: f64 = (0..steps)
                .map(|i| {
                    let x = f64::from(i) * h;
                    density(x) + 4.0 * density(x + 0.5 * h) + density(x + h)
                })
                .sum();
            let probability = 2.0 * sum * h / 6.0;
            // Half of the last decimal, by the density there.
            assert!((probability - 0.95).abs() < 2.0 * 0.51e-8 * density(t), "{degrees}: {probability}");
        }
    }

    /// −1, 0 and 1: s = 1, and t = 4.302 652 73 of two degrees of freedom, which is √(2·0.95²/(1 − 0.95²)).
    #[test]
    fn the_limits_are_those_of_n_less_one_degrees() {
        let [low, high] = ErrorRate::of(&[-1.0, 0.0, 1.0]).limits;
        let t = (2.0 * 0.95_f64.powi(2) / (1.0 - 0.95_f64.powi(2))).sqrt();
        let reach = t * (1.0_f64 + 1.0 / 3.0).sqrt();
        assert!((high - reach).abs() < 1e-8 && (low + reach).abs() < 1e-8, "{low} {high} {reach}");
    }
}
