//! What the recorders of a case say alone.

use inputs::{Case, Fault, FaultKind, Recorder, RecordersDeltaV, SeriesSource};
use pim_core::VehicleId;
use recorder::{DistanceBounds, ImpactSpeed, ImpactSpeedErrors, PulseRule, PulseSpan, SpeedLimits};

use crate::failure::Failure;

/// What the recorders of both vehicles say alone.
#[derive(Clone, Debug, PartialEq)]
pub struct RecorderReading {
    /// Of vehicles 1 and 2; `None` for one without a table.
    pub vehicles: [Option<VehicleReading>; 2],
}

/// What the recorder of a vehicle says alone.
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleReading {
    /// Its table and its keys.
    pub recorder: Recorder,
    /// The speed at impact, by the table before it.
    pub speed: Option<ImpactSpeed>,
    /// The errors that it was found with.
    pub errors: ImpactSpeedErrors,
    /// For each sample with a speed its time (s) and the distance from there to the last of them.
    pub distances: Vec<(f64, DistanceBounds)>,
    /// The impact in the pulse by each rule that finds one.
    pub spans: Vec<PulseSpan>,
    /// Whether the pulse ends before the impact does, so that its ΔV is a lower bound.
    pub is_cut: bool,
    /// ΔV at the centre of gravity, if the pulse holds all of it.
    pub delta_v: Option<RecordersDeltaV>,
    /// (rad) principal direction of force of the pulse over time (s), clockwise from the front.
    pub force_directions: Vec<(f64, f64)>,
}

/// (m/s) 5 km/h: of a smaller ΔV its rounding to 1 km/h decides the direction.
const LEAST_OF_DIRECTION: f64 = 5.0 / 3.6;

/// The keys of recorder files that were not read.
fn unread(case: &Case) -> Option<(String, String)> {
    let of = |id: VehicleId, key: &str, source: &SeriesSource, is_read: bool| match source {
        SeriesSource::File(name) if !is_read => {
            Some((format!("vehicle{}.recorder.{key}.file", id.number()), name.to_string()))
        }
        _ => None,
    };
    VehicleId::ALL.into_iter().find_map(|id| {
        let recorder = case.vehicles[id.index()].recorder.as_ref()?;
        let before = recorder.pre_crash.as_ref();
        let before = before.and_then(|given| of(id, "pre_crash", &given.source, given.record.is_some()));
        let pulse = recorder.pulse.as_ref();
        before.or_else(|| pulse.and_then(|given| of(id, "pulse", &given.source, given.pulse.is_some())))
    })
}

/// Refuses a case whose recorder is in a file that nobody read.
pub(crate) fn is_read(case: &Case) -> Result<(), Failure> {
    let Some((key, name)) = unread(case) else { return Ok(()) };
    let reason = format!("the file {name} of the recorder was not read: a case alone has no folder");
    let advice =
        "write the lines of the file into the case: text = \"\"\"…\"\"\" in place of file".to_owned();
    let kind = FaultKind::Refused { reason };
    Err(Failure::Case(Fault { key, kind, advice: Some(advice) }.into()))
}

/// What the recorders of a case say alone.
///
/// # Errors
/// [`Failure`] if no vehicle has a table of a recorder.
pub fn recorders(case: &Case) -> Result<RecorderReading, Failure> {
    is_read(case)?;
    let ground = case.surface.as_ref().map(|surface| surface.friction);
    let vehicles = case.vehicles.each_ref().map(|vehicle| {
        let recorder = vehicle.recorder.as_ref()?;
        let has_table = recorder.pre_crash.is_some() || recorder.pulse.is_some();
        has_table.then(|| reading(recorder, ground, case))
    });
    if vehicles.iter().all(Option::is_none) {
        let reason = "no vehicle has a table of a recorder".to_owned();
        let advice =
            "give one in [vehicle1.recorder] or [vehicle2.recorder]: pre_crash = { file = \"edr.csv\" }, \
                      or pre_crash = { text = \"\"\"…\"\"\" } with the table as it copies out of the report"
                .to_owned();
        let fault = Fault {
            key: "vehicle1.recorder".to_owned(),
            kind: FaultKind::Refused { reason },
            advice: Some(advice),
        };
        return Err(Failure::Case(fault.into()));
    }
    Ok(RecorderReading { vehicles })
}

fn reading(recorder: &Recorder, ground: Option<f64>, case: &Case) -> VehicleReading {
    let record = recorder.pre_crash.as_ref().and_then(|given| given.record.as_ref());
    let pulse = recorder.pulse.as_ref().and_then(|given| given.pulse.as_ref());
    VehicleReading {
        recorder: recorder.clone(),
        speed: recorder.impact_speed(ground),
        errors: recorder.errors.errors(ground),
        distances: record.map(|record| record.distances_to_last(&SpeedLimits::default())).unwrap_or_default(),
        spans: pulse
            .map(|pulse| PulseRule::ALL.into_iter().filter_map(|rule| pulse.span(rule)).collect())
            .unwrap_or_default(),
        is_cut: pulse.is_some_and(recorder::CrashPulse::is_cut),
        delta_v: recorder.tells_delta_v(case.axes).filter(|told| told.is_of_table),
        force_directions: pulse.map(|pulse| pulse.force_directions(LEAST_OF_DIRECTION)).unwrap_or_default(),
    }
}
