//! The judgement by recorders as JSON, in SI units.

use std::collections::BTreeMap;

use case::SeverityPrior;
use field::ciss::{CissCrashes, CissLeftOut, CissTable};
use field::{Field, Figures, Judged, LEVELS};
use serde_json::{Value, json};

use super::{followed, list, object, pretty, program, sha256};

/// The crashes that are judged.
#[derive(Clone, Copy, Debug)]
pub struct FieldData<'a> {
    /// Their name in a report.
    pub name: &'a str,
    /// The table of crashes that is judged, as comma-separated values.
    pub table: &'a str,
    /// The tables of NHTSA from which it was made, if it was.
    pub years: &'a [FieldYear],
}

/// The crashes of a year from NHTSA's tables.
#[derive(Clone, Debug)]
pub struct FieldYear {
    /// The source of the tables: a folder or a ZIP file.
    pub source: String,
    /// The crashes.
    pub crashes: CissCrashes,
    /// The SHA-256 of each table's file, in hexadecimal digits.
    pub sha256: Vec<String>,
}

/// The judgement with the program and what was judged: with these a result can be repeated.
pub(super) fn of_data(data: &FieldData<'_>, judgement: Value) -> Value {
    let years = list(data.years, year);
    // The checksum is that of the table of crashes.
    let data = object! { "sha256": sha256(data.table.as_bytes()), "years"?: years };
    followed(judgement, json!({ "program": program(), "data": data }))
}

fn year(FieldYear { source, crashes, sha256 }: &FieldYear) -> Value {
    let tables = crashes.tables.iter().zip(sha256);
    let why = |(reason, count): (&CissLeftOut, &usize)| (reason.why(crashes.is_of_objects), *count);
    json!({
        "source": source,
        "tables": list(tables, |(CissTable { name, file, rows }, sha256)| json!({
            "name": name,
            "file": file,
            "rows": rows,
            "sha256": sha256,
        })),
        "crashes": crashes.rows.len(),
        "left_out": crashes.left_out.iter().map(why).collect::<BTreeMap<_, _>>(),
    })
}

pub(super) fn figures(figures: &Figures) -> Value {
    let part = |place: usize| Some(coverage(figures.coverage?.map(|part| part[place])));
    object! {
        figures.{n, collisions},
        "bias": figures.bias[0],
        "bias_error": figures.bias[1],
        "rms": figures.rms[0],
        "rms_error": figures.rms[1],
        "coverage"?: part(0),
        "coverage_error"?: part(1),
        "width95"?: figures.width95,
        "crps": figures.crps,
        "pit"?: figures.pit,
    }
}

/// A number for the intervals of each level, by the level in per cent.
pub(super) fn coverage<T>(of_levels: [T; LEVELS.len()]) -> BTreeMap<String, T> {
    LEVELS.iter().map(|level| format!("{:.0}", 100.0 * level)).zip(of_levels).collect()
}

fn vehicle(judged: &Judged) -> Value {
    let [interval50, interval80, interval95] = judged.intervals;
    object! {
        "case": judged.case,
        "vehicle": judged.vehicle.number(),
        "kind": judged.kind.name(),
        "recorder": judged.truth.delta_v,
        "longitudinal": judged.truth.is_longitudinal,
        "median": judged.median,
        "interval50": interval50,
        "interval80": interval80,
        "interval95": interval95,
        judged.{below, crps, converged},
        "winsmash"?: judged.winsmash,
    }
}

/// The word for the prior of the severity.
pub(super) fn prior(injured: bool) -> &'static str {
    if injured { SeverityPrior::SeriousInjury } else { SeverityPrior::Field }.name()
}

/// The judgement as JSON: `groups` and `winsmash`, all, by kind of collision and of one event, each with `n`,
/// `bias`, `rms`, `coverage`, `width95` and `crps` (m/s), the records that are left out, and every vehicle;
/// `program` and `data`, with the SHA-256 of what was judged.
///
/// # Errors
/// If the JSON cannot be written.
pub fn field_json(field: &Field, data: &FieldData<'_>) -> Result<String, serde_json::Error> {
    let ours = field.groups.iter().map(|group| (group.name, figures(&group.ours)));
    let winsmash =
        field.groups.iter().filter_map(|group| Some((group.name, figures(group.winsmash.as_ref()?))));
    let document = json!({
        "other": field.other,
        "objects": field.objects,
        "prior": prior(field.injured),
        "pairs": field.pairs,
        "finished": field.finished,
        "groups": ours.collect::<BTreeMap<_, _>>(),
        "winsmash": winsmash.collect::<BTreeMap<_, _>>(),
        "left_out": list(&field.doubted, |(case, id)| json!({ "case": case, "vehicle": id.number() })),
        "judged": list(&field.judged, vehicle),
    });
    pretty(&of_data(data, document))
}
