//! The damage of each vehicle, and CRASH3's answer from both.

use crash3::{
    CrushError, EnergyBasis, ObliqueCorrection, Profile, SideStiffness, StruckVehicle, UniformCrush,
};
use inputs::{CrushEvidence, EnergyData, InferredWidth, VehicleData};

use pim_core::Real;

use crate::vehicle::{Damage, EnergyAlone, Inferred, Oblique, Vehicle};

/// The friction assumed if the case gives none: within the 0.3 to 1.0 that is usual between vehicles.
pub(crate) const ASSUMED_FRICTION: f64 = 0.5;

/// CRASH3's answer.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Crash3 {
    /// (J) crush energy of both vehicles.
    pub crush_energy: f64,
    /// (m) moment arms; zero for a fixed object.
    pub moment_arm: [f64; 2],
    /// (m²) k², the squares of the radii of gyration; zero for a fixed object.
    pub square_radius: [f64; 2],
    /// γ of both vehicles; one for a fixed object.
    pub effective_mass_ratio: [f64; 2],
    /// (m/s) velocity changes from the uncorrected energy, with a common normal velocity (e = 0).
    pub delta_v: [f64; 2],
    /// (m/s) velocity changes from the corrected energy; `None` if a force does not push on its damaged side.
    pub corrected: Option<Corrected>,
    /// The factor on each ΔV that accounts for restitution; `None` if the restitution is unknown or 1.
    pub restitution_factor: Option<f64>,
    /// CRASH3's answer with each correction for oblique forces, without those that need a force to push on
    /// its damaged side if it does not.
    pub corrections: Vec<Correction>,
}

/// CRASH3's ΔV with one correction for oblique forces and a common normal velocity.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Correction {
    /// The correction of each vehicle: one kind for both, but each vehicle with its own friction limit.
    pub corrections: [ObliqueCorrection; 2],
    /// The factor on each vehicle's crush energy; one for a fixed object.
    pub factor: [f64; 2],
    /// (J) crush energy of both vehicles, corrected.
    pub crush_energy: f64,
    /// (m/s) velocity changes.
    pub delta_v: [f64; 2],
}

/// CRASH3's answer with the correction for oblique forces.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Corrected {
    /// (J) crush energy of both vehicles.
    pub crush_energy: f64,
    /// (m/s) velocity changes.
    pub delta_v: [f64; 2],
}

/// Assesses the damage of both vehicles; `pdof` (rad) are those of the impact, used if the file gives none.
pub(crate) fn assess<T: Real>(
    [s1, s2]: [VehicleData<T>; 2],
    [p1, p2]: [Option<T>; 2],
) -> Result<[Vehicle<T>; 2], CrushError> {
    // The vehicle with a measured crush comes first: that of the other may have to be inferred from it.
    if s1.damage.as_ref().is_some_and(|damage| matches!(damage.evidence, CrushEvidence::ForceBalance { .. }))
    {
        let second = vehicle(s2, p2, None)?;
        return Ok([vehicle(s1, p1, second.damage.as_ref())?, second]);
    }
    let first = vehicle(s1, p1, None)?;
    let second = vehicle(s2, p2, first.damage.as_ref())?;
    Ok([first, second])
}

fn vehicle<T: Real>(
    subject: VehicleData<T>,
    computed_pdof: Option<T>,
    other: Option<&Damage<T>>,
) -> Result<Vehicle<T>, CrushError> {
    let energy = match subject.inertia.zip(subject.energy) {
        Some((inertia, given)) => Some(energy_alone(&subject, inertia.mass, given, computed_pdof)?),
        None => None,
    };
    let (Some(given), Some(inertia)) = (&subject.damage, subject.inertia) else {
        return Ok(Vehicle { subject, damage: None, energy });
    };
    let force = subject.force;
    let pdof = force.pdof.or(computed_pdof);
    // A case of two vehicles without a PDOF gives the angle and the arm themselves, as its demands ensure.
    let known_angle = given.oblique_angle.or(pdof.map(|pdof| given.side.oblique_angle(pdof)));
    let oblique_angle = known_angle.unwrap_or(T::ZERO);
    let (profile, structure, inferred) = match &given.evidence {
        CrushEvidence::Measured { profile, structure } => (profile.clone(), structure.clone(), None),
        CrushEvidence::ForceBalance { stiffness, width } => {
            // A case with a force balance also has a measured crush, as its demands ensure.
            let Some(other) = other else { return Ok(Vehicle { subject, damage: None, energy }) };
            let Some(Oblique { peak_force: force, .. }) = other.oblique else {
                let angle = other.oblique_angle.map_or(0.0, T::value);
                return Err(CrushError::NotPushing { angle });
            };
            let inferred = match *width {
                InferredWidth::Given(width) => {
                    let crush = crash3::crush_from_force(force, oblique_angle, width, stiffness)?;
                    Inferred { force, crush, range: None }
                }
                InferredWidth::Bounded { widest, deepest } => {
                    let range = crash3::crush_range_from_force(
                        force,
                        oblique_angle,
                        stiffness,
                        other.width,
                        widest,
                        deepest,
                    )?;
                    Inferred { force, crush: range.nominal, range: Some(range) }
                }
            };
            let UniformCrush { width, depth, .. } = inferred.crush;
            let profile = Profile::equally_spaced(vec![depth; 2], width)?;
            (profile, SideStiffness::Uniform(*stiffness), Some(inferred))
        }
    };
    let centroid = match (force.moment_arm, subject.contact, &given.face) {
        (None, None, Some(face)) => Some(face.centroid(&profile, &structure)?),
        _ => None,
    };
    let line = subject.contact.or(centroid).zip(pdof);
    let moment_arm =
        force.moment_arm.or(line.map(|(point, pdof)| crash3::moment_arm(point, pdof))).unwrap_or(T::ZERO);
    // An inferred crush has the force from which it was inferred, and less energy than w G if that force
    // leaves no residual crush.
    let (crush_energy, peak_force) = match &inferred {
        Some(inferred) => (inferred.crush.energy, Ok(inferred.force)),
        None => (structure.crush_energy(&profile)?, structure.peak_force(&profile, oblique_angle)),
    };
    let oblique = match (given.correction.factor(oblique_angle), peak_force) {
        (Ok(factor), Ok(peak_force)) if known_angle.is_some() => {
            // E' = E (1 + tan²α), or the factor of another correction
            Some(Oblique { factor, corrected_crush_energy: crush_energy * factor.factor, peak_force })
        }
        _ => None,
    };
    let damage = Damage {
        width: profile.width(),
        depths: if inferred.is_some() { Vec::new() } else { profile.depths().to_vec() },
        inferred,
        structure,
        crush_energy,
        ees: crash3::energy_equivalent_speed(crush_energy, inertia.mass)?,
        pdof,
        oblique_angle: known_angle,
        oblique,
        moment_arm,
        centroid,
    };
    Ok(Vehicle { subject, damage: Some(damage), energy })
}

fn energy_alone<T: Real>(
    subject: &VehicleData<T>,
    mass: T,
    given: EnergyData<T>,
    computed_pdof: Option<T>,
) -> Result<EnergyAlone<T>, CrushError> {
    let ees = given.ees.unwrap_or(T::ZERO);
    let force = subject.force;
    let pdof = force.pdof.or(computed_pdof);
    let line = subject.contact.zip(pdof);
    let moment_arm =
        force.moment_arm.or(line.map(|(point, pdof)| crash3::moment_arm(point, pdof))).unwrap_or(T::ZERO);
    let crush_energy = crash3::energy_of_equivalent_speed(ees, mass)?;
    Ok(EnergyAlone { crush_energy, ees, pdof, moment_arm })
}

/// (J) crush energy of both vehicles.
pub(crate) fn crush_energy<T: Real>(vehicles: &[Vehicle<T>; 2]) -> T {
    let energies = vehicles.iter().filter_map(Vehicle::crush_energy);
    energies.fold(T::ZERO, |sum, energy| sum + energy)
}

/// (J) uncorrected crush energy of both vehicles. It does not depend on the impact; a force balance takes its
/// directions from the file.
pub(crate) fn uncorrected<T: Real>(vehicles: [VehicleData<T>; 2]) -> Result<T, CrushError> {
    Ok(crush_energy(&assess(vehicles, [None, None])?))
}

/// CRASH3's answer, or `None` if the damage of a vehicle that can move is unknown.
pub(crate) fn crash3(
    vehicles: &[Vehicle; 2],
    basis: EnergyBasis,
    restitution: Option<f64>,
) -> Result<Option<Crash3>, CrushError> {
    let mut crush_energy = 0.0;
    let mut corrected_energy = Some(0.0);
    let mut inertias = [StruckVehicle::fixed(); 2];
    let mut moment_arm = [0.0; 2];
    for (i, vehicle) in vehicles.iter().enumerate() {
        let Some(inertia) = vehicle.subject.inertia else {
            let of_object = vehicle.crush_energy().unwrap_or_default();
            crush_energy += of_object;
            corrected_energy = corrected_energy.map(|sum| sum + of_object);
            continue;
        };
        let Some((energy, arm)) = vehicle.crush_energy().zip(vehicle.moment_arm()) else { return Ok(None) };
        crush_energy += energy;
        corrected_energy =
            corrected_energy.zip(vehicle.corrected_crush_energy()).map(|(sum, corrected)| sum + corrected);
        moment_arm[i] = arm;
        let Some(yaw_inertia) = inertia.yaw_inertia else { return Ok(None) };
        inertias[i] = StruckVehicle::new(inertia.mass, yaw_inertia, arm)?;
    }
    let corrected = match corrected_energy {
        Some(crush_energy) => {
            Some(Corrected { crush_energy, delta_v: crash3::delta_v(crush_energy, inertias)? })
        }
        None => None,
    };
    let mut corrections = Vec::new();
    for correction in [
        [ObliqueCorrection::None; 2],
        [ObliqueCorrection::Capped; 2],
        [ObliqueCorrection::Uncapped; 2],
        friction_limits(vehicles).map(ObliqueCorrection::Friction),
        [ObliqueCorrection::Secant; 2],
    ] {
        corrections.extend(corrected_by(correction, vehicles, inertias)?);
    }
    Ok(Some(Crash3 {
        crush_energy,
        moment_arm,
        square_radius: inertias.map(|inertia| inertia.square_radius()),
        effective_mass_ratio: inertias.map(|inertia| inertia.effective_mass_ratio()),
        delta_v: crash3::delta_v(crush_energy, inertias)?,
        corrected,
        restitution_factor: restitution.and_then(|e| basis.restitution_factor(e).ok()),
        corrections,
    }))
}

/// The friction limit of each vehicle: its own, else that of the other vehicle, because the surfaces are the
/// same, else the assumed one.
fn friction_limits(vehicles: &[Vehicle; 2]) -> [f64; 2] {
    let [first, second] =
        vehicles.each_ref().map(|vehicle| match vehicle.subject.damage.as_ref()?.correction {
            ObliqueCorrection::Friction(limit) => Some(limit),
            _ => None,
        });
    [first.or(second), second.or(first)].map(|limit| limit.unwrap_or(ASSUMED_FRICTION))
}

/// `None` if a force does not push on its damaged side.
fn corrected_by(
    corrections: [ObliqueCorrection; 2],
    vehicles: &[Vehicle; 2],
    inertias: [StruckVehicle; 2],
) -> Result<Option<Correction>, CrushError> {
    let mut crush_energy = 0.0;
    let mut factor = [1.0; 2];
    for (i, vehicle) in vehicles.iter().enumerate() {
        let Some(damage) = &vehicle.damage else {
            crush_energy += vehicle.crush_energy().unwrap_or_default();
            continue;
        };
        let oblique = damage.oblique_angle.map(|angle| corrections[i].factor(angle));
        let Some(Ok(oblique)) = oblique else { return Ok(None) };
        factor[i] = oblique.factor;
        crush_energy += damage.crush_energy * oblique.factor;
    }
    let delta_v = crash3::delta_v(crush_energy, inertias)?;
    Ok(Some(Correction { corrections, factor, crush_energy, delta_v }))
}
