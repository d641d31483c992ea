//! Stiffness and crush energy.

mod barrier_test;
mod inferred;
mod profile;
mod stiffness;

pub(super) use profile::share_below;

use analysis::{Damage, Seen, Vehicle};
use case::{Basis, Case, Crush, CrushEvidence};
use crash3::{Profile, SideStiffness, Yielding};
use pim_core::VehicleId;

use super::{Step, StepGroup, group, n, p, step};
use crate::{basis, words};

pub(super) fn groups(case: &Case, analysis: &Seen) -> Vec<StepGroup> {
    let mut groups = Vec::new();
    for (i, vehicle) in VehicleId::ALL.into_iter().zip(&analysis.vehicles) {
        if let (Some(damage), Some(crush)) = (&vehicle.damage, &case.vehicles[i.index()].crush) {
            groups.push(group(format!("Crush energy of vehicle {i}"), energy(vehicle, damage, crush, i)));
        } else if let Some(step) = energy_alone(vehicle, i) {
            groups.push(group(format!("Crush energy of vehicle {i}"), step));
        } else if let Some(deformation_energy) = vehicle.subject.deformation_energy {
            let name = format!("energy that deformed object {i}");
            let step = step(name, format!("E_{i}")).is(deformation_energy, "J", "input");
            groups.push(group(format!("Energy of object {i}"), vec![step]));
        }
    }
    groups.push(group("Energy sought", sought(analysis)));
    groups
}

/// The crush that was measured; `None` if it was inferred.
pub(super) fn measured(vehicle: &Vehicle) -> Option<&Profile> {
    match &vehicle.subject.damage.as_ref()?.evidence {
        CrushEvidence::Measured { profile, .. } => Some(profile),
        CrushEvidence::ForceBalance { .. } => None,
    }
}

fn energy(vehicle: &Vehicle, damage: &Damage, crush: &Crush, i: VehicleId) -> Vec<Step> {
    let mut steps = stiffness::steps(&damage.structure, &crush.stiffness, i);
    if let (Some(inferred), SideStiffness::Uniform(stiffness)) = (&damage.inferred, &damage.structure) {
        steps.extend(inferred::steps(damage, inferred, stiffness, i));
        return steps;
    }
    let Some(profile) = measured(vehicle) else { return steps };
    let rises_everywhere = match &damage.structure {
        SideStiffness::Uniform(stiffness) => {
            profile.zones().all(|zone| zone.yielding(stiffness) == Yielding::Nowhere)
        }
        SideStiffness::Zones(_) => false,
    };
    if rises_everywhere {
        steps.extend(profile::moments(profile, i));
    }
    match &damage.structure {
        SideStiffness::Uniform(stiffness) => {
            if rises_everywhere {
                steps.extend(profile::whole(profile, stiffness, damage.crush_energy, i));
            } else {
                let zones = profile.zones().map(|zone| (zone, *stiffness));
                steps.extend(profile::zone_by_zone(zones, damage.crush_energy, i));
            }
        }
        SideStiffness::Zones(stiffnesses) => {
            let zones = profile.zones().zip(stiffnesses.iter().copied());
            steps.extend(profile::zone_by_zone(zones, damage.crush_energy, i));
        }
    }
    steps.extend(speeds(vehicle, damage, i));
    steps
}

/// An energy that is given directly or as a speed, or that of a vehicle without damage.
fn energy_alone(vehicle: &Vehicle, i: VehicleId) -> Option<Vec<Step>> {
    let (inertia, energy) = vehicle.subject.inertia.zip(vehicle.energy)?;
    if vehicle.subject.energy?.ees.is_none() {
        let name = format!("crush energy of vehicle {i}, which has no damage that counts");
        return Some(vec![step(name, format!("E_{i}")).is(0.0, "J", "input")]);
    }
    let ees = step(format!("energy equivalent speed of vehicle {i}"), format!("EES_{i}"))
        .is(energy.ees, "m/s", "input");
    let crush_energy = step(format!("crush energy of vehicle {i}"), format!("E_{i}"))
        .equals(
            format!("½ m_{i} EES_{i}²"),
            format!("1 / 2 · {} · {}²", n(inertia.mass, "kg"), p(energy.ees, "m/s")),
        )
        .is(energy.crush_energy, "J", "theory 5");
    Some(vec![ees, crush_energy])
}

/// The speeds that stand for energies: b_0 if one stiffness holds along the side, and EES.
fn speeds(vehicle: &Vehicle, damage: &Damage, i: VehicleId) -> Vec<Step> {
    let Some(inertia) = vehicle.subject.inertia else { return Vec::new() };
    let mut steps = Vec::new();
    if let (SideStiffness::Uniform(stiffness), Some(speed)) = (&damage.structure, vehicle.no_damage_speed()) {
        steps.push(
            step(format!("no-damage speed of vehicle {i}"), format!("b_0,{i}"))
                .equals(
                    format!("√(2 G_{i} L_{i}/m_{i})"),
                    format!(
                        "√(2 · {} · {} / {})",
                        n(stiffness.g(), "N"),
                        n(damage.width, "m"),
                        n(inertia.mass, "kg")
                    ),
                )
                .is(speed, "m/s", "theory 5"),
        );
    }
    steps.push(
        step(format!("energy equivalent speed of vehicle {i}"), format!("EES_{i}"))
            .equals(
                format!("√(2 E_{i}/m_{i})"),
                format!("√(2 · {} / {})", n(damage.crush_energy, "J"), n(inertia.mass, "kg")),
            )
            .is(damage.ees, "m/s", "theory 5"),
    );
    steps
}

/// The sum over the vehicles that have damage, of their energies or, with a `prime`, of the corrected ones.
pub(super) fn total(
    analysis: &Seen,
    prime: &str,
    of: impl Fn(&Vehicle) -> Option<f64>,
    crush_energy: f64,
    source: &'static str,
) -> Step {
    let (symbols, numbers): (Vec<String>, Vec<String>) = VehicleId::ALL
        .into_iter()
        .zip(&analysis.vehicles)
        .filter_map(|(i, vehicle)| of(vehicle).map(|energy| (vehicle, i, energy)))
        .map(|(vehicle, i, energy)| {
            // An energy that is given directly has no correction.
            let prime = if vehicle.damage.is_none() { "" } else { prime };
            (format!("E{prime}_{i}"), n(energy, "J"))
        })
        .unzip();
    let what = if prime.is_empty() { "crush energy" } else { "corrected crush energy" };
    let name = format!("{what}{}", words::of_crushed(&analysis.vehicles, symbols.len()));
    let sum = step(name, format!("E{prime}")).equals(symbols.join(" + "), numbers.join(" + "));
    sum.is(crush_energy, "J", source)
}

/// The work that the impact has to do.
fn sought(analysis: &Seen) -> Vec<Step> {
    let Some(found) = &analysis.found else { return Vec::new() };
    let both = total(analysis, "", Vehicle::crush_energy, found.crush_energy, "Eq 4, 5");
    let e = analysis.impact.as_ref().map_or(0.0, |impact| impact.law.restitution());
    let work = match analysis.basis {
        Basis::Dissipated | Basis::TangentialShare(_) => ("E", n(found.crush_energy, "J")),
        Basis::Absorbed => ("E (1 − e²)", format!("{} · (1 − {}²)", n(found.crush_energy, "J"), p(e, ""))),
    };
    let (kind, symbol) = match analysis.basis {
        Basis::Dissipated | Basis::Absorbed => ("normal work", "W_n"),
        Basis::TangentialShare(_) => ("work", "W_n + λ W_t"),
    };
    let name = format!("{kind} sought, basis {}", basis::named(analysis.basis));
    let mut steps = vec![both];
    steps.extend(share(analysis));
    steps.push(step(name, symbol).equals(work.0, work.1).is(found.normal_work, "J", "theory 6"));
    steps
}

/// λ, if the case gives one.
pub(super) fn share(analysis: &Seen) -> Vec<Step> {
    let Basis::TangentialShare(share) = analysis.basis else { return Vec::new() };
    vec![step("share of the tangential work in the crush energy", "λ").is(share, "", "theory 6")]
}
