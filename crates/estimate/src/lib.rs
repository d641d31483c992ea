//! Draws from a Bayesian posterior, and its evidence.
//!
//! Tempered sequential Monte Carlo: particles drawn from the prior move to the posterior in steps; each step
//! weights, resamples and moves them. The method needs no derivatives, finds several modes, processes
//! particles in blocks, and reports when it has not converged.
//!
//! ```
//! use estimate::{LikelihoodFunction, Independent, DrawnQuantity, ParticleSettings, Verdict, sample_quietly};
//! use uncertainty::Distribution;
//!
//! // A speed, by a rough guess 15 ± 5 m/s. Two measurements: 18 ± 2 m/s, and its square, 250 ± 40 m²/s².
//! let prior = Independent(vec![Distribution::normal(15.0, 5.0)?]);
//! let evidence = LikelihoodFunction::new(2, |values: &[f64], terms: &mut [f64]| {
//!     let z = [(18.0 - values[0]) / 2.0, (250.0 - values[0] * values[0]) / 40.0];
//!     terms[0] = -0.5 * z[0] * z[0];
//!     terms[1] = -0.5 * z[1] * z[1];
//!     Ok(())
//! });
//! let posterior = sample_quietly(&prior, &evidence, &ParticleSettings::new(512, 1))?;
//! assert_eq!(posterior.verdict(), Verdict::Converged);
//! let speed = posterior.summary(DrawnQuantity::Value(0));
//! // By quadrature of prior times likelihood.
//! assert!((speed.mean.value - 16.290).abs() < 0.06);
//! assert!((speed.sd.value - 1.016).abs() < 0.06);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Items
//!
//! | item | what it is |
//! |---|---|
//! | [`Prior`], [`Independent`] | the transform of standard normal numbers into the unknown values |
//! | [`Evidence`], [`LikelihoodFunction`] | the log-likelihood in terms, one for each piece of evidence; further outputs and residuals |
//! | [`Hurdle`] | the condition for accepting a proposal, for evidence with slow terms |
//! | [`ParticleSettings`], [`Selection`] | number of particles and islands, seed, pieces of evidence used |
//! | [`sample`] → [`Posterior`] | draws of equal weight, the log evidence, and a [`Verdict`] with its reasons |
//! | [`DrawsSummary`], [`Draws`] | mean, deviation, median, intervals and probabilities, with standard errors |
//! | [`Posterior::without`] → [`Weights`] | the answer without some pieces of evidence, from the same draws |
//! | [`sample_without`] | the same with new draws, started from those with all evidence |
//! | [`Posterior::check`] → [`PieceCheck`] | one piece of evidence compared with the prediction of the rest: a p-value |
//! | [`NoDraws`], [`Exclusion`] | the reason why there is no answer, and the evidence that excludes the prior |
//!
//! # The method
//!
//! The sampler works in a space in which the prior is standard normal. Several independent islands, 16 by
//! default, each lead a population from the prior to the posterior. The spread of their results is that of
//! sampling; all standard errors, R̂ and effective sample sizes follow from it. `docs/theory.md` in the
//! repository has the equations, section 12.
//!
//! # Guarantees
//!
//! - The same prior, evidence and settings give the same bits for any number of threads, with and without the
//!   feature `parallel`, for any of the [`uncertainty::Instructions`] and in any build profile, if prior and
//!   evidence do so.
//! - A log-likelihood of NaN or +∞ ends the run with an error that holds the values; it never becomes a draw.
//!   −∞ and failures of the model are allowed.
//! - [`Verdict::Converged`] is refused if R̂ is above [`R_HAT_LIMIT`], if an effective sample size is below
//!   [`ESS_LIMIT`] or, for the extremes, [`EXTREME_ESS_LIMIT`], if the islands' evidence differs by more than
//!   [`EVIDENCE_LIMIT`], if a mode descends from fewer than [`ANCESTORS_LIMIT`] draws from the prior, and if
//!   there are too few moves or possible draws from the prior.
//!
//! # What it does not do
//!
//! It does not detect a mode that no particle has found: most runs of ten thousand particles, and their
//! verdict, miss a mode with 1e-5 of the prior if the likelihood does not rise towards it. Nor does it detect
//! that all islands are wrong in the same way, for example if the final moves have only begun to enter a mode
//! that no draw from the prior had found. Use more particles, or a prior nearer to the posterior.
//!
//! It does not use derivatives: in hundreds of dimensions, a sampler that does is better. Values have no
//! names and no units here.

mod circle;
mod diagnosis;
mod error;
mod gaussian;
mod island;
mod limits;
mod model;
mod moves;
mod posterior;
mod reweight;
mod settings;
mod shrink;
mod summary;
mod target;

pub use diagnosis::{
    ANCESTORS_LIMIT, Diagnosis, DrawnQuantity, ESS_LIMIT, EVIDENCE_LIMIT, EXTREME_ESS_LIMIT, Mixing, Mode,
    POSSIBLE_LIMIT, R_HAT_LIMIT, SamplerDoubt, UNMOVED_LIMIT, Verdict,
};
pub use error::{CannotReweight, Culprit, Exclusion, NoDraws};
pub use limits::{LEAST_ISLANDS, MOST_ISLANDS, MOST_PARTICLES, PARTICLES_STEP};
pub use model::{Evidence, Hurdle, Independent, LikelihoodFunction, Part, Prior, Selection};
pub use posterior::{PieceCheck, Posterior, sample, sample_quietly, sample_without};
pub use reweight::{PARETO_LIMIT, Weights};
pub use settings::{ISLANDS, ParticleSettings};
pub use summary::{Draws, DrawsSummary, LEVELS};
pub use uncertainty::Interval as DrawsInterval;
