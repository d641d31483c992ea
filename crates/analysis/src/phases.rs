//! How fast a vehicle was before the impact, by its phases from a known speed on.

use inputs::{GivenVehicle, PhaseForm, Quantity};
use pim_core::InvalidInput;
use time_distance::{Leg, Phase, approach};

/// The speeds (m/s) where the phases begin and where the last ends, followed onward from the first.
pub(crate) fn starts(phases: &[PhaseForm]) -> Result<Vec<f64>, InvalidInput> {
    let mut speed = phases.first().and_then(|phase| phase.speed.as_ref()).map_or(0.0, Quantity::si);
    let mut starts = vec![speed];
    for form in phases {
        let [distance, time, acceleration] =
            [&form.distance, &form.time, &form.acceleration].map(|given| given.as_ref().map(Quantity::si));
        // A motion seen backwards has the opposite acceleration.
        let backwards = match (distance, time, acceleration) {
            (Some(distance), Some(time), _) => Phase::OverFor { distance, time },
            (Some(distance), None, Some(a)) => Phase::Over { distance, acceleration: -a },
            (None, Some(time), Some(a)) => Phase::For { time, acceleration: -a },
            _ => Phase::For { time: 0.0, acceleration: 0.0 },
        };
        speed = match approach(&Leg { speed, ..Leg::at_rest(0.0, 0.0) }, backwards) {
            Err(InvalidInput::GainsMore { end }) => return Err(InvalidInput::StopsWithin { start: end }),
            ends => ends?.speed,
        };
        starts.push(speed);
    }
    Ok(starts)
}

/// (m/s) the speed at the impact to which the phases of a vehicle lead from a known one; `None` if they do
/// not begin with one, or cannot be.
pub(crate) fn speed_at_impact(vehicle: &GivenVehicle) -> Option<f64> {
    let forms: Vec<PhaseForm> = vehicle.phases().iter().map(|phase| phase.form).collect();
    forms.first().filter(|first| first.leads_on())?;
    starts(&forms).ok()?.last().copied()
}
