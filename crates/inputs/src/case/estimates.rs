//! Estimates in place of data that a case does not give.

use pim_core::VehicleId;

use super::Case;
use crate::estimate::{
    ContactSpread, DAMAGE_LENGTH_SD, DEPTH_SD, EstimatedInput, FaceAxis, OFFSET_SD, YawSource,
};

impl<T: Copy + From<f64>> Case<T> {
    /// Whether the stiffness of each vehicle is that of many cars, its radius of gyration from a class or a
    /// formula, and the contact point of an impact from the damage.
    #[must_use]
    pub fn estimates(&self) -> Vec<EstimatedInput> {
        let of = |vehicle: VehicleId| {
            let given = &self.vehicles[vehicle.index()];
            let typical = given.crush.as_ref().and_then(|crush| crush.stiffness.typical());
            let source = given
                .yaw_form(T::from(1.0))
                .map(|yaw| yaw.source())
                .filter(|source| *source != YawSource::Given);
            let stiffness = typical.map(|typical| EstimatedInput::Stiffness { vehicle, typical });
            let yaw_radius = source.map(|source| EstimatedInput::YawRadius { vehicle, source });
            let is_placed = self.impact.is_some() && given.places_contact();
            let contact =
                FaceAxis::ALL.map(|axis| is_placed.then_some(EstimatedInput::Contact { vehicle, axis }));
            [stiffness, yaw_radius].into_iter().chain(contact).flatten().filter(|_| !given.fixed)
        };
        VehicleId::ALL.into_iter().flat_map(of).collect()
    }
}

impl Case {
    /// The spread of a vehicle's contact point that is placed at the centroid of the damage.
    ///
    /// Along the face, its error is that of the middle of the damage: the error of the offset and half that
    /// of the length, since an error at one end moves the middle by half as much. Both are taken as
    /// independent, which is on the safe side: the error of an end may be part of that of the offset already.
    /// Across the face, its error is that of one depth. The errors of several depths move their centroid by
    /// less, but they were measured after the impact, and the force acted when the crush was at its deepest.
    ///
    /// An error that the case gives itself is not counted again. If the `offset` has one, it is the only
    /// error of the middle of the damage; an error of `width` or `spacing` replaces that of the length, and
    /// one of the `depths` the error across the face.
    #[must_use]
    pub fn contact_spread(&self, vehicle: VehicleId, axis: FaceAxis) -> ContactSpread {
        let table = format!("vehicle{vehicle}");
        let has_error = |key: &str| self.has_error(&format!("{table}.crush.{key}"));
        let is_exact = || self.uncertainty.exact.contains(&format!("{table}.contact"));
        match axis {
            FaceAxis::Along if has_error("offset") => ContactSpread::OfInputs,
            FaceAxis::Inward if has_error("depths") => ContactSpread::OfInputs,
            _ if is_exact() => ContactSpread::Exact,
            FaceAxis::Along if has_error("width") || has_error("spacing") => {
                ContactSpread::Default(OFFSET_SD)
            }
            FaceAxis::Along => {
                let half_length_sd = DAMAGE_LENGTH_SD / 2.0;
                // σ = √(σ_D² + (σ_L/2)²)
                ContactSpread::Default((OFFSET_SD * OFFSET_SD + half_length_sd * half_length_sd).sqrt())
            }
            FaceAxis::Inward => ContactSpread::Default(DEPTH_SD),
        }
    }
}
