//! Matches records with impacts, by direction, size and sequence.

use std::f64::consts::PI;

use real::elementary::{exp, ln, sin_cos};
use real::principal_angle;

use uncertainty::normal::cumulative;

use crate::assumption::{AssumptionOutOfRange, in_ranges};
use crate::pre_crash::REGULAR_STEP;
use crate::pulse::force_direction;

/// The known data of an impact without the recorder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnownImpact {
    /// (rad) principal direction of force, clockwise from the front of the vehicle.
    pub force_direction: Option<f64>,
    /// (m/s) ΔV, from crush or momentum.
    pub delta_v: Option<f64>,
}

/// (m/s) ΔV of a recorder with one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OneAxis {
    /// Along the vehicle, positive forward.
    Longitudinal(f64),
    /// Across it, positive to the right.
    Lateral(f64),
}

impl OneAxis {
    /// (m/s) ΔV along the axis, and (rad) the direction of the axis, clockwise from the front.
    fn part(self) -> (f64, f64) {
        match self {
            Self::Longitudinal(part) => (part, 0.0),
            Self::Lateral(part) => (part, 0.5 * PI),
        }
    }
}

/// The data of a record that distinguish impacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventRecord {
    /// (rad) principal direction of force of its ΔV; `None` if it has only one axis, or if ΔV is so small
    /// that its rounding leaves no direction.
    pub force_direction: Option<f64>,
    /// (m/s) its ΔV; of a recorder with one axis that along the axis.
    pub delta_v: Option<f64>,
    /// Its ΔV with a sign, if it has only one axis.
    pub one_axis: Option<OneAxis>,
    /// Whether the record contains the whole impact. If not, ΔV is a lower bound.
    pub complete: bool,
}

/// (m/s) half of the step in which ΔV is stored. A smaller part is stored as 0, and has no sign.
const HALF_STEP: f64 = 0.5 * REGULAR_STEP;

impl EventRecord {
    /// A record of these parts of ΔV (m/s), positive forward and to the right.
    #[must_use]
    pub fn new(delta_v: [Option<f64>; 2], complete: bool) -> Self {
        let one_axis = |axis: OneAxis| Self {
            delta_v: Some(axis.part().0.abs()),
            one_axis: Some(axis),
            complete,
            ..Self::default()
        };
        match delta_v {
            [Some(along), Some(right)] => {
                let size = (along * along + right * right).sqrt();
                Self {
                    force_direction: (size > HALF_STEP).then(|| force_direction([along, right])),
                    delta_v: Some(size),
                    complete,
                    ..Self::default()
                }
            }
            [Some(along), None] => one_axis(OneAxis::Longitudinal(along)),
            [None, Some(right)] => one_axis(OneAxis::Lateral(right)),
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
/// (1) range of ln ΔV over which a record of none of the impacts lies, any as likely: from 2 to 110 km/h.
const SIZES: f64 = 4.0;
/// (m/s) the least ΔV of a complete record of none of the impacts: 2 km/h.
const LEAST_OF_NONE: f64 = 2.0 / 3.6;

/// (m/s) at least half the step in which ΔV is stored: what is smaller looks the same.
fn stored(delta_v: f64) -> f64 {
    delta_v.abs().max(HALF_STEP)
}

/// The density of a normal number with mean 0.
fn normal(value: f64, sd: f64) -> f64 {
    let z = value / sd;
    exp(-0.5 * z * z) / (sd * (2.0 * PI).sqrt())
}

/// (rad) standard deviation of the difference of directions: that of [`MatchErrors`], and that which the
/// rounding of both parts of ΔV (m/s) gives its direction.
fn direction_sd(delta_v: Option<f64>, errors: &MatchErrors) -> f64 {
    // A part rounded by a step w has the variance w²/12.
    let rounding = delta_v.map_or(0.0, |size| REGULAR_STEP / 12_f64.sqrt() / stored(size));
    (errors.direction * errors.direction + rounding * rounding).sqrt()
}

/// The density of ln ΔV (m/s) in a record of an impact with this one.
fn density_of_size(own: f64, other: f64, complete: bool, errors: &MatchErrors) -> f64 {
    let (y, sd) = (ln(stored(own) / stored(other)), errors.size);
    if complete {
        return normal(y, sd);
    }
    // The record holds a share s of ΔV, and any s from 0 to 1 is as likely. With m = −ln s of density e⁻ᵐ,
    // p(y) = ∫ e⁻ᵐ N(y + m) dm = exp(y + σ²/2) Φ(−(y + σ²)/σ)
    exp(y + 0.5 * sd * sd) * cumulative(-(y + sd * sd) / sd)
}

/// The density of ln ΔV (m/s) in a record of none of the impacts that is not complete.
fn density_of_piece(own: f64) -> f64 {
    // Below the least ΔV of a complete one, only shares of it are left: e⁻ᵐ with m = ln(least/own).
    (stored(own) / LEAST_OF_NONE).min(1.0) / SIZES
}

/// The likelihood of a direction that differs by this angle (rad), relative to a record of none.
fn likelihood_of_direction(difference: f64, sd: f64) -> f64 {
    // p = (1 − ε) N(z)/σ + ε/2π, over 1/2π
    (1.0 - ANY_DIRECTION) * normal(difference, sd) * 2.0 * PI + ANY_DIRECTION
}

/// How many directions stand for a whole turn.
const DIRECTIONS: u32 = 720;
/// How many standard deviations on either side of a direction count.
const WIDTH: i32 = 4;
/// How many directions stand for a standard deviation.
const PER_SD: i32 = 40;

/// The likelihood of a record of one axis if it is of this impact, relative to that if it is of none: the
/// impact has its direction up to the error of that, and the axis shows the part of ΔV along it.
fn likelihood_of_axis(axis: OneAxis, complete: bool, impact: &KnownImpact, errors: &MatchErrors) -> f64 {
    let (part, axis) = axis.part();
    // The cosine of the angle to the axis, if the sign of ΔV agrees: ΔV = −|ΔV| cos(θ − θ_axis) along the
    // axis.
    let seen = |direction: f64| {
        let (_, cosine) = sin_cos(direction - axis);
        (part.abs() < HALF_STEP || part * cosine < 0.0).then_some(cosine)
    };
    let of = |direction: f64| {
        let density = |cosine: f64| {
            impact.delta_v.map_or(1.0, |whole| density_of_size(part, whole * cosine, complete, errors))
        };
        seen(direction).map_or(0.0, density)
    };
    let turn = f64::from(DIRECTIONS);
    let over_all = |of: &dyn Fn(f64) -> f64| {
        (0..DIRECTIONS).map(|k| of(2.0 * PI * (f64::from(k) + 0.5) / turn)).sum::<f64>() / turn
    };
    // A record of none has its force from anywhere.
    let of_none = over_all(&|direction| {
        let density = |cosine: f64| {
            let whole = stored(part) / cosine.abs();
            match impact.delta_v {
                None => 1.0,
                Some(_) if complete => f64::from(u8::from(whole > LEAST_OF_NONE)) / SIZES,
                Some(_) => density_of_piece(whole),
            }
        };
        seen(direction).map_or(0.0, density)
    });
    let anywhere = over_all(&of);
    let Some(direction) = impact.force_direction else { return anywhere / of_none };
    let (mut sum, mut weights) = (0.0, 0.0);
    for k in -WIDTH * PER_SD..=WIDTH * PER_SD {
        let z = f64::from(k) / f64::from(PER_SD);
        let weight = normal(z, 1.0);
        sum += weight * of(direction + z * errors.direction);
        weights += weight;
    }
    ((1.0 - ANY_DIRECTION) * sum / weights + ANY_DIRECTION * anywhere) / of_none
}

/// The likelihood of a record if it is of this impact, relative to that if it is of none.
fn likelihood(record: &EventRecord, impact: &KnownImpact, errors: &MatchErrors) -> f64 {
    if let Some(axis) = record.one_axis {
        return likelihood_of_axis(axis, record.complete, impact, errors);
    }
    let sd = direction_sd(record.delta_v, errors);
    let of_direction = record.force_direction.zip(impact.force_direction);
    let of_direction =
        of_direction.map_or(1.0, |(own, other)| likelihood_of_direction(principal_angle(own - other), sd));
    let of_size = record.delta_v.zip(impact.delta_v).map_or(1.0, |(own, other)| {
        let of_none = if record.complete { SIZES.recip() } else { density_of_piece(own) };
        density_of_size(own, other, record.complete, errors) / of_none
    });
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
    let of_record = |record: &EventRecord| -> Vec<f64> {
        impacts.iter().map(|impact| of_impact * likelihood(record, impact, errors)).collect()
    };
    let weights: Vec<Vec<f64>> = records.iter().map(of_record).collect();
    // Sums over the assignments of the records before k to impacts before j, and of those from k to those
    // from j.
    let mut before = vec![vec![1.0; m + 1]; n + 1];
    for k in 0..n {
        for j in 0..=m {
            let matched: f64 = (0..j).map(|i| before[k][i] * weights[k][i]).sum();
            before[k + 1][j] = before[k][j] * errors.of_none + matched;
        }
    }
    let mut after = vec![vec![1.0; m + 1]; n + 1];
    for k in (0..n).rev() {
        for j in 0..=m {
            let matched: f64 = (j..m).map(|i| weights[k][i] * after[k + 1][i + 1]).sum();
            after[k][j] = errors.of_none * after[k + 1][j] + matched;
        }
    }
    let whole = before[n][m];
    let one = |k: usize| {
        let impacts_of: Vec<f64> =
            (0..m)
                .map(|j| {
                    if whole > 0.0 { before[k][j] * weights[k][j] * after[k + 1][j + 1] / whole } else { 0.0 }
                })
                .collect();
        let none = (1.0 - impacts_of.iter().sum::<f64>()).clamp(0.0, 1.0);
        let is_excluded = |j: &usize| impacts_of[*j] < RecordMatch::EXCLUDED;
        let reason = |j: usize| mismatch(&records[k], &impacts[j], errors);
        let cannot = (0..m).map(|j| Some(j).filter(is_excluded).map(reason)).collect();
        RecordMatch { impacts: impacts_of, none, cannot }
    };
    (0..n).map(one).collect()
}

/// (1) the smallest cosine of the angle between a direction and the axis of a recorder for which the ΔV along
/// that axis shows the whole ΔV: cos 60°.
const LEAST_COSINE: f64 = 0.5;

/// A record of one axis as it would be with both if its force came from the direction of this impact, or from
/// its mirror image if the sign is opposite. Far off the axis, it has no direction and is a lower bound.
fn in_direction(record: &EventRecord, impact: &KnownImpact) -> EventRecord {
    let Some((part, axis)) = record.one_axis.map(OneAxis::part) else { return *record };
    let bound = EventRecord { complete: false, ..*record };
    let Some(direction) = impact.force_direction else { return bound };
    let (_, cosine) = sin_cos(direction - axis);
    if cosine.abs() < LEAST_COSINE {
        return bound;
    }
    // The mirror image of θ is 2 θ_axis + π − θ.
    let mirrored = principal_angle(2.0 * axis + PI - direction);
    EventRecord {
        force_direction: Some(if part * cosine > 0.0 { mirrored } else { direction }),
        delta_v: Some(part.abs() / cosine.abs()),
        ..*record
    }
}

/// Why this record cannot be of this impact: the larger of the differences, in standard deviations.
fn mismatch(record: &EventRecord, impact: &KnownImpact, errors: &MatchErrors) -> Mismatch {
    let record = in_direction(record, impact);
    let sd = direction_sd(record.delta_v, errors);
    let turned = record.force_direction.zip(impact.force_direction);
    let turned = turned.map_or(0.0, |(own, other)| principal_angle(own - other).abs());
    let ratio = record.delta_v.zip(impact.delta_v).map_or(1.0, |(own, other)| stored(own) / stored(other));
    // A lower bound may be smaller by any factor.
    let ratio = if record.complete { ratio } else { ratio.max(1.0) };
    let notable = |z: f64| if z > NOTABLE { z } else { 0.0 };
    let (direction, size) = (notable(turned / sd), notable(ln(ratio).abs() / errors.size));
    if direction == 0.0 && size == 0.0 {
        Mismatch::Others
    } else if direction >= size {
        Mismatch::Direction { difference: turned }
    } else {
        Mismatch::Size { ratio }
    }
}
