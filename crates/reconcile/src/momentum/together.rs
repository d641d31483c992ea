//! Vehicles that leave the impact locked together.

use pim_core::{Real, Vector2};

use crate::momentum::{Departure, Momentum, cross, dot};

impl<T: Real> Momentum<T> {
    /// The same for vehicles locked together, with the velocity V of their common CG: they turn with one yaw
    /// rate, from the angular momentum about that CG, and each CG moves as a point of one body.
    ///
    /// (I_1 + I_2 + m̄ d²) Ω = I_1 ω_1 + I_2 ω_2 + m̄ d × (v_1 − v_2),  m̄ = m_1 m_2/(m_1 + m_2)
    /// V_1 = V + Ω × d m_2/(m_1 + m_2),  V_2 = V − Ω × d m_1/(m_1 + m_2),  d from CG 2 to CG 1
    ///
    /// The momentum is unchanged, and so are the speeds (m/s) from it.
    #[must_use]
    pub fn locked_together(&self, speeds: [T; 2]) -> Self {
        let bodies = self.contact.participants().each_ref().map(|participant| *participant.body());
        let [m1, m2] = self.masses();
        let whole = m1 + m2;
        let d = self.between();
        let before = self.motions_at(speeds);
        // m̄ = m₁ m₂/(m₁ + m₂)
        let reduced = m1 * m2 / whole;
        let [i1, i2] = bodies.map(|body| body.yaw_inertia());
        let [w1, w2] = self.yaw_rates;
        let moment = i1 * w1 + i2 * w2 + cross(d, before[0].velocity - before[1].velocity) * reduced;
        let yaw_rate = moment / (i1 + i2 + dot(d, d) * reduced);
        // V = p/(m₁ + m₂)
        let common = self.total() / whole;
        let at =
            |share: T| Departure { velocity: common + turned(d, yaw_rate) * share, yaw_rate: Some(yaw_rate) };
        Self { after: [at(m2 / whole), at(-(m1 / whole))], ..*self }
    }

    /// The same for vehicles that left as one body without turning, so that both CGs have one velocity.
    ///
    /// V_1 = V_2 = (m_1 V_1 + m_2 V_2)/(m_1 + m_2),  Ω = 0
    #[must_use]
    pub fn of_one_velocity(&self) -> Self {
        let [m1, m2] = self.masses();
        let common = Departure { velocity: self.total() / (m1 + m2), yaw_rate: Some(T::ZERO) };
        Self { after: [common; 2], ..*self }
    }

    /// Whether the vehicles left as one body: the velocities of the CGs agree with those of points of it
    /// within `within` (m/s), and the yaw rates with each other within `within` (rad/s). Without yaw rates,
    /// the velocities must agree.
    #[must_use]
    pub fn is_of_one_body(&self, within: f64) -> bool {
        let [one, two] = &self.after;
        let (turn, differs) = match (one.yaw_rate, two.yaw_rate) {
            (Some(one), Some(two)) => (one, (one - two).value().abs()),
            _ => (T::ZERO, 0.0),
        };
        // V₁ = V₂ + Ω × d
        let apart = one.velocity - two.velocity - turned(self.between(), turn);
        let [x, y] = [apart.x.value(), apart.y.value()];
        differs <= within && x * x + y * y <= within * within
    }

    /// (m) from CG 2 to CG 1: r_2 − r_1, as both arms end at C.
    pub(super) fn between(&self) -> Vector2<T> {
        let [one, two] = self.contact.participants().each_ref().map(|participant| participant.arm());
        two - one
    }
}

/// (m/s) Ω × d.
pub(super) fn turned<T: Real>(d: Vector2<T>, yaw_rate: T) -> Vector2<T> {
    Vector2::new(-(d.y * yaw_rate), d.x * yaw_rate)
}

impl<T: Real> Departure<T> {
    /// Motion after the impact of a vehicle locked to the one with this motion, its CG at `apart` (m) from
    /// that one's: it moves as a point of the same body; without a yaw rate, with the same velocity.
    #[must_use]
    pub fn of_locked(&self, apart: Vector2<T>) -> Self {
        // V₂ = V₁ + Ω × d
        let added = self.yaw_rate.map_or(Vector2::new(T::ZERO, T::ZERO), |yaw_rate| turned(apart, yaw_rate));
        Self { velocity: self.velocity + added, yaw_rate: self.yaw_rate }
    }
}
