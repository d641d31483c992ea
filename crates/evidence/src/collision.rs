//! A collision of which some numbers are unknown.

use core::f64::consts::FRAC_PI_2;

use pim_core::{Vector2, VehicleId};
use real::Real;
use real::elementary::{exp, ln, sin_cos};
use uncertainty::{Distribution, InvalidDistribution};

use crate::density::Freedom;
use crate::number::Number;

/// Two vehicles that collide: what is known of them before the evidence, and what was observed.
///
/// Headings, velocities and the crush plane are those of a scene with y to the left of x, counter-clockwise
/// positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision<N = Number> {
    /// The vehicles.
    pub vehicles: [Vehicle<N>; 2],
    /// How fast they were.
    pub speeds: Speeds<N>,
    /// (rad) Γ, direction of the line at right angles to the crush plane.
    pub crush_plane: N,
    /// e.
    pub restitution: Restitution<N>,
    /// (–) μ_max: greatest ratio of the impulses along the crush plane and across it. The sliding ends before
    /// where less ends it.
    pub friction: N,
    /// (–) λ, share of the tangential work that went into crush: E = W_n + λ W_t.
    pub tangential_share: N,
    /// The crush energy of the one vehicle whose crush is not known; `None` where both are known, or neither.
    pub other_crush: Option<OtherCrush<N>>,
    /// What is held against the impact.
    pub observed: Observed,
}

/// One vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vehicle<N = Number> {
    /// Its body; `None` for a fixed object.
    pub body: Option<BodyNumbers<N>>,
    /// (rad) heading in the scene.
    pub heading: N,
    /// (m) contact point C ahead of the CG, and to its left.
    pub contact: [N; 2],
    /// (rad/s) yaw rate before impact.
    pub yaw_rate: N,
    /// The crush energy.
    pub crush: Option<Crush<N>>,
}

/// What is held against the impact of a particle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observed {
    /// Of each vehicle.
    pub vehicles: [ObservedVehicle; 2],
    /// How severe such collisions are; `None` where nothing is assumed of it.
    pub severity: Option<Severity>,
    /// How well crush energy and impact agree; `None` where the crush is no evidence.
    pub crush: Option<CrushErrors>,
}

/// What was observed of a vehicle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservedVehicle {
    /// PDOF as it was coded.
    pub pdof: Option<CodedPdof>,
    /// How it left the impact.
    pub after: After,
    /// Where it came to rest.
    pub rest: Option<MeasuredRest>,
    /// (m/s) speed where its skid before the impact begins.
    pub skid_speed: Option<MeasuredSpeed>,
    /// (m) standard deviation of the error of each point that its CG passed, in the order of the points.
    pub points: Vec<f64>,
    /// What its recorder stored.
    pub recorder: Recorder,
    /// What is certain of its speed.
    pub limits: Limits,
}

/// Where a vehicle came to rest, with the errors of the survey and of the model of its motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredRest {
    /// (m) place of the CG in the scene.
    pub position: Vector2<f64>,
    /// (rad) direction in which it lies from the impact: its normal score is that of the error along it.
    pub direction: f64,
    /// (m) standard deviation of its error, in each direction.
    pub position_sd: f64,
    /// (rad) heading.
    pub heading: f64,
    /// Whether full turns are counted in it.
    pub turns_are_known: bool,
    /// (rad) standard deviation of its error.
    pub heading_sd: f64,
}

/// What resists the impulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyNumbers<N = Number> {
    /// (kg) mass.
    pub mass: N,
    /// (m) k, radius of gyration about the vertical axis: I = m k².
    pub yaw_radius: N,
}

/// How fast the vehicles were along their headings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speeds<N = Number> {
    /// (m/s) each by itself.
    Each([N; 2]),
    /// Neither is known, but that none moved backward.
    Together {
        /// (–) ln c, c = |v₁ − v₂| (m/s) the relative speed of the CGs.
        ln_relative: N,
        /// (rad) φ between 0 and π/2: v₂/v₁ = tan φ. Below that vehicle 2 stands, above it vehicle 1.
        split: N,
    },
}

/// (m/s) slowest and fastest relative speed that is thought of.
const RELATIVE_SPEED: [f64; 2] = [0.3, 120.0];

impl Speeds {
    /// ln c, of which nothing is known.
    ///
    /// # Errors
    /// None, as these ends make a distribution.
    pub fn any_ln_relative() -> Result<Distribution, InvalidDistribution> {
        let [slowest, fastest] = RELATIVE_SPEED;
        Distribution::uniform(ln(slowest), ln(fastest))
    }

    /// φ, where nothing is known but how probable (–) it is that each vehicle stood.
    ///
    /// # Errors
    /// Where both stood for certain, or a probability is negative.
    pub fn split_with_standing(stood: [f64; 2]) -> Result<Distribution, InvalidDistribution> {
        // P(φ ≤ 0) = p₂, P(φ ≥ π/2) = p₁
        let moved = 1.0 - stood[0] - stood[1];
        let [above, below] = stood.map(|stood| FRAC_PI_2 * stood / moved);
        Distribution::uniform(-below, FRAC_PI_2 + above)
    }

    /// φ, of which nothing is known.
    ///
    /// # Errors
    /// None, as these ends make a distribution.
    pub fn any_split() -> Result<Distribution, InvalidDistribution> {
        Distribution::uniform(0.0, FRAC_PI_2)
    }
}

impl<N: Copy> Speeds<N> {
    /// With other numbers in their places.
    #[inline(always)]
    #[must_use]
    pub fn map<M>(self, mut of: impl FnMut(N) -> M) -> Speeds<M> {
        match self {
            Self::Each([one, two]) => Speeds::Each([of(one), of(two)]),
            Self::Together { ln_relative, split } => {
                Speeds::Together { ln_relative: of(ln_relative), split: of(split) }
            }
        }
    }
}

impl Speeds<f64> {
    /// (m/s) along the headings, of which `forward` are the unit vectors.
    #[inline(always)]
    #[must_use]
    pub fn along(self, forward: [Vector2<f64>; 2]) -> [f64; 2] {
        match self {
            Self::Each(speeds) => speeds,
            Self::Together { ln_relative, split } => {
                let (sin, cos) = match split {
                    angle if angle <= 0.0 => (0.0, 1.0),
                    angle if angle >= FRAC_PI_2 => (1.0, 0.0),
                    angle => sin_cos(angle),
                };
                // c = s |cos φ f₁ − sin φ f₂|
                let apart = forward[0] * cos - forward[1] * sin;
                let scale = exp(ln_relative) / Real::sqrt(apart.x * apart.x + apart.y * apart.y);
                [scale * cos, scale * sin]
            }
        }
    }
}

/// Coefficient of restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Restitution<N = Number> {
    /// (–) the same at any speed.
    Constant(N),
    /// Falls with the closing speed: e = [`low` + `rise` exp(u_n/`fade`)] · `factor`, at most `most`.
    ByClosingSpeed {
        /// (–) at high speeds.
        low: f64,
        /// (–) what is added at a standstill.
        rise: f64,
        /// (m/s) closing speed at which e of that is left.
        fade: f64,
        /// (–) what this collision has of the mean.
        factor: N,
        /// (–) no collision has more.
        most: f64,
    },
}

impl<N: Copy> Restitution<N> {
    /// With another number in its place.
    #[inline(always)]
    #[must_use]
    pub fn map<M>(self, mut of: impl FnMut(N) -> M) -> Restitution<M> {
        match self {
            Self::Constant(e) => Restitution::Constant(of(e)),
            Self::ByClosingSpeed { low, rise, fade, factor, most } => {
                Restitution::ByClosingSpeed { low, rise, fade, factor: of(factor), most }
            }
        }
    }
}

impl Restitution<f64> {
    /// (–) e at a closing speed −u_n (m/s).
    #[inline(always)]
    #[must_use]
    pub fn at(self, closing: f64) -> f64 {
        match self {
            Self::Constant(e) => e,
            Self::ByClosingSpeed { low, rise, fade, factor, most } => {
                // e = min[(e₀ + e₁ exp(u_n/u_e)) ε, e_max]
                Real::min((low + rise * exp(-closing / fade)) * factor, most)
            }
        }
    }
}

/// Crush of one vehicle: E = L (G₀ β² + A₀ C̄ κ β + ½ B₀ C²̄ κ²), the integral over its profile with the
/// stiffness A = A₀ κ β, B = B₀ κ², G = A²/2B of the vehicle itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crush<N = Number> {
    /// (J) part of the energy without depth, L G₀.
    pub constant: f64,
    /// (J) part that grows with the depth, L A₀ C̄.
    pub linear: f64,
    /// (J) part that grows with its square, ½ L B₀ C²̄.
    pub square: f64,
    /// (–) κ, slope of force over depth of this vehicle by that of its kind.
    pub slope: N,
    /// (–) β, no-damage speed of this vehicle by that of its kind.
    pub no_damage_speed: N,
}

/// Crush energy of a vehicle whose crush is not known, where that of the other is: E_j = r E_i.
///
/// The crush of the other vehicle alone is evidence by it: with its share s = 1/(1 + r) of both energies,
/// ln E_i = ln(W_n + λ W_t) + ln s + b + error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherCrush<N = Number> {
    /// The vehicle whose crush is not known.
    pub vehicle: VehicleId,
    /// (–) r, its crush energy by that of the other vehicle.
    pub ratio: N,
}

impl<N: Copy> OtherCrush<N> {
    /// With another number in its place.
    #[inline(always)]
    #[must_use]
    pub fn map<M>(self, of: impl FnOnce(N) -> M) -> OtherCrush<M> {
        OtherCrush { vehicle: self.vehicle, ratio: of(self.ratio) }
    }
}

impl OtherCrush<f64> {
    /// (J) crush energies of both vehicles, from that of the other among `known` (J).
    #[inline(always)]
    #[must_use]
    pub fn completed(self, known: [f64; 2]) -> [f64; 2] {
        let Self { vehicle, ratio } = self;
        // E_j = r E_i
        match (vehicle, known) {
            (VehicleId::One, [_, own]) => [ratio * own, own],
            (VehicleId::Two, [own, _]) => [own, ratio * own],
        }
    }
}

/// ln(E₁ + E₂) = ln(W_n + λ W_t) + b + error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrushMisfit {
    /// (–) b: how much the crush energy is above what the impact took.
    pub bias: f64,
    /// (–) standard deviation of the error, which both vehicles share.
    pub ln_sd: f64,
}

/// How far the crush energy of one vehicle is from its part of what the impact took. It depends on how the
/// energy was obtained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyError {
    /// (–) b: how much the logarithm of the crush energy is above that of its part on average.
    pub bias: f64,
    /// (–) c: standard deviation of the error of the method, which it shares with that of the other vehicle.
    pub shared_ln_sd: f64,
    /// (–) o: standard deviation of its own error.
    pub own_ln_sd: f64,
}

/// That of both vehicles:
/// ln(E₁ exp(−b₁) + E₂ exp(−b₂)) = ln(W_n + λ W_t) + error, σ² = (w₁ c₁ + w₂ c₂)² + (w₁ o₁)² + (w₂ o₂)²,
/// w_i the share of vehicle i in the sum on the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrushErrors(pub [EnergyError; 2]);

impl From<CrushMisfit> for CrushErrors {
    /// Of energies that were obtained alike.
    fn from(CrushMisfit { bias, ln_sd }: CrushMisfit) -> Self {
        Self([EnergyError { bias, shared_ln_sd: ln_sd, own_ln_sd: 0.0 }; 2])
    }
}

/// ln √(ΔV₁ ΔV₂) is normally distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Severity {
    /// (m/s) half of the collisions have a smaller mean ΔV.
    pub median: f64,
    /// (–) standard deviation of the logarithm.
    pub ln_sd: f64,
    /// (m/s) speeds above some times this are rare: weight exp(−(v₁² + v₂²)/2s²).
    pub speed: f64,
}

/// PDOF as an investigator saw it, or as a recorder's ΔV shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CodedPdof {
    /// (rad) clockwise from the heading, where the force came from.
    pub pdof: f64,
    /// (rad) scale of its error, Student's t with 2 degrees of freedom.
    pub scale: f64,
}

/// A measurement with a normal error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// What was measured.
    pub value: f64,
    /// Standard deviation of its error.
    pub sd: f64,
}

/// A speed that was measured, with a normal error of which one part grows with the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredSpeed {
    /// (m/s) what was measured.
    pub value: f64,
    /// (–) standard deviation of the part that grows: that of the logarithm.
    pub ln_sd: f64,
    /// (m/s) standard deviation of the error of a vehicle that stands.
    pub least: f64,
}

/// How a vehicle left the impact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct After {
    /// (m/s) speed of the CG.
    pub speed: Option<MeasuredSpeed>,
    /// (rad) direction of its velocity in the scene.
    pub direction: Option<Measured>,
    /// (rad/s) yaw rate.
    pub yaw_rate: Option<Measured>,
}

/// What a recorder stored.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Recorder {
    /// Size of ΔV.
    pub delta_v: Option<RecordedDeltaV>,
    /// The part of ΔV along the vehicle with its sign, of a recorder that stored this part alone: in place of
    /// [`delta_v`](Self::delta_v).
    pub longitudinal: Option<RecordedPart>,
    /// Where the force came from by both parts of its ΔV.
    pub direction: Option<CodedPdof>,
    /// (m/s) speed before impact.
    pub speed: Option<MeasuredSpeed>,
    /// (rad/s) yaw rate after the impact.
    pub yaw_rate: Option<Measured>,
}

/// ΔV that a recorder stored; its logarithm has an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedDeltaV {
    /// (m/s) size of what it stored.
    pub size: f64,
    /// Whether it stored the longitudinal part alone.
    pub is_longitudinal: bool,
    /// (–) scale of the error of the logarithm, Student's t.
    pub ln_scale: f64,
    /// (m/s) scale of the error of a ΔV of zero; without one, the logarithm alone errs.
    pub least: f64,
    /// Its degrees of freedom.
    pub freedom: Freedom,
}

/// The part of ΔV along a vehicle, with its sign, that a recorder stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedPart {
    /// (m/s) negative where the vehicle was slowed down.
    pub along: f64,
    /// (–) scale of the part of the error that grows with it, Student's t.
    pub ln_scale: f64,
    /// (m/s) scale of the error of a part of zero, beside what comes from the part across the vehicle.
    pub least: f64,
    /// Degrees of freedom.
    pub freedom: Freedom,
}

/// What holds for certain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// (m/s) the speed is not below.
    pub least: f64,
    /// (m/s) the speed is not above.
    pub most: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { least: f64::NEG_INFINITY, most: f64::INFINITY }
    }
}
