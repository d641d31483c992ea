//! The tests of samples and indices, in one binary.

mod distributions;
mod propagation;
mod ranking;
