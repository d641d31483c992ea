//! A problem for which a speed can be sought.

use real::Real;

use crate::error::ReconcileError;
use crate::line::ApproachLine;
use crate::problem::Problem;

/// A problem that makes sense, and what every search in it needs.
#[derive(Clone, Copy)]
pub(crate) struct Posed<'a, T = f64> {
    pub(crate) problem: &'a Problem<T>,
    pub(crate) line: ApproachLine<T>,
}

impl<T: Real> Posed<'_, T> {
    /// (m/s) the approach speed at which a frictionless and plastic impact absorbs the crush energy: whatever
    /// the law, that of a root is of this size.
    #[inline(always)]
    pub(crate) fn frictionless_approach_speed(self) -> T {
        // x² = 2 E k_nn
        (self.problem.crush_energy * self.problem.contact.inverse_mass().nn * 2.0).sqrt()
    }
}

impl<T: Real> Problem<T> {
    /// The problem with what every search needs, if a speed can be sought.
    #[inline(always)]
    pub(crate) fn posed(&self) -> Result<Posed<'_, T>, ReconcileError> {
        let posed = Posed { problem: self, line: self.line() };
        if self.makes_sense(posed.line.slope) { Ok(posed) } else { Err(self.refusal()) }
    }
}
