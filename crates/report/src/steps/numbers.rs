//! Numbers of a substitution, kept until the units of the reader are known.
//!
//! The steps put numbers in SI units into their equations. All equations hold in any coherent system of
//! units, so a reader of US units gets the same steps in ft, lb, s and slug (lb·s²/ft). Until the system is
//! known, a number is in the text as its SI value and unit between marks, with every digit.

use case::Quantity;

use crate::units::{Units, significant};

/// The marks of such a number: beginning, separator of its parts, and end. No other text of a step contains
/// them.
const BEGIN: char = '\u{e000}';
const NEXT: char = '\u{e001}';
const END: char = '\u{e002}';

/// A number with its unit, in parentheses if it is negative or a product.
pub(super) fn n(value: f64, unit: &str) -> String {
    format!("{BEGIN}n{NEXT}{value:e}{NEXT}{unit}{END}")
}

/// A number with its unit in parentheses, to be raised to a power.
pub(super) fn p(value: f64, unit: &str) -> String {
    format!("{BEGIN}p{NEXT}{value:e}{NEXT}{unit}{END}")
}

/// A number of the file in the unit of the equations: `3300 lb · 0.453592 kg/lb`, or unchanged if the file
/// has that unit.
pub(super) fn converted(quantity: &Quantity, unit: &str) -> String {
    let own = quantity.unit().spelling().replace(' ', "·").replace("^2", "²");
    let (number, factor) = (quantity.number(), quantity.unit().factor());
    format!("{BEGIN}c{NEXT}{number:e}{NEXT}{own}{NEXT}{factor:e}{NEXT}{unit}{END}")
}

/// The name of a unit.
pub(super) fn name_of(unit: &str) -> String {
    format!("{BEGIN}u{NEXT}{unit}{END}")
}

/// An angle as the argument of a function.
pub(super) fn angle(rad: f64) -> String {
    format!("({}\u{a0}°)", digits(rad.to_degrees()))
}

/// The text with its numbers in the coherent units of the reader.
pub(super) fn printed(text: &str, units: Units) -> String {
    let mut parts = text.split(BEGIN);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (number, rest) = part.split_once(END).unwrap_or((part, ""));
        let fields: Vec<&str> = number.split(NEXT).collect();
        out.push_str(&one(&fields, units).unwrap_or_default());
        out.push_str(rest);
    }
    out
}

fn one(fields: &[&str], units: Units) -> Option<String> {
    Some(match *fields {
        ["n", value, unit] => {
            let (size, unit) = units.coherent(unit);
            bracketed(with_unit(value.parse::<f64>().ok()? / size, unit))
        }
        ["p", value, unit] => {
            let (size, unit) = units.coherent(unit);
            format!("({})", with_unit(value.parse::<f64>().ok()? / size, unit))
        }
        ["c", number, own, factor, unit] => {
            let (size, unit) = units.coherent(unit);
            let number = bracketed(with_unit(number.parse().ok()?, own));
            match factor.parse::<f64>().ok()? / size {
                same if is_one(same) => number,
                factor => {
                    let own = if own.contains('·') { format!("({own})") } else { own.to_owned() };
                    format!("{number} · {}", bracketed(with_unit(factor, &format!("{unit}/{own}"))))
                }
            }
        }
        ["u", unit] => units.coherent(unit).1.to_owned(),
        _ => return None,
    })
}

/// Whether a number of the file needs no conversion.
pub(super) fn is_coherent(quantity: &Quantity, unit: &str, units: Units) -> bool {
    is_one(quantity.unit().factor() / units.coherent(unit).0)
}

/// Whether a factor is 1, except for the rounding of a product of factors.
fn is_one(factor: f64) -> bool {
    (factor - 1.0).abs() < 1e-12
}

fn bracketed(text: String) -> String {
    if text.starts_with('−') || text.contains('·') && text.contains("10") && !text.contains('\u{a0}') {
        format!("({text})")
    } else {
        text
    }
}

fn with_unit(value: f64, unit: &str) -> String {
    if unit.is_empty() { digits(value) } else { format!("{}\u{a0}{unit}", digits(value)) }
}

/// (digits) of a rounded number.
const DIGITS: usize = 6;

/// A smaller number is a rounded zero: no quantity of a collision is so small in SI units.
const NOTHING: f64 = 1e-12;

/// A number as printed: exact if that takes fewer than six digits, else with six. The error of a unit
/// conversion in the thirteenth digit does not count.
pub(crate) fn digits(value: f64) -> String {
    let value = if value.abs() < NOTHING { 0.0 } else { value };
    let text = match format!("{value:.11e}").parse::<f64>() {
        Ok(plain) if is_short(plain) => format!("{plain}"),
        _ => rounded(value),
    };
    text.replace('-', "−")
}

/// A smaller number has at least three zeros after the point.
const LONG: f64 = 1e-3;

fn is_short(value: f64) -> bool {
    let text = format!("{value}");
    let digits = text.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit).count();
    digits < DIGITS && (value == 0.0 || (1e-5..1e6).contains(&value.abs()))
}

/// Six significant digits, with a power of ten only where the number would be long.
fn rounded(value: f64) -> String {
    if (1e5..1e12).contains(&value.abs()) {
        return format!("{value:.0}");
    }
    if value.abs() >= LONG {
        let text = significant(value, DIGITS);
        if !text.contains('e') {
            return text;
        }
        // Zeros after the point, and then all six digits.
        let zeros = if value.abs() < 0.01 { 2 } else { 1 };
        return format!("{value:.*}", DIGITS + zeros);
    }
    let scientific = format!("{value:.*e}", DIGITS - 1);
    match scientific.split_once('e') {
        Some((mantissa, exponent)) => format!("{mantissa}·10{}", superscript(exponent)),
        None => scientific,
    }
}

fn superscript(exponent: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent
        .chars()
        .map(|c| match c.to_digit(10) {
            Some(digit) => usize::try_from(digit).ok().and_then(|d| RAISED.get(d).copied()).unwrap_or(c),
            None => '⁻',
        })
        .collect()
}
