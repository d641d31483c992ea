//! Results as data for programs: JSON in SI units and radians, CSV, samples. No sentence for people is
//! written here.

pub(crate) mod comparison;
pub(crate) mod csv;
pub(crate) mod json;
pub(crate) mod judgement;
pub(crate) mod samples;
pub(crate) mod sensitivity;
pub(crate) mod topics;
pub(crate) mod uncertainty;
pub(crate) mod validation;

use case::{Case, Text};
use serde::Serialize;

/// The title as given; empty without one.
fn title(case: &Case) -> &str {
    case.title.as_ref().map_or("", Text::as_given)
}

/// A JSON document in indented lines.
fn pretty(document: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(escaped(&serde_json::to_string_pretty(document)?) + "\n")
}

/// A JSON document on one line.
fn on_one_line(document: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(escaped(&serde_json::to_string(document)?) + "\n")
}

/// JSON on which a terminal does not act: `serde_json` escapes the control characters below U+0020 alone. All
/// others can only be within its texts, where an escape means the same.
fn escaped(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for letter in json.chars() {
        if letter != '\n' && case::acts(letter) {
            // None of them is beyond U+FFFF, where two escapes would be needed.
            out.push_str(&format!("\\u{:04x}", u32::from(letter)));
        } else {
            out.push(letter);
        }
    }
    out
}
