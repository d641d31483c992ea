//! Drawings.

use analysis::Analysis;
use case::{Case, Quantity};
use report::{DrawingError, DrawingRequest, PlanBody, PlanView, SitePlan, Subject, Viewport};
use serde_json::{Value, json};

use crate::given::{Given, Refused, made};

pub(crate) fn draw(text: &str, what: &str, units: &str) -> Value {
    made(Given::read(text, None, units).and_then(|given| {
        let plain = what.starts_with("plain-");
        let subject = subject(what.strip_prefix("plain-").unwrap_or(what))?;
        match subject.obstacle(&given.file.case) {
            None => {}
            Some(DrawingError::Analysis(failure)) => return given.answered(Err(failure)),
            Some(obstacle) => return Err(Refused::message(obstacle.to_string())),
        }
        let analysis = given.answered(subject.analysis(&given.file.case))?;
        let drawing = DrawingRequest { subject, plain };
        let drawing = drawing.draw(&given.file, &analysis, None, given.units, None);
        let drawing = drawing.map_err(|error| Refused::message(error.to_string()))?;
        Ok(json!({
            "ok": true,
            "svg": if plain { drawing.svg_named(what) } else { drawing.svg() },
            "title": drawing.title(),
            "description": drawing.description(),
        }))
    }))
}

/// The picture that the case names, if its bytes are given.
pub(crate) fn site_plan(case: &Case, plan: Option<Vec<u8>>) -> Result<Option<SitePlan>, Refused> {
    let Some(picture) = plan else { return Ok(None) };
    report::site_plan_of(case, picture).map_err(|error| Refused::message(format!("the site plan: {error}")))
}

fn subject(what: &str) -> Result<Subject, Refused> {
    let subject = Subject::ALL.into_iter().find(|subject| subject.name() == what);
    subject.ok_or_else(|| Refused::message(format!("there is no drawing \"{}\"", case::shown(what))))
}

/// (m) from the contact point to the handle that turns the crush plane.
const ON_PLANE: f64 = 1.5;

pub(crate) fn scene(text: &str, what: &str, units: &str, viewport: &str) -> Value {
    made(Given::read(text, None, units).and_then(|given| {
        let subject = if what.is_empty() { usual(&given) } else { subject(what)? };
        let analysis = given.answered(subject.analysis(&given.file.case))?;
        view(&given, &analysis, subject, read_viewport(viewport)?)
    }))
}

/// The plan view that a case has.
fn usual(given: &Given) -> Subject {
    if given.file.case.impact.is_some() { Subject::Scene } else { Subject::Motion }
}

/// The scene or motion that is requested or, if the case has none, the other one; `null` if it has neither,
/// or if `none` is requested. `furthest` is the furthest analysis of the case, if that is known.
pub(crate) fn first_view(given: &Given, what: &str, viewport: &str, furthest: Option<&Analysis>) -> Value {
    if what == "none" {
        return Value::Null;
    }
    let asked = subject(what).ok();
    let one = |subject: Subject| {
        let viewport = read_viewport(viewport).ok()?;
        let is_drawn = |analysis: &&Analysis| match subject {
            Subject::Scene => analysis.impact.is_some(),
            _ => analysis.travel.iter().any(Option::is_some),
        };
        match furthest.filter(is_drawn) {
            Some(analysis) => view(given, analysis, subject, viewport).ok(),
            None => view(given, &subject.analysis(&given.file.case).ok()?, subject, viewport).ok(),
        }
    };
    asked.into_iter().chain([usual(given)]).find_map(one).unwrap_or_default()
}

fn view(
    given: &Given,
    analysis: &Analysis,
    subject: Subject,
    viewport: Option<Viewport>,
) -> Result<Value, Refused> {
    let view = report::plan_view(&given.file, analysis, given.units, subject, viewport);
    let (drawing, view) = view.map_err(|error| Refused::message(error.to_string()))?;
    let Viewport { left, bottom, right, top } = view.viewport;
    let is_scene = subject == Subject::Scene;
    let case = &given.file.case;
    // The scene at the impact has the contact point in its own place, the motion that of the survey.
    let survey = view.contact.map_or([0.0; 2], |contact| {
        let surveyed = report::place_of_impact(case);
        [0, 1].map(|axis| surveyed[axis] - contact[axis])
    });
    Ok(json!({
        "ok": true,
        "what": subject.name(),
        "svg": drawing.svg(),
        "title": drawing.title(),
        "description": drawing.description(),
        "viewport": { "left": left, "bottom": bottom, "right": right, "top": top },
        "origin": view.origin,
        "scale": view.scale,
        "contact": view.contact,
        "bodies": view.bodies.iter().enumerate().map(|(i, body)| body.as_ref().map(|body| json!({
            "vehicle": i + 1,
            "outline": body.outline,
            "centre": body.cg,
            "heading": angle(body.forward),
        }))).collect::<Vec<_>>(),
        "handles": handles(case, &view, is_scene),
        "survey": survey,
        "plan": plan(case),
    }))
}

/// The site plan that the case names, in the axes of the pictures and the places of the survey.
fn plan(case: &Case) -> Value {
    case.site_plan.as_ref().map_or(Value::Null, |plan| {
        json!({
            "file": plan.file.as_given(),
            "corner": [plan.corner.x.si(), case.axes.lateral(plan.corner.y.si())],
            "width": plan.width.si(),
            "angle": case.axes.lateral(plan.angle.as_ref().map_or(0.0, Quantity::si)),
        })
    })
}

fn read_viewport(viewport: &str) -> Result<Option<Viewport>, Refused> {
    if viewport.is_empty() {
        return Ok(None);
    }
    let read: Option<Value> = serde_json::from_str(viewport).ok();
    let side = |name: &str| read.as_ref()?.get(name)?.as_f64();
    let viewport = || {
        let [left, bottom] = [side("left")?, side("bottom")?];
        Some(Viewport { left, bottom, right: side("right")?, top: side("top")? })
    };
    let wrong = || Refused::message("a viewport is empty, or { left, bottom, right, top } in metres");
    viewport().map(Some).ok_or_else(wrong)
}

/// (rad)
fn angle([x, y]: [f64; 2]) -> f64 {
    real::Real::atan2(y, x)
}

/// The handles that can be moved, and the keys that they change.
fn handles(case: &Case, view: &PlanView, is_scene: bool) -> Vec<Value> {
    let mut handles = Vec::new();
    let contact = view.contact.unwrap_or_default();
    if is_scene
        && let Some([x, y]) = view.normal
        && case.impact.is_some()
    {
        let at = [contact[0] - y * ON_PLANE, contact[1] + x * ON_PLANE];
        handles.push(json!({
            "kind": "plane", "vehicle": null, "at": at, "centre": contact, "keys": ["impact.crush_plane"],
        }));
    }
    for (i, body) in view.bodies.iter().enumerate() {
        let Some(body) = body else { continue };
        let given = &case.vehicles[i];
        let vehicle = i + 1;
        let mut add = |kind: &str, index: Option<usize>, at: [f64; 2], centre: [f64; 2], keys: &[&str]| {
            let keys: Vec<String> = keys.iter().map(|key| format!("vehicle{vehicle}.{key}")).collect();
            handles.push(json!({
                "kind": kind, "vehicle": vehicle, "index": index, "at": at, "centre": centre, "keys": keys,
            }));
        };
        if given.heading.is_some() {
            let reach = body.cg_to_front.unwrap_or(ON_PLANE);
            let nose = [0, 1].map(|axis| body.cg[axis] + body.forward[axis] * reach);
            // The bodies touch at the contact point, and turn around that.
            add("heading", None, nose, contact, &["heading"]);
        }
        if is_scene {
            if given.contact.is_some() {
                add("body", None, body.cg, body.cg, &["contact"]);
                add("contact", None, contact, body.cg, &["contact"]);
            }
            for (index, station) in body.stations.iter().enumerate() {
                add("station", Some(index), station.crushed, station.face, &["crush.depths"]);
            }
        } else {
            if let Some((at, forward)) = body.rest {
                let reach = body.cg_to_front.unwrap_or(ON_PLANE);
                let nose = [0, 1].map(|axis| at[axis] + forward[axis] * reach);
                add("rest", None, at, at, &["after.rest.x", "after.rest.y"]);
                add("rest_heading", None, nose, at, &["after.rest"]);
            }
            for (index, &at) in body.points.iter().enumerate() {
                add("point", Some(index), at, at, &["after.points"]);
            }
        }
    }
    handles
}

/// Frames of a motion unless the times are given, and (s) how long before the impact they begin.
const FRAMES: u32 = 60;
const APPROACH: f64 = 1.0;

pub(crate) fn motion(text: &str, units: &str, times: &str) -> Value {
    made(Given::read(text, None, units).and_then(|given| {
        let times: Vec<f64> = match times {
            "" => Vec::new(),
            times => serde_json::from_str(times)
                .map_err(|_| Refused::message("times are empty, or a list of seconds since the impact"))?,
        };
        let analysis = given.answered(Subject::Motion.analysis(&given.file.case))?;
        let equal = |duration: f64| {
            let step = (duration + APPROACH) / f64::from(FRAMES);
            (0..=FRAMES).map(|n| f64::from(n) * step - APPROACH).collect()
        };
        let frames = report::frames(&given.file, &analysis, given.units, |duration| {
            if times.is_empty() { equal(duration) } else { times }
        });
        let frames = frames.map_err(|error| Refused::message(error.to_string()))?;
        let body = |body: &PlanBody| {
            json!({ "outline": body.outline, "centre": body.cg, "heading": angle(body.forward) })
        };
        let frame = |(time, bodies): &(f64, [Option<PlanBody>; 2])| {
            json!({ "time": time, "bodies": bodies.each_ref().map(|one| one.as_ref().map(body)) })
        };
        Ok(json!({
            "ok": true,
            "duration": frames.duration,
            "frames": frames.frames.iter().map(frame).collect::<Vec<_>>(),
        }))
    }))
}
