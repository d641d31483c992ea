//! A vehicle of an analysis, and its damage.

use crash3::{CrushRange, ObliqueFactor, SideStiffness, UniformCrush};
use inputs::{CrushEvidence, ForceData, VehicleData};
use pim_core::Real;

use crate::thresholds::HALF_HOUR;

/// One vehicle.
#[derive(Clone, Debug)]
pub struct Vehicle<T = f64> {
    /// The data that the case gives.
    pub subject: VehicleData<T>,
    /// Its damage, if the crush was measured or inferred.
    pub damage: Option<Damage<T>>,
    /// Its damage, if only the energy is known.
    pub energy: Option<EnergyAlone<T>>,
}

impl<T: Real> Vehicle<T> {
    /// (J) the energy without crush: as given, or what a fixed object absorbed.
    fn energy_alone(&self) -> Option<T> {
        self.energy.map(|energy| energy.crush_energy).or(self.subject.deformation_energy)
    }

    /// (J) crush energy, uncorrected, as far as the damage is known.
    #[must_use]
    pub fn crush_energy(&self) -> Option<T> {
        let alone = self.energy_alone();
        self.damage.as_ref().map(|damage| damage.crush_energy).or(alone)
    }

    /// (J) crush energy, corrected for an oblique force; an energy given on its own needs no correction.
    /// `None` if the force does not push on the damaged side.
    #[must_use]
    pub fn corrected_crush_energy(&self) -> Option<T> {
        let alone = self.energy_alone();
        self.damage.as_ref().map_or(alone, |damage| Some(damage.oblique?.corrected_crush_energy))
    }

    /// (m/s) energy equivalent speed of the uncorrected crush energy.
    #[must_use]
    pub fn ees(&self) -> Option<T> {
        let alone = self.energy.map(|energy| energy.ees);
        self.damage.as_ref().map(|damage| damage.ees).or(alone)
    }

    /// (m) h: distance of the force's line of action from the CG.
    #[must_use]
    pub fn moment_arm(&self) -> Option<T> {
        let alone = self.energy.map(|energy| energy.moment_arm);
        self.damage.as_ref().map(|damage| damage.moment_arm).or(alone)
    }

    /// (rad) the PDOF that CRASH3 uses: the file's, else that of the impact.
    #[must_use]
    pub fn crash3_pdof(&self) -> Option<T> {
        self.damage.as_ref().map_or(self.energy.and_then(|energy| energy.pdof), |damage| damage.pdof)
    }
}

impl Vehicle {
    /// Whether it is not a fixed object.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.subject.inertia.is_some()
    }

    /// (rad) the PDOF that the file gives for this vehicle itself.
    pub(crate) fn given_pdof(&self) -> Option<f64> {
        self.subject.force.pdof.filter(|_| !self.subject.force.pdof_follows)
    }

    /// (rad) how far the direction of force may be from the middle of the given hour; 0 for an angle.
    pub(crate) fn half_hour(&self) -> f64 {
        if self.subject.force.pdof_is_hour { HALF_HOUR } else { 0.0 }
    }

    /// (m/s) b_0, the highest speed without crush on the damaged width: its energy is G.
    #[must_use]
    pub fn no_damage_speed(&self) -> Option<f64> {
        let damage = self.damage.as_ref()?;
        let energy = match (&damage.structure, &self.subject.damage.as_ref()?.evidence) {
            (SideStiffness::Uniform(stiffness), _) => stiffness.g() * damage.width,
            (SideStiffness::Zones(zones), CrushEvidence::Measured { profile, .. }) => {
                zones.iter().zip(profile.zones()).map(|(stiffness, zone)| stiffness.g() * zone.width).sum()
            }
            // The reader does not accept zones for a crush without stations.
            (SideStiffness::Zones(_), CrushEvidence::ForceBalance { .. }) => return None,
        };
        // b₀ = √(2 G w/m)
        Some((2.0 * energy / self.subject.inertia?.mass).sqrt())
    }
}

/// The results for the damage of one vehicle.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Damage<T = f64> {
    /// (m) width of the damage.
    pub width: T,
    /// (m) depths of crush; `None` if the crush was inferred.
    pub depths: Vec<T>,
    /// The inferred crush, if it was not measured.
    pub inferred: Option<Inferred<T>>,
    /// The stiffness.
    pub structure: SideStiffness<T>,
    /// (J) crush energy, uncorrected.
    pub crush_energy: T,
    /// (m/s) energy equivalent speed of the uncorrected crush energy.
    pub ees: T,
    /// (rad) the PDOF that determines the correction and the moment arm: the file's, else that of the impact.
    pub pdof: Option<T>,
    /// (rad) α: angle between the force and the normal of the damaged side; `None` if no direction of the
    /// force is known, for one vehicle alone.
    pub oblique_angle: Option<T>,
    /// The correction for α; `None` if that is not known, or the force does not push on the damaged side.
    pub oblique: Option<Oblique<T>>,
    /// (m) h: distance of the force's line of action from the CG.
    pub moment_arm: T,
    /// (m) centroid of the damage, forward and left of the CG, if the force was assumed to act through it.
    pub centroid: Option<[T; 2]>,
}

/// The results for a damage with only a known energy: from an EES, or none at all.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct EnergyAlone<T = f64> {
    /// (J) crush energy; no correction for oblique forces applies to it.
    pub crush_energy: T,
    /// (m/s) energy equivalent speed.
    pub ees: T,
    /// (rad) the PDOF that determines the moment arm: the file's, else that of the impact.
    pub pdof: Option<T>,
    /// (m) h: distance of the force's line of action from the CG.
    pub moment_arm: T,
}

/// A crush inferred from the force on the other vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Inferred<T = f64> {
    /// (N) the peak force of the other vehicle.
    pub force: T,
    /// The crush whose energy is used.
    pub crush: UniformCrush<T>,
    /// The bounds, if the width is unknown.
    pub range: Option<CrushRange<T>>,
}

/// The correction for an oblique force that pushes on the damaged side.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Oblique<T = f64> {
    /// The factor on the crush energy.
    pub factor: ObliqueFactor<T>,
    /// (J) crush energy with that factor.
    pub corrected_crush_energy: T,
    /// (N) peak force.
    pub peak_force: T,
}

/// A vehicle without any data.
pub(crate) const NOTHING: VehicleData = VehicleData {
    kind: None,
    inertia: None,
    contact: None,
    contact_is_placed: false,
    dimensions: None,
    deformation_energy: None,
    damage: None,
    energy: None,
    force: ForceData::UNKNOWN,
};
