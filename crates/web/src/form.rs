//! The form of a case, from the keys that it may have.

use case::{Bounds, Dimension, KeyForm, KeyInfo, Unit};
use serde_json::{Map, Value, json};

pub(crate) fn form() -> Value {
    let keys = case::key_tree();
    let (groups, fields): (Vec<_>, Vec<_>) = keys.iter().partition(|key| key.has_header());
    let top = json!({
        "key": "",
        "title": "Case",
        "help": "What heads every report.",
        "fields": fields.iter().map(|key| field(key, "")).collect::<Vec<_>>(),
        "groups": [],
    });
    std::iter::once(top).chain(groups.iter().map(|key| group(key, ""))).collect()
}

/// The path of a key below another one.
fn path(above: &str, name: &str) -> String {
    if above.is_empty() { name.to_owned() } else { format!("{above}.{name}") }
}

/// The first sentence of what a key means, and the rest.
fn title_and_help(text: &str) -> [&str; 2] {
    let (title, help) = text.split_once(". ").unwrap_or((text, ""));
    [title.trim_end_matches('.'), help]
}

fn group(key: &KeyInfo, above: &str) -> Value {
    let path = path(above, key.name);
    let keys = keys_below(&key.form);
    let [title, help] = title_and_help(key.text);
    let (groups, fields): (Vec<_>, Vec<_>) = keys.iter().partition(|key| key.has_header());
    json!({
        "key": path,
        "title": title,
        "help": help,
        // A word may stand in place of the whole table.
        "choices": words(&key.form),
        "fields": fields.iter().map(|key| field(key, &path)).collect::<Vec<_>>(),
        "groups": groups.iter().map(|key| group(key, &path)).collect::<Vec<_>>(),
    })
}

fn field(key: &KeyInfo, above: &str) -> Value {
    let path = path(above, key.name);
    let (kind, range) = kind(&key.form);
    let [title, help] = title_and_help(key.text);
    let mut field = Map::new();
    let mut put = |name: &str, value: Value| field.insert(name.to_owned(), value);
    put("key", json!(path));
    put("name", json!(key.name));
    put("kind", json!(kind));
    put("title", json!(title));
    put("help", json!(help));
    put("example", json!(key.example));
    put("required", json!(key.is_required));
    put("range", json!(range));
    let units = dimension(&key.form).map(Dimension::units).unwrap_or_default();
    put("units", units.iter().map(Unit::spelling).collect());
    put("choices", json!(words(&key.form)));
    put("bounds", bounds(&key.form, key.bounds));
    put("fields", keys_below(&key.form).iter().map(|key| self::field(key, &path)).collect());
    Value::Object(field)
}

/// What a field is, and whether it may have a range.
fn kind(form: &KeyForm) -> (&'static str, bool) {
    match form {
        KeyForm::Text => ("text", false),
        KeyForm::Flag => ("flag", false),
        KeyForm::Word(_) | KeyForm::WordOrAll(_) | KeyForm::WordOrTable(..) => ("choice", false),
        KeyForm::Count(_) => ("integer", false),
        KeyForm::Names => ("names", false),
        KeyForm::Number | KeyForm::NumberOrTable(_) => ("number", true),
        KeyForm::Numbers => ("numbers", true),
        KeyForm::Quantity(_) | KeyForm::Sourced(_) | KeyForm::QuantityOrTables(..) => ("quantity", true),
        KeyForm::Exact(_) => ("quantity", false),
        KeyForm::Quantities(_) => ("quantities", true),
        KeyForm::Wheels(_) => ("wheels", true),
        KeyForm::AngleOrHour => ("angle-or-hour", true),
        KeyForm::Table(_) => ("table", false),
        KeyForm::Tables(_) => ("tables", false),
        KeyForm::Percent => ("percent", false),
        KeyForm::Probability => ("number", false),
        KeyForm::Value | KeyForm::Values | KeyForm::Deviation => ("value", false),
    }
}

fn dimension(form: &KeyForm) -> Option<Dimension> {
    match form {
        KeyForm::Quantity(dimension)
        | KeyForm::Sourced(dimension)
        | KeyForm::Exact(dimension)
        | KeyForm::Quantities(dimension)
        | KeyForm::QuantityOrTables(dimension, _) => Some(*dimension),
        KeyForm::AngleOrHour => Some(Dimension::Angle),
        _ => None,
    }
}

fn words(form: &KeyForm) -> &'static [&'static str] {
    match form {
        KeyForm::Word(words) | KeyForm::WordOrAll(words) | KeyForm::Wheels(words) => words,
        KeyForm::WordOrTable(words, _) => words,
        _ => &[],
    }
}

fn keys_below(form: &KeyForm) -> &[KeyInfo] {
    match form {
        KeyForm::QuantityOrTables(_, keys)
        | KeyForm::Table(keys)
        | KeyForm::Tables(keys)
        | KeyForm::WordOrTable(_, keys)
        | KeyForm::NumberOrTable(keys) => keys,
        _ => &[],
    }
}

fn bounds(form: &KeyForm, bounds: Bounds) -> Value {
    let (min, max) = match (form, bounds) {
        (KeyForm::Count(last), _) => (Some(1.0), Some(f64::from(*last))),
        (KeyForm::Probability, _) => (Some(0.0), Some(1.0)),
        (_, Bounds::None | Bounds::Acute) => (None, None),
        (_, Bounds::NotNegative | Bounds::Positive) => (Some(0.0), None),
        (_, Bounds::Share | Bounds::BelowOne) => (Some(0.0), Some(1.0)),
        (_, Bounds::Coefficient) => (Some(-1.0), Some(1.0)),
    };
    let above = matches!(bounds, Bounds::Positive) || matches!(form, KeyForm::Probability);
    json!({ "min": min, "max": max, "above": above })
}
