//! A problem that can be solved for a speed.

use pim_core::check;
use real::Real;

use crate::error::ReconcileError;
use crate::line::ApproachLine;
use crate::problem::Problem;

/// A valid problem, with the data that every search needs.
#[derive(Clone, Copy)]
pub(crate) struct Posed<'a, T = f64> {
    pub(crate) problem: &'a Problem<T>,
    pub(crate) line: ApproachLine<T>,
}

impl<T: Real> Posed<'_, T> {
    /// (m/s) the approach speed at which a frictionless, plastic impact absorbs the crush energy: under any
    /// law the approach speed of a root is of this order of magnitude.
    #[inline(always)]
    pub(crate) fn frictionless_approach_speed(self) -> T {
        // x² = 2 E k_nn
        (self.problem.crush_energy * self.problem.contact.inverse_mass().nn * 2.0).sqrt()
    }
}

impl<T: Real> Problem<T> {
    /// The problem with the data that every search needs, if it is valid.
    #[inline(always)]
    pub(crate) fn posed(&self) -> Result<Posed<'_, T>, ReconcileError> {
        let posed = Posed { problem: self, line: self.line() };
        let ApproachLine { at_rest, slope, relative_yaw_rate } = posed.line;
        if !self.makes_sense(slope) {
            return Err(self.refusal());
        }
        check::finite("normal relative velocity", at_rest.normal.value())?;
        check::finite("tangential relative velocity", at_rest.tangential.value())?;
        check::finite("relative yaw rate", relative_yaw_rate.value())?;
        Ok(posed)
    }
}
