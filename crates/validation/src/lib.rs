//! The program's error rate: its results compared with the RICSAC staged collisions and with the numbers that
//! papers print for them.
//!
//! ```
//! let validation = validation::validate(&validation::Data::built_in())?;
//! assert!(validation.failures().is_empty());
//! // SAE 980025, Table 1: rms error of PIM over the 60° front to side collisions, 2.73 ft/s.
//! let rms = validation.table1[0].paper_rows.ours / validation::FOOT_PER_SECOND;
//! assert!((rms - 2.73).abs() < 0.02);
//! # Ok::<(), validation::ValidationError>(())
//! ```
//!
//! The types: [`validate`] runs the [`Data`] and returns a [`Validation`], whose tables consist of [`Cell`]s:
//! our number, the paper's, and a [`Claim`]. [`Validation::failures`] lists the claims that fail; a known
//! difference carries its reason, and a misprint of the paper its [`Erratum`]. [`ErrorRate`] gives the errors
//! of computed velocities.
//!
//! `examples/error_rate.rs` prints the error of each reconstructed speed.
//!
//! # What the comparison shows
//!
//! e and μ of SAE 871993 were fitted to these very tests, and the distances d_1 and d_2 were solved back from
//! the paper's numbers. So the PIM rows show that the equations are the paper's, not that they predict a
//! collision. The reconstruction from the published crush profiles tests the program's purpose.
//!
//! # What it does not do
//!
//! It adds no equation of mechanics: every result comes from `analysis`, `crash3`, `evidence`, `pim-core`,
//! `reconcile` and `trajectory`. It writes no text (`report`).

mod appendix;
mod both_speeds;
mod claim;
mod data;
mod error;
mod judged;
mod motion;
mod published;
mod reconstruction;
mod requirements;
mod scene;
mod shares;
mod staged;
mod statistics;
mod tables;

pub use appendix::AppendixFigure;
pub use both_speeds::{BothSpeedErrors, BothSpeedsRow, FromRestRow, RestMethod, SpeedEvidence, speed_error};
pub use claim::{Cell, Claim, Erratum};
pub use data::Data;
pub use error::ValidationError;
pub use judged::{
    AfterImpact, AssumedErrors, JudgedSpeed, JudgedTest, JudgedTests, judge_speeds, judge_speeds_assuming,
};
pub use motion::{FoundStart, MotionRow, ReturnRow, Simulation};
pub use published::{DEGREE, FOOT_PER_SECOND, FOOT_POUND, PrintedUnit};
pub use reconstruction::{Choices, Reconstruction, SpeedErrors, TurnedPdof};
pub use requirements::Requirement;
pub use shares::{SHARES, ShareRow};
pub use statistics::ErrorRate;
pub use tables::{DeltaVErrors, DeltaVRow, EnergyRow, Method, Table1Row, Table2Row, Table3Rms, Table3Row};

use pim_core::VehicleId;
use published::Published;
use scene::Scene;
use staged::Staged;

/// All comparisons.
#[derive(Clone, Debug, PartialEq)]
pub struct Validation {
    /// The paper's Table 1.
    pub table1: Vec<Table1Row>,
    /// The paper's Table 2.
    pub table2: Vec<Table2Row>,
    /// The paper's Table 3.
    pub table3: Vec<Table3Row>,
    /// The last column of the paper's Table 3.
    pub table3_rms: Vec<Table3Rms>,
    /// SAE 871993, Table 1.
    pub energies: Vec<EnergyRow>,
    /// The paper's appendix.
    pub appendix: Vec<AppendixFigure>,
    /// The speed of vehicle 1, found and true.
    pub reconstructions: Vec<Reconstruction>,
    /// Velocity changes against measured ones.
    pub delta_v_errors: DeltaVErrors,
    /// Reconstructed speeds against true ones.
    pub speed_errors: SpeedErrors,
    /// The speed of vehicle 1, by the share of the tangential work in the crush energy.
    pub by_share: Vec<ShareRow>,
    /// Their relative errors, by share.
    pub share_errors: [ErrorRate; SHARES.len()],
    /// The motions from the published velocities after the impact to rest.
    pub motions: Vec<MotionRow>,
    /// The motions from rest back to those velocities.
    pub returns: Vec<ReturnRow>,
    /// The accuracy of simulations of whole collisions.
    pub simulations: Vec<Simulation>,
    /// Both speeds from the published velocities after the impact.
    pub both_speeds: Vec<BothSpeedsRow>,
    /// Their errors.
    pub both_speed_errors: BothSpeedErrors,
    /// Both speeds from the published rest positions.
    pub from_rest: Vec<FromRestRow>,
    /// The data behind all of it.
    pub data: Data,
}

/// Runs all collisions and compares the results.
///
/// # Errors
/// If the data cannot be run or do not fit together, which never happens with the built-in data.
pub fn validate(data: &Data) -> Result<Validation, ValidationError> {
    let published = Published::read(data)?;
    let scene = Scene::read(data)?;
    let staged = published
        .collision
        .iter()
        .map(|collision| Staged::run(data, collision))
        .collect::<Result<Vec<_>, _>>()?;
    let named = published.table1.iter().flat_map(|row| &row.tests);
    for &test in named.chain(published.table3.iter().flat_map(|half| &half.tests)) {
        if !staged.iter().any(|staged| staged.printed.test == test) {
            return Err(ValidationError::NotPrinted { test });
        }
    }
    let table2 = gather(&staged, tables::table2)?;
    let table3 = gather(&staged, tables::table3)?;
    let reconstructions = staged.iter().map(reconstruction::reconstruction).collect::<Result<Vec<_>, _>>()?;
    let (motions, returns) = motion::motions(&scene, &staged)?;
    let both_speeds = both_speeds::both_speeds(&scene, &staged)?;
    let by_share = shares::by_share(&staged)?;
    Ok(Validation {
        table1: tables::table1(&published, &table2),
        table3_rms: tables::table3_rms(&published, &table3),
        energies: staged.iter().map(tables::energies).collect::<Result<_, _>>()?,
        appendix: appendix::appendix(data, &published)?,
        delta_v_errors: tables::delta_v_errors(&table2),
        speed_errors: reconstruction::speed_errors(&reconstructions),
        share_errors: shares::share_errors(&by_share),
        by_share,
        simulations: motion::simulations(&scene),
        both_speed_errors: both_speeds::both_speed_errors(&both_speeds),
        from_rest: both_speeds::from_rest(&scene, &staged)?,
        motions,
        returns,
        both_speeds,
        table2,
        table3,
        reconstructions,
        data: data.clone(),
    })
}

fn gather<T>(
    staged: &[Staged],
    rows: impl Fn(&Staged) -> Result<Vec<T>, ValidationError>,
) -> Result<Vec<T>, ValidationError> {
    Ok(staged.iter().map(rows).collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

impl Validation {
    /// All cells, each with the name of its position.
    #[must_use]
    pub fn cells(&self) -> Vec<(String, &Cell)> {
        let mut cells = Vec::new();
        for row in &self.table1 {
            let method = match row.method {
                Method::Pim => "PIM",
                Method::Crash3 => "CRASH3",
            };
            cells.push((format!("Table 1, {}, {method}", row.geometry), &row.paper_rows));
        }
        for row in &self.table2 {
            let place = |id| format!("Table 2, test {}, {:?}, vehicle {id}", row.test, row.row);
            cells.extend(VehicleId::ALL.map(place).into_iter().zip(&row.cells));
        }
        for row in &self.table3 {
            let degrees = row.turn / DEGREE;
            let place = |id| format!("Table 3, test {}, {degrees:+.0}°, vehicle {id}", row.test);
            cells.extend(VehicleId::ALL.map(place).into_iter().zip(&row.cells));
        }
        for row in &self.table3_rms {
            let degrees = row.turn / DEGREE;
            cells.push((format!("Table 3, rms, tests {:?}, {degrees:+.0}°", row.tests), &row.paper_rows));
        }
        for row in &self.energies {
            let place = |what| format!("SAE 871993, Table 1, test {}, {what}", row.test);
            cells.push((place("initial energy"), &row.initial));
            cells.push((place("normal loss"), &row.normal));
            cells.push((place("tangential loss"), &row.tangential));
            cells.push((place("total loss"), &row.total));
        }
        for figure in &self.appendix {
            cells.push((format!("appendix, {}", figure.quantity), &figure.cell));
        }
        for row in &self.reconstructions {
            cells.push((format!("reconstruction, test {}, round trip", row.test), &row.round_trip));
        }
        for row in &self.motions {
            let place = |what| format!("motion to rest, test {}, vehicle {}, {what}", row.test, row.vehicle);
            cells.push((place("distance"), &row.distance));
            cells.push((place("turn"), &row.turn));
        }
        for row in &self.returns {
            let place = |what| format!("back from rest, test {}, vehicle {}, {what}", row.test, row.vehicle);
            cells.push((place("round trip"), &row.round_trip));
            if let Some(found) = &row.from_rest {
                cells.push((place("speed"), &found.speed));
                cells.push((place("direction"), &found.direction));
                cells.push((place("yaw rate"), &found.yaw_rate));
            }
        }
        cells
    }

    /// The cells that are claimed to reproduce and do not, each with the name of its position.
    #[must_use]
    pub fn failures(&self) -> Vec<(String, &Cell)> {
        self.cells().into_iter().filter(|(_, cell)| cell.fails()).collect()
    }

    /// Number of cells that are claimed to reproduce.
    #[must_use]
    pub fn claimed(&self) -> usize {
        self.cells().iter().filter(|(_, cell)| cell.is_claimed()).count()
    }
}
