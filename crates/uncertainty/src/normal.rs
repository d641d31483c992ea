//! The standard normal distribution.
//!
//! # References
//!
//! M. J. Wichura, *Algorithm AS 241: the percentage points of the normal distribution*, Applied Statistics 37
//! (1988): PPND16. G. E. P. Box and M. E. Muller, *A note on the generation of random normal deviates*,
//! Annals of Mathematical Statistics 29 (1958). G. Marsaglia, *Evaluating the normal distribution*, Journal
//! of Statistical Software 11 (2004): the series. M. Abramowitz and I. A. Stegun, *Handbook of Mathematical
//! Functions* (1964): 26.2.14, the continued fraction; 25.4.30, Gauss's quadrature. J. F. Hart et al.,
//! *Computer Approximations* (1968), with the coefficients printed in G. West, *Better approximations to
//! cumulative normal functions*, Wilmott Magazine (2005): probabilities of lanes.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, LN_2, PI};

use real::elementary::{exp, ln};

use crate::model::{LANES, Lanes};

// Numerators and denominators of AS 241: near the middle, in the tails, far out.
const A: [f64; 8] = [
    3.387_132_872_796_366_5,
    133.141_667_891_784_38,
    1_971.590_950_306_551_3,
    13_731.693_765_509_46,
    45_921.953_931_549_87,
    67_265.770_927_008_7,
    33_430.575_583_588_13,
    2_509.080_928_730_122_7,
];
const B: [f64; 8] = [
    1.0,
    42.313_330_701_600_91,
    687.187_007_492_057_9,
    5_394.196_021_424_751,
    21_213.794_301_586_597,
    39_307.895_800_092_71,
    28_729.085_735_721_943,
    5_226.495_278_852_854,
];
const C: [f64; 8] = [
    1.423_437_110_749_683_5,
    4.630_337_846_156_546,
    5.769_497_221_460_691,
    3.647_848_324_763_204_5,
    1.270_458_252_452_368_4,
    0.241_780_725_177_450_6,
    0.022_723_844_989_269_184,
    0.000_774_545_014_278_341_4,
];
const D: [f64; 8] = [
    1.0,
    2.053_191_626_637_759,
    1.676_384_830_183_803_8,
    0.689_767_334_985_1,
    0.148_103_976_427_480_08,
    0.015_198_666_563_616_457,
    0.000_547_593_808_499_534_5,
    1.050_750_071_644_416_9e-9,
];
const E: [f64; 8] = [
    6.657_904_643_501_103,
    5.463_784_911_164_114,
    1.784_826_539_917_291_3,
    0.296_560_571_828_504_87,
    0.026_532_189_526_576_124,
    0.001_242_660_947_388_078_4,
    0.000_027_115_555_687_434_876,
    2.010_334_399_292_288_1e-7,
];
const F: [f64; 8] = [
    1.0,
    0.599_832_206_555_888,
    0.136_929_880_922_735_8,
    0.014_875_361_290_850_615,
    0.000_786_869_131_145_613_3,
    0.000_018_463_183_175_100_548,
    1.421_511_758_316_446e-7,
    2.044_263_103_389_939_8e-15,
];

/// z with Φ(z) = p for each p, 0 < p < 1; −∞ at 0, +∞ at 1.
///
/// Within a relative error of 1e-15. The middle, with 85 % of all probabilities, costs one division and is
/// evaluated for all lanes; the tails are then gathered and evaluated again, with logarithm, root and
/// division. Each loop is branch-free and so vectorised.
#[inline(always)]
pub fn quantiles<const N: usize>(lanes: &mut [f64; N]) {
    let mut tails = Tails::new();
    tails.gather(lanes, 0);
    tails.settle(|lane, quantile| lanes[lane % N] = quantile);
}

/// Probabilities in the tails, gathered from several columns, so that their loop has full vectors.
pub(crate) struct Tails {
    shares: [f64; ROOM],
    /// The places that they come from.
    places: [usize; ROOM],
    count: usize,
}

/// Room for the tails of a column and as many that wait.
const ROOM: usize = 2 * LANES;

/// Number of tails evaluated in one loop.
const GROUP: usize = 16;

/// A probability in a tail, for lanes without one.
const ANY: f64 = 0.05;

impl Tails {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self { shares: [ANY; ROOM], places: [0; ROOM], count: 0 }
    }

    /// Whether there may be no room for the tails of another column.
    #[inline(always)]
    pub(crate) fn are_many(&self) -> bool {
        self.count > ROOM - LANES
    }

    /// Turns the probabilities of a column into quantiles, except for those in a tail, which wait until they
    /// are [settled](Self::settle). The column begins at the place `first` of their destination.
    #[inline(always)]
    pub(crate) fn gather<const N: usize>(&mut self, lanes: &mut [f64; N], first: usize) {
        const { assert!(N <= LANES && LANES <= 64) };
        // A bit for each lane in a tail, so that the loop visits only these.
        let mut in_tail = 0_u64;
        for (lane, share) in lanes.iter().enumerate() {
            in_tail |= u64::from((share - 0.5).abs() > MIDDLE) << lane;
        }
        // The indices never exceed the bounds: the remainders only tell the compiler so, since a bounds check
        // could panic and would prevent vectorisation.
        let mut count = self.count;
        while in_tail != 0 {
            let lane = in_tail.trailing_zeros() as usize;
            self.shares[count % ROOM] = lanes[lane % N];
            self.places[count % ROOM] = first + lane;
            in_tail &= in_tail - 1;
            count += 1;
        }
        self.count = count;
        for lane in lanes {
            *lane = middle(*lane);
        }
    }

    /// Puts the quantiles of all full groups into their places. The others wait.
    #[inline(always)]
    pub(crate) fn settle_groups(&mut self, put: impl FnMut(usize, f64)) {
        let count = self.count.min(ROOM);
        let settled = count - count % GROUP;
        self.settle_first(settled, put);
        self.shares.copy_within(settled..count, 0);
        self.places.copy_within(settled..count, 0);
        self.count = count - settled;
    }

    /// Puts the quantiles of all waiting tails into their places.
    #[inline(always)]
    pub(crate) fn settle(&mut self, put: impl FnMut(usize, f64)) {
        self.settle_first(self.count.min(ROOM), put);
        self.count = 0;
    }

    /// The last group may be filled up with other values, whose quantiles are discarded.
    #[inline(always)]
    fn settle_first(&self, count: usize, mut put: impl FnMut(usize, f64)) {
        let (groups, _) = self.shares.as_chunks::<GROUP>();
        for (group, places) in groups.iter().zip(self.places[..count].chunks(GROUP)) {
            let mut is_far = false;
            let mut quantiles = [0.0; GROUP];
            for (quantile, share) in quantiles.iter_mut().zip(group.iter()) {
                let (z, is_beyond) = tail(*share);
                *quantile = z;
                is_far |= is_beyond;
            }
            if is_far {
                far_tails(group, &mut quantiles);
            }
            for (quantile, place) in quantiles.iter().zip(places) {
                put(*place, *quantile);
            }
        }
    }
}

/// |p − ½| up to which AS 241 uses its first fraction.
const MIDDLE: f64 = 0.425;

/// z for |p − ½| ≤ [`MIDDLE`].
#[inline(always)]
fn middle(p: f64) -> f64 {
    let q = p - 0.5;
    // x = 0.425² − q²
    let x = 0.180_625 - q * q;
    // z = q·A(x)/B(x)
    let (numerator, denominator) = (polynomial(&A, x), polynomial(&B, x));
    q * (numerator / denominator)
}

/// r = √(−ln p) up to which AS 241 uses its second fraction.
const FAR: f64 = 5.0;

/// r = √(−ln p) for the probability p beyond a quantile.
#[inline(always)]
fn root_of_tail(p: f64) -> f64 {
    let share = if p < 0.5 { p } else { 1.0 - p };
    (-ln(share)).sqrt()
}

/// z for |p − ½| > [`MIDDLE`], and whether p is so far out that z is wrong.
#[inline(always)]
fn tail(p: f64) -> (f64, bool) {
    let r = root_of_tail(p);
    // |z| = C(r − 1.6)/D(r − 1.6)
    let x = r - 1.6;
    ((polynomial(&C, x) / polynomial(&D, x)).copysign(p - 0.5), r > FAR)
}

/// Corrects the quantiles that lie far out: one in 3·10¹⁰.
#[cold]
#[inline(never)]
fn far_tails(shares: &[f64; GROUP], quantiles: &mut [f64; GROUP]) {
    for (quantile, &p) in quantiles.iter_mut().zip(shares) {
        let r = root_of_tail(p);
        if r > FAR {
            // |z| = E(r − 5)/F(r − 5), which is ∞/∞ if the probability is zero.
            let x = r - 5.0;
            let z = if r.is_finite() { polynomial(&E, x) / polynomial(&F, x) } else { f64::INFINITY };
            *quantile = z.copysign(p - 0.5);
        }
    }
}

/// c₀ + c₁x + … + c₇x⁷
#[inline(always)]
fn polynomial(coefficients: &[f64; 8], x: f64) -> f64 {
    let [c0, c1, c2, c3, c4, c5, c6, c7] = coefficients;
    c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * (c6 + x * c7))))))
}

/// Turns independent uniform numbers in (0, 1) into independent standard normal numbers: each in the first
/// half of the lanes and its counterpart in the second half become two.
///
/// Faster than [`quantiles`], but only for independent points, because a number is no longer the quantile of
/// one uniform number.
#[inline(always)]
pub fn box_muller(lanes: &mut Lanes) {
    let (radii, turns) = lanes.split_at_mut(LANES / 2);
    for (first, second) in radii.iter_mut().zip(turns) {
        [*first, *second] = NormalPair::of([*first, *second]).numbers;
    }
}

/// Two independent standard normal numbers.
pub(crate) struct NormalPair {
    pub(crate) numbers: [f64; 2],
    /// √(z₁² + z₂²), a bound of both.
    pub(crate) radius: f64,
}

impl NormalPair {
    /// From two independent uniform numbers.
    #[inline(always)]
    pub(crate) fn of([first, second]: [f64; 2]) -> Self {
        // z₁ = √(−2 ln u₁) cos 2πu₂,  z₂ = √(−2 ln u₁) sin 2πu₂
        let radius = minus_two_ln_of_share(first).sqrt();
        let (sin, cos) = sin_cos_of_turn(second);
        Self { numbers: [radius * cos, radius * sin], radius }
    }
}

// The functions of `real` are accurate to the last digit for all arguments. Random numbers need neither, and
// these take half the time.

/// (2 artanh s − 2s)/s³ in powers of s², |s| ≤ 0.1716: Chebyshev interpolation, good to 3e-16 of 2 artanh s.
const LN: [f64; 6] = [
    0.666_666_666_666_620_8,
    0.400_000_000_112_065_05,
    0.285_714_241_383_241_6,
    0.222_228_622_801_087_16,
    0.181_401_938_028_659_92,
    0.166_218_171_528_589_28,
];

/// sin(πf/2)/f in powers of f², |f| ≤ ½: Chebyshev interpolation, good to 5e-18.
const SIN: [f64; 7] = [
    FRAC_PI_2,
    -0.645_964_097_506_244_3,
    0.079_692_626_246_043_01,
    -0.004_681_754_132_340_976,
    0.000_160_441_150_742_190_9,
    -3.598_643_352_982_31e-6,
    5.633_933_781_537_854e-8,
];

/// cos(πf/2) in powers of f², |f| ≤ ½: Chebyshev interpolation, good to 5e-17.
const COS: [f64; 7] = [
    1.0,
    -1.233_700_550_136_151_3,
    0.253_669_507_899_864_75,
    -0.020_863_480_734_946_57,
    0.000_919_259_950_041_661,
    -2.520_013_526_428_479e-5,
    4.655_296_187_486_762_3e-7,
];

/// −2 ln u for 2⁻⁵³ ≤ u < 1, within a relative error of 1e-15.
#[inline(always)]
fn minus_two_ln_of_share(u: f64) -> f64 {
    const FRACTION: u64 = (1 << 52) - 1;
    /// 2⁵²: exponent bits put into its fraction become a number.
    const TO_NUMBER: f64 = 4_503_599_627_370_496.0;
    // u = 2ᵏ·m, √½ ≤ m < √2
    let shifted = u.to_bits().wrapping_add(1.0_f64.to_bits() - FRAC_1_SQRT_2.to_bits());
    let k = f64::from_bits(TO_NUMBER.to_bits() | (shifted >> 52)) - (TO_NUMBER + 1023.0);
    let m = f64::from_bits((shifted & FRACTION) + FRAC_1_SQRT_2.to_bits());
    // −2 ln u = −2k ln 2 − 4 artanh s, s = (m − 1)/(m + 1)
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    let [l0, l1, l2, l3, l4, l5] = LN.map(|coefficient| -2.0 * coefficient);
    let series = l0 + z * (l1 + z * (l2 + z * (l3 + z * (l4 + z * l5))));
    k * (-2.0 * LN_2) + s * (z * series - 4.0)
}

/// sin 2πu and cos 2πu for u in [0, 1], within 1e-15.
#[inline(always)]
fn sin_cos_of_turn(u: f64) -> (f64, f64) {
    /// 1.5·2⁵²: adding it rounds to an integer, held in the lowest bits.
    const TO_INTEGER: f64 = 6_755_399_441_055_744.0;
    // 2πu = (n + f)·π/2, |f| ≤ ½
    let shifted = 4.0 * u + TO_INTEGER;
    let f = 4.0 * u - (shifted - TO_INTEGER);
    let z = f * f;
    let [s0, s1, s2, s3, s4, s5, s6] = SIN;
    let sin = f * (s0 + z * (s1 + z * (s2 + z * (s3 + z * (s4 + z * (s5 + z * s6))))));
    let [c0, c1, c2, c3, c4, c5, c6] = COS;
    let cos = c0 + z * (c1 + z * (c2 + z * (c3 + z * (c4 + z * (c5 + z * c6)))));
    // sin = sin, cos, −sin, −cos and cos = cos, −sin, −cos, sin for n = 0, 1, 2, 3 (mod 4)
    let n = shifted.to_bits();
    let (sin, cos) = if n & 1 == 1 { (cos, sin) } else { (sin, cos) };
    let sin_sign = (n << 62) & (1 << 63);
    let cos_sign = ((n << 62) ^ (n << 63)) & (1 << 63);
    (f64::from_bits(sin.to_bits() ^ sin_sign), f64::from_bits(cos.to_bits() ^ cos_sign))
}

/// φ(z) = e^(−z²/2)/√(2π)
fn density(z: f64) -> f64 {
    exp(-0.5 * z * z) / (2.0 * PI).sqrt()
}

/// Φ(z), within a relative error of 1e-14 for z < 0 (far out z²·1e-16, from the rounding of z²).
#[must_use]
pub fn cumulative(z: f64) -> f64 {
    /// From here on the continued fraction converges faster than the series loses digits.
    const TAIL: f64 = 1.5;
    if z > 0.0 {
        return 1.0 - cumulative(-z);
    }
    if z > -TAIL {
        // Φ(z) = ½ + φ(z)·(z + z³/3 + z⁵/(3·5) + …)
        let mut term = z;
        let mut sum = z;
        // Each term is at most 2.25/n of the one before: 20 of them end below 1e-17.
        for odd in (3_u8..=41).step_by(2) {
            term = term * z * z / f64::from(odd);
            sum += term;
        }
        return 0.5 + density(z) * sum;
    }
    // Φ(−t) = φ(t)/(t + 1/(t + 2/(t + 3/(t + …))))
    let t = -z;
    let density = density(t);
    // Bounds this far out are common, such as that a mass is greater than zero.
    if density == 0.0 {
        return 0.0;
    }
    // 200 levels give 1e-16 at t = 1.5; fewer are enough farther out.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 20 and 220")]
    let enough = (450.0 / (t * t) + 20.0) as u8;
    let levels = (1..=enough.min(200)).rev();
    density / levels.fold(t, |below, level| t + f64::from(level) / below)
}

// Numerator and denominator of Hart's fraction for Φ(−t)·exp(t²/2), up to [`SHARE_TAIL`].
const P: [f64; 7] = [
    220.206_867_912_376,
    221.213_596_169_931,
    112.079_291_497_871,
    33.912_866_078_383,
    6.373_962_203_531_65,
    0.700_383_064_443_688,
    0.035_262_496_599_891_1,
];
const Q: [f64; 8] = [
    440.413_735_824_752,
    793.826_512_519_948,
    637.333_633_378_831,
    296.564_248_779_674,
    86.780_732_202_946_1,
    16.064_177_579_207,
    1.755_667_163_182_64,
    0.088_388_347_648_318_4,
];

/// t from which a continued fraction takes over.
const SHARE_TAIL: f64 = 7.071_067_811_865_47;

/// Turns standard normal numbers into their probabilities Φ(z), at least 2⁻⁵³ and at most 1 − 2⁻⁵³, like
/// those of [`crate::random::unit`].
///
/// Within 1e-14 of the exact value; for z < 0 within a relative error of 1e-11 down to −4.5, 1e-8 down to −7
/// and 1e-7 below. Branch-free and so vectorised.
#[inline(always)]
pub fn shares<const N: usize>(lanes: &mut [f64; N]) {
    /// (–) 2⁻⁵³.
    const LEAST: f64 = f64::EPSILON / 2.0;
    for lane in lanes {
        let t = lane.abs();
        // Φ(−t) = exp(−t²/2) P(t)/Q(t)
        let p = P[0] + t * (P[1] + t * (P[2] + t * (P[3] + t * (P[4] + t * (P[5] + t * P[6])))));
        let q = Q[0] + t * (Q[1] + t * (Q[2] + t * (Q[3] + t * (Q[4] + t * (Q[5] + t * (Q[6] + t * Q[7]))))));
        // Φ(−t) = exp(−t²/2)/(√(2π) (t + 1/(t + 2/(t + 3/(t + 4/(t + 0.65))))))
        let far = ((2.0 * PI).sqrt() * (t + 1.0 / (t + 2.0 / (t + 3.0 / (t + 4.0 / (t + 0.65)))))).recip();
        let tail = exp(-0.5 * t * t) * if t < SHARE_TAIL { p / q } else { far };
        let tail = if tail < LEAST { LEAST } else { tail };
        *lane = if *lane > 0.0 { 1.0 - tail } else { tail };
    }
}

/// Mean and standard deviation of a standard normal variable truncated to [low, high].
///
/// In closed form if the interval includes all within one standard deviation. Otherwise by quadrature, whose
/// terms are all positive: the differences of the closed form cancel if the interval is narrow or far out.
pub(crate) fn truncated_moments(low: f64, high: f64) -> (f64, f64) {
    if low > -1.0 || high < 1.0 {
        return moments_by_quadrature(low, high);
    }
    let share = 1.0 - (cumulative(low) + cumulative(-high));
    // φ(z), and zφ(z), which is 0 at an infinite bound.
    let [at_low, at_high] = [low, high].map(density);
    let [times_low, times_high] =
        [(low, at_low), (high, at_high)].map(|(z, at)| if at > 0.0 { z * at } else { 0.0 });
    // μ = (φ(α) − φ(β))/(Φ(β) − Φ(α)),  σ² = 1 + (αφ(α) − βφ(β))/(Φ(β) − Φ(α)) − μ²
    let mean = (at_low - at_high) / share;
    let variance = 1.0 + (times_low - times_high) / share - mean * mean;
    (mean, variance.sqrt())
}

fn moments_by_quadrature(low: f64, high: f64) -> (f64, f64) {
    /// Beyond this the density is negligible compared with a kept probability of [`crate::MIN_KEPT`].
    const REACH: f64 = 12.0;
    const PANELS: u8 = 128;
    let (low, high) = (low.max(-REACH), high.min(REACH));
    let half = 0.5 * (high - low) / f64::from(PANELS);

    // Gauss's quadrature: nodes ±⅓√(5 ± 2√(10/7)) and 0, weights (322 ∓ 13√70)/900 and 128/225.
    let root = 2.0 * (10.0_f64 / 7.0).sqrt();
    let (near, far) = ((5.0 - root).sqrt() / 3.0, (5.0 + root).sqrt() / 3.0);
    let root = 13.0 * 70.0_f64.sqrt();
    let (near_weight, far_weight) = ((322.0 + root) / 900.0, (322.0 - root) / 900.0);
    let rule = [
        (-far, far_weight),
        (-near, near_weight),
        (0.0, 128.0 / 225.0),
        (near, near_weight),
        (far, far_weight),
    ];

    // ∫ f(z)·e^(−z²/2) dz, up to a factor
    let integral = |f: &dyn Fn(f64) -> f64| {
        let mut sum = 0.0;
        for panel in 0..PANELS {
            let middle = low + half * (2.0 * f64::from(panel) + 1.0);
            for (node, weight) in rule {
                let z = middle + half * node;
                sum += weight * f(z) * exp(-0.5 * z * z);
            }
        }
        sum
    };
    let mass = integral(&|_| 1.0);
    // Relative to the mode, so that no digits are lost if the interval is narrow and far from zero.
    let centre = 0.0_f64.clamp(low, high);
    let mean = centre + integral(&|z| z - centre) / mass;
    let variance = integral(&|z| (z - mean) * (z - mean)) / mass;
    (mean, variance.sqrt())
}

#[cfg(test)]
#[expect(clippy::excessive_precision, reason = "constants as they were computed, with all their digits")]
mod tests {
    use super::{cumulative, minus_two_ln_of_share, quantiles, shares, sin_cos_of_turn, truncated_moments};
    use crate::random::{bits, unit};
    use real::elementary::{ln, sin_cos};
    use std::f64::consts::TAU;

    fn quantile(p: f64) -> f64 {
        let mut lanes = [p];
        quantiles(&mut lanes);
        lanes[0]
    }

    fn assert_near(value: f64, exact: f64, relative: f64) {
        assert!((value - exact).abs() <= relative * exact.abs(), "{value} is not {exact}");
    }

    /// Values by mpmath 1.3 with 40 digits, for the `f64` nearest to the printed p.
    #[test]
    fn quantiles_are_those_of_forty_digits() {
        let table = [
            (0.6, 0.253_347_103_135_799_741_3),
            (0.9, 1.281_551_565_544_600_593_487),
            (0.95, 1.644_853_626_951_472_284_276),
            (0.975, 1.959_963_984_540_053_855_604),
            (0.99, 2.326_347_874_040_840_767_637),
            (0.995, 2.575_829_303_548_900_453_857),
            // Both sides of |p − ½| = 0.425, and of p = e⁻²⁵.
            (0.074, -1.446_632_067_158_978_509_863),
            (0.0763, -1.430_407_837_949_544_232_121),
            (0.925, 1.439_531_470_938_456_229_063),
            (0.001, -3.090_232_306_167_813_535_358),
            (1e-10, -6.361_340_902_404_056_199_1),
            (1.3e-11, -6.667_611_456_510_740_834_662),
            (f64::EPSILON / 2.0, -8.209_536_151_601_386_855_631),
            (1e-20, -9.262_340_089_798_407_579_572),
            (1e-100, -21.273_453_560_965_324_294_18),
            (1e-300, -37.047_096_299_361_199_236_55),
        ];
        for (p, exact) in table {
            assert_near(quantile(p), exact, 1e-15);
        }
        assert_eq!(quantile(0.5), 0.0);
        assert_eq!((quantile(0.0), quantile(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
    }

    /// Values by mpmath 1.3 with 40 digits.
    #[test]
    fn cumulative_shares_are_those_of_forty_digits() {
        let table = [
            (-0.5, 0.308_537_538_725_986_896_362_3),
            (-1.0, 0.158_655_253_931_457_051_414_8),
            (-2.0, 0.022_750_131_948_179_207_200_28),
            (-2.5, 0.006_209_665_325_776_135_166_978),
            (-3.0, 0.001_349_898_031_630_094_526_652),
            (-5.0, 2.866_515_718_791_939_116_738e-7),
            (-8.0, 6.220_960_574_271_784_123_516e-16),
            (-20.0, 2.753_624_118_606_233_695_076e-89),
            (-37.0, 5.725_571_222_524_576_822_683e-300),
            (0.25, 0.598_706_325_682_923_724_240_9),
            (1.75, 0.959_940_843_136_182_910_381_2),
            (4.0, 0.999_968_328_758_166_880_078_7),
        ];
        for (z, exact) in table {
            assert_near(cumulative(z), exact, 1e-14 + z * z * 1e-16);
        }
        assert_eq!(cumulative(0.0), 0.5);
        assert_eq!((cumulative(f64::NEG_INFINITY), cumulative(f64::INFINITY)), (0.0, 1.0));
    }

    /// Compared with the series and the continued fraction, which have nothing in common with Hart's
    /// fraction.
    #[test]
    fn shares_of_lanes_are_cumulative_shares() {
        for step in -8_000..=8_000 {
            let z = f64::from(step) / 1000.0;
            let mut lanes = [z];
            shares(&mut lanes);
            let exact = cumulative(z);
            assert!((lanes[0] - exact).abs() < 1e-14, "{z}: {} is not {exact}", lanes[0]);
            let relative = match z {
                z if z < -7.0 => 1e-7,
                z if z < -4.5 => 1e-8,
                _ => 1e-11,
            };
            assert!(z > 0.0 || (lanes[0] / exact - 1.0).abs() < relative, "{z}: {} is not {exact}", lanes[0]);
        }
        let mut lanes = [-40.0, 40.0, 0.0, f64::NEG_INFINITY, f64::INFINITY];
        shares(&mut lanes);
        let least = f64::EPSILON / 2.0;
        assert_eq!(lanes, [least, 1.0 - least, 0.5, least, 1.0 - least]);
    }

    /// Any number of tails, in any lanes.
    #[test]
    fn a_lane_of_a_block_has_the_bits_of_a_call() {
        for tails in 0..=64 {
            let shares: [f64; 64] = std::array::from_fn(|lane| {
                let shift = lane as f64 / 1000.0;
                if lane * 37 % 64 < tails { 0.001 + shift } else { 0.5 + shift }
            });
            let mut lanes = shares;
            quantiles(&mut lanes);
            assert!(lanes.iter().zip(shares).all(|(lane, share)| *lane == quantile(share)), "{tails} tails");
        }
    }

    /// Compared with the functions of `real`, which have their own tests.
    #[test]
    fn logarithm_and_turn_of_a_share_are_those_of_real() {
        let ends = [f64::EPSILON / 2.0, 0.5_f64.sqrt(), 0.25, 0.5, 0.75, 1.0 - f64::EPSILON / 2.0];
        let shares = ends.into_iter().chain((0..100_000).map(|index| unit(bits(5, index))));
        for u in shares.flat_map(|u| [u, u * 1e-9]).filter(|u| *u > 1e-16) {
            assert_near(minus_two_ln_of_share(u), -2.0 * ln(u), 1e-15);
            let (sin, cos) = sin_cos_of_turn(u);
            // 2π to 107 bits: its tail times u.
            let exact = sin_cos(TAU * u);
            let tail = 2.449_293_598_294_706_4e-16 * u;
            assert!((sin - (exact.0 + tail * exact.1)).abs() < 1.5e-15, "sin 2π·{u}");
            assert!((cos - (exact.1 - tail * exact.0)).abs() < 1.5e-15, "cos 2π·{u}");
        }
    }

    #[test]
    fn cumulative_undoes_quantile() {
        // An odd number of steps, so that no p is ½.
        for step in 1..2000 {
            let p = f64::from(step) / 2001.0;
            assert_near(cumulative(quantile(p)), p, 1e-14);
        }
    }

    /// Values by mpmath 1.3 with 40 digits, from the differences of densities.
    #[test]
    fn moments_of_a_truncated_normal_are_those_of_forty_digits() {
        let infinity = f64::INFINITY;
        let table = [
            (0.0, infinity, 0.797_884_560_802_865_355_88, 0.602_810_274_989_086_974_27),
            (-1.0, 2.0, 0.229_637_179_091_328_969_18, 0.720_945_586_859_045_788_77),
            (1.0, 1.5, 1.224_338_737_657_778_706_2, 0.142_368_996_501_650_052_64),
            (-infinity, -2.0, -2.373_215_532_822_840_867_3, 0.338_051_919_701_813_343_58),
            (3.0, 4.0, 3.260_454_285_590_021_153_9, 0.221_986_021_581_074_170_07),
            // Both sides of the limit of the closed form.
            (-1.0, 1.5, 0.145_187_447_152_526_173_160, 0.644_736_385_011_261_303_960),
            (-0.75, 3.0, 0.384_322_332_340_415_376_110, 0.736_564_640_008_173_111_944),
            (-1.25, infinity, 0.204_225_458_898_676_755_199, 0.838_456_998_488_460_913_953),
            (-2.5, infinity, 0.017_637_825_486_916_734_788, 0.977_545_059_521_453_074_116),
            (-6.0, 1.0, -0.287_599_964_054_794_396_583, 0.793_527_722_306_824_400_808),
            (-infinity, 2.0, -0.055_247_862_678_989_959_102, 0.941_515_771_674_284_567_433),
            (-1.5, 1.25, -0.064_203_900_116_254_042_541, 0.696_580_468_746_744_593_092),
        ];
        for (low, high, mean, sd) in table {
            let moments = truncated_moments(low, high);
            assert_near(moments.0, mean, 1e-14);
            assert_near(moments.1, sd, 1e-14);
        }
        let (mean, sd) = truncated_moments(-3.0, 3.0);
        assert!(mean.abs() < 1e-15);
        assert_near(sd, 0.986_578_392_558_108_621_27, 1e-14);
        // Bounds too far out to matter.
        for bounds in [(-infinity, infinity), (-50.0, infinity), (-40.0, 60.0)] {
            assert_eq!(truncated_moments(bounds.0, bounds.1), (0.0, 1.0));
        }
        // The bounds themselves are rounded to 1e-13 of their distance.
        let (mean, sd) = truncated_moments(0.1, 0.1001);
        assert_near(mean, 0.100_049_999_916_625_000_03, 1e-14);
        assert_near(sd, 0.000_028_867_513_454_597_795_012, 1e-11);
    }
}
