//! Propagation of ranges through any function: here a ΔV by conservation of momentum, from two masses and a
//! closing speed.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;
use std::ops::ControlFlow;

use uncertainty::{Distribution, Function, SamplingMethod, Settings, propagate};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // Masses of the paper's vehicles (SAE 980025, appendix), ± 20 kg; a closing speed of 21 ± 1 m/s; central,
    // without restitution.
    let inputs = [
        Distribution::normal(1676.5, 20.0)?,
        Distribution::normal(1548.1, 20.0)?,
        Distribution::normal(21.0, 1.0)?,
    ];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        // ΔV₁ = m₂/(m₁ + m₂) x
        y[0] = x[1] / (x[0] + x[1]) * x[2];
        Ok(())
    });
    // Points that fill the space evenly need fewer samples; the same seed gives the same bits.
    let settings = Settings::new(SamplingMethod::Sobol, 16_384, 1);
    let result = propagate(&model, &inputs, &settings, &mut |_, _| ControlFlow::Continue(()))?;
    let summary = result.summaries()[0].ok_or("no sample has an answer")?;
    let [low, high] = [summary.intervals[2].low.value, summary.intervals[2].high.value];
    println!("ΔV {:.2} m/s, between {low:.2} and {high:.2} m/s with 95 %", summary.mean.value);

    // By hand, first order: ΔV 10.08 m/s, and u² = (0.4801 · 1)² + (0.003127 · 20)² + (0.003386 · 20)² =
    // 0.489² m²/s².
    assert!((summary.mean.value - 10.08).abs() < 0.01);
    assert!((summary.sd.value - 0.489).abs() < 0.005);
    // A normal distribution has 95 % within 1.96 deviations.
    assert!(((high - low) / (2.0 * 1.96 * 0.489) - 1.0).abs() < 0.01);
    Ok(())
}
