//! The example runs, and its numbers hold.

#[path = "../examples/derivative.rs"]
mod derivative;

#[test]
fn the_derivative_example_runs() {
    derivative::main();
}
