//! Contradictions of a case that no purpose allows.

use pim_core::VehicleId;

use super::table;
use crate::case::Find;
use crate::estimate::TypicalStiffness;
use crate::fault::Fault;
use crate::recorder::CertainSpeed;
use crate::vehicle::{GivenVehicle, VehicleKind, Velocity};

/// Known speeds of vehicles that lie outside of their certain limits.
#[must_use]
pub fn uncertain_speeds(vehicles: &[GivenVehicle; 2], find: Option<Find>) -> Vec<Fault> {
    let of = |id: VehicleId| {
        let vehicle = &vehicles[id.index()];
        let Some(Velocity::Speed(speed)) = &vehicle.motion else { return None };
        let CertainSpeed { at_least, at_most } = vehicle.certain_speed?;
        let is_below = at_least.is_some_and(|least| speed.si() < least.si());
        let is_beyond = at_most.is_some_and(|most| speed.si() > most.si());
        let is_known = !find.is_some_and(|find| find.seeks(id));
        (is_known && (is_below || is_beyond)).then(|| {
            let table = table(id);
            Fault::refused(
                format_args!("{table}.certain_speed"),
                format_args!("the speed of [{table}] is outside of the limits that are certain"),
                "correct one of them; if the speed is to be found, remove `speed`",
            )
        })
    };
    VehicleId::ALL.into_iter().filter_map(of).collect()
}

/// Contradictions between the vehicles of a case and the speed to find, which no purpose allows.
#[must_use]
pub fn contradictions<T>(vehicles: &[GivenVehicle<T>; 2], find: Option<Find>) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut contradiction =
        |key: &str, reason: &str, advice: &str| faults.push(Fault::refused(key, reason, advice));
    let fixed = VehicleId::ALL
        .into_iter()
        .find(|id| vehicles[id.index()].fixed && find.is_some_and(|find| find.seeks(*id)));
    if vehicles.iter().all(|vehicle| vehicle.fixed) {
        contradiction(
            "vehicle2.fixed",
            "both vehicles are fixed, so nothing can collide",
            "remove fixed = true from the one that can move",
        );
    } else if let Some(id) = fixed {
        contradiction(
            "reconstruct.find",
            &format!("\"reconstruct.find\" asks for the speed of [{}], which is fixed", table(id)),
            &format!("write find = \"{}.speed\"", table(id.other())),
        );
    }
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(vehicles) {
        let Some(kind) = vehicle.kind.filter(|kind| *kind != VehicleKind::Car) else { continue };
        let (table, kind) = (table(id), kind.name());
        if vehicle.class.is_some() {
            contradiction(
                &format!("{table}.class"),
                &format!("CRASH3's size classes are for passenger cars, but [{table}] has kind = \"{kind}\""),
                "remove `class`, and give yaw_inertia or yaw_radius, and length, width and cg_to_front",
            );
        }
        let (key, what) = match vehicle.crush.as_ref().and_then(|crush| crush.stiffness.typical()) {
            Some(TypicalStiffness::Category(_)) => {
                ("crush.stiffness.category", "CRASH3's stiffness categories are for passenger cars")
            }
            Some(TypicalStiffness::Fleet) => {
                ("crush.stiffness", "the stiffness of the fleet is that of passenger cars")
            }
            None => continue,
        };
        contradiction(
            &format!("{table}.{key}"),
            &format!("{what}, but [{table}] has kind = \"{kind}\""),
            "give A and B of its structure, or a test",
        );
    }
    let inferred =
        |id: VehicleId| vehicles[id.index()].crush.as_ref().is_some_and(|crush| crush.from_force_balance);
    if VehicleId::ALL.into_iter().all(inferred) {
        contradiction(
            "vehicle2.crush.from_force_balance",
            "both vehicles take their crush from the force balance, so neither crush was measured",
            "give the width and depths of the inspected vehicle, and remove its from_force_balance",
        );
    } else if let Some(id) =
        VehicleId::ALL.into_iter().find(|id| inferred(*id) && vehicles[id.other().index()].crush.is_none())
    {
        let [vehicle, other] = [table(id), table(id.other())];
        contradiction(
            &format!("{vehicle}.crush.from_force_balance"),
            &format!(
                "[{vehicle}.crush] takes its crush from the force balance, but [{other}] has no measured crush"
            ),
            &format!("add [{other}.crush] with side, width, depths and stiffness"),
        );
    }
    faults
}
