//! What the program takes from a table or a formula in place of a measurement, and how far that may be off.

use std::fmt;

use crash3::{CrushError, SideStiffness, Stiffness};
use pim_core::{Real, VehicleId};

use crate::case::Case;
use crate::crush::StiffnessForm;
use crate::demands::YawSource;
use crate::vehicle::GivenVehicle;

/// (–) standard deviation of ln A among the vehicles of a fleet.
///
/// From 698 full-width frontal barrier tests of NHTSA, medians A = 64 kN/m and B = 769 kN/m².
pub const STIFFNESS_LN_SD_A: f64 = 0.38;
/// (–) the same of ln B.
pub const STIFFNESS_LN_SD_B: f64 = 0.59;
/// (–) by how much k of a size class or by Burg's formula may be off, with a probability of
/// [`YAW_RADIUS_CONFIDENCE`].
pub const YAW_RADIUS_WITHIN: f64 = 0.05;
/// (–) that probability.
pub const YAW_RADIUS_CONFIDENCE: f64 = 0.95;

/// A value of a vehicle that comes from a table or a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Estimate {
    /// Stiffness of a category: the factor is that of A; B goes with it, as stiff vehicles have more of both.
    Stiffness {
        /// Whose.
        vehicle: VehicleId,
        /// The category.
        category: u8,
    },
    /// Radius of gyration of a size class, or by Burg's formula.
    YawRadius {
        /// Whose.
        vehicle: VehicleId,
        /// Where it comes from.
        source: YawSource,
    },
}

/// The path of its factor among the numbers that may vary.
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stiffness { vehicle, .. } => write!(f, "vehicle{vehicle}.crush.stiffness.factor"),
            Self::YawRadius { vehicle, .. } => write!(f, "vehicle{vehicle}.yaw_radius.factor"),
        }
    }
}

impl Estimate {
    /// The key of the value that is estimated.
    #[must_use]
    pub fn key(self) -> String {
        match self {
            Self::Stiffness { vehicle, .. } => format!("vehicle{vehicle}.crush.stiffness"),
            Self::YawRadius { vehicle, .. } => format!("vehicle{vehicle}.yaw_inertia"),
        }
    }
}

/// (–) by what the estimates of both vehicles are multiplied: 1 where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Factors<T = f64> {
    /// On A of a stiffness category.
    pub stiffness: [Option<T>; 2],
    /// On the radius of gyration of a size class or by Burg's formula.
    pub yaw_radius: [Option<T>; 2],
}

/// The stiffness of another vehicle of the same category, whose A is so many times as large.
pub(crate) fn scaled<T: Real>(
    structure: SideStiffness<T>,
    factor: T,
) -> Result<SideStiffness<T>, CrushError> {
    let SideStiffness::Uniform(stiffness) = structure else { return Ok(structure) };
    // A = f A₀ with ln f = σ_A z, B = B₀ exp(σ_B z) = f^(σ_B/σ_A) B₀
    let b_factor = factor.power(STIFFNESS_LN_SD_B / STIFFNESS_LN_SD_A);
    // G is A²/2B
    let g_factor = factor * factor / b_factor;
    let (a, b, g) = (stiffness.a() * factor, stiffness.b() * b_factor, stiffness.g() * g_factor);
    Stiffness::from_abg(a, b, g).map(SideStiffness::Uniform)
}

/// Where the yaw inertia of a vehicle comes from: what is given takes precedence over the class, and that
/// over Burg's formula. `None` where nothing tells it.
pub(crate) fn yaw_source<T>(vehicle: &GivenVehicle<T>) -> Option<YawSource> {
    let has_length = vehicle.outline.is_some() || vehicle.length.is_some();
    match (&vehicle.yaw, vehicle.class) {
        (Some(_), _) => Some(YawSource::Given),
        (None, Some(class)) => Some(YawSource::Class(class)),
        (None, None) => (vehicle.wheelbase.is_some() && has_length).then_some(YawSource::Burg),
    }
}

impl<T> Case<T> {
    /// Whether the stiffness of each vehicle comes from a category, and its radius of gyration from a class
    /// or a formula.
    #[must_use]
    pub fn estimates(&self) -> Vec<Estimate> {
        let of = |vehicle: VehicleId| {
            let given = &self.vehicles[vehicle.index()];
            let category = given.crush.as_ref().and_then(|crush| match crush.stiffness {
                StiffnessForm::Category(category) => Some(category),
                _ => None,
            });
            let source = yaw_source(given).filter(|source| *source != YawSource::Given);
            let stiffness = category.map(|category| Estimate::Stiffness { vehicle, category });
            let yaw_radius = source.map(|source| Estimate::YawRadius { vehicle, source });
            [stiffness, yaw_radius].into_iter().flatten().filter(|_| !given.fixed)
        };
        VehicleId::ALL.into_iter().flat_map(of).collect()
    }
}
