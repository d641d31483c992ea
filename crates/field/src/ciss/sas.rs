//! Converts SAS files to the CSV that NHTSA also offers.

use std::ops::ControlFlow;

use sas7bdat::{CellValue, Dataset, Error};

use super::error::CissError;

/// The table of a SAS file, as CSV.
pub(super) fn as_csv(file: &str, content: Vec<u8>) -> Result<Vec<u8>, CissError> {
    csv_of(content).map_err(|reason| CissError::Sas { file: file.to_owned(), reason })
}

fn csv_of(content: Vec<u8>) -> Result<Vec<u8>, Error> {
    let table = Dataset::from_bytes(content)?;
    let mut text = csv::Writer::from_writer(Vec::new());
    write(&mut text, table.columns().iter().map(|column| column.name().to_owned()))?;
    table.scan().visit_rows(|row| {
        write(&mut text, row.iter().map(cell))?;
        Ok(ControlFlow::Continue(()))
    })?;
    text.into_inner().map_err(|error| Error::io_error(error.error()))
}

fn write(text: &mut csv::Writer<Vec<u8>>, cells: impl Iterator<Item = String>) -> Result<(), Error> {
    text.write_record(cells).map_err(|error| Error::io_error(&error.into()))
}

/// No column that is read contains a date or a time.
fn cell(value: &CellValue<'_>) -> String {
    match value {
        CellValue::Int32(number) => number.to_string(),
        CellValue::Int64(number) => number.to_string(),
        CellValue::Float64(number) => number.to_string(),
        CellValue::Str(text) => text.trim().to_owned(),
        CellValue::Bytes(bytes) => String::from_utf8_lossy(bytes).trim().to_owned(),
        CellValue::Null | CellValue::Date(_) | CellValue::DateTime(_) | CellValue::Time(_) => String::new(),
    }
}
