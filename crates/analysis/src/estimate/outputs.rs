//! The results of each draw.

use ::estimate::Posterior;
use inputs::{Case, GivenVehicle};
use pim_core::VehicleId;

use super::impacts::{CaseImpacts, SkidNumbers};
use crate::output::Output;
use crate::quantities::{CRUSH_ENERGY, SKID_SPEED, SPEED};

/// The results that a case has: none for a fixed object, and those of a skid, of a path or of crush if there
/// is one.
pub(super) fn of(case: &Case, skids: &[Option<SkidNumbers>; 2], followed: [bool; 2]) -> Vec<Output> {
    let has_energy =
        |vehicle: &GivenVehicle| vehicle.has_damage_data() || vehicle.deformation_energy.is_some();
    let is_crushed = case.vehicles.iter().any(has_energy);
    let is_told = |output: &Output| {
        (is_crushed || !output.is(&CRUSH_ENERGY))
            && output.vehicle().is_none_or(|vehicle| {
                let id = vehicle.index();
                let is_seen = match output.quantity() {
                    row if row.is_of_path() => followed[id],
                    _ => !output.is(&SKID_SPEED) || skids[id].is_some(),
                };
                is_seen && !case.vehicles[id].fixed
            })
    };
    Output::drawn().into_iter().filter(is_told).collect()
}

impl CaseImpacts {
    /// The place of an output.
    pub(super) fn place(&self, wanted: Output) -> Option<usize> {
        self.outputs.iter().position(|output| *output == wanted)
    }

    /// The place among the outputs of the speed of a vehicle that moves.
    pub(super) fn speed_place(&self, id: VehicleId) -> Option<usize> {
        self.place(SPEED.of_vehicle(id))
    }

    /// Whether it is the speed of a vehicle that the case gives.
    pub(super) fn is_given(&self, output: Output) -> bool {
        let given = output.vehicle().filter(|_| output.is(&SPEED));
        given.is_some_and(|vehicle| !self.speeds.is_open(vehicle))
    }

    /// (SI) the draws of an output.
    pub(super) fn draws<'p>(&self, posterior: &'p Posterior, wanted: Output) -> Option<&'p [f64]> {
        posterior.outputs().get(self.place(wanted)?).map(Vec::as_slice)
    }

    /// (m/s) the draws of the speed of a vehicle that moves.
    pub(super) fn speed<'p>(&self, posterior: &'p Posterior, id: VehicleId) -> Option<&'p [f64]> {
        self.draws(posterior, SPEED.of_vehicle(id))
    }
}
