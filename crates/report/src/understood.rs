//! A case as the program understood it, in words: ranges, units, choices, and what is assumed where the file
//! says nothing.

use analysis::{Assumption, AxleMeasure};
use case::{
    After, BrachTangential, Case, Dimension, Drag, Fit, GivenDemand, GivenWayOut, ImpactLaw, Input,
    KnownEnergy, MarkedWheel, Pdof, Range, Recorder, SUBJECTS, SWELLS, SeverityPrior, Spread, StiffnessForm,
    UNDAMAGED, Unit, UnitSystem, WheelDrag, word,
};
use crash3::ObliqueCorrection;
use pim_core::VehicleId;
use recorder::{Channel, RecorderTable};

use crate::units::{Measure, Units, number, significant};
use crate::words;

pub(crate) fn spread(range: &Range) -> String {
    match range.spread {
        Spread::Normal { sd } => format!("sd {sd}"),
        Spread::Uniform { low, high } => format!("{low} to {high}"),
        Spread::Triangular { low, high } => format!("likeliest of {low} to {high}"),
        Spread::Within { percent, confidence } => {
            format!("within {percent} % ({})", significant(confidence, 2))
        }
    }
}

pub(crate) fn amount(number: f64, unit: Option<&'static Unit>) -> String {
    unit.map_or_else(|| number.to_string(), |unit| format!("{number} {unit}"))
}

/// The customary unit of a quantity in a system; smaller for depths and widths of damage than for other
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

/// Six digits are more than any input has, and trailing zeros say nothing.
pub(crate) fn shown((value, unit): (f64, Option<&'static Unit>)) -> String {
    // Via the text with six digits: the shortest decimal that reads back the same has no trailing zeros and
    // no exponent.
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    let digits = if rounded == 0.0 { "0".to_owned() } else { rounded.to_string() };
    unit.map_or_else(|| digits.clone(), |unit| format!("{digits} {unit}"))
}

/// The words and whole numbers of the file, key by key.
pub(crate) fn choices(case: &Case) -> Vec<(String, String)> {
    let mut choices = vec![("scene.axes".to_owned(), case.axes.name().to_owned())];
    if let Some(plan) = &case.site_plan {
        choices.push(("scene.site_plan.file".to_owned(), plan.file.to_string()));
    }
    if case.locked_together {
        choices.push(("scene.locked_together".to_owned(), "true".to_owned()));
    }
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&case.vehicles) {
        let mut say = |key: &str, value: String| choices.push((format!("vehicle{id}.{key}"), value));
        if let Some(name) = &vehicle.name {
            say("name", name.to_string());
        }
        if vehicle.fixed {
            say("fixed", "true".to_owned());
        }
        if let Some(kind) = vehicle.kind {
            say("kind", kind.name().to_owned());
        }
        if let Some(class) = vehicle.class {
            say("class", class.to_string());
        }
        match &vehicle.energy {
            Some(KnownEnergy::Undamaged) => say("crush", UNDAMAGED.to_owned()),
            Some(KnownEnergy::Ees(given)) => {
                if let Some(side) = given.side {
                    say("crush.side", words::side_name(side).to_owned());
                }
                if let Some(Pdof::Clock(hour)) = given.pdof {
                    say("crush.pdof", clock(hour));
                }
            }
            None => {}
        }
        if let Some(recorder) = &vehicle.recorder {
            for (key, words) in tables(recorder, "recorder") {
                say(&key, words);
            }
            for (k, one) in recorder.records.iter().enumerate() {
                for (key, words) in tables(&one.stored, &format!("recorder.records[{}]", k + 1)) {
                    say(&key, words);
                }
            }
        }
        if let Some(after) = &vehicle.after {
            for (key, words) in of_path(after) {
                say(&key, words);
            }
        }
        let Some(crush) = &vehicle.crush else { continue };
        say("crush.side", words::side_name(crush.side).to_owned());
        if crush.from_force_balance {
            say("crush.from_force_balance", "true".to_owned());
        }
        match &crush.stiffness {
            StiffnessForm::Category(category) => say("crush.stiffness.category", category.to_string()),
            StiffnessForm::Test(test) => {
                say("crush.stiffness.test.fit", word(&Fit::WORDS, &test.fit).to_owned());
            }
            _ => {}
        }
        if let Some(Pdof::Clock(hour)) = crush.pdof {
            say("crush.pdof", clock(hour));
        }
        match crush.oblique {
            // Its number stands among the numbers.
            None | Some(ObliqueCorrection::Friction(_)) => {}
            Some(correction) => say("crush.oblique", crate::law::correction_name(correction).to_owned()),
        }
    }
    if let Some(impact) = &case.impact {
        choices.push(("impact.law".to_owned(), impact.law.name().to_owned()));
        if matches!(impact.law, ImpactLaw::Brach { tangential: BrachTangential::Critical, .. }) {
            let critical = word(&BrachTangential::WORDS, &BrachTangential::Critical);
            choices.push(("impact.tangential".to_owned(), critical.to_owned()));
        }
    }
    if let Some(reconstruct) = &case.reconstruct {
        choices.push(("reconstruct.find".to_owned(), words::find_names(reconstruct.find)));
        // The number of a share stands among the numbers.
        choices.push(("reconstruct.energy_basis".to_owned(), reconstruct.energy_basis.name().to_owned()));
    }
    if let Some(avoid) = &case.avoid {
        choices.push(("avoid.vehicle".to_owned(), word(&SUBJECTS, &case.avoid_subject()).to_owned()));
        let form = avoid.swell_form.unwrap_or_default();
        choices.push(("avoid.swell_form".to_owned(), word(&SWELLS, &form).to_owned()));
        if let Some(party) = avoid.other_party {
            choices.push(("avoid.other_party".to_owned(), party.name().to_owned()));
        }
        for (key, is_true) in [
            ("avoid.unbraked", avoid.unbraked),
            ("avoid.demand.sight", avoid.demand == Some(GivenDemand::Sight)),
            (
                "avoid.clear.outlines",
                avoid.clear.as_ref().is_some_and(|clear| clear.way == GivenWayOut::Outlines),
            ),
        ] {
            if is_true {
                choices.push((key.to_owned(), "true".to_owned()));
            }
        }
    }
    if let Some(estimate) = &case.estimate {
        choices.push(("estimate.prior".to_owned(), word(&SeverityPrior::WORDS, &estimate.prior).to_owned()));
    }
    if !case.uncertainty.exact.is_empty() {
        choices.push(("uncertainty.exact".to_owned(), case.uncertainty.exact.join(", ")));
    }
    choices
}

/// The words of the path to rest: wheels that are locked, and those that left a mark. The numbers of the
/// others stand among the numbers.
fn of_path(after: &After) -> Vec<(String, String)> {
    let locked = WheelDrag::WORDS[0].0;
    let is_locked = |drag: &WheelDrag| matches!(drag, WheelDrag::Locked);
    let drag: Vec<String> = match &after.drag {
        Some(Drag::Every(drag)) => is_locked(drag).then(|| "after.drag".to_owned()).into_iter().collect(),
        Some(Drag::Each(wheels)) => (1..)
            .zip(wheels)
            .filter(|(_, drag)| is_locked(drag))
            .map(|(n, _)| format!("after.drag[{n}]"))
            .collect(),
        None => Vec::new(),
    };
    let marks = (1..).zip(&after.points).filter_map(|(n, point)| {
        Some((format!("after.points[{n}].wheel"), word(&MarkedWheel::WORDS, &point.wheel?).to_owned()))
    });
    drag.into_iter().map(|key| (key, locked.to_owned())).chain(marks).collect()
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

/// What is assumed, in words.
pub(crate) fn message(assumption: &Assumption, units: Units) -> String {
    match assumption {
        Assumption::ZUp => {
            "z-up: y to the left of x, angles and yaw rates counter-clockwise positive".to_owned()
        }
        Assumption::CategoryStiffness { category, side, abg: [a, b, g], .. } => format!(
            "A = {}, B = {}, G = {}: category {category} of CRASH3's table, {}",
            units.format(Measure::StiffnessA, *a),
            units.format(Measure::StiffnessB, *b),
            units.format(Measure::StiffnessG, *g),
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
            "x = 0, y = 0: the path to rest is counted from the place where the impulse acted".to_owned()
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
            "of unknown size: this is the speed to find; of the {} that the file gives only the direction is used",
            units.format(Measure::Speed, *given)
        ),
        Assumption::SpeedUnused { given, is_direction_used: false, .. } => format!(
            "unknown: this is the speed to find; the {} that the file gives is not used",
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
