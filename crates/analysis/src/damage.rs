//! The damage of each vehicle, and CRASH3's answer from both.

use case::Subject;
use crash3::{CrushError, EnergyBasis, Inertia, ObliqueFactor, Stiffness};

use crate::Vehicle;

/// What the damage of one vehicle says.
#[derive(Clone, Debug)]
pub struct Damage {
    /// (m) width of the damage.
    pub width: f64,
    /// (m) depths of crush.
    pub depths: Vec<f64>,
    /// The stiffness.
    pub stiffness: Stiffness,
    /// (J) crush energy, uncorrected.
    pub crush_energy: f64,
    /// (m/s) energy equivalent speed of the uncorrected crush energy.
    pub ees: f64,
    /// (rad) the PDOF that the correction and the moment arm follow from: the file's, else that of the impact.
    pub pdof: Option<f64>,
    /// (rad) α: angle between the force and the normal of the damaged side.
    pub oblique_angle: f64,
    /// The correction for it; none where the force does not push on the damaged side.
    pub oblique: Option<Oblique>,
    /// (m) h: distance of the force's line of action from the CG.
    pub moment_arm: f64,
}

/// What follows for an oblique force that pushes on the damaged side.
#[derive(Clone, Copy, Debug)]
pub struct Oblique {
    /// The factor on the crush energy.
    pub factor: ObliqueFactor,
    /// (J) crush energy with that factor.
    pub corrected_crush_energy: f64,
    /// (N) peak force.
    pub peak_force: f64,
}

/// CRASH3's answer.
#[derive(Clone, Copy, Debug)]
pub struct Crash3 {
    /// (J) crush energy of both vehicles.
    pub crush_energy: f64,
    /// (m) moment arms; zero for a fixed object.
    pub moment_arm: [f64; 2],
    /// γ of both vehicles; one for a fixed object.
    pub effective_mass_ratio: [f64; 2],
    /// (m/s) velocity changes from the uncorrected energy, with a common normal velocity (e = 0).
    pub delta_v: [f64; 2],
    /// The same from the corrected energy; none where a force does not push on its damaged side.
    pub corrected: Option<Corrected>,
    /// The factor on each ΔV that takes restitution into account; none where the restitution is not known or is 1.
    pub restitution_factor: Option<f64>,
}

/// CRASH3's answer with the correction for oblique forces.
#[derive(Clone, Copy, Debug)]
pub struct Corrected {
    /// (J) crush energy of both vehicles.
    pub crush_energy: f64,
    /// (m/s) velocity changes.
    pub delta_v: [f64; 2],
}

/// Assesses the damage of both vehicles; `pdof` (rad) are those of the impact, which serve where the file gives none.
pub(crate) fn assess(subjects: [Subject; 2], pdof: [Option<f64>; 2]) -> Result<[Vehicle; 2], CrushError> {
    let [s1, s2] = subjects;
    let [p1, p2] = pdof;
    Ok([vehicle(s1, p1)?, vehicle(s2, p2)?])
}

fn vehicle(subject: Subject, computed_pdof: Option<f64>) -> Result<Vehicle, CrushError> {
    let (Some(given), Some(inertia)) = (&subject.damage, subject.inertia) else {
        return Ok(Vehicle { subject, damage: None });
    };
    let pdof = given.pdof.or(computed_pdof);
    // A file that gives no PDOF gives the angle and the arm themselves: `case` sees to that.
    let oblique_angle =
        given.oblique_angle.or(pdof.map(|pdof| given.side.oblique_angle(pdof))).unwrap_or_default();
    let line = subject.contact.zip(pdof);
    let moment_arm = given
        .moment_arm
        .or(line.map(|(contact, pdof)| crash3::moment_arm(contact, pdof)))
        .unwrap_or_default();
    let crush_energy = crash3::crush_energy(&given.profile, &given.stiffness);
    let oblique = match (
        given.correction.factor(oblique_angle),
        crash3::peak_force(&given.profile, &given.stiffness, oblique_angle),
    ) {
        (Ok(factor), Ok(peak_force)) => {
            // E' = E (1 + tan²α)
            Some(Oblique { factor, corrected_crush_energy: crush_energy * factor.factor, peak_force })
        }
        _ => None,
    };
    let damage = Damage {
        width: given.profile.width(),
        depths: given.profile.depths().to_vec(),
        stiffness: given.stiffness,
        crush_energy,
        ees: crash3::energy_equivalent_speed(crush_energy, inertia.mass)?,
        pdof,
        oblique_angle,
        oblique,
        moment_arm,
    };
    Ok(Vehicle { subject, damage: Some(damage) })
}

/// CRASH3's answer, or `None` where the damage of a vehicle that can move is not known.
pub(crate) fn crash3(
    vehicles: &[Vehicle; 2],
    basis: EnergyBasis,
    restitution: Option<f64>,
) -> Result<Option<Crash3>, CrushError> {
    let mut crush_energy = 0.0;
    let mut corrected_energy = Some(0.0);
    let mut inertias = [Inertia::fixed(); 2];
    let mut moment_arm = [0.0; 2];
    for (i, vehicle) in vehicles.iter().enumerate() {
        let Some(inertia) = vehicle.subject.inertia else { continue };
        let Some(damage) = &vehicle.damage else { return Ok(None) };
        crush_energy += damage.crush_energy;
        corrected_energy =
            corrected_energy.zip(damage.oblique).map(|(sum, oblique)| sum + oblique.corrected_crush_energy);
        moment_arm[i] = damage.moment_arm;
        inertias[i] = Inertia::new(inertia.mass, inertia.yaw_inertia, damage.moment_arm)?;
    }
    let corrected = match corrected_energy {
        Some(crush_energy) => {
            Some(Corrected { crush_energy, delta_v: crash3::delta_v(crush_energy, inertias)? })
        }
        None => None,
    };
    Ok(Some(Crash3 {
        crush_energy,
        moment_arm,
        effective_mass_ratio: inertias.map(|inertia| inertia.effective_mass_ratio()),
        delta_v: crash3::delta_v(crush_energy, inertias)?,
        corrected,
        restitution_factor: restitution.and_then(|e| basis.restitution_factor(e).ok()),
    }))
}
