//! The tables of a case file and their keys, as error texts and the JSON Schema describe them.

use std::fmt;

use crate::nearest::join;
use crate::units::read_unit;
use inputs::{
    Axes, Bounds, BrachTangential, Dimension, ENERGY_BASES, EdgeSide, FLEET_STIFFNESS, Fit, LawName,
    MarkedWheel, OBLIQUE_CORRECTIONS, OtherImpact, OtherParty, SIDES, SUBJECTS, SWELLS, SeverityPrior,
    UNDAMAGED, UNKNOWNS, VehicleKind, WheelDrag, words_of,
};

/// The largest number of stations: far more than any scan of a vehicle gives.
pub(crate) const MOST_STATIONS: usize = 10_000;

/// The largest number of zones with separate stiffness: far more than any published structure has.
pub(crate) const MOST_ZONES: usize = 1_000;

/// The wheels of a vehicle: front left, front right, rear left, rear right.
pub(crate) const WHEELS: usize = 4;

/// The largest number of ranges. Each takes as much computing time as the whole case, and represents an error
/// that is independent of all others.
pub(crate) const MOST_RANGES: usize = 500;

/// A key of a case file.
#[derive(Clone, Copy, Debug)]
pub struct KeyInfo {
    /// Its name in its table.
    pub name: &'static str,
    /// The line that sets it, or the header of its table.
    pub example: &'static str,
    /// The form of its value.
    pub form: Form,
    text: &'static str,
}

const fn key(example: &'static str, form: Form, text: &'static str) -> KeyInfo {
    KeyInfo { name: name_in(example), example, form, text }
}

/// The keys of a table. A row has the line that sets a key, the form of its value, and its text; the text of
/// a key that is a table is that of the table. The key of a range has its name, and then the whole range.
macro_rules! keys {
    ($($example:literal $(in $range:literal)?: $form:expr $(, $text:expr)?;)*) => {
        [$(keys!(@key $example $(in $range)?, $form, keys!(@text $($text)?))),*]
    };
    (@key $example:literal, $form:expr, $text:expr) => { key($example, $form, $text) };
    (@key $name:literal in $range:literal, $form:expr, $text:expr) => {
        KeyInfo { name: $name, example: $range, form: $form, text: $text }
    };
    (@text) => { "" };
    (@text $text:expr) => { $text };
}

/// The key that a line sets, or the last one in the header of a table.
const fn name_in(example: &'static str) -> &'static str {
    let (bytes, mut start, mut end) = (example.as_bytes(), 0, 0);
    while !matches!(bytes[end], b' ' | b']') {
        end += 1;
        if matches!(bytes[end - 1], b'[' | b'.') {
            start = end;
        }
    }
    example.split_at(end).0.split_at(start).1
}

impl KeyInfo {
    /// What it means; the first sentence is its title.
    #[must_use]
    pub fn text(&self) -> &'static str {
        match self.form {
            Form::Table(schema) => schema.text,
            _ => self.text,
        }
    }

    /// Whether it is a table with its own header.
    #[must_use]
    pub fn has_header(&self) -> bool {
        self.example.starts_with('[')
    }
}

/// The form of the value of a key of a case file. A number of a key that can be a range may also be a table
/// of [`range_keys`](crate::range_keys).
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A text that is not empty.
    Text,
    /// True or false.
    Flag,
    /// One of these words.
    Words(&'static [&'static str]),
    /// One of these words, or a list of all of them.
    WordOrAll(&'static [&'static str]),
    /// The name of an impact law: one of these words.
    Law(&'static [&'static str]),
    /// A whole number from the first to the second.
    Count(u16, u16),
    /// A list of these keys or, if there are none, of keys that hold numbers.
    Keys(&'static [&'static str]),
    /// A plain number, or a range.
    Number(Bounds),
    /// A list of plain numbers and of ranges.
    Numbers(Bounds),
    /// A number with its unit, or a range.
    Quantity(Dimension, Bounds),
    /// A number with its unit, and never a range.
    Exact(Dimension, Bounds),
    /// A number with its unit, a range, or either with its source.
    Sourced(Dimension, Bounds),
    /// Several numbers with their unit, at least as many as the last field gives.
    Quantities(Dimension, Bounds, usize),
    /// A number with its unit, a range, or a list of tables.
    QuantityOrTables(Dimension, Bounds, &'static Schema),
    /// A plain number, a range or one of these words; or a list of four of these, one for each wheel.
    Wheels(Bounds, &'static [&'static str]),
    /// An angle, or the hour of a clock.
    AngleOrHour,
    /// The table of a vehicle.
    Vehicle,
    /// A table.
    Table(&'static Schema),
    /// A list of tables, of which there are at least so many.
    Tables(&'static Schema, usize),
    /// One of these words, or a table.
    WordsOrTable(&'static [&'static str], &'static Schema),
    /// A plain number, a range, or a table.
    NumberOrTable(Bounds, &'static Schema),
    /// In a range: a value of the key that the range belongs to.
    Value,
    /// In a range of a list: the values.
    Values,
    /// In a range: like the value, but greater than zero: how far a number may be off.
    Deviation,
    /// A percentage.
    Percent(Bounds),
    /// In a range: greater than 0 and less than 1.
    Probability,
}

/// The dimension and the bounds of a quantity.
#[derive(Clone, Copy)]
pub(crate) struct Measure {
    pub(crate) dimension: Dimension,
    pub(crate) bounds: Bounds,
    /// Why it has to be greater than zero, if that needs an explanation.
    pub(crate) why: &'static str,
    /// The example line of its key, if it is of one.
    pub(crate) example: &'static str,
}

impl Measure {
    /// The same measure, but greater than zero, with the reason.
    pub(crate) fn positive(self, why: &'static str) -> Self {
        Self { bounds: Bounds::Positive, why, ..self }
    }
}

impl Form {
    /// The measure of a quantity, or of each of several.
    pub(crate) fn measure(self) -> Option<Measure> {
        let (dimension, bounds) = match self {
            Self::Quantity(dimension, bounds)
            | Self::Exact(dimension, bounds)
            | Self::Sourced(dimension, bounds)
            | Self::Quantities(dimension, bounds, _)
            | Self::QuantityOrTables(dimension, bounds, _) => (dimension, bounds),
            Self::AngleOrHour => (Dimension::Angle, Bounds::None),
            _ => return None,
        };
        Some(Measure { dimension, bounds, why: "", example: "" })
    }

    /// The bounds of its numbers, if it holds any.
    #[must_use]
    pub fn bounds(self) -> Option<Bounds> {
        match self {
            Self::Number(bounds)
            | Self::Numbers(bounds)
            | Self::NumberOrTable(bounds, _)
            | Self::Wheels(bounds, _) => Some(bounds),
            _ => self.measure().map(|measure| measure.bounds),
        }
    }

    /// The dimension of a quantity, or of each of several.
    #[must_use]
    pub fn dimension(self) -> Option<Dimension> {
        self.measure().map(|measure| measure.dimension)
    }

    /// The words that it may have.
    #[must_use]
    pub fn words(self) -> &'static [&'static str] {
        match self {
            Self::Words(words)
            | Self::Law(words)
            | Self::WordOrAll(words)
            | Self::Wheels(_, words)
            | Self::WordsOrTable(words, _) => words,
            _ => &[],
        }
    }

    /// The ranges that may stand in place of its numbers, or of each of them; none if they have to be exact.
    #[must_use]
    pub fn ranges(self) -> &'static [&'static Schema] {
        match self {
            Self::Number(_)
            | Self::Numbers(_)
            | Self::NumberOrTable(..)
            | Self::Quantity(..)
            | Self::QuantityOrTables(..)
            | Self::Wheels(..)
            | Self::AngleOrHour => const { &[&RANGE] },
            Self::Sourced(..) => const { &[&SOURCED_RANGE] },
            Self::Quantities(..) => const { &[&RANGE_OF_LIST, &RANGE] },
            _ => &[],
        }
    }

    /// The table that it may be, or the tables of which it may be a list, ranges apart.
    #[must_use]
    pub fn table(self) -> Option<&'static Schema> {
        match self {
            Self::Vehicle => Some(&VEHICLE),
            Self::Table(schema)
            | Self::Tables(schema, _)
            | Self::QuantityOrTables(_, _, schema)
            | Self::WordsOrTable(_, schema)
            | Self::NumberOrTable(_, schema) => Some(schema),
            _ => None,
        }
    }

    /// The keys of [`Form::table`].
    #[must_use]
    pub fn keys(self) -> &'static [KeyInfo] {
        self.table().map_or(&[], |schema| schema.keys)
    }
}

/// A table of a case file.
pub struct Schema {
    /// The place of its keys in words, for error texts.
    pub(crate) place: &'static str,
    /// What it is; the first sentence is its title.
    pub(crate) text: &'static str,
    /// Its keys.
    pub keys: &'static [KeyInfo],
    pub(crate) rules: &'static [Rule],
}

/// A rule about several keys of a table.
pub(crate) enum Rule {
    /// These keys have to be present.
    Needs(&'static [&'static str]),
    /// If all of these conditions hold, these keys have to be present.
    NeedsIf(&'static [Condition], &'static [&'static str]),
    /// If this condition holds, none of these keys may be present.
    NeverIf(Condition, &'static [&'static str]),
    /// The keys of one of these forms are present: all that it requires, and only those that it allows.
    OneOf(&'static [FormOfTable]),
    /// The keys that each law needs, and no others.
    KeysOfLaw,
    /// At least one key is present.
    NotEmpty,
}

/// A condition of a rule.
#[derive(Clone, Copy)]
pub(crate) enum Condition {
    /// The key is present.
    Has(&'static str),
    /// The key is absent.
    Lacks(&'static str),
    /// The flag is true.
    True(&'static str),
    /// The flag is false or absent.
    NotTrue(&'static str),
}
use Condition::{Has, Lacks, NotTrue, True};

/// The keys of one form of a table.
pub(crate) struct FormOfTable {
    pub(crate) needs: &'static [&'static str],
    pub(crate) may: &'static [&'static str],
}

const fn form(needs: &'static [&'static str], may: &'static [&'static str]) -> FormOfTable {
    FormOfTable { needs, may }
}

/// Both lists of keys, `N` in all.
const fn joined<const N: usize>(first: &[KeyInfo], second: &[KeyInfo]) -> [KeyInfo; N] {
    assert!(first.len() + second.len() == N);
    let mut keys = [first[0]; N];
    let mut i = 0;
    while i < N {
        keys[i] = if i < first.len() { first[i] } else { second[i - first.len()] };
        i += 1;
    }
    keys
}

const fn names_of<const N: usize>(keys: &[KeyInfo; N]) -> [&'static str; N] {
    let mut names = [""; N];
    let mut i = 0;
    while i < N {
        names[i] = keys[i].name;
        i += 1;
    }
    names
}

/// The table of a point.
const fn point(place: &'static str, text: &'static str, keys: &'static [KeyInfo; 2]) -> Schema {
    Schema { place, text, keys, rules: &[Rule::Needs(&["x", "y"])] }
}

/// The coordinates of a point in the scene.
const fn in_scene(form: Form, x: &'static str, y: &'static str) -> [KeyInfo; 2] {
    [
        key(x, form, "Coordinate along the x axis of the scene."),
        key(y, form, "Coordinate along the y axis of the scene."),
    ]
}

/// The coordinates of a point of a vehicle.
const fn from_cg(form: Form, x: &'static str, y: &'static str) -> [KeyInfo; 2] {
    [
        key(x, form, "Distance forward of the CG. Negative behind it."),
        key(
            y,
            form,
            "Distance to the left of the CG, or to the right with `axes = \"z-down\"`. Negative on the other side.",
        ),
    ]
}

const ANY: Bounds = Bounds::None;
const NOT_NEGATIVE: Bounds = Bounds::NotNegative;
const POSITIVE: Bounds = Bounds::Positive;
const FRICTION: Bounds = Bounds::Friction;

const LENGTH: Form = Form::Quantity(Dimension::Length, ANY);
const EXACT_LENGTH: Form = Form::Exact(Dimension::Length, ANY);
const PLACE: [KeyInfo; 2] = in_scene(LENGTH, "x = \"12.4 m\"", "y = \"3.1 m\"");

pub(crate) static TOP: Schema = Schema {
    place: "the lines above the first table",
    text: "The case file. It describes a two-vehicle collision: the vehicles, their damage, the impact, and the speed to find. Every number with a dimension is a text with its unit.",
    keys: &keys! {
        r#"title = "Intersection collision""#: Form::Text,
            "Title of the case. Every report shows it at the top.";
        r#"source = "police report""#: Form::Text,
            "Source of the data. For example a police report, a file number or a paper.";
        "[report]": Form::Table(&REPORT);
        "[scene]": Form::Table(&SCENE);
        "[surface]": Form::Table(&SURFACE);
        "[vehicle1]": Form::Vehicle, "First vehicle.";
        "[vehicle2]": Form::Vehicle, "Second vehicle, or a fixed object.";
        "[impact]": Form::Table(&IMPACT);
        "[reconstruct]": Form::Table(&RECONSTRUCT);
        "[estimate]": Form::Table(&ESTIMATE);
        "[avoid]": Form::Table(&AVOID);
        "[uncertainty]": Form::Table(&UNCERTAINTY);
    },
    rules: &[Rule::NeedsIf(&[Lacks("avoid")], &["vehicle1"])],
};

pub(crate) static REPORT: Schema = Schema {
    place: "[report]",
    text: "The head of the report. Who made it, when, and for which file; no result depends on it.",
    keys: &keys! {
        r#"analyst = "J. Doe, P.E.""#: Form::Text, "Analyst. Who made the reconstruction.";
        r#"date = "22 November 2026""#: Form::Text, "Date of the report.";
        r#"file_number = "2026-0417""#: Form::Text,
            "File number. The number under which you keep the matter.";
        r#"exhibit = "B-3""#: Form::Text, "Exhibit. The number of the report as an exhibit.";
    },
    rules: &[],
};

pub(crate) static SCENE: Schema = Schema {
    place: "[scene]",
    text: "The scene. It says in which axes the file gives angles, lateral coordinates and yaw rates, and where the impact happened.",
    keys: &keys! {
        r#"axes = "z-down""#: Form::Words(&words_of(&Axes::WORDS)),
            r#"Axes of the file. `"z-up"` (the default): y points to the left of x; angles and yaw rates are positive counter-clockwise, seen from above. `"z-down"`, as in SAE J670: y points to the right; clockwise is positive."#;
        r#"contact = { x = "12.4 m", y = "3.1 m" }"#: Form::Table(&SCENE_CONTACT);
        r#"site_plan = { file = "aerial.jpg", corner = { x = "-20 m", y = "-15 m" }, width = "60 m" }"#:
            Form::Table(&SITE_PLAN);
        "locked_together = true": Form::Flag,
            "Vehicles that left the impact as one wreck. It is then enough to give `speed` and `direction` in the table `after` of one of them: the other moved with it. With a `rest`, the program follows that vehicle as if nothing were attached to it, and `deltav estimate` does not use it. Without a yaw rate, the velocity is taken as that of their common CG, and momentum gives their yaw rate.";
    },
    rules: &[],
};

pub(crate) static SITE_PLAN: Schema = Schema {
    place: "site_plan = { … } of [scene]",
    text: "A picture of the scene from above. `deltav draw --what motion` and the report as HTML draw the motion on it. No result depends on it.",
    keys: &keys! {
        r#"file = "aerial.jpg""#: Form::Text,
            r#"Name of the picture, a PNG or a JPEG. It must be in the folder of the case file, or in a folder within that: `"pictures/aerial.jpg"`."#;
        r#"corner = { x = "-20 m", y = "-15 m" }"#: Form::Table(&PLAN_CORNER);
        r#"width = "60 m""#: Form::Exact(Dimension::Length, POSITIVE),
            "How long the lower edge of the picture is in the scene. Its pixels are square, so this is its scale.";
        r#"angle = "15 deg""#: Form::Exact(Dimension::Angle, ANY),
            r#"Angle from the x axis of the scene to the lower edge of the picture, 0 if left out. Seen from above; positive counter-clockwise, or clockwise with `axes = "z-down"`."#;
    },
    rules: &[Rule::Needs(&["file", "corner", "width"])],
};

pub(crate) static PLAN_CORNER: Schema = point(
    "corner = { … } of site_plan",
    "Where the lower left corner of the picture lies. It is exact: no range is possible.",
    &in_scene(EXACT_LENGTH, "x = \"-20 m\"", "y = \"-15 m\""),
);

pub(crate) static SCENE_CONTACT: Schema = point(
    "contact = { … } of [scene]",
    "Place of the impact. The point through which the impulse acted, in the coordinates of the survey. Every place of the file is in the same coordinates, whose axes are those of the headings; any origin will do.",
    &PLACE,
);

pub(crate) static SURFACE: Schema = Schema {
    place: "[surface]",
    text: "The ground between impact and rest. Its friction, its slope, and the parts with a different friction.",
    keys: &keys! {
        "friction = 0.7": Form::Number(FRICTION),
            "Coefficient of friction between tyre and ground. The force that slows a locked wheel, as a share of its load.";
        r#"grade = { slope = 0.03, uphill = "90 deg" }"#: Form::Table(&GRADE);
        r#"zone = [{ name = "grass", friction = 0.4, edge = [{ x = "0 m", y = "6 m" }, { x = "50 m", y = "6 m" }], side = "left" }]"#:
            Form::Tables(&SURFACE_ZONE, 0),
            "Parts of the ground with a friction of their own. Where two overlap, the later one counts.";
    },
    rules: &[Rule::Needs(&["friction"])],
};

pub(crate) static GRADE: Schema = Schema {
    place: "grade = { … } of [surface]",
    text: "Slope of the ground. Without it, the ground is level.",
    keys: &keys! {
        "slope = 0.03": Form::Number(Bounds::Share),
            "Rise per horizontal distance, 0 to 1. A grade of 3 % is 0.03.";
        r#"uphill = "90 deg""#: Form::Quantity(Dimension::Angle, ANY),
            r#"Direction in which the ground rises. The angle from the x axis of the scene, seen from above; positive counter-clockwise, or clockwise with `axes = "z-down"`."#;
    },
    rules: &[Rule::Needs(&["slope", "uphill"])],
};

pub(crate) static SURFACE_ZONE: Schema = Schema {
    place: "[[surface.zone]]",
    text: "A part of the ground, such as a shoulder, a strip of grass or an ice patch. Give the corners of a `polygon`, or an `edge` and the `side` of it on which the zone lies.",
    keys: &keys! {
        r#"name = "grass""#: Form::Text, "Name of the zone. Reports and drawings use it.";
        "friction = 0.4": Form::Number(FRICTION), "Coefficient of friction in the zone.";
        r#"polygon = [{ x = "0 m", y = "6 m" }, { x = "50 m", y = "6 m" }, { x = "50 m", y = "9 m" }]"#:
            Form::Tables(&CORNER, 3),
            "Corners of the zone, three or more, in their order along its outline. The outline must not cross itself.";
        r#"edge = [{ x = "0 m", y = "6 m" }, { x = "50 m", y = "6 m" }]"#: Form::Tables(&CORNER, 2),
            "Two places on a straight edge. The zone is everything on one `side` of it.";
        r#"side = "left""#: Form::Words(&words_of(&EdgeSide::WORDS)),
            "Side of the `edge` on which the zone lies. Left or right, seen from above, for someone who walks from the first place to the second.";
    },
    rules: &[Rule::OneOf(&[
        form(&["friction", "polygon"], &["name"]),
        form(&["friction", "edge", "side"], &["name"]),
    ])],
};

pub(crate) static CORNER: Schema = point(
    "a corner of a zone or obstacle",
    "A place on the edge of a zone or an obstacle. It is exact: no range is possible.",
    &in_scene(EXACT_LENGTH, "x = \"0 m\"", "y = \"6 m\""),
);

pub(crate) static VEHICLE: Schema = Schema {
    place: "[vehicle1] or [vehicle2]",
    text: "A vehicle, or a fixed object with `fixed = true`. Which keys it needs depends on the analysis.",
    keys: &keys! {
        r#"name = "1994 GMC Jimmy""#: Form::Text, "Name of the vehicle. Reports use it.";
        "fixed = true": Form::Flag,
            "Fixed object. Set it to true for a barrier, a wall or a pole, which does not move and has no mass, inertia, speed or crush.";
        r#"kind = "heavy-truck""#: Form::Words(&words_of(&VehicleKind::WORDS)),
            r#"Kind of vehicle. `"car"` (the default): a car, a van or a pickup; `"heavy-truck"`: a lorry, a bus or a tractor with its semitrailer, as one rigid body; `"trailer"`; `"motorcycle"`. It sets which sizes are plausible and how the vehicle is drawn; CRASH3's classes and categories and Burg's formula are for cars only."#;
        r#"mass = "1676 kg""#: Form::Quantity(Dimension::Mass, POSITIVE),
            "Mass at the collision, with load and occupants. Alternatively, give `weight`. Here lb is the pound of mass.";
        r#"weight = "3696 lb""#: Form::Quantity(Dimension::Weight, POSITIVE),
            "Weight at the collision, with load and occupants. Alternatively, give `mass`. Here lb is the pound-force.";
        r#"yaw_inertia = "2437 lb ft s^2""#: Form::Quantity(Dimension::Inertia, POSITIVE),
            "Yaw moment of inertia about the CG. Alternatively, give `yaw_radius`; without either, it is estimated from `class`, or from `wheelbase` and `length`.";
        r#"yaw_radius = "1.40 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Radius of gyration in yaw, k. The inertia is m k².";
        "class = 3": Form::Count(1, 6),
            "CRASH3 size class, 1 to 6. The one with the nearest wheelbase: 1 is 93 in (2.37 m), 2 is 96 in (2.45 m), 3 is 105 in (2.66 m), 4 is 114 in (2.89 m), 5 is 121 in (3.08 m), 6 is 125 in (3.18 m). Its typical values are used for a yaw inertia or an outline that is not given.";
        "model_year = 2014": Form::Count(1950, 2050),
            "Model year. `deltav estimate` corrects an energy by a stiffness `category` by as much as cars of this year differ from those of CRASH3's table; without it, the car is taken for one of the field, of about 2010. Nothing else depends on it.";
        r#"wheelbase = "2.62 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Wheelbase. If no yaw inertia is given, Burg's formula estimates it from the wheelbase and `length`. The motion after the impact needs it, or `class`.";
        r#"track = "1.50 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Distance between the wheels of an axle, for the motion after the impact. Without it, that of `class` is used.";
        r#"cg_to_front_axle = "1.10 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Distance from the CG to the front axle, for the motion after the impact. Without it, the CG lies at the same share of the wheelbase as in the `class`.";
        r#"heading = "180 deg""#: Form::Quantity(Dimension::Angle, ANY),
            r#"Heading at impact. The angle of the vehicle's forward axis from the x axis of the scene, seen from above; positive counter-clockwise, or clockwise with `axes = "z-down"`."#;
        r#"sideslip = "-4.35 deg""#: Form::Quantity(Dimension::Angle, ANY),
            r#"Angle from the heading to the direction in which the CG travels just before impact. Seen from above, positive counter-clockwise, or clockwise with `axes = "z-down"`; 0 (the default) is straight ahead. The speed, given or sought, is then along that direction."#;
        r#"position = { x = "10.8 m", y = "3.9 m" }"#: Form::Table(&POSITION);
        r#"speed = "10 mph""#: Form::Quantity(Dimension::Speed, ANY),
            "Speed just before impact. It is along the heading or, with `sideslip`, along the direction of travel; negative in reverse. Leave it out for the vehicle whose speed is to be found.";
        r#"velocity = { x = "-75 ft/s", y = "0 ft/s" }"#: Form::Table(&VELOCITY);
        r#"yaw_rate = "0 deg/s""#: Form::Quantity(Dimension::YawRate, ANY),
            r#"Yaw rate just before impact. Seen from above, positive counter-clockwise, or clockwise with `axes = "z-down"`; 0 (the default) is no rotation."#;
        r#"contact = { distance = "6.3 ft", angle = "-22.4 deg" }"#: Form::Table(&CONTACT);
        r#"length = "4.32 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Overall length of the body. With `width` and `cg_to_front` it makes up the outline for drawings and checks.";
        r#"width = "1.74 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Overall width of the body. Give it with `length` and `cg_to_front`.";
        r#"cg_to_front = "2.02 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Distance from the CG to the front bumper. Give it with `length` and `width`.";
        r#"diameter = "30 cm""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Diameter of a pole or tree, for drawings. Only for a fixed object, in place of `length`, `width` and `cg_to_front`.";
        r#"deformation_energy = { value = "15 kJ", sd = "5 kJ" }"#:
            Form::Quantity(Dimension::Energy, NOT_NEGATIVE),
            "Energy that deformed the object. Give it if the object bent, cracked or leaned, for example from a test with such an object; it adds to the crush energy of the vehicle. Only for a fixed object at which the vehicle stopped or from which it rebounded. An estimate gives it an error of 20 % and, without a range, another 30 %.";
        "[vehicle1.crush]": Form::WordsOrTable(&[UNDAMAGED], &CRUSH),
            r#"Damage of the vehicle. A table; or `crush = "none"` for a vehicle whose damage took negligible energy, such as a lorry that a car ran into."#;
        "[vehicle1.before]": Form::Table(&BEFORE);
        "[vehicle1.after]": Form::Table(&AFTER);
        "[vehicle1.recorder]": Form::Table(&RECORDER);
        r#"certain_speed = { at_least = "0 km/h", at_most = "60 km/h" }"#: Form::Table(&CERTAIN_SPEED);
    },
    rules: &[
        Rule::NeverIf(True("fixed"), &NEVER_FIXED),
        Rule::NeverIf(NotTrue("fixed"), &["diameter", "deformation_energy"]),
        Rule::NeverIf(Has("diameter"), &["length", "width", "cg_to_front"]),
        Rule::NeverIf(Has("mass"), &["weight"]),
        Rule::NeverIf(Has("yaw_inertia"), &["yaw_radius"]),
        Rule::NeverIf(Has("speed"), &["velocity"]),
        Rule::NeverIf(Has("velocity"), &["sideslip"]),
        Rule::NeedsIf(&[Has("width")], &["length", "cg_to_front"]),
        Rule::NeedsIf(&[Has("cg_to_front")], &["length", "width"]),
        Rule::NeedsIf(&[Has("length"), Lacks("wheelbase")], &["width", "cg_to_front"]),
    ],
};

/// Keys of motion and damage, which a fixed object does not have.
pub(crate) static NEVER_FIXED: [&str; 20] = [
    "kind",
    "mass",
    "weight",
    "yaw_inertia",
    "yaw_radius",
    "class",
    "model_year",
    "wheelbase",
    "track",
    "cg_to_front_axle",
    "sideslip",
    "position",
    "speed",
    "velocity",
    "yaw_rate",
    "crush",
    "before",
    "after",
    "recorder",
    "certain_speed",
];

pub(crate) static POSITION: Schema = point(
    "position = { … } of a vehicle",
    "Place of the CG at the impact, in the coordinates of the survey. The path to rest begins there, and not where `contact` of [scene] and that of the vehicle would place the CG.",
    &PLACE,
);

/// The keys of a record.
const STORED: [KeyInfo; 11] = keys! {
    r#"delta_v_longitudinal = "-24 km/h""#: Form::Exact(Dimension::Speed, ANY),
        "Largest ΔV along the vehicle. Negative where the vehicle was slowed down.";
    r#"delta_v_lateral = "7 km/h""#: Form::Exact(Dimension::Speed, ANY),
        r#"Largest ΔV across the vehicle. Positive to the left, or to the right with `axes = "z-down"`. Together with the part along the vehicle it shows where the force came from."#;
    r#"delta_v_error = "8 %""#: Form::Percent(POSITIVE),
        "Error of the recorded ΔV in per cent. 6 of 10 errors are smaller, and large ones are more frequent than in a normal distribution: it is the scale of Student's t with 3 degrees of freedom. 8 % if left out.";
    r#"direction_error = "6 deg""#: Form::Exact(Dimension::Angle, POSITIVE),
        "Error of the direction of the recorded ΔV, which needs both parts. 6 of 10 errors are smaller: it is the scale of Student's t with 2 degrees of freedom. 5.3° if left out, 8.0° where a side was hit.";
    r#"speed = "55 km/h""#: Form::Exact(Dimension::Speed, POSITIVE),
        r#"Speed just before the impact. For a stationary vehicle, leave it out and write `speed = "0 km/h"` in the table of the vehicle."#;
    r#"speed_error = "4 %""#: Form::Percent(POSITIVE),
        "Error of the recorded speed, as a standard deviation in per cent. If left out, 4 %, or what the table before the impact implies; locked or spinning wheels make it larger.";
    r#"yaw_rate = "90 deg/s""#: Form::Exact(Dimension::YawRate, ANY),
        r#"Yaw rate just after the impact. Positive counter-clockwise, seen from above, or clockwise with `axes = "z-down"`."#;
    r#"yaw_rate_error = "15 deg/s""#: Form::Exact(Dimension::YawRate, POSITIVE),
        "Error of the recorded yaw rate, as a standard deviation. 20 % of it if left out, and at least 10 °/s.";
    r#"pre_crash = { file = "edr.csv" }"#: Form::Table(&PRE_CRASH);
    r#"pulse = { file = "pulse.csv" }"#: Form::Table(&PULSE);
    "incomplete = true": Form::Flag,
        "A record that the recorder did not finish. The recorder's report says so; the ΔV is a lower bound, and an estimate treats it as one. A pulse that ends before the impact does is recognised without this key.";
};

pub(crate) static RECORDER: Schema = Schema {
    place: "[vehicle1.recorder] or [vehicle2.recorder]",
    text: "What the event data recorder of the vehicle stored. `deltav recorder` shows what this gives on its own, `deltav estimate` compares it with the impact, and `deltav avoid` follows it; the other commands warn where it contradicts their answer.",
    keys: &joined::<15>(
        &STORED,
        &keys! {
            r#"records = [{ speed = "55 km/h" }, { since_previous = "0.8 s", speed = "41 km/h" }]"#:
                Form::Tables(&RECORD, 1),
                "Several records. In the order of time, in place of the keys of a single one: `deltav recorder` says which belongs to the impact of this case, by the direction and the size of its ΔV, and `deltav estimate` uses that one.";
            r#"other_impacts = [{ when = "after", pdof = "90 deg", delta_v = "12 km/h" }]"#:
                Form::Tables(&OTHER_IMPACT, 0),
                "Other impacts of this vehicle in the crash. In the order of time. `deltav recorder` then says for each record which impact it may belong to.";
            r#"at = { x = "-0.3 m", y = "0 m" }"#: Form::Table(&RECORDER_AT);
            r#"errors = { slip_low = "3 km/h", friction = "75 %" }"#: Form::Table(&RECORDER_ERRORS);
        },
    ),
    rules: &[
        Rule::NeverIf(Has("records"), &KEYS_OF_RECORD),
        Rule::NeverIf(Has("pre_crash"), &["speed"]),
        Rule::NeverIf(Has("pulse"), &["delta_v_longitudinal", "delta_v_lateral"]),
        Rule::NeedsIf(&[Has("delta_v_lateral")], &["delta_v_longitudinal"]),
        Rule::NeedsIf(&[Has("direction_error")], &["delta_v_lateral"]),
        Rule::NeedsIf(&[Has("yaw_rate_error")], &["yaw_rate"]),
        Rule::NeedsIf(&[Has("speed_error"), Lacks("pre_crash")], &["speed"]),
        Rule::NeedsIf(&[Has("delta_v_error"), Lacks("pulse")], &["delta_v_longitudinal"]),
        Rule::NeedsIf(&[Has("at"), Lacks("pulse"), Lacks("records")], &["delta_v_longitudinal"]),
        Rule::NeedsIf(&INCOMPLETE_ALONE, &["speed"]),
        Rule::NeedsIf(&OTHER_IMPACTS_ALONE, &["speed"]),
    ],
};

static INCOMPLETE_ALONE: [Condition; 7] = of_nothing(True("incomplete"));
static OTHER_IMPACTS_ALONE: [Condition; 7] = of_nothing(Has("other_impacts"));

/// That a recorder has this, and nothing that it stored.
const fn of_nothing(this: Condition) -> [Condition; 7] {
    [
        this,
        Lacks("delta_v_longitudinal"),
        Lacks("speed"),
        Lacks("yaw_rate"),
        Lacks("pre_crash"),
        Lacks("pulse"),
        Lacks("records"),
    ]
}

/// The keys of a single record, which cannot be combined with a list of several.
pub(crate) static KEYS_OF_RECORD: [&str; 11] = names_of(&STORED);

pub(crate) static OTHER_IMPACT: Schema = Schema {
    place: "[[vehicle1.recorder.other_impacts]] or [[vehicle2.recorder.other_impacts]]",
    text: "Another impact of the vehicle in the same crash, to which a record may belong.",
    keys: &keys! {
        r#"when = "after""#: Form::Words(&words_of(&OtherImpact::WHEN)),
            "Whether it was before or after the impact of this case.";
        r#"pdof = "90 deg""#: Form::Exact(Dimension::Angle, ANY),
            "Principal direction of force. The direction from which the force came, clockwise from the heading in any axes.";
        r#"delta_v = "12 km/h""#: Form::Exact(Dimension::Speed, POSITIVE),
            "ΔV of the vehicle. As its damage or the object that it struck shows.";
    },
    rules: &[Rule::OneOf(&[form(&["when", "pdof"], &["delta_v"]), form(&["when", "delta_v"], &["pdof"])])],
};

pub(crate) static RECORD: Schema = Schema {
    place: "[[vehicle1.recorder.records]] or [[vehicle2.recorder.records]]",
    text: "One of several records of a recorder. It has the keys of a single record; `at` and `errors` are those of the recorder.",
    keys: &joined::<12>(
        &keys! {
            r#"since_previous = "0.8 s""#: Form::Exact(Dimension::Time, NOT_NEGATIVE),
                "Time since the previous record. As the recorder stored it, from one trigger to the next.";
        },
        &STORED,
    ),
    rules: &[
        Rule::NotEmpty,
        Rule::NeverIf(Has("pre_crash"), &["speed"]),
        Rule::NeverIf(Has("pulse"), &["delta_v_longitudinal", "delta_v_lateral"]),
        Rule::NeedsIf(&[Has("delta_v_lateral")], &["delta_v_longitudinal"]),
        Rule::NeedsIf(&[Has("direction_error")], &["delta_v_lateral"]),
        Rule::NeedsIf(&[Has("yaw_rate_error")], &["yaw_rate"]),
        Rule::NeedsIf(&[Has("speed_error"), Lacks("pre_crash")], &["speed"]),
        Rule::NeedsIf(&[Has("delta_v_error"), Lacks("pulse")], &["delta_v_longitudinal"]),
    ],
};

/// The texts of keys that a table of a recorder has before the impact and during it.
const RECORDER_FILE: &str = "Name of a file with the table. A CSV or another text; it must be in the folder of the case file, or in a folder within that.";
const RECORDER_ROWS: &str = "Rows of one record. For a long table of NHTSA (EDRPRECRASH, EDRPOSTCRASH), which has a row for each value and may hold several records: columns, each with the value that selects the rows.";
const RECORDER_TEXT: &str = "Table as text, in three double quotes. Copied from a printed report, or the lines of a CSV. Columns are recognised by their headings and units, and `deltav recorder` shows how each was read.";
const RECORDER_TIMES: &str =
    "Times of the samples. All in one text, with their unit at the end; 0 is the impact.";

pub(crate) static PRE_CRASH: Schema = Schema {
    place: "pre_crash = { … } of [vehicle1.recorder] or [vehicle2.recorder]",
    text: "Samples before the impact. Speeds over time and, where the recorder has them, brake, ABS and others. The speed at impact and its error follow from the last of them, in place of `speed`.",
    keys: &keys! {
        r#"text = "Time (s) -0.5 0\nVehicle speed (km/h) 58 47""#: Form::Text, RECORDER_TEXT;
        r#"file = "edr.csv""#: Form::Text, RECORDER_FILE;
        r#"rows = "CASEID 30123, VEHNO 1, EDREVENTNO 2""#: Form::Text, RECORDER_ROWS;
        r#"time = "-1 -0.5 0 s""#: Form::Text, RECORDER_TIMES;
        r#"speed = "60 58 47 km/h""#: Form::Text,
            "Stored speeds. In one text with their unit after them; write `-` for a missing value.";
        r#"brake = "off on on""#: Form::Text, "Service brake. `on` or `off` for each time.";
        r#"abs = "off off on""#: Form::Text, "Antilock brakes. `on` where they were active, for each time.";
        r#"stability = "on on on""#: Form::Text,
            "Stability control. `on` where it was active, for each time.";
        r#"accelerator = "12 0 0 %""#: Form::Text, "Accelerator pedal. For each time.";
        r#"throttle = "12 0 0 %""#: Form::Text, "Engine throttle. For each time.";
        r#"engine_speed = "1900 1700 1500 rpm""#: Form::Text, "Engine speed. For each time.";
        r#"steering = "0 -5 -12.5 deg""#: Form::Text,
            "Angle of the steering wheel. For each time, with the sign that the report has.";
        r#"yaw_rate = "0 -2 -8 deg/s""#: Form::Text,
            "Yaw rate before the impact. For each time, with the sign that the report has.";
    },
    rules: &[Rule::OneOf(&[
        form(&["text"], &["rows"]),
        form(&["file"], &["rows"]),
        form(
            &["time", "speed"],
            &["brake", "abs", "stability", "accelerator", "throttle", "engine_speed", "steering", "yaw_rate"],
        ),
    ])],
};

pub(crate) static PULSE: Schema = Schema {
    place: "pulse = { … } of [vehicle1.recorder] or [vehicle2.recorder]",
    text: "ΔV over time. As the recorder stored it. It gives ΔV, and shows whether the record ends before the impact does, in place of `delta_v_longitudinal` and `delta_v_lateral`.",
    keys: &keys! {
        r#"text = "Time (ms) 0 10 20\nLongitudinal delta-V (km/h) 0 -4 -9""#: Form::Text, RECORDER_TEXT;
        r#"file = "edr.csv""#: Form::Text, RECORDER_FILE;
        r#"rows = "CASEID 30123, VEHNO 1, EDREVENTNO 2""#: Form::Text, RECORDER_ROWS;
        r#"time = "0 10 20 ms""#: Form::Text, RECORDER_TIMES;
        r#"delta_v_longitudinal = "0 -4 -9 km/h""#: Form::Text,
            "ΔV along the vehicle. Until each time, in one text with the unit after the values; negative where the vehicle was slowed down.";
        r#"delta_v_lateral = "0 1 2 km/h""#: Form::Text,
            "ΔV across the vehicle. Until each time; positive to the right, as recorders store it, whatever the axes.";
    },
    rules: &[Rule::OneOf(&[
        form(&["text"], &["rows"]),
        form(&["file"], &["rows"]),
        form(&["time", "delta_v_longitudinal"], &["delta_v_lateral"]),
        form(&["time", "delta_v_lateral"], &[]),
    ])],
};

pub(crate) static RECORDER_AT: Schema = point(
    "at = { … } of [vehicle1.recorder] or [vehicle2.recorder]",
    "Place of the recorder. From the CG: a recorder away from it stores a ΔV to which the rotation of the vehicle adds; with `yaw_rate`, the ΔV of `pulse` is converted to that of the CG. Without it, `deltav estimate` compares that ΔV with the one at this place.",
    &from_cg(EXACT_LENGTH, "x = \"-0.3 m\"", "y = \"0 m\""),
);

pub(crate) static RECORDER_ERRORS: Schema = Schema {
    place: "errors = { … } of [vehicle1.recorder] or [vehicle2.recorder]",
    text: "Errors of the speed at impact. They say how far a stored speed may be from the speed at impact; each has a default, which `deltav recorder` shows with its source.",
    keys: &keys! {
        r#"step = "1 km/h""#: Form::Exact(Dimension::Speed, NOT_NEGATIVE),
            "Step in which speeds are stored. If left out, what they show: a unit of a column of whole numbers (1 mph), 5 or 2 of it if at least 4 or 6 different speeds are multiples, 1 mph where speeds in km/h are whole miles converted (35.4, 33.8), otherwise 1 km/h, as in 49 CFR 563 and UN R160.";
        r#"steady_low = "1.4 %""#: Form::Percent(NOT_NEGATIVE),
            "By how much a stored speed is too low in steady driving. A share of it, 1.4 % if left out, the mean of 18 runs of a 2010 Ford Flex against GPS.";
        r#"steady_sd = "0.43 %""#: Form::Percent(NOT_NEGATIVE),
            "Standard deviation of `steady_low`. 0.43 % if left out, from the same runs.";
        r#"tyre_sd = "0.7 %""#: Form::Percent(NOT_NEGATIVE),
            "Standard deviation due to the tyres. Worn or other tyres change a stored speed by a share of it: 0.7 % if left out.";
        r#"slip_low = "3 km/h""#: Form::Exact(Dimension::Speed, NOT_NEGATIVE),
            "By how much a stored speed is too low in hard braking. The wheels slip: 3 km/h if left out, the mean of the same 18 runs with ABS.";
        r#"slip_sd = "2.1 km/h""#: Form::Exact(Dimension::Speed, NOT_NEGATIVE),
            "Standard deviation of `slip_low`. 2.1 km/h if left out, so that the worst of 18 runs is 6.8 km/h.";
        r#"friction = "75 %""#: Form::Percent(NOT_NEGATIVE),
            "Drag factor of hard braking. Between the last sample and the impact; that of [surface] if left out, or 75 %.";
        r#"coasting = "10 %""#: Form::Percent(NOT_NEGATIVE),
            "Greatest acceleration with the brake off. Either way, in per cent of g: 1 m/s² if left out.";
        r#"brake_comes_on = "25 %""#: Form::Percent(NOT_NEGATIVE),
            "Probability that the brake came on in the gap. If it is off in the last sample, for each half second after that: 25 % if left out.";
        r#"keeps_braking = "65 %""#: Form::Percent(NOT_NEGATIVE),
            "Probability that a driver who braked kept the deceleration. If the brake is on in the last two samples, he keeps what they show, within 0.1 g, up to the impact; otherwise he brakes at anything up to `friction`: 65 % if left out, as in half seconds of 39 crashes.";
        r#"latency = "0.1 s""#: Form::Exact(Dimension::Time, NOT_NEGATIVE),
            "Greatest age of a stored speed. At the time that the report gives for it: 0.1 s if left out.";
        r#"last_is_of_impact = "50 %""#: Form::Percent(NOT_NEGATIVE),
            "Probability that a steep last drop in speed is due to the impact. If the last speed fell by more than g allows, the cause is the impact or slip, and the sample before it counts: 50 % if left out.";
    },
    rules: &[],
};

pub(crate) static CERTAIN_SPEED: Schema = Schema {
    place: "certain_speed = { … } of a vehicle",
    text: "Certain limits of the speed before the impact. `deltav estimate` excludes every other speed.",
    keys: &keys! {
        r#"at_least = "0 km/h""#: Form::Exact(Dimension::Speed, ANY), "The vehicle was not slower.";
        r#"at_most = "60 km/h""#: Form::Exact(Dimension::Speed, ANY), "The vehicle was not faster.";
    },
    rules: &[Rule::OneOf(&[form(&["at_least"], &["at_most"]), form(&["at_most"], &[])])],
};

pub(crate) static ESTIMATE: Schema = Schema {
    place: "[estimate]",
    text: "What `deltav estimate` assumes before it looks at the evidence. Every key has a default that was fitted to real crashes.",
    keys: &keys! {
        r#"prior = "field""#: Form::Words(&words_of(&SeverityPrior::WORDS)),
            r#"How severe the collision may have been. `"field"` (the default): as severe as collisions after which a vehicle was towed; `"serious-injury"`: as those of them in which somebody in either vehicle was seriously hurt (MAIS 3 or more); `"flat"`: every speed is as likely as any other."#;
        r#"delta_v_median = "26 km/h""#: Form::Exact(Dimension::Speed, POSITIVE),
            "Median ΔV before the evidence. Half of such collisions are less severe. It is the median of the geometric mean of both ΔV.";
        r#"crush_error = "40 %""#: Form::Percent(POSITIVE),
            "Error of crush energies. How far that of both vehicles may be from the energy that the impact took, as a standard deviation in per cent. If left out, it depends on how each energy was obtained: a category, the stiffness of the fleet, A and B, a barrier test of the car, an EES.";
        r#"crush_bias = "45 %""#: Form::Percent(POSITIVE),
            r#"Average share of the impact's energy that crush shows. `"100 %"`: crush energies are right on average. If left out, what recorders showed: of energies by a `category`, 43 % between two fronts, 45 % where a side was hit, 87 % where a rear was hit, 51 % where a front met a fixed object, each nearer to 100 % for an older car (`model_year`); of energies by the stiffness of the fleet, 59 %, and 46 % where a front met a fixed object; and 100 % for everything else."#;
        r#"rest_error = "10 %""#: Form::Percent(POSITIVE),
            "Error of a computed rest or point, as a standard deviation. In per cent of its distance from the impact, at the geometric mean of the measured and the computed distance: 10 % if left out. `rest_least_error` is added to it; the range of the rest in the file is added to both in quadrature.";
        r#"rest_least_error = "0.5 m""#: Form::Exact(Dimension::Length, POSITIVE),
            "Error of a computed rest or point that does not grow with the path. 0.5 m if left out.";
        r#"rest_heading_error = "15 deg""#: Form::Exact(Dimension::Angle, POSITIVE),
            "Error of a computed heading at rest, as a standard deviation. A quarter of the turn, but 5° to 15°, if left out.";
        r#"stood = "20 %""#: Form::Percent(NOT_NEGATIVE),
            "Probability, before the evidence, that a vehicle of unknown speed was standing. 20 % if left out; from 0 % to less than 50 %. For a vehicle that certainly moved, give `certain_speed` with `at_least` above 0.";
    },
    rules: &[],
};

pub(crate) static AVOID: Schema = Schema {
    place: "[avoid]",
    text: "Whether the collision was avoidable. `deltav avoid` asks what the driver of one vehicle could have done; no other command uses it. Each number may have a range and a source, which the report shows.",
    keys: &keys! {
        r#"vehicle = "vehicle1""#: Form::Words(&words_of(&SUBJECTS)),
            "Vehicle whose driver is considered. Vehicle 1 if left out.";
        r#"speed = { value = "62 km/h", source = "recorder" }"#: Form::Sourced(Dimension::Speed, POSITIVE),
            "Speed of that vehicle at the reaction demand. Without it, the speed at the impact counts, from the table of the vehicle or from the rest of the case; with skid marks before the impact, the speed before them follows.";
        r#"limit = { value = "50 km/h", source = "built-up area" }"#:
            Form::Sourced(Dimension::Speed, POSITIVE),
            "Speed for which avoidability is examined. The speed limit, or another speed that is of interest.";
        r#"reaction_time = { value = "1.0 s", sd = "0.2 s", source = "Dettinger 2008" }"#:
            Form::Sourced(Dimension::Time, NOT_NEGATIVE),
            "Time from the reaction demand to the first effect of the brakes. None is assumed: `deltav new --template avoid` lists choices with their sources.";
        r#"swell = "0.2 s""#: Form::Sourced(Dimension::Time, NOT_NEGATIVE),
            "Build-up time of the brakes, from their first effect to the full deceleration. 0 if left out, which the report says.";
        r#"swell_form = "linear""#: Form::Words(&words_of(&SWELLS)),
            r#"How the deceleration grows in the swell. `"linear"` (the default); `"half"`: half the full deceleration throughout; `"full speed"`: none, as if the swell were part of the reaction. Conventions differ, and the answer depends on them."#;
        r#"deceleration = { value = "7.5 m/s^2", source = "brake test on site" }"#:
            Form::Sourced(Dimension::Acceleration, POSITIVE),
            "Full deceleration that the driver could have reached. None is assumed.";
        r#"demand = { distance = "30 m" }"#: Form::Table(&AVOID_DEMAND);
        r#"clear = { distance = "2.4 m", speed = "1.4 m/s" }"#: Form::Table(&AVOID_CLEAR);
        r#"other_party = "pedestrian""#: Form::Words(&words_of(&OtherParty::WORDS)),
            "What the other party is. The report and the diagram name it.";
        "unbraked = true": Form::Flag,
            "Known not to have braked before the impact. Otherwise a vehicle whose `speed` is given here is assumed to have reacted and braked as the other keys say, provided that it then still reaches the place of the impact.";
        "[avoid.sight]": Form::Table(&AVOID_SIGHT);
        r#"obstacle = [{ name = "parked van", source = "survey", polygon = [{ x = "-8 m", y = "-1.8 m" }, { x = "-3 m", y = "-1.8 m" }, { x = "-3 m", y = "-3.8 m" }, { x = "-8 m", y = "-3.8 m" }] }]"#:
            Form::Tables(&OBSTACLE, 0),
            "What hides the other party, such as a parked van, a house or a hedge. The report then says from when on the view was free.";
    },
    rules: &[],
};

pub(crate) static AVOID_SIGHT: Schema = Schema {
    place: "[avoid.sight]",
    text: "Where the driver's eye and the first visible part of the other party are at the impact. Both approach it in a straight line or along `path` and `other_path`, the other party at constant speed. Without an `obstacle`, only the plan view uses it.",
    keys: &keys! {
        r#"eye = { x = "-1.9 m", y = "0.4 m" }"#: Form::Table(&SIGHT_PLACE);
        r#"heading = "0 deg""#: Form::Sourced(Dimension::Angle, ANY),
            "Direction in which the vehicle drives. The angle from the x axis of the scene; the `heading` of the vehicle if left out.";
        r#"point = { x = "0 m", y = "0 m" }"#: Form::Table(&SIGHT_PLACE);
        r#"other_heading = "90 deg""#: Form::Sourced(Dimension::Angle, ANY),
            "Direction in which the other party moves. The `heading` of the other vehicle if left out.";
        r#"path = [{ x = "-30 m", y = "-12 m" }, { x = "-12 m", y = "0 m" }]"#: Form::Tables(&CORNER, 0),
            "Points of the path of the driver's eye to the impact, in their order. It is straight between them and to `eye`, and goes on straight before the first. It takes the place of `heading`.";
        r#"other_path = [{ x = "6 m", y = "-8 m" }, { x = "0 m", y = "-4 m" }]"#: Form::Tables(&CORNER, 0),
            "The same for the other party, up to `point`. It takes the place of `other_heading`.";
        r#"other_speed = { low = "1.2 m/s", high = "2.0 m/s" }"#:
            Form::Sourced(Dimension::Speed, NOT_NEGATIVE),
            "How fast the other party moves, at constant speed. That of `other` in `demand`, of `clear` or of the other vehicle if left out; that vehicle then moves as its phases, skid or recorder tell.";
    },
    rules: &[Rule::NeverIf(Has("path"), &["heading"]), Rule::NeverIf(Has("other_path"), &["other_heading"])],
};

pub(crate) static SIGHT_PLACE: Schema = point(
    "eye or point of [avoid.sight]",
    "Place of the driver's eye, or of the first visible part of the other party. At the impact, in the coordinates of the scene. If left out, it is the `position` of the vehicle, or else the `contact` of [scene], or else the origin if neither vehicle has a `position`.",
    &PLACE,
);

pub(crate) static OBSTACLE: Schema = Schema {
    place: "[[avoid.obstacle]]",
    text: "Something that blocks the view. It does not move.",
    keys: &keys! {
        r#"name = "parked van""#: Form::Text, "Name of the obstacle. Reports and drawings use it.";
        r#"source = "survey""#: Form::Text, "Where its corners come from.";
        r#"polygon = [{ x = "-8 m", y = "-1.8 m" }, { x = "-3 m", y = "-1.8 m" }, { x = "-3 m", y = "-3.8 m" }]"#:
            Form::Tables(&CORNER, 3),
            "Corners of the obstacle, three or more, in their order along its outline. The outline must not cross itself.";
    },
    rules: &[Rule::Needs(&["polygon"])],
};

pub(crate) static AVOID_DEMAND: Schema = Schema {
    place: "demand = { … } of [avoid]",
    text: "Reaction demand: where or when the danger could first be recognized. Give `distance`, `time`, `other` or `sight`, and say why in `reason`.",
    keys: &keys! {
        r#"distance = "30 m""#: Form::Sourced(Dimension::Length, POSITIVE),
            "Distance of the vehicle to the place of the impact. Along its path.";
        r#"time = "2.1 s""#: Form::Sourced(Dimension::Time, POSITIVE), "Time before the impact.";
        r#"other = { distance = "4 m", speed = { low = "1.2 m/s", high = "2.0 m/s" } }"#:
            Form::Table(&AVOID_OTHER);
        "sight = true": Form::Flag, "As soon as no `obstacle` hides the other party any more.";
        r#"reason = "the pedestrian steps from behind the parked van""#: Form::Text,
            "Why the danger could be recognized then, and not before.";
    },
    rules: &[
        Rule::OneOf(&[
            form(&["distance"], &["reason"]),
            form(&["time"], &["reason"]),
            form(&["other"], &["reason"]),
            form(&["sight"], &["reason"]),
        ]),
        Rule::NeverIf(NotTrue("sight"), &["sight"]),
    ],
};

pub(crate) static AVOID_OTHER: Schema = Schema {
    place: "other = { … } of demand",
    text: "Path of the other party from the reaction demand to the impact. With `speed` alone, its time is the distance divided by the speed; with `acceleration`, it starts from a stop.",
    keys: &keys! {
        r#"distance = "4 m""#: Form::Sourced(Dimension::Length, POSITIVE),
            "Distance that the other party covered. From where it was recognizable to the place of the impact.";
        r#"speed = { low = "1.2 m/s", high = "2.0 m/s" }"#: Form::Sourced(Dimension::Speed, POSITIVE),
            "How fast it went there. With `acceleration`, the speed that it kept once it had reached it.";
        r#"acceleration = { low = "1.5 m/s^2", high = "2.0 m/s^2" }"#:
            Form::Sourced(Dimension::Acceleration, POSITIVE),
            "How hard it accelerated from a stop.";
    },
    rules: &[Rule::OneOf(&[
        form(&["distance", "speed"], &["acceleration"]),
        form(&["distance", "acceleration"], &["speed"]),
    ])],
};

pub(crate) static AVOID_CLEAR: Schema = Schema {
    place: "clear = { … } of [avoid]",
    text: "Path of the other party out of the danger zone. Give it only if it is certain that the other party moved and would not have stopped: only then does the program examine whether the vehicle would have arrived late enough.",
    keys: &keys! {
        r#"distance = "2.4 m""#: Form::Sourced(Dimension::Length, POSITIVE),
            "Distance that it still had to go at the impact. Until it has left the zone, its own length or body included.";
        "outlines = true": Form::Flag,
            "That distance, by the outlines of both vehicles. Until its outline has left the strip that the other one sweeps, each straight along its heading. It takes the place of `distance`, and needs `length`, `width` and `cg_to_front` or `class` of both, their headings, and their contact points or positions.";
        r#"speed = "1.4 m/s""#: Form::Sourced(Dimension::Speed, POSITIVE),
            "Speed at which it would have gone on. If left out, it goes on as in `other` of `demand`, or else at the speed of its vehicle: that of its table or, where the speed of the vehicle considered is to be found, that by the evidence. A party that stops never clears the zone: leave `clear` out then.";
    },
    rules: &[
        Rule::OneOf(&[form(&["distance"], &["speed"]), form(&["outlines"], &["speed"])]),
        Rule::NeverIf(NotTrue("outlines"), &["outlines"]),
    ],
};

pub(crate) static BEFORE: Schema = Schema {
    place: "[vehicle1.before] or [vehicle2.before]",
    text: "The vehicle before the impact. Its skid marks give the speed at which the driver began to brake; phases say how it moved where there are no marks.",
    keys: &keys! {
        r#"skid = { length = "18 m", friction = 0.7 }"#: Form::Table(&SKID);
        r#"phase = [{ distance = "12 m", acceleration = "-4 m/s^2" }]"#: Form::Tables(&PHASE, 0),
            "How the vehicle moved before the impact, in the order of time. `deltav avoid` follows the phases; the last ends at the impact.";
        r#"speed = "62 km/h""#: Form::Quantity(Dimension::Speed, POSITIVE),
            "Speed where the skid begins, as a recorder, a tachograph or a camera gives it. `deltav estimate` compares it with the impact. Its range is its error, 4 % without one. `deltav avoid`, and `deltav reconstruct` where it weighs all the evidence, use that estimate.";
    },
    rules: &[
        Rule::NeedsIf(&[Lacks("phase")], &["skid"]),
        Rule::NeedsIf(&[Has("speed")], &["skid"]),
        Rule::NeverIf(Has("phase"), &["skid"]),
    ],
};

pub(crate) static PHASE: Schema = Schema {
    place: "[[vehicle1.before.phase]] or [[vehicle2.before.phase]]",
    text: "A stretch of constant acceleration before the impact. Give two of its numbers; the others follow from the speed at its end. If nothing else gives the speed at the impact, the first phase may have `speed` and two of the others.",
    keys: &keys! {
        r#"distance = "12 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Distance along the path of the vehicle.";
        r#"time = "1.2 s""#: Form::Quantity(Dimension::Time, POSITIVE), "How long it lasts.";
        r#"speed = "0 km/h""#: Form::Quantity(Dimension::Speed, NOT_NEGATIVE),
            "Speed where the phase begins; 0 is a stop.";
        r#"acceleration = { low = "1.5 m/s^2", high = "2.0 m/s^2" }"#:
            Form::Quantity(Dimension::Acceleration, ANY),
            "Acceleration along the path. It is negative where the vehicle brakes, and 0 at constant speed.";
        r#"source = "SAE 2010-01-0062""#: Form::Text, "Where its numbers come from.";
    },
    rules: &[Rule::NotEmpty],
};

pub(crate) static SKID: Schema = Schema {
    place: "skid = { … } of [vehicle1.before] or [vehicle2.before]",
    text: "Skid marks of all wheels, up to the impact.",
    keys: &keys! {
        r#"length = "18 m""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Distance that the vehicle skidded, from the beginning of the marks to the impact.";
        r#"from = { x = "18 m", y = "15 m" }"#: Form::Table(&SKID_FROM);
        "friction = 0.7": Form::Number(FRICTION),
            "Coefficient of friction there. Without it, that of [surface] is used.";
    },
    rules: &[Rule::OneOf(&[form(&["length"], &["friction"]), form(&["from"], &["friction"])])],
};

pub(crate) static SKID_FROM: Schema = point(
    "from = { … } of skid",
    "Place of the CG where the wheels began to skid, in the coordinates of the survey. The length of the skid is the distance from there to the CG at the impact.",
    &PLACE,
);

pub(crate) static AFTER: Schema = Schema {
    place: "[vehicle1.after] or [vehicle2.after]",
    text: "The vehicle between impact and rest. Where it came to rest, what slowed its wheels and, where it is known from elsewhere, how it left the impact.",
    keys: &keys! {
        "friction = 0.72": Form::Number(FRICTION),
            "Coefficient of friction between the tyres of this vehicle and the ground. It takes the place of that of [surface] on the path of this vehicle; a zone keeps its own.";
        r#"drag = [0.02, "locked", 0.02, 0.02]"#: Form::Wheels(NOT_NEGATIVE, &words_of(&WheelDrag::WORDS)),
            r#"What resists the rolling of the wheels, as a share of the load on each. One value for all wheels, or a list of four: front left, front right, rear left, rear right. About 0.01 rolls freely; `"locked"` does not turn."#;
        r#"steer = "5 deg""#: Form::QuantityOrTables(Dimension::Angle, Bounds::Acute, &STEER),
            r#"Steer angle of the front wheels. Positive counter-clockwise, or clockwise with `axes = "z-down"`, seen from above; 0 (the default) is straight ahead. One angle, or a list of angles over time."#;
        r#"rest = { x = "31.2 m", y = "9.8 m", heading = "140 deg" }"#: Form::Table(&REST);
        r#"points = [{ x = "18.0 m", y = "5.5 m" }, { x = "25.1 m", y = "8.3 m" }]"#: Form::Tables(&POINT, 0),
            "Places where the CG passed, from impact to rest. They show which of several motions to the same rest took place.";
        r#"speed = "12 m/s""#: Form::Quantity(Dimension::Speed, NOT_NEGATIVE),
            "Speed of the CG just after the impact, if it is known from elsewhere. Give it with `direction`.";
        r#"direction = "35 deg""#: Form::Quantity(Dimension::Angle, ANY),
            r#"Direction in which the CG left the impact. The angle from the x axis of the scene, seen from above; positive counter-clockwise, or clockwise with `axes = "z-down"`."#;
        r#"yaw_rate = "90 deg/s""#: Form::Quantity(Dimension::YawRate, ANY),
            r#"Yaw rate just after the impact, if it is known from elsewhere. Seen from above, positive counter-clockwise, or clockwise with `axes = "z-down"`."#;
    },
    rules: &[Rule::NeedsIf(&[Has("speed")], &["direction"])],
};

pub(crate) static REST: Schema = Schema {
    place: "rest = { … } of [vehicle1.after] or [vehicle2.after]",
    text: "Rest position of the vehicle: the place of its CG, and its heading there. Give `heading`, or `turned` if it is known which way and how far it turned.",
    keys: &joined::<4>(
        &PLACE,
        &keys! {
            r#"heading = "140 deg""#: Form::Quantity(Dimension::Angle, ANY),
                "Heading at rest. The angle of the forward axis from the x axis of the scene, like `heading` of the vehicle; it does not say which way and how far the vehicle turned.";
            r#"turned = "-220 deg""#: Form::Quantity(Dimension::Angle, ANY),
                r#"Angle by which the vehicle turned since the impact, full turns included. Seen from above, positive counter-clockwise, or clockwise with `axes = "z-down"`."#;
        },
    ),
    rules: &[Rule::OneOf(&[form(&["x", "y", "heading"], &[]), form(&["x", "y", "turned"], &[])])],
};

pub(crate) static POINT: Schema = Schema {
    place: "a point of the path",
    text: "A place that the CG passed, or the wheel that is named.",
    keys: &joined::<4>(
        &PLACE,
        &keys! {
            r#"heading = "140 deg""#: Form::Quantity(Dimension::Angle, ANY),
                "Heading there, where marks show it. At the end of rotation, from which the vehicle went on without yaw, it is that of the rest.";
            r#"wheel = "front left""#: Form::Words(&words_of(&MarkedWheel::WORDS)),
                "Wheel that passed there, if the place is on its tyre mark. Without it, the place is one that the CG passed.";
        },
    ),
    rules: &[Rule::Needs(&["x", "y"])],
};

pub(crate) static STEER: Schema = Schema {
    place: "steer = [{ … }] of [vehicle1.after] or [vehicle2.after]",
    text: "Steer angle at one time. Between two times it changes linearly; before the first and after the last it is constant.",
    keys: &keys! {
        r#"time = "0.5 s""#: Form::Quantity(Dimension::Time, NOT_NEGATIVE),
            "Time since the impact. Each is later than the one before.";
        r#"angle = "5 deg""#: Form::Quantity(Dimension::Angle, Bounds::Acute),
            "Steer angle at that time, signed like `steer`.";
    },
    rules: &[Rule::Needs(&["time", "angle"])],
};

/// The keys that an energy equivalent speed replaces.
pub(crate) static NEVER_BESIDE_EES: [&str; 8] =
    ["width", "depths", "spacing", "from_force_balance", "stiffness", "offset", "oblique_angle", "oblique"];

pub(crate) static CRUSH: Schema = Schema {
    place: "[vehicle1.crush] or [vehicle2.crush]",
    text: "Damage to one side of the vehicle. The measured residual crush and the stiffness of the structure, or the energy equivalent speed.",
    keys: &keys! {
        r#"ees = "45 km/h""#: Form::Quantity(Dimension::Speed, NOT_NEGATIVE),
            "Energy equivalent speed. The crush energy is ½ m EES². Give it in place of width, depths and stiffness, for example from a catalogue; it stands for the energy of all plastic deformation, so no correction for an oblique force is applied.";
        r#"side = "front""#: Form::Words(&words_of(&SIDES)),
            "Damaged side. The side of the vehicle whose face was crushed.";
        r#"width = "65 in""#: Form::Quantity(Dimension::Length, POSITIVE),
            "Width of the whole damage along the face. It may be left out if `spacing` is given.";
        r#"depths = "21.3 20.3 13.8 11.3 5.3 4.8 in""#: Form::Quantities(Dimension::Length, NOT_NEGATIVE, 2),
            "Crush depths C1, C2, … at two or more stations. They run from left to right on the front and rear, and from rear to front on the sides.";
        r#"spacing = "13 13 13 13 13 in""#: Form::Quantities(Dimension::Length, POSITIVE, 1),
            "Widths between neighbouring stations, one fewer than there are depths. Without them, the stations are equally spaced over the width.";
        "from_force_balance = true": Form::Flag,
            "Crush inferred from the other vehicle. Set it to true if this vehicle could not be measured: the force on it equals the force on the other one. It then has no depths.";
        r#"stiffness = { d0 = "35 lb^0.5", d1 = "115 lb^0.5/ft" }"#: Form::WordsOrTable(&[FLEET_STIFFNESS], &STIFFNESS),
            r#"Stiffness of the damaged side. A table; or `stiffness = "fleet"` for that of the cars on the road, of model years 1991 to 2018 (docs/calibration.md): front 70.2 √N and 876 √N/m, rear 70.2 and 730, side 50.0 and 983, as `d0` and `d1`. It is meant for the whole width of the damaged end, or on a side for the width of the end that struck it. `deltav estimate` corrects energies from it by what recorders showed; the exact solutions do not."#;
        r#"offset = "12 in""#: Form::Quantity(Dimension::Length, ANY),
            r#"Middle of the damage. On the front and rear, its distance to the left of the vehicle's axis, or to the right with `axes = "z-down"`; on the sides, its distance forward of the CG. It places the damage in drawings, gives a line of action or, with the outline, the contact point if there is none, and shows whether a contact point lies within the damage."#;
        r#"pdof = "2.7 deg""#: Form::AngleOrHour,
            "Principal direction of force. The direction from which the force comes, clockwise from the heading in any axes, or a clock hour. The CRASH3 part of every command uses it instead of the direction of the impulse, and uses its opposite for the other vehicle if that one gives none; the impact itself does not depend on it.";
        r#"oblique_angle = "20 deg""#: Form::Quantity(Dimension::Angle, Bounds::Acute),
            "Angle between the force and the normal of the damaged side. It is less than 90° and replaces the angle derived from the direction of force.";
        r#"moment_arm = "2.1 ft""#: Form::Quantity(Dimension::Length, NOT_NEGATIVE),
            "Distance from the CG to the line of action of the force. It replaces the distance derived from the contact point and the direction of force.";
        r#"oblique = "capped""#: Form::WordsOrTable(&words_of(&OBLIQUE_CORRECTIONS), &OBLIQUE),
            r#"Correction of the crush energy for an oblique force. `"capped"` (the default): 1 + tan²α with α limited to 45°, as in CRASH3; `"uncapped"`: without that limit; `"secant"`: 1/cos α, after Fonda (SAE 1999-01-0106); `"none"`: no correction; `{ friction = 0.5 }`: limited by friction."#;
    },
    rules: &[
        Rule::NeedsIf(&[Lacks("ees")], &["side", "stiffness"]),
        Rule::NeedsIf(&[Lacks("ees"), NotTrue("from_force_balance")], &["depths"]),
        Rule::NeedsIf(&[Lacks("ees"), NotTrue("from_force_balance"), Lacks("spacing")], &["width"]),
        Rule::NeverIf(Has("ees"), &NEVER_BESIDE_EES),
        Rule::NeverIf(True("from_force_balance"), &["depths", "spacing"]),
    ],
};

pub(crate) static IMPACT: Schema = Schema {
    place: "[impact]",
    text: "The impact: the crush plane, and the impact law with its coefficients. A key of another law is an error.",
    keys: &keys! {
        r#"crush_plane = "-23 deg""#: Form::Quantity(Dimension::Angle, ANY),
            r#"Angle Γ of the normal of the crush plane. Measured from the x axis of the scene, seen from above; positive counter-clockwise, or clockwise with `axes = "z-down"`. The plane itself lies along the surface on which the vehicles touched; Γ and Γ + 180° describe the same plane."#;
        r#"law = "brach""#: Form::Law(&words_of(&LawName::WORDS)), r#"Impact law. The default is `"brach"`."#;
        "restitution = 0.3": Form::NumberOrTable(Bounds::BelowOne, &RESTITUTION),
            "Coefficient of restitution e, 0 to 1. The separation speed after the impact divided by the closing speed before it, at the contact point and normal to the crush plane; or a curve over the closing speed.";
        r#"tangential = "critical""#: Form::WordsOrTable(&words_of(&BrachTangential::WORDS), &TANGENTIAL),
            r#"What happens along the crush plane, for Brach's law. `"critical"`: sliding ends at or before separation, as in most collisions that are not sideswipes; or a table with `ratio`, `fraction` or `friction`."#;
        "moment_restitution = -0.5": Form::Number(Bounds::Coefficient),
            "Moment coefficient of restitution e_m, -1 to 1. It sets the moment impulse at the contact point, for Brach's law; -1 (the default) is no moment impulse.";
        r#"tangential_velocity_change = "5 m/s""#: Form::Quantity(Dimension::Speed, ANY),
            r#"Change of the relative velocity along the crush plane. Give it for a sideswipe with Woolley's law; without it, the surfaces stop sliding. The tangential axis is the normal rotated by 90°, counter-clockwise or, with `axes = "z-down"`, clockwise."#;
        "tangential_restitution = -0.2": Form::Number(Bounds::Coefficient),
            "Tangential coefficient of restitution e_t, -1 to 1, for Ishikawa's law. 1 reverses the sliding, 0 ends it, and -1 leaves it unchanged.";
        "friction = 0.5": Form::Number(NOT_NEGATIVE),
            "Friction coefficient μ, for Kudlich and Slibar's law. The surfaces stop sliding, or slide until they separate if stopping would take more friction than this.";
    },
    rules: &[Rule::Needs(&["crush_plane"]), Rule::KeysOfLaw],
};

/// The keys of an impact law in the file.
pub(crate) trait KeysOfLaw: Copy {
    /// The keys of [impact] that the law requires, besides crush_plane.
    fn needed(self) -> &'static [&'static str];

    /// The key that the law accepts but does not require.
    fn optional(self) -> Option<&'static str>;

    fn uses(self, key: &str) -> bool {
        key == "crush_plane"
            || key == "law"
            || self.needed().contains(&key)
            || self.optional().is_some_and(|own| own == key)
    }

    /// Its keys in words.
    fn keys(self) -> String {
        let needed = [&["crush_plane"], self.needed()].concat();
        match self.optional() {
            Some(key) => format!("{} and, optionally, {key}", needed.join(", ")),
            None => join(&needed, "and"),
        }
    }
}

impl KeysOfLaw for LawName {
    fn needed(self) -> &'static [&'static str] {
        match self {
            Self::Brach => &["restitution", "tangential"],
            Self::Woolley => &[],
            Self::Ishikawa => &["restitution", "tangential_restitution"],
            Self::KudlichSlibar => &["restitution", "friction"],
        }
    }

    fn optional(self) -> Option<&'static str> {
        match self {
            Self::Brach => Some("moment_restitution"),
            Self::Woolley => Some("tangential_velocity_change"),
            Self::Ishikawa | Self::KudlichSlibar => None,
        }
    }
}

/// The laws that use a key of [impact].
pub(crate) fn laws_of_key(key: &str) -> Vec<&'static str> {
    LawName::WORDS.into_iter().filter(|(_, law)| law.uses(key)).map(|(name, _)| name).collect()
}

pub(crate) static RECONSTRUCT: Schema = Schema {
    place: "[reconstruct]",
    text: "The reconstruction: which speed to find. It is the speed at which the impact dissipates exactly the crush energy.",
    keys: &keys! {
        r#"find = "vehicle1.speed""#: Form::WordOrAll(&words_of(&UNKNOWNS)),
            "The speed to find. The other vehicle's speed must be known, unless that vehicle is fixed. A list of both speeds finds both, from the motion of both vehicles after the impact.";
        r#"energy_basis = "dissipated""#: Form::WordsOrTable(&words_of(&ENERGY_BASES), &ENERGY_BASIS),
            r#"What the crush energy stands for. `"dissipated"` (the default): the energy that stays in the deformed structure after rebound, as in SAE 980025; `"absorbed"`: the energy taken up at maximum engagement, as given by stiffness that was derived from the impact speeds of barrier tests; `{ tangential_share = … }`: as `"dissipated"`, but the damage also shows a share of the work of the tangential impulse. Without this key, `deltav estimate` takes that share as unknown."#;
    },
    rules: &[Rule::Needs(&["find"])],
};

pub(crate) static ENERGY_BASIS: Schema = Schema {
    place: "energy_basis = { … } of [reconstruct]",
    text: "A share of the work of sliding in the crush energy. The crush energy equals the work of the normal impulse and this share of that of the tangential impulse.",
    keys: &keys! {
        "tangential_share = 0.5": Form::Number(Bounds::Share),
            "Share λ of the work of the tangential impulse that the crush takes, 0 to 1. 0 is the method of SAE 980025.";
    },
    rules: &[Rule::Needs(&["tangential_share"])],
};

/// Values that are estimated from a table or a formula if the file does not give them.
static ESTIMATES: [&str; 6] = [
    "vehicle1.crush.stiffness",
    "vehicle1.yaw_inertia",
    "vehicle1.contact",
    "vehicle2.crush.stiffness",
    "vehicle2.yaw_inertia",
    "vehicle2.contact",
];

pub(crate) static UNCERTAINTY: Schema = Schema {
    place: "[uncertainty]",
    text: "What `deltav uncertainty` cannot see from the ranges. Errors that several numbers share, and estimates that have no spread.",
    keys: &keys! {
        r#"exact = ["vehicle1.crush.stiffness"]"#: Form::Keys(&ESTIMATES),
            "Estimates without a spread. The stiffness of a `category` or of the fleet, the yaw inertia of a `class` or by Burg's formula, and a contact point that the program placed have a spread by default; for those listed here it is switched off.";
        r#"shared = [{ name = "tape", of = ["vehicle1.crush.depths"], sd = "1 cm" }]"#:
            Form::Tables(&SHARED, 0),
            "Errors that several numbers share. Each sample draws such an error once and applies it to all of its numbers.";
    },
    rules: &[],
};

pub(crate) static SHARED: Schema = Schema {
    place: "[[uncertainty.shared]]",
    text: "An error that several numbers share, such as that of one tape, one photograph or one scale. `sd` is added to each number, in one unit for all; `within` multiplies each number.",
    keys: &keys! {
        r#"name = "tape""#: Form::Text, "Name of the error. Reports use it.";
        r#"of = ["vehicle1.crush.depths", "vehicle1.crush.width"]"#: Form::Keys(&[]),
            "The numbers that share the error, by their keys. The key of a list means all of its numbers. A depth that the error would make negative is zero.";
        r#"sd = "1 cm""#: Form::Deviation,
            "Standard deviation of the error. It is added to each of the numbers.";
        r#"within = "5 %""#: Form::Percent(POSITIVE),
            "Greatest error in per cent of each number, with the probability `confidence`. All of the numbers are multiplied by the same factor.";
        "confidence = 0.95": Form::Probability,
            "Probability that the error is no larger. More than 0 and less than 1.";
    },
    rules: &[Rule::OneOf(&[
        form(&["name", "of", "sd"], &[]),
        form(&["name", "of", "within", "confidence"], &[]),
    ])],
};

const OF_CONTACT: [KeyInfo; 2] = from_cg(LENGTH, "x = \"1.78 m\"", "y = \"-0.73 m\"");

pub(crate) static CONTACT: Schema = Schema {
    place: "contact = { … } of a vehicle",
    text: "Contact point, measured from the CG of the vehicle. Give `distance` and `angle`, or `x` and `y`. Where it is left out, an impact takes the centroid of the damage, if `crush` has `width`, `depths` and `offset` and the outline or `class` is given.",
    keys: &joined::<4>(
        &keys! {
            r#"distance = "6.3 ft""#: Form::Quantity(Dimension::Length, NOT_NEGATIVE),
                "Distance from the CG to the contact point.";
            r#"angle = "-22.4 deg""#: Form::Quantity(Dimension::Angle, ANY),
                r#"Angle from the heading to the contact point. Positive to the left, or to the right with `axes = "z-down"`."#;
        },
        &OF_CONTACT,
    ),
    rules: &[Rule::OneOf(&[form(&["distance", "angle"], &[]), form(&["x", "y"], &[])])],
};

pub(crate) static VELOCITY: Schema = Schema {
    place: "velocity = { … } of a vehicle",
    text: "Velocity of the CG just before impact. It is given in the axes of the scene.",
    keys: &keys! {
        r#"x = "-75 ft/s""#: Form::Quantity(Dimension::Speed, ANY),
            "Component along the x axis of the scene.";
        r#"y = "0 ft/s""#: Form::Quantity(Dimension::Speed, ANY), "Component along the y axis of the scene.";
    },
    rules: &[Rule::Needs(&["x", "y"])],
};

// The keys of a straight line of force against crush: of a whole side, or of one zone.
const OF_STIFFNESS_LINE: [KeyInfo; 6] = keys! {
    r#"A = "587 N/cm""#: Form::Quantity(Dimension::StiffnessA, NOT_NEGATIVE),
        "Stiffness A. Force per width at which crush begins.";
    r#"B = "63.3 N/cm^2""#: Form::Quantity(Dimension::StiffnessB, NOT_NEGATIVE),
        "Stiffness B. Force per width and depth; it may be zero only if `G` is given.";
    r#"d0 = "35 lb^0.5""#: Form::Quantity(Dimension::RootForce, NOT_NEGATIVE),
        "Coefficient d0 = A/√B. With E/w the energy per width, √(2 E/w) = d0 + d1 C rises linearly with the crush C.";
    r#"d1 = "115 lb^0.5/ft""#: Form::Quantity(Dimension::RootForcePerLength, POSITIVE),
        "Coefficient d1 = √B. With E/w the energy per width, √(2 E/w) = d0 + d1 C rises linearly with the crush C.";
    r#"G = "612 lb""#: Form::Quantity(Dimension::StiffnessG, NOT_NEGATIVE),
        "Stiffness G. Energy per width that leaves no crush; the default is A²/2B.";
    r#"limit = "250 kN/m""#: Form::Quantity(Dimension::StiffnessA, NOT_NEGATIVE),
        "Force per width at which the force stops rising. Leave it out if it is not known.";
};

pub(crate) static STIFFNESS: Schema = Schema {
    place: "stiffness = { … } of a crush table",
    text: "Stiffness of the damaged side. Give `A` and `B`, or `d0` and `d1`, or a CRASH3 `category`, or a barrier `test`, or `zones`.",
    keys: &joined::<9>(
        &OF_STIFFNESS_LINE,
        &keys! {
            "category = 4": Form::Count(1, 5),
                "Stiffness category of CRASH3's table, 1 to 5. By wheelbase: 1 minicar (93 in), 2 subcompact (96 in), 3 compact (105 in), 4 intermediate (114 in), 5 full-size (121 in and more). The table has values for each side (SAE 870045, Table 1).";
            r#"test = { mass = "1500 kg", speed = "56 km/h", width = "1.6 m", depths = "42 50 54 54 50 42 cm", no_damage_speed = "8 km/h" }"#:
                Form::Table(&TEST);
            r#"zones = [{ A = "587 N/cm", B = "63.3 N/cm^2" }, { A = "400 N/cm", B = "50 N/cm^2" }]"#:
                Form::Tables(&ZONE, 0),
                "Stiffness of each zone between two stations. There is one zone fewer than there are depths.";
        },
    ),
    rules: &[Rule::OneOf(&[
        form(&["A", "B"], &["G", "limit"]),
        form(&["d0", "d1"], &["G", "limit"]),
        form(&["category"], &[]),
        form(&["test"], &[]),
        form(&["zones"], &[]),
    ])],
};

pub(crate) static ZONE: Schema = Schema {
    place: "zones = [{ … }] of a stiffness",
    text: "Stiffness of the zone between two stations. Give `A` and `B`, or `d0` and `d1`.",
    keys: &OF_STIFFNESS_LINE,
    rules: &[Rule::OneOf(&[form(&["A", "B"], &["G", "limit"]), form(&["d0", "d1"], &["G", "limit"])])],
};

pub(crate) static TEST: Schema = Schema {
    place: "test = { … } of a stiffness",
    text: "A full-width test against a rigid barrier, to which the stiffness is fitted. The tested car is of the same or a similar model.",
    keys: &keys! {
        r#"mass = "1500 kg""#: Form::Quantity(Dimension::Mass, POSITIVE),
            "Test mass. Alternatively, give `weight`.";
        r#"weight = "3300 lb""#: Form::Quantity(Dimension::Weight, POSITIVE),
            "Test weight. Alternatively, give `mass`.";
        r#"speed = "56 km/h""#: Form::Quantity(Dimension::Speed, POSITIVE), "Impact speed of the test.";
        r#"width = "1.6 m""#: Form::Quantity(Dimension::Length, POSITIVE), "Width of the damage in the test.";
        r#"depths = "42 50 54 54 50 42 cm""#: Form::Quantities(Dimension::Length, NOT_NEGATIVE, 2),
            "Residual crush after the test, at equally spaced stations.";
        r#"no_damage_speed = "8 km/h""#: Form::Quantity(Dimension::Speed, NOT_NEGATIVE),
            "Highest impact speed that leaves no crush. It is below the speed of the test.";
        r#"fit = "exact""#: Form::Words(&words_of(&Fit::WORDS)),
            r#"How the stiffness is fitted. `"exact"` (the default): the fit reproduces the kinetic energy of the test; `"mean"`: the fit uses the mean crush, which gives an energy a few per cent too high."#;
    },
    rules: &[
        Rule::Needs(&["speed", "width", "depths", "no_damage_speed"]),
        Rule::NeedsIf(&[Lacks("weight")], &["mass"]),
        Rule::NeverIf(Has("mass"), &["weight"]),
    ],
};

pub(crate) static OBLIQUE: Schema = Schema {
    place: "oblique = { … } of a crush table",
    text: "A correction for an oblique force, limited by friction. The factor is 1 + min(|tan α|, μ) |tan α|.",
    keys: &keys! {
        "friction = 0.5": Form::Number(NOT_NEGATIVE), "Friction coefficient μ between the vehicles.";
    },
    rules: &[Rule::Needs(&["friction"])],
};

pub(crate) static TANGENTIAL: Schema = Schema {
    place: "tangential = { … } of [impact]",
    text: "What happens along the crush plane. Give one of `ratio`, `fraction` and `friction`.",
    keys: &keys! {
        "ratio = 0.37": Form::Number(ANY),
            r#"Impulse ratio μ. The tangential impulse divided by the normal impulse, with its sign: the tangential axis is the normal rotated by 90°, counter-clockwise or, with `axes = "z-down"`, clockwise."#;
        "fraction = 0.9": Form::Number(Bounds::Share),
            "Fraction of the critical impulse ratio, 0 to 1. 0 is no friction, and 1 ends the sliding.";
        "friction = 0.5": Form::Number(NOT_NEGATIVE),
            "Friction coefficient μ. The surfaces stop sliding, or slide until they separate if stopping would take more friction than this. Use it for sideswipes and barriers.";
    },
    rules: &[Rule::OneOf(&[form(&["ratio"], &[]), form(&["fraction"], &[]), form(&["friction"], &[])])],
};

pub(crate) static RESTITUTION: Schema = Schema {
    place: "restitution = { … } of [impact]",
    text: "A coefficient of restitution that depends on the closing speed. It has as many values as speeds.",
    keys: &keys! {
        r#"speeds = "2 5 10 20 m/s""#: Form::Quantities(Dimension::Speed, NOT_NEGATIVE, 1),
            "Closing speeds, in ascending order.";
        "values = [0.3, 0.2, 0.12, 0.05]": Form::Numbers(Bounds::BelowOne),
            "Coefficient of restitution at each of these speeds, 0 to 1.";
    },
    rules: &[Rule::Needs(&["speeds", "values"])],
};

/// How far a number may be off, in per cent of it.
const WITHIN: [KeyInfo; 2] = keys! {
    r#"within = "10 %""#: Form::Percent(POSITIVE),
        "Greatest deviation from the value, in per cent of it, with the probability `confidence`. The distribution is normal.";
    "confidence = 0.95": Form::Probability,
        "Probability that the number lies within that deviation. More than 0 and less than 1.";
};

// The example of a key of a range also serves for the amounts of its range.
const RANGE_KEYS: [KeyInfo; 7] = joined(
    &keys! {
        "value" in "{ value = …, sd = … }": Form::Value, "Central value.";
        "sd" in "{ value = …, sd = … }": Form::Deviation,
            "Standard deviation. With `value`, it makes a normal distribution.";
        "low" in "{ low = …, high = … }": Form::Value, "Least value.";
        "mode" in "{ low = …, mode = …, high = … }": Form::Value,
            "Most likely value. With `low` and `high`, it makes a triangular distribution.";
        "high" in "{ low = …, high = … }": Form::Value,
            "Greatest value. With only `low`, every value between the two is equally likely.";
    },
    &WITHIN,
);

/// The range of one quantity.
pub(crate) static RANGE: Schema = Schema {
    place: "a range",
    text: "A number that is not known exactly.",
    keys: &RANGE_KEYS,
    rules: &[Rule::OneOf(&[
        form(&["value", "sd"], &[]),
        form(&["value", "within", "confidence"], &[]),
        form(&["low", "high"], &["mode"]),
    ])],
};

/// The same with its source, or a number with its source.
pub(crate) static SOURCED_RANGE: Schema = Schema {
    place: "a range with its source",
    text: "A number, or one that is not known exactly, with its source.",
    keys: &joined::<8>(
        &RANGE_KEYS,
        &keys! {
            r#"source = "Dettinger 2008""#: Form::Text, "Where the number comes from. The report shows it.";
        },
    ),
    rules: &[Rule::OneOf(&[
        form(&["value", "source"], &[]),
        form(&["value", "sd"], &["source"]),
        form(&["value", "within", "confidence"], &["source"]),
        form(&["low", "high"], &["mode", "source"]),
    ])],
};

/// The range of several quantities.
pub(crate) static RANGE_OF_LIST: Schema = Schema {
    place: "a range of several values",
    text: "Several numbers that are not known exactly. All have the same spread, and each varies independently of the others.",
    keys: &joined::<4>(
        &keys! {
            r#"values = "21.3 20.3 13.8 in""#: Form::Values, "The central values.";
            "sd" in "{ values = …, sd = … }": Form::Deviation,
                "Standard deviation. With `values`, it makes normal distributions.";
        },
        &WITHIN,
    ),
    rules: &[Rule::OneOf(&[form(&["values", "sd"], &[]), form(&["values", "within", "confidence"], &[])])],
};

static ALL: [&Schema; 36] = [
    &TOP,
    &REPORT,
    &SCENE,
    &VEHICLE,
    &CRUSH,
    &IMPACT,
    &RECONSTRUCT,
    &ENERGY_BASIS,
    &UNCERTAINTY,
    &CONTACT,
    &VELOCITY,
    &STIFFNESS,
    &TANGENTIAL,
    &RESTITUTION,
    &SURFACE,
    &BEFORE,
    &AFTER,
    &RECORDER,
    &RECORD,
    &OTHER_IMPACT,
    &PRE_CRASH,
    &PULSE,
    &RECORDER_AT,
    &RECORDER_ERRORS,
    &CERTAIN_SPEED,
    &ESTIMATE,
    &AVOID,
    &AVOID_DEMAND,
    &AVOID_OTHER,
    &AVOID_SIGHT,
    &AVOID_CLEAR,
    &GRADE,
    &SKID,
    &PHASE,
    &REST,
    &STEER,
];

/// The path of every key of a case file, tables included: `scene`, `scene.axes`, `vehicle1`, …,
/// `vehicle1.crush.stiffness.d0`, …
///
/// The keys of a range, which can replace any number, are not listed.
///
/// ```
/// let keys = case::keys();
/// assert!(keys.contains(&"impact.tangential.friction".to_owned()));
/// ```
#[must_use]
pub fn keys() -> Vec<String> {
    walked(|_| true)
}

/// The path of every key of a case file that holds one or more numbers, each of which can be a range:
/// `vehicle1.mass`, …, `impact.restitution`, `impact.restitution.speeds`, … All are among [`keys`], without
/// indices of elements.
///
/// ```
/// let keys = case::number_keys();
/// assert!(keys.contains(&"vehicle1.crush.depths".to_owned()));
/// assert!(!keys.contains(&"vehicle1.crush.side".to_owned()));
/// ```
#[must_use]
pub fn number_keys() -> Vec<String> {
    walked(|form| !form.ranges().is_empty())
}

/// The paths of the keys whose form is wanted.
fn walked(is_wanted: fn(&Form) -> bool) -> Vec<String> {
    fn walk(schema: &Schema, within: &str, is_wanted: fn(&Form) -> bool, paths: &mut Vec<String>) {
        for key in schema.keys {
            let path = format!("{within}{}", key.name);
            let inner = format!("{path}.");
            if is_wanted(&key.form) {
                paths.push(path);
            }
            if let Some(schema) = key.form.table() {
                walk(schema, &inner, is_wanted, paths);
            }
        }
    }
    let mut paths = Vec::new();
    walk(&TOP, "", is_wanted, &mut paths);
    paths
}

/// Other names for some keys, spelled too differently to be recognised by their letters.
const OTHER_NAMES: [(&str, &str); 16] = [
    ("min", "low"),
    ("minimum", "low"),
    ("max", "high"),
    ("maximum", "high"),
    ("mean", "value"),
    ("sigma", "sd"),
    ("crush", "depths"),
    ("edr", "recorder"),
    ("cdr", "recorder"),
    ("black_box", "recorder"),
    ("event_data_recorder", "recorder"),
    ("ebs", "ees"),
    ("bev", "ees"),
    ("kees", "ees"),
    ("inertia", "yaw_inertia"),
    ("moment_of_inertia", "yaw_inertia"),
];

/// The example line of a key with this name and dimension, in any table.
pub(crate) fn example_of(name: &str, dimension: Dimension) -> Option<&'static str> {
    let mut keys = keys_named(name);
    let of_dimension =
        |key: &&KeyInfo| key.form.measure().is_some_and(|measure| measure.dimension == dimension);
    keys.find(of_dimension).map(|key| key.example)
}

/// The dimensions of the keys with this name, in any table; empty if none is a quantity.
pub(crate) fn dimensions_of(name: &str) -> Vec<Dimension> {
    keys_named(name).filter_map(|key| Some(key.form.measure()?.dimension)).collect()
}

fn keys_named(name: &str) -> impl Iterator<Item = &'static KeyInfo> {
    let keys = ALL.into_iter().chain([&TEST]).flat_map(|schema| schema.keys);
    keys.filter(move |key| key.name == name)
}

impl fmt::Debug for Schema {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.place)
    }
}

impl Schema {
    /// Whether this table always needs the key.
    #[must_use]
    pub fn requires(&self, name: &str) -> bool {
        self.rules.iter().any(|rule| matches!(rule, Rule::Needs(names) if names.contains(&name)))
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &'static str> + Clone + use<> {
        self.keys.iter().map(|key| key.name)
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    /// The row of a key of this table.
    pub(crate) fn key(&self, name: &str) -> Option<&'static KeyInfo> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// The example line of a key of this table.
    pub(crate) fn example(&self, name: &str) -> &'static str {
        self.key(name).map_or("", |key| key.example)
    }

    /// The key of this table that has another name elsewhere.
    pub(crate) fn of_other_name(&self, name: &str) -> Option<&'static str> {
        let (_, key) = OTHER_NAMES.iter().find(|(other, _)| other.eq_ignore_ascii_case(name))?;
        self.has(key).then_some(*key)
    }

    /// The quantity of this table whose name is given with a unit at its end: `speed` for "speed_mph".
    pub(crate) fn without_unit(&self, name: &str) -> Option<&'static str> {
        let (key, unit) = name.rsplit_once(['_', '-', ' '])?;
        let known = self.key(key)?;
        read_unit(unit, known.form.measure()?.dimension).map(|_| known.name)
    }

    /// The place of a key that this table does not have.
    pub(crate) fn belongs(name: &str) -> Option<String> {
        let places: Vec<&str> =
            ALL.iter().filter(|schema| schema.has(name)).map(|schema| schema.place).collect();
        if places == [TOP.place] && TOP.example(name).starts_with('[') {
            return Some(format!("a table of its own, {}", TOP.example(name)));
        }
        (!places.is_empty()).then(|| join(&places, "or"))
    }
}

#[cfg(test)]
mod tests;
