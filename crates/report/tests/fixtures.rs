//! Requirements for every valid case of the fixtures: drawings, and substitutions that give the printed
//! results.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "the calculator and the measures are not those of the program")]

#[path = "fixtures/axes.rs"]
mod axes;
#[path = "fixtures/drawings.rs"]
mod drawings;
#[path = "fixtures/evaluate.rs"]
mod evaluate;
#[path = "fixtures/pages.rs"]
mod pages;
#[path = "fixtures/plots.rs"]
mod plots;
#[path = "../../drawing/tests/reader.rs"]
pub(crate) mod reader;
#[path = "fixtures/substitutions.rs"]
mod substitutions;
#[path = "fixtures/texts.rs"]
mod texts;

use std::fs;
use std::path::PathBuf;

use analysis::Analysis;
use case::{Axes, CaseFile};

/// Every analysis that a valid case allows, with the name of the case; each case in z-up and in z-down axes.
fn analyses() -> Vec<(String, CaseFile, Analysis)> {
    [analyses_in(Axes::ZUp), analyses_in(Axes::ZDown)].concat()
}

/// The same in these axes alone.
fn analyses_in(axes: Axes) -> Vec<(String, CaseFile, Analysis)> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut analyses = Vec::new();
    for folder in ["", "laws", "ricsac"] {
        let mut paths: Vec<PathBuf> =
            fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        for path in paths.into_iter().filter(|path| path.extension().is_some_and(|e| e == "toml")) {
            let text = fs::read_to_string(&path).unwrap();
            // Not a case: the numbers that the papers print.
            let Ok(file) = CaseFile::parse(&path.display().to_string(), &text) else {
                assert!(path.ends_with("published.toml"), "{}", path.display());
                continue;
            };
            let file = match (file.case.axes, axes) {
                (Axes::ZUp, Axes::ZUp) => file,
                (Axes::ZUp, Axes::ZDown) => axes::z_down(&file.case),
                (Axes::ZDown, _) => continue,
            };
            let of = |kind: &str| format!("{} {} {kind}", path.file_name().unwrap().display(), axes.name());
            let results = [
                ("reconstruct", analysis::reconstruct(&file.case)),
                ("impact", analysis::impact(&file.case)),
                ("crush", analysis::crush(&file.case)),
            ];
            let before = analyses.len();
            for (kind, result) in results {
                if let Ok(analysis) = result {
                    analyses.push((of(kind), file.clone(), analysis));
                }
            }
            assert!(analyses.len() > before, "{} has no answer", path.display());
        }
    }
    assert!(analyses.len() > 30, "only {} analyses", analyses.len());
    analyses
}
