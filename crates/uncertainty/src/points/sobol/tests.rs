use super::{DIRECTION_NUMBERS, DIRECTIONS, MAX_INPUTS, POINTS, SHIFTED, Sobol, directions, point, sum_of};
use crate::model::Lanes;
use crate::points::REPLICATES;
use crate::random::key;

/// The point as a number.
fn plain(input: usize, index: u64) -> f64 {
    point(&directions(input), index).reverse_bits() as f64 / 2.0_f64.powi(64)
}

/// The inputs of replicates with this number of points.
fn all(inputs: usize, seed: u64, points: u64) -> Vec<Sobol> {
    let seeds: Vec<u64> = (1..=inputs as u64).map(|input| key(seed, &[input])).collect();
    Sobol::all(&seeds, seed, points)
}

/// Points 1 to 3 in any dimension begin with ½, and points 4 to 7 of the first dimensions are printed in S.
/// Joe and F. Y. Kuo, *Notes on generating Sobol' sequences* (2008), in Gray-code order; here they are in
/// index order.
#[test]
fn the_first_points_are_those_of_sobol() {
    let first: Vec<f64> = (0..8).map(|index| plain(0, index)).collect();
    assert_eq!(first, [0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875]);
    // m = 1, 3, 5, …: v = 0.1, 0.11, 0.101 in binary.
    let second: Vec<f64> = (0..8).map(|index| plain(1, index)).collect();
    assert_eq!(second, [0.0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875]);
    // Degree 3, m = 1, 3, 1, then 2²·a₂m₂ ⊕ 2³m₁ ⊕ m₁ = 12 ⊕ 8 ⊕ 1 = 5, with x³ + x + 1: v₄ = 5/16.
    let third: Vec<f64> = [1, 2, 4, 8].map(|index| plain(3, index)).to_vec();
    assert_eq!(third, [0.5, 0.75, 0.125, 0.3125]);
}

/// A polynomial of degree s is primitive if x has the order 2ˢ − 1 modulo it.
#[test]
fn the_polynomials_are_primitive_and_differ() {
    let mut seen = Vec::new();
    for (polynomial, initial) in DIRECTION_NUMBERS {
        let degree = initial.len();
        assert_eq!(polynomial >> degree, 1, "{polynomial:b} is not of degree {degree}");
        let mut power = 1;
        let mut order = 0;
        loop {
            power <<= 1;
            if power >> degree == 1 {
                power ^= polynomial;
            }
            order += 1;
            if power == 1 || order == 1 << degree {
                break;
            }
        }
        assert_eq!(order, (1 << degree) - 1, "{polynomial:b} is not primitive");
        assert!(!seen.contains(&polynomial), "{polynomial:b} stands twice");
        seen.push(polynomial);
        for (place, m) in initial.iter().enumerate() {
            assert!(m % 2 == 1 && *m < 2 << place, "{m} is no number for place {place}");
        }
    }
}

/// Sobol's property A, which according to Joe and Kuo holds for their first 1111 dimensions: the first digits
/// of the first d direction numbers in d dimensions are linearly independent, so that each of the 2ᵈ orthants
/// of the cube contains one of the first 2ᵈ points.
#[test]
fn property_a_holds_as_joe_and_kuo_say() {
    // With more dimensions than direction numbers the matrix would not be square.
    for dimensions in 1..=DIRECTIONS {
        let rows = (0..dimensions).map(|input| {
            directions(input)[..dimensions].iter().fold(0, |row, direction| (row << 1) | (direction & 1))
        });
        let mut basis: Vec<u64> = Vec::new();
        for row in rows {
            let reduced = basis.iter().fold(row, |row, &other| row.min(row ^ other));
            assert_ne!(reduced, 0, "{dimensions} dimensions depend on each other");
            basis.push(reduced);
            basis.sort_unstable_by(|first, second| second.cmp(first));
        }
    }
}

/// FNV-1a over the table as copied from Joe and Kuo's file: the tests above do not check every digit.
#[test]
fn the_table_is_unchanged() {
    assert_eq!(MAX_INPUTS, 256);
    let numbers = DIRECTION_NUMBERS
        .iter()
        .flat_map(|(polynomial, initial)| std::iter::once(*polynomial).chain(initial.iter().copied()));
    let hash = numbers.flat_map(u32::to_le_bytes).fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    });
    assert_eq!(hash, 0x9778_A5D1_26C9_A245, "0x{hash:016X}");
}

/// The point at an index, taken from its block.
fn fill(sobol: &Sobol, index: u64, shares: &mut [f64; REPLICATES]) {
    let mut block = Lanes::ZERO;
    let place = index % POINTS as u64;
    sobol.fill(index - place, &mut block);
    shares.copy_from_slice(block.chunks(REPLICATES).nth(place as usize).unwrap());
}

/// In every input, a block of 2ᵏ points has one point in each of 2ᵏ equal intervals, scrambled or not.
#[test]
fn each_block_is_stratified_in_every_input() {
    for (input, sobol) in all(MAX_INPUTS, 77, 512).into_iter().enumerate() {
        let mut shares = [0.0; REPLICATES];
        for power in [1, 4, 9] {
            let count = 1_usize << power;
            for block in 0..3 {
                let mut filled = vec![[false; REPLICATES]; count];
                for index in block * count..(block + 1) * count {
                    fill(&sobol, index as u64, &mut shares);
                    for (replicate, share) in shares.iter().enumerate() {
                        let cell = (share * count as f64) as usize;
                        assert!(!filled[cell][replicate], "input {input}, {count} points");
                        filled[cell][replicate] = true;
                    }
                }
            }
        }
    }
}

/// The first two inputs are a (0, 2)-sequence (Sobol' 1967): one point in each elementary rectangle of any
/// shape, even when scrambled.
#[test]
fn the_first_two_inputs_fill_every_elementary_rectangle() {
    let [first, second] = all(2, 3, 256).try_into().unwrap();
    let count = 256;
    let mut shares = [[0.0; REPLICATES]; 2];
    let mut points = Vec::new();
    for index in 0..count {
        fill(&first, index, &mut shares[0]);
        fill(&second, index, &mut shares[1]);
        points.push(shares);
    }
    for replicate in 0..REPLICATES {
        for columns in [1, 2, 4, 8, 16, 32, 64, 128, 256] {
            let rows = 256 / columns;
            let mut filled = [false; 256];
            for [x, y] in &points {
                let column = (x[replicate] * f64::from(columns)) as u32;
                let row = (y[replicate] * f64::from(rows)) as u32;
                let cell = (column * rows + row) as usize;
                assert!(!filled[cell]);
                filled[cell] = true;
            }
        }
    }
}

/// Owen's scrambling may move a point anywhere, and tosses a separate coin at each branch of the tree of
/// digits.
#[test]
fn scrambling_is_uniform_and_its_coins_are_independent() {
    let seeds = 4096_u64;
    let mut shares = [0.0; REPLICATES];
    // Counts how often digit k (from 1) of the points with the first digits 0… and 1… is flipped.
    let mut turned = [[0_u32; 12]; 2];
    let mut both = [0_u32; 12];
    let mut sum = 0.0;
    for seed in 0..seeds {
        let sobol = Sobol::new(0, seed);
        let digits = [0, 1].map(|index| {
            fill(&sobol, index, &mut shares);
            shares[0]
        });
        sum += digits[0];
        for place in 1..=12_i32 {
            let digit = |share: f64| ((share * 2.0_f64.powi(place)) as u64) % 2 == 1;
            let [zero, one] = digits.map(digit);
            let number = (place - 1) as usize;
            turned[0][number] += u32::from(zero);
            turned[1][number] += u32::from(one);
            both[number] += u32::from(zero == one);
        }
    }
    // Five standard deviations of the count of a fair coin, √(n/4), and of the mean of uniform numbers,
    // 1/√(12n).
    let limit = 5.0 * (seeds as f64 / 4.0).sqrt();
    let fair = |count: u32| (f64::from(count) - seeds as f64 / 2.0).abs() < limit;
    assert!(turned.iter().flatten().all(|&count| fair(count)), "{turned:?}");
    // Both points share the coin of the first digit; all others have separate coins.
    assert_eq!(both[0], 0);
    assert!(both[1..].iter().all(|&count| fair(count)), "{both:?}");
    assert!((sum / seeds as f64 - 0.5).abs() < 5.0 / (12.0 * seeds as f64).sqrt());
}

/// The bits that shift coinciding digits of two inputs agree in half of the replicates; all others are coins.
#[test]
fn shifts_of_digits_that_coincide_are_orthogonal() {
    let (inputs, places) = (31, 6);
    let patterns: Vec<(usize, u64, usize)> = (0..inputs)
        .flat_map(|input| (0..SHIFTED).map(move |digit| (input, digit)))
        .map(|(input, digit)| (input, sum_of(&directions(input)[..places], digit), digit))
        .collect();
    let seeds = 50;
    let (mut coinciding, mut others, mut squares, mut ones) = (0, 0.0, 0.0, 0.0);
    for seed in 0..seeds {
        let all = all(inputs, seed, 1 << places);
        let bits: Vec<u16> = patterns
            .iter()
            .map(|&(input, _, digit)| {
                (0..).zip(all[input].shifts).fold(0, |bits, (replicate, shift)| {
                    bits | u16::from((shift >> digit) & 1 == 1) << replicate
                })
            })
            .collect();
        ones += f64::from(bits.iter().map(|bits| bits.count_ones()).sum::<u32>());
        for (place, first) in patterns.iter().enumerate() {
            for (other, second) in patterns.iter().enumerate().skip(place + 1) {
                let agreeing = (bits[place] ^ bits[other]).count_zeros();
                if first.1 == second.1 {
                    assert_eq!(agreeing, 8, "{first:?}, {second:?}");
                    coinciding += 1;
                } else {
                    others += 1.0;
                    squares += (f64::from(agreeing) - 8.0).powi(2);
                }
            }
        }
    }
    assert!(coinciding > 50 * seeds, "{coinciding}");
    // 16 coins have variance 4, their fraction of ones ¼ over 31·4·16·50 = 99,200.
    assert!((squares / others - 4.0).abs() < 0.1, "{}", squares / others);
    let all = (patterns.len() * REPLICATES) as f64 * seeds as f64;
    assert!((ones / all - 0.5).abs() < 5.0 * (0.25 / all).sqrt(), "{}", ones / all);
}

/// Digits beyond those that distinguish the points are left to the scrambling, which tosses another coin for
/// each point.
#[test]
fn few_points_have_few_digits_shifted() {
    for (points, digits) in [(4, 2), (7, 2), (8, 3), (16, 4), (1 << 28, 4)] {
        assert!(all(3, 1, points).iter().all(|sobol| sobol.shifted == (1 << digits) - 1), "{points}");
    }
}
