//! Both speeds, and all other results, from all the evidence of a case.

mod agreement;
mod block;
mod impacts;
mod notes;
mod observe;
mod outputs;
mod pieces;
mod posed;
mod runs;
mod setup;

use std::f64::consts::FRAC_PI_2;
use std::ops::ControlFlow;

use ::estimate::{Culprit, DrawnQuantity, DrawsSummary, NoDraws, Posterior, SamplerDoubt, Verdict, Weights};
use ::uncertainty::{Distribution, Estimate, InvalidDistribution};
use evidence::{CollisionModel, EnergyMethod, InjuryRisk, Observed, Piece, TestedClass};
use inputs::{Case, ImpactLaw, SeverityPrior, Unit, VehicleKind, table};
use pim_core::VehicleId;

use crate::aside;
use crate::excluded::{Impossible, key};
use crate::failure::Failure;
use crate::given::certain_limits;
use crate::output::Output;
use crate::quantities::{DELTA_V, DELTA_V_LONGITUDINAL, PDOF, SKID_SPEED};
use crate::uncertainty::NOISE;
use crate::warning::Warning;
pub use agreement::{Agreement, CONTRADICTS, DOUBTFUL};
use impacts::CaseImpacts;
pub use notes::{Unused, UnusedReason};
use pieces::There;
pub use pieces::{PieceFound, SameTwice};
use runs::Runs;
pub use setup::Assumed;
use setup::{Before, Setup};

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
    /// What to find for each piece of evidence.
    pub pieces: PieceDetail,
}

/// What is found for each piece of evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceDetail {
    /// How far it is off, if enough draws of the answer count for that.
    Weighed,
    /// How far it is off. If too few of the draws count, as for a piece that contradicts the rest, a run
    /// without it is made.
    Compared,
    /// The same, and the speeds by it alone and without it, which takes up to two runs for each piece.
    Apart,
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
    /// Whether the front of a vehicle met a fixed object: the errors of its energy are those of such
    /// collisions.
    pub is_at_object: bool,
    /// The class of real collisions on which the intervals of such estimates were tested; `None` if no such
    /// class was tested.
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
    /// The keys of the limits that count as certain, which no evidence outweighs.
    pub certain: Vec<String>,
    /// Data of the case that the estimate does not use.
    pub unused: Vec<Unused>,
    /// The warnings that need no answer, in the axes of the engine; [`Warning::seen`] converts them to those
    /// of the case.
    pub warnings: Vec<Warning>,
    /// The draws: a column for each of the unknown numbers, and one for each output.
    pub posterior: Posterior,
    /// The same before the evidence; `None` if that run did not converge.
    pub before: Option<Posterior>,
    /// Number of likelihoods computed, including those for the pieces and the prior.
    pub evaluations: usize,
}

/// Why all the evidence, weighed, gives no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoEstimate {
    /// The run has not converged.
    Unconverged,
    /// Even the nearest collisions miss the evidence with these keys.
    Contradicted(Vec<String>),
}

impl Estimated {
    /// Why it is no answer; `None` if the run has converged and the result agrees with all of the evidence.
    #[must_use]
    pub fn no_answer(&self) -> Option<NoEstimate> {
        if !self.doubts().is_empty() {
            return Some(NoEstimate::Unconverged);
        }
        (!self.missed.is_empty()).then(|| NoEstimate::Contradicted(self.missed.clone()))
    }

    /// Whether the damage is only an upper bound, because no vehicle has residual crush.
    #[must_use]
    pub fn is_bound(&self) -> bool {
        self.pieces.iter().any(|found| found.piece == Piece::NoResidualCrush)
    }
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
    /// The quantity and its vehicle.
    pub output: Output,
    /// Whether it is a speed that the case gives, with its range.
    pub is_given: bool,
    /// (SI) before the evidence; `None` if that run did not converge.
    pub prior: Option<DrawsSummary>,
    /// (SI) after it.
    pub posterior: DrawsSummary,
    /// (SI) after it, if somebody in either vehicle was also known to be seriously hurt; `None` if the prior
    /// is not that of the field, or if too few draws are so severe.
    pub if_injured: Option<DrawsSummary>,
    is_told: bool,
}

/// (–) if the 95 % interval after the evidence is wider than this share of the one before, and the median has
/// hardly moved, the evidence does not determine the result.
pub const TOLD_BELOW: f64 = 0.8;

impl EstimatedOutput {
    /// Whether the case gives it or the evidence determines it: its 95 % interval is at most
    /// [`TOLD_BELOW`] of the one before, or its median lies outside the interval that contained half of the
    /// probability before. The ΔV of both vehicles, whose ratio is that of the masses, are told together.
    #[must_use]
    pub fn is_told(&self) -> bool {
        self.is_told
    }

    fn tells(&self) -> bool {
        let Some(before) = &self.prior else { return true };
        let width = |summary: &DrawsSummary| {
            let [.., widest] = &summary.intervals;
            widest.high.value - widest.low.value
        };
        let [half, ..] = &before.intervals;
        let median = self.posterior.median.value;
        let has_moved = median < half.low.value || half.high.value < median;
        self.is_given || !self.varies() || has_moved || width(&self.posterior) <= TOLD_BELOW * width(before)
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
/// [`Failure`] if the case lacks something, or if a distribution is invalid.
pub fn estimate_outputs(case: &Case) -> Result<Vec<Output>, Failure> {
    Ok(setup::of(case, None)?.impacts.outputs)
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

    /// The result for an output.
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
    let Setup {
        prior,
        impacts,
        observed,
        unknown,
        default_errors,
        unused,
        stood: assumed,
        energies,
        hit,
        is_at_object,
        seeks_speed,
        warnings,
    } = setup::of(case, plan.prior)?;
    let model = CollisionModel::of(impacts, observed.clone());
    let impacts = model.leads();
    let mut runs = Runs::new(&model, plan, progress);
    let posterior = runs.answer()?;
    let before = runs.before()?;
    let there = There { posterior: &posterior, before: before.as_ref() };
    let mut pieces = runs.pieces(there);
    for found in &mut pieces {
        found.reversed |= has_other_sign(found, &observed, impacts, &posterior);
    }
    let evaluations = runs.evaluations;
    let is_field = prior == SeverityPrior::Field;
    let tested = match hit {
        _ if !is_field || !is_as_tested(case, energies) => None,
        Some(hit) => TestedClass::of(hit, energies, model.pieces()),
        None if is_at_object && seeks_speed => TestedClass::of_object(energies, model.pieces()),
        None => None,
    };
    let mut estimated = Estimated {
        prior,
        energies,
        is_at_object,
        tested,
        stood: VehicleId::ALL.map(|id| there.stood(id, assumed[id.index()], impacts)),
        default_errors,
        unknown: there.unknown(unknown, impacts),
        outputs: there.outputs(impacts, is_field),
        pieces,
        same_twice: pieces::same_twice(model.pieces()),
        missed: missed(&model, &posterior),
        certain: certain(&model),
        unused,
        warnings,
        evaluations,
        observed,
        posterior,
        before,
    };
    let below = aside::below_records(case, |id| {
        let [.., widest] = &estimated.output(DELTA_V.of_vehicle(id))?.posterior.intervals;
        Some(widest.high.value)
    });
    estimated.warnings.extend(below);
    let above = aside::above_records(case, |id| {
        let [.., widest] = &estimated.output(SKID_SPEED.of_vehicle(id))?.posterior.intervals;
        Some(widest.low.value)
    });
    estimated.warnings.extend(above);
    // A vehicle that was backing looks like one that was stationary, against the other evidence.
    let is_contradicted = !estimated.with_agreement(Agreement::Contradicts).is_empty();
    let stood = |id: VehicleId| estimated.stood[id.index()].is_some_and(|stood| stood.after.value >= 0.5);
    let backed =
        VehicleId::ALL.into_iter().filter(|id| is_contradicted && stood(*id) && !may_back(case, *id));
    let backed = backed.map(|vehicle| Warning::MayHaveBacked { vehicle, speed: None });
    estimated.warnings.extend(backed.collect::<Vec<_>>());
    let not_pushed: Vec<Warning> =
        VehicleId::ALL.into_iter().filter_map(|id| estimated.not_pushed(case, id)).collect();
    estimated.warnings.extend(not_pushed);
    Ok(estimated)
}

/// Whether all assumptions of a case are those with which estimates were tested: cars of the years of the
/// data, Brach's law, and no error, bias or prior of the analyst's own.
fn is_as_tested(case: &Case, energies: [Option<EnergyMethod>; 2]) -> bool {
    let given = case.estimate.unwrap_or_default();
    let is_default = given.crush_error.is_none()
        && given.crush_bias.is_none()
        && given.delta_v_median.is_none()
        && given.stood.is_none();
    let is_brach = case.impact.as_ref().is_none_or(|impact| matches!(impact.law, ImpactLaw::Brach { .. }));
    let is_car = |id: VehicleId| {
        let vehicle = &case.vehicles[id.index()];
        let is_of_years =
            energies[id.index()].is_none_or(|method| TestedClass::has_cars_of(method, vehicle.model_year));
        let is_car = vehicle.fixed || vehicle.kind.unwrap_or_default() == VehicleKind::Car;
        let recorder = vehicle.recorder.as_ref();
        let has_usual_errors = recorder
            .is_none_or(|recorder| recorder.delta_v_error.is_none() && recorder.direction_error.is_none());
        is_of_years && is_car && has_usual_errors
    };
    let is_of_evidence = |path: &str| path.ends_with(".crush.pdof") || path.contains(".after.");
    is_default
        && is_brach
        && VehicleId::ALL.into_iter().all(is_car)
        && !case.ranges.iter().any(|range| is_of_evidence(&range.path))
}

impl Estimated {
    /// Warns if no likely force pushes on the side of a vehicle that the case gives as damaged.
    fn not_pushed(&self, case: &Case, vehicle: VehicleId) -> Option<Warning> {
        let side = case.vehicles[vehicle.index()].damaged_side()?;
        let summary = &self.output(PDOF.of_vehicle(vehicle))?.posterior;
        let [.., widest] = &summary.intervals;
        let angles = [summary.median, widest.low, widest.high].map(|pdof| side.oblique_angle(pdof.value));
        let pushes = angles.into_iter().any(|angle| angle.abs() < FRAC_PI_2);
        (!pushes).then_some(Warning::SideNotPushed { vehicle, oblique_angle: angles[0] })
    }
}

/// Whether the case allows that a vehicle was backing.
pub(crate) fn may_back(case: &Case, id: VehicleId) -> bool {
    let vehicle = &case.vehicles[id.index()];
    let [least, _] = certain_limits(vehicle);
    vehicle.fixed || vehicle.motion.is_some() || least.is_some_and(|least| least < 0.0)
}

impl There<'_> {
    /// Whether a vehicle stood still, with the probability `assumed` (–) before; `None` if that is 0.
    fn stood(&self, id: VehicleId, assumed: f64, impacts: &CaseImpacts) -> Option<Stood> {
        let stands = |run: &Posterior| {
            let draws = impacts.speed(run, id)?;
            Some(run.draws().mean(|draw| if draws[draw] == 0.0 { 1.0 } else { 0.0 }))
        };
        let before = self.before.and_then(stands);
        (assumed > 0.0).then(|| Some(Stood { assumed, before, after: stands(self.posterior)? }))?
    }

    /// The results before and after the evidence. If the prior is that of the field, also those if somebody
    /// was seriously hurt.
    fn outputs(&self, impacts: &CaseImpacts, is_field: bool) -> Vec<EstimatedOutput> {
        let Self { posterior, before } = self;
        let injured = is_field.then(|| of_injured(impacts, posterior)).flatten();
        let outputs = impacts.outputs.iter().zip(posterior.outputs()).enumerate();
        let estimated = outputs.map(|(place, (output, draws))| EstimatedOutput {
            output: *output,
            is_given: impacts.is_given(*output),
            prior: before.map(|before| before.summary(DrawnQuantity::Output(place))),
            posterior: posterior.summary(DrawnQuantity::Output(place)),
            if_injured: injured.as_ref().map(|weights| posterior.weighted(weights).summary(draws)),
            is_told: false,
        });
        let mut estimated: Vec<EstimatedOutput> = estimated.collect();
        let tells_delta_v = estimated.iter().any(|found| found.output.is(&DELTA_V) && found.tells());
        for found in &mut estimated {
            found.is_told = found.tells() || (tells_delta_v && found.output.is(&DELTA_V));
        }
        estimated
    }

    /// The unknown numbers before and after the evidence.
    fn unknown(&self, numbers: Vec<Before>, impacts: &CaseImpacts) -> Vec<UnknownNumber> {
        let after = |place: usize, key: &str| {
            // The speed itself if its value also encodes whether the vehicle stood.
            let speed = VehicleId::ALL.into_iter().find(|id| key == format!("{}.speed", table(*id)));
            let output = speed.and_then(|id| impacts.speed_place(id));
            self.posterior.summary(output.map_or(DrawnQuantity::Value(place), DrawnQuantity::Output))
        };
        let numbers = numbers.into_iter().enumerate();
        let unknown = numbers.map(|(place, Before { key, unit, prior, moving, assumed })| UnknownNumber {
            posterior: after(place, &key),
            key,
            unit,
            prior: moving.unwrap_or(prior),
            assumed,
        });
        unknown.collect()
    }
}

/// The injury that somebody suffered in each collision of a population, if it was chosen for one.
#[must_use]
pub fn injury(prior: SeverityPrior) -> Option<InjuryRisk> {
    (prior == SeverityPrior::SeriousInjury).then_some(InjuryRisk::SERIOUS)
}

/// (–) an answer that misses a piece of evidence by more than this many of the piece's standard errors does
/// not agree with it: a normal error exceeds this once in 16,000.
pub const MISSED: f64 = 4.0;

/// The keys of the limits that count as certain.
fn certain(model: &CollisionModel<CaseImpacts>) -> Vec<String> {
    let limits = model.pieces().iter().filter(|piece| matches!(piece, Piece::Limits(_)));
    limits.map(|piece| key(*piece)).collect()
}

/// The keys of the evidence in use with a number that is off by more than [`MISSED`] errors in most draws: no
/// collision agrees with all of the evidence.
fn missed(model: &CollisionModel<CaseImpacts>, posterior: &Posterior) -> Vec<String> {
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
/// few of them are so severe.
fn of_injured(impacts: &CaseImpacts, posterior: &Posterior) -> Option<Weights> {
    let delta_v = VehicleId::ALL.map(|id| impacts.draws(posterior, DELTA_V.of_vehicle(id)));
    let risk = |draw: usize| {
        let delta_v = delta_v.map(|draws| draws.map_or(0.0, |draws| draws[draw]));
        InjuryRisk::SERIOUS.ln_in_either(delta_v)
    };
    let weights = Weights::smoothed(&(0..posterior.count()).map(risk).collect::<Vec<_>>());
    let suffice = weights.are_reliable() && posterior.worth(&weights) >= ::estimate::ESS_LIMIT;
    suffice.then_some(weights)
}

/// Whether a recorder's longitudinal ΔV has the opposite sign of all draws.
fn has_other_sign(
    found: &PieceFound,
    observed: &Observed,
    impacts: &CaseImpacts,
    posterior: &Posterior,
) -> bool {
    let Piece::RecordedDeltaV(id) = found.piece else { return false };
    let Some(part) = observed.vehicles[id.index()].recorder.longitudinal else { return false };
    let wanted = DELTA_V_LONGITUDINAL.of_vehicle(id);
    let median =
        impacts.place(wanted).map(|place| posterior.summary(DrawnQuantity::Output(place)).median.value);
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
