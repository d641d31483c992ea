//! Text in lines.

/// Columns of a page of text.
pub(crate) const LINE: usize = 98;

/// A paragraph in lines of at most 98 columns.
pub(crate) fn wrapped(text: &str) -> String {
    wrapped_within(text, LINE)
}

pub(crate) fn wrapped_within(text: &str, line: usize) -> String {
    let mut lines = String::new();
    let mut column = 0;
    for word in text.split_whitespace() {
        let width = word.chars().count();
        if column > 0 {
            let (separator, start) = if column + 1 + width > line { ('\n', 0) } else { (' ', column + 1) };
            lines.push(separator);
            column = start;
        }
        lines.push_str(word);
        column += width;
    }
    lines.push('\n');
    lines
}

/// The text behind a head that its further lines are indented by.
pub(crate) fn hanging(head: &str, text: &str) -> String {
    hanging_within(head, text, LINE)
}

pub(crate) fn hanging_within(head: &str, text: &str, line: usize) -> String {
    let indent = head.chars().count();
    let mut lines = head.to_owned();
    let mut column = indent;
    for word in text.split_whitespace() {
        let width = word.chars().count();
        if column > indent && column + 1 + width > line {
            lines.push('\n');
            lines.push_str(&" ".repeat(indent));
            column = indent;
        } else if column > indent {
            lines.push(' ');
            column += 1;
        }
        lines.push_str(word);
        column += width;
    }
    lines.push('\n');
    lines
}

/// The first cell of a row of so many columns, of which the last two are blank: what is too long for it stands on a line of its own.
pub(crate) fn first_cell(text: &str, width: usize) -> String {
    if text.chars().count() + 2 <= width {
        format!("{text:<width$}")
    } else {
        format!("{text}\n{:width$}", "")
    }
}
