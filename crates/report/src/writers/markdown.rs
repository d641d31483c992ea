//! A document as Markdown.

use super::{anchor, code_spans, is_for_html_alone, step_lines};
use crate::document::{Block, Cells, Column, Row, Table};

/// The document as Markdown.
pub(crate) fn write(blocks: &[Block]) -> String {
    let blocks: Vec<String> = blocks.iter().filter(|block| !is_for_html_alone(block)).map(block).collect();
    blocks.join("\n")
}

/// One block, ending in a line break.
fn block(block: &Block) -> String {
    match block {
        Block::Title { title, source } => {
            let source = source.as_ref().map(|source| format!("\nSource: {}\n", escaped(source)));
            format!("# {}\n{}", escaped(title), source.unwrap_or_default())
        }
        Block::Heading(heading) => format!("## {}\n", escaped(heading)),
        Block::Subheading(heading) => format!("### {}\n", escaped(heading)),
        Block::Paragraph(words) => format!("{}\n", prose(words)),
        Block::Answer { found, how } => {
            let how = if how.is_empty() { String::new() } else { format!("\n{}\n", prose(how)) };
            let found: Vec<String> = found.iter().map(|line| format!("**{}**", escaped(line))).collect();
            format!("{}\n{how}", found.join("\n\n"))
        }
        Block::Notice { count, heading } => match heading {
            Some(heading) => format!("[{count}](#{}), at the end.\n", anchor(heading)),
            None => format!("{count}, at the end.\n"),
        },
        Block::Warnings { warnings, more } => {
            if warnings.is_empty() {
                return "No warnings.\n".to_owned();
            }
            let item = |(code, message): &(&str, String)| {
                format!("- warning [{}]: {}.\n", escaped(code), prose(message))
            };
            let items: String = warnings.iter().map(item).collect();
            if more.is_empty() { items } else { format!("{items}\n{}\n", prose(more)) }
        }
        Block::List(items) => items.iter().map(|item| format!("- {}\n", prose(item))).collect(),
        Block::Notes(notes) => (1..).zip(notes).map(|(n, note)| format!("{n}. {}\n", prose(note))).collect(),
        Block::Facts { title, facts } => {
            let item = |(name, value): &(&str, String)| format!("- {name}: {}\n", escaped(value));
            titled(title) + &facts.iter().map(item).collect::<String>()
        }
        Block::Entries(entries) => {
            entries.iter().map(|(words, value)| format!("- {}: {}\n", escaped(words), prose(value))).collect()
        }
        Block::Table(table) | Block::Chart { instead: Some(table), .. } => self::table(table),
        Block::Chart { instead: None, .. } => String::new(),
        Block::Steps(group) => {
            let lines: String = group.steps.iter().flat_map(step_lines).map(|line| line + "\n").collect();
            format!("### {}\n\n{}", escaped(&group.title), listing("text", &lines))
        }
        Block::Drawing(drawing) => {
            format!("- {}: {}\n", drawing.name(), escaped(drawing.description()))
        }
        Block::Picture { file, says, .. } => format!("![{says}]({file})\n"),
        Block::Listing { language, text } => listing(language, text),
    }
}

/// The title of the block that follows; nothing if it is empty.
fn titled(title: &str) -> String {
    if title.is_empty() { String::new() } else { format!("**{}**\n\n", escaped(title)) }
}

fn table(table: &Table) -> String {
    let mut out = titled(&table.title);
    out.push_str(&line(table.columns.iter().map(Column::heading)));
    let rule = |column: &Column| match column.cells {
        Cells::Numbers => "---:".to_owned(),
        Cells::Words | Cells::Bars => "---".to_owned(),
    };
    out.push_str(&format!(
        "|{}\n",
        table.columns.iter().map(|column| format!(" {} |", rule(column))).collect::<String>()
    ));
    for row in &table.rows {
        let cells = match row {
            Row::Cells(cells) => cells.clone(),
            Row::Shared { label, value, source } => {
                let mut cells = vec![String::new(); table.columns.len().max(3)];
                let last = cells.len() - 1;
                (cells[0], cells[1], cells[last]) = (label.clone(), value.clone(), source.clone());
                cells
            }
            Row::Detail(words) => vec![words.clone()],
        };
        out.push_str(&line(cells.into_iter()));
    }
    for note in &table.notes {
        out.push_str(&format!("\n{}\n", prose(note)));
    }
    out
}

fn line(cells: impl Iterator<Item = String>) -> String {
    let cells: String = cells.map(|cell| format!(" {} |", escaped(cell.trim()))).collect();
    format!("|{cells}\n")
}

/// Between fences that are longer than any run of backticks in the text.
fn listing(language: &str, text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest.max(2) + 1);
    let end = if text.ends_with('\n') { "" } else { "\n" };
    format!("{fence}{language}\n{text}{end}{fence}\n")
}

/// A sentence of the program: text in backticks stays code.
fn prose(text: &str) -> String {
    let parts = code_spans(text);
    parts
        .into_iter()
        .map(|(part, is_code)| if is_code { format!("`{part}`") } else { escaped(part) })
        .collect()
}

/// Escapes the characters that Markdown would interpret. A row of a table is one line, so line breaks become
/// blanks. The number of a note stays as it is.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        let length = note(rest).unwrap_or(letter.len_utf8());
        let (this, after) = rest.split_at(length);
        match letter {
            '[' if length > 1 => out.push_str(this),
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '#' => {
                out.push('\\');
                out.push(letter);
            }
            '\n' | '\r' => out.push(' '),
            _ => out.push_str(this),
        }
        rest = after;
    }
    out
}

/// (bytes) of a leading number in brackets that is not a link.
fn note(text: &str) -> Option<usize> {
    let (digits, after) = text.strip_prefix('[')?.split_once(']')?;
    let is_number = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    (is_number && !after.starts_with(['(', '[', ':'])).then_some(digits.len() + 2)
}

#[cfg(test)]
mod tests {
    use super::{block, escaped, prose};
    use crate::document::{Block, Column, Table, Width};

    #[test]
    fn facts_have_their_title() {
        let facts =
            |title| block(&Block::Facts { title, facts: vec![("Speed", "at most 5 m/s".to_owned())] });
        assert_eq!(facts("Enough"), "**Enough**\n\n- Speed: at most 5 m/s\n");
        assert_eq!(facts(""), "- Speed: at most 5 m/s\n");
    }

    #[test]
    fn a_unit_has_a_comma_before_it_and_the_rest_of_a_name_has_none() {
        let columns = [
            Column::numbers("speed", Width::Fit(0)).unit("km/h"),
            Column::numbers("what", Width::Fit(0)).goes_on("happened"),
        ];
        let table = block(&Block::Table(Table::new("").columns(columns)));
        assert!(table.starts_with("| speed, km/h | what happened |\n"), "{table}");
    }

    #[test]
    fn nothing_of_a_text_is_taken_for_markdown() {
        for (text, expected) in [
            ("a_b *c* <d> |", "a\\_b \\*c\\* \\<d\\> \\|"),
            ("[1], [x](y), [2](z)", "[1], \\[x\\](y), \\[2\\](z)"),
            ("two\nlines", "two lines"),
        ] {
            assert_eq!(escaped(text), expected);
        }
    }

    #[test]
    fn code_stays_code_where_it_ends() {
        assert_eq!(prose("check `a_b` and c_d"), "check `a_b` and c\\_d");
        assert_eq!(prose("one ` alone_"), "one \\` alone\\_");
    }
}
