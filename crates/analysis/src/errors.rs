//! The errors of the evidence of momentum and of crush.

use evidence::{CrushMisfit, DamagedSide, FITTED};
use inputs::{Case, GivenVehicle};
use reconcile::EvidenceErrors;

use crate::thresholds::{DIRECTION_AFTER_ERROR, SPEED_AFTER_ERROR};

/// The errors of the evidence when momentum and the crush energy are weighed.
///
/// That of the crush energy combines the bias and the spread that were fitted to real crashes: the bias
/// counts as an error because the bias of the stiffness in a file is unknown. On the RICSAC collisions it is
/// 0.5.
pub(crate) fn errors(case: &Case) -> EvidenceErrors {
    let sides = case.vehicles.iter().filter_map(GivenVehicle::damaged_side);
    let hit: Vec<DamagedSide> = sides.map(DamagedSide::from).collect();
    let CrushMisfit { bias, ln_sd } = FITTED.crush_misfit(&hit);
    EvidenceErrors {
        speed: SPEED_AFTER_ERROR,
        direction: DIRECTION_AFTER_ERROR,
        // σ = √(b² + σ_c²)
        crush_ln: (bias * bias + ln_sd * ln_sd).sqrt(),
    }
}
