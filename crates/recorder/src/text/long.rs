//! The long tables of NHTSA: a row for each value, `PCODE`, `PTIME`, `PVALUE`.
//!
//! # References
//!
//! National Highway Traffic Safety Administration: Crash Investigation Sampling System, Analytical User's
//! Manual, DOT HS 813 243, tables EDRPRECRASH and EDRPOSTCRASH.

use std::collections::{BTreeMap, BTreeSet};

use super::delimited::{Field, fields, lines};
use super::heads::Head;
use super::raw::RawTable;
use super::tokens::{Token, number};
use crate::channel::{Channel, unit_of};
use crate::table::{CellDoubt, NoValue, TextFault, TextLayout, TextPlace, TextRefusal};

/// The columns of a value.
const CODE: &str = "PCODE";
const TIME: &str = "PTIME";
const VALUE: &str = "PVALUE";
/// The columns that distinguish records, from the crash to the record.
const OF_RECORD: [&str; 6] = ["CIRENID", "CASEID", "CASENO", "VEHNO", "EDRSUMMNO", "EDREVENTNO"];
/// (s or ms) codes for a missing time.
const NO_TIME: [f64; 2] = [9996.0, 9997.0];
/// Maximum number of values that a message lists.
const LISTED: usize = 8;

/// The quantity of a code of NHTSA, and the unit of its values.
fn coded(code: &str) -> (Channel, &'static str) {
    match code {
        "1010" => (Channel::Speed, "km/h"),
        "1020" => (Channel::Throttle, "%"),
        "1030" => (Channel::Accelerator, "%"),
        "1040" => (Channel::Brake, ""),
        "1050" => (Channel::EngineSpeed, "rpm"),
        "1060" => (Channel::Abs, ""),
        "1070" => (Channel::Stability, ""),
        "1080" => (Channel::Steering, "deg"),
        "2010" => (Channel::DeltaVLongitudinal, "km/h"),
        "2020" => (Channel::DeltaVLateral, "km/h"),
        "2030" => (Channel::AccelerationLongitudinal, "g"),
        "2040" => (Channel::AccelerationLateral, "g"),
        _ => (Channel::Other, ""),
    }
}

/// Rows of fields, and the names of their columns.
struct LongText {
    rows: Vec<Vec<Field>>,
    names: Vec<String>,
}

impl LongText {
    /// The text, if its first line names the columns of a value.
    fn of(text: &str) -> Option<Self> {
        let (_, heading) = lines(text).next()?;
        let delimiter = [',', ';', '\t'].into_iter().find(|delimiter| heading.contains(*delimiter))?;
        let mut rows = lines(text).map(|(number, line)| fields(&line, number, delimiter));
        let names: Vec<String> = rows.next()?.iter().map(|field| field.text.to_uppercase()).collect();
        let has = |name: &str| names.iter().any(|own| own == name);
        (has(CODE) && has(TIME) && has(VALUE)).then(|| Self { rows: rows.collect(), names })
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|own| own == name)
    }

    /// The different values of a column in these rows.
    fn values(&self, rows: &[&Vec<Field>], name: &str) -> BTreeSet<String> {
        let Some(column) = self.column(name) else { return BTreeSet::new() };
        rows.iter().map(|row| cell(row, column).text).collect()
    }

    /// The rows with these values: `VEHNO 1, EDREVENTNO 2`.
    fn chosen(&self, wanted: &str) -> Result<Vec<&Vec<Field>>, TextRefusal> {
        let mut rows: Vec<&Vec<Field>> = self.rows.iter().collect();
        for pair in wanted.split(',').map(str::trim).filter(|pair| !pair.is_empty()) {
            let (name, value) = pair.split_once([' ', '=']).unwrap_or((pair, ""));
            let name = name.trim().to_uppercase();
            let value = value.trim_start_matches(['=', ' ']).trim().to_owned();
            let column = self.column(&name).filter(|_| OF_RECORD.contains(&name.as_str()));
            let Some(column) = column else {
                let columns = OF_RECORD.iter().filter(|name| self.column(name).is_some());
                let known = columns.copied().collect::<Vec<_>>().join(", ");
                return Err(TextFault::NoColumn { name, known }.into());
            };
            let known = self.values(&rows, &name);
            rows.retain(|row| cell(row, column).text == value);
            if rows.is_empty() {
                return Err(TextFault::NoSuchRows { name, value, known: listed(&known) }.into());
            }
        }
        Ok(rows)
    }

    /// Refuses rows of several records.
    fn is_of_one(&self, rows: &[&Vec<Field>]) -> Result<(), TextRefusal> {
        let several = OF_RECORD.iter().map(|name| (*name, self.values(rows, name)));
        let several: Vec<(&str, BTreeSet<String>)> = several.filter(|(_, values)| values.len() > 1).collect();
        if several.is_empty() {
            return Ok(());
        }
        let records: Vec<String> =
            several.iter().map(|(name, values)| format!("{name} {}", listed(values))).collect();
        let first = |(name, values): &(&str, BTreeSet<String>)| {
            format!("{name} {}", values.first().cloned().unwrap_or_default())
        };
        let example = several.iter().map(first).collect::<Vec<_>>().join(", ");
        Err(TextFault::SeveralRecords { records: records.join(" and "), example }.into())
    }
}

/// The value of a row in a column.
fn cell(row: &[Field], column: usize) -> Token {
    let end = row.last().map_or_else(TextPlace::default, |field| field.place);
    let field = row.get(column).cloned().unwrap_or(Field { text: String::new(), place: end });
    Token { text: field.text, bracket: None, place: field.place }
}

fn listed(values: &BTreeSet<String>) -> String {
    let shown: Vec<&str> = values.iter().take(LISTED).map(String::as_str).collect();
    let more = if values.len() > LISTED { ", …" } else { "" };
    format!("{}{more}", shown.join(", "))
}

/// Tables, each with its rows that have no valid time.
type LongTables = Vec<(RawTable, Vec<CellDoubt>)>;

/// The tables of a long text, one before the impact and one during it, of the record that `wanted` chooses;
/// `None` for any other text.
pub(crate) fn tables(text: &str, wanted: &str) -> Result<Option<LongTables>, TextRefusal> {
    let Some(long) = LongText::of(text) else { return Ok(None) };
    let (Some(code), Some(time), Some(value)) = (long.column(CODE), long.column(TIME), long.column(VALUE))
    else {
        return Ok(None);
    };
    let rows = long.chosen(wanted)?;
    long.is_of_one(&rows)?;
    // The codes of EDRPRECRASH begin with 1 and its times are in s; those of EDRPOSTCRASH with 2, in ms.
    let mut found = Vec::new();
    for (kind, unit) in [('1', "s"), ('2', "ms")] {
        let rows: Vec<_> =
            rows.iter().copied().filter(|row| cell(row, code).text.starts_with(kind)).collect();
        if !rows.is_empty() {
            found.push(table(&rows, [code, time, value], unit)?);
        }
    }
    if let Some(first) = rows.first().filter(|_| found.is_empty()) {
        let known = listed(&long.values(&rows, CODE));
        return Err(TextFault::NoCodes { known }.at(cell(first, code).place));
    }
    Ok(Some(found))
}

/// A row for each time, a column for each code.
fn table(
    rows: &[&Vec<Field>],
    [code, time, value]: [usize; 3],
    unit: &str,
) -> Result<(RawTable, Vec<CellDoubt>), TextRefusal> {
    let mut doubts = Vec::new();
    let mut times: Vec<(f64, Token)> = Vec::new();
    let mut columns: BTreeMap<String, Vec<(f64, Token)>> = BTreeMap::new();
    for row in rows {
        let of_time = cell(row, time);
        let Some(at) = number(&of_time.text, false) else {
            return Err(TextFault::TimeUnreadable { text: of_time.text }.at(of_time.place));
        };
        if NO_TIME.contains(&at) {
            let reason = NoValue::Code(of_time.text);
            doubts.push(CellDoubt { place: of_time.place, channel: Channel::Time, reason });
            continue;
        }
        if times.iter().all(|(other, _)| *other != at) {
            times.push((at, of_time.clone()));
        }
        let column = columns.entry(cell(row, code).text).or_default();
        if column.iter().any(|(other, _)| *other == at) {
            return Err(TextFault::TimeTwice { time: at }.at(of_time.place));
        }
        column.push((at, cell(row, value)));
    }
    times.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let units = unit_of(unit).into_iter().collect();
    let place = times.first().map_or_else(TextPlace::default, |(_, cell)| cell.place);
    let head = Head::of(TIME.to_owned(), Channel::Time, units, place);
    let cells = times.iter().map(|(_, cell)| cell.clone()).collect();
    let mut table = RawTable { layout: TextLayout::Long, columns: vec![(head, cells)], ignored: Vec::new() };
    for (code, mut cells) in columns {
        let place = cells.first().map_or_else(TextPlace::default, |(_, cell)| cell.place);
        let (channel, unit) = coded(&code);
        let text = format!("{CODE} {code}");
        if channel == Channel::Other {
            table.ignored.push((text, place));
            continue;
        }
        let absent = |cell: &Token| Token { text: String::new(), bracket: None, place: cell.place };
        let column = times.iter().map(|(at, of_time)| {
            let here = cells.iter().position(|(other, _)| other == at);
            here.map_or_else(|| absent(of_time), |here| cells.swap_remove(here).1)
        });
        let column = column.collect();
        table.columns.push((Head::of(text, channel, unit_of(unit).into_iter().collect(), place), column));
    }
    Ok((table, doubts))
}
