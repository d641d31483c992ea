//! The scene: both vehicles at impact, seen from above.

use ::drawing::{SceneArrow, SceneBody, SceneMotion, ScenePicture, SceneVehicle};
use analysis::{Analysis, Exchange, Seen};
use case::{Axes, Case, Geometry};
use pim_core::{Contact, Real, Vector2, VehicleId};

use super::vehicle::{Body, DrawnOutline, name_of, profile};
use super::{DrawingError, PlainSpeed, Subject, caveat, scale_unit, title, with_caveat};
use crate::Units;
use crate::axes;
use crate::units::Measure;

/// The same for readers who are not engineers: vehicles and their speeds before and after, in words.
pub(super) fn plain(
    case: &Case,
    analysis: &Analysis,
    speeds: [PlainSpeed<'_>; 2],
    units: Units,
) -> Result<ScenePicture, DrawingError> {
    let picture = picture(case, analysis, units)?;
    let mut description = vec!["Both vehicles from above at the moment of impact, to scale.".to_owned()];
    let mut vehicles = picture.vehicles;
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&mut vehicles) {
        let given = &case.vehicles[id.index()];
        let kind = if given.fixed { "fixed object" } else { "vehicle" };
        let name = given.name.as_ref().map_or_else(|| format!("{kind} {id}"), ToString::to_string);
        let body = Body::of(given, &analysis.vehicles[id.index()]);
        vehicle.legend = Some(match (&vehicle.body, body.map(|body| body.outline)) {
            (SceneBody::Wall | SceneBody::Unknown, _) => format!("{name}, shape not known"),
            (_, Some(DrawnOutline::OfClass(_))) => format!("{name}, typical shape"),
            (_, Some(DrawnOutline::Nearest(_))) => format!("{name}, shape assumed"),
            (_, Some(DrawnOutline::Given) | None) => name.clone(),
        });
        vehicle.motion = vehicle.motion.take().and_then(|motion| {
            let (speed, exact) = (speeds[id.index()], analysis.speed(id));
            let before = speed.label(exact, units)?;
            if matches!(speed, PlainSpeed::Exact) {
                let size = length(motion.after.vector.into());
                let after = format!("after: {}", units.format(Measure::RoadSpeed, size));
                description.push(format!("Speed of {name} {before}, {after}."));
                let [before, after] = [(before, motion.before), (after, motion.after)]
                    .map(|(label, arrow)| SceneArrow { label, ..arrow });
                return Some(SceneMotion { before, after, ..motion });
            }
            description.push(format!("Speed of {name} {before}."));
            // Only the speed along the heading is known exactly, not the velocity after the impact, which
            // follows from it.
            let along = speed.along(exact).filter(|along| *along != 0.0)?;
            let vector = vehicle.forward.map(|part| part * along);
            let after = SceneArrow { vector: [0.0; 2], label: String::new() };
            Some(SceneMotion { before: SceneArrow { vector, label: before }, after, ..motion })
        });
        vehicle.name = name;
    }
    let caveat = PlainSpeed::caveat(speeds).to_owned();
    let description = with_caveat(description.join(" "), &caveat);
    Ok(ScenePicture { is_plain: true, description, caveat, vehicles, ..picture })
}

/// The scene, without arrows if the analysis has only the geometry.
pub(super) fn picture(case: &Case, analysis: &Analysis, units: Units) -> Result<ScenePicture, DrawingError> {
    let no_scene = DrawingError::NoImpact { subject: Subject::Scene };
    if analysis.both.as_ref().is_some_and(|both| both.geometry != Geometry::Given) {
        return Err(no_scene);
    }
    let contact = analysis.impact.as_ref().map(|impact| &impact.contact).or(analysis.geometry.as_ref());
    let contact = contact.ok_or(no_scene)?;
    let exchange = analysis.exchange();
    let caveat = caveat(analysis);
    Ok(ScenePicture {
        title: title(case),
        description: with_caveat(description(case, &analysis.seen(case.axes), units), &caveat),
        caveat,
        is_z_down: case.axes == Axes::ZDown,
        is_plain: false,
        vehicles: VehicleId::ALL.map(|id| vehicle(case, analysis, (contact, exchange.as_ref()), id, units)),
        normal: contact.normal().into(),
        impulse: exchange.map(|exchange| {
            let vector = exchange.impulse_vector;
            let label = format!("P {}", units.format(Measure::Impulse, length(vector)));
            SceneArrow { vector: vector.into(), label }
        }),
        length: scale_unit(units, Measure::Length),
        speed: scale_unit(units, Measure::RoadSpeed),
    })
}

fn vehicle(
    case: &Case,
    analysis: &Analysis,
    (contact, exchange): (&Contact, Option<&Exchange>),
    id: VehicleId,
    units: Units,
) -> SceneVehicle {
    let i = id.index();
    let participant = &contact.participants()[i];
    let body = Body::of(&case.vehicles[i], &analysis.vehicles[i]);
    let is_fixed = participant.body().is_fixed();
    let name = name_of(id, &case.vehicles[i]);
    let legend = match (&body, is_fixed) {
        (Some(body), _) => Some(body.class_legend(id).unwrap_or_else(|| format!("outline {id}, as given"))),
        (None, true) => Some(match &case.vehicles[i].diameter {
            Some(diameter) => {
                format!("{id}: fixed object, {} across", units.format(Measure::Crush, diameter.si()))
            }
            None => format!("{id}: fixed object, extent not known"),
        }),
        (None, false) => Some(format!("{id}: outline not known")),
    };
    SceneVehicle {
        name,
        legend,
        body: scene_body(case, &analysis.vehicles[i], body, i),
        // r points from the CG to C, which is the origin.
        cg: (-participant.arm()).into(),
        forward: participant.forward().into(),
        is_fixed,
        motion: exchange
            .filter(|_| !is_fixed)
            .map(|exchange| motion(exchange, analysis.speed(id), participant.forward(), i, units)),
    }
}

/// The body of a vehicle, with its crush if that was measured.
pub(super) fn scene_body(
    case: &Case,
    vehicle: &analysis::Vehicle,
    body: Option<Body>,
    i: usize,
) -> SceneBody {
    let given = &case.vehicles[i];
    if let Some(diameter) = &given.diameter {
        return SceneBody::Pole { diameter: diameter.si() };
    }
    let Some(body) = body else {
        return if given.fixed { SceneBody::Wall } else { SceneBody::Unknown };
    };
    let measured = vehicle.damage.as_ref().filter(|damage| damage.inferred.is_none());
    SceneBody::Outline {
        footprint: body.footprint(),
        crush: measured
            .and_then(|damage| profile(case, vehicle, |side| body.dimensions.face(side), damage, i)),
    }
}

fn motion(exchange: &Exchange, speed: f64, forward: Vector2<f64>, i: usize, units: Units) -> SceneMotion {
    let number = ["₁", "₂"][i];
    let arrow = |velocity: Vector2<f64>, label: String| SceneArrow { vector: velocity.into(), label };
    let before = format!("v{number} before: {}", units.speed_in_words(speed));
    let after = exchange.velocities[i];
    let size = units.format(Measure::RoadSpeed, length(after));
    // The heading, turned clockwise by the PDOF.
    let (sin, cos) = Real::sin_cos(exchange.pdof[i]);
    let from = [forward.x * cos + forward.y * sin, forward.y * cos - forward.x * sin];
    let pdof = units.format(Measure::Angle, exchange.pdof[i]);
    SceneMotion {
        before: arrow(exchange.before[i].velocity, before),
        after: arrow(after, format!("V{number} after: {size}")),
        force_from: SceneArrow { vector: from, label: format!("PDOF{number} {pdof}") },
    }
}

fn length(vector: Vector2<f64>) -> f64 {
    (vector.x * vector.x + vector.y * vector.y).sqrt()
}

/// In the axes of the case, as is `analysis`.
fn description(case: &Case, analysis: &Seen, units: Units) -> String {
    let exchange = analysis.exchange();
    let mut sentences = vec!["Both vehicles from above at the moment of impact, to scale.".to_owned()];
    for id in VehicleId::ALL {
        let i = id.index();
        let vehicle = &case.vehicles[i];
        let name = vehicle.name.clone().map(|name| format!(", {name},")).unwrap_or_default();
        if vehicle.fixed {
            sentences.push(format!("Vehicle {id}{name} is a fixed object."));
            continue;
        }
        let heading = vehicle.heading.as_ref().map_or(0.0, case::Quantity::si);
        let heads = format!(
            "Vehicle {id}{name} heads {} {} from the x axis of the scene",
            units.format(Measure::Angle, heading),
            axes::sense(case.axes)
        );
        let Some(exchange) = exchange else {
            sentences.push(format!("{heads}."));
            continue;
        };
        sentences.push(format!(
            "{heads}; its velocity is {} before and {} after the impact; the force on it comes from {} clockwise of its heading.",
            units.format_vector(Measure::RoadSpeed, exchange.before[i].velocity.into()),
            units.format_vector(Measure::RoadSpeed, exchange.velocities[i].into()),
            units.format(Measure::Angle, exchange.pdof[i]),
        ));
    }
    let Some(exchange) = exchange else {
        sentences.push("The speeds are not known.".to_owned());
        return sentences.join(" ");
    };
    sentences.push(format!(
        "The impulse of {} on vehicle 1 at the contact point C points to {} in the scene.",
        units.format(Measure::Impulse, length(exchange.impulse_vector)),
        units.format(Measure::Angle, exchange.impulse_direction()),
    ));
    sentences.join(" ")
}
