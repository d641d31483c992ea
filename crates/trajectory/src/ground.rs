//! The ground under the wheels.

use pim_core::{InvalidInput, Vector2};
use real::{Real, elementary};

use pim_core::check;

/// (–) greatest friction of a ground.
pub const GREATEST_FRICTION: f64 = 2.0;

/// (–) greatest rise per length of a ground, up or down: 45°.
pub const GREATEST_GRADE: f64 = 1.0;

/// A plane with friction, which may differ from zone to zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground<'a, T = f64> {
    /// (–) μ of tyres on it, outside the zones.
    pub friction: T,
    /// The zones of different friction. If zones overlap, the later one counts.
    pub zones: &'a [FrictionZone<'a, T>],
    /// (–) rise per horizontal length along x and along y. All distances are measured along the plane.
    pub grade: Vector2<T>,
}

/// A part of the ground with its own friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionZone<'a, T = f64> {
    /// Its region.
    pub region: Region<'a>,
    /// (–) μ of tyres on it.
    pub friction: T,
}

/// A part of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region<'a> {
    /// Everything on one side of a straight line.
    HalfPlane {
        /// (m) a point of the line.
        point: Vector2<f64>,
        /// (–) unit vector at right angles to the line, into the region.
        into: Vector2<f64>,
    },
    /// The inside of the polygon with these corners (m), in either direction.
    Polygon(&'a [Vector2<f64>]),
}

impl<T: Real> Ground<'_, T> {
    /// Level ground of uniform friction.
    #[must_use]
    pub fn level(friction: T) -> Self {
        Self { friction, zones: &[], grade: Vector2::new(T::ZERO, T::ZERO) }
    }

    /// Checks that a ground can have every number.
    ///
    /// # Errors
    /// If a friction is not above 0 and at most [`GREATEST_FRICTION`], a grade is steeper than
    /// [`GREATEST_GRADE`], a position is not finite, or a polygon has fewer than three corners.
    pub fn check(&self) -> Result<(), InvalidInput> {
        friction(self.friction)?;
        check::within("grade along x", self.grade.x.value(), -GREATEST_GRADE, GREATEST_GRADE)?;
        check::within("grade along y", self.grade.y.value(), -GREATEST_GRADE, GREATEST_GRADE)?;
        for zone in self.zones {
            friction(zone.friction)?;
            zone.region.check()?;
        }
        Ok(())
    }

    /// The number of the zone at a point, counted from 1; 0 is outside all zones.
    pub(crate) fn zone_at(&self, point: [f64; 2]) -> usize {
        self.zones.iter().rposition(|zone| zone.region.contains(point)).map_or(0, |place| place + 1)
    }

    /// (–) μ in the zone of that number.
    pub(crate) fn friction_in(&self, zone: usize) -> T {
        zone.checked_sub(1)
            .and_then(|place| self.zones.get(place))
            .map_or(self.friction, |zone| zone.friction)
    }
}

/// (–) tolerance of the length of a unit vector.
const UNIT: f64 = 1e-9;

/// Refuses a friction that no ground can have.
fn friction<T: Real>(friction: T) -> Result<(), InvalidInput> {
    check::positive("friction of the ground", friction.value())?;
    check::within("friction of the ground", friction.value(), 0.0, GREATEST_FRICTION)
}

/// A straight border between regions, as a line with a unit normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    point: [f64; 2],
    normal: [f64; 2],
}

impl Edge {
    /// (m) distance of a point from the line, positive on the side of its normal.
    pub(crate) fn distance<T: Real>(&self, [x, y]: [T; 2]) -> T {
        (x - self.point[0]) * self.normal[0] + (y - self.point[1]) * self.normal[1]
    }

    /// (m/s) speed of a point with this velocity along the normal.
    pub(crate) fn rate<T: Real>(&self, [vx, vy]: [T; 2]) -> T {
        vx * self.normal[0] + vy * self.normal[1]
    }
}

/// What is certain about a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Passage {
    /// It meets no border.
    Clear,
    /// It crosses each border at most once.
    Once,
    Unknown,
}

impl Region<'_> {
    /// One side of a straight line through a point (m); the direction `into` (rad) is at right angles to it.
    #[must_use]
    pub fn half_plane(point: Vector2<f64>, into: f64) -> Self {
        let (sin, cos) = elementary::sin_cos(into);
        Self::HalfPlane { point, into: Vector2::new(cos, sin) }
    }

    fn check(&self) -> Result<(), InvalidInput> {
        match *self {
            Self::HalfPlane { point, into } => {
                corner(point)?;
                let length = elementary::sqrt(into.x * into.x + into.y * into.y);
                check::within("length of the unit vector into a zone", length, 1.0 - UNIT, 1.0 + UNIT)
            }
            Self::Polygon(corners) => {
                #[expect(clippy::cast_precision_loss, reason = "nobody draws 2⁵³ corners")]
                check::at_least("number of corners of a zone", corners.len() as f64, 3.0)?;
                corners.iter().copied().try_for_each(corner)
            }
        }
    }

    /// Whether a point lies in the region.
    pub(crate) fn contains(&self, [x, y]: [f64; 2]) -> bool {
        match *self {
            Self::HalfPlane { point, into } => (x - point.x) * into.x + (y - point.y) * into.y > 0.0,
            // A ray from the point along +x crosses the border an odd number of times.
            Self::Polygon(corners) => sides(corners).fold(false, |inside, [from, to]| {
                let crosses = (from.y > y) != (to.y > y)
                    && x < from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y);
                inside != crosses
            }),
        }
    }

    /// What is certain about a smooth path from one point to another, which leaves the straight line between
    /// them by at most `bow` (m). It may start on the border.
    pub(crate) fn passage(&self, from: [f64; 2], to: [f64; 2], bow: f64) -> Passage {
        match *self {
            Self::HalfPlane { point, into } => {
                let edge = Edge { point: [point.x, point.y], normal: [into.x, into.y] };
                let ends = [edge.distance(from), edge.distance(to)];
                match () {
                    () if keeps_side(ends, bow) => Passage::Clear,
                    () if is_monotone(ends, bow) => Passage::Once,
                    () => Passage::Unknown,
                }
            }
            Self::Polygon(corners) => {
                let is_clear = sides(corners).all(|[a, b]| is_apart([from, to], [a.into(), b.into()], bow));
                if is_clear { Passage::Clear } else { Passage::Unknown }
            }
        }
    }

    /// (m) distance of a point from the border.
    pub(crate) fn distance_to_border(&self, point: [f64; 2]) -> f64 {
        self.nearest(point).map_or(f64::INFINITY, |(distance, _)| distance)
    }

    /// The edge nearest to a point.
    pub(crate) fn nearest_edge(&self, point: [f64; 2]) -> Option<Edge> {
        self.nearest(point).map(|(_, edge)| edge)
    }

    /// The edge nearest to a point, with its distance (m).
    fn nearest(&self, [x, y]: [f64; 2]) -> Option<(f64, Edge)> {
        match *self {
            Self::HalfPlane { point, into } => {
                let edge = Edge { point: [point.x, point.y], normal: [into.x, into.y] };
                Some((edge.distance([x, y]).abs(), edge))
            }
            Self::Polygon(corners) => {
                let mut nearest = None;
                let mut least = f64::INFINITY;
                for [from, to] in sides(corners) {
                    let side = to - from;
                    let length_squared = side.x * side.x + side.y * side.y;
                    if length_squared == 0.0 {
                        continue;
                    }
                    let along = ((x - from.x) * side.x + (y - from.y) * side.y) / length_squared;
                    let along = along.clamp(0.0, 1.0);
                    let (dx, dy) = (x - from.x - along * side.x, y - from.y - along * side.y);
                    let distance = dx * dx + dy * dy;
                    if distance < least {
                        least = distance;
                        let length = elementary::sqrt(length_squared);
                        let normal = [-side.y / length, side.x / length];
                        nearest = Some(Edge { point: [from.x, from.y], normal });
                    }
                }
                nearest.map(|edge| (elementary::sqrt(least), edge))
            }
        }
    }
}

/// (m) a point this far from a border may be on either side of it: rounding decides.
pub(crate) const ON_BORDER: f64 = 1e-9;

/// Whether a path whose ends lie so far (m) from a line stays on one side of it, if it leaves the straight
/// line between its ends by at most `bow` (m) and has no kink. It may start on the line.
fn keeps_side([from, to]: [f64; 2], bow: f64) -> bool {
    let (from, to) = (from * 1.0_f64.copysign(to), to.abs());
    // d(t) ≥ (1 − t) d₀ + t d₁ − 4 t (1 − t) b, which is positive throughout if both ends are above b. It is
    // at least (1 − t) d₀ + t (d₁ − 4 b).
    (from > bow && to > bow) || (from >= -ON_BORDER && to > 4.0 * bow)
}

/// Whether a path whose ends lie so far (m) from a line comes ever nearer to it, or goes ever farther: its
/// rate differs from the mean one by at most four times its `bow`.
fn is_monotone([from, to]: [f64; 2], bow: f64) -> bool {
    (to - from).abs() > 4.0 * bow
}

/// Whether a path from one point to another is shown to keep clear of a side of a polygon: it keeps to one
/// side of its line, or passes nowhere alongside it, or the whole side lies beyond the path.
fn is_apart([from, to]: [[f64; 2]; 2], [start, end]: [[f64; 2]; 2], bow: f64) -> bool {
    // Most sides are far away, along an axis of the scene.
    let is_beside = |i: usize| {
        let (low, high) = (start[i].min(end[i]) - bow, start[i].max(end[i]) + bow);
        (from[i] < low && to[i] < low) || (from[i] > high && to[i] > high)
    };
    if is_beside(0) || is_beside(1) {
        return true;
    }
    let along = [end[0] - start[0], end[1] - start[1]];
    let length = elementary::sqrt(along[0] * along[0] + along[1] * along[1]);
    if length == 0.0 {
        return true;
    }
    let along = along.map(|part| part / length);
    let ahead = |[x, y]: [f64; 2]| (x - start[0]) * along[0] + (y - start[1]) * along[1];
    let aside = |[x, y]: [f64; 2]| (y - start[1]) * along[0] - (x - start[0]) * along[1];
    let places = [ahead(from), ahead(to)];
    if keeps_side([aside(from), aside(to)], bow)
        || places.iter().all(|place| *place < -bow)
        || places.iter().all(|place| *place > length + bow)
    {
        return true;
    }
    let way = [to[0] - from[0], to[1] - from[1]];
    let gap = bow * elementary::sqrt(way[0] * way[0] + way[1] * way[1]);
    let across = |[x, y]: [f64; 2]| way[0] * (y - from[1]) - way[1] * (x - from[0]);
    let (one, other) = (across(start), across(end));
    (one > gap && other > gap) || (one < -gap && other < -gap)
}

fn corner(point: Vector2<f64>) -> Result<(), InvalidInput> {
    check::finite("corner of a zone along x", point.x)?;
    check::finite("corner of a zone along y", point.y)
}

/// The sides of a polygon, including the one from the last corner to the first.
fn sides(corners: &[Vector2<f64>]) -> impl Iterator<Item = [Vector2<f64>; 2]> {
    let before = corners.last().into_iter().chain(corners);
    before.zip(corners).map(|(&from, &to)| [from, to])
}
