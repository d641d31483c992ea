//! The examples run, and their numbers hold.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../examples/propagate.rs"]
mod propagate;

#[test]
fn the_propagate_example_runs() {
    propagate::main().unwrap();
}
