//! Why a table cannot be read at all. What is wrong with one row stands in that row.

use arrow_schema::{ArrowError, DataType};
use case::Diagnostics;

/// Why a table has no results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The template is no part of a case.
    #[error("the template is no part of a case: {}", .0.one_line())]
    Template(Box<Diagnostics>),
    /// A column looks like a key, and is none.
    #[error("the column \"{column}\" is no key of a case: {help}")]
    UnknownKey {
        /// Its name, or the path of the field of a struct.
        column: String,
        /// What to write instead.
        help: String,
    },
    /// A column of another type than its key has.
    #[error("the column \"{column}\" has the type {found}, but {wanted}")]
    Type {
        /// Its name, or the path of the field of a struct.
        column: String,
        /// Its type.
        found: DataType,
        /// What the key needs.
        wanted: String,
    },
    /// A unit that the key cannot have.
    #[error("the column \"{column}\" has the unit \"{unit}\", which {problem}; {help}")]
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
    #[error("the columns \"{first}\" and \"{second}\" both give {key}: leave one out")]
    Twice {
        /// One.
        first: String,
        /// The other.
        second: String,
        /// The key.
        key: String,
    },
    /// A column to carry over has the name of one of the results.
    #[error("the column \"{column}\" has the name of a result: rename it")]
    NameOfResult {
        /// Its name.
        column: String,
    },
    /// Options that do not fit together, or make no sense.
    #[error("{0}")]
    Options(String),
    /// The run was ended.
    #[error("ended after {done} of {total} rows")]
    Ended {
        /// Rows that were done.
        done: usize,
        /// All.
        total: usize,
    },
    /// Of the columns themselves.
    #[error(transparent)]
    Arrow(#[from] ArrowError),
}
