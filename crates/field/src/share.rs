//! How two vehicles share the crush energy, fitted to pairs with two known crush profiles.

use evidence::{CrushNumbers, DamagedSide, Fitted};
use real::Real;
use real::elementary::{exp, ln};

use crate::collision::Layout;
use crate::error::FieldError;
use crate::pair::Pair;

/// How two vehicles share the crush energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShareFit {
    /// (–) median ratio of the crush energy of a side to that of the front or rear that it met, and the
    /// standard error of its logarithm.
    pub side_crush: [f64; 2],
    /// (–) spread of the logarithm of the ratio of the two crush energies, without that of the stiffnesses,
    /// and its standard error.
    pub ln_sd: [f64; 2],
    /// Number of pairs.
    pub pairs: usize,
}

/// The shares of one pair.
struct Shares {
    /// 1 if only the second damage is that of a side, −1 if only the first is, otherwise 0.
    sides: f64,
    /// (–) ln(E₂/E₁), its mean over the stiffnesses.
    mean: f64,
    /// (–) its variance due to the stiffnesses.
    variance: f64,
}

/// Nodes and weights of Gauss–Hermite quadrature for a standard normal number, M. Abramowitz and I. A.
/// Stegun, *Handbook of Mathematical Functions*, table 25.10, n = 5: x √2 and w/√π.
const NODES: [[f64; 2]; 5] = [
    [-2.856_970_013_872_805_6, 0.011_257_411_327_720_69],
    [-1.355_626_179_974_266, 0.222_075_922_005_612_65],
    [0.0, 0.533_333_333_333_333_3],
    [1.355_626_179_974_266, 0.222_075_922_005_612_65],
    [2.856_970_013_872_805_6, 0.011_257_411_327_720_69],
];

/// (–) the iteration ends when the variance changes by less than this share.
const LEAST_CHANGE: f64 = 1e-12;
/// Maximum number of its steps: it gains a digit in one or two.
const MOST_STEPS: usize = 1000;

/// Mean and variance of ln E over κ and β of the fleet.
fn moments(crush: &CrushNumbers, fitted: &Fitted) -> Option<[f64; 2]> {
    let mut sums = [0.0; 2];
    for [z, weight] in NODES {
        for [y, other] in NODES {
            let factors = [exp(fitted.slope_ln_sd * z), exp(fitted.no_damage_speed_ln_sd * y)];
            let energy = crush.energy(factors);
            if energy <= 0.0 {
                return None;
            }
            let ln_e = ln(energy);
            sums = [sums[0] + weight * other * ln_e, sums[1] + weight * other * ln_e * ln_e];
        }
    }
    let [mean, square] = sums;
    Some([mean, Real::max(square - mean * mean, 0.0)])
}

fn shares(pair: &Pair, fitted: &Fitted) -> Option<Shares> {
    let layout = Layout::of(pair, fitted);
    let [one, two] = [0, 1]
        .map(|i| moments(&pair.vehicles[i].crush(fitted, layout.widths[i], layout.shapes[i].depths), fitted));
    let ([m1, v1], [m2, v2]) = (one?, two?);
    // By the fleet's stiffness, rears do not differ from fronts.
    let differs = |i: usize| match layout.damages[i] {
        DamagedSide::Front => false,
        DamagedSide::Side => true,
        DamagedSide::Rear => pair.vehicles[i].category.is_some(),
    };
    let [s1, s2] = [0, 1].map(|i| f64::from(u8::from(differs(i))));
    Some(Shares { sides: s2 - s1, mean: m2 - m1, variance: v1 + v2 })
}

/// Fits how two vehicles share the crush energy, with the stiffnesses of `fitted`.
///
/// ln(E_2/E_1) = c (s_2 − s_1) + τ z + (stiffnesses), with s = 1 for a side and 0 for an end
/// (with stiffnesses by category, 0 for a front alone); c and τ
/// maximise the likelihood, with the stiffnesses taken as normal with the variance that they give ln E (R. J.
/// Hardy and S. G. Thompson, Statistics in Medicine 15 (1996) 619, for a random effect besides errors of
/// known size).
///
/// # Errors
/// [`FieldError::NoShares`] if no pair has the crush energies of both vehicles.
pub fn fit_share(pairs: &[Pair], fitted: &Fitted) -> Result<ShareFit, FieldError> {
    let all: Vec<Shares> = pairs.iter().filter_map(|pair| shares(pair, fitted)).collect();
    let sum = |of: &dyn Fn(&Shares) -> f64| all.iter().map(of).sum::<f64>();
    let weight = |shares: &Shares, square: f64| (shares.variance + square).recip();
    // c = Σ w s x/Σ w s², w = 1/(v + τ²)
    let side = |square: f64| {
        let of_sides = sum(&|shares| weight(shares, square) * shares.sides * shares.sides);
        let c = sum(&|shares| weight(shares, square) * shares.sides * shares.mean) / of_sides;
        if of_sides > 0.0 { [c, of_sides.recip()] } else { [0.0, f64::INFINITY] }
    };
    if all.is_empty() {
        return Err(FieldError::NoShares);
    }
    let mut square: f64 = 1.0;
    for _ in 0..MOST_STEPS {
        let [c, _] = side(square);
        // τ² = Σ w² [(x − c s)² − v]/Σ w²
        let squares = sum(&|shares| {
            let (w, error) = (weight(shares, square), shares.mean - c * shares.sides);
            w * w * (error * error - shares.variance)
        });
        let next = Real::max(squares / sum(&|shares| weight(shares, square) * weight(shares, square)), 0.0);
        let change = (next - square).abs();
        square = next;
        if change <= LEAST_CHANGE * square {
            break;
        }
    }
    let [c, variance] = side(square);
    let ln_sd = Real::sqrt(square);
    // var τ² = 2/Σ w²
    let information = sum(&|shares| weight(shares, square) * weight(shares, square));
    let error = Real::sqrt(2.0 / information) / (2.0 * ln_sd);
    Ok(ShareFit { side_crush: [exp(c), Real::sqrt(variance)], ln_sd: [ln_sd, error], pairs: all.len() })
}

#[cfg(test)]
mod tests;
