//! The text of a case file, and the place of each value in it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::OnceLock;

use inputs::Text;
use recorder::TextPlace;
use toml::de::DeTable;

use crate::node::Entries;
use crate::units_in_use::UnitsInUse;

/// (bytes) the place of each key's value, or of each table's header.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spans(BTreeMap<String, Range<usize>>);

impl Spans {
    pub(crate) fn insert(&mut self, path: String, span: Range<usize>) {
        self.0.insert(path, span);
    }

    pub(crate) fn get(&self, path: &str) -> Option<Range<usize>> {
        self.0.get(path).cloned()
    }

    /// The innermost key around a place; of several the longest name.
    fn around(&self, place: &Range<usize>) -> Option<&str> {
        let around = self.0.iter().filter(|(_, span)| span.start <= place.start && place.end <= span.end);
        around.min_by_key(|(key, span)| (span.len(), usize::MAX - key.len())).map(|(key, _)| &**key)
    }

    /// The place of the key or, if it is absent, of the nearest table around it.
    pub(crate) fn nearest(&self, path: &str) -> Option<Range<usize>> {
        self.get(path).or_else(|| self.nearest(path.rsplit_once('.')?.0))
    }
}

/// A case file's name, text and the places of its keys.
#[derive(Clone, Debug)]
pub struct Source {
    name: Text,
    /// `None` for values, whose keys have no lines.
    text: Option<String>,
    spans: Spans,
    /// Boxed to keep errors small.
    units_in_use: OnceLock<Box<UnitsInUse>>,
}

impl Source {
    pub(crate) fn new(name: &str, text: &str, spans: Spans) -> Self {
        Self { name: name.into(), text: Some(text.to_owned()), spans, units_in_use: OnceLock::new() }
    }

    /// The source of values, whose places are counted as by [`Entries::of_values`].
    pub(crate) fn of_values(name: &str, spans: Spans) -> Self {
        Self { text: None, ..Self::new(name, "", spans) }
    }

    /// The key at a place, or that of the list or table around it.
    pub(crate) fn key_at(&self, place: &Range<usize>) -> Option<&str> {
        self.spans.around(place)
    }

    /// Whether it is a text, so that its keys have lines.
    pub(crate) fn is_text(&self) -> bool {
        self.text.is_some()
    }

    /// The units of the file. Finding them parses the text again, which happens only for an error.
    pub(crate) fn units_in_use(&self) -> &UnitsInUse {
        self.units_in_use.get_or_init(|| {
            Box::new(UnitsInUse::of(&Entries::of_toml(
                DeTable::parse_recoverable(self.text()).0.into_inner(),
            )))
        })
    }

    /// The name under which the file was read.
    #[must_use]
    pub fn name(&self) -> &Text {
        &self.name
    }

    /// The whole text.
    #[must_use]
    pub fn text(&self) -> &str {
        self.text.as_deref().unwrap_or_default()
    }

    /// (bytes) the place of the value of a key such as `"vehicle1.crush.width"`, or of the header of a table
    /// such as `"vehicle1"`.
    #[must_use]
    pub fn span(&self, path: &str) -> Option<Range<usize>> {
        self.spans.get(path)
    }

    /// Line and column, from 1, of a place within the text that is the value of a key; `None` if it is
    /// written with escapes, or the source is not text.
    #[must_use]
    pub fn place_in_text(&self, path: &str, text: &str, place: TextPlace) -> Option<TextPlace> {
        let source = self.text.as_deref()?;
        let at = span_in_text(source, &self.span(path)?, text, place)?.start;
        let before = source.get(..at)?;
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.rsplit('\n').next().unwrap_or_default().chars().count();
        Some(TextPlace { line, column })
    }

    /// (bytes) every key and table in the text, with its place as in [`span`](Self::span), in the order of
    /// their names.
    pub fn spans(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        self.spans.0.iter().map(|(key, span)| (&**key, span.clone()))
    }

    /// (bytes) the place of a key or, if it is absent, of the nearest table around it. `None` is the file
    /// itself.
    #[must_use]
    pub fn nearest_span(&self, path: &str) -> Option<Range<usize>> {
        self.spans.nearest(path)
    }
}

/// (bytes) the piece at a place of a text that is a string within `span` of the source; `None` if the string
/// is written with escapes.
pub(crate) fn span_in_text(
    source: &str,
    span: &Range<usize>,
    text: &str,
    place: TextPlace,
) -> Option<Range<usize>> {
    let start = span.start + source.get(span.clone())?.find(text)?;
    let before: usize = text.split_inclusive('\n').take(place.line.saturating_sub(1)).map(str::len).sum();
    let line = text.get(before..)?.lines().next().unwrap_or_default();
    let from: usize = line.chars().take(place.column.saturating_sub(1)).map(char::len_utf8).sum();
    let rest = line.get(from..)?;
    let length = rest.find([' ', '\t', ',', ';']).unwrap_or(rest.len()).max(1);
    let begin = (start + before + from).min(span.end);
    Some(begin..(begin + length).min(span.end).max(begin))
}
