//! The examples of the engine's crates run, and their numbers hold.

#[path = "../crates/crash3/examples/barrier_test.rs"]
mod barrier_test;
#[path = "../crates/crash3/examples/damage.rs"]
mod damage;
#[path = "../crates/real/examples/derivative.rs"]
mod derivative;
#[path = "../crates/pim-core/examples/impact.rs"]
mod impact;
#[path = "../crates/pim-core/examples/laws.rs"]
mod laws;
#[path = "../crates/trajectory/examples/rest.rs"]
mod rest;
#[path = "../crates/reconcile/examples/speed.rs"]
mod speed;

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
fn the_rest_example_runs() {
    rest::main().unwrap();
}

#[test]
fn the_speed_example_runs() {
    speed::main().unwrap();
}
