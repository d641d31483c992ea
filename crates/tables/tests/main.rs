//! The tests of tables, in one binary.

mod fixtures;
mod forms;
mod rows;
mod same;
