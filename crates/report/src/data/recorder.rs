//! The readings of the recorders of a case on their own, as JSON and CSV.

use std::io::{self, Write};

use analysis::{ClockedSample, OfImpact, RecorderReading, VehicleReading};
use case::{Axes, CaseFile, RecordersDeltaV};
use pim_core::VehicleId;
use recorder::{ImpactSpeed, OneAxis, PulseSpan, RecorderTable, StepSource, force_direction};
use serde_json::{Value, json};

use super::csv::CsvStyle;
use super::{identified, list, object, pretty, title};
use crate::sections::recorder::{is_of_center, leading, verdict};

/// A record, and whether it is of the impact of the case. With an `axis`, `delta_v` is the size of the part
/// along it, and `pdof` is null.
pub(super) fn which(key: &str, found: &OfImpact) -> Value {
    let OfImpact { since_previous, event, impact, probability, is_taken, other, .. } = found;
    json!({
        "key": key,
        "is_taken": is_taken,
        "probability": probability,
        "verdict": verdict(found),
        "since_previous": since_previous,
        "delta_v": event.delta_v,
        "pdof": event.force_direction,
        "axis": event.one_axis.map(|axis| match axis {
            OneAxis::Longitudinal(_) => "longitudinal",
            OneAxis::Lateral(_) => "lateral",
        }),
        "complete": event.complete,
        "impact_delta_v": impact.delta_v,
        "impact_pdof": impact.force_direction,
        // The number, from 1, of the other impact to which it most probably belongs.
        "other_impact": other.map(|(place, _)| place),
        "other_probability": other.map(|(_, probability)| probability),
    })
}

/// The recorders as indented JSON, ending in a line break: `{"vehicles": [{"record": {"probability": …,
/// "verdict": …}, "other_records": […], "recognised": […], "speed_at_impact": {"mean": …, "sd": …,
/// "interval_95": […], "parts": […]}, "samples": […], "pulse": {"ends_before_impact": …, "spans": […]}},
/// null]}`. `step` is that of the stored speeds, and `step_source` says how it was found: `"case"`,
/// `"regular"`, `"unit"`, `"multiples"` or `"miles"`. The last of the samples is the impact, at time 0; its
/// speed is the median of that at the impact unless `speed_is_stored`. SI and radians.
///
/// `longitudinal` and `lateral` of the pulse are as stored: to the right if positive, whatever the axes of
/// the case. `delta_v_at_recorder` and `delta_v_at_center` are [along the vehicle, across it] in the axes of
/// the case, as `delta_v_lateral` of other answers is. That at the centre of gravity needs `at` and
/// `yaw_rate`, and is null without. If the record does not hold all of the impact, there are lower bounds
/// instead: `least_delta_v_at_recorder` and `least_delta_v_at_center`.
///
/// # Errors
/// If serialisation fails, which no record causes.
pub fn recorders_json(file: &CaseFile, reading: &RecorderReading) -> Result<String, serde_json::Error> {
    let case = &file.case;
    let vehicles = VehicleId::ALL
        .map(|id| reading.vehicles[id.index()].as_ref().map(|found| vehicle(id, case.axes, found)));
    let document = json!({ "title": title(case), "axes": case.axes.name(), "vehicles": vehicles });
    pretty(&identified(file, document))
}

/// Writes the path to the impact as CSV for other programs, a row for each sample of each vehicle before the
/// impact and one for the impact itself: in SI units and radians, the impact at time 0 and distance 0. Speeds
/// and distances are by the wheels: slip is corrected only in a speed at the impact that was not stored.
///
/// # Errors
/// Those of the output.
pub fn write_records(reading: &RecorderReading, style: CsvStyle, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{}", style.beginning())?;
    for row in rows(reading) {
        let row: Vec<String> = row.into_iter().map(|cell| style.number(cell)).collect();
        writeln!(out, "{}", row.join(&style.separator().to_string()))?;
    }
    Ok(())
}

fn vehicle(id: VehicleId, axes: Axes, found: &VehicleReading) -> Value {
    let recorder = &found.recorder;
    let tables = recorder.pre_crash.iter().flat_map(|given| &given.tables);
    let tables = tables.chain(recorder.pulse.iter().flat_map(|given| &given.tables));
    json!({
        "record": which(&found.of_impact.key(id), &found.of_impact),
        "other_records": list(&found.others, |other| vehicle(id, axes, other)),
        "recognised": list(tables, table),
        "step": found.speed.as_ref().map(|_| found.errors.step),
        "step_source": found.speed.as_ref().map(|_| found.step_source.map_or("case", StepSource::key)),
        "speed_at_impact": found.speed.as_ref().map(speed),
        "samples": list(&found.path, |ClockedSample { sample, speed_is_stored, distance }| object! {
            sample.{time, speed, brake, abs, accelerator, throttle, engine_speed, steering, yaw_rate},
            "speed_is_stored": speed_is_stored,
            "distance": distance.map(|bounds| object! { bounds.{at_least, left, between, right, at_most} }),
        }),
        "pulse": pulse(axes, found),
    })
}

fn table(table: &RecorderTable) -> Value {
    json!({
        "layout": table.layout.name(),
        "columns": list(&table.columns, |column| json!({
            "heading": column.heading,
            "quantity": column.channel.key(),
            "unit": column.unit.name,
            "values": column.values,
        })),
        "ignored": list(&table.ignored, |(heading, _)| heading),
        "left": list(&table.left, |left| json!({
            "headings": left.headings,
            "reason": left.reason.to_string(),
        })),
        "without_value": list(&table.doubts, |doubt| json!({
            "line": doubt.place.line,
            "column": doubt.place.column,
            "quantity": doubt.channel.key(),
            "reason": doubt.reason.to_string(),
        })),
    })
}

fn speed(speed: &ImpactSpeed) -> Value {
    json!({
        "stored": speed.stored,
        "stored_at": speed.time,
        "mean": speed.mean,
        "sd": speed.sd,
        "median": speed.quantile(0.5),
        "interval_50": speed.interval(0.5),
        "interval_80": speed.interval(0.8),
        "interval_95": speed.interval(0.95),
        "parts": list(&speed.parts, |part| json!({
            "source": part.source.key(),
            "shift": part.shift,
            "variance": part.variance,
        })),
        "steep_fall": speed.steep_fall.map(|fall| object! { fall.{deceleration, time, speed, probability} }),
    })
}

fn pulse(axes: Axes, found: &VehicleReading) -> Option<Value> {
    let pulse = found.recorder.during_impact()?;
    let across = |left: f64| axes.lateral(left);
    let stored = |complete: bool| {
        let span = leading(&found.spans).filter(|span| span.complete == complete)?;
        let [along, right] = span.delta_v;
        Some([along, right.map(|right| across(-right))])
    };
    let at_center = |told: Option<RecordersDeltaV>| {
        let told = told.filter(|_| is_of_center(found))?;
        Some([told.along, told.left.map(across)])
    };
    let span = |span: &PulseSpan| {
        json!({
            "rule": span.rule.key(),
            "start": span.start,
            "end": span.end,
            "longitudinal": span.delta_v[0],
            "lateral": span.delta_v[1],
            "delta_v": span.resultant(),
            "pdof": span.delta_v[0].zip(span.delta_v[1]).map(|both| force_direction(both.into())),
            "complete": span.complete,
        })
    };
    Some(json!({
        "ends_before_impact": found.is_cut,
        "spans": list(&found.spans, span),
        "delta_v_at_recorder": stored(true),
        "delta_v_at_center": at_center(found.delta_v),
        "least_delta_v_at_recorder": stored(false),
        "least_delta_v_at_center": at_center(found.least_delta_v),
        "accelerations": list(pulse.accelerations(), |(time, [longitudinal, lateral])| json!({
            "time": time,
            "longitudinal": longitudinal,
            "lateral": lateral,
        })),
        "pdof": found.force_directions,
    }))
}

/// The columns of the path as CSV: one row for each point of each vehicle, in SI units and radians; the
/// impact is at 0.
fn rows(reading: &RecorderReading) -> Vec<Vec<String>> {
    let header = "vehicle,time,speed,brake,abs,accelerator,throttle,engine_speed,steering,yaw_rate,\
                  distance,distance_at_least,distance_at_most,speed_is_stored";
    let mut rows = vec![header.split(',').map(str::to_owned).collect()];
    for id in VehicleId::ALL {
        let path = reading.vehicles[id.index()].iter().flat_map(|found| &found.path);
        for ClockedSample { sample, speed_is_stored, distance } in path {
            let value = |si: Option<f64>| si.map_or_else(String::new, |si| si.to_string());
            let switch = |on: Option<bool>| on.map_or_else(String::new, |on| u8::from(on).to_string());
            rows.push(vec![
                id.number().to_string(),
                sample.time.to_string(),
                value(sample.speed),
                switch(sample.brake),
                switch(sample.abs),
                value(sample.accelerator),
                value(sample.throttle),
                value(sample.engine_speed),
                value(sample.steering),
                value(sample.yaw_rate),
                value(distance.map(|bounds| bounds.between)),
                value(distance.map(|bounds| bounds.at_least)),
                value(distance.map(|bounds| bounds.at_most)),
                switch(*speed_is_stored),
            ]);
        }
    }
    rows
}
