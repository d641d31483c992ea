//! Geometry, speed, impulse, motion and energy.

mod energy;
mod geometry;
mod impulse;
mod motion;
mod speed;

use analysis::{Impact, Seen};
use case::Case;
use pim_core::VehicleId;

use super::{StepGroup, group};

pub(super) use self::energy::{kinetic, work};
pub(super) use self::motion::relative;

/// The data that most steps share.
struct Collision<'a> {
    case: &'a Case,
    analysis: &'a Seen,
    impact: &'a Impact,
    /// (rad) scene angle of n, oriented from vehicle 2 to vehicle 1.
    gamma: f64,
    /// (kg, kg·m²) of each vehicle that can move.
    inertia: [Option<(f64, f64)>; 2],
}

pub(super) fn groups(case: &Case, analysis: &Seen) -> Vec<StepGroup> {
    let Some(impact) = &analysis.impact else { return Vec::new() };
    let collision = Collision {
        case,
        analysis,
        impact,
        gamma: impact.contact.normal_angle(),
        inertia: analysis
            .vehicles
            .each_ref()
            .map(|vehicle| vehicle.subject.inertia.and_then(|v| Some((v.mass, v.yaw_inertia?)))),
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
    fn moving(&self) -> impl Iterator<Item = (VehicleId, f64, f64)> {
        let vehicles = VehicleId::ALL.into_iter().zip(self.inertia);
        vehicles.filter_map(|(k, v)| v.map(|(m, inertia)| (k, m, inertia)))
    }

    /// A sum over the vehicles that can move, in symbols and in numbers.
    fn sum(
        &self,
        symbols: &dyn Fn(VehicleId) -> String,
        numbers: &dyn Fn(VehicleId, f64, f64) -> String,
    ) -> (String, String) {
        let formula: Vec<String> = self.moving().map(|(k, ..)| symbols(k)).collect();
        let substitution: Vec<String> = self.moving().map(|(k, m, inertia)| numbers(k, m, inertia)).collect();
        (formula.join(" + "), substitution.join(" + "))
    }
}
