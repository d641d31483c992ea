//! The tables of a case file and their keys, each with the line an error text shows.

use crate::nearest::join;

/// One key: its name, and an example of the line that sets it.
pub(crate) struct Key {
    pub(crate) name: &'static str,
    pub(crate) example: &'static str,
}

const fn key(name: &'static str, example: &'static str) -> Key {
    Key { name, example }
}

/// A table: its keys, and how an error text says where they belong.
pub(crate) struct Schema {
    pub(crate) place: &'static str,
    pub(crate) keys: &'static [Key],
}

pub(crate) static TOP: Schema = Schema {
    place: "the lines above the first table",
    keys: &[
        key("title", "title = \"Intersection collision\""),
        key("source", "source = \"police report\""),
        key("scene", "[scene]"),
        key("vehicle1", "[vehicle1]"),
        key("vehicle2", "[vehicle2]"),
        key("impact", "[impact]"),
        key("reconstruct", "[reconstruct]"),
    ],
};

pub(crate) static SCENE: Schema = Schema { place: "[scene]", keys: &[key("axes", "axes = \"z-down\"")] };

pub(crate) static VEHICLE: Schema = Schema {
    place: "[vehicle1] or [vehicle2]",
    keys: &[
        key("name", "name = \"1994 GMC Jimmy\""),
        key("fixed", "fixed = true"),
        key("mass", "mass = \"1676 kg\""),
        key("weight", "weight = \"3696 lb\""),
        key("yaw_inertia", "yaw_inertia = \"2437 lb ft s^2\""),
        key("yaw_radius", "yaw_radius = \"1.40 m\""),
        key("class", "class = 3"),
        key("wheelbase", "wheelbase = \"2.62 m\""),
        key("heading", "heading = \"180 deg\""),
        key("speed", "speed = \"10 mph\""),
        key("velocity", "velocity = { x = \"-75 ft/s\", y = \"0 ft/s\" }"),
        key("yaw_rate", "yaw_rate = \"0 deg/s\""),
        key("contact", "contact = { distance = \"6.3 ft\", angle = \"-22.4 deg\" }"),
        key("length", "length = \"4.32 m\""),
        key("width", "width = \"1.74 m\""),
        key("cg_to_front", "cg_to_front = \"2.02 m\""),
        key("crush", "[vehicle1.crush]"),
    ],
};

pub(crate) static CRUSH: Schema = Schema {
    place: "[vehicle1.crush] or [vehicle2.crush]",
    keys: &[
        key("side", "side = \"front\""),
        key("width", "width = \"65 in\""),
        key("depths", "depths = \"21.3 20.3 13.8 11.3 5.3 4.8 in\""),
        key("spacing", "spacing = \"13 13 13 13 13 in\""),
        key("from_force_balance", "from_force_balance = true"),
        key("stiffness", "stiffness = { d0 = \"35 lb^0.5\", d1 = \"115 lb^0.5/ft\" }"),
        key("offset", "offset = \"12 in\""),
        key("pdof", "pdof = \"2.7 deg\""),
        key("oblique_angle", "oblique_angle = \"20 deg\""),
        key("moment_arm", "moment_arm = \"2.1 ft\""),
        key("oblique", "oblique = \"capped\""),
    ],
};

pub(crate) static IMPACT: Schema = Schema {
    place: "[impact]",
    keys: &[
        key("crush_plane", "crush_plane = \"-23 deg\""),
        key("law", "law = \"brach\""),
        key("restitution", "restitution = 0.3"),
        key("tangential", "tangential = \"critical\""),
        key("moment_restitution", "moment_restitution = -0.5"),
        key("tangential_velocity_change", "tangential_velocity_change = \"5 m/s\""),
        key("tangential_restitution", "tangential_restitution = -0.2"),
        key("friction", "friction = 0.5"),
    ],
};

/// The impact laws that `law` of [impact] can name.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum LawName {
    Brach,
    Woolley,
    Ishikawa,
    KudlichSlibar,
}

impl LawName {
    pub(crate) const ALL: [Self; 4] = [Self::Brach, Self::Woolley, Self::Ishikawa, Self::KudlichSlibar];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Brach => "brach",
            Self::Woolley => "woolley",
            Self::Ishikawa => "ishikawa",
            Self::KudlichSlibar => "kudlich-slibar",
        }
    }

    /// The keys of [impact] that the law has to have, besides crush_plane.
    pub(crate) fn needed(self) -> &'static [&'static str] {
        match self {
            Self::Brach => &["restitution", "tangential"],
            Self::Woolley => &[],
            Self::Ishikawa => &["restitution", "tangential_restitution"],
            Self::KudlichSlibar => &["restitution", "friction"],
        }
    }

    /// The key that it may have.
    pub(crate) fn optional(self) -> Option<&'static str> {
        match self {
            Self::Brach => Some("moment_restitution"),
            Self::Woolley => Some("tangential_velocity_change"),
            Self::Ishikawa | Self::KudlichSlibar => None,
        }
    }

    pub(crate) fn uses(self, key: &str) -> bool {
        key == "crush_plane"
            || key == "law"
            || self.needed().contains(&key)
            || self.optional().is_some_and(|own| own == key)
    }

    /// Its keys in words.
    pub(crate) fn keys(self) -> String {
        let needed = [&["crush_plane"], self.needed()].concat();
        match self.optional() {
            Some(key) => format!("{} and, if wanted, {key}", needed.join(", ")),
            None => join(&needed, "and"),
        }
    }

    /// The laws that use a key.
    pub(crate) fn of_key(key: &str) -> Vec<&'static str> {
        Self::ALL.into_iter().filter(|law| law.uses(key)).map(Self::name).collect()
    }
}

pub(crate) static RECONSTRUCT: Schema = Schema {
    place: "[reconstruct]",
    keys: &[key("find", "find = \"vehicle1.speed\""), key("energy_basis", "energy_basis = \"dissipated\"")],
};

pub(crate) static CONTACT: Schema = Schema {
    place: "contact = { … } of a vehicle",
    keys: &[
        key("distance", "distance = \"6.3 ft\""),
        key("angle", "angle = \"-22.4 deg\""),
        key("x", "x = \"1.78 m\""),
        key("y", "y = \"-0.73 m\""),
    ],
};

pub(crate) static VELOCITY: Schema = Schema {
    place: "velocity = { … } of a vehicle",
    keys: &[key("x", "x = \"-75 ft/s\""), key("y", "y = \"0 ft/s\"")],
};

pub(crate) static STIFFNESS: Schema = Schema {
    place: "stiffness = { … } of a crush table",
    keys: &[
        key("A", "A = \"587 N/cm\""),
        key("B", "B = \"63.3 N/cm^2\""),
        key("d0", "d0 = \"35 lb^0.5\""),
        key("d1", "d1 = \"115 lb^0.5/ft\""),
        key("G", "G = \"612 lb\""),
        key("limit", "limit = \"250 kN/m\""),
        key("category", "category = 4"),
        key(
            "test",
            "test = { mass = \"1500 kg\", speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 50 54 54 50 42 cm\", no_damage_speed = \"8 km/h\" }",
        ),
        key(
            "zones",
            "zones = [{ A = \"587 N/cm\", B = \"63.3 N/cm^2\" }, { A = \"400 N/cm\", B = \"50 N/cm^2\" }]",
        ),
    ],
};

pub(crate) static ZONE: Schema = Schema {
    place: "zones = [{ … }] of a stiffness",
    keys: &[
        key("A", "A = \"587 N/cm\""),
        key("B", "B = \"63.3 N/cm^2\""),
        key("d0", "d0 = \"35 lb^0.5\""),
        key("d1", "d1 = \"115 lb^0.5/ft\""),
        key("G", "G = \"612 lb\""),
        key("limit", "limit = \"250 kN/m\""),
    ],
};

pub(crate) static TEST: Schema = Schema {
    place: "test = { … } of a stiffness",
    keys: &[
        key("mass", "mass = \"1500 kg\""),
        key("weight", "weight = \"3300 lb\""),
        key("speed", "speed = \"56 km/h\""),
        key("width", "width = \"1.6 m\""),
        key("depths", "depths = \"42 50 54 54 50 42 cm\""),
        key("no_damage_speed", "no_damage_speed = \"8 km/h\""),
        key("fit", "fit = \"exact\""),
    ],
};

pub(crate) static OBLIQUE: Schema =
    Schema { place: "oblique = { … } of a crush table", keys: &[key("friction", "friction = 0.5")] };

pub(crate) static TANGENTIAL: Schema = Schema {
    place: "tangential = { … } of [impact]",
    keys: &[
        key("ratio", "ratio = 0.37"),
        key("fraction", "fraction = 0.9"),
        key("friction", "friction = 0.5"),
    ],
};

pub(crate) static RESTITUTION: Schema = Schema {
    place: "restitution = { … } of [impact]",
    keys: &[key("speeds", "speeds = \"2 5 10 20 m/s\""), key("values", "values = [0.3, 0.2, 0.12, 0.05]")],
};

/// Of one quantity; a line of the key itself is the example of its amounts.
pub(crate) static RANGE: Schema = Schema {
    place: "a range",
    keys: &[
        key("value", "{ value = …, sd = … }"),
        key("sd", "{ value = …, sd = … }"),
        key("low", "{ low = …, high = … }"),
        key("mode", "{ low = …, mode = …, high = … }"),
        key("high", "{ low = …, high = … }"),
        key("within", "within = \"10 %\""),
        key("confidence", "confidence = 0.95"),
    ],
};

/// Of several quantities.
pub(crate) static RANGE_OF_LIST: Schema = Schema {
    place: "a range of several values",
    keys: &[
        key("values", "values = \"21.3 20.3 13.8 in\""),
        key("sd", "{ values = …, sd = … }"),
        key("within", "within = \"10 %\""),
        key("confidence", "confidence = 0.95"),
    ],
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

impl Schema {
    pub(crate) fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.keys.iter().map(|key| key.name)
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    /// The example line of a key of this table.
    pub(crate) fn example(&self, name: &str) -> &'static str {
        self.keys.iter().find(|key| key.name == name).map_or("", |key| key.example)
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
