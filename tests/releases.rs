//! The steps to a release: the book has every page, and the workflows run only commands that anyone can run,
//! with actions pinned to a commit.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The pages in docs that the list of chapters does not name.
fn left_out(summary: &str) -> Vec<String> {
    let mut pages = Vec::new();
    for folder in ["docs", "docs/guide"] {
        for entry in fs::read_dir(root().join(folder)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            if name.ends_with(".md") {
                pages.push(format!("{folder}/{name}"));
            }
        }
    }
    assert!(pages.len() > 20, "{pages:?}");
    pages.retain(|page| !summary.contains(&format!("]({page})")));
    pages
}

#[test]
fn the_book_has_every_page_of_docs() {
    let summary = fs::read_to_string(root().join("book/SUMMARY.md")).unwrap();
    assert_eq!(left_out(&summary), [""; 0]);
    for part in summary.split("](").skip(1) {
        let page = part.split(')').next().unwrap();
        assert!(root().join(page).is_file(), "book/SUMMARY.md names {page}, which does not exist");
        assert_eq!(summary.matches(&format!("]({page})")).count(), 1, "{page} is twice in the book");
    }
    assert_eq!(left_out(&summary.replace("(docs/theory.md)", "")), ["docs/theory.md"]);
}

/// The faults of a workflow, line by line.
fn faults(workflow: &str) -> Vec<String> {
    let mut faults = Vec::new();
    for line in workflow.lines() {
        let step = line.trim_start().trim_start_matches("- ");
        if let Some(action) = step.strip_prefix("uses: ") {
            let hash = action.split_once('@').map_or("", |(_, rest)| rest.split(' ').next().unwrap());
            let is_hash = hash.len() == 40 && hash.chars().all(|c| c.is_ascii_hexdigit());
            if !is_hash || !action.contains(" # v") {
                faults.push(format!("not pinned by a hash with its version beside it: {action}"));
            }
        }
        if let Some(command) = step.strip_prefix("run: ") {
            let script = command.split(' ').next().unwrap();
            let is_ours =
                command.starts_with("cargo run --locked -p xtask -- ") || root().join(script).is_file();
            if !is_ours {
                faults.push(format!("no script of the repository: {command}"));
            }
        }
    }
    let begin = workflow.split("\njobs:").next().unwrap();
    if !begin.contains("\npermissions:\n  contents: read\n") {
        faults.push("the workflow as a whole may do more than read".to_owned());
    }
    faults
}

#[test]
fn workflows_run_scripts_of_the_repository_and_pinned_actions() {
    let mut steps = 0;
    for entry in fs::read_dir(root().join(".github/workflows")).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(faults(&text), [""; 0], "{}", path.display());
        steps += text.matches("uses: ").count() + text.matches("run: ").count();
    }
    assert!(steps > 20, "{steps}");
}

#[test]
fn a_step_that_nobody_else_can_run_is_found() {
    let workflow =
        |step: &str| format!("on: push\npermissions:\n  contents: read\n\njobs:\n      - {step}\n");
    let pinned = "uses: a/b@0123456789012345678901234567890123456789 # v1";
    assert_eq!(faults(&workflow(pinned)), [""; 0]);
    assert_eq!(faults(&workflow("run: .ci/run")), [""; 0]);
    assert_eq!(faults(&workflow("uses: a/b@v1 # v1")).len(), 1);
    assert_eq!(faults(&workflow("run: cargo test")).len(), 1);
    assert_eq!(faults(&workflow(pinned).replace("read", "write")).len(), 1);
}
