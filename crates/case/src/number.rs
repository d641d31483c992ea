//! Numbers as a case writes them.

use std::ops::Range;

/// Takes the longest number off the front: sign, digits, point, exponent. The number is `None` if there is
/// none.
pub(crate) fn split_number(text: &str) -> (Option<f64>, &str) {
    let digits = |s: &str| s.len() - s.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    // The minus sign of print (U+2212) comes in with text copied from a paper.
    let (sign, unsigned) = match text.strip_prefix(['-', '−']) {
        Some(unsigned) => (-1.0, unsigned),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    let whole = digits(unsigned);
    let mut end = whole;
    if unsigned[end..].starts_with('.') {
        let fraction = digits(&unsigned[end + 1..]);
        if whole + fraction == 0 {
            return (None, text);
        }
        end += 1 + fraction;
    }
    if end == 0 {
        return (None, text);
    }
    if let Some(exponent) = unsigned[end..].strip_prefix(['e', 'E']) {
        let unsigned_exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
        let length = digits(unsigned_exponent);
        if length > 0 {
            end += 1 + (exponent.len() - unsigned_exponent.len()) + length;
        }
    }
    let (number, rest) = unsigned.split_at(end);
    (number.parse::<f64>().ok().map(|magnitude| sign * magnitude), rest)
}

/// The numbers at the beginning of a text, each with its place, and what comes after the last.
pub(crate) fn leading_numbers(text: &str) -> (Vec<(f64, Range<usize>)>, &str) {
    let mut numbers = Vec::new();
    let mut rest = text.trim_start();
    while let (Some(number), after) = split_number(rest) {
        let end = text.len() - after.len();
        numbers.push((number, text.len() - rest.len()..end));
        rest = after.trim_start();
        if rest.len() == after.len() {
            // No space: what follows is not a further number, but a unit, or a typo such as "1.2.3".
            break;
        }
    }
    (numbers, rest.trim())
}
