//! The speed that a reconstruction finds.

use inputs::Case;
use pim_core::VehicleId;
use reconcile::{AffineImpact, ApproachLine, Iteration, Problem, Quadratic, ReconcileError};

use crate::failure::Failure;
use crate::given::speed_limits;

/// A speed that reconciles crush and impact.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Found {
    /// The vehicle of the speed.
    pub unknown: VehicleId,
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

impl Found {
    /// (m/s) the other admissible speeds, from the slowest approach to the fastest.
    pub fn others(&self) -> impl Iterator<Item = f64> {
        self.admissible.iter().copied().filter(|speed| *speed != self.speed)
    }

    /// (m/s) the speed, unless that with the slowest approach is the answer, which needs no choice.
    pub(crate) fn chosen(&self) -> Option<f64> {
        (self.admissible.first() != Some(&self.speed)).then_some(self.speed)
    }
}

/// (m/s) a speed that exceeds a limit by less than this is taken to be at the limit: 1 km/h.
const AT_LIMIT: f64 = 1.0 / 3.6;

/// (–) relative speeds that differ by less than this share are the same: rounding must not choose.
const AS_FAR: f64 = 1e-9;

/// The admissible speed (m/s) that is the answer: of those within the limits of the vehicle's speed, the one
/// with which the vehicles move least relative to each other, and of two as good the one with the slower
/// approach. If none is within the limits, all are compared. `None` if there is no admissible speed.
pub(crate) fn chosen(case: &Case, problem: &Problem, admissible: &[f64]) -> Option<f64> {
    let id = problem.unknown;
    let [least, most] = speed_limits(&case.vehicles[id.index()]);
    let is_believed = |speed: f64| speed >= least - AT_LIMIT && speed <= most + AT_LIMIT;
    // |v_other − s ê| is least where s = v_other · ê.
    let course = problem.contact.participants()[id.index()].course();
    let beside = problem.motions[id.other().index()].velocity.dot(&course);
    let apart = |speed: f64| (speed - beside).abs();
    admissible.iter().copied().reduce(|best, next| {
        let is_better = match (is_believed(best), is_believed(next)) {
            (false, true) => true,
            (true, false) => false,
            _ => apart(next) < apart(best) * (1.0 - AS_FAR),
        };
        if is_better { next } else { best }
    })
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
