//! The tests of the program, in one binary; what needs a process of its own stands beside it.

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
