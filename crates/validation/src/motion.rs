//! Vehicles followed from the published velocities after the impact to rest, and back.

use std::error::Error;

use pim_core::{Motion, Vector2, VehicleId};
use trajectory::{Chassis, Control, Ground, StartMotion, Starts, State, Steer, Target, to_rest, to_start};

use crate::claim::Cell;
use crate::error::ValidationError;
use crate::published::DEGREE;
use crate::scene::{Collided, Rest, Scene, length_and_direction, polar};
use crate::staged::Staged;

/// The drag is not published: it was fitted to the distance, to three decimals and with another integration.
const DISTANCE: f64 = 0.03;
/// (rad) the turn of the Rabbit in test 6, the one vehicle that spun.
const TURN: f64 = 5.0 * DEGREE;
/// Tolerance of the speed found backward from our own rest position.
const ROUND_TRIP: f64 = 0.001;
/// (rad) accuracy of the direction of the path: the diagrams of the tests can be read to 5° to 10°.
const DIRECTION: f64 = 5.0 * DEGREE;

const FREE_WHEELS: &str = "the vehicle rolled, and the angle of its front wheels, which nobody held, and the drag of its single wheels are \
     not published: the simulation has straight wheels of equal drag";
const STRUCK_AGAIN: &str = "vehicle 2 struck it a second time, from the side, at a time and place that are \
                            not published, so its rest is not that \
     of a free motion; its drag is the mean of those fitted to the other tests";
const SENSITIVE: &str = "a spin that ends in rolling hardly determines the velocity at which it began: the \
                         speeds found for a path that is turned by 5° are given next to it. The distance is \
                         that to which the drag was fitted, the direction of the path and the turn are the \
                         published ones";

/// A vehicle followed from its published velocity to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionRow {
    /// The test.
    pub test: u8,
    /// The vehicle.
    pub vehicle: VehicleId,
    /// (–) drag of each wheel, fitted to the distance.
    pub drag: f64,
    /// (m) from the impact to rest.
    pub distance: Cell,
    /// (m) possible error of the published distance.
    pub within: f64,
    /// (m) length of the path.
    pub path: f64,
    /// (s) from the impact to rest.
    pub time: f64,
    /// (rad) turn along its path, counter-clockwise.
    pub turn: Cell,
    /// (m) from our rest position to the point at the published distance in the published direction, if that
    /// is known.
    pub miss: Option<f64>,
}

/// A vehicle followed from its rest position back to its velocity after the impact.
#[derive(Clone, Debug, PartialEq)]
pub struct ReturnRow {
    /// The test.
    pub test: u8,
    /// The vehicle.
    pub vehicle: VehicleId,
    /// (–) drag of each wheel, fitted to the distance.
    pub drag: f64,
    /// (m/s) speed found from our own rest position, compared with the published one that led to it.
    pub round_trip: Cell,
    /// The motion that leads to the published rest position, if its direction is known.
    pub from_rest: Option<FoundStart>,
}

/// A velocity after the impact that leads to the published rest position, and the published one.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundStart {
    /// (m/s) speed.
    pub speed: Cell,
    /// (rad) direction in the scene.
    pub direction: Cell,
    /// (rad/s) yaw rate, counter-clockwise.
    pub yaw_rate: Cell,
    /// (m/s) speeds found with the direction of the path turned by −5° and by +5°, counter-clockwise.
    pub turned: [f64; 2],
}

/// Mean errors of the path in a simulation of whole collisions, from before the impact to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulation {
    /// Its name.
    pub name: String,
    /// The smallest and the largest of the five tests, as shares of the path.
    pub errors: [f64; 2],
}

/// One vehicle on its path.
struct Way<'a> {
    rest: &'a Rest,
    ground: Ground<'static>,
    chassis: Chassis,
    /// (rad)
    heading: f64,
}

/// A vehicle's path to rest with a given drag (–).
fn way<'a>(
    scene: &Scene,
    collided: &Collided,
    rest: &'a Rest,
    drag: f64,
) -> Result<Way<'a>, ValidationError> {
    let i = rest.vehicle().index();
    Ok(Way {
        rest,
        ground: scene.ground(),
        chassis: rest.chassis(collided.bodies[i], drag)?,
        heading: collided.headings[i],
    })
}

impl Way<'_> {
    fn to_rest(&self, motion: Motion) -> Result<trajectory::Rest, ValidationError> {
        let start = State { position: Vector2::new(0.0, 0.0), heading: self.heading, motion };
        to_rest(&self.chassis, Steer::straight(), &self.ground, &start, &Control::default(), |_| {})
            .map_err(|source| self.failed(source))
    }

    fn failed(&self, source: impl Error + Send + Sync + 'static) -> ValidationError {
        let test = self.rest.test;
        ValidationError::Vehicle { test, vehicle: self.rest.vehicle(), source: Box::new(source) }
    }

    fn starts(&self, target: &Target) -> Result<Starts, ValidationError> {
        let origin = Vector2::new(0.0, 0.0);
        let (steer, control) = (Steer::straight(), Control::default());
        to_start(&self.chassis, steer, &self.ground, origin, self.heading, target, &control)
            .map_err(|source| self.failed(source))
    }

    /// The most likely motion that leads to the published distance and turn in a direction (rad).
    fn published_start(&self, direction: f64) -> Result<Motion, ValidationError> {
        let starts = self.starts(&self.rest.target(direction, self.heading))?;
        let first = starts.first().map(|departure| departure.motion);
        first.ok_or(ValidationError::Incomplete { test: self.rest.test, what: "motion to its rest" })
    }
}

/// (m/s) velocity after the impact that leads to the published rest position of a vehicle with a drag (–).
pub(crate) fn velocity_from_rest(
    scene: &Scene,
    collided: &Collided,
    rest: &Rest,
    drag: f64,
) -> Result<Option<Vector2<f64>>, ValidationError> {
    let Some(direction) = rest.direction() else { return Ok(None) };
    let way = way(scene, collided, rest, drag)?;
    Ok(Some(way.published_start(direction)?.velocity))
}

pub(crate) fn simulations(scene: &Scene) -> Vec<Simulation> {
    let share = |percent: f64| percent / 100.0;
    scene
        .simulation
        .iter()
        .map(|printed| Simulation { name: printed.name.clone(), errors: printed.errors.map(share) })
        .collect()
}

/// Every vehicle with a published velocity after the impact and a published rest position: to rest, and back
/// if it came to rest undisturbed.
pub(crate) fn motions(
    scene: &Scene,
    staged: &[Staged],
) -> Result<(Vec<MotionRow>, Vec<ReturnRow>), ValidationError> {
    let (mut forward, mut backward) = (Vec::new(), Vec::new());
    for rest in &scene.rest {
        let Some(after) = scene.after(rest.test) else { continue };
        let motion = after.motion(rest.vehicle());
        let collided = scene.collided(staged, rest.test)?;
        let drag = rest.drag.unwrap_or_else(|| scene.drag_of_others(rest.test));
        let way = way(scene, &collided, rest, drag)?;
        let ours = way.to_rest(motion)?;
        forward.push(motion_row(&way, drag, &ours));
        if !rest.struck_again {
            backward.push(return_row(&way, drag, motion, &ours)?);
        }
    }
    Ok((forward, backward))
}

fn motion_row(way: &Way<'_>, drag: f64, ours: &trajectory::Rest) -> MotionRow {
    let rest = way.rest;
    let (distance, published) = (length_and_direction(ours.position).0, rest.distance());
    let (turn, published_turn) = (ours.heading - way.heading, rest.turn(way.heading));
    let spun = published_turn.abs() > std::f64::consts::FRAC_PI_2;
    let (distance, turn) = if rest.struck_again {
        (Cell::known(distance, published, STRUCK_AGAIN), Cell::known(turn, published_turn, STRUCK_AGAIN))
    } else {
        let turn = if spun {
            Cell::claimed(turn, published_turn, TURN)
        } else {
            Cell::known(turn, published_turn, FREE_WHEELS)
        };
        (Cell::claimed(distance, published, DISTANCE * published), turn)
    };
    let point = rest.direction().map(|direction| polar(published, direction));
    MotionRow {
        test: rest.test,
        vehicle: rest.vehicle(),
        drag,
        distance,
        within: rest.within(),
        path: ours.distance,
        time: ours.time,
        turn,
        miss: point.filter(|_| !rest.struck_again).map(|point| length_and_direction(ours.position - point).0),
    }
}

fn return_row(
    way: &Way<'_>,
    drag: f64,
    motion: Motion,
    ours: &trajectory::Rest,
) -> Result<ReturnRow, ValidationError> {
    let rest = way.rest;
    let (speed, direction) = length_and_direction(motion.velocity);
    let own = Target { position: ours.position, heading: ours.heading, turns_known: true, via: None };
    let found_speed = |departure: &StartMotion| length_and_direction(departure.motion.velocity).0;
    let off = |found: &f64| (found - speed).abs();
    let round_trip = way
        .starts(&own)?
        .iter()
        .map(found_speed)
        .min_by(|a, b| off(a).total_cmp(&off(b)))
        .unwrap_or(f64::NAN);
    let from_rest = rest
        .direction()
        .map(|to| {
            let found = way.published_start(to)?;
            let turned =
                |by: f64| way.published_start(to + by).map(|motion| length_and_direction(motion.velocity).0);
            let (found_speed, found_direction) = length_and_direction(found.velocity);
            Ok::<_, ValidationError>(FoundStart {
                speed: Cell::known(found_speed, speed, SENSITIVE),
                direction: Cell::known(
                    direction + real::principal_angle(found_direction - direction),
                    direction,
                    SENSITIVE,
                ),
                yaw_rate: Cell::known(found.yaw_rate, motion.yaw_rate, SENSITIVE),
                turned: [turned(-DIRECTION)?, turned(DIRECTION)?],
            })
        })
        .transpose()?;
    Ok(ReturnRow {
        test: rest.test,
        vehicle: rest.vehicle(),
        drag,
        round_trip: Cell::claimed(round_trip, speed, ROUND_TRIP * speed),
        from_rest,
    })
}
