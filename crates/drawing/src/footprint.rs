//! The outline of a vehicle, undamaged and damaged.

use kurbo::{Affine, BezPath, Line, ParamCurve as _, Point, Rect, RoundedRect, Shape as _, Vec2};

use crate::vector::polygon;

/// Number of pieces of the arc of a rounded corner, and of a line that the damage may bend.
const PIECES: u32 = 12;

/// A body seen from above, in its own axes: x forward, y left of the CG.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// (m)
    pub length: f64,
    /// (m)
    pub width: f64,
    /// (m) from the CG to the front.
    pub cg_to_front: f64,
    /// Its shape.
    pub shape: BodyShape,
}

/// The shape of a body from above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyShape {
    /// Rounded corners, and a windscreen.
    Car,
    /// A rectangle: a truck or a trailer.
    Box,
    /// Round at both ends, with handlebars.
    Motorcycle,
    /// A rectangle, hatched: a fixed object.
    Fixed,
}

/// A damaged face in the axes of its vehicle (m): x forward, y left of the CG.
#[derive(Clone, Debug, PartialEq)]
pub struct CrushProfile {
    /// Stations on the undamaged face, from one end to the other.
    pub face: Vec<[f64; 2]>,
    /// The same stations on the crushed face.
    pub crushed: Vec<[f64; 2]>,
    /// Outward direction: a unit vector along an axis.
    pub outward: [f64; 2],
}

impl Footprint {
    fn bounds(&self) -> Rect {
        let Self { length, width, cg_to_front, .. } = *self;
        Rect::new(cg_to_front - length, -width / 2.0, cg_to_front, width / 2.0)
    }

    /// (m) radius of the corners.
    fn radius(&self) -> f64 {
        match self.shape {
            BodyShape::Car => 0.12 * self.width,
            BodyShape::Box => 0.03 * self.width,
            BodyShape::Motorcycle => 0.5 * self.width.min(self.length),
            BodyShape::Fixed => 0.0,
        }
    }

    /// The undamaged body.
    pub(crate) fn outline(&self) -> BezPath {
        RoundedRect::from_rect(self.bounds(), self.radius()).to_path(1e-3)
    }

    /// The damaged body: each point of the face is moved inward by the crush depth there.
    pub(crate) fn damaged(&self, crush: &CrushProfile) -> BezPath {
        let surface = Surface::new(self, crush);
        polygon(surface.contour().into_iter().map(|[along, depth]| surface.at(along, depth)))
    }

    /// The damaged body, or the undamaged one.
    pub(crate) fn left_by(&self, crush: Option<&CrushProfile>) -> BezPath {
        crush.map_or_else(|| self.outline(), |crush| self.damaged(crush))
    }

    /// The detail that distinguishes front from rear: a car's windscreen or a motorcycle's handlebars, pushed
    /// in where the damage reaches them.
    pub(crate) fn detail(&self, crush: Option<&CrushProfile>) -> Option<BezPath> {
        let whole = match self.shape {
            BodyShape::Car => self.windscreen(),
            BodyShape::Motorcycle => self.handlebars(),
            BodyShape::Box | BodyShape::Fixed => return None,
        };
        let Some(surface) = crush.map(|crush| Surface::new(self, crush)) else { return Some(whole) };
        if whole.segments().all(|segment| {
            [segment.start(), segment.end()].iter().all(|&point| surface.pushed(point) == point)
        }) {
            return Some(whole);
        }
        let mut path = BezPath::new();
        kurbo::flatten(whole.iter(), 1e-2, |element| match element {
            kurbo::PathEl::MoveTo(point) => path.move_to(surface.pushed(point)),
            kurbo::PathEl::LineTo(end) => {
                let Some(start) = path.current_position() else { return };
                for k in 1..=PIECES {
                    let share = f64::from(k) / f64::from(PIECES);
                    path.line_to(surface.pushed(Line::new(start, end).eval(share)));
                }
            }
            _ => path.close_path(),
        });
        Some(path)
    }

    fn windscreen(&self) -> BezPath {
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

    fn handlebars(&self) -> BezPath {
        let Rect { x1: front, y0: right, y1: left, .. } = self.bounds();
        let across = front - 0.3 * self.length;
        let mut path = BezPath::new();
        path.move_to((across, right));
        path.line_to((across, left));
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

/// The body in the coordinates of the damaged face: position along the face and depth below it.
struct Surface {
    /// Along the face, in the axes of the vehicle.
    direction: Vec2,
    outward: Vec2,
    /// (m) from the CG to the face, and to the one opposite.
    face: f64,
    depth: f64,
    /// (m) where the face ends.
    ends: [f64; 2],
    /// (m) radius of the corners.
    radius: f64,
    /// (m) stations, sorted: position along the face, and crush depth.
    stations: Vec<[f64; 2]>,
}

impl Surface {
    fn new(body: &Footprint, crush: &CrushProfile) -> Self {
        let outward = Vec2::new(crush.outward[0], crush.outward[1]);
        let direction = Vec2::new(outward.y.abs(), outward.x.abs());
        let corners = body.corners().map(Point::to_vec2);
        let most = |direction: Vec2| corners.map(|c| c.dot(direction)).into_iter().fold(f64::MIN, f64::max);
        let face = most(outward);
        let mut stations: Vec<[f64; 2]> = crush
            .crushed
            .iter()
            .map(|&[x, y]| Vec2::new(x, y))
            .map(|at| [at.dot(direction), face - at.dot(outward)])
            .collect();
        if stations.first().zip(stations.last()).is_some_and(|(first, last)| first[0] > last[0]) {
            stations.reverse();
        }
        let (radius, ends) = (body.radius(), [-most(-direction), most(direction)]);
        // If an end station lies in a rounded corner of the bumper, the rest of the corner is crushed too.
        let corner = if body.shape == BodyShape::Motorcycle { 0.0 } else { radius };
        let beside = |along: f64, end: f64| (along - end).abs() < corner;
        if let Some(first) = stations.first().copied().filter(|first| beside(first[0], ends[0])) {
            stations.insert(0, [first[0].min(ends[0]), first[1]]);
        }
        if let Some(last) = stations.last().copied().filter(|last| beside(last[0], ends[1])) {
            stations.push([last[0].max(ends[1]), last[1]]);
        }
        Self { direction, outward, face, depth: face + most(-outward), ends, radius, stations }
    }

    fn at(&self, along: f64, depth: f64) -> Point {
        (self.direction * along + self.outward * (self.face - depth)).to_point()
    }

    /// (m) how far the undamaged body lies below its face: more than zero at the rounded corners.
    fn undamaged(&self, along: f64) -> f64 {
        let [low, high] = self.ends;
        let inside = (along - low).min(high - along).clamp(0.0, self.radius);
        let short = self.radius - inside;
        // r − √(r² − (r − s)²)
        self.radius - (self.radius * self.radius - short * short).max(0.0).sqrt()
    }

    /// (m) the same for the opposite face.
    fn opposite(&self, along: f64) -> f64 {
        self.depth - self.undamaged(along)
    }

    /// (m) crush depth, linear between stations; zero next to the damage.
    fn crush(&self, along: f64) -> f64 {
        let pair = self.stations.windows(2).find(|pair| pair[0][0] <= along && along <= pair[1][0]);
        pair.map_or(0.0, |pair| {
            let [[from, first], [to, second]] = [pair[0], pair[1]];
            let share = if to > from { (along - from) / (to - from) } else { 0.0 };
            first + (second - first) * share
        })
    }

    /// (m) depth of the surface of the remaining body, at most that of the opposite face.
    fn damaged(&self, along: f64, crush: f64) -> f64 {
        self.undamaged(along).max(crush).min(self.opposite(along))
    }

    /// Position along the face and depth of each corner of the remaining body, once around.
    fn contour(&self) -> Vec<[f64; 2]> {
        let [low, high] = self.ends;
        let arc = |k: u32| {
            // s = r (1 − cos φ) would space the points evenly on the arc; (k/N)² is close enough.
            let share = f64::from(k) / f64::from(PIECES);
            self.radius * share * share
        };
        let mut body: Vec<f64> = (0..=PIECES).map(|k| low + arc(k)).collect();
        body.extend((0..=PIECES).rev().map(|k| high - arc(k)));
        let (begins, ends) = match (self.stations.first(), self.stations.last()) {
            (Some(first), Some(last)) => (first[0], last[0]),
            _ => (high, low),
        };
        let mut near: Vec<[f64; 2]> = Vec::new();
        let beside = |along: f64| [along, self.undamaged(along)];
        let left = body.iter().filter(|&&along| along < begins);
        near.extend(left.map(|&along| beside(along)));
        if low < begins && begins <= high {
            near.push(beside(begins));
        }
        let mut inside: Vec<[f64; 2]> =
            self.stations.iter().copied().filter(|[along, _]| (low..=high).contains(along)).collect();
        let between = body.iter().filter(|&&along| begins <= along && along <= ends);
        inside.extend(between.map(|&along| [along, self.crush(along)]));
        inside.sort_by(|one, other| one[0].total_cmp(&other[0]));
        near.extend(inside.iter().map(|&[along, crush]| [along, self.damaged(along, crush)]));
        if low <= ends && ends < high {
            near.push(beside(ends));
        }
        let right = body.iter().filter(|&&along| along > ends);
        near.extend(right.map(|&along| beside(along)));
        near.extend(body.iter().rev().map(|&along| [along, self.opposite(along)]));
        near.dedup();
        near
    }

    /// Where the damage moves a point of the body.
    fn pushed(&self, point: Point) -> Point {
        let at = point.to_vec2();
        let (along, depth) = (at.dot(self.direction), self.face - at.dot(self.outward));
        let crush = self.damaged(along, self.crush(along));
        if depth < crush { self.at(along, crush) } else { point }
    }
}

/// Transform to the page from the axes of a vehicle whose forward axis is `forward` (a unit vector of the
/// scene, y upwards) and whose CG is at `cg` (px).
pub(crate) fn placed(forward: Vec2, cg: Point, scale: f64) -> Affine {
    let (c, s) = (forward.x * scale, forward.y * scale);
    // (x, y) ↦ CG + scale (x cos θ − y sin θ, −(x sin θ + y cos θ)): the page's y runs downwards.
    Affine::new([c, -s, -s, -c, cg.x, cg.y])
}

#[cfg(test)]
mod tests {
    use kurbo::{BezPath, Point, Shape as _};

    use super::{BodyShape, CrushProfile, Footprint};

    /// 4 m × 2 m, its CG 1.5 m behind the front: from x = −2.5 to 1.5, y = −1 to 1.
    const BODY: Footprint = Footprint { length: 4.0, width: 2.0, cg_to_front: 1.5, shape: BodyShape::Fixed };

    fn crush(outward: [f64; 2], stations: &[([f64; 2], f64)]) -> CrushProfile {
        let [x, y] = outward;
        CrushProfile {
            face: stations.iter().map(|(at, _)| *at).collect(),
            crushed: stations.iter().map(|([u, v], deep)| [u - x * deep, v - y * deep]).collect(),
            outward,
        }
    }

    fn has(path: &BezPath, x: f64, y: f64) -> bool {
        path.elements()
            .iter()
            .filter_map(kurbo::PathEl::end_point)
            .any(|at| at.distance(Point::new(x, y)) < 1e-12)
    }

    /// The corners of the remaining body, and its area by hand, on all four sides; the stations run as they
    /// do in a case: from left to right on front and rear, from rear to front on the sides.
    #[test]
    fn each_side_is_as_deep_as_its_stations() {
        // 0.2 m at one end of a damage of 1 m, 0.4 m at the other: 0.3 m² are gone.
        let left = 4.0 * 2.0 - 0.3;
        let front = crush([1.0, 0.0], &[([1.5, 0.6], 0.2), ([1.5, -0.4], 0.4)]);
        let rear = crush([-1.0, 0.0], &[([-2.5, 0.6], 0.2), ([-2.5, -0.4], 0.4)]);
        let of_left = crush([0.0, 1.0], &[([-0.5, 1.0], 0.2), ([0.5, 1.0], 0.4)]);
        let of_right = crush([0.0, -1.0], &[([-0.5, -1.0], 0.2), ([0.5, -1.0], 0.4)]);
        for (crush, corners) in [
            (front, [[1.5, 0.6], [1.3, 0.6], [1.1, -0.4], [1.5, -0.4]]),
            (rear, [[-2.5, 0.6], [-2.3, 0.6], [-2.1, -0.4], [-2.5, -0.4]]),
            (of_left, [[-0.5, 1.0], [-0.5, 0.8], [0.5, 0.6], [0.5, 1.0]]),
            (of_right, [[-0.5, -1.0], [-0.5, -0.8], [0.5, -0.6], [0.5, -1.0]]),
        ] {
            let path = BODY.damaged(&crush);
            for [x, y] in corners.into_iter().chain([[-2.5, 1.0], [-2.5, -1.0], [1.5, 1.0], [1.5, -1.0]]) {
                assert!(has(&path, x, y), "{x} {y}: {}", path.to_svg());
            }
            assert!((path.area().abs() - left).abs() < 1e-12, "{}", path.area());
        }
    }

    #[test]
    fn damage_beyond_the_body_takes_no_more_than_there_is() {
        // From 0.5 m to the left of the axis to 1.5 m to its right, where the body ends at 1 m; 0.4 m deep.
        let wide = crush([1.0, 0.0], &[([1.5, 0.5], 0.4), ([1.5, -1.5], 0.4)]);
        assert!((BODY.damaged(&wide).area().abs() - (8.0 - 1.5 * 0.4)).abs() < 1e-12);
        // As deep as the body is wide, and more.
        let through = crush([0.0, 1.0], &[([-0.5, 1.0], 3.0), ([0.5, 1.0], 3.0)]);
        let path = BODY.damaged(&through);
        assert!((path.area().abs() - 6.0).abs() < 1e-12);
        assert!(path.bounding_box().y0 >= -1.0);
    }

    #[test]
    fn rounded_corners_stay_where_the_damage_does_not_reach() {
        let car = Footprint { shape: BodyShape::Car, ..BODY };
        let shallow = crush([1.0, 0.0], &[([1.5, 1.0], 0.05), ([1.5, -1.0], 0.05)]);
        let (whole, damaged) = (car.outline(), car.damaged(&shallow));
        // r = 0.24 m; the strip of 0.05 m is 2 m wide, less what the two rounded corners already lack.
        let (r, d) = (0.24_f64, 0.05_f64);
        let angle = ((r - d) / r).acos();
        let gone = whole.area().abs() - damaged.area().abs();
        // ∫ from r − d to r of the width 2 (1 − r + √(r² − u²)) du
        let half_strip = 0.5 * (r * r * angle - (r - d) * (r * r - (r - d) * (r - d)).sqrt());
        let expected = 2.0 * ((1.0 - r) * d + half_strip);
        assert!((gone - expected).abs() < 2e-3, "{gone} for {expected}");
    }

    #[test]
    fn no_sliver_of_a_corner_stands_beside_the_damage() {
        let car = Footprint { shape: BodyShape::Car, ..BODY };
        // The corners have a radius of 0.24 m: 0.2 m next to the damage are crushed with it, 0.3 m are not.
        let front = |left: f64, right: f64| {
            car.damaged(&crush([1.0, 0.0], &[([1.5, left], 0.5), ([1.5, -right], 0.5)])).bounding_box().x1
        };
        assert!((front(0.8, 0.8) - 1.0).abs() < 1e-12);
        assert!((front(0.7, 0.8) - 1.5).abs() < 1e-12);
        assert!((front(0.8, 0.7) - 1.5).abs() < 1e-12);
        // A motorcycle is round at its ends, and has no bumper: 0.2 m to each side of the axis are gone, and
        // next to them its front is √(1 − 0.2²) m ahead of the middle of the arc, at x = 0.5.
        let motorcycle = Footprint { shape: BodyShape::Motorcycle, ..BODY };
        let hit = crush([1.0, 0.0], &[([1.5, 0.2], 0.5), ([1.5, -0.2], 0.5)]);
        let front = motorcycle.damaged(&hit).bounding_box().x1;
        assert!((front - (0.5 + 0.96_f64.sqrt())).abs() < 1e-12, "{front}");
    }

    #[test]
    fn the_windscreen_is_pushed_in_with_the_front() {
        let car = Footprint { shape: BodyShape::Car, ..BODY };
        let small = crush([1.0, 0.0], &[([1.5, 1.0], 0.5), ([1.5, -1.0], 0.5)]);
        assert_eq!(car.detail(Some(&small)), car.detail(None));
        // The windscreen lies between 0.88 m and 1.44 m behind the front.
        let large = crush([1.0, 0.0], &[([1.5, 1.0], 1.2), ([1.5, -1.0], 1.2)]);
        let bent = car.detail(Some(&large)).unwrap().bounding_box();
        assert!((bent.x1 - 0.3).abs() < 1e-9 && bent.x0 < 0.1, "{bent:?}");
        // Its front corners lie at x = 0.46, y = ±0.78. From 1.0 m deep on the left, at y = 1, to 1.4 m on
        // the right the crush is 1.0 + 0.2 (1 − y): 1.044 m and 1.356 m there.
        let slope = crush([1.0, 0.0], &[([1.5, 1.0], 1.0), ([1.5, -1.0], 1.4)]);
        let bent = car.detail(Some(&slope)).unwrap();
        let near = |x: f64, y: f64| {
            let points = bent.elements().iter().filter_map(kurbo::PathEl::end_point);
            points.map(|at| at.distance(Point::new(x, y))).fold(f64::INFINITY, f64::min)
        };
        assert!(near(1.5 - 1.044, 0.78) < 1e-9 && near(1.5 - 1.356, -0.78) < 1e-9, "{}", bent.to_svg());
        assert_eq!(BODY.detail(None), None);
    }
}
