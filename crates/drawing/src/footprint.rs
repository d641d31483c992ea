//! The outline of a vehicle.

use kurbo::{Affine, BezPath, Point, Rect, RoundedRect, Shape as _, Vec2};

/// A vehicle's body seen from above, in its own axes: x forward, y left of the CG.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// (m)
    pub length: f64,
    /// (m)
    pub width: f64,
    /// (m) from the CG to the front.
    pub cg_to_front: f64,
}

impl Footprint {
    fn bounds(&self) -> Rect {
        let Self { length, width, cg_to_front } = *self;
        Rect::new(cg_to_front - length, -width / 2.0, cg_to_front, width / 2.0)
    }

    /// The body with rounded corners.
    pub(crate) fn outline(&self) -> BezPath {
        let bounds = self.bounds();
        let radius = 0.12 * bounds.height();
        RoundedRect::from_rect(bounds, radius).to_path(1e-3)
    }

    /// The windscreen: what tells front from rear.
    pub(crate) fn windscreen(&self) -> BezPath {
        let Rect { x1: front, y0: right, y1: left, .. } = self.bounds();
        let length = self.length;
        let (ahead, behind) = (front - 0.26 * length, front - 0.36 * length);
        let mut path = BezPath::new();
        path.move_to((ahead, right * 0.78));
        path.quad_to((ahead + 0.04 * length, 0.0), (ahead, left * 0.78));
        path.line_to((behind, left * 0.66));
        path.quad_to((behind + 0.03 * length, 0.0), (behind, right * 0.66));
        path.close_path();
        path
    }

    pub(crate) fn corners(&self) -> [Point; 4] {
        let Rect { x0, y0, x1, y1 } = self.bounds();
        [Point::new(x0, y0), Point::new(x1, y0), Point::new(x1, y1), Point::new(x0, y1)]
    }

    /// The middle of the front.
    pub(crate) fn front(&self) -> Point {
        Point::new(self.cg_to_front, 0.0)
    }

    pub(crate) fn middle(&self) -> Point {
        self.bounds().center()
    }
}

/// From the axes of a vehicle whose forward axis is `forward` (a unit vector of the scene, y upwards) and
/// whose CG is at `cg` (px) to the page.
pub(crate) fn placed(forward: Vec2, cg: Point, scale: f64) -> Affine {
    let (c, s) = (forward.x * scale, forward.y * scale);
    // (x, y) ↦ CG + scale (x cos θ − y sin θ, −(x sin θ + y cos θ)): the page's y runs downwards.
    Affine::new([c, -s, -s, -c, cg.x, cg.y])
}
