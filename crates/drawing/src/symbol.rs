//! The symbols of points.

use kurbo::{Point, Rect, Vec2};

use crate::canvas::Canvas;
use crate::pens::{BLUE, GREEN, PURPLE, Pen, VERMILION};
use crate::vector::polygon;

/// (px) radius of a circle, and half the size of any symbol with its edge.
const RADIUS: f64 = 5.0;
const HALF: f64 = 7.0;

/// A filled or hollow shape in its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its shape.
    pub marker: Marker,
    /// Whether it is filled.
    pub is_filled: bool,
}

/// Shapes and colours that remain distinct in grey and for people with any kind of colour vision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// Blue.
    Circle,
    /// Vermilion.
    Square,
    /// Green.
    Triangle,
    /// Purple.
    Diamond,
}

impl Marker {
    /// All markers.
    pub const ALL: [Self; 4] = [Self::Circle, Self::Square, Self::Triangle, Self::Diamond];

    fn colour(self) -> &'static str {
        match self {
            Self::Circle => BLUE,
            Self::Square => VERMILION,
            Self::Triangle => GREEN,
            Self::Diamond => PURPLE,
        }
    }

    /// (px) corners around the middle; a circle has none.
    fn corners(self) -> &'static [(f64, f64)] {
        match self {
            Self::Circle => &[],
            Self::Square => &[(-4.5, -4.5), (4.5, -4.5), (4.5, 4.5), (-4.5, 4.5)],
            Self::Triangle => &[(0.0, -6.5), (6.0, 4.5), (-6.0, 4.5)],
            Self::Diamond => &[(0.0, -6.5), (6.5, 0.0), (0.0, 6.5), (-6.5, 0.0)],
        }
    }
}

impl Symbol {
    /// Draws it at a point, which no label covers.
    pub(crate) fn draw(self, canvas: &mut Canvas, id: &str, at: Point) {
        let pen = Pen { colour: self.marker.colour(), width: 1.8, dashes: "" };
        let fill = if self.is_filled { pen.colour } else { "none" };
        let path = polygon(self.marker.corners().iter().map(|&corner| at + Vec2::from(corner)));
        if path.is_empty() {
            canvas.dot(id, at, RADIUS, Some(pen), fill);
        } else {
            canvas.path(id, &path, Some(pen), fill);
        }
        canvas.labels.protect(Rect::from_center_size(at, (2.0 * HALF, 2.0 * HALF)));
    }
}
