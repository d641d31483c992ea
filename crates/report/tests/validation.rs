//! The pages in `docs` and the README have the numbers of the program.
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

use resvg::usvg::Tree;
use validation::{Claim, Data, DeltaVRow, Validation, validate};

use super::fixtures::reader::{Reader, Scale, area, attribute, scales};

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
    assert_current("computed-against-measured.svg", &report::computed_against_measured(&validation).svg());
    assert_current("reconstructed-speed.svg", &report::reconstructed_speed(&validation).svg());
}

/// Where the symbol of a point is, in the units of the axes of a chart. A triangle's middle lies up to a
/// pixel below that of its box.
#[track_caller]
fn assert_drawn(svg: &str, tree: &Tree, [across, upward]: &[Scale; 2], id: &str, [x, y]: [f64; 2]) {
    let symbol = area(tree, id);
    let drawn = [
        across.value(f64::from(symbol.left() + symbol.right()) / 2.0),
        upward.value(f64::from(symbol.top() + symbol.bottom()) / 2.0),
    ];
    assert!((drawn[0] - x).abs() < 0.05 * across.pixel(), "{id}: {drawn:?} for {x}, {y}");
    assert!((drawn[1] - y).abs() < 1.1 * upward.pixel(), "{id}: {drawn:?} for {x}, {y}");
    assert!(attribute(svg, id, "fill").is_some());
}

#[test]
fn the_plots_have_every_point_in_its_place() {
    const FOOT: f64 = 0.3048;
    let validation = built_in();
    let reader = Reader::new();
    let svg = report::computed_against_measured(&validation).svg();
    let tree = reader.tree(&svg);
    let labels = reader.readable("computed against measured", &svg);
    let mut tests = Vec::new();
    for (panel, row) in [(1, DeltaVRow::PimTotal), (2, DeltaVRow::CrashCorrected)] {
        let left = f64::from(panel - 1) * 600.0;
        let scales = scales(&svg, left + 24.0, left + 624.0);
        let lines: Vec<_> = validation.table2.iter().filter(|line| line.row == row).collect();
        assert_eq!(lines.len(), 11);
        for (k, line) in lines.into_iter().enumerate() {
            for i in [0, 1] {
                let id = format!("computed-against-measured-point-{panel}-{}", 2 * k + i + 1);
                let at = [line.measured[i] / FOOT, line.cells[i].ours / FOOT];
                assert_drawn(&svg, &tree, &scales, &id, at);
                // Vehicle 2 is hollow.
                assert_eq!(attribute(&svg, &id, "fill").unwrap() == "none", i == 1, "{id}");
                tests.push(line.test.to_string());
            }
        }
    }
    let count = |words: &str| labels.iter().filter(|(label, _)| label == words).count();
    for test in &tests {
        let ticks = if test == "10" { 4 } else { 0 };
        assert_eq!(count(test) - ticks, tests.iter().filter(|other| *other == test).count(), "{test}");
    }
    for line in validation.table1.iter().filter(|line| line.method == validation::Method::Pim) {
        assert_eq!(count(&line.geometry), 1, "{}", line.geometry);
    }

    let svg = report::reconstructed_speed(&validation).svg();
    let tree = reader.tree(&svg);
    reader.readable("reconstructed speed", &svg);
    let scales = scales(&svg, 0.0, 648.0);
    let tests = validation.reconstructions.len();
    assert_eq!(tests, 11);
    for (k, line) in validation.reconstructions.iter().enumerate() {
        for (source, speed) in [line.found, line.found_implied, line.round_trip.ours].into_iter().enumerate()
        {
            let id = format!("reconstructed-speed-point-1-{}", source * tests + k + 1);
            assert_drawn(&svg, &tree, &scales, &id, [line.true_speed, speed]);
        }
    }
}

/// The description of a plot for a reader who cannot see it: the farthest points, looked up in the tables.
#[test]
fn the_plots_say_how_far_points_are_off() {
    let validation = built_in();
    let drawing = report::reconstructed_speed(&validation);
    let errors = validation.reconstructions.iter().map(|line| line.found - line.true_speed);
    let [least, most] =
        [errors.clone().fold(0.0, f64::min), errors.fold(0.0, f64::max)].map(|error| format!("{error:.1}"));
    let words = format!(" From published profiles: 11 points, differences from {least} to {most};");
    assert!(drawing.description().contains(&words), "{}", drawing.description());
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The README has the mean and the rms error of each error rate; docs/validation.md has all of it.
#[test]
fn the_readme_has_the_error_rate() {
    let [readme, details] = ["README.md", "docs/validation.md"]
        .map(|name| words(&fs::read_to_string(root().join(name)).unwrap()));
    let mut from = 0;
    for headline in [report::validation_headline, report::both_speeds_headline] {
        let headline = words(&headline(&built_in(), report::Units::Si));
        assert!(details.contains(&headline), "docs/validation.md has to say:\n{headline}");
        // One after the other, as the first is that of vehicle 1 alone.
        for (begin, end) in [("On average ", ";"), ("an rms error of ", ".")] {
            let part = &headline[headline.find(begin).unwrap()..];
            let part = part.split(end).next().unwrap();
            let found = readme[from..].find(part);
            from += found.unwrap_or_else(|| panic!("the README has to say: {part}")) + part.len();
        }
    }
    assert!(readme[from..].contains("(docs/validation.md)"));
}

/// A report has the error rate of the quantities that it finds; one that finds no quantity of a collision has
/// none.
#[test]
fn a_report_has_the_error_rate_of_its_own_answer() {
    let validation = built_in();
    let page = |case: &str, solve: fn(&case::Case) -> Result<analysis::Analysis, analysis::Failure>| {
        let text = fs::read_to_string(root().join("fixtures").join(case)).unwrap();
        let file = case::CaseFile::parse(case, &text).unwrap();
        let supplements = report::Supplements { validation: Some(&validation), ..Default::default() };
        let analysis = solve(&file.case).unwrap();
        let page = report::handover(&file, &analysis, supplements, report::Units::Si).unwrap();
        words(&page.markdown())
    };
    let [one, both] = [report::validation_headline, report::both_speeds_headline]
        .map(|headline| words(&headline(&validation, report::Units::Si)));
    let of_one = page("sae-980025.toml", analysis::reconstruct);
    assert!(of_one.contains(&one) && !of_one.contains(&both));
    let of_both = page("rear-end-rest.toml", analysis::reconstruct);
    assert!(of_both.contains(&both) && !of_both.contains(&one));
    assert!(!of_both.contains("reconstructs no speed"));
    // The assumed motion of the two vehicles.
    for vehicle in ["vehicle 1", "vehicle 2"] {
        assert!(of_both.contains(&format!("By EDCRASH's rule, {vehicle} did not spin")), "{of_both}");
    }
    let forward = page("sae-980025-impact.toml", analysis::impact);
    assert!(forward.contains("reconstructs no speed") && forward.contains(&one));
    for alone in [page("one-vehicle.toml", analysis::crush), page("motion/ricsac-6.toml", analysis::motion)] {
        assert!(!alone.contains("error rate") && !alone.contains("how far the method is off"), "{alone}");
    }
}

/// n, bias, range and rms of the 22 speeds, in km/h and mph, from the rows.
#[test]
fn the_second_headline_is_that_of_both_speeds() {
    let validation = built_in();
    let errors: Vec<f64> = validation
        .both_speeds
        .iter()
        .flat_map(|row| [0, 1].map(|i| row.found[i] - row.true_speeds[i]))
        .collect();
    assert_eq!(errors.len(), 22);
    let mean = errors.iter().sum::<f64>() / 22.0;
    let rms = (errors.iter().map(|error| error * error).sum::<f64>() / 22.0).sqrt();
    let [least, most] =
        [errors.iter().copied().fold(0.0, f64::min), errors.iter().copied().fold(0.0, f64::max)];
    for (units, name, size) in
        [(report::Units::Si, "km/h", 1.0 / 3.6), (report::Units::Us, "mph", 1609.344 / 3600.0)]
    {
        let headline = report::both_speeds_headline(&validation, units);
        let [mean, rms, least, most] = [mean, rms, least, most].map(|error| error / size);
        assert!(headline.contains("the 22 speeds of 11 staged collisions"), "{headline}");
        assert!(headline.contains(&format!("they are {:.0} {name} (", mean.abs())), "{headline}");
        assert!(mean < 0.0 && headline.contains("too low"), "{headline}");
        assert!(headline.contains(&format!("by {least:+.0} to {most:+.0} {name}")), "{headline}");
        assert!(headline.contains(&format!("rms error of {rms:.0} {name}")), "{headline}");
        assert!(headline.contains("of the 19 that were not zero"), "{headline}");
    }
}

#[test]
fn the_headline_is_that_of_the_speeds() {
    let validation = built_in();
    let errors: Vec<f64> =
        validation.reconstructions.iter().map(|line| line.found - line.true_speed).collect();
    let mean = errors.iter().sum::<f64>() / 11.0;
    let [least, most] =
        [errors.iter().copied().fold(0.0, f64::min), errors.iter().copied().fold(0.0, f64::max)];
    let headline = report::validation_headline(&validation, report::Units::Si);
    // 1 m/s is 3.6 km/h.
    let [mean, least, most] = [mean, least, most].map(|error| error * 3.6);
    assert!(mean > 0.0 && headline.contains(&format!("{mean:.0} km/h (")), "{headline}");
    assert!(headline.contains("too high"), "{headline}");
    assert!(headline.contains(&format!("by {least:+.0} to {most:+.0} km/h")), "{headline}");
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
        assert!(page.contains("1 of the 240 numbers that are claimed to reproduce FAIL."), "{page}");
        assert!(page.contains(&format!("Failing: {place}.")), "{page}");
    }
    let text = words(&report::validation(&validation).text());
    assert!(text.contains("FAILS, ≤ 0.10") || text.contains("≤ 0.10, FAILS"), "{text}");
    let json = report::validation_json(&validation).unwrap();
    assert!(json.contains(place) && json.contains("\"reproduces\": false"));
}

/// Every reason and every misprint is given.
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
