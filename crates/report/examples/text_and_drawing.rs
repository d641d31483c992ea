//! From a case to a report as text and a plan view as SVG: all that a program of one's own needs of the
//! workspace.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use case::CaseFile;
use report::{Subject, Units};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // SAE 980025, appendix.
    let file = CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
    let analysis = analysis::reconstruct(&file.case)?;

    let text = report::results(&file.case, &analysis, Units::Si).text();
    for line in text.lines().take(5) {
        println!("{line}");
    }
    for warning in &analysis.warnings {
        println!("{}", report::message(&warning.seen(file.case.axes), Units::Si));
    }
    // The paper finds 22.9 m/s.
    assert!(text.contains("Speed of vehicle 1: 82.3 km/h (22.87 m/s)"));

    let scene = report::drawing(&file, &analysis, Units::Si, Subject::Scene)?;
    println!("{} bytes of SVG: {}", scene.svg().len(), scene.title());
    assert!(scene.svg().starts_with("<svg") && scene.svg().contains("GMC Jimmy"));
    Ok(())
}
