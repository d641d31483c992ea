//! The runs of the sampler behind an estimate: the answer, what was known before the evidence, and what each
//! piece of evidence adds.

use std::ops::ControlFlow;

use ::estimate::{
    MOST_PARTICLES, PARTICLES_STEP, ParticleSettings, Posterior, Selection, Verdict, sample, sample_without,
};
use ::uncertainty::Progress;
use evidence::{CollisionModel, Piece};

use super::impacts::CaseImpacts;
use super::pieces::{PieceFound, There, Wanted, found};
use super::{EstimatePlan, EstimateStage, PieceDetail, refused};
use crate::failure::Failure;

/// Maximum factor by which the particles are increased if a run does not converge: they are doubled twice.
const MOST_TIMES: usize = 4;
/// Minimum effective sample size with the default number of particles: below it, they are doubled as if the
/// run had not converged.
const WORTH: f64 = 1000.0;
/// Islands of a run for the median and interval of a piece, and of one from the prior for a piece that
/// contradicts the rest: few, so that the particles of each suffice to adapt moves in many dimensions.
const PIECE_ISLANDS: usize = 4;
const ANEW_ISLANDS: usize = 8;
/// Particles of these islands: the divisor of those of the answer, and the minimum.
const PIECE_SHARE: usize = 2;
const PIECE_LEAST: usize = 256;

type Model = CollisionModel<CaseImpacts>;

/// Receives the stage, the work done of it and its total, and may end the estimate.
pub(super) type Report<'a> = dyn FnMut(EstimateStage, usize, usize) -> ControlFlow<()> + Send + 'a;

/// The runs of one estimate: ending one of them ends all.
pub(super) struct Runs<'a> {
    model: &'a Model,
    plan: &'a EstimatePlan,
    report: &'a mut Report<'a>,
    is_ended: bool,
    /// Number of likelihoods computed.
    pub(super) evaluations: usize,
}

/// Whether a term is part of every run: the severity of such collisions, and certain limits.
fn is_always(piece: &Piece) -> bool {
    matches!(piece, Piece::Severity | Piece::Limits(_))
}

impl<'a> Runs<'a> {
    pub(super) fn new(model: &'a Model, plan: &'a EstimatePlan, report: &'a mut Report<'a>) -> Self {
        Self { model, plan, report, is_ended: false, evaluations: 0 }
    }

    /// By all evidence, with more particles if the first run does not suffice.
    pub(super) fn answer(&mut self) -> Result<Posterior, Failure> {
        let EstimatePlan { particles: first, seed, .. } = *self.plan;
        let most = first.saturating_mul(MOST_TIMES).min(MOST_PARTICLES);
        let mut particles = first;
        loop {
            let posterior = self.reported(EstimateStage::All, &ParticleSettings::new(particles, seed))?;
            let is_worth = first != EstimatePlan::PARTICLES || posterior.diagnosis().ess() >= WORTH;
            let is_enough = posterior.verdict() == Verdict::Converged && is_worth;
            if self.is_ended || is_enough || particles >= most {
                return Ok(posterior);
            }
            particles = (2 * particles).min(most);
        }
    }

    /// Before the evidence; `None` if the estimate was ended, or if the run did not converge.
    pub(super) fn before(&mut self) -> Result<Option<Posterior>, Failure> {
        if self.is_ended {
            return Ok(None);
        }
        let terms = Selection::Only(self.places(is_always));
        let settings =
            ParticleSettings { terms, ..ParticleSettings::new(self.plan.particles, self.plan.seed) };
        let before = self.reported(EstimateStage::Prior, &settings)?;
        Ok(Some(before).filter(|before| before.verdict() == Verdict::Converged))
    }

    /// What each piece of evidence adds.
    pub(super) fn pieces(&mut self, there: There<'_>) -> Vec<PieceFound> {
        let always = self.places(is_always);
        let judged = self.places(|piece| !is_always(piece));
        let mut pieces = Vec::with_capacity(judged.len());
        for (done, &term) in judged.iter().enumerate() {
            self.begin_piece(done, judged.len());
            let is_wanted = !self.is_ended && judged.len() > 1;
            let detail = if is_wanted { self.plan.pieces } else { PieceDetail::Weighed };
            let (impacts, piece) = (self.model.leads(), (term, self.model.pieces()[term]));
            let mut again = |wanted: Wanted| self.again(wanted, there.posterior);
            pieces.push(found(piece, impacts, there, &always, (detail, &mut again)));
        }
        pieces
    }

    fn begin_piece(&mut self, done: usize, judged: usize) {
        if !self.is_ended {
            self.is_ended = (self.report)(EstimateStage::Piece, done, judged).is_break();
        }
    }

    /// A run in addition to the answer; `None` if it fails.
    fn again(&mut self, wanted: Wanted, posterior: &Posterior) -> Option<Posterior> {
        let EstimatePlan { particles, seed, .. } = *self.plan;
        let beside = (particles / PIECE_SHARE).next_multiple_of(PARTICLES_STEP);
        let beside = beside.max(PIECE_LEAST).min(particles);
        let settings = ParticleSettings { islands: PIECE_ISLANDS, ..ParticleSettings::new(beside, seed) };
        match wanted {
            Wanted::Only(terms) => {
                self.quietly(&ParticleSettings { terms: Selection::Only(terms), ..settings })
            }
            Wanted::WithoutAnew(term) => {
                let terms = Selection::Without(vec![term]);
                self.quietly(&ParticleSettings { terms, islands: ANEW_ISLANDS, ..settings })
            }
            Wanted::Without(term) => {
                let without = sample_without(self.model, self.model, posterior, term, &settings).ok()?;
                self.evaluations += without.diagnosis().evaluations;
                Some(without)
            }
        }
    }

    /// A run that reports its progress.
    fn reported(&mut self, stage: EstimateStage, settings: &ParticleSettings) -> Result<Posterior, Failure> {
        let Self { model, report, is_ended, .. } = self;
        let mut progress = |done: usize, total: usize| {
            let flow = report(stage, done, total);
            *is_ended |= flow.is_break();
            flow
        };
        let posterior = run(model, settings, &mut progress, &mut self.evaluations);
        posterior.map_err(|failure| refused(failure, self.model.pieces()))
    }

    fn quietly(&mut self, settings: &ParticleSettings) -> Option<Posterior> {
        let mut progress = |_: usize, _: usize| ControlFlow::Continue(());
        run(self.model, settings, &mut progress, &mut self.evaluations).ok()
    }

    /// The terms of the pieces that are wanted.
    fn places(&self, is_wanted: impl Fn(&Piece) -> bool) -> Vec<usize> {
        let pieces = self.model.pieces().iter().enumerate();
        pieces.filter(|(_, piece)| is_wanted(piece)).map(|(place, _)| place).collect()
    }
}

/// Runs the sampler, and adds its likelihoods to `evaluations`.
fn run(
    model: &Model,
    settings: &ParticleSettings,
    progress: &mut Progress<'_>,
    evaluations: &mut usize,
) -> Result<Posterior, ::estimate::NoDraws> {
    let posterior = sample(model, model, settings, progress)?;
    *evaluations += posterior.diagnosis().evaluations;
    Ok(posterior)
}
