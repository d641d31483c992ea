//! Random bits by index: the same for every thread, in any order.
//!
//! # References
//!
//! G. L. Steele, D. Lea and C. H. Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014:
//! SplitMix64.

use crate::model::LANES;

/// SplitMix64's increment, 2⁶⁴ over the golden ratio.
const GAMMA: u64 = 0x9E37_79B9_7F4A_7C15;

/// The number at `index` of the SplitMix64 sequence that starts at `key`.
#[inline(always)]
#[must_use]
pub fn bits(key: u64, index: u64) -> u64 {
    mixed(state(key, index))
}

/// The sequence's state at `index`.
#[inline(always)]
fn state(key: u64, index: u64) -> u64 {
    key.wrapping_add(GAMMA.wrapping_mul(index.wrapping_add(1)))
}

/// SplitMix64's number of a state.
#[inline(always)]
fn mixed(state: u64) -> u64 {
    let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Difference of the state of each lane of a block from that of the first lane. Adding it saves a 64-bit
/// multiplication in each lane, which is slow in vectors.
static STEPS: [u64; LANES] = {
    let mut steps = [0; LANES];
    let mut lane = 1;
    while lane < LANES {
        steps[lane] = GAMMA.wrapping_add(steps[lane - 1]);
        lane += 1;
    }
    steps
};

/// The numbers at `first` and the indices that follow, one for each lane of a block.
#[inline(always)]
pub(crate) fn bits_of_block(key: u64, first: u64) -> impl Iterator<Item = u64> {
    let first = state(key, first);
    STEPS.iter().map(move |step| mixed(first.wrapping_add(*step)))
}

/// A sequence's key, from the seed and the purpose of the sequence.
#[must_use]
pub fn key(seed: u64, path: &[u64]) -> u64 {
    path.iter().fold(bits(seed, 0), |key, &step| bits(key, step))
}

/// The leading 52 bits as a number in (0, 1): the middle of one of 2⁵² equal cells.
///
/// Never 0 or 1, and 1 − u is exact. The least is 2⁻⁵³: its normal quantile is 8.2 standard deviations below
/// the mean.
#[inline(always)]
#[must_use]
pub fn unit(bits: u64) -> f64 {
    // 1 − 2⁻⁵³
    const BEGIN: f64 = 1.0 - f64::EPSILON / 2.0;
    // u = k·2⁻⁵² + 2⁻⁵³; the mantissa of 1 + k·2⁻⁵² is k. The difference is exact.
    f64::from_bits(1.0_f64.to_bits() | (bits >> 12)) - BEGIN
}

#[cfg(test)]
mod tests {
    use super::{bits, key, unit};

    /// Outputs for seed 1234567, as printed by Rosetta Code, *Pseudo-random numbers/Splitmix64*.
    #[test]
    fn the_sequence_is_that_of_splitmix64() {
        let expected: [u64; 5] = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        for (index, value) in (0..).zip(expected) {
            assert_eq!(bits(1_234_567, index), value);
        }
    }

    #[test]
    fn units_lie_inside_and_are_symmetric() {
        assert_eq!(unit(0), 2.0_f64.recip() * f64::EPSILON);
        assert_eq!(unit(u64::MAX), 1.0 - unit(0));
        assert_eq!(unit(1 << 63), 0.5 + unit(0));
        for index in 0..1000 {
            let word = bits(7, index);
            assert_eq!(1.0 - unit(word), unit(!word));
        }
    }

    #[test]
    fn keys_differ_by_every_step() {
        let keys = [key(1, &[]), key(1, &[0]), key(1, &[1]), key(1, &[0, 0]), key(1, &[0, 1]), key(2, &[0])];
        for (index, first) in keys.iter().enumerate() {
            assert!(!keys[index + 1..].contains(first));
        }
    }
}
