//! The first-order propagation of the Guide to the expression of uncertainty in measurement.
//!
//! # References
//!
//! JCGM 100:2008, *Evaluation of measurement data – Guide to the expression of uncertainty in measurement*,
//! Eq 10 (independent inputs).

use crate::error::InvalidRequest;

/// Relative difference allowed between the first-order and the sampled standard deviation: 10 %.
pub const FIRST_ORDER_LIMIT: f64 = 0.1;

/// Combined uncertainty of an output from its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstOrder {
    /// (unit of the output) combined standard deviation: NaN or infinite if a number is, or if the squares
    /// are.
    pub sd: f64,
    /// Fraction of the variance due to each input. Their sum is 1, or 0 if nothing varies, if the variance is
    /// finite.
    pub shares: Vec<f64>,
}

impl FirstOrder {
    /// From the derivative of the output with respect to each input, and the input's standard deviation.
    ///
    /// # Errors
    /// If the lists differ in length.
    pub fn new(derivatives: &[f64], sds: &[f64]) -> Result<Self, InvalidRequest> {
        if derivatives.len() != sds.len() {
            let (expected, given) = (derivatives.len(), sds.len());
            return Err(InvalidRequest::Length { what: "standard deviation", expected, given });
        }
        // u² = Σ (∂f/∂xᵢ·uᵢ)²
        let squares: Vec<f64> = derivatives.iter().zip(sds).map(|(c, u)| (c * u) * (c * u)).collect();
        let variance: f64 = squares.iter().sum();
        let share = |square: &f64| if variance == 0.0 { 0.0 } else { square / variance };
        Ok(Self { sd: variance.sqrt(), shares: squares.iter().map(share).collect() })
    }

    /// Whether a sampled standard deviation differs by more than [`FIRST_ORDER_LIMIT`], so that the output is
    /// not linear over the range of its inputs. NaN differs from everything.
    #[must_use]
    pub fn differs(&self, sampled_sd: f64) -> bool {
        let agrees = (self.sd - sampled_sd).abs() <= FIRST_ORDER_LIMIT * sampled_sd;
        !agrees
    }
}

#[cfg(test)]
mod tests {
    use super::FirstOrder;
    use crate::InvalidRequest;

    /// A 3-4-5 triangle: (3·1)² + (−2·2)² = 5².
    #[test]
    fn squares_add_up() {
        let combined = FirstOrder::new(&[3.0, -2.0], &[1.0, 2.0]).unwrap();
        assert_eq!(combined, FirstOrder { sd: 5.0, shares: vec![9.0 / 25.0, 16.0 / 25.0] });
        let constant = FirstOrder::new(&[0.0], &[1.0]).unwrap();
        assert_eq!(constant, FirstOrder { sd: 0.0, shares: vec![0.0] });
    }

    #[test]
    fn a_tenth_is_the_limit() {
        let combined = FirstOrder::new(&[90.0], &[1.0]).unwrap();
        assert!(!combined.differs(100.0) && combined.differs(100.1));
        assert!(!combined.differs(82.0) && combined.differs(81.8));
        assert!(combined.differs(f64::NAN));
    }

    #[test]
    fn lists_of_different_length_are_refused() {
        let refused = FirstOrder::new(&[1.0, 2.0], &[1.0]);
        let expected = InvalidRequest::Length { what: "standard deviation", expected: 2, given: 1 };
        assert_eq!(refused, Err(expected));
    }
}
