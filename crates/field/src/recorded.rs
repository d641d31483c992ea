//! Pairs whose recorders both stored a speed before the impact, and their tables.

use pim_core::VehicleId;
use recorder::{ImpactSpeed, ImpactSpeedErrors, PreCrash, PreCrashSample};

use crate::error::FieldError;
use crate::pair::{Pair, PairVehicle};
use crate::read::{Cells, MOST_SPEED, cells};

/// A row of a table of crashes with recorders.
#[derive(Clone, Debug, PartialEq)]
pub struct RecorderRow {
    /// Number of the crash.
    pub case: String,
    /// The pair, or what is missing for it to be judged.
    pub pair: Result<RecordedPair, String>,
}

/// Two vehicles whose recorders both stored a speed before the impact.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedPair {
    /// The vehicles. The depths of a vehicle whose crush was not measured are 0.
    pub pair: Pair,
    /// Whether the crush of each vehicle was measured, which is true of at least one.
    pub is_measured: [bool; 2],
    /// The speeds before the impact.
    pub last: [LastSpeed; 2],
}

/// The last speed that a recorder stored before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastSpeed {
    /// (m/s) the speed.
    pub speed: f64,
    /// (m/s) mean and standard deviation of the speed at impact less this one, with the usual errors of a
    /// recorder.
    pub to_impact: [f64; 2],
}

impl LastSpeed {
    /// From the last stored `speed` (m/s), the time `gap` (s) from it to the impact, whether the vehicle
    /// `braked`, and a speed (m/s) `before`, with the time (s) from it to the impact; `None` if these make no
    /// record.
    #[must_use]
    pub fn of(speed: f64, gap: f64, braked: Option<bool>, before: Option<(f64, f64)>) -> Option<Self> {
        let sample = |time: f64, speed: f64, brake| PreCrashSample {
            time,
            speed: Some(speed),
            brake,
            ..PreCrashSample::default()
        };
        let before = before.map(|(time, speed)| sample(-time, speed, None));
        let samples = before.into_iter().chain([sample(-gap, speed, braked)]);
        let record = PreCrash::new(samples.collect()).ok()?;
        let found = ImpactSpeed::of(&record, &ImpactSpeedErrors::default()).ok()?;
        Some(Self { speed, to_impact: [found.mean - found.stored, found.sd] })
    }
}

/// (s) longest time from the last sample to the impact: recorders store five seconds, a few of them twenty.
const MOST_GAP: f64 = 20.0;

/// Reads a table of crashes with recorders, one per line, with the columns of CIREN. A row without the data
/// for a judgement states what is missing.
///
/// # Errors
/// If the file is not a table of this form, with the line and the column.
pub fn read_recorders(text: &str) -> Result<Vec<RecorderRow>, FieldError> {
    let rows = cells(text)?.into_iter().map(|cells| {
        let case = cells.case()?.to_owned();
        let pair = cells.recorded(&case)?;
        Ok(RecorderRow { case, pair })
    });
    let rows = rows.collect::<Result<Vec<_>, FieldError>>().map_err(|error| match error {
        FieldError::NoColumn { column } => FieldError::NoRecorderColumn { column },
        error => error,
    })?;
    if rows.is_empty() { Err(FieldError::NoPairs) } else { Ok(rows) }
}

/// One vehicle of a row, as far as it can be judged.
struct Found {
    vehicle: PairVehicle,
    is_measured: bool,
    last: LastSpeed,
}

impl Cells {
    fn recorded(&self, case: &str) -> Result<Result<RecordedPair, String>, FieldError> {
        let (one, two) = match (self.found(VehicleId::One)?, self.found(VehicleId::Two)?) {
            (Ok(one), Ok(two)) => (one, two),
            (Err(reason), _) | (_, Err(reason)) => return Ok(Err(reason)),
        };
        if !one.is_measured && !two.is_measured {
            return Ok(Err("the crush of neither vehicle was measured".to_owned()));
        }
        Ok(Ok(RecordedPair {
            pair: Pair { case: case.to_owned(), vehicles: [one.vehicle, two.vehicle] },
            is_measured: [one.is_measured, two.is_measured],
            last: [one.last, two.last],
        }))
    }

    fn found(&self, id: VehicleId) -> Result<Result<Found, String>, FieldError> {
        let number = if id == VehicleId::One { 1 } else { 2 };
        let vehicle = Some(number);
        let speed = self.at_most(MOST_SPEED, "V_T0_KMH", vehicle)?;
        let Some(speed) = speed.filter(|speed| *speed >= 0.0) else {
            return Ok(Err(format!("the recorder of vehicle {number} stored no speed before the impact")));
        };
        for (column, what) in
            [("CURBWT", "mass"), ("CDCPLANE", "damaged plane"), ("PDOF", "PDOF"), ("HEADINGANG", "heading")]
        {
            if self.text(column, vehicle)?.is_empty() {
                return Ok(Err(format!("the {what} of vehicle {number} is missing ({column}_{number})")));
            }
        }
        let plane = self.text("CDCPLANE", vehicle)?;
        if !["F", "B", "L", "R"].contains(&plane) {
            return Ok(Err(format!(
                "the damage of vehicle {number} is to plane {plane}, not to F, B, L or R"
            )));
        }
        let mut are_measured = true;
        for column in ["C1", "C2", "C3", "C4", "C5", "C6"] {
            are_measured &= !self.text(column, vehicle)?.is_empty();
        }
        let depths = if are_measured { self.depths(vehicle)? } else { [0.0; 6] };
        let vehicle_found = self.vehicle_with(vehicle, true, || Ok(depths))?;
        if vehicle_found.heading.is_none() {
            return Ok(Err(format!("the heading of vehicle {number} is missing (HEADINGANG_{number})")));
        }
        let lengths = [vehicle_found.field_length, vehicle_found.direct_length];
        let has_width =
            vehicle_found.plane.is_side() || lengths.into_iter().flatten().any(|length| length > 0.0);
        let gap = self.at_most(MOST_GAP, "V_T0_AT_S", vehicle)?.map_or(0.0, f64::abs);
        let brake = self.at_most(MOST_SPEED, "BRAKE_T0", vehicle)?;
        let before = self.at_most(MOST_SPEED, "V_1S_KMH", vehicle)?.filter(|speed| *speed >= 0.0);
        let before = before.filter(|_| gap < 1.0).map(|speed| (1.0, speed / 3.6));
        let braked = brake.map(|brake| brake > 0.0);
        let Some(last) = LastSpeed::of(speed / 3.6, gap, braked, before) else {
            return Ok(Err(format!(
                "the last samples of the recorder of vehicle {number} do not form a record"
            )));
        };
        Ok(Ok(Found {
            is_measured: has_width && depths.iter().any(|depth| *depth > 0.0),
            vehicle: vehicle_found,
            last,
        }))
    }
}
