//! Many problems at once whose restitution depends on the closing speed.

use crash3::EnergyBasis;
use pim_core::{Law, Outcome, RestitutionCurve};

use crate::isolated::{Meeting, Push, against, along, full, slowest};
use crate::pieces::{Branch, Stretch};
use crate::posed::Posed;
use crate::problem::Problem;

/// Problems under curves of restitution, of which what a search takes lies in columns, so that loops over
/// them vectorise.
///
/// Their laws have one condition, and as many `BRANCHES` as laws without a limit of which one acts: three
/// under a friction limit, one where the law has none.
pub struct CurveBlock<const N: usize, const BRANCHES: usize> {
    basis: EnergyBasis,
    meetings: [[f64; N]; Meeting::NUMBERS],
    /// (m/s) the least and the greatest approach speed.
    reach: [[f64; N]; 2],
}

/// The laws of a [`CurveBlock`], one by one, whatever their restitution. A trait, as a closure would not
/// become part of a loop.
pub trait Laws {
    /// That of one problem.
    fn law(&self, lane: usize) -> Law;
}

impl<const N: usize, const BRANCHES: usize> CurveBlock<N, BRANCHES> {
    /// Without a problem.
    #[inline(always)]
    #[must_use]
    pub fn new(basis: EnergyBasis) -> Self {
        Self { basis, meetings: [[0.0; N]; Meeting::NUMBERS], reach: [[0.0; N]; 2] }
    }

    /// Sets one problem, whatever its law. Its share of the tangential work has to be zero.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, problem: &Problem) {
        let posed = Posed { problem, line: problem.line() };
        for (column, number) in self.meetings.iter_mut().zip(posed.meeting().numbers()) {
            column[lane] = number;
        }
        let [least, most] = posed.reach();
        self.reach[0][lane] = least;
        self.reach[1][lane] = most;
    }

    /// (m/s) the slowest approach speed of each problem that has the energy sought, under curves through
    /// these points (closing speed in m/s, coefficient of restitution); zero where there is none, or where
    /// [`solve`](Problem::solve) has to search for it. Where there is one, it has the same bits.
    #[inline(always)]
    #[must_use]
    pub fn slowest_approaches(&self, points: &[[[f64; N]; 2]], laws: &impl Laws) -> [f64; N] {
        let mut found = [0.0; N];
        let mut is_open = [true; N];
        let [Some([_, first]), Some(last)] = [points.first(), points.last()] else { return found };
        let pushes = self.pushes(laws);
        let before = [[0.0; N], *first];
        let after = [[f64::INFINITY; N], last[1]];
        let ends = points.iter().chain([&after]);
        for stretch in [&before].into_iter().chain(points).zip(ends) {
            if !is_open.contains(&true) {
                break;
            }
            let mut roots = [[f64::INFINITY; N]; BRANCHES];
            let mut is_sure = [true; N];
            let mut search = Searching { stretch, laws, is_open: &is_open, is_sure: &mut is_sure };
            // Not a loop, so that each of them is compiled for one law.
            if BRANCHES == 1 {
                self.branch(own, &pushes[0], &mut search, &mut roots[0]);
            } else {
                self.branch(full, &pushes[0], &mut search, &mut roots[0]);
                self.branch(against, &pushes[1], &mut search, &mut roots[1]);
                self.branch(along, &pushes[2], &mut search, &mut roots[2]);
            }
            for lane in 0..N {
                let all: [f64; BRANCHES] = core::array::from_fn(|i| roots[i][lane]);
                let (x, are_apart) = slowest(all);
                let (is_found, is_sure) = (x < f64::INFINITY, is_sure[lane] & are_apart);
                found[lane] = if is_open[lane] & is_sure & is_found { x } else { found[lane] };
                is_open[lane] &= is_sure & !is_found;
            }
        }
        found
    }

    /// P_n of all problems under each branch of their laws.
    #[inline(always)]
    fn pushes(&self, laws: &impl Laws) -> [[[f64; N]; Push::NUMBERS]; BRANCHES] {
        let mut pushes = [[[0.0; N]; Push::NUMBERS]; BRANCHES];
        if BRANCHES == 1 {
            self.set_pushes(own, laws, &mut pushes[0]);
        } else {
            self.set_pushes(full, laws, &mut pushes[0]);
            self.set_pushes(against, laws, &mut pushes[1]);
            self.set_pushes(along, laws, &mut pushes[2]);
        }
        pushes
    }

    #[inline(always)]
    fn set_pushes(
        &self,
        branch: impl Fn(&Law) -> Branch,
        laws: &impl Laws,
        pushes: &mut [[f64; N]; Push::NUMBERS],
    ) {
        for lane in 0..N {
            let law = laws.law(lane);
            let push = self.meeting(lane).push(&law, branch(&law));
            for (column, number) in pushes.iter_mut().zip(push.numbers()) {
                column[lane] = number;
            }
        }
    }

    /// The roots in a stretch under one branch of the laws, infinite where there is none.
    #[inline(always)]
    fn branch<L: Laws>(
        &self,
        branch: impl Fn(&Law) -> Branch,
        pushes: &[[f64; N]; Push::NUMBERS],
        search: &mut Searching<'_, N, L>,
        roots: &mut [f64; N],
    ) {
        let Searching { stretch: ([from, e_from], [to, e_to]), laws, is_open, is_sure } = search;
        let mut may_have = [false; N];
        for lane in 0..N {
            let stretch = self.stretch(lane, [(from[lane], e_from[lane]), (to[lane], e_to[lane])]);
            let changes = self.meeting(lane).changes(&stretch, &push(pushes, lane));
            let is_searched = is_open[lane] & stretch.has_length() & !stretch.is_elastic();
            is_sure[lane] &= !is_searched | changes.none | changes.one;
            may_have[lane] = is_searched & changes.one;
        }
        if !may_have.contains(&true) {
            return;
        }
        let mut speeds = [0.0; N];
        let mut is_found = [false; N];
        for lane in 0..N {
            let stretch = self.stretch(lane, [(from[lane], e_from[lane]), (to[lane], e_to[lane])]);
            let (root, is_root) = self.meeting(lane).isolated(&stretch, &push(pushes, lane));
            speeds[lane] = root.x;
            is_found[lane] = is_root;
        }
        for lane in 0..N {
            let stretch = self.stretch(lane, [(from[lane], e_from[lane]), (to[lane], e_to[lane])]);
            let law = laws.law(lane);
            let [acts, is_root_sure] = self.meeting(lane).acts(&stretch, &law, branch(&law), speeds[lane]);
            is_sure[lane] &= !may_have[lane] | (is_found[lane] & is_root_sure);
            roots[lane] = if may_have[lane] & acts { speeds[lane] } else { f64::INFINITY };
        }
    }

    #[inline(always)]
    fn meeting(&self, lane: usize) -> Meeting {
        Meeting::of(core::array::from_fn(|i| self.meetings[i][lane]), self.basis)
    }

    #[inline(always)]
    fn stretch(&self, lane: usize, points: [(f64, f64); 2]) -> Stretch {
        Stretch::between(points).within([self.reach[0][lane], self.reach[1][lane]])
    }
}

/// What the search in one stretch takes for all problems.
struct Searching<'a, const N: usize, L> {
    /// The points at its ends.
    stretch: (&'a [[f64; N]; 2], &'a [[f64; N]; 2]),
    laws: &'a L,
    /// Whether no root is found yet.
    is_open: &'a [bool; N],
    /// Whether signs isolate the roots.
    is_sure: &'a mut [bool; N],
}

#[inline(always)]
fn push<const N: usize>(pushes: &[[f64; N]; Push::NUMBERS], lane: usize) -> Push {
    Push::of(core::array::from_fn(|i| pushes[i][lane]))
}

#[inline(always)]
fn own(_: &Law) -> Branch {
    Branch::Own
}

/// e at each closing speed (m/s), as [`RestitutionCurve::at`], on curves through these points; and whether
/// there is such a curve.
#[inline(always)]
#[must_use]
pub fn restitutions<const N: usize>(points: &[[[f64; N]; 2]], speeds: &[f64; N]) -> ([f64; N], [bool; N]) {
    let Some([first, e_first]) = points.first() else { return ([f64::NAN; N], [false; N]) };
    let mut e = *e_first;
    let mut is_curve = [true; N];
    for lane in 0..N {
        is_curve[lane] = RestitutionCurve::is_point(first[lane], e_first[lane]);
    }
    for pair in points.windows(2) {
        let [[v0, e0], [v1, e1]] = pair else { continue };
        for lane in 0..N {
            let ends = [(v0[lane], e0[lane]), (v1[lane], e1[lane])];
            let between = RestitutionCurve::between(ends, speeds[lane]);
            e[lane] = if speeds[lane] >= v0[lane] { between } else { e[lane] };
            e[lane] = if speeds[lane] >= v1[lane] { e1[lane] } else { e[lane] };
            is_curve[lane] &= RestitutionCurve::is_point(v1[lane], e1[lane]) & (v0[lane] < v1[lane]);
        }
    }
    (e, is_curve)
}

impl Problem {
    /// (m/s) −u_n of the motions at the speed that an approach speed (m/s) belongs to.
    #[inline(always)]
    #[must_use]
    pub fn closing_speed_at(&self, approach_speed: f64) -> f64 {
        -self.contact.approach(&self.motions_at(self.line().speed(approach_speed))).velocity.normal
    }

    /// The speed that an approach speed (m/s) belongs to, the impact at it, and whether that can be an
    /// answer.
    #[inline(always)]
    #[must_use]
    pub fn answer_at(&self, approach_speed: f64) -> (f64, Outcome, bool) {
        Posed { problem: self, line: self.line() }.answer_at(approach_speed)
    }
}
