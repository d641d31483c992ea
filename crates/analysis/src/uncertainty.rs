//! Propagates the ranges of a case to its results.

mod doubts;
mod exact;
pub(crate) mod lanes;

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use ::uncertainty::{
    Distribution, FirstOrder, Instructions, InvalidDistribution, InvalidRequest, LANES, Lanes, Model,
    Progress, Propagation, Sampler, Settings, TORNADO_PROBABILITIES, Tornado, Truncation, evaluate_each,
    join,
};
use crash3::CrushError;
use inputs::{
    Axes, Bounds, Case, ContactSpread, Dimension, EstimatedInput, Fault, FaultKind, Faults, GivenUncertainty,
    GivenVehicle, Input, Origin, Range, SharedEffects, SharedError, Spread, Unit, YAW_RADIUS_CONFIDENCE,
};
use pim_core::{ImpactError, VehicleId};
use real::Gradient;
use reconcile::{MomentumError, ReconcileError};

use crate::columns::Number;
pub use doubts::{Doubt, Doubtful};
pub use exact::{ExactValue, TakenAsExact};
use lanes::{Alone, Block};

use crate::analysis::Analysis;
use crate::failure::Failure;
use crate::goal::{self, Answer, Goal, Search, at};
use crate::output::{Kind, Output};
use crate::sensitivity::gradients;
use crate::speeds::BothFound;

/// The requested samples and indices.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// The number of samples, the seed and the method.
    pub settings: Settings,
    /// Rows for the variance-based indices, each with as many evaluations as there are uncertain inputs plus
    /// two; `None` computes no indices.
    pub index_rows: Option<usize>,
}

/// The result of propagating the ranges of a case.
#[derive(Debug)]
pub struct Uncertainty {
    /// The case at its central values.
    pub nominal: Analysis,
    /// The settings: the method and the requested number of samples.
    pub settings: Settings,
    /// The numbers that are ranges, in the order of the file, followed by the departures of estimates.
    pub inputs: Vec<UncertainInput>,
    /// The numbers that all samples share, so that the intervals do not contain their errors.
    pub taken_as_exact: Vec<TakenAsExact>,
    /// The quantities that were computed for each sample.
    pub outputs: Vec<UncertainOutput>,
    /// The samples of the outputs (SI), in their order, and the failures by [`Reason::code`].
    pub propagation: Propagation,
    /// Number of doubtful samples with an answer, by reason; reasons without any are omitted.
    pub doubtful: Vec<Doubtful>,
    /// One input at a time, from low to high.
    pub tornado: Tornado,
    /// Sobol' indices of the outputs in their order, if requested.
    pub indices: Option<::uncertainty::SobolIndices>,
}

/// A number that is a range, or the departure of an estimate.
#[derive(Clone, Debug)]
pub struct UncertainInput {
    /// The number itself, which is the central value.
    pub input: Input,
    /// (–) its index among the numbers that may vary, [`Case::variables`].
    pub place: usize,
    /// Its distribution, in the unit in which the file gives it.
    pub distribution: Distribution,
    /// Its physical bounds.
    pub bounds: Bounds,
}

impl UncertainInput {
    /// The truncation, if the physical bounds cut off part of the normal distribution in the file.
    #[must_use]
    pub fn truncation(&self) -> Option<Truncation> {
        self.distribution.truncation().filter(|truncation| truncation.kept < 1.0)
    }
}

/// A result that the ranges make uncertain.
#[derive(Clone, Debug)]
pub struct UncertainOutput {
    /// The result.
    pub output: Output,
    /// (SI) its value at the central values.
    pub central: f64,
    /// (SI) its standard deviation from the derivatives at the central values, and the share of each input in
    /// its square: the law of propagation of uncertainty of the GUM.
    ///
    /// JCGM 100:2008, *Guide to the Expression of Uncertainty in Measurement*, equation 10.
    pub first_order: FirstOrder,
    /// (SI) a typical large value: a spread below [`NOISE`] of that is rounding.
    scale: f64,
}

/// (–) far above the rounding of any output, and far below any relevant spread.
pub(crate) const NOISE: f64 = 1e-9;

impl UncertainOutput {
    /// Whether the result varies with the inputs at all, by the derivatives or by the samples' standard
    /// deviation.
    #[must_use]
    pub fn varies(&self, sampled_sd: f64) -> bool {
        self.first_order.sd.max(sampled_sd) > NOISE * self.scale
    }

    /// Whether the result varies, and its first-order and sampled standard deviations differ by more than 10
    /// %.
    #[must_use]
    pub fn differs(&self, sampled_sd: f64) -> bool {
        self.varies(sampled_sd) && self.first_order.differs(sampled_sd)
    }
}

/// (SI) a typical large value of an output: a right angle or so, the closing speed, the energy before the
/// impact; of a path to rest its length, its time and the speed at its start. 0 if any spread counts.
fn scale(output: Output, nominal: &Analysis) -> f64 {
    let exchange = nominal.exchange();
    let travel = output.vehicle().and_then(|vehicle| nominal.travel[vehicle.index()].as_ref());
    let scale = match output.quantity().kind {
        Kind::Ratio | Kind::Angle | Kind::YawRate => Some(1.0),
        Kind::Speed if output.quantity().is_of_path() => {
            travel.map(|travel| travel.start.motion.velocity.norm())
        }
        Kind::Speed => exchange.map(|exchange| exchange.closing_speed.abs()),
        Kind::Length => travel.map(|travel| travel.rest.distance),
        Kind::Time => travel.map(|travel| travel.rest.time),
        Kind::Energy => exchange.map(|exchange| exchange.energy.before),
        Kind::Impulse => exchange.map(|exchange| exchange.impulse_vector.norm()),
        Kind::MomentImpulse | Kind::Force => None,
    };
    scale.unwrap_or(0.0)
}

/// Why a sample has no answer, with the code by which the engine counts it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The contact points do not approach each other.
    NotApproaching = 1,
    /// No speed reconciles crush and impact.
    NoRoot = 2,
    /// The coefficients would create energy.
    EnergyCreated = 3,
    /// The contact jams.
    Jam = 4,
    /// The vehicles would have to pull at each other.
    Pulling = 5,
    /// The speed without damage is not below that of the barrier test.
    NoDamageSpeed = 7,
    /// The limit of the force per width is less than A, its initial value.
    LimitBelowStart = 8,
    /// No motion after the impact leads to a rest, or from it.
    NoRest = 9,
    /// Momentum and crush energy give no speeds.
    NoSpeeds = 10,
    /// Something else.
    Other = 6,
}

/// All reasons.
pub const REASONS: [Reason; 10] = [
    Reason::NotApproaching,
    Reason::NoRoot,
    Reason::EnergyCreated,
    Reason::Jam,
    Reason::Pulling,
    Reason::NoDamageSpeed,
    Reason::LimitBelowStart,
    Reason::NoRest,
    Reason::NoSpeeds,
    Reason::Other,
];

impl Reason {
    /// The code by which the engine counts it.
    #[must_use]
    pub fn code(self) -> u8 {
        self as u8
    }

    /// The reason of a code: a result that is not finite, which the engine itself refuses, belongs to the
    /// others.
    #[must_use]
    pub fn of_code(code: u8) -> Self {
        REASONS.into_iter().find(|reason| reason.code() == code).unwrap_or(Self::Other)
    }

    fn of(failure: &Failure) -> Self {
        match failure {
            Failure::Impact(error)
            | Failure::Reconcile(ReconcileError::Inadmissible { reason: error, .. })
            | Failure::NotReached { nearest: Err(error), .. } => Self::of_impact(error),
            Failure::NotReached { .. }
            | Failure::Reconcile(
                ReconcileError::NotReached { .. }
                | ReconcileError::NoCrushEnergy { .. }
                | ReconcileError::NoRestitutionLoss { .. }
                | ReconcileError::SpeedWithoutEffect { .. },
            ) => Self::NoRoot,
            Failure::NoRest { .. } | Failure::NoStart { .. } => Self::NoRest,
            Failure::Momentum(
                MomentumError::Impact(error) | MomentumError::Inadmissible { reason: error, .. },
            ) => Self::of_impact(error),
            Failure::Momentum(_) => Self::NoSpeeds,
            Failure::Reconcile(_)
            | Failure::Case(_)
            | Failure::Crush(_)
            | Failure::Ranges(_)
            | Failure::Excluded(_)
            | Failure::Unjudged { .. }
            | Failure::Estimate(_) => Self::Other,
        }
    }

    /// The reason of a case: the engine's refusal of its damage is reported as a fault of the case, which no
    /// longer has its kind.
    fn of_case(case: &Case, failure: &Failure) -> Self {
        if !matches!(failure, Failure::Case(_)) {
            return Self::of(failure);
        }
        Self::of_structures(case.vehicles.iter().filter_map(|vehicle| {
            let crush = vehicle.crush.as_ref()?;
            crush.stiffness.structure(crush.side).err()
        }))
    }

    /// The first of these refusals of a stiffness that is counted by itself.
    fn of_structures(refusals: impl Iterator<Item = CrushError>) -> Self {
        let mut counted = refusals.filter_map(|refusal| match refusal {
            CrushError::NoDamageSpeed { .. } => Some(Self::NoDamageSpeed),
            CrushError::LimitBelowStart { .. } => Some(Self::LimitBelowStart),
            _ => None,
        });
        counted.next().unwrap_or(Self::Other)
    }

    fn of_impact(error: &ImpactError) -> Self {
        match error {
            ImpactError::NotApproaching { .. } => Self::NotApproaching,
            ImpactError::EnergyCreated { .. } => Self::EnergyCreated,
            ImpactError::Jam { .. } => Self::Jam,
            ImpactError::Pulling { .. } => Self::Pulling,
            _ => Self::Other,
        }
    }
}

/// Consecutive samples. Lanes beyond the last sample hold arbitrary values.
#[derive(Clone, Copy, Debug)]
pub struct SampleBlock<'a> {
    /// (unit of the file) the uncertain inputs, a column for each.
    pub inputs: &'a [Lanes],
    /// (SI) the outputs, a column for each, which are meaningless if the sample failed.
    pub outputs: &'a [Lanes],
    /// [`Reason::code`] of each sample, 0 if it has an answer.
    pub reasons: &'a [u8],
}

impl Uncertainty {
    /// Visits all samples in order, with their inputs, which are drawn again, and with their outputs.
    ///
    /// # Errors
    /// The error that `visit` returns.
    pub fn for_each_block<E>(
        &self,
        mut visit: impl FnMut(SampleBlock<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let distributions: Vec<Distribution> = self.inputs.iter().map(|input| input.distribution).collect();
        // The settings and inputs are those of a completed run.
        let Ok(sampler) = Sampler::new(&distributions, &self.settings) else { return Ok(()) };
        let mut inputs = vec![Lanes::ZERO; self.inputs.len()];
        let mut answers = vec![Lanes::ZERO; self.outputs.len()];
        let (reasons, columns) = (self.propagation.reasons(), self.propagation.columns());
        for (block, first) in (0..).zip((0..reasons.len()).step_by(LANES)) {
            let reasons = &reasons[first..reasons.len().min(first + LANES)];
            sampler.fill(block, &mut inputs);
            for (answer, column) in answers.iter_mut().zip(columns) {
                answer[..reasons.len()].copy_from_slice(&column[first..][..reasons.len()]);
            }
            visit(SampleBlock { inputs: &inputs, outputs: &answers, reasons })?;
        }
        Ok(())
    }

    /// Number of samples that failed for a reason.
    #[must_use]
    pub fn failed(&self, reason: Reason) -> usize {
        let failures = self.propagation.failures().iter();
        failures.filter(|(code, _)| Reason::of_code(**code) == reason).map(|(_, count)| count).sum()
    }
}

/// The stage that [`uncertainty()`](crate::uncertainty()) has reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The samples.
    Samples,
    /// The rows for the indices.
    Indices,
}

/// As [`uncertainty_of`](crate::uncertainty_of).
pub(crate) fn uncertainty_of(
    case: &Case,
    plan: &Plan,
    wanted: &dyn Fn(Output) -> bool,
    progress: &mut (dyn FnMut(Stage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Uncertainty, Failure> {
    let goal = Goal::of(case);
    // A range is no help to a case that lacks something else.
    let inputs = goal.obstacle(case).map_or_else(|| inputs(case), Err)?;
    let nominal = goal.solve(case)?;
    let all = Output::of(&nominal, case.axes);
    let (mut outputs, others): (Vec<Output>, Vec<Output>) = all.iter().partition(|output| wanted(**output));
    let asked = outputs.len();
    if asked == 0 {
        return Err(Faults::from(no_output(&all)).into());
    }
    // These show which samples are doubtful, whatever is requested.
    outputs.extend(others.into_iter().filter(|output| doubts::reads(*output)));
    let central = central(&nominal, &outputs, case.axes);
    let model = Sample::new(case, &nominal, &inputs, &outputs, &central);
    let distributions: Vec<Distribution> = inputs.iter().map(|input| input.distribution).collect();
    let numbers: Vec<f64> = inputs.iter().map(|input| input.input.number).collect();

    let without_samples = || {
        let gradients = gradients(case, &nominal, &outputs)?;
        let first_order = first_order(&gradients, &inputs)?;
        let taken_as_exact = exact::taken_as_exact(case, &inputs, &gradients);
        let tornado = ::uncertainty::tornado(&model, &distributions, &numbers, TORNADO_PROBABILITIES)?;
        Ok::<_, Failure>((first_order, taken_as_exact, tornado))
    };
    let of_samples: &mut Progress<'_> = &mut |done, total| progress(Stage::Samples, done, total);
    let propagate = || ::uncertainty::propagate(&model, &distributions, &plan.settings, of_samples);
    let (found, propagation) = join(without_samples, propagate);
    let ((first_order, taken_as_exact, tornado), mut propagation) = (found?, propagation?);
    let is_ended = propagation.evaluated() < propagation.requested();
    let doubtful = doubts::doubtful(case, &model, &inputs, &plan.settings, &propagation)?;
    propagation.truncate(asked);
    let indices = match plan.index_rows {
        Some(samples) if !is_ended => {
            let settings = Settings { samples, ..plan.settings };
            let of_indices: &mut Progress<'_> = &mut |done, total| progress(Stage::Indices, done, total);
            Some(::uncertainty::sensitivity(&model, &distributions, &settings, of_indices)?)
        }
        _ => None,
    };
    let outputs = outputs.into_iter().zip(central).zip(first_order).take(asked);
    let outputs = outputs
        .map(|((output, central), first_order)| {
            let scale = scale(output, &nominal);
            UncertainOutput { output, central, first_order, scale }
        })
        .collect();
    Ok(Uncertainty {
        nominal,
        settings: plan.settings,
        inputs,
        taken_as_exact,
        outputs,
        propagation,
        doubtful,
        tornado,
        indices,
    })
}

/// Only the samples of a case, without the rest of its [`Uncertainty`].
#[derive(Debug)]
pub struct Samples {
    /// The quantities that were computed for each sample.
    pub outputs: Vec<Output>,
    /// The samples of the outputs (SI), in their order, and the failures by [`Reason::code`].
    pub propagation: Propagation,
}

/// The samples of [`uncertainty()`](crate::uncertainty()), with the same bits, in a fraction of its time if
/// they are few: without derivatives, tornado and doubts, for which a row of a table has no place. `None` if
/// nothing is uncertain.
///
/// # Errors
/// As for [`uncertainty()`](crate::uncertainty()), except for a case without ranges.
pub fn samples(
    case: &Case,
    settings: &Settings,
    progress: &mut Progress<'_>,
) -> Result<Option<Samples>, Failure> {
    let case = &*case.without_avoid();
    let inputs = any_inputs(case)?;
    if inputs.is_empty() {
        return Ok(None);
    }
    let nominal = Goal::of(case).solve(case)?;
    let outputs = Output::of(&nominal, case.axes);
    let central = central(&nominal, &outputs, case.axes);
    let model = Sample::new(case, &nominal, &inputs, &outputs, &central);
    let distributions: Vec<Distribution> = inputs.iter().map(|input| input.distribution).collect();
    let propagation = ::uncertainty::propagate(&model, &distributions, settings, progress)?;
    Ok(Some(Samples { outputs, propagation }))
}

/// Whether [`uncertainty()`](crate::uncertainty()) has anything to propagate: a range, an estimated value, or
/// an error that numbers share.
#[must_use]
pub fn is_uncertain(case: &Case) -> bool {
    any_inputs(&case.without_avoid()).map_or(true, |inputs| !inputs.is_empty())
}

/// Whether each sample of [`uncertainty()`](crate::uncertainty()) is traced back from a rest position, which
/// takes a thousand times as long as solving an impact.
#[must_use]
pub fn is_searched_back(case: &Case) -> bool {
    let seeks = matches!(Goal::of(case), Goal::BothSpeeds | Goal::Motion);
    let has_rest_alone = |vehicle: &GivenVehicle| {
        vehicle.after.as_ref().is_some_and(|after| after.rest.is_some() && after.speed.is_none())
    };
    seeks && case.vehicles.iter().any(has_rest_alone)
}

/// The ranges of the case and the spreads of its estimates, in the types of the engine: at least one.
pub(crate) fn inputs(case: &Case) -> Result<Vec<UncertainInput>, Faults> {
    let inputs = any_inputs(&case.without_avoid())?;
    if inputs.is_empty() { Err(no_range(case).into()) } else { Ok(inputs) }
}

/// The same, but possibly none.
pub(crate) fn any_inputs(case: &Case) -> Result<Vec<UncertainInput>, Faults> {
    let mut ranges = case.ranges.iter();
    let mut inputs = Vec::new();
    let mut faults = Vec::new();
    let mut unmatched = case.ranges.iter().peekable();
    let depends_on_stiffness = case.reconstruct.is_some() || Goal::of(case) == Goal::Damage;
    let variables = case.variables_where(|variable| {
        variable.origin != Origin::Given || unmatched.next_if(|range| variable.is_at(&range.path)).is_some()
    });
    for (place, input) in variables {
        let (distribution, bounds) = match input.origin {
            Origin::Given => {
                let Some(range) = ranges.next() else { continue };
                (distribution(&input, range), range.bounds)
            }
            // Without a speed to find, only the energy of one vehicle depends on the stiffness.
            Origin::Estimate(EstimatedInput::Stiffness { .. }) if !depends_on_stiffness => continue,
            Origin::Estimate(estimate) if case.uncertainty.exact.contains(&estimate.key()) => continue,
            Origin::Estimate(EstimatedInput::Contact { vehicle, axis }) => {
                match case.contact_spread(vehicle, axis) {
                    // The number is in the unit of the offset.
                    ContactSpread::Default(sd) => {
                        (Distribution::normal(input.number, sd / input.factor()), Bounds::None)
                    }
                    ContactSpread::OfInputs | ContactSpread::Exact => continue,
                }
            }
            Origin::Estimate(EstimatedInput::Stiffness { typical, .. }) => {
                // A = A₀ exp(σ_A z)
                let [of_a, _] = typical.ln_sds();
                (Distribution::log_normal(input.number, of_a), Bounds::Positive)
            }
            Origin::Estimate(EstimatedInput::YawRadius { source, .. }) => {
                let distance = source.within() * input.number;
                let spread = within(input.number, distance, YAW_RADIUS_CONFIDENCE, Bounds::Positive, None);
                (spread, Bounds::Positive)
            }
            Origin::Shared(error) => match case.uncertainty.shared.get(error) {
                Some(error) => (size_of(error, &input), Bounds::None),
                None => continue,
            },
        };
        match distribution {
            Ok(distribution) => inputs.push(UncertainInput { input, place, distribution, bounds }),
            Err(error) => faults.push(Fault {
                key: input.path,
                kind: FaultKind::Refused { reason: error.to_string() },
                advice: None,
            }),
        }
    }
    Faults::none_of(faults)?;
    // An unknown speed is not an input, even if the file gives one.
    if let Some(reconstruct) = &case.reconstruct {
        for id in VehicleId::ALL.into_iter().filter(|id| reconstruct.find.seeks(*id)) {
            // Of a vector the direction still counts.
            let sought = format!("vehicle{id}.speed");
            inputs.retain(|input| input.input.path != sought);
        }
    }
    Ok(inputs)
}

/// The advice for a case without ranges outside of `[avoid]`, shown at a number of the case.
fn no_range(case: &Case) -> Fault {
    let collision = case.without_avoid();
    let key = if case.ranges.len() > collision.ranges.len() { "avoid".to_owned() } else { String::new() };
    let inputs = collision.inputs();
    let example = inputs.iter().find_map(|input| {
        // A share of an angle depends on its zero, which is arbitrary.
        let unit = input.unit.filter(|unit| input.number != 0.0 && unit.dimension() != Dimension::Angle)?;
        let (table, key) = input.path.rsplit_once('.')?;
        let value = format!("{} {unit}", input.number);
        Some(format!("in [{table}] {key} = {{ value = \"{value}\", within = \"5 %\", confidence = 0.95 }}"))
    });
    let forms = "{ value = …, sd = … }, { low = …, high = … } and { low = …, mode = …, high = … }, and of depths { values = …, sd = … }";
    let help = match example {
        Some(example) => {
            format!("give at least one number as a range, for example {example}; the other forms are {forms}")
        }
        None => format!("give at least one number as a range; the forms are {forms}"),
    };
    Fault { key, kind: FaultKind::NothingUncertain, advice: Some(help) }
}

/// The advice for a case that has none of the requested outputs.
fn no_output(all: &[Output]) -> Fault {
    let names: Vec<String> = all.iter().map(|output| output.path()).collect();
    let advice = format!("its outputs are {}", names.join(", "));
    Fault::refused("", "the case has none of the outputs requested", advice)
}

/// The distribution of a shared error.
fn size_of(error: &SharedError, input: &Input) -> Result<Distribution, InvalidDistribution> {
    let range = Range { path: input.path.clone(), spread: error.size, bounds: Bounds::None };
    distribution(input, &range)
}

fn distribution(input: &Input, range: &Range) -> Result<Distribution, InvalidDistribution> {
    let value = input.number;
    match range.spread {
        Spread::Normal { sd } => normal(value, sd.in_unit(input.unit), range.bounds, input.unit),
        Spread::Within { percent, confidence } => {
            within(value, percent / 100.0 * value.abs(), confidence, range.bounds, input.unit)
        }
        Spread::Uniform { low, high } => {
            Distribution::uniform(low.in_unit(input.unit), high.in_unit(input.unit))
        }
        Spread::Triangular { low, high } => {
            Distribution::triangular(low.in_unit(input.unit), value, high.in_unit(input.unit))
        }
    }
}

fn normal(
    value: f64,
    sd: f64,
    bounds: Bounds,
    unit: Option<&'static Unit>,
) -> Result<Distribution, InvalidDistribution> {
    match bounds {
        Bounds::None => Distribution::normal(value, sd),
        bounds => {
            let [low, high] = bounds.interval(unit);
            Distribution::truncated_normal(value, sd, low, high)
        }
    }
}

/// Normal: with the probability `confidence`, at most `distance` from the value.
fn within(
    value: f64,
    distance: f64,
    confidence: f64,
    bounds: Bounds,
    unit: Option<&'static Unit>,
) -> Result<Distribution, InvalidDistribution> {
    // P(|x − μ| < d) = c  ⇒  σ = d/Φ⁻¹((1 + c)/2)
    let z = Distribution::normal(0.0, 1.0)?.quantile(0.5 * (1.0 + confidence));
    normal(value, distance / z, bounds, unit)
}

/// (SI) the outputs at the central values.
fn central(nominal: &Analysis, outputs: &[Output], axes: Axes) -> Vec<f64> {
    let answer = Answer::of(nominal);
    outputs.iter().map(|output| output.of_answer(&answer, axes)).collect()
}

fn first_order(gradients: &[Gradient], inputs: &[UncertainInput]) -> Result<Vec<FirstOrder>, InvalidRequest> {
    let sds: Vec<f64> = inputs.iter().map(|input| input.distribution.sd() * input.input.factor()).collect();
    let of = |gradient: &Gradient| {
        let derivatives: Vec<f64> = inputs.iter().map(|input| gradient.by[input.place]).collect();
        FirstOrder::new(&derivatives, &sds)
    };
    gradients.iter().map(of).collect()
}

/// Computes the outputs of a sample from its uncertain numbers.
struct Sample<'a> {
    goal: Goal,
    /// Whether the crush energy gives the speeds.
    is_by_crush: bool,
    /// The starting points of the search for the starts of paths.
    search: Search,
    outputs: &'a [Output],
    /// (SI) the outputs at the central values.
    central: &'a [f64],
    /// For each number of the case, whether it is uncertain.
    is_uncertain: Vec<bool>,
    /// The case without its texts, which no sample needs.
    case: Case,
    /// The shared errors, if there are any.
    shared: Option<Shared>,
    /// The same for a block at once, or why the shape of the case does not allow that.
    block: Result<Block, Alone>,
}

impl<'a> Sample<'a> {
    fn new(
        case: &Case,
        nominal: &Analysis,
        inputs: &[UncertainInput],
        outputs: &'a [Output],
        central: &'a [f64],
    ) -> Self {
        let shared = Shared::of(case, inputs);
        let mut uncertain = inputs.iter().map(|input| input.place).peekable();
        let mut is_uncertain = Vec::new();
        let mut case = case.map_numbers(|number| {
            is_uncertain.push(uncertain.next_if_eq(&is_uncertain.len()).is_some());
            number
        });
        let (mut places, mut marks) = (0.., is_uncertain.iter().enumerate());
        // The numbers that share an error follow the inputs.
        let with_error = |place| Some(inputs.len() + shared.as_ref()?.covered.binary_search(&place).ok()?);
        let numbers = case.map_numbers(|number| {
            let (place, is_uncertain) = marks.next().unwrap_or((0, &false));
            let input = if *is_uncertain { places.next() } else { None };
            with_error(place).or(input).map_or(Number::Known(number), Number::Uncertain)
        });
        let uncertain = match &shared {
            None => inputs.len(),
            Some(shared) => shared.uncertain_numbers(inputs),
        };
        let search = Search::near(nominal);
        let block = Block::new(numbers, uncertain, outputs, central, search.chosen);
        case.uncertainty = GivenUncertainty::default();
        case.title = None;
        case.source = None;
        for vehicle in &mut case.vehicles {
            vehicle.name = None;
        }
        Self {
            goal: Goal::of(&case),
            is_by_crush: nominal.found.is_some() || nominal.both.as_ref().is_some_and(BothFound::is_by_crush),
            search,
            outputs,
            central,
            is_uncertain,
            case,
            shared,
            block,
        }
    }

    /// Solves the samples of a block that are not `settled` yet, each as a separate case.
    ///
    /// Compiled once: turning a case into the types of the engine gains nothing from a copy for each
    /// instruction set.
    #[inline(never)]
    fn one_by_one(
        &self,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
        settled: &[bool; LANES],
    ) {
        evaluate_each(
            inputs,
            outputs,
            reasons,
            |lane| !settled[lane],
            |numbers, results| self.answer(numbers, results).map_err(Reason::code),
        );
    }

    /// The case of a sample with these uncertain numbers.
    fn case_of(&self, numbers: &[f64]) -> Case {
        let mut numbers = numbers.iter();
        if let Some(shared) = &self.shared {
            let mut all = Vec::new();
            shared.fill(numbers.copied(), &mut all);
            // Without the errors themselves, which the case of a sample no longer has.
            let mut all = all.into_iter();
            return self.case.map_numbers(|central| all.next().unwrap_or(central));
        }
        let mut is_uncertain = self.is_uncertain.iter();
        self.case.map_numbers(|central| match is_uncertain.next() {
            Some(true) => numbers.next().copied().unwrap_or(central),
            _ => central,
        })
    }

    fn answer(&self, numbers: &[f64], results: &mut [f64]) -> Result<(), Reason> {
        let case = self.case_of(numbers);
        self.solve(&case, results).map_err(|failure| Reason::of_case(&case, &failure))
    }

    fn solve(&self, case: &Case, results: &mut [f64]) -> Result<(), Failure> {
        let answer = goal::answer(self.goal, case, &mut { self.search })?;
        for ((output, central), result) in self.outputs.iter().zip(self.central).zip(results) {
            *result = as_beside(*output, *central, output.of_answer(&answer, case.axes));
        }
        Ok(())
    }

    /// Number of these samples of a block with other speeds that agree with their crush energy.
    fn several_speeds(
        &self,
        instructions: Instructions,
        inputs: &[Lanes],
        lanes: impl Iterator<Item = usize>,
    ) -> usize {
        if let (Goal::Speed, Ok(block)) = (self.goal, &self.block) {
            let with_errors = self.shared.as_ref().map(|shared| shared.columns(inputs));
            return block.several_speeds(instructions, with_errors.as_deref().unwrap_or(inputs), lanes);
        }
        let mut numbers = vec![0.0; inputs.len()];
        let has_several = |lane: &usize| {
            for (number, column) in numbers.iter_mut().zip(inputs) {
                *number = column[*lane];
            }
            self.has_several_speeds(&numbers)
        };
        lanes.filter(has_several).count()
    }

    /// Whether other speeds of a sample agree with its crush energy.
    fn has_several_speeds(&self, numbers: &[f64]) -> bool {
        let case = self.case_of(numbers);
        match self.goal {
            Goal::Speed => at(&case, |problem| Ok(problem.has_several_speeds())).unwrap_or(false),
            Goal::BothSpeeds => {
                let mut search = self.search;
                search.several = Some(false);
                goal::answer(self.goal, &case, &mut search).is_ok() && search.several == Some(true)
            }
            Goal::Impact | Goal::Motion | Goal::Damage => false,
        }
    }
}

/// The shared errors of a case.
struct Shared {
    effects: SharedEffects,
    /// (unit of the file) every number that may vary, at its central value.
    central: Vec<f64>,
    /// The indices of the inputs among these, and those of the numbers that an error covers.
    inputs: Vec<usize>,
    covered: Vec<usize>,
}

impl Shared {
    /// `None` if there are no shared errors.
    fn of(case: &Case, inputs: &[UncertainInput]) -> Option<Self> {
        let effects = SharedEffects::of(case);
        if effects.is_empty() {
            return None;
        }
        let central: Vec<f64> = case.variables().into_iter().map(|input| input.number).collect();
        let covered = (0..central.len()).filter(|place| effects.cover(*place)).collect();
        let inputs = inputs.iter().map(|input| input.place).collect();
        Some(Self { effects, central, inputs, covered })
    }

    /// Number of uncertain numbers of the case, including those that an error covers, but not the errors.
    fn uncertain_numbers(&self, inputs: &[UncertainInput]) -> usize {
        let is_error = |input: &UncertainInput| matches!(input.input.origin, Origin::Shared(_));
        let others = inputs.iter().filter(|input| !is_error(input) && !self.effects.cover(input.place));
        self.covered.len() + others.count()
    }

    /// (unit of the file) all numbers of a sample.
    fn fill(&self, inputs: impl Iterator<Item = f64>, all: &mut Vec<f64>) {
        all.clone_from(&self.central);
        for (place, input) in self.inputs.iter().zip(inputs) {
            all[*place] = input;
        }
        self.effects.apply(all);
    }

    /// The columns of the inputs, followed by those of the numbers that an error covers.
    #[inline(never)]
    fn columns(&self, inputs: &[Lanes]) -> Vec<Lanes> {
        let mut columns = inputs.to_vec();
        columns.resize(inputs.len() + self.covered.len(), Lanes::ZERO);
        let mut all = Vec::new();
        for lane in 0..LANES {
            self.fill(inputs.iter().map(|column| column[lane]), &mut all);
            for (column, place) in columns[inputs.len()..].iter_mut().zip(&self.covered) {
                column[lane] = all[*place];
            }
        }
        columns
    }
}

/// (SI) the value of an output; a direction within half a turn of its `central` value.
#[inline(always)]
fn as_beside(output: Output, central: f64, value: f64) -> f64 {
    if output.quantity().is_direction { beside(value, central) } else { value }
}

impl Model for Sample<'_> {
    fn outputs(&self) -> usize {
        self.outputs.len()
    }

    #[inline(always)]
    fn evaluate(
        &self,
        instructions: Instructions,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) {
        let shared = self.shared.as_ref().filter(|_| self.block.is_ok());
        let with_errors = shared.map(|shared| shared.columns(inputs));
        let settled = match &self.block {
            Ok(block) => {
                block.evaluate(instructions, with_errors.as_deref().unwrap_or(inputs), outputs, reasons)
            }
            Err(_) => [false; LANES],
        };
        if !settled.iter().all(|is_settled| *is_settled) {
            self.one_by_one(inputs, outputs, reasons, &settled);
        }
    }
}

/// (rad) the same direction, within half a turn of another.
#[inline(always)]
pub(crate) fn beside(angle: f64, other: f64) -> f64 {
    if angle - other > PI {
        angle - TAU
    } else if angle - other < -PI {
        angle + TAU
    } else {
        angle
    }
}

#[cfg(test)]
mod tests;
