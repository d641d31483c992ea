//! Tests of the validation, in one binary.

mod claims;
mod momentum;
