//! The case files of `fixtures`, as texts, as values and in SI units.

use std::fs;
use std::path::{Path, PathBuf};

use case::{CaseFile, KeyInfo, Value, ValueTable, key_tree};

/// A case file.
pub(crate) struct Fixture {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) values: ValueTable<'static>,
}

/// All files that can be read, in the order of their names.
pub(crate) fn all() -> Vec<Fixture> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut paths = Vec::new();
    collect(&root, &mut paths);
    paths.sort();
    let fixtures: Vec<Fixture> = paths
        .into_iter()
        .filter_map(|path| {
            let text = fs::read_to_string(&path).unwrap();
            // Some are data of another kind.
            CaseFile::parse("case.toml", &text).ok()?;
            let values = CaseFile::part("part.toml", &text).unwrap();
            Some(Fixture { name: path.strip_prefix(&root).unwrap().display().to_string(), text, values })
        })
        .collect();
    assert!(fixtures.len() >= 45, "{} fixtures", fixtures.len());
    fixtures
}

pub(crate) fn one(name: &str) -> Fixture {
    all().into_iter().find(|fixture| fixture.name == name).unwrap()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            if path.file_name().is_some_and(|name| name != "invalid") {
                collect(&path, paths);
            }
        } else if path.extension().is_some_and(|ending| ending == "toml") {
            paths.push(path);
        }
    }
}

/// The same in SI units.
pub(crate) fn in_si<'a>(table: &ValueTable<'a>) -> ValueTable<'a> {
    table.iter().map(|(key, value)| (key.to_owned().into(), value_in_si(value))).collect()
}

fn value_in_si<'a>(value: &Value<'a>) -> Value<'a> {
    match value {
        Value::Quantity(number, unit) => {
            let dimension = unit.dimension();
            Value::Quantity(number * unit.factor(), dimension.unit(dimension.si_unit()).unwrap())
        }
        Value::List(list) => Value::List(list.iter().map(value_in_si).collect()),
        Value::Table(table) => Value::Table(in_si(table)),
        other => other.clone(),
    }
}

/// The values as TOML, one table in a line.
pub(crate) fn toml(table: &ValueTable<'_>) -> String {
    let lines = table.iter().map(|(key, value)| format!("{key} = {}\n", toml_value(value)));
    lines.collect()
}

fn toml_value(value: &Value<'_>) -> String {
    match value {
        Value::Text(text) => format!("{text:?}"),
        Value::Number(number) => format!("{number:?}"),
        Value::Quantity(number, unit) => format!("\"{number:?} {unit}\""),
        Value::Flag(flag) => flag.to_string(),
        Value::List(list) => format!("[{}]", list.iter().map(toml_value).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let keys = table.iter().map(|(key, value)| format!("{key} = {}", toml_value(value)));
            format!("{{ {} }}", keys.collect::<Vec<_>>().join(", "))
        }
    }
}

/// Every key with its path, tables within tables.
pub(crate) fn each_key(visit: &mut dyn FnMut(&str, &'static KeyInfo)) {
    fn walk(keys: &'static [KeyInfo], within: &str, visit: &mut dyn FnMut(&str, &'static KeyInfo)) {
        for key in keys {
            let path = format!("{within}{}", key.name);
            visit(&path, key);
            walk(key.form.keys(), &format!("{path}."), visit);
        }
    }
    walk(key_tree().keys, "", visit);
}
