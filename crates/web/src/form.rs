//! The form of a case, from the keys that it may have.

use case::{Dimension, Form, KeyInfo, Schema, Unit};
use serde_json::{Map, Value, json};

pub(crate) fn form() -> Value {
    let case = case::key_tree();
    let top = json!({
        "key": "",
        "title": "Case",
        "help": "The head of every report.",
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
        // Some keys take a word in place of the whole table.
        "choices": key.form.words(),
        "fields": table.map_or_else(Vec::new, |table| fields(table, &path, false)),
        "groups": table.map_or_else(Vec::new, |table| groups(table, &path)),
    })
}

fn field(table: &Schema, key: &KeyInfo, above: &str) -> Value {
    let path = path(above, key.name);
    let [title, help] = title_and_help(key.text());
    let mut field = Map::new();
    let mut put = |name: &str, value: Value| field.insert(name.to_owned(), value);
    put("key", json!(path));
    put("kind", json!(kind(key.form)));
    put("title", json!(title));
    put("help", json!(help));
    put("required", json!(table.requires(key.name)));
    put("range", json!(!key.form.ranges().is_empty()));
    let units = key.form.dimension().map(Dimension::units).unwrap_or_default();
    put("units", units.iter().map(Unit::spelling).collect());
    put("choices", json!(key.form.words()));
    put("fields", key.form.table().map_or_else(Vec::new, |table| fields(table, &path, true)).into());
    Value::Object(field)
}

/// The kind of a field.
fn kind(form: Form) -> &'static str {
    match form {
        Form::Text => "text",
        Form::Flag => "flag",
        Form::Words(_) | Form::Law(_) | Form::WordOrAll(_) | Form::WordsOrTable(..) => "choice",
        Form::Count(..) => "integer",
        Form::Keys(_) => "names",
        Form::Number(_) | Form::NumberOrTable(..) | Form::Probability => "number",
        Form::Numbers(_) => "numbers",
        Form::Quantity(..) | Form::Sourced(..) | Form::QuantityOrTables(..) | Form::Exact(..) => "quantity",
        Form::Quantities(..) => "quantities",
        Form::Wheels(..) => "wheels",
        Form::AngleOrHour => "angle-or-hour",
        Form::Vehicle | Form::Table(_) => "table",
        Form::Tables(..) => "tables",
        Form::Percent(_) => "percent",
        Form::Value | Form::Values | Form::Deviation => "value",
    }
}
