//! Every dependency that is built here has a licence that `deny.toml` allows, and comes from crates.io.
//!
//! cargo-deny checks all platforms and more, but must be installed; this test needs only cargo.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use toml::de::{DeTable, DeValue};

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn allowed() -> BTreeSet<String> {
    let text = fs::read_to_string(root().join("deny.toml")).unwrap();
    let table = DeTable::parse(&text).unwrap();
    let licences = table.get_ref()["licenses"].get_ref().as_table().unwrap();
    let list = licences["allow"].get_ref().as_array().unwrap();
    let name = |value: &DeValue<'_>| value.as_str().unwrap().to_owned();
    list.iter().map(|value| name(value.get_ref())).collect()
}

/// The packages that are built here. Those of other platforms and features need not have been downloaded.
pub(crate) fn packages() -> Vec<Value> {
    let rustc = Command::new("rustc").arg("-vV").output().unwrap();
    let version = String::from_utf8_lossy(&rustc.stdout).into_owned();
    let host = version.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked", "--offline", "--filter-platform", host])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

/// The packages that are built here and do not belong to this workspace.
fn dependencies() -> Vec<Value> {
    packages().into_iter().filter(|package| !package["source"].is_null()).collect()
}

/// The licences chosen from an SPDX expression: those of the first alternative that is wholly allowed. The
/// old "MIT/Apache-2.0" is a choice.
fn chosen(expression: &str, allowed: &BTreeSet<String>) -> Option<Vec<String>> {
    let spaced =
        expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ").replace(" or ", " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let (licences, rest) = any(&words, allowed);
    assert_eq!(rest, [""; 0], "\"{expression}\" is no SPDX expression that this test can read");
    licences
}

type Choice<'a, 'w> = (Option<Vec<String>>, &'a [&'w str]);

fn any<'a, 'w>(words: &'a [&'w str], allowed: &BTreeSet<String>) -> Choice<'a, 'w> {
    let (mut first, mut rest) = all(words, allowed);
    while let ["OR", tail @ ..] = rest {
        let (next, after) = all(tail, allowed);
        (first, rest) = (first.or(next), after);
    }
    (first, rest)
}

fn all<'a, 'w>(words: &'a [&'w str], allowed: &BTreeSet<String>) -> Choice<'a, 'w> {
    let (mut first, mut rest) = one(words, allowed);
    while let ["AND", tail @ ..] = rest {
        let (next, after) = one(tail, allowed);
        first = first.zip(next).map(|(first, next)| [first, next].concat());
        rest = after;
    }
    (first, rest)
}

fn one<'a, 'w>(words: &'a [&'w str], allowed: &BTreeSet<String>) -> Choice<'a, 'w> {
    let of = |name: String| allowed.contains(&name).then(|| vec![name]);
    match words {
        ["(", tail @ ..] => match any(tail, allowed) {
            (inner, [")", rest @ ..]) => (inner, rest),
            (_, rest) => panic!("a parenthesis is open before {rest:?}"),
        },
        [licence, "WITH", exception, rest @ ..] => (of(format!("{licence} WITH {exception}")), rest),
        [licence, rest @ ..] => (of((*licence).to_owned()), rest),
        [] => panic!("a licence is missing at the end"),
    }
}

#[test]
fn every_dependency_has_an_allowed_licence() {
    let allowed = allowed();
    let mut used = BTreeSet::new();
    let mut refused = Vec::new();
    let dependencies = dependencies();
    assert!(dependencies.len() > 100, "only {} dependencies", dependencies.len());
    for package in &dependencies {
        let licence = package["license"].as_str();
        match licence.and_then(|licence| chosen(licence, &allowed)) {
            Some(licences) => used.extend(licences),
            None => refused.push(format!("{} {}: {licence:?}", package["name"], package["version"])),
        }
    }
    assert!(refused.is_empty(), "not allowed by deny.toml:\n{}", refused.join("\n"));
    assert!(used.is_subset(&allowed));
}

#[test]
fn the_workspace_has_the_customary_licence() {
    for package in packages().iter().filter(|package| package["source"].is_null()) {
        assert_eq!(package["license"], "MIT OR Apache-2.0", "{}", package["name"]);
    }
    let text = |name: &str| fs::read_to_string(root().join(name)).unwrap();
    assert!(text("LICENSE-MIT").contains("Copyright (c) 2026 The deltav developers\n"));
    let apache = text("LICENSE-APACHE");
    assert!(apache.contains("Version 2.0, January 2004") && apache.contains("END OF TERMS AND CONDITIONS"));
}

#[test]
fn every_dependency_comes_from_crates_io() {
    for package in dependencies() {
        let source = package["source"].as_str().unwrap();
        assert!(source.starts_with("registry+") && source.ends_with("/crates.io-index"), "{source}");
    }
}

/// SPDX specification, annex "license expressions": AND binds more strongly than OR.
#[test]
fn a_choice_of_licences_is_judged_as_spdx_says() {
    let allowed = BTreeSet::from(["MIT".to_owned(), "Zlib".to_owned()]);
    for (expression, accepted) in [
        ("MIT", true),
        ("GPL-3.0-only", false),
        ("GPL-3.0-only OR MIT", true),
        ("GPL-3.0-only/MIT", true),
        ("MIT AND Zlib", true),
        ("MIT AND GPL-3.0-only", false),
        ("(GPL-3.0-only OR MIT) AND Zlib", true),
        ("(GPL-3.0-only OR MIT) AND Unicode-3.0", false),
        ("MIT OR GPL-3.0-only AND Unicode-3.0", true),
        ("GPL-3.0-only AND Unicode-3.0 OR MIT", true),
        ("MIT WITH LLVM-exception", false),
    ] {
        assert_eq!(chosen(expression, &allowed).is_some(), accepted, "{expression}");
    }
}
