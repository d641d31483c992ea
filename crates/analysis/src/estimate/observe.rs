//! The observations of a collision, and their errors.

mod after;
mod damage;
mod recorder;

use std::f64::consts::FRAC_PI_6;

use ::uncertainty::Shape;
use crash3::opposite_pdof;
use evidence::{DamagedSide, FITTED, Limits, MeasuredSpeed, Observed, ObservedVehicle, Severity};
use inputs::{Case, CollisionData, GivenVehicle, MotionInput, Quantity, SeverityPrior, table};
use pim_core::VehicleId;
use real::principal_angle;

use super::injury;
use super::notes::{Notes, Unused, UnusedReason};
use super::posed::OpenSpeeds;
use crate::errors::is_with_object;
use crate::given::certain_limits;
use crate::phases::speed_at_impact;
use crate::thresholds::RECORDER_SPEED_ERROR;
use crate::uncertainty::UncertainInput;

pub(super) use damage::{Crushed, damage, energies};

/// (m/s) scale of the error of a speed of zero: 1 km/h, chosen; the rounding allowed by 49 CFR 563.
pub(super) const LEAST_SPEED_ERROR: f64 = 1.0 / 3.6;
/// (–) a range wider than this share of its speed is the error of the speed, not of its logarithm.
const WIDE_RANGE: f64 = 0.5;
/// (–) the field data have only five vehicles hit side against side, too few for their severity: its spread
/// is taken as this multiple of that of all others.
const SIDESWIPE_SPREAD: f64 = 2.0;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// The case from which evidence is collected.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub(super) case: &'a Case,
    pub(super) prior: SeverityPrior,
    pub(super) ranges: &'a [UncertainInput],
    pub(super) nominal: &'a CollisionData,
    pub(super) motion: Option<&'a MotionInput>,
    /// Whether each vehicle is followed to rest.
    pub(super) followed: [bool; 2],
    pub(super) crushed: Crushed,
    pub(super) speeds: OpenSpeeds,
    /// (rad) PDOF of both vehicles if the force were normal to the crush plane.
    pub(super) reference: [f64; 2],
}

/// A vehicle of the case from which evidence is collected.
#[derive(Clone, Copy)]
struct Subject<'a> {
    case: &'a Case,
    ranges: &'a [UncertainInput],
    id: VehicleId,
}

impl<'a> Subject<'a> {
    fn given(self) -> &'a GivenVehicle {
        &self.case.vehicles[self.id.index()]
    }

    fn key(self, of: &str) -> String {
        format!("{}.{of}", table(self.id))
    }

    /// (SI) the standard deviation of the range of a number, if it has one: as given, even if the number
    /// cannot be below zero.
    fn sd(self, of: &str) -> Option<f64> {
        let key = self.key(of);
        let range = self.ranges.iter().find(|range| range.input.path == key)?;
        let sd = match range.distribution.shape() {
            Shape::Normal { sd, .. } => sd,
            _ => range.distribution.sd(),
        };
        Some(sd * range.input.factor())
    }

    /// The same; without a range, it is noted that the number has its default error.
    fn noted_sd(self, of: &str, notes: &mut Notes) -> Option<f64> {
        let sd = self.sd(of);
        notes.default_error(sd.is_none(), self.key(of));
        sd
    }
}

/// All the evidence of a case.
pub(super) fn observe(scene: &Scene<'_>) -> (Observed, Notes) {
    let Scene { case, prior, ranges, nominal, crushed, speeds, reference, .. } = *scene;
    let mut notes = Notes::default();
    let vehicles = VehicleId::ALL.map(|id| vehicle(scene, id, &mut notes));
    let pdofs_differ = pdofs_differ(case, &vehicles);
    if let [Some(one), Some(two)] = vehicles.each_ref().map(|vehicle| vehicle.pdof) {
        let id = if one.scale <= two.scale { VehicleId::Two } else { VehicleId::One };
        let key = format!("{}.crush.pdof", table(id));
        notes.default_errors.retain(|defaulted| *defaulted != key);
        let reason = if pdofs_differ { UnusedReason::PdofsDiffer } else { UnusedReason::OtherPdof };
        notes.unused.push(Unused { key, reason });
    }
    let given = case.estimate.unwrap_or_default();
    let hit: Vec<DamagedSide> = damage::movers(case).map(|id| damage(id, nominal, reference)).collect();
    let fitted = FITTED.of_injured(injury(prior));
    let usual = if is_with_object(case, &hit) { fitted.objects.severity } else { fitted.severity_of(&hit) };
    let median = given.delta_v_median.as_ref().map_or(usual.median, Quantity::si);
    let times = if hit == [DamagedSide::Side; 2] { SIDESWIPE_SPREAD } else { 1.0 };
    let severity = Severity { median, ln_sd: usual.ln_sd * times, uniform_speeds: speeds.uniform(), ..usual };
    let crush = (crushed != Crushed::No)
        .then(|| damage::crush_errors(case, energies(crushed, case), ranges, &hit, &mut notes));
    let severity = (prior != SeverityPrior::Flat).then_some(severity);
    let (crush, figures) = crush.map_or((None, None), |(errors, figures)| (Some(errors), figures));
    let crush_is_bound = case.has_no_residual_crush();
    let observed = Observed { vehicles, pdofs_differ, severity, crush, crush_is_bound, figures };
    notes.unused.extend(of_nothing(case, &observed));
    (observed, notes)
}

/// What the case says about evidence that the estimate does not have.
fn of_nothing(case: &Case, observed: &Observed) -> Vec<Unused> {
    let given = case.estimate.unwrap_or_default();
    let has_rest = observed.vehicles.each_ref().map(|vehicle| vehicle.rest.is_some());
    let has_place = [0, 1].map(|place| has_rest[place] || !observed.vehicles[place].points.is_empty());
    let mut unused = Vec::new();
    let mut add = |key: String, is_unused: bool, reason| {
        if is_unused {
            unused.push(Unused { key, reason });
        }
    };
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&case.vehicles) {
        let key = |of: &str| format!("{}.{of}", table(id));
        if let Some(after) = vehicle.after.as_ref().filter(|_| !has_place[id.index()]) {
            add(key("after.friction"), after.friction.is_some(), UnusedReason::NoPlace);
            add(key("after.drag"), after.drag.is_some(), UnusedReason::NoPlace);
            add(key("after.steer"), after.steer.is_some(), UnusedReason::NoPlace);
        }
    }
    let [no_rest, no_place] = [has_rest, has_place].map(|has| has == [false; 2]);
    let [no_energy, is_flat] = [observed.crush.is_none(), observed.severity.is_none()];
    let mut of_estimate = |key: &str, is_unused, reason| add(format!("estimate.{key}"), is_unused, reason);
    of_estimate("delta_v_median", is_flat && given.delta_v_median.is_some(), UnusedReason::FlatPrior);
    of_estimate("crush_error", no_energy && given.crush_error.is_some(), UnusedReason::NoCrushEnergy);
    of_estimate("crush_bias", no_energy && given.crush_bias.is_some(), UnusedReason::NoCrushEnergy);
    of_estimate("rest_error", no_place && given.rest_error.is_some(), UnusedReason::NoPlace);
    of_estimate("rest_least_error", no_place && given.rest_least_error.is_some(), UnusedReason::NoPlace);
    of_estimate("rest_heading_error", no_rest && given.rest_heading_error.is_some(), UnusedReason::NoRest);
    unused
}

/// (rad) 30°, an hour of the clock: two PDOFs that are farther from opposite are not of one force.
const ONE_FORCE: f64 = FRAC_PI_6;

/// Whether the PDOFs of both vehicles are not of one force.
fn pdofs_differ(case: &Case, vehicles: &[ObservedVehicle; 2]) -> bool {
    let ([Some(one), Some(two)], [Some(h1), Some(h2)]) =
        (vehicles.each_ref().map(|vehicle| vehicle.pdof), case.headings())
    else {
        return false;
    };
    principal_angle(two.pdof - opposite_pdof(one.pdof, [h1, h2])).abs() > ONE_FORCE
}

/// The evidence of one vehicle.
fn vehicle(scene: &Scene<'_>, id: VehicleId, notes: &mut Notes) -> ObservedVehicle {
    let Scene { case, ranges, nominal, motion, followed, reference, .. } = *scene;
    let subject = Subject { case, ranges, id };
    let way = motion.filter(|_| followed[id.index()]).and_then(|motion| motion.vehicles[id.index()].as_ref());
    let is_side = damage(id, nominal, reference) == DamagedSide::Side;
    // At the start of the skid.
    let skid_speed = subject.given().before.as_ref().and_then(|before| before.speed);
    let skid_speed = skid_speed.map(|speed| {
        measured_speed(speed.si(), subject.noted_sd("before.speed", notes), RECORDER_SPEED_ERROR)
    });
    if speed_at_impact(subject.given()).is_some() {
        notes.unused.push(Unused { key: subject.key("before.phase"), reason: UnusedReason::Phases });
    }
    let after = after::after(subject, notes);
    let (rest, points) = way.map(|way| after::rest(subject, way, notes)).unwrap_or_default();
    let pdof = damage::pdof(subject, &nominal.vehicles[id.index()], notes);
    let recorder = recorder::recorded(subject, is_side, notes);
    let limits = limits(subject);
    ObservedVehicle { pdof, after, rest, skid_speed, points, recorder, limits }
}

/// The certain limits of a speed.
fn limits(subject: Subject<'_>) -> Limits {
    let [least, most] = certain_limits(subject.given());
    Limits { least: least.unwrap_or(f64::NEG_INFINITY), most: most.unwrap_or(f64::INFINITY) }
}

/// A measured speed (m/s), with the range of the case, whose standard deviation is `sd` (m/s), or without a
/// range, with a `share` of the speed.
fn measured_speed(value: f64, sd: Option<f64>, share: f64) -> MeasuredSpeed {
    match sd {
        None => MeasuredSpeed { value, ln_sd: share, least: LEAST_SPEED_ERROR },
        Some(sd) if sd <= WIDE_RANGE * value => MeasuredSpeed { value, ln_sd: sd / value, least: 0.0 },
        Some(sd) => MeasuredSpeed { value, ln_sd: 0.0, least: sd },
    }
}
