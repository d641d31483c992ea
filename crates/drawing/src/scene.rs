//! The scene: both vehicles at impact, seen from above.

use kurbo::{Affine, BezPath, Circle, ParamCurve as _, Point, Rect, Shape as _, Vec2};

use crate::canvas::{Canvas, Head};
use crate::finished::Drawing;
use crate::font::{self, Anchor, SMALL};
use crate::footprint::{CrushProfile, Footprint, Shape, placed};
use crate::legend::{self, EDGE, HEADER, Sample, ScaleUnit, WIDTH};
use crate::pens::{
    AFTER, AXIS, BEFORE, BLACK, FILL, GREY, HEADING, IMPULSE, OUTLINE, PALE, PDOF, PLANE, Pen, THIN,
    undamaged,
};

const NAME: &str = "scene";

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
/// (m) how far the wall that stands for a fixed object of unknown extent reaches beyond the vehicle at it,
/// its thickness, and the least length that is drawn.
const WALL: f64 = 0.7;
const WALL_DEPTH: f64 = 0.5;
const SHORTEST_WALL: f64 = 0.2;
/// (m) what of a vehicle lies farther than this beyond the crush plane has no wall in front of it.
const BEHIND: f64 = 0.1;
/// (m/s) below this there is no arrow.
const SLOWEST: f64 = 1e-6;

/// Plan view of both vehicles at impact.
///
/// Vectors are those of the scene with y to the left of x, whatever the axes that are shown; lengths are in
/// metres from the contact point C.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenePicture {
    /// Of the case.
    pub title: String,
    /// What a reader who cannot see it has to be told.
    pub description: String,
    /// The axes that are shown have y to the right, and t so.
    pub is_z_down: bool,
    /// For readers who are no engineers: vehicles and their velocities alone.
    pub is_plain: bool,
    /// Vehicles 1 and 2.
    pub vehicles: [SceneVehicle; 2],
    /// Of the crush plane, from vehicle 2 to vehicle 1; a unit vector.
    pub normal: [f64; 2],
    /// On vehicle 1; its direction is drawn.
    pub impulse: SceneArrow,
    /// Of the scale bar.
    pub length: ScaleUnit,
    /// Of the scale bar of the velocities.
    pub speed: ScaleUnit,
}

/// A vehicle of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneVehicle {
    /// What stands on it.
    pub name: String,
    /// What the legend says of its body.
    pub legend: Option<String>,
    /// What is drawn of it.
    pub body: SceneBody,
    /// (m) its centre of gravity.
    pub cg: [f64; 2],
    /// Its heading; a unit vector.
    pub forward: [f64; 2],
    /// `None` for a fixed object.
    pub motion: Option<SceneMotion>,
}

/// What is known of the shape of a vehicle or of a fixed object.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneBody {
    /// Its outline. Where its crush is known, the damaged body is filled and the undamaged one dashed.
    Outline {
        /// The undamaged body.
        footprint: Footprint,
        /// The damaged face.
        crush: Option<CrushProfile>,
    },
    /// A pole or a tree, which the contact point touches.
    Pole {
        /// (m)
        diameter: f64,
    },
    /// A fixed object of unknown extent: a wall along the crush plane.
    Wall,
    /// A vehicle of unknown shape: its centre of gravity and its arrows are drawn, and no body.
    Unknown,
}

/// What moves a vehicle, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMotion {
    /// (m/s) velocity of the CG before the impact.
    pub before: SceneArrow,
    /// (m/s) the same after it.
    pub after: SceneArrow,
    /// From the CG to where the force comes from; a unit vector.
    pub force_from: SceneArrow,
}

/// A vector with the text that stands at its arrow.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneArrow {
    /// Its components in the scene.
    pub vector: [f64; 2],
    /// Its symbol and value.
    pub label: String,
}

impl ScenePicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let motions = self.vehicles.iter().filter_map(|vehicle| vehicle.motion.as_ref());
        let fastest = motions
            .flat_map(|motion| [&motion.before, &motion.after])
            .map(|arrow| vec2(arrow.vector).hypot())
            .fold(SLOWEST, f64::max);
        let arrows = Arrows { scene: self, per_speed: FASTEST / fastest };
        let (scale, origin) = self.fit(&arrows);

        let bar_row = HEADER + SCENE + 30.0;
        let canvas = Canvas::new(NAME, WIDTH, bar_row);
        let mut page = Page { canvas, scene: self, scale, origin, wall: self.wall_ends() };
        legend::header(&mut page.canvas, &self.title, "Plan view at impact, to scale");
        // The bodies lie over each other: all areas first, so that no edge is hidden; and fixed objects below
        // what drove into them.
        for is_fixed in [true, false] {
            for (i, vehicle) in self.vehicles.iter().enumerate() {
                if vehicle.motion.is_none() == is_fixed {
                    page.area(vehicle, i);
                }
            }
        }
        if !self.is_plain {
            page.plane();
        }
        for (i, vehicle) in self.vehicles.iter().enumerate() {
            page.edge(vehicle, i);
        }
        if !self.is_plain {
            page.axes();
            // Before the other values: it has the fewest places, as its arrow is mostly over both vehicles.
            page.canvas.label_beside(page.tip_of_impulse(), &self.impulse.label, BLACK);
        }
        for (i, vehicle) in self.vehicles.iter().enumerate() {
            if let Some(motion) = &vehicle.motion {
                page.vehicle(vehicle, motion, &arrows, i);
            }
        }
        if !self.is_plain {
            page.canvas.arrow("impulse", origin, page.tip_of_impulse(), IMPULSE, Head::Filled);
        }
        for (i, vehicle) in self.vehicles.iter().enumerate() {
            page.name(vehicle, i);
        }
        if !self.is_plain {
            page.frame();
        }
        page.canvas.place_labels(area());
        page.scales(bar_row, &arrows);
        let entries = page.entries();
        page.canvas.set_height(bar_row + 22.0 + legend::height(entries.len(), 3) + 10.0);
        legend::legend(&mut page.canvas, bar_row + 22.0, 3, &entries);
        let title = format!("{}: plan view at impact", self.title);
        Drawing::new(NAME, title, self.description.clone(), page.canvas)
    }

    /// The scale (px/m) and the place of C (px) at which everything is on the page.
    fn fit(&self, arrows: &Arrows) -> (f64, Point) {
        let room = area().inset(-MARGIN);
        let bounds = |scale: f64| {
            let mut points = vec![Vec2::ZERO];
            if !self.is_plain {
                points.push(arrows.impulse());
                let normal = flipped(vec2(self.normal));
                let t = Vec2::new(normal.y, -normal.x);
                // t points to either side, by the axes of the case; the picture is the same.
                points.extend([normal, t, -t].map(|axis| axis * AXES));
            }
            for (i, vehicle) in self.vehicles.iter().enumerate() {
                let cg = flipped(vec2(vehicle.cg)) * scale;
                match &vehicle.body {
                    SceneBody::Outline { footprint, .. } => {
                        let there = vehicle.on_page(Point::ZERO, scale);
                        points.extend(footprint.corners().map(|corner| (there * corner).to_vec2()));
                    }
                    SceneBody::Pole { diameter } => {
                        let centre = self.pole(*diameter, i);
                        let reach =
                            [(1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| Vec2::new(x, y) * (diameter / 2.0));
                        points.extend(reach.map(|reach| flipped(centre + reach) * scale));
                    }
                    SceneBody::Wall => {
                        points.extend(self.wall(self.wall_ends(), i).map(|corner| flipped(corner) * scale));
                    }
                    SceneBody::Unknown => {}
                }
                if let Some(motion) = &vehicle.motion {
                    points.push(cg);
                    points.extend(arrows.of_vehicle(motion).map(|arrow| cg + arrow));
                }
            }
            let start = Rect::from_points(Point::ZERO, Point::ZERO);
            points.iter().fold(start, |bounds, point| bounds.union_pt(point.to_point()))
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

    /// (m) the corners of the wall that stands for a fixed object: on the far side of the crush plane.
    fn wall(&self, [low, high]: [f64; 2], i: usize) -> [Vec2; 4] {
        let n = vec2(self.normal);
        let t = Vec2::new(-n.y, n.x);
        // n points from vehicle 2 to vehicle 1.
        let away = if i == 0 { n } else { -n };
        [t * high, t * high + away * WALL_DEPTH, t * low + away * WALL_DEPTH, t * low]
    }

    /// (m) the centre of a pole: C lies on its surface.
    fn pole(&self, diameter: f64, i: usize) -> Vec2 {
        // n points from vehicle 2 to vehicle 1.
        vec2(self.normal) * (if i == 0 { 0.5 } else { -0.5 } * diameter)
    }

    /// (m) how far a wall reaches along t from C: beyond the whole of the other vehicle, but for what of that
    /// lies beyond the crush plane, where there cannot be a wall.
    fn wall_ends(&self) -> [f64; 2] {
        let n = vec2(self.normal);
        let t = Vec2::new(-n.y, n.x);
        let (mut ends, mut blocked) = ([-WALL, WALL], Vec::new());
        for (vehicle, outward) in self.vehicles.iter().zip([-1.0, 1.0]) {
            let SceneBody::Outline { footprint, crush } = &vehicle.body else { continue };
            let outline =
                crush.as_ref().map_or_else(|| footprint.outline(), |crush| footprint.damaged(crush));
            let there = vehicle.in_scene();
            for edge in outline.segments() {
                let [from, to] = [edge.start(), edge.end()].map(|at| (there * at).to_vec2());
                let along = [from.dot(t).min(to.dot(t)), from.dot(t).max(to.dot(t))];
                ends = [ends[0].min(along[0] - WALL), ends[1].max(along[1] + WALL)];
                if [from, to].iter().all(|at| at.dot(n) * outward > BEHIND) {
                    blocked.push(along);
                }
            }
        }
        blocked.sort_by(|one, other| one[0].total_cmp(&other[0]));
        // Of the gaps, the nearest to C and, of several such, the longest.
        let (mut low, mut gaps) = (ends[0], Vec::new());
        for [from, to] in blocked.into_iter().chain([[ends[1]; 2]]) {
            if from > low {
                gaps.push([low, from]);
            }
            low = low.max(to);
        }
        let far = |[low, high]: [f64; 2]| low.max(-high).max(0.0);
        let length = |[low, high]: [f64; 2]| high - low;
        let best = |one: &[f64; 2], other: &[f64; 2]| {
            far(*one).total_cmp(&far(*other)).then(length(*other).total_cmp(&length(*one)))
        };
        gaps.into_iter().min_by(best).unwrap_or_default()
    }
}

impl SceneVehicle {
    fn on_page(&self, origin: Point, scale: f64) -> Affine {
        placed(vec2(self.forward), origin + flipped(vec2(self.cg)) * scale, scale)
    }

    /// (m) from its own axes to those of the scene.
    fn in_scene(&self) -> Affine {
        let (forward, cg) = (vec2(self.forward), vec2(self.cg));
        Affine::new([forward.x, forward.y, -forward.y, forward.x, cg.x, cg.y])
    }
}

/// Where the scene is drawn.
fn area() -> Rect {
    Rect::new(EDGE, HEADER, WIDTH - EDGE, HEADER + SCENE)
}

fn vec2([x, y]: [f64; 2]) -> Vec2 {
    Vec2::new(x, y)
}

/// From the scene (m, y upwards) to the page (px, y downwards), without the origin.
fn flipped(v: Vec2) -> Vec2 {
    Vec2::new(v.x, -v.y)
}

fn unit(v: Vec2) -> Vec2 {
    let length = v.hypot();
    if length > 0.0 { v / length } else { Vec2::new(1.0, 0.0) }
}

/// All arrows of the scene, of which only the starting points are to scale.
struct Arrows<'a> {
    scene: &'a ScenePicture,
    /// (px·s/m)
    per_speed: f64,
}

impl Arrows<'_> {
    /// (px, page) from a vehicle's CG: its velocities before and after, and the tail of its PDOF arrow.
    fn of_vehicle(&self, motion: &SceneMotion) -> [Vec2; 3] {
        let before = flipped(vec2(motion.before.vector)) * self.per_speed;
        let after = flipped(vec2(motion.after.vector)) * self.per_speed;
        [before, after, flipped(vec2(motion.force_from.vector)) * PDOF_LENGTH]
    }

    /// From C.
    fn impulse(&self) -> Vec2 {
        flipped(unit(vec2(self.scene.impulse.vector))) * IMPULSE_LENGTH
    }
}

struct Page<'a> {
    canvas: Canvas,
    scene: &'a ScenePicture,
    scale: f64,
    origin: Point,
    /// (m) along t from C, where there is a wall.
    wall: [f64; 2],
}

impl Page<'_> {
    fn at(&self, metres: Vec2) -> Point {
        self.origin + flipped(metres) * self.scale
    }

    /// The crush plane, as far as the page goes.
    fn plane(&mut self) {
        let n = vec2(self.scene.normal);
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

    fn area(&mut self, vehicle: &SceneVehicle, i: usize) {
        let id = format!("outline-{}", i + 1);
        let fixed = match &vehicle.body {
            SceneBody::Outline { footprint, .. } if footprint.shape == Shape::Fixed => {
                vehicle.on_page(self.origin, self.scale) * footprint.outline()
            }
            SceneBody::Outline { footprint, crush } => {
                let there = vehicle.on_page(self.origin, self.scale);
                let whole = there * footprint.outline();
                let body =
                    crush.as_ref().map_or_else(|| whole.clone(), |crush| there * footprint.damaged(crush));
                self.canvas.path("", &body, None, FILL[i]);
                self.canvas.keep_off(&whole, false);
                return;
            }
            SceneBody::Pole { diameter } => {
                let centre = self.at(self.scene.pole(*diameter, i));
                Circle::new(centre, 0.5 * diameter * self.scale).to_path(1e-2)
            }
            SceneBody::Wall if self.wall[1] - self.wall[0] >= SHORTEST_WALL => {
                let mut path = BezPath::new();
                for (k, corner) in self.scene.wall(self.wall, i).into_iter().enumerate() {
                    let corner = self.at(corner);
                    if k == 0 { path.move_to(corner) } else { path.line_to(corner) }
                }
                path.close_path();
                path
            }
            SceneBody::Wall | SceneBody::Unknown => return,
        };
        self.canvas.define_stripes("fixed", GREY, PALE, 45, 8.0);
        let fill = self.canvas.pattern("fixed");
        self.canvas.path(&id, &fixed, Some(THIN), &fill);
        // No letter is legible on stripes.
        self.canvas.keep_off(&fixed, true);
    }

    fn edge(&mut self, vehicle: &SceneVehicle, i: usize) {
        let SceneBody::Outline { footprint, crush } = &vehicle.body else { return };
        if footprint.shape == Shape::Fixed {
            return;
        }
        let there = vehicle.on_page(self.origin, self.scale);
        let id = format!("outline-{}", i + 1);
        match crush {
            None => self.canvas.path(&id, &(there * footprint.outline()), Some(OUTLINE[i]), "none"),
            Some(crush) => {
                self.canvas.path(&id, &(there * footprint.outline()), Some(undamaged(i)), "none");
                let id = format!("damaged-{}", i + 1);
                self.canvas.path(&id, &(there * footprint.damaged(crush)), Some(OUTLINE[i]), "none");
            }
        }
        if let Some(detail) = footprint.detail(crush.as_ref()) {
            let pen = Pen { width: 1.0, ..OUTLINE[i] };
            self.canvas.path(&format!("front-{}", i + 1), &(there * detail), Some(pen), "none");
        }
    }

    fn axes(&mut self) {
        let n = vec2(self.scene.normal);
        // +90° in the sense of the axes
        let t = Vec2::new(-n.y, n.x) * if self.scene.is_z_down { -1.0 } else { 1.0 };
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

    fn vehicle(&mut self, vehicle: &SceneVehicle, motion: &SceneMotion, arrows: &Arrows, i: usize) {
        let cg = self.at(vec2(vehicle.cg));
        let is_plain = self.scene.is_plain;
        if let (SceneBody::Outline { footprint, .. }, false) = (&vehicle.body, is_plain) {
            let there = vehicle.on_page(self.origin, self.scale);
            self.canvas.line("", cg, there * footprint.front(), HEADING);
        }
        let [before, after, tail] = arrows.of_vehicle(motion);
        if !is_plain {
            let tip = cg + unit(tail) * 9.0;
            self.canvas.arrow(&format!("pdof-{}", i + 1), cg + tail, tip, PDOF, Head::Open);
            self.canvas.label_beside(cg + tail, &motion.force_from.label, BLACK);
        }
        for (id, given, arrow, pen, head) in [
            ("before", &motion.before, before, BEFORE, Head::Filled),
            ("after", &motion.after, after, AFTER, Head::Open),
        ] {
            if vec2(given.vector).hypot() < SLOWEST {
                continue;
            }
            self.canvas.arrow(&format!("velocity-{id}-{}", i + 1), cg, cg + arrow, pen, head);
            self.canvas.label_beside(cg + arrow, &given.label, BLACK);
        }
        if is_plain {
            self.canvas.dot(&format!("cg-{}", i + 1), cg, CONTACT, None, BLACK);
        } else {
            self.canvas.centre_of_gravity(&format!("cg-{}", i + 1), cg);
            self.canvas.label(cg, ["CG₁", "CG₂"][i], BLACK);
        }
    }

    fn tip_of_impulse(&self) -> Point {
        self.origin + flipped(unit(vec2(self.scene.impulse.vector))) * IMPULSE_LENGTH
    }

    fn name(&mut self, vehicle: &SceneVehicle, i: usize) {
        let at = match &vehicle.body {
            // Well away from C, where the arrows are.
            SceneBody::Outline { footprint, .. } => {
                let there = vehicle.on_page(self.origin, self.scale);
                let length = footprint.length;
                let ends =
                    [0.36, -0.36].map(|share| there * (footprint.middle() + Vec2::new(share * length, 0.0)));
                let [front, rear] = ends.map(|end| (end - self.origin).hypot());
                if front > rear { ends[0] } else { ends[1] }
            }
            SceneBody::Pole { diameter } => self.at(self.scene.pole(2.0 * diameter, i)),
            SceneBody::Wall => {
                let [_, outer, inner, _] = self.scene.wall(self.wall, i).map(|corner| self.at(corner));
                outer.midpoint(inner)
            }
            SceneBody::Unknown => self.at(vec2(vehicle.cg)),
        };
        self.canvas.label(at, &font::cut(&vehicle.name, SMALL, 240.0), BLACK);
    }

    /// The axes of the scene, in a corner.
    fn frame(&mut self) {
        let (drop, end, dy) = if self.scene.is_z_down { (64.0, 40.0, 16.0) } else { (12.0, -40.0, -8.0) };
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
        let ScenePicture { length, speed, .. } = self.scene;
        let at = Point::new(EDGE + 4.0, y);
        legend::scale_bar(&mut self.canvas, "scale", at, self.scale * length.size, length, "");
        let at = Point::new(WIDTH / 2.0, y);
        let what = " for the arrows of velocity";
        legend::scale_bar(&mut self.canvas, "velocity-scale", at, arrows.per_speed * speed.size, speed, what);
    }

    fn entries(&self) -> Vec<(Sample, String)> {
        let mut entries = if self.scene.is_plain {
            vec![
                (Sample::Arrow(BEFORE, Head::Filled), "speed and direction before impact".to_owned()),
                (Sample::Arrow(AFTER, Head::Open), "speed and direction after impact".to_owned()),
            ]
        } else {
            vec![
                (Sample::Arrow(BEFORE, Head::Filled), "v: velocity of the CG before impact".to_owned()),
                (Sample::Arrow(AFTER, Head::Open), "V: velocity of the CG after impact".to_owned()),
                (Sample::Arrow(IMPULSE, Head::Filled), "P: impulse on vehicle 1 (−P on 2)".to_owned()),
                (Sample::Arrow(PDOF, Head::Open), "PDOF, drawn to the CG".to_owned()),
                (Sample::Line(PLANE), "crush plane, with axes n and t".to_owned()),
                (Sample::Dot(None, BLACK), "C: contact point of the impulse".to_owned()),
                (Sample::CentreOfGravity, "CG: centre of gravity".to_owned()),
            ]
        };
        let vehicles = &self.scene.vehicles;
        let outlines = || {
            vehicles.iter().enumerate().filter_map(|(i, vehicle)| match &vehicle.body {
                SceneBody::Outline { footprint, crush } => Some((i, vehicle, footprint, crush)),
                _ => None,
            })
        };
        if outlines().any(|(_, _, footprint, _)| footprint.shape == Shape::Car) {
            entries.push(legend::windscreen());
        }
        if !self.scene.is_plain && outlines().any(|(_, vehicle, ..)| vehicle.motion.is_some()) {
            entries.push((Sample::Line(HEADING), "heading, from the CG to the front".to_owned()));
        }
        if let Some((i, ..)) = outlines().find(|(.., crush)| crush.is_some()) {
            entries.push((Sample::Line(undamaged(i)), "shape before the damage".to_owned()));
        }
        for (i, vehicle) in vehicles.iter().enumerate() {
            let Some(text) = vehicle.legend.clone() else { continue };
            let sample = match &vehicle.body {
                SceneBody::Outline { footprint, .. } if footprint.shape != Shape::Fixed => {
                    Sample::Box(OUTLINE[i], FILL[i].to_owned())
                }
                SceneBody::Unknown => Sample::Nothing,
                SceneBody::Wall if self.wall[1] - self.wall[0] < SHORTEST_WALL => Sample::Nothing,
                _ => Sample::Box(THIN, self.canvas.pattern("fixed")),
            };
            entries.push((sample, text));
        }
        entries
    }
}
