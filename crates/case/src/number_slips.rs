//! Recognises other number notations, such as `1,234.5` or `5'11"`, only to suggest the accepted one.

use crate::number::split_number;
use crate::units::read_unit;
use inputs::{Dimension, format_number};

/// Signs between a number and its deviation, and between the two ends of a range. Longer signs come first.
const PLUS_MINUS: [&str; 3] = ["+/-", "+-", "±"];
const FROM_TO: [&str; 6] = ["…", "–", "—", "−", " to ", "-"];

/// Fractions that are one character.
const FRACTIONS: [(char, f64); 3] = [('½', 0.5), ('¼', 0.25), ('¾', 0.75)];

/// What to write in place of "25 mph +- 2" or "20-30 mph"; `dimension` is `None` for a plain number.
pub(crate) fn range(text: &str, dimension: Option<Dimension>) -> Option<String> {
    // Spaces at both ends, so that " to " is found after a number without a unit.
    let text = format!(" {} ", text.trim());
    let (first, rest) = number(text.trim_start())?;
    let rest = format!(" {rest}");
    let split = |signs: &[&str]| {
        signs.iter().find_map(|sign| {
            let (between, after) = rest.split_once(sign)?;
            let (second, end) = number(after.trim_start().trim_start_matches('+'))?;
            Some((between.trim().to_owned(), second, end.trim().to_owned()))
        })
    };
    let (is_spread, (between, second, end)) = split(&PLUS_MINUS)
        .map(|parts| (true, parts))
        .or_else(|| split(&FROM_TO).map(|parts| (false, parts)))?;
    let quoted = |number: f64, unit: &str| match dimension {
        Some(_) => format!("\"{} {unit}\"", format_number(number)),
        None => format_number(number),
    };
    let is_unit = |text: &str| match dimension {
        Some(dimension) => read_unit(text, dimension).is_some(),
        None => text.is_empty(),
    };
    if is_spread && end == "%" && is_unit(&between) {
        let value = quoted(first, &between);
        return Some(format!(
            "{{ value = {value}, within = \"{} %\", confidence = 0.95 }}",
            format_number(second)
        ));
    }
    // The unit is after one of the numbers, or after both.
    let own = if between.is_empty() { &end } else { &between };
    let other = if end.is_empty() { &between } else { &end };
    if !(is_unit(own) && is_unit(other)) {
        return None;
    }
    if !is_spread {
        return Some(format!("{{ low = {}, high = {} }}", quoted(first, own), quoted(second, other)));
    }
    let spread = format!("{{ value = {}, sd = {} }}", quoted(first, own), quoted(second, other));
    if own != other {
        return Some(spread);
    }
    let (low, high) = (rounded(first - second), rounded(first + second));
    Some(format!(
        "{spread} if the ± is a standard deviation, or {{ low = {}, high = {} }} if it is a limit",
        quoted(low, own),
        quoted(high, own)
    ))
}

/// The plain number in a text such as "8 %", ".08", "0,08" or "½"; it is 0.08 for the first three. Full-width
/// digits and the typographic minus sign are accepted.
pub(crate) fn plain(text: &str) -> Option<f64> {
    let text: String = text.trim().chars().map(keyboard).collect();
    let (text, share) = match text.strip_suffix('%') {
        Some(text) => (text.trim_end(), 0.01),
        None => (text.as_str(), 1.0),
    };
    let (sign, unsigned) = match text.strip_prefix('-') {
        Some(unsigned) => (-1.0, unsigned),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    if !unsigned
        .starts_with(|c: char| c.is_ascii_digit() || c == '.' || FRACTIONS.iter().any(|(sign, _)| *sign == c))
    {
        return None;
    }
    let digits_only = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let magnitude = match unsigned.split_once(',') {
        // A comma before three digits may separate thousands.
        Some((whole, fraction)) if digits_only(whole) && digits_only(fraction) => {
            let is_decimal = fraction.len() != 3 || whole == "0";
            is_decimal.then(|| format!("{whole}.{fraction}")).and_then(|text| text.parse().ok())
        }
        _ => match amount(unsigned)? {
            (magnitude, _, "") => Some(magnitude),
            _ => None,
        },
    }?;
    let number = sign * magnitude * share;
    // The digits of "8 %" times 0.01, without the rounding of the product.
    let shown = if share < 1.0 { format!("{number:.12}").parse().unwrap_or(number) } else { number };
    shown.is_finite().then_some(shown)
}

/// A quantity with full-width digits or typographic signs, in the characters of the keyboard: "5 in" for
/// "５ in".
pub(crate) fn typed(text: &str, dimension: Dimension) -> Option<String> {
    let typed: String = text.chars().map(keyboard).collect();
    let (number, unit) = split_number(&typed);
    Some(format!("{} {}", format_number(number?), read_unit(unit.trim(), dimension)?))
}

/// The keyboard character for one that looks like it: full-width digits, point and comma, and dashes used as
/// a minus sign.
pub(crate) fn keyboard(letter: char) -> char {
    match letter {
        '−' | '–' | '‐' | '‑' | '﹣' | '－' => '-',
        '\u{a0}' | '\u{2009}' | '\u{202f}' | '\u{3000}' => ' ',
        // U+FF01 to U+FF5E are ASCII in full width.
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(u32::from(letter) - 0xfee0).unwrap_or(letter),
        other => other,
    }
}

/// One decimal number for digits in groups: "1450.5 kg" for "1.450,5 kg", "1,450.5 kg", "1 450.5 kg" and
/// "1'450.5 kg". A single comma or point may be either sign, so nothing is suggested.
pub(crate) fn grouped(text: &str, dimension: Dimension) -> Option<String> {
    let text: String = text.trim().chars().map(keyboard).collect();
    let text = text.replace('’', "'");
    let (sign, unsigned) = match text.strip_prefix('-') {
        Some(unsigned) => ("-", unsigned),
        None => ("", text.strip_prefix('+').unwrap_or(&text)),
    };
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, ',' | '.' | ' ' | '\'');
    let (number, unit) = unsigned.split_at(unsigned.find(|c| !is_of_number(c))?);
    let unit = read_unit(unit.trim(), dimension)?;
    let number = number.trim_end();
    let between = number.chars().find(|c| !c.is_ascii_digit())?;
    let (groups, fraction) = match number.rfind([',', '.']) {
        Some(place) if !number[place..].starts_with(between) => (&number[..place], &number[place + 1..]),
        _ => (number, ""),
    };
    let groups: Vec<&str> = groups.split(between).collect();
    let (first, others) = groups.split_first()?;
    let is_digits =
        |text: &str, most: usize| text.len() <= most && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_one_reading = !fraction.is_empty() || others.len() > 1 || !matches!(between, ',' | '.');
    let is_grouped = !first.is_empty()
        && is_digits(first, 3)
        && !others.is_empty()
        && others.iter().all(|group| group.len() == 3 && is_digits(group, 3))
        && is_digits(fraction, fraction.len());
    let point = if fraction.is_empty() { "" } else { "." };
    (is_one_reading && is_grouped).then(|| format!("{sign}{}{point}{fraction} {unit}", groups.concat()))
}

/// One decimal number for a fraction, for feet and inches, or for a number with a mark of feet or inches:
/// "71.5 in" for "71 1/2 in", "74 in" for `6' 2"`.
pub(crate) fn decimal(text: &str, dimension: Dimension) -> Option<String> {
    let text = text.replace(['′', '’'], "'").replace(['″', '”'], "\"").replace("''", "\"");
    let (first, is_fraction, rest) = amount(text.trim())?;
    let end = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
    let (unit, rest) = rest.split_at(end);
    let (unit, is_mark) = marked(unit.trim().trim_end_matches(['-', ',']).trim_end(), dimension)?;
    if rest.is_empty() {
        return (is_fraction || is_mark).then(|| format!("{} {unit}", format_number(first)));
    }
    let (second, _, rest) = amount(rest)?;
    let (inches, _) = if rest.trim().is_empty() { ("in", false) } else { marked(rest.trim(), dimension)? };
    let is_feet_and_inches = unit == "ft" && inches == "in" && dimension == Dimension::Length;
    // 1 ft = 12 in
    is_feet_and_inches.then(|| format!("{} in", format_number(rounded(12.0 * first + second))))
}

/// The unit of the mark of feet or inches after a list of numbers, if there is one.
pub(crate) fn mark(text: &str, dimension: Dimension) -> Option<&'static str> {
    match (text, dimension) {
        ("'" | "′" | "’", Dimension::Length) => Some("ft"),
        ("\"" | "″" | "”" | "''", Dimension::Length) => Some("in"),
        _ => None,
    }
}

/// The unit, and whether it was a mark.
fn marked(text: &str, dimension: Dimension) -> Option<(&'static str, bool)> {
    mark(text, dimension)
        .map(|unit| (unit, true))
        .or_else(|| read_unit(text, dimension).map(|unit| (unit.spelling(), false)))
}

/// A number without sign, perhaps with a fraction, whether it has one, and the rest of the text.
fn amount(text: &str) -> Option<(f64, bool, &str)> {
    let vulgar = |text: &str| {
        let first = text.chars().next()?;
        FRACTIONS.iter().find(|(sign, _)| *sign == first).map(|(sign, value)| (*value, sign.len_utf8()))
    };
    if let Some((value, length)) = vulgar(text) {
        return Some((value, true, text[length..].trim_start()));
    }
    let (whole, rest) = number(text)?;
    let rest = rest.trim_start();
    if let Some((value, length)) = vulgar(rest) {
        return Some((whole + value, true, rest[length..].trim_start()));
    }
    if let Some(value) = rest.strip_prefix('/').and_then(|rest| quotient(whole, rest)) {
        return Some((value.0, true, value.1));
    }
    // The hyphen of "5-1/2 in".
    let after = rest.strip_prefix('-').unwrap_or(rest).trim_start();
    if let Some((above, below)) = number(after)
        && let Some((value, rest)) = below.strip_prefix('/').and_then(|below| quotient(above, below))
    {
        return Some((rounded(whole + value), true, rest));
    }
    Some((whole, false, rest))
}

fn quotient(above: f64, below: &str) -> Option<(f64, &str)> {
    let (below, rest) = number(below)?;
    (below > 0.0).then(|| (rounded(above / below), rest.trim_start()))
}

fn number(text: &str) -> Option<(f64, &str)> {
    let (number, rest) = split_number(text);
    number.filter(|number| number.is_finite()).map(|number| (number, rest))
}

/// The number to four decimals, more than any tape shows, without the rounding errors of the arithmetic.
fn rounded(number: f64) -> f64 {
    format!("{number:.4}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use inputs::Dimension;

    use super::{decimal, grouped, plain, range, typed};

    #[test]
    fn ranges_in_one_text_are_understood() {
        let spread = "{ value = \"25 mph\", sd = \"2 mph\" } if the ± is a standard deviation, or { low = \"23 mph\", high = \"27 mph\" } if it is a limit";
        let ends = "{ low = \"20 mph\", high = \"30 mph\" }";
        for (text, wanted) in [
            ("25 mph +- 2", spread),
            ("25 +/- 2 mph", spread),
            ("25±2mph", spread),
            ("25 mph ± 2 mph", spread),
            ("25 mph ± 5 ft/s", "{ value = \"25 mph\", sd = \"5 ft/s\" }"),
            ("25 mph ± 10 %", "{ value = \"25 mph\", within = \"10 %\", confidence = 0.95 }"),
            ("20-30 mph", ends),
            ("20 – 30 mph", ends),
            ("20 mph - 30 mph", ends),
            ("20 to 30 mph", ends),
            ("20 mph to 30 mph", ends),
            ("20…30 mph", ends),
            ("-20 - -10 mph", "{ low = \"-20 mph\", high = \"-10 mph\" }"),
        ] {
            assert_eq!(range(text, Some(Dimension::Speed)).as_deref(), Some(wanted), "{text}");
        }
        assert_eq!(range("0.2-0.4", None).as_deref(), Some("{ low = 0.2, high = 0.4 }"));
        assert_eq!(
            range("0.3 ± 0.1", None).as_deref(),
            Some(
                "{ value = 0.3, sd = 0.1 } if the ± is a standard deviation, or { low = 0.2, high = 0.4 } if it is a limit"
            )
        );
        for text in ["25 mph", "25 mph -", "about 25 mph", "25 m - 30 mph", "1e-3 mph", "25 to", ""] {
            assert_eq!(range(text, Some(Dimension::Speed)), None, "{text}");
        }
    }

    #[test]
    fn plain_numbers_of_other_notations_are_understood() {
        for (text, wanted) in [
            ("8 %", 0.08),
            ("45%", 0.45),
            (".08", 0.08),
            ("1.", 1.0),
            ("05", 5.0),
            ("0,08", 0.08),
            ("1,5", 1.5),
            ("0,125", 0.125),
            ("−0.5", -0.5),
            ("–3", -3.0),
            ("０．３", 0.3),
            ("½", 0.5),
            ("1/4", 0.25),
            ("1e-3", 0.001),
        ] {
            assert_eq!(plain(text), Some(wanted), "{text}");
        }
        // Separators of thousands, and texts that are not numbers.
        for text in ["1,500", "1,2,3", "8 in", "inf", "nan", "", "%", "-", "e5", "1e999", "0x10"] {
            assert_eq!(plain(text), None, "{text}");
        }
    }

    #[test]
    fn what_looks_like_the_keyboard_is_typed() {
        assert_eq!(typed("５．５\u{3000}in", Dimension::Length).as_deref(), Some("5.5 in"));
        assert_eq!(typed("–5\u{a0}mph", Dimension::Speed).as_deref(), Some("-5 mph"));
        assert_eq!(typed("５ mph", Dimension::Length), None);
        assert_eq!(typed("five in", Dimension::Length), None);
    }

    #[test]
    fn fractions_and_feet_with_inches_become_one_number() {
        for (text, wanted) in [
            ("71 1/2 in", "71.5 in"),
            ("71-1/2 in", "71.5 in"),
            ("71½ in", "71.5 in"),
            ("1/2 in", "0.5 in"),
            ("¾\"", "0.75 in"),
            ("6 ft 0 in", "72 in"),
            ("6 feet, 2 inches", "74 in"),
            ("6'", "6 ft"),
            ("4\"", "4 in"),
            ("5'11\"", "71 in"),
            ("5′ 11 1/2″", "71.5 in"),
            ("5'-11", "71 in"),
            ("6 1/3 ft", "6.3333 ft"),
        ] {
            assert_eq!(decimal(text, Dimension::Length).as_deref(), Some(wanted), "{text}");
        }
        assert_eq!(decimal("35 1/2 mph", Dimension::Speed).as_deref(), Some("35.5 mph"));
        for text in ["71 in", "6 m 2 in", "1/0 in", "6 3 ft", "1.2.3 ft", "6 in 2 ft", "6' 2 m", ""] {
            assert_eq!(decimal(text, Dimension::Length), None, "{text}");
        }
        assert_eq!(decimal("6'", Dimension::Speed), None);
    }

    #[test]
    fn digits_in_groups_are_one_number() {
        for (text, wanted) in [
            ("1.450,5 kg", Some("1450.5 kg")),
            ("1,450.5 kg", Some("1450.5 kg")),
            ("1 450 kg", Some("1450 kg")),
            ("1\u{202f}450,25 kg", Some("1450.25 kg")),
            ("1'450 kg", Some("1450 kg")),
            ("-12.345.678 kg", Some("-12345678 kg")),
            // Each of these may be two numbers, or a decimal sign.
            ("1,450 kg", None),
            ("1.450 kg", None),
            ("9 10 kg", None),
            ("1.45,5 kg", None),
            ("1 450 mph", None),
        ] {
            assert_eq!(grouped(text, Dimension::Mass).as_deref(), wanted, "{text}");
        }
    }
}
