//! From a case to its unknown numbers and its evidence.

use std::f64::consts::{FRAC_PI_2, TAU};

use ::estimate::Independent;
use ::uncertainty::normal::cumulative;
use ::uncertainty::{Distribution, InvalidDistribution};
use evidence::{DamagedSide, EnergyMethod, FITTED, Observed, OtherCrush, Speeds};
use inputs::{
    Amount, Bounds, BrachTangential, Case, CollisionData, Dimension, Fault, FaultKind, Faults, Find,
    GivenVehicle, ImpactLaw, Input, MotionInput, Origin, Purpose, Quantity, Range, Reconstruct,
    RecordersSpeed, Restitution, SeverityPrior, SharedEffects, SkidBegin, Spread, Unit, VehicleKind,
    Velocity, YawForm, table,
};
use pim_core::VehicleId;
use real::Real;
use real::elementary::ln;

use super::MISSED;
use super::block::Block;
use super::impacts::{CaseImpacts, SkidNumbers, Slot, Varied};
use super::notes::{Unused, UnusedReason};
use super::observe::{Crushed, LEAST_SPEED_ERROR, Scene, damage, energies, observe};
use super::of_number;
use super::outputs;
use super::posed::{Alone, OpenSpeeds};
use crate::columns::Number;
use crate::errors::{fitted, is_with_object};
use crate::failure::Failure;
use crate::given::{certain_limits, speed_limits, with_sideslip};
use crate::normal_force::reference;
use crate::phases::speed_at_impact;
use crate::recorded::{RecordsOfImpact, has_pdof, with_records_of_impact};
use crate::thresholds::FASTEST_BELIEVED;
use crate::uncertainty::{UncertainInput, any_inputs, inputs};
use crate::unsolved;
use crate::warning::Warning;

/// The reason for the distribution of a number, if the case does not give it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Assumed {
    /// The usual uncertainty of a heading.
    Heading,
    /// The usual uncertainty of a crush plane.
    CrushPlane,
    /// The usual uncertainty of a contact point.
    Contact,
    /// The usual uncertainty of a mass: Smith and Noga 1982.
    Mass,
    /// The usual uncertainty of the mass of a truck or trailer with its load.
    Load,
    /// A value from a table or a formula, as varied by `uncertainty`.
    Estimate,
    /// Speeds without evidence.
    Speed,
    /// A coefficient of the impact given without a range, with the spread of such collisions.
    Coefficient,
    /// The largest impulse ratio, if the case does not give it.
    Friction,
    /// λ.
    TangentialShare,
    /// The crush energy of a vehicle from that of the other, as in real crashes.
    OtherCrush,
    /// The usual uncertainty of the friction of the ground.
    Ground,
    /// The usual uncertainty of the drag of wheels.
    Drag,
}

/// (rad) standard deviation of a heading without a range: 2°.
const HEADING_SD: f64 = 2.0 * DEGREE;
/// (rad) standard deviation of a crush plane without a range: 5°.
const CRUSH_PLANE_SD: f64 = 5.0 * DEGREE;
/// (m) standard deviation of a contact point without a range, in each direction.
const CONTACT_SD: f64 = 0.10;
/// (kg) standard deviation of a mass without a range: 65 lb, Smith and Noga, SAE 821169 (1982).
const MASS_SD: f64 = 65.0 * 0.453_592_37;
/// (–) standard deviation of the mass of a truck or trailer without a range, as a share of it: few loads are
/// weighed.
const LOAD_SHARE: f64 = 0.05;
/// (–) standard deviation of the logarithm of the friction of the ground.
const GROUND_LN_SD: f64 = 0.10;
/// (–) standard deviation of the logarithm of the drag of a vehicle's wheels.
const DRAG_LN_SD: f64 = 0.30;
/// (–) standard deviation of the logarithm of a coefficient of the impact without a range: for e, that of the
/// field; for the friction, a choice.
const RESTITUTION_LN_SD: f64 = FITTED.restitution[3];
const FRICTION_LN_SD: f64 = FITTED.friction[1];
/// (%) probability before the evidence that a vehicle stood still.
const STOOD: f64 = 20.0;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// An unknown number, before the evidence.
pub(super) struct Before {
    pub(super) key: String,
    pub(super) unit: Option<&'static Unit>,
    pub(super) prior: Distribution,
    /// The distribution of the speed of a vehicle that does not stand still; `None` for every other number.
    pub(super) moving: Option<Distribution>,
    pub(super) assumed: Option<Assumed>,
}

/// The starting point of an estimate.
pub(super) struct Setup {
    pub(super) prior: SeverityPrior,
    pub(super) impacts: CaseImpacts,
    pub(super) observed: Observed,
    pub(super) unknown: Vec<Before>,
    pub(super) default_errors: Vec<String>,
    pub(super) unused: Vec<Unused>,
    /// (–) probability before the evidence that each vehicle stood still; 0 if it certainly moved, and if its
    /// speed is known.
    pub(super) stood: [f64; 2],
    /// How the crush energy of each vehicle was obtained, if it is evidence.
    pub(super) energies: [Option<EnergyMethod>; 2],
    /// Where both vehicles were hit, if both move and neither speed is known.
    pub(super) hit: Option<[DamagedSide; 2]>,
    /// Whether the front of a vehicle met a fixed object.
    pub(super) is_at_object: bool,
    /// Whether a speed is unknown.
    pub(super) seeks_speed: bool,
    /// The warnings that need no answer.
    pub(super) warnings: Vec<Warning>,
}

/// A distribution before the evidence, unless its numbers are invalid.
type CheckedPrior = Result<Distribution, InvalidDistribution>;

/// The unknown numbers, in the order in which they are found.
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

    fn assumed(&mut self, key: &str, prior: CheckedPrior, assumed: Assumed) -> Result<usize, Failure> {
        Ok(self.push(key, None, of_number(key, prior)?, Some(assumed)))
    }

    fn speed(&mut self, key: &str, prior: CheckedPrior) -> Result<usize, Failure> {
        self.assumed(key, prior, Assumed::Speed)
    }
}

pub(super) fn of(case: &Case, prior: Option<SeverityPrior>) -> Result<Setup, Failure> {
    crate::recorded::is_read(case)?;
    let RecordsOfImpact { case, aside, uncertain } = with_records_of_impact(case);
    let case = case.as_ref();
    let given = case.estimate.unwrap_or_default();
    let prior = prior.unwrap_or(given.prior);
    let (mut case, sought, mut unused) = with_all_speeds(case)?;
    leave_out_no_moment(&mut case);
    unused.extend(aside.into_iter().map(|key| Unused { key, reason: UnusedReason::OtherImpact }));
    let lacking = |faults: Faults| faults.needed_for(Purpose::Estimate);
    let nominal = case.collision().map_err(lacking)?.collision;
    let mut warnings = unsolved::warnings(&case, Some(&nominal));
    // Its rest position is not used, which the list of unused evidence states.
    warnings.retain(|warning| !matches!(warning, Warning::WreckAlone { .. }));
    warnings.extend(uncertain.into_iter().map(Warning::from));
    let motion = case.run_out().transpose().map_err(lacking)?;
    let ranges = match inputs(&case) {
        Ok(ranges) => ranges,
        Err(faults) if faults.list().iter().all(|fault| fault.kind == FaultKind::NothingUncertain) => {
            Vec::new()
        }
        Err(faults) => return Err(faults.into()),
    };

    let mut unknowns = Unknowns::default();
    let (followed, unfollowed) = followed(&case, motion.as_ref());
    unused.extend(unfollowed);
    let open = Open::of(&case, &ranges);
    let slots = slots(&case, &ranges, &nominal, followed, &mut unknowns)?;
    let stood = stood(sought, &case);
    if stood == [0.0; 2] && given.stood.is_some_and(|percent| percent > 0.0) {
        unused.push(Unused { key: "estimate.stood".to_owned(), reason: UnusedReason::NoneStood });
    }
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
    let (crushed, uncrushed) = Crushed::of(&case, &nominal);
    unused.extend(uncrushed);
    let other_crush = match crushed {
        Crushed::Of(known) => {
            let [known, other] = [known, known.other()].map(|id| (id, damage(id, &nominal, reference)));
            let method = energies(crushed, &case)[known.0.index()];
            let prior = fitted(method, &[known.1, other.1]).other_crush(other.1, known.1);
            let key = format!("{}.crush_by_{}", table(other.0), table(known.0));
            let ratio = unknowns.assumed(&key, prior, Assumed::OtherCrush)?;
            Some(OtherCrush { vehicle: other.0, ratio })
        }
        Crushed::All | Crushed::No => None,
    };
    let hit = (sought == [true; 2]).then(|| VehicleId::ALL.map(|id| damage(id, &nominal, reference)));
    let hit_of_movers: Vec<DamagedSide> = VehicleId::ALL
        .into_iter()
        .filter(|id| !case.vehicles[id.index()].fixed)
        .map(|id| damage(id, &nominal, reference))
        .collect();
    let is_at_object = is_with_object(&case, &hit_of_movers);
    let (observed, notes) = observe(&Scene {
        case: &case,
        prior,
        ranges: &ranges,
        nominal: &nominal,
        motion: motion.as_ref(),
        followed,
        crushed,
        speeds,
        reference,
    });
    unused.extend(notes.unused);

    let law = nominal.law.at(1.0);
    let (placeholder, _) = nominal.contact.impact_with_validity(nominal.motions, &law);
    let shared = SharedEffects::of(&case);
    let variables = case.variables();
    let numbers = placed(&case, &slots);
    let skids = skids(&case, &numbers, &variables, &slots);
    let block = shared.is_empty().then(|| block(numbers, &variables, &slots, speeds)).flatten();
    case.uncertainty = Default::default();
    case.title = None;
    case.source = None;
    case.report = Default::default();
    for vehicle in &mut case.vehicles {
        vehicle.name = None;
    }
    let shared = (!shared.is_empty()).then_some(shared);
    let motion = shared.is_none().then(|| of_motion(&case, &variables, &slots));
    let (axes, outputs) = (case.axes, outputs::of(&case, &skids, followed));
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
        outputs,
        axes,
        reference,
        unknown: Independent(unknowns.0.iter().map(|unknown| unknown.prior).collect()),
    };
    let energies = energies(crushed, &impacts.impact.case);
    Ok(Setup {
        prior,
        impacts,
        observed,
        unknown: unknowns.0,
        default_errors: notes.default_errors,
        unused,
        stood,
        energies,
        hit,
        is_at_object,
        seeks_speed: sought != [false; 2],
        warnings,
    })
}

/// The parts of a case that its motion after the impact needs: each particle that is followed copies them.
fn of_motion(case: &Case, variables: &[Input], slots: &[Slot]) -> Varied {
    let mut case = case.clone();
    case.impact = None;
    case.reconstruct = None;
    case.site_plan = None;
    for vehicle in &mut case.vehicles {
        // If the contact point is placed on the damage, the motion needs the damage.
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

/// The case with the indices of its unknown numbers.
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
        let skid = numbers.vehicles[id.index()].skid()?;
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
fn block(numbers: Case<Number>, variables: &[Input], slots: &[Slot], speeds: OpenSpeeds) -> Option<Block> {
    // Burg's formula takes the yaw inertia from the wheelbase.
    let is_by_burg = |id: &VehicleId| matches!(numbers.vehicle_form(*id).yaw, Some(YawForm::Burg { .. }));
    let by_burg = VehicleId::ALL.into_iter().filter(is_by_burg);
    let wheelbases: Vec<String> = by_burg.map(|id| format!("{}.wheelbase", table(id))).collect();
    let is_read = |path: &String| !is_beside(path) || wheelbases.contains(path);
    let enters = |(input, slot): &(&Input, &Slot)| **slot != Slot::Given && is_read(&input.path);
    let unknown = variables.iter().zip(slots).filter(enters).count();
    Block::new(numbers, speeds, unknown)
}

/// Whether a number only belongs to the motion before or after the impact.
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

/// The case with a speed for every vehicle, which speeds are unknown, and the data that are not used.
fn with_all_speeds(case: &Case) -> Result<(Case, [bool; 2], Vec<Unused>), Faults> {
    let mut case = case.clone();
    let mut unused = Vec::new();
    if case.locked_together {
        unused.extend(as_one_wreck(&mut case));
    }
    unused.extend(without_inferred_crush(&mut case));
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
            with_course(&mut case, id)?;
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
        [true, false] => Some(Find::One(VehicleId::One)),
        [false, true] => Some(Find::One(VehicleId::Two)),
        [false, false] => None,
    };
    if let Some(find) = find {
        let energy_basis = case.reconstruct.map(|reconstruct| reconstruct.energy_basis);
        case.left_out.energy_basis |= energy_basis.is_none();
        case.reconstruct = Some(Reconstruct { find, energy_basis: energy_basis.unwrap_or_default() });
    }
    Ok((case, sought, unused))
}

/// Removes the crush that the balance of forces would give if no PDOF gives their directions: it is no
/// evidence, and follows from none.
fn without_inferred_crush(case: &mut Case) -> Vec<Unused> {
    if has_pdof(case) {
        return Vec::new();
    }
    let mut unused = Vec::new();
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&mut case.vehicles) {
        let places_contact = vehicle.places_contact();
        if !places_contact && vehicle.crush.take_if(|crush| crush.from_force_balance).is_some() {
            unused.push(Unused { key: format!("{}.crush", table(id)), reason: UnusedReason::Inferred });
        }
    }
    unused
}

/// Vehicles that leave as one do not rebound, and their surfaces do not slip on each other at the end: e = 0
/// and μ = μ_c, whatever the case gives. Returns the data that are therefore not used; for a law other than
/// Brach's, and for Brach's with a moment, that is the key itself.
fn as_one_wreck(case: &mut Case) -> Vec<Unused> {
    let unused = |key: &str, reason| Unused { key: key.to_owned(), reason };
    let (restitution, tangential) = match case.impact.as_mut().map(|impact| &mut impact.law) {
        Some(ImpactLaw::Brach { restitution, tangential, moment_restitution: None }) => {
            (restitution, tangential)
        }
        Some(ImpactLaw::Brach { .. }) => {
            return vec![unused("scene.locked_together", UnusedReason::WithMoment)];
        }
        _ => return vec![unused("scene.locked_together", UnusedReason::OtherLaw)],
    };
    let mut given = Vec::new();
    if *restitution != Restitution::Constant(0.0) {
        given.push(unused("impact.restitution", UnusedReason::OneWreck));
        *restitution = Restitution::Constant(0.0);
    }
    if *tangential != BrachTangential::Critical {
        given.push(unused("impact.tangential", UnusedReason::OneWreck));
        *tangential = BrachTangential::Critical;
    }
    case.ranges.retain(|range| {
        !range.path.starts_with("impact.restitution") && !range.path.starts_with("impact.tangential")
    });
    given
}

/// Replaces a velocity by its only information, the direction of travel, as a sideslip with its spread.
fn with_course(case: &mut Case, id: VehicleId) -> Result<(), Faults> {
    let sd = direction_sd(case, id)?;
    with_sideslip(case, id);
    let of_velocity = format!("{}.velocity.", table(id));
    case.ranges.retain(|range| !range.path.starts_with(&of_velocity));
    if sd > 0.0 {
        let path = format!("{}.sideslip", table(id));
        let is_before = |input: &&Input| case.ranges.iter().any(|range| range.path == input.path);
        let variables = case.variables();
        let place = variables.iter().take_while(|input| input.path != path).filter(is_before).count();
        let unit = variables.iter().find(|input| input.path == path).and_then(|input| input.unit);
        let sd = Amount { number: sd, unit };
        case.ranges.insert(place, Range { path, spread: Spread::Normal { sd }, bounds: Bounds::None });
    }
    Ok(())
}

/// (rad) standard deviation of the direction of a velocity, from the ranges of its parts.
fn direction_sd(case: &Case, id: VehicleId) -> Result<f64, Faults> {
    let Some(Velocity::Vector { x, y }) = case.vehicles[id.index()].motion else { return Ok(0.0) };
    let ranges = any_inputs(case)?;
    let sd = |key: &str| {
        let path = format!("{}.velocity.{key}", table(id));
        let range = ranges.iter().find(|range| range.input.path == path);
        range.map_or(0.0, |range| range.distribution.sd() * range.input.factor())
    };
    let [x, y, sd_x, sd_y] = [x.si(), y.si(), sd("x"), sd("y")];
    // ψ = atan2(v_y, v_x),  σ_ψ = √((v_y σ_x)² + (v_x σ_y)²)/v²
    let square = x * x + y * y;
    let across = Real::sqrt((y * sd_x) * (y * sd_x) + (x * sd_y) * (x * sd_y));
    Ok(if square > 0.0 { across / square } else { 0.0 })
}

/// Whether a number is compared with the impact and does not enter it.
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

/// The treatment of each number of the case: those with a range are unknown, and some others have their usual
/// uncertainty.
fn slots(
    case: &Case,
    ranges: &[UncertainInput],
    nominal: &CollisionData,
    followed: [bool; 2],
    unknowns: &mut Unknowns,
) -> Result<Vec<Slot>, Failure> {
    let mut ranges = ranges.iter().peekable();
    let has_ground_range = case.ranges.iter().any(|range| is_ground(&range.path));
    let skids_on_it = |vehicle: &GivenVehicle| vehicle.skid().is_some_and(|skid| skid.friction.is_none());
    let uses_ground = followed != [false, false] || case.vehicles.iter().any(skids_on_it);
    let mut ground = None;
    let mut drags = [None; 2];
    let mut slot = |input: &Input| -> Result<Slot, Failure> {
        let range = ranges.next_if(|range| range.input.path == input.path);
        if is_observed(&input.path) {
            return Ok(Slot::Given);
        }
        if let Some(range) = range {
            let assumed = matches!(input.origin, Origin::Estimate(_)).then_some(Assumed::Estimate);
            let place = unknowns.push(&input.path, input.unit, range.distribution, assumed);
            return Ok(Slot::Value(place));
        }
        // A coefficient of zero is exact.
        if input.number != 0.0
            && let Some(ln_sd) = coefficient_ln_sd(input, case)
        {
            return Ok(if input.number > 0.0 {
                let prior = of_number(&input.path, Distribution::log_normal(input.number, ln_sd))?;
                Slot::Value(unknowns.push(&input.path, input.unit, prior, Some(Assumed::Coefficient)))
            } else {
                // A ratio has the sign of the force, and its mirror image the same spread.
                let (key, factor) = (format!("{}.factor", input.path), Distribution::log_normal(1.0, ln_sd));
                Slot::Factor(unknowns.assumed(&key, factor, Assumed::Coefficient)?)
            });
        }
        if let Some((sd, assumed)) = usual_sd(input, case, nominal) {
            let prior = of_number(&input.path, Distribution::normal(input.number, sd / input.factor()))?;
            return Ok(Slot::Value(unknowns.push(&input.path, input.unit, prior, Some(assumed))));
        }
        if let Some(id) = VehicleId::ALL.into_iter().find(|id| input.path == skid_friction(*id)) {
            let factor = Distribution::log_normal(1.0, GROUND_LN_SD);
            return Ok(Slot::Factor(unknowns.assumed(&skid_friction(id), factor, Assumed::Ground)?));
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
            return Ok(Slot::Factor(place));
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
            return Ok(Slot::Factor(place));
        }
        Ok(Slot::Given)
    };
    case.variables().iter().map(&mut slot).collect()
}

fn is_ground(path: &str) -> bool {
    let of_ground = path.starts_with("surface.") && path.ends_with("friction");
    of_ground || VehicleId::ALL.into_iter().any(|id| path == path_friction(id))
}

/// (–) the spread of the logarithm of a coefficient of the impact without a range, whose median is the value
/// of the case; the numbers of laws other than Brach's are taken as exact.
fn coefficient_ln_sd(input: &Input, case: &Case) -> Option<f64> {
    let ImpactLaw::Brach { moment_restitution: None, .. } = case.impact.as_ref()?.law else { return None };
    match input.path.as_str() {
        "impact.restitution" => Some(RESTITUTION_LN_SD),
        path if path.starts_with("impact.tangential") => Some(FRICTION_LN_SD),
        _ => None,
    }
}

/// (SI) the usual uncertainty of a number without a range, if that matters.
fn usual_sd(input: &Input, case: &Case, nominal: &CollisionData) -> Option<(f64, Assumed)> {
    if input.origin != Origin::Given {
        return None;
    }
    if input.path == "impact.crush_plane" {
        return Some((CRUSH_PLANE_SD, Assumed::CrushPlane));
    }
    let id = VehicleId::ALL.into_iter().find(|id| input.path.starts_with(table(*id)))?;
    let fixed = case.vehicles[id.index()].fixed;
    let kind = case.vehicles[id.index()].kind;
    let is_loaded = matches!(kind, Some(VehicleKind::HeavyTruck | VehicleKind::Trailer));
    match input.path.split_once('.')?.1 {
        // A wall has the heading of the crush plane.
        "heading" if !fixed => Some((HEADING_SD, Assumed::Heading)),
        "mass" | "weight" if is_loaded => Some((LOAD_SHARE * input.si(), Assumed::Load)),
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

/// Which vehicles are followed to their measured rest position or points, and the data that are not used if
/// they are not.
fn followed(case: &Case, motion: Option<&MotionInput>) -> ([bool; 2], Vec<Unused>) {
    let mut unused = Vec::new();
    let followed = VehicleId::ALL.map(|id| {
        let Some(after) = &case.vehicles[id.index()].after else { return false };
        let places = [("rest", after.rest.is_some()), ("points", !after.points.is_empty())];
        let given: Vec<&str> = places.iter().filter(|(_, is_given)| *is_given).map(|(key, _)| *key).collect();
        // A vehicle attached to another one does not come to rest as it would alone.
        let can_follow = motion.is_some_and(|motion| motion.vehicles[id.index()].is_some());
        let is_followed = can_follow && !case.locked_together;
        if !is_followed {
            let key = |key: &&str| format!("{}.after.{key}", table(id));
            let reason = if case.locked_together { UnusedReason::Wreck } else { UnusedReason::NotFollowed };
            unused.extend(given.iter().map(|given| Unused { key: key(given), reason }));
        }
        !given.is_empty() && is_followed
    });
    (followed, unused)
}

/// The unknowns of the impact in the case.
struct Open {
    friction: bool,
    tangential_share: bool,
}

/// Leaves out a moment restitution of −1, which is the same as none: no moment impulse.
fn leave_out_no_moment(case: &mut Case) {
    let has_range = case.ranges.iter().any(|range| range.path == "impact.moment_restitution");
    if let Some(impact) = &mut case.impact
        && let ImpactLaw::Brach { moment_restitution, .. } = &mut impact.law
        && !has_range
    {
        moment_restitution.take_if(|moment| *moment == -1.0);
    }
}

impl Open {
    /// `"critical"` gives no largest impulse ratio, and one wreck has none. Laws other than Brach's are taken
    /// as exact.
    fn of(case: &Case, ranges: &[UncertainInput]) -> Self {
        let has_range = ranges.iter().any(|range| range.input.path.starts_with("impact.tangential"));
        let law = case.impact.as_ref().map(|impact| &impact.law);
        let is_critical = matches!(
            law,
            Some(ImpactLaw::Brach { tangential: BrachTangential::Critical, moment_restitution: None, .. })
        );
        let is_said = case.reconstruct.is_some() && !case.left_out.energy_basis;
        let is_open = is_critical && !has_range && !case.locked_together;
        Self { friction: is_open, tangential_share: !is_said }
    }
}

/// Whether no vehicle that stood has such a recorded speed: one from a table has no error at zero, and any
/// other is far beyond its error.
fn excludes_standing(told: RecordersSpeed) -> bool {
    match told.humps {
        Some(humps) => humps.iter().all(|hump| hump.mean > MISSED * hump.sd),
        None => told.is_of_table || told.speed > MISSED * LEAST_SPEED_ERROR,
    }
}

/// (–) the probability before the evidence that each vehicle stood. If one stood, the other moved.
fn stood(sought: [bool; 2], case: &Case) -> [f64; 2] {
    let ground = case.ground_friction();
    let given = case.estimate.unwrap_or_default().stood.unwrap_or(STOOD) / 100.0;
    let may_move = |id: VehicleId| {
        let vehicle = &case.vehicles[id.index()];
        let is_known_to_stand = vehicle.motion.is_some_and(|motion| motion.size() == 0.0);
        !vehicle.fixed && (sought[id.index()] || !is_known_to_stand)
    };
    VehicleId::ALL.map(|id| {
        let vehicle = &case.vehicles[id.index()];
        let [least, most] = certain_limits(vehicle);
        let certainly_moved = speed_at_impact(vehicle).is_some_and(|speed| speed > 0.0)
            || least.is_some_and(|speed| speed > 0.0)
            || most.is_some_and(|speed| speed < 0.0)
            || vehicle
                .recorder
                .as_ref()
                .and_then(|recorder| recorder.tells_speed(ground))
                .is_some_and(excludes_standing);
        let may_stand = sought[id.index()] && may_move(id.other()) && !certainly_moved;
        if may_stand { given } else { 0.0 }
    })
}

/// The vehicle whose speed has the narrowest certain limits (m/s), by their ratio, of those with both above
/// 0.
fn narrowest(case: &Case) -> Option<(VehicleId, [f64; 2])> {
    let within = VehicleId::ALL.into_iter().filter_map(|id| {
        let [Some(least), Some(most)] = certain_limits(&case.vehicles[id.index()]) else { return None };
        (least > 0.0).then_some((id, [least, most]))
    });
    within.min_by(|(_, [low, high]), (_, [least, most])| (high / low).total_cmp(&(most / least)))
}

/// (m/s) how much of a range of speeds counts beside a vehicle that stood: all of it, or by the share that
/// the usual severity gives to each speed.
fn moving([least, most]: [f64; 2], prior: SeverityPrior) -> f64 {
    if prior == SeverityPrior::Flat {
        return most - least;
    }
    // ∫ e^(−v²/2s²) dv = s √(2π) (Φ(v_max/s) − Φ(v_min/s))
    let usual = FITTED.severity.speed;
    usual * Real::sqrt(TAU) * (cumulative(most / usual) - cumulative(least / usual))
}

fn speeds(
    sought: [bool; 2],
    stood: [f64; 2],
    prior: SeverityPrior,
    case: &Case,
    unknowns: &mut Unknowns,
) -> Result<OpenSpeeds, Failure> {
    let key = |id: VehicleId| format!("{}.speed", table(id));
    let limits = |id: VehicleId| {
        let vehicle = &case.vehicles[id.index()];
        let [least, most] = certain_limits(vehicle);
        let fault = |of: &str, reason: &str, advice: &str| {
            let key = format!("{}.certain_speed.{of}", table(id));
            Failure::Case(Fault::refused(key, reason, advice).into())
        };
        if let Some(least) = least.filter(|least| *least >= FASTEST_BELIEVED && most.is_none()) {
            return Err(fault(
                "at_least",
                &format!(
                    "{:.0} km/h is faster than any speed considered: the highest is {:.0} km/h",
                    3.6 * least,
                    3.6 * FASTEST_BELIEVED
                ),
                "check its unit",
            ));
        }
        if least.is_none() && most == Some(0.0) {
            return Err(fault(
                "at_most",
                "a speed of at most 0 means that the vehicle was stationary or moved backward",
                &format!(
                    "write speed = \"0 km/h\" in [{}] if it was stationary, and give at_least, such as \
                     \"-20 km/h\", if it moved backward",
                    table(id)
                ),
            ));
        }
        Ok(speed_limits(vehicle))
    };
    let [limits1, limits2] = VehicleId::ALL.map(limits);
    let limits = [limits1?, limits2?];
    let mut alone = |id: VehicleId| {
        let [least, most] = limits[id.index()];
        let stood = if least <= 0.0 && most > 0.0 { stood[id.index()] } else { 0.0 };
        // p = w/(w + ∫ e^(−v²/2s²) dv)
        let standing = moving(limits[id.index()], prior) * stood / (1.0 - stood);
        let place = unknowns.speed(&key(id), Distribution::uniform(least, most + standing))?;
        unknowns.0[place].moving = Some(of_number(&key(id), Distribution::uniform(least, most))?);
        Ok::<_, Failure>(Alone { place, standing })
    };
    Ok(match sought {
        [false, false] => OpenSpeeds::None,
        [true, false] => OpenSpeeds::One(VehicleId::One, alone(VehicleId::One)?),
        [false, true] => OpenSpeeds::One(VehicleId::Two, alone(VehicleId::Two)?),
        [true, true] => {
            let backward = limits.iter().any(|[least, _]| *least < 0.0);
            if prior == SeverityPrior::Flat || backward {
                OpenSpeeds::Each([alone(VehicleId::One)?, alone(VehicleId::Two)?])
            } else if let Some((vehicle, [least, most])) = narrowest(case) {
                let key = format!("{}.ln_speed", table(vehicle));
                let ln_speed = unknowns.speed(&key, Distribution::uniform(ln(least), ln(most)))?;
                let split = unknowns.speed("speed_split", Speeds::split_within(vehicle, least, stood))?;
                OpenSpeeds::Together(Speeds::Within { vehicle, ln_speed, split })
            } else {
                let ln_relative = unknowns.speed("ln_relative_speed", Speeds::any_ln_relative())?;
                let split = unknowns.speed("speed_split", Speeds::split_with_standing(stood))?;
                OpenSpeeds::Together(Speeds::Together { ln_relative, split })
            }
        }
    })
}
