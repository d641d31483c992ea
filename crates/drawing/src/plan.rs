//! Shared by all plan views: the mapping from the scene to the page, and the places of fixed objects.

use kurbo::{Affine, BezPath, Circle, ParamCurve as _, Point, Rect, Shape as _, Vec2};

use crate::body::SceneBody;
use crate::canvas::{Canvas, Head};
use crate::font::{Anchor, SMALL};
use crate::footprint::{BodyShape, placed};
use crate::legend::Sample;
use crate::pens::{FILL, GREY, OUTLINE, PALE, Pen, THIN};
use crate::vector::{flipped, polygon, unit, vec2};

/// (m) how far the wall drawn for a fixed object of unknown extent extends beyond the vehicle at it, its
/// thickness, and its minimum length.
const WALL: f64 = 0.7;
const WALL_DEPTH: f64 = 0.5;
const SHORTEST_WALL: f64 = 0.2;
/// (m) parts of a vehicle farther than this beyond the crush plane have no wall in front of them.
const BEHIND: f64 = 0.1;
/// (px/m) the smallest scale that is tried.
const SMALLEST: f64 = 1e-3;

/// The pose of a vehicle.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    /// (m)
    pub(crate) cg: Vec2,
    /// A unit vector.
    pub(crate) forward: Vec2,
}

impl Pose {
    pub(crate) fn new(cg: [f64; 2], forward: [f64; 2]) -> Self {
        Self { cg: vec2(cg), forward: unit(vec2(forward)) }
    }

    /// (m) transform from the vehicle's own axes to those of the scene.
    pub(crate) fn in_scene(self) -> Affine {
        let Self { cg, forward } = self;
        Affine::new([forward.x, forward.y, -forward.y, forward.x, cg.x, cg.y])
    }
}

impl SceneBody {
    /// (m) its outline in the scene, damaged if its crush is known.
    pub(crate) fn outline_in(&self, pose: Pose) -> Option<BezPath> {
        let Self::Outline { footprint, crush } = self else { return None };
        Some(pose.in_scene() * footprint.left_by(crush.as_ref()))
    }

    /// Its sample in the legend as body `i`, with the ends (m) of a wall if the place of the contact is
    /// known.
    pub(crate) fn sample(&self, ends: Option<[f64; 2]>, i: usize, canvas: &Canvas) -> Sample {
        match (self, ends) {
            (Self::Outline { footprint, .. }, _) if footprint.shape != BodyShape::Fixed => {
                Sample::Box(OUTLINE[i], FILL[i].to_owned())
            }
            (Self::Wall, Some(ends)) if !is_drawn(ends) => Sample::Nothing,
            (Self::Unknown, _) | (Self::Wall | Self::Pole { .. }, None) => Sample::Nothing,
            _ => Sample::Box(THIN, canvas.pattern("fixed")),
        }
    }

    /// The fixed object that is body `i`, on the page: a pole or a wall only if the contact is known, with
    /// the ends (m) of a wall there, and a wall only if it is long enough to be drawn.
    pub(crate) fn fixed_on(
        &self,
        view: View,
        pose: Pose,
        contact: Option<(Contact, [f64; 2])>,
        i: usize,
    ) -> Option<BezPath> {
        match (self, contact) {
            (Self::Outline { footprint, .. }, _) if footprint.shape == BodyShape::Fixed => {
                Some(view.place(pose) * footprint.outline())
            }
            (Self::Pole { diameter }, Some((contact, _))) => {
                let radius = 0.5 * diameter * view.scale;
                Some(Circle::new(view.at(contact.pole(*diameter, i)), radius).to_path(1e-2))
            }
            (Self::Wall, Some((contact, ends))) => {
                is_drawn(ends).then(|| polygon(contact.wall(ends, i).map(|corner| view.at(corner))))
            }
            _ => None,
        }
    }
}

/// The mapping from the scene to the page.
#[derive(Clone, Copy)]
pub(crate) struct View {
    /// (px) of the scene's origin.
    pub(crate) origin: Point,
    /// (px/m)
    pub(crate) scale: f64,
}

impl View {
    /// The largest scale up to `largest` (px/m) that fits the drawing into the room (px), centred in it.
    /// `bounds` gives its extent (px) around the scene's origin at a scale.
    pub(crate) fn fit(room: Rect, largest: f64, bounds: impl Fn(f64) -> Rect) -> Self {
        let fits = |scale: f64| {
            let bounds = bounds(scale);
            bounds.width() <= room.width() && bounds.height() <= room.height()
        };
        let (mut low, mut high) = (SMALLEST.min(largest), largest);
        if fits(high) {
            low = high;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if fits(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Self { origin: (room.center() - bounds(low).center()).to_point(), scale: low }
    }

    pub(crate) fn at(self, metres: Vec2) -> Point {
        self.origin + flipped(metres) * self.scale
    }

    /// Transform from a vehicle's own axes (m) to the page.
    pub(crate) fn place(self, pose: Pose) -> Affine {
        placed(pose.forward, self.at(pose.cg), self.scale)
    }
}

/// The contact of two bodies.
#[derive(Clone, Copy)]
pub(crate) struct Contact {
    /// (m) the contact point C.
    pub(crate) at: Vec2,
    /// Normal of the crush plane, from vehicle 2 to vehicle 1; a unit vector.
    pub(crate) normal: Vec2,
}

impl Contact {
    fn tangent(self) -> Vec2 {
        Vec2::new(-self.normal.y, self.normal.x)
    }

    /// (m) the corners of the wall drawn for body `i`, on the far side of the crush plane.
    pub(crate) fn wall(self, [low, high]: [f64; 2], i: usize) -> [Vec2; 4] {
        let t = self.tangent();
        let away = if i == 0 { self.normal } else { -self.normal };
        [t * high, t * high + away * WALL_DEPTH, t * low + away * WALL_DEPTH, t * low]
            .map(|corner| self.at + corner)
    }

    /// (m) the centre of the pole that is body `i`: C lies on its surface.
    pub(crate) fn pole(self, diameter: f64, i: usize) -> Vec2 {
        self.at + self.normal * (if i == 0 { 0.5 } else { -0.5 } * diameter)
    }

    /// (m) how far a wall extends along t from C: beyond all of the other vehicle, except for its parts
    /// beyond the crush plane, where there cannot be a wall, unless C itself is there. `outlines` are those
    /// of the bodies in the scene (m), if they have one.
    pub(crate) fn wall_ends(self, outlines: [Option<BezPath>; 2]) -> [f64; 2] {
        let (n, t) = (self.normal, self.tangent());
        let (mut ends, mut blocked) = ([-WALL, WALL], Vec::new());
        for (outline, outward) in outlines.into_iter().zip([-1.0, 1.0]) {
            for edge in outline.iter().flat_map(BezPath::segments) {
                let [from, to] = [edge.start(), edge.end()].map(|at| at.to_vec2() - self.at);
                let along = [from.dot(t).min(to.dot(t)), from.dot(t).max(to.dot(t))];
                ends = [ends[0].min(along[0] - WALL), ends[1].max(along[1] + WALL)];
                if [from, to].iter().all(|at| at.dot(n) * outward > BEHIND) {
                    blocked.push(along);
                }
            }
        }
        blocked.sort_by(|one, other| one[0].total_cmp(&other[0]));
        // The gap nearest to C; of several equally near, the longest.
        let (mut low, mut gaps) = (ends[0], Vec::new());
        for [from, to] in blocked.into_iter().chain([[ends[1]; 2]]) {
            if from > low {
                gaps.push([low, from]);
            }
            low = low.max(to);
        }
        let far = |[low, high]: [f64; 2]| low.max(-high).max(0.0);
        let length = |[low, high]: [f64; 2]| high - low;
        let best = |one: &[f64; 2], other: &[f64; 2]| {
            far(*one).total_cmp(&far(*other)).then(length(*other).total_cmp(&length(*one)))
        };
        // C is on the wall: a body that is drawn undamaged reaches into it there.
        gaps.into_iter().min_by(best).filter(|gap| far(*gap) <= BEHIND).unwrap_or(ends)
    }

    /// (m) points as far out as a pole, or the corners of a wall; none for a body with its own shape.
    pub(crate) fn reach(self, body: &SceneBody, ends: impl FnOnce() -> [f64; 2], i: usize) -> Vec<Vec2> {
        match body {
            SceneBody::Pole { diameter } => {
                let centre = self.pole(*diameter, i);
                [1.0, -1.0].map(|side| centre + Vec2::new(side, side) * (diameter / 2.0)).to_vec()
            }
            SceneBody::Wall => self.wall(ends(), i).to_vec(),
            SceneBody::Outline { .. } | SceneBody::Unknown => Vec::new(),
        }
    }

    /// (m) the outline of a pole, or of a wall with these ends; `None` for a body with its own shape.
    pub(crate) fn outline(self, body: &SceneBody, ends: [f64; 2], i: usize) -> Option<BezPath> {
        match body {
            SceneBody::Pole { diameter } => {
                Some(Circle::new(self.pole(*diameter, i).to_point(), 0.5 * diameter).to_path(1e-3))
            }
            SceneBody::Wall => Some(polygon(self.wall(ends, i).map(Vec2::to_point))),
            SceneBody::Outline { .. } | SceneBody::Unknown => None,
        }
    }
}

/// Whether a wall with these ends (m along t) is long enough to be drawn.
pub(crate) fn is_drawn([low, high]: [f64; 2]) -> bool {
    high - low >= SHORTEST_WALL
}

/// The extent of some points; that of the origin if there are none.
pub(crate) fn extent(points: impl IntoIterator<Item = Point>) -> Rect {
    let mut points = points.into_iter();
    let first = points.next().unwrap_or_default();
    points.fold(Rect::from_points(first, first), |extent, point| extent.union_pt(point))
}

/// Draws a fixed object.
pub(crate) fn fixed(canvas: &mut Canvas, id: &str, area: &BezPath) {
    canvas.define_stripes("fixed", GREY, PALE, 45, 8.0);
    let fill = canvas.pattern("fixed");
    canvas.path(id, area, Some(THIN), &fill);
    // Letters are illegible on stripes.
    canvas.labels.keep_off(area, true);
}

/// Draws the axes of the scene in the lower right corner of an area.
pub(crate) fn axes_in_corner(canvas: &mut Canvas, area: Rect, is_z_down: bool) {
    let drop = if is_z_down { 64.0 } else { 12.0 };
    axes(canvas, Point::new(area.x1 - 62.0, area.y1 - drop), is_z_down);
}

/// Draws the axes of the scene, 40 px long.
pub(crate) fn axes(canvas: &mut Canvas, at: Point, is_z_down: bool) {
    let (end, dy) = if is_z_down { (40.0, 16.0) } else { (-40.0, -8.0) };
    for (name, end, dx, dy) in [("x", Vec2::new(40.0, 0.0), 8.0, 4.0), ("y", Vec2::new(0.0, end), -4.0, dy)] {
        let tip = at + end;
        canvas.arrow(&format!("scene-{name}"), at, tip, Pen { width: 1.4, ..THIN }, Head::Open);
        canvas.text(Point::new(tip.x + dx, tip.y + dy), name, SMALL, Anchor::Start, GREY);
    }
}
