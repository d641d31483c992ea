//! Topics of the glossary.

use crate::document::{Block, Document};
use crate::glossary::{Topic, topics};

/// (columns) of lines that are easy to read.
const COLUMNS: [usize; 2] = [40, 100];

/// A topic: its names and its text.
#[must_use]
pub fn explanation(topic: &Topic) -> Document {
    let mut page = Document::new().with_columns(COLUMNS);
    page.heading(topic.name);
    if !topic.aliases.is_empty() {
        page.paragraph(format!("Also: {}", topic.aliases.join("; ")));
    }
    for paragraph in topic.text.split("\n\n") {
        if paragraph.starts_with("    ") {
            page.push(Block::Listing { language: "text", text: paragraph.to_owned() });
        } else {
            page.paragraph(paragraph);
        }
    }
    page
}

/// The names of all topics under their headings.
#[must_use]
pub fn list_of_topics() -> Document {
    let mut page = Document::new().with_columns(COLUMNS);
    page.paragraph(
        "`deltav explain TOPIC` explains one of these; symbols, keys of the case file and codes of warnings are known too.",
    );
    for group in topics().chunk_by(|one, next| one.group == next.group) {
        let names: Vec<&str> = group.iter().map(|topic| topic.name).collect();
        page.heading(group.first().map_or("", |topic| topic.group));
        page.paragraph(names.join("; "));
    }
    page
}
