//! Real polynomials of low degree, and all of their roots in an interval.

use real::Real;

use crate::brent::{RootError, brent_between, narrowed};

/// The highest degree that a [`Polynomial`] can have.
pub(crate) const DEGREE: usize = 12;

/// c₀ + c₁ t + … + c₁₂ t¹².
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Polynomial {
    coefficients: [f64; DEGREE + 1],
    /// Coefficients beyond this index are not used.
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

    /// Points in ascending order that divide the interval so that the polynomial is monotonic between
    /// neighbours: its extrema strictly inside.
    ///
    /// By Rolle's theorem a polynomial has at most one root between two neighbouring roots of its derivative.
    /// So the roots of the derivative of order n − 1, a line, isolate those of the next lower order, and so
    /// on up to the first derivative. None can be missed except by rounding, which matters only if an
    /// extremum and a root coincide.
    pub(crate) fn extrema(&self, interval: [f64; 2]) -> Points {
        if self.degree == 0 { Points::none() } else { self.derivative(1).roots(interval) }
    }

    /// Number of sign changes of the Bernstein coefficients of an interval. The polynomial has that many
    /// roots inside, or fewer by an even number (Descartes). `None` if rounding could decide one of the
    /// signs.
    pub(crate) fn changes(&self, [low, high]: [f64; 2]) -> Option<usize> {
        let (n, length) = (self.degree, high - low);
        let bernstein = bernstein(self.coefficients, n, [low, length]);
        // An upper bound of the sum of the absolute terms of any Bernstein coefficient.
        let reach = low.abs() + length;
        let size = self.coefficients().iter().rev().fold(0.0, |size, c| size * reach + c.abs());
        let (mut changes, mut before) = (0, 0.0);
        for &b in &bernstein[..=n] {
            if b.is_nan() || b.abs() <= size * SIGN_IS_SURE {
                return None;
            }
            changes += usize::from(b * before < 0.0);
            before = b;
        }
        Some(changes)
    }

    /// The roots in the interval where the sign changes, in ascending order.
    pub(crate) fn roots(&self, interval: [f64; 2]) -> Points {
        let mut points = Points::none();
        // This would cost more than the derivatives of a parabola.
        if self.degree > 2 {
            match self.changes(interval) {
                Some(0) => return points,
                Some(1) => return self.roots_between(interval, points),
                Some(_) | None => {}
            }
        }
        for order in (1..self.degree).rev() {
            points = self.derivative(order).roots_between(interval, points);
        }
        self.roots_between(interval, points)
    }

    /// The roots in the interval, isolated by the given points.
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

    /// The root of a polynomial of degree 2.
    fn quadratic_root(&self, [(_, at_low), _]: [(f64, f64); 2]) -> f64 {
        let [c, b, a] = [0, 1, 2].map(|i| self.coefficients[i]);
        // a t² + b t + c rises at (−b + √(b² − 4 a c))/(2 a), and falls at the other root.
        let root = Real::sqrt((b * b - 4.0 * a * c).max(0.0));
        let root = if at_low < 0.0 { root } else { -root };
        // In the form that does not cancel: (−b + √…)/(2 a) = 2 c/(−b − √…)
        if b * root > 0.0 { 2.0 * c / (-b - root) } else { (root - b) / (2.0 * a) }
    }

    /// The root in an interval that has at most one; `None` if the sign does not change. Newton's method
    /// starts from the given point or, if that lies outside, from the zero of the chord; if it leaves the
    /// interval, a bracketed search follows.
    pub(crate) fn root_in(&self, interval: [f64; 2], from: f64) -> Option<f64> {
        let ends = interval.map(|t| (t, self.at(t)));
        let [(low, at_low), (high, at_high)] = ends;
        let is_inside = |t: f64| low <= t && t <= high;
        opposite(at_low, at_high).then(|| {
            let on_chord = low + (high - low) * (at_low / (at_low - at_high));
            match self.newton(if is_inside(from) { from } else { on_chord }) {
                Some(root) if is_inside(root) => root,
                _ => self.root_between(ends),
            }
        })
    }

    /// A root near a point, if Newton's method converges within a few steps.
    fn newton(&self, mut t: f64) -> Option<f64> {
        for _ in 0..NEWTON_STEPS {
            let (mut value, mut slope) = (0.0, 0.0);
            for c in self.coefficients().iter().rev() {
                (value, slope) = (value * t + c, slope * t + value);
            }
            let step = value / slope;
            t -= step;
            if step.abs() <= NEWTON_CONVERGED * t.abs() {
                return Some(t);
            }
        }
        None
    }

    /// The root between two ends (t, value) with opposite signs.
    fn root_between(&self, ends: [(f64, f64); 2]) -> f64 {
        let [low, high] = ends.map(|(t, _)| t);
        if self.degree == 1 {
            // c₀ + c₁ t = 0
            return (-self.coefficients[0] / self.coefficients[1]).max(low).min(high);
        }
        if self.degree == 2 {
            return self.quadratic_root(ends).max(low).min(high);
        }
        let value = |t: f64| self.at(t);
        let ends = if low < 0.0 { ends } else { narrowed(value, ends) };
        match brent_between(value, ends, 0.0, |_, _| ()) {
            Ok(t) | Err(RootError::NotConverged { last: t, .. }) => t,
            Err(RootError::NotBracketed { .. }) => low,
        }
    }
}

/// The Bernstein coefficients of a polynomial of degree n with these coefficients, in the interval of the
/// given length that begins at `low`.
#[inline(always)]
pub(crate) fn bernstein<const M: usize>(
    mut shifted: [f64; M],
    n: usize,
    [low, length]: [f64; 2],
) -> [f64; M] {
    // c_j of (t − low)ʲ, by Horner's scheme
    for end in 0..n {
        for i in (end..n).rev() {
            shifted[i] += low * shifted[i + 1];
        }
    }
    let mut power = 1.0;
    for (j, c) in shifted[..=n].iter_mut().enumerate() {
        *c *= power / binomial(n, j);
        power *= length;
    }
    let mut coefficients = [0.0; M];
    for (i, b) in coefficients[..=n].iter_mut().enumerate() {
        // b_i = Σ_j C(i, j)/C(n, j) c_j (high − low)ʲ
        *b = (0..=i).map(|j| binomial(i, j) * shifted[j]).sum();
    }
    coefficients
}

/// More steps than Newton's method needs from a start of a few times the root.
const NEWTON_STEPS: usize = 12;

/// The last step is at most this fraction of the root: the remaining error is its square.
const NEWTON_CONVERGED: f64 = 1e-9;

/// A Bernstein coefficient smaller than this fraction of the sum of its absolute terms may have either sign:
/// rounding changes it by less than a hundredth of that.
pub(crate) const SIGN_IS_SURE: f64 = 1e-12;

/// C(n, k), up to [`DEGREE`]; zero if k > n.
#[inline(always)]
fn binomial(n: usize, k: usize) -> f64 {
    /// Pascal's triangle.
    const ROWS: [[f64; DEGREE + 1]; DEGREE + 1] = {
        let mut rows = [[0.0; DEGREE + 1]; DEGREE + 1];
        let mut n = 0;
        while n <= DEGREE {
            rows[n][0] = 1.0;
            let mut k = 1;
            while k <= n {
                rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
                k += 1;
            }
            n += 1;
        }
        rows
    };
    ROWS[n][k]
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

    /// The degrees must not add up to more than [`DEGREE`]: higher terms are dropped.
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

/// Arithmetic of polynomials.
pub(crate) trait Ring: Copy + core::ops::Add<Output = Self> + core::ops::Mul<Output = Self> {
    /// This one, multiplied by a number.
    fn by(self, factor: f64) -> Self;
}

impl Ring for Polynomial {
    fn by(self, factor: f64) -> Self {
        factor * self
    }
}

/// A short list without allocation: the roots of one polynomial, or of several of lower degree.
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

    /// Both lists in ascending order, at most [`DEGREE`] numbers.
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

/// Whether the sign changes between two values; zero counts as positive, and NaN has no sign.
pub(crate) fn opposite(a: f64, b: f64) -> bool {
    (a < 0.0 && b >= 0.0) || (a >= 0.0 && b < 0.0)
}

#[cfg(test)]
mod tests;
