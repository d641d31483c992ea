//! A page of shapes and labels, and how it becomes SVG.

use std::fmt::Write as _;

use kurbo::{BezPath, Line, PathEl, Point, Rect, Shape as _, Vec2};

use super::font;
use super::pens::{BLACK, GREY, Pen, WHITE};

/// (px) letters of labels.
pub(super) const SMALL: f64 = 13.0;
/// (px) letters of headings.
pub(super) const LARGE: f64 = 17.0;
/// Height of a line of text over the size of its letters.
const LINE: f64 = 1.25;
/// Share of a line above the base of its letters.
const ASCENT: f64 = 0.97;
/// (px) how far a label's line reaches before it is drawn.
const LEADER: f64 = 26.0;
/// (px) pieces of a line that labels keep clear of.
const PIECE: f64 = 6.0;

/// What a label costs that leaves the page, covers another, or covers a point that a reader looks for: so much that any other place is better.
const OFF_PAGE: f64 = 1e6;
const ON_TEXT: f64 = 1e5;
const ON_POINT: f64 = 1e4;
/// What it costs to lie on an area that it should keep off, where a place at the nearest point costs nothing and one 10 px away 6.
const ON_AREA: f64 = 200.0;
/// What it costs that a label's line crosses that of another, and a piece of anything else.
const CROSSING: f64 = 60.0;
const CROSSED: f64 = 0.5;

/// The head of an arrow.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Head {
    /// A filled triangle.
    Filled,
    /// Two strokes.
    Open,
}

/// Which point of a text is given.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A label that has yet to find its place.
#[derive(Clone, Debug)]
struct Label {
    at: Point,
    text: String,
    colour: &'static str,
    /// It may stand on an outline.
    inside: bool,
}

/// An area that labels keep off.
#[derive(Clone, Debug)]
struct Area {
    path: BezPath,
    /// All of them, and not only those that are to stand beside the outlines.
    all: bool,
}

/// Something that labels should not cover.
#[derive(Clone, Copy, Debug)]
struct Obstacle {
    area: Rect,
    weight: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Canvas {
    width: f64,
    height: f64,
    prefix: &'static str,
    body: String,
    labels: Vec<Label>,
    texts: Vec<Rect>,
    obstacles: Vec<Obstacle>,
    /// Heads of arrows, and what else no label covers.
    points: Vec<Rect>,
    areas: Vec<Area>,
    /// From labels to their points.
    leaders: Vec<Line>,
}

impl Canvas {
    /// (px) of the given size; the `id`s of its shapes begin with `prefix`.
    pub(super) fn new(prefix: &'static str, width: f64, height: f64) -> Self {
        let mut canvas = Self {
            width,
            height,
            prefix,
            body: String::new(),
            labels: Vec::new(),
            texts: Vec::new(),
            obstacles: Vec::new(),
            points: Vec::new(),
            areas: Vec::new(),
            leaders: Vec::new(),
        };
        canvas.element(&format!(
            "<rect width=\"{}\" height=\"{}\" fill=\"{WHITE}\"/>",
            px(width),
            px(height)
        ));
        canvas
    }

    pub(super) fn size(&self) -> (f64, f64) {
        (self.width, self.height)
    }

    pub(super) fn body(&self) -> &str {
        &self.body
    }

    pub(super) fn element(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    fn id(&self, id: &str) -> String {
        if id.is_empty() { String::new() } else { format!(" id=\"{}-{id}\"", self.prefix) }
    }

    /// A stripe pattern, named for [`pattern`](Self::pattern): what colour says, in grey as well.
    pub(super) fn define_stripes(&mut self, name: &str, colour: &str, ground: &str, degrees: i32, gap: f64) {
        let id = self.id(name);
        self.element(&format!(
            "<defs><pattern{id} width=\"{0}\" height=\"{0}\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate({degrees})\">\
             <rect width=\"{0}\" height=\"{0}\" fill=\"{ground}\"/><rect width=\"{1}\" height=\"{0}\" fill=\"{colour}\"/></pattern></defs>",
            px(gap),
            px(gap / 3.0)
        ));
    }

    /// A fill by name.
    pub(super) fn pattern(&self, name: &str) -> String {
        format!("url(#{}-{name})", self.prefix)
    }

    /// Labels keep off the line from `a` to `b`, the more the greater the weight.
    fn block(&mut self, a: Point, b: Point, weight: f64) {
        let length = (b - a).hypot();
        let mut done = 0.0;
        while done <= length {
            let at = if length > 0.0 { a + (b - a) * (done / length) } else { a };
            self.obstacles.push(Obstacle { area: Rect::from_center_size(at, (PIECE, PIECE)), weight });
            done += PIECE;
        }
    }

    pub(super) fn line(&mut self, id: &str, a: Point, b: Point, pen: Pen) {
        self.block(a, b, 1.0);
        let id = self.id(id);
        self.element(&format!(
            "<line{id} x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>",
            px(a.x),
            px(a.y),
            px(b.x),
            px(b.y),
            stroke(pen)
        ));
    }

    /// A line that no label has to avoid: a grid.
    pub(super) fn grid(&mut self, a: Point, b: Point, pen: Pen) {
        self.element(&format!(
            "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>",
            px(a.x),
            px(a.y),
            px(b.x),
            px(b.y),
            stroke(pen)
        ));
    }

    /// An arrow from `a` to `b`. Its line carries the id and reaches to the very tip.
    pub(super) fn arrow(&mut self, id: &str, a: Point, b: Point, pen: Pen, head: Head) {
        self.block(a, b, 4.0);
        let along = b - a;
        let length = along.hypot();
        let direction = if length > 0.0 { along / length } else { Vec2::new(1.0, 0.0) };
        let across = Vec2::new(-direction.y, direction.x);
        let size = (6.0 + 2.0 * pen.width).min(length);
        let (left, right) =
            (b - direction * size + across * (size * 0.4), b - direction * size - across * (size * 0.4));
        self.protect(Rect::from_points(left, right).union_pt(b));
        let id = self.id(id);
        let (end, tip) = match head {
            Head::Filled => {
                // A thick line would be blunt at the tip: it ends inside of the head, which is drawn over it.
                let neck = b - direction * (size * 0.6);
                let corners = [b, left, right].map(|corner| format!("{} {}", px(corner.x), px(corner.y)));
                (neck, format!("<path d=\"M{}Z\" fill=\"{}\"/>", corners.join("L"), pen.colour))
            }
            Head::Open => {
                let solid = Pen { dashes: "", ..pen };
                let corners = [left, b, right].map(|corner| format!("{} {}", px(corner.x), px(corner.y)));
                (b, format!("<path d=\"M{}\"{} fill=\"none\"/>", corners.join("L"), stroke(solid)))
            }
        };
        let [from, to, end] = [a, b, end].map(|point| format!("{} {}", px(point.x), px(point.y)));
        self.element(&format!(
            "<g{id} data-from=\"{from}\" data-to=\"{to}\"><path d=\"M{from}L{end}\"{} fill=\"none\"/>{tip}</g>",
            stroke(pen)
        ));
    }

    /// A bar with ticks at both ends that stands for `si` (in SI units).
    pub(super) fn scale(&mut self, id: &str, a: Point, b: Point, si: f64, pen: Pen) {
        self.block(a, b, 10.0);
        let id = self.id(id);
        let tick = Vec2::new(0.0, 5.0);
        let ends = [a, b].map(|end| {
            let (top, bottom) = (end - tick, end + tick);
            format!("M{} {}L{} {}", px(top.x), px(top.y), px(bottom.x), px(bottom.y))
        });
        self.element(&format!(
            "<g{id} data-from=\"{} {}\" data-to=\"{} {}\" data-si=\"{}\"><path d=\"{}{}M{} {}L{} {}\"{} fill=\"none\"/></g>",
            px(a.x), px(a.y), px(b.x), px(b.y),
            crate::units::significant(si, 6),
            ends[0], ends[1],
            px(a.x), px(a.y), px(b.x), px(b.y),
            stroke(pen)
        ));
    }

    pub(super) fn path(&mut self, id: &str, path: &BezPath, pen: Option<Pen>, fill: &str) {
        if let Some(pen) = pen {
            let mut last = None;
            for element in path.flatten_to_lines() {
                if let Some(from) = last.replace(element) {
                    self.block(from, element, pen.width * 0.25);
                }
            }
        }
        let id = self.id(id);
        let line = pen.map(stroke).unwrap_or_default();
        self.element(&format!("<path{id} d=\"{}\"{line} fill=\"{fill}\"/>", data(path)));
    }

    pub(super) fn rect(&mut self, id: &str, area: Rect, pen: Option<Pen>, fill: &str) {
        let id = self.id(id);
        let line = pen.map(stroke).unwrap_or_default();
        self.element(&format!(
            "<rect{id} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{line} fill=\"{fill}\"/>",
            px(area.x0),
            px(area.y0),
            px(area.width()),
            px(area.height())
        ));
    }

    pub(super) fn dot(&mut self, id: &str, at: Point, radius: f64, pen: Option<Pen>, fill: &str) {
        self.obstacles.push(Obstacle {
            area: Rect::from_center_size(at, (2.0 * radius + 2.0, 2.0 * radius + 2.0)),
            weight: 30.0,
        });
        let id = self.id(id);
        let line = pen.map(stroke).unwrap_or_default();
        self.element(&format!(
            "<circle{id} cx=\"{}\" cy=\"{}\" r=\"{}\"{line} fill=\"{fill}\"/>",
            px(at.x),
            px(at.y),
            px(radius)
        ));
    }

    /// A centre of gravity: black and white quarters.
    pub(super) fn centre_of_gravity(&mut self, id: &str, at: Point) {
        const RADIUS: f64 = 6.0;
        self.dot(id, at, RADIUS, Some(Pen { colour: BLACK, width: 1.2, dashes: "" }), WHITE);
        self.protect(Rect::from_center_size(at, (2.0 * RADIUS, 2.0 * RADIUS)));
        let (x, y, r) = (px(at.x), px(at.y), px(RADIUS));
        let (left, right) = (px(at.x - RADIUS), px(at.x + RADIUS));
        self.element(&format!(
            "<path d=\"M{x} {y}L{right} {y}A{r} {r} 0 0 0 {x} {}ZM{x} {y}L{left} {y}A{r} {r} 0 0 0 {x} {}Z\" fill=\"{BLACK}\"/>",
            px(at.y - RADIUS),
            px(at.y + RADIUS)
        ));
    }

    /// A text at a given place on its base line.
    pub(super) fn text(&mut self, at: Point, text: &str, size: f64, anchor: Anchor, colour: &str) {
        let width = font::width(text, size);
        let left = match anchor {
            Anchor::Start => at.x,
            Anchor::Middle => at.x - width / 2.0,
            Anchor::End => at.x - width,
        };
        let top = at.y - ASCENT * size;
        self.texts.push(Rect::new(left, top, left + width, top + LINE * size));
        self.write(at, text, size, anchor, colour);
    }

    fn write(&mut self, at: Point, text: &str, size: f64, anchor: Anchor, colour: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        // The white rim keeps letters legible where a line runs below them.
        self.element(&format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\"{anchor} fill=\"{colour}\" stroke=\"{WHITE}\" stroke-width=\"3\" \
             stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>",
            px(at.x),
            px(at.y),
            px(size),
            escaped(text)
        ));
    }

    /// No label covers this.
    pub(super) fn protect(&mut self, area: Rect) {
        self.points.push(area);
    }

    /// Labels keep off an area: those of [`label_beside`](Self::label_beside), or all of them.
    pub(super) fn keep_off(&mut self, path: &BezPath, all: bool) {
        self.areas.push(Area { path: path.clone(), all });
    }

    /// A text that belongs to a point; [`place_labels`](Self::place_labels) finds it a place nearby.
    pub(super) fn label(&mut self, at: Point, text: &str, colour: &'static str) {
        self.labels.push(Label { at, text: text.to_owned(), colour, inside: true });
    }

    /// The same beside all outlines, with a line to the point.
    pub(super) fn label_beside(&mut self, at: Point, text: &str, colour: &'static str) {
        self.labels.push(Label { at, text: text.to_owned(), colour, inside: false });
    }

    /// Places all labels inside of `bounds`, in the order in which they were given: each where it covers no other text and the least of the lines,
    /// as near to its point as that allows.
    pub(super) fn place_labels(&mut self, bounds: Rect) {
        for Label { at, text, colour, inside } in std::mem::take(&mut self.labels) {
            let size = (font::width(&text, SMALL), LINE * SMALL);
            let mut best = (f64::INFINITY, at);
            for centre in candidates(at, size) {
                let area = Rect::from_center_size(centre, size).inflate(5.0, 1.0);
                let far = 0.6 * gap(at, area);
                // Most places are too far to be better, whatever lies there.
                if far >= best.0 {
                    continue;
                }
                let mut cost = self.cost(area, bounds, inside) + far;
                if cost < best.0
                    && let Some(line) = leader(at, Rect::from_center_size(centre, size))
                {
                    cost += self.cost_of_leader(line);
                }
                if cost < best.0 {
                    best = (cost, centre);
                }
            }
            let area = Rect::from_center_size(best.1, size);
            if let Some(line) = leader(at, area) {
                self.leaders.push(line);
                self.line("", line.p0, line.p1, Pen { colour: GREY, width: 0.8, dashes: "" });
            }
            let base = Point::new(area.x0, area.y0 + ASCENT * SMALL);
            self.text(base, &text, SMALL, Anchor::Start, colour);
        }
    }

    fn cost(&self, area: Rect, bounds: Rect, inside: bool) -> f64 {
        let off_page = if bounds.union(area) == bounds { 0.0 } else { OFF_PAGE };
        let covers = |other: &Rect| area.intersect(*other).area() > 0.0;
        let texts = count(self.texts.iter().filter(|other| covers(other))) * ON_TEXT;
        let points = count(self.points.iter().filter(|other| covers(other))) * ON_POINT;
        let kept_off = self.areas.iter().filter(|other| other.all || !inside);
        let areas = count(kept_off.filter(|other| other.is_under(area))) * ON_AREA;
        let lines: f64 = self
            .obstacles
            .iter()
            .filter(|obstacle| covers(&obstacle.area))
            .map(|obstacle| obstacle.weight)
            .sum();
        off_page + texts + points + areas + 6.0 * lines
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
        // It ends on what it belongs to.
        let points = self.points.iter().filter(|point| !point.inflate(1.0, 1.0).contains(line.p0));
        let points = count(points.filter(|point| cuts(line, **point)));
        let crossed = self.obstacles.iter().filter(|obstacle| cuts(line, obstacle.area));
        let crossed: f64 = crossed.map(|obstacle| obstacle.weight).sum();
        texts * ON_POINT + points * ON_AREA + leaders * CROSSING + crossed * CROSSED
    }
}

impl Area {
    /// As far as points every few pixels of the label tell.
    fn is_under(&self, label: Rect) -> bool {
        const STEPS: i32 = 8;
        (0..=STEPS).any(|step| {
            let x = label.x0 + label.width() * f64::from(step) / f64::from(STEPS);
            [label.y0, label.center().y, label.y1].iter().any(|&y| self.path.contains(Point::new(x, y)))
        })
    }
}

fn count<T>(iterator: impl Iterator<Item = T>) -> f64 {
    iterator.fold(0.0, |count, _| count + 1.0)
}

/// From a point to the label that belongs to it, where that is not beside it.
fn leader(at: Point, label: Rect) -> Option<Line> {
    let nearest = Point::new(at.x.clamp(label.x0, label.x1), at.y.clamp(label.y0, label.y1));
    (gap(at, label) > LEADER).then_some(Line::new(at, nearest))
}

/// Whether a line goes through an area.
fn cuts(Line { p0, p1 }: Line, area: Rect) -> bool {
    let along = p1 - p0;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    // The parts of the line between the two edges in x, and in y, have to have something in common (Liang and Barsky).
    for (from, along, low, high) in [(p0.x, along.x, area.x0, area.x1), (p0.y, along.y, area.y0, area.y1)] {
        if along == 0.0 {
            if from < low || from > high {
                return false;
            }
            continue;
        }
        let ends = [(low - from) / along, (high - from) / along];
        first = first.max(ends[0].min(ends[1]));
        last = last.min(ends[0].max(ends[1]));
    }
    first <= last
}

/// Where the middle of a label may lie: around its point, nearer places first.
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
    let (dx, dy) =
        ((area.x0 - at.x).max(at.x - area.x1).max(0.0), (area.y0 - at.y).max(at.y - area.y1).max(0.0));
    (dx * dx + dy * dy).sqrt()
}

fn stroke(Pen { colour, width, dashes }: Pen) -> String {
    let dashes = if dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dashes}\"") };
    format!(" stroke=\"{colour}\" stroke-width=\"{}\"{dashes}", px(width))
}

/// Two decimals, as few as are needed.
pub(super) fn px(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn data(path: &BezPath) -> String {
    let mut data = String::new();
    let mut put = |letter: &str, points: &[Point]| {
        data.push_str(letter);
        for (i, point) in points.iter().enumerate() {
            let blank = if i == 0 { "" } else { " " };
            // Writing to a string does not fail.
            let _ = write!(data, "{blank}{} {}", px(point.x), px(point.y));
        }
    };
    for element in path {
        match element {
            PathEl::MoveTo(a) => put("M", &[a]),
            PathEl::LineTo(a) => put("L", &[a]),
            PathEl::QuadTo(a, b) => put("Q", &[a, b]),
            PathEl::CurveTo(a, b, c) => put("C", &[a, b, c]),
            PathEl::ClosePath => put("Z", &[]),
        }
    }
    data
}

/// The corners of a path, its curves as a few chords.
trait Flatten {
    fn flatten_to_lines(&self) -> Vec<Point>;
}

impl Flatten for BezPath {
    fn flatten_to_lines(&self) -> Vec<Point> {
        let mut points = Vec::new();
        let mut start = None;
        kurbo::flatten(self.iter(), 1.0, |element| match element {
            PathEl::MoveTo(point) => {
                start = Some(point);
                points.push(point);
            }
            PathEl::LineTo(point) => points.push(point),
            _ => points.extend(start),
        });
        points
    }
}

/// A text as XML has to have it. Characters that XML cannot hold are left out.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            control if control.is_control() || matches!(control, '\u{fffe}' | '\u{ffff}') => {}
            letter => out.push(letter),
        }
    }
    out
}
