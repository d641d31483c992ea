//! Documents written: as text, as Markdown and as HTML, one writer each.

mod html;
mod markdown;
mod text;
pub(crate) mod wrap;

use crate::document::{Block, Document, LINE};
use crate::steps::Step;

impl Document {
    /// Text of 98 columns.
    #[must_use]
    pub fn text(&self) -> String {
        self.text_within(LINE)
    }

    /// Text with lines of this many columns, as far as its tables allow.
    #[must_use]
    pub fn text_within(&self, columns: usize) -> String {
        text::write(&self.blocks, self.line(columns), false)
    }

    /// The same with its headings in bold and its warnings in yellow, by the escape sequences of a terminal
    /// (ECMA-48).
    #[must_use]
    pub fn terminal(&self, columns: usize) -> String {
        text::write(&self.blocks, self.line(columns), true)
    }

    fn line(&self, columns: usize) -> usize {
        let [least, most] = self.columns;
        columns.clamp(least, most)
    }

    /// Markdown (`CommonMark` with tables). Words take the place of drawings.
    #[must_use]
    pub fn markdown(&self) -> String {
        markdown::write(&self.blocks)
    }

    /// HTML to put into another page, such as a notebook: without the style of a page and without drawings.
    #[must_use]
    pub fn html_fragment(&self) -> String {
        html::fragment(&self.blocks)
    }

    /// One self-contained HTML file: no scripts, nothing from a network, made to be printed on A4 or Letter.
    #[must_use]
    pub fn html(&self) -> String {
        html::write(&self.blocks)
    }
}

/// Whether a block appears only in HTML: a picture of data that are also in tables.
fn is_for_html_alone(block: &Block) -> bool {
    matches!(block, Block::Chart { instead: None, .. })
}

/// A step as lines of plain text: its name, its equation, the numbers in it, and the value.
fn step_lines(step: &Step) -> Vec<String> {
    let mut value = step.printed.clone();
    if !step.unit.is_empty() {
        value.push_str(&format!(" {}", step.unit));
    }
    if let Some(shown) = &step.repeated {
        value.push_str(&format!(" = {shown}"));
    }
    let mut lines = vec![format!("{} ({})", step.name, step.source)];
    let indent = " ".repeat(step.symbol.chars().count());
    let mut left = step.symbol.as_str();
    for right in
        [step.formula.as_str(), &step.substitution, &value].into_iter().filter(|side| !side.is_empty())
    {
        lines.push(format!("  {left} = {right}"));
        left = &indent;
    }
    lines
}

/// The anchor of a heading for links, as GitHub, GitLab and Pandoc form it.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// The parts of a sentence in order, and whether each is code; with an unpaired backtick none is.
fn code_spans(text: &str) -> Vec<(&str, bool)> {
    if text.matches('`').count() % 2 == 1 {
        return vec![(text, false)];
    }
    text.split('`').zip([false, true].into_iter().cycle()).filter(|(part, _)| !part.is_empty()).collect()
}
