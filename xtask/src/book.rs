//! The book: the pages of the repository, as a site that can be searched. Nothing is written for it alone: the
//! chapters that `book/SUMMARY.md` names are gathered in a folder, and mdbook builds it.

mod links;
mod pages;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use crate::tools::{is_installed, run, say, target_folder};

/// What to do where mdbook is missing.
pub(crate) const HOW_TO_INSTALL: &str = "mdbook is not installed; `cargo install mdbook --locked --version 0.5.4 \
    --root target/mdbook` brings it into the folder where this task looks for it";

/// mdbook: as it was installed for this repository, or for this machine.
pub(crate) fn program(root: &Path) -> Option<PathBuf> {
    let own = target_folder(root).join("mdbook/bin").join(format!("mdbook{}", std::env::consts::EXE_SUFFIX));
    [own, PathBuf::from("mdbook")].into_iter().find(|program| is_installed(program))
}

/// Builds the book into a folder, and fails for a link that leads nowhere.
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
    let found = links::check(&out)?;
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
