//! A collision with one unknown speed.

use crash3::EnergyBasis;
use pim_core::{
    Approach, Contact, ImpactError, Law, LawImpulse, Motion, NormalTangential, Outcome, Real, VaryingLaw,
    Vector2, VehicleId, normal_work,
};

use crate::error::ReconcileError;
use crate::line::ApproachLine;

/// If the cosine between course and crush plane normal is below this, rounding of the angles decides the
/// effect of the speed.
const LEAST_COSINE: f64 = 1e-9;

/// The element of a pair that belongs to a vehicle. An index would not be resolved in a loop over samples.
#[inline(always)]
fn of<V>(vehicle: VehicleId, [one, two]: [V; 2]) -> V {
    match vehicle {
        VehicleId::One => one,
        VehicleId::Two => two,
    }
}

/// Both motions, with the velocity of a vehicle replaced.
#[inline(always)]
fn with_velocity<T: Real>(
    vehicle: VehicleId,
    [one, two]: [Motion<T>; 2],
    velocity: Vector2<T>,
) -> [Motion<T>; 2] {
    match vehicle {
        VehicleId::One => [Motion { velocity, ..one }, two],
        VehicleId::Two => [one, Motion { velocity, ..two }],
    }
}

/// A collision with one unknown speed and known crush energy: the speed of `unknown` along its course must
/// make W_n equal to the crush energy on `basis`.
///
/// The fields may hold any values. [`check`](Self::check) tests whether they make a valid problem;
/// [`solve`](Self::solve) calls it first.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Problem<T = f64> {
    /// The geometry.
    pub contact: Contact<T>,
    /// The impact law. If its restitution depends on the closing speed, only the root-finder solves the
    /// problem.
    pub law: VaryingLaw<T>,
    /// Motions before impact. The velocity of the vehicle whose speed is sought is not used; its yaw rate is.
    pub motions: [Motion<T>; 2],
    /// The vehicle whose speed is sought.
    pub unknown: VehicleId,
    /// (J) crush energy of both vehicles.
    pub crush_energy: T,
    /// The energy that the crush represents.
    pub basis: EnergyBasis,
    /// (–) λ, from 0 to 1: the share of the tangential work W_t that the crush takes in addition to the
    /// normal work, so that W_n + λ W_t equals the crush energy. 0 is the method of SAE 980025, and the only
    /// value allowed on the basis `absorbed`.
    pub tangential_share: T,
}

impl<T: Real> Problem<T> {
    /// Whether the problem is valid.
    ///
    /// # Errors
    /// If the vehicle is fixed, the crush energy is not positive, e = 1, the speed has no effect on u_n, or a
    /// motion is not finite.
    #[inline(always)]
    pub fn check(&self) -> Result<(), ReconcileError> {
        self.posed().map(|_| ())
    }

    #[inline(always)]
    pub(crate) fn makes_sense(&self, slope: NormalTangential<T>) -> bool {
        !of(self.unknown, *self.contact.participants()).body().is_fixed()
            & (self.crush_energy > T::ZERO)
            & self.crush_energy.is_finite()
            & !self.law.is_elastic()
            & self.has_tangential_share()
            & (slope.normal.abs() >= T::from(LEAST_COSINE))
    }

    /// Whether the basis allows this λ.
    #[inline(always)]
    pub(crate) fn has_tangential_share(&self) -> bool {
        let share = self.tangential_share;
        let most = match self.basis {
            EnergyBasis::Dissipated => T::ONE,
            EnergyBasis::Absorbed => T::ZERO,
        };
        (share >= T::ZERO) & (share <= most) & share.is_finite()
    }

    /// The reason why the problem is not valid.
    #[cold]
    pub(crate) fn refusal(&self) -> ReconcileError {
        let vehicle = self.unknown;
        if of(self.unknown, *self.contact.participants()).body().is_fixed() {
            ReconcileError::Fixed { vehicle }
        } else if !(self.crush_energy > T::ZERO && self.crush_energy.is_finite()) {
            ReconcileError::NoCrushEnergy { energy: self.crush_energy.value() }
        } else if self.law.is_elastic() {
            ReconcileError::NoRestitutionLoss { restitution: self.law.nominal().restitution().value() }
        } else if !self.has_tangential_share() {
            ReconcileError::TangentialShare { share: self.tangential_share.value(), basis: self.basis }
        } else {
            let course = of(self.unknown, *self.contact.participants()).course();
            let cosine = self.contact.resolve(course).normal.value();
            ReconcileError::SpeedWithoutEffect { vehicle, cosine }
        }
    }

    /// The relative velocity at C as a function of the speed.
    #[inline(always)]
    #[must_use]
    pub fn line(&self) -> ApproachLine<T> {
        let at_rest = with_velocity(self.unknown, self.motions, Vector2::new(T::ZERO, T::ZERO));
        let Approach { velocity: at_rest, relative_yaw_rate } = self.contact.approach(&at_rest);
        let course = self.contact.resolve(of(self.unknown, *self.contact.participants()).course());
        // u is vehicle 1 relative to vehicle 2, so vehicle 2's speed enters with the opposite sign.
        let slope = match self.unknown {
            VehicleId::One => course,
            VehicleId::Two => NormalTangential { normal: -course.normal, tangential: -course.tangential },
        };
        ApproachLine { at_rest, slope, relative_yaw_rate }
    }

    /// (m/s) the speed at which the vehicles just touch: u_n = 0.
    #[must_use]
    pub fn touching_speed(&self) -> T {
        self.line().speed(T::ZERO)
    }

    /// (J) the normal work sought, which may include λ W_t; under a restitution curve, that for its first
    /// point.
    #[must_use]
    pub fn normal_work_sought(&self) -> T {
        self.sought(&self.law.nominal())
    }

    /// (J) the normal work sought under a law.
    #[inline(always)]
    pub(crate) fn sought(&self, law: &Law<T>) -> T {
        self.basis.dissipated(self.crush_energy, law.restitution())
    }

    /// The motions before impact at the given speed (m/s) of the unknown.
    #[inline(always)]
    #[must_use]
    pub fn motions_at(&self, speed: T) -> [Motion<T>; 2] {
        let course = of(self.unknown, *self.contact.participants()).course();
        with_velocity(self.unknown, self.motions, course * speed)
    }

    /// (J) W_n at the given speed (m/s), by the law's conditions alone: negative or NaN if no impact is
    /// possible.
    #[inline(always)]
    #[must_use]
    pub fn normal_work(&self, speed: T) -> T {
        let approach = self.contact.approach(&self.motions_at(speed));
        self.work_at(&self.law.at(-approach.velocity.normal), approach)
    }

    /// (J) W_n + λ W_t at the given speed (m/s), likewise: the work compared with the crush energy.
    #[inline(always)]
    #[must_use]
    pub fn crush_work(&self, speed: T) -> T {
        let approach = self.contact.approach(&self.motions_at(speed));
        self.crush_work_at(&self.law.at(-approach.velocity.normal), approach)
    }

    /// (J) W_n + λ W_t at the given speed (m/s) less the work sought there: zero at every root. Its
    /// derivatives with respect to an input p and to the speed give those of the root, ds/dp =
    /// −(∂/∂p)/(∂/∂s), whatever method found it.
    #[inline(always)]
    #[must_use]
    pub fn residual(&self, speed: T) -> T {
        let approach = self.contact.approach(&self.motions_at(speed));
        let law = self.law.at(-approach.velocity.normal);
        self.crush_work_at(&law, approach) - self.sought(&law)
    }

    /// The impact at the given speed (m/s), and the law there.
    ///
    /// # Errors
    /// [`ImpactError`].
    #[inline(always)]
    pub fn impact(&self, speed: T) -> Result<(Law<T>, Outcome<T>), ImpactError> {
        let motions = self.motions_at(speed);
        let law = self.law.at(-self.contact.approach(&motions).velocity.normal);
        self.contact.impact(motions, &law).map(|outcome| (law, outcome))
    }

    /// (J) W_n + λ W_t under a law: the work compared with the crush energy.
    #[inline(always)]
    pub(crate) fn crush_work_at(&self, law: &Law<T>, approach: Approach<T>) -> T {
        let normal = self.work_at(law, approach);
        if self.tangential_share.is_constant_zero() {
            return normal;
        }
        let impulse = law.impulse(&self.contact.inverse_mass(), approach);
        let sliding = self.sliding(approach, impulse);
        // W_n + λ W_t,  W_t = −½ P_t (u_t + U_t)
        normal - self.tangential_share * (impulse.linear.tangential * sliding) * 0.5
    }

    /// (m/s) u_t + U_t
    #[inline(always)]
    pub(crate) fn sliding(&self, approach: Approach<T>, impulse: LawImpulse<T>) -> T {
        let LawImpulse { linear, moment, .. } = impulse;
        let separation = self.contact.inverse_mass().separation(approach, linear, moment);
        approach.velocity.tangential + separation.velocity.tangential
    }

    #[inline(always)]
    pub(crate) fn work_at(&self, law: &Law<T>, approach: Approach<T>) -> T {
        let u = approach.velocity;
        let impulse = law.impulse(&self.contact.inverse_mass(), approach).linear;
        // The law's own condition: in a glancing contact u + K P would lose U_n in the rounding of K P.
        // U_n = −e u_n
        let separation = NormalTangential { normal: -(u.normal * law.restitution()), ..u };
        normal_work(u, impulse, separation)
    }
}
