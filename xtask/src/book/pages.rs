//! Gathers the pages of the book, and the files that they show or link to, under the paths that they have in the
//! repository.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context as _, Result, ensure};

/// Copies the chapters that `book/SUMMARY.md` names to a folder, and what they link to.
pub(super) fn gather(root: &Path, folder: &Path) -> Result<()> {
    let summary = fs::read_to_string(root.join("book/SUMMARY.md")).context("cannot read book/SUMMARY.md")?;
    let chapters: BTreeSet<PathBuf> =
        links(&summary).into_iter().map(|(_, link)| PathBuf::from(link)).collect();
    write(&folder.join("SUMMARY.md"), index(&summary).as_bytes())?;
    let mut others = BTreeSet::new();
    for chapter in &chapters {
        let text = fs::read_to_string(root.join(chapter))
            .with_context(|| format!("book/SUMMARY.md names {}, which cannot be read", chapter.display()))?;
        let page = adapt(&text, chapter, &chapters, root, &mut others)?;
        write(&folder.join(index(&chapter.to_string_lossy())), page.as_bytes())?;
    }
    for other in others {
        let content =
            fs::read(root.join(&other)).with_context(|| format!("cannot read {}", other.display()))?;
        write(&folder.join(&other), &content)?;
    }
    Ok(())
}

fn write(file: &Path, content: &[u8]) -> Result<()> {
    let above = file.parent().context("a file has no folder")?;
    fs::create_dir_all(above).with_context(|| format!("cannot make {}", above.display()))?;
    fs::write(file, content).with_context(|| format!("cannot write {}", file.display()))
}

/// The name by which mdbook knows the front page of a folder.
fn index(text: &str) -> String {
    text.replace("README.md", "index.md")
}

/// The links and pictures of a page, with their places: `](link)` and `src="link"`, outside of fenced blocks.
fn links(text: &str) -> Vec<(usize, &str)> {
    let (mut found, mut start, mut is_fenced) = (Vec::new(), 0, false);
    for line in text.split_inclusive('\n') {
        is_fenced ^= line.starts_with("```");
        for (opens, closes) in [("](", ')'), ("src=\"", '"'), ("href=\"", '"')] {
            let mut from = 0;
            while let Some(at) = line[from..].find(opens).filter(|_| !is_fenced) {
                let begin = from + at + opens.len();
                let end = line[begin..].find(closes).map_or(line.len(), |length| begin + length);
                found.push((start + begin, &line[begin..end]));
                from = end;
            }
        }
        start += line.len();
    }
    found.sort_unstable();
    found
}

/// The page with links that lead somewhere within the book: a file that is not a chapter is copied into the
/// book with it, and a folder or a page of the repository that is not in the book is named instead.
fn adapt(
    text: &str,
    page: &Path,
    chapters: &BTreeSet<PathBuf>,
    root: &Path,
    others: &mut BTreeSet<PathBuf>,
) -> Result<String> {
    let (mut adapted, mut done) = (String::new(), 0);
    for (at, link) in links(text) {
        let (file, anchor) = link.split_once('#').map_or((link, None), |(file, anchor)| (file, Some(anchor)));
        if file.is_empty() || link.contains("://") || link.starts_with("mailto:") {
            continue;
        }
        let target = plain(&page.parent().unwrap_or(Path::new("")).join(file));
        let there = root.join(&target);
        ensure!(there.exists(), "{} links to {link}, which does not exist", page.display());
        adapted.push_str(&text[done..at]);
        done = at + link.len();
        let is_page = target.extension().is_some_and(|ending| ending == "md");
        if chapters.contains(&target) {
            adapted.push_str(&index(file));
            adapted.extend(anchor.map(|anchor| format!("#{anchor}")));
        } else if is_page || there.is_dir() || target.extension().is_none_or(|ending| ending == "rs") {
            unlink(&mut adapted, &target);
            done += 1;
        } else {
            adapted.push_str(link);
            others.insert(target);
        }
    }
    adapted.push_str(&text[done..]);
    Ok(adapted)
}

/// Turns the link whose `[text](` was just written into its text, with its target in brackets.
fn unlink(page: &mut String, target: &Path) {
    page.truncate(page.len() - "](".len());
    if let Some(open) = page.rfind('[') {
        page.remove(open);
        let path = target.display().to_string();
        if !page[open..].contains(&path) {
            page.push_str(&format!(" (`{path}`)"));
        }
    }
}

/// The path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(plain.pop()),
            Component::CurDir => {}
            part => plain.push(part),
        }
    }
    plain
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn links_are_found_outside_of_fenced_blocks() {
        let text = "[a](b.md#c) and ![d](e.svg)\n```\n[no](no.md)\n```\n<img src=\"f.png\">\n";
        let found: Vec<_> = links(text).into_iter().map(|(_, link)| link).collect();
        assert_eq!(found, ["b.md#c", "e.svg", "f.png"]);
    }

    #[test]
    fn links_lead_to_chapters_and_what_is_no_chapter_is_named() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let chapters = BTreeSet::from([PathBuf::from("docs/guide/README.md")]);
        let text = "[guide](guide/README.md#x), [build](../CONTRIBUTING.md), [case](../fixtures/pole.toml).";
        let mut others = BTreeSet::new();
        let page = adapt(text, Path::new("docs/theory.md"), &chapters, &root, &mut others).unwrap();
        assert_eq!(
            page,
            "[guide](guide/index.md#x), build (`CONTRIBUTING.md`), [case](../fixtures/pole.toml)."
        );
        assert_eq!(others, BTreeSet::from([PathBuf::from("fixtures/pole.toml")]));
        let dead = adapt("[no](no.md)", Path::new("docs/theory.md"), &chapters, &root, &mut others);
        assert!(dead.unwrap_err().to_string().contains("no.md"));
    }
}
