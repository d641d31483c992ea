//! Scrambled Sobol' points.
//!
//! Each replicate takes the same first points of the sequence and scrambles them separately. But few points
//! in many dimensions are not evenly spread in every pair of inputs: among 64 points, two inputs out of 31
//! often have the same first digit throughout, or the first digit of one is the second of the other.
//! Scrambling changes the sign of such a correlation but not its size, and 16 random signs do not cancel.
//! Therefore the first digits are only shifted, by bits that are random in every replicate, but chosen
//! together for coinciding digits: the bits of any two of these agree in eight replicates and differ in
//! eight, so that the correlations cancel. Effects of one input, or of three, still vary between any two
//! replicates as if they were independent, so that their spread is that of chance.
//!
//! # References
//!
//! I. M. Sobol', *On the distribution of points in a cube and the approximate evaluation of integrals*, USSR
//! Comput. Math. Math. Phys. 7 (1967). P. Bratley and B. L. Fox, *Algorithm 659*, ACM TOMS 14 (1988): the
//! recurrence of the direction numbers. S. Laine and T. Karras, *Stratified sampling for stochastic
//! transparency*, Computer Graphics Forum 30 (2011), and B. Burley, *Practical hash-based Owen scrambling*,
//! JCGT 9 (2020): scrambling by a hash in which each bit depends on those below it only. J. J. Sylvester,
//! *Thoughts on inverse orthogonal matrices*, Philosophical Magazine 34 (1867): the matrix of signs with
//! orthogonal rows.

use super::direction_numbers::DIRECTION_NUMBERS;
use super::{POINTS, REPLICATES, permuted};
use crate::model::Lanes;
use crate::random::{bits, key, unit};

/// Maximum number of inputs for which there are direction numbers. The first needs none.
pub const MAX_INPUTS: usize = DIRECTION_NUMBERS.len() + 1;

/// Enough for 2²⁸ points per replicate, more than [`MAX_SAMPLES`](crate::MAX_SAMPLES) need.
const DIRECTIONS: usize = 28;

// Even, and 2 modulo 4, so that each bit depends on the next lower one. Digits of π (as Blowfish takes them),
// but for the last two bits.
const FOLDS: [u64; 3] = [0x243F_6A88_85A3_08D2, 0x1319_8A2E_0370_7346, 0xA409_3822_299F_31D2];

/// Maximum number of digits that are shifted. If only later ones coincide, the correlation is below 3/64.
pub(super) const SHIFTED: usize = 4;

/// Points of one input.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sobol {
    /// Direction numbers, the first binary digit in the lowest bit.
    directions: [u64; DIRECTIONS],
    /// The summands and factors of each replicate's scrambling.
    keys: [[u64; REPLICATES]; 4],
    /// Bit mask of the shifted digits.
    shifted: u64,
    /// The shifts of these digits in each replicate.
    shifts: [u64; REPLICATES],
}

impl Sobol {
    /// All inputs, with `points` points in each replicate. `seeds` has one seed for each input; `common` is
    /// the seed for what they share.
    pub(super) fn all(seeds: &[u64], common: u64, points: u64) -> Vec<Self> {
        let mut all: Vec<_> = seeds.iter().enumerate().map(|(input, &seed)| Self::new(input, seed)).collect();
        // Digits are shifted only as far as they distinguish the points, up to the greatest power of two of
        // them. Later ones would be shifted equally in all points.
        let places = (points.max(1).ilog2() as usize).min(DIRECTIONS);
        let digits = SHIFTED.min(places);
        for input in &mut all {
            input.shifted = (1 << digits) - 1;
        }

        // Groups digits that coincide, being sums of the same places of the index.
        let mut coinciding: Vec<_> = (0..all.len())
            .flat_map(|input| (0..digits).map(move |digit| (input, digit)))
            .map(|(input, digit)| (sum_of(&all[input].directions[..places], digit), input, digit))
            .collect();
        coinciding.sort_unstable();
        let same = coinciding.chunk_by(|first, second| first.0 == second.0);
        for (group, members) in (0..).zip(same.flat_map(|same| same.chunks(REPLICATES))) {
            let seed = key(common, &[group]);
            for (&(_, input, digit), row) in members.iter().zip(ROWS) {
                for (replicate, shift) in (0..).zip(&mut all[input].shifts) {
                    #[expect(clippy::cast_possible_truncation, reason = "16")]
                    let column = permuted(replicate, REPLICATES as u32, key(seed, &[0]));
                    // bᵣ + |row ∧ π(r)| modulo 2
                    let sign =
                        (bits(seed, 1) >> replicate) ^ u64::from((row & u64::from(column)).count_ones());
                    *shift |= (sign & 1) << digit;
                }
            }
        }
        all
    }

    fn new(input: usize, seed: u64) -> Self {
        let step = |step: u64| {
            move |replicate: usize| {
                let word = key(seed, &[step, replicate as u64]);
                // The odd ones multiply.
                if step % 2 == 1 { word | 1 } else { word }
            }
        };
        let keys = [0, 1, 2, 3].map(|number| std::array::from_fn(step(number)));
        Self { directions: directions(input), keys, shifted: 0, shifts: [0; REPLICATES] }
    }

    /// The points of the block that begins at `index`, scrambled for each replicate.
    #[inline(always)]
    pub(super) fn fill(&self, index: u64, shares: &mut Lanes) {
        // A block begins at a multiple of its points, so the indices differ only in their last places.
        let common = point(&self.directions, index);
        let [add, multiply, add_again, multiply_again] = &self.keys;
        let (groups, _) = shares.as_chunks_mut::<REPLICATES>();
        for (place, group) in (0..POINTS as u64).zip(groups) {
            let digits = common ^ last_places(&self.directions, place);
            let first = digits & self.shifted;
            for (replicate, share) in group.iter_mut().enumerate() {
                // Digit 1 is the lowest bit here: no higher bit affects a lower one, so that points that
                // agree in their first digits still do, and the next digit distinguishes them as before.
                let mut word = digits;
                word ^= word.wrapping_mul(FOLDS[0]);
                word = word.wrapping_add(add[replicate]).wrapping_mul(multiply[replicate]);
                word ^= word.wrapping_mul(FOLDS[1]);
                word = word.wrapping_add(add_again[replicate]).wrapping_mul(multiply_again[replicate]);
                word ^= word.wrapping_mul(FOLDS[2]);
                word = (word & !self.shifted) | (first ^ self.shifts[replicate]);
                *share = unit(word.reverse_bits());
            }
        }
    }
}

/// The rows of the matrix of signs (−1)^|row ∧ column| in the order of assignment. No four of the first six
/// multiply to one, which would be a sign common to all replicates.
const ROWS: [u64; REPLICATES] = [0, 1, 2, 4, 8, 15, 3, 5, 6, 9, 10, 12, 7, 11, 13, 14];

/// The places of the index whose sum modulo 2 is the digit.
fn sum_of(directions: &[u64], digit: usize) -> u64 {
    directions.iter().rev().fold(0, |places, direction| places << 1 | (direction >> digit) & 1)
}

/// x = i₁v₁ ⊕ i₂v₂ ⊕ …, i = …i₂i₁ in binary, the first digit of x in the lowest bit.
#[inline(always)]
fn point(directions: &[u64; DIRECTIONS], index: u64) -> u64 {
    let mut digits = 0;
    for (place, direction) in directions.iter().enumerate() {
        // All ones if the digit is one.
        digits ^= direction & ((index >> place) & 1).wrapping_neg();
    }
    digits
}

/// The contribution of the two last places of an index to its point.
#[inline(always)]
fn last_places(directions: &[u64; DIRECTIONS], place: u64) -> u64 {
    let [last, last_but_one, ..] = directions;
    (last & (place & 1).wrapping_neg()) ^ (last_but_one & (place >> 1).wrapping_neg())
}

/// Direction numbers of an input, the first binary digit in the lowest bit.
fn directions(input: usize) -> [u64; DIRECTIONS] {
    let row = input.checked_sub(1).and_then(|row| DIRECTION_NUMBERS.get(row));
    let mut directions = [0; DIRECTIONS];
    for place in 0..DIRECTIONS {
        // v = m/2ᵏ, k counted from 1
        let fraction = |m: u64| m << (63 - place);
        directions[place] = match row {
            None => fraction(1),
            Some((_, initial)) if place < initial.len() => fraction(u64::from(initial[place])),
            Some((polynomial, initial)) => {
                let degree = initial.len();
                // vₖ = a₁vₖ₋₁ ⊕ a₂vₖ₋₂ ⊕ … ⊕ vₖ₋ₛ ⊕ vₖ₋ₛ/2ˢ, polynomial xˢ + a₁xˢ⁻¹ + … + 1
                let mut direction = directions[place - degree] >> degree;
                for back in 1..=degree {
                    if (polynomial >> (degree - back)) & 1 == 1 {
                        direction ^= directions[place - back];
                    }
                }
                direction
            }
        };
    }
    directions.map(u64::reverse_bits)
}

#[cfg(test)]
#[expect(clippy::cast_possible_truncation, reason = "cells that a share in (0, 1) falls into")]
#[expect(clippy::disallowed_methods, reason = "powers of two and squares, no bits of which are compared")]
mod tests;
