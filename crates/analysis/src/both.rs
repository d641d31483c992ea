//! Both speeds, from how the vehicles left the impact.

use inputs::{Case, Collision, TwoSpeedInput};
use pim_core::{Motion, Vector2, VehicleId};
use reconcile::{Departure, Implied, Momentum, MomentumAndCrush, MomentumError};

use crate::travel::{self, Left, Scene, Travel};
use crate::{Analysis, Failure, Impact, checks, damage, judged, warning};

/// Both speeds, and what they rest on.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BothFound {
    /// (m/s) the speeds along the headings.
    pub speeds: [f64; 2],
    /// What gave them.
    pub method: BothMethod,
    /// (m/s) the ΔV that go with the speeds: by momentum, |V − v|; where the crush energy was needed, those
    /// of the impact that it makes.
    pub delta_v: [f64; 2],
    /// How the vehicles left the impact.
    pub momentum: Momentum,
    /// What follows from the speeds and the velocities after the impact, without an impact law.
    pub implied: Implied,
}

/// What gives both speeds.
#[derive(Clone, Debug, PartialEq)]
pub enum BothMethod {
    /// Momentum alone: the approaches cross.
    Momentum,
    /// Momentum along the line that the approaches share, and the crush energy.
    MomentumAndCrush {
        /// (J) crush energy of both vehicles.
        crush_energy: f64,
        /// (J) the normal work sought.
        normal_work: f64,
        /// (m/s) the relative speed that was found, from which both follow.
        relative_speed: f64,
        /// (m/s) all admissible pairs of speeds, from the slowest approach to the fastest.
        admissible: Vec<[f64; 2]>,
    },
}

/// Finds both speeds.
pub(crate) fn reconstruct(case: &Case) -> Result<Analysis, Failure> {
    let input = case.two_speeds()?;
    let (after, travel) = departures(&input)?;
    let TwoSpeedInput {
        collision: Collision { contact, law, motions, vehicles },
        basis,
        has_crush,
        motion,
        ..
    } = input;
    let momentum = Momentum { contact, yaw_rates: motions.map(|motion| motion.yaw_rate), after };
    let assessed = damage::assess(vehicles.clone(), [None, None])?;
    let (speeds, method) = if momentum.is_collinear() {
        let crush_energy = damage::crush_energy(&assessed);
        let axis = momentum.common_axis();
        let search = MomentumAndCrush::new(momentum, axis, law.clone(), crush_energy, basis, 0.0)?;
        let answer = search.solve()?;
        let admissible = search.speeds().collect();
        let method = BothMethod::MomentumAndCrush {
            crush_energy,
            normal_work: answer.normal_work,
            relative_speed: answer.relative,
            admissible,
        };
        (answer.speeds, method)
    } else {
        (momentum.speeds()?, BothMethod::Momentum)
    };
    let implied = momentum.implied(speeds)?;
    let before = momentum.motions_at(speeds);
    let law_here = law.at(-contact.approach(&before).velocity.normal);
    let outcome = contact.impact(before, &law_here)?;
    let impact = Impact::new(contact, law, law_here, outcome);
    let vehicles = damage::assess(vehicles, implied.pdof.map(Some))?;
    let restitution = impact.law.restitution();
    let delta_v = match method {
        BothMethod::Momentum => implied.delta_v.map(|change| change.norm()),
        BothMethod::MomentumAndCrush { .. } => impact.outcome.delta_v_magnitude(),
    };
    let both = BothFound { speeds, method, delta_v, momentum, implied };
    let mut analysis = judged(case, vehicles, basis, Some(restitution), (None, Some(impact)), Vec::new())?;
    // The part of the crush energy that the normal impulse dissipates, on the case's basis.
    let crush_energy =
        has_crush.then(|| basis.dissipated(damage::crush_energy(&analysis.vehicles), restitution));
    if let Some(impact) = &analysis.impact {
        let checks = checks::of_momentum(&both, impact, &analysis.vehicles, crush_energy);
        warning::of_momentum(&checks, &mut analysis.warnings);
        analysis.checks.extend(checks);
    }
    analysis.both = Some(both);
    Ok(analysis.with_travel(travel, motion.map(|motion| motion.surface)))
}

/// How both vehicles left the impact, and the ways that tell it or follow from it.
fn departures(input: &TwoSpeedInput) -> Result<([Departure; 2], [Option<Travel>; 2]), Failure> {
    let scene = input.motion.as_ref().map(|motion| Scene::new(&motion.surface));
    let of = |vehicle: VehicleId| {
        let given = input.departures[vehicle.index()].as_ref();
        let way = input.motion.as_ref().and_then(|motion| motion.vehicles[vehicle.index()].as_ref());
        let (left, travel) = match (scene.as_ref().zip(way), given) {
            (Some((scene, way)), _) => {
                travel::left(scene, vehicle, way, given)?.ok_or(MomentumError::Fixed { vehicle })?
            }
            (None, Some(given)) => (Left::given(given), None),
            (None, None) => return Err(MomentumError::Fixed { vehicle }.into()),
        };
        let Motion { velocity, yaw_rate } = left.motion;
        let yaw_rate = given.map_or(Some(yaw_rate), |given| given.yaw_rate);
        Ok::<_, Failure>((Departure { velocity, yaw_rate }, travel))
    };
    let ((d1, t1), (d2, t2)) = (of(VehicleId::One)?, of(VehicleId::Two)?);
    Ok(([d1, d2], [t1, t2]))
}

impl BothFound {
    /// The same in axes of the other handedness.
    pub(crate) fn mirrored(self) -> Self {
        let Momentum { contact, yaw_rates, after } = self.momentum;
        let momentum = Momentum {
            contact: contact.mirrored(),
            yaw_rates: yaw_rates.map(|rate| 0.0 - rate),
            after: after.map(|Departure { velocity, yaw_rate }| Departure {
                velocity: Vector2::new(velocity.x, 0.0 - velocity.y),
                yaw_rate: yaw_rate.map(|rate| 0.0 - rate),
            }),
        };
        Self { momentum, implied: self.implied.mirrored(), ..self }
    }
}
