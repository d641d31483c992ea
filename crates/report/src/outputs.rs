//! The names of outputs and reasons, and the units in which outputs are printed.

use analysis::quantities::SKID_SPEED;
use analysis::{Kind, Output, Reason};
use case::{EstimatedInput, FaceAxis, Input, Origin, TypicalStiffness, YawSource};

use crate::units::{Measure, Units};

/// Why a sample has no answer: the key of the JSON and of the samples.
#[must_use]
pub fn reason_name(reason: Reason) -> &'static str {
    reason_words(reason)[0]
}

/// The code of a reason, and its words.
pub(crate) fn reason_words(reason: Reason) -> [&'static str; 2] {
    match reason {
        Reason::NotApproaching => ["not_approaching", "the contact points do not approach each other"],
        Reason::NoRoot => ["no_root", "no speed makes crush and impact agree"],
        Reason::EnergyCreated => ["energy_created", "the coefficients would create energy"],
        Reason::Jam => ["jam", "the contact jams"],
        Reason::Pulling => ["pulling", "the vehicles would have to pull on each other"],
        Reason::NoDamageSpeed => {
            ["no_damage_speed", "the speed without damage is not below that of the barrier test"]
        }
        Reason::LimitBelowStart => {
            ["limit_below_start", "the limit of the force per width is below A, at which crush begins"]
        }
        Reason::NoRest => {
            ["no_rest", "no motion after the impact reaches the rest position, or none ends at rest"]
        }
        Reason::NoSpeeds => ["no_speeds", "momentum and crush energy give no speeds"],
        Reason::Other => ["other", "the numbers are impossible for another reason"],
    }
}

/// The name of a number that may vary: its path if the file gives it, otherwise words.
pub(crate) fn input_name(input: &Input) -> String {
    match input.origin {
        Origin::Given => input.path.clone(),
        Origin::Estimate(estimate) => estimate_name(estimate),
        Origin::Shared(_) => {
            format!("shared error {}", input.path.strip_prefix("uncertainty.shared.").unwrap_or_default())
        }
    }
}

/// The source of an estimate.
pub(crate) fn estimate_source(estimate: EstimatedInput) -> String {
    match estimate {
        EstimatedInput::Stiffness { typical: TypicalStiffness::Category(category), .. } => {
            format!("category {category}")
        }
        EstimatedInput::Stiffness { typical: TypicalStiffness::Fleet, .. } => "fleet".to_owned(),
        EstimatedInput::YawRadius { source: YawSource::Class(class), .. } => format!("class {class}"),
        EstimatedInput::YawRadius { .. } => "Burg".to_owned(),
        EstimatedInput::Contact { .. } => "centroid of the damage".to_owned(),
    }
}

/// What is estimated, and from what.
pub(crate) fn estimate_name(estimate: EstimatedInput) -> String {
    let source = estimate_source(estimate);
    match estimate {
        EstimatedInput::Stiffness { vehicle, .. } => format!("stiffness, vehicle {vehicle}, {source}"),
        EstimatedInput::YawRadius { vehicle, .. } => format!("yaw radius, vehicle {vehicle}, {source}"),
        EstimatedInput::Contact { vehicle, axis: FaceAxis::Along } => {
            format!("C along the face, vehicle {vehicle}")
        }
        EstimatedInput::Contact { vehicle, axis: FaceAxis::Inward } => {
            format!("C across the face, vehicle {vehicle}")
        }
    }
}

/// The measure in which a kind of number is printed.
pub(crate) fn printed(kind: Kind) -> Measure {
    match kind {
        Kind::Ratio => Measure::Ratio,
        Kind::Speed => Measure::Speed,
        Kind::Length => Measure::Length,
        Kind::Angle => Measure::Angle,
        Kind::YawRate => Measure::YawRate,
        Kind::Energy => Measure::Energy,
        Kind::Impulse => Measure::Impulse,
        Kind::MomentImpulse => Measure::MomentImpulse,
        Kind::Force => Measure::Force,
        Kind::Time => Measure::Time,
    }
}

/// The name of an output in a heading.
pub(crate) fn output_name(output: Output) -> String {
    let row = output.quantity();
    let of = match output.vehicle() {
        // "marks begin of vehicle 1" would sound like the marks of another vehicle.
        Some(vehicle) if output.is(&SKID_SPEED) => {
            return format!("Speed of vehicle {vehicle} where its skid begins");
        }
        Some(vehicle) => format!(" of vehicle {vehicle}"),
        None if row.is_of_vehicle() => return format!("Total {}", row.name),
        None if row.kind == Kind::Ratio => format!(" {}", row.symbol),
        None => String::new(),
    };
    let along = match row.key.rsplit('.').next() {
        Some("x") => " along x",
        Some("y") => " along y",
        _ => "",
    };
    let mut letters = row.name.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}{of}{along}", letters.as_str())
}

/// The measure in which an output is printed; a speed is in the unit of the equations.
pub(crate) fn output_quantity(output: Output) -> Measure {
    printed(output.quantity().kind)
}

/// The same, a speed as people read it: in km/h or mph.
pub(crate) fn pictured(output: Output) -> Measure {
    match output_quantity(output) {
        Measure::Speed => Measure::RoadSpeed,
        other => other,
    }
}

/// An output and its unit: the label of an axis or a row.
pub(crate) fn label(output: Output, measure: Measure, units: Units) -> String {
    let name = output_name(output);
    match units.name(measure) {
        "" => name,
        unit => format!("{name}, {unit}"),
    }
}
