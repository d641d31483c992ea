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

/// Writes one dimension's rows: canonical spelling, other spellings, factor, custom.
macro_rules! rows {
    ($name:ident, $dimension:ident: $($spelling:literal $others:expr, $factor:expr, $system:ident;)+) => {
        static $name: &[Unit] = &[$(Unit {
            spelling: $spelling,
            others: &$others,
            factor: $factor,
            system: $system,
            dimension: Dimension::$dimension,
        }),+];
    };
}

rows! { LENGTH, Length:
    "m" [], 1.0, SI;
    "cm" [], 0.01, SI;
    "mm" [], 0.001, SI;
    "ft" [], FOOT, US;
    "in" [], INCH, US;
}
rows! { MASS, Mass:
    "kg" [], 1.0, SI;
    "t" [], 1000.0, SI;
    "lb" ["lbm"], POUND, US;
    "slug" [], SLUG, US;
    "short ton" ["short tons"], 2000.0 * POUND, US;
}
rows! { WEIGHT, Weight:
    "lb" ["lbf"], POUND_FORCE, US;
    "N" [], 1.0, SI;
    "kN" [], 1000.0, SI;
    "kgf" [], STANDARD_GRAVITY, SI;
    "short ton" ["short tons"], 2000.0 * POUND_FORCE, US;
}
rows! { SPEED, Speed:
    "m/s" ["mps"], 1.0, SI;
    "km/h" ["kph", "kmph"], 1.0 / 3.6, SI;
    "mph" ["mi/h"], MILE / 3600.0, US;
    "ft/s" ["fps"], FOOT, US;
    "kn" ["kt"], 1852.0 / 3600.0, BOTH;
}
rows! { ANGLE, Angle:
    "deg" [], DEGREE, BOTH;
    "rad" [], 1.0, BOTH;
}
rows! { YAW_RATE, YawRate:
    "deg/s" [], DEGREE, BOTH;
    "rad/s" [], 1.0, BOTH;
    "rpm" ["rev/min"], PI / 30.0, BOTH;
}
rows! { TIME, Time:
    "s" [], 1.0, BOTH;
    "ms" [], 0.001, BOTH;
}
rows! { ACCELERATION, Acceleration:
    "m/s^2" [], 1.0, SI;
    "g" [], STANDARD_GRAVITY, BOTH;
    "ft/s^2" [], FOOT, US;
}
rows! { INERTIA, Inertia:
    "kg m^2" ["m^2 kg"], 1.0, SI;
    "slug ft^2" ["ft^2 slug"], SLUG * FOOT * FOOT, US;
    "lb ft s^2" ["ft lb s^2", "lb s^2 ft", "ft s^2 lb", "s^2 lb ft", "s^2 ft lb"], POUND_FORCE * FOOT, US;
    "lb in s^2" ["in lb s^2", "lb s^2 in", "in s^2 lb", "s^2 lb in", "s^2 in lb"], POUND_FORCE * INCH, US;
    "lb ft^2" ["ft^2 lb", "lbm ft^2", "ft^2 lbm"], POUND * FOOT * FOOT, US;
    "lb in^2" ["in^2 lb", "lbm in^2", "in^2 lbm"], POUND * INCH * INCH, US;
}
rows! { ENERGY, Energy:
    "J" ["N m"], 1.0, SI;
    "kJ" ["kN m"], 1000.0, SI;
    "MJ" [], 1e6, SI;
    "ft lb" ["lb ft"], POUND_FORCE * FOOT, US;
}
rows! { STIFFNESS_A, StiffnessA:
    "N/cm" [], 100.0, SI;
    "N/m" [], 1.0, SI;
    "N/mm" [], 1000.0, SI;
    "kN/m" [], 1000.0, SI;
    "kN/cm" [], 1e5, SI;
    "kN/mm" [], 1e6, SI;
    "lb/in" [], POUND_FORCE / INCH, US;
    "lb/ft" [], POUND_FORCE / FOOT, US;
}
rows! { STIFFNESS_B, StiffnessB:
    "N/cm^2" [], 1e4, SI;
    "N/m^2" ["Pa"], 1.0, SI;
    "kN/m^2" ["kPa"], 1e3, SI;
    "MN/m^2" ["MPa", "N/mm^2"], 1e6, SI;
    "kN/cm^2" [], 1e7, SI;
    "lb/in^2" ["psi"], POUND_FORCE / (INCH * INCH), US;
    "lb/ft^2" ["psf"], POUND_FORCE / (FOOT * FOOT), US;
}
rows! { STIFFNESS_G, StiffnessG:
    "N" [], 1.0, SI;
    "kN" [], 1000.0, SI;
    "lb" ["lbf"], POUND_FORCE, US;
}
rows! { ROOT_FORCE, RootForce:
    "lb^0.5" [], ROOT_POUND_FORCE, US;
    "N^0.5" [], 1.0, SI;
}
rows! { ROOT_FORCE_PER_LENGTH, RootForcePerLength:
    "lb^0.5/ft" [], ROOT_POUND_FORCE / FOOT, US;
    "lb^0.5/in" [], ROOT_POUND_FORCE / INCH, US;
    "N^0.5/m" [], 1.0, SI;
    "N^0.5/cm" [], 100.0, SI;
}

pub(super) fn units(dimension: Dimension) -> &'static [Unit] {
    match dimension {
        Dimension::Length => LENGTH,
        Dimension::Mass => MASS,
        Dimension::Weight => WEIGHT,
        Dimension::Speed => SPEED,
        Dimension::Angle => ANGLE,
        Dimension::YawRate => YAW_RATE,
        Dimension::Time => TIME,
        Dimension::Acceleration => ACCELERATION,
        Dimension::Inertia => INERTIA,
        Dimension::Energy => ENERGY,
        Dimension::StiffnessA => STIFFNESS_A,
        Dimension::StiffnessB => STIFFNESS_B,
        Dimension::StiffnessG => STIFFNESS_G,
        Dimension::RootForce => ROOT_FORCE,
        Dimension::RootForcePerLength => ROOT_FORCE_PER_LENGTH,
    }
}
