//! Spellings: which variations are accepted, and which unit a misspelt one was meant to be.

use inputs::{Dimension, Unit};

/// Words for a unit's short form, accepted wherever that form is: "feet/second" is "ft/s".
pub(super) const WORDS: &[(&str, &[&str])] = &[
    ("m", &["meter", "meters", "metre", "metres"]),
    ("ft", &["foot", "feet"]),
    ("in", &["inch", "inches"]),
    ("mi", &["mile", "miles"]),
    ("kg", &["kilogram", "kilograms", "kgs"]),
    ("lb", &["lbs", "pound", "pounds"]),
    ("slug", &["slugs"]),
    ("s", &["sec", "second", "seconds"]),
    ("h", &["hr", "hour", "hours"]),
    ("deg", &["°", "degree", "degrees"]),
    ("rad", &["radian", "radians"]),
    ("kn", &["knot", "knots"]),
    ("J", &["joule", "joules"]),
    ("kJ", &["kilojoule", "kilojoules"]),
];

/// Signs for other ways to type the same, replaced in this order.
const SIGNS: &[(&str, &str)] = &[
    ("²", "^2"),
    ("^(1/2)", "^0.5"),
    ("^1/2", "^0.5"),
    ("^½", "^0.5"),
    ("½", "^0.5"),
    ("^.5", "^0.5"),
    ("·", " "),
    ("⋅", " "),
    ("*", " "),
    ("-", " "),
];

/// The treatment of "lbf".
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Pound {
    /// It stays.
    AsWritten,
    /// It becomes "lb", as the table writes a force.
    Force,
}

/// Brings a unit into the form in which the table spells it; the result need not be in the table.
pub(super) fn normalise(spelling: &str, pound: Pound) -> String {
    let mut text = spelling.to_owned();
    for (sign, plain) in SIGNS {
        text = text.replace(sign, plain);
    }
    for root in ["√(", "sqrt("] {
        while let Some((before, after)) = text.split_once(root) {
            let Some((inside, rest)) = after.split_once(')') else { break };
            let inside = inside.trim();
            // A root of nothing is not a unit.
            if inside.is_empty() {
                break;
            }
            text = format!("{before}{inside}^0.5{rest}");
        }
    }
    while let Some((before, after)) = text.split_once('√') {
        let end = after.find(|c: char| !c.is_alphabetic()).unwrap_or(after.len());
        if end == 0 {
            break;
        }
        let (inside, rest) = after.split_at(end);
        text = format!("{before}{inside}^0.5{rest}");
    }

    let mut out = String::new();
    let mut rest = text.as_str();
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|c: char| is_word(c) != is_word(first)).unwrap_or(rest.len());
        let (piece, tail) = rest.split_at(end);
        if is_word(first) {
            out.push_str(short_word(piece, pound));
        } else {
            // A square typed without its sign: "N/cm2".
            if piece.starts_with('2') && out.ends_with(char::is_alphabetic) {
                out.push('^');
            }
            out.push_str(piece);
        }
        rest = tail;
    }
    let mut words = out.split_whitespace();
    let mut joined = words.next().unwrap_or_default().to_owned();
    for word in words {
        if !(word.starts_with(['/', '^']) || joined.ends_with(['/', '^'])) {
            joined.push(' ');
        }
        joined.push_str(word);
    }
    joined
}

fn is_word(c: char) -> bool {
    c.is_alphabetic() || c == '°'
}

fn short_word(word: &str, pound: Pound) -> &str {
    if word.eq_ignore_ascii_case("lbf") && pound == Pound::Force {
        return "lb";
    }
    let is_word = |long: &&str| long.eq_ignore_ascii_case(word);
    WORDS.iter().find(|(_, long)| long.iter().any(is_word)).map_or(word, |(short, _)| short)
}

/// Whether a short form is the one of the table, apart from capitals that do not change the meaning.
pub(super) fn is_spelled(known: &str, written: &str, dimension: Dimension) -> bool {
    let is_same =
        |(a, b): (u8, u8)| a == b || a.eq_ignore_ascii_case(&b) && is_free(char::from(a), known, dimension);
    known.len() == written.len() && known.bytes().zip(written.bytes()).all(is_same)
}

/// Whether a letter of a short form means the same as its capital: m is milli and M is mega, but not in a
/// speed, where kn is the knot and kN would be a force.
pub(super) fn is_free(letter: char, form: &str, dimension: Dimension) -> bool {
    letter.is_ascii_alphabetic()
        && form != "kn"
        && (dimension == Dimension::Speed || !letter.eq_ignore_ascii_case(&'m'))
}

/// Whether a unit is written with "lbf".
pub(super) fn has_pound_force(spelling: &str) -> bool {
    spelling.as_bytes().windows(3).any(|letters| letters.eq_ignore_ascii_case(b"lbf"))
}

/// Whether the "lb" in a spelling of the table is a pound-force, which may be written "lbf" there.
pub(super) fn is_pound_a_force(known: &str, dimension: Dimension) -> bool {
    match dimension {
        Dimension::Mass => false,
        // lb·ft·s² is a force by a length by the square of a time, lb·ft² a mass by the square of a length.
        Dimension::Inertia => known.contains("s^2"),
        _ => true,
    }
}

/// The unit of `dimension` that a misspelt one certainly means: it has the same letters and digits, apart
/// from capitals, spaces, signs or a long word.
///
/// A different letter or digit is more often another unit than a slip: "lb ft^2" is not "lb ft s^2", "kN/cm"
/// not "kN/m" and "fpm" not "fps". A wrong suggestion, once accepted, would be an error without a trace.
pub(crate) fn nearest_unit(spelling: &str, dimension: Dimension) -> Option<&'static Unit> {
    if spelling.len() > crate::nearest::LONGEST {
        return None;
    }
    let letters =
        |text: &str| text.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase();
    let wanted = letters(&normalise(&mend_words(spelling), Pound::AsWritten));
    // "mN" is not a slip for "MN": the one is a thousandth of a newton, the other a million.
    let is_meant = |known: &str| letters(known) == wanted && (!known.contains('M') || spelling.contains('M'));
    let mut near = dimension.units().iter().filter(|unit| unit.spellings().any(is_meant));
    match (near.next(), near.next()) {
        (Some(unit), None) => Some(unit),
        _ => None,
    }
}

/// Replaces a misspelt long word by the word it resembles: "feets/s" becomes "feet/s".
fn mend_words(spelling: &str) -> String {
    let long = || WORDS.iter().flat_map(|(_, long)| long.iter().copied()).filter(|word| word.len() > 3);
    let mut out = String::new();
    for piece in spelling.split_inclusive(|c| !is_word(c)) {
        let word = piece.trim_end_matches(|c| !is_word(c));
        // A short word is as near to several units: "incs" may be "inch" or "in s".
        out.push_str(if word.len() > 4 {
            crate::nearest::nearest(word, long()).unwrap_or(word)
        } else {
            word
        });
        out.push_str(&piece[word.len()..]);
    }
    out
}
