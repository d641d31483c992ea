//! A number that records how it was computed (reverse-mode differentiation).

use core::cell::RefCell;
use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::Real;

/// A number within [`gradients`]. Every operation on it is recorded, so that the derivatives with respect to
/// all inputs follow at once.
///
/// It belongs to the call that made it and to the thread of that call. Afterwards it is a constant, and a
/// nested call must not use it.
#[derive(Clone, Copy, Debug)]
pub struct Traced {
    value: f64,
    /// Its place in the record.
    place: usize,
}

/// The place of a number that does not depend on any input.
const CONSTANT: usize = usize::MAX;

/// How one number was computed: its two operands ([`CONSTANT`] if there is none) and the derivatives with
/// respect to them.
struct Step {
    of: [usize; 2],
    by: [f64; 2],
}

std::thread_local! {
    /// The record of the running call of [`gradients`].
    static RECORD: RefCell<Option<Vec<Step>>> = const { RefCell::new(None) };
}

/// A result and its derivatives.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gradient {
    /// The result itself.
    pub value: f64,
    /// Its derivative with respect to each input, in the order of the inputs.
    pub by: Vec<f64>,
}

/// Evaluates a formula once, and differentiates each result with respect to every input.
///
/// For few inputs, [`Duals`](crate::Duals) are quicker. The time taken here does not grow with the number of
/// inputs: each result takes a few times as long as the formula. The record takes 32 bytes per operation of
/// the formula.
///
/// ```
/// // SAE 980025, appendix: the GMC Jimmy of 3696 lb took 1.02e5 N·m of crush. Its energy equivalent speed:
/// let [speed] = &real::gradients(&[1.02e5, 1676.5], |inputs| {
///     let [energy, mass] = *inputs else { return Err("two inputs") };
///     // EES = √(2E/m)
///     Ok(vec![real::Real::sqrt(energy * 2.0 / mass)])
/// })?[..] else { return Err("one result") };
/// assert!((speed.value - 11.03).abs() < 0.005);
/// // dEES/dE = EES/2E, dEES/dm = −EES/2m
/// assert!((speed.by[0] * 2.0 * 1.02e5 / speed.value - 1.0).abs() < 1e-14);
/// assert!((speed.by[1] * 2.0 * 1676.5 / speed.value + 1.0).abs() < 1e-14);
/// # Ok::<(), &str>(())
/// ```
///
/// # Errors
/// Those of the formula.
pub fn gradients<E>(
    inputs: &[f64],
    formula: impl FnOnce(&[Traced]) -> Result<Vec<Traced>, E>,
) -> Result<Vec<Gradient>, E> {
    let traced: Vec<Traced> =
        inputs.iter().enumerate().map(|(place, &value)| Traced { value, place }).collect();
    let record = inputs.iter().map(|_| Step { of: [CONSTANT; 2], by: [0.0; 2] }).collect();
    // A formula may call `gradients` itself; its own record is put back afterwards.
    let outer = RECORD.replace(Some(record));
    let results = formula(&traced);
    let record = RECORD.replace(outer).unwrap_or_default();
    Ok(results?.into_iter().map(|result| result.gradient(&record, inputs.len())).collect())
}

impl Traced {
    /// A number computed from two others, with the derivatives with respect to them.
    #[inline]
    fn computed(value: f64, of: [Self; 2], by: [f64; 2]) -> Self {
        let of = of.map(|number| number.place);
        if of == [CONSTANT; 2] {
            return Self::from(value);
        }
        Self { value, place: written(Step { of, by }) }
    }

    /// A number computed from one other.
    #[inline]
    fn computed_from(value: f64, of: Self, by: f64) -> Self {
        Self::computed(value, [of, Self::ZERO], [by, 0.0])
    }

    /// The chain rule, from the result back to the inputs, which are the first steps.
    fn gradient(self, record: &[Step], inputs: usize) -> Gradient {
        let mut by = vec![0.0; record.len()];
        if let Some(own) = by.get_mut(self.place) {
            *own = 1.0;
        }
        for (place, step) in record.iter().enumerate().skip(inputs).rev() {
            let of_result = by[place];
            // A number on which the result does not depend may have an infinite derivative.
            if of_result == 0.0 {
                continue;
            }
            for (&of, derivative) in step.of.iter().zip(step.by) {
                if let Some(sum) = by.get_mut(of) {
                    // dr/dx = Σ (dr/dy) (∂y/∂x)
                    *sum += of_result * derivative;
                }
            }
        }
        by.truncate(inputs);
        Gradient { value: self.value, by }
    }
}

/// Appends a step to the record and returns its place. Not inlined: every operation of every formula appends
/// one, and the inlined pushes would be most of the program.
#[inline(never)]
fn written(step: Step) -> usize {
    let place = RECORD.with_borrow_mut(|record| {
        let record = record.as_mut()?;
        record.push(step);
        Some(record.len() - 1)
    });
    place.unwrap_or(CONSTANT)
}

impl PartialEq for Traced {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Traced {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl From<f64> for Traced {
    #[inline]
    fn from(value: f64) -> Self {
        Self { value, place: CONSTANT }
    }
}

impl Neg for Traced {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::computed_from(-self.value, self, -1.0)
    }
}

/// An operator on two numbers, and on a number with an `f64` on its right.
macro_rules! operator {
    ($Op:ident $op:ident $Assign:ident $assign:ident: |$x:ident, $y:ident| $value:expr, $by:expr) => {
        impl $Op for Traced {
            type Output = Self;

            #[inline]
            fn $op(self, other: Self) -> Self {
                let ($x, $y) = (self.value, other.value);
                Self::computed($value, [self, other], $by)
            }
        }

        impl $Op<f64> for Traced {
            type Output = Self;

            #[inline]
            fn $op(self, other: f64) -> Self {
                self.$op(Self::from(other))
            }
        }

        impl $Assign for Traced {
            #[inline]
            fn $assign(&mut self, other: Self) {
                *self = self.$op(other);
            }
        }
    };
}

operator!(Add add AddAssign add_assign: |x, y| x + y, [1.0, 1.0]);
operator!(Sub sub SubAssign sub_assign: |x, y| x - y, [1.0, -1.0]);
// ∂(x y)/∂x = y, ∂(x y)/∂y = x
operator!(Mul mul MulAssign mul_assign: |x, y| x * y, [y, x]);
// ∂(x/y)/∂x = 1/y, ∂(x/y)/∂y = −(x/y)/y
operator!(Div div DivAssign div_assign: |x, y| x / y, [1.0 / y, -(x / y) / y]);

impl Real for Traced {
    const ZERO: Self = Self { value: 0.0, place: CONSTANT };
    const ONE: Self = Self { value: 1.0, place: CONSTANT };

    #[inline]
    fn value(self) -> f64 {
        self.value
    }

    #[inline]
    fn sqrt(self) -> Self {
        let root = f64::sqrt(self.value);
        // (√x)′ = 1/(2√x)
        Self::computed_from(root, self, 0.5 / root)
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(self.value);
        (Self::computed_from(sin, self, cos), Self::computed_from(cos, self, -sin))
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        let (y, x_value) = (self.value, x.value);
        let square = x_value * x_value + y * y;
        // ∂atan2(y, x)/∂y = x/(x² + y²), ∂atan2(y, x)/∂x = −y/(x² + y²)
        Self::computed(Real::atan2(y, x_value), [self, x], [x_value / square, -y / square])
    }

    #[inline]
    fn power(self, exponent: f64) -> Self {
        let power = self.value.power(exponent);
        // (xᵖ)′ = p xᵖ/x
        Self::computed_from(power, self, exponent * power / self.value)
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    #[inline]
    fn is_constant_zero(self) -> bool {
        self.value == 0.0 && self.place == CONSTANT
    }
}

#[cfg(test)]
mod tests {
    use super::{Gradient, Traced, gradients};
    use crate::{Duals, Real};

    /// Every operation, on three numbers.
    fn formulas<T: Real>([x, y, z]: [T; 3]) -> Vec<T> {
        let (sin, cos) = (x * 3.0).sin_cos();
        let mut sum = (sin / (y + 2.0) - cos * z).abs().sqrt().atan2(x);
        sum += y;
        sum -= T::ONE;
        sum *= z;
        sum /= x + 1.0;
        vec![
            sum,
            -x,
            x + y,
            x - y,
            x * y,
            x / y,
            x * x * x,
            x - 2.0,
            x / 2.0,
            x.sqrt(),
            y.power(1.7),
            sin,
            cos,
            x.atan2(y),
            (-x).abs(),
            x.min(y),
            y.min(x),
            x.max(y),
            y.max(x),
            T::from(2.0) / z,
            T::ONE,
        ]
    }

    fn at<const N: usize>(inputs: [f64; N], formula: impl Fn([Traced; N]) -> Vec<Traced>) -> Vec<Gradient> {
        gradients(&inputs, |inputs| Ok::<_, ()>(formula(inputs.try_into().unwrap()))).unwrap()
    }

    /// [`Duals`] differentiate in forward mode; their own tests compare them with known derivatives.
    #[test]
    fn all_derivatives_at_once_are_those_by_one_input_at_a_time() {
        for inputs in [[0.7, 1.3, -0.4], [1.4, 0.2, 2.5], [0.1, 3.0, 1.0]] {
            let gradients = at(inputs, formulas);
            let values = formulas(inputs);
            assert_eq!(gradients.len(), values.len());
            for input in 0..3 {
                let mut duals = inputs.map(Duals::<1>::from);
                duals[input].derivatives = [1.0];
                for (i, (dual, gradient)) in formulas(duals).into_iter().zip(&gradients).enumerate() {
                    assert_eq!(gradient.value.to_bits(), values[i].to_bits(), "value {i}");
                    let [derivative] = dual.derivatives;
                    let error = (gradient.by[input] - derivative).abs();
                    assert!(
                        error <= 1e-14 * derivative.abs().max(1.0),
                        "{i} by {input}: {gradient:?} {dual:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn an_infinite_derivative_of_what_a_result_does_not_need_is_none_of_it() {
        let [product] = &at([0.0, 3.0], |[x, y]| {
            let _unused = x.sqrt();
            vec![x * y]
        })[..] else {
            panic!("one result")
        };
        assert_eq!(product.by, [3.0, 0.0]);
        assert_eq!(at([0.0], |[x]| vec![x.sqrt()])[0].by, [f64::INFINITY]);
    }

    #[test]
    fn a_call_inside_of_another_leaves_the_record_of_that() {
        let outer = at([2.0], |[x]| {
            let square = x * x;
            let inner = at([5.0], |[y]| vec![y * y * y]);
            assert_eq!((inner[0].value, &inner[0].by[..]), (125.0, &[75.0][..]));
            vec![square * x]
        });
        assert_eq!((outer[0].value, &outer[0].by[..]), (8.0, &[12.0][..]));
    }

    #[test]
    fn after_its_call_a_number_is_a_constant() {
        let mut kept = Traced::ONE;
        assert_eq!(
            gradients(&[2.0], |inputs| {
                kept = inputs[0];
                Err("refused")
            }),
            Err("refused")
        );
        let square = kept * kept;
        assert_eq!(square.value(), 4.0);
        assert_eq!(at([3.0], |_| vec![square])[0], Gradient { value: 4.0, by: vec![0.0] });
    }

    #[test]
    fn comparisons_are_those_of_the_values() {
        at([0.0, f64::NAN], |[zero, nan]| {
            assert!(zero == Traced::ZERO && zero < Traced::ONE && zero.is_finite() && !nan.is_finite());
            assert!(nan.min(zero).value().is_nan() && zero.max(nan).value().is_nan());
            Vec::new()
        });
    }
}
