//! What the evidence of a two-vehicle collision says of its speeds.
#![doc = include_str!("../README.md")]

mod collision;
mod density;
mod fitted;
mod impact;
mod model;
mod number;

pub use collision::{
    After, BodyNumbers, CodedPdof, Collision, Crush, CrushErrors, CrushMisfit, EnergyError, Limits, Measured,
    MeasuredRest, MeasuredSpeed, Observed, ObservedVehicle, OtherCrush, RecordedDeltaV, RecordedPart,
    Recorder, Restitution, Severity, Speeds, Vehicle,
};
pub use density::Freedom;
pub use fitted::{Damage, EnergyMethod, FITTED, Fitted};
pub use impact::{Impacted, Impacts, LEAST_APPROACH, Way};
pub use model::{Model, NO_IMPACT, Output, Piece, Placed, shown_delta_v};
pub use number::Number;
