//! The maps for contributors name files that exist.

use std::fs;
use std::path::Path;

/// The texts in backticks that are paths from the root of the repository.
fn paths(text: &str) -> Vec<&str> {
    let folders = ["crates/", "python/", "tests/", "benches/", "fuzz/", "docs/", "fixtures/"];
    let is_path = |code: &&str| folders.iter().any(|folder| code.starts_with(folder)) && !code.contains(' ');
    text.split('`').skip(1).step_by(2).filter(is_path).collect()
}

#[test]
fn every_file_that_the_maps_name_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (map, least) in [("ARCHITECTURE.md", 50), ("CONTRIBUTING.md", 8)] {
        let text = fs::read_to_string(root.join(map)).unwrap();
        let paths = paths(&text);
        let absent: Vec<_> = paths.iter().filter(|path| !root.join(path).exists()).collect();
        assert!(absent.is_empty(), "{map} names {absent:?}, which do not exist");
        assert!(paths.len() >= least, "{map} names only {} files", paths.len());
    }
}

/// A crate that is not on the map will not be found.
#[test]
fn every_crate_is_on_the_map() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let map = fs::read_to_string(root.join("ARCHITECTURE.md")).unwrap();
    for entry in fs::read_dir(root.join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let name =
            manifest.lines().find_map(|line| line.strip_prefix("name = \"")).unwrap().trim_end_matches('"');
        let row = format!("| `crates/{}` | `{name}` |", folder.file_name().unwrap().to_str().unwrap());
        assert!(map.contains(&row), "ARCHITECTURE.md has no row {row}");
    }
}
