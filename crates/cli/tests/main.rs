//! The tests of the program, in one binary; tests that need a process of their own are separate.

mod avoid;
mod batch;
#[path = "../../case/tests/changes.rs"]
mod changes;
mod ciss;
mod drawn;
mod estimate;
mod examples;
mod field;
mod guide;
mod hostile;
mod json;
mod live;
mod outputs;
mod rows;
mod site_plan;
mod start;
mod table;
mod words;
mod writing;
