//! The cases of `fixtures/invalid`, including those that are given as changes of one case.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The case that `changes.diff` changes. It is a valid one.
pub(crate) const BASE: &str = "base";

pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/invalid")
}

/// The texts of all invalid cases, by name: of the files, and of `base.toml` changed.
pub(crate) fn invalid_cases() -> BTreeMap<String, String> {
    let read = |name: &str| fs::read_to_string(folder().join(name)).unwrap();
    let mut cases = changed(&read("base.toml"), &read("changes.diff"));
    for entry in fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        if path.extension().is_some_and(|ending| ending == "toml") && name != BASE {
            let twice = cases.insert(name.to_owned(), fs::read_to_string(&path).unwrap());
            assert!(twice.is_none(), "{name} is a file and a change");
        }
    }
    cases
}

/// `base` with each of the changes, by name. The head of `fixtures/invalid/changes.diff` says how they are
/// written.
pub(crate) fn changed(base: &str, changes: &str) -> BTreeMap<String, String> {
    let mut cases = BTreeMap::new();
    let lines: Vec<&str> = changes.lines().filter(|line| !line.starts_with('#')).collect();
    for change in lines.split(|line| line.is_empty()).filter(|change| !change.is_empty()) {
        let (name, lines) = change.split_first().unwrap();
        assert!(
            !name.starts_with([' ', '+', '-']),
            "{name:?} is not a name: a line that is empty is \"+\" or \" \""
        );
        let side = |left_out: char| -> String {
            let lines = lines.iter().filter(|line| !line.starts_with(left_out));
            lines.map(|line| format!("{}\n", line.strip_prefix([' ', '+', '-']).unwrap())).collect()
        };
        let (old, new) = (format!("\n{}", side('+')), format!("\n{}", side('-')));
        // Whole lines, the first and the last of the file too.
        let text = format!("\n{base}");
        assert!(old != new, "{name} changes nothing");
        let once = text.find(&old).is_some_and(|at| text.rfind(&old) == Some(at));
        assert!(once, "{name} needs its place once in the case:{old}");
        let text = text.replacen(&old, &new, 1);
        let twice = cases.insert((*name).to_owned(), text[1..].to_owned());
        assert!(twice.is_none(), "{name} stands there twice");
    }
    cases
}
