//! Both speeds, from how the vehicles left the impact.

use inputs::{Case, Collision, TwoSpeedInput};
use pim_core::{Law, Outcome, Real, VaryingLaw, Vector2, VehicleId};
use reconcile::{Departure, Implied, Momentum, MomentumAndCrush, MomentumError};

use crate::travel::{Origin, Record, Way, Ways, departures};
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
    /// How the CGs approached each other; `None` where they lie in one place.
    pub cg_line: Option<CgLine>,
}

/// The relative velocity of the CGs along the line through both, as EDCRASH judges an impact: without the
/// rotation, which [`Implied::restitution`] has.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CgLine {
    /// (m/s) closing speed before the impact.
    pub closing_speed: f64,
    /// (–) separation speed by closing speed; `None` where the CGs do not approach.
    pub restitution: Option<f64>,
}

impl CgLine {
    /// Along the line from the CG of vehicle 1 to that of vehicle 2, which are `apart` (m).
    fn new(apart: Vector2<f64>, before: [Vector2<f64>; 2], after: [Vector2<f64>; 2]) -> Option<Self> {
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
        Some(Self { closing_speed, restitution })
    }
}

/// (m) from the CG of vehicle 1 to that of vehicle 2: between the places that the case gives, or by the arms
/// to the contact point.
fn between_cgs(case: &Case, momentum: &Momentum) -> Vector2<f64> {
    let given = case.vehicles.each_ref().map(|vehicle| {
        let place = vehicle.position.as_ref()?;
        Some(Vector2::new(place.x.si(), case.axes.lateral(place.y.si())))
    });
    if let [Some(one), Some(two)] = given {
        return two - one;
    }
    let [one, two] = momentum.contact.participants();
    // CG₂ − CG₁ = (C − r₂) − (C − r₁)
    one.arm() - two.arm()
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
        /// (J) the work sought, W_n + λ W_t, of which the basis gives λ.
        normal_work: f64,
        /// (m/s) the relative speed that was found, from which both follow.
        relative_speed: f64,
        /// (m/s) all admissible pairs of speeds, from the slowest approach to the fastest.
        admissible: Vec<[f64; 2]>,
    },
}

/// Both speeds, as an equation.
pub(crate) struct Posed<T = f64> {
    /// Momentum, and how the vehicles left the impact.
    pub(crate) momentum: Momentum<T>,
    /// The crush energy, where momentum alone does not tell one speed from the other.
    pub(crate) by_crush: Option<ByCrush<T>>,
    /// The ways that tell how the vehicles left the impact, or follow from it.
    pub(crate) ways: [Option<Way<T>>; 2],
    pub(crate) law: VaryingLaw<T>,
}

/// What momentum along one line lacks.
pub(crate) struct ByCrush<T = f64> {
    pub(crate) search: MomentumAndCrush<T>,
    /// (J) of both vehicles.
    crush_energy: T,
}

impl<T: Real> Posed<T> {
    /// The impact at both speeds (m/s), and the law at its closing speed.
    pub(crate) fn impact(&self, speeds: [T; 2]) -> Result<(Law<T>, Outcome<T>), Failure> {
        let (contact, before) = (self.momentum.contact, self.momentum.motions_at(speeds));
        let law = self.law.at(-contact.approach(&before).velocity.normal);
        let outcome = contact.impact(before, &law)?;
        Ok((law, outcome))
    }
}

/// Poses the equation for both speeds.
pub(crate) fn pose<T: Real>(input: TwoSpeedInput<T>, ways: &mut impl Ways<T>) -> Result<Posed<T>, Failure> {
    let [(one, way_1), (two, way_2)] = departures(input.motion.as_ref(), input.departures, ways)?;
    let (Some(one), Some(two)) = (one, two) else {
        let vehicle = if one.is_none() { VehicleId::One } else { VehicleId::Two };
        return Err(MomentumError::Fixed { vehicle }.into());
    };
    let Collision { contact, law, motions, vehicles } = input.collision;
    let yaw_rates = motions.map(|motion| motion.yaw_rate);
    let momentum = Momentum { contact, yaw_rates, after: [one, two] };
    let by_crush = if momentum.is_collinear() {
        let crush_energy = damage::crush_energy(&damage::assess(vehicles, [None, None])?);
        let (axis, law) = (momentum.common_axis(), law.clone());
        let (basis, share) = (input.basis.energy(), input.basis.tangential_share());
        let search = MomentumAndCrush::new(momentum, axis, law, crush_energy, basis, share)?;
        Some(ByCrush { search, crush_energy })
    } else {
        None
    };
    Ok(Posed { momentum, by_crush, ways: [way_1, way_2], law })
}

/// Finds both speeds.
pub(crate) fn reconstruct(case: &Case) -> Result<Analysis, Failure> {
    let input = case.two_speeds()?;
    let (basis, has_crush, vehicles) = (input.basis, input.has_crush, input.collision.vehicles.clone());
    let surface = input.motion.as_ref().map(|motion| motion.surface.clone());
    let mut record = Record::of(Origin::Given);
    let posed = pose(input, &mut record)?;
    let (speeds, method) = match &posed.by_crush {
        Some(ByCrush { search, crush_energy }) => {
            let answer = search.solve()?;
            let method = BothMethod::MomentumAndCrush {
                crush_energy: *crush_energy,
                normal_work: answer.normal_work,
                relative_speed: answer.relative,
                admissible: search.speeds().collect(),
            };
            (answer.speeds, method)
        }
        None => (posed.momentum.speeds()?, BothMethod::Momentum),
    };
    let implied = posed.momentum.implied(speeds)?;
    let (law_here, outcome) = posed.impact(speeds)?;
    let Posed { momentum, law, .. } = posed;
    let impact = Impact::new(momentum.contact, law, law_here, outcome);
    let vehicles = damage::assess(vehicles, implied.pdof.map(Some))?;
    let restitution = impact.law.restitution();
    let delta_v = match method {
        BothMethod::Momentum => implied.delta_v.map(|change| change.norm()),
        BothMethod::MomentumAndCrush { .. } => impact.outcome.delta_v_magnitude(),
    };
    let velocities = |motions: [pim_core::Motion; 2]| motions.map(|motion| motion.velocity);
    let after = momentum.after.map(|departure| departure.velocity);
    let cg_line = CgLine::new(between_cgs(case, &momentum), velocities(implied.before), after);
    let both = BothFound { speeds, method, delta_v, momentum, implied, cg_line };
    let given = VehicleId::ALL.into_iter().zip(speeds);
    let warnings = given.filter_map(|(id, speed)| warning::of_given_speed(case, id, speed)).collect();
    let mut analysis = judged(case, vehicles, basis, Some(restitution), (None, Some(impact)), warnings)?;
    // The part of the crush energy that the impact dissipates, on the case's basis.
    let dissipated = || basis.energy().dissipated(damage::crush_energy(&analysis.vehicles), restitution);
    let crush_energy = has_crush.then(|| (dissipated(), basis));
    if let Some(impact) = &analysis.impact {
        let checks = checks::of_momentum(&both, impact, &analysis.vehicles, crush_energy);
        warning::of_momentum(&checks, &mut analysis.warnings);
        analysis.checks.extend(checks);
    }
    analysis.both = Some(both);
    Ok(analysis.with_travel(record.travel, surface))
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
