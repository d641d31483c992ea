//! The readings of the recorders of a case on their own.

use analysis::{ClockedSample, OfImpact, RecorderReading, VehicleReading};
use case::{Axes, CaseFile, STANDARD_GRAVITY, SeriesSource};
use pim_core::VehicleId;
use recorder::{
    BEYOND_TYRES, KEPT_WITHIN, KnownImpact, LeftTable, MatchErrors, OneAxis, PreCrash, PreCrashSample,
    PulseRule, PulseSpan, RecordMatch, RecorderTable, SpeedErrorPart, SpeedErrorSource, StepSource,
    force_direction,
};

use super::chosen::or_none;
use crate::document::{Block, Column, Document, NONE, Table, Width};
use crate::pictures::recorder as pictures;
use crate::units::{Measure, Units, number, percent};

/// The recorders of a case: what was recognised, the samples with the distances between them, the speed at
/// impact with the account of its error, and the pulse.
#[must_use]
pub fn recorders(file: &CaseFile, reading: &RecorderReading, units: Units) -> Document {
    let case = &file.case;
    let mut page = Document::of_case(case);
    let found: Vec<String> = read_of(reading).flat_map(|(id, found)| headline(id, found, units)).collect();
    page.push(Block::Answer { found, how: "By the recorders alone.".to_owned() });
    for (id, found) in read_of(reading) {
        page.heading(format!("Vehicle {id}"));
        which(&mut page, found, units);
        for record in in_order(found) {
            before(&mut page, file, id, record, units);
            pulse(&mut page, file, id, record, units);
        }
        if let Some(picture) = pictures::curves(case, id, &found.recorder, found, units) {
            page.chart(format!("recorder-{id}"), move || picture.draw());
        }
    }
    if let Some(picture) = pictures::both(case, reading, units) {
        page.heading("Both vehicles on one clock");
        page.paragraph(one_clock(reading));
        page.chart("recorders", move || picture.draw());
    }
    page
}

/// The vehicles that have a table, with what was found.
fn read_of(reading: &RecorderReading) -> impl Iterator<Item = (VehicleId, &VehicleReading)> {
    VehicleId::ALL.into_iter().filter_map(|id| Some((id, reading.vehicles[id.index()].as_ref()?)))
}

fn headline(id: VehicleId, found: &VehicleReading, units: Units) -> Vec<String> {
    let road = |si: f64| units.format(Measure::RoadSpeed, si);
    if !found.of_impact.is_taken {
        let is_open = in_order(found).iter().any(|one| one.of_impact.probability >= RecordMatch::UNLIKELY);
        return vec![if is_open {
            format!("It is not known which record of vehicle {id} is of this impact")
        } else {
            format!("No record of vehicle {id} is likely to be of this impact")
        }];
    }
    let mut lines = Vec::new();
    if let Some(speed) = &found.speed {
        let [low, high] = speed.interval(0.95);
        lines.push(format!(
            "Speed of vehicle {id} at the impact: {} (95 %: {} to {})",
            road(speed.quantile(0.5)),
            units.plain(Measure::RoadSpeed, low),
            road(high)
        ));
        lines.extend(speed.humps.map(|humps| {
            let [last, earlier] =
                humps.map(|hump| format!("{} ({} %)", road(hump.mean), percent(hump.probability)));
            format!(
                "The stored speed falls steeply, so it is about {last} or about {earlier}, hardly in between"
            )
        }));
    }
    if let Some(span) = leading(&found.spans) {
        let of_center = found.delta_v.or(found.least_delta_v).filter(|_| is_of_center(found));
        // A bound of 0 says nothing; that at the place of the recorder does.
        let of_center = of_center.filter(|told| span.complete || told.size() > 0.0);
        let size = road(of_center.map_or_else(|| span.resultant(), |told| told.size()));
        let axis = match span.delta_v {
            [Some(_), None] => " (longitudinal only)",
            [None, Some(_)] => " (lateral only)",
            _ => "",
        };
        let place = if of_center.is_some() {
            " at its centre of gravity"
        } else if found.recorder.at.is_some() {
            " at the place of its recorder"
        } else {
            ""
        };
        lines.push(if span.complete {
            format!("ΔV of vehicle {id}: {size}{axis}{place}, at {}", milliseconds(span.end))
        } else {
            let why = if found.recorder.incomplete {
                "the recorder did not finish the record"
            } else {
                "its record may end before the impact does"
            };
            format!("ΔV of vehicle {id}: at least {size}{axis}{place}, because {why}")
        });
    }
    lines
}

/// Whether the recorder is away from the centre of gravity, and the case has the data to convert ΔV to there.
pub(crate) fn is_of_center(found: &VehicleReading) -> bool {
    found.recorder.at.is_some() && found.recorder.yaw_rate.is_some()
}

/// The common clock of both records, and which of them end before time 0.
fn one_clock(reading: &RecorderReading) -> String {
    let early: Vec<String> = read_of(reading)
        .filter_map(|(id, found)| Some((id, last_before_impact(found)?)))
        .map(|(id, time)| format!("the last speed of vehicle {id} is at {} s", number(time, 2)))
        .collect();
    let early = if early.is_empty() { String::new() } else { format!("; {}", early.join(", and ")) };
    format!(
        "Time 0 and distance 0 are the impact for both records{early}. The speed is linear between the samples, \
         and from the last of them to the impact. Wheel slip is not corrected here, as it is in `deltav avoid`."
    )
}

/// (s) the time of the last stored speed, if it is before the impact.
fn last_before_impact(found: &VehicleReading) -> Option<f64> {
    let speed = found.speed.as_ref()?;
    (speed.time < 0.0).then_some(speed.time)
}

/// The heading of the choice among records.
pub(crate) const WHICH: &str = "Which record is of this impact";

/// Whether a record is of the impact, in words.
pub(crate) fn verdict(found: &OfImpact) -> String {
    let words = RecordMatch::words(found.probability);
    let percent =
        |p: f64| if p > 0.99 { "over 99 %".to_owned() } else { format!("{} %", number(100.0 * p, 0)) };
    let why = found.cannot.map_or_else(|| percent(found.probability), |reason| reason.to_string());
    let other = found.other.filter(|(_, probability)| *probability >= RecordMatch::UNLIKELY);
    let other = other.map_or_else(String::new, |(place, probability)| {
        format!("; of other impact {place}: {}", percent(probability))
    });
    format!("{words}: {why}{other}")
}

/// All records of a vehicle, in the order of time.
fn in_order(found: &VehicleReading) -> Vec<&VehicleReading> {
    let mut records: Vec<&VehicleReading> = std::iter::once(found).chain(&found.others).collect();
    records.sort_by_key(|one| one.of_impact.number);
    records
}

/// The heading of a part of a record, with the number of the record if there are several.
fn part(found: &VehicleReading, name: &str) -> Block {
    let number = found.of_impact.number;
    Block::Subheading(number.map_or_else(|| name.to_owned(), |number| format!("{name}: record {number}")))
}

/// Which record is of the impact of the case, if there are several, or if the only one is probably not.
fn which(page: &mut Document, found: &VehicleReading, units: Units) {
    if !found.of_impact.is_told() {
        return;
    }
    let unit = units.name(Measure::RoadSpeed);
    let mut table = Table::new(WHICH).columns([
        Column::words("record", 7),
        Column::numbers("after the last", 15).unit("s"),
        Column::numbers("ΔV", 9).unit(unit),
        Column::numbers("PDOF", 6).unit("°"),
        Column::words("", Width::Share),
    ]);
    let degrees = |direction: f64| number(direction.to_degrees(), 0);
    for one in in_order(found) {
        let OfImpact { number: place, since_previous, event, .. } = one.of_impact;
        let delta_v = event.delta_v.map(|si| units.plain(Measure::RoadSpeed, si));
        let bound = if event.complete { "" } else { "> " };
        table.row([
            place.map_or_else(|| "1".to_owned(), |place| place.to_string()),
            or_none(since_previous.map(|time| number(time, 2))),
            or_none(delta_v.map(|delta_v| format!("{bound}{delta_v}{}", axis(event.one_axis)))),
            or_none(event.force_direction.map(degrees)),
            verdict(&one.of_impact),
        ]);
    }
    let OfImpact { impact: KnownImpact { force_direction, delta_v }, errors, .. } = found.of_impact;
    let size = delta_v.map(|si| format!("a ΔV of {}", units.format(Measure::RoadSpeed, si)));
    let direction = force_direction.map(|direction| format!("a PDOF of {}°", degrees(direction)));
    let known: Vec<String> = size.into_iter().chain(direction).collect();
    table.note(if known.is_empty() {
        "The case gives neither the ΔV nor the direction of its impact: give `pdof`, or `[impact]` with the \
         headings and contact points of both vehicles; for the ΔV, the crush of both."
            .to_owned()
    } else {
        let by_plane = if errors.direction > MatchErrors::default().direction {
            " Without `pdof`, the force is taken as normal to the crush plane."
        } else {
            ""
        };
        format!(
            "The damage shows {}.{by_plane} The records are compared with it, with errors (standard \
             deviations) of {}° in direction, and more where the rounding of a small ΔV blurs it, and {} % in \
             ΔV. A record that is not complete holds any share of the ΔV; {} % of all records are assumed to be \
             of no impact listed here.",
            known.join(" and "),
            degrees(errors.direction),
            number(100.0 * errors.size, 0),
            number(100.0 * errors.of_none, 0),
        )
    });
    if in_order(found).iter().any(|one| one.of_impact.event.one_axis.is_some()) {
        table.note(
            "x: along the vehicle only, y: across it only. Such a record shows no PDOF; it is compared with the \
             part of the impact along its axis.",
        );
    }
    page.push(table);
}

/// The mark of a ΔV along one axis.
fn axis(one_axis: Option<OneAxis>) -> &'static str {
    match one_axis {
        Some(OneAxis::Longitudinal(_)) => " x",
        Some(OneAxis::Lateral(_)) => " y",
        None => "",
    }
}

/// The leading span: that to the largest ΔV.
pub(crate) fn leading(spans: &[PulseSpan]) -> Option<&PulseSpan> {
    spans.iter().find(|span| span.rule == PulseRule::GreatestDeltaV)
}

fn milliseconds(time: f64) -> String {
    format!("{} ms", number(time * 1000.0, 0))
}

/// What each heading was taken for, and the cells without a value.
fn recognised(page: &mut Document, file: &CaseFile, key: &str, source: &SeriesSource, table: &RecorderTable) {
    let mut rows = Table::new("Recognised").columns([
        Column::words("heading", Width::Fit(30)),
        Column::words("read as", Width::Fit(18)),
        Column::words("unit", Width::Fit(6)),
        Column::numbers("values", Width::Fit(8)),
    ]);
    for column in &table.columns {
        let filled = column.values.iter().flatten().count();
        rows.row([
            case::shown(&column.heading).into_owned(),
            column.channel.name().to_owned(),
            column.unit.name.to_owned(),
            format!("{filled} of {}", column.values.len()),
        ]);
    }
    for (heading, _) in &table.ignored {
        rows.row([
            case::shown(heading).into_owned(),
            "not read".to_owned(),
            NONE.to_owned(),
            NONE.to_owned(),
        ]);
    }
    rows.note(format!("{}: {}.", from(source), table.layout.name()));
    for LeftTable { headings, reason } in &table.left {
        let headings: Vec<String> =
            headings.iter().map(|heading| format!("\"{}\"", case::shown(heading))).collect();
        rows.note(format!("Not read: {}, because {reason}.", headings.join(", ")));
    }
    page.push(rows);
    if table.counted_down {
        page.paragraph("Its times count down to the impact, and are read as negative.");
    }
    if !table.doubts.is_empty() {
        let place = |doubt: &recorder::CellDoubt| match source {
            SeriesSource::Text(text) => {
                file.source.place_in_text(&format!("{key}.text"), text.as_given(), doubt.place)
            }
            SeriesSource::Columns(columns) => {
                columns.iter().find(|(channel, _)| *channel == doubt.channel).and_then(|(channel, text)| {
                    file.source.place_in_text(
                        &format!("{key}.{}", channel.key()),
                        text.as_given(),
                        doubt.place,
                    )
                })
            }
            SeriesSource::File(_) => None,
        };
        let doubts = table.doubts.iter().map(|doubt| {
            let at = place(doubt).unwrap_or(doubt.place);
            format!("{at}, {}: {}", doubt.channel.name(), case::shown(&doubt.reason.to_string()))
        });
        page.paragraph("Without a value, and left out:");
        page.push(Block::List(doubts.collect()));
    }
}

/// The source of a table.
fn from(source: &SeriesSource) -> String {
    match source {
        SeriesSource::Text(_) => "From the text in the case".to_owned(),
        SeriesSource::File(name) => format!("From the file {name}"),
        SeriesSource::Columns(_) => "From the lists in the case".to_owned(),
    }
}

fn before(page: &mut Document, file: &CaseFile, id: VehicleId, found: &VehicleReading, units: Units) {
    let Some(given) = &found.recorder.pre_crash else { return };
    let (Some(table), Some(record)) = (given.tables.first(), &given.record) else { return };
    page.push(part(found, "Before the impact"));
    recognised(page, file, &format!("{}.pre_crash", found.of_impact.key(id)), &given.source, table);
    page.push(samples(found, units));
    if record.speeds().next().is_none() {
        page.paragraph(
            "No sample has a speed: the record gives neither a distance nor a speed at the impact.",
        );
        return;
    }
    let rounding = if found.errors.step > 0.0 {
        format!("are rounded to {}", units.format(Measure::RoadSpeed, found.errors.step))
    } else {
        "are exact".to_owned()
    };
    page.paragraph(format!(
        "The distance is to the impact, by the speed of the wheels. That distance lies between \"at least\" and \
         \"at most\" if the speed changes by at most 1 g either way and the stored values {rounding}. \"Left\" \
         holds each speed until the next sample and \"right\" from the one before; \"between\" is linear. \
         Wheels that slip, as in braking, read low: the vehicle then drove farther, and may have driven \
         farther than \"at most\".",
    ));
    if let Some(time) = last_before_impact(found) {
        page.paragraph(format!(
            "The last speed was stored at {} s. The row at 0 s has the median of the speed at the impact below; \
             from the last stored speed to it, \"between\" is linear.",
            number(time, 2)
        ));
    }
    steep(page, found);
    if let Some(speed) = &found.speed {
        page.push(account(speed, found, units));
        if let Some(fall) = &speed.steep_fall {
            let why = if fall.is_slip {
                "Several samples are that low, so the wheels may have slipped or locked long before the impact."
            } else {
                "The wheels may have slipped, or the sample is of the impact itself."
            };
            let share = number(100.0 * fall.probability, 0);
            page.paragraph(format!(
                "The last speed is {} below that at {} s, a deceleration of {} g. Few tyres slow a vehicle by \
                 more than 1 g, and none by more than {} g. {why} The earlier speed has a weight of {share} %, \
                 the last one the rest.",
                units.format(Measure::RoadSpeed, fall.speed - speed.stored),
                number(fall.time, 2),
                number(fall.deceleration / STANDARD_GRAVITY, 2),
                number(BEYOND_TYRES / STANDARD_GRAVITY, 1),
            ));
        }
    }
}

/// Where the speed changes by more than 1 g, and what the bounds of the distance then are.
fn steep(page: &mut Document, found: &VehicleReading) {
    if found.steep.is_empty() {
        return;
    }
    let places: Vec<String> = found
        .steep
        .iter()
        .map(|one| {
            let [from, to] = one.times.map(|time| number(time, 2));
            let verb = if one.acceleration < 0.0 { "falls" } else { "rises" };
            format!(
                "from {from} to {to} s it {verb} by {} g",
                number(one.acceleration.abs() / STANDARD_GRAVITY, 2)
            )
        })
        .collect();
    page.paragraph(format!(
        "The stored speed changes by more than 1 g: {}. Few tyres do that, and none more than {} g: the \
         wheels probably slipped or gripped again, or the vehicle struck something. There the bounds let the \
         speed change at any instant, and limit it to 1 g only in the other direction.",
        places.join(", "),
        number(BEYOND_TYRES / STANDARD_GRAVITY, 1)
    ));
}

/// The samples and the impact, with the distance from each to the impact.
fn samples(found: &VehicleReading, units: Units) -> Table {
    let (speed, length) = (units.name(Measure::RoadSpeed), units.name(Measure::Length));
    let samples: Vec<&PreCrashSample> = found.path.iter().map(|point| &point.sample).collect();
    let mut columns = vec![Column::numbers("time", 7).unit("s"), Column::numbers("speed", 8).unit(speed)];
    // Columns that the record does not have are omitted.
    let has = |of: fn(&PreCrashSample) -> bool| samples.iter().any(|one| of(one));
    let shown = [
        has(|one| one.brake.is_some()),
        has(|one| one.abs.is_some()),
        has(|one| one.accelerator.or(one.throttle).is_some()),
        has(|one| one.steering.is_some()),
    ];
    let optional = [
        Column::words("brake", 7),
        Column::words("ABS", 5),
        Column::numbers("pedal", 7).unit("%"),
        Column::numbers("steering", 10).unit("°"),
    ];
    columns.extend(optional.into_iter().zip(shown).filter(|(_, shown)| *shown).map(|(column, _)| column));
    for name in ["at least", "right", "between", "left", "at most"] {
        columns.push(Column::numbers(name, 10).unit(length));
    }
    let mut table = Table::new("Samples").columns(columns);
    let pedals = || samples.iter().filter_map(|one| one.accelerator.or(one.throttle));
    let decimals = usize::from(pedals().any(|percent| percent.fract() != 0.0));
    let switch = |on: Option<bool>| on.map_or(NONE, |on| if on { "on" } else { "off" }).to_owned();
    for ClockedSample { sample, distance, .. } in &found.path {
        let mut cells = vec![number(sample.time, 2)];
        cells.push(sample.speed.map_or(NONE.to_owned(), |si| units.plain(Measure::RoadSpeed, si)));
        let optional = [
            switch(sample.brake),
            switch(sample.abs),
            sample
                .accelerator
                .or(sample.throttle)
                .map_or(NONE.to_owned(), |percent| number(percent, decimals)),
            sample.steering.map_or(NONE.to_owned(), |angle| number(angle.to_degrees(), 1)),
        ];
        cells.extend(optional.into_iter().zip(shown).filter(|(_, shown)| *shown).map(|(cell, _)| cell));
        let parts = distance.map(|one| [one.at_least, one.right, one.between, one.left, one.at_most]);
        let metres = |si: f64| number(units.value(Measure::Length, si), 1);
        cells.extend(parts.map_or_else(|| vec![NONE.to_owned(); 5], |parts| parts.map(metres).to_vec()));
        table.cells(cells);
    }
    table
}

/// The speed at impact, and the sources of its error.
fn account(speed: &recorder::ImpactSpeed, found: &VehicleReading, units: Units) -> Table {
    let unit = units.name(Measure::RoadSpeed);
    let plain = |si: f64| units.plain(Measure::RoadSpeed, si);
    let mut table = Table::new("Speed at impact").columns([
        Column::words("", Width::Fit(44)),
        Column::numbers("changes it by", 15).unit(unit),
        Column::numbers("sd", 9).unit(unit),
        Column::numbers("of the variance", 17).unit("%"),
    ]);
    let whole: f64 = speed.parts.iter().map(|part| part.variance).sum();
    table.row([
        format!("stored at {} s", number(speed.time, 2)),
        plain(speed.stored),
        NONE.to_owned(),
        NONE.to_owned(),
    ]);
    // Hardly anything may be cut off.
    let is_nothing = |part: &SpeedErrorPart| {
        let [shift, zero] = [part.shift, 0.0].map(|shift| units.signed(Measure::RoadSpeed, shift));
        part.source == SpeedErrorSource::CutOff && shift == zero
    };
    for part in speed.parts.iter().filter(|part| !is_nothing(part)) {
        let share = if whole > 0.0 { part.variance / whole } else { 0.0 };
        table.row([
            part.source.name().to_owned(),
            units.signed(Measure::RoadSpeed, part.shift),
            if part.variance < 0.0 { NONE.to_owned() } else { plain(part.variance.sqrt()) },
            number(100.0 * share, 0),
        ]);
    }
    table.row(["mean at the impact".to_owned(), plain(speed.mean), plain(speed.sd), "100".to_owned()]);
    let median = "median at the impact: as above".to_owned();
    table.row([median, plain(speed.quantile(0.5)), NONE.to_owned(), NONE.to_owned()]);
    let errors = &found.errors;
    let kmh = |si: f64| units.format(Measure::RoadSpeed, si);
    let percent = |share: f64| number(100.0 * share, 2);
    table.note(format!(
        "Rounding: to {} ({}). Slip: {} % ± {} % low in steady driving, {} ± {} low in hard braking (18 runs of a \
         2010 Ford Flex against GPS), and in between by the deceleration before the last sample, less engine \
         braking if the brake is off. Tyres: ± {} %.",
        kmh(errors.step),
        step_source(found),
        percent(errors.steady_low),
        percent(errors.steady_sd),
        kmh(errors.slip_low),
        kmh(errors.slip_sd),
        percent(errors.tyre_sd),
    ));
    let kept = number(KEPT_WITHIN / STANDARD_GRAVITY, 1);
    table.note(format!(
        "From the last speed to the impact: with the brake on, the vehicle slows by up to {} g, any deceleration \
         as likely. If the brake is on in the last two samples, the driver keeps the deceleration that they \
         show, within {kept} g, with a probability of {} %. With the brake off, the speed changes by at most {} g. \
         {} A stored speed is up to {} s old. All of these numbers but the {kept} g are keys of `errors`.",
        number(errors.friction, 2),
        number(100.0 * errors.keeps_braking, 0),
        number(errors.coasting / STANDARD_GRAVITY, 2),
        brake(found),
        number(errors.latency, 2),
    ));
    if speed.parts.iter().any(|part| part.source == SpeedErrorSource::LastSample) {
        table.note("The stored speed may be that of the impact itself: see below.");
    }
    table
}

/// How the step in which speeds are stored was found.
fn step_source(found: &VehicleReading) -> String {
    match found.step_source {
        None => "`step` of the case".to_owned(),
        Some(StepSource::Regular) => "the step of 49 CFR 563, as the speeds show no coarser one".to_owned(),
        Some(StepSource::Unit) => "all speeds are whole numbers of their unit".to_owned(),
        Some(StepSource::Multiples(count)) => format!("all {count} different speeds are multiples of it"),
        Some(StepSource::Miles(count)) => {
            format!("all {count} different speeds are whole miles per hour, converted")
        }
    }
}

/// The assumption about the brake between the last speed and the impact.
fn brake(found: &VehicleReading) -> String {
    let percent = number(100.0 * found.errors.brake_comes_on, 0);
    let samples = found.recorder.before_impact().map_or(&[][..], PreCrash::samples);
    let comes_on = format!(
        "If the brake is off in the last sample, it comes on with a probability of {percent} % in the first \
         half second, and, if still off, with the same probability in each further half second, at any instant of it."
    );
    if samples.iter().all(|one| one.brake.is_none()) {
        return format!(
            "No sample shows the brake: it is taken to be on with a probability of 50 %. {comes_on}"
        );
    }
    format!(
        "The brake is as the samples show, and changes at any instant between two that differ. {comes_on}"
    )
}

fn pulse(page: &mut Document, file: &CaseFile, id: VehicleId, found: &VehicleReading, units: Units) {
    let recorder = &found.recorder;
    let Some(given) = &recorder.pulse else { return };
    page.push(part(found, "During the impact"));
    for table in &given.tables {
        recognised(page, file, &format!("{}.pulse", found.of_impact.key(id)), &given.source, table);
    }
    if found.spans.is_empty() {
        page.paragraph("The pulse has no impact: ΔV never changes by more than 0.8 km/h in 20 ms.");
        return;
    }
    let unit = units.name(Measure::RoadSpeed);
    let delta_v = |name: &str| Column::numbers(name, 14).unit(unit);
    let mut table = Table::new("Pulse").columns([
        Column::words("by", Width::Fit(28)),
        Column::numbers("from", 7).unit("ms"),
        Column::numbers("to", 7).unit("ms"),
        delta_v("longitudinal"),
        delta_v("lateral"),
        Column::numbers("ΔV", 9).unit(unit),
        Column::numbers("PDOF", 7).unit("°"),
        Column::words("", Width::Fit(12)),
    ]);
    for span in &found.spans {
        let part = |si: Option<f64>| si.map_or(NONE.to_owned(), |si| units.signed(Measure::RoadSpeed, si));
        let direction = match span.delta_v {
            [Some(along), Some(across)] => number(force_direction([along, across]).to_degrees(), 0),
            _ => NONE.to_owned(),
        };
        table.row([
            span.rule.name().to_owned(),
            number(span.start * 1000.0, 0),
            number(span.end * 1000.0, 0),
            part(span.delta_v[0]),
            part(span.delta_v[1]),
            units.plain(Measure::RoadSpeed, span.resultant()),
            direction,
            if span.complete {
                "complete"
            } else if recorder.incomplete {
                "unfinished"
            } else {
                "cut off"
            }
            .to_owned(),
        ]);
    }
    table.note(
        "ISO/TR 12353-3 determines the beginning and the end by methods A, B and C. These rules are that of 49 CFR 563.5 and \
         UN R160 (ΔV changes by more than 0.8 km/h in 20 ms), a mean acceleration above 2 g in 20 ms, and the greatest ΔV of the record. \
         Lateral ΔV is positive to the right; PDOF is where the force comes from, clockwise from the front.",
    );
    page.push(table);
    remarks(page, found);
    let ends_alone = found.recorder.during_impact().is_some_and(|pulse| pulse.alone_from().is_some());
    if let Some(span) = leading(&found.spans).filter(|_| !ends_alone) {
        let alone = match span.delta_v {
            [Some(_), None] => {
                "Only longitudinal ΔV was stored: in an oblique impact the whole ΔV is greater."
            }
            [None, Some(_)] => "Only lateral ΔV was stored: in an oblique impact the whole ΔV is greater.",
            _ => "",
        };
        if !alone.is_empty() {
            page.paragraph(alone);
        }
    }
    if recorder.at.is_some() && found.delta_v.or(found.least_delta_v).is_some() {
        page.paragraph(place(found, file.case.axes, units));
    }
}

/// Remarks on a pulse.
fn remarks(page: &mut Document, found: &VehicleReading) {
    let Some(pulse) = found.recorder.during_impact() else { return };
    if found.recorder.incomplete {
        page.paragraph("The recorder did not finish the record (`incomplete`): its ΔV is a lower bound.");
    }
    if let Some(time) = pulse.padded_from() {
        page.paragraph(format!(
            "From {} on, the record is 0 throughout: the recorder padded it. These zeros are left out.",
            milliseconds(time)
        ));
    }
    if found.is_cut {
        page.paragraph(
            "ΔV changed by more than 0.8 km/h in the last 20 ms of the record, so by 49 CFR 563.5 the impact may \
             continue, and ΔV is a lower bound. The greatest ΔV would be complete if the record then fell back \
             by more than 2 km/h.",
        );
    }
    if let Some([from, to]) = pulse.pause() {
        page.paragraph(format!(
            "ΔV does not change from {} to {}, and then changes again: a second impact, or one with a \
             pause. By the first rule the pulse ends at the pause; by the others it includes both.",
            milliseconds(from),
            milliseconds(to)
        ));
    }
    if let Some(time) = pulse.alone_from() {
        page.paragraph(format!(
            "After {} only one axis has a ΔV; that of the other may have changed further.",
            milliseconds(time)
        ));
    }
}

/// The position of the recorder, and ΔV at the centre of gravity.
fn place(found: &VehicleReading, axes: Axes, units: Units) -> String {
    let told = found.delta_v.or(found.least_delta_v).filter(|_| is_of_center(found));
    let (Some(at), Some(told)) = (found.recorder.at, told) else {
        return "ΔV applies at the place of the recorder: with `yaw_rate` it is converted to the centre of gravity."
            .to_owned();
    };
    let sided = |measure: Measure, value: f64, [positive, negative]: [&str; 2]| {
        format!("{} {}", units.format(measure, value.abs()), if value < 0.0 { negative } else { positive })
    };
    // A bound of 0 has no sense.
    let is_told = |part: &f64| found.delta_v.is_some() || *part != 0.0;
    let part = |part: Option<f64>, senses: [&str; 2]| {
        part.filter(is_told).map(|part| sided(Measure::RoadSpeed, part, senses))
    };
    let along = part(told.along, ["forward", "backward"]);
    let left = part(told.left, ["to the left", "to the right"]);
    let parts: Vec<String> = along.into_iter().chain(left).collect();
    let bound = if found.delta_v.is_some() { "" } else { "at least " };
    let there = if parts.is_empty() {
        "the record gives no lower bound of ΔV".to_owned()
    } else {
        format!("ΔV is {bound}{}", parts.join(" and "))
    };
    format!(
        "The recorder is {} and {} of the centre of gravity, where {there} (ΔV − ΔΩ × r; ΔΩ is the yaw rate \
         after the impact minus that before).",
        sided(Measure::Length, at.x.si(), ["ahead", "behind"]),
        sided(Measure::Length, axes.lateral(at.y.si()), ["to the left", "to the right"]),
    )
}
