//! A finished analysis as JSON, in SI units and radians: each quantity at the pointer of its row, and
//! everything that is not a quantity.

use analysis::quantities::{
    IMPACT_CLOSING_SPEED, IMPACT_CRITICAL_IMPULSE_RATIO, IMPACT_IMPULSE_RATIO, IMPACT_NORMAL_IMPULSE,
    IMPACT_RESTITUTION, MOMENTUM_CRITICAL_IMPULSE_RATIO, MOMENTUM_ENERGY_LOSS, MOMENTUM_IMPULSE_RATIO,
    MOMENTUM_NORMAL_WORK, MOMENTUM_RESTITUTION,
};
use analysis::{
    Analysis, BothFound, BothMethod, Check, Combination, Correction, Found, OutputQuantity, QUANTITIES, Seen,
    SeenWarning, Travel, TravelOrigin, Values, Weighed,
};
use case::{Basis, Case, CaseFile, MarkedWheel};
use pim_core::VehicleId;
use serde_json::{Value, json};
use trajectory::Sample;

use super::headline::{headline, solution};
use super::{identified, list, object, pretty, title};
use crate::Units;
use crate::law;
use crate::warnings;
use crate::words;

/// A warning, in SI units.
pub(crate) fn warning(seen: &SeenWarning) -> Value {
    let warning = seen.warning();
    let vehicle = warning.vehicle().map(VehicleId::number);
    let message = warnings::message(seen, Units::Si);
    object! { "code": warning.code(), "vehicle"?: vehicle, "message": message }
}

/// The warnings of an analysis.
pub(crate) fn all_warnings(analysis: &Analysis, case: &Case) -> Vec<Value> {
    list(&analysis.seen(case.axes).warnings, warning)
}

/// Quantities that are `null` instead of absent if they have no value but the second quantity has one: the
/// vehicles do not close, the impulse does not push, or no push could end the sliding.
const NULL_BESIDE: [(&OutputQuantity, &OutputQuantity); 6] = [
    (&IMPACT_RESTITUTION, &IMPACT_CLOSING_SPEED),
    (&IMPACT_IMPULSE_RATIO, &IMPACT_NORMAL_IMPULSE),
    (&IMPACT_CRITICAL_IMPULSE_RATIO, &IMPACT_NORMAL_IMPULSE),
    (&MOMENTUM_RESTITUTION, &MOMENTUM_ENERGY_LOSS),
    (&MOMENTUM_IMPULSE_RATIO, &MOMENTUM_NORMAL_WORK),
    (&MOMENTUM_CRITICAL_IMPULSE_RATIO, &MOMENTUM_NORMAL_WORK),
];

/// The order of the keys of an impact. Here and below, keys that are not listed come last.
const IMPACT: [&str; 20] = [
    "law",
    "regime",
    "restitution",
    "impulse_ratio",
    "critical_impulse_ratio",
    "normal_impulse",
    "tangential_impulse",
    "impulse",
    "impulse_direction",
    "normal",
    "closing_speed",
    "normal_velocity",
    "tangential_velocity",
    "initial_energy",
    "final_energy",
    "energy_loss",
    "normal_work",
    "tangential_work",
    "moment_impulse",
    "moment_work",
];

/// The order of the keys of a vehicle, or of a fixed object.
const VEHICLE: [&str; 29] = [
    "name",
    "fixed",
    "speed",
    "velocity",
    "yaw_rate",
    "final_velocity",
    "final_yaw_rate",
    "final_speed",
    "delta_v",
    "delta_v_longitudinal",
    "delta_v_lateral",
    "delta_v_vector",
    "pdof",
    "stiffness_source",
    "crush_source",
    "crush_energy",
    "crush_energy_bounds",
    "inferred_crush",
    "oblique_angle",
    "oblique_factor",
    "corrected_crush_energy",
    "ees",
    "peak_force",
    "no_damage_speed",
    "skid",
    "start",
    "rest",
    "path",
    "points",
];

/// The order of the keys of CRASH3's answer.
const CRASH3: [&str; 8] = [
    "crush_energy",
    "corrected_crush_energy",
    "moment_arm",
    "effective_mass_ratio",
    "delta_v",
    "corrected_delta_v",
    "restitution_factor",
    "corrections",
];

/// The analysis as indented JSON, ending in a line break.
///
/// # Errors
/// If serialisation fails, which no analysis causes.
pub fn json(file: &CaseFile, analysis: &Analysis) -> Result<String, serde_json::Error> {
    pretty(&identified(file, document(&file.case, analysis)))
}

/// The same for a case with more evidence than its exact solution uses: its headline weighs all of it.
///
/// # Errors
/// As [`json()`].
pub fn weighed_json(
    file: &CaseFile,
    analysis: &Analysis,
    weighed: &Weighed,
) -> Result<String, serde_json::Error> {
    pretty(&identified(file, headed(&file.case, analysis, Some(weighed))))
}

/// The JSON document of an analysis.
pub(crate) fn document(case: &Case, analysis: &Analysis) -> Value {
    headed(case, analysis, None)
}

fn headed(case: &Case, analysis: &Analysis, weighed: Option<&Weighed>) -> Value {
    let seen = &analysis.seen(case.axes);
    let mut document = head(case, analysis, seen, weighed);
    for (place, value) in others(case, seen) {
        put(&mut document, &place, value);
    }
    for quantity in QUANTITIES {
        for (place, value) in numbers(quantity, seen) {
            put(&mut document, &place, value);
        }
    }
    if let Some(both) = seen.both.as_ref().filter(|both| !both.combinations.is_empty()) {
        put(&mut document, "/momentum/combinations", both.combinations.iter().map(combination).collect());
    }
    for (block, keys) in
        [("impact", &IMPACT[..]), ("vehicle1", &VEHICLE), ("vehicle2", &VEHICLE), ("crash3", &CRASH3)]
    {
        if let Some(Value::Object(block)) = document.get_mut(block) {
            let mut entries: Vec<(String, Value)> = std::mem::take(block).into_iter().collect();
            entries
                .sort_by_key(|(key, _)| keys.iter().position(|listed| listed == key).unwrap_or(keys.len()));
            block.extend(entries);
        }
    }
    document
}

/// Puts a value at its place (RFC 6901), and creates the objects and lists that contain it. Missing elements
/// of a list are `null`.
fn put(document: &mut Value, place: &str, value: Value) {
    let mut at = document;
    for token in place.split('/').skip(1) {
        let number = token.parse::<usize>();
        if at.is_null() {
            *at = if number.is_ok() { json!([]) } else { json!({}) };
        }
        at = match (at, number) {
            (Value::Array(elements), Ok(number)) => {
                elements.resize(elements.len().max(number + 1), Value::Null);
                &mut elements[number]
            }
            (Value::Object(keys), _) => keys.entry(token).or_insert(Value::Null),
            _ => return,
        };
    }
    *at = value;
}

/// The numbers of a quantity, each with its place.
fn numbers(quantity: &OutputQuantity, seen: &Seen) -> Vec<(String, Value)> {
    match quantity.values(seen) {
        Values::Shared(None) => {
            let is_null = NULL_BESIDE
                .iter()
                .any(|(one, beside)| one.key == quantity.key && beside.values(seen) != Values::Shared(None));
            if is_null { vec![(quantity.pointer.to_owned(), Value::Null)] } else { Vec::new() }
        }
        Values::Shared(Some(value)) => vec![(quantity.pointer.to_owned(), value.into())],
        Values::Pair([None, None]) => Vec::new(),
        Values::Pair(values) => {
            // A list contains both, with `null` for a fixed object.
            let is_list = quantity.pointer.ends_with('%');
            let place = |id: VehicleId| {
                quantity.pointer.replace('#', &id.to_string()).replace('%', &id.index().to_string())
            };
            let of = |id: VehicleId| Some(values[id.index()]).filter(|value| is_list || value.is_some());
            VehicleId::ALL.into_iter().filter_map(|id| Some((place(id), of(id)?.into()))).collect()
        }
    }
}

/// The keys before the blocks of quantities.
fn head(case: &Case, analysis: &Analysis, seen: &Seen, weighed: Option<&Weighed>) -> Value {
    let [of_answer, of_solution] = warnings::of_answer(seen, weighed, weighed.is_none());
    let check = |check: &Check| {
        object! {
            "code": check.code(),
            "vehicle"?: check.quantity.vehicle().map(VehicleId::number),
            "value": plain(check.value),
            "limit": check.limit,
            "passed": check.passed(),
        }
    };
    object! {
        "title": title(case),
        // The axes of all signed values: `z-up` or `z-down`.
        "axes": case.axes.name(),
        // The answer of a reconstruction, and its method.
        "headline"?: headline(analysis, weighed),
        // If all the evidence was weighed: the answers by its parts, each taken as exact.
        "solutions"?: list(weighed.into_iter().flat_map(|weighed| &weighed.solutions), solution),
        // Keys of evidence that the numbers below do not use.
        "left_aside"?: seen.left_aside,
        "energy_basis": seen.basis.name(),
        // λ, if the basis has one.
        "tangential_share"?: match seen.basis {
            Basis::TangentialShare(share) => Some(share),
            Basis::Dissipated | Basis::Absorbed => None,
        },
        "warnings": list(&of_answer, warning),
        // The warnings about the exact solution, if all the evidence was weighed.
        "solution_warnings"?: list(&of_solution, warning),
        "checks": list(&seen.checks, check),
    }
}

/// The values that are not numbers of a row, each with its place. The blocks get their order here.
fn others(case: &Case, seen: &Seen) -> Vec<(String, Value)> {
    let mut others = Vec::new();
    let mut add = |place: &str, value: Value| others.push((place.to_owned(), value));
    match (&seen.found, &seen.both) {
        (Some(found), _) => add("/found", one_found(seen, found)),
        (None, Some(both)) => add("/found", both_found(both)),
        (None, None) => {}
    }
    if seen.both.is_some() {
        add("/momentum", json!({}));
    }
    if seen.exchange().is_some() {
        add("/impact", json!({}));
    }
    if let Some(impact) = &seen.impact {
        // If momentum gave the speeds, the law is compared with them.
        let block = if seen.law_check().is_some() { "/law_check" } else { "/impact" };
        let law = case.impact.as_ref().map_or("brach", |given| given.law.name());
        add(&format!("{block}/law"), law.into());
        if let Some(regime) = impact.outcome.regime {
            add(&format!("{block}/regime"), words::regime_name(regime).into());
        }
    }
    for id in VehicleId::ALL {
        for (place, value) in of_vehicle(case, seen, id) {
            add(&format!("/vehicle{id}{place}"), value);
        }
    }
    if let Some(crash3) = &seen.crash3 {
        // CRASH3's answer under one correction for oblique forces.
        let row = |row: &Correction| {
            object! {
                "oblique": law::row_name(row),
                // The friction limit of each vehicle, for the friction-limited correction.
                "friction"?: law::friction_limits(row).map(|limits| of_movable(case, limits)),
                "factor": row.factor,
                "crush_energy": row.crush_energy,
                "delta_v": of_movable(case, row.delta_v),
            }
        };
        add("/crash3/corrections", list(&crash3.corrections, row).into());
    }
    others
}

/// The values of a vehicle that are not numbers of a row, each with its place in the block.
fn of_vehicle(case: &Case, seen: &Seen, id: VehicleId) -> impl Iterator<Item = (&'static str, Value)> {
    let (given, vehicle) = (&case.vehicles[id.index()], &seen.vehicles[id.index()]);
    let inferred = vehicle.damage.as_ref().and_then(|damage| damage.inferred);
    let travel = seen.travel[id.index()].as_ref();
    let points = travel.map(points).filter(|points| !points.is_empty());
    let others = [
        Some(("", json!({}))),
        given.name.as_ref().map(|name| ("/name", name.as_given().into())),
        given.fixed.then(|| ("/fixed", true.into())),
        vehicle.subject.damage.as_ref().map(|damage| {
            ("/stiffness_source", words::stiffness_source(damage.stiffness_source, damage.side).into())
        }),
        words::crush_source(vehicle).map(|source| ("/crush_source", source.into())),
        inferred.map(|inferred| {
            // (m) from the force on the other vehicle
            ("/inferred_crush", json!({ "depth": inferred.crush.depth, "width": inferred.crush.width }))
        }),
        travel.map(|travel| ("/start/source", start_source(travel.origin).into())),
        travel.map(|travel| ("/path", travel.samples.iter().map(moment).collect())),
        points.map(|points| ("/points", points.into())),
    ];
    others.into_iter().flatten()
}

/// The source of the start of a path.
fn start_source(origin: TravelOrigin) -> &'static str {
    match origin {
        TravelOrigin::Impact => "impact",
        TravelOrigin::Given => "given",
        TravelOrigin::Rest => "rest",
        TravelOrigin::StraightRest => "straight rest",
    }
}

/// The one speed that the crush energy gives.
fn one_found(seen: &Seen, found: &Found) -> Value {
    // W_n, or W_n + λ W_t if the basis is a share of the tangential work.
    let work = if matches!(seen.basis, Basis::TangentialShare(_)) { "crush_work" } else { "normal_work" };
    let steps = found.iterations.iter().flatten();
    json!({
        "quantity": words::unknown_name(found.unknown),
        "value": plain(found.speed),
        "admissible_roots": found.admissible.len(),
        "roots": list(&found.admissible, |root| plain(*root)),
        "method": if found.iterations.is_some() { "root finder" } else { "closed form" },
        "iterations": list(steps, |step| json!({
            "speed": plain(step.speed),
            work: plain(step.normal_work),
        })),
    })
}

/// One speed, or a list of both: as `reconstruct.find` of the case.
fn both_found(both: &BothFound) -> Value {
    let of = |unknown: VehicleId| {
        let value = plain(both.speeds[unknown.index()]);
        let (method, roots) = match &both.method {
            BothMethod::Momentum => ("momentum", vec![value]),
            BothMethod::MomentumAndSpeed { .. } => ("momentum and known speed", vec![value]),
            BothMethod::Wall { .. } => ("restitution", vec![value]),
            BothMethod::MomentumAndCrush { admissible, .. } => {
                ("momentum and crush energy", list(admissible, |speeds| plain(speeds[unknown.index()])))
            }
        };
        json!({
            "quantity": words::unknown_name(unknown),
            "value": value,
            "admissible_roots": roots.len(),
            "roots": roots,
            "method": method,
            "iterations": [],
        })
    };
    match both.sought() {
        Some(vehicle) => of(vehicle),
        None => VehicleId::ALL.map(of).to_vec().into(),
    }
}

/// A start of each vehicle that leads to its rest position, and how well the two agree with the impulse. The
/// first combination is the one that is used.
fn combination(combination: &Combination) -> Value {
    json!({
        // Along the headings.
        "speeds": plain_pair(combination.speeds),
        // After the impact; an unknown yaw rate is null.
        "velocities": combination.after.map(|departure| plain_pair(departure.velocity.into())),
        "yaw_rates": combination.after.map(|departure| departure.yaw_rate.map(plain)),
        // On the path to rest; null for a vehicle that is not followed.
        "turns": combination.turns.map(|turn| turn.map(plain)),
        // χ² of the implications of the speeds, compared with the other evidence.
        "misfit": combination.misfit,
        "weight": combination.weight,
        // Codes of the checks that it fails.
        "against": combination.against.iter().map(Check::code).collect::<Vec<_>>(),
    })
}

/// A moment of the path to rest.
fn moment(sample: &Sample) -> Value {
    let state = &sample.state;
    json!({
        "time": sample.time,
        "x": plain(state.position.x),
        "y": plain(state.position.y),
        "heading": plain(state.heading),
        "velocity": plain_pair(state.motion.velocity.into()),
        "yaw_rate": plain(state.motion.yaw_rate),
        // Front left, front right, rear left, rear right.
        "sliding": sample.sliding,
    })
}

/// How a path passes the points of the case.
fn points(travel: &Travel) -> Vec<Value> {
    list(travel.passes.iter().zip(&travel.points), |(pass, point)| {
        object! {
            "wheel"?: point.wheel.map(MarkedWheel::name),
            "miss": pass.miss,
            "turned"?: pass.turned.map(plain),
        }
    })
}

/// Values that only a vehicle that can move has: `None` for a fixed object.
pub(crate) fn of_movable(case: &Case, values: [f64; 2]) -> [Option<f64>; 2] {
    [0, 1].map(|i| (!case.vehicles[i].fixed).then_some(values[i]))
}

/// No minus before zero.
fn plain(value: f64) -> f64 {
    value + 0.0
}

fn plain_pair(values: [f64; 2]) -> [f64; 2] {
    values.map(plain)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::put;

    #[test]
    fn a_value_stands_at_its_pointer() {
        let mut document = json!({ "axes": "z-up" });
        put(&mut document, "/vehicle2/velocity/0", 3.0.into());
        put(&mut document, "/vehicle2/velocity/1", 4.0.into());
        // A value that is known only for the second vehicle.
        put(&mut document, "/crash3/moment_arm/1", 0.5.into());
        put(&mut document, "/impact/restitution", Value::Null);
        let expected = json!({
            "axes": "z-up",
            "vehicle2": { "velocity": [3.0, 4.0] },
            "crash3": { "moment_arm": [null, 0.5] },
            "impact": { "restitution": null },
        });
        assert_eq!(document.to_string(), expected.to_string());
    }
}
