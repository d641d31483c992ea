#![doc = include_str!("../README.md")]

mod case_text;
mod collision;
mod error;
mod fit;
mod judge;
mod pair;

pub use error::FieldError;
pub use fit::{Figure, Fit, FitOptions, Folds, fit, fit_folds};
pub use judge::{Field, Figures, Group, Judged, Kind, LEVELS, Options, judge, judge_by};
pub use pair::{Pair, Plane, Truth, Vehicle, read};
