//! The tests of this crate.

#![allow(clippy::unwrap_used, reason = "tests")]

mod records;
mod written;
