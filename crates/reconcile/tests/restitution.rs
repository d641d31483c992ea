//! Restitution that depends on the closing speed: the curve, and the resulting speeds.

use std::f64::consts::PI;

use oracle::compare::{assert_close, assert_relative};
use oracle::scenes::{Scene, for_all};
use oracle::{Verdict, approach, verdict};
use pim_core::{ImpactError, Law, RestitutionCurve, Tangential, VehicleId};
use proptest::prelude::*;
use reconcile::{EnergyBasis, Problem, ReconcileError};

use crate::reconciliation::{Case, all_laws, case, head_on, places, posed, with_curve};

fn curve(points: &[(f64, f64)]) -> RestitutionCurve {
    RestitutionCurve::new(points.to_vec()).unwrap()
}

/// Independent interpolation, from the points alone.
fn interpolated(points: &[(f64, f64)], x: f64) -> f64 {
    let first = points[0];
    let last = points[points.len() - 1];
    if x <= first.0 {
        return first.1;
    }
    points.windows(2).find(|pair| x <= pair[1].0).map_or(last.1, |pair| {
        let share = (x - pair[0].0) / (pair[1].0 - pair[0].0);
        pair[0].1 * (1.0 - share) + pair[1].1 * share
    })
}

fn points() -> impl Strategy<Value = Vec<(f64, f64)>> {
    ([0.0..10.0, 1.0..20.0, 1.0..40.0], [0.0..0.95, 0.0..0.95, 0.0..0.95]).prop_map(
        |([a, b, c], mut e): ([f64; 3], [f64; 3])| {
            // Restitution falls with speed.
            e.sort_by(|a, b| b.total_cmp(a));
            vec![(a, e[0]), (a + b, e[1]), (a + b + c, e[2])]
        },
    )
}

fn at(case: &Case, points: &[(f64, f64)], speed: f64) -> Scene {
    let scene = case.at(speed);
    Scene { restitution: interpolated(points, -approach(&scene)[0]), ..scene }
}

#[test]
fn the_speed_under_a_curve_is_that_of_the_restitution_there() {
    for_all(5000, 0.6, (case(all_laws()), points()), |(case, points)| {
        let scene = at(&case, &points, case.speed);
        let Verdict::Impact(effects) = verdict(&scene) else { return false };
        let work = effects.normal_work;
        let step = 1e-4 * case.speed_scale() * effects.approach[0].abs().min(1.0);
        let near =
            [case.speed - step, case.speed + step].map(|speed| match verdict(&at(&case, &points, speed)) {
                Verdict::Impact(effects) => effects.normal_work,
                _ => f64::NAN,
            });
        let steep = (near[1] - near[0]).abs() / work > 1e-6 && (near[0] < work) != (near[1] < work);
        if case.slope().abs() < 0.02 || !steep {
            return false;
        }
        let e = scene.restitution;
        let energy = match case.basis {
            EnergyBasis::Dissipated => work,
            EnergyBasis::Absorbed => work / (1.0 - e * e),
        };
        let through = curve(&points);
        let problem = posed(
            case.scene.contact(),
            case.scene.law(),
            case.scene.motions(),
            case.unknown,
            energy,
            case.basis,
        )
        .unwrap();
        let problem = with_curve(&problem, &through);
        assert!(problem.closed_form().is_none());
        let answer = problem.solve().unwrap_or_else(|error| panic!("{error}"));
        let speeds: Vec<f64> = problem.speeds().collect();
        assert_eq!(answer.admissible, speeds.len());
        let nearest = speeds.iter().map(|speed| (speed - case.speed).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest <= 1e-8 * case.speed_scale(), "{nearest} {speeds:?}");
        // Any answer has the energy, by the raw equations.
        let there = at(&case, &points, answer.speed);
        assert_close("e", answer.law.restitution(), there.restitution, 1e-9);
        let e = there.restitution;
        let sought = match case.basis {
            EnergyBasis::Dissipated => energy,
            EnergyBasis::Absorbed => energy * (1.0 - e * e),
        };
        assert_relative("W_n sought", answer.normal_work, sought, 1e-8);
        assert_relative("W_n", answer.outcome.energy.normal_work, sought, 1e-6);
        true
    });
}

#[test]
fn a_flat_curve_is_a_constant() {
    for_all(3000, 0.5, (case(all_laws()), 0.0..30.0), |(case, speed): (Case, f64)| {
        let Ok(outcome) = case.scene.impact() else { return false };
        let problem = case.problem(outcome.energy.normal_work);
        let flat = curve(&[(speed, case.scene.restitution), (speed + 5.0, case.scene.restitution)]);
        let (Ok(constant), Ok(curved)) = (problem.solve(), with_curve(&problem, &flat).solve()) else {
            return false;
        };
        if constant.admissible != 1 || curved.admissible != 1 || case.slope().abs() < 0.02 {
            return false;
        }
        assert_close("the speed", curved.speed, constant.speed, 1e-6 * case.speed_scale());
        assert_eq!(curved.law, constant.law);
        assert_relative("W_n", curved.normal_work, constant.normal_work, 1e-12);
        true
    });
}

fn central(energy: f64, basis: EnergyBasis) -> Problem {
    let contact = pim_core::Contact::new(places(PI), 0.0).unwrap();
    let law = Law::new(0.3, Tangential::Critical).unwrap();
    posed(contact, law, [pim_core::Motion::rest(); 2], VehicleId::One, energy, basis).unwrap()
}

/// By hand, head-on and central with equal masses: W_n = ½ m̄ (1−e²) v² with m̄ = 750 kg, and ½ m̄ v² is
/// absorbed.
#[test]
fn a_curve_by_hand() {
    // e(10) = 0.3
    let falling = curve(&[(0.0, 0.5), (20.0, 0.1)]);
    for (energy, basis) in
        [(375.0 * 100.0 * (1.0 - 0.09), EnergyBasis::Dissipated), (375.0 * 100.0, EnergyBasis::Absorbed)]
    {
        let answer = with_curve(&central(energy, basis), &falling).solve().unwrap();
        assert_eq!(answer.admissible, 1);
        assert_relative("the speed", answer.speed, 10.0, 1e-12);
        assert_relative("e", answer.law.restitution(), 0.3, 1e-12);
        assert_relative("W_n", answer.normal_work, 34_125.0, 1e-12);
    }
}

/// A curve that is 1 up to 5 m/s and 0.6 at 10 m/s: below 5 m/s nothing is dissipated, whatever is absorbed.
#[test]
fn where_the_restitution_is_one_there_is_no_speed() {
    let elastic = curve(&[(5.0, 1.0), (15.0, 0.2)]);
    for (energy, basis) in [(375.0 * 64.0, EnergyBasis::Dissipated), (37_500.0, EnergyBasis::Absorbed)] {
        let answer = with_curve(&central(energy, basis), &elastic).solve().unwrap();
        assert_eq!(answer.admissible, 1);
        assert_relative("the speed", answer.speed, 10.0, 1e-12);
    }
    // A little above 5 m/s, where e = 1 − 0.08 (v − 5): the elastic part of the curve does not hide the root.
    for above in [1e-4, 1e-3, 2e-3, 3e-3, 5e-3, 0.01, 0.02] {
        let e: f64 = 1.0 - 0.08 * above;
        let absorbed = 375.0 * (5.0 + above) * (5.0 + above);
        for (energy, basis) in
            [(absorbed * (1.0 - e * e), EnergyBasis::Dissipated), (absorbed, EnergyBasis::Absorbed)]
        {
            let answer = with_curve(&central(energy, basis), &elastic).solve().unwrap();
            assert_relative("the speed", answer.speed, 5.0 + above, 1e-8);
        }
    }
    // 4 m/s would absorb it.
    let answer = with_curve(&central(375.0 * 16.0, EnergyBasis::Absorbed), &elastic).solve();
    assert!(matches!(answer, Err(ReconcileError::NotReached { vehicle: VehicleId::One, .. })), "{answer:?}");
    let always = curve(&[(0.0, 1.0)]);
    for basis in [EnergyBasis::Absorbed, EnergyBasis::Dissipated] {
        let answer = with_curve(&central(1e4, basis), &always).solve();
        assert!(matches!(answer, Err(ReconcileError::NoRestitutionLoss { restitution: 1.0 })), "{answer:?}");
    }
}

/// A peak of restitution within two centimetres per second: W_n = 375 (1−e²) v² falls below the energy and
/// rises again.
#[test]
fn a_narrow_peak_of_a_curve_is_not_overlooked() {
    let peak = curve(&[(9.99, 0.0), (10.0, 0.9), (10.01, 0.0)]);
    let energy = 375.0 * 9.5 * 9.5;
    let speeds: Vec<f64> = with_curve(&central(energy, EnergyBasis::Dissipated), &peak).speeds().collect();
    let [first, falling, rising] = speeds[..] else { panic!("{speeds:?}") };
    assert_relative("the speed", first, 9.5, 1e-12);
    assert!(9.99 < falling && falling < 10.0 && 10.0 < rising && rising < 10.01);
    for speed in [falling, rising] {
        let e = 0.9 * (1.0 - (speed - 10.0).abs() / 0.01);
        assert_relative("W_n", 375.0 * (1.0 - e * e) * speed * speed, energy, 1e-9);
    }
}

/// A jam occurs at every speed, with or without a curve; other refusals at one speed do not apply to the
/// rest.
#[test]
fn a_refusal_at_one_speed_is_not_a_jam() {
    let problem = head_on(places(PI), VehicleId::One, 0.3, 1e5).unwrap();
    assert!(problem.solve().is_ok());
    for_all(3000, 0.005, (case((-1.5..1.5).prop_map(Tangential::Ratio)), 0.01..100.0), |(case, factor)| {
        let energy: f64 = 1e3 * factor;
        match case.problem(energy).solve() {
            Err(ReconcileError::Impact(reason)) => {
                assert!(matches!(reason, ImpactError::Jam { .. }), "{reason}");
                true
            }
            _ => false,
        }
    });
}
