//! The posterior of a collision against independent calculations.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![allow(
    clippy::disallowed_methods,
    reason = "expected values by other functions than the crate's; no bits are compared"
)]

mod likelihood;
mod posterior;
