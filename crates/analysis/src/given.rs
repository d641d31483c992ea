//! The speed that a case gives for a vehicle, in any of its forms.

use inputs::{Case, CourseForm, Dimension, GivenVehicle, Quantity, Velocity};
use pim_core::{Motion, VehicleId};
use real::principal_angle;

use crate::impact::speed_along;
use crate::thresholds::FASTEST_BELIEVED;

/// Speed and direction of a vehicle, whether given as a speed, as a speed with a sideslip or as a vector.
#[derive(Clone, Copy)]
pub(crate) struct GivenSpeed {
    /// (m/s) along the course: negative backward.
    pub(crate) speed: f64,
    /// (rad) the direction of travel or, if the vehicle moves backward, its opposite; `None` if the case
    /// gives no heading.
    pub(crate) course: Option<f64>,
}

impl GivenSpeed {
    /// `None` if the case gives no velocity.
    pub(crate) fn of(case: &Case, id: VehicleId) -> Option<Self> {
        let motion = case.vehicles[id.index()].motion?;
        Some(match motion {
            Velocity::Speed(speed) => Self { speed: speed.si(), course: case.courses()[id.index()] },
            Velocity::Vector { x, y } => {
                let heading = case.headings()[id.index()]?;
                let course = CourseForm::Along { x, y }.rad(case.axes, heading).unwrap_or(heading);
                let unit = Motion::along(course, 1.0).velocity;
                Self { speed: speed_along(unit, motion.vector(case.axes, course)), course: Some(course) }
            }
        })
    }

    /// The same for a vehicle whose speed is not to be found.
    pub(crate) fn of_known(case: &Case, id: VehicleId) -> Option<Self> {
        let is_sought = case.reconstruct.is_some_and(|reconstruct| reconstruct.find.seeks(id));
        if is_sought { None } else { Self::of(case, id) }
    }
}

/// (m/s) the limits that a case gives for the speed of a vehicle.
pub(crate) fn certain_limits(vehicle: &GivenVehicle) -> [Option<f64>; 2] {
    let certain = vehicle.certain_speed.unwrap_or_default();
    [certain.at_least, certain.at_most].map(|limit| limit.as_ref().map(Quantity::si))
}

/// (m/s) the limits within which the speed of a vehicle is taken to lie: those that the case gives, and
/// otherwise from 0 to [`FASTEST_BELIEVED`].
pub(crate) fn speed_limits(vehicle: &GivenVehicle) -> [f64; 2] {
    let [least, most] = certain_limits(vehicle);
    let (least, most) = (least.unwrap_or(0.0), most.unwrap_or(FASTEST_BELIEVED));
    // A limit below zero means that the vehicle may have moved backward.
    [if most <= least { most - FASTEST_BELIEVED } else { least }, most]
}

/// Writes the vector of a vehicle as a speed and a sideslip, which keeps its direction.
pub(crate) fn with_sideslip(case: &mut Case, id: VehicleId) {
    let vector = case.vehicles[id.index()].motion.filter(|given| matches!(given, Velocity::Vector { .. }));
    let (Some(_), Some(given)) = (vector, GivenSpeed::of(case, id)) else { return };
    let off = given.course.zip(case.headings()[id.index()]);
    let sideslip = off.map(|(course, heading)| case.axes.lateral(principal_angle(course - heading)));
    let quantity = |si: f64, dimension| Quantity::from_si(si, dimension).ok();
    let vehicle = &mut case.vehicles[id.index()];
    vehicle.motion = quantity(given.speed, Dimension::Speed).map(Velocity::Speed);
    vehicle.sideslip = sideslip.and_then(|sideslip| quantity(sideslip, Dimension::Angle));
}
