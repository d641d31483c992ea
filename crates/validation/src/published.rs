//! The printed numbers of the papers, read from `fixtures/ricsac/published.toml`, and their units.

use pim_core::VehicleId;
use serde::Deserialize;

use crate::Data;
use crate::claim::{Cell, Claim, Erratum};
use crate::error::ValidationError;

/// (m/s) one foot per second.
pub const FOOT_PER_SECOND: f64 = 0.3048;
/// (J) one foot-pound: 0.3048 m times the standard weight of 0.453 592 37 kg.
pub const FOOT_POUND: f64 = 0.3048 * 4.448_221_615_260_5;
/// (rad) one degree.
pub const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// All numbers, in the printed units.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Published {
    pub(crate) table1: Vec<Geometry>,
    pub(crate) table3: Vec<Deviations>,
    pub(crate) collision: Vec<Collision>,
    pub(crate) appendix: Vec<Figure>,
}

/// A row of the paper's Table 1 (ft/s).
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Geometry {
    pub(crate) geometry: String,
    pub(crate) tests: Vec<u8>,
    pub(crate) pim: f64,
    pub(crate) crash3: f64,
}

/// The last column of one half of the paper's Table 3 (degrees, ft/s).
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Deviations {
    pub(crate) tests: Vec<u8>,
    pub(crate) turns: Vec<f64>,
    pub(crate) rms: Vec<f64>,
}

/// The printed numbers of one collision.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Collision {
    pub(crate) test: u8,
    pub(crate) table2: Table2,
    pub(crate) energy: Energy,
    pub(crate) table3: Option<Table3>,
}

/// The paper's Table 2 (ft/s), of vehicle 1 and vehicle 2.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table2 {
    pub(crate) pim_crush: [f64; 2],
    pub(crate) pim_total: [f64; 2],
    pub(crate) crash_uncorrected: [f64; 2],
    pub(crate) crash_corrected: [f64; 2],
    pub(crate) measured: [f64; 2],
}

/// SAE 871993, Table 1 (ft·lb).
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Energy {
    pub(crate) initial: f64,
    pub(crate) normal: f64,
    pub(crate) tangential: f64,
    pub(crate) total: f64,
}

/// The paper's Table 3 (degrees, ft/s) and the energies (ft·lb) that were solved from it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table3 {
    pub(crate) implied_energies: [f64; 2],
    pub(crate) rows: Vec<Turned>,
    #[serde(default)]
    pub(crate) errata: Vec<TurnedErratum>,
}

/// A row of Table 3.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Turned {
    pub(crate) turn: f64,
    pub(crate) delta_v: [f64; 2],
}

/// A misprint in a row of Table 3.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TurnedErratum {
    pub(crate) turn: f64,
    pub(crate) vehicles: Vec<u8>,
    pub(crate) printed: String,
    pub(crate) reason: String,
}

impl Table3 {
    /// The misprint that was corrected in the row of this turn (degrees) for this vehicle.
    pub(crate) fn erratum(&self, turn: f64, vehicle: VehicleId) -> Option<Erratum> {
        self.errata
            .iter()
            .find(|erratum| erratum.turn == turn && erratum.vehicles.contains(&vehicle.number()))
            .map(|erratum| Erratum { printed: erratum.printed.clone(), reason: erratum.reason.clone() })
    }
}

/// A figure of the paper's appendix.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Figure {
    /// The key of our corresponding result.
    pub(crate) key: String,
    pub(crate) quantity: String,
    pub(crate) unit: PrintedUnit,
    value: f64,
    tolerance: Option<f64>,
    printed: Option<String>,
    reason: Option<String>,
    known: Option<String>,
}

impl Figure {
    /// The cell with our value (SI).
    ///
    /// A figure has either a tolerance or a known difference, and a reason if it is misprinted.
    pub(crate) fn cell(&self, ours: f64) -> Result<Cell, ValidationError> {
        let size = self.unit.size();
        let claim = match (self.tolerance, &self.known) {
            (Some(tolerance), None) => Claim::Reproduces { tolerance: tolerance * size },
            (None, Some(reason)) => Claim::KnownDifference { reason: reason.clone() },
            _ => return Err(ValidationError::Figure { quantity: self.quantity.clone() }),
        };
        let erratum = match (&self.printed, &self.reason) {
            (Some(printed), Some(reason)) => {
                Some(Erratum { printed: printed.clone(), reason: reason.clone() })
            }
            (None, None) => None,
            _ => return Err(ValidationError::Figure { quantity: self.quantity.clone() }),
        };
        Ok(Cell { ours, paper: self.value * size, erratum, claim })
    }
}

/// A unit that the appendix prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum PrintedUnit {
    /// J, printed as N-m.
    #[serde(rename = "J")]
    Joule,
    /// m/s.
    #[serde(rename = "m/s")]
    MetrePerSecond,
    /// ft/s.
    #[serde(rename = "ft/s")]
    FootPerSecond,
    /// N·s.
    #[serde(rename = "N·s")]
    NewtonSecond,
    /// rad/s.
    #[serde(rename = "rad/s")]
    RadianPerSecond,
    /// %.
    #[serde(rename = "%")]
    Percent,
    /// None: a ratio.
    #[serde(rename = "")]
    One,
}

impl PrintedUnit {
    /// Its size in SI units.
    #[must_use]
    pub fn size(self) -> f64 {
        match self {
            Self::FootPerSecond => FOOT_PER_SECOND,
            Self::Percent => 0.01,
            Self::Joule | Self::MetrePerSecond | Self::NewtonSecond | Self::RadianPerSecond | Self::One => {
                1.0
            }
        }
    }

    /// Its symbol.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Joule => "J",
            Self::MetrePerSecond => "m/s",
            Self::FootPerSecond => "ft/s",
            Self::NewtonSecond => "N·s",
            Self::RadianPerSecond => "rad/s",
            Self::Percent => "%",
            Self::One => "",
        }
    }
}

impl Published {
    pub(crate) fn read(data: &Data) -> Result<Self, ValidationError> {
        toml::from_str(data.published).map_err(|error| ValidationError::Published(Box::new(error)))
    }
}

/// (m/s) a pair of printed velocities (ft/s).
pub(crate) fn speeds(printed: [f64; 2]) -> [f64; 2] {
    printed.map(|value| value * FOOT_PER_SECOND)
}
