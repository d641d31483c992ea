//! The example runs, and its numbers hold.

#[path = "../examples/printed_report.rs"]
mod printed_report;

#[test]
fn the_example_runs() {
    printed_report::main().unwrap();
}
