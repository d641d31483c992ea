//! Both speeds found from how the vehicles left the impact, compared with the true ones.

use std::f64::consts::FRAC_PI_2;

use crash3::EnergyBasis;
use pim_core::{Contact, Participant, Vector2, VehicleId};
use reconcile::{Departure, Momentum, MomentumAndCrush, MomentumError};
use trajectory::closed::Slide;

use crate::claim::Erratum;
use crate::error::ValidationError;
use crate::motion::velocity_from_rest;
use crate::scene::{Collided, Rest, Scene, length_and_direction, polar};
use crate::staged::Staged;
use crate::statistics::ErrorRate;

/// (m/s) a vehicle below this speed was at rest.
const STOOD: f64 = 1e-9;

/// (m) arm for tests without a published point of contact: momentum alone does not use it.
const ANY_ARM: f64 = 1.5;

/// The evidence for both speeds, besides the masses and the headings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedEvidence {
    /// The velocities after the impact: the approaches cross.
    Momentum,
    /// The velocities after the impact and the crush energy: the approaches are collinear.
    MomentumAndCrush,
}

/// Both speeds of a test from the published velocities after the impact.
#[derive(Clone, Debug, PartialEq)]
pub struct BothSpeedsRow {
    /// The test.
    pub test: u8,
    /// The evidence that gave the speeds.
    pub evidence: SpeedEvidence,
    /// (m/s) true speeds along the headings.
    pub true_speeds: [f64; 2],
    /// (m/s) the speeds found.
    pub found: [f64; 2],
    /// (–) how far the impulses on the two vehicles, as computed from the true speeds, lie apart, as a share
    /// of their mean: the accuracy of the published velocities.
    pub disagreement: f64,
    /// The misprint that was corrected in the velocities.
    pub erratum: Option<Erratum>,
}

/// How the velocities after the impact were found from the rest position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestMethod {
    /// From the motion that leads there: its speed and its direction.
    Motion,
    /// From the motion that leads there: its speed, with the published direction.
    MotionDirected,
    /// From a straight slide along the common line of the approaches.
    Slide,
}

/// Both speeds of a test from the published rest positions.
#[derive(Clone, Debug, PartialEq)]
pub struct FromRestRow {
    /// The test.
    pub test: u8,
    /// How the velocities after the impact were found.
    pub method: RestMethod,
    /// The evidence that gave the speeds before it.
    pub evidence: SpeedEvidence,
    /// (–) drag of each wheel: the mean of those fitted to the other tests.
    pub drag: f64,
    /// (m/s) speeds after the impact.
    pub after: [f64; 2],
    /// (m/s) true speeds before the impact, along the headings.
    pub true_speeds: [f64; 2],
    /// (m/s) the speeds found.
    pub found: [f64; 2],
}

/// The error of a speed: in m/s, and as a share of the true speed unless the vehicle was at rest.
#[must_use]
pub fn speed_error(found: f64, true_speed: f64) -> (f64, Option<f64>) {
    let error = found - true_speed;
    (error, (true_speed.abs() > STOOD).then(|| error / true_speed))
}

/// Errors of both speeds from the published velocities after the impact: in m/s, and as shares of the true
/// speeds for the vehicles that moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BothSpeedErrors {
    /// From either.
    pub all: [ErrorRate; 2],
    /// From momentum alone.
    pub momentum: [ErrorRate; 2],
    /// From momentum and crush energy.
    pub momentum_and_crush: [ErrorRate; 2],
}

pub(crate) fn both_speed_errors(rows: &[BothSpeedsRow]) -> BothSpeedErrors {
    let rate = |of: Option<SpeedEvidence>| {
        let errors: Vec<(f64, Option<f64>)> = rows
            .iter()
            .filter(|row| of.is_none_or(|evidence| row.evidence == evidence))
            .flat_map(|row| [0, 1].map(|i| speed_error(row.found[i], row.true_speeds[i])))
            .collect();
        let absolute: Vec<f64> = errors.iter().map(|(error, _)| *error).collect();
        let relative: Vec<f64> = errors.iter().filter_map(|(_, share)| *share).collect();
        [ErrorRate::of(&absolute), ErrorRate::of(&relative)]
    };
    BothSpeedErrors {
        all: rate(None),
        momentum: rate(Some(SpeedEvidence::Momentum)),
        momentum_and_crush: rate(Some(SpeedEvidence::MomentumAndCrush)),
    }
}

/// Both speeds of every test whose velocities after the impact are published.
pub(crate) fn both_speeds(scene: &Scene, staged: &[Staged]) -> Result<Vec<BothSpeedsRow>, ValidationError> {
    staged
        .iter()
        .map(|staged| {
            let test = staged.printed.test;
            let incomplete = ValidationError::Incomplete { test, what: "velocities after the impact" };
            let after = scene.after(test).ok_or(incomplete)?;
            let departures = VehicleId::ALL.map(|id| {
                let motion = after.motion(id);
                Departure { velocity: motion.velocity, yaw_rate: Some(motion.yaw_rate) }
            });
            let momentum =
                Momentum { contact: staged.collision()?.contact, yaw_rates: [0.0; 2], after: departures };
            let true_speeds = scene.collided(std::slice::from_ref(staged), test)?.true_speeds;
            let (evidence, found) = solved(momentum, staged)?;
            let implied =
                momentum.implied(true_speeds).map_err(|source| ValidationError::of_test(test, source))?;
            let size = length_and_direction(implied.impulse_vector).0;
            Ok(BothSpeedsRow {
                test,
                evidence,
                true_speeds,
                found,
                disagreement: implied.disagreement() / size,
                erratum: after.erratum(),
            })
        })
        .collect()
}

/// (m/s) both speeds by momentum alone if the approaches cross, else with the crush energy of the published
/// profiles.
fn solved(momentum: Momentum, staged: &Staged) -> Result<(SpeedEvidence, [f64; 2]), ValidationError> {
    let failed = |source: MomentumError| ValidationError::of_test(staged.printed.test, source);
    if !momentum.is_collinear() {
        return Ok((SpeedEvidence::Momentum, momentum.speeds().map_err(failed)?));
    }
    let law = staged.collision()?.law;
    let [e1, e2] = staged.from_profiles;
    let axis = momentum.common_axis();
    // As everywhere here, the crush energy is only the work of the normal impulse: λ = 0.
    let solver = MomentumAndCrush::new(momentum, axis, law.into(), e1 + e2, EnergyBasis::Dissipated, 0.0);
    let answer = solver.and_then(|solver| solver.solve()).map_err(failed)?;
    Ok((SpeedEvidence::MomentumAndCrush, answer.speeds))
}

/// Both speeds of every test in which both vehicles came to rest undisturbed.
pub(crate) fn from_rest(scene: &Scene, staged: &[Staged]) -> Result<Vec<FromRestRow>, ValidationError> {
    let mut rows = Vec::new();
    for first in scene.rest.iter().filter(|rest| rest.vehicle() == VehicleId::One && !rest.struck_again) {
        let test = first.test;
        let Some(second) = scene.rest(test, VehicleId::Two) else { continue };
        let rests = [first, second];
        let collided = scene.collided(staged, test)?;
        let drag = scene.drag_of_others(test);
        let directions = rests.map(Rest::direction);
        let case = staged.iter().find(|staged| staged.printed.test == test);
        if let [Some(towards_1), Some(towards_2)] = directions {
            let velocity = |i: usize| velocity_from_rest(scene, &collided, rests[i], drag);
            let incomplete = ValidationError::Incomplete { test, what: "direction after the impact" };
            let [Some(one), Some(two)] = [velocity(0)?, velocity(1)?] else { return Err(incomplete) };
            let [speed_1, speed_2] = [one, two].map(|velocity| length_and_direction(velocity).0);
            let directed = [polar(speed_1, towards_1), polar(speed_2, towards_2)];
            for (method, velocities) in
                [(RestMethod::Motion, [one, two]), (RestMethod::MotionDirected, directed)]
            {
                let momentum = momentum_alone(&collided, velocities)?;
                let found = momentum.speeds().map_err(|source| ValidationError::of_test(test, source))?;
                rows.push(FromRestRow {
                    test,
                    method,
                    evidence: SpeedEvidence::Momentum,
                    drag,
                    after: [speed_1, speed_2],
                    true_speeds: collided.true_speeds,
                    found,
                });
            }
        } else if let Some(staged) = case {
            rows.push(from_slides(scene, &collided, rests, drag, staged)?);
        }
    }
    Ok(rows)
}

/// Momentum with these velocities after the impact (m/s). It needs no contact point, so tests without a
/// published one can use it.
fn momentum_alone(collided: &Collided, velocities: [Vector2<f64>; 2]) -> Result<Momentum, ValidationError> {
    let [one, two] = collided.bodies;
    let [heading_1, heading_2] = collided.headings;
    let participants = [
        Participant::new(one, heading_1, ANY_ARM, 0.0)?,
        Participant::new(two, heading_2, ANY_ARM, -FRAC_PI_2)?,
    ];
    Ok(Momentum {
        contact: Contact::new(participants, heading_1)?,
        yaw_rates: [0.0; 2],
        after: velocities.map(|velocity| Departure { velocity, yaw_rate: None }),
    })
}

/// Both vehicles rolled out nearly along the line of the approaches: a straight slide gives their speeds.
fn from_slides(
    scene: &Scene,
    collided: &Collided,
    rests: [&Rest; 2],
    drag: f64,
    staged: &Staged,
) -> Result<FromRestRow, ValidationError> {
    let friction = scene.ground().friction;
    let speed = |rest: &Rest| {
        let slide = Slide { friction, drag_share: drag / friction, grade: 0.0, distance: rest.distance() };
        slide.speed_at_start(0.0)
    };
    let after = [speed(rests[0])?, speed(rests[1])?];
    let [heading, _] = collided.headings;
    let still = Departure { velocity: Vector2::new(0.0, 0.0), yaw_rate: None };
    let mut momentum =
        Momentum { contact: staged.collision()?.contact, yaw_rates: [0.0; 2], after: [still; 2] };
    let axis = momentum.common_axis();
    // The axis may point either way; both vehicles went on in the direction of vehicle 1.
    let towards = if axis.dot(&polar(1.0, heading)) < 0.0 { -axis } else { axis };
    momentum.after = after.map(|speed| Departure { velocity: towards * speed, yaw_rate: None });
    let (evidence, found) = solved(momentum, staged)?;
    Ok(FromRestRow {
        test: staged.printed.test,
        method: RestMethod::Slide,
        evidence,
        drag,
        after,
        true_speeds: collided.true_speeds,
        found,
    })
}
