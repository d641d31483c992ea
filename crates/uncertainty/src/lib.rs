//! Propagates the uncertainty of the inputs of any function to its outputs, and ranks the inputs.
//!
//! ```
//! use std::ops::ControlFlow;
//! use crash3::{Profile, Stiffness, crush_energy};
//! use uncertainty::{Distribution, Function, SamplingMethod, Settings, propagate};
//!
//! // SAE 980025, appendix: six depths of crush over 65 in of the GMC Jimmy's front. How accurate is its
//! // crush energy (Eq 5) if each depth was measured to half an inch?
//! let [inch, width] = [0.0254, 65.0 * 0.0254];
//! let depth = |depth: f64| Distribution::normal(depth * inch, 0.5 * inch);
//! let inputs = [depth(21.3)?, depth(20.3)?, depth(13.8)?, depth(11.3)?, depth(5.3)?, depth(4.8)?];
//! let stiffness = Stiffness::from_ab(58_740.0, 633_000.0)?;
//! let model = Function::new(1, |depths: &[f64], energy: &mut [f64]| {
//!     let profile = Profile::equally_spaced(depths.to_vec(), width).map_err(|_| 1_u8)?;
//!     energy[0] = crush_energy(&profile, &stiffness);
//!     Ok(())
//! });
//! let settings = Settings::new(SamplingMethod::MonteCarlo, 100_000, 1);
//! let result = propagate(&model, &inputs, &settings, &mut |_, _| ControlFlow::Continue(()))?;
//!
//! let summary = result.summaries()[0].ok_or("no sample has an answer")?;
//! assert!((summary.mean.value / 1.02e5 - 1.0).abs() < 0.005); // the paper: 1.02e5 N·m
//! // By hand: σ_E² = Σ (∂E/∂C_j)² σ², with ∂E/∂C_j = w (A + B (C_j−1 + 4 C_j + C_j+1)/6) and, at the ends,
//! // w (A/2 + B (2 C_1 + C_2)/6).
//! assert!((summary.sd.value / 2462.0 - 1.0).abs() < 0.01);
//! assert_eq!(summary.intervals[2].level, 0.95);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Items
//!
//! | item | what it is |
//! |---|---|
//! | [`Distribution`] | the distribution of an input: normal, normal within bounds, log-normal, uniform, triangular |
//! | [`Model`], [`Function`] | the function to evaluate, for a block of samples or for one |
//! | [`Settings`], [`SamplingMethod`] | number of samples, seed, kind of points: Monte Carlo, Latin hypercube, scrambled Sobol' |
//! | [`propagate`] → [`Propagation`] | samples of the outputs, and a [`Summary`] of each: mean, deviation, median, intervals, with standard errors |
//! | [`sensitivity`] → [`SobolIndices`] | first-order and total [`Indices`] of the inputs, with standard errors |
//! | [`tornado`] → [`Tornado`] | one input at a time, from low to high |
//! | [`FirstOrder`] | propagation by derivatives, and whether it differs from the samples |
//! | [`Sampler`] | the inputs of the samples, generated again |
//! | [`random`], [`normal`], [`order_statistic`], [`in_order`], [`for_each`] | building blocks for other engines: random bits by index, standard normal numbers, work shared among threads |
//!
//! # Guarantees
//!
//! - The same inputs, settings and model give the same bits for any number of threads, with and without the
//!   feature `parallel`, for any of the [`Instructions`] and in any build profile. Nothing here calls the
//!   mathematical functions of the platform; a model that does has its own bits.
//! - Every point depends only on the seed, the number of the input and the number of the sample; Latin
//!   hypercube and Sobol' points also depend on the number of inputs and samples. All distributions use their
//!   inverse transform, so every method works with every distribution; only independent points are turned
//!   into normal numbers by Box–Muller, which is faster.
//! - Samples without an answer are counted by reason. An output that is infinite or NaN counts as a failure.
//! - A run that is ended early returns the first samples of the whole run, evenly from all replicates.
//! - Medians and intervals are exact order statistics.
//! - Every output of every sample is kept, eight bytes each, but no input: [`MAX_SAMPLES`] samples of
//!   thirteen outputs take a gigabyte.
//!
//! # Threads
//!
//! With the feature `parallel`, the work is shared among the threads of rayon's current pool:
//! `ThreadPool::install` chooses another.
//!
//! `examples/propagate.rs` propagates ranges through a function and compares the result with a hand
//! calculation.
//!
//! # What it does not do
//!
//! It treats all inputs as independent. It does not truncate a uniform or triangular distribution: choose
//! bounds that make sense. Sobol' points support [`MAX_SOBOL_INPUTS`] inputs, half as many in
//! [`sensitivity`]. Quantities have no units here, and inputs no names; files, histograms and texts are left
//! to other crates.

mod distribution;
mod error;
mod first_order;
mod limits;
mod model;
pub mod normal;
mod points;
mod propagate;
pub mod random;
mod run;
mod sampler;
mod sensitivity;
mod summary;
mod tornado;

#[doc(hidden)]
pub use fearless_simd as simd;

pub use distribution::{Distribution, MIN_KEPT, Shape, Truncation};
pub use error::{InvalidDistribution, InvalidRequest};
pub use first_order::{FIRST_ORDER_LIMIT, FirstOrder};
pub use limits::{MAX_SAMPLES, MIN_SAMPLES, REPLICATES};
pub use model::{Failures, Function, LANES, Lanes, Model, NOT_FINITE, SUCCEEDED, evaluate_each};
pub use points::{MAX_SOBOL_INPUTS, SamplingMethod};
pub use propagate::{Propagation, propagate};
pub use run::{Instructions, Progress, Span, for_each, in_order, join};
pub use sampler::{Sampler, Settings};
pub use sensitivity::{Index, Indices, SobolIndices, sensitivity};
pub use summary::{Classes, Estimate, Histogram, Interval, LEVELS, Summary, order_statistic};
pub use tornado::{Bar, End, TORNADO_PROBABILITIES, Tornado, tornado};
