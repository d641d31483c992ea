//! Mass and yaw inertia, from the values in the file.

use analysis::{Seen, Vehicle};
use case::{Case, Mass, Quantity, STANDARD_GRAVITY, YawInertia, YawSource};
use pim_core::VehicleId;

use super::{Step, StepGroup, converted, group, n, name_of, p, step};

pub(super) fn groups(case: &Case, analysis: &Seen) -> Vec<StepGroup> {
    let steps = VehicleId::ALL
        .into_iter()
        .zip(case.vehicles.iter().zip(&analysis.vehicles))
        .flat_map(|(k, (given, vehicle))| of_vehicle(given, vehicle, k))
        .collect();
    vec![group("Mass and yaw inertia", steps)]
}

/// A number of the file, converted if its unit is not that of the reader's equations.
fn input(name: String, symbol: String, quantity: &Quantity, unit: &'static str) -> Step {
    let formula = format!("as given, in {}", name_of(unit));
    let step = step(name, symbol).equals(formula, converted(quantity, unit)).is(quantity.si(), unit, "input");
    Step { input: Some(*quantity), ..step }
}

/// A mass in kg: a weight divided by the standard gravity, as in the program.
pub(super) fn mass(written: &Mass, name: String, of: &str) -> Step {
    let symbol = format!("m_{of}");
    match written {
        Mass::Mass(mass) => input(name, symbol, mass, "kg"),
        // m = W/g
        Mass::Weight(weight) => step(name, symbol)
            .equals(
                format!("W_{of}/g"),
                format!("{} / {}", converted(weight, "N"), n(STANDARD_GRAVITY, "m/s²")),
            )
            .is(written.kg(), "kg", "theory 1"),
    }
}

fn of_vehicle(written: &case::GivenVehicle, vehicle: &Vehicle, k: VehicleId) -> Vec<Step> {
    let (Some(inertia), Some(written_mass)) = (vehicle.subject.inertia, &written.mass) else {
        return Vec::new();
    };
    let mut steps = vec![mass(written_mass, format!("mass of vehicle {k}"), &k.to_string())];
    let Some(yaw_inertia) = inertia.yaw_inertia else { return steps };
    let name = format!("yaw inertia of vehicle {k}");
    let symbol = format!("I_{k}");
    // I = m k²
    let by_radius = |name: String, radius: f64| {
        step(name, format!("I_{k}"))
            .equals(format!("m_{k} k_{k}²"), format!("{} · {}²", n(inertia.mass, "kg"), p(radius, "m")))
            .is(yaw_inertia, "kg·m²", "theory 1")
    };
    match (inertia.yaw_source, &written.yaw) {
        (YawSource::Given, Some(YawInertia::Inertia(given))) => {
            steps.push(input(name, symbol, given, "kg·m²"));
        }
        (YawSource::Given, Some(YawInertia::Radius(radius))) => {
            steps.push(input(format!("radius of gyration of vehicle {k}"), format!("k_{k}"), radius, "m"));
            steps.push(by_radius(name, radius.si()));
        }
        (YawSource::Class(class), _) => {
            let Ok(known) = crash3::VehicleClass::new(class) else { return steps };
            let name_of_radius =
                format!("radius of gyration of vehicle {k}, from class {class} of CRASH3's table");
            steps.push(step(name_of_radius, format!("k_{k}")).is(known.yaw_radius, "m", "theory 5"));
            steps.push(by_radius(name, known.yaw_radius));
        }
        (YawSource::Burg, _) => {
            let length = written.outline.map(|outline| outline.length).or(written.length);
            let Some((wheelbase, length)) = written.wheelbase.zip(length) else { return steps };
            steps.push(input(format!("wheelbase of vehicle {k}"), format!("wheelbase_{k}"), &wheelbase, "m"));
            steps.push(input(format!("length of vehicle {k}"), format!("length_{k}"), &length, "m"));
            steps.push(
                step(format!("{name}, by Burg's formula"), symbol)
                    .equals(
                        format!("{} · m_{k} · wheelbase_{k} · length_{k}", crash3::BURG),
                        format!(
                            "{} · {} · {} · {}",
                            crash3::BURG,
                            n(inertia.mass, "kg"),
                            n(wheelbase.si(), "m"),
                            n(length.si(), "m")
                        ),
                    )
                    .is(yaw_inertia, "kg·m²", "theory 5"),
            );
        }
        (YawSource::Given, None) | (YawSource::Unknown, _) => {}
    }
    steps
}
