//! The comparison as JSON, in SI units and radians.

use serde::Serialize;
use validation::{
    Cell, Claim, DeltaVRow, Erratum, ErrorRate, Method, Requirement, RestMethod, SHARES, SpeedEvidence,
    TurnedPdof, Validation,
};

use super::pretty;

#[derive(Serialize)]
struct Document {
    claimed: usize,
    failed: Vec<FailureBlock>,
    requirements: Vec<RequirementBlock>,
    table1: Vec<Table1Block>,
    table2: Vec<Table2Block>,
    table3: Vec<Table3Block>,
    table3_rms: Vec<Table3RmsBlock>,
    energies: Vec<EnergyBlock>,
    appendix: Vec<FigureBlock>,
    reconstruction: Vec<ReconstructionBlock>,
    choices: Vec<ChoicesBlock>,
    by_share: Vec<ShareBlock>,
    motion: Vec<MotionBlock>,
    back_from_rest: Vec<ReturnBlock>,
    simulations: Vec<SimulationBlock>,
    both_speeds: Vec<BothSpeedsBlock>,
    both_speeds_from_rest: Vec<FromRestBlock>,
    error_rate: ErrorRates,
}

#[derive(Serialize)]
struct FailureBlock {
    place: String,
    ours: f64,
    paper: f64,
}

/// A requirement of the methods with the result of its test.
#[derive(Serialize)]
struct RequirementBlock {
    code: &'static str,
    requirement: &'static str,
    test: &'static str,
    acceptance: &'static str,
    compared: usize,
    failed: usize,
    /// Greatest difference as a share of its tolerance.
    worst: f64,
    met: bool,
}

impl RequirementBlock {
    fn of(found: &Requirement) -> Self {
        let Requirement { code, requirement, test, acceptance, compared, failed, worst } = *found;
        Self { code, requirement, test, acceptance, compared, failed, worst, met: found.is_met() }
    }
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

/// The speed by the share of the tangential work.
#[derive(Serialize)]
struct ShareBlock {
    tangential_share: f64,
    /// In the order of the tests of `reconstruction`; `null` where there is no answer.
    found: Vec<Option<f64>>,
    relative_error: RateBlock,
}

#[derive(Serialize)]
struct TurnBlock {
    turn: f64,
    corrected_delta_v: [f64; 2],
}

#[derive(Serialize)]
struct CellBlock {
    ours: f64,
    paper: f64,
    claim: ClaimBlock,
}

impl From<&Cell> for CellBlock {
    fn from(cell: &Cell) -> Self {
        Self { ours: cell.ours, paper: cell.paper, claim: claim(cell) }
    }
}

#[derive(Serialize)]
struct MotionBlock {
    test: u8,
    vehicle: u8,
    drag: f64,
    distance: CellBlock,
    distance_within: f64,
    path: f64,
    time: f64,
    turn: CellBlock,
    #[serde(skip_serializing_if = "Option::is_none")]
    rest_missed: Option<f64>,
}

#[derive(Serialize)]
struct ReturnBlock {
    test: u8,
    vehicle: u8,
    drag: f64,
    round_trip: CellBlock,
    #[serde(skip_serializing_if = "Option::is_none")]
    from_rest: Option<StartBlock>,
}

#[derive(Serialize)]
struct StartBlock {
    speed: CellBlock,
    direction: CellBlock,
    yaw_rate: CellBlock,
    speed_of_turned_way: [f64; 2],
}

/// Shares of the path.
#[derive(Serialize)]
struct SimulationBlock {
    name: String,
    mean_errors: [f64; 2],
}

#[derive(Serialize)]
struct BothSpeedsBlock {
    test: u8,
    evidence: &'static str,
    #[serde(rename = "true")]
    true_speeds: [f64; 2],
    found: [f64; 2],
    error: [f64; 2],
    impulse_disagreement: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    erratum: Option<ErratumBlock>,
}

#[derive(Serialize)]
struct FromRestBlock {
    test: u8,
    method: &'static str,
    evidence: &'static str,
    drag: f64,
    after: [f64; 2],
    #[serde(rename = "true")]
    true_speeds: [f64; 2],
    found: [f64; 2],
    error: [f64; 2],
}

#[derive(Serialize)]
struct ErrorRates {
    delta_v: DeltaVRates,
    speed: SpeedRates,
    both_speeds: BothSpeedsRates,
}

#[derive(Serialize)]
struct BothSpeedsRates {
    all: RateBlock,
    all_relative: RateBlock,
    momentum: RateBlock,
    momentum_relative: RateBlock,
    momentum_and_crush: RateBlock,
    momentum_and_crush_relative: RateBlock,
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
        erratum: cell.erratum.as_ref().map(ErratumBlock::from),
    }
}

impl From<&Erratum> for ErratumBlock {
    fn from(Erratum { printed, reason }: &Erratum) -> Self {
        Self { printed: printed.clone(), reason: reason.clone() }
    }
}

fn evidence(evidence: SpeedEvidence) -> &'static str {
    match evidence {
        SpeedEvidence::Momentum => "momentum",
        SpeedEvidence::MomentumAndCrush => "momentum_and_crush",
    }
}

fn errors(found: [f64; 2], true_speeds: [f64; 2]) -> [f64; 2] {
    [found[0] - true_speeds[0], found[1] - true_speeds[1]]
}

fn pair<T>(cells: &[Cell; 2], of: impl Fn(&Cell) -> T) -> [T; 2] {
    [of(&cells[0]), of(&cells[1])]
}

fn row_name(row: DeltaVRow) -> &'static str {
    match row {
        DeltaVRow::PimCrush => "pim_crush",
        DeltaVRow::PimTotal => "pim_total",
        DeltaVRow::CrashUncorrected => "crash_uncorrected",
        DeltaVRow::CrashCorrected => "crash_corrected",
        DeltaVRow::CrashUncorrectedImplied => "crash_uncorrected_implied",
        DeltaVRow::CrashCorrectedImplied => "crash_corrected_implied",
    }
}

/// The comparison as indented JSON, ending in a line break.
///
/// # Errors
/// If serialisation fails, which no comparison causes.
pub fn validation_json(validation: &Validation) -> Result<String, serde_json::Error> {
    let dv = &validation.delta_v_errors;
    let speed = &validation.speed_errors;
    let both = &validation.both_speed_errors;
    let turn = |pdof: TurnedPdof| TurnBlock { turn: pdof.turn, corrected_delta_v: pdof.delta_v };
    let document = Document {
        claimed: validation.claimed(),
        failed: validation
            .failures()
            .into_iter()
            .map(|(place, cell)| FailureBlock { place, ours: cell.ours, paper: cell.paper })
            .collect(),
        requirements: validation.requirements().iter().map(RequirementBlock::of).collect(),
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
        by_share: SHARES
            .iter()
            .zip(validation.share_errors)
            .enumerate()
            .map(|(i, (&tangential_share, rate))| ShareBlock {
                tangential_share,
                found: validation.by_share.iter().map(|row| row.found[i]).collect(),
                relative_error: rate.into(),
            })
            .collect(),
        motion: validation
            .motions
            .iter()
            .map(|line| MotionBlock {
                test: line.test,
                vehicle: line.vehicle.number(),
                drag: line.drag,
                distance: (&line.distance).into(),
                distance_within: line.within,
                path: line.path,
                time: line.time,
                turn: (&line.turn).into(),
                rest_missed: line.miss,
            })
            .collect(),
        back_from_rest: validation
            .returns
            .iter()
            .map(|line| ReturnBlock {
                test: line.test,
                vehicle: line.vehicle.number(),
                drag: line.drag,
                round_trip: (&line.round_trip).into(),
                from_rest: line.from_rest.as_ref().map(|found| StartBlock {
                    speed: (&found.speed).into(),
                    direction: (&found.direction).into(),
                    yaw_rate: (&found.yaw_rate).into(),
                    speed_of_turned_way: found.turned,
                }),
            })
            .collect(),
        simulations: validation
            .simulations
            .iter()
            .map(|other| SimulationBlock { name: other.name.clone(), mean_errors: other.errors })
            .collect(),
        both_speeds: validation
            .both_speeds
            .iter()
            .map(|line| BothSpeedsBlock {
                test: line.test,
                evidence: evidence(line.evidence),
                true_speeds: line.true_speeds,
                found: line.found,
                error: errors(line.found, line.true_speeds),
                impulse_disagreement: line.disagreement,
                erratum: line.erratum.as_ref().map(ErratumBlock::from),
            })
            .collect(),
        both_speeds_from_rest: validation
            .from_rest
            .iter()
            .map(|line| FromRestBlock {
                test: line.test,
                method: match line.method {
                    RestMethod::Motion => "motion",
                    RestMethod::MotionDirected => "motion_directed",
                    RestMethod::Slide => "slide",
                },
                evidence: evidence(line.evidence),
                drag: line.drag,
                after: line.after,
                true_speeds: line.true_speeds,
                found: line.found,
                error: errors(line.found, line.true_speeds),
            })
            .collect(),
        error_rate: ErrorRates {
            both_speeds: BothSpeedsRates {
                all: both.all[0].into(),
                all_relative: both.all[1].into(),
                momentum: both.momentum[0].into(),
                momentum_relative: both.momentum[1].into(),
                momentum_and_crush: both.momentum_and_crush[0].into(),
                momentum_and_crush_relative: both.momentum_and_crush[1].into(),
            },
            delta_v: DeltaVRates {
                pim: dv.pim.into(),
                pim_paper: dv.pim_paper.into(),
                crash3: dv.crash3.into(),
                crash3_implied: dv.crash3_implied.into(),
                crash3_paper: dv.crash3_paper.into(),
            },
            speed: SpeedRates {
                profiles: speed.profiles[0].into(),
                profiles_relative: speed.profiles[1].into(),
                implied: speed.implied[0].into(),
                implied_relative: speed.implied[1].into(),
                round_trip: speed.round_trip[0].into(),
                round_trip_relative: speed.round_trip[1].into(),
            },
        },
    };
    pretty(&document)
}
