//! The pages in `docs` and the README say what the program says.
//!
//! `UPDATE=1 cargo test -p deltav-report` writes the pages anew. Read the difference before you keep it.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]

use std::fs;
use std::path::{Path, PathBuf};

use validation::{Claim, Data, Validation, validate};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn built_in() -> Validation {
    validate(&Data::built_in()).unwrap()
}

#[track_caller]
fn assert_current(name: &str, now: &str) {
    let path = root().join("docs").join(name);
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&path, now).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == now,
        "docs/{name} is not current: write it anew with UPDATE=1 cargo test -p deltav-report"
    );
}

#[test]
fn the_page_is_current() {
    assert_current("validation.md", &report::validation(&built_in()).markdown());
}

#[test]
fn the_plots_are_current() {
    let validation = built_in();
    assert_current("computed-against-measured.svg", &report::computed_against_measured(&validation).unwrap());
    assert_current("reconstructed-speed.svg", &report::reconstructed_speed(&validation).unwrap());
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_readme_has_the_error_rate() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let headline = report::validation_headline(&built_in());
    assert!(words(&readme).contains(&words(&headline)), "the README has to say:\n{headline}");
}

#[test]
fn the_headline_is_that_of_the_speeds() {
    let validation = built_in();
    let errors: Vec<f64> =
        validation.reconstructions.iter().map(|line| line.found - line.true_speed).collect();
    let mean = errors.iter().sum::<f64>() / 11.0;
    let [least, most] =
        [errors.iter().copied().fold(0.0, f64::min), errors.iter().copied().fold(0.0, f64::max)];
    let headline = report::validation_headline(&validation);
    assert!(mean > 0.0 && headline.contains(&format!("{mean:.1} m/s (")), "{headline}");
    assert!(headline.contains("too high"), "{headline}");
    assert!(headline.contains(&format!("by {least:+.1} to {most:+.1} m/s")), "{headline}");
}

#[test]
fn lines_of_text_fit_the_terminal() {
    let text = report::validation(&built_in()).text();
    let long: Vec<&str> = text.lines().filter(|line| line.chars().count() > 98).collect();
    assert!(long.is_empty(), "{}", long.join("\n"));
}

/// A claim that fails is at the head of every form.
#[test]
fn a_failure_is_shouted() {
    let mut validation = built_in();
    let cell = &mut validation.table2[0].cells[1];
    assert!(matches!(cell.claim, Claim::Reproduces { .. }));
    cell.ours += 1.0;
    let place = "Table 2, test 1, PimCrush, vehicle 2";
    for page in [report::validation(&validation).text(), report::validation(&validation).markdown()] {
        let page = words(&page);
        assert!(page.contains("1 of the 231 numbers that are claimed to reproduce FAIL."), "{page}");
        assert!(page.contains(&format!("Failing: {place}.")), "{page}");
    }
    let text = words(&report::validation(&validation).text());
    assert!(text.contains("FAILS, ≤ 0.10") || text.contains("≤ 0.10, FAILS"), "{text}");
    let json = report::validation_json(&validation).unwrap();
    assert!(json.contains(place) && json.contains("\"reproduces\": false"));
}

/// Every reason and every misprint is told.
#[test]
fn nothing_is_hidden() {
    let validation = built_in();
    let page = words(&report::validation(&validation).text());
    for (place, cell) in validation.cells() {
        if let Claim::KnownDifference { reason } = &cell.claim {
            let tail: String = reason.chars().skip(1).collect();
            assert!(page.contains(&words(&tail)), "{place}: {reason}");
        }
        if let Some(erratum) = &cell.erratum {
            assert!(page.contains(&format!("ERRATUM, printed \"{}\"", erratum.printed)), "{place}");
        }
    }
}
