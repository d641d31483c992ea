//! A table as printed, and from there the table in SI.

use super::heads::Head;
use super::tokens::{NONE, OFF, ON, Token, number};
use crate::channel::{Channel, ChannelUnit};
use crate::table::{CellDoubt, NoValue, RecorderTable, TableColumn, TextLayout, TextPlace, TextRefusal};

/// Columns with their cells as printed.
pub(crate) struct RawTable {
    pub(crate) layout: TextLayout,
    pub(crate) columns: Vec<(Head, Vec<Token>)>,
    pub(crate) ignored: Vec<(String, TextPlace)>,
}

/// Some headings, for who has none that is known.
const KNOWN: &str = "speed, accelerator pedal, engine throttle, engine rpm, service brake, ABS activity, stability \
                     control, steering input, yaw rate, longitudinal and lateral delta-V, and longitudinal and \
                     lateral acceleration";

/// (share of a step) a step this much longer than its equal neighbours has lost a sample.
const LOST: f64 = 1.5;

/// (code) how near a printed number has to be to a code, once it is converted: reports print a tenth of a
/// mile.
const NEAR_CODE: f64 = 0.09;

/// What the tables of NHTSA have in place of a value that is not reported, or is unknown.
const OF_NHTSA: [f64; 2] = [99_996.0, 99_997.0];

/// The value of a cell, or why it has none.
fn value(token: &Token, channel: Channel, units: (ChannelUnit, Option<ChannelUnit>)) -> Result<f64, NoValue> {
    let (text, unit) = match (&token.bracket, units.1) {
        (Some(bracket), Some(second)) => (bracket.as_str(), second),
        (Some(bracket), None) if token.text.is_empty() => (bracket.as_str(), units.0),
        _ => (token.text.as_str(), units.0),
    };
    let lower = text.trim().to_lowercase();
    if lower.is_empty() {
        return Err(NoValue::Empty);
    }
    if NONE.contains(&lower.as_str()) {
        return Err(NoValue::Word(text.to_owned()));
    }
    if channel.is_switch() && (ON.contains(&lower.as_str()) || OFF.contains(&lower.as_str())) {
        return Ok(if ON.contains(&lower.as_str()) { 1.0 } else { 0.0 });
    }
    let printed = number(text.trim(), channel == Channel::EngineSpeed)
        .ok_or_else(|| NoValue::Unreadable(text.to_owned()))?;
    let si = printed * unit.factor;
    let (codes, worth) = channel.codes();
    let is_code = |code: &f64| (printed - code).abs() < 1e-9 || (si / worth - code).abs() < NEAR_CODE;
    if codes.iter().any(is_code) || OF_NHTSA.contains(&printed) {
        return Err(NoValue::Code(text.to_owned()));
    }
    let [least, greatest] = channel.range();
    if !(least..=greatest).contains(&si) {
        let range = [least / unit.factor, greatest / unit.factor];
        return Err(NoValue::OutOfRange { printed: text.to_owned(), range });
    }
    if channel.is_switch() && si != 0.0 && (si - 1.0).abs() > 0.0 {
        return Err(NoValue::Unreadable(text.to_owned()));
    }
    Ok(si)
}

/// (s) the times, each read or the table refused, and whether they fall.
fn times(
    cells: &[Token],
    units: (ChannelUnit, Option<ChannelUnit>),
) -> Result<(Vec<f64>, bool), TextRefusal> {
    let mut times: Vec<f64> = Vec::with_capacity(cells.len());
    for cell in cells {
        let time = value(cell, Channel::Time, units);
        let text = cell.text.clone();
        times.push(time.map_err(|_| TextRefusal::TimeUnreadable { place: cell.place, text })?);
    }
    let falls = times.first() > times.last();
    for (pair, cell) in times.windows(2).zip(&cells[1..]) {
        let steady = if falls { pair[1] < pair[0] } else { pair[1] > pair[0] };
        if !steady {
            let sense = if falls { "fall" } else { "rise" };
            return Err(TextRefusal::TimesTurn { place: cell.place, time: pair[1], before: pair[0], sense });
        }
    }
    Ok((times, falls))
}

/// The steps that have lost a sample: longer than those beside them, which are equal.
fn lost(times: &[f64]) -> Vec<(usize, NoValue)> {
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut found = Vec::new();
    for (k, around) in steps.windows(3).enumerate() {
        let equal = (around[0] - around[2]).abs() < 0.01 * around[0];
        if equal && around[1] > LOST * around[0] {
            found.push((k + 1, NoValue::SampleMissing { gap: around[1], step: around[0] }));
        }
    }
    found
}

/// Refuses a column that has not one cell for each time. Empty cells behind the last time are of nothing.
fn one_for_each_time(head: &Head, cells: &mut Vec<Token>, expected: usize) -> Result<(), TextRefusal> {
    while cells.len() > expected && cells.last().is_some_and(Token::is_empty) {
        cells.pop();
    }
    if cells.len() == expected {
        return Ok(());
    }
    let place = cells.first().map_or(head.place, |token| token.place);
    let columns = format!("as many as there are times, for {}", head.channel.name());
    Err(TextRefusal::Uneven { place, found: cells.len(), expected, columns })
}

/// The table in SI, its times rising.
pub(crate) fn finish(raw: RawTable) -> Result<RecorderTable, TextRefusal> {
    let RawTable { layout, mut columns, mut ignored } = raw;
    let Some(time) = columns.iter().position(|(head, _)| head.channel == Channel::Time) else {
        return Err(match columns.first() {
            Some((head, _)) => TextRefusal::NoTime { heading: head.text.clone(), place: head.place },
            None => TextRefusal::NoHeading {
                begins: ignored.into_iter().next().map(|(text, _)| text).unwrap_or_default(),
            },
        });
    };
    while columns[time].1.last().is_some_and(Token::is_empty) && layout == TextLayout::Transposed {
        columns[time].1.pop();
    }
    let expected = columns[time].1.len();
    for (head, cells) in &mut columns {
        one_for_each_time(head, cells, expected)?;
    }
    let (time_head, time_cells) = &columns[time];
    if time_cells.is_empty() {
        return Err(TextRefusal::NoRows { heading: time_head.text.clone(), place: time_head.place });
    }
    let time_units = time_head.unit()?;
    let (mut seconds, falls) = times(time_cells, time_units)?;
    if falls {
        seconds.reverse();
    }
    let has_speed = columns.iter().any(|(head, _)| head.channel == Channel::Speed);
    // Seconds before the impact, counted down without a sign.
    let counted_down = falls && has_speed && seconds.first().is_some_and(|least| *least >= 0.0);
    if counted_down {
        seconds = seconds.iter().rev().map(|time| if *time == 0.0 { 0.0 } else { -time }).collect();
    }
    // A table that counts down falls, and reads forward once its sign is turned.
    let backward = falls && !counted_down;
    let mut doubts = Vec::new();
    let place_of = |row: usize| time_cells[if backward { time_cells.len() - 1 - row } else { row }].place;
    for (row, reason) in lost(&seconds) {
        doubts.push(CellDoubt { place: place_of(row), channel: Channel::Time, reason });
    }
    let mut read = vec![TableColumn {
        heading: time_head.text.clone(),
        channel: Channel::Time,
        unit: time_units.0,
        place: time_head.place,
        values: seconds.into_iter().map(Some).collect(),
    }];
    for (head, cells) in &columns {
        if head.channel == Channel::Time {
            continue;
        }
        let unread = head.channel == Channel::Other || head.channel.is_voltage(&head.units);
        if unread || read.iter().any(|column| column.channel == head.channel) {
            ignored.push((head.text.clone(), head.place));
            continue;
        }
        let units = head.unit()?;
        let mut values = Vec::with_capacity(cells.len());
        for cell in cells {
            let found = value(cell, head.channel, units);
            values.push(found.as_ref().ok().copied());
            if let Err(reason) = found {
                doubts.push(CellDoubt { place: cell.place, channel: head.channel, reason });
            }
        }
        if backward {
            values.reverse();
        }
        let bracketed = cells.iter().any(|cell| cell.bracket.is_some());
        let unit = units.1.filter(|_| bracketed).unwrap_or(units.0);
        let (heading, channel, place) = (head.text.clone(), head.channel, head.place);
        read.push(TableColumn { heading, channel, unit, place, values });
    }
    if read.len() == 1 {
        let headings: Vec<String> = ignored.iter().map(|(text, _)| format!("\"{text}\"")).collect();
        let found = if headings.is_empty() { String::new() } else { format!(" in {}", headings.join(", ")) };
        return Err(TextRefusal::NoQuantity { place: time_head.place, found, known: KNOWN });
    }
    doubts.sort_by_key(|doubt| doubt.place);
    Ok(RecorderTable { layout, columns: read, ignored, doubts, counted_down })
}
