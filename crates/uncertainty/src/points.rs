//! Points in the unit cube, each from its index alone: shares between 0 and 1 for every input of every
//! sample.
//!
//! Samples are dealt in turn to [`REPLICATES`] point sets: sample j is point ⌊j/16⌋ of set j mod 16. Each set
//! is random by itself, so the spread of a result between the sets gives its standard error. Every whole
//! number of blocks from the beginning has the same number of points from each set. Latin hypercube sets are
//! independent of each other. So are Sobol' sets, except for correlations between two inputs, which cancel
//! among them.
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
use crate::random::{bits, key, unit};
use sobol::Sobol;

pub use sobol::MAX_INPUTS as MAX_SOBOL_INPUTS;

/// How points are distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SamplingMethod {
    /// Independent points.
    MonteCarlo,
    /// In every replicate, each input has exactly one point in each of as many equal strata as there are
    /// points.
    LatinHypercube,
    /// Sobol' points with Owen's scrambling, except for the first digits, which are shifted. They work best
    /// for a power of two of samples; otherwise a part of the points of each replicate is less even, and so
    /// are pairs of inputs.
    Sobol,
}

/// Points of one method, seed and number of inputs and samples.
#[derive(Clone, Debug)]
pub(crate) struct Points {
    samples: u64,
    inputs: Inputs,
}

/// What the points of each input follow from.
#[derive(Clone, Debug)]
enum Inputs {
    MonteCarlo(Vec<u64>),
    LatinHypercube(Vec<Strata>),
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
        let count = samples as u64;
        if samples < MIN_SAMPLES || count > MAX_SAMPLES {
            return Err(InvalidRequest::Samples { samples });
        }
        // The numbers 1 to 4 keep the sequences of the methods apart under one seed.
        let all = 0..inputs;
        let inputs = match method {
            SamplingMethod::MonteCarlo => {
                Inputs::MonteCarlo(all.map(|input| key(seed, &[1, input as u64])).collect())
            }
            SamplingMethod::LatinHypercube => {
                Inputs::LatinHypercube(all.map(|input| Strata::new(key(seed, &[2, input as u64]))).collect())
            }
            SamplingMethod::Sobol if inputs > MAX_SOBOL_INPUTS => {
                return Err(InvalidRequest::TooManyInputs { inputs, limit: MAX_SOBOL_INPUTS });
            }
            SamplingMethod::Sobol => {
                let seeds: Vec<_> = all.map(|input| key(seed, &[3, input as u64])).collect();
                Inputs::Sobol(Sobol::all(&seeds, key(seed, &[4]), count / REPLICATES as u64))
            }
        };
        Ok(Self { samples: count, inputs })
    }

    /// Whether any point is independent of all others.
    #[inline(always)]
    pub(crate) fn are_independent(&self) -> bool {
        matches!(self.inputs, Inputs::MonteCarlo(_))
    }

    /// The shares of a block of samples, a column for each input. Lanes beyond the last sample hold some
    /// point or other.
    #[inline(always)]
    pub(crate) fn fill(&self, block: u64, columns: &mut [Lanes]) {
        let first = block * LANES as u64;
        match &self.inputs {
            Inputs::MonteCarlo(keys) => {
                for (&key, column) in keys.iter().zip(columns) {
                    for (lane, share) in (0..).zip(column) {
                        *share = unit(bits(key, first + lane));
                    }
                }
            }
            Inputs::LatinHypercube(inputs) => {
                for (strata, column) in inputs.iter().zip(columns) {
                    for (lane, share) in (0..).zip(column) {
                        *share = strata.share(first + lane, self.samples);
                    }
                }
            }
            Inputs::Sobol(inputs) => {
                for (sobol, column) in inputs.iter().zip(columns) {
                    let (groups, _) = column.as_chunks_mut::<REPLICATES>();
                    for (group, index) in groups.iter_mut().zip(first / REPLICATES as u64..) {
                        sobol.fill(index, group);
                    }
                }
            }
        }
    }
}

/// Latin hypercube points of one input.
#[derive(Clone, Copy, Debug)]
struct Strata {
    /// One permutation of the strata for each replicate.
    permutations: [u64; REPLICATES],
    /// Where in its stratum a point lies.
    places: u64,
}

impl Strata {
    fn new(input: u64) -> Self {
        let permutation = |replicate| key(input, &[1, replicate as u64]);
        Self { permutations: std::array::from_fn(permutation), places: key(input, &[2]) }
    }

    fn share(&self, sample: u64, samples: u64) -> f64 {
        /// (bit) with a stratum's number of up to 28 bits below the 53 of an `f64`, so that their sum is
        /// exact.
        const PLACE_BITS: u32 = 20;
        const PLACES: f64 = (1_u64 << PLACE_BITS) as f64;
        let sets = REPLICATES as u64;
        let (replicate, index) = (sample % sets, sample / sets);
        // Points of this replicate: ⌈(N − r)/16⌉
        let count = (samples - replicate).div_ceil(sets);
        if index >= count {
            return 0.5;
        }
        #[expect(clippy::cast_possible_truncation, reason = "below 16")]
        let stratum = permuted(index, count, self.permutations[replicate as usize]);
        let place = (bits(self.places, sample) >> (64 - PLACE_BITS)) as f64;
        // u = (π(i) + (k + ½)·2⁻²⁰)/n
        (stratum as f64 + (place + 0.5) / PLACES) / count as f64
    }
}

/// The place of `index` in a random permutation of 0, 1, … `count` − 1.
///
/// A bijection of the numbers of as many bits as `count` needs, walked until it comes back below `count`:
/// less than two steps on average (J. Black and P. Rogaway, *Ciphers with arbitrary finite domains*, CT-RSA
/// 2002: cycle walking).
fn permuted(index: u64, count: u64, key: u64) -> u64 {
    const ROUNDS: u64 = 4;
    let mask = count.next_power_of_two() - 1;
    let shift = (mask.count_ones() / 2).max(1);
    let mut place = index;
    loop {
        for round in 0..ROUNDS {
            // Adding, multiplying by an odd number and folding the high bits into the low ones can each be
            // undone.
            let word = bits(key, round);
            place = place.wrapping_add(word >> 32) & mask;
            place = place.wrapping_mul(word | 1) & mask;
            place ^= place >> shift;
        }
        if place < count {
            return place;
        }
    }
}

#[cfg(test)]
#[expect(clippy::cast_possible_truncation, reason = "cells that a share in (0, 1) falls into")]
#[expect(clippy::disallowed_methods, reason = "powers of two and squares, no bits of which are compared")]
mod tests;
