//! What a recorder stored, as curves.

use ::drawing::{Axis, Curves, CurvesPicture};
use analysis::{RecorderReading, VehicleReading};
use case::{Case, Recorder};
use pim_core::VehicleId;
use recorder::PulseRule;

use super::axis;
use crate::units::{Measure, Units};
use crate::words;

/// (s) before the impact.
fn time_before() -> Axis {
    Axis { title: "time before the impact, s".to_owned(), unit: 1.0 }
}

fn panel(across: Axis, upward: Axis, curves: [Vec<[f64; 2]>; 2], marks: Vec<f64>) -> Curves {
    Curves { across, ends: None, upward, curves, marks }
}

fn picture(
    case: &Case,
    subtitle: String,
    description: String,
    panels: Vec<Curves>,
    legend: [Option<String>; 2],
) -> CurvesPicture {
    CurvesPicture {
        name: "record-curves",
        title: words::title(case),
        subtitle,
        caveat: String::new(),
        description,
        height: 150.0,
        is_thinned: false,
        panels,
        legend,
    }
}

/// The samples of a vehicle over time and over distance, and its pulse; `None` if there is nothing to draw.
pub(crate) fn curves(
    case: &Case,
    id: VehicleId,
    recorder: &Recorder,
    found: &VehicleReading,
    units: Units,
) -> Option<CurvesPicture> {
    let mut panels = Vec::new();
    if !found.path.is_empty() {
        let samples = || found.path.iter().map(|point| &point.sample);
        let over_time = |of: fn(&recorder::PreCrashSample) -> Option<f64>| -> Vec<[f64; 2]> {
            samples().filter_map(|one| Some([one.time, of(one)?])).collect()
        };
        let mut add = |across: Axis, upward: Axis, curve: Vec<[f64; 2]>| {
            if curve.len() > 1 {
                panels.push(panel(across, upward, [curve, Vec::new()], Vec::new()));
            }
        };
        add(time_before(), axis(units, "speed", Measure::RoadSpeed), over_time(|one| one.speed));
        let brake = over_time(|one| one.brake.map(|on| if on { 1.0 } else { 0.0 }));
        add(
            time_before(),
            Axis { title: "service brake, 1 on, 0 off".to_owned(), unit: 1.0 },
            Curves::steps(&brake),
        );
        add(time_before(), axis(units, "steering wheel", Measure::Angle), over_time(|one| one.steering));
        let over_distance: Vec<[f64; 2]> = found
            .path
            .iter()
            .filter_map(|point| Some([-point.distance?.between, point.sample.speed?]))
            .collect();
        let across = axis(units, "distance before the impact", Measure::Length);
        add(across, axis(units, "speed", Measure::RoadSpeed), over_distance);
    }
    let pulse = recorder.during_impact();
    if let Some(pulse) = pulse {
        let part = |of: fn(&recorder::PulseSample) -> Option<f64>| -> Vec<[f64; 2]> {
            pulse.samples().iter().filter_map(|one| Some([one.time, of(one)?])).collect()
        };
        let marks = found.spans.iter().find(|span| span.rule == PulseRule::CHANGE);
        panels.push(panel(
            Axis { title: "time, ms".to_owned(), unit: 1e-3 },
            axis(units, "ΔV", Measure::RoadSpeed),
            [part(|one| one.longitudinal), part(|one| one.lateral)],
            marks.map(|span| vec![span.start, span.end]).unwrap_or_default(),
        ));
    }
    let names = pulse.map(|_| ["longitudinal, and other numbers", "lateral, positive to the right"]);
    (!panels.is_empty()).then(|| {
        picture(
            case,
            format!("what the recorder of vehicle {id} stored"),
            format!("Speed, brake and steering before the impact and ΔV during it, vehicle {id}"),
            panels,
            names.map_or([None, None], |names| names.map(|name| Some(name.to_owned()))),
        )
    })
}

/// The paths of both vehicles on one clock, if both have a record before the impact.
pub(crate) fn both(case: &Case, reading: &RecorderReading, units: Units) -> Option<CurvesPicture> {
    let path = |id: VehicleId| -> Option<Vec<[f64; 2]>> {
        let found = reading.vehicles[id.index()].as_ref().filter(|found| found.of_impact.is_taken)?;
        let points = found.path.iter();
        let path: Vec<[f64; 2]> =
            points.filter_map(|point| Some([point.sample.time, point.distance?.between])).collect();
        (path.len() > 1).then_some(path)
    };
    let across = time_before();
    let upward = axis(units, "distance to the impact", Measure::Length);
    let paths = [path(VehicleId::One)?, path(VehicleId::Two)?];
    Some(picture(
        case,
        "distance of both vehicles to the impact over time".to_owned(),
        "Distance of both vehicles to the impact over the time before it".to_owned(),
        vec![panel(across, upward, paths, Vec::new())],
        [1, 2].map(|k| Some(format!("vehicle {k}"))),
    ))
}
