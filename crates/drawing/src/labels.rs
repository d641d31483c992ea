//! Places the labels of all pictures.

use kurbo::{BezPath, Line, Point, Rect};

use crate::font::{self, Anchor, SMALL};
use crate::outline::{Neighbours, Outline};

/// Line height as a multiple of the font size.
const LINE: f64 = 1.25;
/// Share of the line height above the baseline.
const ASCENT: f64 = 0.97;
/// (px) shortest leader that is drawn, in general and for a label that names one point among many.
const LEADER: f64 = 26.0;
const LEADER_OF_POINT: f64 = 13.0;
/// (px) length of the pieces into which a line that labels avoid is divided.
const PIECE: f64 = 6.0;

/// Costs of a label that leaves the page, covers another label, or covers a point that a reader looks for:
/// any other place is better.
const OFF_PAGE: f64 = 1e6;
const ON_TEXT: f64 = 1e5;
const ON_POINT: f64 = 1e4;
/// Cost of lying on an area that the label should keep off. A place right at the point costs nothing, and one
/// 10 px away costs 6.
const ON_AREA: f64 = 200.0;
/// Cost of a label without a leader that is as near to another point as to its own, and of a label with a
/// leader that leaves another point no room for a label.
const MISLEADING: f64 = 300.0;
const CROWDING: f64 = 60.0;
/// (px) how much nearer a label has to be to its own point than to any other.
const PLAIN: f64 = 3.0;
/// (px) two points at most this far apart look like one.
const SAME: f64 = 1.0;
/// (px) distance between places within an area, and cost of each pixel from the best place: a line costs
/// more.
const STEP: f64 = 12.0;
const WITHIN: f64 = 0.02;
/// Cost of a leader for each other leader that it crosses, and for each piece of anything else.
const CROSSING: f64 = 60.0;
const CROSSED: f64 = 0.5;

/// The allowed places of a label.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Anywhere, even on an outline.
    Anywhere,
    /// Outside all outlines.
    BesideOutlines,
    /// Where it is clear which of many points it names.
    OfPoint,
    /// On the area that it names, without a leader, if there is room; otherwise outside all outlines.
    Within,
}

/// A label that is not yet placed.
#[derive(Clone, Debug)]
struct Label {
    at: Point,
    text: String,
    colour: &'static str,
    kind: Kind,
    /// The area of [`Kind::Within`].
    within: Option<Outline>,
}

/// An area that labels keep off.
#[derive(Clone, Debug)]
struct Area {
    outline: Outline,
    /// Whether all labels keep off it, not only those that have to be outside outlines.
    all: bool,
}

/// Something that labels should not cover.
#[derive(Clone, Copy, Debug)]
struct Obstacle {
    area: Rect,
    weight: f64,
}

/// A label that has been placed.
pub(crate) struct Placed {
    /// Where its text begins, on the baseline.
    pub(crate) base: Point,
    pub(crate) text: String,
    pub(crate) colour: &'static str,
    /// From its point to the label, unless the label is next to it.
    pub(crate) leader: Option<Line>,
}

/// The contents of a page so far, and the labels that are not yet placed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Placer {
    labels: Vec<Label>,
    texts: Vec<Rect>,
    obstacles: Neighbours<Obstacle>,
    /// Arrowheads, and other areas that no label may cover.
    points: Vec<Rect>,
    areas: Vec<Area>,
    /// From labels to their points.
    leaders: Vec<Line>,
}

impl Placer {
    /// Keeps labels off the line from `a` to `b`, the more the greater the weight.
    pub(crate) fn block(&mut self, a: Point, b: Point, weight: f64) {
        let length = (b - a).hypot();
        if length.is_infinite() {
            return;
        }
        let mut done = 0.0;
        while done <= length {
            let at = if length > 0.0 { a + (b - a) * (done / length) } else { a };
            self.avoid(Rect::from_center_size(at, (PIECE, PIECE)), weight);
            done += PIECE;
        }
    }

    /// Keeps labels off an area, the more the greater the weight.
    pub(crate) fn avoid(&mut self, area: Rect, weight: f64) {
        self.obstacles.push(Obstacle { area, weight }, area);
    }

    /// Marks an area as taken by a text, which no label covers.
    pub(crate) fn taken(&mut self, area: Rect) {
        self.texts.push(area);
    }

    /// Keeps all labels from covering an area.
    pub(crate) fn protect(&mut self, area: Rect) {
        self.points.push(area);
    }

    /// Keeps labels off an area: those of [`label_beside`](Self::label_beside), or all of them.
    pub(crate) fn keep_off(&mut self, path: &BezPath, all: bool) {
        self.areas.push(Area { outline: Outline::new(path), all });
    }

    /// Labels a point; the text is placed nearby.
    pub(crate) fn label(&mut self, at: Point, text: &str, colour: &'static str) {
        self.add(at, text, colour, Kind::Anywhere);
    }

    /// Labels a point from outside all outlines, with a line to it.
    pub(crate) fn label_beside(&mut self, at: Point, text: &str, colour: &'static str) {
        self.add(at, text, colour, Kind::BesideOutlines);
    }

    /// Labels one of many points, which were given to [`protect`](Self::protect).
    pub(crate) fn label_of_point(&mut self, at: Point, text: &str, colour: &'static str) {
        self.add(at, text, colour, Kind::OfPoint);
    }

    fn add(&mut self, at: Point, text: &str, colour: &'static str, kind: Kind) {
        self.labels.push(Label { at, text: text.to_owned(), colour, kind, within: None });
    }

    /// Adds a label that names an area, on the area if there is room, as near to the point as that allows.
    pub(crate) fn label_within(&mut self, area: &BezPath, at: Point, text: &str, colour: &'static str) {
        let within = Some(Outline::new(area));
        self.labels.push(Label { at, text: text.to_owned(), colour, kind: Kind::Within, within });
    }

    /// Places all labels inside `bounds` in the order given, each where it covers no other text and as little
    /// of the lines as possible, near its point.
    pub(crate) fn place(&mut self, bounds: Rect) -> Vec<Placed> {
        let mut placed = Vec::new();
        for Label { at, text, colour, kind, within } in std::mem::take(&mut self.labels) {
            let size = (font::width(&text, SMALL), LINE * SMALL);
            if let Some(centre) = within.and_then(|within| self.place_within(&within, at, size, bounds)) {
                let base = base_of(Rect::from_center_size(centre, size));
                self.taken(text_area(base, &text, SMALL, Anchor::Start));
                placed.push(Placed { base, text, colour, leader: None });
                continue;
            }
            let mut best = (f64::INFINITY, at);
            for centre in candidates(at, size) {
                let area = Rect::from_center_size(centre, size).inflate(5.0, 1.0);
                let far = 0.6 * gap(at, area);
                let Some(mut cost) = self.cost(area, bounds, kind, far, best.0) else { continue };
                let label = Rect::from_center_size(centre, size);
                let line = leader(at, label, kind);
                cost += line.map_or(0.0, |line| self.cost_of_leader(line));
                if kind == Kind::OfPoint {
                    cost += self.cost_of_others(at, label, line.is_some());
                }
                if cost < best.0 {
                    best = (cost, centre);
                }
            }
            let area = Rect::from_center_size(best.1, size);
            let leader = leader(at, area, kind);
            if let Some(line) = leader {
                self.leaders.push(line);
                self.block(line.p0, line.p1, 1.0);
            }
            let base = base_of(area);
            self.taken(text_area(base, &text, SMALL, Anchor::Start));
            placed.push(Placed { base, text, colour, leader });
        }
        placed
    }

    /// The best place wholly on an area that is clear of other texts, points and outlines, if there is one.
    fn place_within(&self, within: &Outline, at: Point, size: (f64, f64), bounds: Rect) -> Option<Point> {
        let room = within.bounds().intersect(bounds);
        let mut best = (ON_AREA, None);
        let mut y = room.y0 + 0.5 * size.1 + PIECE;
        while y < room.y1 {
            let mut x = room.x0 + 0.5 * size.0 + PIECE;
            while x < room.x1 {
                let centre = Point::new(x, y);
                let area = Rect::from_center_size(centre, size).inflate(5.0, 1.0);
                let far = WITHIN * (centre - at).hypot();
                if far < best.0
                    && holds(within, area)
                    && let Some(cost) = self.cost(area, bounds, Kind::Within, far, best.0)
                {
                    best = (cost, Some(centre));
                }
                x += STEP;
            }
            y += STEP;
        }
        best.1
    }

    /// The cost of a label in `area`, where `far` is its cost of distance; `None` if it is not below the
    /// limit.
    ///
    /// No term is negative, so a partial sum that reaches the limit decides, even with rounding. Most places
    /// are too far away, whatever lies there; areas are tested last because they take longest.
    fn cost(&self, area: Rect, bounds: Rect, kind: Kind, far: f64, limit: f64) -> Option<f64> {
        if far >= limit {
            return None;
        }
        let covered = |other: &Rect| overlap(area, *other);
        let off_page = if bounds.contains_rect(area) { 0.0 } else { OFF_PAGE };
        let texts = count(self.texts.iter().filter(|other| covered(other))) * ON_TEXT;
        let points = count(self.points.iter().filter(|other| covered(other))) * ON_POINT;
        let mut lines = 0.0;
        for Obstacle { area, weight } in self.obstacles.near(|few| covered(&few)) {
            if covered(area) {
                lines += weight;
                if off_page + texts + points + 6.0 * lines + far >= limit {
                    return None;
                }
            }
        }
        let kept_off = self
            .areas
            .iter()
            .filter(|other| other.all || matches!(kind, Kind::BesideOutlines | Kind::Within));
        let areas = count(kept_off.filter(|other| is_under(&other.outline, area))) * ON_AREA;
        let cost = off_page + texts + points + areas + 6.0 * lines + far;
        (cost < limit).then_some(cost)
    }

    /// The cost of a label near points other than its own.
    fn cost_of_others(&self, at: Point, label: Rect, has_line: bool) -> f64 {
        let others = self.points.iter().map(Rect::center).filter(|other| (*other - at).hypot() > SAME);
        let nearest = others.map(|other| gap(other, label)).fold(f64::INFINITY, f64::min);
        match has_line {
            false if nearest < gap(at, label) + PLAIN => MISLEADING,
            true if nearest < LEADER_OF_POINT => CROWDING,
            _ => 0.0,
        }
    }

    fn cost_of_leader(&self, line: Line) -> f64 {
        let leaders = count(self.leaders.iter().filter(|other| {
            other.crossing_point(line).is_some_and(|at| {
                [line, **other]
                    .iter()
                    .all(|line| Rect::from_points(line.p0, line.p1).inflate(0.1, 0.1).contains(at))
            })
        }));
        let texts = count(self.texts.iter().filter(|text| cuts(line, **text)));
        // The point where the line begins is its own.
        let points = self.points.iter().filter(|point| !point.inflate(1.0, 1.0).contains(line.p0));
        let points = count(points.filter(|point| cuts(line, **point)));
        let near = self.obstacles.near(|few| cuts(line, few));
        let crossed = near.filter(|obstacle| cuts(line, obstacle.area));
        let crossed: f64 = crossed.map(|obstacle| obstacle.weight).sum();
        texts * ON_POINT + points * ON_AREA + leaders * CROSSING + crossed * CROSSED
    }
}

/// The box of a text that is anchored at a point on its baseline.
pub(crate) fn text_area(at: Point, text: &str, size: f64, anchor: Anchor) -> Rect {
    let width = font::width(text, size);
    let left = match anchor {
        Anchor::Start => at.x,
        Anchor::Middle => at.x - width / 2.0,
        Anchor::End => at.x - width,
    };
    let top = at.y - ASCENT * size;
    Rect::new(left, top, left + width, top + LINE * size)
}

/// Whether an outline lies under a label, tested at points every few pixels of the label.
fn is_under(outline: &Outline, label: Rect) -> bool {
    outline.bounds().overlaps(label) && rows_of(label).any(|(y, xs)| outline.holds(y, xs).contains(&true))
}

/// Whether an outline contains the whole label, tested at the same points.
fn holds(outline: &Outline, label: Rect) -> bool {
    rows_of(label).all(|(y, xs)| !outline.holds(y, xs).contains(&false))
}

/// Test points of a label, row by row.
fn rows_of(label: Rect) -> impl Iterator<Item = (f64, [f64; 9])> {
    let xs = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0].map(|step| label.x0 + label.width() * step / 8.0);
    [label.y0, label.center().y, label.y1].into_iter().map(move |y| (y, xs))
}

/// Where the text of a label begins.
fn base_of(label: Rect) -> Point {
    Point::new(label.x0, label.y0 + ASCENT * SMALL)
}

fn count<T>(iterator: impl Iterator<Item = T>) -> f64 {
    iterator.fold(0.0, |count, _| count + 1.0)
}

/// The line from a point to its label, unless they are next to each other.
fn leader(at: Point, label: Rect, kind: Kind) -> Option<Line> {
    let most = if kind == Kind::OfPoint { LEADER_OF_POINT } else { LEADER };
    let nearest = Point::new(at.x.clamp(label.x0, label.x1), at.y.clamp(label.y0, label.y1));
    (gap(at, label) > most).then_some(Line::new(at, nearest))
}

/// Whether a line goes through an area.
fn cuts(Line { p0, p1 }: Line, area: Rect) -> bool {
    let along = p1 - p0;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    // The line's parts between the two edges in x and in y have to overlap (Liang and Barsky).
    for (from, along, low, high) in [(p0.x, along.x, area.x0, area.x1), (p0.y, along.y, area.y0, area.y1)] {
        if along == 0.0 {
            if from < low || from > high {
                return false;
            }
            continue;
        }
        let ends = [(low - from) / along, (high - from) / along];
        first = greater(first, lesser(ends[0], ends[1]));
        last = lesser(last, greater(ends[0], ends[1]));
    }
    first <= last
}

/// Candidates for the middle of a label: around its point, nearer ones first.
fn candidates(at: Point, (width, height): (f64, f64)) -> impl Iterator<Item = Point> {
    const DIRECTIONS: [(f64, f64); 16] = [
        (1.0, -1.0),
        (-1.0, -1.0),
        (1.0, 1.0),
        (-1.0, 1.0),
        (1.0, 0.0),
        (-1.0, 0.0),
        (0.0, -1.0),
        (0.0, 1.0),
        (1.0, -0.5),
        (-1.0, -0.5),
        (1.0, 0.5),
        (-1.0, 0.5),
        (0.5, -1.0),
        (-0.5, -1.0),
        (0.5, 1.0),
        (-0.5, 1.0),
    ];
    (0..40).flat_map(move |ring| {
        let distance = 9.0 + 7.0 * f64::from(ring);
        DIRECTIONS.iter().map(move |&(x, y)| {
            Point::new(at.x + x * (width / 2.0 + distance), at.y + y * (height / 2.0 + distance))
        })
    })
}

/// (px) from a point to an area.
fn gap(at: Point, area: Rect) -> f64 {
    let dx = greater(greater(area.x0 - at.x, at.x - area.x1), 0.0);
    let dy = greater(greater(area.y0 - at.y, at.y - area.y1), 0.0);
    (dx * dx + dy * dy).sqrt()
}

/// Whether two areas share more than an edge.
fn overlap(one: Rect, other: Rect) -> bool {
    greater(one.x0, other.x0) < lesser(one.x1, other.x1)
        && greater(one.y0, other.y0) < lesser(one.y1, other.y1)
}

/// The lesser of two numbers. `f64::min` also handles NaN, and in WebAssembly it is a call; these two
/// functions take most of the time of a drawing.
fn lesser(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}

/// The greater of two numbers.
fn greater(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

#[cfg(test)]
mod tests {
    use kurbo::{Circle, Point, Rect, Shape as _};

    use super::{Kind, LEADER_OF_POINT, Placed, Placer, gap, text_area};
    use crate::font::{Anchor, SMALL};

    const PAGE: Rect = Rect::new(0.0, 0.0, 200.0, 200.0);

    fn symbol(at: Point) -> Rect {
        Rect::from_center_size(at, (14.0, 14.0))
    }

    /// The labels of points with symbols, in the order of the points.
    fn placed(points: &[(Point, &str)], bounds: Rect) -> Vec<(Placed, Rect)> {
        let mut placer = Placer::default();
        for (at, text) in points {
            placer.protect(symbol(*at));
            placer.label_of_point(*at, text, "black");
        }
        let placed = placer.place(bounds).into_iter();
        placed
            .map(|label| {
                let area = text_area(label.base, &label.text, SMALL, Anchor::Start);
                (label, area)
            })
            .collect()
    }

    fn overlap(one: Rect, other: Rect) -> bool {
        one.intersect(other).area() > 0.0
    }

    /// Six points on one spot in a corner of the page: the labels have to avoid it, each other and the edge.
    #[test]
    fn labels_of_a_crowd_stay_apart_and_inside() {
        let at = Point::new(12.0, 12.0);
        let labels = placed(&[(at, "12"); 6], PAGE);
        assert_eq!(labels.len(), 6);
        for (i, (_, area)) in labels.iter().enumerate() {
            assert_eq!(PAGE.union(*area), PAGE, "{area:?}");
            assert!(!overlap(*area, symbol(at)));
            assert!(labels[..i].iter().all(|(_, other)| !overlap(*area, *other)));
        }
    }

    #[test]
    fn a_lone_label_is_beside_its_point_without_a_line() {
        let at = Point::new(100.0, 100.0);
        let [(label, area)] = &placed(&[(at, "7")], PAGE)[..] else { panic!() };
        assert!(label.leader.is_none() && gap(at, *area) < LEADER_OF_POINT, "{area:?}");
    }

    /// Pairs of points at every distance and in every direction, as on a dial: each label is nearer to its
    /// own point, or has a leader to it.
    #[test]
    fn it_is_plain_which_point_a_label_names() {
        let mut lines = 0;
        let middle = Point::new(100.0, 100.0);
        for x in -10..=10 {
            for y in -10..=10 {
                let other = middle + kurbo::Vec2::new(f64::from(x), f64::from(y)) * 2.3;
                if (other - middle).hypot() < 1.5 {
                    continue;
                }
                let points = [(middle, "10"), (other, "7"), (Point::new(150.0, 100.0), "8")];
                for ((own, _), (label, area)) in points.iter().zip(placed(&points, PAGE)) {
                    let nearest =
                        points.iter().map(|(point, _)| gap(*point, area)).fold(f64::INFINITY, f64::min);
                    match label.leader {
                        Some(line) => {
                            lines += 1;
                            assert_eq!(line.p0, *own, "{points:?}");
                        }
                        None => assert!(gap(*own, area) <= nearest, "{points:?}: {area:?}"),
                    }
                    let covers = points.iter().any(|(point, _)| overlap(area, symbol(*point)));
                    assert!(!covers, "{points:?}: {area:?}");
                }
            }
        }
        assert!(lines > 0);
    }

    /// At every few pixels, each of the three lines of a histogram, whose labels only have room above them.
    #[test]
    fn three_labels_have_room_above_their_lines() {
        let room = Rect::new(72.0, 100.0, 920.0, 174.0);
        let ends = || (0..=16_u8).map(|step| 72.0 + 53.0 * f64::from(step));
        for low in ends() {
            for central in ends().chain([low + 3.0, low + 40.0]) {
                for high in ends().chain([low + 2.0, central + 30.0]).filter(|high| *high >= low) {
                    let points = [
                        (low, "2.5 %: 1,234,567"),
                        (central, "central: 1,234,567"),
                        (high, "97.5 %: 1,234,567"),
                    ]
                    .map(|(x, text)| (Point::new(x.min(920.0), 174.0), text));
                    let labels = placed(&points, room);
                    for (i, (label, area)) in labels.iter().enumerate() {
                        assert_eq!(room.union(*area), room, "{low} {central} {high}: {}", label.text);
                        let apart = labels[..i].iter().all(|(_, other)| !overlap(*area, *other));
                        assert!(apart, "{low} {central} {high}: {}", label.text);
                    }
                }
            }
        }
    }

    /// A ring of arrowheads where the label would otherwise be placed.
    #[test]
    fn a_label_of_any_kind_covers_no_head_of_an_arrow() {
        let at = Point::new(100.0, 100.0);
        let around = [
            (-1.0, -1.0),
            (0.0, -1.0),
            (1.0, -1.0),
            (-1.0, 0.0),
            (1.0, 0.0),
            (-1.0, 1.0),
            (0.0, 1.0),
            (1.0, 1.0),
        ];
        let heads = around.map(|(x, y)| symbol(at + kurbo::Vec2::new(x, y) * 16.0));
        for kind in [Kind::Anywhere, Kind::BesideOutlines, Kind::OfPoint] {
            let mut placer = Placer::default();
            for head in heads {
                placer.protect(head);
            }
            placer.add(at, "10", "black", kind);
            let label = &placer.place(PAGE)[0];
            let area = text_area(label.base, &label.text, SMALL, Anchor::Start);
            assert!(heads.iter().all(|head| !overlap(area, *head)), "{kind:?}: {area:?}");
        }
    }

    /// A search that gives up on a place early finds the same place: below the limit, the cost equals the
    /// cost without a limit to the last bit; from the limit on, there is none.
    #[test]
    fn a_limit_changes_no_cost() {
        let mut placer = Placer::default();
        placer.protect(symbol(Point::new(60.0, 60.0)));
        placer.taken(Rect::new(120.0, 40.0, 180.0, 60.0));
        placer.block(Point::new(0.0, 100.0), Point::new(200.0, 30.0), 0.4);
        placer.block(Point::new(30.0, 0.0), Point::new(90.0, 200.0), 1.1);
        placer.keep_off(&Circle::new((100.0, 140.0), 30.0).to_path(0.01), true);
        let mut costs = Vec::new();
        for x in 0..20 {
            for y in 0..20 {
                let centre = Point::new(f64::from(x) * 10.0, f64::from(y) * 10.0);
                let area = Rect::from_center_size(centre, (40.0, 16.0));
                let cost = |limit| placer.cost(area, PAGE, Kind::Anywhere, 1.7, limit);
                let whole = cost(f64::INFINITY).unwrap();
                costs.push(whole);
                for limit in [0.0, 1.0, 1.7, 3.0, 10.0, 30.0, 203.0, 1e4, 1e6, 2e6, whole] {
                    assert_eq!(cost(limit), (whole < limit).then_some(whole), "{area} below {limit}");
                }
            }
        }
        costs.sort_by(f64::total_cmp);
        costs.dedup();
        assert!(costs.len() > 50, "{costs:?}");
    }

    #[test]
    fn a_line_without_end_is_no_obstacle() {
        let mut placer = Placer::default();
        placer.block(Point::ORIGIN, Point::new(f64::INFINITY, 0.0), 1.0);
        placer.label(Point::new(100.0, 100.0), "7", "black");
        assert_eq!(placer.place(PAGE).len(), 1);
    }
}
