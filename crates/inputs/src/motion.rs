//! The data for the motion after the impact, in the types of its engine.

use pim_core::{Contact, Motion, Real, VaryingLaw, Vector2, VehicleId};
use reconcile::Departure;
use trajectory::{Chassis, FrictionZone, Region, Steer};

use crate::after::MarkedWheel;
use crate::basis::Basis;
use crate::data::{CollisionData, VehicleData};
use crate::text::Text;

/// The vehicles after the impact, and the ground on which they move.
#[derive(Clone, Debug)]
pub struct MotionInput<T = f64> {
    /// The ground.
    pub surface: SurfaceData<T>,
    /// Each vehicle; `None` if it is fixed or absent, or if the case does not give enough data to follow it.
    pub vehicles: [Option<VehicleMotion<T>>; 2],
}

/// The ground, in the axes of the engine.
#[derive(Clone, Debug)]
pub struct SurfaceData<T = f64> {
    /// (–) coefficient of friction outside all zones. Without a table `[surface]`, no vehicle uses it: each
    /// that is followed has its own.
    pub friction: T,
    /// (–) rise per horizontal length along x and along y.
    pub grade: Vector2<T>,
    /// Zones with their own friction; where two overlap, the later one counts.
    pub zones: Vec<ZoneData<T>>,
}

impl<T: Copy> SurfaceData<T> {
    /// The zones for the field of a [`trajectory::Ground`].
    #[must_use]
    pub fn zones(&self) -> Vec<FrictionZone<'_, T>> {
        self.zones
            .iter()
            .map(|zone| FrictionZone { region: zone.region.region(), friction: zone.friction })
            .collect()
    }
}

/// A zone of the ground.
#[derive(Clone, Debug)]
pub struct ZoneData<T = f64> {
    /// Its name.
    pub name: Option<Text>,
    /// (–) its coefficient of friction.
    pub friction: T,
    /// Its area.
    pub region: RegionData,
}

/// The area of a zone, in the axes of the engine.
#[derive(Clone, Debug)]
pub enum RegionData {
    /// Everything on one side of a straight line.
    HalfPlane {
        /// (m) a point of the line.
        point: Vector2<f64>,
        /// (rad) direction at right angles to the line, into the region.
        into: f64,
    },
    /// (m) the inside of a polygon with these corners.
    Polygon(Vec<Vector2<f64>>),
}

impl RegionData {
    /// The region in the type of the engine.
    #[must_use]
    pub fn region(&self) -> Region<'_> {
        match self {
            Self::HalfPlane { point, into } => Region::half_plane(*point, *into),
            Self::Polygon(corners) => Region::Polygon(corners),
        }
    }
}

/// A point that the CG of a vehicle passed, or one of its wheels, in the axes of the engine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointData<T = f64> {
    /// (m) the place.
    pub position: Vector2<T>,
    /// (rad) its heading there, if known, without full turns.
    pub heading: Option<T>,
    /// The wheel, if a wheel passed there.
    pub wheel: Option<MarkedWheel>,
}

/// A vehicle after the impact, in the axes of the engine.
#[derive(Clone, Debug)]
pub struct VehicleMotion<T = f64> {
    /// The body on its wheels.
    pub chassis: Chassis<T>,
    /// How its front wheels are steered.
    pub steer: SteerData<T>,
    /// (–) coefficient of friction on its path outside all zones, if it differs from that of the ground.
    pub friction: Option<T>,
    /// (m) position of the CG at impact: as given, or from that of C. If the case gives neither C nor any
    /// position of this vehicle, C is the origin; if the position of the CG relative to C is not known
    /// either, the CG is.
    pub position: Vector2<T>,
    /// (rad) heading at the impact.
    pub heading: T,
    /// How it left the impact, if the case gives speed and direction.
    pub velocity: Option<Departure<T>>,
    /// Its rest position.
    pub rest: Option<RestData<T>>,
    /// (m) points that the CG or a wheel passed, from impact to rest.
    pub points: Vec<PointData<T>>,
}

impl<T: Copy> VehicleMotion<T> {
    /// (–) coefficient of friction on its path, outside all zones.
    #[must_use]
    pub fn friction_on(&self, surface: &SurfaceData<T>) -> T {
        self.friction.unwrap_or(surface.friction)
    }
}

/// How the front wheels are steered.
#[derive(Clone, Debug)]
pub enum SteerData<T = f64> {
    /// (rad) the same angle all the time.
    Held(T),
    /// Times (s) and angles (rad).
    Over(Vec<(T, T)>),
}

impl<T: Real> SteerData<T> {
    /// The steer in the type of the engine.
    #[must_use]
    pub fn steer(&self) -> Steer<'_, T> {
        match self {
            Self::Held(angle) => Steer::Held(*angle),
            Self::Over(points) => Steer::Over(points),
        }
    }
}

/// The rest position of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestData<T = f64> {
    /// (m) place of the CG.
    pub position: Vector2<T>,
    /// Its orientation there.
    pub heading: RestHeadingData<T>,
}

/// The orientation of a vehicle at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RestHeadingData<T = f64> {
    /// (rad) its heading; the number of full turns before it is unknown.
    Heading(T),
    /// (rad) its rotation since the impact, full turns included.
    Turned(T),
}

impl<T: Real> RestHeadingData<T> {
    /// (rad) the heading at rest of a vehicle that had the heading `at_impact` (rad); if only the heading is
    /// known, without the full turns before it.
    #[must_use]
    pub fn heading(self, at_impact: T) -> T {
        match self {
            Self::Heading(heading) => heading,
            Self::Turned(turn) => at_impact + turn,
        }
    }

    /// Whether the full turns before rest are known.
    #[must_use]
    pub fn turns_are_known(self) -> bool {
        matches!(self, Self::Turned(_))
    }
}

/// Skid marks before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkidData<T = f64> {
    /// (m) their length.
    pub length: T,
    /// (–) coefficient of friction there.
    pub friction: T,
}

/// A collision whose speeds are found from how the vehicles left it.
#[derive(Clone, Debug)]
pub struct TwoSpeedInput<T = f64> {
    /// The unknown speeds.
    pub sought: Sought<T>,
    /// How much of the contact is known.
    pub geometry: Geometry,
    /// The contact. For point masses it only has masses and headings.
    pub contact: Contact<T>,
    /// The impact law; `None` if the contact is unknown, or the case gives no law.
    pub law: Option<VaryingLaw<T>>,
    /// (rad/s) yaw rates before the impact.
    pub yaw_rates: [T; 2],
    /// The data of each vehicle.
    pub vehicles: [VehicleData<T>; 2],
    /// The velocity after the impact of each vehicle, if the case gives it. Every other moving vehicle has
    /// its rest position in `motion`, or is locked to one with a velocity.
    pub departures: [Option<Departure<T>>; 2],
    /// Whether the vehicles left the impact locked together.
    pub locked_together: bool,
    /// The motion after the impact of the vehicles that can be followed; `None` if no rest position is given
    /// and the ground is unknown.
    pub motion: Option<MotionInput<T>>,
    /// The energy basis.
    pub basis: Basis<T>,
    /// Whether the crush energy of every moving vehicle is known, as required when both speeds are unknown
    /// and the approaches are collinear.
    pub has_crush: bool,
}

impl<T: Real> TwoSpeedInput<T> {
    /// The collision, with the vehicles at rest except for their yaw rates; `None` if the contact or the law
    /// is unknown.
    #[must_use]
    pub fn collision(&self) -> Option<CollisionData<T>> {
        if self.geometry != Geometry::Given {
            return None;
        }
        Some(CollisionData {
            contact: self.contact,
            law: self.law.clone()?,
            motions: self.yaw_rates.map(|yaw_rate| Motion::rest().with_yaw_rate(yaw_rate)),
            vehicles: self.vehicles.clone(),
        })
    }
}

/// The speeds that are found from the momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sought<T = f64> {
    /// Both.
    Both,
    /// That of one vehicle.
    Beside {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) the speed of the other along its direction of travel.
        known: T,
    },
    /// That of one vehicle, which hit a fixed object.
    IntoWall {
        /// The vehicle.
        vehicle: VehicleId,
    },
}

/// How much is known of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// Contact points, yaw inertias and crush plane.
    Given,
    /// Only the crush plane at a fixed object: the impulse is assumed to act towards the CG.
    Plane,
    /// Only masses and headings.
    PointMasses,
}
