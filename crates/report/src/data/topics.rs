//! Topics of the glossary as JSON.

use serde_json::{Value, json};

use super::{list, pretty};
use crate::glossary::{Topic, topics};

fn entry(topic: &Topic) -> Value {
    let Topic { name, group, aliases, text } = topic;
    json!({ "term": name, "kind": group, "also": aliases, "text": text, "see_also": topic.see_also() })
}

/// A topic as indented JSON, ending in a line break: `term`, `kind` (its heading in the glossary), `also`
/// (its other names), `text` (Markdown) and `see_also`, the terms of other topics that the text uses.
///
/// # Errors
/// If serialisation fails, which no topic causes.
pub fn topic_json(topic: &'static Topic) -> Result<String, serde_json::Error> {
    pretty(&entry(topic))
}

/// All topics as a list of what [`topic_json`] gives, in the order of the glossary.
///
/// # Errors
/// If serialisation fails, which no topic causes.
pub fn topics_json() -> Result<String, serde_json::Error> {
    pretty(&list(topics(), entry))
}
