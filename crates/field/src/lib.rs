#![doc = include_str!("../README.md")]

mod collision;
mod error;
mod judge;
mod pair;

pub use error::FieldError;
pub use judge::{Field, Figures, Group, Judged, Kind, LEVELS, Options, judge};
pub use pair::{Pair, Plane, Truth, Vehicle, read};
