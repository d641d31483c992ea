//! The speeds from all evidence.

use analysis::{EstimatePlan, Estimated, PieceDetail};
use case::{Case, SeverityPrior};
use estimate::{MOST_PARTICLES, PARTICLES_STEP, ParticleSettings};
use report::{Asked, Question};
use serde::{Serialize, Serializer};

use crate::options::{OptionError, RequestOptions};
use crate::progress::{RequestProgress, of_estimate};
use crate::refusal::Unanswered;

/// How to estimate, and further questions: see [`EstimatePlan`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EstimateOptions {
    /// Number of particles of each of 16 islands.
    pub particles: usize,
    /// The random seed: the same seed gives the same results.
    pub seed: u64,
    /// In place of the `prior` of the case.
    #[serde(serialize_with = "prior")]
    pub prior: Option<SeverityPrior>,
    /// Whether to find the answer by each piece of evidence alone.
    pub pieces: bool,
    /// Questions such as `vehicle1.speed 50 km/h`: how probable is it that the result is above the limit?
    pub above: Vec<String>,
}

/// The plan for weighing evidence: the default options, without the answers by each piece alone.
pub(crate) const WEIGHING: EstimatePlan =
    EstimatePlan { particles: EstimatePlan::PARTICLES, seed: 1, prior: None, pieces: PieceDetail::Compared };

impl Default for EstimateOptions {
    fn default() -> Self {
        let EstimatePlan { particles, seed, prior, .. } = WEIGHING;
        Self { particles, seed, prior, pieces: true, above: Vec::new() }
    }
}

/// The word for it.
fn prior<S: Serializer>(prior: &Option<SeverityPrior>, out: S) -> Result<S::Ok, S::Error> {
    prior.map(SeverityPrior::name).serialize(out)
}

/// An estimate, with its plan and its questions.
#[derive(Debug)]
pub struct EstimateAnswer {
    /// The result of all the evidence.
    pub estimated: Estimated,
    /// The plan and the questions.
    pub asked: Asked,
}

impl EstimateOptions {
    /// Checks that a number of particles can be dealt into two halves of whole blocks.
    ///
    /// # Errors
    /// What to give instead.
    pub fn check_particles(particles: usize) -> Result<usize, String> {
        if ParticleSettings::can_have(particles) {
            return Ok(particles);
        }
        let usual = EstimatePlan::PARTICLES;
        Err(format!("give a multiple of {PARTICLES_STEP} up to {MOST_PARTICLES}, such as {usual}"))
    }

    pub(crate) fn check(&self) -> Result<(), OptionError> {
        let particles = self.particles;
        let wrong = |advice| OptionError::Value { option: "particles", given: particles.to_string(), advice };
        Self::check_particles(particles).map(drop).map_err(wrong)
    }

    pub(crate) fn read(options: &RequestOptions) -> Result<Self, OptionError> {
        let default = Self::default();
        Ok(Self {
            above: options.texts("above")?.unwrap_or_default(),
            particles: options.size("particles")?.unwrap_or(default.particles),
            seed: options.count("seed")?.unwrap_or(default.seed),
            prior: options.word("prior", &SeverityPrior::WORDS)?,
            pieces: options.flag("pieces", default.pieces)?,
        })
    }

    /// The answer to it.
    ///
    /// # Errors
    /// [`Unanswered`].
    pub fn answer(
        &self,
        case: &Case,
        progress: &mut RequestProgress<'_>,
    ) -> Result<EstimateAnswer, Unanswered> {
        let outputs = analysis::estimate_outputs(case)?;
        let question = |text: &String| {
            let problem = |problem| Unanswered::Question { text: text.trim().to_owned(), problem };
            Question::read(text, &outputs).map_err(problem)
        };
        let questions = self.above.iter().map(question).collect::<Result<Vec<Question>, Unanswered>>()?;
        let Self { particles, seed, prior, .. } = *self;
        let pieces = if self.pieces { PieceDetail::Apart } else { PieceDetail::Compared };
        let plan = EstimatePlan { particles, seed, prior, pieces };
        let estimated = analysis::estimate(case, &plan, &mut of_estimate(progress))?;
        Ok(EstimateAnswer { estimated, asked: Asked { plan, questions } })
    }
}
