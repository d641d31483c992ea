//! Which number of the file the speed depends on most: exact derivatives, ranked, and the first of them
//! checked by a difference.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use analysis::quantities::SPEED;
use analysis::{Output, Sweep};
use case::{CaseFile, to_toml};

/// (m/s) the speed found if one number of the file is changed by so many of its units.
fn speed(file: &CaseFile, path: &str, change: f64) -> Result<f64, Box<dyn Error>> {
    let case = file.case.map(|input| if input.path == path { input.number + change } else { input.number });
    let file = CaseFile::parse("changed.toml", &to_toml(&case))?;
    Ok(analysis::reconstruct(&file.case)?.found.ok_or("a reconstruction finds a speed")?.speed)
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // SAE 980025, appendix.
    let file = CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
    let sensitivity = analysis::sensitivity(&file.case, Sweep { step: 5_f64.to_radians(), steps: 1 })?;

    let of_the_speed = |output: Output| output.is(&SPEED);
    let ranked: Vec<_> = sensitivity.derivatives.iter().filter(|one| of_the_speed(one.output)).collect();
    for derivative in ranked.iter().take(5) {
        println!("{:28} {:+.2} %", derivative.input.path, 100.0 * derivative.influence());
    }

    // The crush plane comes first, and a difference quotient over ±0.01° agrees.
    let first = ranked.first().ok_or("the speed depends on something")?;
    assert_eq!(first.input.path, "impact.crush_plane");
    let rise = speed(&file, &first.input.path, 0.01)? - speed(&file, &first.input.path, -0.01)?;
    let quotient = rise / (0.02 * first.input.factor());
    assert!((quotient / first.value - 1.0).abs() < 1e-5);
    Ok(())
}
