//! The examples run, and their numbers hold.

#[path = "../examples/speed.rs"]
mod speed;

#[test]
fn the_speed_example_runs() {
    speed::main().unwrap();
}
