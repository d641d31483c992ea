//! How far off the program is: the speed of vehicle 1 of each staged collision, from its crush and as it was
//! driven.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use validation::{Data, validate};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let validation = validate(&Data::built_in())?;
    let mut squares = 0.0;
    for row in &validation.reconstructions {
        println!("test {:2}: driven {:5.2} m/s, found {:5.2} m/s", row.test, row.true_speed, row.found);
        squares += row.error() * row.error();
    }
    let [rate, _] = &validation.speed_errors.profiles;
    println!("rms error {:.2} m/s, mean {:+.2} m/s", rate.rms, rate.mean);

    // √(Σ e²/n) over the eleven collisions that SAE 980025 compares.
    assert_eq!(rate.count, 11);
    assert!((rate.rms - (squares / 11.0).sqrt()).abs() < 1e-12);
    // Vehicle 1 of test 8 was driven at 9.3 m/s (Vossou 2018).
    let eighth = validation.reconstructions.iter().find(|row| row.test == 8).ok_or("test 8 is compared")?;
    assert!((eighth.true_speed - 9.3).abs() < 1e-9);
    Ok(())
}
