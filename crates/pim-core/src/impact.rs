//! The impact itself: from the approach to the motion after it, with the energy balance.

use core::f64::consts::PI;

use nalgebra::Vector2;
use real::Real;

use crate::body::Motion;
use crate::check;
use crate::contact::{Contact, NormalTangential};
use crate::error::{ImpactError, InvalidInput};
use crate::law::{Law, LawImpulse, Regime, Solution};
use crate::vehicle_id::VehicleId;

/// The impact creates energy if E_L is below zero by more than this fraction of the energy that the impulses
/// exchange, |P|·(|u| + |U|) in each direction and likewise for the moment; less is rounding. The works
/// themselves cannot be the scale: with e = 1 and no friction they are nothing but rounding.
const ENERGY_ROUNDING: f64 = 1e-12;

/// The complete result of an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Outcome<T = f64> {
    /// (N·s) impulse P on vehicle 1, along n and t. Vehicle 2 receives −P.
    pub impulse: NormalTangential<T>,
    /// (N·s) P in the scene frame.
    pub impulse_vector: Vector2<T>,
    /// (N·m·s) moment impulse M on vehicle 1; zero under a law without one.
    pub moment_impulse: T,
    /// Whether the law's friction limit was reached; `None` for a law without one.
    pub regime: Option<Regime>,
    /// μ = P_t/P_n.
    pub impulse_ratio: T,
    /// μ_c: the ratio that makes the final tangential velocity at C zero. `None` if the surfaces slide so
    /// fast that no push could stop them, however rough they are.
    pub critical_impulse_ratio: Option<T>,
    /// (m/s) u: velocity of vehicle 1 relative to vehicle 2 at C before impact.
    pub approach: NormalTangential<T>,
    /// (m/s) U: the same after impact.
    pub separation: NormalTangential<T>,
    /// Motion of both vehicles before impact.
    pub before: [Motion<T>; 2],
    /// Motion of both vehicles after impact.
    pub after: [Motion<T>; 2],
    /// (m/s) ΔV vectors V − v of the two CGs in the scene frame.
    pub delta_v: [Vector2<T>; 2],
    /// Unit vectors of both vehicles' forward axes in the scene.
    pub forward: [Vector2<T>; 2],
    /// The energy balance.
    pub energy: Energy<T>,
}

impl<T: Real> Outcome<T> {
    /// (rad) scene angle of the impulse on vehicle 1, in (−π, π].
    #[inline(always)]
    #[must_use]
    pub fn impulse_direction(&self) -> T {
        direction(self.impulse_vector)
    }

    /// (rad) principal direction of force for both vehicles, see [`pdof`].
    #[inline(always)]
    #[must_use]
    pub fn pdof(&self) -> [T; 2] {
        let [f1, f2] = self.forward;
        [pdof(f1, self.impulse_vector), pdof(f2, -self.impulse_vector)]
    }

    /// (m/s) ΔV of both vehicles along their own forward axes and to their left: longitudinal and lateral, as
    /// recorders store them. The sign of the lateral one turns with the axes.
    #[inline(always)]
    #[must_use]
    pub fn delta_v_components(&self) -> [[T; 2]; 2] {
        let [f1, f2] = self.forward;
        let [dv1, dv2] = self.delta_v;
        [ahead_and_left(f1, dv1), ahead_and_left(f2, dv2)]
    }

    /// (m/s) −u_n: the closing speed along the normal at C.
    #[inline(always)]
    #[must_use]
    pub fn closing_speed(&self) -> T {
        -self.approach.normal
    }

    /// (rad/s) ω_1 − ω_2 before impact, and Ω_1 − Ω_2 after it.
    #[inline(always)]
    #[must_use]
    pub fn relative_yaw_rate(&self) -> [T; 2] {
        [relative_yaw_rate(&self.before), relative_yaw_rate(&self.after)]
    }

    /// (m/s) |ΔV| of both vehicles.
    #[inline(always)]
    #[must_use]
    pub fn delta_v_magnitude(&self) -> [T; 2] {
        self.delta_v.map(|dv| (dv.x * dv.x + dv.y * dv.y).sqrt())
    }
}

/// (rad) principal direction of the force that gives a vehicle `impulse` (N·s, scene frame), for the unit
/// vector `forward` of its forward axis: the direction *from which* the force comes, clockwise positive from
/// the heading, in (−π, π]. 0 is a square hit in front, π/2 one from the right.
#[inline(always)]
#[must_use]
pub fn pdof<T: Real>(forward: Vector2<T>, impulse: Vector2<T>) -> T {
    let [ahead, left] = ahead_and_left(forward, impulse);
    // The force comes from −P; clockwise from the heading is to the right: PDOF = atan2(P_left, −P_ahead).
    direction(Vector2::new(-ahead, left))
}

/// (rad) tolerance for a direction that rounding leaves on the other side of the half turn.
const HALF_TURN_ROUNDING: f64 = 1e-12;

/// (rad) angle of a vector from the x axis, in (−π, π]: that along −x is +π, on whichever side of it rounding
/// leaves the vector.
#[inline(always)]
#[must_use]
pub fn direction<T: Real>(vector: Vector2<T>) -> T {
    let angle = vector.y.atan2(vector.x);
    let value = angle.value();
    if value < HALF_TURN_ROUNDING - PI { angle - value + PI } else { angle }
}

/// Resolves a scene vector along a vehicle's forward axis (unit vector) and to its left.
#[inline(always)]
fn ahead_and_left<T: Real>(forward: Vector2<T>, vector: Vector2<T>) -> [T; 2] {
    // a·f, and the third component of f × a
    [vector.x * forward.x + vector.y * forward.y, vector.y * forward.x - vector.x * forward.y]
}

/// (J) the energy balance of an impact: `before` − `after` = `loss` = `normal_work` + `tangential_work` +
/// `moment_work`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy<T = f64> {
    /// (J) kinetic energy of both vehicles before impact.
    pub before: T,
    /// (J) the same after impact.
    pub after: T,
    /// (J) E_L, the kinetic energy that the impact takes.
    pub loss: T,
    /// (J) W_n, the energy taken by the normal impulse: the crush energy (dissipated).
    pub normal_work: T,
    /// (J) W_t, the energy taken by the tangential impulse. Negative where it gives energy back.
    pub tangential_work: T,
    /// (J) W_m, the energy taken by the moment impulse.
    pub moment_work: T,
}

/// (J) W_n: the energy that the normal impulse takes out of the vehicles.
///
/// By Kelvin's theorem an impulse does work equal to the impulse times the mean velocity of its point of
/// application before and after (SAE 980025, Eq 4).
#[inline(always)]
#[must_use]
pub fn normal_work<T: Real>(
    approach: NormalTangential<T>,
    impulse: NormalTangential<T>,
    separation: NormalTangential<T>,
) -> T {
    // W_n = −½ P_n (u_n + U_n)
    -(impulse.normal * (approach.normal + separation.normal)) * 0.5
}

/// (rad/s) yaw rate of vehicle 1 relative to vehicle 2.
#[inline(always)]
fn relative_yaw_rate<T: Real>([one, two]: &[Motion<T>; 2]) -> T {
    one.yaw_rate - two.yaw_rate
}

/// Whether E_L is below zero by more than rounding.
#[inline(always)]
fn creates_energy<T: Real>(outcome: &Outcome<T>, law: &Law<T>) -> bool {
    let (p, u, v) = (outcome.impulse, outcome.approach, outcome.separation);
    let mut exchanged = p.normal.abs() * (u.normal.abs() + v.normal.abs())
        + p.tangential.abs() * (u.tangential.abs() + v.tangential.abs());
    if law.has_moment() {
        let [before, after] = outcome.relative_yaw_rate();
        exchanged += outcome.moment_impulse.abs() * (before.abs() + after.abs());
    }
    outcome.energy.loss < -(exchanged * ENERGY_ROUNDING)
}

fn representable<T: Real>(what: &'static str, value: T) -> Result<(), ImpactError> {
    if value.is_finite() { Ok(()) } else { Err(ImpactError::Overflow { what, value: value.value() }) }
}

impl<T: Real> Contact<T> {
    /// The effect of the collision on both vehicles under `law`, given their motions before it.
    ///
    /// # Errors
    /// [`ImpactError`]: the vehicles do not approach, the contact jams, they would have to pull on each
    /// other, the coefficients create energy, or a body cannot have the given motion.
    pub fn impact(&self, motions: [Motion<T>; 2], law: &Law<T>) -> Result<Outcome<T>, ImpactError> {
        self.check(&motions)?;
        match self.impact_with_validity(motions, law) {
            (outcome, true) => Ok(outcome),
            _ => Err(self.refusal(motions, law)),
        }
    }

    /// Like [`impact`](Self::impact), but returns the outcome of the law's conditions and a validity flag in
    /// place of an error, so that loops over many samples vectorise: for bodies and laws of a known kind it
    /// is branch-free. The flag tells whether a collision can have this outcome. A fixed body must be at
    /// rest.
    #[inline(always)]
    #[must_use]
    pub fn impact_with_validity(&self, motions: [Motion<T>; 2], law: &Law<T>) -> (Outcome<T>, bool) {
        let approach = self.approach(&motions);
        let solution = law.solve(&self.inverse_mass, approach);
        let pushes = (approach.velocity.normal < T::ZERO) & law.pushes(&solution);
        let outcome = self.outcome(motions, approach.velocity, solution);
        let possible = pushes
            & outcome.energy.before.is_finite()
            & outcome.energy.loss.is_finite()
            & !creates_energy(&outcome, law);
        (outcome, possible)
    }

    /// The reason why the outcome of [`impact_with_validity`](Self::impact_with_validity) is impossible.
    #[cold]
    fn refusal(&self, motions: [Motion<T>; 2], law: &Law<T>) -> ImpactError {
        let approach = self.approach(&motions);
        let u_n = approach.velocity.normal;
        let solution = law.solve(&self.inverse_mass, approach);
        if let Err(overflow) = representable("normal relative velocity", u_n) {
            return overflow;
        }
        if u_n >= T::ZERO {
            return ImpactError::NotApproaching { u_n: u_n.value() };
        }
        if !law.pushes(&solution) {
            return law.refusal(&self.inverse_mass, &solution);
        }
        let Energy { before, loss, normal_work, tangential_work, moment_work, .. } =
            self.outcome(motions, approach.velocity, solution).energy;
        for (what, value) in [("initial kinetic energy", before), ("energy loss", loss)] {
            if let Err(overflow) = representable(what, value) {
                return overflow;
            }
        }
        ImpactError::EnergyCreated {
            loss: loss.value(),
            normal_work: normal_work.value(),
            tangential_work: tangential_work.value(),
            moment_work: moment_work.value(),
        }
    }

    fn check(&self, motions: &[Motion<T>; 2]) -> Result<(), InvalidInput> {
        for ((participant, motion), body) in self.participants().iter().zip(motions).zip(VehicleId::ALL) {
            check::finite("velocity along x", motion.velocity.x.value())?;
            check::finite("velocity along y", motion.velocity.y.value())?;
            check::finite("yaw rate", motion.yaw_rate.value())?;
            if participant.body().is_fixed() && *motion != Motion::rest() {
                return Err(InvalidInput::FixedBodyMoves { body });
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn outcome(
        &self,
        before: [Motion<T>; 2],
        u: NormalTangential<T>,
        Solution { impulse: LawImpulse { linear: impulse, moment, regime }, critical }: Solution<T>,
    ) -> Outcome<T> {
        let [p1, p2] = self.participants();
        let v = self.inverse_mass.separation_velocity(u, impulse, moment);
        let after = self.after(&before, impulse, moment);
        let impulse_vector = impulse.in_scene(self.normal());
        let normal_work = normal_work(u, impulse, v);
        // W_t = −½ P_t (u_t + U_t)
        let tangential_work = -(impulse.tangential * (u.tangential + v.tangential)) * 0.5;
        // W_m = −½ M (ω₁ − ω₂ + Ω₁ − Ω₂)
        let moment_work = -(moment * (relative_yaw_rate(&before) + relative_yaw_rate(&after))) * 0.5;
        Outcome {
            impulse,
            impulse_vector,
            moment_impulse: moment,
            regime,
            impulse_ratio: impulse.tangential / impulse.normal,
            critical_impulse_ratio: if critical.normal > T::ZERO {
                Some(critical.tangential / critical.normal)
            } else {
                None
            },
            approach: u,
            separation: v,
            before,
            after,
            // ΔV_i = ±P/m_i
            delta_v: [impulse_vector * p1.body().inverse_mass(), -impulse_vector * p2.body().inverse_mass()],
            forward: [p1.forward(), p2.forward()],
            energy: Energy {
                before: p1.body().kinetic_energy(&before[0]) + p2.body().kinetic_energy(&before[1]),
                after: p1.body().kinetic_energy(&after[0]) + p2.body().kinetic_energy(&after[1]),
                // E_L = W_n + W_t + W_m
                loss: normal_work + tangential_work + moment_work,
                normal_work,
                tangential_work,
                moment_work,
            },
        }
    }
}
