//! Vectors of the scene and of the page.

use kurbo::{BezPath, Point, Vec2};

pub(crate) fn vec2([x, y]: [f64; 2]) -> Vec2 {
    Vec2::new(x, y)
}

/// From the scene (m, y upwards) to the page (px, y downwards), without the translation.
pub(crate) fn flipped(v: Vec2) -> Vec2 {
    Vec2::new(v.x, -v.y)
}

pub(crate) fn unit(v: Vec2) -> Vec2 {
    let length = v.hypot();
    if length > 0.0 { v / length } else { Vec2::new(1.0, 0.0) }
}

/// The closed path through the corners.
pub(crate) fn polygon(corners: impl IntoIterator<Item = Point>) -> BezPath {
    let mut path = polyline(corners);
    if !path.is_empty() {
        path.close_path();
    }
    path
}

/// The open path from the first point to the last.
pub(crate) fn polyline(points: impl IntoIterator<Item = Point>) -> BezPath {
    let mut path = BezPath::new();
    for (k, point) in points.into_iter().enumerate() {
        if k == 0 { path.move_to(point) } else { path.line_to(point) }
    }
    path
}
