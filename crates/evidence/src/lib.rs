//! Estimates the speeds of a two-vehicle collision from its evidence.
#![doc = include_str!("../README.md")]
//!
//! # Example
//!
//! A car of 1500 kg ran squarely into the rear of a standing one of 1000 kg, at 15 ± 2 m/s according to a
//! witness. According to its path to rest, the struck car left the impact at 11 ± 0.66 m/s.
//!
//! ```
//! use estimate::{DrawnQuantity, ParticleSettings, sample_quietly};
//! use evidence::{BodyNumbers, Collision, CollisionModel, DrawnOutput, MeasuredSpeed, Observed};
//! use evidence::{RestitutionModel, Speeds, VehicleNumbers};
//! use pim_core::VehicleId;
//! use uncertainty::Distribution;
//!
//! let vehicle = |mass: f64, ahead: f64| VehicleNumbers {
//!     body: Some(BodyNumbers { mass: mass.into(), yaw_radius: 1.4.into() }),
//!     heading: 0.0.into(),
//!     contact: [ahead.into(), 0.0.into()],
//!     yaw_rate: 0.0.into(),
//!     crush: None,
//! };
//! let mut observed = Observed::default();
//! observed.vehicles[1].after.speed = Some(MeasuredSpeed { value: 11.0, ln_sd: 0.0, least: 0.66 });
//! let collision = Collision {
//!     vehicles: [vehicle(1500.0, 2.0), vehicle(1000.0, -2.0)],
//!     speeds: Speeds::Each([Distribution::normal(15.0, 2.0)?.into(), 0.0.into()]),
//!     crush_plane: 0.0.into(),
//!     restitution: RestitutionModel::Constant(0.1.into()),
//!     friction: 0.7.into(),
//!     tangential_share: 0.5.into(),
//!     other_crush: None,
//!     observed,
//! };
//!
//! let model = CollisionModel::new(&collision);
//! let posterior = sample_quietly(&model, &model, &ParticleSettings::new(512, 1))?;
//! let speed = posterior.summary(DrawnQuantity::Output(DrawnOutput::Speed(VehicleId::One).column()));
//! // By hand: V₂ = (1 + e) m₁/(m₁ + m₂) v₁ = 0.66 v₁, so the measurement says v₁ = 16.67 ± 1 m/s. With the
//! // witness: (16.67/1² + 15/2²)/(1/1² + 1/2²) = 16.33, ± 1/√1.25 = 0.89 m/s.
//! assert!((speed.mean.value - 16.33).abs() < 0.1);
//! assert!((speed.sd.value - 0.894).abs() < 0.08);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod collision;
mod density;
mod figures;
mod fitted;
mod impact;
mod model;
mod number;
mod tested;

pub use collision::{
    BodyNumbers, CodedPdof, Collision, CrushErrors, CrushMisfit, CrushNumbers, EnergyError, InjuryRisk,
    Limits, Measured, MeasuredRest, MeasuredSpeed, Observed, ObservedVehicle, OtherCrush, PlaceError,
    PostImpactMotion, RecordedData, RecordedDeltaV, RecordedPart, RecorderPlace, RestitutionModel, Severity,
    ShownSpeed, Speeds, VehicleNumbers,
};
pub use density::Freedom;
pub use figures::{CRUSH_FIGURES, CrushChange, CrushFigures, OfVehicle};
pub use fitted::{Behind, DamagedSide, EnergyMethod, FIGURES, FITTED, FigureErrors, Fitted, ObjectFigures};
pub use impact::{DrawnOutput, Impacted, Impacts, LEAST_APPROACH, Way};
pub use model::{CollisionModel, NO_IMPACT, Piece, Placed, shown_delta_v};
pub use number::Number;
pub use tested::{FLEET_YEARS, TestedClass};
