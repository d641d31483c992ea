//! The quantities of a recorder's table, their headings, and their units.

/// A quantity that a recorder stores over time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Channel {
    /// (s) time, 0 at the impact or at the event that triggered the record.
    Time,
    /// (m/s) indicated speed.
    Speed,
    /// (%) accelerator pedal.
    Accelerator,
    /// (%) engine throttle.
    Throttle,
    /// (rev/min) engine speed.
    EngineSpeed,
    /// (1 on, 0 off) service brake.
    Brake,
    /// (1 active, 0 not) antilock braking.
    Abs,
    /// (1 active, 0 not) stability control.
    Stability,
    /// (rad) steering wheel.
    Steering,
    /// (rad/s) yaw rate.
    YawRate,
    /// (m/s) ΔV along the vehicle since t = 0.
    DeltaVLongitudinal,
    /// (m/s) ΔV across the vehicle since t = 0.
    DeltaVLateral,
    /// (m/s²) acceleration along the vehicle.
    AccelerationLongitudinal,
    /// (m/s²) acceleration across the vehicle.
    AccelerationLateral,
    /// Any other quantity: a column that is recognised but not read.
    Other,
}

/// The dimension of a channel, which determines the units that it may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dimension {
    Time,
    Speed,
    Percent,
    Revolutions,
    Switch,
    Angle,
    AngularRate,
    Acceleration,
    Voltage,
    None,
}

/// A unit of a heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelUnit {
    /// Its name in reports.
    pub name: &'static str,
    dimension: Dimension,
    /// (SI per unit) its size.
    pub factor: f64,
}

const KMH: f64 = 1.0 / 3.6;
/// (m/s) 1 mile per hour, by definition.
pub(crate) const MPH: f64 = 0.44704;
/// (m/s²) g, by definition.
pub(crate) const GRAVITY: f64 = 9.80665;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

const fn unit(name: &'static str, dimension: Dimension, factor: f64) -> ChannelUnit {
    ChannelUnit { name, dimension, factor }
}

/// Spellings of units, in lower case and without brackets.
const UNITS: &[(&[&str], ChannelUnit)] = &[
    (&["s", "sec", "secs", "second", "seconds", "sek"], unit("s", Dimension::Time, 1.0)),
    (&["ms", "msec", "msecs", "millisecond", "milliseconds"], unit("ms", Dimension::Time, 1e-3)),
    (&["km/h", "kmh", "kph", "km/hr", "kmph"], unit("km/h", Dimension::Speed, KMH)),
    (&["mph", "mi/h"], unit("mph", Dimension::Speed, MPH)),
    (&["m/s"], unit("m/s", Dimension::Speed, 1.0)),
    (&["ft/s", "fps"], unit("ft/s", Dimension::Speed, 0.3048)),
    (&["%", "pct", "percent"], unit("%", Dimension::Percent, 1.0)),
    (&["rpm", "1/min", "r/min", "u/min", "rev/min"], unit("rpm", Dimension::Revolutions, 1.0)),
    (&["deg", "degree", "degrees", "°", "grad"], unit("deg", Dimension::Angle, DEGREE)),
    (&["rad"], unit("rad", Dimension::Angle, 1.0)),
    (
        &["deg/s", "deg/sec", "degrees/s", "degrees/sec", "degree/sec", "°/s", "°/sec"],
        unit("deg/s", Dimension::AngularRate, DEGREE),
    ),
    (&["rad/s"], unit("rad/s", Dimension::AngularRate, 1.0)),
    (&["g", "g's", "gs"], unit("g", Dimension::Acceleration, GRAVITY)),
    (&["v", "volt", "volts"], unit("V", Dimension::Voltage, 1.0)),
    (&["m/s²", "m/s2", "m/s^2", "m/sec²", "m/sec^2"], unit("m/s²", Dimension::Acceleration, 1.0)),
];

const SWITCH: ChannelUnit = unit("on/off", Dimension::Switch, 1.0);
const RPM: ChannelUnit = unit("rpm", Dimension::Revolutions, 1.0);
const PERCENT: ChannelUnit = unit("%", Dimension::Percent, 1.0);
const NONE: ChannelUnit = unit("", Dimension::None, 1.0);

/// Headings in lower case, word by word, hyphens and underscores as spaces, with commas between
/// them. The longest that fits is taken.
const HEADINGS: &[(Channel, &str)] = &[
    (
        Channel::Time,
        "times, time, ptime, time stamp, timestamp, time before impact, time to impact, time before crash, \
         time relative to impact, time from impact, sample time, pre crash time, seconds before ae, \
         seconds before algorithm enable, seconds before impact, seconds before crash, seconds before event, \
         seconds to impact, zeit, zeitpunkt, temps, tiempo",
    ),
    (
        Channel::Speed,
        "speed vehicle indicated, vehicle indicated speed, indicated vehicle speed, vehicle speed, \
         speed vehicle, pre crash speed, pre crash vehicle speed, velocity vehicle indicated, \
         vehicle velocity, indicated speed, vehicle speed indicated, vehicle speed sensor, road speed, \
         ground speed, vehicle ground speed, speed over ground, speedometer, fahrzeuggeschwindigkeit, \
         vitesse, vitesse du véhicule, velocidad, velocity, speed, geschwindigkeit, fahrgeschwindigkeit",
    ),
    (
        Channel::Accelerator,
        "accelerator pedal position, accelerator pedal, accel pedal, accelerator rate, \
         accelerator opening, accelerator opening ratio, accelerator pedal per cent full, throttle pedal, \
         app, fahrpedal, fahrpedalstellung, accelerator, pedal, gaspedal",
    ),
    (
        Channel::Throttle,
        "engine throttle, throttle position, throttle opening, throttle valve, throttle angle, throttle, \
         drosselklappe",
    ),
    (
        Channel::EngineSpeed,
        "engine rpm, engine speed, engine speed rpm, engine speed combustion, engine revolutions, rpm, \
         drehzahl, motordrehzahl",
    ),
    (
        Channel::Brake,
        "service brake, brake switch circuit status, brake switch circuit state, brake switch circuit, \
         brake switch, brake status, service brake status, service brake activation, service brake switch, \
         service brakes, brake pedal, brake pedal switch, brake pedal status, brake activation, brakes, \
         bremspedal, frein de service, freno de servicio, brake, braking, betriebsbremse, bremse",
    ),
    (
        Channel::Abs,
        "abs activity, abs active, abs status, abs activation, antilock brake system, \
         antilock braking system, antilock brakes, anti lock brake system, anti lock brakes, \
         anti lock braking system, anti lock brake system activity, anti lock braking system activity, abs",
    ),
    (
        Channel::Stability,
        "stability control, stability control status, electronic stability control, \
         electronic stability control status, stability control system, stability, \
         vehicle stability control, dynamic stability control, vdc, dsc, esc, esp, vsc",
    ),
    (
        Channel::Steering,
        "steering wheel angle, steering input, steering angle, steering wheel, steering wheel position, \
         steering wheel input, steering angle sensor, steering, volant, steer, lenkwinkel, lenkradwinkel",
    ),
    (
        Channel::YawRate,
        "yaw rate, yaw velocity, vehicle yaw rate, yaw angular velocity, gierrate, \
         gierwinkelgeschwindigkeit",
    ),
    (
        Channel::DeltaVLongitudinal,
        "delta v longitudinal, longitudinal delta v, deltav longitudinal, longitudinal deltav, \
         longitudinal cumulative delta v, cumulative longitudinal delta v, delta v long, long delta v, \
         dv longitudinal, dv long, δv longitudinal, longitudinal δv, longitudinal velocity change, \
         longitudinal change in velocity, change in velocity longitudinal, cumulative delta v longitudinal, \
         longitudinal crash pulse delta v, delta v x, delta vx, sdm adjusted velocity change, \
         sdm recorded velocity change, adjusted velocity change, recorded velocity change, velocity change, \
         delta v",
    ),
    (
        Channel::DeltaVLateral,
        "delta v lateral, lateral delta v, deltav lateral, lateral deltav, lateral cumulative delta v, \
         cumulative lateral delta v, delta v lat, lat delta v, dv lateral, dv lat, δv lateral, lateral δv, \
         lateral velocity change, lateral change in velocity, change in velocity lateral, \
         cumulative delta v lateral, delta v y, delta vy",
    ),
    (
        Channel::AccelerationLongitudinal,
        "longitudinal acceleration, acceleration longitudinal, longitudinal accel, long acceleration, \
         long accel",
    ),
    (
        Channel::AccelerationLateral,
        "lateral acceleration, acceleration lateral, lateral accel, lat acceleration, lat accel",
    ),
    (
        Channel::Other,
        "parking brake, brake pressure, brake oil pressure, master cylinder pressure, cruise control, \
         cruise control status, cruise control set speed, cruise control target speed, cruise set speed, \
         speed control, traction control, traction control via brakes, traction control via engine, \
         wheel speed, wheel speeds, wheel speed sensor, target speed, \
         set speed, speed limit, speed limiter, time maximum delta v, time maximum delta v longitudinal, \
         time maximum delta v lateral, time to maximum delta v, vertical acceleration, ignition cycle, \
         pitch rate, lane departure warning, lane keeping, automatic emergency braking, \
         advanced emergency braking, autonomous emergency braking, adaptive cruise control, brake assist, \
         brake torque, engine torque, motor torque, steering torque, steering wheel torque, turn signal, \
         occupant protection, air bag warning lamp, airbag warning lamp, driver belt, \
         pre crash recorder status, lateral velocity, longitudinal velocity, shift position, gear position, \
         gear, roll angle, vehicle roll angle, roll rate, maximum delta v longitudinal, \
         maximum delta v lateral, maximum delta v, resultant delta v, vertical delta v, delta v vertical, \
         engine brake, normal acceleration, motor rpm, motor speed, brake lamp, tire pressure, \
         tyre pressure, sequential shift range, drive mode, seat belt, safety belt, collision avoidance",
    ),
];

impl Channel {
    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// Its name in a report.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The column's key in JSON, CSV and the case file.
    #[must_use]
    pub fn key(self) -> &'static str {
        self.row().key
    }

    fn dimension(self) -> Dimension {
        self.row().dimension
    }

    /// Whether its values are on and off.
    #[must_use]
    pub fn is_switch(self) -> bool {
        self.dimension() == Dimension::Switch
    }

    /// The unit that needs no mention in a heading.
    pub(crate) fn own_unit(self) -> Option<ChannelUnit> {
        match self.dimension() {
            Dimension::Switch => Some(SWITCH),
            Dimension::Revolutions => Some(RPM),
            Dimension::Percent => Some(PERCENT),
            Dimension::None => Some(NONE),
            _ => None,
        }
    }

    /// The units that a heading may give it, for messages.
    #[must_use]
    pub fn units(self) -> Vec<&'static str> {
        let dimension = self.dimension();
        UNITS.iter().filter(|(_, unit)| unit.dimension == dimension).map(|(_, unit)| unit.name).collect()
    }

    /// Whether these units show that something else was stored: the voltage of a sensor, or a share of the
    /// largest angle.
    pub(crate) fn is_in_other_units(self, units: &[ChannelUnit]) -> bool {
        !units.is_empty() && !units.iter().any(|unit| self.takes(unit))
    }

    /// Whether this is a unit of the quantity.
    pub(crate) fn takes(self, unit: &ChannelUnit) -> bool {
        self.dimension() == unit.dimension
    }

    /// (SI) the smallest and the largest value that a recorder stores of it. A number outside counts as no
    /// value.
    pub(crate) fn range(self) -> [f64; 2] {
        self.row().range
    }

    /// The stored numbers that mean "no value", and the size of their unit (SI).
    pub(crate) fn codes(self) -> (&'static [f64], f64) {
        self.row().codes
    }
}

/// The data of a channel.
struct Row {
    channel: Channel,
    name: &'static str,
    key: &'static str,
    dimension: Dimension,
    range: [f64; 2],
    codes: (&'static [f64], f64),
}

const fn row(
    channel: Channel,
    [name, key]: [&'static str; 2],
    dimension: Dimension,
    range: [f64; 2],
    codes: (&'static [f64], f64),
) -> Row {
    Row { channel, name, key, dimension, range, codes }
}

// 254 and 255 where a byte has no sign, 126, 127 and −128 where it has one (49 CFR 563 and UN R160 store 1
// km/h in a byte).
const BYTE: &[f64] = &[254.0, 255.0];
const SIGNED_BYTE: &[f64] = &[126.0, 127.0, -128.0];
const ANY_BYTE: &[f64] = &[126.0, 127.0, 254.0, 255.0, -128.0];
const NO_CODES: (&[f64], f64) = (&[], 1.0);

const PEDAL: [f64; 2] = [0.0, 100.0];
const ON_OFF: [f64; 2] = [0.0, 1.0];
const WHEEL: [f64; 2] = [-1500.0 * DEGREE, 1500.0 * DEGREE];
const YAW_RATE: [f64; 2] = [-400.0 * DEGREE, 400.0 * DEGREE];
const DELTA_V: [f64; 2] = [-250.0 * KMH, 250.0 * KMH];
const ACCELERATION: [f64; 2] = [-500.0 * GRAVITY, 500.0 * GRAVITY];
const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// The channels in the order of [`Channel`].
const ROWS: [Row; 15] = {
    use Channel as C;
    use Dimension as D;
    [
        row(C::Time, ["time", "time"], D::Time, [-60.0, 60.0], NO_CODES),
        row(C::Speed, ["speed", "speed"], D::Speed, [0.0, 400.0 * KMH], (BYTE, KMH)),
        row(C::Accelerator, ["accelerator pedal", "accelerator"], D::Percent, PEDAL, (ANY_BYTE, 1.0)),
        row(C::Throttle, ["engine throttle", "throttle"], D::Percent, PEDAL, (ANY_BYTE, 1.0)),
        row(C::EngineSpeed, ["engine speed", "engine_speed"], D::Revolutions, [0.0, 16_000.0], (BYTE, 64.0)),
        row(C::Brake, ["service brake", "brake"], D::Switch, ON_OFF, (ANY_BYTE, 1.0)),
        row(C::Abs, ["ABS", "abs"], D::Switch, ON_OFF, (ANY_BYTE, 1.0)),
        row(C::Stability, ["stability control", "stability"], D::Switch, ON_OFF, (ANY_BYTE, 1.0)),
        row(C::Steering, ["steering wheel", "steering"], D::Angle, WHEEL, NO_CODES),
        row(C::YawRate, ["yaw rate", "yaw_rate"], D::AngularRate, YAW_RATE, NO_CODES),
        row(
            C::DeltaVLongitudinal,
            ["longitudinal ΔV", "delta_v_longitudinal"],
            D::Speed,
            DELTA_V,
            (SIGNED_BYTE, KMH),
        ),
        row(C::DeltaVLateral, ["lateral ΔV", "delta_v_lateral"], D::Speed, DELTA_V, (SIGNED_BYTE, KMH)),
        row(
            C::AccelerationLongitudinal,
            ["longitudinal acceleration", "acceleration_longitudinal"],
            D::Acceleration,
            ACCELERATION,
            NO_CODES,
        ),
        row(
            C::AccelerationLateral,
            ["lateral acceleration", "acceleration_lateral"],
            D::Acceleration,
            ACCELERATION,
            NO_CODES,
        ),
        row(C::Other, ["not read", "other"], D::None, ANY, NO_CODES),
    ]
};

// Each row is at the position of its channel.
const _: () = {
    let mut at = 0;
    while at < ROWS.len() {
        assert!(ROWS[at].channel as usize == at);
        at += 1;
    }
};

/// The words of a heading for comparison: lower case, hyphens, underscores and punctuation as spaces.
pub(crate) fn plain(word: &str) -> String {
    let dashes = ['-', '_', '‑', '–', ',', ';', ':', '"', '.', '*'];
    word.to_lowercase().replace('∆', "δ").replace(dashes, " ")
}

/// The channel whose heading begins at the first of these words, and the number of words it takes.
pub(crate) fn heading_at(words: &[&str]) -> Option<(Channel, usize)> {
    let mut best: Option<(Channel, usize)> = None;
    for (channel, headings) in HEADINGS {
        for heading in headings.split(", ") {
            let count = heading.split(' ').count();
            let fits = heading.split(' ').zip(words).filter(|(own, word)| own == *word).count() == count;
            if fits && words.len() >= count && best.is_none_or(|(_, longest)| count > longest) {
                best = Some((*channel, count));
            }
        }
    }
    best
}

/// The axis that a word next to a ΔV names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axis {
    Along,
    Across,
    /// The vertical axis, or all axes together.
    Other,
}

impl Axis {
    /// The first that these words name, in lower case.
    pub(crate) fn of<'w>(mut words: impl Iterator<Item = &'w str>) -> Option<Self> {
        words.find_map(|word| match word.trim_matches(['(', ')', '[', ']']) {
            "longitudinal" | "long" | "x" | "vx" => Some(Self::Along),
            "lateral" | "lat" | "y" | "vy" => Some(Self::Across),
            "vertical" | "z" | "vz" | "resultant" | "total" => Some(Self::Other),
            _ => None,
        })
    }
}

/// Words next to the name of a quantity that show that the column is not this quantity of the vehicle over
/// time.
const DENYING: &str = "relative, closing, lead, other, trailer, wheel, fan, turbine, output, maximum, max, \
    minimum, min, average, set, cruise, target, desired, limit, limiter, error, warning, lamp, indicator, \
    fluid, level, wear, fault, failure, retarder, emergency, parking, pressure, torque, temperature, \
    assist, counter";

/// Whether this word next to the name of a quantity shows that the heading is of something else.
pub(crate) fn denies(word: &str) -> bool {
    is_one_of(DENYING, word)
}

/// Whether a word is one of these, which have commas between them.
pub(crate) fn is_one_of(words: &str, word: &str) -> bool {
    words.split(", ").any(|one| one == word)
}

/// The unit that a word of a heading names.
pub(crate) fn unit_of(word: &str) -> Option<ChannelUnit> {
    let bare = word.trim_matches(|c: char| "()[],;:\"".contains(c)).to_lowercase();
    UNITS.iter().find(|(spellings, _)| spellings.contains(&bare.as_str())).map(|(_, unit)| *unit)
}
