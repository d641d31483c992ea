//! Pictures of invented figures: they show the given values, and can be read.

use drawing::{
    Axis, BodyShape, ChancePicture, CrushProfile, CurvePoint, DamagePicture, DamagedVehicle, DensityPicture,
    Drawing, EnergyBar, EnergyPicture, Footprint, FoundAtRest, HistogramPicture, JointPicture, Loss, Marker,
    MomentumPicture, PathTimeCourse, PathTimePicture, RanksPicture, ReconciliationPicture, RestsPicture,
    ScaleUnit, ScatterPanel, ScatterPicture, ScatterPoint, SceneArrow, SceneBody, SceneMotion, ScenePicture,
    SceneVehicle, SightPicture, Symbol, TornadoBar, TornadoPicture, ValueMark,
};

use crate::reader::{Reader, area, attribute, number, scales};

/// (px) two decimals are written.
const PIXEL: f64 = 0.02;

const KM_PER_HOUR: f64 = 1.0 / 3.6;

fn text(words: &str) -> String {
    words.to_owned()
}

fn axis(title: &str, unit: f64) -> Axis {
    Axis { title: text(title), unit }
}

fn histogram(central: f64) -> HistogramPicture {
    let mark = |value: f64, lead: &str| ValueMark { value, lead: text(lead) };
    HistogramPicture {
        title: text("Speed & more, km/h"),
        subtitle: text("Histogram of <200> samples"),
        description: text("The speed is distributed."),
        across: axis("speed, km/h", KM_PER_HOUR),
        decimals: 1,
        upward: text("% of the samples"),
        low: 20.0,
        width: 1.0,
        shares: vec![5.0, 15.0, 45.0, 25.0, 10.0],
        interval: [mark(20.4, "2.5 %:"), mark(24.8, "97.5 %:")],
        central: mark(central, "central:"),
        legend: ["samples", "interval", "central value"].map(text),
    }
}

fn ranks() -> RanksPicture {
    RanksPicture {
        name: "ranks",
        title: text("Where speeds lie"),
        subtitle: text("60 speeds"),
        description: text("4, 9, 20, 27."),
        across: axis("share below, %", 0.01),
        upward: axis("speeds", 1.0),
        counts: vec![4.0, 9.0, 20.0, 27.0],
        expected: 15.0,
        band: [8.3, 21.7],
        legend: ["speeds", "expected", "band"].map(text),
    }
}

pub(crate) fn tornado(longest: f64) -> TornadoPicture {
    let bar = |name: &str, ends: [Option<f64>; 2]| TornadoBar {
        name: text(name),
        ends,
        labels: ends.iter().flatten().map(|end| (*end, format!("{end:.1}"))).collect(),
        remark: ends.contains(&None).then(|| text("no answer at an end")),
    };
    TornadoPicture {
        title: text("Speed, km/h"),
        subtitle: text("Tornado"),
        description: text("Mass does most."),
        central: 80.0,
        central_label: text("central 80.0"),
        longest,
        bars: vec![bar("mass", [Some(76.0), Some(82.0)]), bar("yaw_radius", [None, Some(79.0)])],
        legend: ["low", "high"].map(text),
    }
}

/// Two panels; in the first three points lie on one spot.
fn scatter() -> ScatterPicture {
    let point = |x: f64, y: f64, marker: Marker, is_filled: bool, label: &str| ScatterPoint {
        at: [x, y],
        symbol: Symbol { marker, is_filled },
        label: (!label.is_empty()).then(|| text(label)),
    };
    let crowd = vec![
        point(3.0, 4.0, Marker::Circle, true, "1"),
        point(3.0, 4.0, Marker::Square, false, "2"),
        point(3.0, 4.0, Marker::Diamond, false, "3"),
        point(12.3, 6.2, Marker::Square, true, "12"),
    ];
    let line = (1..=9).map(|k| point(f64::from(k), f64::from(k), Marker::Diamond, false, "")).collect();
    ScatterPicture {
        name: "scatter",
        title: text("One over the other"),
        subtitle: text("Invented"),
        description: text("Most points lie on the line."),
        across: axis("one (km/h)", KM_PER_HOUR),
        upward: axis("other (km/h)", KM_PER_HOUR),
        panels: vec![
            ScatterPanel { title: text("A crowd"), points: crowd },
            ScatterPanel { title: text("A line"), points: line },
        ],
        legend: Marker::ALL
            .map(|marker| (Symbol { marker, is_filled: true }, format!("{marker:?}")))
            .to_vec(),
        equality: text("equal"),
    }
}

const CAR: Footprint = Footprint { length: 4.0, width: 1.7, cg_to_front: 2.0, shape: BodyShape::Car };

/// A car that drives to the right into a wall.
fn scene() -> ScenePicture {
    let arrow = |x: f64, y: f64, label: &str| SceneArrow { vector: [x, y], label: text(label) };
    let car = SceneVehicle {
        name: text("1 · car"),
        legend: Some(text("outline 1")),
        body: SceneBody::Outline { footprint: CAR, crush: None },
        cg: [-2.0, 0.5],
        forward: [1.0, 0.0],
        is_fixed: false,
        motion: Some(SceneMotion {
            before: arrow(10.0, 0.0, "v₁ before: 36 km/h"),
            after: arrow(-1.0, 0.5, "V₁ after: 4 km/h"),
            force_from: arrow(1.0, 0.0, "PDOF₁ 0°"),
        }),
    };
    let wall = SceneVehicle {
        name: text("2 · wall"),
        legend: Some(text("2: fixed object")),
        body: SceneBody::Wall,
        cg: [0.0, 0.0],
        forward: [1.0, 0.0],
        is_fixed: true,
        motion: None,
    };
    ScenePicture {
        title: text("Wall"),
        description: text("A car drives into a wall."),
        caveat: String::new(),
        is_z_down: false,
        is_plain: false,
        vehicles: [car, wall],
        normal: [-1.0, 0.0],
        impulse: Some(arrow(-16_500.0, 750.0, "P 16,517 N·s")),
        length: ScaleUnit { name: text("m"), size: 1.0 },
        speed: ScaleUnit { name: text("km/h"), size: KM_PER_HOUR },
    }
}

fn damage() -> DamagePicture {
    let front = DamagedVehicle {
        footprint: Some(CAR),
        crush: CrushProfile {
            face: vec![[2.0, 0.7], [2.0, 0.0], [2.0, -0.7]],
            crushed: vec![[1.8, 0.7], [1.6, 0.0], [1.9, -0.7]],
            outward: [1.0, 0.0],
        },
        has_stations: true,
        name: text("Vehicle 1"),
        caption: vec![text("Damage: front, 140 cm wide."), text("Crush energy 50,000 J.")],
    };
    let length = ScaleUnit { name: text("m"), size: 1.0 };
    DamagePicture { title: text("Wall"), vehicles: [Some(front), None], length }
}

fn energy() -> EnergyPicture {
    let bar = |name: &str, energy: f64, remark: Option<&str>| EnergyBar {
        name: text(name),
        energy,
        value: format!("{energy:.0} J"),
        remark: remark.map(text),
    };
    EnergyPicture {
        title: text("Wall"),
        caveat: String::new(),
        initial: bar("initial kinetic energy", 80_000.0, None),
        losses: vec![
            (Loss::Vehicle1, bar("crush of vehicle 1", 50_000.0, None)),
            (Loss::Tangential, bar("tangential work", -2_000.0, Some("drives the sliding"))),
        ],
        rest: bar("final motion", 32_000.0, None),
        note: text("Each bar begins where the one above it ends."),
    }
}

/// W = 800 v² and 50,000 J sought: at 7.91 m/s.
fn reconciliation() -> ReconciliationPicture {
    let point = |k: u32| {
        let speed = f64::from(k) * 0.1;
        CurvePoint { speed, work: 800.0 * speed * speed, sought: 50_000.0 }
    };
    let root = (50_000.0_f64 / 800.0).sqrt();
    ReconciliationPicture {
        title: text("Wall"),
        subtitle: text("Reconciliation"),
        caveat: String::new(),
        description: text("The work rises to what is sought."),
        speed: axis("speed (km/h)", KM_PER_HOUR),
        work: axis("W (J)", 1.0),
        curve: (0..=150).map(point).collect(),
        found: [root, 50_000.0],
        found_label: text("28.5 km/h"),
        others: vec![(12.0, text("also 43.2 km/h"))],
        steps: vec![[7.0, 39_200.0], [7.9, 49_928.0]],
        legend: [text("Wₙ: work of the normal impulse"), text("Wₙ sought: 50,000 J")],
    }
}

/// Before the evidence a triangle from 10 to 30 m/s, after it one from 18 to 24 m/s.
fn density() -> DensityPicture {
    let triangle = |low: f64, mode: f64, high: f64| {
        let top = 2.0 / (high - low);
        vec![[low, 0.0], [mode, top], [high, 0.0]]
    };
    let mark = |value: f64, lead: &str| ValueMark { value, lead: text(lead) };
    DensityPicture {
        name: "density",
        title: text("Speed of vehicle 1, km/h"),
        subtitle: text("Invented"),
        description: text("The evidence narrows it."),
        across: axis("speed, km/h", KM_PER_HOUR),
        decimals: 1,
        upward: axis("% per km/h", 0.036),
        before: triangle(10.0, 20.0, 30.0),
        after: triangle(18.0, 20.0, 24.0),
        interval: [mark(18.5, "2.5 %:"), mark(23.2, "97.5 %:")],
        median: mark(20.5, "median:"),
        legend: ["before", "after", "interval", "median"].map(text),
    }
}

/// A cone over (20, 10) m/s, which falls from 1 by 0.2 for each m/s.
fn joint() -> JointPicture {
    let ends = [[14.0, 26.0], [4.0, 16.0]];
    let at = |k: u8, low: f64| low + 12.0 * f64::from(k) / 60.0;
    let height = |x: f64, y: f64| 1.0 - 0.2 * ((x - 20.0) * (x - 20.0) + (y - 10.0) * (y - 10.0)).sqrt();
    let density = (0..=60).map(|j| (0..=60).map(|i| height(at(i, 14.0), at(j, 4.0))).collect()).collect();
    JointPicture {
        name: "joint-speeds",
        title: text("Both speeds"),
        subtitle: text("Invented"),
        description: text("They lie around 72 and 36 km/h."),
        across: axis("Speed of vehicle 1, km/h", KM_PER_HOUR),
        upward: axis("Speed of vehicle 2, km/h", KM_PER_HOUR),
        ends,
        draws: vec![[20.0, 10.0], [21.0, 11.0], [18.0, 13.0]],
        density,
        levels: [0.6, 0.2],
        legend: ["draws", "half", "nearly all"].map(text),
    }
}

/// A car found 20 m ahead and 5 m to the left of the impact, turned to the left, and another that was not
/// found.
fn rests() -> RestsPicture {
    let found = FoundAtRest {
        label: text("1 · car"),
        footprint: Some(CAR),
        position: Some([20.0, 5.0]),
        forward: [0.0, 1.0],
        draws: vec![[19.0, 4.0], [21.0, 6.5], [22.0, 5.0]],
        legend: text("draws of vehicle 1"),
    };
    let other = FoundAtRest {
        label: text("2"),
        footprint: None,
        position: None,
        forward: [1.0, 0.0],
        draws: vec![[5.0, -3.0], [6.0, -2.0]],
        legend: text("draws of vehicle 2"),
    };
    RestsPicture {
        name: "rests",
        title: text("Rest positions"),
        subtitle: text("Invented"),
        description: text("Dots around the car."),
        impact: [0.0, 0.0],
        vehicles: vec![(0, found), (1, other)],
        scale: ScaleUnit { name: text("m"), size: 1.0 },
    }
}

/// Two of one kind, and another.
fn stacked() -> Drawing {
    let drawings = [("one", density().draw()), ("two", density().draw()), ("rests", rests().draw())];
    let drawings = drawings.map(|(place, drawing)| (text(place), drawing));
    Drawing::stacked("stack", text("Three pictures"), &drawings)
}

pub(crate) fn all() -> Vec<Drawing> {
    let others = [
        stacked(),
        scene().draw(),
        damage().draw(),
        energy().draw(),
        reconciliation().draw(),
        histogram(22.5).draw(),
        tornado(4.0).draw(),
        scatter().draw(),
        ranks().draw(),
        density().draw(),
        joint().draw(),
        rests().draw(),
    ];
    others.into_iter().chain(crate::motion::all()).collect()
}

#[test]
fn every_picture_can_be_read_and_has_its_title_and_description() {
    let reader = Reader::new();
    for (drawing, again) in all().iter().zip(all()) {
        let (name, svg) = (drawing.name(), drawing.svg());
        let texts = reader.readable(name, &svg);
        assert!(texts.len() > 5, "{name}");
        assert!(texts.iter().all(|(words, _)| !words.contains('…') || name == "damage"), "{name}");
        for part in ["title", "description"] {
            assert!(svg.contains(&format!(" id=\"{name}-{part}\">")), "{name}: {part}");
        }
        assert_eq!(svg, again.svg(), "{name}");
        // No more than two decimals in coordinates.
        let numbers = svg.split([' ', '"', 'M', 'L', ',']).filter(|word| word.parse::<f64>().is_ok());
        let long =
            numbers.filter(|word| word.split_once('.').is_some_and(|(_, decimals)| decimals.len() > 2));
        let long: Vec<&str> = long.filter(|word| !svg.contains(&format!("data-si=\"{word}\""))).collect();
        assert!(long.is_empty(), "{name}: {long:?}");
    }
}

#[test]
fn what_xml_reserves_is_escaped() {
    let svg = histogram(22.5).draw().svg();
    assert!(
        svg.contains(">Speed &amp; more, km/h</text>") && svg.contains("of &lt;200&gt; samples"),
        "{svg}"
    );
    assert!(!svg.contains("& more") && !svg.contains("<200>"), "{svg}");
}

#[test]
fn a_png_has_twice_the_pixels() {
    let drawing = tornado(4.0).draw();
    let pixels = resvg::tiny_skia::Pixmap::decode_png(&drawing.png().unwrap()).unwrap();
    assert_eq!(pixels.width(), 1920);
    // Not all white: letters and bars.
    assert!(pixels.pixels().iter().filter(|pixel| pixel.red() < 100).count() > 1000);
}

#[test]
fn classes_and_lines_of_a_histogram_stand_at_their_values() {
    let reader = Reader::new();
    // The second one beyond all classes, to the left, and the third to the right.
    for central in [22.5, 14.0, 31.0] {
        let picture = histogram(central);
        let drawing = picture.draw();
        let svg = drawing.svg();
        let tree = reader.tree(&svg);
        let texts = reader.readable("histogram", &svg);
        let [across, upward] = scales(&svg, 0.0, 960.0);
        for (k, &share) in (0_u8..).zip(&picture.shares) {
            let class = area(&tree, &format!("histogram-class-{}", k + 1));
            let low = (20.0 + f64::from(k)) * 3.6;
            for (pixel, value) in [(class.left(), low), (class.right(), low + 3.6)] {
                let drawn = across.value(f64::from(pixel));
                assert!((drawn - value).abs() < 2.0 * PIXEL * across.pixel(), "class {k}: {drawn}, {value}");
            }
            for (pixel, value) in [(class.bottom(), 0.0), (class.top(), share)] {
                let drawn = upward.value(f64::from(pixel));
                assert!((drawn - value).abs() < 2.0 * PIXEL * upward.pixel(), "class {k}: {drawn}, {value}");
            }
        }
        // 20.4 m/s are 73.44 km/h, and so on.
        let label = format!("central: {:.1}", central * 3.6);
        let lines =
            [("low", 20.4, "2.5 %: 73.4"), ("central", central, &label), ("high", 24.8, "97.5 %: 89.3")];
        for (id, value, label) in lines {
            let drawn = across.value(number(&svg, &format!("histogram-{id}"), "x1"));
            assert!((drawn - value * 3.6).abs() < 2.0 * PIXEL * across.pixel(), "{id}: {drawn}, {value} m/s");
            assert!(svg.contains(&format!(">{label}</text>")), "{label}");
            assert!(drawing.description().contains(label), "{label}");
            // No line runs through a label.
            let (_, label) = texts.iter().find(|(words, _)| words == label).unwrap();
            assert!(f64::from(label.bottom()) < number(&svg, "histogram-central", "y2"), "{id}");
        }
        assert!(drawing.description().starts_with("The speed is distributed. "));
        let dashes = |id: &str| attribute(&svg, &format!("histogram-{id}"), "stroke-dasharray");
        assert!(dashes("low").is_some() && dashes("high").is_some() && dashes("central").is_none());
    }
}

#[test]
fn classes_and_levels_of_ranks_stand_at_their_values() {
    let reader = Reader::new();
    let svg = ranks().draw().svg();
    let tree = reader.tree(&svg);
    let [across, upward] = scales(&svg, 0.0, 960.0);
    for (k, count) in (0_u8..).zip([4.0, 9.0, 20.0, 27.0]) {
        let class = area(&tree, &format!("ranks-class-{}", k + 1));
        let left = 25.0 * f64::from(k);
        for (pixel, value) in [(class.left(), left), (class.right(), left + 25.0)] {
            let drawn = across.value(f64::from(pixel));
            assert!((drawn - value).abs() < 2.0 * PIXEL * across.pixel(), "class {k}: {drawn}, {value}");
        }
        for (pixel, value) in [(class.bottom(), 0.0), (class.top(), count)] {
            let drawn = upward.value(f64::from(pixel));
            assert!((drawn - value).abs() < 2.0 * PIXEL * upward.pixel(), "class {k}: {drawn}, {value}");
        }
    }
    for (id, level) in [("low", 8.3), ("expected", 15.0), ("high", 21.7)] {
        let id = format!("ranks-{id}");
        let drawn = upward.value(number(&svg, &id, "y1"));
        assert!((drawn - level).abs() < 2.0 * PIXEL * upward.pixel(), "{id}: {drawn}");
        assert_eq!(attribute(&svg, &id, "stroke-dasharray").is_none(), id == "ranks-expected");
    }
}

#[test]
fn the_curves_of_a_density_reach_from_end_to_end() {
    let reader = Reader::new();
    let drawing = density().draw();
    let svg = drawing.svg();
    let tree = reader.tree(&svg);
    let [across, upward] = scales(&svg, 0.0, 960.0);
    // Greatest values: 2/20 per m/s are 2.78 % per km/h, 2/6 are 9.26.
    for (id, low, high, top) in
        [("before", 10.0, 30.0, 0.1 / 0.036), ("after-area", 18.0, 24.0, 1.0 / (3.0 * 0.036))]
    {
        let shape = area(&tree, &format!("density-{id}"));
        for (pixel, value) in [(shape.left(), low), (shape.right(), high)] {
            let drawn = across.value(f64::from(pixel));
            assert!((drawn - value * 3.6).abs() < 4.0 * PIXEL * across.pixel(), "{id}: {drawn}, {value} m/s");
        }
        for (pixel, value) in [(shape.bottom(), 0.0), (shape.top(), top)] {
            let drawn = upward.value(f64::from(pixel));
            assert!((drawn - value).abs() < 4.0 * PIXEL * upward.pixel(), "{id}: {drawn}, {value}");
        }
    }
    assert!(drawing.description().ends_with("2.5 %: 66.6; median: 73.8; 97.5 %: 83.5."));
    // Unknown values are not mentioned.
    let svg = DensityPicture { before: Vec::new(), ..density() }.draw().svg();
    assert!(!svg.contains("density-before") && !svg.contains(">before</text>"), "{svg}");
}

/// Without depths, a car is drawn undamaged and reaches into the wall, which still contains C, the origin.
#[test]
fn a_wall_contains_the_contact_point_of_a_car_without_depths() {
    let reader = Reader::new();
    let mut picture = scene();
    for ahead in [0.0, 0.4] {
        picture.vehicles[0].cg = [ahead - 2.0, 0.5];
        let svg = picture.draw().svg();
        let tree = reader.tree(&svg);
        let [wall, impact] = ["scene-outline-2", "scene-contact"].map(|id| area(&tree, id));
        let middle = f64::from(impact.top() + impact.bottom()) / 2.0;
        assert!(
            f64::from(wall.top()) < middle && middle < f64::from(wall.bottom()),
            "{ahead}: {wall:?} {impact:?}"
        );
    }
}

/// Every text has a white rim, a text of its own right before it, that screen readers leave out.
#[test]
fn letters_have_a_rim_below_them() {
    let svg = scene().draw().svg();
    let texts: Vec<&str> = svg.lines().filter(|line| line.starts_with("<text ")).collect();
    assert!(texts.len() > 10 && texts.len().is_multiple_of(2), "{}", texts.len());
    for pair in texts.chunks(2) {
        let [rim, letters] = [pair[0], pair[1]].map(|text| text.split_once('>').unwrap());
        assert_eq!(rim.1, letters.1);
        assert!(rim.0.contains("stroke-width=\"3\"") && rim.0.contains("aria-hidden"), "{rim:?}");
        assert!(!letters.0.contains("stroke"), "{letters:?}");
    }
}

/// The cone has a height of 0.6 at 2 m/s from its middle, and of 0.2 at 4 m/s.
#[test]
fn the_regions_of_two_speeds_have_their_borders_where_the_density_is() {
    let reader = Reader::new();
    let svg = joint().draw().svg();
    let tree = reader.tree(&svg);
    let [across, upward] = scales(&svg, 0.0, 700.0);
    for (id, radius) in [("inner", 2.0), ("outer", 4.0)] {
        let border = area(&tree, &format!("joint-speeds-{id}"));
        for (pixel, value) in [(border.left(), 20.0 - radius), (border.right(), 20.0 + radius)] {
            let drawn = across.value(f64::from(pixel));
            assert!((drawn - value * 3.6).abs() < 0.1, "{id}: {drawn}, {value} m/s");
        }
        for (pixel, value) in [(border.bottom(), 10.0 - radius), (border.top(), 10.0 + radius)] {
            let drawn = upward.value(f64::from(pixel));
            assert!((drawn - value * 3.6).abs() < 0.1, "{id}: {drawn}, {value} m/s");
        }
    }
}

/// A car of 4 m by 1.7 m that heads along y with its CG in its middle.
#[test]
fn a_rest_is_drawn_to_scale_where_it_was_found() {
    let reader = Reader::new();
    let svg = rests().draw().svg();
    let tree = reader.tree(&svg);
    let [body, impact] = ["rest-1", "impact"].map(|id| area(&tree, &format!("rests-{id}")));
    let scale = f64::from(body.height()) / 4.0;
    assert!((f64::from(body.width()) / scale - 1.7).abs() < 0.01);
    let middle = |area: &resvg::tiny_skia::Rect| {
        [f64::from(area.left() + area.right()) / 2.0, f64::from(area.top() + area.bottom()) / 2.0]
    };
    let ([x, y], [x0, y0]) = (middle(&body), middle(&impact));
    assert!(((x - x0) / scale - 20.0).abs() < 0.01 && ((y0 - y) / scale - 5.0).abs() < 0.01, "{x} {y}");
}

/// Each shape of each picture is shifted down by the height of the pictures before it, and has a name of its
/// own.
#[test]
fn stacked_pictures_are_those_below_each_other() {
    let reader = Reader::new();
    let stack = stacked().svg();
    let tree = reader.tree(&stack);
    let page = tree.size();
    let ids = |svg: &str| -> Vec<String> {
        svg.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next()).map(str::to_owned).collect()
    };
    let mut names = ids(&stack);
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count, "a name stands twice");
    let mut above = 0.0;
    let mut widest: f32 = 0.0;
    for (place, drawing) in [("one", density().draw()), ("two", density().draw()), ("rests", rests().draw())]
    {
        let own = drawing.svg();
        let own_tree = reader.tree(&own);
        let shapes: Vec<String> = ids(&own)
            .into_iter()
            .filter(|id| own_tree.node_by_id(id).is_some_and(|node| node.abs_bounding_box().width() > 0.0))
            .collect();
        assert!(shapes.len() > 2, "{place}: {shapes:?}");
        for id in shapes {
            let of_own = own_tree.node_by_id(&id).unwrap().abs_bounding_box();
            let id = id.replacen(drawing.name(), &format!("stack-{place}"), 1);
            let here = tree.node_by_id(&id).unwrap_or_else(|| panic!("{id}")).abs_bounding_box();
            assert!((here.left() - of_own.left()).abs() < 0.02, "{id}");
            assert!((here.top() - of_own.top() - above).abs() < 0.02, "{id}");
        }
        above += own_tree.size().height();
        widest = widest.max(own_tree.size().width());
    }
    assert!((page.height() - above).abs() < 0.02 && (page.width() - widest).abs() < 0.02);
    assert!(stacked().description().contains("Dots around the car."));
}

#[test]
fn labels_of_a_histogram_have_no_fewer_decimals_than_its_axis() {
    let picture = HistogramPicture { decimals: 0, width: 0.001, ..histogram(20.002) };
    let mark = |value: f64, lead: &str| ValueMark { value, lead: text(lead) };
    let picture = HistogramPicture { interval: [mark(20.0, "2.5 %:"), mark(20.004, "97.5 %:")], ..picture };
    let svg = picture.draw().svg();
    // From 72.000 to 72.018 km/h, in steps of 0.002 km/h.
    assert!(svg.contains(">72.002</text>") && svg.contains(">2.5 %: 72.000</text>"), "{svg}");
    assert!(svg.contains(">97.5 %: 72.014</text>"), "{svg}");
}

#[test]
fn long_numbers_below_a_chart_are_fewer() {
    let mark = |value: f64, lead: &str| ValueMark { value, lead: text(lead) };
    let picture = HistogramPicture {
        across: axis("energy, J", 1.0),
        low: 123_456_700.0,
        width: 0.02,
        interval: [mark(123_456_700.01, "2.5 %:"), mark(123_456_700.09, "97.5 %:")],
        ..histogram(123_456_700.05)
    };
    let svg = picture.draw().svg();
    Reader::new().readable("histogram", &svg);
    // A hundredth is some 85 px wide, and such a number 103 px: there is one for every two hundredths. That
    // at the right end would leave the page.
    let numbers = |hundredths: u8| svg.contains(&format!(">123,456,700.{hundredths:02}</text>"));
    assert_eq!([0, 1, 2, 4, 5, 6, 8, 10].map(numbers), [true, false, true, true, false, true, true, false]);
}

/// (px) where a bar of the tornado begins and ends.
fn bar(svg: &str, id: &str) -> [f64; 2] {
    let [x, width] = ["x", "width"].map(|name| number(svg, &format!("tornado-{id}"), name));
    [x, x + width]
}

#[test]
fn bars_of_a_tornado_reach_from_the_central_value_to_their_ends() {
    let svg = tornado(4.0).draw().svg();
    let middle = number(&svg, "tornado-central", "x1");
    // 4 km/h are the longest bar.
    let [left, right] = bar(&svg, "low-1");
    let pixel = (right - left) / 4.0;
    assert!((right - middle).abs() < PIXEL && right - left >= 180.0, "{left} {right} {middle}");
    for (id, from, to) in [("high-1", 80.0, 82.0), ("high-2", 79.0, 80.0)] {
        for (drawn, value) in bar(&svg, id).into_iter().zip([from, to]) {
            assert!((drawn - middle - (value - 80.0) * pixel).abs() < 2.0 * PIXEL, "{id}: {drawn}");
        }
    }
    assert!(attribute(&svg, "tornado-low-2", "x").is_none(), "an end without an answer has no bar");
    for words in
        ["mass", "yaw_radius", "76.0", "82.0", "79.0", "no answer at an end", "central 80.0", "low", "high"]
    {
        assert!(svg.contains(&format!(">{words}</text>")), "{words}");
    }
    // Low and high differ in more than their colour.
    let fill = |id: &str| attribute(&svg, &format!("tornado-{id}"), "fill").unwrap();
    assert!(fill("low-1").starts_with("url(#") && fill("high-1").starts_with('#'));
}

#[test]
fn a_tornado_of_which_nothing_is_to_be_seen_has_no_bars() {
    let svg = tornado(0.0).draw().svg();
    assert!(!svg.contains("tornado-low-") && !svg.contains("tornado-high-"), "{svg}");
    assert!(svg.contains(">76.0</text>"), "{svg}");
}

#[test]
fn a_tornado_grows_with_its_names() {
    let reader = Reader::new();
    let mut picture = tornado(4.0);
    picture.bars[0].name = "vehicle1.crush.zones[12].stiffness.coefficient.".repeat(4);
    picture.bars[1].labels = vec![(79.0, "low 1,234,567.89, high 1,234,568.90".repeat(2))];
    let svg = picture.draw().svg();
    reader.readable("tornado", &svg);
    assert!(!svg.contains('…'), "{svg}");
}

#[test]
fn points_of_a_scatter_stand_at_their_values_and_the_line_where_both_are_equal() {
    let reader = Reader::new();
    let picture = scatter();
    let svg = picture.draw().svg();
    let tree = reader.tree(&svg);
    for (panel, (left, right)) in picture.panels.iter().zip([(0.0, 624.0), (624.0, 1248.0)]) {
        let number_of_panel = if left == 0.0 { 1 } else { 2 };
        let [across, upward] = scales(&svg, left, right);
        for (k, point) in panel.points.iter().enumerate() {
            let symbol = area(&tree, &format!("scatter-point-{number_of_panel}-{}", k + 1));
            let [x, y] = [
                across.value(f64::from(symbol.left() + symbol.right()) / 2.0),
                upward.value(f64::from(symbol.top() + symbol.bottom()) / 2.0),
            ];
            let far = (x - 3.6 * point.at[0]).abs().max((y - 3.6 * point.at[1]).abs());
            assert!(far < 2.0 * PIXEL * across.pixel(), "{point:?}: {x} {y}");
        }
        let id = format!("scatter-equality-{number_of_panel}");
        for (x, y) in [("x1", "y1"), ("x2", "y2")] {
            let (x, y) = (across.value(number(&svg, &id, x)), upward.value(number(&svg, &id, y)));
            assert!((x - y).abs() < 2.0 * PIXEL * across.pixel(), "{x} {y}");
        }
        // Beyond the greatest number, which is 12.3 m/s or 44.28 km/h; both panels have the same axes.
        assert!(across.value(number(&svg, &id, "x2")) > 44.28 * 1.04);
    }
    let labels =
        ["1", "2", "3", "12", "A crowd", "A line", "Circle", "Square", "Triangle", "Diamond", "equal"];
    for label in labels {
        assert!(svg.contains(&format!(">{label}</text>")), "{label}");
    }
}

#[test]
fn a_hollow_symbol_hides_nothing() {
    let svg = scatter().draw().svg();
    let fill = |k: u8| attribute(&svg, &format!("scatter-point-1-{k}"), "fill").unwrap();
    assert_eq!([fill(1), fill(2), fill(3)], ["#0072b2", "none", "none"].map(text));
}

#[test]
fn arrows_of_a_scene_point_where_the_vectors_do() {
    let svg = scene().draw().svg();
    let ends = |id: &str| {
        ["data-from", "data-to"].map(|name| {
            let at = attribute(&svg, id, name).unwrap();
            let (x, y) = at.split_once(' ').unwrap();
            [x, y].map(|number| number.parse::<f64>().unwrap())
        })
    };
    let [from, to] = ends("scene-velocity-before-1");
    assert!(to[0] > from[0] + 100.0 && (to[1] - from[1]).abs() < PIXEL);
    // 1 m/s to the left and 0.5 m/s to the left of that, where the page's y runs downwards.
    let [from, to] = ends("scene-velocity-after-1");
    assert!(((to[0] - from[0]) / (to[1] - from[1]) - 2.0).abs() < 0.01, "{from:?} {to:?}");
    // The force comes from ahead: its arrow ends at the CG.
    let [from, to] = ends("scene-pdof-1");
    assert!(from[0] > to[0]);
    // The CG lies 2 m behind C and 0.5 m to its left, by the scale bar.
    let [start, end] = ends("scene-scale");
    let metre = (end[0] - start[0]) / number(&svg, "scene-scale", "data-si");
    let [cg, c] = ["scene-cg-1", "scene-contact"].map(|id| ["cx", "cy"].map(|name| number(&svg, id, name)));
    assert!((c[0] - cg[0] - 2.0 * metre).abs() < 0.1 && (c[1] - cg[1] - 0.5 * metre).abs() < 0.1);
}

#[test]
fn crush_is_as_deep_and_as_wide_as_it_was_given() {
    let reader = Reader::new();
    let svg = damage().draw().svg();
    let crush = area(&reader.tree(&svg), "damage-crush-1");
    let ends = ["data-from", "data-to"].map(|name| attribute(&svg, "damage-scale", name).unwrap());
    let [start, end] = ends.map(|at| at.split_once(' ').unwrap().0.parse::<f64>().unwrap());
    let metre = (end - start) / number(&svg, "damage-scale", "data-si");
    assert!((f64::from(crush.width()) / metre - 1.4).abs() < 1e-3, "{crush:?}");
    assert!((f64::from(crush.height()) / metre - 0.4).abs() < 1e-3, "{crush:?}");
    for station in ["C1", "C2", "C3"] {
        assert!(svg.contains(&format!(">{station}</text>")), "{station}");
    }
    let nothing = DamagePicture { vehicles: [None, None], ..damage() };
    assert!(nothing.draw().svg().contains(">Wall</text>"));
}

#[test]
fn bars_of_the_energy_are_as_long_as_their_energies() {
    let svg = energy().draw().svg();
    let width = |id: &str| number(&svg, &format!("energy-{id}"), "width");
    let per_joule = width("initial") / 80_000.0;
    for (id, joule) in [("crush-1", 50_000.0), ("tangential", 2_000.0), ("final", 32_000.0)] {
        assert!((width(id) - per_joule * joule).abs() < 2.0 * PIXEL, "{id}");
    }
    // Work that gives energy back goes to the right, from where the crush ended.
    let left = |id: &str| number(&svg, &format!("energy-{id}"), "x");
    assert!((left("tangential") - left("crush-1")).abs() < 2.0 * PIXEL);

    // Where it comes first, the bars go beyond the initial energy, and stay left of the values.
    let mut picture = energy();
    picture.losses.reverse();
    let svg = picture.draw().svg();
    let [initial, tangential] = ["initial", "tangential"].map(|id| {
        let [x, width] = ["x", "width"].map(|name| number(&svg, &format!("energy-{id}"), name));
        x + width
    });
    let values = svg.split(">80000 J<").next().unwrap().rsplit(" x=\"").next().unwrap();
    let values: f64 = values.split('"').next().unwrap().parse().unwrap();
    assert!(initial < tangential && tangential < values, "{initial} {tangential} {values}");
}

#[test]
fn the_root_of_a_reconciliation_stands_at_its_speed_and_work() {
    let svg = reconciliation().draw().svg();
    let [across, upward] = scales(&svg, 0.0, 960.0);
    let speed = across.value(number(&svg, "reconciliation-root", "cx"));
    let work = upward.value(number(&svg, "reconciliation-root", "cy"));
    // √(50,000 / 800) = 7.906 m/s
    assert!((speed - 7.906 * 3.6).abs() < 2.0 * PIXEL * across.pixel(), "{speed}");
    assert!((work - 50_000.0).abs() < 2.0 * PIXEL * upward.pixel(), "{work}");
    assert!(svg.contains(">steps of the root-finder (2)</text>") && svg.contains(">also 43.2 km/h</text>"));
}

fn momentum(vectors: [[f64; 2]; 4]) -> MomentumPicture {
    let arrow = |[x, y]: [f64; 2], label: &str| SceneArrow { vector: [x, y], label: text(label) };
    let [a, b, c, d] = vectors;
    let gap = [c[0] + d[0] - a[0] - b[0], c[1] + d[1] - a[1] - b[1]];
    MomentumPicture {
        title: text("Crossing"),
        description: text("Two momenta before and after."),
        caveat: text("Not the answer."),
        is_z_down: false,
        before: [arrow(a, "m₁v₁ 20,000 kg·m/s"), arrow(b, "m₂v₂ 9,000 kg·m/s")],
        after: [arrow(c, "m₁V₁ 12,000 kg·m/s"), arrow(d, "m₂V₂ 14,000 kg·m/s")],
        total: arrow([a[0] + b[0], a[1] + b[1]], "total 22,000 kg·m/s"),
        change: arrow([c[0] - a[0], c[1] - a[1]], "m₁ΔV₁ 8,000 kg·m/s"),
        gap: (gap != [0.0, 0.0]).then(|| arrow(gap, "left over 2,000 kg·m/s")),
        momentum: ScaleUnit { name: text("kg·m/s"), size: 1.0 },
    }
}

/// Sides begin where the one before them ends, in any direction; of vehicles on one line they lie below each
/// other; and a polygon that does not close shows the remainder.
#[test]
fn momenta_stand_tip_to_tail() {
    let reader = Reader::new();
    let ends = |svg: &str, id: &str| {
        ["data-from", "data-to"].map(|name| {
            let at = attribute(svg, &format!("momentum-{id}"), name).unwrap_or_else(|| panic!("no {id}"));
            let (x, y) = at.split_once(' ').unwrap();
            [x.parse::<f64>().unwrap(), y.parse::<f64>().unwrap()]
        })
    };
    let near = |one: [f64; 2], other: [f64; 2]| {
        (one[0] - other[0]).abs() < PIXEL && (one[1] - other[1]).abs() < PIXEL
    };
    for k in 0..24 {
        #[expect(clippy::disallowed_methods, reason = "a test, which compares no bits with another machine")]
        let (s, c) = (f64::from(k) * 15.0).to_radians().sin_cos();
        let turned = |x: f64, y: f64| [c * x - s * y, s * x + c * y];
        for size in [1.0, 1e-3, 1e3] {
            let of = |x: f64, y: f64| turned(x * size, y * size);
            let picture = momentum([of(20e3, 0.0), of(0.0, 9e3), of(12e3, 6e3), of(8e3, 3e3)]);
            let svg = MomentumPicture { gap: None, ..picture }.draw().svg();
            reader.readable("momentum", &svg);
            let [before1, before2, after1, after2, total, change] =
                ["before-1", "before-2", "after-1", "after-2", "total", "change"].map(|id| ends(&svg, id));
            assert!(near(before1[1], before2[0]) && near(after1[1], after2[0]), "{k}");
            assert!(near(before2[1], after2[1]) && near(before2[1], total[1]), "{k}");
            assert!(near(before1[0], after1[0]) && near(before1[0], total[0]), "{k}");
            assert!(near(change[0], before1[1]) && near(change[1], after1[1]), "{k}");
            let scale = ends(&svg, "scale");
            let per = (scale[1][0] - scale[0][0]) / number(&svg, "momentum-scale", "data-si");
            let drawn = [before1[1][0] - before1[0][0], before1[0][1] - before1[1][1]];
            let meant = of(20e3, 0.0).map(|part| part * per);
            assert!(near(drawn, meant) || per * 20e3 * size > 1e3, "{k}: {drawn:?} {meant:?}");
        }
    }
    // Along x: no two sides lie on each other, and the ends at one corner are above each other.
    let line = momentum([[20e3, 0.0], [-5e3, 0.0], [6e3, 0.0], [9e3, 0.0]]);
    let svg = line.draw().svg();
    reader.readable("line", &svg);
    assert!(svg.contains(">Not the answer.</text>"));
    let rows = ["before-1", "before-2", "total", "after-1", "after-2", "change"].map(|id| ends(&svg, id));
    for (k, [from, to]) in rows.iter().enumerate() {
        assert!((from[1] - to[1]).abs() < PIXEL);
        assert!(rows[..k].iter().all(|other| from[1] > other[0][1] + 20.0), "{k}");
    }
    let [before2, total, after2] = [rows[1], rows[2], rows[4]];
    assert!((before2[1][0] - after2[1][0]).abs() < PIXEL && (before2[1][0] - total[1][0]).abs() < PIXEL);
    // A vehicle that stood; and a remainder of 2,000 kg·m/s.
    let open = momentum([[20e3, 0.0], [0.0, 0.0], [12e3, 3e3], [8e3, -1e3]]);
    let svg = open.draw().svg();
    reader.readable("open", &svg);
    assert!(attribute(&svg, "momentum-before-2", "data-to").is_none() && svg.contains(">m₂v₂ 9,000"));
    let [gap, after2, total] = ["gap", "after-2", "total"].map(|id| ends(&svg, id));
    assert!(
        near(gap[1], after2[1]) && near(gap[0], total[1]) && svg.contains(">what is left over after it<")
    );
    // If nothing moves, there is no division by zero.
    let still = momentum([[0.0; 2]; 4]).draw().svg();
    reader.readable("still", &still);
    assert!(!still.contains("NaN") && !still.contains("inf"));
}

fn path_time() -> PathTimePicture {
    // Unbraked at 15 m/s, and from 10 m/s to a stop after 26 m.
    let stops = |time: f64| if time < 3.2 { [time, 10.0 * time - 30.0] } else { [time, -4.0] };
    let course = |legend: &str, pen: usize, points: Vec<[f64; 2]>, brakes: Option<[f64; 2]>| PathTimeCourse {
        legend: text(legend),
        pen,
        points,
        brakes,
    };
    PathTimePicture {
        title: text("A <pedestrian>"),
        subtitle: text("Distance and time"),
        description: text("The vehicle would have stopped."),
        time: axis("time, s", 1.0),
        way: axis("way, m", 1.0),
        until: 4.0,
        reach: [-33.0, 6.0],
        courses: vec![
            course("what happened", 0, vec![[0.0, -30.0], [2.0, 0.0]], None),
            course(
                "at the limit",
                5,
                (0..=8).map(|k| stops(0.5 * f64::from(k))).collect(),
                Some([1.0, -20.0]),
            ),
        ],
        other: Some((vec![[0.0, -3.0], [2.0, 0.0], [3.5, 2.4]], text("pedestrian"))),
        zone: Some(([2.0, 3.5], text("in the zone"))),
        impact: (2.0, text("impact")),
        demand: text("reaction demand"),
        brakes: text("brakes take effect"),
    }
}

/// Lines end where their numbers do, on the scales of the axes, and the zone lies on the place of the impact.
#[test]
fn a_path_time_diagram_is_to_scale() {
    let svg = path_time().draw().svg();
    for id in ["course-1", "course-2", "other", "zone", "place", "impact", "demand", "brakes-2"] {
        assert!(svg.contains(&format!("id=\"path-time-{id}\"")), "{id}");
    }
    assert!(!svg.contains("path-time-brakes-1"));
    let element = |id: &str| {
        let from = svg.find(&format!("id=\"path-time-{id}\"")).unwrap();
        let start = svg[..from].rfind('<').unwrap();
        svg[start..].split('>').next().unwrap().to_owned()
    };
    let value = |id: &str, key: &str| -> f64 {
        element(id).split(&format!(" {key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    // The impact lies half-way along the time, on the line of the place.
    let [left, right] = ["x1", "x2"].map(|key| value("place", key));
    assert!((value("impact", "cx") - (left + right) / 2.0).abs() < PIXEL);
    assert!((value("impact", "cy") - value("place", "y1")).abs() < PIXEL);
    // 30 m of 39 m lie between the demand and the place.
    let [top, bottom] = ["y2", "y1"].map(|key| value("demand-line", key));
    let share = (value("demand", "cy") - value("place", "y1")) / (bottom - top);
    assert!((share - 30.0 / 39.0).abs() < 1e-3, "{share}");
    let [from, wide] = ["x", "width"].map(|key| value("zone", key));
    assert!((wide / (right - left) - 1.5 / 4.0).abs() < 1e-3);
    assert!((from - value("impact", "cx")).abs() < PIXEL);
}

#[test]
fn a_probability_falls_within_its_band() {
    let point = |speed: f64, probability: f64| [speed, probability - 0.1, probability, probability + 0.1];
    let picture = ChancePicture {
        title: text("Pedestrian"),
        subtitle: text("Probability"),
        description: text("It falls."),
        across: axis("speed, km/h", KM_PER_HOUR),
        decimals: 1,
        upward: axis("probability", 1.0),
        points: vec![point(10.0, 0.9), point(15.0, 0.5), point(20.0, 0.1)],
        marks: vec![ValueMark { value: 50.0 * KM_PER_HOUR, lead: text("limit:") }],
        legend: ["probability", "band"].map(text),
    };
    let svg = picture.draw().svg();
    for id in ["chance-curve", "chance-band", "chance-mark-1"] {
        assert!(svg.contains(&format!("id=\"{id}\"")), "{id}");
    }
    assert!(svg.contains("limit: 50.0"), "{svg}");
}

/// A corner of the obstacle, the eye and the point that comes into sight lie on one line, to scale.
#[test]
fn a_line_of_sight_passes_the_corner_of_an_obstacle() {
    let way = |ends: [[f64; 2]; 2]| {
        let places = ends.into_iter().zip(["1.0 s", "0.0 s"]);
        places.map(|(at, time)| (at, text(time))).collect::<Vec<_>>()
    };
    let picture = SightPicture {
        title: text("A <corner>"),
        subtitle: text("What the obstacles hide"),
        description: text("A house."),
        obstacles: vec![(vec![[-6.0, 2.0], [-2.0, 2.0], [-2.0, 6.0], [-6.0, 6.0]], text("house"))],
        ways: [way([[-10.0, 0.0], [0.0, 0.0]]), way([[2.0, 3.0], [2.0, 0.0]])],
        legend: ["eye", "cyclist"].map(text),
        line: Some(([[-10.0, 0.0], [2.0, 3.0]], text("the view becomes free"))),
        scale: ScaleUnit { name: text("ft"), size: 0.3048 },
    };
    let svg = picture.draw().svg();
    for id in ["obstacle-1", "way-1", "way-2", "place-1-1", "place-2-2", "line", "eye", "point", "scale"] {
        assert!(svg.contains(&format!("id=\"sight-{id}\"")), "{id}");
    }
    assert!(!svg.contains("NaN") && svg.contains("house") && svg.contains("&lt;corner&gt;"));
    let value = |id: &str, key: &str| -> f64 {
        let from = svg.find(&format!("id=\"sight-{id}\"")).unwrap();
        let element = svg[from..].split('>').next().unwrap();
        element.split(&format!(" {key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    // By hand: 12 m across and 3 m upward, and 10 m from the eye to the place of the impact.
    let across = value("point", "cx") - value("eye", "cx");
    let upward = value("eye", "cy") - value("point", "cy");
    assert!((upward / across - 0.25).abs() < 1e-3, "{upward} {across}");
    let to_impact = value("place-1-2", "cx") - value("eye", "cx");
    assert!((to_impact / across - 10.0 / 12.0).abs() < 1e-3);
    // The bar is as long as its text says: the metres that it stands for, at the 12 m across.
    let element = svg.split("id=\"sight-scale\"").nth(1).unwrap().split('>').next().unwrap();
    let end = |key: &str| -> f64 {
        let point = element.split(&format!("{key}=\"")).nth(1).unwrap();
        point.split(' ').next().unwrap().parse().unwrap()
    };
    let bar = end("data-to") - end("data-from");
    let feet = svg.split(" ft</text>").next().unwrap().rsplit('>').next().unwrap().parse::<f64>().unwrap();
    assert!((bar / across - feet * 0.3048 / 12.0).abs() < 1e-3, "{bar} {across} {feet}");
}

/// No data, one value for all, and a width beyond the precision of the numbers.
#[test]
fn data_without_a_width_are_drawn() {
    let mark = |value: f64, lead: &str| ValueMark { value, lead: text(lead) };
    let none = |bar: EnergyBar| EnergyBar { energy: 0.0, ..bar };
    let of_one = HistogramPicture { shares: Vec::new(), ..histogram(20.0) };
    let of_one = HistogramPicture { interval: [20.0, 20.0].map(|end| mark(end, "end:")), ..of_one };
    let too_fine = HistogramPicture { low: 1e15, width: 0.01, ..histogram(1e15) };
    let drawings = [
        of_one.draw(),
        HistogramPicture { interval: [1e15, 1e15].map(|end| mark(end, "end:")), ..too_fine }.draw(),
        HistogramPicture { shares: vec![0.0; 5], ..histogram(22.0) }.draw(),
        ReconciliationPicture { curve: Vec::new(), ..reconciliation() }.draw(),
        ReconciliationPicture { curve: reconciliation().curve[..1].to_vec(), ..reconciliation() }.draw(),
        JointPicture { ends: [[14.0, 14.0], [4.0, 4.0]], ..joint() }.draw(),
        EnergyPicture {
            initial: none(energy().initial),
            losses: Vec::new(),
            rest: none(energy().rest),
            ..energy()
        }
        .draw(),
    ];
    for (place, drawing) in drawings.iter().enumerate() {
        let svg = drawing.svg();
        assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{place}: {svg}");
    }
}
