//! The rows: exact factors from their definitions (NIST SP 811, appendix B.8 and its footnotes).

use std::f64::consts::PI;

use super::{Dimension, STANDARD_GRAVITY, Unit, UnitSystem};

/// (m) the international foot, exact.
const FOOT: f64 = 0.3048;
/// (m) the inch, exact.
const INCH: f64 = 0.0254;
/// (m) the mile, 5280 ft, exact.
const MILE: f64 = 1609.344;
/// (kg) the avoirdupois pound, exact.
const POUND: f64 = 0.453_592_37;
/// (N) the pound-force: a pound in standard gravity, exact.
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// (kg) the slug: 1 lbf·s²/ft.
const SLUG: f64 = POUND_FORCE / FOOT;
/// (√N) √(1 lbf): √4.448 221 615 260 5 = 2.109 080 751 242 232 545…
const ROOT_POUND_FORCE: f64 = 2.109_080_751_242_232_5;
/// (rad) the degree.
pub(super) const DEGREE: f64 = PI / 180.0;

const SI: Option<UnitSystem> = Some(UnitSystem::Si);
const US: Option<UnitSystem> = Some(UnitSystem::Us);
const BOTH: Option<UnitSystem> = None;

/// The data of a dimension.
pub(super) struct Kind {
    /// Its name with its article.
    pub(super) name: &'static str,
    /// (SI) the largest magnitude.
    pub(super) bound: f64,
    /// (SI) the smallest positive value.
    pub(super) least: f64,
    /// In the order in which error texts list them.
    pub(super) units: &'static [Unit],
}

/// The dimensions in the order of the enum: name, largest magnitude and smallest positive value, and the rows
/// of their units: canonical spelling, other spellings, factor, system.
macro_rules! kinds {
    ($($dimension:ident $name:literal, $bound:expr, $least:expr, {
        $($spelling:literal $others:expr, $factor:expr, $system:ident;)+
    })+) => {
        impl Dimension {
            /// All dimensions, in the order of the unit table.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$dimension),+];
        }

        static KINDS: [Kind; Dimension::ALL.len()] = [$(Kind {
            name: $name,
            bound: $bound,
            least: $least,
            units: &[$(Unit {
                spelling: $spelling,
                others: &$others,
                factor: $factor,
                system: $system,
                dimension: Dimension::$dimension,
            }),+],
        }),+];
    };
}

kinds! {
    Length "a length", 1e3, 1e-6, {
        "m" [], 1.0, SI;
        "cm" [], 0.01, SI;
        "mm" [], 0.001, SI;
        "ft" [], FOOT, US;
        "in" [], INCH, US;
    }
    Mass "a mass", 1e6, 1e-3, {
        "kg" [], 1.0, SI;
        "t" [], 1000.0, SI;
        "lb" ["lbm"], POUND, US;
        "slug" [], SLUG, US;
        "short ton" ["short tons"], 2000.0 * POUND, US;
    }
    Weight "a weight", 1e7, 1e-2, {
        "lb" ["lbf"], POUND_FORCE, US;
        "N" [], 1.0, SI;
        "kN" [], 1000.0, SI;
        "kgf" [], STANDARD_GRAVITY, SI;
        "short ton" ["short tons"], 2000.0 * POUND_FORCE, US;
    }
    Speed "a speed", 1e3, 1e-9, {
        "m/s" ["mps"], 1.0, SI;
        "km/h" ["kph", "kmph"], 1.0 / 3.6, SI;
        "mph" ["mi/h"], MILE / 3600.0, US;
        "ft/s" ["fps"], FOOT, US;
        "kn" ["kt"], 1852.0 / 3600.0, BOTH;
    }
    Angle "an angle", 1e5 * DEGREE, 1e-9, {
        "deg" [], DEGREE, BOTH;
        "rad" [], 1.0, BOTH;
    }
    YawRate "a yaw rate", 1e3, 1e-9, {
        "deg/s" [], DEGREE, BOTH;
        "rad/s" [], 1.0, BOTH;
        "rpm" ["rev/min"], PI / 30.0, BOTH;
    }
    Time "a time", 1e3, 1e-9, {
        "s" [], 1.0, BOTH;
        "ms" [], 0.001, BOTH;
    }
    Acceleration "an acceleration", 1e3, 1e-6, {
        "m/s^2" [], 1.0, SI;
        "g" [], STANDARD_GRAVITY, BOTH;
        "ft/s^2" [], FOOT, US;
    }
    Inertia "a moment of inertia", 1e9, 1e-9, {
        "kg m^2" ["m^2 kg"], 1.0, SI;
        "slug ft^2" ["ft^2 slug"], SLUG * FOOT * FOOT, US;
        "lb ft s^2" ["ft lb s^2", "lb s^2 ft", "ft s^2 lb", "s^2 lb ft", "s^2 ft lb"], POUND_FORCE * FOOT, US;
        "lb in s^2" ["in lb s^2", "lb s^2 in", "in s^2 lb", "s^2 lb in", "s^2 in lb"], POUND_FORCE * INCH, US;
        "lb ft^2" ["ft^2 lb", "lbm ft^2", "ft^2 lbm"], POUND * FOOT * FOOT, US;
        "lb in^2" ["in^2 lb", "lbm in^2", "in^2 lbm"], POUND * INCH * INCH, US;
    }
    Energy "an energy", 1e9, 1e-9, {
        "J" ["N m"], 1.0, SI;
        "kJ" ["kN m"], 1000.0, SI;
        "MJ" [], 1e6, SI;
        "ft lb" ["lb ft"], POUND_FORCE * FOOT, US;
    }
    StiffnessA "a stiffness A", 1e8, 1e-3, {
        "N/cm" [], 100.0, SI;
        "N/m" [], 1.0, SI;
        "N/mm" [], 1000.0, SI;
        "kN/m" [], 1000.0, SI;
        "kN/cm" [], 1e5, SI;
        "kN/mm" [], 1e6, SI;
        "lb/in" [], POUND_FORCE / INCH, US;
        "lb/ft" [], POUND_FORCE / FOOT, US;
    }
    StiffnessB "a stiffness B", 1e10, 1e-3, {
        "N/cm^2" [], 1e4, SI;
        "N/m^2" ["Pa"], 1.0, SI;
        "kN/m^2" ["kPa"], 1e3, SI;
        "MN/m^2" ["MPa", "N/mm^2"], 1e6, SI;
        "kN/cm^2" [], 1e7, SI;
        "lb/in^2" ["psi"], POUND_FORCE / (INCH * INCH), US;
        "lb/ft^2" ["psf"], POUND_FORCE / (FOOT * FOOT), US;
    }
    StiffnessG "a stiffness G", 1e8, 1e-3, {
        "N" [], 1.0, SI;
        "kN" [], 1000.0, SI;
        "lb" ["lbf"], POUND_FORCE, US;
    }
    RootForce "a root of force (d0)", 1e4, 1e-3, {
        "lb^0.5" [], ROOT_POUND_FORCE, US;
        "N^0.5" [], 1.0, SI;
    }
    RootForcePerLength "a root of force per length (d1)", 1e5, 1e-3, {
        "lb^0.5/ft" [], ROOT_POUND_FORCE / FOOT, US;
        "lb^0.5/in" [], ROOT_POUND_FORCE / INCH, US;
        "N^0.5/m" [], 1.0, SI;
        "N^0.5/cm" [], 100.0, SI;
    }
}

impl Dimension {
    pub(super) fn kind(self) -> &'static Kind {
        &KINDS[self as usize]
    }
}
