//! Settings of a run.

use uncertainty::Instructions;

use crate::error::NoDraws;
use crate::limits::{LEAST_ISLANDS, MOST_ISLANDS, MOST_PARTICLES, PARTICLES_STEP};
use crate::model::Selection;

/// Number of islands of [`ParticleSettings::new`], equal to the number of replicates in `uncertainty`.
pub const ISLANDS: usize = 16;

/// Settings of the sampler.
#[derive(Clone, Debug)]
pub struct ParticleSettings {
    /// Number of particles of each island, a multiple of [`PARTICLES_STEP`].
    pub particles: usize,
    /// Number of islands, from [`LEAST_ISLANDS`] to [`MOST_ISLANDS`], which are independent populations.
    /// Together they give `islands` × `particles` draws.
    pub islands: usize,
    /// The random seed: the same seed gives the same results.
    pub seed: u64,
    /// The pieces of evidence that are used.
    pub terms: Selection,
    /// The instruction set, which does not change the results.
    pub instructions: Instructions,
}

impl ParticleSettings {
    /// [`ISLANDS`] islands, all evidence, the best instruction set of this CPU.
    #[must_use]
    pub fn new(particles: usize, seed: u64) -> Self {
        let instructions = Instructions::best();
        Self { particles, islands: ISLANDS, seed, terms: Selection::All, instructions }
    }

    /// Whether an island can have this number of particles: a multiple of [`PARTICLES_STEP`] up to
    /// [`MOST_PARTICLES`].
    #[must_use]
    pub fn can_have(particles: usize) -> bool {
        (PARTICLES_STEP..=MOST_PARTICLES).contains(&particles) && particles.is_multiple_of(PARTICLES_STEP)
    }

    pub(crate) fn check(&self, terms: usize) -> Result<(), NoDraws> {
        let particles = self.particles;
        if !Self::can_have(particles) {
            return Err(NoDraws::Particles { particles });
        }
        if !(LEAST_ISLANDS..=MOST_ISLANDS).contains(&self.islands) {
            return Err(NoDraws::Islands { islands: self.islands });
        }
        match self.terms.named().iter().find(|&&term| term >= terms) {
            Some(&term) => Err(NoDraws::NoSuchTerm { term, terms }),
            None => Ok(()),
        }
    }
}
