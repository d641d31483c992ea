//! The judgement of another program by recorders as JSON, in SI units.

use std::collections::BTreeMap;

use field::{ClaimGroup, Claims, JudgedClaim};
use serde_json::{Value, json};

use super::field::{FieldData, figures, of_data};
use super::{followed, list, pretty};

fn group(group: &ClaimGroup) -> Value {
    let coverage = json!({
        "coverage95": group.coverage95.map(|[share, _]| share),
        "coverage95_error": group.coverage95.map(|[_, error]| error),
        "interval_score": group.interval_score,
    });
    followed(figures(&group.figures), coverage)
}

fn judged(judged: &JudgedClaim) -> Value {
    json!({
        "case": judged.case,
        "vehicle": judged.vehicle.number(),
        "kind": judged.kind.name(),
        "recorder": judged.truth.delta_v,
        "longitudinal": judged.truth.is_longitudinal,
        "claimed": judged.claim.delta_v,
        "interval95": judged.claim.interval,
    })
}

/// The judgement as JSON: `groups`, all and by kind of collision, each with `n`, `bias`, `rms`, `crps` (m/s)
/// and, if the program has intervals, `coverage95` and `interval_score` (m/s); every vehicle; `program` and
/// `data`, with the SHA-256 of what was judged.
///
/// # Errors
/// If the JSON cannot be written.
pub fn claims_json(claims: &Claims, data: &FieldData<'_>) -> Result<String, serde_json::Error> {
    let groups = claims.groups.iter().map(|one| (one.name, group(one)));
    let document = json!({
        "column": claims.columns.value,
        "ends": claims.columns.ends,
        "pairs": claims.pairs,
        "unclaimed": claims.unclaimed,
        "groups": groups.collect::<BTreeMap<_, _>>(),
        "judged": list(&claims.judged, judged),
    });
    pretty(&of_data(data, document))
}
