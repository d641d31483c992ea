//! Geometry, speed, impulse, motion and energy.

mod energy;
mod geometry;
mod impulse;
mod motion;
mod speed;

use analysis::{Impact, Seen};
use case::Case;
use pim_core::VehicleId;

use super::{DraftGroup, group};

pub(super) use self::energy::{kinetic, works};
pub(super) use self::motion::{pdof, relative};

/// The data that most steps share.
struct Collision<'a> {
    case: &'a Case,
    analysis: &'a Seen,
    impact: &'a Impact,
    /// (rad) scene angle of n, oriented from vehicle 2 to vehicle 1.
    gamma: f64,
    /// Whether each vehicle can move.
    has_inertia: [bool; 2],
}

pub(super) fn groups(case: &Case, analysis: &Seen) -> Vec<DraftGroup> {
    let Some(impact) = &analysis.impact else { return Vec::new() };
    let collision = Collision {
        case,
        analysis,
        impact,
        gamma: impact.contact.normal_angle(),
        has_inertia: analysis
            .vehicles
            .each_ref()
            .map(|vehicle| vehicle.subject.inertia.is_some_and(|inertia| inertia.yaw_inertia.is_some())),
    };
    let is_check = analysis.law_check().is_some();
    let mut groups = vec![
        group("Geometry", collision.geometry()),
        group("Contact inverse mass", collision.inverse_mass()),
        group("Speed", analysis.found.as_ref().map_or_else(Vec::new, |found| collision.speed(found))),
        group("Approach", collision.approach()),
        group("Impulse", collision.impulse()),
        group("Impulse in the scene", collision.impulse_in_scene()),
        group("Motion of vehicle 1 after impact", collision.motion(VehicleId::One)),
        group("Motion of vehicle 2 after impact", collision.motion(VehicleId::Two)),
        group("Energy balance", collision.energy()),
    ];
    if is_check {
        for group in &mut groups {
            group.title = format!("Check by the impact law: {}", group.title);
        }
    }
    groups
}

impl Collision<'_> {
    fn moving(&self) -> impl Iterator<Item = VehicleId> {
        VehicleId::ALL.into_iter().filter(|k| self.has_inertia[k.index()])
    }

    /// A sum over the vehicles that can move.
    fn sum(&self, term: impl Fn(VehicleId) -> String) -> String {
        self.moving().map(term).collect::<Vec<_>>().join(" + ")
    }
}
