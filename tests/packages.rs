//! Every crate can be published: its manifest describes it, and its package has all the files that it builds
//! from.
//!
//! `cargo package` builds the packages themselves, but takes minutes; `.ci/run` therefore packs without
//! building, and this test finds what a build would miss.

use std::fs;
use std::path::{Component, Path, PathBuf};

use serde_json::{Value, json};

use super::licences::packages;

/// The packages that are published.
fn published() -> Vec<Value> {
    packages()
        .into_iter()
        .filter(|package| package["source"].is_null() && package["publish"].is_null())
        .collect()
}

fn folder(package: &Value) -> PathBuf {
    Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap().to_owned()
}

/// All Rust files below a folder that a package ships: tests are excluded (`exclude` in its manifest).
fn shipped_code(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut files = Vec::new();
    for path in entries.map(|entry| entry.unwrap().path()) {
        if path.file_stem().is_some_and(|name| name == "tests") {
            continue;
        }
        if path.is_dir() {
            files.extend(shipped_code(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files
}

/// The paths in the `include_str!`, `include_bytes!` and `include!` of a file, from the folder of its
/// package. Additions by a macro are left out.
fn included(text: &str, file: &Path) -> Vec<PathBuf> {
    let opens = ["include_str!(", "include_bytes!(", "include!("];
    let after = opens.into_iter().flat_map(|open| text.split(open).skip(1));
    after
        .filter_map(|rest| match rest.trim_start().strip_prefix("concat!(env!(\"CARGO_MANIFEST_DIR\"),") {
            Some(rest) => Some(Path::new(rest.split('"').nth(1)?.trim_start_matches('/')).to_owned()),
            None => Some(file.parent()?.join(rest.split('"').nth(1)?)),
        })
        .collect()
}

/// The path without `.` and `..`, or `None` if it leads above its beginning.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir if plain.pop() => {}
            Component::Normal(name) => plain.push(name),
            _ => return None,
        }
    }
    Some(plain)
}

/// The includes of a file that a package would lack.
fn missing(text: &str, file: &Path, package: &Path) -> Vec<PathBuf> {
    let in_package = |path: &PathBuf| {
        plain(path).is_some_and(|path| !path.starts_with("tests") && package.join(path).exists())
    };
    included(text, file).into_iter().filter(|path| !in_package(path)).collect()
}

#[test]
fn what_a_package_builds_from_is_in_it() {
    let mut includes = 0;
    for package in published() {
        let folder = folder(&package);
        for file in ["src", "examples"].into_iter().flat_map(|part| shipped_code(&folder.join(part))) {
            let text = fs::read_to_string(&file).unwrap();
            let within = file.strip_prefix(&folder).unwrap();
            let missing = missing(&text, within, &folder);
            assert!(missing.is_empty(), "{} includes {missing:?}, which its package lacks", file.display());
            includes += included(&text, within).len();
        }
    }
    assert!(includes > 10, "only {includes} includes");
}

#[test]
fn an_include_that_a_package_lacks_is_found() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/case");
    let lacks = |text: &str, file: &str| !missing(text, Path::new(file), &package).is_empty();
    assert!(!lacks("include_str!(\"../sae-980025.toml\")", "src/lib.rs"));
    assert!(!lacks(
        "include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/src/units.md\"))",
        "src/units/table.rs"
    ));
    assert!(!lacks("include_str!(concat!(\"../templates/\", $file))", "src/template.rs"));
    assert!(lacks("include_str!(\"../../../fixtures/sae-980025.toml\")", "src/lib.rs"));
    assert!(lacks("include_str!(concat!(\"../../../fixtures/\", $file))", "src/lib.rs"));
    assert!(lacks("include_bytes!(\"../absent.bin\")", "src/lib.rs"));
    assert!(lacks("include!(\"../tests/main.rs\")", "src/lib.rs"));
}

/// The manifest format of cargo: a registry takes five keywords of twenty characters at most, and five
/// categories.
#[test]
fn every_package_says_what_it_is() {
    let packages = published();
    assert_eq!(packages.len(), 21, "crates of crates/");
    for package in packages {
        let name = package["name"].as_str().unwrap();
        let length = |key: &str| package[key].as_array().unwrap().len();
        assert!(name == "crash3" || name == "deltav" || name.starts_with("deltav-"), "{name} is hardly free");
        assert!(package["description"].as_str().is_some_and(|text| text.len() > 20), "{name}");
        assert!((1..=5).contains(&length("keywords")) && (1..=5).contains(&length("categories")), "{name}");
        for keyword in package["keywords"].as_array().unwrap() {
            let word = keyword.as_str().unwrap();
            let is_plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "_-+".contains(c));
            assert!(is_plain && (1..=20).contains(&word.len()), "{name}: {word}");
        }
        assert!(package["rust_version"].is_string(), "{name}");
        assert_eq!(package["readme"], "README.md", "{name}");
        let readme = fs::read_to_string(folder(&package).join("README.md")).unwrap();
        assert!(readme.starts_with(&format!("# {name}\n")), "{name}");
        for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let text = |path: PathBuf| fs::read_to_string(path).unwrap();
            let ours = text(folder(&package).join(licence));
            assert_eq!(ours, text(Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(licence)), "{name}");
        }
        // A path is for this repository, a version for the registry. Dependencies of tests need no version: a
        // package omits them.
        for dependency in package["dependencies"].as_array().unwrap() {
            let is_left_out = dependency["kind"] == "dev" && !dependency["path"].is_null();
            let has_version = dependency["req"] != "*";
            assert!(is_left_out || has_version, "{name} needs {} in any version", dependency["name"]);
        }
    }
}

/// The packages of this workspace that a package needs from the registry, for itself or for its tests.
fn named(package: &Value) -> Vec<&str> {
    let dependencies = package["dependencies"].as_array().unwrap().iter();
    let ours = dependencies.filter(|one| !one["path"].is_null() && one["req"] != "*");
    ours.map(|one| one["name"].as_str().unwrap()).collect()
}

/// The packages that cannot be published: those that need an unpublished one, or one that leads back to them.
fn unpublishable(packages: &[Value]) -> Vec<String> {
    let name = |package: &Value| package["name"].as_str().unwrap().to_owned();
    let mut found = Vec::new();
    for package in packages {
        let own = name(package);
        let (mut seen, mut open) = (vec![own.clone()], vec![package]);
        while let Some(one) = open.pop() {
            for other in named(one) {
                match packages.iter().find(|package| package["name"] == other) {
                    None => found.push(format!("{} needs {other}, which is not published", name(one))),
                    Some(_) if other == own => {
                        found.push(format!("{own} leads back to itself by {}", name(one)));
                    }
                    Some(_) if seen.iter().any(|name| name == other) => {}
                    Some(package) => {
                        seen.push(other.to_owned());
                        open.push(package);
                    }
                }
            }
        }
    }
    found
}

/// The registry accepts a package only if all its dependencies are there, including those of its tests.
#[test]
fn no_package_waits_for_itself() {
    assert_eq!(unpublishable(&published()), [""; 0]);
}

#[test]
fn a_package_that_waits_for_itself_is_found() {
    let package = |name: &str, other: &str, kind: Option<&str>, version: &str| {
        let dependency = json!({ "name": other, "kind": kind, "req": version, "path": "/there" });
        json!({ "name": name, "dependencies": [dependency] })
    };
    let upper = package("upper", "lower", None, "^0.1.0");
    let with = |lower: Value| unpublishable(&[upper.clone(), lower]).len();
    assert_eq!(with(package("lower", "upper", Some("dev"), "*")), 0);
    assert_eq!(with(package("lower", "upper", Some("dev"), "^0.1.0")), 2);
    assert_eq!(with(package("lower", "lower", Some("dev"), "^0.1.0")), 1);
    assert!(with(package("lower", "helpers", Some("dev"), "^0.1.0")) > 0);
}
