//! Tests of the validation, in one binary.

mod after_impact;
mod claims;
mod judged;
mod momentum;
mod tangential_share;
