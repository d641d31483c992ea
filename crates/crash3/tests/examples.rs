//! The examples run, and their numbers hold.

#[path = "../examples/barrier_test.rs"]
mod barrier_test;
#[path = "../examples/damage.rs"]
mod damage;

#[test]
fn the_barrier_test_example_runs() {
    barrier_test::main().unwrap();
}

#[test]
fn the_damage_example_runs() {
    damage::main().unwrap();
}
