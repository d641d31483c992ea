//! The share λ of the tangential work that the crush takes: W_n + λ W_t in place of W_n.

use oracle::compare::{assert_close, assert_relative};
use oracle::scenes::{Scene, for_all};
use oracle::{Effects, Verdict, approach, scanned, verdict};
use pim_core::{RestitutionCurve, Tangential};
use proptest::prelude::*;
use reconcile::{EnergyBasis, Problem, ReconcileError, SolutionMethod};

use crate::reconciliation::{Case, all_laws, case, with_curve};

/// The oracle's work to compare with the crush energy.
fn taken(effects: &Effects, share: f64) -> f64 {
    effects.normal_work + share * effects.tangential_work
}

fn problem(case: &Case, share: f64, energy: f64) -> Problem {
    let dissipated = Case { basis: EnergyBasis::Dissipated, ..*case };
    Problem { tangential_share: share, ..dissipated.problem(energy) }
}

fn share() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(1.0), 6 => 0.0..1.0]
}

/// Whether the search finds the same speeds as the oracle, under the restitution of a curve if there is one.
fn undoes(case: &Case, share: f64, curve: Option<&RestitutionCurve>) -> bool {
    let at = |speed: f64| {
        let scene = case.at(speed);
        let restitution = curve.map_or(scene.restitution, |curve| curve.at(-approach(&scene)[0]));
        Scene { restitution, ..scene }
    };
    let work = |speed: f64| match verdict(&at(speed)) {
        Verdict::Impact(effects) => Some(taken(&effects, share)),
        _ => None,
    };
    let Some(energy) = work(case.speed).filter(|energy| *energy > 10.0) else { return false };
    if case.slope().abs() < 0.02 {
        return false;
    }
    let plain = problem(case, share, energy);
    let problem = curve.map_or(plain.clone(), |curve| with_curve(&plain, curve));
    let found: Vec<f64> = problem.speeds().collect();
    // Near an extremum or a jump a speed is less accurate.
    let step = 1e-3;
    let steep = |speed: f64| match (work(speed - step), work(speed), work(speed + step)) {
        (Some(a), Some(b), Some(c)) => {
            let (left, right) = ((b - a) / energy, (c - b) / energy);
            left.abs() > 1e-7 && (left / right - 1.0).abs() < 0.1
        }
        _ => false,
    };
    for &speed in &found {
        if steep(speed) {
            assert_relative("W_n + λ W_t", work(speed).unwrap(), energy, 1e-6);
        }
        assert!(problem.residual(speed).abs() <= 1e-6 * energy);
    }
    let scale = 1.0 + case.speed_scale();
    for wanted in scanned(&work, energy, 120).into_iter().chain([case.speed]) {
        let off = found.iter().map(|speed| (speed - wanted).abs()).fold(f64::INFINITY, f64::min);
        assert!(off <= 1e-6 * scale || !steep(wanted), "{off} {wanted} {found:?}");
    }
    let Some(closed) = problem.closed_form() else { return true };
    let (closed, searched) = (closed.unwrap(), problem.root_finder().unwrap());
    assert_eq!(closed.admissible, found.len());
    assert!(matches!(closed.method, SolutionMethod::ClosedForm));
    if steep(closed.speed) {
        assert_close("speed", searched.speed, closed.speed, 1e-7 * scale);
    }
    true
}

#[test]
fn all_speeds_are_found_with_a_share_of_the_tangential_work() {
    for_all(600, 0.5, (case(all_laws()), share()), |(case, share)| undoes(&case, share, None));
}

#[test]
fn all_speeds_are_found_under_a_curve() {
    let fraction = (0.0..1.0).prop_map(Tangential::FractionOfCritical);
    let laws = prop_oneof![2 => all_laws(), 1 => fraction];
    for_all(300, 0.4, (case(laws), share(), 0.0..0.4, 0.3..0.9), |(case, share, fast, slow)| {
        let curve = RestitutionCurve::new(vec![(1.0, slow), (15.0, fast), (40.0, 0.5 * fast)]).unwrap();
        undoes(&case, share, Some(&curve))
    });
}

/// Neades' factor in the frame of the crush plane, 1 + tan α tan β (1−e_t)/(1−e_n), is W/W_n. α is the
/// angle of the impulse to the normal, β that of the closing velocity.
#[test]
fn neades_factor_is_the_whole_work_over_the_normal_work() {
    let factor = |tan_alpha: f64, tan_beta: f64, e_n: f64, e_t: f64| {
        1.0 + tan_alpha * tan_beta * (1.0 - e_t) / (1.0 - e_n)
    };
    // His RICSAC 8: α 19.0°, β 45.1°, e_n 0.3605, e_t 0.1237 give 1.474.
    let [alpha, beta] = [19.0_f64, 45.1].map(|degrees| degrees.to_radians().tan());
    assert!((factor(alpha, beta, 0.3605, 0.1237) - 1.474).abs() < 0.001);
    let laws = (-0.9..0.9).prop_map(Tangential::Restitution);
    for_all(1_000, 0.3, case(laws), |case| {
        let Verdict::Impact(effects) = verdict(&case.scene) else { return false };
        let Tangential::Restitution(e_t) = case.scene.tangential else { return false };
        let ([u_n, u_t], [p_n, p_t]) = (effects.approach, effects.impulse);
        // The impulse pushes against the approach.
        let factor = factor(p_t / p_n, u_t / u_n, case.scene.restitution, e_t);
        let energy = effects.normal_work * factor;
        let size = effects.normal_work + effects.tangential_work.abs();
        assert_close("W", effects.normal_work + effects.tangential_work, energy, 1e-9 * size);
        let problem = problem(&case, 1.0, energy.max(1.0));
        if energy > 1.0 {
            assert_close("R", problem.residual(case.speed), 0.0, 1e-7 * size);
        }
        true
    });
}

#[test]
fn a_share_is_between_zero_and_one_and_of_the_dissipated_energy() {
    for_all(50, 0.5, case(all_laws()), |case| {
        if case.slope().abs() < 0.02 {
            return false;
        }
        let problem = problem(&case, 0.5, 1e5);
        assert_eq!(problem.check(), Ok(()));
        for share in [-0.01, 1.01, f64::NAN, f64::INFINITY] {
            let refused = Problem { tangential_share: share, ..problem.clone() }.check();
            assert!(matches!(refused, Err(ReconcileError::TangentialShare { .. })), "{refused:?}");
        }
        let absorbed = Problem { basis: EnergyBasis::Absorbed, ..problem };
        assert!(matches!(absorbed.check(), Err(ReconcileError::TangentialShare { share: 0.5, .. })));
        assert_eq!(Problem { tangential_share: 0.0, ..absorbed }.check(), Ok(()));
        true
    });
}
