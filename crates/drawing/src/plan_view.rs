//! Where the parts of a plan view are, for a program that lets somebody move them.

use kurbo::{BezPath, PathEl, Point, Rect};

use crate::body::SceneBody;
use crate::footprint::CrushProfile;
use crate::plan::{Pose, View};

/// (m) how far the sides of an outline may lie from its arcs.
const TOLERANCE: f64 = 0.002;

/// A part of a scene: x to the right, y upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// (m)
    pub left: f64,
    /// (m)
    pub bottom: f64,
    /// (m)
    pub right: f64,
    /// (m)
    pub top: f64,
}

impl Viewport {
    /// Where the room of a page (px) shows this part; `None` of a part that is empty or not finite.
    pub(crate) fn view(self, room: Rect) -> Option<View> {
        let Self { left, bottom, right, top } = self;
        let (width, height) = (right - left, top - bottom);
        let is_usable =
            [left, bottom, right, top].into_iter().all(f64::is_finite) && width > 0.0 && height > 0.0;
        let scale = (room.width() / width).min(room.height() / height);
        let middle = Point::new(0.5 * (left + right) * scale, -0.5 * (bottom + top) * scale);
        is_usable.then(|| View { origin: (room.center() - middle).to_point(), scale })
    }

    /// What of the scene is in a room of the page (px).
    pub(crate) fn of(view: View, room: Rect) -> Self {
        let View { origin, scale } = view;
        Self {
            left: (room.x0 - origin.x) / scale,
            bottom: (origin.y - room.y1) / scale,
            right: (room.x1 - origin.x) / scale,
            top: (origin.y - room.y0) / scale,
        }
    }
}

/// What a plan view shows, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanView {
    /// What of the scene it shows.
    pub viewport: Viewport,
    /// (px) the origin of the scene on the page, whose y points downwards.
    pub origin: [f64; 2],
    /// (px/m)
    pub scale: f64,
    /// (m) where the impulse acts.
    pub contact: Option<[f64; 2]>,
    /// Of the crush plane, from vehicle 2 to vehicle 1; a unit vector.
    pub normal: Option<[f64; 2]>,
    /// Vehicles 1 and 2 at the impact, as far as they are known.
    pub bodies: [Option<PlanBody>; 2],
}

/// A vehicle of a plan view, in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanBody {
    /// (m) its centre of gravity.
    pub cg: [f64; 2],
    /// Its heading; a unit vector.
    pub forward: [f64; 2],
    /// (m) from its centre of gravity to its front, where its outline is known.
    pub cg_to_front: Option<f64>,
    /// (m) the corners of what is drawn of it; empty where its shape is not known.
    pub outline: Vec<[f64; 2]>,
    /// Where its crush was measured.
    pub stations: Vec<PlanStation>,
    /// (m) where it was found at rest, and its heading there.
    pub rest: Option<([f64; 2], [f64; 2])>,
    /// (m) measured points of its path.
    pub points: Vec<[f64; 2]>,
}

/// A station of a crush profile, in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanStation {
    /// (m) on the undamaged face.
    pub face: [f64; 2],
    /// (m) as deep as the crush.
    pub crushed: [f64; 2],
    /// Out of the vehicle; a unit vector.
    pub outward: [f64; 2],
}

impl PlanBody {
    /// A body at its place; `other` is the outline (m) of one whose shape hangs on the contact.
    pub(crate) fn of(body: &SceneBody, pose: Pose, other: Option<BezPath>) -> Self {
        let there = pose.in_scene();
        let (outline, crush, cg_to_front) = match body {
            SceneBody::Outline { footprint, crush } => {
                let outline = there * footprint.left_by(crush.as_ref());
                (outline, crush.as_ref(), Some(footprint.cg_to_front))
            }
            _ => (other.unwrap_or_default(), None, None),
        };
        let at = |[x, y]: [f64; 2]| pair(there * Point::new(x, y));
        let turned = |[x, y]: [f64; 2]| {
            let [forward, left] = [pose.forward, kurbo::Vec2::new(-pose.forward.y, pose.forward.x)];
            let vector = forward * x + left * y;
            [vector.x, vector.y]
        };
        let station = |crush: &CrushProfile| -> Vec<PlanStation> {
            let stations = crush.face.iter().zip(&crush.crushed);
            let outward = turned(crush.outward);
            stations
                .map(|(&face, &crushed)| PlanStation { face: at(face), crushed: at(crushed), outward })
                .collect()
        };
        Self {
            cg: [pose.cg.x, pose.cg.y],
            forward: [pose.forward.x, pose.forward.y],
            cg_to_front,
            outline: corners(&outline),
            stations: crush.map(station).unwrap_or_default(),
            rest: None,
            points: Vec::new(),
        }
    }
}

fn pair(at: Point) -> [f64; 2] {
    [at.x, at.y]
}

/// (m) the corners of a closed path, its arcs as short lines.
pub(crate) fn corners(path: &BezPath) -> Vec<[f64; 2]> {
    let mut corners = Vec::new();
    kurbo::flatten(path.iter(), TOLERANCE, |element| match element {
        PathEl::MoveTo(at) | PathEl::LineTo(at) => corners.push(pair(at)),
        _ => {}
    });
    corners
}
