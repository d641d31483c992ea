//! The names of outputs and reasons, and the units in which outputs are printed.

use analysis::{Kind, Output, Reason, WayNumber, quantity};
use case::{Estimate, FaceAxis, Input, Origin, YawSource};

use crate::units::Measure;

/// Why a sample has no answer: the key of the JSON and of the samples.
#[must_use]
pub fn reason_name(reason: Reason) -> &'static str {
    match reason {
        Reason::NotApproaching => "not_approaching",
        Reason::NoRoot => "no_root",
        Reason::EnergyCreated => "energy_created",
        Reason::Jam => "jam",
        Reason::Pulling => "pulling",
        Reason::NoDamageSpeed => "no_damage_speed",
        Reason::LimitBelowStart => "limit_below_start",
        Reason::NoRest => "no_rest",
        Reason::NoSpeeds => "no_speeds",
        Reason::Other => "other",
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
pub(crate) fn estimate_source(estimate: Estimate) -> String {
    match estimate {
        Estimate::Stiffness { category, .. } => format!("category {category}"),
        Estimate::YawRadius { source: YawSource::Class(class), .. } => format!("class {class}"),
        Estimate::YawRadius { .. } => "Burg".to_owned(),
        Estimate::Contact { .. } => "centroid of the damage".to_owned(),
    }
}

/// What is estimated, and from what.
pub(crate) fn estimate_name(estimate: Estimate) -> String {
    let source = estimate_source(estimate);
    match estimate {
        Estimate::Stiffness { vehicle, .. } => format!("stiffness, vehicle {vehicle}, {source}"),
        Estimate::YawRadius { vehicle, .. } => format!("yaw radius, vehicle {vehicle}, {source}"),
        Estimate::Contact { vehicle, axis: FaceAxis::Along } => {
            format!("C along the face, vehicle {vehicle}")
        }
        Estimate::Contact { vehicle, axis: FaceAxis::Inward } => {
            format!("C across the face, vehicle {vehicle}")
        }
    }
}

/// The quantity in which a kind of number is printed; none for a pure number.
pub(crate) fn printed(kind: Kind) -> Option<Measure> {
    match kind {
        Kind::Ratio => None,
        Kind::Speed => Some(Measure::Speed),
        Kind::Length => Some(Measure::Length),
        Kind::Angle => Some(Measure::Angle),
        Kind::YawRate => Some(Measure::YawRate),
        Kind::Energy => Some(Measure::Energy),
        Kind::Impulse => Some(Measure::Impulse),
        Kind::MomentImpulse => Some(Measure::MomentImpulse),
        Kind::Force => Some(Measure::Force),
        Kind::Time => Some(Measure::Time),
    }
}

/// The name of an output in a heading.
pub(crate) fn output_name(output: Output) -> String {
    let name = quantity(output.key()).map_or_else(|| output.key(), |row| row.name);
    let mut letters = name.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    let of = output.vehicle().map_or_else(String::new, |vehicle| format!(" of vehicle {vehicle}"));
    let along = match output {
        Output::Way { number: WayNumber::RestX, .. } => " along x",
        Output::Way { number: WayNumber::RestY, .. } => " along y",
        _ => "",
    };
    format!("{first}{}{of}{along}", letters.as_str())
}

/// The quantity as which an output is printed, a speed in the unit of the equations.
pub(crate) fn output_quantity(output: Output) -> Measure {
    quantity(output.key()).and_then(|row| printed(row.kind)).unwrap_or(Measure::Speed)
}

/// The same in a picture, where people read speeds in mph and km/h.
pub(crate) fn pictured(output: Output) -> Measure {
    match output_quantity(output) {
        Measure::Speed => Measure::RoadSpeed,
        other => other,
    }
}
