//! From a case to a finished analysis: reconstruct, impact or crush, with every warning that a careful
//! reconstructionist would raise.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let file = case::CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
//! let analysis = analysis::reconstruct(&file.case)?;
//! let found = analysis.found.as_ref().ok_or("a reconstruction finds a speed")?;
//! assert!((found.speed - 22.9).abs() < 0.05); // SAE 980025, appendix: 22.9 m/s
//! # Ok(())
//! # }
//! ```
//!
//! [`compare`] puts the answers of all impact laws and of CRASH3 side by side, and those of the damage, of
//! the momentum after the impact and of both. [`sensitivity`] shows how
//! sensitive the answer is to each input, and [`uncertainty()`] propagates input ranges to the results.
//! [`work_curve`] gives the work of the normal impulse over the speed, for a drawing.
//!
//! [`judge`] checks a case without solving it: which analyses it allows, what is assumed, and the warnings
//! that need no answer.
//!
//! [`QUANTITIES`] has a row for every number that an analysis gives: its key, label, symbol, kind, source and
//! how to read it.
//!
//! [`beside`] adds to an analysis what a report to hand over has besides.
//!
//! The types: [`reconstruct`], [`impact`] and [`crush`] each return an [`Analysis`]: the impact, each
//! vehicle's damage, CRASH3's own answer for comparison, and [`Warning`]s. A [`Failure`] says whether the
//! case or the physics is to blame.
//!
//! `examples/reconstruct.rs` reconstructs a file and lists its warnings, `examples/influence.rs` ranks its
//! numbers.
//!
//! # What it does not do
//!
//! It adds no equation: those are in `pim-core`, `crash3` and `reconcile`. It reads no file (`case` does) and
//! writes no text (`report` does), so a case can also be built in code from the types of `inputs`.

mod aside;
mod beside;
mod both;
mod checks;
mod codes;
mod compare;
mod curve;
mod damage;
mod estimate;
mod evidence;
mod exchange;
mod goal;
mod headline;
mod judgement;
mod quantities;
mod seen;
mod sensitivity;
mod thresholds;
mod travel;
mod uncertainty;
mod usual;
mod warning;

pub use self::estimate::{
    Assumed, EstimateOutput, EstimatePlan, EstimateStage, Estimated, EstimatedOutput, Impossible, MISSED,
    PieceFound, SameTwice, Stood, TOLD_BELOW, UnknownNumber, Unused, UnusedReason, estimate,
    estimate_evidence, estimate_outputs,
};
pub use self::evidence::{ByEvidence, EvidenceAnswer, EvidenceMethod, NoEvidence};
pub use aside::Evident;
use aside::Used;
pub use beside::{BACKWARD_SAMPLES, Beside, SAMPLES, beside, usual_samples};
pub use both::{BothFound, BothMethod, CgLine, Combination};
pub use checks::{Check, CheckedQuantity};
pub use compare::{Comparison, LawRow, compare};
pub use curve::{WorkPoint, first_push, work_curve};
pub use damage::{Correction, Crash3, Damage, EnergyAlone, Inferred, Oblique};
pub use exchange::{AtContact, EnergyBalance, Exchange};
pub use headline::{Overdetermined, Solution, Weighed, weigh};
pub use judgement::{Ability, Assumption, AxleMeasure, Judgement, assumptions, judge, nearest_class};
pub use quantities::{Kind, Of, OutputQuantity, QUANTITIES, Values, quantity};
pub use seen::{Seen, SeenWarning};
pub use sensitivity::{Derivative, Output, Sensitivity, Sweep, SweepRow, WayNumber, sensitivity};
use thresholds::HALF_HOUR;
pub use thresholds::{DELTA_V_DIFFERENCE, ENERGY_DIFFERENCE, FAST_CLOSING, HIGH_RESTITUTION, POINT_MISSED};
pub use travel::{ClosedForm, Origin as TravelOrigin, Pass, Skid, Travel};
use travel::{Record, after_impact, departures};
pub use uncertainty::{
    Doubt, Doubtful, ExactValue, Plan, REASONS, Reason, SampleBlock, Samples, Stage, TakenAsExact,
    UncertainInput, UncertainOutput, Uncertainty, is_searched_back, is_uncertain, samples, uncertainty,
    uncertainty_of,
};
pub use warning::{Drive, JumpSide, Magnitude, Warning};

use crash3::{CrushError, SideStiffness};
use inputs::{Basis, Case, Collision, Evidence, Faults, Purpose, SurfaceData, VehicleData};
use pim_core::{Contact, ImpactError, Law, Motion, Outcome, Real, VaryingLaw, VehicleId};
use reconcile::{
    AffineImpact, ApproachLine, Iteration, MomentumError, Problem, Quadratic, ReconcileError, SolutionMethod,
    Unknown,
};
use trajectory::{NoRest, Unreached};

/// A finished analysis in the axes of the engine: y to the left, counter-clockwise positive.
/// [`Analysis::seen`] converts it to those of a reader.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Analysis {
    /// What the crush energy is held equal to.
    pub basis: Basis,
    /// The speed found, in a reconstruction.
    pub found: Option<Found>,
    /// Both speeds, in a reconstruction that seeks them.
    pub both: Option<BothFound>,
    /// The impact by the impact law; `None` in an analysis of the damage alone, or of the motion alone, and
    /// where momentum gives the speeds of a case that has no law. Where momentum gives them, it is a check
    /// ([`law_check`](Self::law_check)): what the impact did is [`exchange`](Self::exchange).
    pub impact: Option<Impact>,
    /// How the vehicles touch, in an analysis of the geometry alone.
    pub geometry: Option<Contact>,
    /// The way of each vehicle from the impact to rest, where the case has the ground and the drag for it.
    pub travel: [Option<Travel>; 2],
    /// The skid marks of each vehicle before the impact.
    pub skids: [Option<Skid>; 2],
    /// The ground on which they are followed.
    pub surface: Option<SurfaceData>,
    /// Both vehicles.
    pub vehicles: [Vehicle; 2],
    /// CRASH3's answer, where the damage of all vehicles is known.
    pub crash3: Option<Crash3>,
    /// The keys of the evidence that the case has and this answer does not use. What is over-determined has
    /// no exact solution that takes account of all.
    pub left_aside: Vec<String>,
    /// Whether the case has what it takes to weigh that evidence; looked at only where there is any.
    pub can_be_weighed: bool,
    /// The consistency checks, passed or not.
    pub checks: Vec<Check>,
    /// What a careful reader should know.
    pub warnings: Vec<Warning>,
}

impl Analysis {
    /// Whether a vehicle can move and is not a fixed object.
    #[must_use]
    pub fn moves(&self, vehicle: VehicleId) -> bool {
        self.vehicles[vehicle.index()].moves()
    }

    /// (m/s) speed of a vehicle before the impact: negative where it moves backwards, zero for a fixed
    /// object.
    #[must_use]
    pub fn speed(&self, vehicle: VehicleId) -> f64 {
        match (&self.both, &self.impact) {
            (Some(both), _) => both.speeds[vehicle.index()],
            (None, impact) => impact.as_ref().map_or(0.0, |impact| impact.speed(vehicle)),
        }
    }

    /// (m/s) ΔV of both vehicles: those that go with the speeds of a reconstruction, or of the impact; zero
    /// where there is no impact.
    #[must_use]
    pub fn delta_v(&self) -> [f64; 2] {
        self.exchange().map(|exchange| exchange.delta_v.map(|change| change.norm())).unwrap_or_default()
    }

    /// With what the answer leaves aside of the evidence, and where that contradicts it.
    fn beside_the_rest(mut self, case: &Case) -> Self {
        let used = Used::of(self.found.as_ref(), self.both.as_ref().map(|both| &both.method));
        self.left_aside = aside::left_aside(case, used);
        self.can_be_weighed = !self.left_aside.is_empty() && headline::can_be_weighed(case);
        let contradictions = aside::contradictions(case, &self, used);
        self.warnings.extend(contradictions);
        self
    }

    /// With the ways to rest, and the checks and warnings about them.
    fn with_travel(mut self, travel: [Option<Travel>; 2], surface: Option<SurfaceData>) -> Self {
        let checks = checks::of_travel(&travel);
        warning::of_travel(&travel, self.both.as_ref(), &checks, &mut self.warnings);
        self.checks.extend(checks);
        self.travel = travel;
        self.surface = surface;
        self
    }
}

/// A speed that reconciles crush and impact.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Found {
    /// Whose speed.
    pub unknown: Unknown,
    /// (m/s) the speed along the heading.
    pub speed: f64,
    /// (m/s) all admissible speeds, from the slowest approach to the fastest.
    pub admissible: Vec<f64>,
    /// (J) crush energy of both vehicles.
    pub crush_energy: f64,
    /// (J) work sought, W_n + λ W_t: the crush energy, less the energy that restitution returns if the basis
    /// is absorbed energy. λ is 0 unless the basis is a share of the tangential work.
    pub normal_work: f64,
    /// How the relative velocity at C depends on the speed.
    pub line: ApproachLine,
    /// What the closed form was solved from; `None` where the root-finder gave the answer.
    pub quadratic: Option<Quadratic>,
    /// Impulse and sliding over the approach speed, where there is one.
    pub affine_impact: Option<AffineImpact>,
    /// The steps of the root-finder; `None` where a closed form gave the answer.
    pub iterations: Option<Vec<Iteration>>,
}

/// An impact with what it was computed from.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Impact {
    /// The geometry.
    pub contact: Contact,
    /// The impact law as given.
    pub given_law: VaryingLaw,
    /// The law with the restitution at this closing speed.
    pub law: Law,
    /// What happened.
    pub outcome: Outcome,
    /// (rad) principal direction of force of both vehicles, clockwise from the heading in any axes.
    pub pdof: [f64; 2],
}

impl Impact {
    fn new(contact: Contact, given_law: VaryingLaw, law: Law, outcome: Outcome) -> Self {
        Self { contact, given_law, law, outcome, pdof: outcome.pdof() }
    }

    /// (m/s) speed of a vehicle before the impact: negative where it moves backwards.
    #[must_use]
    pub fn speed(&self, vehicle: VehicleId) -> f64 {
        let velocity = self.outcome.before[vehicle.index()].velocity;
        let forward = self.contact.participants()[vehicle.index()].forward();
        // |v| = √(v_x² + v_y²)
        let size = (velocity.x * velocity.x + velocity.y * velocity.y).sqrt();
        if velocity.x * forward.x + velocity.y * forward.y < 0.0 { -size } else { size }
    }
}

/// One vehicle.
#[derive(Clone, Debug)]
pub struct Vehicle<T = f64> {
    /// The data that the case gives.
    pub subject: VehicleData<T>,
    /// Its damage, where the crush was measured or inferred.
    pub damage: Option<Damage<T>>,
    /// Its damage, where only the energy is known.
    pub energy: Option<EnergyAlone<T>>,
}

impl<T: Real> Vehicle<T> {
    /// (J) crush energy, uncorrected, as far as the damage is known.
    #[must_use]
    pub fn crush_energy(&self) -> Option<T> {
        let alone = self.energy.map(|energy| energy.crush_energy);
        self.damage.as_ref().map(|damage| damage.crush_energy).or(alone)
    }

    /// (J) crush energy, corrected for an oblique force; an energy that is given alone needs no correction.
    /// `None` where the force does not push on the damaged side.
    #[must_use]
    pub fn corrected_crush_energy(&self) -> Option<T> {
        let alone = self.energy.map(|energy| energy.crush_energy);
        self.damage.as_ref().map_or(alone, |damage| Some(damage.oblique?.corrected_crush_energy))
    }

    /// (m/s) energy equivalent speed of the uncorrected crush energy.
    #[must_use]
    pub fn ees(&self) -> Option<T> {
        let alone = self.energy.map(|energy| energy.ees);
        self.damage.as_ref().map(|damage| damage.ees).or(alone)
    }

    /// (m) h: distance of the force's line of action from the CG.
    #[must_use]
    pub fn moment_arm(&self) -> Option<T> {
        let alone = self.energy.map(|energy| energy.moment_arm);
        self.damage.as_ref().map(|damage| damage.moment_arm).or(alone)
    }

    /// (rad) the PDOF that CRASH3 uses: the file's, else that of the impact.
    #[must_use]
    pub fn crash3_pdof(&self) -> Option<T> {
        self.damage.as_ref().map_or(self.energy.and_then(|energy| energy.pdof), |damage| damage.pdof)
    }
}

impl Vehicle {
    /// Whether it is no fixed object.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.subject.inertia.is_some()
    }

    /// (rad) the PDOF that the file gives for this vehicle itself.
    pub(crate) fn given_pdof(&self) -> Option<f64> {
        self.subject.pdof().filter(|_| !self.subject.pdof_follows())
    }

    /// (rad) how far the direction of force may be from the middle of the hour that is given for it; 0 of an
    /// angle.
    pub(crate) fn half_hour(&self) -> f64 {
        let is_hour = self.subject.pdof_is_hour();
        if is_hour { HALF_HOUR } else { 0.0 }
    }

    /// (m/s) b_0, the highest speed that leaves no crush on the damaged width: its energy is G.
    #[must_use]
    pub fn no_damage_speed(&self) -> Option<f64> {
        let damage = self.damage.as_ref()?;
        let energy = match (&damage.structure, &self.subject.damage.as_ref()?.evidence) {
            (SideStiffness::Uniform(stiffness), _) => stiffness.g() * damage.width,
            (SideStiffness::Zones(zones), Evidence::Measured { profile, .. }) => {
                zones.iter().zip(profile.zones()).map(|(stiffness, zone)| stiffness.g() * zone.width).sum()
            }
            // The reader lets no crush without stations have zones between them.
            (SideStiffness::Zones(_), Evidence::ForceBalance { .. }) => return None,
        };
        // b₀ = √(2 G w/m)
        Some((2.0 * energy / self.subject.inertia?.mass).sqrt())
    }
}

/// Why there is no analysis.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The case lacks something or contradicts itself.
    #[error(transparent)]
    Case(#[from] Faults),
    /// No speed reconciles crush and impact.
    #[error(transparent)]
    Reconcile(#[from] ReconcileError),
    /// No speed gives the crush energy, [`ReconcileError::NotReached`].
    #[error(
        "{}",
        ReconcileError::NotReached {
            vehicle: *.vehicle,
            energy: *.energy,
            tangential_share: *.tangential_share
        }
    )]
    NotReached {
        /// Whose speed.
        vehicle: VehicleId,
        /// (J) the work sought, W_n + λ W_t.
        energy: f64,
        /// (–) λ.
        tangential_share: f64,
        /// The impact that comes nearest, or why none can happen.
        nearest: Result<Iteration, ImpactError>,
    },
    /// The impact has no answer.
    #[error(transparent)]
    Impact(#[from] ImpactError),
    /// The damage has no answer.
    #[error(transparent)]
    Crush(#[from] CrushError),
    /// Momentum does not give both speeds.
    #[error(transparent)]
    Momentum(#[from] MomentumError),
    /// A vehicle does not come to rest after the impact.
    #[error("vehicle {vehicle} does not come to rest: {reason}")]
    NoRest {
        /// Which.
        vehicle: VehicleId,
        /// Why.
        reason: NoRest,
    },
    /// No motion after the impact leads to where a vehicle was found.
    #[error("no motion after the impact brings vehicle {vehicle} to its rest: {reason}")]
    NoStart {
        /// Which.
        vehicle: VehicleId,
        /// Why.
        reason: Unreached,
    },
    /// The evidence excludes every collision.
    #[error("{0}")]
    Excluded(Box<Impossible>),
    /// The estimate has no draws.
    #[error(transparent)]
    Estimate(::estimate::Failure),
    /// The likelihood of a piece of evidence cannot be computed.
    #[error("the likelihood of `{key}` cannot be computed")]
    Unjudged {
        /// The key of the piece.
        key: String,
    },
    /// Nothing is uncertain, or the requested samples make no sense.
    #[error(transparent)]
    Ranges(#[from] ::uncertainty::InvalidRequest),
}

/// Finds the speed that makes the work of the normal impulse equal the crush energy; or both speeds, where
/// the case seeks them, from how the vehicles left the impact. Where the case has the ground and the drag for
/// it, the vehicles are followed to rest.
///
/// # Errors
/// [`Failure`].
pub fn reconstruct(case: &Case) -> Result<Analysis, Failure> {
    if case.is_by_momentum() {
        return both::reconstruct(case).map_err(|failure| failure.in_axes(case.axes));
    }
    let input = case.reconstruction()?;
    let Collision { contact, law, motions, vehicles } = input.collision;
    // The uncorrected energies do not depend on the impact; a force balance takes its directions from the
    // file.
    let crush_energy = damage::crush_energy(&damage::assess(vehicles.clone(), [None, None])?);
    let problem = Problem {
        contact,
        law,
        motions,
        unknown: input.unknown,
        crush_energy,
        basis: input.basis.energy(),
        tangential_share: input.basis.tangential_share(),
    };
    let answer = problem.solve().map_err(|refusal| refused(&problem, refusal).in_axes(case.axes))?;
    let (quadratic, affine_impact, iterations) = match &answer.method {
        SolutionMethod::ClosedForm => {
            (problem.quadratic(&answer.acting), problem.affine_impact(&answer.acting), None)
        }
        SolutionMethod::RootFinder(iterations) => (None, None, Some(iterations.as_slice().to_vec())),
    };
    let found = Found {
        unknown: input.unknown,
        speed: answer.speed,
        admissible: problem.speeds().collect(),
        crush_energy,
        normal_work: answer.normal_work,
        line: problem.line(),
        quadratic,
        affine_impact,
        iterations,
    };
    let warnings = warning::of_found(case, &found);
    let impact = Impact::new(contact, problem.law, answer.law, answer.outcome);
    let vehicles = damage::assess(vehicles, impact.pdof.map(Some))?;
    let (travel, surface) = run_out(case, impact.outcome.after)?;
    let restitution = Some(impact.law.restitution());
    let analysis = judged(case, vehicles, input.basis, restitution, (Some(found), Some(impact)), warnings)?;
    Ok(analysis.with_travel(travel, surface).beside_the_rest(case))
}

/// Why a problem has no answer, with the impact that comes nearest to one.
pub(crate) fn refused(problem: &Problem, refusal: ReconcileError) -> Failure {
    match refusal {
        ReconcileError::NotReached { vehicle, energy, tangential_share } => {
            Failure::NotReached { vehicle, energy, tangential_share, nearest: problem.nearest() }
        }
        refusal => refusal.into(),
    }
}

/// Solves the impact of a case that gives both speeds, and follows the vehicles to rest where the case has
/// the ground and the drag for it.
///
/// # Errors
/// [`Failure`].
pub fn impact(case: &Case) -> Result<Analysis, Failure> {
    let input = case.collision()?;
    let (law, outcome) =
        collide(&input.collision).map_err(|refusal| Failure::from(refusal).in_axes(case.axes))?;
    let Collision { contact, law: given_law, vehicles, .. } = input.collision;
    let impact = Impact::new(contact, given_law, law, outcome);
    let vehicles = damage::assess(vehicles, impact.pdof.map(Some))?;
    let (travel, surface) = run_out(case, impact.outcome.after)?;
    let restitution = Some(impact.law.restitution());
    let analysis = judged(case, vehicles, input.basis, restitution, (None, Some(impact)), Vec::new())?;
    Ok(analysis.with_travel(travel, surface).beside_the_rest(case))
}

/// The impact of a fully known collision, and the law at its closing speed.
fn collide<T: Real>(collision: &Collision<T>) -> Result<(Law<T>, Outcome<T>), ImpactError> {
    let law = collision.law.at(closing_speed(collision));
    collision.contact.impact(collision.motions, &law).map(|outcome| (law, outcome))
}

/// (m/s) along the normal at C, negative if the vehicles move apart.
fn closing_speed<T: Real>(collision: &Collision<T>) -> T {
    -collision.contact.approach(&collision.motions).velocity.normal
}

/// The motion after the impact alone: to rest where the case gives how a vehicle left the impact, and back
/// from the rest where it gives that.
///
/// # Errors
/// [`Failure`].
pub fn motion(case: &Case) -> Result<Analysis, Failure> {
    let input = case.motion()?;
    let mut record = Record::of(TravelOrigin::Given);
    let given =
        input.vehicles.each_ref().map(|vehicle| vehicle.as_ref().and_then(|vehicle| vehicle.velocity));
    departures(Some(&input), given, &mut record).map_err(|failure| failure.in_axes(case.axes))?;
    let travel = record.travel;
    let bare = |subject: Option<VehicleData>| Vehicle {
        subject: VehicleData { damage: None, energy: None, ..subject.unwrap_or(judgement::NOTHING) },
        damage: None,
        energy: None,
    };
    let vehicles = case.subjects().map(bare);
    Ok(unsolved(vehicles).with_travel(travel, Some(input.surface)))
}

/// The vehicles as they stand at the impact with the damage that was measured, whatever is known of their
/// speeds: what a picture of them needs.
///
/// # Errors
/// [`Failure`].
pub fn geometry(case: &Case) -> Result<Analysis, Failure> {
    let Collision { contact, mut vehicles, .. } = case.geometry()?;
    for vehicle in &mut vehicles {
        // To infer a crush takes the direction of the force, which is not known without the speeds.
        vehicle.damage =
            vehicle.damage.take().filter(|damage| matches!(damage.evidence, Evidence::Measured { .. }));
    }
    let vehicles = damage::assess(vehicles, [None, None])?;
    Ok(Analysis { geometry: Some(contact), ..unsolved(vehicles) })
}

/// Vehicles of which nothing was found.
fn unsolved(vehicles: [Vehicle; 2]) -> Analysis {
    Analysis {
        basis: Basis::default(),
        found: None,
        both: None,
        impact: None,
        geometry: None,
        travel: [None, None],
        skids: [None; 2],
        surface: None,
        vehicles,
        crash3: None,
        left_aside: Vec::new(),
        can_be_weighed: false,
        checks: Vec::new(),
        warnings: Vec::new(),
    }
}

/// The ways to rest after an impact, where the case has the ground and the drag for them.
fn run_out(case: &Case, after: [Motion; 2]) -> Result<([Option<Travel>; 2], Option<SurfaceData>), Failure> {
    let Some(input) = case.run_out() else { return Ok(([None, None], None)) };
    let input = input?;
    let mut record = Record::of(TravelOrigin::Impact);
    after_impact(&input, after, &mut record).map_err(|failure| failure.in_axes(case.axes))?;
    Ok((record.travel, Some(input.surface)))
}

/// CRASH3 alone: energies and velocity changes from the damage and the PDOF that the file gives.
///
/// # Errors
/// [`Failure`].
pub fn crush(case: &Case) -> Result<Analysis, Failure> {
    let input = case.damage()?;
    let vehicles = damage::assess(input.vehicles, [None, None])?;
    let analysis = judged(case, vehicles, input.basis, input.restitution, (None, None), Vec::new())?;
    Ok(analysis.beside_the_rest(case))
}

/// The most complete analysis that a case allows: [`reconstruct`] if it has a `[reconstruct]` table, else
/// [`impact`] if it has both speeds, else [`crush`].
///
/// # Errors
/// [`Failure`].
pub fn furthest(case: &Case) -> Result<Analysis, Failure> {
    let (_, solve) = furthest_solver(case);
    solve(case)
}

/// What solves a case: one of [`reconstruct`], [`impact`] and [`crush`].
type Solve = fn(&Case) -> Result<Analysis, Failure>;

/// The most complete purpose that the case allows, and the function that serves it.
fn furthest_solver(case: &Case) -> (Purpose, Solve) {
    match case.furthest_purpose() {
        purpose @ Purpose::Reconstruct => (purpose, reconstruct),
        purpose @ Purpose::Impact => (purpose, impact),
        _ => (Purpose::Crush, crush),
    }
}

/// CRASH3's answer, the checks and the warnings of what was found so far.
fn judged(
    case: &Case,
    vehicles: [Vehicle; 2],
    basis: Basis,
    restitution: Option<f64>,
    (found, impact): (Option<Found>, Option<Impact>),
    mut warnings: Vec<Warning>,
) -> Result<Analysis, Failure> {
    let alone = case.vehicles.iter().any(inputs::GivenVehicle::is_absent);
    let crash3 = if alone { None } else { damage::crash3(&vehicles, basis.energy(), restitution)? };
    // Of a speed that was found from the crush energy it would say nothing that the normal work equals it.
    let energy = crash3
        .as_ref()
        .filter(|_| found.is_none())
        .map(|crash3| basis.energy().dissipated(crash3.crush_energy, restitution.unwrap_or_default()));
    let checks =
        checks::checks(&vehicles, case.headings(), energy.map(|energy| (energy, basis)), impact.as_ref());
    if let Some(impact) = &impact {
        warning::of_impact(impact, &mut warnings);
    }
    warning::of_outlines(&vehicles, &mut warnings);
    let speeds = impact.as_ref().map(|impact| impact.outcome.before.map(|motion| motion.velocity.norm()));
    warning::of_case(case, &mut warnings);
    let sought = found.as_ref().map(|found| found.unknown.vehicle());
    warning::of_data(&vehicles, speeds.map_or([None; 2], |speeds| speeds.map(Some)), sought, &mut warnings);
    warning::of_assumptions(case, &vehicles, &mut warnings);
    warning::of_damage(&vehicles, &mut warnings);
    if let Some(impact) = &impact {
        warning::of_directions(impact, &vehicles, &mut warnings);
        if let Some(crash3) = &crash3 {
            warning::of_delta_v(impact, crash3, &vehicles, &mut warnings);
        }
    }
    let marks = case.skids();
    let skids = [0, 1].map(|i| travel::skid(marks[i]?, speeds?[i]));
    warning::of_checks(&checks, &vehicles, impact.as_ref(), basis, &mut warnings);
    Ok(Analysis {
        basis,
        found,
        both: None,
        impact,
        geometry: None,
        travel: [None, None],
        skids,
        surface: None,
        vehicles,
        crash3,
        left_aside: Vec::new(),
        can_be_weighed: false,
        checks,
        warnings,
    })
}
