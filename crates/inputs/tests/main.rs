//! The tests of the inputs, in one binary.

#[cfg(test)]
mod demands;
