//! Every file of tests is part of a test binary.
//!
//! A package with `autotests = false` links its files into one binary; cargo is silent about a file that
//! `main.rs` does not name.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of tests and the manifest of each package of the workspace.
fn packages() -> Vec<(PathBuf, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let crates = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let mut packages: Vec<_> = crates.map(|path| (path.join("tests"), path.join("Cargo.toml"))).collect();
    packages.push((root.join("tests"), root.join("tests/Cargo.toml")));
    packages
}

/// The test files, by name without extension, that are in no binary.
fn left_out(files: &[String], main: &str, manifest: &str) -> Vec<String> {
    let has = |text: &str, line: &str| text.lines().any(|other| other.trim() == line);
    files
        .iter()
        .filter(|name| *name != "main")
        .filter(|name| !has(main, &format!("mod {name};")) && !has(manifest, &format!("name = \"{name}\"")))
        .cloned()
        .collect()
}

#[test]
fn every_file_of_tests_is_in_a_binary() {
    let mut binaries = 0;
    for (folder, manifest) in packages() {
        let Ok(main) = fs::read_to_string(folder.join("main.rs")) else {
            continue;
        };
        let manifest = fs::read_to_string(manifest).unwrap();
        let paths = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
        let files: Vec<String> = paths
            .filter(|path| path.extension().is_some_and(|ending| ending == "rs"))
            .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
            .collect();
        let left_out = left_out(&files, &main, &manifest);
        assert!(left_out.is_empty(), "{} does not name {left_out:?}", folder.join("main.rs").display());
        binaries += 1;
    }
    assert!(binaries >= 6, "only {binaries} packages have a main.rs of tests");
}

#[test]
fn a_file_left_out_is_found() {
    let files = ["main", "laws", "claims", "alone"].map(str::to_owned);
    assert_eq!(left_out(&files, "mod laws;\n// mod claims;\n", "[[test]]\nname = \"alone\"\n"), ["claims"]);
}
