//! Every case in `fixtures/invalid` is refused with exactly the text next to it.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]

use std::collections::BTreeSet;
use std::fs;

use case::{CaseFile, Program};

use crate::changes::{BASE, changed, folder, invalid_cases};

/// As the program words them: the texts are what its users see.
static PROGRAM: Program = Program {
    begins: Some("`deltav new`"),
    describes_classes: Some("`deltav explain class`"),
    ..Program::NONE
};

/// The names of the texts.
fn texts() -> BTreeSet<String> {
    let files = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    files
        .filter(|path| path.extension().is_some_and(|extension| extension == "txt"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect()
}

#[test]
fn every_invalid_case_has_its_text() {
    let update = std::env::var_os("UPDATE").is_some();
    let cases = invalid_cases();
    assert!(cases.len() >= 270, "only {} invalid cases were found", cases.len());
    let mut failures = Vec::new();
    for (name, text) in &cases {
        let Err(diagnostics) = CaseFile::parse(&format!("{name}.toml"), text) else {
            failures.push(format!("{name}.toml is accepted"));
            continue;
        };
        assert!(!diagnostics.list().is_empty(), "{name}.toml is refused without a reason");
        let rendered = format!("{}\n", diagnostics.in_words_of(&PROGRAM));
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
    for orphan in texts().iter().filter(|name| !cases.contains_key(*name)) {
        failures.push(format!("{orphan}.txt belongs to no case"));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_error_says_what_to_write() {
    for (name, text) in invalid_cases() {
        for diagnostic in CaseFile::parse(&name, &text).unwrap_err().list() {
            assert!(diagnostic.problem().help().is_some(), "{name}: {} has no help", diagnostic.problem());
        }
    }
}

/// A library has no commands to point to.
#[test]
fn no_command_is_named_without_a_program() {
    for (name, text) in invalid_cases() {
        let errors = CaseFile::parse(&name, &text).unwrap_err().to_string();
        assert!(!errors.contains("deltav"), "{name}: {errors}");
    }
}

/// The errors of a changed case come from its change.
#[test]
fn the_case_that_is_changed_is_valid() {
    let text = fs::read_to_string(folder().join(format!("{BASE}.toml"))).unwrap();
    if let Err(diagnostics) = CaseFile::parse("base.toml", &text) {
        panic!("{diagnostics}");
    }
}

#[test]
fn changes_are_made_where_they_stand() {
    let changes = "# of one case\n\nthe-first\n+x = 0\n a = 1\n\nthe-last\n-c = 3\n+c = 4\n\nboth\n-a = 1\n b = 2\n+\n-c = 3\n";
    let cases = changed("a = 1\nb = 2\nc = 3\n", changes);
    let cases: Vec<(&str, &str)> = cases.iter().map(|(name, text)| (&**name, &**text)).collect();
    assert_eq!(
        cases,
        [
            ("both", "b = 2\n\n"),
            ("the-first", "x = 0\na = 1\nb = 2\nc = 3\n"),
            ("the-last", "a = 1\nb = 2\nc = 4\n")
        ]
    );
}

#[test]
#[should_panic(expected = "needs its place once")]
fn a_change_without_a_place_is_refused() {
    changed("a = 1\na = 1\n", "which\n-a = 1\n+a = 2\n");
}
