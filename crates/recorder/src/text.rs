//! Reads a recorder's table from text: CSV, or text copied out of a printed report.

mod aligned;
mod columns;
mod delimited;
mod flowing;
mod heads;
mod legend;
mod long;
mod raw;
mod rows;
mod tokens;

use crate::channel::Channel;
use crate::table::{CellDoubt, RecorderTable, TextFault, TextPlace, TextRefusal};

/// The tables of a text, each recognised by the words and the units of its headings.
///
/// The text is CSV with commas, semicolons, tabs or aligned columns, or it is copied out of a printed report:
/// a row in each line, or a value in each line, row after row or column after column, or a quantity in each
/// row with the times across. A heading may be split over lines. In aligned columns, a cell belongs to the
/// column in which it stands, so that an empty one shifts no other. Of several columns of times, that on the
/// left of a quantity is its own. In `50 [81]` below `MPH [km/h]`, the number
/// in brackets is read, which is the stored one. `Brake (0 = On, 1 = Off)` and `Delta-V (left positive)` are
/// read as they say. Values are converted to SI, and the returned times rise.
///
/// # Errors
///
/// [`TextRefusal`] states what is missing and where. A table is not refused because of a cell without a
/// value: that is `None` in its column and reported in [`RecorderTable::doubts`].
pub fn read_tables(text: &str) -> Result<Vec<RecorderTable>, TextRefusal> {
    read_rows(text, "")
}

/// As [`read_tables`], for the rows with these values: `VEHNO 1, EDREVENTNO 2`.
///
/// That is for the long tables of NHTSA, EDRPRECRASH and EDRPOSTCRASH, in which each value has a row, and a
/// file may hold several records. The columns `PCODE`, `PTIME` and `PVALUE` distinguish them from other
/// texts.
///
/// # Errors
///
/// As [`read_tables`]; also if the rows are of several records, or if there are none.
pub fn read_rows(text: &str, rows: &str) -> Result<Vec<RecorderTable>, TextRefusal> {
    if text.trim().is_empty() {
        return Err(TextFault::Empty.into());
    }
    // A byte order mark and no-break spaces come from word processors.
    let text = text.trim_start_matches('\u{feff}').replace(['\u{a0}', '\u{202f}'], " ");
    if let Some(long) = long::tables(&text, rows)? {
        return long.into_iter().map(|(raw, doubts)| finish_with(raw, doubts)).collect();
    }
    if !rows.trim().is_empty() {
        return Err(TextFault::NotLong.into());
    }
    let raw = match delimited::delimiter(&text) {
        Some(delimiter) => delimited::tables(&text, delimiter)?,
        None => match aligned::tables(&text)? {
            Some(tables) => tables,
            None => flowing::tables(&text)?,
        },
    };
    if raw.is_empty() {
        return Err(no_heading(&text));
    }
    raw.into_iter().flat_map(raw::by_times).map(raw::finish).collect()
}

/// (characters) of the beginning of a text in a message.
const BEGINNING: usize = 60;

/// Refuses a text without a heading, and shows where it begins.
fn no_heading(text: &str) -> TextRefusal {
    let line = text.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or_default();
    TextFault::NoHeading { begins: line.chars().take(BEGINNING).collect() }.into()
}

/// The table in SI, with the doubts from earlier steps.
fn finish_with(raw: raw::RawTable, doubts: Vec<CellDoubt>) -> Result<RecorderTable, TextRefusal> {
    let mut table = raw::finish(raw)?;
    table.doubts.extend(doubts);
    table.doubts.sort_by_key(|doubt| doubt.place);
    Ok(table)
}

/// The table of separate columns, each a text of values followed by their unit, `"-1 -0.5 0 s"`, or without a
/// unit for a switch, `"off on on"`.
///
/// # Errors
///
/// [`TextRefusal`] with its channel. Its place is in the text of this channel.
pub fn columns_table(columns: &[(Channel, &str)]) -> Result<RecorderTable, (Channel, TextRefusal)> {
    let raw = columns::table(columns);
    let of_time = raw.columns.iter().find(|(head, _)| head.channel == Channel::Time);
    let expected = of_time.map_or(0, |(_, cells)| cells.len());
    for (head, cells) in &raw.columns {
        head.unit().map_err(|_| (head.channel, columns::without_unit(head)))?;
        if cells.len() != expected && of_time.is_some() {
            let place = cells.last().map_or(TextPlace { line: 1, column: 1 }, |cell| cell.place);
            let columns = "as many as there are times; write - for one that was not stored".to_owned();
            let fault = TextFault::Uneven { found: cells.len(), expected, columns };
            return Err((head.channel, fault.at(place)));
        }
    }
    raw::finish(raw).map_err(|refusal| (Channel::Time, refusal))
}
