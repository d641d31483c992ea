//! The vehicle and the speed that `[avoid]` asks about, and the collision without the question.

use std::borrow::Cow;

use pim_core::VehicleId;

use super::Case;
use crate::avoid::SpeedForm;
use crate::quantity::Quantity;
use crate::vehicle::Velocity;

impl<T: Copy> Case<T> {
    /// The vehicle whose driver `[avoid]` asks about.
    #[must_use]
    pub fn avoid_subject(&self) -> VehicleId {
        self.avoid.as_ref().and_then(|avoid| avoid.vehicle).unwrap_or(VehicleId::One)
    }

    /// The speed of that vehicle, and its source. A speed to be found does not count as known, even if the
    /// file gives it.
    #[must_use]
    pub fn avoid_speed(&self) -> SpeedForm<T> {
        let subject = self.avoid_subject();
        if let Some(speed) = self.avoid.as_ref().and_then(|avoid| avoid.speed.as_ref()) {
            return SpeedForm::AtDemand(speed.quantity);
        }
        if self.vehicles[subject.index()].phases().first().is_some_and(|phase| phase.form.leads_on()) {
            return SpeedForm::ByPhases;
        }
        self.known_speed(subject).map_or(SpeedForm::Sought, |speed| SpeedForm::AtImpact(*speed))
    }

    /// (m/s) the speed of a vehicle at the impact, if its table has it and it is not sought.
    pub(crate) fn known_speed(&self, vehicle: VehicleId) -> Option<&Quantity<T>> {
        let is_sought = self.reconstruct.as_ref().is_some_and(|reconstruct| reconstruct.find.seeks(vehicle));
        match &self.vehicles[vehicle.index()].motion {
            Some(Velocity::Speed(speed)) if !is_sought => Some(speed),
            _ => None,
        }
    }
}

impl Case {
    /// The collision without the question of `[avoid]`, whose numbers no other analysis uses.
    #[must_use]
    pub fn without_avoid(&self) -> Cow<'_, Self> {
        if self.avoid.is_none() {
            return Cow::Borrowed(self);
        }
        let mut case = Self { avoid: None, ..self.clone() };
        for before in case.vehicles.iter_mut().filter_map(|vehicle| vehicle.before.as_mut()) {
            before.phases.clear();
        }
        case.ranges.retain(|range| !is_of_avoid(&range.path));
        for error in &mut case.uncertainty.shared {
            error.of.retain(|key| !is_of_avoid(key));
        }
        case.uncertainty.shared.retain(|error| !error.of.is_empty());
        Cow::Owned(case)
    }
}

/// Whether a key belongs only to the question whether the collision was avoidable.
#[must_use]
pub fn is_of_avoid(path: &str) -> bool {
    path.starts_with("avoid.") || path.contains(".before.phase")
}
