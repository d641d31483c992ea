//! A collision with unknown numbers.

use core::f64::consts::FRAC_PI_2;

use pim_core::{Vector2, VehicleId};
use real::Real;
use real::elementary::{atan2, exp, ln, sin_cos};
use uncertainty::{Distribution, InvalidDistribution};

use crate::density::Freedom;
use crate::figures::CrushFigures;
use crate::number::Number;

/// Two vehicles that collide: the prior knowledge of them, and the observations.
///
/// Headings, velocities and the crush plane are those of a scene with y to the left of x, counter-clockwise
/// positive.
///
/// No number is checked. All but those of [`Limits`] have to be finite. Masses, radii of gyration, factors,
/// ratios, scales, standard deviations and measured sizes have to be positive, but one of the two parts of
/// the error of a speed or ΔV may be 0. e and λ have to lie between 0 and 1, and μ_max must not be negative.
/// The likelihood of other numbers may be finite, and means nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision<N = Number> {
    /// The vehicles.
    pub vehicles: [VehicleNumbers<N>; 2],
    /// Their speeds.
    pub speeds: Speeds<N>,
    /// (rad) Γ, direction of the line at right angles to the crush plane.
    pub crush_plane: N,
    /// e.
    pub restitution: RestitutionModel<N>,
    /// (–) μ_max: largest ratio of the impulse along the crush plane to that across it. If a smaller ratio
    /// ends the sliding, the smaller one applies.
    pub friction: N,
    /// (–) λ, share of the tangential work that went into crush: E = W_n + λ W_t.
    pub tangential_share: N,
    /// The crush energy of the one vehicle whose crush is unknown; `None` if both are known, or neither.
    pub other_crush: Option<OtherCrush<N>>,
    /// The observations to compare with the impact.
    pub observed: Observed,
}

/// One vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VehicleNumbers<N = Number> {
    /// Its body; `None` for a fixed object.
    pub body: Option<BodyNumbers<N>>,
    /// (rad) heading in the scene.
    pub heading: N,
    /// (m) contact point C ahead of the CG, and to its left.
    pub contact: [N; 2],
    /// (rad/s) yaw rate before impact.
    pub yaw_rate: N,
    /// The crush energy.
    pub crush: Option<CrushNumbers<N>>,
}

/// The observations to compare with the impact of a particle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observed {
    /// The observations of each vehicle.
    pub vehicles: [ObservedVehicle; 2],
    /// Whether the PDOFs of both vehicles are too far from opposite to be one observation, so that the one
    /// that is nearer to a collision counts.
    pub pdofs_differ: bool,
    /// The usual severity of such collisions; `None` if no assumption is made.
    pub severity: Option<Severity>,
    /// The misfit between crush energy and impact; `None` if the crush is not evidence.
    pub crush: Option<CrushErrors>,
    /// Whether no vehicle has residual crush, so that the crush energy is only an upper bound: the energy at
    /// which residual crush begins.
    pub crush_is_bound: bool,
    /// The errors of the fitted figures behind the crush energies; `None` if none was fitted, or if they are
    /// taken as exact.
    pub figures: Option<CrushFigures>,
}

impl Observed {
    /// (–) standard deviation of the error of ln of a vehicle's crush energy that both vehicles share, with
    /// that of a fitted bias; `None` if the crush is not evidence.
    #[must_use]
    pub fn shared_ln_sd(&self, vehicle: VehicleId) -> Option<f64> {
        let CrushErrors(errors) = self.crush?;
        let (misfit, of_bias) = (
            errors[vehicle.index()].shared_ln_sd,
            self.figures.map_or(0.0, |figures| figures.bias_sd(vehicle)),
        );
        Some(Real::sqrt(misfit * misfit + of_bias * of_bias))
    }
}

/// The observations of a vehicle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservedVehicle {
    /// PDOF as coded.
    pub pdof: Option<CodedPdof>,
    /// Motion after the impact.
    pub after: PostImpactMotion,
    /// The rest position and heading.
    pub rest: Option<MeasuredRest>,
    /// (m/s) speed at the beginning of its skid before the impact.
    pub skid_speed: Option<MeasuredSpeed>,
    /// (m) standard deviation of the error of each point passed by its CG, in the order of the points.
    pub points: Vec<f64>,
    /// The data of its recorder.
    pub recorder: RecordedData,
    /// Certain limits of its speed.
    pub limits: Limits,
}

/// The rest position and heading of a vehicle, with the errors of the survey and of the model of its motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredRest {
    /// (m) position of the CG in the scene.
    pub position: Vector2<f64>,
    /// (m) its position at the impact: the normal score is that of the error along the line from there.
    pub impact: Vector2<f64>,
    /// The error of the position, in each direction.
    pub error: PlaceError,
    /// (rad) heading.
    pub heading: f64,
    /// Whether the heading includes full turns.
    pub turns_are_known: bool,
    /// (rad) standard deviation of the error of the heading.
    pub heading_sd: f64,
}

impl MeasuredRest {
    /// (m) standard deviation of the error of the position, at the measured distance from the impact.
    #[must_use]
    pub fn position_sd(&self) -> f64 {
        self.error.sd((self.position - self.impact).norm())
    }

    /// (m) how far the measured position is from a computed one, along the line from the impact and across it
    /// (to its left), as an error with the standard deviation [`Self::position_sd`].
    ///
    /// The error grows with the distance. It is taken at the geometric mean of the measured and the computed
    /// distance: a rest position that is too far by a factor is then as likely as one that is too near by it.
    /// With the error at the measured distance, the positions that are too near by chance would count for
    /// more.
    #[inline(always)]
    pub(crate) fn apart(&self, computed: Vector2<f64>) -> [f64; 2] {
        let (line, apart) = (self.position - self.impact, self.position - computed);
        let distance = line.norm();
        let (cos, sin) = if distance > 0.0 { (line.x / distance, line.y / distance) } else { (1.0, 0.0) };
        // Δ/√(σ σ̂) = Δ √(σ/σ̂)/σ
        let scale = Real::sqrt(self.error.sd(distance) / self.error.sd((computed - self.impact).norm()));
        [scale * (apart.x * cos + apart.y * sin), scale * (apart.y * cos - apart.x * sin)]
    }
}

/// The error of a place that the model of the motion computes, against the survey of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceError {
    /// (m) standard deviation of the model's error at the impact.
    pub least: f64,
    /// (–) growth of that with the distance from the impact.
    pub share: f64,
    /// (m) standard deviation of the survey's error.
    pub survey: f64,
}

impl PlaceError {
    /// (m) the standard deviation at a distance (m) from the impact.
    #[inline(always)]
    #[must_use]
    pub fn sd(self, distance: f64) -> f64 {
        // σ² = (least + share d)² + survey²
        let model = self.least + self.share * distance;
        Real::sqrt(model * model + self.survey * self.survey)
    }
}

/// Mass and radius of gyration of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyNumbers<N = Number> {
    /// (kg) mass.
    pub mass: N,
    /// (m) k, radius of gyration about the vertical axis: I = m k².
    pub yaw_radius: N,
}

/// The speeds of the vehicles along their headings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speeds<N = Number> {
    /// (m/s) each separately.
    Each([N; 2]),
    /// Neither is known, except that neither vehicle moved backward.
    Together {
        /// (–) ln c, c = |v₁ − v₂| (m/s) the relative speed of the CGs.
        ln_relative: N,
        /// (rad) φ between 0 and π/2: v₂/v₁ = tan φ. Below 0 vehicle 2 is at rest, above π/2 vehicle 1.
        split: N,
    },
    /// The same, where one vehicle has a speed within limits above 0. For any φ, ln c and ln v differ by a
    /// constant, so that a uniform ln v is a uniform ln c.
    Within {
        /// The vehicle.
        vehicle: VehicleId,
        /// (–) ln v of its speed (m/s).
        ln_speed: N,
        /// (rad) φ.
        split: N,
    },
}

/// (m/s) slowest and fastest relative speed considered.
const RELATIVE_SPEED: [f64; 2] = [0.3, 120.0];

impl Speeds {
    /// The distribution of ln c without prior knowledge.
    ///
    /// # Errors
    /// None, as these bounds are valid.
    pub fn any_ln_relative() -> Result<Distribution, InvalidDistribution> {
        let [slowest, fastest] = RELATIVE_SPEED;
        Distribution::uniform(ln(slowest), ln(fastest))
    }

    /// The distribution of φ if all that is known is the probability (–) that each vehicle was at rest.
    ///
    /// # Errors
    /// If a vehicle was certainly at rest, or a probability is negative.
    pub fn split_with_standing(stood: [f64; 2]) -> Result<Distribution, InvalidDistribution> {
        let [above, below] = standing(stood);
        Distribution::uniform(-below, FRAC_PI_2 + above)
    }

    /// The same if a vehicle moved at `least` (m/s) or faster: without the angles φ that would need a
    /// relative speed above all that are considered.
    ///
    /// # Errors
    /// As [`split_with_standing`](Self::split_with_standing), or if the speed is not above 0.
    pub fn split_within(
        vehicle: VehicleId,
        least: f64,
        stood: [f64; 2],
    ) -> Result<Distribution, InvalidDistribution> {
        let [above, below] = standing(stood);
        let farthest = atan2(RELATIVE_SPEED[1], least);
        match vehicle {
            VehicleId::One => Distribution::uniform(-below, farthest),
            VehicleId::Two => Distribution::uniform(FRAC_PI_2 - farthest, FRAC_PI_2 + above),
        }
    }

    /// The distribution of φ without prior knowledge.
    ///
    /// # Errors
    /// None, as these bounds are valid.
    pub fn any_split() -> Result<Distribution, InvalidDistribution> {
        Distribution::uniform(0.0, FRAC_PI_2)
    }
}

impl<N: Copy> Speeds<N> {
    /// Maps the numbers.
    #[inline(always)]
    #[must_use]
    pub fn map<M>(self, mut of: impl FnMut(N) -> M) -> Speeds<M> {
        match self {
            Self::Each([one, two]) => Speeds::Each([of(one), of(two)]),
            Self::Together { ln_relative, split } => {
                Speeds::Together { ln_relative: of(ln_relative), split: of(split) }
            }
            Self::Within { vehicle, ln_speed, split } => {
                Speeds::Within { vehicle, ln_speed: of(ln_speed), split: of(split) }
            }
        }
    }
}

impl Speeds<f64> {
    /// (m/s) the speeds along the headings, whose unit vectors are `forward`.
    #[inline(always)]
    #[must_use]
    pub fn along(self, forward: [Vector2<f64>; 2]) -> [f64; 2] {
        match self {
            Self::Each(speeds) => speeds,
            Self::Together { ln_relative, split } => {
                let (sin, cos) = shares(split);
                // c = s |cos φ f₁ − sin φ f₂|
                let apart = forward[0] * cos - forward[1] * sin;
                let scale = exp(ln_relative) / Real::sqrt(apart.x * apart.x + apart.y * apart.y);
                [scale * cos, scale * sin]
            }
            Self::Within { vehicle, ln_speed, split } => {
                let (sin, cos) = shares(split);
                let scale = exp(ln_speed) / if vehicle == VehicleId::One { cos } else { sin };
                [scale * cos, scale * sin]
            }
        }
    }
}

/// (rad) how far φ goes above π/2 and below 0: P(φ ≥ π/2) = p₁, P(φ ≤ 0) = p₂.
fn standing(stood: [f64; 2]) -> [f64; 2] {
    let moved = 1.0 - stood[0] - stood[1];
    stood.map(|stood| FRAC_PI_2 * stood / moved)
}

/// sin φ and cos φ, with φ limited to 0 and π/2.
#[inline(always)]
fn shares(split: f64) -> (f64, f64) {
    match split {
        angle if angle <= 0.0 => (0.0, 1.0),
        angle if angle >= FRAC_PI_2 => (1.0, 0.0),
        angle => sin_cos(angle),
    }
}

/// Coefficient of restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RestitutionModel<N = Number> {
    /// (–) constant.
    Constant(N),
    /// Falls with the closing speed: e = [`low` + `rise` exp(u_n/`fade`)] · `factor`, at most `most`.
    ByClosingSpeed {
        /// (–) e at high speeds.
        low: f64,
        /// (–) increase at a standstill.
        rise: f64,
        /// (m/s) closing speed at which 1/e of the increase is left.
        fade: f64,
        /// (–) factor of this collision on the mean.
        factor: N,
        /// (–) greatest e.
        most: f64,
    },
}

impl<N: Copy> RestitutionModel<N> {
    /// Maps the number.
    #[inline(always)]
    #[must_use]
    pub fn map<M>(self, mut of: impl FnMut(N) -> M) -> RestitutionModel<M> {
        match self {
            Self::Constant(e) => RestitutionModel::Constant(of(e)),
            Self::ByClosingSpeed { low, rise, fade, factor, most } => {
                RestitutionModel::ByClosingSpeed { low, rise, fade, factor: of(factor), most }
            }
        }
    }
}

impl RestitutionModel<f64> {
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
pub struct CrushNumbers<N = Number> {
    /// (J) constant part of the energy, L G₀.
    pub constant: f64,
    /// (J) part proportional to the depth, L A₀ C̄.
    pub linear: f64,
    /// (J) part proportional to its square, ½ L B₀ C²̄.
    pub square: f64,
    /// (–) κ, slope of the force of this vehicle over depth, relative to that of its kind.
    pub slope: N,
    /// (–) β, no-damage speed of this vehicle relative to that of its kind.
    pub no_damage_speed: N,
}

/// Crush energy of a vehicle with unknown crush, from that of the other: E_j = r E_i.
///
/// It makes the crush of the other vehicle alone evidence: with its share s = 1/(1 + r) of both energies,
/// ln E_i = ln(W_n + λ W_t) + ln s + b + error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherCrush<N = Number> {
    /// The vehicle with unknown crush.
    pub vehicle: VehicleId,
    /// (–) r, its crush energy relative to that of the other vehicle.
    pub ratio: N,
}

impl<N: Copy> OtherCrush<N> {
    /// Maps the number.
    #[inline(always)]
    #[must_use]
    pub fn map<M>(self, of: impl FnOnce(N) -> M) -> OtherCrush<M> {
        OtherCrush { vehicle: self.vehicle, ratio: of(self.ratio) }
    }
}

impl OtherCrush<f64> {
    /// (J) crush energies of both vehicles, with this one from the other of `known` (J).
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
    /// (–) b: mean excess of the crush energy over the energy taken by the impact.
    pub bias: f64,
    /// (–) standard deviation of the error, common to both vehicles.
    pub ln_sd: f64,
}

impl CrushMisfit {
    /// (–) average share of the impact's energy that crush energies show: exp b.
    #[must_use]
    pub fn shown(&self) -> f64 {
        exp(self.bias)
    }
}

/// Error of the crush energy of one vehicle relative to its part of the energy taken by the impact. It
/// depends on how the energy was obtained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyError {
    /// (–) b: mean excess of the logarithm of the crush energy over that of its part.
    pub bias: f64,
    /// (–) c: standard deviation of the error of the method, shared with the other vehicle.
    pub shared_ln_sd: f64,
    /// (–) o: standard deviation of the vehicle's own error.
    pub own_ln_sd: f64,
}

/// The errors of both vehicles:
/// ln(E₁ exp(−b₁) + E₂ exp(−b₂)) = ln(W_n + λ W_t) + error, σ² = (w₁ c₁ + w₂ c₂)² + (w₁ o₁)² + (w₂ o₂)²,
/// w_i the share of vehicle i in the sum on the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrushErrors(pub [EnergyError; 2]);

impl From<CrushMisfit> for CrushErrors {
    /// For energies obtained by the same method.
    fn from(CrushMisfit { bias, ln_sd }: CrushMisfit) -> Self {
        Self([EnergyError { bias, shared_ln_sd: ln_sd, own_ln_sd: 0.0 }; 2])
    }
}

/// ln √(ΔV₁ ΔV₂) is normally distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Severity {
    /// (m/s) median of the geometric mean of both ΔV.
    pub median: f64,
    /// (–) standard deviation of the logarithm.
    pub ln_sd: f64,
    /// (m/s) s, the scale beyond which speeds are rare: weight exp(−(v₁² + v₂²)/2s²).
    pub speed: f64,
    /// The risk of an injury, if the collision belongs to those in which somebody suffered it.
    pub injury: Option<InjuryRisk>,
    /// Number of speeds that are uniform before it. Each would make the median exp(σ²) times as high, which
    /// is divided out.
    pub uniform_speeds: u32,
}

/// The probability that somebody in a vehicle suffers an injury.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InjuryRisk {
    /// (–) logarithm of the odds without any ΔV.
    pub intercept: f64,
    /// (s/m) its increase with ΔV.
    pub slope: f64,
}

impl InjuryRisk {
    /// A serious injury, MAIS 3 or more, by total ΔV in frontal collisions, −6.9774 and 0.1620 per mph: Wang,
    /// MAIS(05/08) injury probability curves as functions of delta V, DOT HS 813 219 (2022), as in a public
    /// program.
    pub const SERIOUS: Self = Self { intercept: -6.9774, slope: 0.1620 / 0.44704 };

    /// (–) the logarithm of the probability that somebody in either vehicle suffers it; ΔV in m/s.
    #[must_use]
    pub fn ln_in_either(self, delta_v: [f64; 2]) -> f64 {
        // 1 − p = 1/(1 + exp(a + b ΔV))
        let none = |delta_v: f64| 1.0 / (1.0 + exp(self.intercept + self.slope * delta_v));
        // P = 1 − (1 − p₁)(1 − p₂)
        ln(1.0 - none(delta_v[0]) * none(delta_v[1]))
    }
}

impl Severity {
    /// (–) ln(√(ΔV₁ ΔV₂)/m) + n σ², for the logarithm of the ratio to the median m and n uniform speeds: a
    /// uniform v has a density ~ v of ln v, and v N(ln v; μ, σ²) ~ N(ln v; μ + σ², σ²).
    #[inline(always)]
    pub(crate) fn error(&self, ln_ratio: f64) -> f64 {
        ln_ratio + f64::from(self.uniform_speeds) * self.ln_sd * self.ln_sd
    }
}

/// PDOF as coded by an investigator, or from a recorder's ΔV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CodedPdof {
    /// (rad) direction from which the force came, clockwise from the heading.
    pub pdof: f64,
    /// (rad) scale of its error, Student's t with 2 degrees of freedom.
    pub scale: f64,
}

/// A measurement with a normal error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The measured value.
    pub value: f64,
    /// Standard deviation of its error.
    pub sd: f64,
}

/// A measured speed; part of its normal error is proportional to the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredSpeed {
    /// (m/s) the measured speed.
    pub value: f64,
    /// (–) standard deviation of the proportional part, which is that of the logarithm.
    pub ln_sd: f64,
    /// (m/s) standard deviation of the error at zero speed.
    pub least: f64,
}

/// A speed by a recorder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShownSpeed {
    /// One speed.
    One(MeasuredSpeed),
    /// (m/s) one of two, each with its probability: the wheels may have slipped.
    Either([(f64, Measured); 2]),
}

impl From<MeasuredSpeed> for ShownSpeed {
    fn from(speed: MeasuredSpeed) -> Self {
        Self::One(speed)
    }
}

/// Motion of a vehicle after the impact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PostImpactMotion {
    /// (m/s) speed of the CG.
    pub speed: Option<MeasuredSpeed>,
    /// (rad) direction of its velocity in the scene.
    pub direction: Option<Measured>,
    /// (rad/s) yaw rate.
    pub yaw_rate: Option<Measured>,
    /// Whether speed and direction are those of the common CG of both vehicles, which left as one.
    pub of_common_cg: bool,
}

/// Data stored by a recorder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RecordedData {
    /// Size of ΔV.
    pub delta_v: Option<RecordedDeltaV>,
    /// The longitudinal component of ΔV with its sign, from a recorder that stored only this one: replaces
    /// [`delta_v`](Self::delta_v).
    pub longitudinal: Option<RecordedPart>,
    /// Whether the record ends before the impact does, so that its ΔV is a lower bound.
    pub ends_early: bool,
    /// The direction from which the force came, from both components of its ΔV.
    pub direction: Option<CodedPdof>,
    /// (m/s) speed before impact.
    pub speed: Option<ShownSpeed>,
    /// (rad/s) yaw rate after the impact.
    pub yaw_rate: Option<Measured>,
    /// The place of the recorder, if its ΔV is that of this place; `None` if it is that of the CG.
    pub place: Option<RecorderPlace>,
}

/// The place of a recorder away from the CG.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecorderPlace {
    /// (m) forward and left of the CG.
    pub at: [f64; 2],
    /// (rad/s) yaw rate of the vehicle before the impact.
    pub yaw_rate: f64,
}

impl RecorderPlace {
    /// (m/s) the components of ΔV there, forward and left, from those of the CG and the yaw rate (rad/s)
    /// after the impact.
    #[must_use]
    pub fn sensed(&self, delta_v: [f64; 2], yaw_rate: f64) -> [f64; 2] {
        // Seen from the recorder, the CG turns the other way.
        recorder::delta_v_at_center(delta_v, self.yaw_rate - yaw_rate, self.at)
    }
}

/// ΔV stored by a recorder, with an error of its logarithm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedDeltaV {
    /// (m/s) stored size.
    pub size: f64,
    /// Whether it stored only the longitudinal component.
    pub is_longitudinal: bool,
    /// (–) scale of the error of the logarithm, Student's t.
    pub ln_scale: f64,
    /// (m/s) scale of the error of a ΔV of zero; if zero, only the logarithm has an error.
    pub least: f64,
    /// Degrees of freedom.
    pub freedom: Freedom,
}

/// The longitudinal component of ΔV, with its sign, stored by a recorder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedPart {
    /// (m/s) stored component, negative if the vehicle was slowed down.
    pub along: f64,
    /// (–) scale of the proportional part of the error, Student's t.
    pub ln_scale: f64,
    /// (m/s) scale of the error at zero, in addition to that from the lateral component.
    pub least: f64,
    /// Degrees of freedom.
    pub freedom: Freedom,
}

/// Certain limits of a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// (m/s) lower limit of the speed.
    pub least: f64,
    /// (m/s) upper limit of the speed.
    pub most: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { least: f64::NEG_INFINITY, most: f64::INFINITY }
    }
}
