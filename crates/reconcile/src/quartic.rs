//! The speeds under a fraction of μ_c with a moment impulse, if signs isolate them.
//!
//! With a constant e, W_n less the value sought is a quotient whose numerator has degree 4 in the approach
//! speed, see [`fraction_with_moment`]. W_n has the value sought only if the numerator is zero, so that no
//! speed is missed. As in [`isolated`](crate::isolated), the signs of the numerator's Bernstein coefficients
//! show whether a range of approach speeds has no root, one, or perhaps several; a range that may have
//! several is halved. The ranges end where the critical impulse stops pushing and where the
//! contact jams, because most roots lie between these speeds, and at some multiples of the
//! [size](Meeting::size) of a root.

use core::ops::{Add, Mul};

use pim_core::{Law, Tangential};

use crate::branch::Branch;
use crate::fraction::{Critical, Fraction, fraction_with_moment, jams};
use crate::isolated::{Changes, Isolated, Meeting, Roots, Signs};
use crate::polynomial::{Ring, SIGN_IS_SURE, bernstein, opposite};
use crate::posed::Posed;
use crate::root::{CONVERGED, STEPS};
use crate::stretch::Stretch;

/// Multiple of the [size](Meeting::size) of a root: most roots are slower, …
const NEAR: f64 = 2.0;
/// … and in a longer range rounding would hide the signs of slower approaches.
const FAR: f64 = 32.0;

/// After this many halvings, Newton's method converges from the zero of the chord.
const HALVINGS_BEFORE_NEWTON: usize = 4;

/// A polynomial of degree 4 at most: higher terms are dropped.
#[derive(Clone, Copy)]
struct Polynomial([f64; Quartic::COEFFICIENTS]);

impl Polynomial {
    fn line(c: [f64; 2]) -> Self {
        let [c_0, c_1] = c;
        Self([c_0, c_1, 0.0, 0.0, 0.0])
    }

    fn root_of_line(self) -> f64 {
        let [c_0, c_1, ..] = self.0;
        -c_0 / c_1
    }
}

impl Add for Polynomial {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Mul for Polynomial {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let ([a_0, a_1, a_2, a_3, a_4], [b_0, b_1, b_2, b_3, b_4]) = (self.0, other.0);
        Self([
            a_0 * b_0,
            a_0 * b_1 + a_1 * b_0,
            a_0 * b_2 + a_1 * b_1 + a_2 * b_0,
            a_0 * b_3 + a_1 * b_2 + a_2 * b_1 + a_3 * b_0,
            a_0 * b_4 + a_1 * b_3 + a_2 * b_2 + a_3 * b_1 + a_4 * b_0,
        ])
    }
}

impl Ring for Polynomial {
    fn by(self, factor: f64) -> Self {
        Self(self.0.map(|c| factor * c))
    }
}

/// The numerator of F = ½ w x P_n − s as a polynomial in t, x = size t, and the ends of the parts searched
/// first.
pub(crate) struct Quartic {
    coefficients: [f64; Self::COEFFICIENTS],
    /// All approach speeds.
    stretch: Stretch,
    /// (m/s) the ends of the parts, in ascending order; some parts may have no length.
    ends: [f64; Self::PARTS + 1],
    /// Number of parts already returned.
    given: usize,
}

impl Quartic {
    const COEFFICIENTS: usize = 5;
    const PARTS: usize = 6;

    fn of(meeting: &Meeting, law: &Law, f: f64, reach: [f64; 2]) -> Self {
        let (size, e) = (meeting.size, law.restitution());
        let critical = law.without_limit();
        let (touch, there) =
            (meeting.impulse(&critical, 0.0).linear, meeting.impulse(&critical, size).linear);
        let critical = Critical {
            normal: Polynomial::line([touch.normal, there.normal - touch.normal]),
            tangential: Polynomial::line([touch.tangential, there.tangential - touch.tangential]),
        };
        let jams = jams(&meeting.inverse_mass, &critical, f);
        let x = Polynomial::line([0.0, size]);
        let yaw_rate = meeting.line.relative_yaw_rate;
        let Fraction { push, divisor, .. } = fraction_with_moment(
            &meeting.inverse_mass,
            (&critical, f),
            &jams,
            x.by(1.0 + e),
            (yaw_rate, law.moment_restitution()),
        );
        let numerator = (x * push).by(0.5 * meeting.factor(e)) + divisor.by(-meeting.sought(e));
        let [a, b, c] = [critical.normal, jams.normal, jams.moment].map(|line| size * line.root_of_line());
        let [low, high] = reach;
        let mut ends = [low, a, b, c, NEAR * size, FAR * size, high].map(|end| end.max(low).min(high));
        ends.sort_unstable_by(f64::total_cmp);
        let stretch = Stretch::constant(e, size, reach);
        Self { coefficients: numerator.0, stretch, ends, given: 0 }
    }

    /// Sign changes of the Bernstein coefficients in a range of approach speeds.
    fn changes(&self, size: f64, range: [f64; 2]) -> Changes {
        let [low, high] = range.map(|x| x / size);
        // An upper bound of the sum of the absolute terms of any Bernstein coefficient.
        let reach = low.abs() + (high - low);
        let [least, _] = at(self.coefficients.map(f64::abs), reach);
        let coefficients = bernstein(self.coefficients, Self::COEFFICIENTS - 1, [low, high - low]);
        Changes::of(coefficients, least * SIGN_IS_SURE)
    }

    /// The root in a range with one change of sign, and whether it was found.
    fn isolated(&self, size: f64, range: [f64; 2]) -> (Isolated, bool) {
        let [low, high] = range.map(|x| x / size);
        let (mut left, mut right) =
            ([low, at(self.coefficients, low)[0]], [high, at(self.coefficients, high)[0]]);
        for _ in 0..HALVINGS_BEFORE_NEWTON {
            let t = 0.5 * (left[0] + right[0]);
            let middle = [t, at(self.coefficients, t)[0]];
            if opposite(left[1], middle[1]) {
                right = middle;
            } else {
                left = middle;
            }
        }
        let ([from, at_from], [to, at_to]) = (left, right);
        // The zero of the chord.
        let mut t = from + (to - from) * (at_from / (at_from - at_to));
        let mut way = [size * t; STEPS];
        let mut step = t;
        for place in &mut way {
            let [value, slope] = at(self.coefficients, t);
            step = value / slope;
            t -= step;
            *place = size * t;
        }
        let is_found = (step.abs() <= t * CONVERGED) & (low <= t) & (t <= high);
        (Isolated { x: size * t, way }, is_found)
    }

    /// The roots in a part of the approach speeds, as far as signs show them.
    pub(crate) fn signs(&self, meeting: &Meeting, part: &Stretch, law: &Law) -> Signs {
        let changes = self.changes(meeting.size, part.range);
        let mut roots = Roots::none();
        if changes.one {
            let (root, is_found) = self.isolated(meeting.size, part.range);
            let [_, is_sure] = meeting.acts(part, law, Branch::Own, root.x);
            if !(is_found & is_sure) {
                return Signs::Unsure;
            }
            roots.insert(root);
        } else if !changes.none {
            return if changes.is_sure { Signs::Several } else { Signs::Unsure };
        }
        Signs::Isolated(roots)
    }
}

/// Its parts, in ascending order.
impl Iterator for Quartic {
    type Item = Stretch;

    fn next(&mut self) -> Option<Stretch> {
        loop {
            let range = [*self.ends.get(self.given)?, *self.ends.get(self.given + 1)?];
            self.given += 1;
            let part = Stretch { range, ..self.stretch };
            if part.has_length() {
                return Some(part);
            }
        }
    }
}

/// Value and slope of a quartic.
fn at([a, b, c, d, e]: [f64; Quartic::COEFFICIENTS], t: f64) -> [f64; 2] {
    [(((e * t + d) * t + c) * t + b) * t + a, ((4.0 * e * t + 3.0 * d) * t + 2.0 * c) * t + b]
}

impl Posed<'_> {
    /// The quartic of the problem, if the law has one.
    pub(crate) fn quartic(self, meeting: &Meeting) -> Option<Quartic> {
        let law = self.problem.law.nominal();
        let Tangential::FractionOfCritical(f) = law.tangential() else { return None };
        let e_m = law.moment_restitution();
        // With f = 0 and f = 1 the law is another one, and with a common yaw rate numerator and denominator
        // have a common factor.
        let has_numerator = (f != 0.0) & (f != 1.0) & (e_m != 0.0) & (e_m != -1.0);
        let is_constant = self.problem.law.curve().is_none() && self.problem.tangential_share == 0.0;
        (is_constant && has_numerator).then(|| Quartic::of(meeting, &law, f, self.reach()))
    }
}
