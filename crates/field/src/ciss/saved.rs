//! A table of pairs that was saved.

use super::cell::CissCell;
use super::error::CissError;
use super::found::CissCrashes;
use super::table::read_back;

/// Reads a table of pairs back, a row for each pair with a cell for each of its
/// [columns](CissCrashes::columns).
///
/// # Errors
/// If it is another table, with the file, the line and the column.
pub fn read_pairs(file: &str, content: &[u8]) -> Result<Vec<Vec<CissCell>>, CissError> {
    read_back(file, content, &CissCrashes::columns(false))
}
