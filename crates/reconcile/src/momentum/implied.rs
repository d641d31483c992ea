//! Results that follow from both speeds and the velocities after impact.

use pim_core::{Motion, NormalTangential, Real, Vector2, check, normal_work, pdof};

use crate::momentum::{Momentum, cross, error::MomentumError};

/// The results that follow from the speeds before impact and the velocities after it. The collision is then
/// overdetermined: each number here can be compared with another source.
///
/// | number | compare with |
/// |---|---|
/// | [`impulses`](Self::impulses) | each other: if both speeds come from momentum they are equal |
/// | [`impulse_ratio`](Self::impulse_ratio) | μ_c, which it does not exceed, and 0: it has the sign that opposes the sliding |
/// | [`pdof`](Self::pdof) | the direction shown by the damage |
/// | [`normal_work`](Self::normal_work) | the crush energy |
/// | [`energy_loss`](Self::energy_loss) | the crush energy, which it exceeds if sliding took a part |
/// | [`restitution`](Self::restitution), [`separation`](Self::separation) | the impact law, and the motions at C |
/// | [`yaw_rates`](Self::yaw_rates) | the yaw rates from rest positions or recorders |
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Implied<T = f64> {
    /// The motions before impact.
    pub before: [Motion<T>; 2],
    /// (N·s) the impulse on vehicle 1 in the scene frame, from each vehicle's velocities.
    pub impulses: [Vector2<T>; 2],
    /// (N·s) P, their mean.
    pub impulse_vector: Vector2<T>,
    /// (N·s) P along n and t.
    pub impulse: NormalTangential<T>,
    /// (–) P_t/P_n; `None` if P does not push.
    pub impulse_ratio: Option<T>,
    /// (–) μ_c, the ratio that gives U_t = 0 with the same change of u_n; `None` if no push gives that.
    pub critical_impulse_ratio: Option<T>,
    /// (m/s) ΔV vectors V − v of the two CGs in the scene frame.
    pub delta_v: [Vector2<T>; 2],
    /// (rad) principal directions of force, each from the vehicle's own ΔV, see [`pdof`].
    pub pdof: [T; 2],
    /// (m/s) u, velocity of vehicle 1 relative to vehicle 2 at C before impact.
    pub approach: NormalTangential<T>,
    /// (m/s) U, the same after impact: from the velocities and the known yaw rates; if neither is known, from
    /// the impulse P at C.
    pub separation: NormalTangential<T>,
    /// (–) −U_n/u_n with this U; `None` if the vehicles do not approach.
    pub restitution: Option<T>,
    /// (rad/s) Ω, the yaw rates after the impulse P at C.
    pub yaw_rates: [T; 2],
    /// The motions after impact: an unknown yaw rate is the one that P gives.
    pub after: [Motion<T>; 2],
    /// (m/s) U of these motions, if both yaw rates are known.
    pub departure: Option<NormalTangential<T>>,
    /// (–) −U_n/u_n with that U.
    pub departure_restitution: Option<T>,
    /// Whether a yaw rate after the impact is known, so that [`separation`](Self::separation) comes from the
    /// motions; else it comes from the impulse at C, with both vehicles free to turn.
    pub is_yaw_known: bool,
    /// (J) W_n, the energy taken by the normal impulse.
    pub normal_work: T,
    /// (J) W_t, the energy taken by the tangential impulse.
    pub tangential_work: T,
    /// (J) E_L, the kinetic energy before less that after impact, with an unknown yaw rate as P gives it.
    pub energy_loss: T,
}

impl<T: Real> Momentum<T> {
    /// The results that follow from the speeds (m/s), whatever their source. P acts at C only: a moment
    /// impulse cannot be distinguished from another point of contact. A fixed object gives no impulse of its
    /// own.
    ///
    /// # Errors
    /// Those of [`check`](Momentum::check) except for a fixed object, or if a speed or the energy loss is not
    /// finite.
    pub fn implied(&self, speeds: [T; 2]) -> Result<Implied<T>, MomentumError> {
        self.check_numbers()?;
        super::finite("speed of vehicle 1", speeds[0])?;
        super::finite("speed of vehicle 2", speeds[1])?;
        let before = self.motions_at(speeds);
        let bodies = self.contact.participants().each_ref().map(|participant| participant.body());
        let arms = self.contact.participants().each_ref().map(|participant| participant.arm());
        let velocities = self.after.each_ref().map(|departure| departure.velocity);
        // ΔV_i = V_i − v_i
        let delta_v = [velocities[0] - before[0].velocity, velocities[1] - before[1].velocity];
        // P = m₁ ΔV₁ = −m₂ ΔV₂
        let told = [delta_v[0] * bodies[0].mass(), -delta_v[1] * bodies[1].mass()];
        let impulses = match [bodies[0].is_fixed(), bodies[1].is_fixed()] {
            [true, _] => [told[1]; 2],
            [_, true] => [told[0]; 2],
            _ => told,
        };
        let impulse_vector = (impulses[0] + impulses[1]) * T::from(0.5);
        let impulse = self.contact.resolve(impulse_vector);
        // Ω₁ = ω₁ + r₁×P/I₁,  Ω₂ = ω₂ − r₂×P/I₂
        let yaw_rates = [
            before[0].yaw_rate + cross(arms[0], impulse_vector) * bodies[0].inverse_yaw_inertia(),
            before[1].yaw_rate - cross(arms[1], impulse_vector) * bodies[1].inverse_yaw_inertia(),
        ];
        let k = self.contact.inverse_mass();
        let approach = self.contact.approach(&before);
        let u = approach.velocity;
        // U = u + K P, with both free to turn
        let free = k.separation(approach, impulse, T::ZERO).velocity;
        let approaches = u.normal < T::ZERO;
        // e = −U_n/u_n
        let restitution = |after: NormalTangential<T>| approaches.then(|| -(after.normal / u.normal));
        let after = [0, 1].map(|i| Motion {
            velocity: velocities[i],
            yaw_rate: self.after[i].yaw_rate.unwrap_or(yaw_rates[i]),
        });
        let is_known = [0, 1].map(|i| self.after[i].yaw_rate.is_some() || bodies[i].is_fixed());
        let is_yaw_known = self.after.iter().any(|departure| departure.yaw_rate.is_some());
        let of_motions = self.contact.approach(&after).velocity;
        let separation = if is_yaw_known { of_motions } else { free };
        let departure = (is_known == [true; 2] && is_yaw_known).then_some(of_motions);
        // E_L = T_before − T_after
        let energy_loss = (bodies[0].kinetic_energy(&before[0]) - bodies[0].kinetic_energy(&after[0]))
            + (bodies[1].kinetic_energy(&before[1]) - bodies[1].kinetic_energy(&after[1]));
        check::finite("energy loss", energy_loss.value())?;
        // A PDOF is measured from the heading, whatever the course.
        let [f1, f2] = self.contact.participants().each_ref().map(|participant| participant.forward());
        Ok(Implied {
            before,
            impulses,
            impulse_vector,
            impulse,
            impulse_ratio: ratio(impulse),
            critical_impulse_ratio: self.critical_ratio(impulse, separation.tangential),
            delta_v,
            pdof: [pdof(f1, delta_v[0]), pdof(f2, delta_v[1])],
            approach: u,
            separation,
            restitution: restitution(separation),
            yaw_rates,
            after,
            is_yaw_known,
            departure,
            departure_restitution: departure.and_then(restitution),
            normal_work: normal_work(u, impulse, separation),
            // W_t = −½ P_t (u_t + U_t)
            tangential_work: -(impulse.tangential * (u.tangential + separation.tangential)) * 0.5,
            energy_loss,
        })
    }

    /// The ratio of the impulse that would have ended the sliding, U_t = 0, with the same U_n, if it is a
    /// push; `sliding` is the actual U_t (m/s).
    fn critical_ratio(&self, p: NormalTangential<T>, sliding: T) -> Option<T> {
        let k = self.contact.inverse_mass();
        let det = k.nn * k.tt - k.nt * k.nt;
        // P′ = P − K⁻¹ (0, U_t), up to det K
        ratio(NormalTangential {
            normal: det * p.normal + k.nt * sliding,
            tangential: det * p.tangential - k.nn * sliding,
        })
    }
}

/// P_t/P_n, if P pushes.
fn ratio<T: Real>(p: NormalTangential<T>) -> Option<T> {
    (p.normal > T::ZERO).then(|| p.tangential / p.normal)
}

impl<T: Real> Implied<T> {
    /// (N·s) size of the difference between the impulses from the two vehicles.
    #[must_use]
    pub fn disagreement(&self) -> T {
        let apart = self.impulses[0] - self.impulses[1];
        (apart.x * apart.x + apart.y * apart.y).sqrt()
    }

    /// The same in axes of the other handedness: see [`Outcome::mirrored`](pim_core::Outcome::mirrored).
    #[must_use]
    pub fn mirrored(&self) -> Self {
        // Subtracted from zero, because −0 would be printed as "-0".
        let flipped = |value: T| T::ZERO - value;
        let across = |v: Vector2<T>| Vector2::new(v.x, flipped(v.y));
        Self {
            before: self.before.each_ref().map(Motion::mirrored),
            impulses: self.impulses.map(across),
            impulse_vector: across(self.impulse_vector),
            impulse: self.impulse.mirrored(),
            impulse_ratio: self.impulse_ratio.map(flipped),
            critical_impulse_ratio: self.critical_impulse_ratio.map(flipped),
            delta_v: self.delta_v.map(across),
            approach: self.approach.mirrored(),
            separation: self.separation.mirrored(),
            yaw_rates: self.yaw_rates.map(flipped),
            after: self.after.each_ref().map(Motion::mirrored),
            departure: self.departure.map(NormalTangential::mirrored),
            // A PDOF is clockwise in either axes.
            ..*self
        }
    }
}
