//! A vehicle that struck a fixed object.

use std::f64::consts::PI;

use evidence::{Behind, Collision, Fitted, Observed, ObservedVehicle, Speeds, VehicleNumbers};
use pim_core::VehicleId;
use uncertainty::InvalidDistribution;

use crate::collision::{Placed, Shape, normal, observed, outward};
use crate::crash::{Crash, PairKind};
use crate::figure::Figure;
use crate::pair::PairVehicle;

/// A vehicle that struck a fixed object, as an investigator recorded it.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectCrash {
    /// Number of the crash.
    pub case: String,
    /// The vehicle; its PDOF is 0 if it is not known.
    pub vehicle: PairVehicle,
    /// Whether its PDOF is known.
    pub has_pdof: bool,
    /// What it struck.
    pub kind: PairKind,
}

/// The kind of an object by NHTSA's code OBJCONT (CISS Analytical User's Manual).
pub(crate) fn kind_of_object(code: u32) -> PairKind {
    match code {
        // Trees; breakaway poles and posts; others by their diameter.
        41 | 42 | 45 | 50..=53 => PairKind::TreeOrPole,
        // Guardrails, faces and ends; barriers of concrete and others; walls, buildings, bridges.
        48 | 49 | 54 | 56 | 58 | 59 | 64 => PairKind::BarrierOrWall,
        _ => PairKind::OtherObject,
    }
}

impl Crash for ObjectCrash {
    const FIGURES: &'static [Figure] = &Figure::OF_OBJECTS;
    const IS_WITH_OBJECT: bool = true;

    fn case(&self) -> &str {
        &self.case
    }

    fn vehicle(&self, id: VehicleId) -> Option<&PairVehicle> {
        (id == VehicleId::One).then_some(&self.vehicle)
    }

    fn kind(&self) -> PairKind {
        self.kind
    }

    fn is_one_event(&self) -> Option<bool> {
        None
    }

    /// The object does not move and absorbs no energy; its surface lies against the damaged face.
    fn known(
        &self,
        _: Option<VehicleId>,
        fitted: &Fitted,
        given: &[VehicleId],
    ) -> Result<Collision, InvalidDistribution> {
        let (vehicle, shape) = (&self.vehicle, Shape::of(&self.vehicle));
        let placed = Placed { vehicle, shape: &shape, heading: [0.0; 2], width: shape.width };
        let object = VehicleNumbers {
            body: None,
            heading: 0.0.into(),
            contact: [0.0.into(), 0.0.into()],
            yaw_rate: 0.0.into(),
            crush: None,
        };
        let is_given = given.contains(&VehicleId::One);
        Ok(Collision {
            vehicles: [placed.vehicle(fitted)?, object],
            speeds: Speeds::Together { ln_relative: Speeds::any_ln_relative()?.into(), split: 0.0.into() },
            // n points from the object to the vehicle.
            crush_plane: normal(outward(vehicle.plane) + PI, fitted.crush_plane_sd)?,
            restitution: fitted.restitution_with(fitted.restitution_factor()?.into()),
            friction: fitted.any_friction()?.into(),
            tangential_share: fitted.any_tangential_share()?.into(),
            other_crush: None,
            observed: Observed {
                vehicles: [observed(vehicle, is_given, self.has_pdof, fitted), ObservedVehicle::default()],
                pdofs_differ: false,
                crush_is_bound: false,
                severity: Some(fitted.objects.severity),
                crush: Some(fitted.objects.misfit.into()),
                figures: fitted.objects.figures([vehicle.behind(), Behind::Nothing]),
            },
        })
    }
}
