//! The analyses of a case. An answer also says whether the evidence that it does not use can be weighed.

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

/// An analysis of a case, and whether the evidence that it does not use can be weighed.
fn with_weighing(case: &Case, mut analysis: Analysis) -> Analysis {
    analysis.can_be_weighed = can_be_weighed(case, &analysis);
    analysis
}

/// The same, with a warning if a speed that was found depends strongly on an angle.
fn judged(case: &Case, mut analysis: Analysis) -> Analysis {
    analysis.warnings.extend(sensitivity::hangs_on_angle(case, &analysis));
    with_weighing(case, analysis)
}

/// Finds the speed that makes the work of the normal impulse equal the crush energy, or both speeds, if the
/// case asks for both, from how the vehicles left the impact. If the case has the ground and the drag for it,
/// the vehicles are followed to rest.
///
/// # Errors
/// [`Failure`].
pub fn reconstruct(case: &Case) -> Result<Analysis, Failure> {
    solve::reconstruct(case).map(|analysis| judged(case, analysis))
}

/// Solves the impact of a case that gives both speeds, and follows the vehicles to rest if the case has the
/// ground and the drag for it.
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
    solve::furthest(case).map(|analysis| judged(case, analysis))
}

/// Solves the case with its own law and with every other. It uses the coefficients of the case where they
/// apply, and states an assumption where they do not. It reconstructs a case with a `[reconstruct]` table,
/// and solves the impact of one with both speeds. A case with `[reconstruct]` whose file has both the damage
/// and how the vehicles left the impact is also solved from each alone.
///
/// # Errors
/// [`Failure`] if the case has no answer with its own law.
pub fn compare(case: &Case) -> Result<Comparison, Failure> {
    let Comparison { own, laws, evidence } = compare::compare(case)?;
    let laws = laws.into_iter().map(|row| {
        let other = compare::under(case, &row.law);
        LawRow { answer: row.answer.map(|analysis| with_weighing(&other, analysis)), ..row }
    });
    Ok(Comparison { own: judged(case, own), laws: laws.collect(), evidence })
}

/// Differentiates a case with `[reconstruct]` or with a motion to rest, and sweeps the direction of force of
/// any case with known damage.
///
/// The derivatives are exact: the same equations are evaluated on numbers that carry their derivative. The
/// speed found is a root s of the residual R(s, p) = W_n − E, so its derivative with respect to an input p is
/// −(∂R/∂p)/(∂R/∂s), whichever method found it. For several unknowns x, such as the velocity and the yaw rate
/// of each vehicle that lead to its rest position, dx/dp = −(∂R/∂x)⁻¹ ∂R/∂p (implicit function theorem).
///
/// The path to rest is differentiated along the steps of its integration.
///
/// # Errors
/// [`Failure`] if the case has no answer.
pub fn sensitivity(case: &Case, sweep: Sweep) -> Result<Sensitivity, Failure> {
    let case = &*case.without_avoid();
    let Sensitivity { nominal, derivatives, pdof_sweep } = sensitivity::sensitivity(case, sweep)?;
    Ok(Sensitivity { nominal: judged(case, nominal), derivatives, pdof_sweep })
}

/// Propagates the ranges of a case through `reconstruct` or, if the case gives both speeds and asks for none,
/// through `impact`, through `motion` if it has no impact, or through `crush` if it has one vehicle.
///
/// Every sample goes through the same functions as the central values. A range of A or B varies G if the file
/// does not give G: G = A²/2B of each sample. PDOFs continue beyond ±180°, so that they lie around the
/// central one. The start of a path that leads to a rest position is searched for from that at the central
/// values, with about the same turn: if several starts lead there, one the short way round and one the long
/// way, all samples take the same. `progress` receives the work done and its total, and may end the run.
///
/// # Errors
/// [`Failure`] if the case has no answer at its central values, if nothing is a range, or if a range or the
/// plan is invalid.
pub fn uncertainty(
    case: &Case,
    plan: &Plan,
    progress: &mut (dyn FnMut(Stage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Uncertainty, Failure> {
    uncertainty_of(case, plan, &|_| true, progress)
}

/// The same for only the outputs that are requested, which saves most of the time and memory of the others.
/// The results have the same bits.
///
/// # Errors
/// As for [`uncertainty()`], and if the case has none of the outputs.
pub fn uncertainty_of(
    case: &Case,
    plan: &Plan,
    wanted: &dyn Fn(Output) -> bool,
    progress: &mut (dyn FnMut(Stage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Uncertainty, Failure> {
    let case = &*case.without_avoid();
    let found = uncertainty::uncertainty_of(case, plan, wanted, progress)?;
    Ok(Uncertainty { nominal: judged(case, found.nominal), ..found })
}
