//! The form of a case, from the keys that it may have.

use case::{Dimension, Form, KeyInfo, Schema, Unit};
use serde_json::{Map, Value, json};

pub(crate) fn form() -> Value {
    let case = case::key_tree();
    let top = json!({
        "key": "",
        "title": "Case",
        "help": "What stands at the head of every report.",
        "fields": fields(case, "", false),
        "groups": [],
    });
    std::iter::once(top).chain(groups(case, "")).collect()
}

/// The path of a key below another one.
fn path(above: &str, name: &str) -> String {
    if above.is_empty() { name.to_owned() } else { format!("{above}.{name}") }
}

/// The first sentence of the meaning of a key, and the rest.
fn title_and_help(text: &str) -> [&str; 2] {
    let (title, help) = text.split_once(". ").unwrap_or((text, ""));
    [title.trim_end_matches('.'), help]
}

/// The tables with their own header in a table.
fn groups(table: &Schema, above: &str) -> Vec<Value> {
    table.keys.iter().filter(|key| key.has_header()).map(|key| group(key, above)).collect()
}

/// The keys of a table without those that have their own header, or with them.
fn fields(table: &Schema, above: &str, with_headers: bool) -> Vec<Value> {
    let is_field = |key: &&KeyInfo| with_headers || !key.has_header();
    table.keys.iter().filter(is_field).map(|key| field(table, key, above)).collect()
}

fn group(key: &KeyInfo, above: &str) -> Value {
    let path = path(above, key.name);
    let table = key.form.table();
    let [title, help] = title_and_help(key.text());
    json!({
        "key": path,
        "title": title,
        "help": help,
        // A word may stand in place of the whole table.
        "choices": key.form.words(),
        "fields": table.map_or_else(Vec::new, |table| fields(table, &path, false)),
        "groups": table.map_or_else(Vec::new, |table| groups(table, &path)),
    })
}

fn field(table: &Schema, key: &KeyInfo, above: &str) -> Value {
    let path = path(above, key.name);
    let (kind, range) = kind(key.form);
    let [title, help] = title_and_help(key.text());
    let mut field = Map::new();
    let mut put = |name: &str, value: Value| field.insert(name.to_owned(), value);
    put("key", json!(path));
    put("kind", json!(kind));
    put("title", json!(title));
    put("help", json!(help));
    put("required", json!(table.requires(key.name)));
    put("range", json!(range));
    let units = key.form.dimension().map(Dimension::units).unwrap_or_default();
    put("units", units.iter().map(Unit::spelling).collect());
    put("choices", json!(key.form.words()));
    put("fields", key.form.table().map_or_else(Vec::new, |table| fields(table, &path, true)).into());
    Value::Object(field)
}

/// The kind of a field, and whether it may have a range.
fn kind(form: Form) -> (&'static str, bool) {
    match form {
        Form::Text => ("text", false),
        Form::Flag => ("flag", false),
        Form::Words(_) | Form::Law(_) | Form::WordOrAll(_) | Form::WordsOrTable(..) => ("choice", false),
        Form::Count(_) => ("integer", false),
        Form::Keys(_) => ("names", false),
        Form::Number(_) | Form::NumberOrTable(..) => ("number", true),
        Form::Numbers(_) => ("numbers", true),
        Form::Quantity(..) | Form::Sourced(..) | Form::QuantityOrTables(..) => ("quantity", true),
        Form::Exact(..) => ("quantity", false),
        Form::Quantities(..) => ("quantities", true),
        Form::Wheels(..) => ("wheels", true),
        Form::AngleOrHour => ("angle-or-hour", true),
        Form::Vehicle | Form::Table(_) => ("table", false),
        Form::Tables(..) => ("tables", false),
        Form::Percent(_) => ("percent", false),
        Form::Probability => ("number", false),
        Form::Value | Form::Values | Form::Deviation => ("value", false),
    }
}
