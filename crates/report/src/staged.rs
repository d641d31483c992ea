//! Plots of the comparison with the RICSAC collisions.

mod plot;

pub use plot::{computed_against_measured, reconstructed_speed};
