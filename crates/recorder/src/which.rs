//! Matches records with impacts, by direction, size and sequence.

use std::f64::consts::PI;

use real::elementary::{exp, ln, sin_cos};
use real::principal_angle;

use crate::assumption::{AssumptionOutOfRange, in_ranges};
use crate::pulse::force_direction;

/// The known data of an impact without the recorder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnownImpact {
    /// (rad) principal direction of force, clockwise from the front of the vehicle.
    pub force_direction: Option<f64>,
    /// (m/s) ΔV, from crush or momentum.
    pub delta_v: Option<f64>,
}

/// The data of a record that distinguish impacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventRecord {
    /// (rad) principal direction of force of its ΔV; `None` if it has only one axis.
    pub force_direction: Option<f64>,
    /// (m/s) its ΔV.
    pub delta_v: Option<f64>,
    /// Whether the record contains the whole impact. If not, ΔV is a lower bound.
    pub complete: bool,
}

/// (1) the smallest cosine of the angle between a direction and the axis of a recorder for which the ΔV along
/// that axis shows the whole ΔV: cos 60°.
const LEAST_COSINE: f64 = 0.5;

impl EventRecord {
    /// A record of these parts of ΔV (m/s), positive forward and to the right.
    ///
    /// If the recorder has only one axis, the other part is assumed to be that of the direction of this
    /// impact, or of its mirror image if the sign is opposite. If the direction is unknown, or more than 60°
    /// off the axis, the stored value is a lower bound.
    #[must_use]
    pub fn new(delta_v: [Option<f64>; 2], complete: bool, impact: &KnownImpact) -> Self {
        let one_axis = |part: f64, axis: f64| {
            let bound = Self { force_direction: None, delta_v: Some(part.abs()), complete: false };
            let Some(direction) = impact.force_direction else { return bound };
            let (_, cosine) = sin_cos(direction - axis);
            if cosine.abs() < LEAST_COSINE {
                return bound;
            }
            // ΔV = −|ΔV| cos(θ − θ_axis) along the axis; the mirror image of θ is 2 θ_axis + π − θ.
            let mirrored = principal_angle(2.0 * axis + PI - direction);
            Self {
                force_direction: Some(if part * cosine > 0.0 { mirrored } else { direction }),
                delta_v: Some(part.abs() / cosine.abs()),
                complete,
            }
        };
        match delta_v {
            [Some(along), Some(right)] => Self {
                force_direction: Some(force_direction([along, right])),
                delta_v: Some((along * along + right * right).sqrt()),
                complete,
            },
            [Some(along), None] => one_axis(along, 0.0),
            [None, Some(right)] => one_axis(right, 0.5 * PI),
            [None, None] => Self { complete, ..Self::default() },
        }
    }
}

/// How far records and impacts may differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchErrors {
    /// (rad) standard deviation of the difference of directions: 20°.
    pub direction: f64,
    /// (1) standard deviation of the difference of ln ΔV: 0.45. The recorder's part is small, and ΔV from
    /// crush has most of it.
    pub size: f64,
    /// (1) probability before all evidence that a record is of none of the impacts: 0.1.
    pub of_none: f64,
}

impl Default for MatchErrors {
    fn default() -> Self {
        Self { direction: 20_f64.to_radians(), size: 0.45, of_none: 0.1 }
    }
}

impl MatchErrors {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// The first that is not in its range.
    pub fn check(&self) -> Result<(), AssumptionOutOfRange> {
        in_ranges(&[
            ("direction", self.direction, [1e-3, PI]),
            ("size", self.size, [1e-3, 10.0]),
            ("of_none", self.of_none, [1e-6, 1.0]),
        ])
    }
}

/// Why a record cannot be of an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mismatch {
    /// The directions of force differ.
    Direction {
        /// (rad) the difference.
        difference: f64,
    },
    /// The record's ΔV differs from that of the impact by a factor.
    Size {
        /// (1) the ratio.
        ratio: f64,
    },
    /// Neither differs by much, but the other records and impacts, in their order, then fit much better.
    Others,
}

impl std::fmt::Display for Mismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Direction { difference } => {
                write!(f, "its force comes from a direction that differs by {:.0}°", difference.to_degrees())
            }
            Self::Size { ratio } if *ratio < 1.0 => {
                write!(f, "its ΔV is {:.0} % of the impact's", ratio * 100.0)
            }
            Self::Size { ratio } => write!(f, "its ΔV is {ratio:.1} times the impact's"),
            Self::Others => write!(f, "the other records and impacts, in their order, fit far better"),
        }
    }
}

/// The impacts to which a record may belong.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordMatch {
    /// (1) probability of each impact.
    pub impacts: Vec<f64>,
    /// (1) probability that it is of none of them.
    pub none: f64,
    /// For each impact, why the record cannot be of it: `Some` if its probability is below
    /// [`EXCLUDED`](Self::EXCLUDED), and only there.
    pub cannot: Vec<Option<Mismatch>>,
}

impl RecordMatch {
    /// (1) a record cannot be of an impact if the probability that it is lies below this: 1 %.
    pub const EXCLUDED: f64 = 0.01;
    /// (1) it is probably not of the impact if the probability lies below this: 20 %.
    pub const UNLIKELY: f64 = 0.2;
    /// (1) and it is of the impact if the probability lies above this: 95 %.
    pub const CERTAIN: f64 = 0.95;

    /// The meaning of a probability that a record is of an impact, in words that follow "this record".
    #[must_use]
    pub fn words(probability: f64) -> &'static str {
        match probability {
            p if p < Self::EXCLUDED => "cannot be of this impact",
            p if p < Self::UNLIKELY => "is probably not of this impact",
            p if p <= 1.0 - Self::UNLIKELY => "may be of this impact",
            p if p <= Self::CERTAIN => "is probably of this impact",
            _ => "is of this impact",
        }
    }
}

/// (1) a difference of this many standard deviations is a reason.
const NOTABLE: f64 = 2.0;
/// (1) share of directions that are wrong by any angle, due to mistakes in the coding.
const ANY_DIRECTION: f64 = 0.02;
/// (1) range of ln ΔV over which a record of none of the impacts lies: from 2 to 110 km/h.
const SIZES: f64 = 4.0;

/// The difference in standard deviations of direction and size, as far as both are known.
fn differences(record: &EventRecord, impact: &KnownImpact, errors: &MatchErrors) -> [Option<f64>; 2] {
    let direction = record
        .force_direction
        .zip(impact.force_direction)
        .map(|(own, other)| principal_angle(own - other).abs() / errors.direction);
    let size = record.delta_v.zip(impact.delta_v).filter(|(own, other)| *own > 0.0 && *other > 0.0).map(
        |(own, other)| {
            let difference = ln(own / other) / errors.size;
            // A lower bound may be smaller by any factor.
            if record.complete { difference } else { difference.max(0.0) }
        },
    );
    [direction, size]
}

/// The likelihood of a record if it is of this impact, relative to that if it is of none.
fn likelihood(record: &EventRecord, impact: &KnownImpact, errors: &MatchErrors) -> f64 {
    let [direction, size] = differences(record, impact, errors);
    let normal = |z: f64, sd: f64| exp(-0.5 * z * z) / (sd * (2.0 * PI).sqrt());
    let of_direction = direction.map_or(1.0, |z| {
        // p = (1 − ε) N(z)/σ + ε/2π, over 1/2π
        ((1.0 - ANY_DIRECTION) * normal(z, errors.direction) + ANY_DIRECTION / (2.0 * PI)) * 2.0 * PI
    });
    let of_size = size.map_or(1.0, |z| normal(z, errors.size) * SIZES);
    of_direction * of_size
}

/// The probability that each record is of each of the impacts.
///
/// Impacts and records are in the order of time. No two records belong to one impact, the later of two
/// records belongs to the later impact, and a record may belong to none. Every such assignment is weighed.
/// With errors that do not pass their [`check`](MatchErrors::check), the probabilities may be NaN.
#[must_use]
pub fn match_records(
    records: &[EventRecord],
    impacts: &[KnownImpact],
    errors: &MatchErrors,
) -> Vec<RecordMatch> {
    let (n, m) = (records.len(), impacts.len());
    let of_impact = (1.0 - errors.of_none) / crate::spread::count(m.max(1));
    let weight = |k: usize, j: usize| of_impact * likelihood(&records[k], &impacts[j], errors);
    // Sums over the assignments of the records before k to impacts before j, and of those from k to those
    // from j.
    let mut before = vec![vec![1.0; m + 1]; n + 1];
    for k in 0..n {
        for j in 0..=m {
            let matched: f64 = (0..j).map(|i| before[k][i] * weight(k, i)).sum();
            before[k + 1][j] = before[k][j] * errors.of_none + matched;
        }
    }
    let mut after = vec![vec![1.0; m + 1]; n + 1];
    for k in (0..n).rev() {
        for j in 0..=m {
            let matched: f64 = (j..m).map(|i| weight(k, i) * after[k + 1][i + 1]).sum();
            after[k][j] = errors.of_none * after[k + 1][j] + matched;
        }
    }
    let whole = before[n][m];
    let one = |k: usize| {
        let impacts_of: Vec<f64> = (0..m)
            .map(
                |j| if whole > 0.0 { before[k][j] * weight(k, j) * after[k + 1][j + 1] / whole } else { 0.0 },
            )
            .collect();
        let none = (1.0 - impacts_of.iter().sum::<f64>()).clamp(0.0, 1.0);
        let is_excluded = |j: &usize| impacts_of[*j] < RecordMatch::EXCLUDED;
        let reason = |j: usize| mismatch(&records[k], &impacts[j], errors);
        let cannot = (0..m).map(|j| Some(j).filter(is_excluded).map(reason)).collect();
        RecordMatch { impacts: impacts_of, none, cannot }
    };
    (0..n).map(one).collect()
}

/// Why this record cannot be of this impact: the larger of the differences.
fn mismatch(record: &EventRecord, impact: &KnownImpact, errors: &MatchErrors) -> Mismatch {
    let [direction, size] =
        differences(record, impact, errors).map(|z| z.filter(|z| z.abs() > NOTABLE).unwrap_or(0.0));
    if direction == 0.0 && size == 0.0 {
        Mismatch::Others
    } else if direction >= size.abs() {
        Mismatch::Direction { difference: direction * errors.direction }
    } else {
        Mismatch::Size { ratio: exp(size * errors.size) }
    }
}
