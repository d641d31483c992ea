//! Changes of the text.

use case::{Dimension, Quantity, edit, read_quantity, read_unit};
use serde_json::{Value, json};

use crate::given::{Places, Refused, made};

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

/// (digits) that a quantity keeps in another unit: more than anybody measures, and fewer than would show how
/// a computer rounds.
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
                "\"{}\" is no quantity that \"{}\" could measure",
                case::shown(text),
                case::shown(unit)
            );
            json!({ "ok": false, "message": message })
        }
    }
}

/// The shortest text of a number with at most so many digits.
pub(crate) fn rounded(number: f64, digits: usize) -> String {
    let text = format!("{number:.*e}", digits - 1);
    text.parse::<f64>().map_or(text, inputs::format_number)
}
