//! Priors and misfits with their sources.

use crash3::{FLEET, Side};
use real::Real;
use uncertainty::{Distribution, InvalidDistribution};

use crate::collision::{
    CodedPdof, CrushMisfit, CrushNumbers, EnergyError, InjuryRisk, RestitutionModel, Severity,
};
use crate::density::Freedom;
use crate::figures::{CRUSH_FIGURES, CrushFigures, OfVehicle};

/// The damaged side of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DamagedSide {
    /// Its front.
    Front,
    /// Its rear.
    Rear,
    /// One of its sides.
    Side,
}

impl From<Side> for DamagedSide {
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
    /// From the depths, with the stiffness of a category of CRASH3's table.
    Class,
    /// From the depths, with the stiffness of the cars on the road.
    Fleet,
    /// From the depths, with a stiffness given by the analyst.
    Coefficients,
    /// From the depths, with the stiffness from a barrier test of this car.
    Test,
    /// An energy equivalent speed.
    Ees,
    /// As given, of a fixed object that bent, cracked or leaned.
    OfObject,
}

/// (–) bias, error shared by both vehicles, and own error of a stiffness given by the analyst. No bias was
/// ever fitted to such a stiffness; 0.40 is the remaining error between fronts in the field with the
/// stiffness of each car separated ([`FITTED`]), and with 0.30 it gives the 0.50 of RICSAC, whose stiffnesses
/// were given.
const COEFFICIENTS: EnergyError = EnergyError { bias: 0.0, shared_ln_sd: 0.40, own_ln_sd: 0.30 };
/// (–) the same for a test of this car: CRASH3's error was 13 % in ΔV, 26 % in energy, in 22 car-to-car tests
/// measured in a laboratory (Lenard and others, 2000).
const TEST: EnergyError = EnergyError { bias: 0.0, shared_ln_sd: 0.26, own_ln_sd: 0.0 };
/// (–) the same for an EES. By definition it includes all deformation energy, so that it has no bias. Its
/// errors are assumed: 10 % of the speed, 20 % of the energy, for the comparison with a catalogue, and as
/// much again for each vehicle.
const EES: EnergyError = EnergyError { bias: 0.0, shared_ln_sd: 0.20, own_ln_sd: 0.20 };
/// (–) the same for the energy that a fixed object absorbed, assumed: the method has the error of an EES, and
/// the comparison with another object one of 30 % of the energy.
const OF_OBJECT: EnergyError = EnergyError { bias: 0.0, shared_ln_sd: 0.20, own_ln_sd: 0.30 };

/// (years) the model years between which the bias of energies by a category of CRASH3's table grows from
/// nothing to that of the field: the year of the RICSAC cars, for which they are right on average, and the
/// mean year of the field.
pub(crate) const MODEL_YEARS: [u16; 2] = [1977, 2010];

/// The misfit of energies by a category of CRASH3's table in the field: for fronts only, if a rear was hit,
/// if a side was hit, and for a front against a fixed object.
const CATEGORIES: [MisfitFigures; 4] = [
    MisfitFigures { bias: -0.843, ln_sd: 0.382, covariance: [[0.012_33, -0.003_62], [-0.003_62, 0.070_66]] },
    MisfitFigures { bias: -0.134, ln_sd: 0.687, covariance: [[0.018_59, 0.002_26], [0.002_26, 0.043_55]] },
    MisfitFigures { bias: -0.794, ln_sd: 0.387, covariance: [[0.005_97, -0.001_36], [-0.001_36, 0.044_49]] },
    MisfitFigures { bias: -0.671, ln_sd: 1.372, covariance: [[0.038_11, -0.003_40], [-0.003_40, 0.015_78]] },
];

/// (–) the shares of such energies: median ratio of that of a rear and of a side to that of a front, the
/// standard errors of their logarithms, and the spread between crashes.
const CATEGORY_SHARES: ([f64; 2], [f64; 2], f64) = ([1.720, 0.363], [0.088, 0.060], 0.73);

/// (–) spreads of ln b₁ and of ln b₀ between the cars of a category, whose B has the spread 0.59 of ln and
/// whose A has 0.38: half of that of B, and the rest of that of A (docs/theory.md, section 9).
const CATEGORY_SPREADS: [f64; 2] = [0.295, 0.085];

/// A misfit with the covariance of its bias and of the logarithm of its spread.
struct MisfitFigures {
    bias: f64,
    ln_sd: f64,
    covariance: [[f64; 2]; 2],
}

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
    /// (–) median ratio of the crush energy of a rear to that of the front that struck it.
    pub rear_crush: f64,
    /// (–) median ratio of the crush energy of a side to that of the front that struck it.
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
    /// The figures of collisions with a fixed object.
    pub objects: ObjectFigures,
    /// The errors of the figures that were fitted.
    pub errors: FigureErrors,
}

/// The figures of collisions with a fixed object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectFigures {
    /// Severity: of the one vehicle.
    pub severity: Severity,
    /// Misfit between crush energy and impact.
    pub misfit: CrushMisfit,
    /// (–) covariance of its bias and of the logarithm of its spread.
    pub covariance: [[f64; 2]; 2],
}

impl ObjectFigures {
    /// The errors of the bias and of the spread, as far as the crush energy depends on them; `None` if they
    /// are taken as exact.
    #[must_use]
    pub fn figures(&self, behind: [Behind; 2]) -> Option<CrushFigures> {
        let [[bias, both], [_, spread]] = self.covariance;
        let spread_ln_sd = Real::sqrt(spread);
        if spread_ln_sd <= 0.0 || behind.into_iter().all(Behind::is_exact) {
            return None;
        }
        let vehicles = behind.map(Behind::of_misfit);
        let (mut drift, mut covariance) = ([0.0; CRUSH_FIGURES], [[0.0; CRUSH_FIGURES]; CRUSH_FIGURES]);
        drift[0] = both / spread_ln_sd;
        covariance[0][0] = bias - drift[0] * drift[0];
        Some(CrushFigures { vehicles, spread_ln_sd, drift, covariance })
    }
}

/// Number of fitted figures whose errors count.
pub const FIGURES: usize = 9;

/// The errors of fitted figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureErrors {
    /// (–) covariance of the bias of the crush energy and of the logarithms of: its spread for fronts, for a
    /// rear and for a side; b₁ of sides and of rears, relative to that of fronts; the spread of b₁ between
    /// vehicles; b₀ of fronts and rears, and of sides.
    pub covariance: [[f64; FIGURES]; FIGURES],
    /// (–) standard error of ln of the median severity, and of ln of the factor for two fronts: 0.47/√n, for
    /// the 287 collisions and for the 50 of two fronts that gave them.
    pub severity: [f64; 2],
    /// (–) standard errors of ln of the ratio of the crush energy of a rear, and of a side, to that of a
    /// front.
    pub crush_shares: [f64; 2],
}

impl FigureErrors {
    /// The figures as exact.
    pub const NONE: Self =
        Self { covariance: [[0.0; FIGURES]; FIGURES], severity: [0.0; 2], crush_shares: [0.0; 2] };

    /// Whether a figure behind the crush energies has an error.
    fn has_crush(&self) -> bool {
        self.covariance.iter().flatten().any(|entry| *entry != 0.0)
    }
}

/// The numbers from which a crush energy was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Behind {
    /// No fitted number.
    Nothing,
    /// Numbers of the case, with the fitted bias or the fitted spread of the misfit.
    Misfit {
        /// Whether the bias was fitted.
        bias: bool,
        /// Whether the spread was fitted.
        spread: bool,
    },
    /// The fitted stiffness of this kind of damage, bias and spread.
    Stiffness(DamagedSide),
}

impl Behind {
    fn is_exact(self) -> bool {
        self.misfit() == (false, false)
    }

    /// The places of the figures behind it.
    fn of_vehicle(self) -> OfVehicle {
        let Self::Stiffness(damage) = self else { return self.of_misfit() };
        // b₁ of fronts is from barrier tests.
        let (slope, no_damage_speed) = match damage {
            DamagedSide::Front => (None, 4),
            DamagedSide::Rear => (Some(2), 4),
            DamagedSide::Side => (Some(1), 5),
        };
        let no_damage_speed = Some(no_damage_speed);
        OfVehicle { slope, slope_spread: Some(3), no_damage_speed, ..self.of_misfit() }
    }

    /// The places of bias and spread alone.
    fn of_misfit(self) -> OfVehicle {
        let (bias, has_spread) = self.misfit();
        OfVehicle { bias: bias.then_some(0), has_spread, ..OfVehicle::default() }
    }

    /// Whether the bias and the spread of the misfit were fitted.
    fn misfit(self) -> (bool, bool) {
        match self {
            Self::Nothing => (false, false),
            Self::Misfit { bias, spread } => (bias, spread),
            Self::Stiffness(_) => (true, true),
        }
    }
}

/// The places of the figures in [`FigureErrors::covariance`]: those on which ln E − β depends, in the order
/// of [`CrushFigures`], and those of the spreads.
const BESIDE_SPREADS: [usize; CRUSH_FIGURES] = [0, 4, 5, 6, 7, 8];
const SPREADS: [usize; 3] = [1, 2, 3];

/// The figures fitted to crashes of 2017 (Crash Investigation Sampling System, NHTSA), in November 2026.
pub const FITTED: Fitted = Fitted {
    severity: Severity { median: 7.36, ln_sd: 0.47, speed: 25.0, injury: None, uniform_speeds: 0 },
    front_to_front: 1.42,
    crush_bias: -0.521,
    crush_ln_sd: [0.405, 0.576, 0.336],
    slope: FLEET.slope,
    slope_ln_sd: 0.18,
    no_damage_speed: FLEET.no_damage_speed,
    no_damage_speed_ln_sd: 0.38,
    rear_crush: 1.0,
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
    objects: ObjectFigures {
        severity: Severity { median: 7.7, ln_sd: 0.83, speed: 25.0, injury: None, uniform_speeds: 0 },
        misfit: CrushMisfit { bias: -0.770, ln_sd: 1.470 },
        covariance: [[0.059_07, -0.008_01], [-0.008_01, 0.024_70]],
    },
    errors: FigureErrors {
        covariance: [
            [0.02542, -0.00955, -0.02202, -0.01025, 0.01470, -0.00133, -0.00791, 0.02657, 0.00534],
            [-0.00955, 0.07034, 0.00954, 0.00499, -0.00489, 0.00410, -0.00860, -0.01610, 0.00352],
            [-0.02202, 0.00954, 0.06716, 0.01208, -0.01138, 0.02241, 0.00598, -0.02521, -0.00441],
            [-0.01025, 0.00499, 0.01208, 0.04747, 0.00542, 0.00274, -0.01145, -0.01120, -0.01208],
            [0.01470, -0.00489, -0.01138, 0.00542, 0.02470, 0.00087, -0.00096, 0.01382, -0.01723],
            [-0.00133, 0.00410, 0.02241, 0.00274, 0.00087, 0.02938, 0.00245, -0.00762, 0.00442],
            [-0.00791, -0.00860, 0.00598, -0.01145, -0.00096, 0.00245, 0.11381, -0.01002, -0.00220],
            [0.02657, -0.01610, -0.02521, -0.01120, 0.01382, -0.00762, -0.01002, 0.03742, -0.00328],
            [0.00534, 0.00352, -0.00441, -0.01208, -0.01723, 0.00442, -0.00220, -0.00328, 0.07919],
        ],
        severity: [0.028, 0.066],
        crush_shares: [0.0, 0.089],
    },
};

/// The index of the spread of the misfit if these sides were hit: 0 only fronts, 1 a rear, 2 a side.
fn kind(hit: &[DamagedSide]) -> usize {
    hit.iter().max().map_or(0, |damage| *damage as usize)
}

/// (–) how far the stiffness of a car has gone from those of CRASH3's table to those of the field.
fn newer(model_year: Option<u16>) -> f64 {
    let [old, new] = MODEL_YEARS.map(f64::from);
    model_year.map_or(1.0, |year| ((f64::from(year) - old) / (new - old)).clamp(0.0, 1.0))
}

impl Fitted {
    /// The same for collisions selected for an injury with this risk: somebody suffered it in each of them.
    #[must_use]
    pub fn of_injured(mut self, injury: Option<InjuryRisk>) -> Self {
        self.severity.injury = injury;
        self.objects.severity.injury = injury;
        self
    }

    /// Severity of a collision in which these sides were `hit`: two fronts, or others.
    #[must_use]
    pub fn severity_of(&self, hit: &[DamagedSide]) -> Severity {
        let is_front_to_front = hit == [DamagedSide::Front; 2];
        let times = if is_front_to_front { self.front_to_front } else { 1.0 };
        let [of_median, of_factor] = self.errors.severity;
        let of_factor = if is_front_to_front { of_factor } else { 0.0 };
        let Severity { median, ln_sd, .. } = self.severity;
        // The errors of the median are normal as well: σ² + σ_m² + σ_f²
        let ln_sd = Real::sqrt(ln_sd * ln_sd + of_median * of_median + of_factor * of_factor);
        Severity { median: median * times, ln_sd, ..self.severity }
    }

    /// The same with the misfit of energies by a category of CRASH3's table in place of that of the fleet's
    /// stiffness, if these sides were `hit`.
    #[must_use]
    pub fn by_category(mut self, hit: &[DamagedSide]) -> Self {
        let [.., of_object] = &CATEGORIES;
        let (k, all) = (kind(hit), &mut self.errors.covariance);
        let MisfitFigures { bias, ln_sd, covariance: [[of_bias, both], [_, of_spread]] } = CATEGORIES[k];
        (self.crush_bias, self.crush_ln_sd[k]) = (bias, ln_sd);
        (all[0][0], all[SPREADS[k]][SPREADS[k]]) = (of_bias, of_spread);
        (all[0][SPREADS[k]], all[SPREADS[k]][0]) = (both, both);
        self.objects.misfit = CrushMisfit { bias: of_object.bias, ln_sd: of_object.ln_sd };
        self.objects.covariance = of_object.covariance;
        ([self.rear_crush, self.side_crush], self.errors.crush_shares, self.other_crush_ln_sd) =
            CATEGORY_SHARES;
        [self.slope_ln_sd, self.no_damage_speed_ln_sd] = CATEGORY_SPREADS;
        self
    }

    /// Misfit between crush energy and impact if these sides were `hit`, of one vehicle or both.
    #[must_use]
    pub fn crush_misfit(&self, hit: &[DamagedSide]) -> CrushMisfit {
        CrushMisfit { bias: self.crush_bias, ln_sd: self.crush_ln_sd[kind(hit)] }
    }

    /// The errors of the figures behind the crush energies if these sides were `hit`, of one vehicle or both.
    /// `None` if they depend on nothing that was fitted, or if all figures are taken as exact.
    #[must_use]
    pub fn crush_figures(&self, hit: &[DamagedSide], behind: [Behind; 2]) -> Option<CrushFigures> {
        if !self.errors.has_crush() || behind.into_iter().all(Behind::is_exact) {
            return None;
        }
        let vehicles = behind.map(Behind::of_vehicle);
        let all = &self.errors.covariance;
        let spread = SPREADS[kind(hit)];
        let spread_ln_sd = Real::sqrt(all[spread][spread]);
        // Given ln σ, the mean of the others moves by d = cov/s for each s of it, and d dᵀ is no longer in
        // their covariance.
        let drift =
            BESIDE_SPREADS.map(|k| if spread_ln_sd > 0.0 { all[k][spread] / spread_ln_sd } else { 0.0 });
        let row = |k: usize| {
            core::array::from_fn(|l| all[BESIDE_SPREADS[k]][BESIDE_SPREADS[l]] - drift[k] * drift[l])
        };
        Some(CrushFigures { vehicles, spread_ln_sd, drift, covariance: core::array::from_fn(row) })
    }

    /// Error of the crush energy of a vehicle relative to its part of the energy taken by the impact, by
    /// method. An energy by the stiffness of the fleet has the bias and the spread of its `misfit`; one by
    /// category has that bias only as far as the car is newer than CRASH3's table, and one of unknown
    /// `model_year` is taken for a car of the field. If the case `has_range` for the stiffness, the EES or
    /// the energy of the object, that is the vehicle's own error.
    #[must_use]
    pub fn energy_error(
        &self,
        method: EnergyMethod,
        misfit: CrushMisfit,
        model_year: Option<u16>,
        has_range: bool,
    ) -> EnergyError {
        let error = match method {
            EnergyMethod::Class | EnergyMethod::Fleet => {
                let CrushMisfit { bias, ln_sd } = misfit;
                let newer = if method == EnergyMethod::Class { newer(model_year) } else { 1.0 };
                EnergyError { bias: bias * newer, shared_ln_sd: ln_sd, own_ln_sd: 0.0 }
            }
            EnergyMethod::Coefficients => COEFFICIENTS,
            EnergyMethod::Test => TEST,
            EnergyMethod::Ees => EES,
            EnergyMethod::OfObject => OF_OBJECT,
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
    pub fn restitution_with<N>(&self, factor: N) -> RestitutionModel<N> {
        let [low, rise, fade, _] = self.restitution;
        RestitutionModel::ByClosingSpeed { low, rise, fade, factor, most: self.most_restitution }
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
    pub fn other_crush(
        &self,
        other: DamagedSide,
        known: DamagedSide,
    ) -> Result<Distribution, InvalidDistribution> {
        let [of_rear, of_side] = self.errors.crush_shares;
        let of = |damage: DamagedSide| match damage {
            DamagedSide::Front => (1.0, 0.0),
            DamagedSide::Rear => (self.rear_crush, of_rear),
            DamagedSide::Side => (self.side_crush, of_side),
        };
        let ((other_share, one), (known_share, two)) = (of(other), of(known));
        // The errors of the shares count, unless they are the same: σ² + σ_1² + σ_2²
        let of_shares = if other == known { 0.0 } else { one * one + two * two };
        let ln_sd = self.other_crush_ln_sd;
        Distribution::log_normal(other_share / known_share, Real::sqrt(ln_sd * ln_sd + of_shares))
    }

    /// The crush of a vehicle of unknown stiffness, from the `width` (m) of the damage, the mean depth (m)
    /// and the mean square depth (m²). `slope` and `no_damage_speed` are left at 1.
    #[must_use]
    pub fn crush_of(&self, damage: DamagedSide, width: f64, mean: f64, mean_square: f64) -> CrushNumbers {
        let (b0, b1) = (self.no_damage_speed[damage as usize], self.slope[damage as usize]);
        // A = m b₀ b₁/w, B = m b₁²/w, G = m b₀²/2w
        let per_width = FLEET.mass_per_width;
        CrushNumbers {
            constant: 0.5 * per_width * width * b0 * b0,
            linear: per_width * width * b0 * b1 * mean,
            square: 0.5 * per_width * width * b1 * b1 * mean_square,
            slope: 1.0.into(),
            no_damage_speed: 1.0.into(),
        }
    }
}
