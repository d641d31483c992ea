//! Tests whether points of a page lie inside an outline, for many tests of one outline.

use kurbo::{BezPath, Line, PathEl, Point, Rect, Shape as _};

/// (px) maximum distance between a curve and its chords, too small to be seen.
const CHORD: f64 = 0.05;
/// Number of neighbours that share a box: enough that the boxes are few, few enough that the boxes are small.
const FEW: usize = 16;

/// Things on a page in the order in which they were added, with a box around every few of them.
///
/// Neighbours in that order mostly lie next to each other, as the pieces of a line do, so one test of their
/// box rules out all of them.
#[derive(Clone, Debug)]
pub(crate) struct Neighbours<T> {
    things: Vec<T>,
    boxes: Vec<Rect>,
}

// A derived implementation would require `T: Default`.
impl<T> Default for Neighbours<T> {
    fn default() -> Self {
        Self { things: Vec::new(), boxes: Vec::new() }
    }
}

impl<T> Neighbours<T> {
    pub(crate) fn push(&mut self, thing: T, area: Rect) {
        match self.boxes.last_mut() {
            Some(last) if !self.things.len().is_multiple_of(FEW) => *last = last.union(area),
            _ => self.boxes.push(area),
        }
        self.things.push(thing);
    }

    /// All things in their order, except those in boxes that fail the test.
    pub(crate) fn near(&self, matters: impl Fn(Rect) -> bool) -> impl Iterator<Item = &T> {
        let few = self.things.chunks(FEW).zip(&self.boxes);
        few.filter(move |(_, area)| matters(**area)).flat_map(|(few, _)| few)
    }
}

/// A path flattened to straight edges.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    bounds: Rect,
    edges: Neighbours<Line>,
}

impl Outline {
    pub(crate) fn new(path: &BezPath) -> Self {
        let mut edges = Neighbours::default();
        let mut edge = |from: Point, to: Point| {
            // No point lies to the side of a horizontal edge.
            if from.y != to.y {
                edges.push(Line::new(from, to), Rect::from_points(from, to));
            }
        };
        let (mut start, mut last) = (Point::ZERO, Point::ZERO);
        kurbo::flatten(path.iter(), CHORD, |element| match element {
            PathEl::MoveTo(point) => (start, last) = (point, point),
            PathEl::LineTo(point) => edge(std::mem::replace(&mut last, point), point),
            _ => edge(std::mem::replace(&mut last, start), start),
        });
        Self { bounds: path.bounding_box(), edges }
    }

    /// The smallest box around it.
    pub(crate) fn bounds(&self) -> Rect {
        self.bounds
    }

    /// Tests which points at one height are inside the outline (winding number).
    pub(crate) fn holds<const N: usize>(&self, y: f64, xs: [f64; N]) -> [bool; N] {
        let mut windings = [0_i32; N];
        for Line { p0, p1 } in self.edges.near(|area| area.y0 <= y && y < area.y1) {
            let (downwards, upwards) = (p0.y <= y && y < p1.y, p1.y <= y && y < p0.y);
            if downwards || upwards {
                let crossing = p0.x + (y - p0.y) * (p1.x - p0.x) / (p1.y - p0.y);
                for (winding, x) in windings.iter_mut().zip(xs) {
                    *winding += i32::from(crossing <= x) * if upwards { 1 } else { -1 };
                }
            }
        }
        windings.map(|winding| winding != 0)
    }
}

#[cfg(test)]
mod tests {
    use kurbo::{BezPath, Circle, PathSeg, Point, Rect, Shape as _};

    use super::{Neighbours, Outline};

    /// Evenly spread pairs between zero and one, the same in each run: the fractions of the multiples of two
    /// roots (Weyl's sequence).
    fn spread(count: u32) -> impl Iterator<Item = [f64; 2]> {
        (1..=count)
            .map(|i| [0.414_213_562_373_095, 0.732_050_807_568_877].map(|root| (root * f64::from(i)).fract()))
    }

    /// The chords replace the curves: any point clear of the outline is on the same side of both. Tested for
    /// a ring whose hole winds the other way, two overlapping circles, and a shape of straight and curved
    /// edges.
    #[test]
    fn an_outline_holds_what_its_path_holds() {
        let circle = |x: f64, radius: f64| Circle::new((x, 50.0), radius).to_path(1e-3);
        let mut ring = circle(50.0, 45.0);
        ring.extend(circle(50.0, 20.0).reverse_subpaths());
        let mut pair = circle(40.0, 30.0);
        pair.extend(circle(60.0, 30.0));
        let mut shape = BezPath::new();
        shape.move_to((10.0, 20.0));
        shape.quad_to((50.0, -20.0), (90.0, 20.0));
        shape.line_to((60.0, 50.0));
        shape.curve_to((110.0, 60.0), (90.0, 120.0), (50.0, 80.0));
        shape.line_to((30.0, 80.0));
        shape.close_path();
        for path in [ring, pair, shape] {
            let outline = Outline::new(&path);
            assert_eq!(outline.bounds(), path.bounding_box());
            let (mut inside, mut outside) = (0, 0);
            for [x, y] in spread(4000) {
                let at = Point::new(100.0 * x, 100.0 * y);
                if path.segments().any(|segment| distance(&segment, at) < 0.1) {
                    continue;
                }
                let is_inside = path.contains(at);
                assert_eq!(outline.holds(at.y, [at.x]), [is_inside], "{at}");
                *(if is_inside { &mut inside } else { &mut outside }) += 1;
            }
            assert!(inside > 1000 && outside > 1000, "{inside} inside, {outside} outside");
        }
    }

    fn distance(segment: &PathSeg, at: Point) -> f64 {
        use kurbo::ParamCurveNearest as _;
        segment.nearest(at, 1e-6).distance_sq.sqrt()
    }

    /// The boxes leave out nothing that matters, and keep the order.
    #[test]
    fn neighbours_are_as_one_by_one() {
        let mut neighbours = Neighbours::default();
        let mut all = Vec::new();
        for (place, [x, y]) in spread(333).enumerate() {
            let area = Rect::from_center_size((100.0 * x, 100.0 * y), (5.0, 3.0));
            neighbours.push((place, area), area);
            all.push((place, area));
        }
        let mut found = 0;
        for [x, y] in spread(100) {
            let asked = Rect::from_center_size((100.0 * y, 100.0 * x), (12.0, 8.0));
            let near = neighbours.near(|few| few.overlaps(asked)).filter(|(_, area)| area.overlaps(asked));
            let near: Vec<usize> = near.map(|(place, _)| *place).collect();
            let one_by_one = all.iter().filter(|(_, area)| area.overlaps(asked)).map(|(place, _)| *place);
            assert!(near.iter().copied().eq(one_by_one), "{asked}");
            found += near.len();
        }
        assert!(found > 100);
    }
}
