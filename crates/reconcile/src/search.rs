//! The search for the speeds of a problem.

use pim_core::Outcome;

use crate::answer::{Found, Reconciliation, Search, SolutionMethod, Trail, Wanted, is_too_fast};
use crate::error::ReconcileError;
use crate::posed::Posed;
use crate::problem::Problem;
use crate::root::Root;

impl<'a> Posed<'a> {
    /// The answer by root-finding, with the recorded steps.
    pub(crate) fn search<S: Trail>(self, wanted: Wanted) -> Result<Found<f64, S>, ReconcileError> {
        let mut search = Search::new(self.problem, wanted);
        for root in self.roots() {
            let Root { x, steps } = root?;
            search.consider(self.line.speed(x), steps);
            if search.is_done() {
                break;
            }
        }
        search.finish()
    }

    pub(crate) fn speeds(self) -> impl Iterator<Item = f64> + use<'a> {
        let (closed, searched) = if self.problem.has_closed_form() {
            (Some(self.approaches()), None)
        } else {
            (None, Some(self.searched()))
        };
        self.admissible(closed.into_iter().flatten().chain(searched.into_iter().flatten()))
    }

    /// Whether there is more than one admissible speed, without moving a search, which is large, unless
    /// needed.
    fn has_several_speeds(self) -> bool {
        if self.problem.has_closed_form() {
            let approaches = self.approaches();
            approaches.are_several() && self.admissible(approaches.into_iter()).nth(1).is_some()
        } else {
            self.admissible(self.searched()).nth(1).is_some()
        }
    }

    fn searched(self) -> impl Iterator<Item = f64> + use<'a> {
        self.roots::<()>().filter_map(Result::ok).map(|root| root.x)
    }

    /// The speeds of the admissible approach speeds.
    fn admissible<I: Iterator<Item = f64>>(self, approaches: I) -> impl Iterator<Item = f64> + use<'a, I> {
        let speeds = approaches.map(move |x| self.line.speed(x));
        speeds.filter(move |&speed| !is_too_fast(speed) && self.problem.impact(speed).is_ok())
    }
}

impl Problem {
    /// The speed that reconciles impact and crush: in closed form if there is one, else by the root-finder.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn solve(&self) -> Result<Reconciliation, ReconcileError> {
        self.solve_for(Wanted::All)
    }

    /// As [`solve`](Self::solve), but of several admissible speeds the nearest to `speed` (m/s): one of
    /// [`speeds`](Self::speeds), or that of a problem with nearly the same numbers.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn solve_near(&self, speed: f64) -> Result<Reconciliation, ReconcileError> {
        self.solve_for(Wanted::Nearest(speed))
    }

    fn solve_for(&self, wanted: Wanted) -> Result<Reconciliation, ReconcileError> {
        let posed = self.posed()?;
        Ok(if self.has_closed_form() {
            posed.closed_form(wanted)?.reconciling(self, |()| SolutionMethod::ClosedForm)
        } else {
            posed.search(wanted)?.reconciling(self, SolutionMethod::RootFinder)
        })
    }

    /// The speed (m/s) that [`solve`](Self::solve) finds, and its impact: the same bits in less time, as no
    /// steps are recorded and no other speeds are sought.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn speed_and_impact(&self) -> Result<(f64, Outcome), ReconcileError> {
        let posed = self.posed()?;
        if self.has_closed_form() {
            let Found { speed, outcome, .. } = posed.closed_form(Wanted::First)?;
            return Ok((speed, outcome));
        }
        // The only root needs no search, which is large.
        if let Some(Root { x, .. }) = posed.only_root::<()>()
            && let (speed, outcome, true) = posed.answer_at(x)
        {
            return Ok((speed, outcome));
        }
        let Found { speed, outcome, .. } = posed.search::<()>(Wanted::First)?;
        Ok((speed, outcome))
    }

    /// The answer by root-finding alone, which serves every law.
    ///
    /// Guarantee: no speed of at most [`FASTEST`](crate::FASTEST) is missed, and none is counted twice,
    /// unless rounding decides whether it exists. Within each piece, in which one regime of the law holds and
    /// e is linear, W_n less the value sought is a ratio of polynomials in the approach speed. Either the
    /// signs of Bernstein coefficients show that a range has at most one root, or the extrema of the
    /// numerator isolate its roots; Newton's method or Brent's finds each.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn root_finder(&self) -> Result<Reconciliation, ReconcileError> {
        Ok(self.posed()?.search(Wanted::All)?.reconciling(self, SolutionMethod::RootFinder))
    }

    /// (m/s) all admissible speeds, from the slowest approach to the fastest; none if [`check`](Self::check)
    /// refuses the problem. The first is that of [`solve`](Self::solve).
    pub fn speeds(&self) -> impl Iterator<Item = f64> {
        self.posed().into_iter().flat_map(Posed::speeds)
    }

    /// Whether [`speeds`](Self::speeds) has more than one, in less time.
    #[must_use]
    pub fn has_several_speeds(&self) -> bool {
        self.posed().is_ok_and(Posed::has_several_speeds)
    }
}
