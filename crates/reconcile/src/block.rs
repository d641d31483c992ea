//! Many problems at once whose restitution depends on the closing speed.

use crash3::EnergyBasis;
use pim_core::{Law, Outcome, RestitutionCurve};

use crate::isolated::{Meeting, Push, against, along, full, slowest};
use crate::pieces::{Branch, HALVINGS, Stretch};
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
            if !any(&is_open) {
                break;
            }
            let mut parts = self.parts(stretch, &is_open);
            while any(&parts.is_searched) {
                let mut roots = [[f64::INFINITY; N]; BRANCHES];
                let mut search =
                    Searching { laws, parts: &parts, several: [false; N], is_unsure: [false; N] };
                // Not a loop, so that each of them is compiled for one law.
                if BRANCHES == 1 {
                    self.branch(own, &pushes[0], &mut search, &mut roots[0]);
                } else {
                    self.branch(full, &pushes[0], &mut search, &mut roots[0]);
                    self.branch(against, &pushes[1], &mut search, &mut roots[1]);
                    self.branch(along, &pushes[2], &mut search, &mut roots[2]);
                }
                let Searching { several, is_unsure, .. } = search;
                for lane in 0..N {
                    let all: [f64; BRANCHES] = core::array::from_fn(|i| roots[i][lane]);
                    let (x, are_apart) = slowest(all);
                    let is_told = parts.is_searched[lane] & !several[lane];
                    let is_sure = is_told & !is_unsure[lane] & are_apart;
                    let is_found = is_sure & (x < f64::INFINITY);
                    found[lane] = if is_found { x } else { found[lane] };
                    is_open[lane] &= !is_told | (is_sure & !is_found);
                }
                parts.go_on(&several, &mut is_open);
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

    /// The roots in a part of a stretch under one branch of the laws, infinite where there is none.
    #[inline(always)]
    fn branch<L: Laws>(
        &self,
        branch: impl Fn(&Law) -> Branch,
        pushes: &[[f64; N]; Push::NUMBERS],
        search: &mut Searching<'_, N, L>,
        roots: &mut [f64; N],
    ) {
        let Searching { laws, parts, several, is_unsure } = search;
        // Columns of their own, of which the compiler knows that no pointer leads to them.
        let [mut none, mut one, mut is_sure] = [[false; N]; 3];
        for lane in 0..N {
            let changes = self.meeting(lane).changes(&parts.slowest(lane), &push(pushes, lane));
            (none[lane], one[lane], is_sure[lane]) = (changes.none, changes.one, changes.is_sure);
        }
        let mut may_have = [false; N];
        for lane in 0..N {
            // Of the branches in their order the first one that is not sure decides.
            let is_searched = parts.is_searched[lane] & !several[lane] & !is_unsure[lane];
            let is_open = is_searched & !none[lane] & !one[lane];
            may_have[lane] = is_searched & one[lane];
            several[lane] |= is_open & is_sure[lane];
            is_unsure[lane] |= is_open & !is_sure[lane];
        }
        if !any(&may_have) {
            return;
        }
        let mut speeds = [0.0; N];
        let mut is_found = [false; N];
        for lane in 0..N {
            let (root, is_root) = self.meeting(lane).isolated(&parts.slowest(lane), &push(pushes, lane));
            speeds[lane] = root.x;
            is_found[lane] = is_root;
        }
        let mut is_acting = [false; N];
        for lane in 0..N {
            let law = laws.law(lane);
            let [acts, is_root_sure] =
                self.meeting(lane).acts(&parts.slowest(lane), &law, branch(&law), speeds[lane]);
            (is_acting[lane], is_sure[lane]) = (acts, is_root_sure);
        }
        for lane in 0..N {
            is_unsure[lane] |= may_have[lane] & !(is_found[lane] & is_sure[lane]);
            roots[lane] = if may_have[lane] & is_acting[lane] { speeds[lane] } else { f64::INFINITY };
        }
    }

    #[inline(always)]
    fn meeting(&self, lane: usize) -> Meeting {
        Meeting::of(core::array::from_fn(|i| self.meetings[i][lane]), self.basis)
    }

    /// The stretches between two points each, as a part of their own.
    #[inline(always)]
    fn parts<'a>(
        &self,
        ([from, e_from], [to, e_to]): (&'a [[f64; N]; 2], &'a [[f64; N]; 2]),
        is_open: &[bool; N],
    ) -> Parts<'a, N> {
        let mut parts = Parts {
            start: from,
            end: to,
            restitution: [e_from, e_to],
            rise: [0.0; N],
            low: [0.0; N],
            ends: [[0.0; N]; HALVINGS + 1],
            count: [1; N],
            is_searched: [false; N],
        };
        for lane in 0..N {
            let stretch = Stretch::between([(from[lane], e_from[lane]), (to[lane], e_to[lane])])
                .within([self.reach[0][lane], self.reach[1][lane]]);
            let [low, high] = stretch.range;
            (parts.rise[lane], parts.low[lane], parts.ends[0][lane]) = (stretch.rise, low, high);
            parts.is_searched[lane] = is_open[lane] & stretch.has_length() & !stretch.is_elastic();
        }
        parts
    }
}

/// A stretch of each problem in parts, of which the slowest is searched first and halved where it may have
/// several roots: as a search for one problem does it.
struct Parts<'a, const N: usize> {
    /// (m/s)
    start: &'a [f64; N],
    /// (m/s)
    end: &'a [f64; N],
    restitution: [&'a [f64; N]; 2],
    /// (s/m)
    rise: [f64; N],
    /// (m/s) where the slowest part begins.
    low: [f64; N],
    /// (m/s) where each part ends, the slowest first.
    ends: [[f64; N]; HALVINGS + 1],
    /// How many parts there are.
    count: [u8; N],
    /// Whether a part is left to search.
    is_searched: [bool; N],
}

impl<const N: usize> Parts<'_, N> {
    #[inline(always)]
    fn slowest(&self, lane: usize) -> Stretch {
        let [e_0, e_1] = self.restitution;
        Stretch {
            start: self.start[lane],
            length: self.end[lane] - self.start[lane],
            restitution: [e_0[lane], e_1[lane]],
            rise: self.rise[lane],
            range: [self.low[lane], self.ends[0][lane]],
        }
    }

    /// The next part is searched of each problem that is open: the slower half of the one before where that
    /// may have several roots. A problem of which that is no longer halved is closed.
    #[inline(always)]
    fn go_on(&mut self, is_halved: &[bool; N], is_open: &mut [bool; N]) {
        if any(is_halved) {
            for (lane, is_halved) in is_halved.iter().enumerate() {
                is_open[lane] &= !is_halved | (usize::from(self.count[lane]) <= HALVINGS);
            }
            for i in (0..HALVINGS).rev() {
                for (lane, is_halved) in is_halved.iter().enumerate() {
                    let end = self.ends[i][lane];
                    self.ends[i + 1][lane] = if *is_halved { end } else { self.ends[i + 1][lane] };
                }
            }
            for (lane, is_halved) in is_halved.iter().enumerate() {
                let middle = Stretch::middle([self.low[lane], self.ends[0][lane]]);
                self.ends[0][lane] = if *is_halved { middle } else { self.ends[0][lane] };
            }
        }
        for (lane, is_halved) in is_halved.iter().enumerate() {
            self.low[lane] = if *is_halved { self.low[lane] } else { self.ends[0][lane] };
        }
        for (lane, is_halved) in is_halved.iter().enumerate() {
            let count = if *is_halved { self.count[lane] + 1 } else { self.count[lane] - 1 };
            self.is_searched[lane] &= is_open[lane] & (count > 0);
            self.count[lane] = if self.is_searched[lane] { count } else { 1 };
        }
        if !any(&self.is_searched) {
            return;
        }
        for i in 0..HALVINGS {
            for (lane, is_halved) in is_halved.iter().enumerate() {
                let next = self.ends[i + 1][lane];
                self.ends[i][lane] = if *is_halved { self.ends[i][lane] } else { next };
            }
        }
    }
}

/// What the search in one part takes for all problems.
struct Searching<'a, const N: usize, L> {
    laws: &'a L,
    parts: &'a Parts<'a, N>,
    /// Whether a part may have several roots under one branch: fewer in each half.
    several: [bool; N],
    /// Whether rounding may decide what roots it has.
    is_unsure: [bool; N],
}

/// Whether one of these is true. `contains` would be a call, and the column one that a pointer leads to.
#[inline(always)]
fn any<const N: usize>(flags: &[bool; N]) -> bool {
    let mut any = false;
    for flag in flags {
        any |= *flag;
    }
    any
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
