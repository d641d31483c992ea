//! Documents written: as text, as Markdown and as HTML, one writer each.

mod html;
mod markdown;
mod text;
pub(crate) mod wrap;

pub(crate) use html::{fragment as html_fragment, write as html};
pub(crate) use markdown::write as markdown;
pub(crate) use text::write as text;

use crate::document::Block;
use crate::steps::Step;

/// Whether only HTML has a block: a picture that says what tables say too.
fn is_for_html_alone(block: &Block) -> bool {
    matches!(block, Block::Chart { instead: None, .. })
}

/// A step as lines of plain text: what it is, its equation, the numbers in it, and the value.
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

/// The name of a heading in a link: what GitHub, GitLab and Pandoc make of it.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// The parts of a sentence in turn, and which of them is code: all of it is words where a backtick has no
/// other.
fn code_spans(text: &str) -> Vec<(&str, bool)> {
    if text.matches('`').count() % 2 == 1 {
        return vec![(text, false)];
    }
    text.split('`').zip([false, true].into_iter().cycle()).filter(|(part, _)| !part.is_empty()).collect()
}
