//! The paper's example reconstruction.

use analysis::{Analysis, Vehicle};
use case::CaseFile;

use crate::Data;
use crate::claim::Cell;
use crate::error::ValidationError;
use crate::published::{Key, PrintedUnit, Published};

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
            let ours = result(&analysis, figure.key)
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
fn result(analysis: &Analysis, key: Key) -> Option<f64> {
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
        Key::CrushEnergy1 => damage(0)?.crush_energy,
        Key::CrushEnergy2 => damage(1)?.crush_energy,
        Key::CrushEnergy => crash3.crush_energy,
        Key::Speed => analysis.found.as_ref()?.speed,
        Key::ImpulseRatio => outcome.impulse_ratio,
        Key::InitialEnergy => outcome.energy.before,
        Key::EnergyLoss => outcome.energy.loss,
        Key::LossShare => outcome.energy.loss / outcome.energy.before,
        Key::CrushShare => outcome.energy.normal_work / outcome.energy.before,
        Key::NormalImpulse => outcome.impulse.normal,
        Key::TangentialImpulse => outcome.impulse.tangential,
        Key::ResultantImpulse => (p.x * p.x + p.y * p.y).sqrt(),
        Key::After1x => after1.velocity.x,
        Key::After1y => after1.velocity.y,
        Key::YawRate1 => after1.yaw_rate,
        Key::Before2x => outcome.before[1].velocity.x,
        Key::Before2y => outcome.before[1].velocity.y,
        Key::After2x => after2.velocity.x,
        Key::After2y => after2.velocity.y,
        Key::YawRate2 => after2.yaw_rate,
        Key::DeltaV1 => dv1,
        Key::DeltaV2 => dv2,
        Key::Crash3DeltaV1 => crash3.delta_v[0],
        Key::Crash3DeltaV2 => crash3.delta_v[1],
        Key::CorrectedEnergy1 => corrected(v1)?,
        Key::CorrectedEnergy2 => corrected(v2)?,
        Key::CorrectedEnergy => crash3.corrected?.crush_energy,
    })
}
