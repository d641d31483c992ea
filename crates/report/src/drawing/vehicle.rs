//! The outline of a vehicle, and its damage in place.

use analysis::{Damage, Vehicle};
use case::{Case, Dimensions};
use crash3::Side;
use kurbo::{Affine, BezPath, Point, Rect, RoundedRect, Shape as _, Vec2};

/// The body seen from above, in its own axes: x forward, y left of the CG (m).
#[derive(Clone, Copy)]
pub(super) struct Body {
    pub(super) dimensions: Dimensions,
    pub(super) outline: Outline,
}

/// Where an outline is from.
#[derive(Clone, Copy)]
pub(super) enum Outline {
    /// The file gives it.
    Given,
    /// The file gives the CRASH3 class, whose typical outline it is.
    OfClass(u8),
    /// The file gives neither: that of the CRASH3 class whose radius of gyration is nearest.
    Nearest(u8),
}

impl Body {
    /// The vehicle's own outline, else that of the CRASH3 class whose radius of gyration is nearest; `None` for a fixed object without one.
    pub(super) fn of(vehicle: &Vehicle) -> Option<Self> {
        if let Some(dimensions) = vehicle.subject.dimensions {
            let outline = dimensions.class.map_or(Outline::Given, Outline::OfClass);
            return Some(Self { dimensions, outline });
        }
        let (class, known) = analysis::nearest_class(&vehicle.subject.inertia?)?;
        let dimensions = Dimensions {
            length: known.length,
            width: known.width,
            cg_to_front: known.cg_to_front,
            class: Some(class),
        };
        Some(Self { dimensions, outline: Outline::Nearest(class) })
    }

    fn bounds(&self) -> Rect {
        let Dimensions { length, width, cg_to_front, .. } = self.dimensions;
        Rect::new(cg_to_front - length, -width / 2.0, cg_to_front, width / 2.0)
    }

    /// The body with rounded corners.
    pub(super) fn outline(&self) -> BezPath {
        let bounds = self.bounds();
        let radius = 0.12 * bounds.height();
        RoundedRect::from_rect(bounds, radius).to_path(1e-3)
    }

    /// The windscreen: what tells front from rear.
    pub(super) fn windscreen(&self) -> BezPath {
        let Rect { x1: front, y0: right, y1: left, .. } = self.bounds();
        let length = self.dimensions.length;
        let (ahead, behind) = (front - 0.26 * length, front - 0.36 * length);
        let mut path = BezPath::new();
        path.move_to((ahead, right * 0.78));
        path.quad_to((ahead + 0.04 * length, 0.0), (ahead, left * 0.78));
        path.line_to((behind, left * 0.66));
        path.quad_to((behind + 0.03 * length, 0.0), (behind, right * 0.66));
        path.close_path();
        path
    }

    /// (m) how far points lie beyond the front, the rear, the left and the right of the body; negative where none does.
    pub(super) fn beyond(&self, points: impl Iterator<Item = Point>) -> [(Side, f64); 4] {
        let Rect { x0: rear, x1: front, y0: right, y1: left } = self.bounds();
        let mut beyond =
            [Side::Front, Side::Rear, Side::Left, Side::Right].map(|side| (side, f64::NEG_INFINITY));
        for point in points {
            let here = [point.x - front, rear - point.x, point.y - left, right - point.y];
            for ((_, most), here) in beyond.iter_mut().zip(here) {
                *most = most.max(here);
            }
        }
        beyond
    }

    pub(super) fn corners(&self) -> [Point; 4] {
        let Rect { x0, y0, x1, y1 } = self.bounds();
        [Point::new(x0, y0), Point::new(x1, y0), Point::new(x1, y1), Point::new(x0, y1)]
    }

    /// The middle of the front.
    pub(super) fn front(&self) -> Point {
        Point::new(self.dimensions.cg_to_front, 0.0)
    }

    pub(super) fn middle(&self) -> Point {
        self.bounds().center()
    }
}

/// The damage in the axes of the vehicle (m).
pub(super) struct Profile {
    /// Stations on the undamaged face.
    pub(super) face: Vec<Point>,
    /// The same stations as deep as the crush.
    pub(super) crushed: Vec<Point>,
    /// Out of the vehicle.
    pub(super) outward: Vec2,
}

/// Where the crush of vehicle `i` lies on its body.
pub(super) fn profile(
    case: &Case,
    vehicle: &Vehicle,
    body: &Body,
    damage: &Damage,
    i: usize,
) -> Option<Profile> {
    let crush = case.vehicles[i].crush.as_ref()?;
    let given = vehicle.subject.damage.as_ref()?;
    let (side, offset) = (given.side, given.offset.unwrap_or_default());
    let (depths, spacings) = match &damage.inferred {
        Some(inferred) => (vec![inferred.crush.depth; 2], vec![inferred.crush.width]),
        None => {
            let intervals = damage.depths.len().saturating_sub(1);
            #[expect(clippy::cast_precision_loss, reason = "station counts are small")]
            let equal = vec![damage.width / intervals.max(1) as f64; intervals];
            let given = crush.spacing.as_ref().map(|s| s.iter().map(case::Quantity::si).collect());
            (damage.depths.clone(), given.unwrap_or(equal))
        }
    };
    let outward = match side {
        Side::Front => Vec2::new(1.0, 0.0),
        Side::Rear => Vec2::new(-1.0, 0.0),
        Side::Left => Vec2::new(0.0, 1.0),
        Side::Right => Vec2::new(0.0, -1.0),
    };
    // Stations run from left to right on front and rear, from rear to front on the sides; the offset is to the left, or forward.
    let (along, start) = match side {
        Side::Front | Side::Rear => (Vec2::new(0.0, -1.0), Vec2::new(0.0, offset)),
        Side::Left | Side::Right => (Vec2::new(1.0, 0.0), Vec2::new(offset, 0.0)),
    };
    let start = start + outward * body.dimensions.face(side) - along * (damage.width / 2.0);
    let mut face = Vec::new();
    let mut done = 0.0;
    for j in 0..depths.len() {
        face.push((start + along * done).to_point());
        done += spacings.get(j).copied().unwrap_or(0.0);
    }
    let crushed = face.iter().zip(&depths).map(|(at, depth)| *at - outward * *depth).collect();
    Some(Profile { face, crushed, outward })
}

/// From the axes of a vehicle whose forward axis is `forward` (a unit vector of the scene, y upwards) and whose CG is at `cg` (px) to the page.
pub(super) fn placed(forward: Vec2, cg: Point, scale: f64) -> Affine {
    let (c, s) = (forward.x * scale, forward.y * scale);
    // (x, y) ↦ CG + scale (x cos θ − y sin θ, −(x sin θ + y cos θ)): the page's y runs downwards.
    Affine::new([c, -s, -s, -c, cg.x, cg.y])
}
