//! The motion after the impact: from there to rest, or back from the rest to how the vehicle left the impact.

use std::f64::consts::{FRAC_PI_2, PI};

use inputs::{MotionInput, RestData, RestHeadingData, SkidData, SteerData, SurfaceData, VehicleMotion};
use pim_core::{Motion, Real, Vector2, VehicleId};
use reconcile::Departure;
use trajectory::closed::{Slide, Spin, SpinStart, spins};
use trajectory::{
    Chassis, Control, Departure as Start, Ground, Rest, Sample, State, Target, Unreached, Zone, to_rest,
    to_start,
};

use crate::Failure;

/// The way of one vehicle from the impact to rest.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Travel {
    /// Where the motion at its start comes from.
    pub origin: Origin,
    /// The body on its wheels.
    pub chassis: Chassis,
    /// (rad) steer angle of the front wheels at the start.
    pub steer: f64,
    /// Where the vehicle left the impact, and how it moved there.
    pub start: State,
    /// The way, at the moments that the integration chose: the first is the start, the last the rest.
    pub samples: Vec<Sample>,
    /// Where the vehicle comes to rest.
    pub rest: Rest,
    /// Where it was found at rest.
    pub measured: Option<RestData>,
    /// (m) where its CG passed.
    pub points: Vec<Vector2<f64>>,
    /// Other starts that lead to the same rest.
    pub others: Vec<Start>,
    /// What the closed forms say of the start; `None` on ground with zones or a grade, which they do not
    /// know.
    pub closed: Option<ClosedForm>,
}

/// Where the motion at the start of a way comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The impact gives it.
    Impact,
    /// The case gives it.
    Given,
    /// It was found as the one that leads to the measured rest.
    Rest,
    /// The vehicle did not spin: it is taken to have left straight towards its rest, and the length of that
    /// way tells its speed.
    StraightRest,
}

impl Origin {
    /// Whether the rest of the vehicle tells it.
    #[must_use]
    pub fn is_by_rest(self) -> bool {
        matches!(self, Self::Rest | Self::StraightRest)
    }
}

/// Whether a vehicle went to its rest without a spin, by EDCRASH's rule, with its front wheels straight.
///
/// Where it lies to the side of its heading, and how it stands there, then hardly depend on how it left the
/// impact: rolling wheels soon turn the way along the heading. A search for the one motion that leads to the
/// measured place would make a sideways velocity of every error of the survey.
pub(crate) fn leaves_straight<T: Real>(way: &VehicleMotion<T>, rest: &RestData<T>) -> bool {
    let SteerData::Held(steer) = way.steer else { return false };
    let (heading, apart) = (way.heading.value(), rest.position - way.position);
    let turn = match rest.heading {
        RestHeadingData::Heading(at_rest) => real::principal_angle(at_rest.value() - heading),
        RestHeadingData::Turned(turn) => turn.value(),
    };
    let direction = Real::atan2(apart.y.value(), apart.x.value());
    // A vehicle may roll backward too.
    let ahead = real::principal_angle(direction - heading);
    let sideslip = if ahead.abs() > FRAC_PI_2 { real::principal_angle(ahead - PI) } else { ahead };
    let distance = (apart.x * apart.x + apart.y * apart.y).sqrt().value();
    let wheelbase = way.chassis.wheelbase().value();
    steer.value() == 0.0 && distance > 0.0 && spins(sideslip, turn, distance, wheelbase, 0.0) == Ok(false)
}

/// (m) how closely the length of a straight way is met.
const STRAIGHT_WAY: f64 = 1e-9;
/// Steps of that search: on one ground the first is exact.
const STRAIGHT_STEPS: usize = 60;
/// (m/s) where it begins, as far as it does not matter.
const STRAIGHT_BEGIN: f64 = 10.0;

/// The start of the way by a closed form: the one that EDCRASH's rule chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClosedForm {
    /// It slid or rolled straight to rest.
    Straight {
        /// (–) share of the friction that its wheels use.
        drag_share: f64,
        /// (m/s) speed at the start.
        speed: f64,
    },
    /// It spun: Marquard's two phases.
    Spin(SpinStart),
}

/// The ground of a case.
pub(crate) struct Scene<'a, T = f64> {
    surface: &'a SurfaceData<T>,
    zones: Vec<Zone<'a, T>>,
}

/// How a vehicle left the impact.
pub(crate) struct Left {
    /// Where it is known from.
    pub(crate) origin: Origin,
    /// Its velocity and yaw rate.
    pub(crate) motion: Motion,
    /// Other motions that lead to the same rest.
    pub(crate) others: Vec<Start>,
}

impl<'a, T: Real> Scene<'a, T> {
    pub(crate) fn new(surface: &'a SurfaceData<T>) -> Self {
        Self { surface, zones: surface.zones() }
    }

    pub(crate) fn ground(&self) -> Ground<'_, T> {
        Ground { friction: self.surface.friction, zones: &self.zones, grade: self.surface.grade }
    }

    /// Where a vehicle that leaves the impact with this motion comes to rest.
    pub(crate) fn to_rest(
        &self,
        vehicle: VehicleId,
        way: &VehicleMotion<T>,
        motion: Motion<T>,
        control: &Control,
    ) -> Result<Rest<T>, Failure> {
        let start = State { position: way.position, heading: way.heading, motion };
        to_rest(&way.chassis, way.steer.steer(), &self.ground(), &start, control, |_| {})
            .map_err(|reason| Failure::NoRest { vehicle, reason })
    }
}

impl Scene<'_> {
    /// The motion that leads to the rest of a vehicle.
    pub(crate) fn back(
        &self,
        vehicle: VehicleId,
        way: &VehicleMotion,
        rest: &RestData,
    ) -> Result<Left, Failure> {
        if leaves_straight(way, rest) {
            let motion = self.straight(vehicle, way, rest)?;
            return Ok(Left { origin: Origin::StraightRest, motion, others: Vec::new() });
        }
        let starts = to_start(
            &way.chassis,
            way.steer.steer(),
            &self.ground(),
            way.position,
            way.heading,
            &target(way, rest),
            &Control::default(),
        )
        .map_err(|reason| Failure::NoStart { vehicle, reason })?;
        let mut starts = starts.iter().copied();
        let first = starts.next().ok_or(Failure::NoStart { vehicle, reason: Unreached::NoWay })?;
        Ok(Left { origin: Origin::Rest, motion: first.motion, others: starts.collect() })
    }
}

impl Scene<'_> {
    /// The motion straight towards the rest, without yaw, whose way is as long as the measured one.
    pub(crate) fn straight(
        &self,
        vehicle: VehicleId,
        way: &VehicleMotion,
        rest: &RestData,
    ) -> Result<Motion, Failure> {
        let apart = rest.position - way.position;
        let length = apart.norm();
        let along = |speed: f64| Motion { velocity: apart * (speed / length), yaw_rate: 0.0 };
        let reach = |speed: f64| {
            let rest = self.to_rest(vehicle, way, along(speed), &Control::default())?;
            Ok::<_, Failure>((rest.position - way.position).norm())
        };
        // The way grows with the speed: between one that is too short and one that is too long.
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut speed = STRAIGHT_BEGIN;
        for _ in 0..STRAIGHT_STEPS {
            let reached = reach(speed)?;
            if (reached - length).abs() <= STRAIGHT_WAY {
                break;
            }
            if reached < length {
                low = speed;
            } else {
                high = speed;
            }
            // S ∝ V² on one ground, where this is exact.
            let next = speed * (length / reached).sqrt();
            speed = if next > low && next < high { next } else { 0.5 * (low + high.min(2.0 * speed)) };
        }
        Ok(along(speed))
    }
}

/// How a vehicle left the impact, and its way from there: as the case gives it, or as its rest tells; `None`
/// where the case tells neither.
pub(crate) fn left(
    scene: &Scene<'_>,
    vehicle: VehicleId,
    input: &VehicleMotion,
    given: Option<&Departure>,
) -> Result<Option<(Left, Option<Travel>)>, Failure> {
    let left = match (given, &input.rest) {
        (Some(given), _) => Left::given(given),
        (None, Some(rest)) => scene.back(vehicle, input, rest)?,
        (None, None) => return Ok(None),
    };
    // A velocity that is given without a yaw rate does not lead to a rest.
    let is_whole = given.is_none_or(|given| given.yaw_rate.is_some());
    let travel = if is_whole { Some(follow(scene, vehicle, input, &left)?) } else { None };
    Ok(Some((left, travel)))
}

impl Left {
    /// As the case gives it.
    pub(crate) fn given(given: &Departure) -> Self {
        let motion = Motion { velocity: given.velocity, yaw_rate: given.yaw_rate.unwrap_or_default() };
        Self { origin: Origin::Given, motion, others: Vec::new() }
    }
}

pub(crate) fn target(input: &VehicleMotion, rest: &RestData) -> Target {
    let (heading, turns_known) = match rest.heading {
        RestHeadingData::Heading(heading) => (heading, false),
        RestHeadingData::Turned(turn) => (input.heading + turn, true),
    };
    Target { position: rest.position, heading, turns_known, via: input.points.first().copied() }
}

/// Follows a vehicle from its start to rest.
pub(crate) fn follow(
    scene: &Scene<'_>,
    vehicle: VehicleId,
    input: &VehicleMotion,
    left: &Left,
) -> Result<Travel, Failure> {
    let start = State { position: input.position, heading: input.heading, motion: left.motion };
    let mut samples = Vec::new();
    let steer = input.steer.steer();
    let rest = to_rest(&input.chassis, steer, &scene.ground(), &start, &Control::default(), |sample| {
        samples.push(*sample);
    })
    .map_err(|reason| Failure::NoRest { vehicle, reason })?;
    Ok(Travel {
        origin: left.origin,
        chassis: input.chassis,
        steer: steer.at(0.0),
        start,
        samples,
        rest,
        measured: input.rest,
        points: input.points.clone(),
        others: left.others.clone(),
        closed: closed_form(scene.surface, input, &start, &rest),
    })
}

/// What a closed form says of the way that was followed, or measured where it was.
fn closed_form(
    surface: &SurfaceData,
    input: &VehicleMotion,
    start: &State,
    rest: &Rest,
) -> Option<ClosedForm> {
    if !surface.zones.is_empty() || surface.grade != Vector2::new(0.0, 0.0) {
        return None;
    }
    let (distance, turn) = (rest.distance, rest.heading - start.heading);
    let Motion { velocity, .. } = start.motion;
    let direction = Real::atan2(velocity.y, velocity.x);
    let sideslip = real::principal_angle(direction - start.heading);
    let (wheelbase, friction) = (input.chassis.wheelbase(), surface.friction);
    let body = input.chassis.body();
    if spins(sideslip, turn, distance, wheelbase, input.steer.steer().at(0.0)).ok()? {
        // k = √(I/m)
        let yaw_radius = (body.yaw_inertia() / body.mass()).sqrt();
        let spin = Spin { friction, distance, turn, yaw_radius, wheelbase };
        return spin.start().ok().map(ClosedForm::Spin);
    }
    // f = Σ min(d, μ) F_z/(μ W)
    let held = |wheel: &trajectory::Wheel| wheel.drag.min(friction) * wheel.load;
    let drag_share = input.chassis.wheels().iter().map(held).sum::<f64>() / friction;
    let slide = Slide { friction, drag_share, grade: 0.0, distance };
    slide.speed_at_start(0.0).ok().map(|speed| ClosedForm::Straight { drag_share, speed })
}

/// The motion of both vehicles to rest, as far as the case tells how they left the impact.
pub(crate) fn of_case(input: &MotionInput) -> Result<[Option<Travel>; 2], Failure> {
    let scene = Scene::new(&input.surface);
    let of = |id: VehicleId| {
        let Some(vehicle) = &input.vehicles[id.index()] else { return Ok(None) };
        let left = left(&scene, id, vehicle, vehicle.velocity.as_ref())?;
        Ok::<_, Failure>(left.and_then(|(_, travel)| travel))
    };
    Ok([of(VehicleId::One)?, of(VehicleId::Two)?])
}

/// The motion of both vehicles to rest after an impact.
pub(crate) fn after_impact(input: &MotionInput, after: [Motion; 2]) -> Result<[Option<Travel>; 2], Failure> {
    let scene = Scene::new(&input.surface);
    let of = |id: VehicleId| {
        let Some(vehicle) = &input.vehicles[id.index()] else { return Ok(None) };
        let left = Left { origin: Origin::Impact, motion: after[id.index()], others: Vec::new() };
        follow(&scene, id, vehicle, &left).map(Some)
    };
    Ok([of(VehicleId::One)?, of(VehicleId::Two)?])
}

impl Travel {
    /// (rad) of the velocity at the start.
    #[must_use]
    pub fn direction(&self) -> f64 {
        let velocity = self.start.motion.velocity;
        Real::atan2(velocity.y, velocity.x)
    }

    /// The same in axes of the other handedness; the chassis stays as it is.
    pub(crate) fn mirrored(self) -> Self {
        let across = |place: Vector2<f64>| Vector2::new(place.x, 0.0 - place.y);
        let turned =
            |motion: Motion| Motion { velocity: across(motion.velocity), yaw_rate: 0.0 - motion.yaw_rate };
        let state = |state: State| State {
            position: across(state.position),
            heading: 0.0 - state.heading,
            motion: turned(state.motion),
        };
        Self {
            steer: 0.0 - self.steer,
            start: state(self.start),
            samples: self
                .samples
                .into_iter()
                .map(|sample| Sample { state: state(sample.state), ..sample })
                .collect(),
            rest: Rest {
                position: across(self.rest.position),
                heading: 0.0 - self.rest.heading,
                ..self.rest
            },
            measured: self.measured.map(|rest| RestData {
                position: across(rest.position),
                heading: match rest.heading {
                    RestHeadingData::Heading(heading) => RestHeadingData::Heading(0.0 - heading),
                    RestHeadingData::Turned(turn) => RestHeadingData::Turned(0.0 - turn),
                },
            }),
            points: self.points.into_iter().map(across).collect(),
            others: self
                .others
                .into_iter()
                .map(|other| Start {
                    motion: turned(other.motion),
                    turn: 0.0 - other.turn,
                    rest: Rest {
                        position: across(other.rest.position),
                        heading: 0.0 - other.rest.heading,
                        ..other.rest
                    },
                    ..other
                })
                .collect(),
            closed: self.closed.map(|closed| match closed {
                ClosedForm::Spin(spin) => {
                    ClosedForm::Spin(SpinStart { yaw_rate: 0.0 - spin.yaw_rate, ..spin })
                }
                straight @ ClosedForm::Straight { .. } => straight,
            }),
            ..self
        }
    }

    /// (m) from the rest found to the one measured, and (rad) from its heading to that.
    #[must_use]
    pub fn miss(&self) -> Option<(f64, f64)> {
        let measured = self.measured.as_ref()?;
        let apart = measured.position - self.rest.position;
        let turned = match measured.heading {
            RestHeadingData::Heading(heading) => real::principal_angle(heading - self.rest.heading),
            RestHeadingData::Turned(turned) => self.start.heading + turned - self.rest.heading,
        };
        Some((apart.norm(), turned))
    }
}

/// Skid marks before the impact, and what they say of the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Skid {
    /// (m) from where they begin to the impact.
    pub length: f64,
    /// (–) friction.
    pub friction: f64,
    /// (m/s) speed where they begin.
    pub speed: f64,
}

/// What the skid marks of a vehicle say, which reached the impact with `speed` (m/s); `None` where the
/// numbers make no skid.
pub(crate) fn skid(given: SkidData, speed: f64) -> Option<Skid> {
    let SkidData { length, friction } = given;
    let slide = Slide { friction, drag_share: 1.0, grade: 0.0, distance: length };
    let speed = slide.speed_at_start(speed.abs()).ok()?;
    Some(Skid { length, friction, speed })
}
