//! CRASH3's velocity changes.

use analysis::{Crash3, Seen, Vehicle};
use case::Axes;
use crash3::EnergyBasis;
use pim_core::VehicleId;

use super::super::damage::total;
use super::super::{Draft, angle, n, step};
use super::pdof_symbol;

pub(super) fn steps(analysis: &Seen, axes: Axes) -> Vec<Draft> {
    let Some(crash3) = &analysis.crash3 else { return Vec::new() };
    let has_inertia = |k: &VehicleId| {
        analysis.vehicles[k.index()].subject.inertia.is_some_and(|inertia| inertia.yaw_inertia.is_some())
    };
    let vehicles: Vec<VehicleId> = VehicleId::ALL.into_iter().filter(has_inertia).collect();
    let mut steps = Vec::new();
    for &k in &vehicles {
        steps.push(moment_arm(analysis, crash3, k, axes));
        steps.extend(effective_mass(crash3, k));
    }
    steps.push(total(analysis, "", Vehicle::crush_energy, crash3.crush_energy, "Eq 5"));
    // ΔV_1 is that of the impulse.
    steps.extend(changes(&vehicles, "uncorrected", ["", "ΔV_CRASH3,"], crash3.delta_v));
    if let Some(corrected) = crash3.corrected {
        steps.push(total(analysis, "'", Vehicle::corrected_crush_energy, corrected.crush_energy, "Eq 8"));
        let name = "corrected for the oblique force";
        steps.extend(changes(&vehicles, name, ["'", "ΔV'_"], corrected.delta_v));
        steps.extend(with_restitution(analysis, crash3, &vehicles, corrected.delta_v));
    }
    steps
}

/// h, from the contact point or the centroid if it follows from one of them.
fn moment_arm(analysis: &Seen, crash3: &Crash3, k: VehicleId, axes: Axes) -> Draft {
    let vehicle = &analysis.vehicles[k.index()];
    // Across the force, which comes from the PDOF, clockwise in any axes.
    let left = match axes {
        Axes::ZUp => "+",
        Axes::ZDown => "−",
    };
    let damage = vehicle.damage.as_ref();
    let direction = pdof_symbol(vehicle, k);
    let of = |source: &'static str| {
        let name = format!("distance of the line of action from CG {k}");
        step(name, format!("h_{k}"), (crash3.moment_arm[k.index()], "m"), source)
    };
    let point = vehicle.subject.contact.or(damage.and_then(|damage| damage.centroid));
    match (vehicle.subject.force.moment_arm, point, vehicle.crash3_pdof()) {
        (None, Some([x, y]), Some(pdof)) => of("theory 5")
            .equals(format!("|x_{k} sin {direction} {left} y_{k} cos {direction}|"))
            .with([(format!("x_{k}"), n(x, "m")), (format!("y_{k}"), n(y, "m")), (direction, angle(pdof))]),
        _ => of("input"),
    }
}

/// k² and γ.
fn effective_mass(crash3: &Crash3, k: VehicleId) -> [Draft; 2] {
    let (square, ratio) = (crash3.square_radius[k.index()], crash3.effective_mass_ratio[k.index()]);
    let name = format!("square of the radius of gyration, vehicle {k}");
    [
        step(name, format!("k_{k}²"), (square, "m²"), "theory 5").equals(format!("I_{k}/m_{k}")),
        step(format!("effective mass ratio, vehicle {k}"), format!("γ_{k}"), (ratio, ""), "theory 5")
            .equals(format!("k_{k}²/(k_{k}² + h_{k}²)")),
    ]
}

/// ΔV of each vehicle, with a common normal velocity.
fn changes(vehicles: &[VehicleId], name: &str, [prime, symbol]: [&str; 2], delta_v: [f64; 2]) -> Vec<Draft> {
    let inverse: Vec<String> = vehicles.iter().map(|k| format!("1/(γ_{k} m_{k})")).collect();
    let inverse = inverse.join(" + ");
    let of_vehicle = |&k: &VehicleId| {
        let name = format!("velocity change of vehicle {k}, {name}");
        step(name, format!("{symbol}{k}"), (delta_v[k.index()], "m/s"), "Eq 6, 7")
            .equals(format!("√(2 E{prime}/[{inverse}])/m_{k}"))
    };
    vehicles.iter().map(of_vehicle).collect()
}

/// ΔV of each vehicle with the restitution of the impact, if that is known and not 1.
fn with_restitution(
    analysis: &Seen,
    crash3: &Crash3,
    vehicles: &[VehicleId],
    delta_v: [f64; 2],
) -> Vec<Draft> {
    let (Some(factor), Some(_)) = (crash3.restitution_factor, &analysis.impact) else { return Vec::new() };
    let formula = match analysis.basis.energy() {
        EnergyBasis::Dissipated => "√((1 + e)/(1 − e))",
        EnergyBasis::Absorbed => "1 + e",
    };
    let mut steps = vec![step("factor for restitution", "f_e", (factor, ""), "theory 5").equals(formula)];
    steps.extend(vehicles.iter().map(|k| {
        let name = format!("velocity change of vehicle {k}, corrected, with restitution");
        let change = delta_v[k.index()] * factor;
        step(name, format!("ΔV''_{k}"), (change, "m/s"), "theory 5").equals(format!("ΔV'_{k} f_e"))
    }));
    steps
}
