//! Points in the unit cube, each from its index alone: a number between 0 and 1 for every input of every
//! sample.
//!
//! Samples are dealt in turn to [`REPLICATES`] point sets: sample j is point ⌊j/16⌋ of set j mod 16. Each set
//! is random, so the spread of a result between the sets gives its standard error. Any whole number of blocks
//! from the beginning has the same number of points from each set. Latin hypercube sets are independent of
//! each other. So are Sobol' sets, except for correlations between two inputs, which cancel among them.
//!
//! # References
//!
//! M. D. McKay, R. J. Beckman and W. J. Conover, *A comparison of three methods for selecting values of input
//! variables*, Technometrics 21 (1979): Latin hypercube sampling. A. B. Owen, *Randomly permuted (t,m,s)-nets
//! and (t,s)-sequences*, in Monte Carlo and Quasi-Monte Carlo Methods (1995): scrambling.

mod direction_numbers;
mod sobol;

use crate::error::InvalidRequest;
use crate::limits::{MAX_SAMPLES, MIN_SAMPLES, REPLICATES};
use crate::model::{LANES, Lanes};
use crate::random::{bits, bits_of_block, key, unit};
use sobol::Sobol;

pub use sobol::MAX_INPUTS as MAX_SOBOL_INPUTS;

/// The sampling method: how points are distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SamplingMethod {
    /// Independent points.
    MonteCarlo,
    /// In every replicate, each input is divided into as many equal strata as there are points, with exactly
    /// one point in each.
    LatinHypercube,
    /// Sobol' points with Owen's scrambling, except for the first digits, which are shifted. They work best
    /// if the number of samples is a power of two; otherwise some points of each replicate, and pairs of
    /// inputs, are less evenly spread.
    Sobol,
}

impl SamplingMethod {
    /// Each method with its name.
    pub const WORDS: [(&str, Self); 3] = [
        (Self::MonteCarlo.name(), Self::MonteCarlo),
        (Self::LatinHypercube.name(), Self::LatinHypercube),
        (Self::Sobol.name(), Self::Sobol),
    ];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::MonteCarlo => "monte-carlo",
            Self::LatinHypercube => "latin-hypercube",
            Self::Sobol => "sobol",
        }
    }
}

/// Points of one method, seed and number of inputs and samples.
#[derive(Clone, Debug)]
pub(crate) enum Points {
    MonteCarlo(Vec<u64>),
    LatinHypercube(Box<Counts>, Vec<Three>),
    Sobol(Vec<Sobol>),
}

impl Points {
    pub(crate) fn new(
        method: SamplingMethod,
        seed: u64,
        inputs: usize,
        samples: usize,
    ) -> Result<Self, InvalidRequest> {
        if inputs == 0 {
            return Err(InvalidRequest::NoInputs);
        }
        if samples < MIN_SAMPLES {
            return Err(InvalidRequest::Samples { samples });
        }
        if samples > MAX_SAMPLES {
            return Err(InvalidRequest::TooManySamples { samples });
        }
        let count = samples as u64;
        // The numbers 1 to 5 give the methods different sequences for one seed.
        let all = 0..inputs;
        Ok(match method {
            SamplingMethod::MonteCarlo => {
                Self::MonteCarlo(all.map(|input| key(seed, &[1, input as u64])).collect())
            }
            SamplingMethod::LatinHypercube => {
                let strata: Vec<_> = all.map(|input| Strata::new(key(seed, &[2, input as u64]))).collect();
                let threes = (0..).zip(strata.chunks(TOGETHER)).map(|(number, inputs)| Three {
                    inputs: inputs.to_vec(),
                    places: key(seed, &[5, number]),
                });
                Self::LatinHypercube(Box::new(Counts::of(count)), threes.collect())
            }
            SamplingMethod::Sobol if inputs > MAX_SOBOL_INPUTS => {
                return Err(InvalidRequest::TooManyInputs { inputs, limit: MAX_SOBOL_INPUTS });
            }
            SamplingMethod::Sobol => {
                let seeds: Vec<_> = all.map(|input| key(seed, &[3, input as u64])).collect();
                Self::Sobol(Sobol::all(&seeds, key(seed, &[4]), count / REPLICATES as u64))
            }
        })
    }

    /// The random sequence of each input, if all points are independent.
    #[inline(always)]
    pub(crate) fn sequences(&self) -> Option<&[u64]> {
        match self {
            Self::MonteCarlo(keys) => Some(keys),
            Self::LatinHypercube(..) | Self::Sobol(_) => None,
        }
    }

    /// The points of a block of samples, a column for each input. Lanes beyond the last sample hold arbitrary
    /// points.
    #[inline(always)]
    pub(crate) fn fill(&self, block: u64, columns: &mut [Lanes]) {
        let first = block * LANES as u64;
        match self {
            Self::MonteCarlo(keys) => {
                for (&key, column) in keys.iter().zip(columns) {
                    independent(key, first, column);
                }
            }
            Self::LatinHypercube(counts, threes) => {
                for (three, columns) in threes.iter().zip(columns.chunks_mut(TOGETHER)) {
                    three.fill(first, counts, columns);
                }
            }
            Self::Sobol(inputs) => {
                for (sobol, column) in inputs.iter().zip(columns) {
                    sobol.fill(first / REPLICATES as u64, column);
                }
            }
        }
    }
}

/// Uniform numbers of a random sequence, from the sample `first` on.
#[inline(always)]
pub(crate) fn independent(key: u64, first: u64, shares: &mut Lanes) {
    for (share, bits) in shares.iter_mut().zip(bits_of_block(key, first)) {
        *share = unit(bits);
    }
}

/// Points of each replicate in a block.
const POINTS: usize = LANES / REPLICATES;

/// A number for each lane of a block, the same for all lanes of a replicate: a flat array, so that each loop
/// over lanes is vectorised directly.
type Words = Lanes<u32>;

/// The index of each lane's point among those of its replicate in the block.
const ROWS: [u32; LANES] = {
    let mut rows = [0; LANES];
    let mut lane = REPLICATES;
    while lane < LANES {
        rows[lane] = rows[lane - REPLICATES] + 1;
        lane += 1;
    }
    rows
};

fn words(of_replicate: impl Fn(usize) -> u32) -> [u32; LANES] {
    std::array::from_fn(|lane| of_replicate(lane % REPLICATES))
}

/// Number of points in the replicate of each lane, and the constants of a permutation of that many strata.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts {
    counts: Words,
    masks: Words,
    shifts: Words,
    /// The width of a stratum, 1/n.
    widths: Lanes,
}

impl Counts {
    fn of(samples: u64) -> Self {
        // Points of replicate r: ⌈(N − r)/16⌉, at most 2²⁸.
        #[expect(clippy::cast_possible_truncation, reason = "a sixteenth of at most 2³²")]
        let counts = words(|replicate| (samples - replicate as u64).div_ceil(REPLICATES as u64) as u32);
        let size = counts.map(mask_and_shift);
        let (masks, shifts) = (size.map(|(mask, _)| mask), size.map(|(_, shift)| shift));
        let widths = counts.map(|count| 1.0 / f64::from(count)).into();
        Self { counts: counts.into(), masks: masks.into(), shifts: shifts.into(), widths }
    }
}

/// Number of inputs whose places within a stratum come from the same random bits.
const TOGETHER: usize = 3;

/// Latin hypercube points of up to three inputs.
#[derive(Clone, Debug)]
pub(crate) struct Three {
    inputs: Vec<Strata>,
    /// Key of the places of the points in their strata.
    places: u64,
}

impl Three {
    /// The points of a block that begins at the sample `first`.
    #[inline(always)]
    fn fill(&self, first: u64, of: &Counts, columns: &mut [Lanes]) {
        /// (bit) together with the number of a stratum, up to 28 bits, fewer than the 53 of an `f64`, so that
        /// their sum is exact.
        const PLACE_BITS: u32 = 20;
        const PLACES: f64 = (1_u64 << PLACE_BITS) as f64;
        #[expect(clippy::cast_possible_truncation, reason = "at most 2²⁸")]
        let index = (first / REPLICATES as u64) as u32;
        let mut words = Lanes::splat(0);
        for (word, bits) in words.iter_mut().zip(bits_of_block(self.places, first)) {
            *word = bits;
        }
        for (strata, shares) in self.inputs.iter().zip(columns) {
            let strata = strata.of_block(index, of);
            for lane in 0..LANES {
                let place = f64::from((words[lane] >> (64 - PLACE_BITS)) as u32);
                // u = (π(i) + (k + ½)·2⁻²⁰)/n, within its stratum for any rounding of the product
                let inside = (f64::from(strata[lane]) + (place + 0.5) / PLACES) * of.widths[lane];
                shares[lane] = if index + ROWS[lane] < of.counts[lane] { inside } else { 0.5 };
                // The next input takes the next bits.
                words[lane] <<= PLACE_BITS;
            }
        }
    }
}

/// Latin hypercube points of one input, without their places in the strata: the summands and factors of the
/// rounds of each replicate's permutation, each filling a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Strata {
    rounds: [[[u32; REPLICATES]; 2]; ROUNDS],
}

impl Strata {
    fn new(input: u64) -> Self {
        let permutations: [_; REPLICATES] =
            std::array::from_fn(|replicate| rounds(key(input, &[1, replicate as u64])));
        let rounds = std::array::from_fn(|round| {
            [0, 1].map(|word: usize| std::array::from_fn(|replicate| permutations[replicate][round][word]))
        });
        Self { rounds }
    }

    /// The strata of the points from `index` on.
    ///
    /// All lanes walk their permutations together, until the last is below its count.
    #[inline(always)]
    fn of_block(&self, index: u32, of: &Counts) -> Words {
        // From an index without a point, the walk might never end.
        let mut strata = Lanes::splat(0);
        for lane in 0..LANES {
            let row = index + ROWS[lane];
            strata[lane] = if row < of.counts[lane] { row } else { 0 };
        }
        strata = self.permuted(&strata, of);
        loop {
            let mut beyond = 0;
            for (stratum, count) in strata.iter().zip(&of.counts) {
                beyond |= u32::from(stratum >= count);
            }
            if beyond == 0 {
                return strata;
            }
            let next = self.permuted(&strata, of);
            for lane in 0..LANES {
                strata[lane] = if strata[lane] >= of.counts[lane] { next[lane] } else { strata[lane] };
            }
        }
    }

    /// One step of the permutation of each lane.
    #[inline(always)]
    fn permuted(&self, places: &Words, Counts { masks, shifts, .. }: &Counts) -> Words {
        let mut places = *places;
        let (rows, _) = places.as_chunks_mut::<REPLICATES>();
        for row in rows {
            for own in 0..REPLICATES {
                // All rounds in one loop: the compiler would unroll a shorter one instead of vectorising it.
                let mut place = row[own];
                for [add, multiply] in &self.rounds {
                    place = turned(place, [add[own], multiply[own]], (masks[own], shifts[own]));
                }
                row[own] = place;
            }
        }
        places
    }
}

const ROUNDS: usize = 4;

/// The summand and the factor of each round of a permutation.
#[expect(clippy::cast_possible_truncation, reason = "the halves of a word")]
fn rounds(key: u64) -> [[u32; 2]; ROUNDS] {
    std::array::from_fn(|round| {
        let word = bits(key, round as u64);
        [(word >> 32) as u32, word as u32 | 1]
    })
}

/// A mask of the bits that a count needs, and half of their number.
fn mask_and_shift(count: u32) -> (u32, u32) {
    let mask = count.next_power_of_two() - 1;
    (mask, (mask.count_ones() / 2).max(1))
}

/// A round of a permutation of all numbers below a power of two: adding, multiplying by an odd number and
/// folding the high bits into the low ones are each invertible.
#[inline(always)]
fn turned(place: u32, [add, multiply]: [u32; 2], (mask, shift): (u32, u32)) -> u32 {
    // Overflow into higher bits does not affect the lower ones.
    let place = place.wrapping_add(add).wrapping_mul(multiply) & mask;
    place ^ (place >> shift)
}

/// The place of `index` in a random permutation of 0, 1, … `count` − 1, which is at most 2²⁸.
///
/// A bijection of the numbers with as many bits as `count` needs, repeated until the result is below `count`:
/// less than two steps on average (J. Black and P. Rogaway, *Ciphers with arbitrary finite domains*, CT-RSA
/// 2002: cycle walking).
fn permuted(index: u32, count: u32, key: u64) -> u32 {
    let (rounds, size) = (rounds(key), mask_and_shift(count));
    let step = |place: u32| rounds.iter().fold(place, |place, round| turned(place, *round, size));
    let mut place = step(index);
    while place >= count {
        place = step(place);
    }
    place
}

#[cfg(test)]
#[expect(clippy::cast_possible_truncation, reason = "cells that a share in (0, 1) falls into")]
#[expect(clippy::disallowed_methods, reason = "powers of two and squares, no bits of which are compared")]
mod tests;
