//! Whether the collision was avoidable.

use analysis::{AvoidPlan, AvoidStage, Avoidance, NoEstimate};
use case::Case;
use serde::Serialize;
use uncertainty::{MAX_SAMPLES, MIN_SAMPLES};

use crate::options::{OptionError, RequestOptions};
use crate::progress::{RequestProgress, counted, counted_of_estimate};
use crate::refusal::Unanswered;

/// Why an avoidability has no probability if the evidence gives no speed.
#[must_use]
pub fn no_probability(doubt: &NoEstimate) -> &'static str {
    match doubt {
        NoEstimate::Unconverged => {
            "the evidence for the speed was weighed, but the run did not converge, so there is no probability"
        }
        NoEstimate::Contradicted(_) => {
            "the evidence for the speed contradicts itself, so there is no probability"
        }
    }
}

/// How to ask whether a collision was avoidable: see [`AvoidPlan`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AvoidOptions {
    /// Number of samples, if ranges make the answer uncertain.
    pub samples: usize,
    /// The random seed: the same seed gives the same results.
    pub seed: u64,
    /// Whether the exact solution gives a speed to be found, even if there is more evidence.
    pub exact: bool,
}

impl Default for AvoidOptions {
    fn default() -> Self {
        let AvoidPlan { samples, seed, exact } = AvoidPlan::default();
        Self { samples, seed, exact }
    }
}

impl AvoidOptions {
    pub(crate) fn check(&self) -> Result<(), OptionError> {
        let samples = self.samples;
        if (MIN_SAMPLES..=MAX_SAMPLES).contains(&samples) {
            return Ok(());
        }
        let advice = format!("give a whole number from {MIN_SAMPLES} to {MAX_SAMPLES}");
        Err(OptionError::Value { option: "samples", given: samples.to_string(), advice })
    }

    pub(crate) fn read(options: &RequestOptions) -> Result<Self, OptionError> {
        let default = Self::default();
        Ok(Self {
            samples: options.size("samples")?.unwrap_or(default.samples),
            seed: options.count("seed")?.unwrap_or(default.seed),
            exact: options.flag("exact", default.exact)?,
        })
    }

    pub(crate) fn answer(
        &self,
        case: &Case,
        progress: &mut RequestProgress<'_>,
    ) -> Result<Avoidance, Unanswered> {
        let Self { samples, seed, exact } = *self;
        let at = &mut |stage, done, total| {
            let what = match stage {
                AvoidStage::Estimate(stage) => counted_of_estimate(stage),
                AvoidStage::Samples(stage) => counted(stage),
            };
            progress(what, done, total)
        };
        Ok(analysis::avoid(case, &AvoidPlan { samples, seed, exact }, at)?)
    }
}
