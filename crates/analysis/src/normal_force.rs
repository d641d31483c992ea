//! The directions of a force that is normal to the crush plane.

use inputs::CollisionData;
use pim_core::VehicleId;

/// (rad) PDOF of both vehicles if the force were normal to the crush plane.
pub(crate) fn reference(nominal: &CollisionData) -> [f64; 2] {
    let normal = nominal.contact.normal();
    // The force on vehicle 1 acts along n, that on vehicle 2 against it.
    let from = |id: VehicleId, sign: f64| {
        let forward = nominal.contact.participants()[id.index()].forward();
        let along = -sign * (normal.x * forward.x + normal.y * forward.y);
        let left = -sign * (normal.y * forward.x - normal.x * forward.y);
        // Clockwise from the heading.
        real::principal_angle(-real::elementary::atan2(left, along))
    };
    [from(VehicleId::One, 1.0), from(VehicleId::Two, -1.0)]
}
