//! What a recorder stored, as curves.

use ::drawing::{Axis, CurveKind, Curves, CurvesPicture};
use analysis::{ClockedSample, RecorderReading, VehicleReading};
use case::{Case, Recorder};
use pim_core::VehicleId;
use recorder::{PreCrashSample, PulseRule, PulseSample};

use super::axis;
use super::motion::of_vehicles;
use crate::units::{Measure, Units};
use crate::words;

/// (s) before the impact.
fn time_before() -> Axis {
    Axis { title: "time before the impact, s".to_owned(), unit: 1.0 }
}

fn panel(across: Axis, upward: Axis, curves: [Vec<[f64; 2]>; 2]) -> Curves {
    Curves {
        across,
        ends: None,
        upward,
        curves,
        samples: Vec::new(),
        computed: Vec::new(),
        marks: Vec::new(),
    }
}

fn picture(
    case: &Case,
    subtitle: String,
    description: String,
    panels: Vec<Curves>,
    legend: Vec<(CurveKind, String)>,
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
    let mut panels = before_impact(&found.path, units);
    let mut shown: Vec<&str> = panels.iter().map(|(words, _)| *words).collect();
    let mut legend = Vec::new();
    let mut explain = |kind: CurveKind, words: &str| legend.push((kind, words.to_owned()));
    if !panels.is_empty() {
        explain(CurveKind::Sample, "stored value");
    }
    if panels.iter().any(|(_, panel)| !panel.computed.is_empty()) {
        explain(CurveKind::Computed, "to the median of the speed at impact");
    }
    if let Some(pulse) = recorder.during_impact() {
        let part = |of: fn(&PulseSample) -> Option<f64>| -> Vec<[f64; 2]> {
            pulse.samples().iter().filter_map(|one| Some([one.time, of(one)?])).collect()
        };
        let curves = [part(|one| one.longitudinal), part(|one| one.lateral)];
        let names = [
            (CurveKind::First, "longitudinal ΔV, positive forward"),
            (CurveKind::Second, "lateral ΔV, positive to the right"),
        ];
        for ((kind, name), _) in names.into_iter().zip(&curves).filter(|(_, curve)| curve.len() > 1) {
            explain(kind, name);
        }
        let marks = found.spans.iter().find(|span| span.rule == PulseRule::CHANGE);
        let marks = marks.map(|span| vec![span.start, span.end]).unwrap_or_default();
        if !marks.is_empty() {
            explain(CurveKind::Mark, "begin and end of the impact, 49 CFR 563.5");
        }
        let across = Axis { title: "time, ms".to_owned(), unit: 1e-3 };
        let upward = axis(units, "ΔV", Measure::RoadSpeed);
        shown.push("ΔV during the impact");
        panels.push(("", Curves { marks, ..panel(across, upward, curves) }));
    }
    let panels: Vec<Curves> = panels.into_iter().map(|(_, panel)| panel).collect();
    (!panels.is_empty()).then(|| {
        picture(
            case,
            format!("what the recorder of vehicle {id} stored"),
            format!("Charts of vehicle {id}: {}", shown.join(", ")),
            panels,
            legend,
        )
    })
}

/// The charts of the time before the impact, with what each shows. Those over time have one axis.
fn before_impact(path: &[ClockedSample], units: Units) -> Vec<(&'static str, Curves)> {
    let ends = path.first().map(|first| [first.sample.time, 0.0]);
    let over_time = |of: fn(&PreCrashSample) -> Option<f64>| -> Vec<[f64; 2]> {
        path.iter().filter_map(|point| Some([point.sample.time, of(&point.sample)?])).collect()
    };
    let over_distance = |point: &ClockedSample| Some([-point.distance?.between, point.sample.speed?]);
    let over_distance: Vec<[f64; 2]> = path.iter().filter_map(over_distance).collect();
    let is_computed = path.last().is_some_and(|last| last.speed_is_stored == Some(false));
    let brake = over_time(|one| one.brake.map(|on| if on { 1.0 } else { 0.0 }));
    let switch = Axis { title: "service brake, 1 on, 0 off".to_owned(), unit: 1.0 };
    let speed = || axis(units, "speed", Measure::RoadSpeed);
    let distance = axis(units, "distance before the impact", Measure::Length);
    let timed = |upward: Axis, curve: Vec<[f64; 2]>| Curves {
        ends,
        ..panel(time_before(), upward, [curve, Vec::new()])
    };
    let charts = [
        ("speed over time", timed(speed(), over_time(|one| one.speed))),
        ("service brake", timed(switch, brake)),
        (
            "steering wheel",
            timed(axis(units, "steering wheel", Measure::Angle), over_time(|one| one.steering)),
        ),
        ("speed over distance", panel(distance, speed(), [over_distance, Vec::new()])),
    ];
    let finished =
        charts.into_iter().filter(|(_, chart)| chart.curves[0].len() > 1).map(|(shows, mut chart)| {
            let curve = &mut chart.curves[0];
            if is_computed && shows.starts_with("speed") {
                chart.computed = curve.split_off(curve.len() - 2);
                curve.push(chart.computed[0]);
            }
            chart.samples.clone_from(curve);
            if shows == "service brake" {
                *curve = Curves::steps(curve);
            }
            (shows, chart)
        });
    finished.collect()
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
        vec![panel(across, upward, paths)],
        of_vehicles().map(|(id, kind)| (kind, format!("vehicle {id}"))).collect(),
    ))
}
