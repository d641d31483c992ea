//! The examples of the crates around the engine run, and their numbers hold. The program links all of these
//! crates anyway.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../../case/examples/convert.rs"]
mod convert;
#[path = "../../validation/examples/error_rate.rs"]
mod error_rate;
#[path = "../../analysis/examples/influence.rs"]
mod influence;
#[path = "../../uncertainty/examples/propagate.rs"]
mod propagate;
#[path = "../../analysis/examples/reconstruct.rs"]
mod reconstruct;
#[path = "../../report/examples/text_and_drawing.rs"]
mod text_and_drawing;

#[test]
fn the_influence_example_runs() {
    influence::main().unwrap();
}

#[test]
fn the_reconstruct_example_runs() {
    reconstruct::main().unwrap();
}

#[test]
fn the_convert_example_runs() {
    convert::main().unwrap();
}

#[test]
fn the_text_and_drawing_example_runs() {
    text_and_drawing::main().unwrap();
}

#[test]
fn the_propagate_example_runs() {
    propagate::main().unwrap();
}

#[test]
fn the_error_rate_example_runs() {
    error_rate::main().unwrap();
}
