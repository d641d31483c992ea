//! Why a validation fails: faults of the data, never of a comparison.

use case::Diagnostics;
use crash3::CrushError;
use estimate::NoDraws;
use pim_core::{InvalidInput, VehicleId};
use reconcile::{MomentumError, ReconcileError};
use thiserror::Error;
use trajectory::{NoRest, Unreached};
use uncertainty::InvalidDistribution;

/// The data cannot be compared. The built-in data can.
#[derive(Debug, Error)]
pub enum ValidationError {
    /// The printed numbers cannot be read.
    #[error("the printed numbers cannot be read: {0}")]
    Published(Box<toml::de::Error>),
    /// A figure with an invalid combination of keys.
    #[error(
        "the figure {quantity:?} needs either `tolerance` or `known`, and `reason` where it has `printed`"
    )]
    Figure {
        /// Its name.
        quantity: String,
    },
    /// A figure that the example's analysis does not have.
    #[error("the analysis of the paper's example has no {quantity}, which the comparison needs")]
    NoFigure {
        /// Its name.
        quantity: String,
    },
    /// A collision without a case.
    #[error("test {test} is printed, but there is no case of it; the cases are those of tests {known}")]
    NoCase {
        /// Its number.
        test: u8,
        /// The known collisions.
        known: String,
    },
    /// A case lacks what the comparison needs.
    #[error("the case of test {test} has no {what}, which the comparison needs")]
    Incomplete {
        /// The test.
        test: u8,
        /// The missing data.
        what: &'static str,
    },
    /// A table names a test without printed numbers.
    #[error("a table is over test {test}, which is not among the collisions")]
    NotPrinted {
        /// The test.
        test: u8,
    },
    /// A case cannot be read.
    #[error(transparent)]
    Case(#[from] Diagnostics),
    /// A case has no answer.
    #[error(transparent)]
    Analysis(#[from] analysis::Failure),
    /// No speed reconciles crush and impact.
    #[error("test {test}: {source}")]
    Reconcile {
        /// The test.
        test: u8,
        /// The reason.
        source: ReconcileError,
    },
    /// The inputs of an impact law or of a vehicle are invalid.
    #[error(transparent)]
    Law(#[from] InvalidInput),
    /// CRASH3 has no answer.
    #[error("test {test}: {source}")]
    Crush {
        /// The test.
        test: u8,
        /// The reason.
        source: CrushError,
    },
    /// A vehicle does not come to rest.
    #[error("test {test}, vehicle {vehicle}: {source}")]
    Motion {
        /// The test.
        test: u8,
        /// The vehicle.
        vehicle: VehicleId,
        /// The reason.
        source: NoRest,
    },
    /// No motion leads to a vehicle's rest position.
    #[error("test {test}, vehicle {vehicle}: {source}")]
    Unreached {
        /// The test.
        test: u8,
        /// The vehicle.
        vehicle: VehicleId,
        /// The reason.
        source: Unreached,
    },
    /// The error of an input is not a valid distribution.
    #[error("test {test}: {source}")]
    Prior {
        /// The test.
        test: u8,
        /// The reason.
        source: InvalidDistribution,
    },
    /// The posterior has no draws.
    #[error("test {test}: {source}")]
    Estimate {
        /// The test.
        test: u8,
        /// The reason.
        source: Box<NoDraws>,
    },
    /// Momentum does not give both speeds.
    #[error("test {test}: {source}")]
    Momentum {
        /// The test.
        test: u8,
        /// The reason.
        source: MomentumError,
    },
}
