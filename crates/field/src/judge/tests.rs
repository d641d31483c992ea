#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use evidence::{FITTED, Fitted};
use pim_core::VehicleId;
use real::elementary::{self, exp, ln};

use super::{Figures, Judged, PairKind, Predictive};
use crate::pair::Truth;

/// A single draw has the recorder's own error: Student's t with 3 degrees of freedom, whose quartiles are
/// ±0.764892 and whose 2.5 % lie beyond ±3.182446 (tables).
#[test]
fn one_draw_has_the_recorders_error() {
    let predictive = Predictive::of(&[ln(10.0)], &FITTED);
    for (share, z) in
        [(0.025, -3.182_446), (0.25, -0.764_892), (0.5, 0.0), (0.75, 0.764_892), (0.975, 3.182_446)]
    {
        let exact = 10.0 * exp(FITTED.recorder_ln_scale * z);
        assert!((predictive.quantile(share) - exact).abs() < 1e-3 * exact, "{share}");
        assert!((predictive.below(exact) - share).abs() < 1e-3, "{share}");
    }
}

/// Without the recorder's error, the score of a draw is its distance; a value between two draws has half of
/// them on each side: ∫ (F − 1)² = (b − a)/4.
#[test]
fn the_score_of_points_is_their_distance() {
    let exact = Fitted { recorder_ln_scale: 1e-6, ..FITTED };
    let one = Predictive::of(&[ln(10.0)], &exact);
    assert!((one.crps(14.0) - 4.0).abs() < 0.1 && (one.crps(7.0) - 3.0).abs() < 0.1);
    let two = Predictive::of(&[ln(10.0), ln(14.0)], &exact);
    assert!((two.crps(12.0) - 1.0).abs() < 0.1);
}

fn judged(case: &str, truth: f64, median: f64, winsmash: Option<f64>) -> Judged {
    Judged {
        case: case.to_owned(),
        vehicle: VehicleId::One,
        kind: PairKind::FrontSide,
        is_one_event: None,
        truth: Truth { delta_v: truth, is_longitudinal: false, direction: None },
        median,
        intervals: [[9.0, 11.0], [8.0, 12.0], [5.0, 20.0]],
        below: 0.35,
        crps: 1.0,
        converged: true,
        winsmash,
    }
}

#[test]
fn figures_are_counted_by_collision() {
    let (ours, truth) = (10.0, 10.0 * exp(-0.3));
    let rows = [
        judged("a", truth, ours, Some(truth)),
        judged("a", truth, ours, None),
        judged("b", 10.0, ours, None),
    ];
    let rows: Vec<&Judged> = rows.iter().collect();
    let figures = Figures::of_intervals(&rows).unwrap();
    assert_eq!((figures.n, figures.collisions), (3, 2));
    // Errors 0.3, 0.3, 0: mean 0.2; collision a is 0.2 above it, b 0.2 below it: √(0.08)/3.
    assert!(
        (figures.bias[0] - 0.2).abs() < 1e-12
            && (figures.bias[1] - elementary::sqrt(0.08) / 3.0).abs() < 1e-12
    );
    assert!((figures.rms[0] - elementary::sqrt(0.06)).abs() < 1e-12);
    // 7.41 lies only in the widest interval.
    let inside = figures.coverage.unwrap().map(|[share, _]| share);
    assert_eq!(inside, [1.0 / 3.0, 1.0 / 3.0, 1.0]);
    assert_eq!(figures.width95, Some(1.5));
    assert_eq!(figures.pit.unwrap(), [0, 0, 0, 3, 0, 0, 0, 0, 0, 0]);
    let winsmash = Figures::of_points(&rows[..1]).unwrap();
    assert!(winsmash.bias[0].abs() < 1e-12 && winsmash.crps == 0.0 && winsmash.coverage.is_none());
}
