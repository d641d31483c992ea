//! Convergence diagnosis: do the islands agree?
//!
//! # References
//!
//! A. Vehtari, A. Gelman, D. Simpson, B. Carpenter and P.-C. Bürkner, *Rank-normalization, folding, and
//! localization: an improved R̂ for assessing convergence of MCMC*, Bayesian Analysis 16 (2021).

use std::fmt;

use uncertainty::LANES;
use uncertainty::normal::quantiles;

/// Maximum R̂ of a converged run (Vehtari et al. 2021).
pub const R_HAT_LIMIT: f64 = 1.01;

/// Minimum effective sample size of a converged run (Vehtari et al. 2021).
pub const ESS_LIMIT: f64 = 400.0;

/// Minimum effective sample size of the extreme 1 % at either end, which would include a mode that only one
/// island has found.
pub const EXTREME_ESS_LIMIT: f64 = 200.0;

/// (–) maximum standard deviation of ln Z between islands: beyond it a few of them dominate the answer.
pub const EVIDENCE_LIMIT: f64 = 1.0;

/// Minimum effective number of ancestors of a mode: its share is then known to a third.
pub const ANCESTORS_LIMIT: f64 = 10.0;

/// (–) maximum fraction of particles without a move at the end.
pub const UNMOVED_LIMIT: f64 = 0.2;

/// (–) minimum number of possible draws from the prior, relative to the number that the islands need.
pub const POSSIBLE_LIMIT: f64 = 1.0;

/// A quantity of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnQuantity {
    /// An unknown value.
    Value(usize),
    /// An output of the evidence.
    Output(usize),
}

impl fmt::Display for DrawnQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(place) => write!(f, "value {place}"),
            Self::Output(place) => write!(f, "output {place}"),
        }
    }
}

/// One of several modes: a range of a quantity with fewer draws on either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// The quantity.
    pub quantity: DrawnQuantity,
    /// (unit of the quantity) its least draw.
    pub low: f64,
    /// (unit of the quantity) its greatest draw.
    pub high: f64,
    /// (–) fraction of the draws.
    pub share: f64,
    /// Effective number of draws from the prior from which these descend: 1/Σ s² with their shares s.
    pub ancestors: f64,
}

/// Mixing of one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixing {
    /// The quantity.
    pub quantity: DrawnQuantity,
    /// (–) R̂ of the ranks, or of the ranks of the distances from the median, whichever is greater.
    pub r_hat: f64,
    /// Effective sample size: the least of those for the ranks and for both 5 % tails.
    ///
    /// It follows from the spread between the islands and is itself uncertain: with 16 islands by a third, so
    /// that the least of many quantities is about half of the true value of each.
    pub ess: f64,
    /// Effective sample size of the extreme 1 % at either end, the lesser of both.
    pub extreme_ess: f64,
}

/// A reason not to call a run converged.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SamplerDoubt {
    /// Only part of the evidence was used.
    #[error("the evidence is so steep that only {temperature:.1e} of it was reached")]
    Unfinished {
        /// (–) temperature reached.
        temperature: f64,
    },
    /// The prior hardly ever agrees with the evidence.
    #[error(
        "only {possible} of {drawn} draws of the prior are possible, but {needed} are needed; say in the prior \
         what is impossible"
    )]
    HardlyPossible {
        /// Number of possible draws.
        possible: usize,
        /// Number of draws.
        drawn: usize,
        /// Number needed by all islands.
        needed: usize,
    },
    /// The islands give different evidence.
    #[error(
        "the log evidence differs between the islands by {sd:.2}, but may differ only by {EVIDENCE_LIMIT}; take more \
         particles"
    )]
    EvidenceSpread {
        /// (–) standard deviation of ln Z between the islands.
        sd: f64,
    },
    /// The islands give different answers.
    #[error(
        "the islands disagree on {quantity}: R̂ is {r_hat:.3}, but must not exceed {R_HAT_LIMIT}; take more particles"
    )]
    Disagreement {
        /// The quantity.
        quantity: DrawnQuantity,
        /// (–) R̂.
        r_hat: f64,
    },
    /// The effective sample size is too small.
    #[error(
        "{quantity} has an effective sample size of {ess:.0}, but needs {ESS_LIMIT}; take more particles"
    )]
    FewDraws {
        /// The quantity.
        quantity: DrawnQuantity,
        /// Effective sample size.
        ess: f64,
    },
    /// The islands disagree on the extremes of a quantity.
    #[error(
        "the greatest or least hundredth of {quantity} has an effective sample size of {ess:.0}, but needs \
         {EXTREME_ESS_LIMIT}, as when few particles have found a mode; take more particles"
    )]
    Extremes {
        /// The quantity.
        quantity: DrawnQuantity,
        /// Effective sample size.
        ess: f64,
    },
    /// A mode that few particles have found.
    #[error(
        "{:.1} % of the draws have {} from {} to {}, apart from the rest, and descend from only {:.1} \
         draws of the prior; take more particles",
        100.0 * .0.share, .0.quantity, .0.low, .0.high, .0.ancestors
    )]
    FewAncestors(Mode),
    /// Many particles that no move has changed.
    #[error("{:.0} % of the particles did not move at the end: hardly any move is accepted", 100.0 * .unmoved)]
    StoodStill {
        /// (–) fraction of the particles.
        unmoved: f64,
    },
}

/// Whether a run has converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict<'a> {
    /// All islands agree.
    Converged,
    /// The run did not converge, so its draws are not an answer; these are the reasons.
    NotConverged(&'a [SamplerDoubt]),
}

/// Diagnostics of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Mixing of each value, then of each output.
    pub mixing: Vec<Mixing>,
    /// (–) standard deviation of the log evidence between the islands.
    pub evidence_sd: f64,
    /// Modes: ranges of values and outputs separated by fewer draws.
    pub modes: Vec<Mode>,
    /// Maximum number of temperature steps of an island.
    pub stages: usize,
    /// Number of particles evaluated.
    pub evaluations: usize,
    /// (–) final acceptance rate of the kind of move that accepts most, the least of all islands.
    pub acceptance: f64,
    /// (–) fraction of the particles without a move at the end, the greatest of all islands.
    pub unmoved: f64,
    /// (–) mean correlation of the particles with their positions before the final moves, the greatest of all
    /// islands. It stays high if no move leads from mode to mode.
    pub memory: f64,
    /// Number of draws from the prior, and of possible ones.
    pub prior_draws: [usize; 2],
    /// (–) temperature reached.
    pub temperature: f64,
    pub(crate) doubts: Vec<SamplerDoubt>,
}

impl Diagnosis {
    /// The least effective sample size of all values and outputs.
    #[must_use]
    pub fn ess(&self) -> f64 {
        self.mixing.iter().map(|mixing| mixing.ess).fold(f64::INFINITY, f64::min)
    }

    /// Whether the run has converged.
    #[must_use]
    pub fn verdict(&self) -> Verdict<'_> {
        if self.doubts.is_empty() { Verdict::Converged } else { Verdict::NotConverged(&self.doubts) }
    }

    /// Lists the reasons for doubt; `needed` is the number of particles of all islands.
    pub(crate) fn doubt(&mut self, needed: usize) {
        let mut doubts = Vec::new();
        if self.temperature < 1.0 {
            doubts.push(SamplerDoubt::Unfinished { temperature: self.temperature });
        }
        let [drawn, possible] = self.prior_draws;
        if (possible as f64) < POSSIBLE_LIMIT * needed as f64 {
            doubts.push(SamplerDoubt::HardlyPossible { possible, drawn, needed });
        }
        if self.evidence_sd > EVIDENCE_LIMIT {
            doubts.push(SamplerDoubt::EvidenceSpread { sd: self.evidence_sd });
        }
        // One quantity represents all with the same problem.
        let worst = self.mixing.iter().max_by(|a, b| a.r_hat.total_cmp(&b.r_hat));
        if let Some(&Mixing { quantity, r_hat, .. }) = worst.filter(|worst| worst.r_hat > R_HAT_LIMIT) {
            doubts.push(SamplerDoubt::Disagreement { quantity, r_hat });
        }
        let worst = self.mixing.iter().min_by(|a, b| a.ess.total_cmp(&b.ess));
        if let Some(&Mixing { quantity, ess, .. }) = worst.filter(|worst| worst.ess < ESS_LIMIT) {
            doubts.push(SamplerDoubt::FewDraws { quantity, ess });
        }
        let worst = self.mixing.iter().min_by(|a, b| a.extreme_ess.total_cmp(&b.extreme_ess));
        if let Some(worst) = worst.filter(|worst| worst.extreme_ess < EXTREME_ESS_LIMIT) {
            doubts.push(SamplerDoubt::Extremes { quantity: worst.quantity, ess: worst.extreme_ess });
        }
        let worst = self.modes.iter().min_by(|a, b| a.ancestors.total_cmp(&b.ancestors));
        if let Some(mode) = worst.filter(|mode| mode.ancestors < ANCESTORS_LIMIT) {
            doubts.push(SamplerDoubt::FewAncestors(*mode));
        }
        if self.unmoved > UNMOVED_LIMIT {
            doubts.push(SamplerDoubt::StoodStill { unmoved: self.unmoved });
        }
        self.doubts = doubts;
    }
}

/// Agreement of the islands, of `particles` each, on a column.
pub(crate) fn mixing(quantity: DrawnQuantity, column: &[f64], particles: usize) -> Mixing {
    let count = column.len();
    let order = order(column);
    let median = column[order[count / 2]];
    let folded: Vec<f64> = column.iter().map(|value| (value - median).abs()).collect();
    let ranks = normal_scores(column, &order);
    let folded = normal_scores(&folded, &self::order(&folded));
    let [bulk, spread] = [&ranks, &folded].map(|scores| Agreement::of(scores, particles));
    let tail = |share: f64, below: bool| {
        let limit = column[order[place(share, count)]];
        let is_in = |value: &f64| if below { *value <= limit } else { *value >= limit };
        let indicators: Vec<f64> = column.iter().map(|value| if is_in(value) { 1.0 } else { 0.0 }).collect();
        Agreement::of(&indicators, particles).ess
    };
    let ess = bulk.ess.min(tail(0.05, true)).min(tail(0.95, false));
    let extreme_ess = tail(0.01, true).min(tail(0.99, false));
    Mixing { quantity, r_hat: bulk.r_hat.max(spread.r_hat), ess, extreme_ess }
}

/// The place of a quantile among `count` sorted values.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the count")]
fn place(share: f64, count: usize) -> usize {
    (share * count as f64) as usize
}

fn order(column: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..column.len()).collect();
    order.sort_by(|a, b| column[*a].total_cmp(&column[*b]));
    order
}

/// z = Φ⁻¹((r − 3/8)/(S + 1/4)), r the rank, the mean rank of equal values.
fn normal_scores(column: &[f64], order: &[usize]) -> Vec<f64> {
    let count = column.len() as f64;
    let groups = || order.chunk_by(|a, b| column[*a] == column[*b]);
    let mut first = 0.0;
    let shares = groups().map(|group| {
        // Ranks count from 1.
        let rank = first + 0.5 * (group.len() as f64 + 1.0);
        first += group.len() as f64;
        (rank - 0.375) / (count + 0.25)
    });
    let mut of_groups: Vec<f64> = shares.collect();
    let (blocks, rest) = of_groups.as_chunks_mut::<LANES>();
    blocks.iter_mut().for_each(quantiles);
    rest.as_chunks_mut::<1>().0.iter_mut().for_each(quantiles);
    let mut scores = vec![0.0; column.len()];
    for (group, score) in groups().zip(of_groups) {
        for &draw in group {
            scores[draw] = score;
        }
    }
    scores
}

/// The spread between islands compared with that of their draws.
struct Agreement {
    r_hat: f64,
    ess: f64,
}

impl Agreement {
    fn of(column: &[f64], particles: usize) -> Self {
        let count = particles as f64;
        let islands = column.len() as f64 / count;
        let moments = column.chunks(particles).map(|island| {
            let mean = island.iter().sum::<f64>() / count;
            let squares: f64 = island.iter().map(|value| (value - mean) * (value - mean)).sum();
            (mean, squares / (count - 1.0))
        });
        let moments: Vec<(f64, f64)> = moments.collect();
        // W, the mean variance of an island, and B/N, the variance of the means
        let within = moments.iter().map(|(_, variance)| variance).sum::<f64>() / islands;
        let mean = moments.iter().map(|(mean, _)| mean).sum::<f64>() / islands;
        let between = moments.iter().map(|(of, _)| (of - mean) * (of - mean)).sum::<f64>() / (islands - 1.0);
        if within == 0.0 {
            // The value is constant, or constant in each island.
            let agree = between == 0.0;
            return if agree {
                Self { r_hat: 1.0, ess: count * islands }
            } else {
                Self { r_hat: f64::INFINITY, ess: 0.0 }
            };
        }
        // R̂² = ((N − 1)/N W + B/N)/W
        let pooled = (count - 1.0) / count * within + between;
        let r_hat = (pooled / within).sqrt();
        // The variance of a mean of n independent draws is σ²/n.
        let ess = islands * (pooled / between).min(count);
        Self { r_hat, ess }
    }
}

/// The parts of a column separated by valleys of the density; empty without a valley. `lines` holds the draw
/// from the prior from which each draw descends.
///
/// For the valleys equal values count as one, since copies of a draw are not a mode.
pub(crate) fn modes(quantity: DrawnQuantity, column: &[f64], lines: &[u64]) -> Vec<Mode> {
    let order = order(column);
    let mut sorted: Vec<f64> = order.iter().map(|&draw| column[draw]).collect();
    sorted.dedup();
    let mut cuts = Vec::new();
    valleys(&sorted, &mut cuts);
    if cuts.is_empty() {
        return Vec::new();
    }
    cuts.push(f64::INFINITY);
    let mut rest = order.as_slice();
    let mut modes = Vec::new();
    for cut in cuts {
        let (draws, above) = rest.split_at(rest.partition_point(|&draw| column[draw] < cut));
        rest = above;
        let Some((first, last)) = draws.first().zip(draws.last()) else { continue };
        let mut lines: Vec<u64> = draws.iter().map(|&draw| lines[draw]).collect();
        lines.sort_unstable();
        let count = lines.len() as f64;
        let squares = lines.chunk_by(|a, b| a == b).map(|line| {
            let share = line.len() as f64 / count;
            share * share
        });
        let ancestors = squares.sum::<f64>().recip();
        let share = count / column.len() as f64;
        modes.push(Mode { quantity, low: column[*first], high: column[*last], share, ancestors });
    }
    modes
}

/// Values below which a part ends, in rising order: beyond the deepest valley, then recursively on either
/// side of it.
fn valleys(sorted: &[f64], cuts: &mut Vec<f64>) {
    /// Number of neighbours that give a density, and minimum ratio of the density of the lower peak to that
    /// of the valley: by chance the ratio of two among some hundred windows reaches half of that. The shorter
    /// window finds a mode of few draws, if it is well separated.
    const WINDOWS: [(usize, f64); 2] = [(32, 6.0), (8, 25.0)];
    let Some(end) = WINDOWS.iter().find_map(|&(window, ratio)| deepest_valley(sorted, window, ratio)) else {
        return;
    };
    valleys(&sorted[..end], cuts);
    cuts.push(sorted[end]);
    valleys(&sorted[end..], cuts);
}

/// The place of the first value beyond the deepest valley, if it is deeper than `ratio`.
fn deepest_valley(sorted: &[f64], window: usize, ratio: f64) -> Option<usize> {
    if sorted.len() < 3 * window {
        return None;
    }
    // The span of `window` neighbours, which is small where they are dense.
    let spans: Vec<f64> = sorted.windows(window).map(|window| window[window.len() - 1] - window[0]).collect();
    let least = |least: &mut f64, span: &f64| {
        *least = least.min(*span);
        Some(*least)
    };
    let left: Vec<f64> = spans.iter().scan(f64::INFINITY, least).collect();
    let mut right: Vec<f64> = spans.iter().rev().scan(f64::INFINITY, least).collect();
    right.reverse();
    let depth = |place: usize| spans[place] / left[place].max(right[place]);
    let place = (0..spans.len()).max_by(|a, b| depth(*a).total_cmp(&depth(*b)))?;
    if depth(place) < ratio {
        return None;
    }
    // Beyond the widest gap within the window.
    let gap = |place: usize| sorted[place + 1] - sorted[place];
    (place..place + window - 1).max_by(|a, b| gap(*a).total_cmp(&gap(*b))).map(|place| place + 1)
}

#[cfg(test)]
mod tests {
    use super::{DrawnQuantity, mixing, modes};
    use uncertainty::random::{bits, unit};

    fn shares(seed: u64, count: u64) -> Vec<f64> {
        (0..count).map(|index| unit(bits(seed, index))).collect()
    }

    fn normals(seed: u64, count: u64) -> Vec<f64> {
        let mut numbers = shares(seed, count);
        for number in &mut numbers {
            let mut lane = [*number];
            uncertainty::normal::quantiles(&mut lane);
            *number = lane[0];
        }
        numbers
    }

    #[test]
    fn islands_that_agree_have_all_their_draws() {
        let mixing = mixing(DrawnQuantity::Value(0), &normals(1, 4096), 256);
        assert!(mixing.r_hat < 1.005, "{mixing:?}");
        // 4096 draws, estimated three times with 15 degrees of freedom; the least counts.
        assert!(mixing.ess > 1300.0, "{mixing:?}");
    }

    #[test]
    fn islands_that_differ_are_seen_by_mean_and_by_spread() {
        let numbers = normals(2, 4096);
        let moved = |island: usize| if island == 3 { 0.6 } else { 0.0 };
        let column: Vec<f64> = (0..4096).map(|i| numbers[i] + moved(i / 256)).collect();
        let by_mean = mixing(DrawnQuantity::Value(0), &column, 256);
        // B/W = 0.6²·(1/16)(15/16)·16/15 = 0.0225
        assert!((1.009..1.02).contains(&by_mean.r_hat), "{by_mean:?}");
        let column: Vec<f64> = (0..4096).map(|i| numbers[i] * (1.0 + moved(i / 256))).collect();
        assert!(mixing(DrawnQuantity::Value(0), &column, 256).r_hat > 1.005);
        let constant = mixing(DrawnQuantity::Value(0), &[2.0; 4096], 256);
        assert_eq!((constant.r_hat, constant.ess), (1.0, 4096.0));
    }

    /// No seed shows a valley where there is none, and every mode is found.
    #[test]
    fn valleys_are_found_where_they_are() {
        let lines: Vec<u64> = (0..4096).map(|draw| draw % 7).collect();
        let cauchy = |u: f64| {
            let (sin, cos) = real::elementary::sin_cos(std::f64::consts::PI * (u - 0.5));
            sin / cos
        };
        for seed in 0..200 {
            for column in [
                shares(seed, 4096),
                normals(seed, 4096),
                shares(seed, 4096).into_iter().map(cauchy).collect(),
            ] {
                assert!(modes(DrawnQuantity::Value(0), &column, &lines).is_empty(), "{seed}");
            }
            let mut column = normals(seed, 4096);
            for value in column.iter_mut().step_by(33) {
                *value = 8.0 + 0.5 * *value;
            }
            let found = modes(DrawnQuantity::Value(0), &column, &lines);
            assert_eq!(found.len(), 2, "{seed}: {found:?}");
            // Every 33rd of 4096 is 125, from all seven lines equally.
            assert_eq!((found[1].share * 4096.0).round(), 125.0);
            assert!((found[1].ancestors - 7.0).abs() < 0.05, "{found:?}");

            // Ten draws in 4096, well separated.
            let mut column = normals(seed, 4096);
            for value in column.iter_mut().step_by(410) {
                *value = 8.0 + 0.05 * *value;
            }
            let found = modes(DrawnQuantity::Value(0), &column, &lines);
            assert_eq!(found.len(), 2, "{seed}: {found:?}");
            assert_eq!((found[1].share * 4096.0).round(), 10.0);
        }
    }
}
