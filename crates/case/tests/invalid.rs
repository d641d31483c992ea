//! Every case in `fixtures/invalid` is refused with exactly the text beside it.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use case::Case;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/invalid")
}

/// The names, without their ending, of the files with that ending.
fn names(ending: &str) -> BTreeSet<String> {
    let files = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    files
        .filter(|path| path.extension().is_some_and(|extension| extension == ending))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect()
}

#[test]
fn every_invalid_case_has_its_text() {
    let update = std::env::var_os("UPDATE").is_some();
    let cases = names("toml");
    assert!(cases.len() >= 40, "only {} invalid cases were found", cases.len());
    let mut failures = Vec::new();
    for name in &cases {
        let text = fs::read_to_string(folder().join(format!("{name}.toml"))).unwrap();
        let Err(diagnostics) = Case::parse(&format!("{name}.toml"), &text) else {
            failures.push(format!("{name}.toml is accepted"));
            continue;
        };
        assert!(!diagnostics.list().is_empty(), "{name}.toml is refused without a reason");
        let rendered = format!("{diagnostics}\n");
        let expected = folder().join(format!("{name}.txt"));
        if update {
            fs::write(&expected, &rendered).unwrap();
        }
        match fs::read_to_string(&expected) {
            Ok(wanted) if wanted == rendered => {}
            Ok(wanted) => failures.push(format!("{name}.txt says\n{wanted}but the program says\n{rendered}")),
            Err(_) => failures.push(format!("{name}.txt is missing; the program says\n{rendered}")),
        }
    }
    for orphan in names("txt").difference(&cases) {
        failures.push(format!("{orphan}.txt has no {orphan}.toml"));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_error_says_what_to_write() {
    for name in names("toml") {
        let text = fs::read_to_string(folder().join(format!("{name}.toml"))).unwrap();
        for diagnostic in Case::parse(&name, &text).unwrap_err().list() {
            assert!(diagnostic.problem().help().is_some(), "{name}: {} has no help", diagnostic.problem());
        }
    }
}
