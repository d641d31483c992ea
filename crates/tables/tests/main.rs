//! The tests of tables, in one binary.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

mod fixtures;
mod forms;
mod rows;
mod same;
