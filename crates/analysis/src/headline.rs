//! The headline of a reconstruction: the exact solution if the case is just determined and its crush energies
//! are right on average, and otherwise all the evidence weighed.

use std::f64::consts::FRAC_PI_4;
use std::ops::ControlFlow;

use ::estimate::DrawsSummary;
use inputs::Case;
use pim_core::VehicleId;
use real::principal_angle;

use crate::analysis::Analysis;
use crate::aside::CRUSH_BIAS;
use crate::check::{Check, CheckedQuantity};
use crate::estimate::{
    Agreement, EstimatePlan, EstimateStage, Estimated, EstimatedOutput, estimate, estimate_evidence, may_back,
};
use crate::evidence::{ByEvidence, EvidenceMethod, by_evidence};
use crate::failure::Failure;
use crate::given::GivenSpeed;
use crate::output::Output;
use crate::quantities::{DELTA_V, SPEED};
use crate::speeds::BothMethod;
use crate::vehicle::Vehicle;
use crate::warning::{EnergyShown, Warning, of_typical};

impl<W> Analysis<W> {
    /// The checks that refute this exact solution: those that compare it with evidence or with what is
    /// possible at all, and not with the coefficients of the impact law, which are assumed.
    pub fn refuting(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| {
            let refutes = match check.quantity {
                CheckedQuantity::MomentumYawRate { .. }
                | CheckedQuantity::MomentumEnergy { .. }
                | CheckedQuantity::MomentumAcross { .. }
                | CheckedQuantity::MomentumBalance { .. }
                | CheckedQuantity::PossibleRestitution { .. } => true,
                // Under no impact law is it below 0 or above 1.
                CheckedQuantity::MomentumRestitution { implied, .. } => {
                    (implied - 1.0).max(-implied) > check.limit
                }
                _ => false,
            };
            refutes && !check.passed()
        })
    }
}

/// Whether the evidence that an answer does not use, or whose error it does not correct, can be weighed
/// with the rest: a case for momentum of point masses may lack data for that, and a rest position is no
/// evidence if the vehicle cannot be followed to it.
pub(crate) fn can_be_weighed(case: &Case, exact: &Analysis) -> bool {
    let is_excluded = |id: &VehicleId| !may_back(case, *id);
    let is_off = !exact.energies_shown().is_empty()
        || exact.takes_bound()
        || exact.nearly_stood().iter().any(is_excluded);
    if exact.left_aside.is_empty() && !is_off {
        return false;
    }
    let Ok(pieces) = estimate_evidence(case) else { return false };
    is_off || exact.left_aside.iter().any(|key| key == CRUSH_BIAS || is_of(key, &pieces))
}

/// Whether one of these pieces of evidence comes from a key; those of a recorder from any of its keys.
fn is_of(key: &str, pieces: &[String]) -> bool {
    let recorder = key.split_once(".recorder.").map(|(vehicle, _)| format!("{vehicle}.recorder."));
    pieces.iter().any(|piece| {
        key.ends_with(piece.as_str()) || recorder.as_ref().is_some_and(|recorder| piece.starts_with(recorder))
    })
}

/// Why the exact solution is not the answer of its case.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WhyNotExact {
    /// How the exact solution was found.
    pub solved_by: EvidenceMethod,
    /// The keys of the evidence that it does not use.
    pub left_aside: Vec<String>,
    /// Its own checks that refute it.
    pub refuted_by: Vec<Check>,
    /// Whether evidence that it does not use contradicts it, or a vehicle would be faster backward than any
    /// that backs.
    pub is_contradicted: bool,
    /// How much its crush energies show on average, if it does not correct them.
    pub energies_shown: Vec<EnergyShown>,
    /// Whether it takes the energy at which residual crush begins for that of the impact, although no vehicle
    /// has any.
    pub takes_bound: bool,
    /// The vehicles that it has move backward so slowly that they are likely to have stood.
    pub nearly_stood: Vec<VehicleId>,
}

impl Analysis {
    /// The evidence that gave the speeds of a reconstruction.
    #[must_use]
    pub fn solved_by(&self) -> EvidenceMethod {
        match (&self.found, self.both.as_ref().map(|both| &both.method)) {
            (Some(found), _) if !self.moves(found.unknown.other()) => EvidenceMethod::DamageByObject,
            (Some(found), _) => EvidenceMethod::DamageAndSpeed { given: found.unknown.other() },
            (None, Some(BothMethod::MomentumAndCrush { .. })) => EvidenceMethod::MomentumAndDamage,
            (None, Some(BothMethod::MomentumAndSpeed { given })) => {
                EvidenceMethod::MomentumAndSpeed { given: *given }
            }
            (None, Some(BothMethod::Wall { vehicle, restitution })) => {
                EvidenceMethod::Wall { vehicle: *vehicle, restitution: *restitution }
            }
            (None, Some(BothMethod::Momentum) | None) => EvidenceMethod::Momentum,
        }
    }

    /// How much crush energies by a typical stiffness show on average, if this solution depends on some; it
    /// takes them as they are.
    #[must_use]
    pub fn energies_shown(&self) -> Vec<EnergyShown> {
        self.warnings.iter().filter_map(Warning::energy_shown).collect()
    }

    /// Whether it depends on the crush energy of vehicles without residual crush, which is only an upper
    /// bound.
    #[must_use]
    pub fn takes_bound(&self) -> bool {
        let energies = self.vehicles.iter().filter_map(Vehicle::crush_energy).filter(|energy| *energy > 0.0);
        let without =
            self.warnings.iter().filter(|one| matches!(one, Warning::NoResidualCrush { .. })).count();
        self.solved_by().is_by_damage() && without > 0 && without == energies.count()
    }

    /// The vehicles that it has move backward, but no faster than those that stood, if the inputs are
    /// slightly off.
    #[must_use]
    pub fn nearly_stood(&self) -> Vec<VehicleId> {
        let nearly = |warning: &Warning| match warning {
            Warning::MovesBackward { vehicle, speed, found: true } => {
                (*speed > NEARLY_STOOD).then_some(*vehicle)
            }
            _ => None,
        };
        self.warnings.iter().filter_map(nearly).collect()
    }

    /// Why this exact solution is not the answer of the case; `None` if the evidence just determines the
    /// unknown speeds, its average error is zero and the checks hold, if the unused evidence cannot be
    /// weighed but contradicts nothing, and if no speed is unknown.
    #[must_use]
    pub fn why_not_exact(&self) -> Option<WhyNotExact> {
        if !self.is_reconstruction() {
            return None;
        }
        let refuted = self.refuting();
        let differs = |warning: &Warning| match warning {
            Warning::EvidenceDiffers { .. } | Warning::BelowRecord { .. } => true,
            Warning::MovesBackward { speed, found: true, .. } => *speed < -FASTEST_BACK,
            Warning::PdofDiffers { given, computed, limit, .. } => {
                principal_angle(given - computed).abs() > limit.max(PDOF_CONTRADICTS)
            }
            _ => false,
        };
        let why = WhyNotExact {
            solved_by: self.solved_by(),
            left_aside: self.left_aside.clone(),
            refuted_by: refuted.copied().collect(),
            is_contradicted: self.warnings.iter().any(differs),
            energies_shown: self.energies_shown(),
            takes_bound: self.takes_bound(),
            nearly_stood: self.nearly_stood(),
        };
        let is_refuted = why.is_contradicted || !why.refuted_by.is_empty();
        (is_refuted || self.can_be_weighed).then_some(why)
    }
}

/// All the evidence of an over-determined case, weighed, and the exact solutions.
#[derive(Debug)]
#[non_exhaustive]
pub struct Weighed {
    /// Why no exact solution is the answer.
    pub why: WhyNotExact,
    /// How the evidence was weighed.
    pub plan: EstimatePlan,
    /// The result.
    pub estimated: Estimated,
    /// The answers of parts of the evidence, each taken as exact.
    pub solutions: Vec<Solution>,
}

/// The answer of a part of the evidence that is taken as exact.
#[derive(Debug)]
#[non_exhaustive]
pub struct Solution {
    /// How it was found.
    pub by: EvidenceMethod,
    /// (m/s) the speeds along the headings, if it gives them.
    pub speeds: [Option<f64>; 2],
    /// (m/s) ΔV of the vehicles that move.
    pub delta_v: [Option<f64>; 2],
    /// Which of them, the speeds and the ΔV, lie outside the 95 % interval of all the evidence.
    pub outside: [[bool; 2]; 2],
    /// (m/s) the given speeds from which these differ.
    pub differs_from: [Option<f64>; 2],
    /// How much its crush energies show on average, if it does not correct them.
    pub energies_shown: Vec<EnergyShown>,
    /// Whether it takes a PDOF as exact that all the other evidence contradicts.
    pub has_wrong_pdof: bool,
    /// Its checks that fail, only for the solution that the analysis details.
    pub failed: Vec<Check>,
    /// Whether the analysis details it.
    pub is_detailed: bool,
}

/// Weighs all the evidence of a case whose exact solution is `exact`; `None` if that is the answer.
/// `progress` is that of [`estimate()`].
///
/// # Errors
/// [`Failure`], as [`estimate()`].
pub fn weigh(
    case: &Case,
    exact: &Analysis,
    plan: &EstimatePlan,
    progress: &mut (dyn FnMut(EstimateStage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Option<Weighed>, Failure> {
    let Some(why) = exact.why_not_exact() else { return Ok(None) };
    let mut estimated = estimate(case, plan, progress)?;
    let solutions = solutions(case, exact, &estimated);
    for vehicle in VehicleId::ALL.into_iter().filter(|id| !may_back(case, *id)) {
        let speeds = solutions.iter().filter_map(|solution| solution.speeds[vehicle.index()]);
        let slowest = if why.nearly_stood.contains(&vehicle) { 0.0 } else { NEARLY_STOOD };
        let backs = speeds.filter(|speed| (-FASTEST_BACK..slowest).contains(speed));
        if let Some(speed) = backs.min_by(f64::total_cmp) {
            // It names the speed, which the estimate did not know.
            let is_same =
                |one: &Warning| matches!(one, Warning::MayHaveBacked { vehicle: of, .. } if *of == vehicle);
            estimated.warnings.retain(|warning| !is_same(warning));
            estimated.warnings.push(Warning::MayHaveBacked { vehicle, speed: Some(speed) });
        }
    }
    Ok(Some(Weighed { why, plan: *plan, estimated, solutions }))
}

impl Weighed {
    /// The result of all the evidence for an output.
    #[must_use]
    pub fn output(&self, output: Output) -> Option<&EstimatedOutput> {
        self.estimated.output(output)
    }

    /// The distribution of an output.
    #[must_use]
    pub fn summary(&self, output: Output) -> Option<&DrawsSummary> {
        Some(&self.output(output)?.posterior)
    }

    /// Whether it is an answer: the run has converged, and the result agrees with all of the evidence.
    #[must_use]
    pub fn is_answer(&self) -> bool {
        self.estimated.no_answer().is_none()
    }
}

/// (rad) 45°: no direction of force that was measured or coded with any care is so far off.
const PDOF_CONTRADICTS: f64 = FRAC_PI_4;
/// (m/s) an exact solution below this did not just round a stop: -2 m/s, as fast as a walk.
pub const NEARLY_STOOD: f64 = -2.0;
/// (m/s) 30 km/h: a solution that is faster backward is wrong, and not that of a vehicle that backed.
pub const FASTEST_BACK: f64 = 30.0 / 3.6;

/// The exact solutions: the one that the analysis details, and those by other parts of the evidence.
fn solutions(case: &Case, exact: &Analysis, estimated: &Estimated) -> Vec<Solution> {
    let own = Found {
        by: exact.solved_by(),
        speeds: VehicleId::ALL.map(|id| Some(exact.speed(id))),
        delta_v: exact.delta_v().map(Some),
    };
    let mut solutions = vec![own.beside(case, exact, estimated, true)];
    if let Some(ByEvidence { damage, momentum, together, .. }) = by_evidence(case, exact) {
        // One weighed from momentum and damage alone would be a second answer next to the weighed one.
        for answer in [damage, momentum, together].into_iter().flatten() {
            let is_exact = !matches!(answer.by, EvidenceMethod::Weighed { .. });
            if is_exact && answer.by != own.by {
                let speeds = answer.speeds.map_or([None; 2], |speeds| speeds.map(Some));
                let found = Found { by: answer.by, speeds, delta_v: answer.delta_v.map(Some) };
                solutions.push(found.beside(case, exact, estimated, false));
            }
        }
    }
    solutions
}

/// How much the crush energies of a case show on average, if that is known.
fn energies_shown(case: &Case, exact: &Analysis) -> Vec<EnergyShown> {
    of_typical(case, &exact.vehicles).iter().filter_map(Warning::energy_shown).collect()
}

/// (–) of a given speed, or of 1 m/s if that is greater: a smaller difference is rounding in the case.
const SAME_SPEED: f64 = 0.01;

/// An exact solution, before it is compared with all the evidence.
#[derive(Clone, Copy)]
struct Found {
    by: EvidenceMethod,
    speeds: [Option<f64>; 2],
    delta_v: [Option<f64>; 2],
}

impl Found {
    fn beside(self, case: &Case, exact: &Analysis, estimated: &Estimated, is_detailed: bool) -> Solution {
        let moving = |values: [Option<f64>; 2]| {
            VehicleId::ALL.map(|id| values[id.index()].filter(|_| exact.moves(id)))
        };
        let (speeds, delta_v) = (moving(self.speeds), moving(self.delta_v));
        let outside = |output: Output, value: Option<f64>| {
            let found = estimated.output(output).filter(|found| found.varies());
            value.zip(found).is_some_and(|(value, found)| {
                let [.., widest] = &found.posterior.intervals;
                value < widest.low.value || value > widest.high.value
            })
        };
        let outside = [
            VehicleId::ALL.map(|vehicle| outside(SPEED.of_vehicle(vehicle), speeds[vehicle.index()])),
            VehicleId::ALL.map(|vehicle| outside(DELTA_V.of_vehicle(vehicle), delta_v[vehicle.index()])),
        ];
        let differs_from = VehicleId::ALL.map(|id| {
            let (found, given) = (speeds[id.index()]?, GivenSpeed::of_known(case, id)?.speed);
            ((found - given).abs() > SAME_SPEED * given.abs().max(1.0)).then_some(given)
        });
        let energies_shown = if self.by.is_by_damage() { energies_shown(case, exact) } else { Vec::new() };
        let takes_pdof = matches!(self.by, EvidenceMethod::Crash3 { pdof_is_given: true });
        let contradicting = estimated.with_agreement(Agreement::Contradicts);
        let has_wrong_pdof = takes_pdof && contradicting.iter().any(|key| key.ends_with(".crush.pdof"));
        let failed = exact.refuting().filter(|_| is_detailed).copied().collect();
        Solution {
            by: self.by,
            speeds,
            delta_v,
            outside,
            differs_from,
            energies_shown,
            has_wrong_pdof,
            failed,
            is_detailed,
        }
    }
}
