//! The posterior of a collision, compared with independent calculations.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "helpers of tests fail by panicking, slow tests print"
)]
#![allow(
    clippy::disallowed_methods,
    reason = "expected values by other functions than the crate's; no bits are compared"
)]

mod calibration;
mod figures;
mod likelihood;
mod posterior;
mod reference;
mod tested;
