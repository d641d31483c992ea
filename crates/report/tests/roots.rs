//! Cases with speeds that are hard to find (`fixtures/roots`): all of them are found, counted and listed.
//!
//! The expected speeds come from a dense scan by a program that shares no code with this one, and each gave
//! the crush energy in a forward impact.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use analysis::Analysis;
use case::CaseFile;
use serde_json::Value;

#[track_caller]
fn solved(name: &str) -> (CaseFile, Analysis) {
    let path = format!("{}/../../fixtures/roots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap();
    let file = CaseFile::parse(&path, &text).unwrap_or_else(|error| panic!("{error}"));
    let analysis = analysis::reconstruct(&file.case).unwrap_or_else(|failure| panic!("{name}: {failure}"));
    (file, analysis)
}

/// The speed found in the JSON of a reconstruction.
#[track_caller]
fn found(name: &str) -> Value {
    let (file, analysis) = solved(name);
    let mut document: Value = serde_json::from_str(&report::json(&file, &analysis).unwrap()).unwrap();
    document["found"].take()
}

/// The speeds (m/s) are these, slowest approach first, each within half of its last digit; the first is the
/// answer.
#[track_caller]
fn assert_roots(name: &str, expected: &[(f64, f64)]) {
    let found = found(name);
    let roots: Vec<f64> =
        found["roots"].as_array().unwrap().iter().map(|root| root.as_f64().unwrap()).collect();
    assert_eq!(roots.len(), expected.len(), "{roots:?}");
    assert_eq!(found["admissible_roots"], expected.len());
    assert_eq!(found["value"], roots[0]);
    for (root, (speed, within)) in roots.iter().zip(expected) {
        assert!((root - speed).abs() <= *within, "{roots:?}");
    }
}

#[test]
fn the_only_root_is_the_answer() {
    assert_roots("curve-ks-noanswer", &[(-29.631_284_532_644_308, 1e-9)]);
}

#[test]
fn the_slower_approach_is_the_answer() {
    assert_roots("hidden-root", &[(-69.460_441_049_538_96, 1e-9), (-69.722, 5e-4)]);
}

/// The first lines name every speed.
#[test]
fn the_head_names_all_speeds() {
    let (file, analysis) = solved("fraction-moment");
    let text = report::results(&file.case, &analysis, report::Units::Si).text();
    // 8.4577… and 12.4420 m/s
    let others = "Also admissible: -30.4 km/h, -44.8 km/h";
    assert!(text.lines().take(8).any(|line| line == others), "{text}");
}

#[test]
fn three_roots_close_together_are_found() {
    assert_roots("curve-only", &[(-5.679_92, 5e-6), (-5.645_98, 5e-6), (-5.578, 5e-4)]);
}

#[test]
fn a_fifth_root_is_counted_and_listed() {
    let expected = [(-57.718, 5e-4), (-79.588, 5e-4), (-85.030, 5e-4), (-99.620, 5e-4), (-103.645_027, 5e-7)];
    assert_roots("five-roots", &expected);
}

#[test]
fn a_root_between_two_others_is_found() {
    let expected = [(-8.2934, 5e-5), (-8.457_758_360_765_421, 1e-9), (-12.4420, 5e-5)];
    assert_roots("fraction-moment", &expected);
}

#[test]
fn no_share_of_the_critical_ratio_is_no_friction() {
    assert_roots("fraction0", &[(27.42, 5e-3)]);
}

/// A fraction of μ_c has no closed form, however few steps the root-finder takes.
#[test]
fn the_method_is_that_of_the_law() {
    assert_eq!(found("method-label")["method"], "root finder");
}
