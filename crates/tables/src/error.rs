//! Why a table cannot be read at all. Errors of a single row are reported in that row.

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, DataType};
use case::{Diagnostics, shown};

/// Why a table has no results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The template is not a part of a case.
    #[error("the template is not part of a case: {}", .0.one_line())]
    Template(Box<Diagnostics>),
    /// A column looks like a key, but is not one.
    #[error("the column \"{}\" is not a key of a case: {}", shown(.column), shown(.help))]
    UnknownKey {
        /// Its name, or the path of the field of a struct.
        column: String,
        /// What to write instead.
        help: String,
    },
    /// No column gives a key, so every row would be the template.
    #[error(
        "no column of the table is a key of a case, so every row would be the template: its columns are \
         \"{}\"; a column is named like \"vehicle2.speed [mph]\"",
        shown(&.columns.join("\", \""))
    )]
    NoKey {
        /// Their names.
        columns: Vec<String>,
    },
    /// A column has another type than its key requires.
    #[error("the column \"{}\" has the type {found}, but {wanted}", shown(.column))]
    Type {
        /// Its name, or the path of the field of a struct.
        column: String,
        /// Its type.
        found: DataType,
        /// The type that the key requires.
        wanted: String,
    },
    /// A unit that the key cannot have.
    #[error("the column \"{}\" has the unit \"{}\", which {problem}; {help}", shown(.column), shown(.unit))]
    Unit {
        /// Its name, or the path of the field of a struct.
        column: String,
        /// The unit.
        unit: String,
        /// What is wrong with it.
        problem: String,
        /// What to write instead.
        help: String,
    },
    /// Two columns give the same key.
    #[error("the columns \"{}\" and \"{}\" both give {key}: leave one out", shown(.first), shown(.second))]
    Twice {
        /// One column.
        first: String,
        /// The other column.
        second: String,
        /// The key.
        key: String,
    },
    /// A column to carry over has the name of one of the results.
    #[error("the column \"{}\" has the name of a result: rename it", shown(.column))]
    NameOfResult {
        /// Its name.
        column: String,
    },
    /// The contents of a column do not match its type, such as text that is not encoded in UTF-8.
    #[error("the column \"{}\" is damaged: {reason}; text has to be encoded in UTF-8", shown(.column))]
    Damaged {
        /// Its name.
        column: String,
        /// Arrow's error.
        reason: ArrowError,
    },
    /// Options that contradict each other, or are invalid.
    #[error("{0}")]
    Options(String),
    /// The run was ended.
    #[error("ended after {} of {total} rows", .finished.num_rows())]
    Ended {
        /// The results of the rows before the first unfinished one.
        finished: RecordBatch,
        /// Number of all rows.
        total: usize,
    },
    /// An error of Arrow.
    #[error(transparent)]
    Arrow(#[from] ArrowError),
}
