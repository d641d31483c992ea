//! The task for the rows of a table, and its options.

use analysis::EstimatePlan;
use case::{SeverityPrior, choices};
use estimate::{MOST_PARTICLES, PARTICLES_STEP, ParticleSettings};
use uncertainty::MIN_SAMPLES;

use crate::error::TableError;

choices! {
    /// The task for each row.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Job {
        /// The speed that makes impact and crush agree: as `deltav reconstruct --exact`, and with samples as
        /// `deltav uncertainty`.
        Reconstruct = "reconstruct",
        /// The effect of the impact, with both speeds given: as `deltav impact`.
        Impact = "impact",
        /// Energies and ΔV from the damage alone: as `deltav crush`.
        Crush = "crush",
        /// Both speeds from all the evidence: as `deltav estimate`.
        Estimate = "estimate",
        /// Whether the collision was avoidable: as `deltav avoid`.
        Avoid = "avoid",
    }
}

/// How the rows are computed.
#[derive(Clone, Copy, Debug)]
pub struct RowOptions {
    /// Samples of each row for its intervals, Monte Carlo; if absent, there are no intervals. For
    /// [`Job::Reconstruct`] and [`Job::Impact`]; for [`Job::Avoid`], those of its probability, in place of
    /// [`SAMPLES`](analysis::AvoidPlan::SAMPLES).
    pub samples: Option<usize>,
    /// The seed of every row that has none in the column `seed`. It is the same for all of them: the results
    /// of a row do not depend on its position in the table.
    pub seed: u64,
    /// For [`Job::Estimate`]: particles of each of 16 islands, a multiple of 128.
    pub particles: usize,
    /// For [`Job::Estimate`]: in place of the `prior` of the case.
    pub prior: Option<SeverityPrior>,
}

impl Default for RowOptions {
    fn default() -> Self {
        Self { samples: None, seed: 1, particles: EstimatePlan::PARTICLES, prior: None }
    }
}

impl RowOptions {
    /// Whether they fit a job.
    ///
    /// # Errors
    /// [`TableError::Options`] if one does not.
    pub fn check(&self, job: Job) -> Result<(), TableError> {
        let &Self { samples, particles, prior, .. } = self;
        let name = job.name();
        let problem = match (job, samples) {
            (Job::Crush | Job::Estimate, Some(_)) => {
                format!(
                    "samples are for the jobs reconstruct, impact and avoid, and the job is {name}: leave them out"
                )
            }
            (_, Some(samples)) if samples < MIN_SAMPLES => {
                format!("{samples} samples are too few: give {MIN_SAMPLES} or more")
            }
            (Job::Estimate, _) if !ParticleSettings::can_have(particles) => format!(
                "the number of particles is {particles}: give a multiple of {PARTICLES_STEP} up to {MOST_PARTICLES}"
            ),
            (Job::Estimate, _) => return Ok(()),
            _ if prior.is_some() || particles != EstimatePlan::PARTICLES => {
                format!(
                    "particles and a prior are for the job estimate, and the job is {name}: leave them out"
                )
            }
            _ => return Ok(()),
        };
        Err(TableError::Options(problem))
    }
}
