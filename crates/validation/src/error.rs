//! Why a validation fails: faults of the data, never of a comparison.

use std::error::Error;

use case::Diagnostics;
use pim_core::{InvalidInput, VehicleId};
use reconcile::ReconcileError;

/// The data cannot be compared. The built-in data can.
#[derive(Debug, thiserror::Error)]
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
    #[error("a table is about test {test}, which is not among the collisions")]
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
    /// Another part of a test has no answer.
    #[error("test {test}: {source}")]
    Test {
        /// The test.
        test: u8,
        /// The reason.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A vehicle does not come to rest, or no motion leads to its rest position.
    #[error("test {test}, vehicle {vehicle}: {source}")]
    Vehicle {
        /// The test.
        test: u8,
        /// The vehicle.
        vehicle: VehicleId,
        /// The reason.
        source: Box<dyn Error + Send + Sync>,
    },
}

impl ValidationError {
    pub(crate) fn of_test(test: u8, source: impl Error + Send + Sync + 'static) -> Self {
        Self::Test { test, source: Box::new(source) }
    }
}
