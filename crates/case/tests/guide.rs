//! The guide: its pieces of case files, and its links.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};

use case::{CaseFile, CaseProblem};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide")
}

/// The names and texts of the pages.
fn pages() -> Vec<(String, String)> {
    let mut pages: Vec<(String, String)> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "md"))
        .map(|path| {
            (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(&path).unwrap())
        })
        .collect();
    pages.sort();
    pages
}

/// The blocks of a page in this language.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let opening = format!("```{language}\n");
    page.split(&opening[..]).skip(1).map(|rest| rest.split("\n```").next().unwrap()).collect()
}

/// A piece of a case file may leave out keys of other topics. Its own content has to be right.
fn is_of_a_piece(problem: &CaseProblem) -> bool {
    matches!(
        problem,
        CaseProblem::MissingTable { .. }
            | CaseProblem::MissingKey { .. }
            | CaseProblem::MissingKeyOfLaw { .. }
    )
}

#[test]
fn every_piece_of_a_case_file_is_read() {
    let mut count = 0;
    for (name, page) in pages() {
        for block in blocks(&page, "toml") {
            if let Err(errors) = CaseFile::parse(&name, block) {
                for diagnostic in errors.list() {
                    assert!(is_of_a_piece(diagnostic.problem()), "{name}: {errors}");
                }
            }
            count += 1;
        }
    }
    assert!(count > 10, "the guide has only {count} pieces");
}

/// The tutorial's pieces are the paper's example, as the fixture has it.
#[test]
fn the_tutorial_writes_the_paper_s_example() {
    let page = fs::read_to_string(folder().join("tutorial.md")).unwrap();
    let text = blocks(&page, "toml")[..3].join("\n");
    let case = CaseFile::parse("tutorial.md", &text).unwrap_or_else(|errors| panic!("{errors}")).case;
    let fixture = fs::read_to_string(folder().join("../../fixtures/sae-980025.toml")).unwrap();
    let paper = CaseFile::parse("sae-980025.toml", &fixture).unwrap_or_else(|errors| panic!("{errors}")).case;
    assert_eq!(case.vehicles, paper.vehicles);
    assert_eq!((case.axes, case.impact, case.reconstruct), (paper.axes, paper.impact, paper.reconstruct));
}

/// As GitHub makes them of headings.
fn anchors(page: &str) -> Vec<String> {
    let heading = |line: &str| {
        let text = line.trim_start_matches('#').trim().to_lowercase();
        let kept = text.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    page.lines().filter(|line| line.starts_with('#')).map(heading).collect()
}

#[test]
fn every_link_leads_somewhere() {
    let mut count = 0;
    for (name, page) in pages() {
        for link in page.split("](").skip(1).map(|rest| rest.split(')').next().unwrap()) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { folder().join(&name) } else { folder().join(file) };
            assert!(target.exists(), "{name}: there is no {link}");
            if !anchor.is_empty() {
                let text = fs::read_to_string(&target).unwrap();
                assert!(anchors(&text).contains(&anchor.to_owned()), "{name}: there is no {link}");
            }
            count += 1;
        }
    }
    assert!(count > 20, "only {count} links");
}

#[test]
fn every_page_is_in_the_contents() {
    let pages = pages();
    let (_, contents) = pages.iter().find(|(name, _)| name == "README.md").unwrap();
    for (name, _) in pages.iter().filter(|(name, _)| name != "README.md") {
        assert!(contents.contains(&format!("]({name})")), "the contents lack {name}");
    }
}
