//! The scene: both vehicles at impact, seen from above.

use ::drawing::{SceneArrow, SceneMotion, ScenePicture, SceneVehicle};
use analysis::{Analysis, Impact};
use case::{Axes, Case};
use pim_core::{Real, Vector2, VehicleId};

use super::vehicle::{Body, DrawnOutline};
use super::{DrawingError, Subject, scale_unit, title};
use crate::Units;
use crate::axes;
use crate::units::Measure;

pub(super) fn picture(case: &Case, analysis: &Analysis, units: Units) -> Result<ScenePicture, DrawingError> {
    let impact = analysis.impact.as_ref().ok_or(DrawingError::NoImpact { subject: Subject::Scene })?;
    let outcome = &impact.outcome;
    let impulse = units.format(Measure::Impulse, length(outcome.impulse_vector));
    Ok(ScenePicture {
        title: title(case),
        description: description(case, analysis.seen(case.axes).impact.as_ref().unwrap_or(impact), units),
        is_z_down: case.axes == Axes::ZDown,
        vehicles: VehicleId::ALL.map(|id| vehicle(case, analysis, impact, id, units)),
        normal: impact.contact.normal().into(),
        impulse: SceneArrow { vector: outcome.impulse_vector.into(), label: format!("P {impulse}") },
        length: scale_unit(units, Measure::Length),
        speed: scale_unit(units, Measure::RoadSpeed),
    })
}

fn vehicle(case: &Case, analysis: &Analysis, impact: &Impact, id: VehicleId, units: Units) -> SceneVehicle {
    let i = id.index();
    let participant = &impact.contact.participants()[i];
    let body = Body::of(&analysis.vehicles[i]);
    let is_fixed = participant.body().is_fixed();
    let name = match (case.vehicles[i].name.as_ref(), is_fixed) {
        (Some(name), _) => format!("{id} · {name}"),
        (None, true) => format!("{id} · fixed object"),
        (None, false) => format!("vehicle {id}"),
    };
    let legend = match (body.map(|body| body.outline), is_fixed) {
        (Some(DrawnOutline::Given), _) => Some(format!("outline {id}, as given")),
        (Some(DrawnOutline::OfClass(class)), _) => Some(format!("outline {id}: CRASH3 class {class}")),
        (Some(DrawnOutline::Nearest(class)), _) => {
            Some(format!("outline {id}: CRASH3 class {class}, assumed"))
        }
        (None, true) => Some(format!("{id}: fixed object, extent not known")),
        (None, false) => None,
    };
    SceneVehicle {
        name,
        legend,
        footprint: body.map(|body| body.footprint()),
        // r points from the CG to C, which is the origin.
        cg: (-participant.arm()).into(),
        forward: participant.forward().into(),
        motion: (!is_fixed).then(|| motion(impact, i, units)),
    }
}

fn motion(impact: &Impact, i: usize, units: Units) -> SceneMotion {
    let outcome = &impact.outcome;
    let number = ["₁", "₂"][i];
    let velocity = |symbol: &str, velocity: Vector2<f64>| SceneArrow {
        vector: velocity.into(),
        label: format!("{symbol}{number} {}", units.format(Measure::RoadSpeed, length(velocity))),
    };
    // The heading, turned clockwise by the PDOF.
    let forward = outcome.forward[i];
    let (sin, cos) = Real::sin_cos(impact.pdof[i]);
    let from = [forward.x * cos + forward.y * sin, forward.y * cos - forward.x * sin];
    let pdof = units.format(Measure::Angle, impact.pdof[i]);
    SceneMotion {
        before: velocity("v", outcome.before[i].velocity),
        after: velocity("V", outcome.after[i].velocity),
        force_from: SceneArrow { vector: from, label: format!("PDOF{number} {pdof}") },
    }
}

fn length(vector: Vector2<f64>) -> f64 {
    (vector.x * vector.x + vector.y * vector.y).sqrt()
}

/// In the axes of the case, and so is the impact.
fn description(case: &Case, impact: &Impact, units: Units) -> String {
    let outcome = &impact.outcome;
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
        sentences.push(format!(
            "Vehicle {id}{name} heads {} {} from the x axis of the scene; its velocity is {} before and {} after the impact; the force on it \
             comes from {} clockwise of its heading.",
            units.format(Measure::Angle, heading),
            axes::sense(case.axes),
            units.format_vector(Measure::RoadSpeed, outcome.before[i].velocity.into()),
            units.format_vector(Measure::RoadSpeed, outcome.after[i].velocity.into()),
            units.format(Measure::Angle, impact.pdof[i]),
        ));
    }
    sentences.push(format!(
        "The impulse of {} on vehicle 1 at the contact point C points to {} in the scene.",
        units.format(Measure::Impulse, length(outcome.impulse_vector)),
        units.format(Measure::Angle, outcome.impulse_direction()),
    ));
    sentences.join(" ")
}
