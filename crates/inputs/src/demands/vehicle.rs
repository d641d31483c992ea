//! The data of one vehicle: mass and yaw inertia, body, contact point and damage.

use crash3::VehicleClass;
use pim_core::{Real, VehicleId};

use super::{Demand, table};
use crate::crush::{KnownEnergy, Pdof};
use crate::data::{EnergyData, ForceData, InertiaData, VehicleData};
use crate::dimensions::Dimensions;
use crate::estimate::YawSource;
use crate::form::{ContactForm, DamageForm, VehicleForm};
use crate::purpose::Purpose;
use crate::quantity::Quantity;
use crate::vehicle::{GivenVehicle, VehicleKind};

impl<T: Real> Demand<'_, T> {
    pub(super) fn subject(&mut self, id: VehicleId) -> Option<VehicleData<T>> {
        let vehicle = &self.case.vehicles[id.index()];
        let form = self.case.vehicle_form(id);
        let mut contact = self.contact_point(vehicle);
        self.class(id, vehicle);
        let class = vehicle.class.filter(|_| vehicle.outline.is_none());
        let dimensions = form.body.map(|body| Dimensions { class, ..body.dimensions() });
        if vehicle.fixed || vehicle.is_absent() {
            return Some(VehicleData {
                kind: None,
                inertia: None,
                contact,
                contact_is_placed: false,
                dimensions,
                deformation_energy: vehicle.deformation_energy.as_ref().map(Quantity::si),
                damage: None,
                energy: None,
                force: ForceData::UNKNOWN,
            });
        }
        let inertia = self.inertia(id, vehicle, &form);
        let damage = match form.damage {
            DamageForm::Measured(crush) | DamageForm::Inferred(crush) => {
                Some(self.damage(id, &crush, dimensions)?)
            }
            DamageForm::Unknown | DamageForm::Undamaged | DamageForm::OfObject(_) | DamageForm::Ees(_) => {
                None
            }
        };
        let ees = vehicle.energy.as_ref().and_then(KnownEnergy::ees);
        let energy = vehicle.energy.map(|_| EnergyData {
            ees: ees.map(|given| given.ees.si()),
            side: ees.and_then(|given| given.side),
        });
        let of_crush = vehicle.crush.as_ref().map(|crush| (crush.pdof, crush.moment_arm));
        let of_ees = ees.map(|given| (given.pdof, given.moment_arm));
        let (pdof, moment_arm) = of_crush.or(of_ees).unwrap_or_default();
        let force = ForceData {
            pdof: pdof.map(|pdof| crash3::principal_angle(pdof.rad())),
            pdof_follows: false,
            pdof_is_hour: matches!(pdof, Some(Pdof::Clock(_))),
            moment_arm: moment_arm.as_ref().map(Quantity::si),
        };
        // The damage alone needs no point: its force acts through the centroid unless the case gives the arm.
        let needs_contact = self.purpose != Purpose::Crush && !self.is_of_point_masses;
        let contact_is_placed = vehicle.places_contact() && needs_contact;
        if let (true, Some(ContactForm::Placed(placed)), Some(damage)) =
            (contact_is_placed, form.contact, &damage)
        {
            contact = Some(self.placed_contact(id, &placed, damage)?);
        }
        Some(VehicleData {
            kind: vehicle.kind,
            inertia: Some(inertia?),
            contact,
            contact_is_placed,
            dimensions,
            deformation_energy: None,
            damage,
            energy,
            force,
        })
    }

    pub(super) fn class(&mut self, id: VehicleId, vehicle: &GivenVehicle<T>) -> Option<(u8, VehicleClass)> {
        let class = vehicle.class?;
        self.accepted(format_args!("{}.class", table(id)), VehicleClass::new(class))
            .map(|known| (class, known))
    }

    fn inertia(
        &mut self,
        id: VehicleId,
        vehicle: &GivenVehicle<T>,
        form: &VehicleForm<'_, T>,
    ) -> Option<InertiaData<T>> {
        let table = table(id);
        let mass = form.mass.map(|mass| mass.kg());
        let mass = self.given(
            mass,
            format_args!("{table}.weight"),
            "`weight = \"3696 lb\"` or `mass = \"1676 kg\"`",
        );
        if let Some(yaw) = form.yaw {
            let mass = mass?;
            // Burg's formula alone refuses anything.
            let yaw_inertia = Some(self.accepted(format_args!("{table}.wheelbase"), yaw.kg_m2(mass))?);
            return Some(InertiaData { mass, yaw_inertia, yaw_source: yaw.source() });
        }
        if self.case.vehicles[id.other().index()].is_absent() || self.is_of_point_masses {
            return Some(InertiaData { mass: mass?, yaw_inertia: None, yaw_source: YawSource::Unknown });
        }
        if vehicle.kind.unwrap_or_default() != VehicleKind::Car {
            let even = "√((l² + w²)/12) is the value for a body of length l and width w with evenly distributed mass";
            let example = match form.body.map(|body| body.quantities().map(|quantity| quantity.si().value()))
            {
                Some([length, width, _]) => {
                    let radius = Real::sqrt((length * length + width * width) / 12.0);
                    format!("its radius of gyration, such as `yaw_radius = \"{radius:.2} m\"`: {even}")
                }
                None => format!(
                    "its radius of gyration, `yaw_radius`, or `yaw_inertia`: if neither is known, {even}"
                ),
            };
            self.missing(format_args!("{table}.yaw_inertia"), &example);
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
