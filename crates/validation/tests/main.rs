//! Tests of the validation, in one binary.

mod after_impact;
mod claims;
mod momentum;
mod tangential_share;
