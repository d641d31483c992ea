//! From the words of a heading to its columns.

use super::tokens::Word;
use crate::channel::{Channel, ChannelUnit, heading_at, plain, unit_of};
use crate::table::{TextPlace, TextRefusal};

/// A heading, recognised.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Head {
    pub(crate) text: String,
    pub(crate) channel: Channel,
    /// Those named in it, the second that of numbers in brackets.
    pub(crate) units: Vec<ChannelUnit>,
    pub(crate) place: TextPlace,
}

impl Head {
    /// Its unit, and that of values in brackets.
    pub(crate) fn unit(&self) -> Result<(ChannelUnit, Option<ChannelUnit>), TextRefusal> {
        let mut fitting = self.units.iter().copied().filter(|unit| self.channel.takes(unit));
        let first = fitting.next().or_else(|| self.channel.own_unit());
        let unit = first.ok_or_else(|| TextRefusal::Unit {
            heading: self.text.clone(),
            place: self.place,
            channel: self.channel.name(),
            units: self.channel.units().join(", "),
        })?;
        Ok((unit, fitting.next()))
    }
}

/// One of the words into which a word of a heading falls.
struct Part<'a> {
    plain: String,
    /// Of which word.
    of: &'a Word,
    within: bool,
}

/// The columns that these words name, in order; the words before the first are a title.
pub(crate) fn heads(words: &[Word]) -> Vec<Head> {
    let mut parts = Vec::new();
    for word in words {
        let plain = plain(&word.text);
        let of_word = plain.split_whitespace();
        parts.extend(of_word.map(|part| Part { plain: part.to_owned(), of: word, within: word.within }));
    }
    let mut found: Vec<Head> = Vec::new();
    let mut at = 0;
    while at < parts.len() {
        let free: Vec<&str> =
            parts[at..].iter().take_while(|part| !part.within).map(|part| part.plain.as_str()).collect();
        let part = &parts[at];
        // "Engine speed, rpm": a unit behind a heading that may have it is no further heading.
        let is_unit = found.last().is_some_and(|head: &Head| {
            unit_of(&part.plain).is_some_and(|unit| head.channel.takes(&unit) && head.units.is_empty())
        });
        match heading_at(&free).filter(|_| !is_unit) {
            Some((channel, count)) => {
                let text = String::new();
                found.push(Head { text, channel, units: Vec::new(), place: part.of.place });
                for part in &parts[at..at + count] {
                    add(&mut found, part);
                }
                at += count;
            }
            None => {
                if let Some(head) = found.last_mut() {
                    head.units.extend(unit_of(&part.plain));
                }
                add(&mut found, part);
                at += 1;
            }
        }
    }
    found
}

/// Adds a word to the text of the last heading, once.
fn add(found: &mut [Head], part: &Part<'_>) {
    if let Some(head) = found.last_mut() {
        let word = part.of.text.as_str();
        if head.text.ends_with(word) && !head.text.is_empty() {
            return;
        }
        if !head.text.is_empty() {
            head.text.push(' ');
        }
        head.text.push_str(word);
    }
}
