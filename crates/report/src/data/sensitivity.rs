//! How sensitive the answer is to each input, as JSON.

use analysis::{Derivative, Sensitivity, SweepRow};
use case::{CaseFile, Origin, VehicleData};
use crash3::ObliqueCorrection;
use pim_core::VehicleId;

use super::json::{all_warnings, of_movable};
use super::{identified, list, object, pretty, title};
use crate::outputs::input_name;

/// The sensitivity as indented JSON, ending in a line break: `{"derivatives": [{"output": …, "input": …,
/// "value": …}], "pdof_sweep": [{"change": …, "delta_v": […]}]}`. Derivatives are SI per SI, `relative` is
/// per cent per per cent, and `influence` the relative change for 1 % of the input, or for 1° of an angle, by
/// which they are ranked.
///
/// # Errors
/// If serialisation fails, which no sensitivity causes.
pub fn sensitivity_json(file: &CaseFile, sensitivity: &Sensitivity) -> Result<String, serde_json::Error> {
    let case = &file.case;
    let paths = |key: &str, vehicles: Vec<VehicleId>| -> Vec<String> {
        vehicles.into_iter().map(|vehicle| format!("vehicle{vehicle}.crush.{key}")).collect()
    };
    let derivative = |row: &Derivative| {
        object! {
            "output": row.output.path(),
            "input": row.input.path,
            // In words, if it is not a key of the file.
            "name"?: (row.input.origin != Origin::Given).then(|| input_name(&row.input)),
            "value": row.value + 0.0,
            "relative"?: row.relative().map(|relative| relative + 0.0),
            "influence": row.influence() + 0.0,
        }
    };
    let turned = |row: &SweepRow| {
        object! {
            "change": row.change + 0.0,
            "pdof": row.pdof,
            "oblique_angle": row.oblique_angle.map(|angle| angle.map(|angle| angle + 0.0)),
            "moment_arm": of_movable(case, row.crash3.moment_arm),
            "uncorrected_delta_v": of_movable(case, row.crash3.delta_v),
            "delta_v"?: row.crash3.corrected.map(|corrected| of_movable(case, corrected.delta_v)),
            "capped_delta_v"?: row.corrected(ObliqueCorrection::Capped).map(|dv| of_movable(case, dv)),
            "uncapped_delta_v"?: row.corrected(ObliqueCorrection::Uncapped).map(|dv| of_movable(case, dv)),
        }
    };
    let document = object! {
        "title": title(case),
        // The axes of the inputs and of the turned directions.
        "axes": case.axes.name(),
        "derivatives": list(&sensitivity.derivatives, derivative),
        "pdof_sweep": list(&sensitivity.pdof_sweep, turned),
        // Values in the file that would otherwise follow from the direction: kept in every row of the
        // sweep.
        "pdof_sweep_held"?: paths("moment_arm", held_in_sweep(sensitivity)),
        // The same, but turned with the direction.
        "pdof_sweep_turned"?: paths("oblique_angle", turned_in_sweep(sensitivity)),
        // Keys of evidence that the derivatives do not use.
        "left_aside"?: sensitivity.nominal.left_aside,
        // The warnings of the case itself.
        "warnings": all_warnings(&sensitivity.nominal, case),
    };
    pretty(&identified(file, document))
}

/// The vehicles whose moment arm keeps the value that the file gives while the PDOF turns.
pub(crate) fn held_in_sweep(sensitivity: &Sensitivity) -> Vec<VehicleId> {
    given_in_sweep(sensitivity, |vehicle| vehicle.force.moment_arm)
}

/// The vehicles whose oblique angle begins with the value that the file gives, and turns with the PDOF.
pub(crate) fn turned_in_sweep(sensitivity: &Sensitivity) -> Vec<VehicleId> {
    given_in_sweep(sensitivity, |vehicle| vehicle.damage.as_ref()?.oblique_angle)
}

fn given_in_sweep(sensitivity: &Sensitivity, given: fn(&VehicleData) -> Option<f64>) -> Vec<VehicleId> {
    if sensitivity.pdof_sweep.is_empty() {
        return Vec::new();
    }
    let vehicles = VehicleId::ALL.into_iter().zip(&sensitivity.nominal.vehicles);
    vehicles.filter(|(_, vehicle)| given(&vehicle.subject).is_some()).map(|(vehicle, _)| vehicle).collect()
}
