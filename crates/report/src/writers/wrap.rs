//! Text broken into lines.

/// A paragraph in lines of at most `line` columns, as far as its words allow, ending in a line break.
pub(crate) fn wrapped(text: &str, line: usize) -> String {
    hanging("", text, line)
}

/// The text after a head, with further lines indented by its width, ending in a line break.
pub(crate) fn hanging(head: &str, text: &str, line: usize) -> String {
    let indent = head.chars().count();
    let mut lines = head.to_owned();
    let mut column = indent;
    // A no-break space does not break.
    for word in text.split_ascii_whitespace() {
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
    lines.truncate(lines.trim_end_matches(' ').len());
    lines.push('\n');
    lines
}

/// Words in lines of at most `columns` columns, for the cell of a table.
pub(crate) fn folded(words: &str, columns: usize) -> String {
    wrapped(words, columns).trim_end().to_owned()
}
