//! Priors and misfits with their sources.

use crash3::Side;
use uncertainty::{Distribution, InvalidDistribution};

use crate::collision::{CodedPdof, Crush, CrushMisfit, EnergyError, Restitution, Severity};
use crate::density::Freedom;

/// The damaged side of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Damage {
    /// Its front.
    Front,
    /// Its rear.
    Rear,
    /// One of its sides.
    Side,
}

impl From<Side> for Damage {
    fn from(side: Side) -> Self {
        match side {
            Side::Front => Self::Front,
            Side::Rear => Self::Rear,
            Side::Left | Side::Right => Self::Side,
        }
    }
}

/// The source of the crush energy of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyMethod {
    /// From the depths, with the stiffness of a class or category of vehicles.
    Class,
    /// From the depths, with a stiffness given by the analyst.
    Coefficients,
    /// From the depths, with the stiffness from a barrier test of this car.
    Test,
    /// An energy equivalent speed.
    Ees,
}

/// (–) bias, error shared by both vehicles, and own error of a stiffness given by the analyst. No bias was
/// ever fitted to such; 0.40 is the remaining error between fronts in the field with the stiffness of each
/// car separated ([`FITTED`]), and with 0.30 it gives the 0.50 of RICSAC, whose stiffnesses were given.
const COEFFICIENTS: EnergyError = EnergyError { bias: 0.0, shared_ln_sd: 0.40, own_ln_sd: 0.30 };
/// (–) the same for a test of this car: CRASH3's error was 13 % in ΔV, 26 % in energy, in 22 car-to-car tests
/// measured in a laboratory (Lenard and others, 2000).
const TEST: EnergyError = EnergyError { bias: 0.0, shared_ln_sd: 0.26, own_ln_sd: 0.0 };
/// (–) the same for an EES. By definition it includes all deformation energy, so that it has no bias. Its
/// errors are assumed: 10 % of the speed, 20 % of the energy, for the comparison with a catalogue, and as
/// much again for each vehicle.
const EES: EnergyError = EnergyError { bias: 0.0, shared_ln_sd: 0.20, own_ln_sd: 0.20 };

/// The assumptions about a collision of passenger vehicles, and the errors of its model.
///
/// docs/calibration.md has the source of each figure, and describes how the misfits and stiffnesses were
/// fitted to real crashes with a recorder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// Severity of collisions in which a vehicle was towed: its ΔV then has a median of 23 km/h and a spread
    /// of the logarithm of 0.48, as in the field.
    pub severity: Severity,
    /// (–) factor on the severity of front-to-front collisions.
    pub front_to_front: f64,
    /// (–) mean excess of ln of the crush energy over ln of the energy taken by the impact.
    pub crush_bias: f64,
    /// (–) its spread: for fronts only, if a rear was hit, and if a side was hit.
    pub crush_ln_sd: [f64; 3],
    /// (1/s) b₁ by damage: front, rear, side.
    pub slope: [f64; 3],
    /// (–) spread of its logarithm over the vehicles of a fleet: half of that of B.
    pub slope_ln_sd: f64,
    /// (m/s) b₀ by damage: front, rear, side.
    pub no_damage_speed: [f64; 3],
    /// (–) spread of its logarithm.
    pub no_damage_speed_ln_sd: f64,
    /// (–) median ratio of the crush energy of a side to that of the front or rear that struck it.
    pub side_crush: f64,
    /// (–) spread of the logarithm of the ratio of the vehicles' crush energies.
    pub other_crush_ln_sd: f64,
    /// (–) scale of the error of the logarithm of a recorder's ΔV, including that of its mass.
    pub recorder_ln_scale: f64,
    /// Its degrees of freedom.
    pub recorder_freedom: Freedom,
    /// (rad) scale of the error of the direction of a recorder's ΔV, Student's t with 2 degrees of freedom.
    pub recorder_direction_scale: f64,
    /// (–) median and spread of the logarithm of the greatest impulse ratio.
    pub friction: [f64; 2],
    /// (–) mean and spread of λ, before truncation to 0 to 1.
    pub tangential_share: [f64; 2],
    /// (–) e at high speeds, its increase at a standstill; (m/s) the closing speed at which 1/e of the
    /// increase is left; (–) spread of the logarithm for a single collision.
    pub restitution: [f64; 4],
    /// (–) greatest e.
    pub most_restitution: f64,
    /// (rad) spread of the crush plane.
    pub crush_plane_sd: f64,
    /// (m) spread of the contact point along the damaged face.
    pub contact_sd: f64,
    /// (rad) spread of a heading.
    pub heading_sd: f64,
    /// (–) spread of the logarithm of a mass.
    pub mass_ln_sd: f64,
    /// (rad) scale of the error of a coded PDOF, Student's t with 2 degrees of freedom.
    pub pdof_scale: f64,
    /// (–) factor on this scale, and on that of a recorder's direction, for damage to a side.
    pub pdof_side_factor: f64,
}

/// The figures fitted to crashes of 2017 (Crash Investigation Sampling System, NHTSA), in November 2026.
pub const FITTED: Fitted = Fitted {
    severity: Severity { median: 7.36, ln_sd: 0.47, speed: 25.0 },
    front_to_front: 1.42,
    crush_bias: -0.521,
    crush_ln_sd: [0.405, 0.576, 0.336],
    slope: [27.7, 23.1, 31.1],
    slope_ln_sd: 0.18,
    no_damage_speed: [2.22, 2.22, 1.58],
    no_damage_speed_ln_sd: 0.38,
    side_crush: 0.73,
    other_crush_ln_sd: 0.96,
    recorder_ln_scale: 0.128,
    recorder_freedom: Freedom::Three,
    recorder_direction_scale: 0.092_502_450_355_699_47,
    friction: [1.0, 0.4],
    tangential_share: [0.5, 0.35],
    restitution: [0.05, 0.32, 5.0, 0.6],
    most_restitution: 0.7,
    crush_plane_sd: 0.174_532_925_199_432_95,
    contact_sd: 0.25,
    heading_sd: 0.174_532_925_199_432_95,
    mass_ln_sd: 0.03,
    pdof_scale: 0.104_719_755_119_659_77,
    pdof_side_factor: 1.5,
};

/// (kg, m) mass and width to which the stiffness of the fleet refers.
const REFERENCE: [f64; 2] = [1600.0, 1.6];

impl Fitted {
    /// Severity of a collision in which these sides were `hit`: two fronts, or others.
    #[must_use]
    pub fn severity_of(&self, hit: &[Damage]) -> Severity {
        let times = if hit == [Damage::Front; 2] { self.front_to_front } else { 1.0 };
        Severity { median: self.severity.median * times, ..self.severity }
    }

    /// Misfit between crush energy and impact if these sides were `hit`, of one vehicle or both.
    #[must_use]
    pub fn crush_misfit(&self, hit: &[Damage]) -> CrushMisfit {
        let kind = hit.iter().max().map_or(0, |damage| *damage as usize);
        CrushMisfit { bias: self.crush_bias, ln_sd: self.crush_ln_sd[kind] }
    }

    /// Error of the crush energy of a vehicle relative to its part of the energy taken by the impact, by
    /// method. If the case `has_range` for the stiffness or the EES, that is the vehicle's own error.
    #[must_use]
    pub fn energy_error(&self, method: EnergyMethod, hit: &[Damage], has_range: bool) -> EnergyError {
        let error = match method {
            EnergyMethod::Class => {
                let CrushMisfit { bias, ln_sd } = self.crush_misfit(hit);
                EnergyError { bias, shared_ln_sd: ln_sd, own_ln_sd: 0.0 }
            }
            EnergyMethod::Coefficients => COEFFICIENTS,
            EnergyMethod::Test => TEST,
            EnergyMethod::Ees => EES,
        };
        EnergyError { own_ln_sd: if has_range { 0.0 } else { error.own_ln_sd }, ..error }
    }

    /// A coded PDOF (rad) with its error, for a hit on a side or an end.
    #[must_use]
    pub fn coded(&self, pdof: f64, is_side: bool) -> CodedPdof {
        self.direction(pdof, self.pdof_scale, is_side)
    }

    /// The direction (rad) from which the force came, from a recorder with both components of ΔV, for a hit
    /// on a side or an end.
    #[must_use]
    pub fn recorded_direction(&self, pdof: f64, is_side: bool) -> CodedPdof {
        self.direction(pdof, self.recorder_direction_scale, is_side)
    }

    /// A direction (rad) whose error has this scale (rad) for a hit on an end, and a wider one on a side.
    fn direction(&self, pdof: f64, scale: f64, is_side: bool) -> CodedPdof {
        CodedPdof { pdof, scale: scale * if is_side { self.pdof_side_factor } else { 1.0 } }
    }

    /// e as a function of the closing speed, with the `factor` of a collision.
    #[must_use]
    pub fn restitution_with<N>(&self, factor: N) -> Restitution<N> {
        let [low, rise, fade, _] = self.restitution;
        Restitution::ByClosingSpeed { low, rise, fade, factor, most: self.most_restitution }
    }

    /// Distribution of the factor on e of a collision.
    ///
    /// # Errors
    /// If the figure is invalid.
    pub fn restitution_factor(&self) -> Result<Distribution, InvalidDistribution> {
        let [.., ln_sd] = self.restitution;
        Distribution::log_normal(1.0, ln_sd)
    }

    /// Distribution of the greatest impulse ratio.
    ///
    /// # Errors
    /// If the figures are invalid.
    pub fn any_friction(&self) -> Result<Distribution, InvalidDistribution> {
        let [median, ln_sd] = self.friction;
        Distribution::log_normal(median, ln_sd)
    }

    /// Distribution of λ.
    ///
    /// # Errors
    /// If the figures are invalid.
    pub fn any_tangential_share(&self) -> Result<Distribution, InvalidDistribution> {
        let [mean, sd] = self.tangential_share;
        Distribution::truncated_normal(mean, sd, 0.0, 1.0)
    }

    /// Distribution of the ratio of a vehicle's crush energy to that of the other, whose crush is `known`.
    ///
    /// # Errors
    /// If the figures are invalid.
    pub fn other_crush(&self, other: Damage, known: Damage) -> Result<Distribution, InvalidDistribution> {
        let of = |damage: Damage| if damage == Damage::Side { self.side_crush } else { 1.0 };
        Distribution::log_normal(of(other) / of(known), self.other_crush_ln_sd)
    }

    /// The crush of a vehicle of unknown stiffness, from the `width` (m) of the damage, the mean depth (m)
    /// and the mean square depth (m²). `slope` and `no_damage_speed` are left at 1.
    #[must_use]
    pub fn crush_of(&self, damage: Damage, width: f64, mean: f64, mean_square: f64) -> Crush {
        let (b0, b1) = (self.no_damage_speed[damage as usize], self.slope[damage as usize]);
        let [mass, reference_width] = REFERENCE;
        // A = m b₀ b₁/w, B = m b₁²/w, G = m b₀²/2w
        let per_width = mass / reference_width;
        Crush {
            constant: 0.5 * per_width * width * b0 * b0,
            linear: per_width * width * b0 * b1 * mean,
            square: 0.5 * per_width * width * b1 * b1 * mean_square,
            slope: 1.0.into(),
            no_damage_speed: 1.0.into(),
        }
    }
}
