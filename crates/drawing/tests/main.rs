//! The tests of the pictures, in one binary.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod motion;
mod pdf;
mod pictures;
mod reader;
