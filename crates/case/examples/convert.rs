//! A case is read, all of its numbers are converted to SI, and it is written again: the file of another
//! analyst in one's own units.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use case::{CaseFile, Diagnostics, Dimension, Input, to_toml};

/// The number, followed by its unit of the SI.
fn in_si(input: &Input) -> String {
    let unit = input.unit.map_or("", |unit| unit.dimension().si_unit());
    format!("{} = {} {unit}", input.path, input.si())
}

pub(crate) fn main() -> Result<(), Diagnostics> {
    // SAE 980025, appendix.
    let file = CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;

    let inputs = file.case.inputs();
    for input in inputs.iter().take(4) {
        println!("{}", in_si(input));
    }
    // The contact point of the Jimmy, 6.3 ft: 6.3 × 0.3048 m.
    let distance = inputs.iter().find(|input| input.path == "vehicle1.contact.distance");
    assert!(distance.is_some_and(|input| (input.si() - 1.92024).abs() < 1e-12));
    assert!(inputs.iter().any(|input| input.unit.is_some_and(|unit| unit.dimension() == Dimension::Inertia)));

    // Twenty miles per hour instead of ten for the other car. The units of the file stay.
    let changed = file.case.map(|input| if input.path == "vehicle2.speed" { 20.0 } else { input.number });
    let text = to_toml(&changed);
    assert!(text.contains("\"20 mph\""));

    // The written text is read as the same case.
    let again = CaseFile::parse("changed.toml", &text)?.case;
    assert_eq!(again, changed);
    Ok(())
}
