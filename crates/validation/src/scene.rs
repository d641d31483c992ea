//! The published data on the motion after the impact, read from `fixtures/ricsac/motion/published.toml`.

use std::f64::consts::PI;

use crash3::VehicleClass;
use pim_core::{Body, Motion, Vector2, VehicleId};
use real::elementary;
use serde::Deserialize;
use trajectory::{Axles, Chassis, Ground, Target};

use crate::Data;
use crate::claim::Erratum;
use crate::error::ValidationError;
use crate::published::DEGREE;
use crate::staged::Staged;

/// (m) one foot.
const FOOT: f64 = 0.3048;
/// (m/s) one mile per hour.
const MILE_PER_HOUR: f64 = 0.447_04;

/// All data, in the printed units.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Scene {
    friction: f64,
    pub(crate) simulation: Vec<Simulation>,
    after: Vec<After>,
    pub(crate) rest: Vec<Rest>,
    uncased: Vec<Uncased>,
}

/// Mean errors (%) of a simulation of whole collisions.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Simulation {
    pub(crate) name: String,
    pub(crate) errors: [f64; 2],
}

/// V_x, V_y (m/s) and yaw rate (rad/s) after the impact.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct After {
    pub(crate) test: u8,
    motion: [[f64; 3]; 2],
    printed: Option<String>,
    reason: Option<String>,
}

/// How a vehicle came to rest (ft, degrees).
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Rest {
    pub(crate) test: u8,
    vehicle: u8,
    class: u8,
    distance: f64,
    within: f64,
    heading: f64,
    direction: Option<f64>,
    /// (–) fitted to this distance.
    pub(crate) drag: Option<f64>,
    #[serde(default)]
    pub(crate) struck_again: bool,
}

/// A test without a case: of vehicle 1 and vehicle 2, mass (kg), yaw inertia (kg·m²), heading (degrees) and
/// speed (mph).
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Uncased {
    test: u8,
    masses: [f64; 2],
    yaw_inertias: [f64; 2],
    headings: [f64; 2],
    speeds: [f64; 2],
}

/// The data of a test for its motion before and after the impact. SI units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collided {
    pub(crate) bodies: [Body; 2],
    /// (rad)
    pub(crate) headings: [f64; 2],
    /// (m/s) along the headings.
    pub(crate) true_speeds: [f64; 2],
}

impl Scene {
    pub(crate) fn read(data: &Data) -> Result<Self, ValidationError> {
        toml::from_str(data.motion).map_err(|error| ValidationError::Published(Box::new(error)))
    }

    /// The ground of all tests.
    pub(crate) fn ground(&self) -> Ground<'static> {
        Ground::level(self.friction)
    }

    /// The published motions after the impact.
    pub(crate) fn after(&self, test: u8) -> Option<&After> {
        self.after.iter().find(|after| after.test == test)
    }

    pub(crate) fn rest(&self, test: u8, vehicle: VehicleId) -> Option<&Rest> {
        self.rest.iter().find(|rest| rest.test == test && rest.vehicle == vehicle.number())
    }

    /// The vehicles of a test, from its case if there is one.
    pub(crate) fn collided(&self, staged: &[Staged], test: u8) -> Result<Collided, ValidationError> {
        if let Some(staged) = staged.iter().find(|staged| staged.printed.test == test) {
            let impact = staged.collision()?;
            let participants = impact.contact.participants();
            let forward = impact.outcome.forward;
            return Ok(Collided {
                bodies: participants.each_ref().map(|participant| *participant.body()),
                headings: forward.map(|forward| elementary::atan2(forward.y, forward.x)),
                true_speeds: staged.true_speeds()?,
            });
        }
        let incomplete = ValidationError::Incomplete { test, what: "vehicles" };
        let uncased = self.uncased.iter().find(|uncased| uncased.test == test).ok_or(incomplete)?;
        let body = |i: usize| Body::new(uncased.masses[i], uncased.yaw_inertias[i]);
        Ok(Collided {
            bodies: [body(0)?, body(1)?],
            headings: uncased.headings.map(|heading| heading * DEGREE),
            true_speeds: uncased.speeds.map(|speed| speed * MILE_PER_HOUR),
        })
    }

    /// (–) the mean of the drags fitted to the other tests.
    pub(crate) fn drag_of_others(&self, test: u8) -> f64 {
        let drags: Vec<f64> =
            self.rest.iter().filter(|rest| rest.test != test).filter_map(|rest| rest.drag).collect();
        #[expect(clippy::cast_precision_loss, reason = "a handful of vehicles")]
        let count = drags.len() as f64;
        drags.iter().sum::<f64>() / count
    }
}

impl After {
    /// Velocity and yaw rate of a vehicle.
    pub(crate) fn motion(&self, vehicle: VehicleId) -> Motion {
        let [x, y, yaw_rate] = self.motion[vehicle.index()];
        Motion { velocity: Vector2::new(x, y), yaw_rate }
    }

    pub(crate) fn erratum(&self) -> Option<Erratum> {
        Some(Erratum { printed: self.printed.clone()?, reason: self.reason.clone()? })
    }
}

impl Rest {
    pub(crate) fn vehicle(&self) -> VehicleId {
        if self.vehicle == VehicleId::One.number() { VehicleId::One } else { VehicleId::Two }
    }

    /// (m) from the impact.
    pub(crate) fn distance(&self) -> f64 {
        self.distance * FOOT
    }

    /// (m) possible error of the distance.
    pub(crate) fn within(&self) -> f64 {
        self.within * FOOT
    }

    /// (rad) direction of the path after the impact in the scene.
    pub(crate) fn direction(&self) -> Option<f64> {
        // Printed from −x towards +y: φ = π − φ'
        self.direction.map(|direction| PI - direction * DEGREE)
    }

    /// (rad) turn of the vehicle from its heading at impact, counter-clockwise. No vehicle turned by more
    /// than half a revolution.
    pub(crate) fn turn(&self, heading: f64) -> f64 {
        // Printed in axes with x reversed and z down: ψ = π − ψ'
        real::principal_angle(PI - self.heading * DEGREE - heading)
    }

    /// The vehicle on its wheels, with this drag (–) on each of them.
    pub(crate) fn chassis(&self, body: Body, drag: f64) -> Result<Chassis, ValidationError> {
        let crushed = |source| ValidationError::of_test(self.test, source);
        let VehicleClass { wheelbase, track, cg_to_front_axle, .. } =
            VehicleClass::new(self.class).map_err(crushed)?;
        let axles = Axles { cg_to_front: cg_to_front_axle, cg_to_rear: wheelbase - cg_to_front_axle, track };
        Ok(Chassis::new(body, axles, [drag; 4])?)
    }

    /// The rest position at the published distance and turn, in a direction (rad), of a vehicle that left the
    /// origin with a heading (rad).
    pub(crate) fn target(&self, direction: f64, heading: f64) -> Target {
        Target {
            position: polar(self.distance(), direction),
            heading: heading + self.turn(heading),
            turns_known: true,
            via: None,
        }
    }
}

/// The vector of a length in a direction (rad).
pub(crate) fn polar(length: f64, direction: f64) -> Vector2<f64> {
    let (sin, cos) = elementary::sin_cos(direction);
    Vector2::new(length * cos, length * sin)
}

/// The length of a vector and its direction (rad).
pub(crate) fn length_and_direction(vector: Vector2<f64>) -> (f64, f64) {
    ((vector.x * vector.x + vector.y * vector.y).sqrt(), elementary::atan2(vector.y, vector.x))
}
