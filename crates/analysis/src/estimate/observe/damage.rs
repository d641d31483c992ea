//! The damage: where each vehicle was hit, from which direction, and how well its energy is known.

use crash3::Side;
use evidence::{
    Behind, CodedPdof, CrushErrors, CrushFigures, DamagedSide, EnergyError, EnergyMethod, FITTED,
};
use inputs::{Case, CollisionData, GivenVehicle, KnownEnergy, StiffnessForm, VehicleData, table};
use pim_core::VehicleId;
use real::Real;

use super::{DEGREE, Subject};
use crate::damage::assess;
use crate::errors::{fitted, is_with_object, method_of, misfit};
use crate::estimate::notes::{Notes, Unused, UnusedReason};
use crate::uncertainty::UncertainInput;

/// (rad) half of the hour of a clock as a standard deviation, 30°/√12.
const HOUR_SD: f64 = 30.0 * DEGREE / 3.464_101_615_137_754_6;

/// The vehicles whose crush is evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Crushed {
    /// None, or there is no damage.
    No,
    /// One moving vehicle, of two that move.
    Of(VehicleId),
    /// All vehicles that move.
    All,
}

impl Crushed {
    /// The crush that is evidence, and the data that are not used.
    pub(crate) fn of(case: &Case, nominal: &CollisionData) -> (Self, Vec<Unused>) {
        let is_inferred = |id: VehicleId| {
            case.vehicles[id.index()].crush.as_ref().is_some_and(|crush| crush.from_force_balance)
        };
        let movers: Vec<VehicleId> = movers(case).collect();
        let inferred = movers.iter().filter(|id| is_inferred(**id));
        let mut unused: Vec<Unused> = inferred
            .map(|id| Unused { key: format!("{}.crush", table(*id)), reason: UnusedReason::Inferred })
            .collect();
        let is_known = |id: &VehicleId| case.vehicles[id.index()].has_damage_data() && !is_inferred(*id);
        let known: Vec<VehicleId> = movers.iter().copied().filter(is_known).collect();
        if known.is_empty() {
            let objects = VehicleId::ALL.into_iter().filter(|id| case.vehicles[id.index()].fixed);
            let with_energy = objects.filter(|id| case.vehicles[id.index()].deformation_energy.is_some());
            unused.extend(with_energy.map(|id| Unused {
                key: format!("{}.deformation_energy", table(id)),
                reason: UnusedReason::NoCrush,
            }));
            return (Self::No, unused);
        }
        let Ok(assessed) = assess(nominal.vehicles.clone(), [None, None]) else {
            return (Self::No, unused);
        };
        let deformation_energy = nominal.vehicles.iter().filter_map(|vehicle| vehicle.deformation_energy);
        let energies = known.iter().filter_map(|id| assessed[id.index()].crush_energy());
        if energies.chain(deformation_energy).sum::<f64>() <= 0.0 {
            let is_given =
                |id: &&VehicleId| !matches!(case.vehicles[id.index()].energy, Some(KnownEnergy::Undamaged));
            unused.extend(
                known.iter().filter(is_given).map(|id| Unused {
                    key: format!("{}.crush", table(*id)),
                    reason: UnusedReason::NoEnergy,
                }),
            );
            return (Self::No, unused);
        }
        let crushed = match known[..] {
            [one] if movers.len() > 1 => Self::Of(one),
            _ => Self::All,
        };
        (crushed, unused)
    }
}

/// The vehicles that can move.
pub(super) fn movers(case: &Case) -> impl Iterator<Item = VehicleId> {
    VehicleId::ALL.into_iter().filter(|id| !case.vehicles[id.index()].fixed)
}

/// Where a vehicle was hit: the side that the case gives or, without one, the side that meets the normal of
/// the crush plane.
pub(crate) fn damage(id: VehicleId, nominal: &CollisionData, reference: [f64; 2]) -> DamagedSide {
    let data = &nominal.vehicles[id.index()];
    let of_crush = data.damage.as_ref().map(|damage| damage.side);
    let side = of_crush.or_else(|| data.energy.and_then(|energy| energy.side));
    match side {
        Some(side) => side.into(),
        None => match reference[id.index()].abs() {
            from if from <= 45.0 * DEGREE => DamagedSide::Front,
            from if from < 135.0 * DEGREE => DamagedSide::Side,
            _ => DamagedSide::Rear,
        },
    }
}

/// How the crush energy of each vehicle was obtained, if its crush is evidence.
pub(crate) fn energies(crushed: Crushed, case: &Case) -> [Option<EnergyMethod>; 2] {
    VehicleId::ALL.map(|id| {
        let is_evidence = match crushed {
            Crushed::No => false,
            Crushed::Of(known) => known == id,
            Crushed::All => true,
        };
        let vehicle = &case.vehicles[id.index()];
        if vehicle.fixed {
            return vehicle.deformation_energy.filter(|_| is_evidence).map(|_| EnergyMethod::OfObject);
        }
        let by_depths = vehicle.crush.as_ref().map(|crush| match crush.stiffness {
            StiffnessForm::Line(_) | StiffnessForm::Zones(_) => EnergyMethod::Coefficients,
            StiffnessForm::Typical(typical) => method_of(typical),
            StiffnessForm::Test(_) => EnergyMethod::Test,
        });
        let by_speed = matches!(vehicle.energy, Some(KnownEnergy::Ees(_))).then_some(EnergyMethod::Ees);
        by_depths.or(by_speed).filter(|_| is_evidence)
    })
}

/// The errors of the crush energies, depending on how each was obtained, or as given by the case, and those
/// of the fitted figures among them.
pub(super) fn crush_errors(
    case: &Case,
    methods: [Option<EnergyMethod>; 2],
    ranges: &[UncertainInput],
    hit: &[DamagedSide],
    notes: &mut Notes,
) -> (CrushErrors, Option<CrushFigures>) {
    let given = case.estimate.unwrap_or_default();
    notes.default_error(given.crush_error.is_none(), "estimate.crush_error".to_owned());
    notes.default_error(given.crush_bias.is_none(), "estimate.crush_bias".to_owned());
    // Of two ways, the figures of energies by a category count.
    let counted = methods.into_iter().flatten().find(|method| *method == EnergyMethod::Class);
    let of = |id: VehicleId| {
        let method = methods[id.index()]?;
        let misfit = misfit(case, Some(method), hit);
        let has_range = ranges.iter().any(|range| {
            let key = range.input.path.strip_prefix(table(id)).unwrap_or_default();
            let of_energy = [".crush.stiffness", ".crush.ees", ".deformation_energy"];
            of_energy.iter().any(|start| key.starts_with(start))
        });
        let usual = FITTED.energy_error(method, misfit, case.vehicles[id.index()].model_year, has_range);
        if method == EnergyMethod::OfObject {
            // The errors of crush energies that a case gives do not apply to an object.
            return Some(usual);
        }
        Some(EnergyError {
            bias: given.crush_bias.map_or(usual.bias, |shown| real::elementary::ln(shown / 100.0)),
            shared_ln_sd: given.crush_error.map_or(usual.shared_ln_sd, |percent| percent / 100.0),
            own_ln_sd: if given.crush_error.is_some() { 0.0 } else { usual.own_ln_sd },
        })
    };
    let errors = match [of(VehicleId::One), of(VehicleId::Two)] {
        [Some(one), Some(two)] => CrushErrors([one, two]),
        // The energy of the other vehicle follows from that of this one, with all its errors.
        [Some(known), None] | [None, Some(known)] => {
            let EnergyError { bias, shared_ln_sd, own_ln_sd } = known;
            let whole = Real::sqrt(shared_ln_sd * shared_ln_sd + own_ln_sd * own_ln_sd);
            CrushErrors([EnergyError { bias, shared_ln_sd: whole, own_ln_sd: 0.0 }; 2])
        }
        [None, None] => misfit(case, None, hit).into(),
    };
    // Only the misfit of a typical stiffness was fitted.
    let behind = |method: Option<EnergyMethod>| match method {
        Some(EnergyMethod::Class | EnergyMethod::Fleet) => {
            Behind::Misfit { bias: given.crush_bias.is_none(), spread: given.crush_error.is_none() }
        }
        _ => Behind::Nothing,
    };
    let behind = match methods {
        [Some(_), Some(_)] => methods.map(behind),
        [known, None] | [None, known] => [behind(known); 2],
    };
    let fitted = fitted(counted, hit);
    let figures = if is_with_object(case, hit) {
        fitted.objects.figures(behind)
    } else {
        fitted.crush_figures(hit, behind)
    };
    (errors, figures)
}

/// The PDOF of a vehicle, with the error that the case gives or the default one.
pub(super) fn pdof(subject: Subject<'_>, data: &VehicleData, notes: &mut Notes) -> Option<CodedPdof> {
    coded_pdof(data, subject.given()).map(|coded| {
        let scale = subject.noted_sd("crush.pdof", notes);
        CodedPdof { scale: scale.unwrap_or(coded.scale), ..coded }
    })
}

/// The PDOF that the case gives for a vehicle itself.
fn coded_pdof(data: &VehicleData, vehicle: &GivenVehicle) -> Option<CodedPdof> {
    let pdof = data.force.pdof.filter(|_| !data.force.pdof_follows)?;
    let is_side = matches!(vehicle.damaged_side(), Some(Side::Left | Side::Right));
    let coded = FITTED.coded(pdof, is_side);
    let hour = if data.force.pdof_is_hour { HOUR_SD } else { 0.0 };
    Some(CodedPdof { scale: Real::sqrt(coded.scale * coded.scale + hour * hour), ..coded })
}
