//! Text with a character between its fields.

use std::borrow::Cow;

use super::heads::{Head, heading, quoted};
use super::raw::RawTable;
use super::tokens::{Token, Word, bare, is_value, number};
use crate::channel::{Channel, plain, unit_of};
use crate::table::{TextFault, TextLayout, TextPlace, TextRefusal};

/// A field of a line.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) text: String,
    pub(super) place: TextPlace,
}

/// The fields of a line, quotes taken off.
pub(super) fn fields(line: &str, number: usize, delimiter: char) -> Vec<Field> {
    let mut found = Vec::new();
    let (mut text, mut column, mut first, mut quoted) = (String::new(), 0, 1, false);
    let mut close = |text: &mut String, first: usize| {
        let lead = text.chars().take_while(|letter| letter.is_whitespace()).count();
        let place = TextPlace { line: number, column: first + lead };
        found.push(Field { text: text.trim().to_owned(), place });
        text.clear();
    };
    for letter in line.chars() {
        column += 1;
        match letter {
            '"' => quoted = !quoted,
            _ if letter == delimiter && !quoted => {
                close(&mut text, first);
                first = column + 1;
            }
            _ => text.push(letter),
        }
    }
    close(&mut text, first);
    found
}

/// The value of a field: `50 [81]`, `0 (TRG)`.
pub(super) fn token(field: &Field) -> Token {
    let place = field.place;
    let text = field.text.trim_end_matches("(TRG)").trim();
    if text.eq_ignore_ascii_case("trg") {
        return Token { text: "0".to_owned(), bracket: None, place };
    }
    // 36 / 58, with both units in the heading.
    if let Some((value, second)) = text.split_once(" / ")
        && [value, second].iter().all(|text| number(text.trim(), false).is_some())
    {
        let bracket = Some(second.trim().to_owned());
        return Token { text: value.trim().to_owned(), bracket, place };
    }
    match text.split_once('[') {
        Some((value, bracket)) => Token {
            text: value.trim().to_owned(),
            bracket: Some(bare(bracket).trim_end_matches(']').trim().to_owned()),
            place,
        },
        None => Token { text: text.to_owned(), bracket: None, place },
    }
}

pub(super) fn holds_values(fields: &[Field]) -> bool {
    let mut filled = fields.iter().filter(|field| !field.text.is_empty()).peekable();
    filled.peek().is_some()
        && filled.all(|field| {
            let token = token(field);
            is_value(&token.text) || (token.text.is_empty() && token.bracket.is_some())
        })
}

/// The quantity that the heading of a column names.
pub(super) fn head(text: &str, place: TextPlace) -> Option<Head> {
    let whole = text.trim().to_lowercase();
    let is_time =
        matches!(whole.as_str(), "ms" | "msec" | "s" | "sec" | "t" | "t (s)" | "t [s]" | "t (ms)" | "t [ms]");
    let is_speed = matches!(*plain(&whole).split_whitespace().collect::<Vec<_>>(), ["v", unit]
        if unit_of(unit).is_some_and(|unit| Channel::Speed.takes(&unit)));
    let text = match (is_time, is_speed) {
        (true, _) => format!("Time {text}"),
        (_, true) => format!("Speed {text}"),
        _ => text.replace("km_h", "km/h"),
    };
    let mut words = Vec::new();
    let mut depth = 0_i32;
    for piece in text.split_whitespace().flat_map(split_opening) {
        let opens = piece.contains(['(', '[']);
        let within = depth > 0 || opens;
        for letter in piece.chars() {
            depth += i32::from("([".contains(letter)) - i32::from(")]".contains(letter));
        }
        depth = depth.max(0);
        words.push(Word { text: piece, within, place });
    }
    heading(&words)
}

/// `Speed(km/h)` as two words.
fn split_opening(piece: &str) -> Vec<String> {
    match piece.find(['(', '[']).filter(|from| *from > 0) {
        Some(from) => vec![piece[..from].to_owned(), piece[from..].to_owned()],
        None => vec![piece.to_owned()],
    }
}

/// Maximum number of lines of a field in quotes; a quote that stays open longer is an inch mark.
const MOST_QUOTED: usize = 6;

/// Whether a quote is open at the end of a text.
fn is_open(text: &str) -> bool {
    text.matches('"').count() % 2 == 1
}

/// The lines with their numbers; the lines of a field in quotes are joined to one.
fn numbered(text: &str) -> Vec<(usize, Cow<'_, str>)> {
    let all: Vec<&str> = text.lines().collect();
    let (mut found, mut k) = (Vec::new(), 0);
    while k < all.len() {
        let closes = |count: &usize| all.get(k..k + count).is_some_and(|lines| !is_open(&lines.join(" ")));
        let count = if is_open(all[k]) { (2..=MOST_QUOTED).find(closes).unwrap_or(1) } else { 1 };
        let line = if count == 1 { Cow::Borrowed(all[k]) } else { all[k..k + count].join(" ").into() };
        found.push((k + 1, line));
        k += count;
    }
    found
}

/// The lines that are neither empty, nor comments, nor rules between heading and rows.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let is_rule = |line: &str| line.contains('|') && line.chars().all(|letter| "-|:+= ".contains(letter));
    numbered(text).into_iter().filter(move |(_, line)| {
        !line.trim().is_empty() && !line.trim_start().starts_with('#') && !is_rule(line)
    })
}

/// Whether this is how the fields of the text are divided: its heading names a time, and its lines of values
/// have as many fields as the heading.
fn divides(text: &str, delimiter: char) -> bool {
    let rows: Vec<Vec<Field>> = lines(text).map(|(number, line)| fields(&line, number, delimiter)).collect();
    let named =
        |fields: &[Field]| fields.len() >= 2 && fields.iter().any(|field| is_time(&field.text, field.place));
    let Some(heading) = rows.iter().find(|fields| named(fields) && !holds_values(fields)) else {
        return false;
    };
    if is_transposed(&rows) {
        return true;
    }
    let time = heading.iter().position(|field| is_time(&field.text, field.place));
    let is_row = |fields: &&Vec<Field>| holds_values(fields) || time.is_some_and(|time| is_row(fields, time));
    let counts: Vec<usize> = rows.iter().filter(is_row).map(Vec::len).collect();
    let width = heading.len();
    !counts.is_empty() && counts.iter().filter(|count| **count == width).count() * 2 >= counts.len()
}

/// Whether the lines begin with a quantity and go on with its values.
pub(super) fn is_transposed(rows: &[Vec<Field>]) -> bool {
    let begins = |fields: &&Vec<Field>| label(fields, None).is_some_and(|(_, values)| values.len() >= 2);
    let count = rows.iter().filter(begins).count();
    count >= 2 && rows.iter().filter(|fields| holds_values(fields)).count() == 0
}

/// A quantity at the beginning of a line, and the values after it. If there are as many cells as times, some
/// may have words.
pub(super) fn label(fields: &[Field], times: Option<usize>) -> Option<(Head, &[Field])> {
    let has_value = |field: &Field| {
        let token = token(field);
        is_value(&token.text) || token.text.is_empty()
    };
    let first = fields.iter().position(has_value)?;
    let of_times =
        times.and_then(|times| fields.len().checked_sub(times)).filter(|of| (1..=first).contains(of));
    let (label, values) = fields.split_at(of_times.unwrap_or(first));
    let text: Vec<&str> = label.iter().map(|field| field.text.as_str()).collect();
    let found = head(&text.join(" "), label.first()?.place)?;
    (of_times.is_some() || holds_values(values)).then_some((found, values))
}

/// The character between the fields of the text, if there is one.
pub(super) fn delimiter(text: &str) -> Option<char> {
    ['\t', ';', ',', '|'].into_iter().find(|delimiter| divides(text, *delimiter))
}

/// The tables of a text with this character between its fields.
pub(super) fn tables(text: &str, delimiter: char) -> Result<Vec<RawTable>, TextRefusal> {
    let layout = TextLayout::Delimited(delimiter);
    let rows: Vec<Vec<Field>> = lines(text).map(|(number, line)| fields(&line, number, delimiter)).collect();
    if is_transposed(&rows) {
        return Ok(transposed(&rows));
    }
    let mut found: Vec<RawTable> = Vec::new();
    let mut heading: Vec<(String, TextPlace)> = Vec::new();
    for fields in rows {
        let filled = fields.iter().filter(|field| !field.text.is_empty()).count();
        let named = heading.iter().position(|(text, place)| is_time(text, *place));
        let of_table =
            |table: &RawTable| table.columns.iter().position(|(head, _)| head.channel == Channel::Time);
        let time = named.or_else(|| found.last().and_then(of_table));
        let width = found.last().map_or(0, |table| table.columns.len());
        let is_row =
            time.is_some_and(|time| is_row(&fields, time) || (named.is_none() && is_full(&fields, width)));
        if holds_values(&fields) || is_row {
            match found.last_mut() {
                // A line between the rows of a table that names no time is a footer.
                Some(table) if named.is_none() => leave(table, &mut heading),
                _ if !heading.is_empty() => found.push(begun(&std::mem::take(&mut heading), layout)),
                _ => {}
            }
            if let Some(table) = found.last_mut() {
                add_row(table, &fields)?;
            }
        } else if filled >= 2 {
            for (k, field) in fields.iter().enumerate() {
                match heading.get_mut(k) {
                    Some((text, _)) if field.text.is_empty() || text.is_empty() => text.push_str(&field.text),
                    Some((text, _)) => *text = format!("{text} {}", field.text),
                    None => heading.push((field.text.clone(), field.place)),
                }
            }
        }
    }
    if found.is_empty() {
        let all = begun(&heading, layout);
        let first = all.columns.first();
        return Err(match first {
            Some((head, _)) => TextFault::NoRows { heading: head.text.clone() }.at(head.place),
            None => super::no_heading(text),
        });
    }
    if let Some(table) = found.last_mut() {
        leave(table, &mut heading);
    }
    found.iter_mut().for_each(close);
    Ok(found)
}

/// Whether a line with an unknown word in it is a row nevertheless: it has a number for a time.
fn is_row(fields: &[Field], time: usize) -> bool {
    fields.get(time).is_some_and(|field| number(bare(&token(field).text), false).is_some())
}

/// Whether a line has as many fields as the table, and values in half of them: a row without a valid time.
pub(super) fn is_full(fields: &[Field], width: usize) -> bool {
    let values = fields.iter().filter(|field| is_value(&token(field).text)).count();
    width > 2 && fields.len() == width && values * 2 >= width
}

/// Reports lines that looked like a heading but name no time.
fn leave(table: &mut RawTable, heading: &mut Vec<(String, TextPlace)>) {
    let place = heading.first().map(|(_, place)| *place);
    let filled = heading.drain(..).map(|(text, _)| text).filter(|text| !text.is_empty());
    let text = filled.collect::<Vec<_>>().join(" ");
    table.ignored.extend(place.map(|place| (text, place)));
}

pub(super) fn is_time(text: &str, place: TextPlace) -> bool {
    head(text, place).is_some_and(|head| head.channel == Channel::Time)
}

/// A table with its headings. Those not recognised stay as columns that are not read, so that each cell has a
/// column.
fn begun(heading: &[(String, TextPlace)], layout: TextLayout) -> RawTable {
    let column = |(text, place): &(String, TextPlace)| {
        let unread = Head::of(text.clone(), Channel::Other, Vec::new(), *place);
        let mut found = head(text, *place).unwrap_or(unread);
        found.text.clone_from(text);
        (found, Vec::new())
    };
    RawTable { layout, columns: heading.iter().map(column).collect(), ignored: Vec::new() }
}

fn add_row(table: &mut RawTable, fields: &[Field]) -> Result<(), TextRefusal> {
    let width = table.columns.len();
    let found = fields.iter().rposition(|field| !field.text.is_empty()).map_or(0, |last| last + 1);
    if found > width {
        let columns = quoted(table.columns.iter().map(|(head, _)| head));
        let place = fields.first().map_or_else(TextPlace::default, |field| field.place);
        return Err(TextFault::Uneven { found, expected: width, columns }.at(place));
    }
    let end = fields.last().map_or_else(TextPlace::default, |field| field.place);
    let absent = Field { text: String::new(), place: end };
    for (k, (_, cells)) in table.columns.iter_mut().enumerate() {
        cells.push(token(fields.get(k).unwrap_or(&absent)));
    }
    Ok(())
}

/// Takes the columns that are not read out of the table.
pub(super) fn close(table: &mut RawTable) {
    let (unread, columns) =
        std::mem::take(&mut table.columns).into_iter().partition(|(head, _)| head.channel == Channel::Other);
    table.columns = columns;
    let unread: Vec<(Head, Vec<Token>)> = unread;
    let named = unread.into_iter().filter(|(head, _)| !head.text.is_empty());
    table.ignored.extend(named.map(|(head, _)| (head.text, head.place)));
}

pub(super) fn transposed(rows: &[Vec<Field>]) -> Vec<RawTable> {
    let mut found: Vec<RawTable> = Vec::new();
    for fields in rows {
        let times = found.last().and_then(|table| table.columns.first()).map(|(_, cells)| cells.len());
        let Some((head, values)) = label(fields, times) else {
            if let (Some(table), Some(first)) =
                (found.last_mut(), fields.first().filter(|_| fields.len() > 2))
            {
                table.ignored.push((first.text.clone(), first.place));
            }
            continue;
        };
        if head.channel == Channel::Time || found.is_empty() {
            let layout = TextLayout::Transposed;
            found.push(RawTable { layout, columns: Vec::new(), ignored: Vec::new() });
        }
        if let Some(table) = found.last_mut() {
            table.columns.push((head, values.iter().map(token).collect()));
        }
    }
    found
}
