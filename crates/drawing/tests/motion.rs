//! The motion from approach to rest: the picture shows the given data, wherever the vehicles go.

use drawing::{
    Axis, BodyShape, CurveKind, Curves, CurvesPicture, Drawing, Footprint, GroundShape, GroundZone,
    MeasuredPoint, MotionPicture, MotionPoint, MotionRest, MotionVehicle, PlanPlace, ScaleUnit, SceneArrow,
    SceneBody, SitePlan, SitePlanError,
};
use kurbo::{Affine, BezPath, Point, Shape as _};
use resvg::tiny_skia::{Color, Paint, Pixmap, Rect, Transform};

use crate::reader::{Reader, area, attribute, number, scales};

/// (px) two decimals are written.
const PIXEL: f64 = 0.02;

fn text(words: &str) -> String {
    words.to_owned()
}

fn arrow(x: f64, y: f64, label: &str) -> SceneArrow {
    SceneArrow { vector: [x, y], label: text(label) }
}

/// (degrees) a unit vector.
fn direction(degrees: f64) -> [f64; 2] {
    #[expect(
        clippy::disallowed_methods,
        reason = "a test, which compares no bits with those of another machine"
    )]
    let (sin, cos) = degrees.to_radians().sin_cos();
    [cos, sin]
}

const CAR: Footprint = Footprint { length: 4.5, width: 1.8, cg_to_front: 2.1, shape: BodyShape::Car };
const VAN: Footprint = Footprint { length: 6.0, width: 2.1, cg_to_front: 2.7, shape: BodyShape::Box };

/// A spin-out that slows down evenly: at the share τ of its time it has covered 2 τ − τ² of its path, and has
/// turned by the same share of its turn. Its path bends by `bend` (m) to the left in the middle.
struct SpinOut {
    from: [f64; 2],
    to: [f64; 2],
    bend: f64,
    /// (degrees) at the impact, and by how much it turns.
    heading: f64,
    turn: f64,
    /// (s)
    time: f64,
    points: u32,
}

impl SpinOut {
    fn at(&self, share: f64) -> MotionPoint {
        let gone = 2.0 * share - share * share;
        let along = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt().max(1e-9);
        let aside = 4.0 * self.bend * gone * (1.0 - gone) / length;
        MotionPoint {
            time: share * self.time,
            cg: [
                self.from[0] + gone * along[0] - aside * along[1],
                self.from[1] + gone * along[1] + aside * along[0],
            ],
            forward: direction(self.heading + gone * self.turn),
        }
    }

    fn path(&self) -> Vec<MotionPoint> {
        (0..=self.points).map(|k| self.at(f64::from(k) / f64::from(self.points))).collect()
    }

    /// The mark of a wheel at a place in the axes of the vehicle (m), on a part of the vehicle's path.
    fn mark(&self, [x, y]: [f64; 2], from: f64, to: f64) -> Vec<[f64; 2]> {
        (0..=60)
            .map(|k| self.at(from + (to - from) * f64::from(k) / 60.0))
            .map(|MotionPoint { cg, forward: [c, s], .. }| [cg[0] + c * x - s * y, cg[1] + s * x + c * y])
            .collect()
    }

    fn vehicle(&self, name: &str, footprint: Footprint) -> MotionVehicle {
        let (first, last) = (self.at(0.0), self.at(1.0));
        MotionVehicle {
            name: text(name),
            legend: Some(format!("{name}, as given")),
            body: SceneBody::Outline { footprint, crush: None },
            cg: first.cg,
            forward: first.forward,
            approach: Some(SceneArrow { vector: first.forward, label: format!("{name}: before 52 km/h") }),
            path: self.path(),
            rest: Some(MotionRest {
                cg: last.cg,
                forward: Some(last.forward),
                label: format!("{name}: rest, computed"),
            }),
            measured_rest: None,
            measured_points: Vec::new(),
            marks: [[1.3, 0.75], [1.3, -0.75], [-1.4, 0.75], [-1.4, -0.75]]
                .map(|wheel| self.mark(wheel, 0.1, 0.7))
                .to_vec(),
            skids: Vec::new(),
        }
    }
}

fn picture(vehicles: [Option<MotionVehicle>; 2]) -> MotionPicture {
    MotionPicture {
        title: text("Motion"),
        description: text("Both vehicles spin to rest."),
        caveat: String::new(),
        is_z_down: false,
        is_plain: false,
        vehicles,
        impact: Some([0.0, 0.0]),
        normal: None,
        ground: Vec::new(),
        uphill: None,
        site_plan: None,
        length: ScaleUnit { name: text("m"), size: 1.0 },
        time: ScaleUnit { name: text("s"), size: 1.0 },
    }
}

const FIRST: SpinOut = SpinOut {
    from: [-1.9, 0.4],
    to: [17.0, 8.0],
    bend: 1.2,
    heading: 0.0,
    turn: 200.0,
    time: 2.9,
    points: 400,
};
const SECOND: SpinOut = SpinOut {
    from: [0.9, -1.2],
    to: [9.0, 15.0],
    bend: -0.8,
    heading: 90.0,
    turn: -95.0,
    time: 2.4,
    points: 400,
};

/// Two cars cross; both spin out, and were measured at rest.
pub(crate) fn crossing() -> MotionPicture {
    let mut first = FIRST.vehicle("1 · Rabbit", CAR);
    first.measured_rest = Some(MotionRest {
        cg: [17.6, 7.5],
        forward: Some(direction(188.0)),
        label: text("1: rest, measured"),
    });
    first.measured_points = vec![MeasuredPoint { at: FIRST.at(0.4).cg, label: text("mark A") }];
    let mut second = SECOND.vehicle("2 · Chevelle", CAR);
    second.measured_rest =
        Some(MotionRest { cg: [9.6, 14.4], forward: Some(direction(2.0)), label: text("2: rest, measured") });
    MotionPicture { ..picture([Some(first), Some(second)]) }
}

/// A rear-end collision on a straight road.
fn rear_end() -> MotionPicture {
    let straight = SpinOut { bend: 0.0, turn: 0.0, heading: 0.0, ..FIRST };
    let first = SpinOut { from: [-2.1, 0.2], to: [11.0, 0.4], ..straight };
    let second = SpinOut { from: [2.4, 0.0], to: [24.0, -0.6], turn: 4.0, time: 3.6, ..straight };
    let mut second = second.vehicle("2 · van", VAN);
    second.approach = None;
    picture([Some(first.vehicle("1 · car", CAR)), Some(second)])
}

pub(crate) fn on_ground() -> MotionPicture {
    MotionPicture {
        ground: vec![
            GroundZone {
                shape: GroundShape::HalfPlane { edge: [0.0, 9.0], into: [-0.05, 1.0] },
                label: text("grass, friction 0.35"),
            },
            GroundZone {
                shape: GroundShape::Polygon(vec![[4.0, -3.0], [10.0, -4.0], [11.0, 2.0], [5.0, 2.5]]),
                label: text("wet, friction 0.45"),
            },
        ],
        uphill: Some(arrow(1.0, 0.3, "uphill 4 %")),
        ..crossing()
    }
}

pub(crate) fn curves() -> CurvesPicture {
    let curve = |of: fn(f64) -> f64, time: f64| {
        (0..=300).map(|k| f64::from(k) / 300.0).map(|s| [s * time, of(s)]).collect()
    };
    let panel = |title: &str, unit: f64, curves: [Vec<[f64; 2]>; 2]| Curves {
        across: Axis { title: text("time since the impact (s)"), unit: 1.0 },
        ends: Some([0.0, 2.9]),
        upward: Axis { title: text(title), unit },
        curves,
        samples: Vec::new(),
        computed: Vec::new(),
        marks: Vec::new(),
    };
    let degree = 1.0_f64.to_radians();
    CurvesPicture {
        name: "motion-curves",
        title: text("Motion"),
        subtitle: text("Speed, yaw rate and heading from impact to rest"),
        caveat: String::new(),
        description: text("Both slow down."),
        height: 170.0,
        is_thinned: true,
        panels: vec![
            panel(
                "speed of the CG (km/h)",
                1.0 / 3.6,
                [curve(|s| 14.0 * (1.0 - s), 2.9), curve(|s| 12.0 * (1.0 - s), 2.4)],
            ),
            panel(
                "yaw rate (°/s)",
                degree,
                [curve(|s| 2.4 * (1.0 - s), 2.9), curve(|s| -1.4 * (1.0 - s), 2.4)],
            ),
            panel(
                "heading (°)",
                degree,
                [curve(|s| 3.49 * (2.0 * s - s * s), 2.9), curve(|s| 1.57 - 1.66 * (2.0 * s - s * s), 2.4)],
            ),
        ],
        legend: vec![(CurveKind::First, text("1 · Rabbit")), (CurveKind::Second, text("2 · Chevelle"))],
    }
}

/// The scale of a picture, from its numbers: the place of the impact, and the number of pixels per metre.
struct Scale {
    impact: [f64; 2],
    metre: f64,
}

impl Scale {
    fn of(svg: &str) -> Self {
        let ends = ["data-from", "data-to"].map(|name| attribute(svg, "motion-scale", name).unwrap());
        let [start, end] = ends.map(|at| at.split_once(' ').unwrap().0.parse::<f64>().unwrap());
        let cross = BezPath::from_svg(&attribute(svg, "motion-impact", "d").unwrap()).unwrap().bounding_box();
        let metre = (end - start) / number(svg, "motion-scale", "data-si");
        Self { impact: [cross.center().x, cross.center().y], metre }
    }

    /// (px) of a point of the scene (m), where the impact is at its origin.
    fn at(&self, [x, y]: [f64; 2]) -> Point {
        Point::new(self.impact[0] + x * self.metre, self.impact[1] - y * self.metre)
    }
}

fn near(one: Point, other: Point, most: f64) -> bool {
    (one - other).hypot() <= most
}

/// Everything that a picture can have, in all directions.
#[test]
fn bodies_and_paths_are_where_they_were_given() {
    let reader = Reader::new();
    for k in 0..24 {
        let [heading, way] = [f64::from(k) * 15.0, f64::from(k * 7 % 24) * 15.0];
        let turn = if k % 2 == 0 { 130.0 } else { -220.0 };
        let [c, s] = direction(way);
        let spin = SpinOut { from: [0.8, -0.5], to: [20.0 * c, 20.0 * s], heading, turn, ..FIRST };
        let mut vehicle = spin.vehicle("1", CAR);
        let found =
            MotionRest { cg: [19.0 * c, 19.0 * s], forward: Some(direction(way)), label: text("found") };
        vehicle.measured_rest = Some(found);
        let svg = picture([Some(vehicle), None]).draw().svg();
        reader.readable("motion", &svg);
        let tree = reader.tree(&svg);
        let scale = Scale::of(&svg);
        let last = spin.at(1.0);
        for (id, cg, forward) in [
            ("motion-impact-1", spin.from, direction(heading)),
            ("motion-rest-1", last.cg, last.forward),
            ("motion-measured-rest-1", [19.0 * c, 19.0 * s], direction(way)),
        ] {
            // The middle of the body lies 2.1 m − 2.25 m ahead of the CG.
            let middle = scale.at([cg[0] - 0.15 * forward[0], cg[1] - 0.15 * forward[1]]);
            let drawn = area(&tree, id);
            let [x, y] =
                [drawn.left() + drawn.right(), drawn.top() + drawn.bottom()].map(|sum| f64::from(sum) / 2.0);
            assert!(near(Point::new(x, y), middle, 0.1), "{k}: {id} at {x} {y}, not at {middle}");
            // The corner of the box is (1 − 1/√2) · 0.216 m inside of that of the body at most.
            let [along, across] = [forward[0].abs(), forward[1].abs()];
            let width = (4.5 * along + 1.8 * across) * scale.metre;
            let short = width - f64::from(drawn.width());
            assert!((-0.1..0.19 * scale.metre).contains(&short), "{k}: {id} is {short} px too narrow");
        }
        let path = BezPath::from_svg(&attribute(&svg, "motion-path-1", "d").unwrap()).unwrap();
        let ends =
            [path.elements().first(), path.elements().last()].map(|end| end.unwrap().end_point().unwrap());
        assert!(near(ends[0], scale.at(spin.from), 0.1) && near(ends[1], scale.at(last.cg), 0.1), "{k}");
        // The arrow of the approach ends behind the vehicle and points to its CG.
        let [tail, tip] = ["data-from", "data-to"].map(|name| {
            let at = attribute(&svg, "motion-approach-1", name).unwrap();
            let (x, y) = at.split_once(' ').unwrap();
            Point::new(x.parse().unwrap(), y.parse().unwrap())
        });
        let cg = scale.at(spin.from);
        let [gap, whole] = [cg - tip, cg - tail];
        assert!(gap.cross(whole).abs() < 0.1 * whole.hypot() && gap.dot(whole) > 0.0, "{k}");
        let [x, y] = direction(heading);
        assert!(gap.x * x - gap.y * y > 0.0, "{k}: it points ahead, as the vehicle does");
        // From the CG to the rear are 2.4 m.
        assert!(gap.hypot() > 2.4 * scale.metre && gap.hypot() < 2.4 * scale.metre + 10.0, "{k}");
    }
}

/// 2.9 s: at 0.5 s, 1 s, … 2.5 s, by the formula of the path.
#[test]
fn dots_are_at_equal_times() {
    let svg = picture([Some(FIRST.vehicle("1", CAR)), None]).draw().svg();
    let scale = Scale::of(&svg);
    let number = |line: &str, name: &str| -> f64 {
        line.split_once(&format!(" {name}=\"")).unwrap().1.split('"').next().unwrap().parse().unwrap()
    };
    let dots = svg.lines().filter(|line| line.starts_with("<circle") && line.contains(" r=\"2.4\""));
    let dots: Vec<Point> = dots.map(|line| Point::new(number(line, "cx"), number(line, "cy"))).collect();
    assert_eq!(dots.len(), 5);
    for (k, dot) in (1..).zip(dots) {
        let expected = scale.at(FIRST.at(0.5 * f64::from(k) / 2.9).cg);
        assert!(near(dot, expected, 0.1), "{k}: {dot} {expected}");
    }
    assert!(
        svg.contains(">path of the CG, a dot every 0.5 s<") && svg.contains(">outlines, equally far apart<")
    );
    // Six outlines, with their windscreens.
    let passing = svg.lines().filter(|line| line.starts_with("<path") && line.contains("stroke=\"#4a90c2\""));
    assert_eq!(passing.count(), 12);
}

#[test]
fn a_z_down_picture_has_other_axes_and_a_plain_one_has_none() {
    let [up, down] = [false, true].map(|is_z_down| MotionPicture { is_z_down, ..crossing() }.draw().svg());
    let body = |svg: &str| svg.split("id=\"motion-scale\"").next().unwrap().to_owned();
    assert_eq!(body(&up).split("viewBox").count(), 2);
    let without_size =
        |svg: &str| body(svg).split_once("<title").unwrap().1.split_once("<text").unwrap().1.to_owned();
    assert_eq!(without_size(&up), without_size(&down));
    let y = |svg: &str| attribute(svg, "motion-scene-y", "data-to").unwrap();
    let from = |svg: &str| attribute(svg, "motion-scene-y", "data-from").unwrap();
    let height = |at: String| at.split_once(' ').unwrap().1.parse::<f64>().unwrap();
    assert!(height(y(&up)) < height(from(&up)) && height(y(&down)) > height(from(&down)));
    let plain = MotionPicture { is_plain: true, ..crossing() }.draw().svg();
    Reader::new().readable("plain", &plain);
    assert!(!plain.contains("motion-scene-y") && !plain.contains("CG"), "{plain}");
}

/// Whatever is there and however far it goes.
#[test]
fn every_motion_can_be_read() {
    let reader = Reader::new();
    let one = |spin: &SpinOut| picture([Some(spin.vehicle("1 · car", CAR)), None]);
    let body = |body: SceneBody| {
        let fixed = MotionVehicle {
            body,
            approach: None,
            path: Vec::new(),
            rest: None,
            marks: Vec::new(),
            ..SECOND.vehicle("2 · fixed", CAR)
        };
        let back = SpinOut { from: [-2.1, 0.0], to: [-6.0, 1.5], turn: 40.0, ..FIRST };
        let car = back.vehicle("1 · car", CAR);
        MotionPicture { normal: Some([-1.0, 0.0]), ..picture([Some(car), Some(fixed)]) }
    };
    let unknown = |spin: &SpinOut| MotionVehicle { body: SceneBody::Unknown, ..spin.vehicle("unknown", CAR) };
    let still = MotionVehicle {
        path: vec![FIRST.at(0.0)],
        rest: None,
        marks: vec![vec![]],
        ..FIRST.vehicle("1", CAR)
    };
    let no_heading = MotionVehicle {
        forward: [0.0, 0.0],
        rest: Some(MotionRest { cg: [4.0, 1.0], forward: None, label: text("rest") }),
        measured_rest: Some(MotionRest { cg: [4.5, 1.0], forward: None, label: text("found") }),
        ..FIRST.vehicle("1", CAR)
    };
    let mut same_times = FIRST.vehicle("1", CAR);
    for point in &mut same_times.path {
        point.time = 1.0;
    }
    let fixed = Footprint { length: 0.4, width: 12.0, cg_to_front: 0.2, shape: BodyShape::Fixed };
    let empty = MotionPicture { impact: None, ..picture([None, None]) };
    let pictures = [
        ("crossing", crossing()),
        ("rear-end", rear_end()),
        ("ground", on_ground()),
        ("3 m", one(&SpinOut { to: [1.0, 1.0], bend: 0.1, turn: 20.0, ..FIRST })),
        ("100 m", one(&SpinOut { to: [100.0, -9.0], turn: 700.0, time: 8.0, ..FIRST })),
        ("100 m to the left of x", one(&SpinOut { to: [3.0, 100.0], turn: -700.0, time: 8.0, ..FIRST })),
        ("3 km", one(&SpinOut { to: [3000.0, 0.0], ..FIRST })),
        ("5,000 points", one(&SpinOut { points: 5000, ..FIRST })),
        ("two points", one(&SpinOut { points: 1, ..FIRST })),
        ("on one spot", picture([Some(FIRST.vehicle("1", CAR)), Some(FIRST.vehicle("2", CAR))])),
        ("no motion", one(&SpinOut { to: FIRST.from, bend: 0.0, turn: 0.0, ..FIRST })),
        ("wall", body(SceneBody::Wall)),
        ("pole", body(SceneBody::Pole { diameter: 0.5 })),
        ("barrier", body(SceneBody::Outline { footprint: fixed, crush: None })),
        ("wall of no place", MotionPicture { normal: None, ..body(SceneBody::Wall) }),
        ("unknown", picture([Some(unknown(&FIRST)), Some(unknown(&SECOND))])),
        ("at impact", picture([Some(still), None])),
        ("no heading", picture([Some(no_heading), None])),
        ("same times", picture([Some(same_times), None])),
        ("empty", empty),
    ];
    for (name, picture) in pictures {
        let svg = picture.draw().svg();
        let texts = reader.readable(name, &svg);
        assert!(["NaN", "inf", "…"].iter().all(|word| !svg.contains(word)), "{name}");
        assert!(svg.len() < 60_000, "{name}: {} bytes", svg.len());
        let rests =
            picture.vehicles.iter().flatten().flat_map(|vehicle| [&vehicle.rest, &vehicle.measured_rest]);
        for rest in rests.flatten() {
            assert!(texts.iter().any(|(words, _)| *words == rest.label), "{name}: {}", rest.label);
        }
    }
}

#[test]
fn a_wall_and_a_pole_stand_on_the_far_side_of_the_crush_plane() {
    let reader = Reader::new();
    for (normal, sign) in [([-1.0, 0.0], 1.0), ([1.0, 0.0], -1.0)] {
        for fixed in [SceneBody::Wall, SceneBody::Pole { diameter: 0.5 }] {
            let there = SpinOut { from: [-2.1 * sign, 0.0], to: [-6.0 * sign, 1.5], turn: 40.0, ..FIRST };
            let there = SpinOut { heading: if sign > 0.0 { 0.0 } else { 180.0 }, ..there };
            let object = MotionVehicle {
                body: fixed.clone(),
                path: Vec::new(),
                rest: None,
                approach: None,
                marks: Vec::new(),
                ..SECOND.vehicle("2", CAR)
            };
            let picture = MotionPicture {
                normal: Some(normal),
                ..picture([Some(there.vehicle("1", CAR)), Some(object)])
            };
            let svg = picture.draw().svg();
            let scale = Scale::of(&svg);
            let drawn = area(&reader.tree(&svg), "motion-impact-2");
            // Both are 0.5 m deep.
            let ends = [f64::from(drawn.left()), f64::from(drawn.right())]
                .map(|x| (x - scale.impact[0]) / scale.metre);
            let expected = if sign > 0.0 { [0.0, 0.5] } else { [-0.5, 0.0] };
            assert!(
                ends.iter().zip(expected).all(|(end, expected)| (end - expected).abs() < 0.01),
                "{fixed:?} {ends:?}"
            );
        }
    }
}

#[test]
fn parts_of_the_ground_are_named_on_themselves() {
    let reader = Reader::new();
    let svg = on_ground().draw().svg();
    let texts = reader.readable("ground", &svg);
    for (zone, name) in [(1, "grass, friction 0.35"), (2, "wet, friction 0.45")] {
        let path = BezPath::from_svg(&attribute(&svg, &format!("motion-zone-{zone}"), "d").unwrap()).unwrap();
        let (_, label) = texts.iter().find(|(words, _)| words == name).unwrap();
        for (x, y) in [(label.left(), label.top()), (label.right(), label.bottom())] {
            assert!(path.contains(Point::new(f64::from(x), f64::from(y))), "{name}");
        }
        let [frame, path] =
            [attribute(&svg, "motion-frame", "width"), Some(path.bounding_box().width().to_string())]
                .map(|width| width.unwrap().parse::<f64>().unwrap());
        assert!(if zone == 1 { (frame - path).abs() < PIXEL } else { frame > path }, "{name}");
    }
    // The corner at (4, −3) m.
    let corner = BezPath::from_svg(&attribute(&svg, "motion-zone-2", "d").unwrap()).unwrap();
    let scale = Scale::of(&svg);
    assert!(near(corner.elements()[0].end_point().unwrap(), scale.at([4.0, -3.0]), 0.1));
    let [from, to] = ["data-from", "data-to"].map(|name| attribute(&svg, "motion-uphill", name).unwrap());
    assert!(from != to && svg.contains(">uphill 4 %<"));
}

/// 16 × 8 pixels as those of `plans/colour.jpg`: the left half is red, the right one blue.
fn png() -> Vec<u8> {
    let mut pixels = Pixmap::new(16, 8).unwrap();
    for (x, red, blue) in [(0.0, 200, 0), (8.0, 0, 200)] {
        let mut paint = Paint::default();
        paint.set_color(Color::from_rgba8(red, 0, blue, 255));
        pixels.fill_rect(Rect::from_xywh(x, 0.0, 8.0, 8.0).unwrap(), &paint, Transform::identity(), None);
    }
    pixels.encode_png().unwrap()
}

const COLOUR: &[u8] = include_bytes!("plans/colour.jpg");
const PROGRESSIVE: &[u8] = include_bytes!("plans/progressive.jpg");
const GREY: &[u8] = include_bytes!("plans/grey.jpg");
const CMYK: &[u8] = include_bytes!("plans/cmyk.jpg");

const PLACE: PlanPlace = PlanPlace { corner: [7.0, -4.0], along: [4.0, 3.0], width: 8.0 };

fn on_plan(bytes: &[u8], place: PlanPlace) -> MotionPicture {
    MotionPicture { site_plan: Some(SitePlan::new(bytes.to_vec(), place).unwrap()), ..crossing() }
}

pub(crate) fn all() -> [Drawing; 4] {
    [crossing().draw(), on_ground().draw(), on_plan(&png(), PLACE).draw(), curves().draw()]
}

/// Its lower edge runs along (0.8, 0.6), and it is half as high as it is wide.
#[test]
fn a_site_plan_lies_where_it_was_put() {
    for (bytes, kind) in [(&png()[..], "png"), (COLOUR, "jpeg")] {
        let svg = on_plan(bytes, PLACE).draw().svg();
        let scale = Scale::of(&svg);
        let matrix = attribute(&svg, "motion-site-plan", "transform").unwrap();
        let numbers = matrix.trim_start_matches("matrix(").trim_end_matches(')').split(' ');
        let numbers: Vec<f64> = numbers.map(|number| number.parse().unwrap()).collect();
        let place = Affine::new(<[f64; 6]>::try_from(numbers).unwrap());
        for (corner, scene) in [
            ((0.0, 1.0), [7.0, -4.0]),
            ((1.0, 1.0), [7.0 + 6.4, -4.0 + 4.8]),
            ((0.0, 0.0), [7.0 - 2.4, -4.0 + 3.2]),
        ] {
            let drawn = place * Point::from(corner);
            assert!(near(drawn, scale.at(scene), 0.1), "{corner:?}: {drawn} {}", scale.at(scene));
        }
        let href = attribute(&svg, "motion-site-plan", "href").unwrap();
        let data = href.strip_prefix(&format!("data:image/{kind};base64,")).unwrap();
        assert_eq!(base64::Engine::decode(&base64::engine::general_purpose::STANDARD, data).unwrap(), bytes);
        // Behind everything but the page.
        assert!(svg.find("<image").unwrap() < svg.find("<text").unwrap());
    }
}

/// Half of it is seen on white: (200 + 255)/2 and (0 + 255)/2.
#[test]
fn a_png_shows_the_site_plan_faded() {
    // A long title makes the page grow upwards.
    for title in ["Motion".to_owned(), "A caption of a court case ".repeat(12)] {
        let images = [&png()[..], COLOUR, PROGRESSIVE];
        for bytes in &images[..if title.len() > 100 { 1 } else { 3 }] {
            let drawing = MotionPicture { title: title.clone(), ..on_plan(bytes, PLACE) }.draw();
            let svg = drawing.svg();
            let top: f64 =
                svg.split("viewBox=\"0 ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
            assert_eq!(top < 0.0, title.len() > 100);
            let scale = Scale::of(&svg);
            let pixels = Pixmap::decode_png(&drawing.png().unwrap()).unwrap();
            // A quarter of its width from its left and its right edge, and a tenth of its height from below.
            for (share, red, blue) in [(0.25, 227, 127), (0.75, 127, 227)] {
                let [x, y] = [8.0 * share, 0.4];
                let at = scale.at([7.0 + 0.8 * x - 0.6 * y, -4.0 + 0.6 * x + 0.8 * y]);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a place on the page"
                )]
                let pixel = pixels.pixel((2.0 * at.x) as u32, (2.0 * (at.y - top)) as u32).unwrap();
                let far = |drawn: u8, expected: i32| (i32::from(drawn) - expected).abs();
                let parts = [(pixel.red(), red), (pixel.green(), 127), (pixel.blue(), blue)];
                assert!(parts.iter().all(|&(drawn, expected)| far(drawn, expected) <= 4), "{pixel:?}");
            }
        }
    }
}

/// A shade of grey on the page, half of which is seen.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place on the page")]
fn grey(pixels: &Pixmap, at: Point) -> u8 {
    pixels.pixel((2.0 * at.x) as u32, (2.0 * at.y) as u32).unwrap().red()
}

#[test]
fn a_large_site_plan_ends_at_the_frame() {
    let mut black = Pixmap::new(8, 8).unwrap();
    black.fill(Color::BLACK);
    let place = PlanPlace { corner: [-60.0, -60.0], along: [1.0, 0.0], width: 120.0 };
    let drawing = on_plan(&black.encode_png().unwrap(), place).draw();
    let svg = drawing.svg();
    let pixels = Pixmap::decode_png(&drawing.png().unwrap()).unwrap();
    let [left, top] = ["x", "y"].map(|name| number(&svg, "motion-frame", name));
    let corner = Point::new(left, top);
    let shades = [(-3.0, 3.0), (3.0, -3.0), (3.0, 3.0)].map(|beside| grey(&pixels, corner + beside));
    assert!(shades[..2] == [255; 2] && shades[2].abs_diff(128) < 2, "{shades:?}");
    assert!(
        svg.contains("clip-path=\"url(#motion-frame-of-plan)\"")
            && svg.contains("<clipPath id=\"motion-frame-of-plan\">")
    );
}

/// Every second pixel is black, as on a chessboard; of 9 pixels 4 or 5 are, and half is seen: 184 to 198.
#[test]
fn a_fine_site_plan_is_not_lost_between_the_pixels() {
    let mut fine = Pixmap::new(2000, 1000).unwrap();
    for (k, pixel) in (0_usize..).zip(fine.data_mut().chunks_exact_mut(4)) {
        let shade = if (k + k / 2000) % 2 == 0 { 0 } else { 255 };
        pixel.copy_from_slice(&[shade, shade, shade, 255]);
    }
    let drawing = on_plan(&fine.encode_png().unwrap(), PlanPlace { along: [1.0, 0.0], ..PLACE }).draw();
    let scale = Scale::of(&drawing.svg());
    let pixels = Pixmap::decode_png(&drawing.png().unwrap()).unwrap();
    for k in 0..40 {
        let shade = grey(&pixels, scale.at([8.0 + 0.03 * f64::from(k), -3.0 + 0.02 * f64::from(k)]));
        assert!((183..=200).contains(&shade), "{shade}");
    }
}

fn has(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

#[test]
fn a_pdf_holds_the_site_plan() {
    for (bytes, space) in [(COLOUR, "/DeviceRGB"), (PROGRESSIVE, "/DeviceRGB"), (GREY, "/DeviceGray")] {
        let pdf = on_plan(bytes, PLACE).draw().pdf().unwrap();
        assert!(has(&pdf, bytes) && has(&pdf, b"/Filter /DCTDecode") && has(&pdf, space.as_bytes()));
    }
    let pdf = on_plan(&png(), PLACE).draw().pdf().unwrap();
    let colours: Vec<u8> =
        (0..128).flat_map(|k| if k % 16 < 8 { [200, 0, 0] } else { [0, 0, 200] }).collect();
    let streams =
        pdf.windows(7).enumerate().filter(|(_, window)| *window == b"stream\n").map(|(at, _)| at + 7);
    let mut inflated = streams.filter_map(|at| {
        let mut decoder =
            miniz_oxide::inflate::stream::InflateState::new_boxed(miniz_oxide::DataFormat::Zlib);
        let mut out = vec![0; colours.len()];
        let flush = miniz_oxide::MZFlush::None;
        let done = miniz_oxide::inflate::stream::inflate(&mut decoder, &pdf[at..], &mut out, flush);
        done.status.is_ok().then_some(out)
    });
    assert!(inflated.any(|stream| stream == colours));
    assert!(has(&pdf, b"/Width 16") && has(&pdf, b"/Height 8") && has(&pdf, b"/ca 0.5"));
    assert!(!has(&crossing().draw().pdf().unwrap(), b"/XObject"));
}

/// The bytes with another number of 16 or 32 bits at a place.
fn patched(bytes: &[u8], at: usize, number: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[at..at + number.len()].copy_from_slice(number);
    bytes
}

#[test]
fn a_site_plan_that_cannot_be_drawn_says_why() {
    let refused = |bytes: Vec<u8>| SitePlan::new(bytes, PLACE).unwrap_err();
    for bytes in [&b""[..], b"GIF89a", b"\x89PNX\r\n\x1a\n", b"BM", b"<svg/>"] {
        assert_eq!(refused(bytes.to_vec()), SitePlanError::NotAPicture, "{bytes:?}");
    }
    let png = png();
    assert_eq!(refused(patched(&png, 16, &[0; 4])), SitePlanError::NoPixels { width: 0, height: 8 });
    // The height of a frame is three bytes after the length of its segment.
    let frame = COLOUR.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap();
    assert_eq!(
        refused(patched(COLOUR, frame + 5, &[0; 2])),
        SitePlanError::NoPixels { width: 16, height: 0 }
    );
    let huge = patched(&png, 16, &[0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff]);
    let most = 50_000_000;
    assert_eq!(refused(huge), SitePlanError::TooLarge { width: 65_535, height: 65_535, most });
    let huge = patched(COLOUR, frame + 5, &[0xff, 0xff, 0xff, 0xff]);
    assert_eq!(refused(huge), SitePlanError::TooLarge { width: 65_535, height: 65_535, most });
    for whole in [&png[..], COLOUR, GREY] {
        for end in [20, whole.len() / 2] {
            let error = refused(whole[..end].to_vec());
            assert!(matches!(error, SitePlanError::Damaged(_)), "{end}: {error:?}");
        }
    }
    assert_eq!(refused(CMYK.to_vec()), SitePlanError::Components(4));
    // A TIFF with one tag, the orientation, in both orders of bytes (TIFF 6.0, section 2).
    for orientation in [1_u8, 6] {
        for is_little in [true, false] {
            let word = |number: u16| if is_little { number.to_le_bytes() } else { number.to_be_bytes() };
            let long = |number: u32| if is_little { number.to_le_bytes() } else { number.to_be_bytes() };
            let order = if is_little { b"II" } else { b"MM" };
            let mut exif = [b"Exif\0\0", &order[..], &word(42), &long(8), &word(1), &word(0x0112)].concat();
            exif.extend([&word(3)[..], &long(1), &word(orientation.into()), &word(0), &long(0)].concat());
            let length = u16::try_from(exif.len() + 2).unwrap().to_be_bytes();
            let turned = [&COLOUR[..2], &[0xff, 0xe1], &length, &exif, &COLOUR[2..]].concat();
            let expected = (orientation == 6).then_some(SitePlanError::Turned(6));
            assert_eq!(SitePlan::new(turned, PLACE).err(), expected);
        }
    }
    let nan = f64::NAN;
    for (place, words) in [
        (PlanPlace { width: 0.0, ..PLACE }, "is 0 m wide"),
        (PlanPlace { width: -8.0, ..PLACE }, "is -8 m wide"),
        (PlanPlace { width: nan, ..PLACE }, "is NaN m wide"),
        (PlanPlace { corner: [nan, 1.0], ..PLACE }, "at (NaN, 1) m"),
        (PlanPlace { along: [0.0, 0.0], ..PLACE }, "along (0, 0)"),
        (PlanPlace { along: [1.0, nan], ..PLACE }, "along (1, NaN)"),
    ] {
        let error = SitePlan::new(png.clone(), place).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// The speeds of the first vehicle fall from 14 m/s to 0 in 2.9 s.
#[test]
fn curves_go_through_their_numbers() {
    let whole = curves();
    Reader::new().readable("curves", &whole.draw().svg());
    let panel = whole.panels[0].clone();
    let svg = CurvesPicture { panels: vec![panel], ..whole.clone() }.draw().svg();
    let [across, upward] = scales(&svg, 0.0, 960.0);
    for (i, speed, time) in [(1, 14.0, 2.9), (2, 12.0, 2.4)] {
        let d = attribute(&svg, &format!("motion-curves-curve-1-{i}"), "d").unwrap();
        let path = BezPath::from_svg(&d).unwrap();
        let ends =
            [path.elements().first(), path.elements().last()].map(|end| end.unwrap().end_point().unwrap());
        for (end, [time, speed]) in ends.into_iter().zip([[0.0, speed * 3.6], [time, 0.0]]) {
            assert!((across.value(end.x) - time).abs() < 2.0 * PIXEL * across.pixel(), "{end}");
            assert!((upward.value(end.y) - speed).abs() < 2.0 * PIXEL * upward.pixel(), "{end}");
        }
    }
    let constant = Curves { curves: [vec![[0.0, 0.0], [1.0, 0.0]], Vec::new()], ..whole.panels[0].clone() };
    let rounding = Curves { curves: [vec![[0.0, 3e-17], [1.0, 0.0]], Vec::new()], ..whole.panels[0].clone() };
    for panels in [vec![constant], vec![rounding], Vec::new()] {
        let svg = CurvesPicture { panels, legend: Vec::new(), ..whole.clone() }.draw().svg();
        Reader::new().readable("no curves", &svg);
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }
    // Rounding below zero does not lower the axis: its zero is the lower end of the chart.
    let falling = |last: f64| {
        let curves = [vec![[0.0, 10.0], [1.0, last]], Vec::new()];
        let panels = vec![Curves { curves, ..whole.panels[0].clone() }];
        CurvesPicture { panels, ..whole.clone() }.draw().svg()
    };
    assert_eq!(falling(-3e-17), falling(0.0));
}

/// A spin of 20.4 m is passed by six bodies, a seventh of the path apart, by the formula of the path.
#[test]
fn outlines_are_equally_far_apart() {
    let straight = SpinOut { bend: 0.0, ..FIRST };
    let svg = picture([Some(straight.vehicle("1", CAR)), None]).draw().svg();
    let (scale, tree) = (Scale::of(&svg), Reader::new().tree(&svg));
    for k in 1..=6 {
        // At the share s of the time, 2s − s² of the path is gone: s = 1 − √(1 − k/7).
        let gone = f64::from(k) / 7.0;
        let MotionPoint { cg, forward, .. } = straight.at(1.0 - (1.0 - gone).sqrt());
        let drawn = area(&tree, &format!("motion-passing-1-{k}"));
        let [x, y] =
            [drawn.left() + drawn.right(), drawn.top() + drawn.bottom()].map(|sum| f64::from(sum) / 2.0);
        // The middle of the body lies 0.15 m behind the CG.
        let middle = scale.at([cg[0] - 0.15 * forward[0], cg[1] - 0.15 * forward[1]]);
        assert!(near(Point::new(x, y), middle, 0.2), "{k}: {x} {y}, not {middle}");
    }
    assert!(!svg.contains("motion-passing-1-7"));
    // 3 m have no room for any, and 6 m for one.
    for (length, count) in [(3.0, 0), (6.0, 1), (9.0, 2)] {
        let short = SpinOut { from: [0.0, 0.0], to: [length, 0.0], turn: 0.0, ..straight };
        let svg = picture([Some(short.vehicle("1", CAR)), None]).draw().svg();
        assert_eq!(svg.matches(" id=\"motion-passing-1-").count(), count, "{length} m");
    }
}

#[test]
fn a_rest_that_was_solved_for_and_skid_marks_are_drawn() {
    let mut vehicle = FIRST.vehicle("1", CAR);
    vehicle.measured_rest = vehicle.rest.take();
    vehicle.skids = vec![[[-13.9, 1.1], [-1.9, 1.1]], [[-13.9, -0.3], [-1.9, -0.3]]];
    let svg = picture([Some(vehicle), None]).draw().svg();
    Reader::new().readable("skid", &svg);
    assert!(svg.contains(">at rest, as measured</text>") && !svg.contains("as computed</text>"));
    assert!(svg.contains(">skid mark before the impact</text>") && !svg.contains(" id=\"motion-rest-1\""));
    let scale = Scale::of(&svg);
    for (k, y) in [(1, 1.1), (2, -0.3)] {
        let of = |name: &str| number(&svg, &format!("motion-skid-1-{k}"), name);
        let ends = [Point::new(of("x1"), of("y1")), Point::new(of("x2"), of("y2"))];
        assert!(near(ends[0], scale.at([-13.9, y]), 0.1) && near(ends[1], scale.at([-1.9, y]), 0.1), "{k}");
    }
}
