//! Scrambled Sobol' points.
//!
//! # References
//!
//! I. M. Sobol', *On the distribution of points in a cube and the approximate evaluation of integrals*, USSR Comput. Math. Math. Phys. 7
//! (1967).
//! P. Bratley and B. L. Fox, *Algorithm 659*, ACM TOMS 14 (1988): the recurrence of the direction numbers.
//! S. Laine and T. Karras, *Stratified sampling for stochastic transparency*, Computer Graphics Forum 30 (2011), and
//! B. Burley, *Practical hash-based Owen scrambling*, JCGT 9 (2020): scrambling by a hash in which each bit depends on those below it only.

use super::REPLICATES;
use super::direction_numbers::DIRECTION_NUMBERS;
use crate::random::{key, unit};

/// The most inputs that the direction numbers serve. The first needs none.
pub const MAX_INPUTS: usize = DIRECTION_NUMBERS.len() + 1;

/// Enough for [`super::MAX_SAMPLES`] over all replicates.
const DIRECTIONS: usize = 28;

// Even, and 2 modulo 4, so that each bit depends on the next lower one. Digits of π (as Blowfish takes them), but for the last two bits.
const FOLDS: [u64; 3] = [0x243F_6A88_85A3_08D2, 0x1319_8A2E_0370_7346, 0xA409_3822_299F_31D2];

/// Points of one input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sobol {
    /// Direction numbers, the first binary digit in the lowest bit.
    directions: [u64; DIRECTIONS],
    /// What the scrambling of each replicate adds and multiplies.
    keys: [[u64; REPLICATES]; 4],
}

impl Sobol {
    pub(super) fn new(input: usize, seed: u64) -> Self {
        let step = |step: u64| {
            move |replicate: usize| {
                let word = key(seed, &[step, replicate as u64]);
                // The odd ones multiply.
                if step % 2 == 1 { word | 1 } else { word }
            }
        };
        let keys = [0, 1, 2, 3].map(|number| std::array::from_fn(step(number)));
        Self { directions: directions(input), keys }
    }

    /// The point at `index`, scrambled for each replicate.
    #[inline(always)]
    pub(super) fn fill(&self, index: u64, shares: &mut [f64; REPLICATES]) {
        let digits = point(&self.directions, index);
        let [add, multiply, add_again, multiply_again] = &self.keys;
        for (replicate, share) in shares.iter_mut().enumerate() {
            // Digit 1 is the lowest bit here: nothing flows from a higher bit to a lower one, so that points that agree in
            // their first digits still do, and are told apart by the next as before.
            let mut word = digits;
            word ^= word.wrapping_mul(FOLDS[0]);
            word = word.wrapping_add(add[replicate]).wrapping_mul(multiply[replicate]);
            word ^= word.wrapping_mul(FOLDS[1]);
            word = word.wrapping_add(add_again[replicate]).wrapping_mul(multiply_again[replicate]);
            word ^= word.wrapping_mul(FOLDS[2]);
            *share = unit(word.reverse_bits());
        }
    }
}

/// x = i₁v₁ ⊕ i₂v₂ ⊕ …, i = …i₂i₁ in binary, the first digit of x in the lowest bit.
#[inline(always)]
fn point(directions: &[u64; DIRECTIONS], index: u64) -> u64 {
    let mut digits = 0;
    for (place, direction) in directions.iter().enumerate() {
        // All ones where the digit is one.
        digits ^= direction & ((index >> place) & 1).wrapping_neg();
    }
    digits
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
