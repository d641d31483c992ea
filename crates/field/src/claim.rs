//! The ΔV that another program claims, judged by the same recorders.

use std::str::FromStr;

use pim_core::VehicleId;

use crate::crash::{Crash as _, PairKind};
use crate::error::FieldError;
use crate::judge::Figures;
use crate::pair::{Pair, Truth};
use crate::read::{Cells, MOST_SPEED, cells};

/// The columns of a program, without `_1` and `_2`: its ΔV, and the ends of its 95 % interval if it has one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClaimColumns {
    /// The column of ΔV.
    pub value: String,
    /// The columns of the lower and the upper end.
    pub ends: Option<[String; 2]>,
}

impl FromStr for ClaimColumns {
    type Err = FieldError;

    /// From `COLUMN` or `COLUMN,LOW,HIGH`.
    fn from_str(text: &str) -> Result<Self, FieldError> {
        let names: Vec<String> = text.split(',').map(|name| name.trim().to_owned()).collect();
        if names.iter().any(String::is_empty) {
            return Err(FieldError::ClaimColumns { text: text.to_owned() });
        }
        match <[String; 3]>::try_from(names) {
            Ok([value, low, high]) => Ok(Self { value, ends: Some([low, high]) }),
            Err(names) => match <[String; 1]>::try_from(names) {
                Ok([value]) => Ok(Self { value, ends: None }),
                Err(_) => Err(FieldError::ClaimColumns { text: text.to_owned() }),
            },
        }
    }
}

/// The claim of a program about a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgramClaim {
    /// (m/s) ΔV.
    pub delta_v: f64,
    /// (m/s) ends of its 95 % interval.
    pub interval: Option<[f64; 2]>,
}

/// A claim, and the value that the recorder stored.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedClaim {
    /// Number of the crash.
    pub case: String,
    /// The vehicle.
    pub vehicle: VehicleId,
    /// The surfaces that met.
    pub kind: PairKind,
    /// The value that its recorder stored.
    pub truth: Truth,
    /// The claim of the program.
    pub claim: ProgramClaim,
}

/// The figures of a group of claims.
#[derive(Clone, Debug, PartialEq)]
pub struct ClaimGroup {
    /// `all`, or the name of a kind.
    pub name: &'static str,
    /// The same figures as for values without intervals.
    pub figures: Figures,
    /// (–) share of the recorders inside the 95 % intervals, with its standard error.
    pub coverage95: Option<[f64; 2]>,
    /// (m/s) mean interval score of the 95 % intervals: their width, plus 40 times the distance to a recorded
    /// value outside (Gneiting & Raftery 2007, equation 43).
    pub interval_score: Option<f64>,
}

/// All claims of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Claims {
    /// The columns of the program.
    pub columns: ClaimColumns,
    /// Number of pairs of the file.
    pub pairs: usize,
    /// Number of vehicles that have a recorder but no claim of the program.
    pub unclaimed: usize,
    /// Each claim that is judged.
    pub judged: Vec<JudgedClaim>,
    /// All, and by kind of collision.
    pub groups: Vec<ClaimGroup>,
}

/// Judges the columns of another program (km/h) by the recorders of the same pairs as
/// [`judge`](crate::judge): if a recorder stored both parts, the claim is the size of ΔV; if it stored only
/// the longitudinal part, it is the size of that part. `text` is the table from which `pairs` were read.
///
/// # Errors
/// If a column is missing, a cell is not a plausible number, an interval does not contain its own value, or
/// no vehicle has both a claim and a recorder.
pub fn judge_claims(text: &str, pairs: &[Pair], columns: &ClaimColumns) -> Result<Claims, FieldError> {
    let mut judged = Vec::new();
    let mut unclaimed = 0;
    for (pair, cells) in pairs.iter().zip(cells(text)?) {
        for (vehicle, truth) in pair.truths() {
            let Some(claim) = cells.claim(columns, vehicle)? else {
                unclaimed += 1;
                continue;
            };
            let (case, kind) = (pair.case.clone(), pair.kind());
            judged.push(JudgedClaim { case, vehicle, kind, truth, claim });
        }
    }
    if judged.is_empty() {
        return Err(FieldError::NoClaims { column: columns.value.clone() });
    }
    let group = |name, of: &dyn Fn(&JudgedClaim) -> bool| {
        let all: Vec<&JudgedClaim> = judged.iter().filter(|judged| of(judged)).collect();
        ClaimGroup::of(name, &all)
    };
    let mut groups: Vec<ClaimGroup> = group("all", &|_| true).into_iter().collect();
    groups.extend(PairKind::ALL.iter().filter_map(|kind| group(kind.name(), &|judged| judged.kind == *kind)));
    Ok(Claims { columns: columns.clone(), pairs: pairs.len(), unclaimed, judged, groups })
}

impl Cells {
    /// The claim of a program about a vehicle; `None` if its cell is empty.
    fn claim(&self, columns: &ClaimColumns, vehicle: VehicleId) -> Result<Option<ProgramClaim>, FieldError> {
        let vehicle = Some(if vehicle == VehicleId::One { 1 } else { 2 });
        let kmh = |column: &str| {
            let number = self.at_most(MOST_SPEED, column, vehicle).map_err(|error| match error {
                FieldError::NoColumn { column } => FieldError::NoClaimColumn { column },
                error => error,
            })?;
            Ok::<_, FieldError>(number.map(|kmh| kmh.abs() / 3.6))
        };
        let Some(delta_v) = kmh(&columns.value)? else { return Ok(None) };
        if delta_v <= 0.0 {
            let wanted =
                "a ΔV that can be compared: it must not be 0; leave the cell empty where there is none";
            let text = self.text(&columns.value, vehicle)?;
            return Err(self.refusal(&columns.value, vehicle, text, wanted));
        }
        let Some([low, high]) = &columns.ends else {
            return Ok(Some(ProgramClaim { delta_v, interval: None }));
        };
        let missing = |column: &str| {
            self.refusal(column, vehicle, "", "an end of the interval of a ΔV that the line has")
        };
        let ends = [kmh(low)?.ok_or_else(|| missing(low))?, kmh(high)?.ok_or_else(|| missing(high))?];
        // Both ends of a longitudinal ΔV may be negative, the greater size first.
        let interval = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        if !(interval[0]..=interval[1]).contains(&delta_v) {
            let wanted = "an end of an interval that contains its own value";
            return Err(self.refusal(low, vehicle, self.text(low, vehicle)?, wanted));
        }
        Ok(Some(ProgramClaim { delta_v, interval: Some(interval) }))
    }
}

/// (–) 2/α of the interval score, at α = 5 %.
const MISS: f64 = 40.0;

impl ClaimGroup {
    fn of(name: &'static str, judged: &[&JudgedClaim]) -> Option<Self> {
        let rows = judged.iter();
        let rows = rows.map(|judged| (judged.case.as_str(), judged.claim.delta_v, judged.truth.delta_v));
        let figures = Figures::of_values(&rows.collect::<Vec<_>>())?;
        let scored = judged.iter().map(|judged| {
            let [low, high] = judged.claim.interval?;
            let truth = judged.truth.delta_v;
            let missed = (low - truth).max(truth - high).max(0.0);
            let is_inside = f64::from(u8::from(missed <= 0.0));
            Some((judged.case.as_str(), is_inside, high - low + MISS * missed))
        });
        let scored: Option<Vec<(&str, f64, f64)>> = scored.collect();
        let coverage95 = scored.as_ref().map(|scored| {
            let (cases, inside): (Vec<&str>, Vec<f64>) = scored.iter().map(|row| (row.0, row.1)).unzip();
            crate::judge::mean(&cases, &inside)
        });
        let interval_score = scored.map(|scored| {
            let (cases, scores): (Vec<&str>, Vec<f64>) = scored.iter().map(|row| (row.0, row.2)).unzip();
            crate::judge::mean(&cases, &scores)[0]
        });
        Some(Self { name, figures, coverage95, interval_score })
    }
}

#[cfg(test)]
mod tests;
