//! The errors of the evidence of momentum and of crush.

use evidence::{CrushMisfit, DamagedSide, EnergyMethod, FITTED, Fitted};
use inputs::{Case, GivenVehicle, TypicalStiffness};
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

/// How a crush energy by a typical stiffness was obtained.
pub(crate) fn method_of(typical: TypicalStiffness) -> EnergyMethod {
    match typical {
        TypicalStiffness::Category(_) => EnergyMethod::Class,
        TypicalStiffness::Fleet => EnergyMethod::Fleet,
    }
}

/// The figures of crush energies that were obtained in this way, where these sides were `hit`: those by a
/// category have a misfit of their own.
pub(crate) fn fitted(method: Option<EnergyMethod>, hit: &[DamagedSide]) -> Fitted {
    if method == Some(EnergyMethod::Class) { FITTED.by_category(hit) } else { FITTED }
}

/// The misfit between the impact and such crush energies.
pub(crate) fn misfit(case: &Case, method: Option<EnergyMethod>, hit: &[DamagedSide]) -> CrushMisfit {
    let fitted = fitted(method, hit);
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
