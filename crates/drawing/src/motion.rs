//! The motion: both vehicles from their approach through the impact to rest, seen from above.

use kurbo::{Affine, BezPath, Point, Rect, Shape as _, Vec2};

use crate::body::SceneBody;
use crate::canvas::{Canvas, Head};
use crate::finished::Drawing;
use crate::font::{self, SMALL};
use crate::footprint::{BodyShape, Footprint};
use crate::ground::GroundZone;
use crate::legend::{self, EDGE, HEADER, Sample, ScaleUnit, WIDTH};
use crate::number::number;
use crate::pens::{
    APPROACH, BLACK, EDGE_OF_GROUND, FILL, GREY, MARK, MEASURED, OUTLINE, PALE, PASSING, PATH, Pen, SKID,
    THIN, WHITE,
};
use crate::plan::{self, Contact, Pose, View, extent};
use crate::plan_view::{PlanBody, PlanView, Viewport};
use crate::scene::SceneArrow;
use crate::site_plan::{Backdrop, SitePlan};
use crate::symbol::{Marker, Symbol};
use crate::thin::thinned;
use crate::ticks;
use crate::vector::{flipped, polyline, unit, vec2};

const NAME: &str = "motion";

/// (px) minimum and maximum height of the picture, below the title.
const LOWEST: f64 = 300.0;
const HIGHEST: f64 = 760.0;
/// (px) margin around the outermost point, for labels: on all sides; above and below if the height is free.
const MARGIN: f64 = 34.0;
const ABOVE: f64 = 62.0;
/// (px/m) the largest scale.
const LARGEST: f64 = 90.0;
/// (px) length of the approach arrow, and its distance from the vehicle.
const APPROACH_LENGTH: f64 = 80.0;
const BEFORE_VEHICLE: f64 = 7.0;
/// (px) length of the arrow uphill.
const UPHILL: f64 = 34.0;
/// (px) radius of the dots at equal times, of the centre of gravity (minimum and maximum), and of the mark of
/// the impact.
const AT_TIME: f64 = 2.4;
const CENTRE: [f64; 2] = [2.0, 4.0];
const IMPACT: f64 = 6.0;
/// Maximum number of outlines between impact and rest, and their minimum distance in lengths of the vehicle.
/// More would be a tangle.
const MOST_OUTLINES: u32 = 6;
const APART: f64 = 0.6;
/// Maximum number of dots at equal times on the longest path.
const MOST_TIMES: f64 = 9.0;
/// (px) minimum width of a vehicle whose windscreen is drawn.
const WITH_DETAIL: f64 = 5.0;

const MEASURED_POINT: Symbol = Symbol { marker: Marker::Diamond, is_filled: false };
const MEASURED_CENTRE: Pen = Pen { dashes: "", ..MEASURED };
const IMPACT_PEN: Pen = Pen { colour: BLACK, width: 2.4, dashes: "" };
const UPHILL_PEN: Pen = Pen { colour: GREY, width: 2.0, dashes: "" };

/// Plan view of the motion of both vehicles.
///
/// Positions are those of one scene with y to the left of x, whichever axes are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionPicture {
    /// Title of the case.
    pub title: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// Why this is not the answer, shown below the title; usually empty.
    pub caveat: String,
    /// Whether the axes that are shown have y to the right.
    pub is_z_down: bool,
    /// Whether the picture is for readers who are not engineers: no axes and no abbreviations.
    pub is_plain: bool,
    /// Vehicles 1 and 2, as far as they are known.
    pub vehicles: [Option<MotionVehicle>; 2],
    /// (m) the point of impact.
    pub impact: Option<[f64; 2]>,
    /// Normal of the crush plane, from vehicle 2 to vehicle 1; a unit vector. A wall or a pole is drawn at
    /// the point of impact, on its side of this plane, if both are known.
    pub normal: Option<[f64; 2]>,
    /// Parts of the ground, the later ones over the earlier ones.
    pub ground: Vec<GroundZone>,
    /// Up the slope, with its grade.
    pub uphill: Option<SceneArrow>,
    /// Drawn behind everything.
    pub site_plan: Option<SitePlan>,
    /// Unit of the scale bar.
    pub length: ScaleUnit,
    /// Unit of the time between two dots on a path; its size is in seconds.
    pub time: ScaleUnit,
}

/// A vehicle that moves, or what it hits.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionVehicle {
    /// Label at its position at impact.
    pub name: String,
    /// Legend entry of its body.
    pub legend: Option<String>,
    /// Its shape. If its crush is known, the damaged body is drawn.
    pub body: SceneBody,
    /// (m) its centre of gravity at impact.
    pub cg: [f64; 2],
    /// Its heading at impact; a unit vector.
    pub forward: [f64; 2],
    /// The direction of its velocity before the impact; `None` if it was at rest.
    pub approach: Option<SceneArrow>,
    /// From the impact on, in the order of time.
    pub path: Vec<MotionPoint>,
    /// Its computed rest position; `None` if the motion was solved to end at the measured rest position,
    /// since their agreement then shows nothing.
    pub rest: Option<MotionRest>,
    /// Its measured rest position.
    pub measured_rest: Option<MotionRest>,
    /// Points of its path that were measured.
    pub measured_points: Vec<MeasuredPoint>,
    /// (m) its tyre marks: a line for each stretch on which a wheel slides.
    pub marks: Vec<Vec<[f64; 2]>>,
    /// (m) beginning and end of each skid mark before the impact.
    pub skids: Vec<[[f64; 2]; 2]>,
}

/// The pose of a vehicle at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionPoint {
    /// (s) since the impact.
    pub time: f64,
    /// (m) its centre of gravity.
    pub cg: [f64; 2],
    /// Its heading; a unit vector.
    pub forward: [f64; 2],
}

/// The rest position of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionRest {
    /// (m) its centre of gravity.
    pub cg: [f64; 2],
    /// Its heading, if known; a unit vector.
    pub forward: Option<[f64; 2]>,
    /// Its label.
    pub label: String,
}

/// A measured point.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredPoint {
    /// (m)
    pub at: [f64; 2],
    /// Its label.
    pub label: String,
}

impl MotionPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        self.draw_within(None).0
    }

    /// Draws this part of the scene, or all of it, and returns where everything is.
    #[must_use]
    pub fn draw_within(&self, viewport: Option<Viewport>) -> (Drawing, PlanView) {
        let widest = Rect::new(EDGE, HEADER, WIDTH - EDGE, HEADER + HIGHEST);
        let given = viewport.and_then(|viewport| {
            let height = widest.width() * (viewport.top - viewport.bottom) / (viewport.right - viewport.left);
            let area = Rect { y1: HEADER + height.clamp(LOWEST, HIGHEST), ..widest };
            Some((area, viewport.view(area)?))
        });
        let (area, view) = given.unwrap_or_else(|| self.fitted(widest));

        let below = format!("Plan view from approach to rest, to scale\n{}", self.caveat);
        let canvas = legend::page(NAME, WIDTH, &self.title, &below);
        let mut page = Page { canvas, motion: self, area, view, step: self.step() };
        page.ground();
        // Marks lie above the vehicle that begins to make them, and below the one that has made them.
        for layer in
            [Page::skids, Page::at_impact, Page::passing, Page::marks, Page::at_rest, Page::path, Page::edges]
        {
            for (i, vehicle) in self.each() {
                layer(&mut page, vehicle, i);
            }
        }
        page.impact();
        for (i, vehicle) in self.each() {
            page.labels(vehicle, i);
        }
        page.names_of_ground();
        page.canvas.place_labels(area.inset(-2.0));
        (page.below(), self.plan_view(view, area))
    }

    /// (px) the part of the widest area that the motion needs, and its view there.
    fn fitted(&self, widest: Rect) -> (Rect, View) {
        let largest = View::fit(widest.inset((-MARGIN, -ABOVE)), LARGEST, |scale| self.bounds(scale));
        let height = (self.bounds(largest.scale).height() + 2.0 * ABOVE).clamp(LOWEST, HIGHEST);
        let area = Rect { y1: HEADER + height, ..widest };
        (area, View::fit(area.inset((-MARGIN, -ABOVE)), LARGEST, |scale| self.bounds(scale)))
    }

    fn plan_view(&self, view: View, area: Rect) -> PlanView {
        let body = |i: usize| {
            let vehicle = self.vehicles.get(i)?.as_ref()?;
            let measured = vehicle.measured_rest.as_ref();
            Some(PlanBody {
                rest: measured.and_then(|rest| Some((rest.cg, rest.forward?))),
                points: vehicle.measured_points.iter().map(|point| point.at).collect(),
                ..self.body_at(vehicle, i, vehicle.at_impact())
            })
        };
        PlanView {
            viewport: Viewport::of(view, area),
            origin: [view.origin.x, view.origin.y],
            scale: view.scale,
            contact: self.impact,
            normal: self.normal,
            bodies: [body(0), body(1)],
        }
    }

    /// Both vehicles at a time (s) since the impact, as far as they are known. Before the impact each drives
    /// straight on; after the end of its path it is at rest.
    #[must_use]
    pub fn bodies_at(&self, time: f64) -> [Option<PlanBody>; 2] {
        [0, 1].map(|i| {
            let vehicle = self.vehicles.get(i)?.as_ref()?;
            Some(self.body_at(vehicle, i, vehicle.pose_at_any(time)))
        })
    }

    /// (s) time from the impact until the last vehicle stops.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.each().filter_map(|(_, vehicle)| Some(vehicle.path.last()?.time)).fold(0.0, f64::max)
    }

    fn body_at(&self, vehicle: &MotionVehicle, i: usize, pose: Pose) -> PlanBody {
        let outline = |contact: Contact| contact.outline(&vehicle.body, self.wall_ends(contact), i);
        PlanBody::of(&vehicle.body, pose, self.contact().and_then(outline))
    }

    fn each(&self) -> impl Iterator<Item = (usize, &MotionVehicle)> {
        self.vehicles.iter().enumerate().filter_map(|(i, vehicle)| Some((i, vehicle.as_ref()?)))
    }

    fn contact(&self) -> Option<Contact> {
        Some(Contact { at: vec2(self.impact?), normal: unit(vec2(self.normal?)) })
    }

    fn wall_ends(&self, contact: Contact) -> [f64; 2] {
        let outline = |vehicle: &MotionVehicle| vehicle.body.outline_in(vehicle.at_impact());
        contact.wall_ends(self.vehicles.each_ref().map(|vehicle| vehicle.as_ref().and_then(outline)))
    }

    /// (px) extent of the picture, around the origin of the scene.
    fn bounds(&self, scale: f64) -> Rect {
        let mut points: Vec<Vec2> = self.impact.iter().map(|&at| vec2(at)).collect();
        let mut arrows = Vec::new();
        for (i, vehicle) in self.each() {
            match &vehicle.body {
                SceneBody::Outline { .. } | SceneBody::Unknown => {
                    points.extend(vehicle.poses().flat_map(|pose| vehicle.corners(pose)));
                }
                body => points.extend(
                    self.contact()
                        .into_iter()
                        .flat_map(|contact| contact.reach(body, || self.wall_ends(contact), i)),
                ),
            }
            points.extend(vehicle.path.iter().map(|point| vec2(point.cg)));
            points.extend(vehicle.measured_points.iter().map(|point| vec2(point.at)));
            points.extend(vehicle.marks.iter().flatten().map(|&at| vec2(at)));
            points.extend(vehicle.skids.iter().flatten().map(|&at| vec2(at)));
            arrows.extend(vehicle.approach_arrow(View { origin: Point::ZERO, scale }).map(|(tail, _)| tail));
        }
        extent(points.into_iter().map(|point| (flipped(point) * scale).to_point()).chain(arrows))
    }

    /// (units of time) between two dots at equal times: a round number.
    fn step(&self) -> Option<f64> {
        let size = self.time.size;
        let moving = self.each().filter_map(|(_, vehicle)| Some((vehicle, vehicle.path.last()?)));
        let longest = moving.max_by(|(one, _), (other, _)| one.distance().total_cmp(&other.distance()));
        let (vehicle, last) = longest?;
        let apart = APART * vehicle.length();
        let most = (vehicle.distance() / apart).clamp(1.0, MOST_TIMES);
        let (times, _) = ticks::between(0.0, last.time / size, most);
        // A path without a dot between its ends has none.
        times.get(1).copied().filter(|step| *step < last.time / size)
    }
}

impl MotionVehicle {
    fn at_impact(&self) -> Pose {
        Pose::new(self.cg, self.forward)
    }

    fn has_outline_at(&self, rest: &MotionRest) -> bool {
        matches!(self.body, SceneBody::Outline { .. }) && rest.forward.is_some()
    }

    fn has_shape(&self, shape: BodyShape) -> bool {
        matches!(&self.body, SceneBody::Outline { footprint, .. } if footprint.shape == shape)
    }

    fn is_fixed(&self) -> bool {
        match &self.body {
            SceneBody::Outline { footprint, .. } => footprint.shape == BodyShape::Fixed,
            SceneBody::Pole { .. } | SceneBody::Wall => true,
            SceneBody::Unknown => false,
        }
    }

    /// Its poses at impact, on its path and at rest.
    fn poses(&self) -> impl Iterator<Item = Pose> {
        let rests = [&self.rest, &self.measured_rest].into_iter().flatten();
        std::iter::once(self.at_impact())
            .chain(rests.filter_map(MotionRest::pose))
            .chain(self.path.iter().map(|point| Pose::new(point.cg, point.forward)))
    }

    /// (m) corners of the body in this pose.
    fn corners(&self, pose: Pose) -> Vec<Vec2> {
        match &self.body {
            SceneBody::Outline { footprint, .. } => {
                footprint.corners().map(|corner| (pose.in_scene() * corner).to_vec2()).to_vec()
            }
            _ => vec![pose.cg],
        }
    }

    /// (m) length of its path.
    fn distance(&self) -> f64 {
        self.path.windows(2).map(|pair| (vec2(pair[1].cg) - vec2(pair[0].cg)).hypot()).sum()
    }

    /// (m)
    fn length(&self) -> f64 {
        match &self.body {
            SceneBody::Outline { footprint, .. } => footprint.length,
            // A body without an outline only needs room for its symbol.
            _ => 1.0,
        }
    }

    /// The drawn rest position: the computed one or, if the motion was solved for the measured one, that one.
    fn drawn_rest(&self) -> Option<&MotionRest> {
        self.rest.as_ref().or(self.measured_rest.as_ref())
    }

    /// Its poses at equal distances between the impact and the end of its path.
    fn passing(&self) -> Vec<Pose> {
        let distance = self.distance();
        let spaces = (1..=MOST_OUTLINES + 1).rev();
        // As many intervals as are long enough.
        let Some(spaces) = spaces.into_iter().find(|&n| distance > APART * self.length() * f64::from(n))
        else {
            return Vec::new();
        };
        let way = |k: u32| distance * f64::from(k) / f64::from(spaces);
        (1..spaces).filter_map(|k| self.pose_after(way(k))).collect()
    }

    /// Its pose after a distance (m) along its path.
    fn pose_after(&self, way: f64) -> Option<Pose> {
        let mut gone = 0.0;
        for pair in self.path.windows(2) {
            let [from, to] = pair else { continue };
            let step = (vec2(to.cg) - vec2(from.cg)).hypot();
            if step > 0.0 && gone + step >= way {
                return Some(from.towards(to, (way - gone) / step));
            }
            gone += step;
        }
        None
    }

    /// Its pose at a time (s), with straight lines between the points of its path.
    fn pose_at(&self, time: f64) -> Option<Pose> {
        let after = self.path.partition_point(|point| point.time < time);
        let next = self.path.get(after)?;
        let Some(last) = after.checked_sub(1).and_then(|before| self.path.get(before)) else {
            return (next.time <= time).then(|| Pose::new(next.cg, next.forward));
        };
        Some(last.towards(next, (time - last.time) / (next.time - last.time)))
    }

    fn pose_at_any(&self, time: f64) -> Pose {
        let impact = self.at_impact();
        if time < 0.0 {
            let velocity = self.approach.as_ref().map_or(Vec2::ZERO, |approach| vec2(approach.vector));
            return Pose { cg: impact.cg + velocity * time, ..impact };
        }
        let end = self.path.last().map(|point| Pose::new(point.cg, point.forward));
        self.pose_at(time).or(end).unwrap_or(impact)
    }

    /// The approach arrow, from its tail to its tip, which is where the vehicle begins.
    fn approach_arrow(&self, view: View) -> Option<(Point, Point)> {
        let direction = unit(vec2(self.approach.as_ref()?.vector));
        let pose = self.at_impact();
        let reach = self.corners(pose).into_iter().map(|corner| (pose.cg - corner).dot(direction));
        let reach = reach.fold(0.0, f64::max) * view.scale + BEFORE_VEHICLE;
        let back = |length: f64| view.at(pose.cg) - flipped(direction) * length;
        Some((back(reach + APPROACH_LENGTH), back(reach)))
    }
}

impl MotionPoint {
    /// The pose at a share of the straight way from here to there.
    fn towards(&self, to: &Self, share: f64) -> Pose {
        let between = |from: [f64; 2], to: [f64; 2]| vec2(from) + (vec2(to) - vec2(from)) * share;
        Pose { cg: between(self.cg, to.cg), forward: unit(between(self.forward, to.forward)) }
    }
}

impl MotionRest {
    fn pose(&self) -> Option<Pose> {
        self.forward.map(|forward| Pose::new(self.cg, forward))
    }
}

struct Page<'a> {
    canvas: Canvas,
    motion: &'a MotionPicture,
    /// (px) area of the motion.
    area: Rect,
    view: View,
    /// (units of time) between two dots at equal times.
    step: Option<f64>,
}

impl Page<'_> {
    fn ground(&mut self) {
        if let Some(plan) = &self.motion.site_plan {
            let page_of_scene = Affine::translate(self.view.origin.to_vec2())
                * Affine::scale_non_uniform(self.view.scale, -self.view.scale);
            self.canvas.backdrop = Some(Backdrop::new(plan, page_of_scene, self.area));
        }
        for (k, zone) in self.zones() {
            let name = format!("ground-{}", k + 1);
            // Neighbours differ in the direction of their hatching.
            let degrees = if k.is_multiple_of(2) { 60 } else { -60 };
            self.canvas.define_stripes(&name, PALE, "none", degrees, 9.0);
            let fill = self.canvas.pattern(&name);
            self.canvas.path(&format!("zone-{}", k + 1), &zone, Some(EDGE_OF_GROUND), &fill);
        }
        if self.motion.site_plan.is_some() || !self.motion.ground.is_empty() {
            self.canvas.rect("frame", self.area, Some(THIN), "none");
        }
    }

    /// The visible parts of the ground zones, with their numbers.
    fn zones(&self) -> Vec<(usize, BezPath)> {
        let zones = self.motion.ground.iter().enumerate();
        zones.filter_map(|(k, zone)| Some((k, zone.shape.on_page(self.view, self.area)?))).collect()
    }

    fn names_of_ground(&mut self) {
        for (k, zone) in self.zones() {
            let text = font::cut(&self.motion.ground[k].label, SMALL, 320.0);
            self.canvas.labels.label_within(&zone, zone.bounding_box().center(), &text, BLACK);
        }
    }

    fn at_rest(&mut self, vehicle: &MotionVehicle, _: usize) {
        if let Some(rest) = vehicle.drawn_rest().and_then(MotionRest::pose) {
            self.filled(vehicle, rest, WHITE);
        }
    }

    fn filled(&mut self, vehicle: &MotionVehicle, pose: Pose, fill: &str) {
        let SceneBody::Outline { footprint, crush } = &vehicle.body else { return };
        let body = self.view.place(pose) * footprint.left_by(crush.as_ref());
        self.canvas.path("", &body, None, fill);
        self.canvas.labels.keep_off(&body, false);
    }

    /// Draws its body at impact, or the fixed object.
    fn at_impact(&mut self, vehicle: &MotionVehicle, i: usize) {
        let contact = self.motion.contact().map(|contact| (contact, self.motion.wall_ends(contact)));
        match vehicle.body.fixed_on(self.view, vehicle.at_impact(), contact, i) {
            Some(fixed) => plan::fixed(&mut self.canvas, &format!("impact-{}", i + 1), &fixed),
            None => self.filled(vehicle, vehicle.at_impact(), FILL[i]),
        }
    }

    fn marks(&mut self, vehicle: &MotionVehicle, _: usize) {
        for mark in &vehicle.marks {
            let points: Vec<Point> = mark.iter().map(|&at| self.view.at(vec2(at))).collect();
            self.canvas.path("", &polyline(thinned(&points)), Some(MARK), "none");
        }
    }

    fn skids(&mut self, vehicle: &MotionVehicle, i: usize) {
        for (k, &[from, to]) in vehicle.skids.iter().enumerate() {
            let [from, to] = [from, to].map(|at| self.view.at(vec2(at)));
            self.canvas.line(&format!("skid-{}-{}", i + 1, k + 1), from, to, SKID);
        }
    }

    /// Draws its outlines at equal distances.
    fn passing(&mut self, vehicle: &MotionVehicle, i: usize) {
        if let SceneBody::Outline { footprint, crush } = &vehicle.body {
            for (k, pose) in vehicle.passing().into_iter().enumerate() {
                let there = self.view.place(pose);
                let body = there * footprint.left_by(crush.as_ref());
                self.canvas.path(&format!("passing-{}-{}", i + 1, k + 1), &body, Some(PASSING[i]), "none");
                self.detail(vehicle, pose, PASSING[i]);
            }
        }
    }

    /// Draws the path of its centre of gravity.
    fn path(&mut self, vehicle: &MotionVehicle, i: usize) {
        let points: Vec<Point> = vehicle.path.iter().map(|point| self.view.at(vec2(point.cg))).collect();
        if points.len() > 1 {
            let path = polyline(thinned(&points));
            self.canvas.path(&format!("path-{}", i + 1), &path, Some(PATH[i]), "none");
        }
        for pose in self.at_equal_times(vehicle) {
            self.canvas.dot("", self.view.at(pose.cg), AT_TIME, None, PATH[i].colour);
        }
    }

    /// Its poses at equal times between the impact and the end of its path.
    fn at_equal_times(&self, vehicle: &MotionVehicle) -> Vec<Pose> {
        let Some(step) = self.step else { return Vec::new() };
        let end = vehicle.path.last().map_or(0.0, |point| point.time) / self.motion.time.size;
        // The one at the end is drawn as the rest position.
        let (times, _) = ticks::between(step, end * (1.0 - 1e-9), end / step);
        times.iter().filter_map(|time| vehicle.pose_at(time * self.motion.time.size)).collect()
    }

    /// Draws its windscreen or chevron.
    fn detail(&mut self, vehicle: &MotionVehicle, pose: Pose, pen: Pen) {
        let SceneBody::Outline { footprint, crush } = &vehicle.body else { return };
        if footprint.width * self.view.scale < WITH_DETAIL {
            return;
        }
        let front = footprint.detail(crush.as_ref()).unwrap_or_else(|| chevron(footprint));
        let pen = Pen { width: pen.width.min(1.0), ..pen };
        self.canvas.path("", &(self.view.place(pose) * front), Some(pen), "none");
    }

    /// Draws its outlines at impact and at rest, and its approach.
    fn edges(&mut self, vehicle: &MotionVehicle, i: usize) {
        let at_impact = (format!("impact-{}", i + 1), vehicle.at_impact(), OUTLINE[i]);
        let computed = vehicle.rest.as_ref().and_then(MotionRest::pose);
        let computed = computed.map(|pose| (format!("rest-{}", i + 1), pose, OUTLINE[i]));
        let measured = vehicle.measured_rest.as_ref().and_then(MotionRest::pose);
        let measured = measured.map(|pose| (format!("measured-rest-{}", i + 1), pose, MEASURED));
        for (id, pose, pen) in std::iter::once(at_impact).chain(computed).chain(measured) {
            if let SceneBody::Outline { footprint, crush } = &vehicle.body
                && footprint.shape != BodyShape::Fixed
            {
                let there = self.view.place(pose) * footprint.left_by(crush.as_ref());
                self.canvas.path(&id, &there, Some(pen), "none");
                self.detail(vehicle, pose, pen);
            }
        }
        if !vehicle.is_fixed() {
            // Small enough that the vehicle is visible around it.
            let centre = match &vehicle.body {
                SceneBody::Outline { footprint, .. } => 0.16 * footprint.width * self.view.scale,
                _ => CENTRE[1],
            };
            let centre = centre.clamp(CENTRE[0], CENTRE[1]);
            let computed = std::iter::once(vehicle.cg).chain(vehicle.rest.iter().map(|rest| rest.cg));
            for cg in computed {
                self.canvas.dot("", self.view.at(vec2(cg)), centre, None, PATH[i].colour);
            }
            if let Some(rest) = &vehicle.measured_rest {
                self.canvas.dot("", self.view.at(vec2(rest.cg)), centre, Some(MEASURED_CENTRE), WHITE);
            }
        }
        if let Some((tail, tip)) = vehicle.approach_arrow(self.view) {
            self.canvas.arrow(&format!("approach-{}", i + 1), tail, tip, APPROACH, Head::Filled);
        }
        for point in &vehicle.measured_points {
            MEASURED_POINT.draw(&mut self.canvas, "", self.view.at(vec2(point.at)));
        }
    }

    fn impact(&mut self) {
        let Some(at) = self.motion.impact.map(|at| self.view.at(vec2(at))) else { return };
        let cross = legend::cross(at, IMPACT);
        self.canvas.path("", &cross, Some(Pen { width: 5.0, colour: WHITE, dashes: "" }), "none");
        self.canvas.path("impact", &cross, Some(IMPACT_PEN), "none");
        self.canvas.labels.protect(Rect::from_center_size(at, (2.0 * IMPACT, 2.0 * IMPACT)));
    }

    fn labels(&mut self, vehicle: &MotionVehicle, i: usize) {
        if let Some((tail, _)) = vehicle.approach_arrow(self.view)
            && let Some(approach) = &vehicle.approach
        {
            self.canvas.labels.label_beside(tail, &approach.label, BLACK);
        }
        for rest in [&vehicle.rest, &vehicle.measured_rest].into_iter().flatten() {
            self.canvas.labels.label_beside(self.view.at(vec2(rest.cg)), &rest.label, BLACK);
        }
        for point in &vehicle.measured_points {
            self.canvas.labels.label_of_point(self.view.at(vec2(point.at)), &point.label, BLACK);
        }
        let at = match (&vehicle.body, self.motion.contact()) {
            (SceneBody::Pole { diameter }, Some(contact)) => contact.pole(*diameter, i),
            (SceneBody::Wall, Some(contact)) => {
                let [_, outer, inner, _] = contact.wall(self.motion.wall_ends(contact), i);
                (outer + inner) * 0.5
            }
            _ => vec2(vehicle.cg),
        };
        self.canvas.labels.label_beside(self.view.at(at), &font::cut(&vehicle.name, SMALL, 240.0), BLACK);
    }

    /// Draws scales and legend.
    fn below(mut self) -> Drawing {
        let motion = self.motion;
        let row = self.area.y1 + 34.0;
        let at = Point::new(EDGE + 4.0, row);
        legend::scale_bar(&mut self.canvas, "scale", at, self.view.scale, &motion.length, "");
        let mut bottom = row + 22.0;
        if let Some(uphill) = &motion.uphill {
            let half = flipped(unit(vec2(uphill.vector))) * (0.5 * UPHILL);
            let middle = Point::new(0.5 * WIDTH - 60.0, row);
            self.canvas.arrow("uphill", middle - half, middle + half, UPHILL_PEN, Head::Filled);
            let text = font::cut(&uphill.label, SMALL, 280.0);
            let left = Point::new(middle.x + 0.5 * UPHILL + 12.0, row + 4.5);
            self.canvas.text(left, &text, SMALL, font::Anchor::Start, BLACK);
        }
        if !motion.is_plain {
            let drop = if motion.is_z_down { -8.0 } else { 32.0 };
            plan::axes(&mut self.canvas, Point::new(WIDTH - EDGE - 62.0, row + drop), motion.is_z_down);
            bottom = row + if motion.is_z_down { 60.0 } else { 44.0 };
        }
        let entries = self.entries();
        self.canvas.height = legend::legend(&mut self.canvas, bottom, 3, &entries) + 10.0;
        let title = format!("{}: motion from approach to rest", motion.title);
        Drawing::new(title, motion.description.clone(), self.canvas)
    }

    fn entries(&self) -> Vec<(Sample, String)> {
        let motion = self.motion;
        let any = |has: fn(&MotionVehicle) -> bool| motion.each().any(|(_, vehicle)| has(vehicle));
        let mut entries = Vec::new();
        for (i, vehicle) in motion.each() {
            let Some(text) = vehicle.legend.clone() else { continue };
            let ends = motion.contact().map(|contact| motion.wall_ends(contact));
            entries.push((vehicle.body.sample(ends, i, &self.canvas), text));
        }
        let mut add = |is_there: bool, sample: Sample, text: &str| {
            if is_there {
                entries.push((sample, text.to_owned()));
            }
        };
        let is_plain = motion.is_plain;
        let word = |plain: &'static str, other: &'static str| if is_plain { plain } else { other };
        add(motion.impact.is_some(), Sample::Cross(IMPACT_PEN), "place of the impact");
        let approach = word("direction before the impact", "direction of the approach");
        add(any(|vehicle| vehicle.approach.is_some()), Sample::Arrow(APPROACH, Head::Filled), approach);
        let moving = motion.each().filter(|(_, vehicle)| vehicle.path.len() > 1).map(|(i, _)| i).next();
        let path = word("path of the vehicle", "path of the CG");
        let every = self.step.map(|step| format!("{} {}", with_few_decimals(step), motion.time.name));
        if let Some(i) = moving {
            let text = every.as_ref().map_or(path.to_owned(), |every| format!("{path}, a dot every {every}"));
            add(true, Sample::Line(PATH[i]), &text);
        }
        let passing = motion.each().find(|(_, vehicle)| {
            matches!(vehicle.body, SceneBody::Outline { .. }) && !vehicle.passing().is_empty()
        });
        if let Some((i, _)) = passing {
            add(true, Sample::Box(PASSING[i], "none".to_owned()), "outlines, equally far apart");
        }
        let computed =
            |vehicle: &MotionVehicle| vehicle.rest.as_ref().map(|rest| vehicle.has_outline_at(rest));
        let resting = motion.each().filter_map(|(i, vehicle)| Some((computed(vehicle)?, i)));
        if let Some((has_outline, i)) = resting.max_by_key(|(has_outline, _)| *has_outline) {
            let sample = match has_outline {
                true => Sample::Box(OUTLINE[i], WHITE.to_owned()),
                false => Sample::Dot(None, PATH[i].colour),
            };
            add(true, sample, "at rest, as computed");
        }
        let measured =
            |vehicle: &MotionVehicle| vehicle.measured_rest.as_ref().map(|rest| vehicle.has_outline_at(rest));
        if let Some(has_outline) = motion.each().filter_map(|(_, vehicle)| measured(vehicle)).max() {
            let sample = match has_outline {
                true => Sample::Box(MEASURED, "none".to_owned()),
                false => Sample::Dot(Some(MEASURED_CENTRE), WHITE),
            };
            add(true, sample, word("at rest, as found", "at rest, as measured"));
        }
        let points = any(|vehicle| !vehicle.measured_points.is_empty());
        add(points, Sample::Symbol(MEASURED_POINT), "measured point of the path");
        let marks = any(|vehicle| !vehicle.marks.is_empty());
        add(marks, Sample::Line(MARK), word("tyre mark, as computed", "mark of a wheel that slides"));
        let skids = any(|vehicle| !vehicle.skids.is_empty());
        add(skids, Sample::Line(SKID), "skid mark before the impact");
        add(!motion.ground.is_empty(), Sample::Line(EDGE_OF_GROUND), "edge of a part of the ground");
        if any(|vehicle| vehicle.has_shape(BodyShape::Car)) {
            entries.push(legend::windscreen());
        }
        if any(|vehicle| vehicle.has_shape(BodyShape::Box)) {
            entries.push((Sample::Chevron(THIN), "angle: points to the front".to_owned()));
        }
        entries
    }
}

/// A round number.
fn with_few_decimals(step: f64) -> String {
    let text = number(step, 6);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The mark that distinguishes front from rear on a body without a windscreen: a chevron that points forward.
fn chevron(body: &Footprint) -> BezPath {
    let Footprint { length, width, cg_to_front, .. } = *body;
    let behind = cg_to_front - (0.25 * length).min(0.6 * width);
    polyline(
        [(behind, -0.3 * width), (cg_to_front - 0.04 * length, 0.0), (behind, 0.3 * width)].map(Point::from),
    )
}
