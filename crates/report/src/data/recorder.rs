//! What the recorders of a case say alone, as JSON and CSV.

use std::io::{self, Write};

use analysis::{OfImpact, RecorderReading, VehicleReading};
use case::CaseFile;
use pim_core::VehicleId;
use recorder::{DistanceBounds, ImpactSpeed, PreCrash, PulseSpan, RecorderTable, force_direction};
use serde::Serialize;

use super::csv::CsvStyle;
use super::{identified, pretty, title};
use crate::sections::recorder::verdict;

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    axes: &'static str,
    vehicles: [Option<VehicleBlock>; 2],
}

#[derive(Serialize)]
struct VehicleBlock {
    record: WhichBlock,
    other_records: Vec<VehicleBlock>,
    recognised: Vec<TableBlock>,
    speed_at_impact: Option<SpeedBlock>,
    samples: Vec<SampleBlock>,
    pulse: Option<PulseBlock>,
}

/// A record, and whether it is of the impact of the case.
#[derive(Serialize)]
pub(super) struct WhichBlock {
    key: String,
    is_taken: bool,
    probability: f64,
    verdict: String,
    since_previous: Option<f64>,
    delta_v: Option<f64>,
    pdof: Option<f64>,
    complete: bool,
    impact_delta_v: Option<f64>,
    impact_pdof: Option<f64>,
    /// Of the other impacts the one of which it is most probably, from 1.
    other_impact: Option<usize>,
    other_probability: Option<f64>,
}

impl WhichBlock {
    pub(super) fn new(key: String, found: &OfImpact) -> Self {
        let OfImpact { since_previous, event, impact, probability, is_taken, other, .. } = *found;
        Self {
            key,
            is_taken,
            probability,
            verdict: verdict(found),
            since_previous,
            delta_v: event.delta_v,
            pdof: event.force_direction,
            complete: event.complete,
            impact_delta_v: impact.delta_v,
            impact_pdof: impact.force_direction,
            other_impact: other.map(|(place, _)| place),
            other_probability: other.map(|(_, probability)| probability),
        }
    }
}

#[derive(Serialize)]
struct TableBlock {
    layout: &'static str,
    columns: Vec<ColumnBlock>,
    ignored: Vec<String>,
    without_value: Vec<DoubtBlock>,
}

#[derive(Serialize)]
struct ColumnBlock {
    heading: String,
    quantity: &'static str,
    unit: &'static str,
    values: Vec<Option<f64>>,
}

#[derive(Serialize)]
struct DoubtBlock {
    line: usize,
    column: usize,
    quantity: &'static str,
    reason: String,
}

#[derive(Serialize)]
struct SpeedBlock {
    stored: f64,
    stored_at: f64,
    mean: f64,
    sd: f64,
    median: f64,
    interval_50: [f64; 2],
    interval_80: [f64; 2],
    interval_95: [f64; 2],
    parts: Vec<PartBlock>,
    steep_fall: Option<FallBlock>,
}

#[derive(Serialize)]
struct PartBlock {
    source: &'static str,
    shift: f64,
    variance: f64,
}

#[derive(Serialize)]
struct FallBlock {
    deceleration: f64,
    time: f64,
    speed: f64,
}

#[derive(Serialize)]
struct SampleBlock {
    time: f64,
    speed: Option<f64>,
    brake: Option<bool>,
    abs: Option<bool>,
    accelerator: Option<f64>,
    throttle: Option<f64>,
    engine_speed: Option<f64>,
    steering: Option<f64>,
    yaw_rate: Option<f64>,
    distance: Option<DistanceBlock>,
}

#[derive(Serialize)]
struct DistanceBlock {
    at_least: f64,
    left: f64,
    between: f64,
    right: f64,
    at_most: f64,
}

#[derive(Serialize)]
struct PulseBlock {
    ends_before_impact: bool,
    spans: Vec<SpanBlock>,
    delta_v_at_center: Option<[Option<f64>; 2]>,
    accelerations: Vec<AccelerationBlock>,
    pdof: Vec<[f64; 2]>,
}

#[derive(Serialize)]
struct SpanBlock {
    rule: &'static str,
    start: f64,
    end: f64,
    longitudinal: Option<f64>,
    lateral: Option<f64>,
    delta_v: f64,
    pdof: Option<f64>,
    complete: bool,
}

#[derive(Serialize)]
struct AccelerationBlock {
    time: f64,
    longitudinal: Option<f64>,
    lateral: Option<f64>,
}

/// The recorders as indented JSON, ending in a line break: `{"vehicles": [{"record": {"probability": …,
/// "verdict": …}, "other_records": […], "recognised": […],
/// "speed_at_impact": {"mean": …, "sd": …, "interval_95": […], "parts": […]}, "samples": […], "pulse":
/// {"ends_before_impact": …, "spans": […]}}, null]}`. SI and radians; lateral ΔV of the pulse is positive to
/// the right, as recorders have it, and `delta_v_at_center` is along the vehicle and to its left.
///
/// # Errors
/// If serialisation fails, which no record causes.
pub fn recorders_json(file: &CaseFile, reading: &RecorderReading) -> Result<String, serde_json::Error> {
    let case = &file.case;
    let vehicles =
        VehicleId::ALL.map(|id| reading.vehicles[id.index()].as_ref().map(|found| vehicle(id, found)));
    pretty(&identified(file, Document { title: title(case), axes: case.axes.name(), vehicles }))
}

/// Writes the samples before the impact as CSV, a row for each sample of each vehicle: path against time for
/// other programs, in SI and radians, 0 the impact.
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

fn vehicle(id: VehicleId, found: &VehicleReading) -> VehicleBlock {
    let recorder = &found.recorder;
    let tables = recorder.pre_crash.iter().flat_map(|given| &given.tables);
    let tables = tables.chain(recorder.pulse.iter().flat_map(|given| &given.tables));
    let record = recorder.before_impact();
    let samples = record.map(|record| record.samples()).unwrap_or_default().iter();
    let distance = |time: f64| {
        let found = found.distances.iter().find(|(at, _)| *at == time).map(|(_, bounds)| bounds);
        found.map(|DistanceBounds { at_least, left, between, right, at_most }| DistanceBlock {
            at_least: *at_least,
            left: *left,
            between: *between,
            right: *right,
            at_most: *at_most,
        })
    };
    VehicleBlock {
        record: WhichBlock::new(found.of_impact.key(id), &found.of_impact),
        other_records: found.others.iter().map(|other| vehicle(id, other)).collect(),
        recognised: tables.map(table).collect(),
        speed_at_impact: found.speed.as_ref().map(speed),
        samples: samples
            .map(|one| SampleBlock {
                time: one.time,
                speed: one.speed,
                brake: one.brake,
                abs: one.abs,
                accelerator: one.accelerator,
                throttle: one.throttle,
                engine_speed: one.engine_speed,
                steering: one.steering,
                yaw_rate: one.yaw_rate,
                distance: distance(one.time),
            })
            .collect(),
        pulse: pulse(found),
    }
}

fn table(table: &RecorderTable) -> TableBlock {
    TableBlock {
        layout: table.layout.name(),
        columns: table
            .columns
            .iter()
            .map(|column| ColumnBlock {
                heading: column.heading.clone(),
                quantity: column.channel.key(),
                unit: column.unit.name,
                values: column.values.clone(),
            })
            .collect(),
        ignored: table.ignored.iter().map(|(heading, _)| heading.clone()).collect(),
        without_value: table
            .doubts
            .iter()
            .map(|doubt| DoubtBlock {
                line: doubt.place.line,
                column: doubt.place.column,
                quantity: doubt.channel.key(),
                reason: doubt.reason.to_string(),
            })
            .collect(),
    }
}

fn speed(speed: &ImpactSpeed) -> SpeedBlock {
    SpeedBlock {
        stored: speed.stored,
        stored_at: speed.time,
        mean: speed.mean,
        sd: speed.sd,
        median: speed.quantile(0.5),
        interval_50: speed.interval(0.5),
        interval_80: speed.interval(0.8),
        interval_95: speed.interval(0.95),
        parts: speed
            .parts
            .iter()
            .map(|part| PartBlock { source: part.source.key(), shift: part.shift, variance: part.variance })
            .collect(),
        steep_fall: speed.steep_fall.map(|fall| FallBlock {
            deceleration: fall.deceleration,
            time: fall.time,
            speed: fall.speed,
        }),
    }
}

fn pulse(found: &VehicleReading) -> Option<PulseBlock> {
    let pulse = found.recorder.during_impact()?;
    let span = |span: &PulseSpan| SpanBlock {
        rule: span.rule.key(),
        start: span.start,
        end: span.end,
        longitudinal: span.delta_v[0],
        lateral: span.delta_v[1],
        delta_v: span.resultant(),
        pdof: span.delta_v[0].zip(span.delta_v[1]).map(|(along, across)| force_direction([along, across])),
        complete: span.complete,
    };
    Some(PulseBlock {
        ends_before_impact: found.is_cut,
        spans: found.spans.iter().map(span).collect(),
        delta_v_at_center: found.delta_v.map(|told| [told.along, told.left]),
        accelerations: pulse
            .accelerations()
            .into_iter()
            .map(|(time, [longitudinal, lateral])| AccelerationBlock { time, longitudinal, lateral })
            .collect(),
        pdof: found.force_directions.iter().map(|(time, direction)| [*time, *direction]).collect(),
    })
}

/// The columns of a record as CSV: one row for each sample of each vehicle, SI and radians, 0 the impact.
fn rows(reading: &RecorderReading) -> Vec<Vec<String>> {
    let mut rows = vec![
        [
            "vehicle",
            "time",
            "speed",
            "brake",
            "abs",
            "accelerator",
            "throttle",
            "engine_speed",
            "steering",
            "yaw_rate",
            "distance",
            "distance_at_least",
            "distance_at_most",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for id in VehicleId::ALL {
        let Some(found) = &reading.vehicles[id.index()] else { continue };
        let record = found.recorder.before_impact();
        for sample in record.map(PreCrash::samples).unwrap_or_default() {
            let value = |si: Option<f64>| si.map_or_else(String::new, |si| si.to_string());
            let switch = |on: Option<bool>| on.map_or_else(String::new, |on| u8::from(on).to_string());
            let bounds =
                found.distances.iter().find(|(time, _)| *time == sample.time).map(|(_, bounds)| *bounds);
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
                value(bounds.map(|bounds| bounds.between)),
                value(bounds.map(|bounds| bounds.at_least)),
                value(bounds.map(|bounds| bounds.at_most)),
            ]);
        }
    }
    rows
}
