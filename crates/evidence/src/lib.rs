//! What the evidence of a two-vehicle collision says of its speeds.
#![doc = include_str!("../README.md")]

mod collision;
mod density;
mod fitted;
mod impact;
mod model;
mod number;

pub use collision::{
    After, BodyNumbers, CodedPdof, Collision, Crush, CrushMisfit, Limits, Measured, MeasuredRest, Observed,
    ObservedVehicle, OtherCrush, RecordedDeltaV, Recorder, Restitution, Severity, Speeds, Vehicle,
};
pub use density::Freedom;
pub use fitted::{Damage, FITTED, Fitted};
pub use impact::{Impacted, Impacts, LEAST_APPROACH, Way};
pub use model::{Model, NO_IMPACT, Output, Piece, Placed, shown_delta_v};
pub use number::Number;
