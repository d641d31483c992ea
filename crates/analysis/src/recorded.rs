//! The readings of the recorders of a case on their own, and which of their records is of its impact.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_6;

use crash3::EnergyBasis;
use inputs::{
    Case, Dimension, Fault, GivenSeries, GivenVehicle, KnownEnergy, OtherImpact, Pdof, Quantity, Recorder,
    RecordersDeltaV, SeriesSource,
};
use pim_core::VehicleId;
use recorder::{
    DistanceBounds, EventRecord, ImpactSpeed, ImpactSpeedErrors, KnownImpact, MatchErrors, Mismatch,
    PreCrash, PreCrashSample, PulseRule, PulseSpan, RecordMatch, SpeedLimits, SteepChange, StepSource,
    match_records,
};

use crate::damage;
use crate::failure::Failure;
use crate::normal_force::reference;
use crate::vehicle::Vehicle;

/// The readings of the recorders of both vehicles on their own.
#[derive(Clone, Debug, PartialEq)]
pub struct RecorderReading {
    /// Of vehicles 1 and 2; `None` for one without a table.
    pub vehicles: [Option<VehicleReading>; 2],
}

/// The reading of a vehicle's recorder on its own: one of its records, that of the impact if it has several.
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleReading {
    /// Whether this record is of the impact of the case.
    pub of_impact: OfImpact,
    /// The other records, in the order of time.
    pub others: Vec<VehicleReading>,
    /// Its table and its keys.
    pub recorder: Recorder,
    /// The speed at impact, by the table before it.
    pub speed: Option<ImpactSpeed>,
    /// The errors that it was found with.
    pub errors: ImpactSpeedErrors,
    /// How the step in which the speeds are stored was found; `None` if the case states it, or has no speeds.
    pub step_source: Option<StepSource>,
    /// The path to the impact: the samples before it, and the impact itself.
    pub path: Vec<ClockedSample>,
    /// Where the speed changes between two samples by more than the bounds of the distance allow.
    pub steep: Vec<SteepChange>,
    /// The impact in the pulse by each rule that finds one.
    pub spans: Vec<PulseSpan>,
    /// Whether the pulse ends before the impact does, so that its ΔV is a lower bound.
    pub is_cut: bool,
    /// ΔV at the centre of gravity, if the pulse holds all of it.
    pub delta_v: Option<RecordersDeltaV>,
    /// A lower bound of ΔV at the centre of gravity, if the pulse does not hold all of it.
    pub least_delta_v: Option<RecordersDeltaV>,
    /// (rad) principal direction of force of the pulse over time (s), clockwise from the front.
    pub force_directions: Vec<(f64, f64)>,
}

/// A sample before the impact, or the impact itself, with the distance that is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockedSample {
    /// The stored data. If the last speed was stored before the impact, the point at time 0 has the median of
    /// the speed at the impact.
    pub sample: PreCrashSample,
    /// Whether its speed was stored, rather than being that median; `None` without a speed.
    pub speed_is_stored: Option<bool>,
    /// From here to the impact; `None` without a speed.
    pub distance: Option<DistanceBounds>,
}

/// Whether a record is of the impact of the case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfImpact {
    /// Its place among several, from 1; `None` if it is the only one.
    pub number: Option<usize>,
    /// (s) its time since the record before it, as the recorder stored it.
    pub since_previous: Option<f64>,
    /// The data that distinguish it from other records.
    pub event: EventRecord,
    /// The impact as the damage shows it.
    pub impact: KnownImpact,
    /// The errors with which the two were compared.
    pub errors: MatchErrors,
    /// (1) probability that it is of this impact.
    pub probability: f64,
    /// Why it cannot be, if it cannot.
    pub cannot: Option<Mismatch>,
    /// The other impact of the case to which it most probably belongs, if there is one: its place from 1, and
    /// the probability.
    pub other: Option<(usize, f64)>,
    /// Whether it is taken for the record of this impact: the only one is, and of several the one that is
    /// more likely than not.
    pub is_taken: bool,
}

/// (1) the smallest probability with which one of several records is taken for that of the impact.
const TAKEN: f64 = 0.5;

/// (rad) the PDOF that the case gives for a vehicle.
fn given_pdof(case: &Case, id: VehicleId) -> Option<f64> {
    let vehicle = &case.vehicles[id.index()];
    let of_crush = vehicle.crush.as_ref().and_then(|crush| crush.pdof.as_ref());
    let of_energy = vehicle.energy.as_ref().and_then(KnownEnergy::ees).and_then(|given| given.pdof.as_ref());
    of_crush.or(of_energy).map(Pdof::rad)
}

/// Whether the case gives a PDOF for either vehicle.
pub(crate) fn has_pdof(case: &Case) -> bool {
    VehicleId::ALL.into_iter().any(|id| given_pdof(case, id).is_some())
}

/// The damage of both vehicles, and what CRASH3 makes of its energy.
struct Assessed {
    vehicles: [Vehicle; 2],
    basis: EnergyBasis,
    restitution: Option<f64>,
}

impl Assessed {
    fn of(case: &Case) -> Option<Self> {
        let input = case.damage().ok()?;
        let vehicles = damage::assess(input.vehicles, [None, None]).ok()?;
        Some(Self { vehicles, basis: input.basis.energy(), restitution: input.restitution })
    }

    /// (m/s) the ΔV of a vehicle.
    fn delta_v(&self, id: VehicleId) -> Option<f64> {
        let found = damage::crash3(&self.vehicles, self.basis, self.restitution).ok().flatten()?;
        let whole = found.corrected.map_or(found.delta_v, |corrected| corrected.delta_v)[id.index()];
        Some(whole * found.restitution_factor.unwrap_or(1.0)).filter(|delta_v| *delta_v > 0.0)
    }
}

/// The case with forces normal to the crush plane, and the PDOF (rad) that each vehicle then has.
fn with_normal_forces(case: &Case) -> Option<(Case, [f64; 2])> {
    let directions = reference(&case.geometry().ok()?);
    let mut case = case.clone();
    for (vehicle, direction) in case.vehicles.iter_mut().zip(directions) {
        let pdof = Quantity::from_si(direction, Dimension::Angle).ok().map(Pdof::Angle);
        if let Some(crush) = &mut vehicle.crush {
            crush.pdof = pdof;
        }
        if let Some(KnownEnergy::Ees(ees)) = &mut vehicle.energy {
            ees.pdof = pdof;
        }
    }
    Some((case, directions))
}

/// (rad) 30°: standard deviation of a direction of force that is taken as normal to the crush plane. Friction
/// turns the force by up to that and a little more.
const OF_NORMAL: f64 = FRAC_PI_6;

/// The impact of the case as the damage of both vehicles shows it: its ΔV by CRASH3, if the case has what
/// that needs, and its direction, which is normal to the crush plane if the case gives none; and with which
/// errors a record is compared with it.
fn known_impact(case: &Case, id: VehicleId) -> (KnownImpact, MatchErrors) {
    // It is unknown what a lone vehicle struck, and so is its ΔV.
    let alone = case.vehicles.iter().any(GivenVehicle::is_absent);
    let of = |assessed: Option<Assessed>, given: Option<f64>| {
        let pdof = assessed.as_ref().and_then(|assessed| assessed.vehicles[id.index()].crash3_pdof());
        let delta_v = assessed.filter(|_| !alone).and_then(|assessed| assessed.delta_v(id));
        KnownImpact { force_direction: given.or(pdof), delta_v }
    };
    let by_plane = if alone || has_pdof(case) { None } else { with_normal_forces(case) };
    match by_plane {
        Some((case, directions)) => {
            let errors = MatchErrors { direction: OF_NORMAL, ..MatchErrors::default() };
            (of(Assessed::of(&case), Some(directions[id.index()])), errors)
        }
        None => (of(Assessed::of(case), given_pdof(case, id)), MatchErrors::default()),
    }
}

/// The records of a vehicle, each as a recorder with that record only, and whether it is of the impact.
fn records(case: &Case, id: VehicleId, recorder: &Recorder) -> Vec<(Recorder, OfImpact)> {
    let (impact, errors) = known_impact(case, id);
    let stored: Vec<Recorder> = if recorder.records.is_empty() {
        vec![recorder.clone()]
    } else {
        (0..recorder.records.len()).filter_map(|index| recorder.record(index)).collect()
    };
    let turned = case.vehicles[id.index()].yaw_rate_before();
    let events: Vec<EventRecord> = stored.iter().map(|one| one.event(case.axes, turned)).collect();
    let mut impacts: Vec<KnownImpact> = recorder.other_impacts.iter().map(OtherImpact::known).collect();
    let place = recorder.other_impacts.partition_point(|other| !other.after);
    impacts.insert(place, impact);
    let found = match_records(&events, &impacts, &errors);
    let probabilities: Vec<f64> = found.iter().map(|found| found.impacts[place]).collect();
    let other = |k: usize| {
        let others = found[k].impacts.iter().enumerate().filter(|(impact, _)| *impact != place);
        let others = others.zip(1..).map(|((_, probability), number)| (number, *probability));
        others.max_by(|one, other| one.1.total_cmp(&other.1))
    };
    let greatest = probabilities.iter().copied().fold(TAKEN, f64::max);
    let of_impact = |k: usize| OfImpact {
        number: (!recorder.records.is_empty()).then_some(k + 1),
        since_previous: recorder.records.get(k).and_then(|one| one.since_previous.as_ref()).map(Quantity::si),
        event: events[k],
        impact,
        errors,
        probability: probabilities[k],
        cannot: found[k].cannot[place],
        other: other(k),
        is_taken: recorder.records.is_empty() || probabilities[k] >= greatest,
    };
    stored.into_iter().enumerate().map(|(k, one)| (one, of_impact(k))).collect()
}

impl OfImpact {
    /// The key of the record in the case.
    #[must_use]
    pub fn key(&self, id: VehicleId) -> String {
        let table = format!("vehicle{}.recorder", id.number());
        self.number.map_or_else(|| table.clone(), |number| format!("{table}.records[{number}]"))
    }

    /// Whether a reader has to be told: if there are several records, or if the only one is probably not of
    /// the impact.
    #[must_use]
    pub fn is_told(&self) -> bool {
        self.number.is_some() || self.probability < RecordMatch::UNLIKELY
    }
}

/// The records of a case under their keys, as far as a reader has to be told whether they are of its impact.
pub(crate) fn told_records(case: &Case) -> Vec<(String, OfImpact)> {
    let of_vehicle = |id: VehicleId| {
        let recorder = case.vehicles[id.index()].recorder.as_ref();
        let found = recorder.map(|recorder| records(case, id, recorder)).unwrap_or_default();
        let told = found.into_iter().map(|(_, of_impact)| of_impact).filter(OfImpact::is_told);
        told.map(move |one| (one.key(id), one))
    };
    VehicleId::ALL.into_iter().flat_map(of_vehicle).collect()
}

/// A recorder with several records, of which it is not certain which is of the impact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UncertainRecord {
    pub(crate) vehicle: VehicleId,
    /// The number of the record that is used, from 1; `None` if none is.
    pub(crate) used: Option<usize>,
    /// (1) the probability that it is of the impact, or the greatest of all records.
    pub(crate) probability: f64,
}

/// A case with only the record of its impact in each recorder.
pub(crate) struct RecordsOfImpact<'a> {
    /// A recorder without a record that is likely to be of the impact is left out.
    pub(crate) case: Cow<'a, Case>,
    /// The keys of the other records.
    pub(crate) aside: Vec<String>,
    pub(crate) uncertain: Vec<UncertainRecord>,
}

pub(crate) fn with_records_of_impact(case: &Case) -> RecordsOfImpact<'_> {
    let several = |id: &VehicleId| {
        case.vehicles[id.index()].recorder.as_ref().is_some_and(|recorder| !recorder.records.is_empty())
    };
    let mut chosen = RecordsOfImpact { case: Cow::Borrowed(case), aside: Vec::new(), uncertain: Vec::new() };
    for id in VehicleId::ALL.into_iter().filter(several) {
        let Some(recorder) = &case.vehicles[id.index()].recorder else { continue };
        let records = records(case, id, recorder);
        chosen.uncertain.extend(doubt(id, &records));
        let mut taken = None;
        for (record, of_impact) in records {
            if of_impact.is_taken && taken.is_none() {
                taken = Some(record);
            } else {
                chosen.aside.push(of_impact.key(id));
            }
        }
        chosen.case.to_mut().vehicles[id.index()].recorder = taken;
    }
    chosen
}

/// (1) a record is used without a word if it is of the impact with this probability, or a greater one.
const CERTAIN: f64 = 0.9;

/// Whether it is not certain which of several records of a vehicle is of the impact.
pub(crate) fn uncertain_record(case: &Case, vehicle: VehicleId) -> Option<UncertainRecord> {
    let recorder = case.vehicles[vehicle.index()].recorder.as_ref();
    let recorder = recorder.filter(|recorder| !recorder.records.is_empty())?;
    doubt(vehicle, &records(case, vehicle, recorder))
}

fn doubt(vehicle: VehicleId, records: &[(Recorder, OfImpact)]) -> Option<UncertainRecord> {
    let taken = records.iter().find(|(_, record)| record.is_taken);
    let used = taken.and_then(|(_, record)| record.number);
    let greatest = records.iter().map(|(_, record)| record.probability).fold(0.0, f64::max);
    let probability = taken.map_or(greatest, |(_, record)| record.probability);
    (probability < CERTAIN).then_some(UncertainRecord { vehicle, used, probability })
}

/// (m/s) 5 km/h: the direction of a smaller ΔV depends mainly on its rounding to 1 km/h.
const LEAST_OF_DIRECTION: f64 = 5.0 / 3.6;

/// The keys of recorder files that were not read.
fn unread(case: &Case) -> Option<(String, String)> {
    fn of<R>(key: String, given: &GivenSeries<R>) -> Option<(String, String)> {
        let SeriesSource::File(name) = &given.source else { return None };
        given.record.is_none().then(|| (key, name.to_string()))
    }
    let of_record = |table: &str, record: &Recorder| {
        let before = record.pre_crash.as_deref();
        let before = before.and_then(|given| of(format!("{table}.pre_crash.file"), given));
        let pulse = record.pulse.as_deref();
        before.or_else(|| pulse.and_then(|given| of(format!("{table}.pulse.file"), given)))
    };
    VehicleId::ALL.into_iter().find_map(|id| {
        let recorder = case.vehicles[id.index()].recorder.as_ref()?;
        let table = format!("vehicle{}.recorder", id.number());
        let of_several = || {
            let mut records = recorder.records.iter().enumerate();
            records.find_map(|(k, one)| of_record(&format!("{table}.records[{}]", k + 1), &one.stored))
        };
        of_record(&table, recorder).or_else(of_several)
    })
}

/// Refuses a case with recorder data in a file that was not read.
pub(crate) fn is_read(case: &Case) -> Result<(), Failure> {
    let Some((key, name)) = unread(case) else { return Ok(()) };
    let reason = format!("the file {name} of the recorder was not read: a case alone has no folder");
    let advice = "write the lines of the file into the case: text = \"\"\"…\"\"\" in place of file";
    Err(Failure::Case(Fault::refused(key, reason, advice).into()))
}

/// The readings of the recorders of a case on their own.
///
/// # Errors
/// [`Failure`] if no vehicle has a table of a recorder.
pub fn recorders(case: &Case) -> Result<RecorderReading, Failure> {
    is_read(case)?;
    let ground = case.ground_friction();
    let vehicles = VehicleId::ALL.map(|id| {
        let recorder = case.vehicles[id.index()].recorder.as_ref()?;
        let has_table = recorder.pre_crash.is_some() || recorder.pulse.is_some();
        if !has_table && recorder.records.is_empty() {
            return None;
        }
        let turned = case.vehicles[id.index()].yaw_rate_before();
        let of_record = |(record, of_impact): (Recorder, OfImpact)| {
            let delta_v = record.tells_delta_v(case.axes, turned);
            let least = record.least_delta_v(case.axes, turned);
            reading(record, of_impact, ground, [delta_v, least])
        };
        let mut readings: Vec<VehicleReading> =
            records(case, id, recorder).into_iter().map(of_record).collect();
        // If none is taken, the first leads.
        let leading = readings.iter().position(|one| one.of_impact.is_taken).unwrap_or(0);
        let first = readings.remove(leading);
        Some(VehicleReading { others: readings, ..first })
    });
    if vehicles.iter().all(Option::is_none) {
        let reason = "no recorder of the case has a table: neither `pre_crash`, nor `pulse`, nor `records`";
        let advice = "give one in [vehicle1.recorder] or [vehicle2.recorder]: pre_crash = { file = \"edr.csv\" }, \
                      or pre_crash = { text = \"\"\"…\"\"\" } with the table as copied from the report";
        return Err(Failure::Case(Fault::refused("vehicle1.recorder", reason, advice).into()));
    }
    Ok(RecorderReading { vehicles })
}

/// The impact in a pulse by each rule that finds one; of a record that the recorder did not finish, each is a
/// lower bound.
fn spans(recorder: &Recorder) -> Vec<PulseSpan> {
    let Some(pulse) = recorder.during_impact() else { return Vec::new() };
    let found = PulseRule::ALL.into_iter().filter_map(|rule| pulse.span(rule));
    found.map(|span| PulseSpan { complete: span.complete && !recorder.incomplete, ..span }).collect()
}

/// The path to the impact by the samples before it and the median of the speed at the impact (m/s); without
/// that, no point has a distance.
fn path(record: &PreCrash, at_impact: Option<f64>, limits: &SpeedLimits) -> Vec<ClockedSample> {
    let distances = at_impact.map(|speed| record.distances_to_impact(speed, limits)).unwrap_or_default();
    let point = |sample: &PreCrashSample| ClockedSample {
        sample: *sample,
        speed_is_stored: sample.speed.map(|_| true),
        distance: distances.iter().find(|(time, _)| *time == sample.time).map(|(_, bounds)| *bounds),
    };
    let mut path: Vec<ClockedSample> = record.samples().iter().map(point).collect();
    let Some((_, distance)) = distances.last() else { return path };
    // A sample at the impact that has a brake, for example, but no speed.
    let of_impact = path.pop_if(|last| last.sample.time == 0.0);
    let sample = of_impact.map_or_else(PreCrashSample::default, |point| point.sample);
    path.push(ClockedSample {
        sample: PreCrashSample { speed: sample.speed.or(at_impact), ..sample },
        speed_is_stored: Some(sample.speed.is_some()),
        distance: Some(*distance),
    });
    path
}

fn reading(
    recorder: Recorder,
    of_impact: OfImpact,
    ground: Option<f64>,
    delta_v: [Option<RecordersDeltaV>; 2],
) -> VehicleReading {
    let record = recorder.before_impact();
    let pulse = recorder.during_impact();
    let errors = recorder.speed_errors(ground);
    let limits = SpeedLimits::stored_in(errors.step);
    let [delta_v, least_delta_v] = delta_v.map(|told| told.filter(|told| told.is_of_table));
    let speed = recorder.impact_speed(ground);
    let at_impact = speed.as_ref().map(|speed| speed.quantile(0.5));
    VehicleReading {
        of_impact,
        others: Vec::new(),
        step_source: record.filter(|_| recorder.errors.step.is_none()).map(PreCrash::step_source),
        path: record.map(|record| path(record, at_impact, &limits)).unwrap_or_default(),
        speed,
        errors,
        steep: record.map(|record| record.steep_changes(&limits)).unwrap_or_default(),
        spans: spans(&recorder),
        is_cut: pulse.is_some_and(recorder::CrashPulse::is_cut),
        delta_v,
        least_delta_v,
        force_directions: pulse.map(|pulse| pulse.force_directions(LEAST_OF_DIRECTION)).unwrap_or_default(),
        recorder,
    }
}
