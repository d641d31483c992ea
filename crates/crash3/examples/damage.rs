//! Crush energy of two measured profiles, and CRASH3's velocity changes for it.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use crash3::{CrushError, Profile, Stiffness, StruckVehicle, crush_energy, delta_v, energy_equivalent_speed};

const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
/// √N in one √lb.
const ROOT_POUND: f64 = 2.109_080_751_4;

/// Six depths over a width, in inches; d_0 in √lb and d_1 in √lb/ft. The energy is in joules.
fn energy(depths: [f64; 6], width: f64, d0: f64, d1: f64) -> Result<f64, CrushError> {
    let profile = Profile::equally_spaced(depths.map(|depth| depth * INCH).to_vec(), width * INCH)?;
    let stiffness = Stiffness::from_d0_d1(d0 * ROOT_POUND, d1 * ROOT_POUND / FOOT)?;
    Ok(crush_energy(&profile, &stiffness))
}

pub(crate) fn main() -> Result<(), CrushError> {
    // SAE 980025, appendix: the front of the GMC Jimmy and the right side of the Nissan Altima.
    let jimmy = energy([21.3, 20.3, 13.8, 11.3, 5.3, 4.8], 65.0, 35.0, 115.0)?;
    let altima = energy([3.0, 15.8, 13.5, 6.7, 3.3, 5.0], 84.0, 30.0, 77.5)?;
    println!("crush energy {jimmy:.0} J and {altima:.0} J");
    println!("energy equivalent speed of the Jimmy {:.2} m/s", energy_equivalent_speed(jimmy, 1676.5)?);

    // The force passes the centres of gravity at 0.646 m and 0.592 m, the arms of the example's impulse.
    let vehicles = [StruckVehicle::new(1676.5, 3304.1, 0.646)?, StruckVehicle::new(1548.1, 2935.3, 0.592)?];
    let [dv1, dv2] = delta_v(jimmy + altima, vehicles)?;
    println!("ΔV {:.2} ft/s and {:.2} ft/s, for a common normal velocity", dv1 / FOOT, dv2 / FOOT);

    // The paper prints 1.02e5 and 3.87e4 N·m.
    assert!((jimmy - 1.02e5).abs() <= 0.005e5 && (altima - 3.87e4).abs() <= 0.005e4);
    // Equal and opposite momenta.
    assert!((1676.5 * dv1 - 1548.1 * dv2).abs() < 1e-9);
    Ok(())
}
