//! The book: the pages of the repository, as a site that can be searched. No page is written for it alone:
//! the chapters that `book/SUMMARY.md` names are gathered in a folder, and mdbook builds it.

mod links;
mod pages;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};
use serde_json::Value;

use crate::tools::{is_installed, run, say, target_folder};

/// The advice if mdbook is missing.
pub(crate) const HOW_TO_INSTALL: &str = "mdbook is not installed; `cargo install mdbook --locked --version 0.5.4 \
    --root target/mdbook` brings it into the folder where this task looks for it";

/// mdbook, installed for this repository or for this machine.
pub(crate) fn program(root: &Path) -> Option<PathBuf> {
    let own = target_folder(root).join("mdbook/bin").join(format!("mdbook{}", std::env::consts::EXE_SUFFIX));
    [own, PathBuf::from("mdbook")].into_iter().find(|program| is_installed(program))
}

/// The name of the page in the folder of the book.
const PAGE: &str = "deltav.html";

/// Puts the page next to the chapters, with a mark by which it links to them.
///
/// The page is one file that may be anywhere, and its security policy does not allow it to look for other
/// files: so it needs the mark.
pub(crate) fn add_page(folder: &Path, page: &Path) -> Result<()> {
    let text = fs::read_to_string(page).with_context(|| format!("cannot read {}", page.display()))?;
    let told = text.replacen(HEAD, &format!("{HEAD}<meta name=\"deltav-book\">"), 1);
    ensure!(told != text, "{} does not begin with {HEAD}", page.display());
    let copy = folder.join(PAGE);
    fs::write(&copy, told).with_context(|| format!("cannot write {}", copy.display()))
}

/// The declaration of the page's encoding; the mark is put after it.
const HEAD: &str = "<meta charset=\"utf-8\">";

/// All places of the book to which the page links.
fn links_of_page(root: &Path) -> Result<Vec<String>> {
    let file = root.join("web/src/chapters.json");
    let text = fs::read_to_string(&file).with_context(|| format!("cannot read {}", file.display()))?;
    let chapters = serde_json::from_str(&text).with_context(|| format!("{} is no JSON", file.display()))?;
    Ok(texts(&chapters))
}

/// All texts of a document that are not keys.
fn texts(document: &Value) -> Vec<String> {
    match document {
        Value::String(text) => vec![text.clone()],
        Value::Object(entries) => entries.values().flat_map(texts).collect(),
        _ => Vec::new(),
    }
}

/// Builds the book into a folder, and fails for a link that leads nowhere, be it one of the page.
pub(crate) fn build(root: &Path, out: Option<&Path>) -> Result<()> {
    let mdbook = program(root).context(HOW_TO_INSTALL)?;
    let root = &root.canonicalize().context("cannot find the repository")?;
    let folder = std::path::absolute(target_folder(root).join("book"))?;
    let out = out.map_or_else(|| Ok(folder.join("html")), std::path::absolute)?;
    let source = folder.join("src");
    if source.exists() {
        fs::remove_dir_all(&source).with_context(|| format!("cannot empty {}", source.display()))?;
    }
    pages::gather(root, &source)?;
    fs::copy(root.join("book/book.toml"), folder.join("book.toml")).context("cannot copy book/book.toml")?;
    run(Command::new(mdbook).arg("build").arg(&folder).arg("--dest-dir").arg(&out))?;
    let found = links::check(&out, &[(out.join(PAGE), links_of_page(root)?)])?;
    for dead in &found.dead {
        say(&format!("dead link: {dead}"))?;
    }
    ensure!(found.dead.is_empty(), "the book has {} dead links", found.dead.len());
    say(&format!(
        "{} pages, {} links, none dead: {}",
        found.pages,
        found.links,
        out.join("index.html").display()
    ))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_told_that_it_lies_in_the_book() {
        let folder = std::env::temp_dir().join(format!("deltav-page-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        add_page(&folder, &root.join("web/index.html")).unwrap();
        let copy = fs::read_to_string(folder.join(PAGE)).unwrap();
        fs::write(folder.join("none.html"), "<html>").unwrap();
        let refused = add_page(&folder, &folder.join("none.html"));
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(copy.matches("<meta name=\"deltav-book\">").count(), 1);
        assert!(refused.is_err());
    }

    #[test]
    fn the_page_has_links_into_the_book() {
        let links = links_of_page(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).unwrap();
        assert!(links.contains(&"docs/guide/avoid.html#sight".to_owned()), "{links:?}");
    }
}
