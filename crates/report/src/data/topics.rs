//! Topics of the glossary as JSON.

use serde::Serialize;

use super::pretty;
use crate::glossary::{Topic, topics};

/// A topic.
#[derive(Serialize)]
struct Entry {
    term: &'static str,
    kind: &'static str,
    also: &'static [&'static str],
    text: &'static str,
    see_also: Vec<&'static str>,
}

impl Entry {
    fn new(topic: &'static Topic) -> Self {
        let Topic { name: term, group: kind, aliases: also, text } = topic;
        Self { term, kind, also, text, see_also: topic.see_also() }
    }
}

/// A topic as indented JSON, ending in a line break: `term`, `kind` (its heading in the glossary), `also`
/// (its other names), `text` (Markdown) and `see_also`, the terms of other topics that the text uses.
///
/// # Errors
/// If serialisation fails, which no topic causes.
pub fn topic_json(topic: &'static Topic) -> Result<String, serde_json::Error> {
    pretty(&Entry::new(topic))
}

/// All topics as a list of what [`topic_json`] gives, in the order of the glossary.
///
/// # Errors
/// If serialisation fails, which no topic causes.
pub fn topics_json() -> Result<String, serde_json::Error> {
    let entries: Vec<Entry> = topics().iter().map(Entry::new).collect();
    pretty(&entries)
}
