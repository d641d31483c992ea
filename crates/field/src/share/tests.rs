#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]
#![allow(
    clippy::disallowed_methods,
    reason = "expected values by other functions than the crate's; no bits are compared"
)]

use evidence::{DamagedSide, FITTED, Fitted};
use inputs::TypicalStiffness;

use super::{fit_share, moments};
use crate::error::FieldError;
use crate::pair::{Pair, PairVehicle, Plane};

/// Without no-damage speed, the energy of an end grows with the square of its depth.
fn pair(planes: [Plane; 2], depths: [f64; 2]) -> Pair {
    let vehicle = |i: usize| PairVehicle {
        number: None,
        curb_mass: 1500.0,
        cargo: None,
        length: None,
        width: None,
        plane: planes[i],
        pdof: 0.0,
        heading: Some(0.0),
        field_length: Some(1.5),
        direct_length: None,
        direct_offset: None,
        depths: [depths[i]; 6],
        winsmash: [None; 2],
        recorder: [None; 2],
        is_record_doubted: false,
        category: None,
    };
    Pair { case: "1".to_owned(), vehicles: [vehicle(0), vehicle(1)] }
}

/// A fleet of equal stiffness at all sides.
fn fleet(slope_ln_sd: f64, no_damage_speed_ln_sd: f64) -> Fitted {
    Fitted { slope: [25.0; 3], no_damage_speed: [0.0; 3], slope_ln_sd, no_damage_speed_ln_sd, ..FITTED }
}

/// With known stiffnesses, c and τ are the mean and the spread of the logarithms themselves.
#[test]
fn with_known_stiffnesses_the_figures_are_mean_and_spread() {
    let (front, left, rear) = (Plane::Front, Plane::Left, Plane::Rear);
    // ln(E₂/E₁) = 2 ln(C₂/C₁)
    let cases = [
        ([front, left], 0.5_f64, 1.0),
        ([left, front], 1.6, -1.0),
        ([front, left], 0.9, 1.0),
        ([front, front], 0.7, 0.0),
        ([rear, front], 1.9, 0.0),
    ];
    let pairs: Vec<Pair> = cases.iter().map(|(planes, c, _)| pair(*planes, [0.2, 0.2 * c])).collect();
    let ratios: Vec<(f64, f64)> = cases.iter().map(|(_, c, side)| (2.0 * c.ln(), *side)).collect();
    let sides: Vec<f64> = ratios.iter().filter(|(_, s)| *s != 0.0).map(|(x, s)| x * s).collect();
    let c = sides.iter().sum::<f64>() / 3.0;
    let tau = (ratios.iter().map(|(x, s)| (x - c * s).powi(2)).sum::<f64>() / 5.0).sqrt();
    let found = fit_share(&pairs, &fleet(1e-9, 1e-9)).unwrap();
    assert_eq!(found.pairs, 5);
    assert!((found.side_crush[0].ln() - c).abs() < 1e-6, "{found:?} {c}");
    assert!((found.ln_sd[0] - tau).abs() < 1e-6, "{found:?} {tau}");
    assert!((found.side_crush[1] - tau / 3.0_f64.sqrt()).abs() < 1e-6, "{found:?}");
    // Of n values: τ/√2n
    assert!((found.ln_sd[1] - tau / 10.0_f64.sqrt()).abs() < 1e-6, "{found:?}");
}

/// Without b₀, ln E = 2 ln κ + …: two vehicles with a spread of 0.2 each have a variance of 0.32 together,
/// which is not that of the shares.
#[test]
fn the_spread_of_the_stiffnesses_is_not_that_of_the_shares() {
    let fleet = fleet(0.2, 0.3);
    let crush = fleet.crush_of(DamagedSide::Front, 1.5, 0.2, 0.05);
    let [_, variance] = moments(&crush, &fleet).unwrap();
    assert!((variance - 0.16).abs() < 1e-9, "{variance}");
    let pairs = [0.4, 0.8, 1.1, 2.4].map(|c| pair([Plane::Front, Plane::Front], [0.2, 0.2 * c]));
    let mean_square = [0.4_f64, 0.8, 1.1, 2.4].iter().map(|c| (2.0 * c.ln()).powi(2)).sum::<f64>() / 4.0;
    let found = fit_share(&pairs, &fleet).unwrap();
    assert!((found.ln_sd[0] - (mean_square - 0.32).sqrt()).abs() < 1e-6, "{found:?}");
    assert_eq!(found.side_crush, [1.0, f64::INFINITY]);
}

#[test]
fn no_pair_has_no_shares() {
    assert!(matches!(fit_share(&[], &FITTED), Err(FieldError::NoShares)));
}

/// The spreads of b₁ and b₀ between the cars of a category are those that a case by category has
/// (docs/theory.md, section 9): κ = f^(0.59/0.38/2), β = f/κ.
#[test]
fn a_category_has_the_spread_of_a_case() {
    let fitted = FITTED.by_category(&[DamagedSide::Front]);
    let [of_a, of_b] = TypicalStiffness::Category(1).ln_sds();
    let slope = 0.5 * of_b;
    assert!((fitted.slope_ln_sd - slope).abs() < 1e-12);
    assert!((fitted.no_damage_speed_ln_sd - (of_a - slope)).abs() < 1e-12);
}

/// One factor on A gives the energy of a car of the fleet the spread that its two figures give it.
#[test]
fn one_factor_stands_for_both_spreads_of_the_fleet() {
    let [of_a, of_b] = TypicalStiffness::Fleet.ln_sds();
    for side in [0, 1, 2] {
        for depth in [0.1, 0.2, 0.3, 0.4, 0.5] {
            let (b0, b1) = (FITTED.no_damage_speed[side], FITTED.slope[side]);
            // E ~ (b₀ + b₁ C)², of which each spread moves its term
            let share = b0 / (b0 + b1 * depth);
            let both = 2.0 * (share * FITTED.no_damage_speed_ln_sd).hypot((1.0 - share) * FITTED.slope_ln_sd);
            // A ~ b₀ b₁, B ~ b₁²
            let one = 2.0 * (share * (of_a - 0.5 * of_b) + (1.0 - share) * 0.5 * of_b);
            assert!((one / both - 1.0).abs() < 0.07, "{side} {depth}: {one} {both}");
        }
    }
}
