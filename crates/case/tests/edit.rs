//! One key of a file is changed, and every other character stays as it is.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use case::edit::{EditError, remove, set};
use case::{CaseFile, Form, KeyInfo, Source, key_tree};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use toml::de::{DeTable, DeValue};

fn toml_files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            toml_files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "toml") {
            found.push(path);
        }
    }
}

/// Every file of the repository that is TOML, right or wrong as a case.
fn texts() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    toml_files(&root.join("../../fixtures"), &mut files);
    toml_files(&root.join("templates"), &mut files);
    let texts: Vec<String> =
        files.iter().map(|path| String::from_utf8(fs::read(path).unwrap()).unwrap()).collect();
    let texts: Vec<String> = texts.into_iter().filter(|text| DeTable::parse(text).is_ok()).collect();
    assert!(texts.len() > 100, "{}", texts.len());
    texts
}

/// The content of a text, by the parser: the characters of each value that is not a table, under its path.
fn said(text: &str) -> BTreeMap<String, String> {
    fn add(
        path: &str,
        text: &str,
        value: &DeValue<'_>,
        span: std::ops::Range<usize>,
        said: &mut BTreeMap<String, String>,
    ) {
        match value {
            DeValue::Table(table) => {
                for (key, value) in table {
                    let below = format!("{path}.{}", key.get_ref());
                    add(&below, text, value.get_ref(), value.span(), said);
                }
            }
            DeValue::Array(list) if list.iter().any(|one| one.get_ref().is_table()) => {
                for (n, value) in list.iter().enumerate() {
                    add(&format!("{path}[{}]", n + 1), text, value.get_ref(), value.span(), said);
                }
            }
            _ => {
                said.insert(path.to_owned(), text[span].to_owned());
            }
        }
    }
    let table = DeTable::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let mut said = BTreeMap::new();
    for (key, value) in table.get_ref() {
        add(key.get_ref(), text, value.get_ref(), value.span(), &mut said);
    }
    said
}

/// The comments of a text, in their order. No text of a fixture has a `#` in a string.
fn comments(text: &str) -> Vec<&str> {
    text.lines().filter_map(|line| line.find('#').map(|at| line[at..].trim_end())).collect()
}

/// Every key with the value of its example, those of tables with a header below them.
fn keys_with_values() -> Vec<(String, String)> {
    fn add(keys: &'static [KeyInfo], above: &str, all: &mut Vec<(String, String)>) {
        for key in keys {
            let path = if above.is_empty() { key.name.to_owned() } else { format!("{above}.{}", key.name) };
            if !key.has_header() {
                let (name, value) = key.example.split_once('=').unwrap();
                assert_eq!(name.trim(), key.name);
                all.push((path.clone(), value.trim().to_owned()));
            }
            let is_list = matches!(key.form, Form::Tables(..) | Form::QuantityOrTables(..));
            let element = if is_list { "[1]" } else { "" };
            add(key.form.keys(), &format!("{path}{element}"), all);
        }
    }
    let mut all = Vec::new();
    add(key_tree().keys, "", &mut all);
    assert!(all.len() > 200, "{}", all.len());
    all
}

/// Whether a path is another one, or leads on from it.
fn is_within(inner: &str, outer: &str) -> bool {
    inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

fn is_on_the_way(one: &str, other: &str) -> bool {
    is_within(one, other) || is_within(other, one)
}

fn is_subset(part: &[&str], whole: &[&str]) -> bool {
    let mut whole = whole.iter();
    part.iter().all(|one| whole.any(|other| other == one))
}

/// Asserts that only the key is changed, and returns the content of the new text.
#[track_caller]
fn only_changed(before: &str, after: &str, key: &str) -> BTreeMap<String, String> {
    only_changed_of(&said(before), before, after, key)
}

#[track_caller]
fn only_changed_of(
    old: &BTreeMap<String, String>,
    before: &str,
    after: &str,
    key: &str,
) -> BTreeMap<String, String> {
    let new = said(after);
    let others = |said: &BTreeMap<String, String>| -> BTreeMap<String, String> {
        said.iter()
            .filter(|(path, _)| !is_on_the_way(path, key))
            .map(|(a, b)| (a.clone(), b.clone()))
            .collect()
    };
    assert_eq!(others(old), others(&new), "{key}\n{before}\n---\n{after}");
    new
}

/// The lengths that two texts have in common at their beginning and at their end.
fn common(one: &str, other: &str) -> [usize; 2] {
    let same = |(a, b): &(u8, u8)| a == b;
    let ahead = one.bytes().zip(other.bytes()).take_while(same).count();
    let most = one.len().min(other.len()) - ahead;
    [ahead, one.bytes().rev().zip(other.bytes().rev()).take_while(same).count().min(most)]
}

/// A text, and the value and place of each of its keys.
struct Before<'a> {
    text: &'a str,
    said: BTreeMap<String, String>,
    source: Source,
}

impl<'a> Before<'a> {
    fn new(text: &'a str) -> Self {
        let source = CaseFile::parse("case.toml", text).map_or_else(|e| e.source().clone(), |f| f.source);
        Self { text, said: said(text), source }
    }
}

#[track_caller]
fn set_and_removed(before: &Before<'_>, key: &str, value: &str) {
    let text = before.text;
    let edited = set(text, key, value).unwrap_or_else(|error| panic!("{key}: {error}\n{text}"));
    assert_eq!(&edited.text[edited.span.clone()], value, "{key}");
    let new = only_changed_of(&before.said, text, &edited.text, key);
    if !value.starts_with(['{', '[']) {
        assert_eq!(new.get(key).map(String::as_str), Some(value), "{key}\n{}", edited.text);
    }
    // The characters themselves: one place has changed, or two if a table with a header was removed.
    let [ahead, behind] = common(text, &edited.text);
    let gone = &text[ahead..text.len() - behind];
    let was = before.source.span(key);
    let replaces_table =
        before.said.keys().any(|path| path != key && is_on_the_way(path, key) && !path.contains('{'));
    if !replaces_table {
        let most = was.map_or(0, |span| span.len());
        assert!(gone.len() <= most, "{key}: {gone:?} is gone\n{}", edited.text);
        assert_eq!(comments(text), comments(&edited.text), "{key}");
    }
    if text.contains("\r\n") {
        assert_eq!(edited.text.matches('\n').count(), edited.text.matches("\r\n").count(), "{key}");
    }
    assert_eq!(text.starts_with('\u{feff}'), edited.text.starts_with('\u{feff}'), "{key}");

    let removed = remove(&edited.text, key).unwrap_or_else(|error| panic!("{key}: {error}"));
    let rest = only_changed_of(&new, &edited.text, &removed, key);
    assert!(!rest.contains_key(key), "{key}\n{removed}");
    assert!(is_subset(&comments(&removed), &comments(&edited.text)), "{key}");
    assert_eq!(remove(&removed, key).unwrap(), removed, "{key}");
}

/// In a third of the files, so that each file has a third of the keys.
#[test]
fn every_key_can_be_set_and_removed() {
    let keys = keys_with_values();
    for (index, text) in texts().iter().enumerate() {
        let before = Before::new(text);
        for (key, value) in keys.iter().skip(index % 3).step_by(3) {
            set_and_removed(&before, key, value);
        }
    }
}

#[test]
fn line_breaks_of_windows_and_a_byte_order_mark_stay() {
    for text in texts().iter().filter(|text| !text.contains('\r') && !text.starts_with('\u{feff}')).step_by(7)
    {
        let windows = format!("\u{feff}{}", text.replace('\n', "\r\n"));
        let before = Before::new(&windows);
        for (key, value) in keys_with_values() {
            set_and_removed(&before, &key, &value);
        }
    }
}

/// Where a person would put it.
#[test]
fn what_is_missing_is_added_in_its_place() {
    let text = "# mine\n[vehicle1]\nmass    = \"1500 kg\" # weighed\nheading = \"0 deg\"\n\n# the other\n[vehicle2]\nfixed = true\n";
    for (key, value, expected) in [
        ("title", "\"A\"", "title = \"A\"\n\n[vehicle1]"),
        ("vehicle1.name", "\"B\"", "[vehicle1]\nname    = \"B\"\nmass "),
        ("vehicle1.yaw_inertia", "\"2 kg m^2\"", "# weighed\nyaw_inertia = \"2 kg m^2\"\nheading"),
        ("vehicle1.speed", "\"10 mph\"", "heading = \"0 deg\"\nspeed   = \"10 mph\"\n\n# the other"),
        ("vehicle1.contact.x", "\"1 m\"", "contact = { x = \"1 m\" }\n\n# the other"),
        (
            "vehicle1.crush.side",
            "\"front\"",
            "\"0 deg\"\n\n[vehicle1.crush]\nside = \"front\"\n\n# the other",
        ),
        (
            "vehicle2.crush.stiffness.category",
            "3",
            "fixed = true\n\n[vehicle2.crush]\nstiffness = { category = 3 }\n",
        ),
        ("scene.contact.y", "\"3 m\"", "# mine\n\n[scene]\ncontact = { y = \"3 m\" }\n\n[vehicle1]"),
        ("impact.restitution", "0.1", "fixed = true\n\n[impact]\nrestitution = 0.1\n"),
    ] {
        let edited = set(text, key, value).unwrap();
        assert!(edited.text.contains(expected), "{key}\n{}", edited.text);
        assert_eq!(&edited.text[edited.span], value, "{key}");
    }
    let within = "[vehicle1]\ncontact = { x = \"1 m\" } # C\ncrush = \"none\"\n";
    let edited = set(within, "vehicle1.contact.y", "\"2 m\"").unwrap().text;
    assert_eq!(edited, "[vehicle1]\ncontact = { x = \"1 m\", y = \"2 m\" } # C\ncrush = \"none\"\n");
    assert_eq!(
        remove(&edited, "vehicle1.contact.x").unwrap(),
        "[vehicle1]\ncontact = { y = \"2 m\" } # C\ncrush = \"none\"\n"
    );
    // A table without keys has no content.
    assert_eq!(remove(within, "vehicle1.contact.x").unwrap(), "[vehicle1]\ncrush = \"none\"\n");
    // A word and a table cannot both be there.
    let table = set(within, "vehicle1.crush.side", "\"rear\"").unwrap().text;
    assert_eq!(table, "[vehicle1]\ncontact = { x = \"1 m\" } # C\n\n[vehicle1.crush]\nside = \"rear\"\n");
    assert_eq!(
        set(&table, "vehicle1.crush", "\"none\"").unwrap().text,
        "[vehicle1]\ncontact = { x = \"1 m\" } # C\ncrush = \"none\"\n\n"
    );
}

#[test]
fn elements_of_lists_are_set_and_removed() {
    let text = "[vehicle1.crush]\ndepths = [\"1 in\", \"2 in\"]\n[[surface.zone]]\nfriction = 0.4 # ice\n";
    let deeper = set(text, "vehicle1.crush.depths[2]", "\"3 in\"").unwrap().text;
    assert!(deeper.contains("[\"1 in\", \"3 in\"]"));
    let longer = set(text, "vehicle1.crush.depths[3]", "\"3 in\"").unwrap().text;
    assert!(longer.contains("[\"1 in\", \"2 in\", \"3 in\"]"));
    assert!(remove(&longer, "vehicle1.crush.depths[1]").unwrap().contains("[\"2 in\", \"3 in\"]"));
    let error = set(text, "vehicle1.crush.depths[9]", "\"3 in\"").unwrap_err();
    assert_eq!(error, EditError::NoElement { key: "vehicle1.crush.depths[9]".to_owned() });
    let range = "[vehicle1.crush]\ndepths = { values = \"1 2 in\", sd = \"1 in\" }\n";
    let error = set(range, "vehicle1.crush.depths[1]", "\"3 in\"").unwrap_err();
    assert_eq!(error, EditError::NoElement { key: "vehicle1.crush.depths[1]".to_owned() });
    let zone = set(text, "surface.zone[1].name", "\"ice\"").unwrap().text;
    assert!(zone.contains("[[surface.zone]]\nname = \"ice\"\nfriction = 0.4 # ice\n"));
    let two = set(&zone, "surface.zone[2].friction", "0.5").unwrap().text;
    assert!(two.ends_with("# ice\n\n[[surface.zone]]\nfriction = 0.5\n"), "{two}");
}

/// The other elements of a list are then still the same.
#[test]
fn the_only_key_of_an_element_goes_with_it_where_nothing_follows() {
    let text = "vehicle1.crush.stiffness.zones = [{ A = \"1 lb/in\" }, { A = \"2 lb/in\" }]\n";
    let key = |element: usize| format!("vehicle1.crush.stiffness.zones[{element}].A");
    let first = remove(text, &key(1)).unwrap();
    let left = said(&first);
    assert_eq!(left.into_iter().collect::<Vec<_>>(), [(key(2), "\"2 lb/in\"".to_owned())]);
    let second = remove(text, &key(2)).unwrap();
    assert_eq!(second, "vehicle1.crush.stiffness.zones = [{ A = \"1 lb/in\" }]\n");
    assert_eq!(remove(&second, &key(1)).unwrap(), "");
}

#[test]
fn what_cannot_be_done_is_said() {
    let error = |text: &str, key: &str, value: &str| set(text, key, value).unwrap_err().to_string();
    assert_eq!(error("", "vehicle1.wieght", "1"), "a case file has no key \"vehicle1.wieght\"");
    assert_eq!(error("", "vehicle3.mass", "1"), "a case file has no key \"vehicle3.mass\"");
    for value in ["10 mph", "", "1\nb = 2", "{ a = 1", "1 # one", "\"\"\"", "1, 2"] {
        assert!(error("", "vehicle1.mass", value).contains("not a value of TOML"), "{value:?}");
    }
    let broken = set("title = \"a\nb = 1", "title", "\"c\"").unwrap_err();
    assert!(matches!(broken, EditError::NotToml { span: Some(_), .. }), "{broken}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever was changed before.
    #[test]
    fn many_changes_one_after_the_other(
        file in any::<Index>(),
        has_windows in any::<bool>(),
        changes in vec((any::<Index>(), any::<bool>()), 1..20),
    ) {
        let (texts, keys) = (texts(), keys_with_values());
        let mut text = file.get(&texts).clone();
        // A single line has no line break that shows the style.
        let windows = has_windows && text.contains('\n');
        if windows {
            text = text.replace("\r\n", "\n").replace('\n', "\r\n");
        }
        for (key, sets) in changes {
            let (key, value) = key.get(&keys);
            let new = if sets { set(&text, key, value).unwrap().text } else { remove(&text, key).unwrap() };
            let said = only_changed(&text, &new, key);
            prop_assert_eq!(said.keys().any(|path| is_within(path, key)), sets, "{} {}", key, new);
            if windows {
                prop_assert_eq!(new.matches('\n').count(), new.matches("\r\n").count());
            }
            text = new;
        }
    }
}

/// Why `edit` takes the places in a text from the parser and does not write the text of `toml_edit`: for
/// these files it gives other characters, although nothing was changed.
#[test]
fn toml_edit_would_change_more_than_the_key() {
    let plain = "[vehicle1]\nmass = \"1500 kg\" # weighed\n";
    let again = |text: &str| text.parse::<toml_edit::DocumentMut>().unwrap().to_string();
    assert_eq!(again(plain), plain);
    for (text, changed) in [
        // The line breaks of Windows.
        (plain.replace('\n', "\r\n"), "mass = \"1520 kg\" # weighed\r\n"),
        // A byte order mark, with which editors on Windows save.
        (format!("\u{feff}{plain}"), "\u{feff}[vehicle1]\nmass = \"1520 kg\""),
        // The order of dotted keys.
        (
            "vehicle1.mass = \"1500 kg\"\nvehicle2.fixed = true\nvehicle1.heading = \"0 deg\"\n".to_owned(),
            "vehicle1.mass = \"1520 kg\"\nvehicle2.fixed = true\nvehicle1.heading",
        ),
    ] {
        assert_ne!(again(&text), text, "toml_edit keeps this now: can it replace `edit`?");
        let edited = set(&text, "vehicle1.mass", "\"1520 kg\"").unwrap();
        assert!(edited.text.contains(changed), "{}", edited.text);
        assert_eq!(edited.text.replace("1520", "1500"), text);
    }
    // The comment above a removed key may well belong to the lines below: `edit` keeps it, `toml_edit`
    // removes it.
    let above = "[vehicle1]\nmass = \"1500 kg\"\n# from the plan\nheading = \"0 deg\"\nspeed = \"10 mph\"\n";
    let mut document: toml_edit::DocumentMut = above.parse().unwrap();
    document["vehicle1"].as_table_mut().unwrap().remove("heading");
    assert!(!document.to_string().contains("# from the plan"));
    assert!(remove(above, "vehicle1.heading").unwrap().contains("# from the plan\nspeed"));
    // A key that is added has its place among the others.
    document["vehicle1"]["name"] = toml_edit::value("A");
    assert!(document.to_string().ends_with("name = \"A\"\n"));
    assert!(set(above, "vehicle1.name", "\"A\"").unwrap().text.starts_with("[vehicle1]\nname = \"A\"\n"));
}
