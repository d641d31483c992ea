//! Vectors with one number for each of eight motions.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use fearless_simd::{
    Bytes, ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask, f64x8, mask64x8, u64x8,
};
use real::elementary;

use crate::number::{Number, of_inverse_root, of_root};

/// Number of motions followed at once.
pub(crate) const LANES: usize = 8;

/// One number per lane. Each has the same bits as the same operation on a plain number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<S: Simd>(f64x8<S>);

/// One bit per lane.
#[derive(Clone, Copy)]
pub(crate) struct Mask<S: Simd>(mask64x8<S>);

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn splat(simd: S, number: f64) -> Self {
        Self(f64x8::splat(simd, number))
    }

    /// Puts a number into one lane.
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, number: f64) {
        self.0[lane] = number;
    }

    /// The number of one lane.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    fn bits(self) -> u64x8<S> {
        self.0.bitcast()
    }
}

impl<S: Simd> Mask<S> {
    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.0.any_true()
    }

    /// One bit per lane, the first lane in the lowest bit.
    #[inline(always)]
    pub(crate) fn bits(self) -> u64 {
        self.0.to_bitmask()
    }
}

macro_rules! operator {
    ($($Op:ident $op:ident)*) => {$(
        impl<S: Simd> $Op for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $op(self, other: Self) -> Self {
                Self(self.0.$op(other.0))
            }
        }

        impl<S: Simd> $Op<f64> for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $op(self, other: f64) -> Self {
                Self(self.0.$op(other))
            }
        }
    )*};
}

operator!(Add add Sub sub Mul mul Div div);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> Number for Lanes<S> {
    type Plain = Self;
    type Mask = Mask<S>;
    /// A separate function is compiled for the baseline instruction set, whose vectors hold two numbers.
    const CALLS: bool = <S::f64s as SimdBase<S>>::LEN == 2;

    #[inline(always)]
    fn plain(self) -> Self {
        self
    }

    #[inline(always)]
    fn scaled(self, by: Self) -> Self {
        self * by
    }

    #[inline(always)]
    fn constant(self, x: f64) -> Self {
        Self::splat(self.0.token(), x)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let angles: [f64; LANES] = self.0.into();
        let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            (sin[lane], cos[lane]) = elementary::sin_cos(angles[lane]);
        }
        let token = self.0.token();
        (Self(f64x8::simd_from(token, sin)), Self(f64x8::simd_from(token, cos)))
    }

    #[inline(always)]
    fn with_sign_of(self, other: Self) -> Self {
        Self(self.0.copysign(other.0))
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    #[inline(always)]
    fn rough_root(self, halvings: u32) -> Self {
        let bits = self.bits() >> halvings;
        Self((bits + u64x8::splat(bits.token(), of_root(halvings))).bitcast())
    }

    #[inline(always)]
    fn rough_inverse_root(self, halvings: u32) -> Self {
        let bits = self.bits() >> halvings;
        Self((u64x8::splat(bits.token(), of_inverse_root(halvings)) - bits).bitcast())
    }

    #[inline(always)]
    fn below(self, other: Self) -> Mask<S> {
        Mask(self.0.simd_lt(other.0))
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> Mask<S> {
        Mask(self.0.simd_ge(other.0))
    }

    #[inline(always)]
    fn select(mask: Mask<S>, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }

    #[inline(always)]
    fn select_mask(mask: Mask<S>, yes: Mask<S>, no: Mask<S>) -> Mask<S> {
        Mask((mask.0 & yes.0) | (!mask.0 & no.0))
    }

    #[inline(always)]
    fn both(one: Mask<S>, other: Mask<S>) -> Mask<S> {
        Mask(one.0 & other.0)
    }

    #[inline(always)]
    fn one_of(one: Mask<S>, other: Mask<S>) -> Mask<S> {
        Mask(one.0 | other.0)
    }

    #[inline(always)]
    fn certain(_: Mask<S>) -> Option<bool> {
        None
    }

    #[inline(always)]
    fn any(mask: Mask<S>) -> bool {
        mask.any()
    }
}
