//! The reconciliation: the work that is compared with the crush energy, over the speed sought.

use ::drawing::{Axis, CurvePoint, ReconciliationPicture};
use analysis::{Analysis, first_push, work_curve};
use case::{Basis, CaseFile};

use super::{DrawingError, caveat, title, with_caveat};
use crate::Units;
use crate::basis;
use crate::units::Measure;

/// Steps of the curve.
const SAMPLES: usize = 240;

pub(super) fn picture(
    file: &CaseFile,
    analysis: &Analysis,
    units: Units,
) -> Result<ReconciliationPicture, DrawingError> {
    let found = analysis.found.as_ref().ok_or(match analysis.both {
        Some(_) => DrawingError::ByMomentum,
        None => DrawingError::NoReconciliation,
    })?;
    let curve = work_curve(&file.case, found, SAMPLES)?;
    let vehicle = found.unknown;
    let axis = |what: &str, quantity: Measure| Axis {
        title: format!("{what} ({})", units.name(quantity)),
        unit: units.size(quantity),
    };
    let answer = units.road_speed(found.speed);
    let energy = units.format(Measure::Energy, found.normal_work);
    // The work sought may depend on the speed: with an inferred crush, or a basis that involves restitution.
    let varies = curve.iter().any(|point| units.format(Measure::Energy, point.sought) != energy);
    let there = if varies { " at the speed found" } else { "" };
    let speed = |si: f64| units.format(Measure::RoadSpeed, si);
    let touch = speed(curve.first().map_or(0.0, |point| point.speed));
    // The reader sees no interval if its ends are printed alike.
    let begins = first_push(&file.case, &curve)?.filter(|&begins| speed(begins) != touch);
    let begins = match (begins, analysis.basis) {
        // There P_n is a push, but sliding does work as well.
        (begins, Basis::TangentialShare(_)) => format!(
            "It begins at {}, {},",
            begins.map_or_else(|| touch.clone(), speed),
            match begins {
                None => "where the vehicles just touch".to_owned(),
                Some(_) => format!(
                    "where the normal impulse becomes a push (Pₙ > 0), and not at {touch}, where the \
                     vehicles just touch"
                ),
            }
        ),
        (None, _) => format!("It is zero where the vehicles just touch, at {touch},"),
        (Some(begins), _) => format!(
            "It begins at {}, where the normal impulse becomes a push (Pₙ > 0); from {touch}, where the vehicles just touch, up to there they would have to \
             pull on each other. It rises from zero",
            speed(begins)
        ),
    };
    let crush = match analysis.basis {
        Basis::Dissipated | Basis::TangentialShare(_) => format!("the crush energy, {energy},"),
        Basis::Absorbed => format!(
            "{energy}, which is (1 − e²) times the crush energy of {},",
            units.format(Measure::Energy, found.crush_energy)
        ),
    };
    let (work, symbol) = (basis::work(analysis.basis), basis::symbol(analysis.basis, ["Wₙ", "Wₜ"]));
    let work = work.trim_start_matches("the ");
    let what = work.replacen('w', "W", 1);
    let description = format!(
        "{what} over the speed of vehicle {vehicle}. {begins} and reaches {crush} at {answer}. Admissible speeds: {}.",
        found.admissible.iter().map(|&si| speed(si)).collect::<Vec<_>>().join(", "),
    );
    let caveat = caveat(analysis);
    Ok(ReconciliationPicture {
        title: title(&file.case),
        subtitle: format!("Reconciliation: {work} over the speed of vehicle {vehicle}"),
        description: with_caveat(description, &caveat),
        caveat,
        speed: axis(&format!("speed of vehicle {vehicle}"), Measure::RoadSpeed),
        work: axis(&symbol, Measure::Energy),
        legend: [format!("{symbol}: {work}"), format!("{symbol} sought: {energy}{there}")],
        curve: curve
            .iter()
            .map(|point| CurvePoint {
                speed: point.speed,
                // Where the normal impulse would be a pull, no impact can happen, whatever work the sliding
                // does.
                work: if point.normal_work < 0.0 { point.normal_work } else { point.crush_work },
                sought: point.sought,
            })
            .collect(),
        found: [found.speed, found.normal_work],
        others: found.others().map(|si| (si, format!("also {}", speed(si)))).collect(),
        steps: found.iterations.iter().flatten().map(|step| [step.speed, step.normal_work]).collect(),
        found_label: answer,
    })
}
