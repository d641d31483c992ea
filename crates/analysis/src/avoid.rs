//! Whether the collision was avoidable: what the driver of one vehicle did, what another speed, reaction or
//! braking would have made of it, and how probable that is.

mod chance;
mod driven;
mod posing;
mod same_line;
mod scene;
mod sight;

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_6;
use std::ops::{ControlFlow, RangeInclusive};
use std::sync::Arc;

use ::uncertainty::normal::quantiles;
use ::uncertainty::{SamplingMethod, Settings, random};
use crash3::Side;
use inputs::{
    Along, Avoid, AvoidForm, BrakingForm, Case, ClearSpeedForm, DemandForm, Dimension, Fault, Faults, Find,
    GivenDemand, GivenVehicle, OffLine, Quantity, SightForm, SpeedForm, Velocity, choices, format_number,
    is_of_avoid,
};
use pim_core::VehicleId;
use reconcile::COLLINEAR;
use recorder::ImpactSpeed;
use time_distance::Response;

pub use chance::{AvoidChance, AvoidInfluence, AvoidInterval, SightIntervals};
use chance::{Speeds, chance};
pub use driven::{BRAKES, GIVES_WAY};
use posing::{SoughtSpeeds, Unposed};
pub use same_line::{Meeting, SameLine};
pub use scene::{ActualRun, AvoidCourse, AvoidScene, Clears, DrivenBy, Sight, Unbraked, View};
pub use sight::{Hiding, SIGHT_LOOK_BACK};
use sight::{Outlines, Ways};

use crate::analysis::Analysis;
use crate::beside::{SAMPLES, is_estimated_beside, usual_samples};
use crate::columns::Number;
use crate::commands::{reconstruct, uncertainty_of};
use crate::estimate::{
    EstimatePlan, EstimateStage, Estimated, EstimatedOutput, NoEstimate, PieceDetail, PieceFound, estimate,
    estimate_evidence,
};
use crate::failure::Failure;
use crate::given::GivenSpeed;
use crate::output::Output;
use crate::phases::speed_at_impact;
use crate::quantities::{DELTA_V, SPEED};
use crate::recorded::{RecordsOfImpact, with_records_of_impact};
use crate::seen::SeenWarning;
use crate::solve;
use crate::thresholds::RECORDER_SPEED_ERROR;
use crate::uncertainty::{Plan, Stage, UncertainInput, any_inputs};
use crate::warning::{self, Warning};

/// How to ask whether a collision was avoidable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AvoidPlan {
    /// Number of samples, if ranges make the answer uncertain.
    pub samples: usize,
    /// The random seed: the same seed gives the same results.
    pub seed: u64,
    /// Whether the exact solution gives an unknown speed, even if there is more evidence.
    pub exact: bool,
}

impl AvoidPlan {
    /// Default number of samples.
    pub const SAMPLES: usize = SAMPLES;
}

impl Default for AvoidPlan {
    fn default() -> Self {
        Self { samples: Self::SAMPLES, seed: 1, exact: false }
    }
}

/// The stage that [`avoid`] has reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AvoidStage {
    /// All evidence of the speed.
    Estimate(EstimateStage),
    /// The samples of the speed.
    Samples(Stage),
}

/// Whether a collision was avoidable.
#[derive(Clone, Debug)]
pub struct Avoidance {
    /// The vehicle whose driver is judged.
    pub vehicle: VehicleId,
    /// Where its speed comes from.
    pub speed_from: SpeedSource,
    /// The scene, at the central values.
    pub scene: AvoidScene,
    /// The actual run first, then the others.
    pub runs: Vec<AvoidRun>,
    /// The limit with one of the other two, if these can differ: the rest of all combinations.
    pub more_runs: Vec<AvoidRun>,
    /// What would have been enough.
    pub enough: Enough,
    /// How the other party was hidden, if it was.
    pub hiding: Option<Hiding>,
    /// The paths of both in the scene, if the case gives them.
    ways: Option<Ways>,
    /// How probable it is; `None` if nothing is uncertain.
    pub chance: Option<AvoidChance>,
    /// Why the evidence for the speed gives no answer, and so no probability.
    pub speed_doubt: Option<NoEstimate>,
    /// The warnings of the solution that gives the speed; without one, the objections to the marks.
    pub speed_warnings: Vec<SeenWarning>,
    /// How far from one line both vehicles moved, if so little that the place of the impact is not fixed
    /// although it is taken so, or so much that the motion along one line is an approximation.
    pub nearly_along: Option<OffLine>,
    /// (m/s) contradictory speeds of the other vehicle at the impact: by the demand, and by the rest of the
    /// case.
    pub other_speeds: Option<[f64; 2]>,
    /// (m/s) contradictory speeds of the vehicle at the impact: by the answer, and by its own recorder.
    pub own_speeds: Option<[f64; 2]>,
    /// Whether the phases of the other vehicle, or its way in the demand, lead it to the impact moving.
    other_came: bool,
    /// The speed by the rest of the case, if `[avoid]` has none.
    told: Option<Arc<Told>>,
}

choices! {
    /// Where the speed of the vehicle comes from.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SpeedSource {
        /// `speed` of `[avoid]`.
        AtDemand = "avoid",
        /// `speed` of the vehicle.
        AtImpact = "vehicle",
        /// The exact solution of the collision.
        Reconstructed = "reconstruct",
        /// The median by all evidence.
        Estimated = "estimate",
        /// The phases before the impact, which begin with a known speed.
        Phases = "phases",
        /// The table of its recorder alone.
        Recorder = "recorder",
    }
}

/// A question of what would have been.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hypothesis {
    /// What happened.
    Actual,
    /// The speed lowered to the limit, and all else as it was.
    LimitOnly,
    /// At the speed driven, the reaction in time, and the braking as it was.
    ReactionInTime,
    /// At the speed driven, the reaction as it was, and the braking full.
    FullBraking,
    /// At the speed driven, the reaction in time and the braking full.
    ReactionAndBraking,
    /// At the limit, the reaction in time, and the braking as it was.
    LimitAndReaction,
    /// At the limit, the reaction as it was, and the braking full.
    LimitAndBraking,
    /// At the limit, the reaction in time and the braking full.
    All,
}

/// A run up to the place of the impact.
#[derive(Clone, Debug)]
pub struct AvoidRun {
    /// What it supposes.
    pub hypothesis: Hypothesis,
    /// How the vehicle moves.
    pub course: AvoidCourse,
    /// (m/s) speed where it meets the other party: at the place of the impact, or where a vehicle on the same
    /// line then is. 0 if it does not.
    pub collision_speed: f64,
    /// (s) when it does so, after the demand; `None` if it stops before or never reaches it.
    pub arrival: Option<f64>,
    /// (m) how near it comes to a vehicle on the same line that it does not reach.
    pub gap: Option<f64>,
    /// Whether it arrives after the other party has left the danger zone; `None` without that question.
    pub is_late_enough: Option<bool>,
    /// (m/s) ΔV of both vehicles from an impact with that speed; `None` without an impact in the case.
    pub delta_v: Option<[f64; 2]>,
}

impl AvoidRun {
    /// Whether it stops before the place of the impact, or does not reach a vehicle on the same line.
    #[must_use]
    pub fn stops_before(&self) -> bool {
        self.arrival.is_none()
    }

    /// Whether there is no collision.
    #[must_use]
    pub fn is_avoided(&self) -> bool {
        self.stops_before() || self.is_late_enough == Some(true)
    }
}

/// What would have been enough to avoid the collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enough {
    /// (m/s) the speed.
    pub speed: f64,
    /// (m/s²) at the speed driven and with the reaction time of `[avoid]`, the deceleration; zero if the
    /// vehicle arrives late enough without braking, `None` if none is enough.
    pub deceleration: Option<f64>,
    /// (s) at the speed driven and with the deceleration of `[avoid]`, the longest reaction time; `None` if
    /// none is.
    pub reaction: Option<f64>,
    /// (m/s²) the deceleration at the limit, likewise.
    pub deceleration_at_limit: Option<f64>,
    /// (s) the longest reaction time at the limit, likewise.
    pub reaction_at_limit: Option<f64>,
}

impl Avoidance {
    /// The other vehicle, if it moves along the line of the judged one.
    #[must_use]
    pub fn on_line(&self) -> Option<VehicleId> {
        self.scene.same_line.as_ref().map(|_| self.vehicle.other())
    }

    /// The run of a hypothesis; `None` if it is one of the others.
    #[must_use]
    pub fn run(&self, hypothesis: Hypothesis) -> Option<&AvoidRun> {
        self.runs.iter().chain(&self.more_runs).find(|run| run.hypothesis == hypothesis)
    }

    /// The run at the limit, with the reaction and the braking of `[avoid]`: of a vehicle that was not faster
    /// than the limit, at the speed driven.
    #[must_use]
    pub fn run_at_limit(&self) -> Option<&AvoidRun> {
        let likest = [Hypothesis::All, Hypothesis::ReactionAndBraking, Hypothesis::Actual];
        likest.into_iter().find_map(|hypothesis| self.run(hypothesis))
    }

    /// The pieces of evidence behind the speed, if all of it was weighed.
    #[must_use]
    pub fn pieces(&self) -> &[PieceFound] {
        let estimated = self.told.as_ref().and_then(|told| told.estimated.as_ref());
        estimated.map_or(&[], |estimated| &estimated.pieces)
    }

    /// (m/s) its speed at the impact by the exact solution that is the headline of `reconstruct`, if the
    /// answer takes the median of all evidence, which shows how certain it is.
    #[must_use]
    pub fn exact_speed(&self) -> Option<f64> {
        self.told.as_ref()?.exact
    }

    /// The speed of the vehicle at the impact by all evidence, if that does not determine it.
    #[must_use]
    pub fn undetermined(&self) -> Option<&EstimatedOutput> {
        let told = self.told.as_ref().filter(|told| told.from == SpeedSource::Estimated)?;
        let speed = told.estimated.as_ref()?.output(SPEED.of_vehicle(self.vehicle))?;
        (!speed.is_told()).then_some(speed)
    }

    /// (–) probability that the vehicle was stationary at the impact, if its speed is the median of the
    /// evidence, which leaves that open: the central values are then those of a vehicle that moved.
    #[must_use]
    pub fn may_have_stood(&self) -> Option<f64> {
        let told = self.told.as_ref().filter(|told| told.from == SpeedSource::Estimated)?;
        may_have_stood(told.estimated.as_ref()?, self.vehicle)
    }

    /// (–) the same of the other vehicle, if its motion counts.
    #[must_use]
    pub fn other_may_have_stood(&self) -> Option<f64> {
        let stood = may_have_stood(self.told.as_ref()?.estimated.as_ref()?, self.vehicle.other());
        let counts = self.scene.clears.is_some() || self.scene.same_line.is_some() || self.hiding.is_some();
        stood.filter(|_| counts && !self.other_came)
    }

    /// (m) where the driver's eye and the visible point of the other party were on the actual run, at a time
    /// (s) before the impact, in the coordinates of the scene; `None` if the case does not say how both
    /// approached.
    #[must_use]
    pub fn eye_and_point(&self, time: f64) -> Option<[[f64; 2]; 2]> {
        let ways = self.ways.as_ref()?;
        Some(ways.of_scene(&self.scene, time).map(|at| [at.x, at.y]))
    }

    /// The answer for a case that differs only in the numbers of `[avoid]`: the speed by the rest of the case
    /// is not solved again. Without a plan, nothing is sampled, and it has no probability.
    ///
    /// # Errors
    /// Those of [`avoid`].
    pub fn again(&self, case: &Case, plan: Option<&AvoidPlan>) -> Result<Self, Failure> {
        let given = with_records_of_impact(case);
        found(&given, &given.case.avoidance()?, self.told.clone(), plan)
    }
}

/// Whether the collision was avoidable, at the central values and so without a probability; `None` if the
/// speed must be solved for, which is slow.
///
/// # Errors
/// [`Failure`] if the case lacks something or contradicts itself.
pub fn avoid_at_once(case: &Case) -> Result<Option<Avoidance>, Failure> {
    let given = with_records_of_impact(case);
    let form = given.case.avoidance()?;
    match form.speed {
        SpeedForm::Sought => Told::can_be(&given.case, form.vehicle).map(|()| None),
        SpeedForm::AtDemand(_) | SpeedForm::AtImpact(_) | SpeedForm::ByPhases => {
            found(&given, &form, None, None).map(Some)
        }
    }
}

/// Whether the collision of a case was avoidable.
///
/// # Errors
/// [`Failure`] if the case lacks something or contradicts itself, or if its unknown speed cannot be found.
pub fn avoid(
    case: &Case,
    plan: &AvoidPlan,
    progress: &mut (dyn FnMut(AvoidStage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Avoidance, Failure> {
    // Of several records of a recorder, that of this impact shows how the vehicle approached.
    let given = with_records_of_impact(case);
    let form = given.case.avoidance()?;
    let told = match form.speed {
        SpeedForm::Sought => Some(Arc::new(Told::of(&given.case, form.vehicle, plan, progress)?)),
        SpeedForm::AtDemand(_) | SpeedForm::AtImpact(_) | SpeedForm::ByPhases => None,
    };
    found(&given, &form, told, Some(plan))
}

/// The answer, once the speed is known. Without a plan, nothing is sampled.
fn found(
    given: &RecordsOfImpact<'_>,
    form: &AvoidForm,
    told: Option<Arc<Told>>,
    plan: Option<&AvoidPlan>,
) -> Result<Avoidance, Failure> {
    let case = &*given.case;
    let speed_from = match (&form.speed, &told) {
        (SpeedForm::AtDemand(_), _) => SpeedSource::AtDemand,
        (SpeedForm::ByPhases, _) => SpeedSource::Phases,
        (_, None) => SpeedSource::AtImpact,
        (_, Some(told)) => told.from,
    };
    let other = told.as_ref().and_then(|told| told.other);
    // If nothing else gives the speed of the other vehicle, its own recorder does.
    let lacks_other = form.lacks_other_speed() && other.is_none();
    let by_recorder = if lacks_other { RecordedSpeed::of(case, form.vehicle.other()) } else { None };
    let other = other.or_else(|| Some(by_recorder.as_ref()?.quantile(0.5)));
    let sought = SoughtSpeeds { subject: told.as_ref().map(|told| told.speed), other };
    let needs_other = form.clear.as_ref().is_some_and(|clear| matches!(clear.speed, ClearSpeedForm::Sought));
    if needs_other && sought.other.is_some_and(|speed| speed <= 0.0) {
        return Err(unposed(form, Unposed::OtherStands));
    }
    let hidden_by = case.avoid.iter().flat_map(|avoid| &avoid.obstacles);
    let outlines: Vec<_> = hidden_by.map(sight::corners).collect();
    let obstacles: Vec<&[_]> = outlines.iter().map(Vec::as_slice).collect();
    let ways_of = |sight: &SightForm| Ways::of(sight, sought.other, form);
    let ways = form.sight.as_ref().map(ways_of).transpose().map_err(|refusal| unposed(form, refusal))?;
    if let Some(index) = ways.as_ref().and_then(|ways| ways.hides_the_impact(&obstacles)) {
        let what = "lies on the place of the impact, or between the driver's eye and the other party there";
        return Err(of_obstacle(index, format!("{} {what}", obstacle_name(case, index))));
    }
    let scene = sight::pose(form, sought, &obstacles).map_err(|refusal| unposed(form, refusal))?;
    if is_hit_from_behind(case, form.vehicle, sought.other, scene.at_impact) {
        return Err(unposed(form, Unposed::FromBehind));
    }
    let seen = ways.as_ref().zip(scene.view.sight());
    let hiding = seen.map(|(ways, sight)| ways.hiding(&scene, &sight, &obstacles));
    let holds_the_eye = |index| {
        let name = obstacle_name(case, index);
        let what = "the path of the driver's eye to the impact runs through";
        of_obstacle(index, format!("{what} {name}, which would hide everything"))
    };
    let hiding = hiding.transpose().map_err(holds_the_eye)?;
    let of_plan = |plan| of_ranges(case, told.as_deref(), by_recorder.as_ref(), &obstacles, plan);
    let chance = plan.map_or(Ok(None), of_plan)?;
    let [mut runs, mut more_runs] = runs(&scene, &|meeting| delta_v(case, form.vehicle, meeting, other));
    if let Some(told) = &told {
        // The first run is what happened.
        let shares = told.shares_of(runs[0].delta_v);
        for delta_v in runs.iter_mut().chain(&mut more_runs).filter_map(|run| run.delta_v.as_mut()) {
            *delta_v = [delta_v[0] * shares[0], delta_v[1] * shares[1]];
        }
    }
    let enough = Enough {
        speed: scene.just_avoiding(),
        deceleration: scene.least_deceleration(false),
        reaction: scene.longest_reaction(false),
        deceleration_at_limit: scene.least_deceleration(true),
        reaction_at_limit: scene.longest_reaction(true),
    };
    let speed_doubt = told.as_ref().and_then(|told| told.doubt());
    let mut speed_warnings = match &told {
        Some(told) => told.warnings.clone(),
        None => {
            let mut of_marks = Vec::new();
            warning::of_grade(case, form.vehicle, &mut of_marks);
            of_marks
        }
    };
    speed_warnings.extend(given.uncertain.iter().copied().map(Warning::from));
    let speed_warnings = speed_warnings.iter().map(|warning| warning.seen(case.axes)).collect();
    let is_near = |off: &OffLine| match &scene.same_line {
        Some(_) => off.angle > ALONG,
        None => off.angle <= NEARLY_ALONG && !stands(case, form, other),
    };
    let nearly_along = case.off_the_line().filter(is_near);
    let other_speeds = other_speeds(case, form, scene.same_line.as_ref(), other);
    let is_given = matches!(speed_from, SpeedSource::AtDemand | SpeedSource::AtImpact | SpeedSource::Phases);
    let own_recorder = if is_given { RecordedSpeed::of(case, form.vehicle) } else { None };
    let own_speeds = own_recorder.and_then(|recorded| recorded.against(scene.at_impact));
    let vehicle = form.vehicle;
    let by_phases = speed_at_impact(&case.vehicles[vehicle.other().index()]);
    let other_came =
        by_phases.is_some_and(|speed| speed > 0.0) || matches!(form.demand, DemandForm::Other(_));
    // Without obstacles, only the plan needs the paths.
    let ways = ways.or_else(|| ways_of(&case.avoid_plan()?).ok());
    Ok(Avoidance {
        vehicle,
        speed_from,
        scene,
        runs,
        more_runs,
        enough,
        hiding,
        ways,
        chance,
        speed_doubt,
        speed_warnings,
        nearly_along,
        other_speeds,
        own_speeds,
        other_came,
        told,
    })
}

/// The speed at the impact by the rest of the case.
#[derive(Debug)]
struct Told {
    from: SpeedSource,
    /// (m/s) of the vehicle.
    speed: f64,
    /// (m/s) of the other one, if that is found too.
    other: Option<f64>,
    /// (m/s) that of the vehicle by the exact solution, if it would be the headline and `speed` is the median
    /// of all evidence.
    exact: Option<f64>,
    estimated: Option<Box<Estimated>>,
    /// What that solution warns of.
    warnings: Vec<Warning>,
    /// (m/s) samples of both speeds by the ranges of the case, that of the vehicle first.
    sampled: Option<[Vec<f64>; 2]>,
}

impl Told {
    fn of(
        case: &Case,
        vehicle: VehicleId,
        plan: &AvoidPlan,
        progress: &mut (dyn FnMut(AvoidStage, usize, usize) -> ControlFlow<()> + Send),
    ) -> Result<Self, Failure> {
        let alone = &*case.without_avoid();
        let exact = if alone.reconstruct.is_some() { Some(reconstruct(alone)) } else { None };
        let leads = |exact: &Analysis| plan.exact || exact.why_not_exact().is_none();
        let exact = match exact {
            Some(Ok(exact)) if leads(&exact) => Some(exact),
            Some(Err(failure)) if plan.exact => return Err(failure),
            _ => None,
        };
        let mut estimated = None;
        let mut refusal = None;
        if !plan.exact && (exact.is_none() || is_estimated_beside(alone)) {
            let how = EstimatePlan {
                particles: EstimatePlan::PARTICLES,
                seed: plan.seed,
                prior: None,
                pieces: PieceDetail::Compared,
            };
            let at = &mut |stage, done, total| progress(AvoidStage::Estimate(stage), done, total);
            match estimate(alone, &how, at) {
                Ok(found) => estimated = Some(Box::new(found)),
                Err(failure) => refusal = Some(failure),
            }
        }
        let output = |of: VehicleId| -> Option<f64> {
            Some(estimated.as_ref()?.output(SPEED.of_vehicle(of))?.posterior.median.value)
        };
        // Its speed and its probability are of one distribution.
        let is_weighed = estimated.as_ref().is_some_and(|estimated| estimated.no_answer().is_none());
        let leading = exact.as_ref().map(|exact| exact.speed(vehicle));
        if let Some(exact) = exact.filter(|_| !is_weighed) {
            let speed = exact.speed(vehicle);
            let seeks_both = alone.reconstruct.is_some_and(|reconstruct| reconstruct.find == Find::Both);
            let other = seeks_both.then(|| exact.speed(vehicle.other()));
            let sampled = if estimated.is_none() { sampled(alone, vehicle, plan, progress)? } else { None };
            let warnings = exact.warnings;
            return Ok(Self {
                other,
                estimated,
                warnings,
                sampled,
                ..Self::at(SpeedSource::Reconstructed, speed)
            });
        }
        let moving = |of: VehicleId| {
            let moved = estimated.as_deref().and_then(|estimated| median_if_it_moved(estimated, of));
            moved.or_else(|| output(of))
        };
        if let Some(speed) = moving(vehicle) {
            let other = moving(vehicle.other());
            let warnings = estimated.as_ref().map_or_else(Vec::new, |estimated| estimated.warnings.clone());
            let exact = leading;
            return Ok(Self { other, exact, estimated, warnings, ..Self::at(SpeedSource::Estimated, speed) });
        }
        match (Self::of_recorder(alone, vehicle, plan), refusal) {
            (Some(told), _) => Ok(told),
            (None, Some(failure)) if alone.reconstruct.is_some() || alone.impact.is_some() => Err(failure),
            (None, _) if plan.exact => Err(no_exact_speed(vehicle).into()),
            (None, _) => Err(no_speed(vehicle).into()),
        }
    }

    /// Whether the rest of the case has what a speed needs, as far as that shows before solving.
    fn can_be(case: &Case, vehicle: VehicleId) -> Result<(), Failure> {
        let alone = &*case.without_avoid();
        let is_posed = match alone.reconstruct {
            Some(_) if alone.is_by_momentum() => alone.two_speeds().is_ok(),
            Some(_) => alone.reconstruction().is_ok(),
            None => false,
        };
        if is_posed || speed_by_recorder_alone(alone, vehicle).is_some() {
            return Ok(());
        }
        match estimate_evidence(alone) {
            Err(Failure::Case(faults)) if alone.reconstruct.is_some() || alone.impact.is_some() => {
                Err(Failure::Case(faults))
            }
            Err(Failure::Case(_)) => Err(no_speed(vehicle).into()),
            // Other faults are only found when it is solved.
            _ => Ok(()),
        }
    }

    /// By the table of its recorder alone.
    fn of_recorder(case: &Case, vehicle: VehicleId, plan: &AvoidPlan) -> Option<Self> {
        let found = speed_by_recorder_alone(case, vehicle)?;
        let key = random::key(plan.seed, &[OF_RECORDER]);
        let draw = |index: usize| found.quantile(at_random(key, index));
        let sampled = Some([(0..plan.samples).map(draw).collect(), Vec::new()]);
        Some(Self { sampled, ..Self::at(SpeedSource::Recorder, found.quantile(0.5)) })
    }

    /// A speed (m/s) about which nothing else is known.
    fn at(from: SpeedSource, speed: f64) -> Self {
        let (other, exact, estimated, warnings, sampled) = (None, None, None, Vec::new(), None);
        Self { from, speed, other, exact, estimated, warnings, sampled }
    }

    fn doubt(&self) -> Option<NoEstimate> {
        self.estimated.as_ref()?.no_answer()
    }

    /// (–) ΔV of each vehicle by all evidence, as a multiple of that (m/s) of what happened, solved again
    /// with the central values of everything else.
    fn shares_of(&self, solved: Option<[f64; 2]>) -> [f64; 2] {
        VehicleId::ALL.map(|id| {
            let solved = solved.map(|solved| solved[id.index()]).filter(|solved| *solved > 0.0);
            let weighed = self.estimated.as_ref().filter(|_| self.from == SpeedSource::Estimated);
            let weighed = weighed.and_then(|weighed| weighed.output(DELTA_V.of_vehicle(id)));
            solved.zip(weighed).map_or(1.0, |(solved, weighed)| weighed.posterior.median.value / solved)
        })
    }
}

/// The speed of a vehicle at the impact by its own recorder.
enum RecordedSpeed {
    /// (m/s) as stored, and the standard deviation of that.
    Stored { speed: f64, sd: f64 },
    /// By its table.
    Table(ImpactSpeed),
}

impl RecordedSpeed {
    fn of(case: &Case, vehicle: VehicleId) -> Option<Self> {
        let recorder = case.vehicles[vehicle.index()].recorder.as_ref()?;
        let told = recorder.tells_speed(case.ground_friction())?;
        if told.is_of_table {
            return speed_by_recorder(case, vehicle).map(Self::Table);
        }
        let speed = told.speed;
        Some(Self::Stored { speed, sd: speed * told.error.unwrap_or(RECORDER_SPEED_ERROR) })
    }

    /// (m/s) the speed of an answer and the recorded one, if they contradict each other.
    fn against(&self, speed: f64) -> Option<[f64; 2]> {
        let [least, most] = [1.0 - SURELY, SURELY].map(|probability| self.quantile(probability));
        let apart = (least - speed).max(speed - most);
        (apart > NEGLIGIBLE).then(|| [speed, self.quantile(0.5)])
    }

    fn quantile(&self, probability: f64) -> f64 {
        match self {
            Self::Stored { speed, sd } => {
                let mut quantile = [probability];
                quantiles(&mut quantile);
                speed + sd * quantile[0]
            }
            Self::Table(speed) => speed.quantile(probability),
        }
    }
}

/// The speed at the impact by the table of a vehicle's own recorder.
fn speed_by_recorder(case: &Case, vehicle: VehicleId) -> Option<ImpactSpeed> {
    case.vehicles[vehicle.index()].recorder.as_ref()?.impact_speed(case.ground_friction())
}

/// The same if the case has no impact, whose evidence would give it better.
fn speed_by_recorder_alone(case: &Case, vehicle: VehicleId) -> Option<ImpactSpeed> {
    let is_alone = case.impact.is_none() && case.reconstruct.is_none();
    if is_alone { speed_by_recorder(case, vehicle) } else { None }
}

/// A probability drawn for a sample.
fn at_random(key: u64, index: usize) -> f64 {
    random::unit(random::bits(key, index as u64))
}

/// The purposes of the random numbers that draw a recorder's speed.
const OF_RECORDER: u64 = 0x0072_6563_6f72;
const OF_OTHER_RECORDER: u64 = 0x6f72_6563_6f72;

/// The speeds of a vehicle and of the other by the ranges of the case; `None` if nothing is uncertain.
fn sampled(
    case: &Case,
    vehicle: VehicleId,
    plan: &AvoidPlan,
    progress: &mut (dyn FnMut(AvoidStage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Option<[Vec<f64>; 2]>, Failure> {
    if !crate::uncertainty::is_uncertain(case) {
        return Ok(None);
    }
    let samples = plan.samples.min(usual_samples(case));
    let settings = Settings::new(SamplingMethod::MonteCarlo, samples, plan.seed);
    let of = [vehicle, vehicle.other()].map(|vehicle| SPEED.of_vehicle(vehicle).path());
    let wanted = |output: Output| of.contains(&output.path());
    let at = &mut |stage, done, total| progress(AvoidStage::Samples(stage), done, total);
    let found = uncertainty_of(case, &Plan { settings, index_rows: None }, &wanted, at)?;
    let reasons = found.propagation.reasons();
    let column = |path: String| -> Vec<f64> {
        let place = found.outputs.iter().position(|output| output.output.path() == path);
        let column = place.and_then(|place| found.propagation.columns().get(place));
        let known = column.map(Vec::as_slice).unwrap_or_default().iter().zip(reasons);
        known.map(|(speed, reason)| if *reason == 0 { *speed } else { f64::NAN }).collect()
    };
    Ok(Some(of.map(column)))
}

/// The probability that the ranges of `[avoid]` and the evidence of the speed make; `None` if nothing is
/// uncertain.
fn of_ranges(
    case: &Case,
    told: Option<&Told>,
    other: Option<&RecordedSpeed>,
    obstacles: Outlines<'_>,
    plan: &AvoidPlan,
) -> Result<Option<AvoidChance>, Failure> {
    let is_ours = |key: &String| is_of_avoid(key);
    if case.uncertainty.shared.iter().any(|error| error.of.iter().any(is_ours)) {
        let reason = "a number of [avoid] cannot share an error with others";
        let fault = Fault::refused("uncertainty.shared", reason, "give each a range of its own");
        return Err(Faults::from(fault).into());
    }
    let inputs = any_inputs(case)?;
    let mut uncertain = inputs.iter().map(|input| input.place).enumerate().peekable();
    let mut place = 0;
    let numbers = case.map_numbers(|number| {
        let input = uncertain.next_if(|(_, of)| *of == place).map(|(input, _)| input);
        place += 1;
        input.map_or(Number::Known(number), Number::Uncertain)
    });
    let Some(form) = numbers.avoid_form(&case.avoid_basis()) else { return Ok(None) };
    let mut used = BTreeSet::new();
    form.map(|number| {
        if let Number::Uncertain(input) = number {
            used.insert(input);
        }
    });
    let used: Vec<usize> = used.into_iter().collect();
    let form = form.map(|number| match number {
        Number::Uncertain(input) => used.binary_search(&input).map_or(number, Number::Uncertain),
        known @ Number::Known(_) => known,
    });
    let inputs: Vec<UncertainInput> = used.iter().filter_map(|input| inputs.get(*input)).cloned().collect();
    let estimated = told.and_then(|told| told.estimated.as_deref());
    if told.is_some_and(|told| told.doubt().is_some()) {
        return Ok(None);
    }
    let subject = case.avoid_subject();
    let draws_of = |of: VehicleId| estimated.and_then(|estimated| estimated.draws(SPEED.of_vehicle(of)));
    let draws = draws_of(subject).map(|own| [own, draws_of(subject.other()).unwrap_or_default()]);
    let sampled = told.and_then(|told| told.sampled.as_ref()).map(|both| both.each_ref().map(Vec::as_slice));
    let constant: [Vec<f64>; 2];
    let speeds = match (draws.or(sampled), told) {
        (Some(both), _) => Some(both),
        (None, Some(told)) if !inputs.is_empty() => {
            constant = [Some(told.speed), told.other]
                .map(|speed| speed.map_or_else(Vec::new, |speed| vec![speed; plan.samples]));
            Some(constant.each_ref().map(Vec::as_slice))
        }
        (None, _) => None,
    };
    if inputs.is_empty() && speeds.is_none() && !form.is_recorded() && other.is_none() {
        return Ok(None);
    }
    let speeds = speeds.map(|[speeds, other]| Speeds { speeds, other, estimated: draws.and(estimated) });
    let key = random::key(plan.seed, &[OF_OTHER_RECORDER]);
    let drawn = |index: usize| Some(other?.quantile(at_random(key, index)));
    chance(&form, &inputs, speeds.as_ref(), &drawn, obstacles, [plan.samples as u64, plan.seed])
}

/// The actual run, those of the hypotheses that differ from it, and the rest of all combinations.
fn runs(scene: &AvoidScene, delta_v: &dyn Fn(Option<Meeting>) -> Option<[f64; 2]>) -> [Vec<AvoidRun>; 2] {
    let AvoidScene { speed, response, .. } = *scene;
    let actual = scene.course();
    let run = |hypothesis, course: AvoidCourse| {
        let is_actual = hypothesis == Hypothesis::Actual;
        let meeting = if is_actual {
            let other = scene.same_line.as_ref().map(|line| line.speed);
            Some(Meeting { time: scene.time, speed: scene.at_impact, other })
        } else {
            scene.meeting(&course).filter(|meeting| !scene.is_end(meeting))
        };
        let clears = scene.cleared().filter(|_| !is_actual);
        let is_late_enough =
            clears.map(|clears| meeting.is_none_or(|meeting| meeting.time >= clears * (1.0 - ROUNDING)));
        AvoidRun {
            hypothesis,
            collision_speed: meeting.map_or(0.0, |meeting| meeting.speed),
            arrival: meeting.map(|meeting| meeting.time),
            gap: if meeting.is_none() { scene.least_gap(&course) } else { None },
            is_late_enough,
            delta_v: delta_v(meeting),
            course,
        }
    };
    let with = |speed: f64, response: Response| scene.with_response(speed, response);
    let (limit, above) = (scene.limit, scene.is_above_limit());
    let mut runs = vec![run(Hypothesis::Actual, actual)];
    let mut more = Vec::new();
    match scene.actual {
        ActualRun::Responded => {}
        ActualRun::Unbraked(_) | ActualRun::Driven(_) => {
            if above {
                runs.push(run(Hypothesis::LimitOnly, scene.at_limit_else_as_it_was()));
            }
            runs.push(run(Hypothesis::ReactionAndBraking, with(speed, response)));
        }
        ActualRun::Skidded(slowed) => {
            let in_time = slowed.with_reaction(response.reaction());
            let full = response.with_reaction(slowed.reaction());
            if above {
                runs.push(run(Hypothesis::LimitOnly, with(limit, slowed)));
                more.push(run(Hypothesis::LimitAndReaction, with(limit, in_time)));
                more.push(run(Hypothesis::LimitAndBraking, with(limit, full)));
            }
            runs.push(run(Hypothesis::ReactionInTime, with(speed, in_time)));
            runs.push(run(Hypothesis::FullBraking, with(speed, full)));
            runs.push(run(Hypothesis::ReactionAndBraking, with(speed, response)));
        }
    }
    if above {
        runs.push(run(Hypothesis::All, scene.at_limit()));
    }
    [runs, more]
}

/// (–) rounding of a time that is equal to another.
const ROUNDING: f64 = 1e-12;

/// Whether the other vehicle was stationary, or there is none.
fn stands(case: &Case, form: &AvoidForm, speed: Option<f64>) -> bool {
    let id = form.vehicle.other();
    let other = &case.vehicles[id.index()];
    let speed = speed.or_else(|| Some(GivenSpeed::of_known(case, id)?.speed));
    other.fixed || other.is_absent() || speed.is_some_and(|speed| speed <= 0.0)
}

/// Whether the other vehicle ran into the rear of this one, which has this speed at the impact (m/s): they
/// move in nearly the same direction, touch behind the centre of gravity of this one and in front of that of
/// the other, and the other was not slower, as far as is known.
fn is_hit_from_behind(case: &Case, vehicle: VehicleId, other: Option<f64>, speed: f64) -> bool {
    let is_along =
        case.off_the_line().is_some_and(|off| off.along == Along::Ahead && off.angle <= NEARLY_ALONG);
    let ahead = [vehicle, vehicle.other()].map(|id| touches_ahead(&case.vehicles[id.index()]));
    let other = other.or_else(|| Some(GivenSpeed::of_known(case, vehicle.other())?.speed));
    is_along && ahead == [Some(false), Some(true)] && other.is_none_or(|other| other > speed)
}

/// Whether a vehicle touches the other in front of its centre of gravity: by its contact point or, without
/// one, by the damaged side.
fn touches_ahead(vehicle: &GivenVehicle) -> Option<bool> {
    if let Some(contact) = &vehicle.contact {
        return Some(contact.xy()[0] > 0.0);
    }
    match vehicle.damaged_side()? {
        Side::Front => Some(true),
        Side::Rear => Some(false),
        Side::Left | Side::Right => None,
    }
}

/// (rad) 30°. Vehicles whose lines enclose no more move along with each other, or towards each other, rather
/// than across: half of that is lost, sin 30°, at most.
pub const NEARLY_ALONG: f64 = FRAC_PI_6;

/// (rad) 5°. If the lines of both enclose more, but count as one, the answer says so.
const ALONG: f64 = 0.5 * COLLINEAR;

/// Speeds at the impact that differ by this share of the greater one contradict each other, because few
/// ranges are wider.
const CONTRADICTS: f64 = 0.25;

/// (–) probability that a vehicle was stationary, if the evidence leaves that open.
fn may_have_stood(estimated: &Estimated, vehicle: VehicleId) -> Option<f64> {
    let stood = estimated.stood[vehicle.index()]?.after.value;
    OPEN.contains(&stood).then_some(stood)
}

/// (m/s) the median speed of a vehicle if it moved, where the evidence leaves open whether it did: the median
/// of all draws may fit neither case.
fn median_if_it_moved(estimated: &Estimated, vehicle: VehicleId) -> Option<f64> {
    let draws =
        may_have_stood(estimated, vehicle).and_then(|_| estimated.draws(SPEED.of_vehicle(vehicle)))?;
    let moving: Vec<f64> = draws.iter().copied().filter(|speed| *speed > 0.0).collect();
    (!moving.is_empty()).then(|| AvoidInterval::of(moving).median)
}

/// (–) probabilities that leave open whether a vehicle was stationary.
const OPEN: RangeInclusive<f64> = 0.05..=0.95;

/// (–) probability with which a recorded speed is below its upper bound, and above the lower one: three
/// standard deviations.
const SURELY: f64 = 0.998_65;

/// (m/s) 5 km/h: less than anybody measures.
const NEGLIGIBLE: f64 = 5.0 / 3.6;

/// (m/s) the speeds of the other vehicle at the impact by the demand and by the rest of the case, if they
/// contradict each other.
fn other_speeds(
    case: &Case,
    form: &AvoidForm,
    line: Option<&SameLine>,
    told: Option<f64>,
) -> Option<[f64; 2]> {
    let DemandForm::Other(demand) = &form.demand else { return None };
    let known = || Some(GivenSpeed::of_known(case, form.vehicle.other())?.speed);
    let known = line.map(|line| line.speed).or(told).or_else(known)?.abs();
    let by_demand = demand.advance().speed_after(demand.distance.si()).ok()?;
    let apart = (by_demand - known).abs();
    (apart > NEGLIGIBLE.max(CONTRADICTS * by_demand.max(known))).then_some([by_demand, known])
}

/// (m/s) ΔV of both vehicles in such a meeting, with the other one as fast as it was, unless the meeting
/// gives its speed; zero without a meeting. `None` without an impact in the case.
fn delta_v(
    case: &Case,
    vehicle: VehicleId,
    meeting: Option<Meeting>,
    other: Option<f64>,
) -> Option<[f64; 2]> {
    case.impact.as_ref()?;
    let Some(meeting) = meeting else { return Some([0.0; 2]) };
    let mut case = case.without_avoid().into_owned();
    case.reconstruct = None;
    let given = |speed| Quantity::from_si(speed, Dimension::Speed).ok().map(Velocity::Speed);
    case.vehicles[vehicle.index()].motion = given(meeting.speed);
    if let Some(other) = meeting.other.or(other) {
        case.vehicles[vehicle.other().index()].motion = given(other);
    }
    solve::impact(&case).ok().map(|analysis| analysis.delta_v())
}

/// What is wrong with numbers that make no scene.
fn unposed(form: &AvoidForm, refusal: Unposed) -> Failure {
    let table = format!("vehicle{}", form.vehicle);
    let fault = match refusal {
        Unposed::BrakedBefore { distance, time } => {
            let (key, when, given) = match &form.demand {
                DemandForm::Distance(given) => {
                    ("avoid.demand.distance", in_unit_of(given, distance), format!("{given} before it"))
                }
                DemandForm::Time(given) => {
                    ("avoid.demand.time", in_unit_of(given, time), format!("{given} before it"))
                }
                DemandForm::Sight => (
                    "avoid.demand.sight",
                    format!("{} s", rounded(time)),
                    "the moment when the view became free".to_owned(),
                ),
                DemandForm::Other(other) => {
                    let taken = other.time().unwrap_or_default();
                    let [when, given] = [time, taken].map(|time| format!("{} s", rounded(time)));
                    ("avoid.demand.other", when, format!("{given} before it"))
                }
            };
            let reason = format!(
                "the brakes took effect {when} before the impact, and so before the reaction demand, which is {given}"
            );
            let advice = "a driver cannot react before there is something to see: give an earlier demand, or check \
                          the skid and the speed at the impact";
            Fault::refused(key, reason, advice)
        }
        Unposed::SkidTooLong => Fault::refused(
            format!("{table}.before.skid"),
            "from the speed of [avoid], this skid ends before the impact",
            "check its length and friction; or leave `speed` out of [avoid], and give the speed at the impact",
        ),
        Unposed::SetsOutLater { distance } => {
            let (key, given) = match &form.demand {
                DemandForm::Distance(given) => ("avoid.demand.distance", given.to_string()),
                _ => ("avoid.demand", "farther".to_owned()),
            };
            let set_out = match &form.demand {
                DemandForm::Distance(given) => in_unit_of(given, distance),
                _ => format!("{} m", rounded(distance)),
            };
            let reason = format!(
                "the phases begin with a stop {set_out} before the impact, and the reaction demand is {given} before it"
            );
            let advice = "give the demand by `time`, or a distance at which the vehicle was already moving";
            Fault::refused(key, reason, advice)
        }
        Unposed::Phases(refusal) => Fault::refused(
            match form.braking {
                BrakingForm::Recorded { .. } => format!("{table}.recorder.pre_crash"),
                _ => format!("{table}.before.phase"),
            },
            format!("the vehicle cannot have moved like this: {refusal}"),
            "check the numbers of the phases against the speed at the impact; `acceleration` is negative while \
             the vehicle brakes",
        ),
        Unposed::OtherPhases(refusal) => Fault::refused(
            format!("vehicle{}.before", form.vehicle.other()),
            format!("the vehicle cannot have moved like this: {refusal}"),
            "check its phases, skid or recorder against its speed at the impact",
        ),
        Unposed::Parts => Fault::refused(
            "avoid.vehicle",
            format!(
                "both vehicles move along one line, and at these speeds vehicle {} does not catch up with vehicle {}",
                form.vehicle,
                form.vehicle.other()
            ),
            format!(
                "check the speeds and the headings; to ask about the other driver, write vehicle = \"vehicle{}\" in [avoid]",
                form.vehicle.other()
            ),
        ),
        Unposed::FromBehind => Fault::refused(
            "avoid.vehicle",
            format!(
                "by where they touch, vehicle {} ran into the rear of vehicle {}, whose driver could not have avoided that by braking",
                form.vehicle.other(),
                form.vehicle
            ),
            format!(
                "ask about the other driver: vehicle = \"vehicle{}\" in [avoid]; or check `contact`, the damaged side and the headings",
                form.vehicle.other()
            ),
        ),
        Unposed::Stands => Fault::refused(
            format!("{table}.speed"),
            format!(
                "[{table}] did not move forward at the impact, so its driver could not have avoided it by braking"
            ),
            format!("ask about the other: vehicle = \"vehicle{}\" in [avoid]", form.vehicle.other()),
        ),
        Unposed::OtherUnknown => Fault::refused(
            "avoid.sight.other_speed",
            "nothing says how fast the other party moves",
            "give `other_speed` in [avoid.sight], as in other_speed = \"1.5 m/s\"",
        ),
        Unposed::OtherStands => Fault::refused(
            "avoid.clear",
            "the other vehicle was stationary at the impact, so it never clears the danger zone",
            "leave `clear` out",
        ),
        Unposed::Outside => Fault::refused(
            "avoid.clear.outlines",
            format!(
                "by their outlines the vehicles do not meet: at the impact, vehicle {} is beside the strip that vehicle {} sweeps",
                form.vehicle.other(),
                form.vehicle
            ),
            "check `position` or `contact`, the headings, and length, width and cg_to_front of both; or give the \
             `distance` that the other still had to go",
        ),
        Unposed::NeverHidden => Fault::refused(
            "avoid.demand.sight",
            format!(
                "no obstacle hides the other party in the {SIGHT_LOOK_BACK} s before the impact, so the demand \
                 cannot be the moment when it comes into sight"
            ),
            "check the corners of [[avoid.obstacle]] and the directions in [avoid.sight], or give `demand` by distance or time",
        ),
        Unposed::HiddenAtImpact => Fault::refused(
            "avoid.obstacle",
            "an obstacle hides the other party at the impact",
            "check the corners of [[avoid.obstacle]], and `eye` and `point` of [avoid.sight]",
        ),
        Unposed::Engine(refusal) => Fault::refused("avoid", refusal, "check the numbers of [avoid]"),
    };
    Faults::from(fault).into()
}

/// What is wrong with an obstacle.
fn of_obstacle(index: usize, reason: String) -> Failure {
    let key = format!("avoid.obstacle[{}]", index + 1);
    let advice = "check its corners, and `eye`, `point` and the directions in [avoid.sight]: all are in the coordinates of the scene";
    Faults::from(Fault::refused(key, reason, advice)).into()
}

/// How a sentence calls an obstacle.
#[must_use]
pub fn obstacle_name(case: &Case, index: usize) -> String {
    let name = case.avoid.as_ref().and_then(|avoid| avoid.obstacles.get(index)?.name.as_ref());
    name.map_or_else(|| format!("obstacle {}", index + 1), |name| format!("the obstacle \"{name}\""))
}

fn no_exact_speed(vehicle: VehicleId) -> Faults {
    let reason = format!("no exact solution of the case gives the speed of [vehicle{vehicle}]");
    Fault::refused("avoid", reason, "let all the evidence give it, or give `speed` in [avoid]").into()
}

fn no_speed(vehicle: VehicleId) -> Faults {
    let reason = format!("nothing in the case gives the speed of [vehicle{vehicle}]");
    let advice = format!(
        "give `speed` in [avoid], the speed at the reaction demand, or `speed` in [vehicle{vehicle}], the \
         speed at the impact"
    );
    Fault::refused("avoid", reason, advice).into()
}

/// A value in SI, in the unit of another of its kind.
fn in_unit_of(like: &Quantity, si: f64) -> String {
    format!("{} {}", rounded(si / like.unit().factor()), like.unit())
}

/// Four digits.
fn rounded(number: f64) -> String {
    format!("{number:.3e}").parse().map_or_else(|_| number.to_string(), format_number)
}

/// The numbers of `[avoid]` without a source.
#[must_use]
pub fn without_source(avoid: &Avoid) -> Vec<&'static str> {
    let given = [
        ("speed", &avoid.speed),
        ("limit", &avoid.limit),
        ("reaction_time", &avoid.reaction_time),
        ("swell", &avoid.swell),
        ("deceleration", &avoid.deceleration),
    ];
    let lacks = |(key, sourced): (&'static str, &Option<inputs::Sourced>)| {
        sourced.as_ref().filter(|sourced| sourced.source.is_none()).map(|_| key)
    };
    let demand = avoid.demand.as_ref().filter(|demand| !matches!(demand, GivenDemand::Sight));
    let demand = demand.filter(|_| avoid.demand_reason.is_none()).map(|_| "demand");
    given.into_iter().filter_map(lacks).chain(demand).collect()
}
