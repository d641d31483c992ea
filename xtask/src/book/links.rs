//! The links of the built book: each leads to a file that is there and, with `#`, to a place in it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context as _, Result};

/// The result of checking the links of a folder.
#[derive(Debug)]
pub(super) struct Found {
    /// The number of pages.
    pub(super) pages: usize,
    /// The number of links within the book.
    pub(super) links: usize,
    /// The links that lead nowhere, each with its page.
    pub(super) dead: Vec<String>,
}

/// Reads all pages below a folder, and follows their links within it, and those of `others`, pages that are
/// not read. Links to other sites are not followed.
pub(super) fn check(folder: &Path, others: &[(PathBuf, Vec<String>)]) -> Result<Found> {
    let mut pages = BTreeMap::new();
    read(folder, &mut pages)?;
    let places: BTreeMap<&PathBuf, BTreeSet<&str>> =
        pages.iter().map(|(path, text)| (path, values(text, "id").into_iter().collect())).collect();
    let mut found = Found { pages: pages.len(), links: 0, dead: Vec::new() };
    let own = pages.iter().map(|(path, text)| {
        (path, values(text, "href").into_iter().chain(values(text, "src")).collect::<Vec<_>>())
    });
    let told = others.iter().map(|(path, links)| (path, links.iter().map(String::as_str).collect()));
    for (path, all) in own.chain(told) {
        for link in all.into_iter().filter(|link| !is_elsewhere(link)) {
            found.links += 1;
            let (file, place) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { path.clone() } else { beside(path, file) };
            let has_place = |place: &str| {
                let decoded = decoded(place);
                places.get(&target).is_none_or(|ids| ids.contains(decoded.as_str()))
            };
            if !target.is_file() || !(place.is_empty() || has_place(place)) {
                found.dead.push(format!("{} in {}", link, path.display()));
            }
        }
    }
    Ok(found)
}

fn read(folder: &Path, pages: &mut BTreeMap<PathBuf, String>) -> Result<()> {
    let cannot = || format!("cannot read {}", folder.display());
    for entry in fs::read_dir(folder).with_context(cannot)? {
        let path = entry.with_context(cannot)?.path();
        if path.is_dir() {
            read(&path, pages)?;
        } else if path.extension().is_some_and(|ending| ending == "html") {
            let text =
                fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
            pages.insert(path, text);
        }
    }
    Ok(())
}

/// The values of an attribute. mdbook quotes all of them.
fn values<'a>(text: &'a str, attribute: &str) -> Vec<&'a str> {
    let opens = format!(" {attribute}=\"");
    text.split(opens.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

fn is_elsewhere(link: &str) -> bool {
    link.is_empty()
        || link.contains("://")
        || ["mailto:", "data:", "javascript:"].iter().any(|one| link.starts_with(one))
}

fn beside(page: &Path, file: &str) -> PathBuf {
    let mut path = page.parent().unwrap_or(Path::new("")).to_owned();
    for part in Path::new(&decoded(file)).components() {
        match part {
            Component::ParentDir => drop(path.pop()),
            Component::CurDir => {}
            part => path.push(part),
        }
    }
    path
}

/// A link without its escapes: `%C3%A4` is ä.
fn decoded(link: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = link.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = after.get(..2).and_then(|two| str::from_utf8(two).ok());
        let code = code.and_then(|two| u8::from_str_radix(two, 16).ok());
        match code.filter(|_| first == b'%') {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn a_link_to_no_file_or_to_no_place_is_dead() {
        let folder = std::env::temp_dir().join(format!("deltav-links-{}", std::process::id()));
        fs::create_dir_all(folder.join("a")).unwrap();
        let page = "<h1 id=\"ä\"></h1><a href=\"#%C3%A4\"></a><a href=\"../b.html#here\"></a>\
            <a href=\"../b.html#gone\"></a><a href=\"../c.html\"></a><a href=\"https://x.org/none\"></a>";
        fs::write(folder.join("a/a.html"), page).unwrap();
        fs::write(folder.join("b.html"), "<p id=\"here\">").unwrap();
        let others = ["b.html#here", "b.html#there"].map(str::to_owned).to_vec();
        let found = check(&folder, &[(folder.join("unread.html"), others)]).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!((found.pages, found.links), (2, 6));
        let links: Vec<_> = found.dead.iter().map(|dead| dead.split(' ').next().unwrap()).collect();
        assert_eq!(links, ["../b.html#gone", "../c.html", "b.html#there"]);
    }
}
