//! The example runs, and its numbers hold.

#[path = "../examples/rest.rs"]
mod rest;

#[test]
fn the_rest_example_runs() {
    rest::main().unwrap();
}
