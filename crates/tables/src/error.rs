//! Why a table cannot be read at all. What is wrong with one row stands in that row.

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, DataType};
use case::{Diagnostics, shown};

/// Why a table has no results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The template is no part of a case.
    #[error("the template is no part of a case: {}", .0.one_line())]
    Template(Box<Diagnostics>),
    /// A column looks like a key, and is none.
    #[error("the column \"{}\" is no key of a case: {}", shown(.column), shown(.help))]
    UnknownKey {
        /// Its name, or the path of the field of a struct.
        column: String,
        /// What to write instead.
        help: String,
    },
    /// No column gives a key, so that every row would be the template.
    #[error(
        "no column of the table is a key of a case, so every row would be the template: its columns are \"{}\"; a \
         key is called like \"vehicle2.speed [mph]\"",
        shown(&.columns.join("\", \""))
    )]
    NoKey {
        /// Their names.
        columns: Vec<String>,
    },
    /// A column of another type than its key has.
    #[error("the column \"{}\" has the type {found}, but {wanted}", shown(.column))]
    Type {
        /// Its name, or the path of the field of a struct.
        column: String,
        /// Its type.
        found: DataType,
        /// What the key needs.
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
    /// Two columns of one key.
    #[error("the columns \"{}\" and \"{}\" both give {key}: leave one out", shown(.first), shown(.second))]
    Twice {
        /// One.
        first: String,
        /// The other.
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
    /// What a column holds is not what its type says, such as text that is not encoded in UTF-8.
    #[error("the column \"{}\" is damaged: {reason}; text has to be encoded in UTF-8", shown(.column))]
    Damaged {
        /// Its name.
        column: String,
        /// What the library of Arrow says.
        reason: ArrowError,
    },
    /// Options that do not fit together, or make no sense.
    #[error("{0}")]
    Options(String),
    /// The run was ended.
    #[error("ended after {} of {total} rows", .finished.num_rows())]
    Ended {
        /// The results of the rows up to the first that was not done.
        finished: RecordBatch,
        /// All.
        total: usize,
    },
    /// Of the columns themselves.
    #[error(transparent)]
    Arrow(#[from] ArrowError),
}
