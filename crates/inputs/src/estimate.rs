//! Values from a table or a formula in place of measurements, and their uncertainty.

use std::fmt;

use crash3::{CrushError, Side, Stiffness};
use pim_core::{Real, VehicleId};

use crate::quantity::Quantity;

/// The stiffness of many cars in place of that of the car itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TypicalStiffness {
    /// A category of CRASH3's table for the damaged side, 1 to 5.
    Category(u8),
    /// The cars on the road, by the damaged side: [`crash3::FLEET`].
    Fleet,
}

impl TypicalStiffness {
    /// The stiffness of a side.
    ///
    /// # Errors
    /// If there is no such category.
    pub fn stiffness<T: Real>(self, side: Side) -> Result<Stiffness<T>, CrushError> {
        match self {
            Self::Category(category) => Stiffness::from_category(side, category),
            Self::Fleet => Stiffness::of_fleet(side),
        }
    }

    /// (–) standard deviations of ln A and of ln B among such cars, which vary together.
    ///
    /// Those of a category are from 698 full-width frontal barrier tests of NHTSA, medians A = 64 kN/m and B
    /// = 769 kN/m². In the fleet the slope b₁ ∝ √B and the no-damage speed b₀ ∝ A/√B vary independently, by
    /// 0.18 and 0.38 of ln (docs/calibration.md); varying together by 0.15 and 0.25, they give the energy of
    /// 0.1 to 0.5 m of crush the same spread within 7 %.
    #[must_use]
    pub fn ln_sds(self) -> [f64; 2] {
        match self {
            Self::Category(_) => [0.38, 0.59],
            Self::Fleet => [0.40, 0.30],
        }
    }

    /// The stiffness of another car of this kind, whose A is `factor` times that of the `known` one; that one
    /// without a factor.
    ///
    /// # Errors
    /// If there is no such stiffness.
    #[inline(always)]
    pub fn of_car<T: Real>(self, known: Stiffness<T>, factor: Option<T>) -> Result<Stiffness<T>, CrushError> {
        let Some(factor) = factor else { return Ok(known) };
        let [of_a, of_b] = self.ln_sds();
        // A = f A₀ with ln f = σ_A z, B = B₀ exp(σ_B z) = f^(σ_B/σ_A) B₀
        let b_factor = factor.power(of_b / of_a);
        // G is A²/2B
        let g_factor = factor * factor / b_factor;
        Stiffness::from_abg(known.a() * factor, known.b() * b_factor, known.g() * g_factor)
    }
}

/// (–) probability with which k of a size class or by Burg's formula is [as accurate as
/// assumed](YawSource::within).
pub const YAW_RADIUS_CONFIDENCE: f64 = 0.95;

/// (m) standard deviation of the offset of a damage: 1.8 in.
///
/// Like those of its length and its depths, from 34 pairs of measurements of the same damage: Smith and Noga,
/// *Accuracy and Sensitivity of CRASH*, SAE 821169 (1982), cited by Neades, thesis, Table 5.2.
pub const OFFSET_SD: f64 = 1.8 * 0.0254;
/// (m) standard deviation of the length of a damage, the `width` of a case: 3.0 in.
pub const DAMAGE_LENGTH_SD: f64 = 3.0 * 0.0254;
/// (m) standard deviation of a depth of crush: 1.5 in.
pub const DEPTH_SD: f64 = 1.5 * 0.0254;

/// The source of a yaw inertia.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum YawSource {
    /// The case gives it, or the radius of gyration.
    Given,
    /// The radius of gyration of CRASH3's size class.
    Class(u8),
    /// Burg's estimate from wheelbase and length.
    Burg,
    /// It is not known.
    Unknown,
}

impl YawSource {
    /// (–) the relative error of an estimated radius of gyration, which it exceeds with a probability of 1 −
    /// [`YAW_RADIUS_CONFIDENCE`].
    #[must_use]
    pub fn within(self) -> f64 {
        if let Self::Class(_) = self { crash3::CLASS_SPREAD } else { crash3::BURG_SPREAD }
    }
}

/// A direction at the damaged face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceAxis {
    /// Along the face, in the sense of the `offset`.
    Along,
    /// Across it, into the vehicle.
    Inward,
}

impl FaceAxis {
    /// Both directions.
    pub const ALL: [Self; 2] = [Self::Along, Self::Inward];

    /// Its index in a pair.
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::Along => 0,
            Self::Inward => 1,
        }
    }
}

/// The uncertainty of a placed contact point in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactSpread {
    /// (m) its own standard deviation.
    Default(f64),
    /// That of the ranges given for the numbers that determine it.
    OfInputs,
    /// None, as requested by the case.
    Exact,
}

/// A value of a vehicle from a table or a formula, or a point placed by the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EstimatedInput {
    /// Stiffness of many cars: the factor is that of A; B varies with it, as both are high in stiff
    /// vehicles.
    Stiffness {
        /// The vehicle.
        vehicle: VehicleId,
        /// The cars.
        typical: TypicalStiffness,
    },
    /// Radius of gyration of a size class, or by Burg's formula.
    YawRadius {
        /// The vehicle.
        vehicle: VehicleId,
        /// Its source.
        source: YawSource,
    },
    /// Contact point at the centroid of the damage.
    Contact {
        /// The vehicle.
        vehicle: VehicleId,
        /// The direction in which it is moved.
        axis: FaceAxis,
    },
}

/// The path of its factor, or of its displacement, among the numbers that may vary.
impl fmt::Display for EstimatedInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stiffness { vehicle, .. } => write!(f, "vehicle{vehicle}.crush.stiffness.factor"),
            Self::YawRadius { vehicle, .. } => write!(f, "vehicle{vehicle}.yaw_radius.factor"),
            Self::Contact { vehicle, axis: FaceAxis::Along } => write!(f, "vehicle{vehicle}.contact.along"),
            Self::Contact { vehicle, axis: FaceAxis::Inward } => write!(f, "vehicle{vehicle}.contact.inward"),
        }
    }
}

impl EstimatedInput {
    /// The key of the value that is estimated.
    #[must_use]
    pub fn key(self) -> String {
        match self {
            Self::Stiffness { vehicle, .. } => format!("vehicle{vehicle}.crush.stiffness"),
            Self::YawRadius { vehicle, .. } => format!("vehicle{vehicle}.yaw_inertia"),
            Self::Contact { vehicle, .. } => format!("vehicle{vehicle}.contact"),
        }
    }
}

/// How far the estimates of both vehicles are varied; `None` if there is no estimate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Departures<T = f64> {
    /// (–) factor on A of a typical stiffness.
    pub stiffness: [Option<T>; 2],
    /// (–) factor on the radius of gyration of a size class or by Burg's formula.
    pub yaw_radius: [Option<T>; 2],
    /// (m) displacement of a placed contact point, for each [`FaceAxis`].
    pub contact: [[Option<Quantity<T>>; 2]; 2],
}
