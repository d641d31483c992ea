//! From SI units to those of the reader.

use std::f64::consts::PI;

pub(crate) use ::drawing::{number, significant};
use case::{Case, Dimension, UnitSystem};
use recorder::Channel;

/// The units of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// m/s, km/h, N, J, kg, m.
    Si,
    /// mph, ft/s, lb, ft-lb, in.
    Us,
    /// As SI, but speeds of vehicles are in mph and, in CSV, angles in degrees.
    Uk,
}

/// A unit to print in: its name, its size in SI units, and how many decimals make sense.
#[derive(Clone, Copy)]
struct Display {
    name: &'static str,
    size: f64,
    decimals: usize,
}

const fn unit(name: &'static str, size: f64, decimals: usize) -> Display {
    Display { name, size, decimals }
}

pub(crate) const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
const POUND: f64 = 0.453_592_37;
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// 1 lbf·s²/ft
const SLUG: f64 = POUND_FORCE / FOOT;
const MILE_PER_HOUR: f64 = 0.447_04;
const DEGREE: f64 = PI / 180.0;

/// Whether more of a case's speeds, and of the columns of speeds in its recorders, are in miles per hour than
/// in km/h. A speed in m/s, such as that of a pedestrian, says nothing about the roads.
fn are_speeds_in_mph(case: &Case) -> bool {
    let inputs = case.inputs();
    let units = inputs.iter().filter_map(|input| input.unit);
    let of_numbers =
        units.filter(|unit| unit.dimension() == Dimension::Speed).map(|unit| unit.spelling()).collect();
    let speeds = [of_numbers, recorded_speeds(case)].concat();
    let count = |name: &str| speeds.iter().filter(|spelling| **spelling == name).count();
    count("mph") > count("km/h")
}

/// The units of the columns of speeds and of ΔV in the recorders of a case.
fn recorded_speeds(case: &Case) -> Vec<&str> {
    let recorders = case.vehicles.iter().filter_map(|vehicle| vehicle.recorder.as_ref());
    let records = recorders.flat_map(|recorder| {
        std::iter::once(recorder).chain(recorder.records.iter().map(|record| &record.stored))
    });
    let tables = records.flat_map(|record| {
        let before = record.pre_crash.iter().flat_map(|given| &given.tables);
        before.chain(record.pulse.iter().flat_map(|given| &given.tables))
    });
    let of_speed = [Channel::Speed, Channel::DeltaVLongitudinal, Channel::DeltaVLateral];
    let columns = tables.flat_map(|table| &table.columns);
    columns.filter(|column| of_speed.contains(&column.channel)).map(|column| column.unit.name).collect()
}

/// A quantity that can be printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Without unit
    Ratio,
    /// m/s
    Speed,
    /// m/s, as drivers know it: in km/h or mph
    RoadSpeed,
    /// m
    Length,
    /// m, of depths and widths of damage
    Crush,
    /// kg
    Mass,
    /// kg·m²
    YawInertia,
    /// rad
    Angle,
    /// rad/s
    YawRate,
    /// rad/s, in °/s without decimals: no finer than the second decimal of rad/s
    YawRateDegrees,
    /// J
    Energy,
    /// N·s
    Impulse,
    /// N·m·s
    MomentImpulse,
    /// kg·m/s
    Momentum,
    /// N
    Force,
    /// s
    Time,
    /// m, along a path before the impact, as it is measured on a road
    Way,
    /// m/s²
    Acceleration,
    /// N/m
    StiffnessA,
    /// N/m²
    StiffnessB,
    /// N
    StiffnessG,
}

/// A share in per cent, without the sign: two significant digits, and all of those before the point.
pub(crate) fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value.abs() < 99.5 { significant(value, 2) } else { number(value, 0) }
}

/// A count with commas.
#[expect(clippy::cast_precision_loss, reason = "counts are below 2^53")]
pub(crate) fn grouped(count: usize) -> String {
    number(count as f64, 0)
}

impl Units {
    /// Each under its word.
    pub const WORDS: [(&str, Self); 3] = [("si", Self::Si), ("us", Self::Us), ("uk", Self::Uk)];

    /// Those that most of the case is written in.
    #[must_use]
    pub fn of_case(case: &Case) -> Self {
        match case.unit_system() {
            UnitSystem::Us => Self::Us,
            UnitSystem::Si if are_speeds_in_mph(case) => Self::Uk,
            UnitSystem::Si => Self::Si,
        }
    }

    fn display(self, quantity: Measure) -> Display {
        let same = |unit: Display| [unit; 2];
        let [si, us] = match quantity {
            Measure::Ratio => same(unit("", 1.0, 4)),
            Measure::Speed => [unit("m/s", 1.0, 2), unit("ft/s", FOOT, 2)],
            Measure::RoadSpeed if self == Self::Uk => same(unit("mph", MILE_PER_HOUR, 2)),
            Measure::RoadSpeed => [unit("km/h", 1.0 / 3.6, 1), unit("mph", MILE_PER_HOUR, 2)],
            Measure::Length => [unit("m", 1.0, 3), unit("ft", FOOT, 2)],
            Measure::Crush => [unit("cm", 0.01, 1), unit("in", INCH, 1)],
            Measure::Mass => [unit("kg", 1.0, 1), unit("lb", POUND, 0)],
            Measure::YawInertia => [unit("kg·m²", 1.0, 0), unit("lb·ft·s²", POUND_FORCE * FOOT, 0)],
            Measure::Angle => same(unit("°", DEGREE, 1)),
            Measure::YawRate => same(unit("rad/s", 1.0, 2)),
            Measure::YawRateDegrees => same(unit("°/s", DEGREE, 0)),
            Measure::Energy => [unit("J", 1.0, 0), unit("ft·lb", FOOT * POUND_FORCE, 0)],
            Measure::Impulse => [unit("N·s", 1.0, 0), unit("lb·s", POUND_FORCE, 0)],
            Measure::MomentImpulse => [unit("N·m·s", 1.0, 0), unit("ft·lb·s", FOOT * POUND_FORCE, 0)],
            // Weight times speed, as momentum is drawn where weights are in pounds.
            Measure::Momentum => [unit("kg·m/s", 1.0, 0), unit("lb·mph", POUND * MILE_PER_HOUR, 0)],
            Measure::Force => [unit("kN", 1000.0, 1), unit("lb", POUND_FORCE, 0)],
            Measure::Time => same(unit("s", 1.0, 2)),
            Measure::Way => [unit("m", 1.0, 2), unit("ft", FOOT, 1)],
            Measure::Acceleration => [unit("m/s²", 1.0, 2), unit("ft/s²", FOOT, 1)],
            Measure::StiffnessA => [unit("N/cm", 100.0, 1), unit("lb/in", POUND_FORCE / INCH, 1)],
            Measure::StiffnessB => {
                [unit("N/cm²", 10_000.0, 2), unit("lb/in²", POUND_FORCE / (INCH * INCH), 2)]
            }
            Measure::StiffnessG => [unit("N", 1.0, 0), unit("lb", POUND_FORCE, 1)],
        };
        if self == Self::Us { us } else { si }
    }

    /// An SI value with its unit, like `75.03 ft/s`.
    #[must_use]
    pub fn format(self, quantity: Measure, si: f64) -> String {
        let Display { name, size, decimals } = self.display(quantity);
        let space = if name.is_empty() || name == "°" { "" } else { " " };
        format!("{}{space}{name}", number(si / size, decimals))
    }

    /// The unit's size in SI units.
    pub(crate) fn size(self, quantity: Measure) -> f64 {
        self.display(quantity).size
    }

    /// An SI value in the unit.
    pub(crate) fn value(self, quantity: Measure, si: f64) -> f64 {
        si / self.display(quantity).size
    }

    /// The unit's name.
    pub(crate) fn name(self, quantity: Measure) -> &'static str {
        self.display(quantity).name
    }

    /// Decimals that make sense.
    pub(crate) fn decimals(self, quantity: Measure) -> usize {
        self.display(quantity).decimals
    }

    /// The coherent unit that the steps use in place of an SI unit of the equations: its size (SI) and its
    /// name. In US units these are the foot, the pound-force, the second and the slug.
    pub(crate) fn coherent(self, unit: &str) -> (f64, &str) {
        if self != Self::Us {
            return (1.0, unit);
        }
        match unit {
            "m" => (FOOT, "ft"),
            "m²" => (FOOT * FOOT, "ft²"),
            "m³" => (FOOT * FOOT * FOOT, "ft³"),
            "m/s" => (FOOT, "ft/s"),
            "m/s²" => (FOOT, "ft/s²"),
            "kg" => (SLUG, "slug"),
            "1/kg" => (1.0 / SLUG, "1/slug"),
            "1/kg²" => (1.0 / (SLUG * SLUG), "1/slug²"),
            "1/(kg·m)" => (1.0 / (SLUG * FOOT), "1/(slug·ft)"),
            "kg·m²" => (POUND_FORCE * FOOT, "lb·ft·s²"),
            "N" => (POUND_FORCE, "lb"),
            "N/m" => (POUND_FORCE / FOOT, "lb/ft"),
            "N/m²" => (POUND_FORCE / (FOOT * FOOT), "lb/ft²"),
            "√N" => (POUND_FORCE.sqrt(), "√lb"),
            "√N/m" => (POUND_FORCE.sqrt() / FOOT, "√lb/ft"),
            "N·s" => (POUND_FORCE, "lb·s"),
            "N·m·s" => (POUND_FORCE * FOOT, "ft·lb·s"),
            "J" => (POUND_FORCE * FOOT, "ft·lb"),
            // The same in both systems.
            _ => (1.0, unit),
        }
    }

    /// An SI value without its unit, for the columns of a table.
    pub(crate) fn plain(self, quantity: Measure, si: f64) -> String {
        let Display { size, decimals, .. } = self.display(quantity);
        number(si / size, decimals)
    }

    /// A difference, with its sign and without its unit.
    pub(crate) fn signed(self, quantity: Measure, si: f64) -> String {
        let plain = self.plain(quantity, si);
        if plain.starts_with('-') { plain } else { format!("+{plain}") }
    }

    /// SI values with one unit behind them all, like `21.3 20.3 13.8 in`.
    #[must_use]
    pub fn format_all(self, quantity: Measure, si: &[f64]) -> String {
        let Display { name, size, decimals } = self.display(quantity);
        let numbers: Vec<String> = si.iter().map(|value| number(value / size, decimals)).collect();
        format!("{} {name}", numbers.join(" "))
    }

    /// A vector in the scene, like `(-75.03, 0.00) ft/s`.
    #[must_use]
    pub fn format_vector(self, quantity: Measure, [x, y]: [f64; 2]) -> String {
        let Display { name, size, decimals } = self.display(quantity);
        let vector = format!("({}, {})", number(x / size, decimals), number(y / size, decimals));
        if name.is_empty() { vector } else { format!("{vector} {name}") }
    }

    /// A yaw rate as the equations use it and as people read it, like `-3.98 rad/s = -228 °/s`.
    pub(crate) fn yaw_rate(self, si: f64) -> String {
        format!("{} = {}", self.format(Measure::YawRate, si), self.format(Measure::YawRateDegrees, si))
    }

    /// A speed as drivers know it and as the equations use it, like `51.16 mph (75.03 ft/s)`.
    pub(crate) fn speed(self, si: f64) -> String {
        format!("{} ({})", self.road_speed(si), self.format(Measure::Speed, si))
    }

    /// A speed along a heading: as [`speed`](Self::speed), and in words where its sign says that the vehicle
    /// moved against its heading, like `-2.7 km/h (-0.74 m/s), backwards`.
    pub(crate) fn speed_along(self, si: f64) -> String {
        format!("{}{}", self.speed(si), if self.is_backwards(si) { ", backwards" } else { "" })
    }

    /// The same for readers who may not know what a sign means, like `2.7 km/h backwards`.
    pub(crate) fn speed_in_words(self, si: f64) -> String {
        format!("{}{}", self.road_speed(si.abs()), if self.is_backwards(si) { " backwards" } else { "" })
    }

    /// Whether a speed (m/s) is below zero as printed.
    fn is_backwards(self, si: f64) -> bool {
        let printed = [Measure::RoadSpeed, Measure::Speed].map(|measure| self.plain(measure, si));
        printed.iter().any(|text| text.starts_with('-'))
    }

    /// A speed as drivers know it, like `51.16 mph`.
    #[must_use]
    pub fn road_speed(self, si: f64) -> String {
        self.format(Measure::RoadSpeed, si)
    }
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn a_share_of_all_has_no_power_of_ten() {
        assert_eq!([0.004_56, 0.5, 0.998, 1.0, 1.68].map(percent), ["0.46", "50", "100", "100", "168"]);
    }
}
