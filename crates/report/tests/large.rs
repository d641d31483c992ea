//! Profiles of as many stations as a case may have cost a multiple of a small one, not its square.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use analysis::Sweep;
use case::CaseFile;
use report::{Subject, Supplements, Units};

const STATIONS: usize = 10_000;

/// Work that grows with the numbers takes some seconds in a test build on a busy machine; work that grows
/// with their square, minutes.
const SOON: Duration = Duration::from_secs(30);

/// SAE 980025's example with so many stations on both vehicles.
fn scanned(stations: usize) -> CaseFile {
    let mut text = String::new();
    for line in include_str!("../../../fixtures/sae-980025.toml").lines() {
        if line.starts_with("depths") {
            let depths: Vec<String> = (0..stations).map(|i| (10 + i % 9).to_string()).collect();
            writeln!(text, "depths = \"{} in\"", depths.join(" ")).unwrap();
        } else {
            writeln!(text, "{line}").unwrap();
        }
    }
    CaseFile::parse("scanned.toml", &text).unwrap()
}

#[test]
fn the_derivatives_by_all_stations_come_soon() {
    let file = scanned(STATIONS);
    let start = Instant::now();
    let sensitivity = analysis::sensitivity(&file.case, Sweep { step: 0.1, steps: 1 }).unwrap();
    assert_eq!(sensitivity.derivatives.len(), 3 * file.case.inputs().len());
    assert!(file.case.inputs().len() > 2 * STATIONS);
    assert!(start.elapsed() < SOON, "{:?}", start.elapsed());
}

/// The drawing shows all of the paper's six stations; of thousands, as many as can be distinguished.
#[test]
fn a_drawing_does_not_grow_with_the_stations() {
    let drawn = |stations| {
        let file = scanned(stations);
        let analysis = analysis::reconstruct(&file.case).unwrap();
        let drawing = report::drawing(&file, &analysis, Units::Us, Subject::Damage).unwrap();
        let svg = drawing.svg();
        (svg.matches("<circle").count(), svg.matches("<text").count(), svg)
    };
    let (dots, texts, svg) = drawn(6);
    assert!(svg.contains("C1 to C6: 10.0 11.0 12.0") || svg.contains("C1 to C6: 10.0, 11.0"), "{svg}");
    let (many_dots, many_texts, svg) = drawn(STATIONS);
    assert!(dots >= 12 && many_dots < 400, "{dots} {many_dots}");
    assert!(many_texts < texts + 40, "{texts} {many_texts}");
    assert!(svg.contains("C1 to C10000: 10.0 in to 18.0 in deep"), "{svg}");
}

/// Texts of a case may be long, too.
#[test]
fn a_page_with_long_texts_comes_soon() {
    let text = include_str!("../../../fixtures/sae-980025.toml");
    let long = |letters: usize| "collision of two vehicles ".repeat(letters / 26);
    let (title, name) = (long(50_000), "x".repeat(20_000));
    let text: String = text
        .lines()
        .map(|line| match line.split_whitespace().next() {
            Some("title") => format!("title = \"{title}\"\n"),
            Some("source") => format!("source = \"{title}\"\n"),
            Some("name") => format!("name = \"{name}\"\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    let file = CaseFile::parse("long.toml", &text).unwrap();
    let analysis = analysis::reconstruct(&file.case).unwrap();
    let start = Instant::now();
    let page = report::handover(&file, &analysis, Supplements::default(), Units::Us).unwrap().html();
    assert!(page.matches(name.as_str()).count() > 0);
    assert!(start.elapsed() < SOON, "{:?}", start.elapsed());
}
