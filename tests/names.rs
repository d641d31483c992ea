//! A type has one name in the workspace: no two crates have a public type of the same name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The public types of a file, by name: those of the file itself, and of the macro `choices!`.
fn types(text: &str) -> impl Iterator<Item = &str> {
    let mut is_in_choices = false;
    let declared = text.lines().filter_map(move |line| {
        is_in_choices = line == "choices! {" || is_in_choices && line != "}";
        let line = if is_in_choices { line.strip_prefix("    ").unwrap_or(line) } else { line };
        let kinds = ["pub struct ", "pub enum ", "pub trait ", "pub type ", "pub union "];
        kinds.into_iter().find_map(|kind| line.strip_prefix(kind))
    });
    declared.filter_map(|rest| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next())
}

fn sources(folder: &Path, named: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, named);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            named.extend(types(&fs::read_to_string(&path).unwrap()).map(str::to_owned));
        }
    }
}

/// The names that exist in several crates, with the crates.
fn shared(crates: &BTreeMap<String, BTreeSet<String>>) -> BTreeMap<String, Vec<String>> {
    let mut homes: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (home, names) in crates {
        for name in names {
            homes.entry(name.clone()).or_default().push(home.clone());
        }
    }
    homes.retain(|_, homes| homes.len() > 1);
    homes
}

#[test]
fn a_type_has_one_name_in_the_workspace() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut crates = BTreeMap::new();
    for entry in fs::read_dir(root).unwrap() {
        let folder = entry.unwrap().path();
        let home = folder.file_name().unwrap().to_str().unwrap().to_owned();
        // The types of a program are not used elsewhere.
        if folder.join("src/lib.rs").exists() {
            let mut names = BTreeSet::new();
            sources(&folder.join("src"), &mut names);
            crates.insert(home, names);
        }
    }
    assert!(crates.values().map(BTreeSet::len).sum::<usize>() > 300);
    let shared = shared(&crates);
    assert!(shared.is_empty(), "name these by what they are of: {shared:#?}");
}

#[test]
fn a_second_type_of_a_name_is_found() {
    let of = |text: &str| -> BTreeSet<String> { types(text).map(str::to_owned).collect() };
    let one =
        of("pub struct Zone<T = f64> {\npub(crate) struct Row;\n    pub enum Inner {}\npub fn zone() {}\n");
    assert_eq!(one.iter().collect::<Vec<_>>(), ["Zone"]);
    let other =
        of("choices! {\n    pub enum Zone {\n    }\n}\npub trait Named: Sync {\n    pub enum Inner {}\n");
    assert_eq!(other.iter().collect::<Vec<_>>(), ["Named", "Zone"]);
    let crates = [("a".to_owned(), one), ("b".to_owned(), other)].into();
    assert_eq!(
        shared(&crates).into_iter().collect::<Vec<_>>(),
        [("Zone".to_owned(), vec!["a".into(), "b".into()])]
    );
}
