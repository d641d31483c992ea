//! The reconciliation: work of the normal impulse over the speed sought.

use ::drawing::{Axis, CurvePoint, ReconciliationPicture};
use analysis::{Analysis, first_push, work_curve};
use case::CaseFile;
use crash3::EnergyBasis;

use super::{DrawingError, title};
use crate::Units;
use crate::units::Measure;

/// Steps of the curve.
const SAMPLES: usize = 240;

pub(super) fn picture(
    file: &CaseFile,
    analysis: &Analysis,
    units: Units,
) -> Result<ReconciliationPicture, DrawingError> {
    let found = analysis.found.as_ref().ok_or(DrawingError::NoReconciliation)?;
    let curve = work_curve(&file.case, found, SAMPLES)?;
    let vehicle = found.unknown.vehicle();
    let axis = |what: &str, quantity: Measure| Axis {
        title: format!("{what} ({})", units.name(quantity)),
        unit: units.size(quantity),
    };
    let answer = units.road_speed(found.speed);
    let energy = units.format(Measure::Energy, found.normal_work);
    // What is sought may depend on the speed: an inferred crush, or a basis that restitution has a part in.
    let varies = curve.iter().any(|point| units.format(Measure::Energy, point.sought) != energy);
    let there = if varies { " at the speed found" } else { "" };
    let speed = |si: f64| units.format(Measure::RoadSpeed, si);
    let touch = speed(curve.first().map_or(0.0, |point| point.speed));
    // An interval whose ends look the same is none to the reader.
    let begins = match first_push(&file.case, &curve)?.filter(|&begins| speed(begins) != touch) {
        None => format!("It is zero where the vehicles just touch, at {touch},"),
        Some(begins) => format!(
            "It begins at {}, where the normal impulse becomes a push (Pₙ > 0); from {touch}, where the vehicles just touch, up to there they would have to \
             pull on each other. It rises from zero",
            speed(begins)
        ),
    };
    let crush = match analysis.basis {
        EnergyBasis::Dissipated => format!("the crush energy, {energy},"),
        EnergyBasis::Absorbed => format!(
            "{energy}, which is (1 − e²) times the crush energy of {},",
            units.format(Measure::Energy, found.crush_energy)
        ),
    };
    let description = format!(
        "Work of the normal impulse over the speed of vehicle {vehicle}. {begins} and reaches {crush} at {answer}. Admissible speeds: {}.",
        found.admissible.iter().map(|&si| speed(si)).collect::<Vec<_>>().join(", "),
    );
    Ok(ReconciliationPicture {
        title: title(&file.case),
        subtitle: format!("Reconciliation: work of the normal impulse over the speed of vehicle {vehicle}"),
        description,
        speed: axis(&format!("speed of vehicle {vehicle}"), Measure::RoadSpeed),
        work: axis("Wₙ", Measure::Energy),
        curve: curve
            .iter()
            .map(|point| CurvePoint { speed: point.speed, work: point.normal_work, sought: point.sought })
            .collect(),
        found: [found.speed, found.normal_work],
        others: found.admissible.iter().skip(1).map(|&si| (si, format!("also {}", speed(si)))).collect(),
        steps: found.iterations.iter().flatten().map(|step| [step.speed, step.normal_work]).collect(),
        sought: format!("{energy}{there}"),
        found_label: answer,
    })
}
