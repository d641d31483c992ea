//! From the words of a heading to its columns.

use std::cmp::Reverse;
use std::ops::Range;

use super::tokens::{OFF, ON, Word, number};
use crate::channel::{Axis, Channel, ChannelUnit, denies, heading_at, is_one_of, plain, unit_of};
use crate::table::{TextFault, TextPlace, TextRefusal};

/// A heading, recognised.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Head {
    pub(crate) text: String,
    pub(crate) channel: Channel,
    /// The units named in it, the second that of numbers in brackets.
    pub(crate) units: Vec<ChannelUnit>,
    pub(crate) place: TextPlace,
    /// The words that name the quantity.
    named: Vec<String>,
    /// The words next to them, which narrow it down or show that it is another quantity.
    beside: Vec<String>,
    /// Words in brackets.
    bracketed: Vec<String>,
}

impl Head {
    /// A heading without further words.
    pub(crate) fn of(text: String, channel: Channel, units: Vec<ChannelUnit>, place: TextPlace) -> Self {
        let [named, beside, bracketed] = [const { Vec::new() }; 3];
        Self { text, channel, units, place, named, beside, bracketed }
    }

    /// Its unit, and that of values in brackets.
    pub(crate) fn unit(&self) -> Result<(ChannelUnit, Option<ChannelUnit>), TextRefusal> {
        let mut fitting = self.units.iter().copied().filter(|unit| self.channel.takes(unit));
        let first = fitting.next().or_else(|| self.channel.own_unit());
        let unit = first.ok_or_else(|| {
            let (heading, channel) = (self.text.clone(), self.channel.name());
            TextFault::Unit { heading, channel, units: self.channel.units().join(", ") }.at(self.place)
        })?;
        Ok((unit, fitting.next()))
    }

    /// How well its words match its quantity, the smallest being the best: with the fewest other words and,
    /// among equals, with the most matching words.
    pub(crate) fn rank(&self) -> (usize, Reverse<usize>) {
        (self.beside.len(), Reverse(self.named.len()))
    }

    /// The number of words that name the quantity.
    pub(crate) fn named(&self) -> usize {
        self.named.len()
    }

    /// One heading from several in one field or line: that with the longest name, with the others as
    /// additional words.
    fn joined(all: &[Self]) -> Option<Self> {
        let longest = all.iter().rev().max_by_key(|head| head.named.len())?;
        let mut whole = Self { place: all.first()?.place, ..longest.clone() };
        let texts: Vec<&str> = all.iter().map(|head| head.text.as_str()).collect();
        whole.text = texts.join(" ");
        for other in all.iter().filter(|head| !std::ptr::eq(*head, longest)) {
            whole.units.extend(&other.units);
            whole.beside.extend(other.named.iter().chain(&other.beside).cloned());
            whole.bracketed.extend(other.bracketed.iter().cloned());
        }
        Some(whole)
    }

    /// The heading by all its words together: a ΔV is along its axis, and words such as "maximum" or "lamp"
    /// show that the heading is of something else.
    fn settled(mut self) -> Self {
        if self.channel == Channel::Time {
            return self;
        }
        let around = self.beside.iter().chain(&self.bracketed).map(String::as_str);
        self.channel = match self.channel {
            Channel::DeltaVLongitudinal if Axis::of(self.named.iter().map(String::as_str)).is_none() => {
                match Axis::of(around) {
                    None | Some(Axis::Along) => Channel::DeltaVLongitudinal,
                    Some(Axis::Across) => Channel::DeltaVLateral,
                    Some(Axis::Other) => Channel::Other,
                }
            }
            channel => channel,
        };
        if self.beside.iter().any(|word| denies(word)) {
            self.channel = Channel::Other;
        }
        self
    }
}

/// A part of a word of a heading.
struct Part {
    plain: String,
    /// The index of its word.
    of: usize,
    within: bool,
}

impl Part {
    /// Whether it names or narrows down a quantity, as units and the values of a switch do not.
    fn tells(&self) -> bool {
        let word = self.plain.as_str();
        let is_state = word.split('/').all(|state| is_one_of(ON, state) || is_one_of(OFF, state));
        !self.within && !is_state && unit_of(word).is_none() && word != "full"
    }
}

fn parts(words: &[Word]) -> Vec<Part> {
    let of_word = |(of, word): (usize, &Word)| {
        let part = |plain: &str| Part { plain: plain.to_owned(), of, within: word.within };
        plain(&word.text).split_whitespace().map(part).collect::<Vec<_>>()
    };
    words.iter().enumerate().flat_map(of_word).collect()
}

/// The quantities that these parts name, each with the parts that do.
fn names(parts: &[Part]) -> Vec<(Channel, Range<usize>)> {
    let mut found: Vec<(Channel, Range<usize>)> = Vec::new();
    let mut has_unit = false;
    let mut at = 0;
    while at < parts.len() {
        let free: Vec<&str> =
            parts[at..].iter().take_while(|part| !part.within).map(|part| part.plain.as_str()).collect();
        let unit = unit_of(&parts[at].plain);
        // "Engine speed, rpm": a unit after a heading that may have it is not a further heading.
        let takes = |unit: &ChannelUnit| found.last().is_some_and(|(channel, _)| channel.takes(unit));
        let is_unit = unit.as_ref().is_some_and(takes) && !has_unit;
        match heading_at(&free).filter(|_| !is_unit) {
            Some((channel, count)) => {
                found.push((channel, at..at + count));
                has_unit = false;
                at += count;
            }
            None => {
                has_unit |= unit.is_some();
                at += 1;
            }
        }
    }
    found
}

/// Where the words of the heading begin whose name begins at `name`. Words before the name in its line belong
/// to it if they are the first of the heading, or follow the unit of the one before, which ends at `after`.
fn begins(parts: &[Part], words: &[Word], after: Option<usize>, name: usize) -> usize {
    let line = |part: &Part| words[part.of].place.line;
    let from = after.unwrap_or(0);
    let in_line = |part: &Part| after.is_some() || line(part) == line(&parts[name]);
    // A number is a value of the heading before.
    let is_lead = |part: &&Part| part.tells() && in_line(part) && number(&part.plain, false).is_none();
    let begin = name - parts[from..name].iter().rev().take_while(is_lead).count();
    let closed = |part: &Part| part.within && !words[part.of].text.ends_with(',');
    match after {
        Some(after) if begin == after || !closed(&parts[begin - 1]) => name,
        _ => begin,
    }
}

/// The columns that these words name, in order, with their channels as first read; the words before the first
/// are a title.
fn unsettled(words: &[Word]) -> Vec<Head> {
    let parts = parts(words);
    let names = names(&parts);
    let starts: Vec<usize> = (0..names.len())
        .map(|k| begins(&parts, words, k.checked_sub(1).map(|before| names[before].1.end), names[k].1.start))
        .collect();
    let head = |(k, (channel, name)): (usize, &(Channel, Range<usize>))| {
        let own = starts[k]..starts.get(k + 1).copied().unwrap_or(parts.len());
        let first = parts[own.start].of;
        // A word whose rest belongs to the next heading also belongs to this one.
        let last = parts[own.end - 1].of;
        let text: Vec<&str> = words[first..=last].iter().map(|word| word.text.as_str()).collect();
        let around = || own.clone().filter(|at| !name.contains(at)).map(|at| &parts[at]);
        let words_of = |of: &dyn Fn(&Part) -> bool| -> Vec<String> {
            around().filter(|part| of(part)).map(|part| part.plain.clone()).collect()
        };
        let named = &parts[name.clone()];
        let mut units: Vec<ChannelUnit> = around().filter_map(|part| unit_of(&part.plain)).collect();
        if units.is_empty() {
            // "Seconds before AE" has its unit in its name.
            let units_of_name = named.iter().filter_map(|part| unit_of(&part.plain));
            units.extend(units_of_name.filter(|unit| channel.takes(unit)));
        }
        Head {
            text: text.join(" "),
            channel: *channel,
            units,
            place: words[first].place,
            named: named.iter().map(|part| part.plain.clone()).collect(),
            beside: words_of(&|part| part.tells()),
            bracketed: words_of(&|part| part.within),
        }
    };
    names.iter().enumerate().map(head).collect()
}

/// The columns that these words name, in order; the words before the first are a title.
pub(crate) fn heads(words: &[Word]) -> Vec<Head> {
    unsettled(words).into_iter().map(Head::settled).collect()
}

/// The one column that all these words name together.
pub(crate) fn heading(words: &[Word]) -> Option<Head> {
    Head::joined(&unsettled(words)).map(Head::settled)
}

/// The quantities that these words name, one in each line: a name that begins in the line of another belongs
/// to it.
pub(crate) fn labels(words: &[Word]) -> Vec<Head> {
    let all = unsettled(words);
    all.chunk_by(|one, next| one.place.line == next.place.line)
        .filter_map(Head::joined)
        .map(Head::settled)
        .collect()
}

/// Headings in quotes, for messages.
pub(crate) fn quoted<'h>(heads: impl Iterator<Item = &'h Head>) -> String {
    heads.map(|head| format!("\"{}\"", head.text)).collect::<Vec<_>>().join(", ")
}
