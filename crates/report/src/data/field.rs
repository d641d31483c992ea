//! The judgement by recorders as JSON, in SI units.

use std::collections::BTreeMap;

use case::SeverityPrior;
use field::ciss::{CissCrashes, CissTable};
use field::{Field, Figures, Judged, LEVELS};
use serde::Serialize;

use super::{ProgramBlock, THIS_PROGRAM, pretty, sha256};

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

/// What was judged, and by what: with these a result can be repeated.
#[derive(Serialize)]
pub(super) struct JudgedBlock<'a, T> {
    #[serde(flatten)]
    document: T,
    program: ProgramBlock,
    data: DataBlock<'a>,
}

#[derive(Serialize)]
struct DataBlock<'a> {
    /// The checksum of the table of crashes.
    sha256: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    years: Vec<YearBlock<'a>>,
}

#[derive(Serialize)]
struct YearBlock<'a> {
    source: &'a str,
    tables: Vec<TableBlock<'a>>,
    crashes: usize,
    left_out: BTreeMap<&'static str, usize>,
}

#[derive(Serialize)]
struct TableBlock<'a> {
    name: &'static str,
    file: &'a str,
    rows: usize,
    sha256: &'a str,
}

impl<'a, T> JudgedBlock<'a, T> {
    pub(super) fn of(data: &FieldData<'a>, document: T) -> Self {
        let years = data.years.iter().map(YearBlock::of).collect();
        let data = DataBlock { sha256: sha256(data.table.as_bytes()), years };
        Self { document, program: THIS_PROGRAM, data }
    }
}

impl<'a> YearBlock<'a> {
    fn of(FieldYear { source, crashes, sha256 }: &'a FieldYear) -> Self {
        let table = |(CissTable { name, file, rows }, sha256): (&'a CissTable, &'a String)| TableBlock {
            name,
            file,
            rows: *rows,
            sha256,
        };
        let why = |(reason, count): (&field::ciss::CissLeftOut, &usize)| {
            (reason.why(crashes.is_of_objects), *count)
        };
        Self {
            source,
            tables: crashes.tables.iter().zip(sha256).map(table).collect(),
            crashes: crashes.rows.len(),
            left_out: crashes.left_out.iter().map(why).collect(),
        }
    }
}

#[derive(Serialize)]
struct Document<'a> {
    other: bool,
    objects: bool,
    prior: &'static str,
    pairs: usize,
    finished: usize,
    groups: BTreeMap<&'a str, FiguresBlock>,
    winsmash: BTreeMap<&'a str, FiguresBlock>,
    left_out: Vec<LeftOutBlock<'a>>,
    judged: Vec<VehicleBlock<'a>>,
}

#[derive(Serialize)]
struct LeftOutBlock<'a> {
    case: &'a str,
    vehicle: usize,
}

#[derive(Serialize)]
pub(super) struct FiguresBlock {
    n: usize,
    collisions: usize,
    bias: f64,
    bias_error: f64,
    rms: f64,
    rms_error: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    coverage: Option<BTreeMap<String, f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    coverage_error: Option<BTreeMap<String, f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    width95: Option<f64>,
    crps: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pit: Option<[usize; 10]>,
}

#[derive(Serialize)]
struct VehicleBlock<'a> {
    case: &'a str,
    vehicle: usize,
    kind: &'static str,
    recorder: f64,
    longitudinal: bool,
    median: f64,
    interval50: [f64; 2],
    interval80: [f64; 2],
    interval95: [f64; 2],
    below: f64,
    crps: f64,
    converged: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    winsmash: Option<f64>,
}

impl FiguresBlock {
    pub(super) fn of(figures: &Figures) -> Self {
        let level = |level: f64| format!("{:.0}", 100.0 * level);
        let part = |place: usize| {
            let coverage = figures.coverage?;
            Some(LEVELS.iter().zip(coverage).map(|(&at, part)| (level(at), part[place])).collect())
        };
        Self {
            n: figures.n,
            collisions: figures.collisions,
            bias: figures.bias[0],
            bias_error: figures.bias[1],
            rms: figures.rms[0],
            rms_error: figures.rms[1],
            coverage: part(0),
            coverage_error: part(1),
            width95: figures.width95,
            crps: figures.crps,
            pit: figures.pit,
        }
    }
}

impl<'a> VehicleBlock<'a> {
    fn of(judged: &'a Judged) -> Self {
        let [interval50, interval80, interval95] = judged.intervals;
        Self {
            case: &judged.case,
            vehicle: judged.vehicle.index() + 1,
            kind: judged.kind.name(),
            recorder: judged.truth.delta_v,
            longitudinal: judged.truth.is_longitudinal,
            median: judged.median,
            interval50,
            interval80,
            interval95,
            below: judged.below,
            crps: judged.crps,
            converged: judged.converged,
            winsmash: judged.winsmash,
        }
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
    let document = Document {
        other: field.other,
        objects: field.objects,
        prior: prior(field.injured),
        pairs: field.pairs,
        finished: field.finished,
        groups: field.groups.iter().map(|group| (group.name, FiguresBlock::of(&group.ours))).collect(),
        winsmash: field
            .groups
            .iter()
            .filter_map(|group| Some((group.name, FiguresBlock::of(group.winsmash.as_ref()?))))
            .collect(),
        left_out: field
            .doubted
            .iter()
            .map(|(case, vehicle)| LeftOutBlock { case, vehicle: vehicle.index() + 1 })
            .collect(),
        judged: field.judged.iter().map(VehicleBlock::of).collect(),
    };
    pretty(&JudgedBlock::of(data, document))
}
