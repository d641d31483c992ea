//! Usual sizes of each kind of vehicle. The ranges are wide: beyond them, a unit is probably wrong.

use crash3::Side;
use inputs::{Dimensions, VehicleKind};

/// How much wider than the face a damage may be, as a share of the face: a crushed front bows out round the
/// corners, and a size class gives a typical outline.
const SPREAD: f64 = 0.1;

/// The usual numbers of one kind of vehicle.
#[derive(Debug)]
pub(crate) struct Usual {
    /// (kg) at the collision, with load and occupants.
    mass: [f64; 2],
    /// (kg/m²) the ratio of the mass to length times width.
    areal_mass: [f64; 2],
    /// (m) k.
    pub(crate) yaw_radius: [f64; 2],
    /// (m/s) before the impact.
    pub(crate) speed: [f64; 2],
    /// (m) of the body.
    pub(crate) length: [f64; 2],
    /// (m) of the body.
    pub(crate) width: [f64; 2],
    /// (m) the greatest depth of crush.
    depth: f64,
    /// (m) the largest width of a damage to front or rear, and to a side, if no dimensions are known.
    damage_width: [f64; 2],
    /// (m/s) the smallest and the largest b_0, if known for a kind.
    pub(crate) no_damage_speed: Option<[f64; 2]>,
}

/// Cars, vans and pickups.
const CAR: Usual = Usual {
    // From a light quadricycle (at most 425 kg empty, EU 168/2013) to an overloaded light truck (10,000 lb or
    // 4536 kg in the US).
    mass: [300.0, 5000.0],
    // Cars have 150 to 250, a light one of the 1950s with its driver 110, a full van of 3.5 t on 5.9 m by 2 m
    // 300. Exchanged pounds and kilograms change it by 2.2.
    areal_mass: [100.0, 350.0],
    // CRASH3's classes have 1.1 to 1.7; a long van has 0.29 of 7.4 m.
    yaw_radius: [0.8, 2.2],
    // 250 km/h, 155 mph: most cars cannot drive faster.
    speed: [0.0, 250.0 / 3.6],
    // From a quadricycle to the longest vans and pickups.
    length: [2.2, 7.5],
    // From a quadricycle to a pickup with twin rear wheels.
    width: [1.2, 2.6],
    // With more, hardly anything is left of the front of a car, or of its compartment.
    depth: 1.5,
    damage_width: [2.6, 6.0],
    // 1 mph: parking leaves no damage. 15 mph: over the width of the face, CRASH3's categories have 3 to 11
    // mph, except the rear of category 4 (16 mph).
    no_damage_speed: Some([0.447_04, 15.0 * 0.447_04]),
};

/// Lorries, buses and tractors with semitrailers.
const HEAVY_TRUCK: Usual = Usual {
    // From an empty light lorry to the longest combinations of Northern Europe (76 t) and somewhat more.
    mass: [2000.0, 80_000.0],
    // A loaded mixer of four axles has 1400: 32 t on 9.3 m by 2.5 m.
    areal_mass: [0.0, 2000.0],
    // 0.29 of 5 m to 30 m.
    yaw_radius: [1.3, 9.0],
    // 150 km/h, 93 mph: beyond the governed 85 to 120 km/h of lorries and coaches.
    speed: [0.0, 150.0 / 3.6],
    // From a light lorry to a road train.
    length: [4.5, 36.0],
    // 2.55 or 2.6 at most, up to 4 with a wide load.
    width: [1.8, 4.0],
    depth: 2.0,
    damage_width: [4.0, 20.0],
    no_damage_speed: None,
};

/// Trailers and semitrailers without their towing vehicle.
const TRAILER: Usual = Usual {
    // From an empty luggage trailer to a low loader.
    mass: [80.0, 80_000.0],
    areal_mass: [0.0, 2000.0],
    // 0.29 of 1.5 m to 20 m.
    yaw_radius: [0.4, 6.0],
    speed: [0.0, 150.0 / 3.6],
    length: [1.5, 20.0],
    width: [0.8, 4.0],
    depth: 2.0,
    damage_width: [4.0, 20.0],
    no_damage_speed: None,
};

/// Motorcycles, scooters and mopeds.
const MOTORCYCLE: Usual = Usual {
    // From a moped without its rider to a touring motorcycle (about 400 kg) with sidecar and riders.
    mass: [50.0, 800.0],
    areal_mass: [0.0, 600.0],
    // Their wheelbase is 1.1 to 1.8 m, and half of that is k if all mass sits at the axles.
    yaw_radius: [0.25, 0.9],
    // 300 km/h, 186 mph.
    speed: [0.0, 300.0 / 3.6],
    // EU 168/2013, annex: at most 4 m long and, with a sidecar, 2 m wide.
    length: [1.2, 4.0],
    width: [0.3, 2.0],
    depth: 1.0,
    damage_width: [2.0, 4.0],
    no_damage_speed: None,
};

impl Usual {
    /// The usual numbers of a kind.
    pub(crate) fn of(kind: VehicleKind) -> &'static Self {
        match kind {
            VehicleKind::Car => &CAR,
            VehicleKind::HeavyTruck => &HEAVY_TRUCK,
            VehicleKind::Trailer => &TRAILER,
            VehicleKind::Motorcycle => &MOTORCYCLE,
        }
    }

    /// (kg) usual mass.
    pub(crate) fn mass(&self, dimensions: Option<&Dimensions>) -> [f64; 2] {
        let [least, most] = self.mass;
        let area = dimensions.map(|dimensions| dimensions.length * dimensions.width);
        area.map_or([least, most], |area| {
            let [low, high] = self.areal_mass.map(|share| share * area);
            [least.max(low), most.min(high)]
        })
    }

    /// (m) usual depth of crush.
    pub(crate) fn depth(&self, dimensions: Option<&Dimensions>, side: Side) -> [f64; 2] {
        let possible = dimensions.map(|dimensions| match side {
            Side::Front | Side::Rear => dimensions.length / 2.0,
            Side::Left | Side::Right => dimensions.width,
        });
        [0.0, possible.map_or(self.depth, |possible| self.depth.min(possible))]
    }

    /// (m) usual width of the damage.
    pub(crate) fn damage_width(&self, dimensions: Option<&Dimensions>, side: Side) -> [f64; 2] {
        let [across, along] = self.damage_width;
        let most = match (dimensions, side) {
            (Some(dimensions), _) => dimensions.extent(side) * (1.0 + SPREAD),
            (None, Side::Front | Side::Rear) => across,
            (None, Side::Left | Side::Right) => along,
        };
        [0.0, most]
    }
}
