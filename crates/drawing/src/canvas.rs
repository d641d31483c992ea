//! A page of shapes and labels, and how it becomes SVG.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use kurbo::{BezPath, PathEl, Point, Rect, Vec2};

use crate::font::{self, Anchor, SMALL};
use crate::labels::{self, Placer};
use crate::number::{px, significant};
use crate::pens::{BLACK, GREY, Pen, WHITE};
use crate::site_plan::Backdrop;

/// The head of an arrow.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Head {
    /// A filled triangle.
    Filled,
    /// Two strokes.
    Open,
}

#[derive(Clone, Debug)]
pub(crate) struct Canvas {
    pub(crate) width: f64,
    /// (px) height of the page below the origin.
    pub(crate) height: f64,
    /// (px) height of the page above the origin.
    pub(crate) above: f64,
    pub(crate) prefix: &'static str,
    /// Behind everything.
    pub(crate) backdrop: Option<Backdrop>,
    pub(crate) body: String,
    pub(crate) labels: Placer,
    /// Characters written that are missing from the font.
    pub(crate) missing: BTreeSet<char>,
}

impl Canvas {
    /// An empty page of the given width (px); the `id`s of its shapes begin with `prefix`.
    pub(crate) fn new(prefix: &'static str, width: f64) -> Self {
        let (body, labels, missing) = (String::new(), Placer::default(), BTreeSet::new());
        Self { width, height: 0.0, above: 0.0, prefix, backdrop: None, body, labels, missing }
    }

    /// The bounds of the whole page (px).
    pub(crate) fn page(&self) -> Rect {
        Rect::new(0.0, -self.above, self.width, self.height)
    }

    pub(crate) fn element(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    fn id(&self, id: &str) -> String {
        if id.is_empty() { String::new() } else { format!(" id=\"{}-{id}\"", self.prefix) }
    }

    /// Defines a stripe pattern for [`pattern`](Self::pattern): stripes distinguish areas even without
    /// colour. The ground is a colour or `none`.
    pub(crate) fn define_stripes(&mut self, name: &str, colour: &str, ground: &str, degrees: i32, gap: f64) {
        let id = self.id(name);
        self.element(&format!(
            "<defs><pattern{id} width=\"{0}\" height=\"{0}\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate({degrees})\">\
             <rect width=\"{0}\" height=\"{0}\" fill=\"{ground}\"/><rect width=\"{1}\" height=\"{0}\" fill=\"{colour}\"/></pattern></defs>",
            px(gap),
            px(gap / 3.0)
        ));
    }

    /// The fill for a pattern of this name.
    pub(crate) fn pattern(&self, name: &str) -> String {
        format!("url(#{}-{name})", self.prefix)
    }

    pub(crate) fn line(&mut self, id: &str, a: Point, b: Point, pen: Pen) {
        self.labels.block(a, b, 1.0);
        self.stroked(id, a, b, pen);
    }

    /// A grid line, which labels need not avoid.
    pub(crate) fn grid(&mut self, a: Point, b: Point, pen: Pen) {
        self.stroked("", a, b, pen);
    }

    fn stroked(&mut self, id: &str, a: Point, b: Point, pen: Pen) {
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

    /// An arrow from `a` to `b`. Its line carries the id and reaches to the very tip.
    pub(crate) fn arrow(&mut self, id: &str, a: Point, b: Point, pen: Pen, head: Head) {
        self.labels.block(a, b, 4.0);
        let along = b - a;
        let length = along.hypot();
        let direction = if length > 0.0 { along / length } else { Vec2::new(1.0, 0.0) };
        let across = Vec2::new(-direction.y, direction.x);
        let size = (6.0 + 2.0 * pen.width).min(length);
        let (left, right) =
            (b - direction * size + across * (size * 0.4), b - direction * size - across * (size * 0.4));
        self.labels.protect(Rect::from_points(left, right).union_pt(b));
        let id = self.id(id);
        let (end, tip) = match head {
            Head::Filled => {
                // A thick line would be blunt at the tip: it ends inside the head, which is drawn over it.
                let neck = b - direction * (size * 0.6);
                let corners = [b, left, right].map(pair);
                (neck, format!("<path d=\"M{}Z\" fill=\"{}\"/>", corners.join("L"), pen.colour))
            }
            Head::Open => {
                let solid = Pen { dashes: "", ..pen };
                let corners = [left, b, right].map(pair);
                (b, format!("<path d=\"M{}\"{} fill=\"none\"/>", corners.join("L"), stroke(solid)))
            }
        };
        let [from, to, end] = [a, b, end].map(pair);
        self.element(&format!(
            "<g{id} data-from=\"{from}\" data-to=\"{to}\"><path d=\"M{from}L{end}\"{} fill=\"none\"/>{tip}</g>",
            stroke(pen)
        ));
    }

    /// A scale bar with ticks at both ends that represents `si` (in SI units).
    pub(crate) fn scale(&mut self, id: &str, a: Point, b: Point, si: f64, pen: Pen) {
        self.labels.block(a, b, 10.0);
        let id = self.id(id);
        let tick = Vec2::new(0.0, 5.0);
        let ends = [a, b].map(|end| format!("M{}L{}", pair(end - tick), pair(end + tick)));
        let [from, to] = [a, b].map(pair);
        self.element(&format!(
            "<g{id} data-from=\"{from}\" data-to=\"{to}\" data-si=\"{}\"><path d=\"{}{}M{from}L{to}\"{} fill=\"none\"/></g>",
            significant(si, 6),
            ends[0], ends[1],
            stroke(pen)
        ));
    }

    pub(crate) fn path(&mut self, id: &str, path: &BezPath, pen: Option<Pen>, fill: &str) {
        if let Some(pen) = pen {
            let mut last = None;
            for element in flattened(path) {
                if let Some(from) = last.replace(element) {
                    self.labels.block(from, element, pen.width * 0.25);
                }
            }
        }
        let id = self.id(id);
        let line = pen.map(stroke).unwrap_or_default();
        self.element(&format!("<path{id} d=\"{}\"{line} fill=\"{fill}\"/>", data(path)));
    }

    pub(crate) fn rect(&mut self, id: &str, area: Rect, pen: Option<Pen>, fill: &str) {
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

    pub(crate) fn dot(&mut self, id: &str, at: Point, radius: f64, pen: Option<Pen>, fill: &str) {
        self.labels.avoid(Rect::from_center_size(at, (2.0 * radius + 2.0, 2.0 * radius + 2.0)), 30.0);
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
    pub(crate) fn centre_of_gravity(&mut self, id: &str, at: Point) {
        const RADIUS: f64 = 6.0;
        self.dot(id, at, RADIUS, Some(Pen { colour: BLACK, width: 1.2, dashes: "" }), WHITE);
        self.labels.protect(Rect::from_center_size(at, (2.0 * RADIUS, 2.0 * RADIUS)));
        let (x, y, r) = (px(at.x), px(at.y), px(RADIUS));
        let (left, right) = (px(at.x - RADIUS), px(at.x + RADIUS));
        self.element(&format!(
            "<path d=\"M{x} {y}L{right} {y}A{r} {r} 0 0 0 {x} {}ZM{x} {y}L{left} {y}A{r} {r} 0 0 0 {x} {}Z\" fill=\"{BLACK}\"/>",
            px(at.y - RADIUS),
            px(at.y + RADIUS)
        ));
    }

    /// A text anchored at a point on its baseline.
    pub(crate) fn text(&mut self, at: Point, text: &str, size: f64, anchor: Anchor, colour: &str) {
        self.labels.taken(labels::text_area(at, text, size, anchor));
        self.write(at, text, size, anchor, colour);
    }

    fn write(&mut self, at: Point, text: &str, size: f64, anchor: Anchor, colour: &str) {
        self.missing.extend(font::missing(text));
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let place = format!("x=\"{}\" y=\"{}\" font-size=\"{}\"{anchor}", px(at.x), px(at.y), px(size));
        let text = escaped(text);
        // The white rim keeps letters legible where a line runs below them. It is a text of its own, because
        // word processors do not know `paint-order`.
        self.element(&format!(
            "<text {place} aria-hidden=\"true\" fill=\"{WHITE}\" stroke=\"{WHITE}\" stroke-width=\"3\" \
             stroke-linejoin=\"round\">{text}</text>"
        ));
        self.element(&format!("<text {place} fill=\"{colour}\">{text}</text>"));
    }

    /// Places all labels inside `bounds` ([`Placer::place`]).
    pub(crate) fn place_labels(&mut self, bounds: Rect) {
        for label in self.labels.place(bounds) {
            if let Some(leader) = label.leader {
                self.grid(leader.p0, leader.p1, Pen { colour: GREY, width: 0.8, dashes: "" });
            }
            self.write(label.base, &label.text, SMALL, Anchor::Start, label.colour);
        }
    }
}

fn pair(point: Point) -> String {
    format!("{} {}", px(point.x), px(point.y))
}

fn stroke(Pen { colour, width, dashes }: Pen) -> String {
    let dashes = if dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dashes}\"") };
    format!(" stroke=\"{colour}\" stroke-width=\"{}\"{dashes}", px(width))
}

fn data(path: &BezPath) -> String {
    let mut data = String::new();
    let mut put = |letter: &str, points: &[Point]| {
        data.push_str(letter);
        for (i, point) in points.iter().enumerate() {
            let blank = if i == 0 { "" } else { " " };
            // Writing to a string does not fail.
            let _ = write!(data, "{blank}{}", pair(*point));
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

/// The corners of a path, with its curves as a few chords.
fn flattened(path: &BezPath) -> Vec<Point> {
    let mut points = Vec::new();
    let mut start = None;
    kurbo::flatten(path.iter(), 1.0, |element| match element {
        PathEl::MoveTo(point) => {
            start = Some(point);
            points.push(point);
        }
        PathEl::LineTo(point) => points.push(point),
        _ => points.extend(start),
    });
    points
}

/// A text escaped for XML, without the characters that XML cannot hold.
pub(crate) fn escaped(text: &str) -> String {
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
