//! The judgement of another program by recorders as JSON, in SI units.

use std::collections::BTreeMap;

use field::{ClaimGroup, Claims, JudgedClaim};
use serde::Serialize;

use super::field::{FieldData, FiguresBlock, JudgedBlock};
use super::pretty;

#[derive(Serialize)]
struct Document<'a> {
    column: &'a str,
    ends: Option<&'a [String; 2]>,
    pairs: usize,
    unclaimed: usize,
    groups: BTreeMap<&'a str, GroupBlock>,
    judged: Vec<ClaimBlock<'a>>,
}

#[derive(Serialize)]
struct GroupBlock {
    #[serde(flatten)]
    figures: FiguresBlock,
    coverage95: Option<f64>,
    coverage95_error: Option<f64>,
    interval_score: Option<f64>,
}

#[derive(Serialize)]
struct ClaimBlock<'a> {
    case: &'a str,
    vehicle: usize,
    kind: &'static str,
    recorder: f64,
    longitudinal: bool,
    claimed: f64,
    interval95: Option<[f64; 2]>,
}

impl GroupBlock {
    fn of(group: &ClaimGroup) -> Self {
        Self {
            figures: FiguresBlock::of(&group.figures),
            coverage95: group.coverage95.map(|[share, _]| share),
            coverage95_error: group.coverage95.map(|[_, error]| error),
            interval_score: group.interval_score,
        }
    }
}

impl<'a> ClaimBlock<'a> {
    fn of(judged: &'a JudgedClaim) -> Self {
        Self {
            case: &judged.case,
            vehicle: judged.vehicle.index() + 1,
            kind: judged.kind.name(),
            recorder: judged.truth.delta_v,
            longitudinal: judged.truth.is_longitudinal,
            claimed: judged.claim.delta_v,
            interval95: judged.claim.interval,
        }
    }
}

/// The judgement as JSON: `groups`, all and by kind of collision, each with `n`, `bias`, `rms`, `crps` (m/s)
/// and, if the program has intervals, `coverage95` and `interval_score` (m/s); every vehicle; `program` and
/// `data`, with the SHA-256 of what was judged.
///
/// # Errors
/// If the JSON cannot be written.
pub fn claims_json(claims: &Claims, data: &FieldData<'_>) -> Result<String, serde_json::Error> {
    let document = Document {
        column: &claims.columns.value,
        ends: claims.columns.ends.as_ref(),
        pairs: claims.pairs,
        unclaimed: claims.unclaimed,
        groups: claims.groups.iter().map(|group| (group.name, GroupBlock::of(group))).collect(),
        judged: claims.judged.iter().map(ClaimBlock::of).collect(),
    };
    pretty(&JudgedBlock::of(data, document))
}
