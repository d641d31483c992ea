//! Tests of the validation, in one binary.

mod claims;
mod momentum;
mod tangential_share;
