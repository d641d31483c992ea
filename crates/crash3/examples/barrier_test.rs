//! Stiffness from a barrier test: the fit reproduces the test's kinetic energy, the shortcut through the mean
//! crush gives some per cent more.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use crash3::{BarrierTest, CrushError, Profile, crush_energy};

pub(crate) fn main() -> Result<(), CrushError> {
    // Invented: 1500 kg at 15.6 m/s (56 km/h) against a rigid barrier; no crush would have remained at 2.2
    // m/s.
    let (mass, speed) = (1500.0, 15.6);
    let profile = Profile::equally_spaced(vec![0.42, 0.50, 0.54, 0.54, 0.50, 0.42], 1.6)?;
    let test = BarrierTest::new(mass, speed, profile.clone(), 2.2)?;

    // T = ½ m V²
    let kinetic_energy = 0.5 * mass * speed * speed;
    let exact = test.fit()?;
    let mean = test.fit_mean()?;
    for (name, stiffness) in [("exact", &exact), ("mean", &mean)] {
        let share = crush_energy(&profile, stiffness) / kinetic_energy;
        println!(
            "{name}: A {:.0} N/m, B {:.0} N/m², energy {:.4} of the test's",
            stiffness.a(),
            stiffness.b(),
            share
        );
    }
    assert!((crush_energy(&profile, &exact) / kinetic_energy - 1.0).abs() < 1e-12);
    assert!(crush_energy(&profile, &mean) > kinetic_energy);
    Ok(())
}
