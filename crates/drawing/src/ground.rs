//! Zones of the ground, clipped to the page.

use kurbo::{BezPath, Point, Rect, Vec2};

use crate::plan::View;
use crate::vector::{flipped, polygon, vec2};

/// A part of the ground with its own friction.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundZone {
    /// Its area.
    pub shape: GroundShape,
    /// Its label, such as its name and its friction.
    pub label: String,
}

/// The area of a zone.
#[derive(Clone, Debug, PartialEq)]
pub enum GroundShape {
    /// Everything to one side of a line.
    HalfPlane {
        /// (m) a point of the line.
        edge: [f64; 2],
        /// A vector across the line, into the zone; of any length but zero.
        into: [f64; 2],
    },
    /// The inside of a polygon with these corners (m), in order.
    Polygon(Vec<[f64; 2]>),
}

impl GroundShape {
    /// The part of it that is visible on the page, if any.
    pub(crate) fn on_page(&self, view: View, page: Rect) -> Option<BezPath> {
        let corners = |page: Rect| {
            [(page.x0, page.y0), (page.x1, page.y0), (page.x1, page.y1), (page.x0, page.y1)].map(Point::from)
        };
        let seen = match self {
            Self::HalfPlane { edge, into } => {
                cut(corners(page).to_vec(), view.at(vec2(*edge)), flipped(vec2(*into)))
            }
            Self::Polygon(polygon) => {
                let whole = polygon.iter().map(|&corner| view.at(vec2(corner))).collect();
                let [first, _, last, _] = corners(page);
                // Two sides of the page pass through the one corner, and two through the opposite one.
                let sides = [(first, 1.0, 0.0), (first, 0.0, 1.0), (last, -1.0, 0.0), (last, 0.0, -1.0)];
                sides.into_iter().fold(whole, |left, (at, x, y)| cut(left, at, Vec2::new(x, y)))
            }
        };
        (seen.len() > 2).then(|| polygon(seen))
    }
}

/// Clips a polygon to the side of a line to which `into` points (I. Sutherland and G. Hodgman, *Reentrant
/// polygon clipping*, 1974).
fn cut(polygon: Vec<Point>, edge: Point, into: Vec2) -> Vec<Point> {
    let depth = |point: Point| (point - edge).dot(into);
    let mut left = Vec::new();
    let after = polygon.iter().cycle().skip(1);
    for (&from, &to) in polygon.iter().zip(after) {
        let depths = [from, to].map(depth);
        if depths[0] >= 0.0 {
            left.push(from);
        }
        if (depths[0] < 0.0) != (depths[1] < 0.0) {
            left.push(from.lerp(to, depths[0] / (depths[0] - depths[1])));
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use kurbo::{Point, Rect, Shape as _};

    use super::GroundShape;
    use crate::plan::View;

    /// 200 m × 100 m around the origin of the scene, at 1 px/m.
    const PAGE: Rect = Rect::new(0.0, 0.0, 200.0, 100.0);
    const VIEW: View = View { origin: Point::new(100.0, 50.0), scale: 1.0 };

    fn bounds(shape: &GroundShape) -> Option<[f64; 5]> {
        shape.on_page(VIEW, PAGE).map(|path| {
            let Rect { x0, y0, x1, y1 } = path.bounding_box();
            [x0, y0, x1, y1, path.area().abs()]
        })
    }

    #[test]
    fn a_half_plane_reaches_to_the_edge_of_the_page() {
        let half = |edge, into| bounds(&GroundShape::HalfPlane { edge, into });
        // The side to the left of x, which is up on the page, from y = 20 m.
        assert_eq!(half([7.0, 20.0], [0.0, 3.0]), Some([0.0, 0.0, 200.0, 30.0, 6000.0]));
        assert_eq!(half([7.0, 20.0], [0.0, -3.0]), Some([0.0, 30.0, 200.0, 100.0, 14_000.0]));
        assert_eq!(half([60.0, 0.0], [1.0, 0.0]), Some([160.0, 0.0, 200.0, 100.0, 4000.0]));
        // The line y = x from the corner at (−50, −50) to that at (50, 50), and the side to its left.
        assert_eq!(half([0.0, 0.0], [-1.0, 1.0]).map(|b| b[4]), Some(10_000.0));
        assert_eq!(half([0.0, 60.0], [0.0, 1.0]), None);
        assert_eq!(half([0.0, 60.0], [0.0, -1.0]).map(|b| b[4]), Some(20_000.0));
    }

    #[test]
    fn a_polygon_is_cut_at_the_edges_of_the_page() {
        let corners = |x0, y0, x1, y1| GroundShape::Polygon(vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]);
        assert_eq!(bounds(&corners(-10.0, -10.0, 20.0, 10.0)), Some([90.0, 40.0, 120.0, 60.0, 600.0]));
        assert_eq!(bounds(&corners(90.0, 40.0, 500.0, 500.0)), Some([190.0, 0.0, 200.0, 10.0, 100.0]));
        assert_eq!(bounds(&corners(-500.0, -500.0, -90.0, -40.0)), Some([0.0, 90.0, 10.0, 100.0, 100.0]));
        assert_eq!(bounds(&corners(-500.0, -500.0, 500.0, 500.0)).map(|b| b[4]), Some(20_000.0));
        assert_eq!(bounds(&corners(110.0, 0.0, 120.0, 10.0)), None);
        assert_eq!(bounds(&GroundShape::Polygon(Vec::new())), None);
    }
}
