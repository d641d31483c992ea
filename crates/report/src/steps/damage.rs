//! Stiffness and crush energy.

mod barrier_test;
mod inferred;
mod profile;
mod stiffness;

pub(super) use profile::{SHARE_BELOW, of_zone};

use analysis::{Damage, Seen, Vehicle};
use case::{Basis, Case, Crush, CrushEvidence};
use crash3::{Profile, SideStiffness, Yielding};
use pim_core::VehicleId;

use super::{Draft, DraftGroup, group, n, step};
use crate::{basis, words};

pub(super) fn groups(case: &Case, analysis: &Seen) -> Vec<DraftGroup> {
    let mut groups = Vec::new();
    for (i, vehicle) in VehicleId::ALL.into_iter().zip(&analysis.vehicles) {
        if let (Some(damage), Some(crush)) = (&vehicle.damage, &case.vehicles[i.index()].crush) {
            groups.push(group(format!("Crush energy of vehicle {i}"), energy(vehicle, damage, crush, i)));
        } else if let Some(step) = energy_alone(vehicle, i) {
            groups.push(group(format!("Crush energy of vehicle {i}"), step));
        } else if let Some(deformation_energy) = vehicle.subject.deformation_energy {
            let name = format!("energy that deformed object {i}");
            let step = step(name, format!("E_{i}"), (deformation_energy, "J"), "input");
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

fn energy(vehicle: &Vehicle, damage: &Damage, crush: &Crush, i: VehicleId) -> Vec<Draft> {
    let mut steps = stiffness::steps(&damage.structure, &crush.stiffness, i);
    if let (Some(inferred), SideStiffness::Uniform(stiffness)) = (&damage.inferred, &damage.structure) {
        steps.extend(inferred::steps(damage, inferred, stiffness, i));
        return steps;
    }
    let Some(profile) = measured(vehicle) else { return steps };
    match &damage.structure {
        SideStiffness::Uniform(stiffness) => {
            if profile.zones().all(|zone| zone.yielding(stiffness) == Yielding::Nowhere) {
                steps.extend(profile::moments(profile, i));
                steps.push(profile::whole(profile, damage.crush_energy, i));
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
fn energy_alone(vehicle: &Vehicle, i: VehicleId) -> Option<Vec<Draft>> {
    let energy = vehicle.subject.inertia.and(vehicle.energy)?;
    let (name, symbol) = (format!("crush energy of vehicle {i}"), format!("E_{i}"));
    if vehicle.subject.energy?.ees.is_none() {
        let name = format!("{name}, which has no damage that counts");
        return Some(vec![step(name, symbol, (0.0, "J"), "input")]);
    }
    Some(vec![
        step(
            format!("energy equivalent speed of vehicle {i}"),
            format!("EES_{i}"),
            (energy.ees, "m/s"),
            "input",
        ),
        step(name, symbol, (energy.crush_energy, "J"), "theory 5").equals(format!("½ m_{i} EES_{i}²")),
    ])
}

/// The speeds that stand for energies: b_0 if one stiffness holds along the side, and EES.
fn speeds(vehicle: &Vehicle, damage: &Damage, i: VehicleId) -> Vec<Draft> {
    if vehicle.subject.inertia.is_none() {
        return Vec::new();
    }
    let mut steps = Vec::new();
    if let (SideStiffness::Uniform(_), Some(speed)) = (&damage.structure, vehicle.no_damage_speed()) {
        let name = format!("no-damage speed of vehicle {i}");
        steps.push(
            step(name, format!("b_0,{i}"), (speed, "m/s"), "theory 5")
                .equals(format!("√(2 G_{i} L_{i}/m_{i})"))
                .with([(format!("L_{i}"), n(damage.width, "m"))]),
        );
    }
    let name = format!("energy equivalent speed of vehicle {i}");
    let ees = step(name, format!("EES_{i}"), (damage.ees, "m/s"), "theory 5");
    steps.push(ees.equals(format!("√(2 E_{i}/m_{i})")));
    steps
}

/// The sum over the vehicles that have damage, of their energies or, with a `prime`, of the corrected ones.
pub(super) fn total(
    analysis: &Seen,
    prime: &str,
    of: impl Fn(&Vehicle) -> Option<f64>,
    crush_energy: f64,
    source: &'static str,
) -> Draft {
    let vehicles = VehicleId::ALL.into_iter().zip(&analysis.vehicles);
    let symbols: Vec<String> = vehicles
        .filter(|(_, vehicle)| of(vehicle).is_some())
        // An energy that is given directly has no correction.
        .map(|(i, vehicle)| format!("E{}_{i}", if vehicle.damage.is_none() { "" } else { prime }))
        .collect();
    let what = if prime.is_empty() { "crush energy" } else { "corrected crush energy" };
    let name = format!("{what}{}", words::of_crushed(&analysis.vehicles, symbols.len()));
    step(name, format!("E{prime}"), (crush_energy, "J"), source).equals(symbols.join(" + "))
}

/// The work that the impact has to do.
fn sought(analysis: &Seen) -> Vec<Draft> {
    let Some(found) = &analysis.found else { return Vec::new() };
    let e = analysis.impact.as_ref().map_or(0.0, |impact| impact.law.restitution());
    let (kind, symbol, work) = match analysis.basis {
        Basis::Dissipated => ("normal work", "W_n", "E"),
        Basis::Absorbed => ("normal work", "W_n", "E (1 − e²)"),
        Basis::TangentialShare(_) => ("work", "W_n + λ W_t", "E"),
    };
    let name = format!("{kind} sought, basis {}", basis::named(analysis.basis));
    let mut steps = vec![total(analysis, "", Vehicle::crush_energy, found.crush_energy, "Eq 4, 5")];
    steps.extend(share(analysis));
    let sought = step(name, symbol, (found.normal_work, "J"), "theory 6");
    steps.push(sought.equals(work).with([("e", n(e, ""))]));
    steps
}

/// λ, if the case gives one.
pub(super) fn share(analysis: &Seen) -> Option<Draft> {
    let Basis::TangentialShare(share) = analysis.basis else { return None };
    Some(step("share of the tangential work in the crush energy", "λ", (share, ""), "theory 6"))
}
