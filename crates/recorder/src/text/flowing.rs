//! Text copied out of a printed report: lines of words and values without a reliable separator between them.

use super::heads::{Head, heads, labels, quoted};
use super::raw::{self, RawTable};
use super::rows::{self, Cell};
use super::tokens::{Piece, Token, Word, bare, is_value, line, number};
use crate::channel::Channel;
use crate::table::{TextFault, TextLayout, TextPlace, TextRefusal};

/// A heading and the lines of values below it or next to it.
#[derive(Default)]
struct Segment {
    heads: Vec<Head>,
    lines: Vec<Vec<Token>>,
    /// Lines that were not read.
    unread: Vec<(String, TextPlace)>,
}

impl Segment {
    fn names_time(&self) -> bool {
        self.heads.iter().any(|head| head.channel == Channel::Time)
    }

    fn flat(&self) -> Vec<Token> {
        self.lines.iter().flatten().cloned().collect()
    }

    /// The number of times, if they are in one line.
    fn across(&self) -> Option<usize> {
        let times = self.lines.first().filter(|_| self.names_time() && row_width(&self.heads).is_none())?;
        (times.len() > 1).then(|| self.lines.iter().map(Vec::len).sum())
    }
}

/// The number of columns below a heading: a time followed by quantities.
fn row_width(heads: &[Head]) -> Option<usize> {
    let time = heads.iter().position(|head| head.channel == Channel::Time)?;
    let last = heads.iter().rposition(|head| head.channel == Channel::Time)?;
    (last + 1 < heads.len()).then(|| heads.len() - time)
}

/// The number of values at the end of a line after its words, if a quantity and its values are in one line.
fn trailing(pieces: &[Piece], pending: &[Word]) -> usize {
    let count = pieces.iter().rev().take_while(|piece| matches!(piece, Piece::Value(_))).count();
    let of_numbers = pieces[pieces.len() - count..].iter().any(
        |piece| matches!(piece, Piece::Value(token) if number(&token.text, true).is_some() || token.bracket.is_some()),
    );
    // "Service brake, on off": the values that a switch may have, and not those that it has.
    if count < 2 || (count == 2 && !of_numbers) {
        return 0;
    }
    if heads(&with(pending, &pieces[..pieces.len() - count])).is_empty() { 0 } else { count }
}

/// Times in the line of their name, each with its unit: "Time -1.0 sec -0.5 sec".
fn times_across(pieces: &[Piece]) -> Option<Line> {
    let first = pieces.iter().position(|piece| matches!(piece, Piece::Value(_)))?;
    let (label, values) = pieces.split_at(first);
    let cells = rows::cells(values);
    let is_time = channels(&heads(&with(&[], label))) == [Channel::Time];
    let are_values = cells.len() > 1 && cells.len() < values.len() && cells.iter().all(|cell| !cell.is_word);
    (is_time && are_values).then(|| Line::Labelled(label.to_vec(), rows::tokens(cells)))
}

fn word(piece: &Piece) -> Option<Word> {
    match piece {
        Piece::Word(word) => Some(word.clone()),
        Piece::Value(_) => None,
    }
}

/// Words and those among these pieces.
fn with(pending: &[Word], pieces: &[Piece]) -> Vec<Word> {
    pending.iter().cloned().chain(pieces.iter().filter_map(word)).collect()
}

/// A piece of a heading: numbers in it are words, too.
fn as_word(piece: Piece) -> Word {
    match piece {
        Piece::Word(word) => word,
        Piece::Value(Token { text, place, .. }) => Word { text, within: false, place },
    }
}

/// Words as printed, with the place of the first.
fn phrase(words: &[Word]) -> (String, TextPlace) {
    let text: Vec<&str> = words.iter().map(|word| word.text.as_str()).collect();
    (text.join(" "), words.first().map_or_else(TextPlace::default, |word| word.place))
}

/// The kind of a line.
enum Line {
    /// Cells.
    Values(Vec<Token>),
    /// Words, and the cells of the quantity that they name.
    Labelled(Vec<Piece>, Vec<Token>),
    /// Words that belong to a heading, or to none.
    Words(Vec<Piece>),
    /// A row that is not read.
    Unread((String, TextPlace)),
}

/// The segments so far, and the words that wait for their values.
#[derive(Default)]
struct Segments {
    found: Vec<Segment>,
    pending: Vec<Word>,
    /// The last that names a time.
    of_time: Option<usize>,
}

/// (words) more than any heading has: of a text without tables, no more are kept.
const LONGEST_HEADING: usize = 500;

impl Segments {
    fn line(&self, pieces: Vec<Piece>) -> Line {
        let cells = rows::cells(&pieces);
        if cells.iter().all(|cell| !cell.is_word) && matches!(pieces.first(), Some(Piece::Value(_))) {
            return Line::Values(rows::tokens(cells));
        }
        if let Some(row) = self.row(&pieces, &cells) {
            return row;
        }
        if let Some(row) = self.row_across(&pieces) {
            return row;
        }
        if let Some(times) = times_across(&pieces) {
            return times;
        }
        let count = trailing(&pieces, &self.pending);
        let (label, values) = pieces.split_at(pieces.len() - count);
        if count == 0 {
            return Line::Words(pieces);
        }
        Line::Labelled(label.to_vec(), rows::tokens(rows::cells(values)))
    }

    /// A row below a heading, with words among its values: it begins with a time, or has only values after
    /// the cell in the place of the time.
    fn row(&self, pieces: &[Piece], cells: &[Cell]) -> Option<Line> {
        let values = cells.iter().filter(|cell| !cell.is_word).count();
        let is_time = |token: &Token| number(bare(&token.text), false).is_some();
        let begins = matches!(pieces.first(), Some(Piece::Value(token)) if is_time(token));
        if !begins && values < 2 {
            return None;
        }
        let waiting = row_width(&heads(&self.pending));
        let width = waiting.or_else(|| row_width(&self.found.last()?.heads))?;
        let fitted = rows::fitted(pieces, width);
        if !begins {
            let is_row = width > 2 && values + 1 == width && cells.len() == width;
            return fitted.filter(|_| is_row).map(Line::Values);
        }
        match fitted {
            Some(tokens) => Some(Line::Values(tokens)),
            // In a heading, a line such as "0 to 100 (%)" is a part of it.
            None if waiting.is_some() => None,
            None if values > 1 => Some(Line::Values(rows::tokens(cells.to_vec()))),
            None => Some(Line::Unread(phrase(&pieces.iter().cloned().map(as_word).collect::<Vec<_>>()))),
        }
    }

    /// The number of times across, while quantities with their values follow them.
    fn across(&self) -> Option<usize> {
        self.found
            .get(self.of_time?)?
            .across()
            .filter(|_| heads(&self.pending).iter().all(|head| head.channel != Channel::Time))
    }

    /// A quantity, known or not, with a cell for each of the times across.
    fn row_across(&self, pieces: &[Piece]) -> Option<Line> {
        let width = self.across()?;
        let first = pieces.iter().position(|piece| matches!(piece, Piece::Value(_))).unwrap_or(pieces.len());
        let (label, values) = pieces.split_at(first);
        let words = with(&[], label);
        let own = heads(&words);
        if first == 0 || own.iter().any(|head| head.channel == Channel::Time) {
            return None;
        }
        if let Some(tokens) = rows::fitted(values, width) {
            return Some(Line::Labelled(label.to_vec(), tokens));
        }
        let named = labels(&words).last().map(Head::named);
        let cells = rows::cells(values);
        // "ABS Fault Off On": the words after the name belong to the first times.
        let missing = width.saturating_sub(cells.len());
        let spare = words.iter().rev().take_while(|word| !word.within).count();
        let free = words.iter().filter(|word| !word.within).count();
        let is_cells = named.is_some_and(|named| missing > 0 && missing <= spare && free >= named + missing);
        if is_cells && values.is_empty() {
            return Some(Line::Unread(phrase(&words[..words.len() - missing])));
        }
        let (label, behind) = label.split_at(first - if is_cells { missing } else { 0 });
        let tokens = rows::tokens(rows::cells(&pieces[first - behind.len()..]));
        let some_values = cells.iter().filter(|cell| !cell.is_word).count() > 1;
        let some_words = cells.iter().any(|cell| cell.is_word);
        (is_cells || (named.is_some() && some_values && some_words))
            .then(|| Line::Labelled(label.to_vec(), tokens))
    }

    fn add(&mut self, line: Line) {
        let is_below = matches!(line, Line::Values(_));
        let (words, values) = match line {
            Line::Values(values) => (Vec::new(), values),
            Line::Labelled(words, values) => (words, values),
            Line::Words(words) => (words, Vec::new()),
            Line::Unread(unread) => {
                if let Some(last) = self.found.last_mut() {
                    last.unread.push(unread);
                }
                return;
            }
        };
        self.pending.extend(words.into_iter().map(as_word));
        if values.is_empty() {
            self.pending.drain(..self.pending.len().saturating_sub(LONGEST_HEADING));
            return;
        }
        if is_below && self.goes_on(&values) {
            self.pending.clear();
        }
        let named = self.named();
        let in_rows = self.found.last().is_some_and(|last| row_width(&last.heads).is_some());
        // A footer between the rows of a table names nothing: the rows go on.
        if !named.is_empty() || (!self.pending.is_empty() && !in_rows) || self.found.is_empty() {
            let segment = Segment { heads: named, ..Segment::default() };
            self.of_time = if segment.names_time() { Some(self.found.len()) } else { self.of_time };
            self.found.push(segment);
        }
        self.pending.clear();
        if let Some(segment) = self.found.last_mut() {
            segment.lines.push(values);
        }
    }

    /// Whether a line is the next row of the table although the words before it name a quantity, as a note
    /// may: its time follows after the same step.
    fn goes_on(&self, values: &[Token]) -> bool {
        let names_time = [heads(&self.pending), labels(&self.pending)]
            .concat()
            .iter()
            .any(|head| head.channel == Channel::Time);
        let Some(last) = self.found.last().filter(|_| !names_time) else { return false };
        let [.., before, now] = last.lines.as_slice() else { return false };
        let time = |row: &[Token]| number(bare(&row.first()?.text), false);
        let (Some(before), Some(now), Some(next)) = (time(before), time(now), time(values)) else {
            return false;
        };
        let step = now - before;
        row_width(&last.heads) == Some(values.len()) && (next - now - step).abs() < 0.01 * step.abs()
    }

    /// The headings that the waiting words name: columns, or one quantity in each line.
    fn named(&self) -> Vec<Head> {
        let columns = heads(&self.pending);
        if row_width(&columns).is_some() {
            return columns;
        }
        let labels = labels(&self.pending);
        if labels.is_empty() && !self.pending.is_empty() && self.across().is_some() {
            let (text, place) = phrase(&self.pending);
            return vec![Head::of(text, Channel::Other, Vec::new(), place)];
        }
        labels
    }
}

fn segments(text: &str) -> Vec<Segment> {
    let mut all = Segments::default();
    for (k, content) in text.lines().enumerate() {
        let pieces = line(content, k + 1);
        let last = all.found.last().and_then(|segment| segment.lines.last()?.last());
        let names_zero = content.trim().trim_matches(['(', ')']).eq_ignore_ascii_case("trg")
            && last.is_some_and(|token| number(&token.text, false) == Some(0.0));
        if !pieces.is_empty() && !names_zero {
            let line = all.line(pieces);
            all.add(line);
        }
    }
    // A heading at the end with nothing below it is kept, so that it is reported.
    let named = heads(&all.pending);
    let is_cut = all.across().is_some() && named.iter().any(|head| cells_in(head) > 0);
    if named.len() >= 2 || is_cut {
        all.found.push(Segment { heads: named, ..Segment::default() });
    }
    all.found
}

fn channels(heads: &[Head]) -> Vec<Channel> {
    heads.iter().map(|head| head.channel).collect()
}

/// Whether these values are times, one after the other.
fn are_times<'a>(mut values: impl Iterator<Item = &'a Token>) -> bool {
    let read: Option<Vec<f64>> = values.try_fold(Vec::new(), |mut all, token| {
        all.push(number(&token.text, false)?);
        Some(all)
    });
    read.is_some_and(|times| {
        times.len() >= 2
            && (times.windows(2).all(|pair| pair[0] < pair[1])
                || times.windows(2).all(|pair| pair[0] > pair[1]))
    })
}

/// A table with its rows below the heading.
fn of_rows(mut segment: Segment) -> Result<RawTable, TextRefusal> {
    let first = segment.heads.first().map_or_else(TextPlace::default, |head| head.place);
    let title = segment.heads.iter().map(|head| head.text.as_str()).collect::<Vec<_>>().join(" | ");
    if segment.lines.is_empty() {
        return Err(TextFault::NoRows { heading: title }.at(first));
    }
    // A title above the table that names a quantity of it, "Longitudinal delta-V, 0 to 250 ms", is not a
    // column.
    if let Some(time) = segment.heads.iter().position(|head| head.channel == Channel::Time) {
        segment.heads.drain(..time);
    }
    let width = segment.heads.len();
    // A dash alone is a missing value, unless the rows only fit their heading if it is a minus.
    if segment.lines.iter().any(|line| line.len() != width) {
        let joined: Vec<Vec<Token>> = segment.lines.iter().map(|line| with_minuses(line)).collect();
        if joined.iter().all(|line| line.len() == width) {
            segment.lines = joined;
        }
    }
    let counts: Vec<usize> = segment.lines.iter().map(Vec::len).collect();
    let whole = counts.iter().all(|count| *count == width);
    let flat = segment.flat();
    let broken = counts.iter().filter(|count| **count == 1).count() * 2 > counts.len();
    let uneven = || {
        let odd = segment.lines.iter().find(|line| line.len() != width);
        let odd = odd.filter(|_| !broken).and_then(|line| line.first());
        let place = odd.or(flat.last()).map_or(first, |token| token.place);
        let found = if broken { flat.len() % width } else { odd_count(&counts, width) };
        let apart = if flat.iter().any(|token| token.text == "-") {
            "; a minus apart from its number counts as a value: join them"
        } else {
            ""
        };
        let columns = format!("{}{apart}", quoted(segment.heads.iter()));
        TextFault::Uneven { found, expected: width, columns }.at(place)
    };
    if !flat.len().is_multiple_of(width) {
        return Err(uneven());
    }
    let rows = flat.len() / width;
    let by_rows = are_times(flat.iter().step_by(width)) || rows == 1;
    let by_columns = are_times(flat.iter().take(rows));
    let layout = match (whole, by_rows, by_columns) {
        (true, ..) => TextLayout::RowLines,
        (false, true, true) => either(&segment.heads, &flat).ok_or_else(|| TextFault::EitherWay.at(first))?,
        (false, true, _) => TextLayout::RowAfterRow,
        (false, false, true) => TextLayout::ColumnAfterColumn,
        (false, false, false) => return Err(uneven()),
    };
    let cell = |row: usize, column: usize| match layout {
        TextLayout::ColumnAfterColumn => flat[column * rows + row].clone(),
        _ => flat[row * width + column].clone(),
    };
    // Two or three tables side by side have the same headings again.
    let period = repeated(&segment.heads);
    let mut columns: Vec<(Head, Vec<Token>)> =
        segment.heads.iter().take(period).map(|head| (head.clone(), Vec::new())).collect();
    for group in 0..width / period {
        for row in 0..rows {
            for (k, (_, cells)) in columns.iter_mut().enumerate() {
                cells.push(cell(row, group * period + k));
            }
        }
    }
    Ok(RawTable { layout, columns, ignored: segment.unread })
}

/// Whether values in either order are row after row or column after column: that in which each is a value of
/// its column, and the times have equal steps.
fn either(heads: &[Head], flat: &[Token]) -> Option<TextLayout> {
    let rows = flat.len() / heads.len();
    let of_column = |column: usize, by_rows: bool| {
        let at = move |row: usize| if by_rows { row * heads.len() + column } else { column * rows + row };
        (0..rows).map(move |row| &flat[at(row)])
    };
    let is_even = |by_rows: bool| {
        let times: Vec<f64> = of_column(0, by_rows).filter_map(|token| number(&token.text, false)).collect();
        let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
        steps.clone().all(|step| (step - (times[1] - times[0])).abs() < 0.01 * step.abs())
    };
    let fits = |by_rows: &bool| {
        let fits = |(column, head): (usize, &Head)| {
            of_column(column, *by_rows).all(|token| raw::may_be(token, head.channel))
        };
        heads.iter().enumerate().all(fits)
    };
    let fitting: Vec<bool> = [true, false].into_iter().filter(fits).collect();
    let even: Vec<bool> = fitting.iter().copied().filter(|by_rows| is_even(*by_rows)).collect();
    match (fitting.as_slice(), even.as_slice()) {
        ([by_rows], _) | (_, [by_rows]) if *by_rows => Some(TextLayout::RowAfterRow),
        ([_], _) | (_, [_]) => Some(TextLayout::ColumnAfterColumn),
        _ => None,
    }
}

/// The values of a line, with each minus joined to the number after it: `- 5.0`.
fn with_minuses(line: &[Token]) -> Vec<Token> {
    let mut joined: Vec<Token> = Vec::with_capacity(line.len());
    for token in line {
        match joined.last_mut() {
            Some(minus)
                if minus.text == "-" && number(&token.text, false).is_some_and(|value| value >= 0.0) =>
            {
                *minus = Token { text: format!("-{}", token.text), place: minus.place, ..token.clone() };
            }
            _ => joined.push(token.clone()),
        }
    }
    joined
}

/// The values of the first line that has another number of them than the heading.
fn odd_count(counts: &[usize], width: usize) -> usize {
    counts.iter().copied().find(|count| *count != width).unwrap_or(0)
}

/// The number of columns after which the headings repeat.
fn repeated(heads: &[Head]) -> usize {
    let all = channels(heads);
    let next = all.iter().skip(1).position(|channel| *channel == Channel::Time).map(|k| k + 1);
    match next {
        Some(period)
            if all.len().is_multiple_of(period)
                && all.chunks(period).all(|group| *group == all[..period]) =>
        {
            period
        }
        _ => all.len(),
    }
}

/// The number of values at the end of a heading, "Service Brake Off On".
fn cells_in(head: &Head) -> usize {
    head.text.split_whitespace().rev().take_while(|word| is_value(word)).count()
}

/// Refuses a quantity with values in its line, but fewer than there are times: which of them it has is not
/// sure.
fn whole(head: &Head, times: usize) -> Result<(), TextRefusal> {
    let found = cells_in(head);
    if found == 0 || found >= times || matches!(head.channel, Channel::Time | Channel::Other) {
        return Ok(());
    }
    let columns =
        format!("as many as there are times, for {}; write - for one that is empty", head.channel.name());
    Err(TextFault::Uneven { found, expected: times, columns }.at(head.place))
}

/// A table of quantities, each with its values after or below it.
fn of_blocks(segments: Vec<Segment>) -> Result<RawTable, TextRefusal> {
    let across = segments.iter().any(|segment| segment.lines.first().is_some_and(|line| line.len() > 1));
    let layout = if across { TextLayout::Transposed } else { TextLayout::ColumnAfterColumn };
    let times = segments.iter().find_map(Segment::across).unwrap_or(0);
    let (mut columns, mut ignored) = (Vec::new(), Vec::new());
    for segment in segments {
        // With several quantities named before the values, the last is theirs. Above the times, the other
        // names are a title; elsewhere, they are quantities whose values were not recognised.
        let Some((head, above)) = segment.heads.split_last() else { continue };
        let (head, cells) = (head.clone(), segment.flat());
        if head.channel != Channel::Time {
            above.iter().try_for_each(|head| whole(head, times))?;
            ignored.extend(above.iter().map(|head| (head.text.clone(), head.place)));
        }
        if cells.is_empty() {
            whole(&head, times)?;
        }
        ignored.extend(segment.unread);
        if head.channel == Channel::Other {
            ignored.push((head.text, head.place));
            continue;
        }
        columns.push((head, cells));
    }
    Ok(RawTable { layout, columns, ignored })
}

/// The tables of a flowing text.
pub(crate) fn tables(text: &str) -> Result<Vec<RawTable>, TextRefusal> {
    let mut found = Vec::new();
    let mut blocks: Vec<Segment> = Vec::new();
    let mut rows: Option<Segment> = None;
    let mut finish = |blocks: &mut Vec<Segment>, rows: &mut Option<Segment>| -> Result<(), TextRefusal> {
        let is_note = |segment: &Segment| {
            segment.lines.is_empty() && !segment.heads.iter().any(|head| cells_in(head) > 0)
        };
        if let Some(open) = rows.as_mut().filter(|_| blocks.iter().all(is_note)) {
            // Words that follow the rows, and name quantities without values.
            let heads = blocks.drain(..).flat_map(|segment| segment.heads);
            open.unread.extend(heads.map(|head| (head.text, head.place)));
        }
        if blocks.iter().any(|segment| !segment.heads.is_empty()) {
            found.push(of_blocks(std::mem::take(blocks))?);
        }
        blocks.clear();
        if let Some(segment) = rows.take() {
            found.push(of_rows(segment)?);
        }
        Ok(())
    };
    for segment in segments(text) {
        let after_time = segment.heads.iter().rev().take_while(|head| head.channel != Channel::Time).count();
        let is_rows = segment.names_time() && after_time > 0;
        match &mut rows {
            Some(open) if is_rows && channels(&open.heads) == channels(&segment.heads) => {
                open.lines.extend(segment.lines);
                open.unread.extend(segment.unread);
                continue;
            }
            _ if is_rows || segment.names_time() => finish(&mut blocks, &mut rows)?,
            _ => {}
        }
        if is_rows {
            rows = Some(segment);
        } else {
            blocks.push(segment);
        }
    }
    finish(&mut blocks, &mut rows)?;
    Ok(found)
}
