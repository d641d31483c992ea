//! The examples run, and their numbers hold.

#[path = "../examples/impact.rs"]
mod impact;
#[path = "../examples/laws.rs"]
mod laws;

#[test]
fn the_impact_example_runs() {
    impact::main().unwrap();
}

#[test]
fn the_laws_example_runs() {
    laws::main().unwrap();
}
