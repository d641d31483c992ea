//! What may be asked of a case. An answer also says whether the evidence that it leaves aside can be weighed.

use std::ops::ControlFlow;

use inputs::Case;

use crate::analysis::Analysis;
use crate::compare::{self, Comparison, LawRow};
use crate::failure::Failure;
use crate::headline::can_be_weighed;
use crate::output::Output;
use crate::sensitivity::{self, Sensitivity, Sweep};
use crate::solve;
use crate::uncertainty::{self, Plan, Stage, Uncertainty};

/// An analysis of a case, with whether the evidence that it leaves aside can be weighed.
fn with_weighing(case: &Case, mut analysis: Analysis) -> Analysis {
    analysis.can_be_weighed = !analysis.left_aside.is_empty() && can_be_weighed(case);
    analysis
}

/// Finds the speed that makes the work of the normal impulse equal the crush energy; or both speeds, where
/// the case seeks them, from how the vehicles left the impact. Where the case has the ground and the drag for
/// it, the vehicles are followed to rest.
///
/// # Errors
/// [`Failure`].
pub fn reconstruct(case: &Case) -> Result<Analysis, Failure> {
    solve::reconstruct(case).map(|analysis| with_weighing(case, analysis))
}

/// Solves the impact of a case that gives both speeds, and follows the vehicles to rest where the case has
/// the ground and the drag for it.
///
/// # Errors
/// [`Failure`].
pub fn impact(case: &Case) -> Result<Analysis, Failure> {
    solve::impact(case).map(|analysis| with_weighing(case, analysis))
}

/// CRASH3 alone: energies and velocity changes from the damage and the PDOF that the file gives.
///
/// # Errors
/// [`Failure`].
pub fn crush(case: &Case) -> Result<Analysis, Failure> {
    solve::crush(case).map(|analysis| with_weighing(case, analysis))
}

/// The most complete analysis that a case allows: [`reconstruct`] if it has a `[reconstruct]` table, else
/// [`impact`] if it has both speeds, else [`crush`].
///
/// # Errors
/// [`Failure`].
pub fn furthest(case: &Case) -> Result<Analysis, Failure> {
    solve::furthest(case).map(|analysis| with_weighing(case, analysis))
}

/// Solves the case with its own law and with every other. It uses the coefficients of the case where they
/// apply, and states an assumption where they do not. It reconstructs a case with a `[reconstruct]` table,
/// and solves the impact of one with both speeds. A case with `[reconstruct]` whose file has both the damage
/// and how the vehicles left the impact is also solved from either alone.
///
/// # Errors
/// [`Failure`] if the case has no answer with its own law.
pub fn compare(case: &Case) -> Result<Comparison, Failure> {
    let Comparison { own, laws, evidence } = compare::compare(case)?;
    let laws = laws.into_iter().map(|row| {
        let other = compare::under(case, &row.law);
        LawRow { answer: row.answer.map(|analysis| with_weighing(&other, analysis)), ..row }
    });
    Ok(Comparison { own: with_weighing(case, own), laws: laws.collect(), evidence })
}

/// Differentiates a case with `[reconstruct]` or with a motion to rest, and sweeps the direction of force of
/// any case whose damage is known.
///
/// The derivatives are exact: the same equations are evaluated on numbers that carry their derivative. The
/// speed found is a root s of the residual R(s, p) = W_n − E, so its derivative by an input p is
/// −(∂R/∂p)/(∂R/∂s), whichever method found it. Of several unknowns x, such as the velocity and the yaw rate
/// of each vehicle that lead to its rest, dx/dp = −(∂R/∂x)⁻¹ ∂R/∂p (implicit function theorem).
///
/// The way to rest is differentiated over the steps that its integration took.
///
/// # Errors
/// [`Failure`] if the case has no answer.
pub fn sensitivity(case: &Case, sweep: Sweep) -> Result<Sensitivity, Failure> {
    let Sensitivity { nominal, derivatives, pdof_sweep } = sensitivity::sensitivity(case, sweep)?;
    Ok(Sensitivity { nominal: with_weighing(case, nominal), derivatives, pdof_sweep })
}

/// Propagates the ranges of a case through `reconstruct` or, if the case gives both speeds and asks for none,
/// through `impact`, or through `motion` if it has no impact.
///
/// Every sample goes through the functions that the central values go through. A range of A or B moves G,
/// where the file does not give that: G = A²/2B of each sample. PDOFs are counted on beyond ±180°, so that
/// they lie about the central one. The start of a way that leads to a rest is sought from that at the central
/// values, and with a turn by as much: where several starts lead there, one the short way and one the long
/// way round, all samples take the same. `progress` is told what is done of how much, and may end the run.
///
/// # Errors
/// [`Failure`] where the case has no answer at its central values, where nothing is a range, and where a
/// range or the plan makes no sense.
pub fn uncertainty(
    case: &Case,
    plan: &Plan,
    progress: &mut (dyn FnMut(Stage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Uncertainty, Failure> {
    uncertainty_of(case, plan, &|_| true, progress)
}

/// The same of the outputs that are wanted alone: the others are neither kept nor summarised, which saves
/// most of their time and memory. What there is has the same bits.
///
/// # Errors
/// As for [`uncertainty()`], and where the case has none of the outputs.
pub fn uncertainty_of(
    case: &Case,
    plan: &Plan,
    wanted: &dyn Fn(Output) -> bool,
    progress: &mut (dyn FnMut(Stage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Uncertainty, Failure> {
    let found = uncertainty::uncertainty_of(case, plan, wanted, progress)?;
    Ok(Uncertainty { nominal: with_weighing(case, found.nominal), ..found })
}
