//! The warnings on a case that need no answer.

use inputs::{Basis, Case, CollisionData, ForceData, VehicleData};

use crate::checks;
use crate::damage;
use crate::impact::closing_speed;
use crate::vehicle::{NOTHING, Vehicle};
use crate::warning::{self, Warning};

/// The warnings that need neither the impulse nor an unknown speed.
pub(crate) fn warnings(case: &Case, collision: Option<&CollisionData>) -> Vec<Warning> {
    let mut warnings = Vec::new();
    if let Some(collision) = collision {
        warning::of_plane(&collision.contact, &mut warnings);
        // The closing speed is unknown if a speed has to be found.
        if case.reconstruct.is_none() {
            let speed = closing_speed(collision);
            warning::of_restitution(collision.law.at(speed).restitution(), speed, &mut warnings);
        }
    }
    let speeds = collision.map(|collision| collision.motions.map(|motion| motion.velocity.norm()));
    let subjects = case.subjects().map(|subject| subject.unwrap_or(NOTHING));
    of_vehicles(case, subjects, speeds, &mut warnings);
    warnings
}

/// `speeds` (m/s) of a collision; an unknown one is zero.
fn of_vehicles(
    case: &Case,
    mut subjects: [VehicleData; 2],
    speeds: Option<[f64; 2]>,
    warnings: &mut Vec<Warning>,
) {
    let directed = subjects.each_ref().map(|subject| {
        let damage = subject.damage.as_ref();
        damage.is_some_and(|damage| subject.force.pdof.or(damage.oblique_angle).is_some())
    });
    // A force can be balanced only if both angles to it are known.
    if directed != [true; 2] {
        for (subject, vehicle) in subjects.iter_mut().zip(&case.vehicles) {
            if vehicle.crush.as_ref().is_some_and(|crush| crush.from_force_balance) {
                (subject.damage, subject.force) = (None, ForceData::UNKNOWN);
            }
        }
    }
    // The engine's refusal of a damage is reported when it is solved.
    let assessed = damage::assess(subjects.clone(), [None, None]);
    let mut vehicles =
        assessed.unwrap_or_else(|_| subjects.map(|subject| Vehicle { subject, damage: None, energy: None }));
    warning::of_outlines(&vehicles, warnings);
    warning::of_case(case, warnings);
    warning::of_data(&vehicles, speeds.map_or([None; 2], |speeds| speeds.map(Some)), [false; 2], warnings);
    warning::of_assumptions(case, &vehicles, warnings);
    for (vehicle, directed) in vehicles.iter_mut().zip(directed) {
        if !directed {
            vehicle.damage = None;
        }
    }
    warning::of_damage(&vehicles, warnings);
    let checks = checks::checks(&vehicles, case.headings(), None, None, None);
    warning::of_checks(&checks, &vehicles, None, None, Basis::default(), warnings);
}
