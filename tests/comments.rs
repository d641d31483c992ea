//! Comments keep to the line width of the code, which the formatter does not enforce.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::{Path, PathBuf};

/// `max_width` of rustfmt.toml.
const WIDTH: usize = 110;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() {
            if !name.starts_with("target") && !name.starts_with('.') {
                sources(&path, found);
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Rows of tables, code and single words cannot be broken.
fn is_whole(comment: &str) -> bool {
    comment.starts_with("| ")
        || comment.starts_with("let ")
        || comment.starts_with("assert")
        || !comment.contains(' ')
}

#[test]
fn comments_keep_to_the_line_width() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut paths = Vec::new();
    for folder in ["crates", "python/src", "tests", "benches", "fuzz/fuzz_targets"] {
        sources(&root.join(folder), &mut paths);
    }
    assert!(paths.len() > 200, "{}", paths.len());
    let mut long = Vec::new();
    for path in paths {
        for (i, line) in fs::read_to_string(&path).unwrap().lines().enumerate() {
            let text = line.trim_start();
            let comment = text.trim_start_matches(['/', '!']).trim_start();
            if text.starts_with("//") && line.chars().count() > WIDTH && !is_whole(comment) {
                long.push(format!("{}:{}", path.display(), i + 1));
            }
        }
    }
    assert!(long.is_empty(), "longer than {WIDTH} columns: {long:#?}");
}
