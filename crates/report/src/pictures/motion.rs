//! The motion: both vehicles from their approach through the impact to rest, seen from above; and its speeds
//! over time.

use ::drawing::{
    CurveKind, Curves, CurvesPicture, GroundShape, GroundZone, MeasuredPoint, MotionPicture, MotionPoint,
    MotionRest, MotionVehicle, SceneArrow, SceneBody, SitePlan,
};
use analysis::{Analysis, Travel, TravelOrigin};
use case::{Axes, Case, PointData, RegionData, SkidBegin, SurfaceData};
use pim_core::{Real, Vector2, VehicleId};
use trajectory::State;

use super::scene::scene_body;
use super::vehicle::{Body, name_of};
use super::{DrawingError, PlainSpeed, Subject, axis, caveat, scale_unit, title, with_caveat};
use crate::Units;
use crate::units::{Measure, number};

/// (m/s) a vehicle stood if the speed found is at most this, 1 km/h.
const STANDING: f64 = 1.0 / 3.6;

/// What the pictures show, for readers who cannot see them.
const FROM_ABOVE: &str = "Both vehicles from above, from approach through impact to rest, to scale.";
const OVER_TIME: &str =
    "Speed, yaw rate and heading over the time since the impact, one chart below the other.";

/// The number of parts drawn for each step of the integration, which may be a second long.
const PARTS: u32 = 12;

/// With plain speeds, for readers who are not engineers.
pub(super) fn picture(
    case: &Case,
    analysis: &Analysis,
    units: Units,
    plain: Option<[PlainSpeed<'_>; 2]>,
    site_plan: Option<SitePlan>,
) -> Result<MotionPicture, DrawingError> {
    if analysis.travel.iter().all(Option::is_none) {
        return Err(DrawingError::NoMotion { subject: Subject::Motion });
    }
    let surface = analysis.surface.as_ref();
    let caveat = match plain.map(PlainSpeed::caveat) {
        None => caveat(analysis),
        Some(of_speeds) if analysis.why_not_exact().is_none() => of_speeds.to_owned(),
        Some(of_speeds) => format!("{of_speeds} The paths are those of an exact solution.").trim().to_owned(),
    };
    let speed = |id: VehicleId| plain.map(|speeds| speeds[id.index()]);
    Ok(MotionPicture {
        title: title(case),
        description: with_caveat(description(analysis, units, FROM_ABOVE), &caveat),
        caveat,
        is_z_down: case.axes == Axes::ZDown,
        is_plain: plain.is_some(),
        vehicles: VehicleId::ALL.map(|id| vehicle(case, analysis, id, units, speed(id))),
        impact: Some(place_of_impact(case)),
        normal: analysis.impact.as_ref().map(|impact| impact.contact.normal().into()),
        ground: surface.map_or_else(Vec::new, zones),
        uphill: surface.and_then(uphill),
        site_plan,
        length: scale_unit(units, Measure::Length),
        time: scale_unit(units, Measure::Time),
    })
}

/// (m) where the impulse acts in the drawing of the motion; the origin if the case does not give it.
pub fn place_of_impact(case: &Case) -> [f64; 2] {
    case.contact_place().map_or([0.0; 2], Into::into)
}

fn zones(surface: &SurfaceData) -> Vec<GroundZone> {
    let zone = |zone: &case::ZoneData| GroundZone {
        shape: match &zone.region {
            RegionData::HalfPlane { point, into } => {
                let (sin, cos) = Real::sin_cos(*into);
                GroundShape::HalfPlane { edge: (*point).into(), into: [cos, sin] }
            }
            RegionData::Polygon(corners) => {
                GroundShape::Polygon(corners.iter().map(|&corner| corner.into()).collect())
            }
        },
        label: match &zone.name {
            Some(name) => format!("{name}, μ {}", number(zone.friction, 2)),
            None => format!("μ {}", number(zone.friction, 2)),
        },
    };
    surface.zones.iter().map(zone).collect()
}

fn uphill(surface: &SurfaceData) -> Option<SceneArrow> {
    let grade = surface.grade;
    let steep = grade.norm();
    (steep > 0.0).then(|| SceneArrow {
        vector: grade.into(),
        label: format!("uphill, {} %", number(100.0 * steep, 1)),
    })
}

fn vehicle(
    case: &Case,
    analysis: &Analysis,
    id: VehicleId,
    units: Units,
    plain: Option<PlainSpeed<'_>>,
) -> Option<MotionVehicle> {
    let i = id.index();
    let is_plain = plain.is_some();
    let (given, travel) = (&case.vehicles[i], analysis.travel[i].as_ref());
    let body = Body::of(given, &analysis.vehicles[i]);
    let name = match &given.name {
        Some(name) if is_plain => name.to_string(),
        _ => name_of(id, given),
    };
    let body_drawn = scene_body(case, &analysis.vehicles[i], body, i);
    let (start, forward) = match (travel, &analysis.impact) {
        (Some(travel), _) => (travel.start.position.into(), direction(travel.start.heading)),
        (None, Some(impact)) => {
            let participant = &impact.contact.participants()[i];
            let [x, y] = place_of_impact(case);
            let cg = Vector2::new(x, y) - participant.arm();
            (cg.into(), participant.forward().into())
        }
        (None, None) => return None,
    };
    let legend = body.filter(|_| !is_plain).and_then(|body| body.class_legend(id));
    let before = analysis.exchange().filter(|_| !given.fixed).map(|exchange| exchange.before[i].velocity);
    let approach = before.filter(|velocity| velocity.norm() > STANDING).map(|velocity| SceneArrow {
        vector: velocity.into(),
        label: {
            let speed = plain.unwrap_or(PlainSpeed::Exact).label(analysis.speed(id), units);
            let whose = if is_plain { format!("vehicle {id}") } else { ["v₁", "v₂"][i].to_owned() };
            format!("{whose} {}", speed.as_deref().unwrap_or("before the impact"))
        },
    });
    let is_solved_for = travel.is_some_and(|travel| travel.origin == TravelOrigin::Rest);
    let states = travel.map_or_else(Vec::new, dense);
    Some(MotionVehicle {
        name,
        legend,
        body: if matches!(body_drawn, SceneBody::Wall) && !given.fixed {
            SceneBody::Unknown
        } else {
            body_drawn
        },
        cg: start,
        forward,
        approach,
        path: states
            .iter()
            .map(|(time, state, _)| MotionPoint {
                time: *time,
                cg: state.position.into(),
                forward: direction(state.heading),
            })
            .collect(),
        rest: travel.filter(|_| !is_solved_for).map(|travel| MotionRest {
            cg: travel.rest.position.into(),
            forward: Some(direction(travel.rest.heading)),
            label: format!("rest {id}"),
        }),
        measured_rest: travel.and_then(|travel| {
            let measured = travel.measured?;
            let heading = measured.heading.heading(travel.start.heading);
            Some(MotionRest {
                cg: measured.position.into(),
                forward: Some(direction(heading)),
                label: if is_solved_for && !is_plain {
                    format!("rest {id}, measured: the path was solved to end here")
                } else {
                    format!("rest {id}, measured")
                },
            })
        }),
        measured_points: travel.map_or_else(Vec::new, |travel| {
            let have_points =
                |travel: &Option<Travel>| travel.as_ref().is_some_and(|one| !one.points.is_empty());
            let whose =
                if analysis.travel.iter().all(have_points) { format!("v{id} ") } else { String::new() };
            let point = |(n, point): (usize, &PointData)| MeasuredPoint {
                at: point.position.into(),
                label: match point.wheel {
                    Some(wheel) => format!("{whose}point {}, {} wheel", n + 1, wheel.name()),
                    None => format!("{whose}point {}", n + 1),
                },
            };
            travel.points.iter().enumerate().map(point).collect()
        }),
        marks: travel.map_or_else(Vec::new, |travel| marks(travel, &states)),
        skids: skids(case, travel, id, Pose { cg: start, forward, approach: before }),
    })
}

/// Where a vehicle is at the impact.
#[derive(Clone, Copy)]
struct Pose {
    /// (m)
    cg: [f64; 2],
    /// Its heading; a unit vector.
    forward: [f64; 2],
    /// (m/s) its velocity before the impact, where that is known.
    approach: Option<Vector2<f64>>,
}

/// The skid marks before the impact, straight up to the wheels at the impact; a single one of the CG if the
/// positions of the wheels are unknown.
fn skids(case: &Case, travel: Option<&Travel>, id: VehicleId, pose: Pose) -> Vec<[[f64; 2]; 2]> {
    let Some(skid) = case.skids()[id.index()] else { return Vec::new() };
    let cg = Vector2::from(pose.cg);
    let begin = case.vehicles[id.index()].skid().map(|skid| skid.begin);
    let from = match begin {
        Some(SkidBegin::From(place)) => Some(Vector2::new(place.x.si(), case.axes.lateral(place.y.si()))),
        _ => None,
    };
    // From the start of the marks to their end; else along the direction of travel or, if that is not known,
    // the heading.
    let along = from.map(|from| cg - from).or(pose.approach).filter(|way| way.norm() > 0.0);
    let along = along.unwrap_or(Vector2::from(pose.forward));
    let way = along * (skid.length / along.norm());
    let ends = match travel {
        Some(travel) => travel.chassis.wheel_positions(cg, travel.start.heading).to_vec(),
        None => vec![cg],
    };
    ends.into_iter().map(|end| [(end - way).into(), end.into()]).collect()
}

fn direction(heading: f64) -> [f64; 2] {
    let (sin, cos) = Real::sin_cos(heading);
    [cos, sin]
}

/// A time (s), the state then, and which wheels slide.
type Moment = (f64, State, [bool; 4]);

/// The path at more moments than the steps of the integration.
fn dense(travel: &Travel) -> Vec<Moment> {
    let mut moments = Vec::new();
    for pair in travel.samples.windows(2) {
        let [from, to] = pair else { continue };
        for part in 0..PARTS {
            let time = from.time + (to.time - from.time) * f64::from(part) / f64::from(PARTS);
            moments.push((time, from.between(to, time), from.sliding));
        }
    }
    moments.extend(travel.samples.last().map(|last| (last.time, last.state, last.sliding)));
    moments
}

/// A line for each stretch on which a wheel slides.
fn marks(travel: &Travel, moments: &[Moment]) -> Vec<Vec<[f64; 2]>> {
    let mut marks = Vec::new();
    for wheel in 0..4 {
        let mut mark = Vec::new();
        for (_, state, sliding) in moments {
            let places = travel.chassis.wheel_positions(state.position, state.heading);
            if let (Some(true), Some(&at)) = (sliding.get(wheel), places.get(wheel)) {
                mark.push(at.into());
            } else if mark.len() > 1 {
                marks.push(std::mem::take(&mut mark));
            } else {
                mark.clear();
            }
        }
        if mark.len() > 1 {
            marks.push(mark);
        }
    }
    marks
}

fn description(analysis: &Analysis, units: Units, what: &str) -> String {
    let mut sentences = vec![what.to_owned()];
    for (id, travel) in VehicleId::ALL.into_iter().zip(&analysis.travel) {
        let Some(travel) = travel else { continue };
        sentences.push(format!(
            "Vehicle {id} leaves the impact at {} and comes to rest after {}, turned by {}.",
            units.road_speed(travel.start.motion.velocity.norm()),
            units.format(Measure::Length, travel.rest.distance),
            units.format(Measure::Angle, (travel.rest.heading - travel.start.heading).abs()),
        ));
    }
    sentences.join(" ")
}

/// Each vehicle with its curve, where a chart has one of both.
pub(super) fn of_vehicles() -> impl Iterator<Item = (VehicleId, CurveKind)> {
    VehicleId::ALL.into_iter().zip([CurveKind::First, CurveKind::Second])
}

/// Speed, yaw rate and heading over time.
pub(super) fn curves(case: &Case, analysis: &Analysis, units: Units) -> Result<CurvesPicture, DrawingError> {
    if analysis.travel.iter().all(Option::is_none) {
        return Err(DrawingError::NoMotion { subject: Subject::MotionCurves });
    }
    let states = analysis.travel.each_ref().map(|travel| travel.as_ref().map_or_else(Vec::new, dense));
    let last = states.iter().flatten().map(|(time, ..)| *time).fold(0.0, f64::max);
    let panel = |label: &str, measure: Measure, of: &dyn Fn(&State) -> f64| {
        let across = axis(units, "time since the impact", Measure::Time);
        Curves {
            ends: Some([0.0, if last > 0.0 { last } else { across.unit }]),
            across,
            upward: axis(units, label, measure),
            curves: states
                .each_ref()
                .map(|states| states.iter().map(|(time, state, _)| [*time, of(state)]).collect()),
            samples: Vec::new(),
            computed: Vec::new(),
            marks: Vec::new(),
        }
    };
    let lateral = |value: f64| case.axes.lateral(value);
    let caveat = caveat(analysis);
    Ok(CurvesPicture {
        name: "motion-curves",
        title: title(case),
        subtitle: "From the impact to rest".to_owned(),
        description: with_caveat(description(analysis, units, OVER_TIME), &caveat),
        caveat,
        height: 170.0,
        is_thinned: true,
        panels: vec![
            panel("speed", Measure::RoadSpeed, &|state| state.motion.velocity.norm()),
            panel("yaw rate", Measure::YawRateDegrees, &|state| lateral(state.motion.yaw_rate)),
            panel("heading", Measure::Angle, &|state| lateral(state.heading)),
        ],
        legend: of_vehicles()
            .filter(|(id, _)| analysis.travel[id.index()].is_some())
            .map(|(id, kind)| (kind, name_of(id, &case.vehicles[id.index()])))
            .collect(),
    })
}
