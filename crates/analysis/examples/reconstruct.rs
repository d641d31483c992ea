//! A case reconstructed: the speed, each vehicle's ΔV, and every warning with its code.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use case::CaseFile;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // SAE 980025, appendix.
    let file = CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
    let analysis = analysis::reconstruct(&file.case)?;

    let found = analysis.found.as_ref().ok_or("a reconstruction finds a speed")?;
    let impact = analysis.impact.as_ref().ok_or("a reconstruction has an impact")?;
    let [dv1, dv2] = impact.outcome.delta_v_magnitude();
    println!("speed {:.2} m/s, ΔV {dv1:.2} and {dv2:.2} m/s", found.speed);
    for warning in &analysis.warnings {
        // `report::message` makes a sentence of it.
        println!("warning: {}", warning.code());
    }

    // The paper prints 22.9 m/s, and nothing of its example is doubtful.
    assert!((found.speed - 22.9).abs() <= 0.05);
    assert!(analysis.warnings.is_empty());
    Ok(())
}
