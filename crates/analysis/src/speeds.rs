//! Both speeds that a reconstruction finds.

use inputs::{Axes, Geometry};
use pim_core::{Vector2, VehicleId};
use reconcile::{Departure, Implied, Momentum};

use crate::check::Check;
use crate::thresholds::{COMPARABLE_WEIGHT, MATERIAL_SPEED};

/// Both speeds, and their basis.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BothFound {
    /// (m/s) the speeds along the headings.
    pub speeds: [f64; 2],
    /// The evidence that gave them.
    pub method: BothMethod,
    /// (m/s) the ΔV that go with the speeds: by momentum, |V − v|; if the crush energy was needed, those of
    /// the impact with that energy.
    pub delta_v: [f64; 2],
    /// How the vehicles left the impact.
    pub momentum: Momentum,
    /// How much of the contact is known. For point masses the normal is the line of the impulse.
    pub geometry: Geometry,
    /// What follows from the speeds and the velocities after the impact, without an impact law.
    pub implied: Implied,
    /// Whether the case says that they left locked together.
    pub locked_together: bool,
    /// Whether they left as one body that did not turn: the case gives one velocity for both CGs, and the yaw
    /// rate of neither.
    pub one_velocity: bool,
    /// Every combination of a start of either vehicle that leads to the rest positions, the one of this
    /// answer first: it agrees best with the impulse.
    pub combinations: Vec<Combination>,
    /// How the CGs approached each other; `None` if they coincide.
    pub cg_line: Option<CgLine>,
}

/// The relative velocity of the CGs along the line through both, by which EDCRASH judges an impact: without
/// the rotation, which [`Implied::restitution`] includes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CgLine {
    /// (m/s) closing speed before the impact.
    pub closing_speed: f64,
    /// (m/s) speed at which they part after it; negative if they close.
    pub parting_speed: f64,
    /// (–) ratio of separation to closing speed; `None` if the CGs do not approach.
    pub restitution: Option<f64>,
}

impl CgLine {
    /// Along the line from the CG of vehicle 1 to that of vehicle 2, which are `apart` (m).
    pub(crate) fn new(
        apart: Vector2<f64>,
        before: [Vector2<f64>; 2],
        after: [Vector2<f64>; 2],
    ) -> Option<Self> {
        let distance = apart.norm();
        if distance <= 0.0 {
            return None;
        }
        let line = apart * (1.0 / distance);
        // v_c = (v₁ − v₂)·ℓ̂,  V_c = (V₁ − V₂)·ℓ̂
        let closing_speed = (before[0] - before[1]).dot(&line);
        let separating = (after[0] - after[1]).dot(&line);
        // e_CG = −V_c/v_c
        let restitution = (closing_speed > 0.0).then(|| 0.0 - separating / closing_speed);
        Some(Self { closing_speed, parting_speed: 0.0 - separating, restitution })
    }
}

/// The evidence that gives both speeds.
#[derive(Clone, Debug, PartialEq)]
pub enum BothMethod {
    /// Momentum alone: the approaches cross.
    Momentum,
    /// Momentum along the heading of one vehicle, and the given speed of the other.
    MomentumAndSpeed {
        /// Whose speed is given.
        given: VehicleId,
    },
    /// The departure from a fixed object, and the restitution there.
    Wall {
        /// The vehicle that hit it.
        vehicle: VehicleId,
        /// (–) e, as given.
        restitution: f64,
    },
    /// Momentum along the common line of the approaches, and the crush energy.
    MomentumAndCrush {
        /// (J) crush energy of both vehicles.
        crush_energy: f64,
        /// (J) the required work, W_n + λ W_t, with λ from the basis.
        normal_work: f64,
        /// (m/s) the relative speed that was found, from which both speeds follow.
        relative_speed: f64,
        /// (m/s) all admissible pairs of speeds, from the slowest approach to the fastest.
        admissible: Vec<[f64; 2]>,
    },
}

impl BothFound {
    /// Whether the crush energy was needed: the impact is then the one by the law at these speeds.
    #[must_use]
    pub fn is_by_crush(&self) -> bool {
        matches!(self.method, BothMethod::MomentumAndCrush { .. })
    }

    /// The only vehicle whose speed was unknown; `None` if both were.
    #[must_use]
    pub fn sought(&self) -> Option<VehicleId> {
        match self.method {
            BothMethod::MomentumAndSpeed { given } => Some(given.other()),
            BothMethod::Wall { vehicle, .. } => Some(vehicle),
            BothMethod::Momentum | BothMethod::MomentumAndCrush { .. } => None,
        }
    }

    /// The vehicles whose speeds were unknown.
    pub fn vehicles(&self) -> impl Iterator<Item = VehicleId> + use<> {
        let sought = self.sought();
        VehicleId::ALL.into_iter().filter(move |id| sought.is_none_or(|sought| sought == *id))
    }
}

/// A start of each vehicle, and the evidence against the two together.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Combination {
    /// How each vehicle left the impact.
    pub after: [Departure; 2],
    /// (rad) how far each vehicle turns on its path to rest; `None` if it is not followed.
    pub turns: [Option<f64>; 2],
    /// (m/s) the speeds along the headings.
    pub speeds: [f64; 2],
    /// (–) χ² of the implications of the speeds, compared with the other evidence.
    pub misfit: f64,
    /// (–) probability of the combination among all of them.
    pub weight: f64,
    /// The checks that it fails.
    pub against: Vec<Check>,
}

impl Combination {
    /// The same in axes of the other handedness.
    fn mirrored(self) -> Self {
        Self {
            after: self.after.map(mirrored),
            turns: self.turns.map(|turn| turn.map(|turn| 0.0 - turn)),
            against: self.against.into_iter().map(|check| check.in_axes(Axes::ZDown)).collect(),
            ..self
        }
    }
}

impl BothFound {
    /// Other combinations of starts of comparable weight that lead to other speeds: the rest positions do not
    /// decide between them.
    pub fn rivals(&self) -> impl Iterator<Item = &Combination> {
        self.combinations.iter().skip(1).filter(|other| {
            let apart = (0..2).map(|i| (other.speeds[i] - self.speeds[i]).abs()).fold(0.0, f64::max);
            other.weight > COMPARABLE_WEIGHT && apart > MATERIAL_SPEED
        })
    }
}

/// Standard deviations of the differences between the implications of momentum and the evidence.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spread {
    /// (rad/s) of the yaw rates.
    pub(crate) yaw_rates: [f64; 2],
    /// (–) of the restitution.
    pub(crate) restitution: f64,
    /// (–) of the impulse ratio.
    pub(crate) impulse_ratio: f64,
    /// (–) of the logarithm of the energy.
    pub(crate) energy_ln: f64,
}

impl BothFound {
    /// The same in axes of the other handedness.
    pub(crate) fn mirrored(self) -> Self {
        let Momentum { contact, yaw_rates, after } = self.momentum;
        let momentum = Momentum {
            contact: contact.mirrored(),
            yaw_rates: yaw_rates.map(|rate| 0.0 - rate),
            after: after.map(mirrored),
        };
        let combinations = self.combinations.into_iter().map(Combination::mirrored).collect();
        Self { momentum, implied: self.implied.mirrored(), combinations, ..self }
    }
}

fn mirrored(Departure { velocity, yaw_rate }: Departure) -> Departure {
    Departure {
        velocity: Vector2::new(velocity.x, 0.0 - velocity.y),
        yaw_rate: yaw_rate.map(|rate| 0.0 - rate),
    }
}
