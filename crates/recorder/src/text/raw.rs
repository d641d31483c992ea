//! A table as printed, and its conversion to SI.

use std::cmp::Ordering;

use super::heads::Head;
use super::legend::Legend;
use super::tokens::{NONE, OFF, ON, Token, bare, number};
use crate::channel::{Channel, ChannelUnit, heading_at, is_one_of, plain, unit_of};
use crate::table::{
    CellDoubt, NoValue, RecorderTable, TableColumn, TextFault, TextLayout, TextPlace, TextRefusal,
};

/// Columns with their cells as printed.
pub(crate) struct RawTable {
    pub(crate) layout: TextLayout,
    pub(crate) columns: Vec<(Head, Vec<Token>)>,
    pub(crate) ignored: Vec<(String, TextPlace)>,
}

/// Some headings, for a message about a text with no known one.
const KNOWN: &str = "speed, accelerator pedal, engine throttle, engine rpm, service brake, ABS activity, stability \
                     control, steering input, yaw rate, longitudinal and lateral delta-V, and longitudinal and \
                     lateral acceleration";

/// (share of a step) a step this much longer than its equal neighbours has lost a sample.
const LOST: f64 = 1.5;

/// (code) how near a printed number has to be to a code, once it is converted: reports print a tenth of a
/// mile.
const NEAR_CODE: f64 = 0.09;

/// The quantities that are stored during the impact.
const DURING_IMPACT: [Channel; 4] = [
    Channel::DeltaVLongitudinal,
    Channel::DeltaVLateral,
    Channel::AccelerationLongitudinal,
    Channel::AccelerationLateral,
];

/// The numbers in NHTSA's tables for a value that is not reported, or is unknown.
const OF_NHTSA: [f64; 2] = [99_996.0, 99_997.0];

/// The text of a cell's number, and its unit: the number in brackets if the heading has a unit for it; a unit
/// after the number takes precedence over that of the heading.
fn said(
    token: &Token,
    channel: Channel,
    units: (ChannelUnit, Option<ChannelUnit>),
) -> (String, String, ChannelUnit) {
    let (text, unit) = match (&token.bracket, units.1) {
        (Some(bracket), Some(second)) => (bracket.as_str(), second),
        (Some(bracket), None) if token.text.is_empty() => (bracket.as_str(), units.0),
        _ => (token.text.as_str(), units.0),
    };
    let (value, unit) = match own_unit(bare(text)).filter(|(_, own)| channel.takes(own)) {
        Some((value, own)) => (value, own),
        None => (bare(text), unit),
    };
    (text.trim().to_owned(), value.to_owned(), unit)
}

/// A value and the unit after it.
fn own_unit(text: &str) -> Option<(&str, ChannelUnit)> {
    let (value, unit) = text.rsplit_once(' ')?;
    Some((value.trim_end(), unit_of(unit)?))
}

/// Whether a switch is on by these words in lower case, which may name it: "brakes on".
fn switched(text: &str, channel: Channel) -> Option<bool> {
    let state = match text.rsplit_once(' ') {
        _ if is_one_of(OFF, text) => text,
        Some((name, state)) => {
            let words: Vec<&str> = name.split(' ').collect();
            heading_at(&words).filter(|found| *found == (channel, words.len())).map(|_| state)?
        }
        None => text,
    };
    is_one_of(OFF, state).then_some(false).or_else(|| is_one_of(ON, state).then_some(true))
}

/// The value of a cell, or why it has none.
fn value(token: &Token, channel: Channel, units: (ChannelUnit, Option<ChannelUnit>)) -> Result<f64, NoValue> {
    let (text, shown, unit) = said(token, channel, units);
    let lower = shown.to_lowercase();
    if lower.is_empty() {
        return Err(NoValue::Empty);
    }
    if is_one_of(NONE, &lower) {
        return Err(NoValue::Word(text));
    }
    if let Some(on) = switched(&lower, channel).filter(|_| channel.is_switch()) {
        return Ok(f64::from(u8::from(on)));
    }
    let printed =
        number(&shown, channel == Channel::EngineSpeed).ok_or_else(|| NoValue::Unreadable(text.clone()))?;
    let si = printed * unit.factor;
    let (codes, worth) = channel.codes();
    // A speed in whole miles per hour: 158 is what is printed for 254 and 255 km/h.
    let rounds = |code: &f64| channel == Channel::Speed && (code * worth / unit.factor).round() == printed;
    let is_code =
        |code: &f64| (printed - code).abs() < 1e-9 || (si / worth - code).abs() < NEAR_CODE || rounds(code);
    if codes.iter().any(is_code) || OF_NHTSA.contains(&printed) {
        return Err(NoValue::Code(text));
    }
    let [least, greatest] = channel.range();
    if !(least..=greatest).contains(&si) {
        let range = [least / unit.factor, greatest / unit.factor];
        return Err(NoValue::OutOfRange { printed: text, range });
    }
    if channel.is_switch() && si != 0.0 && (si - 1.0).abs() > 0.0 {
        return Err(NoValue::Unreadable(text));
    }
    Ok(si)
}

/// (s) the times, and whether they fall. If one cannot be read, the table is refused.
fn times(
    cells: &[Token],
    units: (ChannelUnit, Option<ChannelUnit>),
) -> Result<(Vec<f64>, bool), TextRefusal> {
    let mut times: Vec<f64> = Vec::with_capacity(cells.len());
    for cell in cells {
        let text = cell.text.clone();
        let time = value(cell, Channel::Time, units).map_err(|none| match none {
            NoValue::OutOfRange { range, .. } => TextFault::TimeFar { text, range },
            _ => TextFault::TimeUnreadable { text },
        });
        times.push(time.map_err(|fault| fault.at(cell.place))?);
    }
    // By most of the steps: a single wrong time, be it the last, does not turn the others.
    let falling = times.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let falls = match (2 * falling + 1).cmp(&times.len()) {
        Ordering::Less => false,
        Ordering::Equal => times.first() > times.last(),
        Ordering::Greater => true,
    };
    for (pair, cell) in times.windows(2).zip(&cells[1..]) {
        if pair[0] == pair[1] {
            return Err(TextFault::TimeTwice { time: pair[1] }.at(cell.place));
        }
        let steady = if falls { pair[1] < pair[0] } else { pair[1] > pair[0] };
        if !steady {
            let sense = if falls { "fall" } else { "rise" };
            return Err(TextFault::TimesTurn { time: pair[1], before: pair[0], sense }.at(cell.place));
        }
    }
    Ok((times, falls))
}

/// The steps that have lost a sample: longer than those next to them, which are equal.
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

/// Refuses a column unless it has one cell for each time. Empty cells after the last time do not count.
fn one_for_each_time(head: &Head, cells: &mut Vec<Token>, expected: usize) -> Result<(), TextRefusal> {
    while cells.len() > expected && cells.last().is_some_and(Token::is_empty) {
        cells.pop();
    }
    if cells.len() == expected {
        return Ok(());
    }
    let place = cells.first().map_or(head.place, |token| token.place);
    let columns = format!("as many as there are times, for {}", head.channel.name());
    Err(TextFault::Uneven { found: cells.len(), expected, columns }.at(place))
}

/// Whether a cell may be of a quantity: a state of a switch, a number of any other, or a word for no value.
pub(super) fn may_be(token: &Token, channel: Channel) -> bool {
    let text = bare(&token.text).to_lowercase();
    let printed = number(&text, true);
    let is_state =
        is_one_of(ON, &text) || is_one_of(OFF, &text) || printed.is_some_and(|of| of == 0.0 || of == 1.0);
    match channel {
        Channel::Other => true,
        _ if is_one_of(NONE, &text) => channel != Channel::Time,
        _ if channel.is_switch() => is_state,
        _ => printed.is_some() || token.is_empty(),
    }
}

/// Whether a word of a heading is the name of a time.
fn names_time(heading: &str) -> bool {
    heading.split_whitespace().any(|word| heading_at(&[&plain(word)]) == Some((Channel::Time, 1)))
}

/// (s) the times of a column, `None` where a cell is empty; `None` unless all others are numbers with a unit.
fn seconds((head, cells): &(Head, Vec<Token>)) -> Option<Vec<Option<f64>>> {
    let head = in_units_of_cells(head.clone(), cells);
    let units = head.unit().ok().filter(|_| head.channel == Channel::Time)?;
    let time = |cell: &Token| match value(cell, Channel::Time, units) {
        Ok(time) => Some(Some(time)),
        Err(NoValue::Empty) => Some(None),
        Err(_) => None,
    };
    cells.iter().map(time).collect()
}

/// A table for each of several columns of different times: a quantity belongs to the one that is nearest on
/// its left.
pub(crate) fn by_times(raw: RawTable) -> Vec<RawTable> {
    let is_series = |(head, _): &(Head, Vec<Token>)| !matches!(head.channel, Channel::Time | Channel::Other);
    // Of those without a quantity in between, and with the same times, the first counts.
    let mut begins: Vec<(usize, Vec<Option<f64>>)> = Vec::new();
    for (at, column) in raw.columns.iter().enumerate() {
        let Some(times) = seconds(column) else { continue };
        let has_series = |begin: usize, end: usize| raw.columns[begin..end].iter().any(is_series);
        let is_new = begins.last().is_none_or(|(begin, last)| has_series(*begin, at) && times != *last);
        if is_new && has_series(at, raw.columns.len()) {
            begins.push((at, times));
        }
    }
    if begins.len() < 2 {
        return vec![raw];
    }
    let RawTable { layout, columns, mut ignored } = raw;
    let mut found: Vec<RawTable> = Vec::new();
    for (at, column) in columns.into_iter().enumerate() {
        if found.is_empty() || begins.iter().skip(1).any(|(begin, _)| *begin == at) {
            let ignored = std::mem::take(&mut ignored);
            found.push(RawTable { layout, columns: Vec::new(), ignored });
        }
        if let Some(table) = found.last_mut() {
            table.columns.push(column);
        }
    }
    // The shorter of two series side by side ends with empty cells.
    for table in &mut found {
        while table.columns.iter().all(|(_, cells)| cells.last().is_some_and(Token::is_empty)) {
            table.columns.iter_mut().for_each(|(_, cells)| cells.truncate(cells.len() - 1));
        }
    }
    found
}

/// The table in SI, its times rising.
pub(crate) fn finish(raw: RawTable) -> Result<RecorderTable, TextRefusal> {
    let RawTable { layout, mut columns, mut ignored } = raw;
    let Some(time) = columns.iter().position(|(head, _)| head.channel == Channel::Time) else {
        let first = columns.into_iter().map(|(head, _)| (head.text, head.place)).chain(ignored).next();
        return Err(match first {
            Some((heading, place)) if names_time(&heading) => TextFault::TimeNotFirst { heading }.at(place),
            Some((heading, place)) => TextFault::NoTime { heading }.at(place),
            None => TextFault::NoHeading { begins: String::new() }.into(),
        });
    };
    while columns[time].1.last().is_some_and(Token::is_empty) && layout == TextLayout::Transposed {
        columns[time].1.pop();
    }
    let expected = columns[time].1.len();
    for (head, cells) in &mut columns {
        one_for_each_time(head, cells, expected)?;
    }
    let (time_head, time_cells) = columns[time].clone();
    let time_head = in_units_of_cells(time_head, &time_cells);
    if time_cells.is_empty() {
        return Err(TextFault::NoRows { heading: time_head.text }.at(time_head.place));
    }
    let time_units = time_head.unit()?;
    let (mut seconds, falls) = times(&time_cells, time_units)?;
    if falls {
        seconds.reverse();
    }
    let has = |of: &[Channel]| columns.iter().any(|(head, _)| of.contains(&head.channel));
    let is_before = has(&[Channel::Speed]) || !has(&DURING_IMPACT);
    // Seconds before the impact, counted down without a sign.
    let counted_down = falls && is_before && seconds.first().is_some_and(|least| *least >= 0.0);
    if counted_down {
        seconds = seconds.iter().rev().map(|time| if *time == 0.0 { 0.0 } else { -time }).collect();
    }
    // The times of a table that counts down fall, and rise once their sign is changed.
    let backward = falls && !counted_down;
    let mut rows: Vec<TextPlace> = time_cells.iter().map(|cell| cell.place).collect();
    if backward {
        rows.reverse();
    }
    let mut doubts = Vec::new();
    for (row, reason) in lost(&seconds) {
        doubts.push(CellDoubt { place: rows[row], channel: Channel::Time, reason });
    }
    let mut read = vec![TableColumn {
        heading: time_head.text.clone(),
        channel: Channel::Time,
        unit: time_units.0,
        place: time_head.place,
        values: seconds.into_iter().map(Some).collect(),
    }];
    let time_place = time_head.place;
    columns.remove(time);
    let (chosen, left) = surest(columns);
    ignored.extend(left.into_iter().map(|head| (head.text, head.place)));
    for mut one in agreeing(chosen, &mut ignored)? {
        if backward {
            one.column.values.reverse();
        }
        read.push(one.column);
        doubts.extend(one.doubts);
    }
    ignored.sort_by_key(|(_, place)| *place);
    if read.len() == 1 {
        let headings: Vec<String> = ignored.iter().map(|(text, _)| format!("\"{text}\"")).collect();
        let found = if headings.is_empty() { String::new() } else { format!(" in {}", headings.join(", ")) };
        return Err(TextFault::NoQuantity { found, known: KNOWN }.at(time_place));
    }
    doubts.sort_by_key(|doubt| doubt.place);
    Ok(RecorderTable { layout, columns: read, rows, ignored, left: Vec::new(), doubts, counted_down })
}

/// The columns with the most certain headings for each quantity, and the headings of the others.
fn surest(columns: Vec<(Head, Vec<Token>)>) -> (Vec<(Head, Vec<Token>)>, Vec<Head>) {
    let is_read = |head: &Head| {
        !matches!(head.channel, Channel::Other | Channel::Time)
            && !head.channel.is_in_other_units(&head.units)
    };
    let ranks: Vec<_> = columns
        .iter()
        .filter(|(head, _)| is_read(head))
        .map(|(head, _)| (head.channel, head.rank()))
        .collect();
    let is_surest = |head: &Head| {
        let mut of_channel = ranks.iter().filter(|(channel, _)| *channel == head.channel);
        is_read(head) && of_channel.all(|(_, rank)| head.rank() <= *rank)
    };
    let (chosen, left): (Vec<_>, Vec<_>) = columns.into_iter().partition(|(head, _)| is_surest(head));
    (chosen, left.into_iter().map(|(head, _)| head).collect())
}

/// A column, read.
struct Reading {
    column: TableColumn,
    cells: Vec<Token>,
    doubts: Vec<CellDoubt>,
    /// (SI) the value of one unit of its last digit.
    step: f64,
}

impl Reading {
    fn of(head: Head, cells: Vec<Token>) -> Result<Self, TextRefusal> {
        let head = in_units_of_cells(head, &cells);
        let (channel, units) = (head.channel, head.unit()?);
        let legend = Legend::of(&head)?;
        let thousands = Thousands::of(channel, &cells);
        let of_cell = |cell: &Token| match legend.state(cell) {
            None if thousands == Thousands::Unsure && is_dotted(bare(&cell.text)) => {
                Err(NoValue::Unreadable(cell.text.clone()))
            }
            None if thousands == Thousands::Points => {
                let cell = Token { text: cell.text.replace('.', ""), ..cell.clone() };
                value(&cell, channel, units)
            }
            Some(Some(on)) => Ok(f64::from(u8::from(on))),
            Some(None) => Err(NoValue::Unreadable(cell.text.clone())),
            None => value(cell, channel, units).map(|value| legend.signed(value)),
        };
        let found: Vec<Result<f64, NoValue>> = cells.iter().map(of_cell).collect();
        let values = found.iter().map(|value| value.as_ref().ok().copied()).collect();
        let doubt = |(cell, found): (&Token, Result<f64, NoValue>)| {
            found.err().map(|reason| CellDoubt { place: cell.place, channel, reason })
        };
        let doubts = cells.iter().zip(found).filter_map(doubt).collect();
        let bracketed = cells.iter().any(|cell| cell.bracket.is_some());
        let unit = units.1.filter(|_| bracketed).unwrap_or(units.0);
        let decimals = cells.iter().map(|cell| decimals(&said(cell, channel, units).1)).max().unwrap_or(0);
        let step = (0..decimals).fold(unit.factor, |step, _| step / 10.0);
        let column = TableColumn { heading: head.text, channel, unit, place: head.place, values };
        Ok(Self { column, cells, doubts, step })
    }

    /// The first row in which its value differs from that of a second column of the same quantity by more
    /// than the rounding of both.
    fn differs(&self, other: &Self) -> Option<usize> {
        let most = if self.column.channel.is_switch() { 0.5 } else { self.step + other.step };
        let differ = |(one, other): (&Option<f64>, &Option<f64>)| {
            one.zip(*other).is_some_and(|(one, other)| (one - other).abs() > most * (1.0 + 1e-9))
        };
        self.column.values.iter().zip(&other.column.values).position(differ)
    }

    /// Its value in a row, with its heading.
    fn quoted(&self, row: usize) -> String {
        let cell = &self.cells[row];
        let bracket = cell.bracket.as_ref().map(|bracket| format!("[{bracket}]"));
        let text = [Some(cell.text.clone()), bracket].into_iter().flatten().collect::<Vec<_>>().join(" ");
        format!("{} under \"{}\"", text.trim(), self.column.heading)
    }
}

/// Whether a number may have a point between its thousands: `1.250`.
fn is_dotted(text: &str) -> bool {
    let is_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    text.split_once('.').is_some_and(|(whole, part)| {
        (1..=2).contains(&whole.len())
            && !whole.starts_with('0')
            && part.len() == 3
            && is_digits(whole)
            && is_digits(part)
    })
}

/// What the points in the numbers of a column are.
#[derive(Clone, Copy, PartialEq)]
enum Thousands {
    /// Decimal points.
    None,
    /// Points between thousands.
    Points,
    /// Either: `1.250` beside `0.5`.
    Unsure,
}

impl Thousands {
    /// An engine does not turn at 1.250 rpm: the point is between thousands if the other numbers are whole.
    fn of(channel: Channel, cells: &[Token]) -> Self {
        let texts = || cells.iter().map(|cell| bare(&cell.text)).filter(|text| number(text, true).is_some());
        let is_whole = |text: &str| is_dotted(text) || !text.contains('.');
        // 850.125: three decimals, as all of them may have.
        let has_decimals = texts().any(|text| decimals(text) == 3 && text.find('.').is_some_and(|at| at > 2));
        match (channel == Channel::EngineSpeed && texts().any(is_dotted), has_decimals) {
            (false, _) | (_, true) => Self::None,
            _ if texts().all(is_whole) => Self::Points,
            _ => Self::Unsure,
        }
    }
}

/// A heading without a unit, with that of its cells: `0.0 km/h`.
fn in_units_of_cells(mut head: Head, cells: &[Token]) -> Head {
    let own = || cells.iter().find_map(|cell| own_unit(bare(&cell.text)));
    if let (true, Some((_, unit))) = (head.units.is_empty(), own()) {
        head.units.push(unit);
    }
    head
}

/// The number of digits after the decimal point or comma.
fn decimals(text: &str) -> usize {
    let digits = |(_, part): (&str, &str)| part.bytes().take_while(u8::is_ascii_digit).count();
    text.rsplit_once(['.', ',']).map_or(0, digits)
}

/// One column of each quantity. If two have equally certain headings and agree, the one with the finer step
/// is read, and the other is ignored.
fn agreeing(
    columns: Vec<(Head, Vec<Token>)>,
    ignored: &mut Vec<(String, TextPlace)>,
) -> Result<Vec<Reading>, TextRefusal> {
    let mut found: Vec<Reading> = Vec::new();
    for (head, cells) in columns {
        let mut next = Reading::of(head, cells)?;
        let Some(before) = found.iter_mut().find(|one| one.column.channel == next.column.channel) else {
            found.push(next);
            continue;
        };
        if let Some(row) = before.differs(&next) {
            let said = [&*before, &next].map(|one| one.quoted(row)).join(" and ");
            let channel = next.column.channel.name();
            return Err(TextFault::Disagree { channel, said }.at(next.cells[row].place));
        }
        if next.step < before.step {
            std::mem::swap(before, &mut next);
        }
        ignored.push((next.column.heading, next.column.place));
    }
    Ok(found)
}
