//! Changes of the text.

use case::{CaseFile, Dimension, Quantity, edit, read_quantity, read_unit};
use serde_json::{Value, json};

use crate::given::{PAGE, Places, Refused, UNNAMED, made};

pub(crate) fn edit(text: &str, key: &str, value: &str) -> Value {
    let refused = |error: edit::EditError| Refused::message(error.to_string());
    made(if value.trim().is_empty() {
        edit::remove(text, key)
            .map(|text| json!({ "ok": true, "text": text, "from": null, "to": null }))
            .map_err(refused)
    } else {
        edit::set(text, key, value)
            .map(|edited| {
                let [from, to] = Places::of(&edited.text).of_span(&edited.span);
                json!({ "ok": true, "text": edited.text, "from": from, "to": to })
            })
            .map_err(refused)
    })
}

/// The text with a recorder's table in it, as copied out of a printed report: `key` is `pre_crash` or `pulse`
/// of `[vehicleN.recorder]`. A table that cannot be read is refused, and errors elsewhere are not.
pub(crate) fn paste(text: &str, key: &str, table: &str) -> Value {
    made(pasted(text, key, table).map(|text| json!({ "ok": true, "text": text })))
}

fn pasted(text: &str, key: &str, table: &str) -> Result<String, Refused> {
    if table.trim().is_empty() {
        return Err(Refused::message("there is no table yet: paste it into the box"));
    }
    let value = format!("{{ text = {} }}", lines_of_toml(table));
    let edited = edit::set(text, key, &value).map_err(|error| Refused::message(error.to_string()))?;
    let recorder = key.rsplit_once('.').map_or(key, |(recorder, _)| recorder);
    if let Err(errors) = CaseFile::parse(UNNAMED, &edited.text) {
        let errors = errors.in_words_of(&PAGE);
        let is_of_recorder = |key: &str| key.starts_with(recorder);
        if errors.problems().iter().any(|problem| problem.key.as_deref().is_some_and(is_of_recorder)) {
            return Err(Refused::of(&errors));
        }
    }
    Ok(edited.text)
}

/// A text of several lines in the notation of TOML.
fn lines_of_toml(lines: &str) -> String {
    let mut written = String::from("\"\"\"\n");
    for line in lines.trim_matches(['\r', '\n']).lines() {
        for letter in line.trim_end().chars() {
            match letter {
                '\\' | '"' => written.extend(['\\', letter]),
                letter if letter.is_control() && letter != '\t' => written.push(' '),
                letter => written.push(letter),
            }
        }
        written.push('\n');
    }
    written + "\"\"\""
}

/// (digits) of a quantity in another unit: more than any measurement has, and few enough to hide rounding
/// errors.
const DIGITS: usize = 9;

pub(crate) fn convert(text: &str, unit: &str) -> Value {
    let converted = Dimension::ALL.into_iter().find_map(|dimension| {
        let to = read_unit(unit, dimension)?;
        let from: Quantity = read_quantity(text, dimension).ok()?;
        Some(format!("{} {unit}", rounded(from.si() / to.factor(), DIGITS)))
    });
    match converted {
        Some(text) => json!({ "ok": true, "text": text }),
        None => {
            let message = format!(
                "\"{}\" is not a quantity in a unit like \"{}\"",
                case::shown(text),
                case::shown(unit)
            );
            json!({ "ok": false, "message": message })
        }
    }
}

/// The shortest text of a number with at most this many digits.
pub(crate) fn rounded(number: f64, digits: usize) -> String {
    let text = format!("{number:.*e}", digits - 1);
    text.parse::<f64>().map_or(text, inputs::format_number)
}
