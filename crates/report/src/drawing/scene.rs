//! The scene: both vehicles at impact, seen from above.

use analysis::{Analysis, Impact};
use case::{Axes, Case};
use kurbo::{Affine, BezPath, Point, Rect, Vec2};

use super::canvas::{Anchor, Canvas, Head, SMALL};
use super::legend::{self, EDGE, HEADER, Sample, WIDTH};
use super::pens::{
    AFTER, AXIS, BEFORE, BLACK, FILL, GREY, HEADING, IMPULSE, OUTLINE, PALE, PDOF, PLANE, Pen, THIN,
};
use super::vehicle::{Body, Outline, placed};
use super::{Drawing, DrawingError, Subject, font};
use crate::Units;
use crate::axes;
use crate::units::Quantity;

/// (px) height of what is drawn, below the title.
const SCENE: f64 = 520.0;
/// (px) of the fastest velocity.
const FASTEST: f64 = 150.0;
/// (px) of the impulse, and of the PDOF.
const IMPULSE_LENGTH: f64 = 120.0;
const PDOF_LENGTH: f64 = 95.0;
/// (px) of n and t.
const AXES: f64 = 52.0;
/// (px) radius of C.
const CONTACT: f64 = 4.5;
/// (px) white around the outermost point, for labels.
const MARGIN: f64 = 34.0;
/// (px/m) the largest scale: a small vehicle does not fill the page.
const LARGEST: f64 = 130.0;
/// (m) how far the wall that stands for a fixed object without an outline reaches beyond the vehicle at it, and its thickness.
const WALL: f64 = 0.7;
const WALL_DEPTH: f64 = 0.5;
/// (m/s) below this there is no arrow.
const SLOWEST: f64 = 1e-6;

/// A vehicle in the scene; lengths in metres from C, y upwards.
struct Placed {
    body: Option<Body>,
    cg: Vec2,
    forward: Vec2,
    fixed: bool,
}

fn vec2(v: pim_core::Vector2<f64>) -> Vec2 {
    Vec2::new(v.x, v.y)
}

/// From the scene (m, y upwards) to the page (px, y downwards), without the origin.
fn flipped(v: Vec2) -> Vec2 {
    Vec2::new(v.x, -v.y)
}

fn unit(v: Vec2) -> Vec2 {
    let length = v.hypot();
    if length > 0.0 { v / length } else { Vec2::new(1.0, 0.0) }
}

pub(super) fn draw(case: &Case, analysis: &Analysis, units: Units) -> Result<Drawing, DrawingError> {
    let impact = analysis.impact.as_ref().ok_or(DrawingError::NoImpact { subject: Subject::Scene })?;
    let scene = [0, 1].map(|i| {
        let participant = &impact.contact.participants()[i];
        Placed {
            body: Body::of(&analysis.vehicles[i]),
            // r points from the CG to C, which is the origin.
            cg: -vec2(participant.arm()),
            forward: vec2(participant.forward()),
            fixed: participant.body().is_fixed(),
        }
    });
    let outcome = &impact.outcome;
    let fastest = outcome
        .before
        .iter()
        .chain(&outcome.after)
        .map(|motion| vec2(motion.velocity).hypot())
        .fold(SLOWEST, f64::max);
    let per_speed = FASTEST / fastest;
    let arrows = Arrows { impact, per_speed };
    let (scale, origin) = fit(&scene, &arrows);

    let bar_row = HEADER + SCENE + 30.0;
    #[expect(clippy::cast_precision_loss, reason = "a legend has few entries")]
    let rows = (7 + scene.len() + body_entries(&scene).len()).div_ceil(3) as f64;
    let height = bar_row + 22.0 + 24.0 * (rows + 0.5) + 10.0;
    let canvas = Canvas::new(Subject::Scene.name(), WIDTH, height);
    let mut page = Page { canvas, units, axes: case.axes, scale, origin, wall: wall_ends(&scene, impact) };
    let title = case.title.as_deref().unwrap_or("Untitled case");
    legend::header(&mut page.canvas, title, "Plan view at impact, to scale");
    // The bodies lie over each other: all areas first, so that no edge is hidden.
    for (i, placed) in scene.iter().enumerate() {
        page.area(placed, impact, i);
    }
    page.plane(impact);
    for (i, placed) in scene.iter().enumerate() {
        page.edge(placed, i);
    }
    page.axes(impact);
    // Before the other values: it has the fewest places, as its arrow is mostly over both vehicles.
    page.name_impulse(impact);
    for (i, placed) in scene.iter().enumerate().filter(|(_, placed)| !placed.fixed) {
        page.vehicle(placed, &arrows, i);
    }
    page.impulse(impact);
    for (i, placed) in scene.iter().enumerate() {
        page.name(case, impact, placed, i);
    }
    page.frame();
    page.canvas.place_labels(area());
    page.scales(bar_row, &arrows);
    let entries = page.entries(&scene);
    legend::legend(&mut page.canvas, bar_row + 22.0, 3, &entries);
    Ok(Drawing::new(
        Subject::Scene,
        format!("{title}: plan view at impact"),
        description(case, analysis.in_axes(case.axes).impact.as_ref().unwrap_or(impact), units),
        page.canvas,
    ))
}

/// Where the scene is drawn.
fn area() -> Rect {
    Rect::new(EDGE, HEADER, WIDTH - EDGE, HEADER + SCENE)
}

/// All arrows of the scene, of which only the starting points are to scale.
struct Arrows<'a> {
    impact: &'a Impact,
    /// (px·s/m)
    per_speed: f64,
}

impl Arrows<'_> {
    /// (px, page) from a vehicle's CG: its velocities before and after, and the tail of its PDOF arrow.
    fn of_vehicle(&self, i: usize) -> [Vec2; 3] {
        let outcome = &self.impact.outcome;
        let before = flipped(vec2(outcome.before[i].velocity)) * self.per_speed;
        let after = flipped(vec2(outcome.after[i].velocity)) * self.per_speed;
        [before, after, self.pdof_tail(i)]
    }

    /// From the CG to where the force comes from: the heading, turned clockwise by the PDOF.
    fn pdof_tail(&self, i: usize) -> Vec2 {
        let outcome = &self.impact.outcome;
        let forward = vec2(outcome.forward[i]);
        let (sin, cos) = pim_core::Real::sin_cos(self.impact.pdof[i]);
        let from = Vec2::new(forward.x * cos + forward.y * sin, forward.y * cos - forward.x * sin);
        flipped(from) * PDOF_LENGTH
    }

    /// From C.
    fn impulse(&self) -> Vec2 {
        flipped(unit(vec2(self.impact.outcome.impulse_vector))) * IMPULSE_LENGTH
    }
}

/// The scale (px/m) and the place of C (px) at which everything is on the page.
fn fit(scene: &[Placed; 2], arrows: &Arrows) -> (f64, Point) {
    let room = area().inset(-MARGIN);
    let bounds = |scale: f64| {
        let mut points = vec![arrows.impulse(), Vec2::ZERO];
        let normal = flipped(vec2(arrows.impact.contact.normal()));
        let t = Vec2::new(normal.y, -normal.x);
        // t points to either side, by the axes of the case; the picture is the same.
        points.extend([normal, t, -t].map(|axis| axis * AXES));
        for (i, placed) in scene.iter().enumerate() {
            let cg = flipped(placed.cg) * scale;
            if let Some(body) = &placed.body {
                let there = placed_on_page(placed, Point::ZERO, scale);
                points.extend(body.corners().map(|corner| (there * corner).to_vec2()));
            } else if placed.fixed {
                points.extend(
                    wall(arrows.impact, wall_ends(scene, arrows.impact), i)
                        .map(|corner| flipped(corner) * scale),
                );
            }
            if !placed.fixed {
                points.push(cg);
                points.extend(arrows.of_vehicle(i).map(|arrow| cg + arrow));
            }
        }
        points
            .iter()
            .skip(1)
            .fold(Rect::from_points(points[0].to_point(), points[0].to_point()), |bounds, point| {
                bounds.union_pt(point.to_point())
            })
    };
    let fits = |scale: f64| {
        let bounds = bounds(scale);
        bounds.width() <= room.width() && bounds.height() <= room.height()
    };
    let (mut low, mut high) = (1.0, LARGEST);
    if fits(high) {
        low = high;
    }
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if fits(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let bounds = bounds(low);
    (low, (room.center() - bounds.center()).to_point())
}

fn placed_on_page(placed: &Placed, origin: Point, scale: f64) -> Affine {
    self::placed(placed.forward, origin + flipped(placed.cg) * scale, scale)
}

/// (m) the corners of the wall that stands for a fixed object: on the far side of the crush plane.
fn wall(impact: &Impact, [low, high]: [f64; 2], i: usize) -> [Vec2; 4] {
    let n = vec2(impact.contact.normal());
    let t = Vec2::new(-n.y, n.x);
    // n points from vehicle 2 to vehicle 1.
    let away = if i == 0 { n } else { -n };
    [t * high, t * high + away * WALL_DEPTH, t * low + away * WALL_DEPTH, t * low]
}

/// (m) how far a wall reaches along t from C: beyond the whole of the other vehicle.
fn wall_ends(scene: &[Placed; 2], impact: &Impact) -> [f64; 2] {
    let n = vec2(impact.contact.normal());
    let t = Vec2::new(-n.y, n.x);
    let mut ends = [-WALL, WALL];
    for placed in scene {
        let Some(body) = &placed.body else { continue };
        let left = Vec2::new(-placed.forward.y, placed.forward.x);
        for corner in body.corners() {
            let along = (placed.cg + placed.forward * corner.x + left * corner.y).dot(t);
            ends = [ends[0].min(along - WALL), ends[1].max(along + WALL)];
        }
    }
    ends
}

struct Page {
    canvas: Canvas,
    units: Units,
    /// Of the labels; what is drawn is in those of the engine.
    axes: Axes,
    scale: f64,
    origin: Point,
    /// (m) along t from C, where there is a wall.
    wall: [f64; 2],
}

impl Page {
    fn at(&self, metres: Vec2) -> Point {
        self.origin + flipped(metres) * self.scale
    }

    /// The crush plane, as far as the page goes.
    fn plane(&mut self, impact: &Impact) {
        let n = vec2(impact.contact.normal());
        let t = flipped(Vec2::new(-n.y, n.x));
        let room = area();
        let reach = |direction: Vec2| {
            let mut most = f64::INFINITY;
            for (at, along, low, high) in [
                (self.origin.x, direction.x, room.x0, room.x1),
                (self.origin.y, direction.y, room.y0, room.y1),
            ] {
                if along > 1e-9 {
                    most = most.min((high - at) / along);
                } else if along < -1e-9 {
                    most = most.min((low - at) / along);
                }
            }
            self.origin + direction * most.clamp(0.0, 330.0)
        };
        let (a, b) = (reach(-t), reach(t));
        self.canvas.line("crush-plane", a, b, PLANE);
        self.canvas.label(b, "crush plane", GREY);
    }

    fn area(&mut self, placed: &Placed, impact: &Impact, i: usize) {
        if let Some(body) = &placed.body {
            let there = placed_on_page(placed, self.origin, self.scale);
            let outline = there * body.outline();
            self.canvas.path("", &outline, None, FILL[i]);
            self.canvas.keep_off(&outline, false);
        } else if placed.fixed {
            self.canvas.define_stripes("wall", GREY, PALE, 45, 8.0);
            let mut path = BezPath::new();
            for (k, corner) in wall(impact, self.wall, i).into_iter().enumerate() {
                let corner = self.at(corner);
                if k == 0 { path.move_to(corner) } else { path.line_to(corner) }
            }
            path.close_path();
            let fill = self.canvas.pattern("wall");
            self.canvas.path(&format!("outline-{}", i + 1), &path, Some(THIN), &fill);
            // No letter is legible on stripes.
            self.canvas.keep_off(&path, true);
        }
    }

    fn edge(&mut self, placed: &Placed, i: usize) {
        let Some(body) = &placed.body else { return };
        let there = placed_on_page(placed, self.origin, self.scale);
        let id = format!("outline-{}", i + 1);
        self.canvas.path(&id, &(there * body.outline()), Some(OUTLINE[i]), "none");
        let edge = Pen { width: 1.0, ..OUTLINE[i] };
        self.canvas.path("", &(there * body.windscreen()), Some(edge), "none");
    }

    fn axes(&mut self, impact: &Impact) {
        let n = vec2(impact.contact.normal());
        // +90° in the sense of the axes
        let t = Vec2::new(-n.y, n.x) * self.axes.lateral(1.0);
        let origin = self.origin;
        for (name, direction) in [("n", n), ("t", t)] {
            let tip = origin + flipped(direction) * AXES;
            self.canvas.arrow(name, origin, tip, AXIS, Head::Open);
            self.canvas.label(tip, name, BLACK);
        }
        self.canvas.dot("contact", origin, CONTACT, None, BLACK);
        self.canvas.protect(Rect::from_center_size(origin, (2.0 * CONTACT, 2.0 * CONTACT)));
        self.canvas.label(origin, "C", BLACK);
    }

    fn vehicle(&mut self, placed: &Placed, arrows: &Arrows, i: usize) {
        let cg = self.at(placed.cg);
        let number = ["₁", "₂"][i];
        let speed = |v: Vec2| self.units.format(Quantity::RoadSpeed, v.hypot());
        if let Some(body) = &placed.body {
            let there = placed_on_page(placed, self.origin, self.scale);
            self.canvas.line("", cg, there * body.front(), HEADING);
        }
        let outcome = &arrows.impact.outcome;
        let [before, after, tail] = arrows.of_vehicle(i);
        let pdof = arrows.impact.pdof[i];
        self.canvas.arrow(&format!("pdof-{}", i + 1), cg + tail, cg + unit(tail) * 9.0, PDOF, Head::Open);
        let pdof_text = format!("PDOF{number} {}", self.units.format(Quantity::Angle, pdof));
        self.canvas.label_beside(cg + tail, &pdof_text, BLACK);
        for (id, symbol, velocity, arrow, pen, head) in [
            ("before", "v", outcome.before[i].velocity, before, BEFORE, Head::Filled),
            ("after", "V", outcome.after[i].velocity, after, AFTER, Head::Open),
        ] {
            let velocity = vec2(velocity);
            if velocity.hypot() < SLOWEST {
                continue;
            }
            let text = format!("{symbol}{number} {}", speed(velocity));
            self.canvas.arrow(&format!("velocity-{id}-{}", i + 1), cg, cg + arrow, pen, head);
            self.canvas.label_beside(cg + arrow, &text, BLACK);
        }
        self.canvas.centre_of_gravity(&format!("cg-{}", i + 1), cg);
        self.canvas.label(cg, &format!("CG{number}"), BLACK);
    }

    fn impulse(&mut self, impact: &Impact) {
        let tip = self.tip_of_impulse(impact);
        self.canvas.arrow("impulse", self.origin, tip, IMPULSE, Head::Filled);
    }

    fn tip_of_impulse(&self, impact: &Impact) -> Point {
        self.origin + flipped(unit(vec2(impact.outcome.impulse_vector))) * IMPULSE_LENGTH
    }

    fn name_impulse(&mut self, impact: &Impact) {
        let p = vec2(impact.outcome.impulse_vector);
        let tip = self.tip_of_impulse(impact);
        let text = format!("P {}", self.units.format(Quantity::Impulse, p.hypot()));
        self.canvas.label_beside(tip, &text, BLACK);
    }

    fn name(&mut self, case: &Case, impact: &Impact, placed: &Placed, i: usize) {
        let name = case.vehicles[i].name.as_deref();
        let number = i + 1;
        let text = match (name, placed.fixed) {
            (Some(name), _) => format!("{number} · {name}"),
            (None, true) => format!("{number} · fixed object"),
            (None, false) => format!("vehicle {number}"),
        };
        let at = match &placed.body {
            // Well away from C, where the arrows are.
            Some(body) => {
                let there = placed_on_page(placed, self.origin, self.scale);
                let length = body.dimensions.length;
                let ends =
                    [0.36, -0.36].map(|share| there * (body.middle() + Vec2::new(share * length, 0.0)));
                let [front, rear] = ends.map(|end| (end - self.origin).hypot());
                if front > rear { ends[0] } else { ends[1] }
            }
            None => {
                let [_, outer, inner, _] = wall(impact, self.wall, i).map(|corner| self.at(corner));
                outer.midpoint(inner)
            }
        };
        self.canvas.label(at, &font::cut(&text, SMALL, 240.0), BLACK);
    }

    /// The axes of the scene, in a corner.
    fn frame(&mut self) {
        let (drop, end, dy) = match self.axes {
            Axes::ZUp => (12.0, -40.0, -8.0),
            Axes::ZDown => (64.0, 40.0, 16.0),
        };
        let at = Point::new(area().x1 - 62.0, area().y1 - drop);
        for (name, end, dx, dy) in
            [("x", Vec2::new(40.0, 0.0), 8.0, 4.0), ("y", Vec2::new(0.0, end), -4.0, dy)]
        {
            let tip = at + end;
            self.canvas.arrow(&format!("scene-{name}"), at, tip, Pen { width: 1.4, ..THIN }, Head::Open);
            self.canvas.text(Point::new(tip.x + dx, tip.y + dy), name, SMALL, Anchor::Start, GREY);
        }
    }

    fn scales(&mut self, y: f64, arrows: &Arrows) {
        let units = self.units;
        let metre = units.size(Quantity::Length);
        let length = (self.scale * metre, units.name(Quantity::Length), metre);
        legend::scale_bar(&mut self.canvas, "scale", Point::new(EDGE + 4.0, y), length, "");
        let speed = units.size(Quantity::RoadSpeed);
        let velocity = (arrows.per_speed * speed, units.name(Quantity::RoadSpeed), speed);
        let at = Point::new(WIDTH / 2.0, y);
        legend::scale_bar(&mut self.canvas, "velocity-scale", at, velocity, " for the arrows of velocity");
    }

    fn entries(&self, scene: &[Placed; 2]) -> Vec<(Sample, String)> {
        let mut entries = vec![
            (Sample::Arrow(BEFORE, Head::Filled), "v: velocity of the CG before impact".to_owned()),
            (Sample::Arrow(AFTER, Head::Open), "V: velocity of the CG after impact".to_owned()),
            (Sample::Arrow(IMPULSE, Head::Filled), "P: impulse on vehicle 1 (−P on 2)".to_owned()),
            (Sample::Arrow(PDOF, Head::Open), "PDOF, drawn to the CG".to_owned()),
            (Sample::Line(PLANE), "crush plane, with axes n and t".to_owned()),
            (Sample::Dot(None, BLACK), "C: contact point of the impulse".to_owned()),
            (Sample::CentreOfGravity, "CG: centre of gravity".to_owned()),
        ];
        entries.extend(body_entries(scene));
        for (i, placed) in scene.iter().enumerate() {
            let number = i + 1;
            let text = match (placed.body.map(|body| body.outline), placed.fixed) {
                (Some(Outline::Given), _) => format!("outline {number}, as given"),
                (Some(Outline::OfClass(class)), _) => format!("outline {number}: CRASH3 class {class}"),
                (Some(Outline::Nearest(class)), _) => {
                    format!("outline {number}: CRASH3 class {class}, assumed")
                }
                (None, true) => {
                    let fill = self.canvas.pattern("wall");
                    entries
                        .push((Sample::Box(THIN, fill), format!("{number}: fixed object, extent not known")));
                    continue;
                }
                (None, false) => continue,
            };
            entries.push((Sample::Box(OUTLINE[i], FILL[i].to_owned()), text));
        }
        entries
    }
}

/// Of what is drawn on a body, where one is drawn.
fn body_entries(scene: &[Placed; 2]) -> Vec<(Sample, String)> {
    let mut entries = Vec::new();
    if scene.iter().any(|placed| placed.body.is_some()) {
        entries.push(legend::windscreen());
    }
    if scene.iter().any(|placed| placed.body.is_some() && !placed.fixed) {
        entries.push((Sample::Line(HEADING), "heading, from the CG to the front".to_owned()));
    }
    entries
}

/// In the axes of the case, and so is the impact.
fn description(case: &Case, impact: &Impact, units: Units) -> String {
    let outcome = &impact.outcome;
    let mut sentences = vec!["Both vehicles from above at the moment of impact, to scale.".to_owned()];
    for i in [0, 1] {
        let vehicle = &case.vehicles[i];
        let name = vehicle.name.clone().map(|name| format!(", {name},")).unwrap_or_default();
        if vehicle.fixed {
            sentences.push(format!("Vehicle {}{name} is a fixed object.", i + 1));
            continue;
        }
        let heading = vehicle.heading.as_ref().map_or(0.0, case::Quantity::si);
        sentences.push(format!(
            "Vehicle {}{name} heads {} {} from the x axis of the scene; its velocity is {} before and {} after the impact; the force on it \
             comes from {} clockwise of its heading.",
            i + 1,
            units.format(Quantity::Angle, heading),
            axes::sense(case.axes),
            units.format_vector(Quantity::RoadSpeed, outcome.before[i].velocity.into()),
            units.format_vector(Quantity::RoadSpeed, outcome.after[i].velocity.into()),
            units.format(Quantity::Angle, impact.pdof[i]),
        ));
    }
    sentences.push(format!(
        "The impulse of {} on vehicle 1 at the contact point C points to {} in the scene.",
        units.format(Quantity::Impulse, vec2(outcome.impulse_vector).hypot()),
        units.format(Quantity::Angle, outcome.impulse_direction()),
    ));
    sentences.join(" ")
}
