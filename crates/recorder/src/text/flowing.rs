//! Text as it copies out of a printed report: lines of words and values without a sure character between
//! them.

use super::heads::{Head, heads};
use super::raw::RawTable;
use super::tokens::{Piece, Token, Word, line, number};
use crate::channel::Channel;
use crate::table::{TextLayout, TextPlace, TextRefusal};

/// A heading and the lines of values below it or beside it.
#[derive(Default)]
struct Segment {
    heads: Vec<Head>,
    lines: Vec<Vec<Token>>,
}

impl Segment {
    fn names_time(&self) -> bool {
        self.heads.iter().any(|head| head.channel == Channel::Time)
    }

    fn flat(&self) -> Vec<Token> {
        self.lines.iter().flatten().cloned().collect()
    }
}

/// The values at the end of a line behind its words, where a quantity stands with its values in one line.
fn trailing(pieces: &[Piece], pending: &[Word]) -> usize {
    let count = pieces.iter().rev().take_while(|piece| matches!(piece, Piece::Value(_))).count();
    let of_numbers = pieces[pieces.len() - count..].iter().any(
        |piece| matches!(piece, Piece::Value(token) if number(&token.text, true).is_some() || token.bracket.is_some()),
    );
    // "Service brake, on off": the values that a switch may have, and not those that it has.
    if count < 2 || (count == 2 && !of_numbers) {
        return 0;
    }
    let mut words = pending.to_vec();
    words.extend(pieces[..pieces.len() - count].iter().filter_map(word));
    if heads(&words).is_empty() { 0 } else { count }
}

fn word(piece: &Piece) -> Option<Word> {
    match piece {
        Piece::Word(word) => Some(word.clone()),
        Piece::Value(_) => None,
    }
}

/// A piece of a heading: numbers in it are words, too.
fn as_word(piece: Piece) -> Word {
    match piece {
        Piece::Word(word) => word,
        Piece::Value(Token { text, place, .. }) => Word { text, within: false, place },
    }
}

fn segments(text: &str) -> Vec<Segment> {
    let mut found: Vec<Segment> = Vec::new();
    let mut pending: Vec<Word> = Vec::new();
    for (k, content) in text.lines().enumerate() {
        let mut pieces = line(content, k + 1);
        let last = found.last().and_then(|segment| segment.lines.last()?.last());
        let names_zero = content.trim().trim_matches(['(', ')']).eq_ignore_ascii_case("trg")
            && last.is_some_and(|token| number(&token.text, false) == Some(0.0));
        if pieces.is_empty() || names_zero {
            continue;
        }
        let is_values = pieces.iter().all(|piece| matches!(piece, Piece::Value(_)));
        let count = if is_values { pieces.len() } else { trailing(&pieces, &pending) };
        let values = pieces.split_off(pieces.len() - count);
        pending.extend(pieces.into_iter().map(as_word));
        if count == 0 {
            continue;
        }
        let named = heads(&pending);
        let in_rows = found.last().is_some_and(|last| last.heads.len() >= 2);
        // A footer between the rows of a table names nothing: the rows go on.
        if !named.is_empty() || (!pending.is_empty() && !in_rows) || found.is_empty() {
            found.push(Segment { heads: named, lines: Vec::new() });
        }
        pending.clear();
        let tokens = values.into_iter().filter_map(|piece| match piece {
            Piece::Value(token) => Some(token),
            Piece::Word(_) => None,
        });
        if let Some(segment) = found.last_mut() {
            segment.lines.push(tokens.collect());
        }
    }
    // A heading at the end, with nothing below it, so that it is told.
    let named = heads(&pending);
    if named.len() >= 2 {
        found.push(Segment { heads: named, lines: Vec::new() });
    }
    found
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
        return Err(TextRefusal::NoRows { heading: title, place: first });
    }
    // A title above the table that names a quantity of it, "Longitudinal delta-V, 0 to 250 ms", is no column.
    if let Some(time) = segment.heads.iter().position(|head| head.channel == Channel::Time) {
        segment.heads.drain(..time);
    }
    let width = segment.heads.len();
    let counts: Vec<usize> = segment.lines.iter().map(Vec::len).collect();
    let whole = counts.iter().all(|count| *count == width);
    let flat = segment.flat();
    let broken = counts.iter().filter(|count| **count == 1).count() * 2 > counts.len();
    let uneven = || {
        let names: Vec<&str> = segment.heads.iter().map(|head| head.channel.name()).collect();
        let odd = segment.lines.iter().find(|line| line.len() != width);
        let odd = odd.filter(|_| !broken).and_then(|line| line.first());
        let place = odd.or(flat.last()).map_or(first, |token| token.place);
        let found = if broken { flat.len() % width } else { odd_count(&counts, width) };
        TextRefusal::Uneven { place, found, expected: width, columns: names.join(", ") }
    };
    if !flat.len().is_multiple_of(width) {
        return Err(uneven());
    }
    let rows = flat.len() / width;
    let by_rows = are_times(flat.iter().step_by(width)) || rows == 1;
    let by_columns = are_times(flat.iter().take(rows));
    let layout = match (whole, by_rows, by_columns) {
        (true, ..) => TextLayout::RowLines,
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
    Ok(RawTable { layout, columns, ignored: Vec::new() })
}

/// The values of the first line that has another number of them than the heading.
fn odd_count(counts: &[usize], width: usize) -> usize {
    counts.iter().copied().find(|count| *count != width).unwrap_or(0)
}

/// After how many columns the headings begin anew.
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

/// A table of quantities with their values behind or below each.
fn of_blocks(segments: Vec<Segment>) -> RawTable {
    let across = segments.iter().any(|segment| segment.lines.first().is_some_and(|line| line.len() > 1));
    let layout = if across { TextLayout::Transposed } else { TextLayout::ColumnAfterColumn };
    let (mut columns, mut ignored) = (Vec::new(), Vec::new());
    for segment in segments {
        // With several quantities named before the values, the last is theirs: a title stands above it.
        let Some(head) = segment.heads.last().cloned() else { continue };
        let cells = segment.flat();
        if head.channel == Channel::Other {
            ignored.push((head.text, head.place));
            continue;
        }
        columns.push((head, cells));
    }
    RawTable { layout, columns, ignored }
}

/// The tables of a flowing text.
pub(crate) fn tables(text: &str) -> Result<Vec<RawTable>, TextRefusal> {
    let mut found = Vec::new();
    let mut blocks: Vec<Segment> = Vec::new();
    let mut rows: Option<Segment> = None;
    let mut finish = |blocks: &mut Vec<Segment>, rows: &mut Option<Segment>| -> Result<(), TextRefusal> {
        if blocks.iter().any(|segment| !segment.heads.is_empty()) {
            found.push(of_blocks(std::mem::take(blocks)));
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
