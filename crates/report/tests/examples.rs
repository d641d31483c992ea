//! The examples run, and their numbers hold.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../examples/text_and_drawing.rs"]
mod text_and_drawing;

#[test]
fn the_text_and_drawing_example_runs() {
    text_and_drawing::main().unwrap();
}
