//! The impact of an analysis.

use inputs::CollisionData;
use pim_core::{Contact, ImpactError, Law, Outcome, Real, VaryingLaw, Vector2, VehicleId};

/// An impact and its inputs.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Impact {
    /// The geometry.
    pub contact: Contact,
    /// The impact law as given.
    pub given_law: VaryingLaw,
    /// The law with the restitution at this closing speed.
    pub law: Law,
    /// The effect of the impact.
    pub outcome: Outcome,
    /// (rad) principal direction of force of both vehicles, clockwise from the heading in any axes.
    pub pdof: [f64; 2],
}

impl Impact {
    pub(crate) fn new(contact: Contact, given_law: VaryingLaw, law: Law, outcome: Outcome) -> Self {
        Self { contact, given_law, law, outcome, pdof: outcome.pdof() }
    }

    /// (m/s) speed of a vehicle before the impact: negative if it moves backward.
    #[must_use]
    pub fn speed(&self, vehicle: VehicleId) -> f64 {
        let velocity = self.outcome.before[vehicle.index()].velocity;
        speed_along(self.contact.participants()[vehicle.index()].course(), velocity)
    }
}

/// (m/s) the speed of a vehicle with this velocity: negative if it moves against its course.
pub(crate) fn speed_along(course: Vector2<f64>, velocity: Vector2<f64>) -> f64 {
    // |v| = √(v_x² + v_y²)
    let size = (velocity.x * velocity.x + velocity.y * velocity.y).sqrt();
    if velocity.x * course.x + velocity.y * course.y < 0.0 { -size } else { size }
}

/// The impact of a fully known collision, and the law at its closing speed.
pub(crate) fn collide<T: Real>(collision: &CollisionData<T>) -> Result<(Law<T>, Outcome<T>), ImpactError> {
    let law = collision.law.at(closing_speed(collision));
    collision.contact.impact(collision.motions, &law).map(|outcome| (law, outcome))
}

/// (m/s) closing speed along the normal at C, negative if the vehicles move apart.
pub(crate) fn closing_speed<T: Real>(collision: &CollisionData<T>) -> T {
    -collision.contact.approach(&collision.motions).velocity.normal
}
