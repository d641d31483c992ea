//! Solves a case, with all checks and warnings.

use inputs::{
    Case, CollisionData, CrushEvidence, ForceData, GivenVehicle, Purpose, SurfaceData, VehicleData,
};
use pim_core::Motion;
use reconcile::SolutionMethod;

use crate::analysis::Analysis;
use crate::both;
use crate::damage;
use crate::failure::Failure;
use crate::found::{Found, chosen, refused};
use crate::goal::{Goal, posed};
use crate::impact::{Impact, collide};
use crate::judged::judged;
use crate::travel::{Record, Travel, TravelOrigin, after_impact, departures};
use crate::vehicle::{NOTHING, Vehicle};
use crate::warning;

/// As [`reconstruct`](crate::reconstruct).
pub(crate) fn reconstruct(case: &Case) -> Result<Analysis, Failure> {
    if case.is_by_momentum() {
        return both::reconstruct(case).map_err(|failure| failure.in_axes(case.axes));
    }
    let input = case.reconstruction()?;
    let (vehicles, basis) = (input.collision.vehicles.clone(), input.basis);
    let problem = posed(input)?;
    let admissible: Vec<f64> = problem.speeds().collect();
    let answer = match chosen(case, &problem, &admissible) {
        Some(speed) => problem.solve_near(speed),
        // It says why there is none.
        None => problem.solve(),
    };
    let answer = answer.map_err(|refusal| refused(&problem, refusal).in_axes(case.axes))?;
    let (quadratic, affine_impact, iterations) = match &answer.method {
        SolutionMethod::ClosedForm => {
            (problem.quadratic(&answer.acting), problem.affine_impact(&answer.acting), None)
        }
        SolutionMethod::RootFinder(iterations) => (None, None, Some(iterations.as_slice().to_vec())),
    };
    let found = Found {
        unknown: problem.unknown,
        speed: answer.speed,
        admissible,
        crush_energy: problem.crush_energy,
        normal_work: answer.normal_work,
        line: problem.line(),
        quadratic,
        affine_impact,
        iterations,
    };
    let mut warnings = warning::of_found(case, &found);
    let impact = Impact::new(problem.contact, problem.law, answer.law, answer.outcome);
    let vehicles = damage::assess(vehicles, impact.pdof.map(Some))?;
    warnings.extend(warning::of_typical(case, &vehicles));
    let (travel, surface) = run_out(case, impact.outcome.after)?;
    let restitution = Some(impact.law.restitution());
    let (found, impact) = (Some(found), Some(impact));
    let analysis = Analysis { basis, found, impact, warnings, ..Analysis::unsolved(vehicles) };
    Ok(judged(case, analysis, restitution)?.with_travel(travel, surface).beside_the_rest(case))
}

/// As [`impact`](crate::impact()).
pub(crate) fn impact(case: &Case) -> Result<Analysis, Failure> {
    let input = case.collision()?;
    let (law, outcome) =
        collide(&input.collision).map_err(|refusal| Failure::from(refusal).in_axes(case.axes))?;
    let CollisionData { contact, law: given_law, vehicles, .. } = input.collision;
    let impact = Impact::new(contact, given_law, law, outcome);
    let vehicles = damage::assess(vehicles, impact.pdof.map(Some))?;
    let (travel, surface) = run_out(case, impact.outcome.after)?;
    let restitution = Some(impact.law.restitution());
    let (basis, impact) = (input.basis, Some(impact));
    let analysis = Analysis { basis, impact, ..Analysis::unsolved(vehicles) };
    Ok(judged(case, analysis, restitution)?.with_travel(travel, surface).beside_the_rest(case))
}

/// Only the motion after the impact: to rest if the case gives how a vehicle left the impact, and back from
/// the rest position if it gives that.
///
/// # Errors
/// [`Failure`].
pub fn motion(case: &Case) -> Result<Analysis, Failure> {
    let input = case.motion()?;
    let mut record = Record::of(TravelOrigin::Given);
    let given =
        input.vehicles.each_ref().map(|vehicle| vehicle.as_ref().and_then(|vehicle| vehicle.velocity));
    departures(Some(&input), given, &mut record).map_err(|failure| failure.in_axes(case.axes))?;
    let travel = record.travel;
    let bare = |subject: Option<VehicleData>| Vehicle {
        subject: VehicleData {
            damage: None,
            energy: None,
            force: ForceData::UNKNOWN,
            ..subject.unwrap_or(NOTHING)
        },
        damage: None,
        energy: None,
    };
    let vehicles = case.subjects().map(bare);
    Ok(Analysis::unsolved(vehicles).with_travel(travel, Some(input.surface)))
}

/// The vehicles at impact with their measured damage, whatever their speeds: the data of a picture of them.
///
/// # Errors
/// [`Failure`].
pub fn geometry(case: &Case) -> Result<Analysis, Failure> {
    let CollisionData { contact, mut vehicles, .. } = case.geometry()?;
    for vehicle in &mut vehicles {
        // A crush can only be inferred with the direction of the force, which is unknown without the speeds.
        let evidence = vehicle.damage.as_ref().map(|damage| &damage.evidence);
        if matches!(evidence, Some(CrushEvidence::ForceBalance { .. })) {
            (vehicle.damage, vehicle.force) = (None, ForceData::UNKNOWN);
        }
    }
    let vehicles = damage::assess(vehicles, [None, None])?;
    Ok(Analysis { geometry: Some(contact), ..Analysis::unsolved(vehicles) })
}

/// The paths to rest after an impact, if the case has the ground and the drag for them.
fn run_out(case: &Case, after: [Motion; 2]) -> Result<([Option<Travel>; 2], Option<SurfaceData>), Failure> {
    let Some(input) = case.run_out() else { return Ok(([None, None], None)) };
    let input = input?;
    let mut record = Record::of(TravelOrigin::Impact);
    after_impact(&input, after, &mut record).map_err(|failure| failure.in_axes(case.axes))?;
    Ok((record.travel, Some(input.surface)))
}

/// As [`crush`](crate::crush).
pub(crate) fn crush(case: &Case) -> Result<Analysis, Failure> {
    let input = case.damage()?;
    let vehicles = damage::assess(input.vehicles, [None, None])?;
    let warnings = warning::of_typical(case, &vehicles);
    let is_of_damage = case.vehicles.iter().any(GivenVehicle::is_absent);
    let analysis = Analysis { basis: input.basis, is_of_damage, warnings, ..Analysis::unsolved(vehicles) };
    Ok(judged(case, analysis, input.restitution)?.beside_the_rest(case))
}

/// As [`furthest`](crate::furthest).
pub(crate) fn furthest(case: &Case) -> Result<Analysis, Failure> {
    let (_, solve) = furthest_solver(case);
    solve(case)
}

/// The function that solves a case: one of [`reconstruct`], [`impact()`] and [`crush`].
type Solve = fn(&Case) -> Result<Analysis, Failure>;

/// The most complete purpose that the case allows, and the function that serves it.
pub(crate) fn furthest_solver(case: &Case) -> (Purpose, Solve) {
    match case.furthest_purpose() {
        purpose @ Purpose::Reconstruct => (purpose, reconstruct),
        purpose @ Purpose::Impact => (purpose, impact),
        _ => (Purpose::Crush, crush),
    }
}

impl Goal {
    /// The analysis of this goal.
    pub(crate) fn solve(self, case: &Case) -> Result<Analysis, Failure> {
        match self {
            Self::Speed | Self::BothSpeeds => reconstruct(case),
            Self::Impact => impact(case),
            Self::Motion => motion(case),
            Self::Damage => crush(case),
        }
    }
}
