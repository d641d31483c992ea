//! The tests of numbers and elementary functions, in one binary.

mod elementary;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod written;
