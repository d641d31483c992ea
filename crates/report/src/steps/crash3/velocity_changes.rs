//! CRASH3's velocity changes.

use analysis::{Crash3, Seen, Vehicle};
use case::Axes;
use crash3::EnergyBasis;
use pim_core::VehicleId;

use super::super::damage::total;
use super::super::{Step, angle, n, p, step};
use super::pdof_symbol;

/// A vehicle that can move.
#[derive(Clone, Copy)]
struct Movable {
    id: VehicleId,
    /// (kg)
    mass: f64,
    /// (kg·m²)
    yaw_inertia: f64,
}

pub(super) fn steps(analysis: &Seen, axes: Axes) -> Vec<Step> {
    let Some(crash3) = &analysis.crash3 else { return Vec::new() };
    let vehicles: Vec<Movable> = VehicleId::ALL
        .into_iter()
        .zip(&analysis.vehicles)
        .filter_map(|(id, vehicle)| {
            let inertia = vehicle.subject.inertia?;
            Some(Movable { id, mass: inertia.mass, yaw_inertia: inertia.yaw_inertia? })
        })
        .collect();
    let mut steps = Vec::new();
    for &vehicle in &vehicles {
        steps.push(moment_arm(analysis, crash3, vehicle.id, axes));
        steps.extend(effective_mass(crash3, vehicle));
    }
    steps.push(total(analysis, "", Vehicle::crush_energy, crash3.crush_energy, "Eq 5"));
    steps.extend(changes(crash3, &vehicles, Energy::Uncorrected));
    if let Some(corrected) = crash3.corrected {
        steps.push(total(analysis, "'", Vehicle::corrected_crush_energy, corrected.crush_energy, "Eq 8"));
        let energy = Energy::Corrected { energy: corrected.crush_energy, delta_v: corrected.delta_v };
        steps.extend(changes(crash3, &vehicles, energy));
        steps.extend(with_restitution(analysis, crash3, &vehicles, corrected.delta_v));
    }
    steps
}

/// h, from the contact point or the centroid if it follows from one of them.
fn moment_arm(analysis: &Seen, crash3: &Crash3, k: VehicleId, axes: Axes) -> Step {
    let (vehicle, arm) = (&analysis.vehicles[k.index()], crash3.moment_arm[k.index()]);
    // Across the force, which comes from the PDOF, clockwise in any axes.
    let left = match axes {
        Axes::ZUp => "+",
        Axes::ZDown => "−",
    };
    let damage = vehicle.damage.as_ref();
    let direction = pdof_symbol(vehicle, k);
    let given_arm = vehicle.subject.force.moment_arm;
    let name = format!("distance of the line of action from CG {k}");
    let point = vehicle.subject.contact.or(damage.and_then(|damage| damage.centroid));
    match (given_arm, point, vehicle.crash3_pdof()) {
        (None, Some([x, y]), Some(pdof)) => step(name, format!("h_{k}"))
            .equals(
                format!("|x_{k} sin {direction} {left} y_{k} cos {direction}|"),
                format!("abs({} · sin{2} {left} {1} · cos{2})", n(x, "m"), n(y, "m"), angle(pdof)),
            )
            .is(arm, "m", "theory 5"),
        _ => step(name, format!("h_{k}")).is(arm, "m", "input"),
    }
}

/// k² and γ.
fn effective_mass(crash3: &Crash3, Movable { id: k, mass, yaw_inertia }: Movable) -> [Step; 2] {
    let square = crash3.square_radius[k.index()];
    [
        step(format!("square of the radius of gyration, vehicle {k}"), format!("k_{k}²"))
            .equals(format!("I_{k}/m_{k}"), format!("{} / {}", n(yaw_inertia, "kg·m²"), n(mass, "kg")))
            .is(square, "m²", "theory 5"),
        step(format!("effective mass ratio, vehicle {k}"), format!("γ_{k}"))
            .equals(
                format!("k_{k}²/(k_{k}² + h_{k}²)"),
                format!("{0} / ({0} + {1}²)", n(square, "m²"), p(crash3.moment_arm[k.index()], "m")),
            )
            .is(crash3.effective_mass_ratio[k.index()], "", "theory 5"),
    ]
}

/// The crush energy from which the velocity changes follow.
#[derive(Clone, Copy)]
enum Energy {
    Uncorrected,
    Corrected { energy: f64, delta_v: [f64; 2] },
}

/// ΔV of each vehicle, with a common normal velocity.
fn changes(crash3: &Crash3, vehicles: &[Movable], energy: Energy) -> Vec<Step> {
    // ΔV_1 is that of the impulse.
    let (name, prime, symbol, energy, delta_v) = match energy {
        Energy::Uncorrected => ("uncorrected", "", "ΔV_CRASH3,", crash3.crush_energy, crash3.delta_v),
        Energy::Corrected { energy, delta_v } => {
            ("corrected for the oblique force", "'", "ΔV'_", energy, delta_v)
        }
    };
    let (formula, numbers): (Vec<String>, Vec<String>) = vehicles
        .iter()
        .map(|&Movable { id, mass, .. }| {
            let ratio = n(crash3.effective_mass_ratio[id.index()], "");
            (format!("1/(γ_{id} m_{id})"), format!("1 / ({ratio} · {})", n(mass, "kg")))
        })
        .unzip();
    let (formula, numbers) = (formula.join(" + "), numbers.join(" + "));
    let of_vehicle = |&Movable { id: k, mass, .. }: &Movable| {
        step(format!("velocity change of vehicle {k}, {name}"), format!("{symbol}{k}"))
            .equals(
                format!("√(2 E{prime}/[{formula}])/m_{k}"),
                format!("√(2 · {} / ({numbers})) / {}", n(energy, "J"), n(mass, "kg")),
            )
            .is(delta_v[k.index()], "m/s", "Eq 6, 7")
    };
    vehicles.iter().map(of_vehicle).collect()
}

/// ΔV of each vehicle with the restitution of the impact, if that is known and not 1.
fn with_restitution(analysis: &Seen, crash3: &Crash3, vehicles: &[Movable], delta_v: [f64; 2]) -> Vec<Step> {
    let e = analysis.impact.as_ref().map(|impact| n(impact.law.restitution(), ""));
    let (Some(factor), Some(e)) = (crash3.restitution_factor, e) else { return Vec::new() };
    let (formula, numbers) = match analysis.basis.energy() {
        EnergyBasis::Dissipated => ("√((1 + e)/(1 − e))", format!("√((1 + {e}) / (1 − {e}))")),
        EnergyBasis::Absorbed => ("1 + e", format!("1 + {e}")),
    };
    let mut steps =
        vec![step("factor for restitution", "f_e").equals(formula, numbers).is(factor, "", "theory 5")];
    steps.extend(vehicles.iter().map(|&Movable { id: k, .. }| {
        let change = delta_v[k.index()];
        step(format!("velocity change of vehicle {k}, corrected, with restitution"), format!("ΔV''_{k}"))
            .equals(format!("ΔV'_{k} f_e"), format!("{} · {}", n(change, "m/s"), n(factor, "")))
            .is(change * factor, "m/s", "theory 5")
    }));
    steps
}
