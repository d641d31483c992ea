//! Mass and yaw inertia, from the values in the file.

use analysis::{Seen, Vehicle};
use case::{Case, Mass, Quantity, YawInertia, YawSource};
use pim_core::VehicleId;

use super::numbers::Amount;
use super::{Draft, DraftGroup, group, step};

pub(super) fn groups(case: &Case, analysis: &Seen) -> Vec<DraftGroup> {
    let steps = VehicleId::ALL
        .into_iter()
        .zip(case.vehicles.iter().zip(&analysis.vehicles))
        .flat_map(|(k, (given, vehicle))| of_vehicle(given, vehicle, k))
        .collect();
    vec![group("Mass and yaw inertia", steps)]
}

/// A number of the file, converted if its unit is not that of the reader's equations.
fn input(name: String, symbol: String, quantity: &Quantity, unit: &'static str) -> Draft {
    let own = [(symbol.clone(), Amount::Given(*quantity, unit))];
    let step = step(name, symbol.clone(), (quantity.si(), unit), "input").equals(symbol).with(own);
    Draft { input: Some(*quantity), ..step }
}

/// A mass in kg: a weight divided by the standard gravity, as in the program.
pub(super) fn mass(written: &Mass, name: String, of: &str) -> Draft {
    let symbol = format!("m_{of}");
    match written {
        Mass::Mass(mass) => input(name, symbol, mass, "kg"),
        // m = W/g
        Mass::Weight(weight) => step(name, symbol, (written.kg(), "kg"), "theory 1")
            .equals(format!("W_{of}/g"))
            .with([(format!("W_{of}"), Amount::Given(*weight, "N"))]),
    }
}

fn of_vehicle(written: &case::GivenVehicle, vehicle: &Vehicle, k: VehicleId) -> Vec<Draft> {
    let (Some(inertia), Some(written_mass)) = (vehicle.subject.inertia, &written.mass) else {
        return Vec::new();
    };
    let mut steps = vec![mass(written_mass, format!("mass of vehicle {k}"), &k.to_string())];
    let Some(yaw_inertia) = inertia.yaw_inertia else { return steps };
    let (name, symbol, radius) = (format!("yaw inertia of vehicle {k}"), format!("I_{k}"), format!("k_{k}"));
    // I = m k²
    let by_radius = || {
        let value = (yaw_inertia, "kg·m²");
        step(&name, &symbol, value, "theory 1").equals(format!("m_{k} {radius}²"))
    };
    let name_of_radius = format!("radius of gyration of vehicle {k}");
    match (inertia.yaw_source, &written.yaw) {
        (YawSource::Given, Some(YawInertia::Inertia(given))) => {
            steps.push(input(name, symbol, given, "kg·m²"));
        }
        (YawSource::Given, Some(YawInertia::Radius(given))) => {
            steps.push(input(name_of_radius, radius.clone(), given, "m"));
            steps.push(by_radius());
        }
        (YawSource::Class(class), _) => {
            let Ok(known) = crash3::VehicleClass::new(class) else { return steps };
            let name = format!("{name_of_radius}, from class {class} of CRASH3's table");
            steps.push(step(name, &radius, (known.yaw_radius, "m"), "theory 5"));
            steps.push(by_radius());
        }
        (YawSource::Burg, _) => {
            let length = written.outline.map(|outline| outline.length).or(written.length);
            let Some((wheelbase, length)) = written.wheelbase.zip(length) else { return steps };
            steps.push(input(format!("wheelbase of vehicle {k}"), format!("wheelbase_{k}"), &wheelbase, "m"));
            steps.push(input(format!("length of vehicle {k}"), format!("length_{k}"), &length, "m"));
            let name = format!("{name}, by Burg's formula");
            steps.push(
                step(name, symbol, (yaw_inertia, "kg·m²"), "theory 5")
                    .equals(format!("{} · m_{k} · wheelbase_{k} · length_{k}", crash3::BURG)),
            );
        }
        (YawSource::Given, None) | (YawSource::Unknown, _) => {}
    }
    steps
}
