//! Real polynomials of low degree, and all of their roots in an interval.

use crate::brent::{RootError, brent_between, narrowed};

/// The highest degree that a [`Polynomial`] can have.
pub(crate) const DEGREE: usize = 12;

/// c₀ + c₁ t + … + c₁₂ t¹².
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Polynomial {
    coefficients: [f64; DEGREE + 1],
    /// Of the coefficients beyond this index none is used.
    degree: usize,
}

impl Polynomial {
    pub(crate) fn new<const N: usize>(given: [f64; N]) -> Self {
        const { assert!(1 <= N && N <= DEGREE + 1) };
        let mut coefficients = [0.0; DEGREE + 1];
        coefficients[..N].copy_from_slice(&given);
        Self { coefficients, degree: N - 1 }
    }

    fn coefficients(&self) -> &[f64] {
        &self.coefficients[..=self.degree]
    }

    pub(crate) fn at(&self, t: f64) -> f64 {
        // Horner: (… (c_n t + c_{n−1}) t + …) t + c₀
        self.coefficients().iter().rev().fold(0.0, |value, c| value * t + c)
    }

    /// The derivative of the given order.
    fn derivative(&self, order: usize) -> Self {
        let mut coefficients = [0.0; DEGREE + 1];
        let factor = |i: usize| (i + 1..=i + order).map(|k| k as f64).product::<f64>();
        // dⁿ/dtⁿ tⁱ⁺ⁿ = (i + n)!/i! tⁱ
        for (i, (place, c)) in coefficients.iter_mut().zip(&self.coefficients()[order..]).enumerate() {
            *place = c * factor(i);
        }
        Self { coefficients, degree: self.degree - order }
    }

    /// Points in ascending order that part the interval so that the polynomial is monotonic between two
    /// neighbours: its extrema strictly inside.
    ///
    /// By Rolle's theorem a polynomial has at most one root between two neighbouring roots of its derivative.
    /// So the roots of the derivative of order n − 1, a line, isolate those of the next lower order, and so
    /// on up to the first derivative. None can be missed but by rounding, which decides only where an
    /// extremum and a root coincide.
    pub(crate) fn extrema(&self, interval: [f64; 2]) -> Points {
        if self.degree == 0 { Points::none() } else { self.derivative(1).roots(interval) }
    }

    /// The roots in the interval at which the sign changes, in ascending order.
    pub(crate) fn roots(&self, interval: [f64; 2]) -> Points {
        let mut points = Points::none();
        if self.degree == 0 {
            return points;
        }
        for order in (1..self.degree).rev() {
            points = self.derivative(order).roots_between(interval, points);
        }
        self.roots_between(interval, points)
    }

    /// The roots in the interval, in which the given points isolate them.
    fn roots_between(&self, [low, high]: [f64; 2], isolating: Points) -> Points {
        let mut roots = Points::none();
        let mut left = (low, self.at(low));
        for t in isolating.into_iter().chain([high]) {
            let right = (t, self.at(t));
            if opposite(left.1, right.1) {
                roots.push(self.root_between([left, right]));
            }
            left = right;
        }
        roots
    }

    /// The root between two ends (t, value) with opposite signs.
    fn root_between(&self, ends: [(f64, f64); 2]) -> f64 {
        let [low, high] = ends.map(|(t, _)| t);
        if self.degree == 1 {
            // c₀ + c₁ t = 0
            return (-self.coefficients[0] / self.coefficients[1]).max(low).min(high);
        }
        let value = |t: f64| self.at(t);
        let ends = if low < 0.0 { ends } else { narrowed(value, ends) };
        match brent_between(value, ends, 0.0, |_, _| ()) {
            Ok(t) | Err(RootError::NotConverged { last: t, .. }) => t,
            Err(RootError::NotBracketed { .. }) => low,
        }
    }
}

impl core::ops::Add for Polynomial {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let mut sum = self;
        for (a, b) in sum.coefficients.iter_mut().zip(other.coefficients) {
            *a += b;
        }
        Self { degree: self.degree.max(other.degree), ..sum }
    }
}

impl core::ops::Mul for Polynomial {
    type Output = Self;

    /// The degrees must not add up to more than [`DEGREE`]: what is beyond is left out.
    fn mul(self, other: Self) -> Self {
        debug_assert!(self.degree + other.degree <= DEGREE, "degrees {} and {}", self.degree, other.degree);
        let mut coefficients = [0.0; DEGREE + 1];
        for (i, a) in self.coefficients().iter().enumerate() {
            for (place, b) in coefficients[i..].iter_mut().zip(other.coefficients()) {
                *place += a * b;
            }
        }
        Self { coefficients, degree: (self.degree + other.degree).min(DEGREE) }
    }
}

impl core::ops::Mul<Polynomial> for f64 {
    type Output = Polynomial;

    fn mul(self, polynomial: Polynomial) -> Polynomial {
        Polynomial { coefficients: polynomial.coefficients.map(|c| self * c), ..polynomial }
    }
}

/// A few numbers without an allocation: the roots of one polynomial, or of several of a lower degree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Points {
    values: [f64; DEGREE],
    count: usize,
}

impl Points {
    pub(crate) fn none() -> Self {
        Self { values: [0.0; DEGREE], count: 0 }
    }

    fn push(&mut self, value: f64) {
        if let Some(place) = self.values.get_mut(self.count) {
            *place = value;
            self.count += 1;
        }
    }

    /// These and the others in ascending order, [`DEGREE`] of them at most.
    pub(crate) fn merged(mut self, others: Self) -> Self {
        for value in others {
            self.push(value);
        }
        self.values[..self.count].sort_unstable_by(f64::total_cmp);
        self
    }
}

impl IntoIterator for Points {
    type Item = f64;
    type IntoIter = core::iter::Take<core::array::IntoIter<f64, DEGREE>>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.into_iter().take(self.count)
    }
}

/// Whether the sign changes between two values; zero counts as positive, and what is not a number has no
/// sign.
pub(crate) fn opposite(a: f64, b: f64) -> bool {
    (a < 0.0 && b >= 0.0) || (a >= 0.0 && b < 0.0)
}

#[cfg(test)]
mod tests;
