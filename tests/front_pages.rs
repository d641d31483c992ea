//! The front page of every library crate has an example that runs, and checks a number.

use std::fs;
use std::path::Path;

/// The examples on the front page of a crate that rustdoc runs, each as one string.
fn examples(lib: &str) -> Vec<String> {
    let page = lib.lines().filter_map(|line| line.strip_prefix("//!")).map(str::trim_start);
    let mut found = Vec::new();
    let mut open: Option<(bool, String)> = None;
    for line in page {
        match (line.strip_prefix("```"), &mut open) {
            (Some(language), None) => open = Some((matches!(language, "" | "rust"), String::new())),
            (Some(_), Some(_)) => found.extend(open.take().filter(|(runs, _)| *runs).map(|(_, text)| text)),
            (None, Some((_, text))) => {
                text.push_str(line);
                text.push('\n');
            }
            (None, None) => {}
        }
    }
    found
}

fn checks_a_number(example: &str) -> bool {
    let asserts = example.lines().map(str::trim_start).filter(|line| line.starts_with("assert"));
    asserts.into_iter().any(|line| line.contains(|c: char| c.is_ascii_digit()))
}

#[test]
fn every_front_page_has_an_example_that_checks_a_number() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut pages = 0;
    for entry in fs::read_dir(root.join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let Ok(lib) = fs::read_to_string(folder.join("src/lib.rs")) else { continue };
        let name = folder.display();
        assert!(examples(&lib).iter().any(|example| checks_a_number(example)), "{name}: src/lib.rs has none");
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        assert!(!manifest.contains("doctest = false"), "{name}: its examples are not run");
        pages += 1;
    }
    assert!(pages >= 17, "{pages}");
}

#[test]
fn an_example_that_does_not_run_or_checks_nothing_is_none() {
    let has_one = |lib: &str| examples(lib).iter().any(|example| checks_a_number(example));
    assert!(has_one("//! A crate.\n//!\n//! ```\n//! assert_eq!(2 + 2, 4);\n//! ```\n"));
    assert!(!has_one("//! ```ignore\n//! assert_eq!(2 + 2, 4);\n//! ```\n"));
    assert!(!has_one("//! ```text\n//! assert_eq!(2 + 2, 4);\n//! ```\n//! assert 4\n"));
    assert!(!has_one("//! ```\n//! let four = 2 + 2;\n//! ```\n"));
    assert!(!has_one("/// ```\n/// assert_eq!(2 + 2, 4);\n/// ```\n"));
}
