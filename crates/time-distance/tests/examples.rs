//! The example runs, and its numbers hold.

#[path = "../examples/avoidable.rs"]
mod avoidable;

#[test]
fn the_example_runs() {
    avoidable::main().unwrap();
}
