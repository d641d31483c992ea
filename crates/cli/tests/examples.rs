//! The examples of all crates run, and their numbers hold. They stand here because the program links every crate anyway.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../../crash3/examples/barrier_test.rs"]
mod barrier_test;
#[path = "../../case/examples/convert.rs"]
mod convert;
#[path = "../../crash3/examples/damage.rs"]
mod damage;
#[path = "../../real/examples/derivative.rs"]
mod derivative;
#[path = "../../validation/examples/error_rate.rs"]
mod error_rate;
#[path = "../../pim-core/examples/impact.rs"]
mod impact;
#[path = "../../analysis/examples/influence.rs"]
mod influence;
#[path = "../../pim-core/examples/laws.rs"]
mod laws;
#[path = "../../uncertainty/examples/propagate.rs"]
mod propagate;
#[path = "../../analysis/examples/reconstruct.rs"]
mod reconstruct;
#[path = "../../reconcile/examples/speed.rs"]
mod speed;
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
fn the_barrier_test_example_runs() {
    barrier_test::main().unwrap();
}

#[test]
fn the_damage_example_runs() {
    damage::main().unwrap();
}

#[test]
fn the_impact_example_runs() {
    impact::main().unwrap();
}

#[test]
fn the_laws_example_runs() {
    laws::main().unwrap();
}

#[test]
fn the_derivative_example_runs() {
    derivative::main();
}

#[test]
fn the_speed_example_runs() {
    speed::main().unwrap();
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
