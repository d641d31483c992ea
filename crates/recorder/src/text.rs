//! Reads a recorder's table from text: CSV, or what one copies out of a printed report.

mod delimited;
mod flowing;
mod heads;
mod raw;
mod tokens;

use crate::table::{RecorderTable, TextRefusal};

/// The tables of a text, each recognised by the words and the units of its headings.
///
/// The text is CSV with commas, semicolons, tabs or aligned columns, or it is copied out of a printed report:
/// a row in each line, or a value in each line, row after row or column after column, or a quantity in each
/// row with the times across. A heading may be split over lines. Of `50 [81]` below `MPH [km/h]` the number in
/// brackets is read, which is the stored one. Values are converted to SI, and times rise in what is returned.
///
/// # Errors
///
/// [`TextRefusal`] says what is missing and where. A cell without a value does not refuse the table: it is
/// `None` in its column and told in [`RecorderTable::doubts`].
pub fn read_tables(text: &str) -> Result<Vec<RecorderTable>, TextRefusal> {
    if text.trim().is_empty() {
        return Err(TextRefusal::Empty);
    }
    // A mark of the order of bytes, and blanks that do not break, are of the word processor.
    let text = text.trim_start_matches('\u{feff}').replace(['\u{a0}', '\u{202f}'], " ");
    let raw = match delimited::layout(&text) {
        Some(layout) => delimited::tables(&text, layout)?,
        None => flowing::tables(&text)?,
    };
    if raw.is_empty() {
        return Err(TextRefusal::NoHeading);
    }
    raw.into_iter().map(raw::finish).collect()
}
