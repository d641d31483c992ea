//! The comparison as JSON, in SI units and radians.

use serde::Serialize;
use validation::{Cell, Claim, ErrorRate, Method, Row, TurnedPdof, Validation};

use super::pretty;

#[derive(Serialize)]
struct Document {
    claimed: usize,
    failed: Vec<FailureBlock>,
    table1: Vec<Table1Block>,
    table2: Vec<Table2Block>,
    table3: Vec<Table3Block>,
    table3_rms: Vec<Table3RmsBlock>,
    energies: Vec<EnergyBlock>,
    appendix: Vec<FigureBlock>,
    reconstruction: Vec<ReconstructionBlock>,
    choices: Vec<ChoicesBlock>,
    error_rate: ErrorRates,
}

#[derive(Serialize)]
struct FailureBlock {
    place: String,
    ours: f64,
    paper: f64,
}

#[derive(Serialize)]
struct Table1Block {
    geometry: String,
    tests: Vec<u8>,
    method: &'static str,
    ours: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    ours_implied: Option<f64>,
    paper_rows: f64,
    paper: f64,
    claim: ClaimBlock,
}

#[derive(Serialize)]
struct Table2Block {
    test: u8,
    row: &'static str,
    ours: [f64; 2],
    paper: [f64; 2],
    difference: [f64; 2],
    measured: [f64; 2],
    claims: [ClaimBlock; 2],
}

#[derive(Serialize)]
struct Table3Block {
    test: u8,
    turn: f64,
    ours: [f64; 2],
    paper: [f64; 2],
    difference: [f64; 2],
    claims: [ClaimBlock; 2],
}

#[derive(Serialize)]
struct Table3RmsBlock {
    tests: Vec<u8>,
    turn: f64,
    ours: f64,
    paper_rows: f64,
    paper: f64,
    claim: ClaimBlock,
}

#[derive(Serialize)]
struct EnergyBlock {
    test: u8,
    quantity: &'static str,
    ours: f64,
    paper: f64,
    claim: ClaimBlock,
}

#[derive(Serialize)]
struct FigureBlock {
    quantity: String,
    ours: f64,
    paper: f64,
    claim: ClaimBlock,
}

/// From the published profiles; then from other energies.
#[derive(Serialize)]
struct ReconstructionBlock {
    test: u8,
    crush_energy: f64,
    found: f64,
    #[serde(rename = "true")]
    true_speed: f64,
    error: f64,
    implied: FoundBlock,
    round_trip: FoundBlock,
}

#[derive(Serialize)]
struct FoundBlock {
    crush_energy: f64,
    found: f64,
    error: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    claim: Option<ClaimBlock>,
}

#[derive(Serialize)]
struct ChoicesBlock {
    test: u8,
    fitted: f64,
    critical: f64,
    critical_plastic: f64,
    pdof: [TurnBlock; 3],
}

#[derive(Serialize)]
struct TurnBlock {
    turn: f64,
    corrected_delta_v: [f64; 2],
}

#[derive(Serialize)]
struct ErrorRates {
    delta_v: DeltaVRates,
    speed: SpeedRates,
}

#[derive(Serialize)]
struct DeltaVRates {
    pim: RateBlock,
    pim_paper: RateBlock,
    crash3: RateBlock,
    crash3_implied: RateBlock,
    crash3_paper: RateBlock,
}

#[derive(Serialize)]
struct SpeedRates {
    profiles: RateBlock,
    profiles_relative: RateBlock,
    implied: RateBlock,
    implied_relative: RateBlock,
    round_trip: RateBlock,
    round_trip_relative: RateBlock,
}

#[derive(Serialize)]
struct RateBlock {
    count: usize,
    rms: f64,
    mean: f64,
    range: [f64; 2],
    limits: [f64; 2],
}

impl From<ErrorRate> for RateBlock {
    fn from(ErrorRate { count, rms, mean, range, limits }: ErrorRate) -> Self {
        Self { count, rms, mean, range, limits }
    }
}

/// Either a tolerance or the reason of a known difference.
#[derive(Serialize)]
struct ClaimBlock {
    reproduces: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    known_difference: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    erratum: Option<ErratumBlock>,
}

#[derive(Serialize)]
struct ErratumBlock {
    printed: String,
    reason: String,
}

fn claim(cell: &Cell) -> ClaimBlock {
    let (tolerance, known_difference) = match &cell.claim {
        Claim::Reproduces { tolerance } => (Some(*tolerance), None),
        Claim::KnownDifference { reason } => (None, Some(reason.clone())),
    };
    ClaimBlock {
        reproduces: cell.is_claimed().then(|| !cell.fails()),
        tolerance,
        known_difference,
        erratum: cell
            .erratum
            .as_ref()
            .map(|erratum| ErratumBlock { printed: erratum.printed.clone(), reason: erratum.reason.clone() }),
    }
}

fn pair<T>(cells: &[Cell; 2], of: impl Fn(&Cell) -> T) -> [T; 2] {
    [of(&cells[0]), of(&cells[1])]
}

fn row_name(row: Row) -> &'static str {
    match row {
        Row::PimCrush => "pim_crush",
        Row::PimTotal => "pim_total",
        Row::CrashUncorrected => "crash_uncorrected",
        Row::CrashCorrected => "crash_corrected",
        Row::CrashUncorrectedImplied => "crash_uncorrected_implied",
        Row::CrashCorrectedImplied => "crash_corrected_implied",
    }
}

/// The comparison as indented JSON, ending in a line break.
///
/// # Errors
/// Where serialisation fails, which no comparison causes.
pub fn validation_json(validation: &Validation) -> Result<String, serde_json::Error> {
    let dv = &validation.delta_v_errors;
    let speed = &validation.speed_errors;
    let turn = |pdof: TurnedPdof| TurnBlock { turn: pdof.turn, corrected_delta_v: pdof.delta_v };
    let document = Document {
        claimed: validation.claimed(),
        failed: validation
            .failures()
            .into_iter()
            .map(|(place, cell)| FailureBlock { place, ours: cell.ours, paper: cell.paper })
            .collect(),
        table1: validation
            .table1
            .iter()
            .map(|line| Table1Block {
                geometry: line.geometry.clone(),
                tests: line.tests.clone(),
                method: match line.method {
                    Method::Pim => "pim",
                    Method::Crash3 => "crash3",
                },
                ours: line.ours,
                ours_implied: line.ours_implied,
                paper_rows: line.paper_rows.ours,
                paper: line.paper_rows.paper,
                claim: claim(&line.paper_rows),
            })
            .collect(),
        table2: validation
            .table2
            .iter()
            .map(|line| Table2Block {
                test: line.test,
                row: row_name(line.row),
                ours: pair(&line.cells, |cell| cell.ours),
                paper: pair(&line.cells, |cell| cell.paper),
                difference: pair(&line.cells, Cell::difference),
                measured: line.measured,
                claims: pair(&line.cells, claim),
            })
            .collect(),
        table3: validation
            .table3
            .iter()
            .map(|line| Table3Block {
                test: line.test,
                turn: line.turn,
                ours: pair(&line.cells, |cell| cell.ours),
                paper: pair(&line.cells, |cell| cell.paper),
                difference: pair(&line.cells, Cell::difference),
                claims: pair(&line.cells, claim),
            })
            .collect(),
        table3_rms: validation
            .table3_rms
            .iter()
            .map(|line| Table3RmsBlock {
                tests: line.tests.clone(),
                turn: line.turn,
                ours: line.ours,
                paper_rows: line.paper_rows.ours,
                paper: line.paper_rows.paper,
                claim: claim(&line.paper_rows),
            })
            .collect(),
        energies: validation
            .energies
            .iter()
            .flat_map(|line| {
                [
                    ("initial_energy", &line.initial),
                    ("normal_loss", &line.normal),
                    ("tangential_loss", &line.tangential),
                    ("total_loss", &line.total),
                ]
                .map(|(quantity, cell)| EnergyBlock {
                    test: line.test,
                    quantity,
                    ours: cell.ours,
                    paper: cell.paper,
                    claim: claim(cell),
                })
            })
            .collect(),
        appendix: validation
            .appendix
            .iter()
            .map(|figure| FigureBlock {
                quantity: figure.quantity.clone(),
                ours: figure.cell.ours,
                paper: figure.cell.paper,
                claim: claim(&figure.cell),
            })
            .collect(),
        reconstruction: validation
            .reconstructions
            .iter()
            .map(|line| ReconstructionBlock {
                test: line.test,
                crush_energy: line.crush_energy,
                found: line.found,
                true_speed: line.true_speed,
                error: line.error(),
                implied: FoundBlock {
                    crush_energy: line.implied_energy,
                    found: line.found_implied,
                    error: line.found_implied - line.true_speed,
                    claim: None,
                },
                round_trip: FoundBlock {
                    crush_energy: line.printed_normal_loss,
                    found: line.round_trip.ours,
                    error: line.round_trip.difference(),
                    claim: Some(claim(&line.round_trip)),
                },
            })
            .collect(),
        choices: validation
            .reconstructions
            .iter()
            .map(|line| ChoicesBlock {
                test: line.test,
                fitted: line.found,
                critical: line.choices.critical,
                critical_plastic: line.choices.critical_plastic,
                pdof: line.choices.pdof.map(turn),
            })
            .collect(),
        error_rate: ErrorRates {
            delta_v: DeltaVRates {
                pim: dv.pim.into(),
                pim_paper: dv.pim_paper.into(),
                crash3: dv.crash3.into(),
                crash3_implied: dv.crash3_implied.into(),
                crash3_paper: dv.crash3_paper.into(),
            },
            speed: SpeedRates {
                profiles: speed.profiles.into(),
                profiles_relative: speed.profiles_relative.into(),
                implied: speed.implied.into(),
                implied_relative: speed.implied_relative.into(),
                round_trip: speed.round_trip.into(),
                round_trip_relative: speed.round_trip_relative.into(),
            },
        },
    };
    pretty(&document)
}
