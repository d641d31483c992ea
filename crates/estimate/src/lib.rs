//! Draws from a posterior, and its evidence: what evidence makes of what was known before.
//!
//! Tempered sequential Monte Carlo: particles drawn from the prior are led to the posterior in steps, and
//! weighed, resampled and moved at each. It needs no derivatives, finds several modes, takes a block of
//! particles at a
//! time, and says when it has not converged.
//!
//! ```
//! use estimate::{LikelihoodFunction, Independent, DrawnQuantity, Settings, Verdict, sample_quietly};
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
//! let posterior = sample_quietly(&prior, &evidence, &Settings::new(512, 1))?;
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
//! | [`Prior`], [`Independent`] | how standard normal numbers become the unknown values |
//! | [`Evidence`], [`LikelihoodFunction`] | the log-likelihood in terms, one for each piece of evidence; further outputs and residuals |
//! | [`Hurdle`] | what a proposal has to reach, for evidence of which some terms take long |
//! | [`Settings`], [`Selection`] | number of particles and islands, seed; which pieces of evidence are used |
//! | [`sample`] → [`Posterior`] | draws of equal weight, their log evidence, and a [`Verdict`] with its reasons |
//! | [`DrawsSummary`], [`Draws`] | mean, deviation, median, intervals and probabilities, with standard errors |
//! | [`Posterior::without`] → [`Weights`] | the answer without some pieces of evidence, from the same draws |
//! | [`sample_without`] | the same by draws of its own, which start from those with all evidence |
//! | [`Posterior::check`] → [`PieceCheck`] | one piece of evidence against what the rest predicts: a p-value |
//! | [`Failure`], [`Exclusion`] | why there is no answer, and what excludes what |
//!
//! # The method
//!
//! Everything happens in a space where the prior is standard normal. Some islands, 16 unless told otherwise,
//! each lead a population of their own from the prior to the posterior, and know nothing of each other:
//! so what they tell differs as much as sampling lets it, and all standard errors, R̂ and effective sample
//! sizes follow from this. `docs/theory.md` in the repository has the equations, section 12.
//!
//! # Guarantees
//!
//! - The same prior, evidence and settings give the same bits for any number of threads, with and without the
//!   feature `parallel`, for any of the [`uncertainty::Instructions`] and in any build profile, if prior and
//!   evidence do.
//! - A log-likelihood that is NaN or +∞ ends the run with an error that has the values; it never becomes a
//!   draw. −∞ and failures of the model are allowed.
//! - [`Verdict::Converged`] is refused where R̂ is above [`R_HAT_LIMIT`], where an effective sample size is
//!   below [`ESS_LIMIT`] or, for the extremes, [`EXTREME_ESS_LIMIT`], where the islands' evidence differs by
//!   more than [`EVIDENCE_LIMIT`], where a mode descends from fewer than [`ANCESTORS_LIMIT`] draws of the
//!   prior, and where moves or possible draws of the prior are lacking.
//!
//! # What it does not do
//!
//! It does not see a mode that no particle has met: of a mode that has 1e-5 of the prior, where the way there
//! does not rise, most runs of ten thousand particles know nothing, and their verdict neither. Nor does it
//! see
//! that all islands are wrong alike, as where moves at the end have only begun to lead into a mode that no
//! draw of the prior had met. Take more particles, or a prior that is nearer.
//!
//! It has no use for derivatives: in hundreds of dimensions, a sampler that has is better. Values have no
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
pub use error::{CannotReweight, Culprit, Exclusion, Failure};
pub use limits::{LEAST_ISLANDS, MOST_PARTICLES, PARTICLES_STEP};
pub use model::{Evidence, Hurdle, Independent, LikelihoodFunction, Part, Prior, Selection};
pub use posterior::{PieceCheck, Posterior, sample, sample_quietly, sample_without};
pub use reweight::{PARETO_LIMIT, Weights};
pub use settings::{ISLANDS, Settings};
pub use summary::{Draws, DrawsInterval, DrawsSummary, LEVELS};
