//! Separate columns, each with its unit after its values: `"-1 -0.5 0 s"`.

use super::heads::Head;
use super::raw::RawTable;
use super::tokens::{Piece, Token, line};
use crate::channel::{Channel, unit_of};
use crate::table::{TextFault, TextLayout, TextPlace, TextRefusal};

/// The table of columns of these channels. Places are those in the text of each.
pub(crate) fn table(columns: &[(Channel, &str)]) -> RawTable {
    let column = |(channel, text): &(Channel, &str)| {
        let mut cells = Vec::new();
        let mut units = Vec::new();
        for (k, content) in text.lines().enumerate() {
            for piece in line(content, k + 1) {
                match piece {
                    Piece::Value(token) => cells.push(token),
                    Piece::Word(word) => match unit_of(&word.text) {
                        Some(unit) => units.push(unit),
                        // A word that is neither a value nor a unit is a cell without a value.
                        None => cells.push(Token { text: word.text, bracket: None, place: word.place }),
                    },
                }
            }
        }
        let place = TextPlace { line: 1, column: 1 };
        (Head::of(channel.key().to_owned(), *channel, units, place), cells)
    };
    let columns = columns.iter().map(column).collect();
    RawTable { layout: TextLayout::Columns, columns, ignored: Vec::new() }
}

/// The refusal of a list whose values have no unit that fits them.
pub(crate) fn without_unit(head: &Head) -> TextRefusal {
    let channel = head.channel;
    TextFault::UnitOfList { channel: channel.name(), units: channel.units().join(", ") }.at(head.place)
}
