//! The examples run, and their numbers hold.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../examples/influence.rs"]
mod influence;
#[path = "../examples/reconstruct.rs"]
mod reconstruct;

#[test]
fn the_influence_example_runs() {
    influence::main().unwrap();
}

#[test]
fn the_reconstruct_example_runs() {
    reconstruct::main().unwrap();
}
