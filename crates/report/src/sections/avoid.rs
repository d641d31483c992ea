//! Whether the collision was avoidable.

use analysis::{
    ActualRun, AvoidChance, AvoidInterval, AvoidRun, AvoidScene, Avoidance, BRAKES, DrivenBy, GIVES_WAY,
    Hiding, Hypothesis, NoEstimate, SIGHT_LOOK_BACK, SameLine, Sight, SpeedSource, Unbraked, View,
    obstacle_name,
};
use case::{
    Along, Avoid, BrakingForm, Case, Clear, GivenDemand, GivenWayOut, OtherApproach, OtherMotionForm,
    OtherParty, PathForm, PlaceForm, Quantity, STANDARD_GRAVITY, Sourced, Text, Velocity,
};
use pim_core::VehicleId;
use reconcile::COLLINEAR;
use time_distance::Swell;

use crate::document::{Block, Column, Document, NONE, Table, Width};
use crate::estimates::{contradictions, median_and_interval};
use crate::outputs::input_name;
use crate::pictures;
use crate::pictures::avoid::{chance_picture, path_time_picture, sight_picture};
use crate::understood::{amount, spread};
use crate::units::{Measure, Units, grouped, number};
use crate::warnings::{message, special_codes};
use crate::words::{quoted, run_words};

/// What avoidability is not.
const NO_GUILT: &str = "Avoidability is a matter of physics. It says nothing about guilt: whether the driver \
 should have expected the danger, driven slower or reacted is for the court.";

/// What the driver did and could have done, side by side, with the inputs, their sources and the conventions.
#[must_use]
pub fn avoid(case: &Case, found: &Avoidance, units: Units) -> Document {
    let mut page = Document::of_case(case);
    page.push(Block::Answer { found: answer(case, found, units), how: how(case, found, units) });
    for doubt in avoid_warnings(found, units) {
        page.paragraph(format!("Warning: {doubt}"));
    }
    let Some(given) = &case.avoid else { return page };
    page.push(inputs(case, given, found, units));
    page.heading("Reaction demand");
    page.paragraph(demand(given, found, units));
    sight(&mut page, case, found, units);
    page.push(runs(case, found, units));
    let picture = path_time_picture(case, found, units);
    page.chart("path-time", move || picture.draw());
    if !found.more_runs.is_empty() {
        page.push(combinations(found, units));
    }
    page.paragraph(on_the_runs(case, found, units));
    if let Some(line) = &found.scene.same_line {
        page.paragraph(on_the_other(found, line, units));
    }
    page.push(just_avoiding(found, units));
    page.push(enough(found, units));
    if let Some(chance) = &found.chance {
        page.push(probability(found, chance, units));
        if let Some(picture) = chance_picture(case, found, units) {
            page.chart("chance", move || picture.draw());
        }
        if !chance.influences.is_empty() {
            page.push(influences(chance));
        }
    }
    page.heading("Definitions and limits");
    page.push(Block::List(definitions(case, found, units)));
    page
}

/// The words for the other party.
fn party(case: &Case) -> String {
    format!("the {}", pictures::avoid::party(case))
}

fn answer(case: &Case, found: &Avoidance, units: Units) -> Vec<String> {
    let scene = &found.scene;
    let limit = units.road_speed(scene.limit);
    let mut lines = Vec::new();
    lines.extend(found.speed_doubt.as_ref().map(|doubt| match doubt {
        NoEstimate::Unconverged => {
            "No probability: the run that weighs the evidence for the speed has not converged. The figures below hold for \
             its median alone. `deltav estimate` says why."
                .to_owned()
        }
        NoEstimate::Contradicted(keys) => {
            format!(
                "No answer: no collision reproduces all of the evidence for the speed, and even the nearest collisions miss {}. \
                 The figures below hold for the median speed alone. `deltav estimate` says more.",
                quoted(keys, " and ")
            )
        }
    }));
    let above = scene.is_above_limit();
    // The verdicts hold for one value of each number, if these are uncertain.
    let central = if found.chance.is_some() { ", by the central values" } else { "" };
    if !above {
        lines.push(format!(
            "The vehicle did not exceed the limit of {limit} between the demand and the impact{central}"
        ));
    }
    // Below the limit, its own speed is what a run with a timely reaction has.
    let at = if above { format!("at {limit}") } else { "at the speed driven".to_owned() };
    if let Some(chance) = &found.chance {
        let either = format!("at {limit}, or the speed driven where that is lower");
        let lower = if (LOW..HIGH).contains(&chance.above_limit) { &either } else { &at };
        let moved = if chance.stationary > 0 { ", if the vehicle moved," } else { "" };
        lines.push(format!(
            "Probability{moved} that it is avoided {lower}: {}; that the vehicle was faster than {limit}: {}",
            at_a_glance(chance.avoided_at_limit),
            at_a_glance(chance.above_limit),
        ));
    }
    let way = |si: f64| units.format(Measure::Way, si);
    let at_limit = scene.at_limit();
    let meeting = scene.meeting(&at_limit);
    let other = found.vehicle.other();
    lines.push(match (scene.stops_at_limit(), scene.least_gap(&at_limit)) {
        (true, None) => {
            let stop = at_limit.stop().unwrap_or(scene.distance);
            format!(
                "Avoidable in space {at}{central}: it stops {} before the place of the impact",
                way(scene.distance - stop)
            )
        }
        (true, Some(gap)) => {
            format!("Avoidable in space {at}{central}: it stays at least {} away from vehicle {other}", way(gap))
        }
        (false, _) => {
            let left = units.road_speed(scene.left_at_limit());
            match meeting.and_then(|meeting| meeting.other) {
                None => format!(
                    "Not avoidable in space {at}{central}: it reaches the place of the impact at {left}"
                ),
                Some(speed) if scene.left_at_limit() <= 0.0 => format!(
                    "Not avoidable in space {at}{central}: it stops, and vehicle {other} then runs into it at {}",
                    units.road_speed(speed)
                ),
                Some(speed) => format!(
                    "Not avoidable in space {at}{central}: it reaches vehicle {other} at {left}; the speed of \
                     vehicle {other} is then {}",
                    units.road_speed(speed)
                ),
            }
        }
    });
    // A vehicle that stops before the place is not late: it never arrives.
    if let Some(is_late) = scene.is_late_at_limit().filter(|_| !scene.stops_at_limit()) {
        let is = if is_late { "Avoidable" } else { "Not avoidable" };
        lines.push(format!(
            "{is} in time {at}{central}: after the demand, {} takes {} to clear the danger zone, and the vehicle {}",
            party(case),
            units.format(Measure::Time, scene.time + scene.clears.map_or(0.0, |clears| clears.after)),
            match meeting {
                Some(meeting) => format!("arrives after {}", units.format(Measure::Time, meeting.time)),
                None => "stops before".to_owned(),
            }
        ));
    }
    if is_avoided_as_it_was(found) {
        lines.push(format!(
            "With the reaction and braking that it had, better than those of the inputs, it is avoided \
             {at}{central}"
        ));
    }
    lines.push(if found.enough.speed > 0.0 {
        format!("Highest speed that avoids it{central}: {}", units.road_speed(found.enough.speed))
    } else {
        format!("No speed avoids it{central}: vehicle {other} would reach even a stationary vehicle")
    });
    let determined = match found.undetermined() {
        Some(_) => "a speed that the evidence does not determine, taken as ",
        None => "",
    };
    lines.push(format!(
        "Vehicle {} at the reaction demand: {determined}{}, {} and {} before the impact",
        found.vehicle,
        units.speed(scene.speed),
        units.format(Measure::Way, scene.distance),
        units.format(Measure::Time, scene.time),
    ));
    if let Some(sight) = scene.view.sight() {
        lines.push(format!(
            "Continuously in sight for the last {} and {} before the impact",
            units.format(Measure::Time, sight.time),
            units.format(Measure::Way, sight.distance_subject),
        ));
    }
    lines
}

/// A probability in the digits that its inputs justify, if these do not round it to 0 or 1.
fn at_a_glance(probability: f64) -> String {
    if (0.005..0.995).contains(&probability) { number(probability, 2) } else { in_decimals(probability) }
}

/// A probability with three decimals, which would round some to 0 or 1.
fn in_decimals(probability: f64) -> String {
    match probability {
        high if high >= HIGH => "above 0.999".to_owned(),
        low if low < LOW => "below 0.001".to_owned(),
        between => number(between, 3),
    }
}

/// The ends of an interval, or the one value of what does not vary.
fn from_to(interval: AvoidInterval, shown: impl Fn(f64) -> String) -> String {
    let [low, high] = [interval.low, interval.high].map(shown);
    if low == high { low } else { format!("{low} to {high}") }
}

/// Its error, if three decimals show the probability.
fn error_between(probability: f64, error: f64) -> Option<f64> {
    (LOW..HIGH).contains(&probability).then_some(error)
}

/// Probabilities that three decimals round to 0 and 1.
const LOW: f64 = 0.0005;
const HIGH: f64 = 0.9995;

/// Objections to the inputs of an avoidability question, as sentences.
#[must_use]
pub fn avoid_warnings(found: &Avoidance, units: Units) -> Vec<String> {
    let deceleration = found.scene.response.deceleration();
    let share = deceleration / STANDARD_GRAVITY;
    let hard = (share > GREATEST_LISTED).then(|| {
        format!(
            "The deceleration of the inputs, {}, is {} g. For new dry asphalt or concrete, the EDCRASH manual \
             lists friction of at most 1.00 above 48 km/h (30 mph) and 1.20 below: check the deceleration, or \
             name the test behind it.",
            units.format(Measure::Acceleration, deceleration),
            number(share, 2)
        )
    });
    let lead = found.scene.view.sight().map(|sight| found.scene.time - sight.time);
    let early = lead.filter(|lead| *lead > SAME_MOMENT).map(|lead| {
        format!(
            "The reaction demand is {} before the other party came into sight: say in its `reason` how the \
             driver could recognize the danger, or write demand = {{ sight = true }}.",
            units.format(Measure::Time, lead)
        )
    });
    let begins = found.scene.begins().filter(|begins| *begins > SAME_MOMENT).map(|begins| {
        format!(
            "The case shows how the vehicle moved only from {} after the reaction demand. Before that, the \
             answer assumes the speed at that moment{}.",
            units.format(Measure::Time, begins),
            if found.chance.is_some() {
                "; the probability does not include the error of this assumption"
            } else {
                ""
            }
        )
    });
    let along = along_the_line(found, units);
    let of_other = of_the_other(found, units);
    let of_recorder = of_recorder(found, units);
    let of_stood = found.other_may_have_stood().map(|stood| {
        let percent = number(100.0 * stood, 0);
        format!(
            "Vehicle {} was stationary with a probability of {percent} %. The central values hold for the case that it moved; the \
             probability accounts for both cases.",
            found.vehicle.other()
        )
    });
    let ours = [hard, early, begins, along, of_other, of_recorder, of_stood];
    let ours = ours.into_iter().flatten();
    let ours = ours.chain(beaten_by_marks(found, units)).chain(beaten_by_what_happened(found, units));
    ours.chain(of_speed(found, units)).chain(contradictions(found.pieces())).collect()
}

/// What a place of the impact that moves does to an answer for a fixed one.
fn along_the_line(found: &Avoidance, units: Units) -> Option<String> {
    let other = found.vehicle.other();
    let comes_on = found
        .scene
        .same_line
        .as_ref()
        .filter(|line| line.along == Along::Oncoming && line.deceleration <= 0.0);
    if comes_on.is_some() {
        return Some(format!(
            "The answer assumes that vehicle {other} drives on without braking, even towards a stationary vehicle. The case does not \
             say whether its driver would have stopped or given way; if so, less would have been enough."
        ));
    }
    let off = found.nearly_along?;
    let vehicle = found.vehicle;
    let is_on_line = off.angle <= COLLINEAR;
    let angle = units.format(Measure::Angle, off.angle);
    let line = units.format(Measure::Angle, COLLINEAR);
    if found.scene.same_line.is_some() {
        return Some(format!(
            "The directions of the two vehicles are {angle} off one line. Up to {line} counts as one line; \
             beyond that, the answer would take the place of the impact as fixed, and differ. The probability \
             does not include a range of the headings."
        ));
    }
    let moved = match (off.along, is_on_line) {
        (Along::Ahead, true) => {
            format!("Vehicle {other} was ahead in nearly the same direction. If it was moving, it")
        }
        (Along::Ahead, false) => {
            format!("Vehicle {other} moved in a direction only {angle} from that of vehicle {vehicle}, and")
        }
        (Along::Oncoming, true) => {
            format!("Vehicle {other} faced vehicle {vehicle} on nearly the same line. If it was moving,")
        }
        (Along::Oncoming, false) => {
            format!("Vehicle {other} approached vehicle {vehicle}, only {angle} off its line, so")
        }
    };
    let errs = match off.along {
        Along::Ahead => format!(
            "would have moved on while vehicle {vehicle} braked: slowing to its speed in time would have been enough. The answer \
             takes the place of the impact as fixed, and so asks more of the driver than was needed."
        ),
        Along::Oncoming => format!(
            "stopping before the place of the impact avoids the collision only if vehicle {other} also stops \
             or gives way. The answer takes that place as fixed, and so asks less of the driver than was needed."
        ),
    };
    let remedy = if is_on_line {
        format!("Give `speed` in [vehicle{other}], and the answer takes its motion into account.")
    } else {
        format!(
            "Up to {line}, the answer takes such a motion into account; if the vehicles did move along one \
             line, give headings that say so."
        )
    };
    Some(format!("{moved} {errs} {remedy}"))
}

/// What the demand says of the other vehicle against what the rest of the case says.
fn of_the_other(found: &Avoidance, units: Units) -> Option<String> {
    let other = found.vehicle.other();
    let [by_demand, known] = found.other_speeds?.map(|speed| units.road_speed(speed));
    Some(format!(
        "By `demand`, vehicle {other} reached the impact at {by_demand}; by the rest of the case, at {known}. \
         The answer takes the time from the demand and all else from the rest: correct one of them."
    ))
}

/// What its own recorder says against the speed of the vehicle.
fn of_recorder(found: &Avoidance, units: Units) -> Option<String> {
    let [used, recorded] = found.own_speeds?.map(|speed| units.road_speed(speed));
    Some(format!(
        "By its recorder, vehicle {} had {recorded} at the impact, but this answer has {used} there. Correct \
         one of them, or give no speed: the recorder then gives it.",
        found.vehicle
    ))
}

/// What the solution behind the speed warns of, by its codes: its own report has the sentences.
fn of_speed(found: &Avoidance, units: Units) -> Vec<String> {
    let command = match found.speed_from {
        SpeedSource::Reconstructed => "reconstruct",
        SpeedSource::Estimated => "estimate",
        _ => {
            let said = found.speed_warnings.iter().map(|warning| message(warning, units));
            return said.map(|said| format!("Note that {said}.")).collect();
        }
    };
    let mut codes = special_codes(&found.speed_warnings);
    codes.sort_unstable();
    if codes.is_empty() {
        return Vec::new();
    }
    vec![format!(
        "The speed is from `deltav {command}`, whose report warns: {}. Read it before you use the speed.",
        codes.join(", ")
    )]
}

/// If the marks show a better driver or better brakes than the inputs of `[avoid]`, these give no run better
/// than what happened.
fn beaten_by_marks(found: &Avoidance, units: Units) -> Vec<String> {
    let ActualRun::Skidded(shown) = found.scene.actual else { return Vec::new() };
    let given = found.scene.response;
    let time = |si: f64| units.format(Measure::Time, si);
    let rate = |si: f64| units.format(Measure::Acceleration, si);
    let sooner = (shown.reaction() < given.reaction() - SAME_REACTION).then(|| {
        format!(
            "The marks show that the driver braked {} after the demand, sooner than the reaction time of the \
             inputs, {}: a run with that reaction is worse than what happened. Check the demand and the \
             reaction time; the run at the limit, else as it was, has the braking that the marks show.",
            time(shown.reaction()),
            time(given.reaction())
        )
    });
    let harder = (shown.deceleration() > given.deceleration() * (1.0 + SAME_RATE)).then(|| {
        format!(
            "The marks show a deceleration of {}, more than the full braking of the inputs, {}: a run with \
             that braking is worse than what happened. Give the greater of the two as `deceleration`.",
            rate(shown.deceleration()),
            rate(given.deceleration())
        )
    });
    sooner.into_iter().chain(harder).collect()
}

/// The same for phases and recorders, and a vehicle that already braked at the demand.
fn beaten_by_what_happened(found: &Avoidance, units: Units) -> Vec<String> {
    let ActualRun::Driven(by) = found.scene.actual else { return Vec::new() };
    let shown = match by {
        DrivenBy::Phases => "the phases show",
        DrivenBy::Recorder => "the recorder shows",
    };
    let before = found.scene.braked_at_demand().map(|rate| {
        format!(
            "At the reaction demand the vehicle already braked with {}. Each run with a reaction assumes no braking \
             until the reaction ends, so it is worse than what was possible: check whether the demand was earlier.",
            units.format(Measure::Acceleration, rate)
        )
    });
    let better = is_avoided_as_it_was(found).then(|| {
        format!(
            "At the limit, the vehicle avoids the collision with the braking that {shown}, but not with the reaction and \
             braking of the inputs, which are therefore worse than what happened. Check the demand, the reaction \
             time and the deceleration."
        )
    });
    before.into_iter().chain(better).collect()
}

/// Whether the vehicle avoids the collision at the limit with its own reaction and braking, but not with
/// those of the inputs.
fn is_avoided_as_it_was(found: &Avoidance) -> bool {
    let scene = &found.scene;
    let is_avoided = scene.stops_at_limit() || scene.is_late_at_limit() == Some(true);
    scene.is_above_limit() && !is_avoided && scene.is_avoided_else_as_it_was()
}

/// How much later (s) than with the reaction time of the inputs something was.
fn against_inputs(late: f64, units: Units) -> String {
    if late.abs() < SAME_PRINTED {
        return "as with the reaction time of the inputs".to_owned();
    }
    let compared = if late > 0.0 { "later" } else { "earlier" };
    format!(
        "{} {compared} than with the reaction time of the inputs",
        units.format(Measure::Time, late.abs())
    )
}

/// (s) how far two reaction times may be apart and still be the same: hardly any is known better.
const SAME_REACTION: f64 = 0.2;
/// (–) how far two decelerations may be apart and still be the same: what prints alike.
const SAME_RATE: f64 = 0.005;

/// (–) deceleration by g, beyond which no source is at hand for most speeds and surfaces.
const GREATEST_LISTED: f64 = 1.0;

fn how(case: &Case, found: &Avoidance, units: Units) -> String {
    let recorder = case.vehicles[found.vehicle.index()].recorder.as_ref();
    let has_record = recorder.is_some_and(|recorder| recorder.before_impact().is_some());
    let speed = match found.speed_from {
        SpeedSource::AtDemand if has_record => &format!(
            "The speed is from [avoid]. The table of the recorder of vehicle {} is not used: it counts if [avoid] has no `speed`",
            found.vehicle
        ),
        SpeedSource::AtDemand => "The speed is from [avoid]",
        SpeedSource::AtImpact => "The speed at the impact is from the case",
        SpeedSource::Reconstructed => "The speed at the impact is from `deltav reconstruct`",
        SpeedSource::Estimated => {
            let exact = found.exact_speed().map(|exact| {
                let exact = units.road_speed(exact);
                format!("; `deltav reconstruct`, which takes its evidence as exact, finds {exact}")
            });
            let exact = exact.unwrap_or_default();
            let doubt = found.undetermined().map(|speed| {
                let [_, interval] = median_and_interval(&speed.posterior, units);
                format!(
                    ". The evidence does not determine it (95 %: {interval} {}): it and the probabilities depend on what is assumed \
                     about such collisions",
                    units.name(Measure::RoadSpeed)
                )
            });
            let doubt = doubt.unwrap_or_default();
            let moved = found.may_have_stood().map(|stood| {
                let percent = number(100.0 * stood, 0);
                format!(", if the vehicle moved (it was stationary with a probability of {percent} %)")
            });
            let moved = moved.unwrap_or_default();
            &format!(
                "The speed at the impact is the median of `deltav estimate`, from all evidence{moved}{exact}{doubt}"
            )
        }
        SpeedSource::Phases => "The speed at the impact follows from the phases before it",
        SpeedSource::Recorder => "The speed at the impact is the median from the recorder's table",
    };
    format!("Time and distance count from the reaction demand (theory 13). {speed}.")
}

fn inputs(case: &Case, given: &Avoid, found: &Avoidance, units: Units) -> Table {
    let other = found.on_line();
    let names_phases = other.is_some_and(|other| !case.vehicles[other.index()].phases().is_empty());
    let mut table = Table::new("Inputs").columns([
        Column::words("", if names_phases { 34 } else { 25 }),
        Column::words("value", 14),
        Column::words("range", 24),
        Column::words("source", Width::Share),
    ]);
    let mut number = |label: &str, key: &str, quantity: &Quantity, source: Option<&Text>| {
        let range =
            case.ranges.iter().find(|range| range.path == key).map_or_else(|| NONE.to_owned(), spread);
        let source = source.map_or_else(|| "none given".to_owned(), ToString::to_string);
        table.row([label.to_owned(), amount(quantity.number(), Some(quantity.unit())), range, source]);
    };
    let phases =
        |id: VehicleId| case.vehicles[id.index()].phases().iter().enumerate().map(move |of| (id, of));
    for (id, (index, phase)) in phases(found.vehicle).chain(other.into_iter().flat_map(phases)) {
        let whose = if id == found.vehicle { String::new() } else { format!("vehicle {id}, ") };
        let form = &phase.form;
        for (word, given) in [
            ("speed", &form.speed),
            ("distance", &form.distance),
            ("time", &form.time),
            ("acceleration", &form.acceleration),
        ] {
            if let Some(quantity) = given {
                let place = index + 1;
                let key = format!("vehicle{id}.before.phase[{place}].{word}");
                number(&format!("{whose}phase {place}: {word}"), &key, quantity, phase.source.as_ref());
            }
        }
    }
    if let (Some(other), Some(Velocity::Speed(speed))) =
        (other, other.and_then(|other| case.vehicles[other.index()].motion.as_ref()))
    {
        number(&format!("vehicle {other}: speed"), &format!("vehicle{other}.speed"), speed, None);
    }
    let mut row = |label: &str, key: &str, sourced: &Sourced| {
        number(label, key, &sourced.quantity, sourced.source.as_ref());
    };
    for (label, key, sourced) in [
        ("speed at the demand", "avoid.speed", &given.speed),
        ("limit", "avoid.limit", &given.limit),
        ("reaction time t_R", "avoid.reaction_time", &given.reaction_time),
        ("brake build-up t_S", "avoid.swell", &given.swell),
        ("full deceleration a", "avoid.deceleration", &given.deceleration),
        ("sight: heading", "avoid.sight.heading", &given.sight.heading),
        ("sight: other's heading", "avoid.sight.other_heading", &given.sight.other_heading),
        ("sight: other's speed", "avoid.sight.other_speed", &given.sight.other_speed),
    ] {
        if let Some(sourced) = sourced {
            row(label, key, sourced);
        }
    }
    match &given.demand {
        Some(GivenDemand::Distance(distance)) => row("demand: distance", "avoid.demand.distance", distance),
        Some(GivenDemand::Time(time)) => row("demand: time", "avoid.demand.time", time),
        Some(GivenDemand::Other(OtherApproach { distance, speed, acceleration })) => {
            row("demand: other's path", "avoid.demand.other.distance", distance);
            if let Some(acceleration) = acceleration {
                row("other's acceleration", "avoid.demand.other.acceleration", acceleration);
            }
            if let Some(speed) = speed {
                row("demand: other's speed", "avoid.demand.other.speed", speed);
            }
        }
        Some(GivenDemand::Sight) | None => {}
    }
    let mut goes_on = false;
    let mut by_outlines = None;
    if let Some(Clear { way, speed }) = &given.clear {
        match way {
            GivenWayOut::Distance(distance) => {
                row("distance to clear zone", "avoid.clear.distance", distance);
            }
            GivenWayOut::Outlines => by_outlines = found.scene.clears,
        }
        match speed {
            Some(speed) => row("speed to clear zone", "avoid.clear.speed", speed),
            None => goes_on = true,
        }
    }
    if let Some(clears) = by_outlines {
        table.note(format!(
            "From the impact, the other vehicle travels {}{} until its outline has left the strip that vehicle \
             {} sweeps; each moves straight along its heading.",
            units.format(Measure::Way, clears.distance),
            if clears.backs { " backward" } else { "" },
            found.vehicle
        ));
    }
    if goes_on {
        let clears = found.scene.clears.filter(|clears| clears.after > 0.0);
        let speed = clears.map(|clears| clears.distance / clears.after);
        table.note(match (&given.demand, speed) {
            (Some(GivenDemand::Other(_)), _) | (_, None) => {
                "The other party continues as it approached.".to_owned()
            }
            (_, Some(speed)) => format!(
                "The other party continues at the speed of its vehicle at the impact, {}.",
                units.road_speed(speed)
            ),
        });
    }
    if given.swell.is_none() {
        table.note("The brake build-up time is 0 because the case gives none.");
    }
    if given.speed.is_none() {
        table.note(format!(
            "The speed at the impact, {}, is not an input of [avoid].",
            units.road_speed(found.scene.at_impact)
        ));
    }
    let missing = analysis::without_source(given);
    if !missing.is_empty() {
        table.note(format!(
            "Without a source: {}. An input without an origin is worth little in court.",
            missing.join(", ")
        ));
    }
    table
}

/// How the other party approached.
fn manner(other: &OtherApproach) -> String {
    let of = |sourced: &Sourced| sourced.quantity.to_string();
    match (&other.acceleration, &other.speed) {
        (None, speed) => format!("at {}", speed.as_ref().map_or_else(String::new, of)),
        (Some(acceleration), None) => format!("from a stop at {}", of(acceleration)),
        (Some(acceleration), Some(speed)) => {
            format!("from a stop at {} up to {}", of(acceleration), of(speed))
        }
    }
}

fn demand(given: &Avoid, found: &Avoidance, units: Units) -> String {
    let scene = &found.scene;
    let [distance, time] = [(Measure::Way, scene.distance), (Measure::Time, scene.time)]
        .map(|(measure, value)| units.format(measure, value));
    let by = match &given.demand {
        Some(GivenDemand::Other(other)) => {
            format!(
                " It follows from the other party's approach, {} {}.",
                other.distance.quantity,
                manner(other)
            )
        }
        Some(GivenDemand::Sight) => " From that moment, no obstacle hides the other party.".to_owned(),
        _ => String::new(),
    };
    let is_sight = matches!(given.demand, Some(GivenDemand::Sight));
    let reason = given.demand_reason.as_ref().map_or_else(
        || {
            if is_sight {
                String::new()
            } else {
                " The case does not say why (`reason` of `demand`).".to_owned()
            }
        },
        |reason| format!(" The reason: {reason}."),
    );
    format!(
        "The danger could first be recognized when the vehicle was {distance} and {time} before the impact.{by}{reason} Every run \
         below begins there."
    )
}

/// When the view became clear, and how that is known; the plan of both, if the case says how they approached.
fn sight(page: &mut Document, case: &Case, found: &Avoidance, units: Units) {
    match found.scene.view {
        View::Open => {}
        View::NeverHidden => {
            page.heading("Sight");
            page.paragraph(format!(
                "The obstacles never hide {} in the {SIGHT_LOOK_BACK} s before the impact.",
                party(case)
            ));
        }
        View::Free(sight) => {
            page.push(free(case, found, &sight, units));
            page.paragraph(view_and_demand(found, &sight, units));
        }
    }
    if found.scene.view != View::Open {
        page.paragraph(ways(case));
    }
    if let Some(picture) = sight_picture(case, found, units) {
        page.chart("sight", move || picture.draw());
    }
}

fn free(case: &Case, found: &Avoidance, sight: &Sight, units: Units) -> Table {
    let mut table = Table::new("Sight").columns([
        Column::words("", 44),
        Column::numbers("", 14),
        Column::numbers("95 % interval", 20),
    ]);
    let intervals = found.chance.as_ref().and_then(|chance| chance.sight.as_ref());
    let mut row = |label: String, measure, value: f64, interval: Option<&AvoidInterval>| {
        table.row([label, units.format(measure, value), ends(interval, measure, units)]);
    };
    row(
        "continuously in sight before the impact".to_owned(),
        Measure::Time,
        sight.time,
        intervals.map(|of| &of.time),
    );
    row(
        format!("distance vehicle {} covers in this time", found.vehicle),
        Measure::Way,
        sight.distance_subject,
        intervals.map(|of| &of.distance_subject),
    );
    row(
        format!("distance {} covers in this time", party(case)),
        Measure::Way,
        sight.distance_other,
        intervals.map(|of| &of.distance_other),
    );
    table.notes.extend(hidden(case, found.hiding.as_ref(), units));
    if let Some(share) = intervals.map(|of| of.never_hidden).filter(|share| *share > 0.0) {
        table.note(format!(
            "In {} of the samples, the obstacles hide nothing in the {SIGHT_LOOK_BACK} s before the impact; \
             the intervals come from the others.",
            number(share, 3)
        ));
    }
    table
}

/// The ends of an interval, if nothing makes the number exact.
fn ends(interval: Option<&AvoidInterval>, measure: Measure, units: Units) -> String {
    interval.filter(|interval| interval.low < interval.high).map_or_else(
        || NONE.to_owned(),
        |AvoidInterval { low, high, .. }| {
            format!("{} to {}", units.plain(measure, *low), units.plain(measure, *high))
        },
    )
}

/// What hid the other party until then.
fn hidden(case: &Case, hiding: Option<&Hiding>, units: Units) -> Vec<String> {
    let Some(hiding) = hiding else { return Vec::new() };
    let by = hiding.by.map(|index| {
        let name = obstacle_name(case, index);
        let source = case.avoid.as_ref().and_then(|avoid| avoid.obstacles.get(index)?.source.as_ref());
        let source =
            source.map_or_else(|| "no source given".to_owned(), |source| format!("source: {source}"));
        let party = party(case);
        if hiding.is_inside {
            format!("Until then, {party} was within {name} ({source}).")
        } else {
            format!("Until then, {name} hid {party} ({source}).")
        }
    });
    let earlier = hiding.seen_earlier.map(|time| {
        let first = if time >= SIGHT_LOOK_BACK {
            String::new()
        } else {
            format!(", first {} before the impact", units.format(Measure::Time, time))
        };
        format!(
            "Before that, {} had been in sight{first}; the program looks back {SIGHT_LOOK_BACK} s.",
            party(case)
        )
    });
    by.into_iter().chain(earlier).collect()
}

fn view_and_demand(found: &Avoidance, sight: &Sight, units: Units) -> String {
    let by = found.scene.time - sight.time;
    let time = units.format(Measure::Time, by.abs());
    if by.abs() <= SAME_MOMENT {
        "The reaction demand is that moment.".to_owned()
    } else if by > 0.0 {
        format!("The reaction demand is {time} earlier than that.")
    } else {
        format!("The reaction demand is {time} later than that.")
    }
}

/// From where to where the driver looks.
fn ways(case: &Case) -> String {
    let Some(form) = case.avoid_plan() else { return String::new() };
    let how = |form: &PlaceForm| match form {
        PlaceForm::Given(_) => "at the place given",
        PlaceForm::Position(_) => "at the centre of gravity of the vehicle",
        PlaceForm::Contact(_) => "at the point of contact",
        PlaceForm::Origin => "at the origin of the scene, because no place is given",
    };
    let path = |path: &PathForm| match path {
        PathForm::Straight(heading) => format!("in a straight line in the direction {heading}"),
        PathForm::Along(points) => {
            let count = points.len();
            format!("through the {count} point{} given", if count == 1 { "" } else { "s" })
        }
    };
    let way = |other: &OtherMotionForm| match (&other.braking, other.speed) {
        (BrakingForm::Phases(_), _) => "as its phases show".to_owned(),
        (BrakingForm::Skid { .. }, _) => "as its skid marks show".to_owned(),
        (BrakingForm::Recorded { .. }, _) => "as its recorder shows".to_owned(),
        (BrakingForm::Unknown | BrakingForm::Unbraked, speed) => {
            let known = |speed| format!("at a constant {speed}");
            speed.map_or_else(|| "at the speed that the evidence gives".to_owned(), known)
        }
    };
    format!(
        "At the impact, the driver's eye is {}, and the first visible part of {} is {}. The vehicle approaches the impact {}, the \
         other party {} {}.",
        how(&form.eye),
        party(case),
        how(&form.point),
        path(&form.path),
        path(&form.other_path),
        way(&form.other),
    )
}

/// (s) two moments that are printed alike.
const SAME_PRINTED: f64 = 0.005;
/// (s) two moments are taken to be the same.
const SAME_MOMENT: f64 = 1e-6;

fn runs(case: &Case, found: &Avoidance, units: Units) -> Table {
    let columns = found.runs.iter().map(|run| {
        let [first, second] = run_words(run.hypothesis).head;
        Column::numbers(first, Width::Fit(0)).goes_on(second)
    });
    let first = Column::words("", Width::Fit(24));
    let mut table = Table::new("What happened, and what would have")
        .columns(std::iter::once(first).chain(columns).collect::<Vec<_>>());
    let mut row = |label: String, of: &dyn Fn(&AvoidRun) -> Option<String>| {
        let cells: Vec<Option<String>> = found.runs.iter().map(of).collect();
        if cells.iter().any(Option::is_some) {
            let cells = cells.into_iter().map(|cell| cell.unwrap_or_else(|| NONE.to_owned()));
            table.cells(std::iter::once(label).chain(cells));
        }
    };
    let label = |words: &str, measure| format!("{words}, {}", units.name(measure));
    let distance = found.scene.distance;
    row(label("speed at the demand", Measure::RoadSpeed), &|run| {
        Some(units.plain(Measure::RoadSpeed, run.course.speed))
    });
    row(label("reaction time", Measure::Time), &|run| {
        Some(units.plain(Measure::Time, run.course.response?.reaction()))
    });
    row(label("deceleration", Measure::Acceleration), &|run| {
        Some(units.plain(Measure::Acceleration, run.course.response?.deceleration()))
    });
    row(label("distance during reaction", Measure::Way), &|run| {
        Some(units.plain(Measure::Way, run.course.position(run.course.response?.reaction())))
    });
    // How it would have gone on is not known of a vehicle that was driven to the place of the impact.
    let is_driven = matches!(found.scene.actual, ActualRun::Driven(_));
    row(label("stopping distance", Measure::Way), &|run| {
        let stop =
            run.course.stop().filter(|_| run.stops_before() || !is_driven || run.course.response.is_some());
        Some(units.plain(Measure::Way, stop?))
    });
    if let Some(other) = found.on_line() {
        let gap = format!("least gap to vehicle {other}");
        row(label(&gap, Measure::Way), &|run| Some(units.plain(Measure::Way, run.gap?)));
    } else {
        row(label("stops before the place", Measure::Way), &|run| {
            run.stops_before()
                .then(|| units.plain(Measure::Way, distance - run.course.stop().unwrap_or(distance)))
        });
    }
    let place = place(found);
    row(label(&format!("speed at the {place}"), Measure::RoadSpeed), &|run| speed_there(found, run, units));
    row(label(&format!("time to the {place}"), Measure::Time), &|run| {
        Some(units.plain(Measure::Time, run.arrival?))
    });
    for (index, _) in case.vehicles.iter().enumerate().filter(|(_, vehicle)| !vehicle.fixed) {
        row(label(&format!("ΔV of vehicle {}", index + 1), Measure::RoadSpeed), &|run| {
            Some(units.plain(Measure::RoadSpeed, run.delta_v?[index]))
        });
    }
    row("avoided".to_owned(), &|run| {
        Some(if run.hypothesis == Hypothesis::Actual { NONE } else { avoided(run) }.to_owned())
    });
    table
}

/// Where a collision is: at the place of the impact, or wherever a moving vehicle then is.
fn place(found: &Avoidance) -> &'static str {
    if found.on_line().is_some() { "contact" } else { "place" }
}

/// The speed of a run there; `None` if it does not reach a vehicle that moves.
fn speed_there(found: &Avoidance, run: &AvoidRun, units: Units) -> Option<String> {
    let is_reached = found.on_line().is_none() || !run.stops_before();
    is_reached.then(|| units.plain(Measure::RoadSpeed, run.collision_speed))
}

/// How a run avoids the collision.
fn avoided(run: &AvoidRun) -> &'static str {
    match (run.stops_before(), run.is_late_enough) {
        (true, _) => "in space",
        (false, Some(true)) => "in time",
        (false, _) => "no",
    }
}

/// Every combination of the limit, the reaction in time and full braking, in the order of how many it takes.
fn combinations(found: &Avoidance, units: Units) -> Table {
    let mut table = Table::new("Each alone and together").columns([
        Column::words("", 44),
        Column::numbers(format!("speed at the {}", place(found)), 20).unit(units.name(Measure::RoadSpeed)),
        Column::words("avoided", 18),
    ]);
    for (hypothesis, label) in [
        (Hypothesis::LimitOnly, "the limit"),
        (Hypothesis::ReactionInTime, "reaction in time"),
        (Hypothesis::FullBraking, "full braking"),
        (Hypothesis::LimitAndReaction, "the limit and reaction in time"),
        (Hypothesis::LimitAndBraking, "the limit and full braking"),
        (Hypothesis::ReactionAndBraking, "reaction in time and full braking"),
        (Hypothesis::All, "all three"),
    ] {
        if let Some(run) = found.run(hypothesis) {
            let speed = speed_there(found, run, units).unwrap_or_else(|| NONE.to_owned());
            table.row([label.to_owned(), speed, avoided(run).to_owned()]);
        }
    }
    table
}

/// How the actual run is known, and whose reaction was late.
fn on_the_runs(case: &Case, found: &Avoidance, units: Units) -> String {
    let scene = &found.scene;
    let AvoidScene { response, actual, speed, .. } = scene;
    let time = |seconds: f64| units.format(Measure::Time, seconds.abs());
    match actual {
        ActualRun::Responded => {
            let recorder = case.vehicles[found.vehicle.index()].recorder.as_ref();
            let unknown = if recorder.is_some_and(|recorder| recorder.before_impact().is_some()) {
                "The speed in [avoid] replaces the recorder's table, so nothing shows how the vehicle \
                 approached; without `speed` in [avoid], the table does."
            } else {
                "Nothing in the case says how the vehicle moved before the impact."
            };
            format!(
                "{unknown} The program assumes that its driver reacted and braked as the inputs say, in time \
                 and fully. If that is wrong, set `unbraked = true`, or give the speed at the impact, skid \
                 marks, phases or a recorder's table."
            )
        }
        ActualRun::Unbraked(why) => {
            let why = match why {
                Unbraked::Stated => "The case says that the vehicle did not brake before the impact.".to_owned(),
                Unbraked::NothingKnown => {
                    "The case gives the speed at the impact, and no braking before it: the vehicle is taken to \
                     have held that speed from the demand on."
                        .to_owned()
                }
                Unbraked::WouldHaveStopped if scene.same_line.is_some() => format!(
                    "With the reaction and braking of the inputs, the vehicle would not have caught up with \
                     vehicle {} at the place of the impact. So its driver reacted later, or not at all; the \
                     vehicle is taken to have approached unbraked.",
                    found.vehicle.other()
                ),
                Unbraked::WouldHaveStopped => format!(
                    "With the reaction and braking of the inputs, the vehicle would have stopped after {}, \
                     before the place of the impact. So its driver reacted later, or not at all; the vehicle \
                     is taken to have approached unbraked.",
                    units.format(Measure::Way, response.stopping_distance(*speed))
                ),
            };
            let late = found.enough.reaction.map(|longest| {
                let by = longest - response.reaction();
                let compared = if by >= 0.0 { "longer" } else { "shorter" };
                format!(
                    " At the speed driven, a reaction of up to {} would have avoided the collision, {} {compared} than that of the inputs.",
                    time(longest),
                    time(by)
                )
            });
            why + &late.unwrap_or_default()
        }
        ActualRun::Skidded(slowed) => {
            format!(
                "The skid shows when the brakes took effect: {} after the demand, {}. The deceleration in the \
                 skid, {}, follows from its friction.",
                time(slowed.reaction()),
                against_inputs(slowed.reaction() - response.reaction(), units),
                units.format(Measure::Acceleration, slowed.deceleration()),
            )
        }
        ActualRun::Driven(by) => {
            let by = match by {
                DrivenBy::Phases => "The phases in the case show how the vehicle approached.".to_owned(),
                DrivenBy::Recorder => format!(
                    "The recorder's table shows how the vehicle approached. Its speeds are corrected for wheel \
                     slip: the usual slip, adjusted by what the speed at the impact shows of it. They change \
                     evenly from sample to sample, and the speed at the impact replaces the samples of the last {}.",
                    time(GIVES_WAY)
                ),
            };
            let braked = match scene.delay() {
                None if let Some(rate) = scene.braked_at_demand() => format!(
                    " It already brakes at the reaction demand, with {}.",
                    units.format(Measure::Acceleration, rate)
                ),
                Some(late) => format!(
                    " From {} after the demand on, {}, it slows by more than {}.",
                    time(late + response.reaction()),
                    against_inputs(late, units),
                    units.format(Measure::Acceleration, BRAKES)
                ),
                None => format!(
                    " Between the demand and the impact it does not begin to slow by more than {}.",
                    units.format(Measure::Acceleration, BRAKES)
                ),
            };
            let goes_on = if scene.accelerates() {
                " In a run with a reaction, it keeps accelerating as it did until the brakes take effect."
            } else {
                ""
            };
            by + &braked + goes_on
        }
    }
}

/// What a vehicle on the same line is taken to do.
fn on_the_other(found: &Avoidance, line: &SameLine, units: Units) -> String {
    let other = found.vehicle.other();
    let way = match line.along {
        Along::Ahead => "moved ahead in the same direction".to_owned(),
        Along::Oncoming => format!("approached vehicle {} on the same line", found.vehicle),
    };
    let goes_on = if line.speed <= 0.0 {
        "it is at rest".to_owned()
    } else if line.deceleration > 0.0 {
        format!(
            "it keeps braking at {} until it stops",
            units.format(Measure::Acceleration, line.deceleration)
        )
    } else {
        "it keeps that speed".to_owned()
    };
    format!(
        "Vehicle {other} {way}. At the demand it was {} away, and its speed at the impact was {}. Every other \
         run assumes the same motion up to that moment; from then on, {goes_on}. They collide where vehicle {} \
         reaches it, wherever that is.",
        units.format(Measure::Way, line.gap),
        units.road_speed(line.speed),
        found.vehicle,
    )
}

fn just_avoiding(found: &Avoidance, units: Units) -> Table {
    let above = found.scene.is_above_limit();
    let mut table = Table::new("Speeds that just avoid it").columns([
        Column::words("", 44),
        Column::numbers("speed", 14).unit(units.name(Measure::RoadSpeed)),
        Column::numbers("95 % interval", 20).unit(units.name(Measure::RoadSpeed)),
        Column::words(if above { "at the limit" } else { "as driven" }, 18),
    ]);
    let chance = found.chance.as_ref();
    let scene = &found.scene;
    let mut row = |label: &str, speed: f64, interval: Option<&AvoidInterval>, is: &str| {
        // If even a stationary vehicle is reached, no speed avoids it.
        let is_none = found.on_line().is_some() && label.starts_with("in ") && speed <= 0.0;
        table.row([
            label.to_owned(),
            if is_none { NONE.to_owned() } else { units.plain(Measure::RoadSpeed, speed) },
            ends(interval, Measure::RoadSpeed, units),
            is.to_owned(),
        ]);
    };
    let avoidable = |is: bool| if is { "avoidable" } else { "not avoidable" };
    let spatial = scene.spatial();
    let in_space = found.on_line().map_or("in space: it stops before the place".to_owned(), |other| {
        format!("in space: it does not reach vehicle {other}")
    });
    row(&in_space, spatial, chance.map(|chance| &chance.spatial), avoidable(scene.stops_at_limit()));
    if let Some(temporal) = scene.temporal() {
        let interval = chance.and_then(|chance| chance.temporal.as_ref());
        row(
            "in time: it arrives when the zone is clear",
            temporal,
            interval,
            avoidable(scene.is_late_at_limit() == Some(true)),
        );
    }
    row("driven", scene.speed, chance.map(|chance| &chance.speed), "");
    row(
        &format!("speed at the {}, from the {}", place(found), if above { "limit" } else { "speed driven" }),
        scene.left_at_limit(),
        chance.map(|chance| &chance.left_at_limit),
        "",
    );
    if scene.temporal().is_none() {
        table.note(
            "The report does not ask whether it was avoidable in time, because the case has no `clear`. That question presupposes that the \
             other party certainly moved and would not have stopped.",
        );
    }
    table
}

/// (m/s²) no road tyre slows a vehicle by more: 1.5 g.
const MOST_OF_TYRES: f64 = 1.5 * STANDARD_GRAVITY;

fn enough(found: &Avoidance, units: Units) -> Block {
    let enough = &found.enough;
    let is_in_time = found.scene.clears.is_some();
    let none = if is_in_time || found.on_line().is_some() {
        "none is enough"
    } else {
        "none is enough to stop before the place"
    };
    let of = |measure, value: Option<f64>, word: &str| {
        value.map_or_else(|| none.to_owned(), |value| format!("{word} {}", units.format(measure, value)))
    };
    let braking = |[deceleration, reaction]: [Option<f64>; 2], is_at_limit: bool| {
        if found.scene.is_avoided_unbraked(is_at_limit) {
            let unbraked = match found.on_line().filter(|_| !is_in_time) {
                Some(other) => format!("any: without braking, it does not reach vehicle {other}"),
                None => "any: without braking, the vehicle arrives late enough".to_owned(),
            };
            return [unbraked.clone(), unbraked];
        }
        if deceleration == Some(0.0) {
            let stays = "any: the vehicle stands until the driver reacts, and then stays there".to_owned();
            return [stays, of(Measure::Time, reaction, "at most")];
        }
        let of_tyres = match deceleration.filter(|deceleration| *deceleration > MOST_OF_TYRES) {
            Some(needed) => {
                format!("more than tyres can do: {}", units.format(Measure::Acceleration, needed))
            }
            None => of(Measure::Acceleration, deceleration, "at least"),
        };
        [of_tyres, of(Measure::Time, reaction, "at most")]
    };
    let [deceleration, reaction] = braking([enough.deceleration, enough.reaction], false);
    // A vehicle that was not faster than the limit is judged at the speed driven alone.
    let at_limit = found.scene.is_above_limit().then(|| {
        let [deceleration, reaction] =
            braking([enough.deceleration_at_limit, enough.reaction_at_limit], true);
        [("Deceleration, at the limit", deceleration), ("Reaction time, at the limit", reaction)]
    });
    Block::Facts {
        title: if is_in_time {
            "What would have been enough, in space or in time"
        } else {
            "What would have been enough, in space"
        },
        facts: vec![
            ("Speed", of(Measure::RoadSpeed, Some(enough.speed).filter(|speed| *speed > 0.0), "at most")),
            ("Deceleration, at the speed driven", deceleration),
            ("Reaction time, at the speed driven", reaction),
        ]
        .into_iter()
        .chain(at_limit.into_iter().flatten())
        .chain(
            found.on_line().is_none().then(|| {
                ("The other party not entering", "no collision, whatever the vehicle does".to_owned())
            }),
        )
        .collect(),
    }
}

fn probability(found: &Avoidance, chance: &AvoidChance, units: Units) -> Table {
    let mut table = Table::new("Probability").columns([
        Column::words("", 60),
        Column::numbers("", 12),
        Column::words("", Width::Share),
    ]);
    let mut row = |label: &str, value: f64, error: String| {
        table.row([label.to_owned(), in_decimals(value), error]);
    };
    let error = error_between(chance.avoided_at_limit, chance.mc_error);
    let error = error.map_or_else(String::new, |error| format!("± {}", number(error, 4)));
    let signed = if error.is_empty() { "" } else { " ± is the sampling error." };
    row("avoided at the limit, reaction and braking of the inputs", chance.avoided_at_limit, error);
    let stopped = if found.on_line().is_some() {
        "… because it does not reach the other vehicle"
    } else {
        "… because it stops before the place of the impact"
    };
    row(stopped, chance.stopped_at_limit, String::new());
    row("avoided at the limit, all else as it was", chance.avoided_else_as_it_was, String::new());
    row("driven faster than the limit", chance.above_limit, String::new());
    table.note(format!(
        "The share without a collision, of {} samples of all that is uncertain, once the speed is lowered to \
         the limit. With all else kept, it is the probability of Davis 2003.{signed} The demand was {} and {} before the \
         impact (95 %).",
        grouped(chance.possible),
        from_to(chance.distance, |si| units.format(Measure::Way, si)),
        from_to(chance.time, |si| units.format(Measure::Time, si)),
    ));
    // Samples and central values may take the vehicle as braked and as unbraked.
    let as_well = match chance.late {
        0 => false,
        late => late < chance.possible || !found.scene.reacted_late(),
    };
    if as_well {
        table.note(format!(
            "What happened is not the same in all samples: in {} of them ({} %), the vehicle would have stopped with the \
             reaction and braking of the inputs, and is taken as unbraked; in the others it reacted and braked as \
             the inputs say.",
            grouped(chance.late),
            number(100.0 * chance.late as f64 / chance.possible as f64, 1)
        ));
    }
    if chance.stationary > 0 {
        table.note(format!(
            "In {} more samples ({} %), vehicle {} did not move forward at the impact. They do not count: the probabilities hold if it moved.",
            grouped(chance.stationary),
            number(100.0 * chance.stationary as f64 / chance.samples as f64, 1),
            found.vehicle
        ));
    }
    let impossible = chance.samples - chance.possible - chance.stationary;
    if impossible > 0 {
        table.note(format!(
            "{} more samples do not count, because they describe no possible scene: for example, the brakes \
             took effect before the demand, or the vehicle did not catch up with the other.",
            grouped(impossible)
        ));
    }
    table
}

fn influences(chance: &AvoidChance) -> Table {
    let mut table =
        Table::new("What moves it most").columns([Column::words("", 56), Column::numbers("difference", 12)]);
    for influence in &chance.influences {
        let name =
            influence.input.as_ref().map_or_else(|| "the speed, by the evidence".to_owned(), input_name);
        table.row([name, number(influence.difference, 3)]);
    }
    table.note(
        "The probability that it is avoided at the limit, among the samples with the number above its median, \
         minus that among the others.",
    );
    table
}

fn definitions(case: &Case, found: &Avoidance, units: Units) -> Vec<String> {
    let form = match found.scene.response.form() {
        Swell::Linear => {
            "the deceleration grows evenly from zero over the swell: S = v (t_R + t_S/2) + v²/2a − a t_S²/24"
        }
        Swell::Half => {
            "half the full deceleration acts during the swell: S = v (t_R + t_S/2) + v²/2a − a t_S²/8"
        }
        Swell::FullSpeed => "the vehicle keeps its full speed during the swell: S = v (t_R + t_S) + v²/2a",
    };
    let mut list = vec![
        format!("Convention of the swell: {form}. Others give other speeds."),
        if found.on_line().is_some() {
            "Avoidable in space: at that speed and with a timely reaction, the vehicle does not reach the other one, wherever that then is."
        } else {
            "Avoidable in space: at that speed and with a timely reaction, the vehicle stops before the place of the impact."
        }
        .to_owned(),
        format!(
            "Avoidable in time: it arrives so much later that {} has left the danger zone. This ranks second \
             to avoidable in space, and holds only if the other certainly moved and could not stop.",
            party(case)
        ),
        "Distances count from the reaction demand, not from the reaction; the demand is the place where the danger could first be recognized."
            .to_owned(),
    ];
    if found.scene.temporal().is_some()
        && case.avoid.as_ref().is_some_and(|avoid| avoid.other_party == Some(OtherParty::Pedestrian))
    {
        list.push(
            "A pedestrian may freeze, run or turn back: avoidability in time is doubtful for pedestrians."
                .to_owned(),
        );
    }
    if found.runs.iter().any(|run| run.delta_v.is_some()) {
        let meets = if found.on_line().is_some() {
            "The speed of the other is that at the new contact."
        } else {
            "That the other party reaches the place at another time is ignored."
        };
        list.push(format!(
            "ΔV is that of the impact solved again at the lower speed, with all else as it was; if `deltav \
             estimate` gives the speed, each ΔV is scaled from its ΔV of what happened. {meets}"
        ));
    }
    if let Some(off) = case.off_the_line().filter(|_| found.on_line().is_some()) {
        list.push(format!(
            "Both vehicles are taken to move along one line. Their headings are {} off it; up to {} counts as \
             one line, and ranges of the headings do not change that.",
            units.format(Measure::Angle, off.angle),
            units.format(Measure::Angle, COLLINEAR)
        ));
    }
    let other = &case.vehicles[found.vehicle.other().index()];
    if case.approach_angle().is_none() && !other.fixed && !other.is_absent() {
        list.push(
            "The answer takes the place of the impact as fixed, which is right if their paths cross. If both \
             travelled along one line, the place moves with the other vehicle: give `heading` for both."
                .to_owned(),
        );
    }
    list.push(NO_GUILT.to_owned());
    list
}
