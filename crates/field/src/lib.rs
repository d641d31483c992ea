#![doc = include_str!("../README.md")]

mod case_text;
mod collision;
mod crossed;
mod direction;
mod error;
mod fit;
mod judge;
mod pair;
mod read;
mod share;

pub use direction::{DirectionFit, fit_direction};
pub use error::FieldError;
pub use fit::{Figure, Fit, FitOptions, Folds, fit, fit_folds};
pub use judge::{Field, Figures, Group, Judged, Kind, KnownCrush, LEVELS, Options, judge, judge_by};
pub use pair::{Pair, Plane, Truth, Vehicle};
pub use read::read;
pub use share::{ShareFit, fit_share};
