//! The pages, and their text outside of fenced blocks.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the repository.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A page of Markdown.
pub(crate) struct Page {
    /// From the root of the repository, with slashes.
    pub(crate) name: String,
    /// As it was written.
    pub(crate) text: String,
}

/// The page of this name.
pub(crate) fn page(name: &str) -> Page {
    let text = fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    Page { name: name.to_owned(), text }
}

/// The README, and the pages of these folders.
pub(crate) fn pages(folders: &[&str]) -> Vec<Page> {
    let mut pages = vec![page("README.md")];
    for folder in folders {
        let mut names: Vec<String> = fs::read_dir(root().join(folder))
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.ends_with(".md"))
            .collect();
        names.sort();
        pages.extend(names.iter().map(|name| page(&format!("{folder}/{name}"))));
    }
    pages
}

impl Page {
    /// The lines outside of fenced blocks.
    pub(crate) fn unfenced(&self) -> Vec<&str> {
        let mut fenced = false;
        let outside = |line: &&str| {
            let fence = line.starts_with("```");
            fenced ^= fence;
            !fenced && !fence
        };
        self.text.lines().filter(outside).collect()
    }

    /// The lines of the fenced blocks in this language.
    pub(crate) fn fenced(&self, language: &str) -> Vec<&str> {
        let mut inside = None;
        let mut lines = Vec::new();
        for line in self.text.lines() {
            match (line.strip_prefix("```"), inside) {
                (Some(language), None) => inside = Some(language),
                (Some(_), Some(_)) => inside = None,
                (None, Some(of)) if of == language => lines.push(line),
                (None, _) => {}
            }
        }
        lines
    }

    /// The texts between backticks, with a space for each line break.
    pub(crate) fn inline_code(&self) -> Vec<String> {
        let text = self.unfenced().join(" ");
        text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
    }
}
