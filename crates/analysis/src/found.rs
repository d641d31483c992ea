//! The speed that a reconstruction finds.

use reconcile::{AffineImpact, ApproachLine, Iteration, Problem, Quadratic, ReconcileError, Unknown};

use crate::failure::Failure;

/// A speed that reconciles crush and impact.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Found {
    /// The vehicle of the speed.
    pub unknown: Unknown,
    /// (m/s) the speed along the heading.
    pub speed: f64,
    /// (m/s) all admissible speeds, from the slowest approach to the fastest.
    pub admissible: Vec<f64>,
    /// (J) crush energy of both vehicles.
    pub crush_energy: f64,
    /// (J) required work, W_n + λ W_t: the crush energy, less the energy that restitution returns if the
    /// basis is absorbed energy. λ is 0 unless the basis is a share of the tangential work.
    pub normal_work: f64,
    /// How the relative velocity at C depends on the speed.
    pub line: ApproachLine,
    /// The equation of the closed form; `None` if the root finder gave the answer.
    pub quadratic: Option<Quadratic>,
    /// Impulse and sliding as functions of the approach speed, if they are affine.
    pub affine_impact: Option<AffineImpact>,
    /// The steps of the root finder; `None` if a closed form gave the answer.
    pub iterations: Option<Vec<Iteration>>,
}

/// Why a problem has no answer, with the nearest possible impact.
pub(crate) fn refused(problem: &Problem, refusal: ReconcileError) -> Failure {
    match refusal {
        ReconcileError::NotReached { vehicle, energy, tangential_share } => {
            Failure::NotReached { vehicle, energy, tangential_share, nearest: problem.nearest() }
        }
        refusal => refusal.into(),
    }
}
