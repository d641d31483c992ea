//! Ranges in, ranges out: propagates what is not known exactly of the inputs of any function to its outputs, and tells which input matters.
//!
//! ```
//! use std::ops::ControlFlow;
//! use uncertainty::{Distribution, Function, Method, Settings, propagate};
//!
//! // Braking distance s = v²/2a from 20 m/s, give or take 1 m/s, at 6 to 8 m/s².
//! let inputs = [Distribution::normal(20.0, 1.0)?, Distribution::uniform(6.0, 8.0)?];
//! let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
//!     y[0] = x[0] * x[0] / (2.0 * x[1]);
//!     Ok(())
//! });
//! let settings = Settings::new(Method::MonteCarlo, 100_000, 1);
//! let result = propagate(&model, &inputs, &settings, &mut |_, _| ControlFlow::Continue(()))?;
//!
//! // E[v²]·E[1/2a] = 401 m²/s² · ln(8/6)/4 s²/m = 28.84 m
//! let summary = result.summaries()[0].ok_or("no sample has an answer")?;
//! let exact = 401.0 * 0.287_682_072_451_780_93 / 4.0;
//! let error = summary.mean.standard_error.ok_or("too few samples")?;
//! assert!((summary.mean.value - exact).abs() < 4.0 * error);
//! assert_eq!(summary.intervals[2].level, 0.95);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Items
//!
//! | item | is |
//! |---|---|
//! | [`Distribution`] | what is known of an input: normal, normal within bounds, uniform, triangular |
//! | [`Model`], [`Function`] | what is evaluated: a block of samples, or one |
//! | [`Settings`], [`Method`] | number of samples, seed, kind of points: Monte Carlo, Latin hypercube, scrambled Sobol' |
//! | [`propagate`] → [`Propagation`] | samples of the outputs, and a [`Summary`] of each: mean, deviation, median, intervals, with standard errors |
//! | [`sensitivity`] → [`Sensitivity`] | first-order and total [`Indices`] of the inputs, with standard errors |
//! | [`tornado`] → [`Tornado`] | one input at a time, from low to high |
//! | [`FirstOrder`] | propagation by derivatives, and whether it differs from the samples |
//! | [`Sampler`] | the inputs of the samples, made again |
//!
//! # Guarantees
//!
//! - The same inputs, settings and model give the same bits for any number of threads, with and without the feature `parallel`, for any of the [`Instructions`] and
//!   in any build profile. Nothing here calls the mathematical functions of the platform; a model that does has its own bits.
//! - Every point follows from seed, number of input and number of sample alone. All distributions go through their inverse
//!   transform, so that every method serves every distribution; only independent points become normal numbers by Box–Muller, which is quicker.
//! - Samples without an answer are counted by reason. An output that is infinite or NaN counts as a failure.
//! - A run that is ended early leaves the first samples of the whole run, evenly from all replicates.
//! - Memory grows with samples × outputs. Inputs are not kept.
//!
//! # Threads
//!
//! With the feature `parallel`, the work is shared among the threads of rayon's current pool: `ThreadPool::install` chooses another.
//!
//! `examples/propagate.rs` sends ranges through a function and compares with the propagation by hand.
//!
//! # What it does not do
//!
//! Inputs do not depend on each other. A uniform or triangular distribution is not cut: choose its bounds where they make sense. Sobol' points
//! serve [`MAX_SOBOL_INPUTS`] inputs, half of that in [`sensitivity`]. No quantity has a unit here, no input a name; files, histograms and words are for others.

mod distribution;
mod error;
mod first_order;
mod model;
mod normal;
mod points;
mod propagate;
mod random;
mod run;
mod sampler;
mod sensitivity;
mod summary;
mod tornado;

pub use distribution::{Distribution, MIN_KEPT, Shape, Truncation};
pub use error::{InvalidDistribution, InvalidRequest};
pub use first_order::{FIRST_ORDER_LIMIT, FirstOrder};
pub use model::{Failures, Function, LANES, Lanes, Model, NOT_FINITE, SUCCEEDED};
pub use points::{MAX_SAMPLES, MAX_SOBOL_INPUTS, MIN_SAMPLES, Method, REPLICATES};
pub use propagate::{Propagation, propagate};
pub use run::{Instructions, Progress};
pub use sampler::{Sampler, Settings};
pub use sensitivity::{Index, Indices, Sensitivity, sensitivity};
pub use summary::{Estimate, Interval, LEVELS, Summary};
pub use tornado::{Bar, End, TORNADO_PROBABILITIES, Tornado, tornado};
