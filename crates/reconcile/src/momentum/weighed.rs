//! Both speeds from the whole momentum and the crush energy, an overdetermined system.

use crash3::EnergyBasis;
use pim_core::nalgebra::Matrix2;
use pim_core::{ImpactError, InvalidInput, Law, Outcome, VaryingLaw, Vector2, VehicleId};
use real::elementary;

use crate::momentum::error::MomentumError;
use crate::momentum::{Momentum, dot};
use crate::problem::Problem;

/// Maximum number of steps of the search: five are usual.
const STEPS: usize = 60;

/// Maximum number of times a step is halved when it does not reduce the sum of squares.
const HALVINGS: usize = 40;

/// The search ends with a step that moves the momentum by less than this fraction.
const LAST_STEP: f64 = 1e-12;

/// Relative step of the momentum for a derivative of ln E by differences. Rounding adds an error of 1e-16
/// divided by this, the third derivative one of this squared.
const DIFFERENCE: f64 = 1e-5;

/// Standard deviations of the velocities after the impact and of the crush energy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EvidenceErrors {
    /// (–) σ_V, of the size of a velocity after the impact, as a fraction of it.
    pub speed: f64,
    /// (rad) σ_δ, of its direction.
    pub direction: f64,
    /// (–) σ_c, of the logarithm of the crush energy.
    pub crush_ln: f64,
}

/// Momentum and the crush energy for crossing approaches: three equations for two speeds, weighed by their
/// errors.
///
/// [`Momentum::speeds`] are those of the momentum alone. An impact at the speeds v_1 and v_2 needs a crush
/// energy E(v_1, v_2). The answer minimises the sum of squares
///
/// S = (q − p)ᵀ Σ⁻¹ (q − p) + [ln E(v_1, v_2) − ln E_c]²/σ_c²,  q = m_1 v_1 ê_1 + m_2 v_2 ê_2
/// Σ = Σ_i m_i² (σ_V² V_i V_iᵀ + σ_δ² V_i⊥ V_i⊥ᵀ)
///
/// with the momentum p after the impact, the measured crush energy E_c, and V⊥, which is V turned by 90°. The
/// closer the approaches are to one line, the less momentum determines how the part along the line is
/// divided, and the more weight the crush energy has, as in [`MomentumAndCrush`](crate::MomentumAndCrush).
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumBesideCrush {
    momentum: Momentum,
    /// The impact law and the crush energy; its motions are those of momentum alone.
    problem: Problem,
    errors: EvidenceErrors,
}

/// The answer.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WeighedSpeeds {
    /// (m/s) the speeds found, along the courses.
    pub speeds: [f64; 2],
    /// (–) √S: the disagreement of momentum and crush energy, in standard deviations.
    pub apart: f64,
    /// The law, with the restitution at this closing speed.
    pub law: Law,
    /// The impact at these speeds.
    pub outcome: Outcome,
}

/// Trial speeds.
#[derive(Clone, Copy)]
struct Trial {
    /// w in q = p + Σ w.
    weight: Vector2<f64>,
    /// (kg·m/s) q.
    total: Vector2<f64>,
    /// ln E − ln E_c.
    excess: f64,
    /// S.
    sum: f64,
}

impl MomentumBesideCrush {
    /// Takes the `crush_energy` (J) of both vehicles on `basis`; the crush takes the share λ of the
    /// tangential work, as in [`Problem`].
    ///
    /// # Errors
    /// Those of [`Momentum::speeds`], or if the crush energy or a standard deviation is not positive, e = 1,
    /// or the basis does not allow this λ.
    pub fn new(
        momentum: Momentum,
        law: VaryingLaw,
        crush_energy: f64,
        (basis, tangential_share): (EnergyBasis, f64),
        errors: EvidenceErrors,
    ) -> Result<Self, MomentumError> {
        let motions = momentum.motions_at(momentum.speeds()?);
        for (what, value) in [
            ("error of the speeds after impact", errors.speed),
            ("error of the directions after impact", errors.direction),
            ("error of the crush energy", errors.crush_ln),
        ] {
            super::finite(what, value)?;
            if value <= 0.0 {
                return Err(InvalidInput::NotPositive { what, value }.into());
            }
        }
        let contact = momentum.contact;
        let unknown = VehicleId::One;
        let problem = Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share };
        if !(crush_energy > 0.0 && crush_energy.is_finite()) {
            Err(MomentumError::NoCrushEnergy { energy: crush_energy })
        } else if problem.law.is_elastic() {
            Err(MomentumError::NoRestitutionLoss { restitution: problem.law.nominal().restitution() })
        } else if !problem.has_tangential_share() {
            Err(MomentumError::TangentialShare { share: tangential_share, basis })
        } else {
            Ok(Self { momentum, problem, errors })
        }
    }

    /// The speeds with the least sum of squares, by a descent from those of momentum alone. At a kink of E,
    /// where the law changes its branch, the search may end next to the minimum.
    ///
    /// # Errors
    /// [`MomentumError::Inadmissible`] if no impact is possible at the speeds of momentum alone, or at those
    /// found.
    pub fn solve(&self) -> Result<WeighedSpeeds, MomentumError> {
        let p = self.momentum.total();
        let covariance = self.covariance();
        let sigma = self.errors.crush_ln;
        let mut here = self.trial(Vector2::new(0.0, 0.0));
        self.answer(&here)?;
        for _ in 0..STEPS {
            let g = self.slope(here.total);
            let along = covariance * g;
            // w′ = −g [ln E − ln E_c + g·(p − q)]/(σ_c² + gᵀ Σ g)
            let gain = (here.excess + dot(g, p - here.total)) / (sigma * sigma + dot(g, along));
            let step = g * -gain - here.weight;
            let Some(next) = self.downhill(&here, step) else { break };
            let moved = next.total - here.total;
            here = next;
            if dot(moved, moved) <= LAST_STEP * LAST_STEP * dot(p, p) {
                break;
            }
        }
        self.answer(&here)
    }

    /// The whole step of the weight if it reduces the sum of squares, else the largest halving that does.
    fn downhill(&self, here: &Trial, step: Vector2<f64>) -> Option<Trial> {
        let mut part = 1.0;
        for _ in 0..HALVINGS {
            let next = self.trial(here.weight + step * part);
            if next.sum < here.sum {
                return Some(next);
            }
            part *= 0.5;
        }
        None
    }

    fn trial(&self, weight: Vector2<f64>) -> Trial {
        let shift = self.covariance() * weight;
        let total = self.momentum.total() + shift;
        // ln E − ln E_c
        let excess = elementary::ln(self.crush_energy(total) / self.problem.crush_energy);
        let share = excess / self.errors.crush_ln;
        // (q − p)ᵀ Σ⁻¹ (q − p) = wᵀ Σ w
        Trial { weight, total, excess, sum: dot(weight, shift) + share * share }
    }

    /// ∂ ln E/∂q.
    fn slope(&self, total: Vector2<f64>) -> Vector2<f64> {
        let h = DIFFERENCE * elementary::sqrt(dot(total, total));
        let along = |step: Vector2<f64>| {
            elementary::ln(self.crush_energy(total + step) / self.crush_energy(total - step)) / (2.0 * h)
        };
        Vector2::new(along(Vector2::new(h, 0.0)), along(Vector2::new(0.0, h)))
    }

    /// (J) E at a momentum q (kg·m/s), by the law's conditions alone: NaN if the vehicles do not approach and
    /// push.
    fn crush_energy(&self, total: Vector2<f64>) -> f64 {
        let before = self.momentum.motions_at(self.momentum.speeds_with(total));
        let approach = self.momentum.contact.approach(&before);
        let closing = -approach.velocity.normal;
        let law = self.problem.law.at(closing);
        if closing <= 0.0 || self.problem.work_at(&law, approach) <= 0.0 {
            return f64::NAN;
        }
        // E = (W_n + λ W_t)/(W_n + λ W_t at E = 1 J)
        self.problem.crush_work_at(&law, approach) / self.problem.basis.dissipated(1.0, law.restitution())
    }

    fn impact(&self, speeds: [f64; 2]) -> Result<(Law, Outcome), ImpactError> {
        let (contact, before) = (self.momentum.contact, self.momentum.motions_at(speeds));
        let law = self.problem.law.at(-contact.approach(&before).velocity.normal);
        Ok((law, contact.impact(before, &law)?))
    }

    fn answer(&self, trial: &Trial) -> Result<WeighedSpeeds, MomentumError> {
        let speeds = self.momentum.speeds_with(trial.total);
        let (law, outcome) =
            self.impact(speeds).map_err(|reason| MomentumError::Inadmissible { speeds, reason })?;
        Ok(WeighedSpeeds { speeds, apart: elementary::sqrt(trial.sum), law, outcome })
    }

    /// (kg²·m²/s²) Σ, the covariance of p.
    fn covariance(&self) -> Matrix2<f64> {
        let mut sum = Matrix2::zeros();
        for (m, after) in self.momentum.masses().into_iter().zip(&self.momentum.after) {
            // Σ_i m_i² (σ_V² V_i V_iᵀ + σ_δ² V_i⊥ V_i⊥ᵀ)
            let along = after.velocity * (m * self.errors.speed);
            let across = Vector2::new(-after.velocity.y, after.velocity.x) * (m * self.errors.direction);
            for side in [along, across] {
                sum += side * side.transpose();
            }
        }
        sum
    }
}
