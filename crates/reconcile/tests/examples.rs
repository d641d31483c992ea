//! The examples run, and their numbers hold.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../examples/speed.rs"]
mod speed;

#[test]
fn the_speed_example_runs() {
    speed::main().unwrap();
}
