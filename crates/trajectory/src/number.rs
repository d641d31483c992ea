//! The numbers of tyres, field and steps: any [`Real`], or lanes.

use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use real::Real;

/// The operations that the equations of motion need. They select by masks and are branch-free.
pub(crate) trait Number:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + AddAssign
{
    /// The number without derivatives.
    type Plain: Number<Plain = Self::Plain, Mask = Self::Mask>;
    /// The result of a comparison.
    type Mask: Copy;
    /// Whether the forces are a function call. For a number with derivatives they are thousands of
    /// instructions, and a step that inlines them eight times takes the compiler most of a minute. Lanes need
    /// inlining.
    const CALLS: bool;

    fn plain(self) -> Self::Plain;

    /// The product with a number without derivatives.
    fn scaled(self, by: Self::Plain) -> Self;

    /// The constant `x`.
    fn constant(self, x: f64) -> Self;

    fn sqrt(self) -> Self;

    fn abs(self) -> Self;

    fn sin_cos(self) -> (Self, Self);

    /// `self` < `other`; false for NaN.
    fn below(self, other: Self) -> Self::Mask;

    /// `self` ≥ `other`; false for NaN.
    fn at_least(self, other: Self) -> Self::Mask;

    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    fn select_mask(mask: Self::Mask, yes: Self::Mask, no: Self::Mask) -> Self::Mask;

    /// Whether both hold.
    #[inline(always)]
    fn both(one: Self::Mask, other: Self::Mask) -> Self::Mask {
        Self::select_mask(one, other, one)
    }

    /// Whether at least one of two holds.
    #[inline(always)]
    fn one_of(one: Self::Mask, other: Self::Mask) -> Self::Mask {
        Self::select_mask(one, one, other)
    }

    /// The square root applied `halvings` times to a positive number, without derivatives. It may be off by a
    /// few per cent.
    fn rough_root(self, halvings: u32) -> Self;

    /// The reciprocal of that root, equally rough.
    fn rough_inverse_root(self, halvings: u32) -> Self;

    /// The number, which is not negative, with the sign of `other`.
    fn with_sign_of(self, other: Self) -> Self;

    /// `other` if either is NaN.
    fn lesser(self, other: Self) -> Self;

    /// `other` if either is NaN.
    fn greater(self, other: Self) -> Self;

    /// 1/x.
    #[inline(always)]
    fn reciprocal(self) -> Self {
        self.constant(1.0) / self
    }

    /// The mask as a `bool` for a single number; `None` for lanes.
    fn certain(mask: Self::Mask) -> Option<bool>;

    /// Whether the mask holds in any lane.
    fn any(mask: Self::Mask) -> bool;
}

/// Selects `$yes` where the mask holds, else `$no`. A single number evaluates only one of them. It is a macro
/// because closures are not always inlined, and the computation of lanes must be.
macro_rules! choose {
    ($T:ty, $mask:expr, $yes:expr, $no:expr $(,)?) => {{
        let mask = $mask;
        match <$T as $crate::number::Number>::certain(mask) {
            Some(true) => $yes,
            Some(false) => $no,
            None => $crate::number::Choice::<$T>::select(mask, $yes, $no),
        }
    }};
}
pub(crate) use choose;

/// The same for a mask that rarely holds: lanes evaluate `$rare` only if one of them needs it.
macro_rules! rarely {
    ($T:ty, $mask:expr, $rare:expr, $usual:expr $(,)?) => {{
        let mask = $mask;
        match <$T as $crate::number::Number>::certain(mask) {
            Some(true) => $rare,
            Some(false) => $usual,
            None => {
                let usual = $usual;
                if <$T as $crate::number::Number>::any(mask) {
                    $crate::number::Choice::<$T>::select(mask, $rare, usual)
                } else {
                    usual
                }
            }
        }
    }};
}
pub(crate) use rarely;

/// A value that a mask can select.
pub(crate) trait Choice<T: Number> {
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self;
}

impl<T: Number> Choice<T> for T {
    #[inline(always)]
    fn select(mask: T::Mask, yes: T, no: T) -> T {
        <T as Number>::select(mask, yes, no)
    }
}

impl<T: Real> Number for T {
    type Plain = f64;
    type Mask = bool;
    const CALLS: bool = size_of::<T>() > size_of::<f64>();

    #[inline(always)]
    fn plain(self) -> f64 {
        self.value()
    }

    #[inline(always)]
    fn scaled(self, by: f64) -> Self {
        self * by
    }

    #[inline(always)]
    fn constant(self, x: f64) -> Self {
        Self::from(x)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Real::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Real::abs(self)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        Real::sin_cos(self)
    }

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self.value() < other.value()
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> bool {
        self.value() >= other.value()
    }

    #[inline(always)]
    fn with_sign_of(self, other: Self) -> Self {
        if other.value().is_sign_negative() { -self } else { self }
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        if self.value() < other.value() { self } else { other }
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        if self.value() > other.value() { self } else { other }
    }

    #[inline(always)]
    fn rough_root(self, halvings: u32) -> Self {
        let bits = (self.value().to_bits() >> halvings) + of_root(halvings);
        Self::from(f64::from_bits(bits))
    }

    #[inline(always)]
    fn rough_inverse_root(self, halvings: u32) -> Self {
        let bits = of_inverse_root(halvings) - (self.value().to_bits() >> halvings);
        Self::from(f64::from_bits(bits))
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn select_mask(mask: bool, yes: bool, no: bool) -> bool {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn certain(mask: bool) -> Option<bool> {
        Some(mask)
    }

    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
}

/// The bits of a number, as an integer, are nearly linear in its logarithm: those of a root of x are those of
/// x, shifted, plus these.
#[inline(always)]
pub(crate) const fn of_root(halvings: u32) -> u64 {
    ONE - (ONE >> halvings)
}

/// The sum of the bits of the reciprocal of such a root and of those of x, shifted.
#[inline(always)]
pub(crate) const fn of_inverse_root(halvings: u32) -> u64 {
    ONE + (ONE >> halvings)
}

const ONE: u64 = 1.0_f64.to_bits();

/// Sine and cosine of an angle (rad) within a step: the omitted terms, x⁹/9! and x⁸/8!, are far below the
/// error of the step.
#[inline(always)]
pub(crate) fn direction_within_step<T: Number>(x: T) -> Direction<T> {
    rarely!(T, x.abs().plain().at_least(x.plain().constant(SMALL_TURN)), Direction::of(x), {
        let z = x * x;
        // sin x = x − x³/3! + x⁵/5! − x⁷/7!, cos x = 1 − x²/2! + x⁴/4! − x⁶/6!
        let sin = z * (z * INVERSE_FACTORIALS[7] - INVERSE_FACTORIALS[5]) + INVERSE_FACTORIALS[3];
        let cos = z * (z * INVERSE_FACTORIALS[6] - INVERSE_FACTORIALS[4]) + INVERSE_FACTORIALS[2];
        let one = x.constant(1.0);
        Direction { sin: x * (one - z * sin), cos: one - z * cos }
    },)
}

/// Sine and cosine of an angle (rad), by their series if it is small.
#[inline(always)]
pub(crate) fn direction_of_turn<T: Number>(x: T) -> Direction<T> {
    rarely!(T, x.abs().plain().at_least(x.plain().constant(SMALL_TURN)), Direction::of(x), {
        let z = x * x;
        let square = z * z;
        // sin x = x − x³/3! + x⁵/5! − …, cos x = 1 − x²/2! + x⁴/4! − …, in pairs of terms
        let sin = (z * INVERSE_FACTORIALS[5] - INVERSE_FACTORIALS[3])
            + square
                * ((z * INVERSE_FACTORIALS[9] - INVERSE_FACTORIALS[7])
                    + square * (z * INVERSE_FACTORIALS[13] - INVERSE_FACTORIALS[11]));
        let cos = (z * INVERSE_FACTORIALS[4] - INVERSE_FACTORIALS[2])
            + square
                * ((z * INVERSE_FACTORIALS[8] - INVERSE_FACTORIALS[6])
                    + square * (z * INVERSE_FACTORIALS[12] - INVERSE_FACTORIALS[10]));
        Direction { sin: x + x * (z * sin), cos: z * cos + 1.0 }
    },)
}

/// Sine and cosine of an angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direction<T> {
    pub(crate) sin: T,
    pub(crate) cos: T,
}

impl<T: Number> Direction<T> {
    #[inline(always)]
    pub(crate) fn of(angle: T) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
    }

    #[inline(always)]
    pub(crate) fn plain(self) -> Direction<T::Plain> {
        Direction { sin: self.sin.plain(), cos: self.cos.plain() }
    }

    /// Sine and cosine of the sum of two angles.
    #[inline(always)]
    pub(crate) fn turned(self, by: Self) -> Self {
        Self { sin: self.sin * by.cos + self.cos * by.sin, cos: self.cos * by.cos - self.sin * by.sin }
    }
}

impl<T: Number> Choice<T> for Direction<T> {
    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self {
            sin: <T as Number>::select(mask, yes.sin, no.sin),
            cos: <T as Number>::select(mask, yes.cos, no.cos),
        }
    }
}

/// (rad) up to here the omitted terms of the series, x¹⁵/15! and x¹⁴/14!, are below the rounding of 1.
const SMALL_TURN: f64 = 0.5;

const INVERSE_FACTORIALS: [f64; 14] = {
    let mut inverse = [1.0; 14];
    let (mut n, mut factorial) = (1, 1.0);
    while n < 14 {
        #[expect(clippy::cast_precision_loss, reason = "n is at most 13")]
        let by = n as f64;
        factorial *= by;
        inverse[n] = 1.0 / factorial;
        n += 1;
    }
    inverse
};

/// The values for 0 to 3, as [`three`].
#[inline(always)]
pub(crate) fn four<R>(value: impl Fn(usize) -> R) -> [R; 4] {
    [value(0), value(1), value(2), value(3)]
}

/// The values for 0, 1 and 2; unlike `map` of an array it is always inlined.
#[inline(always)]
pub(crate) fn three<R>(value: impl Fn(usize) -> R) -> [R; 3] {
    [value(0), value(1), value(2)]
}
