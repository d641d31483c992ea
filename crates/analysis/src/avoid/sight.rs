//! From when on the driver could see the other party.

use inputs::{AvoidForm, BrakingForm, Obstacle, PathForm, Place, PlaceForm, SightForm, SpeedForm};
use pim_core::Vector2;
use real::Real;
use time_distance::{first_sight, free_since, sees};

use super::driven::{Approach, Driven};
use super::posing::{Since, SoughtSpeeds, Unposed};
use super::scene::{AvoidScene, Sight, View, given_demand, response};

/// (s) how far before the impact the sight is examined.
pub const SIGHT_LOOK_BACK: f64 = 10.0;
/// Steps of the examination: one each 0.05 s.
const STEPS: u32 = 200;
/// (s) before the view is free, something hides the other party.
const JUST_BEFORE: f64 = 1e-6;

/// How the other party was hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hiding {
    /// The obstacle that hid it last, by its index.
    pub by: Option<usize>,
    /// Whether it came out of that obstacle.
    pub is_inside: bool,
    /// (s) before the impact, the first moment in the time examined when it was in sight, before it was
    /// hidden.
    pub seen_earlier: Option<f64>,
}

/// The outlines of obstacles (m), each with its corners in their order.
pub(crate) type Outlines<'a> = &'a [&'a [Vector2<f64>]];

pub(crate) fn corners(obstacle: &Obstacle) -> Vec<Vector2<f64>> {
    obstacle.polygon.iter().map(at).collect()
}

fn at(place: &Place) -> Vector2<f64> {
    Vector2::new(place.x.si(), place.y.si())
}

/// A path to a place at the impact.
#[derive(Clone, Debug)]
struct Way {
    /// (m) its points, backwards from the impact.
    points: Vec<Vector2<f64>>,
    /// The direction of travel before the last of them, a unit vector.
    along: Vector2<f64>,
}

impl Way {
    fn of(end: &PlaceForm, path: &PathForm) -> Self {
        let end = end.place().map_or(Vector2::new(0.0, 0.0), at);
        match path {
            PathForm::Straight(heading) => {
                let (sin, cos) = Real::sin_cos(heading.si());
                Self { points: vec![end], along: Vector2::new(cos, sin) }
            }
            PathForm::Along(given) => {
                let mut way = Self { points: vec![end], along: Vector2::new(1.0, 0.0) };
                for [x, y] in given.iter().rev() {
                    way.add(Vector2::new(*x, *y));
                }
                way
            }
        }
    }

    /// Adds a point before the last one of the path. One in the same place is ignored.
    fn add(&mut self, point: Vector2<f64>) {
        let Some(last) = self.points.last() else { return };
        let ahead = Vector2::new(last.x - point.x, last.y - point.y);
        let length = ahead.norm();
        if length > 0.0 {
            self.along = Vector2::new(ahead.x / length, ahead.y / length);
            self.points.push(point);
        }
    }

    /// (m) the place with a distance (m) to go.
    fn back(&self, mut distance: f64) -> Vector2<f64> {
        let between = |from: Vector2<f64>, to: Vector2<f64>, share: f64| {
            Vector2::new(from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share)
        };
        for pair in self.points.windows(2) {
            let [to, from] = [pair[0], pair[1]];
            let length = Vector2::new(to.x - from.x, to.y - from.y).norm();
            if distance < length {
                return between(to, from, distance / length);
            }
            distance -= length;
        }
        let first = self.points.last().copied().unwrap_or_default();
        Vector2::new(first.x - self.along.x * distance, first.y - self.along.y * distance)
    }
}

/// The paths of both to the impact.
#[derive(Clone, Debug)]
pub(crate) struct Ways {
    /// Those of the driver's eye and of the visible point.
    ways: [Way; 2],
    /// How the other party moves, with times and places that count from the impact.
    other: Driven,
    /// 1 forward, −1 if it backs.
    sign: f64,
}

impl Ways {
    /// With the speed of the other vehicle at the impact (m/s), if the rest of the case gives it. Its brakes
    /// build up as those of `[avoid]` do.
    pub(crate) fn of(sight: &SightForm, sought: Option<f64>, form: &AvoidForm) -> Result<Self, Unposed> {
        let speed = sight.other.speed_at_impact(sought).ok_or(Unposed::OtherUnknown)?;
        // The phases of a vehicle that backs describe that motion.
        let sign = if speed < 0.0 { -1.0 } else { 1.0 };
        let approach = Approach::of_other(&sight.other.braking, speed.abs(), &response(form)?)?;
        let (other, _, _) = Driven::new(approach, Since::Time(0.0))?;
        let ways = [Way::of(&sight.eye, &sight.path), Way::of(&sight.point, &sight.other_path)];
        Ok(Self { ways, other, sign })
    }

    /// (m) what the other party has to go at a time (s) before the impact; negative if it backs.
    fn of_other(&self, time: f64) -> f64 {
        -self.sign * self.other.at(-time).position
    }

    /// (m) the eye and the visible point, where the vehicle has `way` (m) and both have `time` (s) to go.
    pub(crate) fn before(&self, way: f64, time: f64) -> [Vector2<f64>; 2] {
        let [eye, point] = &self.ways;
        [eye.back(way), point.back(self.of_other(time))]
    }

    /// The same at a time (s) before the impact, on the actual run.
    pub(crate) fn of_scene(&self, scene: &AvoidScene, time: f64) -> [Vector2<f64>; 2] {
        self.before(way_before(scene, time), time)
    }

    /// The view on the actual run.
    pub(crate) fn view(&self, scene: &AvoidScene, obstacles: Outlines<'_>) -> Result<View, Unposed> {
        let positions = |since: f64| self.of_scene(scene, -since);
        let free = free_since(positions, obstacles, [-SIGHT_LOOK_BACK, 0.0], STEPS);
        let time = -free.ok_or(Unposed::HiddenAtImpact)?;
        if time >= SIGHT_LOOK_BACK {
            return Ok(View::NeverHidden);
        }
        Ok(View::Free(self.sight(way_before(scene, time), time)))
    }

    pub(crate) fn sight(&self, way: f64, time: f64) -> Sight {
        Sight { time, distance_subject: way, distance_other: self.of_other(time) }
    }

    /// When the view became free; the driver reacts from then on.
    pub(crate) fn demand(
        &self,
        form: &AvoidForm,
        sought: SoughtSpeeds,
        obstacles: Outlines<'_>,
    ) -> Result<Since, Unposed> {
        if let (BrakingForm::Unknown, SpeedForm::AtDemand(speed)) = (&form.braking, &form.speed) {
            // The driver brakes in reaction to it, so the place decides when the impact is.
            let farthest = speed.si() * SIGHT_LOOK_BACK;
            let here = AvoidScene::of_vehicle(form, sought, Since::Distance(0.0))?;
            let positions = |since: f64| self.before(-since, here.time_responded(-since, speed.si()));
            let free = free_since(positions, obstacles, [-farthest, 0.0], STEPS);
            let way = -free.ok_or(Unposed::HiddenAtImpact)?;
            return if way < farthest { Ok(Since::Distance(way)) } else { Err(Unposed::NeverHidden) };
        }
        let early = AvoidScene::of_vehicle(form, sought, Since::Time(SIGHT_LOOK_BACK))?;
        let sight = self.view(&early, obstacles)?.sight().ok_or(Unposed::NeverHidden)?;
        Ok(Since::Time(sight.time))
    }

    /// How the other party was hidden before the view was free; an error with the obstacle (by its index) in
    /// which the driver's eye would have been.
    pub(crate) fn hiding(
        &self,
        scene: &AvoidScene,
        sight: &Sight,
        obstacles: Outlines<'_>,
    ) -> Result<Hiding, usize> {
        let [eye, point] = self.of_scene(scene, sight.time + JUST_BEFORE);
        let is_within = |place: Vector2<f64>, outline: &[Vector2<f64>]| !sees(place, place, outline);
        if let Some(index) = obstacles.iter().position(|outline| is_within(eye, outline)) {
            return Err(index);
        }
        let by = obstacles.iter().position(|outline| !sees(eye, point, outline));
        let outline = by.and_then(|index| obstacles.get(index));
        let positions = |since: f64| self.of_scene(scene, -since);
        let looked_at = [-SIGHT_LOOK_BACK, -sight.time - JUST_BEFORE];
        Ok(Hiding {
            by,
            is_inside: outline.is_some_and(|outline| is_within(point, outline)),
            seen_earlier: first_sight(positions, obstacles, looked_at, STEPS).map(|since| -since),
        })
    }

    /// The obstacle on the place of the impact, or between the eye and the visible point there.
    pub(crate) fn hides_the_impact(&self, obstacles: Outlines<'_>) -> Option<usize> {
        let [eye, point] = self.before(0.0, 0.0);
        obstacles.iter().position(|outline| !sees(eye, point, outline))
    }
}

/// The scene of these numbers, with the unknown speeds.
pub(super) fn pose(
    form: &AvoidForm,
    sought: SoughtSpeeds,
    obstacles: Outlines<'_>,
) -> Result<AvoidScene, Unposed> {
    let ways = form.sight.as_ref().map(|sight| Ways::of(sight, sought.other, form)).transpose()?;
    let (since, of_sight) = match (given_demand(form)?, &ways) {
        (Some(since), _) => (since, None),
        (None, None) => return Err(Unposed::NeverHidden),
        (None, Some(ways)) => (ways.demand(form, sought, obstacles)?, Some(ways)),
    };
    let scene = AvoidScene::since(form, sought, since)?;
    let view = match (of_sight, &ways) {
        (Some(ways), _) => View::Free(ways.sight(scene.distance, scene.time)),
        (None, Some(ways)) => ways.view(&scene, obstacles)?,
        (None, None) => View::Open,
    };
    Ok(AvoidScene { view, ..scene })
}

/// (m) what the vehicle has to go at a time (s) before the impact, on the actual run.
fn way_before(scene: &AvoidScene, time: f64) -> f64 {
    let since = scene.time - time;
    // Only phases and recorders show what the vehicle did before the demand.
    let is_known = since >= 0.0 || scene.driven.is_some();
    scene.distance - if is_known { scene.course().position(since) } else { scene.speed * since }
}
