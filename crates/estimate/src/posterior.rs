//! Runs all islands, and combines their results.

use std::ops::{ControlFlow, Range};
use std::sync::{Mutex, PoisonError};

use real::elementary::{exp, ln};
use uncertainty::normal::shares;
use uncertainty::random::{bits, key, unit};
use uncertainty::{Estimate, LANES, Lanes, Progress, for_each};

use crate::circle::unrolled;
use crate::diagnosis::{Diagnosis, DrawnQuantity, Verdict, mixing, modes};
use crate::error::{CannotReweight, Exclusion, NoDraws};
use crate::island::{Island, Population, run, run_without};
use crate::model::{Evidence, Part, Prior};
use crate::reweight::Weights;
use crate::settings::ParticleSettings;
use crate::summary::{Draws, DrawsSummary};
use crate::target::Target;

/// Draws from the posterior with equal weights, and their diagnostics.
#[derive(Clone, Debug)]
pub struct Posterior {
    columns: Columns,
    islands: Vec<Range<usize>>,
    log_evidence: Estimate,
    diagnosis: Diagnosis,
    used: Vec<bool>,
    excludes: Vec<bool>,
    parts: Vec<Part>,
    /// (units of the errors) mean error of each part on a circle.
    means: Vec<Option<f64>>,
    /// The particles of each island, and its ln Z.
    populations: Vec<(Population, f64)>,
}

/// Columns of draws.
#[derive(Clone, Debug)]
struct Columns {
    values: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
    terms: Vec<Vec<f64>>,
    residuals: Vec<Vec<f64>>,
}

/// Comparison of a piece of evidence with the prediction of the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceCheck {
    /// (–) probability that a new observation of the piece, predicted by all other used evidence, lies below
    /// the actual one; for a piece of several parts, that of the part farthest out.
    pub below: Estimate,
    /// (–) two-sided probability of an observation at least as far out: 2 min(below, 1 − below). For a piece
    /// of k parts, k times that of the part farthest out (Bonferroni), at most 1.
    pub p_value: Estimate,
    /// (units of the error) mean of observed − predicted, for a piece on a circle.
    pub mean_on_circle: Option<f64>,
    /// The weights that remove the piece from the draws; `None` if they do not include it.
    pub weights: Option<Weights>,
}

impl PieceCheck {
    /// Whether the weights can be relied on. If not, run without the piece and check it again.
    #[must_use]
    pub fn is_reliable(&self) -> bool {
        self.weights.as_ref().is_none_or(Weights::are_reliable)
    }
}

/// Draws from the posterior.
///
/// `progress` receives the number of finished particles and of all particles before each temperature step of
/// an island, and may end the run.
///
/// # Errors
/// If the settings are invalid, a log-likelihood is NaN or +∞, the evidence excludes everything that the
/// prior allows, or `progress` ended the run.
pub fn sample<P: Prior, E: Evidence>(
    prior: &P,
    evidence: &E,
    settings: &ParticleSettings,
    progress: &mut Progress<'_>,
) -> Result<Posterior, NoDraws> {
    let terms = evidence.terms_count();
    settings.check(terms)?;
    if prior.values_count() == 0 {
        return Err(NoDraws::NothingUnknown);
    }
    let used = settings.terms.flags(terms);
    let target = Target { prior, evidence, used, faded: None, instructions: settings.instructions };
    let particles = settings.particles;
    let voyage = Mutex::new(Voyage { progress, temperatures: vec![0.0; settings.islands], is_ended: false });
    let islands = for_each(0..settings.islands, |index| {
        let goes_on = |temperature| {
            let mut voyage = voyage.lock().unwrap_or_else(PoisonError::into_inner);
            voyage.goes_on(index, temperature, particles)
        };
        let island = run(&target, particles, settings.seed, index as u64, goes_on)?;
        let mut voyage = voyage.lock().unwrap_or_else(PoisonError::into_inner);
        voyage.temperatures[index] = 1.0;
        Ok(island)
    });
    let islands: Vec<Option<Island>> = islands.into_iter().collect::<Result<_, NoDraws>>()?;
    let finished = islands.iter().flatten().count();
    let islands: Vec<Island> = islands.into_iter().flatten().collect();
    if finished < settings.islands {
        return Err(NoDraws::Ended { finished, islands: settings.islands });
    }
    combine(&target, settings, &islands)
}

/// Progress of the islands, and its receiver.
struct Voyage<'a, 'p> {
    progress: &'a mut Progress<'p>,
    /// (–) temperature of each island: 1 when it is finished.
    temperatures: Vec<f64>,
    is_ended: bool,
}

impl Voyage<'_, '_> {
    /// Reports the number of finished particles, counting others by their temperature, and returns whether to
    /// go on.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to all particles")]
    fn goes_on(&mut self, island: usize, temperature: f64, particles: usize) -> bool {
        self.temperatures[island] = temperature;
        let arrived = self.temperatures.iter().sum::<f64>() * particles as f64;
        let all = self.temperatures.len() * particles;
        self.is_ended = self.is_ended || (self.progress)(arrived as usize, all).is_break();
        !self.is_ended
    }
}

/// [`sample`] without progress.
///
/// # Errors
/// As [`sample`].
pub fn sample_quietly<P: Prior, E: Evidence>(
    prior: &P,
    evidence: &E,
    settings: &ParticleSettings,
) -> Result<Posterior, NoDraws> {
    sample(prior, evidence, settings, &mut |_, _| ControlFlow::Continue(()))
}

/// Draws from the posterior without a piece of evidence, starting from draws with it: the first
/// `settings.particles` of each of `settings.islands` islands of `with`, while the likelihood of the piece
/// fades. This takes fewer moves than starting from the prior.
///
/// `prior`, `evidence` and the used pieces must be those of `with`.
///
/// # Errors
/// Those of [`sample`], or if `with` has fewer islands or particles, or does not use the piece.
pub fn sample_without<P: Prior, E: Evidence>(
    prior: &P,
    evidence: &E,
    with: &Posterior,
    term: usize,
    settings: &ParticleSettings,
) -> Result<Posterior, NoDraws> {
    let terms = evidence.terms_count();
    settings.check(terms)?;
    if !with.used.get(term).is_some_and(|used| *used) {
        return Err(NoDraws::NoSuchTerm { term, terms });
    }
    if with.populations.len() < settings.islands {
        return Err(NoDraws::Islands { islands: settings.islands });
    }
    let particles = settings.particles;
    if with.populations.iter().any(|(population, _)| population.particles() < particles) {
        return Err(NoDraws::Particles { particles });
    }
    let used = with.used.clone();
    let mut target = Target { prior, evidence, used, faded: None, instructions: settings.instructions };
    let starts: Vec<(u64, &(Population, f64))> = (0..).zip(&with.populations[..settings.islands]).collect();
    let islands = for_each(&starts, |(index, (population, log))| {
        // Random numbers different from those of the run from which it starts.
        let key = key(settings.seed, &[u64::MAX - 1, term as u64, *index]);
        run_without(&target, term, (population, *log), particles, key)
    });
    let islands: Vec<Island> = islands.into_iter().collect::<Result<_, _>>()?;
    target.used[term] = false;
    combine(&target, settings, &islands)
}

fn combine<P: Prior, E: Evidence>(
    target: &Target<'_, P, E>,
    settings: &ParticleSettings,
    islands: &[Island],
) -> Result<Posterior, NoDraws> {
    let mut exclusion = Exclusion::new(target.used.len());
    for island in islands {
        exclusion.add(&island.exclusion);
    }
    let populations: Option<Vec<&Population>> =
        islands.iter().map(|island| island.population.as_ref()).collect();
    let Some(populations) = populations else { return Err(NoDraws::Impossible(exclusion)) };

    let described = for_each(&populations, |population| describe(target, population));
    let described: Vec<Vec<Described>> = described.into_iter().collect::<Result<_, _>>()?;
    let blocks: Vec<&Described> = described.iter().flatten().collect();
    let all = Columns::gather(&blocks, (0..blocks.len() * LANES).collect::<Vec<_>>().as_slice());

    let evidence = Together::of(islands);
    let share = unit(bits(key(settings.seed, &[u64::MAX]), 0));
    let picked = evidence.pick(settings.particles, share);
    let mut columns = Columns::gather(&blocks, &picked);
    let parts = target.evidence.parts();
    let mut means = vec![None; parts.len()];
    for (part, column) in columns.residuals.iter_mut().enumerate() {
        if let Some(turn) = parts[part].turn {
            means[part] = Some(unrolled(column, turn));
            for error in column {
                *error = target.evidence.score_on_circle(part, *error);
            }
        }
    }
    let mut ranges = Vec::new();
    let mut first = 0;
    for island in 1..=islands.len() {
        let end = picked.partition_point(|place| *place < island * settings.particles);
        ranges.push(first..end);
        first = end;
    }

    let lines: Vec<u64> = populations
        .iter()
        .zip(0_u64..)
        .flat_map(|(population, island)| {
            let of_block = move |block| population.lineage(block).map(|line| island << 32 | u64::from(line));
            (0..population.blocks()).flat_map(of_block)
        })
        .collect();
    let lines: Vec<u64> = picked.iter().map(|&place| lines[place]).collect();
    let quantities: Vec<DrawnQuantity> = (0..all.values.len())
        .map(DrawnQuantity::Value)
        .chain((0..all.outputs.len()).map(DrawnQuantity::Output))
        .collect();
    let judged = for_each(&quantities, |&quantity| {
        let mixing = mixing(quantity, all.column(quantity), settings.particles);
        (mixing, modes(quantity, columns.column(quantity), &lines))
    });
    let (mixing, modes): (Vec<_>, Vec<_>) = judged.into_iter().unzip();

    let greatest = |of: fn(&Island) -> f64| islands.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let least = |of: fn(&Island) -> f64| islands.iter().map(of).fold(f64::INFINITY, f64::min);
    let mut diagnosis = Diagnosis {
        mixing,
        evidence_sd: evidence.sd,
        modes: modes.into_iter().flatten().collect(),
        stages: islands.iter().map(|island| island.stages).max().unwrap_or_default(),
        evaluations: islands.iter().map(|island| island.evaluations).sum(),
        acceptance: least(|island| island.acceptance),
        unmoved: greatest(|island| island.memory.unmoved),
        memory: greatest(|island| island.memory.mean),
        prior_draws: [exclusion.drawn, exclusion.possible],
        temperature: least(|island| island.temperature),
        doubts: Vec::new(),
    };
    diagnosis.doubt(settings.particles * islands.len());
    let excludes = (0..target.used.len()).map(|term| islands.iter().any(|island| island.excludes[term]));
    Ok(Posterior {
        columns,
        islands: ranges,
        log_evidence: evidence.log,
        diagnosis,
        used: target.used.clone(),
        excludes: excludes.collect(),
        parts,
        means,
        populations: populations
            .iter()
            .zip(islands)
            .map(|(&all, of)| (all.clone(), of.log_evidence))
            .collect(),
    })
}

/// The combined evidence of the islands, and the weight of each.
struct Together {
    log: Estimate,
    /// (–) standard deviation of ln Z.
    sd: f64,
    /// (–) Z_i/Σ Z.
    shares: Vec<f64>,
}

impl Together {
    fn of(islands: &[Island]) -> Self {
        let count = islands.len() as f64;
        let logs: Vec<f64> = islands.iter().map(|island| island.log_evidence).collect();
        let best = logs.iter().fold(f64::NEG_INFINITY, |best, log| best.max(*log));
        let evidences: Vec<f64> = logs.iter().map(|log| exp(log - best)).collect();
        // The estimate of Z is unbiased, that of ln Z is not, so Z is averaged.
        let mean = evidences.iter().sum::<f64>() / count;
        let variance = |of: &[f64], mean: f64| {
            of.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0)
        };
        let error = (variance(&evidences, mean) / count).sqrt() / mean;
        let mean_log = logs.iter().sum::<f64>() / count;
        Self {
            log: Estimate { value: best + ln(mean), standard_error: Some(error) },
            sd: variance(&logs, mean_log).sqrt(),
            shares: evidences.iter().map(|evidence| evidence / (mean * count)).collect(),
        }
    }

    /// Systematic resampling of all particles, in order, with those of an island weighted by its evidence.
    fn pick(&self, particles: usize, share: f64) -> Vec<usize> {
        let islands = self.shares.len();
        let count = particles * islands;
        let mut picked = Vec::with_capacity(count);
        // Expected number of draws of each particle.
        let parts = self.shares.iter().map(|share| share * islands as f64);
        let mut reached = 0.0;
        for (island, part) in parts.enumerate() {
            for place in island * particles..(island + 1) * particles {
                reached += part;
                while picked.len() < count && picked.len() as f64 + share < reached {
                    picked.push(place);
                }
            }
        }
        while picked.len() < count {
            picked.push(count - 1);
        }
        picked
    }
}

/// The columns of a block of draws.
struct Described {
    values: Vec<Lanes>,
    outputs: Vec<Lanes>,
    terms: Vec<Lanes>,
    residuals: Vec<Lanes>,
}

fn describe<P: Prior, E: Evidence>(
    target: &Target<'_, P, E>,
    population: &Population,
) -> Result<Vec<Described>, NoDraws> {
    let mut evaluation = target.evaluation();
    let mut described = Vec::with_capacity(population.blocks());
    for block in 0..population.blocks() {
        target.evaluate(population.block(block), &mut evaluation)?;
        let mut outputs = vec![Lanes::ZERO; target.evidence.outputs_count()];
        let mut residuals = vec![Lanes::splat(f64::NAN); target.evidence.parts().len()];
        target.evidence.describe(&evaluation.values, &mut outputs, &mut residuals);
        for (output, column) in outputs.iter().enumerate() {
            if let Some(lane) = column.iter().position(|value| !value.is_finite()) {
                let values = evaluation.values.iter().map(|column| column[lane]).collect();
                return Err(NoDraws::NotFinite { output, value: column[lane], values });
            }
        }
        let (values, terms) = (evaluation.values.clone(), evaluation.terms.clone());
        described.push(Described { values, outputs, terms, residuals });
    }
    Ok(described)
}

impl Columns {
    fn gather(blocks: &[&Described], places: &[usize]) -> Self {
        let columns = |of: fn(&Described) -> &[Lanes]| {
            let count = blocks.first().map_or(0, |block| of(block).len());
            let column = |column: usize| {
                places.iter().map(|place| of(blocks[place / LANES])[column][place % LANES]).collect()
            };
            (0..count).map(column).collect()
        };
        Self {
            values: columns(|block| &block.values),
            outputs: columns(|block| &block.outputs),
            terms: columns(|block| &block.terms),
            residuals: columns(|block| &block.residuals),
        }
    }

    fn column(&self, quantity: DrawnQuantity) -> &[f64] {
        let (columns, place) = match quantity {
            DrawnQuantity::Value(place) => (&self.values, place),
            DrawnQuantity::Output(place) => (&self.outputs, place),
        };
        columns.get(place).map_or(&[], Vec::as_slice)
    }
}

impl Posterior {
    /// Number of draws.
    #[must_use]
    pub fn count(&self) -> usize {
        self.islands.last().map_or(0, |island| island.end)
    }

    /// (units of the values) the draws, a column for each unknown value.
    #[must_use]
    pub fn values(&self) -> &[Vec<f64>] {
        &self.columns.values
    }

    /// (units of the outputs) a column for each output.
    #[must_use]
    pub fn outputs(&self) -> &[Vec<f64>] {
        &self.columns.outputs
    }

    /// The log-likelihood of each piece of evidence, used or not, a column for each.
    #[must_use]
    pub fn terms(&self) -> &[Vec<f64>] {
        &self.columns.terms
    }

    /// The residual of each part of the evidence, NaN if it has none, a column for each.
    #[must_use]
    pub fn residuals(&self) -> &[Vec<f64>] {
        &self.columns.residuals
    }

    /// For each piece of evidence, whether it is used.
    #[must_use]
    pub fn used(&self) -> &[bool] {
        &self.used
    }

    /// ln Z, with Z the prior probability density of the used evidence.
    #[must_use]
    pub fn log_evidence(&self) -> Estimate {
        self.log_evidence
    }

    /// The diagnostics of the run.
    #[must_use]
    pub fn diagnosis(&self) -> &Diagnosis {
        &self.diagnosis
    }

    /// Whether the run has converged. If not, the draws are not an answer.
    #[must_use]
    pub fn verdict(&self) -> Verdict<'_> {
        self.diagnosis.verdict()
    }

    /// The draws, for statistics of any column.
    #[must_use]
    pub fn draws(&self) -> Draws<'_> {
        Draws::new(&self.islands, None)
    }

    /// The draws with other weights, one for each, for statistics of any column. With another number of
    /// weights, all statistics are NaN.
    #[must_use]
    pub fn weighted<'a>(&'a self, weights: &'a Weights) -> Draws<'a> {
        Draws::new(&self.islands, Some(&weights.weights))
    }

    /// Statistics of a value or an output; all NaN if it does not exist.
    #[must_use]
    pub fn summary(&self, quantity: DrawnQuantity) -> DrawsSummary {
        self.draws().summary(self.columns.column(quantity))
    }

    /// Weights that turn the draws into those of the posterior without some pieces of evidence. If they are
    /// not [reliable](Weights::are_reliable), run again with [`crate::Selection::Without`].
    ///
    /// # Errors
    /// If there is no such piece, or if it excludes values.
    pub fn without(&self, terms: &[usize]) -> Result<Weights, CannotReweight> {
        let mut logarithms = vec![0.0; self.count()];
        for &term in terms {
            let column = self.columns.terms.get(term);
            let column =
                column.ok_or(CannotReweight::NoSuchTerm { term, terms: self.columns.terms.len() })?;
            if !self.used[term] {
                continue;
            }
            if self.excludes[term] {
                return Err(CannotReweight::Excludes { term });
            }
            for (logarithm, term) in logarithms.iter_mut().zip(column) {
                *logarithm -= term;
            }
        }
        Ok(Weights::smoothed(&logarithms))
    }

    /// Weights that turn the draws into those of the posterior with another piece of evidence in addition to
    /// those used. If they are not [reliable](Weights::are_reliable), run again with it.
    ///
    /// # Errors
    /// If there is no such piece, or if it makes every draw impossible.
    pub fn with(&self, term: usize) -> Result<Weights, CannotReweight> {
        let terms = self.columns.terms.len();
        let column = self.columns.terms.get(term).ok_or(CannotReweight::NoSuchTerm { term, terms })?;
        if self.used[term] {
            return Ok(Weights::smoothed(&vec![0.0; self.count()]));
        }
        if column.iter().all(|term| *term == f64::NEG_INFINITY) {
            return Err(CannotReweight::Excludes { term });
        }
        Ok(Weights::smoothed(column))
    }

    /// Effective sample size of the draws with these weights: [`Draws::effective`] times the ratio of the
    /// effective sample size of the draws to their number.
    #[must_use]
    pub fn worth(&self, weights: &Weights) -> f64 {
        self.weighted(weights).effective() * self.diagnosis.ess() / self.count() as f64
    }

    /// Compares a piece of evidence with the prediction of the rest.
    ///
    /// # Errors
    /// If there is no such piece, it has no residual, or it excludes values.
    pub fn check(&self, term: usize) -> Result<PieceCheck, CannotReweight> {
        let weights = self.without(&[term])?;
        let weights = self.used[term].then_some(weights);
        let parts: Vec<&Vec<f64>> = self
            .parts
            .iter()
            .zip(&self.columns.residuals)
            .filter_map(|(part, column)| (part.term == term).then_some(column))
            .collect();
        if parts.is_empty() || parts.iter().any(|column| column.iter().any(|residual| residual.is_nan())) {
            return Err(CannotReweight::NoResidual { term });
        }
        let draws = weights.as_ref().map_or_else(|| self.draws(), |weights| self.weighted(weights));
        let share = |residual: f64| {
            let mut lane = [residual];
            shares(&mut lane);
            lane[0]
        };
        let of_part = |residuals: &Vec<f64>| {
            let below = draws.mean(|draw| share(residuals[draw]));
            // Computed separately, since 1 − Φ loses all digits far out.
            let above = draws.mean(|draw| share(-residuals[draw]));
            let least = if below.value < above.value { below } else { above };
            (below, least)
        };
        let tails = parts.iter().map(|residuals| of_part(residuals));
        let farthest = tails.min_by(|(_, a), (_, b)| a.value.total_cmp(&b.value));
        let Some((below, least)) = farthest else { return Err(CannotReweight::NoResidual { term }) };
        // p = min(1, 2k min(P(below), P(above)))
        let times = 2.0 * parts.len() as f64;
        let p_value = Estimate {
            value: (times * least.value).min(1.0),
            standard_error: least.standard_error.map(|error| times * error),
        };
        let mean_on_circle = self
            .parts
            .iter()
            .zip(&self.means)
            .find_map(|(part, mean)| mean.filter(|_| part.term == term && parts.len() == 1));
        Ok(PieceCheck { below, p_value, mean_on_circle, weights })
    }
}
