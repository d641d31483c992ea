//! The example runs, and its numbers hold.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../examples/error_rate.rs"]
mod error_rate;

#[test]
fn the_error_rate_example_runs() {
    error_rate::main().unwrap();
}
