//! The error of the direction of a recorder's ΔV, fitted to recorders that stored both parts.

use evidence::Fitted;
use real::elementary::ln;
use real::{Real, principal_angle};

use crate::error::FieldError;
use crate::pair::Pair;

/// The error of the direction of a recorder's ΔV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionFit {
    /// (rad) scale of its error, Student's t with 2 degrees of freedom, and its standard error.
    pub scale: [f64; 2],
    /// Number of recorders.
    pub recorders: usize,
}

/// (rad) limits between which the scale is sought.
const ENDS: [f64; 2] = [0.005, 1.0];
/// Draws of the error of a PDOF: at the middles of equal shares of probability.
const SHARES: usize = 400;
/// Steps of the search; each shortens the interval by a third.
const STEPS: usize = 60;
/// (–) step of the second derivative with respect to the logarithm of the scale.
const STEP: f64 = 0.05;

/// The difference (rad) between the recorder's direction and the coded PDOF, and the factor on the scale of
/// both errors.
struct Apart {
    apart: f64,
    factor: f64,
}

/// z at a share of Student's t with 2 degrees of freedom.
fn quantile(share: f64) -> f64 {
    // z = (2u − 1)/√(2u(1 − u))
    (2.0 * share - 1.0) / Real::sqrt(2.0 * share * (1.0 - share))
}

/// Density of Student's t with 2 degrees of freedom, up to a constant.
fn density(x: f64, scale: f64) -> f64 {
    let z = x / scale;
    let root = Real::sqrt(1.0 + 0.5 * z * z);
    1.0 / (scale * root * root * root)
}

/// Fits the scale of the error of a recorder's direction to its difference from the coded PDOF, whose own
/// error is that of `fitted`: both are Student's t with 2 degrees of freedom, and are wider on sides by the
/// same factor.
///
/// # Errors
/// [`FieldError::NoDirections`] if no recorder stored both parts of its ΔV.
#[expect(clippy::cast_precision_loss, reason = "numbers of shares are far below 2⁵³")]
pub fn fit_direction(pairs: &[Pair], fitted: &Fitted) -> Result<DirectionFit, FieldError> {
    let all: Vec<Apart> = pairs
        .iter()
        .flat_map(|pair| &pair.vehicles)
        .filter_map(|vehicle| {
            let apart = principal_angle(vehicle.truth()?.direction? - vehicle.pdof);
            let factor = if vehicle.plane.is_side() { fitted.pdof_side_factor } else { 1.0 };
            Some(Apart { apart, factor })
        })
        .collect();
    if all.is_empty() {
        return Err(FieldError::NoDirections);
    }
    let errors: Vec<f64> =
        (0..SHARES).map(|k| fitted.pdof_scale * quantile((k as f64 + 0.5) / SHARES as f64)).collect();
    // ln p = Σ ln ∫ f(d − e_p; s) f(e_p; s_p) de_p
    let log_likelihood = |scale: f64| -> f64 {
        let of = |Apart { apart, factor }: &Apart| {
            let at = |error: &f64| density(principal_angle(apart - factor * error), factor * scale);
            ln(errors.iter().map(at).sum::<f64>())
        };
        all.iter().map(of).sum()
    };
    let [mut low, mut high] = ENDS.map(ln);
    let exp = real::elementary::exp;
    for _ in 0..STEPS {
        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if log_likelihood(exp(a)) < log_likelihood(exp(b)) { low = a } else { high = b }
    }
    let middle = 0.5 * (low + high);
    let [before, at, after] = [middle - STEP, middle, middle + STEP].map(|at| log_likelihood(exp(at)));
    // d²f/dξ² = (f₊ + f₋ − 2f)/h²
    let error = Real::sqrt(STEP * STEP / (2.0 * at - before - after));
    Ok(DirectionFit { scale: [exp(middle), exp(middle) * error], recorders: all.len() })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]
    #![allow(clippy::disallowed_methods, reason = "expected values by other functions; no bits are compared")]

    use evidence::{FITTED, Freedom};
    use uncertainty::random::{bits, key, unit};

    use super::{fit_direction, quantile};
    use crate::error::FieldError;
    use crate::pair::{Pair, PairVehicle, Plane};

    /// For recorders with errors drawn, as those of their PDOFs are, the fit recovers the scale.
    #[test]
    fn the_scale_is_found_again() {
        for (truth, planes) in [(4.0_f64, [Plane::Front, Plane::Rear]), (9.0, [Plane::Left, Plane::Front])] {
            let scale = truth.to_radians();
            let vehicle = |number: u64, i: usize| {
                let factor = if planes[i].is_side() { 1.5 } else { 1.0 };
                let error = |k: u64| quantile(unit(bits(key(7, &[number, i as u64]), k)));
                let from = 0.3;
                let shown = from + factor * scale * error(0);
                PairVehicle {
                    number: None,
                    curb_mass: 1500.0,
                    cargo: None,
                    length: None,
                    width: None,
                    plane: planes[i],
                    pdof: from + factor * FITTED.pdof_scale * error(1),
                    heading: None,
                    field_length: None,
                    direct_length: None,
                    direct_offset: None,
                    depths: [0.1; 6],
                    winsmash: [None; 2],
                    // Forward and to the right, away from the origin of the force.
                    recorder: [Some(-9.0 * shown.cos()), Some(-9.0 * shown.sin())],
                    is_record_doubted: false,
                    category: None,
                }
            };
            let pairs: Vec<Pair> = (0..400)
                .map(|number| Pair {
                    case: number.to_string(),
                    vehicles: [vehicle(number, 0), vehicle(number, 1)],
                })
                .collect();
            let found = fit_direction(&pairs, &FITTED).unwrap();
            assert_eq!(found.recorders, 800);
            let [value, error] = found.scale;
            assert!((value - scale).abs() < 3.0 * error, "{found:?} {scale}");
            assert!(error < 0.12 * scale, "{found:?}");
        }
    }

    #[test]
    fn quantiles_are_those_of_student() {
        for share in [0.01, 0.3, 0.5, 0.975] {
            assert!((Freedom::Two.share_below(quantile(share)) - share).abs() < 1e-12);
        }
        assert!(matches!(fit_direction(&[], &FITTED), Err(FieldError::NoDirections)));
    }
}
