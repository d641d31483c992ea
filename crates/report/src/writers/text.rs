//! A document as text in columns.

use super::wrap::{hanging, wrapped};
use super::{is_for_html_alone, step_lines};
use crate::document::{Block, Cells, Column, Row, Table, Width};
use crate::steps::StepGroup;

/// Codes of ECMA-48.
const BOLD: &str = "1";
const YELLOW: &str = "33";
/// (columns) indent of a detail.
const INDENT: usize = 4;
/// (columns) of the names of entries, including the blanks after them.
const WORDS: usize = 38;

/// The document in lines of `line` columns; on a terminal, headings and answers stand out.
pub(crate) fn write(blocks: &[Block], line: usize, terminal: bool) -> String {
    let mut page = Page { line, terminal, out: String::new() };
    let mut before = None;
    for block in blocks.iter().filter(|block| !is_for_html_alone(block)) {
        page.block(block, before);
        before = Some(block);
    }
    page.out
}

struct Page {
    /// (columns)
    line: usize,
    terminal: bool,
    out: String,
}

impl Page {
    /// Writes lines that stand out on a terminal.
    fn marked(&mut self, code: &str, lines: &str) {
        for line in lines.lines() {
            let line = line.trim_end();
            if self.terminal && !line.is_empty() {
                self.out.push_str(&format!("\x1b[{code}m{line}\x1b[0m\n"));
            } else {
                self.plain(line);
            }
        }
    }

    fn plain(&mut self, line: &str) {
        self.out.push_str(line.trim_end());
        self.out.push('\n');
    }

    fn wrapped(&mut self, words: &str) {
        self.out.push_str(&wrapped(words, self.line));
    }

    fn rule(&mut self) {
        self.out.push_str(&"─".repeat(self.line));
        self.out.push('\n');
    }

    fn heading(&mut self, heading: &str) {
        self.marked(BOLD, heading);
        self.rule();
    }

    fn block(&mut self, block: &Block, before: Option<&Block>) {
        let belongs_to_the_one_before = matches!(block, Block::Notice { .. } | Block::Picture { .. })
            || matches!(
                (before, block),
                (Some(Block::Heading(_)), Block::Entries(_) | Block::List(_) | Block::Paragraph(_))
                    | (Some(Block::Subheading(_)), _)
            )
            || is_beneath_a_heading(block, before);
        if before.is_some() && !belongs_to_the_one_before {
            self.out.push('\n');
        }
        match block {
            Block::Title { title, source } => {
                self.plain(title);
                if let Some(source) = source {
                    self.plain(&format!("Source: {source}"));
                }
            }
            Block::Heading(heading) => self.heading(heading),
            Block::Subheading(heading) => self.marked(BOLD, heading),
            Block::Paragraph(words) => self.wrapped(words),
            Block::Answer { found, how } => {
                self.marked(BOLD, &found.join("\n"));
                self.wrapped(how);
            }
            Block::Notice { count, .. } => {
                self.marked(YELLOW, &wrapped(&format!("{count}, at the end."), self.line));
            }
            Block::Warnings { warnings, more } => {
                for (code, message) in warnings {
                    let lines = wrapped(&format!("warning [{code}]: {message}"), self.line);
                    self.marked(YELLOW, &lines);
                }
                self.wrapped(if warnings.is_empty() { "No warnings." } else { more });
            }
            Block::List(items) => {
                for item in items {
                    self.wrapped(item);
                }
            }
            Block::Notes(notes) => {
                for (n, note) in (1..).zip(notes) {
                    self.out.push_str(&hanging(&format!("{:<5}", format!("[{n}]")), note, self.line));
                }
            }
            Block::Facts { title, facts } => {
                self.heading(title);
                for (name, value) in facts {
                    self.entry(name, value);
                }
            }
            Block::Entries(entries) => {
                for (words, value) in entries {
                    self.entry(words, value);
                }
            }
            Block::Table(table) | Block::Chart { instead: Some(table), .. } => {
                self.table(table, is_beneath_a_heading(block, before));
            }
            Block::Steps(group) => self.steps(group),
            Block::Drawing(drawing) => {
                let words = format!("{}: {}", drawing.name(), drawing.description());
                self.wrapped(&words);
            }
            Block::Picture { .. } | Block::Chart { instead: None, .. } => {}
            Block::Listing { text, .. } => text.lines().for_each(|line| self.plain(line)),
        }
    }

    fn entry(&mut self, words: &str, value: &str) {
        let head =
            if words.chars().count() < WORDS { format!("{words:<WORDS$}") } else { format!("{words} ") };
        self.out.push_str(&hanging(&head, value, self.line));
    }

    fn steps(&mut self, StepGroup { title, steps }: &StepGroup) {
        self.heading(title);
        for step in steps {
            for line in step_lines(step) {
                self.plain(&line);
            }
        }
    }

    /// Writes a table; `has_rule` if the heading above it already has a rule.
    fn table(&mut self, table: &Table, has_rule: bool) {
        let columns = places(table, self.line);
        let mut names: Vec<String> = table.columns.iter().map(|column| column.name.clone()).collect();
        if let Some(first) = names.first_mut()
            && !table.title.is_empty()
        {
            first.clone_from(&table.title);
        }
        let units: Vec<String> = table.columns.iter().map(|column| column.unit.clone()).collect();
        if names.iter().any(|name| !name.is_empty()) {
            let mut header = laid_out(&names, &columns, self.line);
            if units.iter().any(|unit| !unit.is_empty()) {
                header.push_str(&laid_out(&units, &columns, self.line));
            }
            self.marked(BOLD, &header);
            if !has_rule {
                self.rule();
            }
        }
        for row in &table.rows {
            match row {
                Row::Cells(cells) => self.cells(cells, &columns),
                Row::Shared { label, value, source } => self.shared([label, value, source], &columns),
                Row::Detail(words) => {
                    let lines = hanging(&" ".repeat(INDENT), words, self.line);
                    self.out.push_str(&lines);
                }
            }
        }
        for note in &table.notes {
            self.wrapped(note);
        }
    }

    fn cells(&mut self, cells: &[String], columns: &[Place]) {
        let lines = cells.iter().map(|cell| cell.split('\n').count()).max().unwrap_or(0);
        for n in 0..lines {
            let line: Vec<String> =
                cells.iter().map(|cell| cell.split('\n').nth(n).unwrap_or_default().to_owned()).collect();
            let laid = laid_out(&line, columns, self.line);
            self.out.push_str(&laid);
        }
    }

    fn shared(&mut self, [label, value, source]: [&String; 3], columns: &[Place]) {
        let (Some(second), Some(last)) = (columns.get(1), columns.last()) else { return };
        // A value that is longer than a line continues below.
        if source.is_empty() && second.start + value.chars().count() > self.line {
            self.out.push_str(&hanging(&format!("{label:<width$}", width = second.start), value, self.line));
            return;
        }
        let across = Place { end: last.start, ..*second };
        let first = columns.first().copied().unwrap_or(across);
        let cells = [label, value, source].map(String::clone);
        self.out.push_str(&laid_out(&cells, &[first, across, *last], self.line));
    }
}

/// Whether a table has no title and is right below a heading, which has a rule.
fn is_beneath_a_heading(block: &Block, before: Option<&Block>) -> bool {
    matches!((before, block), (Some(Block::Heading(_)), Block::Table(table)) if table.title.is_empty())
}

/// The place of a column in a line.
#[derive(Clone, Copy, Debug)]
struct Place {
    start: usize,
    end: usize,
    cells: Cells,
}

/// The places of the columns of a table in a line of `line` columns.
fn places(table: &Table, line: usize) -> Vec<Place> {
    let longest = |i: usize, column: &Column| {
        let of_row = |row: &Row| match row {
            // The further lines of a cell may use the space of the following columns.
            Row::Cells(cells) => {
                cells.get(i).and_then(|cell| cell.lines().next()).map_or(0, |line| line.chars().count())
            }
            Row::Shared { label, .. } if i == 0 => label.chars().count(),
            Row::Shared { .. } | Row::Detail(_) => 0,
        };
        let name = if i == 0 { &column.name } else { "" };
        let header = name.chars().count().max(column.name.chars().count()).max(column.unit.chars().count());
        table.rows.iter().map(of_row).max().unwrap_or(0).max(header)
    };
    let gap = |column: &Column| match column.width {
        Width::Fit(_) => 2,
        Width::Fixed(_) | Width::Share => 0,
    };
    let widths = |with_least: bool| -> Vec<usize> {
        let of = |(i, column): (usize, &Column)| match column.width {
            Width::Fixed(width) => width,
            Width::Fit(least) if with_least => longest(i, column).max(least),
            Width::Fit(_) => longest(i, column),
            Width::Share => 0,
        };
        table.columns.iter().enumerate().map(of).collect()
    };
    let total =
        |widths: &[usize]| widths.iter().sum::<usize>() + table.columns.iter().map(gap).sum::<usize>();
    let mut widths_of = widths(true);
    if total(&widths_of) > line + 2 {
        widths_of = widths(false);
    }
    let shares = table.columns.iter().filter(|column| column.width == Width::Share).count();
    let share = line.saturating_sub(total(&widths_of)).checked_div(shares).unwrap_or(0);
    let mut start = 0;
    let mut places = Vec::new();
    for (column, width) in table.columns.iter().zip(widths_of) {
        let width = if column.width == Width::Share { share } else { width };
        places.push(Place { start, end: start + width, cells: column.cells });
        start += width + gap(column);
    }
    places
}

/// One line of a table, or more where a cell does not fit: ends in a line break.
fn laid_out(cells: &[String], columns: &[Place], line: usize) -> String {
    let mut out = String::new();
    let mut current = String::new();
    let mut used = 0;
    // Whether the cell before is the first, and whether it is one of words.
    let (mut is_label, mut is_words) = (false, false);
    for (i, (cell, place)) in cells.iter().zip(columns).enumerate() {
        let width = cell.chars().count();
        if width == 0 {
            continue;
        }
        let wanted = match place.cells {
            Cells::Numbers => place.end.saturating_sub(width),
            Cells::Words | Cells::Bars => place.start,
        };
        let least = match place.cells {
            _ if used == 0 => 0,
            // One blank separates figures, two separate words.
            Cells::Numbers => used + 1,
            Cells::Words | Cells::Bars => used + 2,
        };
        let mut start = wanted.max(least);
        // A first cell that is too long gets its own line, as do words that a figure would run into; a cell
        // that would exceed the line starts the next one.
        let runs_into = used + 2 > wanted && (is_label || is_words && place.cells == Cells::Numbers);
        if used > 0 && (runs_into || start > wanted && start + width > line) {
            out.push_str(current.trim_end());
            out.push('\n');
            (current, used, start) = (String::new(), 0, wanted);
        }
        current.push_str(&" ".repeat(start.saturating_sub(used)));
        let is_last = i + 1 == columns.len() && place.cells == Cells::Words;
        if is_last && start + width > line {
            // The last words of a line continue below.
            let lines = hanging(&" ".repeat(start), cell, line);
            current.push_str(lines.trim());
        } else {
            current.push_str(cell);
        }
        used = start + width;
        (is_label, is_words) = (i == 0, place.cells == Cells::Words);
    }
    out.push_str(current.trim_end());
    out.push('\n');
    out
}
