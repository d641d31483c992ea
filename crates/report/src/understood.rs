//! A case as the program understood it, in words: ranges, units, choices, and the assumptions for values that
//! the file does not give.

use analysis::{Assumption, AxleMeasure};
use case::{
    Case, Dimension, GivenValue, Input, Origin, Range, Recorder, SUBJECTS, SWELLS, Spread, TypicalStiffness,
    Unit, UnitSystem, list_of, word,
};
use pim_core::VehicleId;
use recorder::{Channel, RecorderTable};

use crate::units::{Measure, Units, number};
use crate::words;

pub(crate) fn spread(range: &Range) -> String {
    match range.spread {
        Spread::Normal { sd } => format!("sd {sd}"),
        Spread::Uniform { low, high } => format!("{low} to {high}"),
        Spread::Triangular { low, high } => format!("most likely of {low} to {high}"),
        Spread::Within { percent, confidence } => {
            format!("within {percent} % ({confidence})")
        }
    }
}

pub(crate) fn amount(number: f64, unit: Option<&'static Unit>) -> String {
    unit.map_or_else(|| number.to_string(), |unit| format!("{number} {unit}"))
}

/// The customary unit of a quantity in a system; depths and widths of damage have a smaller unit than other
/// lengths.
fn usual(dimension: Dimension, in_crush: bool, system: UnitSystem) -> &'static str {
    let (si, us) = match dimension {
        Dimension::Length if in_crush => ("cm", "in"),
        Dimension::Length => ("m", "ft"),
        Dimension::Mass => ("kg", "lb"),
        Dimension::Weight | Dimension::StiffnessG => ("N", "lb"),
        Dimension::Speed => ("m/s", "mph"),
        Dimension::Angle => ("rad", "deg"),
        Dimension::YawRate => ("rad/s", "deg/s"),
        Dimension::Inertia => ("kg m^2", "lb ft s^2"),
        Dimension::Energy => ("J", "ft lb"),
        Dimension::StiffnessA => ("N/cm", "lb/in"),
        Dimension::StiffnessB => ("N/cm^2", "lb/in^2"),
        Dimension::Time => ("s", "s"),
        Dimension::Acceleration => ("m/s^2", "ft/s^2"),
        Dimension::RootForce => ("N^0.5", "lb^0.5"),
        Dimension::RootForcePerLength => ("N^0.5/cm", "lb^0.5/in"),
    };
    match system {
        UnitSystem::Si => si,
        UnitSystem::Us => us,
    }
}

pub(crate) fn converted(input: &Input, system: UnitSystem) -> (f64, Option<&'static Unit>) {
    let unit = input.unit.and_then(|unit| {
        let in_crush = input.path.contains(".crush.") && !input.path.ends_with(".moment_arm");
        unit.dimension().unit(usual(unit.dimension(), in_crush, system))
    });
    match unit {
        // As written, without the rounding of two conversions.
        Some(unit) if input.unit == Some(unit) => (input.number, Some(unit)),
        Some(unit) => (input.si() / unit.factor(), Some(unit)),
        None => (input.number, None),
    }
}

/// Six digits are more than any input has, and trailing zeros are meaningless.
pub(crate) fn shown((value, unit): (f64, Option<&'static Unit>)) -> String {
    // Via the text with six digits: the shortest decimal that reads back the same has no trailing zeros and
    // no exponent.
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    let digits = if rounded == 0.0 { "0".to_owned() } else { rounded.to_string() };
    unit.map_or_else(|| digits.clone(), |unit| format!("{digits} {unit}"))
}

/// Every number that the file gives, even those that cannot vary.
pub(crate) fn numbers(case: &Case) -> Vec<Input> {
    let values = case.values().into_iter().filter_map(|(path, value)| match value {
        GivenValue::Number { number, unit } => Some(Input { path, number, unit, origin: Origin::Given }),
        _ => None,
    });
    values.collect()
}

/// The words, whole numbers and percentages of the file, key by key.
pub(crate) fn choices(case: &Case) -> Vec<(String, String)> {
    let mut choices: Vec<(String, String)> = Vec::new();
    for (path, value) in case.values() {
        if is_of_head(&path) {
            continue;
        }
        let said = match value {
            GivenValue::Number { .. } => continue,
            GivenValue::Text(text) => case::shown(&text).into_owned(),
            GivenValue::Flag => "true".to_owned(),
            GivenValue::Count(count) => count.to_string(),
            GivenValue::Hour(hour) => clock(hour),
        };
        // The elements of a list of keys share a row.
        let list = list_of(&path)
            .filter(|list| list.ends_with(".exact") || list.ends_with(".of") || list.ends_with(".find"));
        match (list, choices.last_mut()) {
            (Some(list), Some((last, row))) if last == list => row.push_str(&format!(", {said}")),
            (Some(list), _) if path.ends_with("[1]") => choices.push((list.to_owned(), said)),
            _ => choices.push((path, said)),
        }
    }
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&case.vehicles) {
        let Some(recorder) = &vehicle.recorder else { continue };
        choices.extend(tables(recorder, &format!("vehicle{id}.recorder")));
        for (k, one) in (1..).zip(&recorder.records) {
            choices.extend(tables(&one.stored, &format!("vehicle{id}.recorder.records[{k}]")));
        }
    }
    if let Some(avoid) = &case.avoid {
        let mut default = |key: &str, word: &str| {
            let key = format!("avoid.{key}");
            if !choices.iter().any(|(given, _)| *given == key) {
                choices.push((key, word.to_owned()));
            }
        };
        default("vehicle", word(&SUBJECTS, &case.avoid_subject()));
        default("swell_form", word(&SWELLS, &avoid.swell_form.unwrap_or_default()));
    }
    choices
}

/// Whether a text is shown elsewhere: at the head of a report, next to the number that it is about, or with
/// what was recognised in a table.
fn is_of_head(path: &str) -> bool {
    let key = path.rsplit('.').next().unwrap_or_default();
    let is_table = |word: &str| key == word || path.contains(&format!(".{word}."));
    path == "title"
        || path.starts_with("report.")
        || key == "source"
        || key == "reason"
        || is_table("pre_crash")
        || is_table("pulse")
}

/// The hour of a PDOF, and what it means.
fn clock(hour: u8) -> String {
    format!("{hour} o'clock = {}°", clock_degrees(hour))
}

/// (°) clockwise, in (−180°, 180°].
fn clock_degrees(hour: u8) -> i32 {
    match i32::from(hour % 12) * 30 {
        degrees @ 0..=180 => degrees,
        degrees => degrees - 360,
    }
}

/// The assumption in words.
pub(crate) fn message(assumption: &Assumption, units: Units) -> String {
    match assumption {
        Assumption::ZUp => {
            "z-up: y to the left of x, angles and yaw rates counter-clockwise positive".to_owned()
        }
        Assumption::TypicalStiffness { typical, side, abg: [a, b, g], .. } => format!(
            "A = {}, B = {}, G = {}: {}, {}",
            units.format(Measure::StiffnessA, *a),
            units.format(Measure::StiffnessB, *b),
            units.format(Measure::StiffnessG, *g),
            match typical {
                TypicalStiffness::Category(category) => format!("category {category} of CRASH3's table"),
                TypicalStiffness::Fleet => "cars of 1991 to 2018 (docs/calibration.md)".to_owned(),
            },
            words::side_name(*side)
        ),
        Assumption::YawRate { .. } => "0: the vehicle does not turn before the impact".to_owned(),
        Assumption::ClassInertia { class, yaw_inertia, .. } => format!(
            "{}, with the radius of gyration of CRASH3's size class {class}",
            units.format(Measure::YawInertia, *yaw_inertia)
        ),
        Assumption::BurgInertia { yaw_inertia, .. } => format!(
            "{}, Burg's estimate from mass, wheelbase and length",
            units.format(Measure::YawInertia, *yaw_inertia)
        ),
        Assumption::ContactPlaced { point: [x, y], .. } => format!(
            "x = {}, y = {}: the centroid of the damage, from its side, width, depths and offset and the \
             vehicle's outline",
            units.format(Measure::Length, *x),
            units.format(Measure::Length, *y)
        ),
        Assumption::Outline { class, .. } => format!(
            "neither this nor `width`, `cg_to_front` or `class` is given: drawings use the outline of \
             CRASH3's size class {class}, which has the nearest radius of gyration"
        ),
        Assumption::ImpactAtOrigin => {
            "x = 0, y = 0: the path to rest is measured from the place where the impulse acted".to_owned()
        }
        Assumption::LevelGround => {
            "level: no slope speeds a vehicle up or slows it down on its path to rest".to_owned()
        }
        Assumption::Axle { class, measure, value, .. } => format!(
            "{}, {}",
            units.format(Measure::Length, *value),
            match measure {
                AxleMeasure::Wheelbase | AxleMeasure::Track => format!("that of CRASH3's size class {class}"),
                AxleMeasure::CgToFrontAxle =>
                    format!("at the same share of the wheelbase as in CRASH3's size class {class}"),
            }
        ),
        Assumption::StraightWheels { .. } => "0: the front wheels stay straight after the impact".to_owned(),
        Assumption::SkidFriction { friction, .. } => {
            format!("{friction}, that of the ground: the wheels were locked and skidded on level ground")
        }
        Assumption::SpeedUnused { given, is_direction_used: true, .. } => format!(
            "of unknown size: this is the speed to find; only the direction of the {} in the file is used",
            units.format(Measure::Speed, *given)
        ),
        Assumption::SpeedUnused { given, is_direction_used: false, .. } => format!(
            "unknown: this is the speed to find; the {} in the file is not used",
            units.format(Measure::Speed, *given)
        ),
        Assumption::EqualSpacing { .. } => "equal: the stations divide the width into equal parts".to_owned(),
        Assumption::EnergyWithoutCrush { g, .. } => {
            let values: Vec<String> = g.iter().map(|&si| units.format(Measure::StiffnessG, si)).collect();
            format!("A²/2B (d0²/2) = {}", values.join(", "))
        }
        Assumption::ExactFit { .. } => "exact: the line reproduces the test's kinetic energy".to_owned(),
        Assumption::InferredWidth { .. } => {
            "unknown: the width of the measured damage is used, within what the vehicle's dimensions \
             allow"
                .to_owned()
        }
        Assumption::Centred { side, .. } => {
            format!("0: the middle of the damage lies {}", words::undisplaced(*side))
        }
        Assumption::Pdof { opposite: Some(pdof), .. } => {
            format!("{}, opposite to the force on the other vehicle", units.format(Measure::Angle, *pdof))
        }
        Assumption::Pdof { opposite: None, .. } => "that of the impulse, if an impact is computed".to_owned(),
        Assumption::CappedCorrection { .. } => {
            "capped: 1 + tan²α, with α at most 45°, a factor of 2".to_owned()
        }
        Assumption::BrachLaw => "brach".to_owned(),
        Assumption::NoMoment => "-1: no moment impulse".to_owned(),
        Assumption::Dissipated => {
            "dissipated: the crush energy is the energy that the normal impulse dissipates".to_owned()
        }
    }
}

/// The tables of a record under their keys, each with what was recognised in it.
fn tables<'r>(record: &'r Recorder, at: &'r str) -> impl Iterator<Item = (String, String)> + 'r {
    let before = record.pre_crash.iter().flat_map(|given| &given.tables);
    let pulse = record.pulse.iter().flat_map(|given| &given.tables);
    let before = before.map(move |table| (format!("{at}.pre_crash"), recognised_in_words(table)));
    before.chain(pulse.map(move |table| (format!("{at}.pulse"), recognised_in_words(table))))
}

/// What was recognised in a table, on one line.
pub(crate) fn recognised_in_words(table: &RecorderTable) -> String {
    let times = table.times();
    let [first, last] = [times.first(), times.last()].map(|time| time.copied().unwrap_or_default());
    let columns: Vec<String> = table
        .columns
        .iter()
        .filter(|column| column.channel != Channel::Time)
        .map(|column| {
            let unit =
                if column.channel.is_switch() { String::new() } else { format!(" in {}", column.unit.name) };
            format!("{}{unit}", column.channel.name())
        })
        .collect();
    let lost = match table.doubts.len() {
        0 => String::new(),
        1 => "; 1 cell without a value".to_owned(),
        count => format!("; {count} cells without a value"),
    };
    let when = match times.len() {
        1 => format!("1 time, {} s", number(first, 2)),
        count => format!("{count} times from {} to {} s", number(first, 2), number(last, 2)),
    };
    format!("{when}; {}{lost}", columns.join(", "))
}
