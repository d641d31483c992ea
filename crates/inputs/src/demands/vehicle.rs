//! The data of one vehicle: mass and yaw inertia, body, contact point and damage.

use crash3::VehicleClass;
use pim_core::{Real, VehicleId};

use super::{Demand, table};
use crate::crush::Pdof;
use crate::data::{EnergyData, InertiaData, VehicleData};
use crate::dimensions::Dimensions;
use crate::estimate::{YawSource, class_yaw_inertia};
use crate::inertia::Mass;
use crate::purpose::Purpose;
use crate::vehicle::{GivenVehicle, Kind, Outline};

impl<T: Real> Demand<'_, T> {
    pub(super) fn subject(&mut self, id: VehicleId) -> Option<VehicleData<T>> {
        let vehicle = &self.case.vehicles[id.index()];
        let mut contact = self.contact_point(vehicle);
        let class = self.class(id, vehicle);
        let dimensions = dimensions(vehicle, class);
        if vehicle.fixed || vehicle.is_absent() {
            return Some(VehicleData {
                kind: None,
                inertia: None,
                contact,
                contact_is_placed: false,
                dimensions,
                damage: None,
                energy: None,
            });
        }
        let inertia = self.inertia(id, vehicle, class);
        let damage = match &vehicle.crush {
            Some(crush) => Some(self.damage(id, crush, dimensions)?),
            None => None,
        };
        let energy = vehicle.energy.map(|known| {
            let given = known.ees();
            EnergyData {
                ees: given.map(|given| given.ees.si()),
                side: given.and_then(|given| given.side),
                pdof: given.and_then(|given| given.pdof).map(|pdof| crash3::principal_angle(pdof.rad())),
                pdof_follows: false,
                pdof_is_hour: given.is_some_and(|given| matches!(given.pdof, Some(Pdof::Clock(_)))),
                moment_arm: given.and_then(|given| given.moment_arm).map(|arm| arm.si()),
            }
        });
        // The damage alone needs no point: its force acts through the centroid unless the case gives the arm.
        let needs_contact = self.purpose != Purpose::Crush && !self.is_of_point_masses;
        let contact_is_placed = vehicle.places_contact() && needs_contact;
        if let (true, Some(damage), Some(dimensions)) = (contact_is_placed, &damage, dimensions) {
            contact = Some(self.placed_contact(id, damage, dimensions)?);
        }
        Some(VehicleData {
            kind: vehicle.kind,
            inertia: Some(inertia?),
            contact,
            contact_is_placed,
            dimensions,
            damage,
            energy,
        })
    }

    pub(super) fn class(&mut self, id: VehicleId, vehicle: &GivenVehicle<T>) -> Option<(u8, VehicleClass)> {
        let class = vehicle.class?;
        self.accepted(format_args!("{}.class", table(id)), VehicleClass::new(class))
            .map(|known| (class, known))
    }

    /// A given inertia takes precedence over the class, and the class over Burg's estimate.
    fn inertia(
        &mut self,
        id: VehicleId,
        vehicle: &GivenVehicle<T>,
        class: Option<(u8, VehicleClass)>,
    ) -> Option<InertiaData<T>> {
        let table = table(id);
        let mass = vehicle.mass.as_ref().map(Mass::kg);
        let mass = self.given(
            mass,
            format_args!("{table}.weight"),
            "`weight = \"3696 lb\"` or `mass = \"1676 kg\"`",
        );
        let length = vehicle.outline.map(|outline| outline.length).or(vehicle.length);
        let factor = self.case.departures.yaw_radius[id.index()].unwrap_or(T::ONE);
        if let Some(yaw) = &vehicle.yaw {
            let mass = mass?;
            let yaw_inertia = Some(yaw.kg_m2(mass));
            return Some(InertiaData { mass, yaw_inertia, yaw_source: YawSource::Given });
        }
        if let Some((class, known)) = class {
            let mass = mass?;
            let yaw_inertia = Some(class_yaw_inertia(&known, mass, factor));
            return Some(InertiaData { mass, yaw_inertia, yaw_source: YawSource::Class(class) });
        }
        let is_car = vehicle.kind.unwrap_or_default() == Kind::Car;
        if let Some((wheelbase, length)) = vehicle.wheelbase.zip(length).filter(|_| is_car) {
            let mass = mass?;
            let estimate = crash3::yaw_inertia_burg(mass, wheelbase.si(), length.si());
            // I = m k²
            let estimate = self.accepted(format_args!("{table}.wheelbase"), estimate)?;
            let yaw_inertia = Some(estimate * factor * factor);
            return Some(InertiaData { mass, yaw_inertia, yaw_source: YawSource::Burg });
        }
        if self.case.vehicles[id.other().index()].is_absent() || self.is_of_point_masses {
            return Some(InertiaData { mass: mass?, yaw_inertia: None, yaw_source: YawSource::Unknown });
        }
        if !is_car {
            self.missing(
                format_args!("{table}.yaw_inertia"),
                "`yaw_inertia = \"2437 lb ft s^2\"` or the radius of gyration, `yaw_radius = \"1.40 m\"`; if neither is known, √((l² + w²)/12) is \
                 the radius of gyration of a body of length l and width w that is loaded evenly",
            );
            return None;
        }
        self.missing(
            format_args!("{table}.yaw_inertia"),
            "`yaw_inertia = \"2437 lb ft s^2\"` or the radius of gyration, `yaw_radius = \"1.40 m\"`; if neither is known, give \
             CRASH3's size class, `class = 3`, or both `wheelbase` and `length`",
        );
        None
    }
}

fn dimensions<T: Real>(
    vehicle: &GivenVehicle<T>,
    class: Option<(u8, VehicleClass)>,
) -> Option<Dimensions<T>> {
    let given = vehicle.outline.as_ref().map(Outline::dimensions);
    given.or(class.map(|(class, known)| Dimensions::of_class(class, &known)))
}
