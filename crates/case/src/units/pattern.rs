//! The texts that a quantity is read from, as regular expressions for an editor: `read_quantity` in the
//! language of JSON Schema (ECMA 262), without its magnitudes.

use super::spelling::{WORDS, is_free, is_pound_a_force};
use inputs::{Bounds, Dimension};

/// Digits with a point, and an exponent.
const MAGNITUDE: &str = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)";
/// The same, and not zero.
const MAGNITUDE_NOT_ZERO: &str = r"(?:0*[1-9][0-9]*\.?[0-9]*|0*\.0*[1-9][0-9]*)";
const EXPONENT: &str = "(?:[eE][+-]?[0-9]+)?";
/// Allowed between the units of a product, and ignored elsewhere.
const GAP: &str = r"[\s·⋅*-]";

/// The hour of a clock.
pub(crate) const HOUR: &str = r"^\s*\+?0*(?:[1-9]|1[0-2])\s*o['’]clock\s*$";

/// A percentage.
pub(crate) fn percent_pattern(bounds: Bounds) -> String {
    format!(r"^\s*{}\s*%\s*$", number(bounds))
}

/// One number with a unit of the dimension.
pub(crate) fn pattern(dimension: Dimension, bounds: Bounds) -> String {
    format!(r"^\s*{}{GAP}*(?:{}){GAP}*$", number(bounds), units(dimension))
}

/// At least `least` numbers, with the unit of all of them after the last.
pub(crate) fn list_pattern(dimension: Dimension, bounds: Bounds, least: usize) -> String {
    let number = number(bounds);
    let more = least.saturating_sub(1);
    format!(r"^\s*{number}(?:\s+{number}){{{more},}}{GAP}*(?:{}){GAP}*$", units(dimension))
}

fn number(bounds: Bounds) -> String {
    match bounds {
        Bounds::Positive => format!(r"\+?{MAGNITUDE_NOT_ZERO}{EXPONENT}"),
        // Minus zero is zero.
        Bounds::NotNegative => format!(r"(?:\+?{MAGNITUDE}|[-−](?:0+\.?0*|\.0+)){EXPONENT}"),
        _ => format!("[-+−]?{MAGNITUDE}{EXPONENT}"),
    }
}

/// The units of a dimension, with every spelling of each.
fn units(dimension: Dimension) -> String {
    let spellings = dimension.units().iter().flat_map(|unit| unit.spellings());
    let mut alternatives: Vec<String> = Vec::new();
    for spelling in spellings {
        let alternative = unit(spelling, dimension);
        if !alternatives.contains(&alternative) {
            alternatives.push(alternative);
        }
    }
    alternatives.join("|")
}

/// One spelling of the table, with its accepted variations.
fn unit(spelling: &str, dimension: Dimension) -> String {
    let mut out = String::new();
    let mut rest = spelling;
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|c: char| !c.is_alphabetic()).unwrap_or(rest.len());
        if end > 0 {
            let (name, tail) = rest.split_at(end);
            let word = word(name, is_pound_a_force(spelling, dimension), dimension);
            rest = tail;
            match tail.strip_prefix("^0.5") {
                Some(tail) => {
                    out += &root(&word);
                    rest = tail;
                }
                None => out += &word,
            }
            continue;
        }
        let (sign, tail) = match rest.strip_prefix("^2") {
            Some(tail) => (format!(r"(?:{GAP}*\^{GAP}*2|{GAP}*²|2)"), tail),
            None if first == '/' => (format!("{GAP}*/{GAP}*"), &rest[1..]),
            None => (format!("{GAP}+"), &rest[first.len_utf8()..]),
        };
        out += &sign;
        rest = tail;
    }
    out
}

/// The short form of a unit, or one of its words.
fn word(short: &str, is_pound_a_force: bool, dimension: Dimension) -> String {
    let long = WORDS.iter().find(|(known, _)| *known == short).map_or(&[][..], |(_, long)| long);
    let force = (short == "lb" && is_pound_a_force).then_some("lbf");
    let short_forms = std::iter::once(short).chain(force);
    let short_forms = short_forms.map(|form| in_any_case(form, |letter| is_free(letter, form, dimension)));
    let words = long.iter().map(|word| in_any_case(word, |letter| letter.is_ascii_alphabetic()));
    let all: Vec<String> = short_forms.chain(words).collect();
    match &all[..] {
        [only] => only.clone(),
        all => format!("(?:{})", all.join("|")),
    }
}

/// The letters that are free in either case.
fn in_any_case(word: &str, is_free: impl Fn(char) -> bool) -> String {
    let letter = |letter: char| match is_free(letter) {
        true => format!("[{}{}]", letter.to_ascii_lowercase(), letter.to_ascii_uppercase()),
        false => letter.to_string(),
    };
    word.chars().map(letter).collect()
}

fn root(word: &str) -> String {
    let half = format!(r"(?:{GAP}*\^(?:\(1/2\)|1/2|½|\.5|{GAP}*0\.5)|{GAP}*½)");
    format!(r"(?:{word}{half}|(?:√|sqrt)\({GAP}*{word}{GAP}*\)|√{word})")
}
