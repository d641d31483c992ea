//! The tests of the reports, in one binary.

mod drawable;
mod explain;
mod failures;
mod field;
mod fixtures;
mod large;
mod quantities;
mod recorder;
mod roots;
mod validation;
mod warnings;
mod words;
