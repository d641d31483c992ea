//! Vectors of the scene and of the page.

use kurbo::Vec2;

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
