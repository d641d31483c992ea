//! The examples run, and their numbers hold.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../examples/convert.rs"]
mod convert;

#[test]
fn the_convert_example_runs() {
    convert::main().unwrap();
}
