//! The errors of the evidence of momentum and of crush.

use evidence::{CrushMisfit, DamagedSide, FITTED};
use inputs::{Case, GivenVehicle};
use reconcile::EvidenceErrors;

use crate::thresholds::{DIRECTION_AFTER_ERROR, SPEED_AFTER_ERROR};

/// Whether the front of a vehicle met a fixed object, as in the crashes to which the figures for fixed
/// objects were fitted.
pub(crate) fn is_with_object(case: &Case, hit: &[DamagedSide]) -> bool {
    case.vehicles.iter().any(|vehicle| vehicle.fixed) && hit == [DamagedSide::Front]
}

/// The sides that the case gives as damaged.
pub(crate) fn damaged_sides(case: &Case) -> Vec<DamagedSide> {
    case.vehicles.iter().filter_map(GivenVehicle::damaged_side).map(DamagedSide::from).collect()
}

/// The misfit between the impact and crush energies by a category of stiffness, or by the stiffness of the
/// fleet, where these sides were `hit`.
pub(crate) fn misfit(case: &Case, hit: &[DamagedSide], is_by_category: bool) -> CrushMisfit {
    let fitted = if is_by_category { FITTED.by_category(hit) } else { FITTED };
    if is_with_object(case, hit) { fitted.objects.misfit } else { fitted.crush_misfit(hit) }
}

/// The errors of the evidence when momentum and the crush energy are weighed.
///
/// That of the crush energy combines the bias and the spread that were fitted to real crashes: the bias
/// counts as an error because the bias of the stiffness in a file is unknown. On the RICSAC collisions it is
/// 0.5.
pub(crate) fn errors(case: &Case) -> EvidenceErrors {
    let CrushMisfit { bias, ln_sd } = FITTED.crush_misfit(&damaged_sides(case));
    EvidenceErrors {
        speed: SPEED_AFTER_ERROR,
        direction: DIRECTION_AFTER_ERROR,
        // σ = √(b² + σ_c²)
        crush_ln: (bias * bias + ln_sd * ln_sd).sqrt(),
    }
}
