//! Words and values of a line, with their places.

use crate::channel::is_one_of;
use crate::table::TextPlace;

/// A value as printed, with the text in brackets after it: `50 [81]`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Token {
    pub(crate) text: String,
    pub(crate) bracket: Option<String>,
    pub(crate) place: TextPlace,
}

impl Token {
    pub(crate) fn is_empty(&self) -> bool {
        self.text.is_empty() && self.bracket.is_none()
    }
}

/// A word of a heading.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Word {
    pub(crate) text: String,
    /// Whether it is in brackets, which may contain units but no quantities.
    pub(crate) within: bool,
    pub(crate) place: TextPlace,
}

pub(crate) const ON: &str = "on, yes, engaged, active, applied, true, activated, pressed, depressed, ein";
pub(crate) const OFF: &str = "off, no, non-engaged, non engaged, not engaged, not active, not applied, \
    not pressed, not depressed, inactive, disengaged, released, false, aus";
/// Words that reports print for a value that the recorder does not have.
pub(crate) const NONE: &str = "data not available, data not valid, data invalid, not available, \
    not reported, no data, invalid, sna, n/a, na, nan, unknown, error, --, ---, —, -, ***";

/// The number that a text is, with a decimal point or comma, and commas between thousands if these may be.
pub(crate) fn number(text: &str, thousands: bool) -> Option<f64> {
    let text = text.replace(['−', '–'], "-");
    let text = text.strip_prefix('+').unwrap_or(&text).trim_end_matches('%');
    let digits = text.strip_prefix('-').unwrap_or(text);
    let is_plain = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    let mut groups = digits.split(',');
    let first = groups.next()?;
    let rest: Vec<&str> = groups.collect();
    let grouped = !rest.is_empty()
        && (1..=3).contains(&first.len())
        && is_plain(first)
        && rest.iter().all(|group| group.len() == 3 && is_plain(group));
    let plain = if grouped && (thousands || rest.len() > 1) {
        text.replace(',', "")
    } else if rest.len() == 1 && !digits.contains('.') {
        text.replace(',', ".")
    } else {
        text.to_owned()
    };
    let parts: Vec<&str> = plain.strip_prefix('-').unwrap_or(&plain).split('.').collect();
    let is_number = match parts.as_slice() {
        [whole] => is_plain(whole),
        [whole, part] => (is_plain(whole) || whole.is_empty()) && is_plain(part),
        _ => false,
    };
    is_number.then(|| plain.parse().ok()).flatten()
}

/// Marks after a value that point to a note.
const MARKS: [char; 8] = ['*', '†', '‡', '§', '¹', '²', '³', '#'];

/// A value without marks that point to a note: `49*`, `On (1)`.
pub(crate) fn bare(text: &str) -> &str {
    let mut bare = text.trim();
    loop {
        let unmarked = bare.trim_end_matches(MARKS).trim_end();
        let next = match unmarked.strip_suffix(')').and_then(|inner| inner.rsplit_once('(')) {
            Some((value, _)) => value.trim_end(),
            None => unmarked,
        };
        // A text of nothing but marks, such as "***", has none.
        if next.is_empty() || next == bare {
            return bare;
        }
        bare = next;
    }
}

pub(crate) fn is_value(text: &str) -> bool {
    is_exactly_value(bare(text))
}

/// Whether a text is a value with nothing after it.
fn is_exactly_value(text: &str) -> bool {
    let lower = text.to_lowercase();
    let text = lower.as_str();
    number(text, true).is_some() || [ON, OFF, NONE].iter().any(|words| is_one_of(words, text))
}

/// The pieces of a line between blanks, with their column.
fn pieces(line: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut begin: Option<(usize, usize)> = None;
    let mut column = 0;
    for (at, letter) in line.char_indices() {
        column += 1;
        match (letter.is_whitespace(), begin) {
            (true, Some((from, first))) => {
                found.push((first, &line[from..at]));
                begin = None;
            }
            (false, None) => begin = Some((at, column)),
            _ => {}
        }
    }
    if let Some((from, first)) = begin {
        found.push((first, &line[from..]));
    }
    found
}

/// A piece of flowing text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Piece {
    Value(Token),
    Word(Word),
}

/// The values and words of a line. Words that mean one value together are one, a number in brackets belongs
/// to the value before it, and `(TRG)` to the time zero.
pub(crate) fn line(text: &str, number_of_line: usize) -> Vec<Piece> {
    let pieces = pieces(text);
    let mut found: Vec<Piece> = Vec::new();
    let (mut at, mut depth) = (0, 0_i32);
    while let Some(&(column, piece)) = pieces.get(at) {
        let place = TextPlace { line: number_of_line, column };
        let unmarked = piece.trim_end_matches(MARKS);
        let inner = unmarked.strip_prefix('[').and_then(|piece| piece.strip_suffix(']'));
        let trigger = piece.trim_matches(|c| "()[]".contains(c)).eq_ignore_ascii_case("trg");
        let joined = |count: usize| {
            let words: Option<Vec<&str>> =
                (at..at + count).map(|k| pieces.get(k).map(|(_, piece)| *piece)).collect();
            words.map(|words| words.join(" "))
        };
        let value = (depth == 0)
            .then(|| {
                [3, 2, 1].into_iter().find_map(|count| {
                    // "-1 ***" is two values, and no marked one.
                    let is_one = if count == 1 { is_value } else { is_exactly_value };
                    Some((count, joined(count).filter(|all| is_one(all))?))
                })
            })
            .flatten();
        // 36 / 58, with both units in the heading; alone in its line, it is the number of a page.
        let second =
            |at: usize| pieces.get(at).map(|(_, piece)| *piece).filter(|piece| number(piece, true).is_some());
        if let (true, "/", Some(second), Some(Piece::Value(token))) =
            (depth == 0 && pieces.len() > 3, piece, second(at + 1), found.last_mut())
            && number(&token.text, true).is_some()
        {
            token.bracket = Some(second.to_owned());
            at += 2;
            continue;
        }
        // A mark that stands apart from its value fills no cell.
        if depth == 0
            && unmarked.is_empty()
            && value.is_none()
            && matches!(found.last(), Some(Piece::Value(_)))
        {
            at += 1;
            continue;
        }
        match (value, inner) {
            (Some((count, text)), _) => {
                found.push(Piece::Value(Token { text, bracket: None, place }));
                at += count;
                continue;
            }
            (None, Some(inner)) if depth == 0 && is_value(inner) => {
                if let Some(Piece::Value(token)) = found.last_mut() {
                    token.bracket = Some(inner.to_owned());
                } else {
                    found.push(Piece::Value(Token {
                        text: String::new(),
                        bracket: Some(inner.to_owned()),
                        place,
                    }));
                }
            }
            _ if trigger && depth == 0 => {
                let zero = matches!(found.last(), Some(Piece::Value(token)) if number(&token.text, true) == Some(0.0));
                if !zero {
                    found.push(Piece::Value(Token { text: "0".to_owned(), bracket: None, place }));
                }
            }
            _ => {
                let mut within = depth > 0;
                for letter in piece.chars() {
                    match letter {
                        '(' | '[' => depth += 1,
                        ')' | ']' => depth = (depth - 1).max(0),
                        _ => continue,
                    }
                    within = true;
                }
                // A word followed by its unit, `Speed(km/h)`, is two.
                match piece.find(['(', '[']).filter(|from| *from > 0) {
                    Some(from) => {
                        let (name, unit) = piece.split_at(from);
                        found.push(Piece::Word(Word { text: name.to_owned(), within: false, place }));
                        found.push(Piece::Word(Word { text: unit.to_owned(), within: true, place }));
                    }
                    None => found.push(Piece::Word(Word { text: piece.to_owned(), within, place })),
                }
            }
        }
        at += 1;
    }
    found
}
