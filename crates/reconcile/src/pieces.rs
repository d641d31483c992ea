//! All approach speeds at which W_n has the value sought.
//!
//! The relative velocity at C is affine in the approach speed x = −u_n, and e is linear in x between two
//! points of a restitution curve. So the range of x is divided into *stretches* of linear e, and each stretch
//! into *pieces* in which one law without a limit holds: a piece ends where sliding begins, ends or reverses,
//! where the contact jams, or where the law ceases to push. Within a piece W_n minus the value sought is a
//! ratio of polynomials in x:
//!
//! | law | P_n | degree of the numerator, e constant | e linear |
//! |---|---|---:|---:|
//! | a condition on U_t, or a ratio; sticking or sliding under a friction limit; with a moment impulse or without | polynomial | 2 | 4 |
//! | fraction of μ_c | c_n (1+e) x / d | 3 | 6 |
//! | fraction of μ_c with a moment impulse | see [`Posed::fraction_of_critical`] | 4 | 8 |
//!
//! If the crush takes a share λ of the tangential work, W_n + λ W_t has the denominator squared, and the
//! degrees of the numerator are 2 and 4, 4 and 8, 6 and 12.
//!
//! None of this is needed if signs isolate the roots of a whole stretch at once: see
//! [`isolated`](crate::isolated).
//!
//! The extrema of the numerator divide each piece into parts with at most one root each (Rolle), unless the
//! signs of its Bernstein coefficients show that the whole piece has at most one (Descartes). Brent's method
//! finds that root of the numerator, and from it the root of the law's own W_n, unless a chord about the
//! first already gives it. A jump of W_n from one piece to the next is not a change of sign within a piece,
//! so it is never taken for a root.

use crash3::EnergyBasis;
use pim_core::{LawImpulse, Regime, RestitutionCurve, Tangential};

use crate::answer::{FASTEST, Iteration, Trail};
use crate::branch::Branch;
use crate::brent::{RootError, brent_between, narrowed};
use crate::error::ReconcileError;
use crate::fraction::{Critical, Fraction, fraction_with_moment, jams};
use crate::isolated::{Isolated, Meeting, Pushes, Roots, Signs};
use crate::polynomial::{Points, Polynomial, opposite};
use crate::posed::Posed;
use crate::quartic::Quartic;
use crate::root::Root;
use crate::stretch::{Parts, Stretch};

/// Under a fraction of μ_c the contact may jam at the end of a piece, where W_n is infinite: its sign is
/// evaluated at this relative distance from the end, far above rounding.
const BESIDE_A_JAM: f64 = 1e-12;

/// Relative half-width of the bracket about a root of the numerator, far above rounding.
const ABOUT: f64 = 1e-10;

/// If the residual at the zero of a chord of length 2 [`ABOUT`] is at most this fraction of that at its ends,
/// the zero is the root but for rounding.
const STRAIGHT: f64 = 1e-5;

/// Relative tolerance of the energy at a root. Rounding of the speed moves W_n by more only nearer than 1e-9
/// to a jam; a change of sign by rounding on the wrong side of a jam or a jump misses by far more.
const ENERGY_MATCH: f64 = 1e-6;

/// The polynomials whose signs isolate the roots of a part.
enum Isolating {
    Pushes(Pushes),
    /// It also gives the parts.
    Quartic(Quartic),
    /// None: the pieces isolate them.
    Nothing,
}

/// A piece that may have roots.
struct Part {
    stretch: Stretch,
    /// The interval of t.
    piece: [f64; 2],
    branch: Branch,
    /// The numerator of W_n less the value sought.
    excess: Polynomial,
    /// Its number of changes of sign in the piece, if certain.
    changes: Option<usize>,
}

/// Approach speeds between which W_n less the value sought changes its sign once, under one branch of the
/// law.
struct Bracket {
    /// Each with the residual there (J).
    ends: [(f64, f64); 2],
    branch: Branch,
}

impl Bracket {
    /// The zero of the chord between the ends of a narrow bracket.
    fn chord(&self) -> Option<f64> {
        let [(low, at_low), (high, at_high)] = self.ends;
        let is_narrow = high - low <= 3.0 * ABOUT * low;
        is_narrow.then(|| low + (high - low) * (at_low / (at_low - at_high)))
    }

    /// (J) the greater residual of the two ends.
    fn height(&self) -> f64 {
        let [(_, at_low), (_, at_high)] = self.ends;
        at_low.abs().max(at_high.abs())
    }
}

impl<'a> Posed<'a> {
    /// The approach speeds at which W_n has the value sought, in ascending order: all up to [`FASTEST`].
    pub(crate) fn roots<S: Trail>(
        self,
    ) -> impl Iterator<Item = Result<Root<S>, ReconcileError>> + use<'a, S> {
        let mut only = self.only_root();
        let (law, meeting) = (self.problem.law.nominal(), self.meeting());
        let mut isolating = self.isolating(&meeting);
        let mut stretches = only.is_none().then(|| self.stretches());
        let mut parts = Parts::none();
        let mut isolated = Roots::none();
        let mut by_pieces = None;
        let mut last = f64::NAN;
        // Iterator adapters would take a kilobyte, copied several times for each stretch.
        core::iter::from_fn(move || {
            loop {
                if let Some(root) = only.take() {
                    return Some(Ok(root));
                }
                if let Some(Isolated { x, way }) = isolated.next() {
                    return Some(Ok(self.root_at_the_end_of(way, x)));
                }
                match by_pieces.as_mut().and_then(Iterator::next) {
                    // A root on the border of two pieces belongs to both.
                    Some(Ok(Root { x, .. })) if core::mem::replace(&mut last, x) == x => continue,
                    Some(root) => return Some(root),
                    None => by_pieces = None,
                }
                let part = match (parts.slowest(), &mut isolating) {
                    (Some(part), _) => part,
                    (None, Isolating::Quartic(quartic)) => parts.begin(quartic.next()?),
                    (None, _) => parts.begin(stretches.as_mut()?.next()?),
                };
                let signs = match &isolating {
                    Isolating::Pushes(all) => meeting.signs(&part, &law, all),
                    Isolating::Quartic(quartic) => quartic.signs(&meeting, &part, &law),
                    Isolating::Nothing => Signs::Unsure,
                };
                match signs {
                    Signs::Several if parts.halve() => continue,
                    Signs::Isolated(roots) => isolated = roots,
                    Signs::Several | Signs::Unsure => by_pieces = Some(self.roots_by_pieces(part)),
                }
                parts.finish();
            }
        })
    }

    pub(crate) fn roots_by_pieces<S: Trail>(
        self,
        stretch: Stretch,
    ) -> impl Iterator<Item = Result<Root<S>, ReconcileError>> + use<'a, S> {
        self.pieces(stretch)
            .filter_map(move |piece| self.part(stretch, piece))
            .flat_map(move |part| self.brackets(part))
            .filter_map(move |bracket| self.root(&bracket).transpose())
    }

    /// The polynomials whose signs are examined.
    fn isolating(self, meeting: &Meeting) -> Isolating {
        match (self.pushes(meeting), self.quartic(meeting)) {
            (Some(pushes), _) => Isolating::Pushes(pushes),
            (None, Some(quartic)) => Isolating::Quartic(quartic),
            (None, None) => Isolating::Nothing,
        }
    }

    /// P_n under each law without a limit that may act in an impact; `None` if one of them is not affine.
    pub(crate) fn pushes(self, meeting: &Meeting) -> Option<Pushes> {
        if self.problem.tangential_share != 0.0 {
            return None;
        }
        let law = self.problem.law.nominal();
        let under = |branch: Branch| Some((branch, meeting.push(&law, branch)));
        match law.tangential() {
            Tangential::FractionOfCritical(f) => match self.branch_of_fraction(f) {
                Branch::Own => None,
                branch => Some([under(branch), None, None]),
            },
            Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => {
                Some([Branch::Full, Branch::Ratio(-limit), Branch::Ratio(limit)].map(under))
            }
            Tangential::Critical
            | Tangential::Ratio(_)
            | Tangential::VelocityChange(_)
            | Tangential::Restitution(_) => Some([under(Branch::Own), None, None]),
        }
    }

    /// The ranges in which e is linear, limited to approaching vehicles and an unknown speed of at most
    /// [`FASTEST`].
    pub(crate) fn stretches(self) -> impl Iterator<Item = Stretch> + use<'a> {
        let law = &self.problem.law;
        let points = law.curve().map_or(&[][..], RestitutionCurve::points);
        let reach = self.reach();
        let size = self.frictionless_approach_speed();
        // Outside the points e is constant.
        let constant = move |e: f64, range: [f64; 2]| Stretch::constant(e, size, range);
        let first = points.first().map_or(f64::INFINITY, |&(x, _)| x);
        let before = constant(law.nominal().restitution(), [0.0, first]);
        let between = points.windows(2).filter_map(|pair| match *pair {
            [from, to] => Some(Stretch::between([from, to])),
            _ => None,
        });
        let after = points.last().map(|&(x, e)| constant(e, [x, f64::INFINITY]));
        // With e = 1 throughout, the normal impulse does no work.
        let has_share = self.problem.tangential_share != 0.0;
        core::iter::once(before)
            .chain(between)
            .chain(after)
            .map(move |stretch| stretch.within(reach))
            .filter(move |stretch| stretch.has_length() && (has_share || !stretch.is_elastic()))
    }

    /// (m/s) the lowest and the highest approach speed for a speed of at most [`FASTEST`].
    #[inline(always)]
    pub(crate) fn reach(self) -> [f64; 2] {
        // x = −(u_n(s=0) + s w_n)
        let (at_rest, reach) = (self.line.at_rest.normal, self.line.slope.normal.abs() * FASTEST);
        [(-at_rest - reach).max(0.0), reach - at_rest]
    }

    /// The pieces of a stretch, as intervals of t.
    fn pieces(self, stretch: Stretch) -> impl Iterator<Item = [f64; 2]> + use<'a> {
        let [from, to] = stretch.interval();
        let mut left = from;
        self.borders(&stretch).into_iter().chain([to]).filter_map(move |right| {
            let piece = [left, right];
            left = right;
            (piece[0] < piece[1]).then_some(piece)
        })
    }

    /// The borders between the pieces of a stretch.
    fn borders(self, stretch: &Stretch) -> Points {
        let interval = stretch.interval();
        let roots = |polynomial: Polynomial| polynomial.roots(interval);
        match self.problem.law.nominal().tangential() {
            // Friction suffices between P_t = −limit P_n and P_t = limit P_n; beyond, it reverses where the
            // sliding does.
            Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => {
                let full = stretch.corners(&self.problem.law.nominal(), |law, x| {
                    self.impulse_at(&law.without_limit(), x).linear
                });
                let spare = |c_t: f64| roots(full.polynomial(|p| limit * p.normal + c_t * p.tangential));
                let sliding = stretch.polynomial(&self.problem.law.nominal(), |law, x| {
                    let free = self.impulse_at(&law.with_ratio(0.0), x);
                    let k = self.problem.contact.inverse_mass();
                    k.separation(self.line.at(x), free.linear, free.moment).velocity.tangential
                });
                spare(1.0).merged(spare(-1.0)).merged(roots(sliding))
            }
            Tangential::FractionOfCritical(f) => {
                let Branch::Own = self.branch_of_fraction(f) else { return Points::none() };
                let critical = self.critical(stretch);
                let moment = self.problem.law.nominal().moment_restitution();
                let jams = jams(&self.problem.contact.inverse_mass(), &critical, f);
                let mut borders = roots(critical.normal);
                if moment != 0.0 {
                    borders = borders.merged(roots(jams.normal));
                }
                if moment != -1.0 {
                    borders = borders.merged(roots(jams.moment));
                }
                borders
            }
            Tangential::Critical
            | Tangential::Ratio(_)
            | Tangential::VelocityChange(_)
            | Tangential::Restitution(_) => Points::none(),
        }
    }

    /// The law that holds in a piece, determined in its middle.
    fn branch(self, x: f64) -> Branch {
        match self.problem.law.nominal().tangential() {
            Tangential::Friction(limit) | Tangential::FullOrSliding(limit) => {
                let LawImpulse { linear: p, regime, .. } = self.impulse_at(&self.problem.law.at(x), x);
                match regime {
                    Some(Regime::Sliding) if p.normal * p.tangential < 0.0 => Branch::Ratio(-limit),
                    Some(Regime::Sliding) => Branch::Ratio(limit),
                    Some(Regime::Full) | None => Branch::Full,
                }
            }
            Tangential::FractionOfCritical(f) => self.branch_of_fraction(f),
            _ => Branch::Own,
        }
    }

    /// With f = 0 there is no friction. With f = 1 the ratio is μ_c and nothing jams, if the moment impulse
    /// is zero or M_c; any other moment impulse differs between the law that gives μ_c and a ratio of that
    /// size.
    fn branch_of_fraction(self, f: f64) -> Branch {
        let moment = self.problem.law.nominal().moment_restitution();
        if f == 0.0 {
            Branch::Ratio(0.0)
        } else if f == 1.0 && (moment == -1.0 || moment == 0.0) {
            Branch::Full
        } else {
            Branch::Own
        }
    }

    /// The starting data of the search in a piece; `None` if signs show that it has no root, as for most
    /// pieces of a curve.
    fn part(self, stretch: Stretch, piece: [f64; 2]) -> Option<Part> {
        let branch = self.branch(stretch.approach_speed(0.5 * (piece[0] + piece[1])));
        let excess = self.excess(&stretch, branch);
        let changes = excess.changes(piece);
        (changes != Some(0)).then_some(Part { stretch, piece, branch, excess, changes })
    }

    /// Brackets of the points at which W_n passes the value sought within a piece.
    fn brackets(self, part: Part) -> impl Iterator<Item = Bracket> + use<'a> {
        let Part { stretch, piece, branch, excess, changes } = part;
        let [mut low, mut high] = piece.map(|t| stretch.approach_speed(t));
        if let (Tangential::FractionOfCritical(_), Branch::Own) =
            (self.problem.law.nominal().tangential(), branch)
        {
            low *= 1.0 + BESIDE_A_JAM;
            high *= 1.0 - BESIDE_A_JAM;
        }
        let isolating = if changes == Some(1) { Points::none() } else { excess.extrema(piece) };
        let speed = move |t: f64| stretch.approach_speed(t).max(low).min(high);
        let mut from = (piece[0], low);
        isolating
            .into_iter()
            .map(move |t| (t, speed(t)))
            .chain([(piece[1], high)])
            // Rounding may leave nothing between two adjacent jams.
            .take_while(move |_| low < high)
            .filter_map(move |to| {
                let [(left, least), (right, most)] = [from, to];
                from = to;
                let near = stretch.parameter(self.frictionless_approach_speed());
                let root = excess.root_in([left, right], near).map(speed);
                let ends = root.and_then(|root| self.about(branch, root)).or_else(|| {
                    let ends = [least, most].map(|x| (x, self.missing(branch, x)));
                    opposite(ends[0].1, ends[1].1).then_some(ends)
                });
                ends.map(|ends| Bracket { ends, branch })
            })
    }

    /// The ends of a bracket about a root of the numerator, if W_n passes the value sought within it.
    fn about(self, branch: Branch, root: f64) -> Option<[(f64, f64); 2]> {
        let ends = [1.0 - ABOUT, 1.0 + ABOUT].map(|factor| {
            let x = root * factor;
            (x, self.missing(branch, x))
        });
        opposite(ends[0].1, ends[1].1).then_some(ends)
    }

    /// (J) the numerator of W_n + λ W_t less the value sought, as a crush energy on the basis.
    fn excess(self, stretch: &Stretch, branch: Branch) -> Polynomial {
        let share = self.problem.tangential_share;
        let (push, divisor, tangential) = match (branch, self.problem.law.nominal().tangential()) {
            (Branch::Own, Tangential::FractionOfCritical(f)) => {
                let Fraction { push, divisor, slide, moment } = self.fraction_of_critical(stretch, f);
                let tangential = (share != 0.0).then(|| {
                    let k = self.problem.contact.inverse_mass();
                    let u_t = stretch
                        .polynomial(&self.problem.law.nominal(), |_, x| self.line.at(x).velocity.tangential);
                    // u_t + U_t = 2 u_t + k_nt P_n + k_tt P_t + k_tm M
                    let sliding = 2.0 * (u_t * divisor) + k.nt * push + k.tt * slide + k.tm * moment;
                    slide * sliding
                });
                (push, divisor, tangential)
            }
            _ => {
                let part = |value: &dyn Fn(LawImpulse, f64) -> f64| {
                    stretch.polynomial(&self.problem.law.nominal(), |law, x| {
                        value(self.impulse_at(&branch.law(law), x), x)
                    })
                };
                let tangential = (share != 0.0).then(|| {
                    let sliding = part(&|p, x| self.sliding_at(p, x));
                    part(&|p, _| p.linear.tangential) * sliding
                });
                (part(&|p, _| p.linear.normal), Polynomial::new([1.0]), tangential)
            }
        };
        let work = 0.5 * (stretch.x() * push);
        let sought = -self.problem.crush_energy * divisor;
        match (self.problem.basis, tangential) {
            // ½ (1−e) x P_n − E
            (EnergyBasis::Dissipated, None) => stretch.one_plus(-1.0) * work + sought,
            // ½ (1−e) x P_n − ½ λ P_t (u_t + U_t) − E, whose second term has the divisor squared
            (EnergyBasis::Dissipated, Some(tangential)) => {
                (stretch.one_plus(-1.0) * work + sought) * divisor + -0.5 * share * tangential
            }
            // ½ x P_n/(1+e) − E
            (EnergyBasis::Absorbed, _) => work + stretch.one_plus(1.0) * sought,
        }
    }

    /// P_n, P_t = μ P_n and M under a fraction of μ_c as numerators over a common denominator, with the
    /// critical impulse c, μ = f c_t/c_n, d = k_nn c_n + f k_nt c_t and n = k_nm c_n + f k_tm c_t:
    ///
    /// - P_n = c_n (1+e) x / d without a moment impulse,
    /// - P_n = c_n [(1+e) x g + (1+e_m) k_nm (s d + (1+e) x n)] / (d g) with one, where s = ω₁ − ω₂ and g =
    ///   k_mm d − k_nm n,
    /// - P_n = c_n [(1+e) x k_mm + k_nm s] / g with a common yaw rate, e_m = 0, where d cancels;
    /// - M = −(1+e_m) (s d + (1+e) x n) / g.
    fn fraction_of_critical(self, stretch: &Stretch, f: f64) -> Fraction<Polynomial> {
        let k = self.problem.contact.inverse_mass();
        let critical = self.critical(stretch);
        let jams = jams(&k, &critical, f);
        let d = jams.normal;
        // (1+e) x = −(1+e) u_n
        let change = stretch.one_plus(1.0) * stretch.x();
        let fraction = |share: Polynomial, divisor: Polynomial, moment: Polynomial| Fraction {
            push: critical.normal * share,
            slide: f * (critical.tangential * share),
            divisor,
            moment,
        };
        if !self.problem.law.nominal().has_moment() {
            return fraction(change, d, Polynomial::new([0.0]));
        }
        let e_m = self.problem.law.nominal().moment_restitution();
        let yaw_rate = self.line.relative_yaw_rate;
        if e_m == 0.0 {
            let share = k.mm * change + Polynomial::new([k.nm * yaw_rate]);
            return fraction(share, jams.moment, -1.0 * jams.turning(yaw_rate, change));
        }
        fraction_with_moment(&k, (&critical, f), &jams, change, (yaw_rate, e_m))
    }

    /// The critical impulse c, up to a factor.
    fn critical(self, stretch: &Stretch) -> Critical<Polynomial> {
        let c = stretch
            .corners(&self.problem.law.nominal(), |law, x| self.impulse_at(&law.without_limit(), x).linear);
        Critical { normal: c.polynomial(|c| c.normal), tangential: c.polynomial(|c| c.tangential) }
    }

    /// (J) W_n + λ W_t at the approach speed x less the value sought, as a crush energy on the basis.
    fn missing(self, branch: Branch, x: f64) -> f64 {
        let law = branch.law(&self.problem.law.at(x));
        // If the vehicles just touch, the normal impulse does no work, whatever the quotient of two zeros
        // gives.
        let work = if x == 0.0 && self.problem.tangential_share == 0.0 {
            0.0
        } else {
            match self.problem.basis {
                EnergyBasis::Dissipated => self.problem.crush_work_at(&law, self.line.at(x)),
                // W_n/(1−e²) = ½ x P_n/(1+e), which is finite where e = 1
                EnergyBasis::Absorbed => {
                    0.5 * x * self.impulse_at(&law, x).linear.normal / (1.0 + law.restitution())
                }
            }
        };
        work - self.problem.crush_energy
    }

    /// The root in a bracket; `None` if the bracket results from rounding next to a jump.
    fn root<S: Trail>(self, bracket: &Bracket) -> Result<Option<Root<S>>, ReconcileError> {
        let mut steps = S::none();
        let mut observe = |x: f64, residual: f64| {
            steps.push(|| Iteration {
                speed: self.line.speed(x),
                normal_work: self
                    .problem
                    .basis
                    .dissipated(residual + self.problem.crush_energy, self.problem.law.at(x).restitution()),
            });
        };
        let missing = |x: f64| self.missing(bracket.branch, x);
        let on_chord = bracket.chord().map(|x| (x, missing(x)));
        let found = match on_chord.filter(|(_, value)| value.abs() <= bracket.height() * STRAIGHT) {
            Some((x, value)) => {
                observe(x, value);
                Ok(x)
            }
            None => brent_between(missing, narrowed(missing, bracket.ends), 0.0, observe),
        };
        match found {
            Ok(x) => {
                let is_root = self.missing(Branch::Own, x).abs() <= self.problem.crush_energy * ENERGY_MATCH;
                Ok(is_root.then_some(Root { x, steps }))
            }
            Err(RootError::NotBracketed { .. }) => Ok(None),
            Err(RootError::NotConverged { residual, .. }) if !residual.is_finite() => Ok(None),
            Err(RootError::NotConverged { last, residual }) => {
                Err(ReconcileError::NotConverged { last: self.line.speed(last), residual })
            }
        }
    }
}
