//! One population of particles, led from the prior to the posterior.
//!
//! # References
//!
//! P. Del Moral, A. Doucet and A. Jasra, *Sequential Monte Carlo samplers*, JRSS B 68 (2006). R. M. Neal,
//! *Annealed importance sampling*, Statistics and Computing 11 (2001). Y. Zhou, A. M. Johansen and J. A. D.
//! Aston, *Toward automatic model comparison*, JCGS 25 (2016): temperatures by the conditional effective
//! sample size.

use real::elementary::{exp, ln};
use uncertainty::dispatch;
use uncertainty::random::{bits, key, unit};
use uncertainty::{LANES, Lanes};

use crate::error::{Exclusion, NoDraws};
use crate::gaussian::{Gaussian, product, sum};
use crate::model::{Evidence, Faded, Hurdle, Prior};
use crate::moves::{KINDS, Kind, Proposal, Tuning, choose, normals};
use crate::target::{Evaluation, Target, Wanted};

/// (–) conditional effective sample size kept by a temperature step, as a fraction of the particles.
const KEPT: f64 = 0.5;

/// Maximum number of draws from the prior per particle in search of possible ones.
const MOST_DRAWS: usize = 256;

/// Maximum number of temperature steps, more than any evidence needs.
const MOST_STAGES: usize = 1000;

/// Criterion for particles to have moved enough.
#[derive(Clone, Copy, Debug)]
struct Enough {
    /// Minimum and maximum number of rounds of moves.
    rounds: (usize, usize),
    /// (–) maximum correlation of a coordinate with its earlier value.
    correlation: f64,
}

/// Intermediate particles are moved further at the next temperature.
const ON_THE_WAY: Enough = Enough { rounds: (3, 60), correlation: 0.1 };

/// The final particles are the draws.
const AT_THE_END: Enough = Enough { rounds: (9, 240), correlation: 0.1 };

/// Number of rounds after which a mean correlation that has hardly fallen is assumed not to fall: modes do
/// not mix.
const PATIENCE: usize = 12;

/// Correlation of the particles with their earlier positions.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Memory {
    /// (–) greatest correlation of a coordinate with its earlier value.
    pub(crate) greatest: f64,
    /// (–) mean over the coordinates.
    pub(crate) mean: f64,
    /// (–) fraction of the particles that have not moved at all.
    pub(crate) unmoved: f64,
}

/// Particles with equal weights.
#[derive(Clone, Debug)]
pub(crate) struct Population {
    dimensions: usize,
    /// The columns of the first block, then of the second, and so on.
    standard: Vec<Lanes>,
    log_likelihood: Vec<Lanes>,
    /// For each particle the draw from which it descends, by resampling and by local moves.
    lineage: Vec<[u32; LANES]>,
}

impl Population {
    pub(crate) fn blocks(&self) -> usize {
        self.log_likelihood.len()
    }

    pub(crate) fn block(&self, block: usize) -> &[Lanes] {
        &self.standard[block * self.dimensions..][..self.dimensions]
    }

    pub(crate) fn lineage(&self, block: usize) -> &[u32; LANES] {
        &self.lineage[block]
    }

    pub(crate) fn particles(&self) -> usize {
        self.blocks() * LANES
    }

    /// The first `particles` particles, in whole blocks.
    fn first(&self, particles: usize) -> Self {
        let blocks = particles / LANES;
        Self {
            dimensions: self.dimensions,
            standard: self.standard[..blocks * self.dimensions].to_vec(),
            log_likelihood: self.log_likelihood[..blocks].to_vec(),
            lineage: self.lineage[..blocks].to_vec(),
        }
    }

    /// The lineage number of the next draw without an ancestor.
    fn newest(&self) -> u32 {
        let newest = self.lineage.iter().flatten().max();
        newest.map_or(0, |newest| newest.wrapping_add(1))
    }

    /// The blocks of one half, 0 or 1.
    fn half(&self, half: usize) -> Vec<&[Lanes]> {
        (half..self.blocks()).step_by(2).map(|block| self.block(block)).collect()
    }

    /// Mean and variance of each coordinate.
    fn variances(&self) -> Vec<f64> {
        let count = self.particles() as f64;
        let blocks = || (0..self.blocks()).map(|block| self.block(block));
        let of = |coordinate: usize| {
            let mean = blocks().map(|block| sum(&block[coordinate])).sum::<f64>() / count;
            let square = |block: &[Lanes]| {
                let deviations = block[coordinate].map(|value| value - mean);
                product(&deviations, &deviations)
            };
            blocks().map(square).sum::<f64>() / count
        };
        (0..self.dimensions).map(of).collect()
    }

    /// Correlation of the particles with those `before`.
    fn memory(&self, before: &Self, variances: &[f64]) -> Memory {
        let count = self.particles() as f64;
        let now = self.variances();
        let mut greatest: f64 = 0.0;
        let mut total = 0.0;
        for (coordinate, (first, second)) in variances.iter().zip(&now).enumerate() {
            let square = |block: usize| {
                let mut difference = self.block(block)[coordinate];
                for (value, old) in difference.iter_mut().zip(&before.block(block)[coordinate]) {
                    *value -= old;
                }
                product(&difference, &difference)
            };
            let squares: f64 = (0..self.blocks()).map(square).sum();
            // ρ = 1 − ⟨(z − z₀)²⟩/(σ² + σ₀²)
            let scale = first + second;
            let correlation = if scale > 0.0 { 1.0 - squares / count / scale } else { 1.0 };
            greatest = greatest.max(correlation);
            total += correlation;
        }
        let unmoved = (0..self.blocks()).map(|block| {
            let (now, before) = (self.block(block), before.block(block));
            (0..LANES).filter(|&lane| now.iter().zip(before).all(|(now, old)| now[lane] == old[lane])).count()
        });
        let unmoved = unmoved.sum::<usize>() as f64 / count;
        Memory { greatest, mean: total / variances.len() as f64, unmoved }
    }

    /// Systematic resampling with weights of mean 1. Particles i and i + 1 of the result go to different
    /// blocks, so that the copies of a particle are dealt to both halves.
    fn resample(&mut self, weights: &[Lanes], share: f64) {
        let old = self.clone();
        let blocks = self.blocks();
        let mut source = sources(weights, share, self.particles());
        for lane in 0..LANES {
            for block in 0..blocks {
                let (from, from_lane) = source.next().unwrap_or((blocks - 1, LANES - 1));
                for coordinate in 0..self.dimensions {
                    self.standard[block * self.dimensions + coordinate][lane] =
                        old.standard[from * self.dimensions + coordinate][from_lane];
                }
                self.log_likelihood[block][lane] = old.log_likelihood[from][from_lane];
                self.lineage[block][lane] = old.lineage[from][from_lane];
            }
        }
    }
}

/// The particles (block and lane) selected by systematic resampling: `count` of them, at (i + share)·W/count
/// along the cumulative weights with the sum W.
fn sources(weights: &[Lanes], share: f64, count: usize) -> impl Iterator<Item = (usize, usize)> {
    let total: f64 = weights.iter().map(|weights| sum(weights)).sum();
    let mut particles = (0..weights.len()).flat_map(|block| (0..LANES).map(move |lane| (block, lane)));
    let mut current = particles.next();
    let mut reached = current.map_or(0.0, |(block, lane)| weights[block][lane]);
    let weights: Vec<Lanes> = weights.to_vec();
    let mut last = current;
    (0..count).map_while(move |draw| {
        let place = (draw as f64 + share) * total / count as f64;
        while reached <= place
            && let Some(particle) = current
        {
            // If rounding leads past the end, take the last particle with a weight.
            if weights[particle.0][particle.1] > 0.0 {
                last = current;
            }
            current = particles.next();
            reached += current.map_or(0.0, |(block, lane)| weights[block][lane]);
        }
        current.or(last)
    })
}

/// The result of an island.
#[derive(Clone, Debug, Default)]
pub(crate) struct Island {
    /// `None` if no draw from the prior was possible.
    pub(crate) population: Option<Population>,
    pub(crate) log_evidence: f64,
    pub(crate) exclusion: Exclusion,
    /// For each piece of evidence, whether it excluded a particle.
    pub(crate) excludes: Vec<bool>,
    pub(crate) stages: usize,
    pub(crate) evaluations: usize,
    /// (–) final temperature: 1 unless it took too many steps.
    pub(crate) temperature: f64,
    /// (–) final acceptance rate of the kind of move that accepts most.
    pub(crate) acceptance: f64,
    pub(crate) memory: Memory,
}

/// Runs an island.
///
/// `goes_on` receives the temperature before each step; the result is `None` if it returns false.
pub(crate) fn run<P: Prior, E: Evidence>(
    target: &Target<'_, P, E>,
    particles: usize,
    seed: u64,
    index: u64,
    goes_on: impl Fn(f64) -> bool,
) -> Result<Option<Island>, NoDraws> {
    if !goes_on(0.0) {
        return Ok(None);
    }
    let mut traveller = Traveller::new(target, key(seed, &[index]));
    let population = traveller.draw_prior(particles)?;
    let mut island = Island { log_evidence: f64::NEG_INFINITY, ..Island::default() };
    if let Some(mut population) = population {
        // Z₀ = possible fraction of the prior
        let exclusion = &traveller.exclusion;
        island.log_evidence = ln(exclusion.possible as f64 / exclusion.drawn as f64);
        while island.temperature < 1.0 && island.stages < MOST_STAGES {
            if !goes_on(island.temperature) {
                return Ok(None);
            }
            let stage = island.stages as u64;
            let step = step_in_temperature(&population, 1.0 - island.temperature);
            island.temperature = if step.is_last { 1.0 } else { island.temperature + step.size };
            island.log_evidence += step.log_mean;
            population.resample(&step.weights, unit(bits(key(traveller.key, &[1]), stage)));
            let enough = if step.is_last { AT_THE_END } else { ON_THE_WAY };
            let sequence = key(traveller.key, &[2, stage]);
            island.memory = traveller.travel(&mut population, island.temperature, enough, sequence)?;
            island.stages += 1;
        }
        island.acceptance = traveller.acceptance();
        let possible = traveller.possible(&mut population)?;
        island.log_evidence += ln(possible);
        island.population = (possible > 0.0).then_some(population);
    }
    island.exclusion = traveller.exclusion;
    island.excludes = traveller.excludes;
    island.evaluations = traveller.evaluations;
    Ok(Some(island))
}

/// Leads the first `particles` of an island's population, drawn with all evidence of `target`, to the
/// posterior without one of its terms, while the likelihood of the term fades.
pub(crate) fn run_without<P: Prior, E: Evidence>(
    target: &Target<'_, P, E>,
    term: usize,
    from: (&Population, f64),
    particles: usize,
    key_of_island: u64,
) -> Result<Island, NoDraws> {
    let (start, log_evidence) = from;
    let mut population = start.first(particles);
    let Target { prior, evidence, used, faded: _, instructions } = target;
    let faded = Some(Faded { term, share: 1.0 });
    let mut target =
        Target { prior: *prior, evidence: *evidence, used: used.clone(), faded, instructions: *instructions };
    let mut island = Island {
        log_evidence,
        exclusion: Exclusion { drawn: particles, possible: particles, ..Exclusion::new(target.used.len()) },
        excludes: vec![false; target.used.len()],
        temperature: 1.0,
        ..Island::default()
    };
    let mut tunings = [Tuning::new(); KINDS.len()];
    let mut share = 1.0;
    while share > 0.0 {
        if island.stages >= MOST_STAGES {
            island.temperature = 1.0 - share;
            break;
        }
        let stage = island.stages as u64;
        // The log weights for removing the whole term: −l_k.
        let mut traveller = Traveller::new(&target, key_of_island);
        traveller.weigh_again(&mut population, |evaluation| evaluation.terms[term].map(|l| -l).into())?;
        let step = step_in_temperature(&population, share);
        share = if step.is_last { 0.0 } else { share - step.size };
        island.log_evidence += step.log_mean;
        population.resample(&step.weights, unit(bits(key(key_of_island, &[3]), stage)));
        target.faded = Some(Faded { term, share });
        target.used[term] = share > 0.0;
        let mut traveller = Traveller { tunings, ..Traveller::new(&target, key_of_island) };
        traveller.newest = start.newest();
        traveller.weigh_again(&mut population, |evaluation| evaluation.log_likelihood)?;
        let enough = if step.is_last { AT_THE_END } else { ON_THE_WAY };
        island.memory = traveller.travel(&mut population, 1.0, enough, key(key_of_island, &[4, stage]))?;
        tunings = traveller.tunings;
        island.acceptance = traveller.acceptance();
        island.evaluations += traveller.evaluations + 2 * particles;
        for (excludes, now) in island.excludes.iter_mut().zip(&traveller.excludes) {
            *excludes |= now;
        }
        island.stages += 1;
    }
    let possible = Traveller::new(&target, key_of_island).possible(&mut population)?;
    island.log_evidence += ln(possible);
    island.population = (possible > 0.0).then_some(population);
    Ok(island)
}

/// A step from one temperature to the next.
struct Step {
    size: f64,
    is_last: bool,
    /// Weights of mean 1.
    weights: Vec<Lanes>,
    /// ln of their mean before normalisation, which is added to the log evidence.
    log_mean: f64,
}

/// The longest step, up to `rest`, that keeps [`KEPT`] of the effective sample size.
fn step_in_temperature(population: &Population, rest: f64) -> Step {
    let best = population.log_likelihood.iter().flatten().fold(f64::NEG_INFINITY, |best, l| best.max(*l));
    let count = population.particles() as f64;
    // Σ w and Σ w², w = exp(δ (l − l_max))
    let sums = |size: f64| {
        let mut sums = [0.0, 0.0];
        for block in &population.log_likelihood {
            let weights = block.map(|l| exp(size * (l - best)));
            sums[0] += sum(&weights);
            sums[1] += product(&weights, &weights);
        }
        sums
    };
    // As the weights were equal before, the conditional effective sample size is (Σ w)²/Σ w².
    let is_kept = |size: f64| {
        let [first, second] = sums(size);
        first * first >= KEPT * count * second
    };
    let is_last = is_kept(rest);
    let mut size = rest;
    if !is_last {
        let (mut low, mut high) = (0.0, rest);
        // Bisection until the fraction of the particles is known to a tenth of a per cent. For a steep
        // likelihood the step may be tiny; then the search is over its exponent.
        for _ in 0..200 {
            let middle = if low > 0.0 { 0.5 * (low + high) } else { high * 0.125 };
            if is_kept(middle) {
                low = middle;
            } else {
                high = middle;
            }
            if high - low <= 1e-3 * low {
                break;
            }
        }
        // If even the smallest step keeps too little, the likelihood is almost a hard limit; some step must
        // be taken.
        size = if low > 0.0 { low } else { high };
    }
    let mean = sums(size)[0] / count;
    let weight = |l: f64| exp(size * (l - best)) / mean;
    let weights = population.log_likelihood.iter().map(|block| block.map(weight).into());
    Step { size, is_last, weights: weights.collect(), log_mean: ln(mean) + size * best }
}

/// What an island needs to move its particles.
struct Traveller<'a, 'b, P, E> {
    target: &'a Target<'b, P, E>,
    key: u64,
    evaluation: Evaluation,
    proposal: Proposal,
    tunings: [Tuning; KINDS.len()],
    exclusion: Exclusion,
    excludes: Vec<bool>,
    evaluations: usize,
    newest: u32,
    /// The distribution of each half, as of the last round that was a power of two.
    references: [Option<Gaussian>; 2],
}

impl<'a, 'b, P: Prior, E: Evidence> Traveller<'a, 'b, P, E> {
    fn new(target: &'a Target<'b, P, E>, key: u64) -> Self {
        let terms = target.used.len();
        Self {
            target,
            key,
            evaluation: target.evaluation(),
            proposal: Proposal::new(target.dimensions()),
            tunings: [Tuning::new(); KINDS.len()],
            exclusion: Exclusion::new(terms),
            excludes: vec![false; terms],
            evaluations: 0,
            newest: 0,
            references: [None, None],
        }
    }

    /// Draws possible particles from the prior; `None` if many draws give none.
    fn draw_prior(&mut self, particles: usize) -> Result<Option<Population>, NoDraws> {
        let dimensions = self.target.dimensions();
        let blocks = particles / LANES;
        let mut population = Population {
            dimensions,
            standard: vec![Lanes::ZERO; blocks * dimensions],
            log_likelihood: vec![Lanes::ZERO; blocks],
            lineage: vec![[0; LANES]; blocks],
        };
        let sequence = key(self.key, &[0]);
        let mut found = 0;
        let mut draws = vec![Lanes::ZERO; dimensions];
        for block in 0..(blocks * MOST_DRAWS) as u64 {
            if found >= particles {
                break;
            }
            normals(sequence, block * LANES as u64, &mut draws);
            self.target.evaluate_for(&draws, Wanted::Used, &mut self.evaluation)?;
            self.evaluations += LANES;
            self.count_draws();
            for lane in 0..LANES {
                let log_likelihood = self.evaluation.log_likelihood[lane];
                if log_likelihood == f64::NEG_INFINITY {
                    continue;
                }
                self.exclusion.possible += 1;
                if found < particles {
                    let (place, into) = (found / LANES, found % LANES);
                    for (coordinate, column) in draws.iter().enumerate() {
                        population.standard[place * dimensions + coordinate][into] = column[lane];
                    }
                    population.log_likelihood[place][into] = log_likelihood;
                    population.lineage[place][into] = self.newest;
                    self.newest += 1;
                    found += 1;
                }
            }
        }
        if found == 0 {
            return Ok(None);
        }
        // If there are too few, they are repeated; their lineage shows it.
        for index in found..particles {
            let (place, into) = (index / LANES, index % LANES);
            let (old, from) = (index % found / LANES, index % found % LANES);
            for coordinate in 0..dimensions {
                population.standard[place * dimensions + coordinate][into] =
                    population.standard[old * dimensions + coordinate][from];
            }
            population.log_likelihood[place][into] = population.log_likelihood[old][from];
            population.lineage[place][into] = population.lineage[old][from];
        }
        Ok(Some(population))
    }

    /// Re-evaluates the particles, and sets their log-likelihood to the given function of the evaluation.
    fn weigh_again(
        &mut self,
        population: &mut Population,
        of: impl Fn(&Evaluation) -> Lanes,
    ) -> Result<(), NoDraws> {
        for block in 0..population.blocks() {
            self.target.evaluate_for(population.block(block), Wanted::Used, &mut self.evaluation)?;
            population.log_likelihood[block] = of(&self.evaluation);
        }
        Ok(())
    }

    /// (–) acceptance rate of the kind of move that accepts most.
    fn acceptance(&self) -> f64 {
        self.tunings.iter().map(|tuning| tuning.acceptance).fold(0.0, f64::max)
    }

    /// Removes the particles that only the unused terms find impossible, and returns the remaining fraction.
    fn possible(&mut self, population: &mut Population) -> Result<f64, NoDraws> {
        if self.target.used.iter().all(|used| *used) {
            return Ok(1.0);
        }
        let mut weights = Vec::with_capacity(population.blocks());
        for block in 0..population.blocks() {
            self.target.evaluate(population.block(block), &mut self.evaluation)?;
            let is_possible = |reason: u8| if reason == 0 { 1.0 } else { 0.0 };
            weights.push(Lanes::from(self.evaluation.reasons.map(is_possible)));
        }
        let share = weights.iter().map(|weights| sum(weights)).sum::<f64>() / population.particles() as f64;
        if share > 0.0 && share < 1.0 {
            population.resample(&weights, 0.5);
        }
        Ok(share)
    }

    /// Counts the exclusions among this block of draws from the prior.
    fn count_draws(&mut self) {
        self.exclusion.drawn += LANES;
        for lane in 0..LANES {
            if self.evaluation.log_likelihood[lane] > f64::NEG_INFINITY {
                continue;
            }
            let reason = self.evaluation.reasons[lane];
            if reason != 0 {
                *self.exclusion.failures.entry(reason).or_default() += 1;
                continue;
            }
            for term in 0..self.target.used.len() {
                if !self.is_excluded_by(term, lane) {
                    continue;
                }
                self.excludes[term] = true;
                self.exclusion.by_term[term] += 1;
                for other in 0..term {
                    let both = self.is_excluded_by(other, lane);
                    self.exclusion.by_both[term][other] += usize::from(both);
                }
            }
        }
    }

    fn is_excluded_by(&self, term: usize, lane: usize) -> bool {
        self.target.used[term] && self.evaluation.terms[term][lane] == f64::NEG_INFINITY
    }

    /// Moves the particles until they no longer correlate with their earlier positions, or no progress is
    /// made.
    fn travel(
        &mut self,
        population: &mut Population,
        temperature: f64,
        enough: Enough,
        sequence: u64,
    ) -> Result<Memory, NoDraws> {
        let before = population.clone();
        let variances = population.variances();
        let mut means = Vec::new();
        let mut memory = Memory { greatest: 1.0, mean: 1.0, unmoved: 1.0 };
        for round in 0..enough.rounds.1 {
            let sequence = key(sequence, &[round as u64]);
            // The distribution of a half changes less and less, so it is refreshed ever more rarely.
            if round.count_ones() <= 1 {
                self.references = [None, None];
            }
            let place = choose(&self.tunings, unit(bits(sequence, 0)));
            self.round(population, temperature, &variances, place, sequence)?;
            if round + 1 < enough.rounds.0 {
                continue;
            }
            memory = population.memory(&before, &variances);
            let has_stopped = means.len() >= PATIENCE
                && means.get(means.len() - PATIENCE).is_some_and(|earlier| earlier - memory.mean < 0.02);
            means.push(memory.mean);
            // The correlation of independent particles is not zero but ±1/√N.
            let noise = 2.0 / (population.particles() as f64).sqrt();
            if memory.greatest < enough.correlation + noise || has_stopped {
                break;
            }
        }
        Ok(memory)
    }

    /// One move of each particle.
    fn round(
        &mut self,
        population: &mut Population,
        temperature: f64,
        variances: &[f64],
        place: usize,
        sequence: u64,
    ) -> Result<(), NoDraws> {
        let kind = KINDS[place];
        let scale = self.tunings[place].scale();
        let (mut accepted, mut gain) = (0.0, 0.0);
        let mut references = std::mem::take(&mut self.references);
        for half in 0..2 {
            let others = population.half(1 - half);
            let reference = if kind == Kind::Reference {
                let of_others = || Gaussian::of(&others, population.dimensions);
                Some(&*references[1 - half].get_or_insert_with(of_others))
            } else {
                None
            };
            let mut moved = Vec::with_capacity(population.blocks() / 2);
            for block in (half..population.blocks()).step_by(2) {
                let from = population.block(block);
                let first = (block * LANES) as u64;
                let moves = Moves { from, others: &others, reference, scale, kind, first };
                let (instructions, proposal) = (self.target.instructions, &mut self.proposal);
                dispatch!(instructions, propose(proposal, &moves, key(sequence, &[1])));
                let hurdle = Hurdle {
                    used: &self.target.used,
                    faded: self.target.faded,
                    temperature,
                    before: &population.log_likelihood[block],
                    log_ratio: &self.proposal.log_ratio,
                    log_share: &log_shares(key(sequence, &[2]), first),
                };
                let wanted = Wanted::Taken(&hurdle);
                self.target.evaluate_for(&self.proposal.standard, wanted, &mut self.evaluation)?;
                self.evaluations += LANES;
                let proposed = &self.evaluation.log_likelihood;
                let chosen: [bool; LANES] =
                    std::array::from_fn(|lane| hurdle.takes_sum(lane, proposed[lane]));
                self.note_exclusions();
                let mut after = from.to_vec();
                for ((after, proposed), variance) in
                    after.iter_mut().zip(&self.proposal.standard).zip(variances)
                {
                    let weight = if *variance > 0.0 { variance.recip() } else { 0.0 };
                    for ((value, proposed), chosen) in after.iter_mut().zip(proposed).zip(&chosen) {
                        let step = if *chosen { proposed - *value } else { 0.0 };
                        gain += step * step * weight;
                        *value = if *chosen { *proposed } else { *value };
                    }
                }
                moved.push((block, after, self.evaluation.log_likelihood, chosen));
            }
            for (block, standard, log_likelihood, chosen) in moved {
                let dimensions = population.dimensions;
                population.standard[block * dimensions..][..dimensions].copy_from_slice(&standard);
                for lane in 0..LANES {
                    if !chosen[lane] {
                        continue;
                    }
                    accepted += 1.0;
                    population.log_likelihood[block][lane] = log_likelihood[lane];
                    // An independent draw has no ancestor.
                    if kind == Kind::Reference && scale >= 1.0 {
                        population.lineage[block][lane] = self.newest;
                        self.newest = self.newest.wrapping_add(1);
                    }
                }
            }
        }
        self.references = references;
        let count = population.particles() as f64;
        let gain = gain / (count * population.dimensions as f64);
        self.tunings[place].learn(kind, accepted / count, gain);
        Ok(())
    }

    fn note_exclusions(&mut self) {
        for lane in 0..LANES {
            if self.evaluation.log_likelihood[lane] == f64::NEG_INFINITY && self.evaluation.reasons[lane] == 0
            {
                for term in 0..self.excludes.len() {
                    self.excludes[term] |= self.is_excluded_by(term, lane);
                }
            }
        }
    }
}

/// ln of a uniform number between 0 and 1 for each particle from `first` on.
fn log_shares(sequence: u64, first: u64) -> Lanes {
    let mut shares = Lanes::ZERO;
    for (share, lane) in shares.iter_mut().zip(first..) {
        *share = ln(unit(bits(sequence, lane)));
    }
    shares
}

/// The data for the moves of a block.
struct Moves<'a> {
    from: &'a [Lanes],
    others: &'a [&'a [Lanes]],
    reference: Option<&'a Gaussian>,
    scale: f64,
    kind: Kind,
    first: u64,
}

#[inline(always)]
fn propose(proposal: &mut Proposal, moves: &Moves<'_>, sequence: u64) {
    let Moves { from, others, reference, scale, kind, first } = moves;
    match reference {
        Some(reference) => proposal.by_reference(from, reference, *scale, sequence, *first),
        None => proposal.by_difference(from, others, *scale, *kind, sequence, *first),
    }
}

#[cfg(test)]
mod tests {
    use super::{Population, sources, step_in_temperature};
    use uncertainty::{LANES, Lanes};

    fn population(log_likelihood: Vec<Lanes>) -> Population {
        let blocks = log_likelihood.len();
        Population {
            dimensions: 1,
            standard: vec![Lanes::ZERO; blocks],
            log_likelihood,
            lineage: vec![[0; LANES]; blocks],
        }
    }

    /// A particle of weight w is taken ⌊w⌋ or ⌈w⌉ times.
    #[test]
    fn systematic_resampling_takes_each_as_often_as_it_weighs() {
        let raw = [0, 1]
            .map(|block| Lanes::from(std::array::from_fn(|lane| ((block * 64 + lane) * 37 % 11) as f64)));
        let total: f64 = raw.iter().flatten().sum();
        let weights = raw.map(|block| Lanes::from(block.map(|w| w * 128.0 / total)));
        for share in [1e-9, 0.25, 0.5, 1.0 - 1e-9] {
            let mut counts = [0.0; 128];
            for (block, lane) in sources(&weights, share, 128) {
                counts[block * 64 + lane] += 1.0;
            }
            assert_eq!(counts.iter().sum::<f64>(), 128.0);
            for (count, weight) in counts.iter().zip(weights.iter().flatten()) {
                assert!((count - weight).abs() < 1.0, "{weight} taken {count} times");
            }
        }
        // With equal weights each is taken once, in order.
        let all: Vec<_> = sources(&[Lanes::splat(1.0); 2], 0.5, 128).collect();
        assert!(all.iter().enumerate().all(|(i, place)| *place == (i / 64, i % 64)));
    }

    /// A quarter of the particles have the likelihood 1, the others almost none.
    #[test]
    fn a_step_keeps_half_of_the_sample_size() {
        let halves = Lanes::from(std::array::from_fn(|lane| if lane % 4 == 0 { 0.0 } else { -1e6 }));
        let step = step_in_temperature(&population(vec![halves; 2]), 1.0);
        assert!(!step.is_last);
        // w = exp(−1e6 δ): (¼ + ¾w)² = ½(¼ + ¾w²), so 3w² + 6w − 1 = 0.
        let w = 2.0 / 3.0_f64.sqrt() - 1.0;
        assert!((step.size * 1e6 / -real::elementary::ln(w) - 1.0).abs() < 2e-3, "{}", step.size);
        let mean = 0.25 + 0.75 * w;
        assert!((step.log_mean - real::elementary::ln(mean)).abs() < 2e-3);

        let step = step_in_temperature(&population(vec![Lanes::splat(-7.0); 2]), 0.75);
        assert!(step.is_last && step.size == 0.75);
        assert_eq!(step.weights, [Lanes::splat(1.0); 2]);
        assert_eq!(step.log_mean, -5.25);
    }
}
