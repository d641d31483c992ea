//! The approach speeds at which W_n has the value sought, in a stretch of linear e where signs alone isolate
//! them.
//!
//! Under a law without a limit P_n is affine in the approach speed x and affine in e: P_n = p₀ + p_x x + e
//! (p_e + p_ex x). A stretch is a line in the plane of x and e. On it the Bernstein coefficients of x, e and
//! P_n are their values at its ends and at the other two corners of the enclosing rectangle. Sums of products
//! of these are the Bernstein coefficients of
//!
//! F = ½ (1−e) x P_n − E on the basis `dissipated`, and F = ½ x P_n − (1+e) E on the basis `absorbed`.
//!
//! F has no root in the stretch if they do not change sign, and one if they change sign once (Descartes),
//! which Newton's method finds. Under a friction limit each of the three possible laws has such an F, and a
//! root counts if its law acts there. Nearly all stretches, or halves of them, are searched in this way; the
//! rest are left to the polynomials of the stretch's [pieces](crate::pieces).

use crash3::EnergyBasis;
use pim_core::{InverseMass, Law, LawImpulse};

use crate::branch::Branch;
use crate::line::ApproachLine;
use crate::polynomial::SIGN_IS_SURE;
use crate::posed::Posed;
use crate::root::{CONVERGED, STEPS};
use crate::stretch::Stretch;

/// Relative tolerance of the energy at a root, for rounding.
const ENERGY_MATCH: f64 = 1e-12;

/// If a law does not act at its root, the law that does misses the energy sought by more than this fraction;
/// less may be the rounding of a root at the border of two laws.
const ELSEWHERE: f64 = 1e-9;

/// Minimum relative distance of two roots; closer ones may be one root at the border of two laws.
const APART: f64 = 1e-9;

/// The data of a problem that the search in a stretch needs.
#[derive(Clone, Copy)]
pub(crate) struct Meeting {
    pub(crate) inverse_mass: InverseMass,
    pub(crate) line: ApproachLine,
    /// (J)
    pub(crate) crush_energy: f64,
    pub(crate) basis: EnergyBasis,
    /// (m/s) an approach speed of a root's order of magnitude.
    pub(crate) size: f64,
}

/// P_n under a law without a limit, as a function of the approach speed x and e.
#[derive(Clone, Copy)]
pub(crate) struct Push {
    /// (N·s) p₀ and p_e.
    at_rest: [f64; 2],
    /// (kg) p_x and p_ex.
    slope: [f64; 2],
}

impl Push {
    /// (N·s) P_n
    #[inline(always)]
    fn at(&self, x: f64, e: f64) -> f64 {
        let [p_0, p_e] = self.at_rest;
        let [p_x, p_ex] = self.slope;
        // P_n = p₀ + p_x x + e (p_e + p_ex x)
        p_0 + p_x * x + e * (p_e + p_ex * x)
    }

    /// (N·s) an upper bound of the sum of its absolute terms up to an approach speed.
    #[inline(always)]
    fn size(&self, x: f64) -> f64 {
        let [p_0, p_e] = self.at_rest.map(f64::abs);
        let [p_x, p_ex] = self.slope.map(f64::abs);
        p_0 + p_e + (p_x + p_ex) * x
    }
}

/// The only root in a stretch under a law without a limit.
#[derive(Clone, Copy)]
pub(crate) struct Isolated {
    /// (m/s)
    pub(crate) x: f64,
    /// The steps to it.
    pub(crate) way: [f64; STEPS],
}

impl Isolated {
    fn none() -> Self {
        Self { x: 0.0, way: [0.0; STEPS] }
    }
}

/// P_n under each of the laws without a limit that may act.
pub(crate) type Pushes = [Option<(Branch, Push)>; 3];

/// Sign changes of the Bernstein coefficients of a polynomial.
#[derive(Clone, Copy)]
pub(crate) struct Changes {
    /// Certainly none.
    pub(crate) none: bool,
    /// Certainly exactly one.
    pub(crate) one: bool,
    /// Whether all signs are certain despite rounding.
    pub(crate) is_sure: bool,
}

impl Changes {
    /// Counts the changes of these coefficients; the sign of one no greater than `least` is left to rounding.
    #[inline(always)]
    pub(crate) fn of([a, b, c, d, e]: [f64; 5], least: f64) -> Self {
        let is_sure =
            (a.abs() > least) & (b.abs() > least) & (c.abs() > least) & (d.abs() > least) & (e.abs() > least);
        let [a, b, c, d, e] = [a < 0.0, b < 0.0, c < 0.0, d < 0.0, e < 0.0];
        let (p, q, r, s) = (a != b, b != c, c != d, d != e);
        let none = !(p | q | r | s);
        // An odd number of changes is one unless both of the first pair or both of the second are changes.
        let one = (p ^ q ^ r ^ s) & !(p & q) & !(r & s);
        Self { none: is_sure & none, one: is_sure & one, is_sure }
    }
}

/// The roots of a stretch, as far as signs show them.
pub(crate) enum Signs {
    /// The roots, isolated.
    Isolated(Roots),
    /// Perhaps more than one under one law: halves may have fewer.
    Several,
    /// Left to rounding.
    Unsure,
}

/// The roots in a stretch, in ascending order.
pub(crate) struct Roots {
    found: [Isolated; 3],
    count: usize,
    given: usize,
}

impl Roots {
    pub(crate) fn none() -> Self {
        Self { found: [Isolated::none(); 3], count: 0, given: 0 }
    }

    pub(crate) fn insert(&mut self, root: Isolated) {
        let place = self.found[..self.count].partition_point(|other| other.x < root.x);
        self.found[self.count] = root;
        self.found[place..=self.count].rotate_right(1);
        self.count += 1;
    }

    fn are_apart(&self) -> bool {
        self.found[..self.count].windows(2).all(|pair| pair[1].x - pair[0].x > pair[0].x * APART)
    }
}

impl Iterator for Roots {
    type Item = Isolated;

    fn next(&mut self) -> Option<Isolated> {
        let next = *self.found[..self.count].get(self.given)?;
        self.given += 1;
        Some(next)
    }
}

impl Posed<'_> {
    #[inline(always)]
    pub(crate) fn meeting(self) -> Meeting {
        Meeting {
            inverse_mass: self.problem.contact.inverse_mass(),
            line: self.line,
            crush_energy: self.problem.crush_energy,
            basis: self.problem.basis,
            size: self.frictionless_approach_speed(),
        }
    }
}

impl Meeting {
    #[inline(always)]
    pub(crate) fn impulse(&self, law: &Law, x: f64) -> LawImpulse {
        law.impulse(&self.inverse_mass, self.line.at(x))
    }

    /// (N·s) P_n under the branch of the law at the restitution e.
    #[inline(always)]
    fn push_at(&self, law: &Law, branch: Branch, e: f64, x: f64) -> f64 {
        self.impulse(&branch.law(&law.restituting(e)), x).linear.normal
    }

    #[inline(always)]
    pub(crate) fn push(&self, law: &Law, branch: Branch) -> Push {
        let (p_0, p_1) = (self.push_at(law, branch, 0.0, 0.0), self.push_at(law, branch, 0.0, self.size));
        let (q_0, q_1) = (self.push_at(law, branch, 1.0, 0.0), self.push_at(law, branch, 1.0, self.size));
        let (slope, slope_1) = ((p_1 - p_0) / self.size, (q_1 - q_0) / self.size);
        Push { at_rest: [p_0, q_0 - p_0], slope: [slope, slope_1 - slope] }
    }

    /// F = ½ w x P_n − s: the factor w at the restitution e.
    #[inline(always)]
    pub(crate) fn factor(&self, e: f64) -> f64 {
        match self.basis {
            EnergyBasis::Dissipated => 1.0 - e,
            EnergyBasis::Absorbed => 1.0,
        }
    }

    /// (J) F = ½ w x P_n − s: the value sought s at the restitution e.
    #[inline(always)]
    pub(crate) fn sought(&self, e: f64) -> f64 {
        match self.basis {
            EnergyBasis::Dissipated => self.crush_energy,
            EnergyBasis::Absorbed => (1.0 + e) * self.crush_energy,
        }
    }

    /// The root in a stretch in which F changes sign once, and whether it was found.
    #[inline(always)]
    pub(crate) fn isolated(&self, stretch: &Stretch, push: &Push) -> (Isolated, bool) {
        let [low, high] = stretch.range;
        let mut x = self.size.max(low).min(high);
        let e = stretch.restitution_at(x);
        // The root if P_n/x and e had their values at this approach speed at all others.
        let share = self.sought(e) / (0.5 * self.factor(e) * x * push.at(x, e));
        x = (x * real::Real::sqrt(share)).max(low).min(high);
        let mut way = [x; STEPS];
        let mut step = x;
        for place in &mut way {
            step = self.newton(stretch, push, x);
            x -= step;
            *place = x;
        }
        let is_found = (step.abs() <= x * CONVERGED) & (low <= x) & (x <= high);
        (Isolated { x, way }, is_found)
    }

    /// (m/s) Newton's step F/F′.
    #[inline(always)]
    fn newton(&self, stretch: &Stretch, push: &Push, x: f64) -> f64 {
        let (e, rise) = (stretch.restitution_at(x), stretch.rise);
        let [_, p_e] = push.at_rest;
        let [p_x, p_ex] = push.slope;
        let (p, w) = (push.at(x, e), self.factor(e));
        // w′ = −e′ and s′ = 0, or w′ = 0 and s′ = e′ E
        let (w_rise, s_rise) = match self.basis {
            EnergyBasis::Dissipated => (-rise, 0.0),
            EnergyBasis::Absorbed => (0.0, rise * self.crush_energy),
        };
        // P_n′ = p_x + e p_ex + e′ (p_e + p_ex x)
        let p_rise = p_x + e * p_ex + rise * (p_e + p_ex * x);
        // F′ = ½ [w (P_n + x P_n′) + w′ x P_n] − s′
        let slope = 0.5 * (w * (p + x * p_rise) + w_rise * x * p) - s_rise;
        (0.5 * w * x * p - self.sought(e)) / slope
    }

    /// Sign changes of the Bernstein coefficients of F in a stretch.
    #[inline(always)]
    pub(crate) fn changes(&self, stretch: &Stretch, push: &Push) -> Changes {
        let [x_0, x_1] = stretch.range;
        let (e_0, e_1) = (stretch.restitution_at(x_0), stretch.restitution_at(x_1));
        let (p_0, p_2) = (push.at(x_0, e_0), push.at(x_1, e_1));
        let p_1 = 0.5 * (push.at(x_0, e_1) + push.at(x_1, e_0));
        let (w_0, w_1) = (self.factor(e_0), self.factor(e_1));
        // ½ w x
        let (h_0, h_2) = (0.5 * w_0 * x_0, 0.5 * w_1 * x_1);
        let h_1 = 0.25 * (w_1 * x_0 + w_0 * x_1);
        let (s_0, s_1) = (self.sought(e_0), self.sought(e_1));
        // The product of polynomials with the coefficients h_i and p_j: Σ C(2,i) C(2,j) h_i p_j/C(4,i+j)
        let a = h_0 * p_0 - s_0;
        let b = 0.5 * (h_0 * p_1 + h_1 * p_0) - (0.75 * s_0 + 0.25 * s_1);
        let c = (h_0 * p_2 + 4.0 * h_1 * p_1 + h_2 * p_0) * (1.0 / 6.0) - 0.5 * (s_0 + s_1);
        let d = 0.5 * (h_1 * p_2 + h_2 * p_1) - (0.25 * s_0 + 0.75 * s_1);
        let e = h_2 * p_2 - s_1;
        let least = (0.5 * x_1 * push.size(x_1) + s_0.max(s_1)) * SIGN_IS_SURE;
        Changes::of([a, b, c, d, e], least)
    }

    /// Whether a branch of the law acts at its root x, so that x is a root of the law, and whether that is
    /// certain.
    #[inline(always)]
    pub(crate) fn acts(&self, stretch: &Stretch, law: &Law, branch: Branch, x: f64) -> [bool; 2] {
        let e = stretch.restitution_at(x);
        let law = law.restituting(e);
        let own = self.impulse(&law, x).linear;
        let acts = match branch {
            Branch::Own => true,
            Branch::Full | Branch::Ratio(_) => own == self.impulse(&branch.law(&law), x).linear,
        };
        let sought = self.sought(e);
        let missing = (0.5 * self.factor(e) * x * own.normal - sought).abs();
        let is_sure = if acts { missing <= sought * ENERGY_MATCH } else { missing > sought * ELSEWHERE };
        [acts, is_sure]
    }

    /// The roots of a stretch, as far as signs show them.
    pub(crate) fn signs(&self, stretch: &Stretch, law: &Law, pushes: &Pushes) -> Signs {
        let mut roots = Roots::none();
        for (branch, push) in pushes.iter().flatten() {
            let changes = self.changes(stretch, push);
            if changes.none {
                continue;
            }
            if !changes.one {
                return if changes.is_sure { Signs::Several } else { Signs::Unsure };
            }
            let (root, is_found) = self.isolated(stretch, push);
            let [acts, is_sure] = self.acts(stretch, law, *branch, root.x);
            if !(is_found & is_sure) {
                return Signs::Unsure;
            }
            if acts {
                roots.insert(root);
            }
        }
        if roots.are_apart() { Signs::Isolated(roots) } else { Signs::Unsure }
    }
}

#[cfg(test)]
mod tests;
