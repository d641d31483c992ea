//! No package of a lock file has a version with a known security advisory, unless `deny.toml` accepts it.
//!
//! `cargo deny check advisories` uses the newest database, but needs cargo-deny and the network; this test
//! uses the facts in `tests/advisories.toml`. From a copy of <https://github.com/RustSec/advisory-db>,
//! `ADVISORY_DB=/path/to/advisory-db cargo test -p deltav-tests advisories` rewrites that file; without a
//! copy, facts may be added by hand, and `UPDATE=1` formats them.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use semver::{Version, VersionReq};
use toml::de::{DeTable, DeValue};

const HEAD: &str = "\
# The security advisories of the packages in Cargo.lock and fuzz/Cargo.lock: facts from https://rustsec.org
# (https://github.com/RustSec/advisory-db), which are in the public domain (CC0-1.0). tests/advisories.rs
# judges the locked versions by them, and writes this file: see CONTRIBUTING.md.

# The date of the newest advisory in the copy of the database that was read.
";

/// An entry of the database about versions of one package.
#[derive(Debug, Clone, PartialEq)]
struct Advisory {
    id: String,
    package: String,
    date: String,
    /// `vulnerability`, `unsound`, `unmaintained` or `notice`.
    kind: String,
    withdrawn: Option<String>,
    patched: Vec<String>,
    unaffected: Vec<String>,
}

impl Advisory {
    /// Whether this version is affected. A pre-release, such as 2.0.0-rc.1, satisfies only a requirement that
    /// names a pre-release of the same version, as everywhere in Cargo: `>= 1.0.0` does not match it.
    fn affects(&self, version: &Version) -> bool {
        let any = |list: &[String]| {
            list.iter().any(|text| {
                let requirement = VersionReq::parse(text).map_err(|e| format!("{}: {text}: {e}", self.id));
                requirement.unwrap().matches(version)
            })
        };
        self.withdrawn.is_none() && !any(&self.patched) && !any(&self.unaffected)
    }
}

/// The facts of `tests/advisories.toml`.
#[derive(Debug, PartialEq)]
struct Known {
    /// The date of the newest advisory in the copy of the database.
    newest: String,
    /// The packages looked up, with or without advisories.
    packages: BTreeSet<String>,
    /// The packages for which no copy of the database was at hand: only `cargo deny` checks them.
    not_looked_up: BTreeSet<String>,
    advisories: Vec<Advisory>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// `tests/advisories.toml`, rewritten on request.
static FACTS: LazyLock<String> = LazyLock::new(|| {
    let path = "tests/advisories.toml";
    let new = if let Some(database) = std::env::var_os("ADVISORY_DB") {
        let names = packages().into_iter().map(|(name, _)| name).collect();
        Some(looked_up(Path::new(&database), names))
    } else {
        std::env::var_os("UPDATE").map(|_| known(&read(path)))
    };
    if let Some(new) = new {
        fs::write(root().join(path), written(&new)).unwrap();
    }
    read(path)
});

fn word(table: &DeTable<'_>, key: &str) -> Option<String> {
    table.get(key).map(|value| value.get_ref().as_str().unwrap().to_owned())
}

fn words(table: &DeTable<'_>, key: &str) -> Vec<String> {
    let Some(value) = table.get(key) else {
        return Vec::new();
    };
    let words = value.get_ref().as_array().unwrap().iter();
    words.map(|word| word.get_ref().as_str().unwrap().to_owned()).collect()
}

/// The tables of an array of tables, which may be missing.
fn tables<'t, 'a>(table: &'t DeTable<'a>, key: &str) -> Vec<&'t DeTable<'a>> {
    let array = table.get(key).map(|value| value.get_ref().as_array().unwrap());
    array
        .into_iter()
        .flat_map(|array| array.iter().map(|entry| entry.get_ref().as_table().unwrap()))
        .collect()
}

fn known(text: &str) -> Known {
    let table = DeTable::parse(text).unwrap();
    let table = table.get_ref();
    let advisory = |entry: &DeTable<'_>| Advisory {
        id: word(entry, "id").unwrap(),
        package: word(entry, "package").unwrap(),
        date: word(entry, "date").unwrap(),
        kind: word(entry, "kind").unwrap(),
        withdrawn: word(entry, "withdrawn"),
        patched: words(entry, "patched"),
        unaffected: words(entry, "unaffected"),
    };
    Known {
        newest: word(table, "newest").unwrap(),
        packages: words(table, "packages").into_iter().collect(),
        not_looked_up: words(table, "not_looked_up").into_iter().collect(),
        advisories: in_order(tables(table, "advisory").into_iter().map(advisory).collect()),
    }
}

fn in_order(mut advisories: Vec<Advisory>) -> Vec<Advisory> {
    advisories.sort_by(|a, b| (&a.package, &a.id).cmp(&(&b.package, &b.id)));
    advisories
}

/// `tests/advisories.toml` with these facts.
fn written(known: &Known) -> String {
    let list = |words: &[String]| {
        let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
        format!("[{}]", quoted.join(", "))
    };
    let mut text =
        format!("{HEAD}newest = \"{}\"\n\n# Looked up, with advisories or without.\n", known.newest);
    text.push_str("packages = [");
    let mut column = usize::MAX;
    for package in &known.packages {
        // Two names in a line are separated by a comma and a space.
        column = column.saturating_add(package.len() + 4);
        if column > 100 {
            text.push_str("\n    ");
            column = package.len() + 4;
        } else {
            text.push(' ');
        }
        write!(text, "\"{package}\",").unwrap();
    }
    text.push_str("\n]\n");
    if !known.not_looked_up.is_empty() {
        let names: Vec<String> = known.not_looked_up.iter().cloned().collect();
        writeln!(
            text,
            "\n# No copy of the database was at hand when they were added; `cargo deny` alone judges them.\n\
             not_looked_up = {}",
            list(&names)
        )
        .unwrap();
    }
    for advisory in &known.advisories {
        let Advisory { id, package, date, kind, withdrawn, patched, unaffected } = advisory;
        write!(text, "\n[[advisory]]\nid = \"{id}\"\npackage = \"{package}\"\n").unwrap();
        write!(text, "date = \"{date}\"\nkind = \"{kind}\"\n").unwrap();
        if let Some(date) = withdrawn {
            writeln!(text, "withdrawn = \"{date}\"").unwrap();
        }
        writeln!(text, "patched = {}\nunaffected = {}", list(patched), list(unaffected)).unwrap();
    }
    text
}

/// An advisory of the database, which is a page with a TOML header.
fn page(text: &str) -> Advisory {
    let head = text.trim_start().strip_prefix("```toml").and_then(|rest| rest.split_once("\n```"));
    let (head, _) = head.unwrap_or_else(|| panic!("no head in TOML:\n{text}"));
    let table = DeTable::parse(head).unwrap();
    let part = |key: &str| table.get_ref()[key].get_ref().as_table().unwrap();
    let (advisory, versions) = (part("advisory"), part("versions"));
    Advisory {
        id: word(advisory, "id").unwrap(),
        package: word(advisory, "package").unwrap(),
        date: word(advisory, "date").unwrap(),
        kind: word(advisory, "informational").unwrap_or_else(|| "vulnerability".to_owned()),
        withdrawn: word(advisory, "withdrawn"),
        patched: words(versions, "patched"),
        unaffected: words(versions, "unaffected"),
    }
}

/// The entries of a copy of the database about these packages.
fn looked_up(database: &Path, packages: BTreeSet<String>) -> Known {
    let entries = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        entries.map(|entry| entry.unwrap().path()).collect()
    };
    let folders = entries(&database.join("crates"));
    let pages = folders.iter().flat_map(|folder| entries(folder)).filter(|path| {
        // An advisory without a number is only proposed.
        path.extension() == Some(OsStr::new("md"))
            && path.file_stem() != Some(OsStr::new("RUSTSEC-0000-0000"))
    });
    let all: Vec<Advisory> = pages.map(|path| page(&fs::read_to_string(path).unwrap())).collect();
    let newest = all.iter().map(|advisory| advisory.date.clone()).max().unwrap();
    let ours = all.into_iter().filter(|advisory| packages.contains(&advisory.package)).collect();
    Known { newest, advisories: in_order(ours), packages, not_looked_up: BTreeSet::new() }
}

/// The external packages of a lock file.
fn locked(text: &str) -> BTreeSet<(String, Version)> {
    let table = DeTable::parse(text).unwrap();
    let packages = tables(table.get_ref(), "package").into_iter();
    let outside = packages.filter(|package| package.contains_key("source"));
    outside
        .map(|package| {
            let version = Version::parse(&word(package, "version").unwrap()).unwrap();
            (word(package, "name").unwrap(), version)
        })
        .collect()
}

/// The external packages of all lock files.
fn packages() -> BTreeSet<(String, Version)> {
    let mut packages = BTreeSet::new();
    for file in ["Cargo.lock", "fuzz/Cargo.lock"] {
        let locked = locked(&read(file));
        assert!(locked.len() > 100, "{file} has only {} packages from elsewhere", locked.len());
        packages.extend(locked);
    }
    packages
}

/// The advisories that a `deny.toml` accepts, with the reasons.
fn accepted(text: &str) -> BTreeMap<String, String> {
    let table = DeTable::parse(text).unwrap();
    let advisories = table.get_ref()["advisories"].get_ref().as_table().unwrap();
    let list = advisories["ignore"].get_ref().as_array().unwrap();
    let entry = |value: &DeValue<'_>| {
        let entry = value.as_table().expect("write { id = \"RUSTSEC-…\", reason = \"…\" }");
        (word(entry, "id").unwrap(), word(entry, "reason").unwrap_or_default())
    };
    list.iter().map(|value| entry(value.get_ref())).collect()
}

/// The complaints about these packages, a sentence each.
fn complaints(
    packages: &BTreeSet<(String, Version)>,
    known: &Known,
    accepted: &BTreeMap<String, String>,
) -> Vec<String> {
    let mut complaints = Vec::new();
    let mut needed = BTreeSet::new();
    for (name, version) in packages {
        if !known.packages.contains(name) && !known.not_looked_up.contains(name) {
            complaints.push(format!(
                "{name}: nobody has looked for its advisories; CONTRIBUTING.md says how to renew \
                 tests/advisories.toml"
            ));
        }
        for advisory in known.advisories.iter().filter(|advisory| advisory.package == *name) {
            if !advisory.affects(version) {
                continue;
            }
            let Advisory { id, kind, patched, .. } = advisory;
            needed.insert(id.as_str());
            if !accepted.contains_key(id) {
                complaints.push(format!(
                    "{name} {version}: {id} ({kind}), patched: {patched:?}; take a patched version, or accept \
                     it in deny.toml with a reason. https://rustsec.org/advisories/{id}.html"
                ));
            }
        }
    }
    for name in &known.not_looked_up {
        if known.packages.contains(name) || !packages.iter().any(|(locked, _)| locked == name) {
            complaints.push(format!("tests/advisories.toml has {name} in not_looked_up: take it out"));
        }
    }
    for (id, reason) in accepted {
        if !needed.contains(id.as_str()) {
            complaints.push(format!("deny.toml accepts {id}, which affects nothing here: take it out"));
        }
        if reason.trim().is_empty() {
            complaints.push(format!("deny.toml accepts {id} without a reason: give one"));
        }
    }
    complaints
}

#[test]
fn no_locked_version_has_an_advisory() {
    let complaints = complaints(&packages(), &known(&FACTS), &accepted(&read("deny.toml")));
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn the_facts_are_as_they_are_written() {
    let known = known(&FACTS);
    assert_eq!(written(&known), *FACTS, "UPDATE=1 lays tests/advisories.toml out");
    assert!(known.advisories.len() >= 50, "only {} advisories", known.advisories.len());
    for advisory in &known.advisories {
        let Advisory { id, package, date, kind, patched, unaffected, .. } = advisory;
        assert!(id.starts_with("RUSTSEC-20") && id.len() == 17, "{id}");
        assert!(known.packages.contains(package), "{id}: {package} was not looked up");
        assert!(*date <= known.newest, "{id} is newer than {}", known.newest);
        assert!(
            ["vulnerability", "unsound", "unmaintained", "notice"].contains(&kind.as_str()),
            "{id}: {kind}"
        );
        for text in patched.iter().chain(unaffected) {
            assert!(VersionReq::parse(text).is_ok(), "{id}: {text}");
        }
    }
}

fn made_up(withdrawn: Option<&str>, patched: &[&str], unaffected: &[&str]) -> Advisory {
    let list = |words: &[&str]| words.iter().map(|&word| word.to_owned()).collect();
    Advisory {
        id: "RUSTSEC-2026-9999".to_owned(),
        package: "made-up".to_owned(),
        date: "2026-01-31".to_owned(),
        kind: "vulnerability".to_owned(),
        withdrawn: withdrawn.map(str::to_owned),
        patched: list(patched),
        unaffected: list(unaffected),
    }
}

/// The pattern of the database's own example: a fault introduced in 0.2 and fixed in 1.2.3, reintroduced in
/// 1.3.0 and fixed in 1.3.4.
#[test]
fn a_version_is_affected_unless_it_is_patched_or_never_was() {
    let advisory = made_up(None, &[">= 1.2.3, < 1.3.0", ">= 1.3.4"], &["<= 0.1.2"]);
    for (version, affected) in [
        ("0.1.0", false),
        ("0.1.2", false),
        ("0.1.3", true),
        ("1.2.2", true),
        ("1.2.3", false),
        ("1.2.99", false),
        ("1.3.0", true),
        ("1.3.3", true),
        ("1.3.4", false),
        ("1.3.4+build.7", false),
        ("2.0.0", false),
        // Older than the patch.
        ("1.3.4-rc.1", true),
        // No requirement names a pre-release of this version.
        ("2.0.0-rc.1", true),
    ] {
        assert_eq!(advisory.affects(&Version::parse(version).unwrap()), affected, "{version}");
    }
    let of = |patched: &[&str], version: &str| {
        made_up(None, patched, &[]).affects(&Version::parse(version).unwrap())
    };
    assert!(of(&[], "99.0.0"), "nothing is patched");
    assert!(of(&["^0.20.2"], "0.21.0") && !of(&["^0.20.2"], "0.20.3"));
    assert!(of(&[">= 2.0.0-rc.2"], "2.0.0-rc.1") && !of(&[">= 2.0.0-rc.2"], "2.0.0-rc.3"));
    assert!(!made_up(Some("2026-02-28"), &[], &[]).affects(&Version::new(1, 0, 0)), "it was withdrawn");
}

#[test]
fn each_lapse_is_told() {
    let known = Known {
        newest: "2026-01-31".to_owned(),
        packages: ["made-up", "harmless"].map(str::to_owned).into(),
        not_looked_up: BTreeSet::new(),
        advisories: vec![made_up(None, &[">= 1.2.3"], &[])],
    };
    let told = |packages: &[(&str, &str)], accepted: &[(&str, &str)]| {
        let packages = packages
            .iter()
            .map(|&(name, version)| (name.to_owned(), Version::parse(version).unwrap()))
            .collect();
        let accepted = accepted.iter().map(|&(id, reason)| (id.to_owned(), reason.to_owned())).collect();
        complaints(&packages, &known, &accepted)
    };
    let id = "RUSTSEC-2026-9999";
    let one = |told: Vec<String>, with: &str| assert!(told.len() == 1 && told[0].contains(with), "{told:#?}");
    assert_eq!(told(&[("made-up", "1.2.3"), ("harmless", "0.0.1")], &[]), [""; 0]);
    one(told(&[("made-up", "1.2.2")], &[]), "made-up 1.2.2: RUSTSEC-2026-9999 (vulnerability)");
    // Both versions of a package are checked.
    one(told(&[("made-up", "1.2.2"), ("made-up", "1.2.3")], &[]), "made-up 1.2.2");
    assert_eq!(told(&[("made-up", "1.2.2")], &[(id, "is not called")]), [""; 0]);
    one(told(&[("made-up", "1.2.2")], &[(id, " ")]), "without a reason");
    one(told(&[("made-up", "1.2.3")], &[(id, "is not called")]), "affects nothing here");
    one(told(&[("unknown", "1.0.0")], &[]), "unknown: nobody has looked");
    // A package listed as not looked up is reported once it has been looked up, or is gone.
    let of = |listed: &str, packages: [(&str, &str); 1]| {
        let known = Known {
            newest: known.newest.clone(),
            packages: known.packages.clone(),
            not_looked_up: [listed.to_owned()].into(),
            advisories: Vec::new(),
        };
        let packages = packages.map(|(name, version)| (name.to_owned(), Version::parse(version).unwrap()));
        complaints(&packages.into(), &known, &BTreeMap::new())
    };
    assert_eq!(of("unknown", [("unknown", "1.0.0")]), [""; 0]);
    one(of("unknown", [("made-up", "1.2.3")]), "unknown in not_looked_up: take it out");
    one(of("made-up", [("made-up", "1.2.3")]), "made-up in not_looked_up: take it out");
}

#[test]
fn files_are_read_as_they_are_meant() {
    let lock = "[[package]]\nname = \"here\"\nversion = \"0.1.0\"\n\n[[package]]\nname = \"there\"\n\
                version = \"1.2.1+spec\"\nsource = \"registry+https://github.com/rust-lang/crates.io-index\"\n";
    let there = ("there".to_owned(), Version::parse("1.2.1+spec").unwrap());
    assert_eq!(locked(lock), BTreeSet::from([there]));

    let deny = "[advisories]\nignore = [{ id = \"RUSTSEC-2026-9999\", reason = \"is not called\" }]\n";
    let reason = ("RUSTSEC-2026-9999".to_owned(), "is not called".to_owned());
    assert_eq!(accepted(deny), BTreeMap::from([reason]));

    let text = "```toml\n[advisory]\nid = \"RUSTSEC-2026-9999\"\npackage = \"made-up\"\ndate = \"2026-01-31\"\n\
                withdrawn = \"2026-02-28\"\n\n[versions]\npatched = [\">= 1.2.3\"]\n```\n\n# A title\n";
    assert_eq!(page(text), made_up(Some("2026-02-28"), &[">= 1.2.3"], &[]));
    let unsound =
        text.replace("[versions]", "informational = \"unsound\"\n[versions]\nunaffected = [\"< 1\"]");
    assert_eq!(page(&unsound).kind, "unsound");
    assert_eq!(page(&unsound).unaffected, ["< 1"]);
}
