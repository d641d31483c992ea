//! The errors of fitted figures in the likelihood of the crush energy, compared with integrals over the
//! figures.

use std::f64::consts::PI;

use estimate::Evidence;
use evidence::{
    Behind, Collision, CollisionModel, CrushErrors, CrushNumbers, DamagedSide, EnergyError, FIGURES, FITTED,
    FigureErrors, Fitted, Piece,
};
use pim_core::VehicleId;
use uncertainty::{LANES, Lanes};

use crate::likelihood::rear_end;

/// (J) W_n of [`rear_end`].
const TAKEN: f64 = 66_825.0;

/// Two directions of errors: the covariance of z₁ and z₂, standard normal, is the sum of their squares.
type Errors = [[f64; FIGURES]; 2];

/// Errors of the size that the fit has.
const ERRORS: Errors = [
    [0.10, -0.15, 0.20, 0.25, 0.10, -0.12, 0.20, 0.12, -0.20],
    [-0.12, 0.10, 0.10, -0.10, 0.12, 0.10, -0.15, 0.08, 0.15],
];

fn fitted(errors: &Errors) -> Fitted {
    let entry = |k: usize, l: usize| errors.iter().map(|error| error[k] * error[l]).sum::<f64>();
    let covariance = std::array::from_fn(|k| std::array::from_fn(|l| entry(k, l)));
    Fitted { errors: FigureErrors { covariance, ..FigureErrors::NONE }, ..FITTED }
}

/// (J) energies of the front and of the rear or side with the figures ξ, by the profile: κ and β are 1.2 and
/// 0.9 for vehicle 1, 0.8 and 1.1 for vehicle 2, whose κ are the spread of b₁ times the same number.
fn energies(hit: [DamagedSide; 2], by: &Fitted, xi: [f64; FIGURES]) -> [f64; 2] {
    let mut figures = *by;
    figures.slope[2] *= xi[4].exp();
    figures.slope[1] *= xi[5].exp();
    figures.no_damage_speed[0] *= xi[7].exp();
    figures.no_damage_speed[1] *= xi[7].exp();
    figures.no_damage_speed[2] *= xi[8].exp();
    let of = |i: usize, slope: f64, no_damage: f64| {
        let slope = slope.powf(xi[6].exp());
        profile(hit[i], i, &figures).energy([slope, no_damage])
    };
    [of(0, 1.2, 0.9), of(1, 0.8, 1.1)]
}

fn profile(damage: DamagedSide, vehicle: usize, figures: &Fitted) -> CrushNumbers {
    let (mean, square) = [(0.15, 0.03), (0.05, 0.004)][vehicle];
    figures.crush_of(damage, [1.2, 1.5][vehicle], mean, square)
}

fn collision(hit: [DamagedSide; 2], by: &Fitted, bias: f64) -> Collision {
    let mut collision = rear_end();
    for (i, factors) in [[1.2, 0.9], [0.8, 1.1]].into_iter().enumerate() {
        let crush = profile(hit[i], i, by);
        let [slope, no_damage_speed] = factors.map(Into::into);
        collision.vehicles[i].crush = Some(CrushNumbers { slope, no_damage_speed, ..crush });
    }
    let spread = by.crush_misfit(&hit).ln_sd;
    let error = EnergyError { bias, shared_ln_sd: spread, own_ln_sd: 0.0 };
    collision.observed.crush = Some(CrushErrors([error; 2]));
    collision.observed.figures = by.crush_figures(&hit, hit.map(Behind::Stiffness));
    collision
}

fn term(collision: &Collision) -> f64 {
    let model = CollisionModel::new(collision);
    assert_eq!(model.pieces(), [Piece::Crush]);
    let mut terms = vec![Lanes::ZERO; 1];
    model.log_likelihood(&[], &mut terms, &mut [0; LANES]);
    terms[0][0]
}

/// ln ∫∫ N(ln E(ξ) − ln taken − β(ξ); 0, σ(ξ)²) φ(z₁) φ(z₂) dz₁ dz₂ by a fine sum.
fn integral(hit: [DamagedSide; 2], by: &Fitted, errors: &Errors, bias: f64) -> f64 {
    let spread = if hit.contains(&DamagedSide::Side) { 3 } else { 2 };
    let step = 0.05;
    let mut sum = 0.0;
    for i in -120..=120 {
        for j in -120..=120 {
            let z = [f64::from(i) * step, f64::from(j) * step];
            let xi: [f64; FIGURES] = std::array::from_fn(|k| errors[0][k] * z[0] + errors[1][k] * z[1]);
            let [e1, e2] = energies(hit, by, xi);
            let sd = by.crush_misfit(&hit).ln_sd * xi[spread].exp();
            let error = ((e1 + e2) / TAKEN).ln() - bias - xi[0];
            let density = (-0.5 * (error / sd).powi(2)).exp() / (sd * (2.0 * PI).sqrt());
            sum += density * (-0.5 * (z[0] * z[0] + z[1] * z[1])).exp() / (2.0 * PI) * step * step;
        }
    }
    sum.ln()
}

/// Errors that belong together: to first order the mean over them all.
#[test]
fn the_crush_term_is_the_mean_over_the_figures() {
    let errors = ERRORS;
    let by = fitted(&errors);
    for hit in [
        [DamagedSide::Front, DamagedSide::Rear],
        [DamagedSide::Front, DamagedSide::Side],
        [DamagedSide::Side, DamagedSide::Front],
    ] {
        let [e1, e2] = energies(hit, &by, [0.0; FIGURES]);
        let middle = ((e1 + e2) / TAKEN).ln();
        let [mut off, mut off_alone] = [0.0_f64; 2];
        for error in [-0.6, -0.3, 0.0, 0.3, 0.6] {
            let collision = collision(hit, &by, middle - error);
            let (ours, exact) = (term(&collision), integral(hit, &by, &errors, middle - error));
            assert!((ours - exact).abs() < 0.15, "{hit:?} {error} {ours} {exact}");
            off = off.max((ours - exact).abs());
            let mut alone = collision;
            alone.observed.figures = None;
            off_alone = off_alone.max((term(&alone) - exact).abs());
        }
        // Without the errors it is another density.
        assert!(off_alone > 1.5 * off, "{hit:?} {off} {off_alone}");
    }
}

/// For errors of a hundredth of that, first order is all there is.
#[test]
fn small_errors_of_figures_are_exact() {
    let errors = ERRORS.map(|errors| errors.map(|error| 0.01 * error));
    let by = fitted(&errors);
    for hit in [[DamagedSide::Front, DamagedSide::Rear], [DamagedSide::Side, DamagedSide::Front]] {
        let [e1, e2] = energies(hit, &by, [0.0; FIGURES]);
        for error in [-0.9, 0.0, 0.9] {
            let bias = ((e1 + e2) / TAKEN).ln() - error;
            let (ours, exact) = (term(&collision(hit, &by, bias)), integral(hit, &by, &errors, bias));
            assert!((ours - exact).abs() < 4e-5, "{hit:?} {error} {ours} {exact}");
        }
    }
}

/// Only what was fitted has such errors, and figures of a case have none.
#[test]
fn figures_that_were_not_fitted_have_no_errors() {
    let mut errors = [[0.0; FIGURES]; 2];
    (errors[0][0], errors[1][1]) = (0.15, 0.2);
    let by = fitted(&errors);
    let hit = [DamagedSide::Front; 2];
    let of = |bias, spread| by.crush_figures(&hit, [Behind::Misfit { bias, spread }, Behind::Nothing]);
    assert_eq!(of(false, false), None);
    assert_eq!(by.crush_figures(&hit, [Behind::Nothing; 2]), None);
    let exact = Fitted { errors: FigureErrors::NONE, ..by };
    assert_eq!(exact.crush_figures(&hit, [Behind::Stiffness(DamagedSide::Front); 2]), None);
    let of_bias = of(true, false).unwrap();
    assert!((of_bias.bias_sd(VehicleId::One) - 0.15).abs() < 1e-12);
    assert_eq!(of_bias.bias_sd(VehicleId::Two), 0.0);
    // Half of the energy has the error: its effect is half as large.
    assert!((of_bias.ln_sd(0.5, &Default::default()) - 0.075).abs() < 1e-12);
}

/// The score of the crush error is that of a mixture: half of its mass lies on each side of 0, and a share of
/// 2.5 % beyond the score 1.96.
#[test]
fn the_score_of_the_crush_is_that_of_its_distribution() {
    let mut errors = [[0.0; FIGURES]; 2];
    (errors[0][2], errors[1][0]) = (0.3, 0.1);
    let by = fitted(&errors);
    let hit = [DamagedSide::Front, DamagedSide::Rear];
    let [e1, e2] = energies(hit, &by, [0.0; FIGURES]);
    let middle = ((e1 + e2) / TAKEN).ln();
    let score = |error: f64| {
        let model = CollisionModel::new(&collision(hit, &by, middle - error));
        let mut residuals = vec![Lanes::ZERO; model.parts().len()];
        let mut outputs = vec![Lanes::ZERO; model.outputs_count()];
        model.describe(&[], &mut outputs, &mut residuals);
        residuals[0][0]
    };
    assert!(score(0.0).abs() < 1e-6);
    assert!((score(0.7) + score(-0.7)).abs() < 1e-6);
    // The mass above, by a sum of the density: up to 6, beyond which there is nothing.
    let above = |from: f64| {
        let steps = 4000;
        let width = (6.0 - from) / f64::from(steps);
        (0..steps)
            .map(|k| term(&collision(hit, &by, middle - from - width * (f64::from(k) + 0.5))).exp() * width)
            .sum::<f64>()
    };
    // Φ(1) and Φ(2)
    for (z, share) in [(1.0, 0.158_655), (2.0, 0.022_750)] {
        let (mut low, mut high) = (0.0, 4.0);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if score(middle) < z { low = middle } else { high = middle }
        }
        assert!((above(low) - share).abs() < 2e-4, "{z} {low} {}", above(low));
    }
}
