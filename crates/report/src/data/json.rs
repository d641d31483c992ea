//! A finished analysis as JSON, in SI units and radians.

use analysis::{
    Analysis, BothFound, BothMethod, Check, Combination, Exchange, Impact, Pass, Seen, SeenWarning, Travel,
    TravelOrigin, Weighed,
};
use case::{Basis, Case, CaseFile, Geometry, MarkedWheel, PointData};
use pim_core::VehicleId;
use reconcile::Unknown;
use serde::{Serialize, Serializer};
use trajectory::Sample;

use super::headline::{HeadlineBlock, SolutionBlock};
use super::{identified, pretty, title};
use crate::Units;
use crate::law;
use crate::warnings;
use crate::words;

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// Those of all signed values: `z-up` or `z-down`.
    axes: &'static str,
    /// The answer of a reconstruction, and what it is by.
    #[serde(skip_serializing_if = "Option::is_none")]
    headline: Option<HeadlineBlock>,
    /// Where all the evidence was weighed: what its parts say, each taken as exact.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    solutions: Vec<SolutionBlock>,
    /// Keys of evidence that the numbers below do not use.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    left_aside: Vec<String>,
    energy_basis: &'static str,
    /// Where the basis is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    tangential_share: Option<f64>,
    warnings: Vec<WarningBlock>,
    /// What speaks against the exact solution, where all the evidence was weighed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    solution_warnings: Vec<WarningBlock>,
    checks: Vec<CheckBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    found: Option<Found>,
    #[serde(skip_serializing_if = "Option::is_none")]
    momentum: Option<MomentumBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    impact: Option<ImpactBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    law_check: Option<LawCheckBlock>,
    vehicle1: VehicleBlock,
    vehicle2: VehicleBlock,
    #[serde(skip_serializing_if = "Option::is_none")]
    crash3: Option<Crash3Block>,
}

#[derive(Serialize)]
struct CheckBlock {
    code: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    vehicle: Option<u8>,
    value: f64,
    limit: f64,
    passed: bool,
}

#[derive(Serialize)]
pub(crate) struct WarningBlock {
    code: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    vehicle: Option<u8>,
    message: String,
}

impl WarningBlock {
    pub(crate) fn new(seen: &SeenWarning) -> Self {
        let message = warnings::message(seen, Units::Si);
        let warning = seen.warning();
        Self { code: warning.code(), vehicle: warning.vehicle().map(VehicleId::number), message }
    }

    /// Those of an analysis.
    pub(crate) fn all(analysis: &Analysis, case: &Case) -> Vec<Self> {
        let seen = analysis.seen(case.axes);
        seen.warnings.iter().map(Self::new).collect()
    }
}

/// One speed, or a list of both: as `reconstruct.find` of the case.
enum Found {
    One(FoundBlock),
    Both([FoundBlock; 2]),
}

impl Serialize for Found {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::One(found) => found.serialize(serializer),
            Self::Both(found) => found.serialize(serializer),
        }
    }
}

/// What both speeds and the velocities after the impact imply, without an impact law.
#[derive(Serialize)]
struct MomentumBlock {
    /// From the heading of vehicle 1 to that of vehicle 2.
    approach_angle: f64,
    impulse: [f64; 2],
    /// How far the impulses that the two vehicles tell lie apart.
    disagreement: f64,
    restitution: Option<f64>,
    /// Of the CGs towards each other.
    #[serde(skip_serializing_if = "Option::is_none")]
    cg_closing_speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cg_restitution: Option<f64>,
    /// These along n and t, and the yaw rates, are not known of point masses.
    #[serde(skip_serializing_if = "Option::is_none")]
    impulse_ratio: Option<Option<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    critical_impulse_ratio: Option<Option<f64>>,
    energy_loss: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_work: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangential_work: Option<f64>,
    delta_v: OfMovable,
    pdof: OfMovable,
    #[serde(skip_serializing_if = "Option::is_none")]
    final_yaw_rate: Option<OfMovable>,
    /// Each start of vehicle 1 with each of vehicle 2 that leads to the rests, the one that is used first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    combinations: Vec<CombinationBlock>,
}

/// A start of each vehicle that leads to its rest, and how well the two agree with the impulse.
#[derive(Serialize)]
struct CombinationBlock {
    /// Along the headings.
    speeds: [f64; 2],
    /// After the impact.
    velocities: [[f64; 2]; 2],
    /// After the impact; none of a vehicle of which it is not known.
    yaw_rates: [Option<f64>; 2],
    /// On the way to rest; none of a vehicle that is not followed.
    turns: [Option<f64>; 2],
    /// χ² of what the speeds imply against what else is known.
    misfit: f64,
    weight: f64,
    /// Codes of the checks that it does not pass.
    against: Vec<&'static str>,
}

/// Skid marks before the impact.
#[derive(Serialize)]
struct InferredBlock {
    depth: f64,
    width: f64,
}

#[derive(Serialize)]
struct SkidBlock {
    /// Where they begin.
    speed: f64,
}

#[derive(Serialize)]
struct StartBlock {
    /// `impact`, `given` or `rest`: what it comes from.
    source: &'static str,
    speed: f64,
    direction: f64,
    yaw_rate: f64,
}

#[derive(Serialize)]
struct RestBlock {
    x: f64,
    y: f64,
    /// Counted on from the heading at the impact through full turns.
    heading: f64,
    time: f64,
    distance: f64,
}

/// A moment of the way to rest.
#[derive(Serialize)]
struct PathBlock {
    time: f64,
    x: f64,
    y: f64,
    heading: f64,
    velocity: [f64; 2],
    yaw_rate: f64,
    /// Front left, front right, rear left, rear right.
    sliding: [bool; 4],
}

#[derive(Serialize)]
struct FoundBlock {
    quantity: &'static str,
    value: f64,
    admissible_roots: usize,
    roots: Vec<f64>,
    method: &'static str,
    iterations: Vec<IterationBlock>,
}

#[derive(Serialize)]
struct IterationBlock {
    speed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_work: Option<f64>,
    /// W_n + λ W_t, where the basis is a share of the tangential work.
    #[serde(skip_serializing_if = "Option::is_none")]
    crush_work: Option<f64>,
}

/// What the impact law makes of speeds that momentum gave.
#[derive(Serialize)]
struct LawCheckBlock {
    law: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    regime: Option<&'static str>,
    restitution: f64,
    energy_loss: f64,
    delta_v: OfMovable,
    /// By how much more than by momentum.
    delta_v_difference: OfMovable,
    final_speed: OfMovable,
    final_yaw_rate: OfMovable,
    pdof: OfMovable,
}

#[derive(Serialize)]
struct ImpactBlock {
    #[serde(skip_serializing_if = "Option::is_none")]
    law: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    regime: Option<&'static str>,
    /// `null` where vehicles do not close by momentum.
    restitution: Option<f64>,
    /// These along n and t are not known of point masses.
    #[serde(skip_serializing_if = "Option::is_none")]
    impulse_ratio: Option<Option<f64>>,
    /// `null` where no push, however rough the surfaces, could end the sliding.
    #[serde(skip_serializing_if = "Option::is_none")]
    critical_impulse_ratio: Option<Option<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_impulse: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangential_impulse: Option<f64>,
    impulse: [f64; 2],
    impulse_direction: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<[f64; 2]>,
    closing_speed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_velocity: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangential_velocity: Option<[f64; 2]>,
    initial_energy: f64,
    final_energy: f64,
    energy_loss: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_work: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangential_work: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    moment_impulse: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    moment_work: Option<f64>,
}

/// Of a vehicle, or of a fixed object. Keys that do not apply are left out.
#[derive(Serialize)]
struct VehicleBlock {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fixed: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    yaw_rate: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    final_velocity: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    final_yaw_rate: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    final_speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_v: Option<f64>,
    /// Forward.
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_v_longitudinal: Option<f64>,
    /// Along the y axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_v_lateral: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_v_vector: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pdof: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness_source: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    crush_source: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    crush_energy: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    crush_energy_bounds: Option<[f64; 2]>,
    /// (m) depth and width of a crush that was inferred from the force on the other vehicle.
    #[serde(skip_serializing_if = "Option::is_none")]
    inferred_crush: Option<InferredBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    oblique_angle: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    oblique_factor: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    corrected_crush_energy: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ees: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    peak_force: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    no_damage_speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    skid: Option<SkidBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StartBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rest: Option<RestBlock>,
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<Vec<PathBlock>>,
    /// How the way passes the points of the case.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    points: Vec<PointBlock>,
}

#[derive(Serialize)]
struct PointBlock {
    #[serde(skip_serializing_if = "Option::is_none")]
    wheel: Option<&'static str>,
    miss: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    turned: Option<f64>,
}

#[derive(Serialize)]
struct Crash3Block {
    crush_energy: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    corrected_crush_energy: Option<f64>,
    moment_arm: OfMovable,
    effective_mass_ratio: [f64; 2],
    delta_v: OfMovable,
    #[serde(skip_serializing_if = "Option::is_none")]
    corrected_delta_v: Option<OfMovable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    restitution_factor: Option<f64>,
    corrections: Vec<CorrectionBlock>,
}

/// CRASH3's answer under one correction for oblique forces.
#[derive(Serialize)]
struct CorrectionBlock {
    oblique: &'static str,
    /// The limits by vehicle, of the friction-limited correction.
    #[serde(skip_serializing_if = "Option::is_none")]
    friction: Option<OfMovable>,
    factor: [f64; 2],
    crush_energy: f64,
    delta_v: OfMovable,
}

/// The analysis as indented JSON, ending in a line break.
///
/// # Errors
/// Where serialisation fails, which no analysis causes.
pub fn json(file: &CaseFile, analysis: &Analysis) -> Result<String, serde_json::Error> {
    pretty(&identified(file, document(&file.case, analysis)))
}

/// The same of a case with more evidence than its exact solution uses: its headline is by all of it.
///
/// # Errors
/// As [`json`].
pub fn weighed_json(
    file: &CaseFile,
    analysis: &Analysis,
    weighed: &Weighed,
) -> Result<String, serde_json::Error> {
    pretty(&identified(file, headed(&file.case, analysis, Some(weighed))))
}

/// What the JSON says.
pub(crate) fn document<'a>(case: &'a Case, analysis: &Analysis) -> impl Serialize + use<'a> {
    headed(case, analysis, None)
}

fn headed<'a>(case: &'a Case, analysis: &Analysis, weighed: Option<&Weighed>) -> Document<'a> {
    let headline = HeadlineBlock::of(analysis, weighed);
    let is_exact = weighed.is_none();
    let analysis = &analysis.seen(case.axes);
    let [vehicle1, vehicle2] = VehicleId::ALL.map(|id| vehicle(case, analysis, id));
    let share = match analysis.basis {
        Basis::TangentialShare(share) => Some(share),
        Basis::Dissipated | Basis::Absorbed => None,
    };
    Document {
        title: title(case),
        axes: case.axes.name(),
        headline,
        solutions: SolutionBlock::all(weighed),
        left_aside: analysis.left_aside.clone(),
        energy_basis: analysis.basis.name(),
        tangential_share: share,
        warnings: analysis
            .warnings
            .iter()
            .filter(|seen| is_exact || !seen.warning().is_of_exact_solution())
            .map(WarningBlock::new)
            .collect(),
        solution_warnings: analysis
            .warnings
            .iter()
            .filter(|seen| !is_exact && seen.warning().is_of_exact_solution())
            .map(WarningBlock::new)
            .collect(),
        checks: analysis
            .checks
            .iter()
            .map(|check| CheckBlock {
                code: check.code(),
                vehicle: check.vehicle().map(VehicleId::number),
                value: plain(check.value),
                limit: check.limit,
                passed: check.passed(),
            })
            .collect(),
        found: found(analysis),
        momentum: analysis.both.as_ref().map(|both| momentum(case, both)),
        impact: analysis.exchange().map(|of| exchanged(case, analysis, &of)),
        law_check: analysis.law_check().map(|law| law_check(case, analysis, law)),
        vehicle1,
        vehicle2,
        crash3: analysis.crash3.as_ref().map(|crash3| Crash3Block {
            crush_energy: crash3.crush_energy,
            corrected_crush_energy: crash3.corrected.map(|corrected| corrected.crush_energy),
            moment_arm: of_movable(case, crash3.moment_arm),
            effective_mass_ratio: crash3.effective_mass_ratio,
            delta_v: of_movable(case, crash3.delta_v),
            corrected_delta_v: crash3.corrected.map(|corrected| of_movable(case, corrected.delta_v)),
            restitution_factor: crash3.restitution_factor,
            corrections: crash3
                .corrections
                .iter()
                .map(|row| CorrectionBlock {
                    oblique: law::row_name(row),
                    friction: law::friction_limits(row).map(|limits| of_movable(case, limits)),
                    factor: row.factor,
                    crush_energy: row.crush_energy,
                    delta_v: of_movable(case, row.delta_v),
                })
                .collect(),
        }),
    }
}

fn found(analysis: &Seen) -> Option<Found> {
    if let Some(found) = &analysis.found {
        return Some(Found::One(FoundBlock {
            quantity: words::unknown_name(found.unknown),
            value: plain(found.speed),
            admissible_roots: found.admissible.len(),
            roots: found.admissible.iter().copied().map(plain).collect(),
            method: if found.iterations.is_some() { "root finder" } else { "closed form" },
            iterations: found
                .iterations
                .iter()
                .flatten()
                .map(|step| {
                    let work = Some(plain(step.normal_work));
                    let has_share = matches!(analysis.basis, Basis::TangentialShare(_));
                    IterationBlock {
                        speed: plain(step.speed),
                        normal_work: work.filter(|_| !has_share),
                        crush_work: work.filter(|_| has_share),
                    }
                })
                .collect(),
        }));
    }
    let both = analysis.both.as_ref()?;
    let of = |unknown: Unknown| {
        let value = plain(both.speeds[unknown.index()]);
        let (method, roots) = match &both.method {
            BothMethod::Momentum => ("momentum", vec![value]),
            BothMethod::MomentumAndSpeed { .. } => ("momentum and known speed", vec![value]),
            BothMethod::Wall { .. } => ("restitution", vec![value]),
            BothMethod::MomentumAndCrush { admissible, .. } => (
                "momentum and crush energy",
                admissible.iter().map(|speeds| plain(speeds[unknown.index()])).collect(),
            ),
        };
        FoundBlock {
            quantity: words::unknown_name(unknown),
            value,
            admissible_roots: roots.len(),
            roots,
            method,
            iterations: Vec::new(),
        }
    };
    Some(match both.sought() {
        Some(VehicleId::One) => Found::One(of(Unknown::Speed1)),
        Some(VehicleId::Two) => Found::One(of(Unknown::Speed2)),
        None => Found::Both([of(Unknown::Speed1), of(Unknown::Speed2)]),
    })
}

fn momentum(case: &Case, both: &BothFound) -> MomentumBlock {
    let implied = &both.implied;
    let is_contact = both.geometry != Geometry::PointMasses;
    MomentumBlock {
        approach_angle: plain(both.momentum.angle()),
        impulse: plain_pair(implied.impulse_vector.into()),
        disagreement: implied.disagreement(),
        restitution: implied.restitution.map(plain),
        cg_closing_speed: both.cg_line.map(|line| plain(line.closing_speed)),
        cg_restitution: both.cg_line.and_then(|line| line.restitution).map(plain),
        impulse_ratio: is_contact.then(|| implied.impulse_ratio.map(plain)),
        critical_impulse_ratio: is_contact.then(|| implied.critical_impulse_ratio.map(plain)),
        energy_loss: plain(implied.energy_loss),
        normal_work: is_contact.then(|| plain(implied.normal_work)),
        tangential_work: is_contact.then(|| plain(implied.tangential_work)),
        delta_v: of_movable(case, implied.delta_v.map(|change| change.norm())),
        pdof: of_movable(case, plain_pair(implied.pdof)),
        final_yaw_rate: is_contact.then(|| of_movable(case, plain_pair(implied.yaw_rates))),
        combinations: both.combinations.iter().map(combination).collect(),
    }
}

fn combination(combination: &Combination) -> CombinationBlock {
    CombinationBlock {
        speeds: plain_pair(combination.speeds),
        velocities: combination.after.map(|departure| plain_pair(departure.velocity.into())),
        yaw_rates: combination.after.map(|departure| departure.yaw_rate.map(plain)),
        turns: combination.turns.map(|turn| turn.map(plain)),
        misfit: combination.misfit,
        weight: combination.weight,
        against: combination.against.iter().map(Check::code).collect(),
    }
}

fn path(travel: &Travel) -> Vec<PathBlock> {
    let moment = |sample: &Sample| PathBlock {
        time: sample.time,
        x: plain(sample.state.position.x),
        y: plain(sample.state.position.y),
        heading: plain(sample.state.heading),
        velocity: plain_pair(sample.state.motion.velocity.into()),
        yaw_rate: plain(sample.state.motion.yaw_rate),
        sliding: sample.sliding,
    };
    travel.samples.iter().map(moment).collect()
}

fn points(travel: &Travel) -> Vec<PointBlock> {
    let point = |(pass, point): (&Pass, &PointData)| PointBlock {
        wheel: point.wheel.map(MarkedWheel::name),
        miss: pass.miss,
        turned: pass.turned.map(plain),
    };
    travel.passes.iter().zip(&travel.points).map(point).collect()
}

/// What the impact did, by what gave the speeds.
fn exchanged(case: &Case, analysis: &Seen, of: &Exchange) -> ImpactBlock {
    let law = analysis.impact.as_ref().filter(|_| analysis.law_check().is_none());
    block(case, of, law)
}

fn block(case: &Case, of: &Exchange, law: Option<&Impact>) -> ImpactBlock {
    let moment = law.filter(|impact| impact.law.has_moment()).map(|impact| &impact.outcome);
    let contact = of.at_contact.as_ref();
    let name = || case.impact.as_ref().map_or("brach", |given| given.law.name());
    ImpactBlock {
        law: law.map(|_| name()),
        regime: law.and_then(|impact| impact.outcome.regime).map(words::regime_name),
        restitution: of.restitution.map(plain),
        impulse_ratio: contact.map(|contact| contact.impulse_ratio.map(plain)),
        critical_impulse_ratio: contact.map(|contact| contact.critical_impulse_ratio.map(plain)),
        normal_impulse: contact.map(|contact| contact.impulse.normal),
        tangential_impulse: contact.map(|contact| plain(contact.impulse.tangential)),
        impulse: plain_pair(of.impulse_vector.into()),
        impulse_direction: plain(of.impulse_direction()),
        normal: contact.map(|contact| plain_pair(contact.normal.into())),
        closing_speed: of.closing_speed,
        normal_velocity: contact.map(|contact| plain_pair(contact.velocities.map(|u| u.normal))),
        tangential_velocity: contact.map(|contact| plain_pair(contact.velocities.map(|u| u.tangential))),
        initial_energy: of.energy.before,
        final_energy: of.energy.after,
        energy_loss: plain(of.energy.loss),
        normal_work: contact.map(|_| plain(of.energy.normal_work)),
        tangential_work: contact.map(|_| plain(of.energy.tangential_work)),
        moment_impulse: moment.map(|outcome| plain(outcome.moment_impulse)),
        moment_work: moment.map(|outcome| plain(outcome.energy.moment_work)),
    }
}

fn law_check(case: &Case, analysis: &Seen, law: &Impact) -> LawCheckBlock {
    let outcome = &law.outcome;
    let by_law = outcome.delta_v_magnitude();
    let told = analysis.both.as_ref().map_or(by_law, |both| both.delta_v);
    LawCheckBlock {
        law: case.impact.as_ref().map_or("brach", |given| given.law.name()),
        regime: outcome.regime.map(words::regime_name),
        restitution: law.law.restitution(),
        energy_loss: plain(outcome.energy.loss),
        delta_v: of_movable(case, by_law),
        delta_v_difference: of_movable(case, [by_law[0] - told[0], by_law[1] - told[1]].map(plain)),
        final_speed: of_movable(case, outcome.after.map(|motion| motion.velocity.norm())),
        final_yaw_rate: of_movable(case, outcome.after.map(|motion| plain(motion.yaw_rate))),
        pdof: of_movable(case, law.pdof.map(plain)),
    }
}

fn vehicle(case: &Case, analysis: &Seen, id: VehicleId) -> VehicleBlock {
    let i = id.index();
    let fixed = case.vehicles[i].fixed;
    let moves = analysis.exchange().filter(|_| !fixed);
    let damage = analysis.vehicles[i].damage.as_ref();
    let oblique = damage.and_then(|damage| damage.oblique);
    let of = &analysis.vehicles[i];
    let given_pdof = of.crash3_pdof();
    let travel = analysis.travel[i].as_ref();
    VehicleBlock {
        name: case.vehicles[i].name.as_ref().map(|name| name.as_given().to_owned()),
        fixed: fixed.then_some(true),
        speed: moves.map(|_| plain(analysis.speed(id))),
        velocity: moves.map(|of| plain_pair(of.before[i].velocity.into())),
        yaw_rate: moves.map(|of| plain(of.before[i].yaw_rate)),
        final_velocity: moves.map(|of| plain_pair(of.velocities[i].into())),
        final_yaw_rate: moves.and_then(|of| of.yaw_rates[i]).map(plain),
        final_speed: moves.map(|of| of.velocities[i].norm()),
        delta_v: moves.map(|of| of.delta_v[i].norm()),
        delta_v_longitudinal: moves.map(|of| plain(of.delta_v_components[i][0])),
        delta_v_lateral: moves.map(|of| plain(of.delta_v_components[i][1])),
        delta_v_vector: moves.map(|of| plain_pair(of.delta_v[i].into())),
        pdof: moves.map(|exchange| exchange.pdof[i]).or(given_pdof).map(plain),
        stiffness_source: analysis.vehicles[i]
            .subject
            .damage
            .as_ref()
            .map(|given| words::stiffness_source(given.stiffness_source, given.side)),
        crush_source: words::crush_source(of),
        crush_energy: of.crush_energy(),
        crush_energy_bounds: damage
            .and_then(|damage| damage.inferred?.range)
            .map(|range| [range.lowest.energy, range.highest.energy]),
        inferred_crush: damage
            .and_then(|damage| damage.inferred)
            .map(|inferred| InferredBlock { depth: inferred.crush.depth, width: inferred.crush.width }),
        oblique_angle: damage.and_then(|damage| damage.oblique_angle).map(plain),
        oblique_factor: oblique.map(|oblique| oblique.factor.factor),
        corrected_crush_energy: of.corrected_crush_energy(),
        ees: of.ees(),
        peak_force: oblique.map(|oblique| oblique.peak_force),
        no_damage_speed: analysis.vehicles[i].no_damage_speed(),
        skid: analysis.skids[i].map(|skid| SkidBlock { speed: skid.speed }),
        start: travel.map(|travel| StartBlock {
            source: match travel.origin {
                TravelOrigin::Impact => "impact",
                TravelOrigin::Given => "given",
                TravelOrigin::Rest => "rest",
                TravelOrigin::StraightRest => "straight rest",
            },
            speed: travel.start.motion.velocity.norm(),
            direction: plain(travel.direction()),
            yaw_rate: plain(travel.start.motion.yaw_rate),
        }),
        rest: travel.map(|travel| RestBlock {
            x: plain(travel.rest.position.x),
            y: plain(travel.rest.position.y),
            heading: plain(travel.rest.heading),
            time: travel.rest.time,
            distance: travel.rest.distance,
        }),
        path: travel.map(path),
        points: travel.map_or_else(Vec::new, points),
    }
}

/// What only a vehicle has that can move: `None` of a fixed object.
pub(crate) type OfMovable = [Option<f64>; 2];

pub(crate) fn of_movable(case: &Case, values: [f64; 2]) -> OfMovable {
    [0, 1].map(|i| (!case.vehicles[i].fixed).then_some(values[i]))
}

/// No minus before zero.
fn plain(value: f64) -> f64 {
    value + 0.0
}

fn plain_pair(values: [f64; 2]) -> [f64; 2] {
    values.map(plain)
}
