//! The motion after the impact: to rest, or back from the rest position to how the vehicle left the impact.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use inputs::{
    Axes, MotionInput, PointData, RestData, RestHeadingData, SkidData, SteerData, SurfaceData, VehicleMotion,
};
use pim_core::{Motion, Real, Vector2, VehicleId};
use reconcile::Departure;
use trajectory::closed::{Slide, Spin, SpinStart, spins};
use trajectory::{
    Chassis, Control, FrictionZone, Ground, Rest, Sample, StartMotion as Start, State, Target, Unreached,
    to_rest, to_start,
};

use crate::failure::Failure;
use crate::thresholds::{POINT_MISSED, REST_LEAST, REST_SEARCHED, REST_SURVEY, SLOW_YAW};

/// (byte) stack size for threads that call these functions: in unoptimised builds, a search back from a rest
/// position needs more than the usual 2 MiB.
pub const THREAD_STACK: usize = 16 << 20;

/// The path of one vehicle from the impact to rest.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Travel {
    /// The source of the motion at its start.
    pub origin: TravelOrigin,
    /// The body on its wheels.
    pub chassis: Chassis,
    /// (rad) steer angle of the front wheels at the start.
    pub steer: f64,
    /// (–) coefficient of friction on its path, outside all zones.
    pub friction: f64,
    /// The position where the vehicle left the impact, and its motion there.
    pub start: State,
    /// The path at the time steps of the integration: the first is the start, the last the rest.
    pub samples: Vec<Sample>,
    /// The rest position of the vehicle.
    pub rest: Rest,
    /// Its measured rest position.
    pub measured: Option<RestData>,
    /// Measured points of the path of its CG.
    pub points: Vec<PointData>,
    /// How the path passes each of them.
    pub passes: Vec<Pass>,
    /// Other starts that lead to the same rest position; if points are given, without those that miss them by
    /// too much.
    pub others: Vec<Start>,
    /// The start by the closed forms; `None` on ground with zones or a grade, which they do not cover.
    pub closed: Option<ClosedForm>,
}

/// How a path passes a measured point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// (m) from the path to the point, where they are nearest.
    pub miss: f64,
    /// (rad) from the heading there to the measured one, in (−π, π].
    pub turned: Option<f64>,
}

impl Pass {
    /// (–) the miss in position, or by the turn of the wheelbase (m) if that is more, as a share of the
    /// length of the path (m). Of the miss, the first `known` metres do not count.
    fn share(&self, wheelbase: f64, distance: f64, known: f64) -> f64 {
        let miss = self.miss.max(wheelbase * self.turned.unwrap_or_default().abs()) - known;
        if miss > 0.0 { miss / distance } else { 0.0 }
    }

    /// The same in the given axes.
    pub(crate) fn in_axes(self, axes: Axes) -> Self {
        Self { turned: self.turned.map(|turned| axes.lateral(turned)), ..self }
    }
}

/// The source of the motion at the start of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TravelOrigin {
    /// The impact gives it.
    Impact,
    /// The case gives it.
    Given,
    /// It was found as the one that leads to the measured rest.
    Rest,
    /// The vehicle did not spin: it is assumed to have left straight towards its rest position, and the
    /// length of that path gives its speed.
    StraightRest,
}

impl TravelOrigin {
    /// Whether it comes from the rest position of the vehicle.
    #[must_use]
    pub fn is_by_rest(self) -> bool {
        matches!(self, Self::Rest | Self::StraightRest)
    }
}

/// Whether a vehicle went to rest without a spin, by EDCRASH's rule, with its front wheels straight.
///
/// Its lateral rest position and its heading at rest then hardly depend on how it left the impact: rolling
/// wheels soon turn the path along the heading. A search for the one motion that leads to the measured
/// position would turn every survey error into a sideways velocity.
pub(crate) fn leaves_straight<T: Real>(way: &VehicleMotion<T>, rest: &RestData<T>) -> bool {
    let SteerData::Held(steer) = way.steer else { return false };
    let (heading, apart) = (way.heading.value(), rest.position - way.position);
    let turn = rest.heading.heading(way.heading).value() - heading;
    let turn = if rest.heading.turns_are_known() { turn } else { real::principal_angle(turn) };
    let direction = Real::atan2(apart.y.value(), apart.x.value());
    // A vehicle may roll backward too.
    let ahead = real::principal_angle(direction - heading);
    let sideslip = if ahead.abs() > FRAC_PI_2 { real::principal_angle(ahead - PI) } else { ahead };
    let distance = (apart.x * apart.x + apart.y * apart.y).sqrt().value();
    let wheelbase = way.chassis.wheelbase().value();
    steer.value() == 0.0 && distance > 0.0 && spins(sideslip, turn, distance, wheelbase, 0.0) == Ok(false)
}

/// (m) tolerance of the length of a straight path.
const STRAIGHT_WAY: f64 = 1e-9;
/// (m) a path that ends as near as this is the one sought: more than the error of its integration.
const STRAIGHT_NEAR: f64 = 1e-3;
/// Maximum number of steps of that search: on uniform ground, the first is exact.
const STRAIGHT_STEPS: usize = 60;
/// (m/s) its initial speed, which does not affect the result.
const STRAIGHT_BEGIN: f64 = 10.0;

/// The start of the path by the closed form that EDCRASH's rule selects.
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

/// A vehicle on the ground of a case, which can be followed from the impact to rest.
pub(crate) struct Followed<'a, T = f64> {
    pub(crate) vehicle: VehicleId,
    pub(crate) way: &'a VehicleMotion<T>,
    surface: &'a SurfaceData<T>,
    zones: Vec<FrictionZone<'a, T>>,
}

/// A path from the impact to rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way<T = f64> {
    /// How the vehicle moved at its start.
    pub(crate) start: Motion<T>,
    /// Its end.
    pub(crate) rest: Rest<T>,
}

/// How a vehicle left the impact.
struct Left {
    /// The source of its motion.
    origin: TravelOrigin,
    /// Its velocity and yaw rate.
    motion: Motion,
    /// Other motions that lead to the same rest position.
    others: Vec<Start>,
}

impl<'a, T: Real> Followed<'a, T> {
    /// `None` if the input leaves the vehicle out.
    pub(crate) fn of(input: &'a MotionInput<T>, vehicle: VehicleId) -> Option<Self> {
        let (way, surface) = (input.vehicles[vehicle.index()].as_ref()?, &input.surface);
        Some(Self { vehicle, way, surface, zones: surface.zones() })
    }

    /// The ground under it.
    pub(crate) fn ground(&self) -> Ground<'_, T> {
        Ground { friction: self.way.friction_on(self.surface), zones: &self.zones, grade: self.surface.grade }
    }

    /// Its path if it leaves the impact with the motion `start`; `record` gets the samples.
    pub(crate) fn to_rest(
        &self,
        start: Motion<T>,
        control: &Control,
        record: impl FnMut(&Sample<T>),
    ) -> Result<Way<T>, Failure> {
        let (way, vehicle) = (self.way, self.vehicle);
        let state = State { position: way.position, heading: way.heading, motion: start };
        to_rest(&way.chassis, way.steer.steer(), &self.ground(), &state, control, record)
            .map(|rest| Way { start, rest })
            .map_err(|reason| Failure::NoRest { vehicle, reason })
    }
}

impl Followed<'_> {
    /// The motion that leads to its rest position.
    fn back(&self, rest: &RestData) -> Result<Left, Failure> {
        if !leaves_straight(self.way, rest) {
            return self.sought(rest);
        }
        let straight = self.straight(rest)?;
        let miss = (straight.rest.position - rest.position).norm();
        let is_missed = miss > REST_SURVEY && miss > REST_SEARCHED * straight.rest.distance;
        if is_missed && let Ok(sought) = self.sought(rest) {
            // Rolling wheels curved the path: the line to the rest position is not its initial direction.
            let turns = |motion: &Motion| motion.yaw_rate.abs();
            let motions = sought.others.iter().map(|other| other.motion);
            let motions = std::iter::once(sought.motion).chain(motions);
            let slowest = motions.min_by(|a, b| turns(a).total_cmp(&turns(b)));
            if let Some(motion) = slowest.filter(|motion| turns(motion) <= SLOW_YAW) {
                return Ok(Left { origin: TravelOrigin::Rest, motion, others: Vec::new() });
            }
        }
        Ok(Left { origin: TravelOrigin::StraightRest, motion: straight.start, others: Vec::new() })
    }

    /// The same by a search of all motions.
    fn sought(&self, rest: &RestData) -> Result<Left, Failure> {
        let (way, vehicle) = (self.way, self.vehicle);
        let (steer, ground, target) = (way.steer.steer(), self.ground(), self.target(rest));
        let control = Control::default();
        let starts = to_start(&way.chassis, steer, &ground, way.position, way.heading, &target, &control)
            .map_err(|reason| Failure::NoStart { vehicle, reason })?;
        let off = |start: &Start| Ok((self.off(start)?, *start));
        let mut starts: Vec<(f64, Start)> = starts.iter().map(off).collect::<Result<_, Failure>>()?;
        // If the points do not distinguish them, the order of `to_start` remains: the smallest turn first.
        starts.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut starts = starts.into_iter();
        let (off, first) = starts.next().ok_or(Failure::NoStart { vehicle, reason: Unreached::NoWay })?;
        let is_told_apart = |other: f64| off <= POINT_MISSED && other > POINT_MISSED;
        let others = starts.filter(|(other, _)| !is_told_apart(*other)).map(|(_, start)| start).collect();
        Ok(Left { origin: TravelOrigin::Rest, motion: first.motion, others })
    }

    /// (–) the largest miss of a point by the path of a start, in position or by the turn of the wheelbase,
    /// beyond the error that even a short path has, as a share of the path; zero without points.
    fn off(&self, start: &Start) -> Result<f64, Failure> {
        let passes = self.passes(start.motion, Control::default().tolerance)?;
        let share = |pass: &Pass| pass.share(self.way.chassis.wheelbase(), start.rest.distance, REST_LEAST);
        Ok(passes.iter().map(share).fold(0.0, f64::max))
    }

    /// How it passes its points if it leaves the impact with the motion `start`. A step of its path may have
    /// an error of `tolerance` (m).
    pub(crate) fn passes(&self, start: Motion, tolerance: f64) -> Result<Vec<Pass>, Failure> {
        if self.way.points.is_empty() {
            return Ok(Vec::new());
        }
        let control = Control { tolerance, longest_step: LONGEST_BETWEEN, ..Control::default() };
        let mut path = Vec::new();
        self.to_rest(start, &control, |sample| path.push(*sample))?;
        Ok(self.way.points.iter().map(|point| pass(&path, &self.way.chassis, point)).collect())
    }

    /// The path that begins straight towards the rest position, without yaw, with the measured length.
    pub(crate) fn straight(&self, rest: &RestData) -> Result<Way, Failure> {
        let apart = rest.position - self.way.position;
        let length = apart.norm();
        let reach = |speed: f64| {
            let start = Motion { velocity: apart * (speed / length), yaw_rate: 0.0 };
            let reached = self.to_rest(start, &Control::default(), |_| {})?;
            Ok::<_, Failure>((reached, (reached.rest.position - self.way.position).norm()))
        };
        // The path length grows with the speed: bracket it between too short and too long.
        let (mut low, mut high) = ([0.0, 0.0], None);
        let mut speed = STRAIGHT_BEGIN;
        let (mut found, mut reached) = reach(speed)?;
        for step in 1..=STRAIGHT_STEPS {
            if (reached - length).abs() <= STRAIGHT_WAY {
                return Ok(found);
            }
            if reached < length {
                low = [speed, reached];
            } else {
                high = Some([speed, reached]);
            }
            speed = match (low, high) {
                // Where the ground changes, S may grow far faster than V²: the false position of one side
                // alone would stay, so every third step halves.
                ([slow, short], Some([fast, long])) if slow > 0.0 => {
                    let share = if step % 3 == 0 { 0.5 } else { (length - short) / (long - short) };
                    (slow * slow + share * (fast * fast - slow * slow)).sqrt()
                }
                // S ∝ V² on uniform ground, where this is exact.
                _ => speed * (length / reached).sqrt(),
            };
            (found, reached) = reach(speed)?;
        }
        let Way { start, rest } = found;
        let miss = (reached - length).abs();
        if miss <= STRAIGHT_NEAR {
            return Ok(found);
        }
        let reason =
            Unreached::Missed { motion: start, position: rest.position, heading: rest.heading, miss };
        Err(Failure::NoStart { vehicle: self.vehicle, reason })
    }

    /// The target of the search for the motion that leads to its rest position.
    pub(crate) fn target(&self, rest: &RestData) -> Target {
        let of_cg = self.way.points.iter().find(|point| point.wheel.is_none());
        Target {
            position: rest.position,
            heading: rest.heading.heading(self.way.heading),
            turns_known: rest.heading.turns_are_known(),
            via: of_cg.map(|point| point.position),
        }
    }
}

/// (s) between the interpolated positions of a path, which is taken as straight between them.
const BETWEEN_PLACES: f64 = 0.02;
/// (s) the longest step of such a path: its positions within a step are those of a cubic.
const LONGEST_BETWEEN: f64 = 0.2;

/// How a path passes a point: that of the CG, or of the wheel that passed the point.
fn pass(path: &[Sample], chassis: &Chassis, point: &PointData) -> Pass {
    let wheel = point.wheel.map(|wheel| &chassis.wheels()[wheel as usize]);
    // From the CG to the wheel: (f cos θ − l sin θ, f sin θ + l cos θ)
    let place = |state: &State| {
        wheel.map_or(state.position, |wheel| {
            let (sin, cos) = Real::sin_cos(state.heading);
            let (forward, left) = (wheel.forward, wheel.left);
            state.position + Vector2::new(forward * cos - left * sin, forward * sin + left * cos)
        })
    };
    let arm = wheel.map_or(0.0, |wheel| Vector2::new(wheel.forward, wheel.left).norm());
    // The path is at most this far from the point.
    let distances = path.iter().map(|sample| (place(&sample.state) - point.position).norm());
    let farthest = distances.fold(f64::INFINITY, f64::min);
    let mut nearest = Pass { miss: f64::INFINITY, turned: None };
    for pair in path.windows(2) {
        let [before, after] = pair else { continue };
        if least_distance(before, after, point.position) - arm > farthest {
            continue;
        }
        let span = after.time - before.time;
        let shares = (span / BETWEEN_PLACES).ceil().max(1.0);
        let (mut from, mut heading, mut share) = (place(&before.state), before.state.heading, 1.0);
        while share <= shares {
            let state = match share < shares {
                true => before.between(after, before.time + span * (share / shares)),
                false => after.state,
            };
            let (to, later) = (place(&state), state.heading);
            let (side, off) = (to - from, point.position - from);
            let square = side.dot(&side);
            let along = if square > 0.0 { (off.dot(&side) / square).clamp(0.0, 1.0) } else { 0.0 };
            let miss = (off - side * along).norm();
            if miss < nearest.miss {
                let there = heading + (later - heading) * along;
                let turned = point.heading.map(|measured| real::principal_angle(measured - there));
                nearest = Pass { miss, turned };
            }
            (from, heading) = (to, later);
            share += 1.0;
        }
    }
    nearest
}

/// (m) bound on the distance from a point to the path of the CG between two samples. That path is a cubic,
/// which stays within the convex hull of its Bézier points: both ends, and a third of the span ahead of the
/// one and back from the other with the velocities there.
fn least_distance(before: &Sample, after: &Sample, point: Vector2<f64>) -> f64 {
    let third = (after.time - before.time) / 3.0;
    let chord = after.state.position - before.state.position;
    let [ahead, back] = [before, after].map(|sample| sample.state.motion.velocity * third);
    let radius = chord.norm().max(ahead.norm()).max((chord - back).norm());
    (point - before.state.position).norm() - radius
}

/// The source of the vehicles' paths.
pub(crate) trait Ways<T: Real> {
    /// The path of a vehicle that left the impact with the motion `start`.
    fn follow(&mut self, of: &Followed<'_, T>, start: Motion<T>) -> Result<Way<T>, Failure>;

    /// The path that leads to the rest position of a vehicle.
    fn back(&mut self, of: &Followed<'_, T>, rest: &RestData<T>) -> Result<Way<T>, Failure>;
}

/// How a vehicle left the impact, if known, and its path from there, if it can be followed.
type Leaving<T> = (Option<Departure<T>>, Option<Way<T>>);

/// How both vehicles left the impact: as `given`, or as found from their rest positions.
pub(crate) fn departures<T: Real>(
    motion: Option<&MotionInput<T>>,
    given: [Option<Departure<T>>; 2],
    ways: &mut impl Ways<T>,
) -> Result<[Leaving<T>; 2], Failure> {
    let mut leaving = |id: VehicleId| {
        let given = given[id.index()];
        let Some(of) = motion.and_then(|motion| Followed::of(motion, id)) else { return Ok((given, None)) };
        let leaving: Leaving<T> = match (given, &of.way.rest) {
            (Some(Departure { velocity, yaw_rate: Some(yaw_rate) }), _) => {
                (given, Some(ways.follow(&of, Motion { velocity, yaw_rate })?))
            }
            // A velocity without a yaw rate does not lead to a rest position.
            (Some(_), _) | (None, None) => (given, None),
            (None, Some(rest)) => {
                let found = ways.back(&of, rest)?;
                let Motion { velocity, yaw_rate } = found.start;
                (Some(Departure { velocity, yaw_rate: Some(yaw_rate) }), Some(found))
            }
        };
        Ok::<_, Failure>(leaving)
    };
    Ok([leaving(VehicleId::One)?, leaving(VehicleId::Two)?])
}

/// The paths of both vehicles after an impact.
pub(crate) fn after_impact<T: Real>(
    input: &MotionInput<T>,
    after: [Motion<T>; 2],
    ways: &mut impl Ways<T>,
) -> Result<[Option<Way<T>>; 2], Failure> {
    let mut way = |id| Followed::of(input, id).map(|of| ways.follow(&of, after[id.index()])).transpose();
    Ok([way(VehicleId::One)?, way(VehicleId::Two)?])
}

/// Finds the paths of an analysis and keeps all of them.
pub(crate) struct Record {
    /// The source of a motion that is followed.
    origin: TravelOrigin,
    /// The paths that were followed.
    pub(crate) travel: [Option<Travel>; 2],
}

impl Record {
    /// A record of motions that have this source unless a rest position gives them.
    pub(crate) fn of(origin: TravelOrigin) -> Self {
        Self { origin, travel: [None, None] }
    }

    /// Chooses another of the starts that lead to the rest position of a vehicle.
    pub(crate) fn choose(
        &mut self,
        vehicle: VehicleId,
        input: &MotionInput,
        start: Start,
    ) -> Result<Option<Way>, Failure> {
        let Some(of) = Followed::of(input, vehicle) else { return Ok(None) };
        let Some(travel) = &self.travel[vehicle.index()] else { return Ok(None) };
        let starts = std::iter::once(travel.used()).chain(travel.others.iter().copied());
        let others = starts.filter(|other| other.motion != start.motion).collect();
        let left = Left { origin: TravelOrigin::Rest, motion: start.motion, others };
        self.keep(&of, left).map(Some)
    }

    fn keep(&mut self, of: &Followed<'_>, left: Left) -> Result<Way, Failure> {
        let input = of.way;
        let start = State { position: input.position, heading: input.heading, motion: left.motion };
        let mut samples = Vec::new();
        let way = of.to_rest(left.motion, &Control::default(), |sample| samples.push(*sample))?;
        let passes = of.passes(left.motion, Control::default().tolerance)?;
        self.travel[of.vehicle.index()] = Some(Travel {
            origin: left.origin,
            chassis: input.chassis,
            steer: input.steer.steer().at(0.0),
            friction: input.friction_on(of.surface),
            start,
            samples,
            rest: way.rest,
            measured: input.rest,
            points: input.points.clone(),
            passes,
            others: left.others,
            closed: closed_form(of, left.origin, &start, &way.rest),
        });
        Ok(way)
    }
}

impl Ways<f64> for Record {
    fn follow(&mut self, of: &Followed<'_>, start: Motion) -> Result<Way, Failure> {
        self.keep(of, Left { origin: self.origin, motion: start, others: Vec::new() })
    }

    fn back(&mut self, of: &Followed<'_>, rest: &RestData) -> Result<Way, Failure> {
        self.keep(of, of.back(rest)?)
    }
}

/// The start of the path by a closed form; `None` if the assumptions of none hold.
fn closed_form(
    &Followed { way: input, surface, .. }: &Followed<'_>,
    origin: TravelOrigin,
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
    let (wheelbase, friction) = (input.chassis.wheelbase(), input.friction_on(surface));
    let body = input.chassis.body();
    let is_spin = spins(sideslip, turn, distance, wheelbase, input.steer.steer().at(0.0)).ok()?;
    if is_spin && origin != TravelOrigin::StraightRest {
        // Marquard's wheels turn: there is no equation for a spin with locked wheels. And the vehicle
        // alternates between slipping sideways and rolling in line, which takes a quarter of a turn.
        let is_held = input.chassis.wheels().iter().any(|wheel| wheel.drag >= friction);
        if is_held || turn.abs() < FRAC_PI_2 {
            return None;
        }
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

/// (rad) 300°: another motion with a larger turn than this is not reported if one with a smaller turn exists.
pub const UNLIKELY_TURN: f64 = 5.0 / 6.0 * TAU;

impl Travel {
    /// The start of this path as one of those that lead to the rest position.
    pub(crate) fn used(&self) -> Start {
        Start {
            motion: self.start.motion,
            turn: self.rest.heading - self.start.heading,
            miss: self.miss().map_or(0.0, |(miss, _)| miss),
            via_miss: None,
            rest: self.rest,
        }
    }

    /// The other starts that lead to the same rest position, without those with a turn of about one
    /// revolution, which a vehicle with its heading unchanged did not make.
    pub fn likely_others(&self) -> impl Iterator<Item = &Start> {
        self.others.iter().filter(|other| other.turn.abs() < UNLIKELY_TURN)
    }

    /// (rad) direction of the velocity at the start.
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
            points: self
                .points
                .into_iter()
                .map(|point| PointData {
                    position: across(point.position),
                    heading: point.heading.map(|heading| 0.0 - heading),
                    wheel: point.wheel,
                })
                .collect(),
            passes: self.passes.into_iter().map(|pass| pass.in_axes(Axes::ZDown)).collect(),
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

    /// (–) the miss of each point by the path, in position or by the turn of the wheelbase if that is more,
    /// as a share of the path length.
    pub fn shares_missed(&self) -> impl Iterator<Item = f64> {
        self.passes.iter().map(|pass| pass.share(self.chassis.wheelbase(), self.rest.distance, 0.0))
    }

    /// (m) from the computed rest position to the measured one, and (rad) between their headings.
    #[must_use]
    pub fn miss(&self) -> Option<(f64, f64)> {
        let measured = self.measured.as_ref()?;
        let apart = measured.position - self.rest.position;
        let turned = measured.heading.heading(self.start.heading) - self.rest.heading;
        let turned = if measured.heading.turns_are_known() { turned } else { real::principal_angle(turned) };
        Some((apart.norm(), turned))
    }
}

/// Skid marks before the impact, and the speed at their start.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolvedSkid {
    /// (m) from their start to the impact.
    pub length: f64,
    /// (–) friction.
    pub friction: f64,
    /// (m/s) speed at their start.
    pub speed: f64,
}

impl SolvedSkid {
    /// The skid of a vehicle that reached the impact with `speed` (m/s); `None` if the numbers are not those
    /// of a skid.
    pub(crate) fn to(given: SkidData, speed: f64) -> Option<Self> {
        let SkidData { length, friction } = given;
        Some(Self { length, friction, speed: skid_speed(given, speed)? })
    }
}

/// (m/s) the speed where skid marks begin, of a vehicle that reached the impact with `speed` (m/s); `None` if
/// the numbers are not those of a skid.
pub(crate) fn skid_speed<T: Real>(given: SkidData<T>, speed: T) -> Option<T> {
    let SkidData { length, friction } = given;
    let slide = Slide { friction, drag_share: T::ONE, grade: T::ZERO, distance: length };
    slide.speed_at_start(speed.abs()).ok()
}

#[cfg(test)]
mod tests {
    use super::{LONGEST_BETWEEN, pass};
    use ::uncertainty::random::{bits, unit};
    use inputs::{MarkedWheel, PointData};
    use pim_core::{Body, Motion, Vector2};
    use trajectory::{Axles, Chassis, Control, Ground, Sample, State, Steer, to_rest};

    /// A car that spins to rest passes points next to its path and far from it: the least distance of 20,000
    /// positions of the wheel, or of the CG, is that of the path.
    #[test]
    fn a_pass_is_the_least_distance_of_the_whole_path() {
        let axles = Axles { cg_to_front: 1.2, cg_to_rear: 1.4, track: 1.5 };
        let body = Body::new(1400.0, 2600.0).unwrap();
        for number in 0..60 {
            let of = |place: u64, low: f64, high: f64| low + (high - low) * unit(bits(place, number));
            let drag = [0, 1, 2, 3].map(|wheel| if of(wheel, 0.0, 1.0) < 0.4 { 1.0 } else { 0.1 });
            let chassis = Chassis::new(body, axles, drag).unwrap();
            let velocity = Vector2::new(of(5, 2.0, 20.0), of(6, -6.0, 6.0));
            let motion = Motion { velocity, yaw_rate: of(7, -5.0, 5.0) };
            let start = State { position: Vector2::new(0.0, 0.0), heading: of(8, -3.0, 3.0), motion };
            let ground = Ground { friction: 0.7, zones: &[], grade: Vector2::new(0.0, 0.0) };
            let control = Control { longest_step: LONGEST_BETWEEN, ..Control::default() };
            let mut path: Vec<Sample> = Vec::new();
            let record = |sample: &Sample| path.push(*sample);
            to_rest(&chassis, Steer::Held(0.0), &ground, &start, &control, record).unwrap();
            for wheel in [None, Some(MarkedWheel::FrontLeft), Some(MarkedWheel::RearRight)] {
                let near = path[usize::try_from(bits(9, number) % path.len() as u64).unwrap()].state.position;
                let position = near + Vector2::new(of(10, -3.0, 3.0), of(11, -3.0, 3.0));
                let found = pass(&path, &chassis, &PointData { position, heading: None, wheel });
                let of_wheel = wheel.map_or([0.0; 2], |wheel| {
                    let wheel = &chassis.wheels()[wheel as usize];
                    [wheel.forward, wheel.left]
                });
                let mut least = f64::INFINITY;
                for pair in path.windows(2) {
                    let steps = 20_000 / path.len() + 1;
                    for step in 0..=steps {
                        let share = step as f64 / steps as f64;
                        let time = pair[0].time + (pair[1].time - pair[0].time) * share;
                        let state = pair[0].between(&pair[1], time);
                        let ((sin, cos), [forward, left]) = (real::Real::sin_cos(state.heading), of_wheel);
                        let arm = Vector2::new(forward * cos - left * sin, forward * sin + left * cos);
                        least = least.min((state.position + arm - position).norm());
                    }
                }
                // Positions 0.02 s apart, between which the path is taken as straight.
                assert!((found.miss - least).abs() < 0.02, "{number} {wheel:?} {found:?} {least}");
            }
        }
    }
}
