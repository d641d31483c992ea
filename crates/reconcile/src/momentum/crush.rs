//! Both speeds from momentum along one axis and the crush energy.

use crash3::EnergyBasis;
use pim_core::{Contact, Law, Motion, Outcome, Participant, Real, VaryingLaw, Vector2, VehicleId};

use crate::answer::{Reconciliation, SolutionMethod};
use crate::error::ReconcileError;
use crate::momentum::error::MomentumError;
use crate::momentum::{Momentum, cross, dot};
use crate::problem::Problem;

/// An axis may differ from a unit vector only by rounding.
const UNIT: f64 = 1e-9;

/// If both courses have less than this cosine with the axis, rounding of the angles decides the effect of the
/// speeds.
const LEAST_COSINE: f64 = 1e-9;

/// Momentum along one axis and the crush energy: two equations for both speeds, for any angle between the
/// courses. The momentum across the axis remains as a check.
///
/// The momentum restricts the pairs of speeds to a line. Along it the relative velocity of the CGs changes in
/// one direction only, by the *relative speed* σ:
///
/// a_1 v_1 + a_2 v_2 = p·â,  a_i = m_i ê_i·â
/// v_1 = (p·â ê_2·ŵ + a_2 σ)/|d|,  v_2 = (p·â ê_1·ŵ − a_1 σ)/|d|,  d = a_2 ê_1 + a_1 ê_2,  ŵ = d/|d|
///
/// An impact depends only on the relative velocity. So σ is the unknown of a [`Problem`], which finds all its
/// values, and σ gives the two speeds. For courses along one line, σ is the closing speed, which then follows
/// from the crush energy alone.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumAndCrush<T = f64> {
    momentum: Momentum<T>,
    /// v₁ and v₂ at σ = 0, and their derivatives with respect to σ.
    base: [T; 2],
    slope: [T; 2],
    /// Vehicle 1 moves along ŵ with the speed σ; vehicle 2 has, with the opposite sign, the constant part of
    /// the relative velocity.
    problem: Problem<T>,
}

/// The answer: both speeds, and their impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct BothSpeeds<T = f64> {
    /// (m/s) the speeds found, along the courses: of several admissible pairs, the one with the slowest
    /// approach.
    pub speeds: [T; 2],
    /// (m/s) σ, their relative speed.
    pub relative: T,
    /// Number of admissible pairs, which [`MomentumAndCrush::speeds`] lists.
    pub admissible: usize,
    /// The law at the speeds found.
    pub law: Law<T>,
    /// The impact at the speeds found.
    pub outcome: Outcome<T>,
    /// (J) the work sought, W_n + λ W_t.
    pub normal_work: T,
    /// How the speeds were found. The speed of a step is the relative speed σ.
    pub method: SolutionMethod,
}

impl<T: Real> MomentumAndCrush<T> {
    /// Both speeds must give the component of the momentum along `axis`, a unit vector of the scene, and the
    /// work W_n + λ W_t that the crush energy (J) of both vehicles represents on `basis`. For collinear
    /// approaches the axis is [`Momentum::common_axis`].
    ///
    /// # Errors
    /// Those of [`Momentum::check`], or if the axis is not a unit vector or at right angles to both courses,
    /// the speeds have no effect on u_n, the crush energy is not positive, or e = 1.
    pub fn new(
        momentum: Momentum<T>,
        axis: Vector2<T>,
        law: VaryingLaw<T>,
        crush_energy: T,
        basis: EnergyBasis,
        tangential_share: T,
    ) -> Result<Self, MomentumError> {
        momentum.check()?;
        let length = dot(axis, axis).sqrt();
        let is_unit = (length - 1.0).abs() <= T::from(UNIT);
        if !is_unit {
            return Err(MomentumError::NoAxis { length: length.value() });
        }
        let [e1, e2] = momentum.courses();
        let [m1, m2] = momentum.masses();
        let cosines = [dot(e1, axis), dot(e2, axis)];
        if cosines.iter().all(|cosine| cosine.abs() < T::from(LEAST_COSINE)) {
            return Err(MomentumError::AcrossAxis { cosines: cosines.map(Real::value) });
        }
        // a_i = m_i ê_i·â
        let (a1, a2) = (m1 * cosines[0], m2 * cosines[1]);
        let along = dot(momentum.total(), axis);
        // d = a₂ ê₁ + a₁ ê₂
        let d = e1 * a2 + e2 * a1;
        let size = dot(d, d).sqrt();
        let w = d / size;
        // v₁ = (p ê₂·ŵ + a₂ σ)/|d|,  v₂ = (p ê₁·ŵ − a₁ σ)/|d|
        let base = [along * dot(e2, w) / size, along * dot(e1, w) / size];
        let slope = [a2 / size, -a1 / size];
        // The part of the relative velocity across ŵ, which is the same for every σ.
        let across = Vector2::new(-w.y, w.x);
        let fixed = across * dot(e1 * base[0] - e2 * base[1], across);
        let [one, two] = momentum.contact.participants();
        let arm = one.arm();
        let turned = Participant::new(*one.body(), w.y.atan2(w.x), dot(arm, w), cross(w, arm))?;
        let [yaw_1, yaw_2] = momentum.yaw_rates;
        let problem = Problem {
            contact: Contact::new([turned, *two], momentum.contact.crush_plane())?,
            law,
            motions: [Motion::rest().with_yaw_rate(yaw_1), Motion { velocity: -fixed, yaw_rate: yaw_2 }],
            unknown: VehicleId::One,
            crush_energy,
            basis,
            tangential_share,
        };
        let solver = Self { momentum, base, slope, problem };
        solver.problem.check().map_err(|error| solver.refusal(error))?;
        Ok(solver)
    }

    /// The momentum.
    #[must_use]
    pub fn momentum(&self) -> &Momentum<T> {
        &self.momentum
    }

    /// The problem of the relative speed σ: its vehicle 1 moves as vehicle 1 does relative to vehicle 2. Its
    /// [`residual`](Problem::residual) gives the exact derivatives of σ, and with
    /// [`speeds_at`](Self::speeds_at) those of both speeds.
    #[must_use]
    pub fn problem(&self) -> &Problem<T> {
        &self.problem
    }

    /// (m/s) both speeds at the relative speed σ (m/s).
    #[inline(always)]
    #[must_use]
    pub fn speeds_at(&self, relative: T) -> [T; 2] {
        let ([b1, b2], [s1, s2]) = (self.base, self.slope);
        [b1 + s1 * relative, b2 + s2 * relative]
    }

    /// The answer in closed form, or `None` under a law that has none: see [`Problem::closed_form`].
    ///
    /// # Errors
    /// [`MomentumError`].
    #[must_use]
    pub fn closed_form(&self) -> Option<Result<BothSpeeds<T>, MomentumError>> {
        Some(self.answer(self.problem.closed_form()?))
    }

    fn answer(
        &self,
        found: Result<Reconciliation<T>, ReconcileError>,
    ) -> Result<BothSpeeds<T>, MomentumError> {
        let Reconciliation { speed: relative, admissible, law, normal_work, method, .. } =
            found.map_err(|error| self.refusal(error))?;
        let speeds = self.speeds_at(relative);
        let outcome = self
            .momentum
            .contact
            .impact(self.momentum.motions_at(speeds), &law)
            .map_err(|reason| MomentumError::Inadmissible { speeds: speeds.map(Real::value), reason })?;
        Ok(BothSpeeds { speeds, relative, admissible, law, outcome, normal_work, method })
    }

    /// The error of the search, in terms of both speeds.
    #[cold]
    fn refusal(&self, error: ReconcileError) -> MomentumError {
        let speeds = |relative: f64| self.speeds_at(T::from(relative)).map(Real::value);
        match error {
            // The constructor has checked that both vehicles can move.
            ReconcileError::Fixed { .. } => MomentumError::Fixed { vehicle: VehicleId::One },
            ReconcileError::NoCrushEnergy { energy } => MomentumError::NoCrushEnergy { energy },
            ReconcileError::NoRestitutionLoss { restitution } => {
                MomentumError::NoRestitutionLoss { restitution }
            }
            ReconcileError::TangentialShare { share, basis } => {
                MomentumError::TangentialShare { share, basis }
            }
            ReconcileError::SpeedWithoutEffect { cosine, .. } => MomentumError::AlongCrushPlane { cosine },
            ReconcileError::NotReached { energy, tangential_share, .. } => {
                MomentumError::NotReached { energy, tangential_share }
            }
            ReconcileError::Inadmissible { speed, reason, .. } => {
                MomentumError::Inadmissible { speeds: speeds(speed), reason }
            }
            ReconcileError::Impact(reason) => MomentumError::Impact(reason),
            ReconcileError::NotConverged { last, residual } => {
                MomentumError::NotConverged { speeds: speeds(last), residual }
            }
        }
    }
}

impl MomentumAndCrush {
    /// Both speeds.
    ///
    /// # Errors
    /// [`MomentumError`].
    pub fn solve(&self) -> Result<BothSpeeds, MomentumError> {
        self.answer(self.problem.solve())
    }

    /// (m/s) all admissible pairs of speeds with a relative speed of at most [`FASTEST`](crate::FASTEST),
    /// from the slowest approach to the fastest. The first is that of [`solve`](Self::solve).
    pub fn speeds(&self) -> impl Iterator<Item = [f64; 2]> {
        self.problem.speeds().map(|relative| self.speeds_at(relative))
    }
}
