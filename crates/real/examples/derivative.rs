//! The exact derivative of a formula with respect to one of its inputs: write it once over `Real`, evaluate
//! it on `Duals`.
//!
//! How much does the EES of the paper's GMC Jimmy change with its crush energy?

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use real::{Duals, Real};

/// (m/s) energy equivalent speed of a mass (kg) whose crush took an energy (J).
fn energy_equivalent_speed<T: Real>(energy: T, mass: T) -> T {
    // EES = √(2E/m)
    (energy * 2.0 / mass).sqrt()
}

pub(crate) fn main() {
    // SAE 980025, appendix: 1.02e5 N·m of crush on 3696 lb.
    let (energy, mass) = (1.02e5, 1676.5);
    let speed = energy_equivalent_speed(Duals::<1>::variable(energy, 0), Duals::from(mass));
    let [derivative] = speed.derivatives;
    println!("EES {:.2} m/s, and {:.4} m/s more for each kJ", speed.value, 1000.0 * derivative);

    // By hand: dEES/dE = EES/2E.
    let by_hand = speed.value / (2.0 * energy);
    assert!((derivative / by_hand - 1.0).abs() < 1e-14);
    // On plain numbers it is the same function.
    assert_eq!(speed.value, energy_equivalent_speed(energy, mass));
    // A speed of 11.03 m/s has 1.02e5 J in 1676.5 kg.
    assert!((0.5 * mass * 11.03 * 11.03 / energy - 1.0).abs() < 5e-4);
}
