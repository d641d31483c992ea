//! The tests of the case file, in one binary.

mod avoid;
mod cases;
mod changes;
mod edit;
mod estimates;
mod guide;
mod invalid;
mod large;
mod motion;
mod recorders;
mod schema;
