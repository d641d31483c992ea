//! The operators of numbers that carry others.

/// An operator on two numbers, and on a number with an `f64` on its right: the result for the first, and for
/// the second.
macro_rules! operator {
    (
        $(#[$attribute:meta])*
        $Type:ident: $Op:ident $op:ident $Assign:ident $assign:ident |$x:ident, $y:ident| $both:expr, $plain:expr
    ) => {
        impl<const N: usize> $Op for $Type<N> {
            type Output = Self;

            $(#[$attribute])*
            #[inline(always)]
            fn $op(self, $y: Self) -> Self {
                let $x = self;
                $both
            }
        }

        impl<const N: usize> $Op<f64> for $Type<N> {
            type Output = Self;

            #[inline(always)]
            fn $op(self, $y: f64) -> Self {
                let $x = self;
                $plain
            }
        }

        impl<const N: usize> $Assign for $Type<N> {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = self.$op(other);
            }
        }
    };
}

pub(crate) use operator;
