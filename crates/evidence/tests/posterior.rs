//! Draws compared with a grid over the unknown numbers.

use estimate::{DrawnQuantity, ParticleSettings, sample_quietly};
use evidence::{
    CodedPdof, CollisionModel, CrushMisfit, CrushNumbers, DrawnOutput, MeasuredSpeed, Number, Speeds,
};
use pim_core::VehicleId::{One, Two};
use uncertainty::Distribution;

use crate::likelihood::rear_end;

/// The quantile of a density over x, given at equal steps.
fn quantile(grid: &[(f64, f64)], share: f64) -> f64 {
    let total: f64 = grid.iter().map(|(_, density)| density).sum();
    let mut sum = 0.0;
    for (x, density) in grid {
        sum += density / total;
        if sum >= share {
            return *x;
        }
    }
    panic!("the grid ends below {share}")
}

/// v₁ and v₂ of a rear-end collision from the crush energy and one velocity after the impact, by textbook
/// formulas on a grid.
#[test]
fn both_speeds_are_those_of_a_grid() {
    let mut collision = rear_end();
    let speed = |mean, sd| Number::Unknown(Distribution::normal(mean, sd).unwrap());
    collision.speeds = Speeds::Each([speed(18.0, 6.0), speed(2.0, 3.0)]);
    let crush = |constant| CrushNumbers {
        constant,
        linear: 0.0,
        square: 0.0,
        slope: 1.0.into(),
        no_damage_speed: 1.0.into(),
    };
    collision.vehicles[0].crush = Some(crush(30e3));
    collision.vehicles[1].crush = Some(crush(40e3));
    collision.observed.crush = Some(CrushMisfit { bias: 0.1, ln_sd: 0.3 }.into());
    collision.observed.vehicles[1].after.speed = Some(MeasuredSpeed { value: 11.0, ln_sd: 0.1, least: 0.0 });

    let mut marginals: [Vec<(f64, f64)>; 2] = [Vec::new(), Vec::new()];
    let steps = 600;
    let axis = |k: i32, low: f64, high: f64| low + (high - low) * (f64::from(k) + 0.5) / f64::from(steps);
    let mut table = vec![vec![0.0; steps as usize]; steps as usize];
    for i in 0..steps {
        for j in 0..steps {
            let (v1, v2) = (axis(i, 2.0, 32.0), axis(j, -10.0, 14.0));
            let closing = v1 - v2;
            if closing <= 0.3 {
                continue;
            }
            // E = ½ (1 − e²) m₁m₂/(m₁ + m₂) u², V₂ = v₂ + (1 + e) m₁/(m₁ + m₂) u
            let energy = 0.5 * 0.99 * 600.0 * closing * closing;
            let after = v2 + 1.1 * 0.6 * closing;
            let crush = ((70e3_f64 / energy).ln() - 0.1) / 0.3;
            let speed = if after > 0.0 { (11.0 / after).ln() / 0.1 } else { 1e3 };
            let prior = ((v1 - 18.0) / 6.0).powi(2) + ((v2 - 2.0) / 3.0).powi(2);
            table[i as usize][j as usize] = (-0.5 * (crush * crush + speed * speed + prior)).exp();
        }
    }
    for k in 0..steps {
        let row = table[k as usize].iter().sum();
        marginals[0].push((axis(k, 2.0, 32.0), row));
        marginals[1].push((axis(k, -10.0, 14.0), table.iter().map(|row| row[k as usize]).sum()));
    }

    let model = CollisionModel::new(&collision);
    let posterior = sample_quietly(&model, &model, &ParticleSettings::new(512, 7)).unwrap();
    for (output, grid) in [(DrawnOutput::Speed(One), &marginals[0]), (DrawnOutput::Speed(Two), &marginals[1])]
    {
        let summary = posterior.summary(DrawnQuantity::Output(output.column()));
        let ends = summary.intervals[3];
        assert_eq!(ends.level, 0.95);
        for (ours, share) in [(summary.median, 0.5), (ends.low, 0.025), (ends.high, 0.975)] {
            let exact = quantile(grid, share);
            // Four standard errors, and the step of the grid.
            assert!(
                (ours.value - exact).abs() < 4.0 * ours.standard_error.unwrap() + 0.06,
                "{output:?} {ours:?} {exact}"
            );
        }
    }
}

/// Whatever the evidence, a draw's energy is that of its speeds.
#[test]
fn outputs_are_those_of_one_impact() {
    let mut collision = rear_end();
    collision.speeds = Speeds::Each([Number::Unknown(Distribution::uniform(5.0, 25.0).unwrap()), 0.0.into()]);
    collision.observed.vehicles[0].pdof = Some(CodedPdof { pdof: 0.0, scale: 0.1 });
    let model = CollisionModel::new(&collision);
    let posterior = sample_quietly(&model, &model, &ParticleSettings::new(128, 3)).unwrap();
    let column = |output: DrawnOutput| &posterior.outputs()[output.column()];
    assert!(posterior.count() > 0);
    for k in 0..posterior.count() {
        let v = column(DrawnOutput::Speed(One))[k];
        for (output, expected) in [
            (DrawnOutput::DeltaV(One), 0.44 * v),
            (DrawnOutput::DeltaV(Two), 0.66 * v),
            (DrawnOutput::LongitudinalDeltaV(One), -0.44 * v),
            (DrawnOutput::ClosingSpeed, v),
            (DrawnOutput::EnergyLoss, 0.5 * 0.99 * 600.0 * v * v),
            (DrawnOutput::Restitution, 0.1),
        ] {
            let ours = column(output)[k];
            assert!((ours - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{output:?} {ours} {expected}");
        }
    }
}
