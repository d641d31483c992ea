//! The scene: both vehicles at impact, seen from above.

use kurbo::{Point, Rect, Vec2};

use crate::body::SceneBody;
use crate::canvas::{Canvas, Head};
use crate::finished::Drawing;
use crate::font::{self, SMALL};
use crate::footprint::BodyShape;
use crate::legend::{self, EDGE, HEADER, Sample, ScaleUnit, WIDTH};
use crate::pens::{
    AFTER, AXIS, BEFORE, BLACK, FILL, GREY, HEADING, IMPULSE, OUTLINE, PDOF, PLANE, Pen, undamaged,
};
use crate::plan::{self, Contact, Pose, View};
use crate::plan_view::{PlanBody, PlanView, Viewport};
use crate::vector::{flipped, unit, vec2};

const NAME: &str = "scene";

/// (px) height of the picture, below the title.
const SCENE: f64 = 520.0;
/// (px) length of the fastest velocity.
const FASTEST: f64 = 150.0;
/// (px) lengths of the impulse and of the PDOF.
const IMPULSE_LENGTH: f64 = 120.0;
const PDOF_LENGTH: f64 = 95.0;
/// (px) length of n and t.
const AXES: f64 = 52.0;
/// (px) radius of C.
const CONTACT: f64 = 4.5;
/// (px) margin around the outermost point, for labels.
const MARGIN: f64 = 34.0;
/// (px/m) the largest scale, so that a small vehicle does not fill the page.
const LARGEST: f64 = 130.0;
/// (m/s) slower velocities have no arrow.
const SLOWEST: f64 = 1e-6;

/// Plan view of both vehicles at impact.
///
/// Vectors are those of the scene with y to the left of x, whichever axes are shown; lengths are in metres
/// from the contact point C.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenePicture {
    /// Title of the case.
    pub title: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// Why this is not the answer, shown below the title; usually empty.
    pub caveat: String,
    /// Whether the axes that are shown have y, and so t, to the right.
    pub is_z_down: bool,
    /// Whether the picture is for readers who are not engineers: vehicles and their velocities only.
    pub is_plain: bool,
    /// Vehicles 1 and 2.
    pub vehicles: [SceneVehicle; 2],
    /// Normal of the crush plane, from vehicle 2 to vehicle 1; a unit vector.
    pub normal: [f64; 2],
    /// The impulse on vehicle 1; only its direction is drawn. `None` if no speed is known.
    pub impulse: Option<SceneArrow>,
    /// Unit of the scale bar.
    pub length: ScaleUnit,
    /// Unit of the scale bar of the velocities.
    pub speed: ScaleUnit,
}

/// A vehicle of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneVehicle {
    /// Its label.
    pub name: String,
    /// Legend entry of its body.
    pub legend: Option<String>,
    /// Its shape.
    pub body: SceneBody,
    /// (m) its centre of gravity.
    pub cg: [f64; 2],
    /// Its heading; a unit vector.
    pub forward: [f64; 2],
    /// Whether it is a fixed object.
    pub is_fixed: bool,
    /// `None` for a fixed object, and if no speed is known.
    pub motion: Option<SceneMotion>,
}

/// The velocities of a vehicle, and its PDOF.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMotion {
    /// (m/s) velocity of the CG before the impact.
    pub before: SceneArrow,
    /// (m/s) velocity of the CG after the impact.
    pub after: SceneArrow,
    /// From the CG towards the origin of the force; a unit vector.
    pub force_from: SceneArrow,
}

/// A vector with the label of its arrow.
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
        self.draw_within(None).0
    }

    /// Draws this part of the scene, or all of it, and returns where everything is. The contact point is the
    /// origin.
    #[must_use]
    pub fn draw_within(&self, viewport: Option<Viewport>) -> (Drawing, PlanView) {
        let motions = self.vehicles.iter().filter_map(|vehicle| vehicle.motion.as_ref());
        let fastest = motions
            .flat_map(|motion| [&motion.before, &motion.after])
            .map(|arrow| vec2(arrow.vector).hypot())
            .fold(SLOWEST, f64::max);
        let arrows = Arrows { per_speed: FASTEST / fastest };
        let view = viewport.and_then(|viewport| viewport.view(area())).unwrap_or_else(|| self.view(&arrows));
        let origin = view.origin;

        let bar_row = HEADER + SCENE + 30.0;
        let below = format!("Plan view at impact, to scale\n{}", self.caveat);
        let canvas = legend::page(NAME, WIDTH, &self.title, &below);
        let mut page = Page { canvas, scene: self, view, wall: self.wall_ends() };
        // The bodies overlap: all areas are drawn first, so that no edge is hidden, and fixed objects below
        // the vehicles that drove into them.
        for is_fixed in [true, false] {
            for (i, vehicle) in self.vehicles.iter().enumerate() {
                if vehicle.is_fixed == is_fixed {
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
            // Placed before the other values: it has the fewest places, its arrow mostly being on both
            // vehicles.
            if let (Some(impulse), Some(tip)) = (&self.impulse, page.tip_of_impulse()) {
                page.canvas.labels.label_beside(tip, &impulse.label, BLACK);
            }
        }
        for (i, vehicle) in self.vehicles.iter().enumerate() {
            if !vehicle.is_fixed {
                page.vehicle(vehicle, &arrows, i);
            }
        }
        if let (false, Some(tip)) = (self.is_plain, page.tip_of_impulse()) {
            page.canvas.arrow("impulse", origin, tip, IMPULSE, Head::Filled);
        }
        for (i, vehicle) in self.vehicles.iter().enumerate() {
            page.name(vehicle, i);
        }
        if !self.is_plain {
            plan::axes_in_corner(&mut page.canvas, area(), self.is_z_down);
        }
        page.canvas.place_labels(area());
        page.scales(bar_row, &arrows);
        let entries = page.entries();
        page.canvas.height = legend::legend(&mut page.canvas, bar_row + 22.0, 3, &entries) + 10.0;
        let title = format!("{}: plan view at impact", self.title);
        (Drawing::new(title, self.description.clone(), page.canvas), self.plan_view(view))
    }

    fn plan_view(&self, view: View) -> PlanView {
        let body = |i: usize| {
            let vehicle = self.vehicles.get(i)?;
            let outline = self.contact().outline(&vehicle.body, self.wall_ends(), i);
            Some(PlanBody::of(&vehicle.body, vehicle.pose(), outline))
        };
        PlanView {
            viewport: Viewport::of(view, area()),
            origin: [view.origin.x, view.origin.y],
            scale: view.scale,
            contact: Some([0.0; 2]),
            normal: Some(self.normal),
            bodies: [body(0), body(1)],
        }
    }

    /// The view of the scene, with C as the origin.
    fn view(&self, arrows: &Arrows) -> View {
        let room = area().inset(-MARGIN);
        let bounds = |scale: f64| {
            let mut points = vec![Vec2::ZERO];
            if !self.is_plain {
                points.extend(self.impulse_arrow());
                let normal = flipped(vec2(self.normal));
                let t = Vec2::new(normal.y, -normal.x);
                // t points to either side, depending on the axes of the case; the extent is the same.
                points.extend([normal, t, -t].map(|axis| axis * AXES));
            }
            for (i, vehicle) in self.vehicles.iter().enumerate() {
                let cg = flipped(vec2(vehicle.cg)) * scale;
                match &vehicle.body {
                    SceneBody::Outline { footprint, .. } => {
                        let there = View { origin: Point::ZERO, scale }.place(vehicle.pose());
                        points.extend(footprint.corners().map(|corner| (there * corner).to_vec2()));
                    }
                    body => {
                        let reach = self.contact().reach(body, || self.wall_ends(), i);
                        points.extend(reach.into_iter().map(|at| flipped(at) * scale));
                    }
                }
                if !vehicle.is_fixed {
                    points.push(cg);
                }
                if let Some(motion) = &vehicle.motion {
                    points.extend(arrows.of_vehicle(motion).map(|arrow| cg + arrow));
                }
            }
            plan::extent(points.into_iter().map(Vec2::to_point))
        };
        View::fit(room, LARGEST, bounds)
    }

    fn contact(&self) -> Contact {
        Contact { at: Vec2::ZERO, normal: vec2(self.normal) }
    }

    /// (px) the impulse arrow on the page, from C.
    fn impulse_arrow(&self) -> Option<Vec2> {
        let impulse = self.impulse.as_ref()?;
        Some(flipped(unit(vec2(impulse.vector))) * IMPULSE_LENGTH)
    }

    fn wall_ends(&self) -> [f64; 2] {
        let outline = |vehicle: &SceneVehicle| vehicle.body.outline_in(vehicle.pose());
        self.contact().wall_ends(self.vehicles.each_ref().map(outline))
    }
}

impl SceneVehicle {
    fn pose(&self) -> Pose {
        Pose::new(self.cg, self.forward)
    }
}

/// (px) area of the scene.
fn area() -> Rect {
    Rect::new(EDGE, HEADER, WIDTH - EDGE, HEADER + SCENE)
}

/// The lengths of the arrows of the scene: only their starting points are to scale.
struct Arrows {
    /// (px·s/m)
    per_speed: f64,
}

impl Arrows {
    /// (px, page) from a vehicle's CG: velocities before and after, and the tail of the PDOF arrow.
    fn of_vehicle(&self, motion: &SceneMotion) -> [Vec2; 3] {
        let before = flipped(vec2(motion.before.vector)) * self.per_speed;
        let after = flipped(vec2(motion.after.vector)) * self.per_speed;
        [before, after, flipped(vec2(motion.force_from.vector)) * PDOF_LENGTH]
    }
}

struct Page<'a> {
    canvas: Canvas,
    scene: &'a ScenePicture,
    view: View,
    /// (m) ends of the wall along t from C, if there is one.
    wall: [f64; 2],
}

impl Page<'_> {
    fn at(&self, metres: Vec2) -> Point {
        self.view.at(metres)
    }

    /// Draws the crush plane, as far as the page goes.
    fn plane(&mut self) {
        let n = vec2(self.scene.normal);
        let t = flipped(Vec2::new(-n.y, n.x));
        let room = area();
        let reach = |direction: Vec2| {
            let mut most = f64::INFINITY;
            for (at, along, low, high) in [
                (self.view.origin.x, direction.x, room.x0, room.x1),
                (self.view.origin.y, direction.y, room.y0, room.y1),
            ] {
                if along > 1e-9 {
                    most = most.min((high - at) / along);
                } else if along < -1e-9 {
                    most = most.min((low - at) / along);
                }
            }
            self.view.origin + direction * most.clamp(0.0, 330.0)
        };
        let (a, b) = (reach(-t), reach(t));
        self.canvas.line("crush-plane", a, b, PLANE);
        self.canvas.labels.label(b, "crush plane", GREY);
    }

    fn area(&mut self, vehicle: &SceneVehicle, i: usize) {
        let contact = Some((self.scene.contact(), self.wall));
        if let Some(fixed) = vehicle.body.fixed_on(self.view, vehicle.pose(), contact, i) {
            plan::fixed(&mut self.canvas, &format!("outline-{}", i + 1), &fixed);
        } else if let SceneBody::Outline { footprint, crush } = &vehicle.body {
            let there = self.view.place(vehicle.pose());
            self.canvas.path("", &(there * footprint.left_by(crush.as_ref())), None, FILL[i]);
            self.canvas.labels.keep_off(&(there * footprint.outline()), false);
        }
    }

    fn edge(&mut self, vehicle: &SceneVehicle, i: usize) {
        let SceneBody::Outline { footprint, crush } = &vehicle.body else { return };
        if footprint.shape == BodyShape::Fixed {
            return;
        }
        let there = self.view.place(vehicle.pose());
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
        let origin = self.view.origin;
        for (name, direction) in [("n", n), ("t", t)] {
            let tip = origin + flipped(direction) * AXES;
            self.canvas.arrow(name, origin, tip, AXIS, Head::Open);
            self.canvas.labels.label(tip, name, BLACK);
        }
        self.canvas.dot("contact", origin, CONTACT, None, BLACK);
        self.canvas.labels.protect(Rect::from_center_size(origin, (2.0 * CONTACT, 2.0 * CONTACT)));
        self.canvas.labels.label(origin, "C", BLACK);
    }

    fn vehicle(&mut self, vehicle: &SceneVehicle, arrows: &Arrows, i: usize) {
        let cg = self.at(vec2(vehicle.cg));
        let is_plain = self.scene.is_plain;
        if let (SceneBody::Outline { footprint, .. }, false) = (&vehicle.body, is_plain) {
            let there = self.view.place(vehicle.pose());
            self.canvas.line("", cg, there * footprint.front(), HEADING);
        }
        if let Some(motion) = &vehicle.motion {
            self.motion(motion, arrows, cg, i);
        }
        if is_plain {
            self.canvas.dot(&format!("cg-{}", i + 1), cg, CONTACT, None, BLACK);
        } else {
            self.canvas.centre_of_gravity(&format!("cg-{}", i + 1), cg);
            self.canvas.labels.label(cg, ["CG₁", "CG₂"][i], BLACK);
        }
    }

    fn tip_of_impulse(&self) -> Option<Point> {
        Some(self.view.origin + self.scene.impulse_arrow()?)
    }

    fn name(&mut self, vehicle: &SceneVehicle, i: usize) {
        let at = match &vehicle.body {
            // Well away from C, where the arrows are.
            SceneBody::Outline { footprint, .. } => {
                let there = self.view.place(vehicle.pose());
                let length = footprint.length;
                let ends =
                    [0.36, -0.36].map(|share| there * (footprint.middle() + Vec2::new(share * length, 0.0)));
                let [front, rear] = ends.map(|end| (end - self.view.origin).hypot());
                if front > rear { ends[0] } else { ends[1] }
            }
            SceneBody::Pole { diameter } => self.at(self.scene.contact().pole(2.0 * diameter, i)),
            SceneBody::Wall => {
                let [_, outer, inner, _] =
                    self.scene.contact().wall(self.wall, i).map(|corner| self.at(corner));
                outer.midpoint(inner)
            }
            SceneBody::Unknown => self.at(vec2(vehicle.cg)),
        };
        self.canvas.labels.label(at, &font::cut(&vehicle.name, SMALL, 240.0), BLACK);
    }

    fn motion(&mut self, motion: &SceneMotion, arrows: &Arrows, cg: Point, i: usize) {
        let [before, after, tail] = arrows.of_vehicle(motion);
        if !self.scene.is_plain {
            let tip = cg + unit(tail) * 9.0;
            self.canvas.arrow(&format!("pdof-{}", i + 1), cg + tail, tip, PDOF, Head::Open);
            self.canvas.labels.label_beside(cg + tail, &motion.force_from.label, BLACK);
        }
        for (id, given, arrow, pen, head) in [
            ("before", &motion.before, before, BEFORE, Head::Filled),
            ("after", &motion.after, after, AFTER, Head::Open),
        ] {
            if vec2(given.vector).hypot() < SLOWEST {
                continue;
            }
            self.canvas.arrow(&format!("velocity-{id}-{}", i + 1), cg, cg + arrow, pen, head);
            self.canvas.labels.label_beside(cg + arrow, &given.label, BLACK);
        }
    }

    fn scales(&mut self, y: f64, arrows: &Arrows) {
        let ScenePicture { length, speed, .. } = self.scene;
        let at = Point::new(EDGE + 4.0, y);
        legend::scale_bar(&mut self.canvas, "scale", at, self.view.scale, length, "");
        if self.scene.vehicles.iter().all(|vehicle| vehicle.motion.is_none()) {
            return;
        }
        let at = Point::new(WIDTH / 2.0, y);
        let what = " for the arrows of velocity";
        legend::scale_bar(&mut self.canvas, "velocity-scale", at, arrows.per_speed, speed, what);
    }

    fn entries(&self) -> Vec<(Sample, String)> {
        let vehicles = &self.scene.vehicles;
        let is_plain = self.scene.is_plain;
        let mut entries = Vec::new();
        let motions = || vehicles.iter().filter_map(|vehicle| vehicle.motion.as_ref());
        if motions().next().is_some() {
            let [before, after] = if is_plain {
                ["speed and direction before impact", "speed and direction after impact"]
            } else {
                ["v: velocity of the CG before impact", "V: velocity of the CG after impact"]
            };
            entries.push((Sample::Arrow(BEFORE, Head::Filled), before.to_owned()));
            if !is_plain || motions().any(|motion| vec2(motion.after.vector).hypot() >= SLOWEST) {
                entries.push((Sample::Arrow(AFTER, Head::Open), after.to_owned()));
            }
            if !is_plain {
                let impulse = "P: impulse on vehicle 1 (−P on 2)".to_owned();
                entries.push((Sample::Arrow(IMPULSE, Head::Filled), impulse));
                entries.push((Sample::Arrow(PDOF, Head::Open), "PDOF, drawn to the CG".to_owned()));
            }
        }
        if !is_plain {
            entries.push((Sample::Line(PLANE), "crush plane, with axes n and t".to_owned()));
            entries.push((Sample::Dot(None, BLACK), "C: contact point of the impulse".to_owned()));
            entries.push((Sample::CentreOfGravity, "CG: centre of gravity".to_owned()));
        }
        let outlines = || {
            vehicles.iter().enumerate().filter_map(|(i, vehicle)| match &vehicle.body {
                SceneBody::Outline { footprint, crush } => Some((i, vehicle, footprint, crush)),
                _ => None,
            })
        };
        if outlines().any(|(_, _, footprint, _)| footprint.shape == BodyShape::Car) {
            entries.push(legend::windscreen());
        }
        if !is_plain && outlines().any(|(_, vehicle, ..)| !vehicle.is_fixed) {
            entries.push((Sample::Line(HEADING), "heading, from the CG to the front".to_owned()));
        }
        if let Some((i, ..)) = outlines().find(|(.., crush)| crush.is_some()) {
            entries.push((Sample::Line(undamaged(i)), "shape before the damage".to_owned()));
        }
        for (i, vehicle) in vehicles.iter().enumerate() {
            let Some(text) = vehicle.legend.clone() else { continue };
            entries.push((vehicle.body.sample(Some(self.wall), i, &self.canvas), text));
        }
        entries
    }
}
