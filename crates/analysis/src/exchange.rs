//! The effect of the impact, one value for each quantity.

use inputs::Geometry;
use pim_core::{Energy, Motion, NormalTangential, Outcome, Vector2, VehicleId};

use crate::impact::Impact;
use crate::speeds::BothFound;

/// The effect of the impact, depending on the source of the speeds: if that is momentum, the motions after
/// the impact are those of the evidence; otherwise, they follow from the speeds by the impact law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Exchange {
    /// The motions before.
    pub before: [Motion; 2],
    /// (m/s) the velocities after.
    pub velocities: [Vector2<f64>; 2],
    /// (rad/s) the yaw rates after; `None` for point masses whose case does not give them.
    pub yaw_rates: [Option<f64>; 2],
    /// (m/s) ΔV vectors V − v in the scene frame.
    pub delta_v: [Vector2<f64>; 2],
    /// (m/s) ΔV along each vehicle's own forward axis and to its left, or to its right in z-down axes.
    pub delta_v_components: [[f64; 2]; 2],
    /// (rad) principal directions of force.
    pub pdof: [f64; 2],
    /// (N·s) the impulse on vehicle 1 in the scene frame.
    pub impulse_vector: Vector2<f64>,
    /// The energy balance. By momentum, the part of the loss that neither work explains counts as work of a
    /// moment: known yaw rates need not be those of an impulse at C. For point masses, all of it is normal
    /// work.
    pub energy: Energy,
    /// (m/s) −u_n, closing speed along the normal at C; for point masses, along the impulse.
    pub closing_speed: f64,
    /// (–) e at C, along the normal; for point masses, along the impulse. `None` if they do not close.
    pub restitution: Option<f64>,
    /// The exchange at C; `None` for point masses.
    pub at_contact: Option<AtContact>,
}

/// The exchange at the contact point, along n and t.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AtContact {
    /// Unit normal in the scene frame.
    pub normal: Vector2<f64>,
    /// (m/s) u and U.
    pub velocities: [NormalTangential<f64>; 2],
    /// (N·s) P on vehicle 1.
    pub impulse: NormalTangential<f64>,
    /// (–) P_t/P_n; `None` if P does not push.
    pub impulse_ratio: Option<f64>,
    /// (–) μ_c.
    pub critical_impulse_ratio: Option<f64>,
}

impl AtContact {
    fn of_outcome(impact: &Impact) -> Self {
        let outcome = &impact.outcome;
        Self {
            normal: impact.contact.normal(),
            velocities: [outcome.approach, outcome.separation],
            impulse: outcome.impulse,
            impulse_ratio: Some(outcome.impulse_ratio),
            critical_impulse_ratio: outcome.critical_impulse_ratio,
        }
    }
}

/// (–) of the energy loss: less than this is the rounding of the works, not the work of a moment.
const WORK_ROUNDING: f64 = 1e-9;

impl Exchange {
    fn of_impact(impact: &Impact) -> Self {
        let outcome: &Outcome = &impact.outcome;
        Self {
            before: outcome.before,
            velocities: outcome.after.map(|motion| motion.velocity),
            yaw_rates: outcome.after.map(|motion| Some(motion.yaw_rate)),
            delta_v: outcome.delta_v,
            delta_v_components: outcome.delta_v_components(),
            pdof: impact.pdof,
            impulse_vector: outcome.impulse_vector,
            energy: outcome.energy,
            closing_speed: outcome.closing_speed(),
            restitution: Some(impact.law.restitution()),
            at_contact: Some(AtContact::of_outcome(impact)),
        }
    }

    fn of_momentum(both: &BothFound) -> Self {
        let (implied, momentum) = (&both.implied, &both.momentum);
        let participants = momentum.contact.participants();
        let forward = participants.each_ref().map(pim_core::Participant::forward);
        // ΔV·f̂ and f̂ × ΔV
        let components = |i: usize| {
            let (f, dv): (Vector2<f64>, Vector2<f64>) = (forward[i], implied.delta_v[i]);
            [dv.x * f.x + dv.y * f.y, f.x * dv.y - f.y * dv.x]
        };
        // T = Σ ½ m v² + ½ I ω²
        let before = [0, 1].map(|i| participants[i].body().kinetic_energy(&implied.before[i]));
        let before = before[0] + before[1];
        let is_contact = both.geometry != Geometry::PointMasses;
        let loss = implied.energy_loss;
        let [normal_work, tangential_work] =
            if is_contact { [implied.normal_work, implied.tangential_work] } else { [loss, 0.0] };
        let left = loss - normal_work - tangential_work;
        let is_left = is_contact && implied.is_yaw_known && left.abs() > WORK_ROUNDING * loss.abs();
        let moment_work = if is_left { left } else { 0.0 };
        let told = momentum.after.map(|departure| departure.yaw_rate);
        Self {
            before: implied.before,
            velocities: momentum.after.map(|departure| departure.velocity),
            yaw_rates: if is_contact { implied.after.map(|motion| Some(motion.yaw_rate)) } else { told },
            delta_v: implied.delta_v,
            delta_v_components: [components(0), components(1)],
            pdof: implied.pdof,
            impulse_vector: implied.impulse_vector,
            energy: Energy { before, after: before - loss, loss, normal_work, tangential_work, moment_work },
            closing_speed: -implied.approach.normal,
            restitution: implied.restitution,
            at_contact: is_contact.then(|| AtContact {
                normal: momentum.contact.normal(),
                velocities: [implied.approach, implied.separation],
                impulse: implied.impulse,
                impulse_ratio: implied.impulse_ratio,
                critical_impulse_ratio: implied.critical_impulse_ratio,
            }),
        }
    }

    pub(crate) fn of(both: Option<&BothFound>, impact: Option<&Impact>) -> Option<Self> {
        match by_momentum(both) {
            Some(both) => Some(Self::of_momentum(both)),
            None => impact.map(Self::of_impact),
        }
    }

    /// (rad/s) the change of the yaw rate of a vehicle, if that is known.
    pub(crate) fn turned(&self, id: VehicleId) -> Option<f64> {
        Some(self.yaw_rates[id.index()]? - self.before[id.index()].yaw_rate)
    }

    /// (rad) scene angle of the impulse on vehicle 1, in (−π, π].
    #[must_use]
    pub fn impulse_direction(&self) -> f64 {
        pim_core::direction(self.impulse_vector)
    }
}

/// The speeds that momentum alone gave; the impact by the law is then only a check.
pub(crate) fn by_momentum(both: Option<&BothFound>) -> Option<&BothFound> {
    both.filter(|both| !both.is_by_crush())
}
