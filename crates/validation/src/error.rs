//! Why there is no validation: faults of the data, never of a comparison.

use case::Diagnostics;
use crash3::CrushError;
use estimate::Failure;
use pim_core::{InvalidInput, VehicleId};
use reconcile::{MomentumError, ReconcileError};
use thiserror::Error;
use trajectory::{NoRest, Unreached};
use uncertainty::InvalidDistribution;

/// The data are not such that they can be compared. The program's own are.
#[derive(Debug, Error)]
pub enum ValidationError {
    /// The printed numbers cannot be read.
    #[error("the printed numbers cannot be read: {0}")]
    Published(Box<toml::de::Error>),
    /// A figure says both or neither of two things.
    #[error(
        "the figure {quantity:?} needs either `tolerance` or `known`, and `reason` where it has `printed`"
    )]
    Figure {
        /// Which.
        quantity: String,
    },
    /// A figure that the example's analysis does not have.
    #[error("the analysis of the paper's example has no {quantity}, which the comparison needs")]
    NoFigure {
        /// Which.
        quantity: String,
    },
    /// A collision of which there is no case.
    #[error("test {test} is printed, but there is no case of it; the cases are those of tests {known}")]
    NoCase {
        /// Which.
        test: u8,
        /// Those that there are.
        known: String,
    },
    /// A case lacks what the comparison needs.
    #[error("the case of test {test} has no {what}, which the comparison needs")]
    Incomplete {
        /// Which.
        test: u8,
        /// What it lacks.
        what: &'static str,
    },
    /// A table names a test that is not printed.
    #[error("a table is over test {test}, which is not among the collisions")]
    NotPrinted {
        /// Which.
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
        /// Of which.
        test: u8,
        /// Why.
        source: ReconcileError,
    },
    /// A law or a vehicle is not one.
    #[error(transparent)]
    Law(#[from] InvalidInput),
    /// CRASH3 has no answer.
    #[error("test {test}: {source}")]
    Crush {
        /// Of which.
        test: u8,
        /// Why.
        source: CrushError,
    },
    /// A vehicle does not come to rest.
    #[error("test {test}, vehicle {vehicle}: {source}")]
    Motion {
        /// Of which.
        test: u8,
        /// Which vehicle.
        vehicle: VehicleId,
        /// Why.
        source: NoRest,
    },
    /// No motion leads to a vehicle's rest.
    #[error("test {test}, vehicle {vehicle}: {source}")]
    Unreached {
        /// Of which.
        test: u8,
        /// Which vehicle.
        vehicle: VehicleId,
        /// Why.
        source: Unreached,
    },
    /// An error of what is known makes no distribution.
    #[error("test {test}: {source}")]
    Prior {
        /// Of which.
        test: u8,
        /// Why.
        source: InvalidDistribution,
    },
    /// There are no draws of the posterior.
    #[error("test {test}: {source}")]
    Estimate {
        /// Of which.
        test: u8,
        /// Why.
        source: Box<Failure>,
    },
    /// Momentum does not give both speeds.
    #[error("test {test}: {source}")]
    Momentum {
        /// Of which.
        test: u8,
        /// Why.
        source: MomentumError,
    },
}
