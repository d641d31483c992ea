//! Results as data for programs: JSON in SI units and radians, CSV, samples. No sentence for people is
//! written here.

pub(crate) mod avoid;
pub(crate) mod claims;
pub(crate) mod comparison;
pub(crate) mod csv;
pub(crate) mod estimate;
pub(crate) mod field;
pub(crate) mod headline;
pub(crate) mod json;
pub(crate) mod judged_recorders;
pub(crate) mod judgement;
pub(crate) mod recorder;
pub(crate) mod samples;
pub(crate) mod sensitivity;
pub(crate) mod topics;
pub(crate) mod uncertainty;
pub(crate) mod validation;

use ::uncertainty::{Distribution, Shape};
use case::{Case, CaseFile, Text};
use serde::Serialize;
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

use crate::words::file_name;

/// The title as given; empty without one.
fn title(case: &Case) -> &str {
    case.title.as_ref().map_or("", Text::as_given)
}

/// The name of the shape of a distribution.
fn distribution_name(distribution: &Distribution) -> &'static str {
    match distribution.shape() {
        Shape::Normal { .. } => "normal",
        Shape::LogNormal { .. } => "log-normal",
        Shape::Uniform { .. } => "uniform",
        Shape::Triangular { .. } => "triangular",
        _ => "other",
    }
}

/// The results of a case, with the program and the file that reproduce them.
fn identified(file: &CaseFile, results: Value) -> Value {
    let case = case_file(file.source.name(), file.source.text().as_bytes());
    followed(results, json!({ "program": program(), "case": case }))
}

fn program() -> Value {
    json!({ "name": "deltav", "version": env!("CARGO_PKG_VERSION") })
}

fn case_file(path: &Text, bytes: &[u8]) -> Value {
    json!({ "file": file_name(path).as_given(), "sha256": sha256(bytes) })
}

/// An object with the keys of another one behind its own.
fn followed(mut object: Value, more: Value) -> Value {
    if let (Value::Object(object), Value::Object(more)) = (&mut object, more) {
        object.extend(more);
    }
    object
}

/// An object of `"key": value` pairs, in their order. A key with a question mark is left out if it has no
/// value: null, or an empty text or list. `of.{a, b}` stands for the fields of a value under their own names.
macro_rules! object {
    (@ $object:ident $(,)?) => {};
    (@ $object:ident $key:literal? : $value:expr, $($rest:tt)*) => {
        let value = serde_json::json!($value);
        if $crate::data::has_value(&value) {
            $object.insert($key.to_owned(), value);
        }
        $crate::data::object!(@ $object $($rest)*);
    };
    (@ $object:ident $key:literal : $value:expr, $($rest:tt)*) => {
        $object.insert($key.to_owned(), serde_json::json!($value));
        $crate::data::object!(@ $object $($rest)*);
    };
    (@ $object:ident $of:ident.{ $($field:ident),+ }, $($rest:tt)*) => {
        $($object.insert(stringify!($field).to_owned(), serde_json::json!($of.$field));)+
        $crate::data::object!(@ $object $($rest)*);
    };
    ($($pairs:tt)*) => {{
        let mut object = serde_json::Map::new();
        $crate::data::object!(@ object $($pairs)*,);
        serde_json::Value::Object(object)
    }};
}
use object;

/// An object that leaves out all keys without a value.
fn present(mut object: Value) -> Value {
    if let Value::Object(object) = &mut object {
        object.retain(|_, value| has_value(value));
    }
    object
}

fn has_value(value: &Value) -> bool {
    match value {
        Value::Null => false,
        Value::String(text) => !text.is_empty(),
        Value::Array(elements) => !elements.is_empty(),
        _ => true,
    }
}

/// The SHA-256 of a file, in hexadecimal digits: a report and its JSON name that of the case.
///
/// ```
/// // FIPS 180-2, appendix B.1
/// let digest = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
/// assert_eq!(report::sha256(b"abc"), digest);
/// ```
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A JSON document in indented lines.
fn pretty(document: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(escaped(&serde_json::to_string_pretty(document)?) + "\n")
}

/// A JSON list with one element for each item.
fn list<T, R>(of: impl IntoIterator<Item = T>, element: impl FnMut(T) -> R) -> Vec<R> {
    of.into_iter().map(element).collect()
}

/// A JSON document on one line.
fn on_one_line(document: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(escaped(&serde_json::to_string(document)?) + "\n")
}

/// JSON on which a terminal does not act: `serde_json` escapes only the control characters below U+0020. All
/// others can only occur within its texts, where an escape means the same.
fn escaped(json: &str) -> String {
    escaped_where(json, |letter| letter != '\n' && case::acts(letter))
}

/// Equivalent JSON with escapes for these letters, which occur only within its texts.
pub(crate) fn escaped_where(json: &str, is_escaped: impl Fn(char) -> bool) -> String {
    let mut out = String::with_capacity(json.len());
    for letter in json.chars() {
        if is_escaped(letter) {
            // Two escapes beyond U+FFFF.
            for unit in letter.encode_utf16(&mut [0; 2]) {
                out.push_str(&format!("\\u{unit:04x}"));
            }
        } else {
            out.push(letter);
        }
    }
    out
}
