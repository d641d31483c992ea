//! The cells of a line of flowing text with words among the values.

use super::tokens::{OFF, ON, Piece, Token, Word, bare, number};
use crate::channel::{heading_at, is_one_of, plain, unit_of};

/// Signs that may precede a number and make it a bound.
const QUALIFIERS: [&str; 10] = [">", ">=", "<", "<=", "≥", "≤", "=", "~", "≈", "±"];

/// A cell of a line, and whether it has no value in it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cell {
    pub(super) token: Token,
    pub(super) is_word: bool,
}

impl Cell {
    fn of(word: &Word) -> Self {
        Self { token: Token { text: word.text.clone(), bracket: None, place: word.place }, is_word: true }
    }

    fn is_number(&self) -> bool {
        !self.is_word && number(bare(&self.token.text), true).is_some()
    }

    fn is_switch(&self) -> bool {
        let state = bare(&self.token.text).to_lowercase();
        is_one_of(ON, &state) || is_one_of(OFF, &state)
    }

    /// Whether its words name a quantity.
    fn is_name(&self) -> bool {
        let plain = plain(&self.token.text);
        let words: Vec<&str> = plain.split_whitespace().collect();
        heading_at(&words).is_some_and(|(_, count)| count == words.len())
    }

    /// Appends these words to its text, and to the text in brackets.
    fn followed_by(&mut self, words: &str) {
        for text in [Some(&mut self.token.text), self.token.bracket.as_mut()].into_iter().flatten() {
            *text = format!("{text} {words}").trim_start().to_owned();
        }
    }

    /// Puts these words before its text, at their place.
    fn led_by(&mut self, before: &Self) {
        let words = &before.token.text;
        for text in [Some(&mut self.token.text), self.token.bracket.as_mut()].into_iter().flatten() {
            *text = format!("{words} {text}").trim_end().to_owned();
        }
        self.token.place = before.token.place;
    }
}

/// The cells of a line: values with the text in brackets after them, with the sign of a bound before them,
/// and with their unit if `with_units`; other words are cells of their own.
fn split(pieces: &[Piece], with_units: bool) -> Vec<Cell> {
    let mut cells: Vec<Cell> = Vec::new();
    for piece in pieces {
        match (piece, cells.last_mut()) {
            (Piece::Value(token), last) => {
                let mut cell = Cell { token: token.clone(), is_word: false };
                if last.is_some_and(|last| QUALIFIERS.contains(&last.token.text.as_str()))
                    && let Some(sign) = cells.pop()
                {
                    cell.led_by(&sign);
                }
                cells.push(cell);
            }
            (Piece::Word(word), Some(last)) if word.within => last.followed_by(&word.text),
            (Piece::Word(word), Some(last))
                if with_units && last.is_number() && unit_of(&word.text).is_some() =>
            {
                last.followed_by(&word.text);
            }
            (Piece::Word(word), _) => cells.push(Cell::of(word)),
        }
    }
    cells
}

/// The cells of a line, each value with its unit.
pub(super) fn cells(pieces: &[Piece]) -> Vec<Cell> {
    split(pieces, true)
}

/// Words that follow each other as one cell: "Sensor Fault".
fn phrases(cells: Vec<Cell>) -> Vec<Cell> {
    let mut found: Vec<Cell> = Vec::new();
    for cell in cells {
        match found.last_mut().filter(|last| last.is_word && cell.is_word) {
            Some(last) => last.followed_by(&cell.token.text),
            None => found.push(cell),
        }
    }
    found
}

/// Phrases with the value that they belong to: "126 or greater", "Brake On".
fn with_values(cells: Vec<Cell>) -> Vec<Cell> {
    let mut found: Vec<Cell> = Vec::new();
    for mut cell in cells {
        let named = cell.is_switch() && found.last().is_some_and(|last| last.is_word && last.is_name());
        match found.last_mut() {
            Some(last) if named => {
                cell.led_by(last);
                *last = cell;
            }
            _ => found.push(cell),
        }
    }
    let mut joined: Vec<Cell> = Vec::new();
    for cell in found {
        match joined.last_mut().filter(|_| cell.is_word) {
            Some(last) => last.followed_by(&cell.token.text),
            None => joined.push(cell),
        }
    }
    joined
}

/// The line as `width` cells, if it can be read so and at least half of them have a value.
pub(super) fn fitted(pieces: &[Piece], width: usize) -> Option<Vec<Token>> {
    let [with_units, without] = [true, false].map(|with_units| split(pieces, with_units));
    let joined = phrases(with_units.clone());
    let all = [with_units, without, joined.clone(), with_values(joined)];
    let fits = |cells: &Vec<Cell>| {
        cells.len() == width && cells.iter().filter(|cell| cell.is_word).count() * 2 <= width
    };
    all.into_iter().find(fits).map(tokens)
}

pub(super) fn tokens(cells: Vec<Cell>) -> Vec<Token> {
    cells.into_iter().map(|cell| cell.token).collect()
}
