//! Energies near an extremum of W_n: two speeds close together, or none.

use oracle::compare::assert_relative;
use oracle::scenes::for_all;
use oracle::{Condition, approach, solve};
use pim_core::{Contact, Law, Motion, RestitutionCurve, Tangential, VehicleId};
use proptest::prelude::*;
use reconcile::{EnergyBasis, ReconcileError};

use crate::reconciliation::{Case, all_laws, case, places, posed, with_curve};

/// By hand, head-on and central with equal masses and e = e₀ + (1 − e₀) v/v₁: W_n = 375 v² (1 − e²) is
/// greatest where 2 e² − e₀ e − 1 = 0.
#[test]
fn two_speeds_about_the_greatest_work_under_a_curve() {
    let contact = Contact::new(places(std::f64::consts::PI), 0.0).unwrap();
    let law = Law::new(0.3, Tangential::Critical).unwrap();
    let problem = |energy: f64, basis: EnergyBasis| {
        posed(contact, law, [Motion::rest(); 2], VehicleId::One, energy, basis).unwrap()
    };
    for step in 0..40 {
        let e0 = 0.02 * f64::from(step);
        let v1 = 20.0;
        let curve = RestitutionCurve::new(vec![(0.0, e0), (v1, 1.0)]).unwrap();
        let e = (e0 + (e0 * e0 + 8.0).sqrt()) / 4.0;
        let v = (e - e0) / (1.0 - e0) * v1;
        let greatest = 375.0 * v * v * (1.0 - e * e);
        for below in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
            let energy = greatest * (1.0 - below);
            let problem = with_curve(&problem(energy, EnergyBasis::Dissipated), &curve);
            let speeds: Vec<f64> = problem.speeds().collect();
            let [slow, fast] = speeds[..] else { panic!("{e0} {below} {speeds:?}") };
            assert!(slow < v && v < fast, "{slow} {v} {fast}");
            for root in [slow, fast] {
                let there = e0 + (1.0 - e0) * root / v1;
                assert_relative("W_n", 375.0 * root * root * (1.0 - there * there), energy, 1e-9);
                // The work at a speed is that with the restitution at that speed.
                assert_relative("W_n", problem.normal_work(root), energy, 1e-9);
                assert!((problem.residual(root) / energy).abs() < 1e-9);
            }
        }
        let beyond = problem(greatest * (1.0 + 1e-9), EnergyBasis::Dissipated);
        let refused = with_curve(&beyond, &curve).solve();
        assert!(
            matches!(refused, Err(ReconcileError::NotReached { vehicle: VehicleId::One, .. })),
            "{refused:?}"
        );
    }
}

/// The extrema of a function, by brute force: a grid from `low` to `high`, with each triple whose middle is
/// the highest or lowest narrowed by thirds.
fn turns(f: &dyn Fn(f64) -> f64, [low, high]: [f64; 2]) -> Vec<[f64; 3]> {
    let ratio: f64 = 1.01;
    let xs: Vec<f64> =
        std::iter::successors(Some(low), |x| Some(x * ratio)).take_while(|x| *x < high).collect();
    let fs: Vec<f64> = xs.iter().map(|&x| f(x)).collect();
    let mut found = Vec::new();
    for (x, y) in xs.windows(3).zip(fs.windows(3)) {
        let side = if y[1] > y[0] && y[1] > y[2] {
            1.0
        } else if y[1] < y[0] && y[1] < y[2] {
            -1.0
        } else {
            continue;
        };
        let (mut a, mut b) = (x[0], x[2]);
        for _ in 0..60 {
            let (left, right) = ((2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0);
            if side * f(left) > side * f(right) {
                b = right;
            } else {
                a = left;
            }
        }
        found.push([x[0], 0.5 * (a + b), x[2]]);
    }
    found
}

/// The point at which `f` changes sign between `a` and `b`, by bisection.
fn change(f: &dyn Fn(f64) -> f64, [mut a, mut b]: [f64; 2]) -> Option<f64> {
    let sign = f(a) < 0.0;
    if (f(b) < 0.0) == sign {
        return None;
    }
    for _ in 0..80 {
        let middle = 0.5 * (a + b);
        if (f(middle) < 0.0) == sign {
            a = middle;
        } else {
            b = middle;
        }
    }
    Some(0.5 * (a + b))
}

/// Whether both speeds are found just on this side of each extremum of W_n; `None` if there is no extremum.
fn finds_both(case: &Case, share: f64) -> Option<bool> {
    if case.slope().abs() < 0.02 {
        return None;
    }
    let pushed = solve(&case.scene.without_moment(), Condition::Ratio(0.0)).normal_work;
    let scale = -approach(&case.scene)[0];
    let any = case.problem(pushed);
    let speed = |x: f64| any.touching_speed() - x / case.slope();
    let work = |x: f64| any.normal_work(speed(x));
    let mut all = None;
    for [before, x, after] in turns(&work, [scale / 50.0, scale * 50.0]) {
        let top = work(x);
        // An extremum at a pole, or one caused by rounding, does not count.
        if !(top > 1e-6 * pushed && top < 1e6 * pushed && speed(x).abs() < 900.0) {
            continue;
        }
        let outside = [work(before), work(after)];
        let is_maximum = outside[0] < top;
        if outside.iter().any(|y| (y / top - 1.0).abs() < 1e-9 || (y < &top) != is_maximum) {
            continue;
        }
        // The fraction `share` of the difference from the extremum to the nearer end.
        let near = if is_maximum { outside[0].max(outside[1]) } else { outside[0].min(outside[1]) };
        let energy = top + share * (near - top);
        let missing = |x: f64| work(x) - energy;
        let (Some(slow), Some(fast)) = (change(&missing, [before, x]), change(&missing, [x, after])) else {
            continue;
        };
        // Where the sliding reverses, W_n jumps past the energy.
        if [slow, fast].iter().any(|&x| missing(x).abs() > 1e-7 * energy) {
            continue;
        }
        let problem = case.problem(energy);
        let within = x > case.frictionless(energy) / 500.0 && x < case.frictionless(energy) * 500.0;
        let possible = [slow, fast].iter().all(|&x| problem.impact(speed(x)).is_ok());
        if !within || !possible {
            continue;
        }
        let tolerance = 0.2 * (fast - slow) / case.slope().abs();
        let answer = problem.root_finder();
        let both = [slow, fast]
            .map(speed)
            .iter()
            .all(|root| problem.speeds().any(|found| (found - root).abs() <= tolerance));
        all = Some(both && answer.is_ok_and(|answer| answer.admissible >= 2) && all != Some(false));
    }
    all
}

#[track_caller]
fn assert_both(case: &Case, exponent: f64) -> bool {
    let both = finds_both(case, 10_f64.powf(exponent));
    assert!(both != Some(false), "{case:?}");
    both.is_some()
}

#[test]
fn both_speeds_about_a_turn_are_found() {
    let laws = all_laws().prop_filter("fractions stand by themselves", |law| {
        !matches!(law, Tangential::FractionOfCritical(_))
    });
    for_all(8000, 0.02, (case(laws), -4.0..-1.0), |(case, exponent): (Case, f64)| {
        assert_both(&case, exponent)
    });
}

#[test]
fn both_speeds_about_a_turn_are_found_for_a_fraction() {
    let fractions = (0.0..1.0).prop_map(Tangential::FractionOfCritical);
    for_all(4000, 0.01, (case(fractions), -4.0..-1.0), |(case, exponent): (Case, f64)| {
        assert_both(&Case { scene: case.scene.without_moment(), ..case }, exponent)
    });
}

#[test]
fn both_speeds_about_a_turn_are_found_for_a_fraction_with_a_moment_impulse() {
    let fractions = (0.0..1.0).prop_map(Tangential::FractionOfCritical);
    for_all(4000, 0.01, (case(fractions), -4.0..-1.0), |(case, exponent): (Case, f64)| {
        case.scene.moment != -1.0 && assert_both(&case, exponent)
    });
}
