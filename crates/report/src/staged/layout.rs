//! A page as blocks, and the two ways to write them.

use crate::wrap::LINE;

/// A part of a page.
pub(super) enum Block {
    Title(String),
    Heading(String),
    Paragraph(String),
    Table(Table),
    /// Numbered from 1.
    Notes(Vec<String>),
    /// A picture beside the page, for Markdown alone.
    Picture {
        file: &'static str,
        says: &'static str,
    },
}

/// A table of numbers: the first `labels` columns are words, and with `claims` so is the last.
pub(super) struct Table {
    pub(super) labels: usize,
    pub(super) claims: bool,
    pub(super) header: Vec<&'static str>,
    pub(super) rows: Vec<Vec<String>>,
}

impl Table {
    fn is_words(&self, column: usize) -> bool {
        column < self.labels || self.claims && column + 1 == self.header.len()
    }
}

pub(super) fn text(blocks: &[Block]) -> String {
    let mut out = String::new();
    for (i, block) in blocks.iter().enumerate() {
        if i > 0 && !matches!(block, Block::Picture { .. }) {
            out.push('\n');
        }
        match block {
            Block::Title(title) => out.push_str(&format!("{title}\n{}\n", "═".repeat(LINE))),
            Block::Heading(heading) => out.push_str(&format!("{heading}\n{}\n", "─".repeat(LINE))),
            Block::Paragraph(words) => wrap(&mut out, words, ""),
            Block::Table(table) => text_table(&mut out, table),
            Block::Notes(notes) => {
                for (n, note) in notes.iter().enumerate() {
                    wrap(&mut out, &format!("{:<5}{note}", format!("[{}]", n + 1)), "     ");
                }
            }
            Block::Picture { .. } => {}
        }
    }
    out
}

/// Breaks lines at blanks; every line after the first begins with `indent`.
fn wrap(out: &mut String, words: &str, indent: &str) {
    let mut column = 0;
    for (i, word) in words.split(' ').enumerate() {
        let length = word.chars().count();
        if i > 0 && column + 1 + length > LINE {
            out.push('\n');
            out.push_str(indent);
            column = indent.chars().count();
        } else if i > 0 {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += length;
    }
    out.push('\n');
}

fn text_table(out: &mut String, table: &Table) {
    let header: Vec<String> = table.header.iter().map(ToString::to_string).collect();
    let lines: Vec<&Vec<String>> = std::iter::once(&header).chain(&table.rows).collect();
    let width = |column: usize| {
        lines.iter().filter_map(|line| line.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    for line in lines {
        let cells: Vec<String> = line
            .iter()
            .zip(&widths)
            .enumerate()
            .map(
                |(i, (cell, width))| {
                    if table.is_words(i) { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
                },
            )
            .collect();
        out.push_str(cells.join("  ").trim_end());
        out.push('\n');
    }
}

pub(super) fn markdown(blocks: &[Block]) -> String {
    let mut out = String::new();
    for (i, block) in blocks.iter().enumerate() {
        if i > 0 {
            out.push('\n');
        }
        match block {
            Block::Title(title) => out.push_str(&format!("# {title}\n")),
            Block::Heading(heading) => out.push_str(&format!("## {heading}\n")),
            Block::Paragraph(words) => out.push_str(&format!("{}\n", escaped(words))),
            Block::Table(table) => {
                markdown_row(&mut out, table.header.iter().copied());
                let rule = |i: usize| if table.is_words(i) { "---" } else { "---:" };
                markdown_row(&mut out, (0..table.header.len()).map(rule));
                for row in &table.rows {
                    markdown_row(&mut out, row.iter().map(String::as_str));
                }
            }
            Block::Notes(notes) => {
                for (n, note) in notes.iter().enumerate() {
                    out.push_str(&format!("{}. {}\n", n + 1, escaped(note)));
                }
            }
            Block::Picture { file, says } => out.push_str(&format!("![{says}]({file})\n")),
        }
    }
    out
}

fn markdown_row<'a>(out: &mut String, cells: impl Iterator<Item = &'a str>) {
    out.push('|');
    for cell in cells {
        out.push_str(&format!(" {} |", escaped(cell)));
    }
    out.push('\n');
}

/// Underscores are emphasis in Markdown.
fn escaped(words: &str) -> String {
    words.replace('_', "\\_")
}
