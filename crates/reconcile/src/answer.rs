//! The result of a search for the speed.

use pim_core::{Law, Outcome, Real};

use crate::brent::MAX_STEPS;
use crate::error::ReconcileError;
use crate::problem::Problem;

/// (m/s) no vehicle is faster: roots beyond are solutions of the equations only.
pub const FASTEST: f64 = 1000.0;

/// The answer: the speed, and its impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Reconciliation<T = f64> {
    /// (m/s) the speed found, along the vehicle's course: of several admissible speeds, the one with the
    /// slowest approach, or the [nearest](Problem::solve_near) to a given one.
    pub speed: T,
    /// Number of admissible speeds, which [`Problem::speeds`] lists.
    pub admissible: usize,
    /// The law at the speed found: the given one, with the restitution at this closing speed if it varies.
    pub law: Law<T>,
    /// The law without a friction limit that acts at the speed found, see [`Law::acting`]: `law` itself if it
    /// has no limit.
    pub acting: Law<T>,
    /// The impact at the speed found.
    pub outcome: Outcome<T>,
    /// (J) the work sought, W_n + λ W_t: the crush energy on the basis `dissipated`.
    pub normal_work: T,
    /// How the speed was found.
    pub method: SolutionMethod,
}

/// How a speed was found.
///
/// Code that depends on the variant matches without a catch-all arm, so that a new one must be decided there
/// before it compiles; adding one is a breaking change.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a box would be an allocation")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SolutionMethod {
    /// W_n is quadratic in the speed, possibly piecewise.
    ClosedForm,
    /// Newton's method or Brent's.
    RootFinder(Iterations),
}

/// One step of the root-finder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Iteration {
    /// (m/s) speed tried.
    pub speed: f64,
    /// (J) W_n + λ W_t at that speed.
    pub normal_work: f64,
}

/// The steps that led to the speed found.
#[derive(Clone, Copy, PartialEq)]
pub struct Iterations {
    steps: [Iteration; MAX_STEPS],
    count: usize,
}

impl core::fmt::Debug for Iterations {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self.as_slice()).finish()
    }
}

/// The record that a search keeps of its steps.
pub(crate) trait Trail {
    fn none() -> Self;

    /// Adds a step, which is computed only if it is kept.
    fn push(&mut self, step: impl FnOnce() -> Iteration);
}

impl Trail for Iterations {
    fn none() -> Self {
        Self { steps: [Iteration::default(); MAX_STEPS], count: 0 }
    }

    fn push(&mut self, step: impl FnOnce() -> Iteration) {
        if let Some(place) = self.steps.get_mut(self.count) {
            *place = step();
            self.count += 1;
        }
    }
}

/// Keeps nothing: with its steps an answer takes a kilobyte.
impl Trail for () {
    fn none() -> Self {}

    fn push(&mut self, _: impl FnOnce() -> Iteration) {}
}

impl Iterations {
    /// The steps in order.
    #[must_use]
    pub fn as_slice(&self) -> &[Iteration] {
        &self.steps[..self.count]
    }
}

/// Written as a list of the steps taken.
#[cfg(feature = "serde")]
impl serde::Serialize for Iterations {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.as_slice())
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Iterations {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Steps)
    }
}

/// Reads the steps of a search.
#[cfg(feature = "serde")]
struct Steps;

#[cfg(feature = "serde")]
impl<'de> serde::de::Visitor<'de> for Steps {
    type Value = Iterations;

    fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "at most {MAX_STEPS} steps of a root-finder")
    }

    fn visit_seq<A: serde::de::SeqAccess<'de>>(self, mut steps: A) -> Result<Iterations, A::Error> {
        let mut iterations = Iterations::none();
        while let Some(step) = steps.next_element()? {
            if iterations.count == MAX_STEPS {
                return Err(serde::de::Error::invalid_length(MAX_STEPS + 1, &self));
            }
            iterations.push(|| step);
        }
        Ok(iterations)
    }
}

/// Whether no vehicle can have this speed.
#[inline(always)]
pub(crate) fn is_too_fast<T: Real>(speed: T) -> bool {
    speed.abs() > T::from(FASTEST)
}

/// The answer of a search, with its recorded steps.
pub(crate) struct Found<T, S> {
    pub(crate) speed: T,
    admissible: usize,
    law: Law<T>,
    pub(crate) outcome: Outcome<T>,
    steps: S,
}

impl<T: Real, S> Found<T, S> {
    #[inline(always)]
    pub(crate) fn reconciling(
        self,
        problem: &Problem<T>,
        method: impl FnOnce(S) -> SolutionMethod,
    ) -> Reconciliation<T> {
        let Self { speed, admissible, law, outcome, steps } = self;
        let normal_work = problem.sought(&law);
        let acting = law.acting(outcome.regime, outcome.impulse_ratio);
        Reconciliation { speed, admissible, law, acting, outcome, normal_work, method: method(steps) }
    }
}

/// The speeds that a search has to find.
#[derive(Clone, Copy)]
pub(crate) enum Wanted {
    First,
    /// The first, and the number of all.
    All,
    /// The nearest to this speed (m/s), and the number of all.
    Nearest(f64),
}

impl Wanted {
    /// Whether a speed (m/s) is preferred to one with a slower approach.
    #[inline(always)]
    fn prefers<T: Real>(self, speed: T, slower: T) -> bool {
        match self {
            Self::First | Self::All => false,
            Self::Nearest(wanted) => (speed - wanted).abs() < (slower - wanted).abs(),
        }
    }
}

/// Checks the speeds that give the energy, in the order of their approach speeds.
pub(crate) struct Search<'a, T, S> {
    problem: &'a Problem<T>,
    wanted: Wanted,
    found: Option<Found<T, S>>,
    refused: Option<ReconcileError>,
}

impl<'a, T: Real, S> Search<'a, T, S> {
    pub(crate) fn new(problem: &'a Problem<T>, wanted: Wanted) -> Self {
        Self { problem, wanted, found: None, refused: None }
    }

    #[inline(always)]
    pub(crate) fn consider(&mut self, speed: T, steps: S) {
        if is_too_fast(speed) {
            return;
        }
        let problem = self.problem;
        match problem.impact(speed) {
            Ok((law, outcome)) => {
                let admissible = self.found.as_ref().map_or(0, |found| found.admissible) + 1;
                match &mut self.found {
                    Some(found) if !self.wanted.prefers(speed, found.speed) => found.admissible = admissible,
                    found => *found = Some(Found { speed, admissible, law, outcome, steps }),
                }
            }
            Err(reason) => {
                let vehicle = problem.unknown;
                self.refused.get_or_insert(ReconcileError::Inadmissible {
                    vehicle,
                    speed: speed.value(),
                    reason,
                });
            }
        }
    }

    /// Whether the search has found all that is wanted.
    pub(crate) fn is_done(&self) -> bool {
        matches!(self.wanted, Wanted::First) && self.found.is_some()
    }

    #[inline(always)]
    pub(crate) fn finish(self) -> Result<Found<T, S>, ReconcileError> {
        let problem = self.problem;
        self.found.ok_or_else(|| {
            self.refused.unwrap_or(ReconcileError::NotReached {
                vehicle: problem.unknown,
                energy: problem.normal_work_sought().value(),
                tangential_share: problem.tangential_share.value(),
            })
        })
    }
}
