//! Names for the distinctions of the engines, and words for stiffnesses and speeds, for everything that
//! writes a document.

use std::ffi::OsStr;
use std::path::Path;

use analysis::{Analysis, EvidenceMethod, Evident, Hypothesis, Pass, Vehicle};
use case::{
    Case, Find, Fit, Program, SIDES, StiffnessSource, Text, TypicalStiffness, UNKNOWNS, VehicleKind, word,
};
use crash3::Side;
use pim_core::Regime;
use pim_core::VehicleId;

use crate::units::{Measure, Units};

/// The commands of the program `deltav`, for errors that point to them.
pub static PROGRAM: Program = Program {
    name: |purpose| format!("`deltav {purpose}`"),
    begins: Some("`deltav new`"),
    describes_classes: Some("`deltav explain class`"),
    explains_two_speeds: Some("`deltav explain two unknown speeds`"),
};

/// The title of every document and drawing.
pub(crate) fn title(case: &Case) -> String {
    case.title.as_ref().map_or_else(|| "Untitled case".to_owned(), Text::to_string)
}

/// By how much a path misses a point, and the heading there.
pub(crate) fn pass(pass: &Pass, units: Units) -> String {
    let miss = units.format(Measure::Length, pass.miss);
    let turned = pass.turned.map(|turned| format!(", {}", units.format(Measure::Angle, turned)));
    format!("{miss}{}", turned.unwrap_or_default())
}

/// The name of a case file without its folders, which do not concern the recipient of a report.
pub(crate) fn file_name(name: &Text) -> Text {
    let last = Path::new(name.as_given()).file_name().and_then(OsStr::to_str);
    last.map_or_else(|| name.clone(), Text::from)
}

pub(crate) fn unknown_name(unknown: VehicleId) -> &'static str {
    word(&UNKNOWNS, &unknown)
}

/// The keys of the speeds that are to be found.
pub(crate) fn find_names(find: Find) -> String {
    match find {
        Find::One(unknown) => unknown_name(unknown).to_owned(),
        Find::Both => UNKNOWNS.map(|(name, _)| name).join(" and "),
    }
}

/// Whether the offset of damage is counted from the vehicle's axis, rather than from a point level with its
/// CG.
pub(crate) fn is_end(side: Side) -> bool {
    matches!(side, Side::Front | Side::Rear)
}

/// The position of the middle of a damage without an offset.
pub(crate) fn undisplaced(side: Side) -> &'static str {
    if is_end(side) { "on the vehicle's axis" } else { "beside the centre of gravity" }
}

pub(crate) fn side_name(side: Side) -> &'static str {
    word(&SIDES, &side)
}

/// The kind of a vehicle, with its article.
pub(crate) fn kind_name(kind: VehicleKind) -> &'static str {
    match kind {
        VehicleKind::Car => "a car",
        VehicleKind::HeavyTruck => "a heavy truck",
        VehicleKind::Trailer => "a trailer",
        VehicleKind::Motorcycle => "a motorcycle",
    }
}

/// The source of a vehicle's damage: the value of the JSON key `crush_source`.
pub(crate) fn crush_source(vehicle: &Vehicle) -> Option<&'static str> {
    match (&vehicle.damage, &vehicle.subject.energy) {
        (Some(damage), _) if damage.inferred.is_some() => Some("force balance"),
        (Some(_), _) => Some("measured"),
        (None, Some(energy)) if energy.ees.is_some() => Some("EES"),
        (None, Some(_)) => Some("none"),
        (None, None) => vehicle.subject.deformation_energy.map(|_| "object"),
    }
}

/// The vehicles whose `count` crush energies a sum contains.
pub(crate) fn of_crushed(vehicles: &[Vehicle; 2], count: usize) -> &'static str {
    match (count, vehicles.iter().all(Vehicle::moves)) {
        (0 | 1, _) => "",
        (_, true) => " of both vehicles",
        (_, false) => " of vehicle and object",
    }
}

/// The source of a stiffness, short enough for a column.
pub(crate) fn stiffness_source(source: StiffnessSource, side: Side) -> String {
    match source {
        StiffnessSource::Coefficients => "A and B as given".to_owned(),
        StiffnessSource::Roots => "d0 and d1 as given".to_owned(),
        StiffnessSource::Typical(typical) => {
            let side = match side {
                Side::Left | Side::Right => "side",
                Side::Front | Side::Rear => side_name(side),
            };
            match typical {
                TypicalStiffness::Category(category) => format!("CRASH3 category {category}, {side}"),
                TypicalStiffness::Fleet => format!("fleet, {side}"),
            }
        }
        StiffnessSource::Test(Fit::Exact) => "barrier test, exact fit".to_owned(),
        StiffnessSource::Test(Fit::Mean) => "barrier test, mean crush".to_owned(),
        StiffnessSource::Zones => "zone by zone as given".to_owned(),
    }
}

/// The value of the JSON key `regime`.
pub(crate) fn regime_name(regime: Regime) -> &'static str {
    match regime {
        Regime::Full => "full",
        Regime::Sliding => "sliding",
    }
}

/// The name of evidence that an answer does not use.
pub(crate) fn evident(evidence: Evident) -> &'static str {
    match evidence {
        Evident::RecordedSpeed => "the recorder's speed",
        Evident::RecordedLongitudinal => "the recorder's longitudinal ΔV",
        Evident::RecordedLateral => "the recorder's lateral ΔV",
        Evident::TabledSpeed => "the speed at impact by the recorder's table",
        Evident::PulseLongitudinal => "the longitudinal ΔV of the recorder's pulse",
        Evident::PulseLateral => "the lateral ΔV of the recorder's pulse",
        Evident::RecordedYawRate => "the recorder's yaw rate",
        Evident::SkidSpeed => "the speed where the skid begins",
        Evident::SpeedAfter => "the speed after the impact",
        Evident::DirectionAfter => "the direction after the impact",
        Evident::YawRateAfter => "the yaw rate after the impact",
        Evident::AtLeast => "the lowest speed that is possible",
        Evident::AtMost => "the highest speed that is possible",
        _ => "a piece of evidence",
    }
}

/// The evidence that gave an exact solution.
pub(crate) fn solution(by: EvidenceMethod) -> &'static str {
    match by {
        EvidenceMethod::DamageAndSpeed { .. } => "damage and the given speed",
        EvidenceMethod::DamageByObject => "damage at a fixed object",
        EvidenceMethod::DamageAlongLine => "damage, along one line",
        EvidenceMethod::Crash3 { .. } => "damage, by CRASH3",
        EvidenceMethod::Momentum => "momentum",
        EvidenceMethod::MomentumAndSpeed { .. } => "momentum and the given speed",
        EvidenceMethod::Wall { .. } => "the path out of the wall",
        EvidenceMethod::MomentumAndDamage => "momentum and damage",
        EvidenceMethod::Weighed { .. } => "momentum and damage, weighed",
    }
}

/// That some figures are those of an exact solution that is not the answer to its case.
pub(crate) fn not_the_answer(figures: &str, analysis: &Analysis) -> Option<String> {
    analysis.why_not_exact()?;
    Some(format!(
        "All {figures} are for the exact solution by {}, which is not the answer to the case: `deltav reconstruct` \
         says why, and weighs all evidence.",
        solution(analysis.solved_by())
    ))
}

/// Keys of the case in backticks, with a word or a comma between them.
pub(crate) fn quoted(keys: &[String], between: &str) -> String {
    keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(between)
}

/// The names of a run of avoidability.
pub(crate) struct RunWords {
    /// In the head of a table, in two lines.
    pub(crate) head: [&'static str; 2],
    /// In a legend.
    pub(crate) legend: &'static str,
    /// In the JSON.
    pub(crate) key: &'static str,
    /// The number of its pen.
    pub(crate) pen: usize,
}

pub(crate) fn run_words(hypothesis: Hypothesis) -> RunWords {
    let (head, legend, key, pen) = match hypothesis {
        Hypothesis::Actual => (["what", "happened"], "what happened", "actual", 0),
        Hypothesis::LimitOnly => {
            (["at the limit,", "else as it was"], "lower speed, all else as it was", "limit only", 1)
        }
        Hypothesis::ReactionInTime => (["reaction", "in time"], "reaction in time", "reaction in time", 2),
        Hypothesis::FullBraking => (["full", "braking"], "full braking", "full braking", 3),
        Hypothesis::ReactionAndBraking => (
            ["reaction and", "braking"],
            "reaction in time, full braking",
            "reaction in time and full braking",
            4,
        ),
        Hypothesis::LimitAndReaction => {
            (["limit and", "reaction"], "lower speed, reaction in time", "limit and reaction in time", 5)
        }
        Hypothesis::LimitAndBraking => {
            (["limit and", "braking"], "lower speed, full braking", "limit and full braking", 5)
        }
        Hypothesis::All => (
            ["limit, reaction", "and braking"],
            "lower speed, reaction in time, full braking",
            "limit, reaction in time and full braking",
            5,
        ),
    };
    RunWords { head, legend, key, pen }
}
