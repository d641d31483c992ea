//! Both speeds, and all other results, from all the evidence of a case.

mod block;
mod impacts;
mod notes;
mod observe;
mod outputs;
mod pieces;
mod posed;
mod setup;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use ::estimate::{
    Culprit, DrawsSummary, MOST_PARTICLES, NoDraws, PARTICLES_STEP, ParticleSettings, Posterior,
    SamplerDoubt, Selection, Verdict, Weights, sample, sample_without,
};
use ::uncertainty::{Distribution, Estimate, InvalidDistribution};
use evidence::{CollisionModel, EnergyMethod, InjuryRisk, Observed, Piece, TestedClass};
use inputs::{Case, SeverityPrior, Unit};
use pim_core::VehicleId;

use crate::excluded::{Impossible, key, table};
use crate::failure::Failure;
use crate::output::Output;
use crate::quantities::{DELTA_V, DELTA_V_LONGITUDINAL};
use crate::uncertainty::NOISE;
pub use notes::{Unused, UnusedReason};
use outputs::Told;
pub use pieces::{PieceFound, SameTwice};
pub use setup::Assumed;

/// The settings of an estimate.
#[derive(Clone, Copy, Debug)]
pub struct EstimatePlan {
    /// Number of particles of each of 16 islands. A run that does not converge is repeated with twice as
    /// many, and once more with four times as many; so is one with [`PARTICLES`](Self::PARTICLES) whose
    /// effective sample size is below 1,000.
    pub particles: usize,
    /// The random seed: the same seed gives the same results.
    pub seed: u64,
    /// Replaces the `prior` of the case.
    pub prior: Option<SeverityPrior>,
    /// Whether to judge each piece of evidence on its own and to find the answer without it, which takes a
    /// run for each.
    pub pieces: bool,
}

impl EstimatePlan {
    /// Default number of particles of an island.
    pub const PARTICLES: usize = 256;
}

/// The result of all the evidence.
#[derive(Debug)]
pub struct Estimated {
    /// The prior of the severity.
    pub prior: SeverityPrior,
    /// The observations, each with its error (SI).
    pub observed: Observed,
    /// How the crush energy of each vehicle was obtained, if it is evidence.
    pub energies: [Option<EnergyMethod>; 2],
    /// The class of real collisions on which intervals of such estimates were judged; `None` where nothing
    /// like it was.
    pub tested: Option<&'static TestedClass>,
    /// Whether each vehicle may have stood still, if its speed is unknown.
    pub stood: [Option<Stood>; 2],
    /// The keys of errors that the case does not give.
    pub default_errors: Vec<String>,
    /// The unknown numbers.
    pub unknown: Vec<UnknownNumber>,
    /// The results before and after the evidence.
    pub outputs: Vec<EstimatedOutput>,
    /// The pieces of evidence.
    pub pieces: Vec<PieceFound>,
    /// Pieces that count the same observation twice.
    pub same_twice: Vec<SameTwice>,
    /// The keys of the evidence that the answer itself misses by more than [`MISSED`] of its errors: no
    /// collision agrees with all of the evidence.
    pub missed: Vec<String>,
    /// Data of the case that the estimate does not use.
    pub unused: Vec<Unused>,
    /// The draws: a column for each of the unknown numbers, and one for each output.
    pub posterior: Posterior,
    /// The same before the evidence; `None` if that run did not converge.
    pub before: Option<Posterior>,
    /// Number of likelihoods computed, including those for the pieces and the prior.
    pub evaluations: usize,
}

/// The probability that a vehicle stood still.
#[derive(Clone, Copy, Debug)]
pub struct Stood {
    /// (–) as assumed, before taking account of which vehicles can collide at all.
    pub assumed: f64,
    /// (–) among the collisions that are possible before the evidence; `None` if that run did not converge.
    pub before: Option<Estimate>,
    /// (–) after it.
    pub after: Estimate,
}

/// An unknown number.
#[derive(Clone, Debug)]
pub struct UnknownNumber {
    /// Its key, or that of the number that it multiplies.
    pub key: String,
    /// The unit of the case; `None` for a plain number.
    pub unit: Option<&'static Unit>,
    /// Its distribution before the evidence, in that unit.
    pub prior: Distribution,
    /// The reason for that distribution, if the case does not give it.
    pub assumed: Option<Assumed>,
    /// The same after the evidence.
    pub posterior: DrawsSummary,
}

/// A result.
#[derive(Clone, Debug)]
pub struct EstimatedOutput {
    /// Which.
    pub output: Output,
    /// (SI) before the evidence; `None` where that run did not converge.
    pub prior: Option<DrawsSummary>,
    /// (SI) after it.
    pub posterior: DrawsSummary,
    /// (SI) after it, if it was known as well that somebody in either vehicle was seriously hurt; `None` if
    /// the prior is another one than that of the field, or too few draws lead there.
    pub if_injured: Option<DrawsSummary>,
}

/// (–) if the 95 % interval after the evidence is wider than this share of the one before, and the median has
/// hardly moved, the evidence does not determine the result.
pub const TOLD_BELOW: f64 = 0.8;

impl EstimatedOutput {
    /// Whether the evidence determines it: its 95 % interval is at most [`TOLD_BELOW`] of the one before, or
    /// its median lies outside the interval that contained half of the probability before.
    #[must_use]
    pub fn is_told(&self) -> bool {
        let Some(before) = &self.prior else { return true };
        let width = |summary: &DrawsSummary| {
            let [.., widest] = &summary.intervals;
            widest.high.value - widest.low.value
        };
        let [half, ..] = &before.intervals;
        let median = self.posterior.median.value;
        let has_moved = median < half.low.value || half.high.value < median;
        !self.varies() || has_moved || width(&self.posterior) <= TOLD_BELOW * width(before)
    }

    /// Whether its draws differ by more than rounding: not for a known speed, even with uncertain heading.
    #[must_use]
    pub fn varies(&self) -> bool {
        let DrawsSummary { median, intervals, .. } = &self.posterior;
        let [.., widest] = intervals;
        widest.high.value - widest.low.value > NOISE * median.value.abs()
    }
}

/// The results that [`estimate()`] gives for a case.
///
/// # Errors
/// [`Failure`] where the case lacks something, or where a distribution makes no sense.
pub fn estimate_outputs(case: &Case) -> Result<Vec<Output>, Failure> {
    let setup = setup::of(case, None)?;
    Ok(outputs::of(&setup.impacts))
}

/// The keys of the evidence that [`estimate()`] uses in a case.
///
/// # Errors
/// [`Failure`] if the case lacks something, or if a distribution is invalid.
pub fn estimate_evidence(case: &Case) -> Result<Vec<String>, Failure> {
    let setup = setup::of(case, None)?;
    let model = CollisionModel::of(setup.impacts, setup.observed);
    let pieces = model.pieces().iter().filter(|piece| **piece != Piece::Severity);
    Ok(pieces.map(|piece| key(*piece)).collect())
}

/// The stage that [`estimate()`] has reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EstimateStage {
    /// All evidence.
    All,
    /// Before the evidence.
    Prior,
    /// A piece of evidence on its own, or the rest without it.
    Piece,
}

impl Estimated {
    /// The doubts about the run. If there are any, the draws are not an answer.
    #[must_use]
    pub fn doubts(&self) -> &[SamplerDoubt] {
        match self.posterior.verdict() {
            Verdict::Converged => &[],
            Verdict::NotConverged(doubts) => doubts,
        }
    }

    /// The smallest effective sample size of all numbers.
    #[must_use]
    pub fn ess(&self) -> f64 {
        self.posterior.diagnosis().ess()
    }

    fn place(&self, output: Output) -> Option<usize> {
        self.outputs.iter().position(|found| found.output == output)
    }

    /// What it says of a result.
    #[must_use]
    pub fn output(&self, output: Output) -> Option<&EstimatedOutput> {
        self.outputs.get(self.place(output)?)
    }

    /// (SI) the draws of a result.
    #[must_use]
    pub fn draws(&self, output: Output) -> Option<&[f64]> {
        self.posterior.outputs().get(self.place(output)?).map(Vec::as_slice)
    }

    /// (SI) the draws of a result before the evidence.
    #[must_use]
    pub fn draws_before(&self, output: Output) -> Option<&[f64]> {
        self.before.as_ref()?.outputs().get(self.place(output)?).map(Vec::as_slice)
    }

    /// The probability that a result is above a limit (SI), with its error from sampling.
    #[must_use]
    pub fn probability_above(&self, output: Output, limit: f64) -> Option<Estimate> {
        Some(self.posterior.draws().probability_above(self.draws(output)?, limit))
    }
}

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

/// Estimates the results from the evidence of a case.
///
/// `progress` receives the stage, the work done of it and its total, and may end the run.
///
/// # Errors
/// [`Failure`] if the case lacks something, if a distribution is invalid, or if the evidence excludes every
/// collision.
pub fn estimate(
    case: &Case,
    plan: &EstimatePlan,
    progress: &mut (dyn FnMut(EstimateStage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Estimated, Failure> {
    let setup = setup::of(case, plan.prior)?;
    let (observed, default_errors, unused) = (setup.observed.clone(), setup.default_errors, setup.unused);
    let (assumed, energies, hit) = (setup.stood, setup.energies, setup.hit);
    let is_with_object = setup.is_with_object;
    let model = CollisionModel::of(setup.impacts, setup.observed);
    let told = Told::new(&model, case.axes, setup.reference);
    let evaluations = AtomicUsize::new(0);
    let run = |settings: ParticleSettings, report: &mut ::uncertainty::Progress<'_>| {
        let posterior = sample(&told, &told, &settings, report);
        if let Ok(posterior) = &posterior {
            evaluations.fetch_add(posterior.diagnosis().evaluations, Ordering::Relaxed);
        }
        posterior.map_err(|failure| refused(failure, model.pieces()))
    };

    // Ending one run ends all of them.
    let ended = AtomicBool::new(false);
    let mut progress = |stage: EstimateStage, done: usize, total: usize| {
        let flow = progress(stage, done, total);
        ended.fetch_or(flow.is_break(), Ordering::Relaxed);
        flow
    };
    let is_ended = || ended.load(Ordering::Relaxed);

    let mut particles = plan.particles;
    let most = plan.particles.saturating_mul(MOST_TIMES).min(MOST_PARTICLES);
    let posterior = loop {
        let settings = ParticleSettings::new(particles, plan.seed);
        let posterior = run(settings, &mut |done, total| progress(EstimateStage::All, done, total))?;
        let is_worth = plan.particles != EstimatePlan::PARTICLES || posterior.diagnosis().ess() >= WORTH;
        let is_enough = posterior.verdict() == Verdict::Converged && is_worth;
        if is_ended() || is_enough || particles >= most {
            break posterior;
        }
        particles = (2 * particles).min(most);
    };

    // Terms of every run: the severity of such collisions, and certain limits.
    let always = |piece: &Piece| matches!(piece, Piece::Severity | Piece::Limits(_));
    let places = |wanted: &dyn Fn(&Piece) -> bool| -> Vec<usize> {
        let pieces = model.pieces().iter().enumerate();
        pieces.filter(|(_, piece)| wanted(piece)).map(|(place, _)| place).collect()
    };
    let beside = (plan.particles / PIECE_SHARE).next_multiple_of(PARTICLES_STEP);
    let beside = beside.max(PIECE_LEAST).min(plan.particles);
    let mut before = || {
        let terms = Selection::Only(places(&always));
        let settings = ParticleSettings { terms, ..ParticleSettings::new(plan.particles, plan.seed) };
        run(settings, &mut |done, total| progress(EstimateStage::Prior, done, total))
    };
    let prior = if is_ended() { None } else { Some(before()?) };
    let prior = prior.filter(|prior| prior.verdict() == Verdict::Converged);

    let speed = |id: VehicleId| told.speed_place(id);
    let stands = |run: &Posterior, id: VehicleId| {
        let draws = run.outputs().get(speed(id)?)?;
        Some(run.draws().mean(|draw| if draws[draw] == 0.0 { 1.0 } else { 0.0 }))
    };
    let stood = VehicleId::ALL.map(|id| {
        let assumed = Some(assumed[id.index()]).filter(|assumed| *assumed > 0.0)?;
        let before = prior.as_ref().and_then(|prior| stands(prior, id));
        Some(Stood { assumed, before, after: stands(&posterior, id)? })
    });
    let injured = (setup.prior == SeverityPrior::Field).then(|| of_injured(&told, &posterior)).flatten();
    let outputs = told
        .outputs()
        .iter()
        .zip(posterior.outputs())
        .enumerate()
        .map(|(place, (output, draws))| EstimatedOutput {
            output: *output,
            prior: prior.as_ref().map(|prior| prior.summary(::estimate::DrawnQuantity::Output(place))),
            posterior: posterior.summary(::estimate::DrawnQuantity::Output(place)),
            if_injured: injured.as_ref().map(|weights| posterior.weighted(weights).summary(draws)),
        })
        .collect();
    let unknown = setup
        .unknown
        .into_iter()
        .enumerate()
        .map(|(place, unknown)| {
            // The speed itself if its value also encodes whether the vehicle stood.
            let speed = VehicleId::ALL.into_iter().find(|id| unknown.key == format!("{}.speed", table(*id)));
            let quantity = match speed.and_then(|id| told.speed_place(id)) {
                Some(output) => ::estimate::DrawnQuantity::Output(output),
                None => ::estimate::DrawnQuantity::Value(place),
            };
            UnknownNumber {
                key: unknown.key,
                unit: unknown.unit,
                prior: unknown.moving.unwrap_or(unknown.prior),
                assumed: unknown.assumed,
                posterior: posterior.summary(quantity),
            }
        })
        .collect();
    let judged: Vec<usize> = places(&|piece| !always(piece));
    let mut pieces = Vec::new();
    for (done, &term) in judged.iter().enumerate() {
        if !is_ended() {
            // The return value is stored by `progress`.
            let _ = progress(EstimateStage::Piece, done, judged.len());
        }
        let mut quietly = |_: usize, _: usize| ControlFlow::Continue(());
        let mut again = |wanted: pieces::Wanted| {
            let settings =
                ParticleSettings { islands: PIECE_ISLANDS, ..ParticleSettings::new(beside, plan.seed) };
            match wanted {
                pieces::Wanted::Only(terms) => {
                    run(ParticleSettings { terms: Selection::Only(terms), ..settings }, &mut quietly).ok()
                }
                pieces::Wanted::WithoutAnew(term) => {
                    let terms = Selection::Without(vec![term]);
                    run(ParticleSettings { terms, islands: ANEW_ISLANDS, ..settings }, &mut quietly).ok()
                }
                pieces::Wanted::Without(term) => {
                    let without = sample_without(&told, &told, &posterior, term, &settings).ok()?;
                    evaluations.fetch_add(without.diagnosis().evaluations, Ordering::Relaxed);
                    Some(without)
                }
            }
        };
        let again: Option<&mut pieces::Again<'_>> =
            if plan.pieces && !is_ended() && judged.len() > 1 { Some(&mut again) } else { None };
        let there = pieces::There { posterior: &posterior, before: prior.as_ref() };
        let mut found = pieces::found((term, model.pieces()[term]), &told, there, &places(&always), again);
        found.reversed |= has_other_sign(&found, &observed, &told, &posterior);
        pieces.push(found);
    }
    let same_twice = pieces::same_twice(model.pieces());
    let tested = match hit {
        _ if setup.prior != SeverityPrior::Field => None,
        Some(hit) => TestedClass::of(hit, energies, model.pieces()),
        None if is_with_object => TestedClass::of_object(energies, model.pieces()),
        None => None,
    };
    let missed = missed(&model, &posterior);
    Ok(Estimated {
        prior: setup.prior,
        observed,
        energies,
        tested,
        stood,
        default_errors,
        unknown,
        outputs,
        pieces,
        same_twice,
        missed,
        unused,
        posterior,
        before: prior,
        evaluations: evaluations.into_inner(),
    })
}

/// The injury that somebody suffered in each collision of a population, if it was chosen for one.
#[must_use]
pub fn injury(prior: SeverityPrior) -> Option<InjuryRisk> {
    (prior == SeverityPrior::SeriousInjury).then_some(InjuryRisk::SERIOUS)
}

/// (–) an answer that misses a piece of evidence by more than this many of its errors does not agree with it:
/// a normal error exceeds this once in 16,000.
pub const MISSED: f64 = 4.0;

/// The keys of the evidence in use with a number that is off by more than [`MISSED`] errors in most draws: no
/// collision agrees with all of the evidence.
fn missed(model: &CollisionModel<impacts::CaseImpacts>, posterior: &Posterior) -> Vec<String> {
    let mut keys = Vec::new();
    for (part, scores) in model.parts().iter().zip(posterior.residuals()) {
        // The score of an angle is its error itself, at most half a turn.
        if part.turn.is_some() || !posterior.used()[part.term] {
            continue;
        }
        let beyond = posterior.draws().mean(|draw| if scores[draw].abs() > MISSED { 1.0 } else { 0.0 });
        let key = key(model.pieces()[part.term]);
        if beyond.value > 0.5 && !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}

/// Weights that turn the draws into those of a collision in which somebody was seriously hurt; `None` if too
/// few of them lead there.
fn of_injured(told: &Told<'_>, posterior: &Posterior) -> Option<Weights> {
    let delta_v = VehicleId::ALL.map(|id| told.draws(posterior, DELTA_V.of_vehicle(id)));
    let risk = |draw: usize| {
        let delta_v = delta_v.map(|draws| draws.map_or(0.0, |draws| draws[draw]));
        InjuryRisk::SERIOUS.ln_in_either(delta_v)
    };
    let weights = Weights::smoothed(&(0..posterior.count()).map(risk).collect::<Vec<_>>());
    let suffice = weights.are_reliable() && posterior.worth(&weights) >= ::estimate::ESS_LIMIT;
    suffice.then_some(weights)
}

/// Whether a recorder's longitudinal ΔV has the opposite sign of all draws.
fn has_other_sign(found: &PieceFound, observed: &Observed, told: &Told<'_>, posterior: &Posterior) -> bool {
    let Piece::RecordedDeltaV(id) = found.piece else { return false };
    let Some(part) = observed.vehicles[id.index()].recorder.longitudinal else { return false };
    let wanted = DELTA_V_LONGITUDINAL.of_vehicle(id);
    let median = told
        .place(wanted)
        .map(|place| posterior.summary(::estimate::DrawnQuantity::Output(place)).median.value);
    median.is_some_and(|median| median * part.along < 0.0)
}

fn refused(failure: NoDraws, pieces: &[Piece]) -> Failure {
    let exclusion = match failure {
        NoDraws::Impossible(exclusion) => exclusion,
        NoDraws::NotALikelihood { term, .. } if term < pieces.len() => {
            return Failure::Unjudged { key: key(pieces[term]) };
        }
        other => return Failure::Estimate(other),
    };
    let piece = |place: usize| pieces.get(place).copied();
    let (culprits, together) = match exclusion.culprit() {
        Culprit::Term(term) => (vec![piece(term)], false),
        Culprit::Pair(one, two) => (vec![piece(one), piece(two)], false),
        Culprit::Together => (Vec::new(), true),
        _ => (Vec::new(), false),
    };
    let culprits = culprits.into_iter().flatten().collect();
    Failure::Excluded(Box::new(Impossible { culprits, together, exclusion }))
}

/// A fault of the case for an invalid distribution.
fn of_number(key: &str, result: Result<Distribution, InvalidDistribution>) -> Result<Distribution, Failure> {
    result.map_err(|error| {
        let kind = inputs::FaultKind::Refused { reason: error.to_string() };
        Failure::Case(inputs::Fault { key: key.to_owned(), kind, advice: None }.into())
    })
}

#[cfg(test)]
mod tests;
