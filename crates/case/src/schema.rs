//! The tables of a case file and their keys: what an error text and the JSON Schema say of them.

use crate::nearest::join;
use crate::units::read_unit;
use inputs::{
    Axes, Bounds, BrachTangential, Dimension, ENERGY_BASES, Fit, LawName, OBLIQUE_CORRECTIONS, SIDES,
    UNKNOWNS, words_of,
};

/// The largest number of stations: far more than any scan of a vehicle gives.
pub(crate) const MOST_STATIONS: usize = 10_000;

/// The largest number of zones, each with a stiffness of its own: as many as a stiffness was ever told apart
/// in, and many more.
pub(crate) const MOST_ZONES: usize = 1_000;

/// The largest number of ranges. Each costs as much time as the whole case, and stands for an error that is
/// independent of all others.
pub(crate) const MOST_RANGES: usize = 500;

/// One key.
pub(crate) struct Key {
    pub(crate) name: &'static str,
    /// The line that sets it.
    pub(crate) example: &'static str,
    /// What its value is.
    pub(crate) form: Form,
    /// What it means; the first sentence is its title.
    pub(crate) text: &'static str,
}

const fn key(name: &'static str, example: &'static str, form: Form, text: &'static str) -> Key {
    Key { name, example, form, text }
}

/// A key whose text is that of its table.
const fn table(name: &'static str, example: &'static str, schema: &'static Schema) -> Key {
    Key { name, example, form: Form::Table(schema), text: "" }
}

impl Key {
    pub(crate) fn text(&self) -> &'static str {
        match self.form {
            Form::Table(schema) => schema.text,
            _ => self.text,
        }
    }
}

/// What a value is.
#[derive(Clone, Copy)]
pub(crate) enum Form {
    /// A text that is not empty.
    Text,
    /// True or false.
    Flag,
    /// One of these words.
    Words(&'static [&'static str]),
    /// The name of an impact law: one of these words.
    Law(&'static [&'static str]),
    /// A whole number from 1 to this.
    Count(u8),
    /// A plain number, or a range.
    Number(Bounds),
    /// A list of plain numbers and of ranges.
    Numbers(Bounds),
    /// A number with its unit, or a range.
    Quantity(Dimension, Bounds),
    /// Several, at least as many as the number says.
    Quantities(Dimension, Bounds, usize),
    /// An angle, or the hour of a clock.
    AngleOrHour,
    /// The table of a vehicle.
    Vehicle,
    /// A table.
    Table(&'static Schema),
    /// A list of tables.
    Tables(&'static Schema),
    /// One of these words, or a table.
    WordsOrTable(&'static [&'static str], &'static Schema),
    /// A plain number, a range, or a table.
    NumberOrTable(Bounds, &'static Schema),
    /// In a range: a value of the key that it stands for.
    Value,
    /// In a range of a list: the values.
    Values,
    /// In a range: as the value, and greater than zero.
    Deviation,
    /// In a range: a percentage.
    Percent,
    /// In a range: greater than 0 and less than 1.
    Probability,
}

/// What a quantity has to be.
#[derive(Clone, Copy)]
pub(crate) struct Measure {
    pub(crate) dimension: Dimension,
    pub(crate) bounds: Bounds,
    /// Why it has to be greater than zero, where that is worth saying.
    pub(crate) why: &'static str,
}

impl Measure {
    /// The same of one that has to be greater than zero, for a reason.
    pub(crate) fn positive(self, why: &'static str) -> Self {
        Self { bounds: Bounds::Positive, why, ..self }
    }
}

impl Form {
    /// What a quantity is, or each of several.
    pub(crate) fn measure(self) -> Option<Measure> {
        let (dimension, bounds) = match self {
            Self::Quantity(dimension, bounds) | Self::Quantities(dimension, bounds, _) => (dimension, bounds),
            Self::AngleOrHour => (Dimension::Angle, Bounds::None),
            _ => return None,
        };
        Some(Measure { dimension, bounds, why: "" })
    }

    /// The bounds of a plain number, or of each of several.
    pub(crate) fn bounds(self) -> Option<Bounds> {
        match self {
            Self::Number(bounds) | Self::Numbers(bounds) | Self::NumberOrTable(bounds, _) => Some(bounds),
            _ => None,
        }
    }
}

/// A table: its keys, and how an error text says where they belong.
pub(crate) struct Schema {
    pub(crate) place: &'static str,
    /// What it is; the first sentence is its title.
    pub(crate) text: &'static str,
    pub(crate) keys: &'static [Key],
    pub(crate) rules: &'static [Rule],
}

/// What holds of the keys of a table together.
pub(crate) enum Rule {
    /// These have to be there.
    Needs(&'static [&'static str]),
    /// Under all of these conditions, these have to be there.
    NeedsIf(&'static [Condition], &'static [&'static str]),
    /// Under this condition, none of these is there.
    NeverIf(Condition, &'static [&'static str]),
    /// The keys of one of these forms are there: those that it has to have, and none but those that it may.
    OneOf(&'static [FormOfTable]),
    /// The keys that each law needs, and no others.
    KeysOfLaw,
}

/// A condition of a rule.
#[derive(Clone, Copy)]
pub(crate) enum Condition {
    /// The key is there.
    Has(&'static str),
    /// It is not.
    Lacks(&'static str),
    /// The flag is true.
    True(&'static str),
    /// It is false or absent.
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

const ANY: Bounds = Bounds::None;
const NOT_NEGATIVE: Bounds = Bounds::NotNegative;
const POSITIVE: Bounds = Bounds::Positive;

pub(crate) static TOP: Schema = Schema {
    place: "the lines above the first table",
    text: "The case file. A two-vehicle collision: the vehicles, their damage, the impact, and what is looked for. Every number with a dimension is a text with its unit.",
    keys: &[
        key(
            "title",
            "title = \"Intersection collision\"",
            Form::Text,
            "Title of the case. It heads every report.",
        ),
        key(
            "source",
            "source = \"police report\"",
            Form::Text,
            "Where the data come from. A police report, a file number, a paper.",
        ),
        table("scene", "[scene]", &SCENE),
        key("vehicle1", "[vehicle1]", Form::Vehicle, "First vehicle."),
        key("vehicle2", "[vehicle2]", Form::Vehicle, "Second vehicle, or a fixed object."),
        table("impact", "[impact]", &IMPACT),
        table("reconstruct", "[reconstruct]", &RECONSTRUCT),
    ],
    rules: &[Rule::Needs(&["vehicle1", "vehicle2"])],
};

pub(crate) static SCENE: Schema = Schema {
    place: "[scene]",
    text: "The scene. In which axes the file gives its angles, lateral coordinates and yaw rates.",
    keys: &[key(
        "axes",
        "axes = \"z-down\"",
        Form::Words(&words_of(&Axes::WORDS)),
        "Axes of the file. `\"z-up\"`, also where absent: y to the left of x, angles and yaw rates positive counter-clockwise seen from above. `\"z-down\"`, as in SAE J670: y to the right, clockwise positive.",
    )],
    rules: &[],
};

pub(crate) static VEHICLE: Schema = Schema {
    place: "[vehicle1] or [vehicle2]",
    text: "A vehicle, or a fixed object with `fixed = true`. Which keys it needs depends on what is computed.",
    keys: &[
        key("name", "name = \"1994 GMC Jimmy\"", Form::Text, "Name of the vehicle. Reports call it so."),
        key(
            "fixed",
            "fixed = true",
            Form::Flag,
            "Fixed object. True for a barrier, a wall or a pole: it does not move and has no mass, inertia, speed or crush.",
        ),
        key(
            "mass",
            "mass = \"1676 kg\"",
            Form::Quantity(Dimension::Mass, POSITIVE),
            "Mass at the collision, with load and occupants. Or give `weight`. Here lb is the pound of mass.",
        ),
        key(
            "weight",
            "weight = \"3696 lb\"",
            Form::Quantity(Dimension::Weight, POSITIVE),
            "Weight at the collision, with load and occupants. Or give `mass`. Here lb is the pound-force.",
        ),
        key(
            "yaw_inertia",
            "yaw_inertia = \"2437 lb ft s^2\"",
            Form::Quantity(Dimension::Inertia, POSITIVE),
            "Yaw moment of inertia about the CG. Or give `yaw_radius`; without either, `class` or `wheelbase` beside `length` gives an estimate.",
        ),
        key(
            "yaw_radius",
            "yaw_radius = \"1.40 m\"",
            Form::Quantity(Dimension::Length, POSITIVE),
            "Radius of gyration in yaw, k. The inertia is m k².",
        ),
        key(
            "class",
            "class = 3",
            Form::Count(6),
            "Size class of CRASH3, 1 to 6. Its typical values stand in for a yaw inertia and an outline that are not given.",
        ),
        key(
            "wheelbase",
            "wheelbase = \"2.62 m\"",
            Form::Quantity(Dimension::Length, POSITIVE),
            "Wheelbase. Beside `length`, Burg's formula estimates a yaw inertia that is not given.",
        ),
        key(
            "heading",
            "heading = \"180 deg\"",
            Form::Quantity(Dimension::Angle, ANY),
            "Heading at impact. The scene angle of the forward axis, from x. Seen from above, positive counter-clockwise; clockwise under `axes = \"z-down\"`.",
        ),
        key(
            "speed",
            "speed = \"10 mph\"",
            Form::Quantity(Dimension::Speed, ANY),
            "Speed along the heading just before impact. Negative in reverse. Leave it out for the vehicle whose speed is looked for.",
        ),
        table("velocity", "velocity = { x = \"-75 ft/s\", y = \"0 ft/s\" }", &VELOCITY),
        key(
            "yaw_rate",
            "yaw_rate = \"0 deg/s\"",
            Form::Quantity(Dimension::YawRate, ANY),
            "Yaw rate just before impact. Seen from above, positive counter-clockwise; clockwise under `axes = \"z-down\"`. 0 where absent.",
        ),
        table("contact", "contact = { distance = \"6.3 ft\", angle = \"-22.4 deg\" }", &CONTACT),
        key(
            "length",
            "length = \"4.32 m\"",
            Form::Quantity(Dimension::Length, POSITIVE),
            "Overall length of the body. With `width` and `cg_to_front` it is the outline in drawings and checks.",
        ),
        key(
            "width",
            "width = \"1.74 m\"",
            Form::Quantity(Dimension::Length, POSITIVE),
            "Overall width of the body. With `length` and `cg_to_front`.",
        ),
        key(
            "cg_to_front",
            "cg_to_front = \"2.02 m\"",
            Form::Quantity(Dimension::Length, POSITIVE),
            "Distance from the CG to the front bumper. With `length` and `width`.",
        ),
        table("crush", "[vehicle1.crush]", &CRUSH),
    ],
    rules: &[
        Rule::NeverIf(True("fixed"), &NEVER_FIXED),
        Rule::NeverIf(Has("mass"), &["weight"]),
        Rule::NeverIf(Has("yaw_inertia"), &["yaw_radius"]),
        Rule::NeverIf(Has("speed"), &["velocity"]),
        Rule::NeedsIf(&[Has("width")], &["length", "cg_to_front"]),
        Rule::NeedsIf(&[Has("cg_to_front")], &["length", "width"]),
        Rule::NeedsIf(&[Has("length"), Lacks("wheelbase")], &["width", "cg_to_front"]),
    ],
};

/// What moves or is damaged, and a fixed object is neither.
pub(crate) static NEVER_FIXED: [&str; 10] = [
    "mass",
    "weight",
    "yaw_inertia",
    "yaw_radius",
    "class",
    "wheelbase",
    "speed",
    "velocity",
    "yaw_rate",
    "crush",
];

pub(crate) static CRUSH: Schema = Schema {
    place: "[vehicle1.crush] or [vehicle2.crush]",
    text: "Damage of one side of the vehicle. Residual crush as it was measured, and the stiffness of the structure.",
    keys: &[
        key(
            "side",
            "side = \"front\"",
            Form::Words(&words_of(&SIDES)),
            "Damaged side. The side of the vehicle whose face was crushed.",
        ),
        key(
            "width",
            "width = \"65 in\"",
            Form::Quantity(Dimension::Length, POSITIVE),
            "Width of the whole damage along the face. May be left out where `spacing` is given.",
        ),
        key(
            "depths",
            "depths = \"21.3 20.3 13.8 11.3 5.3 4.8 in\"",
            Form::Quantities(Dimension::Length, NOT_NEGATIVE, 2),
            "Crush depths C1, C2, … at two stations or more. From left to right on front and rear, from rear to front on the sides.",
        ),
        key(
            "spacing",
            "spacing = \"13 13 13 13 13 in\"",
            Form::Quantities(Dimension::Length, POSITIVE, 1),
            "Widths between neighbouring stations, one fewer than depths. Without it the stations are equally spaced over the width.",
        ),
        key(
            "from_force_balance",
            "from_force_balance = true",
            Form::Flag,
            "Crush inferred from the other vehicle. True where this vehicle could not be measured: its force is that on the other one. It then has no depths.",
        ),
        table("stiffness", "stiffness = { d0 = \"35 lb^0.5\", d1 = \"115 lb^0.5/ft\" }", &STIFFNESS),
        key(
            "offset",
            "offset = \"12 in\"",
            Form::Quantity(Dimension::Length, ANY),
            "Middle of the damage. Left of the vehicle's axis on front and rear, or right of it under `axes = \"z-down\"`; forward of the CG on the sides. For drawings, for a line of action without a contact point, and to see whether a contact point lies within the damage.",
        ),
        key(
            "pdof",
            "pdof = \"2.7 deg\"",
            Form::AngleOrHour,
            "Principal direction of force. The direction from which the force comes, clockwise from the heading in any axes, or the hour of a clock. CRASH3's part of every command takes it in place of that of the impulse, and its opposite for the other vehicle if that has none; the impact itself does not depend on it.",
        ),
        key(
            "oblique_angle",
            "oblique_angle = \"20 deg\"",
            Form::Quantity(Dimension::Angle, Bounds::Acute),
            "Angle between the force and the normal of the damaged side. Less than 90°. It replaces the one that the direction of force gives.",
        ),
        key(
            "moment_arm",
            "moment_arm = \"2.1 ft\"",
            Form::Quantity(Dimension::Length, NOT_NEGATIVE),
            "Distance from the CG to the line of action of the force. It replaces the one that contact point and direction of force give.",
        ),
        key(
            "oblique",
            "oblique = \"capped\"",
            Form::WordsOrTable(&words_of(&OBLIQUE_CORRECTIONS), &OBLIQUE),
            "Correction of the crush energy for an oblique force. `\"capped\"`, also where absent: 1 + tan²α with α at most 45°, as in CRASH3; `\"uncapped\"`: without that limit; `\"secant\"`: 1/cos α; `\"none\"`; or `{ friction = 0.5 }`: limited by friction.",
        ),
    ],
    rules: &[
        Rule::Needs(&["side", "stiffness"]),
        Rule::NeedsIf(&[NotTrue("from_force_balance")], &["depths"]),
        Rule::NeedsIf(&[NotTrue("from_force_balance"), Lacks("spacing")], &["width"]),
        Rule::NeverIf(True("from_force_balance"), &["depths", "spacing"]),
    ],
};

pub(crate) static IMPACT: Schema = Schema {
    place: "[impact]",
    text: "The impact: the crush plane, and the impact law with its coefficients. Keys of another law are errors.",
    keys: &[
        key(
            "crush_plane",
            "crush_plane = \"-23 deg\"",
            Form::Quantity(Dimension::Angle, ANY),
            "Scene angle Γ of the normal of the crush plane. From x; seen from above, positive counter-clockwise, or clockwise under `axes = \"z-down\"`. The plane itself lies along the surface on which the vehicles touched; Γ and Γ + 180° are the same plane.",
        ),
        key(
            "law",
            "law = \"brach\"",
            Form::Law(&words_of(&LawName::WORDS)),
            "Impact law. `\"brach\"` where absent.",
        ),
        key(
            "restitution",
            "restitution = 0.3",
            Form::NumberOrTable(Bounds::BelowOne, &RESTITUTION),
            "Coefficient of restitution e, 0 to 1. Closing speed after over before, at the contact point and normal to the crush plane. Or a curve over the closing speed.",
        ),
        key(
            "tangential",
            "tangential = \"critical\"",
            Form::WordsOrTable(&words_of(&BrachTangential::WORDS), &TANGENTIAL),
            "What happens along the crush plane, under Brach's law. `\"critical\"`: sliding ends by separation, as in most collisions that are not sideswipes; or a table with `ratio`, `fraction` or `friction`.",
        ),
        key(
            "moment_restitution",
            "moment_restitution = -0.5",
            Form::Number(Bounds::Coefficient),
            "Moment coefficient of restitution e_m, -1 to 1. For a moment impulse at the contact point, under Brach's law; -1, also where absent, is none.",
        ),
        key(
            "tangential_velocity_change",
            "tangential_velocity_change = \"5 m/s\"",
            Form::Quantity(Dimension::Speed, ANY),
            "Change of the relative velocity along the crush plane. For a sideswipe under Woolley's law; without it the surfaces stop sliding. The tangential axis is the normal turned by 90°, counter-clockwise or, under `axes = \"z-down\"`, clockwise.",
        ),
        key(
            "tangential_restitution",
            "tangential_restitution = -0.2",
            Form::Number(Bounds::Coefficient),
            "Tangential coefficient of restitution e_t of Ishikawa's law, -1 to 1. 1 reverses the sliding, 0 ends it, -1 does not change it.",
        ),
        key(
            "friction",
            "friction = 0.5",
            Form::Number(NOT_NEGATIVE),
            "Friction μ of Kudlich and Slibar's law. The surfaces stop sliding, or slide to the end where that takes more than this.",
        ),
    ],
    rules: &[Rule::Needs(&["crush_plane"]), Rule::KeysOfLaw],
};

/// What the file has to say of an impact law.
pub(crate) trait KeysOfLaw: Copy {
    /// The keys of [impact] that the law has to have, besides crush_plane.
    fn needed(self) -> &'static [&'static str];

    /// The key that it may have.
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
            Some(key) => format!("{} and, if wanted, {key}", needed.join(", ")),
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
    text: "The reconstruction: the speed that is looked for. It is the one at which the impact takes the crush energy.",
    keys: &[
        key(
            "find",
            "find = \"vehicle1.speed\"",
            Form::Words(&words_of(&UNKNOWNS)),
            "Speed that is looked for. The other vehicle's has to be known, or that vehicle fixed.",
        ),
        key(
            "energy_basis",
            "energy_basis = \"dissipated\"",
            Form::Words(&words_of(&ENERGY_BASES)),
            "What the crush energy is. `\"dissipated\"`, also where absent: what stays in the deformed structure after rebound, as in SAE 980025; `\"absorbed\"`: what was taken up at maximum engagement, as stiffness from the impact speeds of barrier tests gives it.",
        ),
    ],
    rules: &[Rule::Needs(&["find"])],
};

pub(crate) static CONTACT: Schema = Schema {
    place: "contact = { … } of a vehicle",
    text: "Contact point, from the CG of the vehicle. `distance` and `angle`, or `x` and `y`.",
    keys: &[
        key(
            "distance",
            "distance = \"6.3 ft\"",
            Form::Quantity(Dimension::Length, NOT_NEGATIVE),
            "Distance from the CG to the contact point.",
        ),
        key(
            "angle",
            "angle = \"-22.4 deg\"",
            Form::Quantity(Dimension::Angle, ANY),
            "Angle from the heading to the contact point. Positive to the left, or to the right under `axes = \"z-down\"`.",
        ),
        key(
            "x",
            "x = \"1.78 m\"",
            Form::Quantity(Dimension::Length, ANY),
            "Forward of the CG. Negative behind it.",
        ),
        key(
            "y",
            "y = \"-0.73 m\"",
            Form::Quantity(Dimension::Length, ANY),
            "Left of the CG, or right of it under `axes = \"z-down\"`. Negative on the other side.",
        ),
    ],
    rules: &[Rule::OneOf(&[form(&["distance", "angle"], &[]), form(&["x", "y"], &[])])],
};

pub(crate) static VELOCITY: Schema = Schema {
    place: "velocity = { … } of a vehicle",
    text: "Velocity of the CG just before impact. In the axes of the scene.",
    keys: &[
        key("x", "x = \"-75 ft/s\"", Form::Quantity(Dimension::Speed, ANY), "Along the x axis of the scene."),
        key("y", "y = \"0 ft/s\"", Form::Quantity(Dimension::Speed, ANY), "Along the y axis of the scene."),
    ],
    rules: &[Rule::Needs(&["x", "y"])],
};

// The keys of a straight line of force over crush: of a whole side, or of one zone.
const STIFFNESS_A: Key = key(
    "A",
    "A = \"587 N/cm\"",
    Form::Quantity(Dimension::StiffnessA, NOT_NEGATIVE),
    "Stiffness A. Force per width at which crush begins.",
);
const STIFFNESS_B: Key = key(
    "B",
    "B = \"63.3 N/cm^2\"",
    Form::Quantity(Dimension::StiffnessB, NOT_NEGATIVE),
    "Stiffness B. Force per width and depth; zero only beside `G`.",
);
const STIFFNESS_D0: Key = key(
    "d0",
    "d0 = \"35 lb^0.5\"",
    Form::Quantity(Dimension::RootForce, NOT_NEGATIVE),
    "Coefficient d0 = A/√B. With E/w the energy per width, √(2 E/w) = d0 + d1 C rises in a straight line over the crush C.",
);
const STIFFNESS_D1: Key = key(
    "d1",
    "d1 = \"115 lb^0.5/ft\"",
    Form::Quantity(Dimension::RootForcePerLength, POSITIVE),
    "Coefficient d1 = √B. With E/w the energy per width, √(2 E/w) = d0 + d1 C rises in a straight line over the crush C.",
);
const STIFFNESS_G: Key = key(
    "G",
    "G = \"612 lb\"",
    Form::Quantity(Dimension::StiffnessG, NOT_NEGATIVE),
    "Stiffness G. Energy per width that leaves no crush; A²/2B where absent.",
);
const STIFFNESS_LIMIT: Key = key(
    "limit",
    "limit = \"250 kN/m\"",
    Form::Quantity(Dimension::StiffnessA, NOT_NEGATIVE),
    "Force per width beyond which the force no longer rises. Left out where that is not known.",
);

pub(crate) static STIFFNESS: Schema = Schema {
    place: "stiffness = { … } of a crush table",
    text: "Stiffness of the damaged side. `A` and `B`, or `d0` and `d1`, or a `category` of CRASH3, or a barrier `test`, or `zones`.",
    keys: &[
        STIFFNESS_A,
        STIFFNESS_B,
        STIFFNESS_D0,
        STIFFNESS_D1,
        STIFFNESS_G,
        STIFFNESS_LIMIT,
        key(
            "category",
            "category = 4",
            Form::Count(5),
            "Stiffness category of CRASH3's table, 1 to 5. For the damaged side (SAE 870045, Table 1).",
        ),
        table(
            "test",
            "test = { mass = \"1500 kg\", speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 50 54 54 50 42 cm\", no_damage_speed = \"8 km/h\" }",
            &TEST,
        ),
        key(
            "zones",
            "zones = [{ A = \"587 N/cm\", B = \"63.3 N/cm^2\" }, { A = \"400 N/cm\", B = \"50 N/cm^2\" }]",
            Form::Tables(&ZONE),
            "Stiffness of each zone between two stations. One fewer than depths.",
        ),
    ],
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
    text: "Stiffness of the zone between two stations. `A` and `B`, or `d0` and `d1`.",
    keys: &[STIFFNESS_A, STIFFNESS_B, STIFFNESS_D0, STIFFNESS_D1, STIFFNESS_G, STIFFNESS_LIMIT],
    rules: &[Rule::OneOf(&[form(&["A", "B"], &["G", "limit"]), form(&["d0", "d1"], &["G", "limit"])])],
};

pub(crate) static TEST: Schema = Schema {
    place: "test = { … } of a stiffness",
    text: "A full-width test against a rigid barrier, to which the stiffness is fitted. Of the same make, or a similar one.",
    keys: &[
        key(
            "mass",
            "mass = \"1500 kg\"",
            Form::Quantity(Dimension::Mass, POSITIVE),
            "Test mass. Or give `weight`.",
        ),
        key(
            "weight",
            "weight = \"3300 lb\"",
            Form::Quantity(Dimension::Weight, POSITIVE),
            "Test weight. Or give `mass`.",
        ),
        key(
            "speed",
            "speed = \"56 km/h\"",
            Form::Quantity(Dimension::Speed, POSITIVE),
            "Impact speed of the test.",
        ),
        key(
            "width",
            "width = \"1.6 m\"",
            Form::Quantity(Dimension::Length, POSITIVE),
            "Width of the damage in the test.",
        ),
        key(
            "depths",
            "depths = \"42 50 54 54 50 42 cm\"",
            Form::Quantities(Dimension::Length, NOT_NEGATIVE, 2),
            "Residual crush after the test, at equally spaced stations.",
        ),
        key(
            "no_damage_speed",
            "no_damage_speed = \"8 km/h\"",
            Form::Quantity(Dimension::Speed, NOT_NEGATIVE),
            "Impact speed up to which no crush remains. Below the speed of the test.",
        ),
        key(
            "fit",
            "fit = \"exact\"",
            Form::Words(&words_of(&Fit::WORDS)),
            "How the stiffness is fitted. `\"exact\"`, also where absent: the kinetic energy of the test comes back; `\"mean\"`: through the mean crush, which gives some per cent too much.",
        ),
    ],
    rules: &[
        Rule::Needs(&["speed", "width", "depths", "no_damage_speed"]),
        Rule::NeedsIf(&[Lacks("weight")], &["mass"]),
        Rule::NeverIf(Has("mass"), &["weight"]),
    ],
};

pub(crate) static OBLIQUE: Schema = Schema {
    place: "oblique = { … } of a crush table",
    text: "A correction for an oblique force that friction limits. The factor is 1 + min(|tan α|, μ) |tan α|.",
    keys: &[key(
        "friction",
        "friction = 0.5",
        Form::Number(NOT_NEGATIVE),
        "Friction μ between the vehicles.",
    )],
    rules: &[Rule::Needs(&["friction"])],
};

pub(crate) static TANGENTIAL: Schema = Schema {
    place: "tangential = { … } of [impact]",
    text: "What happens along the crush plane. One of `ratio`, `fraction` and `friction`.",
    keys: &[
        key(
            "ratio",
            "ratio = 0.37",
            Form::Number(ANY),
            "Impulse ratio μ. Tangential over normal impulse, with its sign: the tangential axis is the normal turned by 90°, counter-clockwise or, under `axes = \"z-down\"`, clockwise.",
        ),
        key(
            "fraction",
            "fraction = 0.9",
            Form::Number(Bounds::Share),
            "Fraction of the critical impulse ratio, 0 to 1. 0 is without friction, 1 ends the sliding.",
        ),
        key(
            "friction",
            "friction = 0.5",
            Form::Number(NOT_NEGATIVE),
            "Friction μ. The surfaces stop sliding, or slide to the end where that takes more than this: for sideswipes and barriers.",
        ),
    ],
    rules: &[Rule::OneOf(&[form(&["ratio"], &[]), form(&["fraction"], &[]), form(&["friction"], &[])])],
};

pub(crate) static RESTITUTION: Schema = Schema {
    place: "restitution = { … } of [impact]",
    text: "A coefficient of restitution that depends on the closing speed. As many values as speeds.",
    keys: &[
        key(
            "speeds",
            "speeds = \"2 5 10 20 m/s\"",
            Form::Quantities(Dimension::Speed, NOT_NEGATIVE, 1),
            "Closing speeds, each more than the one before.",
        ),
        key(
            "values",
            "values = [0.3, 0.2, 0.12, 0.05]",
            Form::Numbers(Bounds::BelowOne),
            "Coefficient of restitution at each of these speeds, 0 to 1.",
        ),
    ],
    rules: &[Rule::Needs(&["speeds", "values"])],
};

/// Of one quantity; a line of the key itself is the example of its amounts.
pub(crate) static RANGE: Schema = Schema {
    place: "a range",
    text: "A number that is not known exactly.",
    keys: &[
        key("value", "{ value = …, sd = … }", Form::Value, "Central value."),
        key(
            "sd",
            "{ value = …, sd = … }",
            Form::Deviation,
            "Standard deviation. Beside `value`: a normal distribution.",
        ),
        key("low", "{ low = …, high = … }", Form::Value, "Least value."),
        key(
            "mode",
            "{ low = …, mode = …, high = … }",
            Form::Value,
            "Likeliest value. Beside `low` and `high`: a triangular distribution.",
        ),
        key(
            "high",
            "{ low = …, high = … }",
            Form::Value,
            "Greatest value. With `low` alone, anything between the two is as likely.",
        ),
        key(
            "within",
            "within = \"10 %\"",
            Form::Percent,
            "Distance from the value, in per cent of it. With the probability `confidence` it lies as near: a normal distribution.",
        ),
        key(
            "confidence",
            "confidence = 0.95",
            Form::Probability,
            "Probability that it lies within that distance. More than 0 and less than 1.",
        ),
    ],
    rules: &[Rule::OneOf(&[
        form(&["value", "sd"], &[]),
        form(&["value", "within", "confidence"], &[]),
        form(&["low", "high"], &["mode"]),
    ])],
};

/// Of several quantities.
pub(crate) static RANGE_OF_LIST: Schema = Schema {
    place: "a range of several values",
    text: "Several numbers that are not known exactly. Each with the same spread, independent of the others.",
    keys: &[
        key("values", "values = \"21.3 20.3 13.8 in\"", Form::Values, "The central values."),
        key(
            "sd",
            "{ values = …, sd = … }",
            Form::Deviation,
            "Standard deviation. Beside `values`: a normal distribution.",
        ),
        key(
            "within",
            "within = \"10 %\"",
            Form::Percent,
            "Distance from the value, in per cent of it. With the probability `confidence` it lies as near: a normal distribution.",
        ),
        key(
            "confidence",
            "confidence = 0.95",
            Form::Probability,
            "Probability that it lies within that distance. More than 0 and less than 1.",
        ),
    ],
    rules: &[Rule::OneOf(&[form(&["values", "sd"], &[]), form(&["values", "within", "confidence"], &[])])],
};

static ALL: [&Schema; 11] = [
    &TOP,
    &SCENE,
    &VEHICLE,
    &CRUSH,
    &IMPACT,
    &RECONSTRUCT,
    &CONTACT,
    &VELOCITY,
    &STIFFNESS,
    &TANGENTIAL,
    &RESTITUTION,
];

/// The path of every key of a case file, tables included: `scene`, `scene.axes`, `vehicle1`, …,
/// `vehicle1.crush.stiffness.d0`, …
///
/// Those of a range, which can stand in the place of any number, are not among them.
///
/// ```
/// let keys = case::keys();
/// assert!(keys.contains(&"impact.tangential.friction".to_owned()));
/// ```
#[must_use]
pub fn keys() -> Vec<String> {
    walked(|_| true)
}

/// The path of every key of a case file that holds a number or several, each of which can be a range:
/// `vehicle1.mass`, …, `impact.restitution`, `impact.restitution.speeds`, … They are among [`keys`], and have
/// no numbers of elements.
///
/// ```
/// let keys = case::number_keys();
/// assert!(keys.contains(&"vehicle1.crush.depths".to_owned()));
/// assert!(!keys.contains(&"vehicle1.crush.side".to_owned()));
/// ```
#[must_use]
pub fn number_keys() -> Vec<String> {
    walked(|form| match form {
        Form::Number(_)
        | Form::Numbers(_)
        | Form::Quantity(..)
        | Form::Quantities(..)
        | Form::AngleOrHour
        | Form::NumberOrTable(..) => true,
        Form::Text
        | Form::Flag
        | Form::Words(_)
        | Form::Law(_)
        | Form::Count(_)
        | Form::Vehicle
        | Form::Table(_)
        | Form::Tables(_)
        | Form::WordsOrTable(..)
        | Form::Value
        | Form::Values
        | Form::Deviation
        | Form::Percent
        | Form::Probability => false,
    })
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
            match key.form {
                Form::Vehicle => walk(&VEHICLE, &inner, is_wanted, paths),
                Form::Table(schema)
                | Form::Tables(schema)
                | Form::WordsOrTable(_, schema)
                | Form::NumberOrTable(_, schema) => walk(schema, &inner, is_wanted, paths),
                _ => {}
            }
        }
    }
    let mut paths = Vec::new();
    walk(&TOP, "", is_wanted, &mut paths);
    paths
}

/// What people call some keys, which resembles them too little to be found by its letters.
const OTHER_NAMES: [(&str, &str); 7] = [
    ("min", "low"),
    ("minimum", "low"),
    ("max", "high"),
    ("maximum", "high"),
    ("mean", "value"),
    ("sigma", "sd"),
    ("crush", "depths"),
];

/// The line that sets a key of this name to a quantity of that dimension, in any table.
pub(crate) fn example_of(name: &str, dimension: Dimension) -> Option<&'static str> {
    let mut keys = keys_named(name);
    let of_dimension = |key: &&Key| key.form.measure().is_some_and(|measure| measure.dimension == dimension);
    keys.find(of_dimension).map(|key| key.example)
}

/// What a key of this name measures, in any table: nothing where it is no quantity.
pub(crate) fn dimensions_of(name: &str) -> Vec<Dimension> {
    keys_named(name).filter_map(|key| Some(key.form.measure()?.dimension)).collect()
}

fn keys_named(name: &str) -> impl Iterator<Item = &'static Key> {
    let keys = ALL.into_iter().chain([&TEST]).flat_map(|schema| schema.keys);
    keys.filter(move |key| key.name == name)
}

impl Schema {
    pub(crate) fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.keys.iter().map(|key| key.name)
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    /// The row of a key of this table.
    pub(crate) fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// The example line of a key of this table.
    pub(crate) fn example(&self, name: &str) -> &'static str {
        self.key(name).map_or("", |key| key.example)
    }

    /// The key of this table that goes by another name elsewhere.
    pub(crate) fn of_other_name(&self, name: &str) -> Option<&'static str> {
        let (_, key) = OTHER_NAMES.iter().find(|(other, _)| other.eq_ignore_ascii_case(name))?;
        self.has(key).then_some(*key)
    }

    /// The quantity of this table that has a unit at the end of its name: `speed` of "speed_mph".
    pub(crate) fn without_unit(&self, name: &str) -> Option<&'static str> {
        let (key, unit) = name.rsplit_once(['_', '-', ' '])?;
        let known = self.names().find(|known| *known == key)?;
        dimensions_of(key).iter().any(|dimension| read_unit(unit, *dimension).is_some()).then_some(known)
    }

    /// Where a key that this table does not have belongs.
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
