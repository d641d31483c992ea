//! The answers of the damage, of the momentum and of both together for one collision.

use inputs::{Axes, Basis, Case, Dimension, Find, GivenVehicle, Quantity, Reconstruct, Velocity};
use pim_core::{Law, Outcome, VehicleId};
use reconcile::{EvidenceErrors, MomentumBesideCrush, are_collinear};

use crate::analysis::Analysis;
use crate::both::{Posed, pose_agreeing};
use crate::damage;
use crate::errors::errors;
use crate::failure::Failure;
use crate::given::{GivenSpeed, with_sideslip};
use crate::solve::{crush, reconstruct};

/// The answers of the damage, of the momentum and of both together, for a case that has the evidence for
/// each.
#[derive(Debug)]
#[non_exhaustive]
pub struct ByEvidence {
    /// (J) crush energy of both vehicles, as measured; `None` if no vehicle has damage data.
    pub crush_energy: Option<f64>,
    /// The damage, without any data after the impact.
    pub damage: Result<EvidenceAnswer, NoEvidence>,
    /// The momentum after the impact, without the crush energy.
    pub momentum: Result<EvidenceAnswer, NoEvidence>,
    /// Momentum and the crush energy: if the approaches are collinear, the momentum along their line; if they
    /// cross, all of it, weighed against the crush energy.
    pub together: Result<EvidenceAnswer, NoEvidence>,
}

/// The answer of one kind of evidence, as far as it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct EvidenceAnswer {
    /// How it was found.
    pub by: EvidenceMethod,
    /// (m/s) the speeds along the headings.
    pub speeds: Option<[f64; 2]>,
    /// (m/s) ΔV of both vehicles.
    pub delta_v: [f64; 2],
    /// (m/s) −u_n, the speed at which the vehicles approach each other along the normal at C.
    pub closing_speed: Option<f64>,
    /// (J) the crush energy that the impact would need, on the case's basis.
    pub crush_energy: Option<f64>,
    /// (J) E_L.
    pub energy_loss: Option<f64>,
}

/// How an answer was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EvidenceMethod {
    /// From the crush energy and the speed that the case gives for this vehicle.
    DamageAndSpeed {
        /// Whose speed is given.
        given: VehicleId,
    },
    /// From the crush energy of a vehicle that hit a fixed object.
    DamageByObject,
    /// From the crush energy: the vehicles approach along one line, so it gives their relative speed, but not
    /// the share of each.
    DamageAlongLine,
    /// CRASH3, from the crush energy and a direction of force.
    Crash3 {
        /// Whether the case gives the direction; otherwise it is that of the momentum.
        pdof_is_given: bool,
    },
    /// From momentum: the approaches cross.
    Momentum,
    /// From momentum along the heading of one vehicle, and the given speed of the other.
    MomentumAndSpeed {
        /// Whose speed is given.
        given: VehicleId,
    },
    /// From the departure from a fixed object and the restitution there.
    Wall {
        /// The vehicle that hit it.
        vehicle: VehicleId,
        /// (–) e.
        restitution: f64,
    },
    /// From momentum along the common line of the approaches, and the crush energy.
    MomentumAndDamage,
    /// From momentum and the crush energy, weighed by their errors: the approaches cross.
    Weighed {
        /// The errors.
        errors: EvidenceErrors,
        /// (–) difference between momentum and crush energy, in standard deviations.
        apart: f64,
    },
}

impl EvidenceMethod {
    /// Whether the answer depends on crush energies.
    #[must_use]
    pub fn is_by_damage(self) -> bool {
        !matches!(self, Self::Momentum | Self::MomentumAndSpeed { .. } | Self::Wall { .. })
    }
}

/// Why a kind of evidence has no answer.
#[derive(Debug)]
pub enum NoEvidence {
    /// The approaches cross, so the damage gives neither speed without the other, and the force does not push
    /// on the damaged sides, so CRASH3 has no ΔV.
    NeedsSpeedOrPdof,
    /// The approaches lie within 10° of one line, and no speed or both are given: momentum alone does not
    /// separate the speeds.
    NeedsSpeed {
        /// (rad) the angle between the headings.
        angle: f64,
    },
    /// No vehicle has damage data.
    NoDamage,
    /// The case lacks data of the impact law: contact points, yaw inertias and `[impact]`.
    NoLaw,
    /// It has no answer.
    Failed(Failure),
}

impl From<Failure> for NoEvidence {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

/// The answers by evidence, if a case with an unknown speed has both the damage of its vehicles and how they
/// left the impact. `own` is its answer as it stands.
pub(crate) fn by_evidence(case: &Case, own: &Analysis) -> Option<ByEvidence> {
    case.reconstruct.as_ref()?;
    if case.is_by_momentum() && !case.vehicles.iter().any(GivenVehicle::has_damage_data) {
        return Some(without_damage(own));
    }
    // Vehicles that leave locked together leave alike.
    let is_told = |id: VehicleId| {
        tells_departure(&case.vehicles[id.index()])
            || (case.locked_together && tells_departure(&case.vehicles[id.other().index()]))
    };
    if !VehicleId::ALL.into_iter().all(|id| has_damage(&case.vehicles[id.index()]) && is_told(id)) {
        return None;
    }
    let [one, two] = case.subjects();
    let vehicles = damage::assess([one?, two?], [None, None]).ok()?;
    let crush_energy = damage::crush_energy(&vehicles);
    let fails = |no: NoEvidence| no.in_axes(case.axes);
    Some(ByEvidence {
        crush_energy: Some(crush_energy),
        damage: by_damage(case, own).map_err(fails),
        momentum: by_momentum(case).map_err(fails),
        together: by_both(case, crush_energy).map_err(fails),
    })
}

/// The answer of momentum, if there is no damage to compare it with.
fn without_damage(own: &Analysis) -> ByEvidence {
    let momentum = || {
        let both = own.both.as_ref()?;
        let exchange = own.exchange()?;
        let restitution = own.impact.as_ref().map(|impact| impact.law.restitution());
        let energy = exchange.energy;
        let works = exchange.at_contact.map(|_| [energy.normal_work, energy.tangential_work]);
        Some(EvidenceAnswer {
            by: own.solved_by(),
            speeds: Some(both.speeds),
            delta_v: both.delta_v,
            closing_speed: Some(exchange.closing_speed),
            crush_energy: works.zip(restitution).and_then(|(works, e)| needed(own.basis, works, e)),
            energy_loss: Some(energy.loss),
        })
    };
    ByEvidence {
        crush_energy: None,
        damage: Err(NoEvidence::NoDamage),
        momentum: momentum().ok_or(NoEvidence::NoLaw),
        together: Err(NoEvidence::NoDamage),
    }
}

/// Whether a vehicle can move and its damage is known.
fn has_damage(vehicle: &GivenVehicle) -> bool {
    !vehicle.fixed && !vehicle.is_absent() && vehicle.has_damage_data()
}

/// Whether it is known how a vehicle left the impact.
fn tells_departure(vehicle: &GivenVehicle) -> bool {
    let after = vehicle.after.as_ref();
    after.is_some_and(|after| after.rest.is_some() || (after.speed.is_some() && after.direction.is_some()))
}

/// The case with another speed to find. A vehicle whose velocity was given keeps its direction.
fn seeking(case: &Case, find: Find) -> Case {
    let mut case = case.clone();
    for id in VehicleId::ALL.into_iter().filter(|id| find.seeks(*id)) {
        with_sideslip(&mut case, id);
    }
    case.reconstruct = case.reconstruct.map(|reconstruct| Reconstruct { find, ..reconstruct });
    case
}

/// The vehicle with a known speed, if the other one is unknown; in a case that asks for both, the only one
/// with a speed.
fn given_speed(case: &Case) -> Option<VehicleId> {
    match case.reconstruct?.find {
        Find::One(unknown) => Some(unknown.other()),
        Find::Both => {
            let given = case.vehicles.each_ref().map(|vehicle| vehicle.motion.is_some());
            match given {
                [true, false] => Some(VehicleId::One),
                [false, true] => Some(VehicleId::Two),
                _ => None,
            }
        }
    }
}

/// The answer of the damage, as if nothing were known after the impact.
fn by_damage(case: &Case, own: &Analysis) -> Result<EvidenceAnswer, NoEvidence> {
    let mut bare = case.clone();
    for vehicle in &mut bare.vehicles {
        vehicle.after = None;
    }
    let found = |case: &Case, given: VehicleId| reconstruct(&seeking(case, Find::One(given.other())));
    if let Some(given) = given_speed(case) {
        let analysis = found(&bare, given)?;
        return of_impact(&analysis, analysis.solved_by()).ok_or(NoEvidence::NeedsSpeedOrPdof);
    }
    if case.approach_angle().is_some_and(are_collinear) {
        // An impact depends only on the relative velocity: any speed of vehicle 2 gives the same one.
        bare.vehicles[1].motion = Quantity::from_si(0.0, Dimension::Speed).ok().map(Velocity::Speed);
        let analysis = found(&bare, VehicleId::Two)?;
        let answer = of_impact(&analysis, EvidenceMethod::DamageAlongLine);
        return answer
            .map(|answer| EvidenceAnswer { speeds: None, ..answer })
            .ok_or(NoEvidence::NeedsSpeedOrPdof);
    }
    let (alone, pdof_is_given) = match crush(&bare) {
        Ok(analysis) => (analysis.crash3, true),
        Err(Failure::Case(_)) => (own.crash3.clone(), false),
        Err(failure) => return Err(failure.into()),
    };
    let crash3 = alone.ok_or(NoEvidence::NeedsSpeedOrPdof)?;
    let corrected = crash3.corrected.ok_or(NoEvidence::NeedsSpeedOrPdof)?;
    Ok(EvidenceAnswer {
        by: EvidenceMethod::Crash3 { pdof_is_given },
        speeds: None,
        delta_v: corrected.delta_v,
        closing_speed: None,
        crush_energy: Some(crash3.crush_energy),
        energy_loss: Some(corrected.crush_energy),
    })
}

/// Momentum after the impact, and the additional data that it needs if the approaches do not cross.
fn posed(case: &Case) -> Result<(Posed, Basis), Failure> {
    let input = seeking(case, Find::Both).two_speeds()?;
    let basis = input.basis;
    Ok((pose_agreeing(case, input)?, basis))
}

/// The answer of the momentum after the impact, without the crush energy.
fn by_momentum(case: &Case) -> Result<EvidenceAnswer, NoEvidence> {
    let (posed, basis) = posed(case)?;
    let momentum = &posed.momentum;
    let (speeds, by) = if posed.by_crush.is_none() {
        (momentum.speeds().map_err(Failure::from)?, EvidenceMethod::Momentum)
    } else {
        let angle = momentum.angle().abs();
        let given = given_speed(case).ok_or(NoEvidence::NeedsSpeed { angle })?;
        let known = GivenSpeed::of(case, given).ok_or(NoEvidence::NeedsSpeed { angle })?.speed;
        let found = momentum.speed_beside(given.other(), known).map_err(Failure::from)?;
        let speeds = match given {
            VehicleId::One => [known, found],
            VehicleId::Two => [found, known],
        };
        (speeds, EvidenceMethod::MomentumAndSpeed { given })
    };
    let (_, implied) = posed.implied(speeds)?;
    let law = posed.impact(speeds).transpose()?.map(|(law, _)| law);
    let works = [implied.normal_work, implied.tangential_work];
    Ok(EvidenceAnswer {
        by,
        speeds: Some(speeds),
        delta_v: implied.delta_v.map(|change| change.norm()),
        closing_speed: Some(-implied.approach.normal),
        crush_energy: law.and_then(|law| needed(basis, works, law.restitution())),
        energy_loss: Some(implied.energy_loss),
    })
}

/// The answer of momentum and the crush energy (J).
fn by_both(case: &Case, crush_energy: f64) -> Result<EvidenceAnswer, NoEvidence> {
    let (posed, basis) = posed(case)?;
    let (speeds, by) = if let Some(by_crush) = &posed.by_crush {
        (by_crush.search.solve().map_err(Failure::from)?.speeds, EvidenceMethod::MomentumAndDamage)
    } else {
        let (momentum, law) = (posed.momentum, posed.law.clone().ok_or(NoEvidence::NoLaw)?);
        let on = (basis.energy(), basis.tangential_share());
        let errors = errors(case);
        let found = MomentumBesideCrush::new(momentum, law, crush_energy, on, errors)
            .and_then(|weighed| weighed.solve())
            .map_err(Failure::from)?;
        (found.speeds, EvidenceMethod::Weighed { errors, apart: found.apart })
    };
    let (law, outcome) = posed.impact(speeds).ok_or(NoEvidence::NoLaw)??;
    Ok(of_outcome(by, speeds, (&outcome, &law), basis))
}

/// The answer of a reconstruction from the damage.
fn of_impact(analysis: &Analysis, by: EvidenceMethod) -> Option<EvidenceAnswer> {
    let impact = analysis.impact.as_ref()?;
    let speeds = VehicleId::ALL.map(|id| analysis.speed(id));
    Some(of_outcome(by, speeds, (&impact.outcome, &impact.law), analysis.basis))
}

/// The answer of an impact (m/s) and its law.
fn of_outcome(
    by: EvidenceMethod,
    speeds: [f64; 2],
    (outcome, law): (&Outcome, &Law),
    basis: Basis,
) -> EvidenceAnswer {
    EvidenceAnswer {
        by,
        speeds: Some(speeds),
        delta_v: outcome.delta_v_magnitude(),
        closing_speed: Some(outcome.closing_speed()),
        crush_energy: needed(basis, works(outcome), law.restitution()),
        energy_loss: Some(outcome.energy.loss),
    }
}

/// (J) works of the normal and of the tangential impulse.
pub(crate) fn works(outcome: &Outcome) -> [f64; 2] {
    [outcome.energy.normal_work, outcome.energy.tangential_work]
}

/// (J) the crush energy that corresponds to an impact with these works (J) of the normal and the tangential
/// impulse; `None` if the restitution e lets the impact dissipate none of it.
pub(crate) fn needed(
    basis: Basis,
    [normal_work, tangential_work]: [f64; 2],
    restitution: f64,
) -> Option<f64> {
    // E = W_n/(1 − e²) if it is what was absorbed, else W_n + λ W_t
    let work = basis.taken_by_crush(normal_work, tangential_work);
    let energy = work / basis.energy().dissipated(1.0, restitution);
    energy.is_finite().then_some(energy)
}

impl NoEvidence {
    /// The same, its numbers in the given axes.
    fn in_axes(self, axes: Axes) -> Self {
        match self {
            Self::Failed(failure) => Self::Failed(failure.in_axes(axes)),
            other => other,
        }
    }
}
