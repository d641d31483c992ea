//! Positions of the parts of a plan view, for a program that lets its user move them.

use kurbo::{BezPath, PathEl, Point, Rect};

use crate::body::SceneBody;
use crate::footprint::CrushProfile;
use crate::plan::{Pose, View};

/// (m) maximum distance between the sides of an outline and its arcs.
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
    /// The view that shows this part in an area of the page (px); `None` if the part is empty or not finite.
    pub(crate) fn view(self, room: Rect) -> Option<View> {
        let Self { left, bottom, right, top } = self;
        let (width, height) = (right - left, top - bottom);
        let is_usable =
            [left, bottom, right, top].into_iter().all(f64::is_finite) && width > 0.0 && height > 0.0;
        let scale = (room.width() / width).min(room.height() / height);
        let middle = Point::new(0.5 * (left + right) * scale, -0.5 * (bottom + top) * scale);
        is_usable.then(|| View { origin: (room.center() - middle).to_point(), scale })
    }

    /// The part of the scene in an area of the page (px).
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

/// The contents of a plan view, and their positions.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanView {
    /// The part of the scene that it shows.
    pub viewport: Viewport,
    /// (px) the origin of the scene on the page, whose y points downwards.
    pub origin: [f64; 2],
    /// (px/m)
    pub scale: f64,
    /// (m) the contact point, where the impulse acts.
    pub contact: Option<[f64; 2]>,
    /// Normal of the crush plane, from vehicle 2 to vehicle 1; a unit vector.
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
    /// (m) from its centre of gravity to its front, if its outline is known.
    pub cg_to_front: Option<f64>,
    /// (m) the corners of its drawn shape; empty if its shape is unknown.
    pub outline: Vec<[f64; 2]>,
    /// The stations of its measured crush.
    pub stations: Vec<PlanStation>,
    /// (m) its measured rest position, and its heading there.
    pub rest: Option<([f64; 2], [f64; 2])>,
    /// (m) measured points of its path.
    pub points: Vec<[f64; 2]>,
}

/// A station of a crush profile, in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanStation {
    /// (m) on the undamaged face.
    pub face: [f64; 2],
    /// (m) on the crushed face.
    pub crushed: [f64; 2],
}

impl PlanBody {
    /// A body in its pose; `other` is the outline (m) of one whose shape depends on the contact.
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
        let station = |crush: &CrushProfile| -> Vec<PlanStation> {
            let stations = crush.face.iter().zip(&crush.crushed);
            stations.map(|(&face, &crushed)| PlanStation { face: at(face), crushed: at(crushed) }).collect()
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

/// (m) the corners of a closed path, with its arcs as short lines.
pub(crate) fn corners(path: &BezPath) -> Vec<[f64; 2]> {
    let mut corners = Vec::new();
    kurbo::flatten(path.iter(), TOLERANCE, |element| match element {
        PathEl::MoveTo(at) | PathEl::LineTo(at) => corners.push(pair(at)),
        _ => {}
    });
    corners
}
