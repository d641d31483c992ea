//! From a case to its unknown numbers and its evidence.

use std::f64::consts::FRAC_PI_2;

use ::estimate::Independent;
use ::uncertainty::Distribution;
use evidence::{
    CodedPdof, CrushErrors, Damage, EnergyError, EnergyMethod, FITTED, Freedom, Limits, Measured,
    MeasuredRest, MeasuredSpeed, Observed, ObservedVehicle, OtherCrush, RecordedDeltaV, RecordedPart,
    Recorder, Severity, Speeds,
};
use inputs::{
    BrachTangential, Case, Collision, Dimension, Fault, FaultKind, Faults, Find, GivenVehicle, ImpactLaw,
    Input, KnownEnergy, MotionInput, Origin, Prior, Purpose, Quantity, Reconstruct, SharedEffects, SkidBegin,
    StiffnessForm, Unit, VehicleData, Velocity,
};
use pim_core::VehicleId;
use real::Real;
use reconcile::Unknown;

use super::block::Block;
use super::impacts::{CaseImpacts, SkidNumbers, Slot, Varied};
use super::of_number;
use super::posed::{Alone, OpenSpeeds};
use crate::damage;
use crate::excluded::table;
use crate::failure::Failure;
use crate::thresholds::{DIRECTION_AFTER_ERROR, SPEED_AFTER_ERROR};
use crate::uncertainty::lanes::Number;
use crate::uncertainty::{UncertainInput, inputs};
use crash3::Side;

/// Why a number has the distribution that it has, where the case does not give it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Assumed {
    /// A heading as it is usually known.
    Heading,
    /// A crush plane, likewise.
    CrushPlane,
    /// A contact point, likewise.
    Contact,
    /// A mass, likewise: Smith and Noga 1982.
    Mass,
    /// What a table or a formula gives, as `uncertainty` varies it.
    Estimate,
    /// Speeds without evidence.
    Speed,
    /// A coefficient of the impact that the case gives without a range, with the spread that such collisions
    /// have.
    Coefficient,
    /// The greatest impulse ratio, where the case does not give it.
    Friction,
    /// λ.
    TangentialShare,
    /// The crush energy of a vehicle by that of the other, of real crashes.
    OtherCrush,
    /// The friction of the ground, as it is usually known.
    Ground,
    /// The drag of wheels, likewise.
    Drag,
}

/// What the case gives and the estimate does not use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unused {
    /// Its key.
    pub key: String,
    /// Why.
    pub reason: UnusedReason,
}

/// Why a value is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnusedReason {
    /// The speed that is sought.
    Sought,
    /// A crush that was not measured.
    Inferred,
    /// A crush of both vehicles that took no energy.
    NoEnergy,
    /// A PDOF that follows from that of the other vehicle: both are one observation.
    OtherPdof,
    /// A rest or points of a vehicle that cannot be followed there: friction or drag is missing.
    NotFollowed,
    /// The direction of a vehicle that stood after the impact.
    NoDirection,
    /// That the vehicles left as one wreck.
    OneWreck,
}

/// (rad) standard deviation of a heading without a range: 2°.
const HEADING_SD: f64 = 2.0 * DEGREE;
/// (rad) of a crush plane without a range: 5°.
const CRUSH_PLANE_SD: f64 = 5.0 * DEGREE;
/// (m) of a contact point without a range, in each direction.
const CONTACT_SD: f64 = 0.10;
/// (kg) of a mass without a range: 65 lb, Smith and Noga, SAE 821169 (1982).
const MASS_SD: f64 = 65.0 * 0.453_592_37;
/// (–) of the logarithm of the friction of the ground.
const GROUND_LN_SD: f64 = 0.10;
/// (–) of that of the drag of a vehicle's wheels.
const DRAG_LN_SD: f64 = 0.30;
/// (m/s) no vehicle is thought to have been faster.
const FASTEST: f64 = 70.0;
/// (–; rad/s) error of a yaw rate after the impact: a share of it, and at least that of a slow turn.
const YAW_RATE_SHARE: f64 = 0.2;
const YAW_RATE_LEAST: f64 = 10.0 * DEGREE;
/// (–; m) error of the simulated rest: a share of the way, and what it has at least.
const REST_SHARE: f64 = 0.10;
const REST_LEAST: f64 = 0.5;
/// (m/s) scale of the error of a speed of zero: 1 km/h, chosen; what 49 CFR 563 lets a recorder round.
const LEAST_SPEED_ERROR: f64 = 1.0 / 3.6;
/// (–) a range that is more than this share of its speed is the error of the speed, not of its logarithm.
const WIDE_RANGE: f64 = 0.5;
/// (–) of the logarithm of a coefficient of the impact without a range: of e as in the field, of the friction
/// chosen.
const RESTITUTION_LN_SD: f64 = FITTED.restitution[3];
const FRICTION_LN_SD: f64 = FITTED.friction[1];
/// (–) where a side met a side the severity of the field is not known, as it had five such vehicles: its
/// spread is taken as so many times that of all others.
const SIDESWIPE_SPREAD: f64 = 2.0;
/// (%) probability before the evidence that a vehicle stood.
const STOOD: f64 = 20.0;
/// (rad) error of the heading at rest: a quarter of the turn, between 5° and 15°.
const REST_HEADING: [f64; 2] = [5.0 * DEGREE, 15.0 * DEGREE];
const REST_TURN_SHARE: f64 = 0.25;
/// (–) error of a recorder's ΔV, of its logarithm, and of its speed.
const RECORDER_DELTA_V: f64 = crate::thresholds::RECORDER_DELTA_V_ERROR;
const RECORDER_SPEED: f64 = crate::thresholds::RECORDER_SPEED_ERROR;
/// (–) standard error of the mean of the crush misfit, which is part of the error of a single case.
const CRUSH_BIAS_ERROR: f64 = 0.15;
/// (rad) half of the hour of a clock as a standard deviation, 30°/√12.
const HOUR_SD: f64 = 30.0 * DEGREE / 3.464_101_615_137_754_6;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// A number that is unknown, before the evidence.
pub(super) struct Before {
    pub(super) key: String,
    pub(super) unit: Option<&'static Unit>,
    pub(super) prior: Distribution,
    /// The same of a speed of a vehicle that does not stand; `None` of every other number.
    pub(super) moving: Option<Distribution>,
    pub(super) assumed: Option<Assumed>,
}

/// What an estimate begins with.
pub(super) struct Setup {
    pub(super) prior: Prior,
    pub(super) impacts: CaseImpacts,
    pub(super) observed: Observed,
    pub(super) unknown: Vec<Before>,
    pub(super) default_errors: Vec<String>,
    pub(super) unused: Vec<Unused>,
    /// (–) probability before the evidence that each vehicle stood; 0 where it is certain that it moved, and
    /// where its speed is known.
    pub(super) stood: [f64; 2],
    /// How the crush energy of each vehicle was obtained, where it is evidence.
    pub(super) energies: [Option<EnergyMethod>; 2],
    /// (rad) PDOF of both vehicles if the force were normal to the crush plane.
    pub(super) reference: [f64; 2],
}

/// The unknown numbers as they are found.
#[derive(Default)]
struct Unknowns(Vec<Before>);

impl Unknowns {
    fn push(
        &mut self,
        key: &str,
        unit: Option<&'static Unit>,
        prior: Distribution,
        assumed: Option<Assumed>,
    ) -> usize {
        self.0.push(Before { key: key.to_owned(), unit, prior, moving: None, assumed });
        self.0.len() - 1
    }

    fn assumed(
        &mut self,
        key: &str,
        prior: Result<Distribution, ::uncertainty::InvalidDistribution>,
        assumed: Assumed,
    ) -> Result<usize, Failure> {
        Ok(self.push(key, None, of_number(key, prior)?, Some(assumed)))
    }
}

pub(super) fn of(case: &Case, prior: Option<Prior>) -> Result<Setup, Failure> {
    let given = case.estimate.unwrap_or_default();
    let prior = prior.unwrap_or(given.prior);
    let (mut case, sought, mut unused) = with_all_speeds(case);
    let lacking = |faults: Faults| faults.needed_for(Purpose::Estimate);
    let nominal = case.collision().map_err(lacking)?.collision;
    let motion = case.run_out().transpose().map_err(lacking)?;
    let ranges = match inputs(&case) {
        Ok(ranges) => ranges,
        Err(faults) if faults.list().iter().all(|fault| fault.kind == FaultKind::NothingUncertain) => {
            Vec::new()
        }
        Err(faults) => return Err(faults.into()),
    };

    let mut unknowns = Unknowns::default();
    let followed = followed(&case, motion.as_ref(), &mut unused);
    let open = Open::of(&case, &ranges);
    let slots = slots(&case, &ranges, &nominal, followed, &mut unknowns)?;
    let stood = stood(sought, &case);
    let speeds = speeds(sought, stood, prior, &case, &mut unknowns)?;
    let mut open_number = |is_open: bool, key, prior, assumed| {
        is_open.then(|| unknowns.assumed(key, prior, assumed)).transpose()
    };
    let friction =
        open_number(open.friction, "impact.tangential.friction", FITTED.any_friction(), Assumed::Friction)?;
    let tangential_share = open_number(
        open.tangential_share,
        "reconstruct.energy_basis.tangential_share",
        FITTED.any_tangential_share(),
        Assumed::TangentialShare,
    )?;
    let reference = reference(&nominal);
    let crushed = Crushed::of(&case, &nominal, &mut unused);
    let other_crush = match crushed {
        Crushed::Of(known) => {
            let [known, other] = [known, known.other()].map(|id| (id, damage(id, &nominal, reference)));
            let prior = FITTED.other_crush(other.1, known.1);
            let key = format!("{}.crush_by_{}", table(other.0), table(known.0));
            let ratio = unknowns.assumed(&key, prior, Assumed::OtherCrush)?;
            Some(OtherCrush { vehicle: other.0, ratio })
        }
        Crushed::All | Crushed::No => None,
    };
    let mut default_errors = Vec::new();
    let observed = observe(
        &case,
        prior,
        &ranges,
        &nominal,
        motion.as_ref(),
        followed,
        crushed,
        reference,
        &mut default_errors,
        &mut unused,
    );

    let law = nominal.law.at(1.0);
    let (placeholder, _) = nominal.contact.impact_with_validity(nominal.motions, &law);
    let shared = SharedEffects::of(&case);
    let variables = case.variables();
    let numbers = placed(&case, &slots);
    let skids = skids(&case, &numbers, &variables, &slots);
    let block = shared.is_empty().then(|| block(&numbers, &variables, &slots, speeds)).flatten();
    case.uncertainty = Default::default();
    case.title = None;
    case.source = None;
    case.report = Default::default();
    for vehicle in &mut case.vehicles {
        vehicle.name = None;
    }
    let shared = (!shared.is_empty()).then_some(shared);
    let motion = shared.is_none().then(|| of_motion(&case, &variables, &slots));
    let impact = Varied { case, slots, shared };
    let impacts = CaseImpacts {
        impact,
        motion,
        speeds,
        friction,
        tangential_share,
        other_crush,
        skids,
        placeholder,
        followed,
        block,
        unknown: Independent(unknowns.0.iter().map(|unknown| unknown.prior).collect()),
    };
    let energies = energies(crushed, &impacts.impact.case);
    Ok(Setup {
        prior,
        impacts,
        observed,
        unknown: unknowns.0,
        default_errors,
        unused,
        stood,
        energies,
        reference,
    })
}

/// What of a case its motion after the impact needs: each particle that is followed copies it.
fn of_motion(case: &Case, variables: &[Input], slots: &[Slot]) -> Varied {
    let mut case = case.clone();
    case.impact = None;
    case.reconstruct = None;
    case.site_plan = None;
    for vehicle in &mut case.vehicles {
        // Where the contact point is placed on the damage, the motion begins by it.
        if !vehicle.places_contact() {
            vehicle.crush = None;
        }
        vehicle.energy = None;
        vehicle.before = None;
        vehicle.recorder = None;
        vehicle.certain_speed = None;
    }
    let slot = |input: &Input| {
        let place = variables.iter().position(|variable| variable.path == input.path);
        place.and_then(|place| slots.get(place)).copied().unwrap_or(Slot::Given)
    };
    let slots = case.variables().iter().map(slot).collect();
    Varied { case, slots, shared: None }
}

/// The case with the places of its unknown numbers.
fn placed(case: &Case, slots: &[Slot]) -> Case<Number> {
    let mut places = slots.iter();
    case.map_numbers(|number| match places.next() {
        Some(Slot::Value(place)) => Number::Uncertain(*place),
        _ => Number::Known(number),
    })
}

/// The skid marks of each vehicle.
fn skids(
    case: &Case,
    numbers: &Case<Number>,
    variables: &[Input],
    slots: &[Slot],
) -> [Option<SkidNumbers>; 2] {
    let factor = |path: &str| {
        let place = variables.iter().position(|input| input.path == path)?;
        if let Some(Slot::Factor(place)) = slots.get(place) { Some(*place) } else { None }
    };
    VehicleId::ALL.map(|id| {
        let skid = numbers.vehicles[id.index()].before?.skid;
        let (friction, path) = match (skid.friction, &numbers.surface) {
            (Some(friction), _) => (friction, skid_friction(id)),
            (None, Some(surface)) => (surface.friction, "surface.friction".to_owned()),
            (None, None) => return None,
        };
        let length = match skid.begin {
            SkidBegin::Length(length) => Some(length),
            SkidBegin::From(_) => {
                let at = |key: &str| format!("{}.{key}.", table(id));
                let places = [at("position"), at("before.skid.from")];
                let is_place = |path: &str| places.iter().any(|place| path.starts_with(place));
                let mut ends = variables.iter().zip(slots).filter(|(input, _)| is_place(&input.path));
                let is_known = case.vehicles[id.index()].position.is_some()
                    && ends.all(|(_, slot)| *slot == Slot::Given);
                let length = Quantity::from_si(case.skids()[id.index()]?.length, Dimension::Length).ok()?;
                is_known.then(|| length.with(Number::Known(length.number())))
            }
        };
        Some(SkidNumbers { length, friction, factor: factor(&path) })
    })
}

/// The key of the friction on the path of a vehicle.
fn path_friction(id: VehicleId) -> String {
    format!("{}.after.friction", table(id))
}

/// The key of the friction under a skid.
fn skid_friction(id: VehicleId) -> String {
    format!("{}.before.skid.friction", table(id))
}

/// The case for a block of particles at once.
fn block(numbers: &Case<Number>, variables: &[Input], slots: &[Slot], speeds: OpenSpeeds) -> Option<Block> {
    let enters = |(input, slot): &(&Input, &Slot)| **slot != Slot::Given && !is_beside(&input.path);
    let unknown = variables.iter().zip(slots).filter(enters).count();
    Block::new(numbers, speeds, unknown)
}

/// Whether a number is of the motion before or after the impact alone.
fn is_beside(path: &str) -> bool {
    let of_chassis = [".wheelbase", ".track", ".cg_to_front_axle"];
    of_chassis.iter().any(|key| path.ends_with(key))
        || [
            "scene.",
            "surface.",
            "vehicle1.after.",
            "vehicle2.after.",
            "vehicle1.before.",
            "vehicle2.before.",
            "vehicle1.position.",
            "vehicle2.position.",
        ]
        .iter()
        .any(|table| path.starts_with(table))
}

/// The case with a speed for every vehicle, and whose speed is sought.
fn with_all_speeds(case: &Case) -> (Case, [bool; 2], Vec<Unused>) {
    let mut case = case.clone();
    let mut unused = Vec::new();
    if case.locked_together {
        unused.push(Unused { key: "scene.locked_together".to_owned(), reason: UnusedReason::OneWreck });
    }
    let find = case.reconstruct.map(|reconstruct| reconstruct.find);
    let mut sought = [false; 2];
    for id in VehicleId::ALL {
        let vehicle = &mut case.vehicles[id.index()];
        if vehicle.fixed || vehicle.is_absent() {
            continue;
        }
        let is_sought = find.is_some_and(|find| find.seeks(id));
        let is_vector = is_sought && matches!(vehicle.motion, Some(Velocity::Vector { .. }));
        if is_vector {
            with_course(&mut case, id);
        }
        let vehicle = &mut case.vehicles[id.index()];
        if is_sought && vehicle.motion.is_some() {
            let key = if is_vector { "velocity" } else { "speed" };
            unused.push(Unused { key: format!("{}.{key}", table(id)), reason: UnusedReason::Sought });
        }
        if is_sought || vehicle.motion.is_none() {
            sought[id.index()] = true;
            vehicle.motion = Quantity::from_si(0.0, Dimension::Speed).ok().map(Velocity::Speed);
        }
    }
    let find = match sought {
        [true, true] => Some(Find::Both),
        [true, false] => Some(Find::One(Unknown::Speed1)),
        [false, true] => Some(Find::One(Unknown::Speed2)),
        [false, false] => None,
    };
    if let Some(find) = find {
        let energy_basis = case.reconstruct.map(|reconstruct| reconstruct.energy_basis);
        case.left_out.energy_basis |= energy_basis.is_none();
        case.reconstruct = Some(Reconstruct { find, energy_basis: energy_basis.unwrap_or_default() });
    }
    (case, sought, unused)
}

/// A vehicle of which a velocity tells no more than the direction in which it travelled: a sideslip has that.
fn with_course(case: &mut Case, id: VehicleId) {
    let (course, heading) = (case.course(id), case.headings()[id.index()]);
    let sideslip = course.zip(heading).map(|(course, heading)| case.axes.lateral(course - heading));
    case.vehicles[id.index()].sideslip =
        sideslip.and_then(|sideslip| Quantity::from_si(sideslip, Dimension::Angle).ok());
    let of_velocity = format!("{}.velocity.", table(id));
    case.ranges.retain(|range| !range.path.starts_with(&of_velocity));
}

/// Whether a number is held against the impact, and does not enter it.
fn is_observed(path: &str) -> bool {
    let of_vehicle = path.strip_prefix("vehicle1.").or_else(|| path.strip_prefix("vehicle2."));
    of_vehicle.is_some_and(|key| {
        [
            "after.rest",
            "after.points",
            "after.speed",
            "after.direction",
            "after.yaw_rate",
            "crush.pdof",
            "before.speed",
        ]
        .iter()
        .any(|observed| key.starts_with(observed))
    })
}

/// What becomes of each number of the case: those with a range are unknown, and some others are known as well
/// as they usually are.
fn slots(
    case: &Case,
    ranges: &[UncertainInput],
    nominal: &Collision,
    followed: [bool; 2],
    unknowns: &mut Unknowns,
) -> Result<Vec<Slot>, Failure> {
    let mut ranges = ranges.iter().peekable();
    let has_ground_range = case.ranges.iter().any(|range| is_ground(&range.path));
    let skids_on_it =
        |vehicle: &GivenVehicle| vehicle.before.as_ref().is_some_and(|before| before.skid.friction.is_none());
    let uses_ground = followed != [false, false] || case.vehicles.iter().any(skids_on_it);
    let mut ground = None;
    let mut drags = [None; 2];
    let mut slots = Vec::new();
    for input in case.variables() {
        let range = ranges.next_if(|range| range.input.path == input.path);
        if is_observed(&input.path) {
            slots.push(Slot::Given);
            continue;
        }
        if let Some(range) = range {
            let assumed = matches!(input.origin, Origin::Estimate(_)).then_some(Assumed::Estimate);
            let place = unknowns.push(&input.path, input.unit, range.distribution, assumed);
            slots.push(Slot::Value(place));
            continue;
        }
        if let Some(prior) = coefficient(&input, case) {
            let prior = of_number(&input.path, prior)?;
            let place = unknowns.push(&input.path, input.unit, prior, Some(Assumed::Coefficient));
            slots.push(Slot::Value(place));
            continue;
        }
        if let Some((sd, assumed)) = usual_sd(&input, case, nominal) {
            let prior = of_number(&input.path, Distribution::normal(input.number, sd / input.factor()))?;
            slots.push(Slot::Value(unknowns.push(&input.path, input.unit, prior, Some(assumed))));
            continue;
        }
        if let Some(id) = VehicleId::ALL.into_iter().find(|id| input.path == skid_friction(*id)) {
            let factor = Distribution::log_normal(1.0, GROUND_LN_SD);
            slots.push(Slot::Factor(unknowns.assumed(&skid_friction(id), factor, Assumed::Ground)?));
            continue;
        }
        if is_ground(&input.path) && uses_ground && !has_ground_range {
            let place = match ground {
                Some(place) => place,
                None => {
                    let factor = Distribution::log_normal(1.0, GROUND_LN_SD);
                    unknowns.assumed("surface.friction", factor, Assumed::Ground)?
                }
            };
            ground = Some(place);
            slots.push(Slot::Factor(place));
            continue;
        }
        let dragged = VehicleId::ALL
            .into_iter()
            .find(|id| followed[id.index()] && input.path.starts_with(&format!("{}.after.drag", table(*id))));
        if let Some(id) = dragged {
            let place = match drags[id.index()] {
                Some(place) => place,
                None => {
                    let factor = Distribution::log_normal(1.0, DRAG_LN_SD);
                    unknowns.assumed(&format!("{}.after.drag", table(id)), factor, Assumed::Drag)?
                }
            };
            drags[id.index()] = Some(place);
            slots.push(Slot::Factor(place));
            continue;
        }
        slots.push(Slot::Given);
    }
    Ok(slots)
}

fn is_ground(path: &str) -> bool {
    let of_ground = path.starts_with("surface.") && path.ends_with("friction");
    of_ground || VehicleId::ALL.into_iter().any(|id| path == path_friction(id))
}

/// What is known of a coefficient of the impact without a range: its median is the one of the case. A
/// coefficient of zero is exact, and the numbers of laws other than Brach's are meant as they stand.
fn coefficient(
    input: &Input,
    case: &Case,
) -> Option<Result<Distribution, ::uncertainty::InvalidDistribution>> {
    let ImpactLaw::Brach { moment_restitution: None, .. } = case.impact.as_ref()?.law else { return None };
    let ln_sd = match input.path.as_str() {
        "impact.restitution" => RESTITUTION_LN_SD,
        path if path.starts_with("impact.tangential") => FRICTION_LN_SD,
        _ => return None,
    };
    match input.number {
        number if number > 0.0 => Some(Distribution::log_normal(number, ln_sd)),
        // A ratio has the sign of the force.
        number if number < 0.0 => Some(Distribution::normal(number, ln_sd * number.abs())),
        _ => None,
    }
}

/// (SI) how well a number without a range is usually known, where that matters.
fn usual_sd(input: &Input, case: &Case, nominal: &Collision) -> Option<(f64, Assumed)> {
    if input.origin != Origin::Given {
        return None;
    }
    if input.path == "impact.crush_plane" {
        return Some((CRUSH_PLANE_SD, Assumed::CrushPlane));
    }
    let id = VehicleId::ALL.into_iter().find(|id| input.path.starts_with(table(*id)))?;
    let fixed = case.vehicles[id.index()].fixed;
    match input.path.split_once('.')?.1 {
        // A wall stands as the crush plane does.
        "heading" if !fixed => Some((HEADING_SD, Assumed::Heading)),
        "mass" => Some((MASS_SD, Assumed::Mass)),
        "weight" => Some((MASS_SD * inputs::STANDARD_GRAVITY, Assumed::Mass)),
        "contact.x" | "contact.y" | "contact.distance" if !fixed => Some((CONTACT_SD, Assumed::Contact)),
        "contact.angle" if !fixed => {
            let [ahead, left] = nominal.vehicles[id.index()].contact?;
            let distance = Real::sqrt(ahead * ahead + left * left);
            // δφ = δs/d, at most a right angle
            Some((Real::min(CONTACT_SD / distance, FRAC_PI_2), Assumed::Contact))
        }
        _ => None,
    }
}

/// Which vehicles are followed to the rest or the points that were measured.
fn followed(case: &Case, motion: Option<&MotionInput>, unused: &mut Vec<Unused>) -> [bool; 2] {
    VehicleId::ALL.map(|id| {
        let Some(after) = &case.vehicles[id.index()].after else { return false };
        let has_places = after.rest.is_some() || !after.points.is_empty();
        let is_followed = motion.is_some_and(|motion| motion.vehicles[id.index()].is_some());
        if has_places && !is_followed {
            unused
                .push(Unused { key: format!("{}.after.rest", table(id)), reason: UnusedReason::NotFollowed });
        }
        has_places && is_followed
    })
}

/// What the case leaves open of the impact.
struct Open {
    friction: bool,
    tangential_share: bool,
}

impl Open {
    /// `"critical"` gives no greatest impulse ratio. Laws other than Brach's are meant as they stand.
    fn of(case: &Case, ranges: &[UncertainInput]) -> Self {
        let has_range = ranges.iter().any(|range| range.input.path.starts_with("impact.tangential"));
        let law = case.impact.as_ref().map(|impact| &impact.law);
        let is_critical = matches!(
            law,
            Some(ImpactLaw::Brach { tangential: BrachTangential::Critical, moment_restitution: None, .. })
        );
        let is_said = case.reconstruct.is_some() && !case.left_out.energy_basis;
        Self { friction: is_critical && !has_range, tangential_share: !is_said }
    }
}

/// (–) the probability before the evidence that each vehicle stood. Where one stands the other has to move.
fn stood(sought: [bool; 2], case: &Case) -> [f64; 2] {
    let given = case.estimate.unwrap_or_default().stood.unwrap_or(STOOD) / 100.0;
    let may_move = |id: VehicleId| {
        let vehicle = &case.vehicles[id.index()];
        let is_known_to_stand = matches!(&vehicle.motion, Some(Velocity::Speed(speed)) if speed.si() == 0.0);
        !vehicle.fixed && (sought[id.index()] || !is_known_to_stand)
    };
    VehicleId::ALL.map(|id| {
        let vehicle = &case.vehicles[id.index()];
        let at_least = vehicle.certain_speed.and_then(|certain| certain.at_least);
        let at_most = vehicle.certain_speed.and_then(|certain| certain.at_most);
        let certainly_moved = at_least.is_some_and(|speed| speed.si() > 0.0)
            || at_most.is_some_and(|speed| speed.si() < 0.0)
            || vehicle.recorder.is_some_and(|recorder| recorder.speed.is_some());
        let may_stand = sought[id.index()] && may_move(id.other()) && !certainly_moved;
        if may_stand { given } else { 0.0 }
    })
}

fn speeds(
    sought: [bool; 2],
    stood: [f64; 2],
    prior: Prior,
    case: &Case,
    unknowns: &mut Unknowns,
) -> Result<OpenSpeeds, Failure> {
    let key = |id: VehicleId| format!("{}.speed", table(id));
    let limits = |id: VehicleId| {
        let certain = case.vehicles[id.index()].certain_speed.unwrap_or_default();
        let si = |limit: Option<Quantity>| limit.as_ref().map(Quantity::si);
        let (least, most) = (si(certain.at_least), si(certain.at_most));
        let fault = |of: &str, reason: String, advice: String| {
            let kind = FaultKind::Refused { reason };
            let key = format!("{}.certain_speed.{of}", table(id));
            Failure::Case(Fault { key, kind, advice: Some(advice) }.into())
        };
        if let Some(least) = least.filter(|least| *least >= FASTEST) {
            return Err(fault(
                "at_least",
                format!(
                    "{:.0} km/h is faster than any speed that is thought of, {:.0} km/h",
                    3.6 * least,
                    3.6 * FASTEST
                ),
                "check its unit".to_owned(),
            ));
        }
        if least.is_none() && most == Some(0.0) {
            return Err(fault(
                "at_most",
                "a speed of at most 0 says that the vehicle stood, or that it moved backward".to_owned(),
                format!(
                    "write speed = \"0 km/h\" in [{}] if it stood, and give at_least, such as \"-20 km/h\", if it moved backward",
                    table(id)
                ),
            ));
        }
        let (least, most) = (least.unwrap_or(0.0), most.unwrap_or(FASTEST));
        // A limit below a standstill says that the vehicle may have moved backward.
        Ok([if most <= least { most - FASTEST } else { least }, most])
    };
    let [limits1, limits2] = VehicleId::ALL.map(limits);
    let limits = [limits1?, limits2?];
    let mut alone = |id: VehicleId| {
        let [least, most] = limits[id.index()];
        let stood = if least <= 0.0 && most > 0.0 { stood[id.index()] } else { 0.0 };
        // p = w/(w + v_max − v_min)
        let standing = (most - least) * stood / (1.0 - stood);
        let place =
            unknowns.assumed(&key(id), Distribution::uniform(least, most + standing), Assumed::Speed)?;
        unknowns.0[place].moving = Some(of_number(&key(id), Distribution::uniform(least, most))?);
        Ok::<_, Failure>(Alone { place, standing })
    };
    Ok(match sought {
        [false, false] => OpenSpeeds::None,
        [true, false] => OpenSpeeds::One(VehicleId::One, alone(VehicleId::One)?),
        [false, true] => OpenSpeeds::One(VehicleId::Two, alone(VehicleId::Two)?),
        [true, true] => {
            let backward = limits.iter().any(|[least, _]| *least < 0.0);
            if prior == Prior::Flat || backward {
                OpenSpeeds::Each([alone(VehicleId::One)?, alone(VehicleId::Two)?])
            } else {
                OpenSpeeds::Together(Speeds::Together {
                    ln_relative: unknowns.assumed(
                        "ln_relative_speed",
                        Speeds::any_ln_relative(),
                        Assumed::Speed,
                    )?,
                    split: unknowns.assumed(
                        "speed_split",
                        Speeds::split_with_standing(stood),
                        Assumed::Speed,
                    )?,
                })
            }
        }
    })
}

/// How the crush energy of each vehicle was obtained whose crush is evidence.
fn energies(crushed: Crushed, case: &Case) -> [Option<EnergyMethod>; 2] {
    VehicleId::ALL.map(|id| {
        let is_evidence = match crushed {
            Crushed::No => false,
            Crushed::Of(known) => known == id,
            Crushed::All => true,
        };
        let vehicle = &case.vehicles[id.index()];
        let by_depths = vehicle.crush.as_ref().map(|crush| match crush.stiffness {
            StiffnessForm::Line(_) | StiffnessForm::Zones(_) => EnergyMethod::Coefficients,
            StiffnessForm::Category(_) => EnergyMethod::Class,
            StiffnessForm::Test(_) => EnergyMethod::Test,
        });
        let by_speed = matches!(vehicle.energy, Some(KnownEnergy::Ees(_))).then_some(EnergyMethod::Ees);
        by_depths.or(by_speed).filter(|_| is_evidence && !vehicle.fixed)
    })
}

/// How far the crush energies are off, by how each was obtained; with what the case gives instead.
fn crush_errors(
    case: &Case,
    methods: [Option<EnergyMethod>; 2],
    ranges: &[UncertainInput],
    hit: &[Damage],
    default_errors: &mut Vec<String>,
) -> CrushErrors {
    let given = case.estimate.unwrap_or_default();
    if given.crush_error.is_none() {
        default_errors.push("estimate.crush_error".to_owned());
    }
    if given.crush_bias.is_none() {
        default_errors.push("estimate.crush_bias".to_owned());
    }
    let of = |id: VehicleId| {
        let method = methods[id.index()]?;
        let has_range = ranges.iter().any(|range| {
            let of_crush = range.input.path.strip_prefix(&format!("{}.crush.", table(id)));
            of_crush.is_some_and(|key| key.starts_with("stiffness") || key.starts_with("ees"))
        });
        let usual = FITTED.energy_error(method, hit, has_range);
        let shared = match method {
            // The mean of the misfit has an error, too.
            EnergyMethod::Class => {
                Real::sqrt(usual.shared_ln_sd * usual.shared_ln_sd + CRUSH_BIAS_ERROR * CRUSH_BIAS_ERROR)
            }
            _ => usual.shared_ln_sd,
        };
        Some(EnergyError {
            bias: given.crush_bias.map_or(usual.bias, |shown| real::elementary::ln(shown / 100.0)),
            shared_ln_sd: given.crush_error.map_or(shared, |percent| percent / 100.0),
            own_ln_sd: if given.crush_error.is_some() { 0.0 } else { usual.own_ln_sd },
        })
    };
    match [of(VehicleId::One), of(VehicleId::Two)] {
        [Some(one), Some(two)] => CrushErrors([one, two]),
        // The energy of the other vehicle is told by that of this one, with all its errors.
        [Some(known), None] | [None, Some(known)] => {
            let EnergyError { bias, shared_ln_sd, own_ln_sd } = known;
            let whole = Real::sqrt(shared_ln_sd * shared_ln_sd + own_ln_sd * own_ln_sd);
            CrushErrors([EnergyError { bias, shared_ln_sd: whole, own_ln_sd: 0.0 }; 2])
        }
        [None, None] => FITTED.crush_misfit(hit).into(),
    }
}

/// A speed (m/s) that was measured with the range of the case, of which `sd` (m/s) is the standard deviation,
/// or without one with a `share` of the speed.
fn measured_speed(value: f64, sd: Option<f64>, share: f64) -> MeasuredSpeed {
    match sd {
        None => MeasuredSpeed { value, ln_sd: share, least: LEAST_SPEED_ERROR },
        Some(sd) if sd <= WIDE_RANGE * value => MeasuredSpeed { value, ln_sd: sd / value, least: 0.0 },
        Some(sd) => MeasuredSpeed { value, ln_sd: 0.0, least: sd },
    }
}

/// (rad) PDOF of both vehicles if the force were normal to the crush plane.
fn reference(nominal: &Collision) -> [f64; 2] {
    let normal = nominal.contact.normal();
    // The force on vehicle 1 acts along n, that on vehicle 2 against it.
    let from = |id: VehicleId, sign: f64| {
        let forward = nominal.contact.participants()[id.index()].forward();
        let along = -sign * (normal.x * forward.x + normal.y * forward.y);
        let left = -sign * (normal.y * forward.x - normal.x * forward.y);
        // Clockwise from the heading.
        real::principal_angle(-real::elementary::atan2(left, along))
    };
    [from(VehicleId::One, 1.0), from(VehicleId::Two, -1.0)]
}

#[expect(clippy::too_many_arguments, reason = "a step of `of`, which has them all")]
fn observe(
    case: &Case,
    prior: Prior,
    ranges: &[UncertainInput],
    nominal: &Collision,
    motion: Option<&MotionInput>,
    followed: [bool; 2],
    crushed: Crushed,
    reference: [f64; 2],
    default_errors: &mut Vec<String>,
    unused: &mut Vec<Unused>,
) -> Observed {
    let given = case.estimate.unwrap_or_default();
    // (SI)
    let sd_of = |key: &str| {
        let range = ranges.iter().find(|range| range.input.path == key)?;
        Some(range.distribution.sd() * range.input.factor())
    };
    let mut vehicles = [ObservedVehicle::default(), ObservedVehicle::default()];
    for id in VehicleId::ALL {
        let vehicle = &case.vehicles[id.index()];
        let data = &nominal.vehicles[id.index()];
        let key = |of: &str| format!("{}.{of}", table(id));
        let mut defaulted = |is_default: bool, key: String| {
            if is_default {
                default_errors.push(key);
            }
        };
        let observed = &mut vehicles[id.index()];
        observed.skid_speed = vehicle.before.and_then(|before| before.speed).map(|speed| {
            let sd = sd_of(&key("before.speed"));
            defaulted(sd.is_none(), key("before.speed"));
            measured_speed(speed.si(), sd, RECORDER_SPEED)
        });
        if let Some(after) = &vehicle.after {
            let lateral = |quantity: &Quantity| case.axes.lateral(quantity.si());
            observed.after.speed = after.speed.as_ref().map(|speed| {
                let sd = sd_of(&key("after.speed"));
                defaulted(sd.is_none(), key("after.speed"));
                measured_speed(speed.si(), sd, SPEED_AFTER_ERROR)
            });
            // A vehicle that stands leaves in no direction.
            let leaves = after.speed.as_ref().is_none_or(|speed| speed.si() > 0.0);
            observed.after.direction = after.direction.as_ref().filter(|_| leaves).map(|direction| {
                let sd = sd_of(&key("after.direction"));
                defaulted(sd.is_none(), key("after.direction"));
                Measured { value: lateral(direction), sd: sd.unwrap_or(DIRECTION_AFTER_ERROR) }
            });
            if after.direction.is_some() && !leaves {
                unused.push(Unused { key: key("after.direction"), reason: UnusedReason::NoDirection });
            }
            observed.after.yaw_rate = after.yaw_rate.as_ref().map(|rate| {
                let (value, sd) = (lateral(rate), sd_of(&key("after.yaw_rate")));
                defaulted(sd.is_none(), key("after.yaw_rate"));
                Measured { value, sd: sd.unwrap_or(yaw_rate_error(value)) }
            });
        }
        if let Some(way) =
            motion.filter(|_| followed[id.index()]).and_then(|motion| motion.vehicles[id.index()].as_ref())
        {
            let share = given.rest_error.map_or(REST_SHARE, |percent| percent / 100.0);
            let least = given.rest_least_error.as_ref().map_or(REST_LEAST, Quantity::si);
            let far = |place: pim_core::Vector2<f64>| least + share * (place - way.position).norm();
            // Survey and model together.
            let both = |model: f64, [x, y]: [f64; 2]| Real::sqrt(model * model + 0.5 * (x * x + y * y));
            observed.rest = way.rest.as_ref().map(|rest| {
                let surveyed = ["after.rest.x", "after.rest.y"].map(|of| sd_of(&key(of)).unwrap_or_default());
                let model = far(rest.position);
                let heading = rest.heading.heading(way.heading);
                let turns_are_known = rest.heading.turns_are_known();
                let turned = heading - way.heading;
                let turned = if turns_are_known { turned } else { real::principal_angle(turned) };
                let [least, most] = REST_HEADING;
                let usual = Real::min(Real::max(REST_TURN_SHARE * turned.abs(), least), most);
                let model_heading = given.rest_heading_error.as_ref().map_or(usual, Quantity::si);
                let own = [key("after.rest.heading"), key("after.rest.turned")]
                    .iter()
                    .find_map(|key| sd_of(key))
                    .unwrap_or_default();
                let apart = rest.position - way.position;
                MeasuredRest {
                    position: rest.position,
                    direction: real::elementary::atan2(apart.y, apart.x),
                    position_sd: both(model, surveyed),
                    heading,
                    turns_are_known,
                    heading_sd: Real::sqrt(model_heading * model_heading + own * own),
                }
            });
            observed.points = way
                .points
                .iter()
                .enumerate()
                .map(|(place, point)| {
                    let surveyed = ["x", "y"].map(|of| {
                        sd_of(&key(&format!("after.points[{}].{of}", place + 1))).unwrap_or_default()
                    });
                    both(far(point.position), surveyed)
                })
                .collect();
            let keys = [
                (given.rest_error.is_none(), "estimate.rest_error"),
                (given.rest_least_error.is_none(), "estimate.rest_least_error"),
                (given.rest_heading_error.is_none() && way.rest.is_some(), "estimate.rest_heading_error"),
            ];
            for (is_default, key) in keys {
                if is_default && !default_errors.iter().any(|defaulted| defaulted == key) {
                    default_errors.push(key.to_owned());
                }
            }
        }
        observed.pdof = coded_pdof(data, vehicle).map(|coded| match sd_of(&key("crush.pdof")) {
            Some(scale) => CodedPdof { scale, ..coded },
            None => {
                default_errors.push(key("crush.pdof"));
                coded
            }
        });
        if let Some(recorder) = &vehicle.recorder {
            let is_side = damage(id, nominal, reference) == Damage::Side;
            observed.recorder = recorded(recorder, is_side, case, &key, default_errors);
        }
        if let Some(certain) = &vehicle.certain_speed {
            let si = |limit: &Option<Quantity>, none: f64| limit.as_ref().map_or(none, Quantity::si);
            observed.limits = Limits {
                least: si(&certain.at_least, f64::NEG_INFINITY),
                most: si(&certain.at_most, f64::INFINITY),
            };
        }
    }
    if let [Some(one), Some(two)] = vehicles.each_ref().map(|vehicle| vehicle.pdof) {
        let id = if one.scale <= two.scale { VehicleId::Two } else { VehicleId::One };
        let key = format!("{}.crush.pdof", table(id));
        default_errors.retain(|defaulted| *defaulted != key);
        unused.push(Unused { key, reason: UnusedReason::OtherPdof });
    }
    let hit: Vec<Damage> = movers(case).map(|id| damage(id, nominal, reference)).collect();
    let usual = FITTED.severity_of(&hit);
    let median = given.delta_v_median.as_ref().map_or(usual.median, Quantity::si);
    let times = if hit == [Damage::Side; 2] { SIDESWIPE_SPREAD } else { 1.0 };
    let severity = Severity { median, ln_sd: usual.ln_sd * times, ..usual };
    let crush = (crushed != Crushed::No)
        .then(|| crush_errors(case, energies(crushed, case), ranges, &hit, default_errors));
    Observed { vehicles, severity: (prior == Prior::Field).then_some(severity), crush }
}

/// The PDOF that the case gives for a vehicle itself.
fn coded_pdof(data: &VehicleData, vehicle: &GivenVehicle) -> Option<CodedPdof> {
    let pdof = data.pdof().filter(|_| !data.pdof_follows())?;
    let of_crush = vehicle.crush.as_ref().map(|crush| crush.side);
    let side = of_crush.or_else(|| data.energy.and_then(|energy| energy.side));
    let is_side = matches!(side, Some(Side::Left | Side::Right));
    let coded = FITTED.coded(pdof, is_side);
    let hour = if data.pdof_is_hour() { HOUR_SD } else { 0.0 };
    Some(CodedPdof { scale: Real::sqrt(coded.scale * coded.scale + hour * hour), ..coded })
}

/// (rad/s) the usual error of a yaw rate after the impact (rad/s).
fn yaw_rate_error(rate: f64) -> f64 {
    Real::max(YAW_RATE_SHARE * rate.abs(), YAW_RATE_LEAST)
}

fn recorded(
    recorder: &inputs::Recorder,
    is_side: bool,
    case: &Case,
    key: &dyn Fn(&str) -> String,
    default_errors: &mut Vec<String>,
) -> Recorder {
    let mut or_default = |of: &str, given: Option<f64>, default: f64| {
        given.unwrap_or_else(|| {
            default_errors.push(key(of));
            default
        })
    };
    let share = |percent: Option<f64>| percent.map(|percent| percent / 100.0);
    let (mut delta_v, mut longitudinal) = (None, None);
    if let Some(along) = recorder.delta_v_longitudinal.as_ref().map(Quantity::si) {
        let ln_scale = or_default("recorder.delta_v_error", share(recorder.delta_v_error), RECORDER_DELTA_V);
        let (least, freedom) = (LEAST_SPEED_ERROR, Freedom::Three);
        match recorder.delta_v_lateral.as_ref().map(Quantity::si) {
            Some(across) => {
                let size = Real::sqrt(along * along + across * across);
                delta_v = Some(RecordedDeltaV { size, is_longitudinal: false, ln_scale, least, freedom });
            }
            None => longitudinal = Some(RecordedPart { along, ln_scale, least, freedom }),
        }
    }
    let both = recorder.delta_v_longitudinal.zip(recorder.delta_v_lateral);
    let direction = both.filter(|(along, across)| along.si() != 0.0 || across.si() != 0.0).map(|parts| {
        let (along, left) = (parts.0.si(), case.axes.lateral(parts.1.si()));
        // Away from where the force came from; clockwise from the heading.
        let shown = FITTED.recorded_direction(real::elementary::atan2(left, -along), is_side);
        let given = recorder.direction_error.as_ref().map(Quantity::si);
        CodedPdof { scale: or_default("recorder.direction_error", given, shown.scale), ..shown }
    });
    let speed = recorder.speed.as_ref().map(|speed| MeasuredSpeed {
        value: speed.si(),
        ln_sd: or_default("recorder.speed_error", share(recorder.speed_error), RECORDER_SPEED),
        least: LEAST_SPEED_ERROR,
    });
    let yaw_rate = recorder.yaw_rate.as_ref().map(|rate| {
        let value = case.axes.lateral(rate.si());
        let given = recorder.yaw_rate_error.as_ref().map(Quantity::si);
        Measured { value, sd: or_default("recorder.yaw_rate_error", given, yaw_rate_error(value)) }
    });
    Recorder { delta_v, longitudinal, direction, speed, yaw_rate }
}

/// Whose crush is evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Crushed {
    /// Nobody's, or there is no damage.
    No,
    /// That of one vehicle that moves, where another moves, too.
    Of(VehicleId),
    /// That of all vehicles that move.
    All,
}

impl Crushed {
    fn of(case: &Case, nominal: &Collision, unused: &mut Vec<Unused>) -> Self {
        let is_inferred = |id: VehicleId| {
            case.vehicles[id.index()].crush.as_ref().is_some_and(|crush| crush.from_force_balance)
        };
        let movers: Vec<VehicleId> = movers(case).collect();
        let inferred = movers.iter().filter(|id| is_inferred(**id));
        unused.extend(
            inferred
                .map(|id| Unused { key: format!("{}.crush", table(*id)), reason: UnusedReason::Inferred }),
        );
        let is_known = |id: &VehicleId| case.vehicles[id.index()].has_damage_data() && !is_inferred(*id);
        let known: Vec<VehicleId> = movers.iter().copied().filter(is_known).collect();
        let Ok(assessed) = damage::assess(nominal.vehicles.clone(), [None, None]) else {
            return Self::No;
        };
        let energy = |id: &VehicleId| assessed[id.index()].crush_energy().unwrap_or_default();
        if known.iter().map(energy).sum::<f64>() <= 0.0 {
            let is_given =
                |id: &&VehicleId| !matches!(case.vehicles[id.index()].energy, Some(KnownEnergy::Undamaged));
            unused.extend(
                known.iter().filter(is_given).map(|id| Unused {
                    key: format!("{}.crush", table(*id)),
                    reason: UnusedReason::NoEnergy,
                }),
            );
            return Self::No;
        }
        match known[..] {
            [one] if movers.len() > 1 => Self::Of(one),
            _ => Self::All,
        }
    }
}

/// The vehicles that can move.
fn movers(case: &Case) -> impl Iterator<Item = VehicleId> {
    VehicleId::ALL.into_iter().filter(|id| !case.vehicles[id.index()].fixed)
}

/// Where a vehicle was hit: the side that the case gives or, without one, the side that the line at right
/// angles to the crush plane meets.
fn damage(id: VehicleId, nominal: &Collision, reference: [f64; 2]) -> Damage {
    let data = &nominal.vehicles[id.index()];
    let of_crush = data.damage.as_ref().map(|damage| damage.side);
    let side = of_crush.or_else(|| data.energy.and_then(|energy| energy.side));
    match side {
        Some(side) => side.into(),
        None => match reference[id.index()].abs() {
            from if from <= 45.0 * DEGREE => Damage::Front,
            from if from < 135.0 * DEGREE => Damage::Side,
            _ => Damage::Rear,
        },
    }
}
