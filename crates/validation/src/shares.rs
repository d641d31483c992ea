//! The speed of vehicle 1 with a share λ of the tangential work in the crush energy, and the true one.

use reconcile::ReconcileError;

use crate::error::ValidationError;
use crate::staged::Staged;
use crate::statistics::ErrorRate;

/// (–) the shares λ that are compared, from the paper's method to all of the work.
pub const SHARES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The speeds of one test. Crush energy from the published profiles, μ = μ_c and e of SAE 871993.
#[derive(Clone, Debug, PartialEq)]
pub struct ShareRow {
    /// The test.
    pub test: u8,
    /// (m/s) true speed of vehicle 1.
    pub true_speed: f64,
    /// (m/s) the speed found with each of [`SHARES`]; `None` if no speed gives the crush energy.
    pub found: [Option<f64>; SHARES.len()],
}

impl ShareRow {
    /// The error of each speed as a share of the true one.
    #[must_use]
    pub fn errors(&self) -> [Option<f64>; SHARES.len()] {
        self.found.map(|found| found.map(|found| found / self.true_speed - 1.0))
    }
}

pub(crate) fn by_share(staged: &[Staged]) -> Result<Vec<ShareRow>, ValidationError> {
    staged
        .iter()
        .map(|staged| {
            let mut found = [None; SHARES.len()];
            for (found, share) in found.iter_mut().zip(SHARES) {
                *found = answer(staged, share)?;
            }
            Ok(ShareRow { test: staged.printed.test, true_speed: staged.true_speed, found })
        })
        .collect()
}

fn answer(staged: &Staged, share: f64) -> Result<Option<f64>, ValidationError> {
    let [e1, e2] = staged.from_profiles;
    match staged.speed_with_share(e1 + e2, Some(staged.critical(None)?), share) {
        Ok(speed) => Ok(Some(speed)),
        Err(ValidationError::Reconcile {
            source: ReconcileError::NotReached { .. } | ReconcileError::Inadmissible { .. },
            ..
        }) => Ok(None),
        Err(error) => Err(error),
    }
}

/// The relative errors with each of [`SHARES`], over the tests that have an answer.
pub(crate) fn share_errors(rows: &[ShareRow]) -> [ErrorRate; SHARES.len()] {
    [0, 1, 2, 3, 4].map(|i| {
        let errors: Vec<f64> = rows.iter().filter_map(|row| row.errors()[i]).collect();
        ErrorRate::of(&errors)
    })
}
