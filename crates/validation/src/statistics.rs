//! Root mean square, mean and 95 % limits of errors.

/// How large errors are, in the unit of the errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorRate {
    /// How many.
    pub count: usize,
    /// Root mean square.
    pub rms: f64,
    /// Mean: the bias.
    pub mean: f64,
    /// The least and the greatest.
    pub range: [f64; 2],
    /// Limits within which one more error of the same kind lies with a probability of 95 %, if errors are independent and normally
    /// distributed: mean ± t s √(1 + 1/n).
    pub limits: [f64; 2],
}

/// Student's t for 95 % two-sided by degrees of freedom from 1 on: NIST/SEMATECH e-Handbook of Statistical Methods, section 1.3.6.7.2.
const STUDENT: [f64; 30] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
    2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
];

impl ErrorRate {
    /// Of at least two and at most 31 errors; else there are no limits and they are not a number.
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
