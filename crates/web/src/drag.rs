//! Moves of a user in the scene, as numbers of the text.

use std::f64::consts::PI;

use case::edit::{self, EditError};
use case::{CaseFile, ContactPoint, Dimension, Quantity, RestHeading, UnitSystem, read_quantity, read_unit};
use real::{Real, principal_angle};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::given::{Given, Refused, made};

/// (m) and (rad) accuracy of a mouse, and (m) that for a station of the crush.
const PLACE: f64 = 0.01;
const ANGLE: f64 = PI / 1800.0;
const DEPTH: f64 = 0.005;

pub(crate) fn drag(text: &str, handle: &str, to: &str) -> Value {
    made(Given::read(text, None, "").and_then(|given| {
        let handle =
            Handle::read(handle).ok_or_else(|| Refused::message("this is not a handle of the scene"))?;
        let to = To::read(to)
            .ok_or_else(|| Refused::message("a handle is moved to { at: [x, y] } or { angle }"))?;
        let mut change = Change::of(given.file);
        change.make(&handle, &to)?;
        Ok(json!({ "ok": true, "text": change.file.source.text(), "changed": change.changed }))
    }))
}

/// Where a site plan is to lie, in the axes of the scene's pictures.
#[derive(Deserialize)]
struct Plan {
    file: String,
    /// (m) its lower left corner.
    corner: [f64; 2],
    /// (m) its lower edge.
    width: f64,
    /// (rad) from the x axis to its lower edge.
    angle: f64,
}

pub(crate) fn keep_plan(text: &str, plan: &str) -> Value {
    made(Given::read(text, None, "").and_then(|given| {
        let plan: Plan = serde_json::from_str(plan)
            .map_err(|_| Refused::message("a site plan is kept as { file, corner: [x, y], width, angle }"))?;
        let mut change = Change::of(given.file);
        change.keep(&plan)?;
        Ok(json!({ "ok": true, "text": change.file.source.text(), "changed": change.changed }))
    }))
}

#[derive(Deserialize)]
struct Handle {
    kind: String,
    vehicle: Option<usize>,
    index: Option<usize>,
    at: [f64; 2],
    centre: Option<[f64; 2]>,
}

impl Handle {
    fn read(text: &str) -> Option<Self> {
        let handle: Self = serde_json::from_str(text).ok()?;
        (1..=2).contains(&handle.vehicle()).then_some(handle)
    }

    fn vehicle(&self) -> usize {
        self.vehicle.unwrap_or(1)
    }

    fn index(&self) -> usize {
        self.index.unwrap_or(0)
    }

    fn centre(&self) -> [f64; 2] {
        self.centre.unwrap_or(self.at)
    }

    fn key(&self, key: &str) -> String {
        format!("vehicle{}.{key}", self.vehicle())
    }
}

#[derive(Deserialize)]
struct To {
    at: Option<[f64; 2]>,
    angle: Option<f64>,
}

impl To {
    fn read(text: &str) -> Option<Self> {
        let to: Self = serde_json::from_str(text).ok()?;
        (to.at.is_some() || to.angle.is_some()).then_some(to)
    }

    /// (rad) how far a handle turns around its centre, the shorter way.
    fn turn(&self, handle: &Handle) -> f64 {
        let from = angle(handle.centre(), handle.at);
        let to = self.angle.unwrap_or_else(|| angle(handle.centre(), self.at.unwrap_or(handle.at)));
        principal_angle(to - from)
    }

    /// (m)
    fn place(&self, handle: &Handle) -> [f64; 2] {
        self.at.unwrap_or(handle.at)
    }
}

/// (rad)
fn angle(from: [f64; 2], to: [f64; 2]) -> f64 {
    Real::atan2(to[1] - from[1], to[0] - from[0])
}

/// A text that changes key by key.
pub(crate) struct Change {
    pub(crate) file: CaseFile,
    changed: Vec<String>,
}

impl Change {
    pub(crate) fn of(file: CaseFile) -> Self {
        Self { file, changed: Vec::new() }
    }

    fn make(&mut self, handle: &Handle, to: &To) -> Result<(), Refused> {
        let case = &self.file.case;
        let axes = case.axes;
        let vehicle = &case.vehicles[handle.vehicle() - 1];
        let [x, y] = to.place(handle);
        match handle.kind.as_str() {
            "heading" => {
                let old = vehicle.heading.as_ref().map_or(0.0, Quantity::si);
                let turned = old + axes.lateral(to.turn(handle));
                let new = principal_angle(to.angle.map_or(turned, |angle| axes.lateral(angle)));
                self.put(&handle.key("heading"), new, Dimension::Angle, ANGLE)
            }
            "plane" => {
                let old = case.impact.as_ref().map_or(0.0, |impact| impact.crush_plane.si());
                let new = principal_angle(old + axes.lateral(to.turn(handle)));
                self.put("impact.crush_plane", new, Dimension::Angle, ANGLE)
            }
            // The contact point stays where it is, and the vehicle moves.
            "body" => self.contact(handle, [-x, -y]),
            "contact" => self.contact(handle, [x - handle.centre()[0], y - handle.centre()[1]]),
            "station" => self.depth(handle, to),
            "rest" => self.put_place(&handle.key("after.rest"), [x, axes.lateral(y)]),
            "rest_heading" => {
                let rest = vehicle.after.as_ref().and_then(|after| after.rest);
                let turn = axes.lateral(to.turn(handle));
                match rest.map(|rest| rest.heading) {
                    Some(RestHeading::Turned(turned)) => self.put(
                        &handle.key("after.rest.turned"),
                        turned.si() + turn,
                        Dimension::Angle,
                        ANGLE,
                    ),
                    Some(RestHeading::Heading(old)) => {
                        let new = principal_angle(old.si() + turn);
                        self.put(&handle.key("after.rest.heading"), new, Dimension::Angle, ANGLE)
                    }
                    None => Err(Refused::message("the case has no rest of this vehicle")),
                }
            }
            "point" => {
                let point = handle.key(&format!("after.points[{}]", handle.index() + 1));
                self.put_place(&point, [x, axes.lateral(y)])
            }
            kind => Err(Refused::message(format!("\"{}\" moves nothing in the case", case::shown(kind)))),
        }
    }

    /// Names a site plan, or moves the one that the case names.
    fn keep(&mut self, plan: &Plan) -> Result<(), Refused> {
        let case = &self.file.case;
        let axes = case.axes;
        let [x, y] = [plan.corner[0], axes.lateral(plan.corner[1])];
        let angle = principal_angle(axes.lateral(plan.angle));
        let file = json!(plan.file).to_string();
        if case.site_plan.is_none() {
            let [x, y, width] = [x, y, plan.width].map(|si| self.usual(si, Dimension::Length, PLACE));
            let angle = self.usual(angle, Dimension::Angle, ANGLE);
            let [x, y, width, angle] = [x?, y?, width?, angle?];
            return self.set(
                "scene.site_plan",
                &format!(
                    "{{ file = {file}, corner = {{ x = {x}, y = {y} }}, width = {width}, angle = {angle} }}"
                ),
            );
        }
        self.set("scene.site_plan.file", &file)?;
        self.put_place("scene.site_plan.corner", [x, y])?;
        self.put("scene.site_plan.width", plan.width, Dimension::Length, PLACE)?;
        self.put("scene.site_plan.angle", angle, Dimension::Angle, ANGLE)
    }

    /// `arm` (m) points from the centre of gravity to the contact point, in the scene.
    fn contact(&mut self, handle: &Handle, arm: [f64; 2]) -> Result<(), Refused> {
        let case = &self.file.case;
        let axes = case.axes;
        let vehicle = &case.vehicles[handle.vehicle() - 1];
        let heading = axes.lateral(vehicle.heading.as_ref().map_or(0.0, Quantity::si));
        let (sin, cos) = Real::sin_cos(heading);
        // In the axes of the vehicle.
        let forward = arm[0] * cos + arm[1] * sin;
        let lateral = axes.lateral(arm[1] * cos - arm[0] * sin);
        match vehicle.contact {
            Some(ContactPoint::Polar { .. }) => {
                let distance = (forward * forward + lateral * lateral).sqrt();
                self.put(&handle.key("contact.distance"), distance, Dimension::Length, PLACE)?;
                let angle = Real::atan2(lateral, forward);
                self.put(&handle.key("contact.angle"), angle, Dimension::Angle, ANGLE)
            }
            Some(ContactPoint::Cartesian { .. }) | None => {
                self.put_place(&handle.key("contact"), [forward, lateral])
            }
        }
    }

    fn depth(&mut self, handle: &Handle, to: &To) -> Result<(), Refused> {
        let case = &self.file.case;
        let none = || Refused::message("this vehicle has no measured crush");
        let crush = case.vehicles[handle.vehicle() - 1].crush.as_ref().ok_or_else(none)?;
        let old = crush.depths.get(handle.index()).ok_or_else(none)?;
        // Out of the vehicle, in the scene.
        let axes = case.axes;
        let heading = case.vehicles[handle.vehicle() - 1].heading.as_ref().map_or(0.0, Quantity::si);
        let side = match crush.side {
            crash3::Side::Front => 0.0,
            crash3::Side::Left => PI / 2.0,
            crash3::Side::Rear => PI,
            crash3::Side::Right => -PI / 2.0,
        };
        let (sin, cos) = Real::sin_cos(axes.lateral(heading) + side);
        let [x, y] = to.place(handle);
        let inwards = (handle.at[0] - x) * cos + (handle.at[1] - y) * sin;
        let depth = (old.si() + inwards).max(0.0);
        self.put_station(handle, depth)
    }

    /// A number of the list of depths, which is a text, a list, or a range of either.
    fn put_station(&mut self, handle: &Handle, depth: f64) -> Result<(), Refused> {
        let mut lists = ["crush.depths.values", "crush.depths"].map(|key| handle.key(key)).into_iter();
        let key = lists.find(|key| self.file.source.span(key).is_some());
        let written = key.as_ref().and_then(|key| self.written(key));
        if let (Some(key), Some('[')) = (&key, written.and_then(|written| written.chars().next())) {
            return self.put(&format!("{key}[{}]", handle.index() + 1), depth, Dimension::Length, DEPTH);
        }
        let changed = key.and_then(|key| {
            let text = self.text(&key)?;
            let places = numbers(&text);
            let place = places.get(handle.index())?;
            let unit = read_unit(text[places.last()?.end..].trim(), Dimension::Length)?;
            let number = rounded(depth / unit.factor(), DEPTH / unit.factor());
            let new = [&text[..place.start], &number, &text[place.end..]].concat();
            Some((key, format!("\"{new}\"")))
        });
        let (key, value) = changed.ok_or_else(|| {
            Refused::message("the depths are not written as a list of numbers with one unit")
        })?;
        self.set(&key, &value)
    }

    /// The value of a key, letter by letter.
    fn written(&self, key: &str) -> Option<&str> {
        self.file.source.text().get(self.file.source.span(key)?)
    }

    /// Gives the keys `x` and `y` of a table other values (m), in the axes of the case.
    fn put_place(&mut self, key: &str, [x, y]: [f64; 2]) -> Result<(), Refused> {
        self.put(&format!("{key}.x"), x, Dimension::Length, PLACE)?;
        self.put(&format!("{key}.y"), y, Dimension::Length, PLACE)
    }

    /// Gives a quantity another value (SI), in its unit in the file; a range moves as a whole.
    pub(crate) fn put(&mut self, key: &str, si: f64, dimension: Dimension, step: f64) -> Result<(), Refused> {
        let value = format!("{key}.value");
        if self.written(&value).is_some() {
            return self.put(&value, si, dimension, step);
        }
        let low = format!("{key}.low");
        if self.written(&low).is_some() {
            let inputs = self.file.case.inputs();
            let old = inputs.iter().find(|input| input.path == key).map_or(si, inputs::Input::si);
            let mut ends = ["low", "mode", "high"];
            // A range that moves up gets its upper end first, so that its ends are in order in every
            // intermediate text.
            if si > old {
                ends.reverse();
            }
            for end in ends {
                let key = format!("{key}.{end}");
                if let Some(quantity) = self.quantity(&key, dimension) {
                    self.put(&key, quantity.si() + si - old, dimension, step)?;
                }
            }
            return Ok(());
        }
        let Some(quantity) = self.quantity(key, dimension) else {
            let value = self.usual(si, dimension, step)?;
            return self.set(key, &value);
        };
        let unit = quantity.unit();
        let number = rounded(si / unit.factor(), step / unit.factor());
        self.set(key, &format!("\"{number} {}\"", self.spelling(key).unwrap_or_else(|| unit.to_string())))
    }

    /// A value of TOML for a quantity (SI), in its usual unit in a file of this unit system.
    fn usual(&self, si: f64, dimension: Dimension, step: f64) -> Result<String, Refused> {
        let is_us = self.file.case.unit_system() == UnitSystem::Us;
        let name = match dimension {
            Dimension::Angle => "deg",
            _ if is_us => "ft",
            _ => "m",
        };
        let unit = dimension.unit(name).or_else(|| dimension.units().first());
        let unit = unit.ok_or_else(|| Refused::message("there is no unit for this number"))?;
        Ok(format!("\"{} {unit}\"", rounded(si / unit.factor(), step / unit.factor())))
    }

    /// The text of a key, in any quotes of TOML.
    fn text(&self, key: &str) -> Option<String> {
        let alone = format!("title = {}", self.written(key)?);
        match CaseFile::part("title", &alone).ok()?.get("title")? {
            case::Value::Text(text) => Some(text.to_string()),
            _ => None,
        }
    }

    pub(crate) fn quantity(&self, key: &str, dimension: Dimension) -> Option<Quantity> {
        read_quantity(&self.text(key)?, dimension).ok()
    }

    /// The unit of a key as the file spells it.
    fn spelling(&self, key: &str) -> Option<String> {
        let text = self.text(key)?;
        let end = numbers(&text).last()?.end;
        Some(text[end..].trim().to_owned())
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), Refused> {
        let refused = |error: EditError| Refused::message(error.to_string());
        let edited = edit::set(self.file.source.text(), key, value).map_err(refused)?;
        let name = self.file.source.name().as_given().to_owned();
        self.file = CaseFile::parse(&name, &edited.text).map_err(|errors| Refused::of(&errors))?;
        self.changed.push(key.to_owned());
        Ok(())
    }
}

/// (bytes) where the numbers at the beginning of a text are.
fn numbers(text: &str) -> Vec<std::ops::Range<usize>> {
    let mut places = Vec::new();
    let mut at = 0;
    for part in text.split_inclusive(char::is_whitespace) {
        let word = part.trim_end();
        let end = word.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c))).unwrap_or(word.len());
        if word.is_empty() {
            at += part.len();
            continue;
        }
        // "3cm" has its unit right after the number.
        if end == 0 || word[..end].parse::<f64>().is_err() {
            break;
        }
        places.push(at..at + end);
        if end < word.len() {
            break;
        }
        at += part.len();
    }
    places
}

/// A number with the decimals that a step of this size needs.
fn rounded(number: f64, step: f64) -> String {
    let mut decimals = 0_usize;
    let mut size = step;
    while size < 0.999 && decimals < 9 {
        size *= 10.0;
        decimals += 1;
    }
    let text = format!("{number:.decimals$}");
    let zero = text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.');
    let text = if zero { text.trim_start_matches('-') } else { &text };
    text.to_owned()
}
