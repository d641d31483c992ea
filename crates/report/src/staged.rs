//! Plots of the comparison with the RICSAC collisions.

mod label;
mod plot;

pub use plot::{PlotError, computed_against_measured, reconstructed_speed};
