//! The speed at which the work of the normal impulse equals the crush energy.

use crash3::EnergyBasis;
use pim_core::{
    Approach, Contact, ImpactError, Law, Motion, NormalTangential, Outcome, Real, RestitutionCurve, Vector2,
    normal_work,
};

use crate::answer::{Method, Reconciliation, Search, is_too_fast};
use crate::error::ReconcileError;
use crate::line::ApproachLine;

/// Where the cosine between heading and crush plane normal is below this, rounding of the angles decides what the speed does.
const LEAST_COSINE: f64 = 1e-9;

/// Which vehicle's speed along its heading is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The speed of vehicle 1.
    Speed1,
    /// The speed of vehicle 2.
    Speed2,
}

impl Unknown {
    /// 0 or 1.
    #[inline(always)]
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::Speed1 => 0,
            Self::Speed2 => 1,
        }
    }

    /// Of both vehicles, what belongs to this one. An index would not be resolved in a loop over samples.
    #[inline(always)]
    fn of<V>(self, [one, two]: [V; 2]) -> V {
        match self {
            Self::Speed1 => one,
            Self::Speed2 => two,
        }
    }

    /// Both motions, this vehicle's velocity replaced.
    #[inline(always)]
    fn with_velocity<T: Real>(self, [one, two]: [Motion<T>; 2], velocity: Vector2<T>) -> [Motion<T>; 2] {
        match self {
            Self::Speed1 => [Motion { velocity, ..one }, two],
            Self::Speed2 => [one, Motion { velocity, ..two }],
        }
    }
}

/// A collision of which one speed is unknown and the crush energy is known.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a, T = f64> {
    pub(crate) contact: Contact<T>,
    pub(crate) law: Law<T>,
    pub(crate) restitution: Option<&'a RestitutionCurve<T>>,
    motions: [Motion<T>; 2],
    unknown: Unknown,
    pub(crate) crush_energy: T,
    pub(crate) basis: EnergyBasis,
    pub(crate) line: ApproachLine<T>,
}

impl<'a, T: Real> Problem<'a, T> {
    /// The speed of `unknown` along its heading is to make W_n equal `crush_energy` (J, of both vehicles) on `basis`.
    /// The velocity that `motions` gives for that vehicle is not used; its yaw rate is.
    ///
    /// # Errors
    /// Where the crush energy is not positive, e = 1, or the speed has no effect on u_n.
    #[inline(always)]
    pub fn new(
        contact: Contact<T>,
        law: Law<T>,
        motions: [Motion<T>; 2],
        unknown: Unknown,
        crush_energy: T,
        basis: EnergyBasis,
    ) -> Result<Self, ReconcileError> {
        match Self::pose(contact, law, motions, unknown, crush_energy, basis) {
            (problem, true) => Ok(problem),
            (problem, false) => Err(problem.refusal()),
        }
    }

    /// The same without a reason, for loops over many samples: the problem, and whether it makes sense.
    #[inline(always)]
    #[must_use]
    pub fn pose(
        contact: Contact<T>,
        law: Law<T>,
        motions: [Motion<T>; 2],
        unknown: Unknown,
        crush_energy: T,
        basis: EnergyBasis,
    ) -> (Self, bool) {
        let motions = unknown.with_velocity(motions, Vector2::new(T::ZERO, T::ZERO));
        let Approach { velocity: at_rest, spin: relative_yaw_rate } = contact.approach(&motions);
        let participant = unknown.of(*contact.participants());
        // u is vehicle 1 relative to vehicle 2, so that vehicle 2's speed counts against it.
        let forward = contact.resolve(participant.forward());
        let slope = match unknown {
            Unknown::Speed1 => forward,
            Unknown::Speed2 => NormalTangential { normal: -forward.normal, tangential: -forward.tangential },
        };
        let line = ApproachLine { at_rest, slope, relative_yaw_rate };
        let problem = Self { contact, law, restitution: None, motions, unknown, crush_energy, basis, line };
        let makes_sense = !participant.body().is_fixed()
            & (crush_energy > T::ZERO)
            & crush_energy.is_finite()
            & (law.restitution() != T::ONE)
            & (slope.normal.abs() >= T::from(LEAST_COSINE));
        (problem, makes_sense)
    }

    /// Why a problem makes no sense.
    #[cold]
    fn refusal(&self) -> ReconcileError {
        let vehicle = self.vehicle();
        let e = self.law.restitution();
        if self.unknown.of(*self.contact.participants()).body().is_fixed() {
            ReconcileError::Fixed { vehicle }
        } else if !(self.crush_energy > T::ZERO && self.crush_energy.is_finite()) {
            ReconcileError::NoCrushEnergy { energy: self.crush_energy.value() }
        } else if e == T::ONE {
            ReconcileError::NoRestitutionLoss { restitution: e.value() }
        } else {
            let forward = self.unknown.of(*self.contact.participants()).forward();
            let cosine = self.contact.resolve(forward).normal.value();
            ReconcileError::SpeedWithoutEffect { vehicle, cosine }
        }
    }

    /// The same problem with a restitution that depends on the closing speed, in place of the law's own; `None` leaves that. Only the root-finder
    /// solves a problem with a curve.
    #[must_use]
    pub fn with_restitution_curve(self, curve: impl Into<Option<&'a RestitutionCurve<T>>>) -> Self {
        Self { restitution: curve.into(), ..self }
    }

    /// How the relative velocity at C depends on the speed.
    #[inline(always)]
    #[must_use]
    pub fn line(&self) -> ApproachLine<T> {
        self.line
    }

    /// (m/s) the speed at which the vehicles just touch: u_n = 0.
    #[must_use]
    pub fn touching_speed(&self) -> T {
        self.line.speed(T::ZERO)
    }

    /// (J) the normal work sought; under a curve of restitution, that for the law's own.
    #[must_use]
    pub fn normal_work_sought(&self) -> T {
        self.sought(&self.law)
    }

    /// The law at the approach speed x (m/s).
    #[inline(always)]
    pub(crate) fn law(&self, x: T) -> Law<T> {
        match self.restitution {
            None => self.law,
            Some(curve) => curve.law(self.law, x),
        }
    }

    /// (J) the normal work sought under a law.
    #[inline(always)]
    pub(crate) fn sought(&self, law: &Law<T>) -> T {
        self.basis.dissipated(self.crush_energy, law.restitution())
    }

    /// The motions before impact at the given speed (m/s) of the unknown.
    #[inline(always)]
    #[must_use]
    pub fn motions(&self, speed: T) -> [Motion<T>; 2] {
        let forward = self.unknown.of(*self.contact.participants()).forward();
        self.unknown.with_velocity(self.motions, forward * speed)
    }

    /// (J) W_n at the given speed (m/s), by the law's conditions alone: negative or not a number where no impact can
    /// happen.
    #[inline(always)]
    #[must_use]
    pub fn normal_work(&self, speed: T) -> T {
        let approach = self.contact.approach(&self.motions(speed));
        self.work_at(&self.law(-approach.velocity.normal), approach)
    }

    /// (J) what the normal work at the given speed (m/s) is above the one sought there: zero at every root. Its derivatives by an
    /// input p and by the speed are those of the root, ds/dp = −(∂/∂p)/(∂/∂s), whatever method found it.
    #[inline(always)]
    #[must_use]
    pub fn residual(&self, speed: T) -> T {
        let approach = self.contact.approach(&self.motions(speed));
        let law = self.law(-approach.velocity.normal);
        self.work_at(&law, approach) - self.sought(&law)
    }

    /// The impact at the given speed (m/s), and the law there.
    ///
    /// # Errors
    /// [`ImpactError`].
    #[inline(always)]
    pub fn impact(&self, speed: T) -> Result<(Law<T>, Outcome<T>), ImpactError> {
        let motions = self.motions(speed);
        let law = self.law(-self.contact.approach(&motions).velocity.normal);
        self.contact.impact(motions, &law).map(|outcome| (law, outcome))
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

    pub(crate) fn vehicle(&self) -> usize {
        self.unknown.index() + 1
    }
}

impl Problem<'_, f64> {
    /// The speed that reconciles impact and crush: in closed form where there is one, else by the root-finder.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn solve(&self) -> Result<Reconciliation, ReconcileError> {
        self.closed_form().unwrap_or_else(|| self.root_finder())
    }

    /// The answer by root-finding alone, which serves every law.
    ///
    /// Guarantee: no speed of at most [`FASTEST`](crate::FASTEST) is missed, and none is counted twice, but where rounding decides
    /// whether it exists. W_n less the value sought is a ratio of polynomials of the approach speed within the pieces in which one
    /// regime of the law holds and e is linear. The extrema of the numerator isolate its roots, and Brent's method finds each on the
    /// law's own W_n.
    ///
    /// # Errors
    /// [`ReconcileError`].
    pub fn root_finder(&self) -> Result<Reconciliation, ReconcileError> {
        if let Some(curve) = self.restitution
            && curve.points().iter().all(|&(_, e)| e == 1.0)
        {
            return Err(ReconcileError::NoRestitutionLoss { restitution: 1.0 });
        }
        let mut search = Search::new(self);
        for root in self.roots() {
            let root = root?;
            search.consider(self.line.speed(root.x), Method::RootFinder(root.iterations));
        }
        search.finish()
    }

    /// (m/s) the admissible speeds, from the slowest approach to the fastest, however many. The first is that of
    /// [`solve`](Self::solve).
    pub fn speeds(&self) -> impl Iterator<Item = f64> {
        let (closed, searched) = if self.has_closed_form() {
            (Some(self.approaches().ascending()), None)
        } else {
            (None, Some(self.roots().filter_map(Result::ok).map(|root| root.x)))
        };
        closed
            .into_iter()
            .flatten()
            .chain(searched.into_iter().flatten())
            .map(|x| self.line.speed(x))
            .filter(|&speed| !is_too_fast(speed) && self.impact(speed).is_ok())
    }

    /// (m/s) the approach speed at which a frictionless and plastic impact absorbs the crush energy: whatever the law, that of a
    /// root is of this size.
    pub(crate) fn frictionless_approach_speed(&self) -> f64 {
        // x² = 2 E k_nn
        (2.0 * self.crush_energy * self.contact.inverse_mass().nn).sqrt()
    }
}
