//! The errors of fitted figures, in the likelihood of the crush energy.

use pim_core::VehicleId;
use real::Real;
use real::elementary::{exp, ln};
use uncertainty::normal::{cumulative, quantiles};

use crate::density::LN_ROOT_TAU;

/// Number of fitted figures on which ln of the crush energy or its bias depends.
pub const CRUSH_FIGURES: usize = 6;

/// The fitted figures on which the crush energy of a vehicle depends, by their places in
/// [`CrushFigures::covariance`]; `None` for a figure that was not fitted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OfVehicle {
    /// The bias.
    pub bias: Option<usize>,
    /// ln b₁ of its kind of damage.
    pub slope: Option<usize>,
    /// ln of the spread of ln b₁ between vehicles of a kind.
    pub slope_spread: Option<usize>,
    /// ln b₀ of its kind of damage.
    pub no_damage_speed: Option<usize>,
    /// Whether the shared error of its energy has the fitted spread.
    pub has_spread: bool,
}

/// The errors of the figures behind the crush energies: jointly normal, for the figures themselves or, if
/// they are positive, their logarithms.
///
/// They are common to all collisions and so to both vehicles. The likelihood is the mean over them: to
/// first order in the figures, and by Gauss–Hermite quadrature over the spread of the misfit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrushFigures {
    /// The figures behind the energy of each vehicle.
    pub vehicles: [OfVehicle; 2],
    /// (–) s, standard error of ln of the fitted spread.
    pub spread_ln_sd: f64,
    /// (–) expected change of each figure if ln of the spread is larger by s.
    pub drift: [f64; CRUSH_FIGURES],
    /// (–) covariance of the figures for a known spread.
    pub covariance: [[f64; CRUSH_FIGURES]; CRUSH_FIGURES],
}

/// The relative change of the crush energy of a vehicle with the figures behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CrushChange {
    /// (–) ∂ ln E/∂ ln b₁.
    pub slope: f64,
    /// (–) ∂ ln E/∂ ln τ, with τ the spread of ln b₁ between vehicles.
    pub slope_spread: f64,
    /// (–) ∂ ln E/∂ ln b₀.
    pub no_damage_speed: f64,
}

/// Nodes (standard deviations) and weights of the quadrature over ln of the spread: Gauss–Hermite, three
/// points (M. Abramowitz and I. A. Stegun, *Handbook of Mathematical Functions*, table 25.10), exact for
/// polynomials up to the fifth degree.
const NODES: [[f64; 2]; 3] =
    [[-1.732_050_807_568_877_2, 1.0 / 6.0], [0.0, 2.0 / 3.0], [1.732_050_807_568_877_2, 1.0 / 6.0]];

/// A mixture of normal distributions: for each, the error, its standard deviation and the weight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mixture(pub(crate) [[f64; 3]; 3]);

impl CrushFigures {
    /// The error (–) of the crush energies, whose shares are 1 − `share` and `share`, if it is `error` with
    /// the figures as fitted. `spread` gives its standard deviation (–) for a factor on the fitted spread.
    #[inline(always)]
    pub(crate) fn mixture(
        &self,
        error: f64,
        share: f64,
        changes: &[CrushChange; 2],
        spread: impl Fn(f64) -> f64,
    ) -> Mixture {
        let [variance, drift] = self.moments(share, changes);
        Mixture(NODES.map(|[node, weight]| {
            let of_spread = spread(exp(node * self.spread_ln_sd));
            [error + node * drift, Real::sqrt(of_spread * of_spread + variance), weight]
        }))
    }

    /// (–) standard error of the bias of a vehicle: 0 if it was not fitted.
    #[must_use]
    pub fn bias_sd(&self, vehicle: VehicleId) -> f64 {
        let place = self.vehicles[vehicle.index()].bias;
        let variance = place.and_then(|place| {
            let (own, moved) = (self.covariance.get(place)?.get(place)?, self.drift.get(place)?);
            Some(own + moved * moved)
        });
        Real::sqrt(variance.unwrap_or_default())
    }

    /// (–) standard deviation of ln of the crush energy due to the figures, in addition to the misfit, for
    /// the `share` of vehicle 2.
    #[must_use]
    pub fn ln_sd(&self, share: f64, changes: &[CrushChange; 2]) -> f64 {
        let [variance, drift] = self.moments(share, changes);
        Real::sqrt(variance + drift * drift)
    }

    /// (–) variance of ln of the crush energy due to the figures for a known spread, and its change with one
    /// standard error of that.
    #[inline(always)]
    fn moments(&self, share: f64, changes: &[CrushChange; 2]) -> [f64; 2] {
        // u = ∂ [ln(E₁ + E₂) − β]/∂ξ = Σ w_i ∂ (ln E_i − β)/∂ξ
        let mut slopes = [0.0; CRUSH_FIGURES];
        for ((vehicle, change), weight) in self.vehicles.iter().zip(changes).zip([1.0 - share, share]) {
            let OfVehicle { bias, slope, slope_spread, no_damage_speed, has_spread: _ } = *vehicle;
            let parts = [
                (bias, -1.0),
                (slope, change.slope),
                (slope_spread, change.slope_spread),
                (no_damage_speed, change.no_damage_speed),
            ];
            for (place, part) in parts {
                if let Some(sum) = place.and_then(|place| slopes.get_mut(place)) {
                    *sum += weight * part;
                }
            }
        }
        let (mut variance, mut drift) = (0.0, 0.0);
        for ((row, slope), moved) in self.covariance.iter().zip(&slopes).zip(&self.drift) {
            let product: f64 = row.iter().zip(&slopes).map(|(entry, other)| entry * other).sum();
            // v = uᵀ C u, and u·d
            variance += slope * product;
            drift += slope * moved;
        }
        [variance, drift]
    }
}

impl Mixture {
    /// (–) log density.
    #[inline(always)]
    pub(crate) fn log_density(&self) -> f64 {
        let half_square = |[error, sd, _]: [f64; 3]| 0.5 * (error / sd) * (error / sd);
        let least = self.0.map(half_square).into_iter().fold(f64::INFINITY, Real::min);
        // ln Σ w φ(ε/σ)/σ
        let terms = self.0.map(|node| node[2] / node[1] * exp(least - half_square(node)));
        ln(terms.iter().sum()) - least - LN_ROOT_TAU
    }

    /// (–) the probability that such an error lies below this one: Σ w Φ(ε/σ).
    #[inline(always)]
    pub(crate) fn below(&self) -> f64 {
        self.tail(1.0)
    }

    /// The same for the errors times a `sign`.
    #[inline(always)]
    fn tail(&self, sign: f64) -> f64 {
        self.0.iter().map(|[error, sd, weight]| weight * cumulative(sign * error / sd)).sum()
    }

    /// Its normal score: z with Φ(z) = Σ w Φ(ε/σ).
    pub(crate) fn score(&self) -> f64 {
        let is_above = self.0[1][0] > 0.0;
        // The smaller tail keeps its digits.
        let sign = if is_above { -1.0 } else { 1.0 };
        let mut share = [Real::max(self.tail(sign), f64::MIN_POSITIVE)];
        quantiles(&mut share);
        sign * share[0]
    }
}
