//! Text whose columns are separated by runs of blanks: cells belong to the column in which they stand.

use super::delimited::{self, Field, head, holds_values, is_full, is_transposed, label, lines, token};
use super::heads::Head;
use super::raw::RawTable;
use super::tokens::{Token, bare, is_value, number};
use crate::channel::{Axis, Channel, ChannelUnit, plain};
use crate::table::{TextFault, TextLayout, TextPlace, TextRefusal};

/// (characters) the distance between the stops of a tab.
const TAB: usize = 8;
/// (characters) by how much the edges of a column may be off.
const OFF: usize = 1;
/// (lines) the most that a heading is taken to have.
const MOST_LINES: usize = 8;

/// The characters of a line that something covers, from the first to the one behind the last.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    from: usize,
    to: usize,
}

impl Span {
    fn of(field: &Field) -> Self {
        let from = field.place.column;
        Self { from, to: from + field.text.chars().count() }
    }

    fn overlaps(self, other: Self) -> bool {
        self.from < other.to && other.from < self.to
    }

    fn holds(self, other: Self) -> bool {
        self.from <= other.from && other.to <= self.to
    }

    fn hull(self, other: Self) -> Self {
        Self { from: self.from.min(other.from), to: self.to.max(other.to) }
    }

    /// Twice its centre.
    fn centre(self) -> usize {
        self.from + self.to
    }

    fn moved(self, by: isize) -> Self {
        Self { from: self.from.saturating_add_signed(by), to: self.to.saturating_add_signed(by) }
    }
}

/// The cells of a line, which have two blanks between them.
fn cells(line: &str, number: usize) -> Vec<Field> {
    let mut found: Vec<Field> = Vec::new();
    let (mut column, mut blanks) = (0_usize, 2);
    for letter in line.trim_end().chars() {
        column += 1;
        if letter == '\t' {
            column = column.next_multiple_of(TAB);
            blanks += 2;
        } else if letter.is_whitespace() {
            blanks += 1;
        } else {
            match found.last_mut() {
                Some(cell) if blanks < 2 => {
                    cell.text.extend(std::iter::repeat_n(' ', blanks));
                    cell.text.push(letter);
                }
                _ => found.push(Field { text: letter.into(), place: TextPlace { line: number, column } }),
            }
            blanks = 0;
        }
    }
    found
}

/// A heading with the rows below it, page by page.
#[derive(Default)]
struct Part {
    heading: Vec<Vec<Field>>,
    pages: Vec<Vec<Vec<Field>>>,
    ignored: Vec<(String, TextPlace)>,
    /// A value that is alone in its line, and is not the number of a page.
    alone: Option<Field>,
}

/// The cell of the times in a heading: the position in its line, and its span.
fn time_cell(heading: &[Vec<Field>]) -> Option<(usize, Span)> {
    let named = |line: &Vec<Field>| {
        line.iter().position(|cell| {
            let above = heading.iter().flatten().filter(|other| {
                other.place.line < cell.place.line && Span::of(other).overlaps(Span::of(cell))
            });
            let stacked: Vec<&str> = above.chain([cell]).map(|cell| cell.text.as_str()).collect();
            delimited::is_time(&cell.text, cell.place) || delimited::is_time(&stacked.join(" "), cell.place)
        })
    };
    heading.iter().rev().find_map(|line| named(line).map(|at| (at, Span::of(&line[at]))))
}

impl Part {
    fn rows(&self) -> impl Iterator<Item = &Vec<Field>> {
        self.pages.iter().flatten()
    }

    /// Reports lines between its rows that were not read.
    fn leave(&mut self, lines: &mut Vec<Vec<Field>>) {
        self.alone = self.alone.take().or_else(|| lone(lines));
        for line in lines.drain(..) {
            let text: Vec<&str> = line.iter().map(|cell| cell.text.as_str()).collect();
            let is_told = line.len() > 1 || line.iter().any(|cell| is_value(&token(cell).text));
            self.ignored.extend(line.first().filter(|_| is_told).map(|cell| (text.join(" "), cell.place)));
        }
    }
}

/// The first value that is alone in its line, and is not the number of a page.
fn lone(lines: &[Vec<Field>]) -> Option<Field> {
    let is_value = |cell: &Field| {
        number(bare(&cell.text), true).is_some() && !cell.text.bytes().all(|byte| byte.is_ascii_digit())
    };
    lines.iter().filter(|line| line.len() == 1).flatten().find(|cell| is_value(cell)).cloned()
}

/// Whether a line is a row below this heading: all its cells are values, or its time is a number, or it has
/// as many cells as the last row and values in half of them.
fn is_row(line: &[Field], heading: &[Vec<Field>], last: Option<&Vec<Field>>) -> bool {
    if line.len() > 1 && holds_values(line) {
        return true;
    }
    let time = time_cell(heading);
    let is_number = |cell: &Field| number(bare(&token(cell).text), false).is_some();
    let over_time =
        |cell: &&Field| time.is_some_and(|(_, span)| span.overlaps(Span::of(cell))) && is_number(cell);
    if let [cell] = line {
        // A number alone is that of a page, unless it stands below the times.
        let above = last.and_then(|last| last.iter().find(over_time).or_else(|| last.get(time?.0)));
        let is_below = |above| is_near(Span::of(cell), Span::of(above));
        return is_number(cell) && above.map_or(last.is_none() && over_time(&cell), is_below);
    }
    line.iter().any(|cell| over_time(&cell))
        || time.is_some_and(|(at, _)| line.get(at).is_some_and(is_number))
        || last.is_some_and(|last| is_full(line, last.len()))
}

/// Whether two spans begin, end or have their centre at the same place.
fn is_near(one: Span, other: Span) -> bool {
    one.from.abs_diff(other.from) <= OFF
        || one.to.abs_diff(other.to) <= OFF
        || one.centre().abs_diff(other.centre()) <= 2 * OFF
}

/// Whether all these spans begin, end or have their centre at one place.
fn are_aligned(spans: &[Span]) -> bool {
    let within = |edge: fn(&Span) -> usize, most: usize| {
        let edges = spans.iter().map(edge);
        edges.clone().max().unwrap_or(0) - edges.min().unwrap_or(0) <= most
    };
    within(|span| span.from, OFF) || within(|span| span.to, OFF) || within(|span| span.centre(), 2 * OFF)
}

/// The tables of a text whose rows are in aligned columns; `None` for any other text.
pub(super) fn tables(text: &str) -> Result<Option<Vec<RawTable>>, TextRefusal> {
    let all: Vec<Vec<Field>> = lines(text).map(|(number, line)| cells(&line, number)).collect();
    if is_transposed(&all) {
        return transposed(&all).map(Some);
    }
    let rows = all.iter().filter(|line| line.len() > 1 && holds_values(line)).count();
    let flowing = all.iter().filter(|line| flows(line)).count();
    if rows == 0 || rows < flowing {
        return Ok(None);
    }
    let parts = parts(all);
    if parts.is_empty() {
        return Ok(None);
    }
    if let Some(cell) = parts.iter().find_map(|part| part.alone.as_ref()) {
        return Err(unplaced_row(std::slice::from_ref(cell)));
    }
    parts.into_iter().map(table).collect::<Result<_, _>>().map(Some)
}

/// Whether a line has values with single blanks between them.
fn flows(line: &[Field]) -> bool {
    let mut words = line.iter().flat_map(|cell| cell.text.split(' ')).peekable();
    line.iter().any(|cell| cell.text.contains(' ')) && !holds_values(line) && words.all(is_value)
}

/// The headings that name a time, each with its rows.
fn parts(all: Vec<Vec<Field>>) -> Vec<Part> {
    let mut found: Vec<Part> = Vec::new();
    let mut waiting: Vec<Vec<Field>> = Vec::new();
    for line in all {
        let first = waiting.len().saturating_sub(MOST_LINES);
        let names_time = time_cell(&waiting[first..]).is_some();
        let last = found.last().filter(|_| !names_time);
        let heading = last.map_or(&waiting[first..], |part| &part.heading);
        if !is_row(&line, heading, last.and_then(|part| part.rows().last())) {
            waiting.push(line);
            continue;
        }
        if names_time {
            let heading = waiting.split_off(first);
            if let Some(part) = found.last_mut() {
                part.leave(&mut waiting);
            }
            waiting.clear();
            let alone = lone(&heading);
            found.push(Part { heading, pages: vec![Vec::new()], ignored: Vec::new(), alone });
        }
        let Some(part) = found.last_mut() else { continue };
        if !waiting.is_empty() {
            part.leave(&mut waiting);
            part.pages.push(Vec::new());
        }
        if let Some(page) = part.pages.last_mut() {
            page.push(line);
        }
    }
    if let Some(part) = found.last_mut() {
        part.leave(&mut waiting);
    }
    found
}

/// Columns with the cells of each row.
struct Grid {
    spans: Vec<Span>,
    rows: Vec<Vec<Option<Field>>>,
}

impl Grid {
    /// If each row has as many cells as a heading of one line, the columns by order.
    fn by_order(part: &Part) -> Option<Self> {
        let several: Vec<&Vec<Field>> = part.heading.iter().filter(|line| line.len() > 1).collect();
        let [heading] = several.as_slice() else { return None };
        let width = heading.len();
        if !part.rows().all(|row| row.len() == width) {
            return None;
        }
        // Another page may be indented otherwise.
        let first = &part.pages[0];
        let hull = |at: usize| first.iter().map(|row| Span::of(&row[at])).reduce(Span::hull);
        let spans = (0..width).map(hull).collect::<Option<_>>()?;
        let rows = part.rows().map(|row| row.iter().cloned().map(Some).collect()).collect();
        Some(Self { spans, rows })
    }

    /// The columns by position: cells that overlap, in whatever rows, are in one column.
    fn by_position(part: &Part) -> Result<Self, TextRefusal> {
        let mut rows: Vec<Vec<(Span, &Field)>> = Vec::new();
        for page in &part.pages {
            let by = shift(&part.pages[0], page).ok_or_else(|| unplaced_row(&page[0]))?;
            rows.extend(page.iter().map(|row| row.iter().map(|c| (Span::of(c).moved(by), c)).collect()));
        }
        let mut all: Vec<Span> = rows.iter().flatten().map(|(span, _)| *span).collect();
        all.sort_by_key(|span| span.from);
        let mut spans: Vec<Span> = Vec::new();
        for span in all {
            match spans.last_mut().filter(|last| last.overlaps(span)) {
                Some(last) => *last = last.hull(span),
                None => spans.push(span),
            }
        }
        let mut found = Vec::new();
        for row in &rows {
            let mut cells: Vec<Option<Field>> = vec![None; spans.len()];
            for (span, cell) in row {
                let at = spans.iter().position(|column| column.overlaps(*span)).unwrap_or(0);
                if cells[at].replace((*cell).clone()).is_some() {
                    return Err(unplaced_row(&bridge(&rows)));
                }
            }
            found.push(cells);
        }
        let grid = Self { spans, rows: found };
        let spans = if grid.is_full() { &[] } else { grid.spans.as_slice() };
        for column in spans {
            let of_row = rows.iter().flatten().filter(|(span, _)| column.overlaps(*span));
            let cells: Vec<(Span, &Field)> = of_row.copied().collect();
            let all: Vec<Span> = cells.iter().map(|(span, _)| *span).collect();
            if !are_aligned(&all) {
                let odd = cells.iter().find(|(span, _)| !is_near(*span, all[0])).unwrap_or(&cells[0]);
                return Err(unplaced_row(std::slice::from_ref(odd.1)));
            }
        }
        Ok(grid)
    }

    /// Whether each row has a cell in each column.
    fn is_full(&self) -> bool {
        self.rows.iter().flatten().all(Option::is_some)
    }
}

/// By how much a page is indented less than the first, by its first column; `None` if its edges do not tell.
fn shift(first: &[Vec<Field>], page: &[Vec<Field>]) -> Option<isize> {
    let edge = |page: &[Vec<Field>], of: fn(Span) -> usize| {
        let mut edges = page.iter().filter_map(|row| row.first()).map(|cell| of(Span::of(cell)));
        let one = edges.next()?;
        edges.all(|edge| edge == one).then(|| one.cast_signed())
    };
    let by = |of| edge(first, of).zip(edge(page, of)).map(|(first, page)| first - page);
    match (by(|span| span.from), by(|span| span.to)) {
        (Some(left), Some(right)) if left != right && left != 0 && right != 0 => None,
        (Some(0), _) | (_, Some(0)) | (None, None) => Some(0),
        (Some(by), _) | (None, Some(by)) => Some(by),
    }
}

/// The row with a cell over two cells of another row, or the first.
fn bridge(rows: &[Vec<(Span, &Field)>]) -> Vec<Field> {
    let joins = |row: &&Vec<(Span, &Field)>| {
        row.iter().any(|(own, _)| {
            rows.iter().any(|other| other.iter().filter(|(span, _)| span.overlaps(*own)).count() > 1)
        })
    };
    let row = rows.iter().find(joins).or(rows.first());
    row.into_iter().flatten().map(|(_, cell)| (*cell).clone()).collect()
}

fn unplaced_row(row: &[Field]) -> TextRefusal {
    let place = row.first().map_or_else(TextPlace::default, |cell| cell.place);
    let text: Vec<&str> = row.iter().map(|cell| cell.text.as_str()).collect();
    TextFault::CellUnplaced { text: text.join("  ") }.at(place)
}

fn unplaced_heading(cell: &Field) -> TextRefusal {
    TextFault::HeadingUnplaced { text: cell.text.clone() }.at(cell.place)
}

/// A cell of a heading with its columns.
struct Placed {
    cell: Field,
    columns: Vec<usize>,
    /// Whether it is the only cell of its line.
    alone: bool,
}

/// The columns of a table with the cells of its heading, from the top.
struct Headed {
    spans: Vec<Span>,
    placed: Vec<Placed>,
}

impl Headed {
    /// The cells over a column.
    fn cells(&self, column: usize) -> impl Iterator<Item = &Field> {
        let over = self.placed.iter().filter(move |placed| placed.columns.contains(&column));
        over.map(|placed| &placed.cell)
    }

    /// The words over a column.
    fn text(&self, column: usize) -> String {
        words(self.cells(column))
    }

    /// The words over a column with those of one more cell.
    fn text_with(&self, column: usize, cell: &Field) -> String {
        words(self.cells(column).chain([cell]))
    }

    /// Places the cells of a line over the columns in their order.
    fn add_in_order(&mut self, line: &[Field]) {
        for (at, cell) in line.iter().enumerate() {
            self.spans[at] = self.spans[at].hull(Span::of(cell));
            self.placed.push(Placed { cell: cell.clone(), columns: vec![at], alone: false });
        }
    }

    /// Places the cells that are alone in their lines.
    fn add_all_alone(&mut self, heading: &[Vec<Field>]) -> Result<(), TextRefusal> {
        let alone = heading.iter().rev().filter(|line| line.len() == 1);
        alone.into_iter().try_for_each(|line| self.add_alone(&line[0]))
    }

    /// The columns over which a cell stands; `None` if that is not clear.
    fn over(&self, cell: &Field) -> Option<Vec<usize>> {
        let own = Span::of(cell);
        let over: Vec<usize> =
            (0..self.spans.len()).filter(|column| self.spans[*column].overlaps(own)).collect();
        let is_of = |column: usize| {
            let span = self.spans[column];
            let others = self.placed.iter().filter(|placed| placed.columns == [column]);
            span.holds(own)
                || own.holds(span)
                || is_near(own, span)
                || others.into_iter().any(|placed| is_near(own, Span::of(&placed.cell)))
        };
        // A cell in the middle of two columns, and over the gap between them, belongs to both.
        let is_middle = |left: &usize| {
            let hull = self.spans[*left].hull(self.spans[left + 1]);
            hull.centre().abs_diff(own.centre()) <= 2 * OFF
        };
        match over.as_slice() {
            [column] if is_of(*column) => Some(over),
            [] | [_] => {
                let last = self.spans.len().saturating_sub(1);
                let reached =
                    |left: &usize| self.spans[*left].from < own.from && own.to < self.spans[left + 1].to;
                (0..last).find(|left| reached(left) && is_middle(left)).map(|left| vec![left, left + 1])
            }
            _ => Some(over),
        }
    }

    /// Whether a cell makes no difference to any column.
    fn is_harmless(&self, cell: &Field) -> bool {
        (0..self.spans.len())
            .all(|column| quantity(&self.text(column)) == quantity(&self.text_with(column, cell)))
    }

    /// Places the cells of a line of several.
    fn add_line(&mut self, line: &[Field]) -> Result<(), TextRefusal> {
        let mut placed: Vec<Placed> = Vec::new();
        for cell in line {
            let columns = self.over(cell);
            let free = |columns: &Vec<usize>| {
                columns.iter().all(|column| placed.iter().all(|other| !other.columns.contains(column)))
            };
            match columns.filter(free) {
                Some(columns) => placed.push(Placed { cell: cell.clone(), columns, alone: false }),
                None if self.is_harmless(cell) => {}
                None => return Err(unplaced_heading(cell)),
            }
        }
        self.placed.extend(placed);
        Ok(())
    }

    /// Whether a cell is in the line above the heading of a column so far, and aligned with it.
    fn is_next_above(&self, column: usize, cell: &Field) -> bool {
        let over = self.placed.iter().filter(|placed| placed.columns == [column]);
        let top = over.map(|placed| &placed.cell).min_by_key(|cell| cell.place);
        top.is_some_and(|top| top.place.line == cell.place.line + 1 && is_near(Span::of(top), Span::of(cell)))
    }

    /// Places a cell that is alone in its line, unless it is a title: it makes columns known that are not
    /// without it.
    fn add_alone(&mut self, cell: &Field) -> Result<(), TextRefusal> {
        let own = Span::of(cell);
        let begins = self.spans.first().is_some_and(|first| own.from <= first.from + OFF);
        let Some(columns) = self.over(cell) else {
            return if begins || self.is_harmless(cell) { Ok(()) } else { Err(unplaced_heading(cell)) };
        };
        let [mut known, mut new, mut is_title] = [false, false, begins];
        let mut is_word = !cell.text.contains(' ');
        let is_unknown = |column: &usize| quantity(&self.text(*column)).is_none();
        let is_part = columns.len() == 1 && (!begins || columns.iter().all(is_unknown));
        for column in &columns {
            let text = self.text(*column);
            match (quantity(&text), quantity(&self.text_with(*column, cell))) {
                (before, after) if before == after => {}
                (None, _) => new = true,
                (Some((channel, _)), _) => {
                    known = true;
                    // The title "Lateral crash pulse" says which ΔV is meant, if the column does not.
                    let tells = channel != Channel::Time && is_axis(&cell.text) && !is_axis(&text);
                    is_title &= !tells && (columns.len() > 1 || channel == Channel::Time);
                    is_word &= columns.len() == 1 && self.is_next_above(*column, cell);
                }
            }
        }
        if known && !is_title && !is_word {
            return Err(unplaced_heading(cell));
        }
        if (known && !is_title) || (!known && (new || is_part)) {
            self.placed.push(Placed { cell: cell.clone(), columns, alone: true });
        }
        Ok(())
    }

    /// Refuses a cell that may also belong to a column beside it: one whose heading is only an axis, or is
    /// the same as the rest of its own.
    fn is_clear(&self) -> Result<(), TextRefusal> {
        for placed in &self.placed {
            let in_line = |other: &&Placed| other.cell.place.line == placed.cell.place.line;
            let covered = |column: usize| {
                self.placed.iter().filter(in_line).any(|other| other.columns.contains(&column))
            };
            let (Some(first), Some(last)) = (placed.columns.first(), placed.columns.last()) else { continue };
            let left = (0..*first).rev().take_while(|column| !covered(*column));
            let right = (last + 1..self.spans.len()).take_while(|column| !covered(*column));
            let rest = words(self.cells(*first).filter(|cell| cell.place != placed.cell.place));
            for column in left.chain(right) {
                let text = self.text(column);
                let changes = quantity(&text) != quantity(&self.text_with(column, &placed.cell));
                let is_same = !rest.is_empty() && text == rest;
                let is_known = quantity(&text).is_some_and(|(channel, _)| channel != Channel::Other);
                if changes && (is_same || (!is_known && is_axis(&text)) || text.is_empty()) {
                    return Err(unplaced_heading(&placed.cell));
                }
            }
            // A cell in the middle of two columns names no time.
            if placed.columns.len() > 1 && !placed.alone {
                let has_time = |column: &usize| {
                    quantity(&self.text(*column)).is_some_and(|(channel, _)| channel == Channel::Time)
                };
                if placed.columns.iter().any(has_time) {
                    return Err(unplaced_heading(&placed.cell));
                }
            }
        }
        Ok(())
    }

    /// A cell of a column that has no heading of its own, but shares all of it with another column.
    fn stray(&self, grid: &Grid) -> Option<Field> {
        let has = |placed: &Placed, column: usize| placed.columns.contains(&column);
        let width = self.spans.len();
        let mut pairs = (0..width).flat_map(|one| (one + 1..width).map(move |other| (one, other)));
        let (one, other) = pairs
            .find(|(one, other)| self.placed.iter().all(|placed| has(placed, *one) == has(placed, *other)))?;
        let cells = |column: usize| grid.rows.iter().filter_map(move |row| row[column].as_ref());
        let rarer = if cells(one).count() < cells(other).count() { one } else { other };
        cells(rarer).next().cloned()
    }
}

/// The words of cells, from the top.
fn words<'a>(cells: impl Iterator<Item = &'a Field>) -> String {
    let mut cells: Vec<&Field> = cells.collect();
    cells.sort_by_key(|cell| cell.place);
    cells.iter().map(|cell| cell.text.as_str()).collect::<Vec<_>>().join(" ")
}

/// The quantity that a heading names, with its units, if it has one that fits.
fn quantity(text: &str) -> Option<(Channel, Vec<ChannelUnit>)> {
    head(text, TextPlace::default()).filter(|head| head.unit().is_ok()).map(|mut head| {
        head.units.retain(|unit| head.channel.takes(unit));
        (head.channel, head.units)
    })
}

/// Whether a heading names an axis.
fn is_axis(text: &str) -> bool {
    let plain = plain(text);
    Axis::of(plain.split_whitespace()).is_some()
}

/// The columns of a grid with their headings. A heading over no value is a column of empty cells, which is
/// put into the grid.
fn headed(heading: &[Vec<Field>], grid: &mut Grid) -> Result<Headed, TextRefusal> {
    let width = grid.spans.len();
    let whole = heading.iter().rposition(|line| line.len() == width);
    let longest = heading.iter().map(Vec::len).max().unwrap_or(0);
    let base = whole.or_else(|| heading.iter().rposition(|line| line.len() == longest)).unwrap_or(0);
    let mut headed = Headed { spans: grid.spans.clone(), placed: Vec::new() };
    let Some(line) = heading.get(base) else { return Ok(headed) };
    let over = |cell: &Field| -> Vec<usize> {
        (0..width).filter(|column| grid.spans[*column].overlaps(Span::of(cell))).collect()
    };
    let covered: Vec<Vec<usize>> = line.iter().map(over).collect();
    if line.len() == width {
        for (at, (cell, over)) in line.iter().zip(&covered).enumerate() {
            let is_own = over.as_slice() == [at] || (over.is_empty() && grid.is_full());
            if !is_own {
                return Err(unplaced_heading(cell));
            }
        }
    } else if line.len() > width {
        if !covered.iter().flatten().copied().eq(0..width) {
            let odd = covered.iter().position(|over| over.len() != 1).unwrap_or(0);
            return Err(unplaced_heading(&line[odd]));
        }
        for (at, over) in covered.iter().enumerate() {
            if over.is_empty() {
                headed.spans.insert(at, Span::of(&line[at]));
                grid.rows.iter_mut().for_each(|row| row.insert(at, None));
            }
        }
    }
    if line.len() >= width {
        headed.add_in_order(line);
    } else {
        headed.add_line(line)?;
    }
    for (_, line) in heading.iter().enumerate().filter(|(at, line)| *at != base && line.len() > 1) {
        headed.add_line(line)?;
    }
    headed.add_all_alone(heading)?;
    Ok(headed)
}

/// The heading of a table whose columns are those by order.
fn headed_by_order(heading: &[Vec<Field>], grid: &Grid) -> Result<Headed, TextRefusal> {
    let mut headed = Headed { spans: grid.spans.clone(), placed: Vec::new() };
    for line in heading.iter().filter(|line| line.len() > 1) {
        headed.add_in_order(line);
    }
    headed.add_all_alone(heading)?;
    Ok(headed)
}

/// The table of a heading and its rows.
fn table(part: Part) -> Result<RawTable, TextRefusal> {
    let (grid, headed) = match Grid::by_order(&part) {
        Some(grid) => {
            let headed = headed_by_order(&part.heading, &grid)?;
            (grid, headed)
        }
        None => {
            let mut grid = Grid::by_position(&part)?;
            let headed = headed(&part.heading, &mut grid)?;
            (grid, headed)
        }
    };
    let mut columns: Vec<(Head, Vec<Token>)> = Vec::new();
    for (at, span) in headed.spans.iter().enumerate() {
        let text = headed.text(at);
        let of_column = headed.placed.iter().filter(|placed| placed.columns.contains(&at));
        let place = of_column.map(|placed| placed.cell.place).min();
        let Some(place) = place else {
            let value = grid.rows.iter().find_map(|row| row[at].clone());
            return Err(unplaced_row(value.as_slice()));
        };
        let unread = Head::of(text.clone(), Channel::Other, Vec::new(), place);
        let mut found = head(&text, place).unwrap_or(unread);
        found.text = text;
        let absent = |row: &[Option<Field>]| {
            let line = row.iter().flatten().next().map_or(place.line, |cell| cell.place.line);
            Token { text: String::new(), bracket: None, place: TextPlace { line, column: span.from } }
        };
        let cell = |row: &Vec<Option<Field>>| row[at].as_ref().map_or_else(|| absent(row), token);
        columns.push((found, grid.rows.iter().map(cell).collect()));
    }
    if let Some(cell) = headed.stray(&grid) {
        return Err(unplaced_row(&[cell]));
    }
    headed.is_clear()?;
    let time = columns.iter().find(|(head, _)| head.channel == Channel::Time);
    if let Some(at) = time.and_then(|(_, cells)| cells.iter().position(Token::is_empty)) {
        let row: Vec<Field> = grid.rows[at].iter().flatten().cloned().collect();
        return Err(unplaced_row(&row));
    }
    let mut table = RawTable { layout: TextLayout::Aligned, columns, ignored: part.ignored };
    delimited::close(&mut table);
    Ok(table)
}

/// The tables of lines that begin with a quantity. A line with fewer values than times has them below the
/// times over which they stand.
fn transposed(all: &[Vec<Field>]) -> Result<Vec<RawTable>, TextRefusal> {
    let mut spans: Vec<Span> = Vec::new();
    let mut whole: Vec<Vec<Field>> = Vec::new();
    for line in all {
        if let Some((_, values)) = label(line, None).filter(|(head, _)| head.channel == Channel::Time) {
            spans = values.iter().map(Span::of).collect();
            let width = spans.len();
            for row in all.iter().filter(|row| is_whole(row, width)) {
                spans.iter_mut().zip(&row[1..]).for_each(|(span, cell)| *span = span.hull(Span::of(cell)));
            }
        }
        whole.push(if is_whole(line, spans.len()) { line.clone() } else { below(line, &spans)? });
    }
    Ok(delimited::transposed(&whole))
}

/// Whether a line has a label in one cell, and after it as many values as there are times.
fn is_whole(line: &[Field], times: usize) -> bool {
    line.len() == times + 1 && holds_values(&line[1..])
}

/// A line with its label in one cell, and a cell for each of these spans.
fn below(line: &[Field], spans: &[Span]) -> Result<Vec<Field>, TextRefusal> {
    let is_below = |cell: &Field| spans.iter().any(|span| span.overlaps(Span::of(cell)));
    let first = line.iter().position(|cell| is_value(&token(cell).text) || is_below(cell));
    let Some(first) = first.filter(|first| *first > 0) else { return Ok(line.to_vec()) };
    let (names, values) = line.split_at(first);
    let text = names.iter().map(|cell| cell.text.as_str()).collect::<Vec<_>>().join(" ");
    if values.len() > spans.len() || head(&text, names[0].place).is_none() {
        return Ok(line.to_vec());
    }
    let end = |span: &Span| TextPlace { column: span.from, ..names[0].place };
    let mut found = vec![Field { text, place: names[0].place }];
    found.extend(spans.iter().map(|span| Field { text: String::new(), place: end(span) }));
    for cell in values {
        let mut over = (0..spans.len()).filter(|at| spans[*at].overlaps(Span::of(cell)));
        match (over.next(), over.next()) {
            (Some(at), None) if found[at + 1].text.is_empty() => found[at + 1] = cell.clone(),
            _ => return Err(unplaced_row(std::slice::from_ref(cell))),
        }
    }
    Ok(found)
}
