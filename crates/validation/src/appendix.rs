//! The paper's example reconstruction.

use analysis::{Analysis, Vehicle};
use case::CaseFile;

use crate::Data;
use crate::claim::Cell;
use crate::error::ValidationError;
use crate::published::{PrintedUnit, Published};

/// A figure of the paper's appendix.
#[derive(Clone, Debug, PartialEq)]
pub struct AppendixFigure {
    /// Its name.
    pub quantity: String,
    /// The unit in which the paper prints it.
    pub unit: PrintedUnit,
    /// The figure, in SI units.
    pub cell: Cell,
}

pub(crate) fn appendix(data: &Data, published: &Published) -> Result<Vec<AppendixFigure>, ValidationError> {
    let file = CaseFile::parse("fixtures/sae-980025.toml", data.example)?;
    let analysis = analysis::reconstruct(&file.case)?;
    published
        .appendix
        .iter()
        .map(|figure| {
            let ours = result(&analysis, &figure.key)
                .ok_or_else(|| ValidationError::NoFigure { quantity: figure.quantity.clone() })?;
            Ok(AppendixFigure {
                quantity: figure.quantity.clone(),
                unit: figure.unit,
                cell: figure.cell(ours)?,
            })
        })
        .collect()
}

/// Our result (SI); `None` if the analysis does not give it.
fn result(analysis: &Analysis, key: &str) -> Option<f64> {
    let outcome = &analysis.impact.as_ref()?.outcome;
    let crash3 = analysis.crash3.as_ref()?;
    let damage = |i: usize| analysis.vehicles[i].damage.as_ref();
    let corrected = |vehicle: &Vehicle| {
        vehicle
            .damage
            .as_ref()
            .and_then(|damage| damage.oblique)
            .map(|oblique| oblique.corrected_crush_energy)
    };
    let [v1, v2] = &analysis.vehicles;
    let [after1, after2] = outcome.after;
    let [dv1, dv2] = outcome.delta_v_magnitude();
    let p = outcome.impulse_vector;
    Some(match key {
        "crush_energy_1" => damage(0)?.crush_energy,
        "crush_energy_2" => damage(1)?.crush_energy,
        "crush_energy" => crash3.crush_energy,
        "speed" => analysis.found.as_ref()?.speed,
        "impulse_ratio" => outcome.impulse_ratio,
        "initial_energy" => outcome.energy.before,
        "energy_loss" => outcome.energy.loss,
        "loss_share" => outcome.energy.loss / outcome.energy.before,
        "crush_share" => outcome.energy.normal_work / outcome.energy.before,
        "normal_impulse" => outcome.impulse.normal,
        "tangential_impulse" => outcome.impulse.tangential,
        "resultant_impulse" => (p.x * p.x + p.y * p.y).sqrt(),
        "after_1x" => after1.velocity.x,
        "after_1y" => after1.velocity.y,
        "yaw_rate_1" => after1.yaw_rate,
        "before_2x" => outcome.before[1].velocity.x,
        "before_2y" => outcome.before[1].velocity.y,
        "after_2x" => after2.velocity.x,
        "after_2y" => after2.velocity.y,
        "yaw_rate_2" => after2.yaw_rate,
        "delta_v_1" => dv1,
        "delta_v_2" => dv2,
        "crash3_delta_v_1" => crash3.delta_v[0],
        "crash3_delta_v_2" => crash3.delta_v[1],
        "corrected_energy_1" => corrected(v1)?,
        "corrected_energy_2" => corrected(v2)?,
        "corrected_energy" => crash3.corrected?.crush_energy,
        _ => return None,
    })
}
