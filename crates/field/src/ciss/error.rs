//! Why tables of CISS cannot be read.

/// Why NHTSA's tables give no crashes.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CissError {
    /// A table is missing.
    #[error(
        "there is no table {table} ({table}.csv or {}.sas7bdat); {}",
        .table.to_lowercase(),
        has(.files)
    )]
    NoTable {
        /// Its name.
        table: &'static str,
        /// The files that were found.
        files: Vec<String>,
    },
    /// The tables are those of the sample before CISS.
    #[error(
        "the tables are those of NASS-CDS (ACCIDENT, VE): they have no ΔV of a recorder, so there is \
         nothing to compare an estimate with, and the units of their masses changed over the years. Give \
         the tables of CISS, which follows NASS-CDS \
         from 2017"
    )]
    Nass,
    /// A SAS file cannot be read.
    #[error(
        "{file}: it cannot be read as a SAS file: {reason}; download it again, or download the year as CSV"
    )]
    Sas {
        /// Its name.
        file: String,
        /// What is wrong.
        reason: sas7bdat::Error,
    },
    /// A table appears twice.
    #[error("the table {table} appears twice: {} and {}; give the tables of one year", .files[0], .files[1])]
    Twice {
        /// Its name.
        table: &'static str,
        /// The files.
        files: [String; 2],
    },
    /// The rows cannot be separated.
    #[error("{file}: it is not a table of comma-separated values: {reason}")]
    Table {
        /// The file.
        file: String,
        /// What is wrong.
        reason: csv::Error,
    },
    /// A table lacks columns that are needed.
    #[error("the table {table} ({file}) has no column {}; it has {}", .columns.join(", "), .has.join(", "))]
    NoColumn {
        /// Name of the table.
        table: &'static str,
        /// The file.
        file: String,
        /// Those that are missing.
        columns: Vec<&'static str>,
        /// Those that it has.
        has: Vec<String>,
    },
    /// A column appears twice.
    #[error("{file}, line 1: there are two columns {column}; leave one of them")]
    ColumnTwice {
        /// The file.
        file: String,
        /// The name of the column.
        column: String,
    },
    /// A row does not fit the header.
    #[error(
        "{file}, line {line}: the row has {cells} cells, and the header {columns}; a text with a comma needs quotation marks"
    )]
    Cells {
        /// The file.
        file: String,
        /// Line number, where 1 is the header.
        line: u64,
        /// (–) number of its cells.
        cells: usize,
        /// (–) number of the columns.
        columns: usize,
    },
    /// A cell does not hold a valid value.
    #[error("{file}, line {line}, column {column}: \"{text}\" is not {wanted}")]
    Cell {
        /// The file.
        file: String,
        /// Line number, where 1 is the header.
        line: u64,
        /// The name of its column.
        column: String,
        /// Its text.
        text: String,
        /// The required value.
        wanted: &'static str,
    },
    /// Two rows for one thing.
    #[error("the table {table} has two rows of {key}: give the tables of one year")]
    Rows {
        /// Name of the table.
        table: &'static str,
        /// The key of both.
        key: String,
    },
    /// A crash without a year.
    #[error("the table CRASH has no row of crash {crash}, which CDC has: give all tables of the same year")]
    NoCrash {
        /// CASEID.
        crash: i64,
    },
    /// A recorder without a record.
    #[error("the recorder of vehicle {vehicle} in crash {crash} has no record with a speed or a ΔV")]
    NoRecord {
        /// CASEID.
        crash: i64,
        /// VEHNO.
        vehicle: i64,
    },
    /// Not a table of pairs.
    #[error("{file}: there is no column {column}; give a file that Pairs.save wrote")]
    NoPairColumn {
        /// The file.
        file: String,
        /// The name of the column.
        column: String,
    },
}

/// (–) at most this many files are named.
const NAMED: usize = 40;

fn has(files: &[String]) -> String {
    let named = files.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
    match files.len() {
        0 => "there is no file".to_owned(),
        1..=NAMED => format!("there are {named}"),
        all => format!("there are {named} and {} more", all - NAMED),
    }
}
