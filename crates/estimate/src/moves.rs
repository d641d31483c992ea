//! Moves of particles that leave a tempered posterior invariant.
//!
//! A population is dealt into two halves, and each half moves according to the other, which is kept fixed, so
//! that a move never depends on the other moving particles.
//!
//! # References
//!
//! S. L. Cotter, G. O. Roberts, A. M. Stuart and D. White, *MCMC methods for functions: modifying old
//! algorithms to make them faster*, Statistical Science 28 (2013): moves that are reversible for a normal
//! distribution. C. J. F. ter Braak, *A Markov chain Monte Carlo version of the genetic algorithm
//! differential evolution*, Statistics and Computing 16 (2006). D. Foreman-Mackey, D. W. Hogg, D. Lang and J.
//! Goodman, *emcee: the MCMC hammer*, PASP 125 (2013): the halves.

use real::elementary::exp;
use uncertainty::normal::box_muller;
use uncertainty::random::{bits, key, unit};
use uncertainty::{LANES, Lanes};

use crate::gaussian::Gaussian;

/// A kind of move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Towards a draw of the normal distribution of the other half, which the move leaves invariant; with a
    /// scale of 1 it is such a draw.
    Reference,
    /// Along the difference of two particles of the other half; occasionally by the whole difference, which
    /// leads from mode to mode.
    Difference,
    /// The same in a subset of the coordinates.
    Subset,
}

/// All kinds.
pub(crate) const KINDS: [Kind; 3] = [Kind::Reference, Kind::Difference, Kind::Subset];

/// Recent performance of a kind of move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tuning {
    ln_scale: f64,
    /// Recent mean squared distance over all particles, each coordinate relative to its variance: the worth
    /// of a move.
    gain: f64,
    /// (–) recent acceptance rate.
    pub(crate) acceptance: f64,
}

impl Tuning {
    pub(crate) fn new() -> Self {
        Self { ln_scale: 0.0, gain: 1.0, acceptance: 1.0 }
    }

    pub(crate) fn scale(&self) -> f64 {
        exp(self.ln_scale)
    }

    /// Lengthens the moves if more are accepted than is optimal, and shortens them if fewer.
    pub(crate) fn learn(&mut self, kind: Kind, accepted: f64, gain: f64) {
        /// (–) weight of the last move in the averages.
        const MEMORY: f64 = 0.3;
        /// ln 1e-4: shorter moves are useless.
        const LEAST: f64 = -9.2;
        // Near the optimal acceptance rate of a random walk: 0.23 in many dimensions, 0.44 in one.
        let (best, most) = if kind == Kind::Reference { (0.3, 0.0) } else { (0.25, 1.0) };
        self.ln_scale = (self.ln_scale + (accepted - best)).clamp(LEAST, most);
        self.gain += MEMORY * (gain - self.gain);
        self.acceptance += MEMORY * (accepted - self.acceptance);
    }
}

/// The kind to try next, for a uniform number in (0, 1): in proportion to its worth, with a least share each.
pub(crate) fn choose(tunings: &[Tuning; KINDS.len()], share: f64) -> usize {
    /// (–) fraction of the mean worth added to each.
    const FLOOR: f64 = 0.2;
    let total: f64 = tunings.iter().map(|tuning| tuning.gain).sum();
    let floor = FLOOR * total / KINDS.len() as f64;
    let mut left = share * (total + floor * KINDS.len() as f64);
    for (place, tuning) in tunings.iter().enumerate() {
        left -= tuning.gain + floor;
        if left < 0.0 {
            return place;
        }
    }
    KINDS.len() - 1
}

/// Independent standard normal numbers, a column for each coordinate, for particles from `first` on.
#[inline(always)]
pub(crate) fn normals(sequence: u64, first: u64, columns: &mut [Lanes]) {
    for (coordinate, column) in (0..).zip(columns) {
        let key = key(sequence, &[coordinate]);
        for (lane, number) in (first..).zip(column.iter_mut()) {
            *number = unit(bits(key, lane));
        }
        box_muller(column);
    }
}

/// A proposal for each particle of a block.
pub(crate) struct Proposal {
    pub(crate) standard: Vec<Lanes>,
    /// ln of the ratio of the prior densities times that of the proposal densities back and forth.
    pub(crate) log_ratio: Lanes,
    noise: Vec<Lanes>,
    whitened: Vec<Lanes>,
}

impl Proposal {
    pub(crate) fn new(dimensions: usize) -> Self {
        let columns = || vec![Lanes::ZERO; dimensions];
        Self { standard: columns(), log_ratio: Lanes::ZERO, noise: columns(), whitened: columns() }
    }

    /// Proposes from the normal distribution N(m, L Lᵀ) of the other half.
    #[inline(always)]
    pub(crate) fn by_reference(
        &mut self,
        from: &[Lanes],
        reference: &Gaussian,
        scale: f64,
        sequence: u64,
        first: u64,
    ) {
        normals(sequence, first, &mut self.noise);
        reference.standardise(from, &mut self.whitened);
        // y′ = √(1 − b²) y + b ξ
        let kept = ((1.0 - scale) * (1.0 + scale)).sqrt();
        self.log_ratio = Lanes::ZERO;
        for (whitened, noise) in self.whitened.iter_mut().zip(&self.noise) {
            for ((number, noise), ratio) in whitened.iter_mut().zip(noise).zip(&mut self.log_ratio) {
                let moved = kept * *number + scale * noise;
                // ln N(y) − ln N(y′) = ½(y′² − y²)
                *ratio += 0.5 * (moved * moved - *number * *number);
                *number = moved;
            }
        }
        reference.spread(&self.whitened, &mut self.standard);
        self.add_prior(from);
    }

    /// z′ = z + γ(z_a − z_b) with two particles of the other half.
    #[inline(always)]
    pub(crate) fn by_difference(
        &mut self,
        from: &[Lanes],
        others: &[&[Lanes]],
        scale: f64,
        kind: Kind,
        sequence: u64,
        first: u64,
    ) {
        /// (–) fraction of the moves by the whole difference.
        const WHOLE: f64 = 0.1;
        /// (–) probability that a coordinate moves in a subset.
        const CHANCE: f64 = 0.3;
        let count = others.len() * LANES;
        let is_subset = kind == Kind::Subset;
        let moved = from.len() as f64 * if is_subset { CHANCE } else { 1.0 };
        // γ = 2.38/√(2d) is optimal for a normal distribution (ter Braak 2006).
        let best = 2.38 / (2.0 * moved.max(1.0)).sqrt();
        let [pairs, lengths] = [0, 1].map(|purpose| key(sequence, &[u64::MAX, purpose]));
        let mut partners = [[(0, 0); 2]; LANES];
        let mut lengths_of = Lanes::ZERO;
        for ((lane, partners), length) in (first..).zip(&mut partners).zip(&mut lengths_of) {
            let [a, b] = two_of(bits(pairs, lane), count);
            let place = |index: usize| (index / LANES, index % LANES);
            *partners = [place(a), place(b)];
            let share = unit(bits(lengths, lane));
            // From a quarter of the length to one and a half times it.
            let within = 0.25 + 1.25 * (share - WHOLE) / (1.0 - WHOLE);
            *length = if share < WHOLE { 1.0 } else { best * scale * within };
        }
        for (coordinate, (target, column)) in self.standard.iter_mut().zip(from).enumerate() {
            let sequence = key(sequence, &[coordinate as u64]);
            let lanes = target.iter_mut().zip(column).zip(&partners).zip(&lengths_of);
            for ((((place, value), [a, b]), length), lane) in lanes.zip(first..) {
                let [near, far] = [a, b].map(|(block, lane)| others[*block][coordinate][*lane]);
                let is_moved = !is_subset || unit(bits(sequence, lane)) < CHANCE;
                *place = if is_moved { value + length * (near - far) } else { *value };
            }
        }
        self.log_ratio = Lanes::ZERO;
        self.add_prior(from);
    }

    /// + ln of the ratio of the prior densities, ½(z² − z′²).
    #[inline(always)]
    fn add_prior(&mut self, from: &[Lanes]) {
        for (moved, column) in self.standard.iter().zip(from) {
            for ((moved, value), ratio) in moved.iter().zip(column).zip(&mut self.log_ratio) {
                *ratio += 0.5 * (value * value - moved * moved);
            }
        }
    }
}

/// Two different numbers below `count`, from one random word.
#[expect(clippy::cast_possible_truncation, reason = "the high half of a product is below its second factor")]
fn two_of(word: u64, count: usize) -> [usize; 2] {
    let below = |word: u64, count: usize| ((u128::from(word) * count as u128) >> 64) as usize;
    let first = below(word, count);
    // Another word from the first.
    let second = below(bits(word, 0), count - 1);
    [first, second + usize::from(second >= first)]
}

#[cfg(test)]
mod tests {
    use super::{KINDS, Kind, Tuning, choose, two_of};
    use uncertainty::random::bits;

    #[test]
    fn two_different_particles_each_as_often() {
        let mut counts = [[0; 5]; 5];
        for index in 0..20_000 {
            let [a, b] = two_of(bits(3, index), 5);
            counts[a][b] += 1;
        }
        // 1000 are expected in each of 20 cells, ±4.5 standard deviations.
        for (a, row) in counts.iter().enumerate() {
            for (b, count) in row.iter().enumerate() {
                assert!(if a == b { *count == 0 } else { (860..1140).contains(count) }, "{a} {b} {count}");
            }
        }
    }

    #[test]
    fn what_is_worth_more_is_chosen_more_often() {
        let mut tunings = [Tuning::new(); KINDS.len()];
        for _ in 0..50 {
            tunings[0].learn(Kind::Reference, 0.9, 10.0);
            tunings[1].learn(Kind::Difference, 0.0, 0.0);
            tunings[2].learn(Kind::Subset, 0.25, 1.0);
        }
        assert_eq!(tunings[0].scale(), 1.0);
        assert!(tunings[1].scale() < 1.1e-4);
        let mut counts = [0; KINDS.len()];
        for index in 0..1000 {
            counts[choose(&tunings, (f64::from(index) + 0.5) / 1000.0)] += 1;
        }
        // The worths 10, 0 and 1, plus a fifth of their mean for each: 10.73, 0.73 and 1.73 of 13.2.
        assert_eq!(counts, [813, 56, 131]);
    }
}
