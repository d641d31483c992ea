//! Sine, cosine, arctangent, logarithm and exponential of `f64`, with the same bits everywhere.
//!
//! Made of + − × ÷, comparisons, selects and bit operations only: no table, no branch, no fused
//! multiplication, no call. A plain loop over an array is therefore vectorised, and each lane has the bits of
//! a single call.
//!
//! # References
//!
//! Sun Microsystems, *fdlibm* 5.3 (1993): minimax coefficients of `k_sin.c`, `k_cos.c`, `s_atan.c`, `e_log.c`
//! and `e_exp.c`, parts of π/2 of `e_rem_pio2.c`. W. J. Cody and W. Waite, *Software Manual for the
//! Elementary Functions* (1980): reduction by parts of π/2. T. J. Dekker, *A floating-point technique for
//! extending the available precision*, Numer. Math. 18 (1971): splitting, exact products and sums. S. M.
//! Rump, T. Ogita and S. Oishi, *Accurate floating-point summation, part I*, SIAM J. Sci. Comput. 31 (2008):
//! when such sums are exact.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LOG2_E, SQRT_2};

/// (rad) the greatest angle, of either sign, that [`sin_cos`] takes: 2²⁰·π/2, about 1.6 million radians or
/// 262 144 turns.
///
/// Up to here the multiples of the parts of π/2 are exact.
pub const SIN_COS_LIMIT: f64 = 1_048_576.0 * FRAC_PI_2;

/// 1.5·2⁵²: the spacing of `f64` is 1 from here on, so adding it rounds to an integer, held in the lowest
/// bits.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

// π/2 in four parts (fdlibm `e_rem_pio2.c`). The first three end in 22, 21 and 25 zero bits, so their
// products with integers up to 2²⁰ are exact. Their sum is π/2 to 2⁻¹⁰³, and with the fourth to 2⁻¹⁵⁶.
const FRAC_PI_2_A: f64 = f64::from_bits(0x3FF9_21FB_5440_0000);
const FRAC_PI_2_B: f64 = f64::from_bits(0x3DD0_B461_1A60_0000);
const FRAC_PI_2_C: f64 = f64::from_bits(0x3BA3_198A_2E00_0000);
const FRAC_PI_2_D: f64 = f64::from_bits(0x397B_839A_2520_49C1);

// sin x ≈ x + S₁x³ + S₂x⁵ + … + S₆x¹³ on [−π/4, π/4] to 2⁻⁵⁸ (fdlibm `k_sin.c`).
const S1: f64 = f64::from_bits(0xBFC5_5555_5555_5549);
const S2: f64 = f64::from_bits(0x3F81_1111_1110_F8A6);
const S3: f64 = f64::from_bits(0xBF2A_01A0_19C1_61D5);
const S4: f64 = f64::from_bits(0x3EC7_1DE3_57B1_FE7D);
const S5: f64 = f64::from_bits(0xBE5A_E5E6_8A2B_9CEB);
const S6: f64 = f64::from_bits(0x3DE5_D93A_5ACF_D57C);

// cos x ≈ 1 − x²/2 + C₁x⁴ + C₂x⁶ + … + C₆x¹⁴ on [−π/4, π/4] to 2⁻⁵⁸ (fdlibm `k_cos.c`).
const C1: f64 = f64::from_bits(0x3FA5_5555_5555_554C);
const C2: f64 = f64::from_bits(0xBF56_C16C_16C1_5177);
const C3: f64 = f64::from_bits(0x3EFA_01A0_19CB_1590);
const C4: f64 = f64::from_bits(0xBE92_7E4F_809C_52AD);
const C5: f64 = f64::from_bits(0x3E21_EE9E_BDB4_B1C4);
const C6: f64 = f64::from_bits(0xBDA8_FAE9_BE88_38D4);

// atan t ≈ t − t·(A₀t² + A₁t⁴ + … + A₁₀t²²) on [−7/16, 7/16] (fdlibm `s_atan.c`).
const A0: f64 = f64::from_bits(0x3FD5_5555_5555_550D);
const A1: f64 = f64::from_bits(0xBFC9_9999_9998_EBC4);
const A2: f64 = f64::from_bits(0x3FC2_4924_9200_83FF);
const A3: f64 = f64::from_bits(0xBFBC_71C6_FE23_1671);
const A4: f64 = f64::from_bits(0x3FB7_45CD_C54C_206E);
const A5: f64 = f64::from_bits(0xBFB3_B0F2_AF74_9A6D);
const A6: f64 = f64::from_bits(0x3FB1_0D66_A0D0_3D51);
const A7: f64 = f64::from_bits(0xBFAD_DE2D_52DE_FD9A);
const A8: f64 = f64::from_bits(0x3FA9_7B4B_2476_0DEB);
const A9: f64 = f64::from_bits(0xBFA2_B444_2C6A_6C2F);
const A10: f64 = f64::from_bits(0x3F90_AD3A_E322_DA11);

/// π/4 − [`FRAC_PI_4`] (fdlibm `s_atan.c`).
const FRAC_PI_4_TAIL: f64 = f64::from_bits(0x3C81_A626_3314_5C07);

/// Ratio above which [`atan2`] measures the angle from the diagonal: the end of the polynomial's interval.
const FOLD: f64 = 0.4375;

// [`atan2`] scales its arguments by a power of two, and so exactly, if a sum could overflow or a product of
// low bits underflow.
const TWO_TO_1000: f64 = f64::from_bits(0x7E70_0000_0000_0000);
const TWO_TO_200: f64 = f64::from_bits(0x4C70_0000_0000_0000);
const TWO_TO_MINUS_100: f64 = f64::from_bits(0x39B0_0000_0000_0000);
const TWO_TO_MINUS_800: f64 = f64::from_bits(0x0DF0_0000_0000_0000);

/// 2⁻³⁰: below it atan t = t to a tenth of an ulp.
const TWO_TO_MINUS_30: f64 = f64::from_bits(0x3E10_0000_0000_0000);

// ln 2 in two parts (fdlibm `e_log.c`). The first ends in 21 zero bits, so its products with exponents are
// exact.
const LN_2_A: f64 = f64::from_bits(0x3FE6_2E42_FEE0_0000);
const LN_2_B: f64 = f64::from_bits(0x3DEA_39EF_3579_3C76);

// ln((1 + s)/(1 − s)) ≈ 2s + s·(L₁s² + L₂s⁴ + … + L₇s¹⁴) to 2⁻⁵⁸ (fdlibm `e_log.c`).
const L1: f64 = f64::from_bits(0x3FE5_5555_5555_5593);
const L2: f64 = f64::from_bits(0x3FD9_9999_9997_FA04);
const L3: f64 = f64::from_bits(0x3FD2_4924_9422_9359);
const L4: f64 = f64::from_bits(0x3FCC_71C5_1D8E_78AF);
const L5: f64 = f64::from_bits(0x3FC7_4664_96CB_03DE);
const L6: f64 = f64::from_bits(0x3FC3_9A09_D078_C69F);
const L7: f64 = f64::from_bits(0x3FC2_F112_DF3E_5244);

// r(eʳ + 1)/(eʳ − 1) ≈ 2 + P₁r² + P₂r⁴ + … + P₅r¹⁰ on [−½ln 2, ½ln 2] to 2⁻⁵⁹ (fdlibm `e_exp.c`).
const P1: f64 = f64::from_bits(0x3FC5_5555_5555_553E);
const P2: f64 = f64::from_bits(0xBF66_C16C_16BE_BD93);
const P3: f64 = f64::from_bits(0x3F11_566A_AF25_DE2C);
const P4: f64 = f64::from_bits(0xBEBB_BD41_C5D2_6BF1);
const P5: f64 = f64::from_bits(0x3E66_3769_72BE_A4D0);

/// Beyond ±[`EXP_LIMIT`] the exponential is infinite or zero: ln of the greatest `f64` is 709.8, and of half
/// the smallest −745.2.
const EXP_LIMIT: f64 = 746.0;

/// 2⁵⁴: makes every subnormal number normal.
const TWO_TO_54: f64 = f64::from_bits(0x4350_0000_0000_0000);
/// 2⁵²: exponent bits put into its mantissa become a number.
const TWO_TO_52: f64 = f64::from_bits(0x4330_0000_0000_0000);

const MANTISSA_BITS: u64 = (1 << 52) - 1;
const SIGN_BIT: u64 = 1 << 63;

/// Sine and cosine of an angle in radians.
///
/// For |x| ≤ [`SIN_COS_LIMIT`] each is within 1 ulp of the exact value, even near the multiples of π/2; the
/// greatest error found was below 0.8 ulp, near the odd multiples of π/4. Beyond the limit, and for
/// infinities and NaN, both are NaN. sin(−x) = −sin x and cos(−x) = cos x to the bit; sin(−0) = −0.
#[inline(always)]
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    let angle = x.abs();

    // n = round(|x|·2/π)
    let shifted = angle * FRAC_2_PI + TO_INTEGER;
    let n = shifted - TO_INTEGER;
    let quadrant = shifted.to_bits();
    let (r, r_tail) = reduce(angle, n);
    let (sin_r, cos_r) = (sin_kernel(r, r_tail), cos_kernel(r, r_tail));

    // sin(r + nπ/2) = sin r, cos r, −sin r, −cos r for n = 0, 1, 2, 3 (mod 4)
    // cos(r + nπ/2) = cos r, −sin r, −cos r, sin r
    let odd = quadrant & 1 == 1;
    let (sin, cos) = if odd { (cos_r, sin_r) } else { (sin_r, cos_r) };
    let sin_sign = ((quadrant << 62) ^ x.to_bits()) & SIGN_BIT;
    let cos_sign = ((quadrant << 62) ^ (quadrant << 63)) & SIGN_BIT;
    let sin = f64::from_bits(sin.to_bits() ^ sin_sign);
    let cos = f64::from_bits(cos.to_bits() ^ cos_sign);

    // The comparison is false for NaN too.
    if angle <= SIN_COS_LIMIT { (sin, cos) } else { (f64::NAN, f64::NAN) }
}

/// x − n·π/2 as a sum of two numbers, for 0 ≤ x ≤ [`SIN_COS_LIMIT`] and n the integer nearest to x·2/π.
///
/// No `f64` in this range is nearer than 2⁻⁶¹ to a multiple of π/2; the remainder is still good to more than
/// 53 bits there.
#[inline(always)]
fn reduce(x: f64, n: f64) -> (f64, f64) {
    // Exact: the two are within a factor of two of each other.
    // a = x − n·A
    let a = x - n * FRAC_PI_2_A;
    // For n ≥ 1, a is a multiple of 2⁻⁵³ and the last place of n·B is at most 2⁻⁶⁶.
    // b + b′ = a − n·B
    let (b, b_tail) = exact_sum(a, -(n * FRAC_PI_2_B));
    // b is a multiple of 2⁻⁶⁶ and the last place of n·C is at most 2⁻¹⁰¹.
    // c + c′ = b − n·C
    let (c, c_tail) = exact_sum(b, -(n * FRAC_PI_2_C));
    // d = b′ + c′ − n·D
    let d = (b_tail + c_tail) - n * FRAC_PI_2_D;
    // r + r′ = c + d
    exact_sum(c, d)
}

/// sin(r + r′) for r in [−π/4, π/4] and a tail r′ below an ulp of r.
#[inline(always)]
fn sin_kernel(r: f64, r_tail: f64) -> f64 {
    let z = r * r;
    let cube = z * r;
    // p = S₂ + S₃z + S₄z² + S₅z³ + S₆z⁴
    let p = S2 + z * (S3 + z * (S4 + z * (S5 + z * S6)));
    // sin(r + r′) ≈ r + (S₁r³ + (r′ + z(p·r³ − r′/2)))
    r + (cube * S1 + (r_tail + z * (cube * p - 0.5 * r_tail)))
}

/// cos(r + r′) for r in [−π/4, π/4] and a tail r′ below an ulp of r.
#[inline(always)]
fn cos_kernel(r: f64, r_tail: f64) -> f64 {
    let z = r * r;
    let half = 0.5 * z;
    // h + h′ = 1 − z/2
    let (h, h_tail) = exact_sum(1.0, -half);
    // p = C₁z + C₂z² + … + C₆z⁶
    let p = z * (C1 + z * (C2 + z * (C3 + z * (C4 + z * (C5 + z * C6)))));
    // cos(r + r′) ≈ h + (h′ + (z·p − r·r′))
    h + (h_tail + (z * p - r * r_tail))
}

/// Angle in radians, in [−π, π], of the vector `(x, y)`.
///
/// Within 1 ulp of the exact value for all finite arguments, however great, small or unequal: no intermediate
/// result overflows, and underflow loses nothing that the result can hold. The greatest error found was below
/// 0.7 ulp, for ratios near 7/16. Zeros and infinities, with their signs, give what IEEE 754 and C specify
/// for `atan2`: atan2(±0, −0) = ±π, atan2(±∞, −∞) = ±3π/4. NaN in either gives NaN. atan2(−y, x) = −atan2(y,
/// x) to the bit.
#[inline(always)]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let steep = y.abs() > x.abs();
    let (least, most) = if steep { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
    let (least, most) = scale(least, most);

    // Beyond 7/16 of the diagonal: atan(l/m) = π/4 + atan((l − m)/(l + m))
    let fold = least > FOLD * most;
    let (p, p_tail) = if fold { exact_sum(-most, least) } else { (least, 0.0) };
    let (q, q_tail) = if fold { exact_sum(most, least) } else { (most, 0.0) };
    let t = p / q;
    let z = t * t;

    // Without the rounding error of the quotient, the error just below a power of two would exceed 1 ulp.
    // t′ = ((p + p′) − t·(q + q′))/q
    let t_tail = ((residual(p, t, q) + p_tail) - t * q_tail) / q;
    // Below 2⁻³⁰ the rounded quotient is the rounded angle already, and the residual could underflow.
    let t_tail = if least < TWO_TO_MINUS_30 * most { 0.0 } else { t_tail };

    // atan(t + t′) ≈ t − s, s = t·(A₀z + A₁z² + … + A₁₀z¹¹) − t′(1 − z)
    let p = z
        * (A0
            + z * (A1
                + z * (A2
                    + z * (A3 + z * (A4 + z * (A5 + z * (A6 + z * (A7 + z * (A8 + z * (A9 + z * A10))))))))));
    let s = t * p - t_tail * (1.0 - z);

    // The angle is k·π/4 ± atan t.
    let (k, sign) = if fold { (1.0, 1.0) } else { (0.0, 1.0) };
    // φ = π/2 − φ where |y| > |x|
    let (k, sign) = if steep { (2.0 - k, -sign) } else { (k, sign) };
    // φ = π − φ where x < 0
    let (k, sign) = if x.is_sign_negative() { (4.0 - k, -sign) } else { (k, sign) };

    // `FRAC_PI_4` ends in three zero bits, so k·π/4 is exact.
    // φ = k·π/4 ± (t − s)
    let (angle, angle_tail) = exact_sum(k * FRAC_PI_4, sign * t);
    let angle = angle + (angle_tail + (k * FRAC_PI_4_TAIL - sign * s));

    if x.is_nan() || y.is_nan() { f64::NAN } else { angle.copysign(y) }
}

/// Natural logarithm.
///
/// Within 1 ulp of the exact value for all positive finite arguments, subnormal ones too; the greatest error
/// found was below 0.7 ulp. −∞ for either zero, NaN for negative numbers and NaN, +∞ for +∞.
#[inline(always)]
#[must_use]
pub fn ln(x: f64) -> f64 {
    // x = 2ᵏ·(1 + f), √½ ≤ 1 + f < √2
    let subnormal = x < f64::MIN_POSITIVE;
    let bits = if subnormal { x * TWO_TO_54 } else { x }.to_bits();
    let bias = if subnormal { 1023.0 + 54.0 } else { 1023.0 };
    let exponent = f64::from_bits(TWO_TO_52.to_bits() | (bits >> 52)) - TWO_TO_52;
    let mantissa = f64::from_bits(1.0_f64.to_bits() | (bits & MANTISSA_BITS));
    let great = mantissa >= SQRT_2;
    let f = if great { 0.5 * mantissa } else { mantissa } - 1.0;
    let k = if great { exponent + 1.0 } else { exponent } - bias;

    // ln(1 + f) = 2 artanh s = f − (f²/2 − s·(f²/2 + p)), s = f/(2 + f), p = L₁s² + L₂s⁴ + … + L₇s¹⁴
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let p = z * (L1 + z * (L2 + z * (L3 + z * (L4 + z * (L5 + z * (L6 + z * L7))))));
    // For k ≠ 0, |k·A| > |f|.
    // h + h′ = k·A + f
    let (h, h_tail) = exact_sum(k * LN_2_A, f);
    // g + g′ = h − f²/2
    let (g, g_tail) = exact_sum(h, -half_square);
    // ln x = k ln 2 + ln(1 + f)
    let logarithm = g + (g_tail + (h_tail + (s * (half_square + p) + k * LN_2_B)));

    let logarithm = if x == f64::INFINITY { x } else { logarithm };
    let logarithm = if x == 0.0 { f64::NEG_INFINITY } else { logarithm };
    // The comparison is false for NaN too.
    if x >= 0.0 { logarithm } else { f64::NAN }
}

/// eˣ.
///
/// Within 1 ulp of the exact value for all arguments, even if it is subnormal; the greatest error found was
/// below 0.95 ulp. Infinite above 709.78, zero below −745.13, NaN for NaN.
#[inline(always)]
#[must_use]
pub fn exp(x: f64) -> f64 {
    let clamped = if x > EXP_LIMIT { EXP_LIMIT } else { x };
    let clamped = if clamped < -EXP_LIMIT { -EXP_LIMIT } else { clamped };

    // x = k ln 2 + r, |r| ≤ ½ ln 2
    let shifted = clamped * LOG2_E + TO_INTEGER;
    let k = shifted - TO_INTEGER;
    let high = clamped - k * LN_2_A;
    let low = k * LN_2_B;
    let r = high - low;

    // eʳ = 1 + r + r·c/(2 − c), c = r − (P₁r² + P₂r⁴ + … + P₅r¹⁰)
    let z = r * r;
    let c = r - z * (P1 + z * (P2 + z * (P3 + z * (P4 + z * P5))));
    let power = 1.0 + (high - (low - r * c / (2.0 - c)));

    // 2ᵏ in two factors, since it may lie outside the normal numbers although eˣ does not. Only the second
    // product is rounded. 2ᵏ = 2ᵏ′·2ᵏ″, k′ = ⌊k/2⌋, k″ = k − k′
    let halves = shifted.to_bits().wrapping_sub(TO_INTEGER.to_bits()).wrapping_add(2046);
    let first = f64::from_bits((halves >> 1) << 52);
    let second = f64::from_bits((halves - (halves >> 1)) << 52);
    power * first * second
}

/// √x, rounded correctly: the same bits as the processor's instruction, for builds without the standard
/// library. NaN below zero, −0 for −0.
#[must_use]
pub fn sqrt(x: f64) -> f64 {
    if x.is_nan() || x < 0.0 {
        return f64::NAN;
    }
    if x == 0.0 || x == f64::INFINITY {
        return x;
    }
    let subnormal = x < f64::MIN_POSITIVE;
    let bits = if subnormal { x * TWO_TO_54 } else { x }.to_bits();
    let mantissa = u128::from((bits & MANTISSA_BITS) | (1 << 52));
    // x = m 2ᵉ, e = exponent − 1075, and 54 less where x was scaled
    let exponent = (bits >> 52) + if subnormal { 2048 - 1075 - 54 } else { 2048 - 1075 };
    // m 2ᵉ = s 2²ʰ with 2¹⁰⁸ ≤ s < 2¹¹⁰ and 2h = e − 56, or e − 57 where e is odd; all counted from 2048.
    let square = mantissa << (56 + (exponent & 1));
    let half = (exponent - (exponent & 1)) / 2 - 28;
    let root = square.isqrt();
    // The last bit (sticky bit) is set if there is a remainder: with it the conversion rounds as if the root
    // were exact.
    let sticky = u128::from(root * root != square);
    #[expect(clippy::cast_precision_loss, reason = "it is the rounding that is wanted")]
    let rounded = (root << 1 | sticky) as f64;
    // √x = root 2ʰ, and h lies between −565 and 484.
    rounded * f64::from_bits((half + 1023 - 1024 - 1) << 52)
}

/// The least integer that is not below x: exact, with the sign of x if it is zero. Infinities and NaN are
/// returned unchanged.
#[inline(always)]
#[must_use]
pub fn ceil(x: f64) -> f64 {
    let size = x.abs();
    // Beyond 2⁵² every number is an integer; below, the sum rounds to an integer.
    let nearest = if size < TWO_TO_52 { (size + TWO_TO_52) - TWO_TO_52 } else { size };
    let nearest = nearest.copysign(x);
    if nearest < x { (nearest + 1.0).copysign(x) } else { nearest }
}

/// Scales `least` ≤ `most` together so that their sum is finite and a product with their ratio keeps its low
/// bits.
///
/// Two infinities count as equal, two zeros as 0/1. If `most` is finite the scaling is exact, unless the
/// ratio is below the smallest `f64` anyway.
#[inline(always)]
fn scale(least: f64, most: f64) -> (f64, f64) {
    let factor = if most > TWO_TO_1000 { TWO_TO_MINUS_100 } else { 1.0 };
    let factor = if most < TWO_TO_MINUS_800 { TWO_TO_200 } else { factor };
    let finite = (least * factor, if most == 0.0 { 1.0 } else { most * factor });
    let infinite = (if least == f64::INFINITY { 1.0 } else { 0.0 }, 1.0);
    if most == f64::INFINITY { infinite } else { finite }
}

/// a + b as the rounded sum and its rounding error (Dekker).
///
/// Needs a to be a multiple of the last place of b (Rump, Ogita, Oishi), as it is for |a| ≥ |b| and for a =
/// 0.
#[inline(always)]
fn exact_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, (a - sum) + b)
}

/// a − t·b for t = a/b rounded, so that a and t·b agree to 52 bits: good to about 50 bits of its own.
#[inline(always)]
fn residual(a: f64, t: f64, b: f64) -> f64 {
    let (t_head, b_head) = (head(t), head(b));
    let (t_rest, b_rest) = (t - t_head, b - b_head);
    // a − t·b = ((a − t₁b₁) − t₁b₂ − t₂b₁) − t₂b₂
    (((a - t_head * b_head) - t_head * b_rest) - t_rest * b_head) - t_rest * b_rest
}

/// The leading 26 bits, so that a product of two of them is exact.
#[inline(always)]
fn head(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & !((1 << 27) - 1))
}
